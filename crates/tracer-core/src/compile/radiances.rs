//! How bright lamps and background are, and the unit that this is measured in.

use super::csg::SolidObject;
use super::curved::Curved;
use super::polygonal::polygonal;
use scene_format::Diagnostic;
use scene_format::SceneDesc;
use scene_format::codes;
use scene_format::desc::{self, Integrator, Radiometric, SphereLight};
use scene_format::diagnostic::Span;

/// L = I / (pi r^2) = P / (4 pi^2 r^2).
pub(super) fn of_light(light: &SphereLight) -> [f64; 3] {
    let disc = std::f64::consts::PI * light.radius.value * light.radius.value;
    match light.radiometric() {
        Radiometric::Radiance(l) => l,
        Radiometric::Intensity(i) => i.map(|x| x / disc),
        Radiometric::Power(p) => p.map(|x| x / (4.0 * std::f64::consts::PI * disc)),
    }
}

/// What an object shines.
pub(super) struct Shining {
    /// Of its copies the brightest and the darkest.
    radiances: [[f64; 3]; 2],
    /// Where that is said.
    span: Span,
}

/// What the objects shine that do, in the order of the scene. `meshes`: what copies of objects of triangles shine, by
/// object.
pub(super) fn of_objects(
    desc: &SceneDesc,
    (curved, solids): (&[Curved], &[SolidObject]),
    meshes: &[Vec<[f64; 3]>],
) -> Vec<Shining> {
    let sum = |radiance: &&[f64; 3]| radiance.iter().sum::<f64>();
    let shining = |copies: &[[f64; 3]], span: Span| {
        let brightest = copies.iter().max_by(|a, b| sum(a).total_cmp(&sum(b)))?;
        let darkest = copies.iter().min_by(|a, b| sum(a).total_cmp(&sum(b)))?;
        Some(Shining { radiances: [*brightest, *darkest], span })
    };
    let of_curved = curved.iter().filter_map(|object| {
        let emissive = object.emissive.as_ref()?;
        Some((object.number, shining(&object.radiances(), emissive.amount.span)?))
    });
    let of_solids = solids.iter().filter_map(|object| {
        let (radiances, span) = object.radiances()?;
        Some((object.number, shining(&radiances, span)?))
    });
    let of_meshes = polygonal(desc).zip(meshes);
    let of_meshes = of_meshes.filter_map(|(object, copies)| Some((object.number, shining(copies, object.span)?)));
    let mut all: Vec<(u32, Shining)> = of_curved.chain(of_solids).chain(of_meshes).collect();
    all.sort_by_key(|(number, _)| *number);
    all.into_iter().map(|(_, shining)| shining).collect()
}

/// The largest power of two that is not above the brightest channel of all lights and the background: to divide by it
/// changes no digit. One where there is no light. `background`: the most that comes from there.
pub(super) fn unit(desc: &SceneDesc, shining: &[Shining], background: [f64; 3]) -> f64 {
    if is_without_light(desc) {
        return 1.0;
    }
    let lamps = desc.lights.iter().map(|light| {
        let desc::Light::SphereLight(light) = &light.value;
        of_light(light)
    });
    let objects = shining.iter().flat_map(|object| object.radiances);
    let all = lamps.chain(objects).chain([background]).flatten();
    let brightest = all.filter(|x| x.is_finite()).fold(0.0, f64::max);
    // Sign and mantissa cleared. What f64 itself can hardly hold stays as it is.
    let power = f64::from_bits(brightest.to_bits() & 0x7ff0_0000_0000_0000);
    if power > 1e-290 { power } else { 1.0 }
}

/// Whether the picture is of no light, but of numbers up to one.
fn is_without_light(desc: &SceneDesc) -> bool {
    matches!(desc.render.integrator, Integrator::AmbientOcclusion { .. })
}

/// A warning for each light, and the background, that is so dark beside the brightest that single precision does not
/// hold it.
pub(super) fn too_dark(desc: &SceneDesc, shining: &[Shining], background: [f64; 3], unit: f64) -> Vec<Diagnostic> {
    if is_without_light(desc) {
        return Vec::new();
    }
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
        is_lost(of_light(lamp)).then(|| warning(lamp.amount.span, "this light"))
    });
    let objects = shining.iter().filter(|object| object.radiances.iter().any(|&radiance| is_lost(radiance)));
    let objects = objects.map(|object| warning(object.span, "what this object shines"));
    let background = is_lost(background).then(|| warning(Span::NONE, "the background"));
    lamps.chain(objects).chain(background).collect()
}
