//! Words of every day and of other programs, for those who ask by themselves what there is.

use super::hints::{field_of_others, kind_elsewhere, other_kind};
use super::of_fields::SHADOW_CATCHER;
use super::of_kinds::{LETTERS, of_another_list};
use super::synonyms::called_elsewhere;
use crate::desc::{Camera, Effects, Layer, Light, Material, Object, Scene, Sphere, Transform};
use crate::schema::{EnumDef, StructDef, Type};
use crate::syntax::Syntax;
use crate::words::Words;

/// Words that stand in no hint by themselves, or mean something else there.
const WORDS: &[(&[&str], &str)] = &[
    (
        &["stairs", "stair", "staircase", "ladder", "fence", "books", "row"],
        "what is there many times by a rule is made by Repeat: Repeat(count: 8, items: [Box(center: (\"=0.3*i\", \
         \"=0.2*i\", 0), size: (0.3, 0.2, 1))])",
    ),
    (
        &["vase", "bottle", "cup", "mug", "glass bottle", "candlestick", "chess piece", "pawn", "bell", "plate"],
        "what is round about an axis is a Lathe: its `profile` are points (distance from the axis, height), as in \
         Lathe(profile: [(0, 0), (0.4, 0), (0.5, 0.4), (0.2, 0.8), (0.3, 1)], curve: CatmullRom)",
    ),
    (
        &["leather", "rubber", "fabric", "cloth", "stone", "concrete", "clay", "plaster", "paper", "skin"],
        "what is matt is Diffuse, leather and rubber with a dull gloss BlinnPhong(albedo: (0.2, 0.1, 0.06), exponent: \
         20, specular: 0.05, energy_conserving: true); grain is a picture or a pattern, Noise(), as its `albedo`",
    ),
    (
        &[
            "planks",
            "plank",
            "boards",
            "floorboards",
            "parquet",
            "wood floor",
            "wooden floor",
            "table top",
            "grain of wood",
        ],
        "a floor or a table top shows stripes where the grain lies in it: Diffuse(albedo: Wood(a: (0.5, 0.28, 0.13), \
         b: (0.25, 0.11, 0.05), axis: (1, 0, 0), mapping: Object(scale: (1, 8, 8))))",
    ),
    (
        &["data", "chart", "bars", "bar chart", "histogram", "scatter plot", "plot", "table of numbers"],
        "numbers stand in `vars`, and a Repeat draws them: vars: { \"data\": [3, 1, 4] } and Repeat(count: \
         \"=len(data)\", items: [Box(center: (\"=i\", \"=data[i]/2\", 0), size: (0.8, \"=data[i]\", 0.8))])",
    ),
    (
        &["contour", "contour line", "isoline", "isolines", "level line", "level curve", "contour plot", "topographic"],
        "contour lines are Lines seen from the side, here every 0.1 of height: material: Diffuse(albedo: Lines(along: \
         U, width: 0.1, a: 0.05, b: 0.7, mapping: Planar(normal: (0, 0, 1), size: (1, 0.1))))",
    ),
    (
        &["viridis", "plasma", "magma", "inferno", "colormap", "cmap", "color map", "colour map", "colourmap"],
        "colours by a number are a ramp: ColorRamp(input: Gradient(), stops: [(at: 0, color: \"#440154\"), (at: 0.25, \
         color: \"#3b528b\"), (at: 0.5, color: \"#21918c\"), (at: 0.75, color: \"#5ec962\"), (at: 1, color: \
         \"#fde725\")]) is viridis along v, from 0 to 1; at points of a Mesh they are its `colors`",
    ),
    (
        &["colorbar", "color bar", "colour bar", "legend"],
        "a bar of colours is a Rectangle with the ramp: Rectangle(size: (0.2, 2), material: Diffuse(albedo: \
         ColorRamp(input: Gradient(), stops: [(at: 0, color: \"#440154\"), (at: 1, color: \"#fde725\")]))); its \
         numbers are laid over the picture, where `output: Output(marks: {..})` and `tracer marks` tell",
    ),
    (
        &["axes", "coordinate axes", "coordinate system", "gizmo", "triad", "axes3d"],
        "axes are Arrows: Arrow(to: (1, 0, 0), radius: 0.02, material: Diffuse(albedo: \"#d03a2b\")), Arrow(to: (0, 1, \
         0), radius: 0.02, material: Diffuse(albedo: \"#3aa655\")), Arrow(to: (0, 0, 1), radius: 0.02, material: \
         Diffuse(albedo: \"#2b5fd0\"))",
    ),
    (
        &["atom", "molecule", "bond", "ball and stick", "ball-and-stick", "protein", "chemistry", "unit cell"],
        "atoms are Spheres, bonds Cylinders; from lists in `vars` a Repeat makes them: vars: { \"atoms\": [(0, 0, 0), \
         (1, 0, 0), (1.5, 0.8, 0)], \"bonds\": [(0, 1), (1, 2)] } and Repeat(count: \"=len(atoms)\", items: \
         [Sphere(center: \"=atoms[i]\", radius: 0.3)]), Repeat(count: \"=len(bonds)\", items: [Cylinder(from: \
         \"=atoms[bonds[i].x]\", to: \"=atoms[bonds[i].y]\", radius: 0.1)])",
    ),
    (
        &["streamline", "field line", "trajectory", "flow line"],
        "a line in space is a Tube through its points: Tube(points: [(0, 0, 0), (1, 0.5, 0), (2, 0, 0)], radius: 0.02, \
         curve: CatmullRom)",
    ),
    (
        &["fire", "flame", "candle", "explosion", "smoke", "clouds", "cloud", "dust"],
        "only surfaces are seen: a flame is a small shape that shines, Emissive(radiance: 20, color: \
         \"=blackbody(1900)\")",
    ),
    (
        &["svg", "logo", "vector graphics", "dxf", "outline of a picture"],
        "outlines come as points: Extrude(outline: [[(0, 0), (2, 0), (1, 1.5)]], depth: 0.2), a ring for each hole; \
         or another program makes a mesh of them, and Mesh(file: \"logo.obj\") names it",
    ),
    (
        &["planet", "earth", "globe", "moon"],
        "a planet is a Sphere with a picture of twice its height as breadth: Sphere(radius: 1, material: \
         Diffuse(albedo: Texture(file: \"earth.png\")))",
    ),
    (
        &["stars", "starry sky", "night", "space", "galaxy"],
        "stars are a picture of all directions, `background: Environment(file: \"stars.exr\")`, or many small \
         Spheres that shine, by Scatter",
    ),
    (
        &["sunset", "sunrise", "evening", "dusk", "dawn", "golden hour"],
        "low and warm light is a SphereLight(center: (90, 10, 30), radius: 0.5, radiance: 30000, color: \
         \"=blackbody(3000)\") before a `background` of (0.5, 0.3, 0.25)",
    ),
    (
        &["dice", "die"],
        "a die is Intersection(objects: [Box(size: 1), Sphere(radius: 0.7)]), with its pips cut by Difference; or a \
         Box(rounding: 0.1)",
    ),
    (
        &["section", "cutaway", "cut open", "cross section", "cross-section", "clip plane", "clipping"],
        "a body of Boxes, Spheres, Cylinders, Cones, Capsules and Tori is cut open by Difference(objects: [body, \
         Box(..)]), or by Intersection with a Plane; meshes, Lathes and Extrudes cannot be in one: they are cut by \
         `camera: Camera(near: 4)`, what is nearer to the camera is not seen",
    ),
    (
        &["hollow", "shell", "wall thickness"],
        "what is hollow is a Difference of two shapes, the inner one smaller; what is open at both ends has `caps: \
         false`",
    ),
    (
        &["variable", "variables", "constant", "constants", "parameter", "parameters"],
        "values with names stand in `vars`, and expressions use them: `vars: { \"r\": 2 }` and `radius: \"=2*r\"`; \
         `--set vars.r=3` gives another one",
    ),
    (
        &["list", "lists", "array", "arrays"],
        "a list stands in brackets, in `vars`, too: `vars: { \"sizes\": [1, 2, 4] }`, of which \"=sizes[0]\" is the \
         first and \"=len(sizes)\" the count; a Repeat makes an item for each",
    ),
    (
        &["scale bar", "scale_bar", "scalebar", "ruler", "dimension line"],
        "nothing is drawn over the picture: a scale bar is a thin Box of its length beside the body",
    ),
    (
        &["thumbnail", "thumbnails", "contact sheet", "small picture"],
        "a small picture is quickly made by `tracer render scene.ron --size 160x120 --samples 16 -o small.png`",
    ),
    (&["shadow catcher", "shadow_catcher", "shadowcatcher", "catch shadows"], SHADOW_CATCHER),
    (
        &["ray", "rays", "light ray", "light rays", "ray tracing"],
        "rays of light are not drawn: a ray in a figure is an Arrow or a thin Cylinder; how often light is turned is \
         `max_bounces`",
    ),
    (
        &["json", "toml", "ron", "yaml", "syntax", "convert", "converter"],
        "scenes are written in RON, TOML or JSON, as the file's name says: `tracer convert scene.ron -o scene.json`",
    ),
    (
        &["golden", "goldens", "regression", "reference image"],
        "`tracer golden run golden` compares pictures with those that were accepted: docs/golden.md",
    ),
    (
        &["python", "script", "notebook", "jupyter", "numpy"],
        "from Python, `import tracer`; a program may also write a scene as JSON, and `tracer render -` reads it",
    ),
    (
        &["ffmpeg", "mp4 of frames", "encode"],
        "frames become a film by another program: `tracer render scene.ron --frames 0-47 -o frame_####.png`, and \
         `ffmpeg -framerate 24 -i frame_%04d.png film.mp4`",
    ),
    (
        &["window", "windowpane", "pane", "door", "doorway", "opening"],
        "a hole is cut by Difference(objects: [wall, hole]); a pane is a thin Box of Transparent(ior: 1.5)",
    ),
    (
        &["blur", "blurry", "unsharp", "defocus"],
        "blur by depth is an effect: `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`; \
         what moves is blurred while the camera's `shutter` is open",
    ),
    (
        &["floor", "ground", "terrain", "landscape"],
        "a floor is a Plane without an end, or a Rectangle; hills are a HeightField",
    ),
    (
        &["sun", "sunlight", "daylight"],
        "a sun is a SphereLight far away, SphereLight(center: (60, 80, 40), radius: 0.5, radiance: 45000); light from \
         all around is the scene's `background`",
    ),
    (
        &["laser", "laserlight", "beam", "ray of light"],
        "a beam is what a slit lets through of a small SphereLight far away; it is seen on what it meets, for there is \
         no fog",
    ),
    (
        &["helix", "spiral", "spring", "coil", "spiral staircase", "around a pole"],
        "a spiral is made by Repeat(count: 20, items: [Group(objects: [..], transform: [Rotate(axis: (0, 1, 0), \
         degrees: \"=20*i\"), Translate((0, \"=0.2*i\", 0))])]), a coil by a Tube through points that a Repeat makes",
    ),
    (
        &["pivot", "origin", "orbit", "turn about"],
        "an object is turned about its own middle, a Group about the origin; about another point: Rotate(axis: (0, 1, \
         0), degrees: 30, about: (0, 0, 0))",
    ),
    (
        &["z up", "z-up", "zup", "up axis", "blender", "sideways", "lies on its side"],
        "y is up here; a mesh of a program that has z up is turned by `transform: [Rotate(axis: (1, 0, 0), degrees: \
         -90)]`, and its points (x, y, z) are (x, z, -y)",
    ),
    (
        &["csv", "spreadsheet", "data file"],
        "places, a line each, stand in a placements file, `placements: \"copies.txt\"`; other numbers a program writes \
         into a scene as JSON",
    ),
    (&["shadow", "shadows"], "what is lit throws shadows: a small light throws sharp ones, a large one soft ones"),
    (&["reflection", "reflective", "shiny"], "what reflects has the material Mirror, Conductor or BlinnPhong"),
    (&["color", "colour", "colors", "colours"], "colours are red, green and blue, (0.8, 0.2, 0.1), or \"#d03a2b\""),
    (&["wall", "room", "house"], "walls are Boxes or Rectangles; a Box seen from inside is a room"),
    (
        &["water", "wine", "liquid", "drink", "juice", "nested glass", "nested"],
        "water is Transparent(ior: 1.33), wine has a `transmittance`, too; in a glass it reaches a little into the \
         glass around it, as in scenes/cookbook/wine_glass.ron",
    ),
    (
        &["motion blur", "motionblur", "motion_blur"],
        "what moves is blurred while the camera's `shutter` is open, a share of a frame: `shutter: 0.5` with an \
         `animation`",
    ),
    (
        &["transparent background", "no background", "alpha channel", "cutout"],
        "a picture without its background has `output: Output(alpha: true)`, or `--set output.alpha=true`",
    ),
    (
        &["checkered floor", "chequered floor", "chessboard", "checkerboard floor", "tiles"],
        "a checkered floor is Plane(material: Diffuse(albedo: Checkerboard()))",
    ),
    (
        &["lampshade", "shade"],
        "a lampshade is an open Cylinder or Cone, or a Lathe, around a small lamp: scenes/cookbook/lampshade.ron",
    ),
    (
        &["dpi", "ppi", "print"],
        "pixels count: 6 by 4 inches at 300 dots per inch are `--size 1800x1200`; the file does not say how large it \
         is printed",
    ),
    (
        &["resume", "interrupt", "continue", "checkpoint"],
        "`tracer render scene.ron --checkpoint c.tracer` keeps what was rendered, and `--resume c.tracer` goes on",
    ),
    (
        &["tomato", "apple", "fruit", "egg"],
        "fruit is a Sphere, a little flattened by `transform: [Scale((1, 0.8, 1))]`, or a Lathe",
    ),
    (&["gamma", "srgb"], "pictures are sRGB; colours as \"#d03a2b\" are sRGB, too, and (r, g, b) are linear"),
    (
        &["frosted", "frosted glass", "translucent", "milk glass"],
        "there is no rough glass: the nearest are Transparent and Diffuse",
    ),
    (
        &["aspect", "pixel aspect", "non-square pixels", "fx", "fy"],
        "pixels are square: of a camera with fx and fy that differ, stretch the picture afterwards",
    ),
    (
        &["table", "chair", "furniture", "shelf", "desk", "bench", "stool", "cupboard"],
        "furniture is a Group of Boxes and Cylinders; legs are one of them with \
         `placements: Grid(count: (2, 1, 2), spacing: (1, 1, 0.6))`",
    ),
    (
        &["brightness", "bright", "dark", "black", "white", "contrast", "overexposed", "underexposed"],
        "how bright a picture is shown is `effects: Effects(exposure: 1)`, twice the light a stop; its contrast is \
         that of the `tone_map`",
    ),
    (
        &["png", "exr", "hdr", "pfm", "jpg", "jpeg", "tiff", "format", "export", "output_file"],
        "the name says the format: `tracer render scene.ron -o picture.png`, or .exr, .hdr, .pfm",
    ),
    (
        &["video", "movie", "gif", "mp4", "clip", "film", "motion"],
        "a film is rendered frame by frame: `animation: Animation(frames: 48)` in the scene, `frame` or `time` in its \
         expressions, and `tracer render scene.ron --frames 0-47 -o frame_####.png`",
    ),
    (
        &["turntable", "orbit", "carousel", "spin around", "fly around", "camera path"],
        "the camera goes round by `camera: Camera(position: \"=(6*sin(360*frame/48), 2, 6*cos(360*frame/48))\", \
         look_at: (0, 0, 0))`, with `animation: Animation(frames: 48)`: docs/animation.md",
    ),
    (
        &["wireframe", "outlines", "edges", "line art", "lineart", "freestyle", "stroke", "toon", "cel shading"],
        "there are no lines and no drawn shading; the layers `object_id`, `normal` and `depth` of an EXR tell another \
         program where edges are",
    ),
    (
        &["style", "theme", "shared settings", "preset", "template", "house style"],
        "what several scenes share stands in one file: `include: [\"style.ron\"]` takes its materials, cameras, \
         `vars`, image size and settings",
    ),
    (
        &["explode", "exploded view", "explosion drawing", "assembly"],
        "parts move apart by a name of `vars`: `vars: { \"apart\": 0.5 }`, and `transform: [Translate((0, \
         \"=2*apart\", 0))]` of each; `--set vars.apart=1` shows it",
    ),
    (
        &["hexagon", "pentagon", "regular polygon", "nut", "ngon", "n-gon", "octagon"],
        "a regular outline is a rule: Extrude(outline: [[Repeat(count: 6, items: [\"=(cos(60*i), sin(60*i))\"])]], \
         depth: 0.4); a second ring is a hole",
    ),
    (
        &["grass", "hair", "fur", "tree", "forest", "leaf", "leaves", "particle", "crowd", "pebbles", "stones"],
        "many of one thing are its `placements: Scatter(..)`, or a `Repeat`; what grows is a Mesh, a Cone or a Tube",
    ),
    (
        &["letters", "letter", "font", "word", "writing", "title", "labels", "text", "label", "caption", "annotation"],
        LETTERS,
    ),
    (
        &["rough", "gloss", "polished", "matte", "matt", "dull"],
        "matt is Diffuse; gloss is BlinnPhong, whose `exponent` is 10 where dull and 100000 nearly a mirror; metal is \
         a Conductor with its `roughness`",
    ),
    (
        &["grain", "noisy", "fireflies", "firefly", "speckles", "grainy"],
        "noise becomes less with more `samples`; `--noise 0.02` stops when it is good, and `--denoise` removes what is \
         left",
    ),
    (
        &["bounce", "bounces", "max_depth", "recursion"],
        "how often light may be turned is `max_bounces`: `render: Render(max_bounces: 8)`",
    ),
    (
        &["zoom", "closer", "telephoto", "wide_angle"],
        "how much is seen is the camera's `fov` in degrees, or its `focal_length` in millimetres: the smaller `fov`, \
         the nearer",
    ),
    (
        &["kelvin", "temperature", "color_temperature", "warm", "cold"],
        "the colour of what glows is that of its temperature in kelvin: `color: \"=blackbody(2700)\"` beside `power` \
         or another amount",
    ),
    (
        &["watt", "watts", "lumen", "lumens", "lux", "candela", "nits", "wattage"],
        "how much light there is is `power` in W, `radiance` in W/(sr m^2), `intensity` in W/sr, `luminous_power` in \
         lm, `luminous_intensity` in cd or `luminance` in cd/m^2: one of them",
    ),
    (&["bulb", "lamp", "lightbulb", "lantern"], "a bulb is a small SphereLight, or a shape of the material Emissive"),
    (
        &["pillar", "column", "colonnade"],
        "a pillar is a Cylinder; a row of them is its `placements: Grid(..)` or Ring(..)",
    ),
    (&["isometric", "ortho", "parallel"], "parallel rays are a camera's `projection: Orthographic(height: 4)`"),
    (
        &["fresnel", "schlick"],
        "glass, metal and `energy_conserving` gloss reflect more at grazing angles by themselves; there is no such \
         field",
    ),
    (
        &["expression", "expressions", "formula", "arithmetic", "calculation"],
        "a text that begins with `=` is reckoned wherever a number may stand: `radius: \"=2*r\"`; `r` stands in `vars`",
    ),
    (
        &["preview", "watch", "viewer", "window_preview"],
        "`tracer preview scene.ron` shows the picture in the browser while the scene is edited",
    ),
    (&["gpu", "cuda", "opencl", "optix"], "there is no need of a GPU: all cores of the processor are at work"),
    (
        &["instancing", "instances", "duplicate"],
        "copies of an object are its `placements`: a list, a file, Grid(..), Ring(..) or Scatter(..)",
    ),
    (
        &["absorption", "absorb", "beer", "beer-lambert", "extinction", "attenuation"],
        "glass takes nothing on the way through: it is coloured by its `transmittance`, once at each surface",
    ),
    (
        &["dispersion", "abbe", "rainbow", "spectrum", "spectral", "wavelength"],
        "there are no wavelengths: glass refracts red, green and blue alike",
    ),
    (
        &["thin", "thin_walled", "thinwalled", "soap", "bubble"],
        "what is thin and of glass is a thin Box of Transparent(ior: 1.5), or one Sphere of it in another; what is \
         matt may have no thickness: Rectangle, Disk",
    ),
    (
        &["lens", "magnifier", "loupe"],
        "a lens is the Intersection of two Spheres, of Transparent(ior: 1.5); that of the camera is an effect: \
         `effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5))`",
    ),
    (
        &["f_stop", "fstop", "f-stop", "fnumber", "bokeh"],
        "the `aperture` of a ThinLens is its focal length over the f-number",
    ),
];

