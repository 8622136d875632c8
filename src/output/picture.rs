//! What both painters share: where each particle lands in the picture, and how the filled pixels
//! become a figure.
//!
//! [`compose`] turns a snapshot and a [`View`] into discs in pixels. A painter fills
//! [`OVERSAMPLING`]² samples a pixel; [`Picture::finish`] averages them in linear light, which is
//! what smooths the edges, and draws the rest of the figure around them.

use super::axis::Axis;
use super::camera::Camera;
use super::colour::{ColourScale, decode, encode};
use super::overlay::{self, Layout};
use super::snapshot::Snapshot;
use glam::DVec3;
use image::{Rgba, RgbaImage};
use rayon::prelude::*;

/// Samples along each side of a pixel.
pub const OVERSAMPLING: u32 = 2;
/// Where the light comes from: over the left shoulder, in the axes right, up, towards the eye.
pub const LIGHT: [f32; 3] = [-0.40, 0.55, 0.733];
/// Light on a surface that faces away, and what full light adds to it.
pub const AMBIENT: f32 = 0.42;
pub const DIFFUSE: f32 = 0.62;
/// Radius in spacings: on a square or cubic lattice neighbours meet at √½, which leaves no gap that
/// would look like a hole, or as moiré along an axis of the lattice.
const RADIUS: f64 = 0.71;
/// Radius in pixels of the dots of a 1D chart.
const DOT: f32 = 3.5;
const DOT_COLOUR: [f32; 3] = [0.02, 0.09, 0.33];

/// What a picture shows and from where.
#[derive(Debug, Clone)]
pub struct View {
    pub width: u32,
    pub height: u32,
    /// A path that [`Snapshot::scalar`] takes.
    pub field: String,
    /// None takes the range of the data.
    pub range: Option<[f64; 2]>,
    /// From the middle of the scene towards the eye, for 3D.
    pub eye: Option<[f64; 3]>,
    /// Low and high corner of what to show, to hold the camera still over a sequence; in 1D only the
    /// x axis matters, as `range` gives the other one.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Time and step are added to it.
    pub caption: String,
}

impl Default for View {
    fn default() -> Self {
        Self { width: 1280, height: 960, field: String::new(), range: None, eye: None, bounds: None, caption: String::new() }
    }
}

/// A particle in the picture, in samples: x to the right, y down, z towards the eye.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Disc {
    pub centre: [f32; 3],
    /// Linear light.
    pub colour: [f32; 3],
}

/// A figure before its pixels are filled.
#[derive(Debug, Clone)]
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub discs: Vec<Disc>,
    /// The same for all discs, in samples.
    pub radius: f32,
    /// 0 paints flat discs, 1 fully shaded spheres.
    pub relief: f32,
    pub layout: Layout,
}

/// Places every particle of `snapshot` in the picture that `view` asks for.
pub fn compose(snapshot: &Snapshot, view: &View) -> Result<Picture, String> {
    if !(160..=8192).contains(&view.width) || !(120..=8192).contains(&view.height) {
        return Err(format!("a picture of {} x {} pixels is too small or too large", view.width, view.height));
    }
    let values = snapshot.scalar(&view.field)?;
    let scale = view.range.map_or_else(|| ColourScale::of(&values), ColourScale::new);
    let bounds = bounds(snapshot, view)?;
    let place = if snapshot.dimension == 1 { chart } else { body };
    Ok(place(snapshot, view, &values, scale, bounds))
}

/// Low and high corner of all particles, or of the view, with half a spacing around.
fn bounds(snapshot: &Snapshot, view: &View) -> Result<[DVec3; 2], String> {
    let [low, high] = view.bounds.map(|corners| corners.map(DVec3::from)).unwrap_or_else(|| {
        let finite = snapshot.positions.iter().map(|&p| DVec3::from(p)).filter(|p| p.is_finite());
        finite.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
    });
    if !low.is_finite() || !high.is_finite() {
        return Err("there is no particle to paint".into());
    }
    let around = DVec3::splat((RADIUS * snapshot.spacing).max(1e-12 * (high - low).length()));
    Ok([low - around, high + around])
}

