//! Lists the particles within reach of each particle, mirror images included, in cell order.
//! Twin: shaders/pass/find_neighbors.wgsl

use super::Stage;
use super::bin_cells::{cell_of, place};
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::{Wide, with_columns, write_rows};
use crate::pair::{mirror_point, reference_separation, separation};
use crate::rows::{Fault, NEIGHBOR_BITS};
use crate::state::State;
use crate::tensor::{Real, Space};
use std::sync::atomic::{AtomicU32, Ordering};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "lists the particles within reach, mirror images included",
        entries: LISTED,
        runs: Runs::Rebuilding,
        own: &[
            always(&[ReferencePosition, Displacement, CellStart, CellParticles]),
            when(|m| m.coupling && m.many_bodies, &[Body]),
        ],
        neighbours: &[always(&[ReferencePosition, Displacement]), when(|m| m.coupling && m.many_bodies, &[Body])],
        writes: &[always(&[NeighborCount, Neighbors]), when(|m| m.list_follows(), &[ListedDisplacement])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    let capacity = state.params.list_capacity as usize;
    let fault = AtomicU32::new(0);
    with_columns!(state, [neighbors, neighbor_count] => {
        let lists = Wide { entries: &mut neighbors[..], width: capacity };
        write_rows((lists, &mut neighbor_count[..]), 64, |a, (row, count)| {
            *count = list_one(state, a, row, stage).unwrap_or_else(|| {
                fault.store(Fault::ListFull as u32, Ordering::Relaxed);
                0
            });
        });
    });
    if !stage.reference {
        let columns = &mut state.columns;
        columns.listed_displacement.clone_from(&columns.displacement);
    }
    if fault.into_inner() != 0 {
        state.clock.fault = Fault::ListFull as u32;
    }
}

/// Fills one particle's row; None if it is too short.
fn list_one<S: Space>(state: &State<S>, a: usize, row: &mut [u32], stage: Stage) -> Option<u32> {
    let params = &state.params;
    let x = place(state, a, stage);
    let mut found = 0;
    for image in 0..1u32 << params.plane_count {
        let center = mirror_point::<S>(params, image, x);
        if image != 0 {
            // The image of every particle within reach of a is near a's own image only if a is near the plane.
            let apart = x - center;
            let limit = S::Real::of(2.0) * params.reach * S::Real::of(f64::from(params.plane_count)).sqrt();
            if S::inner(apart, apart) > limit * limit {
                continue;
            }
        }
        visit_cells::<S>(state, center, |b| {
            let entry = b | image << NEIGHBOR_BITS;
            if image == 0 && b as usize == a {
                return Some(());
            }
            let apart = if stage.reference { reference_separation(state, a, entry) } else { separation(state, a, entry) };
            if S::inner(apart, apart) >= params.reach * params.reach {
                return Some(());
            }
            if state.method.coupling && state.coupling_of(a, b as usize) == S::Real::of(0.0) {
                return Some(());
            }
            *row.get_mut(found)? = entry;
            found += 1;
            Some(())
        })?;
    }
    Some(found as u32)
}

/// Calls `visit` with every particle of the cells around a point, until it returns None.
#[inline(always)]
pub fn visit_cells<S: Space>(state: &State<S>, center: S::Vec, mut visit: impl FnMut(u32) -> Option<()>) -> Option<()> {
    let params = &state.params;
    let [cx, cy, cz] = cell_of::<S>(params, center);
    let range = |c: u32, cells: u32, period: S::Real, axis: usize| {
        if axis >= S::DIMENSION {
            return (0, 0);
        }
        let wraps = period > S::Real::of(0.0);
        let low = if c == 0 && !wraps { 0 } else { c as i32 - 1 };
        let high = if c + 1 == cells && !wraps { c as i32 } else { c as i32 + 1 };
        (low, high)
    };
    let wrap = |c: i32, cells: u32| c.rem_euclid(cells as i32) as u32;
    let (x0, x1) = range(cx, params.cells_x, params.period_x, 0);
    let (y0, y1) = range(cy, params.cells_y, params.period_y, 1);
    let (z0, z1) = range(cz, params.cells_z, params.period_z, 2);
    for z in z0..=z1 {
        for y in y0..=y1 {
            let row = (wrap(z, params.cells_z) * params.cells_y + wrap(y, params.cells_y)) * params.cells_x;
            // Cells that follow each other along x also do in memory, so that a row of cells is one range of particles,
            // or two where the box is periodic and the row wraps along x.
            let (mut first, last) = (x0, x1);
            while first <= last {
                let start = wrap(first, params.cells_x);
                let width = (last - first).min((params.cells_x - 1 - start) as i32) as u32;
                let cells = (row + start) as usize;
                let columns = &state.columns;
                let places = columns.cell_start[cells] as usize..columns.cell_start[cells + width as usize + 1] as usize;
                for &b in &columns.cell_particles[places] {
                    visit(b)?;
                }
                first += width as i32 + 1;
            }
        }
    }
    Some(())
}
