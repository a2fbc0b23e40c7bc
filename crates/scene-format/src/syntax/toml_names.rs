//! Which table has which name: the index of the tables of a TOML file that are too large to be searched one by one.

use crate::syntax::decode;
use crate::tape::Tape;
use crate::tree::Node;
use hashbrown::HashTable;
use std::borrow::Cow;
use std::hash::{BuildHasher, RandomState};

/// A table, and the key of a value in it.
type Slot = (u32, u32);

/// Parts of the index. Each grows by itself, so that never more than one of them is in memory twice, or half empty.
const PARTS: usize = 64;

/// Eight bytes a name; the names themselves stay in the text. The hash is seeded by chance, so that no file can be made
/// to collide.
#[derive(Debug, Default)]
pub(super) struct Names {
    parts: Vec<HashTable<Slot>>,
    hash: RandomState,
}

/// The name that a key node stands for.
pub(super) fn name_of<'s>(text: &'s str, node: &Node) -> Cow<'s, str> {
    decode::toml_key(text.get(node.start as usize..node.end as usize).unwrap_or(""))
}

/// Which part a hash belongs to, by bits that the parts themselves do not go by. The last part gets twice as many names
/// as the first, those between them more and more: parts double when they are full, and so do not all double at once.
fn part(hash: u64) -> usize {
    let fraction = (hash >> 32 & 0xff_ffff) as f64 / f64::from(1 << 24);
    ((1.0 + fraction).log2() * PARTS as f64) as usize
}

impl Names {
    /// The key of that name in a table.
    pub fn find(&self, text: &str, nodes: &Tape<Node>, table: u32, name: &str) -> Option<u32> {
        let hash = self.hash.hash_one((table, name));
        let same = |&(owner, key): &Slot| {
            owner == table && nodes.get(key as usize).is_some_and(|node| name_of(text, &node) == name)
        };
        self.parts.get(part(hash))?.find(hash, same).map(|&(_, key)| key)
    }

    /// Remembers a key of a table, unless the table has one of that name.
    pub fn insert(&mut self, text: &str, nodes: &Tape<Node>, table: u32, key: u32) {
        let name = name_of(text, &nodes.at(key as usize));
        if self.find(text, nodes, table, &name).is_some() {
            return;
        }
        let seeds = &self.hash;
        let hash = seeds.hash_one((table, &*name));
        self.parts.resize_with(PARTS, HashTable::new);
        if let Some(part) = self.parts.get_mut(part(hash)) {
            let again = |&(table, key): &Slot| seeds.hash_one((table, &*name_of(text, &nodes.at(key as usize))));
            part.insert_unique(hash, (table, key), again);
        }
    }
}
