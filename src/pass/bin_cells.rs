//! Cell of each particle and number of particles of each cell. Twin: shaders/pass/bin_cells.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always};
use super::write::fill;
use crate::rows::Params;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "counts the particles of each cell",
        entries: PARTICLES,
        runs: Runs::Rebuilding,
        own: &[always(&[ReferencePosition, Displacement, CellCount])],
        neighbours: &[],
        writes: &[always(&[Cell, CellCount])],
    }
};

/// Cell coordinates of a point. Points outside the grid belong to the cell at its edge: two points nearer than
/// a cell are then still in the same or in adjacent cells. A periodic axis wraps.
#[inline(always)]
pub fn cell_of<S: Space>(params: &Params<S::Real>, x: S::Vec) -> [u32; 3] {
    let origin = [params.origin_x, params.origin_y, params.origin_z];
    let size = [params.cell_x, params.cell_y, params.cell_z];
    let period = [params.period_x, params.period_y, params.period_z];
    let cells = [params.cells_x, params.cells_y, params.cells_z];
    let mut cell = [0; 3];
    for k in 0..S::DIMENSION {
        let mut distance = x[k] - origin[k];
        if period[k] > S::Real::of(0.0) {
            distance -= period[k] * (distance / period[k]).floor();
        }
        let last = S::Real::of(f64::from(cells[k] - 1));
        cell[k] = (distance / size[k]).floor().max(S::Real::of(0.0)).min(last).f64() as u32;
    }
    cell
}

/// Where a particle is, or was in the reference configuration.
#[inline(always)]
pub fn place<S: Space>(state: &State<S>, i: usize, stage: Stage) -> S::Vec {
    if stage.reference { state.columns.reference_position[i] } else { state.position(i) }
}

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    fill!(state, cell, |i, slot| {
        let params = &state.params;
        let [x, y, z] = cell_of::<S>(params, place(state, i, stage));
        *slot = (z * params.cells_y + y) * params.cells_x + x;
    });
    let columns = &mut state.columns;
    for &cell in &columns.cell {
        columns.cell_count[cell as usize] += 1;
    }
}
