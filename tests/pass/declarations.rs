//! What passes declare against what their composed shaders bind: every scene with its variants, every case of the parity
//! tests, and random methods.

use crate::backend::parity::cases::cases;
use crate::backend::shaders::{random_corrected, random_lagrangian, random_method};
use crate::common::{Random, scene_files};
use lithosph::backend::shader::{Access, Shader, compose};
use lithosph::fields::Field;
use lithosph::method::Method;
use lithosph::pass::Pass;
use lithosph::scene::Scene;
use lithosph::step;
use std::collections::{BTreeMap, BTreeSet};

/// Methods of all scenes and their variants.
fn methods_of_scenes() -> Vec<Method> {
    let mut list = Vec::new();
    for path in scene_files() {
        let plain = Scene::open(&path, None, &[]).unwrap();
        let variants = plain.file.variant.keys().map(|name| Scene::open(&path, Some(name), &[]).unwrap());
        list.extend(variants.flat_map(|scene| scene.methods()));
        list.extend(plain.methods());
    }
    list
}

/// The same with those of the parity tests' cases, with and without compensation.
fn methods() -> Vec<Method> {
    let of_cases = (1..=3).flat_map(cases).flat_map(|case| case.scene().methods());
    let both = |method: Method| [false, true].map(|compensated| Method { compensated, ..method.clone() });
    methods_of_scenes().into_iter().chain(of_cases).flat_map(both).collect()
}

/// Fields that the entry points of a shader load from and store to.
#[derive(Clone, Default)]
struct Bound {
    reads: BTreeSet<Field>,
    writes: BTreeSet<Field>,
}

fn bound(pass: Pass, text: &str) -> Bound {
    let shader = Shader::parse(text).unwrap_or_else(|error| panic!("{}: {error}", pass.name()));
    let mut bound = Bound::default();
    for entry in pass.entries() {
        for binding in shader.entry(entry.name).unwrap().bindings {
            let Some(&field) = Field::ALL.iter().find(|field| field.name() == binding.name) else { continue };
            let of_writes = binding.kind == Access::ReadWrite;
            if binding.reads {
                bound.reads.insert(field);
            }
            if of_writes {
                bound.writes.insert(field);
            }
        }
    }
    bound
}

/// What is wrong with the declarations of a method's passes.
fn check(method: &Method, known: &mut BTreeMap<String, Bound>) -> BTreeSet<String> {
    let mut wrong = BTreeSet::new();
    for pass in step::passes(method) {
        let text = compose(pass, method);
        let bound = known.entry(text).or_insert_with_key(|text| bound(pass, text));
        let reads: BTreeSet<Field> = pass.declaration().reads(method).into_iter().collect();
        let writes: BTreeSet<Field> = pass.declaration().written(method).into_iter().collect();
        for (verb, declared, found) in [("read", &reads, &bound.reads), ("write", &writes, &bound.writes)] {
            let told = |fields: Vec<&Field>| fields.iter().map(|field| field.name()).collect::<Vec<_>>().join(", ");
            let missing = told(found.difference(declared).collect());
            let idle = told(declared.difference(found).collect());
            if !missing.is_empty() || !idle.is_empty() {
                let flags = method.flags().join(" ");
                wrong.insert(format!("{} {verb}s also [{missing}], does not {verb} [{idle}]: {flags}", pass.name()));
            }
        }
    }
    wrong
}

#[test]
fn passes_read_and_write_what_they_declare() {
    let (methods, mut known) = (methods(), BTreeMap::new());
    let wrong: BTreeSet<String> = methods.iter().flat_map(|method| check(method, &mut known)).collect();
    let passes: BTreeSet<Pass> = methods.iter().flat_map(step::passes).collect();
    assert_eq!(passes, Pass::ALL.iter().copied().collect());
    assert!(wrong.is_empty(), "{}", wrong.into_iter().collect::<Vec<_>>().join("\n"));
}

#[test]
fn passes_of_random_methods_read_and_write_what_they_declare() {
    let (mut random, mut known, mut wrong) = (Random(2027), BTreeMap::new(), BTreeSet::new());
    for _ in 0..400 {
        for method in [random_method(&mut random), random_lagrangian(&mut random), random_corrected(&mut random)] {
            wrong.extend(check(&method, &mut known));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.into_iter().collect::<Vec<_>>().join("\n"));
}
