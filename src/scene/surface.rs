//! How the surface of a body lies that touches others: packed to its shape unless the scene says otherwise, and what is said of
//! one whose particles stand in steps.

use super::copies::{named, pairs};
use super::facets::facets;
use super::file::{BodyTable, ContactTable, File, ObstacleShape, ObstacleTable};
use super::packing::Packing;
use super::refuse::Refuse;
use super::shape::Shape;
use super::{Scene, SceneBody};
use crate::method::Formulation;
use glam::DVec3;

/// Part of a surface that may lie across the lattice before its steps are told.
const STEPPED: f64 = 0.05;

/// Largest angle between a surface and the rows of a lattice, in radians, that makes no step within some twenty spacings.
const LEVEL: f64 = 0.05;

impl ContactTable {
    /// Some law keeps the surfaces of the two apart. Zones find the surface by counting neighbours, which only a lattice has alike.
    fn meets_surfaces(&self) -> bool {
        self.potential.is_some() || self.colour_field.is_some() || self.gap.is_some()
    }

    /// The two touch from particle to particle, so that what is their surface is where the particles are.
    fn meets_particles(&self) -> bool {
        self.potential.is_some() || self.colour_field.is_some()
    }
}

impl BodyTable {
    /// How the body's particles lie.
    pub fn packing(&self) -> Packing {
        self.packing.unwrap_or_default()
    }
}

impl File {
    /// Fits to its shape each Total Lagrangian body that touches another and names neither packing nor anchor. On a lattice a round
    /// surface stands in steps: its outermost rows are flat, meet all at once and throw back another part of the energy, however
    /// fine the lattice is. A shape that a lattice fills to its faces is packed alike either way.
    pub(super) fn settle_packings(&mut self) {
        let File { body, contact, obstacle, formulation, formulations, spacing, dimension, .. } = self;
        let free = |body: &&mut BodyTable| body.packing.is_none() && body.anchor.is_none();
        for body in body.iter_mut().filter(free) {
            if filled(&body.shape, body.spacing.unwrap_or(*spacing), *dimension) {
                continue;
            }
            let own = body.formulation.as_ref().map_or(Some(&*formulation), |name| formulations.get(name));
            let lagrangian = own.is_some_and(|own| own.kind == Formulation::TotalLagrangian);
            let contacts = contact.iter().filter(|contact| contact.meets_surfaces());
            let touches = contacts.flat_map(|contact| &contact.between).any(|name| *name == body.name);
            let against =
                obstacle.iter().any(|obstacle| obstacle.against.as_ref().is_none_or(|names| names.contains(&body.name)));
            if lagrangian && (touches || against) {
                body.packing = Some(Packing::Fitted);
            }
        }
    }
}

/// Whether a shape is a block of whole cells of a lattice.
fn filled(shape: &Shape, spacing: f64, dimension: usize) -> bool {
    let Shape::Block { min, max } = shape else { return false };
    let cells = (max.vector() - min.vector()) / spacing;
    (0..dimension).all(|axis| (cells[axis] - cells[axis].round()).abs() < 1e-6)
}

/// Most facets to a spacing that a body may have.
pub(super) const MOST_PIECES: u32 = 8;

/// Facets to a spacing, in each direction, of each body's surface.
pub(super) fn pieces(file: &File, bodies: &[SceneBody]) -> Vec<u32> {
    let mut sharp = edged_obstacles(file, bodies);
    let polygon = |body: usize| matches!(file.body[body].shape, Shape::Polygon { .. });
    for contact in file.contact.iter().filter(|contact| contact.gap.is_some()) {
        for (a, b) in pairs(bodies, &contact.between).into_iter().filter(|&(a, b)| polygon(a) || polygon(b)) {
            (sharp[a], sharp[b]) = (true, true);
        }
    }
    let usual = |sharp: bool| match (sharp, file.dimension) {
        (true, 2) => 4,
        (true, 3) => 2,
        _ => 1,
    };
    file.body.iter().zip(sharp).map(|(typed, sharp)| typed.facets.unwrap_or_else(|| usual(sharp))).collect()
}

/// Facets on a square spacing of a surface, in the plane on a spacing.
pub(super) fn to_a_cell(pieces: u32, dimension: usize) -> f64 {
    f64::from(pieces).powi(dimension as i32 - 1)
}

/// Which bodies a wedge, a cone or a pyramid may press.
fn edged_obstacles(file: &File, bodies: &[SceneBody]) -> Vec<bool> {
    let edged = |typed: &&ObstacleTable| matches!(typed.shape, ObstacleShape::Cone { .. } | ObstacleShape::Berkovich { .. });
    let meets = |typed: &ObstacleTable, body: &SceneBody| {
        typed.against.as_ref().is_none_or(|list| list.iter().any(|word| *word == body.name || *word == body.group))
    };
    bodies.iter().map(|body| file.obstacle.iter().filter(edged).any(|typed| meets(typed, body))).collect()
}

/// Bodies whose particles touch others while they stand in steps where the surface should be, each with its index.
pub(super) fn warnings(scene: &Scene, refuse: &Refuse) -> Vec<String> {
    let contacts = scene.file.contact.iter().enumerate();
    let of = |(k, contact): (usize, &ContactTable)| {
        let found: Vec<usize> = contact.between.iter().flat_map(|word| named(&scene.bodies, word)).collect();
        let mut names: Vec<&str> = found.iter().filter(|&&k| stepped(scene, k)).map(|&k| &*scene.bodies[k].group).collect();
        names.sort_unstable();
        names.dedup();
        if names.is_empty() {
            return None;
        }
        Some(refuse.at(
            &["contact", &k.to_string()],
            format!(
                "the particles of `{}` stand in steps where the surface is round or oblique, and touch there one by one: a rebound \
                 can be a tenth off, also with finer ones; take `packing = \"fitted\"` (without an anchor it is usual where bodies \
                 touch), `rings`, or a `gap`, which sees the surface itself",
                names.join("`, `")
            ),
        ))
    };
    contacts.filter(|(_, contact)| contact.meets_particles()).filter_map(of).collect()
}

