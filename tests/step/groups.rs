//! Bodies of different formulations in one run: what each does alone it does beside the others, and what acts between them
//! keeps momentum.

use crate::common::{adapter, in_order, largest, parse, steps};
use lithosph::backend::cpu::Cpu;
use lithosph::backend::gpu::Gpu;
use lithosph::backend::{Backend, Choice};
use lithosph::fields::Field;
use lithosph::method::Formulation;
use lithosph::pass::Pass;
use lithosph::run::{Options, run};
use lithosph::scene::Scene;
use lithosph::scene::file::Viscosity;
use lithosph::state::State;
use lithosph::step;
use lithosph::tensor::{Plane, Space};

/// A disc of rates and a bonded one `gap` apart that move towards each other, off the axis; with more lines.
fn discs(gap: f64, time: &str, contact: &str) -> Scene {
    parse(&text_of(gap, time, contact))
}

fn text_of(gap: f64, time: &str, contact: &str) -> String {
    format!(
        r#"
title = "discs"
dimension = 2
units = "dimensionless"
spacing = 1.0
duration = 1000.0
[[body]]
name = "flowing"
shape = {{ disc = {{ center = [{}, 2], radius = 6 }} }}
anchor = [{}, 2]
material = "rubber"
formulation = "rates"
velocity = [0.05, 0]
[[body]]
name = "bonded"
shape = {{ disc = {{ center = [6, -2], radius = 6 }} }}
anchor = [6, -2]
material = "neo_hookean"
velocity = [-0.03, 0.01]
[material.rubber]
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[material.neo_hookean]
law = "neo_hookean"
density = 1.3
youngs_modulus = 2.0
poisson_ratio = 0.3
[formulation]
kind = "total_lagrangian"
[formulation.rates]
smoothing_length = 1.4
gradient = "adjoint"
viscosity = {{ alpha = 0.2 }}
{contact}
[time]
{time}
"#,
        -6.0 - gap,
        -6.0 - gap
    )
}

const BARRIER: &str =
    "[[contact]]\nbetween = [\"flowing\", \"bonded\"]\npotential = { law = \"barrier\", stiffness = 0.5, range = 1.0 }";
const COLOUR: &str =
    "[[contact]]\nbetween = [\"flowing\", \"bonded\"]\ncolour_field = { stiffness = 0.5, threshold = 0.2, range = 5 }";

fn cpu(scene: &Scene) -> Cpu<Plane<f64>> {
    Cpu::of_members(scene.members().map(|member| member.state::<Plane<f64>>(false)).collect())
}

/// Momentum, and the sum of m|v|.
fn momentum<S: Space<Real = f64>>(groups: &[State<S>]) -> ([f64; 2], f64) {
    let (mut sum, mut size) = ([0.0; 2], 0.0);
    for state in groups.iter().filter(|state| !state.method.between) {
        for (a, v) in state.columns.velocity.iter().enumerate() {
            (0..2).for_each(|k| sum[k] += state.mass(a) * v[k]);
            size += state.mass(a) * S::inner(*v, *v).sqrt();
        }
    }
    (sum, size)
}

#[test]
fn each_group_has_the_fields_and_passes_that_it_has_alone() {
    let scene = discs(0.5, "", BARRIER);
    let [flowing, bonded] = scene.groups() else { panic!("{} groups", scene.groups().len()) };
    assert_eq!((flowing.method.formulation, bonded.method.formulation), (Formulation::Eulerian, Formulation::TotalLagrangian));
    for (group, kept) in [(flowing, "flowing"), (bonded, "bonded")] {
        let alone = alone(kept);
        assert_eq!(group.method, alone.method, "{kept}");
        assert_eq!(step::calls(&group.method), step::calls(&alone.method));
        assert_eq!(step::fields(&group.method), step::fields(&alone.method));
    }
    let between: Vec<Pass> = step::passes(&scene.method);
    use Pass::*;
    assert_eq!(between, [BinCells, ScanCells, FillCells, SortCells, FindContacts, ContactForce, BoundBetween]);
}

/// The scene with one of its bodies.
fn alone(body: &str) -> Scene {
    let mut file = discs(0.5, "", "").file;
    file.body.retain(|typed| typed.name == body);
    let formulation = file.body[0].formulation.take();
    file.formulation = formulation.map_or(file.formulation.clone(), |name| file.formulations[&name].clone());
    file.formulations.clear();
    Scene::from_file(file, "alone").unwrap()
}

