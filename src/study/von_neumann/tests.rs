use super::*;
use crate::smoothing::Smoothing;
use std::f64::consts::PI;

const ARTIFICIAL: [ArtificialStress; 4] = [
    ArtificialStress::None,
    ArtificialStress::Scalar { epsilon: 0.4, exponent: 4.0, spacing: 1.07 },
    ArtificialStress::Principal { epsilon: 0.3, exponent: 2.5, spacing: 0.98 },
    ArtificialStress::Signed { epsilon: -0.2, exponent: 3.0, spacing: 1.2 },
];
const GRADIENTS: [Gradient; 3] = [Gradient::Plain, Gradient::Corrected, Gradient::Adjoint];

/// The nonlinear equations on a periodic lattice, as loops over all pairs.
struct Periodic<'a> {
    equations: &'a Equations,
    start: Vec<DVec3>,
    side: f64,
}
#[derive(Clone)]
struct State {
    position: Vec<DVec3>,
    density: Vec<f64>,
    stress: Vec<DMat3>,
}

impl Periodic<'_> {
    fn new(equations: &Equations, n: usize) -> Periodic<'_> {
        let &Lattice { dimension, spacing, .. } = equations.lattice();
        let point = |index: usize| {
            let along = |axis: usize| if axis < dimension { index / n.pow(axis as u32) % n } else { 0 };
            DVec3::new(along(0) as f64, along(1) as f64, along(2) as f64) * spacing
        };
        Periodic { equations, start: (0..n.pow(dimension as u32)).map(point).collect(), side: n as f64 * spacing }
    }
    fn mass(&self) -> f64 {
        self.equations.medium.density * self.equations.lattice.spacing.powi(self.equations.lattice.dimension as i32)
    }
    /// x_b - x_a of the nearest image, g_ab and r; None for those that do not meet.
    fn pair(&self, position: &[DVec3], a: usize, b: usize) -> Option<(DVec3, DVec3, f64)> {
        let lattice = &self.equations.lattice;
        let x = position[b] - position[a];
        let x = x - (x / self.side).round() * self.side;
        let r = x.length();
        let h = lattice.smoothing_length;
        (a != b && r < 2.0 * h).then(|| (x, -x * (lattice.smoothing.derivative(r, h, lattice.dimension) / r), r))
    }
    fn inverse_moment(&self, state: &State, a: usize) -> DMat3 {
        let mut moment = DMat3::ZERO;
        for b in 0..self.start.len() {
            if let Some((x, g, _)) = self.pair(&state.position, a, b) {
                moment += outer(x, g) * (self.mass() / state.density[b]);
            }
        }
        for axis in self.equations.lattice.dimension..3 {
            moment.col_mut(axis)[axis] = 1.0;
        }
        moment.inverse()
    }
    /// v_a + weight sum (m_b/rho) (v_b - v_a) W_ab
    fn smoothed(&self, state: &State, v: &[DVec3], a: usize) -> DVec3 {
        let lattice = &self.equations.lattice;
        let mut smoothed = v[a];
        for b in 0..self.start.len() {
            if let Some((_, _, r)) = self.pair(&state.position, a, b) {
                let value = lattice.smoothing.value(r, lattice.smoothing_length, lattice.dimension);
                smoothed += (v[b] - v[a]) * (self.equations.xsph * self.mass() / state.density[b] * value);
            }
        }
        smoothed
    }
    /// The lattice after the time one at the velocities v, to first order in v times `amount`.
    fn evolved(&self, v: &[DVec3], amount: f64) -> State {
        let (medium, count) = (&self.equations.medium, self.start.len());
        let rho = medium.density;
        let rest = State { position: self.start.clone(), density: vec![rho; count], stress: vec![self.equations.stress; count] };
        let mut moved = rest.clone();
        for a in 0..count {
            let mut gradient = DMat3::ZERO;
            for b in 0..count {
                if let Some((_, g, _)) = self.pair(&rest.position, a, b) {
                    gradient += outer(v[b] - v[a], g) * (self.mass() / rho);
                }
            }
            if self.equations.gradient != Gradient::Plain {
                gradient *= self.inverse_moment(&rest, a);
            }
            let d = (gradient + gradient.transpose()) * 0.5;
            let omega = gradient - d;
            let s = self.equations.stress + DMat3::IDENTITY * medium.pressure();
            let density_rate = -rho * trace(d);
            let s_rate = (d - DMat3::IDENTITY * (trace(d) / 3.0)) * (2.0 * medium.shear_modulus) + omega * s - s * omega;
            let pressure_rate = medium.bulk_modulus / medium.reference_density * density_rate;
            moved.position[a] += self.smoothed(&rest, v, a) * amount;
            moved.density[a] += density_rate * amount;
            moved.stress[a] += within(s_rate - DMat3::IDENTITY * pressure_rate, self.equations.lattice.dimension) * amount;
        }
        moved
    }
    fn repulsion(&self, state: &State, a: usize) -> DMat3 {
        let medium = &self.equations.medium;
        let square = state.density[a] * state.density[a];
        match self.equations.artificial_stress {
            ArtificialStress::None => DMat3::ZERO,
            ArtificialStress::Scalar { epsilon, .. } => {
                let pressure = medium.bulk_modulus * (state.density[a] / medium.reference_density - 1.0);
                DMat3::IDENTITY * if pressure < 0.0 { -epsilon * pressure.abs() / square } else { 0.0 }
            }
            ArtificialStress::Signed { epsilon, .. } => {
                let pressure = medium.bulk_modulus * (state.density[a] / medium.reference_density - 1.0);
                DMat3::IDENTITY * (epsilon * pressure / square)
            }
            ArtificialStress::Principal { epsilon, .. } => {
                let (values, axes) = principal(state.stress[a]);
                axes * DMat3::from_diagonal(values.max(DVec3::ZERO) * (-epsilon / square)) * axes.transpose()
            }
        }
    }
    fn accelerations(&self, state: &State) -> Vec<DVec3> {
        let (count, mass, lattice) = (self.start.len(), self.mass(), &self.equations.lattice);
        let adjoint = self.equations.gradient == Gradient::Adjoint;
        let repulsion: Vec<_> = (0..count).map(|a| self.repulsion(state, a)).collect();
        let flux: Vec<_> = (0..count)
            .map(|a| match adjoint {
                true => state.stress[a] * self.inverse_moment(state, a),
                false => state.stress[a] * (1.0 / (state.density[a] * state.density[a])),
            })
            .collect();
        let value = |r: f64| lattice.smoothing.value(r, lattice.smoothing_length, lattice.dimension);
        let acceleration = |a: usize| {
            let mut sum = DVec3::ZERO;
            for b in 0..count {
                let Some((_, g, r)) = self.pair(&state.position, a, b) else { continue };
                let weight = if adjoint { mass / (state.density[a] * state.density[b]) } else { mass };
                sum += (flux[a] + flux[b]) * g * weight;
                if let Some((exponent, spacing)) = self.equations.artificial_stress.shape() {
                    sum += (repulsion[a] + repulsion[b]) * g * (mass * (value(r) / value(spacing)).powf(exponent));
                }
            }
            sum
        };
        (0..count).map(acceleration).collect()
    }
}

