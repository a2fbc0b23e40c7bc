//! Kinds of other programs that are something else here: a material among the objects, a sky among the lights.

use super::hints::{Hints, kind_elsewhere};
use super::of_fields::SHADOW_CATCHER;
use super::synonyms::squeezed;
use crate::desc::{Material, Object, PatternWords, is_texture};
use crate::schema::EnumDef;

/// What is said of writing, which may be meant over the picture or in the scene.
pub(super) const LETTERS: &str = "letters over the picture are laid on afterwards: `tracer marks` makes labels of an \
                                  .svg, or coordinates for TikZ (.tex), of `output: Output(marks: { \"A\": (0, 1, \
                                  0) })`; letters in the scene are a Mesh of another program, an Extrude of their \
                                  outlines, or a picture of them, Texture(file: \"a.png\") on a Rectangle";

/// Objects of other programs.
pub(super) const OBJECTS: Hints = &[
    (
        &["prism", "wedge", "triangularprism"],
        "what has the same outline all along is an `Extrude`: Extrude(outline: [[(0, 0), (1, 0), (0.5, 0.87)]], depth: \
         2)",
    ),
    (
        &["tetrahedron"],
        "its corners and faces stand in the scene: Mesh(points: [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], \
         faces: [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])",
    ),
    (
        &["octahedron"],
        "its corners and faces stand in the scene: Mesh(points: [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, \
         1), (0, 0, -1)], faces: [[0, 2, 4], [0, 3, 5], [0, 4, 3], [0, 5, 2], [1, 2, 5], [1, 3, 4], [1, 4, 2], [1, 5, \
         3]])",
    ),
    (
        &["icosahedron", "dodecahedron", "platonicsolid", "platonic"],
        "its corners and faces stand in the scene: Mesh(points: [..], faces: [..]); all five regular solids are in \
         scenes/cookbook/platonic_solids.ron",
    ),
    (
        &["pyramid", "polyhedron", "loft"],
        "its corners and faces may stand in the scene: Mesh(points: [(0, 1, 0), (-1, 0, -1), (1, 0, -1), (1, 0, 1), \
         (-1, 0, 1)], faces: [[0, 4, 3], [0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 3, 4]]), or in a file, \
         OBJ, OFF, PLY, STL, glTF or GLB: Mesh(file: \"a.obj\")",
    ),
    (
        &["translate", "rotate", "scale", "align", "fitto", "dropto", "centerto"],
        "transforms stand in an object: `transform: [Translate((0, 1, 0))]`; several objects are moved by \
         Group(objects: [..], transform: [Translate((0, 1, 0))])",
    ),
    (&["repeat"], "a repetition has a large letter: Repeat(count: 8, items: [..])"),
    (&["ellipsoid", "spheroid"], "an ellipsoid is a `Sphere` with `transform: [Scale((1, 2, 1))]`"),
    (
        &["bezier"],
        "a curve is a `Tube` with `curve: Bezier`; of patches make a mesh, in OBJ, OFF, PLY, STL, glTF or GLB, and \
         name its file in a `Mesh`",
    ),
    (&["text", "label", "caption", "annotation", "letters", "letter", "title", "font"], LETTERS),
    (
        &["nurbs", "teapot", "bunny", "dragon", "suzanne", "monkey"],
        "there is no such shape yet: make a mesh of it, in OBJ, OFF, PLY, STL, glTF or GLB, and name its file in a \
         `Mesh`",
    ),
    (
        &["instance", "instances", "objectinstance", "copy", "array", "clone", "for", "loop"],
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
        &["import", "link", "reference", "scene", "use"],
        "another scene comes by `Include(file: ..)`, geometry of other files by `Mesh(file: ..)`",
    ),
    (
        &["arealight", "area", "quadlight", "rectlight", "rectanglelight", "rectarealight", "meshlight", "lamp"],
        "a lamp is an object that shines: `Rectangle(size: 1, material: Emissive(radiance: 5))`",
    ),
    (&["spherelight", "pointlight", "light", "sun", "spotlight"], "lights stand in `lights`, beside `objects`"),
    (
        &["wall", "walls", "room"],
        "a wall is a Box(size: (4, 3, 0.1)), or a Rectangle(size: (4, 3), normal: (0, 0, 1)) without thickness; a Box \
         seen from inside is a room",
    ),
    (
        &["foreach", "map", "each"],
        "for each item of a list: vars: { \"list\": [1, 3, 5] } and Repeat(count: \"=len(list)\", items: [..]), where \
         \"=list[i]\" is the item",
    ),
    (
        &["star", "gear", "cog", "cogwheel", "sprocket"],
        "its outline is a rule: Extrude(outline: [[Repeat(count: 10, items: [\"=if(i % 2 == 0, 1, 0.4)*(cos(36*i), \
         sin(36*i))\"])]], depth: 0.2)",
    ),
    (
        &["heart", "moon", "crescent", "leaf", "cross", "arch", "logo"],
        "an outline of points has a depth, and may be curved: Extrude(outline: [[(0, -1), (1, 0.2), (0.5, 0.8), (0, \
         0.4), (-0.5, 0.8), (-1, 0.2)]], depth: 0.2, curve: CatmullRom)",
    ),
    (&["bevel", "roundedbox", "roundbox", "chamfer"], "edges are rounded by `Box(size: 1, rounding: 0.1)`"),
    (&["empty", "null"], "what only holds others is a `Group(objects: [..])`; a point needs no object"),
    (&["shadowcatcher", "shadowmatte"], SHADOW_CATCHER),
    (
        &["dimension", "dimensionline", "measure", "measurement", "scalebar", "ruler"],
        "a dimension line is two Arrows that meet in its middle: Arrow(from: (0.5, 0, 0), to: (0, 0, 0), radius: \
         0.01), Arrow(from: (0.5, 0, 0), to: (1, 0, 0), radius: 0.01); its number is laid over the picture, where \
         `output: Output(marks: { \"L\": (0.5, 0, 0) })` and `tracer marks` tell",
    ),
    (
        &["cloth", "fabric", "drape", "curtain", "flag", "softbody"],
        "nothing falls or bends here: cloth is a mesh that another program has draped, Mesh(file: \"cloth.obj\"); its \
         material is Diffuse(..)",
    ),
    (&["line", "lines", "segment", "polyline"], "a line has a thickness: `Tube(points: [..], radius: 0.02)`"),
    (&["point"], "a point is a small `Sphere`; a light without size is a small `SphereLight`"),
    (&["camera"], "the camera is the scene's `camera`, beside `objects`"),
    (
        &["if", "when", "switch", "choose", "random", "select"],
        "what is there at times only: Repeat(count: \"=if(frame < 10, 1, 0)\", items: [..]); one of several: \
         Pick(from: [..], index: 1)",
    ),
    (&["volume", "fog", "medium", "smoke", "hair"], "there is no such thing: surfaces only"),
];

