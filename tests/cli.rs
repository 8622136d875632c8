//! The command line from outside: exit codes, what is said, and what is left on the disk.

use crate::common::sandbox::{SCENE, Said, Sandbox, said, signal, until};
use lithosph::output::csv;

/// Exactly one line, with the program's name before it.
#[track_caller]
fn one_line(text: &str, what: &str) {
    assert!(text.starts_with("lithosph: "), "{what}: {text}");
    assert!(text.ends_with('\n') && text.lines().count() == 1, "{what}: more than one line: {text}");
}

/// Bad input: code 2, one line that holds all these words, no folder.
#[track_caller]
fn refused(sandbox: &Sandbox, said: &Said, words: &[&str]) {
    let what = format!("{words:?}");
    assert_eq!(said.code, Some(2), "{what}: {said:?}");
    one_line(&said.err, &what);
    for word in words {
        assert!(said.err.contains(word), "{what}: {}", said.err);
    }
    assert!(!sandbox.exists("out"), "{what}: an output folder was made");
}

/// A change to the scene, the text on whose line the fault lies, and words of the complaint.
type Bad<'a> = (&'a str, &'a str, &'a str, &'a [&'a str]);

#[track_caller]
fn bad_scenes(name: &str, cases: &[Bad]) {
    let sandbox = Sandbox::new(name);
    for (from, to, at, words) in cases {
        assert!(SCENE.contains(from), "{from}");
        let text = SCENE.replacen(from, to, 1);
        let line = 1 + text[..text.find(at).unwrap()].matches('\n').count();
        sandbox.write("s.toml", &text);
        let place = format!("s.toml:{line}: ");
        let said = sandbox.lithosph(&["run", "s.toml", "--backend", "cpu"]);
        refused(&sandbox, &said, &[&[place.as_str()], *words].concat());
    }
}

const LEFT: &str = "velocity = [-0.01, 0]";
const BLOCK: &str = "{ block = { min = [0, 0], max = [6, 6] } }";
const MODULI: &str = "youngs_modulus = 1\npoisson_ratio = 0.3";
const VISCOSITY: &str = "viscosity = { alpha = 1 }";
const END: &str = "[variant.slow]";

#[test]
fn wrong_words_and_types_are_refused_at_their_line() {
    bad_scenes(
        "words",
        &[
            ("duration = 4", "duration = ", "duration", &["not valid TOML"]),
            ("[formulation]", "[formulation", "[formulation", &["not valid TOML", "`]`"]),
            ("duration = 4", "durration = 4", "durration", &["unknown key `durration`", "did you mean `duration`?"]),
            (VISCOSITY, "viscosty = { alpha = 1 }", "viscosty", &["unknown key `viscosty`", "did you mean `viscosity`?"]),
            (VISCOSITY, "smoothing = \"gausian\"", "gausian", &["unknown word `gausian`", "did you mean `gaussian`?"]),
            ("{ block", "{ blok", "{ blok", &["unknown word `blok`", "did you mean `block`?"]),
            ("dimension = 2", "dimension = 2.5", "dimension", &["`dimension` must be a whole number"]),
            ("spacing = 1", "spacing = \"fine\"", "spacing", &["`spacing` must be a number, found a string"]),
            ("density = 1\n", "", "[material", &["missing key `density` in `material.rubber`"]),
            ("material = \"rubber\"\nvelocity", "material = \"ruber\"\nvelocity", "ruber", &["did you mean `rubber`?"]),
            ("name = \"right\"", "name = \"left\"", "name = \"left\"\nshape = { block = { min = [7", &["two bodies", "`left`"]),
        ],
    );
}

#[test]
fn numbers_out_of_range_are_refused_at_their_line() {
    bad_scenes(
        "numbers",
        &[
            ("dimension = 2", "dimension = 4", "dimension", &["dimension must be 1, 2 or 3, found 4"]),
            ("spacing = 1", "spacing = -1", "spacing", &["spacing must be a positive number, found -1"]),
            (LEFT, "spacing = -1", "spacing = -1", &["spacing must be a positive number, found -1"]),
            ("duration = 4", "duration = 0", "duration", &["duration must be a positive number, found 0"]),
            ("series = 1", "series = 1e-9", "series", &["more than 1e6 times"]),
            ("width = 320", "width = 3", "width", &["160 x 120"]),
            (VISCOSITY, "viscosity = { alpha = -1 }", "viscosity", &["negative"]),
            (VISCOSITY, "list_capacity = 0", "list_capacity", &["list_capacity must not be 0"]),
            (VISCOSITY, "xsph = 0.5\nvelocity_filter = 0.5", "velocity_filter", &["xsph and velocity_filter", "one of them"]),
            (VISCOSITY, "dissipated_energy = true", "dissipated_energy", &["names no viscosity"]),
            (LEFT, "velocity = [nan, 0]", "[[body]]", &["velocity", "finite"]),
            (LEFT, "deviatoric_stress = [1, 0, 0, 0, 0, 0]", "deviatoric", &["sum to zero"]),
        ],
    );
}

