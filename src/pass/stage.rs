//! Numbers by which calls of the same pass within one step differ.

/// Numbers that tell calls of the same pass in one step apart; `override` constants of the shader.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// Time at which prescribed velocities are taken, as a fraction of the step.
    pub time: f64,
    /// Runge-Kutta: weight of this stage's rate in the sum.
    pub weight: f64,
    /// The next state is start + step (`of_sum` sum + `of_rate` rate).
    pub of_sum: f64,
    pub of_rate: f64,
    pub first: bool,
    pub last: bool,
    /// Part of the step that a kick or a drift takes.
    pub part: f64,
    /// True: the pass sorts, lists or sums over the positions of the reference configuration; false: over the present ones.
    pub reference: bool,
}

impl Default for Stage {
    fn default() -> Self {
        Self { time: 0.0, weight: 0.0, of_sum: 0.0, of_rate: 0.0, first: false, last: false, part: 0.5, reference: false }
    }
}

impl Stage {
    /// Name and value of every override constant; a shader takes those that it declares.
    pub fn constants(&self) -> [(&'static str, f64); 8] {
        [
            ("stage_time", self.time),
            ("stage_weight", self.weight),
            ("stage_of_sum", self.of_sum),
            ("stage_of_rate", self.of_rate),
            ("stage_first", f64::from(u8::from(self.first))),
            ("stage_last", f64::from(u8::from(self.last))),
            ("stage_part", self.part),
            ("stage_reference", f64::from(u8::from(self.reference))),
        ]
    }
}
