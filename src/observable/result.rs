//! Numbers found from finished series.

use super::table::Table;
use super::{ObservableKind, Value};
use crate::scene::file::Observe;

fn restitution(table: &Table, typed: &Observe) -> Result<f64, String> {
    fn relative(table: &Table, typed: &Observe, of: fn(&[(f64, f64)]) -> f64) -> Result<f64, String> {
        let own = of(&table.of(typed)?);
        match &typed.over {
            None => Ok(own),
            Some(other) => Ok(own - of(&table.window(other, typed)?)),
        }
    }
    let before = relative(table, typed, |rows| rows[0].1)?;
    // Bodies ring after they part, so the mean of the last tenth stands for the speed of leaving.
    let tail = |rows: &[(f64, f64)]| {
        let count = rows.len().div_ceil(10);
        rows[rows.len() - count..].iter().map(|r| r.1).sum::<f64>() / count as f64
    };
    Ok(-relative(table, typed, tail)? / before)
}

/// Bodies count as touching from when the speed falls below this part of the first one until it reaches this part of the last.
const TOUCHED: f64 = 0.9;

/// Time of contact, from when a speed falls to 0.9 of its first value to when, turned round, it reaches 0.9 of its last one.
fn contact_time(table: &Table, typed: &Observe) -> Result<f64, String> {
    let rows = table.of(typed)?;
    let (first, last) = (rows[0].1, -restitution(table, &Observe { over: None, ..typed.clone() })? * rows[0].1);
    let when = |level: f64| {
        let passes =
            |pair: &&[(f64, f64)]| (pair[0].1 - level) * first.signum() > 0.0 && (pair[1].1 - level) * first.signum() <= 0.0;
        let pair = rows.windows(2).find(passes).ok_or_else(|| format!("the speed never passes {level:e}"))?;
        let share = (pair[0].1 - level) / (pair[0].1 - pair[1].1);
        Ok::<f64, String>(pair[0].0 + (pair[1].0 - pair[0].0) * share)
    };
    Ok(when(TOUCHED * last)? - when(TOUCHED * first)?)
}

/// Slope of a series against time by least squares.
fn slope(rows: &[(f64, f64)]) -> Result<f64, String> {
    if rows.len() < 3 {
        return Err("a slope needs at least three rows".into());
    }
    let n = rows.len() as f64;
    let (t, y) = (rows.iter().map(|r| r.0).sum::<f64>() / n, rows.iter().map(|r| r.1).sum::<f64>() / n);
    let (up, down) = rows.iter().fold((0.0, 0.0), |(u, d), r| (u + (r.0 - t) * (r.1 - y), d + (r.0 - t).powi(2)));
    Ok(up / down)
}

fn growth_rate(table: &Table, typed: &Observe) -> Result<f64, String> {
    let rows: Vec<(f64, f64)> = table.of(typed)?.into_iter().filter(|r| r.1 > 0.0).map(|(t, v)| (t, v.ln())).collect();
    slope(&rows)
}

fn ratio_of_means(table: &Table, typed: &Observe) -> Result<f64, String> {
    let mean = |rows: Vec<(f64, f64)>| rows.iter().map(|r| r.1).sum::<f64>() / rows.len() as f64;
    Ok(mean(table.of(typed)?) / mean(table.over(typed)?))
}

pub const CONTACT_TIME: ObservableKind = ObservableKind {
    word: "contact_time",
    about: "time from where series `of`, a speed, has fallen to 0.9 of its first value to 0.9 of its last, turned back",
    needs: &["of"],
    fields: &[],
    value: Value::Result(contact_time),
};

pub const SLOPE: ObservableKind = ObservableKind {
    word: "slope",
    about: "slope of series `of` within the times `between`, by least squares",
    needs: &["of", "between"],
    fields: &[],
    value: Value::Result(|table, typed| slope(&table.of(typed)?)),
};

pub const RATIO_OF_MEANS: ObservableKind = ObservableKind {
    word: "ratio_of_means",
    about: "mean of series `of` over that of series `over`, within the times `between`",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Result(ratio_of_means),
};

pub const RESTITUTION: ObservableKind = ObservableKind {
    word: "restitution",
    about: "minus the mean of the last tenth of series `of` (less `over`) over its first value",
    needs: &["of"],
    fields: &[],
    value: Value::Result(restitution),
};

pub const GROWTH_RATE: ObservableKind = ObservableKind {
    word: "growth_rate",
    about: "slope of ln of series `of` within the times `between`",
    needs: &["of", "between"],
    fields: &[],
    value: Value::Result(growth_rate),
};

pub const RATIO: ObservableKind = ObservableKind {
    word: "ratio",
    about: "last value of series `of` over the last of `over`",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let last = |rows: Vec<(f64, f64)>| rows[rows.len() - 1].1;
        Ok(last(table.of(typed)?) / last(table.over(typed)?))
    }),
};

pub const RMS: ObservableKind = ObservableKind {
    word: "rms",
    about: "root mean square of series `of` within the times `between`",
    needs: &["of"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let rows = table.of(typed)?;
        Ok((rows.iter().map(|r| r.1 * r.1).sum::<f64>() / rows.len() as f64).sqrt())
    }),
};

/// Slope of deflection against deflection over load by least squares: Southwell 1932.
fn southwell(table: &Table, typed: &Observe) -> Result<f64, String> {
    let loads = table.over(typed)?;
    let pairs = table.of(typed)?.into_iter().zip(loads).filter(|(_, load)| load.1 != 0.0);
    let rows: Vec<(f64, f64)> = pairs.map(|(deflection, load)| (deflection.1.abs(), (deflection.1 / load.1).abs())).collect();
    if rows.len() < 3 {
        return Err("a Southwell line needs at least three rows under load".into());
    }
    let n = rows.len() as f64;
    let (x, y) = (rows.iter().map(|r| r.0).sum::<f64>() / n, rows.iter().map(|r| r.1).sum::<f64>() / n);
    let (up, down) = rows.iter().fold((0.0, 0.0), |(u, d), r| (u + (r.0 - x) * (r.1 - y), d + (r.0 - x).powi(2)));
    Ok(down / up)
}

pub const SOUTHWELL: ObservableKind = ObservableKind {
    word: "southwell",
    about: "buckling load: slope of series `of`, a deflection, against itself over series `over`, the load",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Result(southwell),
};