#[test]
fn impossible_shapes_and_materials_are_refused_at_their_line() {
    let block = format!("shape = {BLOCK}");
    bad_scenes(
        "shapes",
        &[
            (&block, "shape = { block = { min = [6, 0], max = [0, 6] } }", "[6, 0]", &["min < max"]),
            (&block, "shape = { block = { min = [0, 0], max = [0.2, 0.2] } }", "0.2", &["`left`", "no particle lies inside"]),
            (&block, "shape = { ring = { center = [0, 0], inner = 6, outer = 5 } }", "ring", &["inner must be below outer"]),
            (&block, "shape = { sphere = { center = [0, 0], radius = 3 } }", "sphere", &["3D scene", "use a disc"]),
            ("dimension = 2", "dimension = 3", "shape = { block", &["`left`", "on z min is 0 and max is 0"]),
            ("poisson_ratio = 0.3", "poisson_ratio = 0.5", "[material", &["`rubber`", "between -1 and 0.5, found 0.5"]),
            (MODULI, "youngs_modulus = 1\nbulk_modulus = 1", "[material", &["youngs_modulus with poisson_ratio, or"]),
            (
                MODULI,
                "youngs_modulus = 1\npoisson_ratio = 0\nbulk_modulus = 1\nshear_modulus = 1",
                "[material",
                &["nothing beside"],
            ),
            (MODULI, "law = \"fluid\"\nbulk_modulus = 1\nshear_modulus = 1", "[material", &["is a fluid", "no other modulus"]),
        ],
    );
    let sandbox = Sandbox::new("disc-in-3d");
    let text = SCENE.replace("dimension = 2", "dimension = 3").replace(BLOCK, "{ disc = { center = [0, 0], radius = 3 } }");
    sandbox.write("s.toml", &text);
    refused(&sandbox, &sandbox.lithosph(&["run", "s.toml"]), &["s.toml:9: ", "a disc needs a 2D scene: in 3D use a sphere"]);
}

#[test]
fn impossible_boundaries_contacts_and_boxes_are_refused_at_their_line() {
    let with = |text: &str| format!("{text}\n\n{END}");
    let body = with("[[boundary]]\nselect = { body = \"lft\" }\nfixed = true");
    let none =
        with("[[boundary]]\nname = \"wall\"\nselect = { inside = { disc = { center = [90, 0], radius = 1 } } }\nfixed = true");
    let both = with("[[boundary]]\nselect = { body = \"left\" }\nfixed = true\nvelocity = [0, 0]");
    let twice = with("[[boundary]]\nselect = { body = \"left\" }\nfixed = true\n\n[[boundary]]\nselect = {}\nfixed = true # 2");
    let course = with("[[boundary]]\nselect = { body = \"left\" }\nvelocity = [1, 0]\ncourse = [[0, 1], [2, 0], [1, 3]]");
    let contact = with("[[contact]]\nbetween = [\"left\", \"rihgt\"]\nkernel = 0");
    let weight = with("[[contact]]\nbetween = [\"left\", \"right\"]\nkernel = 2");
    let own = with("[[contact]]\nbetween = [\"left\", \"left\"]\nkernel = 0");
    let plane = "[[symmetry]]\npoint = [0, 0]\nnormal = ";
    let oblique = with(&format!("{plane}[1, 0]\n{plane}[1, 1]"));
    let mixed = format!("duration = 4\nperiodic = [40, 40]\n{plane}[1, 0]\n");
    bad_scenes(
        "boundaries",
        &[
            (END, &body, "[[boundary]]", &["no body named `lft`", "did you mean `left`?"]),
            (END, &none, "[[boundary]]", &["`wall` selects no particle"]),
            (END, &both, "[[boundary]]", &["not both"]),
            (END, &twice, "[[boundary]]\nselect = {}", &["both hold the particle"]),
            (END, &course, "[[boundary]]", &["must increase"]),
            (END, &contact, "between = [\"left\"", &["no body is named `rihgt`", "did you mean `right`?"]),
            (END, &weight, "kernel = 2", &["kernel must lie between 0", "found 2"]),
            (END, &own, "between = [\"left\"", &["itself"]),
            (END, &oblique, "[[symmetry]]\npoint = [0, 0]\nnormal = [1, 1]", &["right angles"]),
            ("duration = 4", "duration = 4\nperiodic = [20, 5]", "periodic", &["longer than three reaches", "found 5"]),
            ("duration = 4", "duration = 4\nperiodic = [20]", "periodic", &["2 lengths"]),
            ("duration = 4\n", &mixed, "periodic", &["not both"]),
        ],
    );
}

