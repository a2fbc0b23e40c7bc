//! Materials in linear RGB, and their look-up tables.

use super::table::Table;

/// A colour, constant or from a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Albedo {
    /// Linear RGB.
    Color([f64; 3]),
    /// Index into the scene's textures.
    Texture(u32),
    /// Index into the scene's patterns.
    Pattern(u32),
}

/// How a surface scatters light. The words are those of the scene language.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// albedo / pi.
    Diffuse {
        /// Reflected share.
        albedo: Albedo,
    },
    /// A perfect mirror.
    Mirror {
        /// Reflected share, linear RGB.
        reflectance: [f64; 3],
    },
    /// A smooth dielectric.
    Transparent {
        /// Index of the inside against the outside.
        ior: f64,
        /// Share of refracted light that passes the surface, linear RGB.
        transmittance: [f64; 3],
    },
    /// albedo ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h), or with the glossy lobe of Ashikhmin and Shirley.
    BlinnPhong {
        /// Colour of both lobes.
        albedo: Albedo,
        /// alpha.
        exponent: f64,
        /// s.
        specular: f64,
        /// The glossy lobe is s (alpha + 1)/(8 pi (wo.h) max(cos i, cos o)) cos^alpha theta_h.
        energy_conserving: bool,
    },
    /// It shines, as the light of its surface says, and reflects nothing.
    Emissive,
}

/// Numbers of the kinds of material in the tables.
pub(crate) mod kind {
    pub const DIFFUSE: u32 = 0;
    pub const MIRROR: u32 = 1;
    pub const TRANSPARENT: u32 = 2;
    pub const BLINN_PHONG: u32 = 3;
    pub const BLINN_PHONG_CONSERVING: u32 = 4;
    pub const EMITTER: u32 = 5;
}

/// Materials as look-up tables, index = material; the last entry is the emitters' (black).
pub(crate) struct MaterialTable {
    /// Albedo, reflectance or transmittance; the bits of one of [`kind`], and of texture + 1, or 0.
    pub rows: Table<5>,
    /// Index of refraction, or alpha; s.
    pub parameters: Table<2>,
    /// Which kinds occur, one bit each: a stage skips what no material asks for.
    pub kinds: u32,
    /// Whether any material has a texture.
    pub textured: bool,
    /// How many pictures there are: texture numbers from here on are patterns'.
    pub first_pattern: u32,
    /// The emitters' entry.
    pub emitter: u32,
}

impl MaterialTable {
    /// `first_pattern`: how many pictures there are, behind which patterns are numbered.
    pub fn new(materials: &[Material], first_pattern: u32) -> Self {
        struct Row {
            kind: u32,
            color: [f64; 3],
            parameter: f64,
            specular: f64,
            texture: u32,
        }
        const EMITTER: Row = Row { kind: kind::EMITTER, color: [0.0; 3], parameter: 0.0, specular: 0.0, texture: 0 };
        let color = |albedo: Albedo| match albedo {
            Albedo::Color(c) => c,
            Albedo::Texture(_) | Albedo::Pattern(_) => [1.0; 3],
        };
        let texture = |albedo: Albedo| match albedo {
            Albedo::Color(_) => 0,
            Albedo::Texture(t) => t + 1,
            Albedo::Pattern(p) => first_pattern + p + 1,
        };
        let mut rows: Vec<Row> = materials
            .iter()
            .map(|m| match *m {
                Material::Diffuse { albedo } => Row {
                    kind: kind::DIFFUSE,
                    color: color(albedo),
                    parameter: 0.0,
                    specular: 0.0,
                    texture: texture(albedo),
                },
                Material::Mirror { reflectance } => {
                    Row { kind: kind::MIRROR, color: reflectance, parameter: 0.0, specular: 0.0, texture: 0 }
                }
                Material::Transparent { ior, transmittance } => {
                    Row { kind: kind::TRANSPARENT, color: transmittance, parameter: ior, specular: 0.0, texture: 0 }
                }
                Material::BlinnPhong { albedo, exponent, specular, energy_conserving } => Row {
                    kind: if energy_conserving { kind::BLINN_PHONG_CONSERVING } else { kind::BLINN_PHONG },
                    color: color(albedo),
                    parameter: exponent,
                    specular,
                    texture: texture(albedo),
                },
                Material::Emissive => EMITTER,
            })
            .collect();
        let emitter = rows.len() as u32;
        rows.push(EMITTER);
        MaterialTable {
            rows: Table::new(rows.iter().map(|row| {
                let [r, g, b] = row.color.map(|x| x as f32);
                [r, g, b, f32::from_bits(row.kind), f32::from_bits(row.texture)]
            })),
            parameters: Table::new(rows.iter().map(|r| [r.parameter as f32, r.specular as f32])),
            kinds: rows.iter().fold(0, |bits, r| bits | 1 << r.kind),
            textured: rows.iter().any(|r| r.texture != 0),
            first_pattern,
            emitter,
        }
    }
}
