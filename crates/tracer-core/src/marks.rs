//! Where points of a scene are in its picture, and whether they are seen: for labels that are laid over it.

use crate::engine::{RenderOptions, Unobserved, render};
use crate::scene::{Camera, Filter, FisheyeMapping, Projection, Scene};
use glam::DVec3;
use scene_format::SceneDesc;
use std::f64::consts::PI;
use tracer_kernels::layers::{Layer, LayerSet};

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
        let Seen { of_eye, whole, beside } = Seen::by(&scene.camera, eye, point);
        let place = place(&of_eye, point).filter(|_| beside);
        let within = place.is_some_and(|place| place.iter().all(|x| x.abs() <= 1.0));
        let pixel = place.map(whole).map(|[x, y]| [(x + 1.0) / 2.0 * size[0], (1.0 - y) / 2.0 * size[1]]);
        let depth = depth(&of_eye, point);
        let seen = within && depth >= scene.camera.near && is_free(scene, &of_eye, point);
        MarkSeen { name: mark.name.value.clone(), eye, pixel, depth: depth / scene.frame.scale, seen }
    };
    let marks = desc.output.marks.iter().flat_map(|mark| eyes.iter().map(move |eye| (mark, *eye)));
    let seen = marks.map(of).collect();
    scene.moments = moments;
    seen
}

/// How an eye sees a point.
struct Seen<F> {
    /// The camera, as if it were the only eye.
    of_eye: Camera,
    /// From a place in its picture to that in the whole.
    whole: F,
    /// The point does not lie between the eyes of a panorama, where none of them sees it.
    beside: bool,
}

impl Seen<()> {
    fn by(camera: &Camera, eye: Option<Eye>, point: DVec3) -> Seen<impl Fn([f64; 2]) -> [f64; 2] + use<>> {
        let stereo = camera.stereo.zip(eye).map(|(stereo, eye)| (stereo, eye.side()));
        let (mut of_eye, mut beside) = (Camera { stereo: None, ..*camera }, true);
        if let Some((stereo, side)) = stereo {
            let Camera { eye, forward, right, .. } = *camera;
            let across = right.normalize();
            let aside = side * stereo.aside;
            let [x, z] = [across, forward].map(|axis| (point - eye).dot(axis));
            of_eye.eye += match camera.projection {
                // The ray touches the circle of the eyes: `across` turned by its longitude.
                Projection::Panorama => {
                    let level = libm::hypot(x, z);
                    beside = level > stereo.aside;
                    let longitude = libm::atan2(x, z) - libm::asin((aside / level.max(1e-300)).clamp(-1.0, 1.0));
                    aside * (libm::cos(longitude) * across - libm::sin(longitude) * forward)
                }
                _ => aside * across,
            };
            if let Projection::Perspective { shift, .. } = &mut of_eye.projection {
                shift[0] -= side * stereo.inwards;
            }
        }
        let whole = move |place| stereo.map_or(place, |(stereo, side)| stereo.in_whole(side, place));
        Seen { of_eye, whole, beside }
    }
}

/// In render units.
fn depth(camera: &Camera, point: DVec3) -> f64 {
    let away = point - camera.eye;
    match camera.projection {
        Projection::Perspective { .. } | Projection::Orthographic => away.dot(camera.forward),
        Projection::Panorama | Projection::Fisheye { .. } => away.length(),
    }
}

/// The place in the picture that shows a point, from -1 to 1 to the right and upwards; the lens' middle is the eye.
fn place(camera: &Camera, point: DVec3) -> Option<[f64; 2]> {
    let Camera { forward, right, up, .. } = *camera;
    let away = point - camera.eye;
    let along = away.dot(forward);
    let [x, y] = [right, up].map(|axis| away.dot(axis) / axis.length_squared());
    match camera.projection {
        Projection::Perspective { shift, .. } => (along > 0.0).then(|| [x / along - shift[0], y / along - shift[1]]),
        Projection::Orthographic => (along > 0.0).then_some([x, y]),
        Projection::Panorama => {
            let level = libm::sqrt(x * x + along * along);
            (away != DVec3::ZERO).then(|| [libm::atan2(x, along) / PI, libm::atan2(y, level) * 2.0 / PI])
        }
        Projection::Fisheye { mapping, scale } => {
            let across = away - along * forward;
            let angle = libm::atan2(across.length(), along);
            let r = match mapping {
                FisheyeMapping::Equidistant => angle,
                FisheyeMapping::Equisolid => libm::sin(angle / 2.0),
                FisheyeMapping::Stereographic => libm::tan(angle / 2.0),
                // Behind the eye the sine would come back.
                FisheyeMapping::Orthographic if along < 0.0 => f64::INFINITY,
                FisheyeMapping::Orthographic => libm::sin(angle),
            } / scale;
            let towards = across.try_normalize().unwrap_or(DVec3::ZERO) * r;
            (r < 1.0).then(|| [right, up].map(|axis| towards.dot(axis) / axis.length_squared()))
        }
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
