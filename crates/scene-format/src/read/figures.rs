//! Fields of programs that draw figures of data: heads of arrows, heights in a list, colour maps.

use super::colors_elsewhere::color_alone;
use super::elsewhere::{Fields, whole_field};
use super::together::Together;
use super::unknown::Unknown;
use super::value::is_picture;
use super::vars::is_expression;
use crate::desc::is_texture;
use crate::diagnostic::Edit;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// Colour maps of matplotlib (CC0), and the two of ParaView and VTK: five of their colours, evenly apart.
const MAPS: [(&str, [&str; 5]); 6] = [
    ("viridis", ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"]),
    ("plasma", ["#0d0887", "#7e03a8", "#cc4778", "#f89540", "#f0f921"]),
    ("magma", ["#000004", "#51127c", "#b73779", "#fc8961", "#fcfdbf"]),
    ("inferno", ["#000004", "#57106e", "#bc3754", "#f98e09", "#fcffa4"]),
    ("coolwarm", ["#3b4cc0", "#8db0fe", "#dddcdc", "#f49a7b", "#b40426"]),
    ("gray", ["#000000", "#404040", "#808080", "#bfbfbf", "#ffffff"]),
];

/// What fields for a colour map are called.
const OF_MAPS: [&str; 8] = ["colormap", "cmap", "colourmap", "color_map", "colour_map", "lut", "palette", "colorscale"];

/// Names of fields for heights that are no picture's.
const HEIGHTS: [&str; 14] = [
    "heights",
    "height_data",
    "function",
    "z",
    "zs",
    "data",
    "array",
    "values",
    "grid",
    "f",
    "expression",
    "equation",
    "formula",
    "elevations",
];

/// More colours than these are no map.
const MOST: usize = 64;

/// What is said of such a field.
pub(super) fn of(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    head_of_arrow(unknown)
        .or_else(|| heights(unknown))
        .or_else(|| reach(unknown))
        .or_else(|| stops_of_ramp(unknown))
        .or_else(|| map_of_surface(unknown))
        .or_else(|| width_of_view(unknown))
}

impl Unknown<'_, '_, '_> {
    fn has(&self, field: &str) -> bool {
        // More fields than these are no scene.
        self.item.fields().take(64).any(|(key, _)| key.text() == field)
    }

    /// What is to be written for name and value.
    fn instead(&self, mended: String, fields: Vec<&'static str>) -> Option<Together> {
        let hint = Some(format!("write `{mended}`"));
        let edit = Some(Edit { span: whole_field(self.key, self.value), replacement: mended });
        Some(Together { hint, edit, fields })
    }
}

fn told(hint: impl Into<String>, fields: Vec<&'static str>) -> Option<Together> {
    Some(Together { hint: Some(hint.into()), edit: None, fields })
}

/// A length of the head, where it may be one of two: a point is where the arrow ends.
fn head_of_arrow(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, value, def, .. } = unknown;
    let is_number = value.number().is_some();
    if def.name != "Arrow" || !is_number && !is_expression(value) {
        return None;
    }
    let write = |field: &str| format!("{}{}", Fields(value.syntax()).name(field), value.lexeme());
    match name {
        "head" | "tip" | "head_size" | "headsize" | "tip_size" | "arrowhead" | "cone" => {
            let (length, radius) = (write("head_length"), write("head_radius"));
            told(format!("write `{length}` for how long its head is, `{radius}` for how thick"), Vec::new())
        }
        "head_width" | "headwidth" | "head_diameter" | "tip_diameter" | "tip_width" => {
            let half = value.number()? / 2.0;
            unknown.instead(format!("{}{half}", Fields(value.syntax()).name("head_radius")), Vec::new())
        }
        _ => None,
    }
}

/// Heights of a landscape that stand in no file.
fn heights(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, value, def, .. } = unknown;
    if def.name != "HeightField" || !HEIGHTS.contains(&name) || unknown.has("file") {
        return None;
    }
    if value.kind() == Kind::Text && is_picture(&value.text()) {
        return unknown.instead(format!("{}{}", Fields(value.syntax()).name("file"), value.lexeme()), vec!["file"]);
    }
    told(HEIGHTS_ARE, vec!["file"])
}

