// alpha, beta and their derivatives at each particle, Shutov & Klyuchantsev 2019 (2), (3): with m = sum V_b W,
// p = sum V_b W r, M = sum V_b W r (x) r, s = sum V_b (W'/r) (1 + beta . r) r and
// G = sum V_b (W'/r) (1 + beta . r) r (x) r,
//
// beta = -M^-1 p, 1/alpha = m + beta . p, d beta/dx = -M^-1 (G + 1/alpha + p (x) beta),
// d alpha/dx = -alpha^2 (s + (d beta/dx)^T p + m beta).
//
// Twin: src/pass/shape_function.rs and src/shape_function.rs
#import inverse
#import shape_node

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if current
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
#endif
@group(0) @binding(_) var<storage, read_write> shape_factor: array<real>;
@group(0) @binding(_) var<storage, read_write> shape_slope: array<Vec>;
@group(0) @binding(_) var<storage, read_write> shape_factor_gradient: array<Vec>;
@group(0) @binding(_) var<storage, read_write> shape_slope_gradient: array<Mat>;

fn of_particle(a: u32, row: u32) {
    let shape = corrected(center_of(a, row));
    shape_factor[a] = shape.factor;
    shape_slope[a] = shape.slope;
    shape_factor_gradient[a] = shape.factor_gradient;
    shape_slope_gradient[a] = shape.slope_gradient;
}

// m, p, M
struct Moments {
    zeroth: real,
    first: Vec,
    second: Mat,
}

fn moments_of(center: Center) -> Moments {
    var sums = Moments();
    for (var k = 0u; k <= center.count; k++) {
        let node = node_at(center, k);
        let share = volume_of(node) * node.weight;
        sums.zeroth += share;
        sums.first += node.x * share;
        sums.second += outer(node.x, node.x * share);
    }
    return sums;
}

// s and G
fn gradient_moments_of(center: Center, slope: Vec) -> Moments {
    var sums = Moments();
    for (var k = 0u; k <= center.count; k++) {
        let node = node_at(center, k);
        let share = volume_of(node) * node.slope * (1.0 + inner(slope, node.x));
        sums.first += node.x * share;
        sums.second += outer(node.x, node.x * share);
    }
    return sums;
}

fn corrected(center: Center) -> Shape {
    let sums = moments_of(center);
    let inverse = inverse_or_zero(sums.second, center.h);
    let slope = -mat_vec(inverse, sums.first);
    let total = sums.zeroth + inner(slope, sums.first);
    let factor = 1.0 / total;
    let changes = gradient_moments_of(center, slope);
    let turned = changes.second + mat_identity() * total + outer(sums.first, slope);
    let slope_gradient = mat_mat(inverse, turned) * -1.0;
    let change = changes.first + mat_vec(transpose_mat(slope_gradient), sums.first) + slope * sums.zeroth;
    return Shape(factor, slope, change * -(factor * factor), slope_gradient);
}

// M^-1; zero where the particles around lie on a line or a plane, or there are none: then alpha alone corrects.
fn inverse_or_zero(moment: Mat, h: real) -> Mat {
    // In units of h, so that f32 holds the determinant of the smallest scene.
    let scale = 1.0 / (h * h);
    return inverse_or(moment * scale, Mat()) * scale;
}
