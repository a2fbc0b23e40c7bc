//! The picture is the same, byte for byte, for every number of threads, lane type, acceleration and crop, and whether
//! rendered in one go or not: on scenes that reach every material, shape, light and effect.

use crate::support::compiled;
use crate::support::describe::*;
use crate::support::meshes::{cube, deep_picture, icosphere, picture, square, torus};
use scene_format::desc::{
    Acceleration, Caustics, Instances, Integrator, MaterialRef, Object, Part, PixelFilter, Reuse, Shading, Stereo,
    StereoLayout, TextureFilter, TextureWrap, Transform,
};
use scene_format::{SceneDesc, Syntax, load_str};
use std::ops::ControlFlow;
use std::path::Path;
use tracer_core::Level;
use tracer_core::{Crop, Film, Look, Observer, Progress, RenderOptions, Scene, Unobserved, develop};

/// Every material, shape and way of shading, both kinds of texture and every wrap, copies, lights inside and outside,
/// lens, background.
pub(crate) fn everything() -> SceneDesc {
    use TextureFilter::{Bilinear, Nearest};
    let wall = |wrap, filter| glossy(picture_albedo(wrap, filter), 50.0, 0.3, true);
    let at = |x: f64, y: f64, z: f64, size: f64| vec![scale(size), Transform::Translate([x, y, z])];
    let objects = vec![
        sphere([0.0, -1000.0, 0.0], 1000.0, textured(&picture(), Bilinear, TextureWrap::Repeat)),
        sphere([-3.0, 1.0, 0.0], 1.0, glass(1.5)),
        sphere([-1.2, 0.6, 2.0], 0.6, mirror([0.9, 0.8, 0.7])),
        sphere([0.4, 0.5, 2.2], 0.5, textured(&deep_picture(), Nearest, TextureWrap::Mirror)),
        sphere([1.6, 0.5, 2.0], 0.5, blinn_phong([0.2, 0.4, 0.9], 300.0, 0.2)),
        mesh(
            &torus(0.4, 12, 8).obj("torus-12-8"),
            wall(TextureWrap::Clamp, Bilinear),
            Shading::Auto,
            at(3.0, 0.5, 0.0, 0.9),
        ),
        mesh(&icosphere(1).off("icosphere-1"), glass(1.3), Shading::Smooth, at(1.0, 1.0, 0.0, 0.8)),
        mesh(&icosphere(2).obj("icosphere-2"), mirror([0.8; 3]), Shading::Smooth, at(-1.2, 2.6, -1.0, 0.7)),
        mesh(
            &square(3.0).obj("square-3"),
            wall(TextureWrap::Repeat, Nearest),
            Shading::Flat,
            vec![rotate([1.0, 0.0, 0.0], 90.0), scale(4.0), Transform::Translate([0.0, 2.0, -4.0])],
        ),
        placed(
            &cube().off("cube"),
            diffuse([0.7, 0.5, 0.3]),
            Shading::Auto,
            vec![scale(0.25)],
            (0..9)
                .map(|k| {
                    let angle = 40.0 * f64::from(k);
                    vec![
                        Transform::Translate([0.0, 0.3, 5.0]).into(),
                        Transform::Rotate { axis: [0.1, 1.0, 0.0], degrees: angle, about: Some(Box::new([0.0; 3])) }
                            .into(),
                    ]
                })
                .collect(),
        ),
    ];
    let lights = vec![
        light([4.0, 7.0, 5.0], 1.0, [12.0, 11.0, 9.0]),
        light([-3.0, 1.0, 0.0], 0.3, [6.0, 2.0, 1.0]),
        light([0.0; 3], 60.0, [0.2, 0.25, 0.3]),
    ];
    scene(37, lights, objects)
        .camera([0.5, 3.0, 9.0], [0.0, 1.0, 0.0], 45.0)
        .background([0.1, 0.2, 0.3])
        .bounces(7)
        .filter(PixelFilter::Gaussian { sigma: 0.5.into() })
        .lens(0.2, 9.0)
}

fn picture_albedo(wrap: TextureWrap, filter: TextureFilter) -> scene_format::desc::Albedo {
    crate::support::describe::picture(&picture(), filter, wrap)
}

