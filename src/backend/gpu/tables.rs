//! The tables of a run as device buffers, found by the name that the shaders use.

use super::connection::Connection;
use crate::backend::device::DeviceInfo;
use crate::fields::{Field, Type};
use crate::rows::{Balance, Body, BodyOptions, Clock, Constraint, ContactPair, FacetPair, Mover, Obstacle, Params};
use crate::state::State;
use crate::step;
use crate::tensor::Space;
use bytemuck::{Pod, Zeroable, bytes_of, cast_slice};
use std::collections::BTreeMap;
use wgpu::{Buffer, BufferUsages};

macro_rules! plain {
    ($($name:ident),*) => { $(
        // SAFETY: repr(C) of 32-bit numbers only, so without padding; any bits are valid.
        unsafe impl Zeroable for $name<f32> {}
        // SAFETY: as above.
        unsafe impl Pod for $name<f32> {}
    )* };
}
plain!(Params, Body, BodyOptions, Constraint, ContactPair, FacetPair, Obstacle, Mover, Clock, Balance);

/// Bytes of the smallest buffer: no shader's element is larger.
const SMALLEST: u64 = 64;
/// Most particles of one part of the neighbour list: keeps dispatches short on slow devices.
const LONGEST_PART: u64 = 4 << 20;

pub struct Table {
    pub buffer: Buffer,
    /// Bytes of the table, without those by which the buffer was rounded up.
    pub bytes: u64,
}

/// A part of the particles with its part of the neighbour list: entry k of particle i at
/// `k * count + (i - first)`, so that neighbouring invocations read neighbouring words.
pub struct Part {
    pub first: u32,
    pub count: u32,
    pub params: Buffer,
    pub neighbors: Buffer,
}

pub struct Tables {
    pub dimension: usize,
    pub params: Params<f32>,
    pub fields: Vec<Field>,
    pub parts: Vec<Part>,
    /// Buffer in which a field is put into its new order.
    pub scratch: Table,
    named: BTreeMap<&'static str, Table>,
}

/// Splits the particles so that each part's list fits into a buffer: first particle and number.
pub fn split(count: u32, capacity: u32, limit: u64, forced: Option<u32>) -> Vec<(u32, u32)> {
    let fits = (limit / (4 * u64::from(capacity.max(1)))).clamp(1, LONGEST_PART) as u32;
    let most = forced.map_or(fits, |forced| forced.clamp(1, fits));
    let parts = count.div_ceil(most).max(1);
    let size = count.div_ceil(parts).max(1);
    let part = |k: u32| (k * size, size.min(count.saturating_sub(k * size)));
    (0..parts).map(part).filter(|(_, number)| *number > 0 || count == 0).collect()
}

impl Tables {
    /// Makes room for every table and fills it from the host's. Tables that the host left empty, though
    /// the run needs them, begin as zeros.
    ///
    /// # Errors
    /// One sentence, if a table or their sum does not fit on the device.
    pub fn new<S: Space<Real = f32>>(
        link: &Connection,
        info: &DeviceInfo,
        state: &State<S>,
        longest_part: Option<u32>,
    ) -> Result<Self, String> {
        let mut fields = step::fields(&state.method);
        fields.extend(state.columns.present());
        fields.sort_unstable();
        fields.dedup();
        let params = state.params;
        let contents = contents(state, &fields);
        let limit = info.max_binding_bytes.min(info.max_buffer_bytes) & !15;
        let split = split(params.count, params.list_capacity, limit, longest_part);
        let list = params.counts().bytes(&[Field::Neighbors], S::DIMENSION, 4);
        let scratch = contents.iter().filter(|c| c.carried).map(|c| c.bytes).max().unwrap_or(0);
        let total = list + scratch + contents.iter().map(|c| c.bytes).sum::<u64>();
        check_sizes(info, limit, &contents, params.count, total)?;

        let mut named = BTreeMap::new();
        for content in &contents {
            let buffer = link.table(content.name, rounded(content.bytes))?;
            if content.host.iter().any(|&byte| byte != 0) {
                link.write(&buffer, content.host)?;
            }
            named.insert(content.name, Table { buffer, bytes: content.bytes });
        }
        let scratch = Table { buffer: link.table("destination", rounded(scratch))?, bytes: scratch };
        let parts = split.into_iter().map(|(first, count)| Part::new(link, first, count, params.list_capacity));
        let parts = parts.collect::<Result<_, _>>()?;
        let tables = Self { dimension: S::DIMENSION, params, fields, parts, scratch, named };
        tables.write_params(link, &params)?;
        if state.columns.neighbors.iter().any(|&entry| entry != 0) {
            tables.write_neighbors(link, &state.columns.neighbors)?;
        }
        Ok(tables)
    }

