//! The laws of the Total Lagrangian formulation: stress is the derivative of the energy, whatever turns with the
//! body turns the stress, the plane and the line are slices of space, and f32 keeps the digits of small strains.

use crate::common::Random;
use crate::common::deformation::*;
use lithosph::material::{first_piola, inelastic, relax, stored_energy, strain};
use lithosph::tensor::{Line, Plane, Real, Solid, Space, Tuple};

const SAMPLES: usize = 200;

fn stress_is_the_derivative_of_energy<S: Space<Real = f64>>() {
    let (mut random, mut worst) = (Random(1), 0.0_f64);
    for law in LAWS {
        let body = body::<f64>(law);
        for _ in 0..SAMPLES {
            let (h, memory) = (gradient::<S>(&mut random, 0.25), memory::<S>(&mut random, 0.2));
            let stress = first_piola::<S>(&body, h, memory);
            let mut slope = S::Mat::default();
            for k in (0..S::DIMENSION).flat_map(|i| (0..S::DIMENSION).map(move |j| S::mat_index(i, j))) {
                let at = |by: f64| {
                    let mut moved = h;
                    moved[k] += by;
                    stored_energy::<S>(&body, moved, memory)
                };
                // Of fourth order.
                let e = 1e-3;
                slope[k] = (8.0 * (at(e) - at(-e)) - (at(2.0 * e) - at(-2.0 * e))) / (12.0 * e);
            }
            worst = worst.max(apart::<S>(stress, slope) / size::<S>(stress).max(body.shear_modulus));
        }
    }
    println!("{} dimensions: P - d psi/dF {worst:.1e}", S::DIMENSION);
    assert!(worst < 1e-7, "{worst:e}");
}

#[test]
fn stress_is_the_derivative_of_energy_in_every_dimension() {
    stress_is_the_derivative_of_energy::<Line<f64>>();
    stress_is_the_derivative_of_energy::<Plane<f64>>();
    stress_is_the_derivative_of_energy::<Solid<f64>>();
}

fn stress_turns_with_the_body<S: Space<Real = f64>>() {
    let mut random = Random(2);
    for law in LAWS {
        let body = body::<f64>(law);
        for _ in 0..SAMPLES {
            let (h, memory) = (gradient::<S>(&mut random, 0.25), memory::<S>(&mut random, 0.2));
            let turn = rotation::<S>(&mut random);
            let turned = then::<S>(h, turn);
            let (before, after) = (stored_energy::<S>(&body, h, memory), stored_energy::<S>(&body, turned, memory));
            assert!((before - after).abs() < 1e-13 * (1.0 + before), "{law:?}: {before} {after}");
            let wanted = first_piola::<S>(&body, h, memory);
            let wanted = wanted + S::mat_mat(turn, wanted);
            assert!(apart::<S>(first_piola::<S>(&body, turned, memory), wanted) < 1e-13 * (1.0 + size::<S>(wanted)), "{law:?}");
            let (a, b) =
                (relax::<S>(&body, h, remembering(memory, 0.1), 0.3), relax::<S>(&body, turned, remembering(memory, 0.1), 0.3));
            assert!(
                apart::<S>(S::mat_of_sym(a.strain), S::mat_of_sym(b.strain)) < 1e-14 && (a.plastic - b.plastic).abs() < 1e-14,
                "{law:?}"
            );
        }
    }
}

#[test]
fn stress_turns_with_the_body_in_plane_and_space() {
    stress_turns_with_the_body::<Plane<f64>>();
    stress_turns_with_the_body::<Solid<f64>>();
}

/// The stress of a rotation, relative to the shear modulus.
fn stress_of_rotations<S: Space>() -> f64 {
    let mut random = Random(3);
    let mut worst = 0.0_f64;
    for law in LAWS {
        for _ in 0..SAMPLES {
            let turn = rotation::<S>(&mut random);
            worst = worst.max(size::<S>(first_piola::<S>(&body(law), turn, S::Sym::default())) / 1.25);
        }
    }
    worst
}

#[test]
fn a_rotation_makes_no_stress() {
    let errors = [stress_of_rotations::<Plane<f64>>(), stress_of_rotations::<Solid<f64>>()];
    let single = [stress_of_rotations::<Plane<f32>>(), stress_of_rotations::<Solid<f32>>()];
    println!("stress of rotations over mu: f64 {errors:?}, f32 {single:?}");
    assert!(errors.iter().all(|e| *e < 1e-14) && single.iter().all(|e| *e < 6e-6), "{errors:?} {single:?}");
}

/// The viscous strain of a space in three dimensions.
fn memory_in_space<S: Space<Real = f64>>(memory: S::Sym) -> <Solid<f64> as Space>::Sym {
    let mut full = embedded::<S, Solid<f64>>(S::mat_of_sym(memory));
    for k in S::DIMENSION..3 {
        full[Solid::<f64>::mat_index(k, k)] = inelastic::whole::<S>(memory).across;
    }
    Solid::<f64>::sym_part(full)
}

