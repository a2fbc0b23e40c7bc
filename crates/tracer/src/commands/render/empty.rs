//! Pictures that show nothing, or next to nothing.

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

/// What is said of a picture that is nearly black, white, or nothing but background. A part of one (`--crop`) may well
/// be. Where it was said before why, nothing.
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

/// What is hard to tell from black on a screen: 10 of 255, by the slope of sRGB next to black (IEC 61966-2-1).
const DARK: f64 = 10.0 / 255.0 / 12.92;
/// What clipping has taken the colour of.
const WHITE: f64 = 2.0;

/// Of a picture in which there is light, but 99 of 100 pixels are dark.
fn dark(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    let brightest = || shown(film, desc, |radiance| radiance.into_iter().fold(0.0, f64::max));
    let pixels = film.size().map(|side| side as usize).iter().product::<usize>();
    let is_dark =
        is_plain(desc) && pixels > 0 && brightest().filter(|light| *light >= DARK).nth(pixels / 100).is_none();
    // Of little in the dark the rest may be meant: stars.
    let most = if is_dark { brightest().fold(0.0, f64::max) } else { 0.0 };
    if most == 0.0 || most >= 0.5 {
        return None;
    }
    let mut sorted: Vec<f64> = brightest().collect();
    let (_, bright, _) = sorted.select_nth_unstable_by(pixels - 1 - pixels / 100, f64::total_cmp);
    let of = if *bright > 0.0 { *bright } else { most };
    let message = "the picture is so dark that nearly all is black";
    Some(
        Diagnostic::warning(codes::ALL_BLACK, desc.effects.exposure.span, message)
            .expected("what is seen between black, 0, and white, 1")
            .hint(way(desc, 0.5 / of, "brighter lights")),
    )
}

/// Of a picture three quarters of which are white twice over, in every channel.
fn white(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    let least = || shown(film, desc, |radiance| radiance.into_iter().fold(f64::INFINITY, f64::min));
    let pixels = film.size().map(|side| side as usize).iter().product::<usize>();
    if !is_plain(desc) || pixels == 0 || least().filter(|light| *light < WHITE).nth(pixels / 4).is_some() {
        return None;
    }
    let mut sorted: Vec<f64> = least().collect();
    let (_, pale, _) = sorted.select_nth_unstable_by(pixels / 4, f64::total_cmp);
    let message = match least().all(|light| light >= WHITE) {
        true => "the picture is white",
        false => "most of the picture is white",
    };
    Some(
        Diagnostic::warning(codes::ALL_WHITE, desc.effects.exposure.span, message)
            .expected("what is seen between black, 0, and white, 1")
            .hint(way(desc, 0.5 / *pale, "a darker background, darker lights")),
    )
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

/// What makes a picture so many times as bright.
fn way(desc: &SceneDesc, factor: f64, lights: &str) -> String {
    let exposure = (desc.effects.exposure.value + factor.log2()).round();
    format!("try `--set effects.exposure={exposure}`, where 1 more is twice as bright, or take {lights}")
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
