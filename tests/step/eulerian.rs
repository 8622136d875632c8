//! What an Eulerian scene is made of, and what symmetry, boundaries and contact do in it.

use lithosph::backend::Choice;
use lithosph::backend::cpu::Cpu;
use lithosph::fields::Field;
use lithosph::pass::Pass;
use lithosph::run::{Options, run};
use lithosph::scene::Scene;
use lithosph::step;
use lithosph::tensor::Plane;

pub const DISC: &str = r#"
title = "disc"
dimension = 2
units = "dimensionless"
spacing = 1.0
duration = 20.0
[[body]]
name = "disc"
shape = { disc = { center = [0, 0], radius = 9.3 } }
packing = "fitted"
material = "rubber"
[material.rubber]
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[formulation]
smoothing_length = 1.4
"#;

pub fn scene(text: &str, changes: &[&str]) -> Scene {
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_string()).collect();
    Scene::parse(text, "test", None, &changes).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn an_elastic_scene_has_the_fields_of_elasticity_and_no_others() {
    let scene = scene(DISC, &[]);
    let cpu = Cpu::new(scene.state::<Plane<f64>>(false));
    use Field::*;
    let expected = [
        Number,
        ReferencePosition,
        ReferenceVolume,
        Displacement,
        Velocity,
        Acceleration,
        VolumetricStrain,
        DeviatoricStress,
        VelocityGradient,
        SpecificStress,
        ListedDisplacement,
        Cell,
        NeighborCount,
        CellCount,
        CellStart,
        CellBlock,
        CellParticles,
        Neighbors,
        BlockBound,
    ];
    assert_eq!(cpu.members[0].columns.present(), expected.iter().copied().fold(Vec::new(), sorted_in));
    let passes: Vec<&str> = step::step(&scene.method).iter().map(|c| c.pass.name()).collect();
    let read_aloud = "kick drift bin_cells scan_cells fill_cells sort_cells find_neighbors \
                      strain_rate stress drift specific_stress force kick bound_time_step";
    assert_eq!(passes.join(" "), read_aloud);
}

/// Inserts in the order of the fields' list.
fn sorted_in(mut list: Vec<Field>, field: Field) -> Vec<Field> {
    let place = list.partition_point(|f| *f < field);
    list.insert(place, field);
    list
}

#[test]
fn each_option_adds_exactly_its_own_fields_and_passes() {
    let plain = scene(DISC, &[]);
    let cases: &[(&[&str], &[Field], &[Pass])] = &[
        (&["formulation.viscosity={alpha=1.0}"], &[], &[]),
        (&["formulation.xsph=0.5"], &[Field::SmoothedVelocity], &[Pass::SmoothVelocity]),
        (&["formulation.velocity_filter=0.5"], &[Field::SmoothedVelocity], &[Pass::SmoothVelocity, Pass::FilterVelocity]),
        (&["formulation.artificial_stress={epsilon=0.3}"], &[Field::ArtificialStress], &[]),
        (&["formulation.artificial_stress={form=\"scalar\",epsilon=0.3}"], &[Field::ArtificialPressure], &[]),
        (&["formulation.internal_energy=true"], &[Field::InternalEnergy, Field::InternalPower], &[]),
        (
            &["formulation.viscosity={alpha=1.0}", "formulation.dissipated_energy=true"],
            &[Field::DissipatedEnergy, Field::DissipatedPower],
            &[],
        ),
        (&["formulation.density=summation"], &[], &[Pass::SumDensity]),
        (&["formulation.gradient=corrected"], &[], &[]),
        (&["body_force=[0,-1]"], &[], &[]),
    ];
    for (changes, fields, passes) in cases {
        let changed = scene(DISC, changes);
        let (before, after) = (step::fields(&plain.method), step::fields(&changed.method));
        let new: Vec<Field> = after.iter().copied().filter(|f| !before.contains(f)).collect();
        assert_eq!(new, *fields, "{changes:?}");
        let (before, after) = (step::passes(&plain.method), step::passes(&changed.method));
        let new: Vec<Pass> = after.iter().copied().filter(|p| !before.contains(p)).collect();
        assert!(new.len() == passes.len() && new.iter().all(|p| passes.contains(p)), "{changes:?}: {new:?}");
        for pass in step::passes(&changed.method) {
            let shader = lithosph::backend::shader::compose(pass, &changed.method);
            let viscous = changed.method.viscosity;
            assert!(viscous || !shader.contains("fn viscosity"), "{changes:?}: viscosity in {}", pass.name());
        }
    }
}

