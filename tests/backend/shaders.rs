//! Every composed shader is valid WGSL and binds nothing that it does not use; no source asks a device for what
//! devices do badly or not at all.

use crate::common::{Random, scene_files};
use lithosph::backend::shader::{Shader, compose};
use lithosph::material::{Law, Reads, Role};
use lithosph::method::{
    ArtificialForm, Configuration, CorrectedKernel, Deformation, Density, Formulation, Gradient, Integrator, Method,
    VelocityGradient,
};
use lithosph::registry::Registry;
use lithosph::scene::Scene;
use lithosph::smoothing::Smoothing;
use lithosph::step;
use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut list = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => list.extend(files(&path, extension)),
            false if path.extension().is_some_and(|found| found == extension) => list.push(path),
            false => {}
        }
    }
    list.sort();
    list
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Names of the bindings that a composed text declares.
fn declared(text: &str) -> BTreeSet<String> {
    let name = |line: &str| line.split_once('>')?.1.split_once(':').map(|(name, _)| name.trim().to_string());
    let lines = text.lines().filter(|line| line.contains("@binding("));
    lines.map(|line| name(line).unwrap_or_else(|| panic!("what does this bind: {line}"))).collect()
}

/// Checks all passes of a method whose text is new; what is wrong, by pass and binding.
fn check(method: &Method, seen: &mut HashSet<String>) -> Vec<String> {
    let mut wrong = Vec::new();
    for pass in step::passes(method) {
        let text = compose(pass, method);
        if !seen.insert(text.clone()) {
            continue;
        }
        let shader = Shader::parse(&text).unwrap_or_else(|error| panic!("{}: {method:?}\n{error}", pass.name()));
        let used = |entry: &lithosph::pass::Entry| shader.entry(entry.name).unwrap().bindings;
        let used: BTreeSet<String> = pass.entries().iter().flat_map(used).map(|binding| binding.name).collect();
        let declared = declared(&text);
        assert!(used.is_subset(&declared), "{}: {used:?} is more than {declared:?}", pass.name());
        let idle: Vec<_> = declared.difference(&used).cloned().collect();
        wrong
            .extend(idle.iter().map(|name| format!("{} declares {name} and does not use it: {:?}", pass.name(), method.flags())));
    }
    wrong
}

#[test]
fn shaders_of_every_scene_are_valid() {
    let (mut seen, mut wrong) = (HashSet::new(), Vec::new());
    for path in scene_files() {
        let plain = Scene::open(&path, None, &[]).unwrap();
        let variants = plain.file.variant.keys().map(|name| Scene::open(&path, Some(name), &[]).unwrap());
        let methods: Vec<Method> = variants.flat_map(|scene| scene.methods()).chain(plain.methods()).collect();
        for method in methods {
            for compensated in [false, true] {
                let method = Method { compensated, ..method.clone() };
                wrong.extend(check(&method, &mut seen));
                // It pays for nothing that another scene names: all else may be gone.
                let own = Registry::own(&method).unwrap();
                assert!(own.parts.len() < Registry::full().parts.len(), "{}", path.display());
                assert_eq!(own.texts(&method), Registry::full().texts(&method), "{}", path.display());
            }
        }
    }
    assert!(seen.len() >= 20 && wrong.is_empty(), "{}", wrong.join("\n"));
}

pub fn random_method(random: &mut Random) -> Method {
    use Integrator::*;
    let many_bodies = random.coin();
    let symmetry = random.coin();
    let viscosity = random.coin();
    let xsph = random.coin();
    let plastic = random.coin();
    Method {
        dimension: 1 + random.below(3),
        laws: if plastic { metal(random, Law::Linear) } else { vec![Law::Linear, Law::Elastic] },
        smoothing: Smoothing::ALL[random.below(Smoothing::ALL.len())],
        integrator: if plastic { Leapfrog } else { [Leapfrog, Rk2, SspRk3, Rk4][random.below(4)] },
        density: [Density::Continuity, Density::Summation][random.below(2)],
        gradient: [Gradient::Plain, Gradient::Corrected, Gradient::Adjoint][random.below(3)],
        shear: plastic || random.coin(),
        many_bodies,
        coupling: many_bodies && random.coin(),
        body_options: many_bodies && random.coin(),
        constraints: random.coin(),
        symmetry,
        periodic: !symmetry && random.coin(),
        body_force: random.coin(),
        viscosity,
        xsph,
        velocity_filter: !xsph && random.coin(),
        artificial_stress: [None, Some(ArtificialForm::Scalar), Some(ArtificialForm::Principal)][random.below(3)],
        internal_energy: random.coin(),
        dissipated_energy: (viscosity || plastic) && random.coin(),
        compensated: random.coin(),
        ..Method::default()
    }
}

