//! The steps of an object's way into the scene.

use super::Vec3;
use super::fit_to::FitTo;
use super::matrix::Rows;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum};

/// One step of an object's way into the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Transform {
    /// Moves by a vector.
    Translate(Vec3),
    /// Scales per axis.
    Scale {
        /// Factor per axis; negative mirrors.
        factor: Vec3,
        /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices).
        about: Option<Box<Vec3>>,
    },
    /// Rotates by the right-hand rule.
    Rotate {
        /// Axis of rotation (any length but zero).
        axis: Vec3,
        /// Angle in degrees.
        degrees: f64,
        /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices).
        about: Option<Box<Vec3>>,
    },
    /// Moves along y so that the lowest point lies at this height.
    DropTo {
        /// Height of the lowest point.
        y: f64,
    },
    /// Moves so that the middle of its bounds in the world lies at this point.
    CenterTo {
        /// Where the middle is then.
        point: Vec3,
    },
    /// An affine map.
    Matrix {
        /// What becomes of x, y and z: three factors, and how far it moves.
        rows: Box<[[f64; 4]; 3]>,
    },
    /// The least rotation that takes one direction to another.
    Align {
        /// The one (any length but zero).
        from: Box<Vec3>,
        /// The other.
        to: Box<Vec3>,
        /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices).
        about: Option<Box<Vec3>>,
    },
    /// Scales by one factor to an extent.
    FitTo {
        /// Which one.
        extent: Extent,
        /// How long it is then.
        length: f64,
        /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices).
        about: Option<Box<Vec3>>,
    },
}

impl Transform {
    /// Whether it asks how far what it moves reaches in the world.
    pub fn asks_for_reach(&self) -> bool {
        match self {
            Transform::DropTo { .. } | Transform::CenterTo { .. } | Transform::FitTo { .. } => true,
            Transform::Translate(_)
            | Transform::Scale { .. }
            | Transform::Rotate { .. }
            | Transform::Matrix { .. }
            | Transform::Align { .. } => false,
        }
    }
}

/// An extent in the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Along y.
    Height,
    /// Along x.
    Width,
    /// Along z.
    Depth,
    /// The largest of the three.
    Size,
}

scene_enum! {
    /// One step of an object's way into the scene.
    pub(crate) enum TransformWords, "transform" {
        /// Moves by a vector.
        Translate(Vec3) => Rule::within("a vector", -1e12, 1e12).unit("in the scene's unit");
        /// Scales; `Scale(2)` is short for `Scale(factor: 2)`.
        Scale as "a scaling" bare factor {
            /// One factor, or one per axis; negative ones mirror.
            factor: Factor => Rule::within("a factor", -1e9, 1e9);
            /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the
            /// origin.
            about: Option<Vec3> = None => Rule::point();
        };
        /// Rotates by the right-hand rule.
        Rotate as "a rotation" {
            /// Axis of rotation (any length but zero).
            axis: Vec3 => Rule::direction();
            /// Angle in degrees.
            degrees: f64 => Rule::within("an angle", -1e9, 1e9).unit("in degrees");
            /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the
            /// origin.
            about: Option<Vec3> = None => Rule::point();
        };
        /// Moves along y so that the lowest point lies at this height.
        DropTo as "a drop" bare y {
            /// Height of the lowest point.
            y: f64 => Rule::within("a height", -1e12, 1e12).unit("in the scene's unit");
        };
        /// Moves so that the middle of its bounds lies at this point: half way between the lowest and the highest that
        /// it reaches along x, y and z of the world. Meshes of CAD and of scans lie far from the origin:
        /// `FitTo(size: 2)`, `CenterTo((0, 0, 0))` and `DropTo(0)` set any of them in the middle of the floor.
        CenterTo as "a centring" bare point {
            /// Where the middle of its bounds is then.
            point: Vec3 => Rule::point();
        };
        /// An affine map, about the origin: the point (px, py, pz) comes to a px + b py + c pz + x, and so on. It may
        /// turn, scale, mirror, shear and move. Blender's `matrix_world` and Mitsuba's `to_world` have these rows and a
        /// fourth, which is left out; glTF and pbrt list columns. Worlds of POV-Ray and pbrt are mirrored: there the
        /// signs of x's row and then of x's column change.
        Matrix as "a matrix" {
            /// Three rows of four numbers: three factors, and how far it moves.
            rows: Rows => Rule::within("three rows of four numbers", -1e12, 1e12);
        };
        /// Turns by the least rotation that takes one direction to another. Where they are opposite it is half a turn
        /// about what is right on a `Rectangle` whose normal is `from`: x for (0, 1, 0).
        Align as "an alignment" {
            /// The direction that is turned (any length but zero).
            from: Vec3 = [0.0, 1.0, 0.0] => Rule::direction();
            /// The direction that it is turned to.
            to: Vec3 => Rule::direction();
            /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the
            /// origin.
            about: Option<Vec3> = None => Rule::point();
        };
        /// Scales by one factor so that the object has this extent along one axis of the world, or as its largest.
        FitTo(FitTo);
    }
}

