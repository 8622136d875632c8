//! Rates of volumetric strain, Fuller (2.21), and of deviatoric stress, (2.45), for the Runge-Kutta stages.
//! Twin: shaders/pass/stress_rate.wgsl

use super::Stage;
use crate::material;
use crate::method::Density;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    if state.method.shear {
        let mut rates = std::mem::take(&mut state.columns.deviatoric_stress_rate);
        super::write(&mut rates, |a, slot| {
            let gradient = state.columns.velocity_gradient[a];
            let spun = S::mat_mat(S::skew_part(gradient), S::mat_of_sym(state.columns.deviatoric_stress[a]));
            // Omega S - S Omega is twice the symmetric part of Omega S.
            let rotation = S::sym_part(spun) * S::Real::of(2.0);
            *slot = material::deviatoric_rate::<S>(state.body(a).shear_modulus, gradient) + rotation;
        });
        state.columns.deviatoric_stress_rate = rates;
    }
    if state.method.density == Density::Continuity {
        let mut rates = std::mem::take(&mut state.columns.volumetric_strain_rate);
        super::write(&mut rates, |a, slot| {
            let trace = S::trace(state.columns.velocity_gradient[a]);
            *slot = (S::Real::of(1.0) + state.columns.volumetric_strain[a]) * trace;
        });
        state.columns.volumetric_strain_rate = rates;
    }
}
