//! Binary trees by the surface area heuristic over binned centroids (Wald, *On fast construction of SAH-based bounding
//! volume hierarchies*, 2007), built in parallel.
//!
//! The splits are a pure function of the items: ranges are handed to other threads, but never cut by their number,
//! and what threads merge are minima, maxima and counts, which are exact in any order.

use super::super::bounds::Bounds;
use super::contents::TriangleList;
use glam::Vec4;
use rayon::prelude::*;

/// An item to sort into the tree: its box and its index.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    /// The index's upper 16 bits, as a number, ride in the fourth lane.
    lower: Vec4,
    /// The index's lower 16 bits, likewise.
    upper: Vec4,
}

impl Item {
    pub fn new(bounds: &Bounds, index: u32) -> Self {
        let mut item = Self { lower: bounds.lower, upper: bounds.upper };
        // Small whole numbers, not bit patterns: those would be subnormal, which slows some processors down.
        item.lower.w = (index >> 16) as f32;
        item.upper.w = (index & 0xFFFF) as f32;
        item
    }

    pub fn index(&self) -> u32 {
        (self.lower.w as u32) << 16 | self.upper.w as u32
    }

    /// Twice the centroid.
    #[inline(always)]
    fn center(&self) -> Vec4 {
        self.lower + self.upper
    }

    #[inline(always)]
    pub fn bounds(&self) -> Bounds {
        Bounds { lower: self.lower, upper: self.upper }
    }
}

/// What a leaf holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Triangles,
    /// Triangles of which at least one is a part of one.
    Parts,
    Spheres,
    Shape,
    Instance,
}

/// A node of a binary tree, in preorder: the left child follows its parent at once.
#[derive(Clone, Copy, Debug)]
pub struct BinaryNode {
    pub bounds: Bounds,
    pub content: Content,
    /// The box must stay: the node is not opened into its parent.
    pub sealed: bool,
}

#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// How far on the right child is.
    Inner { right: u32 },
    /// `count` items from `first` on in the order of its kind.
    Leaf { kind: Kind, first: u32, count: u32 },
}

/// A binary tree, and the items in the order of its leaves.
#[derive(Default)]
pub struct BinaryTree {
    pub nodes: Vec<BinaryNode>,
    pub order: Vec<u32>,
}

const BINS: usize = 16;
/// Ranges of more items than this are binned by several threads, and their halves built in parallel.
const PARALLEL_BINNING: usize = 1 << 16;
const PARALLEL_BUILD: usize = 1 << 12;
/// Splits are by the median where the heuristic's depth and what medians still need would come to more than this.
pub const DEEPEST: u32 = 38;
/// A split among at most four triangles must gain this part of a leaf test, its share of a node's.
const SPLIT_COST: f32 = 0.3;

impl BinaryTree {
    /// The tree of `items`; leaves hold at most `most` of them.
    pub fn build(mut items: Vec<Item>, kind: Kind, most: usize) -> Self {
        if items.is_empty() {
            return Self::default();
        }
        let builder = Builder { kind, most };
        let extent = Extent::of(&items);
        let grown = builder.grow(&mut items, 0, extent, 0);
        let mut nodes = Vec::with_capacity(grown.count());
        grown.append_to(&mut nodes);
        Self { nodes, order: items.iter().map(Item::index).collect() }
    }

    /// A balanced tree over the items as they come, whose boxes leave nothing out.
    pub fn in_given_order(items: &[Item], kind: Kind, most: u32) -> Self {
        let mut nodes = Vec::new();
        if !items.is_empty() {
            everything(0, items.len() as u32, kind, most, &mut nodes);
        }
        Self { nodes, order: items.iter().map(Item::index).collect() }
    }

    /// Counts the leaves' items from `first` on.
    pub fn start_at(&mut self, start: u32) {
        for node in &mut self.nodes {
            if let Content::Leaf { first, .. } = &mut node.content {
                *first += start;
            }
        }
    }

