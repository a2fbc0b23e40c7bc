//! Where a texture lies on a surface, or in space.

use crate::desc::{PerAxis, Vec3};
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum, scene_struct};

/// Where a texture lies on a surface. Its size is that of a pointer, since nearly all textures lie as they are.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Mapping(Option<Box<MappingWords>>);

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

scene_struct! {
    /// Seen along a direction, as if a projector far away threw it on the object: from there it is upright, what faces
    /// away shows it mirrored, what runs along the direction shows it drawn out. It goes by the coordinates that the
    /// shape is written in, before its `transform` and `placements`, and needs no texture coordinates. To the right and
    /// upwards are those of a `Rectangle` with this normal: to the right is (0, 1, 0) x normal, or (1, 0, 0) where the
    /// normal is upright.
    pub struct Planar as "Planar", "a mapping by a plane" {
        /// Where its lower left corner is.
        origin: Vec3 = [0.0; 3] => Rule::point();
        /// The direction that it is seen from.
        normal: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// How far it goes to the right and upwards before it begins again, or one number for both.
        size: PerAxis<2> = PerAxis([1.0; 2]) => Rule::length("a length");
    }
}

scene_struct! {
    /// By longitude and latitude about a point, as a map lies on a globe: u goes round once and v is 0 at the lower
    /// pole and 1 at the upper one, as on a `Sphere`. It goes by the coordinates that the shape is written in, before
    /// its `transform` and `placements`, and needs no texture coordinates.
    pub struct Spherical as "Spherical", "a mapping by longitude and latitude" {
        /// The point in the middle.
        center: Vec3 = [0.0; 3] => Rule::point();
        /// The direction of the upper pole. Where it is upright u begins at -z and is 1/2 at +z.
        axis: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// So many times round and from pole to pole, or one number for both.
        scale: PerAxis<2> = PerAxis([1.0; 2]) => Rule::within("a factor", -1e6, 1e6);
    }
}

scene_struct! {
    /// Seen along x, along y and along z at once, each as much as the surface faces that way: no seams, no drawn out
    /// sides, no texture coordinates. It is three `Planar` mappings in one, of the normals (1, 0, 0), (0, 1, 0) and (0,
    /// 0, 1), mixed by |n|^(1 / `blend`) with n the normal in the coordinates that the shape is written in.
    pub struct Triplanar as "Triplanar", "a mapping from three sides" {
        /// So many times along a unit of length.
        scale: f64 = 1.0 => Rule::within("a factor", -1e6, 1e6);
        /// How softly one side goes over into the next: near 0 with a sharp edge.
        blend: f64 = 0.2 => Rule::within("a number", 0.01, 1.0);
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

impl Default for Planar {
    fn default() -> Self {
        Planar { origin: [0.0; 3], normal: [0.0, 1.0, 0.0].into(), size: PerAxis([1.0; 2]) }
    }
}

impl Default for Spherical {
    fn default() -> Self {
        Spherical { center: [0.0; 3], axis: [0.0, 1.0, 0.0].into(), scale: PerAxis([1.0; 2]) }
    }
}

impl Default for Triplanar {
    fn default() -> Self {
        Triplanar { scale: 1.0, blend: 0.2 }
    }
}

impl Mapping {
    /// R(rotation)(scale uv) + offset; the rotation in degrees, counter-clockwise where v points up.
    pub fn uv(scale: [f64; 2], rotation: f64, offset: [f64; 2]) -> Self {
        Uv { scale: PerAxis(scale), rotation, offset }.into()
    }

    /// By the surface's texture coordinates, if it is; `None` where it goes by points in space.
    pub fn by_uv(&self) -> Option<Uv> {
        match self.0.as_deref() {
            None => Some(Uv::default()),
            Some(MappingWords::Uv(uv)) => Some(uv.clone()),
            Some(_) => None,
        }
    }
}

scene_enum! {
    /// Where a texture lies on a surface.
    pub(crate) enum MappingWords, "mapping" {
        /// By the surface's texture coordinates: scaled, then turned, then moved.
        Uv(Uv);
        /// Seen along a direction.
        Planar(Box<Planar>);
        /// By longitude and latitude about a point.
        Spherical(Box<Spherical>);
        /// Seen along x, along y and along z at once.
        Triplanar(Triplanar);
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
        /// Seen along a direction.
        Planar(Box<Planar>);
        /// By longitude and latitude about a point.
        Spherical(Box<Spherical>);
        /// Seen along x, along y and along z at once.
        Triplanar(Triplanar);
    }
}

impl SolidMapping {
    /// By the object's coordinates as they are.
    pub fn object() -> Self {
        SolidMapping::Object { scale: PerAxis([1.0; 3]), offset: [0.0; 3] }
    }
}

impl From<Uv> for Mapping {
    fn from(uv: Uv) -> Self {
        Mapping((uv != Uv::default()).then(|| Box::new(MappingWords::Uv(uv))))
    }
}

impl From<Planar> for Mapping {
    fn from(planar: Planar) -> Self {
        Mapping(Some(Box::new(MappingWords::Planar(Box::new(planar)))))
    }
}

impl From<Spherical> for Mapping {
    fn from(spherical: Spherical) -> Self {
        Mapping(Some(Box::new(MappingWords::Spherical(Box::new(spherical)))))
    }
}

impl From<Triplanar> for Mapping {
    fn from(triplanar: Triplanar) -> Self {
        Mapping(Some(Box::new(MappingWords::Triplanar(triplanar))))
    }
}

impl From<Mapping> for SolidMapping {
    fn from(mapping: Mapping) -> Self {
        match mapping.0.map_or_else(|| MappingWords::Uv(Uv::default()), |words| *words) {
            MappingWords::Uv(uv) => SolidMapping::Uv(uv),
            MappingWords::Planar(planar) => SolidMapping::Planar(planar),
            MappingWords::Spherical(spherical) => SolidMapping::Spherical(spherical),
            MappingWords::Triplanar(triplanar) => SolidMapping::Triplanar(triplanar),
        }
    }
}

impl Words for Mapping {
    const TYPE: Type = MappingWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        Some(match MappingWords::read(reader, item, at)? {
            MappingWords::Uv(uv) => uv.into(),
            other => Mapping(Some(Box::new(other))),
        })
    }

    fn form(&self, all: bool) -> Form {
        match &self.0 {
            None => MappingWords::Uv(Uv::default()).form(all),
            Some(words) => words.form(all),
        }
    }
}
