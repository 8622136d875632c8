//! The one list of tables against what a state of each scene takes, and of each case of the parity tests.

use crate::backend::parity::cases::cases;
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
    let of_files = scene_files().into_iter().map(|path| Scene::open(&path, None, &[]).unwrap());
    let small = of_files.filter(|scene| scene.particles.len() <= MOST);
    let mut sets = BTreeSet::new();
    let scenes = small.chain((1..=3).flat_map(cases).map(|case| case.scene()));
    for scene in scenes.flat_map(|scene| scene.members().cloned().collect::<Vec<_>>()) {
        let taken = match scene.dimension() {
            1 => [scene.state::<Line<f32>>(true).bytes(), scene.state::<Line<f64>>(false).bytes()],
            2 => [scene.state::<Plane<f32>>(true).bytes(), scene.state::<Plane<f64>>(false).bytes()],
            _ => [scene.state::<Solid<f32>>(true).bytes(), scene.state::<Solid<f64>>(false).bytes()],
        };
        assert_eq!(taken, [scene.state_bytes(4, true), scene.state_bytes(8, false)], "{}", scene.label());
        sets.extend(step::fields(&scene.method).into_iter().map(Field::set));
    }
    assert_eq!(sets, Set::ALL.iter().copied().collect());
}
