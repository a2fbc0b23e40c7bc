//! Materials in linear RGB: one file each, one line each in the registry below, and their look-up tables.
//!
//! What a material is made of is told by its `Row`, what others want to know of it by its [`Traits`]: nobody else has a
//! `match` on kinds of material. How the lobes scatter over lanes stands in `engine/stages/materials`.

mod blinn_phong;
mod conductor;
mod diffuse;
mod emissive;
mod ggx;
mod mirror;
mod transparent;

pub use blinn_phong::BlinnPhong;
pub use conductor::ConductorTable;
pub use conductor::{Conductor, Fresnel};
pub use diffuse::Diffuse;
pub use emissive::Emissive;
pub use ggx::STEPS as GGX_STEPS;
pub use mirror::Mirror;
pub use transparent::Transparent;

use super::table::Table;

/// Glossy lobes cast caustics from this exponent on; what wider ones reflect is found by light samples.
pub const LEAST_EXPONENT: f32 = 50.0;

/// GGX casts caustics up to this alpha: as narrow as a Blinn-Phong lobe of that exponent, alpha^2 = 2 / (exponent + 2).
pub const NARROWEST_ALPHA: f32 = 0.196;

/// Lobes that are wider than this have fewer photons than mirrors.
const NARROW_ALPHA: f64 = 0.05;

/// How many photons a lobe of this alpha is worth, of those of a mirror: what a lobe reflects is found by light samples
/// so much the more seldom as its solid angle is small, which goes by alpha^2. So where lobes are so wide that they are
/// no casters any more, they have hardly been ones.
fn narrow(alpha: f64) -> f64 {
    (NARROW_ALPHA / alpha).powi(2).min(1.0)
}

/// Below this alpha a rough lobe is a specular one.
pub const LEAST_ALPHA: f64 = 1e-4;

/// A colour or a number, constant or from a texture. Of a number every channel is the number; of a texture that stands
/// for one the luminance counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Albedo {
    /// Linear RGB.
    Color([f64; 3]),
    /// Index into the scene's textures.
    Texture(u32),
    /// Index into the scene's patterns.
    Pattern(u32),
    /// Index into the scene's programs: textures made of others.
    Program(u32),
}

impl Albedo {
    /// A number.
    pub const fn number(number: f64) -> Self {
        Albedo::Color([number; 3])
    }

    /// Linear RGB, where it is the same everywhere.
    pub const fn constant(&self) -> Option<[f64; 3]> {
        match self {
            Albedo::Color(color) => Some(*color),
            Albedo::Texture(_) | Albedo::Pattern(_) | Albedo::Program(_) => None,
        }
    }

    /// The largest channel that it may have, of those from 0 to 1.
    fn largest(&self) -> f64 {
        match self {
            Albedo::Color(color) => color.iter().fold(0.0, |a, &b| a.max(b)),
            Albedo::Texture(_) | Albedo::Pattern(_) | Albedo::Program(_) => 1.0,
        }
    }
}

/// What lobes a material has, as pbrt's `BxdfFlags`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BxdfFlags(u32);

impl BxdfFlags {
    /// It scatters nothing.
    pub const NONE: Self = BxdfFlags(0);
    /// To the side that light comes from.
    pub const REFLECTION: Self = BxdfFlags(1);
    /// To the other side.
    pub const TRANSMISSION: Self = BxdfFlags(2);
    /// Alike in all directions.
    pub const DIFFUSE: Self = BxdfFlags(4);
    /// Mostly about one direction.
    pub const GLOSSY: Self = BxdfFlags(8);
    /// In one direction only: a Dirac delta.
    pub const SPECULAR: Self = BxdfFlags(16);

    /// Both together.
    pub const fn or(self, other: Self) -> Self {
        BxdfFlags(self.0 | other.0)
    }

    /// Whether all of these are there.
    pub const fn has(self, flags: Self) -> bool {
        self.0 & flags.0 == flags.0
    }
}

/// What others want to know of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traits {
    /// Its lobes.
    pub flags: BxdfFlags,
    /// Its colour without light: albedo, reflectance, transmittance; of what shines black.
    pub color: Albedo,
    /// The largest share of light that photons carry on, about; 0: it casts no caustics.
    pub casts: f64,
    /// How many photons that is worth, of those of a mirror: see [`narrow`].
    pub narrow: f64,
}

/// The lobes that the engine has, by their numbers in the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Lobe {
    /// albedo / pi.
    Lambert = 0,
    /// Specular reflection.
    Mirror = 1,
    /// Specular reflection and transmission. Parameters: index of refraction.
    Dielectric = 2,
    /// Lambert and the report's glossy lobe. Parameters: alpha, s.
    BlinnPhong = 3,
    /// Lambert and the energy-conserving glossy lobe. Parameters: alpha, s.
    BlinnPhongConserving = 4,
    /// None: it shines.
    Emitter = 5,
    /// Specular reflection by Fresnel's equations or the F82-tint model. Parameters: alpha, place in the table of
    /// conductors.
    SmoothConductor = 6,
    /// GGX with these. Parameters: as before.
    Conductor = 7,
}

