//! The CPU path: the twins, on all cores. In f64 it is the reference, and the fallback where there is no GPU.

use super::{Backend, Fetched};
use crate::bond::BondTable;
use crate::fields::{Field, Type};
use crate::pass::{Call, Pass};
use crate::rows::Clock;
use crate::state::State;
use crate::step;
use crate::tensor::{Real, Space};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Steps a host state.
pub struct Cpu<S: Space> {
    pub state: State<S>,
    /// Whether the passes of [`crate::step::prepare`] have run.
    prepared: bool,
    step: Vec<Call>,
}

impl<S: Space> Cpu<S> {
    pub fn new(state: State<S>) -> Self {
        Self { step: step::step(&state.method), prepared: false, state }
    }

    /// Makes the table of distinct bonds, then runs the passes that correct gradients again: made with kernel values from the
    /// table, the corrections agree with the sums of the steps to the last digit.
    fn tabulate(&mut self) {
        let state = &mut self.state;
        if state.method.bond_table {
            state.bond_table = BondTable::new(state);
            let calls = step::prepare(&state.method);
            let after: Vec<Call> =
                calls.into_iter().filter(|call| matches!(call.pass, Pass::CorrectReference | Pass::CorrectQuadratic)).collect();
            self.run(&after);
        }
    }

    fn run(&mut self, calls: &[Call]) {
        for call in calls {
            call.pass.run(&mut self.state, call.stage);
        }
    }
}

/// Time that one call to `advance` may take, after which the run loop looks for an interrupt.
const PATIENCE: Duration = Duration::from_millis(100);

impl<S: Space> Backend for Cpu<S> {
    fn describe(&self) -> String {
        format!("CPU, {} threads, f{}", rayon::current_num_threads(), 8 * size_of::<S::Real>())
    }

    fn bytes(&self) -> u64 {
        self.state.bytes()
    }

    fn begin_segment(&mut self, start: f64, duration: f64, steps: u32, first: bool) -> Result<(), String> {
        let zero = S::Real::of(0.0);
        self.state.clock = Clock {
            start: S::Real::of(start),
            elapsed: zero,
            elapsed_carry: zero,
            step: zero,
            duration: S::Real::of(duration),
            steps_left: steps,
            running: 1,
            rebuild: 1,
            fault: 0,
            residual: zero,
            ..self.state.clock
        };
        let method = self.state.method.clone();
        if !std::mem::replace(&mut self.prepared, true) {
            self.run(&step::prepare(&method));
            self.tabulate();
        }
        self.run(&step::begin_segment(&method));
        if first {
            self.run(&step::begin_run(&method));
        }
        self.run(&[step::bound(&method)]);
        Ok(())
    }

    fn advance(&mut self) -> Result<Clock<f64>, String> {
        let begin = Instant::now();
        let step = self.step.clone();
        // The whole call runs on a worker thread, so that the pool stays awake from pass to pass.
        rayon::scope(|_| {
            while self.state.clock.running == 1 && begin.elapsed() < PATIENCE {
                self.run(&step);
            }
        });
        Ok(self.state.clock.to_f64())
    }

    fn fetch(&mut self, fields: &[Field]) -> Result<Fetched, String> {
        let running = std::mem::replace(&mut self.state.clock.running, 1);
        self.run(&step::before_fetch(&self.state.method, fields));
        self.state.clock.running = running;
        let column = |&field: &Field| (field, numbers::<S>(field, self.state.columns.bytes(field)));
        Ok(fields.iter().map(column).collect())
    }

    fn save(&mut self) -> Result<BTreeMap<Field, Vec<u8>>, String> {
        let columns = &self.state.columns;
        Ok(columns.present().into_iter().filter(|f| f.carried()).map(|f| (f, columns.bytes(f).to_vec())).collect())
    }

    fn load(&mut self, columns: &BTreeMap<Field, Vec<u8>>) -> Result<(), String> {
        for (&field, bytes) in columns {
            let column = self.state.columns.bytes_mut(field);
            if column.len() != bytes.len() {
                return Err(format!(
                    "the checkpoint's {} has {} bytes where the scene has {}",
                    field.name(),
                    bytes.len(),
                    column.len()
                ));
            }
            column.copy_from_slice(bytes);
        }
        Ok(())
    }

    fn set_steps_done(&mut self, steps: u32) {
        self.state.clock.steps_done = steps;
    }

    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String> {
        let mut list = Vec::new();
        for call in calls {
            // The clock is set back for every call: a pass that advances it would soon end the segment.
            let clock = self.state.clock;
            let begin = processor_seconds();
            for _ in 0..repeats {
                call.pass.run(&mut self.state, call.stage);
                self.state.clock = clock;
            }
            list.push((call.pass.name().to_string(), (processor_seconds() - begin) / f64::from(repeats)));
        }
        Ok(list)
    }
}

/// Processor seconds that this process has used on all its threads: unlike wall time, fair on a shared machine.
pub fn processor_seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the pointer is to a live timespec.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) };
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A column's bytes as f64.
fn numbers<S: Space>(field: Field, bytes: &[u8]) -> Vec<f64> {
    if field.kind() == Type::Integer {
        return bytemuck::cast_slice::<u8, u32>(bytes).iter().map(|&x| f64::from(x)).collect();
    }
    bytemuck::cast_slice::<u8, S::Real>(bytes).iter().map(|x| x.f64()).collect()
}