/// Materials of other programs.
pub(super) const MATERIALS: Hints = &[
    (
        &["fresnel", "fresnelmix", "layerweight"],
        "glass, metal and gloss reflect more at grazing angles by themselves: BlinnPhong(albedo: 0.5, exponent: 1000, \
         specular: 0.1, energy_conserving: true), say",
    ),
    (&["random", "noise"], "a pattern is the colour of a material: Diffuse(albedo: Noise())"),
    (&["water", "liquid", "wine", "sea"], "water is Transparent(ior: 1.33)"),
    (&["diamond", "gem", "crystal"], "a diamond is Transparent(ior: 2.42)"),
    (&["ice"], "ice is Transparent(ior: 1.31)"),
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
            "clearcoat",
            "carpaint",
            "metallicpaint",
            "meshstandardmaterial",
            "meshphysicalmaterial",
        ],
        "a coloured surface with a gloss is BlinnPhong(albedo: .., exponent: 1000, specular: 0.1, energy_conserving: \
         true)",
    ),
    (&["frostedglass", "frosted", "roughglass", "roughdielectric"], "glass is smooth here: Transparent(ior: 1.5)"),
    (
        &["mix", "blend", "blendbsdf", "layered", "mixshader", "mix_shader"],
        "materials cannot be mixed, but colours can: Diffuse(albedo: Mix(a: .., b: ..)); `BlinnPhong` mixes a matt and \
         a glossy share",
    ),
    (
        &["toon", "cel", "celshading", "wireframe", "wire", "outline", "sketch", "cartoon"],
        "materials are surfaces, drawing styles are not: the layers `object_id`, `normal` and `depth` of an EXR tell \
         another program where edges are",
    ),
    (&["shadowcatcher", "shadowmatte", "shadowmaterial"], SHADOW_CATCHER),
    (
        &["unlit", "shadeless", "fullbright", "meshbasicmaterial", "flatcolor", "constant"],
        "what looks the same in any light shines by itself, and lights others: Emissive(radiance: 1, color: (0.8, 0.2, \
         0.1)), as bright as that colour",
    ),
    (&["pigment", "color", "rgb"], "a colour is the `albedo` of a material: Diffuse(albedo: (0.8, 0.2, 0.1))"),
    (&["null", "none", "invisible"], "leave the object out"),
    (
        &[
            "gold",
            "silver",
            "copper",
            "aluminum",
            "aluminium",
            "iron",
            "chromium",
            "chrome",
            "nickel",
            "titanium",
            "brass",
            "platinum",
            "steel",
            "bronze",
            "tin",
        ],
        "a metal is Conductor(metal: Gold), Silver, Copper, Aluminum, Iron, Chromium, Nickel, Titanium, Brass, \
         Platinum or Steel",
    ),
    (&["thindielectric", "thintransparent"], "a pane is a thin `Box` of Transparent(ior: 1.5)"),
    (&["normalmap", "bumpmap", "bump", "displacement"], "surfaces have no bumps: they need to be in the mesh"),
];

