//! Marks as coordinates of TikZ, in a node `picture` that shows the picture, however large it is.

use super::Placed;
use crate::failure::Failure;
use std::fmt::Write;

/// What ends or divides a coordinate's name, or is no letter to TeX.
const NOT_IN_NAMES: &[char] =
    &['.', ',', ':', ';', '(', ')', '[', ']', '{', '}', '\\', '%', '#', '$', '&', '~', '^', '"'];

/// The coordinates.
///
/// # Errors
/// That a mark has a name that TikZ does not take.
pub fn tikz(placed: &Placed) -> Result<String, Failure> {
    if let Some(mark) = placed.marks.iter().find(|mark| mark.name.contains(NOT_IN_NAMES)) {
        let name = &mark.name;
        return Err(Failure::wrong(format!(
            "TikZ takes no coordinate called {name:?}; name the mark with letters, figures, spaces and hyphens"
        )));
    }
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(placed, &mut out);
    Ok(out)
}

fn write(placed: &Placed, out: &mut String) -> std::fmt::Result {
    let [width, height] = placed.size;
    let scene = placed.scene.replace(char::is_control, " ");
    writeln!(
        out,
        "% tracer marks: those of {scene} in its picture of {width} x {height} pixels, for \\usepackage{{tikz}}:"
    )?;
    writeln!(out, "%   \\begin{{tikzpicture}}")?;
    writeln!(out, "%     \\node[inner sep=0, outer sep=0] (picture) {{\\includegraphics[width=8cm]{{the picture}}}};")?;
    writeln!(out, "%     \\input{{this file}}")?;
    let first = placed.marks.iter().find(|mark| mark.pixel.is_some()).map_or_else(String::new, |mark| mark.label());
    writeln!(out, "%     \\draw ({first}) -- +(5mm,5mm) node[right] {{{first}}};")?;
    writeln!(out, "%   \\end{{tikzpicture}}")?;
    for mark in &placed.marks {
        let label = mark.label();
        if let Some(why) = mark.unseen(placed.size) {
            writeln!(out, "% {label}: {why}")?;
        }
        let Some([x, y]) = mark.pixel else { continue };
        let (right, up) = (x / f64::from(width), 1.0 - y / f64::from(height));
        writeln!(out, "\\path (picture.south west) -- (picture.south east) coordinate[pos={right:.6}] (mark x);")?;
        writeln!(out, "\\path (picture.south west) -- (picture.north west) coordinate[pos={up:.6}] (mark y);")?;
        writeln!(out, "\\coordinate ({label}) at (mark x |- mark y);")?;
    }
    Ok(())
}
