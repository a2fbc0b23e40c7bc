//! Surfaces in one plane do not speckle: one of them wins everywhere, whatever the distance, the angle, the attitude
//! and the kind of ray. Under a white sky a plane's radiance is its albedo, sample by sample, so there is no noise to
//! hide anything.

use crate::support::describe::*;
use crate::support::meshes::square;
use crate::support::{compiled, film};
use glam::{DQuat, DVec3};
use scene_format::desc::{
    Amount, Camera, Cylinder, Disk, Emissive, LightGroup, Material, MaterialRef, Name, Object, PerAxis, PixelFilter,
    Placements, RectBox, Rectangle, Shading, Transform,
};
use scene_format::diagnostic::Spanned;
use scene_format::{SceneDesc, codes};

pub(crate) const SIZE: u32 = 32;
pub(crate) const RED: [f64; 3] = [0.8, 0.1, 0.2];
pub(crate) const BLUE: [f64; 3] = [0.1, 0.3, 0.9];

/// Where the plane y = 0 of a description stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attitude {
    pub(crate) axis: DVec3,
    pub(crate) degrees: f64,
    pub(crate) place: DVec3,
}

impl Attitude {
    pub(crate) fn point(&self, p: DVec3) -> DVec3 {
        self.place + DQuat::from_axis_angle(self.axis, self.degrees.to_radians()) * p
    }

    /// The transforms of something that is turned by `turn` degrees in the plane, at `at`.
    pub(crate) fn steps(&self, turn: f64, at: [f64; 3]) -> Vec<Transform> {
        let about = |axis: [f64; 3], degrees: f64| Transform::Rotate { axis, degrees, about: Some(Box::new([0.0; 3])) };
        vec![
            about([0.0, 1.0, 0.0], turn),
            Transform::Translate(at),
            about(self.axis.to_array(), self.degrees),
            Transform::Translate(self.place.to_array()),
        ]
    }
}

pub(crate) fn of(material: Material) -> MaterialRef {
    MaterialRef::Inline(Box::new(material.into()))
}

