//! The J2 body of the Total Lagrangian formulation on the paths of one element, beside closed forms and the rate
//! equations; its heat; what a rotation does to it; and the digits of f32.

use crate::common::deformation::*;
use crate::common::matrix::{M, determinant, times};
use lithosph::backend::Choice;
use lithosph::material::j2::J2;
use lithosph::material::{self, Law, Memory};
use lithosph::rows::Body;
use lithosph::run::{Options, run};
use lithosph::scene::Scene;
use lithosph::tensor::{Line, Plane, Real, Solid, Space};

mod plastic_flow;
use plastic_flow::Flow;

type S = Solid<f64>;

#[derive(Clone, Copy, Debug)]
enum Hardening {
    Perfect,
    Linear,
    Power,
}
const HARDENINGS: [Hardening; 3] = [Hardening::Perfect, Hardening::Linear, Hardening::Power];

/// A metal of elastic strains of some 1e-3.
fn metal<R: Real>(hardening: Hardening) -> Body<R> {
    let [modulus, exponent] = match hardening {
        Hardening::Perfect => [0.0, 1.0],
        Hardening::Linear => [0.01, 1.0],
        Hardening::Power => [0.006, 0.3],
    };
    let elastic = Body { bulk_modulus: R::of(1.0 / 1.2), shear_modulus: R::of(1.0 / 2.6), ..body(Law::J2) };
    crate::common::deformation::metal(elastic, [2e-3, modulus, exponent])
}

fn yield_stress(body: &Body<f64>, k: f64) -> f64 {
    let own = J2::of(body);
    own.yield_stress + own.hardening * k.powf(own.hardening_exponent)
}

fn gradient_of<T: Space>(f: &M) -> T::Mat {
    let mut h = T::Mat::default();
    for i in 0..T::DIMENSION {
        for j in 0..T::DIMENSION {
            h[T::mat_index(i, j)] = T::Real::of(f[i][j] - if i == j { 1.0 } else { 0.0 });
        }
    }
    h
}

fn cauchy(body: &Body<f64>, h: <S as Space>::Mat, memory: &Memory<S>) -> [f64; 6] {
    material::cauchy::<S>(body, h, memory.strain).0
}

/// Uniaxial stress q: ln of the axial stretch without plastic flow. Its isochoric part is ln(b)/2 with
/// q = mu (b - b^(-1/2)), its third of the volume's asinh(5 q/(3 K))/5, from q/3 = K/10 (J^5 - J^-5).
fn elastic_stretch(body: &Body<f64>, q: f64) -> f64 {
    let mut b = 1.0 + q / (1.5 * body.shear_modulus);
    for _ in 0..50 {
        let excess = body.shear_modulus * (b - b.powf(-0.5)) - q;
        b -= excess / (body.shear_modulus * (1.0 + 0.5 * b.powf(-1.5)));
    }
    0.5 * b.ln() + volume(body, q) / 3.0
}

/// ln J
fn volume(body: &Body<f64>, q: f64) -> f64 {
    (5.0 / 3.0 * q / body.bulk_modulus).asinh() / 5.0
}

/// Axial Cauchy stress and memory after one step to stretches exp(axial), the sides free; `side` is a guess.
fn pull(body: &Body<f64>, memory: &Memory<S>, axial: f64, mut side: f64) -> (f64, Memory<S>) {
    let at = |side: f64| {
        let f = [[axial.exp(), 0.0, 0.0], [0.0, side.exp(), 0.0], [0.0, 0.0, side.exp()]];
        let h = gradient_of::<S>(&f);
        let next = material::relax::<S>(body, h, *memory, 0.0);
        (cauchy(body, h, &next), next)
    };
    // Secants: the response to the side is smooth, but not known here.
    let mut before = side + 1e-6;
    let mut pressed = at(before).0[1];
    for _ in 0..60 {
        let (stress, next) = at(side);
        if stress[1].abs() < 1e-14 || stress[1] == pressed {
            return (stress[0], next);
        }
        let slope = (stress[1] - pressed) / (side - before);
        (before, pressed) = (side, stress[1]);
        side -= stress[1] / slope;
    }
    panic!("no side stretch frees the sides at {axial}");
}

