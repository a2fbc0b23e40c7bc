//! Surfaces that shine.

use super::MaterialWords;
use crate::desc::{Color, LightGroup};
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct};

/// How much light a surface gives, per channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// Radiance in W/(sr m^2).
    Radiance(Color),
    /// Power of each copy in W: L = P / (pi A).
    Power(Color),
}

/// A surface that shines and reflects nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Emissive {
    /// How much light.
    pub amount: Spanned<Amount>,
    /// Whether it shines to both sides, not only outwards.
    pub two_sided: bool,
    /// The group of lights that what shines so is of.
    pub group: LightGroup,
}

scene_struct! {
    /// A surface that shines and reflects nothing: whatever shape has it is a light. How much it shines is said by
    /// exactly one of `radiance` and `power`.
    pub(crate) struct EmissiveWords as "Emissive", "an emissive material", exactly one of [radiance, power] {
        /// Radiance L of every point, in all directions.
        radiance: Option<Spanned<Color>> = None => Rule::light("in W/(sr m^2)");
        /// Power of each copy: L = P / (pi A), A the true area that shines (both sides where `two_sided`).
        power: Option<Spanned<Color>> = None => Rule::light("in W");
        /// Whether it shines to both sides; else only to the normal's: outwards.
        two_sided: bool = false;
        /// The group of lights that what shines so is of: with `output.light_groups`, what each group
        /// brings to the picture is told apart.
        group: LightGroup = LightGroup::default();
    }
}

impl Words for Emissive {
    const TYPE: Type = EmissiveWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let words = EmissiveWords::read(reader, item, at)?;
        let amount = match (words.radiance, words.power) {
            (Some(color), _) => Spanned { value: Amount::Radiance(color.value), span: color.span },
            (_, Some(color)) => Spanned { value: Amount::Power(color.value), span: color.span },
            // None was written, or what was written could not be read: reported.
            _ => return None,
        };
        Some(Emissive { amount, two_sided: words.two_sided, group: words.group })
    }

    fn form(&self, all: bool) -> Form {
        let (two_sided, group) = (self.two_sided, self.group.clone());
        let mut words = EmissiveWords { radiance: None, power: None, two_sided, group };
        match self.amount.value {
            Amount::Power(color) => words.power = Some(color.into()),
            Amount::Radiance(color) => words.radiance = Some(color.into()),
        }
        let mut form = words.form(all);
        // Of the amounts the one that is not written has no default to show: only one may be there.
        if let Form::Struct { fields, .. } = &mut form {
            let amounts = ["radiance", "power"];
            let is_none = |form: &Form| matches!(form, Form::Variant { name: "None", .. });
            fields.retain(|field| !amounts.contains(&&*field.name) || !is_none(&field.value));
        }
        form
    }
}

impl Told for Emissive {
    const ALSO: &'static [&'static str] = &["emitter", "light", "area", "emission", "arealight", "glow", "areasource"];
    const EXAMPLE: &'static str = "Emissive(radiance: 3)";
}

impl MaterialWords for Emissive {
    fn shines(&self) -> Option<&Emissive> {
        Some(self)
    }
}
