//! Scenes by chance, of every word that a description has.

use super::Random;
use super::lights::{emissive, light_group, sphere_light};
use super::solid::solid;
use super::textures::{albedo, named_textures, varying};
use scene_format::SceneDesc;
use scene_format::desc::*;
use scene_format::diagnostic::{Span, Spanned};
use std::path::PathBuf;
use std::sync::Arc;

pub(super) fn number(random: &mut Random, low: f64, high: f64) -> f64 {
    match random.below(6) {
        0 => (low + (high - low) * random.unit()).round().clamp(low, high),
        1 if low <= 0.0 && high >= 0.0 => 0.0,
        // Very small and very large ones, where decimal digits are hard to get right.
        2 if high > 1e6 => 10f64.powi(random.below(20) as i32 - 10).clamp(low, high),
        _ => low + (high - low) * random.unit(),
    }
}

pub(super) fn length(random: &mut Random) -> f64 {
    number(random, 1e-9, 1e9).max(1e-9)
}

pub(super) fn vector(random: &mut Random) -> Vec3 {
    [(); 3].map(|()| number(random, -1e6, 1e6))
}

pub(super) fn share(random: &mut Random) -> Color {
    if random.below(3) == 0 { [random.unit(); 3] } else { [(); 3].map(|()| random.unit()) }
}

pub(super) fn text(random: &mut Random) -> String {
    const LETTERS: [&str; 12] = ["a", "Z", "0", "_", "-", " ", "é", "赤", "\"", "\\", "\t", "\u{1}"];
    let letters: String = (0..1 + random.below(8)).map(|_| *random.pick(&LETTERS)).collect();
    format!("n{letters}")
}

fn material(random: &mut Random) -> Material {
    match random.below(6) {
        5 => Material::Conductor(Box::new(Conductor {
            reflectance: match random.below(3) {
                0 => Reflectance::Metal(*random.pick(&[Metal::Silver, Metal::Gold, Metal::Steel])),
                1 => Reflectance::Complex { ior: share(random).into(), k: share(random).into() },
                _ => Reflectance::Tinted { reflectance: albedo(random), edge_tint: albedo(random) },
            },
            roughness: varying(random, 1.0),
            multiple_scattering: random.below(2) == 0,
        })),
        0 => Material::Diffuse(Diffuse { albedo: albedo(random) }),
        4 => Material::Emissive(Box::new(emissive(random))),
        1 => Material::Mirror(Mirror { reflectance: albedo(random) }),
        2 => Material::Transparent(Box::new(Transparent {
            ior: number(random, 1.0, 3.0).into(),
            transmittance: albedo(random),
        })),
        _ => Material::BlinnPhong(Box::new(BlinnPhong {
            albedo: albedo(random),
            exponent: varying(random, 1e5),
            specular: varying(random, 1.0),
            energy_conserving: random.below(2) == 0,
        })),
    }
}

fn transform(random: &mut Random) -> Transform {
    let about = (random.below(2) == 0).then(|| Box::new(vector(random)));
    match random.below(8) {
        0 => Transform::Translate(vector(random)),
        1 => {
            let uniform = random.below(2) == 0;
            let factor = [(); 3].map(|()| number(random, 0.1, 10.0) * [1.0, -1.0][random.below(2)]);
            Transform::Scale { factor: if uniform { [factor[0]; 3] } else { factor }, about }
        }
        2 => Transform::Rotate { axis: [1.0, random.unit(), 0.0], degrees: number(random, -360.0, 360.0), about },
        3 => {
            // Larger on the diagonal than beside it: it can be undone.
            let row = |k: usize, random: &mut Random| {
                let mut row = [(); 4].map(|()| number(random, -1.0, 1.0));
                row[k] = number(random, 3.0, 5.0) * [1.0, -1.0][random.below(2)];
                row
            };
            Transform::Matrix { rows: Box::new([0, 1, 2].map(|k| row(k, random))) }
        }
        4 => {
            let from = if random.below(2) == 0 { [0.0, 1.0, 0.0] } else { [random.unit(), 0.5, 0.0] };
            Transform::Align { from: Box::new(from), to: Box::new([1.0, 0.0, random.unit()]), about }
        }
        5 => Transform::FitTo {
            extent: *random.pick(&[Extent::Height, Extent::Width, Extent::Depth, Extent::Size]),
            length: length(random),
            about,
        },
        6 => Transform::CenterTo { point: vector(random) },
        _ => Transform::DropTo { y: number(random, -1e3, 1e3) },
    }
}

