//! Scenes that together switch on everything: two blocks, or one in a periodic box, of at least 1000 particles.

use crate::common::parse;
use lithosph::material::{Law, Number, Role};
use lithosph::rows::BodyOptions;
use lithosph::scene::Scene;

#[derive(Clone, Copy)]
pub struct Case {
    pub name: &'static str,
    pub dimension: usize,
    /// Spacing, Young's modulus and density of the first body.
    pub units: [f64; 3],
    pub bodies: usize,
    /// Symmetry planes along the axes, so many; or one that is oblique.
    pub planes: usize,
    pub oblique: bool,
    /// The planes along the axes go through particles, not between them.
    pub through: bool,
    pub periodic: bool,
    pub boundary: bool,
    pub fluid: bool,
    /// Laws of the two materials, or none for the default.
    pub laws: [&'static str; 2],
    /// Numbers of the second body's formulation, where they are not the scene's. The text of a scene cannot name them.
    pub second: Option<BodyOptions<f64>>,
    pub compensated: bool,
    /// Between the two blocks, in spacings.
    pub gap: f64,
    /// The bodies are bonded where they meet, of one lattice.
    pub tied: bool,
    /// The second body has a formulation of its own: the case is what acts between the two.
    pub apart: bool,
    /// Lines of the scene: those of no table, of the formulation, and of the time.
    pub top: &'static str,
    pub formulation: &'static str,
    pub time: &'static str,
}

const PLAIN: [f64; 3] = [1.0, 1.0, 1.0];
/// Steel in millimetres and seconds, as SI.
const STEEL: [f64; 3] = [1e-3, 2e11, 7800.0];

const BARE: Case = Case {
    name: "bare",
    dimension: 2,
    units: PLAIN,
    bodies: 1,
    planes: 0,
    oblique: false,
    through: false,
    periodic: false,
    boundary: false,
    fluid: false,
    laws: [""; 2],
    second: None,
    compensated: false,
    gap: GAP,
    tied: false,
    apart: false,
    top: "",
    formulation: "",
    time: "",
};

/// Far from the numbers of every case that has them.
const OTHER: BodyOptions<f64> = BodyOptions { alpha: 1.1, beta: 3.0, artificial_epsilon: 0.9, hourglass: 0.25 };

/// A wall that moves, and a ball that flies; with friction.
const OBSTACLES: &str =
    "contact = [{ between = [\"first\", \"second\"], gap = { stiffness = 2, range = 2, friction = 0.3 } }]
    obstacle = [
        { name = \"wall\", shape = { plane = { point = [0.3, 0, 0], normal = [1, 0, 0] } }, velocity = [0.01, 0.02, 0.01], course = [[0, 1], [700, 3]], friction = 0.2 },
        { name = \"ball\", shape = { sphere = { center = [8, -9.7, 4], radius = 10 } }, velocity = [0, 0.01, 0], mass = 7, friction = 0.4 },
    ]";
const SOLID_OBSTACLES: &str =
    "contact = [{ between = [\"first\", \"second\"], gap = { stiffness = 2, range = 2, friction = 0.3 } }]
    obstacle = [
        { name = \"wall\", shape = { plane = { point = [0.3, 0, 0], normal = [1, 0, 0] } }, velocity = [0.01, 0.02, 0.01], course = [[0, 1], [700, 3]], friction = 0.2 },
        { name = \"ball\", shape = { sphere = { center = [8, -9.7, 4], radius = 10 } }, velocity = [0, 0.01, 0], mass = 7, friction = 0.4 },
        { name = \"bar\", shape = { cylinder = { center = [6, 13.6, 4], axis = [1, 0, 1], radius = 4 } }, velocity = [0, 0, 0.01], friction = 0.4 },
        { name = \"cone\", shape = { cone = { apex = [4.1, 4.2, 8.5], axis = [0, 0, 1], half_angle = 70.3 } }, against = [\"first\"] },
        { name = \"tip\", shape = { berkovich = { apex = [6.1, 5.2, 0.5], axis = [0, 0, -1] } }, against = [\"first\"] },
    ]";

const FIRE: &str =
    "cfl = 0.8\n[quasi_static]\nload_steps = 4\n[output]\nfields = []\npicture = { field = \"displacement.magnitude\" }";
const KINETIC_DAMPING: &str = "cfl = 0.8\n[quasi_static]\nload_steps = 4\nmethod = \"kinetic_damping\"\n[output]\nfields = []\n\
    picture = { field = \"displacement.magnitude\" }";

/// The cases of one dimension.
pub fn cases(dimension: usize) -> Vec<Case> {
    let list = [
        Case {
            name: "leapfrog, contact, planes, xsph, principal",
            bodies: 2,
            planes: dimension,
            boundary: true,
            compensated: true,
            formulation: "viscosity = { alpha = 1.0, softening = 0.01 }\nxsph = 0.5\ninternal_energy = true
                dissipated_energy = true\nartificial_stress = { epsilon = 0.3, exponent = 6 }",
            ..BARE
        },
        Case {
            name: "rk2, periodic, adjoint, filter, scalar",
            units: STEEL,
            periodic: true,
            boundary: true,
            compensated: true,
            formulation:
                "smoothing = \"wendland\"\ngradient = \"adjoint\"\nvelocity_filter = 0.4\nviscosity = { alpha = 0.7, beta = 0.3 }
                dissipated_energy = true\nartificial_stress = { form = \"scalar\", epsilon = 0.2 }",
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "rk3, fluid, summation, corrected",
            fluid: true,
            formulation: "smoothing = \"quadratic\"\ndensity = \"summation\"\ngradient = \"corrected\"",
            time: "integrator = \"ssp_rk3\"",
            ..BARE
        },
        Case {
            name: "rk4, oblique plane, adjoint, xsph, principal",
            bodies: 2,
            oblique: dimension > 1,
            planes: usize::from(dimension == 1),
            boundary: true,
            compensated: true,
            formulation:
                "smoothing = \"gaussian\"\ngradient = \"adjoint\"\nxsph = 0.3\ninternal_energy = true\ndissipated_energy = true
                viscosity = { alpha = 1.0 }\nartificial_stress = { epsilon = 0.3, exponent = 4 }",
            time: "integrator = \"rk4\"",
            ..BARE
        },
        Case {
            name: "leapfrog, fixed step, planes, filter, scalar, summation",
            units: STEEL,
            bodies: 2,
            planes: 1,
            through: true,
            formulation: "density = \"summation\"\nvelocity_filter = 0.5\ninternal_energy = true
                artificial_stress = { form = \"scalar\", epsilon = 0.3 }",
            time: "step = 7e-8",
            ..BARE
        },
        Case {
            name: "leapfrog, periodic, two bodies, plain, compensated",
            bodies: 2,
            periodic: true,
            compensated: true,
            formulation: "smoothing = \"wendland\"\ngradient = \"adjoint\"\nviscosity = { alpha = 0.1 }",
            ..BARE
        },
        Case {
            name: "leapfrog, j2 and elastic, heat, plain",
            units: STEEL,
            bodies: 2,
            laws: ["j2, perfect", "elastic"],
            formulation: "dissipated_energy = true",
            ..BARE
        },
        Case {
            name: "leapfrog, j2 by a power, summation, adjoint",
            bodies: 2,
            planes: 1,
            laws: ["j2, power", "j2, linear"],
            formulation: "density = \"summation\"\ngradient = \"adjoint\"\nviscosity = { alpha = 0.5 }\ndissipated_energy = true",
            ..BARE
        },
        Case {
            name: "leapfrog, bodies that differ, planes, principal",
            bodies: 2,
            planes: dimension,
            formulation: "viscosity = { alpha = 0.4, softening = 0.01 }\ninternal_energy = true
                dissipated_energy = true\nartificial_stress = { epsilon = 0.3, exponent = 6 }",
            second: Some(OTHER),
            ..BARE
        },
        Case {
            name: "rk2, bodies that differ, adjoint, scalar",
            units: STEEL,
            bodies: 2,
            formulation: "smoothing = \"wendland\"\ngradient = \"adjoint\"\nviscosity = { alpha = 2.0, beta = 0.5 }
                artificial_stress = { form = \"scalar\", epsilon = 0.2 }",
            second: Some(OTHER),
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "lagrangian, bodies that differ, j2 and neo-hookean, heat",
            bodies: 2,
            planes: 1,
            laws: ["j2, linear", "neo_hookean"],
            formulation: "kind = \"total_lagrangian\"\nviscosity = { alpha = 0.4 }\ndissipated_energy = true",
            second: Some(OTHER),
            ..BARE
        },
        Case {
            name: "lagrangian, rk2, bodies that differ, quadratic gradient",
            units: STEEL,
            bodies: 2,
            laws: ["neo_hookean", "st_venant_kirchhoff"],
            formulation: "kind = \"total_lagrangian\"\ngradient = \"quadratic\"\nviscosity = { alpha = 2.0, beta = 0.5 }",
            second: Some(OTHER),
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "lagrangian, j2 with linear hardening and neo-hookean, heat",
            units: STEEL,
            bodies: 2,
            planes: 1,
            laws: ["j2, linear", "neo_hookean"],
            formulation: "kind = \"total_lagrangian\"\ndissipated_energy = true",
            ..BARE
        },
        Case {
            name: "lagrangian, j2 by a power and maxwell, quadratic gradient",
            bodies: 2,
            compensated: true,
            laws: ["j2, power", "maxwell"],
            formulation: "kind = \"total_lagrangian\"\ngradient = \"quadratic\"",
            ..BARE
        },
        Case {
            name: "lagrangian, tied bodies that differ, j2 and neo-hookean, viscosity, heat, planes",
            bodies: 2,
            planes: dimension,
            tied: true,
            laws: ["j2, linear", "neo_hookean"],
            formulation: "kind = \"total_lagrangian\"\nviscosity = { alpha = 0.4 }\ndissipated_energy = true",
            second: Some(OTHER),
            ..BARE
        },
        Case {
            name: "lagrangian, rk2, tied bodies, viscosity, quadratic gradient",
            units: STEEL,
            bodies: 2,
            tied: true,
            laws: ["neo_hookean", "st_venant_kirchhoff"],
            formulation: "kind = \"total_lagrangian\"\ngradient = \"quadratic\"\nviscosity = { alpha = 2.0, beta = 0.5 }",
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "fire, tied bodies, j2, periodic",
            bodies: 2,
            periodic: true,
            tied: true,
            laws: ["j2, perfect", "st_venant_kirchhoff"],
            formulation: "kind = \"total_lagrangian\"",
            time: FIRE,
            ..BARE
        },
        Case {
            name: "lagrangian, tied bodies, zones of the first on itself",
            bodies: 2,
            tied: true,
            laws: ["neo_hookean", "neo_hookean"],
            top: "contact = [{ between = [\"first\", \"second\"], tie = true },
                { between = [\"first\", \"first\"], zones = { radius = 2, stiffness = 1e-3, normals = \"initial\" } }]",
            formulation: "kind = \"total_lagrangian\"",
            ..BARE
        },
        Case {
            name: "fire, j2, planes",
            bodies: 2,
            planes: 1,
            laws: ["j2, perfect", "j2, linear"],
            formulation: "kind = \"total_lagrangian\"",
            time: FIRE,
            ..BARE
        },
        Case {
            name: "lagrangian, pefrl, two laws, planes",
            bodies: 2,
            planes: dimension,
            boundary: true,
            laws: ["st_venant_kirchhoff", "neo_hookean"],
            formulation: "kind = \"total_lagrangian\"",
            time: "integrator = \"pefrl\"",
            ..BARE
        },
        Case {
            name: "lagrangian, leapfrog, maxwell, heat, periodic",
            units: STEEL,
            periodic: true,
            boundary: true,
            compensated: true,
            laws: ["maxwell", "maxwell"],
            formulation: "kind = \"total_lagrangian\"\nsmoothing = \"wendland\"\ndissipated_energy = true",
            ..BARE
        },
        Case {
            name: "lagrangian, leapfrog, maxwell and neo-hookean, heat, oblique plane, no hourglass energy",
            bodies: 2,
            oblique: dimension > 1,
            planes: usize::from(dimension == 1),
            laws: ["maxwell", "neo_hookean"],
            formulation: "kind = \"total_lagrangian\"\nhourglass = 0\ndissipated_energy = true",
            ..BARE
        },
        Case {
            name: "lagrangian, leapfrog, contact by the barrier and by a power, quadratic gradient",
            bodies: 2,
            compensated: true,
            laws: ["neo_hookean", "st_venant_kirchhoff"],
            top:
                "contact = [{ between = [\"first\", \"second\"], potential = { law = \"barrier\", stiffness = 0.5, range = 2 } },
                { between = [\"first\", \"first\"], potential = { law = \"power\", stiffness = 0.5, range = 3.6 } }]",
            formulation: "kind = \"total_lagrangian\"\ngradient = \"quadratic\"",
            ..BARE
        },
        Case {
            name: "lagrangian, rk2, contact by the soft potential, Strand's and the colour field",
            bodies: 2,
            laws: ["neo_hookean", "neo_hookean"],
            top:
                "contact = [{ between = [\"first\", \"second\"], colour_field = { stiffness = 0.5, threshold = 0.2, range = 5 } },
                { between = [\"first\", \"first\"], potential = { law = \"quadratic\", stiffness = 0.5, range = 3.6 } },
                { between = [\"second\", \"second\"], potential = { law = \"repulsive\", stiffness = 0.1, range = 4.5 } }]",
            formulation: "kind = \"total_lagrangian\"\nviscosity = { alpha = 1.0, softening = 0.01 }\ndissipated_energy = true",
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "lagrangian, surfaces and obstacles with friction and heat",
            bodies: 2,
            boundary: true,
            gap: -0.2,
            laws: ["neo_hookean", "st_venant_kirchhoff"],
            top: if dimension == 3 { SOLID_OBSTACLES } else { OBSTACLES },
            formulation: "kind = \"total_lagrangian\"\ndissipated_energy = true",
            ..BARE
        },
        Case {
            name: "lagrangian, surfaces along their normals, and a potential",
            bodies: 2,
            gap: -0.2,
            laws: ["neo_hookean", "st_venant_kirchhoff"],
            top: "contact = [{ between = [\"first\", \"second\"], gap = { form = \"along_normals\" } },
                { between = [\"first\", \"first\"], potential = { law = \"barrier\", stiffness = 0.5, range = 1 } }]",
            formulation: "kind = \"total_lagrangian\"\ngradient = \"plain\"",
            ..BARE
        },
        Case {
            name: "fire, obstacles",
            units: PLAIN,
            laws: ["st_venant_kirchhoff"; 2],
            top: "obstacle = [{ name = \"wall\", shape = { plane = { point = [0.3, 0, 0], normal = [1, 0, 0] } }, velocity = [0.0005, 0, 0] }]",
            formulation: "kind = \"total_lagrangian\"",
            time: FIRE,
            ..BARE
        },
        Case {
            name: "leapfrog, contact by Strand's force, compensated",
            bodies: 2,
            compensated: true,
            top: "contact = [{ between = [\"first\", \"second\"], kernel = 0,
                potential = { law = \"repulsive\", stiffness = 0.1, range = 4, exponent = 3 } }]",
            formulation: "gradient = \"adjoint\"\nviscosity = { alpha = 0.1 }",
            ..BARE
        },
        Case {
            name: "leapfrog, zones with the normals of the start",
            bodies: 2,
            top: "contact = [{ between = [\"first\", \"second\"], kernel = 0, zones = { radius = 2, stiffness = 1e-3, normals = \"initial\" } }]",
            ..BARE
        },
        Case {
            name: "lagrangian, leapfrog, zones as printed, of all neighbours, with friction",
            bodies: 2,
            laws: ["neo_hookean", "neo_hookean"],
            top: "contact = [{ between = [\"first\", \"second\"],
                zones = { radius = 2, stiffness = 1e-3, form = \"printed\", normals = \"all\", friction = 0.3 } }]",
            formulation: "kind = \"total_lagrangian\"",
            ..BARE
        },
        Case {
            name: "between groups, a potential",
            bodies: 2,
            apart: true,
            compensated: true,
            top: "contact = [{ between = [\"first\", \"second\"], potential = { law = \"quadratic\", stiffness = 0.5, range = 2 } }]",
            ..BARE
        },
        Case {
            name: "between groups, a colour field in a periodic box",
            bodies: 2,
            apart: true,
            periodic: true,
            top: "contact = [{ between = [\"first\", \"second\"], colour_field = { stiffness = 0.5, threshold = 0.2, range = 5 } }]",
            time: "integrator = \"ssp_rk3\"",
            ..BARE
        },
        Case {
            name: "between groups that do not touch",
            bodies: 2,
            apart: true,
            top: "contact = [{ between = [\"first\", \"second\"], kernel = 0 }]",
            ..BARE
        },
        Case {
            name: "rk2, contact by a power",
            bodies: 2,
            top: "contact = [{ between = [\"first\", \"second\"], kernel = 0,
                potential = { law = \"power\", stiffness = 0.5, range = 2 } }]",
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "lagrangian, rk4, plain gradient",
            laws: ["neo_hookean", "neo_hookean"],
            formulation: "kind = \"total_lagrangian\"\ngradient = \"plain\"",
            time: "integrator = \"rk4\"",
            ..BARE
        },
        Case {
            name: "fire, planes, compensated",
            planes: dimension,
            boundary: true,
            compensated: true,
            laws: ["st_venant_kirchhoff"; 2],
            formulation: "kind = \"total_lagrangian\"",
            time: FIRE,
            ..BARE
        },
        Case {
            name: "kinetic damping, wendland",
            units: STEEL,
            laws: ["st_venant_kirchhoff"; 2],
            formulation: "kind = \"total_lagrangian\"\nsmoothing = \"wendland\"",
            time: KINETIC_DAMPING,
            ..BARE
        },
        Case {
            name: "corrected kernel, rk3, planes",
            planes: dimension,
            boundary: true,
            compensated: true,
            laws: ["neo_hookean", "neo_hookean"],
            formulation: "kind = \"corrected_kernel\"",
            time: "integrator = \"ssp_rk3\"",
            ..BARE
        },
        Case {
            name: "corrected kernel, leapfrog, maxwell, periodic, two bodies, as printed",
            units: STEEL,
            bodies: 2,
            periodic: true,
            laws: ["maxwell", "neo_hookean"],
            formulation: "kind = \"corrected_kernel\"\nsmoothing = \"wendland\"\nvelocity_gradient = \"printed\"",
            ..BARE
        },
        Case {
            name: "corrected kernel, displacements and current sums, oblique plane",
            units: STEEL,
            oblique: dimension > 1,
            planes: usize::from(dimension == 1),
            laws: ["neo_hookean", "neo_hookean"],
            formulation: "kind = \"corrected_kernel\"\ndeformation = \"reference\"",
            ..BARE
        },
        Case {
            name: "corrected kernel, reference configuration, rk2, planes",
            planes: dimension,
            laws: ["st_venant_kirchhoff", "st_venant_kirchhoff"],
            formulation: "kind = \"corrected_kernel\"\nconfiguration = \"reference\"",
            time: "integrator = \"rk2\"",
            ..BARE
        },
        Case {
            name: "bare kernel, leapfrog",
            laws: ["neo_hookean", "neo_hookean"],
            formulation: "kind = \"corrected_kernel\"\ncorrection = false",
            ..BARE
        },
    ];
    let metals = Law::of_role(Role::Strength).filter(|law| law.yields()).flat_map(metals);
    list.into_iter().chain(metals).map(|case| Case { dimension, ..case }).collect()
}

/// A strength that yields with the numbers that it declares for tests and its own heat, in both formulations.
fn metals(strength: Law) -> [Case; 2] {
    let name = |formulation: &str| -> &'static str { format!("{formulation}, {}, adiabatic", strength.word()).leak() };
    let eulerian = Case {
        name: name("leapfrog"),
        units: STEEL,
        bodies: 2,
        laws: [strength.word(), "elastic"],
        formulation: "dissipated_energy = true",
        ..BARE
    };
    let lagrangian = Case {
        name: name("lagrangian"),
        bodies: 2,
        laws: [strength.word(), "neo_hookean"],
        formulation: "kind = \"total_lagrangian\"\ndissipated_energy = true",
        ..BARE
    };
    [eulerian, lagrangian]
}

/// Sides of the first block, of the second, and the gap between, in spacings of the first.
const SIDES: [[[f64; 3]; 2]; 3] =
    [[[1002.0, 0.0, 0.0], [320.0, 0.0, 0.0]], [[60.0, 24.0, 0.0], [16.0, 16.0, 0.0]], [[12.0, 10.0, 9.0], [4.0, 8.0, 6.4]]];
const GAP: f64 = 0.5;
/// Side of a cell, and where the first edge lies on each axis, in spacings: a tenth or more from any particle.
pub const CELL: f64 = 3.0;
pub const EDGE: [f64; 3] = [0.0, 0.1, 0.1];
/// Spacing of the second body over that of the first.
const FINER: f64 = 0.8;

impl Case {
    /// Time in which sound crosses a spacing of the first body, about.
    pub fn moment(&self) -> f64 {
        self.units[0] * (self.units[2] / self.units[1]).sqrt()
    }

    fn point(&self, x: [f64; 3]) -> String {
        let numbers: Vec<String> = x[..self.dimension].iter().map(|x| format!("{:e}", x * self.units[0])).collect();
        format!("[{}]", numbers.join(", "))
    }

    fn block(&self, name: &str, from: f64, sides: [f64; 3], spacing: f64) -> String {
        let end = [from + sides[0], sides[1], sides[2]];
        let (min, max) = (self.point([from, 0.0, 0.0]), self.point(end));
        let anchor = self.point([from + 0.5 * spacing, 0.5 * spacing, 0.5 * spacing]);
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ block = {{ min = {min}, max = {max} }} }}\nspacing = {:e}\n\
             anchor = {anchor}\nmaterial = \"{name}\"\n",
            spacing * self.units[0]
        )
    }

    fn law(&self, name: &str) -> String {
        match self.laws[usize::from(name == "second")] {
            "" => String::new(),
            // Relaxes by about a tenth in a step.
            "maxwell" => format!("law = \"maxwell\"\nviscosity = {:e}\n", self.units[1] * self.moment()),
            // The random strains are of a tenth: some particles yield.
            "j2, perfect" => format!("law = \"j2\"\nyield_stress = {:e}\n", 0.05 * self.units[1]),
            "j2, linear" => {
                let [_, modulus, _] = self.units;
                format!("law = \"j2\"\nyield_stress = {:e}\nhardening = {{ linear = {:e} }}\n", 0.05 * modulus, 0.1 * modulus)
            }
            "j2, power" => {
                let [_, modulus, _] = self.units;
                let hardening = format!("{{ power = {{ coefficient = {:e}, exponent = 0.3 }} }}", 0.05 * modulus);
                format!("law = \"j2\"\nyield_stress = {:e}\nhardening = {hardening}\n", 0.02 * modulus)
            }
            word => match Law::named(Role::Strength, word).filter(|law| law.yields()) {
                Some(strength) => {
                    let (own, heat) = (self.sampled(strength), self.sampled(Law::Adiabatic));
                    format!("strength = {{ {word} = {own} }}\nheat = {{ adiabatic = {heat} }}\n")
                }
                None => format!("law = \"{word}\"\n"),
            },
        }
    }

    /// A law's numbers as it declares them for tests, in the units of the case.
    fn sampled(&self, law: Law) -> String {
        let [length, _, density] = self.units;
        let scale = [length, density * length.powi(3), self.moment(), 1.0];
        let of = |number: &Number| {
            let unit = scale.iter().zip(number.dimensions).map(|(unit, power)| unit.powi(power.into())).product::<f64>();
            format!("{:e}", number.sample * unit)
        };
        let declared = law.declaration().numbers;
        let exponent = declared.iter().find(|number| number.key == "hardening_exponent").map(of);
        let typed = declared.iter().filter(|number| number.key != "hardening_exponent").map(|number| match &exponent {
            Some(power) if number.key == "hardening" => {
                format!("hardening = {{ power = {{ coefficient = {}, exponent = {power} }} }}", of(number))
            }
            _ => format!("{} = {}", number.key, of(number)),
        });
        format!("{{ {} }}", typed.collect::<Vec<_>>().join(", "))
    }

    fn material(&self, name: &str, stiffer: f64) -> String {
        let [_, modulus, density] = self.units;
        let density = density * (1.0 + 0.3 * (stiffer - 1.0));
        match self.fluid {
            true => {
                format!("[material.{name}]\nlaw = \"fluid\"\ndensity = {density:e}\nbulk_modulus = {:e}\n", modulus * stiffer)
            }
            false => format!(
                "[material.{name}]\n{}density = {density:e}\nyoungs_modulus = {:e}\npoisson_ratio = 0.3\n",
                self.law(name),
                modulus * stiffer
            ),
        }
    }

    /// One condition that prescribes along the first axis, one that pushes, one that does both.
    fn boundaries(&self) -> String {
        let [length, modulus, density] = self.units;
        let speed = (modulus / density).sqrt();
        let force = modulus * length.powi(self.dimension as i32 - 1);
        // The clock stands between the last two points, before the first, and after the last.
        let course = |points: [[f64; 2]; 3]| points.map(|[t, f]| format!("[{:e}, {f}]", t * self.moment())).join(", ");
        let between = course([[-100.0, 0.3], [0.05, 1.7], [200.0, 0.6]]);
        let before = course([[1000.0, 0.4], [1100.0, 1.0], [1200.0, 3.0]]);
        let after = course([[-3.0, 0.9], [-2.0, 1.0], [-1.0, 0.45]]);
        let slab = |from: f64, to: f64| {
            format!(
                "[[boundary]]\nselect = {{ inside = {{ block = {{ min = {}, max = {} }} }} }}\n",
                self.point([from, -1.0, -1.0]),
                self.point([to, 99.0, 99.0])
            )
        };
        let list = |numbers: [f64; 3]| numbers[..self.dimension].iter().map(|x| format!("{x:e}")).collect::<Vec<_>>().join(", ");
        let mut held = vec![format!("{:e}", 0.01 * speed)];
        held.resize(self.dimension, "\"free\"".into());
        let pushed = [0.5 * force, -0.7 * force, 0.3 * force];
        format!(
            "{}velocity = [{held}]\ncourse = [{between}]\n{}force = [{pushed}]\ncourse = [{before}]\n\
             {}velocity = [{held}]\nforce = [{across}]\n{}force = [{pushed}]\ncourse = [{between}]\n\
             {}velocity = [{held}]\ncourse = [{after}]\n",
            slab(0.0, 1.0),
            slab(2.0, 3.0),
            slab(4.0, 5.0),
            slab(6.0, 7.0),
            slab(8.0, 9.0),
            held = held.join(", "),
            pushed = list(pushed),
            across = list([0.0, pushed[1], pushed[2]]),
        )
    }

    fn symmetries(&self) -> String {
        let planes = (0..self.planes).map(|axis| {
            let mut normal = [0.0; 3];
            normal[axis] = 1.0;
            let point = self.point([if self.through { 0.5 } else { 0.0 }; 3]);
            format!("[[symmetry]]\npoint = {point}\nnormal = {:?}\n", &normal[..self.dimension])
        });
        let oblique = self.oblique.then(|| {
            format!("[[symmetry]]\npoint = {}\nnormal = {:?}\n", self.point([0.0, -0.3, 0.0]), &[0.6, 0.8, 0.0][..self.dimension])
        });
        planes.chain(oblique).collect()
    }

    pub fn text(&self) -> String {
        let [length, ..] = self.units;
        let [first, second] = SIDES[self.dimension - 1];
        let mut text = format!(
            "title = \"{}\"\ndimension = {}\nspacing = {length:e}\nduration = 1.0\n{}\n",
            self.name, self.dimension, self.top
        );
        if self.boundary {
            let pull = 0.01 * self.units[1] / self.units[2] / length;
            let numbers: Vec<String> =
                [pull, -2.0 * pull, 0.5 * pull][..self.dimension].iter().map(|x| format!("{x:e}")).collect();
            text += &format!("body_force = [{}]\n", numbers.join(", "));
        }
        if self.periodic {
            let length = first[0] + if self.bodies == 2 { second[0] + 2.0 * GAP } else { 0.0 };
            let along = (length / CELL).ceil() * CELL;
            // The middle axis stays open.
            let across = if self.bodies == 1 { first[2] } else { 0.0 };
            let period = [along, 0.0, across];
            text += &format!("periodic = {}\n", self.point(period));
        }
        text += &self.block("first", 0.0, first, 1.0);
        if self.bodies == 2 {
            let (gap, spacing) = if self.tied { (0.0, 1.0) } else { (self.gap, FINER) };
            text += &self.block("second", first[0] + gap, second, spacing);
            if self.apart {
                text += "formulation = \"other\"\n";
            }
        }
        text += &self.material("first", 1.0);
        text += &self.material("second", 2.2);
        // Through the reference configuration, bodies that are not tied have nothing to do with each other.
        if self.bodies == 2 && self.laws[0].is_empty() && !self.top.contains("contact") {
            text += "[[contact]]\nbetween = [\"first\", \"second\"]\nkernel = 0.6\n";
        }
        if self.tied && !self.top.contains("contact") {
            text += "[[contact]]\nbetween = [\"first\", \"second\"]\ntie = true\n";
        }
        if self.boundary {
            text += &self.boundaries();
        }
        text += &self.symmetries();
        if self.apart {
            text += "[formulation.other]\ngradient = \"adjoint\"\n";
        }
        let kind = if self.formulation.contains("kind") { "" } else { "kind = \"eulerian\"\n" };
        text + &format!("[formulation]\n{kind}{}\n[time]\n{}\n", self.formulation, self.time)
    }

    pub fn scene(&self) -> Scene {
        let mut scene = parse(&self.text());
        if let Some(options) = self.second {
            scene.bodies[1].options = options;
            scene.method.body_options = true;
        }
        scene
    }
}
