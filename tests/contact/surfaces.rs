//! Contact of surfaces by facets: what it keeps, and that it does not rub where it should not.

use crate::common::{in_order, parse, steps};
use crate::pass::lagrangian::{assert_force_is_the_gradient_of_the_energy, assert_momenta_stay, begun, energy, resultants};
use glam::DVec3;
use lithosph::backend::cpu::Cpu;
use lithosph::fields::Field;
use lithosph::scene::Scene;
use lithosph::tensor::{Plane, Solid, Space};

const RUBBER: &str = "[material.rubber]\nlaw = 'neo_hookean'\ndensity = 1.3\nyoungs_modulus = 1.0\npoisson_ratio = 0.3
    [formulation]\nkind = 'total_lagrangian'\n";

/// Two bodies that overlap a little: a disc and a block, or two blocks of which one stands askew.
fn overlapping(dimension: usize, gap: &str) -> Scene {
    let bodies = match dimension {
        2 => {
            "[[body]]\nname = 'a'\nshape = { disc = { center = [0, 5.9], radius = 6 } }\nanchor = [0.1, 5.7]\nmaterial = 'rubber'
            [[body]]\nname = 'b'\nshape = { block = { min = [-8, -5], max = [8, 0] } }\nanchor = [0.5, -0.5]\nmaterial = 'rubber'"
        }
        _ => {
            "[[body]]\nname = 'a'\nshape = { block = { min = [0, 0, 0], max = [4, 4, 4] } }\nanchor = [0.5, 0.5, 0.5]\nmaterial = 'rubber'
            [[body]]\nname = 'b'\nshape = { block = { min = [3.9, 0.6, 1.3], max = [6.9, 4.6, 5.3] } }\nanchor = [4.4, 1.1, 1.8]
            material = 'rubber'"
        }
    };
    parse(&format!(
        "title = 'contact'\ndimension = {dimension}\nspacing = 1.0\nduration = 1.0\n{bodies}
        [[contact]]\nbetween = ['a', 'b']\ngap = {{ {gap} }}\n{RUBBER}"
    ))
}

/// A body between rigid obstacles.
fn between_obstacles(dimension: usize) -> Scene {
    let (shape, obstacles) = match dimension {
        2 => (
            "disc = { center = [0, 0], radius = 6 }",
            "[[obstacle]]\nname = 'floor'\nshape = { plane = { point = [0, -5.8], normal = [0.1, 1] } }
            [[obstacle]]\nname = 'wedge'\nshape = { cone = { apex = [0, 5.8], axis = [0, 1], half_angle = 60 } }
            [[obstacle]]\nname = 'ball'\nshape = { sphere = { center = [-9, 1], radius = 3.2 } }",
        ),
        _ => (
            "block = { min = [0, 0, 0], max = [5, 5, 4] }",
            "[[obstacle]]\nname = 'tip'\nshape = { berkovich = { apex = [2.4, 2.6, 3.7], axis = [0, 0, 1], turn = 20 } }
            [[obstacle]]\nname = 'bar'\nshape = { cylinder = { center = [-2.9, 2, 2], axis = [0, 1, 0.2], radius = 3 } }
            [[obstacle]]\nname = 'cone'\nshape = { cone = { apex = [2, 2, 0.2], axis = [0, 0, -1], half_angle = 70.3 } }",
        ),
    };
    parse(&format!(
        "title = 'obstacles'\ndimension = {dimension}\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'body'\nshape = {{ {shape} }}\nanchor = {:?}\nmaterial = 'rubber'\n{obstacles}\n{RUBBER}",
        vec![0.5; dimension]
    ))
}

fn contact_energy<S: Space<Real = f64>>(scene: &Scene) -> f64 {
    begun::<S>(scene).members[0].columns.contact_energy.iter().sum()
}

#[test]
fn the_force_of_surfaces_is_minus_the_gradient_of_the_energy() {
    for gap in ["", "range = 1.5, stiffness = 5"] {
        assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&overlapping(2, gap));
        assert_force_is_the_gradient_of_the_energy::<Solid<f64>>(&overlapping(3, gap));
    }
    assert!(contact_energy::<Plane<f64>>(&overlapping(2, "")) > 1e-4);
    assert!(contact_energy::<Solid<f64>>(&overlapping(3, "")) > 1e-3);
}

