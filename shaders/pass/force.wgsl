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
#if viscosity
#if body_options
#import body_options
#endif
#endif
#if pair_velocity
#import pair_velocity
#endif
#if pair_volume
#import density
#endif
#if adjoint
#import volume
#endif

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
#if adjoint
@group(0) @binding(_) var<storage, read> corrected_stress: array<Mat>;
#else
@group(0) @binding(_) var<storage, read> specific_stress: array<Sym>;
#endif
#if scalar_form
@group(0) @binding(_) var<storage, read> artificial_pressure: array<real>;
#endif
#if principal_form
@group(0) @binding(_) var<storage, read> artificial_stress: array<Sym>;
#endif
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;
#if internal_energy
@group(0) @binding(_) var<storage, read_write> internal_power: array<real>;
#endif
#if dissipated_power
@group(0) @binding(_) var<storage, read_write> dissipated_power: array<real>;
#endif

// What the terms of the force need of particle a, loaded once.
struct Own {
#if adjoint
    stress: Mat,
#else
    stress: Sym,
#endif
#if pair_volume
    density: real,
#endif
#if viscosity
    sound_speed: real,
#if body_options
    options: BodyOptions,
#endif
#endif
#if scalar_form
    artificial: real,
#endif
#if principal_form
    artificial: Sym,
#endif
}

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

fn own_of(a: u32) -> Own {
    var own: Own;
#if adjoint
    own.stress = corrected_stress[a];
#else
    own.stress = specific_stress[a];
#endif
#if pair_volume
    own.density = density(a);
#endif
#if viscosity
    own.sound_speed = body_of(a).sound_speed;
#if body_options
    own.options = options_of(a);
#endif
#endif
#if scalar_form
    own.artificial = artificial_pressure[a];
#endif
#if principal_form
    own.artificial = artificial_stress[a];
#endif
    return own;
}

fn sum_pairs(a: u32, row: u32) -> Sums {
    let center = center_of(a);
    let own = own_of(a);
#if pair_velocity
    let velocity_a = velocity[a];
#endif
    let count = neighbor_count[a];
    var sums: Sums;
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        let coupled = pair_coupling(center.body, pair.b);
        let mass_b = mass(pair.b) * coupled;
        let gradient = pair.x * pair.gradient;
#if adjoint
        var force = mat_vec(pair_stress(own.stress, pair), gradient) * (volume(pair.b) * coupled / own.density);
#else
        var force = mat_vec(pair_stress(own.stress, pair), gradient) * mass_b;
#endif
#if artificial_stress
        let nearness = weight(pair.distance, pair.h) / params.artificial_weight;
        let strength = whole_power(nearness, params.artificial_exponent);
        force += repulsion(own, pair, gradient) * (mass_b * strength);
#endif
#if pair_velocity
        let v_ba = velocity_difference(velocity_a, pair);
#endif
#if viscosity
        let friction = gradient * (-mass_b * viscosity(own, pair, v_ba));
        force += friction;
#if dissipated_power
        sums.dissipated_power += 0.5 * inner(v_ba, friction);
#endif
#endif
        sums.acceleration += force;
#if internal_energy
        sums.internal_power += 0.5 * inner(v_ba, force);
#endif
    }
    return sums;
}

#if adjoint
// sigma_a K_a^-1 + sigma_b K_b^-1
fn pair_stress(stress_a: Mat, pair: Pair) -> Mat {
    var stress_b = corrected_stress[pair.b];
#if symmetry
    if pair.image != 0u {
        stress_b = mirror_tensor(pair.image, stress_b);
    }
#endif
    return stress_a + stress_b;
}
#else
// sigma_a/rho_a^2 + sigma_b/rho_b^2
fn pair_stress(stress_a: Sym, pair: Pair) -> Mat {
#if symmetry
    if pair.image != 0u {
        return mat_of_sym(stress_a) + mirror_tensor(pair.image, mat_of_sym(specific_stress[pair.b]));
    }
#endif
    return mat_of_sym(sym_add(stress_a, specific_stress[pair.b]));
}
#endif

#if artificial_stress
// (R_a + R_b) grad_a W_ab
fn repulsion(own: Own, pair: Pair, gradient: Vec) -> Vec {
#if scalar_form
    return gradient * (own.artificial + artificial_pressure[pair.b]);
#else
#if symmetry
    if pair.image != 0u {
        let image = mirror_tensor(pair.image, mat_of_sym(artificial_stress[pair.b]));
        return mat_vec(mat_of_sym(own.artificial) + image, gradient);
    }
#endif
    return sym_vec(sym_add(own.artificial, artificial_stress[pair.b]), gradient);
#endif
}

// Small whole powers, without the cost of a general one.
fn whole_power(base: real, exponent: u32) -> real {
    var product: real = 1.0;
    for (var k = 0u; k < exponent; k++) {
        product *= base;
    }
    return product;
}
#endif

#if viscosity
// Pi_ab of Monaghan, Fuller (2.60): only while the two approach.
fn viscosity(own: Own, pair: Pair, v_ba: Vec) -> real {
    let approach = -inner(v_ba, pair.x);
    let square = pair.distance * pair.distance + params.softening * pair.h * pair.h;
    let mu = min(pair.h * approach / square, 0.0);
    let sound_speed = 0.5 * (own.sound_speed + body_of(pair.b).sound_speed);
    let mean_density = 0.5 * (own.density + density(pair.b));
#if body_options
    // The means of the two particles' numbers, so that both feel the same Pi and momentum is kept.
    let other = options_of(pair.b);
    let alpha = 0.5 * (own.options.alpha + other.alpha);
    let beta = 0.5 * (own.options.beta + other.beta);
    return (beta * mu - alpha * sound_speed) * mu / mean_density;
#else
    return (params.beta * mu - params.alpha * sound_speed) * mu / mean_density;
#endif
}
#endif
