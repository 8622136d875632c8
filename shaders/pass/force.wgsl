// Acceleration of each particle, Fuller (2.59) with the viscosity's sign mended:
//
// a_a = sum m_b (sigma_a/rho_a^2 + sigma_b/rho_b^2 - Pi_ab + (R_a + R_b) f^n) grad_a W_ab,
//
// or, adjoint to the corrected velocity gradient,
//
// a_a = (1/rho_a) sum V_b (sigma_a K_a^-1 + sigma_b K_b^-1) grad_a W_ab + the terms of Pi and R as above.
//
// Twin: src/pass/force.rs
#import pair
#import coupling
#import mass
#import plain_stress if !adjoint
#import adjoint_stress if adjoint
#import volume if adjoint
#import density if pair_volume
#import pair_velocity if pair_velocity
#import artificial_stress if artificial_stress
#import viscosity if viscosity

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if pair_volume
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
#endif
#if pair_velocity
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;
#if internal_energy
@group(0) @binding(_) var<storage, read_write> internal_power: array<real>;
#endif
#if dissipated_power
@group(0) @binding(_) var<storage, read_write> dissipated_power: array<real>;
#endif

// What the sum over neighbours gives.
struct Sums {
    acceleration: Vec,
    internal_power: real,
    dissipated_power: real,
}

fn of_particle(a: u32, row: u32) {
    let sums = sum_pairs(a, row);
    acceleration[a] = sums.acceleration;
#if internal_energy
    internal_power[a] = sums.internal_power;
#endif
#if dissipated_power
    dissipated_power[a] = sums.dissipated_power;
#endif
}

fn sum_pairs(a: u32, row: u32) -> Sums {
    // What the terms need of particle a, loaded once.
    let center = center_of(a);
    let stress_a = stress_of(a);
#if pair_volume
    let density_a = density(a);
#endif
#if pair_velocity
    let velocity_a = velocity[a];
#endif
#if artificial_stress
    let repulsion_a = repulsion_of(a);
#endif
#if viscosity
    let viscous_a = viscous_of(a, density_a);
#endif
    let count = neighbor_count[a];
    var sums: Sums;
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        let coupled = pair_coupling(center.body, pair.b);
        let mass_b = mass(pair.b) * coupled;
        let gradient = pair.x * pair.gradient;
#if adjoint
        var force = mat_vec(pair_stress(stress_a, pair), gradient) * (volume(pair.b) * coupled / density_a);
#else
        var force = mat_vec(pair_stress(stress_a, pair), gradient) * mass_b;
#endif
#if artificial_stress
        force += repulsion(repulsion_a, pair, gradient) * (mass_b * nearness(pair));
#endif
#if pair_velocity
        let v_ba = velocity_difference(velocity_a, pair);
#endif
#if viscosity
        let friction = gradient * (-mass_b * viscosity(viscous_a, pair, v_ba));
        force += friction;
#endif
#if dissipated_power
        sums.dissipated_power += 0.5 * inner(v_ba, friction);
#endif
        sums.acceleration += force;
#if internal_energy
        sums.internal_power += 0.5 * inner(v_ba, force);
#endif
    }
    return sums;
}
