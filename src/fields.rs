//! The one list of tables that have rows by count: a column of numbers for each particle, facet, obstacle, bond,
//! contact, cell or block, with its set, type, unit and meaning.
//!
//! From this list come the host columns, the device buffers, what they take, checkpoints, what is put in order with the
//! particles, and the table that `lithosph list` prints. A field exists in a run only if a pass of that run needs it:
//! see [`crate::step::fields`].

use crate::tensor::{Linear, Space};

/// What one row stores in a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    Integer,
    Real,
    Vec,
    Sym,
    Mat,
    /// A `Sym` for each axis.
    Tri,
    /// Four real numbers.
    Four,
    /// Eight real numbers.
    Eight,
}

/// Cells that one block of the prefix sum covers; values that one block of a reduction covers.
pub const SCAN_BLOCK: usize = 1024;
pub const REDUCTION_BLOCK: usize = 256;

macro_rules! sets {
    ($($name:ident, $word:literal, $count:expr, $about:literal;)*) => {
        /// What a field has a row for.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Set { $(#[doc = $about] $name),* }

        impl Set {
            pub const ALL: &'static [Set] = &[$(Set::$name),*];
            /// Name in lists.
            pub fn word(self) -> &'static str {
                match self { $(Set::$name => $word),* }
            }
        }

        impl Counts {
            /// Rows of a set.
            pub fn of(&self, set: Set) -> usize {
                let rows: fn(&Counts) -> usize = match set { $(Set::$name => $count),* };
                rows(self)
            }
        }
    };
}

/// What decides the number of rows of each set.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    pub particles: usize,
    pub facets: usize,
    pub obstacles: usize,
    pub cells: usize,
    /// Entries of one particle's list of neighbours, and of its list of contacts.
    pub list_capacity: usize,
    pub contact_capacity: usize,
    /// Entries of one facet's list of contacts.
    pub facet_capacity: usize,
}

// Entry k of row a of a list lies at `k * count + a`, so that neighbouring invocations read neighbouring words. The one
// exception is [`Field::Neighbors`], see [`Field::in_parts`].
sets! {
    Particle, "particles", |c| c.particles, "A particle.";
    Facet, "facets", |c| c.facets, "A piece of a body's surface, carried by a particle.";
    Obstacle, "obstacles", |c| c.obstacles, "A rigid obstacle.";
    Bond, "bonds", |c| c.particles * c.list_capacity, "An entry of a particle's list of neighbours.";
    KeptBond, "kept bonds", |c| c.particles * c.list_capacity, "An entry of a particle's list of the neighbours in the reference configuration, kept beside one that follows the particles.";
    Contact, "contacts", |c| c.particles * c.contact_capacity, "An entry of a particle's list of contacts.";
    FacetContact, "contacts of facets", |c| c.facets * c.facet_capacity, "An entry of a facet's list of contacts.";
    Cell, "cells", |c| c.cells, "A cell of the grid.";
    CellEnd, "ends of cells", |c| c.cells + 1, "A cell of the grid, and the end of the last.";
    CellEntry, "places in cells", |c| c.particles, "A place in the order of cells.";
    ScanBlock, "blocks of cells", |c| c.cells.div_ceil(SCAN_BLOCK), "A block of the prefix sum over cells.";
    ReductionBlock, "blocks of particles", |c| c.particles.div_ceil(REDUCTION_BLOCK), "A block of a reduction over particles.";
    ObstacleBlock, "blocks of facets", |c| c.obstacles * c.facet_blocks(), "A block of a reduction over facets, for each obstacle: block j of obstacle k at `k * blocks + j`.";
}

impl Counts {
    /// Blocks of the reduction over facets.
    pub fn facet_blocks(&self) -> usize {
        self.facets.div_ceil(REDUCTION_BLOCK)
    }

    /// Bytes of the columns of some fields, where a real number has `word` bytes.
    pub fn bytes(&self, fields: &[Field], dimension: usize, word: usize) -> u64 {
        let of = |field: &Field| {
            let size = if field.kind() == Type::Integer { 4 } else { word };
            (self.of(field.set()) * field.kind().words_in(dimension) * size) as u64
        };
        fields.iter().map(of).sum()
    }
}

/// How the unit of a field is made of length, mass and time: exponents in that order.
pub type Unit = [i8; 3];

