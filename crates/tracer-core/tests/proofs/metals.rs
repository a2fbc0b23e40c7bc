//! Metals: the engine against the reference, with light from everywhere, from a lamp, and over one metal to another;
//! and the default picture against the plain path tracer's.

use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture, assert_sharing_is_unbiased};
use crate::support::describe::*;
use crate::support::meshes::{cube, icosphere, torus};
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use scene_format::desc::{Albedo, Conductor, Material, Metal, Reflectance, Shading, Transform};

fn metal(metal: Metal, roughness: f64) -> Material {
    conductor(Reflectance::Metal(metal), roughness, true)
}

fn tinted(color: [f64; 3], edge_tint: [f64; 3], roughness: f64) -> Material {
    let reflectance = Albedo::Color(color.into());
    conductor(Reflectance::Tinted { reflectance, edge_tint: edge_tint.into() }, roughness, true)
}

fn conductor(reflectance: Reflectance, roughness: f64, multiple_scattering: bool) -> Material {
    Material::Conductor(Box::new(Conductor { reflectance, roughness: roughness.into(), multiple_scattering }))
}

/// Three balls on a matt floor: smooth, narrow and dull.
fn balls() -> SceneDesc {
    let dull = conductor(Reflectance::Complex { ior: [2.9, 1.2, 0.4].into(), k: [3.0, 2.5, 1.9].into() }, 0.9, false);
    let objects = vec![
        sphere([0.0, -1000.0, 0.0], 1000.0, diffuse([0.6; 3])),
        sphere([-2.1, 1.0, 0.0], 1.0, metal(Metal::Gold, 0.0)),
        sphere([0.0, 1.0, 0.0], 1.0, tinted([0.9, 0.5, 0.3], [1.0, 0.7, 0.4], 0.45)),
        sphere([2.1, 1.0, 0.0], 1.0, dull),
        sphere([0.0, 0.5, 2.0], 0.5, metal(Metal::Copper, 1.0)),
    ];
    scene(32, vec![light([3.0, 7.0, 5.0], 1.5, [12.0, 11.0, 9.0])], objects)
        .camera([0.0, 3.0, 9.0], [0.0, 0.8, 0.0], 35.0)
        .background([0.2, 0.3, 0.4])
        .bounces(3)
}

#[test]
fn metals_are_those_of_the_reference() {
    assert_same_picture("metals", &balls(), Samples { engine: 256, reference: 256 });
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn metals_with_interpolated_normals_are_those_of_the_reference() {
    let torus = torus(0.4, 24, 16).obj("torus-24-16");
    let placed = vec![Transform::Translate([0.0, 0.8, 0.0])];
    let mut desc = balls();
    desc.objects.truncate(1);
    for (k, roughness) in [0.0, 0.5].into_iter().enumerate() {
        let mut steps = placed.clone();
        steps.push(Transform::Translate([2.8 * k as f64 - 1.4, 0.0, 0.0]));
        desc.objects.push(mesh(&torus, metal(Metal::Brass, roughness), Shading::Smooth, steps).into());
    }
    assert_same_picture("smooth metals", &desc, Samples { engine: 256, reference: 256 });
}

#[test]
fn metals_share_and_guide_without_bias() {
    let mut desc = balls();
    desc.background = [0.0; 3].into();
    assert_sharing_is_unbiased("metals", &desc, 4);
    assert_guiding_is_unbiased("metals", &desc, 256, 4);
}

/// Under an even sky no metal is brighter than it, whatever its roughness: low-poly meshes whose interpolated normals
/// are seen from behind along outlines, and a plain to the horizon. By one reflection no sample is; by several their
/// mean is not.
#[test]
fn metals_make_no_light() {
    let white = |roughness: f64, several: bool| {
        let reflectance = Reflectance::Tinted { reflectance: [1.0; 3].into(), edge_tint: [1.0; 3].into() };
        conductor(reflectance, roughness, several)
    };
    let of_shape = |shape: u32, material: Material| {
        let object = match shape {
            0 => mesh(&icosphere(0).off("icosphere-0"), material, Shading::Smooth, vec![]),
            1 => mesh(&cube().off("cube"), material, Shading::Smooth, vec![]),
            _ => sphere([0.0, -1e4, 0.0], 1e4 - 1.0, material),
        };
        scene(32, vec![], vec![object]).camera([1.2, 0.8, 2.4], [0.0, -0.2, 0.0], 50.0).background([1.0; 3]).bounces(8)
    };
    for (shape, roughness) in (0..3).flat_map(|shape| [0.05, 0.1, 0.3, 0.7].map(|roughness| (shape, roughness))) {
        for several in [false, true] {
            let film = film(&compiled(&of_shape(shape, white(roughness, several))), 64, 1);
            let pixels = (0..32).flat_map(|y| (0..32).map(move |x| (x, y)));
            let values: Vec<f64> = pixels.map(|(x, y)| film.radiance(x, y)[0]).collect();
            let (mean, most) = (values.iter().sum::<f64>() / 1024.0, values.iter().copied().fold(0.0, f64::max));
            // Single precision. By several reflections the mean is what E is told to between the table's places; and
            // of a pixel's 64 samples three that are worth 8, the most there is (the unit tests say so), make 1.33.
            let bounds = if several { (1.003, 1.3) } else { (1.0 + 1e-4, 1.0 + 1e-3) };
            assert!(mean < bounds.0 && most < bounds.1, "{shape} {roughness} {several}: mean {mean}, most {most}");
        }
    }
}
