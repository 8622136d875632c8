use super::*;
use crate::method::Integrator;
use crate::scene::Scene;
use crate::step::{amplification, longest_step};

const BASE: &str = "
    title = 'a lattice'
    dimension = 2
    units = 'dimensionless'
    spacing = 1.0
    duration = 1.0
    [[body]]
    name = 'block'
    shape = { block = { min = [-0.5, -0.5, -0.5], max = [9.5, 9.5, 9.5] } }
    material = 'medium'
    [material.medium]
    law = 'neo_hookean'
    density = 1.3
    youngs_modulus = 2.0
    poisson_ratio = 0.3
    [formulation]
    kind = 'total_lagrangian'
    smoothing_length = 1.3
    ";

fn scene(overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(|s| s.to_string()).collect();
    Scene::parse(BASE, "lattice", None, &overrides).unwrap()
}

fn setting(overrides: &[&str]) -> Setting {
    Setting::new(&scene(overrides)).unwrap()
}

const COMPRESSED: [&str; 3] = [
    "study.stability.deformation=[[0.9]]",
    "study.stability.deformation=[[0.9, 0.05], [-0.02, 1.1]]",
    "study.stability.deformation=[[0.9, 0.05, 0.0], [-0.02, 1.1, 0.03], [0.01, 0.0, 0.95]]",
];
const DAMAGED: [&str; 3] =
    ["study.stability.damage=[0.3]", "study.stability.damage=[0.3, 0.7]", "study.stability.damage=[0.3, 0.7, 0.1]"];

#[test]
fn a_lattice_is_written_as_a_scene_and_read_back() {
    for overrides in [&["formulation.smoothing=wendland"][..], &["formulation.hourglass=0.1", "dimension=3"], &["dimension=1"]] {
        let (scene, setting) = (scene(overrides), setting(overrides));
        let again = simulate::parsed(&setting.file).unwrap();
        assert_eq!(again.method, scene.method);
        assert_eq!(again.particles.len(), scene.particles.len());
        assert_eq!(again.bodies[0].smoothing_length, scene.bodies[0].smoothing_length);
    }
}

/// Deformed and damaged, with every form of the gradient: the passes' forces against A(k).
#[test]
fn lagrangian_stiffness_is_the_derivative_of_the_passes_forces() {
    let waves = [[1.0, 2.0, -1.0], [3.0, -2.0, 1.0], [4.0, 4.0, 0.0]];
    let mut worst = 0.0_f64;
    for dimension in 1..=3 {
        let size = format!("dimension={dimension}");
        let (compressed, damaged) = (COMPRESSED[dimension - 1], DAMAGED[dimension - 1]);
        let cases = [
            vec![],
            vec!["formulation.gradient=plain", compressed],
            vec!["formulation.hourglass=0", compressed],
            vec!["formulation.gradient=quadratic", compressed],
            vec!["material.medium.law=st_venant_kirchhoff", compressed, damaged],
            vec!["formulation.smoothing_length=1.6", compressed, damaged, "study.stability.whole_correction=true"],
        ];
        for (overrides, numbers) in cases.iter().flat_map(|case| waves.iter().map(move |wave| (case, wave))) {
            let overrides: Vec<&str> = overrides.iter().copied().chain([size.as_str()]).collect();
            let setting = setting(&overrides);
            let cells = 8;
            let wave = glam::DVec3::from_array(std::array::from_fn(|axis| {
                if axis < dimension { numbers[axis] * std::f64::consts::TAU / cells as f64 } else { 0.0 }
            }));
            let xi =
                glam::DVec3::from_array(std::array::from_fn(|axis| if axis < dimension { [0.6, -0.5, 0.7][axis] } else { 0.0 }));
            let counts = std::array::from_fn(|axis| if axis < dimension { cells } else { 1 });
            let error = halo::tests::error(&setting, counts, wave, xi);
            assert!(error < 1e-6, "{overrides:?} {numbers:?}: {error:e}");
            worst = worst.max(error);
        }
    }
    println!("largest relative error {worst:e}");
}

#[test]
fn oscillators_have_the_limits_of_the_textbooks() {
    let method = scene(&[]).method;
    let limits = [
        (Integrator::Leapfrog, 2.0, 1e-6),
        (Integrator::Rk2, 0.0, 0.0),
        (Integrator::SspRk3, 3f64.sqrt(), 1e-6),
        (Integrator::Rk4, 8f64.sqrt(), 1e-6),
        // Omelyan, Mryglod & Folk's own figure, to its digits.
        (Integrator::Pefrl, 2.990, 1e-3),
    ];
    for (integrator, limit, tolerance) in limits {
        let found = longest_step(&method, integrator);
        assert!((found - limit).abs() <= tolerance, "{integrator:?}: {found}");
    }
    let growth = amplification(&method, Integrator::Rk2, 0.1) - 1.0;
    assert!((growth / (0.1f64.powi(4) / 8.0) - 1.0).abs() < 1e-3, "{growth}");
}

/// Largest frequency of the discrete equations against runs of thousands of steps.
#[test]
fn runs_grow_from_the_computed_step_on() {
    for overrides in [&["dimension=1"][..], &["dimension=2", "formulation.smoothing=wendland"]] {
        let setting = setting(overrides);
        let found = limits(&setting, |_| {}).unwrap();
        assert_eq!(found.len(), 4);
        for limit in found {
            println!("{limit:?} {:.4}", limit.ratio());
            assert!((limit.ratio() - 1.0).abs() < 0.05, "{limit:?}");
        }
        let growth = secular(&setting).unwrap();
        println!("{growth:?}");
        assert!((growth.measured / growth.computed - 1.0).abs() < 0.01, "{growth:?}");
        // What the textbooks say of small steps.
        assert!((growth.computed / (growth.omega_step.powi(4) / 8.0) - 1.0).abs() < 0.02, "{growth:?}");
    }
}