/// A material's row in the tables.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its lobes.
    pub lobe: Lobe,
    /// Their colour.
    pub color: Albedo,
    /// What the lobe says: numbers. Of metals the first is alpha, or the texture of the roughness, and the second their
    /// place in the table.
    pub parameters: [Albedo; 2],
    /// A colour beside the first: the tint of metals.
    pub second: Albedo,
    /// Of what shines the share of its light that each point has.
    pub glow: Albedo,
}

impl Row {
    /// A lobe with nothing but a colour.
    fn new(lobe: Lobe, color: Albedo) -> Self {
        Row {
            lobe,
            color,
            parameters: [Albedo::number(0.0); 2],
            second: Albedo::number(1.0),
            glow: Albedo::number(1.0),
        }
    }
}

/// What a compiled material has to tell.
pub trait MaterialKind {
    /// Its row in the tables.
    fn row(&self) -> Row;

    /// What others want to know of it.
    fn traits(&self) -> Traits;

    /// Itself, if it is a conductor: the engine has a table of these.
    fn conductor(&self) -> Option<&Conductor> {
        None
    }
}

/// The registry: one line for each material.
macro_rules! materials {
    ($($Name:ident;)+) => {
        /// How a surface scatters light. The words are those of the scene language.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Material {
            $( #[doc = concat!("[`", stringify!($Name), "`].")] $Name($Name), )+
        }

        impl Material {
            fn kind(&self) -> &dyn MaterialKind {
                match self {$( Material::$Name(material) => material, )+}
            }
        }
    };
}

materials! {
    Diffuse;
    Mirror;
    Transparent;
    BlinnPhong;
    Conductor;
    Emissive;
}

impl Material {
    /// What others want to know of it.
    pub fn traits(&self) -> Traits {
        self.kind().traits()
    }
}

/// Materials as look-up tables, index = material; the last entry is the emitters' (black).
pub struct MaterialTable {
    /// The colour; the bits of one of [`Lobe`], and of texture + 1, or 0; patterns are numbered behind the textures,
    /// programs behind them.
    pub rows: Table<5>,
    /// What the lobe says.
    pub parameters: Table<2>,
    /// The conductors', if there are any.
    pub conductors: Option<ConductorTable>,
    /// Which lobes occur, one bit each: a stage skips what no material asks for.
    lobes: u32,
    /// Of each material the numbers of the textures, as in `rows`, that its parameters and its second colour come from;
    /// `None` where all of these are constants.
    pub varying: Option<Table<3>>,
    /// Of each material the number of the texture, as in `rows`, that says how much of its light each point shines, or
    /// 0; empty where all that shines does so evenly.
    pub glow: Vec<u32>,
    /// Whether any material has a texture or a pattern.
    pub textured: bool,
    /// How many textures there are: numbers from here on are patterns'.
    pub first_pattern: u32,
    /// The emitters' entry.
    pub emitter: u32,
}

impl MaterialTable {
    /// Of the materials, in their order. `first_pattern`: how many textures there are, behind which patterns are
    /// numbered; `first_program`: how many both are, behind which programs are.
    pub fn new(materials: &[Material], first_pattern: u32, first_program: u32) -> Self {
        let mut rows: Vec<Row> = materials.iter().map(|material| material.kind().row()).collect();
        let conductors =
            || materials.iter().enumerate().filter_map(|(k, material)| Some((k, material.kind().conductor()?)));
        let mut place = 0;
        for (k, conductor) in conductors() {
            rows[k].parameters[1] = Albedo::number(f64::from(place));
            place += conductor.rows() as u32;
        }
        let emitter = rows.len() as u32;
        rows.push(Emissive::EVEN.row());
        let texture = |value: &Albedo| match *value {
            Albedo::Color(_) => 0,
            Albedo::Texture(t) => t + 1,
            Albedo::Pattern(p) => first_pattern + p + 1,
            Albedo::Program(p) => first_program + p + 1,
        };
        let number = |value: Albedo| value.constant().unwrap_or([0.0; 3])[0] as f32;
        let others = |row: &Row| [row.parameters[0], row.parameters[1], row.second];
        let varies = rows.iter().flat_map(others).any(|value| texture(&value) != 0);
        let glow: Vec<u32> = rows.iter().map(|row| texture(&row.glow)).collect();
        let glows = glow.iter().any(|&number| number != 0);
        MaterialTable {
            rows: Table::new(rows.iter().map(|row| {
                let [r, g, b] = row.color.constant().unwrap_or([1.0; 3]).map(|x| x as f32);
                [r, g, b, f32::from_bits(row.lobe as u32), f32::from_bits(texture(&row.color))]
            })),
            parameters: Table::new(rows.iter().map(|row| row.parameters.map(number))),
            varying: varies
                .then(|| Table::new(rows.iter().map(|row| others(row).map(|of| f32::from_bits(texture(&of)))))),
            conductors: ConductorTable::new(conductors().map(|(_, conductor)| conductor)),
            lobes: rows.iter().fold(0, |bits, row| bits | 1 << row.lobe as u32),
            glow: if glows { glow } else { Vec::new() },
            textured: varies || glows || rows.iter().any(|row| texture(&row.color) != 0),
            first_pattern,
            emitter,
        }
    }

    /// Whether any material has these lobes.
    #[inline(always)]
    pub fn has(&self, lobe: Lobe) -> bool {
        self.lobes >> lobe as u32 & 1 == 1
    }
}
