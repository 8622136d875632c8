use super::*;

/// A load for each depth, once down and once up, in rows of equal time from 0 to 2; unloading ends at depth `end`.
fn table(largest: f64, end: f64, rows: usize, load: impl Fn(f64) -> f64, unload: impl Fn(f64) -> f64) -> Table {
    let share = |k: usize| k as f64 / rows as f64;
    let down = (0..=rows).map(|k| largest * share(k)).map(|h| (h, load(h)));
    let up = (1..=rows).map(|k| largest + (end - largest) * share(k)).map(|h| (h, unload(h)));
    let (depth, force): (Vec<f64>, Vec<f64>) = down.chain(up).unzip();
    let times = (0..depth.len()).map(share).collect();
    Table { times, columns: [("depth".to_string(), depth), ("load".to_string(), force)].into() }
}

fn typed() -> Observe {
    Observe { of: Some("load".into()), over: Some("depth".into()), ..Observe::default() }
}

fn number(kind: &ObservableKind, table: &Table, typed: &Observe) -> Result<f64, String> {
    let Value::Result(of) = kind.value else { panic!("a result") };
    of(table, typed)
}

fn assert_close(kind: &ObservableKind, table: &Table, typed: &Observe, expected: f64, tolerance: f64) {
    let found = number(kind, table, typed).unwrap();
    assert!((found / expected - 1.0).abs() < tolerance, "{}: {found} {expected}", kind.word);
}

#[test]
fn an_elastic_ball_shows_hertz_s_numbers() {
    let (modulus, radius, depth) = (70e9, 0.01, 2e-4);
    let hertz = |h: f64| 4.0 / 3.0 * modulus * f64::sqrt(radius) * h.powf(1.5);
    let (table, typed) = (table(depth, 0.0, 100, hertz, hertz), Observe { radius: Some(radius), ..typed() });
    let stiffness = 2.0 * modulus * f64::sqrt(radius * depth);
    assert_close(&UNLOADING_STIFFNESS, &table, &typed, stiffness, 1e-9);
    assert_close(&CONTACT_DEPTH, &table, &typed, depth / 2.0, 1e-9);
    let area = PI * (radius * depth - depth * depth / 4.0);
    assert_close(&HARDNESS, &table, &typed, hertz(depth) / area, 1e-9);
    // Hertz's paraboloid has pi R h.
    let paraboloid = (area / (PI * radius * depth)).sqrt();
    assert_close(&REDUCED_MODULUS, &table, &typed, modulus / paraboloid, 1e-9);
    let beta = Observe { beta: Some(1.034), ..typed };
    assert_close(&REDUCED_MODULUS, &table, &beta, modulus / paraboloid / 1.034, 1e-9);
}

#[test]
fn an_elastic_cone_shows_sneddon_s_numbers_in_any_direction() {
    let (modulus, tangent, depth) = (3.0, 70.3_f64.to_radians().tan(), 0.5);
    let sneddon = |h: f64| 2.0 / PI * modulus * tangent * h * h;
    let mut table = table(depth, 0.0, 80, sneddon, sneddon);
    // The surface of the cone's own contact sinks by 2 (pi - 2)/pi of load over stiffness.
    let typed = Observe { section: Some(PI * tangent * tangent), level: Some(2.0 * (PI - 2.0) / PI), ..typed() };
    for name in ["depth", "load", "depth"] {
        assert_close(&UNLOADING_STIFFNESS, &table, &typed, 4.0 / PI * modulus * tangent * depth, 1e-9);
        assert_close(&CONTACT_DEPTH, &table, &typed, 2.0 / PI * depth, 1e-9);
        assert_close(&REDUCED_MODULUS, &table, &typed, modulus, 1e-9);
        assert_close(&HARDNESS, &table, &typed, modulus / (2.0 * tangent), 1e-9);
        table.columns.get_mut(name).unwrap().iter_mut().for_each(|value| *value = -*value);
    }
}

#[test]
fn a_plastic_imprint_is_found_whatever_part_of_unloading_is_fitted() {
    let (depth, left, exponent) = (2.0, 1.6, 1.3);
    let load = |h: f64| 5.0 * h * h;
    let factor = load(depth) / f64::powf(depth - left, exponent);
    let unload = |h: f64| factor * (h - left).max(0.0).powf(exponent);
    let rows = table(depth, left, 2000, load, unload);
    let slope = exponent * load(depth) / (depth - left);
    for shares in [None, Some([0.2, 0.9]), Some([1.0, 0.6])] {
        assert_close(&UNLOADING_STIFFNESS, &rows, &Observe { shares, ..typed() }, slope, 1e-9);
    }
    let work = |between| Observe { between, ..typed() };
    let (paid, returned) = (5.0 * depth.powi(3) / 3.0, load(depth) * (depth - left) / (exponent + 1.0));
    assert_close(&WORK, &rows, &work(Some([0.0, 1.0])), paid, 1e-6);
    assert_close(&WORK, &rows, &work(Some([1.0, 2.0])), -returned, 1e-6);
    assert_close(&WORK, &rows, &work(None), paid - returned, 1e-6);
    // A gap before the first touch.
    let mut late = rows.clone();
    late.columns.get_mut("depth").unwrap().iter_mut().for_each(|h| *h += 0.7);
    let expected = depth - 0.75 * load(depth) / slope;
    assert_close(&CONTACT_DEPTH, &late, &Observe { distance: Some(0.7), ..typed() }, expected, 1e-9);
}

#[test]
fn noise_of_a_thousandth_leaves_the_slope_of_unloading() {
    let (depth, left) = (2.0, 1.6);
    let unload = |h: f64| 100.0 * f64::powf(f64::max(h - left, 0.0), 1.4) * (1.0 + 1e-3 * (1e5 * h).sin());
    let rows = table(depth, left, 400, |h| unload(depth) * h / depth, unload);
    assert_close(&UNLOADING_STIFFNESS, &rows, &typed(), 140.0 * f64::powf(0.4, 0.4), 0.01);
}

#[test]
fn a_series_is_read_where_another_first_reaches_a_level() {
    let rows = table(2.0, 0.0, 7, |h| 3.0 * h, |h| h);
    let at = |level| number(&VALUE_AT, &rows, &Observe { level: Some(level), ..typed() });
    assert!((at(1.1).unwrap() - 3.3).abs() < 1e-12);
    assert_eq!((at(0.0).unwrap(), at(2.0).unwrap()), (0.0, 6.0));
    assert!(at(2.1).unwrap_err().contains("never reaches"));
    let from_above = Observe { level: Some(1.0), between: Some([1.0, 2.0]), ..typed() };
    let (before, after) = (8.0 / 7.0, 6.0 / 7.0);
    let between = (before + after) / 2.0;
    assert!((number(&VALUE_AT, &rows, &from_above).unwrap() - between).abs() < 1e-12);
}

#[test]
fn what_was_never_unloaded_is_refused() {
    let rows = table(2.0, 0.0, 50, |h| h * h, |h| h * h);
    let loading = Observe { between: Some([0.0, 1.0]), ..typed() };
    assert!(number(&UNLOADING_STIFFNESS, &rows, &loading).unwrap_err().contains("at least four rows"));
    let shallow = Observe { level: Some(3.0), section: Some(24.5), ..typed() };
    assert!(number(&HARDNESS, &rows, &shallow).unwrap_err().contains("no area"));
}
