//! The CPU path: the twins, on all cores. In f64 it is the reference, and the fallback where there is no GPU.

use super::machine::{Part, joined};
use super::{Backend, Fetched, Saved};
use crate::bond::BondTable;
use crate::fields::{Columns, Field, Type};
use crate::method::Method;
use crate::pass::{Call, Pass};
use crate::rows::Clock;
use crate::state::State;
use crate::step::{self, Act, Steps};
use crate::tensor::{Real, Space};
use std::time::{Duration, Instant};

/// Steps host states.
pub struct Cpu<S: Space> {
    /// The groups, and after several of them what acts between them.
    pub members: Vec<State<S>>,
    /// Whether the passes of [`crate::step::prepare`] have run.
    prepared: bool,
    steps: Steps,
}

impl<S: Space> Cpu<S> {
    /// A run of one group.
    pub fn new(state: State<S>) -> Self {
        Self::of_members(vec![state])
    }

    /// The state of the first group.
    pub fn into_state(mut self) -> State<S> {
        self.members.swap_remove(0)
    }

    /// A run of the members that [`crate::scene::Scene::members`] gives.
    pub fn of_members(members: Vec<State<S>>) -> Self {
        let methods: Vec<Method> = members.iter().map(|state| state.method.clone()).collect();
        Self { steps: step::steps(&methods), prepared: false, members }
    }

    /// Makes the tables of distinct bonds, then runs the passes that correct gradients again: made with kernel values from the
    /// table, the corrections agree with the sums of the steps to the last digit.
    fn tabulate(&mut self) {
        for state in self.members.iter_mut().filter(|state| state.method.bond_table) {
            state.bond_table = BondTable::new(state);
            let calls = step::prepare(&state.method);
            for call in calls.iter().filter(|call| matches!(call.pass, Pass::CorrectReference | Pass::CorrectQuadratic)) {
                call.pass.run(state, call.stage);
            }
        }
    }

    fn run(&mut self, acts: &[Act]) {
        for act in acts {
            match *act {
                Act::Call(member, Call { pass, stage }) => pass.run(&mut self.members[member], stage),
                Act::Collect(fields) => self.copy(fields, true),
                Act::Spread(fields) => self.copy(fields, false),
                Act::CollectClocks => {
                    let Some((between, groups)) = self.members.split_last_mut() else { continue };
                    between.group_clocks.iter_mut().zip(groups).for_each(|(clock, group)| *clock = group.clock);
                }
                Act::SpreadClocks => {
                    let Some((between, groups)) = self.members.split_last_mut() else { continue };
                    groups.iter_mut().zip(&between.group_clocks).for_each(|(group, clock)| group.clock = *clock);
                }
            }
        }
    }

    /// Copies columns between the groups and their ranges in the last member.
    fn copy(&mut self, fields: &[Field], collect: bool) {
        let Some((between, groups)) = self.members.split_last_mut() else { return };
        for &field in fields {
            let whole = between.columns.bytes_mut(field);
            let row = whole.len() / (between.params.count.max(1) as usize);
            let mut first = 0;
            for group in groups.iter_mut() {
                let last = first + row * group.params.count as usize;
                let (own, place) = (group.columns.bytes_mut(field), &mut whole[first..last]);
                first = last;
                match (own.is_empty(), collect) {
                    (true, _) => {}
                    (false, true) => place.copy_from_slice(own),
                    (false, false) => own.copy_from_slice(place),
                }
            }
        }
    }

    /// The clock that tells how far the run is.
    fn clock(&self) -> &Clock<S::Real> {
        &self.members[self.members.len() - 1].clock
    }
}

/// Time that one call to `advance` may take, after which the run loop looks for an interrupt.
const PATIENCE: Duration = Duration::from_millis(100);

impl<S: Space> Backend for Cpu<S> {
    fn describe(&self) -> String {
        format!("CPU, {} threads, f{}", rayon::current_num_threads(), 8 * size_of::<S::Real>())
    }

    fn bytes(&self) -> u64 {
        self.members.iter().map(State::bytes).sum()
    }

    fn begin_segment(&mut self, start: f64, duration: f64, steps: u32, first: bool) -> Result<(), String> {
        let zero = S::Real::of(0.0);
        for state in &mut self.members {
            state.clock = Clock {
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
                ..state.clock
            };
        }
        let steps = std::mem::take(&mut self.steps);
        if !std::mem::replace(&mut self.prepared, true) {
            self.run(&steps.prepare);
            self.tabulate();
        }
        self.run(&steps.begin_segment);
        if first {
            self.run(&steps.begin_run);
        }
        self.run(&steps.bound);
        self.steps = steps;
        Ok(())
    }

    fn advance(&mut self) -> Result<Clock<f64>, String> {
        let begin = Instant::now();
        let step = std::mem::take(&mut self.steps.step);
        // The whole call runs on a worker thread, so that the pool stays awake from pass to pass.
        rayon::scope(|_| {
            while self.clock().running == 1 && begin.elapsed() < PATIENCE {
                self.run(&step);
            }
        });
        self.steps.step = step;
        Ok(self.clock().to_f64())
    }

    fn fetch(&mut self, fields: &[Field]) -> Result<Fetched, String> {
        let running: Vec<u32> = self.members.iter_mut().map(|state| std::mem::replace(&mut state.clock.running, 1)).collect();
        let methods: Vec<Method> = self.members.iter().map(|state| state.method.clone()).collect();
        self.run(&step::refresh(&methods, fields));
        self.members.iter_mut().zip(running).for_each(|(state, running)| state.clock.running = running);
        let part = |state: &State<S>| {
            let column = |&field: &Field| (field, numbers::<S>(field, state.columns.bytes(field)));
            let present = fields.iter().filter(|&&field| self.members.len() == 1 || !state.columns.bytes(field).is_empty());
            Part { particles: state.params.count as usize, columns: present.map(column).collect() }
        };
        let mut parts: Vec<Part> = self.members.iter().map(part).collect();
        if parts.len() == 1 {
            Ok(parts.remove(0).columns)
        } else {
            joined(fields, &parts, |field| field.kind().words_in(S::DIMENSION))
        }
    }

    fn save(&mut self) -> Result<Vec<Saved>, String> {
        let of_group = |columns: &Columns<S>| {
            columns.present().into_iter().filter(|f| f.carried()).map(|f| (f, columns.bytes(f).to_vec())).collect()
        };
        Ok(self.members.iter().filter(|state| !state.method.between).map(|state| of_group(&state.columns)).collect())
    }

    fn load(&mut self, groups: &[Saved]) -> Result<(), String> {
        let members = self.members.iter_mut().filter(|state| !state.method.between);
        for (state, columns) in members.zip(groups) {
            for (&field, bytes) in columns {
                let column = state.columns.bytes_mut(field);
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
        }
        Ok(())
    }

    fn clocks(&mut self) -> Result<Vec<Clock<f64>>, String> {
        Ok(self.members.iter().map(|state| state.clock.to_f64()).collect())
    }

    fn set_clocks(&mut self, clocks: &[Clock<f64>]) -> Result<(), String> {
        self.members.iter_mut().zip(clocks).for_each(|(state, clock)| state.clock = Clock::of(clock));
        Ok(())
    }

    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String> {
        let mut list = Vec::new();
        for call in calls {
            // The clock is set back for every call: a pass that advances it would soon end the segment.
            let state = &mut self.members[0];
            let clock = state.clock;
            let begin = processor_seconds();
            for _ in 0..repeats {
                call.pass.run(state, call.stage);
                state.clock = clock;
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