    /// Makes leaves of parts of those that hold one.
    pub fn mark_parts(&mut self, triangles: &TriangleList) {
        if triangles.parts() == 0 {
            return;
        }
        for node in &mut self.nodes {
            if let Content::Leaf { kind, first, count } = &mut node.content
                && self.order[*first as usize..(*first + *count) as usize].iter().any(|&index| triangles.is_part(index))
            {
                *kind = Kind::Parts;
            }
        }
    }

    /// Puts a box around the whole tree and keeps it there.
    pub fn seal(&mut self, bounds: Bounds) {
        if let Some(root) = self.nodes.first_mut() {
            root.bounds = bounds;
            root.sealed = true;
        }
    }

    /// Gives leaves of one item the item's box.
    pub fn restore_leaf_bounds(&mut self, items: &[Item]) {
        for node in &mut self.nodes {
            if let Content::Leaf { first, .. } = node.content {
                node.bounds = items[first as usize].bounds();
            }
        }
    }
}

fn everything(first: u32, count: u32, kind: Kind, most: u32, nodes: &mut Vec<BinaryNode>) {
    let at = nodes.len();
    let content = Content::Leaf { kind, first, count };
    nodes.push(BinaryNode { bounds: Bounds::EVERYTHING, content, sealed: false });
    if count > most {
        // Whole leaves on the left.
        let left = (count.div_ceil(most) / 2) * most;
        everything(first, left, kind, most, nodes);
        nodes[at].content = Content::Inner { right: (nodes.len() - at) as u32 };
        everything(first + left, count - left, kind, most, nodes);
    }
}

/// Joins trees over different kinds of items (or parts of the orders) under one root.
pub fn join(trees: Vec<Vec<BinaryNode>>) -> Vec<BinaryNode> {
    let mut trees: Vec<_> = trees.into_iter().filter(|nodes| !nodes.is_empty()).collect();
    if trees.len() <= 1 {
        return trees.pop().unwrap_or_default();
    }
    let mut joined = Vec::with_capacity(trees.iter().map(|nodes| nodes.len() + 1).sum());
    join_into(&trees, &mut joined);
    joined
}

fn join_into(trees: &[Vec<BinaryNode>], joined: &mut Vec<BinaryNode>) {
    if let [tree] = trees {
        return joined.extend_from_slice(tree);
    }
    let mut bounds = Bounds::EMPTY;
    trees.iter().for_each(|nodes| bounds.include(&nodes[0].bounds));
    let at = joined.len();
    joined.push(BinaryNode { bounds, content: Content::Inner { right: 0 }, sealed: false });
    let (left, right) = trees.split_at(trees.len() / 2);
    join_into(left, joined);
    joined[at].content = Content::Inner { right: (joined.len() - at) as u32 };
    join_into(right, joined);
}

/// The box of a range's items, and the box of their (doubled) centroids.
#[derive(Clone, Copy)]
struct Extent {
    bounds: Bounds,
    centers: Bounds,
}

impl Extent {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, centers: Bounds::EMPTY };

    #[inline(always)]
    fn include(&mut self, item: &Item) {
        self.bounds.include(&item.bounds());
        self.centers.include_point(item.center());
    }

    fn of(items: &[Item]) -> Self {
        let of = |items: &[Item]| {
            let mut extent = Self::EMPTY;
            items.iter().for_each(|item| extent.include(item));
            extent
        };
        items.par_chunks(PARALLEL_BINNING).map(of).reduce(
            || Self::EMPTY,
            |mut a, b| {
                a.bounds.include(&b.bounds);
                a.centers.include(&b.centers);
                a
            },
        )
    }
}

/// Which bin of an axis a centroid falls into; the same arithmetic for counting and for parting.
#[derive(Clone, Copy)]
struct Binning {
    origin: Vec4,
    scale: Vec4,
    bins: usize,
}

impl Binning {
    fn new(centers: &Bounds, items: usize) -> Self {
        let bins = BINS.min(4 + items / 8);
        let extent = centers.upper - centers.lower;
        let scale = |e: f32| if e > 1e-30 { bins as f32 * (1.0 - 1.0 / 1_048_576.0) / e } else { 0.0 };
        Self { origin: centers.lower, scale: Vec4::new(scale(extent.x), scale(extent.y), scale(extent.z), 0.0), bins }
    }

