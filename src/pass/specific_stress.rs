//! Stress in the form that the pair force sums: sigma/rho^2 (plain) or sigma K^-1 (adjoint), and the
//! artificial stress R. Twin: shaders/pass/specific_stress.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::material;
use crate::method::{ArtificialForm, Gradient};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "stress in the form that the pair force sums, and the artificial stress",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[VolumetricStrain]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.shears(), &[DeviatoricStress]),
            when(|m| m.adjoint(), &[Correction]),
        ],
        neighbours: &[],
        writes: &[
            when(|m| m.adjoint(), &[CorrectedStress]),
            when(|m| !m.adjoint(), &[SpecificStress]),
            when(|m| m.scalar_form(), &[ArtificialPressure]),
            when(|m| m.principal_form(), &[ArtificialStress]),
        ],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.method.gradient == Gradient::Adjoint {
        fill!(state, corrected_stress, |a, slot| {
            *slot = S::mat_mat(S::mat_of_sym(stress(state, a)), state.columns.correction[a]);
        });
    } else {
        fill!(state, specific_stress, |a, slot| *slot = stress(state, a) * square_of_volume(state, a));
    }
    match state.method.artificial_stress {
        Some(ArtificialForm::Scalar) => {
            fill!(state, artificial_pressure, |a, slot| {
                let pressure = material::pressure(state.body(a), state.columns.volumetric_strain[a]);
                let tension = (-pressure).max(S::Real::of(0.0));
                *slot = -state.artificial_epsilon(a) * tension * square_of_volume(state, a);
            });
        }
        Some(ArtificialForm::Principal) => {
            fill!(state, artificial_stress, |a, slot| {
                let tension = tensile_part::<S>(stress(state, a));
                *slot = tension * (-state.artificial_epsilon(a) * square_of_volume(state, a));
            });
        }
        None => {}
    }
}

/// 1/rho^2
#[inline(always)]
fn square_of_volume<S: Space>(state: &State<S>, a: usize) -> S::Real {
    let specific_volume = S::Real::of(1.0) / state.density(a);
    specific_volume * specific_volume
}

/// sigma = -P 1 + S, Fuller (2.29) with the sign mended.
#[inline(always)]
pub fn stress<S: Space>(state: &State<S>, a: usize) -> S::Sym {
    let pressure = material::pressure(state.body(a), state.columns.volumetric_strain[a]);
    let sigma = S::diagonal(-pressure);
    if state.method.shear { sigma + state.columns.deviatoric_stress[a] } else { sigma }
}

/// The tensor with its compressive principal values set to zero: Gray, Monaghan & Swift 2001.
///
/// Jacobi rotations: in the plane one is exact; in space five sweeps reach rounding. The shader does the
/// same, since a driver's atan2 is only good to five digits.
#[inline(always)]
fn tensile_part<S: Space>(stress: S::Sym) -> S::Sym {
    let (mut m, mut axes) = (S::mat_of_sym(stress), S::mat_identity());
    let sweeps = if S::DIMENSION == 3 { 5 } else { 1 };
    for _ in 0..sweeps {
        for p in 0..S::DIMENSION {
            for q in p + 1..S::DIMENSION {
                jacobi::<S>(&mut m, &mut axes, p, q);
            }
        }
    }
    let mut kept = S::Mat::default();
    for k in 0..S::DIMENSION {
        kept[S::mat_index(k, k)] = m[S::mat_index(k, k)].max(S::Real::of(0.0));
    }
    S::sym_part(S::mat_mat(S::mat_mat(axes, kept), S::transpose(axes)))
}

/// One Jacobi rotation in the plane of the axes p and q, after which the component (p, q) is 0.
#[inline(always)]
fn jacobi<S: Space>(m: &mut S::Mat, axes: &mut S::Mat, p: usize, q: usize) {
    let (one, zero) = (S::Real::of(1.0), S::Real::of(0.0));
    let shear = m[S::mat_index(p, q)];
    if shear == zero {
        return;
    }
    let theta = (m[S::mat_index(q, q)] - m[S::mat_index(p, p)]) / (S::Real::of(2.0) * shear);
    let sign = if theta < zero { -one } else { one };
    let tangent = sign / (theta.abs() + (theta * theta + one).sqrt());
    let cosine = one / (tangent * tangent + one).sqrt();
    let sine = tangent * cosine;
    let mut rotation = S::mat_identity();
    rotation[S::mat_index(p, p)] = cosine;
    rotation[S::mat_index(q, q)] = cosine;
    rotation[S::mat_index(p, q)] = sine;
    rotation[S::mat_index(q, p)] = -sine;
    *m = S::mat_mat(S::mat_mat(S::transpose(rotation), *m), rotation);
    *axes = S::mat_mat(*axes, rotation);
}
