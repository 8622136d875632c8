//! The rule: the GPU may be at most four times as far from the f64 twin as the f32 twin is, each taken at its
//! worst over all numbers of a table, and two units in the last place of the largest are always allowed.
//! Integers are equal, and so is what is only moved.

use super::tables::{field, padding};
use lithosph::fields::{Field, Set, Type};
use lithosph::pair::separation;
use lithosph::pass::Pass;
use lithosph::rows::{Clock, NEIGHBOR_BITS, NEIGHBOR_MASK};
use lithosph::smoothing::Smoothing;
use lithosph::state::State;
use lithosph::tensor::{Real, Space};

const ALLOWED: f64 = 4.0;
const LAST_PLACES: f64 = 2.0 * f32::EPSILON as f64;

/// The sum and what it handed back, which together hold the digits of a step.
const ELAPSED: &str = "clock.elapsed - clock.elapsed_carry";

/// How one writable binding came out of one pass.
#[derive(Debug, Clone)]
pub struct Row {
    pub pass: Pass,
    pub binding: String,
    /// Largest error of the GPU and of the f32 twin, relative to the largest number.
    pub gpu: f64,
    pub twin: f64,
    pub good: bool,
}

impl Row {
    /// The GPU's error over what counts as the twin's: at most [`ALLOWED`].
    pub fn ratio(&self) -> f64 {
        if self.gpu == 0.0 { 0.0 } else { self.gpu / self.twin.max(LAST_PLACES / ALLOWED) }
    }
}

/// The state before a pass, and after it as each of the three left it.
pub struct Seen<'a, W: Space, N: Space> {
    pub before: &'a State<N>,
    pub truth: &'a State<W>,
    pub twin: &'a State<N>,
    pub gpu: &'a State<N>,
}

/// All rows of one table.
pub fn compare<W: Space, N: Space>(pass: Pass, name: &str, seen: &Seen<W, N>) -> Vec<Row> {
    let row = |binding: &str, gpu, twin, good| Row { pass, binding: binding.to_string(), gpu, twin, good };
    let mut rows = Vec::new();
    let sort = pass == Pass::FillCells;
    if let Some(exact) = integers(seen.truth, name, sort) {
        let same = Some(&exact) == integers(seen.gpu, name, sort).as_ref();
        assert!(Some(&exact) == integers(seen.twin, name, sort).as_ref(), "{}: the twins disagree on {name}", pass.name());
        rows.push(row(name, if same { 0.0 } else { f64::INFINITY }, 0.0, same));
    }
    let reals = |(label, truth): (String, Vec<f64>), twin: &[f64], gpu: &[f64], scale: Option<f64>| {
        let scale = scale.unwrap_or_else(|| truth.iter().fold(0.0, |m, x| m.max(x.abs())));
        let error = |values: &[f64]| worst(&truth, values) / if scale > 0.0 { scale } else { 1.0 };
        let (gpu, twin) = (error(gpu), error(twin));
        let bound = if pass == Pass::Reorder { 0.0 } else { (ALLOWED * twin).max(LAST_PLACES) };
        row(&label, gpu, twin, gpu <= bound)
    };
    let carried = field(name).and_then(carried_sum);
    // What a sum hands back is of the size of that sum's rounding.
    let scale = carried.map(|sum| numbers(seen.truth, sum.name()).iter().flat_map(|(_, x)| x.clone()).fold(0.0, f64::max));
    let step = seen.before.clock.step.f64();
    // Contact's rate stands beside that of the body itself.
    let scale = scale.or_else(|| {
        let own = &seen.truth.bodies[0];
        let most = seen.truth.columns.contact_rate.iter().fold(0.0, |most, rate| rate.f64().max(most));
        (field(name) == Some(Field::ContactRate)).then(|| most.max((own.sound_speed / own.smoothing_length).f64().powi(2)))
    });
    let scale_of = |label: &str| if label == ELAPSED && step > 0.0 { Some(step) } else { scale };
    let (truth, twin, gpu) = (numbers(seen.truth, name), numbers(seen.twin, name), numbers(seen.gpu, name));
    for ((truth, twin), gpu) in truth.into_iter().zip(twin).zip(gpu) {
        let scale = scale_of(&truth.0);
        rows.push(reals(truth, &twin.1, &gpu.1, scale));
    }
    let free = |a: usize| seen.before.columns.constraint.get(a).is_none_or(|&held| held == 0);
    if let (Some(sum), true) = (carried, pass != Pass::Reorder) {
        let whole = |values: (Vec<f64>, Vec<f64>)| -> Vec<f64> {
            let width = values.0.len() / seen.before.params.count as usize;
            let both = values.0.iter().zip(&values.1).enumerate().filter(|(k, _)| free(k / width));
            both.map(|(_, (sum, carry))| sum - carry).collect()
        };
        let column = |values: Vec<(String, Vec<f64>)>| values.into_iter().flat_map(|(_, values)| values).collect::<Vec<f64>>();
        let exact = |s: &State<N>| whole((column(numbers(s, sum.name())), column(numbers(s, name))));
        let truth = whole((column(numbers(seen.truth, sum.name())), column(numbers(seen.truth, name))));
        // Together the two hold the increment's digits.
        let increment = worst(&truth, &exact(seen.before));
        let label = format!("{} - {name}", sum.name());
        rows.push(reals((label, truth), &exact(seen.twin), &exact(seen.gpu), Some(increment)));
    }
    rows
}

