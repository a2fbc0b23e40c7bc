//! What other programs call our fields.

use crate::schema::StructDef;

/// Ours, and theirs. A word may stand for several: which one is said by the value.
const SYNONYMS: &[(&str, &[&str])] = &[
    ("objects", &["children", "items", "members", "contents", "shapes", "of", "operands", "parts"]),
    (
        "position",
        &[
            "eye",
            "origin",
            "from",
            "pos",
            "location",
            "look_from",
            "eye_point",
            "translate",
            "translation",
            "viewpoint",
            "camera_position",
        ],
    ),
    ("look_at", &["target", "lookat", "to", "at", "interest", "aim", "center_of_interest"]),
    ("up", &["sky", "up_vector", "vup", "world_up", "up_direction", "upvec"]),
    ("matrix", &["to_world", "matrix_world", "transform", "world_matrix", "camera_to_world", "c2w", "pose"]),
    ("count", &["times", "n", "number", "repeat", "repetitions", "repeats", "num", "iterations"]),
    ("y", &["height", "level", "floor", "ground", "to", "on"]),
    ("cameras", &["views", "viewpoints", "camera_list"]),
    ("animation", &["anim", "animate", "timeline", "motion"]),
    ("frames", &["frame_count", "num_frames", "frame_end", "final_frame", "count", "length", "end"]),
    ("fps", &["frame_rate", "framerate", "frames_per_second", "rate"]),
    ("frame", &["frame_current", "current_frame", "frame_number"]),
    ("center", &["c", "middle", "centre", "position", "pos", "origin", "location", "loc"]),
    ("point", &["center", "centre", "position", "pos", "origin", "location", "through"]),
    ("radius", &["r", "size", "base_radius", "bottom_radius", "radius1", "from_radius", "outer_radius", "outer"]),
    ("radius", &["shaft_radius", "shaft"]),
    ("head_radius", &["tip_radius", "cone_radius"]),
    ("head_length", &["tip_length", "cone_length", "head_height", "tip_height"]),
    ("k", &["kappa", "extinction", "extinction_coefficient", "absorption_coefficient"]),
    ("normal", &["facing", "axis", "direction", "dir", "n", "face_normal"]),
    ("about", &["pivot", "around", "center", "centre", "origin", "point", "anchor", "fixed_point", "pivot_point"]),
    ("spacing", &["step", "steps", "distance", "pitch", "interval", "min_distance", "minimum_distance"]),
    ("rotation", &["rotate", "yaw", "azimuth", "turn"]),
    ("scale", &["intensity", "strength", "multiplier", "brightness"]),
    ("fov", &["field_of_view", "angle", "vfov", "yfov", "fovy", "view_angle", "vertical_fov"]),
    ("focal_length", &["focal", "focallength"]),
    ("sensor_width", &["sensor", "film_width", "sensor_size", "film_size", "horizontal_aperture"]),
    ("near", &["clip", "near_clip", "znear", "clip_start", "near_plane"]),
    ("shift", &["shift_x", "shift_y", "principal_point_offset", "lens_shift"]),
    ("stereo", &["stereoscopy", "stereoscopic", "multiview", "multi_view", "stereo_mode", "stereo_3d"]),
    ("separation", &["interocular_distance", "eye_separation", "interaxial", "ipd", "eye_distance", "distance"]),
    ("separation", &["interaxial_separation", "interpupillary_distance", "interocular", "eye_width"]),
    ("convergence", &["convergence_distance", "zero_parallax", "convergence_plane_distance", "focus_distance"]),
    ("layout", &["stereo_mode", "display_mode", "stereo_format", "type", "kind", "mode", "format"]),
    ("projection", &["type", "kind", "camera_type", "lens_type"]),
    ("fov_axis", &["axis", "sensor_fit"]),
    ("focus_distance", &["focus", "focal_distance", "focaldistance"]),
    ("focus_on", &["focal_point", "focus_object", "focus_point", "focus"]),
    ("depth_of_field", &["dof", "bokeh", "depth_blur"]),
    ("blades", &["aperture_blades", "num_blades"]),
    ("width", &["w", "x", "thickness", "line_width", "xresolution", "xres", "resolution_x", "res_x"]),
    ("height", &["h", "y", "yresolution", "yres", "resolution_y", "res_y"]),
    (
        "samples",
        &["spp", "samples_per_pixel", "sample_count", "pixel_samples", "num_samples", "nsamples", "max_samples"],
    ),
    ("max_bounces", &["max_depth", "depth", "bounces", "max_trace_level", "ray_depth", "path_depth", "max_ray_depth"]),
    (
        "clamp",
        &["clamp_indirect", "clamp_direct", "max_radiance", "firefly_clamp", "radiance_clamp", "max_component_value"],
    ),
    ("albedo", &["color", "colour", "diffuse", "base_color", "reflectance", "rgb", "hex", "kd", "pigment", "texture"]),
    ("albedo", &["base_color_factor", "base_color_texture", "diffuse_color", "map", "map_kd", "image", "tint"]),
    ("reflectance", &["color", "colour", "albedo", "rgb", "hex", "kr", "tint", "base_color", "specular_reflectance"]),
    (
        "transmittance",
        &["color", "colour", "tint", "kt", "rgb", "hex", "specular_transmittance", "base_color", "filter"],
    ),
    ("metal", &["material", "preset"]),
    ("material", &["bsdf", "shader", "mat", "surface", "materials"]),
    ("factor", &["by", "amount", "ratio", "s", "factors", "value", "size", "to"]),
    ("items", &["objects", "children", "contents", "elements", "list"]),
    ("materials", &["bsdfs", "shaders", "material", "mats"]),
    ("lights", &["emitters", "light_sources", "lamps", "luminaires"]),
    ("objects", &["meshes", "models", "primitives", "geometry", "entities", "geometries"]),
    (
        "vars",
        &[
            "variables",
            "parameters",
            "params",
            "constants",
            "declare",
            "define",
            "defines",
            "consts",
            "values",
            "locals",
            "let",
        ],
    ),
    ("include", &["imports", "includes", "import", "libraries"]),
    ("placements", &["instances", "copies", "array", "duplicates", "instance_transforms"]),
    ("tone_map", &["tonemap", "tonemapping", "tone_mapping", "view_transform", "tonemapper"]),
    (
        "ior",
        &[
            "index",
            "eta",
            "n",
            "refractive_index",
            "int_ior",
            "index_of_refraction",
            "refraction",
            "ni",
            "refraction_index",
        ],
    ),
    (
        "file",
        &[
            "path",
            "filename",
            "mesh",
            "src",
            "url",
            "uri",
            "source",
            "file_name",
            "image",
            "obj",
            "stl",
            "ply",
            "model",
        ],
    ),
    ("index", &["var", "variable", "counter", "as"]),
    ("degrees", &["angle", "deg"]),
    ("exponent", &["shininess", "alpha", "glossiness", "ns", "phong_size", "hardness", "specular_exponent"]),
    ("specular", &["ks", "phong", "specularity", "specular_color"]),
    ("transform", &["transforms", "trs", "transformation", "transformations"]),
    (
        "points",
        &["vertices", "positions", "verts", "p", "corners", "outline", "profile", "path", "spine", "centerline"],
    ),
    ("faces", &["indices", "triangles", "polygons"]),
    ("inner_radius", &["innerradius", "inner", "hole"]),
    ("distance", &["max_distance", "maxdistance", "radius", "range", "ao_distance"]),
    ("tip_radius", &["radius2", "top_radius", "tipradius", "end_radius", "radius_top", "cap_radius", "to_radius"]),
    ("camera_visible", &["visible_camera", "visible_to_camera", "primary_visibility", "primaryvisibility"]),
    ("camera_visible", &["camera_visibility", "seen_by_camera", "visible_in_camera", "visible_in_primary_ray"]),
    ("caps", &["cap", "closed", "capped", "end_caps"]),
    ("from", &["p0", "a", "start", "base_point", "bottom", "base", "tail", "begin", "start_point"]),
    (
        "to",
        &["p1", "b", "end", "cap", "apex", "tip", "top", "head", "cap_point", "end_point", "apex_point", "tip_point"],
    ),
    ("size", &["dimensions", "dims", "extent", "extents", "sides"]),
    ("profile", &["points", "outline", "curve_points", "path", "shape", "polygon", "silhouette", "vertices"]),
    ("outline", &["points", "profile", "shape", "path", "polygon", "rings", "contour", "contours", "vertices"]),
    ("depth", &["height", "thickness", "length", "amount", "distance", "extrusion"]),
    ("segments", &["sides", "resolution", "steps", "slices", "divisions", "subdivisions", "facets"]),
    ("kind", &["type", "noise_type", "noisetype", "basis", "fractal", "fractal_type"]),
    ("octaves", &["detail", "levels", "depth", "octave"]),
    ("gain", &["roughness", "persistence", "persistance", "omega"]),
    ("lacunarity", &["lambda", "frequency_multiplier"]),
    ("distortion", &["turbulence", "turb", "warp", "wobble", "bend"]),
    ("feature", &["type", "kind", "mode", "output"]),
    ("jitter", &["randomness", "random"]),
    (
        "a",
        &[
            "color1", "colour1", "color_1", "color_a", "colour_a", "colora", "col1", "c1", "dark", "low", "even",
            "tex1", "first", "from", "start",
        ],
    ),
    (
        "b",
        &[
            "color2", "colour2", "color_2", "color_b", "colour_b", "colorb", "col2", "c2", "light", "high", "odd",
            "tex2", "second", "to", "end",
        ],
    ),
    ("weight", &["factor", "fac", "amount", "mask", "blend", "t", "alpha"]),
    ("input", &["factor", "fac", "texture", "value", "t", "pattern"]),
    ("stops", &["color_map", "colour_map", "colors", "colours", "elements", "points", "entries", "keys", "palette"]),
    ("axis", &["direction", "dir"]),
    ("along", &["direction", "axis", "orientation"]),
    ("cryptomatte", &["crypto", "crypto_object", "crypto_material", "mattes", "matte", "cryptomattes"]),
    ("layers", &["aovs", "aov", "passes", "render_passes", "channels"]),
    ("masks", &["mask", "object_masks", "holdouts"]),
    (
        "light_groups",
        &["light_group", "lightgroups", "lightgroup", "light_layers", "light_passes", "lpe", "light_aovs"],
    ),
    ("part", &["submesh", "sub_mesh", "node", "node_name", "object_name", "group_name", "mesh_name", "subset"]),
    ("group", &["lightgroup", "light_group", "light_layer", "aov_group"]),
    ("marks", &["labels", "points", "anchors", "annotations"]),
];

