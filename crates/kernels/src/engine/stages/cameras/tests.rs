//! Where a point falls is where its pixel's ray comes from, and what a pixel sees is as large as told.

use super::*;
use crate::lanes::{ArrayF, Mask};
use crate::sampling::sampler::hash3;
use crate::scene::{Filter, FisheyeMapping, Lens, Stereo};
use glam::DVec3;

type One = ArrayF<1>;

const SIZE: [u32; 2] = [64, 48];

fn number(x: One) -> f64 {
    let mut out = [0.0];
    x.store(&mut out);
    f64::from(out[0])
}

fn vector(v: V3<One>) -> DVec3 {
    DVec3::new(number(v.0), number(v.1), number(v.2))
}

fn splat(v: DVec3) -> V3<One> {
    V3::splat(v.as_vec3().to_array())
}

/// One that looks aslant, its sides as long as asked.
fn camera(projection: Projection, right: f64, up: f64, near: f64) -> Camera {
    Camera {
        eye: DVec3::new(0.1, 0.2, 0.3),
        forward: DVec3::new(0.0, 0.6, -0.8),
        right: DVec3::new(right, 0.0, 0.0),
        up: DVec3::new(0.0, 0.8, 0.6) * up,
        projection,
        stereo: None,
        near,
        filter: Filter::Box,
    }
}

fn stereo(camera: Camera, inwards: f64, above: bool) -> Camera {
    Camera { stereo: Some(Stereo { aside: 0.06, inwards, above }), ..camera }
}

fn cameras() -> Vec<Camera> {
    let lens = Lens { radius: 0.05, focus_distance: 1.7, blades: 0, rotation: 0.1, tilted: None };
    let tilted = Some(DVec3::new(0.3, 0.6 + 0.4 * 0.8, -0.8 + 0.4 * 0.6));
    let through = |shift, lens| Projection::Perspective { shift, lens };
    let fisheye = |mapping, scale| camera(Projection::Fisheye { mapping, scale }, 64.0 / 48.0, 1.0, 0.0);
    vec![
        camera(through([0.0; 2], None), 0.7, 0.5, 0.0),
        camera(through([0.3, -1.2], None), 0.7, 0.5, 0.25),
        camera(through([0.0; 2], Some(lens)), 0.7, 0.5, 0.0),
        camera(through([0.2, 0.4], Some(Lens { blades: 5, ..lens })), 0.7, 0.5, 0.4),
        camera(through([0.0, 0.5], Some(Lens { tilted, ..lens })), 0.7, 0.5, 0.0),
        camera(Projection::Orthographic, 1.2, 0.9, 0.0),
        camera(Projection::Orthographic, 1.2, 0.9, 0.3),
        camera(Projection::Panorama, 1.0, 1.0, 0.0),
        fisheye(FisheyeMapping::Equidistant, 3.0),
        fisheye(FisheyeMapping::Equisolid, libm::sin(1.2)),
        fisheye(FisheyeMapping::Stereographic, libm::tan(1.3)),
        fisheye(FisheyeMapping::Orthographic, libm::sin(1.4)),
        stereo(camera(through([0.0; 2], None), 0.35, 0.5, 0.0), 0.07, false),
        stereo(camera(through([0.2, 0.4], Some(Lens { blades: 5, ..lens })), 0.7, 0.25, 0.4), 0.0, true),
        stereo(camera(through([0.0, 0.5], Some(Lens { tilted, ..lens })), 0.35, 0.5, 0.0), -0.03, false),
        stereo(camera(Projection::Panorama, 1.0, 1.0, 0.0), 0.0, true),
        stereo(camera(Projection::Panorama, 1.0, 1.0, 0.0), 0.0, false),
        // The plane of focus cuts through the lens.
        camera(through([0.0, 0.5], Some(Lens { tilted, radius: 1.0, focus_distance: 0.5, ..lens })), 0.7, 0.5, 0.0),
    ]
}

