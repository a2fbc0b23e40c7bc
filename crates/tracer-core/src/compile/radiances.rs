//! How bright lamps and background are, and the unit that this is measured in.

use scene_format::Diagnostic;
use scene_format::SceneDesc;
use scene_format::codes;
use scene_format::desc::{self, Amount, Emission, Emissive, Object, Sphere, SphereLight};
use scene_format::diagnostic::{Span, Spanned};

/// L = I / (pi r^2) = P / (4 pi^2 r^2).
pub(super) fn of_light(light: &SphereLight) -> [f64; 3] {
    let disc = std::f64::consts::PI * light.radius.value * light.radius.value;
    match light.emission.value {
        Emission::Radiance(l) => l,
        Emission::Intensity(i) => i.map(|x| x / disc),
        Emission::Power(p) => p.map(|x| x / (4.0 * std::f64::consts::PI * disc)),
    }
}

/// What a luminous sphere of an object shines: L = P / (pi A), A = 4 pi r^2, of both sides where it has two.
pub(super) fn of_sphere(sphere: &Sphere, emissive: &Emissive) -> [f64; 3] {
    let pi = std::f64::consts::PI;
    let sides = if emissive.two_sided { 2.0 } else { 1.0 };
    let area = 4.0 * pi * sphere.radius.value * sphere.radius.value * sides;
    match emissive.amount.value {
        Amount::Radiance(l) => l,
        Amount::Power(p) => p.map(|x| x / (pi * area)),
    }
}

/// What an object shines.
pub(super) struct Shining {
    /// Of its copies the brightest and the darkest.
    radiances: [[f64; 3]; 2],
    /// Where that is said.
    span: Span,
}

/// What the objects shine that do. Spheres and objects of triangles are each counted in the order of the scene.
pub(super) fn of_objects(desc: &SceneDesc, spheres: &[Option<Emissive>], meshes: &[Vec<[f64; 3]>]) -> Vec<Shining> {
    let (mut spheres, mut meshes) = (spheres.iter(), meshes.iter());
    let of_object = |object: &Spanned<Object>| match &object.value {
        Object::Sphere(sphere) => {
            let emissive = spheres.next()?.as_ref()?;
            Some(Shining { radiances: [of_sphere(sphere, emissive); 2], span: emissive.amount.span })
        }
        _ => {
            let copies = meshes.next()?;
            let sum = |radiance: &&[f64; 3]| radiance.iter().sum::<f64>();
            let brightest = copies.iter().max_by(|a, b| sum(a).total_cmp(&sum(b)))?;
            let darkest = copies.iter().min_by(|a, b| sum(a).total_cmp(&sum(b)))?;
            Some(Shining { radiances: [*brightest, *darkest], span: object.span })
        }
    };
    desc.objects.iter().filter_map(of_object).collect()
}

/// The largest power of two that is not above the brightest channel of all lights and the background: to divide by it changes no digit.
/// One where there is no light. `background`: the most that comes from there.
pub(super) fn unit(desc: &SceneDesc, shining: &[Shining], background: [f64; 3]) -> f64 {
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

/// A warning for each light, and the background, that is so dark beside the brightest that single precision does not hold it.
pub(super) fn too_dark(desc: &SceneDesc, shining: &[Shining], background: [f64; 3], unit: f64) -> Vec<Diagnostic> {
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
    let objects = shining.iter().filter(|object| object.radiances.iter().any(|&radiance| is_lost(radiance)));
    let objects = objects.map(|object| warning(object.span, "what this object shines"));
    let background = is_lost(background).then(|| warning(Span::NONE, "the background"));
    lamps.chain(objects).chain(background).collect()
}
