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
use super::machine::{Part, joined};
use super::{Backend, Fetched, Saved};
use crate::fields::Field;
use crate::method::Method;
use crate::pass::Call;
use crate::rows::{Clock, Params};
use crate::state::State;
use crate::step::{self, Act};
use crate::tensor::Space;
use bytemuck::{bytes_of, pod_read_unaligned};
use connection::Connection;
use pace::Pace;
use plan::{Action, Planner};
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
    /// The groups, and after several of them what acts between them.
    members: Vec<Member>,
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

/// One member of a run: its tables, and the commands that work on them.
struct Member {
    tables: Tables,
    planner: Planner,
}

/// The commands of acts in order.
fn planned(link: &Connection, members: &mut [Member], acts: &[Act]) -> Result<Vec<Action>, String> {
    let mut actions = Vec::new();
    for act in acts {
        match *act {
            Act::Call(member, call) => {
                let Member { tables, planner } = &mut members[member];
                actions.extend(planner.actions(link, tables, &[call])?);
            }
            Act::Collect(fields) => copies(members, fields, true, &mut actions),
            Act::Spread(fields) => copies(members, fields, false, &mut actions),
            Act::CollectClocks => copy_clocks(members, true, &mut actions)?,
            Act::SpreadClocks => copy_clocks(members, false, &mut actions)?,
        }
    }
    Ok(actions)
}

/// Copies of columns between the groups that have them and their ranges in the last member.
fn copies(members: &[Member], fields: &[Field], collect: bool, actions: &mut Vec<Action>) {
    let Some((between, groups)) = members.split_last() else { return };
    for &field in fields {
        let Ok(whole) = between.tables.field(field) else { continue };
        let row = whole.bytes / u64::from(between.tables.params.count.max(1));
        let mut first = 0;
        for group in groups {
            if let Ok(own) = group.tables.field(field) {
                let (own, place, bytes) = ((own.buffer.clone(), 0), (whole.buffer.clone(), first), own.bytes);
                let (from, to) = if collect { (own, place) } else { (place, own) };
                actions.push(Action::Copy { from, to, bytes });
            }
            first += row * u64::from(group.tables.params.count);
        }
    }
}

fn copy_clocks(members: &[Member], collect: bool, actions: &mut Vec<Action>) -> Result<(), String> {
    let Some((between, groups)) = members.split_last() else { return Ok(()) };
    let whole = &between.tables.get("group_clocks")?.buffer;
    for (k, group) in (0..).zip(groups) {
        let (own, place) = ((group.tables.get("clock")?.buffer.clone(), 0), (whole.clone(), k * CLOCK_BYTES));
        let (from, to) = if collect { (own, place) } else { (place, own) };
        actions.push(Action::Copy { from, to, bytes: CLOCK_BYTES });
    }
    Ok(())
}

fn write_table(link: &Connection, tables: &Tables, name: &str, bytes: &[u8]) -> Result<(), String> {
    let checked = |wanted: u64| match bytes.len() as u64 == wanted {
        true => Ok(()),
        false => Err(format!("{name} holds {wanted} bytes, not {}", bytes.len())),
    };
    match name {
        "params" => {
            checked(size_of::<Params<f32>>() as u64)?;
            tables.write_params(link, &pod_read_unaligned(bytes))
        }
        "neighbors" => {
            let params = &tables.params;
            checked(4 * u64::from(params.count) * u64::from(params.list_capacity))?;
            tables.write_neighbors(link, &tables::words(bytes).collect::<Vec<_>>())
        }
        _ => {
            let table = tables.get(name)?;
            checked(table.bytes)?;
            link.write(&table.buffer, bytes)
        }
    }
}

