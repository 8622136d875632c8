use super::*;

fn sample(step: u64) -> Snapshot {
    let count = 700;
    let value = |k: usize| (k as f32 * 0.37 + step as f32).sin() as f64;
    let column = |name: &str, unit: &str, components: usize| Column {
        name: name.into(),
        unit: unit.into(),
        components,
        values: (0..count * components).map(value).collect(),
    };
    let mut columns =
        vec![column("density", "kg/m³", 1), column("particle", "", 1), column("stress", "Pa", 6), column("velocity", "m/s", 3)];
    columns[1].values = (0..count).map(|k| (20_000_000 + k) as f64).collect();
    Snapshot {
        time: step as f64 * 0.1,
        step: step * 10,
        dimension: 3,
        spacing: 0.01,
        positions: (0..count).map(|k| [value(k), value(k + 1), value(k + 2)]).collect(),
        columns,
    }
}

/// Three frames and their master in a folder of their own; gives the master.
fn write(name: &str, steps: u32) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("lithosph-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("particles")).unwrap();
    let mut kept = Vec::new();
    for number in 0..steps {
        let snapshot = sample(u64::from(number));
        std::fs::write(folder.join(frame_name(number)), frame(&snapshot).unwrap()).unwrap();
        kept.push(Kept { number, time: snapshot.time, step: snapshot.step });
    }
    let path = folder.join("particles.vtkhdf");
    std::fs::write(&path, master(&Shape::of(&sample(0)), &kept).unwrap()).unwrap();
    path
}

fn same(a: &Snapshot, b: &Snapshot) {
    assert_eq!((a.time, a.step, a.dimension, a.spacing), (b.time, b.step, b.dimension, b.spacing));
    assert_eq!(a.positions, b.positions);
    for (a, b) in a.columns.iter().zip(&b.columns) {
        assert_eq!((&a.name, &a.unit, a.components), (&b.name, &b.unit, b.components));
        assert_eq!(a.values, b.values);
    }
}

fn remove(master: &Path) {
    std::fs::remove_dir_all(master.parent().unwrap()).unwrap();
}

#[test]
fn steps_come_back_as_written() {
    let path = write("steps", 3);
    assert_eq!(read(&path).unwrap(), [0.0, 0.1, 0.2]);
    assert_eq!(kept(&path).unwrap()[2], Kept { number: 2, time: 0.2, step: 20 });
    for k in 0..3 {
        same(&read_step(&path, k).unwrap(), &sample(k as u64));
        same(&read_step(&beside(&path, k as u32), 0).unwrap(), &sample(k as u64));
    }
    assert!(read_step(&path, 3).unwrap_err().contains("3 steps"));
    assert_eq!(shape(&beside(&path, 1)).unwrap(), Shape::of(&sample(0)));
    remove(&path);
}

/// What another reader of HDF5 sees, which knows nothing of frames.
#[test]
fn the_master_has_the_rows_of_all_frames() {
    let path = write("virtual", 3);
    let file = open(&path).unwrap();
    for k in 0..3 {
        same(&snapshot_of(&file, k).unwrap(), &sample(k as u64));
    }
    remove(&path);
}

#[test]
fn the_same_particles_give_the_same_bytes() {
    assert!(frame(&sample(1)).unwrap() == frame(&sample(1)).unwrap());
    let kept = [Kept { number: 3, time: 0.5, step: 7 }];
    let master = || master(&Shape::of(&sample(0)), &kept).unwrap();
    let first = master();
    std::thread::sleep(std::time::Duration::from_millis(1100));
    assert!(first == master());
}

#[test]
fn a_missing_frame_and_a_flipped_bit_are_errors() {
    let path = write("damage", 2);
    let damaged = beside(&path, 1);
    let whole = std::fs::read(&damaged).unwrap();
    let (mut silent, every) = (0, whole.len() / 200);
    for place in (0..whole.len()).step_by(every) {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x10;
        std::fs::write(&damaged, &bytes).unwrap();
        // Names and times have no checksums: those of the run's manifest serve.
        let read = std::panic::catch_unwind(|| read_step(&damaged, 0));
        if let Ok(Ok(snapshot)) = read {
            silent += usize::from(
                snapshot.positions != sample(1).positions || snapshot.columns[3].values != sample(1).columns[3].values,
            );
        }
    }
    assert_eq!(silent, 0, "flipped bits gave other numbers");
    std::fs::remove_file(&damaged).unwrap();
    assert!(read_step(&path, 1).unwrap_err().contains("00001.vtkhdf: "));
    same(&read_step(&path, 0).unwrap(), &sample(0));
    remove(&path);
}

#[test]
fn columns_that_do_not_fit_are_refused() {
    let mut short = sample(1);
    short.columns[0].values.pop();
    assert!(frame(&short).unwrap_err().contains("density"));
    let mut empty = sample(1);
    empty.positions.clear();
    empty.columns.clear();
    assert!(frame(&empty).unwrap_err().contains("no particle"));
}
