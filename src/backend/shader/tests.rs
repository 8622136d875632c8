//! Composition and reflection on small texts; then every variant of every pass.

use super::*;

fn composed(source: &str, flags: &[&str]) -> String {
    compose_text("test", source, &Choice { flags, dimension: 2, smoothing: "kernel\n", potentials: &[], laws: &[] })
}

#[test]
fn conditions_nest() {
    let source = "a\n#if xsph\nb\n  #if !shear\nc\n#else\nd\n#endif\ne\n#else\nf\n#endif\ng";
    assert_eq!(composed(source, &["xsph"]), "a\nb\nc\ne\ng\n");
    assert_eq!(composed(source, &["xsph", "shear"]), "a\nb\nd\ne\ng\n");
    assert_eq!(composed(source, &["shear"]), "a\nf\ng\n");
}

#[test]
fn imports_come_once_and_only_where_kept() {
    let twice = composed("#import smoothing\nx\n#import smoothing\n", &[]);
    assert_eq!(twice, "kernel\nx\n");
    assert_eq!(composed("#if xsph\n#import smoothing\n#endif\nx\n", &[]), "x\n");
    assert!(composed("#import tensor\n#import real\n", &[]).contains("alias real = f32;"));
}

#[test]
fn an_import_may_ask_for_a_flag() {
    let source = "#import smoothing if xsph\n#import real if !xsph\nx\n";
    assert_eq!(composed(source, &["xsph"]), "kernel\nx\n");
    assert!(composed(source, &[]).contains("alias real = f32;"));
    // Nor is it kept in a branch that is not.
    assert_eq!(composed("#if shear\n#import smoothing if xsph\n#endif\nx\n", &["xsph"]), "x\n");
}

#[test]
fn an_import_with_keys_comes_each_time() {
    let source =
        "#import integrated QUANTITY=heat RATE=power TYPE=real\n#import integrated QUANTITY=strain RATE=speed TYPE=Mat if xsph\n";
    let (one, both) = (composed(source, &[]), composed(source, &["xsph"]));
    assert!(one.contains("fn advance_heat(") && one.contains("power: array<real>") && !one.contains("strain"), "{one}");
    assert!(both.starts_with(&one) && both.contains("fn advance_strain(") && both.contains("speed: array<Mat>"), "{both}");
    let word = ["QUANTITY", "RATE", "TYPE"].into_iter().find(|key| both.contains(key));
    assert_eq!(word, None);
}

#[test]
fn bindings_are_numbered_as_they_are_kept() {
    let source = "@group(0) @binding(_) a\n#if xsph\n@group(0) @binding(_) b\n#endif\n@group(0) @binding(_) c\n";
    assert_eq!(composed(source, &[]), "@group(0) @binding(0) a\n@group(0) @binding(1) c\n");
    assert!(composed(source, &["xsph"]).ends_with("@binding(1) b\n@group(0) @binding(2) c\n"));
}

#[test]
#[should_panic(expected = "test.wgsl line 2: unknown flag: #if sheer")]
fn a_misspelt_flag_is_an_error() {
    composed("a\n#if sheer\n#endif\n", &[]);
}

#[test]
#[should_panic(expected = "test.wgsl line 1: unknown flag: #import real if sheer")]
fn a_misspelt_flag_of_an_import_is_an_error() {
    composed("#import real if sheer\n", &[]);
}

#[test]
#[should_panic(expected = "test.wgsl line 1: a word of an import has no key: #import real shear")]
fn a_word_without_a_key_is_an_error() {
    composed("#import real shear\n", &[]);
}

#[test]
#[should_panic(expected = "an #if is not closed")]
fn an_open_condition_is_an_error() {
    composed("#if shear\n", &["shear"]);
}

const TWO_ENTRIES: &str = "
    struct P { n: u32 }
    override scale: f32 = 2.0;
    @group(0) @binding(0) var<uniform> params: P;
    @group(0) @binding(1) var<storage, read> velocity: array<f32>;
    @group(0) @binding(2) var<storage, read_write> displacement: array<f32>;
    @group(0) @binding(3) var<storage, read_write> spare: array<f32>;
    fn put(i: u32) { displacement[i] = scale * velocity[i]; }
    @compute @workgroup_size(64)
    fn main(@builtin(global_invocation_id) id: vec3<u32>) { if id.x < params.n { put(id.x); } }
    @compute @workgroup_size(256)
    fn other(@builtin(global_invocation_id) id: vec3<u32>) { spare[id.x] = 1.0; }";

