//! Adaptive sampling: a film whose quiet tiles rest is the same for any threads, lanes, crops, passes and parts; saved
//! anywhere it goes on; and where nothing would be gained no tile rests.

mod film_support;

use film_support::{Random, Victim};
use scene_format::{Override, Syntax, load_str};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};
use tracer_core::{
    Costs, Crop, Film, FilmHead, Gaps, Level, MergeError, Misfit, Observer, Part, Plan, Progress, RenderOptions,
    SavedFilm, Scene, Split, Unobserved, compile, render, resume,
};

/// A ball of glass and one of metal on a disk in the right half, beside a small lamp; the sky is quiet.
const SCENE: &str = r#"Scene(
    version: 1,
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 72, height: 56),
    background: (0.2, 0.3, 0.4),
    render: Render(max_bounces: 4, adaptive: Always, caustics: None),
    lights: [SphereLight(center: (4, 5, 1), radius: 0.1, radiance: 3000, group: "key")],
    objects: [
        Disk(center: (1.3, 0, 0.3), radius: 1.3, normal: (0, 1, 0)),
        Sphere(center: (1.6, 0.6, 0), radius: 0.6, material: Transparent(ior: 1.5)),
        Sphere(center: (0.6, 0.3, 0.8), radius: 0.3, material: Conductor(metal: Gold, roughness: 0.1)),
    ],
)"#;

fn scene(set: &[&str]) -> Scene {
    let set: Vec<Override> = set.iter().map(|&set| Override::from(set.to_owned())).collect();
    let loaded = load_str("scene.ron", SCENE, Syntax::Ron, Path::new("."), &set).expect("a scene");
    compile(&loaded.scene).expect("nothing to load")
}

/// A room of white walls around the camera, lit by half of its ceiling.
fn even_room(set: &[&str]) -> Scene {
    let text = "Scene(image: Image(width: 64, height: 64), render: Render(adaptive: Always), \
                camera: Camera(position: (0, 0, 0), look_at: (0, 0, -1), fov: 60), \
                objects: [Sphere(center: (0, 0, 0), radius: 4, material: Emissive(radiance: 1)), \
                          Sphere(center: (0, 0, -2), radius: 0.9, material: Diffuse(albedo: 0.5))])";
    let set: Vec<Override> = set.iter().map(|&set| Override::from(set.to_owned())).collect();
    compile(&load_str("room.ron", text, Syntax::Ron, Path::new("."), &set).expect("a scene").scene).expect("nothing")
}

fn options(samples: u32) -> RenderOptions {
    RenderOptions { samples: Some(samples), threads: 2, ..RenderOptions::default() }
}

fn bytes(film: &Film) -> Vec<u8> {
    let mut bytes = Vec::new();
    film.save(&mut bytes, &[]).expect("memory");
    bytes
}

fn without_time(mut film: Film) -> Film {
    (film.costs, film.threads, film.level) = (Costs::default(), 1, Level::best());
    film
}

#[track_caller]
fn assert_same(film: Film, expected: &Film) {
    assert!(without_time(film) == without_time(expected.clone()));
}

fn pixels(crop: Crop) -> impl Iterator<Item = (u32, u32)> {
    (crop.y..crop.y + crop.height).flat_map(move |y| (crop.x..crop.x + crop.width).map(move |x| (x, y)))
}

/// Films that differ in kind.
fn cases() -> Vec<Scene> {
    vec![
        scene(&[]),
        scene(&["output.light_groups=true", "render.clamp=20"]),
        scene(&["output.layers=[Depth, Normal, Samples, Variance]", "output.alpha=true"]),
        scene(&["render.integrator=Path"]),
        // Light paths fall on it.
        scene(&["render.caustics=Photons", "objects[1].radius=0.35"]),
        // And pixels share: within a ball.
        scene(&[
            "render.caustics=Photons",
            "background=0",
            "objects[0]=Sphere(center: (0, 4, 0), radius: 7, material: Diffuse(albedo: 0.3))",
            "lights[0].radius=0.4",
        ]),
    ]
}

#[test]
fn quiet_tiles_rest_and_others_do_not() {
    let film = render(&scene(&[]), &options(256), &Unobserved);
    assert!(film.is_adaptive());
    assert_eq!((film.samples(), *film.samples_of_pixels().end()), (256..=256, 256));
    // 64, and one in eight of the others.
    assert_eq!(*film.samples_of_pixels().start(), 64 + 192 / 8);
    let mean = film.camera_samples() as f64 / (72.0 * 56.0);
    assert!(mean < 0.8 * 256.0, "{mean}");
    // Nobody rests before it is decided, and where all is even.
    for (scene, samples) in [(scene(&[]), 64), (even_room(&[]), 256), (scene(&["render.adaptive=Never"]), 128)] {
        let film = render(&scene, &options(samples), &Unobserved);
        assert!(!film.is_adaptive());
        assert_eq!(film.samples_of_pixels(), samples..=samples);
    }
}

