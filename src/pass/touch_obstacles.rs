//! Force of the rigid obstacle that a facet is deepest in: k A (-g) along the obstacle's normal at the facet, g the
//! distance from its surface, and friction. It is the derivative of (k/2) A g^2. Twin:
//! shaders/pass/touch_obstacles.wgsl

use super::Stage;
use crate::facet::{FacetPair, lever, stick};
use crate::obstacle;
use crate::state::State;
use crate::tensor::{Real, Space};
use rayon::prelude::*;

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
    let mut touches = vec![TouchIn::<S>::default(); state.params.facet_count as usize];
    touches.par_iter_mut().enumerate().with_min_len(super::GRAIN).for_each(|(e, slot)| *slot = touch(state, e));
    let (added, friction) = (state.method.gap.is_some(), state.method.friction);
    for (e, touch) in touches.iter().enumerate() {
        let moment =
            if touch.obstacle > 0 { S::outer(touch.load, lever(state, e)) * S::Real::of(-1.0) } else { S::Mat::default() };
        let columns = &mut state.particles;
        columns.facet_obstacle[e] = touch.obstacle;
        columns.facet_load[e] = touch.load;
        let kept = if added { S::Real::of(1.0) } else { S::Real::of(0.0) };
        columns.facet_force[e] = columns.facet_force[e] * kept + touch.load;
        columns.facet_moment[e] = columns.facet_moment[e] * kept + moment;
        columns.facet_pressure[e] = columns.facet_pressure[e] * kept + touch.pressure;
        columns.facet_energy[e] = columns.facet_energy[e] * kept + touch.energy;
        if friction {
            columns.facet_obstacle_slip[e] = touch.slip;
            columns.facet_heat[e] = columns.facet_heat[e] * kept + touch.heat;
        }
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

fn touch<S: Space>(state: &State<S>, e: usize) -> TouchIn<S> {
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
        rub(state, (e, obstacle - 1), normal, (&pair, stiffness, force), &mut touch);
    }
    touch
}

/// The tangential spring, which the facet's way over the obstacle stretches.
fn rub<S: Space>(
    state: &State<S>,
    (e, k): (usize, usize),
    normal: S::Vec,
    (pair, stiffness, force): (&FacetPair<S::Real>, S::Real, S::Real),
    touch: &mut TouchIn<S>,
) {
    let columns = &state.particles;
    let grown = columns.facet_obstacle_slip[e] + columns.facet_move[e] - columns.obstacle_move[k];
    let along = grown - normal * S::inner(grown, normal);
    (touch.slip, touch.heat) = stick::<S>(along, stiffness, pair.friction * force);
    touch.load += touch.slip * (S::Real::of(-1.0) * stiffness);
    touch.energy += S::Real::of(0.5) * stiffness * S::inner(touch.slip, touch.slip);
}
