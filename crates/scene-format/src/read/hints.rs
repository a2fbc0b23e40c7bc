//! What was meant by a word that is not there: the words of other programs, and the right place.

use super::of_fields;
use super::of_kinds::{self, LIGHTS, MATERIALS, OBJECTS, TRANSFORMS};
use super::pattern_fields::of_pattern;
use super::shape_fields::of_shape;
use super::synonyms::{squeezed, synonyms};
use crate::desc::{Material, Object, Scene};
use crate::schema::{EnumDef, FieldDef, StructDef};
use crate::syntax::Syntax;
use crate::tree::Item;
use std::borrow::Cow;

/// How the language says what other programs have a field for.
pub(super) fn other_way(name: &str, def: &'static StructDef, syntax: Syntax) -> Option<Cow<'static, str>> {
    let ron = syntax == Syntax::Ron;
    let has = |field| def.field(field).is_some();
    let words = match name.to_ascii_lowercase().as_str() {
        "color" | "colour" | "albedo" | "texture" | "pigment" | "rgb" | "hex" | "diffuse" if has("material") && ron => {
            Some("colours belong to a material: `material: Diffuse(albedo: ..)`")
        }
        "color" | "colour" | "albedo" | "texture" | "pigment" | "rgb" | "hex" | "diffuse" if has("material") => {
            Some("colours belong to a material: `material = { Diffuse = { albedo = .. } }`")
        }
        "size" | "width" | "radius" | "extent" if def.name == "Plane" => {
            Some("a `Plane` has no end; what has one is a `Rectangle`, with a `size`")
        }
        // Of hills it is how high they are.
        "scale" if def.name == "HeightField" => None,
        "scale" | "size" if has("transform") && ron => Some("write it as a transform: `transform: [Scale(2)]`"),
        "scale" | "size" if has("transform") => Some("write it as a transform: `transform = [{ Scale = 2 }]`"),
        "position" | "center" | "translate" | "translation" | "move" | "offset" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Translate((x, y, z))]`")
        }
        "position" | "center" | "translate" | "translation" | "move" | "offset" if has("transform") => {
            Some("write it as a transform: `transform = [{ Translate = [x, y, z] }]`")
        }
        "matrix" | "to_world" | "matrix_world" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Matrix(rows: ((a, b, c, x), (d, e, f, y), (g, h, i, z)))]`")
        }
        "matrix" | "to_world" | "matrix_world" if has("transform") => Some(
            "write it as a transform: `transform = [{ Matrix = { rows = [[a, b, c, x], [d, e, f, y], [g, h, i, z]] } \
             }]`",
        ),
        "rotate" | "rotation" | "rotatex" | "rotatey" | "rotatez" | "rotate_x" | "rotate_y" | "rotate_z" | "turn"
        | "euler" | "orientation"
            if has("transform") && ron =>
        {
            Some("write it as a transform: `transform: [Rotate(axis: (0, 1, 0), degrees: 90)]`")
        }
        "rotate" | "rotation" | "rotatex" | "rotatey" | "rotatez" | "rotate_x" | "rotate_y" | "rotate_z" | "turn"
        | "euler" | "orientation"
            if has("transform") =>
        {
            Some("write it as a transform: `transform = [{ Rotate = { axis = [0, 1, 0], degrees = 90 } }]`")
        }
        _ => None,
    };
    words.map(|words| syntax.of_toml(words))
}

/// A picture without a background, asked for as pages of the web do.
pub(super) fn clear_background(name: &str, value: Item<'_, '_>) -> Option<&'static str> {
    let is_clear = name == "background" && value.lexeme().to_ascii_lowercase().contains("transparent");
    is_clear.then_some("the background is left out of the picture by `output: Output(alpha: true)`")
}

