//! Small scenes that carry what they do not need, and one that needs what it carries.

use super::*;
use crate::backend::Choice;
use crate::study::accuracy::row::OK;

/// A bar rings; another, far off, is to be kept from it.
const FAR_APART: &str = r#"title = "Two bars"
dimension = 1
units = "dimensionless"
spacing = 0.05
duration = 0.5
[[body]]
name = "ringing"
shape = { block = { min = [0], max = [1] } }
anchor = [0.025]
material = "rubber"
motion = { wave = { amplitude = [0.01], wave_vector = [3.141592653589793] } }
[[body]]
name = "idle"
shape = { block = { min = [3], max = [4] } }
anchor = [3.025]
material = "rubber"
[material.rubber]
law = "st_venant_kirchhoff"
density = 1
youngs_modulus = 1
poisson_ratio = 0.3
[formulation]
kind = "total_lagrangian"
[[contact]]
between = ["ringing", "idle"]
potential = { law = "barrier", stiffness = 1, range = 1 }
[output]
series = 0.05
[observe]
total = { kind = "total_energy" }
touching = { kind = "contact_energy" }
end = { kind = "probe", field = "displacement.x", at = [1] }
[expect.total]
value = 2.5e-5
tolerance = 0.01
relative = true
source = "rho v^2/2 over half a wave"
"#;

