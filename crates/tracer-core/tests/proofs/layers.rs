//! Picture layers: what camera rays hit first, against the reference and against formulas; and the same bytes whatever
//! the schedule.

use crate::same_bytes::{cut, everything, options};
use crate::shining::{cuboid, rectangle};
use crate::support::compiled;
use crate::support::describe::*;
use scene_format::SceneDesc;
use scene_format::desc::{
    Acceleration, FisheyeMapping, Integrator, Material, MaterialRef, Name, Object, PerAxis, PixelFilter, Placements,
    Projection, Rectangle,
};
use std::ops::ControlFlow;
use tracer_core::{
    Crop, Film, Layer, LayerSet, Level, Misfit, Observer, Progress, RenderOptions, Scene, Unobserved, render, resume,
};
use tracer_reference::{FirstHit, first_hits};

fn with_layers(options: RenderOptions) -> RenderOptions {
    RenderOptions { layers: Some(LayerSet::all()), ..options }
}

fn samples(samples: u32) -> RenderOptions {
    with_layers(RenderOptions { samples: Some(samples), threads: 1, ..RenderOptions::default() })
}

/// The numbers of a layer, pixel by pixel.
fn layer<const N: usize>(film: &Film, layer: Layer) -> Vec<[f32; N]> {
    let image = film.layer(layer).expect("all layers are kept");
    assert_eq!(image.channels.len(), N);
    image.values.as_chunks::<N>().0.to_vec()
}

/// All that a film says of its layers, as bits: pixel by pixel.
fn bits(film: &Film) -> Vec<Vec<u32>> {
    bits_of(film, |_| true)
}

fn bits_of(film: &Film, wanted: impl Fn(Layer) -> bool) -> Vec<Vec<u32>> {
    let [width, height] = [film.crop().width, film.crop().height];
    let images: Vec<_> = LayerSet::all()
        .iter()
        .filter(|layer| wanted(*layer))
        .map(|layer| film.layer(layer).expect("all are kept"))
        .collect();
    let pixel = |k: usize| {
        let of = |image: &tracer_core::LayerImage| {
            image.values[k * image.channels.len()..(k + 1) * image.channels.len()].to_vec()
        };
        images.iter().flat_map(of).map(f32::to_bits).collect()
    };
    (0..(width * height) as usize).map(pixel).collect()
}

/// Around a fisheye's circle there is no camera ray, and in the corners of a wide picture not one of a whole batch:
/// there nothing is, for every layer, and not what the batch before has found.
#[test]
fn around_a_fisheye_nothing_is() {
    let mut desc = everything();
    desc.camera.projection = Projection::Fisheye { fov: 180.0.into(), mapping: FisheyeMapping::Equidistant };
    (desc.image.width, desc.image.height) = (192.into(), 64.into());
    let scene = compiled(&desc);
    let film = |threads| render(&scene, &RenderOptions { threads, ..samples(3) }, &Unobserved);
    let (film, other) = (film(1), film(2));
    assert!(bits(&film) == bits(&other), "one and two threads differ");
    for (which, nothing) in [(Layer::Alpha, 0.0), (Layer::Depth, f32::INFINITY), (Layer::ObjectId, 0.0)] {
        for (k, [value]) in layer::<1>(&film, which).into_iter().enumerate() {
            let from_the_middle = ((k % 192) as f64 + 0.5 - 96.0).hypot((k / 192) as f64 + 0.5 - 32.0);
            // The circle, and two pixels for the filter, whose samples lie that far from a pixel's middle at most.
            let outside = from_the_middle >= 32.0 + 2.0 * 2f64.sqrt();
            assert!(value == nothing || !outside, "{which:?} is {value} at pixel {k}");
        }
    }
    assert!(layer::<1>(&film, Layer::Alpha).into_iter().any(|[alpha]| alpha > 0.9));
}

/// Without the lamp that is all around, so that some rays hit nothing.
fn open() -> SceneDesc {
    let mut desc = everything();
    desc.lights.truncate(2);
    desc
}

