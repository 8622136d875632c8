//! What a rigid obstacle does and meets.

use super::momentum::component;
use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use glam::DVec3;

/// Index of the observer's obstacle.
fn index(moment: &Moment, observer: &Observer) -> usize {
    let name = observer.typed.obstacle.as_ref();
    moment.scene.obstacles.iter().position(|obstacle| Some(&obstacle.name) == name).unwrap_or(0)
}

fn vector(moment: &Moment, observer: &Observer, field: Field) -> f64 {
    component(DVec3::from_array(moment.vector(field, index(moment, observer))), observer)
}

/// Area of the facets that an obstacle presses, as large as they are where it presses them. Without an obstacle that
/// of all facets under pressure.
fn area(moment: &Moment, observer: &Observer) -> f64 {
    let wanted = observer.typed.obstacle.as_ref().map(|_| index(moment, observer) as f64 + 1.0);
    let own = |owner: u32| observer.typed.body.is_none() || observer.particles.binary_search(&(owner as usize)).is_ok();
    let facets = moment.scene.facets.iter().enumerate();
    facets
        .filter(|(_, facet)| own(facet.owner))
        .filter(|&(e, _)| match wanted {
            Some(number) => moment.scalar(Field::FacetObstacle, e) == number,
            None => moment.scalar(Field::FacetPressure, e) > 0.0,
        })
        .fold(0.0, |sum, (_, facet)| sum + facet.piece.area)
}

pub const FORCE: ObservableKind = ObservableKind {
    word: "obstacle_force",
    about: "force of the bodies on a rigid obstacle (key `obstacle`)",
    needs: &["obstacle", "axis"],
    fields: &[Field::ObstacleForce],
    value: Value::Series(|moment, observer| vector(moment, observer, Field::ObstacleForce)),
};

pub const DISPLACEMENT: ObservableKind = ObservableKind {
    word: "obstacle_displacement",
    about: "displacement of a rigid obstacle (key `obstacle`)",
    needs: &["obstacle", "axis"],
    fields: &[Field::ObstacleDisplacement],
    value: Value::Series(|moment, observer| vector(moment, observer, Field::ObstacleDisplacement)),
};

pub const VELOCITY: ObservableKind = ObservableKind {
    word: "obstacle_velocity",
    about: "velocity of a rigid obstacle (key `obstacle`)",
    needs: &["obstacle", "axis"],
    fields: &[Field::ObstacleVelocity],
    value: Value::Series(|moment, observer| vector(moment, observer, Field::ObstacleVelocity)),
};

pub const AREA: ObservableKind = ObservableKind {
    word: "contact_area",
    about: "area at the start of the facets that an obstacle touches (key `obstacle`), or of all under pressure",
    needs: &[],
    fields: &[Field::FacetPressure],
    value: Value::Series(area),
};
