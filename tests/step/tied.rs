//! Tied bodies against exact solutions: bars in series and side by side, a round inclusion; energy; and what is refused.

use crate::common::parse;
use crate::pass::tied::blocks;
use lithosph::backend::Choice;
use lithosph::run::{Finished, Options, run};
use lithosph::scene::{Scene, SceneConstraint};

fn finished(scene: &Scene) -> Finished {
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
    run(scene, &options).unwrap_or_else(|stop| panic!("{stop:?}"))
}

fn last(run: &Finished, name: &str) -> f64 {
    *run.table.columns[name].last().unwrap()
}

/// A bar of two halves of length 20, the second `ratio` times as stiff. Its ends, the middles of the outermost particles, are moved
/// apart by 4e-4.
fn series(spacing: f64, ratio: f64) -> Finished {
    let grip = |at: f64, velocity: f64| {
        let (low, high) = (at - 0.25 * spacing, at + 0.25 * spacing);
        format!(
            "[[boundary]]\nselect = {{ inside = {{ block = {{ min = [{low}], max = [{high}] }} }} }}\nvelocity = [{velocity}]\n"
        )
    };
    let mean = |name: &str, from: f64| {
        format!(
            "{name} = {{ kind = 'mean', field = 'stress.xx', inside = {{ block = {{ min = [{from}], max = [{}] }} }} }}\n",
            from + 8.0
        )
    };
    let probe = |name: &str, at: f64| format!("{name} = {{ kind = 'probe', field = 'displacement.x', at = [{at}] }}\n");
    let end = 0.5 * spacing;
    finished(&parse(&format!(
        "title = 'series'\ndimension = 1\nspacing = {spacing}\nduration = 1
        [[body]]\nname = 'soft'\nshape = {{ block = {{ min = [0], max = [20] }} }}\nanchor = [{end}]\nmaterial = 'soft'
        [[body]]\nname = 'stiff'\nshape = {{ block = {{ min = [20], max = [40] }} }}\nanchor = [{end}]\nmaterial = 'stiff'
        [[contact]]\nbetween = ['soft', 'stiff']\ntie = true
        [material.soft]\nlaw = 'st_venant_kirchhoff'\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0
        [material.stiff]\nlaw = 'st_venant_kirchhoff'\ndensity = 2\nyoungs_modulus = {ratio}\npoisson_ratio = 0
        [formulation]\nkind = 'total_lagrangian'\n[quasi_static]\nload_steps = 1\nresidual = 1e-8\n{}{}
        [observe]\n{}{}{}{}{}{}load = {{ kind = 'force', axis = 'x', inside = {{ block = {{ min = [0], max = [{spacing}] }} }} }}\n",
        grip(end, 0.0),
        grip(40.0 - end, 4e-4),
        mean("soft_stress", 6.0),
        mean("stiff_stress", 26.0),
        probe("a", 6.25),
        probe("b", 14.25),
        probe("c", 26.25),
        probe("d", 34.25),
    )))
}

/// One stress throughout, strains as the inverse of the moduli, and a load that nears that of two springs in series.
#[test]
fn bars_in_series_share_the_stress() {
    for ratio in [5.0, 70.0] {
        let errors = [1.0, 0.5].map(|spacing| {
            let run = series(spacing, ratio);
            let of = |name: &str| last(&run, name);
            let (stress, load) = (of("soft_stress"), of("load"));
            println!("ratio {ratio}, spacing {spacing}: stresses {stress:.6e}, {:.6e}, load {load:.6e}", of("stiff_stress"));
            assert!((of("stiff_stress") / stress - 1.0).abs() < 1e-4);
            assert!(((of("b") - of("a")) / (of("d") - of("c")) / ratio - 1.0).abs() < 1e-4);
            assert!((load.abs() / stress - 1.0).abs() < 1e-3);
            // Of the halves the grips leave half a spacing.
            let length = 20.0 - 0.5 * spacing;
            stress / (4e-4 / (length + length / ratio)) - 1.0
        });
        println!("ratio {ratio}: error of the load {:.4} at spacing 1, {:.4} at 0.5", errors[0], errors[1]);
        assert!(errors[0].abs() < 0.02 && errors[1].abs() < 0.6 * errors[0].abs(), "{errors:?}");
    }
}

