//! Where the objects of a scene are: in its world, and in its picture.

use crate::Scene;
use crate::scene::{Camera, Instance, Projection};
use glam::DVec3;

/// Where an object is, all its copies together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whereabouts {
    /// How many copies it has: none where something is wrong with it or no frame shows it.
    pub copies: u64,
    /// A box around them in the person's world, by its lower and upper corner; `None`: without an end, or no copies.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Where the picture shows that box.
    pub seen: SeenAt,
}

/// Where the picture shows a box. What stands before it, and how much of the box is filled, does not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SeenAt {
    /// Within these pixels: left, top, right and bottom, the last two one beyond.
    Pixels([u32; 4]),
    /// The camera is within it or beside it: what of it is in view is not one rectangle.
    Around,
    /// Its middle in this pixel, of the left eye's picture where there are two. Said of pictures with two eyes and of
    /// those of all directions, in which a box is no rectangle.
    Middle([u32; 2]),
    /// Behind the camera.
    Behind,
    /// Beyond the left border.
    Left,
    /// Beyond the right border.
    Right,
    /// Beyond the upper border.
    Above,
    /// Beyond the lower border.
    Below,
    /// Beyond the border of a round picture; or there is nothing.
    Nowhere,
}

/// Where each object of the scene is, and behind them each light. It looks at every vertex and every copy once.
///
/// ```
/// use scene_format::{Syntax, load_str};
/// use tracer_core::{SeenAt, compile, whereabouts};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = "Scene(image: Image(width: 40, height: 40), camera: Camera(position: (0, 0, 9), look_at: (0, 0, 0), \
///             fov: 90), objects: [Sphere(center: (0, 0, 0), radius: 1), Sphere(center: (0, 0, 20), radius: 1)])";
/// let scene = compile(&load_str("balls.ron", text, Syntax::Ron, std::path::Path::new("."), &[])?.scene)?;
/// let [near, behind] = whereabouts(&scene)[..] else { panic!("two") };
/// assert_eq!(near.bounds, Some([[-1.0; 3], [1.0; 3]]));
/// assert_eq!((near.seen, behind.seen), (SeenAt::Pixels([17, 17, 23, 23]), SeenAt::Behind));
/// # Ok(())
/// # }
/// ```
pub fn whereabouts(scene: &Scene) -> Vec<Whereabouts> {
    let mut all: Vec<(u64, Option<[DVec3; 2]>, bool)> = Vec::new();
    for (object, bounds) in boxes(scene) {
        if all.len() <= object as usize {
            all.resize(object as usize + 1, (0, None, false));
        }
        let of = &mut all[object as usize];
        of.0 += 1;
        match (bounds, of.1) {
            (Some([low, high]), Some([least, most])) => of.1 = Some([least.min(low), most.max(high)]),
            (Some(first), None) => of.1 = Some(first),
            (None, _) => of.2 = true,
        }
    }
    let world = |p: DVec3| (p / scene.frame.scale + scene.frame.centre).to_array();
    let told = |(copies, bounds, endless): (u64, Option<[DVec3; 2]>, bool)| {
        let bounds = bounds.filter(|_| !endless);
        let seen = match bounds {
            Some(bounds) => seen_at(&scene.camera, scene.size, bounds),
            None if endless => SeenAt::Around,
            None => SeenAt::Nowhere,
        };
        Whereabouts { copies, bounds: bounds.map(|corners| corners.map(world)), seen }
    };
    all.into_iter().map(told).collect()
}

/// Of each thing that is placed the object, and a box around it in render space; `None`: it has no end.
fn boxes(scene: &Scene) -> impl Iterator<Item = (u32, Option<[DVec3; 2]>)> {
    let spheres = scene.spheres.iter().map(|sphere| {
        let radius = DVec3::splat(sphere.radius.abs());
        (sphere.object, Some([sphere.center - radius, sphere.center + radius]))
    });
    let shapes = scene.shapes.iter().map(|shape| (shape.object, (!shape.unit.is_endless()).then(|| shape.bounds())));
    let of_mesh = |mesh: &crate::scene::Mesh| {
        let triangles = mesh.first_triangle..mesh.first_triangle + mesh.triangle_count;
        around(triangles.filter_map(|triangle| scene.triangles.corners(triangle)).flatten())
    };
    let meshes: Vec<Option<[DVec3; 2]>> = scene.meshes.iter().map(of_mesh).collect();
    let copies = scene.instances.iter().filter_map(move |copy| {
        let own = (*meshes.get(copy.mesh as usize)?)?;
        Some((copy.object, around(corners(own).map(|corner| placed(copy, corner)))))
    });
    spheres.chain(shapes).chain(copies)
}

