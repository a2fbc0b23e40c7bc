//! Values as other programs and languages write them, and how they are written here: `vec3(0, 1, 6)`, `material: red`.

use super::Reader;
use super::colors_elsewhere::numbers_in_text;
use super::kinds_elsewhere::two_of_a_pattern;
use super::pattern_fields::is_mapping;
use super::shape_fields::one_ring;
use super::value::{hex_color, is_picture};
use crate::codes;
use crate::desc::{Material, is_texture};
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::expression::TEMPERATURES;
use crate::schema::{FieldDef, StructDef};
use crate::syntax::{Syntax, decode};
use crate::tree::{Item, Kind};

/// `5000K`: the expression of that colour, where more than 1 may stand, which its red is.
pub(super) fn of_kelvins(text: &str, at: &FieldDef) -> Option<String> {
    let kelvin = text.trim().strip_suffix(['K', 'k'])?.trim_end();
    let fits = at.rule.range.high != 1.0 && TEMPERATURES.contains(&decode::number(kelvin));
    fits.then(|| format!("\"=blackbody({kelvin})\""))
}

/// Numbers in the brackets of the syntax.
pub(super) fn vector(item: Item<'_, '_>, numbers: &[&str]) -> String {
    match item.syntax() {
        Syntax::Ron => format!("({})", numbers.join(", ")),
        Syntax::Toml | Syntax::Json => format!("[{}]", numbers.join(", ")),
    }
}

/// A number as it is best written: `90` for 90.00021045914971, who writes 1.5708 means it.
fn rounded(value: f64) -> String {
    let near = (value * 100.0).round() / 100.0;
    if (value - near).abs() < 1e-3 * value.abs().max(1.0) { format!("{near}") } else { format!("{value}") }
}

/// Radians as degrees: a multiple of 15 where the digits that are written, three or more, are its own.
pub(super) fn degrees(radians: f64, written: &str) -> String {
    let fraction = written.split_once('.').map_or("", |(_, fraction)| fraction);
    let significant = written.trim_start_matches(['-', '+', '0', '.']).bytes().filter(u8::is_ascii_digit).count();
    let plain = written.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+'));
    let near = (radians.to_degrees() / 15.0).round() * 15.0;
    let same = format!("{:.*}", fraction.len(), near.to_radians()) == format!("{radians:.*}", fraction.len());
    if plain && significant >= 3 && same { format!("{near}") } else { rounded(radians.to_degrees()) }
}

/// The rows of a matrix that a transform is made of alone, as the camera has them.
fn rows_of(value: Item<'_, '_>) -> Option<String> {
    let mut children = value.children();
    let only = match value.kind() {
        Kind::List if value.name().is_none() => children.next().filter(|_| children.next().is_none())?,
        _ => value,
    };
    if only.name() != Some("Matrix") {
        return None;
    }
    let named = only.fields().find(|(key, _)| key.text() == "rows").map(|(_, rows)| rows.lexeme().to_owned());
    let mut inner = only.children();
    let mut listed = || inner.next().and_then(matrix_rows).or_else(|| matrix_rows(only));
    named.or_else(|| listed().and_then(|rows| rows.strip_prefix("rows: ").map(str::to_owned)))
}

/// The numbers within brackets as they are written; `None` where there is anything else.
pub(super) fn numbers<'s>(item: Item<'_, 's>) -> Option<Vec<&'s str>> {
    let numbers: Option<Vec<&str>> =
        item.children().take(20).map(|child| child.number().map(|_| child.lexeme())).collect();
    numbers.filter(|numbers| !numbers.is_empty())
}

/// The rows of a matrix of twelve numbers in one list.
pub(super) fn matrix_rows(item: Item<'_, '_>) -> Option<String> {
    let numbers = numbers(item).filter(|numbers| numbers.len() == 12)?;
    let rows: Vec<String> = numbers.chunks(4).map(|row| format!("({})", row.join(", "))).collect();
    Some(format!("rows: ({})", rows.join(", ")))
}