#[test]
fn groups_that_do_not_touch_move_to_the_bits_of_each_alone() {
    let scene = discs(30.0, "step = 0.1", "");
    let mut both = cpu(&scene);
    steps(&mut both, 150);
    for (k, body) in ["flowing", "bonded"].into_iter().enumerate() {
        let part = discs(30.0, "step = 0.1", "").parts.remove(k);
        let mut own = Cpu::new(part.state::<Plane<f64>>(false));
        steps(&mut own, 150);
        assert!(own.save().unwrap()[0] == both.save().unwrap()[k], "{body}");
    }
}

#[test]
fn all_groups_take_the_shortest_of_their_steps() {
    let scene = discs(30.0, "", "");
    let mut both = cpu(&scene);
    let clock = steps(&mut both, 20);
    let own = |k: usize| {
        let mut own = Cpu::new(scene.parts[k].state::<Plane<f64>>(false));
        steps(&mut own, 20).elapsed
    };
    let each = [own(0), own(1)];
    let shortest = each[0].min(each[1]);
    assert!(each[0].max(each[1]) > 1.1 * shortest, "{each:?}: both groups ask for the same");
    assert!((clock.elapsed / shortest - 1.0).abs() < 1e-9, "{} of {each:?}", clock.elapsed);
}

#[test]
fn a_blow_between_formulations_keeps_momentum_with_every_integrator() {
    for contact in [BARRIER, COLOUR] {
        for integrator in ["leapfrog", "rk2", "ssp_rk3", "rk4"] {
            let scene = discs(if contact == BARRIER { 0.5 } else { 2.0 }, &format!("integrator = \"{integrator}\""), contact);
            let mut cpu = cpu(&scene);
            let (before, size) = momentum(&cpu.members);
            steps(&mut cpu, if contact == BARRIER { 120 } else { 400 });
            let (after, _) = momentum(&cpu.members);
            let own = |k: usize| momentum(&cpu.members[k..=k]).0[0];
            let masses: Vec<f64> = (0..2).map(|k| scene.parts[k].particles.iter().map(|p| p.volume).sum::<f64>()).collect();
            let changed = (own(0) - 0.05 * masses[0]).abs() / size;
            assert!(changed > 0.05, "{integrator}: the discs have not touched: {changed}");
            let drift = largest((0..2).map(|k| after[k] - before[k])) / size;
            println!("{integrator}: {:.0} % of the momentum went over, {drift:.1e} of it was lost", 100.0 * changed);
            assert!(drift < 2e-15, "{integrator}: {drift}");
        }
    }
}

#[test]
fn contact_between_groups_is_that_within_one() {
    // The softening of a viscosity of no strength changes nothing: it parts the bodies all the same.
    let apart = |own: &str| {
        let scene = discs(0.5, "", BARRIER).file;
        let mut file = scene;
        let bonded = file.formulation.clone();
        file.formulations.get_mut("rates").unwrap().clone_from(&bonded);
        file.body[0].material = "neo_hookean".into();
        let viscosity = |softening| Some(Viscosity { alpha: 0.0, beta: None, softening });
        file.formulation.viscosity = viscosity(0.01);
        // The bound of a step knows the contacts between groups apart from each group's own stiffness.
        file.time.step = Some(0.3);
        file.formulations.get_mut("rates").unwrap().viscosity = viscosity(if own == "apart" { 0.02 } else { 0.01 });
        Scene::from_file(file, "discs").unwrap()
    };
    let (one, two) = (apart("together"), apart("apart"));
    assert_eq!((one.parts.len(), two.parts.len()), (0, 2));
    let run = |scene: &Scene| {
        let mut cpu = cpu(scene);
        let clock = steps(&mut cpu, 80);
        (clock.elapsed, in_order(&mut cpu, Field::Displacement), in_order(&mut cpu, Field::ContactEnergy))
    };
    let (one, two) = (run(&one), run(&two));
    let apart = |a: &[f64], b: &[f64]| largest(a.iter().zip(b).map(|(a, b)| a - b)) / largest(a.iter().copied());
    assert!(largest(one.2.iter().copied()) > 1e-6, "nothing touches");
    let errors = [apart(&[one.0], &[two.0]), apart(&one.1, &two.1), apart(&one.2, &two.2)];
    println!("clock, displacement and energy of contact differ by {errors:?}");
    // Sums over contacts run in another order.
    assert!(errors.iter().all(|error| *error < 1e-11), "{errors:?}");
}

