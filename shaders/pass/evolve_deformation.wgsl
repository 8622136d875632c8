// The velocity gradient L_a = sum V_b (v_b - v_a) (x) grad psi_b(x_a), Shutov & Klyuchantsev 2019 (6), which as
// printed has v_b alone; and what it does to F, (9): in leapfrog F <- exp(step L) F, in Runge-Kutta the rate L F.
// Both are written for H = F - 1, so that f32 keeps small strains. Twin: src/pass/evolve_deformation.rs
#import shape_node
#import shape_columns

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
#if staged
@group(0) @binding(_) var<storage, read> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read_write> displacement_gradient_rate: array<Mat>;
#else
@group(0) @binding(_) var<storage, read_write> displacement_gradient: array<Mat>;
#endif

// Terms of the exponential's series: all digits for steps that turn or stretch by a tenth.
const EXPONENTIAL_TERMS: u32 = 10u;

fn of_particle(a: u32, row: u32) {
    let gradient = velocity_gradient_of(a, row);
    let h = displacement_gradient[a];
#if staged
    displacement_gradient_rate[a] = before(gradient, h);
#else
    displacement_gradient[a] = h + before(exponential_less_one(gradient * clock.step), h);
#endif
}

fn velocity_gradient_of(a: u32, row: u32) -> Mat {
    let center = center_of(a, row);
    let shape = shape_of(a);
#if difference
    let own = velocity[a];
#else
    let own = Vec();
#endif
    var sum = Mat();
    for (var k = 0u; k <= center.count; k++) {
        let node = node_at(center, k);
        let gradient = shape_gradient(shape, node.x, node.weight, node.slope) * volume_of(node);
        sum += outer(seen(node.image, velocity[node.b]) - own, gradient);
    }
    return sum;
}

// A F = A + A H
fn before(a: Mat, h: Mat) -> Mat {
    return a + mat_mat(a, h);
}

// exp A - 1 = A (1 + A/2 (1 + A/3 (...)))
fn exponential_less_one(a: Mat) -> Mat {
    var rest = Mat();
    for (var k = 0u; k + 1u < EXPONENTIAL_TERMS; k++) {
        rest = before(a, rest) * (1.0 / real(EXPONENTIAL_TERMS - k));
    }
    return before(a, rest);
}
