//! Which bodies step together. Bodies of one formulation are a group; so are bodies of several formulations that differ in
//! nothing but the smoothing length and the numbers of [`BodyOptions`], which each body has for itself. All others are groups
//! of their own, with their own fields, lists and passes: see [`crate::step`].

use super::file::{ContactTable, File, FormulationTable};
use super::read::{hint, is_formulation_key};
use super::refuse::Refuse;
use crate::method::{Configuration, Formulation};
use std::collections::BTreeSet;

/// Bodies that step together, and the formulation of the first.
#[derive(Debug, Clone)]
pub(super) struct Group {
    /// As in `[formulation.NAME]`; None for the plain one.
    pub name: Option<String>,
    pub formulation: FormulationTable,
    /// In the order of the file.
    pub bodies: Vec<usize>,
}

/// The groups of a scene, in the order of their first bodies.
///
/// # Errors
/// Where a body names a formulation that there is not, or no body names one that there is.
pub(super) fn groups(file: &File, refuse: &Refuse) -> Result<Vec<Group>, String> {
    let mut list: Vec<Group> = Vec::new();
    for (k, body) in file.body.iter().enumerate() {
        let Some(formulation) = of_body(file, k) else {
            let name = body.formulation.as_deref().unwrap_or_default();
            let names: Vec<&str> = file.formulations.keys().map(String::as_str).collect();
            let message = if is_formulation_key(name) {
                format!("`{name}` is a key of every formulation: a named one needs another name")
            } else {
                format!("no [formulation.{name}]{}", hint(name, &names))
            };
            return Err(refuse.at(&["body", &k.to_string(), "formulation"], message));
        };
        match list.iter_mut().find(|group| one_group(&group.formulation, formulation)) {
            Some(group) => group.add(k, formulation),
            None => {
                list.push(Group { name: body.formulation.clone(), formulation: formulation.clone(), bodies: vec![k] });
            }
        }
    }
    let named: BTreeSet<&str> = file.body.iter().filter_map(|body| body.formulation.as_deref()).collect();
    let own = refuse.source.keys(&["formulation"]);
    let idle = own.into_iter().find(|key| is_formulation_key(key) && file.body.iter().all(|body| body.formulation.is_some()));
    if let Some(key) = idle {
        let message = format!("{key} of the plain [formulation] would do nothing: every body names another formulation");
        return Err(refuse.at(&["formulation", key], message));
    }
    match file.formulations.keys().find(|name| !named.contains(name.as_str())) {
        Some(idle) => Err(refuse.at(&["formulation", idle], format!("no body names [formulation.{idle}]: it would do nothing"))),
        None => Ok(list),
    }
}

/// The formulation of a body; None if it names one that there is not.
pub(super) fn of_body(file: &File, body: usize) -> Option<&FormulationTable> {
    file.body[body].formulation.as_ref().map_or(Some(&file.formulation), |name| file.formulations.get(name))
}

/// Whether two formulations differ in numbers of the body alone.
fn one_group(a: &FormulationTable, b: &FormulationTable) -> bool {
    structure(a, b) == structure(b, a)
}

/// A formulation without what parts no bodies: the numbers that each body of a group has for itself, the lengths of lists, and
/// energies that are only added up. What strengthens nothing in one formulation is taken to have the form that it has in the
/// other.
fn structure(own: &FormulationTable, other: &FormulationTable) -> FormulationTable {
    let mut bare = FormulationTable {
        smoothing_length: 0.0,
        hourglass: None,
        gradient: Some(own.gradient()),
        bond_table: None,
        xsph: own.xsph.filter(|weight| *weight > 0.0),
        velocity_filter: own.velocity_filter.filter(|weight| *weight > 0.0),
        internal_energy: false,
        dissipated_energy: false,
        list_margin: None,
        list_capacity: None,
        ..own.clone()
    };
    bare.viscosity = own.viscosity.clone().or_else(|| other.viscosity.clone());
    if let Some(viscosity) = &mut bare.viscosity {
        (viscosity.alpha, viscosity.beta) = (0.0, None);
    }
    bare.artificial_stress = own.artificial_stress.clone().or_else(|| other.artificial_stress.clone());
    if let Some(stress) = &mut bare.artificial_stress {
        stress.epsilon = 0.0;
    }
    bare
}

