//! Marks on a finished picture: filled boxes, lines and letters.

use font8x8::legacy::LATIN_LEGACY;
use font8x8::{BASIC_FONTS, GREEK_FONTS, UnicodeFonts};
use image::RgbaImage;

/// sRGB, each channel in 0..=1.
pub type Colour = [f32; 3];
pub const INK: Colour = [0.13, 0.14, 0.16];
pub const PALE_INK: Colour = [0.45, 0.47, 0.50];
const GRID: Colour = [0.92, 0.93, 0.94];

/// Mixes `colour` over a pixel; outside the picture nothing happens.
fn blend(image: &mut RgbaImage, [x, y]: [i32; 2], colour: Colour, cover: f32) {
    if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
        && let Some(pixel) = image.get_pixel_mut_checked(x, y)
    {
        for (channel, ink) in pixel.0.iter_mut().zip(colour) {
            *channel = (f32::from(*channel) * (1.0 - cover) + 255.0 * ink * cover).round() as u8;
        }
    }
}

pub fn fill(image: &mut RgbaImage, [left, top, right, bottom]: [i32; 4], colour: Colour) {
    for y in top..bottom {
        (left..right).for_each(|x| blend(image, [x, y], colour, 1.0));
    }
}

/// Fills with the colour of the grid, but only where the paper is still white.
pub fn behind(image: &mut RgbaImage, [left, top, right, bottom]: [i32; 4]) {
    for (x, y) in (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y))) {
        if image.get_pixel_checked(x as u32, y as u32).is_some_and(|pixel| pixel.0 == [255; 4]) {
            blend(image, [x, y], GRID, 1.0);
        }
    }
}

/// A straight line with soft edges.
pub fn stroke(image: &mut RgbaImage, from: [f64; 2], to: [f64; 2], half: f64) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = (along[0] * along[0] + along[1] * along[1]).max(1e-9);
    let reach = |k: usize| (from[k].min(to[k]) - half - 1.0) as i32..=(from[k].max(to[k]) + half + 1.0) as i32;
    for (x, y) in reach(1).flat_map(|y| reach(0).map(move |x| (x, y))) {
        let [px, py] = [f64::from(x) + 0.5 - from[0], f64::from(y) + 0.5 - from[1]];
        let part = ((px * along[0] + py * along[1]) / square).clamp(0.0, 1.0);
        let distance = (px - part * along[0]).hypot(py - part * along[1]);
        blend(image, [x, y], PALE_INK, (half + 0.5 - distance).clamp(0.0, 1.0) as f32);
    }
}

pub fn width(text: &str, scale: i32) -> i32 {
    8 * scale * text.chars().count() as i32
}

/// Writes from the upper left corner `at`; what does not fit is cut.
pub fn text(image: &mut RgbaImage, [left, top]: [i32; 2], scale: i32, colour: Colour, text: &str) {
    for (number, letter) in text.chars().enumerate() {
        let glyph = smooth_glyph(letter);
        for (x, y) in (0..8 * scale).flat_map(|y| (0..8 * scale).map(move |x| (x, y))) {
            // Four by four points of the pixel, in the dots of the smooth glyph.
            let dot = |pixel: i32, point: i32| ((8 * pixel + 2 * point + 1) / (2 * scale)).min(31) as usize;
            let inked = (0..16).filter(|p| glyph[dot(y, p / 4)] >> dot(x, p % 4) & 1 == 1).count();
            blend(image, [left + number as i32 * 8 * scale + x, top + y], colour, inked as f32 / 16.0);
        }
    }
}

/// A letter in 32 x 32 dots, a bit each from the left up, with its stairs smoothed to slopes.
fn smooth_glyph(letter: char) -> [u32; 32] {
    // By code point: the crate's Latin table names three letters "²" and none "³".
    let latin = (letter as usize).checked_sub(0xa0).and_then(|k| LATIN_LEGACY.get(k).copied());
    let fonts = [BASIC_FONTS.get(letter), latin, GREEK_FONTS.get(letter)];
    let glyph = fonts.into_iter().flatten().next().or_else(|| BASIC_FONTS.get('?')).unwrap_or_default();
    let mut dots = [0; 32];
    glyph.iter().zip(&mut dots).for_each(|(&row, dots)| *dots = u32::from(row));
    doubled(&doubled(&dots, 8), 16)
}

/// Scale2x (Mazzoleni): each dot becomes four, and a corner takes the colour of its two neighbours
/// where these agree with each other and with no one else.
fn doubled(dots: &[u32; 32], side: usize) -> [u32; 32] {
    let dot = |x: usize, y: usize| x < side && y < side && dots[y] >> x & 1 == 1;
    let mut larger = [0; 32];
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let (left, right) = (dot(x.wrapping_sub(1), y), dot(x + 1, y));
        let (above, below) = (dot(x, y.wrapping_sub(1)), dot(x, y + 1));
        for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (beside, over) = (if column == 0 { left } else { right }, if row == 0 { above } else { below });
            let opposite = left != right && above != below;
            let inked = if opposite && beside == over { beside } else { dot(x, y) };
            larger[2 * y + row] |= u32::from(inked) << (2 * x + column);
        }
    }
    larger
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_units_exist() {
        let unknown = smooth_glyph('?');
        assert!("µ²³·°ρσ".chars().all(|letter| smooth_glyph(letter) != unknown));
        assert_eq!(smooth_glyph('\u{4e00}'), unknown);
    }

    #[test]
    fn text_beyond_the_edge_is_cut() {
        let mut image = RgbaImage::from_pixel(20, 20, image::Rgba([255; 4]));
        text(&mut image, [-5, 15], 2, INK, "long text");
        assert!(image.pixels().any(|pixel| pixel[0] < 100));
    }
}
