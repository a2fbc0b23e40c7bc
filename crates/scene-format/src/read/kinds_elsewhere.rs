//! Kinds of other programs as the nearest kind here, with what is said of them there.

use super::colors_elsewhere::{color_alone, is_named_in};
use super::elsewhere::{Fields, numbers, vector};
use super::pattern_fields::of_mapping;
use super::shape_fields::is_ring;
use super::synonyms::{squeezed, synonyms};
use super::vector::in_groups;
use crate::schema::{Content, EnumDef, FieldDef, StructDef, VariantDef};
use crate::syntax::Syntax;
use crate::tree::Item;

/// More fields than these are not looked at.
const MOST: usize = 16;

/// How a kind is written with the fields that it needs and those that another kind has of it; `None`: what is written
/// would do for it as it stands.
pub(super) fn needs(variant: &'static VariantDef, inner: Option<Item<'_, '_>>, syntax: Syntax) -> Option<String> {
    let (Content::Struct(fields), Some(inner)) = (&variant.content, inner) else { return None };
    let in_a_row = of_sides(variant.name, inner).is_some();
    let written = |name: &str| inner.fields().any(|(key, _)| key.text() == name);
    let known = inner.fields().all(|(key, _)| fields.field(&key.text()).is_some());
    let all = fields.fields.iter().all(|field| field.default.is_some() || written(field.name));
    let one = fields.exactly_one.is_empty() || fields.exactly_one.iter().any(|name| written(name));
    if known && all && one && !in_a_row {
        return None;
    }
    let (theirs, more) = with_values(variant.name, fields, inner);
    let way = written_kind(variant.name, &theirs, syntax);
    Some(format!("`{way}`{more}"))
}

/// `Kind(field: value, ..)`
fn written_kind(kind: &str, fields: &[(&str, String)], syntax: Syntax) -> String {
    let name = |field: &str| if syntax == Syntax::Ron { format!("{field}: ") } else { format!("{field} = ") };
    let all: Vec<String> = fields.iter().map(|(field, value)| format!("{}{value}", name(field))).collect();
    match syntax {
        Syntax::Ron => format!("{kind}({})", all.join(", ")),
        syntax if all.is_empty() => syntax.of_toml(format!("{{ {kind} = {{}} }}")).into_owned(),
        syntax => syntax.of_toml(format!("{{ {kind} = {{ {} }} }}", all.join(", "))).into_owned(),
    }
}

