//! Passes: the smallest pieces of a step, each a shader `shaders/pass/x.wgsl` and its twin `src/pass/x.rs`.
//!
//! A pass writes only to particle (or cell, or block) i. Twins have the shape of their shader without its
//! machinery: the loop over i is [`write`], which runs on all cores.

mod attach_facets;
mod begin_load;
mod bin_cells;
mod bond_force;
mod bond_friction;
mod bound_residual;
mod bound_time_step;
mod carry_facets;
mod contact_force;
mod correct_gradient;
mod correct_quadratic;
mod correct_reference;
mod deform;
mod deform_by_shape;
mod descend;
mod drift;
mod evolve_deformation;
mod fill_cells;
mod filter_velocity;
mod find_contacts;
mod find_facet_contacts;
mod find_neighbors;
mod find_normals;
mod find_surface;
mod force;
mod hourglass_energy;
mod keep_gradients;
mod keep_listed;
mod kick;
mod load_obstacles;
mod measure_gap;
mod move_obstacles;
mod place_facets;
mod press_facets;
mod push_intruders;
mod reorder;
mod runge_kutta;
mod scan_cells;
mod shape_force;
mod shape_function;
mod shape_stress;
mod smooth_velocity;
mod sort_cells;
mod specific_stress;
mod stage;
mod strain_rate;
mod stress;
mod stress_rate;
mod sum_colour;
mod sum_density;
mod surface_force;
mod touch_obstacles;
mod write;
mod zone_force;

pub use bound_residual::{force_scale, unbalanced};
pub use stage::Stage;
pub(crate) use write::{compensated_add, write};

use crate::method::Method;
use crate::state::State;
use crate::tensor::Space;

/// What one dispatch runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// One invocation a particle.
    Particles,
    /// The same, but the pass binds the neighbour list, and so is dispatched for each of its parts.
    Listed,
    /// One invocation a facet.
    Facets,
    /// One workgroup of 256 for each [`crate::rows::REDUCTION_BLOCK`] facets.
    FacetBlocks,
    /// One invocation a cell.
    Cells,
    /// One workgroup of 256 for each [`crate::rows::SCAN_BLOCK`] cells.
    ScanBlocks,
    /// One workgroup of 256 for each [`crate::rows::REDUCTION_BLOCK`] particles.
    ReductionBlocks,
    /// One workgroup of 256.
    One,
}

/// An entry point of a pass's shader and what it runs over.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    pub name: &'static str,
    pub domain: Domain,
}

/// A pass at its place in the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Call {
    pub pass: Pass,
    pub stage: Stage,
}

macro_rules! passes {
    ($($word:ident: $name:ident, [$($entry:ident: $domain:ident),*], $about:literal;)*) => {
        /// Names the passes.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Pass { $($name),* }

        impl Pass {
            pub const ALL: &'static [Pass] = &[$(Pass::$name),*];
            /// File stem, pipeline label, name in timings.
            pub fn name(self) -> &'static str {
                match self { $(Pass::$name => stringify!($word)),* }
            }
            pub fn about(self) -> &'static str {
                match self { $(Pass::$name => $about),* }
            }
            /// The shader twin's source, before composition.
            pub fn source(self) -> &'static str {
                match self {
                    $(Pass::$name => include_str!(concat!("../../shaders/pass/", stringify!($word), ".wgsl"))),*
                }
            }
            pub fn entries(self) -> &'static [Entry] {
                match self {
                    $(Pass::$name => &[$(Entry { name: stringify!($entry), domain: Domain::$domain }),*]),*
                }
            }
            /// Runs the twin.
            pub fn run<S: Space>(self, state: &mut State<S>, stage: Stage) {
                match self { $(Pass::$name => $word::run(state, stage)),* }
            }
        }
    };
}

