//! Shapes that become triangles when they are compiled.

use super::curved::steps;
use super::draw::once_in;
use super::meshes::Point;
use super::world::{World, inline};
use crate::picture::Picture;
use glam::DVec3;
use scene_format::desc::{
    Arrow, Corners, Curve, Extrude, HeightField, Lathe, Material, Name, Object, Outline, PathPoints, Polygon, Profile,
    Radii, Transform, Tube, TubeCurve, Vec3,
};
use std::f64::consts::TAU;
use std::path::PathBuf;
use tracer_reference::Random;

/// Adds such a shape within a sphere. Glass is closed.
// Long: one arm for each shape, with its fields.
pub fn shape(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    let glass = material.transmits();
    let curve = if once_in(random, 2) { Curve::CatmullRom } else { Curve::Linear };
    let segments = if once_in(random, 2) { 128 } else { 3 + random.below(30) as u32 };
    let transform = if once_in(random, 4) { Vec::new() } else { steps([0.0; 3], radius, random) };
    let there = vec![Transform::Translate(center).into()];
    let placements = std::iter::once(there).collect();
    let (material, name) = (inline(material), Name::default());
    let object = match random.below(11) {
        10 if !glass => {
            let (size, smooth) = ([1.2, random.between(0.2, 0.8), 1.0].map(|side| side * radius), once_in(random, 2));
            let (file, center) = (landscape(world, random).into(), [0.0, -0.2 * radius, 0.05 * radius].into());
            let size = size.into();
            let field =
                HeightField { file, size, center, smooth, material, transform, placements, camera_visible: true, name };
            Object::HeightField(Box::new(field))
        }
        0 if !glass => Object::Polygon(Box::new(Polygon {
            points: Corners(star(radius, random).into_iter().map(|[x, y]| [x, 0.6 * y, 0.8 * y]).collect()).into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        0..=2 => Object::Extrude(Box::new(Extrude {
            outline: Outline(plate(radius, random)).into(),
            depth: (random.between(0.1, 0.8) * radius).into(),
            curve,
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        3 | 8 => {
            let path = path(radius, random);
            let (points, curve, closed) = match curve {
                Curve::Linear => (path, TubeCurve::Linear, once_in(random, 2)),
                Curve::CatmullRom if once_in(random, 2) => (path, TubeCurve::CatmullRom, once_in(random, 2)),
                Curve::CatmullRom => (handles(&path), TubeCurve::Bezier, false),
            };
            Object::Tube(Box::new(Tube {
                points: PathPoints(points).into(),
                // A curve that bends tighter than its tube passes through itself, which glass shows.
                radius: Radii::All(0.12 * radius).into(),
                curve,
                closed,
                segments: segments.min(32).into(),
                material,
                transform,
                placements,
                camera_visible: true,
                name,
            }))
        }
        4 | 5 => Object::Arrow(Box::new(Arrow {
            from: [0.0, -0.6 * radius, 0.0].into(),
            to: [random.between(-0.5, 0.5) * radius, 0.6 * radius, 0.0].into(),
            radius: (random.between(0.05, 0.15) * radius).into(),
            head_radius: once_in(random, 2).then(|| (random.between(0.2, 0.4) * radius).into()),
            head_length: once_in(random, 2).then(|| (random.between(0.2, 0.8) * radius).into()),
            segments: segments.into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        _ => Object::Lathe(Box::new(Lathe {
            profile: Profile(profile(radius, random)).into(),
            curve,
            segments: segments.into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
    };
    world.desc.objects.push(object.into());
}

/// A picture of hills.
fn landscape(world: &mut World, random: &mut Random) -> PathBuf {
    let (x, y) = (random.between(1.0, 3.0), random.between(1.0, 3.0));
    let height = |u: f64, v: f64| DVec3::splat(0.5 + 0.25 * ((x * TAU * u).sin() + (y * TAU * v).cos()));
    let picture = Picture::from_fn(6 + random.below(20), 5 + random.below(20), height);
    // A few hundred pixels: the encoder has nothing to refuse.
    let bytes = picture.png().unwrap_or_default();
    world.file("heights", "png", bytes)
}

/// A body between two ends of the axis, or a ring about it.
fn profile(radius: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let mut wide = || random.between(0.2, 0.7) * radius;
    if wide() < 0.4 * radius {
        return vec![
            [0.0, -0.6 * radius],
            [wide(), -0.6 * radius],
            [0.5 * wide(), 0.1 * radius],
            [wide(), 0.5 * radius],
            [0.0, 0.6 * radius],
        ];
    }
    let (out, high) = (0.3 * wide(), 0.5 * wide());
    let first = [0.6 * radius + out, -high];
    vec![first, [0.6 * radius + out, high], [0.6 * radius - out, high], [0.6 * radius - out, -high], first]
}

/// A zigzag whose sides are longer than the elbows of a tube.
fn path(radius: f64, random: &mut Random) -> Vec<Vec3> {
    let across = random.between(0.3, 0.5) * radius;
    let corner = |k: usize| {
        let side = if k.is_multiple_of(2) { -across } else { across };
        [side, (0.3 * k as f64 - 0.45) * radius, 0.3 * if k < 2 { side } else { -side }]
    };
    (0..4).map(corner).collect()
}

/// A zigzag's Bezier curve: it is level at its points, and bends as wide as the zigzag.
fn handles(path: &[Vec3]) -> Vec<Vec3> {
    let mut points = vec![path[0]];
    for pair in path.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let rise = [0.0, 0.5 * (to[1] - from[1]), 0.0];
        points.extend([[0, 1, 2].map(|axis| from[axis] + rise[axis]), [0, 1, 2].map(|axis| to[axis] - rise[axis]), to]);
    }
    points
}

/// A star, or a polygon that is nearly regular.
fn star(radius: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let tips = 3 + random.below(5);
    let inner = random.between(0.3, 0.6) * radius;
    let corner = |k: usize| {
        let angle = std::f64::consts::PI * k as f64 / tips as f64;
        let r = if k.is_multiple_of(2) { 0.65 * radius } else { inner };
        [r * angle.cos(), r * angle.sin()]
    };
    (0..2 * tips).map(corner).collect()
}

/// A star, sometimes with a hole.
fn plate(radius: f64, random: &mut Random) -> Vec<Vec<[f64; 2]>> {
    let outer = star(radius, random);
    if once_in(random, 2) {
        return vec![outer];
    }
    let hole = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]].map(|p| p.map(|x| x * radius));
    vec![outer, hole.to_vec()]
}