    /// Bins on the three axes. Rounds instead of truncating, half a bin lower: adding 1.5 · 2^23 leaves the nearest
    /// whole number in the low bits.
    #[inline(always)]
    fn of(&self, item: &Item) -> [usize; 3] {
        const MAGIC: f32 = 12_582_912.0;
        let place = (item.center() - self.origin) * self.scale - Vec4::splat(0.5) + Vec4::splat(MAGIC);
        let [x, y, z, _] = place.to_array();
        [x, y, z].map(|p| p.to_bits() as usize % BINS)
    }
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: u32,
}

impl Bin {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, count: 0 };

    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.bounds.include(&other.bounds);
        self.count += other.count;
    }
}

type Bins = [[Bin; BINS]; 3];

fn fill(items: &[Item], binning: &Binning) -> Bins {
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for item in items {
        let bounds = item.bounds();
        let places = binning.of(item);
        for (axis, place) in places.into_iter().enumerate() {
            let bin = &mut bins[axis][place];
            bin.bounds.include(&bounds);
            bin.count += 1;
        }
    }
    bins
}

/// A way to part a range: items in bins below `bin` of `axis` go left.
struct Split {
    axis: usize,
    bin: usize,
    cost: f32,
    left: Bounds,
    right: Bounds,
}

struct Found {
    split: Split,
    binning: Binning,
}

/// A subtree whose nodes are in pieces still: each is copied once, whatever the number of levels that are built in
/// parallel.
enum Grown {
    Dense(Vec<BinaryNode>),
    Halves { bounds: Bounds, halves: Box<[Grown; 2]> },
}

impl Grown {
    fn count(&self) -> usize {
        match self {
            Self::Dense(nodes) => nodes.len(),
            Self::Halves { halves, .. } => 1 + halves[0].count() + halves[1].count(),
        }
    }

    fn append_to(self, nodes: &mut Vec<BinaryNode>) {
        match self {
            Self::Dense(mut dense) => nodes.append(&mut dense),
            Self::Halves { bounds, halves } => {
                let at = nodes.len();
                nodes.push(BinaryNode { bounds, content: Content::Inner { right: 0 }, sealed: false });
                let [left, right] = *halves;
                left.append_to(nodes);
                nodes[at].content = Content::Inner { right: (nodes.len() - at) as u32 };
                right.append_to(nodes);
            }
        }
    }
}

struct Builder {
    kind: Kind,
    most: usize,
}

impl Builder {
    fn build(&self, items: &mut [Item], first: u32, extent: Extent, depth: u32, nodes: &mut Vec<BinaryNode>) {
        let at = nodes.len();
        let count = items.len();
        let content = Content::Leaf { kind: self.kind, first, count: count as u32 };
        nodes.push(BinaryNode { bounds: extent.bounds, content, sealed: false });
        if count == 1 {
            return;
        }
        let split = self.find_unless_deep(items, &extent, depth);
        if count <= self.most {
            let area = extent.bounds.half_area();
            // Written so that a NaN keeps the leaf.
            let pays = split.as_ref().is_some_and(|found| found.split.cost + SPLIT_COST * area < area);
            if !pays {
                return;
            }
        }
        let (middle, left, right) = part_or_halve(items, split, &extent);
        let (left_items, right_items) = items.split_at_mut(middle);
        let right_first = first + middle as u32;
        self.build(left_items, first, left, depth + 1, nodes);
        nodes[at].content = Content::Inner { right: (nodes.len() - at) as u32 };
        self.build(right_items, right_first, right, depth + 1, nodes);
    }

    /// As [`Builder::build`], the halves of long ranges in parallel, each with nodes of its own.
    fn grow(&self, items: &mut [Item], first: u32, extent: Extent, depth: u32) -> Grown {
        if items.len() <= PARALLEL_BUILD {
            let mut nodes = Vec::with_capacity(items.len());
            self.build(items, first, extent, depth, &mut nodes);
            return Grown::Dense(nodes);
        }
        let split = self.find_unless_deep(items, &extent, depth);
        let (middle, left, right) = part_or_halve(items, split, &extent);
        let (left_items, right_items) = items.split_at_mut(middle);
        let right_first = first + middle as u32;
        let (left, right) = rayon::join(
            || self.grow(left_items, first, left, depth + 1),
            || self.grow(right_items, right_first, right, depth + 1),
        );
        Grown::Halves { bounds: extent.bounds, halves: Box::new([left, right]) }
    }

