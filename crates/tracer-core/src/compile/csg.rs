//! Solids: objects that are made of closed shapes (see [`tracer_kernels::shapes::csg`]).
//!
//! Surfaces of different operands that are one and the same get the same numbers here, once for all copies: so lines
//! meet them at the same places to the last bit, and where faces coincide nothing is between them.

mod left;
mod shining;
mod touching;

use super::assets::Sources;
use super::bodies::{Extent, Side, UnitBody};
use super::curved::{Written, written};
use super::materials::MaterialBuilder;
use super::placing::{Given, Maps, Subject, check, place, place_all};
use super::settled::Settled;
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};
pub use left::warn;
use scene_format::desc::{Emissive, MaterialRef, Object};
use scene_format::diagnostic::Spanned;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
pub use shining::Lit;
use shining::amount_of_whole;
use std::sync::Arc;
use touching::Moved;
pub use touching::part;
use tracer_kernels::scene::{Frame, NONE, Operand, Shape, Solids, Step};
use tracer_kernels::shapes::csg::{Operation, Part, Surface};
use tracer_kernels::shapes::{Solid, UnitShape};

/// What a solid is made of.
enum Node {
    /// One of the operands.
    Operand(usize),
    /// What becomes of several: two at a time, from the first on.
    Made(Operation, Vec<Node>),
}

/// A shape in a solid.
struct OperandWritten {
    unit: UnitShape,
    /// From its object space to where it is before its transforms.
    local: DAffine3,
    /// From there to where it is in the solid, before the solid's transforms.
    moved: DAffine3,
    material: u32,
    /// How it shines, where it does.
    emissive: Option<Arc<Emissive>>,
}

/// A surface of an operand, in the space that the solid is written in.
struct PartWritten {
    surface: Surface,
    map: DAffine3,
    flipped: bool,
    joins: bool,
    operand: usize,
}

/// A solid of the scene.
pub struct SolidObject {
    /// Its place among the objects of the scene.
    pub number: u32,
    node: Node,
    operands: Vec<OperandWritten>,
    parts: Vec<PartWritten>,
    /// From where it is written to the world, one per copy.
    maps: Maps,
    /// Its walls that other things lie in one plane with.
    moved: Moved,
}

/// A shape that a copy is made of.
pub struct WallOf {
    pub unit: UnitShape,
    /// Where it is in the world.
    pub map: DAffine3,
    pub material: u32,
    pub shines: bool,
}

/// Lower and upper corner.
type Box3 = [DVec3; 2];

/// Surfaces of solids that a scene may have, those of copies counted: 2 GB.
const MOST_ROWS: usize = 1 << 24;

/// Finds what the solids are made of, and their materials, in order.
pub fn load(
    desc: &SceneDesc,
    sources: &Sources<'_>,
    builder: &mut MaterialBuilder,
    diagnostics: &mut Diagnostics,
) -> Vec<SolidObject> {
    let mut all = Vec::new();
    for (number, object) in (0..).zip(&desc.objects) {
        if object.value.operands().is_none() {
            continue;
        }
        let noun = noun(&object.value);
        let (transform, placements) = (object.value.transform(), object.value.placements());
        let faults = object.value.faults(object.span);
        if !faults.is_empty() {
            builder.resolve(object.value.material(), number, diagnostics);
            diagnostics.extend(faults);
            // A placements file is read even when something else is wrong: all faults in one run.
            let given = Given { desc, sources, settled: &Settled::default() };
            place_all(given, transform, placements, &Subject::unknown(noun), diagnostics);
            continue;
        }
        let mut reader = Nodes { builder: &mut *builder, diagnostics: &mut *diagnostics };
        let mut operands = Vec::new();
        let node = reader.node(object, &format!("objects[{number}]"), None, &mut operands);
        let parts = parts(&operands);
        all.push(SolidObject { number, node, operands, parts, maps: Maps::new(), moved: Moved::default() });
    }
    all
}

