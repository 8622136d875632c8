use super::case::{Case, Form, Spacing};
use super::findings::Statement;
use super::particles::{Block, Rule, border, growth};
use super::partition::{self, Criterion, Equation, Partition, Unity};
use super::unity::{Packing, disorder, sums};
use super::windows::windows;
use super::{compression, criteria, edge, line, plane, points, repulsion, tension, viscosity, work};
use crate::smoothing::Smoothing;
use crate::study::von_neumann::{fixed_wave_vectors, second_derivative};
use glam::DVec3;
use std::f64::consts::PI;

/// The smallest stable epsilon on a line stops the sawtooth, which has no gradient: with one neighbour on each side at an odd
/// distance W'' - epsilon (W'' + n W'^2/W) = 0 there, for dp = dx.
fn least_on_a_line(ratio: f64) -> f64 {
    let lattice = Case::new(1, ratio).lattice();
    let (w, slope) = (lattice.smoothing.value(1.0, ratio, 1), lattice.smoothing.derivative(1.0, ratio, 1));
    let curvature = second_derivative(&lattice, 1.0);
    curvature / (curvature + 4.0 * slope * slope / w)
}

#[test]
fn windows_on_a_line_begin_where_the_sawtooth_stops() {
    for ratio in [0.7, 1.3] {
        let found = windows(Case::new(1, ratio), [1e-2, 1e2], 41);
        assert!(found.len() == 1 && (found[0][0] / least_on_a_line(ratio) - 1.0).abs() < 1e-4, "{ratio}: {found:?}");
    }
    // The trace is three times the pressure, and dp only scales f^n.
    let whole = windows(Case::new(1, 1.3), [1e-2, 1e2], 41)[0];
    let trace = windows(Case::new(1, 1.3).form(Form::Trace), [1e-3, 1e2], 51)[0];
    let mean = windows(Case::new(1, 1.3).spacing(Spacing::Mean), [1e-5, 1e2], 71)[0];
    let lattice = Case::new(1, 1.3).lattice();
    let value = |r: f64| lattice.smoothing.value(r, 1.3, 1);
    let factor = (value(1.0) / value(1.5)).powi(4);
    for end in 0..2 {
        assert!((whole[end] / trace[end] / 3.0 - 1.0).abs() < 1e-4, "{whole:?} {trace:?}");
        assert!((whole[end] / mean[end] / factor - 1.0).abs() < 1e-4, "{whole:?} {mean:?} {factor}");
    }
    assert!((whole[1] - 1.166).abs() < 0.001, "{whole:?}");
}

/// Runs of the small loop on either side of both ends of a window.
#[test]
fn runs_end_where_windows_do() {
    let [low, high] = windows(Case::new(1, 1.3), [1e-2, 1e2], 41)[0];
    for (epsilon, grows) in [(0.8 * low, true), (1.2 * low, false), (0.95 * high, false), (1.1 * high, true)] {
        let rows = Block::new(Case::new(1, 1.3).epsilon(epsilon), Rule::default(), 61, 2e-10).run(800.0, 20, 0.2);
        let most = rows.iter().map(|row| row.speed).fold(0.0, f64::max) / rows[0].speed;
        assert_eq!(most > 3.0, grows, "epsilon {epsilon}: {most}");
    }
}

#[test]
fn the_fluid_of_the_partitions_is_that_of_the_analysis() {
    for (dimension, ratio, volume) in [(1, 1.3, 1.01), (2, 1.2, 1.03), (2, 1.8, 0.97), (3, 1.3, 1.02)] {
        let case = Case::new(dimension, ratio).volume(volume);
        let (here, there) = (partition::growth(case, None), case.growth());
        assert!((here - there).abs() < 1e-9, "{dimension}D h {ratio} V {volume}: {here} {there}");
        for (criterion, equation) in
            [(Criterion::SmoothingLength, Equation::Momentum), (Criterion::SmoothingLength, Equation::StrainRate)]
        {
            let control = partition::growth(case, Some(Partition::new(criterion, equation, Unity::Local, 1.0)));
            assert!((control - there).abs() < 1e-9, "lambda 1 is the plain method: {control} {there}");
        }
    }
}

