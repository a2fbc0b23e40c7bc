//! One tree of several over different kinds of items, so that things that lie together are met together: under one root
//! beside each other, rays would go through all of them.
//!
//! Each tree is cut into subtrees, and a tree is built over those of all. A kind is cut into some eight times as many
//! pieces as there are leaves of others: where a mesh stands beside three balls its tree stays nearly whole, and where
//! there are as many cylinders as boxes all leaves are sorted anew. A leaf holds one kind, as before.

use super::binary::{BinaryNode, BinaryTree, Content, DEEPEST, Item, Kind, join};

/// Pieces of a kind for each leaf of another.
const PIECES: usize = 8;

/// A subtree: the number of its tree, and its nodes there.
#[derive(Clone, Copy)]
struct Piece {
    tree: usize,
    from: usize,
    to: usize,
}

/// The tree over all items of these, whose leaves keep what they hold. Where it would be deeper than a tree may be,
/// they stay beside each other.
pub fn interleave(trees: Vec<Vec<BinaryNode>>) -> Vec<BinaryNode> {
    let trees: Vec<_> = trees.into_iter().filter(|nodes| !nodes.is_empty()).collect();
    if trees.len() <= 1 {
        return join(trees);
    }
    let all: usize = trees.iter().map(|nodes| leaves(nodes.len())).sum();
    let mut pieces = Vec::new();
    for (tree, nodes) in trees.iter().enumerate() {
        let own = leaves(nodes.len());
        let most = (own / (PIECES * (all - own))).max(1);
        cut(nodes, Piece { tree, from: 0, to: nodes.len() }, most, &mut pieces);
    }
    let item = |(index, piece): (u32, &Piece)| Item::new(&trees[piece.tree][piece.from].bounds, index);
    let over = BinaryTree::build((0..).zip(&pieces).map(item).collect(), Kind::Instance, 1);
    let mut made = Vec::with_capacity(trees.iter().map(Vec::len).sum::<usize>() + trees.len());
    let deepest = Splice { trees: &trees, pieces: &pieces, over: &over }.write(0, 0, &mut made);
    if deepest > DEEPEST { join(trees) } else { made }
}

/// Of a binary tree of so many nodes.
fn leaves(nodes: usize) -> usize {
    nodes.div_ceil(2)
}

/// Cuts a subtree into pieces of at most so many leaves.
fn cut(nodes: &[BinaryNode], piece: Piece, most: usize, pieces: &mut Vec<Piece>) {
    let node = &nodes[piece.from];
    match node.content {
        Content::Inner { right } if !node.sealed && leaves(piece.to - piece.from) > most => {
            let middle = piece.from + right as usize;
            cut(nodes, Piece { from: piece.from + 1, to: middle, ..piece }, most, pieces);
            cut(nodes, Piece { from: middle, ..piece }, most, pieces);
        }
        _ => pieces.push(piece),
    }
}

/// Puts the pieces in the place of the leaves of the tree over them.
struct Splice<'a> {
    trees: &'a [Vec<BinaryNode>],
    pieces: &'a [Piece],
    over: &'a BinaryTree,
}

impl Splice<'_> {
    /// Writes the subtree at a node of the tree over the pieces; how deep it is at most.
    fn write(&self, node: usize, depth: u32, made: &mut Vec<BinaryNode>) -> u32 {
        match self.over.nodes[node].content {
            Content::Leaf { first, .. } => {
                let Piece { tree, from, to } = self.pieces[self.over.order[first as usize] as usize];
                let piece = &self.trees[tree][from..to];
                made.extend_from_slice(piece);
                depth + height(piece)
            }
            Content::Inner { right } => {
                let at = made.len();
                made.push(self.over.nodes[node]);
                let left = self.write(node + 1, depth + 1, made);
                made[at].content = Content::Inner { right: (made.len() - at) as u32 };
                left.max(self.write(node + right as usize, depth + 1, made))
            }
        }
    }
}

/// How many nodes are above the lowest leaf.
fn height(nodes: &[BinaryNode]) -> u32 {
    match nodes[0].content {
        Content::Leaf { .. } => 0,
        Content::Inner { right } => {
            let (left, right) = nodes[1..].split_at(right as usize - 1);
            1 + height(left).max(height(right))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::bounds::Bounds;
    use super::*;

    /// A row of boxes along x.
    fn row(kind: Kind, count: u32, at: f32) -> Vec<BinaryNode> {
        let bounds = |k: u32| Bounds::new([k as f32, at, 0.0], [k as f32 + 0.9, at + 0.9, 1.0]);
        BinaryTree::build((0..count).map(|k| Item::new(&bounds(k), k)).collect(), kind, 1).nodes
    }

    fn found(nodes: &[BinaryNode], kind: Kind) -> Vec<u32> {
        let of = |node: &BinaryNode| match node.content {
            Content::Leaf { kind: of, first, count: 1 } if of == kind => Some(first),
            _ => None,
        };
        let mut all: Vec<u32> = nodes.iter().filter_map(of).collect();
        all.sort_unstable();
        all
    }

    /// All leaves are there once, in boxes that hold them, beside each other where they lie beside each other.
    #[test]
    fn every_leaf_is_there_and_neighbours_are_near() {
        let trees = || vec![row(Kind::Triangles, 100, 0.0), Vec::new(), row(Kind::Shape, 100, 1.0)];
        let made = interleave(trees());
        assert_eq!(made.len(), 399);
        for kind in [Kind::Triangles, Kind::Shape] {
            assert_eq!(found(&made, kind), (0..100).collect::<Vec<_>>());
        }
        for (at, node) in made.iter().enumerate() {
            if let Content::Inner { right } = node.content {
                for child in [at + 1, at + right as usize] {
                    let (inner, outer) = (made[child].bounds, node.bounds);
                    assert!(outer.lower.cmple(inner.lower).all() && inner.upper.cmple(outer.upper).all());
                }
            }
        }
        // A ray across both rows in the middle goes one way down, and not two.
        let met = |nodes: &[BinaryNode]| {
            nodes.iter().filter(|node| node.bounds.lower.x <= 50.5 && node.bounds.upper.x >= 50.5).count()
        };
        assert!(met(&made) < met(&join(trees())), "{} {}", met(&made), met(&join(trees())));
    }

    /// A large tree beside a small one is cut into few pieces: its own order stays.
    #[test]
    fn a_large_tree_beside_a_leaf_stays_nearly_whole() {
        let (large, small) = (row(Kind::Triangles, 10_000, 0.0), row(Kind::Shape, 1, 0.5));
        let mut pieces = Vec::new();
        let most = leaves(large.len()) / PIECES;
        cut(&large, Piece { tree: 0, from: 0, to: large.len() }, most, &mut pieces);
        assert!(pieces.len() <= 4 * PIECES, "{}", pieces.len());
        let made = interleave(vec![large, small]);
        assert_eq!(found(&made, Kind::Triangles).len(), 10_000);
        assert_eq!(found(&made, Kind::Shape), [0]);
    }
}
