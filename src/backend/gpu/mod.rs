//! The GPU path: shaders in f32, with the state resident on the device.
//!
//! The host encodes many steps ahead and waits only for the clock at the end of a batch; fields come back
//! only when asked for. `connection` is the device, `tables` its buffers, `plan` the commands made from
//! calls, `pace` the number of steps in a batch.

mod connection;
mod pace;
mod plan;
mod tables;
#[cfg(test)]
mod tests;

use super::device::{DeviceInfo, TIMESTAMPS};
use super::{Backend, Fetched};
use crate::fields::Field;
use crate::pass::Call;
use crate::rows::{Clock, Params};
use crate::state::State;
use crate::step;
use crate::tensor::Space;
use bytemuck::{bytes_of, pod_read_unaligned};
use connection::Connection;
use pace::Pace;
use plan::{Action, Planner};
use std::collections::BTreeMap;
use std::mem::offset_of;
use std::time::Instant;
use tables::Tables;
use wgpu::{Buffer, BufferUsages};

pub use plan::Patch;

/// Dispatches of one submission: the device begins while the host encodes the next ones.
const SUBMISSION: usize = 1000;
const CLOCK_BYTES: u64 = size_of::<Clock<f32>>() as u64;

/// What a test changes about a run on the device.
#[derive(Default)]
pub struct Options {
    /// Most particles of one part of the neighbour list.
    pub longest_part: Option<u32>,
    pub patch: Option<Patch>,
}

/// A run on a graphics device.
pub struct Gpu {
    link: Connection,
    info: DeviceInfo,
    tables: Tables,
    planner: Planner,
    /// Commands that run once, before the first segment.
    prepare: Vec<Action>,
    begin_segment: Vec<Action>,
    begin_run: Vec<Action>,
    bound: Vec<Action>,
    step: Vec<Action>,
    /// Mappable copy of the clock.
    clock: Buffer,
    /// When the segment began, with the digits that the device's f32 drops.
    start: f64,
    pace: Pace,
}

impl Gpu {
    /// Opens the device, moves the state there and compiles the passes that its method takes.
    ///
    /// # Errors
    /// One sentence, if the tables do not fit or the device fails.
    pub fn new<S: Space<Real = f32>>(adapter: &wgpu::Adapter, state: &State<S>) -> Result<Self, String> {
        Self::with_options(adapter, state, Options::default())
    }

    pub fn with_options<S: Space<Real = f32>>(
        adapter: &wgpu::Adapter,
        state: &State<S>,
        options: Options,
    ) -> Result<Self, String> {
        let info = DeviceInfo::of(adapter);
        let link = Connection::open(adapter, TIMESTAMPS)?;
        let tables = Tables::new(&link, &info, state, options.longest_part)?;
        let mut planner = Planner::new(&state.method, options.patch);
        let mut plan = |calls: &[Call]| planner.actions(&link, &tables, calls);
        let prepare = plan(&step::prepare(&state.method))?;
        let begin_segment = plan(&step::begin_segment(&state.method))?;
        let begin_run = plan(&step::begin_run(&state.method))?;
        let bound = plan(&[step::bound(&state.method)])?;
        let step = plan(&step::step(&state.method))?;
        let clock = link.buffer("clock copy", CLOCK_BYTES, BufferUsages::MAP_READ | BufferUsages::COPY_DST)?;
        let (start, pace) = (f64::from(state.clock.start), Pace::new(state.params.count, state.method.quasi_static.is_some()));
        Ok(Self { link, info, tables, planner, prepare, begin_segment, begin_run, bound, step, clock, start, pace })
    }

    /// Runs calls once, in order, and waits.
    pub fn run_calls(&mut self, calls: &[Call]) -> Result<(), String> {
        let actions = self.planner.actions(&self.link, &self.tables, calls)?;
        self.submit(&actions)?;
        self.link.wait()
    }

    /// Overwrites a table by its shader name with bytes as the host's `State` holds them.
    pub fn write_table(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let checked = |wanted: u64| match bytes.len() as u64 == wanted {
            true => Ok(()),
            false => Err(format!("{name} holds {wanted} bytes, not {}", bytes.len())),
        };
        match name {
            "params" => {
                checked(size_of::<Params<f32>>() as u64)?;
                self.tables.write_params(&self.link, &pod_read_unaligned(bytes))
            }
            "neighbors" => {
                let params = &self.tables.params;
                checked(4 * u64::from(params.count) * u64::from(params.list_capacity))?;
                self.tables.write_neighbors(&self.link, &tables::words(bytes).collect::<Vec<_>>())
            }
            _ => {
                let table = self.tables.get(name)?;
                checked(table.bytes)?;
                self.link.write(&table.buffer, bytes)
            }
        }
    }

