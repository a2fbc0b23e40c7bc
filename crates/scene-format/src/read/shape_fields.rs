//! Fields that shapes have in other programs, and how they are said here.

use super::elsewhere::Fields;
use crate::schema::StructDef;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// One ring where an extrude has a list of them, under another name: what to write for name and value.
pub(super) fn one_ring(name: &str, value: Item<'_, '_>, def: &'static StructDef) -> Option<String> {
    let names = ["points", "profile", "shape", "path", "polygon", "contour", "vertices", "ring", "base"];
    if def.name != "Extrude" || !names.contains(&name) || value.kind() != Kind::List {
        return None;
    }
    is_ring(value).then(|| format!("{}[{}]", Fields(value.syntax()).name("outline"), value.lexeme()))
}

/// Whether a list is one ring of points, and not several rings.
pub(super) fn is_ring(value: Item<'_, '_>) -> bool {
    let number = |item: Item<'_, '_>| matches!(item.kind(), Kind::Integer | Kind::Float);
    let of_numbers = |first: Item<'_, '_>| {
        matches!(first.kind(), Kind::Tuple | Kind::List) && first.children().next().is_some_and(number)
    };
    value.kind() == Kind::List && value.children().next().is_some_and(of_numbers)
}

/// What round edges are called.
const ROUND: [&str; 12] = [
    "bevel",
    "bevels",
    "chamfer",
    "fillet",
    "rounded",
    "round",
    "roundness",
    "rounding",
    "bevel_depth",
    "bevel_radius",
    "corner_radius",
    "edge_radius",
];

