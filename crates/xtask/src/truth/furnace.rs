//! Things under an even sky and no lamp: passive as they are, nothing is brighter than the sky. The plain path tracer
//! and the reference may have the same fault, so this asks neither.

use super::draw::{self, one_of};
use super::world::{World, matt, mirror};
use scene_format::desc::{Background, Material};
use tracer_reference::Random;

/// Metals of all roughnesses, mirrors and matt things of all shapes, apart from each other, in white.
pub fn furnace(world: &mut World, random: &mut Random) {
    for k in 0..2 + random.below(6) {
        let place = [1.9 * (k % 3) as f64 - 1.9, 0.0, 1.9 * (k / 3) as f64 - 1.9];
        let (radius, material) = (random.between(0.3, 0.8), material(world, random));
        draw::thing(world, place, radius, material, random);
    }
    world.desc.background = Background::Color([1.0; 3]);
    let eye = [random.between(-3.0, 3.0), one_of(random, &[0.1, 1.0, 3.0]), random.between(3.0, 6.0)];
    world.camera(eye, [0.0; 3], random.between(30.0, 60.0));
}

fn material(world: &mut World, random: &mut Random) -> Material {
    match random.below(6) {
        0 => draw::metal(world, 0.0, 0.0, random),
        1 => mirror(),
        2 => matt(random.between(0.3, 1.0)),
        3 => draw::metal(world, 0.02, 0.15, random),
        _ => draw::metal(world, 0.02, 1.0, random),
    }
}
