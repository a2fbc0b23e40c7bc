//! What was meant by a word that is not there: the words of other programs, and the right place.

use super::pattern_fields::of_pattern;
use super::shape_fields::of_shape;
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
        "color" | "colour" | "albedo" | "texture" if has("material") && ron => {
            Some("colours belong to a material: `material: Diffuse(albedo: ..)`")
        }
        "color" | "colour" | "albedo" | "texture" if has("material") => {
            Some("colours belong to a material: `material = { Diffuse = { albedo = .. } }`")
        }
        "size" | "width" | "radius" | "extent" if def.name == "Plane" => {
            Some("a `Plane` has no end; what has one is a `Rectangle`, with a `size`")
        }
        "scale" | "size" if has("transform") && ron => Some("write it as a transform: `transform: [Scale(2)]`"),
        "scale" | "size" if has("transform") => Some("write it as a transform: `transform = [{ Scale = 2 }]`"),
        "position" | "center" | "translate" | "translation" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Translate((x, y, z))]`")
        }
        "position" | "center" | "translate" | "translation" if has("transform") => {
            Some("write it as a transform: `transform = [{ Translate = [x, y, z] }]`")
        }
        "matrix" | "to_world" | "matrix_world" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Matrix(rows: ((a, b, c, x), (d, e, f, y), (g, h, i, z)))]`")
        }
        "matrix" | "to_world" | "matrix_world" if has("transform") => Some(
            "write it as a transform: `transform = [{ Matrix = { rows = [[a, b, c, x], [d, e, f, y], [g, h, i, z]] } \
             }]`",
        ),
        "rotate" | "rotation" if has("transform") && ron => {
            Some("write it as a transform: `transform: [Rotate(axis: (0, 1, 0), degrees: 90)]`")
        }
        "rotate" | "rotation" if has("transform") => {
            Some("write it as a transform: `transform = [{ Rotate = { axis = [0, 1, 0], degrees = 90 } }]`")
        }
        _ => None,
    };
    words.map(|words| syntax.of_toml(words))
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
    // Of things width and height are their own, not the picture's.
    if matches!(name, "width" | "height")
        && def.name != "Scene"
        && Scene::DEF.fields.iter().all(|field| !is_group(field, def))
    {
        return None;
    }
    let group = Scene::DEF
        .fields
        .iter()
        .find(|field| field.kind.group().is_some_and(|group| group.name != def.name && group.field(name).is_some()))?;
    let group = group.name;
    Some(match toml {
        true => format!("`{name}` is a field of [{group}]"),
        false => format!("`{name}` is a field of `{group}`"),
    })
}

/// Whether this field of the scene has these fields.
fn is_group(field: &FieldDef, def: &'static StructDef) -> bool {
    field.kind.group().is_some_and(|group| group.name == def.name)
}

/// What other programs call a kind of ours.
pub(super) fn kind_elsewhere(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    const SYNONYMS: &[(&str, &[&str])] = &[
        ("Linear", &["linear_spline", "linearspline", "polyline", "straight", "lines", "polygon"]),
        ("CatmullRom", &["cubic_spline", "cubicspline", "quadratic_spline", "spline", "smooth", "cubic", "natural"]),
        ("SideBySide", &["sidebyside", "side_by_side", "sbs", "left_right", "leftright", "horizontal", "lr"]),
        ("TopBottom", &["topbottom", "top_bottom", "over_under", "overunder", "tab", "vertical", "above", "tb"]),
        ("SphereLight", &["pointlight", "light", "lamp", "spherearealight"]),
        ("Matrix", &["matrix", "matrix_world", "matrixworld", "to_world", "toworld", "matrix4", "mat4", "affine"]),
        ("Matrix", &["transform", "concattransform", "concat_transform"]),
        ("Align", &["orient", "aligned", "align_to", "alignto", "rotate_to", "rotateto", "point_at", "reorient"]),
        ("FitTo", &["fit", "resize", "normalize", "normalise", "unitize", "scale_to", "scaleto", "dimensions"]),
        ("DropTo", &["drop", "ground", "place_on", "rest_on"]),
        ("Group", &["node", "collection", "shapegroup", "assembly"]),
        ("Checkerboard", &["checker", "checkers", "chess", "chessboard", "checkertexture"]),
        ("Noise", &["perlin", "fbm", "clouds", "wrinkled", "granite", "bozo", "windy", "noisetexture", "musgrave"]),
        ("Noise", &["turbulence", "fractalnoise", "perlinnoise", "spotted", "bumps"]),
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
    let lower = name.to_ascii_lowercase();
    let told = Material::TOLD.iter().chain(Object::TOLD).map(|(kind, others, _)| (kind, others));
    let mut all = SYNONYMS.iter().map(|(kind, others)| (kind, others)).chain(told);
    let found = all.find(|(kind, others)| def.variant(kind).is_some() && others.contains(&lower.as_str()));
    found.map(|(kind, _)| *kind)
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
        "mapping" | "mapping of a solid texture" => MAPPINGS,
        "light" => LIGHTS,
        "transform" => TRANSFORMS,
        "layer" => LAYERS,
        _ => return None,
    };
    table.iter().find(|(names, _)| names.contains(&lower.as_str())).map(|(_, hint)| *hint)
}

