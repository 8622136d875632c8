//! The step against linear theory: on a uniform, stressed lattice every run must grow at the rate that von
//! Neumann's analysis of the same discrete equations gives, and a stable one must not grow.

use super::accuracy::bar;
use crate::common::sandbox::Sandbox;
use crate::common::scene_file;
use lithosph::backend::Choice;
use lithosph::run::{Finished, Options, Stop, run};
use lithosph::scene::Scene;
use lithosph::study::stability::{self, Request, Setting, chosen, growth, simulate};
use lithosph::study::von_neumann::{Gradient, Mode, fixed_wave_vectors};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Law {
    /// K = 1.
    Fluid,
    /// E = 1, nu = 0.3.
    Elastic,
}

/// A pre-stressed lattice of spacing 1 and density 1 when unstressed.
#[derive(Clone, Copy, Debug)]
struct Case {
    dimension: usize,
    law: Law,
    /// Smoothing length over spacing.
    h: f64,
    relative_volume: f64,
    /// S_xx = -S_yy.
    deviator: f64,
    /// Coefficient and whether it is the principal form.
    artificial: Option<(f64, bool)>,
    gradient: Gradient,
    /// Particles along each axis.
    cells: [usize; 3],
}

impl Case {
    const fn new(dimension: usize, law: Law, h: f64, relative_volume: f64) -> Self {
        let cells = [[144, 1, 1], [42, 42, 1], [42, 10, 10]][dimension - 1];
        Self { dimension, law, h, relative_volume, deviator: 0.0, artificial: None, gradient: Gradient::Plain, cells }
    }
    const fn scalar(self, epsilon: f64) -> Self {
        Self { artificial: Some((epsilon, false)), ..self }
    }
    const fn principal(self, epsilon: f64) -> Self {
        Self { artificial: Some((epsilon, true)), ..self }
    }
    const fn gradient(self, gradient: Gradient) -> Self {
        Self { gradient, ..self }
    }
    const fn deviator(self, deviator: f64) -> Self {
        Self { deviator, ..self }
    }

    fn moduli(&self) -> (f64, f64) {
        match self.law {
            Law::Fluid => (1.0, 0.0),
            Law::Elastic => (1.0 / 1.2, 1.0 / 2.6),
        }
    }

    /// Speed of longitudinal waves, as the time step takes it.
    fn sound_speed(&self) -> f64 {
        let (bulk, shear) = self.moduli();
        (bulk + 4.0 / 3.0 * shear).sqrt()
    }

    fn setting(&self) -> Setting {
        Setting::new(&parsed(&self.text("", 1.0, 1))).unwrap_or_else(|reason| panic!("{self:?}: {reason}"))
    }

    /// Particles a side of the box whose waves are looked at.
    fn side(&self) -> usize {
        self.cells[0]
    }

    /// The fastest wave of the periodic box.
    fn fastest(&self) -> ([f64; 3], Mode) {
        let growth = growth(&self.setting(), self.side());
        (growth.wave, growth.mode)
    }

    fn list(&self, numbers: impl Fn(usize) -> f64) -> String {
        let words: Vec<String> = (0..self.dimension).map(|k| format!("{:.17e}", numbers(k))).collect();
        format!("[{}]", words.join(", "))
    }