/// A box around points; `None`: there are none.
fn around(points: impl Iterator<Item = DVec3>) -> Option<[DVec3; 2]> {
    points.map(|p| [p, p]).reduce(|[low, high], [p, _]| [low.min(p), high.max(p)])
}

fn corners([low, high]: [DVec3; 2]) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |k: u32| {
        let upper = glam::BVec3::new(k & 1 == 1, k >> 1 & 1 == 1, k >> 2 & 1 == 1);
        DVec3::select(upper, high, low)
    })
}

/// A point of a mesh in a copy of it.
fn placed(copy: &Instance, p: DVec3) -> DVec3 {
    let row = |[x, y, z, at]: [f32; 4]| DVec3::new(x.into(), y.into(), z.into()).dot(p) + f64::from(at);
    copy.placement.map_or(p, |rows| DVec3::from(rows.map(row)))
}

/// Where the picture shows a box.
fn seen_at(camera: &Camera, size: [u32; 2], bounds: [DVec3; 2]) -> SeenAt {
    let of_place = |[x, y]: [f64; 2]| [(x + 1.0) * 0.5 * f64::from(size[0]), (1.0 - y) * 0.5 * f64::from(size[1])];
    let flat = match camera.projection {
        Projection::Perspective { .. } => false,
        Projection::Orthographic => true,
        Projection::Panorama | Projection::Fisheye { .. } => return middle(camera, size, bounds, of_place),
    };
    if camera.stereo.is_some() {
        return middle(camera, size, bounds, of_place);
    }
    let shift = match camera.projection {
        Projection::Perspective { shift, .. } => shift,
        _ => [0.0; 2],
    };
    // To the right, upwards, and the depth.
    let seen: Vec<[f64; 3]> = corners(bounds)
        .map(|corner| {
            let away = corner - camera.eye;
            let [x, y] = [camera.right, camera.up].map(|axis| away.dot(axis) / axis.length_squared());
            [x, y, away.dot(camera.forward)]
        })
        .collect();
    let all = |beyond: &dyn Fn(&[f64; 3]) -> bool| seen.iter().all(beyond);
    let border = |depth: f64| if flat { 1.0 } else { depth };
    if all(&|p| p[2] <= camera.near) {
        return SeenAt::Behind;
    }
    let beyond =
        |axis: usize, side: f64| all(&|p: &[f64; 3]| side * (p[axis] - shift[axis] * border(p[2])) > border(p[2]));
    for (axis, side, told) in
        [(0, -1.0, SeenAt::Left), (0, 1.0, SeenAt::Right), (1, 1.0, SeenAt::Above), (1, -1.0, SeenAt::Below)]
    {
        if beyond(axis, side) {
            return told;
        }
    }
    if !flat && !all(&|p| p[2] > 0.0) {
        return SeenAt::Around;
    }
    let places = seen.iter().map(|p| of_place([0, 1].map(|axis| p[axis] / border(p[2]) - shift[axis])));
    let [low, high] = places.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[0, 1].map(|axis| low[axis].min(p[axis])), [0, 1].map(|axis| high[axis].max(p[axis]))]
    });
    let within = |axis: usize, x: f64| x.clamp(0.0, f64::from(size[axis])) as u32;
    let [left, top] = [0, 1].map(|axis| within(axis, low[axis].floor()));
    let [right, bottom] = [0, 1].map(|axis| within(axis, high[axis].ceil()));
    SeenAt::Pixels([left, top, right, bottom])
}

/// Where the picture shows the middle of a box.
fn middle(camera: &Camera, size: [u32; 2], [low, high]: [DVec3; 2], of_place: impl Fn([f64; 2]) -> [f64; 2]) -> SeenAt {
    let Some(place) = camera.sees(-1.0, 0.5 * (low + high)).in_whole else { return SeenAt::Nowhere };
    let at = of_place(place);
    let within = (0..2).all(|axis| at[axis] >= 0.0 && at[axis] <= f64::from(size[axis]));
    if within { SeenAt::Middle([0, 1].map(|axis| (at[axis] as u32).min(size[axis] - 1))) } else { SeenAt::Nowhere }
}