#[test]
fn the_gpu_follows_f64_through_a_blow_between_formulations() {
    let Some(adapter) = adapter() else { return };
    let scene = discs(0.5, "", BARRIER);
    let states: Vec<State<Plane<f32>>> = scene.members().map(|member| member.state(true)).collect();
    let (mut cpu, mut gpu) = (cpu(&scene), Gpu::of_members(&adapter, &states).unwrap());
    let clocks = (steps(&mut cpu, 100), steps(&mut gpu, 100));
    assert_eq!((clocks.0.steps_done, clocks.0.lists_built), (clocks.1.steps_done, clocks.1.lists_built));
    for field in [Field::Displacement, Field::Velocity, Field::ContactEnergy] {
        let (wanted, seen) = (in_order(&mut cpu, field), in_order(&mut gpu, field));
        let error = largest(wanted.iter().zip(&seen).map(|(a, b)| a - b)) / largest(wanted.iter().copied());
        println!("{}: {error:.1e}", field.name());
        assert!(error < 2e-5, "{}: {error}", field.name());
    }
    assert!(gpu.save().unwrap().len() == 2, "a checkpoint has both groups");
}

#[test]
fn observables_see_both_groups() {
    let mut text = text_of(30.0, "", "");
    text += "[observe]\nkinetic = { kind = \"kinetic_energy\" }\nspeed = { kind = \"mean_velocity\", body = \"bonded\", axis = \"y\" }\n\
             volume = { kind = \"largest\", field = \"volumetric_strain\" }\n";
    let scene = Scene::parse(&text.replace("duration = 1000.0", "duration = 1.0"), "discs", None, &[]).unwrap();
    let finished = run(&scene, &Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() }).unwrap();
    let mass = |body: u32| scene.particles.iter().filter(|p| p.body == body).map(|p| p.volume).sum::<f64>();
    let kinetic = 0.5 * (mass(0) * 0.05f64.powi(2) + 1.3 * mass(1) * (0.03f64.powi(2) + 0.01f64.powi(2)));
    assert!((finished.table.columns["kinetic"][0] / kinetic - 1.0).abs() < 1e-12);
    assert!((finished.table.columns["speed"][0] - 0.01).abs() < 1e-15);
    assert!(finished.table.columns["volume"].iter().all(|volume| volume.abs() < 1e-12));
}

#[test]
fn a_scene_of_formulations_that_cannot_be_is_refused() {
    let text = text_of(0.5, "", BARRIER);
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from), "{from} is not in\n{text}");
        Scene::parse(&text.replacen(from, to, 1), "test", None, &[]).map(|_| ()).unwrap_err()
    };
    for (from, to, wanted) in [
        ("formulation = \"rates\"", "formulation = \"rate\"", "no [formulation.rate], did you mean `rates`?"),
        ("formulation = \"rates\"\n", "", "no body names [formulation.rates]"),
        ("smoothing_length = 1.4", "smoothing_length = -1.4", "smoothing_length (in spacings) must be a positive number"),
        ("smoothing_length = 1.4", "smothing_length = 1.4", "unknown key `smothing_length`"),
        ("potential = { law = \"barrier\", stiffness = 0.5, range = 1.0 }", "kernel = 0.5", "kernel must be 0"),
        (
            "potential = { law = \"barrier\", stiffness = 0.5, range = 1.0 }",
            "gap = { stiffness = 2, range = 2 }",
            "for bodies of one group",
        ),
        (
            "potential = { law = \"barrier\", stiffness = 0.5, range = 1.0 }",
            "zones = { radius = 2, stiffness = 1e-3 }",
            "zones belong to bodies of one group",
        ),
        ("formulation = \"rates\"", "formulation = \"viscosity\"", "`viscosity` is a key of every formulation"),
        ("name = \"bonded\"", "name = \"bonded\"\nformulation = \"rates\"", "kind of the plain [formulation] would do nothing"),
        ("[time]", "[observe]\nt = { kind = \"mean\", field = \"temperature\" }\n[time]", "this scene has no field temperature"),
        ("[time]", "[quasi_static]\nload_steps = 2\n[time]", "equilibrium is sought for bodies of one formulation"),
        (
            "[time]",
            "[[obstacle]]\nname = \"wall\"\nshape = { plane = { point = [0, -20], normal = [0, 1] } }\n[time]",
            "for an obstacle the bodies that it is `against`",
        ),
    ] {
        let sentence = refused(from, to);
        assert!(sentence.contains(wanted), "{sentence}");
        assert!(sentence.starts_with("test:"), "{sentence}");
    }
}