/// Layers 4 thick, of which the middle one is stiffer, are stretched together: one strain, stresses as the moduli.
#[test]
fn layers_side_by_side_share_the_strain() {
    let ratio = 20.0;
    let layer = |name: &str, low: f64, material: &str| {
        format!(
            "[[body]]\nname = '{name}'\nshape = {{ block = {{ min = [0, {low}], max = [30, {}] }} }}\nanchor = [0.5, 0.5]\nmaterial = '{material}'\n",
            low + 4.0
        )
    };
    let mean = |name: &str, low: f64| {
        let block = format!("{{ block = {{ min = [12, {low}], max = [18, {}] }} }}", low + 4.0);
        format!("{name} = {{ kind = 'mean', field = 'stress.xx', inside = {block} }}\n")
    };
    let probe =
        |name: &str, x: f64, y: f64| format!("{name} = {{ kind = 'probe', field = 'displacement.x', at = [{x}, {y}] }}\n");
    let run = finished(&parse(&format!(
        "title = 'layers'\ndimension = 2\nspacing = 1\nduration = 1\n{}{}{}
        [[contact]]\nbetween = ['lower', 'middle']\ntie = true\n[[contact]]\nbetween = ['middle', 'upper']\ntie = true
        [material.soft]\nlaw = 'st_venant_kirchhoff'\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0
        [material.stiff]\nlaw = 'st_venant_kirchhoff'\ndensity = 2\nyoungs_modulus = {ratio}\npoisson_ratio = 0
        [[boundary]]\nselect = {{ inside = {{ block = {{ min = [0, 0], max = [1, 12] }} }} }}\nvelocity = [0, 'free']
        [[boundary]]\nselect = {{ inside = {{ block = {{ min = [29, 0], max = [30, 12] }} }} }}\nvelocity = [0.003, 'free']
        [formulation]\nkind = 'total_lagrangian'\n[quasi_static]\nload_steps = 1\nresidual = 1e-7
        [observe]\nload = {{ kind = 'force', axis = 'x', inside = {{ block = {{ min = [0, 0], max = [1, 12] }} }} }}\n{}{}{}{}{}{}{}",
        layer("lower", 0.0, "soft"),
        layer("middle", 4.0, "stiff"),
        layer("upper", 8.0, "soft"),
        mean("lower", 0.0),
        mean("middle", 4.0),
        mean("upper", 8.0),
        probe("a", 12.5, 10.5),
        probe("b", 18.5, 10.5),
        probe("c", 12.5, 6.5),
        probe("d", 18.5, 6.5),
    )));
    let of = |name: &str| last(&run, name);
    println!("stresses {:.6e} {:.6e} {:.6e}, load {:.6e}", of("lower"), of("middle"), of("upper"), of("load"));
    assert!(((of("b") - of("a")) / (of("d") - of("c")) - 1.0).abs() < 1e-3);
    assert!((of("middle") / of("upper") / ratio - 1.0).abs() < 1e-3);
    assert!((of("lower") / of("upper") - 1.0).abs() < 1e-6);
    let section = 4.0 * (of("lower") + of("middle") + of("upper"));
    assert!((of("load").abs() / section - 1.0).abs() < 1e-3);
    // The stretch between the probes, 6 apart, for the grips hold the layers near them too firmly.
    let exact = (of("d") - of("c")) / 6.0 * 4.0 * (ratio + 2.0);
    assert!((of("load").abs() / exact - 1.0).abs() < 1e-3, "{} {exact}", of("load"));
}

/// Stress along and across the tension inside a round inclusion of modulus E_i in an infinite plate of modulus 1, both over the
/// tension, and the displacement at a point of the plate for unit tension and radius: Goodier 1933, in plane strain.
struct Goodier {
    shear: [f64; 2],
    kolosov: [f64; 2],
}

impl Goodier {
    fn new(ratio: f64, [nu, nu_i]: [f64; 2]) -> Self {
        let shear = [0.5 / (1.0 + nu), 0.5 * ratio / (1.0 + nu_i)];
        Self { shear, kolosov: [3.0 - 4.0 * nu, 3.0 - 4.0 * nu_i] }
    }

    fn stress(&self) -> [f64; 2] {
        let ([m, i], [k, ki]) = (self.shear, self.kolosov);
        let (mean, differ) = (i * (k + 1.0) / (2.0 * i + m * (ki - 1.0)), i * (k + 1.0) / (m + i * k));
        [0.5 * (mean + differ), 0.5 * (mean - differ)]
    }

