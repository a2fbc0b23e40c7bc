//! Metals.

use super::MaterialWords;
use crate::codes;
use crate::desc::{Albedo, Color, Number};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct, scene_words};

scene_words! {
    /// A measured metal.
    pub enum Metal, "metal" {
        /// Silver (Johnson and Christy 1972).
        Silver,
        /// Gold (Johnson and Christy 1972).
        Gold,
        /// Copper (Johnson and Christy 1972).
        Copper,
        /// Aluminium (Rakic 1995).
        Aluminum,
        /// Iron (Johnson and Christy 1974).
        Iron,
        /// Chromium (Johnson and Christy 1974).
        Chromium,
        /// Nickel (Johnson and Christy 1974).
        Nickel,
        /// Titanium (Johnson and Christy 1974).
        Titanium,
        /// Brass, a third of it zinc (Querry 1985).
        Brass,
        /// Platinum (Rakic 1998).
        Platinum,
        /// Steel (Karlsson and Ribbing 1982).
        Steel,
    }
}

impl Metal {
    /// Index of refraction and extinction coefficient in red, green and blue, fitted so that Fresnel's reflectance at 0
    /// and 82 degrees has the colour of the spectral one under D65 (linear sRGB; gold's red cut to 0.99). The
    /// measurements are those of refractiveindex.info (CC0).
    pub fn ior_and_k(self) -> [Color; 2] {
        match self {
            Metal::Silver => [[0.056, 0.055, 0.043], [4.480, 3.542, 2.586]],
            Metal::Gold => [[0.081, 0.503, 1.464], [5.586, 2.268, 1.773]],
            Metal::Copper => [[0.211, 1.043, 1.294], [3.301, 2.623, 2.361]],
            Metal::Aluminum => [[1.505, 0.985, 0.606], [7.661, 6.548, 5.350]],
            Metal::Iron => [[2.923, 2.919, 2.546], [3.077, 2.937, 2.750]],
            Metal::Chromium => [[3.246, 3.116, 2.286], [3.286, 3.336, 3.117]],
            Metal::Nickel => [[2.032, 1.903, 1.727], [4.200, 3.570, 2.895]],
            Metal::Titanium => [[2.749, 2.507, 2.239], [3.844, 3.397, 3.015]],
            Metal::Brass => [[0.441, 0.522, 1.121], [4.175, 2.665, 1.808]],
            Metal::Platinum => [[2.359, 2.068, 1.826], [4.254, 3.679, 3.091]],
            Metal::Steel => [[2.189, 1.888, 1.468], [3.460, 3.151, 2.738]],
        }
    }
}

/// How much a metal reflects, by the angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Reflectance {
    /// A measured metal.
    Metal(Metal),
    /// By Fresnel's equations.
    Complex {
        /// Index of refraction.
        ior: Spanned<Color>,
        /// Extinction coefficient.
        k: Spanned<Color>,
    },
    /// The F82-tint model (Kutz, Hasan, Edmondson 2021, as in OpenPBR).
    Tinted {
        /// At normal incidence.
        reflectance: Albedo,
        /// What Schlick's reflectance at about 82 degrees is multiplied by.
        edge_tint: Albedo,
    },
}

/// A metal, smooth or rough.
#[derive(Clone, Debug, PartialEq)]
pub struct Conductor {
    /// How much it reflects.
    pub reflectance: Reflectance,
    /// r: alpha = r^2.
    pub roughness: Number,
    /// Whether light that is reflected several times among its bumps counts.
    pub multiple_scattering: bool,
}

scene_struct! {
    /// A metal, smooth or rough: GGX. What it reflects is said by exactly one of `metal`, `ior` (with `k`) and
    /// `reflectance`.
    pub(crate) struct ConductorWords as "Conductor", "a conductor", exactly one of [metal, ior, reflectance] {
        /// A measured metal.
        metal: Option<Metal> = None;
        /// Index of refraction per channel, for Fresnel's equations.
        ior: Option<Spanned<Color>> = None => Rule::per_channel("an index of refraction per channel", 0.0, 100.0);
        /// Extinction coefficient per channel; with `ior` only.
        k: Option<Spanned<Color>> = None => Rule::per_channel("an extinction coefficient per channel", 0.0, 100.0);
        /// Reflected share at normal incidence per channel; it grows to 1 at grazing angles (F82-tint model).
        reflectance: Option<Albedo> = None => Rule::share();
        /// What the reflected share at about 82 degrees is multiplied by, per channel; with `reflectance` only.
        /// None: 1.
        edge_tint: Option<Albedo> = None => Rule::share();
        /// r: 0 is a mirror, 1 dull. The width of the lobe is alpha = r^2.
        roughness: Number = 0.0 => Rule::within("a roughness", 0.0, 1.0);
        /// Whether light that is reflected several times among the bumps counts (Kulla and Conty 2017): without it
        /// rough metals are too dark.
        multiple_scattering: bool = true;
    }
}

