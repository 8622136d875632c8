//! Words in a picture, over several lines.

use super::canvas::{self, Align, Canvas};

/// Lines of words no wider than this, in pixels.
pub(super) fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if canvas::width(&format!("{line} {word}"), size) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

/// Writes lines from the top down; gives where the next would begin.
pub(super) fn paragraph(canvas: &mut Canvas, lines: &[String], [left, top]: [f64; 2], size: f64, bold: bool) -> f64 {
    let colour = if bold { canvas::INK } else { canvas::PALE_INK };
    for (k, line) in lines.iter().enumerate() {
        canvas.text(line, [left, top + (k as f64 + 0.5) * 1.3 * size], size, colour, Align::Left, bold);
    }
    top + 1.3 * size * lines.len() as f64
}
