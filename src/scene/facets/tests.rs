use super::*;
use crate::scene::packing::{Packing, fill};
use std::f64::consts::{PI, TAU};

fn shape(text: &str) -> Shape {
    toml::from_str(text).unwrap()
}

fn sample(text: &str, spacing: f64, dimension: usize) -> Vec<Facet> {
    facets(&shape(text), spacing, DVec3::splat(spacing / 2.0), dimension)
}

fn total(facets: &[Facet]) -> f64 {
    facets.iter().map(|facet| facet.area).sum()
}

const SIMPLE: [(&str, usize, f64); 9] = [
    ("block = { min = [0.3], max = [4.7] }", 1, 2.0),
    ("block = { min = [0.2, -1.1], max = [7.9, 3.3] }", 2, 2.0 * (7.7 + 4.4)),
    ("block = { min = [0, 0, 0], max = [3.25, 4.5, 0.3] }", 3, 2.0 * (3.25 * 4.5 + 0.3 * 7.75)),
    ("disc = { center = [1, 2], radius = 7.3 }", 2, TAU * 7.3),
    ("ring = { center = [0, 0], inner = 3.3, outer = 5 }", 2, TAU * 8.3),
    ("sphere = { center = [1, 2, 3], radius = 6.2 }", 3, 4.0 * PI * 6.2 * 6.2),
    ("cylinder = { center = [0, 1, 0], axis = [1, 2, 2], radius = 4.4, length = 9 }", 3, TAU * 4.4 * 13.4),
    (
        "tube = { center = [0, 0, 0], axis = [0, 2, 0], inner = 2.5, outer = 4, length = 7.2 }",
        3,
        TAU * 6.5 * 7.2 + TAU * (16.0 - 6.25),
    ),
    ("polygon = { points = [[0, 0], [0, 6], [4, 3], [8, 6], [8, 0]] }", 2, 30.0),
];

#[test]
fn areas_add_up_and_the_surface_is_closed() {
    for (text, dimension, area) in SIMPLE {
        for spacing in [1.0, 0.37] {
            let list = sample(text, spacing, dimension);
            assert!((total(&list) / area - 1.0).abs() < 1e-12, "{text} {} {area}", total(&list));
            let sum: DVec3 = list.iter().map(|facet| facet.area * facet.normal).sum();
            assert!(sum.length() < 1e-12 * area, "{text} {sum}");
        }
    }
}

#[test]
fn facets_stand_on_the_surface_and_point_out() {
    let mixed = [
        ("union = { of = [{ disc = { center = [0, 0], radius = 5 } }, { block = { min = [0, -2], max = [9, 2] } }] }", 2),
        (
            "cut = { from = { sphere = { center = [0, 0, 0], radius = 5 } }, remove = [{ cylinder = { center = [0, 0, 0], radius = 2, length = 20 } }] }",
            3,
        ),
    ];
    for (text, dimension) in SIMPLE.iter().map(|row| (row.0, row.1)).chain(mixed) {
        let shape = shape(text);
        for facet in sample(text, 0.5, dimension) {
            assert!(shape.distance(facet.position, dimension).abs() < 1e-12, "{text} {facet:?}");
            assert!(shape.distance(facet.position + 0.01 * facet.normal, dimension) > 0.0099, "{text} {facet:?}");
            assert!(shape.distance(facet.position - 0.01 * facet.normal, dimension) < -0.0099, "{text} {facet:?}");
            assert!((facet.normal.length() - 1.0).abs() < 1e-14 && facet.area > 0.0);
        }
    }
}

#[test]
fn neighbours_on_round_surfaces_are_about_a_spacing_apart() {
    for (text, dimension, _) in SIMPLE.into_iter().filter(|row| !row.0.starts_with("block")) {
        let list = sample(text, 0.4, dimension);
        for (index, facet) in list.iter().enumerate() {
            let others = list.iter().enumerate().filter(|(other, o)| *other != index && o.normal.dot(facet.normal) > 0.5);
            let nearest = others.map(|(_, o)| o.position.distance(facet.position)).fold(f64::INFINITY, f64::min);
            assert!((0.25..0.5).contains(&nearest), "{text} {nearest}");
            let square = 0.4_f64.powi(dimension as i32 - 1);
            assert!((0.7..1.3).contains(&(facet.area / square)), "{text} {}", facet.area / square);
        }
    }
}

#[test]
fn a_column_has_one_facet_above_each_particle_of_its_surface() {
    let column = shape("block = { min = [0, 0, 0], max = [2, 2, 80] }");
    let list = facets(&column, 1.0, DVec3::splat(0.5), 3);
    let facing = |normal: DVec3| list.iter().filter(move |facet| facet.normal == normal).collect::<Vec<_>>();
    for axis in DVec3::AXES {
        for normal in [axis, -axis] {
            assert_eq!(facing(normal).len(), if axis == DVec3::Z { 4 } else { 160 });
        }
    }
    assert!(list.iter().all(|facet| facet.area == 1.0));
    let points: Vec<DVec3> =
        fill(&column, Packing::Square, 1.0, DVec3::splat(0.5), 3).unwrap().iter().map(|p| p.position).collect();
    for (facet, owner) in list.iter().zip(owners(&list, &points, 1.0)) {
        assert_eq!(points[owner as usize], facet.position - 0.5 * facet.normal);
    }
}

