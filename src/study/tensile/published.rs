//! The numbers of Strand 2010, chapter 5, that the study is held against. Unless said otherwise: Swegle's test, a fluid
//! at relative volume 1.01, n = 4, h = 1.3 dx, dp the initial spacing.

use super::case::Spacing;

/// Section 5.1.3.1, page 110: neighbours on a line, and h over their mean distance.
pub const LINE_MEANS: [(usize, f64); 2] = [(4, 0.87), (6, 0.85)];
/// Sections 5.1.3.6, pages 118 and 119: dimension, h/dx, neighbours.
pub const NEIGHBOURS: [(usize, f64, usize); 6] =
    [(1, 0.7, 2), (1, 1.3, 4), (1, 1.8, 6), (2, 1.3, 20), (2, 1.52, 28), (2, 1.8, 36)];
/// Section 5.1.3.2, page 112: smallest epsilon that is stable on a line.
pub const LINE_LEAST: [(Spacing, f64); 2] = [(Spacing::Mean, 1.045), (Spacing::Initial, 1.119)];
/// Section 5.1.3.2, page 112: about the largest epsilon that is stable on a line.
pub const LINE_MOST: f64 = 90.0;
/// Section 5.1.3.6, page 118: smallest stable epsilon on a line by h/dx; none at 0.7.
pub const LINE_LEAST_BY_RATIO: [(f64, Option<f64>); 3] = [(0.7, None), (1.3, Some(1.119)), (1.8, Some(0.600))];
/// Section 5.1.3.2, page 111: in the plane no epsilon is stable, and this one is the most nearly so.
pub const PLANE_CALMEST: f64 = 1.3;
/// Section 5.1.3.6, pages 118 to 120: in the plane at h = 1.8 dx the first epsilon is stable and the second is not.
pub const PLANE_WIDE_STABLE: f64 = 0.95;
pub const PLANE_WIDE_UNSTABLE: f64 = 10.0;
/// Section 5.1.3.7, page 121: at h = 1.8 dx in the plane epsilon 1.3 is stable at these relative volumes. At the relative volume
/// 1.001 no epsilon is stable, and 0.900 grows least.
pub const TENSIONS_STABLE: [f64; 3] = [1.01, 1.03, 1.05];
pub const TENSION_EPSILON: f64 = 1.3;
pub const TENSION_UNSTABLE: (f64, f64) = (1.001, 0.900);
/// Section 5.1.3.2, page 111: Libersky's 0.3 x 10^(N - 1).
pub const LIBERSKY: [f64; 3] = [0.3, 3.0, 30.0];
/// Section 5.2.2.1, page 128: total velocity of a stable run, and the kick of its one particle (5.1.2), km/s.
pub const QUIET: f64 = 5.0e-11;
pub const KICK: f64 = 1.0e-9;
/// Section 5.1.2, page 107: time after which the particles at relative volume 1.05 have clumped, s.
pub const CLUMPED: f64 = 12e-6;
/// Section 5.1.3.4, page 114: work of the repulsive force in a stable run on a line, J.
pub const WORK: f64 = 1e-17;
/// Section 5.2.3.1, page 133: estimate of unity near the centre, and the non-local one of every particle not on the border.
pub const UNITY: f64 = 0.9979;
pub const UNITY_NONLOCAL: f64 = 1.00076;
/// Table 5.2-1, page 127: local h/dx, and the scale factors of the non-local one.
pub const LOCAL_RATIO: f64 = 1.2;
pub const SCALES: [f64; 4] = [1.25, 1.5, 1.75, 2.0];
/// Table 5.2-2 and figure 5.2-3, pages 132 and 133: neighbours beyond the local ones for those factors.
pub const RING: [usize; 4] = [8, 16, 36, 48];
