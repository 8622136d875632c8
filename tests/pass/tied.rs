//! Bodies that are tied: what their bonds must do exactly.

use super::lagrangian::{assert_force_is_the_gradient_of_the_energy, begun, respond};
use crate::common::{Random, in_order, largest, parse, steps};
use lithosph::backend::cpu::Cpu;
use lithosph::fields::Field;
use lithosph::rows::BodyOptions;
use lithosph::scene::Scene;
use lithosph::tensor::{Line, Plane, Solid, Space};

const LAWS: [&str; 2] = ["law = 'neo_hookean'", "law = 'st_venant_kirchhoff'"];

/// A block of which a part in the middle of one face, a piece of the lattice, is another body, with a corner in its material.
/// `ratio` is its Young's modulus; its density is twice as large as that of the rest.
pub fn blocks(dimension: usize, ratio: f64, laws: [&str; 2], formulation: &str) -> Scene {
    let shape = |k: usize| match (dimension, k) {
        (1, 0) => "{ block = { min = [0], max = [12] } }",
        (1, _) => "{ block = { min = [12], max = [21] } }",
        (2, 0) => {
            "{ cut = { from = { block = { min = [0, 0], max = [13, 9] } }, remove = [{ block = { min = [5, 4], max = [10, 9] } }] } }"
        }
        (2, _) => "{ block = { min = [5, 4], max = [10, 9] } }",
        (_, 0) => {
            "{ cut = { from = { block = { min = [0, 0, 0], max = [7, 6, 5] } }, remove = [{ block = { min = [2, 3, 2], max = [5, 6, 5] } }] } }"
        }
        _ => "{ block = { min = [2, 3, 2], max = [5, 6, 5] } }",
    };
    let anchor = vec![0.5; dimension];
    let body = |name: &str, k: usize| {
        format!("[[body]]\nname = '{name}'\nshape = {}\nanchor = {anchor:?}\nmaterial = '{name}'\n", shape(k))
    };
    let material = |name: &str, k: usize, modulus: f64| {
        let density = 1.0 + k as f64;
        format!("[material.{name}]\n{}\ndensity = {density}\nyoungs_modulus = {modulus}\npoisson_ratio = 0.3\n", laws[k])
    };
    parse(&format!(
        "title = 'tied'\ndimension = {dimension}\nspacing = 1.0\nduration = 1.0\n{}{}{}{}
        [[contact]]\nbetween = ['rest', 'part']\ntie = true
        [formulation]\nkind = 'total_lagrangian'\nsmoothing_length = 1.4\n{formulation}",
        body("rest", 0),
        body("part", 1),
        material("rest", 0, 1.0),
        material("part", 1, ratio)
    ))
}

/// Numbers of the formulation as each body may have them.
fn differing(mut scene: Scene) -> Scene {
    for (body, [alpha, hourglass]) in scene.bodies.iter_mut().zip([[0.3, 0.2], [1.1, 0.6]]) {
        body.options = BodyOptions { alpha, beta: 2.0 * alpha, artificial_epsilon: 0.0, hourglass };
    }
    scene.method.body_options = true;
    scene
}

#[test]
fn the_force_of_tied_bodies_is_minus_the_gradient_of_their_energy() {
    for formulation in ["", "hourglass = 0", "gradient = 'quadratic'", "gradient = 'plain'\nhourglass = 0", "bond_table = false"]
    {
        assert_force_is_the_gradient_of_the_energy::<Line<f64>>(&blocks(1, 20.0, LAWS, formulation));
        assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&blocks(2, 20.0, LAWS, formulation));
        assert_force_is_the_gradient_of_the_energy::<Solid<f64>>(&blocks(3, 0.05, LAWS, formulation));
    }
    assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&differing(blocks(2, 7.0, LAWS, "")));
    // The strains are of a tenth: nothing flows, but each particle's hourglass energy is its own.
    let strong = ["law = 'j2'\nyield_stress = 3.0", "law = 'j2'\nyield_stress = 9.0"];
    assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&differing(blocks(2, 7.0, strong, "")));
    assert_force_is_the_gradient_of_the_energy::<Solid<f64>>(&blocks(3, 7.0, [strong[0], LAWS[0]], ""));
}

/// Largest error of H over the largest of its components.
fn linear_error<S: Space<Real = f64>>(scene: &Scene) -> f64 {
    let mut cpu = begun::<S>(scene);
    let state = &mut cpu.members[0];
    let gradient: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| 0.03 * (i as f64 - 0.7 * j as f64 + 0.4)));
    for a in 0..state.params.count as usize {
        let x = S::vec_to(state.columns.reference_position[a]);
        let shift: [f64; 3] = std::array::from_fn(|i| (0..S::DIMENSION).map(|j| gradient[i][j] * x[j]).sum());
        state.columns.displacement[a] = S::vec_from(shift);
    }
    respond(state);
    let mut error: f64 = 0.0;
    for h in &state.columns.displacement_gradient {
        for (i, row) in gradient.iter().enumerate().take(S::DIMENSION) {
            for (j, wanted) in row.iter().enumerate().take(S::DIMENSION) {
                let mut unit = [0.0; 3];
                unit[j] = 1.0;
                let seen = S::vec_to(S::mat_vec(*h, S::vec_from(unit)))[i];
                error = error.max((seen - wanted).abs() / 0.072);
            }
        }
    }
    error
}

