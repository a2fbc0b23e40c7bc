//! Disks, cylinders, cones, capsules, tori and ellipsoids: engine and reference make the same picture, whatever they
//! are made of; placed spheres.

use crate::support::compare::{Samples, assert_same_picture};
use crate::support::describe::*;
use scene_format::desc::{
    Capsule, Cone, Cylinder, Disk, Emissive, LightGroup, Material, MaterialRef, Name, Object, PerAxis, Placements,
    Rectangle, Torus, Transform, Transparent, Vec3,
};
use scene_format::{SceneDesc, desc::Amount};
use tracer_core::compile;

fn inline(material: Material) -> MaterialRef {
    MaterialRef::Inline(Box::new(material.into()))
}

pub fn turned(object: Object, transform: Vec<Transform>) -> Object {
    let mut object = object;
    *object.transform_mut() = transform.into_iter().map(Into::into).collect();
    object
}

pub fn disk(center: Vec3, normal: Vec3, [radius, inner]: [f64; 2], material: Material) -> Object {
    Object::Disk(Box::new(Disk {
        center: center.into(),
        normal: normal.into(),
        radius: radius.into(),
        inner_radius: inner.into(),
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

pub fn cylinder(from: Vec3, to: Vec3, radius: f64, caps: bool, material: Material) -> Object {
    Object::Cylinder(Box::new(Cylinder {
        from: from.into(),
        to: to.into(),
        radius: radius.into(),
        caps,
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

pub fn cone(from: Vec3, to: Vec3, [radius, tip]: [f64; 2], caps: bool, material: Material) -> Object {
    Object::Cone(Box::new(Cone {
        from: from.into(),
        to: to.into(),
        radius: radius.into(),
        tip_radius: tip.into(),
        caps,
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

pub fn capsule(from: Vec3, to: Vec3, radius: f64, material: Material) -> Object {
    Object::Capsule(Box::new(Capsule {
        from: from.into(),
        to: to.into(),
        radius: radius.into(),
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

pub fn torus(center: Vec3, axis: Vec3, [radius, tube]: [f64; 2], material: Material) -> Object {
    Object::Torus(Box::new(Torus {
        center: center.into(),
        axis: axis.into(),
        radius: radius.into(),
        tube_radius: tube.into(),
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

fn floor() -> Object {
    Object::Rectangle(Box::new(Rectangle {
        center: [0.0; 3].into(),
        normal: [0.0, 1.0, 0.0].into(),
        size: PerAxis([9.0; 2]).into(),
        material: inline(diffuse([0.7, 0.6, 0.5])),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

fn view(objects: Vec<Object>) -> SceneDesc {
    let lamp = light([-2.5, 4.0, 3.0], 0.7, [14.0, 13.0, 12.0]);
    let objects = [vec![floor()], objects].concat();
    scene(32, vec![lamp], objects).camera([0.5, 2.2, 6.0], [0.0, 0.9, 0.0], 42.0).bounces(5)
}

pub fn stretch() -> Vec<Transform> {
    vec![
        Transform::Scale { factor: [1.3, 0.8, -0.6], about: None },
        Transform::Rotate { axis: [1.0, 0.3, 0.2], degrees: 35.0, about: None },
    ]
}

/// A matrix that shears and mirrors, with (1.5, 1, 0) where it was.
pub fn shear() -> Vec<Transform> {
    vec![Transform::Matrix { rows: Box::new([[1.0, 0.4, 0.0, -0.4], [0.0, 1.0, 0.3, 0.0], [0.2, 0.0, -1.0, -0.3]]) }]
}

/// Of each material each shape, some of them stretched, turned, mirrored and sheared.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn curved_shapes_as_the_reference_sees_them() {
    let samples = Samples { engine: 256, reference: 256 };
    let glass =
        || Material::Transparent(Box::new(Transparent { ior: 1.5.into(), transmittance: [0.9, 0.95, 1.0].into() }));
    let materials: [(&str, Material); 4] = [
        ("matt", diffuse([0.3, 0.5, 0.8])),
        ("mirror", mirror([0.9, 0.8, 0.7])),
        ("glass", glass()),
        ("glossy", blinn_phong([0.5; 3], 120.0, 0.2)),
    ];
    for (name, material) in materials {
        // Light through glass the reference finds in few of its samples.
        let samples = Samples { reference: if name == "glass" { 16384 } else { 256 }, ..samples };
        let m = || material.clone();
        let closed = vec![
            cylinder([-1.6, 0.01, 0.4], [-1.2, 1.5, 0.0], 0.45, true, m()),
            cone([0.2, 0.01, 0.7], [0.0, 1.4, 0.5], [0.6, 0.15], true, m()),
            turned(capsule([1.2, 0.8, 0.0], [1.9, 1.2, 0.3], 0.4, m()), shear()),
            turned(sphere([0.2, 1.9, -0.6], 0.6, m()), stretch()),
        ];
        let tori = vec![
            torus([-1.3, 0.9, 0.2], [0.6, 0.3, 1.0], [0.6, 0.25], m()),
            turned(torus([0.4, 0.7, 0.9], [0.0, 1.0, 0.2], [0.4, 0.4], m()), stretch()),
            turned(torus([1.5, 0.9, 0.0], [0.3, 0.5, 0.5], [0.7, 0.1], m()), shear()),
        ];
        assert_same_picture(&format!("tori, {name}"), &view(tori), samples);
        assert_same_picture(&format!("closed, {name}"), &view(closed), samples);
        if name != "glass" {
            let open = vec![
                disk([-1.3, 0.9, 0.0], [0.6, 0.3, 1.0], [0.8, 0.3], m()),
                turned(cylinder([0.2, 0.2, 0.6], [0.5, 1.1, 0.4], 0.5, false, m()), stretch()),
                cone([1.6, 0.3, 0.0], [1.7, 1.5, 0.0], [0.3, 0.7], false, m()),
            ];
            assert_same_picture(&format!("open, {name}"), &view(open), samples);
        }
    }
}

/// Tori of three materials, one of which shines.
#[test]
fn tori_as_the_reference_sees_them() {
    let samples = Samples { engine: 128, reference: 128 };
    let lamp = Material::Emissive(Box::new(Emissive {
        amount: Amount::Power([9.0; 3]).into(),
        color: [1.0; 3].into(),
        two_sided: false,
        group: LightGroup::default(),
    }));
    let tori = vec![
        torus([-1.3, 0.9, 0.2], [0.6, 0.3, 1.0], [0.6, 0.25], diffuse([0.3, 0.5, 0.8])),
        turned(torus([0.4, 0.7, 0.9], [0.0, 1.0, 0.2], [0.4, 0.4], blinn_phong([0.5; 3], 120.0, 0.2)), stretch()),
        turned(torus([1.5, 0.9, 0.0], [0.3, 0.5, 0.5], [0.7, 0.1], lamp), shear()),
    ];
    assert_same_picture("tori", &view(tori), samples);
}

/// A sphere that is moved and scaled alike is that sphere: the same bytes. One that shines may turn, too.
#[test]
fn placed_spheres_are_spheres() {
    let written = view(vec![sphere([0.5, 1.0, 0.25], 0.5, diffuse([0.4; 3]))]);
    let steps = vec![
        Transform::Scale { factor: [0.5; 3], about: Some(Box::new([0.0; 3])) },
        Transform::Translate([0.5, 0.5, 0.25]),
    ];
    let moved = view(vec![turned(sphere([0.0, 1.0, 0.0], 1.0, diffuse([0.4; 3])), steps)]);
    let (written, moved) = (compile(&written).unwrap(), compile(&moved).unwrap());
    assert_eq!(written.spheres, moved.spheres);
    assert!(moved.shapes.is_empty());

    let power = Amount::Power([50.0; 3]).into();
    let lamp = Material::Emissive(Box::new(Emissive {
        amount: power,
        color: [1.0; 3].into(),
        two_sided: false,
        group: LightGroup::default(),
    }));
    let mut copied = turned(sphere([0.0; 3], 1.0, lamp.clone()), vec![rotate([1.0, 2.0, 0.5], 70.0)]);
    let copy = |x: f64, size: f64| {
        vec![Transform::Scale { factor: [size; 3], about: None }.into(), Transform::Translate([x, 2.5, 0.0]).into()]
    };
    *copied.placements_mut() = [copy(-1.0, 0.2), copy(1.0, 0.4)].into_iter().collect();
    let both = vec![sphere([-1.0, 2.5, 0.0], 0.2, lamp.clone()), sphere([1.0, 2.5, 0.0], 0.4, lamp.clone())];
    let samples = Samples { engine: 128, reference: 128 };
    assert_same_picture("copied lamps", &view(vec![copied.clone()]), samples);
    let (copied, both) = (compile(&view(vec![copied])).unwrap(), compile(&view(both)).unwrap());
    assert_eq!((copied.lights.len(), copied.shapes.len()), (3, 0));
    for (a, b) in copied.lights.iter().zip(&both.lights) {
        let (a, b) = (a.radiance(), b.radiance());
        assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-9 * b[k]), "{a:?} {b:?}");
    }
}

/// What cannot be is told.
#[test]
fn faults_of_curved_shapes() {
    let told = |object: Object| match compile(&view(vec![object])) {
        Err(error) => error.diagnostics.iter().map(|d| format!("{}: {}", d.code, d.message)).collect::<Vec<_>>(),
        Ok(scene) => scene.warnings.iter().map(|d| format!("{}: {}", d.code, d.message)).collect(),
    };
    let lamp = || {
        Material::Emissive(Box::new(Emissive {
            amount: Amount::Radiance([1.0; 3]).into(),
            color: [1.0; 3].into(),
            two_sided: false,
            group: LightGroup::default(),
        }))
    };
    let glass = || Material::Transparent(Box::new(Transparent { ior: 1.5.into(), transmittance: [1.0; 3].into() }));
    let matt = || diffuse([0.5; 3]);
    let up = [0.0, 1.0, 0.0];
    assert!(told(disk(up, up, [1.0, 0.0], lamp())).is_empty());
    let unseen = "W0315: objects[1] shines to where nothing is: nobody sees its light";
    assert_eq!(told(disk(up, [0.0, 1.0, 1e-3], [1.0, 0.0], lamp())), [""; 0]);
    assert_eq!(told(disk([0.0, 9.0, 0.0], up, [1.0, 0.0], lamp())), [unseen]);
    let flat = vec![Transform::Scale { factor: [1.0, 0.5, 1.0], about: None }];
    assert!(told(turned(sphere(up, 0.5, lamp()), flat)).is_empty());
    let nothing = vec![Transform::Scale { factor: [1.0, 0.0, 1.0], about: None }];
    assert_eq!(
        told(turned(cylinder(up, [0.0, 2.0, 0.0], 0.5, true, matt()), nothing)),
        ["E0540: the transforms flatten the cylinder to nothing"]
    );
    assert_eq!(told(cone(up, up, [1.0, 0.0], true, matt())), ["E0542: the cone has no length"]);
    let hole = "E0542: the hole is as large as the disk: nothing of it is left";
    assert_eq!(told(disk(up, up, [1.0, 1.5], matt())), [hole]);
    assert_eq!(told(disk(up, up, [1.0, 0.5], glass())), ["W0310: glass of an open disk has no inside"]);
    let tube = cylinder(up, [0.0, 2.0, 0.0], 0.5, false, glass());
    assert_eq!(told(tube), ["W0310: glass of an open cylinder has no inside"]);
    assert!(told(cylinder(up, [0.0, 2.0, 0.0], 0.5, true, glass())).is_empty());
}
