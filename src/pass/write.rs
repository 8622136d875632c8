//! How twins set their columns.

use crate::tensor::Space;
use rayon::prelude::*;

/// Particles of one task: few enough to balance two cores on a thousand particles, enough to hide the scheduling.
pub(crate) const GRAIN: usize = 128;

/// Sets every element of a column from its index and the state, on all cores. The column must have been
/// taken out of the state: a pass reads its neighbours' values of other columns, never of the one it writes.
pub(crate) fn write<T: Send>(column: &mut [T], value: impl Fn(usize, &mut T) + Sync) {
    column.par_iter_mut().enumerate().with_min_len(GRAIN).for_each(|(i, slot)| value(i, slot));
}

/// Sum that hands back what rounding dropped. The shader hides the intermediate sum from the optimiser.
#[inline(always)]
pub(crate) fn compensated_add<S: Space>(sum: &mut S::Vec, carry: &mut S::Vec, increment: S::Vec) {
    let corrected = increment - *carry;
    let total = *sum + corrected;
    *carry = (total - *sum) - corrected;
    *sum = total;
}
