//! Bodies and random deformations that the tests of the laws share.

use super::Random;
use lithosph::material::{self, Law, Memory};
use lithosph::rows::Body;
use lithosph::tensor::{Real, Space};

pub const LAWS: [Law; 4] = [Law::StVenantKirchhoff, Law::NeoHookean, Law::Maxwell, Law::J2];

/// The plate of Shutov & Klyuchantsev 2019; viscosity 1 where it has one, and yield at a fifth of the shear modulus.
pub fn body<R: Real>(law: Law) -> Body<R> {
    let plate = Body {
        density: R::of(3.0),
        bulk_modulus: R::of(5.833),
        shear_modulus: R::of(1.25),
        youngs_modulus: R::of(3.5),
        ..Body::default()
    };
    match law {
        Law::J2 => metal(plate, [0.25, 0.25, 1.0]),
        Law::Maxwell => plate.with(law, &[R::of(1.0)]),
        _ => plate.with(law, &[]),
    }
}

/// The same body as a metal of a yield stress, the factor of its hardening and its exponent.
pub fn metal<R: Real>(body: Body<R>, numbers: [f64; 3]) -> Body<R> {
    let body = Body { yield_stress: R::of(numbers[0]), ..body };
    body.with(Law::HartmannNeff, &[]).with(Law::J2, &numbers.map(R::of))
}

/// What remembers an inelastic strain and a plastic strain.
pub fn remembering<S: Space>(strain: S::Sym, plastic: S::Real) -> Memory<S> {
    Memory { strain, plastic, ..Memory::default() }
}

/// H with components up to a size.
pub fn gradient<S: Space>(random: &mut Random, size: f64) -> S::Mat {
    let mut h = S::Mat::default();
    for i in 0..S::DIMENSION {
        for j in 0..S::DIMENSION {
            h[S::mat_index(i, j)] = S::Real::of(size * random.signed());
        }
    }
    h
}

/// C_i - 1 with a unit determinant, as steps at random deformations leave it.
pub fn memory<S: Space>(random: &mut Random, size: f64) -> S::Sym {
    let body = body::<S::Real>(Law::Maxwell);
    let step = S::Real::of(0.5);
    (0..3).fold(S::Sym::default(), |memory, _| {
        let h = gradient::<S>(random, size);
        material::relax::<S>(&body, h, remembering(memory, S::Real::of(0.0)), step).strain
    })
}

/// Q - 1 of a random rotation Q.
pub fn rotation<S: Space>(random: &mut Random) -> S::Mat {
    let mut turn = S::mat_identity();
    for (i, j) in [(0, 1), (1, 2), (0, 2)] {
        if j < S::DIMENSION {
            let (sin, cos) = (3.0 * random.signed()).sin_cos();
            let mut one = S::mat_identity();
            for (place, value) in [((i, i), cos), ((j, j), cos), ((i, j), -sin), ((j, i), sin)] {
                one[S::mat_index(place.0, place.1)] = S::Real::of(value);
            }
            turn = S::mat_mat(one, turn);
        }
    }
    turn - S::mat_identity()
}

/// H of the first deformation followed by the second: F'F - 1.
pub fn then<S: Space>(first: S::Mat, second: S::Mat) -> S::Mat {
    first + second + S::mat_mat(second, first)
}

/// Components (row, column) in order.
pub fn components<S: Space>(m: S::Mat) -> Vec<f64> {
    (0..S::DIMENSION).flat_map(|i| (0..S::DIMENSION).map(move |j| m[S::mat_index(i, j)].f64())).collect()
}

/// A tensor of one space in another of any precision; what does not fit is dropped, what lacks is zero.
pub fn embedded<A: Space, B: Space>(m: A::Mat) -> B::Mat {
    let mut out = B::Mat::default();
    let shared = A::DIMENSION.min(B::DIMENSION);
    for i in 0..shared {
        for j in 0..shared {
            out[B::mat_index(i, j)] = B::Real::of(m[A::mat_index(i, j)].f64());
        }
    }
    out
}

/// Largest difference of two tensors.
pub fn apart<S: Space>(a: S::Mat, b: S::Mat) -> f64 {
    size::<S>(a - b)
}

pub fn size<S: Space>(m: S::Mat) -> f64 {
    super::largest(components::<S>(m))
}
