//! The same scene, cheaper: coarser, with a smaller support, shorter, in fewer load steps, with a body less.

use super::named::{stores, without_fields};
use super::piece::{Piece, Sort, without, without_observables};
use super::plane;
use crate::fields::{Field, Set};
use crate::output::csv::shortest;
use crate::scene::Scene;
use crate::scene::file::{BodyTable, File};
use crate::scene::packing::Packing;
use crate::scene::shape::Shape;

/// A coarser spacing is this much larger, or as near to it as whole numbers of spacings across the bodies allow.
const COARSER: f64 = 1.5;
/// Range in which such a factor is sought.
const FACTORS: [f64; 2] = [1.2, 2.2];
/// Part of the smoothing length that is left, and the smallest number of spacings that it may come to.
const NARROWER: f64 = 0.85;
const LEAST_SMOOTHING_LENGTH: f64 = 1.0;
/// Part of a spacing by which places on a lattice may differ.
const PLACE: f64 = 1e-4;

/// Every reduction; `typed` is the file before copies of bodies are made.
pub fn pieces(scene: &Scene, typed: &File) -> Vec<Piece> {
    let mut list = vec![coarser(typed), plane::piece(scene, typed)];
    list.extend(narrower(typed));
    list.push(shorter(typed));
    if typed.body.len() > 1 {
        list.extend(typed.body.iter().map(|body| dropped(scene, typed, body)));
    }
    list
}

fn reduction(name: impl Into<String>, overrides: Vec<String>) -> Piece {
    Piece::new(name, Sort::Reduced, overrides)
}

/// The number with six digits, for names and overrides.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

fn coarser(file: &File) -> Piece {
    let Some(factor) = factor(file) else {
        let reason = "no coarser lattice has whole numbers of spacings across its blocks";
        return Piece::refused("coarser spacing", Sort::Reduced, reason);
    };
    let spacing = file.spacing * factor;
    let mut overrides = vec![format!("spacing={}", shortest(spacing))];
    for body in &file.body {
        if let Some(own) = body.spacing {
            overrides.push(format!("body.{}.spacing={}", body.name, shortest(own * factor)));
        }
        if let Some(anchor) = moved_anchor(file, body, factor) {
            overrides.push(format!("body.{}.anchor={anchor:?}", body.name));
        }
    }
    reduction(format!("spacing {} instead of {}", rounded(spacing), rounded(file.spacing)), overrides)
}

/// Corners of a body that is a block packed on a square lattice, and so shows where that lattice lies.
fn block(file: &File, body: &BodyTable) -> Option<(Vec<f64>, Vec<f64>, f64)> {
    let Shape::Block { min, max } = &body.shape else { return None };
    let axes = |corner: &crate::scene::shape::Coordinates| corner.vector().to_array()[..file.dimension].to_vec();
    let square = body.packing() == Packing::Square;
    square.then(|| (axes(min), axes(max), body.spacing.unwrap_or(file.spacing)))
}

/// The factor nearest to [`COARSER`] by which every block keeps a whole number of spacings along each side, and where no
/// anchor is typed, so that the lattice is centred in it, the point in its middle or the lack of one. Any other shape is content with any factor.
fn factor(file: &File) -> Option<f64> {
    let blocks: Vec<_> = file.body.iter().filter_map(|body| Some((body, block(file, body)?))).collect();
    let sides = |low: &[f64], high: &[f64]| low.iter().zip(high).map(|(low, high)| high - low).collect::<Vec<f64>>();
    let Some((_, (low, high, spacing))) = blocks.first() else { return Some(COARSER) };
    let most = (sides(low, high).into_iter().fold(0.0, f64::max) / spacing).round();
    let fits = |factor: f64| {
        blocks.iter().all(|(body, (low, high, spacing))| {
            // A side that is no whole number of spacings now need not become one.
            let whole = |side: f64| !kept(0.0, side / spacing) || kept(side / spacing, side / (spacing * factor));
            let half = |side: &f64| kept(side / 2.0 / spacing, side / 2.0 / (spacing * factor));
            let sides = sides(low, high);
            (body.anchor.is_some() || sides.iter().all(half)) && sides.into_iter().all(whole)
        })
    };
    let factors = (1..most as u64).map(|fewer| most / fewer as f64);
    let allowed = factors.filter(|&factor| (FACTORS[0]..=FACTORS[1]).contains(&factor) && fits(factor));
    allowed.min_by(|a, b| (a - COARSER).abs().total_cmp(&(b - COARSER).abs()))
}

/// Whether two places lie alike between the points of their lattices.
fn kept(before: f64, after: f64) -> bool {
    let off = (before - after) - (before - after).round();
    off.abs() < PLACE
}

/// The typed anchor, as far from the corner of its block, or from the origin, in spacings as before.
fn moved_anchor(file: &File, body: &BodyTable, factor: f64) -> Option<Vec<f64>> {
    let anchor = body.anchor.as_ref()?.vector().to_array();
    let corner = block(file, body).map_or_else(|| vec![0.0; file.dimension], |(low, ..)| low);
    let spacing = body.spacing.unwrap_or(file.spacing);
    // The nearest point of the lattice to the corner, so that rounding does not grow with the distance.
    let offset = |axis: usize| {
        let steps = (anchor[axis] - corner[axis]) / spacing;
        steps - (steps + PLACE).floor()
    };
    let moved = |axis: usize| tidy(corner[axis] + offset(axis) * spacing * factor, spacing);
    let moved: Vec<f64> = (0..file.dimension).map(moved).collect();
    (moved != anchor[..file.dimension]).then_some(moved)
}

