//! Contact laws: what each keeps, in oblique collisions of two discs; what those keep not that Fuller's method and the
//! kernel make of contact; and that forces are derivatives of energies.

mod discs;
mod kept;
mod kernel;
mod list;
mod surfaces;
mod zones;
