//! Scenes made by chance: engine and reference make the same picture. Every material, shape, light and effect occurs.

use crate::support::compare::{Samples, assert_same_picture};
use crate::support::describe::*;
use crate::support::meshes::{cube, deep_picture, icosphere, square, torus};
use scene_format::SceneDesc;
use scene_format::desc::{
    Albedo, Diffuse, Material, Object, PixelFilter, Placements, Reuse, Shading, SphereLight, TextureFilter,
    TextureWrap, Transform, Transparent, Vec3,
};
use scene_format::diagnostic::Spanned;
use tracer_reference::Random;

const SIZE: u32 = 32;

/// Things lie within this distance of the origin.
const REACH: f64 = 5.0;

fn point(random: &mut Random) -> Vec3 {
    [0; 3].map(|_| random.between(-REACH, REACH))
}

fn color(random: &mut Random) -> [f64; 3] {
    [0; 3].map(|_| random.between(0.1, 0.95))
}

fn albedo(random: &mut Random) -> Albedo {
    if random.below(3) > 0 {
        return Albedo::Color(color(random).into());
    }
    let file = if random.below(2) == 0 { crate::support::meshes::picture() } else { deep_picture() };
    let filter = [TextureFilter::Bilinear, TextureFilter::Nearest][random.below(2)];
    let wrap = [TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror][random.below(3)];
    crate::support::describe::picture(&file, filter, wrap)
}

fn material(random: &mut Random) -> Material {
    match random.below(5) {
        0 | 1 => Material::Diffuse(Diffuse { albedo: albedo(random) }),
        2 => mirror(color(random)),
        3 => Material::Transparent(Box::new(Transparent {
            ior: random.between(1.05, 2.4).into(),
            transmittance: [0; 3].map(|_| random.between(0.7, 1.0)).into(),
        })),
        _ => {
            let exponent = 10f64.powf(random.between(0.0, 3.5));
            // The report's lobe reflects up to four times its share.
            let energy_conserving = random.below(2) == 0;
            let share = random.between(0.05, if energy_conserving { 1.0 } else { 0.25 });
            glossy(albedo(random), exponent, share, energy_conserving)
        }
    }
}

fn object(random: &mut Random) -> Object {
    let center = point(random);
    let material = material(random);
    if random.below(2) == 0 {
        return sphere(center, random.between(0.7, 2.5), material);
    }
    let file = match random.below(5) {
        0 => icosphere(1).off("icosphere-1"),
        1 => icosphere(1).obj("icosphere-1"),
        2 => torus(0.4, 12, 6).obj("torus-12-6"),
        3 => cube().off("cube"),
        _ => square(2.0).obj("square-2"),
    };
    let shading = [Shading::Auto, Shading::Smooth, Shading::Flat][random.below(3)];
    let axis = random.direction().to_array();
    let factor = [0; 3].map(|_| random.between(0.8, 2.2) * if random.below(4) == 0 { -1.0 } else { 1.0 });
    let steps = vec![
        Transform::Scale { factor, about: None },
        rotate(axis, random.between(0.0, 360.0)),
        Transform::Translate(center),
    ];
    let placements = if random.below(2) == 0 {
        Placements::One
    } else {
        let copy = |random: &mut Random| {
            let by = point(random).map(|x| 0.6 * x);
            let mirrored = if random.below(2) == 0 { [1.0, 1.0, -1.0] } else { [1.0; 3] };
            vec![
                Spanned::from(Transform::Scale { factor: mirrored, about: Some(Box::new([0.0; 3])) }),
                Spanned::from(Transform::Translate(by)),
            ]
        };
        (0..2).map(|_| copy(random)).collect()
    };
    placed(&file, material, shading, steps, placements)
}

fn lamp(random: &mut Random) -> SphereLight {
    // Sometimes all around: everything, the camera too, is inside of it.
    if random.below(8) == 0 {
        return light([0.0; 3], random.between(20.0, 30.0), color(random));
    }
    let radius = random.between(0.5, 2.0);
    let brightness = random.between(5.0, 20.0) / (radius * radius);
    light(point(random).map(|x| 1.2 * x), radius, color(random).map(|c| c * brightness))
}

pub fn random_scene(seed: u64) -> SceneDesc {
    let mut random = Random::new(seed);
    let random = &mut random;
    let mut objects: Vec<Object> = (0..2 + random.below(4)).map(|_| object(random)).collect();
    if random.below(3) > 0 {
        objects.push(sphere(
            [0.0, -1000.0 - REACH, 0.0],
            1000.0,
            Material::Diffuse(Diffuse { albedo: Albedo::Color(color(random).into()) }),
        ));
    }
    let lights: Vec<SphereLight> = (0..random.below(4)).map(|_| lamp(random)).collect();
    let dark = lights.is_empty() || random.below(2) == 0;
    let eye = (12.0 * random.direction()).to_array();
    let desc = scene(SIZE, lights, objects)
        .camera([eye[0], 0.5 * eye[1] + 1.0, eye[2]], point(random).map(|x| 0.2 * x), random.between(30.0, 70.0))
        .bounces(random.below(8) as u32)
        .filter(match random.below(4) {
            0 => PixelFilter::None,
            1 => PixelFilter::Box,
            2 => PixelFilter::Gaussian { sigma: random.between(0.2, 1.0).into() },
            _ => PixelFilter::BlackmanHarris { radius: random.between(1.0, 2.5).into() },
        });
    let desc = if dark { desc.background(color(random)) } else { desc };
    if random.below(3) == 0 { desc.lens(random.between(0.2, 1.5), random.between(6.0, 15.0)) } else { desc }
}

/// Twelve a test, so that the runner has several to run side by side.
fn compare(first: u64) {
    for seed in first..first + 12 {
        let mut desc = random_scene(seed);
        if seed % 3 == 0 {
            desc.render.reuse = Reuse::None;
        }
        // In four of them glass and mirrors show in a few pixels what one sample in ten thousand finds there (the
        // engine goes both ways at glass, the reference does not): with fewer samples the reference sees nothing of it,
        // and knows of no error. With 1536 all tiles agree.
        let reference = if [0, 19, 21, 30].contains(&seed) { 1536 } else { 96 };
        assert_same_picture(&format!("random scene {seed}"), &desc, Samples { engine: 256, reference });
    }
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn random_scenes_0_to_11() {
    compare(0);
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn random_scenes_12_to_23() {
    compare(12);
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn random_scenes_24_to_35() {
    compare(24);
}