/// What is said of fields that shapes do not have.
// Long: a table.
pub(super) fn of_shape(name: &str, def: &'static StructDef, syntax: Syntax) -> Option<&'static str> {
    let (Some(_), Some(_)) = (def.field("material"), def.field("transform")) else { return None };
    let ron = syntax == Syntax::Ron;
    let ends = def.field("from").is_some() && def.field("to").is_some();
    let side = matches!(name, "height" | "width" | "depth" | "length" | "thickness");
    Some(match (name, def.name) {
        (name, "Box") if ROUND.contains(&name) => "the radius of its edges and corners is its `rounding`",
        (name, "Cylinder" | "Cone") if ROUND.contains(&name) && ron => {
            "its section is the profile of a `Lathe`, here with edges cut by 0.1: Lathe(profile: [(0, 0), (0.9, 0), \
             (1, 0.1), (1, 1.9), (0.9, 2), (0, 2)])"
        }
        (name, "Cylinder" | "Cone") if ROUND.contains(&name) => {
            "its section is the `profile` of a `Lathe`, from below to above, with the edge cut off"
        }
        (name, _) if ROUND.contains(&name) => {
            "only a `Box` has round ones: make a mesh of it elsewhere, and name its file in a `Mesh`"
        }
        ("holes" | "hole" | "inner" | "cutouts" | "windows", "Extrude") => {
            "holes are rings of the `outline`, after the outer one: [[outer points ..], [points of a hole ..]]"
        }
        ("holes" | "hole" | "inner" | "cutouts" | "windows", "Polygon") if ron => {
            "polygons have no holes yet: a thin plate with holes is Extrude(outline: [[..], [..]], depth: 0.01)"
        }
        ("holes" | "hole" | "inner" | "cutouts" | "windows", "Polygon") => {
            "polygons have no holes yet: a thin plate with holes is an `Extrude` of small `depth`, whose `outline` has \
             a ring for each"
        }
        (
            "spline" | "interpolation" | "smooth" | "bezier" | "type" | "kind" | "linear_spline" | "cubic_spline",
            "Tube",
        ) => {
            "how points are joined is its `curve`: Linear by straight lines, CatmullRom by a smooth curve through all \
             of them, Bezier by curves with handles"
        }
        ("handles" | "control_points" | "controlpoints" | "handle_left" | "handle_right" | "tangents", "Tube") => {
            "handles stand among the `points` with `curve: Bezier`: a point, two handles, the next point, and so on"
        }
        ("spline" | "interpolation" | "smooth" | "bezier" | "type" | "kind" | "linear_spline" | "cubic_spline", _)
            if def.field("curve").is_some() =>
        {
            "how points are joined is its `curve`: Linear by straight lines, CatmullRom by a smooth curve through all \
             of them"
        }
        (
            "height" | "max_height" | "scale" | "strength" | "displacement" | "height_scale" | "z_scale",
            "HeightField",
        ) => "how high white is is the second number of its `size`: (along x, high, along z)",
        ("width" | "depth" | "length" | "dimensions" | "extent", "HeightField") => {
            "how far it reaches is said by its `size`: (along x, high, along z)"
        }
        (
            "clip" | "clip_plane" | "clipping" | "clipping_planes" | "clip_planes" | "clipped_by" | "bounded_by"
            | "cut",
            _,
        )
        | ("zmin" | "zmax" | "z_min" | "z_max", "Sphere" | "Cylinder" | "Cone") => match def.name {
            "Sphere" | "Box" | "Cylinder" | "Cone" | "Capsule" | "Torus" if ron => {
                "what is cut off stands in a Difference, here all above y = 0: Difference(objects: [Sphere(radius: 1), \
                 Box(center: (0, 5, 0), size: 10)])"
            }
            "Sphere" | "Box" | "Cylinder" | "Cone" | "Capsule" | "Torus" => {
                "what is cut off stands in a `Difference`, behind the body itself"
            }
            "Union" | "Intersection" | "Difference" => "what is cut off is one of the `objects` of a `Difference`",
            _ if ron => {
                "it cannot be cut: `camera: Camera(near: 4)` leaves out what is nearer to the camera; only Boxes, \
                 Spheres, Cylinders, Cones, Capsules and Tori may stand in a Difference"
            }
            _ => {
                "it cannot be cut: the camera's `near` leaves out what is nearer to it; only Boxes, Spheres, \
                 Cylinders, Cones, Capsules and Tori may stand in a `Difference`"
            }
        },
        ("water_level" | "sea_level" | "water", "HeightField") => {
            "nothing is cut off: lay a `Rectangle` at its height through it"
        }
        ("subdivisions" | "segments" | "resolution" | "nu" | "nv" | "pz", "HeightField") => {
            "how fine it is is said by its picture's pixels: leave it out"
        }
        (
            "segments" | "sides" | "steps" | "resolution" | "slices" | "subdivisions" | "facets" | "major_segments"
            | "minor_segments",
            "Sphere" | "Cylinder" | "Cone" | "Capsule" | "Disk" | "Torus",
        ) => "it is round, and not made of pieces: leave it out",
        ("from" | "to" | "start" | "end" | "begin" | "p1" | "p2", "Tube") if ron => {
            "a tube goes along its `points`: [(0, 0, 0), (1, 1, 0)]; one that is straight is a `Cylinder` or `Capsule`"
        }
        ("from" | "to" | "start" | "end" | "begin" | "p1" | "p2", "Tube") => {
            "a tube goes along its `points`, two or more; one that is straight is a `Cylinder` or `Capsule`"
        }
        ("origin" | "direction" | "dir" | "position" | "start" | "end" | "tip" | "vector", "Arrow") => {
            "an arrow goes from the point `from` to the point `to`"
        }
        ("inner_radius" | "thickness" | "wall" | "wall_thickness" | "inner" | "hole", "Cylinder") => {
            "a pipe with a wall is a `Difference` of two cylinders, or a `Lathe` whose profile is the wall's section"
        }
        ("thickness", "Torus") => "how thick its ring is says the `tube_radius`, which is half of that",
        ("twist" | "taper" | "scale_top", "Extrude") => {
            "the outline is the same all along: a `Mesh` takes other shapes"
        }
        ("axis" | "direction" | "up" | "normal", "Lathe") => {
            "it turns about the y axis; another one by `transform: [Align(to: (0, 0, 1))]`"
        }
        ("thickness" | "wall" | "wall_thickness" | "solidify", "Lathe") => {
            "its wall is as thick as its section: a `profile` that goes up outside, and down again inside"
        }
        ("axis" | "direction" | "dir" | "normal" | "up", "Extrude") => {
            "its outline lies in x and y, and it goes along z; another way by `transform: [Align(from: (0, 0, 1), to: \
             (0, 1, 0))]`"
        }
        ("up" | "tangent" | "right", "Rectangle" | "Disk") => {
            "which way it faces is its `normal`; within its plane it turns by `transform: [Rotate(axis: (0, 0, 1), \
             degrees: 30)]`, about that axis"
        }
        ("height" | "radius" | "width", "Lathe") => {
            "its size is that of its `profile`, whose points are (distance from the axis, height)"
        }
        ("angle" | "sweep" | "phi_max" | "start_angle" | "degrees", "Lathe") => {
            "it always goes all the way round: leave it out"
        }
        ("open" | "open_ended" | "openended" | "hollow", _) if def.field("caps").is_some() => {
            "without its flat ends it has `caps: false`"
        }
        ("height" | "length" | "h", _) if ends && ron => {
            "how long it is is said by its ends: `from: (0, 0, 0), to: (0, 2, 0)`"
        }
        ("height" | "length" | "h", _) if ends => "how long it is is said by its ends, `from` and `to`",
        ("radius" | "r" | "half_extents" | "half_size" | "halfsize" | "edge" | "side" | "length", "Box") => {
            "its sides along x, y and z are its `size`, from face to face; round edges have a radius, its `rounding`"
        }
        ("u" | "v" | "edge1" | "edge2", "Rectangle") => {
            "its sides are the two numbers of its `size`, which way it faces its `normal`; by its corners it is a \
             `Polygon`"
        }
        ("corners" | "points" | "vertices", "Rectangle") if ron => {
            "by its corners it is Polygon(points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])"
        }
        ("corners" | "points" | "vertices", "Rectangle") => "by its corners it is a `Polygon`, whose `points` they are",
        ("radius" | "r", "Rectangle" | "Polygon") => "what has a radius is a `Disk`, or a `Sphere`",
        (_, "Box") if side => "its sides along x, y and z are its `size`",
        (_, "Rectangle") if side => "its sides are its `size`: two numbers, or one for both",
        _ => return None,
    })
}