#[test]
fn reflection_tells_what_each_entry_point_uses() {
    let seen = reflect(TWO_ENTRIES, "main").unwrap();
    let short: Vec<_> = seen.bindings.iter().map(|b| (b.group, b.binding, b.name.as_str(), b.kind)).collect();
    let wanted = [(0, 0, "params", Access::Uniform), (0, 1, "velocity", Access::Read), (0, 2, "displacement", Access::ReadWrite)];
    assert_eq!(short, wanted);
    assert_eq!((seen.workgroup, seen.overrides), (64, vec!["scale".to_string()]));
    let other = reflect(TWO_ENTRIES, "other").unwrap();
    assert_eq!((other.bindings.len(), other.workgroup), (1, 256));
    assert!(reflect(TWO_ENTRIES, "none").is_err());
}

fn methods() -> Vec<Method> {
    use crate::method::{ArtificialForm, Density, Gradient, Integrator};
    use crate::smoothing::Smoothing;
    let switches: [fn(&mut Method); 15] = [
        |_| (),
        |m| m.shear = true,
        |m| m.many_bodies = true,
        |m| (m.many_bodies, m.coupling) = (true, true),
        |m| m.constraints = true,
        |m| m.symmetry = true,
        |m| m.periodic = true,
        |m| m.body_force = true,
        |m| m.viscosity = true,
        |m| (m.xsph, m.velocity_filter) = (true, false),
        |m| (m.xsph, m.velocity_filter) = (false, true),
        |m| (m.internal_energy, m.dissipated_energy) = (true, true),
        |m| (m.laws, m.shear, m.integrator) = (vec![Law::Elastic, Law::J2], true, Integrator::Leapfrog),
        |m| m.compensated = true,
        |m| (m.many_bodies, m.body_options) = (true, true),
    ];
    let forms = [None, Some(ArtificialForm::Scalar), Some(ArtificialForm::Principal)];
    let mut list = Vec::new();
    for dimension in 1..=3 {
        for k in 0..2 * 2 * 3 * 3 * 2 {
            let mut method = Method {
                dimension,
                smoothing: Smoothing::ALL[k % Smoothing::ALL.len()],
                integrator: [Integrator::Leapfrog, Integrator::Rk4][k % 2],
                density: [Density::Summation, Density::Continuity][k / 2 % 2],
                gradient: [Gradient::Plain, Gradient::Corrected, Gradient::Adjoint][k / 4 % 3],
                shear: false,
                artificial_stress: forms[k / 12 % 3],
                ..Method::default()
            };
            // Every switch alone, then all that went before it too.
            let together = k / 36 == 1;
            for switch in switches {
                let mut alone = method.clone();
                switch(if together { &mut method } else { &mut alone });
                list.push(if together { method.clone() } else { alone });
            }
        }
    }
    list.extend((1..=3).flat_map(lagrangian_methods));
    list.extend((1..=3).flat_map(corrected_methods));
    list
}

/// Every set of laws, with each switch of the Total Lagrangian formulation alone and with all.
fn lagrangian_methods(dimension: usize) -> Vec<Method> {
    use crate::method::{Density, Descent, Formulation, Gradient, Integrator};
    use crate::smoothing::Smoothing;
    let switches: [fn(&mut Method); 12] = [
        |_| (),
        |m| m.hourglass = true,
        |m| m.gradient = Gradient::Plain,
        |m| m.many_bodies = true,
        |m| (m.many_bodies, m.coupling) = (true, true),
        |m| (m.many_bodies, m.coupling, m.tied, m.viscosity) = (true, true, true, true),
        |m| m.symmetry = true,
        |m| m.periodic = true,
        |m| m.dissipated_energy = m.memory() && m.quasi_static.is_none(),
        |m| (m.many_bodies, m.body_options) = (true, true),
        |m| m.quasi_static = Some(Descent::Fire),
        |m| m.quasi_static = Some(Descent::KineticDamping),
    ];
    let all = [Law::StVenantKirchhoff, Law::NeoHookean, Law::Maxwell, Law::J2];
    let mut list = Vec::new();
    for set in 1..16 {
        let mut together = Method {
            dimension,
            formulation: Formulation::TotalLagrangian,
            laws: all.into_iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|(_, law)| law).collect(),
            smoothing: Smoothing::ALL[set % Smoothing::ALL.len()],
            integrator: Integrator::Leapfrog,
            density: Density::Continuity,
            gradient: Gradient::Adjoint,
            shear: true,
            artificial_stress: None,
            ..Method::default()
        };
        for switch in switches {
            let mut alone = together.clone();
            switch(&mut alone);
            switch(&mut together);
            list.extend([alone, together.clone()]);
        }
    }
    list
}