/// Lights of other programs.
pub(super) const LIGHTS: Hints = &[
    (
        &["directional", "distant", "sun", "directionallight", "distantlight", "sunlight", "parallel", "parallellight"],
        "a sun is a sphere light far away: SphereLight(center: (60, 80, 40), radius: 0.5, radiance: 45000) is as wide \
         as ours, and gives 3 W/m^2",
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
            "rect",
            "arealight",
            "area",
            "disklight",
            "quad",
            "emission",
            "emissive",
            "emitter",
        ],
        "a flat lamp is an object that shines: `Rectangle(material: Emissive(radiance: 5))` in `objects`",
    ),
    (&["meshlight"], "a mesh that shines is a `Mesh` with `material: Emissive(radiance: 5)`, in `objects`"),
    (&["pointlight", "point", "omni"], "a point light is a small sphere: radius: 0.1, intensity: .. in W/sr"),
    (
        &["spotlight", "spot", "ies", "goniometric", "goniometriclight", "projector", "projectionlight"],
        "there is no spotlight: put a `SphereLight` into a tube or box of objects, open to one side",
    ),
];

/// Transforms of other programs.
pub(super) const TRANSFORMS: Hints = &[
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
        &["center", "centre", "recenter", "recentre", "centered", "geometrytoorigin", "origintogeometry"],
        "the middle of its bounds comes to the origin by CenterTo((0, 0, 0))",
    ),
    (
        &["lookat", "look_at", "track", "trackto", "track_to"],
        "Align(from: (0, 0, 1), to: (1, 0, 0)) turns one direction to another; the camera alone has `look_at`",
    ),
    (
        &["rotatex", "rotatey", "rotatez", "rotx", "roty", "rotz"],
        "a turn about x is Rotate(axis: (1, 0, 0), degrees: 30), about y (0, 1, 0), about z (0, 0, 1)",
    ),
    (&["shear", "skew"], "a `Matrix` may shear: Matrix(rows: ((1, 0.5, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)))"),
    (&["mirror", "reflect", "flip"], "a negative factor mirrors: Scale((-1, 1, 1))"),
    (
        &["quaternion", "euler", "euler_xyz"],
        "turn about one axis after the other: Rotate(axis: (0, 1, 0), degrees: 90)",
    ),
];

