//! Fields that patterns and their mappings have in other programs, and how they are said here.

use super::elsewhere::{Fields, numbers, vector};
use super::figures::{evenly, map};
use super::{Reader, describe};
use crate::codes;
use crate::desc::is_texture;
use crate::diagnostic::{Diagnostic, Edit};
use crate::schema::{EnumDef, StructDef};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// Whether these are the fields of a pattern: two colours, and how it lies.
fn is_pattern(def: &'static StructDef) -> bool {
    is_texture(def.name) && def.field("a").is_some()
}

/// Whether these are the fields of a mapping itself.
pub(super) fn is_mapping(def: &'static StructDef) -> bool {
    matches!(def.name, "Uv" | "Planar" | "Spherical" | "Triplanar" | "Object" | "World") && def.field("scale").is_some()
}

/// The mapping by which a pattern is scaled, and how many numbers it takes for each axis.
fn scaled_by(def: &'static StructDef) -> (&'static str, usize) {
    if matches!(def.name, "Noise" | "Wood" | "Marble" | "Voronoi") { ("Object", 3) } else { ("Uv", 2) }
}

/// `Object(scale: 4)`, or in TOML and JSON `{ Object = { scale = 4 } }`.
fn mapping(kind: &str, field: &str, value: &str, syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => format!("{kind}({field}: {value})"),
        syntax => syntax.of_toml(format!("{{ {kind} = {{ {field} = {value} }} }}")).into_owned(),
    }
}

/// A field of a pattern that belongs to its mapping: what is told, and what to write for name and value where that is
/// certain.
pub(super) fn of_mapping(
    name: &str,
    value: Item<'_, '_>,
    item: Item<'_, '_>,
    def: &'static StructDef,
) -> Option<(String, Option<String>)> {
    // Of pictures as well.
    if !is_texture(def.name) || def.field("mapping").is_none() {
        return None;
    }
    let (kind, axes) = scaled_by(def);
    let syntax = value.syntax();
    let field = match name.to_ascii_lowercase().as_str() {
        "scale" | "frequency" | "freq" | "density" | "tiling" | "tiles" | "count" | "fineness" | "repeat" => "scale",
        "offset" | "translate" | "translation" | "shift" | "position" | "origin" => "offset",
        "rotate" | "rotation" | "angle" if kind == "Uv" => "rotation",
        "uscale" | "vscale" | "u_scale" | "v_scale" | "su" | "sv" | "udelta" | "vdelta" | "to_uv" if kind == "Uv" => {
            let written = match syntax {
                Syntax::Ron => "Uv(scale: (u, v), offset: (u, v))".into(),
                syntax => syntax.of_toml("{ Uv = { scale = [u, v], offset = [u, v] } }"),
            };
            return Some((format!("its `mapping` says how it lies: {written}"), None));
        }
        "size" | "cell_size" | "period" | "spacing" | "wavelength" => {
            let written = mapping(kind, "scale", "..", syntax);
            return Some((format!("its `mapping` says how fine it is: {written}, one over the size of a cell"), None));
        }
        "rotate" | "rotation" | "angle" | "transform" | "direction" | "orientation" | "grain" | "normal"
            if def.field("axis").is_some_and(|axis| axis.rule.direction) =>
        {
            let (name, x) = (Fields(syntax).name("axis"), vector(value, &["1", "0", "0"]));
            return Some((format!("its direction is `axis`: `{name}{x}`; or it turns with its object"), None));
        }
        "rotate" | "rotation" | "angle" | "transform" | "direction" | "orientation" | "axis" => {
            let turn = match syntax {
                Syntax::Ron => "transform: [Rotate(axis: (0, 0, 1), degrees: 90)]".into(),
                syntax => syntax.of_toml("transform = [{ Rotate = { axis = [0, 0, 1], degrees = 90 } }]"),
            };
            return Some((format!("a pattern turns with its object: `{turn}`"), None));
        }
        _ => return None,
    };
    let count = numbers(value).map(|numbers| numbers.len());
    let number = matches!(value.kind(), Kind::Integer | Kind::Float);
    let certain = match field {
        "scale" => number || count == Some(axes),
        "offset" => count == Some(axes),
        _ => number,
    };
    let written = item.fields().any(|(key, _)| key.text() == "mapping");
    let shown = if certain { value.lexeme() } else { ".." };
    let mended = mapping(kind, field, shown, syntax);
    if written {
        return Some((format!("it belongs to its `mapping`: {mended}"), None));
    }
    let mended = format!("{}{mended}", Fields(syntax).name("mapping"));
    // In POV-Ray `scale` is how large a pattern is: below 1 it is finer there, and coarser here.
    if let ("scale", "Object", Some(finer)) = (name, kind, finer(value)) {
        let finer = format!("{}{}", Fields(syntax).name("mapping"), mapping(kind, field, &finer, syntax));
        let size = value.lexeme();
        return Some((
            format!(
                "write `{finer}` for a pattern of {size} of the size, as in POV-Ray, or `{mended}` for so many cells \
                 along a unit of length"
            ),
            None,
        ));
    }
    let more = match (field, kind) {
        ("scale", "Object") => ": so many cells along a unit of length",
        ("scale", _) => ": so many along each side",
        _ => "",
    };
    Some((format!("write `{mended}`{more}"), certain.then_some(mended)))
}

