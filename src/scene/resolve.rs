//! From what is typed to particles and numbers; refuses what is impossible or contradictory.

use super::copies::{expand, named, pairs};
use super::corrected_kernel;
use super::file::{ArtificialSpacing, EnergyWatch, File, FormulationTable, Viscosity};
use super::groups::{Group, across, check_parted, groups, of_body};
use super::interval::ROUNDING;
use super::material::Material;
use super::packing::fill;
use super::prescribed::held;
use super::read::{Read, hint};
use super::refuse::{MOST_OUTPUTS, Refuse};
use super::shape::used;
use super::surfaces::Parts;
use super::warn::warnings;
use super::{
    Near, Particle, Plane, Scene, SceneBody, SceneConstraint, contacts, count, plasticity, quasi_static, strangers, ties,
};
use crate::material::Law;
use crate::method::{Configuration, Density, Formulation, Gradient, Integrator, Method};
use crate::rows::BodyOptions;
use glam::DVec3;
use std::sync::OnceLock;

/// A scene from what was read. Whether it can give what it is asked to observe, [`Scene::open`] looks at.
///
/// # Errors
/// One sentence that begins with the place of what is impossible.
pub(crate) fn resolve(name: String, read: Read) -> Result<Scene, String> {
    let Read { mut file, source, variant, resolved_text: text, .. } = read;
    let typed_at = expand(&mut file).map_err(|(k, message)| {
        let refuse = Refuse { source: &source, typed_at: &[], formulation: None };
        refuse.at(&["body", &k.to_string(), "copies"], message)
    })?;
    let refuse = Refuse { source: &source, typed_at: &typed_at, formulation: None };
    numbers(&file, &refuse)?;
    let groups = groups(&file, &refuse)?;
    check_parted(&file, &groups, &refuse)?;
    let bodies = bodies(&file, &groups, &refuse)?;
    if let [only] = &groups[..] {
        // What asks the scene for its formulation means that of its bodies, also where it has a name.
        file.formulation = only.formulation.clone();
    }
    count::check(&file, &bodies, &groups, &refuse)?;
    let mut particles = pack(&file, &bodies, &refuse)?;
    // The particles of a group follow each other. The sort is stable: of one group they keep their order.
    particles.sort_by_key(|particle| groups.iter().position(|group| group.bodies.contains(&(particle.body as usize))));
    let mut constraints = constraints(&file, &bodies, &mut particles, &refuse)?;
    let coupling = coupling(&file, &bodies, &groups, &refuse)?;
    let contacts = contacts::pairs(&file, &bodies, &groups, &refuse)?;
    let planes = planes(&file, &refuse)?;
    let period = period(&file, &bodies, &refuse)?;
    let parts = Parts {
        file: &file,
        bodies: &bodies,
        particles: &particles,
        planes: &planes,
        groups: &groups,
        coupling: &coupling,
        refuse: &refuse,
    };
    let facet_pairs = parts.gaps()?;
    ties::alone(&file, &bodies, &refuse)?;
    let laws = strangers::Laws { coupling: &coupling, contacts: &contacts, gaps: &facet_pairs };
    let apart = strangers::meant_apart(&file, &bodies, &laws, &refuse)?;
    strangers::no_overlap(&file, &bodies, &particles, &apart, &refuse)?;
    let strangers = strangers::strangers(bodies.len(), &laws, &apart);
    let obstacles = parts.obstacles(&mut constraints)?;
    let facets = parts.facets(&facet_pairs, &obstacles)?;
    let mut scene = Scene {
        name,
        variant,
        file,
        text,
        source: source.clone(),
        method: Method::default(),
        parts: Vec::new(),
        first_number: 0,
        part_of: None,
        bodies,
        coupling,
        contacts,
        facet_pairs,
        strangers,
        obstacles,
        facets,
        constraints,
        particles,
        period,
        planes,
        artificial_spacing: 0.0,
        warnings: Vec::new(),
        most_bonds: OnceLock::new(),
    };
    ties::meet(&scene, &refuse)?;
    if let [only] = &groups[..] {
        let named = Refuse { formulation: only.name.as_deref(), ..refuse };
        scene.method = method(&scene, &named)?;
        scene.artificial_spacing = artificial_spacing(&scene.file, &scene.bodies, &scene.particles);
        scene.warnings = warnings(&scene, layered(&scene, &refuse)?, &refuse);
        return Ok(scene);
    }
    several(&scene, &groups, &refuse)?;
    let mut thin = Vec::new();
    for group in &groups {
        let mut part = scene.part(group);
        let typed_at: Vec<usize> = group.bodies.iter().map(|&k| typed_at[k]).collect();
        let refuse = Refuse { source: &source, typed_at: &typed_at, formulation: group.name.as_deref() };
        part.method = method(&part, &refuse)?;
        part.artificial_spacing = artificial_spacing(&part.file, &part.bodies, &part.particles);
        let of_part = layered(&part, &refuse)?.into_iter();
        thin.extend(of_part.map(|(body, sentence)| (group.bodies[body], sentence)));
        scene.parts.push(part);
    }
    scene.method = scene.method_between(&groups);
    scene.leave_to_parts(&groups);
    scene.warnings = warnings(&scene, thin, &refuse);
    Ok(scene)
}

