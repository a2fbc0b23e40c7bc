//! Projections, lenses, moved film: by closed forms, against the reference, and light paths against paths.

use crate::caustics::on_the_floor;
use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture};
use crate::support::describe::*;
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use scene_format::desc::{FisheyeMapping, Focus, FovAxis, PixelFilter, Projection, Stereo, StereoLayout, ThinLens};
use tracer_core::{Layer, LayerSet, RenderOptions, Unobserved, render};

/// All that are compared with paths alone here, for the strictness of the tests.
const SCENES: usize = 12;

/// Where small lamps at these points are seen in a picture of `size` pixels, in pixels from the upper left corner: the
/// middle of what each shows by itself.
fn seen(desc: &SceneDesc, points: &[[f64; 3]], radius: f64) -> Vec<Option<[f64; 2]>> {
    let of = |point: &[f64; 3]| {
        let mut desc = desc.clone();
        desc.lights = scene(8, vec![light(*point, radius, [1.0; 3])], Vec::new()).lights;
        let film = film(&compiled(&desc), 16, 1);
        let [width, height] = film.size();
        let mut sums = [0.0; 3];
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let bright = film.radiance(x, y)[0];
            sums = [sums[0] + bright, sums[1] + bright * (f64::from(x) + 0.5), sums[2] + bright * (f64::from(y) + 0.5)];
        }
        (sums[0] > 0.0).then(|| [sums[1] / sums[0], sums[2] / sums[0]])
    };
    points.iter().map(of).collect()
}

/// Looks along -z from the origin, without anything that scatters.
fn empty(projection: Projection, [width, height]: [u32; 2]) -> SceneDesc {
    let far = sphere([0.0, 0.0, 900.0], 1.0, diffuse([0.0; 3]));
    let mut desc = scene(8, Vec::new(), vec![far]).camera([0.0; 3], [0.0, 0.0, -1.0], 40.0).bounces(0);
    (desc.image.width, desc.image.height) = (width.into(), height.into());
    desc.camera.projection = projection;
    desc
}

fn assert_seen(name: &str, desc: &SceneDesc, points: &[([f64; 3], Option<[f64; 2]>)], radius: f64) {
    let at: Vec<[f64; 3]> = points.iter().map(|(point, _)| *point).collect();
    for (found, (point, expected)) in seen(desc, &at, radius).iter().zip(points) {
        let near = match (found, expected) {
            // 16 samples a pixel over a disc of three pixels and more: a twentieth of a pixel.
            (Some(a), Some(b)) => (a[0] - b[0]).abs() < 0.15 && (a[1] - b[1]).abs() < 0.15,
            (a, b) => a.is_none() && b.is_none(),
        };
        assert!(near, "{name}: {point:?} is seen at {found:?}, not {expected:?}");
    }
}

#[test]
fn orthographic_pictures_do_not_shrink_with_distance() {
    let mut desc = empty(Projection::Orthographic { height: 4.0.into() }, [96, 64]);
    // 16 pixels to a unit; behind the plane of the eye nothing is seen.
    let points = [
        ([0.0, 0.0, -3.0], Some([48.0, 32.0])),
        ([1.5, 1.0, -3.0], Some([72.0, 16.0])),
        ([1.5, 1.0, -300.0], Some([72.0, 16.0])),
        ([0.0, 0.0, 3.0], None),
    ];
    assert_seen("orthographic", &desc, &points, 0.2);
    desc.camera.shift = [0.25, -0.5].into();
    assert_seen("shifted", &desc, &[([1.0, -2.0, -3.0], Some([48.0, 32.0]))], 0.2);
    desc.camera.shift = [0.0; 2].into();
    desc.camera.near = Some(5.0.into());
    assert_seen("near", &desc, &[([0.0, 0.0, -4.0], None), ([0.0, 0.0, -6.0], Some([48.0, 32.0]))], 0.2);
}

