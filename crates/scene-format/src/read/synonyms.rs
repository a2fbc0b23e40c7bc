//! What other programs call our fields.

use crate::schema::StructDef;

/// Ours, and theirs. A word may stand for several: which one is said by the value.
const SYNONYMS: &[(&str, &[&str])] = &[
    ("objects", &["children", "items", "members", "contents", "shapes"]),
    ("position", &["eye", "origin", "from", "pos", "location"]),
    ("look_at", &["target", "lookat", "to"]),
    ("matrix", &["to_world", "matrix_world", "transform", "world_matrix", "camera_to_world", "c2w", "pose"]),
    ("cameras", &["views", "viewpoints", "camera_list"]),
    ("animation", &["anim", "animate", "timeline", "film", "motion"]),
    ("frames", &["frame_count", "num_frames", "frame_end", "final_frame", "count", "length", "end"]),
    ("fps", &["frame_rate", "framerate", "frames_per_second", "rate"]),
    ("frame", &["frame_current", "current_frame", "frame_number"]),
    ("center", &["centre", "position", "pos", "origin", "location", "loc"]),
    ("point", &["center", "centre", "position", "pos", "origin", "location", "through"]),
    ("radius", &["r", "size", "base_radius", "bottom_radius", "radius1", "outer_radius", "outer"]),
    ("fov", &["field_of_view", "angle", "vfov"]),
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
    ("width", &["w", "x", "thickness", "line_width"]),
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
    ("points", &["vertices", "positions", "verts", "corners", "outline", "profile"]),
    ("faces", &["indices", "triangles", "polygons"]),
    ("inner_radius", &["innerradius", "inner", "hole"]),
    ("distance", &["max_distance", "maxdistance", "radius", "range", "ao_distance"]),
    ("tip_radius", &["radius2", "top_radius", "tipradius", "end_radius", "radius_top", "cap_radius"]),
    ("camera_visible", &["visible_camera", "visible_to_camera", "primary_visibility", "primaryvisibility"]),
    ("camera_visible", &["camera_visibility", "seen_by_camera", "visible_in_camera", "visible_in_primary_ray"]),
    ("caps", &["cap", "closed", "capped", "end_caps"]),
    ("from", &["p0", "start", "base_point", "bottom", "base", "tail", "begin", "start_point"]),
    ("to", &["p1", "end", "cap", "apex", "tip", "top", "head", "cap_point", "end_point", "apex_point", "tip_point"]),
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
    ("a", &["color1", "colour1", "color_1", "color_a", "colour_a", "colora", "col1", "c1", "dark", "low", "even"]),
    ("b", &["color2", "colour2", "color_2", "color_b", "colour_b", "colorb", "col2", "c2", "light", "high", "odd"]),
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
    ("group", &["lightgroup", "light_group", "light_layer", "aov_group"]),
    ("marks", &["labels", "points", "anchors", "annotations"]),
];

/// The two radii of a torus are told apart by small and large letters alone.
const OF_TORUS: &[(&str, &[&str])] = &[
    ("radius", &["R", "major", "major_radius", "ring_radius", "radius_major", "main_radius"]),
    ("tube_radius", &["r", "minor", "minor_radius", "tube", "radius_minor", "section_radius", "thickness_radius"]),
];

/// What other programs call a field of ours by this name, the most likely first.
pub(super) fn synonyms(name: &str, def: &'static StructDef) -> Vec<&'static str> {
    let torus = def.name == "Torus";
    let of_torus = OF_TORUS.iter().filter(|(_, others)| torus && others.contains(&name));
    let lower = name.to_ascii_lowercase();
    let ambiguous = torus && matches!(&*lower, "r" | "outer" | "outer_radius" | "inner" | "inner_radius");
    let all = SYNONYMS
        .iter()
        .filter(|(field, others)| !ambiguous && def.field(field).is_some() && others.contains(&lower.as_str()));
    of_torus.chain(all).map(|(field, _)| *field).collect()
}
