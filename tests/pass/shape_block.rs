//! A block of particles out of order, of unequal volumes and deformations.

use crate::common::{Random, parse};
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::tensor::Space;

pub fn text(dimension: usize, options: &str) -> String {
    let side = [30, 9, 6][dimension - 1];
    format!(
        "title = 'block'
        dimension = {dimension}
        spacing = 1.0
        duration = 1.0
        [[body]]
        name = 'block'
        shape = {{ block = {{ min = [0, 0, 0], max = [{side}, {side}, {side}] }} }}
        anchor = [0.5, 0.5, 0.5]
        material = 'rubber'
        [material.rubber]
        law = 'neo_hookean'
        density = 3.0
        shear_modulus = 1.25
        bulk_modulus = 5.833
        [formulation]
        kind = 'corrected_kernel'
        {options}
        [time]
        integrator = 'ssp_rk3'
        "
    )
}

/// Particles out of order, of unequal volumes and deformations, each with a velocity; listed, and with their forces.
pub fn irregular<S: Space<Real = f64>>(options: &str) -> Cpu<S> {
    let mut random = Random(2019);
    let mut state = parse(&text(S::DIMENSION, options)).state::<S>(false);
    for a in 0..state.params.count as usize {
        let p = &mut state.columns;
        p.reference_volume[a] *= 1.0 + 0.2 * random.signed();
        for k in 0..S::DIMENSION {
            p.displacement[a][k] = 0.15 * random.signed();
            p.velocity[a][k] = 0.1 * random.signed();
            for j in 0..S::DIMENSION {
                p.displacement_gradient[a][S::mat_index(k, j)] = 0.05 * random.signed();
            }
        }
    }
    let mut cpu = Cpu::new(state);
    cpu.begin_segment(0.0, 1.0, 1, true).unwrap();
    cpu
}

fn components<S: Space>() -> impl Iterator<Item = (usize, usize)> {
    (0..S::DIMENSION).flat_map(|i| (0..S::DIMENSION).map(move |j| (i, j)))
}

/// Largest component of a difference.
pub fn apart<S: Space<Real = f64>>(a: S::Mat, b: S::Mat) -> f64 {
    components::<S>().map(|(i, j)| (a[S::mat_index(i, j)] - b[S::mat_index(i, j)]).abs()).fold(0.0, f64::max)
}