/// Refuses a body of a single layer of particles where its formulation corrects gradients. Those of two are warned of: index of
/// the body and sentence.
fn layered(scene: &Scene, refuse: &Refuse) -> Result<Vec<(usize, String)>, String> {
    let thin = scene.thin_parts();
    match thin.iter().find(|thin| thin.layers < 2) {
        Some(thin) => Err(refuse.at(&["body", &thin.body.to_string(), "shape"], scene.one_layer(thin))),
        None => Ok(thin.iter().map(|thin| (thin.body, scene.two_layers(thin))).collect()),
    }
}

/// Refuses what a scene of several groups cannot have.
fn several(scene: &Scene, groups: &[Group], refuse: &Refuse) -> Result<(), String> {
    refuse.unless(scene.file.quasi_static.is_none(), &["quasi_static"], || {
        "equilibrium is sought for bodies of one formulation, and this scene has several".into()
    })?;
    let carries = |group: &&Group| {
        let bodies = scene.facets.iter().map(|facet| scene.particles[facet.owner as usize].body as usize);
        bodies.into_iter().any(|body| group.bodies.contains(&body))
    };
    refuse.unless(groups.iter().filter(carries).count() < 2, &["contact"], || {
        "gaps and obstacles are for bodies of one formulation, and in this scene those of several have them".into()
    })
}

/// Refuses single numbers that lie outside their range.
fn numbers(file: &File, refuse: &Refuse) -> Result<(), String> {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    refuse.unless((1..=3).contains(&file.dimension), &["dimension"], || {
        format!("dimension must be 1, 2 or 3, found {}", file.dimension)
    })?;
    let one = |value: f64, path: &[&str], what: &str| {
        refuse.unless(positive(value), path, || format!("{what} must be a positive number, found {value}"))
    };
    one(file.spacing, &["spacing"], "spacing")?;
    one(file.duration, &["duration"], "duration")?;
    one(file.time.cfl, &["time", "cfl"], "cfl")?;
    if let Some(step) = file.time.step {
        one(step, &["time", "step"], "step")?;
        refuse.unless(step <= file.duration * (1.0 + ROUNDING), &["time", "step"], || {
            format!(
                "a time.step of {step} is longer than the whole run, whose duration is {}: leave it out, and cfl finds one",
                file.duration
            )
        })?;
    }
    if let Some(drift) = file.watch.energy_drift {
        let path = ["watch", "energy_drift"];
        one(drift, &path, "energy_drift")?;
        refuse.unless(file.watch.energy == EnergyWatch::Stop, &path, || {
            "energy_drift says where a run stops, and watch.energy stops none: give one of the two".into()
        })?;
    }
    let fits = file.body_force.as_ref().is_none_or(|g| g.len() == file.dimension);
    refuse.unless(fits, &["body_force"], || format!("body_force takes {} components", file.dimension))?;
    outputs(file, refuse)?;
    weights(&file.formulation, refuse)?;
    for (name, formulation) in &file.formulations {
        weights(formulation, &Refuse { formulation: Some(name), ..*refuse })?;
    }
    if let Some(course) =
        file.boundary.iter().find(|b| b.course.as_ref().is_some_and(|c| c.windows(2).any(|w| w[1][0] <= w[0][0])))
    {
        let name = course.name.clone().unwrap_or_default();
        return Err(refuse.at(&["boundary"], format!("times of the course of boundary `{name}` must increase")));
    }
    refuse.unless(!file.body.is_empty(), &["body"], || "a scene needs at least one [[body]]".into())
}