#[test]
fn points_fall_where_they_are_seen() {
    for (c, camera) in cameras().iter().enumerate() {
        let view = View::<One>::new(camera, SIZE);
        let mut seen = 0;
        for k in 0..400 {
            let of = |salt: u32| (hash3(k, salt, 7) >> 40) as f32 / (1u32 << 24) as f32;
            let lens = (One::splat(of(2)), One::splat(of(3)));
            // Column and row, in pixels from the picture's corner, and the ray there as origin and unit direction.
            let (x, y) = (64.0 * f64::from(of(0)), 48.0 * f64::from(of(1)));
            // Of the two eyes of stereo that which the pixel is of, by the number that chooses it.
            let eye = view.eye(One::splat((x / 32.0 - 1.0) as f32), One::splat((1.0 - y / 24.0) as f32));
            let mut to_lens = lens;
            if number(eye) != 0.0 {
                to_lens.0 = One::splat((of(2) + f32::from(number(eye) > 0.0)) / 2.0);
            }
            let ray = |x: f64, y: f64| {
                let at = ((x / 32.0 - 1.0) as f32, (1.0 - y / 24.0) as f32);
                let ray = view.ray(eye, One::splat(at.0), One::splat(at.1), lens);
                ray.seen.any().then(|| (vector(ray.origin), vector(ray.direction).normalize(), number(ray.measure)))
            };
            let beside = [(0.0, 0.0), (0.25, 0.0), (-0.25, 0.0), (0.0, 0.25), (0.0, -0.25)];
            let Some((origin, direction, measure)) = ray(x, y) else { continue };
            let rays: Vec<_> = beside.iter().filter_map(|(dx, dy)| ray(x + dx, y + dy)).collect();
            // A point on the ray, and the plane through it that the surface lies in.
            let t = 0.5 + f64::from(of(4));
            let point = origin + direction * t;
            let normal = (DVec3::new(0.3, -0.2, 0.1) - direction).normalize();
            let place = view.place(splat(point), to_lens);
            assert!(place.seen.any(), "{c}: {x} {y}");
            let (px, py) = (number(place.x), number(place.y));
            assert!((px - x).abs() < 4e-3 && (py - y).abs() < 4e-3, "{c}: {x} {y} is {px} {py}");
            assert!((vector(place.wo) + direction).length() < 1e-5, "{c}");
            assert!((number(place.free) - t).abs() < 1e-4, "{c}: free {} of {t}", number(place.free));
            // Near the border of a panorama measures are of what lies in the picture.
            if measure != 0.0 {
                assert!((number(place.measure) / measure - 1.0).abs() < 1e-3, "{c}: {x} {y}");
            }
            if rays.len() < 5 || measure == 0.0 {
                continue;
            }
            seen += 1;
            let on_plane = |k: usize| {
                let (o, d, _) = rays[k];
                o + d * ((point - o).dot(normal) / d.dot(normal))
            };
            // Of half a pixel by half a pixel.
            let mut sides = 4.0 * (on_plane(1) - on_plane(2)).cross(on_plane(3) - on_plane(4));
            if camera.stereo.is_some() {
                // A light path goes to either eye half of the time.
                sides /= 2.0;
            }
            let cos_to_view = direction.dot(camera.forward);
            let cos = -direction.dot(normal);
            let area = view.area(place.distance, One::splat(cos_to_view as f32), One::splat(cos as f32));
            let area = number(area) * measure;
            // A quarter of a pixel to all sides; next to the poles of a panorama, and to the circle of a fisheye, that
            // is no small part of what is left. An eye's half has half as many pixels, which errors go with squared.
            let bound = if camera.stereo.is_some() || (x - 32.0).hypot(y - 24.0) > 19.0 { 2e-2 } else { 6e-3 };
            assert!((area / sides.length() - 1.0).abs() < bound, "{c}: {x} {y}: {area} and {}", sides.length());
        }
        assert!(seen > 200, "{c}: {seen}");
    }
}

