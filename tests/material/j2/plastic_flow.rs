//! The rate equations of J2 flow on a prescribed path F(t), integrated by the classical Runge-Kutta method: an answer
//! that shares nothing with the return map but the law itself.
//!
//! With l the velocity gradient and s = mu b^D, b the isochoric elastic left Cauchy-Green tensor,
//! db/dt = l^D b + b (l^D)^T - 3 (k'/q) s b, where q = sqrt(3/2 s:s) and k' keeps q = sY(k).

use super::yield_stress;
use crate::common::matrix::*;
use lithosph::material::j2::J2;
use lithosph::rows::Body;

pub struct Flow<'a> {
    pub body: Body<f64>,
    pub path: &'a dyn Fn(f64) -> M,
}

impl Flow<'_> {
    fn stress(&self, b: &M) -> (M, f64) {
        let s = scaled(&deviator(b), self.body.shear_modulus);
        let q = (1.5 * inner(&s, &s)).sqrt();
        (s, q)
    }

    /// l^D by central differences, good to 1e-10.
    fn velocity_gradient(&self, t: f64) -> M {
        let e = 1e-5;
        let (after, before) = ((self.path)(t + e), (self.path)(t - e));
        let rate = scaled(&plus(&after, -1.0, &before), 0.5 / e);
        deviator(&times(&rate, &inverse(&(self.path)(t))))
    }

    /// Rates of b and k.
    fn rates(&self, t: f64, b: &M, k: f64) -> (M, f64) {
        let l = self.velocity_gradient(t);
        let lb = times(&l, b);
        let elastic = plus(&lb, 1.0, &transposed(&lb));
        let (s, q) = self.stress(b);
        let flow = scaled(&times(&s, b), 3.0 / q);
        let scale = 1.5 * self.body.shear_modulus / q;
        let own = J2::of(&self.body);
        let power = own.hardening_exponent;
        let slope = own.hardening * power * k.powf(power - 1.0);
        let growth = scale * inner(&s, &elastic) / (slope + scale * inner(&s, &flow));
        assert!(growth >= 0.0, "the path unloads at {t}");
        (plus(&elastic, -growth, &flow), growth)
    }

    /// Isochoric elastic tensor of an elastic path, and its Mises stress.
    fn elastic(&self, t: f64) -> (M, f64) {
        let f = (self.path)(t);
        let b = scaled(&times(&f, &transposed(&f)), determinant(&f).powf(-2.0 / 3.0));
        let q = self.stress(&b).1;
        (b, q)
    }

    /// Kirchhoff's deviator and k at time 1, in so many steps from the onset of yield, from a k above 0: there the
    /// slope of a power is infinite.
    pub fn run(&self, k: f64, steps: u32) -> (M, f64) {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.elastic(middle).1 < yield_stress(&self.body, k) { low = middle } else { high = middle }
        }
        let (mut t, mut b, mut k) = (high, self.elastic(high).0, k);
        let step = (1.0 - t) / f64::from(steps);
        for _ in 0..steps {
            let (b1, k1) = self.rates(t, &b, k);
            let (b2, k2) = self.rates(t + 0.5 * step, &plus(&b, 0.5 * step, &b1), k + 0.5 * step * k1);
            let (b3, k3) = self.rates(t + 0.5 * step, &plus(&b, 0.5 * step, &b2), k + 0.5 * step * k2);
            let (b4, k4) = self.rates(t + step, &plus(&b, step, &b3), k + step * k3);
            for (part, rate) in [(1.0, b1), (2.0, b2), (2.0, b3), (1.0, b4)] {
                b = plus(&b, step * part / 6.0, &rate);
            }
            k += step * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
            t += step;
        }
        (self.stress(&b).0, k)
    }
}