/// Finds where the solids are.
pub fn place_copies(given: Given<'_>, solids: &mut Vec<SolidObject>, diagnostics: &mut Diagnostics) {
    let mut rows = 0usize;
    for index in 0..solids.len() {
        let object = &given.desc.objects[solids[index].number as usize];
        let (transform, placements) = (object.value.transform(), object.value.placements());
        let place = |subject: &Subject<'_>| place_all(given, transform, placements, subject, diagnostics);
        let maps = solids[index].with_subject(noun(&object.value), place);
        check(&maps, transform.first().map_or(object.span, |t| t.span), noun(&object.value), diagnostics);
        rows += maps.len().saturating_mul(solids[index].parts.len());
        if rows > MOST_ROWS {
            let message = format!("the surfaces of all copies of solids are more than {MOST_ROWS}");
            diagnostics.push(Diagnostic::error(codes::TOO_MUCH, object.span, message).expected("fewer copies"));
            return solids.truncate(index);
        }
        solids[index].maps = maps;
    }
}

impl SolidObject {
    /// What steps ask of it.
    pub fn with_subject<T>(&self, noun: &str, then: impl FnOnce(&Subject<'_>) -> T) -> T {
        let reach = |map: &DAffine3, axis: usize| bounds(&self.node, &self.operands, map).map(|corner| corner[axis]);
        then(&Subject { noun, local: DAffine3::IDENTITY, middle: None, reach: &reach })
    }
}

/// What a solid is called.
pub fn noun(object: &Object) -> &'static str {
    match object {
        Object::Union(_) => "union",
        Object::Intersection(_) => "intersection",
        _ => "difference",
    }
}

/// What reads the parts of a solid.
struct Nodes<'a, 'm> {
    builder: &'a mut MaterialBuilder<'m>,
    diagnostics: &'a mut Diagnostics,
}

impl Nodes<'_, '_> {
    /// What an object is made of. `path`: where it stands; `inherited`: the material of what has none of its own. Its
    /// own transforms are applied to its operands where it is part of another.
    fn node(
        &mut self,
        object: &Spanned<Object>,
        path: &str,
        inherited: Option<u32>,
        operands: &mut Vec<OperandWritten>,
    ) -> Node {
        let material = match object.value.material() {
            MaterialRef::Default => inherited,
            own => {
                let material = self.builder.resolve_as(own, || format!("{path}.material"), self.diagnostics);
                let emissive = self.builder.emissive(material);
                let fault = emissive.and_then(|emissive| amount_of_whole(object, emissive));
                // One mistake may be that of many shapes.
                let is_told = |fault: &Diagnostic| {
                    self.diagnostics.iter().any(|other| (other.code, other.span) == (fault.code, fault.span))
                };
                let fault = fault.filter(|fault| !is_told(fault));
                self.diagnostics.extend(fault);
                Some(material)
            }
        };
        let (operation, list) = match &object.value {
            Object::Union(solid) => (Operation::Union, &solid.objects.0),
            Object::Intersection(solid) => (Operation::Intersection, &solid.objects.0),
            Object::Difference(solid) => (Operation::Difference, &solid.objects.0),
            _ => return self.operand(object, material, operands),
        };
        let nodes = list.iter().enumerate().map(|(k, part)| {
            let first = operands.len();
            let node = self.node(part, &format!("{path}.objects[{k}]"), material, operands);
            if part.value.operands().is_some() {
                let reach = |map: &DAffine3, axis: usize| bounds(&node, operands, map).map(|corner| corner[axis]);
                let map = self.map_of(part, noun(&part.value), DAffine3::IDENTITY, DVec3::ZERO, &reach);
                operands[first..].iter_mut().for_each(|operand| operand.moved = map * operand.moved);
            }
            node
        });
        Node::Made(operation, nodes.collect())
    }

    fn operand(&mut self, object: &Spanned<Object>, material: Option<u32>, operands: &mut Vec<OperandWritten>) -> Node {
        let index = operands.len();
        // What cannot be an operand is told before.
        let Written { unit, local, noun } = written(&object.value)
            .or_else(|| super::polygonal::cube(&object.value))
            .unwrap_or(Written { unit: UnitShape::Sphere, local: DAffine3::IDENTITY, noun: "shape" });
        let material = material.unwrap_or_else(|| self.builder.default_material());
        let reach = |map: &DAffine3, axis: usize| unit.bounds(&(*map * local)).map(|corner| corner[axis]);
        let moved = self.map_of(object, noun, local, local.translation, &reach);
        let emissive = self.builder.emissive(material).cloned();
        operands.push(OperandWritten { unit, local, moved, material, emissive });
        Node::Operand(index)
    }

