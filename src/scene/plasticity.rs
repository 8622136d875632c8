//! The numbers of a J2 material, and what a scene that yields cannot have beside it.

use super::SceneBody;
use super::file::{File, Hardening, MaterialTable};
use super::refuse::Refuse;
use crate::material::Law;
use crate::method::Formulation;

/// Yield stress, and coefficient and exponent of the hardening; 0, 0 and 1 for laws that do not yield.
///
/// # Errors
/// What the material is or lacks, to follow its name.
pub(super) fn numbers(material: &MaterialTable) -> Result<(f64, [f64; 2]), String> {
    if material.law != Law::J2 {
        return match (material.yield_stress, material.hardening) {
            (None, None) => Ok((0.0, [0.0, 1.0])),
            _ => Err("has a yield_stress or hardening, which only the law `j2` takes".into()),
        };
    }
    let Some(stress) = material.yield_stress else {
        return Err("yields: it needs a yield_stress".into());
    };
    if !(stress > 0.0 && stress.is_finite()) {
        return Err(format!("needs a positive yield_stress, found {stress}"));
    }
    let [modulus, exponent] = match material.hardening {
        None => [0.0, 1.0],
        Some(Hardening::Linear(modulus)) => [modulus, 1.0],
        Some(Hardening::Power { coefficient, exponent }) => [coefficient, exponent],
    };
    if !(modulus >= 0.0 && modulus.is_finite()) {
        return Err(format!("needs a hardening that is not negative, found {modulus}: it would soften"));
    }
    if !(exponent > 0.0 && exponent <= 1.0) {
        return Err(format!("needs a hardening exponent above 0 and up to 1, found {exponent}"));
    }
    // Without hardening the power does not matter, and there is a closed form.
    Ok((stress, if modulus == 0.0 { [0.0, 1.0] } else { [modulus, exponent] }))
}

pub(super) fn check(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<(), String> {
    if bodies.iter().all(|body| body.law != Law::J2) {
        return Ok(());
    }
    refuse.unless(file.formulation.kind != Formulation::CorrectedKernel, &["formulation", "kind"], || {
        "the law `j2` needs formulation.kind `eulerian` or `total_lagrangian`".into()
    })?;
    let adds_up = file.formulation.dissipated_energy;
    refuse.unless(file.quasi_static.is_none() || !adds_up, &["formulation", "dissipated_energy"], || {
        "dissipated_energy adds up plastic work step by step in time, and a quasi_static scene has none".into()
    })
}
