//! Numbers that a run is judged by: host only, f64, from one moment of the state.
//!
//! A **series** kind gives a number at every row of `series.csv`; a **result** kind is found from a finished
//! series; a profile is a table taken at the end. Adding one is a file and a line in the list below.

mod deformation;
mod energy;
mod force;
mod indentation;
mod kind;
mod moment;
mod momentum;
mod neighborhood;
mod obstacle;
mod oscillation;
mod point;
mod power_law;
mod probe;
mod profile;
mod result;
mod rotation;
mod table;
mod trace;
mod zone;

pub use energy::Energies;
pub use kind::{ObservableKind, Observer, Value};
pub use moment::{Moment, fields_of_path};
pub use profile::profile;
pub use table::Table;
pub use trace::trace;

use crate::fields::Field;
use crate::scene::Scene;
use crate::scene::file::{Observe, Scale, Statement};
use crate::scene::read::{hint, nearest};

/// Every kind, in the order that `lithosph list` prints.
pub static KINDS: &[ObservableKind] = &[
    energy::KINETIC,
    energy::ELASTIC,
    energy::INTERNAL,
    energy::DISSIPATED,
    energy::HOURGLASS,
    energy::CONTACT,
    energy::TOTAL,
    energy::SPEED,
    momentum::LINEAR,
    momentum::ANGULAR,
    momentum::VELOCITY,
    momentum::POSITION,
    rotation::ANGLE,
    force::FORCE,
    obstacle::FORCE,
    obstacle::DISPLACEMENT,
    obstacle::VELOCITY,
    obstacle::AREA,
    probe::PROBE,
    point::POINT,
    probe::MEAN,
    probe::LARGEST,
    probe::SMALLEST,
    zone::ZONE,
    neighborhood::PIECES,
    neighborhood::DISTANCE,
    neighborhood::DISORDER,
    result::RESTITUTION,
    result::CONTACT_TIME,
    result::GROWTH_RATE,
    result::SLOPE,
    result::RATIO_OF_MEANS,
    result::RATIO,
    result::RMS,
    result::SOUTHWELL,
    indentation::UNLOADING_STIFFNESS,
    indentation::CONTACT_DEPTH,
    indentation::HARDNESS,
    indentation::REDUCED_MODULUS,
    indentation::WORK,
    indentation::VALUE_AT,
    oscillation::PERIOD,
    oscillation::FREQUENCY,
    oscillation::SWING_PERIOD,
    oscillation::MIDDLE,
    oscillation::AMPLITUDE,
    trace::TRACE,
    profile::PROFILE,
];

/// Word of an axis as an index; "magnitude" and none give None.
fn axis_index(word: Option<&str>) -> Option<usize> {
    word.and_then(|w| ["x", "y", "z"].iter().position(|a| *a == w))
}

/// Whether a kind follows the particle that starts nearest to its point. Others measure from a place, which may be empty.
fn follows(kind: &ObservableKind, typed: &Observe) -> bool {
    kind.word != zone::ZONE.word && !(kind.word == probe::PROBE.word && typed.interpolate)
}

/// Resolves the scene's observables.
pub fn observers(scene: &Scene) -> Vec<Observer> {
    let resolve = |(name, typed): (&String, &Observe)| {
        let kind = KINDS.iter().find(|kind| kind.word == typed.kind)?;
        let (body, inside) = (typed.body.as_deref(), typed.inside.as_ref());
        let particles = match &typed.at {
            // A point outside was refused before the run: see [`check`].
            Some(at) if follows(kind, typed) => scene.nearest(at.vector(), body, inside).into_iter().collect(),
            _ => scene.select(body, inside),
        };
        Some(Observer { name: name.clone(), typed: typed.clone(), kind, particles, axis: axis_index(typed.axis.as_deref()) })
    };
    scene.file.observe.iter().filter_map(resolve).collect()
}

