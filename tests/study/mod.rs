//! The studies, by their command and by the library.

mod accuracy;
mod atlas;
mod buckling;
mod stability;
mod tensile;
