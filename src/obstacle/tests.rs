use super::*;
use crate::tensor::{Line, Plane, Solid};
use std::f64::consts::{PI, TAU};

/// One that is askew, in a space of this dimension.
fn obstacle(kind: ObstacleKind, dimension: usize) -> Obstacle<f64> {
    let (axis, turn) = match dimension {
        1 => (DVec3::X, DVec3::Y),
        2 => (DVec3::new(0.6, -0.8, 0.0), DVec3::Z),
        _ => (DVec3::new(1.0, -2.0, 2.0), DVec3::new(3.0, 1.0, 0.5)),
    };
    Obstacle::new(kind, DVec3::ZERO, [axis, turn], 1.7, BERKOVICH)
}

/// Points of a cube of half side 3, on no symmetry of the obstacles.
fn points<S: Space<Real = f64>>() -> Vec<S::Vec> {
    let share = |k: usize, factor: f64| 6.0 * ((k as f64 * factor).fract() - 0.5);
    (1..2000).map(|k| S::vec_from([share(k, 0.7548776662), share(k, 0.5698402910), share(k, 0.3247179572)])).collect()
}

fn length<S: Space<Real = f64>>(v: S::Vec) -> f64 {
    S::inner(v, v).sqrt()
}

fn normals_are_gradients<S: Space<Real = f64>>() {
    let step = 1e-6;
    for &kind in ObstacleKind::ALL.iter().filter(|kind| kind.fits(S::DIMENSION)) {
        let obstacle = obstacle(kind, S::DIMENSION);
        let mut bent = 0;
        for x in points::<S>() {
            let (gap, normal) = distance::<S>(&obstacle, x);
            assert!((length::<S>(normal) - 1.0).abs() < 1e-14, "{kind:?} {x:?}");
            let near = |k: usize, sign: f64| {
                let mut x = x;
                x[k] += sign * step;
                distance::<S>(&obstacle, x)
            };
            // A kink of the distance, an edge of the pyramid for one, has no gradient.
            if (0..S::DIMENSION).any(|k| S::inner(near(k, 1.0).1, near(k, -1.0).1) < 0.99) {
                bent += 1;
                continue;
            }
            for k in 0..S::DIMENSION {
                let slope = (near(k, 1.0).0 - near(k, -1.0).0) / (2.0 * step);
                assert!((slope - normal[k]).abs() < 1e-8, "{kind:?} {x:?} {slope} {normal:?}");
            }
            // The nearest point of the surface lies at the end of the normal; over the edges of the pyramid it may not.
            // A place is a few units long, of which some ulp of 9e-16 are lost.
            let on_surface = distance::<S>(&obstacle, x - normal * gap).0;
            assert!(on_surface.abs() < 3e-14 || (kind == ObstacleKind::Berkovich && gap > 0.0), "{kind:?} {x:?} {on_surface}");
        }
        assert!(bent < 3, "{kind:?}: {bent} kinks");
    }
}

#[test]
fn normals_are_the_gradient_of_the_distance_and_lead_to_the_surface() {
    normals_are_gradients::<Line<f64>>();
    normals_are_gradients::<Plane<f64>>();
    normals_are_gradients::<Solid<f64>>();
}

#[test]
fn distances_are_those_of_geometry() {
    type S = Solid<f64>;
    let at = |kind, angle, x: [f64; 3]| {
        let obstacle = Obstacle::new(kind, DVec3::ZERO, [DVec3::Z, DVec3::X], 2.0, angle);
        let (gap, normal) = distance::<S>(&obstacle, S::vec_from(x));
        (gap, S::vec_to(normal))
    };
    let close = |(gap, normal): (f64, [f64; 3]), expected: f64, direction: [f64; 3]| {
        let off = DVec3::from_array(normal).distance(DVec3::from_array(direction));
        assert!((gap - expected).abs() < 1e-15 && off < 1e-15, "{gap} {expected} {normal:?} {direction:?}");
    };
    close(at(ObstacleKind::Plane, 0.0, [5.0, 6.0, -0.5]), -0.5, [0.0, 0.0, 1.0]);
    // Its centre is 2 above the point.
    close(at(ObstacleKind::Sphere, 0.0, [3.0, 0.0, 6.0]), 3.0, [0.6, 0.0, 0.8]);
    close(at(ObstacleKind::Sphere, 0.0, [0.0, 1.0, 2.0]), -1.0, [0.0, 1.0, 0.0]);
    // Along x.
    close(at(ObstacleKind::Cylinder, 0.0, [-9.0, 4.0, 5.0]), 3.0, [0.0, 0.8, 0.6]);
    let half = 0.5_f64.sqrt();
    close(at(ObstacleKind::Cone, 45.0, [0.0, 2.0, 0.0]), 2.0 * half, [0.0, half, -half]);
    close(at(ObstacleKind::Cone, 45.0, [0.0, 1.0, 2.0]), -half, [0.0, half, -half]);
    close(at(ObstacleKind::Cone, 45.0, [3.0, 0.0, -4.0]), 5.0, [0.6, 0.0, -0.8]);
    close(at(ObstacleKind::Berkovich, 45.0, [3.0, 0.0, 1.0]), 2.0 * half, [half, 0.0, -half]);
}