/// Bytes of some of a member's fields.
fn read_fields(link: &Connection, tables: &Tables, fields: &[Field]) -> Result<Vec<Vec<u8>>, String> {
    let tables = fields.iter().map(|&field| tables.field(field)).collect::<Result<Vec<_>, _>>()?;
    let wanted: Vec<_> = tables.iter().map(|table| (&table.buffer, table.bytes)).collect();
    link.read(&wanted)
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
        Self::open(adapter, &[state], options)
    }

    /// A run of the members that [`crate::scene::Scene::members`] gives.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_members<S: Space<Real = f32>>(adapter: &wgpu::Adapter, states: &[State<S>]) -> Result<Self, String> {
        Self::open(adapter, &states.iter().collect::<Vec<_>>(), Options::default())
    }

    fn open<S: Space<Real = f32>>(adapter: &wgpu::Adapter, states: &[&State<S>], options: Options) -> Result<Self, String> {
        let info = DeviceInfo::of(adapter);
        let link = Connection::open(adapter, TIMESTAMPS)?;
        let Options { longest_part, mut patch } = options;
        let mut members = Vec::new();
        for state in states {
            let tables = Tables::new(&link, &info, state, longest_part)?;
            members.push(Member { tables, planner: Planner::new(&state.method, patch.take()) });
        }
        let methods: Vec<Method> = states.iter().map(|state| state.method.clone()).collect();
        let steps = step::steps(&methods);
        let mut plan = |acts: &[Act]| planned(&link, &mut members, acts);
        let prepare = plan(&steps.prepare)?;
        let begin_segment = plan(&steps.begin_segment)?;
        let begin_run = plan(&steps.begin_run)?;
        let bound = plan(&steps.bound)?;
        let step = plan(&steps.step)?;
        let clock = link.buffer("clock copy", CLOCK_BYTES, BufferUsages::MAP_READ | BufferUsages::COPY_DST)?;
        let most = states.iter().map(|state| state.params.count).max().unwrap_or(0);
        let descends = methods.iter().any(|method| method.quasi_static.is_some());
        let start = states.first().map_or(0.0, |state| f64::from(state.clock.start));
        Ok(Self {
            link,
            info,
            members,
            prepare,
            begin_segment,
            begin_run,
            bound,
            step,
            clock,
            start,
            pace: Pace::new(most, descends),
        })
    }

    /// The member that tests and timings look at: the first group.
    fn tables(&self) -> &Tables {
        &self.members[0].tables
    }

    /// The clocks of all members; the last tells how far the run is.
    fn clock_buffers(&self) -> Result<Vec<&Buffer>, String> {
        self.members.iter().map(|member| member.tables.get("clock").map(|table| &table.buffer)).collect()
    }

    /// Runs calls once, in order, and waits.
    pub fn run_calls(&mut self, calls: &[Call]) -> Result<(), String> {
        let acts: Vec<Act> = calls.iter().map(|&call| Act::Call(0, call)).collect();
        let actions = planned(&self.link, &mut self.members, &acts)?;
        self.submit(&actions)?;
        self.link.wait()
    }

    /// Overwrites a table of the first group by its shader name with bytes as the host's `State` holds them.
    pub fn write_table(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        write_table(&self.link, self.tables(), name, bytes)
    }

    /// A table by its shader name, as the host's `State` holds it.
    pub fn read_table(&self, name: &str) -> Result<Vec<u8>, String> {
        if name == "neighbors" {
            return Ok(bytemuck::cast_slice(&self.tables().read_neighbors(&self.link)?).to_vec());
        }
        let table = self.tables().get(name)?;
        Ok(self.link.read(&[(&table.buffer, table.bytes)])?.remove(0))
    }

    /// Each particle's neighbour list.
    pub fn fetch_neighbors(&self) -> Result<Vec<Vec<u32>>, String> {
        let counts = self.read_table(Field::NeighborCount.name())?;
        let rows = self.tables().read_neighbors(&self.link)?;
        let rows = rows.chunks(self.tables().params.list_capacity.max(1) as usize);
        Ok(tables::words(&counts).zip(rows).map(|(n, row)| row[..row.len().min(n as usize)].to_vec()).collect())
    }

    /// Parts that the neighbour list comes in.
    pub fn parts(&self) -> usize {
        self.tables().parts.len()
    }

    fn submit<'a>(&self, actions: impl IntoIterator<Item = &'a Action>) -> Result<(), String> {
        let mut encoder = self.link.encoder();
        plan::encode(&mut encoder, actions);
        self.link.submit(encoder)
    }

    /// Brings fields up to date that the steps leave at an earlier time. It may only be called between segments, and starts
    /// the clock for it: passes do nothing while the clock is stopped.
    fn refresh(&mut self, fields: &[Field]) -> Result<(), String> {
        let methods: Vec<Method> = self.members.iter().map(|member| member.planner.method.clone()).collect();
        let acts = step::refresh(&methods, fields);
        if acts.is_empty() {
            return Ok(());
        }
        let actions = planned(&self.link, &mut self.members, &acts)?;
        let running = |value: u32| {
            let place = offset_of!(Clock<f32>, running) as u64;
            for clock in self.clock_buffers()? {
                self.link.queue.write_buffer(clock, place, &value.to_ne_bytes());
            }
            Ok::<(), String>(())
        };
        running(1)?;
        self.submit(&actions)?;
        running(0)
    }

    fn read_clock(&self) -> Result<Clock<f64>, String> {
        let mut encoder = self.link.encoder();
        let clocks = self.clock_buffers()?;
        encoder.copy_buffer_to_buffer(clocks[clocks.len() - 1], 0, &self.clock, 0, CLOCK_BYTES);
        self.link.submit(encoder)?;
        let seen: Clock<f32> = self.link.map(&self.clock, CLOCK_BYTES, pod_read_unaligned)?;
        Ok(Clock { start: self.start, ..seen.to_f64() })
    }

    /// Sets the clock for a segment; the counts of steps and lists go on through the whole run.
    fn write_clock(&self, start: f64, duration: f64, steps: u32) -> Result<(), String> {
        let (start, duration) = (start as f32, duration as f32);
        let clock = Clock { start, duration, steps_left: steps, running: 1, rebuild: 1, ..Clock::default() };
        let bytes = bytes_of(&clock);
        for buffer in self.clock_buffers()? {
            let write = |begin: usize, end: usize| {
                self.link.queue.write_buffer(buffer, begin as u64, &bytes[begin..end]);
            };
            write(0, offset_of!(Clock<f32>, steps_done));
            write(offset_of!(Clock<f32>, running), offset_of!(Clock<f32>, lists_built));
            write(offset_of!(Clock<f32>, fault), bytes.len());
        }
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
        self.members.iter().map(|member| member.tables.bytes()).sum()
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
        let alone = self.members.len() == 1;
        let mut parts = Vec::new();
        for Member { tables, .. } in &self.members {
            let present: Vec<Field> = fields.iter().copied().filter(|&field| alone || tables.field(field).is_ok()).collect();
            let bytes = read_fields(&self.link, tables, &present)?;
            let columns = present.iter().zip(bytes).map(|(&field, bytes)| (field, tables::numbers(field, &bytes))).collect();
            parts.push(Part { particles: tables.params.count as usize, columns });
        }
        if alone { Ok(parts.remove(0).columns) } else { joined(fields, &parts, |field| self.tables().words(field) as usize) }
    }

    fn save(&mut self) -> Result<Vec<Saved>, String> {
        let groups = self.members.iter().filter(|member| !member.planner.method.between);
        let of_group = |member: &Member| {
            let fields: Vec<Field> = member.tables.carried().collect();
            let bytes = read_fields(&self.link, &member.tables, &fields)?;
            Ok(fields.into_iter().zip(bytes).collect())
        };
        groups.map(of_group).collect()
    }

    fn load(&mut self, groups: &[Saved]) -> Result<(), String> {
        for (Member { tables, .. }, columns) in self.members.iter().zip(groups) {
            for (field, bytes) in columns {
                write_table(&self.link, tables, field.name(), bytes)?;
            }
        }
        Ok(())
    }

    fn clocks(&mut self) -> Result<Vec<Clock<f64>>, String> {
        let wanted: Vec<_> = self.clock_buffers()?.into_iter().map(|buffer| (buffer, CLOCK_BYTES)).collect();
        let clock = |bytes: Vec<u8>| pod_read_unaligned::<Clock<f32>>(&bytes[..size_of::<Clock<f32>>()]).to_f64();
        Ok(self.link.read(&wanted)?.into_iter().map(clock).collect())
    }

    fn set_clocks(&mut self, clocks: &[Clock<f64>]) -> Result<(), String> {
        self.pace.steps_done = clocks.last().map_or(0, |clock| clock.steps_done);
        for (buffer, clock) in self.clock_buffers()?.into_iter().zip(clocks) {
            self.link.queue.write_buffer(buffer, 0, bytes_of(&Clock::<f32>::of(clock)));
        }
        self.link.check()
    }

    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String> {
        let plan = |call: &Call| planned(&self.link, &mut self.members, &[Act::Call(0, *call)]);
        let plans = calls.iter().map(plan).collect::<Result<Vec<_>, _>>()?;
        if plans.is_empty() {
            return Ok(Vec::new());
        }
        let clock = self.tables().get("clock")?.buffer.clone();
        let kept = self.link.table("kept clock", CLOCK_BYTES)?;
        self.submit([&Action::Copy { from: (clock.clone(), 0), to: (kept.clone(), 0), bytes: CLOCK_BYTES }])?;
        let restore = Action::Copy { from: (kept, 0), to: (clock, 0), bytes: CLOCK_BYTES };
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
