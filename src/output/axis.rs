//! Round numbers along an axis, and units in words engineers use.

const SI_PREFIXES: [(i32, &str); 6] = [(-9, "n"), (-6, "µ"), (-3, "m"), (3, "k"), (6, "M"), (9, "G")];
/// Units that a prefix may lead, alone or before "/" or "·".
const SI_UNITS: [&str; 7] = ["Pa", "N", "J", "W", "m", "s", "Hz"];

/// Round numbers along a range, written as multiples of a power of ten.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub range: [f64; 2],
    pub ticks: Vec<f64>,
    /// The labels are in units of ten to this power.
    pub power: i32,
    decimals: usize,
}

impl Axis {
    /// About `count` ticks, at multiples of 1, 2 or 5 times a power of ten.
    pub fn new(range: [f64; 2], count: usize) -> Self {
        Self::in_power(range, count, thousands(range[0].abs().max(range[1].abs())))
    }

    /// Two axes in one unit, which two lengths beside each other must have.
    pub fn alike(ranges: [[f64; 2]; 2], counts: [usize; 2]) -> [Self; 2] {
        let power = thousands(ranges.as_flattened().iter().fold(0.0, |largest, end| largest.max(end.abs())));
        [0, 1].map(|k| Self::in_power(ranges[k], counts[k], power))
    }

    fn in_power([low, high]: [f64; 2], count: usize, power: i32) -> Self {
        let rough = (high - low) / count as f64;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * decade).into_iter().find(|&s| s >= 0.999 * rough).unwrap_or(rough);
        let (first, last) = ((low / step - 1e-6).ceil(), (high / step + 1e-6).floor());
        let ticks = (0..=(last - first).max(0.0) as usize).map(|k| (first + k as f64) * step).collect();
        let decimals = (-(step * 10f64.powi(-power)).log10() - 1e-6).ceil().clamp(0.0, 9.0) as usize;
        Self { range: [low, high], ticks, power, decimals }
    }

    pub fn label(&self, tick: f64) -> String {
        // Adding zero turns -0 into 0.
        format!("{:.*}", self.decimals, tick * 10f64.powi(-self.power) + 0.0)
    }

    pub fn longest(&self) -> usize {
        self.ticks.iter().map(|&tick| self.label(tick).len()).max().unwrap_or(0)
    }

    /// Where `value` lies from 0 to 1.
    pub fn part(&self, value: f64) -> f64 {
        (value - self.range[0]) / (self.range[1] - self.range[0])
    }
}

/// The power of a thousand in which `largest` has few digits; 0 for everyday sizes.
fn thousands(largest: f64) -> i32 {
    let decade = largest.log10().floor();
    if largest > 0.0 && !(-1.0..4.0).contains(&decade) { 3 * (decade / 3.0).floor() as i32 } else { 0 }
}

/// `unit` times ten to the `power`: "MPa" where there is such a word, else "1e6 kg".
fn scaled(unit: &str, power: i32) -> String {
    let symbol = unit.split(['/', '·', '*', ' ']).next().unwrap_or("");
    let prefix = SI_PREFIXES.iter().find(|(p, _)| *p == power && SI_UNITS.contains(&symbol));
    match (power, prefix) {
        (0, _) => unit.to_string(),
        (_, Some((_, prefix))) => format!("{prefix}{unit}"),
        _ => format!("1e{power} {unit}").trim_end().to_string(),
    }
}

pub fn named(name: &str, unit: &str, power: i32) -> String {
    match scaled(unit, power) {
        unit if unit.is_empty() => name.to_string(),
        unit => format!("{name} [{unit}]"),
    }
}

/// `value` with at most four digits and its unit: "1.25 ms", or "1.25e-3" where there is no word.
pub fn quantity(value: f64, unit: &str) -> String {
    let power = thousands(value.abs());
    let words = scaled(unit, power);
    // Rounded to four digits first, so that the shortest form is short.
    let text = format!("{value:.3e}");
    let rounded = text.parse().unwrap_or(value);
    let number = match power {
        0 => format!("{rounded}"),
        _ if words.starts_with("1e") => format!("{rounded:e}"),
        _ => format!("{}", (rounded * 10f64.powi(3 - power)).round() / 1e3),
    };
    let words = if words.starts_with("1e") { unit } else { &words };
    format!("{number} {words}").trim_end().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_labels_short() {
        let axis = Axis::new([-2.37e7, 3.1e7], 6);
        let labels: Vec<_> = axis.ticks.iter().map(|&tick| axis.label(tick)).collect();
        assert_eq!((axis.power, labels), (6, ["-20", "-10", "0", "10", "20", "30"].map(String::from).to_vec()));
        let axis = Axis::new([0.0, 0.41], 5);
        assert_eq!(axis.label(axis.ticks[1]), "0.1");
        let axis = Axis::new([-0.0003, 0.0007], 6);
        assert_eq!((axis.power, axis.label(axis.ticks[0])), (-6, "-200".into()));
        assert!(Axis::new([1e5, 1.00001e5], 5).ticks.len() > 3);
    }

    #[test]
    fn lengths_beside_each_other_have_one_unit() {
        let [across, up] = Axis::alike([[-0.01, 0.11], [-0.005, 0.085]], [7, 6]);
        assert_eq!((across.power, up.power), (0, 0));
        assert_eq!((up.label(up.ticks[0]), up.label(up.ticks[1])), ("0.00".into(), "0.02".into()));
        let [across, up] = Axis::alike([[0.0, 0.03], [0.0, 2e-4]], [7, 6]);
        assert_eq!((across.power, up.power, up.label(up.ticks[1])), (-3, -3, "0.05".into()));
    }

    #[test]
    fn units_take_prefixes_where_they_can() {
        assert_eq!(named("stress", "Pa", 6), "stress [MPa]");
        assert_eq!(named("x", "m", -3), "x [mm]");
        assert_eq!(named("density", "kg/m³", 3), "density [1e3 kg/m³]");
        assert_eq!(named("area", "m²", -3), "area [1e-3 m²]");
        assert_eq!(named("damage", "", 0), "damage");
        assert_eq!(quantity(1.25e-3, "s"), "1.25 ms");
        assert_eq!(quantity(0.0, "s"), "0 s");
        assert_eq!(quantity(1200.0, ""), "1200");
        assert_eq!(quantity(0.012345678, "s"), "12.35 ms");
        assert_eq!(quantity(0.0123, ""), "1.23e-2");
        assert_eq!(quantity(250.0, "Myr"), "250 Myr");
    }
}
