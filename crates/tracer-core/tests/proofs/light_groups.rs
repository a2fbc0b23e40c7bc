//! Light groups: they sum to the picture, exactly; each is the picture that its lights make alone; and the same bytes
//! whatever the schedule.

use crate::same_bytes::{bits, cut, options};
use crate::support::compiled;
use scene_format::{Override, SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_core::{
    Crop, Film, Gaps, Layer, LayerSet, Level, MergeError, Misfit, Part, RenderOptions, SavedFilm, Scene, Split,
    Unobserved, develop, film_faults, render, resume,
};

/// Lamps of every kind, in two groups and in none, with caustics and mirrors. The `vars` are factors.
const SCENE: &str = r#"Scene(
    vars: { "key": 1, "fill": 1, "rest": 1 },
    camera: Camera(position: (0.4, 1.8, 6), look_at: (0, 0.7, 0), fov: 42),
    image: Image(width: 37, height: 29),
    render: Render(max_bounces: 4),
    output: Output(light_groups: true),
    lights: [
        SphereLight(center: (-2.5, 4, 3), radius: 0.5, radiance: "=20*key", group: "key"),
        SphereLight(center: (2, 3.5, -1), radius: 0.4, radiance: "=16*rest"),
    ],
    materials: { "panel": Emissive(radiance: "=9*fill", group: "fill"), "matt": Diffuse(albedo: (0.7, 0.6, 0.5)) },
    objects: [
        Plane(material: "matt"),
        Plane(point: (0, 0, -3), normal: (0, 0, 1), material: "matt"),
        Rectangle(center: (3, 2, 1), normal: (-1, 0, 0), size: 1, material: "panel"),
        Disk(
            center: (-3, 1.5, 0), normal: (1, 0, 0), radius: 0.5,
            material: Emissive(radiance: "=12*key", group: "key"),
        ),
        Box(center: (0, 3, 0), size: 0.3, material: Emissive(radiance: "=6*fill", group: "fill")),
        Sphere(center: (0.3, 0.2, 2), radius: 0.2, material: Emissive(radiance: "=4*rest")),
        Sphere(center: (-1, 0.8, 0), radius: 0.8, material: Transparent(ior: 1.5)),
        Sphere(center: (1, 0.7, -0.5), radius: 0.7, material: Mirror(reflectance: 0.9)),
        Sphere(center: (0.9, 0.4, 1.4), radius: 0.4, material: BlinnPhong(albedo: 0.4, exponent: 200, specular: 0.3)),
    ],
)"#;

const NAMES: [&str; 3] = ["fill", "key", "rest"];

pub(crate) fn described(set: &[&str]) -> SceneDesc {
    let set: Vec<Override> = set.iter().map(|&set| Override::from(set.to_owned())).collect();
    load_str("scene.ron", SCENE, Syntax::Ron, Path::new("."), &set).expect("a scene").scene
}

fn scene(set: &[&str]) -> Scene {
    compiled(&described(set))
}

fn rendered(scene: &Scene, options: &RenderOptions) -> Film {
    let film = render(scene, options, &Unobserved);
    assert_eq!(film.counters.dropped, 0);
    film
}

fn pixels(film: &Film) -> impl Iterator<Item = (u32, u32)> + use<> {
    let Crop { x, y, width, height } = film.crop();
    (y..y + height).flat_map(move |y| (x..x + width).map(move |x| (x, y)))
}

/// What a group has brought, as bits.
fn of_group(film: &Film, group: usize) -> Vec<[u64; 3]> {
    pixels(film).map(|(x, y)| film.radiance_of_group(group, x, y).map(f64::to_bits)).collect()
}

/// All that a film tells of groups and picture, as bits.
fn all(film: &Film) -> (Vec<[u64; 7]>, Vec<Vec<[u64; 3]>>) {
    (bits(film), (0..film.light_groups().len()).map(|group| of_group(film, group)).collect())
}

/// The whole numbers of the groups sum to the picture's, whatever finds the light and whatever else is kept.
#[test]
fn groups_sum_to_the_picture() {
    let denoised: LayerSet = tracer_core::GUIDES.into_iter().collect();
    let ways: [(&str, &[&str], RenderOptions); 6] = [
        ("default", &[], RenderOptions { reuse: None, ..options() }),
        ("shared under a background", &["background=0.5"], options()),
        ("paths", &["render.integrator=Path", "background=(0.2, 0.3, 0.4)"], options()),
        ("direct", &["render.integrator=Direct"], options()),
        ("clamped", &[], RenderOptions { clamp: Some(0.7), ..options() }),
        ("halves", &["output.alpha=true"], RenderOptions { halves: true, layers: Some(denoised), ..options() }),
    ];
    for (name, set, options) in ways {
        let film = rendered(&scene(set), &options);
        assert_eq!(film.light_groups(), NAMES, "{name}");
        assert!(film.groups_are_all(), "{name}");
        for group in 0..3 {
            assert!(pixels(&film).any(|(x, y)| film.radiance_of_group(group, x, y)[1] > 0.0), "{name}: {group}");
        }
        // Three means and their sum are each rounded by half a unit in the last place of the largest at most.
        for (x, y) in pixels(&film) {
            let whole = film.radiance(x, y);
            let sum: [f64; 3] = [0, 1, 2].map(|c| (0..3).map(|group| film.radiance_of_group(group, x, y)[c]).sum());
            let error = (0..3).map(|c| (sum[c] - whole[c]).abs() / whole[c].abs().max(1e-3)).fold(0.0, f64::max);
            assert!(error < 1e-14, "{name}: {x}, {y}: {sum:?} {whole:?}");
        }
    }
}

