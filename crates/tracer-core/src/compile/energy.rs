//! Materials that reflect more than they get: Blinn-Phong as the report has it.
//!
//! With f = albedo ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h) under light of radiance one from everywhere,
//! what goes back along wo is albedo ((1 - s) + s G(wo)). G is largest along the normal, where the integral is closed:
//! G = 4 (alpha + 2^(-alpha/2)) / (alpha + 4), which grows from 1 at alpha = 0 to 4.

use crate::texture::Texture;
use scene_format::desc::{self, Albedo, BlinnPhong, Material, MaterialRef, Number, with_operands};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::BTreeSet;

/// What the glossy lobe reflects at most of light from everywhere, as a share of what it gets.
fn glossy_at_most(exponent: f64) -> f64 {
    4.0 * (exponent + libm::exp2(-0.5 * exponent)) / (exponent + 4.0)
}

/// What a Blinn-Phong material of this albedo reflects at most, as a share of what it gets.
fn reflected_at_most(albedo: f64, specular: f64, exponent: f64) -> f64 {
    albedo * (1.0 - specular + specular * glossy_at_most(exponent))
}

/// More materials than this are not marked one by one.
const MARKED: usize = 8;

/// A material that reflects more than it gets.
struct Loud<'d> {
    /// So many times what it gets.
    times: f64,
    name: Option<&'d str>,
    of_picture: bool,
    /// Its share of the glossy lobe.
    span: Span,
}

/// The largest channel that a colour or a texture may have anywhere, or the largest number.
fn brightest<'t>(albedo: &Albedo, number: bool, texture: &impl Fn(&desc::Texture, bool) -> Option<&'t Texture>) -> f64 {
    let most = |color: desc::Color| color.into_iter().fold(0.0, f64::max);
    match albedo.resolved() {
        Albedo::Color(color) if number => Number::of_color(color.value),
        Albedo::Color(color) => most(color.value),
        Albedo::Texture(words) => texture(words, number).map_or(1.0, Texture::brightest),
        Albedo::ColorRamp(ramp) => ramp.stops.0.iter().map(|stop| most(stop.color.value)).fold(0.0, f64::max),
        Albedo::Multiply(words) => brightest(&words.a, number, texture) * brightest(&words.b, number, texture),
        // No vertex is brighter.
        Albedo::VertexColor(_) => 1.0,
        // Between the first two; what may follow says how much of either.
        pattern => {
            let parts = pattern.pattern().map_or_else(Vec::new, |pattern| pattern.parts());
            parts.into_iter().take(2).map(|part| brightest(part, number, texture)).fold(0.0, f64::max)
        }
    }
}

/// Warns of the materials of the scene that reflect more than they get: once, with the loudest first. `texture`: a
/// picture as it is read for colours, or for numbers.
pub fn warn<'t>(
    desc: &SceneDesc,
    texture: impl Fn(&desc::Texture, bool) -> Option<&'t Texture>,
    diagnostics: &mut Diagnostics,
) {
    let named = desc.materials.iter().map(|named| (Some(&named.name), named.name.span, &named.material));
    let inline = with_operands(&desc.objects).filter_map(|object| match object.value.material() {
        MaterialRef::Inline(material) => Some((None, material.span, &material.value)),
        _ => None,
    });
    let mut known = BTreeSet::new();
    let mut loud: Vec<Loud<'_>> = Vec::new();
    for (name, place, material) in named.chain(inline) {
        let Material::BlinnPhong(words) = material else { continue };
        let name = name.map(|name| &*name.value);
        // A texture may stand elsewhere.
        let span = if words.specular.0.is_color() { words.specular.span() } else { place };
        let BlinnPhong { albedo, exponent, specular, energy_conserving: false } = &**words else { continue };
        // A texture's most, of each: the more of any of them, the more is reflected.
        let of_picture = [albedo, &exponent.0, &specular.0].into_iter().any(|value| !value.is_color());
        let albedo = brightest(albedo, false, &texture);
        let [exponent, specular] = [exponent, specular].map(|number| brightest(&number.0, true, &texture));
        let times = reflected_at_most(albedo, specular.min(1.0), exponent.min(1e7));
        // Of the same material written many times one is told; what is above one by rounding only is not.
        let key = [albedo, specular, exponent].map(f64::to_bits);
        if times > 1.0 + 1e-9 && (name.is_some() || known.insert(key)) {
            loud.push(Loud { times, name, of_picture, span });
        }
    }
    loud.sort_by(|a, b| b.times.total_cmp(&a.times));
    diagnostics.extend(warning(&loud));
}