    fn displacement(&self, x: [f64; 2]) -> [f64; 2] {
        let ([m, i], [k, ki]) = (self.shear, self.kolosov);
        let beta = -2.0 * (i - m) / (m + i * k);
        let gamma = (m * (ki - 1.0) - i * (k - 1.0)) / (2.0 * i + m * (ki - 1.0));
        let delta = (i - m) / (m + i * k);
        let square = x[0] * x[0] + x[1] * x[1];
        let r = square.sqrt();
        let (cos, sin) = (x[0] / r, x[1] / r);
        let (cos_2, sin_2) = (cos * cos - sin * sin, 2.0 * sin * cos);
        let outward = (k - 1.0) * square + 2.0 * gamma + (beta * (k + 1.0) + 2.0 * square + 2.0 * delta / square) * cos_2;
        let around = -(beta * (k - 1.0) + 2.0 * square - 2.0 * delta / square) * sin_2;
        [outward * cos - around * sin, outward * sin + around * cos].map(|u| u / (8.0 * m * r))
    }
}

/// A quarter of a disc of three times the inclusion's radius, 1, whose outermost particles have the exact displacements of a tension
/// of 1e-4: the stress in the middle half of the inclusion over the tension, and the displacement of the particle at (1.5, 0) over
/// the exact one.
fn inclusion(spacing: f64, ratio: f64) -> [f64; 3] {
    const NU: [f64; 2] = [0.35, 0.3];
    const TENSION: f64 = 1e-4;
    let quarter = "{ block = { min = [0, 0], max = [4, 4] } }";
    let disc = |radius: f64| format!("{{ disc = {{ center = [0, 0], radius = {radius} }} }}");
    let anchor = 0.5 * spacing;
    let mut scene = parse(&format!(
        "title = 'inclusion'\ndimension = 2\nspacing = {spacing}\nduration = 1
        [[body]]\nname = 'plate'\nanchor = [{anchor}, {anchor}]\nmaterial = 'soft'
        shape = {{ cut = {{ from = {{ intersection = {{ of = [{quarter}, {outer}] }} }}, remove = [{inner}] }} }}
        [[body]]\nname = 'inclusion'\nanchor = [{anchor}, {anchor}]\nmaterial = 'stiff'
        shape = {{ intersection = {{ of = [{quarter}, {inner}] }} }}
        [[contact]]\nbetween = ['plate', 'inclusion']\ntie = true
        [material.soft]\nlaw = 'st_venant_kirchhoff'\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = {}
        [material.stiff]\nlaw = 'st_venant_kirchhoff'\ndensity = 2\nyoungs_modulus = {ratio}\npoisson_ratio = {}
        [[symmetry]]\npoint = [0, 0]\nnormal = [1, 0]\n[[symmetry]]\npoint = [0, 0]\nnormal = [0, 1]
        [[boundary]]\nselect = {{ inside = {{ cut = {{ from = {quarter}, remove = [{held}] }} }} }}\nvelocity = [0, 0]
        [formulation]\nkind = 'total_lagrangian'\n[quasi_static]\nload_steps = 1\nresidual = 1e-6
        [observe]
        along = {{ kind = 'mean', field = 'stress.xx', inside = {core} }}
        across = {{ kind = 'mean', field = 'stress.yy', inside = {core} }}
        beside = {{ kind = 'probe', field = 'displacement.x', at = [1.5, 0] }}\n",
        NU[0],
        NU[1],
        outer = disc(3.0),
        inner = disc(1.0),
        held = disc(3.0 - 2.6 * spacing),
        core = disc(0.5),
    ));
    let exact = Goodier::new(ratio, NU);
    scene.constraints.clear();
    for particle in &mut scene.particles {
        if particle.constraint != 0 {
            let [x, y] = exact.displacement([particle.position.x, particle.position.y]).map(|u| TENSION * u);
            let constraint =
                SceneConstraint { name: String::new(), prescribed: [true, true, false], vector: [x, y, 0.0], course: Vec::new() };
            scene.constraints.push(constraint);
            particle.constraint = scene.constraints.len() as u32;
        }
    }
    let near = scene.particles[scene.nearest(glam::DVec3::new(1.5, 0.0, 0.0), None, None).unwrap()].position;
    let beside = TENSION * exact.displacement([near.x, near.y])[0];
    let run = finished(&scene);
    [last(&run, "along") / TENSION, last(&run, "across") / TENSION, last(&run, "beside") / beside - 1.0]
}