#[test]
fn impossible_observables_and_expectations_are_refused_at_their_line() {
    let observe = |text: &str| format!("[observe.new]\n{text}\n\n{END}");
    let expect = |text: &str| format!("[expect.kinetic]\n{text}\n\n{END}");
    let indent = |kind: &str, keys: &str| observe(&format!("kind = \"{kind}\"\nof = \"kinetic\"\nover = \"kinetic\"\n{keys}"));
    let misnamed = format!("[expect.kinetc]\nvalue = 1\ntolerance = 1\nsource = \"x\"\n\n{END}");
    let comma = format!("[observe.\"a,b\"]\nkind = \"kinetic_energy\"\n\n{END}");
    bad_scenes(
        "observables",
        &[
            (END, &observe("kind = \"kinetic_enrgy\""), "[observe.new]", &["kinetic_enrgy", "did you mean `kinetic_energy`?"]),
            (END, &observe("kind = \"zebra\""), "[observe.new]", &["unknown kind `zebra`", "lithosph list"]),
            (END, &observe("kind = \"mean\""), "[observe.new]", &["is a mean", "needs the key `field`"]),
            (END, &observe("kind = \"mean\"\nfield = \"presure\""), "[observe.new]", &["`presure`", "did you mean `pressure`?"]),
            (END, &observe("kind = \"mean\"\nfield = \"stress.yq\""), "[observe.new]", &["stress.yq"]),
            (END, &observe("kind = \"mean\"\nfield = \"internal_energy\""), "[observe.new]", &["no field internal_energy"]),
            (END, &observe("kind = \"momentum\"\naxis = \"w\""), "[observe.new]", &["axis `w`", "x, y, z"]),
            (END, &observe("kind = \"kinetic_energy\"\nbody = \"lef\""), "[observe.new]", &["no body", "did you mean `left`?"]),
            (END, &observe("kind = \"rms\"\nof = \"kinetik\""), "[observe.new]", &["`kinetik`", "did you mean `kinetic`?"]),
            (END, &indent("value_at", ""), "[observe.new]", &["is a value_at", "needs the key `level`"]),
            (END, &indent("hardness", ""), "[observe.new]", &["is a hardness", "needs the key `radius` or `section`"]),
            (END, &indent("hardness", "radius = 1\nsection = 24.5"), "[observe.new]", &["`radius` or `section`, not both"]),
            (END, &indent("hardness", "radius = -1"), "[observe.new]", &["radius -1", "above 0"]),
            (END, &indent("contact_depth", "shares = [0.5, 5]"), "[observe.new]", &["shares 0.5 and 5", "from 0 to 1"]),
            (END, &comma, "[observe.\"a,b\"]", &["`a,b`", "letters"]),
            (END, &misnamed, "[expect.kinetc]", &["names no observable", "did you mean `kinetic`?"]),
            (END, &expect("value = 1\ntolerance = 1"), "[expect", &["needs a source"]),
            (END, &expect("value = 1\nsource = \"x\""), "[expect", &["needs a tolerance"]),
            (END, &expect("kind = \"failure\"\nvalue = 1\nseen = 2\ntolerance = 0.1\nsource = \"x\""), "[expect", &["`because`"]),
            (END, &expect("kind = \"shortfall\"\nseen = 2\ntolerance = 1\nsource = \"x\""), "[expect", &["needs the truth"]),
            (END, &expect("kind = \"pinned\"\nvalue = 2\ntolerance = 1\nsource = \"x\""), "[expect", &["no truth is at hand"]),
            (
                END,
                &expect(
                    "kind = \"failure\"\nvalue = 0\nseen = 2\ntolerance = 0.1\nrelative = true\nbecause = \"x\"\nsource = \"x\"",
                ),
                "[expect",
                &["it needs a scale"],
            ),
            (END, &expect("value = 1\nseen = 2\ntolerance = 1\nsource = \"x\""), "[expect", &["needs `kind`"]),
            (END, &expect("between = [0, 1]\ntolerance = 1\nsource = \"x\""), "[expect", &["not both"]),
            (END, &expect("value = 1\ntolerance = 1\nscale = \"mean\"\nsource = \"x\""), "[expect", &["has no curve"]),
            (END, &expect("value = 1\ntolerance = 1\nscale = \"best\"\nsource = \"x\""), "scale", &["\"peak\" or \"mean\""]),
            (END, &expect("source = \"x\"\ntolerance = 1"), "[expect", &["exactly one of"]),
            (END, &expect("value = 1\ntolerance = 1\nsource = \"x\"\nvariant = \"slw\""), "[expect", &["did you mean `slow`?"]),
            ("field = \"pressure\"", "field = \"presure\"", "presure", &["picture", "did you mean `pressure`?"]),
            ("series = 1", "fields = [\"strain\"]", "strain", &["unknown field `strain`"]),
        ],
    );
}

