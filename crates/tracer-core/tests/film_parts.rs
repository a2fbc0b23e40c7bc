//! Parts of a rendering, made anyhow and merged in any order: the film of one machine, and nothing taken on trust.

mod film_support;

use film_support::{Random, Victim};
use scene_format::{Override, Syntax, load_str};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use tracer_core::{
    Costs, Counters, Crop, Film, FilmError, FilmHead, Gap, Gaps, Level, MergeError, Misfit, Observer, Part, Progress,
    RenderOptions, SavedFilm, Scene, Split, Unobserved, compile, film_faults, render, resume,
};

const SCENE: &str = r#"Scene(
    version: 1,
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 40, height: 56),
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

fn bytes(film: &Film) -> Vec<u8> {
    let mut bytes = Vec::new();
    film.save(&mut bytes, &[]).expect("memory");
    bytes
}

fn open(file: &[u8]) -> Result<SavedFilm<&[u8]>, FilmError> {
    SavedFilm::open(file)
}

fn merge(files: &[Vec<u8>], gaps: Gaps) -> Result<Film, MergeError> {
    let heads: Vec<FilmHead> = files.iter().map(|file| open(file).expect("a head").head().clone()).collect();
    Film::merge(&heads, |part| open(&files[part]), gaps)
}

/// All but time and machine.
fn without_time(mut film: Film) -> Film {
    (film.costs, film.threads, film.level) = (Costs::default(), 1, Level::best());
    film
}

fn options(part: Part, threads: usize) -> RenderOptions {
    let levels = Level::available();
    RenderOptions { part: Some(part), threads, level: Some(levels[threads % levels.len()]), ..RenderOptions::default() }
}

/// Divided by rows or samples, and some of the parts once more the other way.
fn random_split(crop: Crop, samples: u32, random: &mut Random) -> Vec<Part> {
    let all = |crop: Crop, samples: u32, split: Split, random: &mut Random| -> Vec<Part> {
        let n = 1 + random.below(Part::most(crop, samples, split).min(5) as usize) as u32;
        (1..=n).map(|k| Part::of(crop, samples, split, k, n).expect("no more than there are")).collect()
    };
    let mut parts = Vec::new();
    let split = [Split::Samples, Split::Rows][random.below(2)];
    for part in all(crop, samples, split, random) {
        // Of the same rendering: its rows and samples are those of a part of a part.
        match random.below(2) {
            0 => parts.push(part),
            _ if split == Split::Samples => {
                parts.extend(all(part.of_crop, samples, Split::Rows, random).into_iter().map(|rows| Part {
                    first: part.first,
                    end: part.end,
                    ..rows
                }))
            }
            _ => parts.extend(
                all(part.of_crop, samples, Split::Samples, random)
                    .into_iter()
                    .map(|some| Part { crop: part.crop, ..some }),
            ),
        }
    }
    for k in (1..parts.len()).rev() {
        parts.swap(k, random.below(k + 1));
    }
    parts
}

#[test]
fn parts_of_any_split_are_the_film_of_one_machine() {
    let mut random = Random(1);
    let cases = [
        (scene(&[]), None),
        (scene(&["output.layers=[Depth, Normal, ObjectId, Variance]", "render.clamp=0.5"]), None),
        (scene(&["render.integrator=Path"]), Some(Crop { x: 7, y: 9, width: 20, height: 41 })),
        (scene(&["background=(0.1, 0.2, 0.3)"]), Some(Crop { x: 0, y: 16, width: 33, height: 32 })),
    ];
    let (mut many, mut steps) = (0, 0);
    for (scene, crop) in cases {
        let whole = crop.unwrap_or(Crop::whole(scene.size));
        let of_one = RenderOptions { samples: Some(13), crop, threads: 2, ..RenderOptions::default() };
        // Of parts nobody knows the noise as of the whole.
        let at_once = bytes(&render(&scene, &of_one, &Unobserved));
        let at_once = without_time(merge(&[at_once], Gaps::Refused).expect("it is whole"));
        let pixels = || (0..whole.height).flat_map(|y| (0..whole.width).map(move |x| (whole.x + x, whole.y + y)));
        let variance = pixels().map(|(x, y)| at_once.variance(x, y)).sum::<f64>() / pixels().count() as f64;
        let luminance = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let mean = pixels().map(|(x, y)| luminance(at_once.radiance(x, y))).sum::<f64>() / pixels().count() as f64;
        assert!((at_once.relative_noise() * mean / variance.sqrt() - 1.0).abs() < 1e-9);
        for _ in 0..6 {
            let parts = random_split(whole, 13, &mut random);
            many += usize::from(parts.len() > 3);
            let files: Vec<Vec<u8>> = parts
                .iter()
                .map(|&part| bytes(&render(&scene, &options(part, 1 + random.below(3)), &Unobserved)))
                .collect();
            // Some of them first, where they lie together.
            let some = 1 + random.below(files.len());
            let files = match merge(&files[..some], Gaps::Around) {
                Ok(part) => {
                    steps += 1;
                    [&[bytes(&part)], &files[some..]].concat()
                }
                Err(error) => {
                    assert!(matches!(error, MergeError::Missing(_)), "{error}");
                    files
                }
            };
            let mut film = without_time(merge(&files, Gaps::Refused).expect("all parts"));
            if parts.iter().all(|part| part.crop == whole) {
                assert_eq!(film.counters, at_once.counters, "no ray is traced twice, none is counted twice");
            }
            // Parts by rows trace what they have in common each for itself.
            film.counters = at_once.counters;
            assert!(film == at_once, "{parts:?}");
            assert_eq!(bytes(&film), bytes(&at_once));
        }
    }
    assert!(many > 8 && steps > 8, "{many} of 24 had more than three parts, {steps} were merged in steps");
}