/// The values of these fields, all of them numbers and nothing else there.
pub(super) fn fields_named<'s, const N: usize>(item: Item<'_, 's>, names: [&str; N]) -> Option<[&'s str; N]> {
    let mut values = [None; N];
    for (key, value) in item.fields().take(N + 1) {
        let at = names.iter().position(|name| key.text().eq_ignore_ascii_case(name))?;
        values[at] = value.number().map(|_| value.lexeme());
    }
    let found: Vec<&str> = values.into_iter().flatten().collect();
    found.try_into().ok()
}

/// Channels by their names as a colour.
pub(super) fn channels(item: Item<'_, '_>) -> Option<String> {
    fields_named(item, ["r", "g", "b"]).map(|found| vector(item, &found))
}

/// The axis that a word names: `Y`, `-z`.
pub(super) fn axis(word: &str) -> Option<[&'static str; 3]> {
    let (one, letter) = match word.strip_prefix('-') {
        Some(letter) => ("-1", letter),
        None => ("1", word.trim_start_matches('+')),
    };
    match letter {
        "up" => Some(["0", one, "0"]),
        "down" if one == "1" => Some(["0", "-1", "0"]),
        "x" | "X" => Some([one, "0", "0"]),
        "y" | "Y" => Some(["0", one, "0"]),
        "z" | "Z" => Some(["0", "0", one]),
        _ => None,
    }
}

/// Words before the numbers of a vector or a colour.
pub(super) const VECTORS: [&str; 18] = [
    "vec3", "vec2", "vec", "vector", "vector3", "vector2", "float3", "float2", "double3", "point", "point3", "normal",
    "rgb", "srgb", "color", "colour", "color3", "tuple",
];

/// A vector or colour that is written in the way of another language: how it is written here.
pub(super) fn vector_elsewhere(item: Item<'_, '_>, at: &FieldDef, count: usize) -> Option<String> {
    if at.rule.color
        && count == 3
        && let Some(kelvin) = kelvin(item).filter(|kelvin| TEMPERATURES.contains(&decode::number(kelvin)))
    {
        return Some(format!("\"=blackbody({kelvin})\""));
    }
    match item.kind() {
        Kind::Integer | Kind::Float => {
            grid(item, at).map(|found| vector(item, &found.each_ref().map(|number| &**number)))
        }
        Kind::Tuple => {
            let name = item.name()?.to_ascii_lowercase();
            if let ("hex" | "html" | "rgbhex", true, Some(hex)) = (&*name, at.rule.color, hex_of_call(item)) {
                return Some(format!("\"#{hex}\""));
            }
            let inner = numbers(item).filter(|numbers| numbers.len() == count && VECTORS.contains(&name.as_str()))?;
            Some(vector(item, &inner))
        }
        Kind::Struct | Kind::Map if item.syntax() == Syntax::Ron || item.lexeme().starts_with('{') => {
            let found = match count {
                2 => fields_named(item, ["x", "y"]).map(Vec::from),
                _ if at.rule.color => fields_named(item, ["r", "g", "b"]).map(Vec::from),
                _ => fields_named(item, ["x", "y", "z"]).map(Vec::from),
            };
            found.map(|found| vector(item, &found))
        }
        Kind::Text if let Some(mended) = numbers_in_text(item, count) => Some(mended),
        Kind::Word | Kind::Text | Kind::Char if at.rule.direction && count == 3 => {
            axis(&item.text()).map(|axis| vector(item, &axis))
        }
        _ => None,
    }
}

/// What one or two numbers of a grid of copies mean: so many on the ground, 9 being three times three, so far apart.
pub(super) fn grid(item: Item<'_, '_>, at: &FieldDef) -> Option<[String; 3]> {
    if !at.noun.ends_with("of a grid") {
        return None;
    }
    let one = || "1".to_owned();
    if let Some(number) = item.number() {
        let lexeme = item.lexeme().to_owned();
        let side = number.sqrt();
        return Some(match at.name {
            "count" if side.fract() == 0.0 => [format!("{side}"), one(), format!("{side}")],
            "count" => [lexeme, one(), one()],
            _ => [lexeme.clone(), lexeme.clone(), lexeme],
        });
    }
    let [across, deep] = <[&str; 2]>::try_from(numbers(item)?).ok()?;
    Some([across.to_owned(), one(), deep.to_owned()])
}

