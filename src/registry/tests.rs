//! A scene is composed the same whether all else is there or not, and of nothing that it could do without.

use super::*;
use crate::scene::Scene;

const BODY: &str = r#"
title = "A block"
dimension = 2
spacing = 0.1
duration = 1
[[body]]
name = "block"
shape = { block = { min = [0, 0], max = [1, 1] } }
anchor = [0.05, 0.05]
material = "rubber"
[material.rubber]
density = 1
youngs_modulus = 1
poisson_ratio = 0.3
"#;

const MINIMAL: &str = "[formulation]\n";
const FULLER: &str = r#"
[formulation]
viscosity = { alpha = 1 }
xsph = 0.5
artificial_stress = { epsilon = 0.3 }
"#;
const LAGRANGIAN: &str = r#"
law = "neo_hookean"
[formulation]
kind = "total_lagrangian"
smoothing = "wendland"
[time]
integrator = "pefrl"
"#;
const TOUCHING: &str = r#"
law = "j2"
yield_stress = 0.01
[[body]]
name = "other"
shape = { block = { min = [2, 0], max = [3, 1] } }
anchor = [2.05, 0.05]
material = "soft"
[material.soft]
law = "maxwell"
density = 1
youngs_modulus = 1
poisson_ratio = 0.3
viscosity = 1
[formulation]
kind = "total_lagrangian"
[[contact]]
between = ["block", "other"]
potential = { law = "barrier", stiffness = 1, range = 1 }
"#;

fn method(more: &str) -> Method {
    Scene::parse(&format!("{BODY}{more}"), "block", None, &[]).unwrap().method
}

fn without(registry: &Registry, part: Part) -> Registry {
    Registry { parts: registry.parts.iter().copied().filter(|other| *other != part).collect() }
}

#[test]
fn a_scene_is_composed_of_its_own_parts_alone() {
    for more in [MINIMAL, FULLER, LAGRANGIAN, TOUCHING] {
        let method = method(more);
        let own = Registry::own(&method).unwrap();
        assert!(own.parts.len() < Registry::full().parts.len() / 2, "{}", own.parts.len());
        assert_eq!(own.texts(&method).unwrap(), Registry::full().texts(&method).unwrap());
        for &part in &own.parts {
            let wrong = without(&own, part).texts(&method);
            assert!(wrong.is_err(), "{more} does without {part:?}");
        }
    }
}

#[test]
fn what_is_added_to_the_registry_changes_no_other_scene() {
    let alien = Part::File(File { folder: "material", stem: "alien", text: "fn first_piola_alien() {}\n" });
    let method = method(LAGRANGIAN);
    let more = Registry { parts: [&[alien], &Registry::full().parts[..], &[alien]].concat() };
    assert_eq!(more.texts(&method).unwrap(), Registry::full().texts(&method).unwrap());
}

#[test]
fn a_scene_of_another_law_is_composed_otherwise() {
    let (one, other) = (method(LAGRANGIAN), method(&LAGRANGIAN.replace("neo_hookean", "st_venant_kirchhoff")));
    let (own, full) = (Registry::own(&one).unwrap(), Registry::full());
    let (a, b) = (full.texts(&one).unwrap(), full.texts(&other).unwrap());
    assert!(a.shaders != b.shaders && a.fields == b.fields && a.dispatches == b.dispatches);
    assert!(a.shaders.contains("first_piola_neo_hookean") && !b.shaders.contains("first_piola_neo_hookean"));
    assert_eq!(own.texts(&other).unwrap_err(), "the registry has no law `st_venant_kirchhoff`");
    let (plain, rich) = (full.texts(&method(MINIMAL)).unwrap(), full.texts(&method(FULLER)).unwrap());
    assert!(plain.fields != rich.fields && plain.dispatches != rich.dispatches);
    assert!(!plain.fields.contains("smoothed_velocity") && rich.fields.contains("smoothed_velocity: 2 x Particle"));
    assert!(!plain.dispatches.contains("smooth_velocity") && rich.dispatches.contains("step: smooth_velocity.main over Listed"));
}

#[test]
fn what_is_missing_is_named() {
    let method = method(TOUCHING);
    let own = Registry::own(&method).unwrap();
    let wrong = |part| without(&own, part).texts(&method).unwrap_err();
    assert_eq!(wrong(Part::Law(Law::Maxwell)), "the registry has no law `maxwell`");
    assert_eq!(wrong(Part::Potential(Potential::Barrier)), "the registry has no potential `barrier`");
    assert_eq!(wrong(Part::Field(Field::InelasticStrain)), "the registry has no field `inelastic_strain`");
    assert_eq!(wrong(Part::Pass(Pass::ContactForce)), "the registry has no pass `contact_force`");
    let file = Part::File(own.file("inelastic").unwrap());
    assert!(wrong(file).contains("unknown import: #import inelastic"), "{}", wrong(file));
}
