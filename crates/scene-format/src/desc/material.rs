//! Materials and textures.

use super::{Albedo, Color, Emissive, Texture};
use crate::diagnostic::{Span, Spanned};
use crate::form::{Entry, Form};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_enum};
use std::sync::Arc;

/// A material with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// The name.
    pub name: Spanned<Arc<str>>,
    /// The material.
    pub material: Material,
}

// What only the longer kinds have is in boxes: a file of millions of mirrors must not take many times its size.
scene_enum! {
    /// How a surface scatters light.
    pub enum Material, "material" {
        /// Lambert: albedo / pi.
        Diffuse as "a diffuse material" {
            /// Reflected share per channel.
            albedo: Albedo = Albedo::default() => Rule::share();
        };
        /// A perfect mirror.
        Mirror as "a mirror" {
            /// Reflected share per channel.
            reflectance: Spanned<Color> = [1.0; 3] => Rule::share();
        };
        /// A smooth dielectric: exact Fresnel reflection and refraction.
        Transparent as "a transparent material" {
            /// Index of refraction of the inside against the outside, below 1 where the inside is the thinner: an air
            /// bubble in water is 1/1.33 = 0.752, water within glass 1.33/1.5 = 0.887.
            ior: Spanned<f64> => Rule::within("an index of refraction", 0.01, 100.0);
            /// Share of refracted light that passes each surface, per channel.
            transmittance: Box<Spanned<Color>> = Spanned::from([1.0; 3]) => Rule::share();
        };
        /// Blinn-Phong: albedo * ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h).
        BlinnPhong as "a Blinn-Phong material" {
            /// Colour of both lobes.
            albedo: Box<Albedo> = Albedo::default() => Rule::share();
            /// alpha: 1 is dull, 100000 nearly a mirror.
            exponent: Box<Spanned<f64>> => Rule::within("a number", 0.0, 10_000_000.0);
            /// s: share of the glossy lobe, 0 to 1.
            specular: Box<Spanned<f64>> => Rule::within("a share", 0.0, 1.0);
            /// The glossy lobe after Ashikhmin and Shirley, that never reflects more than it gets.
            energy_conserving: bool = false;
        };
        /// A surface that shines and reflects nothing: any object with it is a light.
        Emissive(Box<Emissive>);
    }
}

impl Material {
    /// The picture that it takes its colour from.
    pub fn texture(&self) -> Option<&Texture> {
        self.albedo()?.image()
    }

    /// Its albedo, where it has one.
    pub fn albedo(&self) -> Option<&Albedo> {
        match self {
            Material::Diffuse { albedo } => Some(albedo),
            Material::BlinnPhong { albedo, .. } => Some(albedo),
            Material::Mirror { .. } | Material::Transparent { .. } | Material::Emissive(_) => None,
        }
    }
}

impl Default for Material {
    fn default() -> Self {
        Material::Diffuse { albedo: Albedo::default() }
    }
}

/// Which material an object has.
#[derive(Clone, Debug, Default)]
pub enum MaterialRef {
    /// None was written.
    #[default]
    Default,
    /// By name.
    Named {
        /// The name.
        name: Arc<str>,
        /// Where it stands.
        span: Span,
    },
    /// Written inline.
    Inline(Box<Spanned<Material>>),
}

/// Two are equal when they say the same, wherever they stand.
impl PartialEq for MaterialRef {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (MaterialRef::Default, MaterialRef::Default) => true,
            (MaterialRef::Named { name, .. }, MaterialRef::Named { name: other, .. }) => name == other,
            (MaterialRef::Inline(material), MaterialRef::Inline(other)) => material == other,
            _ => false,
        }
    }
}

impl Words for MaterialRef {
    const TYPE: Type = Type::OneOf(&[Type::Text, Material::TYPE]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let item = item.without_some();
        match item.kind() {
            Kind::Text => {
                if !reader.knows_material(&item.text()) && reader.material_elsewhere(item) {
                    return None;
                }
                let name = reader.material_name(item, at)?;
                Some(MaterialRef::Named { name, span: item.span() })
            }
            _ if reader.material_elsewhere(item) => None,
            Kind::Struct | Kind::Map | Kind::Tuple | Kind::Word => {
                let material = Material::read(reader, item, at)?;
                Some(MaterialRef::Inline(Box::new(Spanned { value: material, span: item.span() })))
            }
            _ => reader.wrong_type(item, at, "the name of a material, or a material written here"),
        }
    }

    fn form(&self, all: bool) -> Form {
        match self {
            MaterialRef::Default => Form::Absent,
            MaterialRef::Named { name, .. } => Form::Text((**name).to_owned()),
            MaterialRef::Inline(material) => material.form(all),
        }
    }
}

/// `{ "name": material }`
impl Words for Vec<NamedMaterial> {
    const TYPE: Type = Type::Map(&Material::TYPE);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        // They stay with the reader until all objects are read.
        reader.materials(item, at).map(|()| Vec::new())
    }

    fn form(&self, all: bool) -> Form {
        Form::Map(self.iter().map(|named| Entry::new(&*named.name.value, named.material.form(all))).collect())
    }
}