const AMONG_OBJECTS: Hints = &[
    (
        &["lens", "biconvex", "convexlens", "sphericallens"],
        "a lens is what two balls have in common: Intersection(objects: [Sphere(center: (0, 0, -4), radius: 4.1), \
         Sphere(center: (0, 0, 4), radius: 4.1)], material: Transparent(ior: 1.5)); a hollow one a Difference",
    ),
    (
        &[
            "paraboloid",
            "paraboloidmirror",
            "parabola",
            "parabolic",
            "parabolicmirror",
            "parabolicreflector",
            "reflector",
            "hyperboloid",
            "bowl",
            "dish",
        ],
        "what is round about an axis is a `Lathe`: its `profile` are points on the curve, (distance from the axis, \
         height)",
    ),
    (
        &[
            "function",
            "functionsurface",
            "graph",
            "plot",
            "surfaceplot",
            "parametric",
            "parametricsurface",
            "surface",
            "plotsurface",
            "surf",
            "functionplot",
            "plot3d",
            "graph3d",
        ],
        super::figures::HEIGHTS_ARE,
    ),
    (
        &["helix", "spring", "spiral", "coil", "screw", "thread", "screwthread", "helicoid"],
        "a coil is a Tube through points that a Repeat makes: Tube(points: [Repeat(count: 60, items: [(\"=cos(30*i)\", \
         \"=0.05*i\", \"=sin(30*i)\")])], radius: 0.05)",
    ),
    (
        &["hemisphere", "halfsphere", "dome"],
        "half a ball is what a plane leaves of it: Intersection(objects: [Sphere(center: (0, 0, 0), radius: 1), \
         Plane(normal: (0, -1, 0))])",
    ),
    (
        &["pointcloud", "points", "particles"],
        "many alike are one object with `placements`: a list, Grid(..), Ring(..), Scatter(..) or a file of positions",
    ),
    (&["compound", "compositeshape", "assembly", "collection"], "what belongs together is a `Group(objects: [..])`"),
    (
        &["emitter", "emission", "lightsource", "glow", "lamplight"],
        "a lamp is an object that shines: `Rectangle(size: 1, material: Emissive(radiance: 5))`",
    ),
    (
        &["envmap", "environment", "environmentmap", "hdri", "sky", "sunsky", "skysphere", "skydome", "world", "ibl"],
        "light from all around is the scene's `background`: a colour, or `Environment(file: \"sky.hdr\")`",
    ),
    (&["perspective", "thinlens", "sensor", "pinhole"], "the camera is the scene's `camera`, beside `objects`"),
    (
        &[
            "julia",
            "fractal",
            "blob",
            "metaball",
            "metaballs",
            "sdf",
            "superellipsoid",
            "isosurface",
            "quadric",
            "loopsubdiv",
        ],
        "make a mesh of it: name an OBJ, OFF, PLY, STL, glTF or GLB file in a `Mesh`",
    ),
];

const AMONG_LIGHTS: Hints = &[(
    &["hemispherelight", "hemisphere", "uniform", "constantlight", "imagelight", "textureenvironment"],
    "light from all around is the scene's `background`: a colour, or `Environment(file: \"sky.hdr\")`",
)];

const AMONG_MATERIALS: Hints = &[
    (
        &["diffusetransmission", "difftransmitter", "translucentbsdf"],
        "there is no such material; the nearest are `Diffuse` and, for what lets light through, `Transparent(ior: \
         1.5)`",
    ),
    (
        &["mask", "interface", "holdout", "transparentbsdf", "alphamask"],
        "leave the object out, or what is not seen of it",
    ),
    (
        &[
            "substrate",
            "coatedconductor",
            "principledbsdf",
            "openpbr",
            "openpbrsurface",
            "standardsurface",
            "metalmatte",
        ],
        "a coloured surface with a gloss is BlinnPhong(albedo: .., exponent: 1000, specular: 0.1, energy_conserving: \
         true)",
    ),
    (&["measured", "merl", "rgl"], "there are no measured materials; the nearest are `Conductor` and `BlinnPhong`"),
    (&["twosided", "doublesided"], "all surfaces have two sides: write the material within it alone"),
    (
        &["texture", "checkerboard", "checker", "imagemap", "color", "colour", "rgb"],
        "a colour or a texture belongs to \
     a material: Diffuse(albedo: ..)",
    ),
];

const TONE_MAPS: Hints = &[
    (
        &["aces", "acesfilmic", "acesfilmictonemapping", "hable", "uncharted", "uncharted2", "film", "reinhard"],
        "a curve of that kind is `Filmic`; `AgX` lets bright colours go to white",
    ),
    (&["linear", "standard", "srgb", "raw", "clamp", "gamma", "off"], "without a curve it is `None`: clipped, in sRGB"),
];

