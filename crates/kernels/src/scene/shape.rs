//! Curved shapes that are no spheres, and planes (see [`crate::shapes`]).

use crate::shapes::csg::{Operation, Part};
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
    /// Which of its object's copies it is.
    pub copy: u32,
    /// It is where its own fields put it, by no transform.
    pub is_plain: bool,
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

/// A shape that a solid is made of, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operand {
    /// What it is in its object space.
    pub unit: UnitShape,
    /// From there to render space.
    pub placement: DAffine3,
    /// Index into `Scene::materials`.
    pub material: u32,
    /// Its light in `Scene::lights`, or [`NONE`](super::NONE).
    pub light: u32,
    /// As [`Shape::coordinates`].
    pub coordinates: u32,
}

/// How a solid is made, in postfix order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// One of [`Solids::operands`].
    Operand(u32),
    /// Of the two before it.
    Operation(Operation),
}

/// What all solids of a scene are made of ([`crate::shapes::csg`]).
#[derive(Clone, Debug, Default)]
pub struct Solids {
    /// The shapes.
    pub operands: Vec<Operand>,
    /// How they are put together.
    pub steps: Vec<Step>,
    /// The same as rays are tested with it.
    pub parts: Vec<Part>,
}

/// An operand as the engine reads it.
pub struct OperandRow {
    /// Its own surface.
    pub row: Row,
    /// Its material.
    pub material: u32,
    /// Its light + 1, or 0.
    pub light: u32,
}

/// Shapes as the engine reads them: index = primitive id less the number of spheres.
#[derive(Default)]
pub struct ShapeTable {
    /// How rays meet them.
    pub rows: Vec<Row>,
    /// Their materials.
    pub material: Vec<u32>,
    /// Their lights + 1, or 0; empty where none shines, no operand either.
    pub light: Vec<u32>,
    /// The parts of all solids.
    pub parts: Vec<Part>,
    /// Their operands.
    pub operands: Vec<OperandRow>,
    /// The number of the first operand as a body (`Surface::body`): behind those of the instances.
    pub first_body: u32,
}

impl ShapeTable {
    /// Of the shapes, in their order. `first_body`: spheres, shapes and instances of the scene.
    pub fn new(shapes: &[Shape], solids: &Solids, first_body: u32) -> Self {
        let of = |operand: &Operand| OperandRow {
            row: Row::new(&operand.unit, &operand.placement),
            material: operand.material,
            light: operand.light.wrapping_add(1),
        };
        let shines = shapes.iter().any(|shape| shape.light != super::NONE)
            || solids.operands.iter().any(|operand| operand.light != super::NONE);
        let lights = shapes.iter().filter(|_| shines).map(|shape| shape.light.wrapping_add(1));
        ShapeTable {
            parts: solids.parts.clone(),
            operands: solids.operands.iter().map(of).collect(),
            first_body,
            rows: shapes.iter().map(|shape| Row::new(&shape.unit, &shape.placement)).collect(),
            material: shapes.iter().map(|shape| shape.material).collect(),
            light: lights.collect(),
        }
    }
}