    /// A table by its shader name, as the host's `State` holds it.
    pub fn read_table(&self, name: &str) -> Result<Vec<u8>, String> {
        if name == "neighbors" {
            return Ok(bytemuck::cast_slice(&self.tables.read_neighbors(&self.link)?).to_vec());
        }
        let table = self.tables.get(name)?;
        Ok(self.link.read(&[(&table.buffer, table.bytes)])?.remove(0))
    }

    /// Each particle's neighbour list.
    pub fn fetch_neighbors(&self) -> Result<Vec<Vec<u32>>, String> {
        let counts = self.read_table(Field::NeighborCount.name())?;
        let rows = self.tables.read_neighbors(&self.link)?;
        let rows = rows.chunks(self.tables.params.list_capacity.max(1) as usize);
        Ok(tables::words(&counts).zip(rows).map(|(n, row)| row[..row.len().min(n as usize)].to_vec()).collect())
    }

    /// Parts that the neighbour list comes in.
    pub fn parts(&self) -> usize {
        self.tables.parts.len()
    }

    fn submit<'a>(&self, actions: impl IntoIterator<Item = &'a Action>) -> Result<(), String> {
        let mut encoder = self.link.encoder();
        plan::encode(&mut encoder, actions);
        self.link.submit(encoder)
    }

    /// Brings fields up to date that the steps leave at an earlier time. It may only be called between segments, and starts
    /// the clock for it: passes do nothing while the clock is stopped.
    fn refresh(&mut self, fields: &[Field]) -> Result<(), String> {
        let calls = step::before_fetch(&self.planner.method, fields);
        if calls.is_empty() {
            return Ok(());
        }
        let running = |value: u32| {
            let place = offset_of!(Clock<f32>, running) as u64;
            let clock = &self.tables.get("clock")?.buffer;
            self.link.queue.write_buffer(clock, place, &value.to_ne_bytes());
            Ok::<(), String>(())
        };
        let actions = self.planner.actions(&self.link, &self.tables, &calls)?;
        running(1)?;
        self.submit(&actions)?;
        running(0)
    }

    fn read_clock(&self) -> Result<Clock<f64>, String> {
        let mut encoder = self.link.encoder();
        encoder.copy_buffer_to_buffer(&self.tables.get("clock")?.buffer, 0, &self.clock, 0, CLOCK_BYTES);
        self.link.submit(encoder)?;
        let seen: Clock<f32> = self.link.map(&self.clock, CLOCK_BYTES, pod_read_unaligned)?;
        Ok(Clock { start: self.start, ..seen.to_f64() })
    }

    /// Sets the clock for a segment; the counts of steps and lists go on through the whole run.
    fn write_clock(&self, start: f64, duration: f64, steps: u32) -> Result<(), String> {
        let (start, duration) = (start as f32, duration as f32);
        let clock = Clock { start, duration, steps_left: steps, running: 1, rebuild: 1, ..Clock::default() };
        let bytes = bytes_of(&clock);
        let buffer = &self.tables.get("clock")?.buffer;
        let write = |begin: usize, end: usize| {
            self.link.queue.write_buffer(buffer, begin as u64, &bytes[begin..end]);
        };
        write(0, offset_of!(Clock<f32>, steps_done));
        write(offset_of!(Clock<f32>, running), offset_of!(Clock<f32>, lists_built));
        write(offset_of!(Clock<f32>, fault), bytes.len());
        self.link.check()
    }

    /// Timestamps before and after each call, in the device's ticks.
    fn stamp(&self, plans: &[Vec<Action>], restore: &Action) -> Result<Vec<u64>, String> {
        let count = 2 * plans.len() as u32;
        let descriptor = wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count };
        let queries = self.link.device.create_query_set(&descriptor);
        let bytes = u64::from(count) * u64::from(wgpu::QUERY_SIZE);
        let usage = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
        let resolved = self.link.buffer("timestamps", bytes, usage)?;
        let mut encoder = self.link.encoder();
        for (k, actions) in plans.iter().enumerate() {
            encoder.write_timestamp(&queries, 2 * k as u32);
            plan::encode(&mut encoder, actions);
            encoder.write_timestamp(&queries, 2 * k as u32 + 1);
            plan::encode(&mut encoder, [restore]);
        }
        encoder.resolve_query_set(&queries, 0..count, &resolved, 0);
        self.link.submit(encoder)?;
        let bytes = self.link.read(&[(&resolved, bytes)])?;
        Ok(bytes[0].chunks_exact(8).map(pod_read_unaligned).collect())
    }

    /// Seconds that each call takes, measured once. The clock is set back before every call.
    fn time_once(&self, plans: &[Vec<Action>], restore: &Action) -> Result<Vec<f64>, String> {
        if self.info.timestamps && 2 * plans.len() <= wgpu::QUERY_SET_MAX_QUERIES as usize {
            let period = f64::from(self.link.queue.get_timestamp_period()) * 1e-9;
            let ticks = self.stamp(plans, restore)?;
            return Ok(ticks.chunks(2).map(|pair| pair[1].saturating_sub(pair[0]) as f64 * period).collect());
        }
        let time = |actions: &Vec<Action>| {
            let began = Instant::now();
            self.submit(actions)?;
            self.link.wait()?;
            let seconds = began.elapsed().as_secs_f64();
            self.submit([restore])?;
            Ok(seconds)
        };
        plans.iter().map(time).collect()
    }
}

