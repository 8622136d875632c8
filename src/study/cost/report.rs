//! The table as text and as CSV.

use super::Row;
use crate::backend::Choice;
use crate::output::csv::shortest;
use crate::study::accuracy::report::aligned;
use crate::study::accuracy::table::line;
use std::path::Path;

pub const TITLES: [&str; 12] = [
    "scene",
    "dimension",
    "formulation",
    "own parts",
    "particles",
    "fields",
    "passes",
    "dispatches",
    "WGSL",
    "bytes/particle f32, f64",
    "ms/step",
    "ns/particle",
];

/// The table for a terminal; `-` stands where a scene was not stepped.
pub fn text(rows: &[Row]) -> String {
    let mut lines = vec![TITLES.map(String::from).to_vec()];
    lines.extend(rows.iter().map(|row| cells(row).to_vec()));
    aligned(&lines, 4) + &verdict(rows)
}

/// A row's cells under [`TITLES`].
pub fn cells(row: &Row) -> [String; TITLES.len()] {
    let time = |scale: f64| row.step.map_or_else(|| "-".into(), |step| format!("{:.3}", scale * step.processor_seconds));
    [
        row.scene.clone(),
        format!("{}D", row.dimension),
        row.formulation.clone(),
        if row.own_parts_suffice { "suffice" } else { "DIFFER" }.into(),
        row.particles.to_string(),
        row.fields.len().to_string(),
        row.passes.len().to_string(),
        row.dispatches.to_string(),
        row.shader_bytes.to_string(),
        format!("{:.0} {:>5.0}", row.bytes[0], row.bytes[1]),
        time(1e3),
        time(1e9 / row.particles as f64),
    ]
}

/// Whether specialisation holds.
pub fn verdict(rows: &[Row]) -> String {
    let wrong: Vec<&str> = rows.iter().filter(|row| !row.own_parts_suffice).map(|row| row.scene.as_str()).collect();
    match wrong[..] {
        [] => "Composed from its own parts alone, each scene has the same fields, dispatches and WGSL, byte for byte.\n".into(),
        _ => format!("Composed otherwise from their own parts alone: {}\n", wrong.join(", ")),
    }
}

/// Processor time, and names of fields and passes in full.
///
/// # Errors
/// Where the file cannot be written.
pub fn write(path: &Path, rows: &[Row], choice: &Choice) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("cannot write {}: {error}", path.display());
    let titles = [
        "scene",
        "dimension",
        "formulation",
        "particles",
        "fields",
        "passes",
        "dispatches_per_step",
        "wgsl_bytes",
        "own_parts_suffice",
        "bytes_per_particle_f32",
        "bytes_per_particle_f64",
        "backend",
        "bytes",
        "cpu_seconds_per_step",
        "wall_seconds_per_step",
        "field_names",
        "pass_names",
    ];
    let mut text = line(&titles.map(String::from)) + "\n";
    for row in rows {
        let step = |of: fn(super::Step) -> f64| row.step.map_or_else(String::new, |step| shortest(of(step)));
        let cells = [
            row.scene.clone(),
            row.dimension.to_string(),
            row.formulation.clone(),
            row.particles.to_string(),
            row.fields.len().to_string(),
            row.passes.len().to_string(),
            row.dispatches.to_string(),
            row.shader_bytes.to_string(),
            row.own_parts_suffice.to_string(),
            shortest(row.bytes[0]),
            shortest(row.bytes[1]),
            backend(choice).into(),
            step(|step| step.bytes as f64),
            step(|step| step.processor_seconds),
            step(|step| step.seconds),
            row.fields.join(" "),
            row.passes.join(" "),
        ];
        text += &(line(&cells) + "\n");
    }
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).map_err(failed)?;
    crate::output::durable::put(path, &[text.as_bytes()])
}

fn backend(choice: &Choice) -> &'static str {
    match choice {
        Choice::Cpu => "cpu f64",
        Choice::Cpu32 => "cpu f32",
        Choice::Auto | Choice::Gpu(_) => "gpu f32",
    }
}
