//! Numbers that are surely meant on another scale: radians where degrees stand, light as a colour in bytes, an
//! exposure in other units, an f-number where the lens's width stands.

use glam::DVec3;
use scene_format::desc::{
    Albedo, Amount, Color, Focus, Light, Material, MaterialRef, Projection, Transform, with_operands,
};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::f64::consts::PI;

/// A field of view below this many degrees, and above the other, is rather one in radians: 11 to 115 degrees. Half a
/// degree, one, and one and a half are telephoto lenses.
const RADIANS: [f64; 2] = [0.2, 2.0];
/// What people turn things by, as parts of half a turn.
const TURNS: [f64; 9] = [1.0 / 6.0, 0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.75, 1.0, 1.5, 2.0];
/// Stops above which an exposure is looked at.
const MOST_STOPS: f64 = 10.0;
/// A background this many times as bright as white is not meant.
const MOST_WHITE: f64 = 500.0;

/// The numbers on the rings of lenses.
const F_NUMBERS: [f64; 15] = [1.2, 1.4, 1.8, 2.0, 2.2, 2.4, 2.8, 3.5, 4.0, 4.5, 5.6, 8.0, 11.0, 16.0, 22.0];
/// A lens wider than this share of the way to what is sharp is looked at.
const WIDE: f64 = 0.2;
/// And one that is no number on a ring, above this.
const WIDEST: f64 = 1.0;

/// Warns of them, each kind once. `behind`: the brightest channels of the background.
pub fn warn(desc: &SceneDesc, behind: [f64; 3], diagnostics: &mut Diagnostics) {
    let camera = &desc.camera;
    let fov = camera.fov.value;
    let [least, most] = RADIANS;
    let is_told = camera.projection == Projection::Perspective && camera.focal_length.is_none();
    if is_told && fov >= least && fov < most && (2.0 * fov).fract() != 0.0 {
        let message = format!("a `fov` of {fov} degrees shows next to nothing; it looks like radians");
        diagnostics.push(
            Diagnostic::warning(codes::OTHER_SCALE, camera.fov.span, message)
                .expected("an angle in degrees: 40 is a usual one")
                .hint(format!("as radians that is `fov: {:.1}`", fov.to_degrees())),
        );
    }
    let turned = desc.objects.iter().find_map(|object| {
        object.value.transform().iter().find_map(|step| match step.value {
            Transform::Rotate { degrees, .. } if is_radians(degrees) => Some((step.span, degrees)),
            _ => None,
        })
    });
    if let Some((span, degrees)) = turned {
        diagnostics.push(
            Diagnostic::warning(codes::OTHER_SCALE, span, format!("`degrees: {degrees}` looks like radians"))
                .expected("an angle in degrees")
                .hint(format!("as radians that is `degrees: {:.0}`", degrees.to_degrees())),
        );
    }
    if let Some((span, color)) = light_in_bytes(desc) {
        let hex: String = color.iter().map(|channel| format!("{:02x}", *channel as u8)).collect();
        diagnostics.push(
            Diagnostic::warning(codes::OTHER_SCALE, span, "the light looks like a colour in bytes")
                .expected("an amount of light for red, green and blue, without an upper end")
                .hint(format!("write \"#{hex}\" for the colour, or 256 for 255 where the amount is meant")),
        );
    }
    if let Some((span, kelvin)) = lights(desc).find_map(|(amount, color)| Some((amount.span, kelvin(color)?))) {
        let message = format!("the light's `color` of {kelvin} looks like a temperature in kelvin");
        diagnostics.push(
            Diagnostic::warning(codes::OTHER_SCALE, span, message)
                .expected("a colour: how bright it is does not count")
                .hint(format!("write `color: \"=blackbody({kelvin})\"`")),
        );
    }
    diagnostics.extend(f_number(desc));
    diagnostics.extend(in_metres(desc));
    diagnostics.extend(up_along_view(desc));
    let exposure = &desc.effects.exposure;
    let brightest = behind.iter().fold(0.0, |most: f64, channel| most.max(*channel)) * libm::exp2(exposure.value);
    if exposure.value > MOST_STOPS && brightest > MOST_WHITE {
        let times = libm::exp2(exposure.value);
        let message = format!("an `exposure` of {} makes everything {times:.0} times as bright", exposure.value);
        diagnostics.push(
            Diagnostic::warning(codes::OTHER_SCALE, exposure.span, message)
                .expected("stops: each doubles what is seen, 0 leaves it")
                .hint("write `exposure: 0`, and look at the picture"),
        );
    }
}

/// A focal length below this many millimetres is rather one in metres: no lens of a camera is so short.
const SHORTEST: f64 = 1.0;
/// The sine of the angle between `up` and the view below which the picture is turned by chance: ten degrees.
const UPRIGHT: f64 = 0.17;

