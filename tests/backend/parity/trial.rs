//! One case: the state that the f64 twin leads, the GPU, and what came of comparing them.

use super::compare::{Row, Seen, assert_rounding_decides_nothing, compare};
use super::tables::{convert, different, download, names, upload};
use bytemuck::bytes_of;
use lithosph::backend::gpu::{Gpu, Options, Patch};
use lithosph::backend::shader::{self, Access, compose};
use lithosph::fields::Field;
use lithosph::method::Method;
use lithosph::pass::{Call, Pass, Stage};
use lithosph::rows::Clock;
use lithosph::state::State;
use lithosph::step;
use lithosph::tensor::Space;
use std::collections::BTreeSet;

/// What a run dispatches from its beginning through its first step.
pub fn calls(method: &Method) -> Vec<Call> {
    let before = step::prepare(method).into_iter().chain(step::begin_segment(method));
    let fetched = step::before_fetch(method, &step::fields(method));
    before.chain(step::begin_run(method)).chain(step::step(method)).chain(fetched).collect()
}

/// Tables that a pass can write, by reflection on its shader.
fn writable<S: Space>(pass: Pass, state: &State<S>) -> BTreeSet<&'static str> {
    let text = compose(pass, &state.method);
    let known = names(state);
    let mut list = BTreeSet::new();
    for entry in pass.entries() {
        let bindings = shader::reflect(&text, entry.name).unwrap().bindings;
        for binding in bindings.iter().filter(|binding| binding.kind == Access::ReadWrite) {
            if binding.name == "destination" {
                list.extend(state.columns.present().iter().filter(|field| field.carried()).map(|field| field.name()));
                continue;
            }
            let name = known.iter().find(|name| **name == binding.name);
            list.insert(name.unwrap_or_else(|| panic!("{} writes {}, which the host lacks", pass.name(), binding.name)));
        }
    }
    list
}

/// A GPU, beside it another one with the neighbour list in parts, and the f64 twin, which leads.
pub struct Trial<W: Space, N: Space> {
    pub truth: State<W>,
    before: State<N>,
    gpu: Gpu,
    split: Gpu,
    pub rows: Vec<Row>,
}

impl<W: Space<Real = f64>, N: Space<Real = f32>> Trial<W, N> {
    pub fn new(adapter: &wgpu::Adapter, state: State<N>, patch: Option<Patch>) -> Self {
        assert!(state.params.count >= 1000);
        let gpu = Gpu::with_options(adapter, &state, Options { longest_part: None, patch }).unwrap();
        let split = Gpu::with_options(adapter, &state, Options { longest_part: Some(300), patch: None }).unwrap();
        assert!(gpu.parts() == 1 && split.parts() > 3);
        Self { truth: convert(&state), before: state, gpu, split, rows: Vec::new() }
    }

    /// Runs a call everywhere and compares.
    pub fn run(&mut self, call: Call) {
        self.before = convert(&self.truth);
        self.truth = convert(&self.before);
        let mut twin = self.before.clone();
        assert_rounding_decides_nothing(call.pass, &self.truth);
        call.pass.run(&mut self.truth, call.stage);
        call.pass.run(&mut twin, call.stage);
        upload(&mut self.gpu, &self.before);
        self.gpu.run_calls(&[call]).unwrap();
        let mut seen = self.before.clone();
        let written = writable(call.pass, &self.before);
        // What acts between groups lists no neighbours.
        let counts = Some(Field::NeighborCount.name()).filter(|_| !self.before.method.between);
        let names: Vec<&str> = written.iter().copied().chain(counts).collect();
        download(&self.gpu, &mut seen, &names);
        for name in &written {
            let seen = Seen { before: &self.before, truth: &self.truth, twin: &twin, gpu: &seen };
            self.rows.extend(compare(call.pass, name, &seen));
        }
    }

