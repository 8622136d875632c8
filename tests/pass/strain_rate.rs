//! The gradient of the velocity, of fields that are linear.

use crate::step::eulerian::{DISC, scene};
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::pass::{Pass, Stage};
use lithosph::state::State;
use lithosph::tensor::{Plane, Solid, Space};

/// Fills the velocity with a linear field and returns the largest error of its gradient.
fn gradient_error<S: Space<Real = f64>>(mut state: State<S>, set_up: impl FnOnce(State<S>) -> State<S>) -> f64 {
    let mut expected = S::Mat::default();
    for i in 0..S::DIMENSION {
        for j in 0..S::DIMENSION {
            expected[S::mat_index(i, j)] = 0.3 * (i as f64 + 1.0) - 0.7 * j as f64;
        }
    }
    state = set_up(state);
    for a in 0..state.params.count as usize {
        state.columns.velocity[a] = S::mat_vec(expected, state.position(a));
    }
    Pass::StrainRate.run(&mut state, Stage::default());
    let components = || (0..S::DIMENSION).flat_map(|i| (0..S::DIMENSION).map(move |j| (i, j)));
    let error = |a: usize| {
        let found = state.columns.velocity_gradient[a];
        components().map(|(i, j)| (found[S::mat_index(i, j)] - expected[S::mat_index(i, j)]).abs()).fold(0.0, f64::max)
    };
    (0..state.params.count as usize).map(error).fold(0.0, f64::max)
}

fn listed<S: Space<Real = f64>>(state: State<S>) -> State<S> {
    let mut cpu = Cpu::new(state);
    cpu.begin_segment(0.0, 1.0, 1, true).unwrap_or_else(|e| panic!("{e}"));
    cpu.into_state()
}

#[test]
fn the_corrected_gradient_is_exact_for_linear_fields() {
    for gradient in ["corrected", "adjoint"] {
        let plane = scene(DISC, &[&format!("formulation.gradient={gradient}")]);
        assert!(gradient_error(plane.state::<Plane<f64>>(false), listed) < 1e-12, "{gradient}");
        let changes = ["dimension=3", "body.disc.shape={sphere={center=[0,0,0],radius=4.1}}", "body.disc.packing=cubic"];
        let gradient = format!("formulation.gradient={gradient}");
        let solid = scene(DISC, &[changes[0], changes[1], changes[2], &gradient]);
        assert!(gradient_error(solid.state::<Solid<f64>>(false), listed) < 1e-12, "{gradient}");
    }
}

#[test]
fn the_plain_gradient_is_wrong_at_a_free_surface() {
    let error = gradient_error(scene(DISC, &[]).state::<Plane<f64>>(false), listed);
    assert!(error > 0.1, "{error}");
}