/// 2D and 3D: particles as spheres coloured by the field.
fn body(snapshot: &Snapshot, view: &View, values: &[f64], scale: ColourScale, bounds: [DVec3; 2]) -> Picture {
    let flat = snapshot.dimension == 2;
    let bar = Axis::new(scale.range, 6);
    let mut layout = Layout::new(view, snapshot, if flat { 7 } else { 0 }, Some((scale, bar)));
    let plot = layout.plot;
    let [wide, high] = [(plot.right - plot.left) as f64, (plot.bottom - plot.top) as f64];
    let margin = 0.94;
    let camera = Camera::new(bounds, snapshot.dimension, view.eye, [margin * wide, margin * high]);
    let middle = [plot.left as f64 + 0.5 * wide, plot.top as f64 + 0.5 * high];
    if flat {
        let reach = [0.5 * wide / camera.scale, 0.5 * high / camera.scale];
        let shown = |k: usize| [camera.middle[k] - reach[k], camera.middle[k] + reach[k]];
        layout.axes = Some(Axis::alike([shown(0), shown(1)], [7, 6]));
    } else {
        layout.triad = Some(camera.triad());
    }
    let samples = f64::from(OVERSAMPLING);
    let discs = snapshot.positions.par_iter().zip(values).filter(|(p, _)| p.iter().all(|v| v.is_finite()));
    let discs = discs.map(|(&point, &value)| {
        let at = samples * camera.project(point);
        let centre = [samples * middle[0] + at.x, samples * middle[1] - at.y, at.z].map(|v| v as f32);
        Disc { centre, colour: scale.linear(value) }
    });
    Picture {
        width: view.width,
        height: view.height,
        discs: discs.collect(),
        // Less than a sample would leave holes where millions of particles share a pixel.
        radius: (samples * camera.scale * RADIUS * snapshot.spacing).max(0.75) as f32,
        relief: if flat { 0.3 } else { 1.0 },
        layout,
    }
}

/// 1D: the field against x as a scatter chart.
fn chart(snapshot: &Snapshot, view: &View, values: &[f64], scale: ColourScale, bounds: [DVec3; 2]) -> Picture {
    let mut layout = Layout::new(view, snapshot, 9, None);
    let wider = |[low, high]: [f64; 2], part: f64| [low - part * (high - low), high + part * (high - low)];
    let shown = [wider([bounds[0].x, bounds[1].x], 0.02), wider(scale.range, 0.06)];
    let plot = layout.plot;
    let discs = snapshot.positions.iter().zip(values).filter(|(p, v)| p[0].is_finite() && v.is_finite());
    let samples = f64::from(OVERSAMPLING);
    let discs = discs.map(|(p, &value)| {
        let right = (p[0] - shown[0][0]) / (shown[0][1] - shown[0][0]);
        let up = (value - shown[1][0]) / (shown[1][1] - shown[1][0]);
        let x = plot.left as f64 + right * (plot.right - plot.left) as f64;
        let y = plot.bottom as f64 - up * (plot.bottom - plot.top) as f64;
        Disc { centre: [(samples * x) as f32, (samples * y) as f32, 0.0], colour: DOT_COLOUR }
    });
    layout.axes = Some(shown.map(|range| Axis::new(range, 6)));
    let radius = DOT * samples as f32 * layout.scale as f32 / 2.0;
    Picture { width: view.width, height: view.height, discs: discs.collect(), radius, relief: 0.0, layout }
}

impl Picture {
    /// Samples in a row and in a column.
    pub fn samples(&self) -> [u32; 2] {
        [self.width * OVERSAMPLING, self.height * OVERSAMPLING]
    }

    /// Left, top, right and bottom of the samples that discs may fill.
    pub fn scissor(&self) -> [u32; 4] {
        let plot = self.layout.plot;
        [plot.left, plot.top, plot.right, plot.bottom].map(|edge| edge as u32 * OVERSAMPLING)
    }