/// Largest error of A xi cos(k.X) against the nonlinear equations, relative to the largest acceleration.
fn error(equations: &Equations, n: usize, numbers: [f64; 3]) -> f64 {
    let lattice = &equations.lattice;
    let scene = Periodic::new(equations, n);
    let k = DVec3::from(numbers) * (2.0 * PI / scene.side);
    let stiffness = equations.stiffness(k.into());
    let xi = within(DMat3::IDENTITY, lattice.dimension) * DVec3::new(0.6, -0.5, 0.7);
    let wave: Vec<f64> = scene.start.iter().map(|x| (k.dot(*x) + 0.4).cos()).collect();
    let v: Vec<DVec3> = wave.iter().map(|&cos| xi * cos).collect();
    let amount = 1e-5 * lattice.spacing;
    let [plus, minus] = [amount, -amount].map(|amount| scene.accelerations(&scene.evolved(&v, amount)));
    let (mut error, mut largest) = (0.0_f64, 0.0_f64);
    for a in 0..wave.len() {
        let nonlinear = (plus[a] - minus[a]) / (2.0 * amount);
        error = error.max((nonlinear - stiffness * xi * wave[a]).length());
        largest = largest.max(nonlinear.length());
    }
    error / largest
}

#[test]
fn stiffness_is_the_derivative_of_the_nonlinear_equations() {
    let tension = Medium { deviator: [0.02, -0.05, 0.03, 0.03, -0.01, 0.02], ..Medium::at_volume(1.08, 1.3, 2.0, 0.8) };
    let compression = Medium { deviator: [0.06, 0.21, -0.27, 0.05, 0.02, 0.04], ..Medium::at_volume(0.95, 1.3, 2.0, 0.8) };
    let numbers = [[1.0, 2.0, -1.0], [3.0, -2.0, 1.0], [4.0, 1.0, 3.0]];
    let mut worst = 0.0_f64;
    for dimension in 1..=3 {
        for (medium, artificial_stress) in [tension, compression].into_iter().flat_map(|m| ARTIFICIAL.map(|r| (m, r))) {
            for gradient in GRADIENTS {
                let lattice = Lattice { dimension, spacing: 1.1, smoothing: Smoothing::CubicSpline, smoothing_length: 1.43 };
                let equations = Equations::new(lattice, medium, artificial_stress, gradient);
                let waves = if dimension == 3 { &numbers[..1] } else { &numbers[..] };
                for &numbers in waves {
                    let numbers = std::array::from_fn(|axis| if axis < dimension { numbers[axis] } else { 0.0 });
                    let error = error(&equations, if dimension == 3 { 6 } else { 8 }, numbers);
                    assert!(error < 1e-6, "{dimension}D {artificial_stress:?} {gradient:?} {numbers:?}: {error:e}");
                    worst = worst.max(error);
                }
            }
        }
    }
    println!("largest relative error {worst:e}");
}

