//! Options of `formulation.kind = "corrected_kernel"`, the method of Shutov & Klyuchantsev 2019: as typed, and with
//! what is usual where nothing is typed.

use super::file::{File, FormulationTable};
use super::refuse::Refuse;
use crate::method::{Configuration, CorrectedKernel, Deformation, Formulation};

/// The paper's own choice: corrected sums in the current configuration, F from its rate.
fn chosen(f: &FormulationTable) -> CorrectedKernel {
    let configuration = f.configuration.unwrap_or_default();
    let usual = if configuration == Configuration::Current { Deformation::Evolved } else { Deformation::Reference };
    CorrectedKernel {
        correction: f.correction.unwrap_or(true),
        configuration,
        deformation: f.deformation.unwrap_or(usual),
        velocity_gradient: f.velocity_gradient.unwrap_or_default(),
    }
}

/// The options if the scene is of this kind.
///
/// # Errors
/// One sentence where they are typed and it is not, or where they exclude each other.
pub(super) fn options(file: &File, refuse: &Refuse) -> Result<Option<CorrectedKernel>, String> {
    let f = &file.formulation;
    let own = [
        ("correction", f.correction.is_some()),
        ("configuration", f.configuration.is_some()),
        ("deformation", f.deformation.is_some()),
        ("velocity_gradient", f.velocity_gradient.is_some()),
    ];
    if f.kind != Formulation::CorrectedKernel {
        return match own.iter().find(|(_, named)| *named) {
            Some((word, _)) => {
                Err(refuse.at(&["formulation", word], format!("{word} belongs to formulation.kind `corrected_kernel`")))
            }
            None => Ok(None),
        };
    }
    let options = chosen(f);
    consistent(options, f, refuse)?;
    foreign(file, refuse)?;
    Ok(Some(options))
}

fn consistent(options: CorrectedKernel, f: &FormulationTable, refuse: &Refuse) -> Result<(), String> {
    refuse.unless(options.current() || !options.evolved(), &["formulation", "deformation"], || {
        "deformation `evolved` integrates the velocity gradient of the current configuration: \
         with configuration `reference` it must be `reference`"
            .into()
    })?;
    refuse.unless(options.evolved() || f.velocity_gradient.is_none(), &["formulation", "velocity_gradient"], || {
        "velocity_gradient is summed only where deformation is `evolved`".into()
    })
}

/// What only the other formulations know.
fn foreign(file: &File, refuse: &Refuse) -> Result<(), String> {
    let f = &file.formulation;
    let words =
        [("viscosity", f.viscosity.is_some()), ("gradient", f.gradient.is_some()), ("dissipated_energy", f.dissipated_energy)];
    for (word, named) in words {
        refuse.unless(!named, &["formulation", word], || format!("formulation.kind `corrected_kernel` has no {word}"))?;
    }
    Ok(())
}
