use super::*;

fn scene(changes: &str) -> Scene {
    let law = if changes.contains(LAGRANGIAN) { "law = 'neo_hookean'" } else { "law = 'elastic'" };
    let text = format!(
        "title = 't'\ndimension = 2\nunits = 'dimensionless'\nspacing = 1\nduration = 10\n{changes}\n\
         [material.rubber]\n{law}\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.3\n"
    );
    Scene::parse(&text, "s", None, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

const BLOCK: &str = "[[body]]\nname = 'block'\nshape = { block = { min = [0, 0], max = [6, 6] } }\nanchor = [0.5, 0.5]\n\
                     material = 'rubber'\n";
const LAGRANGIAN: &str = "kind = 'total_lagrangian'\n";

fn judged(rest: &str) -> Judged {
    judge::judged(&scene(&format!("{BLOCK}{rest}")))
}

#[test]
fn what_can_be_said_follows_from_what_is_counted() {
    let formulation = |more: &str| judged(&format!("[formulation]\n{LAGRANGIAN}{more}"));
    assert_eq!(formulation(""), Judged::Kept);
    assert_eq!(formulation("viscosity = { alpha = 1 }"), Judged::Falling("viscosity".into()));
    assert_eq!(formulation("viscosity = { alpha = 1 }\ndissipated_energy = true"), Judged::Kept);
    assert_eq!(judged("[formulation]\nkind = 'eulerian'"), Judged::Bounded("stress by rates".into()));
}

#[test]
fn a_steady_force_has_a_potential_and_no_other_drive_is_known() {
    let boundary = |keys: &str| {
        let select = "select = { inside = { block = { min = [0, 0], max = [1, 6] } } }";
        judged(&format!("[[boundary]]\nname = 'end'\n{select}\n{keys}\n[formulation]\n{LAGRANGIAN}"))
    };
    assert_eq!(boundary("force = [0.1, 0]"), Judged::Kept);
    assert_eq!(boundary("force = [0.1, 0]\ncourse = [[0, 2], [5, 2]]"), Judged::Kept);
    assert_eq!(boundary("fixed = true"), Judged::Kept);
    let reason = |judged: Judged| judged.reason_against().unwrap_or_default().to_string();
    assert!(reason(boundary("force = [0.1, 0]\ncourse = [[0, 0], [5, 1]]")).contains("`end` is pushed by a force"));
    assert!(reason(boundary("velocity = [0.1, 'free']")).contains("`end` is driven by a velocity"));
    let obstacle = |keys: &str| {
        let shape = "shape = { plane = { point = [0, -1], normal = [0, 1] } }";
        judged(&format!("[[obstacle]]\nname = 'tool'\n{shape}\n{keys}\n[formulation]\n{LAGRANGIAN}"))
    };
    assert_eq!(obstacle(""), Judged::Kept);
    assert_eq!(obstacle("velocity = [0, 1]\nmass = 2"), Judged::Kept);
    assert!(reason(obstacle("velocity = [0, 1]")).contains("obstacle `tool` is driven"));
}

#[test]
fn digits_are_three() {
    for (value, text) in [(0.0, "0"), (31.24, "31.2"), (1234.6, "1235"), (0.0312, "0.0312"), (2.5e-5, "2.50e-5"), (3e7, "3.00e7")]
    {
        assert_eq!(short(value), text);
    }
}
