//! Lights.

use super::amount::{amount_of, put_amount};
use super::{Amount, Color, LightGroup, Name, Radiometric, Vec3};
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

impl SphereLight {
    /// Its kind, and an example of it.
    pub(crate) const TOLD: (&'static str, &'static str) =
        ("SphereLight", "SphereLight(center: (0, 5, 0), radius: 0.5, radiance: 20)");
}

/// A luminous sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereLight {
    /// Centre.
    pub center: Spanned<Vec3>,
    /// Radius.
    pub radius: Spanned<f64>,
    /// How much light. Of an intensity L = I / (pi r^2), of a power L = P / (4 pi^2 r^2).
    pub amount: Spanned<Amount>,
    /// Its colour, as far as it differs from its luminance.
    pub color: Color,
    /// Whether the camera sees it.
    pub camera_visible: bool,
    /// What it is called.
    pub name: Name,
    /// The group that it is of.
    pub group: LightGroup,
}

impl SphereLight {
    /// How much light, per channel.
    pub fn radiometric(&self) -> Radiometric {
        self.amount.value.radiometric(self.color)
    }
}

scene_struct! {
    /// A luminous sphere; it emits and does not reflect. How much it emits is said by exactly one of `intensity`,
    /// `radiance` and `power`, or, as people see it, of `luminous_intensity`, `luminance` and `luminous_power`.
    pub(crate) struct SphereLightWords as "SphereLight", "a sphere light",
        exactly one of [intensity, radiance, luminous_intensity, luminance, luminous_power, power] {
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
        /// Luminous intensity: 683 times the luminance Y of an intensity in W/sr.
        luminous_intensity: Option<Spanned<f64>> = None => Rule::amount("a luminous intensity", "in cd");
        /// Luminance: 683 Y of a radiance.
        luminance: Option<Spanned<f64>> = None => Rule::amount("a luminance", "in cd/m^2");
        /// Luminous flux, as lamps are sold: 683 Y of a power. A bulb of 60 W in old times is one of 800 lm.
        luminous_power: Option<Spanned<f64>> = None => Rule::amount("a luminous flux", "in lm");
        /// The colour of the light. Only what it is beside its own luminance counts: the amount times color / Y(color).
        /// `"=blackbody(2700)"` is that of a bulb.
        color: Color = [1.0; 3] => Rule::light("");
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
        // None was written, or what was written could not be read: reported.
        let amount = amount_of!(words)?;
        let SphereLightWords { center, radius, color, camera_visible, name, group, .. } = words;
        Some(SphereLight { center, radius, amount, color, camera_visible, name, group })
    }

    fn form(&self, _all: bool) -> Form {
        let mut words = SphereLightWords {
            center: self.center.clone(),
            radius: self.radius.clone(),
            intensity: None,
            radiance: None,
            power: None,
            luminous_intensity: None,
            luminance: None,
            luminous_power: None,
            color: self.color,
            camera_visible: self.camera_visible,
            name: self.name.clone(),
            group: self.group.clone(),
        };
        put_amount!(self.amount.value, words);
        // Those that are not written have no default to show: only one may be there.
        words.form(false)
    }
}