/// So many balls that they hang in the tree, in the dark but for one light; no lens, other filter.
pub(crate) fn many_balls() -> SceneDesc {
    let mut random = tracer_reference::Random::new(9);
    let mut objects: Vec<Object> = (0..200)
        .map(|k| {
            let place = [0; 3].map(|_| random.between(-3.0, 3.0));
            let material = match k % 4 {
                0 => diffuse([0.8, 0.3, 0.2]),
                1 => glass(1.7),
                2 => mirror([0.9; 3]),
                _ => conserving([0.5, 0.9, 0.6], 1e4, 0.7),
            };
            sphere(place, random.between(0.05, 0.5), material)
        })
        .collect();
    objects.push(sphere([0.0, -1003.0, 0.0], 1000.0, diffuse([0.5; 3])));
    scene(29, vec![light([3.0, 8.0, 3.0], 1.5, [20.0; 3])], objects)
        .camera([0.0, 1.0, 9.0], [0.0; 3], 45.0)
        .bounces(5)
        .filter(PixelFilter::BlackmanHarris { radius: 1.5.into() })
}

/// Planes without an end: a floor with a rug, a lamp and a box of glass in it or on it, a mirror, and things that reach
/// through; solids, matt and of glass, copied and mirrored, and a curved lamp.
fn planes() -> SceneDesc {
    let text = r#"Scene(
        image: Image(width: 37, height: 37), background: (0.2, 0.25, 0.3), render: Render(max_bounces: 6),
        camera: Camera(position: (0.5, 1.4, 6), look_at: (0, 0.6, 0), fov: 50),
        lights: [SphereLight(center: (-2, 4, 3), radius: 0.6, radiance: 25)],
        materials: { "lamp": Emissive(radiance: 6), "gloss": BlinnPhong(albedo: 0.4, exponent: 200, specular: 0.2) },
        objects: [
            Plane(material: Diffuse(albedo: Checkerboard(a: 0.7, b: 0.2))),
            Plane(point: (-3, 0, 0), normal: (1, 0, 0.5), material: Mirror(reflectance: 0.9)),
            Plane(point: (0, 0, -2.5), normal: (0, 0.2, 1), material: "gloss"),
            Rectangle(center: (0.6, 0, 1), size: (1.5, 1), material: Diffuse(albedo: (0.7, 0.1, 0.1))),
            Rectangle(center: (1.8, 0, 0), size: 0.6, material: "lamp"),
            Box(center: (0.4, 0.35, 1), size: 0.7, material: Transparent(ior: 1.5)),
            Sphere(center: (-0.9, 0.2, 0.3), radius: 0.6, material: Diffuse(albedo: 0.8)),
            Cylinder(from: (-0.4, 0, 2), to: (-0.4, 0.5, 2), radius: 0.3),
            Difference(
                objects: [
                    Box(center: (-1.9, 0.4, 1.6), size: 0.8, material: Diffuse(albedo: Checkerboard(
                        a: 0.1, b: 0.8, mapping: Object(scale: 5),
                    ))),
                    Sphere(center: (-1.6, 0.7, 1.9), radius: 0.4, material: Mirror(reflectance: 0.8)),
                    Cylinder(from: (-3, 0.4, 1.6), to: (0, 0.4, 1.6), radius: 0.15, material: "gloss"),
                ],
                placements: [[], [Scale((-0.8, 1, 1)), Translate((0.6, 0, 1.2))]],
            ),
            Intersection(material: Transparent(ior: 1.5), objects: [
                Sphere(center: (1.5, 0.6, 2), radius: 0.6),
                Union(objects: [
                    Box(center: (1.2, 0.6, 2), size: (0.6, 0.7, 0.8)),
                    Box(center: (1.7, 0.5, 2), size: (0.4, 0.9, 0.5)),
                ]),
            ]),
            Disk(center: (0, 3, 1), radius: 0.4, normal: (0, -1, 0), material: "lamp"),
        ])"#;
    match scene_format::load_str("planes", text, scene_format::Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => loaded.scene,
        Err(error) => panic!("{error:?}"),
    }
}

/// Two eyes, of which a column of pixels has no one's middle.
fn stereo() -> SceneDesc {
    let mut desc = many_balls();
    let layout = StereoLayout::SideBySide;
    desc.camera.stereo = Some(Stereo { separation: 0.3.into(), convergence: Some(8.0.into()), layout });
    desc
}