#[test]
fn the_force_of_obstacles_is_minus_the_gradient_of_the_energy() {
    assert_force_is_the_gradient_of_the_energy::<Plane<f64>>(&between_obstacles(2));
    assert_force_is_the_gradient_of_the_energy::<Solid<f64>>(&between_obstacles(3));
    assert!(contact_energy::<Plane<f64>>(&between_obstacles(2)) > 1e-3);
    assert!(contact_energy::<Solid<f64>>(&between_obstacles(3)) > 1e-3);
}

#[test]
fn surfaces_have_no_resultant_and_no_moment_but_along_their_normals() {
    assert_momenta_stay::<Plane<f64>>(&overlapping(2, ""));
    assert_momenta_stay::<Solid<f64>>(&overlapping(3, ""));
    let (force, moment) = resultants::<Plane<f64>>(&overlapping(2, "form = 'along_normals'"));
    assert!(force < 1e-13 && moment > 1e-6, "{force:e} {moment:e}");
    let (force, moment) = resultants::<Solid<f64>>(&overlapping(3, "form = 'along_normals'"));
    assert!(force < 1e-13 && moment > 1e-6, "{force:e} {moment:e}");
}

/// Sums over the particles: m v, x cross v m, and energies of motion, material, hourglass terms and contact, and heat.
fn sums(cpu: &mut Cpu<Plane<f64>>) -> [f64; 3] {
    let state = &cpu.members[0];
    let (mut momentum, mut spin) = (0.0, 0.0);
    for a in 0..state.params.count as usize {
        let (x, v, m) = (state.position(a), state.columns.velocity[a], state.mass(a));
        (momentum, spin) = (momentum + m * v[0], spin + m * (x[0] * v[1] - x[1] * v[0]));
    }
    let heat: f64 = (0..state.params.count as usize).map(|a| state.mass(a) * state.columns.dissipated_energy[a]).sum();
    [momentum, spin, heat]
}

#[test]
fn rubbing_discs_keep_both_momenta_and_heat_up() {
    let disc = |name: &str, at: [f64; 2], v: [f64; 2]| {
        format!(
            "[[body]]\nname = '{name}'\nshape = {{ disc = {{ center = {at:?}, radius = 8 }} }}\nanchor = {at:?}
            velocity = {v:?}\nmaterial = 'rubber'\n"
        )
    };
    let scene = parse(&format!(
        "title = 'discs'\ndimension = 2\nspacing = 1.0\nduration = 100.0\n{}{}[[contact]]\nbetween = ['a', 'b']
        gap = {{ friction = 0.5 }}\n{RUBBER}dissipated_energy = true",
        disc("a", [-8.3, 3.0], [0.08, 0.0]),
        disc("b", [8.0, -2.6], [-0.08, 0.01])
    ));
    let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
    let before = sums(&mut cpu);
    steps(&mut cpu, 250);
    let after = sums(&mut cpu);
    let mass = 1.3 * 2.0 * 201.0;
    assert!((after[0] - before[0]).abs() < 1e-12 * mass * 0.08, "momentum {before:?} {after:?}");
    assert!((after[1] - before[1]).abs() < 1e-12 * mass * 0.08 * 10.0, "angular momentum {before:?} {after:?}");
    assert!(after[2] > 1e-3 && before[2] == 0.0, "heat {after:?}");
}

/// Mass of the ball.
const BALL: f64 = 15.0;

/// Where it begins.
fn center(dimension: usize) -> DVec3 {
    if dimension == 2 { DVec3::new(2.3, 4.2, 0.0) } else { DVec3::new(1.3, 0.4, 4.2) }
}

/// A block at rest that a free ball strikes aside of its middle.
fn struck(dimension: usize) -> Scene {
    let (block, velocity) = match dimension {
        2 => ("min = [-6, -5], max = [6, 0]", "[0.01, -0.05]"),
        _ => ("min = [-3, -3, -3], max = [3, 3, 0]", "[0.01, 0.02, -0.05]"),
    };
    let center = &center(dimension).to_array()[..dimension];
    parse(&format!(
        "title = 'free'\ndimension = {dimension}\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'block'\nshape = {{ block = {{ {block} }} }}\nanchor = {:?}\nmaterial = 'rubber'
        [[obstacle]]\nname = 'ball'\nshape = {{ sphere = {{ center = {center:?}, radius = 4 }} }}\nmass = {BALL}\nvelocity = {velocity}\n{RUBBER}",
        vec![0.5; dimension]
    ))
}