/// Refuses intervals and sizes of output that cannot be.
fn outputs(file: &File, refuse: &Refuse) -> Result<(), String> {
    if let Some(series) = file.output.series {
        refuse.unless(series > 0.0 && series.is_finite(), &["output", "series"], || {
            format!("series (time between rows) must be a positive number, found {series}")
        })?;
    }
    for (interval, key) in [(file.output.series, "series"), (file.output.frames, "frames")] {
        let few = interval.is_none_or(|interval| interval == 0.0 || file.duration / interval <= MOST_OUTPUTS);
        refuse.unless(few, &["output", key], || format!("{key} would be written more than {MOST_OUTPUTS:e} times"))?;
    }
    if let Some(frames) = file.output.frames {
        refuse.unless(frames >= 0.0 && frames.is_finite(), &["output", "frames"], || {
            format!("frames (time between pictures) must not be negative, found {frames}")
        })?;
    }
    let picture = &file.output.picture;
    let fits = (160..=8192).contains(&picture.width) && (120..=8192).contains(&picture.height);
    refuse.unless(fits, &["output", "picture"], || {
        format!("a picture has 160 x 120 to 8192 x 8192 pixels, found {} x {}", picture.width, picture.height)
    })
}

/// Weights and coefficients of a formulation.
fn weights(f: &FormulationTable, refuse: &Refuse) -> Result<(), String> {
    let fits = f.smoothing_length > 0.0 && f.smoothing_length.is_finite();
    refuse.unless(fits, &["formulation", "smoothing_length"], || {
        format!("smoothing_length (in spacings) must be a positive number, found {}", f.smoothing_length)
    })?;
    let fits = f.list_margin.is_none_or(|margin| (0.02..=1.0).contains(&margin));
    refuse
        .unless(fits, &["formulation", "list_margin"], || "list_margin must lie between 0.02 and 1 smoothing lengths".into())?;
    refuse.unless(f.list_capacity != Some(0), &["formulation", "list_capacity"], || "list_capacity must not be 0".into())?;
    for (weight, key) in [(f.xsph, "xsph"), (f.velocity_filter, "velocity_filter")] {
        let fits = weight.is_none_or(|w| (0.0..=1.0).contains(&w));
        refuse.unless(fits, &["formulation", key], || format!("{key} must lie between 0 and 1"))?;
    }
    if let Some(v) = &f.viscosity {
        let fits = v.alpha >= 0.0 && v.beta.unwrap_or(0.0) >= 0.0 && v.softening >= 0.0;
        refuse
            .unless(fits, &["formulation", "viscosity"], || "viscosity takes no negative numbers: it would add energy".into())?;
    }
    if let Some(a) = &f.artificial_stress {
        refuse.unless(a.epsilon >= 0.0, &["formulation", "artificial_stress", "epsilon"], || {
            "epsilon must not be negative".into()
        })?;
    }
    Ok(())
}

