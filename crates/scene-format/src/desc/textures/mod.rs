//! Textures: one file each, with the texture's words, and one line in the registry below.

mod checkerboard;
mod color_ramp;
mod dots;
mod gradient;
mod image;
mod lines;
mod mapping;
mod marble;
mod mix;
mod multiply;
mod named;
mod nested;
mod noise;
mod number;
mod vertex_color;
mod voronoi;
mod wood;

pub use checkerboard::Checkerboard;
pub use color_ramp::{ColorRamp, RampInterpolation, Stop, Stops};
pub use dots::Dots;
pub use gradient::{Gradient, GradientAxis};
pub use image::{Texture, TextureChannel, TextureColorSpace, TextureFilter, TextureWrap};
pub use lines::{Lines, LinesAlong};
pub(crate) use mapping::MappingWords;
pub use mapping::{Mapping, Planar, SolidMapping, Spherical, Triplanar, Uv};
pub use marble::Marble;
pub use mix::Mix;
pub use multiply::Multiply;
pub use named::NamedTexture;
pub(crate) use nested::Nested;
pub use noise::{Noise, NoiseKind};
pub use number::Number;
pub use vertex_color::{VertexColor, VertexColorSpace};
pub use voronoi::{Voronoi, VoronoiFeature};
pub use wood::Wood;

use super::Color;
use crate::codes;
use crate::diagnostic::{Diagnostic, Spanned};
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_enum};
use std::sync::Arc;

/// A texture that is reckoned: of most kinds the colour at a point is mix(a, b, t), with t from 0 to 1 by the kind of
/// pattern.
pub trait Pattern {
    /// The colours and textures that it is made of, in the order of its fields: a and b.
    fn parts(&self) -> Vec<&Albedo>;

    /// From the surface's texture coordinates, or from points, to those that t depends on; `None`: it has no
    /// coordinates of its own.
    fn mapping(&self) -> Option<SolidMapping>;
}