    /// Where its transforms put what is written.
    fn map_of(
        &mut self,
        object: &Spanned<Object>,
        noun: &str,
        local: DAffine3,
        middle: DVec3,
        reach: super::placing::Reach<'_>,
    ) -> DAffine3 {
        let subject = Subject { noun, local: DAffine3::IDENTITY, middle: Some(middle), reach };
        let transform = object.value.transform();
        let map = place(transform, &subject, self.diagnostics);
        check(&[map * local], transform.first().map_or(object.span, |t| t.span), noun, self.diagnostics);
        map
    }
}

/// The box of a node under a map: of an intersection what those of its parts have in common, of a difference that of
/// the first. Where nothing is left it is one point.
fn bounds(node: &Node, operands: &[OperandWritten], map: &DAffine3) -> Box3 {
    match node {
        Node::Operand(k) => {
            let operand = &operands[*k];
            let map = *map * operand.moved * operand.local;
            if operand.unit.is_endless() { behind(&map) } else { operand.unit.bounds(&map) }
        }
        Node::Made(operation, nodes) => {
            let boxes = nodes.iter().map(|node| bounds(node, operands, map));
            let whole = match operation {
                Operation::Union => boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]),
                Operation::Intersection => boxes.reduce(|a, b| [a[0].max(b[0]), a[1].min(b[1])]),
                Operation::Difference => boxes.take(1).next(),
            };
            let [low, high] = whole.unwrap_or([DVec3::ZERO; 2]);
            if low.cmple(high).all() { [low, high] } else { [0.5 * (low + high); 2] }
        }
    }
}

/// The box of what is behind a plane: it ends where the plane is across an axis.
fn behind(map: &DAffine3) -> Box3 {
    let normal = map.matrix3.x_axis.cross(map.matrix3.y_axis) * map.matrix3.determinant().signum();
    let mut corners = [DVec3::NEG_INFINITY, DVec3::INFINITY];
    for axis in 0..3 {
        if normal[(axis + 1) % 3] == 0.0 && normal[(axis + 2) % 3] == 0.0 {
            corners[usize::from(normal[axis] > 0.0)][axis] = map.translation[axis];
        }
    }
    corners
}

/// The surfaces of all operands, those that are one and the same with the same numbers.
fn parts(operands: &[OperandWritten]) -> Vec<PartWritten> {
    let [low, high] = operands
        .iter()
        .filter(|operand| !operand.unit.is_endless())
        .map(|operand| operand.unit.bounds(&(operand.moved * operand.local)))
        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
        .unwrap_or([DVec3::ZERO; 2]);
    let unit = Scale { middle: 0.5 * (low + high), size: (high - low).max_element().max(f64::MIN_POSITIVE) };
    let mut parts: Vec<PartWritten> = Vec::new();
    for (k, operand) in operands.iter().enumerate() {
        let map = operand.moved * operand.local;
        for (at, (surface, local)) in surfaces(&operand.unit).into_iter().enumerate() {
            let map = map * local;
            let mut part = PartWritten { surface, map, flipped: false, joins: at > 0, operand: k };
            if let Some((known, flipped)) =
                parts.iter().find_map(|known| Some((known, unit.same((&known.surface, &known.map), (&surface, &map))?)))
            {
                (part.surface, part.map, part.flipped) = (known.surface, known.map, flipped);
            }
            parts.push(part);
        }
    }
    parts
}