/// Points, and faces that name them.
fn inline_mesh(random: &mut Random) -> MeshSource {
    let points: Vec<_> = (0..3 + random.below(5)).map(|_| vector(random)).collect();
    let mut faces = Faces::default();
    for _ in 0..=random.below(3) {
        let corners: Vec<u32> = (0..3 + random.below(3)).map(|_| random.below(points.len()) as u32).collect();
        faces.push(&corners);
    }
    let count = if random.below(2) == 0 { points.len() } else { 0 };
    let colors = (0..count).map(|_| share(random)).collect();
    MeshSource::Inline(Arc::new(InlineMesh { points, faces, colors }.into()))
}

pub(super) fn transforms(random: &mut Random) -> Vec<scene_format::diagnostic::Spanned<Transform>> {
    (0..random.below(4)).map(|_| transform(random).into()).collect()
}

fn pattern(random: &mut Random) -> PlacementPattern {
    let count = |random: &mut Random| 1 + random.below(5) as u32;
    match random.below(3) {
        0 => PlacementPattern::Grid { count: [count(random), 1, count(random)], spacing: vector(random) },
        1 => PlacementPattern::Ring {
            count: count(random),
            radius: length(random),
            axis: [0.0, number(random, 0.1, 1.0), 1.0],
            start: number(random, -90.0, 90.0),
            turn: random.below(2) == 0,
        },
        _ => PlacementPattern::Scatter {
            count: count(random),
            min: vector(random),
            max: vector(random),
            seed: count(random),
            spacing: (random.below(2) == 0).then(|| length(random)),
            turn: (random.below(2) == 0).then_some([0.0, 1.0, 0.0]),
            scale: [0.5, number(random, 1.0, 2.0)],
        },
    }
}

pub(super) fn name(random: &mut Random) -> Name {
    (random.below(3) == 0).then(|| text(random)).into()
}

/// Puts some of the objects into groups, and groups into groups.
fn grouped(random: &mut Random, objects: &mut [Spanned<Object>]) {
    let moves = |random: &mut Random| {
        let mut steps = transforms(random);
        steps.retain(|step| !step.value.asks_for_reach());
        steps.insert(0, Transform::Translate(vector(random)).into());
        steps
    };
    let group = |random: &mut Random| {
        let placements = match random.below(3) {
            0 => Placements::One,
            1 => Placements::from(PathBuf::from(text(random))),
            _ => (0..1 + random.below(3)).map(|_| moves(random)).collect(),
        };
        Arc::new(Moved { transform: moves(random), placements })
    };
    let mut groups = Arc::new(Groups { inner: None, group: group(random) });
    for object in objects {
        match random.below(5) {
            0 => groups = Arc::new(Groups { inner: None, group: group(random) }),
            1 => groups = Arc::new(Groups { inner: Some(groups), group: group(random) }),
            2 => continue,
            _ => {}
        }
        let placements = object.value.placements_mut();
        let own = std::mem::take(placements);
        *placements = Placements::from(Within { own, groups: Arc::clone(&groups) });
    }
}