/// `position.x = 0` and so on, a line for each number in TOML: what to write.
pub(super) fn dotted(item: Item<'_, '_>, at: &FieldDef, count: usize) -> Option<String> {
    if item.syntax() != Syntax::Toml || item.kind() != Kind::Map || item.lexeme().starts_with('{') {
        return None;
    }
    let numbers = match count {
        2 => fields_named(item, ["x", "y"]).map(Vec::from),
        _ => fields_named(item, ["x", "y", "z"]).or_else(|| fields_named(item, ["r", "g", "b"])).map(Vec::from),
    };
    numbers.map(|numbers| format!("write {} = {} in one line", at.name, vector(item, &numbers)))
}

/// The temperature of `blackbody(2700)` or `Blackbody(temperature: 2700)`.
fn kelvin<'s>(item: Item<'_, 's>) -> Option<&'s str> {
    let name = item.name()?;
    if !["blackbody", "black_body", "kelvin"].iter().any(|known| name.eq_ignore_ascii_case(known)) {
        return None;
    }
    match item.kind() {
        Kind::Tuple => numbers(item).filter(|numbers| numbers.len() == 1).map(|numbers| numbers[0]),
        Kind::Struct => fields_named(item, ["temperature"]).map(|[kelvin]| kelvin),
        _ => None,
    }
}

/// The digits of `hex("ff0000")`.
fn hex_of_call(item: Item<'_, '_>) -> Option<String> {
    let mut children = item.children();
    let (only, None) = (children.next().filter(|only| only.kind() == Kind::Text)?, children.next()) else {
        return None;
    };
    let text = only.text();
    let digits = text.trim_start_matches('#').trim_start_matches("0x");
    (digits.len() == 6 && digits.bytes().all(|byte| byte.is_ascii_hexdigit())).then(|| digits.to_owned())
}

/// What may be written for a number: what stands in `Some(..)` or `float(..)`, and degrees for `radians(..)`.
pub(super) fn number_elsewhere(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    let mut children = item.children();
    let (Some(only), None) = (children.next(), children.next()) else { return None };
    let value = only.number()?;
    match item.name() {
        None | Some("Some" | "float" | "int" | "f32" | "f64" | "Number") => Some(only.lexeme().to_owned()),
        Some("deg" | "degrees") if at.rule.unit == "in degrees" => Some(only.lexeme().to_owned()),
        Some("rad" | "radians") if at.rule.unit == "in degrees" => {
            // `radians(50)` is how other languages say 50 degrees: they take radians.
            let fits = at.rule.range.contains(value.to_degrees());
            Some(if fits { degrees(value, only.lexeme()) } else { only.lexeme().to_owned() })
        }
        Some(_) => None,
    }
}

/// How fields are written in a syntax.
pub(super) struct Fields(pub Syntax);

impl Fields {
    /// A name with what joins it to its value.
    pub fn name(&self, field: &str) -> String {
        match self.0 {
            Syntax::Ron => format!("{field}: "),
            Syntax::Toml => format!("{field} = "),
            Syntax::Json => format!("\"{field}\": "),
        }
    }
}

