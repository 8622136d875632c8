//! The painter that needs no adapter: a z-buffer on all cores.
//!
//! The picture is cut into bands of rows and each core fills its own band from all discs, so no
//! two cores meet in a sample and the result does not depend on their number.

use super::picture::{AMBIENT, DIFFUSE, LIGHT, Picture, View, compose};
use super::{colour::encode, snapshot::Snapshot};
use image::RgbaImage;
use rayon::prelude::*;

/// Rows of a band: enough bands to share out, few enough that scanning the discs costs little.
const BAND: usize = 128;
const NOTHING: u32 = u32::MAX;

/// Paints the snapshot on the CPU.
pub fn splat(snapshot: &Snapshot, view: &View) -> Result<RgbaImage, String> {
    let picture = compose(snapshot, view)?;
    let [width, height] = picture.samples().map(|side| side as usize);
    let mut samples = vec![[255; 4]; width * height];
    let bands = samples.par_chunks_mut(width * BAND).enumerate();
    bands.for_each(|(band, samples)| {
        let nearest = cover(&picture, band * BAND, samples.len() / width);
        for (k, sample) in samples.iter_mut().enumerate().filter(|(k, _)| nearest[*k] != NOTHING) {
            *sample = shade(&picture, nearest[k] as usize, k % width, band * BAND + k / width);
        }
    });
    Ok(picture.finish(&samples))
}

/// The disc nearest to the eye at each sample of the rows from `first` on.
fn cover(picture: &Picture, first: usize, rows: usize) -> Vec<u32> {
    let width = picture.samples()[0] as usize;
    let [left, top, right, bottom] = picture.scissor().map(|edge| edge as usize);
    let (top, bottom) = (top.max(first), bottom.min(first + rows));
    let mut nearest = vec![NOTHING; width * rows];
    let mut depth = vec![f32::NEG_INFINITY; width * rows];
    let radius = picture.radius;
    for (number, disc) in picture.discs.iter().enumerate() {
        let [x, y, z] = disc.centre;
        for row in span(y, radius, top, bottom) {
            let dy = row as f32 + 0.5 - y;
            for column in span(x, radius, left, right) {
                let dx = column as f32 + 0.5 - x;
                let rest = radius * radius - dx * dx - dy * dy;
                let k = (row - first) * width + column;
                // The square root alone decides the depth; most samples are hidden without it.
                if rest >= 0.0 && z + radius > depth[k] && z + rest.sqrt() > depth[k] {
                    depth[k] = z + rest.sqrt();
                    nearest[k] = number as u32;
                }
            }
        }
    }
    nearest
}

/// The samples from `low` to `high` whose middle lies within `radius` of `centre`.
fn span(centre: f32, radius: f32, low: usize, high: usize) -> std::ops::Range<usize> {
    let from = (centre - radius - 0.5).ceil().max(low as f32) as usize;
    let to = (centre + radius + 0.5).floor().clamp(0.0, high as f32) as usize;
    from..to
}

/// The sRGB colour of a sphere where its surface shows at a sample; the shader's twin.
fn shade(picture: &Picture, number: usize, column: usize, row: usize) -> [u8; 4] {
    let disc = picture.discs[number];
    let dx = (column as f32 + 0.5 - disc.centre[0]) / picture.radius;
    let dy = (row as f32 + 0.5 - disc.centre[1]) / picture.radius;
    let normal = [dx, -dy, (1.0 - dx * dx - dy * dy).max(0.0).sqrt()];
    let facing: f32 = (0..3).map(|k| normal[k] * LIGHT[k]).sum();
    let light = 1.0 + picture.relief * (AMBIENT + DIFFUSE * facing.max(0.0) - 1.0);
    let [r, g, b] = disc.colour.map(|channel| encode(channel * light));
    [r, g, b, 255]
}

#[cfg(test)]
mod tests {
    use super::super::samples::{bar, cube, ring, view};
    use super::*;

    fn coloured(image: &RgbaImage) -> usize {
        // Only particles are neither grey nor white.
        image.pixels().filter(|p| p[0].abs_diff(p[1]) > 20 || p[1].abs_diff(p[2]) > 20).count()
    }

    #[test]
    fn all_dimensions_are_painted() {
        for (shot, field, least) in [(ring(), "pressure", 0.1), (cube(27), "von_mises", 0.2), (bar(), "pressure", 0.002)] {
            let image = splat(&shot, &view(field)).unwrap();
            let part = coloured(&image) as f64 / f64::from(image.width() * image.height());
            assert!(part > least && part < 0.8, "{part} of the picture of dimension {}", shot.dimension);
            // LITHOSPH_KEEP=folder keeps the pictures to be looked at.
            if let Some(folder) = std::env::var_os("LITHOSPH_KEEP") {
                let name = format!("splat-{}d.png", shot.dimension);
                super::super::save_png(&std::path::Path::new(&folder).join(name), &image).unwrap();
            }
        }
    }

    #[test]
    fn the_nearer_sphere_hides_the_farther_one() {
        let mut shot = cube(2);
        shot.positions = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        shot.columns[0].values = vec![0.0, 1.0];
        shot.columns[1].values = vec![0.0; 6];
        let from = |z: f64| {
            let eye = Some([0.0, 0.0, z]);
            let picture = compose(&shot, &View { eye, ..view("von_mises") }).unwrap();
            let at = picture.discs[0].centre;
            cover(&picture, at[1] as usize, 1)[at[0] as usize]
        };
        assert_eq!((from(1.0), from(-1.0)), (1, 0));
    }

    #[test]
    fn the_number_of_cores_does_not_matter() {
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let alone = one.install(|| splat(&ring(), &view("pressure")).unwrap());
        assert_eq!(alone, splat(&ring(), &view("pressure")).unwrap());
    }
}