/// Nothing is seen around a fisheye's circle, nor behind the eye; nor nearer than asked.
#[test]
fn what_is_not_seen() {
    let cameras = cameras();
    for camera in &cameras[8..12] {
        let view = View::<One>::new(camera, SIZE);
        let seen = |x: f32, y: f32| {
            view.ray(One::splat(0.0), One::splat(x), One::splat(y), (One::splat(0.5), One::splat(0.5))).seen.any()
        };
        assert!(seen(0.0, 0.99) && seen(0.74, 0.0) && !seen(0.76, 0.0) && !seen(0.6, 0.9) && !seen(0.0, -1.01));
    }
    let falls = |camera: &Camera, depth: f64| {
        let point = camera.eye + camera.forward * depth;
        View::<One>::new(camera, SIZE).place(splat(point), (One::splat(0.5), One::splat(0.5))).seen.any()
    };
    for k in [0, 2, 5] {
        assert!(falls(&cameras[k], 0.1) && !falls(&cameras[k], -0.1), "{k}");
    }
    for (k, near) in [(1, 0.25), (3, 0.4), (6, 0.3)] {
        assert!(falls(&cameras[k], near + 0.05) && !falls(&cameras[k], near - 0.05), "{k}");
    }
    assert!(falls(&cameras[7], -0.3));
}

/// The rays of a panorama of two eyes touch their circle: none leads to what is above or below it, 0.06 wide here.
#[test]
fn panoramas_of_two_eyes_do_not_see_what_is_above_their_circle() {
    for camera in cameras().iter().filter(|camera| camera.stereo.is_some() && camera.projection == Projection::Panorama)
    {
        let view = View::<One>::new(camera, SIZE);
        let up = camera.right.cross(camera.forward).normalize();
        let falls = |aside: f64, lens: f32| {
            let ahead = 0.6 * camera.forward.normalize() + 0.8 * camera.right.normalize();
            let point = camera.eye + ahead * aside - up;
            view.place(splat(point), (One::splat(lens), One::splat(0.5))).seen.any()
        };
        for lens in [0.25, 0.75] {
            assert!(falls(0.07, lens) && !falls(0.05, lens) && !falls(0.0, lens), "{lens}");
        }
    }
}

/// The points of a lens with blades fill a polygon evenly.
#[test]
fn lenses_with_blades_are_polygons() {
    let lens = Lens { radius: 0.5, focus_distance: 1.0, blades: 5, rotation: 0.25, tilted: None };
    let camera = camera(Projection::Perspective { shift: [0.0; 2], lens: Some(lens) }, 0.7, 0.5, 0.0);
    let view = View::<One>::new(&camera, SIZE);
    let (right, up) = (camera.right.normalize(), camera.up.normalize());
    let (n, mut moments, mut highest) = (256, [0.0; 3], 0.0f64);
    for k in 0..n * n {
        let (u, v) = (((k % n) as f32 + 0.5) / n as f32, ((k / n) as f32 + 0.5) / n as f32);
        let at = vector(view.lens(view.eye, Some(lens), (One::splat(u), One::splat(v)))) - camera.eye;
        let (x, y) = (at.dot(right), at.dot(up));
        for k in 0..5 {
            // Each side's normal; the inner radius is r cos(pi / 5).
            let angle = std::f64::consts::TAU * (0.25 + 0.1 + 0.2 * f64::from(k));
            assert!(x * angle.cos() + y * angle.sin() < 0.5 * (std::f64::consts::PI / 5.0).cos() + 1e-6);
        }
        highest = highest.max(y);
        moments = [moments[0] + x, moments[1] + y, moments[2] + x * x + y * y];
    }
    let count = f64::from(n * n);
    // The second moment of a regular polygon about its middle: R^2 (2 + cos(2 pi / n)) / 6.
    let second = 0.25 * (2.0 + (std::f64::consts::TAU / 5.0).cos()) / 6.0;
    assert!(moments[0].abs() / count < 1e-4 && moments[1].abs() / count < 1e-4, "{moments:?}");
    assert!((moments[2] / count / second - 1.0).abs() < 1e-3, "{} {second}", moments[2] / count);
    assert!((highest - 0.5).abs() < 5e-3, "{highest}");
}