#[test]
fn the_exact_inclusion_is_that_of_the_hole_and_of_the_plate() {
    let whole = Goodier::new(1.0, [0.3, 0.3]);
    assert!((whole.stress()[0] - 1.0).abs() < 1e-15 && whole.stress()[1].abs() < 1e-15);
    // e_xx = (1 - nu^2)/E, e_yy = -nu (1 + nu)/E of plane strain.
    let [x, y] = whole.displacement([2.0, 3.0]);
    assert!((x - 2.0 * 0.91).abs() < 1e-14 && (y + 3.0 * 0.39).abs() < 1e-14, "{x} {y}");
    // Three times the tension beside a hole: the strain along its edge at its top is that over the plane modulus.
    let hole = Goodier::new(0.0, [0.3, 0.3]);
    assert_eq!(hole.stress(), [0.0, 0.0]);
    let strain = |turn: f64| {
        let u = |angle: f64| hole.displacement([angle.cos(), angle.sin()]);
        (u(turn + 1e-5)[0] - u(turn - 1e-5)[0]) / -2e-5
    };
    assert!((strain(std::f64::consts::FRAC_PI_2) - 3.0 * 0.91).abs() < 1e-8, "{}", strain(std::f64::consts::FRAC_PI_2));
}

#[test]
fn the_stress_inside_a_round_inclusion_nears_the_exact_one() {
    for (ratio, most) in [(10.0, [0.1, 0.05]), (0.1, [0.09, 0.05])] {
        let exact = Goodier::new(ratio, [0.35, 0.3]).stress();
        let errors = [1.0 / 6.0, 1.0 / 12.0].map(|spacing| {
            let [along, across, beside] = inclusion(spacing, ratio);
            println!(
                "ratio {ratio}, spacing {spacing:.3}: {along:.4} and {across:.4} for {:.4} and {:.4}, displacement {beside:.4}",
                exact[0], exact[1]
            );
            [along / exact[0] - 1.0, (across - exact[1]) / exact[0], beside].map(f64::abs)
        });
        for (error, most) in errors.iter().zip(most) {
            assert!(error.iter().all(|error| *error < most), "{errors:?}");
        }
        // Of first order: halving the spacing takes off at least a third of the largest error.
        let worst = errors.map(|error| error.into_iter().fold(0.0, f64::max));
        assert!(worst[1] < 0.67 * worst[0], "{errors:?}");
    }
}

