//! Pictures that show nothing.

use scene_format::codes::Code;
use scene_format::desc::{Background, Integrator, ToneMap};
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

/// What is said of a picture that is black, white, or nothing but background. A part of one (`--crop`) may well be.
/// Where it was said before why, nothing.
pub(super) fn warning(film: &Film, desc: &SceneDesc, scene: &Scene) -> Option<Diagnostic> {
    let fault = of_picture(film, desc, scene)?;
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
    empty(film, desc).or_else(|| dark(film, desc)).or_else(|| white(film, desc))
}

/// What an eight-bit picture shows as black: half of a 255th, which is where sRGB is linear (IEC 61966-2-1).
const BLACK: f64 = 0.5 / 255.0 / 12.92;

/// Of a picture in which there is light, but so little that all of it is shown black.
fn dark(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    // A curve lifts what is dark, and before a backdrop little may be seen.
    if desc.effects.tone_map != ToneMap::None || desc.output.backdrop.is_some() {
        return None;
    }
    let [width, height] = film.size();
    let exposed = desc.effects.exposure.value.exp2();
    let is_black = |x: u32, y: u32| film.radiance(x, y).iter().all(|channel| channel * exposed < BLACK);
    let all = (0..height).all(|y| (0..width).all(|x| is_black(x, y)));
    all.then(|| {
        Diagnostic::warning(codes::ALL_BLACK, desc.effects.exposure.span, "the picture is so dark that all is black")
            .expected("what is seen between black, 0, and white, 1")
            .hint("take brighter lights or a higher `exposure`: 1 more is twice as bright")
    })
}

/// Of a picture that is white twice over, in every channel of every pixel.
fn white(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    // A curve brings something back, and before a backdrop little may be seen.
    if desc.effects.tone_map != ToneMap::None || desc.output.backdrop.is_some() {
        return None;
    }
    let [width, height] = film.size();
    let exposed = desc.effects.exposure.value.exp2();
    let is_white = |x: u32, y: u32| film.radiance(x, y).iter().all(|channel| channel * exposed >= 2.0);
    (0..height).all(|y| (0..width).all(|x| is_white(x, y))).then(|| {
        Diagnostic::warning(codes::ALL_WHITE, desc.effects.exposure.span, "the picture is white")
            .expected("what is seen between black, 0, and white, 1")
            .hint("take a darker background, darker lights, or a lower `exposure`; a bright sky is about 1")
    })
}

fn empty(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
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
        let hint = if background == [0.0; 3] {
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
    // What is as bright as the background may be an object in it: then rays went on from there.
    if film.counters.scattered_rays + film.counters.shadow_rays + film.counters.segments > 0 {
        return None;
    }
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-5 * b.abs();
    let shown = std::array::from_fn::<_, 3, _>(|channel| near(first[channel], background[channel]));
    (shown == [true; 3] && background != [0.0; 3]).then(|| {
        Diagnostic::warning(codes::NOTHING_IN_VIEW, span, "nothing is in view: the picture is the background alone")
            .expected("objects between the camera and where it looks")
            .hint("set `look_at` to the middle of an object; `tracer info` tells where the objects are")
    })
}
