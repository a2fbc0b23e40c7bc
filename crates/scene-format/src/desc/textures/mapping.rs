//! Where a texture lies on a surface.

use crate::desc::PerAxis;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum};

/// From a surface's texture coordinates to those of a texture: turned by `rotation` after they were scaled, then moved. Its size is that of a
/// pointer, since nearly all textures lie as they are.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Mapping(Option<Box<Uv>>);

#[derive(Clone, Debug, PartialEq)]
struct Uv {
    scale: [f64; 2],
    rotation: f64,
    offset: [f64; 2],
}

impl Mapping {
    /// R(rotation)(scale uv) + offset; the rotation in degrees, counter-clockwise where v points up.
    pub fn uv(scale: [f64; 2], rotation: f64, offset: [f64; 2]) -> Self {
        let uv = Uv { scale, rotation, offset };
        let plain = uv == Uv { scale: [1.0; 2], rotation: 0.0, offset: [0.0; 2] };
        Mapping((!plain).then(|| Box::new(uv)))
    }

    /// (scale, rotation, offset).
    pub fn parts(&self) -> ([f64; 2], f64, [f64; 2]) {
        self.0.as_ref().map_or(([1.0; 2], 0.0, [0.0; 2]), |uv| (uv.scale, uv.rotation, uv.offset))
    }

    /// Rows of the matrix (x, y, 1) from a surface's coordinates to the texture's.
    pub fn rows(&self) -> [[f64; 3]; 2] {
        let (scale, rotation, offset) = self.parts();
        let (sin, cos) = match rotation.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            degrees => (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())),
        };
        [[cos * scale[0], -sin * scale[1], offset[0]], [sin * scale[0], cos * scale[1], offset[1]]]
    }
}

scene_enum! {
    /// Where a texture lies on a surface.
    pub(crate) enum MappingWords, "mapping" {
        /// By the surface's texture coordinates: scaled, then turned, then moved.
        Uv as "a mapping by texture coordinates" {
            /// So many times along each side, or one number for both.
            scale: PerAxis<2> = PerAxis([1.0; 2]) => Rule::within("a factor", -1e6, 1e6);
            /// Angle, counter-clockwise where v points up.
            rotation: f64 = 0.0 => Rule::within("an angle", -1e9, 1e9).unit("in degrees");
            /// Added at last.
            offset: [f64; 2] = [0.0; 2] => Rule::within("two numbers", -1e6, 1e6);
        };
    }
}

impl Words for Mapping {
    const TYPE: Type = MappingWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let MappingWords::Uv { scale, rotation, offset } = MappingWords::read(reader, item, at)?;
        Some(Mapping::uv(scale.0, rotation, offset))
    }

    fn form(&self, all: bool) -> Form {
        let (scale, rotation, offset) = self.parts();
        MappingWords::Uv { scale: PerAxis(scale), rotation, offset }.form(all)
    }
}
