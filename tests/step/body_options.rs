//! Bodies whose viscosity, artificial stress or hourglass strength differ.

use crate::common::{in_order, largest, parse, steps};
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::fields::Field;
use lithosph::rows::BodyOptions;
use lithosph::scene::Scene;
use lithosph::tensor::Plane;

const STEPS: u32 = 60;

/// Formulations, in each of which some of the numbers act; with the law of the bodies.
const EULERIAN: [[&str; 2]; 2] = [
    [
        "viscosity = { alpha = 0.5, softening = 0.01 }\ndissipated_energy = true\ninternal_energy = true
        artificial_stress = { epsilon = 0.3 }",
        "",
    ],
    [
        "gradient = \"adjoint\"\nviscosity = { alpha = 0.5, beta = 0.3 }
        artificial_stress = { form = \"scalar\", epsilon = 0.2 }",
        "",
    ],
];
const LAGRANGIAN: [[&str; 2]; 2] = [
    ["kind = \"total_lagrangian\"\nviscosity = { alpha = 0.5 }\ndissipated_energy = true", "law = \"neo_hookean\""],
    ["kind = \"total_lagrangian\"\nviscosity = { alpha = 0.5 }", "law = \"j2\"\nyield_stress = 0.01"],
];

const LEFT: BodyOptions<f64> = BodyOptions { alpha: 0.2, beta: 1.3, artificial_epsilon: 0.1, hourglass: 0.1 };
const RIGHT: BodyOptions<f64> = BodyOptions { alpha: 1.5, beta: 0.4, artificial_epsilon: 0.7, hourglass: 0.6 };

/// Two discs, `gap` apart, that meet; a blow to one particle of each stretches and compresses what is around it.
fn discs([formulation, law]: [&str; 2], gap: f64) -> Scene {
    let disc = |name: &str, side: f64| {
        let center = side * (6.0 + 0.5 * gap);
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ disc = {{ center = [{center}, 0], radius = 6.2 }} }}\n\
             anchor = [{center}, 0]\nmaterial = \"rubber\"\nvelocity = [{}, 0]\n\
             [[kick]]\nat = [{center}, 3]\nvelocity = [0.05, {}]\n",
            -0.05 * side,
            0.1 * side
        )
    };
    parse(&format!(
        "title = \"discs\"\ndimension = 2\nspacing = 1\nduration = 100\n{}{}\
         [material.rubber]\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.3\n{law}\n\
         [formulation]\nsmoothing_length = 1.4\n{formulation}\n[time]\nstep = 0.1\n",
        disc("left", -1.0),
        disc("right", 1.0)
    ))
}

fn with(mut scene: Scene, options: [BodyOptions<f64>; 2]) -> Scene {
    for (body, options) in scene.bodies.iter_mut().zip(options) {
        body.options = options;
    }
    scene.method.body_options = true;
    scene
}

/// The scene after some steps. Where bodies differ, the numbers of the run are no numbers: nothing may read them.
fn stepped(scene: &Scene) -> Cpu<Plane<f64>> {
    let mut state = scene.state::<Plane<f64>>(false);
    assert_eq!(state.body_options.len(), if scene.method.body_options { 2 } else { 0 });
    if scene.method.body_options {
        let params = &mut state.params;
        for number in [&mut params.alpha, &mut params.beta, &mut params.artificial_epsilon, &mut params.hourglass] {
            *number = f64::NAN;
        }
    }
    let mut cpu = Cpu::new(state);
    assert_eq!(steps(&mut cpu, STEPS).steps_done, STEPS);
    cpu
}

fn bits(cpu: &mut Cpu<Plane<f64>>, field: Field) -> Vec<u64> {
    in_order(cpu, field).into_iter().map(f64::to_bits).collect()
}

