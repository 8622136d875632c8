//! Passes: the smallest pieces of a step, each a shader `shaders/pass/x.wgsl` and its twin `src/pass/x.rs`.
//!
//! A pass writes only to particle (or cell, or block) i. Beside its twin it declares what it reads of its own particle
//! and of neighbours, what it writes, and when it runs: see [`Declaration`]. Twins have the shape of their shader without
//! its machinery: the loop over i is `write::fill`, which runs on all cores.

mod attach_facets;
mod begin_load;
mod bin_cells;
mod bond_force;
mod bond_friction;
mod bound_between;
mod bound_residual;
mod bound_time_step;
mod carry_facets;
mod contact_force;
mod correct_gradient;
mod correct_quadratic;
mod correct_reference;
mod declaration;
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
pub use declaration::{Declaration, Domain, Entry, Runs, Use};
pub use stage::Stage;
pub(crate) use write::{compensated_add, write};

use crate::method::Method;
use crate::state::State;
use crate::tensor::{Line, Plane, Solid, Space};
use std::any::Any;

/// A pass at its place in the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Call {
    pub pass: Pass,
    pub stage: Stage,
}

macro_rules! passes {
    ($($word:ident: $name:ident),* $(,)?) => {
        /// Names the passes.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Pass { $($name),* }

        impl Pass {
            pub const ALL: &'static [Pass] = &[$(Pass::$name),*];
            /// File stem, pipeline label, name in timings.
            pub fn name(self) -> &'static str {
                match self { $(Pass::$name => stringify!($word)),* }
            }
            /// What it tells of itself.
            pub fn declaration(self) -> &'static Declaration {
                match self { $(Pass::$name => &$word::PASS),* }
            }
            /// The shader twin's source, before composition.
            pub fn source(self) -> &'static str {
                match self {
                    $(Pass::$name => include_str!(concat!("../../shaders/pass/", stringify!($word), ".wgsl"))),*
                }
            }
        }

        fn run_in<S: Space>(pass: Pass, state: &mut State<S>, stage: Stage) {
            match pass { $(Pass::$name => $word::run(state, stage)),* }
        }
    };
}

/// Compiles the twins here, once for each space: a crate that calls them links to these instead of compiling its own.
macro_rules! spaces {
    ($($name:ident: $space:ty),* $(,)?) => {
        $(fn $name(pass: Pass, state: &mut State<$space>, stage: Stage) {
            run_in(pass, state, stage);
        })*

        impl Pass {
            /// Runs the twin, unless the pass rests.
            pub fn run<S: Space>(self, state: &mut State<S>, stage: Stage) {
                if !self.declaration().runs.now(&state.clock) {
                    return;
                }
                let state: &mut dyn Any = state;
                $(if let Some(state) = state.downcast_mut::<State<$space>>() {
                    return $name(self, state, stage);
                })*
                unreachable!("there is no other space");
            }
        }
    };
}

spaces! {
    line_single: Line<f32>,
    line_double: Line<f64>,
    plane_single: Plane<f32>,
    plane_double: Plane<f64>,
    solid_single: Solid<f32>,
    solid_double: Solid<f64>,
}

passes! {
    bin_cells: BinCells,
    scan_cells: ScanCells,
    fill_cells: FillCells,
    sort_cells: SortCells,
    reorder: Reorder,
    find_neighbors: FindNeighbors,
    sum_density: SumDensity,
    strain_rate: StrainRate,
    stress: Stress,
    stress_rate: StressRate,
    correct_gradient: CorrectGradient,
    specific_stress: SpecificStress,
    force: Force,
    correct_reference: CorrectReference,
    correct_quadratic: CorrectQuadratic,
    deform: Deform,
    bond_force: BondForce,
    bond_friction: BondFriction,
    hourglass_energy: HourglassEnergy,
    shape_function: ShapeFunction,
    keep_gradients: KeepGradients,
    deform_by_shape: DeformByShape,
    evolve_deformation: EvolveDeformation,
    shape_stress: ShapeStress,
    shape_force: ShapeForce,
    find_contacts: FindContacts,
    sum_colour: SumColour,
    contact_force: ContactForce,
    attach_facets: AttachFacets,
    keep_listed: KeepListed,
    find_facet_contacts: FindFacetContacts,
    move_obstacles: MoveObstacles,
    place_facets: PlaceFacets,
    measure_gap: MeasureGap,
    press_facets: PressFacets,
    touch_obstacles: TouchObstacles,
    carry_facets: CarryFacets,
    surface_force: SurfaceForce,
    load_obstacles: LoadObstacles,
    find_surface: FindSurface,
    find_normals: FindNormals,
    push_intruders: PushIntruders,
    zone_force: ZoneForce,
    smooth_velocity: SmoothVelocity,
    filter_velocity: FilterVelocity,
    kick: Kick,
    drift: Drift,
    runge_kutta: RungeKutta,
    begin_load: BeginLoad,
    descend: Descend,
    bound_residual: BoundResidual,
    bound_time_step: BoundTimeStep,
    bound_between: BoundBetween,
}

impl Pass {
    pub fn about(self) -> &'static str {
        self.declaration().about
    }
    pub fn entries(self) -> &'static [Entry] {
        self.declaration().entries
    }
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
