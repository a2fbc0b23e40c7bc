//! Matt surfaces.

use super::MaterialWords;
use crate::desc::Albedo;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// Lambert: albedo / pi.
    pub struct Diffuse as "Diffuse", "a diffuse material" {
        /// Reflected share per channel.
        albedo: Albedo = Albedo::default() => Rule::share();
    }
}

impl Told for Diffuse {
    const ALSO: &'static [&'static str] = &["lambertian", "lambert", "matte", "matt", "roughdiffuse"];
    const EXAMPLE: &'static str = "Diffuse(albedo: (0.8, 0.3, 0.1))";
}

impl MaterialWords for Diffuse {
    fn varying(&self) -> Vec<&Albedo> {
        vec![&self.albedo]
    }
}
