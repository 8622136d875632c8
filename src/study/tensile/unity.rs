//! The estimate of unity, sum V W, and its gradient, sum V grad W: over kernels, smoothing lengths, lattices, at borders
//! and in disorder; and what both criteria of section 5.2 make of the growth.

use super::criteria;
use super::draw::{chart, curve, dots};
use super::findings::{Exhibit, Findings, table_columns};
use super::partition::offsets;
use crate::smoothing::Smoothing;
use crate::study::chart::{Axis, Table};
use glam::DVec3;

/// A packing, with nearest neighbours at the distance 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Packing {
    Square(usize),
    Hexagonal,
    FaceCentred,
}

impl Packing {
    pub fn dimension(self) -> usize {
        match self {
            Self::Square(dimension) => dimension,
            Self::Hexagonal => 2,
            Self::FaceCentred => 3,
        }
    }
    fn word(self) -> &'static str {
        match self {
            Self::Square(1) => "line",
            Self::Square(2) => "square",
            Self::Square(_) => "cubic",
            Self::Hexagonal => "hexagonal",
            Self::FaceCentred => "face-centred",
        }
    }
    /// Volume of a particle.
    fn volume(self) -> f64 {
        match self {
            Self::Square(_) => 1.0,
            Self::Hexagonal => 0.75_f64.sqrt(),
            Self::FaceCentred => 0.5_f64.sqrt(),
        }
    }
    /// Neighbours nearer than `reach`.
    pub fn neighbours(self, reach: f64) -> Vec<DVec3> {
        let near = |o: &DVec3| *o != DVec3::ZERO && o.length() < reach;
        match self {
            Self::Square(dimension) => offsets(dimension, reach),
            Self::Hexagonal => {
                let most = (2.0 * reach).ceil() as i32;
                let rows = (-most..=most).flat_map(|i| (-most..=most).map(move |j| (f64::from(i), f64::from(j))));
                rows.map(|(i, j)| DVec3::new(i + 0.5 * j, j * 0.75_f64.sqrt(), 0.0)).filter(near).collect()
            }
            Self::FaceCentred => {
                // Points of a cubic lattice whose coordinates have an even sum.
                let even = |o: &DVec3| (o.x + o.y + o.z).rem_euclid(2.0) == 0.0;
                let all = offsets(3, reach * 2.0_f64.sqrt() + 1e-9);
                all.into_iter().filter(even).map(|o| o * 0.5_f64.sqrt()).filter(near).collect()
            }
        }
    }
}

/// Sum V W, itself among them, and sum V grad W times h.
pub fn sums(smoothing: Smoothing, h: f64, packing: Packing, neighbours: &[DVec3]) -> (f64, DVec3) {
    let dimension = packing.dimension();
    let value = |r: f64| smoothing.value(r, h, dimension);
    let unity = value(0.0) + neighbours.iter().map(|o| value(o.length())).sum::<f64>();
    let gradient: DVec3 = neighbours.iter().map(|o| *o * (-smoothing.derivative(o.length(), h, dimension) / o.length())).sum();
    (unity * packing.volume(), gradient * (packing.volume() * h))
}

/// Neighbours that a particle of the outermost layer keeps (`faces` faces meet there).
fn at_border(neighbours: &[DVec3], faces: usize) -> Vec<DVec3> {
    neighbours.iter().copied().filter(|o| (0..faces).all(|axis| o[axis] > -1e-9)).collect()
}

