//! alpha, beta and their derivatives at each particle, Shutov & Klyuchantsev 2019 (2), (3).
//! Twin: shaders/pass/shape_function.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use crate::shape_function::{Shape, correct};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "corrects the kernel, Shutov & Klyuchantsev (1) to (3)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.current(), &[VolumetricStrain]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.current(), &[VolumetricStrain]),
        ],
        writes: &[always(&[ShapeFactor, ShapeSlope, ShapeFactorGradient, ShapeSlopeGradient])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
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
