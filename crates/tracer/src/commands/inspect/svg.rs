//! A path as a drawing: from above and from the side, what it meets numbered, rays to lights dashed.

use super::Explained;
use std::fmt::Write;
use tracer_core::scene::{NONE, Scene};
use tracer_core::{PathTold, VertexTold};

/// Pixels of a view's side, and around it.
const SIDE: f64 = 480.0;
const MARGIN: f64 = 24.0;
/// Of more triangles than this no outline is drawn: it would be a blot.
const MOST_TRIANGLES: usize = 4000;
/// And of more spheres.
const MOST_SPHERES: usize = 1000;

const STYLE: &str = "\
  text { font: 12px sans-serif; fill: #222 }
  .title { font-weight: bold }
  .thing { fill: none; stroke: #c8c8c8; stroke-width: 0.7 }
  .ray { stroke: #1f5fa8; stroke-width: 1.6 }
  .branch { stroke: #8a4fbf }
  .lost { stroke-opacity: 0.45 }
  .shadow { stroke-dasharray: 5 4; stroke-width: 1.2 }
  .seen { stroke: #d9820a }
  .hidden { stroke: #9a9a9a }
  .hit { fill: #fff; stroke: #222; stroke-width: 1.2 }
  .light { fill: #ffd75e; stroke: #a86a00 }
  .number { font-size: 11px; text-anchor: middle }";

/// Which axes a view has, across and up, and whether up is the other way round.
struct View {
    title: &'static str,
    across: usize,
    up: usize,
    sign: f64,
}

/// From above -z is up, as a map of what the default camera sees has it.
const VIEWS: [View; 2] = [
    View { title: "from above (x to the right, -z up)", across: 0, up: 2, sign: -1.0 },
    View { title: "from the side (x to the right, y up)", across: 0, up: 1, sign: 1.0 },
];

/// The drawing.
pub fn svg(of: &Explained) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = draw(of, &mut out);
    out
}

fn draw(of: &Explained, out: &mut String) -> std::fmt::Result {
    let (width, height) = (2.0 * SIDE + 3.0 * MARGIN, SIDE + 4.0 * MARGIN);
    writeln!(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\">")?;
    writeln!(out, "<style>\n{STYLE}\n</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>")?;
    let [x, y] = of.told.pixel;
    let name = of.desc.sources.first().map_or("", |source| source.name.as_str());
    let title = escaped(&format!("{name}, pixel {x},{y}, sample {}", of.told.sample));
    writeln!(out, "<title>{title}</title>\n<text class=\"title\" x=\"{MARGIN}\" y=\"{MARGIN}\">{title}</text>")?;
    for (k, view) in VIEWS.iter().enumerate() {
        let left = MARGIN + k as f64 * (SIDE + MARGIN);
        panel(of, view, [left, 2.5 * MARGIN], k, out)?;
    }
    writeln!(out, "</svg>")
}

/// One view: what lies there in grey, the path over it.
fn panel(of: &Explained, view: &View, at: [f64; 2], number: usize, out: &mut String) -> std::fmt::Result {
    let path = &of.told.path;
    let frame = Frame::around(path, view);
    writeln!(out, "<clipPath id=\"view{number}\"><rect width=\"{SIDE}\" height=\"{SIDE}\"/></clipPath>")?;
    writeln!(out, "<g transform=\"translate({} {})\">", at[0], at[1])?;
    writeln!(out, "<text y=\"-6\">{}</text>", view.title)?;
    writeln!(out, "<rect width=\"{SIDE}\" height=\"{SIDE}\" fill=\"#fafafa\" stroke=\"#888\"/>")?;
    writeln!(out, "<g clip-path=\"url(#view{number})\">")?;
    things(&of.scene, &frame, out)?;
    rays(path, &frame, out)?;
    marks(path, &frame, out)?;
    let (bar, length) = frame.scale_bar();
    let foot = SIDE - 10.0;
    writeln!(out, "<path class=\"hit\" d=\"M10 {foot}h{bar:.1}\"/>")?;
    writeln!(out, "<text x=\"10\" y=\"{:.1}\">{length}</text>", foot - 5.0)?;
    writeln!(out, "</g>\n</g>")
}

/// Where points of the scene lie in a view.
struct Frame<'a> {
    view: &'a View,
    low: [f64; 2],
    scale: f64,
}

impl<'a> Frame<'a> {
    /// So that all of a path is seen, and the lights that it asked.
    fn around(path: &PathTold, view: &'a View) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let ends = path.vertices.iter().flat_map(|vertex| {
            [vertex.told.as_ref().map(|told| told.point), vertex.sampled.as_ref().and_then(|sampled| sampled.point)]
        });
        for point in path.camera.into_iter().chain(ends.flatten()) {
            for (axis, x) in flat(view, point).into_iter().enumerate() {
                (low[axis], high[axis]) = (low[axis].min(x), high[axis].max(x));
            }
        }
        let size = (0..2).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        let size = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let middle = [0, 1].map(|axis| if low[axis].is_finite() { (low[axis] + high[axis]) / 2.0 } else { 0.0 });
        let around = 1.2 * size;
        Frame { view, low: middle.map(|x| x - around / 2.0), scale: SIDE / around }
    }

    fn at(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y] = flat(self.view, point);
        [(x - self.low[0]) * self.scale, SIDE - (y - self.low[1]) * self.scale]
    }

    /// A round length of the scene about a fifth as long as the view: in pixels, and as it is called.
    fn scale_bar(&self) -> (f64, String) {
        let most = SIDE / 5.0 / self.scale;
        let ten = 10f64.powf(most.log10().floor());
        let length = [5.0, 2.0, 1.0].into_iter().map(|k| k * ten).find(|&length| length <= most).unwrap_or(ten);
        (length * self.scale, super::text::digits(length))
    }
}

fn flat(view: &View, point: [f64; 3]) -> [f64; 2] {
    [point[view.across], view.sign * point[view.up]]
}

/// Outlines of spheres and edges of triangles.
fn things(scene: &Scene, frame: &Frame<'_>, out: &mut String) -> std::fmt::Result {
    let to_world = |p: [f64; 3]| [0, 1, 2].map(|c| p[c] / scene.frame.scale + scene.frame.centre.to_array()[c]);
    if scene.spheres.len() <= MOST_SPHERES {
        for sphere in scene.spheres.iter() {
            let [x, y] = frame.at(to_world(sphere.center.to_array()));
            let radius = sphere.radius / scene.frame.scale * frame.scale;
            // Circles of a million pixels are no circles to those who draw them.
            if radius < 1e5 {
                writeln!(out, "<circle class=\"thing\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>")?;
            }
        }
    }
    let count = |mesh: u32| scene.meshes.get(mesh as usize).map_or(0, |mesh| mesh.triangle_count as usize);
    if scene.instances.iter().map(|instance| count(instance.mesh)).sum::<usize>() > MOST_TRIANGLES {
        return Ok(());
    }
    for instance in scene.instances.iter().filter(|instance| instance.mesh != NONE) {
        let Some(mesh) = scene.meshes.get(instance.mesh as usize) else { continue };
        for triangle in mesh.first_triangle..mesh.first_triangle + mesh.triangle_count {
            let Some(corners) = scene.triangles.corners(triangle) else { continue };
            let placed =
                corners.map(|corner| frame.at(to_world(placed(instance.placement.as_ref(), corner.to_array()))));
            let [[ax, ay], [bx, by], [cx, cy]] = placed;
            writeln!(out, "<path class=\"thing\" d=\"M{ax:.1} {ay:.1}L{bx:.1} {by:.1}L{cx:.1} {cy:.1}Z\"/>")?;
        }
    }
    Ok(())
}

/// A point of a mesh in render space.
fn placed(placement: Option<&[[f32; 4]; 3]>, p: [f64; 3]) -> [f64; 3] {
    let Some(rows) = placement else { return p };
    rows.map(|[x, y, z, t]| f64::from(x) * p[0] + f64::from(y) * p[1] + f64::from(z) * p[2] + f64::from(t))
}

/// The point that a ray goes to; of one that leaves the scene one a little way off.
fn end(vertex: &VertexTold, frame: &Frame<'_>) -> [f64; 3] {
    let far = 0.15 * SIDE / frame.scale;
    let away = || [0, 1, 2].map(|c| vertex.origin[c] + far * vertex.direction[c]);
    vertex.told.as_ref().map_or_else(away, |told| told.point)
}

fn line(class: &str, from: [f64; 2], to: [f64; 2], out: &mut String) -> std::fmt::Result {
    let ([ax, ay], [bx, by]) = (from, to);
    writeln!(out, "<line class=\"{class}\" x1=\"{ax:.1}\" y1=\"{ay:.1}\" x2=\"{bx:.1}\" y2=\"{by:.1}\"/>")
}

fn rays(path: &PathTold, frame: &Frame<'_>, out: &mut String) -> std::fmt::Result {
    for vertex in &path.vertices {
        let Some(sampled) = vertex.sampled.as_ref().filter(|sampled| sampled.arrives.is_some()) else { continue };
        let Some(told) = &vertex.told else { continue };
        let far = 0.15 * SIDE / frame.scale;
        let to = sampled.point.unwrap_or([0, 1, 2].map(|c| told.point[c] + far * sampled.direction[c]));
        let seen = if sampled.arrives == Some(true) { "seen" } else { "hidden" };
        line(&format!("shadow {seen}"), frame.at(told.point), frame.at(to), out)?;
    }
    for vertex in &path.vertices {
        let branch = if vertex.is_branch { " branch" } else { "" };
        let lost = if vertex.told.is_none() { " lost" } else { "" };
        line(&format!("ray{branch}{lost}"), frame.at(vertex.origin), frame.at(end(vertex, frame)), out)?;
    }
    Ok(())
}

/// Numbers where the path has met something.
fn marks(path: &PathTold, frame: &Frame<'_>, out: &mut String) -> std::fmt::Result {
    if let Some(camera) = path.camera {
        let [x, y] = frame.at(camera);
        writeln!(out, "<path class=\"hit\" d=\"M{:.1} {:.1}h10v10h-10z\"/>", x - 5.0, y - 5.0)?;
        writeln!(out, "<text x=\"{:.1}\" y=\"{:.1}\">camera</text>", x + 9.0, y + 4.0)?;
    }
    for (k, vertex) in path.vertices.iter().enumerate() {
        let Some(told) = &vertex.told else { continue };
        let [x, y] = frame.at(told.point);
        let light = if told.is_light { " light" } else { "" };
        writeln!(out, "<circle class=\"hit{light}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\"/>")?;
        writeln!(out, "<text class=\"number\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>", y + 4.0, k + 1)?;
    }
    Ok(())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
