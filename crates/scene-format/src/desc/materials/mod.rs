//! Materials: one file each, with the material's words, and one line each in the registry below.
//!
//! Nobody else has a `match` on kinds of material: what others want to know is asked of [`MaterialWords`].

mod blinn_phong;
mod conductor;
mod diffuse;
mod emissive;
mod mirror;
mod transparent;

pub use blinn_phong::BlinnPhong;
pub use conductor::{Conductor, Metal, Reflectance};
pub use diffuse::Diffuse;
pub use emissive::Emissive;
pub use mirror::Mirror;
pub use transparent::Transparent;

use super::{Albedo, Texture};
use crate::diagnostic::{Span, Spanned};
use crate::form::{Entry, Form};
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_kinds};
use std::sync::Arc;

/// A material with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// The name.
    pub name: Spanned<Arc<str>>,
    /// The material.
    pub material: Material,
}

/// What is asked of a material's words.
pub(crate) trait MaterialWords {
    /// What of it may differ from place to place.
    fn varying(&self) -> Vec<&Albedo> {
        Vec::new()
    }

    /// Whether light passes its surfaces: there may be something to be seen inside.
    fn transmits(&self) -> bool {
        false
    }

    /// How it shines, if it does.
    fn shines(&self) -> Option<&Emissive> {
        None
    }
}

// A box around the longer kinds: a file of millions of mirrors must not take many times its size.
scene_kinds! {
    /// How a surface scatters light.
    pub enum Material, "material", by MaterialWords {
        Diffuse(Diffuse);
        Mirror(Mirror);
        Transparent(Box<Transparent>);
        BlinnPhong(Box<BlinnPhong>);
        Conductor(Box<Conductor>);
        Emissive(Box<Emissive>);
    }
}

impl Material {
    /// What of it may differ from place to place.
    pub fn varying(&self) -> Vec<&Albedo> {
        self.words().varying()
    }

    /// Whether any of it is the colours of vertices.
    pub fn reads_vertex_colors(&self) -> bool {
        self.varying().into_iter().any(Albedo::reads_vertex_colors)
    }

    /// The pictures that it is read from.
    pub fn textures(&self) -> Vec<&Texture> {
        self.varying().into_iter().flat_map(Albedo::images).collect()
    }

    /// Whether light passes its surfaces.
    pub fn transmits(&self) -> bool {
        self.words().transmits()
    }

    /// How it shines, if it does.
    pub fn shines(&self) -> Option<&Emissive> {
        self.words().shines()
    }
}

impl Default for Material {
    fn default() -> Self {
        Material::Diffuse(Diffuse { albedo: Albedo::default() })
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
        Form::Map(self.iter().map(|named| Entry::new(named.name.value.to_string(), named.material.form(all))).collect())
    }
}