macro_rules! column {
    (Integer, $S:ident) => { Vec<u32> };
    (Real, $S:ident) => { Vec<$S::Real> };
    (Vec, $S:ident) => { Vec<$S::Vec> };
    (Sym, $S:ident) => { Vec<$S::Sym> };
    (Mat, $S:ident) => { Vec<$S::Mat> };
    (Tri, $S:ident) => { Vec<$S::Tri> };
    (Four, $S:ident) => { Vec<[$S::Real; 4]> };
    (Eight, $S:ident) => { Vec<[$S::Real; 8]> };
}

macro_rules! fields {
    ($($name:ident: $Variant:ident, $set:ident, $kind:ident, $unit:expr, $carried:literal, $about:literal;)*) => {
        /// Names the fields.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Field { $($Variant),* }

        impl Field {
            pub const ALL: &'static [Field] = &[$(Field::$Variant),*];
            /// Name in shaders, files and pictures.
            pub fn name(self) -> &'static str {
                match self { $(Field::$Variant => stringify!($name)),* }
            }
            pub fn kind(self) -> Type {
                match self { $(Field::$Variant => Type::$kind),* }
            }
            pub fn unit(self) -> Unit {
                match self { $(Field::$Variant => $unit),* }
            }
            pub fn about(self) -> &'static str {
                match self { $(Field::$Variant => $about),* }
            }
            /// What it has a row for.
            pub fn set(self) -> Set {
                match self { $(Field::$Variant => Set::$set),* }
            }
            /// Part of the state: reordered with the particles and kept in a checkpoint. The others are
            /// made anew from the state before they are read.
            pub fn carried(self) -> bool {
                match self { $(Field::$Variant => $carried),* }
            }
        }

        /// All columns of a run; the ones that it does not need are empty.
        pub struct Columns<S: Space> { $(#[doc = $about] pub $name: column!($kind, S)),* }

        impl<S: Space> Clone for Columns<S> {
            fn clone(&self) -> Self {
                Self { $($name: self.$name.clone()),* }
            }
        }

        impl<S: Space> Default for Columns<S> {
            fn default() -> Self {
                Self { $($name: Vec::new()),* }
            }
        }

        impl<S: Space> Columns<S> {
            /// Columns of zeros for each of the fields.
            pub fn allocate(counts: Counts, fields: &[Field]) -> Self {
                let length = |field: Field| if fields.contains(&field) { counts.of(field.set()) } else { 0 };
                Self { $($name: vec![Default::default(); length(Field::$Variant)]),* }
            }
            /// Puts particle `order[k]` at place k in every carried column of particles.
            pub fn reorder(&mut self, order: &[u32]) {
                $(if $carried && Set::$set == Set::Particle && !self.$name.is_empty() {
                    self.$name = order.iter().map(|&k| self.$name[k as usize]).collect();
                })*
            }
            /// A column as the bytes that a storage buffer of the same precision holds.
            pub fn bytes(&self, field: Field) -> &[u8] {
                match field { $(Field::$Variant => bytemuck::cast_slice(&self.$name)),* }
            }
            /// Overwrites a column with bytes of the same length.
            pub fn bytes_mut(&mut self, field: Field) -> &mut [u8] {
                match field { $(Field::$Variant => bytemuck::cast_slice_mut(&mut self.$name)),* }
            }
            /// Fields that hold a column.
            pub fn present(&self) -> Vec<Field> {
                let mut list = Vec::new();
                $(if !self.$name.is_empty() { list.push(Field::$Variant); })*
                list
            }
        }
    };
}

const NONE: Unit = [0, 0, 0];
const LENGTH: Unit = [1, 0, 0];
const INVERSE_LENGTH: Unit = [-1, 0, 0];
const VELOCITY: Unit = [1, 0, -1];
const ACCELERATION: Unit = [1, 0, -2];
const RATE: Unit = [0, 0, -1];
const STRESS: Unit = [-1, 1, -2];
const STRESS_RATE: Unit = [-1, 1, -3];
const FORCE: Unit = [1, 1, -2];
const ENERGY: Unit = [2, 1, -2];
const SPECIFIC_STRESS: Unit = [5, -1, -2];
const SPECIFIC_ENERGY: Unit = [2, 0, -2];
const SPECIFIC_POWER: Unit = [2, 0, -3];