/// The surfaces of a unit shape, each by a map from the space that it is of a size of one in.
fn surfaces(unit: &UnitShape) -> Vec<(Surface, DAffine3)> {
    // The plane across an axis, on its positive or negative side.
    let plane = |axis: usize, at: f64| {
        let columns = [0, 1, 2].map(|k: usize| DVec3::AXES[(axis + 1 + k) % 3]);
        let matrix3 = DMat3::from_cols(columns[0], columns[1], columns[2] * at.signum());
        (Surface::Plane, DAffine3 { matrix3, translation: at * DVec3::AXES[axis] })
    };
    match *unit {
        UnitShape::Cone { radii, .. } => {
            vec![(Surface::Side { radii }, DAffine3::IDENTITY), plane(2, 1.0), plane(2, -1.0)]
        }
        UnitShape::Capsule { half } => vec![(Surface::Capsule { half }, DAffine3::IDENTITY)],
        UnitShape::Torus { tube } => vec![(Surface::Torus { tube }, DAffine3::IDENTITY)],
        UnitShape::Cube => (0..3).flat_map(|axis| [plane(axis, 0.5), plane(axis, -0.5)]).collect(),
        UnitShape::Plane => vec![(Surface::Plane, DAffine3::IDENTITY)],
        // Others are no operands.
        UnitShape::Sphere | UnitShape::Disk { .. } | UnitShape::Solid(_) => {
            vec![(Surface::Ball, DAffine3::IDENTITY)]
        }
    }
}

/// Where a solid is and how large: surfaces are compared in parts of that.
struct Scale {
    middle: DVec3,
    size: f64,
}

/// Surfaces that differ by less, in parts of a solid, are one: some roundings of what is written.
const SAME: f64 = 1e-11;

impl Scale {
    /// Whether two surfaces are the same; `true`: seen from its other side.
    fn same(&self, a: (&Surface, &DAffine3), b: (&Surface, &DAffine3)) -> Option<bool> {
        match (a.0, b.0) {
            (Surface::Plane, Surface::Plane) => {
                let ([n, at], [other_n, other_at]) = (self.plane(a.1), self.plane(b.1));
                let apart = (other_at - at).dot(n).abs();
                if apart > SAME {
                    return None;
                }
                let near = |n: DVec3| (n - other_n).length() <= SAME;
                if near(n) {
                    Some(false)
                } else if near(-n) {
                    Some(true)
                } else {
                    None
                }
            }
            (Surface::Capsule { half }, Surface::Capsule { half: other }) => {
                let apart = a.1.matrix3 - b.1.matrix3;
                let turned = apart.to_cols_array().iter().fold(0.0f64, |most, x| most.max(x.abs()));
                let moved = (a.1.translation - b.1.translation).length();
                (turned.max(moved) <= SAME * self.size && (half - other).abs() <= SAME * half).then_some(false)
            }
            (Surface::Torus { tube }, Surface::Torus { tube: other }) => {
                // It may be turned about its axis, and upside down.
                let [map, other_map] = [a.1, b.1];
                let turned = map.matrix3 * map.matrix3.transpose() - other_map.matrix3 * other_map.matrix3.transpose();
                let most = turned.to_cols_array().iter().fold(0.0f64, |most, x| most.max(x.abs()));
                let [n, other_n] = [map, other_map].map(|map| map.matrix3.inverse().row(2) * self.size);
                let tilted = (n - other_n).length().min((n + other_n).length());
                let moved = (map.translation - other_map.translation).length();
                let long =
                    map.matrix3.x_axis.length().max(map.matrix3.y_axis.length()).max(map.matrix3.z_axis.length());
                let same = most <= SAME * self.size * long && tilted <= SAME * n.length();
                (same && moved <= SAME * self.size && (tube - other).abs() <= SAME * tube).then_some(false)
            }
            (Surface::Plane | Surface::Capsule { .. } | Surface::Torus { .. }, _)
            | (_, Surface::Plane | Surface::Capsule { .. } | Surface::Torus { .. }) => None,
            _ => {
                let (first, second) = (self.quadric(a), self.quadric(b));
                let same = (first - second).to_cols_array().iter().all(|x| x.abs() <= SAME);
                // Both halves of a double cone have one equation.
                (same && self.holds_inside(a, b)).then_some(false)
            }
        }
    }

    /// Unit normal and a point of a plane.
    fn plane(&self, map: &DAffine3) -> [DVec3; 2] {
        let inverse = map.matrix3.inverse();
        [inverse.row(2).normalize(), (map.translation - self.middle) / self.size]
    }

