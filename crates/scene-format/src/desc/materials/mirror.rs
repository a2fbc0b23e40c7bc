//! Perfect mirrors.

use super::MaterialWords;
use crate::desc::Albedo;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A perfect mirror.
    pub struct Mirror as "Mirror", "a mirror" {
        /// Reflected share per channel.
        reflectance: Albedo = [1.0; 3] => Rule::share();
    }
}

impl Told for Mirror {
    const ALSO: &'static [&'static str] = &["specular", "reflective", "chrome", "perfectmirror"];
    const EXAMPLE: &'static str = "Mirror(reflectance: 0.9)";
}

impl MaterialWords for Mirror {
    fn varying(&self) -> Vec<&Albedo> {
        vec![&self.reflectance]
    }
}
