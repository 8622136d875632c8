// One stage: sum += weight rate, then state = start + step (of_sum sum + of_rate rate).
// Twin: src/pass/runge_kutta.rs
//
// Rates are summed, not states, so that f32 adds small numbers to small numbers until the last stage.
#import acceleration
#import moving_velocity
#if compensated
#import compensated
#endif

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
#if xsph
@group(0) @binding(_) var<storage, read> smoothed_velocity: array<Vec>;
#endif
#if constraints
@group(0) @binding(_) var<storage, read> constraint: array<u32>;
#endif
#if shear
@group(0) @binding(_) var<storage, read> deviatoric_stress_rate: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress_start: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress_sum: array<Sym>;
#endif
#if continuity
@group(0) @binding(_) var<storage, read> volumetric_strain_rate: array<real>;
@group(0) @binding(_) var<storage, read_write> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read_write> volumetric_strain_start: array<real>;
@group(0) @binding(_) var<storage, read_write> volumetric_strain_sum: array<real>;
#endif
#if evolved
@group(0) @binding(_) var<storage, read> displacement_gradient_rate: array<Mat>;
@group(0) @binding(_) var<storage, read_write> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read_write> displacement_gradient_start: array<Mat>;
@group(0) @binding(_) var<storage, read_write> displacement_gradient_sum: array<Mat>;
#endif
#if internal_energy
@group(0) @binding(_) var<storage, read> internal_power: array<real>;
@group(0) @binding(_) var<storage, read_write> internal_energy: array<real>;
@group(0) @binding(_) var<storage, read_write> internal_energy_start: array<real>;
@group(0) @binding(_) var<storage, read_write> internal_energy_sum: array<real>;
#endif
#if dissipated_power
@group(0) @binding(_) var<storage, read> dissipated_power: array<real>;
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
@group(0) @binding(_) var<storage, read_write> dissipated_energy_start: array<real>;
@group(0) @binding(_) var<storage, read_write> dissipated_energy_sum: array<real>;
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
    advance_stress(a);
#endif
#if evolved
    advance_deformation(a);
#endif
#if continuity
    let strain = advance_scalar(
        volumetric_strain[a],
        volumetric_strain_start[a],
        volumetric_strain_sum[a],
        volumetric_strain_rate[a],
    );
    volumetric_strain[a] = strain.state;
    if stage_first {
        volumetric_strain_start[a] = strain.start;
    }
    volumetric_strain_sum[a] = strain.sum;
#endif
#if internal_energy
    let energy = advance_scalar(
        internal_energy[a],
        internal_energy_start[a],
        internal_energy_sum[a],
        internal_power[a],
    );
    internal_energy[a] = energy.state;
    if stage_first {
        internal_energy_start[a] = energy.start;
    }
    internal_energy_sum[a] = energy.sum;
#endif
#if dissipated_power
    let heat = advance_scalar(
        dissipated_energy[a],
        dissipated_energy_start[a],
        dissipated_energy_sum[a],
        dissipated_power[a],
    );
    dissipated_energy[a] = heat.state;
    if stage_first {
        dissipated_energy_start[a] = heat.start;
    }
    dissipated_energy_sum[a] = heat.sum;
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

#if shear
fn advance_stress(a: u32) {
    let rate = deviatoric_stress_rate[a];
    var start = deviatoric_stress_start[a];
    var sum = deviatoric_stress_sum[a];
    if stage_first {
        start = deviatoric_stress[a];
        sum = Sym();
    }
    sum = sym_add(sum, sym_scale(rate, stage_weight));
    let slope = sym_add(sym_scale(sum, stage_of_sum), sym_scale(rate, stage_of_rate));
    deviatoric_stress[a] = sym_add(start, sym_scale(slope, clock.step));
    if stage_first {
        deviatoric_stress_start[a] = start;
    }
    deviatoric_stress_sum[a] = sum;
}
#endif

#if evolved
fn advance_deformation(a: u32) {
    let rate = displacement_gradient_rate[a];
    var start = displacement_gradient_start[a];
    var sum = displacement_gradient_sum[a];
    if stage_first {
        start = displacement_gradient[a];
        sum = Mat();
    }
    sum += rate * stage_weight;
    displacement_gradient[a] = start + (sum * stage_of_sum + rate * stage_of_rate) * clock.step;
    if stage_first {
        displacement_gradient_start[a] = start;
    }
    displacement_gradient_sum[a] = sum;
}
#endif

// Next state of a scalar, with the step's start and the sum of the stages' rates.
struct NextScalar {
    state: real,
    start: real,
    sum: real,
}

fn advance_scalar(now: real, start_before: real, sum_before: real, rate: real) -> NextScalar {
    var start = start_before;
    var sum = sum_before;
    if stage_first {
        start = now;
        sum = 0.0;
    }
    sum += rate * stage_weight;
    let increment = (sum * stage_of_sum + rate * stage_of_rate) * clock.step;
    return NextScalar(start + increment, start, sum);
}