/// Mean and deviation of sum V W, and root mean square of h |sum V grad W|, where each particle of a lattice is moved by up to
/// `amount` spacings along each axis.
pub fn disorder(smoothing: Smoothing, h: f64, dimension: usize, amount: f64) -> [f64; 3] {
    let mut seed = 5_u64;
    // SplitMix64 of Steele, Lea & Flood 2014: the same on every machine.
    let mut random = || {
        seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = seed;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    let packing = Packing::Square(dimension);
    let places = packing.neighbours(2.0 * h + 2.0 * amount * 2.0);
    let draws = 2000;
    let mut moved = || {
        let mut o = DVec3::ZERO;
        (0..dimension).for_each(|axis| o[axis] = amount * random());
        o
    };
    let (mut first, mut second, mut slope) = (0.0, 0.0, 0.0);
    for _ in 0..draws {
        let own = moved();
        let neighbours: Vec<DVec3> = places.iter().map(|o| *o + moved() - own).collect();
        let (unity, gradient) = sums(smoothing, h, packing, &neighbours);
        (first, second, slope) = (first + unity, second + unity * unity, slope + gradient.length_squared());
    }
    let count = f64::from(draws);
    let mean = first / count;
    [mean, (second / count - mean * mean).max(0.0).sqrt(), (slope / count).sqrt()]
}

const PACKINGS: [Packing; 5] =
    [Packing::Square(1), Packing::Square(2), Packing::Square(3), Packing::Hexagonal, Packing::FaceCentred];

/// Both sums over kernels, smoothing lengths and packings, inside and at borders, and in disorder.
pub fn lattices() -> Findings {
    let ratios: Vec<f64> = (0..=36).map(|k| 0.7 + 0.05 * f64::from(k)).collect();
    let mut rows = Vec::new();
    for packing in PACKINGS {
        for &smoothing in Smoothing::ALL {
            for &h in &ratios {
                let all = packing.neighbours(2.0 * h);
                let mut row = vec![packing.word().to_string(), smoothing.word().to_string(), format!("{h:.2}")];
                row.push(format!("{:.6}", sums(smoothing, h, packing, &all).0));
                for faces in 1..=2 {
                    let plane = faces <= packing.dimension() && matches!(packing, Packing::Square(_));
                    let (unity, gradient) = sums(smoothing, h, packing, &at_border(&all, faces));
                    row.extend(if plane {
                        [format!("{unity:.4}"), format!("{:.4}", gradient.length())]
                    } else {
                        [String::new(), String::new()]
                    });
                }
                rows.push(row);
            }
        }
    }
    let columns = [
        "packing",
        "kernel",
        "h/dx",
        "sum V W inside",
        "at a face",
        "h |sum V grad W| there",
        "at an edge",
        "h |sum V grad W| there",
    ];
    let pictures = [Packing::Square(2), Packing::Hexagonal].map(|packing| {
        let kernels = Smoothing::ALL.iter().enumerate();
        let line = |&smoothing: &Smoothing| {
            ratios.iter().map(|&h| [h, sums(smoothing, h, packing, &packing.neighbours(2.0 * h)).0]).collect()
        };
        chart(
            &format!("Estimate of unity inside, {}", packing.word()),
            "Sum V W with the particle itself.",
            Axis::linear("h/dx"),
            Axis::linear("sum V W").within([0.9, 1.15]),
            kernels.map(|(colour, smoothing)| curve(smoothing.word(), colour, line(smoothing))).collect(),
        )
    });
    let inside = Exhibit {
        stem: "unity".into(),
        heading: "The estimate of unity on lattices".into(),
        text: vec!["The gradient's sum is zero inside by symmetry; at a face and at an edge of the body neither sum is what it should be.".into()],
        pictures: pictures.into(),
        table: Some(Table { columns: table_columns(&columns), rows }),
    };
    Findings { exhibits: vec![inside, disordered()], statements: criteria::estimates() }
}

fn disordered() -> Exhibit {
    let amounts = [0.0, 0.02, 0.05, 0.1, 0.2, 0.3];
    let mut rows = Vec::new();
    let mut series = Vec::new();
    for dimension in 1..=3 {
        for &smoothing in Smoothing::ALL {
            let found = amounts.map(|amount| disorder(smoothing, 1.3, dimension, amount));
            for (amount, [mean, deviation, slope]) in amounts.iter().zip(found) {
                let cells = [mean, deviation, slope].map(|x| format!("{x:.5}"));
                rows.push([vec![dimension.to_string(), smoothing.word().into(), amount.to_string()], cells.to_vec()].concat());
            }
            if smoothing == Smoothing::CubicSpline {
                let points = |k: usize| amounts.iter().zip(&found).map(|(amount, f)| [*amount, f[k]]).collect();
                series.push(curve(format!("deviation of sum V W, {dimension}D"), dimension - 1, points(1)));
                series.push(dots(format!("h |sum V grad W|, {dimension}D"), dimension - 1, points(2), Vec::new()));
            }
        }
    }
    Exhibit {
        stem: "unity-disorder".into(),
        heading: "The estimate of unity in disorder".into(),
        text: vec![
            "Each particle of a lattice moved by up to that part of a spacing along each axis, h 1.3 dx, 2000 draws.".into(),
        ],
        pictures: vec![chart(
            "Disorder, cubic spline, h 1.3 dx",
            "",
            Axis::linear("displacement, dx"),
            Axis::linear("root mean square"),
            series,
        )],
        table: Some(Table {
            columns: table_columns(&[
                "dimension",
                "kernel",
                "moved by up to, dx",
                "mean sum V W",
                "its deviation",
                "h |sum V grad W|, rms",
            ]),
            rows,
        }),
    }
}
