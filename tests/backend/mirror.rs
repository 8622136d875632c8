//! The host's structures against their twins in `shaders/lib`: same members, same offsets, same size.

use lithosph::backend::shader::{compose, offsets};
use lithosph::method::Method;
use lithosph::pass::Pass;
use lithosph::rows::{Balance, Body, BodyOptions, Clock, Constraint, ContactPair, FacetPair, Mover, Params};
use lithosph::scene::Scene;
use std::mem::offset_of;

/// The texts of passes that together use every structure.
fn texts() -> [String; 2] {
    let scene = include_str!("../../scenes/colliding_rings.toml");
    let method = Scene::parse(scene, "colliding_rings", None, &[]).unwrap().method;
    let method = Method { constraints: true, body_force: true, body_options: true, ..method };
    [Pass::Kick, Pass::Force].map(|pass| compose(pass, &method))
}

/// The first of them that has a structure.
fn text_with(structure: &str) -> String {
    let [kick, force] = texts();
    if offsets(&kick, structure).is_ok() { kick } else { force }
}

/// Bytes of a structure as naga lays it out.
fn span(structure: &str) -> u32 {
    let module = naga::front::wgsl::parse_str(&text_with(structure)).unwrap();
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(structure));
    match found.map(|(_, ty)| &ty.inner) {
        Some(naga::TypeInner::Struct { span, .. }) => *span,
        _ => panic!("the shader has no structure {structure}"),
    }
}

macro_rules! assert_mirrors {
    ($structure:ident: $($member:ident),* $(,)?) => {{
        let host = [$((stringify!($member).to_string(), offset_of!($structure<f32>, $member) as u32)),*];
        assert_eq!(offsets(&text_with(stringify!($structure)), stringify!($structure)).unwrap(), host);
        // A host structure with one more member than is named here does not compile.
        let $structure::<f32> { $($member: _),* } = $structure::default();
    }};
}

#[test]
fn params_mirror_the_shader_s() {
    assert_mirrors!(Params:
        planes, count, first, chunk, list_capacity, cells_x, cells_y, cells_z, cell_total, plane_count, body_count,
        artificial_exponent, contact_capacity, facet_count, facet_capacity, obstacle_count, facet_alike, surface_count, corner_count, zero, origin_x, origin_y, origin_z, cell_x, cell_y, cell_z, period_x, period_y, period_z,
        body_force_x, body_force_y, body_force_z, normalisation, reach, contact_reach, facet_reach, contact_rate, contact_apart, slack, hourglass, alpha, beta, softening, smoothing_weight,
        artificial_epsilon, artificial_weight, cfl, fixed_step, rest_step, interval, stable, residual, load_rate,
    );
    // Bound alone, in a buffer rounded up to the alignment of a vec4.
    assert_eq!(size_of::<Params<f32>>().next_multiple_of(16), span("Params") as usize);
}

#[test]
fn bodies_mirror_the_shader_s() {
    assert_mirrors!(Body:
        whole, pressure, strength, heat, density, bulk_modulus, shear_modulus, youngs_modulus, yield_stress, sound_speed,
        smoothing_length, frequency, numbers);
    assert_eq!(size_of::<Body<f32>>(), span("Body") as usize);
}

#[test]
fn options_of_bodies_mirror_the_shader_s() {
    assert_mirrors!(BodyOptions: alpha, beta, artificial_epsilon, hourglass);
    assert_eq!(size_of::<BodyOptions<f32>>(), span("BodyOptions") as usize);
}

#[test]
fn contact_pairs_mirror_the_shader_s() {
    assert_mirrors!(ContactPair: law, exponent, strength, range, threshold, friction);
    assert_eq!(size_of::<ContactPair<f32>>(), span("ContactPair") as usize);
}

#[test]
fn constraints_mirror_the_shader_s() {
    assert_mirrors!(Constraint: prescribed, course_first, course_count, padding, x, y, z, unused);
    assert_eq!(size_of::<Constraint<f32>>(), span("Constraint") as usize);
}

#[test]
fn contacts_of_surfaces_mirror_the_shader_s() {
    assert_mirrors!(FacetPair: stiffness, range, full, friction);
    assert_mirrors!(Mover: condition, inverse_mass);
}

#[test]
fn clocks_mirror_the_shader_s() {
    assert_mirrors!(Clock:
        start, elapsed, elapsed_carry, step, duration, steps_left, steps_done, running, rebuild, lists_built, changes, held, arrived,
        fault, residual,
    );
    assert_eq!(size_of::<Clock<f32>>(), span("Clock") as usize);
}

#[test]
fn balances_mirror_the_shader_s() {
    assert_mirrors!(Balance: back, keep, push, forward, mixing, longest, downhill, padding);
    assert_eq!(size_of::<Balance<f32>>(), span("Balance") as usize);
}