    /// The matrix of x^T Q x = 0, its largest entry that goes with squares made 1.
    fn quadric(&self, (surface, map): (&Surface, &DAffine3)) -> DMat4 {
        let (m, s) = radii(surface).map_or((0.0, 0.0), |[a, b]| (0.5 * (a + b), 0.5 * (b - a)));
        let form = match surface {
            Surface::Side { .. } => DMat4::from_cols(
                DVec4::X,
                DVec4::Y,
                DVec4::new(0.0, 0.0, -s * s, -m * s),
                DVec4::new(0.0, 0.0, -m * s, -m * m),
            ),
            _ => DMat4::from_diagonal(DVec4::new(1.0, 1.0, 1.0, -1.0)),
        };
        let here = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(self.size)), translation: self.middle };
        let to_object = DMat4::from(map.inverse() * here);
        let whole = to_object.transpose() * form * to_object;
        let linear = DMat3::from_mat4(whole).to_cols_array();
        whole * (1.0 / linear.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs())))
    }

    /// Whether the middle of the wider end of the second lies in the first one's half.
    fn holds_inside(&self, a: (&Surface, &DAffine3), b: (&Surface, &DAffine3)) -> bool {
        let (Some([first, last]), Some(other)) = (radii(a.0), radii(b.0)) else { return true };
        let end = DVec3::new(0.0, 0.0, if other[1] > other[0] { 1.0 } else { -1.0 });
        let q = a.1.inverse().transform_point3(b.1.transform_point3(end));
        0.5 * (first + last) + 0.5 * (last - first) * q.z > 0.0
    }
}

fn radii(surface: &Surface) -> Option<[f64; 2]> {
    if let Surface::Side { radii } = surface { Some(*radii) } else { None }
}

/// Where a thing lies of a node under a map.
fn side(node: &Node, operands: &[OperandWritten], map: &DAffine3, extent: &Extent) -> Side {
    match node {
        Node::Operand(k) => {
            let operand = &operands[*k];
            let body = UnitBody::of(&operand.unit, &(*map * operand.moved * operand.local));
            body.map_or(Side::Unknown, |body| body.side(extent))
        }
        Node::Made(operation, nodes) => {
            let sides = nodes.iter().map(|node| side(node, operands, map, extent));
            let whole = match operation {
                Operation::Union => sides.reduce(Side::or),
                Operation::Intersection => sides.map(Side::not).reduce(Side::or).map(Side::not),
                // What is in none of the others, and in the first: not (not a or b).
                Operation::Difference => sides.reduce(|a, b| a.not().or(b).not()),
            };
            whole.unwrap_or(Side::Unknown)
        }
    }
}

impl SolidObject {
    /// Its place among the objects of the scene.
    pub fn number(&self) -> u32 {
        self.number
    }

    /// From where it is written to the world, one per copy.
    pub fn maps(&self) -> &[DAffine3] {
        &self.maps
    }

    /// Where a copy is.
    pub fn bounds(&self, map: &DAffine3) -> Box3 {
        bounds(&self.node, &self.operands, map)
    }

    /// What a copy is made of.
    pub fn walls(&self, map: &DAffine3) -> impl Iterator<Item = WallOf> {
        let map = *map;
        self.operands.iter().map(move |operand| WallOf {
            unit: operand.unit,
            map: map * operand.moved * operand.local,
            material: operand.material,
            shines: operand.emissive.is_some(),
        })
    }

    /// Where a thing lies of a copy.
    pub fn side(&self, map: &DAffine3, extent: &Extent) -> Side {
        side(&self.node, &self.operands, map, extent)
    }

    /// The hollows of a copy that nothing leads into: what a difference takes away within the first, and apart from all
    /// else that it takes away.
    pub fn hollows(&self, map: &DAffine3) -> Vec<UnitBody> {
        let Node::Made(Operation::Difference, nodes) = &self.node else { return Vec::new() };
        let [first, taken @ ..] = nodes.as_slice() else { return Vec::new() };
        let hollow = |(k, node): (usize, &Node)| {
            let Node::Operand(index) = node else { return None };
            let operand = self.operands.get(*index).filter(|operand| !operand.unit.is_endless())?;
            let whole = *map * operand.moved * operand.local;
            let extent = Extent::of_unit(&operand.unit, &whole);
            let lies = |node: &Node| side(node, &self.operands, map, &extent);
            let mut others = taken.iter().enumerate().filter(|(other, _)| *other != k);
            let is_shut = lies(first) == Side::In && others.all(|(_, other)| lies(other) == Side::Out);
            if is_shut { UnitBody::of(&operand.unit, &whole) } else { None }
        };
        taken.iter().enumerate().filter_map(hollow).collect()
    }

