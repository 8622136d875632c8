//! Waves of a setting that are run, and the file that keeps what they did.

use super::setting::Setting;
use super::simulate::{Measured, simulate};
use crate::output::csv::shortest;
use crate::run::{INTERRUPTED, Stop};
use crate::study::accuracy::table::{cells, line};
use crate::study::von_neumann::Mode;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// A growth rate below this fraction of c/dx counts as the rounding error of a wave that does not grow.
const GROWS: f64 = 1e-4;

/// The waves of the Brillouin zone that are run. Up to half of the number asked for is spread over all waves that grow, the
/// fastest first, and the rest over those that swing. A wave that does both is left out.
pub fn chosen(setting: &Setting, cells: usize, count: usize) -> Vec<[f64; 3]> {
    let unit = setting.unit_rate();
    let modes = setting.wave_vectors(cells).into_iter().map(|wave| (wave, setting.mode(wave)));
    // A neutral motion with damping keeps a displacement, but no velocity to measure.
    let still = |mode: &Mode| setting.dissipates() && mode.rate.abs().max(mode.frequency) < GROWS * unit;
    let pure = modes.filter(|(_, mode)| mode.rate.min(mode.frequency) < 1e-6 * unit && !still(mode));
    let (mut growing, stable): (Vec<_>, Vec<_>) = pure.partition(|(_, mode)| mode.rate > GROWS * unit);
    growing.sort_by(|a, b| b.1.rate.total_cmp(&a.1.rate));
    let some = growing.len().min(count.div_ceil(2)).max(count.saturating_sub(stable.len()));
    let waves = |modes: &[([f64; 3], _)]| modes.iter().map(|mode| mode.0).collect::<Vec<_>>();
    let mut chosen = spread(&waves(&growing), some);
    chosen.extend(spread(&waves(&stable), count - chosen.len().min(count)));
    chosen
}

/// `count` elements of a list, the first among them, at distances as equal as whole numbers allow.
fn spread<T: Copy>(list: &[T], count: usize) -> Vec<T> {
    let count = count.min(list.len());
    (0..count).map(|k| list[k * list.len() / count]).collect()
}

/// A run and the setting that it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    pub setting: Vec<String>,
    /// Rates and frequencies over c/dx, waves times dx.
    pub run: Measured,
}

/// What a file of runs begins with, and its rows.
pub struct Runs {
    path: PathBuf,
    pub rows: Vec<Row>,
}

impl Runs {
    /// Opens the file, or makes it.
    ///
    /// # Errors
    /// One sentence where the file is of another study.
    pub fn open(path: &Path, stamp: &str, paths: &[String], force: bool) -> Result<Self, String> {
        let failed = |error: std::io::Error| format!("{}: {error}", path.display());
        let header = format!("# {stamp}\n{}\n", line(&columns(paths)));
        let text = match std::fs::read_to_string(path) {
            Ok(text) if !force => text,
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(failed(error)),
            _ => String::new(),
        };
        // A kill may have cut a row, or the header itself.
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let rows = match text[..whole].strip_prefix(&header) {
            Some(rest) => rest.lines().map(|text| row(text, paths.len())).collect::<Option<Vec<_>>>(),
            None if header.starts_with(&text) => Some(Vec::new()),
            None => None,
        };
        let rows = rows.ok_or_else(|| {
            let place = path.display();
            format!("{place} has the runs of another study, or the scene has changed since; --force overwrites it, --out names another file")
        })?;
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(failed)?;
        }
        let kept = if rows.is_empty() { header.as_str() } else { &text[..whole] };
        crate::output::durable::put(path, &[kept.as_bytes()])?;
        Ok(Self { path: path.into(), rows })
    }

    /// Runs the waves that have no row.
    ///
    /// # Errors
    /// A run that fails, a file that cannot be written, or the user.
    pub fn fill(
        &mut self,
        key: &[String],
        setting: &Setting,
        cells: usize,
        count: usize,
        mut tell: impl FnMut(&Row),
    ) -> Result<(), Stop> {
        for wave in chosen(setting, cells, count) {
            if self.holds(key, wave.map(|k| k * setting.spacing())) {
                continue;
            }
            if INTERRUPTED.load(Ordering::Relaxed) {
                let (rows, path) = (self.rows.len(), self.path.display());
                let message = format!("interrupted with {rows} runs in {path}; the same command goes on from there");
                return Err(Stop::Interrupted(message));
            }
            let run = simulate(setting, cells, wave).map_err(Stop::Failed)?;
            let row = Row { setting: key.to_vec(), run: run.over(setting) };
            self.append(&row).map_err(Stop::Failed)?;
            tell(&row);
            self.rows.push(row);
        }
        Ok(())
    }

    /// The runs of a setting.
    pub fn of<'a>(&'a self, key: &'a [String]) -> impl Iterator<Item = &'a Measured> {
        self.rows.iter().filter(move |row| row.setting == key).map(|row| &row.run)
    }

    fn holds(&self, key: &[String], wave: [f64; 3]) -> bool {
        self.of(key).any(|run| (0..3).all(|axis| (run.wave[axis] - wave[axis]).abs() < 1e-9))
    }

    fn append(&self, row: &Row) -> Result<(), String> {
        let Measured { wave, theory, rate, frequency, difference } = row.run;
        let numbers = wave.into_iter().chain([theory.rate, theory.frequency, rate, frequency, difference]);
        let text: Vec<String> = row.setting.iter().cloned().chain(numbers.map(shortest)).collect();
        let file = OpenOptions::new().append(true).open(&self.path);
        let written = file.and_then(|mut file| file.write_all((line(&text) + "\n").as_bytes()));
        written.map_err(|error| format!("{}: {error}", self.path.display()))
    }
}

fn columns(paths: &[String]) -> Vec<String> {
    let own = ["kx dx", "ky dx", "kz dx", "theory rate", "theory frequency", "rate", "frequency", "difference"];
    paths.iter().cloned().chain(own.map(str::to_string)).collect()
}

fn row(text: &str, paths: usize) -> Option<Row> {
    let cells = cells(text);
    let numbers: Vec<f64> = cells.get(paths..)?.iter().map(|cell| cell.parse()).collect::<Result<_, _>>().ok()?;
    let &[x, y, z, theory_rate, theory_frequency, rate, frequency, difference] = &numbers[..] else { return None };
    let theory = Mode { rate: theory_rate, frequency: theory_frequency, polarisation: [f64::NAN; 3], quadrature: [f64::NAN; 3] };
    Some(Row { setting: cells[..paths].to_vec(), run: Measured { wave: [x, y, z], theory, rate, frequency, difference } })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_thinned_evenly() {
        assert_eq!(spread(&[1, 2, 3, 4, 5, 6], 3), [1, 3, 5]);
        assert_eq!(spread(&[1, 2], 5), [1, 2]);
        assert!(spread::<i32>(&[], 2).is_empty());
    }

    #[test]
    fn a_row_is_read_back() {
        let read = row("\"[0.8, 1]\",3.25,0,0,0.1,0,0.101,0,0.01", 1).unwrap();
        assert_eq!(read.setting, ["[0.8, 1]"]);
        assert_eq!((read.run.wave[0], read.run.theory.rate, read.run.rate, read.run.difference), (3.25, 0.1, 0.101, 0.01));
        assert!(row("a,1,2", 1).is_none());
    }
}
