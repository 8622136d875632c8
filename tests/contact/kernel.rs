//! Contact through the kernel sticks; a potential lets go.

use super::discs::{LAGRANGIAN, collide, discs_of};

/// Speed of longitudinal waves.
const SOUND: f64 = 1.1602;

/// Seen: 0.12 at the end, and falling still, since the kernels overlap and hold the discs back; twice that just after
/// the turn.
#[test]
fn equal_discs_stick_at_a_thousandth_of_the_speed_of_sound_by_the_kernel_and_not_by_a_potential() {
    let speed = 0.001 * SOUND;
    let kernel = collide(&discs_of(12.0, "kernel = 1", "viscosity = { alpha = 1.0 }", [1.0, 0.0], speed), 3000.0);
    println!("kernel: restitution {:.3}", kernel.restitution);
    assert!((0.0..0.13).contains(&kernel.restitution), "{}", kernel.restitution);
    let barrier = "potential = { law = 'barrier', stiffness = 1.0, range = 1.5 }";
    let barrier = collide(&discs_of(6.0, barrier, LAGRANGIAN, [-0.4, 0.0], speed), 1200.0);
    println!("barrier: restitution {:.3}", barrier.restitution);
    assert!((0.97..1.002).contains(&barrier.restitution), "{}", barrier.restitution);
}
