//! alpha, beta and their derivatives at each particle, Shutov & Klyuchantsev 2019 (2), (3).
//! Twin: shaders/pass/shape_function.wgsl

use super::Stage;
use crate::shape_function::{Shape, correct};
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut shapes = vec![Shape::<S>::bare(); state.params.count as usize];
    super::write(&mut shapes, |a, slot| *slot = correct(state, a, stage.reference));
    let p = &mut state.columns;
    for (a, shape) in shapes.into_iter().enumerate() {
        p.shape_factor[a] = shape.factor;
        p.shape_slope[a] = shape.slope;
        p.shape_factor_gradient[a] = shape.factor_gradient;
        p.shape_slope_gradient[a] = shape.slope_gradient;
    }
}