    /// The cheapest split, unless only medians stay above the deepest level from here on.
    fn find_unless_deep(&self, items: &[Item], extent: &Extent, depth: u32) -> Option<Found> {
        let medians = (items.len() as u32).ilog2() + 1;
        if depth + medians >= DEEPEST { None } else { self.find(items, extent) }
    }

    /// The cheapest split between bins, if the centroids fall into more than one.
    fn find(&self, items: &[Item], extent: &Extent) -> Option<Found> {
        let binning = Binning::new(&extent.centers, items.len());
        let bins = if items.len() > PARALLEL_BINNING {
            items.par_chunks(PARALLEL_BINNING / 4).map(|items| fill(items, &binning)).reduce(
                || [[Bin::EMPTY; BINS]; 3],
                |mut a, b| {
                    a.iter_mut().flatten().zip(b.iter().flatten()).for_each(|(a, b)| a.merge(b));
                    a
                },
            )
        } else {
            fill(items, &binning)
        };
        let mut best: Option<Split> = None;
        for (axis, bins) in bins.iter().enumerate() {
            self.sweep(axis, &bins[..binning.bins], &mut best);
        }
        best.map(|split| Found { split, binning })
    }

    fn sweep(&self, axis: usize, bins: &[Bin], best: &mut Option<Split>) {
        let mut rights = [Bin::EMPTY; BINS];
        let mut right = Bin::EMPTY;
        for bin in (1..bins.len()).rev() {
            right.merge(&bins[bin]);
            rights[bin] = right;
        }
        let mut left = Bin::EMPTY;
        for bin in 1..bins.len() {
            left.merge(&bins[bin - 1]);
            let right = &rights[bin];
            if left.count == 0 || right.count == 0 {
                continue;
            }
            let cost = self.cost(&left) + self.cost(right);
            if best.as_ref().is_none_or(|best| cost < best.cost) {
                *best = Some(Split { axis, bin, cost, left: left.bounds, right: right.bounds });
            }
        }
    }

    #[inline(always)]
    fn cost(&self, bin: &Bin) -> f32 {
        bin.bounds.half_area() * (bin.count as usize).div_ceil(self.most) as f32
    }
}

fn part_or_halve(items: &mut [Item], split: Option<Found>, extent: &Extent) -> (usize, Extent, Extent) {
    match split {
        Some(found) => part(items, &found),
        None => halve(items, extent),
    }
}

/// Moves the items of the left side to the front. Returns their number and the extents of both sides.
fn part(items: &mut [Item], found: &Found) -> (usize, Extent, Extent) {
    let Found { split, binning } = found;
    let mut left = Extent { bounds: split.left, centers: Bounds::EMPTY };
    let mut right = Extent { bounds: split.right, centers: Bounds::EMPTY };
    let goes_left = |item: &Item| binning.of(item)[split.axis] < split.bin;
    let (mut low, mut high) = (0, items.len());
    loop {
        while low < high && goes_left(&items[low]) {
            left.centers.include_point(items[low].center());
            low += 1;
        }
        while low < high && !goes_left(&items[high - 1]) {
            right.centers.include_point(items[high - 1].center());
            high -= 1;
        }
        if low >= high {
            return (low, left, right);
        }
        items.swap(low, high - 1);
    }
}

/// Two halves by number, along the axis on which the centroids spread most.
fn halve(items: &mut [Item], extent: &Extent) -> (usize, Extent, Extent) {
    let spread = extent.centers.upper - extent.centers.lower;
    let axis = if spread.x >= spread.y && spread.x >= spread.z {
        0
    } else if spread.y >= spread.z {
        1
    } else {
        2
    };
    let middle = items.len() / 2;
    let key = |item: &Item| item.center()[axis];
    items.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.index().cmp(&b.index())));
    (middle, Extent::of(&items[..middle]), Extent::of(&items[middle..]))
}
