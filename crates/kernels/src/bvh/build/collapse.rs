//! Which binary nodes become wide ones: the cheapest choice by the surface area heuristic.
//!
//! Dynamic programming over the binary tree, as in section 3.2 of Ylitie, Karras and Laine, *Efficient incoherent ray
//! traversal on GPUs through compressed wide BVHs*, HPG 2017: for each node, the least cost of putting what is below
//! it into 1, 2, … 7 slots of a wide node; one slot means a wide node of its own, whose eight slots its children share.

use super::binary::{BinaryNode, Content, Kind};

/// Binary subtrees of at most this many nodes are one task.
const CHUNK: usize = 1 << 13;
/// A leaf test, in node visits.
const LEAF_COST: f32 = 1.2;
/// What the memory of a node over nothing but instances is worth: its cost is as if its surface were larger by this
/// part of an average instance's. Instances are many and their leaves are the nodes themselves. Over triangles it
/// cost more speed (up to 40 % for camera rays in a room) than memory was saved (2 %).
const MEMORY_COST: f32 = 4.0;

/// What to do with one binary node, and what it costs.
#[derive(Clone, Copy, Default)]
struct Choice {
    /// The least cost in at most 1 to 7 slots.
    costs: [f32; 7],
    /// See [`Choices::left_slots`].
    left_slots: u32,
    /// There are only instances below.
    instances: bool,
}

/// The choices for a whole tree in preorder.
pub struct Choices<'a> {
    nodes: &'a [BinaryNode],
    /// For 2 to 8 slots, 4 bits each: how many of them go to the left child; 0 where one slot less does as well. Costs
    /// are kept for one task's nodes only: of a large tree they would be a large part of the memory.
    left_slots: Vec<u32>,
}

impl<'a> Choices<'a> {
    pub fn new(nodes: &'a [BinaryNode]) -> Self {
        let mut left_slots = vec![0; nodes.len()];
        if !nodes.is_empty() {
            choose(nodes, memory_cost(nodes), &mut left_slots);
        }
        Self { nodes, left_slots }
    }

    /// The (at most eight) children of the wide node over the binary subtree `root..end`, each with the end of its
    /// subtree.
    pub fn children(&self, root: u32, end: u32, children: &mut Vec<(u32, u32)>) {
        children.clear();
        self.expand(root, end, 8, children);
    }

    fn expand(&self, node: u32, end: u32, slots: usize, children: &mut Vec<(u32, u32)>) {
        let Content::Inner { right } = self.nodes[node as usize].content else {
            return children.push((node, end));
        };
        let left_slots = match slots {
            1 => return children.push((node, end)),
            _ => (self.left_slots[node as usize] >> (4 * (slots - 2)) & 15) as usize,
        };
        if left_slots == 0 {
            return self.expand(node, end, slots - 1, children);
        }
        self.expand(node + 1, node + right, left_slots, children);
        self.expand(node + right, end, slots - left_slots, children);
    }
}

/// Fills in the choices of the subtree that `nodes` is, in parallel where it is large; gives that of its root.
fn choose(nodes: &[BinaryNode], memory: f32, left_slots: &mut [u32]) -> Choice {
    if let Content::Inner { right } = nodes[0].content
        && nodes.len() > CHUNK
    {
        let (top, below) = left_slots.split_at_mut(1);
        let (left, right_slots) = below.split_at_mut(right as usize - 1);
        let (left_nodes, right_nodes) = nodes[1..].split_at(right as usize - 1);
        let (left, right) =
            rayon::join(|| choose(left_nodes, memory, left), || choose(right_nodes, memory, right_slots));
        let root = choice(&nodes[0], memory, &left, &right);
        top[0] = root.left_slots;
        return root;
    }
    let mut choices = vec![Choice::default(); nodes.len()];
    for at in (0..nodes.len()).rev() {
        choices[at] = match nodes[at].content {
            Content::Leaf { kind, .. } => {
                Choice { costs: [LEAF_COST * area(&nodes[at]); 7], left_slots: 0, instances: kind == Kind::Instance }
            }
            Content::Inner { right } => choice(&nodes[at], memory, &choices[at + 1], &choices[at + right as usize]),
        };
        left_slots[at] = choices[at].left_slots;
    }
    choices[0]
}

fn choice(node: &BinaryNode, memory: f32, left: &Choice, right: &Choice) -> Choice {
    let mut all = Choice { instances: left.instances && right.instances, ..Choice::default() };
    // The wide node of its own comes first: its cost is that of a single slot.
    let mut own = (f32::INFINITY, 4);
    for left_slots in 1..8 {
        let cost = left.costs[left_slots - 1] + right.costs[7 - left_slots];
        if cost < own.0 {
            own = (cost, left_slots);
        }
    }
    all.left_slots = (own.1 as u32) << 24;
    all.costs[0] = area(node) + own.0 + if all.instances { memory } else { 0.0 };
    for slots in 2..8 {
        let mut best = (all.costs[slots - 2], 0);
        if !node.sealed {
            for left_slots in 1..slots {
                let cost = left.costs[left_slots - 1] + right.costs[slots - left_slots - 1];
                if cost < best.0 {
                    best = (cost, left_slots);
                }
            }
        }
        all.costs[slots - 1] = best.0;
        all.left_slots |= (best.1 as u32) << (4 * (slots - 2));
    }
    all
}

/// The share of memory in the cost of a node over instances. Summed in the order of the nodes, so that it is always the
/// same.
fn memory_cost(nodes: &[BinaryNode]) -> f32 {
    let (mut sum, mut leaves) = (0.0f64, 0u32);
    for node in nodes {
        if let Content::Leaf { kind: Kind::Instance, .. } = node.content {
            sum += f64::from(area(node));
            leaves += 1;
        }
    }
    (sum / f64::from(leaves.max(1))) as f32 * MEMORY_COST
}

/// Boxes that leave nothing out count as 1, so that their trees are cut into few nodes.
fn area(node: &BinaryNode) -> f32 {
    let area = node.bounds.half_area();
    if area.is_finite() { area } else { 1.0 }
}
