//! Kinds of programs that draw figures of data: points from a file, axes, molecules.

use super::everyday::thing;
use super::synonyms::squeezed;
use crate::schema::EnumDef;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

const POINTS: [&str; 14] = [
    "points",
    "pointcloud",
    "particles",
    "spheres",
    "balls",
    "glyphs",
    "glyph",
    "glyph3d",
    "scatter3d",
    "scatter3",
    "scatterplot",
    "pointset",
    "atoms",
    "markers",
];

/// What stands for such a kind: a word of every day tells it.
const THINGS: [(&str, &[&str]); 6] = [
    ("axes", &["axes", "axes3d", "axis3d", "axeshelper", "axishelper", "coordinateaxes", "triad", "gizmo"]),
    ("molecule", &["molecule", "atom", "bond", "bonds", "ballandstick", "protein", "unitcell"]),
    ("colorbar", &["colorbar", "colourbar", "legend", "scalarbar"]),
    ("streamline", &["streamline", "streamlines", "streamtube", "trajectory", "fieldline", "fieldlines"]),
    ("contour", &["contour", "contours", "contourplot", "isoline", "isolines"]),
    ("laser", &["laser", "laserlight", "laserbeam", "beam"]),
];

const THIN_FILM: [&str; 5] = ["thinfilm", "soapbubble", "bubble", "soap", "iridescent"];

/// What to write for it.
pub(super) fn way(name: &str, def: &'static EnumDef, inner: Option<Item<'_, '_>>, syntax: Syntax) -> Option<String> {
    let plain = squeezed(name);
    match def.noun {
        "object" if POINTS.contains(&&*plain) => points(&plain, inner, syntax),
        "material" if THIN_FILM.contains(&&*plain) => {
            let (glass, air) = match syntax {
                Syntax::Ron => ("Transparent(ior: 1.5)".into(), "Transparent(ior: 0.667)".into()),
                _ => ["1.5", "0.667"]
                    .map(|ior| format!("{{ Transparent = {{ ior = {ior} }} }}"))
                    .map(|way| syntax.of_toml(way))
                    .into(),
            };
            Some(format!(
                "thin films have no colours here: a bubble is a ball of glass, {glass}, and in it one of air, {air}"
            ))
        }
        "object" | "light" | "texture" => {
            let is_light = def.noun == "light";
            let known =
                THINGS.iter().find(|(thing, names)| names.contains(&&*plain) && (*thing == "laser") == is_light);
            // These are told in RON.
            thing(known?.0).map(str::to_owned)
        }
        _ => None,
    }
}

/// Many balls at places of a file or a list.
fn points(plain: &str, inner: Option<Item<'_, '_>>, syntax: Syntax) -> Option<String> {
    let find = |names: &[&str]| {
        let inner = inner?;
        inner.fields().take(16).find(|(key, _)| names.contains(&&*squeezed(&key.text()))).map(|(_, value)| value)
    };
    let radius = find(&["radius", "r", "size", "pointsize", "radii"]).filter(|radius| radius.number().is_some());
    let radius = radius.map_or("0.05", |radius| radius.lexeme());
    let file = find(&["file", "path", "filename", "src", "data", "csv"]).filter(|file| file.kind() == Kind::Text);
    let list = find(&["points", "positions", "centers", "centres", "coords", "coordinates", "vertices"]);
    // One that is meant as a sphere has its fields.
    if matches!(plain, "spheres" | "balls") && file.is_none() && list.is_none() {
        return None;
    }
    let is_table = |file: &Item<'_, '_>| {
        let text = file.text().to_ascii_lowercase();
        [".csv", ".txt", ".dat", ".tsv"].iter().any(|end| text.ends_with(end))
    };
    let places = list.and_then(|list| translations(list, syntax));
    let places = places.or_else(|| file.filter(is_table).map(|file| file.lexeme().to_owned()));
    let more = if places.is_none() {
        "; a line of the file has x, y, z, and a factor of the size where it differs"
    } else {
        ""
    };
    let places = places.unwrap_or_else(|| "\"points.csv\"".to_owned());
    let way = match syntax {
        Syntax::Ron => format!("Sphere(radius: {radius}, placements: {places})"),
        syntax => {
            let radius = syntax.of_toml(format!("radius = {radius}")).into_owned();
            let name = if syntax == Syntax::Json { "\"placements\": " } else { "placements = " };
            let kind = if syntax == Syntax::Json { "\"Sphere\": " } else { "Sphere = " };
            format!("{{ {kind}{{ {radius}, {name}{places} }} }}")
        }
    };
    Some(format!("many alike are one object with its places: {way}{more}"))
}

/// A few points as placements.
fn translations(list: Item<'_, '_>, syntax: Syntax) -> Option<String> {
    const MOST: usize = 6;
    let of_one = |point: Item<'_, '_>| {
        let bare = matches!(point.kind(), Kind::Tuple | Kind::List) && point.name().is_none();
        let three = bare && point.children().take(4).count() == 3;
        three.then(|| match syntax {
            Syntax::Ron => format!("[Translate({})]", point.lexeme()),
            Syntax::Toml => format!("[{{ Translate = {} }}]", point.lexeme()),
            Syntax::Json => format!("[{{ \"Translate\": {} }}]", point.lexeme()),
        })
    };
    let all: Option<Vec<String>> = list.children().take(MOST + 1).map(of_one).collect();
    all.filter(|all| (1..=MOST).contains(&all.len())).map(|all| format!("[{}]", all.join(", ")))
}