#[test]
fn normals_are_defined_where_the_gradient_is_not() {
    for kind in [ObstacleKind::Cone, ObstacleKind::Berkovich] {
        let obstacle = Obstacle::new(kind, DVec3::ZERO, [DVec3::Z, DVec3::X], 0.0, 70.0);
        for height in [0.0, 0.5, 1e-30] {
            let (gap, normal) = distance::<Solid<f64>>(&obstacle, Solid::<f64>::vec_from([0.0, 0.0, height]));
            assert_eq!((gap, Solid::<f64>::vec_to(normal)), (-height * obstacle.sine, [0.0, 0.0, -1.0]), "{kind:?}");
        }
    }
    let ball = Obstacle::new(ObstacleKind::Sphere, DVec3::ZERO, [DVec3::Y, DVec3::X], 3.0, 0.0);
    let (gap, normal) = distance::<Plane<f64>>(&ball, Plane::<f64>::vec_from([0.0, 3.0, 0.0]));
    assert_eq!((gap, Plane::<f64>::vec_to(normal)), (-3.0, [0.0, -1.0, 0.0]));
}

#[test]
fn sections_have_the_area_of_the_indenter() {
    let measured = |obstacle: &Obstacle<f64>, height: f64| {
        let rays = 30_000;
        let ray = |k: usize| {
            let (sine, cosine) = (TAU * k as f64 / rays as f64).sin_cos();
            let inside =
                |r: f64| distance::<Solid<f64>>(obstacle, Solid::<f64>::vec_from([r * cosine, r * sine, height])).0 < 0.0;
            let (mut low, mut high) = (0.0, 20.0 * height);
            for _ in 0..50 {
                let middle = (low + high) / 2.0;
                if inside(middle) { low = middle } else { high = middle }
            }
            low * low / 2.0
        };
        (0..rays).map(ray).sum::<f64>() * TAU / rays as f64
    };
    let vickers = 4.0 * 68_f64.to_radians().tan().powi(2);
    let cases = [
        (ObstacleKind::Berkovich, BERKOVICH, vickers),
        (ObstacleKind::Berkovich, 65.3, 24.56),
        (ObstacleKind::Cone, 70.3, vickers),
        (ObstacleKind::Cone, 45.0, PI),
    ];
    for (kind, angle, factor) in cases {
        let obstacle = Obstacle::new(kind, DVec3::ZERO, [DVec3::Z, DVec3::X], 0.0, angle);
        let height = 0.3;
        let area = measured(&obstacle, height) / (height * height);
        let of_square = if kind == ObstacleKind::Cone { PI } else { 27_f64.sqrt() };
        let exact = of_square * angle.to_radians().tan().powi(2);
        assert!((area / exact - 1.0).abs() < 1e-6, "{kind:?} {area}");
        assert!((area / factor - 1.0).abs() < 1e-3, "{kind:?} at {angle} degrees {area} {factor}");
    }
}

#[test]
fn a_gap_near_the_first_touch_keeps_its_digits_in_single_precision() {
    let ball = Obstacle::new(ObstacleKind::Sphere, DVec3::ZERO, [DVec3::Z, DVec3::X], 1.0, 0.0);
    let (mut worst, mut from_center) = (0.0_f64, 0.0_f64);
    for k in 1..1000 {
        let (across, height) = (1e-3 * (k as f32 * 0.7548777).fract(), 1e-6 * ((k as f32 * 0.5698403).fract() - 0.3));
        let x = [f64::from(across), 0.0, f64::from(height)];
        let exact = distance::<Solid<f64>>(&ball, Solid::<f64>::vec_from(x)).0;
        let gap = distance::<Solid<f32>>(&ball.cast(), Solid::<f32>::vec_from(x)).0;
        worst = worst.max((f64::from(gap) - exact).abs());
        let below = height - 1.0;
        from_center = from_center.max((f64::from((across * across + below * below).sqrt() - 1.0) - exact).abs());
    }
    // Half an ulp of the terms, 1e-6 here, a few times; the centre as the origin leaves half an ulp of the radius.
    assert!(worst < 4.0 * 6e-8 * 1e-6, "{worst:e}");
    assert!(from_center > 1e4 * worst, "{from_center:e} {worst:e}");
}

#[test]
fn kinds_are_numbered_in_order_and_go_by_two_names() {
    #[derive(serde::Deserialize)]
    struct Typed {
        kind: ObstacleKind,
    }
    let parse = |word: &str| toml::from_str::<Typed>(&format!("kind = '{word}'")).unwrap().kind;
    assert_eq!((parse("disc"), parse("wedge")), (ObstacleKind::Sphere, ObstacleKind::Cone));
    for (number, &kind) in ObstacleKind::ALL.iter().enumerate() {
        assert_eq!((kind as usize, parse(kind.name())), (number, kind));
    }
}
