//! From numbers to colours: perceptually even maps, and the sRGB transfer curve.

use std::sync::LazyLock;

/// Light along the map in even steps, from dark to bright: viridis of matplotlib as the polynomial
/// of sixth degree fitted by Matt Zucker (<https://www.shadertoy.com/view/WlfXRN>, CC0).
const VIRIDIS: [[f32; 3]; 7] = [
    [0.277_727_33, 0.005_407_344_5, 0.334_099_8],
    [0.105_093_04, 1.404_613_5, 1.384_590_2],
    [-0.330_861_83, 0.214_847_56, 0.095_095_16],
    [-4.634_230_5, -5.799_101, -19.332_441],
    [6.228_27, 14.179_933, 56.690_55],
    [4.776_385, -13.745_145, -65.353_03],
    [-5.435_456, 4.645_852_6, 26.312_435],
];

/// Blue over grey to red with even steps either side: the "cool to warm" of Moreland, Diverging
/// Color Maps for Scientific Visualization (2009), in eight equal intervals.
const COOL_TO_WARM: [[u8; 3]; 9] = [
    [59, 76, 192],
    [98, 130, 234],
    [141, 176, 254],
    [184, 208, 249],
    [221, 221, 221],
    [245, 196, 173],
    [244, 154, 123],
    [222, 96, 77],
    [180, 4, 38],
];

/// What a particle without a finite value is painted in: outside both maps.
const NO_VALUE: [f32; 3] = [0.9, 0.2, 0.9];

/// A range of values and the map that suits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourScale {
    pub range: [f64; 2],
    pub diverging: bool,
}

impl ColourScale {
    /// Diverging around zero where both signs matter, else sequential. A range without width is
    /// widened, so that a uniform field shows as one colour.
    pub fn new([low, high]: [f64; 2]) -> Self {
        let (low, high) = (low.min(high), low.max(high));
        let largest = low.abs().max(high.abs());
        let range = if high - low > 1e-9 * largest {
            [low, high]
        } else if largest > 0.0 {
            [low - 0.01 * largest, high + 0.01 * largest]
        } else {
            [-1.0, 1.0]
        };
        // One sign at the level of noise should not take half of the colours.
        Self { range, diverging: low < 0.0 && high > 0.0 && (-low).min(high) > 0.05 * largest }
    }

    /// The range of the finite values, [0, 0] where there is none.
    pub fn of(values: &[f64]) -> Self {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        let wider = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        let range = finite.fold([f64::INFINITY, f64::NEG_INFINITY], wider);
        Self::new(if range[0] <= range[1] { range } else { [0.0, 0.0] })
    }

    /// The colour of `value` in sRGB, each channel in 0..=1.
    pub fn srgb(&self, value: f64) -> [f32; 3] {
        let [low, high] = self.range;
        if !value.is_finite() {
            NO_VALUE
        } else if self.diverging {
            // Zero stays grey whatever the range, so that sign and size can be told by eye.
            diverging((0.5 + 0.5 * value / low.abs().max(high.abs())) as f32)
        } else {
            sequential(((value - low) / (high - low)) as f32)
        }
    }

    /// The colour of `value` in linear light, in which shading is computed.
    pub fn linear(&self, value: f64) -> [f32; 3] {
        self.srgb(value).map(to_linear)
    }
}

fn sequential(t: f32) -> [f32; 3] {
    let t = t.clamp(0.0, 1.0);
    let horner = |channel: usize| VIRIDIS.iter().rev().fold(0.0, |sum, c| sum * t + c[channel]);
    [0, 1, 2].map(|channel| f32::clamp(horner(channel), 0.0, 1.0))
}

fn diverging(t: f32) -> [f32; 3] {
    let place = t.clamp(0.0, 1.0) * (COOL_TO_WARM.len() - 1) as f32;
    let below = (place as usize).min(COOL_TO_WARM.len() - 2);
    let (low, high, part) = (COOL_TO_WARM[below], COOL_TO_WARM[below + 1], place - below as f32);
    [0, 1, 2].map(|k| (f32::from(low[k]) * (1.0 - part) + f32::from(high[k]) * part) / 255.0)
}

/// Inverse of the sRGB transfer curve (IEC 61966-2-1).
pub fn to_linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

fn to_srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

const STEPS: usize = 8192;
/// A power per channel and pixel is what painting would otherwise spend its time on.
static ENCODED: LazyLock<Vec<u8>> =
    LazyLock::new(|| (0..=STEPS).map(|k| (to_srgb(k as f32 / STEPS as f32) * 255.0).round() as u8).collect());
static DECODED: LazyLock<Vec<f32>> = LazyLock::new(|| (0..256).map(|k| to_linear(k as f32 / 255.0)).collect());

/// Linear light in 0..=1 as an sRGB byte.
pub fn encode(linear: f32) -> u8 {
    ENCODED[(linear.clamp(0.0, 1.0) * STEPS as f32 + 0.5) as usize]
}

/// An sRGB byte as linear light.
pub fn decode(byte: u8) -> f32 {
    DECODED[byte as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance by ITU-R BT.709.
    fn luminance(colour: [f32; 3]) -> f32 {
        let [r, g, b] = colour.map(to_linear);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn viridis_matches_matplotlib_and_gets_brighter_all_along() {
        // matplotlib.cm.viridis at 0, 0.5 and 1.
        for (t, expected) in [(0.0, [68, 1, 84]), (0.5, [33, 145, 140]), (1.0, [253, 231, 37])] {
            for (channel, wanted) in sequential(t).iter().zip(expected) {
                assert!((channel * 255.0 - wanted as f32).abs() < 5.0, "{t}: {channel} {wanted}");
            }
        }
        let light: Vec<f32> = (0..=50).map(|k| luminance(sequential(k as f32 / 50.0))).collect();
        assert!(light.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn zero_is_grey_where_both_signs_matter() {
        let scale = ColourScale::new([-1.0, 3.0]);
        assert!(scale.diverging);
        assert_eq!(scale.srgb(0.0), [221.0 / 255.0; 3]);
        assert!(!ColourScale::new([-1e-9, 1.0]).diverging);
        assert!(!ColourScale::new([1.0, 2.0]).diverging);
    }

    #[test]
    fn odd_ranges_and_values_still_have_colours() {
        assert_eq!(ColourScale::of(&[f64::NAN]).range, [-1.0, 1.0]);
        assert_eq!(ColourScale::of(&[1.0, f64::NAN, 3.0]).range, [1.0, 3.0]);
        let flat = ColourScale::of(&[5.0, 5.0]);
        assert!(flat.range[0] < 5.0 && flat.range[1] > 5.0);
        assert_eq!(flat.srgb(f64::NAN), NO_VALUE);
    }

    #[test]
    fn bytes_survive_linear_light() {
        assert!((0..=255).all(|byte| encode(decode(byte)) == byte));
    }
}
