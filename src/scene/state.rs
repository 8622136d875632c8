//! A scene's first state, in the precision of the backend that will step it.

use super::{Particle, Scene};
use crate::bond::BondTable;
use crate::fields::Columns;
use crate::rows::{Balance, Body, BodyOptions, Clock, Constraint, ContactPair, Mover, Params};
use crate::state::State;
use crate::step;
use crate::tensor::{Real, Space};
use glam::DVec3;

/// Largest number of cells over particles: beyond it cells are made larger.
const CELLS_PER_PARTICLE: usize = 4;

/// Particles of one body touch only if they were more than so many spacings apart.
const CONTACT_APART: f64 = 3.0;
/// Margin of the list of contacts, in h. It is wide, since pairs enter this list only where surfaces meet, so that a long
/// list costs little and a rare search saves much.
const CONTACT_MARGIN: f64 = 1.0;

/// Least softening of the viscosity's denominator r^2 + softening h^2, so that a particle on a mirror plane and its own image
/// do not give 0/0. For all other pairs so small a number is lost in rounding.
const LEAST_SOFTENING: f64 = 1e-9;

impl Scene {
    /// All tables at time zero. `compensated` keeps the digits that f32 sums would drop.
    pub fn state<S: Space>(&self, compensated: bool) -> State<S> {
        let mut method = self.method.clone();
        method.compensated = compensated;
        let params = self.params::<S::Real>();
        let real = S::Real::of;
        let own_options: Vec<_> = self.bodies.iter().map(|body| body.options.map(real)).collect();
        let body_options = method.body_options;
        let mut state = State {
            columns: Columns::allocate(params.counts(), &step::fields(&method)),
            method,
            params,
            clock: Clock::default(),
            group_clocks: vec![Clock::default(); self.parts.len()],
            bodies: self.by_body(&self.bodies.iter().map(super::SceneBody::numbers).collect::<Vec<_>>()),
            body_options: if body_options { self.by_body(&own_options) } else { Vec::new() },
            coupling: self.by_pair(&self.coupling).into_iter().map(real).collect(),
            facet_pairs: self.by_pair(&self.facet_pairs).iter().map(|pair| pair.map(real)).collect(),
            obstacles: self.own_obstacles().iter().map(|obstacle| obstacle.shape.cast()).collect(),
            movers: self.own_obstacles().iter().map(super::SceneObstacle::mover).collect(),
            obstacle_pairs: self.own_obstacles().iter().flat_map(|o| self.by_body(&o.pairs)).map(|pair| pair.map(real)).collect(),
            contact_pairs: self.by_pair(&self.contacts).iter().map(|pair| pair.map(real)).collect(),
            constraints: Vec::new(),
            course: Vec::new(),
            bond_table: BondTable::default(),
            balance: Balance::default(),
        };
        self.fill_constraints(&mut state);
        self.fill_particles(&mut state);
        self.fill_facets(&mut state);
        state
    }

    /// Bytes that the columns take where a number has `word` bytes.
    pub fn state_bytes(&self, word: usize, compensated: bool) -> u64 {
        let mut method = self.method.clone();
        method.compensated = compensated;
        self.params::<f64>().counts().bytes(&step::fields(&method), self.dimension(), word)
    }

    fn fill_constraints<S: Space>(&self, state: &mut State<S>) {
        let real = S::Real::of;
        for typed in &self.constraints {
            let bits = typed.prescribed.iter().enumerate().map(|(k, &held)| u32::from(held) << k).sum();
            state.constraints.push(Constraint {
                prescribed: bits,
                course_first: state.course.len() as u32,
                course_count: typed.course.len() as u32,
                padding: 0,
                x: real(typed.vector[0]),
                y: real(typed.vector[1]),
                z: real(typed.vector[2]),
                unused: real(0.0),
            });
            state.course.extend(typed.course.iter().map(|p| p.map(real)));
        }
    }

    fn fill_particles<S: Space>(&self, state: &mut State<S>) {
        let columns = &mut state.columns;
        for (i, particle) in self.particles.iter().enumerate() {
            let body = &self.bodies[particle.body as usize];
            columns.number[i] = self.first_number + i as u32;
            columns.reference_position[i] = S::vec_from(particle.position.to_array());
            columns.reference_volume[i] = S::Real::of(particle.volume);
            columns.velocity[i] = S::vec_from(particle.velocity.to_array());
            if let Some(slot) = columns.volumetric_strain.get_mut(i) {
                *slot = S::Real::of(body.relative_volume - 1.0);
            }
            if let Some(slot) = columns.temperature.get_mut(i) {
                *slot = S::Real::of(body.material.temperature());
            }
            if let Some(slot) = columns.body.get_mut(i) {
                *slot = self.body_number(particle);
            }
            if let Some(slot) = columns.constraint.get_mut(i) {
                *slot = particle.constraint;
            }
            if let Some(slot) = columns.deviatoric_stress.get_mut(i) {
                let full = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
                for (row, line) in full.iter().enumerate().take(S::DIMENSION) {
                    for (column, &k) in line.iter().enumerate().take(S::DIMENSION) {
                        slot[S::sym_index(row, column)] = S::Real::of(body.deviator[k]);
                    }
                }
            }
        }
    }