fn carried_sum(carry: Field) -> Option<Field> {
    match carry {
        Field::DisplacementCarry => Some(Field::Displacement),
        Field::VelocityCarry => Some(Field::Velocity),
        _ => None,
    }
}

fn worst(truth: &[f64], values: &[f64]) -> f64 {
    assert_eq!(truth.len(), values.len());
    let error = |(t, v): (&f64, &f64)| if (t - v).is_nan() { f64::INFINITY } else { (t - v).abs() };
    truth.iter().zip(values).map(error).fold(0.0, f64::max)
}

/// The whole numbers of a table; with `sorted`, those of a cell in ascending order.
fn integers<S: Space>(state: &State<S>, name: &str, sorted: bool) -> Option<Vec<u32>> {
    match name {
        "clock" => Some(counts_of(&state.clock)),
        "group_clocks" => Some(state.group_clocks.iter().flat_map(counts_of).collect()),
        "balance" => Some(vec![state.balance.downhill]),
        "cell_count" => Some(state.columns.cell_count.clone()),
        "cell_start" => Some(state.columns.cell_start.clone()),
        "cell_block" => Some(state.columns.cell_block.clone()),
        "cell_particles" => {
            let mut list = state.columns.cell_particles.clone();
            for cell in state.columns.cell_start.windows(2).filter(|_| sorted) {
                list[cell[0] as usize..cell[1] as usize].sort_unstable();
            }
            Some(list)
        }
        "neighbors" => {
            let lists = (0..state.params.count as usize).map(|a| state.neighbors_of(a));
            Some(lists.flat_map(|list| std::iter::once(list.len() as u32).chain(list.iter().copied())).collect())
        }
        "contacts" => {
            let count = state.params.count as usize;
            let entry =
                |k: usize, a: usize| (k < state.columns.contact_count[a] as usize).then(|| state.columns.contacts[k * count + a]);
            let rows = state.columns.contacts.len() / count;
            Some((0..rows).flat_map(|k| (0..count).filter_map(move |a| entry(k, a))).collect())
        }
        "facet_contacts" => {
            let (count, counts) = (state.params.facet_count as usize, &state.columns.facet_contact_count);
            let entry = |k: usize, e: usize| (k < counts[e] as usize).then(|| state.columns.facet_contacts[k * count + e]);
            let rows = state.params.facet_capacity as usize;
            Some((0..rows).flat_map(|k| (0..count).filter_map(move |e| entry(k, e))).collect())
        }
        "kept_neighbors" => Some(kept(state).map(|place| state.columns.kept_neighbors[place]).collect()),
        _ => match field(name) {
            Some(field) if field.kind() == Type::Integer => Some(bytemuck::cast_slice(state.columns.bytes(field)).to_vec()),
            _ => None,
        },
    }
}

fn counts_of<R>(c: &Clock<R>) -> Vec<u32> {
    vec![c.steps_left, c.steps_done, c.running, c.rebuild, c.lists_built, c.changes, c.arrived, c.fault]
}

/// Places of the neighbours kept, each particle's in order.
fn kept<S: Space>(state: &State<S>) -> impl Iterator<Item = usize> {
    let count = state.params.count as usize;
    let counts = state.columns.kept_count.iter().enumerate();
    counts.flat_map(move |(a, &kept)| (0..kept as usize).map(move |k| k * count + a))
}

