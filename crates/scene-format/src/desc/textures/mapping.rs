//! Where a texture lies on a surface, or in space.

use crate::desc::PerAxis;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum, scene_struct};

/// From a surface's texture coordinates to those of a texture: turned by `rotation` after they were scaled, then moved.
/// Its size is that of a pointer, since nearly all textures lie as they are.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Mapping(Option<Box<Uv>>);

scene_struct! {
    /// By the surface's texture coordinates: scaled, then turned, then moved.
    pub struct Uv as "Uv", "a mapping by texture coordinates" {
        /// So many times along each side, or one number for both.
        scale: PerAxis<2> = PerAxis([1.0; 2]) => Rule::within("a factor", -1e6, 1e6);
        /// Angle, counter-clockwise where v points up.
        rotation: f64 = 0.0 => Rule::within("an angle", -1e9, 1e9).unit("in degrees");
        /// Added at last.
        offset: [f64; 2] = [0.0; 2] => Rule::within("two numbers", -1e6, 1e6);
    }
}

impl Uv {
    /// Rows of the matrix (x, y, 1) from a surface's coordinates to the texture's: R(rotation)(scale uv) + offset.
    pub fn rows(&self) -> [[f64; 3]; 2] {
        let (scale, offset) = (self.scale.0, self.offset);
        let (sin, cos) = match self.rotation.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            degrees => (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())),
        };
        [[cos * scale[0], -sin * scale[1], offset[0]], [sin * scale[0], cos * scale[1], offset[1]]]
    }
}

impl Default for Uv {
    fn default() -> Self {
        Uv { scale: PerAxis([1.0; 2]), rotation: 0.0, offset: [0.0; 2] }
    }
}

impl Mapping {
    /// R(rotation)(scale uv) + offset; the rotation in degrees, counter-clockwise where v points up.
    pub fn uv(scale: [f64; 2], rotation: f64, offset: [f64; 2]) -> Self {
        let uv = Uv { scale: PerAxis(scale), rotation, offset };
        Mapping((uv != Uv::default()).then(|| Box::new(uv)))
    }

    /// What it says.
    pub fn words(&self) -> Uv {
        self.0.as_deref().cloned().unwrap_or_default()
    }

    /// Rows of the matrix (x, y, 1) from a surface's coordinates to the texture's.
    pub fn rows(&self) -> [[f64; 3]; 2] {
        self.words().rows()
    }
}

scene_enum! {
    /// Where a texture lies on a surface.
    pub(crate) enum MappingWords, "mapping" {
        /// By the surface's texture coordinates: scaled, then turned, then moved.
        Uv(Uv);
    }
}

scene_enum! {
    /// Where a texture lies on a surface, or in the space that surfaces are cut out of.
    pub enum SolidMapping, "mapping of a solid texture" {
        /// By the surface's texture coordinates: scaled, then turned, then moved.
        Uv(Uv);
        /// By the coordinates that the shape is written in, before its `transform` and `placements` and those of
        /// groups: the texture goes with the object, which is turned to turn it. A `center` other than the origin is
        /// such a coordinate, too.
        Object as "a mapping by an object's coordinates" {
            /// So many cells of the texture a unit along each axis, or one number for all.
            scale: PerAxis<3> = PerAxis([1.0; 3]) => Rule::within("a factor", -1e6, 1e6);
            /// Added at last.
            offset: [f64; 3] = [0.0; 3] => Rule::within("three numbers", -1e6, 1e6);
        };
        /// By the scene's coordinates, after all transforms: objects move through the texture, and those side by side
        /// share it.
        World as "a mapping by the scene's coordinates" {
            /// So many cells of the texture a unit along each axis, or one number for all.
            scale: PerAxis<3> = PerAxis([1.0; 3]) => Rule::within("a factor", -1e6, 1e6);
            /// Added at last.
            offset: [f64; 3] = [0.0; 3] => Rule::within("three numbers", -1e6, 1e6);
        };
    }
}

impl SolidMapping {
    /// By the object's coordinates as they are.
    pub fn object() -> Self {
        SolidMapping::Object { scale: PerAxis([1.0; 3]), offset: [0.0; 3] }
    }
}

impl From<Mapping> for SolidMapping {
    fn from(mapping: Mapping) -> Self {
        SolidMapping::Uv(mapping.words())
    }
}

impl Words for Mapping {
    const TYPE: Type = MappingWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let MappingWords::Uv(uv) = MappingWords::read(reader, item, at)?;
        Some(Mapping::uv(uv.scale.0, uv.rotation, uv.offset))
    }

    fn form(&self, all: bool) -> Form {
        MappingWords::Uv(self.words()).form(all)
    }
}