/// A field that says by another quantity what one of ours says: ours, and what to write for both name and value.
pub(super) fn field_elsewhere(
    name: &str,
    value: Item<'_, '_>,
    def: &'static StructDef,
) -> Option<(Option<&'static str>, String)> {
    let name_of = |field: &str| Fields(value.syntax()).name(field);
    let convert = |field: &'static str, by: fn(f64) -> f64| {
        let mended = value.number().map(|number| format!("{}{}", name_of(field), rounded(by(number))));
        def.field(field).and(mended).map(|mended| (Some(field), mended))
    };
    match name {
        _ if let Some(mended) = one_ring(name, value, def) => Some((None, mended)),
        _ if let Some(mended) = two_of_a_pattern(name, value, def) => Some((None, mended)),
        "texture" | "map" | "map_kd" | "map_Kd" | "image" | "albedo_map" | "color_map" | "diffuse_texture"
            if def.field("albedo").is_some() && value.kind() == Kind::Text && is_picture(&value.text()) =>
        {
            let file = Fields(value.syntax()).name("file");
            let texture = match value.syntax() {
                Syntax::Ron => format!("Texture({file}{})", value.lexeme()),
                Syntax::Toml => format!("{{ Texture = {{ {file}{} }} }}", value.lexeme()),
                Syntax::Json => format!("{{ \"Texture\": {{ {file}{} }} }}", value.lexeme()),
            };
            Some((None, format!("{}{texture}", name_of("albedo"))))
        }
        // Of POV-Ray, where it is along the width.
        "angle" if def.name == "Camera" => {
            let axis = if value.syntax() == Syntax::Ron { "Horizontal" } else { "\"Horizontal\"" };
            let degrees = value.number().map(|_| value.lexeme())?;
            let mended = format!("{}{degrees}, {}{axis}", name_of("fov"), name_of("fov_axis"));
            (value.syntax() != Syntax::Toml).then_some((Some("fov"), mended))
        }
        "repeat" | "tiling" | "tiles" | "tile" | "frequency" if is_mapping(def) => {
            let number = value.number().is_some() || numbers(value).is_some();
            number.then(|| (Some("scale"), format!("{}{}", name_of("scale"), value.lexeme())))
        }
        // Its width and its height.
        "sensor" | "sensor_size" | "film_size" if def.name == "Camera" => {
            let width = *numbers(value).filter(|sides| sides.len() == 2)?.first()?;
            Some((Some("sensor_width"), format!("{}{width}", name_of("sensor_width"))))
        }
        "d" if !matches!(def.name, "Sphere" | "Cylinder" | "Disk") => None,
        "diameter" | "d" => convert("radius", |d| d / 2.0),
        "step" | "distance" | "pitch" | "interval" if def.name == "Grid" && value.number().is_some() => {
            let spacing = vector(value, &[value.lexeme(); 3]);
            Some((Some("spacing"), format!("{}{spacing}", name_of("spacing"))))
        }
        "radians" if def.field("degrees").is_some() => {
            let degrees = degrees(value.number()?, value.lexeme());
            Some((Some("degrees"), format!("{}{degrees}", name_of("degrees"))))
        }
        "smooth" | "smooth_shading" | "smoothing" | "shade_smooth" if def.field("shading").is_some() => {
            let kind = match value.lexeme() {
                "true" => "Smooth",
                "false" => "Flat",
                _ => return None,
            };
            let kind = if value.syntax() == Syntax::Ron { kind.to_owned() } else { format!("\"{kind}\"") };
            Some((Some("shading"), format!("{}{kind}", name_of("shading"))))
        }
        "transform" | "matrix_world" | "to_world" | "camera_to_world" | "world_matrix" if def.name == "Camera" => {
            rows_of(value).map(|rows| (None, format!("{}{rows}", name_of("matrix"))))
        }
        "object" | "item" | "body" | "child" if def.name == "Repeat" => {
            let is_list = value.kind() == Kind::List;
            let items = if is_list { value.lexeme().to_owned() } else { format!("[{}]", value.lexeme()) };
            Some((None, format!("{}{items}", name_of("items"))))
        }
        "resolution" | "size" | "dimensions" | "res" | "pixels" if def.name == "Image" => {
            let [width, height] = sides(value)?;
            Some((None, format!("{}{width}, {}{height}", name_of("width"), name_of("height"))))
        }
        "resolution" | "size" if def.name == "Scene" => Some((None, format!("{}{}", name_of("image"), image(value)?))),
        _ => None,
    }
}

