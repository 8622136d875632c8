//! Numbers of an indentation, found from a finished run: series `of` is the load, series `over` the depth.
//!
//! Either may have either sign: both are turned so that they are positive where the load is largest.
//! Source: Oliver & Pharr, J. Mater. Res. 7 (1992) 1564, reviewed in J. Mater. Res. 19 (2004) 3.

use super::power_law::{PowerLaw, fit};
use super::table::Table;
use super::{ObservableKind, Value};
use crate::scene::file::Observe;
use std::f64::consts::PI;

/// Loads, over the largest, between which unloading is fitted unless a scene says.
const SHARES: [f64; 2] = [0.5, 0.95];
/// What the surface sinks outside the contact, over load/stiffness: exact for a paraboloid, for a cone it is 0.73.
const SINK: f64 = 0.75;

/// Depths and loads of a run or of a window of it.
struct Curve {
    rows: Vec<(f64, f64)>,
    /// Row of the largest load.
    peak: usize,
}

fn curve(table: &Table, typed: &Observe) -> Result<Curve, String> {
    let (loads, depths) = (table.of(typed)?, table.over(typed)?);
    let size = |row: usize| loads[row].1.abs();
    // Of equals the last: unloading begins where holding ends.
    let peak = (0..loads.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0);
    let (up, down) = (loads[peak].1.signum(), depths[peak].1.signum());
    let before = typed.distance.unwrap_or(0.0);
    let rows = loads.iter().zip(&depths).map(|(load, depth)| (down * depth.1 - before, up * load.1)).collect();
    Ok(Curve { rows, peak })
}

impl Curve {
    fn largest(&self) -> (f64, f64) {
        self.rows[self.peak]
    }

    /// The power law of the upper part of the unloading that follows the largest load.
    fn unloading(&self, typed: &Observe) -> Result<PowerLaw, String> {
        let [a, b] = typed.shares.unwrap_or(SHARES);
        let (_, largest) = self.largest();
        let (least, most) = (a.min(b) * largest, a.max(b) * largest);
        let branch = self.rows[self.peak..].iter().copied().take_while(|row| row.1 >= least && row.1 > 0.0);
        let rows: Vec<(f64, f64)> = branch.filter(|row| row.1 <= most).collect();
        if rows.len() < 4 {
            let count = rows.len();
            return Err(format!("unloading needs at least four rows of loads between {least:e} and {most:e}, found {count}"));
        }
        fit(&rows).ok_or_else(|| "unloading changes no depth".into())
    }

    fn stiffness(&self, typed: &Observe) -> Result<f64, String> {
        Ok(self.unloading(typed)?.slope(self.largest().0))
    }

    fn contact_depth(&self, typed: &Observe) -> Result<f64, String> {
        let (depth, load) = self.largest();
        Ok(depth - typed.level.unwrap_or(SINK) * load / self.stiffness(typed)?)
    }

    /// Cross-section of the indenter at the contact depth.
    fn area(&self, typed: &Observe) -> Result<f64, String> {
        let depth = self.contact_depth(typed)?;
        let area = match (typed.radius, typed.section) {
            (Some(radius), _) => PI * (2.0 * radius - depth) * depth,
            (None, section) => section.unwrap_or_default() * depth * depth,
        };
        if depth > 0.0 && area > 0.0 { Ok(area) } else { Err(format!("a contact of depth {depth:e} has no area")) }
    }
}

pub const UNLOADING_STIFFNESS: ObservableKind = ObservableKind {
    word: "unloading_stiffness",
    about: "slope at the largest depth of the power law through unloading, `shares` 0.95 to 0.5 of the largest load `of`, over depth `over`",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Result(|table, typed| curve(table, typed)?.stiffness(typed)),
};

pub const CONTACT_DEPTH: ObservableKind = ObservableKind {
    word: "contact_depth",
    about: "largest depth `over` (less `distance`) less `level`, 0.75, of largest load `of` over unloading stiffness",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Result(|table, typed| curve(table, typed)?.contact_depth(typed)),
};

pub const HARDNESS: ObservableKind = ObservableKind {
    word: "hardness",
    about: "largest load `of` over the cross-section, by `radius` or `section`, of the indenter at the contact depth",
    needs: &["of", "over", "radius|section"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let curve = curve(table, typed)?;
        Ok(curve.largest().1 / curve.area(typed)?)
    }),
};

pub const REDUCED_MODULUS: ObservableKind = ObservableKind {
    word: "reduced_modulus",
    about: "sqrt(pi)/(2 `beta`) unloading stiffness over the root of the cross-section, by `radius` or `section`",
    needs: &["of", "over", "radius|section"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let curve = curve(table, typed)?;
        let root = curve.area(typed)?.sqrt();
        Ok(PI.sqrt() / (2.0 * typed.beta.unwrap_or(1.0)) * curve.stiffness(typed)? / root)
    }),
};

pub const WORK: ObservableKind = ObservableKind {
    word: "work",
    about: "integral of load `of` over depth `over`, within the times `between`: of loading above 0, of unloading below",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let Curve { rows, .. } = curve(table, typed)?;
        Ok(rows.windows(2).map(|pair| (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1) / 2.0).sum())
    }),
};

/// Where a series first reaches a level, from whichever side it begins on, the other one's value there.
fn value_at(table: &Table, typed: &Observe) -> Result<f64, String> {
    let level = typed.level.unwrap_or_default();
    let rows: Vec<(f64, f64)> = table.over(typed)?.iter().zip(table.of(typed)?).map(|(x, y)| (x.1 - level, y.1)).collect();
    if rows[0].0 == 0.0 {
        return Ok(rows[0].1);
    }
    let reaches = |pair: &&[(f64, f64)]| pair[0].0.signum() != pair[1].0.signum() || pair[1].0 == 0.0;
    let pair = rows.windows(2).find(reaches);
    let [(before, from), (after, to)] = pair.and_then(|pair| <[_; 2]>::try_from(pair).ok()).ok_or_else(|| {
        let over = typed.over.as_deref().unwrap_or_default();
        format!("the series `{over}` never reaches {level:e}")
    })?;
    Ok(from + (to - from) * before / (before - after))
}

pub const VALUE_AT: ObservableKind = ObservableKind {
    word: "value_at",
    about: "series `of` where series `over` first reaches `level`, linear between rows",
    needs: &["of", "over", "level"],
    fields: &[],
    value: Value::Result(value_at),
};

#[cfg(test)]
mod tests;