    /// One point per copy near what the camera looks at, in its box; of many copies of every so many, 1024 at most.
    pub fn marks(&self, look_at: DVec3) -> impl Iterator<Item = DVec3> {
        let every = self.maps.len().div_ceil(1024).max(1);
        self.maps.iter().step_by(every).map(move |map| {
            let [low, high] = bounds(&self.node, &self.operands, map);
            look_at.clamp(low, high)
        })
    }

    /// A box around a copy.
    pub fn extent(&self, map: &DAffine3) -> Extent {
        Extent::of_box(bounds(&self.node, &self.operands, &DAffine3::IDENTITY), map)
    }

    /// Adds its copies to the shapes of the scene, and its operands that shine to the lights. `written`, where a
    /// pattern asks for it: from the coordinates that things are written in to the world, the first the world's own.
    pub fn build(
        &self,
        frame: &Frame,
        shapes: &mut Vec<Shape>,
        solids: &mut Solids,
        lit: &mut Lit<'_>,
        mut written: Option<&mut Vec<DAffine3>>,
    ) {
        for (copy, map) in (0..).zip(&self.maps) {
            let scaled = |map: DAffine3| DAffine3 {
                matrix3: map.matrix3 * frame.scale,
                translation: frame.point(map.translation),
            };
            let first = [solids.parts.len(), solids.steps.len(), solids.operands.len()].map(|n| n as u32);
            for (number, operand) in self.operands.iter().enumerate() {
                let mut coordinates = 0;
                let whole = *map * operand.moved;
                if let Some(written) = written.as_mut().filter(|_| whole != DAffine3::IDENTITY) {
                    coordinates = written.len() as u32;
                    written.push(whole);
                }
                let (unit, placement) = self.moved_operand(copy, number, map);
                solids.operands.push(Operand {
                    unit,
                    placement: scaled(placement),
                    material: operand.material,
                    light: NONE,
                    coordinates,
                });
            }
            let placed = |k: usize, map_in: &DAffine3| {
                let mut whole = *map * *map_in;
                whole.translation += self.moved.of(copy, k);
                scaled(whole)
            };
            self.steps(&self.node, &placed, first[2], solids);
            let count = |list: usize, first: u32| [first, list as u32 - first];
            let [low, high] = bounds(&self.node, &self.operands, map);
            let most = self.moved.most(copy);
            let [low, high] = [low - most, high + most].map(|corner| frame.point(corner));
            let solid = Solid {
                parts: count(solids.parts.len(), first[0]),
                steps: count(solids.steps.len(), first[1]),
                operands: count(solids.operands.len(), first[2]),
                bounds: [low.min(high), low.max(high)],
            };
            self.shine(frame, (copy, map), (&solid, shapes.len() as u32), &mut solids.operands, lit);
            let unit = UnitShape::Solid(solid);
            let material = self.operands.first().map_or(0, |operand| operand.material);
            let (placement, object) = (DAffine3::IDENTITY, self.number);
            let (light, is_plain) = (NONE, false);
            shapes.push(Shape { unit, placement, material, light, object, copy, is_plain, coordinates: 0 });
        }
    }

    /// Adds the parts and steps of a node. `placed`: of a part, from its map in the solid to render space.
    fn steps(&self, node: &Node, placed: &dyn Fn(usize, &DAffine3) -> DAffine3, first: u32, solids: &mut Solids) {
        match node {
            Node::Operand(k) => {
                let operand = first + *k as u32;
                let own = self.parts.iter().enumerate().filter(|(_, part)| part.operand == *k);
                let parts = own.map(|(number, part)| {
                    let PartWritten { surface, map, flipped, joins, .. } = part;
                    Part::of_surface(surface, &placed(number, map), *flipped, *joins, operand)
                });
                solids.parts.extend(parts);
                solids.steps.push(Step::Operand(operand));
            }
            Node::Made(operation, nodes) => {
                for (k, node) in nodes.iter().enumerate() {
                    self.steps(node, placed, first, solids);
                    if k > 0 {
                        solids.parts.push(Part::of_operation(*operation));
                        solids.steps.push(Step::Operation(*operation));
                    }
                }
            }
        }
    }
}
