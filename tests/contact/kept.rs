//! Laws with an energy keep momentum, angular momentum and energy.

use super::discs::{LAGRANGIAN, WITH_ENERGY, begun, collide, discs};
use crate::common::Random;
use lithosph::pass::{Pass, Stage};
use lithosph::state::State;
use lithosph::tensor::Plane;

const ROUNDING: f64 = 1e-12;

#[test]
fn laws_with_an_energy_keep_all_in_an_oblique_collision() {
    for (law, gap) in WITH_ENERGY {
        let scene = discs(law, LAGRANGIAN, [gap, 5.0], 0.1);
        let change = collide(&scene, 120.0);
        println!(
            "{law}: momentum {:.1e}, spin {:.1e}, energy {:.1e}, contact {:.2}, restitution {:.3}",
            change.momentum, change.spin, change.energy, change.contact, change.restitution
        );
        assert!(change.contact > 0.05, "{law}: they have not touched");
        assert!(change.momentum < ROUNDING && change.spin.abs() < ROUNDING, "{law}");
        assert!(change.energy.abs() < 1e-3, "{law}: {}", change.energy);
    }
}

/// The bodies alone would let steps be twenty times longer than these contacts bear.
#[test]
fn potentials_far_stiffer_than_the_bodies_shorten_the_step_and_keep_the_energy() {
    for (law, gap) in [
        ("potential = { law = 'barrier', stiffness = 1000.0, range = 1.0 }", 1.0),
        ("potential = { law = 'quadratic', stiffness = 1000.0, range = 2.0 }", 2.0),
        ("potential = { law = 'power', stiffness = 1000.0, range = 2.0 }", 2.0),
        ("potential = { law = 'repulsive', stiffness = 1000.0, range = 2.6 }", 2.6),
    ] {
        let change = collide(&discs(law, LAGRANGIAN, [gap, 5.0], 0.1), 120.0);
        println!("{law}: energy {:.1e}, restitution {:.3}", change.energy, change.restitution);
        // The touch is over between two looks at it.
        assert!(change.restitution > 0.2, "{law}: they have not touched");
        assert!(change.momentum < ROUNDING && change.spin.abs() < ROUNDING, "{law}");
        assert!(change.energy.abs() < 0.01, "{law}: {}", change.energy);
    }
}

/// In the Eulerian formulation the adjoint gradients keep angular momentum; its material has no energy to the last
/// digit.
#[test]
fn laws_with_an_energy_keep_all_in_the_eulerian_formulation_too() {
    for (law, gap) in WITH_ENERGY {
        let scene = discs(&format!("kernel = 0\n{law}"), "gradient = 'adjoint'", [gap, 5.0], 0.02);
        let change = collide(&scene, 400.0);
        println!(
            "{law}: momentum {:.1e}, spin {:.1e}, energy {:.1e}, contact {:.2}, restitution {:.3}",
            change.momentum, change.spin, change.energy, change.contact, change.restitution
        );
        assert!(change.contact > 0.05, "{law}: they have not touched");
        assert!(change.momentum < ROUNDING && change.spin.abs() < 1e-6, "{law}");
        assert!(change.energy.abs() < 1e-3, "{law}: {}", change.energy);
    }
}

/// Energy of all contacts, and the force on each particle.
fn contacts(state: &mut State<Plane<f64>>) -> (f64, Vec<[f64; 2]>) {
    state.columns.acceleration.iter_mut().for_each(|a| *a = Default::default());
    if state.method.contact.colour_field {
        Pass::SumColour.run(state, Stage::default());
    }
    Pass::ContactForce.run(state, Stage::default());
    let forces = state.columns.acceleration.iter().enumerate().map(|(a, pull)| [pull[0], pull[1]].map(|x| x * state.mass(a)));
    (state.columns.contact_energy.iter().sum(), forces.collect())
}

#[test]
fn forces_are_minus_the_gradients_of_the_energies() {
    for (law, _) in WITH_ENERGY {
        let mut state = begun::<Plane<f64>>(&discs(law, LAGRANGIAN, [-1.2, 1.3], 0.0)).into_state();
        let mut random = Random(5);
        for a in 0..state.columns.displacement.len() {
            (0..2).for_each(|k| state.columns.displacement[a][k] = 0.05 * random.signed());
        }
        let (energy, forces) = contacts(&mut state);
        let strongest = forces.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        assert!(energy > 1e-4, "{law}: {energy}");
        for a in (0..forces.len()).filter(|&a| forces[a][0].abs() > 0.05 * strongest) {
            for (k, force) in forces[a].iter().enumerate() {
                let mut at = |shift: f64| {
                    state.columns.displacement[a][k] += shift;
                    let energy = contacts(&mut state).0;
                    state.columns.displacement[a][k] -= shift;
                    energy
                };
                let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
                assert!((force + slope).abs() < 1e-6 * strongest, "{law}: {force} against {}", -slope);
            }
        }
    }
}
