//! Physics and numerics that a scene names, piece by piece.

use super::piece::{Piece, Sort, without, without_observables};
use crate::fields::{Field, Set};
use crate::material::{Law, Role};
use crate::method::{Formulation, Gradient, Integrator};
use crate::observable::{KINDS, fields_of_path};
use crate::scene::Scene;
use crate::scene::file::{ContactTable, File, Observe};
use crate::scene::material::MaterialTable;

/// Every named piece; `typed` is the file before copies of bodies are made.
pub fn pieces(scene: &Scene, typed: &File) -> Vec<Piece> {
    let named = Named { scene, file: typed };
    let mut list = named.formulation();
    list.extend(named.materials());
    list.extend(named.contacts());
    list.extend(named.surroundings());
    list.extend(named.observables());
    list
}

struct Named<'a> {
    scene: &'a Scene,
    file: &'a File,
}

fn piece(name: impl Into<String>, overrides: Vec<String>) -> Piece {
    Piece::new(name, Sort::Named, overrides)
}

impl Named<'_> {
    fn formulation(&self) -> Vec<Piece> {
        let (f, method) = (&self.file.formulation, &self.scene.method);
        let key = |key: &str, value: &str| vec![format!("formulation.{key}={value}")];
        let also = |mut first: Vec<String>, more: Vec<String>| {
            first.extend(more);
            first
        };
        let heat = also(key("dissipated_energy", "false"), self.without_fields(&[Field::DissipatedEnergy]));
        let viscous_heat = if f.dissipated_energy && self.dissipates() == 1 { heat.clone() } else { Vec::new() };
        let hourglass = also(key("hourglass", "0"), self.without_fields(&[Field::HourglassEnergy]));
        let energy = also(key("internal_energy", "false"), self.without_fields(&[Field::InternalEnergy]));
        let corrects = f.gradient() != Gradient::Plain && f.kind != Formulation::CorrectedKernel;
        let all = [
            (method.artificial_stress.is_some(), "artificial stress", key("artificial_stress", "none")),
            (method.viscosity, "viscosity", also(key("viscosity", "none"), viscous_heat)),
            (method.xsph, "XSPH", key("xsph", "none")),
            (method.velocity_filter, "velocity filter", key("velocity_filter", "none")),
            (corrects, "correction of gradients", key("gradient", "plain")),
            (f.gradient() == Gradient::Quadratic, "quadratic terms of gradients", key("gradient", "adjoint")),
            (method.hourglass, "hourglass energy", hourglass),
            (
                f.kind == Formulation::CorrectedKernel && f.correction != Some(false),
                "correction of the kernel",
                key("correction", "false"),
            ),
            (method.internal_energy, "energy equation", energy),
            (method.dissipated_energy, "sum of heat", heat),
        ];
        all.into_iter().filter(|(on, ..)| *on).map(|(_, name, overrides)| piece(name, overrides)).collect()
    }

    /// How many things make heat.
    fn dissipates(&self) -> usize {
        let laws = self.used().filter(|(_, material)| material.has_memory()).count();
        usize::from(self.scene.method.viscosity) + usize::from(self.scene.method.friction) + laws
    }

    fn used(&self) -> impl Iterator<Item = (&String, &MaterialTable)> {
        self.file.material.iter().filter(|(name, _)| self.file.body.iter().any(|body| body.material == **name))
    }

    fn materials(&self) -> Vec<Piece> {
        let mut list = Vec::new();
        for (name, material) in self.used() {
            let key = |key: &str, value: &str| format!("material.{name}.{key}={value}");
            let elastic = if self.file.formulation.kind == Formulation::Eulerian { "elastic" } else { "neo_hookean" };
            let hardening = material.hardens().then(|| key("hardening", "none"));
            if let Some(hardening) = &hardening {
                list.push(piece(format!("hardening of `{name}`"), vec![hardening.clone()]));
            }
            if material.yields() && material.law.is_none() {
                // Laws by roles: without the strength that gives way, and the heat that comes of it.
                let eulerian = elastic == "elastic";
                let gone = material.roles.keys().filter(|role| !eulerian || *role == Role::Heat.word());
                let mut overrides: Vec<String> = gone.map(|role| key(role, "none")).collect();
                overrides.push(key(if eulerian { "strength" } else { "law" }, elastic));
                overrides.extend(self.without_plasticity());
                list.push(piece(format!("plasticity of `{name}`"), overrides));
                continue;
            }
            let (what, limit) = match material.named() {
                Some(Law::J2) => ("plasticity", "yield_stress"),
                Some(Law::Maxwell) => ("relaxation", "viscosity"),
                _ => continue,
            };
            let mut overrides = vec![key("law", elastic), key(limit, "none")];
            overrides.extend(hardening);
            overrides.extend(self.without_plasticity());
            list.push(piece(format!("{what} of `{name}`"), overrides));
        }
        list
    }

    /// What a scene must do without if the only material that remembers no longer does.
    fn without_plasticity(&self) -> Vec<String> {
        let mut overrides = Vec::new();
        if self.file.formulation.dissipated_energy && self.dissipates() == 1 {
            overrides.push("formulation.dissipated_energy=false".into());
            overrides.extend(self.without_fields(&[Field::DissipatedEnergy]));
        }
        if self.used().filter(|(_, other)| other.has_memory()).count() == 1 {
            let remembered = [Field::InelasticStrain, Field::EquivalentPlasticStrain, Field::Temperature];
            overrides.extend(self.without_fields(&remembered));
        }
        overrides
    }

    /// Laws one by one, then what is left of a contact beside its only law.
    fn contacts(&self) -> Vec<Piece> {
        let mut list = Vec::new();
        for (k, contact) in self.file.contact.iter().enumerate() {
            let [a, b] = &contact.between;
            let laws = laws(contact);
            for law in &laws {
                let path = if laws.len() == 1 { format!("contact.{k}") } else { format!("contact.{k}.{law}") };
                let rubs = *law == "gap" && frictions(contact).any(|(own, friction)| own == "gap" && friction > 0.0);
                let mut overrides = if rubs { self.frictionless(without(&path)) } else { vec![without(&path)] };
                overrides.extend(self.without_fields(&self.touch(law)));
                list.push(piece(format!("contact of `{a}` and `{b}` by {law}"), overrides));
            }
            for (law, _) in frictions(contact).filter(|(_, friction)| *friction > 0.0) {
                let change = format!("contact.{k}.{law}.friction=0");
                // Zones count no heat.
                let overrides = if law == "gap" { self.frictionless(change) } else { vec![change] };
                list.push(piece(format!("friction of `{a}` and `{b}`"), overrides));
            }
        }
        list
    }

    /// Fields that only one law of contact has.
    fn touch(&self, law: &str) -> Vec<Field> {
        let contacts = &self.file.contact;
        let faces = contacts.iter().filter(|contact| contact.gap.is_some()).count() + self.file.obstacle.len();
        let energies = contacts.iter().map(stores).sum::<usize>() + self.file.obstacle.len();
        let by_faces = ["gap", "obstacle"].contains(&law);
        let last = (by_faces || ["potential", "colour_field"].contains(&law)) && energies == 1;
        let energy = Some(Field::ContactEnergy).filter(|_| last);
        let facets = Field::ALL.iter().copied().filter(|field| by_faces && faces == 1 && field.set() == Set::Facet);
        facets.chain(energy).collect()
    }

    /// A change that ends one friction, and the sum of heat where nothing else makes any.
    fn frictionless(&self, change: String) -> Vec<String> {
        let of_contacts = self.file.contact.iter().flat_map(frictions).filter(|(law, friction)| *law == "gap" && *friction > 0.0);
        let rubbing = of_contacts.count() + self.file.obstacle.iter().filter(|obstacle| obstacle.friction > 0.0).count();
        let mut overrides = vec![change];
        if self.file.formulation.dissipated_energy && self.dissipates() == 1 && rubbing == 1 {
            overrides.push("formulation.dissipated_energy=false".into());
            overrides.extend(self.without_fields(&[Field::DissipatedEnergy]));
        }
        overrides
    }

    /// Obstacles, mirrors, a periodic box, gravity, flaws.
    fn surroundings(&self) -> Vec<Piece> {
        let mut list = Vec::new();
        for obstacle in &self.file.obstacle {
            let (name, path) = (&obstacle.name, format!("obstacle.{}", obstacle.name));
            let rubs = obstacle.friction > 0.0;
            let mut overrides = if rubs { self.frictionless(without(&path)) } else { vec![without(&path)] };
            overrides.extend(without_observables(self.file, |typed| typed.obstacle.as_ref() == Some(name)));
            overrides.extend(self.without_fields(&self.touch("obstacle")));
            list.push(piece(format!("obstacle `{name}`"), overrides));
            if rubs {
                list.push(piece(format!("friction of obstacle `{name}`"), self.frictionless(format!("{path}.friction=0"))));
            }
        }
        let mirrors =
            (0..self.file.symmetry.len()).map(|k| piece(format!("mirror {k}"), vec![without(&format!("symmetry.{k}"))]));
        list.extend(mirrors);
        if self.scene.method.periodic {
            list.push(piece("periodic box", vec![without("periodic")]));
        }
        if self.scene.method.body_force {
            list.push(piece("body force", vec![without("body_force")]));
        }
        let flawed = self.file.body.iter().filter(|body| body.flaw.is_some());
        list.extend(
            flawed.map(|body| piece(format!("flaw of `{}`", body.name), vec![without(&format!("body.{}.flaw", body.name))])),
        );
        if self.file.time.integrator != Integrator::Leapfrog {
            list.push(Piece::new("stages of the integrator", Sort::Reduced, vec!["time.integrator=leapfrog".into()]));
        }
        if self.scene.method.bond_table {
            list.push(Piece::new("table of distinct bonds", Sort::Reduced, vec!["formulation.bond_table=false".into()]));
        }
        list
    }

    /// Observables of which nothing is expected and from which nothing expected is found.
    fn observables(&self) -> Option<Piece> {
        let mut needed: Vec<&String> = self.file.expect.keys().collect();
        let mut next = 0;
        while let Some(typed) = needed.get(next).map(|name| self.file.observe.get(*name)) {
            needed.extend(typed.into_iter().flat_map(|typed| [&typed.of, &typed.over]).flatten());
            next += 1;
        }
        let idle = self.file.observe.keys().filter(|name| !needed.contains(name));
        let overrides: Vec<String> = idle.map(|name| without(&format!("observe.{name}"))).collect();
        let some = !overrides.is_empty() && !self.file.expect.is_empty();
        some.then(|| piece("idle observables", overrides))
    }

    fn without_fields(&self, gone: &[Field]) -> Vec<String> {
        without_fields(self.scene, self.file, gone)
    }
}