/// Whether the lattice of a body runs across a part of its surface.
fn stepped(scene: &Scene, k: usize) -> bool {
    let (typed, body, dimension) = (&scene.file.body[k], &scene.bodies[k], scene.file.dimension);
    let hexagonal = match typed.packing() {
        Packing::Square => false,
        Packing::Hexagonal => true,
        Packing::Rings | Packing::Fitted => return false,
    };
    if dimension == 1 {
        return false;
    }
    let surface = facets(&typed.shape, body.spacing, typed.lattice_anchor(body.spacing, dimension), dimension);
    // Rows of a hexagonal lattice are straight along x alone; in space its layers are planes of the cube.
    let level = |normal: DVec3| {
        let axes = if hexagonal && dimension == 2 { 1..2 } else { 0..dimension };
        axes.into_iter().any(|axis| normal[axis].abs() > LEVEL.cos())
    };
    let (all, across) = surface
        .iter()
        .fold((0.0, 0.0), |(all, across), facet| (all + facet.area, across + if level(facet.normal) { 0.0 } else { facet.area }));
    across > STEPPED * all
}

#[cfg(test)]
mod tests {
    use super::Packing::{self, Fitted, Hexagonal, Square};
    use crate::scene::Scene;

    /// Two discs, or what `bodies` says in the place of their shapes, under a contact.
    fn scene(bodies: [&str; 2], contact: &str, formulation: &str) -> Scene {
        let text = format!(
            "title = 't'\ndimension = 2\nspacing = 1.0\nduration = 1.0\n\
             [[body]]\nname = 'a'\nmaterial = 'm'\n{}\n[[body]]\nname = 'b'\nmaterial = 'm'\n{}\n\
             [[contact]]\nbetween = ['a', 'b']\n{contact}\n[formulation]\n{formulation}\n\
             [material.m]\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n{}\n",
            bodies[0],
            bodies[1],
            if formulation.contains("eulerian") { "" } else { "law = 'neo_hookean'" }
        );
        Scene::parse(&text, "s", None, &[]).unwrap_or_else(|error| panic!("{error}"))
    }

    fn packings(scene: &Scene) -> Vec<Packing> {
        scene.file.body.iter().map(|body| body.packing()).collect()
    }

    fn steps(scene: &Scene) -> Vec<&String> {
        scene.warnings.iter().filter(|line| line.contains("stand in steps")).collect()
    }

    const DISC: &str = "shape = { disc = { center = [0, 0], radius = 6 } }";
    const OTHER: &str = "shape = { disc = { center = [14, 0], radius = 6 } }";
    const BLOCK: &str = "shape = { block = { min = [8, -4], max = [14, 4] } }";
    const BARRIER: &str = "potential = { law = 'barrier', stiffness = 1.0, range = 1.0 }";

    #[test]
    fn bodies_that_touch_are_fitted_unless_the_scene_says_how_they_lie() {
        for contact in [BARRIER, "gap = {}", "colour_field = { stiffness = 2.0, threshold = 0.1, range = 4.0 }"] {
            assert_eq!(packings(&scene([DISC, OTHER], contact, "")), [Fitted, Fitted], "{contact}");
        }
        let typed = format!("{DISC}\npacking = 'hexagonal'");
        let anchored = format!("{OTHER}\nanchor = [14, 0]");
        assert_eq!(packings(&scene([&typed, &anchored], BARRIER, "")), [Hexagonal, Square]);
        // A lattice fills this one to its faces.
        assert_eq!(packings(&scene([DISC, BLOCK], BARRIER, "")), [Fitted, Square]);
        let eulerian = format!("kernel = 0\n{BARRIER}");
        for (contact, formulation) in [("none = true", ""), ("zones = { radius = 1.0 }", ""), (&eulerian, "kind = 'eulerian'")] {
            assert_eq!(packings(&scene([DISC, OTHER], contact, formulation)), [Square, Square], "{contact} {formulation}");
        }
    }

    #[test]
    fn steps_of_a_round_surface_are_told_where_particles_touch() {
        let lattice = [format!("{DISC}\npacking = 'square'"), format!("{OTHER}\npacking = 'rings'")];
        let lattice = [&*lattice[0], &*lattice[1]];
        let said = scene(lattice, BARRIER, "");
        assert!(steps(&said).len() == 1 && steps(&said)[0].contains("particles of `a` stand"), "{:?}", said.warnings);
        assert!(steps(&scene(lattice, "gap = {}", "")).is_empty());
        assert!(steps(&scene([DISC, OTHER], BARRIER, "")).is_empty());
        // Rows of a hexagonal lattice are straight along x alone.
        let blocks = |packing: &str| {
            let first = format!("shape = {{ block = {{ min = [0, -4], max = [6, 4] }} }}\npacking = '{packing}'");
            steps(&scene([&first, BLOCK], BARRIER, "")).len()
        };
        assert_eq!((blocks("square"), blocks("hexagonal")), (0, 1));
    }
}