#[test]
fn the_gradient_of_linear_displacements_is_exact_across_the_face() {
    // The table of bonds rounds their ends to 2^-36 smoothing lengths.
    for (gradient, most) in [("adjoint", 1e-14), ("quadratic", 1e-13)] {
        let formulation = format!("bond_table = false\ngradient = '{gradient}'");
        let errors = [
            linear_error::<Line<f64>>(&blocks(1, 100.0, LAWS, &formulation)),
            linear_error::<Plane<f64>>(&blocks(2, 100.0, LAWS, &formulation)),
            linear_error::<Solid<f64>>(&blocks(3, 100.0, LAWS, &formulation)),
        ];
        println!("{gradient}: {errors:?}");
        assert!(largest(errors) < most, "{errors:?}");
    }
}

/// With all laws and viscosity of both ends, and particles that move at random.
#[test]
fn tied_bodies_keep_momentum_to_rounding() {
    let yielding = ["law = 'j2'\nyield_stress = 0.02", "law = 'neo_hookean'"];
    for (laws, formulation) in [
        (LAWS, "viscosity = { alpha = 1.0 }"),
        (LAWS, "viscosity = { alpha = 1.0 }\ngradient = 'quadratic'"),
        (yielding, "viscosity = { alpha = 1.0 }\ndissipated_energy = true"),
    ] {
        for scene in [blocks(2, 20.0, laws, formulation), differing(blocks(2, 20.0, laws, formulation))] {
            let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
            let mut random = Random(3);
            for v in &mut cpu.members[0].columns.velocity {
                *v = <Plane<f64> as Space>::vec_from([0.02 * random.signed(), 0.02 * random.signed(), 0.0]);
            }
            let momentum = |cpu: &mut Cpu<Plane<f64>>| {
                let (v, u) = (in_order(cpu, Field::Velocity), in_order(cpu, Field::Displacement));
                let mut sum = [0.0; 3];
                for (i, particle) in scene.particles.iter().enumerate() {
                    let (m, x) = (scene.mass(i), [particle.position.x + u[2 * i], particle.position.y + u[2 * i + 1]]);
                    sum[0] += m * v[2 * i];
                    sum[1] += m * v[2 * i + 1];
                    sum[2] += m * (x[0] * v[2 * i + 1] - x[1] * v[2 * i]);
                }
                sum
            };
            let before = momentum(&mut cpu);
            let moved = in_order(&mut cpu, Field::Velocity);
            steps(&mut cpu, 100);
            let after = momentum(&mut cpu);
            let change: Vec<f64> = (0..2).map(|k| after[k] - before[k]).collect();
            let turned = after[2] - before[2];
            let scale = 0.01 * (0..scene.particles.len()).map(|i| scene.mass(i)).sum::<f64>();
            println!("{formulation:?}: momentum {:.1e}, angular {:.1e} of {scale:.2}", largest(change.iter().copied()), turned);
            assert!(largest(change) < 1e-13 * scale);
            assert!(turned.abs() < 1e-12, "{turned}");
            // The particles have moved: 100 steps are not 100 times nothing.
            let now = in_order(&mut cpu, Field::Velocity);
            assert!(largest(now.iter().zip(&moved).map(|(a, b)| a - b)) > 0.01);
        }
    }
}

/// A body cut in two and tied is the body: bonds of equal moduli have the weight 1.
#[test]
fn parts_of_one_material_move_as_one_body() {
    let shapes = [
        "{ block = { min = [0, 0], max = [13, 4] } }",
        "{ block = { min = [0, 4], max = [13, 9] } }",
        "{ block = { min = [0, 0], max = [13, 9] } }",
    ];
    let run = |bodies: &[usize], tie: &str| {
        let body = |k: &usize| {
            format!("[[body]]\nname = '{k}'\nshape = {}\nanchor = [0.5, 0.5]\nmaterial = 'rubber'\nspin = 0.02\n", shapes[*k])
        };
        let scene = parse(&format!(
            "title = 'one'\ndimension = 2\nspacing = 1\nduration = 1\n{}{tie}
            [[kick]]\nat = [3, 4]\nvelocity = [0.05, 0.1]
            [material.rubber]\nlaw = 'neo_hookean'\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.3
            [formulation]\nkind = 'total_lagrangian'\nviscosity = {{ alpha = 0.5 }}\n[time]\nstep = 0.1",
            bodies.iter().map(body).collect::<String>()
        ));
        let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
        steps(&mut cpu, 100);
        let u = in_order(&mut cpu, Field::Displacement);
        let mut list: Vec<([i64; 2], [f64; 2])> = (scene.particles.iter().zip(u.chunks(2)))
            .map(|(particle, u)| ([particle.position.y, particle.position.x].map(|x| (2.0 * x).round() as i64), [u[0], u[1]]))
            .collect();
        list.sort_by_key(|(place, _)| *place);
        list
    };
    let (whole, tied) = (run(&[2], ""), run(&[0, 1], "[[contact]]\nbetween = ['0', '1']\ntie = true\n"));
    let parted = run(&[0, 1], "");
    assert_eq!(whole.len(), tied.len());
    let apart = |other: &[([i64; 2], [f64; 2])]| {
        largest(whole.iter().zip(other).flat_map(|((x, u), (y, v))| {
            assert_eq!(x, y);
            [u[0] - v[0], u[1] - v[1]]
        }))
    };
    assert!(apart(&tied) < 1e-13, "{}", apart(&tied));
    assert!(apart(&parted) > 1e-3, "{}", apart(&parted));
}
