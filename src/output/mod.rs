//! What a run leaves behind: columns of numbers, particles for ParaView, and pictures.
//!
//! Everything here starts from a [`Snapshot`], the host's f64 view of one moment; nothing here
//! knows a scene, a pass or a law.
//!
//! | file | written by | read back by |
//! |---|---|---|
//! | `series.csv` | [`csv::Series`], one row an output | [`csv::read`] |
//! | `particles/*.vtkhdf`, `particles.vtkhdf` | `vtkhdf`, a file for each frame and a master | ParaView, `lithosph render` |
//! | `frames/*.png` | [`impostor::draw`] on a GPU, else [`splat::splat`] | people |
//!
//! [`durable`] puts whole files into their places, [`manifest`] keeps a list of them, and [`lock`] keeps a second run out.
//!
//! The two painters share everything but the filling of pixels: [`picture::compose`] places the
//! particles, and [`picture::Picture::finish`] adds the colour bar, the axes and the caption.

pub mod axis;
pub mod camera;
pub mod colour;
pub mod csv;
pub mod durable;
mod follow;
pub mod impostor;
mod ink;
pub mod lock;
pub mod manifest;
#[cfg(feature = "hdf5")]
pub mod memory_file;
pub mod overlay;
pub mod picture;
#[cfg(test)]
mod samples;
pub mod snapshot;
pub mod splat;
#[cfg(feature = "hdf5")]
pub mod vtkhdf;

pub use follow::follow;
pub use picture::View;
pub use snapshot::{Column, Snapshot};

use std::io::Cursor;
use std::path::Path;

/// What paints: the splatter, or a GPU. On a software adapter the splatter is 2.5 times faster.
pub enum Painter {
    Splat,
    Gpu { device: wgpu::Device, queue: wgpu::Queue },
}

impl Painter {
    /// A hardware adapter if there is one, or with `any` a software adapter too, else the splatter.
    pub fn choose(any: bool) -> Result<Self, String> {
        use crate::backend::device::{Want, choose};
        let Some(adapter) = choose(if any { Want::Gpu } else { Want::Auto }, None)? else { return Ok(Self::Splat) };
        let wanted = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
        let opened = pollster::block_on(adapter.request_device(&wanted));
        let (device, queue) = opened.map_err(|e| format!("cannot open the adapter for pictures: {e}"))?;
        Ok(Self::Gpu { device, queue })
    }

    pub fn paint(&self, snapshot: &Snapshot, view: &View) -> Result<image::RgbaImage, String> {
        match self {
            Self::Splat => splat::splat(snapshot, view),
            Self::Gpu { device, queue } => impostor::draw(device, queue, snapshot, view),
        }
    }
}

/// The bytes of `image` as PNG.
pub fn png(image: &image::RgbaImage) -> Result<Vec<u8>, String> {
    let mut bytes = Cursor::new(Vec::new());
    let written = image.write_to(&mut bytes, image::ImageFormat::Png);
    written.map(|()| bytes.into_inner()).map_err(|error| format!("cannot make a picture of {} pixels: {error}", image.len() / 4))
}

/// Writes `image` as PNG, so that a kill never leaves half a picture.
pub fn save_png(path: &Path, image: &image::RgbaImage) -> Result<(), String> {
    durable::put(path, &[&png(image)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_survives_the_disk_and_leaves_nothing_aside() {
        let path = std::env::temp_dir().join(format!("lithosph-png-{}.png", std::process::id()));
        let image = image::RgbaImage::from_fn(5, 3, |x, y| image::Rgba([x as u8 * 40, y as u8 * 80, 7, 255]));
        save_png(&path, &image).unwrap();
        assert_eq!(image::open(&path).unwrap().to_rgba8(), image);
        assert!(!durable::aside(&path).exists());
        std::fs::remove_file(&path).unwrap();
    }

    #[test]
    fn png_in_a_missing_folder_is_an_error() {
        let image = image::RgbaImage::new(1, 1);
        assert!(save_png(Path::new("/nonexistent/x.png"), &image).unwrap_err().contains("x.png"));
    }
}
