//! Marks as labels in a drawing of the picture's size, to be laid over it.

use super::Placed;
use std::fmt::Write;

/// Dark on a light rim, so that they are read on any picture.
const STYLE: &str = "\
  text { font-family: sans-serif; fill: #111; stroke: #fff; stroke-width: 0.2em; paint-order: stroke }
  .dot { fill: #111; stroke: #fff }
  .hidden { fill-opacity: 0.5 }
  .dot.hidden { fill: none; stroke: #111 }";

/// The drawing; `picture`: the way from it to the picture.
pub fn svg(placed: &Placed, picture: Option<String>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = draw(placed, picture, &mut out);
    out
}

fn draw(placed: &Placed, picture: Option<String>, out: &mut String) -> std::fmt::Result {
    let [width, height] = placed.size;
    let size = f64::from(width.min(height)) / 20.0;
    write!(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" ")?;
    writeln!(out, "width=\"{width}\" height=\"{height}\">")?;
    writeln!(out, "<!-- tracer marks -->\n<style>\n{STYLE}\n</style>")?;
    writeln!(out, "<title>{}</title>", escaped(&placed.scene))?;
    if let Some(picture) = picture {
        writeln!(out, "<image href=\"{}\" width=\"{width}\" height=\"{height}\"/>", escaped(&picture))?;
    }
    writeln!(out, "<g font-size=\"{size:.2}\" stroke-width=\"{:.2}\">", size / 12.0)?;
    for mark in &placed.marks {
        let (label, unseen) = (mark.label(), mark.unseen(placed.size));
        let (Some([x, y]), true) = (mark.pixel, unseen.is_none_or(|why| why.starts_with("behind"))) else {
            writeln!(out, "<desc>{}: {}</desc>", escaped(&label), unseen.unwrap_or_default())?;
            continue;
        };
        let class = if unseen.is_some() { " hidden" } else { "" };
        writeln!(out, "<circle class=\"dot{class}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\"/>", size / 6.0)?;
        // Above and to the right, but to the left where that would leave the picture.
        let letters = label.chars().count() as f64;
        let (side, anchor) =
            if x + size * (0.6 * letters + 0.4) > f64::from(width) { (-0.4, "end") } else { (0.4, "start") };
        let base = (y - 0.4 * size).max(size);
        writeln!(
            out,
            "<text class=\"label{class}\" x=\"{:.2}\" y=\"{base:.2}\" text-anchor=\"{anchor}\">{}</text>",
            x + side * size,
            escaped(&label)
        )?;
    }
    writeln!(out, "</g>\n</svg>")
}

/// As XML has it, in quotes, too.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    // XML has no control characters, not even escaped.
    text.replace(|c: char| c.is_control(), " ")
}
