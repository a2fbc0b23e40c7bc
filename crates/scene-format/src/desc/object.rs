//! Objects: what is to be seen.

use super::shapes::{Mesh, Placements, RectBox, Rectangle, Sphere};
use super::{MaterialRef, Transform};
use crate::diagnostic::Spanned;
use crate::words::scene_enum;

scene_enum! {
    /// A thing in the scene.
    pub enum Object, "object" {
        /// A sphere.
        Sphere(Sphere);
        /// A flat rectangle: a floor, a wall, a picture, a square lamp.
        Rectangle(Box<Rectangle>);
        /// A box with right angles.
        Box(Box<RectBox>);
        /// A triangle mesh from a file.
        Mesh(Mesh);
    }
}

impl Object {
    /// Its material.
    pub fn material(&self) -> &MaterialRef {
        match self {
            Object::Sphere(sphere) => &sphere.material,
            Object::Rectangle(rectangle) => &rectangle.material,
            Object::Box(cuboid) => &cuboid.material,
            Object::Mesh(mesh) => &mesh.material,
        }
    }

    /// Its material, to be changed.
    pub fn material_mut(&mut self) -> &mut MaterialRef {
        match self {
            Object::Sphere(sphere) => &mut sphere.material,
            Object::Rectangle(rectangle) => &mut rectangle.material,
            Object::Box(cuboid) => &mut cuboid.material,
            Object::Mesh(mesh) => &mut mesh.material,
        }
    }

    /// Its transforms, first to last; `None` where it has no such field.
    pub fn transform(&self) -> Option<&[Spanned<Transform>]> {
        match self {
            Object::Sphere(_) => None,
            Object::Rectangle(rectangle) => Some(&rectangle.transform),
            Object::Box(cuboid) => Some(&cuboid.transform),
            Object::Mesh(mesh) => Some(&mesh.transform),
        }
    }

    /// Where its copies are; `None` where it has no such field.
    pub fn placements(&self) -> Option<&Placements> {
        match self {
            Object::Sphere(_) => None,
            Object::Rectangle(rectangle) => Some(&rectangle.placements),
            Object::Box(cuboid) => Some(&cuboid.placements),
            Object::Mesh(mesh) => Some(&mesh.placements),
        }
    }
}