#[test]
fn smoothed_velocities_are_linearised() {
    let medium = Medium { deviator: [0.02, -0.05, 0.03, 0.03, -0.01, 0.02], ..Medium::at_volume(1.08, 1.3, 2.0, 0.8) };
    for gradient in GRADIENTS {
        let lattice = Lattice { dimension: 2, spacing: 1.1, smoothing: Smoothing::CubicSpline, smoothing_length: 1.43 };
        let equations = Equations::new(lattice, medium, ARTIFICIAL[2], gradient).with_xsph(0.5);
        for numbers in [[1.0, 2.0, 0.0], [4.0, 1.0, 0.0]] {
            let error = error(&equations, 8, numbers);
            assert!(error < 1e-6, "{gradient:?} {numbers:?}: {error:e}");
        }
    }
}

#[test]
fn every_kernel_is_linearised() {
    for &smoothing in Smoothing::ALL {
        // h = dx puts neighbours on the cubic spline's knot at q = 1.
        for smoothing_length in [1.0, 1.3, 1.55, 1.9] {
            let lattice = Lattice { dimension: 2, spacing: 1.0, smoothing, smoothing_length };
            let equations = Equations::new(lattice, Medium::at_volume(1.1, 1.0, 1.0, 0.4), ARTIFICIAL[1], Gradient::Adjoint);
            let error = error(&equations, 8, [1.0, 3.0, 0.0]);
            // At h = dx pairs at 2 dx enter the quadratic's support with a kink and the cut Gaussian's with a jump:
            // no derivative there. The amplitude of the difference shows at the spline's knot.
            let tolerance = match smoothing {
                Smoothing::Quadratic | Smoothing::Gaussian if smoothing_length == 1.0 => continue,
                _ if smoothing_length == 1.0 => 1e-4,
                _ => 1e-6,
            };
            assert!(error < tolerance, "{smoothing:?} {smoothing_length}: {error:e}");
        }
    }
}

fn elastic(dimension: usize, ratio: f64, medium: Medium, artificial_stress: ArtificialStress, gradient: Gradient) -> Equations {
    let lattice = Lattice { dimension, spacing: 1.0, smoothing: Smoothing::CubicSpline, smoothing_length: ratio };
    Equations::new(lattice, medium, artificial_stress, gradient)
}

#[test]
fn long_waves_run_at_the_speeds_of_sound() {
    for dimension in 1..=3 {
        for ratio in [1.22, 1.3, 1.5] {
            for (gradient, tolerance) in [(Gradient::Adjoint, 0.01), (Gradient::Plain, 0.06)] {
                let medium = Medium::at_volume(1.0, 1.0, 1.0, 0.4);
                let equations = elastic(dimension, ratio, medium, ArtificialStress::None, gradient);
                let k = 0.05;
                let direction = [DVec3::X, DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.48, 0.64, 0.6)][dimension - 1];
                let mut speeds: Vec<f64> =
                    equations.eigenpairs((direction * k).into()).iter().map(|pair| pair.square_root()[1].abs() / k).collect();
                speeds.sort_by(f64::total_cmp);
                let fastest = speeds.pop().unwrap() / medium.longitudinal_speed();
                assert!((fastest - 1.0).abs() < tolerance, "{dimension}D h {ratio} {gradient:?} p: {fastest}");
                for slow in speeds {
                    let ratio_s = slow / medium.shear_speed();
                    assert!((ratio_s - 1.0).abs() < tolerance, "{dimension}D h {ratio} {gradient:?} s: {ratio_s}");
                }
            }
        }
    }
}

