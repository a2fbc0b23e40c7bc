//! Checks a built tree against the geometry it was built from.

use super::build::Polygon;
use super::geometry::Geometry;
use super::layout::{InstanceRecord, Kind, Node, Parts4, Ref, Shape, Spheres4, Triangles4, Unit};
use super::triangle::padded_box;
use super::{Accel, NONE};

/// What is wrong with a tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Invalid {
    /// A reference leads out of the arena, or two lead to one place.
    #[error("reference {reference:#010x} leads nowhere")]
    Reference {
        /// The reference.
        reference: u32,
    },
    /// A primitive or an instance sticks out of a box that is meant to hold it.
    #[error("primitive {primitive} is not inside the boxes above it")]
    Outside {
        /// The primitive (or instance).
        primitive: u32,
    },
    /// A primitive or an instance is not there exactly once.
    #[error("primitive {primitive} of instance {instance} is in the tree {times} times")]
    Times {
        /// The primitive.
        primitive: u32,
        /// The instance, or [`NONE`].
        instance: u32,
        /// How often it is there.
        times: u32,
    },
    /// Some of a triangle that is cut is in none of its parts, or one of these sticks out of its box.
    #[error("the parts of primitive {primitive} are not the whole of it")]
    Parts {
        /// The primitive.
        primitive: u32,
    },
    /// A leaf holds other numbers than the geometry.
    #[error("primitive {primitive} is not what the geometry says")]
    Content {
        /// The primitive.
        primitive: u32,
    },
    /// A node does not visit all its children in some octant.
    #[error("node at unit {unit}: its order of children is not a permutation")]
    Order {
        /// Where the node is.
        unit: u32,
    },
}

/// A part of a triangle that has been cut: what of it is in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrianglePart {
    /// The triangle.
    pub primitive: u32,
    /// Lower and upper corner, padded, in the space of the triangle's mesh.
    pub bounds: [[f32; 3]; 2],
}

/// Lower and upper corners.
type Box3 = [[f32; 3]; 2];

const EVERYTHING: Box3 = [[f32::NEG_INFINITY; 3], [f32::INFINITY; 3]];

impl Accel {
    /// Walks the whole structure: every primitive is there once, or in parts that together are the whole of it, inside
    /// every box above it, as the geometry has it. Returns the parts, those of a triangle together, triangles in order
    /// within their tree.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn validate(&self, geometry: &Geometry) -> Result<Vec<TrianglePart>, Invalid> {
        let loose = match geometry.shapes.len() as u32 {
            0 => self.spheres,
            shapes => geometry.first_shape + shapes,
        };
        let end = geometry.meshes.last().map_or(loose, |mesh| mesh.first_primitive + mesh.triangles.len() as u32);
        let mut walk = Walk {
            accel: self,
            geometry,
            seen: vec![0; end as usize],
            instances: vec![0; self.records().len()],
            parts: Vec::new(),
        };
        walk.tree(self.root)?;
        for (index, sphere) in (0u32..).zip(geometry.spheres) {
            let finite = sphere.lower.iter().chain(&sphere.upper).all(|x| x.is_finite());
            walk.expect(index, NONE, u32::from(finite))?;
        }
        for index in 0..geometry.shapes.len() as u32 {
            walk.expect(geometry.first_shape + index, NONE, 1)?;
        }
        for (mesh, record) in (0u32..).zip(&self.meshes) {
            walk.expect_mesh(mesh, u32::from(record.direct_instance != NONE))?;
        }
        for (index, record) in (0u32..).zip(self.records()) {
            let direct = record.mesh & InstanceRecord::DIRECT != 0;
            let mesh = (record.mesh & !InstanceRecord::DIRECT) as usize;
            let there = !direct && Ref(self.meshes[mesh].root) != Ref::END;
            let times = walk.instances[index as usize];
            if times != u32::from(there) {
                return Err(Invalid::Times { primitive: NONE, instance: index, times });
            }
        }
        for (mesh, record) in (0u32..).zip(&self.meshes) {
            walk.seen.fill(0);
            walk.tree(Ref(record.root))?;
            walk.expect_mesh(mesh, u32::from(Ref(record.root) != Ref::END))?;
        }
        Ok(walk.parts)
    }
}

struct Walk<'a> {
    accel: &'a Accel,
    geometry: &'a Geometry<'a>,
    /// How often each primitive was met.
    seen: Vec<u32>,
    instances: Vec<u32>,
    parts: Vec<TrianglePart>,
}