/// Where a field belongs that stands in the wrong group: `samples` in the image.
pub(super) fn right_place(name: &str, def: &'static StructDef, item: Item<'_, '_>) -> Option<String> {
    let toml = item.syntax() == Syntax::Toml;
    if toml && def.name == "Scene" {
        // Headers of TOML have the whole way.
        if Material::DEF.variant(name).is_some() {
            return Some(format!("a material with the name red begins with [materials.red.{name}]"));
        }
    }
    if def.name != "Scene" && Scene::DEF.field(name).is_some() {
        return Some(match toml {
            // What stands below a header belongs to it.
            true => format!("`{name}` belongs to the scene itself: put it above the first [header]"),
            false => format!("`{name}` belongs to the scene itself, beside the other groups"),
        });
    }
    // Of things width and height are their own, not the picture's.
    if matches!(name, "width" | "height") && def.name != "Scene" && !is_group_of_scene(def) {
        return None;
    }
    let named = |group: &&FieldDef| group.kind.group().filter(|group| group.name != def.name);
    let exact = |group: &&FieldDef| named(group).is_some_and(|group| group.field(name).is_some());
    let group = Scene::DEF.fields.iter().find(exact);
    // `spp` beside the groups, or in another of them.
    let vague = [
        "type", "kind", "mode", "format", "end", "length", "count", "rate", "distance", "radius", "path", "depth",
        "sky", "channels", "layers",
    ];
    let of_groups = name.len() > 2 && !vague.contains(&name) && (def.name == "Scene" || is_group_of_scene(def));
    let called = || {
        let mut groups = Scene::DEF.fields.iter().filter(|_| of_groups);
        groups.find_map(|field| Some((field.name, *synonyms(name, named(&field)?).first()?)))
    };
    let (group, ours) = group.map(|group| (group.name, None)).or_else(|| called().map(|(g, ours)| (g, Some(ours))))?;
    let place = if toml { format!("[{group}]") } else { format!("`{group}`") };
    let sides = ["width", "height"];
    let written = sides.map(|side| item.fields().find(|(key, _)| key.text() == side).map(|(_, value)| value.lexeme()));
    if let ([Some(width), Some(height)], true) = (written, group == "image" && sides.contains(&name)) {
        return Some(match item.syntax() {
            Syntax::Ron => format!("write it beside: image: Image(width: {width}, height: {height})"),
            syntax => {
                syntax.of_toml(format!("write it beside: image = {{ width = {width}, height = {height} }}")).into()
            }
        });
    }
    Some(match ours {
        None => format!("`{name}` is a field of {place}"),
        Some(ours) => format!("that is `{ours}` here, a field of {place}"),
    })
}

/// Whether these are the fields of one of the scene's groups.
fn is_group_of_scene(def: &'static StructDef) -> bool {
    Scene::DEF.fields.iter().any(|field| is_group(field, def))
}

/// Whether this field of the scene has these fields.
fn is_group(field: &FieldDef, def: &'static StructDef) -> bool {
    field.kind.group().is_some_and(|group| group.name == def.name)
}