#[test]
fn bad_arguments_are_refused_and_leave_no_folder() {
    let sandbox = Sandbox::new("arguments");
    let refuse = |arguments: &[&str], words: &[&str]| refused(&sandbox, &sandbox.lithosph(arguments), words);
    refuse(&["run", "no.toml"], &["no.toml: no such file"]);
    refuse(&["run", "."], &["a folder, not a scene"]);
    refuse(&["check", "no.toml"], &["no.toml: no such file"]);
    refuse(&["list", "no.toml"], &["no.toml: no such file"]);
    refuse(&["run", "s.toml", "--variant", "slwo"], &["unknown variant `slwo`, did you mean `slow`?"]);
    refuse(&["run", "s.toml", "--set", "spacing"], &["--set spacing: must be `path=value`"]);
    refuse(&["run", "s.toml", "--set", "sapcing=1"], &["--set sapcing: unknown key", "did you mean `spacing`?"]);
    refuse(&["run", "s.toml", "--set", "spacing=wide"], &["--set spacing: `spacing` must be a number"]);
    refuse(&["run", "s.toml", "--set", "dimension=7"], &["--set dimension: dimension must be 1, 2 or 3"]);
    refuse(&["run", "s.toml", "--adapter", "Voodoo"], &["no adapter is named Voodoo"]);
    refuse(&["run", "s.toml", "--adapter", "x", "--backend", "cpu"], &["--adapter", "--backend cpu"]);
    refuse(&["run", "--resume", "no"], &["no/run.toml: no such file"]);
    refuse(&["run", "s.toml", "--backend", "cpu", "--out", "s.toml/x"], &["cannot write s.toml/x"]);
    for wrong in [&["run"][..], &["fly"], &["run", "s.toml", "--fats"], &["run", "s.toml", "--backend", "tpu"], &["check"]] {
        let said = sandbox.lithosph(wrong);
        assert_eq!(said.code, Some(2), "{said:?}");
        assert!(said.err.contains("Usage: ") || said.err.contains("For more information"), "{said:?}");
        assert!(said.out.is_empty() && !sandbox.exists("out"));
    }
}

#[test]
fn an_output_folder_is_only_overwritten_by_force() {
    let sandbox = Sandbox::new("force");
    let run = ["run", "s.toml", "--backend", "cpu", "--out", "here"];
    assert_eq!(sandbox.lithosph(&run).code, Some(0));
    sandbox.write("here/notes.txt", "mine");
    let series = std::fs::read(sandbox.path("here/series.csv")).unwrap();
    refused(&sandbox, &sandbox.lithosph(&run), &["here exists already", "--force"]);
    // Nor by a run that cannot begin.
    let no_driver = sandbox.without_driver(&["run", "s.toml", "--backend", "gpu", "--out", "here", "--force"]);
    refused(&sandbox, &no_driver, &["no graphics adapter was found"]);
    assert_eq!(std::fs::read(sandbox.path("here/series.csv")).unwrap(), series);
    let again = sandbox.lithosph(&[&run[..], &["--force", "--variant", "slow"]].concat());
    assert_eq!(again.code, Some(0), "{again:?}");
    assert_ne!(std::fs::read(sandbox.path("here/series.csv")).unwrap(), series);
    assert!(sandbox.exists("here/notes.txt"), "another's file was taken away");
}