fn final_value(scene: &Scene, name: &str) -> f64 {
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
    let finished = run(scene, &options).unwrap_or_else(|e| panic!("{e:?}"));
    finished.table.columns[name].last().copied().unwrap_or(f64::NAN)
}

#[test]
fn a_symmetry_plane_stands_for_the_other_half() {
    let text = r#"
title = "a block squeezed by its own inertia"
dimension = 2
units = "dimensionless"
spacing = 1.0
duration = 25.0
[[body]]
name = "block"
shape = { block = { min = [-10, -6], max = [10, 6] } }
anchor = [0.5, 0.5]
material = "rubber"
motion = { gradient = [[-0.004, 0], [0, 0.002]] }
[material.rubber]
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[formulation]
smoothing_length = 1.3
viscosity = { alpha = 0.5 }
xsph = 0.2
artificial_stress = { epsilon = 0.2 }
[observe]
corner = { kind = "probe", field = "displacement.x", at = [9.5, 5.5] }
side = { kind = "probe", field = "stress.xx", at = [0.5, 0.5] }
"#;
    let half = "body.block.shape={block={min=[0,-6],max=[10,6]}}";
    let quarter = "body.block.shape={block={min=[0,0],max=[10,6]}}";
    let x_plane = "symmetry=[{point=[0,0],normal=[1,0]}]";
    let both = "symmetry=[{point=[0,0],normal=[1,0]},{point=[0,0],normal=[0,1]}]";
    for gradient in ["formulation.gradient=plain", "formulation.gradient=adjoint"] {
        let whole = scene(text, &[gradient]);
        for changes in [[gradient, half, x_plane], [gradient, quarter, both]] {
            let part = scene(text, &changes);
            for name in ["corner", "side"] {
                let (a, b) = (final_value(&whole, name), final_value(&part, name));
                assert!((a - b).abs() < 1e-10 * a.abs().max(1e-3), "{changes:?} {name}: {a} {b}");
            }
        }
    }
}

#[test]
fn prescribed_velocities_and_forces_follow_their_course() {
    let course = "[[0,0],[10,1],[20,1]]";
    let pulled = scene(
        DISC,
        &[
            &format!("boundary=[{{select={{body=\"disc\"}},velocity=[0.01,\"free\"],course={course}}}]"),
            "observe.u={kind=\"mean_position\",axis=\"x\"}",
        ],
    );
    // The area under the course is 5 + 10; leapfrog takes it at the middle of each step, so kinks cost a little.
    assert!((final_value(&pulled, "u") - 0.15).abs() < 1e-4);
    let pushed =
        scene(DISC, &["boundary=[{select={body=\"disc\"},force=[0,2]}]", "observe.v={kind=\"mean_velocity\",axis=\"y\"}"]);
    let mass = std::f64::consts::PI * 9.3 * 9.3;
    assert!((final_value(&pushed, "v") - 2.0 * 20.0 / mass).abs() < 1e-12);
}

#[test]
fn weakened_contact_scales_the_force_between_bodies() {
    let text = r#"
title = "two blocks that overlap their kernels"
dimension = 2
spacing = 1.0
duration = 0.01
[[body]]
name = "left"
shape = { block = { min = [-5, -3], max = [0, 3] } }
anchor = [0.5, 0.5]
material = "m"
relative_volume = 0.99
[[body]]
name = "right"
shape = { block = { min = [0, -3], max = [5, 3] } }
anchor = [0.5, 0.5]
material = "m"
relative_volume = 0.99
[material.m]
law = "fluid"
density = 1.0
bulk_modulus = 1.0
[observe]
push = { kind = "force", body = "right", axis = "x" }
"#;
    let force = |changes: &[&str]| final_value(&scene(text, changes), "push");
    let (full, half) = (force(&[]), force(&["contact=[{between=[\"left\",\"right\"],kernel=0.5}]"]));
    let none = force(&["contact=[{between=[\"left\",\"right\"],kernel=0.0}]"]);
    assert!(full > 1e-3 && (half / full - 0.5).abs() < 1e-3 && none.abs() < 1e-12, "{full} {half} {none}");
}
