//! `render.integrator: Direct` and `AmbientOcclusion`: against what they are by definition.

use crate::analytic::{assert_exact, assert_mean, irradiance};
use crate::same_bytes::{bits, everything, many_balls};
use crate::support::compiled;
use crate::support::describe::*;
use crate::support::meshes::square;
use scene_format::SceneDesc;
use scene_format::desc::{Integrator, Material, MaterialRef, Object, Shading};
use std::f64::consts::PI;
use tracer_core::{Crop, Level, RenderOptions, Unobserved, VertexTold, inspect, render};

fn with(desc: &SceneDesc, integrator: Integrator, bounces: u32) -> SceneDesc {
    let mut desc = desc.clone().bounces(bounces);
    desc.render.integrator = integrator;
    desc
}

fn occlusion(distance: Option<f64>) -> Integrator {
    Integrator::AmbientOcclusion { distance: distance.map(Into::into) }
}

fn options(samples: u32) -> RenderOptions {
    RenderOptions { samples: Some(samples), threads: 1, ..RenderOptions::default() }
}

/// Nothing but rough surfaces.
fn rough(mut desc: SceneDesc) -> SceneDesc {
    for object in &mut desc.objects {
        let material = match &mut object.value {
            Object::Sphere(sphere) => &mut sphere.material,
            Object::Mesh(mesh) => &mut mesh.material,
            _ => continue,
        };
        let MaterialRef::Inline(inline) = material else { continue };
        if matches!(inline.value, Material::Mirror(_) | Material::Transparent(_)) {
            **inline = blinn_phong([0.6, 0.5, 0.4], 40.0, 0.5).into();
        }
    }
    desc
}

/// Without mirrors and glass direct light is what paths bring that are scattered once, byte for byte.
#[test]
fn direct_light_is_that_of_no_bounces() {
    for (name, desc) in [("everything", rough(everything())), ("many balls", rough(many_balls()))] {
        let film = |integrator, bounces| render(&compiled(&with(&desc, integrator, bounces)), &options(4), &Unobserved);
        let direct = film(Integrator::Direct, 5);
        assert!(bits(&direct) == bits(&film(Integrator::Path, 0)), "{name}");
        assert!(bits(&direct) != bits(&film(Integrator::Path, 5)), "{name}: other light there is none");
    }
}

/// Scatterings before a vertex from the first rough one on: of direct light none, or that one alone.
fn from_rough_on(vertices: &[VertexTold], vertex: &VertexTold) -> u32 {
    let Some(from) = vertex.from.map(|from| &vertices[from]) else { return 0 };
    let lobe = from.scattering.as_ref().map_or("", |scattering| scattering.lobe);
    let before = from_rough_on(vertices, from);
    before + u32::from(before > 0 || ["diffuse", "glossy"].contains(&lobe))
}

#[test]
fn direct_light_is_what_one_rough_surface_sends() {
    let (mut direct_ones, mut left_out) = (0, 0);
    let scenes = [Integrator::Path, Integrator::Direct].map(|of| compiled(&with(&everything(), of, 7)));
    for k in 0..150u32 {
        let pixel = [(7 * k) % 37, (5 * k + k / 37) % 37];
        let [path, direct] = scenes.each_ref().map(|scene| {
            let told = inspect(scene, &options(1), pixel, k % 5).expect("the picture has it").path;
            assert!(told.agrees);
            let vertices = told.vertices;
            let mut all = Vec::new();
            for vertex in &vertices {
                let before = from_rough_on(&vertices, vertex);
                let met = vertex.met.as_ref().map(|met| (before, met.brings));
                let sampled = vertex.sampled.as_ref().map(|sampled| (before + 1, sampled.brings()));
                all.extend(met.into_iter().chain(sampled).filter(|(_, brings)| *brings != [0.0; 3]));
            }
            all
        });
        let (of_path, rest): (Vec<_>, Vec<_>) = path.into_iter().partition(|(rough, _)| *rough <= 1);
        assert_eq!(direct, of_path, "{pixel:?}");
        direct_ones += direct.len();
        left_out += rest.len();
    }
    assert!(direct_ones > 100 && left_out > 40, "{direct_ones} {left_out}");
}