/// A bar pulled and pushed with free sides through turning points of its plastic strain.
struct Bar {
    body: Body<f64>,
    /// Plastic logarithmic strain, and its sum without signs.
    plastic: f64,
    k: f64,
    memory: Memory<S>,
    axial: f64,
}

impl Bar {
    fn new(hardening: Hardening) -> Self {
        Self { body: metal(hardening), plastic: 0.0, k: 0.0, memory: Memory::<S>::default(), axial: 0.0 }
    }

    /// Errors of stress and k, relative, after going on to a plastic strain.
    fn go(&mut self, plastic: f64, steps: u32) -> [f64; 2] {
        let sign = (plastic - self.plastic).signum();
        self.k += (plastic - self.plastic).abs();
        let q = sign * yield_stress(&self.body, self.k);
        let end = elastic_stretch(&self.body, q) + plastic;
        let (start, mut stress) = (self.axial, 0.0);
        for step in 1..=steps {
            self.axial = start + (end - start) * f64::from(step) / f64::from(steps);
            let side = 0.5 * (volume(&self.body, q) - self.axial);
            (stress, self.memory) = pull(&self.body, &self.memory, self.axial, side);
        }
        self.plastic = plastic;
        [stress * volume(&self.body, q).exp() / q - 1.0, self.memory.plastic / self.k - 1.0]
    }
}

#[test]
fn tension_and_cycles_follow_the_closed_form() {
    for hardening in HARDENINGS {
        let mut bar = Bar::new(hardening);
        for plastic in [0.2, 0.19, 0.1, 0.15, -0.1] {
            let errors = bar.go(plastic, 1000);
            println!("{hardening:?} at plastic strain {plastic}: stress off by {:.1e}, k by {:.1e}", errors[0], errors[1]);
            assert!(errors.iter().all(|error| error.abs() < 1e-6), "{hardening:?} at {plastic}: {errors:?}");
        }
        // The step is of second order on such a path.
        let errors = [50, 100, 200].map(|steps| Bar::new(hardening).go(0.2, steps)[1].abs());
        assert!(errors[0] > 3.0 * errors[1] && errors[1] < 1e-5, "{hardening:?}: {errors:?}");
    }
}

fn turn(axis: usize, angle: f64) -> M {
    let (sin, cos) = angle.sin_cos();
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut q = [[0.0; 3]; 3];
    (q[axis][axis], q[i][i], q[j][j], q[i][j], q[j][i]) = (1.0, cos, cos, -sin, sin);
    q
}