/// A sphere by three radii.
pub(super) fn by_radii(
    name: &str,
    value: Item<'_, '_>,
    item: Item<'_, '_>,
    def: &'static StructDef,
) -> Option<(Option<&'static str>, String)> {
    if def.name != "Sphere" || !matches!(name, "radii" | "semi_axes" | "half_axes" | "radius3") {
        return None;
    }
    let center = item.fields().take(16).find(|(key, _)| key.text() == "center").map(|(_, center)| center.lexeme());
    Some((None, ellipsoid(value, center)?))
}

/// What a sphere of three radii is here: one of radius 1 that is stretched about its centre, which may be the origin.
pub(super) fn ellipsoid(value: Item<'_, '_>, center: Option<&str>) -> Option<String> {
    let radii = numbers(value).filter(|radii| radii.len() == 3)?.join(", ");
    Some(match (value.syntax(), center) {
        (Syntax::Ron, None) => format!("radius: 1, transform: [Scale(({radii}))]"),
        (Syntax::Ron, Some(at)) => format!("radius: 1, transform: [Scale(factor: ({radii}), about: {at})]"),
        (syntax, None) => syntax.of_toml(format!("radius = 1, transform = [{{ Scale = [{radii}] }}]")).into_owned(),
        (syntax, Some(at)) => syntax
            .of_toml(format!("radius = 1, transform = [{{ Scale = {{ factor = [{radii}], about = {at} }} }}]"))
            .into_owned(),
    })
}

/// Two whole numbers, or `"160x100"`.
fn sides(item: Item<'_, '_>) -> Option<[String; 2]> {
    let text = item.text();
    let found: Vec<&str> = match item.kind() {
        Kind::Text => text.split(['x', 'X', '*']).map(str::trim).collect(),
        Kind::Tuple | Kind::List => numbers(item)?,
        _ => return None,
    };
    let whole = |side: &&str| side.parse::<u32>().is_ok();
    let [width, height] = <[&str; 2]>::try_from(found).ok().filter(|sides| sides.iter().all(whole))?;
    Some([width.to_owned(), height.to_owned()])
}

/// `Image(width: 160, height: 100)` for a value that is two sides.
pub(super) fn image(item: Item<'_, '_>) -> Option<String> {
    let [width, height] = sides(item)?;
    Some(match item.syntax() {
        Syntax::Ron => format!("Image(width: {width}, height: {height})"),
        syntax => syntax.of_toml(format!("{{ width = {width}, height = {height} }}")).into_owned(),
    })
}

