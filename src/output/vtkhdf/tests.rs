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

fn write(name: &str, steps: u64) -> std::path::PathBuf {
    let path = std::env::temp_dir().join(format!("lithosph-{name}-{}.vtkhdf", std::process::id()));
    create(&path, &sample(0)).unwrap();
    (1..steps).for_each(|step| append(&path, &sample(step)).unwrap());
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

#[test]
fn steps_come_back_as_written() {
    let path = write("steps", 3);
    assert_eq!(read(&path).unwrap(), [0.0, 0.1, 0.2]);
    (0..3).for_each(|k| same(&read_step(&path, k).unwrap(), &sample(k as u64)));
    assert!(read_step(&path, 3).unwrap_err().contains("3 steps"));
    // LITHOSPH_KEEP leaves the file for tests/vtk_reads_output.py.
    if std::env::var_os("LITHOSPH_KEEP").is_none() {
        std::fs::remove_file(path).unwrap();
    }
}

#[test]
fn a_resumed_run_replaces_the_steps_after_its_checkpoint() {
    let path = write("resume", 4);
    truncate_after(&path, 0.1).unwrap();
    assert_eq!(read(&path).unwrap(), [0.0, 0.1]);
    append(&path, &sample(7)).unwrap();
    assert_eq!(read(&path).unwrap().len(), 3);
    same(&read_step(&path, 2).unwrap(), &sample(7));
    same(&read_step(&path, 1).unwrap(), &sample(1));
    std::fs::remove_file(path).unwrap();
}

#[test]
fn a_step_cut_short_by_a_kill_is_overwritten() {
    let path = write("kill", 2);
    let file = open(&path, true).unwrap();
    // What a kill just before the last line of append_step leaves.
    file.group("VTKHDF/Steps").unwrap().attr("NSteps").unwrap().write_scalar(&1i64).unwrap();
    file.close().unwrap();
    assert_eq!(read(&path).unwrap(), [0.0]);
    append(&path, &sample(5)).unwrap();
    same(&read_step(&path, 1).unwrap(), &sample(5));
    std::fs::remove_file(path).unwrap();
}

#[test]
fn other_particles_or_columns_are_refused() {
    let path = write("other", 1);
    let mut fewer = sample(1);
    fewer.columns.pop();
    assert!(append(&path, &fewer).unwrap_err().contains("columns"));
    let mut empty = sample(1);
    empty.positions.clear();
    assert!(append(&path, &empty).is_err());
    std::fs::remove_file(path).unwrap();
}
