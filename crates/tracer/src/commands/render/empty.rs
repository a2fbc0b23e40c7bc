//! Pictures that show nothing, or next to nothing.

use scene_format::codes::Code;
use scene_format::desc::{Background, Integrator, Light, MaterialRef, Object, ToneMap};
use scene_format::{Diagnostic, SceneDesc, codes};
use tracer_core::{Crop, Film, Scene};

/// What said before why a picture is black.
const WHY_BLACK: [Code; 6] = [
    codes::BLACK_PICTURE,
    codes::CAMERA_SHUT_IN,
    codes::LIGHT_SHUT_IN,
    codes::NOTHING_IN_VIEW,
    codes::UNSEEN_LIGHT,
    codes::DARK_LAMP,
];

/// What is said of a picture that is nearly black, white, or nothing but background. A part of one (`--crop`) may well
/// be. Where it was said before why, nothing. `is_exposed`: an option has said how bright it is shown.
pub(super) fn warning(film: &Film, desc: &SceneDesc, scene: &Scene, is_exposed: bool) -> Option<Diagnostic> {
    let mut fault = of_picture(film, desc, scene)?;
    if is_exposed {
        // The option counts more than what is set.
        fault.hint = fault.hint.replace("--set effects.exposure=", "--exposure ");
    }
    // That there is no light at all whoever reads a scene tells.
    let no_light = desc.background.is_black() && tracer_core::shining_objects(scene) == 0 && !is_without_light(desc);
    let is_told = no_light || scene.warnings.iter().any(|told| WHY_BLACK.contains(&told.code));
    (fault.code != codes::ALL_BLACK || !is_told).then_some(fault)
}

/// Whether the picture is of no light, so that a scene needs none.
fn is_without_light(desc: &SceneDesc) -> bool {
    matches!(desc.render.integrator, Integrator::AmbientOcclusion { .. })
}

fn of_picture(film: &Film, desc: &SceneDesc, scene: &Scene) -> Option<Diagnostic> {
    if scene.warnings.iter().any(|told| told.code == codes::NOTHING_IN_VIEW) {
        return None;
    }
    if film.crop() != Crop::whole(film.size()) {
        return None;
    }
    empty(film, desc, scene).or_else(|| dark(film, desc)).or_else(|| white(film, desc)).or_else(|| clipped(film, desc))
}

/// What is hard to tell from black on a screen: 10 of 255, by the slope of sRGB next to black (IEC 61966-2-1).
const DARK: f64 = 10.0 / 255.0 / 12.92;
/// What is seen, but hardly what it is: 38 of 255.
const DIM: f64 = 0.02;
/// What clipping has taken the colour of.
const WHITE: f64 = 2.0;
/// What has another colour than it should, by clipping of a channel.
const CLIPPED: f64 = 1.25;
/// More of what is seen is clipped than is windows and gleams.
const MOST_CLIPPED: f64 = 0.25;
/// With more noise what is clipped is chance.
const MOST_NOISE: f64 = 0.25;
/// Of so many pixels that are not of the background alone something is said; of fewer, the rest may be meant.
const MOST_BACKGROUND: f64 = 0.9;

/// Of a picture in which there is light, but 99 of 100 pixels are dark, or three quarters of what is no background dim.
fn dark(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    if !is_plain(desc) {
        return None;
    }
    let brightest = |radiance: [f64; 3]| radiance.into_iter().fold(0.0, f64::max);
    let all: Vec<f64> = shown(film, desc, brightest).collect();
    let most = all.iter().copied().fold(0.0, f64::max);
    let is_dark = all.iter().filter(|light| **light >= DARK).nth(all.len() / 100).is_none();
    // Of little in the dark the rest may be meant: stars.
    if is_dark && most > 0.0 && most < 0.5 {
        let bright = at_share(all, 0.99);
        let of = if bright > 0.0 { bright } else { most };
        return Some(too_dark(desc, "the picture is so dark that nearly all is black", of));
    }
    let lit = without_background(film, desc, brightest);
    if is_dark || (lit.len() as f64) < (1.0 - MOST_BACKGROUND) * all.len() as f64 {
        return None;
    }
    let bright = at_share(lit, 0.75);
    (bright < DIM).then(|| too_dark(desc, "most of the picture is nearly black", 2.0 * bright))
}

/// The picture is; `of`: what ought to be half of white.
fn too_dark(desc: &SceneDesc, message: &'static str, of: f64) -> Diagnostic {
    Diagnostic::warning(codes::ALL_BLACK, desc.effects.exposure.span, message)
        .expected("what is seen between black, 0, and white, 1")
        .hint(way(desc, 0.5 / of, "brighter lights"))
}

