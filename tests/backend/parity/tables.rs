//! The tables of a state by their shader names; states in another precision; states full of random numbers.

use super::cases::{CELL, Case, EDGE};
use crate::common::Random;
use bytemuck::{bytes_of, cast_slice, cast_slice_mut, pod_read_unaligned};
use lithosph::backend::gpu::Gpu;
use lithosph::fields::{Columns, Field, Type};
use lithosph::rows::{Balance, Body, Clock, Constraint, ContactPair, FacetPair, Mover, Obstacle, Params};
use lithosph::state::State;
use lithosph::tensor::{Linear, Real, Space};

pub fn field(name: &str) -> Option<Field> {
    Field::ALL.iter().copied().find(|field| field.name() == name)
}

fn known(name: &str) -> Field {
    field(name).unwrap_or_else(|| panic!("no table is named {name}"))
}

/// Every table that a pass may write: clock, balance, and the fields of this state.
pub fn names<S: Space>(state: &State<S>) -> Vec<&'static str> {
    let sought = state.method.quasi_static.is_some().then_some("balance");
    let sought = sought.into_iter().chain(state.method.between.then_some("group_clocks"));
    ["clock"].into_iter().chain(sought).chain(state.columns.present().into_iter().map(Field::name)).collect()
}

pub fn upload<S: Space<Real = f32>>(gpu: &mut Gpu, state: &State<S>) {
    for name in names(state) {
        match name {
            "clock" => gpu.write_table(name, bytes_of(&state.clock)).unwrap(),
            "balance" => gpu.write_table(name, bytes_of(&state.balance)).unwrap(),
            "group_clocks" => gpu.write_table(name, cast_slice(&state.group_clocks)).unwrap(),
            _ => gpu.write_table(name, state.columns.bytes(known(name))).unwrap(),
        }
    }
}

pub fn download<S: Space<Real = f32>>(gpu: &Gpu, state: &mut State<S>, names: &[&str]) {
    for name in names {
        let bytes = gpu.read_table(name).unwrap();
        match *name {
            "clock" => state.clock = pod_read_unaligned(&bytes),
            "balance" => state.balance = pod_read_unaligned(&bytes),
            "group_clocks" => cast_slice_mut(&mut state.group_clocks).copy_from_slice(&bytes),
            _ => state.columns.bytes_mut(known(name)).copy_from_slice(&bytes),
        }
    }
}

/// Names of the tables whose bits differ.
pub fn different<S: Space<Real = f32>>(a: &State<S>, b: &State<S>) -> Vec<&'static str> {
    let differs = |name: &&str| match *name {
        "clock" => bytes_of(&a.clock) != bytes_of(&b.clock),
        "balance" => a.balance != b.balance,
        "group_clocks" => a.group_clocks != b.group_clocks,
        name => a.columns.bytes(known(name)) != b.columns.bytes(known(name)),
    };
    names(b).into_iter().filter(differs).collect()
}

/// The same state in another precision.
pub fn convert<A: Space, B: Space>(from: &State<A>) -> State<B> {
    let real = |x: A::Real| B::Real::of(x.f64());
    let constraint = |c: &Constraint<A::Real>| Constraint {
        prescribed: c.prescribed,
        course_first: c.course_first,
        course_count: c.course_count,
        padding: c.padding,
        x: real(c.x),
        y: real(c.y),
        z: real(c.z),
        unused: real(c.unused),
    };
    let body = |b: &Body<A::Real>| b.map(real);
    let facet_pair = |p: &FacetPair<A::Real>| FacetPair {
        stiffness: real(p.stiffness),
        range: real(p.range),
        full: real(p.full),
        friction: real(p.friction),
    };
    let mover = |m: &Mover<A::Real>| Mover { condition: m.condition, inverse_mass: real(m.inverse_mass) };
    State {
        facet_pairs: from.facet_pairs.iter().map(facet_pair).collect(),
        obstacles: from.obstacles.iter().map(obstacle).collect(),
        movers: from.movers.iter().map(mover).collect(),
        obstacle_pairs: from.obstacle_pairs.iter().map(facet_pair).collect(),
        method: from.method.clone(),
        params: params(&from.params, real),
        clock: clock(&from.clock, real),
        group_clocks: from.group_clocks.iter().map(|group| clock(group, real)).collect(),
        bodies: from.bodies.iter().map(body).collect(),
        body_options: from.body_options.iter().map(|options| options.map(real)).collect(),
        coupling: from.coupling.iter().map(|&x| real(x)).collect(),
        constraints: from.constraints.iter().map(constraint).collect(),
        course: from.course.iter().map(|point| point.map(real)).collect(),
        columns: columns(from),
        contact_pairs: from
            .contact_pairs
            .iter()
            .map(|p| ContactPair {
                law: p.law,
                exponent: p.exponent,
                strength: real(p.strength),
                range: real(p.range),
                threshold: real(p.threshold),
                friction: real(p.friction),
            })
            .collect(),
        bond_table: Default::default(),
        balance: balance(&from.balance, real),
    }
}

