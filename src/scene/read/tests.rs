use super::*;

const SCENE: &str = r#"title = "Two rings"
dimension = 2
spacing = 1
duration = 2

[[body]]
name = "left"
shape = { ring = { center = [0, 0], inner = 30, outer = 35 } }
material = "steel"
velocity = [1, 0]

[[body]]
name = "right"
shape.disc = { center = [80, 0], radius = 10 }
material = "steel"

[material.steel]
density = 1

[formulation]
smoothing = "gaussian"

[formulation.artificial_stress]
epsilon = 0.3

[[boundary]]
select = { body = "left" }
fixed = true

[[contact]]
between = ["left", "right"]
kernel = 0.5

[time]
integrator = "rk4"

[expect.energy]
norm = "max"

[variant.plain]
formulation.artificial_stress = "none"
formulation.viscosity = { alpha = 1, beta = "none" }

[variant.other]
spacing = 0.5

[[variant.other.body]]
name = "right"
shape.block = { min = [70, -10], max = [90, 10] }

[[variant.other.body]]
name = "third"
shape.disc = { center = [0, 0], radius = 5 }
material = "steel"
"#;

fn set(texts: &[&str]) -> Result<Read, String> {
    let texts: Vec<String> = texts.iter().map(|text| text.to_string()).collect();
    read_text(SCENE, "s.toml", None, &texts)
}

fn variant(name: &str) -> Read {
    read_text(SCENE, "s.toml", Some(name), &[]).unwrap()
}

/// The error after a change to the scene.
fn complaint(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from), "{from}");
    match read_text(&SCENE.replacen(from, to, 1), "s.toml", None, &[]) {
        Ok(_) => panic!("no error: {to}"),
        Err(error) => error,
    }
}

#[track_caller]
fn assert_complaints(cases: &[(&str, &str, &str)]) {
    for (from, to, expected) in cases {
        assert_eq!(complaint(from, to), format!("s.toml:{expected}"), "{to}");
    }
}

#[test]
fn text_that_is_no_toml_is_refused_at_its_line() {
    let quotes = "4: not valid TOML: after `=` comes one value, text in quotes";
    assert_complaints(&[
        ("duration = 2", "duration = ", quotes),
        ("duration = 2", "duration = two", quotes),
        ("duration = 2", "duration = 2 3", quotes),
        ("duration = 2", "duration = \"2", "4: not valid TOML: invalid basic string, expected `\"`"),
        ("duration = 2", "duration = 2\nduration = 3", "5: duplicate key `duration`"),
        ("[formulation]", "[formulation", "20: not valid TOML: unclosed table, expected `]`"),
    ]);
}

#[test]
fn unknown_keys_and_words_are_refused_with_the_nearest() {
    assert_complaints(&[
        ("duration = 2", "durration = 2", "4: unknown key `durration`, did you mean `duration`?"),
        ("smoothing =", "smothing =", "21: unknown key `smothing`, did you mean `smoothing`?"),
        ("outer", "outr", "8: unknown key `outr`, did you mean `outer`?"),
        (
            "norm =",
            "no =",
            "38: unknown key `no` in `expect.energy`, expected `kind`, `value`, `tolerance`, \
          `relative`, `scale`, `reference`, `columns`, `norm`, `seen`, `between`, `because`, `statistic`, `source` or `variant`",
        ),
        (
            "norm =",
            "dimension = 2 #",
            "38: unknown key `dimension` in `expect.energy`, it belongs at the top \
          of the scene, before all tables",
        ),
        ("gaussian", "gausian", "21: unknown word `gausian` for `formulation.smoothing`, did you mean `gaussian`?"),
        ("gaussian", "cubic", "21: unknown word `cubic` for `formulation.smoothing`, did you mean `cubic_spline`?"),
        ("rk4", "rk5", "35: unknown word `rk5` for `time.integrator`, expected `leapfrog`, `rk2`, `ssp_rk3`, `rk4` or `pefrl`"),
        ("{ ring", "{ rng", "8: unknown word `rng` for `body.0.shape`, did you mean `ring`?"),
        ("dimension = 2", "dimension = 2\nunits = \"si\"", "3: unknown word `si` for `units`, did you mean `SI`?"),
    ]);
}

#[test]
fn missing_keys_are_named() {
    assert_complaints(&[
        ("duration = 2", "", "1: missing key `duration` at the top of the scene"),
        (", outer = 35", "", "8: missing key `outer` in `body.0.shape.ring`"),
        ("shape.disc = { center = [80, 0], radius = 10 }", "", "12: missing key `shape` in `body.1`"),
        ("density = 1", "", "17: missing key `density` in `material.steel`"),
    ]);
}

