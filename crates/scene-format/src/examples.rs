//! A small complete scene for every kind of thing in the language: shown in the reference, loaded and rendered by
//! tests.

pub(crate) mod lines;

use crate::desc::{
    Acceleration, Adaptive, Caustics, Curve, GradientAxis, Indirect, Instances, Integrator, Layer, Light, LinesAlong,
    Material, Matte, Metal, NoiseKind, Object, PixelFilter, RampInterpolation, Reuse, Shading, SolidMapping,
    TextureChannel, TextureColorSpace, TextureFilter, TextureWrap, ToneMap, VertexColorSpace, VoronoiFeature,
};
use crate::desc::{
    BackgroundWords, DepthOfField, FisheyeMapping, FovAxis, ITEMS, MappingWords, PatternWords, PlacementPattern,
    Projection, StereoLayout, Stereoscopy, TransformWords, TubeCurve,
};
use crate::schema::EnumDef;

/// A complete scene that shows one kind of thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Example {
    /// What it shows: `Material::Diffuse`.
    pub title: String,
    /// The scene, in RON.
    pub ron: String,
    /// Files that the scene names and that must lie beside it.
    pub files: &'static [ExampleFile],
}

/// A file that an example needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExampleFile {
    /// Its name, relative to the scene.
    pub name: &'static str,
    /// What is in it.
    pub bytes: &'static [u8],
}

/// A tetrahedron as OFF.
const TETRAHEDRON: ExampleFile = ExampleFile {
    name: "tetrahedron.off",
    bytes: b"OFF\n4 4 0\n-1 -1 -1\n1 1 -1\n1 -1 1\n-1 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n",
};

/// A checkerboard of 2 x 2 texels, 8 bits of grey, as PNG.
const CHECKER: ExampleFile = ExampleFile { name: "checker.png", bytes: include_bytes!("checker.png") };

/// Stripes of 4 x 4 texels that are opaque and not, 8 bits of grey and alpha, as PNG.
const CUT: ExampleFile = ExampleFile { name: "cut.png", bytes: include_bytes!("cut.png") };

/// A sky of 16 x 8 pixels with a sun, as HDR.
const SKY: ExampleFile = ExampleFile { name: "sky.hdr", bytes: include_bytes!("sky.hdr") };

/// A chair, to be included.
const CHAIR: ExampleFile = ExampleFile { name: "chair.ron", bytes: include_bytes!("chair.ron") };

/// The choices of the language, each kind of which has an example.
pub(crate) const CHOICES: [&EnumDef; 40] = [
    &Projection::DEF,
    &FovAxis::DEF,
    &FisheyeMapping::DEF,
    &Stereoscopy::DEF,
    &StereoLayout::DEF,
    &PixelFilter::DEF,
    &DepthOfField::DEF,
    &ToneMap::DEF,
    &Layer::DEF,
    &Matte::DEF,
    &Adaptive::DEF,
    &Acceleration::DEF,
    &Integrator::DEF,
    &Reuse::DEF,
    &Caustics::DEF,
    &Indirect::DEF,
    &Light::DEF,
    &BackgroundWords::DEF,
    &Material::DEF,
    &Metal::DEF,
    &PatternWords::DEF,
    &TextureFilter::DEF,
    &TextureWrap::DEF,
    &TextureColorSpace::DEF,
    &TextureChannel::DEF,
    &MappingWords::DEF,
    &ITEMS,
    &SolidMapping::DEF,
    &GradientAxis::DEF,
    &LinesAlong::DEF,
    &NoiseKind::DEF,
    &VoronoiFeature::DEF,
    &VertexColorSpace::DEF,
    &RampInterpolation::DEF,
    &Curve::DEF,
    &TubeCurve::DEF,
    &Instances::DEF,
    &Shading::DEF,
    &TransformWords::DEF,
    &PlacementPattern::DEF,
];