#[test]
fn a_good_run_is_quiet_in_a_pipe_and_leaves_every_file() {
    let sandbox = Sandbox::new("good");
    let said = sandbox.lithosph(&["run", "s.toml", "--backend", "cpu", "--variant", "slow"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.starts_with("s-slow: Two blocks\n") && said.out.contains("written to out/s-slow"), "{said:?}");
    for name in ["run.toml", "series.csv", "summary.json", "frames/00000.png", "frames/00002.png"] {
        assert!(sandbox.exists(&format!("out/s-slow/{name}")), "{name}");
    }
    let (names, rows) = csv::read(&sandbox.path("out/s-slow/series.csv")).unwrap();
    assert_eq!((names.join(" ").as_str(), rows.len()), ("time kinetic momentum", 5));
    let said = sandbox.lithosph(&["run", "s.toml", "--backend", "cpu", "--quiet", "--precision", "f32", "--threads", "1"]);
    assert_eq!((said.code, said.out.as_str(), said.err.as_str()), (Some(0), "", ""));
    assert!(std::fs::read_to_string(sandbox.path("out/s/summary.json")).unwrap().contains("f32"));
}

#[test]
fn lists_devices_and_help_are_told_even_without_a_driver() {
    let sandbox = Sandbox::new("lists");
    let said = sandbox.lithosph(&["list"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""));
    for word in ["cubic_spline", "kinetic_energy", "find_neighbors", "displacement"] {
        assert!(said.out.contains(word), "{word}: {}", said.out);
    }
    let said = sandbox.lithosph(&["list", "s.toml"]);
    assert_eq!((said.code, said.out.as_str()), (Some(0), "slow\n"), "{said:?}");
    let said = sandbox.lithosph(&["devices"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.contains("CPU, "), "{said:?}");
    let said = sandbox.without_driver(&["devices"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.contains("no Vulkan adapter"), "{said:?}");
    for arguments in [&["--help"][..], &["--version"], &["run", "--help"]] {
        assert_eq!(sandbox.lithosph(arguments).code, Some(0));
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let sandbox = Sandbox::new("pipe");
    let mut child = sandbox.command(&["list"]).spawn().unwrap();
    drop(child.stdout.take());
    let mut err = String::new();
    std::io::Read::read_to_string(child.stderr.as_mut().unwrap(), &mut err).unwrap();
    assert_eq!((child.wait().unwrap().code(), err.as_str()), (Some(0), ""));
}

/// The initial kinetic energy of the scene is 36 x 0.01^2 / 2.
const EXPECTED: &str = r#"
[expect.kinetic]
value = 0.0018
tolerance = 1e-9
statistic = "first"
source = "mass and speed"

[expect.momentum]
kind = "failure"
value = -0.72
seen = -0.36
tolerance = 0.1
because = "it is a test"
statistic = "first"
source = "nowhere"
variant = "none"
"#;

fn checked(sandbox: &Sandbox, text: &str, more: &[&str]) -> Said {
    sandbox.write("s.toml", &format!("{SCENE}{text}"));
    let said = sandbox.lithosph(&[&["check", "s.toml", "--backend", "cpu"], more].concat());
    assert!(said.err.is_empty() && !sandbox.exists("out"), "{said:?}");
    said
}

/// The words of the table's line that begins with some of them.
fn line(said: &Said, start: &str) -> String {
    let mut lines = said.out.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    lines.find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("{start}: {}", said.out))
}

#[test]
fn expectations_pass_or_miss_or_state_how_they_are_wrong() {
    let sandbox = Sandbox::new("check");
    let check = |text: &str, more: &[&str]| checked(&sandbox, text, more);
    let said = check(EXPECTED, &["--variant", "none"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(line(&said, "s * kinetic").ends_with(" value ±1e-9 pass mass and speed"), "{said:?}");
    assert_eq!(
        line(&said, "s * momentum"),
        "s * momentum -3.600000e-1 -0.72 50 % value -0.36 ±0.1 failure nowhere; it is a test"
    );
    assert!(said.out.ends_with("2 expectations: 1 pass, 1 failure, 0 missed\n"), "{said:?}");
    // The variant is slower, so that what holds for both misses there.
    let said = check(EXPECTED, &[]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(line(&said, "s-slow").contains(" MISS "), "{said:?}");
    assert!(said.out.ends_with("3 expectations: 1 pass, 1 failure, 1 missed\n"), "{said:?}");
    // An error of ours that has become smaller is a miss as well.
    let better = EXPECTED.replace("failure", "shortfall").replace("seen = -0.36", "seen = 0.0");
    let said = check(&better, &["--variant", "none"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(line(&said, "s * momentum").ends_with("nearer to the truth than it was: say so in the scene"), "{said:?}");
    let said = check(EXPECTED, &["--ci"]);
    assert!(said.code == Some(0) && said.out.ends_with("0 expectations: 0 missed\n"), "{said:?}");
    // A run that breaks off is a line of the table, not the end of it.
    let said = sandbox.lithosph(&[&["check", "s.toml", "--backend", "cpu", "--variant", "slow"], &BREAKS[..]].concat());
    assert!(said.code == Some(1) && said.err.contains("warning: --set time.step: the fixed time.step of 5 T"), "{said:?}");
    assert!(said.out.contains("try time.") && said.out.ends_with("1 expectations: 1 missed\n"), "{said:?}");
}

#[test]
fn a_number_without_a_truth_and_a_wide_tolerance_are_told() {
    let sandbox = Sandbox::new("wide");
    let pinned = "[expect.kinetic]\nkind = \"pinned\"\nstatistic = \"first\"\nseen = 0.0017\ntolerance = 1e-4\nbecause = \"it is a test\"\n\
                  source = \"nowhere\"\nvariant = \"none\"\n";
    let said = checked(&sandbox, pinned, &["--variant", "none"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_eq!(line(&said, "s * kinetic"), "s * kinetic 1.800000e-3 - - 0.0017 ±0.0001 pinned nowhere; it is a test");
    let wide = EXPECTED.replace("0.0018", "0.00179").replace("1e-9", "3e-5");
    let said = checked(&sandbox, &wide, &["--variant", "none"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(line(&said, "s * kinetic").ends_with("TOO WIDE: the tolerance is 3.00 times the error"), "{said:?}");
    assert!(said.out.ends_with("0 missed; 1 tolerances too wide\n"), "{said:?}");
}

#[test]
fn errors_are_fractions_of_what_the_table_says() {
    let sandbox = Sandbox::new("fractions");
    // At the end the reference is 3, and the energy less than a thousandth of that.
    sandbox.write("r.csv", "t,e\n0,1\n4,3\n");
    let of_curve = |scale: &str| {
        let keys = "reference = \"r.csv\"\ncolumns = [\"t\", \"e\"]\nnorm = \"final\"\ntolerance = 1\nsource = \"x\"";
        line(&checked(&sandbox, &format!("[expect.kinetic]\n{keys}\n{scale}\n"), &["--variant", "none"]), "s * kinetic")
    };
    assert!(of_curve("").contains(" r.csv 100 % peak ±1 MISS "), "{}", of_curve(""));
    assert!(of_curve("scale = \"mean\"").contains(" 150 % mean ±1 MISS "), "{}", of_curve("scale = \"mean\""));
    assert!(
        of_curve("scale = 6\nrelative = true").contains(" 50 % 6 ±100 % pass "),
        "{}",
        of_curve("scale = 6\nrelative = true")
    );
    let of_number = |keys: &str| {
        let text = format!("[expect.kinetic]\nstatistic = \"first\"\nsource = \"x\"\n{keys}\n");
        line(&checked(&sandbox, &text, &["--variant", "none"]), "s * kinetic")
    };
    assert!(of_number("value = 0.0036\ntolerance = 1").contains(" -50 % value ±1 pass "));
    assert!(of_number("value = 0\ntolerance = 1\nscale = 0.018").contains(" 10 % 0.018 ±1 pass "));
    // Of a value 0 without a scale: the largest of the series, which begins with its largest.
    let own = of_number("value = 0\ntolerance = 1");
    assert!(own.contains(" largest ±1 pass "), "{own}");
}

#[test]
fn a_check_keeps_its_rows_and_goes_on_with_them() {
    let sandbox = Sandbox::new("record");
    let check = |more: &[&str]| checked(&sandbox, EXPECTED, &[&["--record", "kept/rows.jsonl"], more].concat());
    let late = check(&["--variant", "none", "--within", "0"]);
    assert_eq!(late.code, Some(0), "{late:?}");
    assert!(line(&late, "s * run").contains(" not run not finished in 0 s"), "{late:?}");
    assert!(!sandbox.exists("kept/rows.jsonl"), "what was not run is tried again");
    let first = check(&["--variant", "none"]);
    let kept = std::fs::read_to_string(sandbox.path("kept/rows.jsonl")).unwrap();
    // A mark in the file shows that the rows come from there; a line that was cut short is left out.
    sandbox.write("kept/rows.jsonl", &format!("{}{}", kept.replace("mass and speed", "the record"), &kept[..40]));
    let again = check(&["--variant", "none"]);
    assert_eq!(again.out, first.out.replace("mass and speed", "the record"), "{again:?}");
    // Another scene is another run.
    let other = check(&["--variant", "none", "--set", "duration=3"]);
    assert!(other.out.contains("mass and speed"), "{other:?}");
}

#[test]
fn a_missing_reference_is_told_before_the_run() {
    let sandbox = Sandbox::new("reference");
    let expect = "[expect.kinetic]\nreference = \"r.csv\"\ncolumns = [\"t\", \"e\"]\ntolerance = 1\nsource = \"x\"\n";
    sandbox.write("s.toml", &format!("{SCENE}{expect}"));
    let check = || sandbox.lithosph(&["check", "s.toml", "--backend", "cpu", "--set", "duration=1e5"]);
    refused(&sandbox, &check(), &["cannot read", "r.csv"]);
    sandbox.write("r.csv", "t,energy\n0,1\n1,2\n");
    refused(&sandbox, &check(), &["r.csv has no column `e`"]);
    sandbox.write("r.csv", "t,e\n0,1\n");
    refused(&sandbox, &check(), &["r.csv has fewer than two rows"]);
}

#[test]
fn without_a_driver_auto_takes_the_processor() {
    let sandbox = Sandbox::new("driverless");
    refused(&sandbox, &sandbox.without_driver(&["run", "s.toml", "--backend", "gpu"]), &["no graphics adapter was found"]);
    refused(&sandbox, &sandbox.without_driver(&["run", "s.toml", "--adapter", "GeForce"]), &["GeForce", "no graphics driver"]);
    let said = sandbox.without_driver(&["run", "s.toml", "--backend", "auto"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_eq!(said.err, "no hardware GPU with Vulkan found: running on the CPU\n");
    assert!(said.out.contains("CPU, "), "{said:?}");
    sandbox.write("s.toml", &format!("{SCENE}{EXPECTED}"));
    let said = sandbox.without_driver(&["check", "s.toml"]);
    assert_eq!(said.err.lines().count(), 1, "once for all runs: {said:?}");
}

/// Steps so long that the first one tears the blocks apart.
const BREAKS: [&str; 10] = [
    "--set",
    "time.step=5",
    "--set",
    "body.left.velocity=[2,0]",
    // Said to be meant, so that no warning joins the complaint.
    "--set",
    "formulation.artificial_stress={ epsilon = 0 }",
    "--set",
    "duration=500",
    "--set",
    "output={ series = 5, frames = 5, picture = { width = 320, height = 240 } }",
];

#[test]
fn a_run_that_goes_wrong_says_why_and_keeps_what_it_has() {
    let sandbox = Sandbox::new("wrong");
    let said = sandbox.lithosph(&[&["run", "s.toml", "--backend", "cpu"], &BREAKS[..]].concat());
    assert_eq!(said.code, Some(1), "{said:?}");
    // Before the run it is warned of its step.
    let (warning, reason) = said.err.split_once('\n').unwrap();
    assert!(warning.starts_with("lithosph: warning: --set time.step: the fixed time.step of 5 T"), "{said:?}");
    one_line(reason, "wrong");
    assert!(reason.contains("step ") && reason.contains("try time."), "{said:?}");
    assert!(said.err.contains("written so far is in out/s"), "{said:?}");
    assert!(!csv::read(&sandbox.path("out/s/series.csv")).unwrap().1.is_empty());
    assert!(!sandbox.exists("out/s/summary.json"));
    #[cfg(feature = "hdf5")]
    stored::every_step_reads(&sandbox.path("out/s/particles.vtkhdf"));
}

#[test]
fn an_interrupt_ends_with_130_and_readable_output() {
    let sandbox = Sandbox::new("interrupt");
    let child = sandbox.command(&["run", "s.toml", "--backend", "cpu", "--set", "duration=1e5"]).spawn().unwrap();
    let rows = || csv::read(&sandbox.path("out/s/series.csv")).map_or(0, |(_, rows)| rows.len());
    until("there are rows", || rows() > 3);
    signal(&child, libc::SIGINT);
    let said = said(child);
    assert_eq!(said.code, Some(130), "{said:?}");
    one_line(&said.err, "interrupt");
    assert!(said.err.contains("interrupted at t = ") && said.err.contains("out/s"), "{said:?}");
    assert!(rows() > 3);
    #[cfg(feature = "hdf5")]
    stored::every_step_reads(&sandbox.path("out/s/particles.vtkhdf"));
}

#[cfg(feature = "hdf5")]
mod stored {
    use super::*;
    use lithosph::output::vtkhdf;
    use std::path::Path;

    /// Number of steps; each must be whole.
    #[track_caller]
    pub fn every_step_reads(path: &Path) -> usize {
        let times = vtkhdf::read(path).unwrap();
        assert!(!times.is_empty(), "{} holds no step", path.display());
        for (k, time) in times.iter().enumerate() {
            let snapshot = vtkhdf::read_step(path, k).unwrap();
            assert_eq!((snapshot.time, snapshot.positions.len()), (*time, 72));
            assert!(snapshot.positions.iter().flatten().all(|x| x.is_finite()));
        }
        times.len()
    }

    #[test]
    fn a_full_disk_ends_with_one_sentence_and_readable_output() {
        let sandbox = Sandbox::new("full");
        let often = ["--set", "output.frames=0.01", "--set", "output.series=0.01"];
        let said = sandbox.on_full_disk(64, &[&["run", "s.toml", "--backend", "cpu"], &often[..]].concat());
        assert_eq!(said.code, Some(1), "{said:?}");
        one_line(&said.err, "full disk");
        assert!(said.err.contains("cannot write out/s/particles.vtkhdf: File too large"), "{said:?}");
        let steps = every_step_reads(&sandbox.path("out/s/particles.vtkhdf"));
        assert!(steps > 3, "{steps}");
        assert!(csv::read(&sandbox.path("out/s/series.csv")).unwrap().1.len() > 3);
        // With room again, the run goes on from there.
        let said = sandbox.lithosph(&["run", "--resume", "out/s", "--backend", "cpu"]);
        assert_eq!(said.code, Some(0), "{said:?}");
        assert_eq!(every_step_reads(&sandbox.path("out/s/particles.vtkhdf")), 401);
    }

    #[test]
    fn stored_steps_are_painted_and_what_is_not_stored_is_refused() {
        let sandbox = Sandbox::new("render");
        assert_eq!(sandbox.lithosph(&["run", "s.toml", "--backend", "cpu", "--out", "done"]).code, Some(0));
        let refuse = |arguments: &[&str], words: &[&str]| {
            refused(&sandbox, &sandbox.lithosph(arguments), words);
            assert!(!sandbox.exists("pictures"));
        };
        refuse(&["render", "no.vtkhdf", "--out", "pictures"], &["no.vtkhdf: "]);
        refuse(&["render", "s.toml", "--out", "pictures"], &["s.toml: "]);
        refuse(&["render", "done", "--step", "3", "--out", "pictures"], &["holds 3 steps", "no step 3"]);
        refuse(&["render", "done", "--field", "presure", "--out", "pictures"], &["presure", "\"pressure\""]);
        refuse(&["render", "done", "--width", "3", "--out", "pictures"], &["too small"]);
        let said = sandbox.lithosph(&["render", "done", "--field", "velocity.x", "--step", "1", "--out", "pictures"]);
        assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
        assert!(sandbox.exists("pictures/00001.png") && !sandbox.exists("pictures/00000.png"));
        // A folder without a checkpoint cannot go on.
        for name in ["checkpoint.h5", "checkpoint.previous.h5"] {
            std::fs::remove_file(sandbox.path("done").join(name)).unwrap();
        }
        let said = sandbox.lithosph(&["run", "--resume", "done", "--backend", "cpu"]);
        refused(&sandbox, &said, &["done holds no checkpoint.h5"]);
    }
}