/// The real numbers of a table, those of one kind together.
fn numbers<S: Space>(state: &State<S>, name: &str) -> Vec<(String, Vec<f64>)> {
    let one = |label: &str, values| (label.to_string(), values);
    match name {
        "clock" => {
            let c = state.clock.to_f64();
            let parts = [
                ("clock.start", c.start),
                ("clock.elapsed", c.elapsed),
                (ELAPSED, c.elapsed - c.elapsed_carry),
                ("clock.step", c.step),
                ("clock.duration", c.duration),
                ("clock.held", c.held),
                ("clock.residual", c.residual),
            ];
            parts.map(|(label, value)| one(label, vec![value])).to_vec()
        }
        "group_clocks" => vec![one(name, state.group_clocks.iter().map(|clock| clock.step.f64()).collect())],
        "balance" => {
            let b = &state.balance;
            let parts = [
                ("balance.back", b.back),
                ("balance.keep", b.keep),
                ("balance.push", b.push),
                ("balance.forward", b.forward),
                ("balance.mixing", b.mixing),
                ("balance.longest", b.longest),
            ];
            parts.map(|(label, value)| one(label, vec![value.f64()])).to_vec()
        }
        "block_residual" => {
            let column = |k: usize| state.columns.block_residual.iter().map(|measure| measure[k].f64()).collect();
            (0..8).map(|k| one(&format!("block_residual.{k}"), column(k))).collect()
        }
        "block_load" => {
            vec![one(name, state.columns.block_load.iter().flat_map(|v| (0..S::DIMENSION).map(move |k| v[k].f64())).collect())]
        }
        "block_bound" => {
            let column = |k: usize| state.columns.block_bound.iter().map(|bound| bound[k].f64()).collect();
            (0..4).map(|k| one(&format!("block_bound.{}", ["x", "y", "z", "w"][k]), column(k))).collect()
        }
        "zone_forces" => {
            let count = state.params.count as usize;
            let of =
                |a: usize| (0..state.columns.contact_count[a] as usize).map(move |k| state.columns.zone_forces[k * count + a]);
            let owners = (0..count).filter(|&a| state.columns.surface[a] != 0).flat_map(of);
            vec![one(name, owners.flat_map(|v| (0..S::DIMENSION).map(move |k| v[k].f64())).collect())]
        }
        "kept_gradients" => {
            let rows = kept(state).map(|place| state.columns.kept_gradients[place]);
            vec![one(name, rows.flat_map(|v| (0..S::DIMENSION).map(move |k| v[k].f64())).collect())]
        }
        _ => match field(name) {
            Some(field) if field.kind() != Type::Integer => {
                let width = field.kind().words::<S>();
                let all: &[S::Real] = bytemuck::cast_slice(state.columns.bytes(field));
                let kept = all.iter().enumerate().filter(|(k, _)| !padding::<S>(field.kind(), k % width));
                let values: Vec<f64> = kept.map(|(_, x)| x.f64()).collect();
                assert!(values.len() >= 1000 || field.set() != Set::Particle, "{name} has too few numbers");
                vec![one(name, values)]
            }
            _ => Vec::new(),
        },
    }
}

/// Makes sure that rounding decides nothing in a pass: no particle at a cell's edge, no pair at the list's reach
/// or at the end of a kernel that ends with a jump.
pub fn assert_rounding_decides_nothing<S: Space<Real = f64>>(pass: Pass, state: &State<S>) {
    let p = &state.params;
    let extent = state.columns.reference_position.iter().map(|&x| S::inner(x, x).sqrt()).fold(0.0, f64::max);
    let rounding = 2.0 * f64::from(f32::EPSILON) * extent;
    match pass {
        Pass::BinCells => {
            let (origin, size) = ([p.origin_x, p.origin_y, p.origin_z], [p.cell_x, p.cell_y, p.cell_z]);
            for a in 0..p.count as usize {
                let x = state.position(a);
                for k in 0..S::DIMENSION {
                    let place = (x[k] - origin[k]) / size[k];
                    assert!((place - place.round()).abs() * size[k] > rounding, "particle {a} lies at a cell's edge");
                }
            }
        }
        Pass::FindNeighbors => {
            for entry in (0..1u32 << p.plane_count).flat_map(|image| (0..p.count).map(move |b| b | image << NEIGHBOR_BITS)) {
                // Only images are placed with the rounding of a position.
                let rounding = if entry >> NEIGHBOR_BITS != 0 || state.method.periodic { rounding } else { 0.0 };
                for a in 0..p.count as usize {
                    let x = separation(state, a, entry);
                    let apart = S::inner(x, x).sqrt();
                    assert!((apart - p.reach).abs() > rounding + 3e-7 * p.reach, "particle {a} lies at the reach of {entry}");
                }
            }
        }
        Pass::Force | Pass::StrainRate | Pass::CorrectGradient | Pass::SumDensity | Pass::SmoothVelocity
            if state.method.smoothing == Smoothing::Gaussian =>
        {
            for a in 0..p.count as usize {
                for &entry in state.neighbors_of(a) {
                    let x = separation(state, a, entry);
                    let b = (entry & NEIGHBOR_MASK) as usize;
                    let end = state.body(a).smoothing_length + state.body(b).smoothing_length;
                    assert!((S::inner(x, x).sqrt() - end).abs() > 1e-6 * end, "{a} lies at the end of the kernel of {b}");
                }
            }
        }
        _ => {}
    }
}