/// A valid scene that uses much of the language.
/// A camera, but for where it stands, and its lens.
fn view(random: &mut Random) -> (Camera, Option<ThinLens>) {
    let mut camera = Camera::default();
    let fov = number(random, 1.0, 179.0);
    camera.projection = match random.below(8) {
        0 => Projection::Orthographic { height: length(random).into() },
        1 => Projection::Panorama,
        2 => {
            let mappings = [
                FisheyeMapping::Equidistant,
                FisheyeMapping::Equisolid,
                FisheyeMapping::Stereographic,
                FisheyeMapping::Orthographic,
            ];
            Projection::Fisheye { fov: fov.into(), mapping: *random.pick(&mappings) }
        }
        _ => Projection::Perspective,
    };
    if matches!(camera.projection, Projection::Perspective | Projection::Orthographic { .. }) {
        camera.shift = [number(random, -3.0, 3.0), number(random, -3.0, 3.0)].into();
        camera.near = (random.below(2) == 0).then(|| length(random).into());
    }
    let is_perspective = camera.projection == Projection::Perspective;
    if (is_perspective || camera.projection == Projection::Panorama) && random.below(4) == 0 {
        camera.stereo = Some(Stereo {
            separation: length(random).into(),
            convergence: (is_perspective && random.below(2) == 0).then(|| length(random).into()),
            layout: *random.pick(&[StereoLayout::SideBySide, StereoLayout::TopBottom]),
        });
    }
    if !is_perspective {
        return (camera, None);
    }
    if random.below(3) == 0 {
        camera.focal_length = Some(length(random).into());
        camera.sensor_width = length(random).into();
    } else {
        let axes = [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Diagonal, FovAxis::Smaller, FovAxis::Larger];
        camera.fov = fov.into();
        camera.fov_axis = *random.pick(&axes);
    }
    let blades = [0u32, 3, 5, 64][random.below(4)];
    let lens = (random.below(2) == 0).then(|| ThinLens {
        focus: match random.below(2) {
            0 => Focus::Distance(length(random)).into(),
            // The camera stands far away along x and looks back.
            _ => Focus::On([number(random, -5.0, 5.0), 1.0, -2.0]).into(),
        },
        blades: blades.into(),
        // A disc is not turned.
        rotation: if blades == 0 { 0.0.into() } else { number(random, -400.0, 400.0).into() },
        tilt: if random.below(2) == 0 { [0.0; 2].into() } else { [number(random, -20.0, 20.0), 3.0].into() },
        ..ThinLens::new(number(random, 0.0, 10.0), 1.0)
    });
    (camera, lens)
}

