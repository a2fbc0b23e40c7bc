//! How bright lamps and background are, and the unit that this is measured in.

use scene_format::Diagnostic;
use scene_format::SceneDesc;
use scene_format::codes;
use scene_format::desc::{self, Emission, SphereLight};
use scene_format::diagnostic::Span;

/// L = I / (pi r^2) = P / (4 pi^2 r^2).
pub(super) fn of_light(light: &SphereLight) -> [f64; 3] {
    let disc = std::f64::consts::PI * light.radius.value * light.radius.value;
    match light.emission.value {
        Emission::Radiance(l) => l,
        Emission::Intensity(i) => i.map(|x| x / disc),
        Emission::Power(p) => p.map(|x| x / (4.0 * std::f64::consts::PI * disc)),
    }
}

/// The largest power of two that is not above the brightest channel of all lamps and the background: to divide by it changes no digit.
/// One where there is no light.
pub(super) fn unit(desc: &SceneDesc) -> f64 {
    let lamps = desc.lights.iter().flat_map(|light| {
        let desc::Light::SphereLight(light) = &light.value;
        of_light(light)
    });
    let brightest = lamps.chain(desc.background).filter(|x| x.is_finite()).fold(0.0, f64::max);
    // Sign and mantissa cleared. What f64 itself can hardly hold stays as it is.
    let power = f64::from_bits(brightest.to_bits() & 0x7ff0_0000_0000_0000);
    if power > 1e-290 { power } else { 1.0 }
}

/// A warning for each lamp, and the background, that is so dark beside the brightest that single precision does not hold it.
pub(super) fn too_dark(desc: &SceneDesc, unit: f64) -> Vec<Diagnostic> {
    let is_lost = |radiance: [f64; 3]| radiance.iter().any(|&x| x > 0.0 && x / unit < f64::from(f32::MIN_POSITIVE));
    let warning = |span, what: &str| {
        Diagnostic::warning(
            codes::LIGHT_TOO_DARK,
            span,
            format!("{what} is less than 1e-37 of the brightest light: it may be lost"),
        )
        .hint("bring the radiances of lights and background closer together")
    };
    let lamps = desc.lights.iter().filter_map(|light| {
        let desc::Light::SphereLight(lamp) = &light.value;
        is_lost(of_light(lamp)).then(|| warning(lamp.emission.span, "this light"))
    });
    let background = is_lost(desc.background).then(|| warning(Span::NONE, "the background"));
    lamps.chain(background).collect()
}
