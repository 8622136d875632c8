//! The orthographic camera.

use glam::DVec3;

/// Direction of the eye in 3D unless the view names one: x to the lower right, z up.
const OBLIQUE: [f64; 3] = [0.55, -1.0, 0.5];

/// An orthographic camera: its axes in the scene, and where its window lies along them.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    right: DVec3,
    up: DVec3,
    towards: DVec3,
    pub middle: DVec3,
    /// Pixels per unit of length.
    pub scale: f64,
}

impl Camera {
    /// Looks along -z in 1D and 2D, else from `eye` with z up, at the whole of `bounds`.
    pub fn new(bounds: [DVec3; 2], dimension: usize, eye: Option<[f64; 3]>, [width, height]: [f64; 2]) -> Self {
        let towards = match dimension {
            3 => DVec3::from(eye.unwrap_or(OBLIQUE)).try_normalize().unwrap_or(DVec3::Z),
            _ => DVec3::Z,
        };
        // Seen along z, as every 2D scene is, y is up.
        let above = if towards.z.abs() > 0.999 { DVec3::Y } else { DVec3::Z };
        let right = above.cross(towards).normalize();
        let up = towards.cross(right);
        let half = 0.5 * (bounds[1] - bounds[0]);
        let wide = right.abs().dot(half).max(1e-300);
        let high = up.abs().dot(half).max(1e-300);
        let scale = 0.5 * (width / wide).min(height / high);
        Self { right, up, towards, middle: 0.5 * (bounds[0] + bounds[1]), scale }
    }

    /// Pixels to the right, up and towards the eye from the middle of the window.
    pub fn project(&self, point: [f64; 3]) -> DVec3 {
        let from_middle = DVec3::from(point) - self.middle;
        self.scale * DVec3::new(self.right.dot(from_middle), self.up.dot(from_middle), self.towards.dot(from_middle))
    }

    /// The directions of x, y and z in the picture, for the triad.
    pub fn triad(&self) -> [[f64; 2]; 3] {
        DVec3::AXES.map(|axis| [self.right.dot(axis), self.up.dot(axis)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_eye_looks_from_where_it_is() {
        let camera = Camera::new([DVec3::ZERO, DVec3::ONE], 3, Some([1.0, 0.0, 0.0]), [100.0, 100.0]);
        let near = camera.project([1.0, 0.5, 0.5]);
        assert!(near.z > 0.0 && near.x.abs() < 1e-9 && near.y.abs() < 1e-9);
        // From the x axis y points right and z up.
        assert!(camera.project([0.5, 1.0, 0.5]).x > 0.0 && camera.project([0.5, 0.5, 1.0]).y > 0.0);
    }
}
