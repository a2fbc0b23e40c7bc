//! Closed meshes of few triangles about the eye, smooth or not: no light comes in, however bright it is outside.

use super::draw::{self, once_in, one_of};
use super::meshes::Shape;
use super::world::{World, glass};
use scene_format::desc::Shading;
use tracer_reference::Random;

/// A ball or a ring of few triangles, the eye within, lamps and sky outside.
pub fn dark_shell(world: &mut World, random: &mut Random) {
    let size = draw::magnitude(random, 0.3, 3.0);
    let middle = [0; 3].map(|_| random.between(-5.0, 5.0));
    let (shape, eye) = if once_in(random, 3) {
        let (around, across) = (5 + random.below(8), 4 + random.below(5));
        // In the tube where its first cut is, which is the middle of a polygon.
        (Shape::ring(0.4, around, across), [size, 0.0, 0.0])
    } else {
        (Shape::ball(random.below(3) as u32), [0.0; 3])
    };
    let mut shape = shape.placed(size, middle);
    if once_in(random, 3) {
        // Squeezed, with normals that are not.
        let factor = random.between(0.4, 1.0);
        shape.positions.iter_mut().for_each(|p| p[1] = middle[1] + factor * (p[1] - middle[1]));
    }
    let material = match random.below(3) {
        0 => draw::shiny(world, 1.0, 500.0, random),
        _ => draw::matt(world, random),
    };
    world.mesh("shell", &shape, material);
    let shading = one_of(random, &[Shading::Auto, Shading::Smooth, Shading::Smooth, Shading::Flat]);
    draw::last_mesh(world, |mesh| mesh.shading = shading);
    for _ in 0..1 + random.below(3) {
        let (direction, away) = (random.direction(), size * random.between(2.0, 6.0));
        let at = [0, 1, 2].map(|k| middle[k] + away * direction[k]);
        draw::lamp(world, at, 0.3 * size, random);
    }
    world.desc.background = draw::background(world, random);
    let eye = [0, 1, 2].map(|k| middle[k] + eye[k]);
    if once_in(random, 2) {
        let thing = if once_in(random, 2) { glass(1.5) } else { draw::caster(world, random) };
        world.sphere([eye[0], eye[1], eye[2] - 0.1 * size], 0.05 * size, thing);
    }
    let towards = random.direction();
    world.camera(eye, [0, 1, 2].map(|k| eye[k] + towards[k]), random.between(40.0, 110.0));
}
