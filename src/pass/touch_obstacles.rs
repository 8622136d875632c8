//! Force of the rigid obstacle that a facet is deepest in: k A (-g) along the obstacle's normal at the facet, g the
//! distance from its surface, and friction. It is the derivative of (k/2) A g^2. Twin:
//! shaders/pass/touch_obstacles.wgsl

use super::Stage;
use super::write::{GRAIN, write_rows};
use crate::facet::{lever, stick};
use crate::obstacle;
use crate::rows::FacetPair;
use crate::state::State;
use crate::tensor::{Real, Space};

/// What the pass finds for one facet.
#[derive(Clone, Copy, Default)]
struct Touch<R, V> {
    /// Index of the obstacle, plus 1; 0 for none.
    obstacle: u32,
    load: V,
    pressure: R,
    energy: R,
    slip: V,
    heat: R,
}

type TouchIn<S> = Touch<<S as Space>::Real, <S as Space>::Vec>;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let (added, friction) = (state.method.gap.is_some(), state.method.friction);
    let mut own = std::mem::take(&mut state.particles);
    let (mut obstacle, mut load) = (std::mem::take(&mut own.facet_obstacle), std::mem::take(&mut own.facet_load));
    let (mut force, mut moment) = (std::mem::take(&mut own.facet_force), std::mem::take(&mut own.facet_moment));
    let (mut pressure, mut energy) = (std::mem::take(&mut own.facet_pressure), std::mem::take(&mut own.facet_energy));
    let (mut slip, mut heat) = (std::mem::take(&mut own.facet_obstacle_slip), std::mem::take(&mut own.facet_heat));
    state.particles = own;
    let put = |e: usize, row: Row<'_, S>, slip: S::Vec| {
        let touch = touch(state, e, slip);
        // The facet was out of touch before and still is: there is no force to add, and no earlier one to set to zero.
        if touch.obstacle == 0 && *row.obstacle == 0 {
            return touch;
        }
        let moment = S::outer(touch.load, lever(state, e)) * S::Real::of(-1.0);
        let kept = if added { S::Real::of(1.0) } else { S::Real::of(0.0) };
        *row.obstacle = touch.obstacle;
        *row.load = touch.load;
        *row.force = *row.force * kept + touch.load;
        *row.moment = *row.moment * kept + moment;
        *row.pressure = *row.pressure * kept + touch.pressure;
        *row.energy = *row.energy * kept + touch.energy;
        touch
    };
    let loads = ((&mut obstacle[..], &mut load[..]), (&mut force[..], &mut moment[..]));
    let columns = (loads, (&mut pressure[..], &mut energy[..]));
    if friction {
        write_rows((columns, (&mut slip[..], &mut heat[..])), GRAIN, |e, (row, (slip, heat))| {
            let touch = put(e, Row::of(row), *slip);
            *slip = touch.slip;
            *heat = if added { *heat + touch.heat } else { touch.heat };
        });
    } else {
        write_rows(columns, GRAIN, |e, row| {
            put(e, Row::of(row), S::Vec::default());
        });
    }
    let own = &mut state.particles;
    (own.facet_obstacle, own.facet_load, own.facet_force, own.facet_moment) = (obstacle, load, force, moment);
    (own.facet_pressure, own.facet_energy, own.facet_obstacle_slip, own.facet_heat) = (pressure, energy, slip, heat);
}

/// What the pass writes of one facet.
struct Row<'c, S: Space> {
    obstacle: &'c mut u32,
    load: &'c mut S::Vec,
    force: &'c mut S::Vec,
    moment: &'c mut S::Mat,
    pressure: &'c mut S::Real,
    energy: &'c mut S::Real,
}

/// One row of the columns that the pass writes, as the loop hands it over.
type Written<'c, S> = (
    ((&'c mut u32, &'c mut <S as Space>::Vec), (&'c mut <S as Space>::Vec, &'c mut <S as Space>::Mat)),
    (&'c mut <S as Space>::Real, &'c mut <S as Space>::Real),
);

impl<'c, S: Space> Row<'c, S> {
    #[inline(always)]
    fn of((((obstacle, load), (force, moment)), (pressure, energy)): Written<'c, S>) -> Self {
        Self { obstacle, load, force, moment, pressure, energy }
    }
}

/// The obstacle that a facet is deepest in, counted from 1, its distance and its normal.
fn deepest<S: Space>(state: &State<S>, e: usize) -> (usize, S::Real, S::Vec) {
    let columns = &state.particles;
    let body = state.body_index(columns.facet_owner[e] as usize);
    let mut found = (0, S::Real::of(0.0), S::Vec::default());
    for (k, obstacle) in state.obstacles.iter().enumerate() {
        if state.obstacle_pairs[k * state.params.body_count as usize + body].stiffness == S::Real::of(0.0) {
            continue;
        }
        let reference =
            columns.facet_reference_position[e] - S::vec_of_reals([obstacle.point_x, obstacle.point_y, obstacle.point_z]);
        let (gap, normal) =
            obstacle::distance::<S>(obstacle, reference + (columns.facet_displacement[e] - columns.obstacle_displacement[k]));
        if gap < found.1 {
            found = (k + 1, gap, normal);
        }
    }
    found
}

/// `slip` is the elastic slip before.
fn touch<S: Space>(state: &State<S>, e: usize, slip: S::Vec) -> TouchIn<S> {
    let (obstacle, gap, normal) = deepest(state, e);
    if obstacle == 0 {
        return Touch::default();
    }
    let columns = &state.particles;
    let body = state.body_index(columns.facet_owner[e] as usize);
    let pair = state.obstacle_pairs[(obstacle - 1) * state.params.body_count as usize + body];
    let stiffness = pair.stiffness * columns.facet_area[e];
    let force = S::Real::of(-1.0) * stiffness * gap;
    let mut touch = Touch {
        obstacle: obstacle as u32,
        load: normal * force,
        pressure: force / columns.facet_area[e],
        energy: S::Real::of(0.5) * force * S::Real::of(-1.0) * gap,
        ..Touch::default()
    };
    if state.method.friction && pair.friction > S::Real::of(0.0) {
        touch.slip = slip;
        rub(state, (e, obstacle - 1), normal, (&pair, stiffness, force), &mut touch);
    }
    touch
}

/// The tangential spring, which stretches by the distance that the facet slips over the obstacle.
fn rub<S: Space>(
    state: &State<S>,
    (e, k): (usize, usize),
    normal: S::Vec,
    (pair, stiffness, force): (&FacetPair<S::Real>, S::Real, S::Real),
    touch: &mut TouchIn<S>,
) {
    let columns = &state.particles;
    let grown = touch.slip + columns.facet_move[e] - columns.obstacle_move[k];
    let along = grown - normal * S::inner(grown, normal);
    (touch.slip, touch.heat) = stick::<S>(along, stiffness, pair.friction * force);
    touch.load += touch.slip * (S::Real::of(-1.0) * stiffness);
    touch.energy += S::Real::of(0.5) * stiffness * S::inner(touch.slip, touch.slip);
}