    fn fill_facets<S: Space>(&self, state: &mut State<S>) {
        let columns = &mut state.columns;
        for (e, facet) in self.own_facets().iter().enumerate() {
            let owner = facet.owner as usize;
            if columns.facets[owner] == 0 {
                columns.first_facet[owner] = e as u32;
            }
            columns.facets[owner] += 1;
            columns.facet_owner[e] = facet.owner;
            columns.facet_reference_position[e] = S::vec_from(facet.piece.position.to_array());
            columns.facet_reference_normal[e] = S::vec_from(facet.piece.normal.to_array());
            columns.facet_area[e] = S::Real::of(facet.piece.area);
        }
        for (k, obstacle) in self.own_obstacles().iter().enumerate() {
            columns.obstacle_velocity[k] = S::vec_from(obstacle.velocity.to_array());
        }
    }

    /// Corners of the particles' box at the start.
    pub fn extent(&self) -> (DVec3, DVec3) {
        let ends = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.particles.iter().fold(ends, |(low, high), p| (low.min(p.position), high.max(p.position)))
    }

    /// h of a particle at the start: a number of its body.
    pub fn smoothing_length_of(&self, particle: &Particle) -> f64 {
        self.bodies[particle.body as usize].smoothing_length
    }

    /// The largest smoothing length of a particle: what reaches and cells are made from.
    pub fn smoothing_length(&self) -> f64 {
        self.particles.iter().map(|particle| self.smoothing_length_of(particle)).fold(0.0, f64::max)
    }

    fn reach(&self) -> f64 {
        if self.method.between {
            return 0.0;
        }
        let margin = if self.method.list_follows() { self.margin() } else { 0.0 };
        2.0 * self.smoothing_length() + margin
    }

    /// How far (length) the list that follows the particles reaches beyond the range of what acts, so that it serves for
    /// several steps.
    fn margin(&self) -> f64 {
        let usual = if (self.method.contact.any() && !self.method.list_follows()) || self.method.gap.is_some() {
            CONTACT_MARGIN
        } else {
            self.file.list_margin()
        };
        let named = self.file.formulation.list_margin.filter(|_| !self.method.between);
        named.unwrap_or(usual) * self.smoothing_length()
    }

    /// Distance up to which pairs enter the list of contacts; 0 where nothing touches.
    fn contact_reach(&self) -> f64 {
        let range = self.contacts.iter().flatten().map(ContactPair::reach).fold(0.0, f64::max);
        if range > 0.0 { range + self.margin() } else { 0.0 }
    }

    /// Distance up to which pairs enter the list of facets; 0 where no surfaces touch.
    fn facet_reach(&self) -> f64 {
        let range = self.facet_pairs.iter().flatten().map(|pair| pair.range).fold(0.0, f64::max);
        if range > 0.0 { range + self.margin() } else { 0.0 }
    }

    /// Width of a cell that facets need: a facet may touch those of particles up to this distance from it.
    fn facet_cell(&self) -> f64 {
        if self.method.gap.is_some() { self.facet_reach() + self.longest_lever() } else { 0.0 }
    }

    /// If all pairs of touching bodies have the same numbers, the index of one such pair plus 1; 0 if the pairs differ.
    fn facet_alike(&self) -> u32 {
        let pairs = self.by_pair(&self.facet_pairs);
        let mut touching = pairs.iter().enumerate().filter(|(_, pair)| pair.stiffness > 0.0);
        let Some((place, first)) = touching.next() else { return 0 };
        if touching.all(|(_, pair)| pair == first) { place as u32 + 1 } else { 0 }
    }

    /// Largest distance from a facet to the particle that carries it.
    fn longest_lever(&self) -> f64 {
        let lever = |facet: &super::SceneFacet| facet.piece.position.distance(self.particles[facet.owner as usize].position);
        self.own_facets().iter().map(lever).fold(0.0, f64::max)
    }