/// Every material, shape, texture and way of shading, through the pixels' centres: as the reference finds them in f64.
/// The engine's surfaces are right to some 1e-6 of the scene's size, which bent normals and textures enlarge.
#[test]
fn first_hits_are_those_of_the_reference() {
    for desc in [everything(), open()] {
        let mut desc = desc.filter(PixelFilter::None).bounces(0);
        desc.effects.depth_of_field = None;
        desc.render.integrator = Integrator::Path;
        let scene = compiled(&desc);
        let film = render(&scene, &samples(2), &Unobserved);
        let expected = first_hits(&scene);
        let of_hit = |of: &dyn Fn(&FirstHit) -> [f64; 3], empty: f64| -> Vec<[f64; 3]> {
            expected.iter().map(|hit| hit.as_ref().map_or([empty; 3], of)).collect()
        };
        let scale = scene.frame.scale;
        let close = |name: &str, found: &[[f64; 3]], expected: &[[f64; 3]], channels: usize, tolerance: f64| {
            assert_eq!(found.len(), expected.len());
            for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
                let same = |c: usize| found[c] == expected[c] || (found[c] - expected[c]).abs() <= tolerance;
                assert!((0..channels).all(same), "{name} of pixel {k} is {found:?}, expected {expected:?}");
            }
        };
        let three = |of: Layer| -> Vec<[f64; 3]> { layer::<3>(&film, of).iter().map(|x| x.map(f64::from)).collect() };
        let one = |of: Layer| -> Vec<[f64; 3]> { layer::<1>(&film, of).iter().map(|x| [f64::from(x[0]); 3]).collect() };
        close("albedo", &three(Layer::Albedo), &of_hit(&|hit| hit.albedo.to_array(), 0.0), 3, 1e-4);
        close("normal", &three(Layer::Normal), &of_hit(&|hit| hit.normal.to_array(), 0.0), 3, 2e-5);
        let depth = of_hit(&|hit| [hit.depth / scale; 3], f64::INFINITY);
        close("depth", &one(Layer::Depth), &depth, 1, 3e-5);
        let position = of_hit(&|hit| (hit.point / scale + scene.frame.centre).to_array(), 0.0);
        close("position", &three(Layer::Position), &position, 3, 3e-5);
        let uv: Vec<[f64; 3]> =
            layer::<2>(&film, Layer::Uv).iter().map(|uv| [uv[0].into(), uv[1].into(), 0.0]).collect();
        close("uv", &uv, &of_hit(&|hit| [hit.uv[0], hit.uv[1], 0.0], 0.0), 2, 2e-5);
        close("emission", &three(Layer::Emission), &of_hit(&|hit| hit.emission.to_array(), 0.0), 3, 1e-5);
        let number = |number: u32| [f64::from(number.wrapping_add(1)); 3];
        close("object", &one(Layer::ObjectId), &of_hit(&|hit| number(hit.object), 0.0), 1, 0.0);
        close("material", &one(Layer::MaterialId), &of_hit(&|hit| number(hit.material), 0.0), 1, 0.0);
        let variance = (0..37 * 37).map(|k| [film.variance(k % 37, k / 37); 3]).collect::<Vec<_>>();
        close("variance", &one(Layer::Variance), &variance, 1, 1e-5);
        // All of it is seen.
        let seen = |of: Layer| one(of).iter().map(|x| x[0] as u32).collect::<std::collections::BTreeSet<_>>();
        assert!(seen(Layer::ObjectId).len() > 10 && seen(Layer::MaterialId).len() > 9, "{:?}", seen(Layer::ObjectId));
        let shines = three(Layer::Emission).iter().any(|x| x[0] > 0.0) && variance.iter().any(|x| x[0] > 0.0);
        assert!(shines || desc.lights.len() == 2);
        assert_eq!(expected.iter().any(Option::is_none), desc.lights.len() == 2);
    }
}

