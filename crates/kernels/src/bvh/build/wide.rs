//! From a binary tree to nodes of eight, laid out in the arena.
//!
//! [`Choices`] says which binary nodes become wide ones. Nodes lie in preorder, the leaves of a node right
//! behind it. A plan says where everything goes before anything is written, in chunks that threads then fill.

use super::super::layout::{LINE_UNITS, NODE_UNITS, Node, PARTS_UNITS, Ref, SPHERES_UNITS, TRIANGLES_UNITS, Unit};
use super::binary::{BinaryNode, Content, Kind};
use super::collapse::Choices;
use rayon::prelude::*;

/// Binary subtrees of at most this many nodes are planned and written as one piece.
const CHUNK: usize = 1 << 13;
const MISSING: u32 = u32::MAX;

/// Where the nodes and leaves of one binary tree will lie.
pub struct Plan {
    chunks: Vec<Chunk>,
    root: Root,
    pub nodes: u64,
    pub leaves: u64,
    /// Wide nodes on the longest way down.
    pub depth: u32,
    pub units: u32,
}

enum Root {
    Empty,
    Chunk,
    /// The tree is a single instance: there is nothing to lay out.
    Instance(u32),
}

/// A run of the arena.
#[derive(Default)]
struct Chunk {
    /// Its first unit, from the plan's start.
    start: u32,
    units: u32,
    nodes: Vec<WideNode>,
    /// A tree that is one leaf has no nodes.
    lone_leaf: Option<u32>,
    leaves: u64,
    depth: u32,
}

/// A node to write: for each child, its binary node and its reference, which counts units from the start of its chunk.
struct WideNode {
    unit: u32,
    binary: [u32; 8],
    links: [Link; 8],
}

#[derive(Clone, Copy)]
enum Link {
    Missing,
    /// In the same chunk: kind bits and unit.
    Near(u32),
    /// The root of another chunk.
    Chunk(u32),
    /// A reference that needs no place.
    Whole(u32),
}

/// Writes the leaves of a tree.
pub trait WriteLeaves: Sync {
    fn triangles(&self, first: u32, count: u32, units: &mut [Unit]);
    fn parts(&self, first: u32, count: u32, units: &mut [Unit]);
    fn spheres(&self, first: u32, count: u32, units: &mut [Unit]);
    fn shape(&self, first: u32, units: &mut [Unit]);
    /// The reference of an instance leaf.
    fn instance(&self, first: u32) -> Ref;
}

impl Plan {
    /// Lays out `nodes`, a binary tree in preorder.
    pub fn new(nodes: &[BinaryNode], leaves: &impl WriteLeaves) -> Self {
        let mut plan = Self { chunks: Vec::new(), root: Root::Empty, nodes: 0, leaves: 0, depth: 0, units: 0 };
        let Some(root) = nodes.first() else { return plan };
        if let Content::Leaf { kind: Kind::Instance, first, .. } = root.content {
            plan.root = Root::Instance(leaves.instance(first).0);
            return plan;
        }
        plan.root = Root::Chunk;
        let choices = Choices::new(nodes);
        let mut roots = Vec::new();
        let mut top = Chunk::default();
        let mut planner = Planner { nodes, choices: &choices, leaves, chunk: &mut top, roots: Some(&mut roots) };
        planner.root(0, nodes.len() as u32);
        let below: Vec<Chunk> = roots
            .par_iter()
            .map(|&(root, end, _)| {
                let mut chunk = Chunk::default();
                Planner { nodes, choices: &choices, leaves, chunk: &mut chunk, roots: None }.root(root, end);
                chunk
            })
            .collect();
        plan.depth = below.iter().zip(&roots).map(|(chunk, &(_, _, depth))| chunk.depth + depth).max().unwrap_or(0);
        plan.depth = plan.depth.max(top.depth);
        plan.chunks = std::iter::once(top).chain(below).collect();
        for chunk in &mut plan.chunks {
            chunk.start = plan.units;
            plan.units = plan.units.saturating_add(chunk.units);
            plan.nodes += chunk.nodes.len() as u64;
            plan.leaves += chunk.leaves;
        }
        plan
    }

