//! How bodies touch: from what is typed to the table of pairs of bodies.

use super::file::{ColourField, ContactTable, File, PairPotential, Zones};
use super::groups::{Group, across};
use super::refuse::Refuse;
use super::{Scene, SceneBody, copies};
use crate::contact::zones::Options;
use crate::contact::{COLOUR_FIELD, Laws, Potential, ZONES, repulsive};
use crate::method::{Formulation, Integrator};
use crate::rows::ContactPair;

fn zones(file: &File) -> Option<&Zones> {
    file.contact.iter().find_map(|contact| contact.zones.as_ref())
}

/// The largest number of neighbours that a particle on the surface has, and the largest that one at a corner has.
pub(super) fn surface_counts(scene: &Scene) -> [u32; 2] {
    let Some(zones) = zones(&scene.file) else { return [0; 2] };
    let most = f64::from(scene.most_supported());
    // A particle whose number of neighbours is exactly the share counts as on the surface; rounding must not exclude it.
    [zones.surface, zones.corner].map(|share| (share * most + 1e-9) as u32)
}

/// The laws that a scene names.
pub(super) fn laws(file: &File) -> Laws {
    let mut potentials: Vec<Potential> = file.contact.iter().filter_map(|c| c.potential.as_ref()).map(|p| p.law).collect();
    potentials.sort_unstable();
    potentials.dedup();
    let colour_field = file.contact.iter().any(|contact| contact.colour_field.is_some());
    let friction = file.contact.iter().any(|contact| contact.zones.as_ref().is_some_and(|zones| zones.friction > 0.0));
    let zones = zones(file).map(|zones| Options { form: zones.form, normals: zones.normals, friction });
    Laws { potentials, colour_field, zones }
}

/// The table of contact between bodies a and b. The names of the bodies and the kernel sums between them have been checked
/// before.
pub(super) fn pairs(
    file: &File,
    bodies: &[SceneBody],
    groups: &[Group],
    refuse: &Refuse,
) -> Result<Vec<Vec<ContactPair<f64>>>, String> {
    let mut table = vec![vec![ContactPair::default(); bodies.len()]; bodies.len()];
    for (k, contact) in file.contact.iter().enumerate() {
        let at = k.to_string();
        let path = ["contact", &at];
        let same = |other: &ContactTable| {
            let [a, b] = &contact.between;
            other.between == contact.between || other.between == [b.clone(), a.clone()]
        };
        refuse.unless(!file.contact[..k].iter().any(same), &path, || {
            format!("two tables [[contact]] are for `{}` and `{}`: name them once", contact.between[0], contact.between[1])
        })?;
        let laws = [contact.potential.is_some(), contact.colour_field.is_some(), contact.zones.is_some()];
        refuse.unless(laws.iter().filter(|named| **named).count() < 2, &path, || {
            "two bodies touch by one law: name only one of potential, colour_field and zones".into()
        })?;
        let across = across(groups, file, contact);
        if laws.contains(&true) {
            let kinds = groups.iter().filter(|group| contact.between.iter().any(|word| group.has(file, word))).map(Group::kind);
            may_touch(file, kinds, &path, refuse)?;
        }
        refuse.unless(!across || contact.zones.is_none(), &path, || {
            "zones belong to bodies of one group: between these, whose formulations differ, name a potential or a colour_field".into()
        })?;
        refuse.unless(!across || contact.colour_field.is_none() || one_kernel(file, groups, contact), &path, || {
            "a colour field is summed by one kernel: these bodies need the same formulation.smoothing".into()
        })?;
        for (a, b) in copies::pairs(bodies, &contact.between) {
            let Some(pair) = pair_of(file, bodies, contact, (&at, [&bodies[a], &bodies[b]]), refuse)? else { continue };
            let of_a = groups.iter().find(|group| group.bodies.contains(&a));
            let lagrangian = of_a.is_some_and(|group| group.kind() == Formulation::TotalLagrangian);
            refuse.unless(lagrangian || a != b, &path, || {
                "a body touches itself through the kernel already: self-contact needs formulation.kind `total_lagrangian`".into()
            })?;
            refuse.unless(lagrangian || across || contact.kernel == Some(0.0), &path, || {
                "in the Eulerian formulation a law of contact takes the kernel's place: name kernel = 0 beside it".into()
            })?;
            let free = table[a][b].range == 0.0;
            refuse.unless(free, &path, || {
                format!("another [[contact]] has a law for the bodies `{}` and `{}` already", bodies[a].name, bodies[b].name)
            })?;
            (table[a][b], table[b][a]) = (pair, pair);
        }
    }
    Ok(table)
}

/// Whether the bodies of a contact have the same kernel, as all others between groups that touch by the colour field.
fn one_kernel(file: &File, groups: &[Group], contact: &ContactTable) -> bool {
    let named = file.contact.iter().filter(|other| other.colour_field.is_some() && across(groups, file, other));
    let words = named.chain([contact]).flat_map(|contact| &contact.between);
    let mut kernels =
        words.filter_map(|word| groups.iter().find(|group| group.has(file, word))).map(|group| group.formulation.smoothing);
    let first = kernels.next();
    kernels.all(|kernel| Some(kernel) == first)
}

/// The row of the table of pairs for two bodies whose contact names a law.
fn pair_of(
    file: &File,
    bodies: &[SceneBody],
    contact: &ContactTable,
    (at, both): (&str, [&SceneBody; 2]),
    refuse: &Refuse,
) -> Result<Option<ContactPair<f64>>, String> {
    if let Some(potential) = &contact.potential {
        return by_potential(file, both, potential, &["contact", at, "potential"], refuse).map(Some);
    }
    if let Some(field) = &contact.colour_field {
        return by_colour_field(file, bodies, both, field, &["contact", at, "colour_field"], refuse).map(Some);
    }
    contact.zones.as_ref().map(|zones| by_zones(file, both, zones, &["contact", at, "zones"], refuse)).transpose()
}