passes! {
    bin_cells: BinCells, [main: Particles], "counts the particles of each cell";
    scan_cells: ScanCells, [blocks: ScanBlocks, totals: One, offsets: ScanBlocks], "prefix sum of the counts: where each cell's particles begin";
    fill_cells: FillCells, [main: Particles], "puts each particle into its cell";
    sort_cells: SortCells, [main: Cells], "orders the particles of a cell, so that sums do not depend on the threads";
    reorder: Reorder, [main: Particles], "moves all carried fields into cell order";
    find_neighbors: FindNeighbors, [main: Listed], "lists the particles within reach, mirror images included";
    sum_density: SumDensity, [main: Listed], "density from the masses around, Fuller (2.22)";
    strain_rate: StrainRate, [main: Listed], "velocity gradient, Fuller (2.14)";
    stress: Stress, [main: Particles], "advances volumetric strain and deviatoric stress by a step";
    stress_rate: StressRate, [main: Particles], "rates of volumetric strain and deviatoric stress, Fuller (2.21), (2.45)";
    correct_gradient: CorrectGradient, [main: Listed], "inverse of the first moment of the kernel gradient";
    specific_stress: SpecificStress, [main: Particles], "stress in the form that the pair force sums, and the artificial stress";
    force: Force, [main: Listed], "acceleration, Fuller (2.59) with the sign of the viscosity mended";
    correct_reference: CorrectReference, [main: Listed], "inverse of the first moment of the kernel gradient in the reference configuration";
    correct_quadratic: CorrectQuadratic, [main: Listed], "coefficients of the gradient that is exact for quadratic displacements";
    deform: Deform, [main: Listed], "deformation gradient, stress, and what the bonds carry of it";
    bond_force: BondForce, [main: Listed], "acceleration by the bonds of the reference configuration";
    bond_friction: BondFriction, [main: Listed], "adds viscosity between the ends of bonds";
    hourglass_energy: HourglassEnergy, [main: Listed], "energy of the hourglass term, when asked for";
    shape_function: ShapeFunction, [main: Listed], "corrects the kernel, Shutov & Klyuchantsev (1) to (3)";
    keep_gradients: KeepGradients, [main: Listed], "keeps the gradients of the shape functions of the reference configuration";
    deform_by_shape: DeformByShape, [main: Listed], "deformation gradient from displacements, Shutov & Klyuchantsev (8)";
    evolve_deformation: EvolveDeformation, [main: Listed], "advances the deformation gradient, or gives its rate, Shutov & Klyuchantsev (6), (9)";
    shape_stress: ShapeStress, [main: Particles], "stress that the gradients of the shape functions carry";
    shape_force: ShapeForce, [main: Listed], "acceleration by the shape functions' gradients, Shutov & Klyuchantsev (5)";
    find_contacts: FindContacts, [main: Particles], "lists the particles that each particle may touch";
    sum_colour: SumColour, [main: Particles], "how far the colour of the bodies touched exceeds its threshold";
    contact_force: ContactForce, [main: Particles], "adds the acceleration by contact";
    attach_facets: AttachFacets, [main: Particles], "tells each facet the particle that carries it";
    keep_listed: KeepListed, [main: Particles], "keeps the displacements at which the list of facets is made";
    find_facet_contacts: FindFacetContacts, [main: Facets], "lists the facets that each facet may touch";
    move_obstacles: MoveObstacles, [main: One], "moves rigid obstacles to the end of the step";
    place_facets: PlaceFacets, [main: Facets], "moves facets with their particles";
    measure_gap: MeasureGap, [main: Facets], "smoothed distance of each facet from the surface that faces it, and friction";
    press_facets: PressFacets, [main: Facets], "force of other bodies' surfaces on each facet";
    touch_obstacles: TouchObstacles, [main: Facets], "force of rigid obstacles on each facet";
    carry_facets: CarryFacets, [main: Particles], "adds to what the bonds carry the stress that the facets' levers make";
    surface_force: SurfaceForce, [main: Particles], "adds the acceleration by the facets that a particle carries";
    load_obstacles: LoadObstacles, [blocks: FacetBlocks, total: One], "sums the force on each rigid obstacle";
    find_surface: FindSurface, [main: Listed], "finds surfaces and corners by the number of neighbours, Fuller 4.3.1";
    find_normals: FindNormals, [main: Listed], "normals of surface particles, Fuller (4.1)";
    push_intruders: PushIntruders, [main: Listed], "force of the zone of each surface particle on those inside, Fuller (4.2), (4.3)";
    zone_force: ZoneForce, [main: Particles], "adds the acceleration by zones";
    smooth_velocity: SmoothVelocity, [main: Listed], "velocity averaged over neighbours, Fuller (3.2)";
    filter_velocity: FilterVelocity, [main: Particles], "puts the smoothed velocity in the velocity's place";
    kick: Kick, [main: Particles], "advances the velocity by a part of the step";
    drift: Drift, [main: Particles], "advances the displacement by a part of the step";
    runge_kutta: RungeKutta, [main: Particles], "adds a stage's rates and sets the next stage's state";
    begin_load: BeginLoad, [main: Particles], "moves what is held by a load step, and predicts the rest";
    descend: Descend, [main: Particles], "moves free particles toward equilibrium";
    bound_residual: BoundResidual, [blocks: ReductionBlocks, advance: One], "finds how far from equilibrium the particles are, and how to go on";
    bound_time_step: BoundTimeStep, [blocks: ReductionBlocks, advance: One], "advances the clock; finds the next step, whether the list still holds, and faults";
}

impl Pass {
    /// Whether the pass sums the forces on the particles. The number of such passes is the cost of an integrator's step.
    pub fn is_force(self) -> bool {
        matches!(self, Pass::Force | Pass::BondForce)
    }
    /// Whether the pass serves contact alone; benchmarks add up the time of such passes. Sorting into cells counts as contact
    /// where no neighbour list follows the particles, since then only the lists of contacts are made from cells.
    pub fn is_contact(self, method: &Method) -> bool {
        use Pass::*;
        let cells = !method.list_follows() && matches!(self, BinCells | ScanCells | FillCells | SortCells);
        let lists = cells || matches!(self, FindContacts | KeepListed | FindFacetContacts);
        let potentials = matches!(self, SumColour | ContactForce | FindSurface | FindNormals | PushIntruders | ZoneForce);
        let gaps = matches!(self, PlaceFacets | MeasureGap | PressFacets | CarryFacets | SurfaceForce);
        lists || potentials || gaps || matches!(self, MoveObstacles | TouchObstacles | LoadObstacles)
    }
}
