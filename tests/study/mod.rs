//! The studies, by their command and by the library.

mod ablate;
mod accuracy;
mod atlas;
mod buckling;
mod cost;
mod stability;
mod tensile;
