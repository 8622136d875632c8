//! The discrete operators of Shutov & Klyuchantsev's method: shape functions, their derivatives, and forces that
//! belong to the deformation gradients.

use super::shape_block::{apart, irregular, text};
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::material::{first_piola, stored_energy};
use lithosph::pass::{Pass, Stage};
use lithosph::scene::Scene;
use lithosph::shape_function::{Node, Shape, nodes};
use lithosph::tensor::{Line, Plane, Solid, Space};

fn linear_fields_are_exact<S: Space<Real = f64>>(options: &str, reference: bool) {
    let state = irregular::<S>(options).into_state();
    let mut worst = 0.0_f64;
    for a in 0..state.params.count as usize {
        let shape = Shape::<S>::of(&state, a);
        let (mut one, mut way) = (0.0, S::Vec::default());
        let (mut zero, mut unit) = (S::Vec::default(), S::Mat::default());
        for node in nodes(&state, a, reference) {
            let gradient = shape.gradient(node.x, node.weight, node.slope) * node.volume;
            let value = shape.value(node.x, node.weight) * node.volume;
            one += value;
            way += node.x * value;
            zero += gradient;
            unit += S::outer(node.x * -1.0, gradient);
        }
        let vectors = (0..S::DIMENSION).map(|k| way[k].abs().max(zero[k].abs())).fold(0.0, f64::max);
        worst = worst.max((one - 1.0).abs()).max(vectors).max(apart::<S>(unit, S::mat_identity()));
    }
    println!("{}D {options}: {worst:.1e}", S::DIMENSION);
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn linear_fields_and_their_gradients_are_exact() {
    for (options, reference) in [("", false), ("configuration = 'reference'", true)] {
        linear_fields_are_exact::<Line<f64>>(options, reference);
        linear_fields_are_exact::<Plane<f64>>(options, reference);
        linear_fields_are_exact::<Solid<f64>>(options, reference);
    }
}

/// Shape and the values of all shape functions where a particle is.
fn values<S: Space<Real = f64>>(cpu: &mut Cpu<S>, a: usize) -> (Shape<S>, Vec<(f64, S::Vec)>) {
    Pass::ShapeFunction.run(&mut cpu.members[0], Stage::default());
    let shape = Shape::<S>::of(&cpu.members[0], a);
    let both = |node: Node<S>| (shape.value(node.x, node.weight), shape.gradient(node.x, node.weight, node.slope));
    (shape, nodes(&cpu.members[0], a, false).map(both).collect())
}

/// A particle without volume is a point that the field does not notice: its shape functions are compared with
/// themselves a little aside.
fn derivatives_are_differences<S: Space<Real = f64>>() {
    let mut cpu = irregular::<S>("");
    let count = cpu.members[0].params.count as usize;
    let step = 1e-5;
    let mut worst = 0.0_f64;
    for a in [0, 3, count / 2, count - 1] {
        let volume = std::mem::take(&mut cpu.members[0].columns.reference_volume[a]);
        let (shape, here) = values(&mut cpu, a);
        for k in 0..S::DIMENSION {
            cpu.members[0].columns.displacement[a][k] += step;
            let (after, ahead) = values(&mut cpu, a);
            cpu.members[0].columns.displacement[a][k] -= 2.0 * step;
            let (before, behind) = values(&mut cpu, a);
            cpu.members[0].columns.displacement[a][k] += step;
            // The last of a row has a correction so steep that only digits count.
            let mut check = |seen: f64, high: f64, low: f64| {
                worst = worst.max((seen - (high - low) / (2.0 * step)).abs() / seen.abs().max(1.0));
            };
            check(shape.factor_gradient[k], after.factor, before.factor);
            (0..S::DIMENSION).for_each(|i| check(shape.slope_gradient[S::mat_index(i, k)], after.slope[i], before.slope[i]));
            // The last is the particle itself, which would move along.
            let others = here.iter().zip(&ahead).zip(&behind).take(here.len() - 1);
            others.for_each(|(((_, gradient), high), low)| check(gradient[k], high.0, low.0));
        }
        cpu.members[0].columns.reference_volume[a] = volume;
    }
    println!("{}D: derivatives off by {worst:.1e}", S::DIMENSION);
    assert!(worst < 1e-7, "{worst:e}");
}

#[test]
fn derivatives_of_shape_functions_equal_central_differences() {
    derivatives_are_differences::<Line<f64>>();
    derivatives_are_differences::<Plane<f64>>();
    derivatives_are_differences::<Solid<f64>>();
}

fn energy<S: Space<Real = f64>>(cpu: &mut Cpu<S>) -> f64 {
    Pass::DeformByShape.run(&mut cpu.members[0], Stage { reference: true, ..Stage::default() });
    let state = &cpu.members[0];
    let one = |a: usize| {
        let h = state.columns.displacement_gradient[a];
        state.columns.reference_volume[a] * stored_energy::<S>(state.body(a), h, S::Sym::default())
    };
    (0..state.params.count as usize).map(one).sum()
}

/// Largest error of a force, relative to the largest force.
fn force_less_difference<S: Space<Real = f64>>(options: &str) -> f64 {
    let mut cpu = irregular::<S>(&format!("configuration = 'reference'\n{options}"));
    let (count, step) = (cpu.members[0].params.count as usize, 1e-5);
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for a in [0, 1, count / 3, count / 2, count - 1] {
        for k in 0..S::DIMENSION {
            let force = cpu.members[0].columns.acceleration[a][k] * cpu.members[0].mass(a);
            cpu.members[0].columns.displacement[a][k] += step;
            let high = energy(&mut cpu);
            cpu.members[0].columns.displacement[a][k] -= 2.0 * step;
            let low = energy(&mut cpu);
            cpu.members[0].columns.displacement[a][k] += step;
            worst = worst.max((force + (high - low) / (2.0 * step)).abs());
            largest = largest.max(force.abs());
        }
    }
    println!("{}D {options}: force off by {:.1e}", S::DIMENSION, worst / largest);
    worst / largest
}

#[test]
fn force_in_the_reference_configuration_is_minus_the_derivative_of_the_energy() {
    assert!(force_less_difference::<Line<f64>>("") < 1e-8);
    assert!(force_less_difference::<Plane<f64>>("") < 1e-8);
    assert!(force_less_difference::<Solid<f64>>("") < 1e-8);
    // Bare kernels do not sum to one: then (8) and (5) do not belong together.
    assert!(force_less_difference::<Plane<f64>>("correction = false") > 1e-2);
}

/// Power of the forces plus that of the stress, relative to the sum of its parts.
fn imbalance<S: Space<Real = f64>>(options: &str) -> f64 {
    let mut cpu = irregular::<S>(options);
    Pass::EvolveDeformation.run(&mut cpu.members[0], Stage::default());
    let (state, p) = (&cpu.members[0], &cpu.members[0].columns);
    let (mut sum, mut size) = (0.0, 0.0);
    for a in 0..state.params.count as usize {
        let of_force = state.mass(a) * S::inner(p.acceleration[a], p.velocity[a]);
        let stress = first_piola::<S>(state.body(a), p.displacement_gradient[a], S::Sym::default());
        // tau : L = P : F', F' the rate of F.
        let of_stress = S::trace(S::mat_mat(S::transpose(stress), p.displacement_gradient_rate[a]));
        sum += of_force + p.reference_volume[a] * of_stress;
        size += of_force.abs();
    }
    println!("{}D {options}: power off by {:.1e}", S::DIMENSION, sum.abs() / size);
    sum.abs() / size
}

#[test]
fn power_of_the_forces_is_that_of_the_stress() {
    let printed = "velocity_gradient = 'printed'";
    for options in ["", printed, "correction = false\nvelocity_gradient = 'printed'"] {
        assert!(imbalance::<Line<f64>>(options) < 1e-12, "{options}");
        assert!(imbalance::<Plane<f64>>(options) < 1e-12, "{options}");
        assert!(imbalance::<Solid<f64>>(options) < 1e-12, "{options}");
    }
    // The paper's figure 3: differences and bare kernels do not belong together.
    assert!(imbalance::<Plane<f64>>("correction = false") > 1e-3);
}

#[test]
fn a_lonely_row_of_particles_is_corrected_as_far_as_it_goes() {
    let mut cpu = irregular::<Plane<f64>>("");
    // All but three in a row leave.
    for a in 3..cpu.members[0].params.count as usize {
        cpu.members[0].columns.displacement[a].0[1] = 100.0 + 10.0 * a as f64;
    }
    for a in 0..3 {
        let x = cpu.members[0].columns.reference_position[a].0;
        cpu.members[0].columns.displacement[a].0 = [0.9 * a as f64 - x[0], -x[1]];
    }
    cpu.begin_segment(0.0, 1.0, 1, true).unwrap();
    let finite = |a: usize| cpu.members[0].columns.acceleration[a].0.iter().all(|x| x.is_finite());
    assert!((0..cpu.members[0].params.count as usize).all(finite));
    assert!(cpu.members[0].columns.shape_slope.iter().all(|beta| beta.0 == [0.0; 2]));
}

#[test]
fn options_that_exclude_each_other_are_refused() {
    let refused = |options: &str, sentence: &str| {
        let error = Scene::parse(&text(2, options), "test", None, &[]).err();
        let error = error.unwrap_or_else(|| panic!("not refused: {options}"));
        assert!(error.contains(sentence), "{error}");
    };
    refused("configuration = 'reference'\ndeformation = 'evolved'", "it must be `reference`");
    refused("deformation = 'reference'\nvelocity_gradient = 'printed'", "only where deformation is `evolved`");
    refused("viscosity = { alpha = 1.0 }", "has no viscosity");
    refused("gradient = 'adjoint'", "has no gradient");
    refused("hourglass = 0.5", "belongs to formulation.kind `total_lagrangian`");
    refused("xsph = 0.5", "belongs to formulation.kind `eulerian`");
    let eulerian = text(2, "correction = true").replace("corrected_kernel", "total_lagrangian");
    let error = Scene::parse(&eulerian, "test", None, &[]).err().unwrap_or_default();
    assert!(error.contains("belongs to formulation.kind `corrected_kernel`"), "{error}");
    let pefrl = text(2, "").replace("ssp_rk3", "pefrl");
    assert!(Scene::parse(&pefrl, "test", None, &[]).is_err());
}
