//! One moment of a run as the host sees it, and scalars named by a path such as `stress.yy`.

/// One moment of a run as the host sees it: f64, in the scene's units, ordered by particle number
/// so that rows compare across outputs.
#[derive(Debug, Clone, Default)]
pub struct Snapshot {
    pub time: f64,
    pub step: u64,
    /// 1, 2 or 3.
    pub dimension: usize,
    /// Typical distance between neighbouring particles.
    pub spacing: f64,
    /// Unused axes are 0.
    pub positions: Vec<[f64; 3]>,
    pub columns: Vec<Column>,
}

/// A field of all particles.
#[derive(Debug, Clone)]
pub struct Column {
    pub name: String,
    pub unit: String,
    /// 1 scalar, 3 vector, 6 symmetric tensor as xx yy zz xy yz xz.
    pub components: usize,
    /// Row-major, `particles * components` long.
    pub values: Vec<f64>,
}

const VECTOR_PARTS: [&str; 4] = ["magnitude", "x", "y", "z"];
const TENSOR_PARTS: [&str; 8] = ["von_mises", "mean", "xx", "yy", "zz", "xy", "yz", "xz"];

impl Column {
    /// What may follow the name of this column in a path; empty for a scalar.
    pub fn parts(&self) -> &'static [&'static str] {
        match self.components {
            3 => &VECTOR_PARTS,
            6 => &TENSOR_PARTS,
            _ => &[],
        }
    }

    fn part(&self, part: &str) -> Option<Vec<f64>> {
        // The tensors are symmetric: both orders of two axes name the same component.
        let part = match part {
            "yx" => "xy",
            "zy" => "yz",
            "zx" => "xz",
            part => part,
        };
        let measure: fn(&[f64]) -> f64 = match (self.components, part) {
            (1, "") => |row| row[0],
            (3, "magnitude") => |row| row.iter().map(|v| v * v).sum::<f64>().sqrt(),
            (6, "von_mises") => von_mises,
            (6, "mean") => |row| (row[0] + row[1] + row[2]) / 3.0,
            (3, part) => return self.component(VECTOR_PARTS[1..].iter().position(|&p| p == part)?),
            (6, part) => return self.component(TENSOR_PARTS[2..].iter().position(|&p| p == part)?),
            _ => return None,
        };
        Some(self.values.chunks_exact(self.components).map(measure).collect())
    }

    fn component(&self, k: usize) -> Option<Vec<f64>> {
        Some(self.values.iter().skip(k).step_by(self.components).copied().collect())
    }
}

/// √(3/2 s:s) with s the deviator of the row `xx yy zz xy yz xz`.
fn von_mises(row: &[f64]) -> f64 {
    let &[xx, yy, zz, xy, yz, xz] = row else {
        return f64::NAN;
    };
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * normal + 3.0 * (xy * xy + yz * yz + xz * xz)).sqrt()
}