    /// The split list must not change a bit; after [`Self::run`] of the same call.
    pub fn assert_split_alike(&mut self, call: Call) {
        upload(&mut self.split, &self.before);
        self.split.run_calls(&[call]).unwrap();
        let (mut whole, mut split) = (self.before.clone(), self.before.clone());
        let all = names(&self.before);
        download(&self.gpu, &mut whole, &all);
        download(&self.split, &mut split, &all);
        // Entries beyond a particle's count are left over from before, and the order in a cell is not settled yet.
        let tables = different(&whole, &split);
        let settled = |name: &&&str| **name != "cell_particles" || call.pass != Pass::FillCells;
        assert_eq!(tables.iter().filter(settled).collect::<Vec<_>>(), [&""; 0], "{}", call.pass.name());
    }

    /// Clocks and motions that take each way through the end of a step.
    pub fn run_ends(&mut self) {
        let mut calm = self.before.clone();
        calm.clock = Clock { running: 1, rebuild: 1, ..calm.clock };
        // Slow, and where the list was built.
        calm.columns.velocity.iter_mut().for_each(|v| *v = *v * 0.1);
        if !calm.columns.listed_displacement.is_empty() {
            calm.columns.listed_displacement = calm.columns.displacement.clone();
        }
        self.run_end(calm.clone());
        assert_eq!(self.truth.clock.rebuild, 0);
        let next = self.truth.clock.step as f32;

        let mut moved = calm.clone();
        // A Total Lagrangian list holds for ever.
        if let Some(listed) = moved.columns.listed_displacement.get_mut(500) {
            listed[0] += 2.0 * moved.params.slack;
            self.run_end(moved);
            assert_eq!(self.truth.clock.rebuild, 1);
        }

        // In one block, acceleration bounds the step.
        let mut pulled = calm.clone();
        let hard = 40.0 * pulled.bodies[0].sound_speed.powi(2) / pulled.bodies[0].smoothing_length;
        pulled.columns.acceleration[300..310].iter_mut().for_each(|a| a[0] += hard);
        self.run_end(pulled);
        let fixed = calm.params.fixed_step > 0.0;
        assert!(fixed || self.truth.clock.step < 0.9 * f64::from(next));

        let usual = calm.clock;
        // So early that the few digits of what is left do not decide.
        let early = Clock { elapsed: 9.3 * usual.step, ..usual };
        let ends_in = |left: f32| Clock { duration: early.elapsed + usual.step + left * next, ..early };
        for clock in [
            Clock { rebuild: 0, ..usual },
            Clock { step: 0.0, elapsed: 0.0, elapsed_carry: 0.0, ..usual },
            Clock { step: 0.0, elapsed: 0.0, elapsed_carry: 0.0, arrived: 1, ..usual },
            Clock { step: 0.0, elapsed: 0.0, elapsed_carry: 0.0, arrived: 1, duration: 3.0 * calm.params.interval, ..usual },
            ends_in(0.7),
            ends_in(1.5),
            ends_in(2e-6),
            Clock { steps_left: 1, ..usual },
            Clock { fault: 3, ..usual },
        ] {
            self.run_end(State { clock, ..calm.clone() });
        }
    }

