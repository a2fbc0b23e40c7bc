//! Objects and lamps that nobody sees, since a plane without an end is between them and the camera: light goes round
//! none.

use super::csg::SolidObject;
use super::curved::Curved;
use super::placed::Placed;
use super::polygonal::polygonal;
use super::unmeant::material_of;
use glam::{DAffine3, DVec3};
use scene_format::desc::{Light, Material, Projection};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::BTreeMap;
use tracer_kernels::shapes::UnitShape;

/// More copies of an object than this have marks for some of them only: no more is asked then.
const MOST_COPIES: usize = 1024;

/// More objects than this times the planes are not looked at.
const MOST_PAIRS: usize = 1_000_000;

/// Warns of them, of all together once for each plane.
pub fn warn(
    desc: &SceneDesc,
    placed: &Placed,
    (curved, solids): (&[Curved], &[SolidObject]),
    diagnostics: &mut Diagnostics,
) {
    // What moves may come out, and rays that start far from the camera may start behind.
    if desc.camera.shutter.value > 0.0 || desc.camera.near.is_some() || desc.camera.stereo.is_some() {
        return;
    }
    let materials: BTreeMap<&str, &Material> =
        desc.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    let is_wall = |object: &Curved| {
        let Some(written) = desc.objects.get(object.number as usize) else { return false };
        let material = material_of(&materials, written.value.material());
        object.unit == UnitShape::Plane && written.value.camera_visible() && !material.is_some_and(Material::transmits)
    };
    let walls = curved.iter().filter(|object| is_wall(object) && object.maps.len() == 1);
    for wall in walls.take(MOST_PAIRS / desc.objects.len().max(1)) {
        let Some(map) = wall.maps.first() else { continue };
        let Some(side) = Behind::of(desc, map) else { continue };
        let mut all: BTreeMap<Span, (String, bool)> = BTreeMap::new();
        let mut note = |number: u32, is_behind: bool| {
            let span = desc.objects.get(number as usize).map_or(Span::NONE, |object| object.span);
            all.entry(span).or_insert_with(|| (format!("objects[{number}]"), true)).1 &= is_behind;
        };
        for (k, object) in polygonal(desc).enumerate() {
            note(object.number, side.holds(placed.maps_of(k), placed.marks_of(k, side.far)));
        }
        for object in curved.iter().filter(|object| !object.is_endless()) {
            note(object.number, side.holds(&object.maps, object.marks(side.far)));
        }
        for solid in solids {
            note(solid.number(), side.holds(solid.maps(), solid.marks(side.far)));
        }
        for (index, light) in desc.lights.iter().enumerate() {
            let Light::SphereLight(sphere) = &light.value;
            let nearest = DVec3::from(sphere.center.value) + sphere.radius.value * side.normal;
            all.entry(light.span).or_insert_with(|| (format!("lights[{index}]"), true)).1 &=
                side.holds(&[DAffine3::IDENTITY], std::iter::once(nearest));
        }
        let hidden: Vec<(&Span, &String)> =
            all.iter().filter(|(_, (_, is_behind))| *is_behind).map(|(span, (name, _))| (span, name)).collect();
        diagnostics.extend(told(desc, wall, &hidden));
    }
}

/// The half of space that a plane hides from the camera.
struct Behind {
    center: DVec3,
    /// To the camera's side.
    normal: DVec3,
    /// Far away on that side.
    far: DVec3,
    /// What lies further behind than this is behind for sure.
    least: f64,
}

impl Behind {
    /// Behind the plane of a map; `None`: the camera is in it, or rays start on both sides.
    fn of(desc: &SceneDesc, map: &DAffine3) -> Option<Behind> {
        let normal = map.matrix3.x_axis.cross(map.matrix3.y_axis).try_normalize()?;
        let (center, eye) = (map.translation, DVec3::from(desc.camera.position.value));
        let height = normal.dot(eye - center);
        let size = center.abs().max_element() + eye.abs().max_element();
        let lens = desc.effects.depth_of_field.as_ref().map_or(0.0, |lens| lens.aperture.value);
        let flat = matches!(desc.camera.projection, Projection::Orthographic { .. });
        if flat || height.abs() <= lens + 1e-9 * size {
            return None;
        }
        let normal = normal * height.signum();
        Some(Behind { center, normal, far: center + 1e12 * (1.0 + size) * normal, least: 1e-9 * size })
    }

    /// Whether all copies lie behind, by a point of each that none of its others is in front of.
    fn holds(&self, copies: &[DAffine3], marks: impl Iterator<Item = DVec3>) -> bool {
        let mut any = false;
        let mut marks = marks.inspect(|_| any = true);
        let all = marks.all(|mark| self.normal.dot(mark - self.center) < -self.least);
        all && any && copies.len() <= MOST_COPIES
    }
}

fn told(desc: &SceneDesc, wall: &Curved, hidden: &[(&Span, &String)]) -> Option<Diagnostic> {
    let (&(span, name), more) = hidden.split_first()?;
    let others = match more.len() {
        0 => String::new(),
        1 => format!(", and so does {}", more[0].1),
        count => format!(", and so do {count} more"),
    };
    let message = format!("{name} lies wholly behind the plane objects[{}]{others}: nobody sees it", wall.number);
    let plane = desc.objects.get(wall.number as usize).map_or(Span::NONE, |object| object.span);
    Some(
        Diagnostic::warning(codes::BEHIND_PLANE, *span, message)
            .expected("objects and lamps on the camera's side of a plane, or in part there")
            .hint(
                "move it to the other side: y is up, and a ball that lies on a floor at 0 has its center at its radius",
            )
            .label(plane, "this plane has no end"),
    )
}