/// A factor per axis, written as three numbers or as one for all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Factor(pub Vec3);

impl Words for Factor {
    const TYPE: Type = Type::OneOf(&[Type::Number, Type::Vector]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.factor(item, at).map(Factor)
    }

    fn form(&self, _all: bool) -> Form {
        let [x, y, z] = self.0;
        if x == y && y == z { Form::Number(x) } else { Form::vector(self.0) }
    }
}

impl Words for Transform {
    const TYPE: Type = TransformWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if reader.transform_elsewhere(item) {
            return None;
        }
        TransformWords::read(reader, item, at).map(|words| match words {
            TransformWords::Translate(by) => Transform::Translate(by),
            TransformWords::Scale { factor, about } => {
                Transform::Scale { factor: factor.0, about: about.map(Box::new) }
            }
            TransformWords::Rotate { axis, degrees, about } => {
                Transform::Rotate { axis, degrees, about: about.map(Box::new) }
            }
            TransformWords::DropTo { y } => Transform::DropTo { y },
            TransformWords::CenterTo { point } => Transform::CenterTo { point },
            TransformWords::Matrix { rows } => Transform::Matrix { rows: rows.0 },
            TransformWords::Align { from, to, about } => {
                Transform::Align { from: Box::new(from), to: Box::new(to), about: about.map(Box::new) }
            }
            TransformWords::FitTo(fit) => fit.step(),
        })
    }

    fn form(&self, all: bool) -> Form {
        let words = match self {
            Transform::Translate(by) => TransformWords::Translate(*by),
            Transform::Scale { factor, about } => {
                TransformWords::Scale { factor: Factor(*factor), about: about.as_deref().copied() }
            }
            Transform::Rotate { axis, degrees, about } => {
                TransformWords::Rotate { axis: *axis, degrees: *degrees, about: about.as_deref().copied() }
            }
            Transform::DropTo { y } => TransformWords::DropTo { y: *y },
            Transform::CenterTo { point } => TransformWords::CenterTo { point: *point },
            Transform::Matrix { rows } => TransformWords::Matrix { rows: Rows(rows.clone()) },
            Transform::Align { from, to, about } => {
                TransformWords::Align { from: **from, to: **to, about: about.as_deref().copied() }
            }
            Transform::FitTo { extent, length, about } => {
                let about = about.as_deref().copied();
                TransformWords::FitTo(FitTo { extent: *extent, length: *length, about })
            }
        };
        let mut form = words.form(all);
        // Scale(2) says the same as Scale(factor: 2).
        if let Form::Variant { name: "Scale", content: Some(content) } = &mut form
            && let Form::Struct { fields, .. } = &mut **content
            && fields.len() == 1
            && let Some(only) = fields.pop()
        {
            **content = only.value;
        }
        form
    }
}