/// Refuses a scene that no law of contact works in.
fn may_touch(file: &File, mut kinds: impl Iterator<Item = Formulation>, path: &[&str], refuse: &Refuse) -> Result<(), String> {
    refuse.unless(kinds.all(|kind| kind != Formulation::CorrectedKernel), path, || {
        "a law of contact needs formulation.kind `total_lagrangian` or `eulerian`".into()
    })?;
    refuse.unless(file.symmetry.is_empty(), path, || {
        "contact does not see mirror images: a scene with a law of contact takes no [[symmetry]]".into()
    })
}

fn positive(numbers: &[(&str, f64)], path: &[&str], refuse: &Refuse) -> Result<(), String> {
    for (key, value) in numbers {
        let path: Vec<&str> = path.iter().copied().chain([*key]).collect();
        refuse.unless(*value > 0.0 && value.is_finite(), &path, || format!("{key} must be a positive number, found {value}"))?;
    }
    Ok(())
}

/// Mean spacing of two bodies, and the lower of their moduli.
fn scales([a, b]: [&SceneBody; 2]) -> (f64, f64) {
    (0.5 * (a.spacing + b.spacing), a.material.contact_modulus().min(b.material.contact_modulus()))
}

fn by_potential(
    file: &File,
    bodies: [&SceneBody; 2],
    typed: &PairPotential,
    path: &[&str],
    refuse: &Refuse,
) -> Result<ContactPair<f64>, String> {
    positive(&[("stiffness", typed.stiffness), ("range", typed.range)], path, refuse)?;
    let strands = typed.law == Potential::Repulsive;
    refuse.unless(strands || typed.exponent.is_none(), path, || "exponent belongs to the law `repulsive`".into())?;
    let exponent = typed.exponent.unwrap_or(repulsive::EXPONENT);
    refuse.unless((1..=16).contains(&exponent), path, || format!("exponent must lie between 1 and 16, found {exponent}"))?;
    let (spacing, modulus) = scales(bodies);
    let (volume, range) = (spacing.powi(file.dimension as i32), typed.range * spacing);
    let scale = if strands { repulsive::strength(volume, range, exponent, file.dimension) } else { volume };
    let strength = typed.stiffness * modulus * scale;
    Ok(ContactPair { law: typed.law as u32, exponent, strength, range, ..ContactPair::default() })
}

/// The colour of all bodies touched adds up, so all such contacts have one stiffness and one threshold.
fn by_colour_field(
    file: &File,
    bodies: &[SceneBody],
    both: [&SceneBody; 2],
    typed: &ColourField,
    path: &[&str],
    refuse: &Refuse,
) -> Result<ContactPair<f64>, String> {
    positive(&[("stiffness", typed.stiffness), ("range", typed.range)], path, refuse)?;
    refuse.unless((0.0..1.0).contains(&typed.threshold), path, || {
        format!("threshold must lie between 0 and 1, found {}", typed.threshold)
    })?;
    let alike = file.contact.iter().filter_map(|contact| contact.colour_field.as_ref()).all(|other| other == typed);
    refuse.unless(alike, path, || "all contacts by the colour field share one stiffness, threshold and range".into())?;
    let modulus = bodies.iter().map(|body| body.material.contact_modulus()).fold(f64::INFINITY, f64::min);
    let range = typed.range * scales(both).0;
    let (strength, threshold) = (typed.stiffness * modulus, typed.threshold);
    Ok(ContactPair { law: COLOUR_FIELD, strength, range, threshold, ..ContactPair::default() })
}

/// A body has one surface and one set of normals, whatever it touches. All zones of a scene must therefore have the same
/// options.
fn by_zones(
    file: &File,
    both: [&SceneBody; 2],
    typed: &Zones,
    path: &[&str],
    refuse: &Refuse,
) -> Result<ContactPair<f64>, String> {
    positive(&[("stiffness", typed.stiffness), ("radius", typed.radius)], path, refuse)?;
    let ordered = 0.0 <= typed.corner && typed.corner <= typed.surface && typed.surface <= 1.0;
    refuse.unless(ordered, path, || {
        format!("0 <= corner <= surface <= 1 must hold, found {} and {}", typed.corner, typed.surface)
    })?;
    refuse.unless(typed.friction >= 0.0 && typed.friction.is_finite(), path, || {
        format!("friction must be 0 or a positive number, found {}", typed.friction)
    })?;
    let moves = file.time.integrator != Integrator::Pefrl && file.quasi_static.is_none();
    refuse.unless(typed.friction == 0.0 || moves, path, || {
        "friction needs velocities: neither integrator pefrl nor [quasi_static]".into()
    })?;
    let options = |zones: &Zones| (zones.form, zones.normals, zones.surface, zones.corner);
    let alike = file.contact.iter().filter_map(|contact| contact.zones.as_ref()).all(|other| options(other) == options(typed));
    refuse.unless(alike, path, || "all zones of a scene share form, normals, surface and corner".into())?;
    let (spacing, modulus) = scales(both);
    let strength = typed.stiffness * modulus * spacing.powi(file.dimension as i32 - 1);
    let (range, friction) = (typed.radius * spacing, typed.friction);
    Ok(ContactPair { law: ZONES, strength, range, friction, ..ContactPair::default() })
}