/// Growth of the fastest standing wave of a line in the small loop over that of the analysis.
fn grown(case: Case, partition: Partition) -> f64 {
    let rule = Rule { partition: Some(partition), ..Rule::default() };
    let free = 201 - 2 * border(case, rule);
    let rates = partition::rates(case, Some(partition), &fixed_wave_vectors([free, 0, 0], 1.0));
    let (m, rate) = (1..).zip(rates).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert!(rate > 0.01, "nothing to measure: {partition:?}");
    let rows = Block::new(case, rule, 201, 0.0).standing(m, 1e-9).run(8.0 / rate, 40, 0.1_f64.min(0.05 / rate));
    growth(&rows.iter().map(|row| (row.time, row.speed)).collect::<Vec<_>>(), 4.0 / rate) / rate
}

#[test]
fn partitions_grow_as_their_analysis_says() {
    let neighbourhood = |equation| Partition::new(Criterion::Neighbourhood, equation, Unity::Ring, 1.5);
    let smoothing = Partition::new(Criterion::SmoothingLength, Equation::Momentum, Unity::Local, 1.5);
    for partition in [
        neighbourhood(Equation::Momentum),
        neighbourhood(Equation::StrainRate),
        Partition { swapped: true, ..smoothing },
        Partition { factor: 10.0, unity: Unity::Ring, scale: 1.75, ..smoothing },
    ] {
        let ratio = grown(Case::new(1, 1.2), partition);
        assert!((ratio - 1.0).abs() < 0.01, "{ratio} {partition:?}");
    }
}

#[test]
fn viscous_waves_grow_as_worked_out() {
    let case = Case::new(1, 1.3);
    for epsilon in [0.0, 0.03] {
        let case = case.epsilon(epsilon);
        let (found, (_, theory)) = (viscosity::measured(case, viscosity::STRONG), viscosity::fastest(case, viscosity::STRONG));
        assert!((found / theory - 1.0).abs() < 0.02 && theory < 0.3 * case.growth(), "{found} {theory}");
    }
    let least = least_on_a_line(1.3);
    assert!(viscosity::viscous(case.epsilon(0.999 * least), viscosity::STRONG, PI) > 0.0);
    assert_eq!(viscosity::viscous(case.epsilon(1.001 * least), viscosity::STRONG, PI), 0.0);
}

#[test]
fn sums_over_lattices_are_exact_where_they_are_known() {
    let all = |packing: Packing, h: f64, kernel| sums(kernel, h, packing, &packing.neighbours(2.0 * h));
    // B-splines at whole h are a partition of unity; Johnson's parabola at h = dx sums to 3/4 + 2 3/16.
    for h in [1.0, 2.0, 3.0] {
        assert!((all(Packing::Square(1), h, Smoothing::CubicSpline).0 - 1.0).abs() < 1e-14);
    }
    assert!((all(Packing::Square(1), 1.0, Smoothing::Quadratic).0 - 1.125).abs() < 1e-14);
    // The end of a line at h = dx: 2/3 + 1/6, and h W'(dx) = -1/2.
    let (unity, gradient) = sums(Smoothing::CubicSpline, 1.0, Packing::Square(1), &[DVec3::X]);
    assert!((unity - 5.0 / 6.0).abs() < 1e-14 && (gradient.x - 0.5).abs() < 1e-14, "{unity} {gradient}");
    // Packings: neighbours of the first shell, and the volume of a particle.
    for (packing, first) in [(Packing::Square(3), 6), (Packing::Hexagonal, 6), (Packing::FaceCentred, 12)] {
        assert_eq!(packing.neighbours(1.1).len(), first);
        let (unity, gradient) = all(packing, 2.5, Smoothing::Wendland);
        assert!((unity - 1.0).abs() < 2e-3 && gradient.length() < 1e-12, "{packing:?}: {unity} {gradient}");
    }
    // Disorder: none gives the lattice, and moving all spreads the sums about 1.
    let lattice = all(Packing::Square(2), 1.3, Smoothing::CubicSpline).0;
    let [mean, deviation, slope] = disorder(Smoothing::CubicSpline, 1.3, 2, 0.0);
    assert!((mean - lattice).abs() < 1e-12 && deviation < 1e-7 && slope < 1e-12);
    let [small, large] = [0.05, 0.2].map(|amount| disorder(Smoothing::CubicSpline, 1.3, 2, amount));
    assert!(large[1] > 2.0 * small[1] && large[2] > 2.0 * small[2] && (small[0] - 1.0).abs() < 0.01, "{small:?} {large:?}");
}

