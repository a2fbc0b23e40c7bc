//! Matt surfaces with a gloss.

use super::MaterialWords;
use crate::desc::{Albedo, Number};
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// Blinn-Phong: albedo * ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h).
    pub struct BlinnPhong as "BlinnPhong", "a Blinn-Phong material" {
        /// Colour of both lobes.
        albedo: Albedo = Albedo::default() => Rule::share();
        /// alpha: 1 is dull, 100000 nearly a mirror. A picture goes from 0 to 1: `Multiply(a: Texture(..), b: 1000)`
        /// or a `Mix` between two numbers by it.
        exponent: Number => Rule::per_channel("a number", 0.0, 10_000_000.0);
        /// s: share of the glossy lobe, 0 to 1.
        specular: Number => Rule::within("a share", 0.0, 1.0);
        /// The glossy lobe after Ashikhmin and Shirley, that never reflects more than it gets.
        energy_conserving: bool = false;
    }
}

impl Told for BlinnPhong {
    const ALSO: &'static [&'static str] = &["phong", "glossy", "plastic", "roughplastic"];
    const EXAMPLE: &'static str = "BlinnPhong(albedo: \"#3344dd\", exponent: 1000, specular: 0.05)";
}

impl MaterialWords for BlinnPhong {
    fn varying(&self) -> Vec<&Albedo> {
        vec![&self.albedo, &self.exponent.0, &self.specular.0]
    }
}