fn scenes() -> [(&'static str, SceneDesc); 6] {
    let [hidden, stereo] = [("hidden", crate::hidden::hidden()), ("stereo", stereo())];
    let lamps = ("lamps with textures", crate::glow::lamps());
    [("everything", everything()), ("many balls", many_balls()), ("planes", planes()), hidden, stereo, lamps]
}

const SAMPLES: u32 = 21;

/// Sharing even under a background, where by itself the engine does not.
pub(crate) fn options() -> RenderOptions {
    RenderOptions { samples: Some(SAMPLES), seed: Some(77), threads: 1, reuse: Some(true), ..RenderOptions::default() }
}

/// All that a film says of its pixels, as bits.
pub(crate) fn bits(film: &Film) -> Vec<[u64; 7]> {
    let Crop { x, y, width, height } = film.crop();
    let pixels = (y..y + height).flat_map(|py| (x..x + width).map(move |px| (px, py)));
    pixels
        .map(|(px, py)| {
            let [r, g, b] = film.radiance(px, py).map(f64::to_bits);
            let taken = film.taken(px, py).map(f64::to_bits);
            [r, g, b, film.variance(px, py).to_bits(), taken[0], taken[1], taken[2]]
        })
        .collect()
}

fn rendered(scene: &Scene, options: &RenderOptions) -> Vec<[u64; 7]> {
    let film = tracer_core::render(scene, options, &Unobserved);
    assert_eq!(film.counters.dropped, 0);
    bits(&film)
}

/// The same mesh by way of every format.
#[test]
fn formats_of_meshes() {
    let ball = icosphere(2).in_order_of_use();
    let ring = torus(0.4, 12, 8).in_order_of_use();
    let picture_of = |ball: &Path, ring: &Path, shading: Shading| {
        let light = light([4.0, 7.0, 5.0], 1.0, [12.0, 11.0, 9.0]);
        let wall = glossy(picture_albedo(TextureWrap::Repeat, TextureFilter::Bilinear), 50.0, 0.3, true);
        let turned = vec![rotate([1.0, 2.0, 3.0], 40.0), Transform::Translate([1.0, 0.5, 0.0])];
        let painted = if shading == Shading::Flat { mirror([0.9, 0.8, 0.7]) } else { wall };
        let objects = vec![mesh(ball, glass(1.5), shading, vec![scale(0.9)]), mesh(ring, painted, shading, turned)];
        let desc = scene(24, vec![light], objects).camera([0.5, 3.0, 6.0], [0.0; 3], 45.0);
        rendered(&compiled(&desc), &RenderOptions { samples: Some(4), ..options() })
    };
    for shading in [Shading::Auto, Shading::Smooth, Shading::Flat] {
        let obj = picture_of(&ball.obj("ordered-ball"), &ring.obj("ordered-ring"), shading);
        assert!(obj.iter().any(|p| p[0] != obj[0][0]), "nothing to see");
        assert!(obj == picture_of(&ball.ply("ordered-ball"), &ring.ply("ordered-ring"), shading), "PLY {shading:?}");
        if shading == Shading::Flat {
            assert!(obj == picture_of(&ball.off("ordered-ball"), &ring.off("ordered-ring"), shading), "OFF");
            // Of the ring STL would join the seam.
            assert!(obj == picture_of(&ball.stl("ordered-ball"), &ring.off("ordered-ring"), shading), "STL");
        }
    }
    let (ball, ring) = (ball.in_single_precision(), ring.in_single_precision());
    for shading in [Shading::Auto, Shading::Smooth, Shading::Flat] {
        let obj = picture_of(&ball.obj("single-ball"), &ring.obj("single-ring"), shading);
        assert!(obj == picture_of(&ball.glb("single-ball"), &ring.glb("single-ring"), shading), "GLB {shading:?}");
    }
}

/// A part of a mesh's file is a file that holds nothing else: its materials, texture coordinates and normals, the
/// vertices that turns and scales go about, its bounds, and all that is made of these.
#[test]
fn parts_of_meshes() {
    let alone = ["ball", "ring"].map(|name| {
        let shape = if name == "ball" { icosphere(2) } else { torus(0.4, 12, 8) };
        std::fs::read_to_string(shape.obj(&format!("alone-{name}"))).expect("it was written")
    });
    let count = |word: &str| alone[0].lines().filter(|line| line.split(' ').next() == Some(word)).count();
    let before = ["v", "vt", "vn"].map(count);
    // The ring behind the ball: its corners count from the first vertex of the file.
    let behind: String = alone[1].lines().fold(String::new(), |all, line| {
        let shifted = |corner: &str| {
            let shift = |(index, before): (&str, usize)| {
                index.parse::<usize>().map_or(String::new(), |k| (k + before).to_string())
            };
            corner.split('/').zip(before).map(shift).collect::<Vec<_>>().join("/")
        };
        let words =
            line.strip_prefix("f ").map(|corners| corners.split(' ').map(shifted).collect::<Vec<_>>().join(" "));
        all + &words.map_or(line.to_owned(), |words| format!("f {words}")) + "\n"
    });
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        path
    };
    write("m.mtl", "newmtl red\nKd 0.8 0.1 0.1\nnewmtl glow\nKd 0 0 0\nKe 3 2 1\nnewmtl blue\nKd 0.1 0.2 0.9\n");
    let [ball, ring] = [format!("usemtl red\n{}", alone[0]), format!("usemtl glow\n{behind}")];
    let both = format!("mtllib m.mtl\no ball\n{ball}g ring far\no far\n{ring}o\ng\nusemtl blue\nf 1 2 3\n");
    let both = write("both.obj", &both);
    let files = [
        write("ball.obj", &format!("mtllib m.mtl\n{ball}")),
        write("ring.obj", &format!("mtllib m.mtl\nusemtl glow\n{}", alone[1])),
    ];
    let picture_of = |of_parts: bool, shading: Shading, instances: Instances| {
        let steps = || vec![scale(0.9), rotate([1.0, 2.0, 3.0], 40.0), Transform::DropTo { y: 0.0 }];
        let place = |k: usize, name: &str| {
            let steps =
                steps().into_iter().chain([Transform::Translate([k as f64 - 0.5, 0.0, -0.5 * k as f64])]).collect();
            let mut object = mesh(if of_parts { &both } else { &files[k] }, mirror([0.9; 3]), shading, steps);
            let Object::Mesh(mesh) = &mut object else { panic!("a mesh") };
            mesh.part = Part::from(of_parts.then_some(name));
            mesh.material = MaterialRef::Default;
            mesh.instances = instances;
            object
        };
        let light = light([4.0, 7.0, 5.0], 1.0, [12.0, 11.0, 9.0]);
        let desc =
            scene(24, vec![light], vec![place(0, "ball"), place(1, "ring")]).camera([0.5, 3.0, 6.0], [0.0; 3], 45.0);
        rendered(&compiled(&desc), &RenderOptions { samples: Some(4), ..options() })
    };
    for shading in [Shading::Auto, Shading::Smooth, Shading::Flat] {
        for instances in [Instances::Always, Instances::Never] {
            let file = picture_of(false, shading, instances);
            assert!(file.iter().any(|p| p[0] != file[0][0]), "nothing to see");
            assert!(file == picture_of(true, shading, instances), "{shading:?} {instances:?}");
        }
    }
}