/// The laws of a body that yields, in order, beside one that does not.
fn metal(random: &mut Random, pressure: Law) -> Vec<Law> {
    let strengths: Vec<Law> = Law::of_role(Role::Strength).filter(|law| law.yields()).collect();
    let strength = strengths[random.below(strengths.len())];
    let heat = (strength.reads(Reads::Temperature) || random.coin()).then_some(Law::Adiabatic);
    let mut laws: Vec<Law> = [pressure, Law::Elastic, strength].into_iter().chain(heat).collect();
    laws.sort_unstable();
    laws
}

/// The same in the Total Lagrangian formulation, as far as a scene of it can go.
pub fn random_lagrangian(random: &mut Random) -> Method {
    let whole = Law::of_role(Role::Whole);
    let chosen = 1 + random.below(15);
    let mut laws: Vec<Law> = whole.enumerate().filter(|(k, _)| chosen >> k & 1 == 1).map(|(_, law)| law).collect();
    if chosen >> 3 == 1 {
        laws.extend(metal(random, Law::HartmannNeff));
        laws.sort_unstable();
    }
    let memory = laws.iter().any(|law| law.has_memory());
    let eulerian = random_method(random);
    Method {
        formulation: Formulation::TotalLagrangian,
        tied: eulerian.many_bodies && random.coin(),
        hourglass: random.coin(),
        density: Density::Continuity,
        gradient: [Gradient::Plain, Gradient::Adjoint][random.below(2)],
        integrator: if memory { Integrator::Leapfrog } else { eulerian.integrator },
        many_bodies: eulerian.many_bodies || laws.len() > 1,
        shear: true,
        viscosity: random.coin(),
        xsph: false,
        velocity_filter: false,
        artificial_stress: None,
        internal_energy: false,
        dissipated_energy: memory && random.coin(),
        laws,
        ..eulerian
    }
}

/// The same by corrected kernels, each of its combinations of options.
pub fn random_corrected(random: &mut Random) -> Method {
    let mut lagrangian = random_lagrangian(random);
    while lagrangian.plastic() {
        lagrangian = random_lagrangian(random);
    }
    let (configuration, deformation) = [
        (Configuration::Current, Deformation::Evolved),
        (Configuration::Current, Deformation::Reference),
        (Configuration::Reference, Deformation::Reference),
    ][random.below(3)];
    let velocity_gradient = [VelocityGradient::Difference, VelocityGradient::Printed][random.below(2)];
    let options = CorrectedKernel { correction: random.coin(), configuration, deformation, velocity_gradient };
    Method {
        formulation: Formulation::CorrectedKernel,
        corrected_kernel: Some(options),
        tied: false,
        viscosity: false,
        hourglass: false,
        gradient: Gradient::Plain,
        dissipated_energy: false,
        ..lagrangian
    }
}

#[test]
fn shaders_of_random_methods_are_valid() {
    let (mut random, mut seen, mut wrong) = (Random(2026), HashSet::new(), BTreeSet::new());
    for _ in 0..400 {
        wrong.extend(check(&random_method(&mut random), &mut seen));
        wrong.extend(check(&random_lagrangian(&mut random), &mut seen));
        wrong.extend(check(&random_corrected(&mut random), &mut seen));
    }
    assert!(seen.len() > 500, "{}", seen.len());
    assert!(wrong.is_empty(), "{}", wrong.into_iter().collect::<Vec<_>>().join("\n"));
}

/// The words and numbers of a source, without its comments.
fn words(source: &str) -> Vec<String> {
    let code: Vec<&str> = source.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let parts = code.join("\n");
    let parts = parts.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'));
    parts.filter(|word| !word.is_empty()).map(String::from).collect()
}

/// Functions whose error a device may choose freely or that lose digits, and what only some devices have.
const UNWANTED: &[&str] = &["atan2", "atan", "acos", "asin", "pow", "f64", "f16"];

fn lint(source: &str) -> Vec<String> {
    let number_of_f64 = |word: &str| word.starts_with(|c: char| c.is_ascii_digit() || c == '.') && word.ends_with("lf");
    words(source).into_iter().filter(|word| UNWANTED.contains(&word.as_str()) || number_of_f64(word)).collect()
}

#[test]
fn sources_use_nothing_that_devices_do_badly() {
    assert_eq!(lint("let a = pow(x, 2.0) + 1.5lf; // atan2\nlet power = b.pow1 + 0.5;"), ["pow", "1.5lf"]);
    let all = files(&folder("shaders"), "wgsl");
    assert!(all.len() > 40);
    for path in all {
        let found = lint(&std::fs::read_to_string(&path).unwrap());
        assert!(found.is_empty(), "{}: {found:?}", path.display());
    }
}
