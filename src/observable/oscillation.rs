//! Numbers of a series that swings, found from a finished run: period, frequency, middle, amplitude.

use super::table::Table;
use super::{ObservableKind, Value};
use crate::scene::file::Observe;

type Rows = [(f64, f64)];

/// Where a series is greatest (`sign` 1) or least (-1): time and value at the top of the parabola through three rows.
fn extreme(rows: &Rows, sign: f64) -> (f64, f64) {
    let best = (0..rows.len()).max_by(|&a, &b| (sign * rows[a].1).total_cmp(&(sign * rows[b].1))).unwrap_or(0);
    if best == 0 || best + 1 == rows.len() {
        return rows[best];
    }
    let [(t0, y0), (t1, y1), (t2, y2)] = [rows[best - 1], rows[best], rows[best + 1]];
    let (before, after) = (t1 - t0, t2 - t1);
    let (rise, fall) = ((y1 - y0) / before, (y2 - y1) / after);
    let curvature = (fall - rise) / (before + after);
    let slope = (rise * after + fall * before) / (before + after);
    if curvature == 0.0 { (t1, y1) } else { (t1 - slope / (2.0 * curvature), y1 - slope * slope / (4.0 * curvature)) }
}

/// Times at which a series crosses a level, either way.
fn crossings(rows: &Rows, level: f64) -> Vec<f64> {
    let crossing = |w: &Rows| {
        let (a, b) = (w[0].1 - level, w[1].1 - level);
        let crosses = (a < 0.0 && b >= 0.0) || (a > 0.0 && b <= 0.0);
        crosses.then(|| w[0].0 + (w[1].0 - w[0].0) * a / (a - b))
    };
    rows.windows(2).filter_map(crossing).collect()
}

/// Whole periods from one crossing to another of the same direction where there are any, as they do not depend on
/// the level; else twice the time between the only two.
fn period(table: &Table, typed: &Observe) -> Result<f64, String> {
    let rows = table.difference(typed)?;
    let level = typed.level.unwrap_or_else(|| middle(&rows));
    let times = crossings(&rows, level);
    match times.len() {
        0 | 1 => Err(format!("a period needs two crossings of {level:e}, found {}", times.len())),
        2 => Ok(2.0 * (times[1] - times[0])),
        count => {
            let periods = (count - 1) / 2;
            Ok((times[2 * periods] - times[0]) / periods as f64)
        }
    }
}

fn middle(rows: &Rows) -> f64 {
    0.5 * (extreme(rows, 1.0).1 + extreme(rows, -1.0).1)
}

pub const PERIOD: ObservableKind = ObservableKind {
    word: "period",
    about: "mean period of series `of` (less `over`) from its crossings of `level`, or of the middle of its extremes",
    needs: &["of"],
    fields: &[],
    value: Value::Result(period),
};

pub const FREQUENCY: ObservableKind = ObservableKind {
    word: "frequency",
    about: "one over the `period`",
    needs: &["of"],
    fields: &[],
    value: Value::Result(|table, typed| Ok(1.0 / period(table, typed)?)),
};

pub const SWING_PERIOD: ObservableKind = ObservableKind {
    word: "swing_period",
    about: "twice the time between greatest and least value of series `of` (less `over`), each by a parabola through three rows",
    needs: &["of"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let rows = table.difference(typed)?;
        Ok(2.0 * (extreme(&rows, 1.0).0 - extreme(&rows, -1.0).0).abs())
    }),
};

pub const MIDDLE: ObservableKind = ObservableKind {
    word: "middle",
    about: "half the sum of greatest and least value of series `of` (less `over`)",
    needs: &["of"],
    fields: &[],
    value: Value::Result(|table, typed| Ok(middle(&table.difference(typed)?))),
};

pub const AMPLITUDE: ObservableKind = ObservableKind {
    word: "amplitude",
    about: "half the difference of greatest and least value of series `of` (less `over`)",
    needs: &["of"],
    fields: &[],
    value: Value::Result(|table, typed| {
        let rows = table.difference(typed)?;
        Ok(0.5 * (extreme(&rows, 1.0).1 - extreme(&rows, -1.0).1))
    }),
};

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.3 + 2 cos(2 pi t/0.7) in rows of 0.01.
    fn table(duration: f64) -> Table {
        let times: Vec<f64> = (0..(duration / 0.01) as usize).map(|k| 0.01 * k as f64).collect();
        let wave = times.iter().map(|t| 0.3 + 2.0 * (std::f64::consts::TAU * t / 0.7).cos()).collect();
        Table { times, columns: [("wave".to_string(), wave)].into() }
    }

    fn number(kind: &ObservableKind, duration: f64) -> f64 {
        let typed = Observe { of: Some("wave".into()), ..Observe::default() };
        let Value::Result(of) = kind.value else { panic!("a result") };
        of(&table(duration), &typed).expect("a number")
    }

    #[test]
    fn a_wave_shows_its_numbers_between_rows() {
        for duration in [0.69, 1.2, 2.6] {
            assert!((number(&PERIOD, duration) - 0.7).abs() < 1e-3);
            assert!((number(&FREQUENCY, duration) - 1.0 / 0.7).abs() < 2e-3);
            assert!((number(&MIDDLE, duration) - 0.3).abs() < 1e-4);
            assert!((number(&AMPLITUDE, duration) - 2.0).abs() < 1e-4);
        }
        assert!((number(&SWING_PERIOD, 0.69) - 0.7).abs() < 1e-6);
    }
}
