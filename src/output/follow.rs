//! A window that stands still while the bodies are in it, and grows where one leaves it.

use super::snapshot::Snapshot;

/// Part of the largest side of the first window by which it grows at once, so that pictures of a moving body keep their scale
/// for a while.
const STEP: f64 = 0.25;
/// Part of a body's particles, at either end of an axis, that may leave the window: debris that flies off shall not make the
/// body a dot.
const DEBRIS: f64 = 0.01;

/// The first window, grown in whole steps to where the bodies of a moment are. It depends on that moment alone, so that a run
/// that goes on after a kill paints the same pictures.
pub fn follow([low, high]: [[f64; 3]; 2], snapshot: &Snapshot) -> [[f64; 3]; 2] {
    let largest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let step = STEP * if largest > 0.0 { largest } else { snapshot.spacing };
    let mut window = [low, high];
    for rows in bodies(snapshot) {
        for k in 0..snapshot.dimension.min(3) {
            let Some([first, last]) = middle(rows.iter().map(|&i| snapshot.positions[i][k])) else { continue };
            // A body that only fills its window up to the edge has not left it.
            let beyond = |way: f64| if way > 1e-9 * step { step * (way / step).ceil() } else { 0.0 };
            window[0][k] = window[0][k].min(low[k] - beyond(low[k] - first));
            window[1][k] = window[1][k].max(high[k] + beyond(last - high[k]));
        }
    }
    window
}

/// Rows of the particles of each body; of all where the snapshot does not tell.
fn bodies(snapshot: &Snapshot) -> Vec<Vec<usize>> {
    let Some(column) = snapshot.column("body") else { return vec![(0..snapshot.positions.len()).collect()] };
    let mut list: std::collections::BTreeMap<i64, Vec<usize>> = std::collections::BTreeMap::new();
    for (i, &body) in column.values.iter().enumerate().take(snapshot.positions.len()) {
        list.entry(body as i64).or_default().push(i);
    }
    list.into_values().collect()
}

/// Between which values all but the debris lies.
fn middle(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let mut finite: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    let skip = (DEBRIS * finite.len() as f64) as usize;
    let last = finite.len().checked_sub(1 + skip)?;
    let low = *finite.select_nth_unstable_by(skip, f64::total_cmp).1;
    let high = *finite.select_nth_unstable_by(last, f64::total_cmp).1;
    Some([low, high])
}

#[cfg(test)]
mod tests {
    use super::super::snapshot::Column;
    use super::*;

    /// A row of particles from 0 to 1, moved, and a lone one of another body.
    fn moved(way: [f64; 3], lone: [f64; 3]) -> Snapshot {
        let place = |i: usize| std::array::from_fn(|k| way[k] + if k == 0 { i as f64 / 199.0 } else { 0.0 });
        let positions: Vec<[f64; 3]> = (0..200).map(place).chain([lone]).collect();
        let values = (0..201).map(|i| f64::from(u8::from(i == 200))).collect();
        let body = Column { name: "body".into(), unit: String::new(), components: 1, values };
        Snapshot { dimension: 2, spacing: 0.005, positions, columns: vec![body], ..Snapshot::default() }
    }

    const FIRST: [[f64; 3]; 2] = [[-0.1, -0.1, 0.0], [1.1, 0.1, 0.0]];

    #[test]
    fn a_window_grows_in_steps_to_what_leaves_it() {
        let inside = [0.5, 0.0, 0.0];
        assert_eq!(follow(FIRST, &moved([0.05, 0.0, 0.0], inside)), FIRST);
        let fallen = follow(FIRST, &moved([0.0, -0.45, 0.0], inside));
        assert!((fallen[0][1] + 0.7).abs() < 1e-12 && fallen[1] == FIRST[1], "{fallen:?}");
        // One that flew on is in the picture if it is a body, and not if it is a splinter of one.
        assert!(follow(FIRST, &moved([0.0; 3], [9.0, 0.0, 0.0]))[1][0] >= 9.0);
        let mut debris = moved([0.0; 3], inside);
        debris.positions[7] = [0.0, 1e6, 0.0];
        debris.positions[9] = [f64::NAN, 0.0, 0.0];
        assert_eq!(follow(FIRST, &debris), FIRST);
    }
}