    /// A table by its name in the shaders; not `params` and what comes [in parts](Field::in_parts).
    pub fn get(&self, name: &str) -> Result<&Table, String> {
        self.named.get(name).ok_or_else(|| format!("this run has no table {name}"))
    }

    pub fn field(&self, field: Field) -> Result<&Table, String> {
        self.get(field.name())
    }

    /// Carried fields that the run has.
    pub fn carried(&self) -> impl Iterator<Item = Field> {
        self.fields.iter().copied().filter(|field| field.carried())
    }

    /// 32-bit words that one row takes in a field.
    pub fn words(&self, field: Field) -> u32 {
        field.kind().words_in(self.dimension) as u32
    }

    /// Bytes of the columns alone.
    #[cfg(test)]
    pub fn column_bytes(&self) -> u64 {
        let entries = self.params.counts().of(Field::Neighbors.set()) as u64;
        let whole = self.fields.iter().filter(|field| !field.in_parts());
        4 * entries + whole.map(|field| self.named[field.name()].bytes).sum::<u64>()
    }

    pub fn bytes(&self) -> u64 {
        let parts: u64 = self.parts.iter().map(|part| part.params.size() + part.neighbors.size()).sum();
        parts + self.scratch.buffer.size() + self.named.values().map(|table| table.buffer.size()).sum::<u64>()
    }

    /// Sets the numbers of the run, each part with its own range.
    pub fn write_params(&self, link: &Connection, params: &Params<f32>) -> Result<(), String> {
        for part in &self.parts {
            let own = Params { first: part.first, chunk: part.count, ..*params };
            link.write(&part.params, bytes_of(&own))?;
        }
        Ok(())
    }

    /// Takes the list as the host lays it out: a row of `list_capacity` for each particle.
    pub fn write_neighbors(&self, link: &Connection, rows: &[u32]) -> Result<(), String> {
        let capacity = self.params.list_capacity as usize;
        for part in &self.parts {
            let (first, count) = (part.first as usize, part.count as usize);
            let mut columns = vec![0_u32; count * capacity];
            for (i, row) in rows[first * capacity..(first + count) * capacity].chunks(capacity).enumerate() {
                for (k, &entry) in row.iter().enumerate() {
                    columns[k * count + i] = entry;
                }
            }
            link.write(&part.neighbors, cast_slice(&columns))?;
        }
        Ok(())
    }

    /// The list as the host lays it out.
    pub fn read_neighbors(&self, link: &Connection) -> Result<Vec<u32>, String> {
        let (total, capacity) = (self.params.count as usize, self.params.list_capacity as usize);
        let mut rows = vec![0_u32; total * capacity];
        for part in &self.parts {
            let (first, count) = (part.first as usize, part.count as usize);
            let bytes = link.read(&[(&part.neighbors, (4 * count * capacity) as u64)])?;
            for (place, entry) in words(&bytes[0]).enumerate() {
                rows[(first + place % count) * capacity + place / count] = entry;
            }
        }
        Ok(rows)
    }
}