#[test]
fn panoramas_show_all_directions() {
    let desc = empty(Projection::Panorama, [128, 64]);
    let sixty = [0.0, 10.0 * (60f64.to_radians()).sin(), -10.0 * (60f64.to_radians()).cos()];
    let points = [
        ([0.0, 0.0, -10.0], Some([64.0, 32.0])),
        ([10.0, 0.0, 0.0], Some([96.0, 32.0])),
        ([-10.0, 0.0, 0.0], Some([32.0, 32.0])),
        (sixty, Some([64.0, 32.0 - 64.0 / 3.0])),
        ([10.0, 0.0, 10.0], Some([112.0, 32.0])),
    ];
    assert_seen("panorama", &desc, &points, 0.6);
}

#[test]
fn fisheyes_map_angles_as_they_say() {
    let mapped = |mapping, fov: f64, r: fn(f64) -> f64| {
        let desc = empty(Projection::Fisheye { fov: fov.into(), mapping }, [96, 64]);
        for degrees in [0.0_f64, 20.0, 45.0, 70.0, 85.0, 110.0] {
            let angle = degrees.to_radians();
            if degrees > 0.45 * fov {
                continue;
            }
            // Up and to the right.
            let side = 10.0 * angle.sin() * 0.5f64.sqrt();
            let at = 32.0 * r(angle) / r(fov.to_radians() / 2.0) * 0.5f64.sqrt();
            let point = ([side, side, -10.0 * angle.cos()], Some([48.0 + at, 32.0 - at]));
            assert_seen(&format!("{mapping:?} at {degrees}"), &desc, &[point], 0.5);
        }
    };
    mapped(FisheyeMapping::Equidistant, 250.0, |t| t);
    mapped(FisheyeMapping::Equisolid, 250.0, |t| (t / 2.0).sin());
    mapped(FisheyeMapping::Stereographic, 200.0, |t| (t / 2.0).tan());
    mapped(FisheyeMapping::Orthographic, 160.0, f64::sin);
}

#[test]
fn perspective_by_focal_length_axis_and_shift() {
    // A lens of 50 mm before 36 mm of film: half a picture's width at distance 50 is 18.
    let mut desc = empty(Projection::Perspective, [96, 64]);
    desc.camera.focal_length = Some(50.0.into());
    assert_seen("50 mm", &desc, &[([9.0, 6.0, -50.0], Some([72.0, 16.0]))], 1.0);
    desc.camera.sensor_width = 72.0.into();
    assert_seen("wide film", &desc, &[([18.0, 12.0, -50.0], Some([72.0, 16.0]))], 1.5);
    // 90 degrees along each axis: the edge or corner at distance ten.
    for (axis, half_width) in [
        (FovAxis::Horizontal, 10.0),
        (FovAxis::Larger, 10.0),
        (FovAxis::Vertical, 15.0),
        (FovAxis::Smaller, 15.0),
        (FovAxis::Diagonal, 10.0 * 3.0 / 13f64.sqrt()),
    ] {
        let mut desc = empty(Projection::Perspective, [96, 64]).camera([0.0; 3], [0.0, 0.0, -1.0], 90.0);
        desc.camera.fov_axis = axis;
        assert_seen(&format!("{axis:?}"), &desc, &[([half_width / 2.0, 0.0, -10.0], Some([72.0, 32.0]))], 0.5);
    }
    let mut desc = empty(Projection::Perspective, [96, 64]).camera([0.0; 3], [0.0, 0.0, -1.0], 90.0);
    // Half a picture to the right and up, in heights.
    desc.camera.shift = [0.75, 0.5].into();
    assert_seen("shifted", &desc, &[([15.0, 10.0, -10.0], Some([48.0, 32.0]))], 0.5);
    desc.camera.near = Some(12.0.into());
    assert_seen("near", &desc, &[([15.0, 10.0, -10.0], None)], 0.5);
}