fn columns<A: Space, B: Space>(from: &State<A>) -> Columns<B> {
    let mut to = Columns::<B>::allocate(from.params.counts(), &from.columns.present());
    for field in from.columns.present() {
        let (old, new) = (from.columns.bytes(field), to.bytes_mut(field));
        if field.kind() == Type::Integer {
            new.copy_from_slice(old);
            continue;
        }
        let (old, new) = (cast_slice::<u8, A::Real>(old), cast_slice_mut::<u8, B::Real>(new));
        for (slot, value) in new.iter_mut().zip(old) {
            *slot = B::Real::of(value.f64());
        }
    }
    to
}

fn clock<A: Real, B: Real>(from: &Clock<A>, real: impl Fn(A) -> B) -> Clock<B> {
    Clock {
        start: real(from.start),
        elapsed: real(from.elapsed),
        elapsed_carry: real(from.elapsed_carry),
        step: real(from.step),
        duration: real(from.duration),
        steps_left: from.steps_left,
        steps_done: from.steps_done,
        running: from.running,
        rebuild: from.rebuild,
        lists_built: from.lists_built,
        changes: from.changes,
        held: real(from.held),
        arrived: from.arrived,
        fault: from.fault,
        residual: real(from.residual),
    }
}

fn balance<A: Real, B: Real>(from: &Balance<A>, real: impl Fn(A) -> B) -> Balance<B> {
    Balance {
        back: real(from.back),
        keep: real(from.keep),
        push: real(from.push),
        forward: real(from.forward),
        mixing: real(from.mixing),
        longest: real(from.longest),
        downhill: from.downhill,
        padding: from.padding,
    }
}

/// As in the middle of a descent whose last step was taken back in part.
fn balance_of(step: f32) -> Balance<f32> {
    Balance {
        back: -0.3 * step,
        keep: 0.9,
        push: 1.1 * step,
        forward: step,
        mixing: 0.1,
        longest: 1.5 * step,
        downhill: 7,
        padding: 0,
    }
}

fn obstacle<A: Real, B: Real>(from: &Obstacle<A>) -> Obstacle<B> {
    macro_rules! all {
        ($($real:ident),*) => {
            Obstacle { kind: from.kind, padding: from.padding, $($real: B::of(from.$real.f64())),* }
        };
    }
    all!(point_x, point_y, point_z, axis_x, axis_y, axis_z, turn_x, turn_y, turn_z, radius, cosine, sine)
}

fn params<A: Real, B: Real>(from: &Params<A>, real: impl Fn(A) -> B) -> Params<B> {
    macro_rules! all {
        (same: $($same:ident),*; real: $($real:ident),*) => {
            Params { planes: from.planes.map(|plane| plane.map(&real)), $($same: from.$same,)* $($real: real(from.$real)),* }
        };
    }
    all!(
        same: count, first, chunk, list_capacity, cells_x, cells_y, cells_z, cell_total, plane_count, body_count,
            artificial_exponent, zero, contact_capacity, facet_count, facet_capacity, obstacle_count, facet_alike, surface_count, corner_count;
        real: origin_x, origin_y, origin_z, cell_x, cell_y, cell_z, period_x, period_y, period_z, body_force_x,
            body_force_y, body_force_z, normalisation, reach, slack, hourglass, alpha, beta, softening, smoothing_weight,
            artificial_epsilon, artificial_weight, cfl, fixed_step, rest_step, interval, stable, residual, load_rate, contact_apart, contact_reach, facet_reach, contact_rate
    )
}

