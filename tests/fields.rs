//! The one list of tables against what a state of each scene takes.

use crate::common::scene_files;
use lithosph::fields::{Field, Set};
use lithosph::scene::Scene;
use lithosph::step;
use lithosph::tensor::{Line, Plane, Solid};
use std::collections::BTreeSet;

/// Beyond so many particles a scene's state takes long to make.
const MOST: usize = 5000;

#[test]
fn the_bytes_foretold_are_those_of_all_columns_of_the_state() {
    let mut sets = BTreeSet::new();
    for path in scene_files() {
        let scene = Scene::open(&path, None, &[]).unwrap();
        if scene.particles.len() > MOST {
            continue;
        }
        let taken = match scene.dimension() {
            1 => [scene.state::<Line<f32>>(true).bytes(), scene.state::<Line<f64>>(false).bytes()],
            2 => [scene.state::<Plane<f32>>(true).bytes(), scene.state::<Plane<f64>>(false).bytes()],
            _ => [scene.state::<Solid<f32>>(true).bytes(), scene.state::<Solid<f64>>(false).bytes()],
        };
        assert_eq!(taken, [scene.state_bytes(4, true), scene.state_bytes(8, false)], "{}", path.display());
        sets.extend(step::fields(&scene.method).into_iter().map(Field::set));
    }
    assert!(sets.len() >= Set::ALL.len() - 1, "the scenes have fields of {sets:?} only");
}