/// What is kept of a file is kept for each part of it.
#[test]
fn parts_of_meshes_are_kept_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("t.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no one\nf 1 2 3\no two\nf 1 2 4\nf 1 3 4\n";
    std::fs::write(&file, text).expect("a file");
    let kept = tracer_core::Kept::default();
    let triangles = |part: Option<&str>| {
        let mut object = mesh(&file, mirror([0.9; 3]), Shading::Flat, Vec::new());
        let Object::Mesh(mesh) = &mut object else { panic!("a mesh") };
        mesh.part = Part::from(part);
        let desc = scene(8, vec![light([4.0, 7.0, 5.0], 1.0, [12.0, 11.0, 9.0])], vec![object]);
        tracer_core::compile_keeping(&desc, &kept).expect("a scene").statistics().triangles
    };
    assert_eq!([Some("one"), Some("two"), None, Some("one")].map(triangles), [1, 2, 3, 1]);
}

/// A mesh that the scene writes out is that of a file with the same points and faces, copies and all.
#[test]
fn meshes_written_out() {
    let (ball, cube) = (icosphere(1), cube());
    let picture_of = |written: bool, shading: Shading, instances: Instances| {
        let steps = vec![rotate([1.0, 2.0, 3.0], 40.0), Transform::Translate([1.0, 0.5, 0.0])];
        let mut objects = [
            mesh(&ball.off("written-ball"), glass(1.5), shading, vec![scale(0.9)]),
            mesh(&cube.off("written-cube"), mirror([0.9; 3]), shading, steps),
        ];
        for (object, shape) in objects.iter_mut().zip([&ball, &cube]) {
            let Object::Mesh(mesh) = object else { panic!("a mesh") };
            if written {
                mesh.source = shape.written_out();
            }
            let copies = [[0.0; 3], [-1.0, 0.4, -1.0]].map(|to| vec![Transform::Translate(to).into()]);
            mesh.placements = copies.into_iter().collect();
            mesh.instances = instances;
        }
        let light = light([4.0, 7.0, 5.0], 1.0, [12.0, 11.0, 9.0]);
        let desc = scene(24, vec![light], objects.into()).camera([0.5, 3.0, 6.0], [0.0; 3], 45.0);
        rendered(&compiled(&desc), &RenderOptions { samples: Some(16), ..options() })
    };
    for shading in [Shading::Auto, Shading::Smooth] {
        for instances in [Instances::Always, Instances::Never] {
            let file = picture_of(false, shading, instances);
            assert!(file.iter().any(|p| p[0] != file[0][0]), "nothing to see");
            assert!(file == picture_of(true, shading, instances), "{shading:?} {instances:?}");
        }
    }
}