#[test]
fn no_body_of_a_scene_differs_and_a_run_has_no_table_for_it() {
    for formulation in EULERIAN.into_iter().chain(LAGRANGIAN) {
        let scene = discs(formulation, 1.0);
        assert!(!scene.method.body_options && !scene.method.flags().contains(&"body_options"));
        let [left, right] = &scene.bodies[..] else { panic!("two bodies") };
        assert_eq!(left.options, right.options);
        let state = scene.state::<Plane<f64>>(false);
        let BodyOptions { alpha, beta, artificial_epsilon, hourglass } = left.options;
        let params = &state.params;
        let of_run = [params.alpha, params.beta, params.artificial_epsilon, params.hourglass];
        assert_eq!(of_run, [alpha, beta, artificial_epsilon, hourglass]);
        assert!(state.body_options.is_empty());
    }
    let options = |formulation: [&str; 2]| discs(formulation, 1.0).bodies[0].options;
    assert_eq!(options(EULERIAN[0]), BodyOptions { alpha: 0.5, beta: 1.0, artificial_epsilon: 0.3, hourglass: 0.0 });
    assert_eq!(options(LAGRANGIAN[0]), BodyOptions { alpha: 0.5, beta: 1.0, artificial_epsilon: 0.0, hourglass: 0.5 });
    assert_eq!(options(["", ""]), BodyOptions::default());
}

#[test]
fn bodies_that_have_the_same_numbers_move_as_if_the_run_had_them_bit_by_bit() {
    for formulation in EULERIAN.into_iter().chain(LAGRANGIAN) {
        let plain = discs(formulation, 1.0);
        let own = plain.bodies[0].options;
        let (mut plain, mut same) = (stepped(&plain), stepped(&with(discs(formulation, 1.0), [own, own])));
        assert!(plain.save().unwrap() == same.save().unwrap(), "{formulation:?}");
    }
}

/// Bodies out of each other's reach, with a fixed step, and lists so long that they hold: otherwise the motion of one body would
/// decide when the list of the other is made anew, and so in which order its sums run.
#[test]
fn each_body_moves_by_its_own_numbers_bit_by_bit() {
    for formulation in EULERIAN.into_iter().chain(LAGRANGIAN) {
        let longer = if formulation[1].is_empty() { "\nlist_margin = 1" } else { "" };
        let lines = format!("{}{longer}", formulation[0]);
        let moved = |options| {
            let cpu = stepped(&with(discs([&lines, formulation[1]], 20.0), options));
            assert_eq!(cpu.members[0].clock.lists_built, 1);
            cpu
        };
        let [mut both, mut left, mut right] = [[LEFT, RIGHT], [LEFT, LEFT], [RIGHT, RIGHT]].map(moved);
        for field in [Field::Displacement, Field::Velocity] {
            let [both, left, right] = [&mut both, &mut left, &mut right].map(|cpu| bits(cpu, field));
            let half = both.len() / 2;
            assert!(both[..half] == left[..half] && both[half..] == right[half..], "{formulation:?}");
            assert!(left[..half] != right[..half] && left[half..] != right[half..], "{formulation:?}");
        }
    }
}

/// The pairs of two bodies have the mean of their numbers.
#[test]
fn momentum_is_kept_between_bodies_that_differ() {
    for formulation in EULERIAN {
        let scene = with(discs(formulation, 1.0), [LEFT, RIGHT]);
        let (mut own, mut alike) = (stepped(&scene), stepped(&with(discs(formulation, 1.0), [RIGHT, RIGHT])));
        let (own, alike) = (in_order(&mut own, Field::Velocity), in_order(&mut alike, Field::Velocity));
        let difference = largest(own.iter().zip(&alike).map(|(a, b)| a - b));
        assert!(difference > 1e-3, "the bodies' numbers change velocities only by {difference:e}");
        let (mut change, mut scale) = ([0.0; 2], 0.0);
        for (i, particle) in scene.particles.iter().enumerate() {
            for k in 0..2 {
                change[k] += scene.mass(i) * (own[2 * i + k] - particle.velocity[k]);
            }
            scale += scene.mass(i) * particle.velocity.length();
        }
        let drift = largest(change) / scale;
        println!("momentum drifts by {drift:e}");
        assert!(drift < 1e-15, "momentum drifts by {drift:e}");
    }
}