impl Walk<'_> {
    fn tree(&mut self, root: Ref) -> Result<(), Invalid> {
        let before = self.parts.len();
        self.visit(root, &EVERYTHING)?;
        let parts = &mut self.parts[before..];
        parts.sort_by_key(|part| part.primitive);
        for parts in parts.chunk_by(|a, b| a.primitive == b.primitive) {
            let primitive = parts[0].primitive;
            let corners = corners_of(self.geometry, primitive).ok_or(Invalid::Content { primitive })?;
            let whole = padded_box(corners);
            let mut left = vec![Polygon::of(corners)];
            for part in parts {
                inside(primitive, &whole, &part.bounds).map_err(|_| Invalid::Parts { primitive })?;
                let mut rest = Vec::new();
                for polygon in left {
                    outside(polygon, &part.bounds, &mut rest).ok_or(Invalid::Parts { primitive })?;
                }
                left = rest;
            }
            if !left.is_empty() {
                return Err(Invalid::Parts { primitive });
            }
            self.seen[primitive as usize] += 1;
        }
        Ok(())
    }

    fn visit(&mut self, reference: Ref, bounds: &Box3) -> Result<(), Invalid> {
        match reference.kind() {
            Kind::Nothing => Ok(()),
            Kind::Node(unit) => self.node(reference, unit, bounds),
            Kind::Triangles(unit) => {
                let leaf: Triangles4 = self.read(reference, unit)?;
                for place in (0..4).filter(|&place| leaf.ids[place] != NONE) {
                    self.triangle(&leaf, place, bounds)?;
                }
                Ok(())
            }
            Kind::Parts(unit) => {
                let leaf: Parts4 = self.read(reference, unit)?;
                for place in (0..4).filter(|&place| leaf.triangles.ids[place] != NONE) {
                    self.part(&leaf, place, bounds)?;
                }
                Ok(())
            }
            Kind::Spheres(unit) => {
                let leaf: Spheres4 = self.read(reference, unit)?;
                if leaf.is_shape() {
                    return self.shape(&self.read(reference, unit)?, bounds);
                }
                for place in (0..4).filter(|&place| leaf.ids[place] != NONE) {
                    let id = leaf.ids[place];
                    let content = Invalid::Content { primitive: id };
                    let sphere = self.geometry.spheres.get(id as usize).ok_or(content.clone())?;
                    let same = leaf.curvature[place] == sphere.curvature
                        && (0..3).all(|axis| {
                            leaf.anchor[axis][place] == sphere.anchor[axis]
                                && leaf.normal[axis][place] == sphere.normal[axis]
                        });
                    if !same {
                        return Err(content);
                    }
                    inside(id, bounds, &[sphere.lower, sphere.upper])?;
                    self.seen[id as usize] += 1;
                }
                Ok(())
            }
            Kind::Instance(index) => {
                let nowhere = Invalid::Reference { reference: reference.0 };
                let times = self.instances.get_mut(index as usize).ok_or(nowhere)?;
                *times += 1;
                Ok(())
            }
        }
    }

    fn shape(&mut self, leaf: &Shape, bounds: &Box3) -> Result<(), Invalid> {
        let primitive = leaf.ids[0];
        let index = primitive.wrapping_sub(self.geometry.first_shape) as usize;
        let shape = self.geometry.shapes.get(index).filter(|shape| shape.row == leaf.row);
        let shape = shape.ok_or(Invalid::Content { primitive })?;
        inside(primitive, bounds, &[shape.lower, shape.upper])?;
        self.seen[primitive as usize] += 1;
        Ok(())
    }

    fn node(&mut self, reference: Ref, unit: usize, bounds: &Box3) -> Result<(), Invalid> {
        let node: Node = self.read(reference, unit)?;
        for octant in 0..8 {
            let children = node.order.iter().fold(0u32, |set, word| set | 1 << (word >> (3 * octant) & 7));
            if children != 255 {
                return Err(Invalid::Order { unit: unit as u32 });
            }
        }
        for child in 0..8 {
            let own = [0, 1].map(|side| [0, 1, 2].map(|axis: usize| node.planes[2 * axis + side][child]));
            if node.children[child] == Ref::END {
                // No ray may enter a child that is not there.
                if own[0][0] <= own[1][0] {
                    return Err(Invalid::Reference { reference: Ref::END.0 });
                }
                continue;
            }
            // A box need not lie within its parent's (a tree that leaves nothing out has wider ones below), but what
            // it holds must lie within both.
            let both =
                [0, 1, 2].map(|axis: usize| (own[0][axis].max(bounds[0][axis]), own[1][axis].min(bounds[1][axis])));
            self.visit(node.children[child], &[both.map(|(lower, _)| lower), both.map(|(_, upper)| upper)])?;
        }
        Ok(())
    }

    fn triangle(&mut self, leaf: &Triangles4, place: usize, bounds: &Box3) -> Result<(), Invalid> {
        let id = leaf.ids[place];
        for vertex in self.vertices(leaf, place)? {
            inside(id, bounds, &[vertex, vertex])?;
        }
        self.seen[id as usize] += 1;
        Ok(())
    }

    fn part(&mut self, leaf: &Parts4, place: usize, bounds: &Box3) -> Result<(), Invalid> {
        let (primitive, vertices) = (leaf.triangles.ids[place], self.vertices(&leaf.triangles, place)?);
        let mut own = [&leaf.lower, &leaf.upper].map(|corner| [0, 1, 2].map(|axis: usize| corner[axis][place]));
        if own[0][0] <= own[1][0] {
            self.parts.push(TrianglePart { primitive, bounds: own });
            return inside(primitive, bounds, &own);
        }
        // Whole, which is said by exchanging two planes.
        (own[0][0], own[1][0]) = (own[1][0], own[0][0]);
        if own != padded_box(vertices) {
            return Err(Invalid::Content { primitive });
        }
        self.triangle(&leaf.triangles, place, bounds)
    }

    /// The corners of a triangle in a leaf, which are those of the geometry.
    fn vertices(&self, leaf: &Triangles4, place: usize) -> Result<[[f32; 3]; 3], Invalid> {
        let primitive = leaf.ids[place];
        let vertices = [0, 1, 2].map(|v: usize| [0, 1, 2].map(|axis: usize| leaf.vertices[v][axis][place]));
        let same = corners_of(self.geometry, primitive) == Some(vertices);
        if same { Ok(vertices) } else { Err(Invalid::Content { primitive }) }
    }

    fn expect_mesh(&self, mesh: u32, times: u32) -> Result<(), Invalid> {
        let mesh = &self.geometry.meshes[mesh as usize];
        for (id, triangle) in (mesh.first_primitive..).zip(mesh.triangles) {
            let ordinary = triangle
                .iter()
                .all(|&vertex| mesh.positions[vertex as usize].iter().all(|x| x.abs() <= super::ray_space::RANGE));
            self.expect(id, NONE, if ordinary { times } else { 0 })?;
        }
        Ok(())
    }

    fn expect(&self, primitive: u32, instance: u32, times: u32) -> Result<(), Invalid> {
        let found = self.seen[primitive as usize];
        if found == times { Ok(()) } else { Err(Invalid::Times { primitive, instance, times: found }) }
    }

    fn read<T: bytemuck::Pod>(&self, reference: Ref, unit: usize) -> Result<T, Invalid> {
        let units = size_of::<T>() / size_of::<Unit>();
        let item = self.accel.arena.units().get(unit..unit + units);
        item.map(|item| bytemuck::cast_slice::<Unit, T>(item)[0]).ok_or(Invalid::Reference { reference: reference.0 })
    }
}