/// Where heights come from.
pub(super) const HEIGHTS_ARE: &str = "heights are a picture's, an EXR or a grey PNG of 16 bits: \
     HeightField(file: \"heights.exr\", size: (6, 1, 6)); by a rule it is a mesh, here of 20 by 20 points: \
     Mesh(points: [Repeat(count: 400, items: [(\"=i % 20\", \"=sin(40*(i % 20))\", \"=floor(i/20)\")])], \
     faces: [Repeat(count: 361, items: [[\"=i + floor(i/19)\", \"=i + floor(i/19) + 20\", \"=i + floor(i/19) + 21\", \
     \"=i + floor(i/19) + 1\"]])])";

/// How far a landscape reaches, as a factor of what it is elsewhere.
fn reach(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, value, def, .. } = unknown;
    if def.name != "HeightField" || !matches!(name, "scale" | "scaling" | "spacing") || unknown.has("size") {
        return None;
    }
    let bare = matches!(value.kind(), Kind::Tuple | Kind::List) && value.name().is_none();
    if bare && value.children().take(4).count() == 3 && name != "spacing" {
        return unknown.instead(format!("{}{}", Fields(value.syntax()).name("size"), value.lexeme()), vec!["size"]);
    }
    let way = match value.syntax() {
        Syntax::Ron => "size: (6, 1, 6)".into(),
        syntax => syntax.of_toml("size = [6, 1, 6]"),
    };
    told(format!("how far it reaches along x, how high white is, and along z is `{way}`"), vec!["size"])
}

/// Colours of a ramp alone, evenly apart, or the name of a map of them.
fn stops_of_ramp(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, value, def, .. } = unknown;
    let is_one = OF_MAPS.contains(&name) || matches!(name, "colors" | "colours" | "map" | "name" | "values");
    if def.name != "ColorRamp" || !is_one || unknown.has("stops") {
        return None;
    }
    let stops = evenly(value).or_else(|| map(value))?;
    unknown.instead(format!("{}{stops}", Fields(value.syntax()).name("stops")), vec!["stops"])
}

/// A colour map or a list of colours where a surface has a material, or a material a colour.
fn map_of_surface(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, value, def, .. } = unknown;
    let has = |field: &str| def.field(field).is_some();
    let along = def.name == "Tube" && matches!(name, "colors" | "colours" | "vertex_colors" | "point_colors");
    if !OF_MAPS.contains(&name) && !along {
        return None;
    }
    let syntax = value.syntax();
    let stops = if along { evenly(value) } else { map(value).or_else(|| evenly(value)) };
    let ramp = match &stops {
        Some(stops) => ramp("Gradient", stops, syntax),
        None if along => ramp("Gradient", &even(&["0.1".to_owned(), "0.9".to_owned()], syntax), syntax),
        None => return None,
    };
    let write = |field: &str, value: &str| format!("{}{value}", Fields(syntax).name(field));
    if has("material") && has("transform") {
        let mended = write("material", &super::colors_elsewhere::diffuse(&ramp, syntax));
        // Along a tube there is nothing else for a ramp to go by; elsewhere numbers may be meant.
        return match unknown.has("material") || stops.is_none() || !along {
            false => unknown.instead(mended, Vec::new()),
            true => {
                told(format!("colours belong to a material, here from one end (v is 0) on: `{mended}`"), Vec::new())
            }
        };
    }
    if has("albedo") && !unknown.has("albedo") {
        return told(
            format!("a colour map goes by another texture, here from 0 to 1 of v: `{}`", write("albedo", &ramp)),
            vec!["albedo"],
        );
    }
    if is_texture(def.name) && has("a") {
        let ramp = self::ramp(def.name, stops.as_deref()?, syntax);
        return told(format!("a pattern goes from `a` to `b`; with more colours it is in a ramp: {ramp}"), Vec::new());
    }
    None
}