/// Largest growth rate times dx/c_p over the zone of a periodic box of n particles a side.
fn largest_rate(equations: &Equations, n: usize) -> f64 {
    let cells = std::array::from_fn(|axis| if axis < equations.lattice.dimension { n } else { 1 });
    let (_, rate) = equations.fastest(&periodic_wave_vectors(cells, equations.lattice.spacing));
    rate * equations.lattice.spacing / equations.medium.longitudinal_speed()
}

/// Largest growth rate under isotropic tension s in plane strain, E = 1 and nu = 0.3, over sqrt(s/E) c/dx.
fn tension_rate(ratio: f64, tension: f64) -> f64 {
    let (bulk, shear) = (1.0 / (3.0 * (1.0 - 2.0 * 0.3)), 1.0 / (2.0 * (1.0 + 0.3)));
    let medium = Medium::at_volume(1.0 / (1.0 - tension / bulk), 1.0, bulk, shear);
    let equations = elastic(2, ratio, medium, ArtificialStress::None, Gradient::Plain);
    largest_rate(&equations, 80) / tension.abs().sqrt()
}

#[test]
fn isotropic_tension_grows_at_the_rates_of_the_prototype() {
    // Independent prototype in Python, two figures: 1.14 and 0.50.
    for (ratio, published) in [(1.3, 1.14), (1.5, 0.50)] {
        for tension in [1e-4, 1e-3, 1e-2] {
            let rate = tension_rate(ratio, tension);
            assert!((rate - published).abs() < 0.006, "h {ratio}: {rate}");
        }
    }
    assert!(tension_rate(1.3, -1e-3) > 0.1, "compression feeds the zero-energy mode");
}

#[test]
fn swegles_criterion_decides_on_a_line() {
    // The sawtooth has no gradient, so only W'' sigma acts; at h = 1.3 dx W''(dx) > 0.
    let rate = |volume: f64, ratio: f64| {
        let medium = Medium::at_volume(volume, 1.0, 1.0, 0.0);
        elastic(1, ratio, medium, ArtificialStress::None, Gradient::Plain).growth_rate([PI, 0.0, 0.0])
    };
    // Nearest neighbours alone: lambda = 8 sigma/rho dx W''(dx), W'' = C_1/h^3 (4.5 q - 3).
    let (sigma, density): (f64, f64) = (1.0 - 1.0 / 1.01, 1.0 / 1.01);
    let curvature = (2.0 / 3.0) / 1.3_f64.powi(3) * (4.5 / 1.3 - 3.0);
    assert!((rate(1.01, 1.3) - (8.0 * sigma / density * curvature).sqrt()).abs() < 1e-9);
    assert!(rate(0.99, 1.3) < 1e-7);
    // From h = 1.5 dx on the odd neighbours' W'' of this spline cancel: the sawtooth is neutral either way.
    for ratio in [1.5, 1.6, 1.9] {
        assert!(rate(1.01, ratio) < 1e-5 && rate(0.99, ratio) < 1e-5);
    }
    // The mode that grows is the shortest that the lattice has, and a long wave is a sound wave.
    let medium = Medium::at_volume(1.01, 1.0, 1.0, 0.0);
    let equations = elastic(1, 1.3, medium, ArtificialStress::None, Gradient::Plain);
    assert_eq!(equations.fastest(&periodic_wave_vectors([100, 1, 1], 1.0)).0, [PI, 0.0, 0.0]);
    assert_eq!(equations.growth_rate([0.3, 0.0, 0.0]), 0.0);
}

/// Smallest and largest epsilon that leave a fluid at V_rel 1.01 on a line stable (n = 4, dp = dx).
fn stable_window(ratio: f64) -> Option<[f64; 2]> {
    let stable = |epsilon: f64| {
        let artificial_stress = ArtificialStress::Scalar { epsilon, exponent: 4.0, spacing: 1.0 };
        let medium = Medium::at_volume(1.01, 1.0, 1.0, 0.0);
        largest_rate(&elastic(1, ratio, medium, artificial_stress, Gradient::Plain), 400) < 1e-6
    };
    let scan = (0..400).map(|step| step as f64 * 0.01);
    let first = scan.clone().find(|&epsilon| stable(epsilon))?;
    let last = scan.take_while(|&epsilon| epsilon < first || stable(epsilon)).last()?;
    let bisect = |mut good: f64, mut bad: f64| {
        for _ in 0..30 {
            let middle = 0.5 * (good + bad);
            if stable(middle) { good = middle } else { bad = middle }
        }
        good
    };
    Some([bisect(first, first - 0.01), bisect(last, last + 0.01)])
}

