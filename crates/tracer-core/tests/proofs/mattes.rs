//! Mattes: what covers how much of a pixel, against the reference, against the layers of the same samples, and the same
//! whatever the schedule.

use crate::same_bytes::{everything, options};
use crate::support::compiled;
use crate::support::describe::*;
use scene_format::SceneDesc;
use scene_format::desc::{Integrator, MaskName, Matte, Name, Object, PixelFilter};
use scene_format::diagnostic::{Span, Spanned};
use tracer_core::scene::NONE;
use tracer_core::{
    Crop, Film, Gaps, Layer, Level, MatteImage, MatteOf, Misfit, Part, RenderOptions, SavedFilm, Scene, Split,
    Unobserved, render, resume,
};
use tracer_reference::first_hits;

const BOTH: [MatteOf; 2] = [MatteOf::Objects, MatteOf::Materials];

/// A scene of all there is, some of it named, with all mattes.
fn matted() -> SceneDesc {
    let mut desc = everything();
    desc.lights.truncate(2);
    for (k, object) in desc.objects.iter_mut().enumerate() {
        if let Object::Sphere(sphere) = &mut object.value {
            sphere.name = Name::from(Some(if k % 2 == 0 { "even" } else { "odd" }));
        }
    }
    desc.output.cryptomatte = vec![Matte::Materials, Matte::Objects];
    let mask = |name: &str| Spanned { value: MaskName(name.to_owned()), span: Span::NONE };
    desc.output.masks = ["even", "odd"].map(mask).to_vec();
    desc
}

fn asked(scene: &Scene, samples: u32) -> RenderOptions {
    RenderOptions { samples: Some(samples), mattes: scene.mattes.kept(), ..options() }
}

/// Whose pixels are all of this film.
fn pixels(film: &Film) -> impl Iterator<Item = (u32, u32)> + use<> {
    let Crop { x, y, width, height } = film.crop();
    (y..y + height).flat_map(move |y| (x..x + width).map(move |x| (x, y)))
}

/// All that mattes tell, as bits.
fn bits(scene: &Scene, film: &Film) -> Vec<u32> {
    let MatteImage { channels, .. } = scene.mattes.develop(film);
    assert_eq!(channels.len(), 2 * 12 + 2);
    channels.into_iter().flat_map(|(_, values)| values).map(f32::to_bits).collect()
}

/// Through the pixels' centres each pixel is of one thing: that which the reference finds.
#[test]
fn mattes_are_those_of_the_reference() {
    let mut desc = matted().filter(PixelFilter::None).bounces(0);
    desc.effects.depth_of_field = None;
    desc.render.integrator = Integrator::Path;
    let scene = compiled(&desc);
    let film = render(&scene, &asked(&scene, 2), &Unobserved);
    let mut seen = 0;
    for ((x, y), hit) in pixels(&film).zip(first_hits(&scene)) {
        let [object, material] = BOTH.map(|of| film.matte(of, x, y));
        assert_eq!(object, hit.map_or(vec![], |hit| vec![(hit.object + 1, 1.0)]), "{x}, {y}");
        let of_hit = hit.filter(|hit| hit.material != NONE).map(|hit| vec![(hit.material + 1, 1.0)]);
        assert_eq!(material, of_hit.unwrap_or_default(), "{x}, {y}");
        seen += object.len();
    }
    assert!(seen > 100, "{seen}");
}

