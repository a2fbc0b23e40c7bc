//! What light falls on: thin, small, folded and low-poly things, that methods which smooth over an area lose light on.

use super::draw;
use super::meshes::{Point, Shape};
use super::world::World;
use scene_format::desc::{Material, Shading, Transform};
use tracer_reference::Random;

/// A kind of receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receiver {
    /// Rods of a fortieth of their length.
    Rods,
    /// A grating.
    Slats,
    /// Blades of grass.
    Grass,
    /// A sheet with slopes of fifty degrees.
    Corrugated,
    /// A ball of few triangles with interpolated normals.
    LowPoly,
    /// Small balls.
    Pebbles,
    /// A plain slab: the control.
    Slab,
}

/// All of them.
pub const ALL: [Receiver; 7] = [
    Receiver::Rods,
    Receiver::Slats,
    Receiver::Grass,
    Receiver::Corrugated,
    Receiver::LowPoly,
    Receiver::Pebbles,
    Receiver::Slab,
];

impl Receiver {
    /// The mesh of it, about a unit wide to each side, upon y = 0; pebbles are spheres and have none.
    pub fn shape(self, random: &mut Random) -> Shape {
        match self {
            Receiver::Rods => Shape::rods(12, random.between(0.03, 0.1), random),
            Receiver::Slats => Shape::slats(random.between(0.03, 0.12)),
            Receiver::Grass => Shape::grass(400, random),
            Receiver::Corrugated => Shape::corrugated(random.between(40.0, 60.0), random.between(0.08, 0.25)),
            Receiver::LowPoly => Shape::ball(random.below(2) as u32).placed(0.5, [0.0, 0.5, 0.0]),
            Receiver::Slab => Shape::block([-1.0, 0.1, -1.0], [1.0, 0.2, 1.0]),
            Receiver::Pebbles => Shape::default(),
        }
    }

    /// Adds it to a scene, at this place on the floor.
    pub fn add(self, world: &mut World, scale: f64, at: Point, material: Material, random: &mut Random) {
        if self == Receiver::Pebbles {
            for _ in 0..24 {
                let radius = scale * random.between(0.03, 0.1);
                let [x, z] = [0; 2].map(|_| scale * random.between(-1.0, 1.0));
                world.sphere([at[0] + x, at[1] + radius, at[2] + z], radius, material.clone());
            }
            return;
        }
        let name = format!("{self:?}").to_lowercase();
        let shape = self.shape(random).placed(scale, at);
        world.mesh(&name, &shape, material);
    }

    /// The same, with what the language has for meshes besides: OFF files, shading, transforms that lead to the same
    /// place.
    pub fn add_somehow(self, world: &mut World, scale: f64, at: Point, random: &mut Random) {
        let material = draw::matt(world, random);
        let plain = random.below(2) == 0 || self == Receiver::Pebbles;
        if plain {
            return self.add(world, scale, at, material, random);
        }
        let shape = self.shape(random);
        let name = format!("{self:?}").to_lowercase();
        let file = match random.below(2) {
            0 => world.file(&name, "off", shape.off().into_bytes()),
            _ => world.file(&name, "obj", shape.obj().into_bytes()),
        };
        let turn = Transform::Rotate {
            axis: [0.0, 1.0, 0.0],
            degrees: random.between(0.0, 360.0),
            about: (random.below(2) == 0).then(|| Box::new([0.0; 3])),
        };
        let steps = vec![
            turn,
            Transform::Scale { factor: [scale; 3], about: Some(Box::new([0.0; 3])) },
            Transform::Translate(at),
            Transform::DropTo { y: at[1] + 0.01 },
        ];
        world.placed(file, material, steps);
        let shading = [Shading::Auto, Shading::Smooth, Shading::Flat][random.below(3)];
        // Smooth normals over folds and closed boxes are not what a person would write, but legal.
        draw::last_mesh(world, |mesh| mesh.shading = shading);
    }
}