/// The first key in which two formulations differ so that their bodies are no group.
pub(super) fn difference(a: &FormulationTable, b: &FormulationTable) -> &'static str {
    let (a, b) = (structure(a, b), structure(b, a));
    let keys = [
        ("kind", a.kind == b.kind),
        ("smoothing", a.smoothing == b.smoothing),
        ("density", a.density == b.density),
        ("gradient", a.gradient == b.gradient),
        ("xsph", a.xsph == b.xsph),
        ("velocity_filter", a.velocity_filter == b.velocity_filter),
        ("viscosity.softening", a.viscosity == b.viscosity),
        ("artificial_stress", a.artificial_stress == b.artificial_stress),
    ];
    keys.into_iter().find(|(_, same)| !same).map_or("configuration", |(key, _)| key)
}

/// Refuses bodies that the kernel would join, as it joins all Eulerian bodies, if their formulations did not part them, unless
/// a contact says what acts between them.
pub(super) fn check_parted(file: &File, groups: &[Group], refuse: &Refuse) -> Result<(), String> {
    let current = |group: &Group| match group.kind() {
        Formulation::TotalLagrangian => false,
        Formulation::Eulerian => true,
        Formulation::CorrectedKernel => group.formulation.configuration != Some(Configuration::Reference),
    };
    let joined: Vec<&Group> = groups.iter().filter(|group| current(group)).collect();
    for (k, one) in joined.iter().enumerate() {
        for other in &joined[..k] {
            for (&a, &b) in one.bodies.iter().flat_map(|a| other.bodies.iter().map(move |b| (a, b))) {
                let names =
                    |body: usize, word: &String| file.body[body].name == *word || file.body[body].group.as_ref() == Some(word);
                let between = |[x, y]: &[String; 2]| (names(a, x) && names(b, y)) || (names(a, y) && names(b, x));
                if !file.contact.iter().any(|contact| between(&contact.between)) {
                    let key = difference(&one.formulation, &other.formulation);
                    let message = format!(
                        "`{}` and `{}` have no kernel sums with each other, since their formulations differ in {key}: name a \
                         [[contact]] between them (kernel = 0 for none)",
                        file.body[b].name, file.body[a].name
                    );
                    return Err(refuse.at(&["body", &a.to_string(), "formulation"], message));
                }
            }
        }
    }
    Ok(())
}

impl Group {
    fn add(&mut self, body: usize, formulation: &FormulationTable) {
        self.bodies.push(body);
        let own = &mut self.formulation;
        own.viscosity = own.viscosity.take().or_else(|| formulation.viscosity.clone());
        own.artificial_stress = own.artificial_stress.take().or_else(|| formulation.artificial_stress.clone());
        own.internal_energy |= formulation.internal_energy;
        own.dissipated_energy |= formulation.dissipated_energy;
        own.bond_table = own.bond_table.into_iter().chain(formulation.bond_table).reduce(|a, b| a && b);
        own.list_margin = own.list_margin.into_iter().chain(formulation.list_margin).reduce(f64::max);
        own.list_capacity = own.list_capacity.into_iter().chain(formulation.list_capacity).max();
    }

    /// The scene as a group alone sees it: its bodies, its formulation, what acts between its bodies. Obstacles stay where its
    /// bodies meet them.
    pub fn view(&self, file: &File) -> File {
        let mut view = file.clone();
        view.formulation = self.formulation.clone();
        view.formulations.clear();
        view.body = self.bodies.iter().map(|&k| file.body[k].clone()).collect();
        view.contact.retain(|contact| contact.between.iter().all(|word| self.has(file, word)));
        view
    }

    /// Whether a word names bodies of this group.
    pub fn has(&self, file: &File, word: &str) -> bool {
        self.bodies.iter().any(|&k| file.body[k].name == word || file.body[k].group.as_deref() == Some(word))
    }

    pub fn kind(&self) -> Formulation {
        self.formulation.kind
    }
}

/// Whether a contact is between bodies of different groups.
pub(super) fn across(groups: &[Group], file: &File, contact: &ContactTable) -> bool {
    !groups.iter().any(|group| contact.between.iter().all(|word| group.has(file, word)))
}
