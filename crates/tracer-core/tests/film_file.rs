//! Films that are saved, at the end or at work, and gone on with: the same film as made at once, and nothing taken on
//! trust.

mod film_support;

use film_support::Victim;
use scene_format::{Override, Syntax, load_str};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tracer_core::{
    Costs, Crop, Film, FilmError, FilmState, Misfit, Observer, Plan, Progress, RenderOptions, SavedFilm, Scene,
    Unobserved, compile, render, resume,
};

const SCENE: &str = r#"Scene(
    version: 1,
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 40, height: 24),
    render: Render(max_bounces: 4),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    objects: [
        Sphere(center: (0, -100, 0), radius: 100),
        Sphere(center: (-1, 1, 0), radius: 1, material: Transparent(ior: 1.5)),
        Sphere(center: (1, 1, 0), radius: 1, material: Mirror(reflectance: 0.9)),
    ],
)"#;

fn scene(set: &[&str]) -> Scene {
    let set: Vec<Override> = set.iter().map(|&set| Override::from(set.to_owned())).collect();
    let loaded = load_str("scene.ron", SCENE, Syntax::Ron, Path::new("."), &set).expect("a scene");
    compile(&loaded.scene).expect("nothing to load")
}

/// Scenes whose films differ in kind, and crops of them.
fn cases() -> Vec<(Scene, Option<Crop>)> {
    let lens = ["effects.depth_of_field=ThinLens(aperture: 0.3, focus_distance: 6)"];
    vec![
        (scene(&[]), None),
        (scene(&["render.clamp=0.5"]), Some(Crop { x: 9, y: 3, width: 22, height: 15 })),
        (scene(&lens), None),
        (scene(&["render.integrator=Path"]), Some(Crop { x: 0, y: 5, width: 17, height: 1 })),
        (scene(&["background=(0.1, 0.2, 0.3)", "effects.antialiasing=None"]), None),
        (scene(&["output.layers=[Depth, Normal, ObjectId, Variance]", "render.clamp=0.5"]), None),
        (scene(&["output.light_groups=true"]), None),
        // Each quarter of a sample index sees a moment of its own.
        (scene(&["camera.shutter=0.5", "objects[2].center=(\"=2*time\", 1, 0)"]), None),
    ]
}

fn options(samples: u32, crop: Option<Crop>) -> RenderOptions {
    RenderOptions { samples: Some(samples), crop, threads: 2, ..RenderOptions::default() }
}

fn bytes(film: &Film) -> Vec<u8> {
    let mut bytes = Vec::new();
    film.save(&mut bytes, &[]).expect("memory");
    bytes
}

#[track_caller]
fn assert_same(mut film: Film, mut expected: Film) {
    (film.costs, expected.costs) = (Costs::default(), Costs::default());
    (film.level, film.threads) = (expected.level, expected.threads);
    assert!(film == expected, "{:?} {:?}", film.counters, expected.counters);
}

/// Ends a rendering when so many samples are done, and keeps all states.
struct Watcher {
    end: u64,
    done: AtomicU64,
    writers: Mutex<Vec<std::thread::JoinHandle<Vec<u8>>>>,
}

impl Watcher {
    fn new(end: u64) -> Self {
        Watcher { end, done: AtomicU64::new(0), writers: Mutex::default() }
    }
}

