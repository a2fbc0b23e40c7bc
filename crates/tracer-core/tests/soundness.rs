//! The whole way at its smallest, for Miri: everything that holds unsafe code is reached, in seconds natively and
//! minutes under Miri.
//!
//! CONTRIBUTING.md names the commands. Without vector features Miri runs the portable level; with
//! `RUSTFLAGS=-Ctarget-feature=+avx2,+fma,+bmi1,+bmi2,+lzcnt,+popcnt` the AVX2 kernels, too. What it looks for are
//! accesses out of bounds, uninitialised memory, misaligned or dangling pointers and data races; what the picture shows
//! is proven elsewhere.

use scene_format::{Syntax, load_str};
use std::path::Path;
use tracer_core::{Film, Level, Look, RenderOptions, Scene, Unobserved, compile, develop, render};

/// Files of a scene: a smooth mesh with texture coordinates and a picture of 2 x 2 texels.
fn furnished() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("written");
    write(
        "pyramid.obj",
        b"v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.5 0\nvn 0 1 0\nvn 1 1 0\nvt 0 0\nvt 2 0\nvt 1 2\n\
          f 1/1/1 5/3/2 2/2/1\nf 2/1/1 5/3/2 3/2/1\nf 3/1/2 5/3/1 4/2/2\nf 4/1/1 5/3/1 1/2/1\n\
          f 1/1/1 2/2/1 3/3/1 4/1/1\n",
    );
    let mut picture = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_raw(2, 2, vec![250, 10, 10, 10, 250, 10, 10, 10, 250, 200, 200, 200])
        .expect("4 texels")
        .write_to(&mut picture, image::ImageFormat::Png)
        .expect("a picture in memory");
    write("tile.png", picture.get_ref());
    folder
}

/// Every material and shape, a copied mesh, a textured one, a lens, a light within the picture; 8 x 8 pixels.
const SCENE: &str = r#"Scene(
    version: 1,
    camera: Camera(position: (0, 2, 7), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 8, height: 8),
    render: Render(samples: 1, max_bounces: 3),
    effects: Effects(depth_of_field: ThinLens(aperture: 0.2, focus_distance: 7)),
    background: (0.1, 0.2, 0.3),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 9),
        SphereLight(center: (-1, 2, 0), radius: 0.2, radiance: 20)],
    objects: [
        Sphere(center: (0, -1000, 0), radius: 1000, material: Diffuse(albedo: 0.6)),
        Sphere(center: (-1.5, 0.8, 1), radius: 0.8, material: Transparent(ior: 1.5)),
        Sphere(center: (1.7, 0.7, 0.5), radius: 0.7, material: BlinnPhong(albedo: 0.5, exponent: 50, specular: 0.2)),
        Mesh(file: "pyramid.obj", material: Diffuse(albedo: Texture(file: "tile.png")), transform: [Scale(0.9)]),
        Mesh(file: "pyramid.obj", material: Mirror(reflectance: 0.8), shading: Smooth, placements: [
            [Translate((-1.5, 0.2, -2))], [Scale(factor: (-0.5, 0.7, 0.5)), Translate((1.5, 0.5, -1.5))],
        ]),
    ],
)"#;

fn scene(folder: &Path) -> Scene {
    let loaded = load_str("soundness.ron", SCENE, Syntax::Ron, folder, &[]).expect("a scene that is right");
    compile(&loaded.scene).expect("a scene that compiles")
}

fn film(scene: &Scene, threads: usize, level: Level) -> Film {
    render(scene, &RenderOptions { threads, level: Some(level), ..RenderOptions::default() }, &Unobserved)
}

#[test]
fn from_text_to_a_picture_at_every_level() {
    let folder = furnished();
    let scene = scene(folder.path());
    let look = |film: &Film| develop(film, &Look::default()).display;
    let expected = look(&film(&scene, 1, Level::PORTABLE));
    assert_eq!(expected.len(), 8 * 8 * 3);
    assert!(expected.iter().all(|x| (0.0..=1.0).contains(x)) && expected.iter().any(|x| *x != expected[0]));
    for level in Level::available().into_iter().filter(|level| *level != Level::PORTABLE) {
        let film = film(&scene, 1, level);
        assert_eq!(film.counters.dropped, 0);
        assert!(look(&film) == expected, "{}", level.name());
    }
    // Two threads share the film.
    assert!(look(&film(&scene, 2, Level::PORTABLE)) == expected);
}
