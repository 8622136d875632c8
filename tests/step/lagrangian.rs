//! What a Total Lagrangian scene is made of, and what does not go with it.

use lithosph::fields::Field;
use lithosph::pass::Pass;
use lithosph::scene::Scene;
use lithosph::step;

const BLOCK: &str = "
title = 'block'
dimension = 2
spacing = 1.0
duration = 1.0
[[body]]
name = 'block'
shape = { block = { min = [0, 0], max = [6, 6] } }
anchor = [0.5, 0.5]
material = 'rubber'
[material.rubber]
law = 'neo_hookean'
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[formulation]
kind = 'total_lagrangian'
";
const TOUCH: &str = "contact=[{ between = ['block', 'block'], potential = { law = 'barrier', stiffness = 0.5, range = 1.0 } }]";
const MAXWELL: [&str; 2] = ["material.rubber.law='maxwell'", "material.rubber.viscosity=1.0"];
const J2: [&str; 2] = ["material.rubber.law='j2'", "material.rubber.yield_stress=0.1"];

fn parse(changes: &[&str]) -> Result<Scene, String> {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_string()).collect();
    Scene::parse(BLOCK, "block.toml", None, &changes)
}

fn made_of(changes: &[&str]) -> (Vec<Field>, Vec<Pass>) {
    let method = parse(changes).unwrap_or_else(|error| panic!("{error}")).method;
    (step::fields(&method), step::passes(&method))
}

#[test]
fn a_bare_scene_has_the_fields_and_passes_that_it_needs_and_no_others() {
    use Field::*;
    let (fields, _) = made_of(&["formulation.hourglass=0"]);
    let mut expected = vec![
        Number,
        ReferencePosition,
        ReferenceVolume,
        Displacement,
        Velocity,
        Acceleration,
        DisplacementGradient,
        ReferenceCorrection,
        BondStress,
        Cell,
        NeighborCount,
        CellCount,
        CellStart,
        CellBlock,
        CellParticles,
        Neighbors,
        BlockBound,
    ];
    expected.sort_unstable();
    assert_eq!(fields, expected);
    let method = parse(&["formulation.hourglass=0"]).unwrap().method;
    let read_aloud: Vec<&str> = step::step(&method).iter().map(|call| call.pass.name()).collect();
    assert_eq!(read_aloud.join(" "), "kick drift deform bond_force kick bound_time_step");
}

#[test]
fn each_option_adds_its_own_fields_and_passes() {
    let (fields, passes) = made_of(&["formulation.hourglass=0"]);
    let cases: &[(&[&str], &[Field], &[Pass])] = &[
        (&[], &[Field::HourglassEnergy], &[Pass::HourglassEnergy]),
        (&["formulation.viscosity={ alpha = 1.0 }"], &[Field::HourglassEnergy], &[Pass::HourglassEnergy, Pass::BondFriction]),
        (&[MAXWELL[0], MAXWELL[1], "formulation.hourglass=0"], &[Field::InelasticStrain], &[]),
        (&[J2[0], J2[1], "formulation.hourglass=0"], &[Field::InelasticStrain, Field::EquivalentPlasticStrain], &[]),
        (
            &[J2[0], J2[1], "formulation.hourglass=0", "formulation.dissipated_energy=true"],
            &[Field::InelasticStrain, Field::EquivalentPlasticStrain, Field::DissipatedEnergy],
            &[],
        ),
        (
            &["formulation.gradient='quadratic'", "formulation.hourglass=0"],
            &[Field::LinearCoefficient, Field::QuadraticCoefficient, Field::QuadraticStress],
            &[Pass::CorrectQuadratic],
        ),
        (
            &[TOUCH, "formulation.hourglass=0"],
            &[Field::ListedDisplacement, Field::ContactCount, Field::Contacts, Field::ContactRate, Field::ContactEnergy],
            &[Pass::FindContacts, Pass::ContactForce],
        ),
    ];
    for (changes, more_fields, more_passes) in cases {
        let (now_fields, now_passes) = made_of(changes);
        let added: Vec<&Field> = now_fields.iter().filter(|field| !fields.contains(field)).collect();
        assert!(added.len() == more_fields.len() && added.iter().all(|f| more_fields.contains(f)), "{changes:?}: {added:?}");
        let added: Vec<&Pass> = now_passes.iter().filter(|pass| !passes.contains(pass)).collect();
        assert!(added.len() == more_passes.len() && added.iter().all(|p| more_passes.contains(p)), "{changes:?}: {added:?}");
    }
    let (plain, _) = made_of(&["formulation.gradient='plain'", "formulation.hourglass=0"]);
    assert!(!plain.contains(&Field::ReferenceCorrection));
}