/// What other programs call a kind of ours.
// Long: a table.
pub(super) fn kind_elsewhere(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    const SYNONYMS: &[(&str, &[&str])] = &[
        ("Linear", &["linear_spline", "linearspline", "polyline", "straight", "lines", "polygon"]),
        ("CatmullRom", &["cubic_spline", "cubicspline", "quadratic_spline", "spline", "smooth", "cubic", "natural"]),
        ("Bezier", &["bezier_spline", "bezierspline", "bezier_curve", "beziercurve", "cubic_bezier", "cubicbezier"]),
        ("SideBySide", &["sidebyside", "side_by_side", "sbs", "left_right", "leftright", "horizontal", "lr"]),
        ("TopBottom", &["topbottom", "top_bottom", "over_under", "overunder", "tab", "vertical", "above", "tb"]),
        ("SphereLight", &["pointlight", "light", "lamp", "spherearealight", "lightsource"]),
        ("Matrix", &["matrix", "matrix_world", "matrixworld", "to_world", "toworld", "matrix4", "mat4", "affine"]),
        ("Matrix", &["transform", "concattransform", "concat_transform"]),
        ("Align", &["orient", "aligned", "align_to", "alignto", "rotate_to", "rotateto", "point_at", "reorient"]),
        ("FitTo", &["fit", "resize", "normalize", "normalise", "unitize", "scale_to", "scaleto", "dimensions"]),
        ("DropTo", &["drop", "ground", "place_on", "rest_on", "onground", "on_ground"]),
        ("CenterTo", &["center", "centre", "recenter", "recentre", "centered", "center_at", "move_to", "place_at"]),
        ("CenterTo", &["geometry_to_origin", "origin_to_geometry", "origin_set", "center_object", "center_trans"]),
        ("Grid", &["array", "linear", "lattice", "rows"]),
        ("Ring", &["circle", "radial", "polar", "circular"]),
        ("Scatter", &["random", "poisson", "poissondisk"]),
        ("Emissive", &["arealightsource", "area_light_source"]),
        ("Silver", &["ag"]),
        ("Gold", &["au"]),
        ("Copper", &["cu"]),
        ("Aluminum", &["al", "alu", "aluminium"]),
        ("Iron", &["fe"]),
        ("Chromium", &["cr", "chrome"]),
        ("Nickel", &["ni"]),
        ("Titanium", &["ti"]),
        ("Platinum", &["pt"]),
        ("Full", &["bdpt", "bidirectional", "photon", "photonmapping", "photonmapper", "sppm", "vcm", "mlt", "pssmlt"]),
        ("Translate", &["move", "translation", "position", "offset", "shift", "place", "displace"]),
        ("Rotate", &["turn", "rotation", "spin", "rotateaxis", "angleaxis", "axisangle"]),
        ("Scale", &["scaling", "size", "stretch", "enlarge", "zoom"]),
        ("Panorama", &["spherical", "environment", "equirectangular", "latlong", "panoramic", "omnidirectional"]),
        ("Perspective", &["pinhole", "persp", "perspectivecamera"]),
        ("Orthographic", &["ortho", "parallel", "telecentric", "isometric", "axonometric", "orthographiccamera"]),
        ("Group", &["node", "collection", "shapegroup", "assembly"]),
        ("Checkerboard", &["checker", "checkers", "chess", "chessboard", "checkertexture"]),
        ("ThinLens", &["depthoffield", "dof", "bokeh", "lens", "thin"]),
        ("Noise", &["fbm", "clouds", "wrinkled", "granite", "bozo", "windy", "noisetexture", "musgrave"]),
        ("Noise", &["fractalnoise", "spotted", "bumps", "whitenoise"]),
        ("Lines", &["grid", "stripes", "gridtexture", "tiles", "stripe"]),
        ("Dots", &["polkadots", "spots", "polka", "dot"]),
        ("Gradient", &["ramp", "blend", "gradienttexture"]),
        ("ColorRamp", &["colorramp", "color_ramp", "color_map", "colormap", "colour_map", "valtorgb", "maprange"]),
        ("Mix", &["mix", "mixrgb", "mix_rgb", "mixture", "lerp", "interpolate"]),
        ("Multiply", &["multiply", "scale", "math", "product", "modulate", "tint"]),
        ("VertexColor", &["vertexcolor", "vertexcolors", "vertex_color", "vertex_colors", "attribute", "color_0"]),
        ("VertexColor", &["mesh_attribute", "meshattribute", "colorattribute", "vertexcolour"]),
        ("Planar", &["planar", "flat", "plane", "projection", "projected", "decal"]),
        ("Spherical", &["spherical", "sphere", "latlong", "longlat", "equirectangular"]),
        ("Triplanar", &["triplanar", "box", "boxmapping", "cubic", "cube", "cubemap"]),
        ("Wood", &["woodgrain", "planks", "rings"]),
        ("Marble", &["agate", "veins"]),
        ("Voronoi", &["worley", "cellular", "cellnoise", "crackle", "cells", "voronoitexture"]),
        ("Objects", &["object", "cryptoobject", "crypto_object", "asset", "assets", "cryptoasset"]),
        ("Materials", &["material", "cryptomaterial", "crypto_material"]),
        ("World", &["global", "worldspace", "world_space"]),
        ("Object", &["local", "generated", "objectspace", "object_space"]),
        ("Uv", &["texcoord", "texturecoordinates", "uvmapping", "mapping"]),
        ("Texture", &["image", "bitmap", "imagemap", "imagetexture", "picture"]),
        (
            "Path",
            &["pathtracer", "path_tracer", "pathtracing", "path_tracing", "volpath", "simplepath", "unidirectional"],
        ),
        ("Direct", &["directlighting", "direct_lighting", "directlight", "direct_light", "whitted", "diffuse_direct"]),
        ("Indirect", &["indirectlight", "indirect_light", "bounced", "diffuse_indirect", "gi", "globalillumination"]),
        ("AmbientOcclusion", &["ao", "occlusion"]),
        ("PathLength", &["bounces", "path_depth", "raydepth", "ray_depth", "segments"]),
        ("Nodes", &["traversal", "cost", "heatmap", "boxes"]),
    ];
    let plain = squeezed(name);
    let bare = bare(&plain, def);
    let told = Material::TOLD.iter().chain(Object::TOLD).map(|(kind, others, _)| (kind, others));
    let mut all = SYNONYMS.iter().map(|(kind, others)| (kind, others)).chain(told);
    let same = |other: &str| squeezed(other) == plain || bare == Some(other);
    let found = all.find(|(kind, others)| {
        def.variant(kind).is_some()
            && (others.iter().any(|other| same(other)) || bare.is_some_and(|b| same_word(kind, b)))
    });
    found.map(|(kind, _)| *kind)
}

