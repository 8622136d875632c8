// v += part step a, then the boundary conditions. Twin: src/pass/kick.rs
#import acceleration
#import compensated if compensated

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> acceleration: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;
#if compensated
@group(0) @binding(_) var<storage, read_write> velocity_carry: array<Vec>;
#endif
#if internal_energy
@group(0) @binding(_) var<storage, read> internal_power: array<real>;
@group(0) @binding(_) var<storage, read_write> internal_energy: array<real>;
#endif
#if dissipated_power
@group(0) @binding(_) var<storage, read> dissipated_power: array<real>;
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
#endif

// When prescribed velocities are taken, as a fraction of the step.
override stage_time: real;
// Part of the step that the kick takes.
override stage_part: real;

fn of_particle(a: u32) {
    let part = stage_part * clock.step;
    let time = clock.start + clock.elapsed + stage_time * clock.step;
    let increment = acceleration_at(a, time) * part;
#if internal_energy
    let before = velocity[a];
#endif
#if compensated
    let result = compensated_add(velocity[a], velocity_carry[a], increment);
    velocity[a] = prescribe(a, result.sum, time);
    velocity_carry[a] = result.carry;
#else
    velocity[a] = prescribe(a, velocity[a] + increment, time);
#endif
    // Energies grow at the same two moments as the velocity, with the force of that moment.
#if internal_energy
    // The force found its power with the velocity of the half step; the kick does its work at the mean of the
    // velocities before and after.
    let later = select(0.5, 1.5, stage_time < 1.0);
    let change = (velocity[a] - before) * later;
    internal_energy[a] += (internal_power[a] - inner(acceleration[a], change)) * part;
#endif
#if dissipated_power
    dissipated_energy[a] += dissipated_power[a] * part;
#endif
}
