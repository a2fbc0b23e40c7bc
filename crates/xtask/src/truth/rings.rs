//! A lamp within something that is open above and round: what lies on its far inner side must not be seen through its
//! near one, and the floor around is dark.

use super::curved::{plane, steps};
use super::draw::{self, once_in};
use super::world::{World, inline};
use scene_format::desc::{Cone, Cylinder, Difference, MaterialRef, Name, Object, Operands, Placements, Torus};
use tracer_reference::Random;

/// A floor, on it a ring of one of four kinds, a lamp in its middle, and the camera above.
pub fn ring(world: &mut World, random: &mut Random) {
    let radius = random.between(0.6, 1.2);
    let height = random.between(0.3, 0.8) * radius;
    let ground = draw::matt(world, random);
    plane(world, [0.0; 3], [0.0, 1.0, 0.0], ground, random);
    let material = draw::matt(world, random);
    let mut round = round(radius, height, inline(material), random);
    if once_in(random, 3) {
        *round.transform_mut() = steps([0.0, 0.5 * height, 0.0], 2.0 * radius, random);
    }
    world.desc.objects.push(round.into());
    world.lamp([0.0, random.between(0.3, 0.6) * height, 0.0], 0.1 * radius, [random.between(20.0, 60.0); 3]);
    if once_in(random, 3) {
        let beside = draw::matt(world, random);
        world.sphere([1.9 * radius, 0.3, 0.2], 0.3, beside);
    }
    let eye = [random.between(-1.5, 1.5), random.between(4.0, 6.0), random.between(1.0, 3.0)];
    world.camera(eye, [0.0; 3], random.between(30.0, 50.0));
}

fn round(radius: f64, height: f64, material: MaterialRef, random: &mut Random) -> Object {
    let (transform, placements, name) = (Vec::new(), Placements::One, Name::default());
    match random.below(4) {
        0 => Object::from(Torus {
            center: [0.0, 0.5 * height, 0.0].into(),
            axis: [0.0, 1.0, 0.0].into(),
            radius: radius.into(),
            tube_radius: (0.5 * height).into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        }),
        1 => Object::from(Cone {
            from: [0.0; 3].into(),
            to: [0.0, height, 0.0].into(),
            radius: radius.into(),
            tip_radius: (random.between(0.6, 1.2) * radius).into(),
            caps: false,
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        }),
        2 => Object::from(Difference {
            objects: Operands(
                [(0.0, height, 1.2 * radius), (-1.0, 2.0 * height, radius)]
                    .map(|(from, to, radius)| cylinder([from, to], radius, true, MaterialRef::Default).into())
                    .into(),
            ),
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        }),
        _ => cylinder([0.0, height], radius, false, material),
    }
}

fn cylinder([from, to]: [f64; 2], radius: f64, caps: bool, material: MaterialRef) -> Object {
    Object::from(Cylinder {
        from: [0.0, from, 0.0].into(),
        to: [0.0, to, 0.0].into(),
        radius: radius.into(),
        caps,
        material,
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    })
}
