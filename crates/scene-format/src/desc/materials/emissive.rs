//! Surfaces that shine.

use super::MaterialWords;
use crate::codes;
use crate::desc::amount::{amount_of, put_amount};
use crate::desc::{Albedo, Amount, Color, LightGroup, Radiometric};
use crate::diagnostic::{Diagnostic, Spanned};
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct};

/// A surface that shines and reflects nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Emissive {
    /// How much light.
    pub amount: Spanned<Amount>,
    /// Its colour, as far as it differs from its luminance; or a texture: the share of the amount that each point has.
    pub color: Albedo,
    /// Whether it shines to both sides, not only outwards.
    pub two_sided: bool,
    /// The group of lights that what shines so is of.
    pub group: LightGroup,
}

scene_struct! {
    /// A surface that shines and reflects nothing: whatever shape has it is a light. How much it shines is said by
    /// exactly one of `radiance`, `power` and `intensity`, or, as people see it, of `luminance`, `luminous_power` and
    /// `luminous_intensity`.
    pub(crate) struct EmissiveWords as "Emissive", "an emissive material",
        exactly one of [radiance, intensity, luminance, luminous_intensity, luminous_power, power] {
        /// Radiance L of every point, in all directions.
        radiance: Option<Spanned<Color>> = None => Rule::light("in W/(sr m^2)");
        /// Power of each copy: L = P / (pi A), A the true area that shines (both sides where `two_sided`). Not of
        /// solids and their parts: nobody knows how much of their surface is left.
        power: Option<Spanned<Color>> = None => Rule::light("in W");
        /// Radiant intensity of each copy: of `Rectangle`, `Disk` and `Polygon` along the normal, L = I / A, A the area
        /// of one side; of `Sphere` L = 4 I / A, the mean over all directions where it was scaled unequally. Other
        /// shapes have none.
        intensity: Option<Spanned<Color>> = None => Rule::light("in W/sr");
        /// Luminance of every point: 683 times the luminance Y of a radiance.
        luminance: Option<Spanned<f64>> = None => Rule::amount("a luminance", "in cd/m^2");
        /// Luminous flux of each copy, as lamps are sold: 683 Y of a power.
        luminous_power: Option<Spanned<f64>> = None => Rule::amount("a luminous flux", "in lm");
        /// Luminous intensity of each copy: 683 Y of an intensity.
        luminous_intensity: Option<Spanned<f64>> = None => Rule::amount("a luminous intensity", "in cd");
        /// The colour of the light. Of a constant one only what it is beside its own luminance counts: the amount times
        /// color / Y(color). `"=blackbody(2700)"` is that of a bulb. A texture says how much of the amount, which is
        /// `radiance` or `luminance` then, each point has: where it is white all of it, where it is black nothing. So
        /// `luminance: 300, color: Texture(file: "screen.png")` is a screen whose white has 300 cd/m^2.
        color: Albedo = Albedo::from([1.0; 3]) => Rule::tint();
        /// Whether it shines to both sides; else only to the normal's: outwards.
        two_sided: bool = false;
        /// The group of lights that what shines so is of: with `output.light_groups`, what each group
        /// brings to the picture is told apart.
        group: LightGroup = LightGroup::default();
    }
}

impl Emissive {
    /// How much light, per channel; with a texture where that is white.
    pub fn radiometric(&self) -> Radiometric {
        let color = if let Albedo::Color(color) = self.color.resolved() { color.value } else { [1.0; 3] };
        self.amount.value.radiometric(color)
    }

    /// The texture that says how much each point shines, where there is one.
    pub fn texture(&self) -> Option<&Albedo> {
        (!self.color.is_color()).then_some(&self.color)
    }

    /// What is wrong with the amount and the colour together: a texture on something that is said of the whole lamp.
    pub fn fault(&self) -> Option<Diagnostic> {
        self.texture()?;
        let (name, other) = self.amount.value.of_whole()?;
        let message =
            format!("`{name}` is of the whole lamp, and `color` is a texture: each point shines another part");
        let fault = Diagnostic::error(codes::NO_USE, self.amount.span, message);
        let fault = fault.expected("`radiance` or `luminance`, of points where the texture is white");
        Some(fault.hint(format!("write `{other}` in place of `{name}`, or a `color` that is the same everywhere")))
    }
}

impl Words for Emissive {
    const TYPE: Type = EmissiveWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let words = EmissiveWords::read(reader, item, at)?;
        // None was written, or what was written could not be read: reported.
        let amount = amount_of!(words)?;
        reader.intense |= amount.value.is_intensity();
        let emissive = Emissive { amount, color: words.color, two_sided: words.two_sided, group: words.group };
        if let Some(fault) = emissive.fault() {
            reader.report(fault);
            return None;
        }
        Some(emissive)
    }

    fn form(&self, all: bool) -> Form {
        let mut words = EmissiveWords {
            radiance: None,
            power: None,
            intensity: None,
            luminance: None,
            luminous_power: None,
            luminous_intensity: None,
            color: self.color.clone(),
            two_sided: self.two_sided,
            group: self.group.clone(),
        };
        put_amount!(self.amount.value, words);
        let mut form = words.form(all);
        // Of the amounts the one that is not written has no default to show: only one may be there.
        if let Form::Struct { fields, .. } = &mut form {
            let is_none = |form: &Form| matches!(form, Form::Variant { name: "None", .. });
            fields.retain(|field| !EmissiveWords::DEF.exactly_one.contains(&&*field.name) || !is_none(&field.value));
        }
        form
    }
}

impl Told for Emissive {
    const ALSO: &'static [&'static str] = &["emitter", "light", "area", "emission", "arealight", "glow", "areasource"];
    const EXAMPLE: &'static str = "Emissive(radiance: 3)";
}

impl MaterialWords for Emissive {
    fn varying(&self) -> Vec<&Albedo> {
        vec![&self.color]
    }

    fn shines(&self) -> Option<&Emissive> {
        Some(self)
    }
}