fn is_a_slice_of_space<S: Space<Real = f64>>() {
    let mut random = Random(4);
    for law in LAWS {
        let body = body::<f64>(law);
        for _ in 0..SAMPLES {
            let (h, memory) = (gradient::<S>(&mut random, 0.25), memory::<S>(&mut random, 0.2));
            let (whole, full) = (embedded::<S, Solid<f64>>(h), memory_in_space::<S>(memory));
            let determinant = strain::volume_change::<Solid<f64>>(Solid::<f64>::mat_of_sym(full));
            assert!(determinant.abs() < 1e-15, "{determinant:e}");
            let seen = embedded::<Solid<f64>, S>(first_piola::<Solid<f64>>(&body, whole, full));
            assert!(apart::<S>(seen, first_piola::<S>(&body, h, memory)) < 1e-14 * (1.0 + size::<S>(seen)), "{law:?}");
            let energies = [stored_energy::<S>(&body, h, memory), stored_energy::<Solid<f64>>(&body, whole, full)];
            assert!((energies[0] - energies[1]).abs() < 1e-14, "{law:?}: {energies:?}");
            let seen = relax::<Solid<f64>>(&body, whole, remembering(full, 0.1), 0.3);
            let wanted = relax::<S>(&body, h, remembering(memory, 0.1), 0.3);
            assert!((seen.plastic - wanted.plastic).abs() < 1e-15);
            let (seen, wanted) = (seen.strain, memory_in_space::<S>(wanted.strain));
            assert!((seen - wanted).0.iter().all(|e| e.abs() < 1e-15), "{law:?}: {seen:?} {wanted:?}");
        }
    }
}

#[test]
fn plane_and_line_are_slices_of_space() {
    is_a_slice_of_space::<Plane<f64>>();
    is_a_slice_of_space::<Line<f64>>();
}

/// Largest error of f32 stresses relative to the stress, at strains of a size.
fn error_of_f32<W: Space<Real = f64>, N: Space<Real = f32>>(strain: f64) -> f64 {
    let (mut random, mut worst) = (Random(5), 0.0_f64);
    for law in LAWS {
        for _ in 0..SAMPLES {
            let h = gradient::<N>(&mut random, strain);
            let memory = memory::<N>(&mut random, strain);
            let mut wide = W::Sym::default();
            for i in 0..W::DIMENSION {
                for j in 0..=i {
                    wide[W::sym_index(i, j)] = memory[N::sym_index(i, j)].f64();
                }
            }
            let truth = first_piola::<W>(&body(law), embedded::<N, W>(h), wide);
            let seen = embedded::<N, W>(first_piola::<N>(&body(law), h, memory));
            // On the line the pressure and the deviator of a law that remembers may cancel.
            let least = body::<f64>(law).shear_modulus * strain;
            worst = worst.max(apart::<W>(truth, seen) / size::<W>(truth).max(least));
        }
    }
    worst
}

#[test]
fn single_precision_keeps_the_digits_of_small_strains() {
    for strain in [1e-6, 1e-4, 1e-2] {
        let errors = [
            error_of_f32::<Line<f64>, Line<f32>>(strain),
            error_of_f32::<Plane<f64>, Plane<f32>>(strain),
            error_of_f32::<Solid<f64>, Solid<f32>>(strain),
        ];
        println!("strain {strain:.0e}: f32 stress off by {errors:?}");
        assert!(errors.iter().all(|error| *error < 1e-6), "{errors:?}");
    }
}

#[test]
fn small_strains_are_linear_elastic() {
    type S = Solid<f64>;
    let mut random = Random(6);
    for law in LAWS {
        let body = body::<f64>(law);
        for size_of_strain in [1e-3, 1e-5, 1e-7] {
            let h = gradient::<S>(&mut random, size_of_strain);
            let strain = S::sym_part(h);
            let lambda = body.bulk_modulus - 2.0 / 3.0 * body.shear_modulus;
            let wanted = S::mat_of_sym(strain * (2.0 * body.shear_modulus) + S::diagonal(lambda * S::sym_trace(strain)));
            let error = apart::<S>(first_piola::<S>(&body, h, Tuple::default()), wanted) / size::<S>(wanted);
            assert!(error < 20.0 * size_of_strain, "{law:?} at {size_of_strain:e}: {error:e}");
            let energy = stored_energy::<S>(&body, h, Tuple::default());
            let wanted = 0.5 * S::trace(S::mat_mat(wanted, S::mat_of_sym(strain)));
            assert!((energy / wanted - 1.0).abs() < 20.0 * size_of_strain, "{law:?}: {energy:e} {wanted:e}");
        }
    }
}

#[test]
fn cube_roots_keep_their_digits() {
    for k in 0..400 {
        let x = 10f64.powf(-12.0 + 0.03 * f64::from(k)) * if k % 2 == 0 { 1.0 } else { -0.98 };
        let wanted = (x.ln_1p() / 3.0).exp_m1();
        let error = (strain::cube_root_change(x) / wanted - 1.0).abs();
        assert!(error < 2e-15, "{x}: {error:e}");
        let single = strain::cube_root_change(x as f32);
        let wanted = (f64::from(x as f32).ln_1p() / 3.0).exp_m1();
        assert!((f64::from(single) / wanted - 1.0).abs() < 4e-7, "{x}: {single}");
    }
}