/// Refuses observables and expectations that the scene cannot give.
pub fn check(scene: &Scene, refuse: impl Fn(&[&str], String) -> String) -> Result<(), String> {
    let output = &scene.file.output;
    let pictured = moment::check_path(scene, &output.picture.field);
    pictured.map_err(|message| refuse(&["output", "picture", "field"], format!("the picture {message}")))?;
    for name in &output.fields {
        moment::check_quantity(scene, name).map_err(|message| refuse(&["output", "fields"], format!("output {message}")))?;
    }
    for (name, typed) in &scene.file.observe {
        if !name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-') {
            let message = format!("observable `{name}` names a column: letters, digits, _ and - only");
            return Err(refuse(&["observe", name], message));
        }
        check_one(scene, name, typed).map_err(|message| refuse(&["observe", name], format!("observable `{name}` {message}")))?;
    }
    for (name, expect) in &scene.file.expect {
        let message = check_expect(scene, name, expect);
        message.map_err(|message| refuse(&["expect", name], format!("expectation `{name}` {message}")))?;
    }
    Ok(())
}

fn check_one(scene: &Scene, name: &str, typed: &Observe) -> Result<(), String> {
    let Some(kind) = KINDS.iter().find(|kind| kind.word == typed.kind) else {
        let near = nearest(&typed.kind, KINDS.iter().map(|k| k.word)).map(|word| format!(", did you mean `{word}`?"));
        let hint = near.unwrap_or_else(|| "; `lithosph list` names them all".to_string());
        return Err(format!("is of the unknown kind `{}`{hint}", typed.kind));
    };
    for key in kind.needs {
        let given = match *key {
            "field" => typed.field.is_some(),
            "axis" => typed.axis.is_some(),
            "of" => typed.of.is_some(),
            "over" => typed.over.is_some(),
            "between" => typed.between.is_some(),
            "at" => typed.at.is_some(),
            "level" => typed.level.is_some(),
            "radius|section" => typed.radius.is_some() != typed.section.is_some(),
            "obstacle" => typed.obstacle.is_some(),
            _ => true,
        };
        if !given {
            let (key, both) = (key.replace('|', "` or `"), if key.contains('|') { ", not both" } else { "" });
            return Err(format!("is a {}: it needs the key `{key}`{both}", kind.word));
        }
    }
    for other in [&typed.of, &typed.over].into_iter().flatten() {
        if other == name || !scene.file.observe.contains_key(other) {
            let others: Vec<&str> = scene.file.observe.keys().map(String::as_str).filter(|word| *word != name).collect();
            return Err(format!("is found from `{other}`, which is no other observable{}", hint(other, &others)));
        }
    }
    if let Some(word) = &typed.axis
        && !["x", "y", "z", "magnitude"].contains(&word.as_str())
    {
        return Err(format!("has the axis `{word}`; expected x, y, z or magnitude"));
    }
    if let Some(body) = &typed.body
        && scene.body_index(body).is_none()
    {
        let bodies: Vec<&str> = scene.bodies.iter().map(|b| b.name.as_str()).collect();
        return Err(format!("is taken over `{body}`, which is no body{}", hint(body, &bodies)));
    }
    if let Some(word) = &typed.obstacle
        && !scene.obstacles.iter().any(|obstacle| &obstacle.name == word)
    {
        let names: Vec<&str> = scene.obstacles.iter().map(|obstacle| obstacle.name.as_str()).collect();
        return Err(format!("belongs to `{word}`, which is no obstacle{}", hint(word, &names)));
    }
    let selected = scene.select(typed.body.as_deref(), typed.inside.as_ref());
    if selected.is_empty() {
        return Err(scene.selects_none(typed.body.as_deref(), typed.inside.as_ref()));
    }
    if let Some(at) = typed.at.as_ref().filter(|_| follows(kind, typed)) {
        scene.nearest(at.vector(), typed.body.as_deref(), typed.inside.as_ref())?;
    }
    check_numbers(typed)?;
    moment::check_fields(scene, kind.fields, &selected)?;
    if let Some(path) = &typed.field {
        moment::check_path(scene, path)?;
        // What is read at a place may belong to any body; elsewhere to those selected.
        let read: &[usize] = if typed.at.is_some() { &[] } else { &selected };
        moment::check_fields(scene, moment::fields_of(path)?, read)?;
    }
    Ok(())
}

/// What an indentation is read by.
fn check_numbers(typed: &Observe) -> Result<(), String> {
    for (key, number) in [("radius", typed.radius), ("section", typed.section), ("beta", typed.beta)] {
        if let Some(number) = number
            && !(number.is_finite() && number > 0.0)
        {
            return Err(format!("has the {key} {number}; expected a number above 0"));
        }
    }
    match typed.shares {
        Some([a, b]) if a == b || [a, b].iter().any(|share| !(0.0..=1.0).contains(share)) => {
            Err(format!("has the shares {a} and {b}; expected two different ones from 0 to 1"))
        }
        _ => Ok(()),
    }
}

