//! Objects: what is to be seen.

use super::shapes::{Capsule, Cone, Cylinder, Disk, Mesh, Placements, RectBox, Rectangle, Sphere};
use super::{MaterialRef, Transform};
use crate::diagnostic::Spanned;
use crate::words::scene_enum;

scene_enum! {
    /// A thing in the scene.
    pub enum Object, "object" {
        /// A sphere.
        Sphere(Box<Sphere>);
        /// A flat rectangle: a floor, a wall, a picture, a square lamp.
        Rectangle(Box<Rectangle>);
        /// A box with right angles.
        Box(Box<RectBox>);
        /// A flat disk, or a ring.
        Disk(Box<Disk>);
        /// A round cylinder, closed or open.
        Cylinder(Box<Cylinder>);
        /// A round cone or a part of one, closed or open.
        Cone(Box<Cone>);
        /// A cylinder with round ends.
        Capsule(Box<Capsule>);
        /// A triangle mesh from a file.
        Mesh(Mesh);
    }
}

/// What every shape has, whichever it is.
macro_rules! of_shape {
    ($object:expr, $shape:ident => $what:expr) => {
        match $object {
            Object::Sphere($shape) => $what,
            Object::Rectangle($shape) => $what,
            Object::Box($shape) => $what,
            Object::Disk($shape) => $what,
            Object::Cylinder($shape) => $what,
            Object::Cone($shape) => $what,
            Object::Capsule($shape) => $what,
            Object::Mesh($shape) => $what,
        }
    };
}

impl Object {
    /// Its material.
    pub fn material(&self) -> &MaterialRef {
        of_shape!(self, shape => &shape.material)
    }

    /// Its material, to be changed.
    pub fn material_mut(&mut self) -> &mut MaterialRef {
        of_shape!(self, shape => &mut shape.material)
    }

    /// Its transforms, first to last.
    pub fn transform(&self) -> &[Spanned<Transform>] {
        of_shape!(self, shape => &shape.transform)
    }

    /// Its transforms, to be changed.
    pub fn transform_mut(&mut self) -> &mut Vec<Spanned<Transform>> {
        of_shape!(self, shape => &mut shape.transform)
    }

    /// Where its copies are.
    pub fn placements(&self) -> &Placements {
        of_shape!(self, shape => &shape.placements)
    }

    /// Where its copies are, to be changed.
    pub fn placements_mut(&mut self) -> &mut Placements {
        of_shape!(self, shape => &mut shape.placements)
    }
}
