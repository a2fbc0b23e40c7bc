//! Solids by chance.

use super::Random;
use super::generated::{length, name, transforms, vector};
use scene_format::desc::{
    Amount, Capsule, Difference, Emissive, Intersection, LightGroup, Material, MaterialRef, Object, Operands,
    Placements, Sphere, Union,
};

/// None of its own, or one that shines by what each point has.
fn own_material(random: &mut Random) -> MaterialRef {
    if random.below(3) > 0 {
        return MaterialRef::Default;
    }
    let emissive = Emissive {
        amount: Amount::Radiance([length(random); 3]).into(),
        color: [1.0; 3].into(),
        two_sided: random.below(2) == 0,
        group: LightGroup::default(),
    };
    MaterialRef::Inline(Box::new(Material::Emissive(Box::new(emissive)).into()))
}

/// A solid of closed shapes, solids among them.
pub fn solid(random: &mut Random, placements: Placements, depth: usize) -> Object {
    let material = own_material(random);
    let count = 1 + random.below(3);
    let part = |random: &mut Random| {
        let material = own_material(random);
        match random.below(3) {
            0 if depth > 0 => solid(random, Placements::One, depth - 1),
            1 => Object::Capsule(Box::new(Capsule {
                from: [0.0; 3].into(),
                to: [1.0, length(random), 0.0].into(),
                radius: length(random).into(),
                material,
                transform: transforms(random),
                placements: Placements::One,
                camera_visible: true,
                name: name(random),
            })),
            _ => Object::Sphere(Box::new(Sphere {
                center: vector(random).into(),
                radius: length(random).into(),
                material,
                transform: transforms(random),
                placements: Placements::One,
                camera_visible: true,
                name: name(random),
            })),
        }
    };
    let objects = Operands((0..count).map(|_| part(random).into()).collect());
    let (transform, name) = (transforms(random), name(random));
    // One in another is seen with it.
    let camera_visible = depth < 2 || random.below(4) != 0;
    match random.below(3) {
        0 => Object::Union(Box::new(Union { objects, material, transform, placements, camera_visible, name })),
        1 => Object::Intersection(Box::new(Intersection {
            objects,
            material,
            transform,
            placements,
            camera_visible,
            name,
        })),
        _ => {
            Object::Difference(Box::new(Difference { objects, material, transform, placements, camera_visible, name }))
        }
    }
}