/// Of a picture three quarters of which are white twice over, in every channel, or of that which is no background.
fn white(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    if !is_plain(desc) {
        return None;
    }
    let least = |radiance: [f64; 3]| radiance.into_iter().fold(f64::INFINITY, f64::min);
    let all: Vec<f64> = shown(film, desc, least).collect();
    let seen = without_background(film, desc, least);
    let is_white = |of: &[f64]| of.iter().filter(|light| **light < WHITE).nth(of.len() / 4).is_none();
    let message = match &*all {
        [] => return None,
        all if all.iter().all(|&light| light >= WHITE) => "the picture is white",
        all if is_white(all) => "most of the picture is white",
        all if (seen.len() as f64) < (1.0 - MOST_BACKGROUND) * all.len() as f64 || !is_white(&seen) => return None,
        _ => "most of what is seen before the background is white",
    };
    let pale = if message.contains("before") { at_share(seen, 0.25) } else { at_share(all, 0.25) };
    // Of what is bright in one channel alone nothing is to be told afterwards.
    let brightest = |radiance: [f64; 3]| radiance.into_iter().fold(0.0, f64::max);
    let bright = without_background(film, desc, brightest);
    let is_clipped = |factor: f64| {
        let clipped = bright.iter().filter(|light| factor * **light > CLIPPED).count();
        clipped as f64 >= MOST_CLIPPED * bright.len() as f64
    };
    let factor = 0.5 / pale;
    let factor =
        if bright.is_empty() || !is_clipped(factor) { factor } else { factor.min(1.0 / at_share(bright, 0.9)) };
    Some(
        Diagnostic::warning(codes::ALL_WHITE, desc.effects.exposure.span, message)
            .expected("what is seen between black, 0, and white, 1")
            .hint(way(desc, factor, "a darker background, darker lights")),
    )
}

/// Of a picture in which a channel is clipped in a quarter of what is no background, lamps that are seen left out: they
/// have no noise.
fn clipped(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    if !is_plain(desc) || film.relative_noise() > MOST_NOISE {
        return None;
    }
    let brightest = |radiance: [f64; 3]| radiance.into_iter().fold(0.0, f64::max);
    let seen = without_background(film, desc, brightest);
    let [width, height] = film.size().map(f64::from);
    let exposed = desc.effects.exposure.value.exp2();
    let [columns, rows] = film.size();
    let is_of_lamp = |x: u32, y: u32| x > 0 && film.radiance(x, y) == film.radiance(x - 1, y);
    let bright = (0..rows)
        .flat_map(|y| (0..columns).map(move |x| (x, y)))
        .filter(|&(x, y)| exposed * brightest(film.radiance(x, y)) > CLIPPED && !is_of_lamp(x, y));
    let share = bright.count() as f64 / seen.len().max(1) as f64;
    if share < MOST_CLIPPED || (seen.len() as f64) < (1.0 - MOST_BACKGROUND) * width * height {
        return None;
    }
    let message = format!("{:.0} % of what is seen is too bright to have its colour", 100.0 * share);
    Some(
        Diagnostic::warning(codes::ALL_WHITE, desc.effects.exposure.span, message)
            .expected("what is seen between black, 0, and white, 1, in each channel")
            .hint(way(desc, 1.0 / at_share(seen, 0.9), "darker lights")),
    )
}

/// The number below which this share of some lies; there are some.
fn at_share(mut of: Vec<f64>, share: f64) -> f64 {
    let place = ((of.len() - 1) as f64 * share) as usize;
    *of.select_nth_unstable_by(place, f64::total_cmp).1
}

/// What is brightest or least of those pixels that are not the background alone, nor black.
fn without_background(film: &Film, desc: &SceneDesc, of: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
    let background = match &desc.background {
        Background::Color(color) => color.map(|x| x as f32),
        Background::Environment(_) => [0.0; 3],
    };
    let exposed = desc.effects.exposure.value.exp2();
    let [width, height] = film.size();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let radiance = pixels.map(|(x, y)| film.radiance(x, y));
    let near = |a: f64, b: f32| (a - f64::from(b)).abs() <= 1e-5 * f64::from(b);
    let plain = |pixel: &[f64; 3]| *pixel == [0.0; 3] || (0..3).all(|c| near(pixel[c], background[c]));
    radiance.filter(|pixel| !plain(pixel)).map(|pixel| exposed * of(pixel)).collect()
}

/// Whether the picture shows light as it is: a curve lifts what is dark and brings back what is bright, and before a
/// backdrop little may be seen.
fn is_plain(desc: &SceneDesc) -> bool {
    desc.effects.tone_map == ToneMap::None && desc.output.backdrop.is_none() && !desc.output.alpha
}