#[test]
fn artificial_stress_stabilises_a_line_within_a_window() {
    // Strand 5.1.3 reports the smallest stabilising epsilon as 1.119 at h = 1.3 dx (stable to about 90), none at
    // 0.7 and 0.600 at 1.8. The equations as printed have windows that hold 1.119 and 0.600, but begin far lower
    // and end soon after, and 0.7 has one too. His epsilon hardly depends on dp, even where W(dp) = 0: the f of
    // his code is not the one printed.
    for (ratio, low, high) in [(0.7, 0.145, 1.90), (1.3, 0.056, 1.16), (1.8, 0.017, 0.74)] {
        let [from, to] = stable_window(ratio).expect("a window");
        println!("1D, h {ratio} dx: stable for epsilon {from:.4} .. {to:.4}");
        assert!((from - low).abs() < 0.01 && (to - high).abs() < 0.02, "h {ratio}: {from} {to}");
    }
}

#[test]
fn modes_satisfy_their_equation() {
    let medium = Medium { deviator: [0.1, -0.05, -0.05, 0.03, 0.02, 0.0], ..Medium::at_volume(1.05, 1.0, 1.0, 0.4) };
    for dimension in 1..=3 {
        let equations = elastic(dimension, 1.3, medium, ArtificialStress::None, Gradient::Adjoint);
        for k in [[PI, 0.0, 0.0], [2.0, 0.7, -1.1]] {
            let k = within(DMat3::IDENTITY, dimension) * DVec3::from(k);
            let mode = equations.mode(k.into());
            assert_eq!(mode.rate, equations.growth_rate(k.into()));
            let (re, im) = (DVec3::from(mode.polarisation), DVec3::from(mode.quadrature));
            assert!((re.length_squared() + im.length_squared() - 1.0).abs() < 1e-12);
            let value = [mode.rate * mode.rate - mode.frequency * mode.frequency, 2.0 * mode.rate * mode.frequency];
            let matrix = equations.stiffness(k.into());
            let error = matrix * re - (re * value[0] - im * value[1]);
            let other = matrix * im - (re * value[1] + im * value[0]);
            assert!(error.length() + other.length() < 1e-10, "{dimension}D {mode:?}");
        }
    }
}

#[test]
fn wave_vectors_fill_the_zone_once() {
    let waves = periodic_wave_vectors([4, 3, 1], 0.5);
    assert_eq!(waves.len(), (4 * 3 - 2) / 2 + 1); // (0, 0) and (2, 0) are their own opposites
    for k in &waves {
        assert!(k[0].abs() <= PI / 0.5 + 1e-12 && k[1].abs() < PI / 0.5 && k[2] == 0.0);
        assert!(!waves.iter().any(|other| k[0] == -other[0] && k[1] == -other[1]));
    }
    assert_eq!(periodic_wave_vectors([8, 1, 1], 1.0).len(), 4);
    assert_eq!(periodic_wave_vectors([6, 6, 6], 1.0).len(), (216 - 8) / 2 + 7);
    let fixed = fixed_wave_vectors([3, 2, 0], 1.0);
    assert_eq!(fixed.len(), 6);
    assert_eq!(fixed[0], [PI / 4.0, PI / 3.0, 0.0]);
}

#[test]
fn largest_frequency_bounds_the_time_step() {
    // Fluid without stress on a line: omega = c |Gamma|, Gamma the transform of the kernel's gradient.
    let equations = elastic(1, 1.3, Medium::at_volume(1.0, 1.0, 1.0, 0.0), ArtificialStress::None, Gradient::Plain);
    let waves = periodic_wave_vectors([200, 1, 1], 1.0);
    let gamma =
        |k: f64| (1..3).map(|n| 2.0 * Smoothing::CubicSpline.derivative(n as f64, 1.3, 1) * (k * n as f64).sin()).sum::<f64>();
    let expected = waves.iter().map(|k| gamma(k[0]).abs()).fold(0.0, f64::max);
    assert!((equations.largest_frequency(&waves) - expected).abs() < 1e-12);
}