/// What only sizes lists or adds up energies, or is zero, parts no bodies; nor does a copy of a formulation under another name.
#[test]
fn only_what_changes_the_passes_parts_bodies() {
    let both = |other: &str| {
        let text = text_of(0.5, "", "").replace("kind = \"total_lagrangian\"", "smoothing_length = 1.4\ngradient = \"adjoint\"");
        let text = text.replace("law = \"neo_hookean\"\n", "").replace("viscosity = { alpha = 0.2 }", other);
        Scene::parse(&text, "test", None, &[])
    };
    for other in [
        "",
        "xsph = 0",
        "list_margin = 0.3",
        "list_capacity = 99",
        "internal_energy = true",
        "viscosity = { alpha = 3, beta = 0 }",
    ] {
        let scene = both(other).unwrap();
        assert!(scene.parts.is_empty(), "{other}");
        assert_eq!(scene.method.body_options, other.starts_with("viscosity"), "{other}");
        assert_eq!(scene.method.internal_energy, other.starts_with("internal"), "{other}");
        assert!(scene.coupling.iter().flatten().all(|&weight| weight == 1.0), "{other}");
    }
    for other in ["xsph = 0.1", "smoothing = \"wendland\"", "density = \"summation\""] {
        let sentence = both(other).map(|_| ()).unwrap_err();
        let key = other.split(' ').next().unwrap();
        assert!(sentence.contains(&format!("their formulations differ in {key}: name a [[contact]]")), "{sentence}");
    }
}

/// A body that yields lowers the hourglass strength of its group, also where the others name a copy of the formulation.
#[test]
fn a_copy_of_a_formulation_changes_nothing() {
    let hourglass = |name: &str| {
        let text = text_of(30.0, "", "")
            .replace("formulation = \"rates\"", name)
            .replace("material = \"rubber\"", "material = \"metal\"");
        let text = text.replace(
            "[formulation.rates]\nsmoothing_length = 1.4\ngradient = \"adjoint\"\nviscosity = { alpha = 0.2 }",
            if name.is_empty() { "" } else { "[formulation.copy]\nkind = \"total_lagrangian\"" },
        );
        let text = text.replace("[material.rubber]", "[material.metal]\nlaw = \"j2\"\nyield_stress = 0.1");
        let scene = parse(&text);
        assert!(scene.parts.is_empty());
        scene.bodies.iter().map(|body| body.options.hourglass).collect::<Vec<_>>()
    };
    assert_eq!(hourglass(""), [0.1, 0.1]);
    assert_eq!(hourglass("formulation = \"copy\""), [0.1, 0.1]);
}

/// Contact is as stiff as the softer body, a fluid by its bulk.
#[test]
fn a_fluid_is_kept_out_of_a_solid() {
    let text = text_of(1.5, "", BARRIER).replace(
        "[material.rubber]\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3",
        "[material.rubber]\nlaw = \"fluid\"\ndensity = 1.0\nbulk_modulus = 0.5",
    );
    let scene = parse(&text);
    assert!(scene.contacts[0][1].strength > 0.2 && scene.contacts[0][1].strength < 0.3, "{:?}", scene.contacts[0][1]);
    let mut cpu = cpu(&scene);
    steps(&mut cpu, 600);
    let speed = |k: usize| {
        let velocity = &cpu.members[k].columns.velocity;
        velocity.iter().map(|v| v[0]).sum::<f64>() / velocity.len() as f64
    };
    assert!(speed(0) < 0.03 && speed(1) > -0.015, "the drop goes through: {} {}", speed(0), speed(1));
}

#[test]
fn what_a_group_lacks_is_no_number() {
    let text =
        text_of(30.0, "", "").replace("viscosity = { alpha = 0.2 }", "viscosity = { alpha = 0.2 }\ninternal_energy = true");
    let with = |observe: &str| Scene::parse(&format!("{text}[observe]\n{observe}\n"), "discs", None, &["duration=1".into()]);
    let refused = |observe: &str| with(observe).map(|_| ()).unwrap_err();
    let sentence = refused("e = { kind = \"mean\", field = \"internal_energy\" }");
    assert!(sentence.contains("which the group of the body `bonded` lacks"), "{sentence}");
    let sentence = refused("e = { kind = \"internal_energy\" }");
    assert!(sentence.contains("which the group of the body `bonded` lacks"), "{sentence}");
    let scene = with("e = { kind = \"mean\", field = \"internal_energy\", body = \"flowing\" }\np = { kind = \"probe\", field = \"internal_energy\", at = [6, -2] }").unwrap();
    let finished = run(&scene, &Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() }).unwrap();
    assert!(finished.table.columns["e"].iter().all(|e| e.is_finite()));
    assert!(finished.table.columns["p"].iter().all(|p| p.is_nan()), "the bonded disc has no internal energy of its own");
}