/// What is brightest or least of each pixel as the picture shows it.
fn shown(film: &Film, desc: &SceneDesc, of: impl Fn([f64; 3]) -> f64) -> impl Iterator<Item = f64> {
    let [width, height] = film.size();
    let exposed = desc.effects.exposure.value.exp2();
    let pixels = (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)));
    pixels.map(move |(x, y)| exposed * of(film.radiance(x, y)))
}

/// What makes a picture so many times as bright, or a little more than that.
fn way(desc: &SceneDesc, factor: f64, lights: &str) -> String {
    let exposure = exposure(desc.effects.exposure.value, factor);
    format!("try `--set effects.exposure={exposure}`, where 1 more is twice as bright, or take {lights}")
}

/// A whole one, away from the present one: rounded to the other side it might be that.
fn exposure(present: f64, factor: f64) -> f64 {
    let exact = present + factor.log2();
    // Zero has no sign.
    0.0 + if factor > 1.0 { exact.ceil() } else { exact.floor() }
}

fn empty(film: &Film, desc: &SceneDesc, scene: &Scene) -> Option<Diagnostic> {
    let [width, height] = film.size();
    let first = film.radiance(0, 0);
    let same = (0..height).all(|y| (0..width).all(|x| film.radiance(x, y) == first));
    if !same {
        return None;
    }
    let span = desc.camera.look_at.span;
    let background = match &desc.background {
        Background::Color(color) => *color,
        // It has one colour only where the camera does not see it.
        Background::Environment(_) => [0.0; 3],
    };
    if first == [0.0; 3] {
        // Whether a scene has light at all is told before.
        let behind = behind_a_plane(desc);
        let hint = if let Some(why) = &behind {
            why
        } else if background == [0.0; 3] {
            "look at where the camera stands and looks, and whether a light reaches what it sees"
        } else {
            "not even the background is seen: the camera stands within an object or right before one; move it"
        };
        return Some(
            Diagnostic::warning(codes::ALL_BLACK, span, "the picture is black")
                .expected("objects in view that light falls on")
                .hint(hint),
        );
    }
    // What is as bright as the background may be an object in it: then rays went on from there, unless it shines.
    let inline = |object: &Object| matches!(object.material(), MaterialRef::Inline(of) if of.value.shines().is_some());
    let shine = desc.materials.iter().any(|named| named.material.shines().is_some());
    if shine || desc.objects.iter().any(|object| inline(&object.value)) {
        return None;
    }
    if film.counters.scattered_rays + film.counters.shadow_rays + film.counters.segments > 0 {
        return None;
    }
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-5 * b.abs();
    let shown = std::array::from_fn::<_, 3, _>(|channel| near(first[channel], background[channel]));
    (shown == [true; 3] && background != [0.0; 3]).then(|| {
        Diagnostic::warning(codes::NOTHING_IN_VIEW, span, "nothing is in view: the picture is the background alone")
            .expected("objects between the camera and where it looks")
            .hint(tracer_core::way_into_view(desc, scene))
    })
}

/// Of a black picture: that the camera or all lamps are on the other side of a plane.
fn behind_a_plane(desc: &SceneDesc) -> Option<String> {
    let planes = desc.objects.iter().enumerate().filter_map(|(k, object)| match &object.value {
        Object::Plane(plane) if plane.transform.is_empty() => Some((k, plane)),
        _ => None,
    });
    let eye = desc.camera.position.value;
    let center = |Light::SphereLight(lamp): &Light| lamp.center.value;
    let lamps: Vec<[f64; 3]> = desc.lights.iter().map(|light| center(&light.value)).collect();
    for (k, plane) in planes {
        let (point, normal) = (plane.point.value, plane.normal.value);
        let height = |p: [f64; 3]| (0..3).map(|c| (p[c] - point[c]) * normal[c]).sum::<f64>();
        if lamps.is_empty() || lamps.iter().any(|lamp| (height(*lamp) < 0.0) == (height(eye) < 0.0)) {
            continue;
        }
        let who = if height(eye) < 0.0 { "the camera is" } else { "the lights are" };
        let facing = normal.map(|x| format!("{x}")).join(", ");
        return Some(format!("{who} behind the plane objects[{k}], which faces ({facing}): move them, or the plane"));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::exposure;

    #[test]
    fn another_exposure_is_asked_for() {
        let asked = [(0.0, 0.9), (0.0, 1.1), (-1.0, 1.3), (1.0, 1.01), (-0.5, 0.2), (0.3, 0.9)];
        let said = asked.map(|(present, factor)| exposure(present, factor).to_string());
        assert_eq!(said, ["-1", "1", "0", "2", "-3", "0"]);
    }
}
