//! Lights.

use super::{Color, LightGroup, Name, Vec3};
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum, scene_struct};

scene_enum! {
    /// A light.
    pub enum Light, "light" {
        /// A luminous sphere; it emits and does not reflect.
        SphereLight(SphereLight);
    }
}

impl Light {
    /// What it is called.
    pub fn name(&self) -> &Name {
        match self {
            Light::SphereLight(light) => &light.name,
        }
    }

    /// The group that it is of.
    pub fn group(&self) -> &LightGroup {
        match self {
            Light::SphereLight(light) => &light.group,
        }
    }

    /// Whether the camera sees it.
    pub fn camera_visible(&self) -> bool {
        match self {
            Light::SphereLight(light) => light.camera_visible,
        }
    }

    /// Its kind, as it is written.
    pub fn kind(&self) -> &'static str {
        match self {
            Light::SphereLight(_) => "SphereLight",
        }
    }
}

/// A luminous sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereLight {
    /// Centre.
    pub center: Spanned<Vec3>,
    /// Radius.
    pub radius: Spanned<f64>,
    /// How much light.
    pub emission: Spanned<Emission>,
    /// Whether the camera sees it.
    pub camera_visible: bool,
    /// What it is called.
    pub name: Name,
    /// The group that it is of.
    pub group: LightGroup,
}

/// How much light a luminous sphere gives, per channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Emission {
    /// Radiant intensity in W/sr: L = I / (pi r^2).
    Intensity(Color),
    /// Radiance in W/(sr m^2).
    Radiance(Color),
    /// Power in W: L = P / (4 pi^2 r^2).
    Power(Color),
}

scene_struct! {
    /// A luminous sphere; it emits and does not reflect. How much it emits is said by exactly one of `intensity`,
    /// `radiance` and `power`.
    pub(crate) struct SphereLightWords as "SphereLight", "a sphere light", exactly one of [intensity, radiance, power] {
        /// Centre.
        center: Spanned<Vec3> => Rule::point();
        /// Radius.
        radius: Spanned<f64> => Rule::length("a length");
        /// Radiant intensity: L = I / (pi r^2).
        intensity: Option<Spanned<Color>> = None => Rule::light("in W/sr");
        /// Radiance L of every point of the sphere.
        radiance: Option<Spanned<Color>> = None => Rule::light("in W/(sr m^2)");
        /// Power: L = P / (4 pi^2 r^2).
        power: Option<Spanned<Color>> = None => Rule::light("in W");
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still shines, and is seen
        /// in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set lights.NAME.radius=2` finds it where no other has this name.
        name: Name = Name::default();
        /// The group of lights that it is of: with `output.light_groups`, what each group brings to the picture is told
        /// apart. Several may have one.
        group: LightGroup = LightGroup::default();
    }
}

impl Words for SphereLight {
    const TYPE: Type = SphereLightWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let words = SphereLightWords::read(reader, item, at)?;
        let emission = match (words.intensity, words.radiance, words.power) {
            (Some(color), _, _) => Spanned { value: Emission::Intensity(color.value), span: color.span },
            (_, Some(color), _) => Spanned { value: Emission::Radiance(color.value), span: color.span },
            (_, _, Some(color)) => Spanned { value: Emission::Power(color.value), span: color.span },
            // None was written, or what was written could not be read: reported.
            _ => return None,
        };
        let SphereLightWords { center, radius, camera_visible, name, group, .. } = words;
        Some(SphereLight { center, radius, emission, camera_visible, name, group })
    }

    fn form(&self, _all: bool) -> Form {
        let mut words = SphereLightWords {
            center: self.center.clone(),
            radius: self.radius.clone(),
            intensity: None,
            radiance: None,
            power: None,
            camera_visible: self.camera_visible,
            name: self.name.clone(),
            group: self.group.clone(),
        };
        match self.emission.value {
            Emission::Intensity(color) => words.intensity = Some(color.into()),
            Emission::Radiance(color) => words.radiance = Some(color.into()),
            Emission::Power(color) => words.power = Some(color.into()),
        }
        // The two that are not written have no default to show: only one may be there.
        words.form(false)
    }
}