/// A focal length in metres.
fn in_metres(desc: &SceneDesc) -> Option<Diagnostic> {
    let written = desc.camera.focal_length.as_ref().filter(|length| length.value < SHORTEST)?;
    let message = format!("a `focal_length` of {} mm sees half of all there is; it looks like metres", written.value);
    Some(
        Diagnostic::warning(codes::OTHER_SCALE, written.span, message)
            .expected("a length in millimetres: 50 is a usual one")
            .hint(format!("write `focal_length: {}`", (1e6 * written.value).round() / 1e3)),
    )
}

/// An `up` that is nearly the direction of the view, where another than (0, 1, 0) is written: z is up in other
/// programs.
fn up_along_view(desc: &SceneDesc) -> Option<Diagnostic> {
    let camera = &desc.camera;
    let [eye, look_at, up] = [&camera.position, &camera.look_at, &camera.up].map(|at| DVec3::from(at.value));
    let across = (look_at - eye).normalize_or_zero().cross(up.normalize_or_zero()).length();
    if across >= UPRIGHT || up.x == 0.0 && up.z == 0.0 || camera.matrix.is_some() {
        return None;
    }
    let message = "`up` is nearly the direction of the view: the picture is turned by what little is left of it";
    Some(
        Diagnostic::warning(codes::OTHER_SCALE, camera.up.span, message)
            .expected("the direction that is upwards in the picture, across the view")
            .hint("y is up here: leave `up` out, or write `up: (0, 1, 0)`"),
    )
}

/// A lens whose width is an f-number, or more than half of the way to what is sharp.
fn f_number(desc: &SceneDesc) -> Option<Diagnostic> {
    let lens = desc.effects.depth_of_field.as_ref()?;
    let aperture = lens.aperture.value;
    let eye = desc.camera.position.value;
    let away = match lens.focus.value {
        Focus::Distance(away) => away,
        Focus::On(point) => (0..3).map(|c| (point[c] - eye[c]) * (point[c] - eye[c])).sum::<f64>().sqrt(),
    };
    let is_f_number = F_NUMBERS.contains(&aperture);
    if aperture <= if is_f_number { WIDE } else { WIDEST } * away {
        return None;
    }
    let digits = |x: f64| (x * 1e4).ceil() / 1e4;
    let looks = if is_f_number { "looks like an f-number" } else { "blurs all there is" };
    let message = format!("a lens {aperture} wide, before what is {} away; it {looks}", digits(away));
    Some(
        Diagnostic::warning(codes::OTHER_SCALE, lens.aperture.span, message)
            .expected("the diameter of the lens, in the scene's unit: its focal length over the f-number")
            .hint(format!(
                "a hundredth of the distance, `aperture: {}`, blurs as a portrait lens at f/4 does",
                digits(0.01 * away)
            )),
    )
}

/// The first light whose three numbers are whole, the largest of them 255, and not all the same: light has no upper
/// end, and nobody who means an amount stops just there.
fn light_in_bytes(desc: &SceneDesc) -> Option<(Span, Color)> {
    lights(desc).filter_map(|(amount, _)| of_amount(amount)).find(|(_, color)| {
        let whole = color.iter().all(|channel| channel.fract() == 0.0 && *channel >= 0.0);
        let most = color.iter().fold(0.0, |most: f64, channel| most.max(*channel));
        whole && most == 255.0 && color.iter().any(|channel| *channel != most)
    })
}

/// What lights and materials that shine give, and their colours.
fn lights(desc: &SceneDesc) -> impl Iterator<Item = (&Spanned<Amount>, Color)> {
    fn of_light(light: &Light) -> (&Spanned<Amount>, Color) {
        let Light::SphereLight(light) = light;
        (&light.amount, light.color)
    }
    fn of_material(material: &Material) -> Option<(&Spanned<Amount>, Color)> {
        material.shines().map(|shines| {
            let color = match shines.color.resolved() {
                Albedo::Color(color) => color.value,
                _ => [1.0; 3],
            };
            (&shines.amount, color)
        })
    }
    let inline = with_operands(&desc.objects).filter_map(|object| match object.value.material() {
        MaterialRef::Inline(material) => of_material(&material.value),
        _ => None,
    });
    let named = desc.materials.iter().filter_map(|named| of_material(&named.material));
    desc.lights.iter().map(|light| of_light(&light.value)).chain(named).chain(inline)
}

/// The temperature that a grey colour looks like.
fn kelvin(color: Color) -> Option<f64> {
    let [r, g, b] = color;
    (r == g && g == b && (1000.0..=20000.0).contains(&r)).then_some(r)
}

fn of_amount(amount: &Spanned<Amount>) -> Option<(Span, Color)> {
    match amount.value {
        Amount::Intensity(color) | Amount::Radiance(color) | Amount::Power(color) => Some((amount.span, color)),
        Amount::Luminance(_) | Amount::LuminousIntensity(_) | Amount::LuminousPower(_) => None,
    }
}

/// Whether an angle is one of those that people turn things by, in radians.
fn is_radians(degrees: f64) -> bool {
    TURNS.iter().any(|turn| (degrees.abs() - turn * PI).abs() < 5e-4)
}
