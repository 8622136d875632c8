//! A symmetric banded matrix and its factors L D L^T, without pivoting: by Sylvester's law of inertia D has as many
//! negative pivots as the matrix has negative eigenvalues.

/// Row i holds columns i - width to i: entry j at `i * (width + 1) + j + width - i`.
#[derive(Debug, Clone)]
pub struct Band {
    pub size: usize,
    pub width: usize,
    entries: Vec<f64>,
}

impl Band {
    pub fn new(size: usize, width: usize) -> Self {
        Self { size, width, entries: vec![0.0; size * (width + 1)] }
    }

    fn place(&self, row: usize, column: usize) -> usize {
        row * (self.width + 1) + column + self.width - row
    }

    /// Adds to an entry of the lower triangle; those of the upper one belong to their mirror image.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row.max(column), row.min(column));
        self.entries[place] += value;
    }

    pub fn get(&self, row: usize, column: usize) -> f64 {
        let (row, column) = (row.max(column), row.min(column));
        if row - column > self.width { 0.0 } else { self.entries[self.place(row, column)] }
    }

    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.size];
        for row in 0..self.size {
            for column in row.saturating_sub(self.width)..row {
                y[row] += self.get(row, column) * x[column];
                y[column] += self.get(row, column) * x[row];
            }
            y[row] += self.get(row, row) * x[row];
        }
        y
    }

    /// Row by row: L_ij D_j = A_ij - sum over k of L_ik D_k L_jk.
    ///
    /// # Errors
    /// One sentence, where a pivot is lost in rounding: some motion meets no resistance.
    pub fn factor(mut self) -> Result<Factors, String> {
        let largest = (0..self.size).map(|i| self.get(i, i).abs()).fold(0.0, f64::max);
        let mut pivots = vec![0.0; self.size];
        for row in 0..self.size {
            let pivot = self.eliminate(row, &pivots);
            if pivot.abs() <= 1e-14 * largest {
                return Err("some motion meets no resistance: hold the scene so that it cannot move as a whole".into());
            }
            pivots[row] = pivot;
        }
        Ok(Factors { lower: self, pivots })
    }

    /// Turns a row into that of L, from the rows before, which are; gives its pivot.
    fn eliminate(&mut self, row: usize, pivots: &[f64]) -> f64 {
        let first = row.saturating_sub(self.width);
        for column in first..row {
            let from = first.max(column.saturating_sub(self.width));
            let (left, right, count) = (self.place(row, from), self.place(column, from), column - from);
            let (left, right) = (&self.entries[left..left + count], &self.entries[right..right + count]);
            // This row still holds L D.
            let sum: f64 = left.iter().zip(right).map(|(a, b)| a * b).sum();
            let place = self.place(row, column);
            self.entries[place] -= sum;
        }
        let mut pivot = self.get(row, row);
        for (column, divisor) in pivots.iter().enumerate().take(row).skip(first) {
            let place = self.place(row, column);
            let scaled = self.entries[place] / divisor;
            pivot -= scaled * self.entries[place];
            self.entries[place] = scaled;
        }
        pivot
    }
}

/// L, with ones for its diagonal, and D.
#[derive(Debug, Clone)]
pub struct Factors {
    lower: Band,
    pivots: Vec<f64>,
}

impl Factors {
    pub fn negative(&self) -> usize {
        self.pivots.iter().filter(|pivot| **pivot < 0.0).count()
    }

    pub fn solve(&self, mut x: Vec<f64>) -> Vec<f64> {
        let Band { size, width, .. } = self.lower;
        for row in 0..size {
            let sum: f64 = (row.saturating_sub(width)..row).map(|k| self.lower.get(row, k) * x[k]).sum();
            x[row] -= sum;
        }
        x.iter_mut().zip(&self.pivots).for_each(|(x, pivot)| *x /= pivot);
        for row in (0..size).rev() {
            let own = x[row];
            for (column, slot) in x.iter_mut().enumerate().take(row).skip(row.saturating_sub(width)) {
                *slot -= self.lower.get(row, column) * own;
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Second differences with a diagonal that is lowered: eigenvalues 2 - 2 cos(k pi/(n + 1)) - shift.
    fn lowered(size: usize, shift: f64) -> Band {
        let mut band = Band::new(size, 3);
        for i in 0..size {
            band.add(i, i, 2.0 - shift);
            if i > 0 {
                band.add(i, i - 1, -1.0);
            }
        }
        band
    }

    #[test]
    fn factors_solve_and_count_negative_eigenvalues() {
        let size = 20;
        let x: Vec<f64> = (0..size).map(|i| (i as f64).sin()).collect();
        for shift in [0.0, 0.1, 0.5, 1.3] {
            let band = lowered(size, shift);
            let eigenvalue = |k: usize| 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / (size + 1) as f64).cos() - shift;
            let factors = band.clone().factor().unwrap();
            assert_eq!(factors.negative(), (1..=size).filter(|&k| eigenvalue(k) < 0.0).count());
            let back = factors.solve(band.times(&x));
            assert!(back.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-11));
        }
        assert!(Band::new(3, 1).factor().is_err());
    }
}