/// What stands in an example for each kind: the name of the choice, the name of the kind, the words. Those of materials
/// and shapes stand at their own words.
const SNIPPETS: [(&str, &str, &str); 158] = [
    ("Projection", "Perspective", "projection: Perspective"),
    ("Projection", "Orthographic", "projection: Orthographic(height: 8)"),
    ("Projection", "Panorama", "projection: Panorama"),
    ("Projection", "Fisheye", "projection: Fisheye(fov: 200, mapping: Equisolid)"),
    ("FovAxis", "Vertical", "fov: 50, fov_axis: Vertical"),
    ("FovAxis", "Horizontal", "fov: 50, fov_axis: Horizontal"),
    ("FovAxis", "Diagonal", "fov: 50, fov_axis: Diagonal"),
    ("FovAxis", "Smaller", "fov: 50, fov_axis: Smaller"),
    ("FovAxis", "Larger", "fov: 50, fov_axis: Larger"),
    ("FisheyeMapping", "Equidistant", "projection: Fisheye(mapping: Equidistant)"),
    ("FisheyeMapping", "Equisolid", "projection: Fisheye(mapping: Equisolid)"),
    ("FisheyeMapping", "Stereographic", "projection: Fisheye(mapping: Stereographic)"),
    ("FisheyeMapping", "Orthographic", "projection: Fisheye(mapping: Orthographic)"),
    ("Stereoscopy", "None", "stereo: None"),
    ("Stereoscopy", "Stereo", "stereo: Stereo(separation: 0.3, convergence: 5)"),
    ("StereoLayout", "SideBySide", "stereo: Stereo(separation: 0.3, layout: SideBySide)"),
    ("StereoLayout", "TopBottom", "projection: Panorama, stereo: Stereo(separation: 0.3, layout: TopBottom)"),
    ("PixelFilter", "None", "antialiasing: None"),
    ("PixelFilter", "Box", "antialiasing: Box"),
    ("PixelFilter", "Gaussian", "antialiasing: Gaussian(sigma: 0.5)"),
    ("PixelFilter", "BlackmanHarris", "antialiasing: BlackmanHarris(radius: 1.5)"),
    ("DepthOfField", "None", "depth_of_field: None"),
    ("DepthOfField", "ThinLens", "depth_of_field: ThinLens(aperture: 0.5, focus_distance: 5)"),
    ("ToneMap", "None", "tone_map: None"),
    ("ToneMap", "Filmic", "tone_map: Filmic"),
    ("ToneMap", "AgX", "tone_map: AgX"),
    ("Layer", "Albedo", "layers: [Albedo]"),
    ("Layer", "Normal", "layers: [Normal]"),
    ("Layer", "Depth", "layers: [Depth]"),
    ("Layer", "Position", "layers: [Position]"),
    ("Layer", "Uv", "layers: [Uv]"),
    ("Layer", "Emission", "layers: [Emission]"),
    ("Layer", "ObjectId", "layers: [ObjectId]"),
    ("Layer", "MaterialId", "layers: [MaterialId]"),
    ("Layer", "Variance", "layers: [Variance]"),
    ("Layer", "Alpha", "layers: [Alpha]"),
    ("Layer", "Noise", "layers: [Noise]"),
    ("Layer", "PathLength", "layers: [PathLength]"),
    ("Layer", "Nodes", "layers: [Nodes]"),
    ("Layer", "Leaves", "layers: [Leaves]"),
    ("Layer", "Direct", "layers: [Direct, Indirect]"),
    ("Layer", "Indirect", "layers: [Direct, Indirect]"),
    ("Layer", "Samples", "layers: [Samples]"),
    ("Layer", "Motion", "layers: [Motion]"),
    ("Layer", "DenoisingAlbedo", "layers: [DenoisingAlbedo, DenoisingNormal]"),
    ("Layer", "DenoisingNormal", "layers: [DenoisingAlbedo, DenoisingNormal]"),
    ("Matte", "Objects", "cryptomatte: [Objects]"),
    ("Matte", "Materials", "cryptomatte: [Materials]"),
    ("Adaptive", "WithNoise", "noise: 0.02, adaptive: WithNoise"),
    ("Adaptive", "Always", "samples: 256, adaptive: Always"),
    ("Adaptive", "Never", "noise: 0.02, adaptive: Never"),
    ("Acceleration", "Bvh", "acceleration: Bvh"),
    ("Acceleration", "BoundingBox", "acceleration: BoundingBox"),
    ("Acceleration", "None", "acceleration: None"),
    ("Integrator", "Full", "integrator: Full"),
    ("Integrator", "Path", "integrator: Path"),
    ("Integrator", "Direct", "integrator: Direct"),
    ("Integrator", "AmbientOcclusion", "integrator: AmbientOcclusion(distance: 2)"),
    ("Reuse", "Blocks", "reuse: Blocks"),
    ("Reuse", "None", "reuse: None"),
    ("Caustics", "Photons", "caustics: Photons"),
    ("Caustics", "None", "caustics: None"),
    ("Indirect", "Paths", "indirect: Paths"),
    ("Indirect", "Map", "indirect: Map"),
    ("Light", "SphereLight", "SphereLight(center: (3, 4, 5), radius: 1, power: (400, 380, 350))"),
    ("BackgroundWords", "Environment", "Environment(file: \"sky.hdr\", scale: 2, rotation: 40)"),
    ("Metal", "Silver", "Conductor(metal: Silver, roughness: 0.1)"),
    ("Metal", "Gold", "Conductor(metal: Gold, roughness: 0.2)"),
    ("Metal", "Copper", "Conductor(metal: Copper, roughness: 0.3)"),
    ("Metal", "Aluminum", "Conductor(metal: Aluminum, roughness: 0.4)"),
    ("Metal", "Iron", "Conductor(metal: Iron, roughness: 0.5)"),
    ("Metal", "Chromium", "Conductor(metal: Chromium)"),
    ("Metal", "Nickel", "Conductor(metal: Nickel, roughness: 0.2)"),
    ("Metal", "Titanium", "Conductor(metal: Titanium, roughness: 0.4)"),
    ("Metal", "Brass", "Conductor(metal: Brass, roughness: 0.25)"),
    ("Metal", "Platinum", "Conductor(metal: Platinum, roughness: 0.15)"),
    ("Metal", "Steel", "Conductor(metal: Steel, roughness: 0.35)"),
    ("PatternWords", "Texture", "Diffuse(albedo: Texture(file: \"checker.png\"))"),
    (
        "PatternWords",
        "Checkerboard",
        "Diffuse(albedo: Checkerboard(a: 0.2, b: (0.8, 0.7, 0.6), mapping: Uv(scale: (16, 8))))",
    ),
    ("PatternWords", "Lines", "Diffuse(albedo: Lines(a: 0.3, b: 0.8, width: 0.1, mapping: Uv(scale: (16, 8))))"),
    (
        "PatternWords",
        "Dots",
        "Diffuse(albedo: Dots(a: 0.7, b: \"#c03020\", radius: 0.35, mapping: Uv(scale: (16, 8))))",
    ),
    ("PatternWords", "Gradient", "Diffuse(albedo: Gradient(a: (0.1, 0.2, 0.5), b: (0.9, 0.7, 0.5)))"),
    ("PatternWords", "Noise", "Diffuse(albedo: Noise(a: 0.1, b: 0.8, mapping: Object(scale: 3)))"),
    (
        "PatternWords",
        "Wood",
        "Diffuse(albedo: Wood(a: (0.5, 0.28, 0.13), b: (0.2, 0.09, 0.04), mapping: Object(scale: 6)))",
    ),
    ("PatternWords", "Marble", "Diffuse(albedo: Marble(a: 0.2, b: 0.8, mapping: Object(scale: 2)))"),
    (
        "PatternWords",
        "Voronoi",
        "Diffuse(albedo: Voronoi(a: (0.2, 0.18, 0.15), b: 0.8, feature: Cell, mapping: Object(scale: 3)))",
    ),
    (
        "PatternWords",
        "ColorRamp",
        "Diffuse(albedo: ColorRamp(input: Noise(mapping: Object(scale: 2)), stops: [(at: 0.35, color: \"#12305a\"), \
         (at: 0.5, color: \"#d8c690\"), (at: 0.6, color: \"#3d6b2a\")]))",
    ),
    (
        "PatternWords",
        "Mix",
        "Diffuse(albedo: Mix(a: Texture(file: \"checker.png\"), b: \"#803018\", weight: Marble(mapping: Object(scale: 2\
         ))))",
    ),
    (
        "PatternWords",
        "Multiply",
        "Diffuse(albedo: Multiply(a: Checkerboard(a: 0.4, mapping: Uv(scale: (16, 8))), b: Gradient(a: \"#d04020\", b: \
         \"#f0d080\")))",
    ),
    ("PatternWords", "VertexColor", "Diffuse(albedo: VertexColor())"),
    ("TextureFilter", "Bilinear", "Diffuse(albedo: Texture(file: \"checker.png\", filter: Bilinear))"),
    ("TextureFilter", "Nearest", "Diffuse(albedo: Texture(file: \"checker.png\", filter: Nearest))"),
    ("TextureWrap", "Repeat", "Diffuse(albedo: Texture(file: \"checker.png\", wrap: Repeat))"),
    ("TextureWrap", "Clamp", "Diffuse(albedo: Texture(file: \"checker.png\", wrap: Clamp))"),
    ("TextureWrap", "Mirror", "Diffuse(albedo: Texture(file: \"checker.png\", wrap: Mirror))"),
    ("TextureColorSpace", "Auto", "Diffuse(albedo: Texture(file: \"checker.png\", color_space: Auto))"),
    ("TextureColorSpace", "Srgb", "Diffuse(albedo: Texture(file: \"checker.png\", color_space: Srgb))"),
    ("TextureColorSpace", "Linear", "Diffuse(albedo: Texture(file: \"checker.png\", color_space: Linear))"),
    ("TextureChannel", "Auto", "Diffuse(albedo: Texture(file: \"checker.png\", channel: Auto))"),
    ("TextureChannel", "Red", "Diffuse(albedo: Texture(file: \"checker.png\", channel: Red))"),
    ("TextureChannel", "Green", "Diffuse(albedo: Texture(file: \"checker.png\", channel: Green))"),
    ("TextureChannel", "Blue", "Diffuse(albedo: Texture(file: \"checker.png\", channel: Blue))"),
    (
        "TextureChannel",
        "Alpha",
        "Diffuse(albedo: Mix(a: 0.2, b: 0.8, weight: Texture(file: \"cut.png\", channel: Alpha)))",
    ),
    ("TextureChannel", "Luminance", "Diffuse(albedo: Texture(file: \"checker.png\", channel: Luminance))"),
    (
        "MappingWords",
        "Uv",
        "Diffuse(albedo: Texture(file: \"checker.png\", mapping: Uv(scale: (4, 2), rotation: 30, offset: (0.5, 0))))",
    ),
    (
        "MappingWords",
        "Planar",
        "Diffuse(albedo: Texture(file: \"checker.png\", mapping: Planar(normal: (0, 1, 2), size: (0.5, 0.3))))",
    ),
    (
        "MappingWords",
        "Spherical",
        "Diffuse(albedo: Texture(file: \"checker.png\", mapping: Spherical(axis: (1, 2, 0), scale: (8, 4))))",
    ),
    (
        "MappingWords",
        "Triplanar",
        "Diffuse(albedo: Texture(file: \"checker.png\", mapping: Triplanar(scale: 2, blend: 0.1)))",
    ),
    ("SolidMapping", "Uv", "Diffuse(albedo: Checkerboard(mapping: Uv(scale: (16, 8))))"),
    ("SolidMapping", "Object", "Diffuse(albedo: Checkerboard(mapping: Object(scale: 4)))"),
    ("SolidMapping", "World", "Diffuse(albedo: Noise(mapping: World(scale: (1, 8, 1), offset: (0, 0.5, 0))))"),
    (
        "SolidMapping",
        "Planar",
        "Diffuse(albedo: Gradient(mapping: Planar(origin: (0, -1, 0), normal: (0, 0, 1), size: 2)))",
    ),
    ("SolidMapping", "Spherical", "Diffuse(albedo: Checkerboard(mapping: Spherical(axis: (1, 1, 0), scale: (12, 6))))"),
    ("SolidMapping", "Triplanar", "Diffuse(albedo: Checkerboard(a: 0.2, mapping: Triplanar(scale: 3)))"),
    ("GradientAxis", "X", "Diffuse(albedo: Gradient(axis: X))"),
    ("GradientAxis", "Y", "Diffuse(albedo: Gradient(axis: Y, mapping: Object(scale: 0.5, offset: (0, 0.5, 0))))"),
    ("GradientAxis", "Z", "Diffuse(albedo: Gradient(axis: Z, mapping: Object(scale: 0.5, offset: (0, 0, 0.5))))"),
    ("GradientAxis", "Radial", "Diffuse(albedo: Gradient(axis: Radial, mapping: Object(offset: (0, -1, 0))))"),
    ("LinesAlong", "Both", "Diffuse(albedo: Lines(along: Both, mapping: Uv(scale: (16, 8))))"),
    ("LinesAlong", "U", "Diffuse(albedo: Lines(along: U, width: 0.5, mapping: Uv(scale: (16, 8))))"),
    ("LinesAlong", "V", "Diffuse(albedo: Lines(along: V, width: 0.5, mapping: Uv(scale: (16, 8))))"),
    ("NoiseKind", "Fbm", "Diffuse(albedo: Noise(kind: Fbm, octaves: 8, mapping: Object(scale: 3)))"),
    ("NoiseKind", "Perlin", "Diffuse(albedo: Noise(kind: Perlin, mapping: Object(scale: 6)))"),
    ("NoiseKind", "Turbulence", "Diffuse(albedo: Noise(kind: Turbulence, gain: 0.6, mapping: Object(scale: 3)))"),
    ("VoronoiFeature", "F1", "Diffuse(albedo: Voronoi(feature: F1, mapping: Object(scale: 3)))"),
    ("VoronoiFeature", "F2MinusF1", "Diffuse(albedo: Voronoi(feature: F2MinusF1, mapping: Object(scale: 3)))"),
    ("VoronoiFeature", "Cell", "Diffuse(albedo: Voronoi(feature: Cell, jitter: 0.7, mapping: Object(scale: 3)))"),
    ("VertexColorSpace", "Auto", "Diffuse(albedo: VertexColor(color_space: Auto))"),
    ("VertexColorSpace", "Srgb", "Diffuse(albedo: VertexColor(color_space: Srgb))"),
    ("VertexColorSpace", "Linear", "Diffuse(albedo: VertexColor(color_space: Linear))"),
    (
        "RampInterpolation",
        "Linear",
        "Diffuse(albedo: ColorRamp(input: Gradient(), interpolation: Linear, stops: [(at: 0.2, color: \"#203060\"), \
         (at: 0.5, color: \"#e0b060\"), (at: 0.8, color: 0.9)]))",
    ),
    (
        "RampInterpolation",
        "Smooth",
        "Diffuse(albedo: ColorRamp(input: Gradient(), interpolation: Smooth, stops: [(at: 0.2, color: \"#203060\"), \
         (at: 0.5, color: \"#e0b060\"), (at: 0.8, color: 0.9)]))",
    ),
    (
        "RampInterpolation",
        "Constant",
        "Diffuse(albedo: ColorRamp(input: Gradient(), interpolation: Constant, stops: [(at: 0.2, color: \"#203060\"), \
         (at: 0.5, color: \"#e0b060\"), (at: 0.8, color: 0.9)]))",
    ),
    (
        "Object",
        "Group",
        "Group(objects: [Box(size: (1, 0.1, 1)), Cylinder(from: (0, -0.8, 0), to: (0, 0, 0), radius: 0.1)], \
         material: Diffuse(albedo: 0.6), placements: Ring(count: 3, radius: 1.2))",
    ),
    (
        "Object",
        "Include",
        "Include(file: \"chair.ron\", vars: { \"height\": 0.6 }, materials: { \"seat\": Diffuse(albedo: \"#803020\") \
         }, \
         placements: Ring(count: 4, radius: 1.2))",
    ),
    ("Curve", "Linear", "curve: Linear"),
    ("Curve", "CatmullRom", "curve: CatmullRom"),
    ("TubeCurve", "CatmullRom", "radius: 0.15, curve: CatmullRom"),
    ("TubeCurve", "Linear", "radius: 0.15, curve: Linear"),
    ("TubeCurve", "Bezier", "radius: 0.15, curve: Bezier"),
    ("Instances", "Auto", "instances: Auto"),
    ("Instances", "Always", "instances: Always"),
    ("Instances", "Never", "instances: Never"),
    ("Shading", "Auto", "shading: Auto"),
    ("Shading", "Smooth", "shading: Smooth"),
    ("Shading", "Flat", "shading: Flat"),
    ("TransformWords", "Translate", "Translate((0.5, 0, -1))"),
    ("TransformWords", "Scale", "Scale((1, 2, 1))"),
    ("TransformWords", "Rotate", "Rotate(axis: (0, 1, 0), degrees: 30)"),
    ("TransformWords", "DropTo", "DropTo(y: -1)"),
    ("TransformWords", "CenterTo", "CenterTo((0, 0.5, 0))"),
    ("TransformWords", "Matrix", "Matrix(rows: ((1, 0.5, 0, 0), (0, 1, 0, 0.2), (0, 0, -1, 0)))"),
    ("TransformWords", "Align", "Align(to: (1, 1, 0))"),
    ("TransformWords", "FitTo", "FitTo(height: 1.5)"),
    ("PlacementPattern", "Grid", "placements: Grid(count: (3, 1, 2), spacing: (1.5, 1, 1.5))"),
    ("PlacementPattern", "Ring", "placements: Ring(count: 7, radius: 1.5)"),
    (
        "PlacementPattern",
        "Scatter",
        "placements: Scatter(count: 20, min: (-2, -0.8, -2), max: (2, -0.8, 2), spacing: 0.6, turn: (0, 1, 0), scale: \
         (0.5, 1.5))",
    ),
    ("Scene", "Scene", ""),
];

