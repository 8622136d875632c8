//! A bar and a patch with homogeneous strain, and a bar that hangs.

pub const STRAIN: f64 = 0.1;
const LENGTH: usize = 20;
const WIDTH: usize = 6;
/// Columns at each end that follow the homogeneous strain: as far as forces reach.
const HELD: usize = 6;

/// Stretched along x by [`STRAIN`] in 4 load steps; free across.
pub fn patch(dimension: usize) -> String {
    let point = |x: usize, y: i64| if dimension == 1 { format!("[{x}]") } else { format!("[{x}, {y}]") };
    let mut text = format!(
        "title = 'patch'\nsource = 'x'\ndimension = {dimension}\nunits = 'dimensionless'\nspacing = 1.0\nduration = 1.0\n\
         [[body]]\nname = 'patch'\nshape = {{ block = {{ min = {}, max = {} }} }}\nanchor = {}\nmaterial = 'rubber'\n",
        point(0, 0),
        point(LENGTH, WIDTH as i64),
        if dimension == 1 { "[0.5]" } else { "[0.5, 0.5]" },
    );
    for column in (0..HELD).chain(LENGTH - HELD..LENGTH) {
        let velocity = STRAIN * (column as f64 + 0.5 - 0.5 * LENGTH as f64);
        text += &format!(
            "[[boundary]]\nselect = {{ inside = {{ block = {{ min = {}, max = {} }} }} }}\nvelocity = [{velocity:e}{}]\n",
            point(column, -1),
            point(column + 1, WIDTH as i64 + 1),
            if dimension == 1 { "" } else { ", 'free'" },
        );
    }
    let grip = format!("{{ block = {{ min = {}, max = {} }} }}", point(LENGTH - HELD, -1), point(LENGTH, WIDTH as i64 + 1));
    text + &format!(
        "[material.rubber]\nlaw = 'st_venant_kirchhoff'\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n\
         [formulation]\nkind = 'total_lagrangian'\n[quasi_static]\nload_steps = 4\n\
         [output]\nfields = []\npicture = {{ field = 'displacement.magnitude', width = 160, height = 120 }}\n\
         [observe]\nforce = {{ kind = 'force', axis = 'x', inside = {grip} }}\n"
    )
}

/// (1 + e) E_x (e + e^2/2) times the width, E_x = lambda + 2 mu on the line, E/(1 - nu^2) with free sides in the plane.
pub fn exact_force(dimension: usize, strain: f64) -> f64 {
    let (stiffness, width) =
        if dimension == 1 { ((1.0 - 0.3) / ((1.0 + 0.3) * (1.0 - 0.6)), 1.0) } else { (1.0 / (1.0 - 0.09), WIDTH as f64) };
    (1.0 + strain) * stiffness * (strain + 0.5 * strain * strain) * width
}

/// A bar along x under its weight, held by its first three particles, pulled by its last two.
pub const HANGING: &str = "
title = 'hanging bar'
source = 'x'
dimension = 1
units = 'dimensionless'
spacing = 1.0
duration = 1.0
body_force = [1e-4]
[[body]]
name = 'bar'
shape = { block = { min = [0], max = [20] } }
anchor = [0.5]
material = 'rubber'
[[boundary]]
name = 'grip'
select = { inside = { block = { min = [0], max = [3] } } }
fixed = true
[[boundary]]
name = 'end'
select = { inside = { block = { min = [18], max = [20] } } }
force = [3e-3]
[material.rubber]
law = 'st_venant_kirchhoff'
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[formulation]
kind = 'total_lagrangian'
[quasi_static]
load_steps = 4
[output]
frames = 0
fields = []
picture = { field = 'displacement.magnitude' }
[observe]
force = { kind = 'force', axis = 'x', inside = { block = { min = [0], max = [3] } } }
end = { kind = 'mean_position', axis = 'x', inside = { block = { min = [18], max = [20] } } }
";