/// The root mean square distance of what a lamp shows from its middle, in pixels.
fn spread(desc: &SceneDesc, point: [f64; 3]) -> f64 {
    let mut desc = desc.clone();
    desc.lights = scene(8, vec![light(point, 0.02, [1.0; 3])], Vec::new()).lights;
    let film = film(&compiled(&desc), 512, 1);
    let [width, height] = film.size();
    let mut sums = [0.0; 4];
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let (bright, x, y) = (film.radiance(x, y)[0], f64::from(x), f64::from(y));
        let add = [1.0, x, y, x * x + y * y].map(|moment| bright * moment);
        (0..4).for_each(|k| sums[k] += add[k]);
    }
    let [n, x, y, squares] = sums;
    (squares / n - (x * x + y * y) / (n * n)).max(0.0).sqrt()
}

/// Turned by -60 degrees about the picture's right, the plane of focus through (0, 0, -5) leans away: it holds (0, y,
/// z) with y = -(z + 5) / tan 60. Points of it are sharp, others are blurred as far as they lie from it.
#[test]
fn tilted_lenses_are_sharp_in_their_plane() {
    let mut desc = empty(Projection::Perspective, [64, 64]).camera([0.0; 3], [0.0, 0.0, -1.0], 60.0);
    let lens = ThinLens { tilt: [-60.0, 0.0].into(), ..ThinLens::new(0.8, 5.0) };
    desc.effects.depth_of_field = Some(lens.clone());
    let tan = 60f64.to_radians().tan();
    let on_plane = |z: f64| [0.3, -(z + 5.0) / tan, z];
    for z in [-3.5, -5.0, -7.0] {
        assert!(spread(&desc, on_plane(z)) < 0.6, "{z}: {}", spread(&desc, on_plane(z)));
    }
    // In the upright plane of focus of a lens that is not tilted.
    assert!(spread(&desc, [0.3, 1.5, -5.0]) > 1.5);
    // The point in focus may be anywhere.
    desc.effects.depth_of_field = Some(ThinLens { focus: Focus::On([0.0, 1.0, -4.0]).into(), ..lens });
    assert!(spread(&desc, [0.5, 1.0 + 1.5 / tan, -5.5]) < 0.6 && spread(&desc, on_plane(-7.0)) > 1.5);
}

fn eyes(separation: f64, convergence: Option<f64>, layout: StereoLayout) -> Option<Stereo> {
    Some(Stereo { separation: separation.into(), convergence: convergence.map(Into::into), layout })
}

/// What the pixels of a picture show through their middles: object and position, row by row.
fn shown(desc: &SceneDesc) -> Vec<[f32; 4]> {
    let layers = LayerSet::from_iter([Layer::ObjectId, Layer::Position]);
    let options = RenderOptions { samples: Some(1), threads: 1, layers: Some(layers), ..RenderOptions::default() };
    let film = render(&compiled(desc), &options, &Unobserved);
    let of = |layer: Layer| film.layer(layer).expect("it was asked for").values.clone();
    let (objects, points) = (of(Layer::ObjectId), of(Layer::Position));
    objects.iter().zip(points.as_chunks::<3>().0).map(|(&object, p)| [object, p[0], p[1], p[2]]).collect()
}