fn shear(t: f64) -> M {
    [[1.0, t, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

/// The wall of a tube that is pulled and twisted, more and more of the latter.
fn twist(t: f64) -> M {
    let axial = 1.0 + 0.1 * (1.5 * t).sin();
    [[axial.powf(-0.49), 0.0, 0.0], [0.0, axial.powf(-0.49), 0.3 * t * t], [0.0, 0.0, axial]]
}

/// The same while all turns.
fn turning(t: f64) -> M {
    times(&times(&turn(0, 2.0 * t), &turn(2, -3.0 * t)), &twist(t))
}

/// Memory at the end of a path in so many steps, from an equivalent plastic strain.
fn walked<T: Space>(body: &Body<T::Real>, path: &dyn Fn(f64) -> M, k: f64, steps: u32) -> Memory<T> {
    let walk = |memory, step| {
        let h = gradient_of::<T>(&path(f64::from(step) / f64::from(steps)));
        material::relax::<T>(body, h, memory, T::Real::of(0.0))
    };
    (1..=steps).fold(remembering(T::Sym::default(), T::Real::of(k)), walk)
}

/// k before the paths: with none, the slope of a power is infinite, and its rate equations have no solver.
const WORKED: f64 = 0.01;

/// Error of Kirchhoff's deviator at the end of a path, over the yield stress.
fn error_of(flow: &Flow, memory: &Memory<S>, (s, k): &(M, f64)) -> f64 {
    let f = (flow.path)(1.0);
    let seen = cauchy(&flow.body, gradient_of::<S>(&f), memory).map(|x| x * determinant(&f));
    let mean = (seen[0] + seen[1] + seen[2]) / 3.0;
    let wanted = [s[0][0] + mean, s[1][1] + mean, s[2][2] + mean, s[0][1], s[1][2], s[0][2]];
    let worst = seen.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    worst / yield_stress(&flow.body, *k)
}

type Path = fn(f64) -> M;

#[test]
fn shear_and_torsion_follow_the_rate_equations() {
    let paths: [(&str, Path, u32); 3] = [("shear", shear, 500_000), ("twist", twist, 50_000), ("turning", turning, 50_000)];
    for (name, path, steps) in paths {
        for hardening in HARDENINGS {
            let flow = Flow { body: metal(hardening), path: &path };
            let wanted = flow.run(WORKED, 4000);
            let memory = walked::<S>(&flow.body, &path, WORKED, steps);
            let errors = [error_of(&flow, &memory, &wanted), (memory.plastic / wanted.1 - 1.0).abs()];
            println!("{name}, {hardening:?}: stress off by {:.1e}, k = {:.3} by {:.1e}", errors[0], wanted.1, errors[1]);
            assert!(errors.iter().all(|error| *error < 1e-6), "{name}, {hardening:?}: {errors:?}");
            // Of first order where the direction of stress changes.
            let coarse = error_of(&flow, &walked::<S>(&flow.body, &path, WORKED, steps / 10), &wanted);
            assert!((coarse / errors[0] - 10.0).abs() < 2.0, "{name}, {hardening:?}: {coarse:e} {errors:?}");
        }
    }
}

#[test]
fn a_rotation_of_the_whole_path_changes_nothing() {
    for hardening in HARDENINGS {
        let body = metal::<f64>(hardening);
        let (still, turned) = (walked::<S>(&body, &twist, 0.0, 300), walked::<S>(&body, &turning, 0.0, 300));
        let apart = apart::<S>(S::mat_of_sym(still.strain), S::mat_of_sym(turned.strain));
        assert!(apart < 1e-13 && (still.plastic - turned.plastic).abs() < 1e-13, "{hardening:?}: {apart:e}");
        assert!(still.plastic > 0.1, "{hardening:?}: nothing flowed");
    }
}

#[test]
fn the_plane_is_a_slice_of_space() {
    let body = metal::<f64>(Hardening::Linear);
    let path = |t: f64| [[1.0 + 0.2 * t, 0.3 * t * t, 0.0], [-0.1 * t, 1.0 - 0.1 * t, 0.0], [0.0, 0.0, 1.0]];
    let line = |t: f64| [[1.0 - 0.1 * t, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let (plane, solid) = (walked::<Plane<f64>>(&body, &path, 0.0, 100), walked::<S>(&body, &path, 0.0, 100));
    let [xx, yy, _, xy, ..] = solid.strain.0;
    assert!((plane.plastic - solid.plastic).abs() < 1e-14 && solid.plastic > 0.1);
    assert!(plane.strain.0.iter().zip([xx, yy, xy]).all(|(a, b)| (a - b).abs() < 1e-13), "{plane:?} {solid:?}");
    let (narrow, solid) = (walked::<Line<f64>>(&body, &line, 0.0, 100), walked::<S>(&body, &line, 0.0, 100));
    assert!(
        (narrow.plastic - solid.plastic).abs() < 1e-14
            && (narrow.strain.0[0] - solid.strain.0[0]).abs() < 1e-13
            && solid.plastic > 0.01
    );
}

/// Work done along a path, and stored energy and heat at its end; per volume.
fn energies(body: &Body<f64>, path: &dyn Fn(f64) -> M, steps: u32) -> [f64; 3] {
    let (mut memory, mut h) = (Memory::<S>::default(), <S as Space>::Mat::default());
    let (mut work, mut heat) = (0.0, 0.0);
    for step in 1..=steps {
        let next_h = gradient_of::<S>(&path(f64::from(step) / f64::from(steps)));
        let next = material::relax::<S>(body, next_h, memory, 0.0);
        let stresses = material::first_piola::<S>(body, h, memory.strain) + material::first_piola::<S>(body, next_h, next.strain);
        work += 0.5 * S::trace(S::mat_mat(S::transpose(stresses), next_h - h));
        heat += material::dissipated::<S>(body, (h, memory.strain), (next_h, next.strain));
        (memory, h) = (next, next_h);
    }
    [work, material::stored_energy::<S>(body, h, memory.strain), heat]
}

#[test]
fn work_is_stored_or_plastic() {
    for hardening in HARDENINGS {
        let body = metal::<f64>(hardening);
        let errors = [1000, 10_000].map(|steps| {
            let [work, stored, heat] = energies(&body, &turning, steps);
            assert!(heat > 20.0 * stored && stored > 0.0);
            ((stored + heat) / work - 1.0).abs()
        });
        println!("{hardening:?}: stored energy and heat off the work by {errors:?}");
        // All three trapezoids are of second order but for the one step in which flow begins.
        assert!(errors[1] < 1e-6 && errors[1] < 0.2 * errors[0], "{hardening:?}: {errors:?}");
        // Of perfect plasticity the heat is sY k.
        if matches!(hardening, Hardening::Perfect) {
            let [_, _, heat] = energies(&body, &turning, 10_000);
            let k = walked::<S>(&body, &turning, 0.0, 10_000).plastic;
            assert!((heat / (body.yield_stress * k) - 1.0).abs() < 1e-6, "{heat} {k}");
        }
    }
}

/// A plate set shearing, which soon yields: first and last total energy, and the plastic work.
fn sheared_plate(kind: &str, steps: u32) -> [f64; 3] {
    let text = format!(
        "title = 'plate'
        dimension = 2
        units = 'dimensionless'
        spacing = 0.1
        duration = 0.6
        [[body]]
        name = 'plate'
        shape = {{ block = {{ min = [-0.5, -0.5], max = [0.5, 0.5] }} }}
        anchor = [0, 0]
        material = 'metal'
        motion = {{ gradient = [[0, 0.8], [0, 0]] }}
        [material.metal]
        law = 'j2'
        density = 3.0
        bulk_modulus = 5.833
        shear_modulus = 1.25
        yield_stress = 0.1
        hardening = {{ linear = 0.3 }}
        [formulation]
        kind = '{kind}'
        gradient = 'adjoint'
        dissipated_energy = true
        [time]
        step = {step:.17}
        [output]
        series = 0.6
        frames = 0
        [observe]
        total = {{ kind = 'total_energy' }}
        heat = {{ kind = 'dissipated_energy' }}
        ",
        step = 0.6 / f64::from(steps),
    );
    let changes: &[String] = if kind == "eulerian" { &[] } else { &["formulation.hourglass=0".into()] };
    let scene = Scene::parse(&text, "plate", None, changes).unwrap();
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
    let finished = run(&scene, &options).unwrap_or_else(|stop| panic!("{stop:?}"));
    let ends = |name: &str| [finished.table.columns[name][0], *finished.table.columns[name].last().unwrap()];
    [ends("total")[0], ends("total")[1], ends("heat")[1]]
}

#[test]
fn the_energy_of_a_run_that_yields_stays() {
    // The hypoelastic law has an energy for small strains only; elastic strains are of a tenth here.
    for (kind, tolerance) in [("total_lagrangian", 1e-4), ("eulerian", 1e-3)] {
        let errors = [80, 160, 320].map(|steps| {
            let [first, last, heat] = sheared_plate(kind, steps);
            assert!(heat > 0.2 * first, "{kind}: {heat} of {first}");
            (last / first - 1.0).abs()
        });
        println!("{kind}: energy off by {errors:?}");
        assert!(errors[2] < tolerance, "{kind}: {errors:?}");
    }
}

#[test]
fn single_precision_follows_double() {
    for hardening in HARDENINGS {
        let (wide, narrow) = (metal::<f64>(hardening), metal::<f32>(hardening));
        let wanted = walked::<S>(&wide, &turning, 0.0, 1000);
        let seen = walked::<Solid<f32>>(&narrow, &turning, 0.0, 1000);
        let h = turning(1.0);
        let truth = material::first_piola::<S>(&wide, gradient_of::<S>(&h), wanted.strain);
        let stress = material::first_piola::<Solid<f32>>(&narrow, gradient_of::<Solid<f32>>(&h), seen.strain);
        let stress = embedded::<Solid<f32>, S>(stress);
        let errors = [apart::<S>(truth, stress) / size::<S>(truth), (seen.plastic.f64() / wanted.plastic - 1.0).abs()];
        println!("{hardening:?}: f32 stress off by {:.1e}, k by {:.1e}", errors[0], errors[1]);
        // H of 2 holds the stretch to 1.2e-7, of an elastic strain of 2e-3.
        assert!(errors[0] < 5e-4 && errors[1] < 3e-5, "{hardening:?}: {errors:?}");
    }
}
