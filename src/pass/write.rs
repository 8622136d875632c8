//! The loop of the twins: rows of the columns that a pass writes, on all cores.
//!
//! A pass is compiled once for each space, and a parallel iterator would be compiled once more for each loop of each pass: this
//! made up most of the library. The halving below is therefore generic only over what the columns hold. It calls the loop's
//! body through a pointer, once for each block of rows, and only [`fork`] knows about threads.

use crate::tensor::Space;

/// Smallest number of rows of a task: few enough to balance two cores on a thousand particles, and enough for the work to
/// outweigh the scheduling.
pub(crate) const GRAIN: usize = 128;
/// Tasks for each core, so that a core that is done early finds another task.
const TASKS: usize = 8;

/// Columns that are written together, row by row.
pub(crate) trait Rows: Send + Sized {
    type Row;
    fn length(&self) -> usize;
    /// The rows before a place, and those from it on.
    fn split(self, place: usize) -> (Self, Self);
    fn rows(self) -> impl Iterator<Item = Self::Row>;
}

impl<'c, T: Send> Rows for &'c mut [T] {
    type Row = &'c mut T;
    #[inline(always)]
    fn length(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn split(self, place: usize) -> (Self, Self) {
        self.split_at_mut(place)
    }
    #[inline(always)]
    fn rows(self) -> impl Iterator<Item = &'c mut T> {
        self.iter_mut()
    }
}

/// Several columns of one length side by side.
impl<A: Rows, B: Rows> Rows for (A, B) {
    type Row = (A::Row, B::Row);
    #[inline(always)]
    fn length(&self) -> usize {
        debug_assert_eq!(self.0.length(), self.1.length());
        self.0.length()
    }
    #[inline(always)]
    fn split(self, place: usize) -> (Self, Self) {
        let ((a, rest_of_a), (b, rest_of_b)) = (self.0.split(place), self.1.split(place));
        ((a, b), (rest_of_a, rest_of_b))
    }
    #[inline(always)]
    fn rows(self) -> impl Iterator<Item = Self::Row> {
        self.0.rows().zip(self.1.rows())
    }
}

/// A table with several entries a row; the last row may be shorter.
pub(crate) struct Wide<'c, T> {
    pub entries: &'c mut [T],
    pub width: usize,
}

impl<'c, T: Send> Rows for Wide<'c, T> {
    type Row = &'c mut [T];
    fn length(&self) -> usize {
        self.entries.len().div_ceil(self.width)
    }
    fn split(self, place: usize) -> (Self, Self) {
        let (first, rest) = self.entries.split_at_mut(place * self.width);
        (Self { entries: first, width: self.width }, Self { entries: rest, width: self.width })
    }
    fn rows(self) -> impl Iterator<Item = &'c mut [T]> {
        self.entries.chunks_mut(self.width)
    }
}

/// Takes columns out of the state for a block that writes them and reads all others of the state, and puts them back.
/// The block must not return early.
macro_rules! with_columns {
    ($state:ident, [$($column:ident),+] => $body:expr) => {{
        $(#[allow(unused_mut)] let mut $column = std::mem::take(&mut $state.columns.$column);)+
        $body;
        $($state.columns.$column = $column;)+
    }};
}
pub(crate) use with_columns;

/// Sets every row of a column from its index and the state, from which the column is taken out meanwhile: a pass reads
/// its neighbours' values of other columns, never of the one that it writes.
macro_rules! fill {
    ($state:ident, $column:ident, $value:expr) => {{
        let mut rows = std::mem::take(&mut $state.columns.$column);
        $crate::pass::write::write(&mut rows, $value);
        $state.columns.$column = rows;
    }};
}
pub(crate) use fill;

/// Sets every element of a column that is not the state's from its index.
#[inline(always)]
pub(crate) fn write<T: Send>(column: &mut [T], value: impl Fn(usize, &mut T) + Sync) {
    write_rows(column, GRAIN, value);
}

/// The same for columns that are written together, at least `grain` rows a task.
#[inline(always)]
pub(crate) fn write_rows<R: Rows>(columns: R, grain: usize, value: impl Fn(usize, R::Row) + Sync) {
    write_blocks(columns, grain, &|first, block: R| {
        for (k, row) in block.rows().enumerate() {
            value(first + k, row);
        }
    });
}

/// Calls `work` with the index of the first row of each block of rows, and the block.
pub(crate) fn write_blocks<R: Rows>(columns: R, grain: usize, work: &(dyn Fn(usize, R) + Sync)) {
    let length = columns.length();
    let task = length.div_ceil(TASKS * rayon::current_num_threads());
    halve(columns, 0, task.max(grain), work);
}

fn halve<R: Rows>(columns: R, first: usize, task: usize, work: &(dyn Fn(usize, R) + Sync)) {
    let length = columns.length();
    if length <= task {
        return work(first, columns);
    }
    let middle = length / 2;
    let (low, high) = columns.split(middle);
    let (mut low, mut high) = (Some(low), Some(high));
    let half = |rows: &mut Option<R>, first: usize| {
        if let Some(rows) = rows.take() {
            halve(rows, first, task, work);
        }
    };
    fork(&mut || half(&mut low, first), &mut || half(&mut high, first + middle));
}

/// Does two things, on two cores if another one is free.
fn fork(one: &mut (dyn FnMut() + Send), other: &mut (dyn FnMut() + Send)) {
    rayon::join(one, other);
}

/// Adds an increment to a sum and keeps the rounding error in `carry`, to be taken off the next increment (Kahan 1965). The
/// shader's twin must hide the intermediate sum from the compiler, which would simplify the error to 0.
#[inline(always)]
pub(crate) fn compensated_add<S: Space>(sum: &mut S::Vec, carry: &mut S::Vec, increment: S::Vec) {
    let corrected = increment - *carry;
    let total = *sum + corrected;
    *carry = (total - *sum) - corrected;
    *sum = total;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_written_once_with_its_own_index() {
        for length in [0, 1, 127, 128, 129, 1000, 4099] {
            let (mut a, mut b) = (vec![0usize; length], vec![0usize; length]);
            write_rows((&mut a[..], &mut b[..]), 1, |i, (a, b)| {
                *a += i;
                *b += 2 * i + 1;
            });
            assert!((0..length).all(|i| a[i] == i && b[i] == 2 * i + 1), "{length}");
        }
    }

    #[test]
    fn wide_rows_keep_together_and_the_last_may_be_shorter() {
        let mut table = vec![0usize; 10];
        write_rows(Wide { entries: &mut table, width: 4 }, 1, |i, row| {
            let length = row.len();
            row.fill(10 * i + length);
        });
        assert_eq!(table, [4, 4, 4, 4, 14, 14, 14, 14, 22, 22]);
    }
}
