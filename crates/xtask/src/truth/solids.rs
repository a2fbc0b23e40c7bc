//! Solids made of closed shapes.

use super::curved::steps;
use super::draw::{matt, once_in};
use super::meshes::Point;
use super::world::{World, inline};
use scene_format::desc::{
    Capsule, Cone, Cylinder, Difference, Intersection, Material, MaterialRef, Name, Object, Operands, PerAxis,
    Placements, Plane, RectBox, Sphere, Torus, Transform, Union,
};
use scene_format::diagnostic::Spanned;
use tracer_reference::Random;

/// Adds a solid within a sphere. All of it is of one material, which some of its shapes have written themselves.
pub fn shape(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    placed(world, center, radius, (material, None), random);
}

/// Adds a solid within a sphere that shines, whole or one of its shapes.
pub fn lamp(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    let made = if once_in(random, 2) { (material, None) } else { (matt(world, random), Some(material)) };
    placed(world, center, radius, made, random);
}

/// Adds a solid within a sphere; `last`: of its last shape, where that is another one.
fn placed(
    world: &mut World,
    center: Point,
    radius: f64,
    (material, last): (Material, Option<Material>),
    random: &mut Random,
) {
    let copied = once_in(random, 4);
    let middle = if copied { [0.0; 3] } else { center };
    let there = vec![Transform::Translate(center).into()];
    let placements = if copied { std::iter::once(there).collect() } else { Placements::One };
    let about = |mut steps: Vec<Spanned<Transform>>| {
        // The middle of a solid is the origin.
        for step in &mut steps {
            if let Transform::Scale { about, .. } | Transform::Rotate { about, .. } | Transform::Align { about, .. } =
                &mut step.value
            {
                *about = Some(Box::new(middle));
            }
        }
        steps.retain(|step| !matches!(step.value, Transform::FitTo { .. }));
        steps
    };
    let transform = if once_in(random, 2) { about(steps(middle, radius, random)) } else { Vec::new() };
    let mut solid = solid(middle, radius, &material, 2, random);
    *solid.material_mut() = inline(material);
    if let (Some(last), Some(operands)) = (last, solid.operands_mut())
        && let Some(shape) = operands.0.last_mut()
    {
        *shape.value.material_mut() = inline(last);
    }
    *solid.transform_mut() = transform;
    *solid.placements_mut() = placements;
    world.desc.objects.push(solid.into());
}

/// A solid about a point, of two or three shapes.
fn solid(middle: Point, radius: f64, material: &Material, depth: usize, random: &mut Random) -> Object {
    let count = 2 + random.below(2);
    let first = operand(middle, radius, material, depth, random);
    let mut objects = vec![first];
    objects.extend((1..count).map(|_| {
        let beside = [0, 1, 2].map(|k: usize| middle[k] + random.between(-0.3, 0.3) * radius);
        operand(beside, 0.7 * radius, material, depth, random)
    }));
    let kind = random.below(3);
    // What is behind a plane that passes near the middle.
    if kind > 0 && once_in(random, 4) {
        let point = [0, 1, 2].map(|k: usize| middle[k] + random.between(-0.3, 0.3) * radius);
        let normal = if once_in(random, 2) { random.direction().to_array() } else { [0.0, 1.0, 0.0] };
        objects.push(Object::Plane(Box::new(Plane {
            point: point.into(),
            normal: normal.into(),
            material: if once_in(random, 2) { inline(material.clone()) } else { MaterialRef::Default },
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        })));
    }
    let objects = Operands(objects.into_iter().map(Into::into).collect());
    let (transform, placements, name, own) = (Vec::new(), Placements::One, Name::default(), MaterialRef::Default);
    match kind {
        0 => {
            Object::Union(Box::new(Union { objects, material: own, transform, placements, camera_visible: true, name }))
        }
        1 => Object::Intersection(Box::new(Intersection {
            objects,
            material: own,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        _ => Object::Difference(Box::new(Difference {
            objects,
            material: own,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
    }
}

// Long: one arm for each shape, with its fields.
fn operand(middle: Point, radius: f64, material: &Material, depth: usize, random: &mut Random) -> Object {
    let axis = random.direction();
    let (long, wide) = (random.between(0.4, 0.7) * radius, random.between(0.3, 0.6) * radius);
    let [from, to] = [-long, long].map(|way| [0, 1, 2].map(|k: usize| middle[k] + way * axis[k]));
    let material_ref = if once_in(random, 3) { inline(material.clone()) } else { MaterialRef::Default };
    let transform = if once_in(random, 3) { steps(middle, radius, random) } else { Vec::new() };
    let (placements, name) = (Placements::One, Name::default());
    match random.below(if depth > 0 { 7 } else { 6 }) {
        0 => Object::Sphere(Box::new(Sphere {
            center: middle.into(),
            radius: (0.8 * radius).into(),
            material: material_ref,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        1 => Object::Box(Box::new(RectBox {
            center: middle.into(),
            size: PerAxis([0; 3].map(|_| random.between(0.5, 1.1) * radius)).into(),
            rounding: 0.0.into(),
            material: material_ref,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        2 => Object::Cylinder(Box::new(Cylinder {
            from: from.into(),
            to: to.into(),
            radius: wide.into(),
            caps: true,
            material: material_ref,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        3 => Object::Cone(Box::new(Cone {
            from: from.into(),
            to: to.into(),
            radius: wide.into(),
            tip_radius: if once_in(random, 2) { 0.5 * wide } else { 0.0 }.into(),
            caps: true,
            material: material_ref,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        5 => Object::Torus(Box::new(Torus {
            center: middle.into(),
            axis: axis.to_array().into(),
            radius: (0.5 * radius).into(),
            tube_radius: (0.5 * wide).into(),
            material: material_ref,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        4 => Object::Capsule(Box::new(Capsule {
            from: from.into(),
            to: to.into(),
            radius: (0.5 * wide).into(),
            material: material_ref,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        _ => solid(middle, radius, material, depth - 1, random),
    }
}
