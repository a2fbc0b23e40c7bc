//! Glass, water, air bubbles.

use super::MaterialWords;
use crate::desc::Albedo;
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A smooth dielectric: exact Fresnel reflection and refraction. What lies flat against another thing is glued to
    /// it: no air is between, and most of what a floor beneath sends up is reflected back within the glass. Lifted by a
    /// thousandth of its height it stands on the floor with air between.
    pub struct Transparent as "Transparent", "a transparent material" {
        /// Index of refraction of the inside against the outside, below 1 where the inside is the thinner: an air
        /// bubble in water is 1/1.33 = 0.752, water within glass 1.33/1.5 = 0.887.
        ior: Spanned<f64> => Rule::within("an index of refraction", 0.01, 100.0);
        /// Share of refracted light that passes each surface, per channel.
        transmittance: Albedo = [1.0; 3] => Rule::share();
    }
}

impl Told for Transparent {
    const ALSO: &'static [&'static str] = &["glass", "dielectric", "refractive"];
    const EXAMPLE: &'static str = "Transparent(ior: 1.5)";
}

impl MaterialWords for Transparent {
    fn varying(&self) -> Vec<&Albedo> {
        vec![&self.transmittance]
    }

    fn transmits(&self) -> bool {
        true
    }
}