/// One over a size below 1, as it is best written, for each axis where there are three.
fn finer(value: Item<'_, '_>) -> Option<String> {
    let over = |size: f64| {
        let exact = 1.0 / size;
        let near = (exact * 1000.0).round() / 1000.0;
        format!("{near}")
    };
    if let Some(size) = value.number() {
        return (size > 0.0 && size < 1.0).then(|| over(size));
    }
    let sizes: Option<Vec<f64>> = value.children().take(4).map(|child| child.number()).collect();
    let sizes = sizes.filter(|sizes| sizes.len() == 3 && sizes.iter().all(|size| *size > 0.0))?;
    let inverse: Vec<String> = sizes.iter().map(|size| over(*size)).collect();
    let inverse: Vec<&str> = inverse.iter().map(String::as_str).collect();
    sizes.iter().any(|size| *size < 1.0).then(|| vector(value, &inverse))
}

/// What is said of other fields that patterns do not have.
pub(super) fn of_pattern(name: &str, def: &'static StructDef) -> Option<&'static str> {
    if def.name == "ColorRamp" && matches!(name, "mapping" | "scale" | "offset") {
        return Some("it lies nowhere itself: its `input` has a `mapping`, Noise(mapping: Object(scale: 2))");
    }
    if !is_pattern(def) {
        return None;
    }
    let bent = def.field("distortion").is_some();
    let noise = def.name == "Noise";
    Some(match name {
        "color_map" | "colour_map" | "colormap" | "color_ramp" | "colorramp" | "ramp" | "stops" | "palette"
        | "colors" | "colours" | "gradient" | "map" | "pigment" | "pigment_map" => {
            "a pattern goes from `a` to `b`; steps between are a ramp about it: ColorRamp(input: Noise(..), stops: [\
             (at: 0, color: 0.1), (at: 1, color: 0.9)])"
        }
        "color" | "colour" | "albedo" | "base_color" | "texture" => "a pattern has two colours: `a` and `b`",
        "mapping" | "scale" | "offset" => {
            "it lies nowhere itself: what it is made of has a `mapping`, Noise(mapping: Object(scale: 2))"
        }
        "turbulence" | "billow" | "billows" | "ridged" | "abs" if noise => {
            "billows with dark creases are `kind: Turbulence`"
        }
        "distortion" | "warp" if noise => "noise is not bent: leave it out; noise bends Marble(..) and Wood(..)",
        "contrast" | "brightness" | "strength" | "intensity" | "amplitude" | "threshold" if noise => {
            "its values lie in the middle between its colours: for more contrast take `a` darker and `b` lighter"
        }
        "octaves" | "detail" | "levels" | "omega" | "lambda" | "roughness" | "gain" | "lacunarity" if bent => {
            "the noise that bends it is always the same: how far it bends is `distortion`"
        }
        "seed" | "random_seed" => {
            "there is no seed: another `offset` of the mapping gives another piece of the pattern"
        }
        "opacity" | "alpha" => "patterns are opaque: leave it out",
        _ => return None,
    })
}

impl Reader<'_> {
    /// Colours alone where stops stand, or the name of a map of them: reports it, and says that it did.
    pub(crate) fn stops_elsewhere(&mut self, item: Item<'_, '_>) -> bool {
        let mut children = item.children();
        let is_stop = |child: Item<'_, '_>| child.kind() == Kind::Struct || child.kind() == Kind::Map;
        // Hardly any ramp has other ones.
        let is_list = item.kind() == Kind::List && children.next().is_some_and(|first| !is_stop(first));
        let is_name = item.kind() == Kind::Text;
        let Some(mended) = (is_list.then(|| evenly(item))).or_else(|| is_name.then(|| map(item))).flatten() else {
            return false;
        };
        let message = "a stop has a number, `at`, and a colour";
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected("stops: `at` and `color` of each")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }

    /// A stop of a ramp that is written without names: reports it, and says that it did.
    pub(crate) fn stop_elsewhere(&mut self, item: Item<'_, '_>) -> bool {
        if !matches!(item.kind(), Kind::Tuple | Kind::List) || item.name().is_some() {
            return false;
        }
        let mut children = item.children();
        let (Some(at), Some(color), None) = (children.next(), children.next(), children.next()) else { return false };
        let (at, color) = (at.lexeme(), color.lexeme());
        let mended = match item.syntax() {
            Syntax::Ron => format!("(at: {at}, color: {color})"),
            syntax => syntax.of_toml(format!("{{ at = {at}, color = {color} }}")).into_owned(),
        };
        let message = "the values of a stop are written with their names";
        let mut fault = Diagnostic::error(codes::MISSING_NAME, item.head(), message)
            .expected("a stop: `at` and `color`")
            .hint(format!("write `{mended}`"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }

    /// The word of a texture where its brackets are missing, small or of another program: reports it, and says that it
    /// did.
    pub(crate) fn texture_elsewhere(&mut self, item: Item<'_, '_>, def: &'static EnumDef) -> bool {
        let word = &*item.text();
        let same = def.variants.iter().find(|variant| variant.name.eq_ignore_ascii_case(word)).map(|found| found.name);
        let kind = same.or_else(|| super::hints::kind_elsewhere(word, def));
        let message = format!("a colour cannot be {}", describe(item));
        let fault = Diagnostic::error(codes::WRONG_TYPE, item.span(), message);
        if let Some(kind) = kind {
            let mended = match (kind, item.syntax()) {
                ("Texture", Syntax::Ron) => "Texture(file: \"picture.png\")".into(),
                ("Texture", syntax) => syntax.of_toml("{ Texture = { file = \"picture.png\" } }"),
                ("ColorRamp", Syntax::Ron) => "ColorRamp(input: Noise(), stops: [..])".into(),
                ("ColorRamp", syntax) => syntax.of_toml("{ ColorRamp = { input = { Noise = {} }, stops = [..] } }"),
                (_, Syntax::Ron) => format!("{kind}()").into(),
                (_, syntax) => syntax.of_toml(format!("{{ {kind} = {{}} }}")),
            };
            let mut fault = fault.expected("a colour, or a texture: kinds begin with capitals, and have brackets");
            fault.hint = format!("write {mended}");
            fault.edit = (!matches!(kind, "Texture" | "ColorRamp"))
                .then(|| Edit { span: item.span(), replacement: mended.into_owned() });
            self.report(fault);
            return true;
        }
        let Some(hint) = super::hints::other_kind(word, def) else { return false };
        self.report(fault.expected("a colour, or a texture: Noise(..), Texture(file: ..)").hint(hint));
        true
    }

    /// Numbers where a mapping stands: reports it, and says that it did.
    pub(super) fn mapping_elsewhere(&mut self, item: Item<'_, '_>, def: &'static EnumDef) -> bool {
        let solid = match def.name {
            "SolidMapping" => true,
            "MappingWords" => false,
            _ => return false,
        };
        let number = matches!(item.kind(), Kind::Integer | Kind::Float);
        let axes = if solid { 3 } else { 2 };
        let bare = item.name().is_none() && numbers(item).is_some_and(|numbers| numbers.len() == axes);
        if !number && !bare {
            return false;
        }
        let kind = if solid { "Object" } else { "Uv" };
        let mended = mapping(kind, "scale", item.lexeme(), item.syntax());
        let more = if solid { "so many cells along a unit of length" } else { "so many along each side" };
        let message = format!("a mapping says how a texture lies, and cannot be {}", describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected(super::choices(def, item.syntax()))
            .hint(format!("write {mended}: {more}"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }
}
