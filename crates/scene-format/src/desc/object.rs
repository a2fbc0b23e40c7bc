//! Objects: what is to be seen.

use super::shapes::{
    Arrow, Capsule, Cone, Cylinder, Difference, Disk, Extrude, HeightField, Intersection, Lathe, Mesh, Operands,
    Placements, Plane, Polygon, RectBox, Rectangle, Sphere, Torus, Tube, Union,
};
use super::{Emissive, MaterialRef, Name, Transform, Vec3};
use crate::codes;
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::path::{dot, sub};
use crate::words::{Told, scene_enum};
use std::path::Path;
use std::sync::Arc;

/// What may be wrong with a shape.
pub trait Faulty {
    /// What is wrong with its numbers, each of which is in its range, as far as can be told without making it; `span`:
    /// where it stands.
    fn faults(&self, _span: Span) -> Vec<Diagnostic> {
        Vec::new()
    }
}

/// What is asked of a shape's words.
pub(crate) trait ShapeWords: Told + Faulty {
    /// What several of them are called where they are counted.
    const MANY: &'static str;

    /// The file that it is made of, if it is.
    fn named_file(&self) -> Option<&Spanned<Arc<Path>>> {
        None
    }

    /// Whether it reaches without end.
    fn is_endless(&self) -> bool {
        false
    }
}

/// The diagnostic of a shape that has a length between two ends and no length.
pub(crate) fn no_length(from: &Spanned<Vec3>, to: &Spanned<Vec3>, noun: &str, span: Span) -> Option<Diagnostic> {
    let way = sub(to.value, from.value);
    (dot(way, way) == 0.0).then(|| {
        let at = [to.span, from.span].into_iter().find(|at| *at != Span::NONE).unwrap_or(span);
        Diagnostic::error(codes::NO_EXTENT, at, format!("the {noun} has no length"))
            .expected("`from` and `to` at different points")
    })
}

/// The diagnostic of a thing without an end that is to shine, with its article.
pub fn cannot_shine(what: &str, at: Span) -> Diagnostic {
    Diagnostic::error(codes::NO_LIGHT, at, format!("{what} cannot shine"))
        .expected("`Emissive` on a shape that ends somewhere: light of all of a plane would have no end either")
        .hint("take a large `Rectangle` instead, or light from all directions: `background`")
}

/// The diagnostic of a solid, or of a part of one, with its article, that shines by an amount for the whole lamp.
pub fn no_power_of_solid(what: &str, emissive: &Emissive, object: Span) -> Option<Diagnostic> {
    let (name, other) = emissive.amount.value.of_whole()?;
    let span = emissive.amount.span;
    let message = format!("`{name}` is of a whole lamp, and of {what} nobody knows how much surface is left");
    let fault = Diagnostic::error(codes::NO_LIGHT, if span == Span::NONE { object } else { span }, message);
    Some(
        fault
            .expected(format!("`{other}`, which each point has"))
            .hint(format!("write `{other}` in place of `{name}`")),
    )
}

/// The choice between shapes, one line each, and what is the same for all of them.
macro_rules! shapes {
    ($( $(#[doc = $doc:literal])+ $Kind:ident(Box<$inner:ident>); )+) => {
        // Each in a box: a scene may have millions, and the largest would say how much room all of them take.
        scene_enum! {
            /// A thing in the scene.
            pub enum Object, "object" {
                $( $(#[doc = $doc])+ $Kind(Box<$inner>); )+
            }
        }

        $(
            impl From<$inner> for Object {
                fn from(shape: $inner) -> Self {
                    Object::$Kind(Box::new(shape))
                }
            }
        )+

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

            /// What it is called.
            pub fn name(&self) -> &Name {
                match self { $( Object::$Kind(shape) => &shape.name, )+ }
            }

            /// Whether the camera sees it.
            pub fn camera_visible(&self) -> bool {
                match self { $( Object::$Kind(shape) => shape.camera_visible, )+ }
            }

            /// Whether the camera sees it, to be changed.
            pub fn camera_visible_mut(&mut self) -> &mut bool {
                match self { $( Object::$Kind(shape) => &mut shape.camera_visible, )+ }
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

            /// What is wrong with its numbers: [`Faulty::faults`].
            pub fn faults(&self, span: Span) -> Vec<Diagnostic> {
                match self { $( Object::$Kind(shape) => shape.faults(span), )+ }
            }

            /// Whether it reaches without end: a plane does.
            pub fn is_endless(&self) -> bool {
                match self { $( Object::$Kind(shape) => shape.is_endless(), )+ }
            }

            /// The file that its shape is made of, if it is.
            pub fn file(&self) -> Option<&Spanned<Arc<Path>>> {
                match self { $( Object::$Kind(shape) => shape.named_file(), )+ }
            }
        }
    };
}

shapes! {
    /// A sphere.
    Sphere(Box<Sphere>);
    /// A plane without an end: a floor to the horizon, water.
    Plane(Box<Plane>);
    /// A flat rectangle: a wall, a table, a picture, a square lamp.
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
    /// A landscape from a picture of heights.
    HeightField(Box<HeightField>);
    /// A flat face with any number of corners.
    Polygon(Box<Polygon>);
    /// A triangle mesh from a file.
    Mesh(Box<Mesh>);
    /// Closed shapes put together to one body.
    Union(Box<Union>);
    /// What closed shapes have in common: of two balls a lens.
    Intersection(Box<Intersection>);
    /// The first of several closed shapes without the others: a wall with a window, a bowl.
    Difference(Box<Difference>);
}

impl Object {
    /// Whether it has the materials of its own file (`mtllib` of OBJ, those of glTF), if that has any.
    pub fn has_materials_of_file(&self) -> bool {
        let Object::Mesh(mesh) = self else { return false };
        let extension = mesh.file().and_then(|file| file.value.extension());
        let has =
            |extension: &std::ffi::OsStr| ["obj", "gltf", "glb"].iter().any(|of| extension.eq_ignore_ascii_case(of));
        mesh.material == MaterialRef::Default && extension.is_some_and(has)
    }

    /// The shapes that it is made of, where it is made of several.
    pub fn operands(&self) -> Option<&Operands> {
        match self {
            Object::Union(solid) => Some(&solid.objects),
            Object::Intersection(solid) => Some(&solid.objects),
            Object::Difference(solid) => Some(&solid.objects),
            _ => None,
        }
    }

    /// The shapes that it is made of, to be changed.
    pub fn operands_mut(&mut self) -> Option<&mut Operands> {
        match self {
            Object::Union(solid) => Some(&mut solid.objects),
            Object::Intersection(solid) => Some(&mut solid.objects),
            Object::Difference(solid) => Some(&mut solid.objects),
            _ => None,
        }
    }
}

/// Objects, each followed by what it is made of.
pub fn with_operands(objects: &[Spanned<Object>]) -> impl Iterator<Item = &Spanned<Object>> {
    let mut rest: Vec<&[Spanned<Object>]> = vec![objects];
    std::iter::from_fn(move || {
        loop {
            let list = rest.pop()?;
            let Some((first, others)) = list.split_first() else { continue };
            rest.push(others);
            rest.extend(first.value.operands().map(|operands| &operands.0[..]));
            return Some(first);
        }
    })
}