fields! {
    number: Number, Particle, Integer, NONE, true, "number given when the scene was packed; never changes";
    body: Body, Particle, Integer, NONE, true, "index of the particle's body";
    constraint: Constraint, Particle, Integer, NONE, true, "index of the boundary condition that holds the particle, plus 1; 0 if free";
    reference_position: ReferencePosition, Particle, Vec, LENGTH, true, "position when the scene was packed";
    reference_volume: ReferenceVolume, Particle, Real, [3, 0, 0], true, "volume when unstressed (area in 2D, length in 1D)";
    displacement: Displacement, Particle, Vec, LENGTH, true, "position less the reference position";
    displacement_carry: DisplacementCarry, Particle, Vec, LENGTH, true, "digits that f32 lost in the displacement's last sum";
    velocity: Velocity, Particle, Vec, VELOCITY, true, "velocity";
    velocity_carry: VelocityCarry, Particle, Vec, VELOCITY, true, "digits that f32 lost in the velocity's last sum";
    acceleration: Acceleration, Particle, Vec, ACCELERATION, true, "force over mass, before constraints";
    equilibrium_displacement: EquilibriumDisplacement, Particle, Vec, LENGTH, true, "displacement in equilibrium at the load step before";
    volumetric_strain: VolumetricStrain, Particle, Real, NONE, true, "reference density over density, minus 1";
    deviatoric_stress: DeviatoricStress, Particle, Sym, STRESS, true, "stress less its mean";
    displacement_gradient: DisplacementGradient, Particle, Mat, NONE, true, "H = F - 1: derivative of the displacement by the reference position";
    inelastic_strain: InelasticStrain, Particle, Sym, NONE, true, "C_i - 1 of a law that remembers: its inelastic Cauchy-Green tensor less the unit tensor";
    equivalent_plastic_strain: EquivalentPlasticStrain, Particle, Real, NONE, true, "integral of the plastic strain rate sqrt(2/3 d_p:d_p)";
    temperature: Temperature, Particle, Real, NONE, true, "temperature, in the unit of the material's numbers";
    equilibrium_inelastic_strain: EquilibriumInelasticStrain, Particle, Sym, NONE, true, "inelastic strain in equilibrium at the load step before";
    equilibrium_plastic_strain: EquilibriumPlasticStrain, Particle, Real, NONE, true, "equivalent plastic strain in equilibrium at the load step before";
    internal_energy: InternalEnergy, Particle, Real, SPECIFIC_ENERGY, true, "internal energy per mass";
    dissipated_energy: DissipatedEnergy, Particle, Real, SPECIFIC_ENERGY, true, "energy per mass that viscosity has turned into heat, and plastic work";
    smoothed_velocity: SmoothedVelocity, Particle, Vec, VELOCITY, false, "velocity averaged over neighbours (XSPH)";
    velocity_gradient: VelocityGradient, Particle, Mat, RATE, true, "dv_i/dx_j";
    correction: Correction, Particle, Mat, NONE, false, "inverse of the first moment of the kernel gradient";
    reference_correction: ReferenceCorrection, Particle, Sym, NONE, false, "inverse of the first moment of the kernel gradient in the reference configuration";
    linear_coefficient: LinearCoefficient, Particle, Sym, NONE, false, "quadratic-exact gradient: what multiplies the sum over the separations";
    quadratic_coefficient: QuadraticCoefficient, Particle, Tri, [-1, 0, 0], false, "quadratic-exact gradient: what multiplies the sum over the separations' products";
    quadratic_stress: QuadraticStress, Particle, Tri, [-2, 1, -2], false, "first Piola-Kirchhoff stress times the quadratic coefficient";
    bond_stress: BondStress, Particle, Mat, STRESS, false, "first Piola-Kirchhoff stress times the gradient correction, less the hourglass stiffness times H";
    shape_factor: ShapeFactor, Particle, Real, NONE, false, "alpha of the corrected kernel";
    shape_slope: ShapeSlope, Particle, Vec, INVERSE_LENGTH, false, "beta of the corrected kernel";
    shape_factor_gradient: ShapeFactorGradient, Particle, Vec, INVERSE_LENGTH, false, "derivative of alpha by the position";
    shape_slope_gradient: ShapeSlopeGradient, Particle, Mat, [-2, 0, 0], false, "derivative of beta by the position";
    shape_stress: ShapeStress, Particle, Mat, STRESS, false, "what the gradients of the shape functions carry: Kirchhoff's stress in the current configuration, the first Piola-Kirchhoff stress in the reference configuration";
    specific_stress: SpecificStress, Particle, Sym, SPECIFIC_STRESS, false, "stress over density squared";
    corrected_stress: CorrectedStress, Particle, Mat, STRESS, false, "stress times the gradient correction";
    artificial_pressure: ArtificialPressure, Particle, Real, SPECIFIC_STRESS, false, "Monaghan's artificial stress, scalar form, over density squared";
    artificial_stress: ArtificialStress, Particle, Sym, SPECIFIC_STRESS, false, "Monaghan's artificial stress, principal-stress form, over density squared";
    volumetric_strain_rate: VolumetricStrainRate, Particle, Real, RATE, false, "rate of the volumetric strain";
    deviatoric_stress_rate: DeviatoricStressRate, Particle, Sym, STRESS_RATE, false, "rate of the deviatoric stress, Jaumann";
    displacement_gradient_rate: DisplacementGradientRate, Particle, Mat, RATE, false, "rate of the displacement gradient, L F";
    internal_power: InternalPower, Particle, Real, SPECIFIC_POWER, true, "rate of the internal energy";
    dissipated_power: DissipatedPower, Particle, Real, SPECIFIC_POWER, true, "rate of the dissipated energy";
    displacement_start: DisplacementStart, Particle, Vec, LENGTH, false, "displacement when the Runge-Kutta step began";
    velocity_start: VelocityStart, Particle, Vec, VELOCITY, false, "velocity when the Runge-Kutta step began";
    volumetric_strain_start: VolumetricStrainStart, Particle, Real, NONE, false, "volumetric strain when the Runge-Kutta step began";
    deviatoric_stress_start: DeviatoricStressStart, Particle, Sym, STRESS, false, "deviatoric stress when the Runge-Kutta step began";
    displacement_gradient_start: DisplacementGradientStart, Particle, Mat, NONE, false, "displacement gradient when the Runge-Kutta step began";
    internal_energy_start: InternalEnergyStart, Particle, Real, SPECIFIC_ENERGY, false, "internal energy when the Runge-Kutta step began";
    dissipated_energy_start: DissipatedEnergyStart, Particle, Real, SPECIFIC_ENERGY, false, "dissipated energy when the Runge-Kutta step began";
    displacement_sum: DisplacementSum, Particle, Vec, VELOCITY, false, "weighted sum of the stages' rates of displacement";
    velocity_sum: VelocitySum, Particle, Vec, ACCELERATION, false, "weighted sum of the stages' accelerations";
    volumetric_strain_sum: VolumetricStrainSum, Particle, Real, RATE, false, "weighted sum of the stages' volumetric strain rates";
    deviatoric_stress_sum: DeviatoricStressSum, Particle, Sym, STRESS_RATE, false, "weighted sum of the stages' deviatoric stress rates";
    displacement_gradient_sum: DisplacementGradientSum, Particle, Mat, RATE, false, "weighted sum of the stages' displacement gradient rates";
    internal_energy_sum: InternalEnergySum, Particle, Real, SPECIFIC_POWER, false, "weighted sum of the stages' internal powers";
    dissipated_energy_sum: DissipatedEnergySum, Particle, Real, SPECIFIC_POWER, false, "weighted sum of the stages' dissipated powers";
    listed_displacement: ListedDisplacement, Particle, Vec, LENGTH, false, "displacement when the neighbour list was last built";
    cell: Cell, Particle, Integer, NONE, false, "index of the cell that holds the particle";
    hourglass_energy: HourglassEnergy, Particle, Real, [2, 1, -2], false, "energy of what the deformation gradient does not see, made when asked for";
    kept_count: KeptCount, Particle, Integer, NONE, false, "number of the particle's neighbours in the reference configuration";
    contact_count: ContactCount, Particle, Integer, NONE, false, "number of entries in the particle's list of contacts";
    colour_excess: ColourExcess, Particle, Real, NONE, false, "by how much the colour of the bodies touched exceeds its threshold";
    surface: Surface, Particle, Integer, NONE, true, "1 on the surface of the particle's body, 2 at a corner, else 0";
    surface_normal: SurfaceNormal, Particle, Vec, NONE, true, "outward unit normal of a surface particle";
    contact_rate: ContactRate, Particle, Real, [0, 0, -2], true, "square of the highest frequency that potentials to other bodies may give the particle";
    contact_energy: ContactEnergy, Particle, Real, [2, 1, -2], false, "the particle's part of the energy of its contacts";
    first_facet: FirstFacet, Particle, Integer, NONE, true, "index of the first piece of surface that the particle carries";
    facets: Facets, Particle, Integer, NONE, true, "number of the pieces of surface that the particle carries";
    facet_owner: FacetOwner, Facet, Integer, NONE, false, "index of the particle that carries the facet";
    facet_reference_position: FacetReferencePosition, Facet, Vec, LENGTH, false, "the facet's point when the scene was packed";
    facet_reference_normal: FacetReferenceNormal, Facet, Vec, NONE, false, "the facet's outward normal when the scene was packed";
    facet_area: FacetArea, Facet, Real, [2, 0, 0], false, "the facet's area when the scene was packed (length in 2D, 1 in 1D)";
    facet_displacement: FacetDisplacement, Facet, Vec, LENGTH, true, "displacement of the facet's point";
    facet_move: FacetMove, Facet, Vec, LENGTH, false, "what the facet's displacement grew by in this step";
    facet_normal: FacetNormal, Facet, Vec, NONE, false, "the facet's present outward normal";
    facet_contact_count: FacetContactCount, Facet, Integer, NONE, false, "number of entries in the facet's list of facets that it may touch";
    facet_pressed: FacetPressed, Facet, Integer, NONE, false, "1 where the facet presses on a surface or is in the list of one that does, else 0";
    facet_gap: FacetGap, Facet, Real, LENGTH, false, "smoothed distance to the other surface along its normals";
    facet_spread: FacetSpread, Facet, Real, NONE, false, "one over the sum of the weights of that surface's facets, 0 where it is out of touch";
    facet_pull: FacetPull, Facet, Real, FORCE, false, "derivative of the facet's energy by its gap, over the sum of the weights";
    facet_edge: FacetEdge, Facet, Real, ENERGY, false, "derivative of the facet's energy by the sum of the weights at a fixed gap";
    facet_slip: FacetSlip, Facet, Vec, LENGTH, true, "elastic slip of the facet on another body's surface";
    facet_traction: FacetTraction, Facet, Vec, FORCE, false, "friction of another body's surface on the facet";
    facet_force: FacetForce, Facet, Vec, FORCE, false, "force of contact on the facet";
    facet_moment: FacetMoment, Facet, Mat, ENERGY, false, "derivative of the energy of contact by the deformation gradient of the facet's particle";
    facet_pressure: FacetPressure, Facet, Real, STRESS, false, "pressure of contact on the facet";
    facet_energy: FacetEnergy, Facet, Real, ENERGY, false, "energy of the facet's contact";
    facet_heat: FacetHeat, Facet, Real, ENERGY, false, "heat that the facet's friction made in this step";
    facet_obstacle_slip: FacetObstacleSlip, Facet, Vec, LENGTH, true, "elastic slip of the facet on an obstacle";
    facet_load: FacetLoad, Facet, Vec, FORCE, false, "force of the obstacle that the facet touches most";
    facet_obstacle: FacetObstacle, Facet, Integer, NONE, false, "index of that obstacle, plus 1; 0 for none";
    obstacle_displacement: ObstacleDisplacement, Obstacle, Vec, LENGTH, true, "displacement of a rigid obstacle";
    obstacle_move: ObstacleMove, Obstacle, Vec, LENGTH, true, "what the obstacle's displacement grew by in this step";
    obstacle_velocity: ObstacleVelocity, Obstacle, Vec, VELOCITY, true, "velocity of a rigid obstacle";
    obstacle_force: ObstacleForce, Obstacle, Vec, FORCE, true, "force of the bodies on a rigid obstacle";
    neighbor_count: NeighborCount, Particle, Integer, NONE, false, "number of entries in the particle's neighbour list";
    cell_count: CellCount, Cell, Integer, NONE, false, "particles in the cell while they are being binned; zero otherwise";
    cell_start: CellStart, CellEnd, Integer, NONE, false, "where the cell's particles begin among those in order of cells";
    cell_block: CellBlock, ScanBlock, Integer, NONE, false, "particles before the block of cells";
    cell_particles: CellParticles, CellEntry, Integer, NONE, false, "index of the particle at this place in the order of cells";
    neighbors: Neighbors, Bond, Integer, NONE, false, "neighbour: its index, and in the highest bits the planes it is mirrored in";
    kept_neighbors: KeptNeighbors, KeptBond, Integer, NONE, false, "neighbour in the reference configuration, kept beside a list that follows the particles";
    kept_gradients: KeptGradients, KeptBond, Vec, INVERSE_LENGTH, false, "V_b times the gradient at a of b's shape function, in the reference configuration";
    contacts: Contacts, Contact, Integer, NONE, false, "index of a particle that the particle may touch";
    zone_forces: ZoneForces, Contact, Vec, FORCE, false, "force of the particle's zone on that contact";
    facet_contacts: FacetContacts, FacetContact, Integer, NONE, false, "index of a facet that the facet may touch";
    block_load: BlockLoad, ObstacleBlock, Vec, FORCE, false, "force on the obstacle from the block of facets";
    block_bound: BlockBound, ReductionBlock, Four, NONE, false, "of the block: largest rate, squared displacement since the list was built, squared speed, and fault";
    block_residual: BlockResidual, ReductionBlock, Eight, NONE, false, "of the block: what tells how far from equilibrium its particles are";
}

