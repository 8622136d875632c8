//! The series that results are found from.

use crate::scene::file::Observe;
use std::collections::BTreeMap;

/// A finished run's series: times and columns by name.
#[derive(Debug, Clone, Default)]
pub struct Table {
    pub times: Vec<f64>,
    pub columns: BTreeMap<String, Vec<f64>>,
}

impl Table {
    /// Times and values of a column, within the observable's window.
    pub fn window(&self, name: &str, typed: &Observe) -> Result<Vec<(f64, f64)>, String> {
        let column = self.columns.get(name).ok_or_else(|| format!("there is no series `{name}`"))?;
        let [first, last] = typed.between.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let pairs = self.times.iter().copied().zip(column.iter().copied());
        let list: Vec<(f64, f64)> = pairs.filter(|(t, _)| (first..=last).contains(t)).collect();
        if list.is_empty() { Err(format!("the series `{name}` has no row in the window")) } else { Ok(list) }
    }

    /// Series `of`, less series `over` where one is named.
    pub fn difference(&self, typed: &Observe) -> Result<Vec<(f64, f64)>, String> {
        let mut rows = self.of(typed)?;
        if let Some(other) = &typed.over {
            let taken = self.window(other, typed)?;
            rows.iter_mut().zip(taken).for_each(|(row, other)| row.1 -= other.1);
        }
        Ok(rows)
    }

    pub(super) fn of(&self, typed: &Observe) -> Result<Vec<(f64, f64)>, String> {
        self.window(typed.of.as_deref().unwrap_or_default(), typed)
    }

    pub(super) fn over(&self, typed: &Observe) -> Result<Vec<(f64, f64)>, String> {
        self.window(typed.over.as_deref().unwrap_or_default(), typed)
    }
}
