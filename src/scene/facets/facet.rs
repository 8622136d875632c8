//! A facet by itself.

use glam::DVec3;

/// A piece of surface at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// On the surface (m); 0 on the unused axes.
    pub position: DVec3,
    /// Outward, of length 1.
    pub normal: DVec3,
    /// Area (m2), in 2D length (m), in 1D 1.
    pub area: f64,
}
