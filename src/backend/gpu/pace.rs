//! How many steps to hand to the device at once.

use crate::rows::Clock;

/// Seconds that a batch should take: short enough to stay responsive, long enough to hide the wait.
const TARGET: f64 = 0.5;
/// Fewest steps of a batch where particles are few: the wait for a shorter batch would cost more than the batch.
const LEAST: u32 = 50;
const FEW_PARTICLES: u32 = 1_000_000;
const MOST: u32 = 100_000;

pub struct Pace {
    least: u32,
    seconds_per_step: Option<f64>,
    /// The last time step seen.
    step: f64,
    /// Time and steps that the segment still takes.
    time_left: f64,
    steps_left: u32,
    pub steps_done: u32,
    fresh: bool,
    /// The steps of a segment do not follow from its length: they descend to equilibrium.
    descends: bool,
}

impl Pace {
    pub fn new(particles: u32, descends: bool) -> Self {
        let least = if particles < FEW_PARTICLES { LEAST } else { 1 };
        Self { least, seconds_per_step: None, step: 0.0, time_left: 0.0, steps_left: 0, steps_done: 0, fresh: true, descends }
    }

    pub fn begin_segment(&mut self, duration: f64, steps: u32) {
        (self.time_left, self.steps_left, self.fresh) = (duration, steps, true);
    }

    /// Steps for the next batch: about half a second of work, and not many more than the segment takes.
    pub fn steps(&self) -> u32 {
        let affordable = self.seconds_per_step.map_or(self.least, |seconds| (TARGET / seconds) as u32);
        // Steps may grow shorter on the way; the rest then waits for the next batch.
        let needed = if self.step > 0.0 && !self.descends { (self.time_left / self.step).ceil() as u32 } else { u32::MAX };
        let needed = needed.saturating_add(1).min(self.steps_left);
        affordable.clamp(self.least, MOST).min(needed).max(1)
    }

    /// Learns from a batch: the clock after it, and the seconds that it took.
    pub fn learn(&mut self, clock: &Clock<f64>, seconds: f64) {
        let done = clock.steps_done.wrapping_sub(self.steps_done);
        let measured = seconds / f64::from(done.max(1));
        self.seconds_per_step = match self.seconds_per_step {
            // Steps past the segment's end, and a segment's beginning, both make a step look longer than it is. Such a batch
            // may only lower the estimate.
            Some(known) if clock.running == 0 || self.fresh => Some(known.min(measured)),
            _ => Some(measured),
        };
        if clock.step.is_finite() {
            self.step = clock.step;
        }
        self.time_left = clock.duration - clock.elapsed;
        (self.steps_left, self.steps_done, self.fresh) = (clock.steps_left, clock.steps_done, false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock(elapsed: f64, steps_done: u32) -> Clock<f64> {
        Clock { duration: 1.0, elapsed, step: 1e-3, steps_left: 10_000, steps_done, running: 1, ..Clock::default() }
    }

    #[test]
    fn batches_grow_to_half_a_second_and_end_with_the_segment() {
        let mut pace = Pace::new(1000, false);
        pace.begin_segment(1.0, 10_000);
        assert_eq!(pace.steps(), LEAST);
        pace.learn(&clock(0.05, 50), 0.05);
        assert_eq!(pace.steps(), 500);
        pace.learn(&clock(0.9, 900), 0.5);
        assert!((100..=102).contains(&pace.steps()));
    }

    #[test]
    fn slow_steps_come_few_at_a_time() {
        let mut pace = Pace::new(2_000_000, false);
        pace.begin_segment(1.0, 3);
        assert_eq!(pace.steps(), 1);
        pace.learn(&clock(0.001, 1), 0.2);
        assert_eq!(pace.steps(), 2);
        pace.learn(&clock(0.002, 2), 3.0);
        assert_eq!(pace.steps(), 1);
    }
}