fn bodies(file: &File, groups: &[Group], refuse: &Refuse) -> Result<Vec<SceneBody>, String> {
    let mut list: Vec<SceneBody> = Vec::new();
    for (k, typed) in file.body.iter().enumerate() {
        let at = k.to_string();
        let path = |key: &'static str| ["body".to_string(), at.clone(), key.to_string()];
        let refuse_at = |key, message: String| {
            let path = path(key);
            refuse.at(&path.each_ref().map(String::as_str), message)
        };
        if list.iter().any(|body| body.name == typed.name) {
            return Err(refuse_at("name", format!("two bodies are named `{}`", typed.name)));
        }
        let Some(material) = file.material.get(&typed.material) else {
            let hint = hint(&typed.material, &file.material.keys().map(String::as_str).collect::<Vec<_>>());
            return Err(refuse_at("material", format!("no [material.{}]{hint}", typed.material)));
        };
        let named = |message| refuse.at(&["material", &typed.material], format!("material `{}` {message}", typed.material));
        let formulation = of_body(file, k).unwrap_or(&file.formulation);
        let material = Material::resolve(material, formulation.kind).map_err(named)?;
        let group = groups.iter().find(|group| group.bodies.contains(&k));
        let yields = group.is_some_and(|group| group.bodies.iter().any(|&other| file.yields(&file.body[other])));
        let relative_volume = typed.relative_volume.unwrap_or(1.0);
        if !(relative_volume > 0.0 && relative_volume.is_finite()) {
            return Err(refuse_at(
                "relative_volume",
                format!("relative_volume must be a positive number, found {relative_volume}"),
            ));
        }
        let deviator = typed.deviatoric_stress.unwrap_or_default();
        let scale = deviator.iter().fold(0.0f64, |m, s| m.max(s.abs()));
        if (deviator[0] + deviator[1] + deviator[2]).abs() > 1e-9 * scale {
            return Err(refuse_at(
                "deviatoric_stress",
                "the first three components of a deviatoric stress must sum to zero".into(),
            ));
        }
        if scale > 0.0 && material.shear_modulus == 0.0 {
            return Err(refuse_at("deviatoric_stress", "a fluid carries no deviatoric stress".into()));
        }
        let spacing = typed.spacing.unwrap_or(file.spacing);
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(refuse_at("spacing", format!("spacing must be a positive number, found {spacing}")));
        }
        list.push(SceneBody {
            name: typed.name.clone(),
            group: typed.group.clone().unwrap_or_else(|| typed.name.clone()),
            spacing,
            smoothing_length: formulation.smoothing_length * spacing,
            material,
            options: options(formulation, yields),
            relative_volume,
            deviator,
        });
    }
    Ok(list)
}

/// Numbers of a body's formulation; 0 for what it does not name. `yields` if some body of its group does.
fn options(f: &FormulationTable, yields: bool) -> BodyOptions<f64> {
    let viscosity = |number: fn(&Viscosity) -> f64| f.viscosity.as_ref().map_or(0.0, number);
    BodyOptions {
        alpha: viscosity(|v| v.alpha),
        beta: viscosity(|v| v.beta.unwrap_or(2.0 * v.alpha)),
        artificial_epsilon: f.artificial_stress.as_ref().map_or(0.0, |a| a.epsilon),
        hourglass: f.hourglass(yields),
    }
}

fn names(bodies: &[SceneBody]) -> Vec<&str> {
    let mut list: Vec<&str> = bodies.iter().map(|body| body.group.as_str()).collect();
    list.dedup();
    list
}

