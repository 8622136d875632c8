//! Distance of a series, a profile or the path of a point from a reference table.

use crate::observable::{KINDS, Value, trace};
use crate::output::csv::{self, shortest};
use crate::run::Finished;
use crate::scene::Scene;
use crate::scene::file::{Expect, Norm, Scale, ScaleWord};
use std::path::Path;

/// Abscissa, and one ordinate or the coordinates of a point.
type Rows = Vec<(f64, Vec<f64>)>;

/// How far a run is from its reference, and what that is a fraction of.
pub struct Distance {
    /// In the unit of the reference; of a phase a fraction already.
    pub gap: f64,
    pub scale: f64,
    /// What the scale is, in words.
    pub of: String,
}

/// The distance in the norm asked for.
pub fn distance(scene: &Scene, finished: &Finished, path: &Path, name: &str, expect: &Expect) -> Result<Distance, String> {
    let reference = reference(path, expect)?;
    let seen = seen(scene, finished, name)?;
    let within = |x: f64| x >= reference[0].0 && x <= reference[reference.len() - 1].0;
    let pairs: Vec<(&[f64], Vec<f64>)> =
        seen.iter().filter(|r| within(r.0)).map(|(x, y)| (y.as_slice(), interpolate(&reference, *x))).collect();
    if pairs.is_empty() {
        return Err(format!("{name}: no row lies within the reference {}", path.display()));
    }
    let gap = |p: &(&[f64], Vec<f64>)| length(&p.0.iter().zip(&p.1).map(|(a, b)| a - b).collect::<Vec<_>>());
    let norm = expect.norm.unwrap_or(Norm::Max);
    let gap = match norm {
        Norm::Max => pairs.iter().map(gap).fold(0.0, |m: f64, g| if g.is_nan() { g } else { m.max(g) }),
        Norm::Rms => (pairs.iter().map(|p| gap(p).powi(2)).sum::<f64>() / pairs.len() as f64).sqrt(),
        Norm::Final => gap(&pairs[pairs.len() - 1]),
        Norm::Phase => (period(&seen) / period(&reference) - 1.0).abs(),
    };
    let magnitudes = || pairs.iter().map(|p| length(&p.1));
    let (scale, of) = match (norm, expect.scale) {
        (Norm::Phase, _) => (1.0, "period".into()),
        (_, Some(Scale::Number(scale))) => (scale, shortest(scale)),
        (_, Some(Scale::Word(ScaleWord::Mean))) => (magnitudes().sum::<f64>() / pairs.len() as f64, "mean".into()),
        _ => (magnitudes().fold(0.0, f64::max), "peak".into()),
    };
    Ok(Distance { gap, scale, of })
}

fn length(point: &[f64]) -> f64 {
    point.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn seen(scene: &Scene, finished: &Finished, name: &str) -> Result<Rows, String> {
    let typed = &scene.file.observe[name];
    if KINDS.iter().any(|k| k.word == typed.kind && matches!(k.value, Value::Trace)) {
        return trace(&finished.table, typed);
    }
    let rows = match finished.profiles.get(name) {
        Some(rows) => rows.clone(),
        None => finished.table.window(name, typed)?,
    };
    Ok(rows.into_iter().map(|(x, y)| (x, vec![y])).collect())
}

/// The columns of a reference that an expectation names.
pub fn reference(path: &Path, expect: &Expect) -> Result<Rows, String> {
    let (names, rows) = csv::read(path)?;
    let find = |wanted: &String| {
        names.iter().position(|n| n == wanted).ok_or_else(|| format!("{} has no column `{wanted}`", path.display()))
    };
    let wanted = expect.columns.as_ref().ok_or("a reference needs its columns")?;
    let columns = wanted.iter().map(find).collect::<Result<Vec<usize>, String>>()?;
    if rows.len() < 2 {
        return Err(format!("{} has fewer than two rows", path.display()));
    }
    Ok(rows.iter().map(|r| (r[columns[0]], columns[1..].iter().map(|&k| r[k]).collect())).collect())
}

fn interpolate(table: &Rows, x: f64) -> Vec<f64> {
    let k = table.partition_point(|row| row.0 < x).clamp(1, table.len() - 1);
    let ((x0, before), (x1, after)) = (&table[k - 1], &table[k]);
    before.iter().zip(after).map(|(y0, y1)| y0 + (y1 - y0) * (x - x0) / (x1 - x0)).collect()
}

/// Mean time between upward crossings of the mean.
fn period(rows: &Rows) -> f64 {
    let mean = rows.iter().map(|r| r.1[0]).sum::<f64>() / rows.len() as f64;
    let crossing = |w: &[(f64, Vec<f64>)]| {
        let (a, b) = (w[0].1[0] - mean, w[1].1[0] - mean);
        (a < 0.0 && b >= 0.0).then(|| w[0].0 + (w[1].0 - w[0].0) * a / (a - b))
    };
    let times: Vec<f64> = rows.windows(2).filter_map(crossing).collect();
    if times.len() < 2 { f64::NAN } else { (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64 }
}