/// The two radii of a torus are told apart by small and large letters alone.
const OF_TORUS: &[(&str, &[&str])] = &[
    ("radius", &["R", "r1", "radius1", "major", "major_radius", "ring_radius", "radius_major", "main_radius"]),
    (
        "tube_radius",
        &["r", "r2", "radius2", "minor", "minor_radius", "tube", "radius_minor", "section_radius", "thickness_radius"],
    ),
];

/// The two radii of a cone, by its ends.
const OF_CONE: &[(&str, &[&str])] = &[
    ("radius", &["radius_from", "r1", "radius_a", "radius_bottom", "radius_base", "radius_start", "start_radius"]),
    ("tip_radius", &["radius_to", "r2", "radius_b", "radius_tip", "radius_end", "radius_apex"]),
];

/// A word without what programs join words by: `lookAt`, `look_at` and `lookat` are one.
pub(crate) fn squeezed(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, '_' | '-' | ' ')).map(|c| c.to_ascii_lowercase()).collect()
}

/// Our fields that other programs call so.
pub(super) fn called_elsewhere(name: &str) -> Vec<&'static str> {
    let plain = squeezed(name);
    let same = |others: &[&str]| others.iter().any(|other| squeezed(other) == plain);
    let mut fields: Vec<&'static str> =
        SYNONYMS.iter().filter(|(_, others)| same(others)).map(|(ours, _)| *ours).collect();
    fields.sort_unstable();
    fields.dedup();
    fields
}

/// What other programs call a field of ours by this name, the most likely first.
pub(crate) fn synonyms(name: &str, def: &'static StructDef) -> Vec<&'static str> {
    let torus = def.name == "Torus";
    let own: &[(&str, &[&str])] = match def.name {
        "Torus" => OF_TORUS,
        "Cone" => OF_CONE,
        _ => &[],
    };
    let own = own.iter().filter(|(_, others)| others.contains(&name));
    let plain = squeezed(name);
    // `Instances` is our own word in other letters, not one of those that mean `placements`.
    if let Some(own) = def.fields.iter().find(|field| squeezed(field.name) == plain) {
        return vec![own.name];
    }
    let ambiguous = torus && matches!(&*plain, "r" | "outer" | "outerradius" | "inner" | "innerradius");
    let same = |others: &[&str]| others.iter().any(|other| squeezed(other) == plain);
    let all = SYNONYMS.iter().filter(|(field, others)| !ambiguous && def.field(field).is_some() && same(others));
    own.chain(all).map(|(field, _)| *field).collect()
}