/// A ball of albedo one shows in its layer the share of the samples that hit it, a black one before a white background
/// in the picture the share of those that do not: together they are one, pixel by pixel, whatever places the samples.
#[test]
fn layers_are_averaged_as_the_picture_is() {
    let filters = [
        PixelFilter::Box,
        PixelFilter::Gaussian { sigma: 0.7.into() },
        PixelFilter::BlackmanHarris { radius: 2.0.into() },
    ];
    for (filter, lens) in filters.into_iter().zip([0.0, 1.5, 0.3]) {
        let film = |albedo: f64| {
            let ball = sphere([0.3, 0.2, 0.0], 1.0, diffuse([albedo; 3]));
            let desc = scene(24, vec![], vec![ball]).background([1.0; 3]).bounces(0).filter(filter.clone());
            let mut desc = desc.lens(lens, 3.0);
            desc.render.integrator = Integrator::Path;
            render(&compiled(&desc), &samples(16), &Unobserved)
        };
        let (black, white) = (film(0.0), film(1.0));
        let mut edges = 0;
        for (k, [albedo, ..]) in layer::<3>(&white, Layer::Albedo).into_iter().enumerate() {
            let [share, ..] = black.radiance(k as u32 % 24, k as u32 / 24);
            assert_eq!(f64::from(albedo) + share, 1.0, "{filter:?}, pixel {k}");
            edges += u32::from(albedo > 0.0 && albedo < 1.0);
        }
        assert!(edges > 30, "{filter:?}: {edges}");
    }
}