/// Two cameras beside each other that are placed by hand, with their films moved, see what the two halves show.
#[test]
fn stereo_pictures_are_those_of_two_cameras() {
    let balls = (0..40).map(|k| {
        let k = f64::from(k);
        sphere([4.0 * (1.3 * k).sin(), 2.5 * (2.1 * k).cos(), -2.0 - 0.4 * k], 0.6, diffuse([0.5; 3]))
    });
    let mut desc = scene(8, Vec::new(), balls.collect()).camera([0.3, 0.2, 2.0], [0.3, 0.2, -6.0], 60.0);
    desc.effects.antialiasing = PixelFilter::None;
    let half_height = 30f64.to_radians().tan();
    for (layout, size) in [(StereoLayout::SideBySide, [40, 30]), (StereoLayout::TopBottom, [44, 26])] {
        for convergence in [None, Some(5.0)] {
            let mut whole = desc.clone();
            let beside = layout == StereoLayout::SideBySide;
            let all = if beside { [2 * size[0], size[1]] } else { [size[0], 2 * size[1]] };
            (whole.image.width, whole.image.height) = (all[0].into(), all[1].into());
            whole.camera.stereo = eyes(0.5, convergence, layout);
            let whole = shown(&whole);
            for (k, side) in [(0, -0.25), (1, 0.25)] {
                let mut one = desc.clone();
                (one.image.width, one.image.height) = (size[0].into(), size[1].into());
                one.camera.position.value[0] += side;
                one.camera.look_at.value[0] += side;
                // In picture heights: what is ahead of the middle at that distance comes to the middle.
                let moved = convergence.map_or(0.0, |distance| side / distance / (2.0 * half_height));
                one.camera.shift = [-moved, 0.0].into();
                let mut objects = 0;
                for (at, found) in shown(&one).into_iter().enumerate() {
                    let (x, y) = (at as u32 % size[0], at as u32 / size[0]);
                    let [x, y] = if beside { [x + k * size[0], y] } else { [x, y + k * size[1]] };
                    let there = whole[(y * all[0] + x) as usize];
                    assert_eq!(found[0], there[0], "{layout:?} {convergence:?} {x} {y}");
                    let off = (1..4).map(|c| (found[c] - there[c]).abs()).fold(0.0, f32::max);
                    assert!(off < 2e-3, "{layout:?} {convergence:?} {x} {y}: {found:?} {there:?}");
                    objects += u32::from(found[0] > 0.0);
                }
                assert!(objects > 200, "{objects}");
            }
        }
    }
}

/// In a panorama the eyes see a lamp at a distance r to the side by asin(a / r), whichever way it lies.
#[test]
fn stereo_panoramas_have_eyes_across_every_direction() {
    let (separation, width, height) = (0.8, 192, 96);
    let mut desc = empty(Projection::Panorama, [width, 2 * height]);
    desc.camera.stereo = eyes(separation, None, StereoLayout::TopBottom);
    for (turn, r, up) in [(0.0, 3.0, 0.0), (50.0, 2.0, 1.0), (-120.0, 2.5, -1.5), (80.0, 40.0, 9.0)] {
        let angle = f64::to_radians(turn);
        let point = [r * angle.sin(), up, -r * angle.cos()];
        desc.lights = scene(8, vec![light(point, 0.05 * r, [1.0; 3])], Vec::new()).lights;
        let film = film(&compiled(&desc), 16, 1);
        for (first, side) in [(0, -0.5), (height, 0.5)] {
            let mut sums = [0.0; 3];
            for (x, y) in (first..first + height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let bright = film.radiance(x, y)[0];
                let (x, y) = (f64::from(x) + 0.5, f64::from(y - first) + 0.5);
                sums = [sums[0] + bright, sums[1] + bright * x, sums[2] + bright * y];
            }
            let found = [sums[1] / sums[0], sums[2] / sums[0]];
            let a = side * separation;
            let longitude = turn - (a / r).asin().to_degrees();
            let latitude = up.atan2((r * r - a * a).sqrt()).to_degrees();
            let expected = [f64::from(width) * (0.5 + longitude / 360.0), f64::from(height) * (0.5 - latitude / 180.0)];
            let near = (0..2).all(|axis| (found[axis] - expected[axis]).abs() < 0.15);
            assert!(near, "{turn} {side}: {found:?}, not {expected:?}");
        }
    }
}

