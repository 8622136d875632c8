//! Every row of the atlas of failures behaves as it states; and its command goes on where it was stopped.

use crate::common::sandbox::{Sandbox, said, signal, until};
use lithosph::study::atlas::Size;
use lithosph::study::atlas::rows::ROWS;

macro_rules! rows {
    ($($name:ident),+ $(,)?) => {
        const NAMES: &[&str] = &[$(stringify!($name)),+];
        /// A test a row, so that a failure says which.
        mod plain_fails_and_remedy_survives {
            $(
                #[test]
                fn $name() {
                    super::assert_as_stated(stringify!($name));
                }
            )+
        }
    };
}

rows! {
    tensile_instability,
    tensile_instability_line,
    tensile_instability_plane,
    artificial_stress_spacing,
    artificial_stress_at_rest,
    compression_instability,
    zero_energy_modes,
    numerical_fracture,
    adhesive_contact,
    contact_of_steps,
    contact_zones,
    contact_along_normals,
    rotation_lost_to_xsph,
    rotation_lost_to_gradients,
    density_by_summation,
    energy_of_bare_kernels,
    disorder_of_corrected_kernels,
    time_step_of_leapfrog,
    time_step_of_ssp_rk3,
    time_step_of_rk4,
    time_step_of_pefrl,
    no_stable_step_of_rk2,
    stagnation_in_f32,
    digits_lost_in_f32,
    st_venant_kirchhoff_in_compression,
}

fn assert_as_stated(name: &str) {
    let row = ROWS.iter().find(|row| row.name == name).unwrap_or_else(|| panic!("no row is named {name}"));
    let sandbox = Sandbox::new(name);
    let verdict = row.run(&sandbox.path("row"), Size::Test, |_| {}).unwrap_or_else(|stop| panic!("{name}: {stop:?}"));
    let line = format!("{name}: plain {:.4e}, remedy {:.4e}", verdict.plain, verdict.remedy);
    println!("{line}");
    assert!(verdict.as_stated, "{line}");
}

#[test]
fn each_row_has_a_test_of_its_own() {
    assert_eq!(NAMES, ROWS.iter().map(|row| row.name).collect::<Vec<_>>());
}

#[test]
fn names_are_words_and_come_once() {
    for (k, row) in ROWS.iter().enumerate() {
        assert!(row.name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_'), "{}", row.name);
        assert!(ROWS[..k].iter().all(|other| other.name != row.name), "{} comes twice", row.name);
    }
}

const ROWS_ASKED_FOR: [&str; 4] = ["study", "atlas", "tensile_instability_line", "contact_zones"];

#[test]
fn a_finished_row_is_not_run_again() {
    let sandbox = Sandbox::new("atlas-again");
    let said = sandbox.lithosph(&ROWS_ASKED_FOR[..3]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    let table = || std::fs::read_to_string(sandbox.path("out/study/atlas.csv")).unwrap();
    let (first, page) = (table(), std::fs::read_to_string(sandbox.path("out/study/atlas.html")).unwrap());
    assert!(first.lines().count() == 2 && first.contains(",as stated,") && said.out.contains("as stated"), "{first}{said:?}");
    assert!(page.contains("tensile instability line") && !page.contains("contact zones"), "{page:.2000}");
    for file in ["atlas/tensile_instability_line.png", "atlas/tensile_instability_line-trace.svg"] {
        assert!(sandbox.exists(&format!("out/study/{file}")), "{file}");
    }
    let changed = |name: &str| std::fs::metadata(sandbox.path(name)).and_then(|data| data.modified()).unwrap();
    let series = "out/study/atlas/tensile_instability_line/plain/series.csv";
    let before = changed(series);

    let said = sandbox.lithosph(&ROWS_ASKED_FOR);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_eq!((changed(series), table().lines().count()), (before, 3));
    assert!(table().starts_with(&first) && said.out.contains("contact_zones"), "{said:?}");
    assert_eq!(sandbox.lithosph(&[&ROWS_ASKED_FOR[..3], &["--force"]].concat()).code, Some(0));
    assert!(changed(series) > before);
}

#[test]
fn an_interrupt_leaves_a_table_to_go_on_from() {
    let sandbox = Sandbox::new("atlas-stop");
    let rows = ["study", "atlas", "tensile_instability_line", "adhesive_contact"];
    let child = sandbox.command(&rows).spawn().unwrap();
    until("there is a row", || sandbox.exists("out/study/atlas.csv"));
    signal(&child, libc::SIGINT);
    let said = said(child);
    assert_eq!(said.code, Some(130), "{said:?}");
    assert!(said.err.contains("interrupted in adhesive_contact; finished rows are in out/study/atlas.csv"), "{said:?}");
    let table = std::fs::read_to_string(sandbox.path("out/study/atlas.csv")).unwrap();
    assert!(table.lines().count() == 2 && table.contains("tensile_instability_line,"), "{table}");
}

/// The numbers in the table are judged anew: one that is not as stated ends with exit code 1.
#[test]
fn a_row_that_does_not_behave_ends_with_exit_code_1() {
    let sandbox = Sandbox::new("atlas-wrong");
    assert_eq!(sandbox.lithosph(&ROWS_ASKED_FOR[..3]).code, Some(0));
    let file = sandbox.path("out/study/atlas.csv");
    let text = std::fs::read_to_string(&file).unwrap();
    let mut cells: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    let rewrite = |cells: &[&str]| {
        std::fs::write(&file, format!("{}\n{}\n", text.lines().next().unwrap(), cells.join(","))).unwrap();
        sandbox.lithosph(&ROWS_ASKED_FOR[..3])
    };
    cells[2] = "1.25";
    let said = rewrite(&cells);
    assert!(said.code == Some(1) && said.out.contains("NOT AS STATED"), "{said:?}");
    // A row of another scene or version is run again.
    cells[8] = "0123456789abcdef";
    let said = rewrite(&cells);
    assert!(said.code == Some(0) && said.out.contains("as stated"), "{said:?}");
}

#[test]
fn a_misspelt_row_and_a_file_that_is_no_atlas_are_refused() {
    let sandbox = Sandbox::new("atlas-slip");
    let said = sandbox.lithosph(&["study", "atlas", "tensile_instabilty"]);
    assert_eq!((said.code, said.err.lines().count()), (Some(2), 1), "{said:?}");
    assert!(said.err.contains("did you mean `tensile_instability`?") && !sandbox.exists("out"), "{said:?}");
    std::fs::create_dir_all(sandbox.path("out/study")).unwrap();
    sandbox.write("out/study/atlas.csv", "time,energy\n0,1\n");
    let said = sandbox.lithosph(&ROWS_ASKED_FOR[..3]);
    assert!(said.code == Some(2) && said.err.contains("is there and no atlas"), "{said:?}");
}