fn check_expect(scene: &Scene, name: &str, expect: &crate::scene::file::Expect) -> Result<(), String> {
    if !scene.file.observe.contains_key(name) {
        return Err(format!(
            "names no observable{}",
            hint(name, &scene.file.observe.keys().map(String::as_str).collect::<Vec<_>>())
        ));
    }
    if expect.source.is_empty() {
        return Err("needs a source: where does the number come from?".into());
    }
    check_statement(expect)?;
    check_columns(&scene.file.observe[name].kind, expect)?;
    if let Some(variant) = &expect.variant
        && !scene.file.variant.contains_key(variant)
        && variant != "none"
    {
        let variants: Vec<&str> = scene.file.variant.keys().map(String::as_str).collect();
        return Err(format!("holds for `{variant}`, which is no variant{}", hint(variant, &variants)));
    }
    Ok(())
}

/// Whether an expectation names what its kind needs, and nothing else.
fn check_statement(expect: &crate::scene::file::Expect) -> Result<(), String> {
    let (truth, pinned) = (expect.kind == Statement::Truth, expect.kind == Statement::Pinned);
    let forms = [expect.value.is_some(), expect.reference.is_some(), expect.between.is_some()];
    let wanted = match forms.iter().filter(|&&form| form).count() {
        1 if pinned => Some("is pinned because no truth is at hand: it takes neither value, reference nor between"),
        1 if expect.between.is_some() && !truth => Some("gives a range of the truth, which only `kind = \"truth\"` takes"),
        0 if pinned => None,
        1 => None,
        0 if !truth => Some("states an error: it needs the truth, a value or a reference"),
        _ => Some("needs exactly one of value, reference and between"),
    };
    let seen = match (truth, expect.seen) {
        (true, Some(_)) => Some("names what is seen: it needs `kind`, \"failure\", \"shortfall\" or \"pinned\""),
        (false, None) => Some("needs `seen`, the number that comes out"),
        _ if !truth && expect.because.is_none() => Some("needs `because`: why does another number than the truth come out?"),
        _ => None,
    };
    let tolerance = match (expect.between.is_some(), expect.tolerance) {
        (false, None) => Some("needs a tolerance"),
        (true, Some(_)) => Some("takes a tolerance or the range of its source, not both"),
        _ if !truth && expect.reference.is_none() && expect.unit().is_none() => {
            Some("is relative to the value 0: it needs a scale")
        }
        _ => None,
    };
    let scale = match expect.scale {
        Some(Scale::Number(scale)) if !(scale.is_finite() && scale > 0.0) => Some("needs a scale above 0"),
        Some(Scale::Word(_)) if expect.reference.is_none() => Some("has no curve: its scale must be a number"),
        _ => None,
    };
    [wanted, seen, tolerance, scale].into_iter().flatten().next().map_or(Ok(()), |complaint| Err(complaint.into()))
}

fn check_columns(kind: &str, expect: &crate::scene::file::Expect) -> Result<(), String> {
    let traces = kind == trace::TRACE.word;
    let count = if traces { 3 } else { 2 };
    if expect.reference.is_some() && expect.columns.as_ref().is_none_or(|columns| columns.len() != count) {
        return Err(format!("needs the {count} columns of its reference"));
    }
    if traces && expect.reference.is_none() {
        return Err("is of a trace, which only a reference can judge".into());
    }
    Ok(())
}

/// Fields that the host must see at every row of the series.
pub fn fields_read(observers: &[Observer], scene: &Scene) -> Vec<Field> {
    let mut list = vec![Field::Number];
    for observer in observers {
        list.extend(moment::read(scene, observer.kind.fields));
        if observer.kind.word == obstacle::AREA.word && observer.typed.obstacle.is_some() {
            list.push(Field::FacetObstacle);
        }
        if let Some(path) = &observer.typed.field {
            list.extend(moment::fields_of_path(scene, path));
        }
    }
    list.sort_unstable();
    list.dedup();
    list
}