/// A ramp of these stops over a pattern.
fn ramp(input: &str, stops: &str, syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => format!("ColorRamp(input: {input}(), stops: {stops})"),
        syntax => {
            let input = syntax.of_toml(format!("{{ {input} = {{}} }}")).into_owned();
            let (of, at) = (Fields(syntax).name("input"), Fields(syntax).name("stops"));
            let kind = Fields(syntax).name("ColorRamp");
            format!("{{ {kind}{{ {of}{input}, {at}{stops} }} }}")
        }
    }
}

/// The stops of a list of colours alone; `None` where one of them is none.
pub(super) fn evenly(value: Item<'_, '_>) -> Option<String> {
    if !matches!(value.kind(), Kind::List | Kind::Tuple) || value.name().is_some() {
        return None;
    }
    let colors: Option<Vec<String>> = value.children().take(MOST + 1).map(color_alone).collect();
    let colors = colors.filter(|colors| (2..=MOST).contains(&colors.len()))?;
    Some(even(&colors, value.syntax()))
}

/// The stops of a map that has a name.
pub(super) fn map(value: Item<'_, '_>) -> Option<String> {
    let colors = map_of(&value.text()).filter(|_| matches!(value.kind(), Kind::Text | Kind::Word))?;
    Some(even(&colors.map(|color| format!("\"{color}\"")), value.syntax()))
}

/// The colours of a map by its name, which may have a library before it: `cm.viridis`.
fn map_of(name: &str) -> Option<[&'static str; 5]> {
    let name = name.rsplit('.').next().unwrap_or(name);
    MAPS.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)).map(|(_, colors)| *colors)
}

/// The ramp of a colour map whose name stands where a texture does.
pub(super) fn ramp_of_map(name: &str, syntax: Syntax) -> Option<String> {
    let colors = map_of(name)?.map(|color| format!("\"{color}\""));
    Some(ramp("Gradient", &even(&colors, syntax), syntax))
}

fn even(colors: &[String], syntax: Syntax) -> String {
    let last = colors.len().saturating_sub(1).max(1) as f64;
    let at = |k: usize| (k as f64 / last * 1e4).round() / 1e4;
    let stop = |(k, color): (usize, &String)| match syntax {
        Syntax::Ron => format!("(at: {}, color: {color})", at(k)),
        syntax => syntax.of_toml(format!("{{ at = {}, color = {color} }}", at(k))).into_owned(),
    };
    format!("[{}]", colors.iter().enumerate().map(stop).collect::<Vec<String>>().join(", "))
}

/// A camera of parallel rays that a field tells, and how much it shows, which stands beside that elsewhere.
fn width_of_view(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, value, item, def, .. } = unknown;
    let is_kind = |name: &str| matches!(name, "type" | "kind" | "camera_type" | "projection");
    let is_view = |name: &str| matches!(name, "width" | "height" | "scale" | "ortho_scale" | "size" | "view_height");
    if def.name != "Camera" || !is_kind(name) && !is_view(name) {
        return None;
    }
    let find = |is: &dyn Fn(&str) -> bool| item.fields().take(32).find(|(key, _)| is(&key.text()));
    let (key, kind) = find(&is_kind)?;
    let word = kind.name().map_or_else(|| kind.text(), Into::into);
    if !["orthographic", "ortho", "parallel"].iter().any(|known| word.eq_ignore_ascii_case(known)) {
        return None;
    }
    // What is told of its kind tells of this.
    if !is_kind(name) && key.text() != "projection" {
        return Some(Together { hint: None, edit: None, fields: Vec::new() });
    }
    let height = find(&|name| matches!(name, "height" | "view_height" | "ortho_scale")).map(|(_, height)| height);
    let height = height.filter(|height| height.number().is_some()).map_or("8", |height| height.lexeme());
    let way = match value.syntax() {
        Syntax::Ron => format!("projection: Orthographic(height: {height})"),
        syntax => {
            let kind = syntax.of_toml(format!("{{ Orthographic = {{ height = {height} }} }}")).into_owned();
            format!("{}{kind}", Fields(syntax).name("projection"))
        }
    };
    told(format!("write `{way}`: its height is how much of the scene it shows, from below to above"), Vec::new())
}