impl Snapshot {
    /// Corners of the box around the particles, a twentieth larger on each side.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for position in &self.positions {
            for k in 0..3 {
                low[k] = low[k].min(position[k]);
                high[k] = high[k].max(position[k]);
            }
        }
        let margin: [f64; 3] = std::array::from_fn(|k| 0.05 * (high[k] - low[k]));
        [std::array::from_fn(|k| low[k] - margin[k]), std::array::from_fn(|k| high[k] + margin[k])]
    }

    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// One number per particle by a path: `pressure`, `velocity.x`, `velocity.magnitude`,
    /// `stress.von_mises`, `position.x`. The error is a sentence that names the nearest valid path.
    pub fn scalar(&self, path: &str) -> Result<Vec<f64>, String> {
        let (name, part) = path.split_once('.').unwrap_or((path, ""));
        let values = match self.column(name) {
            Some(column) => column.part(part),
            None if name == "position" => self.position(part),
            None => None,
        };
        let values = values.ok_or_else(|| self.unknown(path))?;
        if values.len() == self.positions.len() {
            return Ok(values);
        }
        Err(format!("{path} has {} values for {} particles", values.len(), self.positions.len()))
    }

    /// The unit of what [`Snapshot::scalar`] gives for the same path; empty where it is not known.
    pub fn unit(&self, path: &str) -> &str {
        let name = path.split_once('.').map_or(path, |(name, _)| name);
        match self.column(name) {
            Some(column) => &column.unit,
            None => self.length_and_time_unit().0,
        }
    }

    /// The units of positions and of time, as the unit of the velocity tells them ("m/s" or "mm/ms").
    pub fn length_and_time_unit(&self) -> (&str, &str) {
        let velocity = self.column("velocity").map_or("", |column| column.unit.as_str());
        velocity.split_once('/').unwrap_or(("", ""))
    }

    /// Every path that [`Snapshot::scalar`] takes.
    pub fn paths(&self) -> Vec<String> {
        let mut paths = Vec::new();
        for column in &self.columns {
            match column.parts() {
                [] => paths.push(column.name.clone()),
                parts => paths.extend(parts.iter().map(|part| format!("{}.{part}", column.name))),
            }
        }
        paths.extend(VECTOR_PARTS.iter().map(|part| format!("position.{part}")));
        paths
    }

    fn position(&self, part: &str) -> Option<Vec<f64>> {
        let measure: fn(&[f64; 3]) -> f64 = match part {
            "x" => |p| p[0],
            "y" => |p| p[1],
            "z" => |p| p[2],
            "magnitude" => |p| p.iter().map(|v| v * v).sum::<f64>().sqrt(),
            _ => return None,
        };
        Some(self.positions.iter().map(measure).collect())
    }

    fn unknown(&self, path: &str) -> String {
        let paths = self.paths();
        // A bare vector or tensor means its most telling scalar, which is listed first.
        let whole = paths.iter().find(|known| known.split('.').next() == Some(path));
        let near = paths.iter().min_by_key(|known| strsim::damerau_levenshtein(known, path));
        match whole.or(near) {
            Some(near) => format!("there is no field {path:?}; the nearest is {near:?}"),
            None => format!("there is no field {path:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Snapshot {
        let column =
            |name: &str, unit: &str, components, values| Column { name: name.into(), unit: unit.into(), components, values };
        Snapshot {
            dimension: 2,
            positions: vec![[1.0, 2.0, 0.0], [3.0, 4.0, 0.0]],
            columns: vec![
                column("pressure", "Pa", 1, vec![5.0, 6.0]),
                column("velocity", "m/s", 3, vec![3.0, 4.0, 0.0, 0.0, 0.0, 2.0]),
                column("stress", "Pa", 6, vec![9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 0.0, 0.0]),
            ],
            ..Snapshot::default()
        }
    }

    #[test]
    fn paths_reach_components_and_measures() {
        let s = sample();
        assert_eq!(s.scalar("pressure").unwrap(), [5.0, 6.0]);
        assert_eq!(s.scalar("velocity.y").unwrap(), [4.0, 0.0]);
        assert_eq!(s.scalar("velocity.magnitude").unwrap(), [5.0, 2.0]);
        assert_eq!(s.scalar("stress.xy").unwrap(), [0.0, 2.0]);
        assert_eq!(s.scalar("stress.yx").unwrap(), [0.0, 2.0]);
        assert_eq!(s.scalar("stress.mean").unwrap(), [3.0, 1.0]);
        assert_eq!(s.scalar("position.x").unwrap(), [1.0, 3.0]);
        // Uniaxial tension gives the stress itself; pure shear gives √3 times the shear.
        let equivalent = s.scalar("stress.von_mises").unwrap();
        assert_eq!(equivalent[0], 9.0);
        assert!((equivalent[1] - 12f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn every_listed_path_works() {
        let s = sample();
        for path in s.paths() {
            assert_eq!(s.scalar(&path).unwrap().len(), 2, "{path}");
        }
    }

    #[test]
    fn errors_name_the_nearest_path() {
        let s = sample();
        assert!(s.scalar("presure").unwrap_err().contains("\"pressure\""));
        assert!(s.scalar("velocity").unwrap_err().contains("\"velocity.magnitude\""));
        assert!(s.scalar("stress").unwrap_err().contains("\"stress.von_mises\""));
        assert!(s.scalar("stress.mises").unwrap_err().contains("\"stress.von_mises\""));
        assert!(s.scalar("pressure.x").unwrap_err().contains("\"pressure\""));
    }

    #[test]
    fn units_follow_the_columns() {
        let s = sample();
        assert_eq!(s.unit("stress.von_mises"), "Pa");
        assert_eq!(s.unit("position.x"), "m");
        assert_eq!(s.length_and_time_unit(), ("m", "s"));
    }

    #[test]
    fn a_column_of_the_wrong_length_is_an_error() {
        let mut s = sample();
        s.columns[0].values.pop();
        assert!(s.scalar("pressure").unwrap_err().contains("1 values for 2 particles"));
    }
}