#[test]
fn threads_and_lanes() {
    threads_and_lanes_of(|level| if level == Level::best() { &[1, 2, 3, 7] } else { &[2] });
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn all_threads_with_all_lanes() {
    threads_and_lanes_of(|_| &[1, 2, 3, 7]);
}

fn threads_and_lanes_of(threads_at: fn(Level) -> &'static [usize]) {
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        let expected = rendered(&scene, &options());
        assert!(expected.iter().any(|p| p[0] != expected[0][0]), "{name} is empty");
        for level in Level::available() {
            // Without hardware fma a sample costs a hundred times more.
            let crop = (level == Level::PORTABLE).then_some(Crop { x: 8, y: 8, width: 16, height: 8 });
            for &threads in if crop.is_some() { &[2] } else { threads_at(level) } {
                let options = RenderOptions { threads, level: Some(level), crop, ..options() };
                let film = tracer_core::render(&scene, &options, &Unobserved);
                let part = crop.unwrap_or(Crop::whole(scene.size));
                let same = bits(&film) == cut(&expected, scene.size, part);
                assert!(same, "{name}: {threads} threads, {}", level.name());
            }
        }
    }
}

/// The part of a picture.
pub(crate) fn cut<T: Copy>(picture: &[T], size: [u32; 2], crop: Crop) -> Vec<T> {
    let rows = crop.y..crop.y + crop.height;
    rows.flat_map(|y| (crop.x..crop.x + crop.width).map(move |x| picture[(y * size[0] + x) as usize])).collect()
}

#[test]
fn crops() {
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        let expected = rendered(&scene, &options());
        for crop in [
            Crop { x: 0, y: 0, width: 1, height: 1 },
            Crop { x: 7, y: 9, width: 2, height: 15 },
            Crop { x: 16, y: 8, width: 8, height: 8 },
            Crop { x: 3, y: 5, width: 21, height: 11 },
            Crop { x: 28, y: 28, width: 1, height: 1 },
        ] {
            for (threads, level) in [(3, Level::best()), (2, Level::from_lanes(1).expect("one lane"))] {
                let options = RenderOptions { crop: Some(crop), threads, level: Some(level), ..options() };
                assert!(rendered(&scene, &options) == cut(&expected, scene.size, crop), "{name}: {crop:?}");
            }
        }
    }
}