fn corners_of(geometry: &Geometry, primitive: u32) -> Option<[[f32; 3]; 3]> {
    let mesh = geometry.meshes.iter().rfind(|mesh| mesh.first_primitive <= primitive)?;
    let triangle = mesh.triangles.get((primitive - mesh.first_primitive) as usize)?;
    Some(triangle.map(|vertex| mesh.positions[vertex as usize]))
}

fn inside(primitive: u32, outer: &Box3, inner: &Box3) -> Result<(), Invalid> {
    let holds = (0..3).all(|axis| outer[0][axis] <= inner[0][axis] && inner[1][axis] <= outer[1][axis]);
    if holds { Ok(()) } else { Err(Invalid::Outside { primitive }) }
}

/// What of a polygon is outside a box. (All planes are across axes, so the pieces are what of it is in some box too.)
fn outside(mut polygon: Polygon, bounds: &Box3, pieces: &mut Vec<Polygon>) -> Option<()> {
    for axis in 0..3 {
        for (side, corner) in bounds.iter().enumerate() {
            let plane = f64::from(corner[axis]);
            let [below, above] = polygon.halves(axis, plane)?;
            let (beyond, rest) = if side == 0 { (below, above) } else { (above, below) };
            // What only touches the box is in it.
            if beyond.points().iter().any(|p| p[axis] != plane) {
                pieces.push(beyond);
            }
            polygon = rest;
        }
    }
    Some(())
}
