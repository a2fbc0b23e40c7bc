//! Scenes of which the picture shows nothing, known before it is made: all that they have lies beside the view.

use glam::DVec3;
use scene_format::desc::{Background, Object, Transform};
use scene_format::{Diagnostic, SceneDesc, codes};
use tracer_kernels::scene::{Camera, Filter, Frame, Projection, Scene, Sphere};

/// Warns where all boxes of the scene lie beyond one of the planes that bound the view. Where something is in view in
/// part, behind others, or between boxes, that is for the picture to tell.
pub fn warning(desc: &SceneDesc, scene: &Scene) -> Option<Diagnostic> {
    // While the shutter is open what is beside the view may come into it.
    if desc.camera.shutter.value > 0.0 {
        return None;
    }
    // A sky may be all that is meant.
    if matches!(desc.background, Background::Environment(_)) {
        return None;
    }
    if scene.camera.stereo.is_some() {
        return None;
    }
    let is_endless = scene.shapes.iter().any(|shape| shape.unit.is_endless());
    let few = scene.size[0].min(scene.size[1]).max(1);
    // A pixel's filter reaches some pixels beyond the border; of a normal one next to nothing is left at eight sigma.
    let reach = match scene.camera.filter {
        Filter::Centre | Filter::Box => 1.0,
        Filter::Gaussian(sigma) => 8.0 * sigma,
        Filter::BlackmanHarris(radius) => radius,
    };
    let margin = 0.02 + 2.0 * reach / f64::from(few);
    let beside = beyond_one_plane(&scene.camera, margin)?;
    let boxes = scene.second_boxes.as_ref();
    let of_tree = boxes.into_iter().flat_map(|boxes| {
        (0..boxes.len).map(move |k| {
            let [x, x1, y, y1, z, z1] = boxes.planes.map(|column| f64::from(column[k]));
            [DVec3::new(x, y, z), DVec3::new(x1, y1, z1)]
        })
    });
    // Lamps are behind the objects.
    let is_object = |object: u32| (object as usize) < desc.objects.len();
    let loose = scene.spheres.iter().skip(scene.tables.spheres.in_tree);
    let of_sphere = |sphere: &Sphere| {
        let (center, radius) = (sphere.center, DVec3::splat(sphere.radius.abs()));
        [center - radius, center + radius]
    };
    let all = || of_tree.clone().chain(loose.clone().map(of_sphere));
    let objects = || of_tree.clone().chain(loose.clone().filter(|sphere| is_object(sphere.object)).map(of_sphere));
    if let Some([width, height]) = speck(scene, objects()) {
        let way = scene.camera.eye.distance(objects().next().map_or(DVec3::ZERO, |[low, high]| 0.5 * (low + high)));
        let beside = if is_endless { " beside its planes" } else { "" };
        let message = format!("all that the scene has{beside} is seen in {width}x{height} pixels");
        let far = format!("the camera is {} away from it", rounded(way / scene.frame.scale));
        let mend = mesh_brought(desc, &scene.camera, &scene.frame)
            .map_or(String::new(), |steps| format!(" A mesh is brought there by {steps}"));
        return Some(
            Diagnostic::warning(codes::OTHER_SCALE, desc.camera.position.span, message)
                .expected("a camera near enough to see it")
                .hint(format!("{far}: move it nearer, or is one of the two in other units?{mend}")),
        );
    }
    // What has no end is in view somewhere.
    if is_endless {
        return None;
    }
    let mut any = false;
    let outside = all().inspect(|_| any = true).all(|ends| beside(&ends));
    (outside && any).then(|| {
        let message = "nothing is in view: all that the scene has lies beside or behind the view";
        Diagnostic::warning(codes::NOTHING_IN_VIEW, desc.camera.look_at.span, message)
            .expected("objects between the camera and where it looks")
            .hint(way_into_view(desc, scene))
    })
}

/// What to do where nothing is in view.
pub fn way_into_view(desc: &SceneDesc, scene: &Scene) -> String {
    let mesh = mesh_brought(desc, &scene.camera, &scene.frame)
        .map_or(String::new(), |steps| format!(", or bring a mesh there by {steps}"));
    format!("set `look_at` to the middle of an object{mesh}; `tracer info --objects` tells where the objects are")
}