    /// Nearest and farthest z of any sphere; never of no extent.
    pub fn depth(&self) -> [f32; 2] {
        let reach = |[far, near]: [f32; 2], disc: &Disc| [far.min(disc.centre[2]), near.max(disc.centre[2])];
        let [far, near] = self.discs.iter().fold([f32::INFINITY, f32::NEG_INFINITY], reach);
        if far <= near { [near + 2.0 * self.radius, far - 2.0 * self.radius] } else { [1.0, 0.0] }
    }

    /// Averages sRGB samples, row by row from the top, and draws the figure around them.
    pub fn finish(&self, samples: &[[u8; 4]]) -> RgbaImage {
        let (width, factor) = (self.width as usize, OVERSAMPLING as usize);
        let mut image = RgbaImage::from_pixel(self.width, self.height, Rgba([255; 4]));
        let stride = width * factor;
        image.par_chunks_mut(4 * width).enumerate().for_each(|(row, pixels)| {
            for (column, pixel) in pixels.as_chunks_mut::<4>().0.iter_mut().enumerate() {
                let mut sum = [0.0; 3];
                for k in 0..factor * factor {
                    let sample = samples[(row * factor + k / factor) * stride + column * factor + k % factor];
                    (0..3).for_each(|channel| sum[channel] += decode(sample[channel]));
                }
                (0..3).for_each(|channel| pixel[channel] = encode(sum[channel] / (factor * factor) as f32));
            }
        });
        overlay::draw(&mut image, &self.layout);
        image
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{bar, cube, ring, view};
    use super::*;

    #[test]
    fn every_particle_lands_inside_the_plot() {
        for (shot, field) in [(ring(), "pressure"), (cube(10), "von_mises"), (bar(), "pressure")] {
            let picture = compose(&shot, &view(field)).unwrap();
            let [left, top, right, bottom] = picture.scissor().map(|edge| edge as f32);
            assert_eq!(picture.discs.len(), shot.positions.len());
            for Disc { centre: [x, y, _], .. } in &picture.discs {
                assert!(*x > left && *x < right && *y > top && *y < bottom, "{x} {y}");
            }
        }
    }

    #[test]
    fn two_dimensions_keep_their_aspect_and_y_points_up() {
        let picture = compose(&ring(), &view("pressure")).unwrap();
        let extent = |k: usize| {
            let values = picture.discs.iter().map(|disc| disc.centre[k]);
            values.clone().fold(f32::MIN, f32::max) - values.fold(f32::MAX, f32::min)
        };
        assert!((extent(0) / extent(1) - 1.0).abs() < 1e-3);
        let shot = ring();
        let highest = (0..shot.positions.len()).max_by(|&a, &b| shot.positions[a][1].total_cmp(&shot.positions[b][1]));
        assert!(picture.discs[highest.unwrap()].centre[1] < 960.0 * 0.5);
    }

    #[test]
    fn fixed_bounds_hold_the_camera_still() {
        let bounds = Some([[-0.1, -0.1, 0.0], [0.1, 0.1, 0.0]]);
        let fixed = View { bounds, ..view("pressure") };
        let mut moved = ring();
        moved.positions.truncate(1);
        moved.columns[0].values.truncate(1);
        moved.columns[1].values.truncate(3);
        let (all, one) = (compose(&ring(), &fixed).unwrap(), compose(&moved, &fixed).unwrap());
        assert_eq!(all.discs[0].centre, one.discs[0].centre);
    }

    #[test]
    fn what_cannot_be_painted_is_an_error() {
        assert!(compose(&ring(), &view("presure")).unwrap_err().contains("pressure"));
        assert!(compose(&Snapshot { columns: ring().columns, ..Snapshot::default() }, &view("pressure")).is_err());
        assert!(compose(&ring(), &View { width: 3, ..view("pressure") }).unwrap_err().contains("3 x 960"));
    }
}