/// Every field and table with random non-zero numbers of physical size, but for what the scene itself gives. The
/// step is a fraction of the usual one.
pub fn random_state<S: Space<Real = f32>>(case: &Case, seed: u64, fraction: f32) -> State<S> {
    let mut state = case.scene().state::<S>(case.compensated);
    let mut random = Random(seed);
    align_cells::<S>(&mut state, case.units[0] as f32);
    for field in state.columns.present() {
        fill::<S>(&mut state, field, case, &mut random);
    }
    // A particle on a mirror plane coincides with its image.
    state.columns.displacement[0] = S::Vec::default();
    state.clock = clock_of(&state, fraction);
    bound_steps::<S>(&mut state);
    state.balance = balance_of(state.clock.step);
    let clock = state.clock;
    for (k, group) in state.group_clocks.iter_mut().enumerate() {
        *group = Clock { step: clock.step * (1.3 - 0.2 * k as f32), lists_built: 4 + k as u32, ..clock };
    }
    state
}

/// Cells between whose edges and all particles there is room.
fn align_cells<S: Space<Real = f32>>(state: &mut State<S>, spacing: f32) {
    let (p, side) = (&mut state.params, CELL as f32 * spacing);
    (p.cell_x, p.cell_y, p.cell_z) = (side, side, side);
    let axes = [
        (&mut p.origin_x, p.period_x, &mut p.cells_x),
        (&mut p.origin_y, p.period_y, &mut p.cells_y),
        (&mut p.origin_z, p.period_z, &mut p.cells_z),
    ];
    for ((origin, period, cells), edge) in axes.into_iter().zip(EDGE) {
        *origin = ((*origin / spacing).floor() + edge as f32) * spacing;
        if period > 0.0 {
            *cells = (period / side).round() as u32;
            assert!((*cells as f32 * side - period).abs() < 1e-5 * period);
        }
    }
    p.cell_total = p.cells_x * p.cells_y * p.cells_z;
    let counts = state.params.counts();
    let fresh = Columns::<S>::allocate(counts, &[Field::CellCount, Field::CellStart, Field::CellBlock]);
    (state.columns.cell_count, state.columns.cell_start, state.columns.cell_block) =
        (fresh.cell_count, fresh.cell_start, fresh.cell_block);
}

/// Numbers of size that a run would have, of which each decides somewhere.
fn bound_steps<S: Space<Real = f32>>(state: &mut State<S>) {
    let step = state.clock.step;
    (state.params.stable, state.params.rest_step, state.params.interval) = (1.6, 0.93 * step, 36.7 * step);
    for body in &mut state.bodies {
        body.frequency = 2.3 * body.sound_speed / body.smoothing_length;
    }
}

fn clock_of<S: Space<Real = f32>>(state: &State<S>, fraction: f32) -> Clock<f32> {
    let step = fraction * 0.21 * state.bodies[0].smoothing_length / state.bodies[0].sound_speed;
    Clock {
        start: 3.7 * step,
        elapsed: 309.3 * step,
        elapsed_carry: 1e-7 * step,
        step,
        duration: 900.0 * step,
        steps_left: 100,
        steps_done: 17,
        running: 1,
        rebuild: 1,
        lists_built: 3,
        changes: 2,
        held: step,
        arrived: 0,
        fault: 0,
        residual: 0.3,
    }
}

/// Either sign, any size between.
fn strain(random: &mut Random) -> f64 {
    let size = 1e-5 * (0.05f64 / 1e-5).powf(random.unit());
    if random.coin() { size } else { -size }
}

