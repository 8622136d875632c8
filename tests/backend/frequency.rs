//! What bounds the time step of a Total Lagrangian body, against steps that it must and must not bear, and against the
//! frequencies of deformed bodies.

use crate::common::parse;
use lithosph::backend::frequency::{about, frequencies};
use lithosph::backend::{Choice, open};
use lithosph::fields::Field;
use lithosph::material;
use lithosph::pass::{Pass, Stage};
use lithosph::scene::Scene;
use lithosph::state::State;
use lithosph::tensor::{Plane, Solid, Space};

fn block(dimension: usize, law: &str, formulation: &str, more: &str) -> Scene {
    let shape = if dimension == 2 { "min = [0, 0], max = [12, 7]" } else { "min = [0, 0, 0], max = [6, 5, 4]" };
    parse(&format!(
        "title = 'a block'\ndimension = {dimension}\nunits = 'dimensionless'\nspacing = 1.0\nduration = 300.0\n{more}
        [[body]]\nname = 'block'\nshape = {{ block = {{ {shape} }} }}\npacking = 'fitted'\nmaterial = 'medium'
        [material.medium]\n{law}\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
        [formulation]\nkind = 'total_lagrangian'\n{formulation}"
    ))
}

/// Growth of the largest speed over a run of a block whose particles are all kicked apart, at a step times the highest
/// frequency.
fn growth(formulation: &str, omega_step: f64) -> f64 {
    let law = "law = 'st_venant_kirchhoff'";
    let highest = frequencies(&mut block(2, law, formulation, "").state::<Plane<f64>>(false))[0];
    let step = format!("[time]\nstep = {}", omega_step / highest);
    let mut scene = block(2, law, formulation, &step);
    for (k, particle) in scene.particles.iter_mut().enumerate() {
        particle.velocity.x = 1e-9 * [1.0, -1.0][(k / 7 + k) % 2];
        particle.velocity.y = 1e-9 * [1.0, 0.3, -1.0][k % 3];
    }
    let mut backend = open(&scene, &Choice::Cpu).unwrap();
    let mut speed = |duration: f64, first: bool| {
        backend.begin_segment(0.0, duration, u32::MAX, first).unwrap();
        while backend.advance().unwrap().running == 1 {}
        backend.fetch(&[Field::Velocity]).unwrap()[&Field::Velocity].iter().fold(0.0f64, |most, v| most.max(v.abs()))
    };
    let start = speed(0.0, true);
    speed(300.0, false) / start
}

#[test]
fn a_step_of_two_over_the_frequency_is_the_longest_that_a_free_body_bears() {
    for formulation in
        ["", "smoothing_length = 1.3\nhourglass = 0.2", "gradient = 'quadratic'\nsmoothing_length = 1.6\nhourglass = 0.1"]
    {
        let (below, above) = (growth(formulation, 1.96), growth(formulation, 2.03));
        assert!(below < 30.0 && above > 1e3, "{formulation}: grows {below} below the limit and {above} above");
    }
}

/// Highest frequency of a block in a uniform deformation, and the bound from that at rest.
fn bounded<S: Space<Real = f64>>(scene: &Scene, gradient: [[f64; 3]; 3]) -> (f64, f64) {
    let mut state: State<S> = scene.state(false);
    let at_rest = frequencies(&mut state)[0];
    for a in 0..state.columns.displacement.len() {
        let x = state.columns.reference_position[a];
        let mut u = [0.0; 3];
        for i in 0..S::DIMENSION {
            u[i] = (0..S::DIMENSION).map(|j| gradient[i][j] * x[j]).sum();
        }
        state.columns.displacement[a] = S::vec_from(u);
    }
    let found = about(&mut state)[0];
    Pass::Deform.run(&mut state, Stage::default());
    let stiffening = |a: usize| material::stiffening::<S>(state.body(a), state.columns.displacement_gradient[a]).max(1.0);
    let most = (0..state.columns.displacement.len()).map(stiffening).fold(1.0, f64::max);
    (found, at_rest * most.sqrt())
}

#[test]
fn the_frequency_of_a_deformed_body_is_bounded() {
    let squeezed = [[-0.4, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    let sheared = [[0.0, 0.5, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
    let dense = [[-0.25, 0.0, 0.0], [0.0, -0.25, 0.0], [0.0, 0.0, -0.25]];
    let turned = [[-0.5, -0.6, 0.0], [0.9, -0.3, 0.0], [0.0, 0.0, 0.0]];
    let stretched = [[0.8, 0.0, 0.0], [0.0, -0.2, 0.0], [0.0, 0.0, -0.1]];
    let hard = "pressure = 'linear'\nstrength = { j2 = { yield_stress = 100.0 } }";
    let cases = [
        ("law = 'neo_hookean'", squeezed),
        ("law = 'neo_hookean'", sheared),
        ("law = 'neo_hookean'", dense),
        ("law = 'neo_hookean'", stretched),
        ("law = 'st_venant_kirchhoff'", stretched),
        ("law = 'st_venant_kirchhoff'", turned),
        ("law = 'maxwell'\nviscosity = 1e6", squeezed),
        (hard, squeezed),
        (hard, dense),
    ];
    for (law, gradient) in cases {
        let (in_plane, bound) = bounded::<Plane<f64>>(&block(2, law, "hourglass = 0.1", ""), gradient);
        let ratio = bound / in_plane;
        println!("{law} {gradient:?} in the plane: {ratio}");
        assert!((1.0..1.6).contains(&ratio), "{law} {gradient:?} in the plane: {ratio}");
        let (in_space, bound) = bounded::<Solid<f64>>(&block(3, law, "hourglass = 0.1", ""), gradient);
        let ratio = bound / in_space;
        println!("{law} {gradient:?} in space: {ratio}");
        assert!((1.0..1.6).contains(&ratio), "{law} {gradient:?} in space: {ratio}");
    }
}
