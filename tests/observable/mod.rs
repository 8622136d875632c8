//! What is measured of a state.

mod moment;