/// Momentum, angular momentum and energy of the bodies and the ball.
fn kept<S: Space<Real = f64>>(cpu: &mut Cpu<S>) -> [f64; 7] {
    cpu.members[0].clock.running = 1;
    let stored = energy::<S>(&mut cpu.members[0]);
    let state = &cpu.members[0];
    let (mut momentum, mut spin, mut motion) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    let vector = |v: S::Vec| DVec3::from_array(std::array::from_fn(|k| if k < S::DIMENSION { v[k] } else { 0.0 }));
    let mut add = |x: DVec3, v: DVec3, m: f64| {
        (momentum, spin, motion) = (momentum + v * m, spin + x.cross(v) * m, motion + 0.5 * m * v.length_squared());
    };
    for a in 0..state.params.count as usize {
        add(vector(state.position(a)), vector(state.columns.velocity[a]), state.mass(a));
    }
    let ball = &state.columns;
    add(center(S::DIMENSION) + vector(ball.obstacle_displacement[0]), vector(ball.obstacle_velocity[0]), BALL);
    let [[a, b, c], [d, e, f]] = [momentum.to_array(), spin.to_array()];
    [a, b, c, d, e, f, motion + stored]
}

fn assert_a_free_ball_gives_what_it_loses<S: Space<Real = f64>>() {
    let scene = struck(S::DIMENSION);
    let mut cpu = Cpu::new(scene.state::<S>(false));
    steps(&mut cpu, 0);
    let before = kept(&mut cpu);
    let fall = |cpu: &Cpu<S>| cpu.members[0].columns.obstacle_velocity[0][S::DIMENSION - 1];
    let first = fall(&cpu);
    steps(&mut cpu, 700);
    let after = kept(&mut cpu);
    assert!(first < 0.0 && fall(&cpu) > 0.1 * -first, "the ball leaves upward: {first} {}", fall(&cpu));
    assert_eq!(cpu.members[0].columns.facet_obstacle.iter().max(), Some(&0), "and has left");
    for k in 0..6 {
        let size = BALL * 0.05 * if k < 3 { 1.0 } else { 5.0 };
        assert!((after[k] - before[k]).abs() < 1e-12 * size, "{k}: {before:?} {after:?}");
    }
    assert!((after[6] / before[6] - 1.0).abs() < 1e-3, "energy: {before:?} {after:?}");
}

#[test]
fn a_free_ball_gives_what_it_loses() {
    assert_a_free_ball_gives_what_it_loses::<Plane<f64>>();
    assert_a_free_ball_gives_what_it_loses::<Solid<f64>>();
}

/// Drag over load of a disc that slides without friction over a held block at 0.005 c, over 3 spacings.
fn effective_friction(shift: f64, packing: &str) -> f64 {
    let scene = parse(&format!(
        "title = 'slide'\ndimension = 2\nspacing = 1.0\nduration = 1.0\nbody_force = [0, -0.0004]
        [[body]]\nname = 'disc'\nshape = {{ disc = {{ center = [0, 11.9], radius = 12 }} }}\npacking = '{packing}'
        anchor = [{shift}, {}]\nvelocity = [0.0058, 0]\nmaterial = 'rubber'
        [[body]]\nname = 'block'\nshape = {{ block = {{ min = [-14, -4], max = [17, 0] }} }}\nanchor = [0.5, -0.5]\nmaterial = 'rubber'
        [[boundary]]\nselect = {{ body = 'block' }}\nfixed = true
        [[contact]]\nbetween = ['disc', 'block']\ngap = {{}}\n{RUBBER}",
        11.9 + 0.7 * shift
    ));
    let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
    let first = in_order(&mut cpu, Field::Velocity);
    let clock = steps(&mut cpu, 3200);
    let last = in_order(&mut cpu, Field::Velocity);
    let disc = |v: &[f64]| {
        let own: Vec<f64> =
            (0..scene.particles.len()).filter(|&i| scene.particles[i].body == 0).map(|i| v[2 * i] * scene.mass(i)).collect();
        own.iter().sum::<f64>()
    };
    let mass: f64 = (0..scene.particles.len()).filter(|&i| scene.particles[i].body == 0).map(|i| scene.mass(i)).sum();
    assert!(clock.elapsed * 0.0058 > 2.0, "{}", clock.elapsed);
    (disc(&first) - disc(&last)) / (mass * 0.0004 * clock.elapsed)
}

