//! Colours in a text: for swatches beside them, and to write another one in their place.

use super::visit::{tree, visit};
use crate::read::hex_color;
use crate::schema::Type;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};
use std::ops::Range;

/// A colour and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorPlace {
    /// The value.
    pub range: Range<usize>,
    /// Linear RGB.
    pub linear: [f64; 3],
}

/// All colours that are written as such; what is brighter than white is none that a screen could show.
pub fn colors(text: &str, syntax: Syntax) -> Vec<ColorPlace> {
    let tree = tree(text, syntax);
    let mut found = Vec::new();
    visit(&tree, &mut |visit| {
        let is_color = match visit.kind {
            Type::Color => true,
            Type::OneOf(kinds) => kinds.iter().any(|kind| matches!(kind, Type::Color)),
            // A var may be anything: three numbers may be a point.
            Type::Value => visit.item.kind() == Kind::Text,
            _ => false,
        };
        if let Some(linear) = is_color.then(|| color(visit.item)).flatten()
            && linear.iter().all(|channel| (0.0..=1.0).contains(channel))
        {
            found.push(ColorPlace { range: super::hover::range(visit.item.span()), linear });
        }
    });
    found
}

fn color(item: Item<'_, '_>) -> Option<[f64; 3]> {
    match item.kind() {
        Kind::Text => hex_color(&item.text()),
        _ => item.three_numbers(),
    }
}

/// How a colour may be written: as `"#rrggbb"`, and as three linear numbers.
pub fn color_texts(linear: [f64; 3], syntax: Syntax) -> [String; 2] {
    let code = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 };
        (encoded * 255.0).round() as u8
    };
    let [r, g, b] = linear.map(code);
    let digits = |x: f64| crate::print::number((x * 1e4).round() / 1e4);
    let [x, y, z] = linear.map(digits);
    let numbers = match syntax {
        Syntax::Ron => format!("({x}, {y}, {z})"),
        Syntax::Toml | Syntax::Json => format!("[{x}, {y}, {z}]"),
    };
    [format!("\"#{r:02x}{g:02x}{b:02x}\""), numbers]
}