#[test]
fn long_waves_run_at_the_speeds_of_the_law() {
    for dimension in 1..=3 {
        for law in ["neo_hookean", "st_venant_kirchhoff"] {
            let (size, law) = (format!("dimension={dimension}"), format!("material.medium.law={law}"));
            let setting = setting(&[&size, &law]);
            let direction = [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0], [0.48, 0.64, 0.6]][dimension - 1];
            let k = 0.02;
            let modes = setting.waves().modes(direction.map(|x| x * k));
            let (bulk, shear): (f64, f64) = (2.0 / 1.2, 2.0 / 2.6);
            for (rank, mode) in modes.iter().rev().enumerate() {
                let modulus = if rank == 0 { bulk + 4.0 / 3.0 * shear } else { shear };
                let speed = (modulus / 1.3).sqrt();
                assert!((mode.frequency / k / speed - 1.0).abs() < 1e-3 && mode.rate == 0.0, "{dimension}D {mode:?} {speed}");
            }
        }
    }
}

/// Without the hourglass energy the sawtooth costs nothing, where a long wave's speed would give a frequency of pi c/dx.
#[test]
fn the_sawtooth_costs_no_energy_without_hourglass_control() {
    use std::f64::consts::PI;
    for k in [[PI, 0.0, 0.0], [PI, PI, 0.0]] {
        let bare = setting(&["formulation.hourglass=0"]);
        let controlled = setting(&[]);
        let unit = bare.unit_rate();
        assert!(bare.waves().mode(k).frequency < 1e-6 * unit, "{k:?}");
        assert!(controlled.waves().mode(k).frequency > unit, "{k:?}");
        let run = simulate(&bare, 8, k).unwrap();
        assert!(run.rate < 1e-3 * unit && run.frequency < 1e-3 * unit, "{run:?}");
    }
}

/// In plane strain the transverse modulus of the isotropically compressed law, mu s^2 + (lambda + mu)(s^2 - 1), is zero
/// at s = 0.845 for a Poisson ratio of 0.3. A neo-Hookean body is stable from 0.6 to 2.
#[test]
fn st_venant_kirchhoff_fails_in_compression_and_neo_hookean_does_not() {
    let fastest = |law: &str, stretch: f64| {
        let law = format!("material.medium.law={law}");
        let state = format!("study.stability.deformation=[[{stretch:?}, 0], [0, {stretch:?}]]");
        let setting = setting(&[&law, &state]);
        growth(&setting, 24).mode.rate / setting.unit_rate()
    };
    assert!(fastest("st_venant_kirchhoff", 0.8) > 0.08);
    assert!(fastest("st_venant_kirchhoff", 0.835) > 0.01);
    assert_eq!(fastest("st_venant_kirchhoff", 0.855), 0.0);
    for stretch in [0.6, 0.8, 1.0, 1.5, 2.0] {
        assert_eq!(fastest("neo_hookean", stretch), 0.0, "{stretch}");
    }
}

#[test]
fn runs_do_as_theory_says() {
    let collapsing = "study.stability.deformation=[[0.8, 0], [0, 0.8]]";
    let sheared = "study.stability.deformation=[[1.2, 0.3], [0, 0.9]]";
    let cases = [
        vec!["material.medium.law=st_venant_kirchhoff", collapsing],
        vec![sheared],
        vec![sheared, "study.stability.damage=[0.6, 0.1]"],
        vec!["formulation.kind=eulerian", "material.medium.law=elastic", "body.block.relative_volume=1.02"],
        vec![
            "formulation.kind=eulerian",
            "material.medium.law=elastic",
            "body.block.relative_volume=1.02",
            "formulation.xsph=0.5",
        ],
        vec![sheared, "formulation.viscosity={alpha=0.2}"],
        vec![
            "formulation.kind=eulerian",
            "material.medium.law=elastic",
            "body.block.relative_volume=1.02",
            "formulation.viscosity={alpha=0.2}",
        ],
    ];
    for case in &cases {
        let setting = setting(case);
        let cells = 12;
        let vectors = setting.wave_vectors(cells);
        let (fastest, _) = setting.waves().fastest(&vectors);
        for wave in [fastest, vectors[5], vectors[40]] {
            let run = simulate(&setting, cells, wave).unwrap();
            println!("{case:?} {run:?}");
            let tolerance = if setting.dissipates() { 0.03 } else { 0.01 };
            assert!(run.difference.abs() < tolerance, "{case:?} {run:?}");
        }
    }
}

/// A correction made of the damaged bonds finds the gradient all the same, so that the body stays as stiff; one of
/// whole bonds sees the part of the strain that the bonds still carry. An hourglass energy, whose fit is then not the
/// gradient, would stiffen it again.
#[test]
fn weakened_bonds_soften_a_body_only_where_the_correction_is_that_of_whole_ones() {
    let speed = |overrides: &[&str]| {
        let bare = ["dimension=1", "formulation.hourglass=0", "study.stability.damage=[0.3]"];
        let setting = setting(&[overrides, &bare].concat());
        setting.mode([0.01, 0.0, 0.0]).frequency / 0.01 / setting.sound_speed()
    };
    assert!((speed(&[]) - 1.0).abs() < 1e-4);
    assert!((speed(&["study.stability.whole_correction=true"]) - 0.7).abs() < 1e-4);
}
