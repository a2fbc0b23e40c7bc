//! How what camera rays hit moves in the picture while the shutter is open.

use super::{Camera, Instance, Mesh, Projection, Scene, Shape, Solids, Sphere, Triangles};
use crate::shapes::UnitShape;
use glam::{DAffine3, DMat3, DVec3};
use std::sync::Arc;

/// A scene in which something moves, as the shutter opens and as it closes. Render space is the same at all times.
pub struct Ends {
    /// As it opens, and as it closes.
    pub scenes: [End; 2],
    /// Which part of a frame the shutter is open.
    pub shutter: f64,
}

/// What of a scene tells where its things are.
pub struct End {
    camera: Camera,
    spheres: Arc<Vec<Sphere>>,
    shapes: Arc<Vec<Shape>>,
    solids: Arc<Solids>,
    meshes: Arc<Vec<Mesh>>,
    triangles: Arc<Triangles>,
    instances: Arc<Vec<Instance>>,
    /// Which copy of which object each sphere and shape is, and its body; in this order.
    places: Vec<[u32; 3]>,
}

/// A sphere or a curved shape: what it is, where, and whether it is where its own fields put it, by no transform.
type Placed = (UnitShape, DAffine3, bool);

impl End {
    /// Of a scene.
    pub fn new(scene: &Scene) -> Self {
        let spheres = scene.spheres.iter().map(|sphere| [sphere.object, sphere.copy]);
        let shapes = scene.shapes.iter().map(|shape| [shape.object, shape.copy]);
        let all = spheres.chain(shapes);
        let mut places: Vec<[u32; 3]> = (0..).zip(all).map(|(body, [object, copy])| [object, copy, body]).collect();
        places.sort_unstable();
        End {
            camera: scene.camera,
            spheres: Arc::clone(&scene.spheres),
            shapes: Arc::clone(&scene.shapes),
            solids: Arc::clone(&scene.solids),
            meshes: Arc::clone(&scene.meshes),
            triangles: Arc::clone(&scene.triangles),
            instances: Arc::clone(&scene.instances),
            places,
        }
    }

    /// The body of a copy of an object that is a sphere or a shape.
    fn body(&self, object: u32, copy: u32) -> Option<usize> {
        let at = self.places.partition_point(|place| place[..2] < [object, copy][..]);
        self.places.get(at).filter(|place| place[..2] == [object, copy]).map(|place| place[2] as usize)
    }
}

impl Scene {
    /// How far what a camera ray from `origin` hits at `point` moves in the picture within a frame: in pixels to the
    /// right and downwards, as fast as it does on average while the shutter is open. `body`, `primitive`: as
    /// [`Surface`](crate::engine::Surface) has them. Zero where nothing moves, where it is not there all the time that
    /// the shutter is open, and where the picture does not show it at both ends.
    pub fn motion(&self, body: u32, primitive: u32, origin: DVec3, point: DVec3) -> [f64; 2] {
        let Some(ends) = &self.ends else { return [0.0; 2] };
        let side = if self.camera.stereo.is_some() { self.camera.side_of(origin, point) } else { 0.0 };
        let place = |end: &End| {
            let then = match (body as usize).checked_sub(self.spheres.len() + self.shapes.len()) {
                Some(instance) if instance < self.instances.len() => self.on_mesh(end, instance, primitive, point)?,
                Some(behind) => self.on_operand(end, behind - self.instances.len(), point)?,
                None => self.on_curved(end, body as usize, point)?,
            };
            end.camera.sees(side, then).in_whole
        };
        let [open, close] = &ends.scenes;
        let (Some(from), Some(to)) = (place(open), place(close)) else { return [0.0; 2] };
        let [width, height] = self.size.map(f64::from);
        let mut across = to[0] - from[0];
        // What passes behind the eye of a panorama goes the short way round.
        if let Projection::Panorama = self.camera.projection {
            let around = self.camera.stereo.map_or(2.0, |stereo| if stereo.above { 2.0 } else { 1.0 });
            across -= around * (across / around).round();
        }
        [across * 0.5 * width / ends.shutter, (from[1] - to[1]) * 0.5 * height / ends.shutter]
    }

    /// Where a point of a sphere or shape is then.
    fn on_curved(&self, end: &End, body: usize, point: DVec3) -> Option<DVec3> {
        let [object, copy] = match self.spheres.get(body) {
            Some(sphere) => [sphere.object, sphere.copy],
            None => self.shapes.get(body - self.spheres.len()).map(|shape| [shape.object, shape.copy])?,
        };
        let now = placed(&self.spheres, &self.shapes, body)?;
        let then = placed(&end.spheres, &end.shapes, end.body(object, copy)?)?;
        carried(&now, &then, point)
    }