/// A kind without what other programs put behind all: `DiffuseBSDF`, `Glass BSDF`, `BoxGeometry` of three.js.
fn bare<'n>(plain: &'n str, def: &'static EnumDef) -> Option<&'n str> {
    let bare = match def.noun {
        "material" => plain.strip_suffix("bsdf")?,
        "object" => plain.strip_suffix("geometry").map(|bare| bare.strip_suffix("buffer").unwrap_or(bare))?,
        _ => return None,
    };
    match (def.noun, bare) {
        (_, "") => None,
        // It has an end there.
        ("object", "plane") => Some("rectangle"),
        ("object", "circle") => Some("disk"),
        _ => Some(bare),
    }
}

fn same_word(kind: &str, bare: &str) -> bool {
    kind.eq_ignore_ascii_case(bare)
}

/// How the language says what other programs have a kind for, or what to do where it does not. A hint goes with the
/// kind that it tells of: once there is one, nobody asks.
pub(super) fn other_kind(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    let lower = name.to_ascii_lowercase();
    let table = match def.noun {
        "object" => OBJECTS,
        "material" => MATERIALS,
        "texture" => TEXTURES,
        "curve" => CURVES,
        "curve of a tube" => TUBE_CURVES,
        "mapping" | "mapping of a solid texture" => MAPPINGS,
        "light" => LIGHTS,
        "transform" => TRANSFORMS,
        "layer" => LAYERS,
        _ => &[],
    };
    let found = table.iter().find(|(names, _)| names.contains(&lower.as_str()) || names.contains(&&*squeezed(name)));
    found.map(|(_, hint)| *hint).or_else(|| of_kinds::elsewhere(name, def))
}

/// Names, and what is said of them.
pub(super) type Hints = &'static [(&'static [&'static str], &'static str)];

const TEXTURES: Hints = &[
    (
        &["bricks", "brick", "bricktexture"],
        "bricks are Lines over a colour: Lines(a: \"#b5b0a8\", b: \"#8a3d2e\", width: 0.08, mapping: Uv(scale: (4, \
         12))); with rows that are shifted they are a picture, Texture(file: \"bricks.png\")",
    ),
    (
        &["perlin", "perlinnoise", "simplex", "gradientnoise"],
        "noise of one octave is a kind of Noise: write Noise(kind: Perlin)",
    ),
    (&["turbulence"], "it is a kind of Noise: write Noise(kind: Turbulence)"),
    (
        &["wave", "wavetexture", "magic"],
        "waves that noise bends are Marble(..) in planes and Wood(..) in rings; even stripes are Lines(width: 0.5, \
         along: V)",
    ),
    (
        &["add", "subtract", "sum", "screen", "invert", "difference", "gamma", "mapping"],
        "textures are reckoned with by Mix(a: .., b: .., weight: ..), Multiply(a: .., b: ..) and ColorRamp(input: .., \
         stops: [..])",
    ),
    (&["constant", "constanttexture", "solidcolor"], "one colour stands by itself: (0.8, 0.2, 0.1)"),
    (
        &["random", "rand", "whitenoise", "white_noise"],
        "what differs from place to place is Noise(..), or a shade for each cell by Voronoi(feature: Cell)",
    ),
    (&["volume"], "textures in space are Noise(..), Marble(..) and Wood(..)"),
    (&["hsv", "hsl", "hsla", "hsva"], "colours are red, green and blue: (0.8, 0.2, 0.1) or \"#d03a2b\""),
];