/// The same by corrected kernels, with every combination of their options.
fn corrected_methods(dimension: usize) -> Vec<Method> {
    use crate::method::{Configuration, CorrectedKernel, Deformation, Formulation, Gradient, Integrator, VelocityGradient};
    let mut list = Vec::new();
    for (k, method) in lagrangian_methods(dimension).into_iter().filter(|method| !method.plastic()).enumerate() {
        let (configuration, deformation) = [
            (Configuration::Current, Deformation::Evolved),
            (Configuration::Current, Deformation::Reference),
            (Configuration::Reference, Deformation::Reference),
        ][k % 3];
        let velocity_gradient = [VelocityGradient::Difference, VelocityGradient::Printed][k / 3 % 2];
        let options = CorrectedKernel { correction: k / 6 % 2 == 0, configuration, deformation, velocity_gradient };
        let integrator = if method.memory() { Integrator::Leapfrog } else { Integrator::SspRk3 };
        let (formulation, corrected_kernel) = (Formulation::CorrectedKernel, Some(options));
        let plain = Method {
            hourglass: false,
            gradient: Gradient::Plain,
            dissipated_energy: false,
            tied: false,
            viscosity: false,
            ..method
        };
        list.push(Method { formulation, corrected_kernel, integrator, ..plain });
    }
    list
}

#[test]
fn every_variant_of_every_pass_is_valid() {
    let mut seen = std::collections::HashSet::new();
    for method in methods() {
        let fields = crate::step::fields(&method);
        for pass in crate::step::passes(&method) {
            let text = compose(pass, &method);
            if !seen.insert(text.clone()) {
                continue;
            }
            let wrong = |error| panic!("{}: {method:?}\n{error}", pass.name());
            let shader = Shader::parse(&text).unwrap_or_else(wrong);
            for entry in pass.entries() {
                for binding in shader.entry(entry.name).unwrap().bindings {
                    let name = binding.name.as_str();
                    let field = crate::fields::Field::ALL.iter().find(|field| field.name() == name);
                    let known = field.map_or(TABLES.contains(&name), |field| fields.contains(field));
                    assert!(known, "{} binds {name}, which {method:?} lacks", pass.name());
                }
            }
        }
    }
    assert!(seen.len() > 300, "{}", seen.len());
}

/// What shaders bind beside the fields.
const TABLES: &[&str] = &[
    "params",
    "clock",
    "balance",
    "bodies",
    "body_options",
    "coupling",
    "constraints",
    "course",
    "contact_pairs",
    "source",
    "destination",
];

#[test]
fn every_file_of_the_library_is_listed() {
    for folder in ["lib", "material"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(folder);
        let files = std::fs::read_dir(path).unwrap().map(|file| file.unwrap().path());
        for stem in files.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()) {
            let listed = LIBRARY.iter().any(|file| file.folder == folder && file.stem == stem);
            let law = folder == "material" && Law::ALL.iter().any(|law| law.word() == stem);
            assert!(listed || law, "{folder}/{stem}.wgsl");
        }
    }
}

#[test]
fn offsets_follow_the_layout_of_the_device() {
    let text = "struct A { x: f32, v: vec3<f32>, n: u32 } @group(0) @binding(0) var<uniform> a: A;";
    let seen = offsets(text, "A").unwrap();
    assert_eq!(seen, [("x".to_string(), 0), ("v".to_string(), 16), ("n".to_string(), 28)]);
    assert!(offsets(text, "B").is_err());
}

#[test]
fn broken_text_is_an_error_that_shows_the_place() {
    let message = validate("fn f() -> f32 { return 1u; }").unwrap_err();
    assert!(message.contains("1u"), "{message}");
}