#[test]
fn surfaces_slip_over_each_other_on_any_lattice() {
    let mut worst: f64 = 0.0;
    for k in 0..10 {
        let packing = if k < 5 { "fitted" } else { "square" };
        let friction = effective_friction(0.1 * f64::from(k), packing);
        println!("layout {k}, {packing}: {friction:.1e}");
        worst = worst.max(friction.abs());
    }
    assert!(worst < 0.01, "{worst}");
}

#[test]
fn what_surfaces_cannot_do_is_refused_in_one_sentence() {
    let text = |gap: &str, more: &str| overlapping(2, "").text.replace("[contact.gap]", &format!("[contact.gap]\n{gap}")) + more;
    assert!(Scene::parse(&text("friction = 0.2", ""), "test", None, &[]).is_ok());
    let floor = "\n[[obstacle]]\nname = 'floor'\n";
    let still = "\n[quasi_static]\nload_steps = 2\n";
    for (gap, more, sentence) in [
        ("stiffness = 0", String::new(), "stiffness must be a positive number, found 0"),
        ("range = 0.5", String::new(), "range must lie between 1 and 4 spacings, found 0.5"),
        ("friction = -1", String::new(), "friction must be 0 or a positive number, found -1"),
        ("friction = 0.2", still.to_string(), "friction depends on the way that equilibrium is reached"),
        ("", format!("{floor}shape = {{ berkovich = {{ apex = [0, 0], axis = [0, 1] }} }}"), "needs dimension 3"),
        ("", format!("{floor}shape = {{ sphere = {{ center = [0, -20], radius = 0 }} }}"), "radius must be a positive number"),
        ("", format!("{floor}shape = {{ plane = {{ point = [0, -20], normal = [0, 0] }} }}"), "normal must not be zero"),
        (
            "",
            format!("{floor}against = ['c']\nshape = {{ plane = {{ point = [0, -20], normal = [0, 1] }} }}"),
            "no body is named `c`",
        ),
        (
            "",
            format!("{floor}mass = 1\ncourse = [[0, 1]]\nshape = {{ plane = {{ point = [0, -20], normal = [0, 1] }} }}"),
            "moves freely",
        ),
    ] {
        let error = Scene::parse(&text(gap, &more), "test", None, &[]).unwrap_err();
        assert!(error.contains(sentence) && error.starts_with("test:"), "{error}\nwanted {sentence}");
    }
}

/// Energy of a wedge pressed `depth` into a block, at `x` along its lattice: an obstacle, or a body that touches by a gap.
fn pressed(tool: &str, x: f64, depth: f64, facets: &str) -> f64 {
    let by = match tool {
        "obstacle" => format!(
            "[[obstacle]]\nname = 'wedge'\nshape = {{ cone = {{ apex = [{x}, {}], axis = [0, 1], half_angle = 45 }} }}",
            -depth
        ),
        _ => format!(
            "[[body]]\nname = 'wedge'\nmaterial = 'rubber'
            shape = {{ polygon = {{ points = [[{x}, {}], [{}, {}], [{}, {}]] }} }}\n{facets}
            [[contact]]\nbetween = ['block', 'wedge']\ngap = {{}}",
            -depth,
            x + 5.0,
            5.0 - depth,
            x - 5.0,
            5.0 - depth
        ),
    };
    contact_energy::<Plane<f64>>(&parse(&format!(
        "title = 'wedge'\ndimension = 2\nspacing = 1.0\nduration = 1.0
        [[body]]\nname = 'block'\nshape = {{ block = {{ min = [-8, -6], max = [8, 0] }} }}\nmaterial = 'rubber'\n{facets}\n{by}\n{RUBBER}"
    )))
}

/// A facet is met at its middle: one to a spacing lets an edge in by half a spacing before it feels it.
#[test]
fn an_edge_is_felt_at_an_eighth_of_a_spacing_wherever_it_meets_the_lattice() {
    for tool in ["obstacle", "body"] {
        for x in [0.0, 0.13, 0.25, 0.37, 0.5] {
            assert!(pressed(tool, x, 0.13, "") > 0.0, "{tool} at {x}");
        }
    }
    let late = |facets| [0.0, 0.13].into_iter().any(|x| pressed("obstacle", x, 0.13, facets) == 0.0);
    assert!(late("facets = 1") && !late("facets = 4"));
}