/// Strand's line under tension, which one particle sets swinging: it clumps without artificial stress.
const STRETCHED: &str = r#"title = "A line under tension"
dimension = 1
spacing = 1e-3
duration = 6e-5
[[body]]
name = "line"
shape = { block = { min = [0], max = [51e-3] } }
anchor = [0.5e-3]
material = "steel"
relative_volume = 1.01
[material.steel]
law = "fluid"
density = 7850.0
bulk_modulus = 196.25e9
[[boundary]]
name = "border"
select = { inside = { cut = { from = { block = { min = [-1], max = [1] } }, remove = [{ block = { min = [3e-3], max = [48e-3] } }] } } }
fixed = true
[[kick]]
at = [25.5e-3]
velocity = [1e-6]
[formulation]
smoothing_length = 1.3
artificial_stress = { form = "scalar", epsilon = 0.3 }
[output]
series = 1e-6
[observe]
speed = { kind = "rms_speed" }
nearest = { kind = "least_distance" }
[expect.speed]
value = 0
tolerance = 2e-7
statistic = "max"
source = "von Neumann analysis: no growing wave"
"#;

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, scene: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("lithosph-ablate-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("s.toml"), scene).unwrap();
        Self(folder)
    }

    fn request(&self) -> Request {
        let (scene, out) = (self.0.join("s.toml"), Some(self.0.join("s.csv")));
        Request { scene, out, choice: Choice::Cpu, repeats: 1, ..Request::default() }
    }

    fn csv(&self) -> String {
        std::fs::read_to_string(self.0.join("s.csv")).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn found(request: &Request) -> (String, Found) {
    let study = Study::plan(request).unwrap();
    let found = study.run(|_| ()).unwrap();
    (study.report(&found).unwrap(), found)
}

/// Of the piece whose name begins so.
fn verdict(found: &Found, name: &str) -> Verdict {
    let known: Vec<&str> = found.rows.iter().map(|(piece, _)| piece.name.as_str()).collect();
    let of = found.verdicts().find(|(piece, _)| piece.name.starts_with(name));
    of.unwrap_or_else(|| panic!("{name} is none of {known:?}")).1
}

/// Without the piece the scene is refused: here since an observable then has no body to sit in.
fn assert_untold(verdict: Verdict, reason: &str) {
    assert!(matches!(&verdict, Verdict::Untold(told) if told.contains(reason)), "{verdict:?}");
}

#[test]
fn a_scene_is_told_what_it_does_not_need() {
    let folder = Folder::new("apart", FAR_APART);
    let (text, found) = found(&folder.request());
    let contact = "contact of `ringing` and `idle` by potential";
    assert_eq!(verdict(&found, contact), Verdict::Idle);
    assert!(text.contains(&format!("s carries {contact}, which it does not need: no observable knows of it.")), "{text}");
    assert_untold(verdict(&found, "body `ringing`"), "it must be a point of a body");
    let line = verdict(&found, "dimension 0 instead of 1");
    assert_eq!(line, Verdict::Untold("refused: a line has no dimension to lose".into()));

    // The smallest model has run, and holds what is expected.
    let (piece, row) = found.smallest.clone().unwrap();
    assert!(piece.name.contains(contact) && piece.overrides.contains(&"contact.0=none".into()), "{piece:?}");
    assert_eq!((row.key[0].as_str(), row.status.as_str()), (COMBINATION, OK));
    let error = row.errors[0].unwrap();
    assert!(error <= 0.01, "{error}");
    let saved = found.judge.saved(&row).unwrap();
    assert!(saved[1] > 0.3 && saved[2] > 0.3, "{saved:?}");
    let options: String = piece.overrides.iter().map(|set| format!(" --set {set}")).collect();
    assert!(text.replace('\'', "").contains(&options), "{text}");
    // By the options that it prints, the scene is that model.
    let scene = Scene::open(&folder.request().scene, None, &piece.overrides).unwrap();
    assert_eq!(row.cost.unwrap()[0], scene.particles.len() as f64);
}

#[test]
fn a_scene_keeps_what_it_needs() {
    let folder = Folder::new("stretched", STRETCHED);
    let (text, found) = found(&folder.request());
    assert_eq!(verdict(&found, "artificial stress"), Verdict::Needed("speed".into()));
    assert!(!text.contains("carries artificial stress"), "{text}");
    let (piece, row) = found.smallest.clone().unwrap();
    assert!(!piece.overrides.iter().any(|set| set.contains("artificial_stress")), "{piece:?}");
    assert!(row.errors[0].unwrap() <= 2e-7, "{row:?}");
    // Half the time tells nothing of a speed that shall never grow.
    let half = found.verdicts().find(|(piece, _)| piece.ends.is_some()).unwrap().1;
    assert!(matches!(&half, Verdict::Untold(why) if why.contains("judged over the whole duration")), "{half:?}");
}

#[test]
fn no_row_is_run_twice() {
    let folder = Folder::new("again", FAR_APART);
    let request = folder.request();
    let (text, _) = found(&request);
    let first = folder.csv();
    assert_eq!(found(&request).0, text);
    assert_eq!(folder.csv(), first);
    // The last rows are cut off, one of them in the middle: what is left is kept to the byte.
    let half = first.len() / 2;
    std::fs::write(folder.0.join("s.csv"), &first[..half]).unwrap();
    let (_, again) = found(&request);
    let second = folder.csv();
    let kept = first[..half].rfind('\n').unwrap();
    assert_eq!(second[..kept], first[..kept]);
    // Times differ from run to run, what is found does not.
    let numbers = |text: &str| {
        let cells = text.lines().skip(2).map(crate::study::accuracy::table::cells);
        let mut rows: Vec<_> = cells.map(|cells| (cells[1].clone(), cells[12..].to_vec())).collect();
        rows.retain(|(name, _)| !name.contains('+'));
        rows.sort();
        rows
    };
    assert_eq!(numbers(&second), numbers(&first));
    assert!(again.smallest.is_some());
}

#[test]
fn a_fraction_takes_the_place_of_the_tolerances() {
    let folder = Folder::new("fraction", FAR_APART);
    let strict = Request { error: Some(1e-12), ..folder.request() };
    let (_, strictly) = found(&strict);
    let before = folder.csv();
    let (_, freely) = found(&Request { error: Some(0.5), ..folder.request() });
    // The same runs serve both.
    assert!(folder.csv().starts_with(&before));
    let may_go = |found: &Found| found.verdicts().filter(|(_, verdict)| verdict.may_go()).count();
    assert!(may_go(&strictly) < may_go(&freely), "{} {}", may_go(&strictly), may_go(&freely));
    assert_eq!(verdict(&freely, "spacing "), Verdict::Spare);
    assert_untold(verdict(&freely, "body `ringing`"), "it must be a point of a body");
    let nothing_expected = FAR_APART[..FAR_APART.find("[expect").unwrap()].to_string();
    std::fs::write(folder.0.join("s.toml"), nothing_expected).unwrap();
    let refusal = Study::plan(&folder.request()).err().unwrap();
    assert!(refusal.contains("s expects nothing") && refusal.contains("--error 1%"), "{refusal}");
}

/// Scenes with fewer particles are looked at.
const FEW: usize = 5000;

/// What a scene names can be taken away: with it goes what observes it.
#[test]
fn every_scene_can_be_without_each_piece_that_it_names() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let fits = |scene: Scene| scene.particles.len() <= FEW && scene.one_formulation("study ablate").is_ok();
        let small = |variant: Option<&str>| Scene::open(&path, variant, &[]).is_ok_and(fits);
        if path.extension().is_none_or(|extension| extension != "toml") || !small(None) {
            continue;
        }
        for variant in crate::scene::read::variants(&path).unwrap().into_iter().map(Some).chain([None]) {
            if small(variant.as_deref()) {
                seen += opened_without_each(&Source::new(path.clone(), variant).unwrap());
            }
        }
    }
    assert!(seen > 100, "{seen}");
}

fn opened_without_each(source: &Source) -> usize {
    let scene = source.open(&[]).unwrap();
    let pieces = named::pieces(&scene, &source.read().unwrap().file);
    for piece in &pieces {
        let opened = source.open(&piece.overrides);
        assert!(opened.is_ok(), "{} without {}: {}", scene.label(), piece.name, opened.err().unwrap());
    }
    pieces.len()
}