/// The fields of a kind with their values as another kind says them, and what more is to be said.
fn with_values(kind: &str, def: &'static StructDef, inner: Item<'_, '_>) -> (Vec<(&'static str, String)>, String) {
    let (mut values, mut more): (Vec<(&'static str, String)>, String) = (Vec::new(), String::new());
    if let Some(size) = of_sides(kind, inner) {
        values.push(("size", size));
    }
    for (key, value) in inner.fields().take(MOST) {
        let name = key.text();
        let ours = def.fields.iter().find(|field| field.name == name).map(|field| field.name);
        let shines = kind == "Emissive" && matches!(&*name, "strength" | "emission_strength" | "energy" | "brightness");
        let of_light = shines.then_some("radiance");
        let Some(field) = ours.or(of_light).or_else(|| synonyms(&name, def).first().copied()) else {
            if let (true, Some((hint, _))) = (more.is_empty(), of_mapping(&name, value, inner, def)) {
                more = format!("; {hint}");
            }
            if let (Some(exponent), "BlinnPhong") = (exponent(&name, value), kind) {
                values.push(("exponent", exponent));
            }
            continue;
        };
        // Of a long value nobody reads all.
        let written = def.field(field).and_then(|at| as_ours(value, at));
        let written = written.unwrap_or_else(|| value.lexeme().to_owned());
        let short = written.len() <= 40 && !written.contains('\n');
        if values.iter().all(|(known, _)| *known != field) {
            values.push((field, if short { written } else { "..".to_owned() }));
        }
    }
    let has = |values: &[(&str, String)], field: &str| values.iter().any(|(known, _)| *known == field);
    for field in def.fields.iter().filter(|field| field.default.is_none()) {
        if !has(&values, field.name) {
            values.push((field.name, usual(kind, field.name).to_owned()));
        }
    }
    // A gloss is white; what is said of its colour goes to the surface.
    if kind == "BlinnPhong" && !has(&values, "energy_conserving") {
        values.push(("energy_conserving", "true".to_owned()));
    }
    if !def.exactly_one.is_empty() && !def.exactly_one.iter().any(|field| has(&values, field)) {
        let of_file = def.exactly_one.iter().find(|name| **name == "file");
        let (field, value) = match kind {
            "Emissive" => ("radiance", "5"),
            "ThinLens" => ("focus_distance", "5"),
            _ => (*of_file.or(def.exactly_one.last()).unwrap_or(&""), ".."),
        };
        values.push((field, value.to_owned()));
    }
    let place = |field: &str| def.fields.iter().position(|known| known.name == field);
    values.sort_by_key(|(field, _)| place(field));
    (values, more)
}

/// A value that other programs write in another way.
fn as_ours(value: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    if at.name == "outline" && is_ring(value) {
        return Some(format!("[{}]", value.lexeme()));
    }
    // What stands for a texture or a var of the scene is no colour.
    let named = || ["textures", "vars"].iter().any(|map| is_named_in(map, value, &value.text()));
    if at.rule.color
        && !named()
        && let Some(color) = color_alone(value)
    {
        return Some(color);
    }
    let hexadecimal = value.lexeme().strip_prefix("0x").filter(|digits| at.rule.color && digits.len() == 6);
    hexadecimal.map(|digits| format!("\"#{digits}\"")).or_else(|| in_groups(value, at))
}

/// The lengths of sides by their names or one after the other.
fn of_sides(kind: &str, inner: Item<'_, '_>) -> Option<String> {
    let names: &[&str] = match kind {
        "Box" => &["width", "height", "depth"],
        "Rectangle" => &["width", "height"],
        _ => return None,
    };
    let find = |name: &&str| inner.fields().take(MOST).find(|(key, _)| key.text() == **name).map(|(_, side)| side);
    let named: Option<Vec<&str>> =
        names.iter().map(|name| find(name).filter(|side| side.number().is_some()).map(|side| side.lexeme())).collect();
    let sides = named.or_else(|| numbers(inner).filter(|sides| sides.len() == names.len()))?;
    Some(vector(inner, &sides))
}

/// The value of a field that has to be written, where one is as good as another.
fn usual(kind: &str, field: &str) -> &'static str {
    match (kind, field) {
        ("BlinnPhong", "exponent") => "1000",
        ("BlinnPhong", "specular") | ("SphereLight", "radius") | ("ThinLens", "aperture") => "0.1",
        _ => "..",
    }
}

/// The exponent of a gloss as rough as that.
fn exponent(name: &str, value: Item<'_, '_>) -> Option<String> {
    let roughness = value.number().filter(|_| matches!(name, "roughness" | "specular_roughness" | "rough"))?;
    let exponent = (2.0 / roughness.powi(4)).clamp(1.0, 1e7);
    // Three digits are as good as the roughness was.
    let scale = 10f64.powi(exponent.log10().floor() as i32 - 2).max(1.0);
    roughness.is_finite().then(|| format!("{}", (exponent / scale).round() * scale))
}

/// What a material for all purposes is here by its numbers: metal, glass or a surface with a gloss.
pub(super) fn of_all_purposes(
    name: &str,
    def: &'static EnumDef,
    inner: Option<Item<'_, '_>>,
    syntax: Syntax,
) -> Option<String> {
    const NAMES: [&str; 20] = [
        "principled",
        "disney",
        "pbr",
        "standard",
        "standardsurface",
        "metallicroughness",
        "uber",
        "coateddiffuse",
        "clearcoat",
        "meshstandardmaterial",
        "meshphysicalmaterial",
        "principledbsdf",
        "openpbr",
        "openpbrsurface",
        "carpaint",
        "metallicpaint",
        "material",
        "gltf",
        "gltfmaterial",
        "pbrmetallicroughness",
    ];
    let plain = squeezed(name);
    let inner = inner.filter(|inner| inner.fields().next().is_some())?;
    if def.noun != "material" || !NAMES.contains(&&*plain) {
        return None;
    }
    let share = |names: &[&str]| {
        let found = inner.fields().take(MOST).find(|(key, _)| names.contains(&&*squeezed(&key.text())));
        found.and_then(|(_, value)| value.number()).unwrap_or(0.0)
    };
    let glossy = ["metallic", "roughness", "specular", "clearcoat", "metalness"];
    let is_glossy = || inner.fields().take(MOST).any(|(key, _)| glossy.contains(&&*squeezed(&key.text())));
    let kind = match () {
        () if plain == "material" && !is_glossy() => "Diffuse",
        () if share(&["metallic", "metalness", "basemetalness", "metal"]) > 0.5 => "Conductor",
        () if share(&["transmission", "transmissionweight", "spectrans"]) > 0.5 => "Transparent",
        () => "BlinnPhong",
    };
    let Content::Struct(fields) = &def.variant(kind)?.content else { return None };
    let (mut values, _) = with_values(kind, fields, inner);
    if kind == "Transparent" {
        values.iter_mut().filter(|(_, value)| value == "..").for_each(|(_, value)| *value = "1.5".to_owned());
    }
    values.retain(|(field, value)| !(*field == "metal" && value.parse::<f64>().is_ok()));
    Some(written_kind(kind, &values, syntax))
}

/// Two colours in a list where a pattern has `a` and `b`.
pub(super) fn two_of_a_pattern(name: &str, value: Item<'_, '_>, def: &'static StructDef) -> Option<String> {
    let has_both = def.field("a").is_some() && def.field("b").is_some();
    let is_list = value.name().is_none() && matches!(name, "colors" | "colours" | "palette");
    let mut colors = value.children();
    let (a, b) = (colors.next()?, colors.next()?);
    let is_color = |item: Item<'_, '_>| item.name().is_none() && item.children().count() != 2;
    (has_both && is_list && colors.next().is_none() && is_color(a) && is_color(b)).then(|| {
        let name = |field: &str| Fields(value.syntax()).name(field);
        format!("{}{}, {}{}", name("a"), a.lexeme(), name("b"), b.lexeme())
    })
}
