//! Numbers in a row with the arithmetic of a linear space.

use super::Real;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Index, IndexMut, Mul, Sub};

/// N numbers with the arithmetic of a linear space; every vector and tensor is one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(transparent)]
pub struct Tuple<R, const N: usize>(pub [R; N]);

// SAFETY: a transparent array of plain numbers, without padding.
unsafe impl<R: Real, const N: usize> bytemuck::Zeroable for Tuple<R, N> {}
// SAFETY: as above; every bit pattern is valid.
unsafe impl<R: Real, const N: usize> bytemuck::Pod for Tuple<R, N> {}

impl<R: Real, const N: usize> Default for Tuple<R, N> {
    #[inline(always)]
    fn default() -> Self {
        Self([R::default(); N])
    }
}
impl<R: Real, const N: usize> Add for Tuple<R, N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}
impl<R: Real, const N: usize> AddAssign for Tuple<R, N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        for k in 0..N {
            self.0[k] += other.0[k];
        }
    }
}
impl<R: Real, const N: usize> Sub for Tuple<R, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] -= other.0[k];
        }
        self
    }
}
impl<R: Real, const N: usize> Mul<R> for Tuple<R, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, scale: R) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k] * scale;
        }
        self
    }
}
impl<R, const N: usize> Index<usize> for Tuple<R, N> {
    type Output = R;
    #[inline(always)]
    fn index(&self, k: usize) -> &R {
        &self.0[k]
    }
}
impl<R, const N: usize> IndexMut<usize> for Tuple<R, N> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut R {
        &mut self.0[k]
    }
}

/// What [`Space`](super::Space) asks of its vector and tensor types; implemented by [`Tuple`] alone.
pub trait Linear<R>:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + bytemuck::Pod
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<R, Output = Self>
    + Index<usize, Output = R>
    + IndexMut<usize>
    + 'static
{
    /// Numbers stored, padding included.
    const LENGTH: usize;
}
impl<R: Real, const N: usize> Linear<R> for Tuple<R, N> {
    const LENGTH: usize = N;
}
