//! What was meant by a word that is not there: the words of other programs, and the right place.

use crate::desc::Scene;
use crate::schema::{EnumDef, StructDef, Type};
use crate::syntax::Syntax;
use crate::tree::Item;

/// How the language says what other programs have a field for.
pub(super) fn other_way(name: &str, def: &'static StructDef, syntax: Syntax) -> Option<&'static str> {
    let ron = syntax == Syntax::Ron;
    let has = |field| def.field(field).is_some();
    match name.to_ascii_lowercase().as_str() {
        "color" | "colour" | "albedo" | "texture" if has("material") && ron => {
            Some("colours belong to a material: `material: Diffuse(albedo: ..)`")
        }
        "color" | "colour" | "albedo" | "texture" if has("material") => {
            Some("colours belong to a material: `material = { Diffuse = { albedo = .. } }`")
        }
        "scale" | "size" if has("transform") && ron => Some("write it as a transform: `transform: [Scale(2)]`"),
        "scale" | "size" if has("transform") => Some("write it as a transform: `transform = [{ Scale = 2 }]`"),
        "position" | "center" | "translate" | "translation" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Translate((x, y, z))]`")
        }
        "position" | "center" | "translate" | "translation" if has("transform") => {
            Some("write it as a transform: `transform = [{ Translate = [x, y, z] }]`")
        }
        "rotate" | "rotation" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Rotate(axis: (0, 1, 0), degrees: 90)]`")
        }
        "rotate" | "rotation" if has("transform") => {
            Some("write it as a transform: `transform = [{ Rotate = { axis = [0, 1, 0], degrees = 90 } }]`")
        }
        _ => None,
    }
}

/// Where a field belongs that stands in the wrong group: `samples` in the image.
pub(super) fn right_place(name: &str, def: &'static StructDef, item: Item<'_, '_>) -> Option<String> {
    let toml = item.syntax() == Syntax::Toml;
    if def.name != "Scene" && Scene::DEF.field(name).is_some() {
        return Some(match toml {
            // What stands below a header belongs to it.
            true => format!("`{name}` belongs to the scene itself: put it above the first [header]"),
            false => format!("`{name}` belongs to the scene itself, beside the other groups"),
        });
    }
    let group = Scene::DEF.fields.iter().find(
        |field| matches!(field.kind, Type::Struct(group) if group.name != def.name && group.field(name).is_some()),
    )?;
    let group = group.name;
    Some(match toml {
        true => format!("`{name}` is a field of [{group}]"),
        false => format!("`{name}` is a field of `{group}`"),
    })
}

/// What other programs call a field of ours.
pub(super) fn synonym(name: &str, def: &'static StructDef) -> Option<&'static str> {
    const SYNONYMS: [(&str, &[&str]); 16] = [
        ("position", &["eye", "origin", "from", "pos", "location"]),
        ("look_at", &["target", "lookat", "to"]),
        ("center", &["centre", "position", "pos", "origin"]),
        ("radius", &["r", "size"]),
        ("fov", &["field_of_view", "angle", "vfov"]),
        ("width", &["w", "x"]),
        ("height", &["h", "y"]),
        ("samples", &["spp", "samples_per_pixel"]),
        ("max_bounces", &["max_depth", "depth", "bounces"]),
        ("albedo", &["color", "colour", "diffuse", "base_color", "reflectance"]),
        ("reflectance", &["color", "colour", "albedo"]),
        ("ior", &["index", "eta", "refractive_index"]),
        ("file", &["path", "filename", "mesh", "src"]),
        ("degrees", &["angle", "deg"]),
        ("exponent", &["shininess", "alpha", "glossiness"]),
        ("transform", &["transforms"]),
    ];
    let lower = name.to_ascii_lowercase();
    let found = SYNONYMS.iter().find(|(field, others)| def.field(field).is_some() && others.contains(&lower.as_str()));
    found.map(|(field, _)| *field)
}

/// What other programs call a kind of ours.
pub(super) fn kind_elsewhere(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    const SYNONYMS: [(&str, &[&str]); 12] = [
        ("Diffuse", &["lambertian", "lambert", "matte", "matt", "roughdiffuse"]),
        ("Mirror", &["metal", "specular", "conductor", "reflective", "chrome"]),
        ("Transparent", &["glass", "dielectric", "refractive"]),
        ("BlinnPhong", &["phong", "glossy", "plastic", "roughplastic"]),
        ("Mesh", &["obj", "off", "ply", "stl", "trianglemesh", "model", "shape"]),
        ("SphereLight", &["pointlight", "light", "lamp", "spherearealight"]),
        ("Sphere", &["ball"]),
        ("Rectangle", &["quad", "square", "rect", "bilinearmesh", "wall"]),
        ("Box", &["cube", "cuboid", "brick"]),
        ("Emissive", &["emitter", "light", "area", "emission", "arealight", "glow", "areasource"]),
        ("Checkerboard", &["checker", "checkers", "chess", "chessboard", "checkertexture"]),
        ("Texture", &["image", "bitmap", "imagemap", "imagetexture", "picture"]),
    ];
    let lower = name.to_ascii_lowercase();
    let found = SYNONYMS.iter().find(|(kind, others)| def.variant(kind).is_some() && others.contains(&lower.as_str()));
    found.map(|(kind, _)| *kind)
}

/// How the language says what other programs have a kind for.
pub(super) fn other_kind(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    let has = |kind| def.variant(kind).is_some();
    match name.to_ascii_lowercase().as_str() {
        "plane" | "ground" | "floor" if has("Rectangle") => Some("a floor is a large `Rectangle(size: 20)`"),
        "cylinder" | "cone" | "disk" | "triangle" | "torus" if has("Mesh") => {
            Some("other shapes are meshes: name an OBJ, OFF, PLY or STL file in a `Mesh`")
        }
        "directional" | "distant" | "sun" | "directionallight" | "distantlight" if has("SphereLight") => {
            Some("a sun is a large sphere light far away")
        }
        "environment" | "sky" | "constant" | "envmap" | "infinite" | "ambientlight" if has("SphereLight") => {
            Some("light from all around is the scene's `background`: a colour, or `Environment(file: \"sky.hdr\")`")
        }
        "quadlight" | "rectanglelight" | "rectlight" | "arealight" | "area" | "disklight" if has("SphereLight") => {
            Some("a flat lamp is an object that shines: `Rectangle(material: Emissive(radiance: 5))` in `objects`")
        }
        _ => None,
    }
}
