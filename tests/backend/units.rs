//! Runs in units that f32 cannot hold, against the same runs in others.

use crate::common::parse;
use lithosph::backend::{Choice, Fetched, open};
use lithosph::fields::Field;
use lithosph::scene::Scene;

const FIELDS: [Field; 4] = [Field::Number, Field::ReferencePosition, Field::Displacement, Field::Velocity];

/// Lengths and times are `l` times as long, velocities, stresses and densities the same: then so are strains.
fn impact(l: f64, dimension: i32, eulerian: bool) -> Scene {
    let place = |numbers: &[f64]| {
        let scaled: Vec<String> = numbers[..dimension as usize].iter().map(|x| format!("{:e}", x * l)).collect();
        format!("[{}]", scaled.join(", "))
    };
    let along = |x: f64, y: f64| if dimension == 2 { format!("[{x:e}, {y:e}]") } else { format!("[{x:e}, {y:e}, 0]") };
    let law = if eulerian {
        "law = 'elastic'".to_string()
    } else {
        "pressure = 'linear'\nstrength = { j2 = { yield_stress = 0.02e9, hardening = { linear = 1e9 } } }".to_string()
    };
    let (formulation, touching) = if eulerian {
        ("kind = 'eulerian'\nartificial_stress = { epsilon = 0.3 }\nviscosity = { alpha = 1.0, beta = 2.0 }", String::new())
    } else {
        let touching = format!(
            "[[contact]]\nbetween = ['ball', 'block']\ngap = {{ friction = 0.3 }}
            [[obstacle]]\nname = 'wall'\nshape = {{ plane = {{ point = {}, normal = {} }} }}
            [[boundary]]\nselect = {{ inside = {{ block = {{ min = {}, max = {} }} }} }}\nvelocity = {}\ncourse = [[0, 0], [{:e}, 1]]",
            place(&[0.0, -0.05, 0.0]),
            along(0.0, 1.0),
            place(&[-1.0, -1.0, -1.0]),
            place(&[1.01, 9.0, 9.0]),
            along(3.0, 0.0),
            2e-3 * l
        );
        ("kind = 'total_lagrangian'\nhourglass = 0.1\nviscosity = { alpha = 0.1 }", touching)
    };
    parse(&format!(
        "title = 'an impact'\ndimension = {dimension}\nspacing = {:e}\nduration = {:e}\nbody_force = {}
        [[body]]\nname = 'block'\nshape = {{ block = {{ min = {}, max = {} }} }}\npacking = 'fitted'\nmaterial = 'steel'
        [[body]]\nname = 'ball'\nshape = {{ block = {{ min = {}, max = {} }} }}\npacking = 'fitted'\nmaterial = 'steel'
        velocity = {}
        [material.steel]\n{law}\ndensity = 1000.0\nyoungs_modulus = 1e9\npoisson_ratio = 0.3
        [formulation]\n{formulation}\n{touching}",
        1.0 * l,
        0.02 * l,
        along(0.0, -10.0 / l),
        place(&[0.0, 0.0, 0.0]),
        place(&[9.0, 4.0, 2.0]),
        place(&[3.0, 4.3, 0.0]),
        place(&[7.0, 7.3, 2.0]),
        along(1.0, -60.0),
    ))
}

fn run(scene: &Scene, choice: &Choice) -> Option<Fetched> {
    let mut backend = open(scene, choice).ok()?;
    for (duration, first) in [(0.0, true), (scene.file.duration, false)] {
        backend.begin_segment(0.0, duration, u32::MAX, first).unwrap();
        loop {
            let clock = backend.advance().unwrap();
            assert_eq!(clock.fault, 0, "{} stopped at step {}", scene.label(), clock.steps_done);
            if clock.running == 0 {
                assert!((clock.elapsed - duration).abs() <= 1e-5 * duration);
                break;
            }
        }
    }
    backend.fetch(&FIELDS).ok()
}

/// Displacements over the unit of length, by the number of the particle.
fn displacements(columns: &Fetched, l: f64) -> Vec<f64> {
    let width = columns[&Field::Displacement].len() / columns[&Field::Number].len();
    let mut rows: Vec<(u32, &[f64])> =
        columns[&Field::Number].iter().map(|&n| n as u32).zip(columns[&Field::Displacement].chunks(width)).collect();
    rows.sort_by_key(|row| row.0);
    rows.into_iter().flat_map(|(_, u)| u.iter().map(move |x| x / l)).collect()
}

#[test]
fn units_that_f32_cannot_hold_lose_no_digits() {
    for (dimension, eulerian) in [(2, false), (3, false), (2, true), (3, true)] {
        for choice in [Choice::Cpu32, Choice::Gpu(None)] {
            let error = |l: f64| {
                let scene = impact(l, dimension, eulerian);
                let [truth, found] =
                    [run(&scene, &Choice::Cpu)?, run(&scene, &choice)?].map(|columns| displacements(&columns, l));
                let size = truth.iter().fold(0.0f64, |most, u| most.max(u.abs()));
                assert!(size > 0.3, "nothing moves: {size}");
                Some(found.iter().zip(&truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size)
            };
            let Some(usual) = error(1.0) else { continue };
            for l in [1e-9, 1e9] {
                let scaled = error(l).expect("the same machine runs");
                assert!(scaled < 3.0 * usual, "{dimension}D at {l} on {choice:?}: off by {scaled}, and by {usual} at 1");
            }
        }
    }
}