    /// The scene without what starts its motion; `motion` is a line of the body.
    fn text(&self, motion: &str, duration: f64, rows: usize) -> String {
        let Self { dimension, h, relative_volume, deviator, .. } = *self;
        let material = match self.law {
            Law::Fluid => "law = 'fluid'\nbulk_modulus = 1.0",
            Law::Elastic => "youngs_modulus = 1.0\npoisson_ratio = 0.3",
        };
        let gradient = format!("{:?}", self.gradient).to_lowercase();
        let artificial = self.artificial.map_or_else(String::new, |(epsilon, principal)| {
            let form = if principal { "principal" } else { "scalar" };
            format!("artificial_stress = {{ form = '{form}', epsilon = {epsilon:?} }}")
        });
        let stress = if deviator == 0.0 {
            String::new()
        } else {
            format!("deviatoric_stress = [{deviator:?}, {:?}, 0.0, 0.0, 0.0, 0.0]", -deviator)
        };
        let (low, high) = (self.list(|_| -0.5), self.list(|k| self.cells[k] as f64 - 0.5));
        format!(
            "title = 'a stressed lattice'
            dimension = {dimension}
            units = 'dimensionless'
            spacing = 1.0
            duration = {duration:.17e}
            [[body]]
            name = 'block'
            shape = {{ block = {{ min = {low}, max = {high} }} }}
            material = 'medium'
            relative_volume = {relative_volume:?}
            {stress}
            {motion}
            [material.medium]
            density = 1.0
            {material}
            [formulation]
            smoothing_length = {h:?}
            gradient = '{gradient}'
            {artificial}
            [output]
            series = {:.17e}
            frames = 0
            [observe]
            speed = {{ kind = 'rms_speed' }}
            nearest = {{ kind = 'least_distance' }}
            ",
            duration / rows as f64
        )
    }

    fn periodic(&self) -> String {
        format!("periodic = {}\n", self.list(|k| self.cells[k] as f64))
    }
}

fn parsed(text: &str) -> Scene {
    Scene::parse(text, "stability", None, &[]).unwrap_or_else(|reason| panic!("{reason}\n{text}"))
}

fn finished(text: &str) -> Finished {
    let scene = parsed(text);
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
    run(&scene, &options).unwrap_or_else(|stop| panic!("{stop:?}\n{text}"))
}

/// Slope of ln speed over the rows from a time on.
fn slope(finished: &Finished, from: f64) -> f64 {
    let rows = finished.table.times.iter().zip(&finished.table.columns["speed"]);
    let rows: Vec<(f64, f64)> = rows.filter(|r| *r.0 >= from).map(|(&t, v)| (t, v.ln())).collect();
    let n = rows.len() as f64;
    let (t, y) = (rows.iter().map(|r| r.0).sum::<f64>() / n, rows.iter().map(|r| r.1).sum::<f64>() / n);
    rows.iter().map(|r| (r.0 - t) * (r.1 - y)).sum::<f64>() / rows.iter().map(|r| (r.0 - t).powi(2)).sum::<f64>()
}

/// Runs the fastest wave of the box.
fn compare(cases: &[Case]) {
    for case in cases {
        let begin = std::time::Instant::now();
        let (wave, mode) = case.fastest();
        assert!(mode.rate > 0.0, "{case:?} is stable: nothing to measure");
        let run = simulate(&case.setting(), case.side(), wave).unwrap();
        let error = run.rate / mode.rate - 1.0;
        println!("{:.5} {:.5} {:+.2} % {:.1} s {case:?}", run.rate, mode.rate, 100.0 * error, begin.elapsed().as_secs_f64());
        assert!(error.abs() < 0.01, "grew at {}, theory says {}: {case:?}", run.rate, mode.rate);
    }
}

use Law::{Elastic, Fluid};

#[test]
fn rows_of_particles_grow_as_theory_says() {
    compare(&[
        Case::new(1, Fluid, 1.3, 1.05),
        Case::new(1, Fluid, 0.7, 1.001),
        Case::new(1, Fluid, 1.3, 1.01).scalar(1.3),
        Case::new(1, Elastic, 1.8, 1.03),
        Case::new(1, Elastic, 1.3, 1.02).principal(1.3),
    ]);
}

#[test]
fn fluids_grow_as_theory_says() {
    compare(&[
        Case::new(2, Fluid, 1.3, 1.01),
        Case::new(2, Fluid, 1.5, 1.05).scalar(0.3),
        Case::new(2, Fluid, 1.8, 1.001).scalar(1.0),
        Case::new(2, Fluid, 1.5, 1.03).gradient(Gradient::Adjoint),
    ]);
}