const LAYERS: Hints = &[
    (
        &["cryptomatte", "crypto", "cryptoobject", "crypto_object", "cryptomaterial", "crypto_material", "cryptoasset"],
        "Cryptomatte has a field of its own beside `layers`: `cryptomatte: [Objects, Materials]`",
    ),
    (
        &["lightgroup", "light_group", "light_groups", "lightgroups", "lights", "lpe"],
        "groups of lights have a field of their own beside `layers`: `light_groups: true`",
    ),
    (&["mask", "matte", "object_mask", "objectmask"], "masks have a field of their own beside `layers`: masks: [..]"),
];

const CURVES: Hints = &[(
    &["bezier", "bezier_spline", "bezierspline", "bspline", "b_spline", "nurbs", "hermite"],
    "there are no control points, which only a `Tube` has: the curve goes through all points, so take points on it and \
     `CatmullRom`",
)];

const TUBE_CURVES: Hints = &[
    (
        &["bspline", "b_spline", "nurbs"],
        "there are no such control points: take points on the curve and `CatmullRom`, or make it `Bezier`",
    ),
    (&["hermite", "hermite_spline"], "take `Bezier`, whose handles stand a third of the tangents from their points"),
];

const MAPPINGS: Hints = &[
    (
        &["object", "world", "local", "global", "solid"],
        "pictures, lines and dots lie on surfaces: Uv(..); by an object's own coordinates they lie as Triplanar(..), \
         Planar(..) or Spherical(..)",
    ),
    (
        &["cylindrical", "cylinder", "camera", "screen", "window", "normal", "reflection"],
        "textures lie by a surface's own coordinates, Uv(..), or by points: Planar(..), Spherical(..), Triplanar(..); \
         patterns also in space: Object(..), World(..)",
    ),
];