fn all() -> Vec<(&'static str, SceneDesc)> {
    let ball = sphere([0.0, 2.5, 0.0], 2.5, glass(1.5));
    let mirrored = sphere([-4.0, 2.0, 3.0], 2.0, mirror([0.9; 3]));
    let base = || on_the_floor(vec![ball.clone(), mirrored.clone()]);
    let with = |change: &dyn Fn(&mut SceneDesc)| {
        let mut desc = base();
        change(&mut desc);
        desc
    };
    let fisheye = |mapping: FisheyeMapping, fov: f64| {
        with(&|desc| {
            desc.camera.position = [-1.0, 3.0, 7.0].into();
            desc.camera.projection = Projection::Fisheye { fov: fov.into(), mapping };
            // Wider than high, so that the sides are not those of a square.
            desc.image.width = 40.into();
        })
    };
    let lens = ThinLens { blades: 5.into(), rotation: 20.0.into(), ..ThinLens::new(2.0, 20.0) };
    let tilted = ThinLens { tilt: [-50.0, 10.0].into(), ..lens.clone() };
    vec![
        ("orthographic", with(&|desc| desc.camera.projection = Projection::Orthographic { height: 18.0.into() })),
        (
            "near",
            with(&|desc| {
                desc.camera.projection = Projection::Orthographic { height: 18.0.into() };
                desc.camera.near = Some(21.0.into());
                desc.camera.shift = [0.1, -0.2].into();
            }),
        ),
        (
            "panorama",
            with(&|desc| {
                desc.camera.position = [-1.0, 3.0, 7.0].into();
                desc.camera.projection = Projection::Panorama;
                desc.image.width = 64.into();
                desc.effects.antialiasing = PixelFilter::Gaussian { sigma: 0.6.into() };
            }),
        ),
        ("equidistant", fisheye(FisheyeMapping::Equidistant, 220.0)),
        ("equisolid", fisheye(FisheyeMapping::Equisolid, 180.0)),
        ("stereographic", fisheye(FisheyeMapping::Stereographic, 200.0)),
        ("hemisphere", fisheye(FisheyeMapping::Orthographic, 170.0)),
        (
            "blades, shifted, near",
            with(&|desc| {
                desc.effects.depth_of_field = Some(lens.clone());
                desc.camera.shift = [0.1, 0.15].into();
                desc.camera.near = Some(20.0.into());
            }),
        ),
        ("tilted", with(&|desc| desc.effects.depth_of_field = Some(tilted.clone()))),
        (
            "stereo",
            with(&|desc| {
                desc.image.width = 56.into();
                desc.camera.stereo = eyes(2.0, Some(18.0), StereoLayout::SideBySide);
                desc.camera.shift = [0.1, 0.0].into();
                desc.effects.antialiasing = PixelFilter::Gaussian { sigma: 0.6.into() };
            }),
        ),
        (
            "stereo through a lens",
            with(&|desc| {
                desc.image.height = 48.into();
                desc.camera.stereo = eyes(1.5, None, StereoLayout::TopBottom);
                desc.camera.near = Some(5.0.into());
                desc.effects.depth_of_field = Some(tilted.clone());
            }),
        ),
        (
            "stereo panorama",
            with(&|desc| {
                desc.camera.position = [-1.0, 3.0, 7.0].into();
                desc.camera.projection = Projection::Panorama;
                desc.camera.stereo = eyes(1.0, None, StereoLayout::TopBottom);
                (desc.image.width, desc.image.height) = (64.into(), 64.into());
            }),
        ),
    ]
}

/// Light paths bring to every camera what paths do.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn light_paths_reach_all_cameras() {
    for (name, desc) in all() {
        assert_guiding_is_unbiased(name, &desc, 512, SCENES);
    }
}

/// Against the reference, whose cameras are written in other words.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn cameras_are_those_of_the_reference() {
    for (name, mut desc) in all() {
        // The lamp is wide: the reference finds it by chance.
        desc.render.max_bounces = 3.into();
        assert_same_picture(name, &desc, Samples { engine: 256, reference: 512 });
    }
}