/// A wall across the view axis has one depth, in all pixels, however samples and lens lie; also far from the world's
/// origin and very small.
#[test]
fn a_wall_seen_straight_has_one_depth() {
    for (size, centre) in [(1.0, [0.0; 3]), (1e-3, [0.0; 3]), (1e4, [3e5, -7e5, 1e5])] {
        let at = |z: f64| [centre[0], centre[1], centre[2] + size * z];
        let wall = Rectangle {
            center: at(-3.0).into(),
            normal: [0.0, 0.0, 1.0].into(),
            size: PerAxis([20.0 * size; 2]).into(),
            material: MaterialRef::Default,
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        };
        let desc = scene(17, vec![], vec![Object::Rectangle(Box::new(wall))])
            .camera(at(2.0), at(0.0), 60.0)
            .background([1.0; 3]);
        let desc = desc.filter(PixelFilter::Gaussian { sigma: 0.8.into() }).lens(0.5 * size, 2.0 * size);
        let film = render(&compiled(&desc), &samples(8), &Unobserved);
        // The world's numbers are doubles; t and the cosine are right to a few roundings of f32.
        for [depth] in layer::<1>(&film, Layer::Depth) {
            assert!((f64::from(depth) / size - 5.0).abs() < 5.0 * 1e-6, "{depth} at {size}");
        }
        assert!(layer::<3>(&film, Layer::Normal).iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
    }
}

/// The normals of a ball, and its depths, lie between the least and the greatest that the formula has where the pixel's
/// samples may lie: a box is half a pixel wide on each side.
#[test]
fn a_ball_is_as_the_formula_says() {
    const SIZE: u32 = 32;
    let desc =
        scene(SIZE, vec![], vec![sphere([0.0; 3], 1.0, diffuse([0.5; 3]))]).camera([0.0, 0.0, 4.0], [0.0; 3], 40.0);
    let film = render(&compiled(&desc), &samples(16), &Unobserved);
    let (normals, depths) = (layer::<3>(&film, Layer::Normal), layer::<1>(&film, Layer::Depth));
    let objects = layer::<1>(&film, Layer::ObjectId);
    // From the eye at (0, 0, 4): t of the nearer hit with x^2 + y^2 + z^2 = 1, depth and normal there.
    let hit = |x: f64, y: f64| {
        let half = 20f64.to_radians().tan();
        let d = [half * (2.0 * x / f64::from(SIZE) - 1.0), half * (1.0 - 2.0 * y / f64::from(SIZE)), -1.0];
        let (a, b) = (d[0] * d[0] + d[1] * d[1] + 1.0, 4.0 * d[2]);
        let root = (b * b - a * 15.0).sqrt();
        let t = (-b - root) / a;
        (!root.is_nan()).then_some([t * d[0], t * d[1], 4.0 + t * d[2], t])
    };
    let (mut inside, mut outside) = (0, 0);
    for (k, (normal, [depth])) in normals.iter().zip(&depths).enumerate() {
        let (x, y) = (f64::from(k as u32 % SIZE), f64::from(k as u32 / SIZE));
        let places = (0..=16).flat_map(|j| (0..=16).map(move |i| (x + f64::from(i) / 16.0, y + f64::from(j) / 16.0)));
        // Of 16 samples in as many squares of a pixel one lies in each of the four about its centre.
        let near =
            places.clone().filter(|(i, j)| (i - x - 0.5).hypot(j - y - 0.5) < 0.36).map(|(x, y)| hit(x, y).is_some());
        let near: Vec<bool> = near.collect();
        if near.iter().all(|&hit| hit == near[0]) {
            assert_eq!(objects[k], [if near[0] { 1.0 } else { 0.0 }], "pixel {k}");
        }
        let found: Vec<_> = places.map(|(x, y)| hit(x, y)).collect();
        let Some(found) = found.iter().copied().collect::<Option<Vec<_>>>() else {
            outside += usize::from(found.iter().all(Option::is_none));
            continue;
        };
        inside += 1;
        let values = [normal[0], normal[1], normal[2], *depth].map(f64::from);
        for c in 0..4 {
            let (least, most) = found.iter().fold((f64::MAX, f64::MIN), |(l, m), hit| (l.min(hit[c]), m.max(hit[c])));
            // Extrema may lie between the places: by less than a place's share of what lies between.
            let slack = (most - least) / 16.0 + 1e-6;
            assert!(
                (least - slack..most + slack).contains(&values[c]),
                "{c} of pixel {k}: {} {least} {most}",
                values[c]
            );
        }
    }
    assert!(inside > 200 && outside > 100, "{inside} {outside}");
    let empty = depths.iter().zip(&normals).filter(|(depth, _)| depth[0] == f32::INFINITY);
    assert!(empty.clone().count() >= outside && empty.clone().all(|(_, normal)| *normal == [0.0; 3]));
}

/// What is seen in a mirror or behind glass is not in the layers: they are of the mirror and of the glass.
#[test]
fn mirrors_and_glass_are_first_hits() {
    let materials = [mirror([0.9, 0.8, 0.7]), glass(1.5), blinn_phong([0.2, 0.4, 0.9], 300.0, 0.2)];
    for (material, expected) in materials.into_iter().zip([[0.9f32, 0.8, 0.7], [1.0; 3], [0.2, 0.4, 0.9]]) {
        let objects = |material: Material| {
            vec![sphere([0.0; 3], 1.0, material), sphere([0.0, 0.0, -9.0], 5.0, diffuse([0.1, 0.2, 0.3]))]
        };
        let desc = scene(3, vec![], objects(material)).camera([0.0, 0.0, 4.0], [0.0; 3], 2.0).background([1.0; 3]);
        let film = render(&compiled(&desc), &samples(4), &Unobserved);
        assert_eq!(layer::<3>(&film, Layer::Albedo), [expected; 9]);
        assert!(layer::<1>(&film, Layer::Depth).iter().all(|[depth]| (3.0..3.01).contains(depth)));
    }
}

/// What guides a denoiser is what is seen over mirrors and through glass, times their tints and by its share: the sum
/// of both ways at a pane, whatever way paths take.
#[test]
fn mirrors_and_glass_show_what_guides_denoisers() {
    let wall = |z: f64, albedo: [f64; 3]| rectangle([0.0, 0.0, z], [0.0, 0.0, -z], [9.0; 2], diffuse(albedo));
    // The eye looks at a mirror, which shows the wall behind the eye.
    let (tint, behind) = ([0.9, 0.8, 0.7], [0.1, 0.5, 0.3]);
    let objects = vec![rectangle([0.0; 3], [0.0, 0.0, 1.0], [4.0; 2], mirror(tint)), wall(6.0, behind)];
    let seen = |objects: Vec<Object>, count: u32| {
        let desc = scene(3, vec![], objects).camera([0.0, 0.0, 4.0], [0.0; 3], 2.0).background([1.0; 3]);
        render(&compiled(&desc), &samples(count), &Unobserved)
    };
    let film = seen(objects, 4);
    let near = |a: [f32; 3], b: [f64; 3], by: f64| (0..3).all(|c| (f64::from(a[c]) - b[c]).abs() < by);
    let product = [0, 1, 2].map(|c| tint[c] * behind[c]);
    assert!(layer::<3>(&film, Layer::DenoisingAlbedo).into_iter().all(|albedo| near(albedo, product, 1e-6)));
    let grey = (0.9 + 0.8 + 0.7) / 3.0;
    assert!(layer::<3>(&film, Layer::DenoisingNormal).into_iter().all(|n| near(n, [0.0, 0.0, -grey], 1e-6)));
    // A pane before a wall: of what its two faces reflect, r each, 2r/(1+r) come back to the eye and see the sky, which
    // is white, and the rest the wall. Paths go both ways at three vertices; further ones are a matter of chance.
    let r = (0.5f64 / 2.5).powi(2);
    let back = 2.0 * r / (1.0 + r);
    let pane = cuboid([0.0; 3], [4.0, 4.0, 0.2], glass(1.5), vec![]);
    let film = seen(vec![pane, wall(-6.0, behind)], 256);
    let expected = behind.map(|albedo| back + (1.0 - back) * albedo);
    let mean = |values: Vec<[f32; 3]>| {
        let sum = |c: usize| values.iter().map(|value| f64::from(value[c])).sum::<f64>();
        [0, 1, 2].map(|c| sum(c) / values.len() as f64)
    };
    // What is left to chance, r^3, in 2304 samples.
    let by = 3.0 * (r.powi(3) / 2304.0).sqrt();
    for (found, expected) in mean(layer(&film, Layer::DenoisingAlbedo)).into_iter().zip(expected) {
        assert!((found - expected).abs() < by + 1e-5, "{found} {expected} {by}");
    }
    let [x, y, z] = mean(layer(&film, Layer::DenoisingNormal));
    assert!(x.abs() < 1e-6 && y.abs() < 1e-6 && (z - (1.0 - back)).abs() < by + 1e-5, "{z}");
    // Where there are neither, they are albedo and normal, and white beyond all surfaces.
    let balls = vec![
        sphere([0.0; 3], 1.0, diffuse([0.2, 0.4, 0.6])),
        sphere([0.7, 0.5, 1.0], 0.4, blinn_phong([0.6, 0.4, 0.9], 300.0, 0.2)),
    ];
    let plain = scene(24, vec![light([-0.8, 0.9, 1.0], 0.3, [5.0; 3])], balls);
    let plain = plain.camera([0.0, 0.0, 4.0], [0.0; 3], 45.0).background([1.0; 3]);
    let film = render(&compiled(&plain), &samples(2), &Unobserved);
    let alpha = layer::<1>(&film, Layer::Alpha);
    let both = layer::<3>(&film, Layer::Albedo).into_iter().zip(layer::<3>(&film, Layer::DenoisingAlbedo));
    for ((first, seen), [alpha]) in both.zip(alpha) {
        assert!((0..3).all(|c| (first[c] + 1.0 - alpha - seen[c]).abs() < 1e-6), "{first:?} {seen:?} {alpha}");
    }
    assert_eq!(layer::<3>(&film, Layer::Normal), layer::<3>(&film, Layer::DenoisingNormal));
}

/// Whatever of threads, lanes, crop and acceleration.
#[test]
fn the_same_bytes_whatever_the_schedule() {
    let scene = compiled(&open());
    let asked = with_layers(RenderOptions { samples: Some(5), ..options() });
    let expected = bits(&render(&scene, &asked, &Unobserved));
    let crop = Crop { x: 3, y: 5, width: 21, height: 11 };
    for level in Level::available() {
        for (threads, crop) in [(1, None), (2, Some(crop)), (3, None)] {
            // Without hardware fma a sample costs a hundred times more.
            let crop = crop.or((level == Level::PORTABLE).then_some(Crop { x: 8, y: 8, width: 16, height: 8 }));
            let film = render(&scene, &RenderOptions { threads, crop, level: Some(level), ..asked }, &Unobserved);
            let part = crop.unwrap_or(Crop::whole(scene.size));
            assert!(bits(&film) == cut_bits(&expected, scene.size, part), "{threads} threads, {}", level.name());
        }
    }
    // What another structure costs is another thing.
    let same = |layer: Layer| !matches!(layer, Layer::Nodes | Layer::Leaves);
    let expected = bits_of(&render(&scene, &asked, &Unobserved), same);
    for acceleration in [Acceleration::BoundingBox, Acceleration::None] {
        let mut desc = open();
        desc.render.acceleration = acceleration;
        assert!(bits_of(&render(&compiled(&desc), &asked, &Unobserved), same) == expected, "{acceleration:?}");
    }
}

fn cut_bits(picture: &[Vec<u32>], size: [u32; 2], crop: Crop) -> Vec<Vec<u32>> {
    let numbers: Vec<usize> = (0..picture.len()).collect();
    cut(&numbers, size, crop).into_iter().map(|k| picture[k].clone()).collect()
}

/// The picture does not know of its layers, nor a layer of the others.
#[test]
fn the_picture_is_the_same_with_and_without_layers() {
    let scene = compiled(&open());
    let options = RenderOptions { samples: Some(3), ..options() };
    let (without, with) = (render(&scene, &options, &Unobserved), render(&scene, &with_layers(options), &Unobserved));
    assert!(crate::same_bytes::bits(&with) == crate::same_bytes::bits(&without));
    assert_eq!((with.counters, without.layers()), (without.counters, LayerSet::default()));
    for layer in LayerSet::all().iter() {
        let alone = RenderOptions { layers: Some(LayerSet::from_iter([layer])), ..options };
        let alone = render(&scene, &alone, &Unobserved);
        assert_eq!(alone.layer(layer), with.layer(layer));
        assert_eq!(without.layer(layer), None);
    }
}

fn saved(film: &Film) -> Vec<u8> {
    let mut bytes = Vec::new();
    film.save(&mut bytes, &[]).expect("memory");
    bytes
}

/// A film that was saved and gone on with is the one made at once; one of other layers is refused.
#[test]
fn films_with_layers_are_gone_on_with() {
    let scene: Scene = compiled(&open());
    let asked = |samples: u32| with_layers(RenderOptions { samples: Some(samples), ..options() });
    let film = render(&scene, &asked(3), &Unobserved);
    let bytes = saved(&film);
    let back = Film::load(&mut bytes.as_slice()).expect("it was saved");
    assert!(bits(&back) == bits(&film) && back.layers() == film.layers());
    assert!(film.bytes() <= Film::bytes_of(film.crop(), false, true, film.layers(), false) as usize);
    let whole = resume(&scene, &asked(8), back, &Unobserved).expect("it is of this scene");
    assert!(bits(&whole) == bits(&render(&scene, &asked(8), &Unobserved)));
    for layers in [LayerSet::default(), LayerSet::from_iter([Layer::Depth])] {
        let other = RenderOptions { layers: Some(layers), ..asked(8) };
        let back = Film::load(&mut bytes.as_slice()).expect("it was saved");
        assert_eq!(resume(&scene, &other, back, &Unobserved).unwrap_err(), Misfit::Setting("set of layers"));
    }
    // A byte that is changed is noticed wherever it is.
    for at in (0..bytes.len()).step_by(997) {
        let mut broken = bytes.clone();
        broken[at] ^= 16;
        assert!(Film::load(&mut broken.as_slice()).is_err(), "byte {at}");
    }
}

/// Path lengths of scenes where they are known, and what a mirror adds; the tree is asked where there is one.
#[test]
fn what_rays_cost_is_counted() {
    let of = |layer: Layer, desc: &SceneDesc| -> Vec<f32> {
        let film = render(&compiled(desc), &samples(4), &Unobserved);
        self::layer::<1>(&film, layer).iter().map(|x| x[0]).collect()
    };
    let plain = |mut desc: SceneDesc| {
        desc.render.integrator = Integrator::Path;
        desc
    };
    let mirrors = |bounces: u32| {
        let ball = sphere([0.0; 3], 1.0, mirror([0.9; 3]));
        let desc = scene(3, vec![], vec![ball]).camera([0.0, 0.0, 4.0], [0.0; 3], 2.0).background([1.0; 3]);
        plain(desc.bounces(bounces))
    };
    // The camera's ray, and the mirrored one that leaves.
    assert_eq!(of(Layer::PathLength, &mirrors(3)), [2.0; 9]);
    assert_eq!(of(Layer::PathLength, &plain(scene(3, vec![], vec![]).background([1.0; 3]))), [1.0; 9]);
    // Between two mirrors as large as worlds rays go to and fro: one more for each bounce.
    let between = |bounces: u32| {
        let walls = [-1.0, 1.0].map(|side| sphere([0.0, 0.0, side * 1001.0], 1000.0, mirror([1.0; 3])));
        plain(scene(3, vec![], walls.into()).camera([0.0; 3], [0.0, 0.0, -1.0], 0.001).bounces(bounces))
    };
    for bounces in [0, 1, 2, 5] {
        assert_eq!(of(Layer::PathLength, &between(bounces)), [bounces as f32 + 2.0; 9]);
    }
    // One ball is asked by every ray; there is no tree. A mesh has one, and shadow rays ask it, too.
    assert_eq!(of(Layer::Nodes, &mirrors(3)), [0.0; 9]);
    let cat = |lights| {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/cat.obj");
        let cat = mesh(file.as_ref(), diffuse([0.5; 3]), scene_format::desc::Shading::Auto, vec![]);
        plain(scene(16, lights, vec![cat]).camera([0.0, 5.0, 60.0], [0.0; 3], 40.0).bounces(0))
    };
    let lit = cat(vec![light([0.0, 60.0, 30.0], 5.0, [10.0; 3])]);
    let (dark, bright) = (of(Layer::Nodes, &cat(vec![])), of(Layer::Nodes, &lit));
    assert!(dark.iter().zip(&bright).all(|(dark, bright)| dark <= bright));
    assert!(bright.iter().sum::<f32>() > dark.iter().sum::<f32>() && dark.iter().any(|&n| n >= 3.0), "{dark:?}");
    let leaves = of(Layer::Leaves, &lit);
    assert!(leaves.iter().any(|&n| n >= 1.0) && leaves.iter().zip(&bright).all(|(leaf, node)| *leaf <= 8.0 * node));
}

/// Ends when there are so many samples.
struct Until(u64);

impl Observer for Until {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        if progress.samples_done < self.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// Where a rendering was ended early, pixels have unlike numbers of samples.
#[test]
fn samples_are_counted() {
    let all = render(&compiled(&everything()), &samples(5), &Unobserved);
    assert!(layer::<1>(&all, Layer::Samples).iter().all(|[count]| *count == 5.0));
    let film = render(&compiled(&everything()), &samples(64), &Until(3000));
    let counts = layer::<1>(&film, Layer::Samples);
    let (least, most) = counts.iter().fold((f32::MAX, 0.0f32), |(a, b), [x]| (a.min(*x), b.max(*x)));
    assert_eq!((least as u32, most as u32), film.samples().into_inner());
    assert!(least < most, "{least} {most}");
}

/// The standard error relative to the pixel's own luminance, as the film has both.
#[test]
fn noise_is_that_of_the_variance() {
    let film = render(&compiled(&everything()), &samples(8), &Unobserved);
    let noise = layer::<1>(&film, Layer::Noise);
    for (k, [noise]) in noise.iter().enumerate() {
        let (x, y) = (k as u32 % 37, k as u32 / 37);
        let [r, g, b] = film.radiance(x, y);
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let expected = if luminance > 0.0 { film.variance(x, y).sqrt() / luminance } else { 0.0 };
        assert!((f64::from(*noise) - expected).abs() <= 1e-6 * expected, "{k}: {noise} {expected}");
    }
    assert!(noise.iter().any(|[noise]| *noise > 0.01));
}
