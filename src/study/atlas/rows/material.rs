//! Laws that give way.

use super::measures::NEAREST;
use crate::study::atlas::side::{set, text};
use crate::study::atlas::{Bound, Row, Side, Text, Trace};

const BAR: Text = text!("src/study/atlas/rows/pressed_bar.toml");

pub static COLLAPSE: Row = Row {
    name: "st_venant_kirchhoff_in_compression",
    failure: "A stress that is linear in Green's strain falls again once a bar is pressed below 1/sqrt(3) = 0.577 of its \
              length: a section collapses to nothing. The neo-Hookean law stiffens without limit, and the bar is pressed \
              to half.",
    source: "P = E_c F (F^2 - 1)/2 has its extreme at F = 1/sqrt(3)",
    plain: Side::new("St. Venant-Kirchhoff", BAR).changes(|| set(&["output.frames=20"])),
    remedy: Side::new("neo-Hookean", BAR).variant("neo_hookean"),
    measure: NEAREST,
    fails: Bound::Below(0.2),
    survives: Bound::Above(0.45),
    trace: Some(Trace { series: "push", about: "force on a plate", log: false }),
    small: &[],
};
