//! How far something spreads from a point: a plastic zone, a wave.

use super::{Moment, ObservableKind, Observer, Value};

/// Where nothing exceeds the level there is no zone, and its reach is 0.
fn reach(moment: &Moment, observer: &Observer) -> f64 {
    let typed = &observer.typed;
    let (Some(at), Some(path), Some(level)) = (&typed.at, &typed.field, typed.level) else { return f64::NAN };
    let distance = |i: usize| moment.scene.particles[i].position.distance(at.vector());
    let values = moment.path(path, &observer.particles);
    let within = values.iter().zip(&observer.particles).filter(|(value, _)| **value > level);
    within.map(|(_, &i)| distance(i)).fold(0.0, f64::max)
}

pub const ZONE: ObservableKind = ObservableKind {
    word: "zone",
    about: "largest distance from `at`, at the start, of the selected particles whose field is above `level`; 0 for none",
    needs: &["field", "at", "level"],
    fields: &[],
    value: Value::Series(reach),
};

#[cfg(test)]
mod tests {
    use super::super::observers;
    use super::*;
    use crate::fields::Field;
    use crate::scene::Scene;

    const SCENE: &str = "
        title = 'A row of points'
        dimension = 1
        units = 'dimensionless'
        spacing = 1.0
        duration = 1.0
        [[body]]
        name = 'row'
        shape = { block = { min = [0], max = [10] } }
        anchor = [0.5]
        material = 'rubber'
        [material.rubber]
        density = 1.0
        youngs_modulus = 1.0
        poisson_ratio = 0.3
        [observe.all]
        kind = 'zone'
        field = 'velocity.x'
        at = [4.0]
        level = 0.1
        [observe.right]
        kind = 'zone'
        field = 'velocity.x'
        at = [4.0]
        level = 0.1
        inside = { block = { min = [4], max = [10] } }
    ";

    #[test]
    fn a_zone_reaches_to_the_furthest_particle_above_the_level() {
        let scene = Scene::parse(SCENE, "row", None, &[]).unwrap();
        let observers = observers(&scene);
        let reach = |speeds: [f64; 10]| {
            let number = (0..10).map(f64::from).collect();
            let columns = [(Field::Number, number), (Field::Velocity, speeds.to_vec())].into();
            let moment = Moment::new(&scene, 0.0, 0, &columns);
            [0, 1].map(|k| super::reach(&moment, &observers[k]))
        };
        assert_eq!(reach([0.0, 0.3, 0.0, 0.0, 0.2, 0.2, 0.1, 0.0, -1.0, 0.0]), [2.5, 1.5]);
        assert_eq!(reach([0.0; 10]), [0.0, 0.0]);
    }
}
