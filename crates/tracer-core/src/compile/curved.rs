//! Objects with curved sides, and planes: spheres, and those that are a unit shape under an affine map (see
//! [`tracer_kernels::shapes`]).

use super::assets::Sources;
use super::materials::MaterialBuilder;
use super::placing::{Given, Maps, Subject, check, place_all, sides};
use super::settled::Settled;
use glam::{DAffine3, DMat3, DVec3};
use scene_format::codes;
use scene_format::desc::{
    Capsule, Cone, Cylinder, Disk, Emissive, Material, MaterialRef, Object, Plane, Radiometric, Torus, Vec3,
    cannot_shine,
};
use scene_format::diagnostic::Spanned;
use scene_format::{Diagnostic, Diagnostics, SceneDesc};
use std::sync::Arc;
use tracer_kernels::scene::{CurvedLight, Frame, NONE, Shape, Sphere};
use tracer_kernels::shapes::UnitShape;
use tracer_mesh::shapes::of_object;

/// An object with curved sides, as it is written.
pub(super) struct Written {
    pub(super) unit: UnitShape,
    /// From object space to where it is before its transforms.
    pub(super) local: DAffine3,
    pub(super) noun: &'static str,
}

impl Written {
    /// What steps ask of it.
    pub fn with_subject<T>(&self, then: impl FnOnce(&Subject<'_>) -> T) -> T {
        let Written { unit, local, noun } = self;
        let reach = |map: &DAffine3, axis: usize| unit.bounds(&(*map * *local)).map(|corner| corner[axis]);
        then(&Subject { noun, local: *local, middle: Some(local.translation), reach: &reach })
    }
}

/// The shape of an object with curved sides.
pub(super) fn written(object: &Object) -> Option<Written> {
    match object {
        Object::Sphere(sphere) => {
            let matrix3 = DMat3::from_diagonal(DVec3::splat(sphere.radius.value));
            let local = DAffine3 { matrix3, translation: DVec3::from(sphere.center.value) };
            Some(Written { unit: UnitShape::Sphere, local, noun: "sphere" })
        }
        Object::Plane(plane) => Some(of_plane(plane)),
        Object::Disk(disk) => Some(of_disk(disk)),
        Object::Cylinder(cylinder) => Some(of_cylinder(cylinder)),
        Object::Cone(cone) => Some(of_cone(cone)),
        Object::Capsule(capsule) => Some(of_capsule(capsule)),
        Object::Torus(torus) => Some(of_torus(torus)),
        _ => None,
    }
}

fn of_plane(plane: &Plane) -> Written {
    let [right, up, normal] = sides(DVec3::from(plane.normal.value));
    let local = DAffine3 { matrix3: DMat3::from_cols(right, up, normal), translation: DVec3::from(plane.point.value) };
    Written { unit: UnitShape::Plane, local, noun: "plane" }
}

fn of_disk(disk: &Disk) -> Written {
    let [right, up, normal] = sides(DVec3::from(disk.normal.value));
    let matrix3 = DMat3::from_cols(right, up, normal) * disk.radius.value;
    let inner = disk.inner_radius.value / disk.radius.value;
    let local = DAffine3 { matrix3, translation: DVec3::from(disk.center.value) };
    Written { unit: UnitShape::Disk { inner }, local, noun: "disk" }
}

/// Half the way from one end to the other, and the frame about it: right and up as they are on a disk that faces that
/// way.
struct Axis {
    middle: DVec3,
    half: f64,
    frame: [DVec3; 3],
    upright: bool,
}

fn axis(from: &Spanned<Vec3>, to: &Spanned<Vec3>) -> Axis {
    let [a, b] = [from, to].map(|p| DVec3::from(p.value));
    let half = 0.5 * (b - a).length();
    let along = if half > 0.0 { b - a } else { DVec3::Y };
    let frame = sides(along);
    Axis { middle: 0.5 * (a + b), half, frame, upright: frame[2].y.abs() > 0.9999 }
}

impl Axis {
    /// The map that takes x and y to so much across, z to so much along.
    fn map(&self, across: f64, along: f64) -> DAffine3 {
        let [right, up, axis] = self.frame;
        DAffine3 { matrix3: DMat3::from_cols(right * across, up * across, axis * along), translation: self.middle }
    }
}

fn of_cylinder(cylinder: &Cylinder) -> Written {
    let axis = axis(&cylinder.from, &cylinder.to);
    let unit = UnitShape::Cone { radii: [1.0; 2], caps: cylinder.caps, upright: axis.upright };
    Written { unit, local: axis.map(cylinder.radius.value, axis.half), noun: "cylinder" }
}

fn of_cone(cone: &Cone) -> Written {
    let axis = axis(&cone.from, &cone.to);
    let radii = [cone.radius.value, cone.tip_radius.value];
    let most = radii[0].max(radii[1]);
    let unit = UnitShape::Cone { radii: radii.map(|r| r / most), caps: cone.caps, upright: axis.upright };
    Written { unit, local: axis.map(most, axis.half), noun: "cone" }
}

fn of_capsule(capsule: &Capsule) -> Written {
    let axis = axis(&capsule.from, &capsule.to);
    let radius = capsule.radius.value;
    let unit = UnitShape::Capsule { half: axis.half / radius };
    Written { unit, local: axis.map(radius, radius), noun: "capsule" }
}

fn of_torus(torus: &Torus) -> Written {
    let [right, up, axis] = sides(DVec3::from(torus.axis.value));
    let radius = torus.radius.value;
    let matrix3 = DMat3::from_cols(right, up, axis) * radius;
    let unit = UnitShape::Torus { tube: torus.tube_radius.value / radius };
    Written { unit, local: DAffine3 { matrix3, translation: DVec3::from(torus.center.value) }, noun: "torus" }
}

/// An object with curved sides in the scene.
pub struct Curved {
    /// Its place among the objects of the scene.
    pub number: u32,
    /// What it is in its object space.
    pub unit: UnitShape,
    /// From there to the world, one per copy.
    pub maps: Maps,
    /// From there to where it is before its transforms; `None` where it has none, and no copies.
    local: Option<Box<DAffine3>>,
    /// Index of its material.
    pub material: u32,
    /// How it shines, where it does.
    pub emissive: Option<Arc<Emissive>>,
}

/// Finds the objects with curved sides, and their materials, in order.
pub fn load(
    desc: &SceneDesc,
    sources: &Sources<'_>,
    builder: &mut MaterialBuilder,
    diagnostics: &mut Diagnostics,
) -> Vec<Curved> {
    let mut all = Vec::new();
    for (number, object) in (0..).zip(&desc.objects) {
        let Some(Written { unit, local, noun }) = written(&object.value) else { continue };
        let (transform, placements) = (object.value.transform(), object.value.placements());
        let material = builder.resolve(object.value.material(), number, diagnostics);
        let mut emissive = builder.emissive(material).cloned();
        let faults = object.value.faults(object.span);
        if !faults.is_empty() {
            diagnostics.extend(faults);
            // A placements file is read even when something else is wrong: all faults in one run.
            let given = Given { desc, sources, settled: &Settled::default() };
            place_all(given, transform, placements, &Subject::unknown(noun), diagnostics);
            continue;
        }
        let plain = transform.is_empty() && matches!(placements, scene_format::desc::Placements::One);
        if emissive.is_some() && unit.is_endless() {
            let span = match object.value.material() {
                MaterialRef::Inline(material) => material.span,
                MaterialRef::Named { span, .. } => *span,
                MaterialRef::Default => object.span,
            };
            diagnostics.push(cannot_shine(&format!("a {noun}"), span));
            emissive = None;
        }
        let local = (!plain).then(|| Box::new(local));
        all.push(Curved { number, unit, maps: Maps::new(), local, material, emissive });
    }
    all
}

/// Finds where they are.
pub fn place(given: Given<'_>, all: &mut [Curved], diagnostics: &mut Diagnostics) {
    for curved in all {
        let object = &given.desc.objects[curved.number as usize];
        let Some(written) = written(&object.value) else { continue };
        let (transform, placements) = (object.value.transform(), object.value.placements());
        curved.maps = written.with_subject(|subject| place_all(given, transform, placements, subject, diagnostics));
        check(&curved.maps, transform.first().map_or(object.span, |t| t.span), written.noun, diagnostics);
    }
}

/// The unit normal of a plane, and its point that is nearest to one.
pub(super) fn equation(map: &DAffine3, point: DVec3) -> (DVec3, DVec3) {
    let normal = (map.matrix3.inverse().transpose() * DVec3::Z).normalize();
    (normal, point - normal * normal.dot(point - map.translation))
}

/// Whether a map keeps all angles (up to rounding): it turns, moves and scales.
pub(super) fn is_similar(map: &DAffine3) -> bool {
    let m = map.matrix3;
    let (x, y, z) = (m.x_axis.length(), m.y_axis.length(), m.z_axis.length());
    let off = m.x_axis.dot(m.y_axis).abs().max(m.y_axis.dot(m.z_axis).abs()).max(m.z_axis.dot(m.x_axis).abs());
    let near = |a: f64| (a - x).abs() <= 1e-12 * x;
    near(y) && near(z) && off <= 1e-12 * x * x
}

impl Curved {
    /// Centre and radius of a copy that stays a sphere: nothing has turned it, or it shines evenly, and how it is
    /// turned does not show.
    fn ball(&self, map: &DAffine3) -> Option<(DVec3, f64)> {
        let m = map.matrix3;
        let upright = m == DMat3::from_diagonal(DVec3::splat(m.x_axis.x)) && m.x_axis.x > 0.0;
        let is_even = self.emissive.as_ref().is_some_and(|emissive| emissive.texture().is_none());
        let ball = self.unit == UnitShape::Sphere && (upright || is_even && is_similar(map));
        ball.then(|| (map.translation, if upright { m.x_axis.x } else { m.x_axis.length() }))
    }

