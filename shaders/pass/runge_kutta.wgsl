// One stage: sum += weight rate, then state = start + step (of_sum sum + of_rate rate).
// Twin: src/pass/runge_kutta.rs
//
// Rates are summed, not states, so that f32 adds small numbers to small numbers until the last stage.
#import acceleration
#import moving_velocity
#import compensated if compensated
#import integrated_stress if shear
#import integrated QUANTITY=displacement_gradient RATE=displacement_gradient_rate TYPE=Mat if evolved
#import integrated QUANTITY=volumetric_strain RATE=volumetric_strain_rate TYPE=real if continuity
#import integrated QUANTITY=internal_energy RATE=internal_power TYPE=real if internal_energy
#import integrated QUANTITY=dissipated_energy RATE=dissipated_power TYPE=real if dissipated_power

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> acceleration: array<Vec>;
@group(0) @binding(_) var<storage, read_write> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> displacement_start: array<Vec>;
@group(0) @binding(_) var<storage, read_write> displacement_sum: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity_start: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity_sum: array<Vec>;
#if compensated
@group(0) @binding(_) var<storage, read_write> displacement_carry: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity_carry: array<Vec>;
#endif

// When prescribed velocities are taken, as a fraction of the step.
override stage_time: real;
// Weight of this stage's rate in the sum.
override stage_weight: real;
override stage_of_sum: real;
override stage_of_rate: real;
override stage_first: bool;
override stage_last: bool;

fn of_particle(a: u32) {
    motion(a);
#if shear
    advance_deviatoric_stress(a);
#endif
#if evolved
    advance_displacement_gradient(a);
#endif
#if continuity
    advance_volumetric_strain(a);
#endif
#if internal_energy
    advance_internal_energy(a);
#endif
#if dissipated_power
    advance_dissipated_energy(a);
#endif
}

// Next state, and its increment over the start.
struct Next {
    state: Vec,
    start: Vec,
    sum: Vec,
    increment: Vec,
}

fn advance(now: Vec, start_before: Vec, sum_before: Vec, rate: Vec) -> Next {
    var start = start_before;
    var sum = sum_before;
    if stage_first {
        start = now;
        sum = Vec();
    }
    sum += rate * stage_weight;
    let increment = (sum * stage_of_sum + rate * stage_of_rate) * clock.step;
    return Next(start + increment, start, sum, increment);
}

// Displacement and velocity; the rate of the displacement is the velocity before this stage changes it.
fn motion(a: u32) {
    let time = clock.start + clock.elapsed;
    let u = advance(displacement[a], displacement_start[a], displacement_sum[a], moving_velocity(a));
    let v = advance(velocity[a], velocity_start[a], velocity_sum[a], acceleration_at(a, time));
    if stage_first {
        displacement_start[a] = u.start;
        velocity_start[a] = v.start;
    }
    displacement_sum[a] = u.sum;
    velocity_sum[a] = v.sum;
    var next_displacement = u.state;
    var next_velocity = v.state;
#if compensated
    if stage_last {
        let moved = compensated_add(u.start, displacement_carry[a], u.increment);
        let pushed = compensated_add(v.start, velocity_carry[a], v.increment);
        next_displacement = moved.sum;
        next_velocity = pushed.sum;
        displacement_carry[a] = moved.carry;
        velocity_carry[a] = pushed.carry;
    }
#endif
    displacement[a] = next_displacement;
    velocity[a] = prescribe(a, next_velocity, time + stage_time * clock.step);
}