#[test]
fn accelerations() {
    accelerations_at(&[Level::best()]);
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn accelerations_with_all_lanes() {
    let fast = Level::available().into_iter().filter(|&level| level != Level::PORTABLE);
    accelerations_at(&fast.collect::<Vec<_>>());
}

fn accelerations_at(levels: &[Level]) {
    for (name, mut desc) in scenes() {
        let expected = rendered(&compiled(&desc), &options());
        for acceleration in [Acceleration::BoundingBox, Acceleration::None] {
            desc.render.acceleration = acceleration;
            let scene = compiled(&desc);
            for &level in levels {
                let options = RenderOptions { level: Some(level), threads: 2, ..options() };
                assert!(rendered(&scene, &options) == expected, "{name}: {acceleration:?}, {}", level.name());
            }
        }
    }
}

/// `integrator: Path` is the picture without sharing and photons, `Full` that with what the scene says of them.
#[test]
fn integrators() {
    let render = |integrator, reuse, caustics| {
        let mut desc = many_balls();
        (desc.render.integrator, desc.render.reuse, desc.render.caustics) = (integrator, reuse, caustics);
        rendered(&compiled(&desc), &RenderOptions { reuse: None, ..options() })
    };
    let plain = render(Integrator::Full, Reuse::None, Caustics::None);
    for (reuse, caustics) in [(Reuse::Blocks, Caustics::None), (Reuse::None, Caustics::Photons)] {
        assert!(
            render(Integrator::Full, reuse, caustics) != plain,
            "{reuse:?}, {caustics:?}: nothing shared, no photons"
        );
        assert!(render(Integrator::Path, reuse, caustics) == plain, "{reuse:?}, {caustics:?}");
    }
}

/// Compiling again, and on more threads, gives the same scene; developing the same film the same picture.
#[test]
fn compiling_and_developing_again() {
    for (name, desc) in scenes() {
        let film = |_| tracer_core::render(&compiled(&desc), &options(), &Unobserved);
        let [a, b] = [0, 1].map(film);
        assert!(bits(&a) == bits(&b), "{name}");
        let picture = develop(&a, &Look::default());
        assert!(picture == develop(&b, &Look::default()) && picture.display.iter().all(|x| (0.0..=1.0).contains(x)));
    }
}

/// Ends after some batches.
struct Impatient;

impl Observer for Impatient {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        if progress.samples_done * 2 > progress.samples_total {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
    fn pass(&self, film: &Film) {
        // Every pixel holds the same samples, and as many as the passes so far.
        assert_eq!(film.samples().start(), film.samples().end());
    }
}

/// After N of more samples the film is that of N samples: a look at it in between is the picture asked for.
#[test]
fn an_early_end_is_the_picture_of_fewer_samples() {
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        let film = tracer_core::render(&scene, &RenderOptions { samples: Some(64), ..options() }, &Impatient);
        let (fewest, most) = film.samples().into_inner();
        assert!(fewest >= 1 && most < 64, "{name}: {fewest} to {most} samples");
        struct Looks(std::sync::Mutex<Vec<(u32, Vec<[u64; 7]>)>>);
        impl Observer for Looks {
            fn progress(&self, _: Progress) -> ControlFlow<()> {
                ControlFlow::Continue(())
            }
            fn pass(&self, film: &Film) {
                self.0.lock().expect("a list").push((*film.samples().end(), bits(film)));
            }
        }
        let looks = Looks(Default::default());
        tracer_core::render(&scene, &RenderOptions { samples: Some(16), threads: 2, ..options() }, &looks);
        for (samples, seen) in looks.0.into_inner().expect("a list") {
            let options = RenderOptions { samples: Some(samples), ..options() };
            assert!(rendered(&scene, &options) == seen, "{name}: {samples} samples");
        }
    }
}

/// Shapes of a `Repeat` that are alike are one mesh, as copies by `placements` are, whatever their materials; what
/// differs is not.
#[test]
fn shapes_that_are_alike_are_one_mesh() {
    let scene = |objects: &str| {
        let text = format!(
            "Scene(image: Image(width: 16, height: 16), camera: Camera(position: (0, 6, 14), look_at: (0, 0, 0)), \
             lights: [SphereLight(center: (4, 8, 6), radius: 1, power: 800)], objects: [{objects}])"
        );
        let read = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]);
        compiled(&read.unwrap_or_else(|error| panic!("{error}\n{text}")).scene)
    };
    // So many triangles are not flattened: 300,000 in all.
    let vase = "Lathe(profile: [(0, 0), (1, 0), (0.9, 0.3), (0.4, 0.5), (0.3, 1.5), (0.6, 2), (0, 2.6)], \
                segments: 2048";
    let placed = |k: usize| format!("[Translate(({}, 0, {}))]", 2 * (k % 4), k / 4);
    let places: Vec<String> = (0..16).map(placed).collect();
    let copies = scene(&format!("{vase}, placements: [{}])", places.join(", ")));
    let repeated = scene(&format!(
        "Repeat(count: 16, items: [{vase}, transform: [Translate((\"=2 * (i % 4)\", 0, \"=floor(i / 4)\"))])])"
    ));
    let counts =
        |scene: &Scene| (scene.statistics().meshes, scene.statistics().instances, scene.statistics().triangles);
    assert_eq!(counts(&repeated), counts(&copies));
    assert_eq!(counts(&repeated), (1, 16, 13 * 4096));
    let picture = |scene: &Scene| bits(&tracer_core::render(scene, &options(), &Unobserved));
    assert_eq!(picture(&repeated), picture(&copies));
    let other = vase.replace("0.6, 2", "\"=0.6 + i / 100\", 2");
    let meshes = scene(&format!("Repeat(count: 6, items: [{other}), {vase})])")).statistics().meshes;
    // The first of the others is the vase itself, of which there are seven; the five others are by themselves.
    assert_eq!(meshes, 6);
}