/// All of them in the order of [`CHOICES`]: the materials' before the metals', the shapes' before the groups'.
fn snippets() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let first = |name| SNIPPETS.iter().position(|(choice, ..)| *choice == name).unwrap_or(SNIPPETS.len());
    let (before, others) = SNIPPETS.split_at(first(Metal::DEF.name));
    let (between, after) = others.split_at(first(Object::DEF.name) - before.len());
    let told =
        |choice, all: &'static [(&str, &[&str], &str)]| all.iter().map(move |&(kind, _, words)| (choice, kind, words));
    let (materials, shapes) = (told(Material::DEF.name, Material::TOLD), told(Object::DEF.name, Object::TOLD));
    let written = |list: &'static [(&str, &str, &str)]| list.iter().copied();
    written(before).chain(materials).chain(written(between)).chain(shapes).chain(written(after))
}

/// The words that show a kind.
pub(crate) fn snippet(choice: &str, kind: &str) -> Option<&'static str> {
    snippets().find(|(c, k, _)| *c == choice && *k == kind).map(|(_, _, words)| words)
}

/// An example for every kind of thing in the language, in the order of the reference.
pub fn examples() -> Vec<Example> {
    snippets().map(|(choice, kind, words)| example(choice, kind, words)).collect()
}

fn example(choice: &str, kind: &str, words: &'static str) -> Example {
    let (mut more, mut render) = (String::new(), "samples: 16, max_bounces: 4".to_owned());
    let mut light = "SphereLight(center: (3, 4, 5), radius: 1, radiance: 20)".to_owned();
    let mut object = "Sphere(center: (0, 0, 0), radius: 1)".to_owned();
    let mut background = "0.1";
    let mut files: &'static [ExampleFile] = &[];
    let mesh = |words: &str| format!("Mesh(file: \"{}\", {words})", TETRAHEDRON.name);
    let mut camera = "position: (0, 1, 5)".to_owned();
    match choice {
        "Projection" | "FovAxis" | "FisheyeMapping" | "Stereoscopy" | "StereoLayout" => {
            camera = format!("{camera}, {words}")
        }
        "PixelFilter" | "DepthOfField" | "ToneMap" => more = format!("    effects: Effects({words}),\n"),
        "Layer" | "Matte" => more = format!("    output: Output({words}),\n"),
        "Adaptive" => render = words.to_owned(),
        "Acceleration" | "Integrator" | "Reuse" | "Caustics" | "Indirect" => render = format!("{render}, {words}"),
        "Light" => light = words.to_owned(),
        "BackgroundWords" => {
            background = words;
            files = &[SKY];
        }
        "PatternWords" | "VertexColorSpace" if words.contains("VertexColor") => object = painted(words),
        "Material" | "Metal" => object = format!("Sphere(center: (0, 0, 0), radius: 1, material: {words})"),
        "PatternWords" | "TextureFilter" | "TextureWrap" | "TextureColorSpace" | "TextureChannel" | "MappingWords"
        | "SolidMapping" | "GradientAxis" | "LinesAlong" | "NoiseKind" | "VoronoiFeature" | "RampInterpolation" => {
            object = format!("Sphere(center: (0, 0, 0), radius: 1, material: {words})");
            files = if words.contains(CUT.name) { &[CUT] } else { &[CHECKER] };
        }
        "Object" => {
            object = words.to_owned();
            files = match kind {
                "Include" => &[CHAIR],
                "HeightField" => &[CHECKER],
                _ => &[TETRAHEDRON],
            };
        }
        "Curve" => object = format!("Lathe(profile: [(0, -1), (1, -0.5), (0.5, 0.5), (0, 1)], {words})"),
        "TubeCurve" => {
            let points = "[(-1, -0.5, 0), (-0.6, 1, 0), (0.6, -1, 0), (1, 0.5, 0)]";
            object = format!("Tube(points: {points}, {words})");
        }
        "Instances" => {
            object = mesh(&format!("placements: [[], [Translate((1, 0, 0))]], {words}"));
            files = &[TETRAHEDRON];
        }
        "Shading" => {
            object = mesh(words);
            files = &[TETRAHEDRON];
        }
        "PlacementPattern" => object = format!("Box(size: 0.4, {words})"),
        "TransformWords" => {
            object = mesh(&format!("transform: [{words}]"));
            files = &[TETRAHEDRON];
        }
        _ => {}
    }
    let ron = format!(
        "Scene(\n    camera: Camera({camera}),\n    image: Image(width: 64, height: 64),\n    render: \
         Render({render}),\n{more}    background: {background},\n    lights: [{light}],\n    objects: [\n        \
         {object},\n        \
         Sphere(center: (0, -1001, 0), radius: 1000),\n    ],\n)\n"
    );
    let choice = choice.trim_end_matches("Words");
    let title = if choice == kind { kind.to_owned() } else { format!("{choice}::{kind}") };
    Example { title, ron, files }
}

