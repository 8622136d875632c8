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

/// Part of the largest pressure below which a facet is out of contact: a gap spreads its force smoothly over the other surface's
/// facets, and far ones have next to nothing of it. Hertz's pressure is below this on a hundredth of the area.
const PRESSED: f64 = 0.1;

/// Area of the facets that an obstacle presses. Without an obstacle that of all that feel a force, which the other surface may have
/// measured.
fn area(moment: &Moment, observer: &Observer) -> f64 {
    let wanted = observer.typed.obstacle.as_ref().map(|_| index(moment, observer) as f64 + 1.0);
    let own = |owner: u32| observer.typed.body.is_none() || observer.particles.binary_search(&(owner as usize)).is_ok();
    let facets = || moment.scene.facets.iter().enumerate().filter(|(_, facet)| own(facet.owner));
    if let Some(number) = wanted {
        let touched = facets().filter(|&(e, _)| moment.scalar(Field::FacetObstacle, e) == number);
        return touched.fold(0.0, |sum, (_, facet)| sum + facet.piece.area);
    }
    let pressure = |e: usize, area: f64| DVec3::from_array(moment.vector(Field::FacetForce, e)).length() / area;
    let most = facets().fold(0.0, |most: f64, (e, facet)| most.max(pressure(e, facet.piece.area)));
    let pressed = facets().filter(|&(e, facet)| pressure(e, facet.piece.area) > PRESSED * most);
    pressed.fold(0.0, |sum, (_, facet)| sum + facet.piece.area)
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
    about: "area at the start of the facets that an obstacle touches (key `obstacle`), or of all that are pressed",
    needs: &[],
    fields: &[Field::FacetForce],
    value: Value::Series(area),
};