impl Backend for Gpu {
    fn describe(&self) -> String {
        let driver = format!("{} {}", self.info.driver, self.info.driver_info);
        format!("{} ({}, {}, {}), f32", self.info.name, self.info.kind, self.info.backend, driver.trim())
    }

    fn bytes(&self) -> u64 {
        self.tables.bytes()
    }

    fn begin_segment(&mut self, start: f64, duration: f64, steps: u32, first: bool) -> Result<(), String> {
        self.start = start;
        self.write_clock(start, duration, steps)?;
        self.pace.begin_segment(duration, steps);
        let begin_run: &[Action] = if first { &self.begin_run } else { &[] };
        let prepare = std::mem::take(&mut self.prepare);
        self.submit(prepare.iter().chain(&self.begin_segment).chain(begin_run).chain(&self.bound))
    }

    fn advance(&mut self) -> Result<Clock<f64>, String> {
        let began = Instant::now();
        let mut left = self.pace.steps() as usize;
        let at_once = SUBMISSION.div_ceil(self.step.len().max(1));
        while left > 0 {
            let now = left.min(at_once);
            self.submit(std::iter::repeat_n(&self.step, now).flatten())?;
            left -= now;
        }
        let clock = self.read_clock()?;
        self.pace.learn(&clock, began.elapsed().as_secs_f64());
        Ok(clock)
    }

    fn fetch(&mut self, fields: &[Field]) -> Result<Fetched, String> {
        self.refresh(fields)?;
        let tables = fields.iter().map(|&field| self.tables.field(field)).collect::<Result<Vec<_>, _>>()?;
        let wanted: Vec<_> = tables.iter().map(|table| (&table.buffer, table.bytes)).collect();
        let bytes = self.link.read(&wanted)?;
        Ok(fields.iter().zip(bytes).map(|(&field, bytes)| (field, tables::numbers(field, &bytes))).collect())
    }

    fn save(&mut self) -> Result<BTreeMap<Field, Vec<u8>>, String> {
        let fields: Vec<Field> = self.tables.carried().collect();
        let tables = fields.iter().map(|&field| self.tables.field(field)).collect::<Result<Vec<_>, _>>()?;
        let wanted: Vec<_> = tables.iter().map(|table| (&table.buffer, table.bytes)).collect();
        Ok(fields.into_iter().zip(self.link.read(&wanted)?).collect())
    }

    fn load(&mut self, columns: &BTreeMap<Field, Vec<u8>>) -> Result<(), String> {
        columns.iter().try_for_each(|(field, bytes)| self.write_table(field.name(), bytes))
    }

    fn set_steps_done(&mut self, steps: u32) {
        self.pace.steps_done = steps;
        if let Ok(clock) = self.tables.get("clock") {
            let place = offset_of!(Clock<f32>, steps_done) as u64;
            self.link.queue.write_buffer(&clock.buffer, place, &steps.to_ne_bytes());
        }
    }

    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String> {
        let plan = |call: &Call| self.planner.actions(&self.link, &self.tables, std::slice::from_ref(call));
        let plans = calls.iter().map(plan).collect::<Result<Vec<_>, _>>()?;
        if plans.is_empty() {
            return Ok(Vec::new());
        }
        let clock = self.tables.get("clock")?.buffer.clone();
        let kept = self.link.table("kept clock", CLOCK_BYTES)?;
        self.submit([&Action::Copy { from: clock.clone(), to: kept.clone(), bytes: CLOCK_BYTES }])?;
        let restore = Action::Copy { from: kept, to: clock, bytes: CLOCK_BYTES };
        // Drivers compile at the first dispatch.
        self.time_once(&plans, &restore)?;
        let mut sums = vec![0.0; calls.len()];
        for _ in 0..repeats {
            for (sum, seconds) in sums.iter_mut().zip(self.time_once(&plans, &restore)?) {
                *sum += seconds;
            }
        }
        let mean = |sum: f64| sum / f64::from(repeats.max(1));
        Ok(calls.iter().zip(sums).map(|(call, sum)| (call.pass.name().to_string(), mean(sum))).collect())
    }
}