    /// Entries that a facet's list can hold: the facets that two flat faces have within reach, and 16 to spare.
    fn facet_capacity(&self) -> u32 {
        let spacing = self.bodies.iter().map(|b| b.spacing).fold(f64::INFINITY, f64::min);
        let q = self.facet_reach() / spacing;
        let face = [2.0, 2.0 * q, std::f64::consts::PI * q * q][self.dimension() - 1];
        let most = super::surface::pieces(&self.file, &self.bodies).into_iter().max().unwrap_or(1);
        let parts = super::surface::to_a_cell(most, self.dimension());
        if q > 0.0 { (2.0 * face * parts) as u32 + 16 } else { 0 }
    }

    /// A quarter of the square of the highest frequency that contact by surfaces gives a particle, in 1/time^2. The square of
    /// the frequency is the sum of k A over the particle's mass. Leapfrog is stable up to a step of 2/frequency; with the
    /// quarter, a step at cfl 1 stays below that. A facet at a distance d from its particle follows the particle's
    /// deformation too, so that the same force moves it farther: its k A counts 1 + 2 (d/spacing)^2 times.
    pub(super) fn contact_rate(&self) -> f64 {
        let stiffness = |body: usize| {
            // Each of two surfaces measures its gap to the other, so a body feels the stiffness twice.
            let own = self.facet_pairs.iter().map(|row| 2.0 * row[body].stiffness);
            own.chain(self.own_obstacles().iter().map(|obstacle| obstacle.pairs[body].stiffness)).fold(0.0, f64::max)
        };
        let stiffness: Vec<f64> = (0..self.bodies.len()).map(stiffness).collect();
        let mut rates = vec![0.0; self.particles.len()];
        for facet in self.own_facets() {
            let particle = &self.particles[facet.owner as usize];
            let body = &self.bodies[particle.body as usize];
            let way = facet.piece.position.distance_squared(particle.position) / (body.spacing * body.spacing);
            let pull = stiffness[particle.body as usize] * facet.piece.area * (1.0 + 2.0 * way);
            rates[facet.owner as usize] += pull / (particle.volume * body.material.density);
        }
        0.25 * rates.into_iter().fold(0.0, f64::max)
    }

    /// Entries that a particle's list of contacts can hold. The other body fills half of the ball within reach; room for the
    /// whole ball, and 16 more, leaves space for crowding.
    fn contact_capacity(&self) -> u32 {
        let spacing = self.bodies.iter().map(|b| b.spacing).fold(f64::INFINITY, f64::min);
        let q = self.contact_reach() / spacing;
        let inside = [2.0 * q, std::f64::consts::PI * q * q, 4.0 / 3.0 * std::f64::consts::PI * q * q * q][self.dimension() - 1];
        if q > 0.0 { inside as u32 + 16 } else { 0 }
    }

    /// Entries that a neighbour list needs. A list of the reference configuration needs as many as there are neighbours. A list
    /// that follows the particles gets what the densest packing holds within reach and half as much again (in the plane,
    /// where clumps form more easily, twice as much), since Eulerian particles may crowd.
    fn list_capacity(&self) -> u32 {
        if self.method.between {
            return 0;
        }
        if !self.method.list_follows() {
            return *self.most_bonds.get_or_init(|| self.most_neighbors(self.reach()).max(1));
        }
        let spacing = self.bodies.iter().map(|b| b.spacing).fold(f64::INFINITY, f64::min);
        let q = self.reach() / spacing;
        let (inside, crowding) = match self.dimension() {
            1 => (2.0 * q, 3.0),
            2 => (std::f64::consts::PI * q * q, 2.0),
            _ => (4.0 / 3.0 * std::f64::consts::PI * q * q * q, 1.5),
        };
        // Hexagonal packings are denser by 15 and 41 %.
        let packing = [1.0, 1.16, 1.42][self.dimension() - 1];
        let square = self.file.body.iter().all(|b| b.packing() == super::packing::Packing::Square);
        (inside * crowding * if square { 1.0 } else { packing }) as u32 + 16
    }