#[test]
fn what_does_not_go_together_is_refused_in_one_sentence() {
    let cases: &[(&[&str], &str)] = &[
        (
            &["time.integrator='pefrl'", "formulation.viscosity={ alpha = 1.0 }"],
            "pefrl needs forces that depend on positions alone",
        ),
        (&["time.integrator='pefrl'", MAXWELL[0], MAXWELL[1]], "pefrl needs forces that depend on positions alone"),
        (&["time.integrator='rk4'", MAXWELL[0], MAXWELL[1]], "leapfrog"),
        (&["formulation.kind='eulerian'"], "needs formulation.kind `total_lagrangian`"),
        (&["material.rubber.law='elastic'"], "takes a material whose law is"),
        (&["formulation.xsph=0.5"], "xsph belongs to formulation.kind `eulerian`"),
        (&["formulation.artificial_stress={ epsilon = 0.3 }"], "artificial_stress belongs to formulation.kind `eulerian`"),
        (&["formulation.list_margin=0.2"], "only where bodies touch"),
        (&["formulation.hourglass=-1"], "hourglass must be 0 or a positive number"),
        (&["body.block.relative_volume=0.9"], "starts unstressed"),
        (&["material.rubber.viscosity=1"], "only the law `maxwell` takes"),
        (&["material.rubber.law='maxwell'"], "needs a viscosity"),
        (&["material.rubber.law='j2'"], "needs a yield_stress"),
        (&["material.rubber.yield_stress=0.1"], "only the law `j2` takes"),
        (&["material.rubber.hardening={ linear = 0.1 }"], "only the law `j2` takes"),
        (&[J2[0], "material.rubber.yield_stress=0"], "needs a positive yield_stress"),
        (&[J2[0], J2[1], "material.rubber.hardening={ linear = -0.1 }"], "needs a hardening that is not negative"),
        (
            &[J2[0], J2[1], "material.rubber.hardening={ power = { coefficient = 0.1, exponent = 2 } }"],
            "exponent above 0 and up to 1",
        ),
        (&[J2[0], J2[1], "time.integrator='rk4'"], "leapfrog"),
        (&[J2[0], J2[1], "formulation.kind='eulerian'", "time.integrator='rk2'"], "leapfrog"),
        (&[J2[0], J2[1], "formulation.kind='corrected_kernel'"], "needs formulation.kind `eulerian` or `total_lagrangian`"),
        (&["formulation.gradient='quadratic'", "symmetry=[{ point = [0, 0], normal = [1, 0] }]"], "does not see mirror images"),
        (&[TOUCH, "symmetry=[{ point = [0, 0], normal = [1, 0] }]"], "does not see mirror images"),
        (&["contact=[{ between = ['block', 'block'] }]"], "needs kernel, potential, colour_field, zones, gap, tie or none"),
        (&["contact=[{ between = ['block', 'block'], potential = { law = 'barrier', stiffness = 0, range = 1 } }]"], "positive"),
    ];
    for (changes, sentence) in cases {
        let error = parse(changes).err().unwrap_or_else(|| panic!("{changes:?} is taken"));
        assert!(error.contains(sentence) && !error.contains('\n'), "{changes:?}: {error}");
    }
}