const BACKGROUNDS: Hints = &[
    (
        &["none", "null", "nil", "transparent", "off", "alpha", "clear", "nothing", "empty"],
        "leave `background` out: then it is black; what is to be laid over other pictures has `output: Output(alpha: \
         true)`",
    ),
    (
        &[
            "sky",
            "sunsky",
            "sun",
            "skytexture",
            "nishita",
            "hosekwilkie",
            "hosek",
            "hoseksky",
            "skymodel",
            "preetham",
            "gradient",
            "skysphere",
            "physicalsky",
        ],
        "a sky is one colour, (0.5, 0.7, 1), a picture, Environment(file: \"sky.hdr\"), or a large sphere that shines: \
         Sphere(center: (0, 0, 0), radius: 300, material: Emissive(radiance: 1, two_sided: true, color: \
         ColorRamp(input: Gradient(), stops: [(at: 0.5, color: (1, 0.8, 0.6)), (at: 0.6, color: (0.3, 0.5, 1))]))), \
         where 0.5 is the horizon",
    ),
    (
        &["color", "colour", "constant", "rgb", "solid", "uniform", "ambient", "vec3", "srgb"],
        "a colour stands alone, as the value of `background` itself",
    ),
    (
        &[
            "hdri",
            "envmap",
            "environmentmap",
            "environmentlight",
            "infinite",
            "infinitelight",
            "ibl",
            "skybox",
            "skydome",
            "image",
            "texture",
            "latlong",
            "equirectangular",
            "domelight",
            "dome",
            "world",
            "bitmap",
        ],
        "a picture of all directions is Environment(file: \"sky.hdr\")",
    ),
];

const PROJECTIONS: Hints = &[(
    &["thinlens", "lens", "dof", "depthoffield", "realistic"],
    "blur by depth is an effect: `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`",
)];

const LENSES: Hints = &[(
    &["thinlens", "lens", "dof", "depthoffield", "bokeh", "thin", "camera", "physical", "realistic"],
    "its aperture is the diameter of the lens in the scene's unit, the focal length over the f-number: of 50 mm at \
     f/2.8 it is 0.018 m",
)];

const STEREO: Hints = &[
    (
        &["sidebyside", "sbs", "leftright", "horizontal", "parallel", "stereoscopic", "true", "on"],
        "two pictures side by side are `Stereo(separation: 0.064)`",
    ),
    (
        &["topbottom", "overunder", "vertical", "tab", "above"],
        "two pictures above each other are `Stereo(separation: 0.064, layout: TopBottom)`",
    ),
];

/// What is said of a word that is no kind of this one.
pub(super) fn elsewhere(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    let plain = squeezed(name);
    let rows = match def.noun {
        "object" => AMONG_OBJECTS,
        "light" => AMONG_LIGHTS,
        "material" => AMONG_MATERIALS,
        "background" => BACKGROUNDS,
        "tone map" => TONE_MAPS,
        "stereo" => STEREO,
        "projection" => PROJECTIONS,
        "lens" => LENSES,
        _ => return None,
    };
    let found = rows.iter().find(|(names, _)| names.contains(&&*plain)).map(|(_, way)| *way);
    found.or_else(|| of_another_list(name, def))
}

/// What is said of a material or a shape in the wrong place.
pub(super) fn of_another_list(name: &str, def: &'static EnumDef) -> Option<&'static str> {
    let is_of = |other: &'static EnumDef| {
        other.variants.iter().any(|variant| variant.name.eq_ignore_ascii_case(name))
            || kind_elsewhere(name, other).is_some()
    };
    let texture = || is_texture(name) || kind_elsewhere(name, &PatternWords::DEF).is_some();
    match def.noun {
        // Of lights themselves.
        "light" if kind_elsewhere(name, def).is_some() => None,
        "object" if texture() && kind_elsewhere(name, def).is_none() => {
            Some("that is a texture, which a material has: Plane(material: Diffuse(albedo: Checkerboard()))")
        }
        "object" if is_of(&Material::DEF) => {
            Some("that is a material, which an object has: `Sphere(center: .., radius: .., material: ..)`")
        }
        "light" if is_of(&Object::DEF) => {
            Some("shapes stand in `objects`; one that shines has `material: Emissive(radiance: 5)`")
        }
        "light" if is_of(&Material::DEF) => {
            Some("that is a material, which an object has; what shines is Emissive(..)")
        }
        "material" if is_of(&Object::DEF) => Some("that is a shape; it stands in `objects`, and has a material"),
        _ => None,
    }
}