/// A group is the picture of the scene in which all other lights are dark: the same bytes, for plain paths and with all
/// techniques.
#[test]
fn a_group_is_what_its_lights_bring_alone() {
    for (name, more) in [
        ("paths", &["render.integrator=Path", "background=\"=0.3*rest\""][..]),
        ("default", &[]),
        ("direct", &["render.integrator=Direct", "background=\"=0.3*rest\""]),
    ] {
        let options = RenderOptions { reuse: None, ..options() };
        let film = rendered(&scene(more), &options);
        for (group, of) in NAMES.into_iter().enumerate() {
            let dark: Vec<String> =
                NAMES.into_iter().filter(|&other| other != of).map(|other| format!("vars.{other}=0")).collect();
            let set: Vec<&str> = dark.iter().map(String::as_str).chain(more.iter().copied()).collect();
            let alone = RenderOptions { light_groups: Some(false), ..options };
            let alone = rendered(&scene(&set), &alone);
            let expected: Vec<[u64; 3]> = pixels(&alone).map(|(x, y)| alone.radiance(x, y).map(f64::to_bits)).collect();
            assert!(of_group(&film, group) == expected, "{name}: {of}");
        }
    }
}

/// A picture in groups has the mean of the picture without, with all techniques at work.
#[test]
fn groups_change_no_mean() {
    let (grouped, plain) = (scene(&[]), scene(&["output.light_groups=false"]));
    let mean = |scene: &Scene, seed: u32| {
        let options = RenderOptions { seed: Some(seed), samples: Some(4), threads: 1, ..RenderOptions::default() };
        let film = rendered(scene, &options);
        pixels(&film).map(|(x, y)| film.radiance(x, y)[1]).sum::<f64>()
    };
    let estimate = |scene: &Scene, first: u32| {
        let means: Vec<f64> = (first..first + 16).map(|seed| mean(scene, seed)).collect();
        let middle = means.iter().sum::<f64>() / 16.0;
        let variance = means.iter().map(|x| (x - middle) * (x - middle)).sum::<f64>() / 15.0 / 16.0;
        (middle, variance)
    };
    let ((one, of_one), (other, of_other)) = (estimate(&grouped, 100), estimate(&plain, 200));
    // The difference of two means of 16 over its standard error has a t distribution with 15 degrees of freedom at
    // least: it is beyond 5 once in six thousand.
    let deviation = (one - other).abs() / (of_one + of_other).sqrt();
    assert!(deviation < 5.0, "{one} {other}: {deviation}");
    // And that is no empty word: the standard error is below a hundredth of the picture.
    assert!((of_one + of_other).sqrt() < 0.01 * other);
}

#[test]
fn the_same_bytes_whatever_the_schedule() {
    let scene = scene(&["background=0.2"]);
    let options = options();
    let at_once = rendered(&scene, &options);
    let expected = all(&at_once);
    for (threads, level) in [(3, Level::best()), (2, Level::available().first().copied().unwrap_or(Level::best()))] {
        let film = rendered(&scene, &RenderOptions { threads, level: Some(level), ..options });
        assert!(all(&film) == expected, "{threads} threads, {}", level.name());
    }
    let crop = Crop { x: 3, y: 5, width: 21, height: 11 };
    let film = rendered(&scene, &RenderOptions { crop: Some(crop), ..options });
    for group in 0..3 {
        assert!(of_group(&film, group) == cut(&expected.1[group], scene.size, crop), "group {group}");
    }
    // Saved and gone on with.
    let mut file = Vec::new();
    rendered(&scene, &RenderOptions { samples: Some(3), ..options }).save(&mut file, &[]).expect("memory");
    let back = || Film::load(&mut file.as_slice()).expect("it was saved");
    let film = resume(&scene, &options, back(), &Unobserved).expect("it is of this scene");
    assert!(all(&film) == expected && film.groups_are_all() && film.bytes() == at_once.bytes());
    let other = RenderOptions { light_groups: Some(false), ..options };
    assert_eq!(resume(&scene, &other, back(), &Unobserved).unwrap_err(), Misfit::Setting("set of light groups"));
    for at in (0..file.len()).step_by(997) {
        let mut broken = file.clone();
        broken[at] ^= 16;
        assert!(Film::load(&mut broken.as_slice()).is_err(), "byte {at}");
    }
}