pub fn scene(random: &mut Random) -> SceneDesc {
    let names: Vec<Arc<str>> = (0..random.below(4)).map(|index| format!("{index}{}", text(random)).into()).collect();
    let material_ref = |random: &mut Random| match random.below(3) {
        0 if !names.is_empty() => MaterialRef::Named { name: Arc::clone(random.pick(&names)), span: Span::NONE },
        1 => MaterialRef::Inline(Box::new(material(random).into())),
        _ => MaterialRef::Default,
    };
    let mut objects = Vec::new();
    for _ in 0..1 + random.below(5) {
        let material = material_ref(random);
        let placements = match random.below(4) {
            0 => Placements::One,
            1 => Placements::from(PathBuf::from(text(random))),
            2 => Placements::from(Spanned::from(pattern(random))),
            _ => (0..1 + random.below(3)).map(|_| transforms(random)).collect(),
        };
        let pair = |random: &mut Random| [number(random, -1e6, 1e6), number(random, -1e6, 1e6)];
        let mut object = match random.below(17) {
            16 => solid(random, placements, 2),
            15 => Object::HeightField(Box::new(HeightField {
                file: PathBuf::from(text(random)).into(),
                size: [(); 3].map(|()| length(random)).into(),
                center: vector(random).into(),
                smooth: random.below(2) == 0,
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            13 => Object::Torus(Box::new(Torus {
                center: vector(random).into(),
                axis: [0.3, number(random, -1.0, 1.0), 0.0].into(),
                radius: length(random).into(),
                tube_radius: length(random).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            14 => Object::Arrow(Box::new(Arrow {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                head_radius: if random.below(2) == 0 { None } else { Some(length(random).into()) },
                head_length: if random.below(2) == 0 { None } else { Some(length(random).into()) },
                segments: (3 + random.below(4094) as u32).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            12 => Object::Tube(Box::new(Tube {
                points: PathPoints((0..2 + random.below(3)).map(|_| vector(random)).collect()).into(),
                radius: match random.below(2) {
                    0 => Radii::All(length(random)),
                    _ => Radii::Each((0..2 + random.below(3)).map(|_| length(random)).collect()),
                }
                .into(),
                curve: *random.pick(&[TubeCurve::Linear, TubeCurve::CatmullRom, TubeCurve::Bezier]),
                closed: random.below(2) == 0,
                segments: (3 + random.below(4094) as u32).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            10 => Object::Extrude(Box::new(Extrude {
                outline: Outline(
                    (0..1 + random.below(3))
                        .map(|_| (0..3 + random.below(3)).map(|_| pair(random)).collect())
                        .collect(),
                )
                .into(),
                depth: length(random).into(),
                curve: *random.pick(&[Curve::Linear, Curve::CatmullRom]),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            11 => Object::Polygon(Box::new(Polygon {
                points: Corners((0..3 + random.below(3)).map(|_| vector(random)).collect()).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            9 => Object::Lathe(Box::new(Lathe {
                profile: Profile(
                    // Not so near to the axis that it is one with it.
                    (0..2 + random.below(4))
                        .map(|_| [number(random, 1e2, 1e6).max(1e2), number(random, -1e6, 1e6)])
                        .collect(),
                )
                .into(),
                curve: *random.pick(&[Curve::Linear, Curve::CatmullRom]),
                segments: (3 + random.below(4094) as u32).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            0 | 1 => Object::Sphere(Box::new(Sphere {
                center: vector(random).into(),
                radius: length(random).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            5 if random.below(3) == 0 => Object::Plane(Box::new(Plane {
                point: vector(random).into(),
                normal: [0.3, number(random, -1.0, 1.0), 0.0].into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            5 => Object::Disk(Box::new(Disk {
                center: vector(random).into(),
                normal: [0.3, number(random, -1.0, 1.0), 0.0].into(),
                radius: length(random).into(),
                inner_radius: number(random, 0.0, 1.0).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            6 => Object::Cylinder(Box::new(Cylinder {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                caps: random.below(2) == 0,
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            7 => Object::Cone(Box::new(Cone {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                tip_radius: number(random, 0.0, 2.0).into(),
                caps: random.below(2) == 0,
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            8 => Object::Capsule(Box::new(Capsule {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            2 => Object::Rectangle(Box::new(Rectangle {
                center: vector(random).into(),
                normal: [0.3, number(random, -1.0, 1.0), 0.0].into(),
                size: PerAxis([length(random), length(random)]).into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            3 => Object::Box(Box::new(RectBox {
                center: vector(random).into(),
                size: PerAxis(if random.below(2) == 0 { [length(random); 3] } else { [1.0, length(random), 2.0] })
                    .into(),
                rounding: if random.below(2) == 0 { 0.0 } else { 1e-3 }.into(),
                material,
                transform: transforms(random),
                placements,
                camera_visible: random.below(4) != 0,
                name: name(random),
            })),
            _ => {
                let of_file = random.below(2) == 0;
                Object::from(Mesh {
                    source: match of_file {
                        true => MeshSource::File(PathBuf::from(text(random)).into()),
                        false => inline_mesh(random),
                    },
                    part: Part::from((of_file && random.below(2) == 0).then(|| text(random))),
                    material,
                    transform: transforms(random),
                    placements,
                    instances: *random.pick(&[Instances::Auto, Instances::Always, Instances::Never]),
                    shading: *random.pick(&[Shading::Auto, Shading::Smooth, Shading::Flat]),
                    camera_visible: random.below(4) != 0,
                    name: name(random),
                })
            }
        };
        // What crosses itself is no outline; three points do not, joined by straight lines.
        match &mut object {
            Object::Extrude(extrude) if extrude.crossing().is_some() => {
                extrude.outline.value.0.truncate(1);
                extrude.outline.value.0[0].truncate(3);
                extrude.curve = Curve::Linear;
            }
            Object::Polygon(polygon) if polygon.points.value.fault(Span::NONE).is_some() => {
                polygon.points.value.0.truncate(3);
                if polygon.points.value.fault(Span::NONE).is_some() {
                    polygon.points.value.0 = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
                }
            }
            _ => {}
        }
        // Numbers that do not go together are no scene, nor are curved sides that shine.
        let curved = matches!(object.kind(), "Plane" | "Disk" | "Cylinder" | "Cone" | "Capsule");
        let dull = matches!(object.material(), MaterialRef::Inline(m) if !matches!(m.value, Material::Emissive(_)));
        if curved && !dull {
            *object.material_mut() = MaterialRef::Default;
        }
        if object.faults(Span::NONE).is_empty() {
            objects.push(object.into());
        }
    }
    if objects.is_empty() {
        let sphere = Sphere {
            center: vector(random).into(),
            radius: length(random).into(),
            material: MaterialRef::Default,
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        };
        objects.push(Object::Sphere(Box::new(sphere)).into());
    }
    grouped(random, &mut objects);
    let defaults = SceneDesc::default();
    let (seen, lens) = view(random);
    let mut camera =
        Camera { position: [1e7, number(random, -1.0, 1.0), 0.0].into(), look_at: vector(random).into(), ..seen };
    if random.below(3) == 0 {
        camera.stand_by(camera.rows());
    }
    let named = NamedCamera { name: "front".to_owned().into(), camera: camera.clone() };
    let cameras = if random.below(3) == 0 { vec![named] } else { Vec::new() };
    let camera_name = cameras.first().map(|named| std::sync::Arc::clone(&named.name.value));
    let mut materials: Vec<NamedMaterial> =
        names.iter().map(|name| NamedMaterial { name: name.clone().into(), material: material(random) }).collect();
    let textures = named_textures(random, &mut materials, &mut objects);
    SceneDesc {
        textures,
        camera,
        camera_name,
        cameras,
        image: Image { width: (1 + random.below(65536) as u32).into(), ..Image::default() },
        render: Render {
            seed: (random.next() as u32).into(),
            noise: (random.below(2) == 0).then(|| number(random, 0.001, 0.9).into()),
            time: (random.below(2) == 0).then(|| length(random).into()),
            acceleration: *random.pick(&[Acceleration::Bvh, Acceleration::BoundingBox, Acceleration::None]),
            integrator: match random.below(5) {
                0 => Integrator::Path,
                1 => Integrator::Direct,
                2 => Integrator::AmbientOcclusion { distance: None },
                3 => Integrator::AmbientOcclusion { distance: Some(2.5.into()) },
                _ => Integrator::Full,
            },
            ..Render::default()
        },
        effects: Effects {
            antialiasing: match random.below(4) {
                0 => PixelFilter::None,
                1 => PixelFilter::Box,
                2 => PixelFilter::Gaussian { sigma: number(random, 0.0, 3.0).into() },
                _ => PixelFilter::BlackmanHarris { radius: number(random, 0.5, 3.0).into() },
            },
            depth_of_field: lens,
            exposure: number(random, -5.0, 5.0).into(),
            tone_map: *random.pick(&[ToneMap::None, ToneMap::Filmic, ToneMap::AgX]),
        },
        output: Output {
            layers: (0..random.below(3)).map(|_| *random.pick(&[Layer::Albedo, Layer::Depth])).collect(),
            alpha: false,
            backdrop: if random.below(2) == 0 { None } else { Some([random.unit(), 0.25, 1.0].into()) },
            cryptomatte: (0..random.below(3)).map(|_| *random.pick(&[Matte::Objects, Matte::Materials])).collect(),
            masks: objects.iter().filter_map(|object| object.value.name().as_str()).take(2).map(mask).collect(),
            light_groups: random.below(2) == 0,
            marks: (0..random.below(3)).map(|k| mark(k, random)).collect(),
        },
        background: match random.below(3) {
            0 => Background::Environment(Box::new(Environment {
                file: std::sync::Arc::<std::path::Path>::from(PathBuf::from(text(random))).into(),
                scale: share(random),
                rotation: number(random, -400.0, 400.0),
                up: [1.0, number(random, -1.0, 1.0), 0.0].into(),
                camera_visible: random.below(2) == 0,
                group: light_group(random),
            })),
            _ => share(random).into(),
        },
        lights: (0..random.below(3)).map(|_| sphere_light(random).into()).collect(),
        materials,
        objects,
        ..defaults
    }
}

fn mask(name: &str) -> Spanned<MaskName> {
    MaskName(name.to_owned()).into()
}

fn mark(k: usize, random: &mut Random) -> Mark {
    Mark { name: format!("{k}{}", text(random)).into(), point: vector(random).into() }
}

/// A scene without the texts it came from.
pub fn plain(scene: SceneDesc) -> SceneDesc {
    let mut materials = scene.materials;
    materials.sort_by(|a, b| a.name.value.cmp(&b.name.value));
    let mut textures = scene.textures;
    textures.sort_by(|a, b| a.name.value.cmp(&b.name.value));
    let mut cameras = scene.cameras;
    cameras.sort_by(|a, b| a.name.value.cmp(&b.name.value));
    // Who reads only what stands there knows of no other time.
    let moments = Default::default();
    SceneDesc { textures, cameras, sources: Vec::new(), base_dir: PathBuf::new(), materials, moments, ..scene }
}
