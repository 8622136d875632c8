//! Keeps the neighbours of the reference configuration, and V_b times the gradient at a of b's shape function there,
//! for a list that will follow the particles. Twin: shaders/pass/keep_gradients.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use crate::shape_function::{Node, Shape, nodes};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "keeps the gradients of the shape functions of the reference configuration",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, VolumetricStrain, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.correction(), &[ShapeFactor, ShapeSlope, ShapeFactorGradient, ShapeSlopeGradient]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, VolumetricStrain]),
            when(|m| m.many_bodies, &[Body]),
        ],
        writes: &[always(&[KeptCount, KeptNeighbors, KeptGradients])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    let count = state.params.count as usize;
    let mut rows: Vec<Vec<S::Vec>> = vec![Vec::new(); count];
    super::write(&mut rows, |a, row| {
        let shape = Shape::of(state, a);
        let gradient = |node: Node<S>| shape.gradient(node.x, node.weight, node.slope) * node.volume;
        *row = nodes(state, a, stage.reference).map(gradient).collect();
    });
    for (a, row) in rows.iter().enumerate() {
        // The last node is particle a itself. It is left out: its displacement differs from a's own by nothing.
        let entries: Vec<u32> = state.neighbors_of(a).to_vec();
        state.columns.kept_count[a] = entries.len() as u32;
        for (k, (&entry, &gradient)) in entries.iter().zip(row).enumerate() {
            state.columns.kept_neighbors[k * count + a] = entry;
            state.columns.kept_gradients[k * count + a] = gradient;
        }
    }
}
