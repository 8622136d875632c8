//! What a Total Lagrangian moment tells of stress, volume and energy: the laws themselves, in f64 and in space,
//! where the axes that the scene lacks do not deform.

use super::Moment;
use crate::fields::Field;
use crate::material::{cauchy, inelastic, stored_energy, strain};
use crate::rows::Body;
use crate::tensor::{Line, Plane, Solid, Space, Tuple};

/// The body of a particle, its H and its C_i - 1.
pub(super) struct Deformation {
    body: Body<f64>,
    gradient: <Solid<f64> as Space>::Mat,
    memory: <Solid<f64> as Space>::Sym,
}

impl Deformation {
    pub fn of(moment: &Moment, i: usize) -> Self {
        let (scene, dimension) = (moment.scene, moment.scene.dimension());
        let h = moment.row(Field::DisplacementGradient, i);
        // Columns of three numbers are padded to four.
        let stride = h.len() / dimension;
        let mut gradient = <Solid<f64> as Space>::Mat::default();
        for column in 0..dimension {
            for row in 0..dimension {
                gradient[Solid::<f64>::mat_index(row, column)] = h[column * stride + row];
            }
        }
        let memory = in_space(moment.row(Field::InelasticStrain, i));
        Self { body: scene.bodies[scene.particles[i].body as usize].numbers(), gradient, memory }
    }

    /// Cauchy stress xx, yy, zz, xy, yz, xz.
    pub fn stress(&self) -> [f64; 6] {
        cauchy::<Solid<f64>>(&self.body, self.gradient, self.memory).0
    }

    pub fn volumetric_strain(&self) -> f64 {
        strain::volume_change::<Solid<f64>>(self.gradient)
    }

    /// Per reference volume.
    pub fn elastic_energy(&self) -> f64 {
        stored_energy::<Solid<f64>>(&self.body, self.gradient, self.memory)
    }
}

/// A viscous strain with the components that its unit determinant gives on the axes that the scene lacks.
fn in_space(memory: &[f64]) -> <Solid<f64> as Space>::Sym {
    match *memory {
        [xx] => {
            let across = inelastic::whole::<Line<f64>>(Tuple([xx])).across;
            Tuple([xx, across, across, 0.0, 0.0, 0.0])
        }
        [xx, yy, xy] => Tuple([xx, yy, inelastic::whole::<Plane<f64>>(Tuple([xx, yy, xy])).across, xy, 0.0, 0.0]),
        _ => Tuple(std::array::from_fn(|k| memory[k])),
    }
}
