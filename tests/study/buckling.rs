//! The tangent of the discrete forces against their energy, and a strut's critical load against Euler's with shear.

use lithosph::bond::{Bond, Listed, Source};
use lithosph::scene::Scene;
use lithosph::state::State;
use lithosph::study::buckling::{Path, Pattern, find};
use lithosph::tensor::{Plane, Space};
use std::f64::consts::PI;

type S = Plane<f64>;

/// Held at x < 0, loaded by a part of Euler's load on the two rows about x = length.
fn strut(thickness: i64, length: i64, load: f64) -> Scene {
    let half = thickness / 2;
    let text = format!(
        "title = 'strut'\nsource = 'x'\ndimension = 2\nunits = 'dimensionless'\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'strut'\nanchor = [0.5, 0.5]\nmaterial = 'rubber'
        shape = {{ block = {{ min = [-3, -{half}], max = [{end}, {half}] }} }}
        flaw = {{ amplitude = [0, 0.1], wave_vector = [0.3, 0] }}
        [[boundary]]\nselect = {{ inside = {{ block = {{ min = [-4, -99], max = [0, 99] }} }} }}\nfixed = true
        [[boundary]]\nselect = {{ inside = {{ block = {{ min = [{start}, -99], max = [{end}, 99] }} }} }}\nforce = [{load:e}, 0]
        [material.rubber]\nlaw = 'st_venant_kirchhoff'\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
        [formulation]\nkind = 'total_lagrangian'\n[quasi_static]\nload_steps = 4
        [output]\nfields = []\npicture = {{ field = 'displacement.magnitude' }}\n",
        start = length - 1,
        end = length + 1,
    );
    Scene::parse(&text, "strut", None, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Without its flaw.
fn straight(mut scene: Scene) -> Scene {
    for particle in &mut scene.particles {
        particle.position.y -= 0.1 * (0.3 * particle.position.x).sin();
    }
    scene
}

/// sum V [lambda (tr E)^2/2 + mu E:E + (alpha E/2) sum V_b w |H X_ab - u_ab|^2], w = -W'(R)/R.
fn energy(state: &State<S>) -> f64 {
    let particle = |a: usize| {
        let (body, h) = (state.body(a), state.columns.displacement_gradient[a]);
        let strain = S::sym_part(h) + S::sym_part(S::mat_mat(S::transpose(h), h)) * 0.5;
        let (trace, square) = (S::sym_trace(strain), strain[0].powi(2) + strain[1].powi(2) + 2.0 * strain[2].powi(2));
        let lambda = body.bulk_modulus - 2.0 / 3.0 * body.shear_modulus;
        let elastic = 0.5 * lambda * trace * trace + body.shear_modulus * square;
        let stray = |bond: Bond<S>| {
            let moved = state.columns.displacement[bond.b] - state.columns.displacement[a];
            let stray = S::mat_vec(h, bond.row.x * -1.0) - moved;
            -bond.row.weight * S::inner(stray, stray)
        };
        let bonds = |part: std::ops::Range<usize>| {
            let block = <Listed as Source<S>>::load(state, a, part.clone());
            part.enumerate().map(|(lane, _)| <Listed as Source<S>>::bond(&block, lane)).collect::<Vec<_>>()
        };
        let hourglass: f64 = <Listed as Source<S>>::parts(state, a).flat_map(bonds).map(stray).sum();
        state.columns.reference_volume[a] * (elastic + 0.5 * state.params.hourglass * body.youngs_modulus * hourglass)
    };
    (0..state.columns.displacement.len()).map(particle).sum()
}

#[test]
fn the_tangent_is_symmetric_and_the_second_derivative_of_the_energy() {
    let scene = strut(4, 9, -2e-2);
    let mut path = Path::<S>::new(&scene, 0);
    path.go(0.5).unwrap();
    let asymmetry = Pattern::asymmetry(&mut path);
    println!("asymmetry {asymmetry:.1e}");
    assert!(asymmetry < 1e-6, "{asymmetry}");
    let tangent = path.tangent();
    for seed in 1..4 {
        let direction: Vec<f64> = (0..path.unknowns.len()).map(|k| (1.3 * (seed * (k + 1)) as f64).sin()).collect();
        let curvature: f64 = tangent.times(&direction).iter().zip(&direction).map(|(a, b)| a * b).sum();
        let mut at = |place: f64| {
            path.add(&direction, place);
            path.forces();
            let energy = energy(&path.state);
            path.add(&direction, -place);
            energy
        };
        let step = 1e-4;
        let seen = (at(step) - 2.0 * at(0.0) + at(-step)) / (step * step);
        println!("curvature {curvature}, of the energy {seen}");
        assert!((seen / curvature - 1.0).abs() < 1e-5, "{curvature}, of the energy {seen}");
    }
}

/// P_E/(1 + 1.2 P_E/(G t)), P_E = pi^2 E t^3/(48 (1 - nu^2) L^2).
fn formula(thickness: f64, length: f64) -> f64 {
    let euler = PI.powi(2) / 0.91 * thickness.powi(3) / (48.0 * length * length);
    euler / (1.0 + 1.2 * euler * 2.6 / thickness)
}

/// Four particles across are 10 to 15 % too soft in bending, and the struts' ends give way a little less than sharp ones.
#[test]
fn a_strut_buckles_near_the_load_of_euler() {
    let found = find(&straight(strut(4, 40, -4e-3))).unwrap();
    let ratio = found.load / formula(4.0, 40.0);
    println!("{}ratio {ratio}", found.text());
    assert!((0.84..0.96).contains(&ratio), "{ratio} of the formula");
    // The mode bends to one side, most at the end.
    let tip = found.mode.iter().map(|v| v.length()).fold(0.0, f64::max);
    let last = found.mode.last().unwrap();
    assert!(tip == 1.0 && last.length() > 0.95 && last.y.abs() > 0.9, "{last}");
}

#[test]
fn a_strut_under_tension_does_not_buckle() {
    let said = find(&straight(strut(4, 12, 1e-2))).unwrap_err();
    assert!(said.contains("does not buckle"), "{said}");
}

#[test]
fn a_body_that_yields_is_refused() {
    let text = strut(6, 30, -1e-3).text.replace("law = \"st_venant_kirchhoff\"", "law = \"j2\"\nyield_stress = 0.1");
    let said = find(&Scene::parse(&text, "strut", None, &[]).unwrap()).map(|_| ()).unwrap_err();
    assert!(said.contains("without a law that yields"), "{said}");
}
