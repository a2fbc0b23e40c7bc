//! Where points of a scene are in its picture, and whether they are seen: for labels that are laid over it.

use crate::engine::{RenderOptions, Unobserved, render};
use crate::scene::{Camera, Filter, Projection, Scene};
use glam::DVec3;
use scene_format::SceneDesc;
use tracer_kernels::layers::{Layer, LayerSet};
use tracer_kernels::scene::Seen;

/// One of two eyes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eye {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

impl Eye {
    /// As [`Stereo`] counts them.
    fn side(self) -> f64 {
        match self {
            Eye::Left => -1.0,
            Eye::Right => 1.0,
        }
    }
}

/// A mark of a scene in its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkSeen {
    /// Its name.
    pub name: String,
    /// Whose picture is told of, where two eyes share one.
    pub eye: Option<Eye>,
    /// Where it is, in pixels from the upper left corner of the whole picture, whose first pixel's centre is (0.5,
    /// 0.5); it may lie outside. `None` where no place of the picture shows it, however wide: behind the camera.
    pub pixel: Option<[f64; 2]>,
    /// How far away, as `focus_distance` is measured: along the view axis, of panoramas and fisheyes from the eye.
    pub depth: f64,
    /// Whether it lies in the picture, and nothing before it. What lies on a surface is seen; what lets light through
    /// hides as well.
    pub seen: bool,
}

/// The marks of a scene, in order of writing; each twice where there are two eyes, for the left one first. The scene
/// is as it was afterwards.
///
/// # Examples
///
/// ```
/// use scene_format::{Syntax, load_str};
/// use std::path::Path;
/// use tracer_core::{compile, marks};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = r#"Scene(
///     image: Image(width: 100, height: 50),
///     camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0)),
///     background: 1,
///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
///     output: Output(marks: { "front": (0, 0, 1), "back": (0, 0, -1) }),
/// )"#;
/// let desc = load_str("ball.ron", text, Syntax::Ron, Path::new("."), &[])?.scene;
/// let mut scene = compile(&desc)?;
/// let found = marks(&mut scene, &desc);
/// assert_eq!((found[0].pixel, found[0].seen), (Some([50.0, 25.0]), true));
/// assert_eq!((found[1].pixel, found[1].seen), (Some([50.0, 25.0]), false));
/// # Ok(())
/// # }
/// ```
pub fn marks(scene: &mut Scene, desc: &SceneDesc) -> Vec<MarkSeen> {
    // They are told of as the shutter opens.
    let moments = scene.moments.take();
    let eyes: &[Option<Eye>] =
        if scene.camera.stereo.is_some() { &[Some(Eye::Left), Some(Eye::Right)] } else { &[None] };
    let of = |(mark, eye): (&scene_format::desc::Mark, Option<Eye>)| {
        let point = scene.frame.point(DVec3::from(mark.point.value));
        let size = scene.size.map(f64::from);
        let Seen { of_eye, in_half, in_whole } = scene.camera.sees(eye.map_or(0.0, Eye::side), point);
        let within = in_half.is_some_and(|place| place.iter().all(|x| x.abs() <= 1.0));
        let pixel = in_whole.map(|[x, y]| [(x + 1.0) / 2.0 * size[0], (1.0 - y) / 2.0 * size[1]]);
        let depth = depth(&of_eye, point);
        let seen = within && depth >= scene.camera.near && is_free(scene, &of_eye, point);
        MarkSeen { name: mark.name.value.clone(), eye, pixel, depth: depth / scene.frame.scale, seen }
    };
    let marks = desc.output.marks.iter().flat_map(|mark| eyes.iter().map(move |eye| (mark, *eye)));
    let seen = marks.map(of).collect();
    scene.moments = moments;
    seen
}

/// In render units.
fn depth(camera: &Camera, point: DVec3) -> f64 {
    let away = point - camera.eye;
    match camera.projection {
        Projection::Perspective { .. } | Projection::Orthographic => away.dot(camera.forward),
        Projection::Panorama | Projection::Fisheye { .. } => away.length(),
    }
}

/// Whether nothing lies before a point that a camera sees: by one of one pixel that looks along the ray that shows it.
fn is_free(scene: &mut Scene, camera: &Camera, point: DVec3) -> bool {
    let camera = *camera;
    let (origin, forward) = match camera.projection {
        Projection::Orthographic => (point - (point - camera.eye).dot(camera.forward) * camera.forward, camera.forward),
        _ => match (point - camera.eye).try_normalize() {
            Some(direction) => (camera.eye, direction),
            None => return false,
        },
    };
    let start = if camera.near > 0.0 { camera.near / forward.dot(camera.forward) } else { 0.0 };
    let eye = origin + start * forward;
    let (right, up) = forward.any_orthonormal_pair();
    let projection = Projection::Perspective { shift: [0.0; 2], lens: None };
    let one = Camera { eye, forward, right, up, projection, stereo: None, near: 0.0, filter: Filter::Centre };
    let before = (std::mem::replace(&mut scene.camera, one), scene.size, scene.max_bounces);
    (scene.size, scene.max_bounces) = ([1, 1], 0);
    let options = RenderOptions {
        samples: Some(1),
        threads: 1,
        reuse: Some(false),
        caustics: Some(false),
        layers: Some(LayerSet::from_iter([Layer::Depth])),
        light_groups: Some(false),
        ..RenderOptions::default()
    };
    let film = render(scene, &options, &Unobserved);
    (scene.camera, scene.size, scene.max_bounces) = before;
    let found = film.layer(Layer::Depth).map_or(f64::INFINITY, |depth| f64::from(depth.values[0]));
    let distance = (point - eye).length() / scene.frame.scale;
    // What lies on a surface is on either side of it by rounding.
    found >= distance * (1.0 - 1e-4)
}