impl Field {
    /// Whether the host and a device lay it out differently: the list of neighbours, alone of all. On the host it is a row
    /// of `list_capacity` entries for each particle; a device, which may have no buffer that long, takes it in parts,
    /// each as columns: entry k of particle i of a part at `k * count + (i - first)`.
    pub fn in_parts(self) -> bool {
        self == Field::Neighbors
    }
}

impl Type {
    /// 32- or 64-bit words that one row takes.
    pub fn words<S: Space>(self) -> usize {
        match self {
            Type::Integer | Type::Real => 1,
            Type::Vec => S::Vec::LENGTH,
            Type::Sym => S::Sym::LENGTH,
            Type::Mat => S::Mat::LENGTH,
            Type::Tri => S::Tri::LENGTH,
            Type::Four => 4,
            Type::Eight => 8,
        }
    }

    /// The same for a dimension known only at run time.
    pub fn words_in(self, dimension: usize) -> usize {
        use crate::tensor::{Line, Plane, Solid};
        match dimension {
            1 => self.words::<Line<f32>>(),
            2 => self.words::<Plane<f32>>(),
            _ => self.words::<Solid<f32>>(),
        }
    }
}

/// A unit in words: "m", "kg", "s" replaced by the three names given.
pub fn unit_text(unit: Unit, names: [&str; 3]) -> String {
    let part = |k: usize| match unit[k] {
        0 => None,
        1 => Some(names[k].to_string()),
        power => Some(format!("{}^{power}", names[k])),
    };
    let parts: Vec<String> = (0..3).filter_map(part).collect();
    if parts.is_empty() { "1".into() } else { parts.join(" ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::{Plane, Solid};

    #[test]
    fn only_the_named_fields_take_memory() {
        let counts = Counts { particles: 10, ..Counts::default() };
        let columns = Columns::<Plane<f32>>::allocate(counts, &[Field::Velocity, Field::Number]);
        assert_eq!(columns.present(), [Field::Number, Field::Velocity]);
        assert_eq!(columns.bytes(Field::Velocity).len(), 80);
    }

    #[test]
    fn every_set_has_rows_and_every_field_the_bytes_of_its_rows() {
        let counts = Counts {
            particles: 300,
            facets: 270,
            obstacles: 2,
            cells: 1030,
            list_capacity: 5,
            contact_capacity: 3,
            facet_capacity: 4,
        };
        let rows = [300, 270, 2, 1500, 1500, 900, 1080, 1030, 1031, 300, 2, 2, 4];
        assert_eq!(Set::ALL.iter().map(|&set| counts.of(set)).collect::<Vec<_>>(), rows);
        let (columns, wide) =
            (Columns::<Plane<f32>>::allocate(counts, Field::ALL), Columns::<Solid<f64>>::allocate(counts, Field::ALL));
        assert_eq!(columns.present(), Field::ALL);
        for field in Field::ALL {
            assert_eq!(columns.bytes(*field).len() as u64, counts.bytes(&[*field], 2, 4), "{}", field.name());
            assert_eq!(wide.bytes(*field).len() as u64, counts.bytes(&[*field], 3, 8), "{}", field.name());
        }
    }

    #[test]
    fn only_carried_columns_of_particles_are_reordered() {
        let counts = Counts { particles: 2, facets: 2, list_capacity: 1, ..Counts::default() };
        let mut columns = Columns::<Plane<f32>>::allocate(counts, &[Field::Number, Field::Cell, Field::Neighbors]);
        (columns.number, columns.cell, columns.neighbors) = (vec![7, 8], vec![1, 2], vec![3, 4]);
        columns.reorder(&[1, 0]);
        assert_eq!((columns.number, columns.cell, columns.neighbors), (vec![8, 7], vec![1, 2], vec![3, 4]));
    }

    #[test]
    fn units_read_as_words() {
        assert_eq!(unit_text(STRESS, ["m", "kg", "s"]), "m^-1 kg s^-2");
        assert_eq!(unit_text(NONE, ["m", "kg", "s"]), "1");
    }
}
