//! Sizes that things are brought to.

use super::{Extent, Transform, Vec3};
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_struct};

scene_struct! {
    /// Scales by one factor so that the object has this extent along one axis of the world, or as its largest. What has
    /// no extent along that axis is an error.
    pub(crate) struct FitToWords as "FitTo", "a fit", exactly one of [height, width, depth, size] {
        /// Extent along y, from the lowest point to the highest.
        height: Written = Written(None) => Rule::length("a length");
        /// Extent along x.
        width: Written = Written(None) => Rule::length("a length");
        /// Extent along z.
        depth: Written = Written(None) => Rule::length("a length");
        /// The largest of the three.
        size: Written = Written(None) => Rule::length("a length");
        /// Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the
        /// origin.
        about: Option<Vec3> = None => Rule::point();
    }
}

/// An extent, where it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Written(Option<f64>);

impl Words for Written {
    const TYPE: Type = Type::Number;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        f64::read(reader, item, at).map(|length| Written(Some(length)))
    }

    fn form(&self, _all: bool) -> Form {
        self.0.map_or(Form::Absent, Form::Number)
    }
}

/// As it is written, and as it is described.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FitTo {
    pub extent: Extent,
    pub length: f64,
    pub about: Option<Vec3>,
}

impl FitTo {
    pub fn step(self) -> Transform {
        Transform::FitTo { extent: self.extent, length: self.length, about: self.about.map(Box::new) }
    }
}

impl Words for FitTo {
    const TYPE: Type = FitToWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let FitToWords { height, width, depth, size, about } = FitToWords::read(reader, item, at)?;
        let all = [(Extent::Height, height), (Extent::Width, width), (Extent::Depth, depth), (Extent::Size, size)];
        // None was written, or what was written could not be read: reported.
        let (extent, length) = all.into_iter().find_map(|(extent, length)| length.0.map(|length| (extent, length)))?;
        Some(FitTo { extent, length, about })
    }

    fn form(&self, all: bool) -> Form {
        let of = |extent: Extent| Written((self.extent == extent).then_some(self.length));
        let words = FitToWords {
            height: of(Extent::Height),
            width: of(Extent::Width),
            depth: of(Extent::Depth),
            size: of(Extent::Size),
            about: self.about,
        };
        words.form(all)
    }
}