#[test]
fn wrong_types_are_refused() {
    let motion = "10: `body.0.motion` must be a table such as `{ wave = { amplitude = [1], wave_vector = [2] } }`, \
                  found a string";
    let velocity = "28: `boundary.0.velocity` must be a list of numbers and \"free\", one for each axis";
    let fixed = "28: `boundary.0.fixed` must be true, false or a list of them, one for each axis";
    assert_complaints(&[
        ("title = \"Two rings\"", "title = 3", "1: `title` must be a string, found 3"),
        ("duration = 2", "duration = \"long\"", "4: `duration` must be a number, found a string"),
        ("duration = 2", "duration = 2024-01-01", "4: `duration` must be a number, found a date"),
        ("duration = 2", "duration = 1e999", "4: `duration` is too large a number"),
        ("dimension = 2", "dimension = 2.5", "2: `dimension` must be a whole number, 0 or more, found 2.5"),
        ("[1, 0]", "\"fast\"", "10: `body.0.velocity` must be a list of numbers, found a string"),
        ("[1, 0]", "[1, \"x\"]", "10: `body.0.velocity.1` must be a number, found a string"),
        ("velocity = [1, 0]", "motion = \"wave\"", motion),
        ("{ ring = {", "{ disc = 1, ring = {", "8: `body.0.shape` must have exactly one key, found `disc` and `ring`"),
        ("\"gaussian\"", "3", "21: `formulation.smoothing` must be a word, found 3"),
        ("fixed = true", "fixed = 3", &format!("{fixed}, found 3")),
        ("fixed = true", "fixed = [true, 3]", fixed),
        ("fixed = true", "velocity = [1, \"fre\"]", velocity),
        (
            "[\"left\", \"right\"]",
            "[\"left\"]",
            "31: `contact.0.between` must be a list of the names of 2 bodies, found a list of 1",
        ),
        ("[[contact]]", "[contact]", "30: `contact` must be a list of tables, each under `[[contact]]`, found a table"),
        ("norm = \"max\"", "columns = 1", "38: `expect.energy.columns` must be a list of strings, found 1"),
        ("[variant.plain]", "[[variant]]", "40: `variant` must be a table, found a list"),
    ]);
}

#[test]
fn what_serde_would_let_pass_is_refused() {
    let stress = "10: `body.0.deviatoric_stress` must be a list of 6 numbers, found a list of 7";
    assert_complaints(&[
        ("velocity = [1, 0]", "deviatoric_stress = [1, 2, 3, 4, 5, 6, 7]", stress),
        (
            "{ center = [0, 0], inner = 30, outer = 35 }",
            "[[0], 30, 35]",
            "8: `body.0.shape.ring` must be a table { center, inner, outer }, found a list",
        ),
        ("\"gaussian\"", "{ gaussian = {} }", "21: `formulation.smoothing` must be a word, found a table"),
        ("smoothing = \"gaussian\"", "viscosity = 2024-01-01", "21: `formulation.viscosity` must be a table, found a date"),
        ("[time]", "[[time]]", "35: `time` must be a table, found a list"),
    ]);
}

#[test]
fn bad_overrides_are_refused() {
    let cases = [
        ("velocity", "velocity: must be `path=value`, found no `=`"),
        ("a..b=3", "a..b: must be a path of keys such as `formulation.xsph`"),
        ("spacing=", "spacing: has no value after the `=`"),
        ("spacing=wide", "spacing: `spacing` must be a number, found a string"),
        ("spacing=[1", "spacing: not a TOML value: unclosed array, expected `]`"),
        ("spacing.x=3", "spacing.x: unknown path, `spacing` is 1 and has no `x`"),
        ("sapcing=3", "sapcing: unknown key `sapcing`, did you mean `spacing`?"),
        ("formulation.xspj=1", "formulation.xspj: unknown key `xspj`, did you mean `xsph`?"),
        ("formulation.viscosity.beta=1", "formulation.viscosity.beta: missing key `alpha` in `formulation.viscosity`"),
        ("formulation.xshp=none", "formulation.xshp: unknown key `xshp`, did you mean `xsph`?"),
        ("body.lft.velocity=[1]", "body.lft.velocity: `body` has no element `lft`, did you mean `left`?"),
        ("body.7.velocity=[1]", "body.7.velocity: `body` has no element `7`, there are 2, counted from 0"),
        ("body.0.velocity.x=1", "body.0.velocity.x: `body.0.velocity` is a list, its elements go by index, not `x`"),
        ("material.stel.density=3", "material.stel.density: there is no `material.stel`, did you mean `steel`?"),
        ("material.stel=none", "material.stel: there is no `material.stel` to remove, did you mean `steel`?"),
        ("variant.plain.spacing=3", "variant.plain.spacing: variants are chosen, not set"),
    ];
    for (text, expected) in cases {
        assert_eq!(set(&["duration=3", text]).err().unwrap_or_default(), format!("--set {expected}"));
    }
}