    fn params<R: Real>(&self) -> Params<R> {
        let real = R::of;
        let f = &self.file.formulation;
        let (origin, size, cells) = self.grid();
        let g = self.file.body_force.clone().unwrap_or_default();
        let component = |k: usize| real(g.get(k).copied().unwrap_or(0.0));
        // Where bodies differ in these numbers, no pass reads them here.
        let largest =
            |number: fn(&BodyOptions<f64>) -> f64| self.bodies.iter().map(|body| number(&body.options)).fold(0.0, f64::max);
        let softening = f.viscosity.as_ref().map_or(0.0, |viscosity| viscosity.softening);
        let mut planes = [[real(0.0); 4]; 3];
        for (slot, plane) in planes.iter_mut().zip(&self.planes) {
            *slot = [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset].map(real);
        }
        let h = self.bodies[0].smoothing_length;
        let shares = super::contacts::surface_counts(self);
        Params {
            planes,
            count: self.particles.len() as u32,
            first: 0,
            chunk: self.particles.len() as u32,
            list_capacity: f.list_capacity.unwrap_or_else(|| self.list_capacity()),
            cells_x: cells[0],
            cells_y: cells[1],
            cells_z: cells[2],
            cell_total: cells[0] * cells[1] * cells[2],
            plane_count: self.planes.len() as u32,
            body_count: self.numbered_bodies(),
            artificial_exponent: f.artificial_stress.as_ref().map_or(0, |a| a.exponent),
            contact_capacity: self.contact_capacity(),
            facet_count: self.own_facets().len() as u32,
            facet_capacity: self.facet_capacity(),
            obstacle_count: self.own_obstacles().len() as u32,
            facet_alike: self.facet_alike(),
            surface_count: shares[0],
            corner_count: shares[1],
            zero: 0,
            origin_x: real(origin[0]),
            origin_y: real(origin[1]),
            origin_z: real(origin[2]),
            cell_x: real(size[0]),
            cell_y: real(size[1]),
            cell_z: real(size[2]),
            period_x: real(self.period[0]),
            period_y: real(self.period[1]),
            period_z: real(self.period[2]),
            body_force_x: component(0),
            body_force_y: component(1),
            body_force_z: component(2),
            normalisation: real(f.smoothing.normalisation(self.dimension())),
            reach: real(self.reach()),
            contact_reach: real(self.contact_reach()),
            facet_reach: real(self.facet_reach()),
            contact_rate: real(self.contact_rate()),
            contact_apart: real(CONTACT_APART * self.bodies.iter().map(|b| b.spacing).fold(0.0, f64::max)),
            slack: real(0.5 * self.margin()),
            hourglass: real(largest(|options| options.hourglass)),
            alpha: real(largest(|options| options.alpha)),
            beta: real(largest(|options| options.beta)),
            softening: real(softening.max(LEAST_SOFTENING)),
            smoothing_weight: real(f.xsph.or(f.velocity_filter).unwrap_or(0.0)),
            artificial_epsilon: real(largest(|options| options.artificial_epsilon)),
            artificial_weight: real(f.smoothing.value(self.artificial_spacing, h, self.dimension())),
            cfl: real(self.file.time.cfl),
            fixed_step: real(self.file.time.step.unwrap_or(0.0)),
            rest_step: real(0.0),
            interval: real(self.file.interval()),
            stable: real(0.0),
            residual: real(self.file.quasi_static.as_ref().map_or(0.0, |q| q.residual)),
            load_rate: real(if self.file.quasi_static.is_some() { 1.0 / self.file.duration } else { 0.0 }),
        }
    }

    /// Origin, cell size and number of cells of each axis. The box is that of the start, half as long again
    /// on each side; particles that leave it still find their neighbours, only more slowly.
    fn grid(&self) -> ([f64; 3], [f64; 3], [u32; 3]) {
        let (low, high) = self.extent();
        let length = (high - low).max(DVec3::ZERO);
        let most = (CELLS_PER_PARTICLE * self.particles.len()).max(1 << 12);
        // A little more than the reach, so that rounding cannot put a pair two cells apart.
        let least = self.reach().max(self.contact_reach()).max(self.facet_cell());
        // Between groups that do not touch nothing is ever sorted into cells.
        let mut side = if least > 0.0 { 1.001 * least } else { self.smoothing_length() };
        loop {
            let (mut origin, mut size, mut cells) = ([0.0; 3], [side; 3], [1u32; 3]);
            for k in 0..self.dimension() {
                if self.period[k] > 0.0 {
                    cells[k] = ((self.period[k] / side).floor() as u32).max(3);
                    (origin[k], size[k]) = (low[k], self.period[k] / f64::from(cells[k]));
                } else {
                    let reach = 0.5 * length[k] + side;
                    origin[k] = low[k] - reach;
                    cells[k] = ((length[k] + 2.0 * reach) / side).ceil() as u32;
                }
            }
            if cells.iter().map(|&c| c as usize).product::<usize>() <= most {
                return (origin, size, cells);
            }
            side *= 1.1;
        }
    }
}

impl super::SceneObstacle {
    fn mover<R: Real>(&self) -> Mover<R> {
        let condition = self.condition.map_or(0, |index| index as u32 + 1);
        Mover { condition, inverse_mass: R::of(self.inverse_mass) }
    }
}

impl super::SceneBody {
    /// The body's row in the table of bodies.
    pub fn numbers<R: Real>(&self) -> Body<R> {
        Body { smoothing_length: self.smoothing_length, ..self.material.row() }.map(R::of)
    }
}