type Hints = &'static [(&'static [&'static str], &'static str)];

const OBJECTS: Hints = &[
    (&["pyramid"], "other shapes are meshes: name an OBJ, OFF, PLY, STL, glTF or GLB file in a `Mesh`"),
    (&["ellipsoid", "spheroid"], "an ellipsoid is a `Sphere` with `transform: [Scale((1, 2, 1))]`"),
    (
        &["bezier", "nurbs", "text"],
        "there is no such shape yet: make a mesh of it, in OBJ, OFF, PLY, STL, glTF or GLB, and name its file in a \
         `Mesh`",
    ),
    (
        &["instance", "objectinstance", "copy", "array", "clone", "for", "loop"],
        "copies of an object are its `placements`: a list, a file, Grid(..), Ring(..) or Scatter(..); `Repeat(count: \
         .., items: [..])` makes \
         objects by a rule",
    ),
    (
        &["csg", "boolean", "booleanmodifier", "solid"],
        "closed shapes are put together by Union(objects: [..]) and cut by Intersection(objects: [..]) and \
         Difference(objects: [..]), the first without the others",
    ),
    (
        &["import", "link", "reference", "scene"],
        "another scene comes by `Include(file: ..)`, geometry of other files by `Mesh(file: ..)`",
    ),
    (
        &["arealight", "area", "quadlight", "rectlight", "rectanglelight", "meshlight", "lamp"],
        "a lamp is an object that shines: `Rectangle(size: 1, material: Emissive(radiance: 5))`",
    ),
    (&["spherelight", "pointlight", "light", "sun", "spotlight"], "lights stand in `lights`, beside `objects`"),
    (&["camera"], "the camera is the scene's `camera`, beside `objects`"),
    (
        &["volume", "fog", "medium", "smoke", "hair", "particles", "points", "metaballs", "sdf"],
        "there is no such thing: surfaces only",
    ),
];

const MATERIALS: Hints = &[
    (
        &["translucent", "difftrans", "subsurface", "sss", "skin", "wax", "cloth", "velvet", "sheen", "hair", "paper"],
        "there is no such material; the nearest are `Diffuse` and, for what lets light through, `Transparent(ior: \
         1.5)`",
    ),
    (
        &[
            "principled",
            "disney",
            "pbr",
            "standard",
            "metallicroughness",
            "uber",
            "plastic",
            "roughplastic",
            "coat",
            "coateddiffuse",
        ],
        "a coloured surface with a gloss is BlinnPhong(albedo: .., exponent: 1000, specular: 0.1, energy_conserving: \
         true)",
    ),
    (&["frostedglass", "frosted", "roughglass", "roughdielectric"], "glass is smooth here: Transparent(ior: 1.5)"),
    (
        &["mix", "blend", "blendbsdf", "layered"],
        "materials cannot be mixed, but colours can: Diffuse(albedo: Mix(a: .., b: ..)); `BlinnPhong` mixes a matt and \
         a glossy share",
    ),
    (&["null", "none", "invisible"], "leave the object out"),
    (&["thindielectric", "thintransparent"], "a pane is a thin `Box` of Transparent(ior: 1.5)"),
    (&["normalmap", "bumpmap", "bump", "displacement"], "surfaces have no bumps: they need to be in the mesh"),
];

const TEXTURES: Hints = &[
    (
        &["bricks", "brick", "bricktexture"],
        "there is no such pattern: make a picture of it, and name its file: Texture(file: \"bricks.png\")",
    ),
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
    "there are no control points: the curve goes through all points, so take points on it and `CatmullRom`",
)];

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