/// Leapfrog's energy swings with the square of the step and does not drift.
#[test]
fn tied_bodies_in_motion_keep_energy() {
    let drift = |step: f64| {
        let laws = ["law = 'neo_hookean'", "law = 'neo_hookean'"];
        let mut scene =
            blocks(2, 20.0, laws, "[observe]\ntotal = { kind = 'total_energy' }\nkinetic = { kind = 'kinetic_energy' }");
        (scene.file.duration, scene.file.time.step, scene.file.output.series) = (40.0, Some(step), Some(1.0));
        scene.particles[30].velocity.x = 0.1;
        let run = finished(&scene);
        let (total, kinetic) = (&run.table.columns["total"], &run.table.columns["kinetic"]);
        // A part of it has gone into strain: there is something to keep.
        assert!(kinetic[5..].iter().all(|e| *e < 0.9 * total[0]));
        total.iter().map(|e| (e / total[0] - 1.0).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (drift(0.05), drift(0.025));
    println!("energy changes by {coarse:.1e}, at half the step by {fine:.1e}");
    assert!(coarse < 1.4e-3 && fine < 0.3 * coarse, "{coarse} {fine}");
}

fn refusal(bodies: [&str; 2], contact: &str, rest: &str) -> String {
    let body = |name: &str, typed: &str| format!("[[body]]\nname = '{name}'\nmaterial = 'rubber'\n{typed}\n");
    let text = format!(
        "title = 'refused'\ndimension = 2\nspacing = 1\nduration = 1\n{}{}[[contact]]\n{contact}
        [material.rubber]\nlaw = 'neo_hookean'\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.3\n{rest}",
        body("left", bodies[0]),
        body("right", bodies[1])
    );
    Scene::parse(&text, "test", None, &[]).map_or_else(|error| error, |_| panic!("not refused:\n{text}"))
}

#[test]
fn what_cannot_be_tied_is_refused() {
    const LEFT: &str = "shape = { block = { min = [0, 0], max = [6, 6] } }\nanchor = [0.5, 0.5]";
    const RIGHT: &str = "shape = { block = { min = [6, 0], max = [12, 6] } }\nanchor = [0.5, 0.5]";
    const TIE: &str = "between = ['left', 'right']\ntie = true";
    const TOTAL: &str = "[formulation]\nkind = 'total_lagrangian'";
    let far = RIGHT.replace("min = [6, 0], max = [12", "min = [7, 0], max = [12");
    let over = RIGHT.replace("min = [6, 0]", "min = [5, 0]");
    let shifted = RIGHT.replace("0.5, 0.5", "0.1, 0.5");
    let finer = format!("{RIGHT}\nspacing = 0.5");
    let other = format!("{RIGHT}\nformulation = 'other'");
    let named = |keys: &str| format!("{TOTAL}\n[formulation.other]\nkind = 'total_lagrangian'\n{keys}");
    let gap = format!("{TIE}\ngap = {{ range = 2 }}");
    let twice = format!("{TIE}\n[[contact]]\nbetween = ['right', 'left']\ngap = {{ range = 2 }}");
    let self_tied = "between = ['left', 'left']\ntie = true";
    for (right, contact, rest, words) in [
        (far.as_str(), TIE, TOTAL, "2.000 spacings apart at [5.5,"),
        (&over, TIE, TOTAL, "overlap at the start: a particle of `left` at (5.5, 0.5)"),
        (&shifted, TIE, TOTAL, "0.600 spacings apart at [5.5,"),
        (&finer, TIE, TOTAL, "tied bodies need one spacing: that of `left` is 1, that of `right` 0.5"),
        (&other, TIE, &named("smoothing_length = 1.5"), "one smoothing length"),
        (&other, TIE, &named("gradient = 'quadratic'"), "their formulations differ in gradient"),
        (RIGHT, TIE, "[formulation]\nkind = 'eulerian'\ngradient = 'adjoint'", "the kernel joins Eulerian bodies"),
        (RIGHT, TIE, "[formulation]\nkind = 'corrected_kernel'", "`corrected_kernel` has none"),
        (RIGHT, &gap, TOTAL, "name no kernel, potential"),
        (RIGHT, &twice, TOTAL, "two tables [[contact]]"),
        (RIGHT, self_tied, TOTAL, "`left` is one body already"),
        (RIGHT, "between = ['left', 'right']\nkernel = 1", TOTAL, "tie = true bonds bodies that share a face"),
        (RIGHT, "between = ['left', 'right']\ntie = false", TOTAL, "gap, tie or none"),
    ] {
        let said = refusal([LEFT, right], contact, rest);
        assert!(said.contains(words), "{said}\nlacks: {words}");
    }
    // Copies, which have one name together and one each.
    let copied =
        "shape = { block = { min = [0, 0], max = [6, 6] } }\nanchor = [0.5, 0.5]\ncopies = { count = [2], apart = [0, 0] }";
    let between = "between = ['left', 'left']\ntie = true\n[[contact]]\nbetween = ['left 1', 'left 2']\ngap = { range = 2 }";
    let said = refusal([copied, "shape = { block = { min = [0, 20], max = [6, 26] } }"], between, TOTAL);
    assert!(said.contains("`left 1` and `left 2` are tied by another [[contact]]"), "{said}");
}

/// A body that touches others by its surface has no facets where a tied one goes on.
#[test]
fn a_shared_face_carries_no_facets() {
    let text = |tie: &str| {
        format!(
            "title = 'facets'\ndimension = 2\nspacing = 1\nduration = 1
            [[body]]\nname = 'left'\nshape = {{ block = {{ min = [0, 0], max = [6, 6] }} }}\nanchor = [0.5, 0.5]\nmaterial = 'rubber'
            [[body]]\nname = 'right'\nshape = {{ block = {{ min = [6, 0], max = [12, 4] }} }}\nanchor = [0.5, 0.5]\nmaterial = 'rubber'
            {tie}\n[[obstacle]]\nname = 'floor'\nshape = {{ plane = {{ point = [0, -1], normal = [0, 1] }} }}
            [material.rubber]\nlaw = 'neo_hookean'\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.3
            [formulation]\nkind = 'total_lagrangian'"
        )
    };
    let apart = parse(&text(""));
    let tied = parse(&text("[[contact]]\nbetween = ['left', 'right']\ntie = true"));
    let length = |scene: &Scene| scene.facets.iter().map(|facet| facet.piece.area).sum::<f64>();
    assert!((length(&apart) - 44.0).abs() < 1e-12);
    assert!((length(&tied) - 36.0).abs() < 1e-12, "{}", length(&tied));
    let inside = |x: f64, y: f64| (x - 6.0).abs() < 1e-9 && y < 4.0;
    assert!(!tied.facets.iter().any(|facet| inside(facet.piece.position.x, facet.piece.position.y)));
}
