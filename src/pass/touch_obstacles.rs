//! Force of the rigid obstacle that a facet is deepest in: k A (-g) along the obstacle's normal at the facet, g the
//! distance from its surface, and friction. It is the derivative of (k/2) A g^2. Twin:
//! shaders/pass/touch_obstacles.wgsl

use super::Stage;
use super::declaration::{Declaration, FACETS, Runs, always, when};
use super::write::{GRAIN, with_columns, write_rows};
use crate::facet::{lever, stick};
use crate::obstacle;
use crate::rows::FacetPair;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "force of rigid obstacles on each facet",
        entries: FACETS,
        runs: Runs::Running,
        own: &[
            always(&[
                ReferencePosition,
                FacetOwner,
                FacetReferencePosition,
                FacetArea,
                FacetDisplacement,
                FacetObstacle,
                ObstacleDisplacement,
            ]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.friction, &[FacetMove, FacetObstacleSlip, ObstacleMove]),
            when(|m| m.gap.is_some(), &[FacetForce, FacetMoment, FacetPressure, FacetEnergy]),
            when(|m| m.friction && m.gap.is_some(), &[FacetHeat]),
        ],
        neighbours: &[],
        writes: &[
            always(&[FacetForce, FacetMoment, FacetPressure, FacetEnergy, FacetLoad, FacetObstacle]),
            when(|m| m.friction, &[FacetHeat, FacetObstacleSlip]),
        ],
    }
};

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
    with_columns!(state, [
        facet_obstacle, facet_load, facet_force, facet_moment, facet_pressure, facet_energy, facet_obstacle_slip, facet_heat
    ] => {
        let loads = ((&mut facet_obstacle[..], &mut facet_load[..]), (&mut facet_force[..], &mut facet_moment[..]));
        let columns = (loads, (&mut facet_pressure[..], &mut facet_energy[..]));
        if state.method.friction {
            let added = state.method.gap.is_some();
            write_rows((columns, (&mut facet_obstacle_slip[..], &mut facet_heat[..])), GRAIN, |e, (row, (slip, heat))| {
                let touch = put(state, e, Row::of(row), *slip);
                *slip = touch.slip;
                *heat = if added { *heat + touch.heat } else { touch.heat };
            });
        } else {
            write_rows(columns, GRAIN, |e, row| {
                put(state, e, Row::of(row), S::Vec::default());
            });
        }
    });
}

#[inline(always)]
fn put<S: Space>(state: &State<S>, e: usize, row: Row<'_, S>, slip: S::Vec) -> TouchIn<S> {
    let touch = touch(state, e, slip);
    // The facet was out of touch before and still is: there is no force to add, and no earlier one to set to zero.
    if touch.obstacle == 0 && *row.obstacle == 0 {
        return touch;
    }
    let moment = S::outer(touch.load, lever(state, e)) * S::Real::of(-1.0);
    let kept = if state.method.gap.is_some() { S::Real::of(1.0) } else { S::Real::of(0.0) };
    *row.obstacle = touch.obstacle;
    *row.load = touch.load;
    *row.force = *row.force * kept + touch.load;
    *row.moment = *row.moment * kept + moment;
    *row.pressure = *row.pressure * kept + touch.pressure;
    *row.energy = *row.energy * kept + touch.energy;
    touch
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
    let columns = &state.columns;
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
    let columns = &state.columns;
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
    let columns = &state.columns;
    let grown = touch.slip + columns.facet_move[e] - columns.obstacle_move[k];
    let along = grown - normal * S::inner(grown, normal);
    (touch.slip, touch.heat) = stick::<S>(touch.slip, along, stiffness, pair.friction * force);
    touch.load += touch.slip * (S::Real::of(-1.0) * stiffness);
    touch.energy += S::Real::of(0.5) * stiffness * S::inner(touch.slip, touch.slip);
}
