//! What the discrete Total Lagrangian operators must do exactly.

use crate::common::{Random, in_order, largest, parse, steps};
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::fields::Field;
use lithosph::material::stored_energy;
use lithosph::pass::{Call, Pass, Stage};
use lithosph::scene::Scene;
use lithosph::state::State;
use lithosph::step;
use lithosph::tensor::{Line, Plane, Real, Solid, Space};

/// One body; in space a block on a lattice, in the plane a disc cut to its edge, so that nothing is regular.
fn body(dimension: usize, formulation: &str) -> Scene {
    let shape = match dimension {
        1 => "{ block = { min = [0], max = [20] } }",
        2 => "{ disc = { center = [0, 0], radius = 5.3 } }",
        _ => "{ block = { min = [0, 0, 0], max = [6, 5, 4] } }",
    };
    let packing = if dimension == 2 { "fitted" } else { "square" };
    let anchor = format!("{:?}", vec![0.5; dimension]);
    parse(&format!(
        "title = 'body'\ndimension = {dimension}\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'body'\nshape = {shape}\npacking = '{packing}'\nanchor = {anchor}\nmaterial = 'rubber'
        [material.rubber]\nlaw = 'neo_hookean'\ndensity = 1.7\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
        [formulation]\nkind = 'total_lagrangian'\nsmoothing_length = 1.4\n{formulation}"
    ))
}

/// A backend whose list is made and whose clock runs.
pub fn begun<S: Space>(scene: &Scene) -> Cpu<S> {
    let mut cpu = Cpu::new(scene.state::<S>(false));
    cpu.begin_segment(0.0, 1e9, 1000, true).unwrap();
    cpu
}

fn run(state: &mut State<impl Space>, calls: &[Call]) {
    for call in calls {
        call.pass.run(state, call.stage);
    }
}

/// The force's own passes, without those that only bound the step.
pub fn respond<S: Space>(state: &mut State<S>) {
    run(state, &step::begin_run(&state.method.clone()));
}

fn displace<S: Space<Real: Real>>(state: &mut State<S>, of: impl Fn(usize, [f64; 3]) -> [f64; 3]) {
    for a in 0..state.params.count as usize {
        let x = S::vec_to(state.columns.reference_position[a]);
        state.columns.displacement[a] = S::vec_from(of(a, x));
    }
}

fn scatter(count: usize, strength: f64) -> Vec<[f64; 3]> {
    let mut random = Random(7);
    (0..count).map(|_| std::array::from_fn(|_| strength * random.signed())).collect()
}

/// Energy of material, hourglass terms and contacts.
pub fn energy<S: Space<Real = f64>>(state: &mut State<S>) -> f64 {
    respond(state);
    if state.method.hourglass {
        Pass::HourglassEnergy.run(state, Stage::default());
    }
    let columns = &state.columns;
    (0..state.params.count as usize)
        .map(|a| {
            let stored = stored_energy::<S>(state.body(a), columns.displacement_gradient[a], S::Sym::default());
            let stray = [&columns.hourglass_energy, &columns.contact_energy].map(|column| column.get(a).copied().unwrap_or(0.0));
            stored * columns.reference_volume[a] + stray[0] + stray[1]
        })
        .sum()
}

pub fn assert_force_is_the_gradient_of_the_energy<S: Space<Real = f64>>(scene: &Scene) {
    let mut cpu = begun::<S>(scene);
    let state = &mut cpu.members[0];
    let count = state.params.count as usize;
    // Where a body has flowed, and now does not, its hourglass energy varies from particle to particle.
    let mut random = Random(5);
    state.columns.equivalent_plastic_strain.iter_mut().for_each(|k| *k = random.unit());
    let noise = scatter(count, 0.08);
    displace(state, |a, x| std::array::from_fn(|k| noise[a][k] + 0.05 * x[(k + 1) % S::DIMENSION]));
    respond(state);
    let forces: Vec<[f64; 3]> = (0..count).map(|a| S::vec_to(state.columns.acceleration[a]).map(|x| x * state.mass(a))).collect();
    let strongest = largest(forces.iter().flatten().copied());
    let mut random = Random(11);
    for _ in 0..12 {
        let (a, k, small) = (random.below(count), random.below(S::DIMENSION), 1e-5);
        let mut at = |shift: f64| {
            state.columns.displacement[a][k] += shift;
            let energy = energy(state);
            state.columns.displacement[a][k] -= shift;
            energy
        };
        let slope = (at(small) - at(-small)) / (2.0 * small);
        assert!((forces[a][k] + slope).abs() < 1e-7 * strongest, "{} against {}", forces[a][k], -slope);
    }
}