impl Observer for Watcher {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        self.done.fetch_max(progress.samples_done, Ordering::Relaxed);
        if progress.samples_done >= self.end { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn wants_state(&self) -> bool {
        true
    }

    fn state(&self, state: FilmState) {
        self.writers.lock().expect("no panic").push(std::thread::spawn(move || {
            let mut bytes = Vec::new();
            state.save(&mut bytes, &[]).expect("memory");
            bytes
        }));
    }
}

#[test]
fn states_are_the_films_of_so_many_samples() {
    for (scene, crop) in cases() {
        let watcher = Watcher::new(u64::MAX);
        render(&scene, &options(13, crop), &watcher);
        let writers = std::mem::take(&mut *watcher.writers.lock().expect("no panic"));
        assert_eq!(writers.len(), if scene.moves() { 12 } else { 5 }, "after 1, 2, 4, 8 and 12 samples, or all");
        for writer in writers {
            let state = Film::load(&mut writer.join().expect("no panic").as_slice()).expect("a film");
            let samples = state.samples();
            assert_eq!(samples.start(), samples.end());
            assert_same(state, render(&scene, &options(*samples.end(), crop), &Unobserved));
        }
    }
}

#[test]
fn a_film_that_was_ended_anywhere_is_gone_on_with() {
    for (scene, crop) in cases() {
        let at_once = render(&scene, &options(37, crop), &Unobserved);
        let pixels = at_once.crop().width * at_once.crop().height;
        let mut partly = 0;
        for k in (0..13).step_by(2) {
            let end = u64::from(pixels) * (1 + 3 * k * k / 10) - k * 71 % 17;
            // Where one of two threads has ended a pass the other one may just have done the rest.
            let threads = 1 + k as usize % 2;
            let ended = render(&scene, &RenderOptions { threads, ..options(37, crop) }, &Watcher::new(end));
            partly += u32::from(ended.samples().start() != ended.samples().end());
            let film = Film::load(&mut bytes(&ended).as_slice()).expect("a film");
            assert_same(film.clone(), ended);
            // Ended once more, with passes of another length.
            let short = RenderOptions { longest_pass: Some(Duration::from_micros(1)), threads: 3, ..options(37, crop) };
            let ended = resume(&scene, &short, film, &Watcher::new(end + 300)).expect("it fits");
            let film = Film::load(&mut bytes(&ended).as_slice()).expect("a film");
            assert_same(resume(&scene, &options(37, crop), film, &Unobserved).expect("it fits"), at_once.clone());
        }
        // A pass of one sample is over before it could be ended.
        assert!(partly > 1 || scene.moves(), "{partly} were ended within a pass");
    }
}

#[test]
fn passes_of_any_length_make_one_film() {
    let (scene, crop) = &cases()[1];
    let at_once = render(scene, &options(50, *crop), &Unobserved);
    for longest in [Duration::ZERO, Duration::from_millis(3), Duration::from_secs(10)] {
        let short = RenderOptions { longest_pass: Some(longest), ..options(50, *crop) };
        assert_same(render(scene, &short, &Unobserved), at_once.clone());
    }
}

#[test]
fn a_finished_film_is_extended() {
    for (scene, crop) in cases() {
        for (first, more) in [(1, 2), (3, 10), (4, 4), (66, 70)] {
            let film = render(&scene, &options(first, crop), &Unobserved);
            let extended = resume(&scene, &options(more, crop), film, &Unobserved).expect("it fits");
            assert_same(extended, render(&scene, &options(more, crop), &Unobserved));
        }
    }
}

/// Wherever a time ends a rendering, the plan of its film ends another one there.
#[test]
fn a_plan_ends_a_rendering_where_a_time_has_ended_one() {
    let mut planned = 0;
    for (scene, crop) in cases() {
        let at_once = render(&scene, &options(37, crop), &Unobserved);
        let ends = [0, 1, 3, 7, 13, 20].map(Duration::from_millis);
        for until in ends.map(|time| Some(Instant::now() + time)) {
            let ended = render(&scene, &RenderOptions { until, threads: 2, ..options(37, crop) }, &Unobserved);
            let Some(plan) = ended.plan() else { continue };
            planned += 1;
            let again = RenderOptions { plan: Some(plan), threads: 3, ..options(0, crop) };
            let again = render(&scene, &again, &Unobserved);
            assert_eq!(again.plan(), Some(plan));
            assert_same(again.clone(), ended);
            // It goes on as any other.
            assert_same(resume(&scene, &options(37, crop), again, &Unobserved).expect("it fits"), at_once.clone());
        }
        // Where nothing of a pass is on it but light paths, and where all of it is.
        for plan in ["3,4,0,4", "8,16,1,8", "16,24,2,20"].map(|plan| plan.parse::<Plan>().expect("a plan")) {
            let planned = RenderOptions { plan: Some(plan), ..options(0, crop) };
            let (one, two) = (RenderOptions { threads: 1, ..planned }, RenderOptions { threads: 2, ..planned });
            let film = render(&scene, &one, &Unobserved);
            assert_same(film.clone(), render(&scene, &two, &Unobserved));
            assert_same(resume(&scene, &options(37, crop), film, &Unobserved).expect("it fits"), at_once.clone());
        }
    }
    assert!(planned > 3, "{planned} were ended within a pass");
}

#[test]
fn what_does_not_fit_is_refused() {
    let (plain, small) = (scene(&[]), Crop { x: 0, y: 0, width: 8, height: 8 });
    let film = || render(&plain, &options(4, None), &Unobserved);
    let refused = |scene: &Scene, options: RenderOptions, what: Misfit| {
        assert_eq!(resume(scene, &options, film(), &Unobserved).expect_err("it does not fit"), what);
    };
    refused(&plain, options(3, None), Misfit::Samples { held: 4, asked: 3 });
    refused(&plain, options(8, Some(small)), Misfit::Setting("crop"));
    refused(&plain, RenderOptions { seed: Some(1), ..options(8, None) }, Misfit::Setting("seed"));
    refused(&plain, RenderOptions { clamp: Some(1.0), ..options(8, None) }, Misfit::Setting("clamp"));
    refused(&plain, RenderOptions { reuse: Some(false), ..options(8, None) }, Misfit::Setting("reuse"));
    refused(&plain, RenderOptions { caustics: Some(false), ..options(8, None) }, Misfit::Setting("caustics"));
    refused(&scene(&["image.width=41"]), options(8, None), Misfit::Setting("size"));
    // What is done beyond a plan is not taken back.
    let planned = |plan: &str| RenderOptions { plan: Some(plan.parse().expect("a plan")), ..options(0, None) };
    refused(&plain, planned("3,4,1,3"), Misfit::Setting("end"));
    let begun = render(&plain, &planned("4,6,1,4"), &Unobserved);
    assert!(begun.samples().end() > begun.samples().start());
    let error = resume(&plain, &planned("4,6,2,4"), begun, &Unobserved).expect_err("it does not fit");
    assert_eq!(error, Misfit::Setting("end"));
    assert_same(
        resume(&plain, &planned("4,6,1,4"), film(), &Unobserved).expect("it fits"),
        render(&plain, &planned("4,6,1,4"), &Unobserved),
    );
}

#[test]
fn the_head_tells_what_there_is() {
    let (scene, crop) = &cases()[1];
    let film = render(scene, &options(5, *crop), &Unobserved);
    let mut file = Vec::new();
    let notes = [("scene".to_owned(), "häuser.ron".to_owned()), (String::new(), "x".repeat(100_000))];
    assert_eq!(film.save(&mut file, &notes).expect("memory"), file.len() as u64);
    let saved = SavedFilm::open(file.as_slice()).expect("a film");
    let head = saved.head().clone();
    assert_eq!((head.size, Some(head.crop), head.seed, head.clamp), ([40, 24], *crop, 0, Some(0.5)));
    assert_eq!((head.samples.clone(), head.counters), (5..=5, film.counters));
    assert_eq!(head.notes, notes);
    assert_eq!(saved.check().expect("whole"), head);
}

/// Cut anywhere, with a bit or byte changed anywhere, with numbers that lie and a checksum that fits: an error, soon,
/// in little memory.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn mutants_are_refused() {
    for (layers, groups) in [("[]", false), ("[Depth, MaterialId]", false), ("[]", true)] {
        mutants_of(&scene(&[
            "image.width=20",
            "image.height=20",
            "render.clamp=0.5",
            &format!("output.layers={layers}"),
            &format!("output.light_groups={groups}"),
        ]));
    }
}

fn mutants_of(scene: &Scene) {
    let ended = render(scene, &options(6, None), &Watcher::new(900));
    let file = bytes(&ended);
    assert!(ended.samples().end() > ended.samples().start());
    for len in (0..300).chain((300..file.len()).step_by(37)) {
        let error = Film::load(&mut &file[..len]).expect_err("it is cut");
        assert!(matches!(error, FilmError::Damaged(_)), "{len}: {error}");
    }
    let refused = |mutant: &[u8]| Film::load(&mut &*mutant).is_err();
    Victim::new(&file).each(3000, refused, |mutant| {
        // What is read is a film, or an error.
        if let Ok(film) = Film::load(&mut &*mutant) {
            film.samples();
            // What fits the scene can be gone on with, whatever is in it.
            let _ = resume(scene, &options(8, None), film, &Watcher::new(0));
        }
    });
    assert!(matches!(Film::load(&mut &b"Scene(objects: [])"[..]), Err(FilmError::Foreign)));
    let mut later = file.clone();
    later[8] += 1;
    assert!(matches!(Film::load(&mut later.as_slice()), Err(FilmError::Format(found)) if found == u32::from(later[8])));
}