fn warning(loud: &[Loud<'_>]) -> Option<Diagnostic> {
    let (first, rest) = loud.split_first()?;
    let who = first.name.map_or_else(|| "this material".to_owned(), |name| format!("the material {name:?}"));
    let place = if first.of_picture { " where its texture is brightest" } else { "" };
    let more = match rest.len() {
        0 => String::new(),
        1 => "; one more adds light, too".to_owned(),
        n => format!("; {n} more add light, too"),
    };
    let message = format!("{who} reflects up to {} times the light that it gets{place}{more}", digits(first.times));
    let warning = Diagnostic::warning(codes::REFLECTS_MORE, first.span, message)
        .expected("at most 1: a real surface adds no light")
        .hint("add `energy_conserving: true`");
    Some(
        rest.iter()
            .take(MARKED - 1)
            .fold(warning, |warning, other| warning.label(other.span, format!("up to {} times", digits(other.times)))),
    )
}

/// As many digits as show that it is more than one.
fn digits(times: f64) -> String {
    let digits = if times >= 1.005 { 2 } else { 4 };
    format!("{times:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The glossy lobe's integral over half vectors, at an angle of the viewer: h is drawn by (alpha + 2)/(2 pi)
    /// cos^(alpha+1) theta_h, and dw_i = 4 (wo.h) dw_h.
    fn integrated(exponent: f64, cos_o: f64) -> f64 {
        const STEPS: usize = 400;
        let sin_o = libm::sqrt(1.0 - cos_o * cos_o);
        let mut sum = 0.0;
        for i in 0..STEPS {
            let cos_h = libm::pow((i as f64 + 0.5) / STEPS as f64, 1.0 / (exponent + 2.0));
            let sin_h = libm::sqrt(1.0 - cos_h * cos_h);
            for j in 0..STEPS {
                let phi = std::f64::consts::PI * (j as f64 + 0.5) / STEPS as f64;
                let wo_h = sin_o * sin_h * libm::cos(phi) + cos_o * cos_h;
                let cos_i = 2.0 * wo_h * cos_h - cos_o;
                if wo_h > 0.0 && cos_i > 0.0 {
                    sum += 4.0 * wo_h * cos_i / cos_h;
                }
            }
        }
        sum / (STEPS * STEPS) as f64
    }

    #[test]
    fn the_most_is_along_the_normal_and_is_the_closed_form() {
        for exponent in [0.0, 0.5, 1.0, 3.0, 10.0, 100.0, 1000.0, 1e5] {
            let most = glossy_at_most(exponent);
            assert!((integrated(exponent, 1.0) / most - 1.0).abs() < 2e-3, "{exponent}: {most}");
            for k in 0..20 {
                let cos_o = 1.0 - f64::from(k) / 20.0;
                assert!(integrated(exponent, cos_o) < most * 1.002, "{exponent} at {cos_o}");
            }
        }
        assert_eq!(glossy_at_most(0.0), 1.0);
    }

    #[test]
    fn who_adds_light_is_told_once_with_the_number() {
        let text = r#"Scene(
            background: 1,
            materials: {
                "loud": BlinnPhong(albedo: (0.2, 0.9, 0.5), exponent: 1000, specular: 0.5),
                "meek": BlinnPhong(albedo: 0.5, exponent: 1000, specular: 0.3),
                "high": BlinnPhong(albedo: 1, exponent: 1000000, specular: 0.001),
                "kept": BlinnPhong(albedo: 1, exponent: 1000, specular: 0.5, energy_conserving: true),
            },
            objects: [
                Sphere(center: (0, 0, 0), radius: 1, material: "loud"),
                Sphere(center: (3, 0, 0), radius: 1, material: "loud"),
                Sphere(center: (0, 3, 0), radius: 1, material: "meek"),
                Sphere(center: (0, 9, 0), radius: 1, material: "high"),
                Sphere(center: (3, 3, 0), radius: 1, material: "kept"),
            ],
        )"#;
        let loaded = scene_format::load_str("s.ron", text, scene_format::Syntax::Ron, Path::new("."), &[]);
        let scene = crate::compile(&loaded.expect("right").scene).expect("right");
        let told: Vec<(&str, &str)> = scene.warnings.iter().map(|w| (w.code.as_str(), w.message.as_str())).collect();
        let message =
            "the material \"loud\" reflects up to 2.24 times the light that it gets; one more adds light, too";
        assert_eq!(told, [("W0302", message)]);
        let at = |span: Span| &text[span.start as usize..span.end as usize];
        let other = &scene.warnings[0].labels[0];
        assert_eq!((at(scene.warnings[0].span), at(other.span), &*other.text), ("0.5", "0.001", "up to 1.0030 times"));
    }
}
