//! K_a^-1, K_a = sum V_b (X_b - X_a) (x) grad_a W_ab: makes the deformation gradient exact for linear fields
//! (Bonet & Lok 1999). Twin: shaders/pass/correct_reference.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::bond::{Source, with_bonds};
use crate::pair::inverse_or;
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "inverse of the first moment of the kernel gradient in the reference configuration",
        entries: LISTED,
        runs: Runs::Always,
        own: &[always(&[ReferencePosition, NeighborCount, Neighbors]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume]), when(|m| m.tied, &[Body])],
        writes: &[always(&[ReferenceCorrection])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_bonds!(state, B => fill!(state, reference_correction, |a, slot| {
        *slot = S::sym_part(inverse_or::<S>(moment::<S, B>(state, a), S::mat_identity()));
    }));
}

#[inline(always)]
fn moment<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> S::Mat {
    let mut moment = S::Mat::default();
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            moment = moment - S::outer(bond.row.x, bond.row.gradient);
        }
    }
    moment
}