/// The steps that bring a mesh to where the camera looks, half as large as what is seen there; `None`: the scene has no
/// mesh of a file, or all have been brought somewhere. They lie where their programs had them, in units of these, and
/// nobody sees a file's.
pub(super) fn mesh_brought(desc: &SceneDesc, camera: &Camera, frame: &Frame) -> Option<String> {
    let is_where_it_was = |object: &Object| match object {
        Object::Mesh(mesh) => {
            let is_centred = mesh.transform.iter().any(|step| matches!(step.value, Transform::CenterTo { .. }));
            mesh.file().is_some() && !is_centred
        }
        _ => false,
    };
    let any = desc.objects.iter().any(|object| is_where_it_was(&object.value));
    any.then(|| {
        let ([x, y, z], size) = (desc.camera.look_at.value, rounded(half_of_view(desc, camera, frame)));
        format!("`transform: [FitTo(size: {size}), CenterTo(({x}, {y}, {z}))]`")
    })
}

/// Half the height of what the camera sees at the point that it looks at, in the scene's unit; where it sees all around
/// half the way there.
fn half_of_view(desc: &SceneDesc, camera: &Camera, frame: &Frame) -> f64 {
    let away = camera.eye.distance(frame.point(DVec3::from(desc.camera.look_at.value)));
    let half = match camera.projection {
        Projection::Perspective { .. } => away * camera.up.length(),
        Projection::Orthographic => camera.up.length(),
        Projection::Panorama | Projection::Fisheye { .. } => 0.5 * away,
    };
    half / frame.scale
}

/// A number as people say it: of two digits.
fn rounded(x: f64) -> String {
    let digits = format!("{x:.1e}");
    digits.parse().map_or(digits, |x: f64| x.to_string())
}

/// How many columns and rows of pixels the boxes take, where these are a few of many; `None`: they are more, or reach
/// behind the camera.
fn speck(scene: &Scene, boxes: impl Iterator<Item = [DVec3; 2]>) -> Option<[u32; 2]> {
    const MOST: f64 = 3.0;
    let camera = &scene.camera;
    if scene.size.iter().any(|&side| f64::from(side) < 16.0 * MOST) {
        return None;
    }
    let half = scene.size.map(|side| 0.5 * f64::from(side));
    let mut seen: Option<[[f64; 2]; 2]> = None;
    for ends in boxes {
        for k in 0..8 {
            let pick = |bit: usize| ends[k >> bit & 1][bit];
            let place = camera.sees(-1.0, DVec3::new(pick(0), pick(1), pick(2))).in_whole?;
            let at = [0, 1].map(|axis| place[axis] * half[axis]);
            let [low, high] = seen.unwrap_or([at, at]);
            let low = [0, 1].map(|axis| f64::min(low[axis], at[axis]));
            let high = [0, 1].map(|axis| f64::max(high[axis], at[axis]));
            if (0..2).any(|axis| high[axis] - low[axis] > MOST || low[axis] < -half[axis] || high[axis] > half[axis]) {
                return None;
            }
            seen = Some([low, high]);
        }
    }
    seen.map(|[low, high]| [0, 1].map(|axis| libm::ceil(high[axis] - low[axis]).max(1.0) as u32))
}

/// Whether a box, given by two of its corners, lies beyond a plane of the view; `None`: the view has no such planes.
fn beyond_one_plane(camera: &Camera, margin: f64) -> Option<impl Fn(&[DVec3; 2]) -> bool> {
    // Across the view x = a z + b at the border, z being the depth.
    let (shift, flat) = match camera.projection {
        Projection::Perspective { shift, lens: None } => (shift, false),
        Projection::Orthographic => ([0.0; 2], true),
        _ => return None,
    };
    let (eye, forward) = (camera.eye, camera.forward);
    let axes = [camera.right / camera.right.length_squared(), camera.up / camera.up.length_squared()];
    Some(move |&[lower, upper]: &[DVec3; 2]| {
        let corner = |k: usize| {
            let pick = |bit: usize, a: f64, b: f64| if k >> bit & 1 == 0 { a } else { b };
            DVec3::new(pick(0, lower.x, upper.x), pick(1, lower.y, upper.y), pick(2, lower.z, upper.z)) - eye
        };
        let all = |outside: &dyn Fn(DVec3) -> bool| (0..8).all(|k| outside(corner(k)));
        let border = |d: DVec3| if flat { 1.0 } else { d.dot(forward) };
        all(&|d| d.dot(forward) <= 0.0)
            || (0..2).any(|k| {
                all(&|d| d.dot(axes[k]) > (1.0 + margin + shift[k]) * border(d))
                    || all(&|d| d.dot(axes[k]) < (-1.0 - margin + shift[k]) * border(d))
            })
    })
}
