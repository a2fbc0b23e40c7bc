//! Fields that lights have in other programs, and how they are said here.

use crate::schema::StructDef;

/// What is said of fields for the brightness of a light that there are not.
pub(super) fn strength(name: &str, def: &'static StructDef) -> Option<&'static str> {
    if !def.exactly_one.contains(&"radiance") {
        return None;
    }
    match name.to_ascii_lowercase().as_str() {
        "colour" | "rgb" | "tint" => {
            Some("a light's colour is `color`, or in its amount, per channel: `radiance: (3, 2, 1)`")
        }
        "texture" | "map" | "image" | "picture" | "pattern" | "emission_map" | "emissive_map" | "map_ke"
        | "filename"
            if def.name == "Emissive" =>
        {
            Some("a texture stands in `color`: radiance: 5, color: Texture(file: \"screen.png\")")
        }
        "temperature" | "kelvin" | "blackbody" | "color_temperature" | "t" => {
            Some("a light as white as a black body of 2700 K has `color: \"=blackbody(2700)\"`")
        }
        "lux" | "lx" | "illuminance" => Some(
            "lux say what arrives, not what a lamp gives: 500 of them at a distance of 2 take `luminous_intensity: \
             2000`, which is lux times the square of the distance",
        ),
        "brightness" | "strength" | "energy" | "emission" | "scale" | "exposure" | "ke" | "l" | "le" | "emissive"
        | "irradiance" => {
            Some("how bright it is is said by `radiance`, `power` in W, `intensity` in W/sr, or `luminous_power` in lm")
        }
        "candela" | "candelas" | "cd" => Some("candela are said by `luminous_intensity`"),
        "nits" | "nit" => Some("nits, cd/m^2, are said by `luminance`"),
        "watts" | "watt" | "flux" => Some("the light that is given in all is `power`, in W"),
        "lumens" | "lumen" | "lm" => Some("lumens are said by `luminous_power`"),
        _ => None,
    }
}