macro_rules! textures {
    (
        $(#[doc = $image_doc:literal])+
        image $Image:ident;
        $( $(#[doc = $doc:literal])+ pattern $Name:ident; )*
    ) => {
        /// A colour, constant or by place.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Albedo {
            /// The same everywhere.
            Color(Spanned<Color>),
            $(#[doc = $image_doc])+
            $Image($Image),
            $( $(#[doc = $doc])+ $Name(Box<$Name>), )*
            /// One of the scene's `textures`, by its name.
            Named(Arc<NamedTexture>),
        }

        scene_enum! {
            /// A colour or a number that differs from place to place. Where a number is wanted (`exponent`,
            /// `roughness`, `weight`), the luminance counts, and pictures are read as numbers. `a` and `b` go from 0 to
            /// 1; in a texture that is written where a field takes larger numbers, as far as those.
            pub(crate) enum PatternWords, "texture" {
                $(#[doc = $image_doc])+
                $Image($Image);
                $( $(#[doc = $doc])+ $Name(Box<$Name>); )*
            }
        }

        impl Albedo {
            /// The pattern, if it is one.
            pub fn pattern(&self) -> Option<&dyn Pattern> {
                match self.resolved() {
                    Albedo::Color(_) | Albedo::$Image(_) | Albedo::Named(_) => None,
                    $( Albedo::$Name(pattern) => Some(&**pattern), )*
                }
            }

            fn of(words: PatternWords) -> Self {
                match words {
                    PatternWords::$Image(image) => Albedo::$Image(image),
                    $( PatternWords::$Name(pattern) => Albedo::$Name(pattern), )*
                }
            }

            fn as_form(&self, all: bool) -> Form {
                match self {
                    Albedo::Color(color) => color.form(all),
                    Albedo::$Image(image) => PatternWords::$Image(image.clone()).form(all),
                    $( Albedo::$Name(pattern) => PatternWords::$Name(pattern.clone()).form(all), )*
                    Albedo::Named(named) => Form::Text(named.name.value.to_string()),
                }
            }
        }
    };
}

textures! {
    /// A picture laid over a surface by `vt` on meshes and by longitude and latitude on spheres.
    image Texture;
    /// Squares, or cubes, of two colours: `a` where the sum of the coordinates' whole parts is even.
    pattern Checkerboard;
    /// Lines at whole coordinates: a grid, tiles with joints, stripes.
    pattern Lines;
    /// Round dots, one in the middle of each unit square.
    pattern Dots;
    /// From `a` where a coordinate is 0 to `b` where it is 1, and constant beyond.
    pattern Gradient;
    /// Clouds: Perlin's improved noise (2002), mixed from octaves. From `a` to `b` by t, with n the noise from -1 to 1,
    /// l the `lacunarity` and g the `gain`: t = 1/2 + n(p)/2 for `Perlin`, 1/2 + sum g^i n(l^i p) / (2 sum g^i) for
    /// `Fbm`, sum g^i |n(l^i p)| / sum g^i for `Turbulence`.
    pattern Noise;
    /// Rings round an axis, one a unit, bent by noise: from `a` to `b` by t = 1/2 - cos(2 pi (d + `distortion` n)) / 2,
    /// d the distance from the `axis` through the origin, n four octaves of noise from -1 to 1.
    pattern Wood;
    /// Veins across an axis, one a unit, bent by turbulence: from `a` to `b` by t = 1/2 - cos(2 pi (x + `distortion`
    /// n)) / 2, x the coordinate along the `axis`, n six octaves of turbulence from 0 to 1.
    pattern Marble;
    /// Cells about scattered points, one in each unit cube (Worley 1996): stones, scales, cracks.
    pattern Voronoi;
    /// Colours by the luminance of another texture.
    pattern ColorRamp;
    /// Between two colours or textures, by a number or a texture.
    pattern Mix;
    /// The product of two colours or textures, channel by channel.
    pattern Multiply;
    /// The colours that the vertices of a mesh have.
    pattern VertexColor;
}

impl Albedo {
    /// What its name stands for, where it is written as a name; else itself. Never [`Albedo::Named`].
    pub fn resolved(&self) -> &Albedo {
        let mut albedo = self;
        while let Albedo::Named(named) = albedo {
            albedo = &named.texture;
        }
        albedo
    }

    /// Its texture file's words, if it is a picture.
    pub fn image(&self) -> Option<&Texture> {
        match self.resolved() {
            Albedo::Texture(texture) => Some(texture),
            _ => None,
        }
    }

    /// All pictures in it.
    pub fn images(&self) -> Vec<&Texture> {
        let mut found = Vec::from_iter(self.image());
        for part in self.pattern().map_or_else(Vec::new, Pattern::parts) {
            found.extend(part.images());
        }
        found
    }

    /// Whether it, or a part of it, is the colours of vertices.
    pub fn reads_vertex_colors(&self) -> bool {
        matches!(self, Albedo::VertexColor(_))
            || self.pattern().is_some_and(|pattern| pattern.parts().iter().any(|part| part.reads_vertex_colors()))
    }

    /// Whether it goes by a surface's texture coordinates.
    pub fn wants_uv(&self) -> bool {
        let image = self.image().is_some_and(|image| image.mapping.by_uv().is_some());
        image
            || self.pattern().is_some_and(|pattern| {
                matches!(pattern.mapping(), Some(SolidMapping::Uv(_)))
                    || pattern.parts().iter().any(|part| part.wants_uv())
            })
    }

    /// Whether it is the same everywhere.
    pub fn is_color(&self) -> bool {
        matches!(self.resolved(), Albedo::Color(_))
    }
}

impl From<Color> for Albedo {
    fn from(color: Color) -> Self {
        Albedo::Color(color.into())
    }
}

impl Default for Albedo {
    fn default() -> Self {
        Albedo::Color([0.8; 3].into())
    }
}

/// Whether a name is that of a texture.
pub(crate) fn is_texture(name: &str) -> bool {
    PatternWords::DEF.variant(name).is_some()
}

/// Whether a name before brackets is other languages' for a colour.
pub(crate) fn is_color(name: &str) -> bool {
    ["rgb", "srgb", "color", "colour", "vec3", "float3", "hex"].iter().any(|known| name.eq_ignore_ascii_case(known))
}

impl Albedo {
    /// Reads a texture, within those that are being read.
    fn texture(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if let Some(message) = reader.textures.add(Nested::ONE) {
            reader.report(Diagnostic::error(codes::TOO_MUCH, item.head(), message).expected("fewer"));
            return None;
        }
        let before = reader.textures.enter(at);
        let words = PatternWords::read(reader, item, at);
        reader.textures.leave(before);
        words.map(Albedo::of)
    }
}

/// Whether what stands where a number is due is a texture, or the name of one; `None`: it is something else that was
/// reported.
fn is_written_as_texture(reader: &mut Reader<'_>, item: Item<'_, '_>) -> Option<bool> {
    match item.kind() {
        Kind::Text => Some(!item.text().starts_with(['#', '='])),
        Kind::Word if item.lexeme().starts_with(char::is_lowercase) => {
            let told = reader.name_without_quotes(item) || reader.texture_elsewhere(item, &PatternWords::DEF);
            (!told).then_some(false)
        }
        _ => Some(matches!(item.kind(), Kind::Struct | Kind::Map | Kind::Word) || item.name().is_some()),
    }
}

impl Words for Albedo {
    // Textures hold textures; a text that is no colour is the name of one.
    const TYPE: Type = Type::OneOf(&[Type::Color, Type::Later(|| PatternWords::TYPE)]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if item.kind() == Kind::Text && !item.text().starts_with(['#', '=']) {
            return reader.texture_by_name(item, at).map(Albedo::Named);
        }
        // `rgb(..)` and `red`: a colour, if not ours; `wood` may be a texture.
        let bare = item.kind() == Kind::Word && item.lexeme().starts_with(char::is_lowercase);
        if reader.name_without_quotes(item) || bare && reader.texture_elsewhere(item, &PatternWords::DEF) {
            return None;
        }
        if bare || item.name().is_some_and(|name| !is_texture(name) && is_color(name)) {
            return <Spanned<Color>>::read(reader, item, reader.textures.range(at)).map(Albedo::Color);
        }
        if matches!(item.kind(), Kind::Struct | Kind::Map) || item.name().is_some() || item.kind() == Kind::Word {
            return Albedo::texture(reader, item, at);
        }
        <Spanned<Color>>::read(reader, item, reader.textures.range(at)).map(Albedo::Color)
    }

    fn form(&self, all: bool) -> Form {
        self.as_form(all)
    }
}