/// A tetrahedron whose points have colours.
fn painted(material: &str) -> String {
    let points = "[(-1, -1, -1), (1, 1, -1), (1, -1, 1), (-1, 1, 1)]";
    let faces = "[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]";
    let colors = r##"["#d03020", "#30a040", "#e0b020", "#2050c0"]"##;
    let fields = [("points", points), ("faces", faces), ("colors", colors), ("material", material)];
    let lines: String = fields.iter().map(|(name, value)| format!("            {name}: {value},\n")).collect();
    format!("Mesh(\n{lines}        )")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Syntax, load_str};
    use std::path::Path;

    #[test]
    fn every_kind_has_an_example_that_loads_without_a_warning() {
        let examples = examples();
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
        for choice in CHOICES {
            for variant in choice.variants {
                let title = format!("{}::{}", choice.name.trim_end_matches("Words"), variant.name);
                let example = examples.iter().find(|example| example.title == title);
                let example = example.unwrap_or_else(|| panic!("{title} has no example"));
                assert!(example.ron.contains(variant.name), "{title} does not show it:\n{}", example.ron);
            }
        }
        for example in &examples {
            let loaded = load_str(&example.title, &example.ron, Syntax::Ron, folder, &[]);
            let loaded = loaded.unwrap_or_else(|error| panic!("{}: {error:?}\n{}", example.title, example.ron));
            assert_eq!(loaded.warnings, Vec::new(), "{}", example.title);
        }
    }
}