impl Reader<'_> {
    /// A colour, a picture or a bare name where a material stands: reports it, and says that it did.
    pub(crate) fn material_elsewhere(&mut self, item: Item<'_, '_>) -> bool {
        let lexeme = item.lexeme();
        if let Some(mended) = quoted_alone(item) {
            let message = format!("`{}` is not a kind of material", item.name().unwrap_or_default());
            let mut fault = Diagnostic::error(codes::UNKNOWN_VARIANT, item.head(), message)
                .expected("the name of a material between quotes, or a material written here")
                .hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
            self.report(fault);
            return true;
        }
        let diffuse = match item.syntax() {
            Syntax::Ron => format!("Diffuse(albedo: {lexeme})"),
            Syntax::Toml => format!("{{ Diffuse = {{ albedo = {lexeme} }} }}"),
            Syntax::Json => format!("{{ \"Diffuse\": {{ \"albedo\": {lexeme} }} }}"),
        };
        let albedo = match item.kind() {
            // Other programs mix materials.
            _ if self.mixes_materials(item) => false,
            Kind::Tuple | Kind::Struct if item.name().is_some_and(is_texture) => true,
            Kind::Tuple | Kind::List if item.name().is_none() => {
                numbers(item).is_some_and(|numbers| numbers.len() == 3)
            }
            Kind::Map if lexeme.starts_with('{') => {
                let key = item.fields().next().map(|(key, _)| key.text());
                key.as_deref().is_some_and(is_texture)
            }
            Kind::Integer | Kind::Float if self.knows_material(lexeme) => false,
            Kind::Integer | Kind::Float => item.number().is_some_and(|number| (0.0..=1.0).contains(&number)),
            Kind::Text => hex_color(&item.text()).is_some(),
            _ => false,
        };
        if albedo {
            let message = format!("a material cannot be {}", super::describe(item));
            let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
                .expected("a material with this colour, or the name of one")
                .hint(format!("write {}", super::hinted(&diffuse)));
            fault.edit = Some(Edit { span: item.span(), replacement: diffuse });
            self.report(fault);
            return true;
        }
        // No material at all, in other languages.
        if item.kind() == Kind::Word && matches!(lexeme, "null" | "nil" | "none" | "undefined") {
            self.report(no_material(item));
            return true;
        }
        let bare = match item.kind() {
            Kind::Word => {
                let cased = || self.materials.nearest(lexeme).is_some_and(|known| known.eq_ignore_ascii_case(lexeme));
                lexeme.starts_with(char::is_lowercase) && !item.is_null()
                    || Material::DEF.variant(lexeme).is_none() && cased()
            }
            Kind::Char => true,
            Kind::Integer | Kind::Float => self.knows_material(lexeme),
            _ => false,
        };
        if !bare {
            return false;
        }
        let name = item.text();
        let known = self.materials.nearest(&name);
        let meant = known.as_deref().unwrap_or(&name);
        let mut fault =
            Diagnostic::error(codes::WORD_NOT_QUOTED, item.span(), "names of materials stand between double quotes")
                .expected("the name of a material between quotes, or a material written here")
                .hint(format!("write \"{meant}\""));
        match &known {
            Some(known) => {
                fault.edit = Some(Edit { span: item.span(), replacement: crate::print::text(known, item.syntax()) });
                self.materials.use_name(known);
            }
            None if !self.materials.damaged => fault.hint += ", and add it to `materials`",
            None => {}
        }
        self.report(fault);
        true
    }
}

impl Reader<'_> {
    /// Whether a mixture is one of materials, which only other programs mix.
    fn mixes_materials(&self, item: Item<'_, '_>) -> bool {
        let body = match item.kind() {
            Kind::Map => item.fields().next().filter(|(key, _)| key.text() == "Mix").map(|(_, body)| body),
            _ => Some(item).filter(|item| item.name() == Some("Mix")),
        };
        let is_material = |value: Item<'_, '_>| match value.kind() {
            Kind::Text => self.knows_material(&value.text()) && !self.knows_texture(&value.text()),
            Kind::Map => value.fields().next().is_some_and(|(key, _)| Material::DEF.variant(&key.text()).is_some()),
            _ => value.name().is_some_and(|name| Material::DEF.variant(name).is_some()),
        };
        let of_materials = |(key, value): (Item<'_, '_>, Item<'_, '_>)| key.text() == "materials" || is_material(value);
        body.is_some_and(|body| body.fields().take(8).any(of_materials))
    }
}

/// What is said of a word for nothing where a material stands.
fn no_material(item: Item<'_, '_>) -> Diagnostic {
    let message = format!("a material cannot be {}", super::describe(item));
    Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
        .expected("the name of a material between quotes, or a material written here")
        .hint("write Diffuse(albedo: 0.5), say")
}

/// `"oak"` for `Material("oak")`, which is a name.
fn quoted_alone(item: Item<'_, '_>) -> Option<String> {
    const WORDS: [&str; 5] = ["material", "mat", "materialref", "ref", "named"];
    let is_word = item.kind() == Kind::Tuple && WORDS.contains(&&*item.name()?.to_ascii_lowercase());
    let mut children = item.children();
    let name = children.next().filter(|child| is_word && child.kind() == Kind::Text)?;
    children.next().is_none().then(|| name.lexeme().to_owned())
}

/// A place from the beginning of a name to the end of its value.
pub(super) fn whole_field(key: Item<'_, '_>, value: Item<'_, '_>) -> Span {
    Span { end: value.span().end, ..key.span() }
}
