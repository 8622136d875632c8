//! What a strength is asked and answers, and what a particle remembers. Twin: shaders/lib/flow.wgsl and
//! shaders/lib/memory.wgsl

use crate::tensor::Space;

/// The state in which a strength is asked for the stress that it bears.
#[derive(Debug, Clone, Copy)]
pub struct Point<R> {
    /// Equivalent plastic strain.
    pub strain: R,
    /// Rate of the equivalent plastic strain, 1/time.
    pub rate: R,
    pub temperature: R,
}

/// What a strength bears at a [`Point`]: a Mises stress, and its derivatives by the plastic strain and by its rate.
#[derive(Debug, Clone, Copy)]
pub struct Flow<R> {
    pub stress: R,
    pub by_strain: R,
    pub by_rate: R,
}

/// What a particle of finite strain remembers.
#[derive(Debug, Clone, Copy)]
pub struct Memory<S: Space> {
    /// C_i - 1, the inelastic strain.
    pub strain: S::Sym,
    /// Equivalent plastic strain.
    pub plastic: S::Real,
    pub temperature: S::Real,
}

impl<S: Space> Default for Memory<S> {
    fn default() -> Self {
        Self { strain: S::Sym::default(), plastic: S::Real::default(), temperature: S::Real::default() }
    }
}