impl Part {
    fn new(link: &Connection, first: u32, count: u32, capacity: u32) -> Result<Self, String> {
        let bytes = rounded(size_of::<Params<f32>>() as u64);
        let params = link.buffer("params", bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?;
        let neighbors = link.table("neighbors", rounded(4 * u64::from(count) * u64::from(capacity)))?;
        Ok(Self { first, count, params, neighbors })
    }
}

/// Integers of a buffer's bytes, which need not be aligned.
pub fn words(bytes: &[u8]) -> impl Iterator<Item = u32> {
    bytes.chunks_exact(4).map(|word| u32::from_ne_bytes([word[0], word[1], word[2], word[3]]))
}

/// Numbers of a field's bytes as the host keeps them.
pub fn numbers(field: Field, bytes: &[u8]) -> Vec<f64> {
    match field.kind() {
        Type::Integer => words(bytes).map(f64::from).collect(),
        _ => words(bytes).map(|bits| f64::from(f32::from_bits(bits))).collect(),
    }
}

/// A table before it is a buffer.
struct Content<'a> {
    name: &'static str,
    bytes: u64,
    /// What to fill it with; empty for zeros.
    host: &'a [u8],
    carried: bool,
}

/// All but the list of neighbours, which comes in parts.
fn contents<'a, S: Space<Real = f32>>(state: &'a State<S>, fields: &[Field]) -> Vec<Content<'a>> {
    let table = |name, host: &'a [u8]| Content { name, bytes: host.len() as u64, host, carried: false };
    let mut list = vec![
        table("clock", bytes_of(&state.clock)),
        table("balance", bytes_of(&state.balance)),
        table("bodies", cast_slice(&state.bodies)),
        table("coupling", cast_slice(&state.coupling)),
        table("contact_pairs", cast_slice(&state.contact_pairs)),
        table("facet_pairs", cast_slice(&state.facet_pairs)),
        table("obstacles", cast_slice(&state.obstacles)),
        table("movers", cast_slice(&state.movers)),
        table("obstacle_pairs", cast_slice(&state.obstacle_pairs)),
        table("constraints", cast_slice(&state.constraints)),
        table("course", cast_slice(&state.course)),
    ];
    if !state.group_clocks.is_empty() {
        list.push(table("group_clocks", cast_slice(&state.group_clocks)));
    }
    // Bound only where bodies differ.
    if !state.body_options.is_empty() {
        list.push(table("body_options", cast_slice(&state.body_options)));
    }
    let counts = state.params.counts();
    list.extend(fields.iter().filter(|field| !field.in_parts()).map(|&field| Content {
        name: field.name(),
        bytes: counts.bytes(&[field], S::DIMENSION, 4),
        host: state.columns.bytes(field),
        carried: field.carried(),
    }));
    list
}

fn rounded(bytes: u64) -> u64 {
    bytes.max(SMALLEST).next_multiple_of(16)
}

fn check_sizes(info: &DeviceInfo, limit: u64, contents: &[Content], count: u32, total: u64) -> Result<(), String> {
    let gigabytes = |bytes: u64| bytes as f64 / 1e9;
    if let Some(large) = contents.iter().find(|content| rounded(content.bytes) > limit) {
        return Err(format!(
            "the table {} of {count} particles takes {:.2} GB but {} binds at most {:.2} GB at once: \
             use fewer particles or the CPU",
            large.name,
            gigabytes(large.bytes),
            info.name,
            gigabytes(limit)
        ));
    }
    match info.memory {
        Some(memory) if total > memory => Err(format!(
            "the tables of {count} particles take {:.2} GB but {} has {:.2} GB: use fewer particles or the CPU",
            gigabytes(total),
            info.name,
            gigabytes(memory)
        )),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_all_particles_once_and_fit() {
        let cases = [(1000, 64, 1 << 20, None), (100_000, 64, 1 << 20, None), (1000, 64, 1 << 30, Some(64)), (7, 3, 16, Some(2))];
        for (count, capacity, limit, forced) in cases {
            let parts = split(count, capacity, limit, forced);
            let mut next = 0;
            for &(first, number) in &parts {
                assert_eq!(first, next);
                assert!(number > 0 && (u64::from(number * capacity * 4) <= limit || number == 1));
                next = first + number;
            }
            assert_eq!(next, count);
        }
        assert_eq!(split(1000, 64, 1 << 30, None), [(0, 1000)]);
        assert_eq!(split(10, 4, 1 << 30, Some(4)), [(0, 4), (4, 4), (8, 2)]);
        assert_eq!(split(0, 4, 1 << 30, None), [(0, 0)]);
    }
}
