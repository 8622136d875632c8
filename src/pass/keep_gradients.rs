//! Keeps the neighbours of the reference configuration, and V_b times the gradient at a of b's shape function there,
//! for a list that will follow the particles. Twin: shaders/pass/keep_gradients.wgsl

use super::Stage;
use crate::shape_function::{Node, Shape, nodes};
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    if state.clock.running == 0 {
        return;
    }
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
        state.particles.kept_count[a] = entries.len() as u32;
        for (k, (&entry, &gradient)) in entries.iter().zip(row).enumerate() {
            state.kept_neighbors[k * count + a] = entry;
            state.kept_gradients[k * count + a] = gradient;
        }
    }
}
