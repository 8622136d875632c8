//! K_a^-1, K_a = sum V_b (X_b - X_a) (x) grad_a W_ab: makes the deformation gradient exact for linear fields
//! (Bonet & Lok 1999). Twin: shaders/pass/correct_reference.wgsl

use super::Stage;
use crate::pair::bonds;
use crate::pair::safe_inverse;
use crate::smoothing::{Kernel, with_kernel};
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let mut corrections = std::mem::take(&mut state.particles.reference_correction);
    with_kernel!(state.method.smoothing, K => {
        super::write(&mut corrections, |a, slot| *slot = S::sym_part(safe_inverse::<S>(moment::<S, K>(state, a))));
    });
    state.particles.reference_correction = corrections;
}

#[inline(always)]
fn moment<S: Space, K: Kernel>(state: &State<S>, a: usize) -> S::Mat {
    let mut moment = S::Mat::default();
    for bond in bonds::<S, K>(state, a) {
        moment = moment - S::outer(bond.x, bond.x * (bond.gradient * state.particles.reference_volume[bond.b]));
    }
    moment
}