/// What there is for a thing of every day.
pub(crate) fn thing(word: &str) -> Option<&'static str> {
    WORDS.iter().find(|(words, _)| words.contains(&word)).map(|(_, text)| *text)
}

/// What there is for a word of every day, a line each; none where nobody knows it.
pub(crate) fn everyday(word: &str) -> Vec<String> {
    let lower = word.trim().to_ascii_lowercase();
    if let Some(text) = thing(&lower) {
        return vec![text.to_owned()];
    }
    let kinds = [Object::TYPE, Material::TYPE, Light::TYPE, Transform::TYPE, Layer::TYPE].into_iter().chain(textures());
    let kinds: Vec<&'static EnumDef> = kinds.filter_map(enum_of).collect();
    let mut said: Vec<String> = Vec::new();
    let mut say = |text: String| {
        if !said.contains(&text) {
            said.push(text);
        }
    };
    for def in &kinds {
        if let Some(kind) = kind_elsewhere(&lower, def) {
            say(format!("{} is called {kind} here: `tracer explain {kind}` tells more", word.trim()));
        }
    }
    for def in &kinds {
        // That it stands in the wrong place is said of what stands somewhere.
        let misplaced = of_another_list(&lower, def);
        if let Some(hint) = other_kind(&lower, def).filter(|hint| Some(*hint) != misplaced) {
            say(hint.to_owned());
        }
    }
    let structs = [Scene::TYPE, Camera::TYPE, Effects::TYPE, Sphere::TYPE].into_iter().filter_map(struct_of);
    for hint in structs.filter_map(|def| field_of_others(&lower, def, Syntax::Ron)) {
        say(hint.to_owned());
    }
    // Fields have many names; what is known better needs none of them.
    const MOST: usize = 4;
    let fields: Vec<String> = called_elsewhere(&lower).iter().map(|field| format!("`{field}`")).collect();
    if said.is_empty() && (1..=MOST).contains(&fields.len()) {
        let first = fields[0].trim_matches('`');
        let word = word.trim();
        said.push(format!("{word} is called {} here: `tracer explain {first}` tells more", fields.join(" or ")));
    }
    said
}

fn enum_of(kind: Type) -> Option<&'static EnumDef> {
    if let Type::Enum(def) = kind.resolved() { Some(def) } else { None }
}

fn struct_of(kind: Type) -> Option<&'static StructDef> {
    if let Type::Struct(def) = kind.resolved() { Some(def) } else { None }
}

/// The kinds of textures, as an albedo takes them.
fn textures() -> Vec<Type> {
    let albedo = Material::DEF.variant("Diffuse").and_then(|diffuse| match &diffuse.content {
        crate::schema::Content::Struct(def) => def.field("albedo"),
        _ => None,
    });
    let mut found = Vec::new();
    collect(albedo.map_or(Type::Bool, |field| field.kind), &mut found);
    found
}

fn collect(kind: Type, found: &mut Vec<Type>) {
    match kind.resolved() {
        Type::OneOf(kinds) => kinds.iter().for_each(|kind| collect(*kind, found)),
        Type::Optional(inner) => collect(*inner, found),
        kind @ Type::Enum(_) => found.push(kind),
        _ => {}
    }
}
