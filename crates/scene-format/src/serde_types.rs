//! Which types are serde's: a scene, and every part of one that has words of its own.

use crate::desc::*;
use crate::diagnostic::Spanned;
use crate::form::{Entry, Form};
use crate::words::Words;
use crate::{deserialize, load, serialize, write};
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::marker::PhantomData;
use std::sync::Arc;

macro_rules! of_words {
    ($($ty:ty),+ $(,)?) => {$(
        impl Serialize for $ty {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serialize::words(self, serializer)
            }
        }

        impl<'de> Deserialize<'de> for $ty {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserialize::words(deserializer)
            }
        }
    )+};
}

of_words![
    Animation,
    Camera,
    Image,
    Render,
    Adaptive,
    Acceleration,
    Integrator,
    Reuse,
    Caustics,
    Indirect,
    Effects,
    PixelFilter,
    ThinLens,
    ToneMap,
    Output,
    Layer,
    Matte,
    Background,
    Environment,
    Light,
    SphereLight,
    Material,
    Diffuse,
    Mirror,
    Transparent,
    BlinnPhong,
    Conductor,
    Emissive,
    Metal,
    Albedo,
    Texture,
    TextureFilter,
    TextureWrap,
    TextureColorSpace,
    TextureChannel,
    Checkerboard,
    ColorRamp,
    Mix,
    Multiply,
    VertexColor,
    VertexColorSpace,
    Mapping,
    Object,
    Sphere,
    Plane,
    Rectangle,
    RectBox,
    Disk,
    Cylinder,
    Cone,
    Capsule,
    Lathe,
    Extrude,
    Polygon,
    Tube,
    Torus,
    Arrow,
    Curve,
    TubeCurve,
    Mesh,
    Union,
    Intersection,
    Difference,
    Instances,
    Shading,
    Placements,
    PlacementPattern,
    Transform,
    Name,
    PerAxis<2>,
    PerAxis<3>,
];

/// What it says, without what has its default; not where that was written, nor the folder that paths start from.
impl Serialize for SceneDesc {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        write::form(self, write::Defaults::Hidden).serialize(serializer)
    }
}

/// Defaults are filled in, and all is checked as in a file. Paths start from the current folder unless `base_dir` is
/// set; no file is looked at, so that what names others (`include`, `Include`) is refused.
impl<'de> Deserialize<'de> for SceneDesc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = deserialize::json(deserializer, Scene::TYPE)?;
        load::unseen(&text).map_err(|faults| D::Error::custom(deserialize::told(&faults)))
    }
}

impl<T: Serialize> Serialize for Spanned<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

/// The value, from nowhere.
impl<'de, T: Deserialize<'de>> Deserialize<'de> for Spanned<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Spanned::from)
    }
}

/// No material is nothing.
impl Serialize for MaterialRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serialize::words(self, serializer)
    }
}

impl<'de> Deserialize<'de> for MaterialRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserialize::optional(deserializer).map(Option::unwrap_or_default)
    }
}

/// A map of one name, as it stands among the materials of a scene.
impl Serialize for NamedMaterial {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entry = Entry::new(self.name.value.to_string(), self.material.form(false));
        Form::Map(vec![entry]).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for NamedMaterial {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (name, material) = deserializer.deserialize_map(OneNamed { of: PhantomData, what: "a material" })?;
        Ok(NamedMaterial { name, material })
    }
}

/// A map of one name, as it stands among the textures of a scene.
impl Serialize for NamedTexture {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entry = Entry::new(self.name.value.to_string(), self.texture.form(false));
        Form::Map(vec![entry]).serialize(serializer)
    }
}

/// What it names itself is not known here: that is refused.
impl<'de> Deserialize<'de> for NamedTexture {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (name, texture) = deserializer.deserialize_map(OneNamed { of: PhantomData, what: "a texture" })?;
        Ok(NamedTexture { name, texture })
    }
}

struct OneNamed<T> {
    of: PhantomData<T>,
    what: &'static str,
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for OneNamed<T> {
    type Value = (Spanned<Arc<str>>, T);

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "the name of {} with it", self.what)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let (name, value) = entries.next_entry::<String, T>()?.ok_or_else(|| A::Error::custom("there is no name"))?;
        if entries.next_key::<String>()?.is_some() {
            return Err(A::Error::custom("there is more than one name"));
        }
        Ok((Arc::<str>::from(name).into(), value))
    }
}
