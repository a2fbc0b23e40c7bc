//! Disks, cylinders, cones, capsules, tori and planes.

use super::draw::once_in;
use super::meshes::Point;
use super::world::{World, inline};
use scene_format::desc::{
    Capsule, Cone, Cylinder, Disk, Extent, Material, Name, Object, Placements, Plane, Torus, Transform,
};
use scene_format::diagnostic::Spanned;
use tracer_reference::Random;

/// Steps that turn a shape about its middle, and sometimes mirror, stretch or shear it. `size`: an extent that it may
/// have, whatever its form.
pub(super) fn steps(middle: Point, size: f64, random: &mut Random) -> Vec<Spanned<Transform>> {
    let axis = random.direction().to_array();
    let turn = Transform::Rotate { axis, degrees: random.between(0.0, 360.0), about: None };
    let about = once_in(random, 2).then(|| Box::new(middle));
    let more = match random.below(9) {
        0..=2 => Transform::Scale { factor: [1.0, random.between(0.4, 1.0), -1.0], about: None },
        3 => sheared(middle, random),
        4 => Transform::Align {
            from: Box::new(if once_in(random, 2) { [0.0, 1.0, 0.0] } else { random.direction().to_array() }),
            to: Box::new(random.direction().to_array()),
            about,
        },
        5 => Transform::FitTo { extent: Extent::Size, length: random.between(0.6, 1.0) * size, about },
        _ => return vec![turn.into()],
    };
    vec![turn.into(), more.into()]
}

/// A matrix that shears, and sometimes mirrors, with a fixed point, and makes nothing larger by more than a tenth.
pub(super) fn sheared(middle: Point, random: &mut Random) -> Transform {
    let mirrored = if once_in(random, 2) { -1.0 } else { 1.0 };
    let (shear, flat) = (random.between(-0.4, 0.4), random.between(0.5, 0.9));
    let linear = [[0.9, shear, 0.0], [0.0, flat, 0.0], [0.1 * shear, 0.0, 0.8 * mirrored]];
    let rows = [0, 1, 2].map(|k: usize| {
        let [a, b, c] = linear[k];
        [a, b, c, middle[k] - a * middle[0] - b * middle[1] - c * middle[2]]
    });
    Transform::Matrix { rows: Box::new(rows) }
}

/// Adds a curved shape within a sphere, written where it is or copied there. Glass is closed.
pub fn shape(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    let glass = matches!(material, Material::Transparent { .. });
    let copied = once_in(random, 4);
    let middle = if copied { [0.0; 3] } else { center };
    let axis = random.direction();
    let (long, wide) = (random.between(0.2, 0.8) * radius, random.between(0.2, 0.6) * radius);
    let [from, to] = [-long, long].map(|way| [0, 1, 2].map(|k: usize| middle[k] + way * axis[k]));
    let caps = glass || once_in(random, 2);
    let material = inline(material);
    let transform = if once_in(random, 2) { steps(middle, radius, random) } else { Vec::new() };
    let there = vec![Transform::Translate(center).into()];
    let placements = if copied { std::iter::once(there).collect() } else { Placements::One };
    let object = match random.below(6) {
        0 if !glass => Object::Disk(Box::new(Disk {
            center: middle.into(),
            normal: axis.to_array().into(),
            radius: radius.into(),
            inner_radius: if once_in(random, 2) { wide } else { 0.0 }.into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name: Name::default(),
        })),
        0 | 1 => Object::Cylinder(Box::new(Cylinder {
            from: from.into(),
            to: to.into(),
            radius: wide.into(),
            caps,
            material,
            transform,
            placements,
            camera_visible: true,
            name: Name::default(),
        })),
        2 => Object::Cone(Box::new(Cone {
            from: from.into(),
            to: to.into(),
            radius: wide.into(),
            tip_radius: if once_in(random, 2) { random.between(0.1, 0.5) * radius } else { 0.0 }.into(),
            caps,
            material,
            transform,
            placements,
            camera_visible: true,
            name: Name::default(),
        })),
        3 => Object::Torus(Box::new(Torus {
            center: middle.into(),
            axis: axis.to_array().into(),
            radius: (0.55 * radius).into(),
            tube_radius: (random.between(0.05, 0.5) * radius).into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name: Name::default(),
        })),
        _ => Object::Capsule(Box::new(Capsule {
            from: from.into(),
            to: to.into(),
            radius: (0.7 * wide).into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name: Name::default(),
        })),
    };
    world.desc.objects.push(object.into());
}

/// Adds a plane without an end through a point, written there or turned and moved to it. Its normal is along an axis.
pub fn plane(world: &mut World, point: Point, normal: Point, material: Material, random: &mut Random) {
    // Along the plane, to another point of it.
    let beside = || [0, 1, 2].map(|k: usize| if normal[k] == 0.0 { 3.0 } else { 0.0 });
    let moved: Point = [0, 1, 2].map(|k: usize| point[k] + beside()[k]);
    let (mut transform, mut placements) = (Vec::new(), Placements::One);
    let (mut written, mut facing) = (moved, normal);
    if once_in(random, 2) {
        facing = random.direction().to_array();
        let (from, to) = (Box::new(facing), Box::new(normal));
        transform.push(Transform::Align { from, to, about: Some(Box::new(moved)) }.into());
    }
    if once_in(random, 3) {
        written = [0.0; 3];
        transform.clear();
        facing = normal;
        let there = vec![Transform::Scale { factor: [2.0; 3], about: None }.into(), Transform::Translate(moved).into()];
        placements = std::iter::once(there).collect();
    }
    let (point, normal) = (written.into(), facing.into());
    let (material, name) = (inline(material), Name::default());
    let plane = Plane { point, normal, material, transform, placements, camera_visible: true, name };
    world.desc.objects.push(Object::Plane(Box::new(plane)).into());
}

/// Adds a closed cylinder that stands, or hangs where `height` is below 0, with one of its caps at the height of its
/// foot.
pub fn standing(world: &mut World, foot: Point, height: f64, radius: f64, material: Material) {
    world.desc.objects.push(
        Object::Cylinder(Box::new(Cylinder {
            from: foot.into(),
            to: [foot[0], foot[1] + height, foot[2]].into(),
            radius: radius.into(),
            caps: true,
            material: inline(material),
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        }))
        .into(),
    );
}

/// Adds a disk that lies flat.
pub fn lying(world: &mut World, center: Point, radius: f64, inner_radius: f64, material: Material) {
    world.desc.objects.push(
        Object::Disk(Box::new(Disk {
            center: center.into(),
            normal: [0.0, 1.0, 0.0].into(),
            radius: radius.into(),
            inner_radius: inner_radius.into(),
            material: inline(material),
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        }))
        .into(),
    );
}

/// Adds a sphere that is turned and copied, or an ellipsoid.
pub fn ball(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    world.sphere([0.0; 3], radius, material);
    if let Some(object) = world.desc.objects.last_mut() {
        let there = vec![Transform::Translate(center).into()];
        *object.value.transform_mut() = steps([0.0; 3], radius, random);
        *object.value.placements_mut() = std::iter::once(there).collect();
    }
}