#[test]
fn edges_of_a_linear_function_have_their_closed_forms() {
    // h = dx: the spline reproduces linear functions inside; W(0), W(1) are 2/3, 1/6 and W'(1) = -1/2.
    let found = edge::estimates(Smoothing::CubicSpline, 1.0, 9);
    let (end, inside, last) = (found[0], found[4], found[8]);
    let is = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} {b}");
    is(inside.value, inside.x);
    is(inside.gradient, 1.0);
    is(end.unity, 5.0 / 6.0);
    is(end.value, 0.5 * 2.0 / 3.0 + 1.5 / 6.0);
    is(end.gradient, 0.75);
    is(end.difference, 0.5);
    is(last.gradient, -0.5 * 7.5);
    for &smoothing in Smoothing::ALL {
        let found = edge::estimates(smoothing, 1.3, 20);
        is(2.0 * found[0].difference, found[10].difference);
        is(found[10].difference, found[10].gradient);
        found.iter().for_each(|e| is(e.corrected, 1.0));
    }
}

/// The verdicts of statements, `+` where they agree: as they came out when each was looked at.
fn verdicts(statements: &[Statement], expected: &str) {
    let found: String = statements.iter().map(|statement| if statement.agrees { '+' } else { '-' }).collect();
    assert_eq!(found, expected.replace(' ', ""), "{statements:#?}");
}

#[test]
fn statements_about_the_repulsive_force_come_out_as_they_did() {
    verdicts(&repulsion::spacing().statements, "+ + -");
    // Windows with dp mean and initial and a point of each, h 0.7 and 1.8, and the fall with h.
    verdicts(&line::line_statements(), "-- -+ -- +");
    // dp mean, its calmest, dp initial; h 1.52; h 1.8 and two points; Libersky's three; the space.
    verdicts(&plane::plane_statements(), "+-+ + +-+ +-- +");
    verdicts(&tension::tension_statements(), "--- +- - +");
    verdicts(&compression::statements(), "++-++");
}

#[test]
fn statements_about_everything_else_come_out_as_they_did() {
    verdicts(&criteria::estimates(), "+-++-");
    verdicts(&criteria::criteria().statements, "+++- +++- +");
    verdicts(&edge::linear().statements, "++-+");
    verdicts(&work::work().statements, "++-");
    verdicts(&viscosity::line_statements(), "++");
}

/// The small loop against the program, in the same test: the kicked line.
#[test]
fn the_small_loop_follows_the_program() {
    let case = Case::new(1, 1.3).volume(1.03);
    let point = points::Point { figure: "", case, published: None };
    let scene = crate::scene::Scene::parse(&point.text(), "tension_square", Some("study"), &[]).unwrap();
    let options = crate::run::Options { choice: crate::backend::Choice::Cpu, dry: true, quiet: true, ..Default::default() };
    let table = crate::run::run(&scene, &options).unwrap().table;
    let end = table.times[table.times.len() - 1] * compression::UNIT_RATE;
    let rows = Block::new(case, Rule::default(), 51, 2e-10).run(end, 80, 0.25);
    for (ours, theirs) in rows.iter().zip(&table.columns["speed"]) {
        // In c, and with 5000 m/s.
        let ratio = ours.speed * 5000.0 / theirs;
        assert!((ratio - 1.0).abs() < 0.02, "at {}: {ratio}", ours.time);
    }
}

#[test]
fn the_repulsive_force_does_work_only_where_it_fails() {
    let kicked = |epsilon: f64| {
        let rows = work::swegle(epsilon);
        rows[rows.len() - 1].work_of_lengths / rows[0].kinetic
    };
    assert!(Case::new(1, 1.3).epsilon(0.3).is_stable() && kicked(0.3) < 100.0, "{}", kicked(0.3));
    assert!(!Case::new(1, 1.3).epsilon(1.3).is_stable() && kicked(1.3) > 1e6, "{}", kicked(1.3));
    // Stretch and return give back all; the path that encloses an area does not.
    let ([there, back], [_, around]) = (work::led(0.3, false), work::led(0.3, true));
    let taken = 1.0 - work::stiffness_left(Case::new(1, 1.3).epsilon(0.3));
    assert!((there / taken - 1.0).abs() < 0.03, "the work is what the stiffness lacks: {there} {taken}");
    assert!(back.abs() < 1e-3 * there && around.abs() > 100.0 * back.abs(), "{there} {back} {around}");
    // Takes stiffness in proportion to epsilon.
    let left = |epsilon: f64| work::stiffness_left(Case::new(1, 1.3).epsilon(epsilon));
    assert!((2.0 * (1.0 - left(0.1)) - (1.0 - left(0.2))).abs() < 1e-6 && left(0.1) < 1.0);
}