    /// Groups of which one has stopped, has a fault, or has moved; and a fault of the list between them.
    pub fn run_meetings(&mut self) {
        let mut usual = self.before.clone();
        usual.clock = Clock { running: 1, rebuild: 1, fault: 0, ..usual.clock };
        let stepped = usual.clock.step;
        for (k, group) in usual.group_clocks.iter_mut().enumerate() {
            *group = Clock { running: 1, fault: 0, step: stepped * (1.3 - 0.2 * k as f32), ..*group };
        }
        usual.columns.velocity.iter_mut().for_each(|v| *v = *v * 0.1);
        usual.columns.contact_rate.iter_mut().for_each(|rate| *rate = 0.0);
        let touching = !usual.columns.listed_displacement.is_empty();
        if touching {
            usual.columns.listed_displacement = usual.columns.displacement.clone();
        }
        let mut end = |state: State<N>| {
            self.truth = convert(&state);
            self.run(Call { pass: Pass::BoundBetween, stage: Stage::default() });
            self.truth.clock
        };
        let calm = end(usual.clone());
        assert_eq!((calm.running, calm.rebuild, calm.fault), (1, 0, 0));
        assert_eq!(calm.step as f32, usual.group_clocks[1].step, "the shortest step is that of the second group");
        if touching {
            let mut moved = usual.clone();
            moved.columns.listed_displacement[500][0] += moved.params.slack;
            assert_eq!(end(moved).rebuild, 1);
        }
        if !usual.columns.contact_rate.is_empty() {
            let mut stiff = usual.clone();
            stiff.columns.contact_rate[500] = (stiff.params.cfl / (0.5 * stepped)).powi(2);
            let halved = end(stiff).step as f32;
            assert!((halved / (0.5 * stepped) - 1.0).abs() < 1e-5, "{halved} for half of {stepped}");
        }
        let mut over = usual.clone();
        over.group_clocks[0].running = 0;
        assert_eq!(end(over).running, 0);
        let mut broken = usual.clone();
        (broken.group_clocks[1].fault, broken.group_clocks[1].running) = (3, 0);
        let clock = end(broken);
        assert_eq!((clock.fault, clock.running), (3, 0));
        let mut full = usual.clone();
        full.clock.fault = 1;
        let clock = end(full);
        assert_eq!((clock.fault, clock.running), (1, 0));
    }

    /// Uphill, at the first step, in equilibrium, out of steps, and beyond a fault.
    pub fn run_descent_ends(&mut self) {
        let usual = State { clock: Clock { running: 1, rebuild: 1, ..self.before.clock }, ..self.before.clone() };
        let bound = Call { pass: Pass::BoundResidual, stage: Stage::default() };
        let mut end = |state: State<N>| {
            self.truth = convert(&state);
            self.gpu.write_table("params", bytes_of(&state.params)).unwrap();
            self.run(bound);
            self.truth.clock
        };
        let mut uphill = usual.clone();
        for (v, a) in uphill.columns.velocity.iter_mut().zip(&uphill.columns.acceleration) {
            *v = *a * -usual.clock.step;
        }
        let clock = end(uphill);
        assert_eq!(clock.running, 1, "{clock:?}");
        let mut downhill = usual.clone();
        for (v, a) in downhill.columns.velocity.iter_mut().zip(&downhill.columns.acceleration) {
            *v = *a * usual.clock.step;
        }
        assert_eq!(end(downhill).running, 1);
        let mut found = usual.clone();
        found.params.residual = 1e9;
        let clock = end(found);
        assert_eq!((clock.running, clock.elapsed), (0, clock.duration));
        for clock in
            [Clock { step: 0.0, ..usual.clock }, Clock { steps_left: 1, ..usual.clock }, Clock { fault: 3, ..usual.clock }]
        {
            end(State { clock, ..usual.clone() });
        }
    }

    /// A turn so large that the rotation's higher powers show.
    pub fn run_long_stress(&mut self) {
        let kept = self.before.clone();
        let mut state = kept.clone();
        state.clock.step *= 15.0;
        self.truth = convert(&state);
        self.run(Call { pass: Pass::Stress, stage: Stage::default() });
        self.before = kept;
    }

    fn run_end(&mut self, state: State<N>) {
        self.truth = convert(&state);
        self.run(Call { pass: Pass::BoundTimeStep, stage: Stage::default() });
    }

    /// Over a segment's end every pass must leave every bit alone, on the GPU and in the twin.
    pub fn assert_idle(&mut self) {
        self.before.clock.running = 0;
        let mut twin = self.before.clone();
        upload(&mut self.gpu, &self.before);
        // What comes before the first segment is never called once one is over.
        let mut calls = calls(&self.before.method);
        calls.drain(..step::prepare(&self.before.method).len());
        for call in &calls {
            call.pass.run(&mut twin, call.stage);
        }
        self.gpu.run_calls(&calls).unwrap();
        let mut seen = self.before.clone();
        let all = names(&self.before);
        download(&self.gpu, &mut seen, &all);
        assert_eq!(different(&self.before, &seen), [""; 0], "an idle step changed the GPU's tables");
        assert_eq!(different(&self.before, &twin), [""; 0], "an idle step changed the twin's tables");
    }
}