#[test]
fn lattice_points_on_a_face_are_no_facets_and_a_thin_block_has_one_across() {
    let list = facets(&shape("block = { min = [0, 0], max = [4, 0.5] }"), 1.0, DVec3::ZERO, 2);
    let top: Vec<_> = list.iter().filter(|facet| facet.normal == DVec3::Y).map(|f| (f.position.x, f.area)).collect();
    assert_eq!(top, [(1.0, 1.5), (2.0, 1.0), (3.0, 1.5)]);
    let left: Vec<_> = list.iter().filter(|facet| facet.normal == -DVec3::X).map(|f| (f.position.y, f.area)).collect();
    assert_eq!(left, [(0.25, 0.5)]);
}

#[test]
fn combinations_keep_what_is_on_the_whole_surface() {
    let root = |a: f64| a.sqrt();
    let cases = [
        // A square plate with a round hole.
        (
            "cut = { from = { block = { min = [-8, -8], max = [8, 8] } }, remove = [{ disc = { center = [0, 0], radius = 3 } }] }",
            2,
            64.0 + TAU * 3.0,
        ),
        // Two blocks that touch, as one.
        (
            "union = { of = [{ block = { min = [0, 0, 0], max = [4, 4, 4] } }, { block = { min = [4, 0, 0], max = [9, 4, 4] } }] }",
            3,
            2.0 * (16.0 + 2.0 * 36.0),
        ),
        // Two that overlap and share three faces.
        ("union = { of = [{ block = { min = [0, 0], max = [5, 4] } }, { block = { min = [3, 0], max = [9, 4] } }] }", 2, 26.0),
        // A notch whose mouth is flush.
        (
            "cut = { from = { block = { min = [0, 0], max = [8, 4] } }, remove = [{ block = { min = [3, 2], max = [5, 4] } }, { block = { min = [5, 2], max = [6, 4] } }] }",
            2,
            28.0,
        ),
        // A lens of two discs: each arc spans 2 acos(3/5).
        (
            "intersection = { of = [{ disc = { center = [-3, 0], radius = 5 } }, { disc = { center = [3, 0], radius = 5 } }] }",
            2,
            20.0 * (3.0_f64 / 5.0).acos(),
        ),
        // Half a ball.
        (
            "cut = { from = { sphere = { center = [0, 0, 0], radius = 6 } }, remove = [{ block = { min = [-9, -9, 0], max = [9, 9, 9] } }] }",
            3,
            3.0 * PI * 36.0,
        ),
        // A ball with a bore: two spherical caps less, a cylinder more.
        (
            "cut = { from = { sphere = { center = [0, 0, 0], radius = 6 } }, remove = [{ cylinder = { center = [0, 0, 0], radius = 2, length = 20 } }] }",
            3,
            4.0 * PI * 6.0 * root(32.0) + TAU * 2.0 * 2.0 * root(32.0),
        ),
    ];
    for (text, dimension, area) in cases {
        let list = sample(text, 0.5, dimension);
        let found = total(&list);
        assert!((found / area - 1.0).abs() < 0.003, "{text} {found} {area}");
        let sum: DVec3 = list.iter().map(|facet| facet.area * facet.normal).sum();
        assert!(sum.length() < 0.003 * area, "{text} {sum}");
        for (index, facet) in list.iter().enumerate() {
            let same = |other: &&Facet| other.normal.dot(facet.normal) > 0.9 && other.position.distance(facet.position) < 0.05;
            assert_eq!(list[..index].iter().find(same), None, "{text} {facet:?}");
        }
    }
}

#[test]
fn owners_are_the_nearest_particles_and_lie_within_a_spacing() {
    let cases = SIMPLE.iter().map(|row| (row.0, row.1, Packing::Square)).chain([(SIMPLE[3].0, 2, Packing::Rings)]);
    for (text, dimension, packing) in cases {
        let (shape, spacing) = (shape(text), 0.29);
        let anchor = DVec3::splat(0.1);
        let points: Vec<DVec3> = fill(&shape, packing, spacing, anchor, dimension).unwrap().iter().map(|p| p.position).collect();
        let list = facets(&shape, spacing, anchor, dimension);
        for (facet, owner) in list.iter().zip(owners(&list, &points, spacing)) {
            let beneath = facet.position - spacing / 2.0 * facet.normal;
            let distance = points[owner as usize].distance(beneath);
            assert!(points.iter().all(|point| point.distance(beneath) >= distance - 1e-12), "{text}");
            assert!(points[owner as usize].distance(facet.position) < 1.5 * spacing, "{text} {facet:?}");
        }
    }
}

#[test]
fn a_far_particle_is_found_where_none_is_near() {
    let facet = Facet { position: DVec3::ZERO, normal: DVec3::X, area: 1.0 };
    assert_eq!(owners(&[facet], &[DVec3::splat(50.0), DVec3::splat(-40.0)], 1.0), [1]);
}