/// Whatever makes it, it is one film.
#[test]
fn threads_lanes_and_passes_do_not_show() {
    for scene in cases() {
        let film = render(&scene, &options(150), &Unobserved);
        assert!(film.is_adaptive());
        assert!(film.light_groups().is_empty() || film.groups_are_all());
        for (threads, level) in (1..).zip(Level::available()) {
            let other = RenderOptions { threads, level: Some(level), ..options(150) };
            assert_same(render(&scene, &other, &Unobserved), &film);
        }
        for longest in [Duration::ZERO, Duration::from_millis(2)] {
            let short = RenderOptions { longest_pass: Some(longest), threads: 3, ..options(150) };
            assert_same(render(&scene, &short, &Unobserved), &film);
        }
        let crop = Crop { x: 21, y: 11, width: 30, height: 23 };
        let part = render(&scene, &RenderOptions { crop: Some(crop), ..options(150) }, &Unobserved);
        for (x, y) in pixels(crop) {
            assert_eq!((part.radiance(x, y), part.variance(x, y)), (film.radiance(x, y), film.variance(x, y)));
        }
    }
}

/// Ends a rendering when so many samples are done.
struct EndAfter(u64);

impl Observer for EndAfter {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        assert!(progress.samples_done <= progress.samples_total);
        if progress.samples_done >= self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn it_is_gone_on_with_wherever_it_was_ended() {
    let mut random = Random(5);
    for scene in cases() {
        let at_once = render(&scene, &options(140), &Unobserved);
        for _ in 0..3 {
            let mut film = None;
            // Some ends are before it is decided which tiles rest, while it is, or after.
            for end in [64 * 4032 - 1 + random.below(3) as u64, 64 * 4032 + random.below(150_000) as u64] {
                let options = RenderOptions { threads: 1 + random.below(3), ..options(140) };
                let ended = match film {
                    None => render(&scene, &options, &EndAfter(end)),
                    Some(film) => resume(&scene, &options, film, &EndAfter(end)).expect("it fits"),
                };
                film = Some(Film::load(&mut bytes(&ended).as_slice()).expect("a film"));
                assert_same(film.clone().expect("it was loaded"), &ended);
            }
            let whole = resume(&scene, &options(140), film.expect("two ends"), &Unobserved).expect("it fits");
            assert_same(whole, &at_once);
        }
        // Extended, from before and after it was decided; by the time, and as that has ended it.
        for first in [30, 64, 65, 100] {
            let film = render(&scene, &options(first), &Unobserved);
            assert_same(resume(&scene, &options(140), film, &Unobserved).expect("it fits"), &at_once);
        }
    }
}

#[test]
fn a_plan_ends_it_where_a_time_has_ended_it() {
    let scene = scene(&["render.caustics=Photons", "objects[1].radius=0.35"]);
    let mut planned = 0;
    for milliseconds in 0..40 {
        let until = Some(Instant::now() + Duration::from_millis(20 * milliseconds));
        let ended = render(&scene, &RenderOptions { until, ..options(3000) }, &Unobserved);
        let Some(plan) = ended.plan().filter(|_| ended.is_adaptive()) else { continue };
        planned += 1;
        assert_same(render(&scene, &RenderOptions { plan: Some(plan), ..options(0) }, &Unobserved), &ended);
        if planned == 4 {
            break;
        }
    }
    assert!(planned > 0, "some are ended while tiles rest");
    let plan = |text: &str| Some(text.parse::<Plan>().expect("a plan"));
    for plan in [plan("64,68,0,66"), plan("72,80,5,80")] {
        let film = render(&scene, &RenderOptions { plan, ..options(0) }, &Unobserved);
        assert!(film.is_adaptive() && film.plan() == plan);
        let whole = resume(&scene, &options(140), film, &Unobserved).expect("it fits");
        assert_same(whole, &render(&scene, &options(140), &Unobserved));
    }
}

/// Each decides for itself which tiles rest, and all decide the same.
#[test]
fn parts_are_the_film_of_one_machine() {
    let mut random = Random(9);
    for (scene, has_light_paths) in cases().into_iter().zip([false, false, false, false, true, true]) {
        let whole = Crop::whole(scene.size);
        let merged = |files: &[Vec<u8>], gaps: Gaps| {
            let open = |file: &Vec<u8>| SavedFilm::open(file.as_slice()).expect("a head").head().clone();
            let heads: Vec<FilmHead> = files.iter().map(open).collect();
            Film::merge(&heads, |part| SavedFilm::open(files[part].as_slice()), gaps)
        };
        // Of parts nobody knows the noise as of the whole.
        let at_once =
            merged(&[bytes(&render(&scene, &options(160), &Unobserved))], Gaps::Refused).expect("it is whole");
        for (split, count) in [(Split::Samples, 2), (Split::Samples, 5), (Split::Rows, 3)] {
            let part = |k: u32| {
                let part = Part::of(whole, 160, split, k, count);
                let threads = 1 + random.below(3);
                let film = render(&scene, &RenderOptions { part, threads, ..RenderOptions::default() }, &Unobserved);
                bytes(&film)
            };
            let files: Vec<Vec<u8>> = (1..=count).map(part).collect();
            let mut film = merged(&files, Gaps::Refused).expect("all parts");
            // Parts by rows trace what they have in common each for itself.
            film.counters = at_once.counters;
            assert_same(film, &at_once);
            let some = merged(&files[1..], Gaps::Allowed);
            match split {
                Split::Samples if has_light_paths => assert!(matches!(some, Err(MergeError::Resting)), "{some:?}"),
                Split::Samples => assert!(some.is_ok(), "{some:?}"),
                Split::Rows => {
                    let some = some.expect("rows are black");
                    let last = (whole.width - 1, whole.height - 1);
                    assert!(
                        split == Split::Samples || some.radiance(last.0, last.1) == at_once.radiance(last.0, last.1)
                    );
                }
            }
        }
        let even =
            RenderOptions { part: Part::of(whole, 160, Split::Samples, 2, 2), adaptive: Some(false), ..options(0) };
        let first = RenderOptions { part: Part::of(whole, 160, Split::Samples, 1, 2), ..options(0) };
        let files = [first, even].map(|options| bytes(&render(&scene, &options, &Unobserved)));
        let foreign = merged(&files, Gaps::Refused);
        assert!(matches!(foreign, Err(MergeError::Foreign { what: "plan of adaptive sampling", .. })), "{foreign:?}");
    }
}

#[test]
fn another_choice_is_refused() {
    let (always, never) = (scene(&[]), scene(&["render.adaptive=Never"]));
    let misfit = Misfit::Setting("choice of adaptive sampling");
    let film = |scene: &Scene, samples: u32| render(scene, &options(samples), &Unobserved);
    assert_eq!(resume(&never, &options(200), film(&always, 100), &Unobserved).err(), Some(misfit));
    assert_eq!(resume(&always, &options(200), film(&never, 100), &Unobserved).err(), Some(misfit));
    // Before anything is decided nothing is lost; and who says nothing takes it as it is.
    assert!(!resume(&never, &options(100), film(&always, 64), &Unobserved).expect("it fits").is_adaptive());
    let unsaid = scene(&["render.adaptive=WithNoise"]);
    let film = resume(&unsaid, &options(140), film(&always, 100), &Unobserved).expect("it fits");
    assert_same(film, &render(&always, &options(140), &Unobserved));
}

/// With a noise goal tiles rest where it is far away, unless that is not wanted; and the noise is reached.
#[test]
fn a_noise_goal_lets_tiles_rest() {
    let of = |set: &[&str], noise: f64| {
        render(&scene(set), &RenderOptions { noise: Some(noise), ..options(4096) }, &Unobserved)
    };
    let unsaid = ["render.adaptive=WithNoise"];
    let at_64 = render(&scene(&unsaid), &options(64), &Unobserved).relative_noise();
    let (far, near) = (of(&unsaid, 0.5 * at_64), of(&unsaid, 0.8 * at_64));
    assert!(far.is_adaptive() && !near.is_adaptive());
    assert!(far.relative_noise() <= 0.5 * at_64 && near.relative_noise() <= 0.8 * at_64);
    let never = of(&["render.adaptive=Never"], 0.5 * at_64);
    assert!(!never.is_adaptive());
    let fewer = far.camera_samples() as f64 / never.camera_samples() as f64;
    assert!(fewer < 0.8, "{fewer}");
    // Where something moves all take all.
    let moving = scene(&["camera.shutter=0.5", "objects[2].center=(\"=0.6 + time\", 0.3, 1)"]);
    assert!(!render(&moving, &options(130), &Unobserved).is_adaptive());
}

/// A file that lies about which tiles rest is an error, or a film.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn mutants_are_refused() {
    let scene = scene(&[]);
    let ended = render(&scene, &options(100), &EndAfter(64 * 4032 + 20_000));
    assert!(ended.is_adaptive());
    let refused = |mutant: &[u8]| Film::load(&mut &*mutant).is_err();
    Victim::new(&bytes(&ended)).each(3000, refused, |mutant| {
        if let Ok(film) = Film::load(&mut &*mutant) {
            film.samples_of_pixels();
            let _ = resume(&scene, &options(102), film, &EndAfter(0));
        }
    });
}