    /// The reference of the tree's root, if the plan's first unit is `start`.
    pub fn root(&self, nodes: &[BinaryNode], start: u32) -> Ref {
        match self.root {
            Root::Empty => Ref::END,
            Root::Instance(reference) => Ref(reference),
            Root::Chunk => Ref(self.chunks[0].root_kind(nodes) | start),
        }
    }

    /// Writes the tree into `units`, which are those from `start` on.
    pub fn write(&self, nodes: &[BinaryNode], leaves: &impl WriteLeaves, start: u32, units: &mut [Unit]) {
        let mut rest = units;
        let mut parts = Vec::with_capacity(self.chunks.len());
        for chunk in &self.chunks {
            let (part, after) = rest.split_at_mut(chunk.units as usize);
            parts.push((chunk, part));
            rest = after;
        }
        parts.into_par_iter().for_each(|(chunk, part)| self.write_chunk(chunk, nodes, leaves, start, part));
    }

    fn write_chunk(
        &self,
        chunk: &Chunk,
        nodes: &[BinaryNode],
        leaves: &impl WriteLeaves,
        start: u32,
        units: &mut [Unit],
    ) {
        if let Some(leaf) = chunk.lone_leaf {
            write_leaf(&nodes[leaf as usize], leaves, units);
        }
        for wide in &chunk.nodes {
            let mut node = Node::EMPTY;
            for child in 0..8 {
                node.children[child] = match wide.links[child] {
                    Link::Missing => continue,
                    Link::Whole(reference) => Ref(reference),
                    Link::Near(reference) => Ref(reference + start + chunk.start),
                    Link::Chunk(index) => {
                        let chunk = &self.chunks[index as usize];
                        Ref(chunk.root_kind(nodes) | (start + chunk.start))
                    }
                };
                let binary = &nodes[wide.binary[child] as usize];
                for axis in 0..3 {
                    node.planes[2 * axis][child] = binary.bounds.lower[axis];
                    node.planes[2 * axis + 1][child] = binary.bounds.upper[axis];
                }
                if let (Content::Leaf { .. }, Link::Near(reference)) = (binary.content, wide.links[child]) {
                    write_leaf(binary, leaves, &mut units[(reference & Ref::UNIT) as usize..]);
                }
            }
            node.set_order();
            let unit = wide.unit as usize;
            units[unit..unit + NODE_UNITS as usize].copy_from_slice(bytemuck::cast_slice(&[node]));
        }
    }
}

impl Chunk {
    fn root_kind(&self, nodes: &[BinaryNode]) -> u32 {
        self.lone_leaf.map_or(0, |leaf| leaf_kind(&nodes[leaf as usize]))
    }
}

fn leaf_kind(node: &BinaryNode) -> u32 {
    match node.content {
        Content::Leaf { kind: Kind::Spheres | Kind::Shape, .. } => Ref::SPHERES,
        Content::Leaf { kind: Kind::Parts, .. } => Ref::PARTS,
        _ => Ref::TRIANGLES,
    }
}

fn write_leaf(node: &BinaryNode, leaves: &impl WriteLeaves, units: &mut [Unit]) {
    match node.content {
        Content::Leaf { kind: Kind::Triangles, first, count } => {
            leaves.triangles(first, count, &mut units[..TRIANGLES_UNITS as usize])
        }
        Content::Leaf { kind: Kind::Parts, first, count } => {
            leaves.parts(first, count, &mut units[..PARTS_UNITS as usize])
        }
        Content::Leaf { kind: Kind::Spheres, first, count } => {
            leaves.spheres(first, count, &mut units[..SPHERES_UNITS as usize])
        }
        Content::Leaf { kind: Kind::Shape, first, .. } => leaves.shape(first, &mut units[..SPHERES_UNITS as usize]),
        _ => {}
    }
}

struct Planner<'a, L> {
    nodes: &'a [BinaryNode],
    choices: &'a Choices<'a>,
    leaves: &'a L,
    chunk: &'a mut Chunk,
    /// Roots of the chunks below (with their ends and depths); `None` where the chunk goes all the way down.
    roots: Option<&'a mut Vec<(u32, u32, u32)>>,
}

