//! The colour of the bodies touched, c_a = sum V_b W_ab over the particles b of the bodies that a's body touches, is
//! about a half where a lies on their surface and one deep inside. Where it exceeds a threshold c0 it costs energy,
//!
//! U = (k/2) sum V_a <c_a - c0>^2, < > the positive part, k in energy per volume, V reference volumes,
//!
//! W the scene's kernel over the present positions, its support the range. The force on a, its exact derivative, is
//! -k sum V_a V_b (<c_a - c0> + <c_b - c0>) grad_a W_ab: central for each pair, so that momentum and angular momentum
//! are kept to rounding, and energy to the integrator's error. Smooth over many particles, it hardly feels a lattice.
//! Two full particles could sit in one place: the energy is finite. Twin: shaders/pass/{sum_colour,contact_force}.wgsl