/// What is said of options of the command line that are taken for fields of the scene.
pub(crate) fn command_line(name: &str, def: &'static StructDef) -> Option<&'static str> {
    if def.name != "Scene" && Scene::DEF.fields.iter().all(|field| !is_group(field, def)) {
        return None;
    }
    Some(match name {
        "denoise" | "denoiser" | "denoising" | "denoised" => {
            "that is an option of the command line, not of the scene: tracer render scene.ron --denoise"
        }
        "oidn" | "OIDN" | "use_oidn" | "open_image_denoise" => {
            "that is an option of the command line, not of the scene: tracer render scene.ron --denoise oidn"
        }
        "threads" | "thread_count" | "num_threads" | "jobs" => {
            "that is an option of the command line, not of the scene: tracer render scene.ron --threads 4"
        }
        "crop" | "region" | "window" => {
            "that is an option of the command line, not of the scene: tracer render scene.ron --crop X,Y,WIDTH,HEIGHT"
        }
        "checkpoint" => {
            "that is an option of the command line, not of the scene: tracer render scene.ron --checkpoint FILE"
        }
        _ => return None,
    })
}

/// How the language says what other programs have a field for, or what to do where it does not.
// Long: a table.
pub(super) fn field_of_others(name: &str, def: &'static StructDef, syntax: Syntax) -> Option<&'static str> {
    let lower = name.to_ascii_lowercase();
    let found = of_pattern(&lower, def)
        .or_else(|| of_shape(&lower, def, syntax))
        .or_else(|| command_line(&lower, def))
        .or_else(|| of_fields::elsewhere(&lower, def));
    if found.is_some() {
        return found;
    }
    let has = |field| def.field(field).is_some();
    let camera = def.name == "Camera" || def.name == "Scene";
    let surface = has("albedo") || has("material") || has("reflectance") || has("ior");
    Some(match lower.as_str() {
        "sky" | "environment" | "envmap" | "world" | "hdri" | "ambient" | "ambient_light" | "sun"
            if has("background") =>
        {
            "light from all around is `background`: a colour, or Environment(file: \"sky.hdr\"); a sun is a large \
             `SphereLight` far away"
        }
        "emission" | "emissive" | "emit" | "glow" | "light" | "radiance" | "emissive_color"
            if surface && !has("radiance") =>
        {
            "what shines has the material Emissive(radiance: 5)"
        }
        "emission" | "emissive" if def.name == "Scene" => {
            "what shines has the material Emissive(radiance: 5), or stands in `lights`"
        }
        "vertices" | "faces" | "indices" | "triangles" | "points" | "positions" if !has("points") => {
            "the triangles of a mesh stand in a file, Mesh(file: \"cat.obj\"), or in the scene: Mesh(points: [..], \
             faces: [[0, 1, 2]])"
        }
        "dof" | "depth_of_field" | "aperture" | "focus_distance" | "focus" | "f_stop" | "fstop" | "focal_distance"
        | "lens_radius" | "lensradius" | "focaldistance" | "aperture_radius" | "apertureradius" | "bokeh"
            if camera =>
        {
            "blur by depth is an effect: `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`"
        }
        "lens" if camera => {
            "what a lens of 50 mm sees is `focal_length: 50`, instead of `fov`; blur by depth is an effect: `effects: \
             Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`"
        }
        "film_gate" | "aperture_blades" if camera => {
            "the lens is an effect: `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`"
        }
        "f_stop" | "fstop" | "f_number" | "fnumber" | "f" if has("aperture") => {
            "how wide the lens is is its `aperture`, in the scene's unit: the focal length over the f-number"
        }
        "fog" | "mist" | "haze" | "volume" | "volumetric" | "smoke"
            if def.name == "Scene" || def.name == "Effects" || def.name == "Camera" =>
        {
            "there is no fog: only surfaces are seen"
        }
        "hfov" | "xfov" | "fov_x" | "fovx" | "horizontal_fov" if has("fov_axis") => {
            "`fov` is measured up and down; across it is `fov: 60, fov_axis: Horizontal`"
        }
        "aspect" | "aspect_ratio" | "resolution" | "film" | "right" | "film_size" if def.name == "Camera" => {
            "the picture's size, and with it its shape, is `image: Image(width: 640, height: 480)`, or --size"
        }
        "iso" | "ev" | "sensitivity" if def.name == "Camera" => {
            "how bright the picture is is `exposure`, in stops, a field of `effects`"
        }
        "name" if def.name == "Camera" => "a camera has its name in `cameras`: { \"front\": Camera(..) }",
        "rr_depth" | "russian_roulette" | "rrdepth" | "roulette" if has("max_bounces") => {
            "paths end by chance where little would come of them: leave it out"
        }
        "time_limit" | "timeout" | "max_time" if has("max_bounces") => {
            "how long it may take is `time: 60` in seconds, or --time 60s on the command line"
        }
        "noise_threshold" | "adaptive_threshold" | "error_threshold" if has("max_bounces") => {
            "how noisy it may be is `noise: 0.02`, or --noise 2% on the command line"
        }
        "adaptive_sampling" | "use_adaptive_sampling" if has("max_bounces") => {
            "that is `adaptive: Always` or `adaptive: Never`; it is on where a `noise` is asked for"
        }
        "gpu" | "device" | "tile_size" | "tiles" | "bucket_size" if has("max_bounces") => {
            "it is made by all of the processor's threads; how does not show in the picture: leave it out"
        }
        "sampler" | "sampling_pattern" | "light_samples" | "aa_samples"
            if has("max_bounces") || def.name == "Scene" =>
        {
            "there is one sampler, and only `samples` of `render` says how many samples a pixel gets"
        }
        "filter" | "pixel_filter" | "reconstruction_filter" | "rfilter"
            if has("max_bounces") || def.name == "Image" || def.name == "Scene" =>
        {
            "how samples become pixels is said by `effects: Effects(antialiasing: Gaussian(sigma: 0.5))`"
        }
        "aa" | "antialias" | "antialiasing" | "anti_aliasing" | "msaa"
            if has("max_bounces") || matches!(def.name, "Image" | "Scene" | "Camera" | "Output") =>
        {
            "edges are smooth without it: leave it out; how samples become pixels is said by `effects: \
             Effects(antialiasing: Gaussian(sigma: 0.5))`"
        }
        "format" | "filename" | "filepath" | "path" | "bits" | "gamma" | "dpi" | "file" | "output"
            if def.name == "Image" || def.name == "Output" =>
        {
            "how it is written is said on the command line: tracer render scene.ron -o picture.png, .exr, --bits 16"
        }
        "aspect" | "aspect_ratio" if def.name == "Image" => "both sides are written: `width: 640, height: 480`",
        "gamma" if def.name == "Scene" || def.name == "Effects" => {
            "pictures are sRGB: leave it out; how bright they are is the `exposure` of `effects`"
        }
        "bloom" | "glare" | "glow" if matches!(def.name, "Scene" | "Effects" | "Render") => {
            "nothing glows beyond its edge here: leave it out; an EXR file keeps the brightness for another program"
        }
        "vignette" | "vignetting" if matches!(def.name, "Scene" | "Effects" | "Camera" | "Render") => {
            "corners are as bright as the middle: leave it out"
        }
        "quality" | "preset" if has("max_bounces") => {
            "how good it is is said by `samples: 256`, or by the noise that may be left: `noise: 0.02`"
        }
        "falloff" | "decay" | "attenuation" if has("radiance") => {
            "light falls off with the square of the distance, as it does: leave it out"
        }
        "finish" | "shininess" | "specular" | "phong" | "reflection" | "gloss" if has("material") => {
            "how a surface shines belongs to its material: Conductor(..), Mirror(..), BlinnPhong(..)"
        }
        "ior" | "eta" | "refraction" | "index_of_refraction" | "int_ior" if has("material") => {
            "that belongs to a material: `material: Transparent(ior: 1.5)`"
        }
        "emitter" | "is_light" | "area_light" | "arealight" | "areasource" if has("material") => {
            "what shines has the material Emissive(radiance: 5)"
        }
        "interior" | "exterior" | "medium" | "media" if surface || def.name == "Scene" => {
            "only surfaces are seen, nothing within them; glass is the material Transparent(ior: 1.5)"
        }
        "instances" | "instance" | "nodes" if def.name == "Scene" => {
            "copies of an object are its `placements`: Grid(..), Ring(..), Scatter(..), or a list of transforms"
        }
        "global_settings" | "settings" | "options" | "config" if def.name == "Scene" => {
            "how to render is `render: Render(samples: 64)`"
        }
        "ior" | "eta" | "refraction" if has("albedo") => "what refracts is Transparent(ior: 1.5)",
        "zoom" if camera => "how much is seen is said by `fov` in degrees, or by `focal_length` in millimetres",
        "orthographic" | "ortho" | "ortho_scale" | "xmag" | "ymag" | "screenwindow" if camera => {
            "parallel rays: `projection: Orthographic(height: 8)`, the height that the picture shows"
        }
        "panorama" | "spherical" | "equirectangular" | "environment" | "latlong" if camera => {
            "all directions: `projection: Panorama`"
        }
        "fisheye" | "dome" if camera => "a round picture: `projection: Fisheye(fov: 180)`",
        "far" | "far_clip" | "zfar" | "clip_end" if camera => "nothing is too far away to be seen: leave it out",
        "motion_blur"
        | "motionblur"
        | "shutter_open"
        | "shutter_close"
        | "shutter_speed"
        | "shutter_time"
        | "shutter_angle"
        | "exposure_time"
        | "motion_blur_shutter"
        | "shutter"
            if !has("shutter") && (camera || def.name == "Effects" || has("frames")) || def.name == "Camera" =>
        {
            "how long the shutter is open is the camera's `shutter`, a share of a frame: 0.5 for 180 degrees"
        }
        "rotation" | "direction" | "forward" if camera => {
            "the camera's direction is said by `look_at`, the point that it looks at, or by `matrix`"
        }
        "clock" | "initial_clock" | "final_clock" | "initial_frame" | "frame_step" | "frame_start" | "start_frame"
            if has("frames") || def.name == "Scene" =>
        {
            "`animation: Animation(frames: 48)` counts frames from 0; which are rendered is said on the command line: \
             --frames 0-47"
        }
        "duration" | "seconds" if has("frames") || def.name == "Scene" => {
            "how long it lasts is `frames` over `fps`: `animation: Animation(frames: 48, fps: 24)`"
        }
        "motion_keys" | "motion_steps" if has("frames") => {
            "each sample sees the scene at a moment of its own while the camera's `shutter` is open: leave it out"
        }
        "bump" | "bump_map" | "normal_map" | "normal" | "displacement" | "normals" if surface => {
            "surfaces have no bumps: they need to be in the mesh; `shading: Smooth` rounds a mesh"
        }
        "bump" | "normal_map" | "displacement" => "surfaces have no bumps: they need to be in the mesh",
        "rough" | "roughness" | "glossiness" | "gloss" | "smoothness" | "metallic" | "metalness" | "clearcoat"
        | "anisotropy"
            if surface || def.name == "Scene" =>
        {
            "how rough a gloss is is the `exponent` of BlinnPhong, about 2 / roughness^4: 10 is dull, 100000 nearly a \
             mirror; rough metal is a Conductor"
        }
        "opacity" | "alpha" | "alpha_map" | "transparency" if def.name == "Transparent" => {
            "how much of the light passes each surface is its `transmittance`"
        }
        "opacity" | "alpha" | "alpha_map" | "transparency" | "alpha_test" | "alphatest" | "alpha_cutoff" if surface => {
            "no picture cuts holes here: what is not there is left out of a mesh, or of the outline of an Extrude; \
             what is seen through is Transparent(ior: 1.5)"
        }
        "resolution" | "size" | "film" if def.name == "Scene" => {
            "the size is `image: Image(width: 640, height: 480)`, or --size"
        }
        "output" | "filename" | "file" if def.name == "Scene" => {
            "the picture's name stands on the command line: tracer render scene.ron -o picture.png"
        }
        "id" | "label" | "tag" if def.field("name").is_some() => "what is called something has a `name`",
        "name" | "id" | "label" | "tag" => "objects, lights and materials have names; write others as a comment",
        "no_image" | "hide_from_camera" | "hidden_from_camera" | "invisible_to_camera" if has("camera_visible") => {
            "what the camera is not to see is `camera_visible: false`"
        }
        "visible" | "hidden" | "hide" | "visibility" | "hide_render" | "invisible" if has("camera_visible") => {
            "leave the object out, or make it a comment; for the camera alone it is hidden by `camera_visible: false`"
        }
        "no_shadow"
        | "no_reflection"
        | "cast_shadow"
        | "cast_shadows"
        | "castshadow"
        | "receiveshadow"
        | "receive_shadow"
        | "visible_shadow"
        | "visible_diffuse"
        | "visible_glossy"
        | "visible_transmission"
            if has("camera_visible") =>
        {
            "only the camera may not see a thing, `camera_visible: false`: all throws shadows and shows in mirrors"
        }
        "visible" | "hidden" | "enabled" | "hide" | "visibility" | "cast_shadow" | "cast_shadows" | "double_sided" => {
            "all that is written is seen: leave the object out, or make it a comment"
        }
        "y" | "d" | "height" | "offset" | "distance" | "level" | "z" if def.name == "Plane" => {
            "where a plane is, a point of it says, `point: (0, -1, 0)` one below the origin; which way it faces, its \
             `normal`"
        }
        "units" | "unit" => "a scene has one unit, whichever it is: leave it out",
        _ => return None,
    })
}
