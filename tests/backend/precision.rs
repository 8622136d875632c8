//! The digits that f32 keeps because positions are sums of a reference and a displacement, and because sums are
//! compensated; each beside the plain way of doing it, which is shown to fail.

use crate::common::{adapter, in_order, parse, steps};
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::backend::gpu::Gpu;
use lithosph::fields::Field;
use lithosph::scene::Scene;
use lithosph::state::State;
use lithosph::tensor::{Plane, Tuple};

/// The twin in f32, and the GPU where there is one.
fn backends(state: &State<Plane<f32>>) -> Vec<(&'static str, Box<dyn Backend>)> {
    let mut list: Vec<(_, Box<dyn Backend>)> = vec![("twin", Box::new(Cpu::new(state.clone())))];
    if let Some(adapter) = adapter() {
        list.push(("gpu", Box::new(Gpu::new(&adapter, state).unwrap())));
    }
    list
}

const LENGTH: usize = 1000;
const STRAIN: f64 = 1e-5;
const STRETCHES: u32 = 100;

/// A strip 1000 spacings long that stretches along x by [`STRAIN`] in a time of 1; so soft that its own stress
/// moves nothing in that time.
fn strip() -> Scene {
    parse(&format!(
        "title = \"stretched strip\"
dimension = 2
spacing = 1.0
duration = 1.0
[[body]]
name = \"strip\"
shape = {{ block = {{ min = [0, 0], max = [{LENGTH}, 8] }} }}
anchor = [0.5, 0.5]
material = \"jelly\"
motion = {{ gradient = [[{STRAIN:e}, 0], [0, 0]] }}
[material.jelly]
density = 1.0
bulk_modulus = 1e-8
shear_modulus = 1e-8
[formulation]
gradient = \"corrected\"
[time]
step = {:e}
",
        1.0 / f64::from(STRETCHES)
    ))
}

/// Strain of each bond along x, next neighbours in the same row, from the particles' positions less their spacing.
fn bond_errors(stretch: impl Fn(usize, usize) -> f64, scene: &Scene) -> f64 {
    let position = |i: usize| scene.particles[i].position;
    let bonds = (1..scene.particles.len()).filter(|&i| (position(i) - position(i - 1)).abs_diff_eq(glam::DVec3::X, 1e-9));
    let errors: Vec<f64> = bonds.map(|i| (stretch(i - 1, i) / STRAIN - 1.0).abs()).collect();
    assert_eq!(errors.len(), 8 * (LENGTH - 1));
    errors.into_iter().fold(0.0, f64::max)
}

#[test]
fn small_strains_far_from_the_origin_keep_their_digits() {
    let scene = strip();
    for (name, mut backend) in backends(&scene.state::<Plane<f32>>(true)) {
        steps(backend.as_mut(), STRETCHES);
        let displacement = in_order(backend.as_mut(), Field::Displacement);
        let bond = bond_errors(|a, b| displacement[2 * b] - displacement[2 * a], &scene);
        // 2 mu (strain - strain/3)
        let stress = in_order(backend.as_mut(), Field::DeviatoricStress);
        let wanted = 2e-8 * STRAIN * 2.0 / 3.0;
        let error = stress.chunks(3).map(|s| (s[0] / wanted - 1.0).abs()).fold(0.0, f64::max);
        let volume = in_order(backend.as_mut(), Field::VolumetricStrain);
        let volume_error = volume.iter().map(|e| (e / STRAIN - 1.0).abs()).fold(0.0, f64::max);
        println!("{name}: errors of strain {bond:.1e}, stress {error:.1e}, volumetric strain {volume_error:.1e}");
        assert!(bond < 1e-3 && error < 1e-3 && volume_error < 1e-3, "{name}: {bond} {error} {volume_error}");
    }
    // The same motion of absolute positions.
    let start: Vec<f32> = scene.particles.iter().map(|p| p.position.x as f32).collect();
    let mut moved = start.clone();
    for _ in 0..STRETCHES {
        for (x, x0) in moved.iter_mut().zip(&start) {
            *x += (STRAIN as f32 * x0) * (1.0 / STRETCHES as f32);
        }
    }
    let absolute = bond_errors(|a, b| f64::from(moved[b] - moved[a]) - 1.0, &scene);
    println!("absolute positions: error of strain {absolute:.1e}");
    assert!(absolute > 0.1, "{absolute}");
}

const PLACE: f32 = 0.7;
const SPEED: f64 = 0.01;
const STEP: f64 = 1e-7;
const STEPS: u32 = 10_000;

fn block() -> Scene {
    parse(&format!(
        "title = \"drifting block\"
dimension = 2
spacing = 0.01
duration = 1.0
[[body]]
name = \"block\"
shape = {{ block = {{ min = [0, 0], max = [0.04, 0.04] }} }}
anchor = [0.005, 0.005]
material = \"rubber\"
velocity = [{SPEED}, 0]
[material.rubber]
density = 1000
youngs_modulus = 1e7
poisson_ratio = 0.3
[time]
step = {STEP:e}
"
    ))
}

#[test]
fn steps_below_the_last_digit_add_up() {
    let mut state = block().state::<Plane<f32>>(true);
    // Far along already: the displacement itself, not the reference, is large.
    state.columns.displacement.iter_mut().for_each(|u| *u = Tuple([PLACE, PLACE]));
    // As f32 holds the numbers.
    let wanted = f64::from(STEPS) * f64::from(STEP as f32) * f64::from(SPEED as f32);
    for (name, mut backend) in backends(&state) {
        let clock = steps(backend.as_mut(), STEPS);
        assert!((clock.elapsed / (f64::from(STEPS) * STEP) - 1.0).abs() < 1e-6);
        let displacement = in_order(backend.as_mut(), Field::Displacement);
        let carry = in_order(backend.as_mut(), Field::DisplacementCarry);
        let along = displacement.chunks(2).zip(carry.chunks(2)).map(|(u, c)| (u[0] - f64::from(PLACE)) - c[0]);
        let error = along.map(|moved| (moved / wanted - 1.0).abs()).fold(0.0, f64::max);
        println!("{name}: error {error:.1e} of what the block moved");
        assert!(error < 1e-5, "{name}: {error}");
        // What a reader of the displacement alone sees is right to the last digit.
        let rounding = f64::from(f32::EPSILON) * f64::from(PLACE);
        assert!(displacement.chunks(2).all(|u| (u[0] - f64::from(PLACE) - wanted).abs() < rounding));
    }
    let mut plain = PLACE;
    for _ in 0..2 * STEPS {
        plain += (0.5 * STEP * SPEED) as f32;
    }
    assert_eq!(plain, PLACE, "a plain sum should not move at all");
}
