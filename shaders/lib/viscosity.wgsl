// The artificial viscosity of Monaghan, Fuller (2.60). The pass declares `volumetric_strain`.
// Twin: viscosity in src/pass/force.rs
#import pair
#import body_options
#import density

// What a particle brings into the viscosity of all of its pairs.
struct Viscous {
    density: real,
    sound_speed: real,
    options: BodyOptions,
}

fn viscous_of(a: u32, density_a: real) -> Viscous {
    return Viscous(density_a, body_of(a).sound_speed, options_of(a));
}

// Pi_ab: only while the two approach.
fn viscosity(own: Viscous, pair: Pair, v_ba: Vec) -> real {
    let approach = -inner(v_ba, pair.x);
    let square = pair.distance * pair.distance + params.softening * pair.h * pair.h;
    let mu = min(pair.h * approach / square, 0.0);
    let sound_speed = 0.5 * (own.sound_speed + body_of(pair.b).sound_speed);
    let mean_density = 0.5 * (own.density + density(pair.b));
    var options = own.options;
#if body_options
    // The means of the two particles' numbers, so that both feel the same Pi and momentum is kept.
    let other = options_of(pair.b);
    options.alpha = 0.5 * (options.alpha + other.alpha);
    options.beta = 0.5 * (options.beta + other.beta);
#endif
    return (options.beta * mu - options.alpha * sound_speed) * mu / mean_density;
}
