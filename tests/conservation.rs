//! What no formulation may lose: momentum, mass, and the same answer twice. Every scene without walls is
//! run for a short while; what its physics gives is the business of `scenes.rs`.

use crate::common::{scene_file, scene_files};
use lithosph::backend::{Choice, Fetched, open};
use lithosph::fields::Field;
use lithosph::method::Gradient;
use lithosph::observable::Moment;
use lithosph::scene::Scene;

const FIELDS: [Field; 4] = [Field::Number, Field::ReferenceVolume, Field::Displacement, Field::Velocity];

/// Time a run is given, in h/c of its first body: past the first contact of every scene.
const CROSSINGS: f64 = 30.0;

/// Scenes on which nothing outside acts.
fn free_scenes() -> Vec<Scene> {
    let scenes = scene_files().into_iter().map(|path| Scene::open(&path, None, &[]).expect("the scene is good"));
    let walls = |s: &Scene| !(s.file.boundary.is_empty() && s.file.symmetry.is_empty() && s.obstacles.is_empty());
    let free = |s: &Scene| !walls(s) && s.file.body_force.is_none();
    scenes.filter(free).collect()
}

fn scene(name: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(|o| (*o).to_string()).collect();
    Scene::open(&scene_file(name), None, &overrides).expect("the scene is good")
}

/// State after a short run; none where there is no such backend.
fn short_run(scene: &Scene, choice: &Choice) -> Option<Fetched> {
    let mut backend = open(scene, choice).ok()?;
    let body = &scene.bodies[0];
    let duration = scene.file.duration.min(CROSSINGS * body.smoothing_length / body.material.sound_speed());
    for (length, first) in [(0.0, true), (duration, false)] {
        backend.begin_segment(0.0, length, u32::MAX, first).expect("a segment begins");
        loop {
            let clock = backend.advance().expect("the run advances");
            assert_eq!(clock.fault, 0, "{} stopped", scene.label());
            if clock.running == 0 {
                break;
            }
        }
    }
    Some(backend.fetch(&FIELDS).expect("the state comes back"))
}

/// Largest change of a component of momentum, over the sum of m|v| at the start, or of m c for bodies at rest.
fn momentum_drift(scene: &Scene, columns: &Fetched) -> f64 {
    let moment = Moment::new(scene, 0.0, 0, columns);
    let (mut change, mut scale, mut at_rest) = ([0.0; 3], 0.0, 0.0);
    for (i, particle) in scene.particles.iter().enumerate() {
        let now = moment.vector(Field::Velocity, i);
        for k in 0..3 {
            change[k] += scene.mass(i) * (now[k] - particle.velocity[k]);
        }
        scale += scene.mass(i) * particle.velocity.length();
        at_rest += scene.mass(i) * scene.bodies[particle.body as usize].material.sound_speed();
    }
    let scale = if scale > 0.0 { scale } else { at_rest };
    change.iter().fold(0.0, |largest: f64, c| largest.max(c.abs())) / scale
}

#[test]
fn momentum_is_kept_to_rounding_in_double_precision() {
    for scene in free_scenes() {
        let columns = short_run(&scene, &Choice::Cpu).expect("there is a CPU");
        let drift = momentum_drift(&scene, &columns);
        assert!(drift < 1e-12, "{}: momentum drifts by {drift:e}", scene.label());
    }
}

#[test]
fn momentum_is_kept_to_rounding_in_single_precision() {
    for scene in free_scenes() {
        let columns = short_run(&scene, &Choice::Cpu32).expect("there is a CPU");
        let drift = momentum_drift(&scene, &columns);
        assert!(drift < 1e-6, "{}: momentum drifts by {drift:e}", scene.label());
    }
}

#[test]
fn momentum_is_kept_to_rounding_on_a_gpu() {
    for scene in free_scenes() {
        let Some(columns) = short_run(&scene, &Choice::Gpu(None)) else {
            eprintln!("skipped: no Vulkan adapter");
            return;
        };
        let drift = momentum_drift(&scene, &columns);
        assert!(drift < 1e-6, "{}: momentum drifts by {drift:e}", scene.label());
    }
}

#[test]
fn the_adjoint_form_keeps_angular_momentum_and_the_plain_one_does_not() {
    let drift = |gradient: &str| {
        let scene = scene("rotating_disc", &[&format!("formulation.gradient={gradient}")]);
        let columns = short_run(&scene, &Choice::Cpu).expect("there is a CPU");
        let moment = Moment::new(&scene, 0.0, 0, &columns);
        let (mut change, mut scale) = (0.0, 0.0);
        for (i, particle) in scene.particles.iter().enumerate() {
            let (x, v) =
                (glam::DVec3::from_array(moment.position(i)), glam::DVec3::from_array(moment.vector(Field::Velocity, i)));
            change += scene.mass(i) * (x.cross(v) - particle.position.cross(particle.velocity)).z;
            scale += scene.mass(i) * particle.position.length() * particle.velocity.length();
        }
        (scene.method.gradient, change.abs() / scale)
    };
    let (gradient, adjoint) = drift("adjoint");
    assert_eq!(gradient, Gradient::Adjoint);
    assert!(adjoint < 1e-12, "the adjoint form loses {adjoint:e}");
    let (_, plain) = drift("plain");
    assert!(plain > 1e-4, "the plain form is known to lose angular momentum, and lost {plain:e}");
}

#[test]
fn no_particle_is_lost_or_changes_its_mass() {
    for scene in free_scenes() {
        let columns = short_run(&scene, &Choice::Cpu).expect("there is a CPU");
        let mut seen = vec![0; scene.particles.len()];
        for (number, volume) in columns[&Field::Number].iter().zip(&columns[&Field::ReferenceVolume]) {
            seen[*number as usize] += 1;
            assert_eq!(*volume, scene.particles[*number as usize].volume, "{}: particle {number}", scene.label());
        }
        assert!(seen.iter().all(|&count| count == 1), "{}: a particle is lost or doubled", scene.label());
    }
}

#[test]
fn repeated_runs_give_the_same_bits_on_any_number_of_threads() {
    let scene = scene("colliding_rings", &[]);
    let bits = |threads: usize| -> Vec<u64> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        let columns = pool.install(|| short_run(&scene, &Choice::Cpu)).expect("there is a CPU");
        columns.values().flatten().map(|x| x.to_bits()).collect()
    };
    let first = bits(1);
    assert!(first == bits(1), "a repeated run differs");
    assert!(first == bits(2), "a run on two threads differs from one on one");
}
