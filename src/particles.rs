//! The one list of fields: a column of numbers for each particle, with its type, unit and meaning.
//!
//! From this list come the host columns, the device buffers, checkpoints and the table that `lithosph list`
//! prints. A field exists in a run only if a pass of that run needs it: see [`crate::step::fields`].

use crate::tensor::{Linear, Space};

/// What one particle stores in a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    Integer,
    Real,
    Vec,
    Sym,
    Mat,
    /// A `Sym` for each axis.
    Tri,
}

/// What a field has a row for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Set {
    Particle,
    /// A piece of a body's surface, carried by a particle: names begin with `facet_`.
    Facet,
    /// A rigid obstacle: names begin with `obstacle_`.
    Obstacle,
}

/// Rows of each set.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    pub particles: usize,
    pub facets: usize,
    pub obstacles: usize,
}

impl Counts {
    pub fn of(&self, set: Set) -> usize {
        match set {
            Set::Particle => self.particles,
            Set::Facet => self.facets,
            Set::Obstacle => self.obstacles,
        }
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
}

macro_rules! fields {
    ($($name:ident: $Variant:ident, $kind:ident, $unit:expr, $carried:literal, $about:literal;)*) => {
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
            pub fn set(self) -> Set {
                let name = self.name();
                let named = |prefix| name.starts_with(prefix);
                if named("facet_") { Set::Facet } else if named("obstacle_") { Set::Obstacle } else { Set::Particle }
            }
            /// Part of the state: reordered with the particles and kept in a checkpoint. The others are
            /// made anew from the state before they are read.
            pub fn carried(self) -> bool {
                match self { $(Field::$Variant => $carried),* }
            }
        }

        /// All columns of a run; the ones that it does not need are empty.
        pub struct Particles<S: Space> { $(#[doc = $about] pub $name: column!($kind, S)),* }

        impl<S: Space> Clone for Particles<S> {
            fn clone(&self) -> Self {
                Self { $($name: self.$name.clone()),* }
            }
        }

        impl<S: Space> Default for Particles<S> {
            fn default() -> Self {
                Self { $($name: Vec::new()),* }
            }
        }

        impl<S: Space> Particles<S> {
            /// Columns of zeros for each of the fields.
            pub fn allocate(counts: Counts, fields: &[Field]) -> Self {
                let length = |field: Field| if fields.contains(&field) { counts.of(field.set()) } else { 0 };
                Self { $($name: vec![Default::default(); length(Field::$Variant)]),* }
            }
            /// Puts particle `order[k]` at place k in every carried column of particles.
            pub fn reorder(&mut self, order: &[u32]) {
                $(if $carried && Field::$Variant.set() == Set::Particle && !self.$name.is_empty() {
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
    number: Number, Integer, NONE, true, "number given when the scene was packed; never changes";
    body: Body, Integer, NONE, true, "index of the particle's body";
    constraint: Constraint, Integer, NONE, true, "index of the boundary condition that holds the particle, plus 1; 0 if free";
    reference_position: ReferencePosition, Vec, LENGTH, true, "position when the scene was packed";
    reference_volume: ReferenceVolume, Real, [3, 0, 0], true, "volume when unstressed (area in 2D, length in 1D)";
    displacement: Displacement, Vec, LENGTH, true, "position less the reference position";
    displacement_carry: DisplacementCarry, Vec, LENGTH, true, "digits that f32 lost in the displacement's last sum";
    velocity: Velocity, Vec, VELOCITY, true, "velocity";
    velocity_carry: VelocityCarry, Vec, VELOCITY, true, "digits that f32 lost in the velocity's last sum";
    acceleration: Acceleration, Vec, ACCELERATION, true, "force over mass, before constraints";
    equilibrium_displacement: EquilibriumDisplacement, Vec, LENGTH, true, "displacement in equilibrium at the load step before";
    volumetric_strain: VolumetricStrain, Real, NONE, true, "reference density over density, minus 1";
    deviatoric_stress: DeviatoricStress, Sym, STRESS, true, "stress less its mean";
    displacement_gradient: DisplacementGradient, Mat, NONE, true, "H = F - 1: derivative of the displacement by the reference position";
    inelastic_strain: InelasticStrain, Sym, NONE, true, "C_i - 1 of a law that remembers: its inelastic Cauchy-Green tensor less the unit tensor";
    equivalent_plastic_strain: EquivalentPlasticStrain, Real, NONE, true, "integral of the plastic strain rate sqrt(2/3 d_p:d_p)";
    temperature: Temperature, Real, NONE, true, "temperature, in the unit of the material's numbers";
    equilibrium_inelastic_strain: EquilibriumInelasticStrain, Sym, NONE, true, "inelastic strain in equilibrium at the load step before";
    equilibrium_plastic_strain: EquilibriumPlasticStrain, Real, NONE, true, "equivalent plastic strain in equilibrium at the load step before";
    internal_energy: InternalEnergy, Real, SPECIFIC_ENERGY, true, "internal energy per mass";
    dissipated_energy: DissipatedEnergy, Real, SPECIFIC_ENERGY, true, "energy per mass that viscosity has turned into heat, and plastic work";
    smoothed_velocity: SmoothedVelocity, Vec, VELOCITY, false, "velocity averaged over neighbours (XSPH)";
    velocity_gradient: VelocityGradient, Mat, RATE, true, "dv_i/dx_j";
    correction: Correction, Mat, NONE, false, "inverse of the first moment of the kernel gradient";
    reference_correction: ReferenceCorrection, Sym, NONE, false, "inverse of the first moment of the kernel gradient in the reference configuration";
    linear_coefficient: LinearCoefficient, Sym, NONE, false, "quadratic-exact gradient: what multiplies the sum over the separations";
    quadratic_coefficient: QuadraticCoefficient, Tri, [-1, 0, 0], false, "quadratic-exact gradient: what multiplies the sum over the separations' products";
    quadratic_stress: QuadraticStress, Tri, [-2, 1, -2], false, "first Piola-Kirchhoff stress times the quadratic coefficient";
    bond_stress: BondStress, Mat, STRESS, false, "first Piola-Kirchhoff stress times the gradient correction, less the hourglass stiffness times H";
    shape_factor: ShapeFactor, Real, NONE, false, "alpha of the corrected kernel";
    shape_slope: ShapeSlope, Vec, INVERSE_LENGTH, false, "beta of the corrected kernel";
    shape_factor_gradient: ShapeFactorGradient, Vec, INVERSE_LENGTH, false, "derivative of alpha by the position";
    shape_slope_gradient: ShapeSlopeGradient, Mat, [-2, 0, 0], false, "derivative of beta by the position";
    shape_stress: ShapeStress, Mat, STRESS, false, "what the gradients of the shape functions carry: Kirchhoff's stress in the current configuration, the first Piola-Kirchhoff stress in the reference configuration";
    specific_stress: SpecificStress, Sym, SPECIFIC_STRESS, false, "stress over density squared";
    corrected_stress: CorrectedStress, Mat, STRESS, false, "stress times the gradient correction";
    artificial_pressure: ArtificialPressure, Real, SPECIFIC_STRESS, false, "Monaghan's artificial stress, scalar form, over density squared";
    artificial_stress: ArtificialStress, Sym, SPECIFIC_STRESS, false, "Monaghan's artificial stress, principal-stress form, over density squared";
    volumetric_strain_rate: VolumetricStrainRate, Real, RATE, false, "rate of the volumetric strain";
    deviatoric_stress_rate: DeviatoricStressRate, Sym, STRESS_RATE, false, "rate of the deviatoric stress, Jaumann";
    displacement_gradient_rate: DisplacementGradientRate, Mat, RATE, false, "rate of the displacement gradient, L F";
    internal_power: InternalPower, Real, SPECIFIC_POWER, true, "rate of the internal energy";
    dissipated_power: DissipatedPower, Real, SPECIFIC_POWER, true, "rate of the dissipated energy";
    displacement_start: DisplacementStart, Vec, LENGTH, false, "displacement when the Runge-Kutta step began";
    velocity_start: VelocityStart, Vec, VELOCITY, false, "velocity when the Runge-Kutta step began";
    volumetric_strain_start: VolumetricStrainStart, Real, NONE, false, "volumetric strain when the Runge-Kutta step began";
    deviatoric_stress_start: DeviatoricStressStart, Sym, STRESS, false, "deviatoric stress when the Runge-Kutta step began";
    displacement_gradient_start: DisplacementGradientStart, Mat, NONE, false, "displacement gradient when the Runge-Kutta step began";
    internal_energy_start: InternalEnergyStart, Real, SPECIFIC_ENERGY, false, "internal energy when the Runge-Kutta step began";
    dissipated_energy_start: DissipatedEnergyStart, Real, SPECIFIC_ENERGY, false, "dissipated energy when the Runge-Kutta step began";
    displacement_sum: DisplacementSum, Vec, VELOCITY, false, "weighted sum of the stages' rates of displacement";
    velocity_sum: VelocitySum, Vec, ACCELERATION, false, "weighted sum of the stages' accelerations";
    volumetric_strain_sum: VolumetricStrainSum, Real, RATE, false, "weighted sum of the stages' volumetric strain rates";
    deviatoric_stress_sum: DeviatoricStressSum, Sym, STRESS_RATE, false, "weighted sum of the stages' deviatoric stress rates";
    displacement_gradient_sum: DisplacementGradientSum, Mat, RATE, false, "weighted sum of the stages' displacement gradient rates";
    internal_energy_sum: InternalEnergySum, Real, SPECIFIC_POWER, false, "weighted sum of the stages' internal powers";
    dissipated_energy_sum: DissipatedEnergySum, Real, SPECIFIC_POWER, false, "weighted sum of the stages' dissipated powers";
    listed_displacement: ListedDisplacement, Vec, LENGTH, false, "displacement when the neighbour list was last built";
    cell: Cell, Integer, NONE, false, "index of the cell that holds the particle";
    hourglass_energy: HourglassEnergy, Real, [2, 1, -2], false, "energy of what the deformation gradient does not see, made when asked for";
    kept_count: KeptCount, Integer, NONE, false, "number of the particle's neighbours in the reference configuration";
    contact_count: ContactCount, Integer, NONE, false, "number of entries in the particle's list of contacts";
    colour_excess: ColourExcess, Real, NONE, false, "by how much the colour of the bodies touched exceeds its threshold";
    surface: Surface, Integer, NONE, true, "1 on the surface of the particle's body, 2 at a corner, else 0";
    surface_normal: SurfaceNormal, Vec, NONE, true, "outward unit normal of a surface particle";
    contact_energy: ContactEnergy, Real, [2, 1, -2], false, "the particle's part of the energy of its contacts";
    first_facet: FirstFacet, Integer, NONE, true, "index of the first piece of surface that the particle carries";
    facets: Facets, Integer, NONE, true, "number of the pieces of surface that the particle carries";
    facet_owner: FacetOwner, Integer, NONE, false, "index of the particle that carries the facet";
    facet_reference_position: FacetReferencePosition, Vec, LENGTH, false, "the facet's point when the scene was packed";
    facet_reference_normal: FacetReferenceNormal, Vec, NONE, false, "the facet's outward normal when the scene was packed";
    facet_area: FacetArea, Real, [2, 0, 0], false, "the facet's area when the scene was packed (length in 2D, 1 in 1D)";
    facet_displacement: FacetDisplacement, Vec, LENGTH, true, "displacement of the facet's point";
    facet_move: FacetMove, Vec, LENGTH, false, "what the facet's displacement grew by in this step";
    facet_normal: FacetNormal, Vec, NONE, false, "the facet's present outward normal";
    facet_contact_count: FacetContactCount, Integer, NONE, false, "number of entries in the facet's list of facets that it may touch";
    facet_pressed: FacetPressed, Integer, NONE, false, "1 where the facet presses on a surface or is in the list of one that does, else 0";
    facet_gap: FacetGap, Real, LENGTH, false, "smoothed distance to the other surface along its normals";
    facet_spread: FacetSpread, Real, NONE, false, "one over the sum of the weights of that surface's facets, 0 where it is out of touch";
    facet_pull: FacetPull, Real, FORCE, false, "derivative of the facet's energy by its gap, over the sum of the weights";
    facet_edge: FacetEdge, Real, ENERGY, false, "derivative of the facet's energy by the sum of the weights at a fixed gap";
    facet_slip: FacetSlip, Vec, LENGTH, true, "elastic slip of the facet on another body's surface";
    facet_traction: FacetTraction, Vec, FORCE, false, "friction of another body's surface on the facet";
    facet_force: FacetForce, Vec, FORCE, false, "force of contact on the facet";
    facet_moment: FacetMoment, Mat, ENERGY, false, "derivative of the energy of contact by the deformation gradient of the facet's particle";
    facet_pressure: FacetPressure, Real, STRESS, false, "pressure of contact on the facet";
    facet_energy: FacetEnergy, Real, ENERGY, false, "energy of the facet's contact";
    facet_heat: FacetHeat, Real, ENERGY, false, "heat that the facet's friction made in this step";
    facet_obstacle_slip: FacetObstacleSlip, Vec, LENGTH, true, "elastic slip of the facet on an obstacle";
    facet_load: FacetLoad, Vec, FORCE, false, "force of the obstacle that the facet touches most";
    facet_obstacle: FacetObstacle, Integer, NONE, false, "index of that obstacle, plus 1; 0 for none";
    obstacle_displacement: ObstacleDisplacement, Vec, LENGTH, true, "displacement of a rigid obstacle";
    obstacle_move: ObstacleMove, Vec, LENGTH, true, "what the obstacle's displacement grew by in this step";
    obstacle_velocity: ObstacleVelocity, Vec, VELOCITY, true, "velocity of a rigid obstacle";
    obstacle_force: ObstacleForce, Vec, FORCE, true, "force of the bodies on a rigid obstacle";
    neighbor_count: NeighborCount, Integer, NONE, false, "number of entries in the particle's neighbour list";
}

impl Type {
    /// 32- or 64-bit words that one particle takes.
    pub fn words<S: Space>(self) -> usize {
        match self {
            Type::Integer | Type::Real => 1,
            Type::Vec => S::Vec::LENGTH,
            Type::Sym => S::Sym::LENGTH,
            Type::Mat => S::Mat::LENGTH,
            Type::Tri => S::Tri::LENGTH,
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
    use crate::tensor::Plane;

    #[test]
    fn only_the_named_fields_take_memory() {
        let particles =
            Particles::<Plane<f32>>::allocate(Counts { particles: 10, ..Counts::default() }, &[Field::Velocity, Field::Number]);
        assert_eq!(particles.present(), [Field::Number, Field::Velocity]);
        assert_eq!(particles.bytes(Field::Velocity).len(), 80);
    }

    #[test]
    fn units_read_as_words() {
        assert_eq!(unit_text(STRESS, ["m", "kg", "s"]), "m^-1 kg s^-2");
        assert_eq!(unit_text(NONE, ["m", "kg", "s"]), "1");
    }
}