fn fill<S: Space<Real = f32>>(state: &mut State<S>, field: Field, case: &Case, random: &mut Random) {
    use Field::*;
    let body = state.bodies[0];
    let [spacing, ..] = case.units;
    let (density, bulk, speed) = (f64::from(body.density), f64::from(body.bulk_modulus), f64::from(body.sound_speed));
    let rate = speed / spacing;
    let count = state.params.counts().of(field.set());
    let kind = field.kind();
    if kind == Type::Integer {
        if matches!(field, Surface | FacetObstacle | FacetPressed) {
            let column: &mut [u32] = cast_slice_mut(state.columns.bytes_mut(field));
            let words = if field == FacetPressed { 2 } else { 3 };
            column.iter_mut().for_each(|entry| *entry = random.word() as u32 % words);
        }
        // The counts of cells are zero between lists.
        let made_anew = matches!(field, Cell | NeighborCount | ContactCount | KeptCount | FacetContactCount);
        if made_anew || matches!(field, CellStart | CellBlock | CellParticles | Neighbors) {
            let column: &mut [u32] = cast_slice_mut(state.columns.bytes_mut(field));
            column.iter_mut().for_each(|entry| *entry = random.word() as u32);
        }
        return;
    }
    let mut number = |old: f32| -> f64 {
        match field {
            ReferencePosition => f64::from(old),
            ReferenceVolume => f64::from(old) * (1.0 + 0.1 * random.signed()),
            Displacement | DisplacementStart | ListedDisplacement | EquilibriumDisplacement => 0.01 * spacing * random.signed(),
            DisplacementCarry => 0.01 * spacing * 2f64.powi(-25) * random.signed(),
            Velocity | VelocityStart | SmoothedVelocity | DisplacementSum => 0.1 * speed * random.signed(),
            VelocityCarry => 0.02 * speed * 2f64.powi(-25) * random.signed(),
            Acceleration | VelocitySum => 0.02 * speed * rate * random.signed(),
            VolumetricStrain | VolumetricStrainStart => strain(random),
            DeviatoricStress | DeviatoricStressStart | CorrectedStress => bulk * strain(random),
            SpecificStress | ArtificialPressure | Field::ArtificialStress => bulk / density.powi(2) * strain(random),
            InternalEnergy | DissipatedEnergy | InternalEnergyStart | DissipatedEnergyStart => {
                1e-3 * speed * speed * random.unit()
            }
            InternalPower | DissipatedPower | InternalEnergySum | DissipatedEnergySum => {
                1e-3 * speed * speed * rate * random.signed()
            }
            VelocityGradient | VolumetricStrainRate | VolumetricStrainSum => 0.02 * rate * random.signed(),
            DeviatoricStressRate | DeviatoricStressSum => 0.02 * rate * bulk * random.signed(),
            Correction | ReferenceCorrection | LinearCoefficient => random.signed(),
            QuadraticCoefficient => random.signed() / spacing,
            QuadraticStress => bulk * strain(random) / spacing,
            DisplacementGradient | InelasticStrain | EquilibriumInelasticStrain => 0.1 * random.signed(),
            Temperature => 1.0 + 0.1 * random.unit(),
            EquivalentPlasticStrain | EquilibriumPlasticStrain => 0.1 * random.unit(),
            ContactRate => rate * rate * random.unit(),
            ContactEnergy | HourglassEnergy => 1e-3 * speed * speed * random.unit(),
            FacetReferencePosition | FacetReferenceNormal | FacetArea => f64::from(old),
            FacetDisplacement | ObstacleDisplacement => 0.01 * spacing * random.signed(),
            FacetMove | FacetSlip | FacetObstacleSlip | ObstacleMove => 0.002 * spacing * random.signed(),
            FacetNormal => random.signed(),
            FacetGap => 0.1 * spacing * random.signed(),
            FacetSpread => 0.3 + 0.1 * random.signed(),
            FacetPull | FacetTraction | FacetForce | FacetLoad | ObstacleForce => 1e-3 * bulk * random.signed(),
            FacetEdge | FacetMoment | FacetEnergy | FacetHeat | FacetPressure => 1e-3 * bulk * random.signed(),
            ObstacleVelocity => 0.1 * speed * random.signed(),
            BondStress => bulk * strain(random),
            SurfaceNormal => random.signed(),
            ColourExcess => 0.1 * random.unit(),
            ShapeFactor => 1.0 + 0.1 * random.signed(),
            ShapeSlope | ShapeFactorGradient => random.signed() / spacing,
            ShapeSlopeGradient => random.signed() / spacing.powi(2),
            ShapeStress => bulk * strain(random),
            DisplacementGradientStart => 0.1 * random.signed(),
            DisplacementGradientRate | DisplacementGradientSum => 0.02 * rate * random.signed(),
            BlockBound | BlockResidual => random.unit(),
            // Only what is listed has one.
            KeptGradients | ZoneForces | BlockLoad => f64::from(old),
            CellCount | CellStart | CellBlock | CellParticles | Neighbors | KeptNeighbors | Contacts | FacetContacts => {
                unreachable!()
            }
            Surface | FirstFacet | Facets | FacetOwner | FacetContactCount | FacetPressed | FacetObstacle => unreachable!(),
            Number | Body | Field::Constraint | Cell | NeighborCount | ContactCount | KeptCount => unreachable!(),
        }
    };
    let width = kind.words::<S>();
    let column: &mut [f32] = cast_slice_mut(state.columns.bytes_mut(field));
    assert_eq!(column.len(), count * width);
    for (k, slot) in column.iter_mut().enumerate() {
        if !padding::<S>(kind, k % width) {
            *slot = number(*slot) as f32;
        }
    }
}

/// Whether a number of a particle's vector or matrix is there only to fill a gap.
pub fn padding<S: Space>(kind: Type, place: usize) -> bool {
    matches!(kind, Type::Vec | Type::Mat) && place % S::Vec::LENGTH >= S::DIMENSION
}