#[test]
fn overrides_reach_tables_lists_and_words() {
    let texts = [
        "formulation.viscosity.alpha=0.5",
        "formulation.viscosity.beta = 2",
        "body.left.velocity=[3,4]",
        "body.1.velocity=[5]",
        "body.left.velocity.1=6",
        "formulation.smoothing=cubic_spline",
        "title=Three rings",
        "formulation.artificial_stress=none",
    ];
    let read = set(&texts).unwrap();
    let viscosity = read.file.formulation.viscosity.unwrap();
    assert_eq!((viscosity.alpha, viscosity.beta), (0.5, Some(2.0)));
    assert_eq!(read.file.body[0].velocity, Some([3.0, 6.0].into()));
    assert_eq!(read.file.body[1].velocity, Some([5.0].into()));
    assert_eq!(read.file.formulation.smoothing.word(), "cubic_spline");
    assert_eq!(read.file.title, "Three rings");
    assert!(read.file.formulation.artificial_stress.is_none());
    assert_eq!(read.source.place(&["body", "right", "velocity"]), "--set body.1.velocity");
}

#[test]
fn a_variant_merges_lists_by_name_and_replaces_shapes() {
    let read = variant("other");
    let names: Vec<_> = read.file.body.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["left", "right", "third"]);
    assert!(matches!(read.file.body[1].shape, super::super::shape::Shape::Block { .. }));
    assert_eq!(read.file.body[1].material, "steel");
    assert_eq!(read.file.spacing, 0.5);
    assert_eq!(read.source.place(&["spacing"]), "s.toml:45");
    assert_eq!(read.check_variants(), Ok(()));
}

#[test]
fn none_removes_a_key() {
    let read = variant("plain");
    assert!(read.file.formulation.artificial_stress.is_none());
    assert_eq!(read.file.formulation.viscosity.unwrap().beta, None);
    assert_eq!(read.file.formulation.smoothing.word(), "gaussian");
}

#[test]
fn bad_variants_are_refused() {
    let choose = |name| read_text(SCENE, "s.toml", Some(name), &[]).err().unwrap_or_default();
    assert_eq!(choose("plan"), "s.toml: unknown variant `plan`, did you mean `plain`?");
    assert_eq!(choose("zebra"), "s.toml: unknown variant `zebra`, expected `other` or `plain`");
    let check = |from: &str, to: &str| {
        assert!(SCENE.contains(from));
        read_text(&SCENE.replacen(from, to, 1), "s.toml", None, &[]).unwrap().check_variants().unwrap_err()
    };
    let misspelt = "s.toml:41: unknown key `artificial_stres`, did you mean `artificial_stress`?";
    assert_eq!(check("artificial_stress = \"none", "artificial_stres = \"none"), misspelt);
    assert_eq!(check("spacing = 0.5", "spcing = 0.5"), "s.toml:45: unknown key `spcing`, did you mean `spacing`?");
    let nested = "s.toml:45: a variant cannot hold variants";
    assert_eq!(check("spacing = 0.5", "variant.x.spacing = 1"), nested);
    let expect = "s.toml:38: unknown variant `plan` in `expect.energy`, did you mean `plain`?";
    assert_eq!(check("norm = \"max\"", "variant = \"plan\""), expect);
}

#[test]
fn the_resolved_text_reads_back() {
    for name in [None, Some("plain"), Some("other")] {
        let mut read = read_text(SCENE, "s.toml", name, &["body.left.spin=1e-300".to_string()]).unwrap();
        let again = read_text(&read.resolved_text, "run.toml", None, &[]).unwrap();
        read.file.variant.clear();
        assert_eq!(format!("{:?}", again.file), format!("{:?}", read.file));
    }
}

#[test]
fn a_path_has_the_line_of_its_key() {
    let source = set(&[]).unwrap().source;
    assert_eq!(source.place(&[]), "s.toml:1");
    assert_eq!(source.place(&["body"]), "s.toml:6");
    assert_eq!(source.place(&["body", "1"]), "s.toml:12");
    assert_eq!(source.place(&["body", "right", "shape", "disc", "radius"]), "s.toml:14");
    assert_eq!(source.place(&["body", "1", "velocity"]), "s.toml:12");
    assert_eq!(source.place(&["contact", "0", "kernel"]), "s.toml:32");
}

#[test]
fn files_are_read_and_what_is_none_is_refused() {
    let folder = std::env::temp_dir().join(format!("lithosph-read-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("scene.toml");
    let shown = path.display();
    assert_eq!(read(&path, None, &[]).err(), Some(format!("{shown}: no such file")));
    std::fs::write(&path, b"title = 1\n\xff").unwrap();
    assert_eq!(read(&path, None, &[]).err(), Some(format!("{shown}:2: not UTF-8 text")));
    std::fs::write(&path, SCENE).unwrap();
    assert_eq!(variants(&path).unwrap(), ["plain", "other"]);
    assert_eq!(read(&folder, None, &[]).err(), Some(format!("{}: a folder, not a scene file", folder.display())));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_nearest_word_is_near() {
    let words = ["smoothing", "smoothing_length", "rk2", "rk4", "x"];
    assert_eq!(nearest("smothing", words), Some("smoothing"));
    assert_eq!(nearest("smoothing-lenght", words), Some("smoothing_length"));
    assert_eq!(nearest("LENGTH", words), Some("smoothing_length"));
    assert_eq!(nearest("rk3", words), None);
    assert_eq!(nearest("y", words), None);
    assert_eq!(nearest("", words), None);
}