#[test]
fn elastic_solids_grow_as_theory_says() {
    compare(&[
        Case::new(2, Elastic, 1.3, 1.05),
        Case::new(2, Elastic, 1.5, 1.03).principal(0.3),
        Case::new(2, Elastic, 1.3, 1.001).principal(1.0),
        Case::new(2, Elastic, 1.8, 1.01).scalar(1.0),
        Case::new(2, Elastic, 1.3, 1.03).gradient(Gradient::Corrected),
        Case::new(2, Elastic, 1.3, 1.03).gradient(Gradient::Adjoint),
        Case::new(2, Elastic, 1.5, 1.02).gradient(Gradient::Adjoint).principal(1.0),
    ]);
}

/// A stretched strip: its stress has two principal values and turns with the material.
#[test]
fn a_deviator_grows_as_theory_says() {
    compare(&[
        Case::new(2, Elastic, 1.3, 1.02).deviator(0.01),
        Case::new(2, Elastic, 1.3, 1.02).deviator(0.01).principal(0.3),
        Case::new(2, Elastic, 1.3, 1.02).deviator(0.01).gradient(Gradient::Adjoint),
    ]);
}

/// Neighbours that shear past each other in a compressed lattice cost no energy.
#[test]
fn compression_grows_as_theory_says() {
    compare(&[
        Case::new(2, Fluid, 1.5, 0.97),
        Case::new(2, Elastic, 1.3, 0.95),
        Case::new(2, Elastic, 1.8, 0.95).gradient(Gradient::Adjoint),
    ]);
}

#[test]
fn a_block_grows_as_theory_says() {
    compare(&[Case::new(3, Elastic, 1.3, 1.03)]);
}

/// Growth rate over c/dx of a box whose middle particle is kicked, from its first speed to the largest of the
/// second half of the run.
fn growth_of_noise(case: &Case, duration: f64) -> f64 {
    let text = case.periodic() + &case.text("", duration, 40) + &kick(case);
    let speed = &finished(&text).table.columns["speed"];
    let late = speed[speed.len() / 2..].iter().copied().fold(0.0, f64::max);
    (late / speed[0]).ln() / duration / case.sound_speed()
}

fn kick(case: &Case) -> String {
    let middle = case.list(|k| (case.cells[k] / 2) as f64);
    format!("[[kick]]\nat = {middle}\nvelocity = {}\n", case.list(|k| [1e-9, 3e-10, 0.0][k]))
}

/// Where theory finds no growing wave, noise must not grow: not in a relaxed lattice, not in compression in 1D,
/// and not in tension where the artificial stress is enough.
#[test]
fn stable_lattices_stay_at_the_noise() {
    let cases = [
        Case::new(1, Fluid, 1.3, 0.95),
        Case::new(1, Fluid, 1.3, 1.01).scalar(1.119),
        Case::new(1, Elastic, 1.8, 1.03).principal(0.3),
        Case::new(2, Elastic, 1.3, 1.0),
        Case::new(2, Elastic, 1.8, 1.01).scalar(0.3),
        Case::new(2, Elastic, 1.8, 1.03).principal(0.3),
    ];
    for case in cases {
        let (wave, mode) = case.fastest();
        assert!(mode.rate < 1e-6, "theory says that {case:?} grows: {mode:?} at {wave:?}");
        let growth = growth_of_noise(&case, 400.0);
        println!("{growth:.1e} {case:?}");
        assert!(growth < 1e-3, "grew at {growth} c/dx, and theory says not: {case:?}");
    }
}

