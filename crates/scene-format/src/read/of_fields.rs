//! Fields of other programs that are said in another way here.

use crate::schema::StructDef;

/// What is said of things that show nothing but shadows.
pub(super) const SHADOW_CATCHER: &str = "there is no shadow catcher: render with and without the body before the \
                                         same floor, and let another program divide the pictures";

/// How it is said here.
// Long: a table.
pub(super) fn elsewhere(lower: &str, def: &'static StructDef) -> Option<&'static str> {
    let has = |field| def.field(field).is_some();
    let camera = def.name == "Camera";
    let texture = has("file") && has("mapping");
    Some(match lower {
        "absorption"
        | "absorption_color"
        | "sigma_a"
        | "attenuation"
        | "extinction"
        | "absorbance"
        | "density"
        | "beer_lambert"
        | "attenuation_color"
        | "attenuation_distance"
        | "fade_color"
        | "fade_distance"
        | "fade_power"
        | "transmit"
        | "filter"
            if has("ior") =>
        {
            "glass takes nothing on the way through: it is coloured by `transmittance`, once at each surface"
        }
        "priority" if has("ior") => "which of two glasses holds where they meet needs no number: leave it out",
        "dispersion" | "abbe" | "abbe_number" | "abbe_v" | "vd" | "cauchy" | "cauchy_a" | "cauchy_b" | "sellmeier"
        | "spectral"
            if has("ior") =>
        {
            "there are no wavelengths: red, green and blue are refracted alike, so leave it out"
        }
        "thin" | "thin_walled" | "thinwalled" | "thin_film" if def.name == "Transparent" => {
            "a pane is a thin `Box` of Transparent(ior: 1.5), which shifts what is behind it by less than its thickness"
        }
        "rough" | "roughness" | "glossiness" | "smoothness" if def.name == "Transparent" => {
            "glass is smooth here: Transparent(ior: 1.5)"
        }
        "rough" if def.name == "Conductor" => "how rough a metal is is its `roughness`",
        "alpha" | "alpha_x" | "alpha_y" if def.name == "Conductor" => "`roughness` is the root of alpha: 0.3 for 0.09",
        "anisotropy" | "anisotropic" if def.name == "Conductor" => "metal is as rough in all directions: `roughness`",
        "cast_shadow" | "cast_shadows" | "casts_shadows" | "castshadow" | "shadow" | "shadows" | "no_shadow"
            if has("radiance") =>
        {
            "all that is lit throws shadows, and no lamp does without: leave it out; soft ones come of a large \
             `radius` or a large shape that shines, and hardly any of a `background`"
        }
        "transmission" | "transmittance" | "translucency" | "translucent" | "subsurface" | "diffuse_transmission"
            if has("albedo") =>
        {
            "no light goes through it: what lets light through is Transparent(ior: 1.5); a lampshade that glows may \
             shine a little itself, Emissive(radiance: 0.2, color: (1, 0.8, 0.6))"
        }
        "two_sided" | "double_sided" | "doublesided" | "twosided" | "side"
            if !has("two_sided") && (has("albedo") || has("reflectance") || has("ior")) =>
        {
            "all surfaces have two sides and look alike from both: leave it out"
        }
        "shadow_catcher" | "shadowcatcher" | "is_shadow_catcher" | "catch_shadows" | "shadow_only"
            if has("material") || has("albedo") =>
        {
            SHADOW_CATCHER
        }
        "mask" | "normaltexture" | "opacity_mask" if has("albedo") || has("material") => {
            "surfaces have no masks and no bumps: what is not there is left out of the mesh"
        }
        "texture_transform" | "uv_transform" | "uvtransform" if texture => {
            "it is moved and turned by its mapping: `mapping: Uv(scale: (2, 2), offset: (0, 0), rotation: 30)`"
        }
        "interpolation" | "filter_type" | "filtering" if texture => {
            "how it is filtered is `filter`: Bilinear or Nearest"
        }
        "extension" | "wrap_mode" | "extend" if texture => "what is beyond the picture is said by `wrap`",
        "gamma" | "encoding" | "srgb" | "raw" if texture => "what its numbers mean is `color_space`",
        "roll" if camera => "it is turned about its view by `up`: (0.1, 1, 0) for a little",
        "focus_on" | "focal_point" if camera => {
            "what is sharp is an effect: `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_on: ..))`"
        }
        "principal_point_offset_x" | "principal_point_offset_y" | "lens_shift" if camera => {
            "the picture is shifted by `shift: (0.1, 0)`"
        }
        "interocular" | "eye_separation" | "ipd" | "interpupillary_distance" if camera => {
            "two eyes are `stereo: Stereo(..)`"
        }
        "velocity" | "motion" if has("material") => {
            "what moves has expressions of `time`: `center: (\"=time\", 0, 0)`, and the camera a `shutter`"
        }
        "count" | "repeat" | "copies" if has("placements") => {
            "copies are its `placements`, Grid(..), Ring(..) or Scatter(..), or made by `Repeat(count: 8, items: [..])`"
        }
        "up" | "up_axis" | "upaxis" | "y_up" | "z_up" | "axis_up" | "orientation" if def.name == "Mesh" => {
            "y is up here; what lies on its side since its program has z up is turned: `transform: [Rotate(axis: (1, \
             0, 0), degrees: -90)]`"
        }
        "look_at" | "lookat" | "track_to" | "facing" if has("material") && has("transform") => {
            "it is turned by `transform: [Align(from: (0, 0, 1), to: (1, 0, 0))]`, one direction to another"
        }
        "area" | "region" | "bounds" | "domain" if has("min") && has("max") => {
            "the box is said by two corners opposite, `min: (-5, 0, -5), max: (5, 0, 5)`"
        }
        "pivot" | "origin" | "anchor" if has("transform") => {
            "what it turns about is said by the turn: `transform: [Rotate(axis: (0, 1, 0), degrees: 30, about: (0, 0, \
             0))]`"
        }
        "perspectivecamera" | "orthographiccamera" if camera => {
            "the camera's fields stand in `camera` itself, and what kind it is in its `projection`"
        }
        "size" | "extent" if def.name == "Grid" => {
            "how far apart its copies are is its `spacing`, along x, y and z: (2, 1, 2)"
        }
        "direction" | "target" | "look_at" | "angle" | "cone_angle" if def.name == "SphereLight" => {
            "it shines to all sides; one that shines to one side is an object: Rectangle(size: 1, normal: (0, -1, 0), \
             material: Emissive(radiance: 5))"
        }
        "specular" | "shininess" | "phong" | "gloss" | "specular_color" if def.name == "Diffuse" => {
            "a surface with a gloss is BlinnPhong(albedo: 0.5, exponent: 1000, specular: 0.1, energy_conserving: true)"
        }
        "parent" if has("material") => "what is moved together stands in a `Group(objects: [..], transform: [..])`",
        "engine" | "renderer" | "integrator_type" if def.name == "Scene" => {
            "how light is followed is `render: Render(integrator: Full)`, which it is without the word, or Path"
        }
        "title" | "description" | "author" if def.name == "Scene" => {
            "leave it out; a comment has room for it, but in JSON"
        }
        "default" | "array" | "driver" | "link" | "functions" if def.name == "Scene" => {
            "values with names stand in `vars`, and are reckoned with in expressions: \"=2*height\""
        }
        "transparent" if def.name == "Output" => "the background is left out of the picture by `alpha: true`",
        "transparent" | "film_transparent" | "transparent_background"
            if matches!(def.name, "Image" | "Scene" | "Render") =>
        {
            "the background is left out of the picture by `output: Output(alpha: true)`"
        }
        "radiosity" | "global_illumination" | "gi" if matches!(def.name, "Scene" | "Render") => {
            "light that surfaces send on is always there; how often is `render: Render(max_bounces: 8)`"
        }
        _ => return None,
    })
}
