//! Curved shapes that are no spheres, and planes (see [`crate::shapes`]).

use crate::shapes::{Row, UnitShape};
use glam::{DAffine3, DVec3};

/// A curved shape or a plane in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// What it is in its object space.
    pub unit: UnitShape,
    /// From there to render space.
    pub placement: DAffine3,
    /// Index into `Scene::materials`.
    pub material: u32,
    /// Its light in `Scene::lights`, or [`NONE`](super::NONE).
    pub light: u32,
    /// Its object's place in the scene.
    pub object: u32,
    /// Which coordinates it is written in, where a pattern asks (`Scene::to_object`); 0 the world's.
    pub coordinates: u32,
}

impl Shape {
    /// Its exact box; of planes it has no end.
    pub fn bounds(&self) -> [DVec3; 2] {
        self.unit.bounds(&self.placement)
    }

    /// What the tree needs to know of it. A hit's point is off by the roundings of t and of the ray's origin and
    /// direction, some 2^-23 of the coordinates on its way; 2^-19 of those of the shape leaves room, and what the
    /// origin's size adds is the tree's to pad.
    pub fn geometry(&self) -> crate::bvh::ShapeGeometry {
        let [lower, upper] = self.bounds();
        let pad = DVec3::splat(lower.abs().max(upper.abs()).max_element() / 524_288.0);
        crate::bvh::ShapeGeometry {
            row: Row::new(&self.unit, &self.placement),
            lower: (lower - pad).as_vec3().to_array(),
            upper: (upper + pad).as_vec3().to_array(),
        }
    }
}

/// Shapes as the engine reads them: index = primitive id less the number of spheres.
#[derive(Default)]
pub struct ShapeTable {
    /// How rays meet them.
    pub rows: Vec<Row>,
    /// Their materials.
    pub material: Vec<u32>,
    /// Their lights + 1, or 0; empty where none shines.
    pub light: Vec<u32>,
}

impl ShapeTable {
    /// Of the shapes, in their order.
    pub fn new(shapes: &[Shape]) -> Self {
        let shines = shapes.iter().any(|shape| shape.light != super::NONE);
        let lights = shapes.iter().filter(|_| shines).map(|shape| shape.light.wrapping_add(1));
        ShapeTable {
            rows: shapes.iter().map(|shape| Row::new(&shape.unit, &shape.placement)).collect(),
            material: shapes.iter().map(|shape| shape.material).collect(),
            light: lights.collect(),
        }
    }
}