/// Swegle's criterion: particles clump where the stress times W'' is positive at the neighbours, which for the
/// cubic spline beyond h 1.2 means tension, and not in compression.
#[test]
fn the_plain_method_clumps_in_tension_and_not_in_compression() {
    let nearest = |relative_volume: f64| {
        let case = Case::new(1, Fluid, 1.3, relative_volume);
        let text = case.periodic() + &case.text("", 150.0, 10) + &kick(&case);
        *finished(&text).table.columns["nearest"].last().unwrap()
    };
    assert!(nearest(1.05) < 0.5);
    assert!(nearest(0.95) > 0.999);
}

/// Swegle's block: its border is held, so its modes are near standing waves of the free inside. The kick wakes
/// all of them; those near the fastest fall behind it only slowly (the sum grows as exp(rate t)/t), so the slope
/// is taken late.
#[test]
fn a_block_with_a_held_border_grows_nearly_as_theory_says() {
    let held = 3;
    for case in
        [Case::new(2, Fluid, 1.3, 1.01), Case::new(2, Elastic, 1.3, 1.03), Case::new(2, Elastic, 1.3, 1.01).principal(0.3)]
    {
        let case = Case { cells: [47, 47, 1], ..case };
        let free = [41, 41, 0];
        let (_, theory) = case.setting().waves().fastest(&fixed_wave_vectors(free, 1.0));
        let inside = |side: f64| format!("{{ block = {{ min = [{0}, {0}], max = [{1}, {1}] }} }}", -side, 46.0 + side);
        let border = format!(
            "[[boundary]]\nselect.inside.cut = {{ from = {}, remove = [{}] }}\nfixed = true\n",
            inside(0.5),
            inside(0.5 - f64::from(held))
        );
        let finished = finished(&(case.text("", 16.0 / theory, 48) + &border + &kick(&case)));
        let measured = slope(&finished, 11.0 / theory);
        println!("{:.5} {:.5} {case:?}", measured / case.sound_speed(), theory / case.sound_speed());
        assert!((measured / theory - 1.0).abs() < 0.03, "grew at {measured}, theory says {theory}: {case:?}");
    }
}

/// Overrides of a Total Lagrangian lattice, and of an Eulerian one.
const LAGRANGIAN: &str = "formulation = { kind = 'total_lagrangian' }\n[material.medium]\nlaw = 'neo_hookean'";
const EULERIAN: &str = "formulation = { smoothing_length = 1.3 }\n[material.medium]\nlaw = 'elastic'";

/// Kernels, widths, dimensions, states and both formulations; growing waves and swinging ones.
#[test]
fn maps_of_theory_and_of_runs_agree() {
    let cases: &[(usize, &str, &[&str])] = &[
        (1, EULERIAN, &["body.block.relative_volume=1.03", "formulation.smoothing=wendland", "formulation.smoothing_length=1.6"]),
        (1, EULERIAN, &["body.block.relative_volume=1.02", "formulation.smoothing=gaussian", "formulation.smoothing_length=1.1"]),
        (1, LAGRANGIAN, &["study.stability.deformation=[[0.8]]", "formulation.smoothing=quadratic"]),
        (2, EULERIAN, &["body.block.relative_volume=0.97", "formulation.gradient=adjoint"]),
        (2, EULERIAN, &["body.block.relative_volume=1.02", "formulation.smoothing=wendland", "formulation.smoothing_length=1.5"]),
        (2, EULERIAN, &["body.block.relative_volume=1.03", "formulation.xsph=0.5", "formulation.smoothing_length=1.8"]),
        (2, LAGRANGIAN, &["study.stability.deformation=[[1.4, 0.2], [0.0, 0.8]]", "formulation.smoothing=quadratic"]),
        (2, LAGRANGIAN, &["study.stability.deformation=[[0.75, 0.0], [0.0, 0.8]]", "material.medium.law=st_venant_kirchhoff"]),
        (
            2,
            LAGRANGIAN,
            &["study.stability.damage=[0.5, 0.0]", "study.stability.whole_correction=true", "formulation.hourglass=0"],
        ),
        (
            2,
            LAGRANGIAN,
            &[
                "study.stability.deformation=[[1.1, 0.0], [0.0, 0.9]]",
                "formulation.gradient=quadratic",
                "formulation.smoothing_length=1.7",
            ],
        ),
    ];
    let (cells, mut growing, mut swinging) = (24, 0, 0);
    for (dimension, formulation, overrides) in cases {
        let text = format!(
            "title = 'a lattice'
            dimension = {dimension}
            units = 'dimensionless'
            spacing = 1.0
            duration = 1.0
            body = [{{ name = 'block', shape = {{ block = {{ min = [0, 0], max = [9, 9] }} }}, material = 'medium' }}]
            {formulation}
            density = 1.0
            youngs_modulus = 1.0
            poisson_ratio = 0.3
            "
        );
        let overrides: Vec<String> = overrides.iter().map(|path| (*path).to_string()).collect();
        let scene = Scene::parse(&text, "lattice", None, &overrides).unwrap_or_else(|reason| panic!("{reason}"));
        let setting = Setting::new(&scene).unwrap();
        for wave in chosen(&setting, cells, 5) {
            let run = simulate(&setting, cells, wave).unwrap();
            assert!(run.difference.abs() < 0.02, "{overrides:?} {run:?}");
            *if run.theory.rate > 0.0 { &mut growing } else { &mut swinging } += 1;
        }
    }
    println!("{growing} growing and {swinging} swinging waves");
    assert!(growing >= 12 && growing + swinging >= 45, "{growing} {swinging}");
}