#[test]
fn the_force_is_minus_the_gradient_of_the_energy() {
    for formulation in [
        "",
        "hourglass = 0",
        "gradient = 'quadratic'\nhourglass = 0.2",
        "gradient = 'plain'\nhourglass = 0",
        "bond_table = false",
    ] {
        assert_force_is_the_gradient_of_the_energy::<Line<f64>>(&body(1, formulation));
        assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&body(2, formulation));
        assert_force_is_the_gradient_of_the_energy::<Solid<f64>>(&body(3, formulation));
    }
    // The strains are of a tenth.
    let strong = |dimension| {
        let law = "law = \"j2\"\nyield_stress = 3.0\nhardening = { linear = 1.0 }";
        let scene = parse(&body(dimension, "hourglass = 0.5").text.replace("law = \"neo_hookean\"", law));
        assert!(scene.method.plastic());
        scene
    };
    assert_force_is_the_gradient_of_the_energy::<Line<f64>>(&strong(1));
    assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&strong(2));
    assert_force_is_the_gradient_of_the_energy::<Solid<f64>>(&strong(3));
}

/// Two blocks a gap apart that is less than the range of their contact.
fn pair_of_blocks(law: &str) -> Scene {
    parse(&format!(
        "title = 'blocks'\ndimension = 2\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'left'\nshape = {{ block = {{ min = [0, 0], max = [5, 5] }} }}\nanchor = [0.5, 0.5]\nmaterial = 'rubber'
        [[body]]\nname = 'right'\nshape = {{ block = {{ min = [5.1, 0.3], max = [9.1, 5.3] }} }}\nanchor = [5.6, 0.8]\nmaterial = 'rubber'
        [[contact]]\nbetween = ['left', 'right']\npotential = {{ law = '{law}', stiffness = 0.5, range = 1.6 }}
        [material.rubber]\nlaw = 'st_venant_kirchhoff'\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
        [formulation]\nkind = 'total_lagrangian'"
    ))
}

#[test]
fn contact_forces_are_minus_the_gradient_of_the_energy_of_bodies_that_touch() {
    for law in ["barrier", "power", "quadratic", "repulsive"] {
        let scene = pair_of_blocks(law);
        assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&scene);
        let mut state = begun::<Plane<f64>>(&scene).into_state();
        respond(&mut state);
        assert!(state.columns.contact_energy.iter().sum::<f64>() > 1e-5);
    }
}

pub fn assert_momenta_stay<S: Space<Real = f64>>(scene: &Scene) {
    let (force, moment) = resultants::<S>(scene);
    assert!(force < 1e-13 && moment < 1e-12, "{force:e} {moment:e}");
}

/// Sum of the forces and of their moments of displaced bodies, over the sum of |f||x|.
pub fn resultants<S: Space<Real = f64>>(scene: &Scene) -> (f64, f64) {
    let mut state = begun::<S>(scene).into_state();
    let noise = scatter(state.params.count as usize, 0.1);
    displace(&mut state, |a, _| noise[a]);
    respond(&mut state);
    let (mut force, mut moment, mut scale) = (glam::DVec3::ZERO, glam::DVec3::ZERO, 0.0);
    for a in 0..state.params.count as usize {
        let f = glam::DVec3::from_array(S::vec_to(state.columns.acceleration[a])) * state.mass(a);
        let x = glam::DVec3::from_array(S::vec_to(state.position(a)));
        (force, moment, scale) = (force + f, moment + x.cross(f), scale + f.length() * x.length());
    }
    (force.length() / scale, moment.length() / scale)
}

#[test]
fn inner_forces_and_contacts_have_no_resultant_and_no_moment() {
    assert_momenta_stay::<Plane<f64>>(&body(2, ""));
    assert_momenta_stay::<Solid<f64>>(&body(3, ""));
    assert_momenta_stay::<Plane<f64>>(&body(2, "gradient = 'quadratic'"));
    assert_momenta_stay::<Plane<f64>>(&pair_of_blocks("barrier"));
}

#[test]
fn the_gradient_is_exact_for_linear_and_the_quadratic_one_for_quadratic_fields() {
    let field = |x: [f64; 3]| [0.1 * x[0] - 0.2 * x[1], 0.05 * x[0] + 0.15 * x[1], 0.0];
    let mut state = begun::<Plane<f64>>(&body(2, "")).into_state();
    displace(&mut state, |_, x| field(x));
    respond(&mut state);
    for h in &state.columns.displacement_gradient {
        assert!(largest([h[0] - 0.1, h[1] - 0.05, h[2] + 0.2, h[3] - 0.15]) < 1e-10, "{h:?}");
    }
    let mut state = begun::<Plane<f64>>(&body(2, "gradient = 'quadratic'")).into_state();
    displace(&mut state, |_, x| [0.01 * x[0] * x[1], 0.02 * x[1] * x[1] - 0.01 * x[0] * x[0], 0.0]);
    respond(&mut state);
    for (h, x) in state.columns.displacement_gradient.iter().zip(&state.columns.reference_position) {
        let exact = [0.01 * x[1], -0.02 * x[0], 0.01 * x[0], 0.04 * x[1]];
        assert!(largest((0..4).map(|k| h[k] - exact[k])) < 1e-9, "{h:?} at {x:?}");
    }
}