/// A floor under a ball of half angle sigma, theta from the normal: what the ball hides of the sky, weighted by the
/// cosine, is the irradiance that it would bring if it shone.
#[test]
fn a_ball_hides_what_it_would_light() {
    for (sigma, theta) in [(0.1, 0.9), (0.5, 0.2), (0.3, 1.3), (0.3, 1.45), (1.0, 1.2)] {
        let distance = 8.0;
        let center = [distance * f64::sin(theta), distance * f64::cos(theta), 0.0];
        let radius = distance * f64::sin(sigma);
        let floor = mesh(&square(1.0).obj("square-1"), mirror([0.3; 3]), Shading::Auto, vec![]);
        let desc = scene(8, vec![], vec![floor, sphere(center, radius, glass(1.5))])
            .camera([-0.3, 0.4, 0.0], [0.0, 0.0, 0.0], 0.01)
            .background([3.0; 3]);
        let expected = 1.0 - irradiance(sigma, theta) / PI;
        let name = format!("occlusion by a ball, sigma {sigma}, theta {theta}");
        assert_mean(&name, &with(&desc, occlusion(None), 5), 64, expected);
        // What is further off than the nearest point of the ball does not count, nor what is as far as its other side.
        let near = with(&desc, occlusion(Some(0.99 * (distance - radius))), 5);
        assert_exact("a ball too far off", &near, [1.0; 3]);
        assert_mean(&name, &with(&desc, occlusion(Some(distance + radius)), 5), 64, expected);
    }
}

/// In a corner of two large walls half of the sky is free at the edge; of nothing nothing is.
#[test]
fn the_sky_over_a_floor_is_free_and_nothing_is_black() {
    let floor = mesh(&square(1.0).obj("square-1"), diffuse([0.1; 3]), Shading::Auto, vec![scale(9.0)]);
    let desc =
        scene(6, vec![light([0.0, 90.0, 0.0], 1.0, [1e6; 3])], vec![floor]).camera([0.0, 5.0, 0.1], [0.0; 3], 30.0);
    assert_exact("a free sky", &with(&desc, occlusion(None), 0), [1.0; 3]);
    // The lamp is a thing like others.
    let mut away = desc.camera([0.0, 5.0, 0.1], [0.0, 9.0, 0.0], 30.0);
    away.lights.clear();
    assert_exact("nothing", &with(&away.background([5.0; 3]), occlusion(None), 0), [0.0; 3]);
    // At the foot of a ball as large as a world, which the eye takes for a wall, half of the sky is hidden.
    let floor = mesh(&square(1.0).obj("square-1"), diffuse([0.1; 3]), Shading::Auto, vec![]);
    let wall = sphere([1e4 + 1e-3, 0.0, 0.0], 1e4, diffuse([0.5; 3]));
    let desc = scene(8, vec![], vec![floor, wall]).camera([-0.3, 0.4, 0.0], [0.0; 3], 1e-3);
    // It curves away: by as much as the formula of balls says.
    let expected = 1.0 - irradiance((1e4 / (1e4 + 1e-3f64)).asin(), PI / 2.0) / PI;
    assert!((0.5..0.501).contains(&expected));
    assert_mean("a wall", &with(&desc, occlusion(None), 0), 64, expected);
}

/// Whatever of threads, lanes and crop.
#[test]
fn the_same_bytes_whatever_the_schedule() {
    for integrator in [Integrator::Direct, occlusion(Some(2.0)), occlusion(None)] {
        let scene = compiled(&with(&everything(), integrator.clone(), 3));
        let expected = bits(&render(&scene, &options(5), &Unobserved));
        for level in Level::available().into_iter().filter(|level| *level != Level::PORTABLE) {
            let film = render(&scene, &RenderOptions { level: Some(level), threads: 2, ..options(5) }, &Unobserved);
            assert!(bits(&film) == expected, "{integrator}, {}", level.name());
        }
        let crop = Crop { x: 5, y: 9, width: 20, height: 13 };
        let film = render(&scene, &RenderOptions { crop: Some(crop), ..options(5) }, &Unobserved);
        let whole = render(&scene, &options(5), &Unobserved);
        for (x, y) in (9..22).flat_map(|y| (5..25).map(move |x| (x, y))) {
            assert_eq!(film.radiance(x, y), whole.radiance(x, y), "{integrator}: {x},{y}");
        }
        // They know no techniques, whoever asks for them.
        let asked = RenderOptions { reuse: Some(true), caustics: Some(true), ..options(5) };
        assert!(bits(&render(&scene, &asked, &Unobserved)) == expected, "{integrator}");
    }
}
