//! A page that holds all it shows: one HTML file, which needs no network and runs no script.

use super::Picture;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use std::fmt::Write as _;
use std::io::Cursor;
use std::path::Path;

#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    pub columns: Vec<String>,
    /// Numbers are set to the right.
    pub rows: Vec<Vec<String>>,
}

#[derive(Debug, Clone, Default)]
pub struct Section {
    pub heading: String,
    pub text: Vec<String>,
    pub pictures: Vec<Picture>,
    /// What each shows, in words, and its pixels.
    pub images: Vec<(String, image::RgbaImage)>,
    pub table: Option<Table>,
}

#[derive(Debug, Clone, Default)]
pub struct Page {
    pub title: String,
    pub lead: String,
    pub sections: Vec<Section>,
}

/// Wide screens get two pictures side by side; narrow ones get wide tables to scroll, not the page.
const STYLE: &str = "\
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 1140px; padding: 16px; background: #fff; color: #212429;
  font: 16px/1.5 system-ui, 'DejaVu Sans', sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.25; } h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; }
p { max-width: 46rem; overflow-wrap: anywhere; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 460px), 1fr)); gap: 16px; }
figure { margin: 0; } figure svg, figure img { display: block; width: 100%; height: auto; }
figure { border: 1px solid #e4e7ea; border-radius: 6px; overflow: hidden; }
figcaption { padding: 4px 12px 8px; font-size: .9rem; color: #5c626a; }
.table { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; margin: 8px 0; }
th, td { padding: 4px 10px; text-align: left; border-bottom: 1px solid #e4e7ea; white-space: nowrap; }
td.words { white-space: normal; min-width: 12rem; } td.number { text-align: right; font-variant-numeric: tabular-nums; }
";

/// Letters from which a cell is prose, which may break its lines.
const PROSE: usize = 32;

impl Page {
    /// Writes the page aside and renames it, so that a kill never leaves half a page.
    ///
    /// # Errors
    /// A picture that cannot be drawn, or the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let text = self.html()?;
        let place = |error: std::io::Error| format!("cannot write {}: {error}", path.display());
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(place)?;
        }
        crate::output::durable::put(path, &[text.as_bytes()])
    }

    /// # Errors
    /// A picture that cannot be drawn.
    pub fn html(&self) -> Result<String, String> {
        let title = escaped(&self.title);
        let mut out = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
             <link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
        );
        paragraphs(&mut out, std::slice::from_ref(&self.lead));
        for section in &self.sections {
            section.write(&mut out)?;
        }
        Ok(out + "</body>\n</html>\n")
    }
}

impl Section {
    fn write(&self, out: &mut String) -> Result<(), String> {
        let _ = writeln!(out, "<h2>{}</h2>", escaped(&self.heading));
        paragraphs(out, &self.text);
        let parts: Vec<&Picture> = self.pictures.iter().flat_map(Picture::parts).collect();
        if !(parts.is_empty() && self.images.is_empty()) {
            out.push_str("<div class=\"pictures\">\n");
            for (words, image) in &self.images {
                let (words, data) = (escaped(words), BASE64_STANDARD.encode(png(image)?));
                let source = format!("data:image/png;base64,{data}");
                let _ = writeln!(out, "<figure><img alt=\"{words}\" src=\"{source}\"><figcaption>{words}</figcaption></figure>");
            }
            for part in parts {
                let svg = part.svg()?;
                // The size in the file is that of a picture alone; here it follows the page.
                let named = format!("<svg role=\"img\" aria-label=\"{}\" ", escaped(&part.title()));
                let _ = writeln!(out, "<figure>{}</figure>", svg.trim().replacen("<svg ", &named, 1));
            }
            out.push_str("</div>\n");
        }
        if let Some(table) = &self.table {
            table.write(out);
        }
        Ok(())
    }
}

impl Table {
    fn write(&self, out: &mut String) {
        out.push_str("<div class=\"table\"><table>\n<thead><tr>");
        for name in &self.columns {
            let _ = write!(out, "<th>{}</th>", escaped(name));
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for cell in row {
                let _ = write!(out, "<td{}>{}</td>", class(cell), escaped(cell));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody>\n</table></div>\n");
    }
}

fn class(cell: &str) -> &'static str {
    let number = cell.trim_end_matches(['%', ' ']);
    match cell {
        _ if number.parse::<f64>().is_ok() => " class=\"number\"",
        _ if cell.chars().count() > PROSE => " class=\"words\"",
        _ => "",
    }
}

fn paragraphs(out: &mut String, text: &[String]) {
    for paragraph in text.iter().filter(|paragraph| !paragraph.is_empty()) {
        let _ = writeln!(out, "<p>{}</p>", escaped(paragraph));
    }
}

fn png(image: &image::RgbaImage) -> Result<Vec<u8>, String> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).map_err(|error| format!("cannot encode a picture: {error}"))?;
    Ok(bytes.into_inner())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