/// The command writes its tables, pictures and page, and runs no wave twice.
#[test]
fn a_study_goes_on_where_it_was_stopped() {
    let sandbox = Sandbox::new("stability");
    let folder = &sandbox.folder;
    let out = folder.join("block.csv");
    let request = |simulate: usize, cells: usize| Request {
        scene: scene_file("tension_square"),
        vary: vec!["formulation.smoothing_length=1.3,1.8".into()],
        cells,
        simulate,
        out: Some(out.clone()),
        ..Request::default()
    };
    let text = stability::run(&request(2, 12)).unwrap();
    assert!(text.contains("1.3: 2 waves run, 2 within 10 % of theory"), "{text}");
    let read = |end: &str| std::fs::read_to_string(folder.join(end)).unwrap_or_else(|error| panic!("{end}: {error}"));
    let short = read("block-runs.csv");
    assert_eq!(short.lines().count(), 2 + 4);
    // The last row is cut, as by a kill, and more waves are asked for: what is whole stays as it is.
    std::fs::write(folder.join("block-runs.csv"), &short[..short.len() - 5]).unwrap();
    stability::run(&request(3, 12)).unwrap();
    let long = read("block-runs.csv");
    let kept: Vec<&str> = short.lines().take(5).collect();
    assert!(long.lines().take(5).eq(kept) && long.lines().count() == 2 + 6, "{long}");
    assert_eq!(read("block.csv").lines().count(), 3);
    // Of few waves no map is made.
    assert!(!read("block.html").contains("Growth rate in runs"));
    assert_eq!(read("block-zone.csv").lines().count(), 1 + 2 * (13 * 13 - 1));
    assert!(read("block.html").contains("<svg") && read("block-2.svg").contains("<svg"));
    assert!(folder.join("block-1.png").exists() && folder.join("block-runs.png").exists());
    match stability::run(&request(3, 16)) {
        Err(Stop::Refused(reason)) => assert!(reason.contains("--force"), "{reason}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn limits_of_a_lattice_that_grows_are_refused_before_anything_is_written() {
    let sandbox = bar("limits");
    let said = sandbox.lithosph(&["study", "stability", "bar.toml", "--limits", "--set", "body.bar.relative_volume=1.05"]);
    assert!(said.code == Some(2) && said.err.contains("grows at any step") && !sandbox.exists("out"), "{said:?}");
}