/// Largest acceleration of the particles far from any surface, over stress/(density spacing).
fn residual<S: Space>(scene: &Scene, stretch: f64) -> f64 {
    let mut state = begun::<S>(scene).into_state();
    displace(&mut state, |_, x| x.map(|x| stretch * x));
    respond(&mut state);
    let inside =
        |a: &usize| S::vec_to(state.columns.reference_position[*a])[..S::DIMENSION].iter().all(|x| (6.0..14.0).contains(x));
    let rows: Vec<usize> = (0..state.params.count as usize).filter(inside).collect();
    assert!(rows.len() > 20);
    largest(rows.into_iter().flat_map(|a| S::vec_to(state.columns.acceleration[a]))) / stretch
}

#[test]
fn constant_stress_pulls_at_no_particle_inside_a_lattice() {
    for (dimension, top) in [(2, "[20, 20]"), (3, "[20, 20, 20]")] {
        let zero = format!("{:?}", vec![0; dimension]);
        let anchor = format!("{:?}", vec![0.5; dimension]);
        let scene = parse(&format!(
            "title = 'block'\ndimension = {dimension}\nspacing = 1.0\nduration = 1.0
            [[body]]\nname = 'block'\nshape = {{ block = {{ min = {zero}, max = {top} }} }}\nanchor = {anchor}\nmaterial = 'rubber'
            [material.rubber]\nlaw = 'neo_hookean'\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
            [formulation]\nkind = 'total_lagrangian'"
        ));
        let (double, single) = match dimension {
            2 => (residual::<Plane<f64>>(&scene, 1e-2), residual::<Plane<f32>>(&scene, 1e-2)),
            _ => (residual::<Solid<f64>>(&scene, 1e-2), residual::<Solid<f32>>(&scene, 1e-2)),
        };
        assert!(double < 1e-12 && single < 1e-5, "{dimension}D: {double:e} in f64, {single:e} in f32");
    }
}

#[test]
fn a_rotation_makes_no_stress() {
    let (sine, cosine) = 0.8f64.sin_cos();
    for formulation in ["", "gradient = 'quadratic'"] {
        let mut state = begun::<Plane<f64>>(&body(2, formulation)).into_state();
        displace(&mut state, |_, x| [(cosine - 1.0) * x[0] - sine * x[1], sine * x[0] + (cosine - 1.0) * x[1], 0.0]);
        respond(&mut state);
        let worst = largest(state.columns.acceleration.iter().flat_map(|a| [a[0], a[1]]));
        assert!(worst < 1e-10, "{worst:e}");
    }
}

#[test]
fn the_table_of_bonds_gives_the_forces_of_the_list() {
    let accelerations = |formulation: &str| {
        let mut state = begun::<Plane<f64>>(&body(2, formulation)).into_state();
        assert_eq!(state.bond_table.rows.is_empty(), formulation.contains("false"));
        let noise = scatter(state.params.count as usize, 0.05);
        displace(&mut state, |a, _| noise[a]);
        respond(&mut state);
        state.columns.acceleration
    };
    let (table, listed) = (accelerations(""), accelerations("bond_table = false"));
    let worst = largest(table.iter().zip(&listed).flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]]));
    assert!(worst < 1e-9, "{worst:e}");
}

/// A bar of 200 spacings in which a wave of strain 1e-5 runs.
#[test]
fn single_precision_keeps_displacement_and_stress_at_small_strain() {
    let scene = parse(
        "title = 'bar'\ndimension = 2\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'bar'\nshape = { block = { min = [0, 0], max = [200, 8] } }\nanchor = [0.5, 0.5]\nmaterial = 'rubber'
        motion = { wave = { amplitude = [1.16e-5, 0], wave_vector = [0.031415926535, 0] } }
        [material.rubber]\nlaw = 'neo_hookean'\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
        [formulation]\nkind = 'total_lagrangian'\n[time]\nstep = 0.4",
    );
    let mut double = Cpu::new(scene.state::<Plane<f64>>(false));
    let mut single = Cpu::new(scene.state::<Plane<f32>>(true));
    steps(&mut double, 120);
    steps(&mut single, 120);
    let mut compare = |field: Field| {
        let (truth, seen) = (in_order(&mut double, field), in_order(&mut single, field));
        let worst = largest(truth.iter().zip(&seen).map(|(a, b)| a - b));
        (worst, largest(truth))
    };
    let (displacement, _) = compare(Field::Displacement);
    assert!(displacement < 1e-6 * 200.0, "{displacement:e}");
    let (strain, most) = compare(Field::DisplacementGradient);
    assert!(most > 3e-6 && strain < 1e-5 * most, "{strain:e} of {most:e}");
}