    /// One point per copy near what the camera looks at, on its surface or in its box; of many copies of every so many,
    /// 1024 at most.
    pub fn marks(&self, look_at: DVec3) -> impl Iterator<Item = DVec3> {
        self.maps.iter().step_by(self.maps.len().div_ceil(1024).max(1)).map(move |map| match self.ball(map) {
            Some((center, radius)) => center + (look_at - center).try_normalize().unwrap_or(DVec3::Z) * radius,
            None if self.unit.is_endless() => equation(map, look_at).1,
            None => {
                let [low, high] = self.unit.bounds(map);
                look_at.clamp(low, high)
            }
        })
    }

    /// Whether it has no end.
    pub fn is_endless(&self) -> bool {
        self.unit.is_endless()
    }

    /// What its copies shine, in the scene's own unit; none where it does not. L = P / (pi A), A the true area of a
    /// copy, of both sides where it has two. L = I / A of disks, 4 I / A of spheres.
    pub fn radiances(&self) -> Vec<[f64; 3]> {
        let Some(emissive) = &self.emissive else { return Vec::new() };
        let pi = std::f64::consts::PI;
        let sides = if emissive.two_sided { 2.0 } else { 1.0 };
        let amount = emissive.radiometric();
        let area = |map: &DAffine3| match self.ball(map) {
            Some((_, radius)) => 4.0 * pi * radius * radius,
            None => self.unit.area(map),
        };
        let radiance = |map: &DAffine3| match amount {
            Radiometric::Radiance(radiance) => radiance,
            Radiometric::Intensity(intensity) => {
                // What a convex body shows is a fourth of its surface, on average (Cauchy); of a flat one its face.
                let shown = if self.unit == UnitShape::Sphere { 0.25 } else { 1.0 } * area(map);
                intensity.map(|x| x / shown)
            }
            Radiometric::Power(power) => power.map(|x| x / (pi * area(map) * sides)),
        };
        self.maps.iter().map(radiance).collect()
    }