    /// Where a point of a solid's operand is then.
    fn on_operand(&self, end: &End, operand: usize, point: DVec3) -> Option<DVec3> {
        // Solids lie behind all other shapes but those without an end, and their operands in their order.
        let is_before = |shape: &Shape| match shape.unit {
            UnitShape::Solid(solid) => (solid.operands[0] + solid.operands[1]) as usize <= operand,
            _ => !shape.unit.is_endless(),
        };
        let shape = self.shapes.get(self.shapes.partition_point(is_before))?;
        let then = end.shapes.get(end.body(shape.object, shape.copy)?.checked_sub(end.spheres.len())?)?;
        let (UnitShape::Solid(solid), UnitShape::Solid(solid_then)) = (shape.unit, then.unit) else { return None };
        let within = operand.checked_sub(solid.operands[0] as usize)?;
        if solid.operands[1] != solid_then.operands[1] {
            return None;
        }
        let now = self.solids.operands.get(operand)?;
        let then = end.solids.operands.get(solid_then.operands[0] as usize + within)?;
        carried(&(now.unit, now.placement, false), &(then.unit, then.placement, false), point)
    }

    /// Where a point of a triangle of a copy of a mesh is then. Copies are counted within their object.
    fn on_mesh(&self, end: &End, instance: usize, primitive: u32, point: DVec3) -> Option<DVec3> {
        let now = self.instances.get(instance)?;
        let copies = |instances: &[Instance]| {
            let first = instances.partition_point(|other| other.object < now.object);
            (first, instances[first..].partition_point(|other| other.object <= now.object))
        };
        let ((first, count), (first_then, count_then)) = (copies(&self.instances), copies(&end.instances));
        let then = end.instances.get(first_then + instance.checked_sub(first)?)?;
        let (mesh, mesh_then) = (self.meshes.get(now.mesh as usize)?, end.meshes.get(then.mesh as usize)?);
        if count != count_then || mesh.triangle_count != mesh_then.triangle_count {
            return None;
        }
        let triangle = primitive.checked_sub(self.tables.loose())?;
        let [a, b, c] = corners(&self.triangles, now, triangle)?;
        let across = (b - a).cross(c - a);
        let square = across.length_squared();
        let corners_then =
            corners(&end.triangles, then, triangle.checked_sub(mesh.first_triangle)? + mesh_then.first_triangle)?;
        let v = (point - a).cross(c - a).dot(across) / square;
        let w = (b - a).cross(point - a).dot(across) / square;
        let [a, b, c] = corners_then;
        (square > 0.0).then(|| a + v * (b - a) + w * (c - a))
    }
}

fn placed(spheres: &[Sphere], shapes: &[Shape], body: usize) -> Option<Placed> {
    if let Some(sphere) = spheres.get(body) {
        let matrix3 = DMat3::from_diagonal(DVec3::splat(sphere.radius));
        return Some((UnitShape::Sphere, DAffine3 { matrix3, translation: sphere.center }, false));
    }
    shapes.get(body - spheres.len()).map(|shape| (shape.unit, shape.placement, shape.is_plain))
}

/// A point of a shape when the shape is another one of its kind, at another place; `None` where it is of another kind.
fn carried(now: &Placed, then: &Placed, point: DVec3) -> Option<DVec3> {
    let mut own = now.1.inverse().transform_point3(point);
    match (now.0, then.0) {
        (UnitShape::Capsule { half }, UnitShape::Capsule { half: half_then }) => own.z *= half_then / half,
        (now, then) if std::mem::discriminant(&now) != std::mem::discriminant(&then) => return None,
        _ => {}
    }
    let is_round = matches!(
        now.0,
        UnitShape::Cone { .. } | UnitShape::Capsule { .. } | UnitShape::Torus { .. } | UnitShape::Disk { .. }
    );
    // What is round and written by its ends or its normal does not turn about its axis, though its coordinates may:
    // they jump where the axis passes the vertical.
    if is_round && now.2 && then.2 {
        let ([ax, ay], [bx, by]) = ([0, 1].map(|k| now.1.matrix3.col(k)), [0, 1].map(|k| then.1.matrix3.col(k)));
        let turn = libm::atan2(ax.dot(by) - ay.dot(bx), ax.dot(bx) + ay.dot(by));
        own = DMat3::from_cols_array(&[
            libm::cos(turn),
            libm::sin(turn),
            0.0,
            -libm::sin(turn),
            libm::cos(turn),
            0.0,
            0.0,
            0.0,
            1.0,
        ]) * own;
    }
    Some(then.1.transform_point3(own))
}

/// The corners of a triangle in render space.
fn corners(triangles: &Triangles, instance: &Instance, triangle: u32) -> Option<[DVec3; 3]> {
    let corners = triangles.corners(triangle)?;
    let Some(rows) = instance.placement else { return Some(corners) };
    let placed = |p: DVec3| {
        DVec3::from(rows.map(|[x, y, z, at]| DVec3::new(x.into(), y.into(), z.into()).dot(p) + f64::from(at)))
    };
    Some(corners.map(placed))
}

impl Camera {
    /// Which of two eyes a ray from `origin` through `point` belongs to: the one that is nearer to its line.
    fn side_of(&self, origin: DVec3, point: DVec3) -> f64 {
        let way = (point - origin).normalize_or_zero();
        let distance = |side: f64| (self.sees(side, point).of_eye.eye - origin).cross(way).length_squared();
        if distance(-1.0) <= distance(1.0) { -1.0 } else { 1.0 }
    }
}