/// Ends a rendering when so many samples are done.
struct EndAfter(u64, AtomicU64);

impl Observer for EndAfter {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        assert!(progress.samples_done <= progress.samples_total);
        self.1.fetch_max(progress.samples_done, Ordering::Relaxed);
        if progress.samples_done >= self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn a_part_that_was_ended_anywhere_is_gone_on_with() {
    let scene = scene(&["output.layers=[Depth, ObjectId]"]);
    let whole = Crop::whole(scene.size);
    for split in [Split::Samples, Split::Rows] {
        let part = Part::of(whole, 37, split, 2, 3).expect("a part");
        let at_once = without_time(render(&scene, &options(part, 2), &Unobserved));
        for end in [0, 500, 4000, 11_111] {
            let ended = render(&scene, &options(part, 2), &EndAfter(end, AtomicU64::new(0)));
            let file = bytes(&ended);
            assert!(matches!(
                merge(std::slice::from_ref(&file), Gaps::Allowed),
                Err(MergeError::Unfinished { part: 0 })
            ));
            let film = Film::load(&mut file.as_slice()).expect("a film");
            let whole = resume(&scene, &options(part, 1), film.clone(), &Unobserved).expect("it fits");
            assert!(without_time(whole) == at_once, "{split:?} {end}");
            let of_all = RenderOptions { samples: Some(37), ..RenderOptions::default() };
            let other = Part::of(Crop::whole(scene.size), 37, split, 3, 3).expect("a part");
            for options in [of_all, options(other, 1)] {
                assert!(resume(&scene, &options, film.clone(), &Unobserved).is_err());
            }
            let elsewhere = Part { of_samples: 38, ..part };
            let misfit = resume(&scene, &options(elsewhere, 1), film, &Unobserved).expect_err("another rendering's");
            assert_eq!(misfit, Misfit::Setting("part"));
        }
    }
}

#[test]
fn what_is_no_whole_set_of_parts_is_named() {
    let plain = scene(&[]);
    let whole = Crop::whole(plain.size);
    let part = |scene: &Scene, samples, split, k, n| {
        let part = Part::of(whole, samples, split, k, n).expect("a part");
        bytes(&render(scene, &options(part, 1), &Unobserved))
    };
    let third = |k| part(&plain, 9, Split::Samples, k, 3);
    let [one, two, three] = [third(1), third(2), third(3)];
    assert!(matches!(merge(&[], Gaps::Refused), Err(MergeError::Empty)));
    let lacks = merge(&[one.clone(), three.clone()], Gaps::Refused).expect_err("the second is missing");
    assert!(matches!(&lacks, MergeError::Missing(gaps) if *gaps == [Gap { rows: 0..56, samples: 3..6 }]), "{lacks}");
    assert_eq!(lacks.to_string(), "samples are missing: 3 to 5 of rows 0 to 55");
    let doubled = merge(&[one.clone(), two.clone(), one.clone(), three.clone()], Gaps::Allowed);
    assert!(matches!(doubled, Err(MergeError::Overlap { first: 0, second: 2 })));
    let rows = part(&plain, 9, Split::Rows, 2, 2);
    assert!(matches!(merge(&[one.clone(), rows], Gaps::Allowed), Err(MergeError::Overlap { first: 0, second: 1 })));
    for (scene, samples, expected) in [
        (&plain, 8, "number of samples"),
        (&scene(&["render.seed=3"]), 9, "seed"),
        (&scene(&["render.clamp=1"]), 9, "clamp"),
        (&scene(&["output.layers=[Depth]"]), 9, "set of layers"),
        (&scene(&["render.reuse=None"]), 9, "reuse"),
        (&scene(&["lights=[]", "background=9"]), 9, "range of brightness"),
    ] {
        let other = part(scene, samples, Split::Samples, 2, 3);
        let foreign = merge(&[one.clone(), other, three.clone()], Gaps::Allowed);
        assert!(matches!(&foreign, Err(MergeError::Foreign { part: 1, what }) if *what == expected), "{foreign:?}");
    }
    // All at once, each with its number.
    let files = [&one, &one, &part(&plain, 8, Split::Samples, 2, 3), &three];
    let heads: Vec<FilmHead> = files.iter().map(|file| open(file).expect("a head").head().clone()).collect();
    let found: Vec<String> = film_faults(&heads, Gaps::Refused).iter().map(MergeError::to_string).collect();
    assert_eq!(
        found,
        [
            "part 2 is of another rendering than part 0: it has another number of samples",
            "parts 0 and 1 have the same samples",
            "samples are missing: 3 to 5 of rows 0 to 55",
        ]
    );
    // Of another one than the head was read of.
    let heads = [open(&one).expect("a head").head().clone()];
    let swapped = Film::merge(&heads, |_| open(&two), Gaps::Allowed);
    assert!(matches!(swapped, Err(MergeError::Part { part: 0, error: FilmError::Damaged(_) })));
}

/// The film of what is there: means of fewer samples, black where there are none.
#[test]
fn gaps_are_left_out_of_the_mean() {
    let scene = scene(&["output.layers=[Depth]"]);
    let whole = Crop::whole(scene.size);
    let file = |split, k| {
        let part = Part::of(whole, 8, split, k, 2).expect("a part");
        bytes(&render(&scene, &options(part, 1), &Unobserved))
    };
    let first = merge(&[file(Split::Samples, 1)], Gaps::Allowed).expect("gaps are allowed");
    let of_four = RenderOptions { samples: Some(4), ..RenderOptions::default() };
    let four = render(&scene, &of_four, &Unobserved);
    for (x, y) in (0..56).flat_map(|y| (0..40).map(move |x| (x, y))) {
        assert_eq!((first.radiance(x, y), first.variance(x, y)), (four.radiance(x, y), four.variance(x, y)));
    }
    assert!(first.has_gaps() && first.samples() == (4..=4) && first.save(&mut Vec::new(), &[]).is_err());
    assert!(matches!(resume(&scene, &of_four, first, &Unobserved), Err(Misfit::Setting("set of samples"))));
    // The second half alone is what the whole lacks of the first.
    let all = merge(&[file(Split::Samples, 2), file(Split::Samples, 1)], Gaps::Refused).expect("both");
    let second = merge(&[file(Split::Samples, 2)], Gaps::Allowed).expect("gaps are allowed");
    for (x, y) in [(3, 40), (20, 30), (11, 25)] {
        for c in 0..3 {
            let mean = 0.5 * (four.radiance(x, y)[c] + second.radiance(x, y)[c]);
            assert!((mean - all.radiance(x, y)[c]).abs() <= 1e-12 * mean.abs());
        }
    }
    let lower = merge(&[file(Split::Rows, 2)], Gaps::Allowed).expect("gaps are allowed");
    assert_eq!((lower.radiance(20, 31), lower.radiance(20, 32)), ([0.0; 3], all.radiance(20, 32)));
    // Four samples above, eight below: light paths cannot be told apart.
    let above = Part { end: 4, ..Part::of(whole, 8, Split::Rows, 1, 2).expect("a part") };
    let above = bytes(&render(&scene, &options(above, 1), &Unobserved));
    assert!(matches!(merge(&[above, file(Split::Rows, 2)], Gaps::Allowed), Err(MergeError::Uneven)));
}

/// Cut or changed anywhere, also by somebody who knows checksums: an error or a film, soon, never a panic.
#[test]
fn mutants_are_refused() {
    let scene = scene(&["image.width=20", "image.height=20", "render.clamp=0.5", "output.layers=[Depth, MaterialId]"]);
    let file = |k| {
        let part = Part::of(Crop::whole(scene.size), 6, Split::Samples, k, 2).expect("a part");
        bytes(&render(&scene, &options(part, 1), &Unobserved))
    };
    let (one, two) = (file(1), file(2));
    let merged = |mutant: &[u8]| -> Result<Film, String> {
        let heads = [mutant, &two].map(|file| open(file).map(|saved| saved.head().clone()));
        let heads = heads.into_iter().collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?;
        let all = |part: usize| open([mutant, &two][part]);
        Film::merge(&heads, all, Gaps::Allowed).map_err(|error| error.to_string())
    };
    assert!(merged(&one).is_ok());
    for len in (0..300).chain((300..one.len()).step_by(61)) {
        assert!(merged(&one[..len]).is_err(), "{len}");
    }
    let mut lied = 0;
    Victim::new(&one).each(
        2000,
        |mutant| merged(mutant).is_err(),
        |mutant| {
            if let Ok(film) = merged(mutant) {
                lied += 1;
                let Counters { camera_rays, .. } = film.counters;
                assert!(camera_rays > 0 && film.radiance(3, 3).iter().all(|x| !x.is_nan()));
            }
        },
    );
    assert!(lied > 10, "{lied} lies were believed");
}
