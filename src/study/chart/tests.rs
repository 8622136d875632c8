use super::*;

fn chart() -> Chart {
    let series = |name: &str, style, colour, scale: f64| Series {
        name: name.into(),
        style,
        colour,
        points: (1..=12).map(|k| [10f64.powf(0.3 * f64::from(k)), scale * 10f64.powf(-0.25 * f64::from(k))]).collect(),
        labels: Vec::new(),
    };
    let mut front = series("Pareto front", Style::LinePoints, 1, 0.5);
    front.labels = (1..=12).map(|k| if k % 3 == 0 { format!("leapfrog, h 1.{k}") } else { String::new() }).collect();
    Chart {
        title: "Error against cost & more <than> a title may say in one line of a picture".into(),
        note: "A note in small print, long enough to need two lines where letters are as wide as these here are.".into(),
        x: Axis::log("particle-updates"),
        y: Axis::log("error (1)"),
        series: vec![series("all runs", Style::Points, 0, 1.0), front, series("theory", Style::Dashed, 2, 2.0)],
    }
}

fn map() -> Map {
    let row = |y: usize| (0..40).map(|x| if x == 3 { f64::NAN } else { (x as f64 * 0.1).sin() * y as f64 }).collect();
    Map {
        title: "Growth rate".into(),
        note: String::new(),
        x: Axis::linear("kx dx/pi").within([0.0, 1.0]),
        y: Axis::linear("ky dx/pi").within([0.0, 1.0]),
        values: (0..30).map(row).collect(),
        unit: "rate dx/c".into(),
    }
}

#[test]
fn both_files_show_the_marks_in_their_size() {
    let stem = std::env::temp_dir().join(format!("lithosph-chart-{}/v1.5-chart", std::process::id()));
    Picture::Row(vec![Picture::Chart(chart()), Picture::Map(map())]).write(&stem).unwrap();
    let file = |end: &str| stem.with_file_name(format!("v1.5-chart.{end}"));
    let svg = std::fs::read_to_string(file("svg")).unwrap();
    assert!(svg.contains("<svg width=\"920\" height=\"370\" viewBox=\"0 0 3680 1480\""), "{}", &svg[..200]);
    assert!(svg.contains("Pareto front") && svg.contains("&lt;than&gt;"));
    let image = image::open(file("png")).unwrap().to_rgba8();
    assert_eq!(image.dimensions(), (1840, 740));
    // The colour of the first series and of the map's largest value are there, and text.
    let holds = |colour: [u8; 3]| image.pixels().any(|pixel| pixel.0[..3] == colour);
    assert!(holds(canvas::palette(0)) && holds(canvas::palette(1)) && holds([255; 3]));
    assert!(image.pixels().any(|pixel| pixel.0[..3].iter().all(|&channel| channel < 60)));
    std::fs::remove_dir_all(stem.parent().unwrap()).unwrap();
}

#[test]
fn points_lie_where_the_axes_say() {
    let shown = [1.0, 1000.0];
    let log = scale::Scale::new(&Axis::log("x").within(shown), std::iter::empty());
    let part = |value| log.part(value).unwrap();
    assert!((part(10.0) - 1.0 / 3.0).abs() < 1e-12 && part(-1.0) == 0.0);
    assert_eq!((log.part(1001.0), log.part(f64::NAN)), (None, None));
    let written = |scale: &scale::Scale| scale.ticks.iter().filter(|tick| !tick.1.is_empty()).cloned().collect::<Vec<_>>();
    let labels: Vec<String> = written(&log).into_iter().map(|tick| tick.1).collect();
    assert_eq!(labels, ["1", "10", "100", "1000"]);
    let small = scale::Scale::new(&Axis::log("x").within([1e-9, 1e-5]), std::iter::empty());
    assert_eq!(written(&small)[0], (1e-9, "10⁻⁹".to_string()));
    let linear = scale::Scale::new(&Axis::linear("x"), [0.0, 10.0].into_iter());
    assert!(linear.part(0.0).unwrap() > 0.0 && linear.part(10.0).unwrap() < 1.0);
}

#[test]
fn names_keep_off_one_another() {
    let mut crowd = labels::Labels::new([0.0, 0.0, 400.0, 300.0]);
    let names: Vec<String> = (0..6).map(|k| format!("a setting {k}")).collect();
    for (k, name) in names.iter().enumerate() {
        crowd.add([200.0 + 4.0 * k as f64, 150.0], name, k, true);
    }
    let mut canvas = Canvas::new([400.0, 300.0]);
    crowd.draw(&mut canvas);
    let boxes = canvas.texts();
    assert_eq!(boxes.len(), names.len());
    for (k, a) in boxes.iter().enumerate() {
        assert!(a[0] >= 0.0 && a[2] <= 400.0, "{a:?}");
        let meets = |b: &[f64; 4]| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
        assert!(!boxes[k + 1..].iter().any(meets), "{boxes:?}");
    }
}

#[test]
fn maps_that_are_none_are_refused() {
    let refused = |map: Map| Picture::Map(map).svg().unwrap_err();
    assert!(refused(Map { values: vec![vec![1.0], vec![]], ..map() }).contains("rows of one length"));
    assert!(refused(Map { x: Axis::linear("x"), ..map() }).contains("ranges"));
}

#[test]
fn a_page_holds_all_that_it_shows() {
    let table = Table { columns: vec!["name".into(), "x".into()], rows: vec![vec!["a<b".into(), "1.5e-3".into()]] };
    let section = Section {
        heading: "Charts".into(),
        text: vec!["Some words.".into()],
        pictures: vec![Picture::Row(vec![Picture::Chart(chart()), Picture::Map(map())])],
        images: vec![("particles".into(), image::RgbaImage::new(2, 2))],
        table: Some(table),
    };
    let html = Page { title: "A study".into(), lead: "What it is.".into(), sections: vec![section] }.html().unwrap();
    assert_eq!(html.matches("<svg ").count(), 2);
    assert!(html.contains("src=\"data:image/png;base64,iVBORw0KGgo"));
    assert!(html.contains("<td>a&lt;b</td><td class=\"number\">1.5e-3</td>"));
    // Nothing is fetched: the only addresses are names of formats.
    let elsewhere = html.matches("http").count() - html.matches("http://www.w3.org/").count();
    assert_eq!(elsewhere, 0);
    assert!(!html.contains("<script"));
}
