//! One law for each pair of bodies, several in a scene; and what is refused.

use super::discs::{LAGRANGIAN, WITH_ENERGY, begun};
use crate::common::parse;
use lithosph::contact::Potential;
use lithosph::scene::Scene;
use lithosph::tensor::Plane;

/// Three blocks in a row, 0.7 between the particles of one and the next.
fn blocks(contacts: &str, formulation: &str) -> String {
    let law = if formulation.contains("total_lagrangian") { "law = 'neo_hookean'" } else { "" };
    let block = |name: &str, from: f64| {
        format!(
            "[[body]]\nname = '{name}'\nshape = {{ block = {{ min = [{from}, 0], max = [{}, 6] }} }}\n\
             anchor = [{}, 0.5]\nmaterial = 'rubber'\n",
            from + 5.0,
            from + 0.5
        )
    };
    format!(
        "title = 'blocks'\ndimension = 2\nspacing = 1.0\nduration = 1.0\ncontact = [{contacts}]\n{}{}{}\
         [material.rubber]\n{law}\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n[formulation]\n{formulation}\n",
        block("a", 0.0),
        block("b", 4.7),
        block("c", 9.4),
    )
}

/// Largest pull along x on each block's particles.
fn pulls(scene: &Scene) -> [f64; 3] {
    let state = begun::<Plane<f64>>(scene).into_state();
    let mut pulls = [0.0f64; 3];
    for (a, acceleration) in state.columns.acceleration.iter().enumerate() {
        let body = state.body_index(a);
        pulls[body] = pulls[body].max(acceleration[0].abs());
    }
    pulls
}

#[test]
fn each_pair_of_bodies_has_its_own_law() {
    let one = |law: &str| format!("{{ between = ['a', 'b'], {law} }}");
    let two = |law: &str| format!("{{ between = ['b', 'c'], {law} }}");
    for (first, _) in WITH_ENERGY {
        for (second, _) in WITH_ENERGY {
            let alone = pulls(&parse(&blocks(&one(first), LAGRANGIAN)));
            let other = pulls(&parse(&blocks(&two(second), LAGRANGIAN)));
            let both = pulls(&parse(&blocks(&format!("{}, {}", one(first), two(second)), LAGRANGIAN)));
            // The colour of two neighbours adds up on both sides of b.
            assert!(alone[0] > 1e-3 && other[2] > 1e-3 && alone[2] == 0.0, "{first} {second}: {alone:?} {other:?}");
            let colours = first.contains("colour") && second.contains("colour");
            assert!(colours || ((both[0] - alone[0]).abs() < 1e-12 && (both[2] - other[2]).abs() < 1e-12), "{first} {second}");
        }
    }
    let scene = parse(&blocks(&format!("{}, {}", two(WITH_ENERGY[1].0), one(WITH_ENERGY[0].0)), LAGRANGIAN));
    assert_eq!(scene.method.contact.potentials, [Potential::Barrier, Potential::Quadratic]);
}

#[test]
fn impossible_contacts_are_refused() {
    let barrier = "potential = { law = 'barrier', stiffness = 1, range = 1 }";
    let cases = [
        (format!("{{ between = ['a', 'b'], {barrier} }}, {{ between = ['b', 'a'], {barrier} }}"), LAGRANGIAN, "name them once"),
        (format!("{{ between = ['a', 'b'], {barrier}, zones = {{ radius = 1 }} }}"), LAGRANGIAN, "two bodies touch by one law"),
        (format!("{{ between = ['a', 'b'], {barrier} }}"), "", "name kernel = 0"),
        (format!("{{ between = ['a', 'a'], {barrier} }}"), "", "self-contact needs"),
        (
            "{ between = ['a', 'b'], potential = { law = 'power', stiffness = 1, range = 1, exponent = 3 } }".into(),
            LAGRANGIAN,
            "belongs to the law `repulsive`",
        ),
        ("{ between = ['a', 'b'], zones = { radius = 1, corner = 0.8 } }".into(), LAGRANGIAN, "0 <= corner <= surface <= 1"),
        ("{ between = ['a', 'b'], zones = { radius = 0 } }".into(), LAGRANGIAN, "radius must be a positive number"),
        (
            "{ between = ['a', 'b'], zones = { radius = 1 } }, { between = ['b', 'c'], zones = { radius = 1, form = 'printed' } }"
                .into(),
            LAGRANGIAN,
            "share form, normals, surface and corner",
        ),
        (
            "{ between = ['a', 'b'], colour_field = { stiffness = 1, threshold = 1, range = 4 } }".into(),
            LAGRANGIAN,
            "threshold must lie between 0 and 1",
        ),
        (
            "{ between = ['a', 'b'], colour_field = { stiffness = 1, threshold = 0.1, range = 4 } },
              { between = ['b', 'c'], colour_field = { stiffness = 2, threshold = 0.1, range = 4 } }"
                .into(),
            LAGRANGIAN,
            "share one stiffness, threshold and range",
        ),
    ];
    for (contacts, formulation, sentence) in cases {
        let error = Scene::parse(&blocks(&contacts, formulation), "s.toml", None, &[]).err();
        let error = error.unwrap_or_else(|| panic!("{contacts} is taken"));
        assert!(error.contains(sentence) && !error.contains('\n'), "{contacts}: {error}");
    }
}