#[test]
fn parts_merge_to_the_same_bytes() {
    let scene = scene(&[]);
    let options = RenderOptions { samples: Some(6), ..options() };
    let expected = all(&rendered(&scene, &options));
    let part = |split: Split, k: u32, n: u32, light_groups: Option<bool>| {
        let part = Part::of(Crop::whole(scene.size), 6, split, k, n);
        let mut file = Vec::new();
        rendered(&scene, &RenderOptions { part, light_groups, ..options }).save(&mut file, &[]).expect("memory");
        file
    };
    let head = |file: &Vec<u8>| SavedFilm::open(file.as_slice()).expect("it was saved").head().clone();
    for (split, n) in [(Split::Samples, 3), (Split::Rows, 2)] {
        let files: Vec<Vec<u8>> = (1..=n).rev().map(|k| part(split, k, n, None)).collect();
        let heads: Vec<_> = files.iter().map(head).collect();
        assert!(heads.iter().all(|head| head.light_groups() == NAMES));
        let open = |part: usize| SavedFilm::open(files[part].as_slice());
        let film = Film::merge(&heads, open, Gaps::Refused).expect("all parts");
        assert!(all(&film) == expected && film.groups_are_all(), "{split:?}");
    }
    let heads = [(1, None), (2, Some(false))].map(|(k, groups)| head(&part(Split::Samples, k, 2, groups)));
    let faults = film_faults(&heads, Gaps::Refused);
    assert!(matches!(faults[..], [MergeError::Foreign { part: 1, what: "set of light groups" }, ..]), "{faults:?}");
}

/// Names alone change nothing, and neither do layers what groups are: they tell of the scene with all its lights.
#[test]
fn names_and_layers_change_nothing() {
    let plain = scene(&["output.light_groups=false"]);
    let mut nameless = described(&["output.light_groups=false"]);
    for light in &mut nameless.lights {
        let scene_format::desc::Light::SphereLight(light) = &mut light.value;
        light.group = Default::default();
    }
    let options = options();
    let film = rendered(&plain, &options);
    assert!(film.light_groups().is_empty() && bits(&film) == bits(&rendered(&compiled(&nameless), &options)));

    let grouped = scene(&[]);
    let layers = Some(LayerSet::from_iter([Layer::Emission, Layer::Depth, Layer::ObjectId, Layer::Albedo]));
    let with_layers = rendered(&grouped, &RenderOptions { layers, ..options });
    assert!(all(&with_layers) == all(&rendered(&grouped, &options)));
    let of_plain = rendered(&plain, &RenderOptions { layers, ..options });
    for layer in with_layers.layers().iter() {
        assert_eq!(with_layers.layer(layer), of_plain.layer(layer), "{layer:?}");
    }
    assert!(with_layers.layer(Layer::Emission).is_some_and(|layer| layer.values.iter().any(|&x| x > 0.0)));
}

/// Developed groups sum to the developed picture within a unit in the last place each, with and without what is behind
/// everything.
#[test]
fn developed_groups_sum_to_the_developed_picture() {
    for set in [&["background=0.3"][..], &["background=0.3", "output.alpha=true", "effects.exposure=1.5"]] {
        let scene = scene(set);
        let film = rendered(&scene, &options());
        let image = develop(&film, &scene.look);
        let names: Vec<&str> = image.light_groups.iter().map(|(name, _)| name.as_str()).collect();
        let expected = ["fill", "key", "rest"].map(|group| ["R", "G", "B"].map(|c| format!("light.{group}.{c}")));
        assert_eq!(names, expected.as_flattened());
        for (k, &whole) in image.linear.iter().enumerate() {
            let parts = [0, 1, 2].map(|group| image.light_groups[3 * group + k % 3].1[k / 3]);
            let ulp = |x: f32| f64::from(x.abs().next_up() - x.abs());
            let most = parts.into_iter().chain([whole]).map(ulp).sum::<f64>();
            let sum: f64 = parts.into_iter().map(f64::from).sum();
            assert!((sum - f64::from(whole)).abs() <= most, "{k}: {parts:?} {whole}");
        }
    }
}

/// While the shutter is open each moment has its own lights; the groups are the same ones.
#[test]
fn groups_of_what_moves() {
    let moving = ["camera.shutter=0.5", "objects[6].center=(\"=time*20\", 0.8, 0)"];
    let scene = scene(&moving);
    assert!(scene.moves());
    let options = RenderOptions { samples: Some(4), ..options() };
    let film = rendered(&scene, &options);
    assert!(film.fault.is_none() && film.groups_are_all());
    let begun = rendered(&scene, &RenderOptions { samples: Some(2), ..options });
    let resumed = resume(&scene, &options, begun, &Unobserved).expect("it is of this scene");
    assert!(all(&resumed) == all(&film));
}

/// What is of no light has no groups.
#[test]
fn ambient_occlusion_has_no_groups() {
    let film = rendered(&scene(&["render.integrator=AmbientOcclusion()"]), &options());
    assert!(film.light_groups().is_empty());
}