const LIGHTS: Hints = &[
    (
        &["directional", "distant", "sun", "directionallight", "distantlight", "sunlight", "parallel", "parallellight"],
        "a sun is a large sphere light far away",
    ),
    (
        &[
            "sky",
            "sunsky",
            "sunandsky",
            "environment",
            "environmentmap",
            "envmap",
            "envlight",
            "environmentlight",
            "hdri",
            "infinite",
            "infinitelight",
            "ibl",
            "domelight",
            "dome",
            "constant",
            "ambient",
            "ambientlight",
            "skylight",
        ],
        "light from all around is the scene's `background`: a colour, or `Environment(file: \"sky.hdr\")`",
    ),
    (
        &[
            "quadlight",
            "rectanglelight",
            "rectlight",
            "arealight",
            "area",
            "disklight",
            "quad",
            "meshlight",
            "emission",
            "emissive",
            "emitter",
        ],
        "a flat lamp is an object that shines: `Rectangle(material: Emissive(radiance: 5))` in `objects`",
    ),
    (&["pointlight", "point", "omni"], "a point light is a small sphere: radius: 0.01, intensity: .. in W/sr"),
    (
        &["spotlight", "spot", "ies", "goniometric", "goniometriclight", "projector", "projectionlight"],
        "there is no spotlight: put a `SphereLight` into a tube or box of objects, open to one side",
    ),
];

const TRANSFORMS: Hints = &[
    (
        &["matrix_world", "matrixworld", "to_world", "toworld", "matrix4", "mat4", "affine"],
        "its rows are these, and a fourth, 0, 0, 0, 1, which is left out",
    ),
    (
        &["transform", "concattransform", "concat_transform"],
        "pbrt lists columns, so the first row takes the first number of each four; its x is mirrored: change the signs \
         of the first row, then \
         of the first column",
    ),
    (
        &["matrix"],
        "POV-Ray and glTF list columns, so that rows and columns change places; POV-Ray's x is mirrored: change the \
         signs of the first row, \
         then of the first column",
    ),
    (
        &["lookat", "look_at", "track", "trackto", "track_to"],
        "Align(from: (0, 0, 1), to: (1, 0, 0)) turns one direction to another; the camera alone has `look_at`",
    ),
    (&["shear", "skew"], "a `Matrix` may shear: Matrix(rows: ((1, 0.5, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)))"),
    (&["mirror", "reflect", "flip"], "a negative factor mirrors: Scale((-1, 1, 1))"),
    (
        &["quaternion", "euler", "euler_xyz"],
        "turn about one axis after the other: Rotate(axis: (0, 1, 0), degrees: 90)",
    ),
];

/// What is said of fields for the brightness of a light that there are not.
pub(super) fn strength(name: &str, def: &'static StructDef) -> Option<&'static str> {
    if !def.exactly_one.contains(&"radiance") {
        return None;
    }
    match name.to_ascii_lowercase().as_str() {
        "color" | "colour" | "rgb" => {
            Some("a light's colour is in its brightness, per channel: `radiance: (1, 0.9, 0.8)`")
        }
        "brightness" | "strength" | "energy" | "emission" | "scale" | "luminance" | "exposure" => {
            Some("how bright a light is is said by `radiance`, by `power` in W, or for spheres by `intensity` in W/sr")
        }
        "watts" | "watt" | "flux" | "lumens" | "lumen" => Some("the light that is given in all is `power`, in W"),
        _ => None,
    }
}

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
    let found = of_pattern(&lower, def).or_else(|| of_shape(&lower, def, syntax)).or_else(|| command_line(&lower, def));
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
            "light from all around is `background`, one colour; a sun is a large `SphereLight` far away"
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
        | "lens_radius" | "bokeh"
            if camera =>
        {
            "blur by depth is an effect: `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`"
        }
        "lens" | "film_gate" | "aperture_blades" if camera => {
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
        "duration" | "seconds" if has("frames") => "the duration is `frames` over `fps`",
        "motion_keys" | "motion_steps" if has("frames") => {
            "each sample sees the scene at a moment of its own while the camera's `shutter` is open: leave it out"
        }
        "bump" | "bump_map" | "normal_map" | "normal" | "displacement" | "normals" if surface => {
            "surfaces have no bumps: they need to be in the mesh; `shading: Smooth` rounds a mesh"
        }
        "bump" | "normal_map" | "displacement" => "surfaces have no bumps: they need to be in the mesh",
        "roughness" | "glossiness" | "gloss" | "smoothness" | "metallic" | "metalness" | "clearcoat" | "anisotropy"
            if surface || def.name == "Scene" =>
        {
            "how rough a gloss is is the `exponent` of BlinnPhong, about 2 / roughness^4: 10 is dull, 100000 nearly a \
             mirror; rough metal is a Conductor"
        }
        "opacity" | "alpha" | "alpha_map" | "transparency" if surface => {
            "what is seen through is Transparent(ior: 1.5)"
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
            "where a plane is, a point of it says: `point: (0, 1, 0)`; which way it faces, its `normal`"
        }
        "units" | "unit" => "a scene has one unit, whichever it is: leave it out",
        _ => return None,
    })
}