/// Without the last digits, which rounding has made.
fn tidy(value: f64, spacing: f64) -> f64 {
    let digits = (12.0 - spacing.log10().floor()).clamp(0.0, 300.0) as usize;
    format!("{value:.digits$}").parse().unwrap_or(value)
}

fn narrower(file: &File) -> Option<Piece> {
    let h = file.formulation.smoothing_length;
    let narrow = (100.0 * NARROWER * h).round() / 100.0;
    let name = format!("smoothing length {narrow} instead of {h} spacings");
    (narrow >= LEAST_SMOOTHING_LENGTH).then(|| reduction(name, vec![format!("formulation.smoothing_length={narrow}")]))
}

/// As long as the latest window of an observable that something is expected of, else half as long; half the load steps
/// where equilibrium is sought.
fn shorter(file: &File) -> Piece {
    if let Some(typed) = &file.quasi_static {
        let (many, few) = (typed.load_steps, typed.load_steps.div_ceil(2));
        if few == many {
            return Piece::refused("fewer load steps", Sort::Reduced, "it has one load step");
        }
        return reduction(format!("{few} load steps instead of {many}"), vec![format!("quasi_static.load_steps={few}")]);
    }
    let windows = file.expect.keys().filter_map(|name| file.observe.get(name)?.between);
    let latest = windows.map(|[_, end]| end).fold(0.0, f64::max);
    let half = 0.5 * file.duration;
    let duration = if latest > half && latest < 0.95 * file.duration { latest } else { half };
    let rows = file.output.series.unwrap_or(file.duration / 100.0);
    let name = format!("duration {} instead of {}", rounded(duration), rounded(file.duration));
    let overrides = vec![format!("duration={}", shortest(duration)), format!("output.series={}", shortest(rows))];
    Piece { ends: Some(duration), ..reduction(name, overrides) }
}

/// Without a body, what touches it, what holds it and what is observed of it.
fn dropped(scene: &Scene, file: &File, body: &BodyTable) -> Piece {
    let name = &body.name;
    let mut overrides = vec![without(&format!("body.{name}"))];
    let listed = |list: &str, k: usize| without(&format!("{list}.{k}"));
    let touching = file.contact.iter().enumerate().filter(|(_, contact)| contact.between.contains(name));
    overrides.extend(touching.map(|(k, _)| listed("contact", k)));
    let holding = file.boundary.iter().enumerate().filter(|(_, boundary)| boundary.select.body.as_ref() == Some(name));
    overrides.extend(holding.map(|(k, _)| listed("boundary", k)));
    for obstacle in &file.obstacle {
        if let Some(against) = obstacle.against.as_ref().filter(|against| against.contains(name)) {
            let rest: Vec<&String> = against.iter().filter(|other| *other != name).collect();
            let path = format!("obstacle.{}", obstacle.name);
            overrides.push(if rest.is_empty() { without(&path) } else { format!("{path}.against={rest:?}") });
        }
    }
    overrides.extend(without_observables(file, |typed| typed.body.as_ref() == Some(name)));
    let left = file.contact.iter().filter(|contact| !contact.between.contains(name)).map(stores).sum::<usize>();
    if left == 0 && file.obstacle.is_empty() {
        let facets = Field::ALL.iter().copied().filter(|field| field.set() == Set::Facet);
        overrides.extend(without_fields(scene, file, &facets.chain([Field::ContactEnergy]).collect::<Vec<Field>>()));
    }
    let remembers = |body: &BodyTable| file.material.get(&body.material).is_some_and(|material| material.has_memory());
    if !file.body.iter().any(|other| other.name != *name && remembers(other)) {
        overrides.extend(without_fields(scene, file, &[Field::InelasticStrain, Field::EquivalentPlasticStrain]));
    }
    reduction(format!("body `{name}`"), overrides)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(block: &str, spacing: f64) -> File {
        let text = format!(
            "title = \"a\"\ndimension = 2\nspacing = {spacing:?}\nduration = 1\n[[body]]\nname = \"b\"\nmaterial = \"m\"\n{block}\n\
             [material.m]\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.3\n"
        );
        Scene::parse(&text, "a", None, &[]).unwrap().file
    }

    /// The block stays filled from face to face, with an odd number where the lattice has a point in its middle.
    #[test]
    fn a_coarser_lattice_fills_the_same_block() {
        let around = file("shape = { block = { min = [-0.5, -0.5], max = [0.5, 0.5] } }", 1.0 / 21.0);
        assert_eq!(coarser(&around).overrides, [format!("spacing={}", 1.0 / 21.0 * 1.4)]);
        let anchored = file("shape = { block = { min = [2, 0], max = [3, 0.4] } }\nanchor = [2.05, 0.05]", 0.1);
        let piece = coarser(&anchored);
        assert_eq!(piece.overrides[0], "spacing=0.2");
        assert_eq!(piece.overrides[1], "body.b.anchor=[2.1, 0.1]");
        let odd = file("shape = { block = { min = [0, 0], max = [0.3, 0.1] } }\nanchor = [0.05, 0.05]", 0.1);
        assert!(coarser(&odd).refused.is_some());
    }

    #[test]
    fn a_disc_takes_any_spacing() {
        let disc = file("shape = { disc = { center = [0, 0], radius = 3 } }", 0.5);
        assert_eq!(coarser(&disc).overrides, ["spacing=0.75"]);
    }
}