impl<L: WriteLeaves> Planner<'_, L> {
    fn root(&mut self, root: u32, end: u32) {
        if let Content::Leaf { .. } = self.nodes[root as usize].content {
            self.chunk.lone_leaf = Some(root);
            self.leaf(root);
        } else if self.nodes[root as usize].sealed {
            // Nothing above would hold the box: a node of one child does.
            self.place(&[(root, end)], 1);
        } else {
            self.node(root, end, 1);
        }
        self.chunk.units = self.chunk.units.next_multiple_of(LINE_UNITS);
    }

    /// Takes room for a leaf; returns its reference within the chunk.
    fn leaf(&mut self, leaf: u32) -> u32 {
        let kind = leaf_kind(&self.nodes[leaf as usize]);
        let unit = self.chunk.units;
        self.chunk.units += match kind {
            Ref::SPHERES => SPHERES_UNITS,
            Ref::PARTS => PARTS_UNITS,
            _ => TRIANGLES_UNITS,
        };
        self.chunk.leaves += 1;
        kind | unit
    }

    /// Plans the wide node over the binary subtree `root..end`; returns its unit.
    fn node(&mut self, root: u32, end: u32, depth: u32) -> u32 {
        let mut children = Vec::with_capacity(8);
        self.choices.children(root, end, &mut children);
        self.place(&children, depth)
    }

    /// Plans a wide node with these children; returns its unit.
    fn place(&mut self, children: &[(u32, u32)], depth: u32) -> u32 {
        self.chunk.depth = self.chunk.depth.max(depth);
        self.chunk.units = self.chunk.units.next_multiple_of(LINE_UNITS);
        let unit = self.chunk.units;
        self.chunk.units += NODE_UNITS;
        let at = self.chunk.nodes.len();
        let mut binary = [MISSING; 8];
        binary.iter_mut().zip(children).for_each(|(binary, (child, _))| *binary = *child);
        self.chunk.nodes.push(WideNode { unit, binary, links: [Link::Missing; 8] });
        for (i, &(child, _)) in children.iter().enumerate() {
            if let Content::Leaf { kind, first, .. } = self.nodes[child as usize].content {
                self.chunk.nodes[at].links[i] = match kind {
                    Kind::Instance => Link::Whole(self.leaves.instance(first).0),
                    _ => Link::Near(self.leaf(child)),
                };
            }
        }
        for (i, &(child, child_end)) in children.iter().enumerate() {
            if matches!(self.nodes[child as usize].content, Content::Leaf { .. }) {
                continue;
            }
            let link = match &mut self.roots {
                Some(roots) if ((child_end - child) as usize) <= CHUNK => {
                    roots.push((child, child_end, depth));
                    // Chunk 0 is the one being planned.
                    Link::Chunk(roots.len() as u32)
                }
                _ => Link::Near(self.node(child, child_end, depth + 1)),
            };
            self.chunk.nodes[at].links[i] = link;
        }
        unit
    }
}

impl Node {
    const EMPTY: Self = {
        let (lower, upper) = ([f32::INFINITY; 8], [f32::NEG_INFINITY; 8]);
        Self { planes: [lower, upper, lower, upper, lower, upper], children: [Ref::END; 8], order: [0; 8] }
    };

    /// Sorts the children for each octant by their nearest corners along its diagonal, farthest first.
    fn set_order(&mut self) {
        self.order = [0; 8];
        for octant in 0..8 {
            let key = |child: usize| {
                let corner = |axis: usize| {
                    if octant >> axis & 1 == 1 {
                        -self.planes[2 * axis + 1][child]
                    } else {
                        self.planes[2 * axis][child]
                    }
                };
                corner(0) + corner(1) + corner(2)
            };
            let keys: [f32; 8] = std::array::from_fn(key);
            let mut children = [0, 1, 2, 3, 4, 5, 6, 7];
            // Stable; total order, so that infinite boxes (inf − inf) are no trouble either.
            children.sort_by(|&a: &usize, &b| keys[b].total_cmp(&keys[a]));
            for (place, child) in children.into_iter().enumerate() {
                self.order[place] |= (child as u32) << (3 * octant);
            }
        }
    }
}