impl Words for Conductor {
    const TYPE: Type = ConductorWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let words = ConductorWords::read(reader, item, at)?;
        let several = [words.metal.is_some(), words.ior.is_some(), words.reflectance.is_some()];
        if several.iter().filter(|written| **written).count() != 1 {
            // Reported.
            return None;
        }
        if let Some(k) = words.k.as_ref().filter(|_| words.ior.is_none()) {
            reader.report(only_with(k.span, "k", "ior"));
            return None;
        }
        if words.edge_tint.is_some() && words.reflectance.is_none() {
            let tint = item.fields().find(|(key, _)| key.text() == "edge_tint");
            let span = tint.map_or(item.span(), |(_, tint)| tint.span());
            reader.report(only_with(span, "edge_tint", "reflectance"));
            return None;
        }
        let reflectance = match (words.metal, words.ior, words.k, words.reflectance) {
            (Some(metal), ..) => Reflectance::Metal(metal),
            (_, Some(ior), Some(k), _) => Reflectance::Complex { ior, k },
            // It is there and could not be read: reported.
            (_, Some(_), None, _) if item.is_damaged() || item.fields().any(|(key, _)| key.text() == "k") => {
                return None;
            }
            (_, Some(ior), None, _) => {
                reader.report(
                    Diagnostic::error(codes::MISSING_FIELD, ior.span, "a conductor with `ior` needs the field `k`")
                        .expected("an extinction coefficient per channel")
                        .hint("add `k`: gold is ior (0.081, 0.503, 1.464), k (5.586, 2.268, 1.773)"),
                );
                return None;
            }
            (_, _, _, Some(reflectance)) => {
                let edge_tint = words.edge_tint.unwrap_or_else(|| [1.0; 3].into());
                Reflectance::Tinted { reflectance, edge_tint }
            }
            _ => return None,
        };
        Some(Conductor { reflectance, roughness: words.roughness, multiple_scattering: words.multiple_scattering })
    }

    fn form(&self, all: bool) -> Form {
        let mut words = ConductorWords {
            metal: None,
            ior: None,
            k: None,
            reflectance: None,
            edge_tint: None,
            roughness: self.roughness.clone(),
            multiple_scattering: self.multiple_scattering,
        };
        match &self.reflectance {
            Reflectance::Metal(metal) => words.metal = Some(*metal),
            Reflectance::Complex { ior, k } => (words.ior, words.k) = (Some(ior.clone()), Some(k.clone())),
            Reflectance::Tinted { reflectance, edge_tint } => {
                words.reflectance = Some(reflectance.clone());
                words.edge_tint = (all || *edge_tint != [1.0; 3].into()).then(|| edge_tint.clone());
            }
        }
        let mut form = words.form(all);
        // What is not written has no default to show: only one may be there.
        if let Form::Struct { fields, .. } = &mut form {
            fields.retain(|field| !matches!(field.value, Form::Variant { name: "None", .. }));
        }
        form
    }
}

fn only_with(span: Span, field: &str, other: &str) -> Diagnostic {
    Diagnostic::error(codes::UNKNOWN_FIELD, span, format!("a conductor without `{other}` has no `{field}`"))
        .expected(format!("`{field}` beside `{other}` only"))
        .hint(format!("remove `{field}`, or say what it reflects by `{other}`"))
}

impl Told for Conductor {
    const ALSO: &'static [&'static str] =
        &["metal", "roughconductor", "roughmetal", "brushedmetal", "brushed", "microfacet", "ggx", "metallic"];
    const EXAMPLE: &'static str = "Conductor(metal: Gold, roughness: 0.3)";
}

impl MaterialWords for Conductor {
    fn varying(&self) -> Vec<&Albedo> {
        match &self.reflectance {
            Reflectance::Tinted { reflectance, edge_tint } => vec![reflectance, edge_tint, &self.roughness.0],
            Reflectance::Metal(_) | Reflectance::Complex { .. } => vec![&self.roughness.0],
        }
    }
}
