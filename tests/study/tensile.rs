//! `lithosph study tensile` from outside.

use crate::common::sandbox::{Said, Sandbox};

fn study(sandbox: &Sandbox, more: &[&str]) -> Said {
    sandbox.lithosph(&[&["study", "tensile"], more].concat())
}

#[test]
fn parts_leave_a_page_tables_and_pictures() {
    let sandbox = Sandbox::new("tensile");
    let said = study(&sandbox, &["edge", "work", "--out", "found"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.contains("agrees  figure 3.3-5, p. 61: near the edge"), "{said:?}");
    assert!(said.out.contains("differs  3.3.3, p. 61: stress and velocity"), "{said:?}");
    assert!(said.out.contains("written to found/tensile.html"), "{said:?}");
    for file in ["tensile.html", "statements.csv", "edge.csv", "edge.svg", "edge.png", "work.csv", "work.svg", "closed-paths.csv"]
    {
        assert!(sandbox.exists(&format!("found/{file}")), "{file}");
    }
    let read = |file: &str| std::fs::read_to_string(sandbox.path(&format!("found/{file}"))).unwrap();
    let page = read("tensile.html");
    assert!(page.contains("The edge of a linear function") && !page.contains("src=\"http") && !page.contains("<script"));
    let statements = read("statements.csv");
    let (agree, all) = (statements.matches(",agrees\n").count(), statements.lines().count() - 1);
    assert!(all > 0 && page.contains(&format!("{agree} of {all} statements agree")), "{agree} of {all}");
    // Four kernels at five smoothing lengths, 20 particles each; the outermost has half the slope of the inside.
    let rows = read("edge.csv");
    assert_eq!(rows.lines().count(), 1 + 4 * 5 * 20);
    assert!(
        rows.lines().any(|row| row.starts_with("cubic_spline,1,0.50000,0.83333,0.58333,0.70000,0.75000,0.50000,1.00000")),
        "{rows}"
    );
}

#[test]
fn an_unknown_part_and_a_folder_that_cannot_be_made_are_refused() {
    let sandbox = Sandbox::new("tensile-slip");
    let said = study(&sandbox, &["edges"]);
    assert!(said.code == Some(2) && said.err.contains("edges") && !sandbox.exists("out"), "{said:?}");
    // A folder that cannot be made.
    sandbox.write("file", "");
    let said = study(&sandbox, &["edge", "--out", "file/found"]);
    assert!(said.code == Some(2) && said.err.contains("file/found") && said.err.lines().count() == 1, "{said:?}");
}
