//! Options of `formulation.kind = "corrected_kernel"`, the method of Shutov & Klyuchantsev 2019: as typed, and with
//! what is usual where nothing is typed.

use super::file::{File, Formulation, Kind};
use super::resolve::Refuse;
use serde::{Deserialize, Serialize};

/// Where kernel sums run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Configuration {
    #[default]
    Current,
    Reference,
}

/// How the deformation gradient is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Deformation {
    /// From displacements, (8).
    Reference,
    /// From the velocity gradient, (9).
    Evolved,
}

/// Which velocities the velocity gradient (6) sums.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VelocityGradient {
    /// v_b - v_a
    #[default]
    Difference,
    /// v_b, as printed: right only where the shape functions sum to one.
    Printed,
}

/// The options of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CorrectedKernel {
    pub correction: bool,
    pub configuration: Configuration,
    pub deformation: Deformation,
    pub velocity_gradient: VelocityGradient,
}

impl CorrectedKernel {
    /// The paper's own choice: corrected sums in the current configuration, F from its rate.
    fn of(f: &Formulation) -> Self {
        let configuration = f.configuration.unwrap_or_default();
        let usual = if configuration == Configuration::Current { Deformation::Evolved } else { Deformation::Reference };
        Self {
            correction: f.correction.unwrap_or(true),
            configuration,
            deformation: f.deformation.unwrap_or(usual),
            velocity_gradient: f.velocity_gradient.unwrap_or_default(),
        }
    }

    pub fn current(self) -> bool {
        self.configuration == Configuration::Current
    }

    pub fn evolved(self) -> bool {
        self.deformation == Deformation::Evolved
    }

    /// Forces are summed where the particles are, F where they were: the neighbours of the reference configuration
    /// are kept apart.
    pub fn keeps_gradients(self) -> bool {
        self.current() && !self.evolved()
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
    if f.kind != Kind::CorrectedKernel {
        return match own.iter().find(|(_, named)| *named) {
            Some((word, _)) => {
                Err(refuse.at(&["formulation", word], format!("{word} belongs to formulation.kind `corrected_kernel`")))
            }
            None => Ok(None),
        };
    }
    let options = CorrectedKernel::of(f);
    consistent(options, f, refuse)?;
    foreign(file, refuse)?;
    Ok(Some(options))
}

fn consistent(options: CorrectedKernel, f: &Formulation, refuse: &Refuse) -> Result<(), String> {
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