/// Overrides that take away what reads fields that will be gone.
pub fn without_fields(scene: &Scene, file: &File, gone: &[Field]) -> Vec<String> {
    let of_path = |path: &str| fields_of_path(scene, path).iter().any(|field| gone.contains(field));
    let reads = |typed: &Observe| {
        let kind = KINDS.iter().find(|kind| kind.word == typed.kind);
        kind.is_some_and(|kind| kind.fields.iter().any(|field| gone.contains(field)))
            || typed.field.as_deref().is_some_and(of_path)
    };
    let mut overrides = without_observables(file, reads);
    if of_path(&file.output.picture.field) {
        overrides.push("output.picture.field=pressure".into());
    }
    if file.output.fields.iter().any(|word| of_path(word)) {
        overrides.push("output.fields=[]".into());
    }
    overrides
}

/// Laws of a contact that store energy.
pub fn stores(contact: &ContactTable) -> usize {
    let all = [contact.potential.is_some(), contact.colour_field.is_some(), contact.gap.is_some()];
    all.into_iter().filter(|on| *on).count()
}

/// Words of the laws of a contact; beside another law the kernel is off, which is no law.
fn laws(contact: &ContactTable) -> Vec<&'static str> {
    let all = [
        ("kernel", contact.kernel.is_some() && !contact.touches() && contact.gap.is_none()),
        ("potential", contact.potential.is_some()),
        ("gap", contact.gap.is_some()),
        ("colour_field", contact.colour_field.is_some()),
        ("zones", contact.zones.is_some()),
        ("tie", contact.tie),
    ];
    all.into_iter().filter(|(_, on)| *on).map(|(word, _)| word).collect()
}

fn frictions(contact: &ContactTable) -> impl Iterator<Item = (&'static str, f64)> {
    let gap = contact.gap.as_ref().map(|gap| ("gap", gap.friction));
    gap.into_iter().chain(contact.zones.as_ref().map(|zones| ("zones", zones.friction)))
}