/// Shares sum to what the layer `alpha` says of the same samples, with the picture's filter and lens; files never say
/// more than that.
#[test]
fn shares_sum_to_coverage() {
    let mut desc = matted().filter(PixelFilter::Gaussian { sigma: 0.7.into() });
    desc.output.layers = vec![scene_format::desc::Layer::Alpha];
    let scene = compiled(&desc);
    let film = render(&scene, &asked(&scene, 7), &Unobserved);
    let alpha = film.layer(Layer::Alpha).expect("it is asked for").values;
    let nearest = film.layer(Layer::ObjectId).expect("mattes are made of it").values;
    let mut edges = 0;
    for ((x, y), k) in pixels(&film).zip(0..) {
        let object = film.matte(MatteOf::Objects, x, y);
        let sum: f64 = object.iter().map(|(_, share)| share).sum();
        assert!((sum - f64::from(alpha[k])).abs() < 1e-6, "{x}, {y}: {sum} {}", alpha[k]);
        assert!(object.iter().any(|(number, _)| *number as f32 == nearest[k]) || nearest[k] == 0.0);
        edges += usize::from(object.len() > 1);
    }
    assert!(edges > 50, "{edges}");
    let MatteImage { channels, attributes } = scene.mattes.develop(&film);
    let channel = |name: &str| &channels.iter().find(|(of, _)| of == name).expect("a channel").1;
    for name in ["CryptoObject", "CryptoMaterial"] {
        let shares: Vec<&Vec<f32>> =
            (0..3).flat_map(|k| ["G", "A"].map(|c| channel(&format!("{name}{k:02}.{c}")))).collect();
        for (k, alpha) in alpha.iter().enumerate() {
            let sum: f64 = shares.iter().map(|values| f64::from(values[k])).sum();
            assert!(sum <= 1.0 && sum <= f64::from(*alpha) + 1e-6 && shares.is_sorted_by(|a, b| a[k] >= b[k]));
        }
    }
    // A mask is the share of what has its name, wherever it ranks.
    let [even, odd] = ["mask.even.Y", "mask.odd.Y"].map(channel);
    assert!(even.iter().zip(odd).zip(&alpha).all(|((a, b), alpha)| a + b <= alpha + 1e-6));
    assert!(even.iter().any(|&x| x > 0.5) && odd.iter().any(|&x| x > 0.5));
    assert_eq!(attributes.len(), 8);
    assert_eq!(scene.mattes.objects.len(), desc.objects.len() + 2);
    assert_eq!(scene.mattes.materials.len(), scene.materials.len());
}

#[test]
fn the_same_bytes_whatever_the_schedule() {
    let scene = compiled(&matted());
    let options = asked(&scene, 5);
    let at_once = render(&scene, &options, &Unobserved);
    let expected = bits(&scene, &at_once);
    let plain = render(&scene, &RenderOptions { mattes: Default::default(), ..options }, &Unobserved);
    assert!(crate::same_bytes::bits(&at_once) == crate::same_bytes::bits(&plain), "the picture knows of its mattes");
    for (threads, level) in [(3, Level::best()), (2, Level::available().first().copied().unwrap_or(Level::best()))] {
        let film = render(&scene, &RenderOptions { threads, level: Some(level), ..options }, &Unobserved);
        assert!(bits(&scene, &film) == expected, "{threads} threads, {}", level.name());
    }
    let crop = Crop { x: 3, y: 5, width: 21, height: 11 };
    let film = render(&scene, &RenderOptions { crop: Some(crop), ..options }, &Unobserved);
    for (x, y) in pixels(&film) {
        assert_eq!(BOTH.map(|of| film.matte(of, x, y)), BOTH.map(|of| at_once.matte(of, x, y)));
    }
    // Saved and gone on with.
    let mut file = Vec::new();
    render(&scene, &asked(&scene, 2), &Unobserved).save(&mut file, &[]).expect("memory");
    let back = || Film::load(&mut file.as_slice()).expect("it was saved");
    let film = resume(&scene, &options, back(), &Unobserved).expect("it is of this scene");
    assert!(bits(&scene, &film) == expected && film.bytes() == at_once.bytes());
    let other = RenderOptions { mattes: Default::default(), ..options };
    assert_eq!(resume(&scene, &other, back(), &Unobserved).unwrap_err(), Misfit::Setting("choice of mattes"));
    for at in (0..file.len()).step_by(499) {
        let mut broken = file.clone();
        broken[at] ^= 16;
        assert!(Film::load(&mut broken.as_slice()).is_err(), "byte {at}");
    }
}

#[test]
fn parts_merge_to_the_same_bytes() {
    let scene = compiled(&matted());
    let options = asked(&scene, 5);
    let expected = bits(&scene, &render(&scene, &options, &Unobserved));
    for (split, n) in [(Split::Samples, 3), (Split::Rows, 2)] {
        let part = |k: u32| {
            let part = Part::of(Crop::whole(scene.size), 5, split, k, n);
            let mut file = Vec::new();
            render(&scene, &RenderOptions { part, ..options }, &Unobserved).save(&mut file, &[]).expect("memory");
            file
        };
        let files: Vec<Vec<u8>> = (1..=n).rev().map(part).collect();
        let open = |part: usize| SavedFilm::open(files[part].as_slice());
        let heads: Vec<_> = (0..files.len()).map(|k| open(k).expect("it was saved").head().clone()).collect();
        let film = Film::merge(&heads, open, Gaps::Refused).expect("all parts");
        assert!(bits(&scene, &film) == expected, "{split:?}");
    }
}
