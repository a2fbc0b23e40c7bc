//! Objects: what is to be seen.

use super::shapes::{
    Arrow, Capsule, Cone, Cylinder, Disk, Extrude, Lathe, Mesh, Placements, Polygon, RectBox, Rectangle, Sphere, Torus,
    Tube,
};
use super::{MaterialRef, Transform};
use crate::diagnostic::Spanned;
use crate::words::{Told, scene_enum};
use std::path::Path;
use std::sync::Arc;

/// What is asked of a shape's words.
pub(crate) trait ShapeWords: Told {
    /// What several of them are called where they are counted.
    const MANY: &'static str;

    /// The file that it is made of, if it is.
    fn named_file(&self) -> Option<&Spanned<Arc<Path>>> {
        None
    }
}

impl<T: ShapeWords> ShapeWords for Box<T> {
    const MANY: &'static str = T::MANY;

    fn named_file(&self) -> Option<&Spanned<Arc<Path>>> {
        T::named_file(self)
    }
}

/// The choice between shapes, one line each, and what is the same for all of them.
macro_rules! shapes {
    ($( $(#[doc = $doc:literal])+ $Kind:ident($inner:ty); )+) => {
        scene_enum! {
            /// A thing in the scene.
            pub enum Object, "object" {
                $( $(#[doc = $doc])+ $Kind($inner); )+
            }
        }

        impl Object {
            /// By kind: names of other programs, an example.
            pub(crate) const TOLD: &[(&str, &[&str], &str)] =
                &[$((stringify!($Kind), <$inner as Told>::ALSO, <$inner as Told>::EXAMPLE),)+];

            /// The kinds, and what several of each are called.
            pub const KINDS: &[(&str, &str)] = &[$((stringify!($Kind), <$inner as ShapeWords>::MANY),)+];

            /// Its kind, as it is written.
            pub fn kind(&self) -> &'static str {
                match self { $( Object::$Kind(_) => stringify!($Kind), )+ }
            }

            /// Its material.
            pub fn material(&self) -> &MaterialRef {
                match self { $( Object::$Kind(shape) => &shape.material, )+ }
            }

            /// Its material, to be changed.
            pub fn material_mut(&mut self) -> &mut MaterialRef {
                match self { $( Object::$Kind(shape) => &mut shape.material, )+ }
            }

            /// Its transforms, first to last.
            pub fn transform(&self) -> &[Spanned<Transform>] {
                match self { $( Object::$Kind(shape) => &shape.transform, )+ }
            }

            /// Its transforms, to be changed.
            pub fn transform_mut(&mut self) -> &mut Vec<Spanned<Transform>> {
                match self { $( Object::$Kind(shape) => &mut shape.transform, )+ }
            }

            /// Where its copies are.
            pub fn placements(&self) -> &Placements {
                match self { $( Object::$Kind(shape) => &shape.placements, )+ }
            }

            /// Where its copies are, to be changed.
            pub fn placements_mut(&mut self) -> &mut Placements {
                match self { $( Object::$Kind(shape) => &mut shape.placements, )+ }
            }

            /// The file that its shape is made of, if it is.
            pub fn file(&self) -> Option<&Spanned<Arc<Path>>> {
                match self { $( Object::$Kind(shape) => ShapeWords::named_file(shape), )+ }
            }
        }
    };
}

shapes! {
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
    /// What a profile passes over as it turns about an axis: a vase, a glass.
    Lathe(Box<Lathe>);
    /// An outline that is pushed along z: a letter, a star, a plate with holes.
    Extrude(Box<Extrude>);
    /// What a ball passes over along a path: a cable, a spring, a knot.
    Tube(Box<Tube>);
    /// A ring with a round section.
    Torus(Box<Torus>);
    /// A round shaft with a cone at its tip.
    Arrow(Box<Arrow>);
    /// A flat face with any number of corners.
    Polygon(Box<Polygon>);
    /// A triangle mesh from a file.
    Mesh(Mesh);
}
