//! What a Total Lagrangian moment tells on the host: stress in all six components, pressure, density and energy
//! from the deformation gradient and what the law remembers.

use crate::common::deformation::body;
use crate::common::parse;
use lithosph::backend::Fetched;
use lithosph::fields::Field;
use lithosph::material::{Law, inelastic, stored_energy};
use lithosph::observable::{Moment, Value, fields_of_path, fields_read, observers};
use lithosph::scene::Scene;
use lithosph::tensor::{Plane, Tuple};

fn text(dimension: usize, law: Law, more: &str) -> String {
    let corner = |x: f64| format!("{:?}", vec![x; dimension]);
    let viscosity = if law.has_memory() { "viscosity = 1.0" } else { "" };
    format!(
        "title = 'block'
        dimension = {dimension}
        spacing = 0.5
        duration = 1.0
        [[body]]
        name = 'block'
        shape = {{ block = {{ min = {}, max = {} }} }}
        anchor = {}
        material = 'stuff'
        velocity = {}
        [material.stuff]
        law = '{}'
        density = 3.0
        bulk_modulus = 5.833
        shear_modulus = 1.25
        {viscosity}
        [observe]
        total = {{ kind = 'total_energy' }}
        elastic = {{ kind = 'elastic_energy' }}
        stress = {{ kind = 'mean', field = 'stress.zz' }}
        density = {{ kind = 'largest', field = 'density' }}
        [formulation]
        kind = 'total_lagrangian'
        {more}",
        corner(0.0),
        corner(1.0),
        corner(0.25),
        corner(2.0),
        law.word()
    )
}

/// The same numbers for every particle.
fn columns(scene: &Scene, rows: &[(Field, &[f64])]) -> Fetched {
    let count = scene.particles.len();
    let numbers = (Field::Number, (0..count).map(|i| i as f64).collect());
    rows.iter().map(|(field, row)| (*field, row.repeat(count))).chain([numbers]).collect()
}

fn linear_elastic(dimension: usize, h: &[f64]) {
    for law in [Law::StVenantKirchhoff, Law::NeoHookean, Law::Maxwell] {
        let scene = parse(&text(dimension, law, ""));
        let fetched = columns(&scene, &[(Field::DisplacementGradient, h)]);
        let moment = Moment::new(&scene, 0.0, 0, &fetched);
        let stride = h.len() / dimension;
        let at = |i: usize, j: usize| if i < dimension && j < dimension { h[j * stride + i] } else { 0.0 };
        let trace = at(0, 0) + at(1, 1) + at(2, 2);
        let lambda = 5.833 - 2.0 / 3.0 * 1.25;
        let normal = |k: usize| lambda * trace + 2.5 * at(k, k);
        let shear = |i: usize, j: usize| 1.25 * (at(i, j) + at(j, i));
        let wanted = [normal(0), normal(1), normal(2), shear(0, 1), shear(1, 2), shear(0, 2)];
        for (seen, wanted) in moment.stress(1).into_iter().zip(wanted) {
            assert!((seen - wanted).abs() < 1e-8, "{law:?} in {dimension}D: {seen:e}, not {wanted:e}");
        }
        assert!((moment.pressure(1) + 5.833 * trace).abs() < 1e-8);
        assert!((moment.volumetric_strain(1) / trace - 1.0).abs() < 1e-4);
        assert!((moment.path("density", &[0])[0] / (3.0 - 3.0 * trace) - 1.0).abs() < 1e-8);
    }
}

#[test]
fn small_strains_give_linear_elastic_stress() {
    linear_elastic(1, &[1e-5]);
    linear_elastic(2, &[1e-5, 3e-6, -7e-6, 2e-6]);
    linear_elastic(3, &[1e-5, 3e-6, -2e-6, 0.0, -7e-6, 2e-6, 1e-6, 0.0, 4e-6, 5e-6, 3e-6, 0.0]);
}

#[test]
fn energies_count_memory_and_heat() {
    let scene = parse(&text(2, Law::Maxwell, "dissipated_energy = true"));
    let (h, memory) = ([0.2, -0.1, 0.15, 0.05], [0.1, -0.05, 0.03]);
    let rows: [(Field, &[f64]); 4] = [
        (Field::DisplacementGradient, &h),
        (Field::InelasticStrain, &memory),
        (Field::Velocity, &[2.0, 2.0]),
        (Field::DissipatedEnergy, &[0.7]),
    ];
    let fetched = columns(&scene, &rows);
    let moment = Moment::new(&scene, 0.0, 0, &fetched);
    let observers = observers(&scene);
    let value = |name: &str| {
        let observer = observers.iter().find(|observer| observer.name == name).unwrap();
        match observer.kind.value {
            Value::Series(value) => value(&moment, observer),
            _ => f64::NAN,
        }
    };
    // Area 1, so mass 3.
    let elastic = stored_energy::<Plane<f64>>(&body(Law::Maxwell), Tuple(h), Tuple(memory));
    assert!((value("elastic") - elastic).abs() < 1e-14, "{} {elastic}", value("elastic"));
    assert!((value("total") - (elastic + 3.0 * 4.0 + 3.0 * 0.7)).abs() < 1e-12);
    let viscous = inelastic::whole::<Plane<f64>>(Tuple(memory));
    let determinant = ((1.1 * 0.95) - 0.03 * 0.03) * (1.0 + viscous.across);
    assert!((determinant - 1.0).abs() < 1e-15);
}

#[test]
fn observables_read_what_the_formulation_has() {
    let metal = parse(&text(2, Law::J2, "").replace("viscosity = 1.0", "yield_stress = 1.0"));
    assert_eq!(fields_of_path(&metal, "equivalent_plastic_strain"), [Field::EquivalentPlasticStrain]);
    let fetched = columns(&metal, &[(Field::EquivalentPlasticStrain, &[0.3]), (Field::Displacement, &[0.0, 0.0])]);
    assert_eq!(Moment::new(&metal, 0.0, 0, &fetched).path("equivalent_plastic_strain", &[0]), [0.3]);
    for (law, memory) in [(Law::NeoHookean, false), (Law::Maxwell, true)] {
        let scene = parse(&text(2, law, ""));
        let fields = fields_read(&observers(&scene), &scene);
        assert!(fields.contains(&Field::DisplacementGradient) && !fields.contains(&Field::VolumetricStrain));
        assert_eq!(fields.contains(&Field::InelasticStrain), memory);
    }
}

#[test]
fn what_memory_cannot_do_is_refused() {
    let refused = |text: &str, sentence: &str| {
        let error = Scene::parse(text, "test", None, &[]).err().unwrap_or_else(|| panic!("not refused: {text}"));
        assert!(error.contains(sentence), "{error}");
    };
    for integrator in ["rk2", "ssp_rk3", "rk4", "pefrl"] {
        let time = format!("[time]\nintegrator = '{integrator}'");
        refused(
            &text(2, Law::Maxwell, &time),
            if integrator == "pefrl" { "pefrl needs" } else { "only the integrator leapfrog" },
        );
    }
    refused(&text(2, Law::NeoHookean, "dissipated_energy = true"), "names no viscosity");
}
