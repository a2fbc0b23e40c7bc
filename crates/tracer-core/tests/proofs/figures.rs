//! The report's nine figures, reduced: engine and reference make the same picture. A torus stands for the cat.

use crate::support::compare::{Samples, assert_same_picture};
use crate::support::describe::*;
use crate::support::meshes::{icosphere, picture, torus};
use scene_format::SceneDesc;
use scene_format::desc::{Acceleration, Material, Object, PixelFilter, Shading, TextureFilter, TextureWrap, Transform};

const SIZE: u32 = 32;
const SPHERES: Samples = Samples { engine: 256, reference: 512 };
const MESHES: Samples = Samples { engine: 256, reference: 128 };

fn figure(bounces: u32, objects: Vec<Object>) -> SceneDesc {
    let objects = room().into_iter().chain(objects).collect();
    scene(SIZE, vec![room_light()], objects)
        .camera([0.0, 0.0, 55.0], [0.0, 0.0, 0.0], 60.0)
        .bounces(bounces)
        .filter(PixelFilter::Gaussian { sigma: 0.4.into() })
}

fn cat(material: Material, x: f64, size: f64, turn: f64) -> Object {
    let steps = vec![
        scale(size),
        rotate([0.0, 0.0, 1.0], 35.0),
        rotate([0.0, 1.0, 0.0], turn),
        Transform::Translate([x, 0.0, 0.0]),
        Transform::DropTo { y: -20.0 },
    ];
    mesh(&torus(0.45, 14, 8).obj("torus"), material, Shading::Auto, steps)
}

fn fur() -> Material {
    textured(&picture(), TextureFilter::Bilinear, TextureWrap::Repeat)
}

#[test]
fn figure_1_a_textured_mesh_and_a_red_sphere() {
    let red = sphere([15.0, -15.0, 15.0], 5.0, diffuse([1.0, 0.05, 0.05]));
    assert_same_picture("figure 1", &figure(5, vec![cat(fur(), 0.0, 12.0, -45.0), red]), MESHES);
}

#[test]
fn figure_2_two_meshes_moved_turned_and_scaled() {
    let rearing = cat(diffuse([0.8; 3]), -16.0, 6.0, -45.0);
    assert_same_picture("figure 2", &figure(10, vec![rearing, cat(fur(), 16.0, 11.0, -135.0)]), MESHES);
}

#[test]
fn figure_3_with_every_acceleration() {
    for acceleration in [Acceleration::Bvh, Acceleration::BoundingBox, Acceleration::None] {
        let mut desc = figure(5, vec![cat(fur(), 9.0, 11.0, -10.0)]);
        desc.render.acceleration = acceleration;
        assert_same_picture(&format!("figure 3, {acceleration:?}"), &desc, Samples { engine: 128, reference: 32 });
    }
}

#[test]
fn figure_4_mirrors_blinn_phong_and_transparent_balls() {
    let row = |y: f64, materials: [Material; 3]| {
        materials.into_iter().zip([-20.0, 0.0, 20.0]).map(move |(m, x)| sphere([x, y, -20.0], 10.0, m))
    };
    let balls = row(-10.0, [1.0, 0.5, 0.1].map(|r| mirror([r; 3])))
        .chain(row(
            10.0,
            [
                blinn_phong([0.1, 0.1, 1.0], 1000.0, 0.01),
                blinn_phong([0.1, 1.0, 0.1], 1000.0, 0.05),
                blinn_phong([1.0, 0.1, 0.1], 1000.0, 0.1),
            ],
        ))
        .chain(row(30.0, [1.33, 1.52, 2.42].map(glass)));
    assert_same_picture("figure 4", &figure(5, balls.collect()), SPHERES);
}

#[test]
fn figure_5_mirror_glossy_and_glass_meshes() {
    let ball = |material: Material, x: f64| {
        let steps = vec![scale(9.0), Transform::Translate([x, 0.0, 0.0]), Transform::DropTo { y: -20.0 }];
        mesh(&icosphere(1).obj("icosphere-1"), material, Shading::Auto, steps)
    };
    let texture = picture_of_fur();
    let objects = vec![
        cat(mirror([0.9; 3]), -20.0, 9.0, -60.0),
        cat(glossy(texture, 1000.0, 0.1, false), 0.0, 9.0, -60.0),
        ball(glass(1.52), 20.0),
    ];
    assert_same_picture("figure 5", &figure(10, objects), MESHES);
}

fn picture_of_fur() -> scene_format::desc::Albedo {
    crate::support::describe::picture(&picture(), TextureFilter::Bilinear, TextureWrap::Repeat)
}

fn three_balls() -> Vec<Object> {
    vec![
        sphere([-20.0, -10.0, -20.0], 10.0, diffuse([1.0, 0.05, 0.05])),
        sphere([10.0, 10.0, 20.0], 10.0, diffuse([0.1, 1.0, 0.3])),
        sphere([0.0, 0.0, 0.0], 10.0, diffuse([0.1, 0.3, 1.0])),
    ]
}

#[test]
fn figure_6_without_depth_of_field() {
    assert_same_picture("figure 6", &figure(5, three_balls()), SPHERES);
}

#[test]
fn figure_7_with_depth_of_field() {
    assert_same_picture("figure 7", &figure(5, three_balls()).lens(4.0, 55.0), SPHERES);
}

#[test]
fn figures_8_and_9_without_and_with_anti_aliasing() {
    let ball = || vec![sphere([0.0, 0.0, 0.0], 20.0, diffuse([0.1, 0.3, 1.0]))];
    // A little to the side: from the middle the centres of the diagonal's pixels see walls and ceiling at the same
    // distance.
    let sharp = figure(5, ball()).filter(PixelFilter::None).camera([0.37, 0.0, 55.0], [0.37, 0.0, 0.0], 60.0);
    assert_same_picture("figure 8", &sharp, SPHERES);
    assert_same_picture("figure 9", &figure(5, ball()), SPHERES);
}