    /// Adds its copies to the spheres and shapes of the scene. `light` makes a light of a radiance for a sphere and
    /// says its index; those of shapes are added to `lamps`, in the order of the shapes. `written`, where a pattern
    /// asks for it: from the coordinates that things are written in to the world, the first the world's own.
    pub fn build(
        &self,
        frame: &Frame,
        light: &mut dyn FnMut([f64; 3], bool) -> u32,
        spheres: &mut Vec<Sphere>,
        (shapes, lamps): (&mut Vec<Shape>, &mut Vec<CurvedLight>),
        mut written: Option<&mut Vec<DAffine3>>,
    ) {
        let radiances = self.radiances();
        let from_written = self.local.as_ref().map(|local| local.inverse());
        for (copy, map) in (0..).zip(&self.maps) {
            let mut coordinates = 0;
            if let (Some(written), Some(from_written)) = (written.as_mut(), &from_written) {
                coordinates = written.len() as u32;
                written.push(*map * *from_written);
            }
            let (material, object) = (self.material, self.number);
            let two_sided = self.emissive.as_ref().is_some_and(|emissive| emissive.two_sided);
            if let Some((center, radius)) = self.ball(map) {
                let light = radiances.get(copy as usize).map_or(NONE, |&radiance| light(radiance, two_sided));
                let (center, radius) = (frame.point(center), frame.length(radius));
                spheres.push(Sphere { center, radius, material, object, copy, light, coordinates });
            } else {
                let placement =
                    DAffine3 { matrix3: map.matrix3 * frame.scale, translation: frame.point(map.translation) };
                let (unit, shape) = (self.unit, shapes.len() as u32);
                let mut light = NONE;
                if let Some(&radiance) = radiances.get(copy as usize) {
                    light = lamps.len() as u32;
                    lamps.push(CurvedLight { shape, unit, placement, radiance, two_sided, offset: 0.0 });
                }
                let is_plain = self.local.is_none();
                shapes.push(Shape { unit, placement, material, light, object, copy, is_plain, coordinates });
            }
        }
    }
}

/// Warns of glass that has no inside.
pub fn warn_of_open_glass(desc: &SceneDesc, diagnostics: &mut Diagnostics) {
    for object in &desc.objects {
        let named = |name: &str| desc.materials.iter().find(|m| &*m.name.value == name).map(|m| &m.material);
        let material = match object.value.material() {
            MaterialRef::Default => None,
            MaterialRef::Named { name, .. } => named(name),
            MaterialRef::Inline(material) => Some(&material.value),
        };
        let Some(Material::Transparent { .. }) = material else { continue };
        let open = match (written(&object.value), of_object(&object.value)) {
            (Some(Written { unit: unit @ UnitShape::Disk { .. }, noun, .. }), _) if !unit.is_closed() => {
                Some((noun, "a pane of glass is a thin `Cylinder`"))
            }
            (Some(Written { unit: UnitShape::Plane, noun, .. }), _) => {
                Some((noun, "water is a large and deep `Box`, a pane of glass a flat one"))
            }
            (Some(Written { unit, noun, .. }), _) if !unit.is_closed() => Some((noun, "close it: `caps: true`")),
            (_, Some(shape)) if !shape.is_closed() => Some((shape.noun(), shape.way_to_close())),
            _ if matches!(object.value, Object::Rectangle(_)) => Some(("rectangle", "a pane of glass is a thin `Box`")),
            _ if matches!(object.value, Object::HeightField(_)) => Some(("height field", "")),
            _ => None,
        };
        if let Some((noun, hint)) = open {
            diagnostics.push(
                Diagnostic::warning(codes::OPEN_GLASS, object.span, format!("glass of an open {noun} has no inside"))
                    .expected("a closed shape: a ray is bent by glass on its way in, and back on its way out")
                    .hint(hint),
            );
        }
    }
}