pub(crate) fn rectangle(size: f64, material: Material, transform: Vec<Transform>) -> Object {
    Object::Rectangle(Box::new(Rectangle {
        size: PerAxis([size; 2]).into(),
        material: of(material),
        transform: transform.into_iter().map(Spanned::from).collect(),
        center: [0.0; 3].into(),
        normal: [0.0, 1.0, 0.0].into(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

/// A square of half side `size / 2` as an instance; its copy lies far away in the same plane, where nothing sees it.
fn instance(size: f64, material: Material, mut transform: Vec<Transform>, attitude: &Attitude) -> Object {
    transform.insert(0, scale(size / 2.0));
    let away = attitude.point(DVec3::X * 500.0) - attitude.place;
    let copies = [vec![], vec![Spanned::from(Transform::Translate(away.to_array()))]].into_iter().collect();
    placed(&square(1.0).obj("square-1"), material, Shading::Flat, transform, copies)
}

/// What lies in the plane at each pixel: a point of the plane, seen from `eye`.
pub(crate) fn points(eye: DVec3, look_at: DVec3, up: DVec3, fov: f64) -> Vec<DVec3> {
    let forward = (look_at - eye).normalize();
    let right = forward.cross(up).normalize();
    let (up, half) = (right.cross(forward), (fov / 2.0).to_radians().tan());
    let across = |k: u32| ((f64::from(k) + 0.5) / f64::from(SIZE) * 2.0 - 1.0) * half;
    let pixels = (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y)));
    pixels
        .map(|(x, y)| {
            let d = forward + across(x) * right - across(y) * up;
            eye - d * (eye.y / d.y)
        })
        .collect()
}

/// A sheet of 8 by 8 and a tile of 3 by 3 that is turned by 25 degrees, in the plane y = 0 of an attitude.
fn is_on_tile(p: DVec3) -> Option<bool> {
    let q = DQuat::from_rotation_y(-25f64.to_radians()) * (p - DVec3::new(0.4, 0.0, 0.2));
    let beside = q.x.abs().max(q.z.abs()) - 1.5;
    (beside.abs() > 0.02).then_some(beside < 0.0)
}

#[test]
fn the_first_is_seen_wherever_it_is() {
    let attitudes = [
        Attitude { axis: DVec3::X, degrees: 0.0, place: DVec3::ZERO },
        Attitude { axis: DVec3::Z, degrees: 90.0, place: DVec3::new(0.3, 0.7, -0.2) },
        Attitude { axis: DVec3::new(0.48, 0.6, 0.64), degrees: 47.0, place: DVec3::new(1.3, -2.7, 3.1) },
        Attitude { axis: DVec3::new(-0.8, 0.0, 0.6), degrees: 161.0, place: DVec3::new(40.0, 20.0, -70.0) },
    ];
    for (round, attitude) in attitudes.into_iter().enumerate() {
        // Near; at a grazing angle; far away; from below.
        for (view, eye, fov) in [
            ("near", DVec3::new(1.0, 3.0, 2.5), 60.0),
            ("grazing", DVec3::new(0.0, 0.12, 4.0), 30.0),
            ("far", DVec3::new(300.0, 400.0, 250.0), 0.5),
            ("below", DVec3::new(-0.5, -2.0, 2.0), 60.0),
        ] {
            for kind in 0..4 {
                let (sheet_first, instanced) = (kind & 1 == 0, kind & 2 != 0);
                let sheet = rectangle(8.0, diffuse(RED), attitude.steps(0.0, [0.0; 3]));
                let steps = attitude.steps(25.0, [0.4, 0.0, 0.2]);
                let tile = match instanced {
                    true => instance(3.0, diffuse(BLUE), steps, &attitude),
                    false => rectangle(3.0, diffuse(BLUE), steps),
                };
                let objects = if sheet_first { vec![sheet, tile] } else { vec![tile, sheet] };
                let mut desc = scene(SIZE, vec![], objects)
                    .background([1.0; 3])
                    .camera(attitude.point(eye).to_array(), attitude.point(DVec3::ZERO).to_array(), fov)
                    .bounces(2)
                    .filter(PixelFilter::None);
                let turned_up = attitude.point(DVec3::Y) - attitude.place;
                desc.camera.up = turned_up.to_array().into();
                let film = film(&compiled(&desc), 4, round as u32);
                let mut told = 0;
                for (k, p) in (0u32..).zip(points(eye, DVec3::ZERO, DVec3::Y, fov)) {
                    let (Some(on_tile), beside) = (is_on_tile(p), p.x.abs().max(p.z.abs())) else { continue };
                    // Above the horizon there is no such point.
                    if beside > 3.9 || (p - eye).length() > 10.0 * eye.length() {
                        continue;
                    }
                    let expected = if on_tile && !sheet_first { BLUE } else { RED };
                    let seen = film.radiance(k % SIZE, k / SIZE);
                    let same = (0..3).all(|c| (seen[c] - expected[c]).abs() < 1e-4);
                    assert!(same, "round {round}, {view}, kind {kind}, pixel {k}: {seen:?}, not {expected:?}");
                    told += usize::from(on_tile);
                }
                assert!(told > 60, "{view} shows {told} pixels of the tile");
            }
        }
    }
}

/// A lamp in the plane of the ceiling lights the floor as one without a ceiling, and is seen whole. Rays to it end
/// before all that may lie in its plane by rounding, by some 16 units in the last place of the farthest corner, so that
/// it lights as if it hung lower by o: at h = 2 above the floor and a distance of d that gets h^2 / d^4 of it, of which
/// o changes at most 2 o / h + 4 o h / d^2 <= 6 o / h. A wide ceiling is seen beside the floor, where it gets nothing
/// but for roundings.
#[test]
fn a_lamp_let_into_the_ceiling_shines() {
    let emissive = Material::Emissive(Box::new(Emissive {
        amount: Amount::Radiance([3.0; 3]).into(),
        color: [1.0; 3].into(),
        two_sided: false,
        group: LightGroup::default(),
    }));
    for (turn, wide) in [(0.0, 7.0), (33.0, 7.0), (0.0, 3000.0), (33.0, 3000.0)] {
        let attitude = Attitude { axis: DVec3::new(0.6, 0.0, 0.8), degrees: turn, place: DVec3::new(0.1, 0.2, 0.3) };
        let down = |mut steps: Vec<Transform>| {
            let over = Transform::Rotate { axis: [1.0, 0.0, 0.0], degrees: 180.0, about: Some(Box::new([0.0; 3])) };
            steps.insert(0, over);
            steps
        };
        let up = [0.0, 2.0, 0.0];
        let lamp = rectangle(1.3, emissive.clone(), down(attitude.steps(25.0, up)));
        let ceiling = rectangle(wide, diffuse([0.5; 3]), down(attitude.steps(0.0, up)));
        let floor = rectangle(60.0, diffuse([0.5; 3]), attitude.steps(10.0, [0.0; 3]));
        let lower = 16.0 * wide / 16_777_216.0;
        let tolerance = f64::max(1e-4, 6.0 * lower / 2.0);
        let seen = |objects: Vec<Object>, eye: DVec3, look_at: DVec3| {
            let desc = scene(SIZE, vec![], objects)
                .camera(attitude.point(eye).to_array(), attitude.point(look_at).to_array(), 50.0)
                .bounces(0);
            let film = film(&compiled(&desc), 16, 1);
            (0..SIZE * SIZE).map(|k| film.radiance(k % SIZE, k / SIZE)).collect::<Vec<_>>()
        };
        let eye = DVec3::new(1.0, 1.5, 2.0);
        let below = DVec3::new(0.0, 0.0, -0.4);
        let alone = seen(vec![lamp.clone(), floor.clone()], eye, below);
        let with = seen(vec![ceiling.clone(), floor.clone(), lamp.clone()], eye, below);
        for (k, (a, b)) in alone.iter().zip(&with).enumerate() {
            assert!(
                (a[0] - b[0]).abs() <= tolerance * a[0] + 1e-9,
                "turned by {turn}, {wide} wide, pixel {k}: {b:?}, not {a:?}"
            );
        }
        assert!(alone.iter().filter(|c| c[0] > 0.0).count() > 900);
        let eye = DVec3::new(0.05, 1.4, 0.02);
        let whole = seen(vec![ceiling.clone(), floor.clone(), lamp.clone()], eye, DVec3::new(0.0, 2.0, 0.0));
        assert!(whole.iter().all(|c| (c[0] - 3.0).abs() < 1e-4), "the lamp is not whole");
    }
}

/// Glass that changes nothing, standing on a table, changes nothing: the table shows through it, whichever comes first.
#[test]
fn glass_on_a_table_shows_the_table() {
    for first in [false, true] {
        // With a channel of one no path is ended by chance, so that all samples of a pixel are the same.
        let albedo = [1.0, 0.5, 0.25];
        let table = rectangle(80.0, diffuse(albedo), vec![]);
        let cube = Object::Box(Box::new(RectBox {
            center: [0.1, 0.6, 0.0].into(),
            size: PerAxis([1.2; 3]).into(),
            rounding: 0.0.into(),
            material: of(glass(1.0)),
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        }));
        let objects = if first { vec![cube, table] } else { vec![table, cube] };
        let desc =
            scene(SIZE, vec![], objects).background([1.0; 3]).camera([1.5, 2.5, 3.0], [0.0; 3], 30.0).bounces(12);
        let film = film(&compiled(&desc), 16, 1);
        for k in 0..SIZE * SIZE {
            let seen = film.radiance(k % SIZE, k / SIZE);
            let same = (0..3).all(|c| (seen[c] - albedo[c]).abs() < 1e-4);
            assert!(same, "glass first: {first}, pixel {k}: {seen:?}");
        }
    }
}

/// A shape with flat sides in the plane y = 0, or with one of them there.
pub(crate) fn flat_sided(kind: &str, material: Material, transform: Vec<Transform>) -> Object {
    let (material, transform) = (of(material), transform.into_iter().map(Spanned::from).collect());
    let (placements, name) = (Placements::One, Name::default());
    match kind {
        "disk" => Object::Disk(Box::new(Disk {
            center: [0.0; 3].into(),
            normal: [0.0, 1.0, 0.0].into(),
            radius: 0.6.into(),
            inner_radius: 0.2.into(),
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
        _ => Object::Cylinder(Box::new(Cylinder {
            from: [0.0; 3].into(),
            to: [0.0, if kind == "below" { -0.7 } else { 0.7 }, 0.0].into(),
            radius: 0.6.into(),
            caps: true,
            material,
            transform,
            placements,
            camera_visible: true,
            name,
        })),
    }
}

/// A plane of a material, which steps put in its place.
type Support = fn(Material, Vec<Transform>) -> Object;

/// Glass that changes nothing and stands on a table by the cap of a cylinder, a rug on a floor and a lid flush with it
/// show no speckle: under a white sky all is of one albedo. Whatever holds them up, and in any attitude.
#[test]
fn flat_sides_of_curved_shapes_do_not_speckle() {
    let albedo = [1.0, 0.5, 0.25];
    let attitudes = [
        Attitude { axis: DVec3::X, degrees: 0.0, place: DVec3::ZERO },
        Attitude { axis: DVec3::new(0.48, 0.6, 0.64), degrees: 47.0, place: DVec3::new(1.3, -2.7, 3.1) },
    ];
    let supports: [(&str, Support); 3] = [
        ("rectangle", |material, steps| rectangle(80.0, material, steps)),
        ("disk", |material, steps| {
            let mut whole = flat_sided("disk", material, steps);
            if let Object::Disk(disk) = &mut whole {
                (disk.radius, disk.inner_radius) = (50.0.into(), 0.0.into());
            }
            whole
        }),
        ("cylinder", |material, steps| {
            let mut stage = flat_sided("below", material, steps);
            if let Object::Cylinder(cylinder) = &mut stage {
                cylinder.radius = 50.0.into();
            }
            stage
        }),
    ];
    for (attitude, (support, under)) in attitudes.iter().flat_map(|a| supports.iter().map(move |s| (a, s))) {
        for (kind, material) in
            [("disk", diffuse(albedo)), ("below", diffuse(albedo)), ("above", glass(1.0)), ("below", glass(1.0))]
        {
            for first in [false, true] {
                let floor = under(diffuse(albedo), attitude.steps(0.0, [0.0; 3]));
                let thing = flat_sided(kind, material.clone(), attitude.steps(25.0, [0.1, 0.0, 0.0]));
                let objects = if first { vec![thing, floor] } else { vec![floor, thing] };
                let mut desc = scene(SIZE, vec![], objects)
                    .background([1.0; 3])
                    .camera(attitude.point(DVec3::new(1.5, 2.5, 3.0)).to_array(), attitude.place.to_array(), 25.0)
                    .bounces(20);
                desc.camera.up = (attitude.point(DVec3::Y) - attitude.place).to_array().into();
                let film = film(&compiled(&desc), 16, 1);
                for k in 0..SIZE * SIZE {
                    let seen = film.radiance(k % SIZE, k / SIZE);
                    let same = (0..3).all(|c| (seen[c] - albedo[c]).abs() < 1e-4);
                    assert!(same, "{kind} on a {support}, first: {first}, {attitude:?}, pixel {k}: {seen:?}");
                }
            }
        }
    }
}

fn block(center: [f64; 3], size: [f64; 3], material: Material, transform: Vec<Transform>) -> Object {
    Object::Box(Box::new(RectBox {
        center: center.into(),
        size: PerAxis(size).into(),
        rounding: 0.0.into(),
        material: of(material),
        transform: transform.into_iter().map(Spanned::from).collect(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

/// In a white furnace glass is invisible, also where bodies touch: what leaves one enters the other, whichever comes
/// first, seen from above, from below and from the side. One face of two stands for both; were it only that of the one,
/// radiance would be off by the square of an index at each joint.
#[test]
fn glass_that_touches_glass_is_invisible_in_a_white_furnace() {
    let (flint, water) = (1.5, 1.33);
    let attitudes = [
        Attitude { axis: DVec3::X, degrees: 0.0, place: DVec3::ZERO },
        Attitude { axis: DVec3::new(0.48, 0.6, 0.64), degrees: 47.0, place: DVec3::new(1.3, -2.7, 3.1) },
    ];
    for attitude in &attitudes {
        let steps = |mirrored: bool| {
            let mut steps = attitude.steps(0.0, [0.0; 3]);
            let factor = [if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0];
            steps.insert(0, Transform::Scale { factor, about: Some(Box::new([0.0; 3])) });
            steps
        };
        let half =
            |y: f64, ior: f64, mirrored: bool| block([0.0, y, 0.0], [1.4, 0.5, 1.4], glass(ior), steps(mirrored));
        let round = |kind: &str, ior: f64| flat_sided(kind, glass(ior), attitude.steps(0.0, [0.1, 0.0, 0.1]));
        let core = |ior: f64, height: f64| block([0.1, -0.25, 0.05], [0.6, height, 0.6], glass(ior), steps(false));
        let stacks = [
            ("a hole from face to face", vec![half(-0.25, flint, false), core(1.0 / flint, 0.5)]),
            ("a hole written first", vec![core(1.0 / flint, 0.5), half(-0.25, flint, false)]),
            ("water flush in glass", vec![half(-0.25, flint, false), core(water / flint, 0.5)]),
            ("two blocks", vec![half(-0.25, flint, false), half(0.25, flint, false)]),
            ("two blocks, one mirrored", vec![half(0.25, flint, true), half(-0.25, water, false)]),
            ("three blocks", vec![half(-0.25, flint, false), half(0.25, water, false), half(0.75, flint, false)]),
            ("a cylinder on a block", vec![half(-0.25, flint, false), round("above", water)]),
            ("cylinders", vec![round("below", flint), round("above", water)]),
            // What is in one place is one body, however many there are and whatever it touches.
            ("two in one place", vec![half(-0.25, flint, false); 2]),
            ("two on water", [vec![half(-0.25, water, false)], vec![half(0.25, flint, false); 2]].concat()),
            ("nine on water", [vec![half(-0.25, water, false)], vec![half(0.25, flint, false); 9]].concat()),
            ("nine under water", [vec![half(-0.25, flint, false); 9], vec![half(0.25, water, false)]].concat()),
        ];
        for (name, objects) in stacks {
            for eye in [DVec3::new(0.1, 6.0, 0.05), DVec3::new(0.1, -6.0, 0.05), DVec3::new(5.0, 1.9, 2.0)] {
                let mut desc = scene(SIZE, vec![], objects.clone())
                    .background([1.0; 3])
                    .camera(attitude.point(eye).to_array(), attitude.place.to_array(), 8.0)
                    .bounces(200)
                    .filter(PixelFilter::None);
                desc.camera.up = (attitude.point(DVec3::Z) - attitude.place).to_array().into();
                let film = film(&compiled(&desc), 8, 1);
                // Rays that go round within corners for ever are seen by some pixels; others are one but for rounding.
                let white = (0..SIZE * SIZE).filter(|k| (film.radiance(k % SIZE, k / SIZE)[0] - 1.0).abs() < 1e-3);
                let white = white.count() as f64 / f64::from(SIZE * SIZE);
                let mean = (0..SIZE * SIZE).map(|k| film.radiance(k % SIZE, k / SIZE)[0]).sum::<f64>();
                let mean = mean / f64::from(SIZE * SIZE);
                if name.starts_with("PROBE") {
                    println!("{name} from {eye}: {mean}, {white}");
                    continue;
                }
                assert!(white > 0.97 && (mean - 1.0).abs() < 0.01, "{name} from {eye}: {mean}, {white} of the pixels");
            }
        }
    }
}

/// Planes through the middle of what is seen, whose coordinates are zero and so have no rounding: in squares of some
/// sizes the normal of one is a rounding off, and they must meet all the same.
#[test]
fn planes_through_the_origin_have_one_winner() {
    for size in [2.0, 3.4, 3.7, 4.9, 5.9, 7.0, 7.4, 9.8, 11.3, 20.0] {
        for shape in ["square", "disk"] {
            let floor = rectangle(size, diffuse(RED), vec![]);
            let tile = match shape {
                "square" => rectangle(1.5, diffuse(BLUE), vec![]),
                _ => flat_sided("disk", diffuse(BLUE), vec![]),
            };
            let desc = scene(SIZE, vec![], vec![floor, tile])
                .background([1.0; 3])
                .camera([0.01, 5.0, 0.0], [0.0; 3], 20.0)
                .bounces(2)
                .filter(PixelFilter::None);
            let desc = SceneDesc { camera: Camera { up: [0.0, 0.0, -1.0].into(), ..desc.camera }, ..desc };
            let film = film(&compiled(&desc), 1, 1);
            let (mut red, mut blue) = (0, 0);
            for k in 0..SIZE * SIZE {
                let seen = film.radiance(k % SIZE, k / SIZE);
                let is = |color: [f64; 3]| (0..3).all(|c| (seen[c] - color[c]).abs() < 1e-4);
                (red, blue) = (red + usize::from(is(RED)), blue + usize::from(is(BLUE)));
            }
            // Of squares the first wins; a disk comes before all of them.
            assert!(if shape == "square" { blue == 0 } else { blue > 300 }, "{shape} on {size}: {blue} pixels");
            assert_eq!(red + blue, (SIZE * SIZE) as usize, "{shape} on {size}");
        }
    }
}

/// Of bodies in one place one is seen, as it is by itself: what lets no light through, else the first. Under a white
/// sky a convex body has its albedo, sample by sample.
#[test]
fn bodies_in_one_place_have_one_winner() {
    let squeezed = || vec![Transform::Scale { factor: [1.0, 0.5, 2.0], about: None }, rotate([1.0, 2.0, 3.0], 40.0)];
    let ball = |material, steps: Vec<Transform>| {
        let mut ball = sphere([0.0; 3], 0.8, material);
        if let Object::Sphere(sphere) = &mut ball {
            sphere.transform = steps.into_iter().map(Spanned::from).collect();
        }
        ball
    };
    let shapes: [(&str, &dyn Fn(Material) -> Object); 4] = [
        ("sphere", &|material| ball(material, vec![])),
        ("turned sphere", &|material| ball(material, vec![rotate([0.0, 0.0, 1.0], 30.0)])),
        ("ellipsoid", &|material| ball(material, squeezed())),
        ("cylinder", &|material| flat_sided("cylinder", material, squeezed())),
    ];
    for (name, shape) in shapes {
        for objects in [
            vec![shape(diffuse(RED)), shape(diffuse(BLUE)), shape(diffuse(BLUE))],
            vec![shape(glass(1.5)), shape(diffuse(RED)), shape(diffuse(BLUE))],
        ] {
            let desc = scene(SIZE, vec![], objects)
                .background([1.0; 3])
                .camera([0.3, 2.0, 5.0], [0.0; 3], 30.0)
                .filter(PixelFilter::None);
            let scene = compiled(&desc);
            assert!(scene.warnings.iter().any(|warning| warning.code == codes::IN_ONE_PLACE), "{name}");
            let film = film(&scene, 1, 1);
            let is = |k: u32, color: [f64; 3]| {
                let seen = film.radiance(k % SIZE, k / SIZE);
                (0..3).all(|c| (seen[c] - color[c]).abs() < 1e-4)
            };
            let red = (0..SIZE * SIZE).filter(|&k| is(k, RED)).count();
            let white = (0..SIZE * SIZE).filter(|&k| is(k, [1.0; 3])).count();
            assert!(red > 100 && red + white == (SIZE * SIZE) as usize, "{name}: {red} red, {white} white");
        }
    }
}

/// A real gap of a ten-thousandth of the scene stays one: the upper of two sheets is seen from above, the lower from
/// below.
#[test]
fn a_thin_gap_stays() {
    for eye in [DVec3::new(0.5, 2.0, 1.0), DVec3::new(0.5, -2.0, 1.0)] {
        let sheet = rectangle(4.0, diffuse(RED), vec![]);
        let tile = rectangle(3.0, diffuse(BLUE), vec![Transform::Translate([0.0, 4e-4, 0.0])]);
        let desc: SceneDesc = scene(SIZE, vec![], vec![sheet, tile])
            .background([1.0; 3])
            .camera(eye.to_array(), [0.0; 3], 20.0)
            .bounces(2);
        let film = film(&compiled(&desc), 4, 1);
        let expected = if eye.y > 0.0 { BLUE } else { RED };
        for k in 0..SIZE * SIZE {
            let seen = film.radiance(k % SIZE, k / SIZE);
            assert!((0..3).all(|c| (seen[c] - expected[c]).abs() < 1e-4), "{eye}, pixel {k}: {seen:?}");
        }
    }
}