fn pack(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<Vec<Particle>, String> {
    let mut particles = Vec::new();
    for (k, (typed, body)) in file.body.iter().zip(bodies).enumerate() {
        let anchor = typed.lattice_anchor(body.spacing, file.dimension);
        let points = fill(&typed.shape, typed.packing(), body.spacing, anchor, file.dimension)
            .map_err(|message| refuse.at(&["body", &k.to_string(), "shape"], format!("body `{}`: {message}", body.name)))?;
        let center = typed.spin_center.as_ref().map_or(DVec3::ZERO, |c| c.vector());
        let axis = typed.spin_axis.as_ref().map_or(DVec3::Z, |a| a.vector().normalize_or_zero());
        if let Some(motion) = &typed.motion {
            motion.check().map_err(|message| refuse.at(&["body", &k.to_string(), "motion"], message))?;
        }
        let velocity = typed.velocity.as_ref().map_or(DVec3::ZERO, |v| v.vector());
        particles.extend(points.iter().map(|point| {
            let spin = (axis * typed.spin).cross(point.position - center);
            let motion = typed.motion.as_ref().map_or(DVec3::ZERO, |m| m.velocity(point.position));
            Particle {
                body: k as u32,
                constraint: 0,
                position: point.position
                    + used(typed.flaw.as_ref().map_or(DVec3::ZERO, |flaw| flaw.at(point.position)), file.dimension),
                volume: point.volume / body.relative_volume,
                velocity: used(velocity + spin + motion, file.dimension),
            }
        }));
    }
    if let Some(wild) = particles.iter().find(|p: &&Particle| !p.velocity.is_finite()) {
        return Err(refuse.at(&["body", &wild.body.to_string()], "the velocity must be a finite number".to_string()));
    }
    for (k, kick) in file.kick.iter().enumerate() {
        let near = Near { bodies, particles: &particles, dimension: file.dimension };
        let kicked = near.point(kick.at.vector(), |_| true);
        let i = kicked.map_err(|message| refuse.at(&["kick", &k.to_string(), "at"], format!("the kick {message}")))?;
        particles[i].velocity += used(kick.velocity.vector(), file.dimension);
    }
    Ok(particles)
}

fn constraints(
    file: &File,
    bodies: &[SceneBody],
    particles: &mut [Particle],
    refuse: &Refuse,
) -> Result<Vec<SceneConstraint>, String> {
    let mut list = Vec::new();
    for (k, typed) in file.boundary.iter().enumerate() {
        let at = k.to_string();
        let path = ["boundary", &at];
        let name = typed.name.clone().unwrap_or_else(|| format!("boundary {}", k + 1));
        let wanted = typed.select.body.as_ref().map(|word| named(bodies, word));
        if let (Some([]), Some(word)) = (wanted.as_deref(), &typed.select.body) {
            let hint = hint(word, &names(bodies));
            return Err(refuse.at(&path, format!("`{name}` selects no body named `{word}`{hint}")));
        }
        let chosen = |p: &Particle| {
            wanted.as_ref().is_none_or(|list| list.binary_search(&(p.body as usize)).is_ok())
                && typed.select.inside.as_ref().is_none_or(|s| s.contains(p.position, file.dimension))
        };
        let mass: f64 = particles.iter().filter(|p| chosen(p)).map(|p| p.volume * bodies[p.body as usize].material.density).sum();
        if mass == 0.0 {
            let near = Near { bodies, particles, dimension: file.dimension };
            let of_body =
                |i: usize| wanted.as_ref().is_none_or(|list| list.binary_search(&(near.particles[i].body as usize)).is_ok());
            return Err(refuse.at(&path, format!("`{name}` {}", near.none_in(typed.select.inside.as_ref(), of_body))));
        }
        let (prescribed, vector) = held(typed, file.dimension, mass).map_err(|m| refuse.at(&path, format!("`{name}` {m}")))?;
        list.push(SceneConstraint { name, prescribed, vector, course: typed.course.clone().unwrap_or_default() });
        for particle in particles.iter_mut().filter(|p| chosen(p)) {
            if particle.constraint != 0 {
                let other = &list[particle.constraint as usize - 1].name;
                return Err(
                    refuse.at(&path, format!("`{}` and `{other}` both hold the particle at {}", list[k].name, particle.position))
                );
            }
            particle.constraint = k as u32 + 1;
            // What is held has its velocity from the first row on, whatever its body sets off with.
            let factor = list[k].factor(0.0).unwrap_or(1.0);
            for axis in (0..3).filter(|&axis| prescribed[axis]) {
                particle.velocity[axis] = factor * vector[axis];
            }
        }
    }
    Ok(list)
}

fn coupling(file: &File, bodies: &[SceneBody], groups: &[Group], refuse: &Refuse) -> Result<Vec<Vec<f64>>, String> {
    // Bodies of different groups share no kernel sums. Nor do two bodies where sums run over the reference configuration.
    let mut table = vec![vec![0.0; bodies.len()]; bodies.len()];
    for group in groups {
        let f = &group.formulation;
        let reference = f.kind == Formulation::TotalLagrangian || f.configuration == Some(Configuration::Reference);
        for &a in &group.bodies {
            group.bodies.iter().for_each(|&b| table[a][b] = if reference && a != b { 0.0 } else { 1.0 });
        }
    }
    for (k, contact) in file.contact.iter().enumerate() {
        let at = k.to_string();
        let path = ["contact", &at, "between"];
        if let Some(word) = contact.between.iter().find(|word| named(bodies, word).is_empty()) {
            return Err(refuse.at(&path, format!("no body is named `{word}`{}", hint(word, &names(bodies)))));
        }
        let acts = contact.kernel.is_some() || contact.touches() || contact.gap.is_some() || contact.tie;
        refuse.unless(acts || contact.none, &["contact", &at], || {
            "a contact needs kernel, potential, colour_field, zones, gap, tie or none".into()
        })?;
        refuse.unless(!(acts && contact.none), &["contact", &at, "none"], || {
            "none = true says that nothing acts between the two: no kernel, no law and no tie goes beside it".into()
        })?;
        if contact.tie {
            ties::join(&mut table, bodies, groups, (&at, contact), refuse)?;
        }
        let Some(kernel) = contact.kernel.or(contact.none.then_some(0.0)) else { continue };
        let touching = pairs(bodies, &contact.between);
        refuse.unless(touching.iter().all(|(a, b)| a != b), &path, || "a body cannot be uncoupled from itself".into())?;
        refuse.unless((0.0..=1.0).contains(&kernel), &["contact", &at, "kernel"], || {
            format!("kernel must lie between 0 (off) and 1 (as one body), found {kernel}")
        })?;
        let meets = touching.iter().all(|&(a, b)| table[a][b] > 0.0);
        refuse.unless(meets || kernel == 0.0, &["contact", &at, "kernel"], || {
            if across(groups, file, contact) {
                "bodies of different groups, whose formulations differ in more than numbers, have no kernel sums with each other: kernel must be 0"
                    .into()
            } else {
                let lagrangian = groups.iter().any(|g| g.kind() == Formulation::TotalLagrangian && g.has(file, &contact.between[0]));
                let tie = if lagrangian { ". In its place tie = true bonds bodies that share a face" } else { "" };
                format!("bodies have no kernel sums with each other in the reference configuration: kernel must be 0{tie}")
            }
        })?;
        for (a, b) in touching {
            (table[a][b], table[b][a]) = (kernel, kernel);
        }
    }
    Ok(table)
}

fn planes(file: &File, refuse: &Refuse) -> Result<Vec<Plane>, String> {
    let mut list: Vec<Plane> = Vec::new();
    for (k, typed) in file.symmetry.iter().enumerate() {
        let at = k.to_string();
        let normal = used(typed.normal.vector(), file.dimension).normalize_or_zero();
        refuse.unless(normal != DVec3::ZERO, &["symmetry", &at, "normal"], || "normal must not be zero".into())?;
        let orthogonal = list.iter().all(|plane| plane.normal.dot(normal).abs() < 1e-9);
        refuse.unless(orthogonal, &["symmetry", &at], || "symmetry planes must be at right angles to each other".into())?;
        list.push(Plane { normal, offset: normal.dot(typed.point.vector()) });
    }
    Ok(list)
}

fn period(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<[f64; 3], String> {
    let mut period = [0.0; 3];
    let Some(lengths) = &file.periodic else { return Ok(period) };
    refuse.unless(lengths.len() == file.dimension, &["periodic"], || {
        format!("periodic takes {} lengths (0 for an open axis)", file.dimension)
    })?;
    period[..file.dimension].copy_from_slice(lengths);
    let reach = bodies.iter().map(|b| b.smoothing_length).fold(0.0, f64::max) * (2.0 + file.list_margin());
    for &length in lengths {
        refuse.unless(length == 0.0 || length > 3.01 * reach, &["periodic"], || {
            format!("a periodic box must be longer than three reaches of the neighbour list, {:.4}; found {length}", 3.01 * reach)
        })?;
    }
    refuse.unless(file.symmetry.is_empty(), &["periodic"], || "a scene has periodic axes or symmetry planes, not both".into())?;
    Ok(period)
}

/// The method of a scene of one group.
pub(super) fn method(scene: &Scene, refuse: &Refuse) -> Result<Method, String> {
    let (file, bodies) = (&scene.file, &scene.bodies);
    let f = &file.formulation;
    refuse.unless(f.xsph.is_none() || f.velocity_filter.is_none(), &["formulation", "velocity_filter"], || {
        "xsph and velocity_filter are two uses of one average: name one of them".into()
    })?;
    let dissipates = f.viscosity.is_some() || rubs(file) || bodies.iter().any(|body| body.material.has_memory());
    refuse.unless(!f.dissipated_energy || dissipates, &["formulation", "dissipated_energy"], || {
        "dissipated_energy adds up the heat of viscosity, friction and plastic work, and this scene names no viscosity, has \
         no friction and does not yield"
            .into()
    })?;
    let lagrangian = f.kind == Formulation::TotalLagrangian;
    let corrected_kernel = corrected_kernel::options(file, refuse)?;
    lagrangian_only(file, bodies, refuse)?;
    plasticity::check(file, bodies, refuse)?;
    quasi_static::check(file, bodies, refuse)?;
    let mut laws: Vec<Law> = bodies.iter().flat_map(|body| body.material.laws()).collect();
    laws.sort_unstable();
    laws.dedup();
    let strengthened = bodies.iter().any(|body| body.options.artificial_epsilon > 0.0);
    let held = scene.particles.iter().any(|particle| particle.constraint != 0);
    let driven = scene.obstacles.iter().any(|obstacle| obstacle.condition.is_some());
    let body_force = file.body_force.as_ref().is_some_and(|g| g.iter().any(|&x| x != 0.0));
    Ok(Method {
        dimension: file.dimension,
        smoothing: f.smoothing,
        integrator: file.time.integrator,
        quasi_static: file.quasi_static.as_ref().map(|q| q.method),
        density: f.density,
        gradient: f.gradient(),
        formulation: f.kind,
        between: false,
        corrected_kernel,
        laws,
        hourglass: lagrangian && bodies.iter().any(|body| body.options.hourglass > 0.0),
        bond_table: lagrangian && f.bond_table.unwrap_or(true),
        shear: bodies.iter().any(|b| b.material.shear_modulus > 0.0),
        many_bodies: bodies.len() > 1,
        body_options: bodies.iter().any(|body| body.options != bodies[0].options),
        coupling: scene.coupling.iter().flatten().any(|&c| c != 1.0),
        tied: lagrangian && ties::any(&scene.coupling),
        constraints: held || driven,
        symmetry: !scene.planes.is_empty(),
        periodic: scene.period.iter().any(|&p| p > 0.0),
        body_force,
        contact: contacts::laws(file),
        gap: file.contact.iter().find_map(|contact| contact.gap.as_ref()).map(|gap| gap.form),
        obstacles: !scene.obstacles.is_empty(),
        friction: rubs(file),
        viscosity: bodies.iter().any(|body| body.options.alpha > 0.0 || body.options.beta > 0.0),
        xsph: f.xsph.is_some_and(|w| w > 0.0),
        velocity_filter: f.velocity_filter.is_some_and(|w| w > 0.0),
        artificial_stress: f.artificial_stress.as_ref().filter(|_| strengthened).map(|a| a.form),
        internal_energy: f.internal_energy,
        dissipated_energy: f.dissipated_energy,
        compensated: false,
    })
}

fn rubs(file: &File) -> bool {
    let gaps = file.contact.iter().filter_map(|contact| contact.gap.as_ref()).map(|gap| gap.friction);
    gaps.chain(file.obstacle.iter().map(|obstacle| obstacle.friction)).any(|friction| friction > 0.0)
}

/// Refuses options that belong to a formulation other than the scene's.
fn lagrangian_only(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<(), String> {
    let f = &file.formulation;
    let lagrangian = f.kind == Formulation::TotalLagrangian;
    let finite = f.kind != Formulation::Eulerian;
    for (k, body) in bodies.iter().enumerate() {
        let at = k.to_string();
        let whole = body.material.whole.is_some();
        let serves = if finite { whole || body.material.yields() } else { !whole };
        refuse.unless(serves, &["body", &at, "material"], || {
            let words = "`st_venant_kirchhoff`, `neo_hookean`, `maxwell`";
            if finite {
                format!("this formulation.kind takes a material whose law is {words} or a strength that yields, such as `j2`")
            } else {
                format!("a material whose law is one of {words} needs formulation.kind `total_lagrangian` or `corrected_kernel`")
            }
        })?;
        let typed = &file.body[k];
        let stressed = typed.relative_volume.is_some() || typed.deviatoric_stress.is_some();
        refuse.unless(!(finite && stressed), &["body", &at], || {
            "a body of finite strain starts unstressed: relative_volume and deviatoric_stress do not go with it".into()
        })?;
    }
    let eulerian_words = [
        ("xsph", f.xsph.is_some()),
        ("velocity_filter", f.velocity_filter.is_some()),
        ("artificial_stress", f.artificial_stress.is_some()),
        ("internal_energy", f.internal_energy),
        ("density", f.density != Density::Continuity),
        ("gradient", f.gradient == Some(Gradient::Corrected)),
    ];
    for (word, named) in eulerian_words {
        refuse.unless(!(finite && named), &["formulation", word], || format!("{word} belongs to formulation.kind `eulerian`"))?;
    }
    let quadratic = f.gradient == Some(Gradient::Quadratic);
    refuse.unless(!quadratic || (lagrangian && file.symmetry.is_empty()), &["formulation", "gradient"], || {
        "the quadratic gradient belongs to formulation.kind `total_lagrangian`, and does not see mirror images: no [[symmetry]]".into()
    })?;
    let touches = file.contact.iter().any(|contact| contact.touches() || contact.gap.is_some());
    refuse.unless(!lagrangian || touches || f.list_margin.is_none(), &["formulation", "list_margin"], || {
        "list_margin is that of a list that follows the particles: a Total Lagrangian scene has one only where bodies touch"
            .into()
    })?;
    refuse.unless(lagrangian || f.bond_table.is_none(), &["formulation", "bond_table"], || {
        "bond_table belongs to formulation.kind `total_lagrangian`".into()
    })?;
    refuse.unless(lagrangian || f.hourglass.is_none(), &["formulation", "hourglass"], || {
        "hourglass belongs to formulation.kind `total_lagrangian`".into()
    })?;
    let strong = bodies.iter().find(|body| !(body.options.hourglass >= 0.0 && body.options.hourglass.is_finite()));
    if let Some(SceneBody { options, .. }) = strong {
        let message = format!("hourglass must be 0 or a positive number, found {}", options.hourglass);
        return Err(refuse.at(&["formulation", "hourglass"], message));
    }
    let remembers = bodies.iter().any(|body| body.material.has_memory());
    let conservative = lagrangian && f.viscosity.is_none() && !remembers;
    refuse.unless(conservative || file.time.integrator != Integrator::Pefrl, &["time", "integrator"], || {
        "pefrl needs forces that depend on positions alone: a Total Lagrangian scene without viscosity or a law that remembers".into()
    })?;
    refuse.unless(!remembers || file.time.integrator == Integrator::Leapfrog, &["time", "integrator"], || {
        "the law `maxwell` and strengths that yield take what they remember to the end of whole steps: only the integrator \
         leapfrog has them"
            .into()
    })
}

fn artificial_spacing(file: &File, bodies: &[SceneBody], particles: &[Particle]) -> f64 {
    match file.formulation.artificial_stress.as_ref().map(|a| a.spacing) {
        Some(ArtificialSpacing::Given(length)) => length,
        Some(ArtificialSpacing::Mean) => mean_spacing(bodies, particles),
        _ => bodies[0].spacing,
    }
}

/// Mean distance to its neighbours of the first body's particle that has most of them.
fn mean_spacing(bodies: &[SceneBody], particles: &[Particle]) -> f64 {
    let own: Vec<DVec3> = particles.iter().filter(|p| p.body == 0).map(|p| p.position).collect();
    let middle = own.iter().copied().sum::<DVec3>() / own.len() as f64;
    let near = |p: DVec3| own.iter().map(move |q| q.distance(p));
    let center = own.iter().copied().min_by(|a, b| a.distance_squared(middle).total_cmp(&b.distance_squared(middle)));
    let reach = 2.0 * bodies[0].smoothing_length;
    let distances: Vec<f64> = near(center.unwrap_or(middle)).filter(|&d| d > 0.0 && d < reach).collect();
    if distances.is_empty() { bodies[0].spacing } else { distances.iter().sum::<f64>() / distances.len() as f64 }
}
