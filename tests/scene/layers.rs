//! Layers of particles through the thinnest part of a body.

use lithosph::scene::Scene;

const LAGRANGIAN: &str = "kind = 'total_lagrangian'";

fn open(shape: &str, packing: &str, nu: f64, formulation: &str, more: &str) -> Result<Scene, String> {
    // Solids have three numbers to a place.
    let dimension = if shape.contains("tube") || shape.contains(", 0, 0]") { 3 } else { 2 };
    let text = format!(
        "title = 't'
        dimension = {dimension}
        spacing = 1
        duration = 1
        [[body]]
        name = 'part'
        shape = {{ {shape} }}
        packing = '{packing}'
        material = 'rubber'
        [material.rubber]
        law = 'neo_hookean'
        density = 1
        youngs_modulus = 1
        poisson_ratio = {nu}
        [formulation]
        {formulation}
        {more}"
    );
    Scene::parse(&text, "thin.toml", None, &[])
}

fn warnings(shape: &str, packing: &str, nu: f64) -> Vec<String> {
    let all = open(shape, packing, nu, LAGRANGIAN, "").unwrap().warnings;
    all.into_iter().filter(|line| line.contains("layers of particles")).collect()
}

/// A piece of `height` between two thick piers.
fn lintel(height: f64) -> String {
    format!(
        "union = {{ of = [{{ block = {{ min = [0, 0], max = [8, 8] }} }}, {{ block = {{ min = [8, 3], max = [20, {}] }} }}, \
         {{ block = {{ min = [20, 0], max = [28, 8] }} }}] }}",
        3.0 + height
    )
}

fn ring(thickness: f64) -> String {
    format!("ring = {{ center = [0, 0], inner = {}, outer = 20 }}", 20.0 - thickness)
}

fn tube(thickness: f64) -> String {
    format!("tube = {{ center = [0, 0, 0], inner = {}, outer = 10, length = 8 }}", 10.0 - thickness)
}

/// Cantilever, square, plate, rod, lintel, ring and tube of so many layers, with their packing.
fn parts(layers: f64) -> Vec<(String, &'static str)> {
    let block = |size: &str| {
        let origin = if size.matches(',').count() == 2 { "0, 0, 0" } else { "0, 0" };
        format!("block = {{ min = [{origin}], max = [{size}] }}")
    };
    vec![
        (block(&format!("{layers}, 30")), "square"),
        (block(&format!("{layers}, {layers}")), "square"),
        (block(&format!("12, {layers}, 12")), "cubic"),
        (block(&format!("12, {layers}, {layers}")), "cubic"),
        (block(&format!("{layers}, 5, 12")), "fitted"),
        (lintel(layers), "square"),
        (lintel(layers), "fitted"),
        (ring(layers), "rings"),
        (tube(layers), "rings"),
    ]
}

#[test]
fn a_single_layer_is_refused_with_what_it_takes() {
    for (shape, packing) in parts(1.0) {
        let said = open(&shape, packing, 0.3, LAGRANGIAN, "").map(|_| ()).unwrap_err();
        assert!(said.contains("thin.toml:7: body `part` is one layer of particles thin at ("), "{shape}: {said}");
        assert!(said.contains("at least 3 layers, a spacing of 0.333 or less"), "{shape}: {said}");
    }
}

#[test]
fn two_layers_are_warned_of() {
    for (shape, packing) in parts(2.0) {
        let said = warnings(&shape, packing, 0.3);
        assert!(said.len() == 1 && said[0].contains("`part` is two layers of particles thin at ("), "{shape}: {said:?}");
        assert!(said[0].contains("off by about 10 %") && !said[0].contains("lock"), "{said:?}");
        assert!(said[0].contains("a spacing of 0.667 or less"), "{said:?}");
        let locks = warnings(&shape, packing, 0.49);
        assert!(locks[0].contains("at a Poisson ratio of 0.49 so few lock"), "{locks:?}");
    }
}

#[test]
fn three_layers_and_thick_bodies_pass() {
    let thick = ["disc = { center = [0, 0], radius = 7.3 }", "polygon = { points = [[0, 0], [30, 0], [15, 26]] }"];
    let thick = thick.map(|shape| (shape.to_string(), "square"));
    for (shape, packing) in parts(3.0).into_iter().chain(thick) {
        assert_eq!(warnings(&shape, packing, 0.49), [""; 0], "{shape} {packing}");
    }
}

#[test]
fn half_a_body_at_a_mirror_plane_counts_with_its_image() {
    let strip = |mirror: &str| open("block = { min = [0, 0], max = [1, 30] }", "square", 0.3, LAGRANGIAN, mirror);
    assert!(strip("").is_err());
    let said = strip("[[symmetry]]\npoint = [0, 0]\nnormal = [1, 0]").unwrap().warnings;
    assert!(said.len() == 1 && said[0].contains("two layers"), "{said:?}");
}

#[test]
fn what_corrects_no_gradient_bears_one_layer() {
    let strip = "block = { min = [0, 0], max = [1, 30] }";
    assert!(open(strip, "square", 0.3, "kind = 'total_lagrangian'\ngradient = 'plain'", "").is_ok());
    assert!(open(strip, "square", 0.3, "kind = 'corrected_kernel'", "").is_err());
    assert!(open(strip, "square", 0.3, "kind = 'corrected_kernel'\ncorrection = false", "").is_ok());
}
