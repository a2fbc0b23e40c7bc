//! Which table has which name: the index of the tables of a TOML file that are too large to be searched one by one.

use crate::syntax::decode;
use crate::tape::Tape;
use crate::tree::{NOWHERE, Node};
use std::borrow::Cow;
use std::hash::{BuildHasher, RandomState};

/// A table, and the key of a value in it.
type Slot = (u32, u32);

const FREE: Slot = (NOWHERE, NOWHERE);

/// Open addressing over eight bytes a name; the names themselves stay in the text. The hash is seeded by chance, so that no file
/// can be made to collide.
#[derive(Debug, Default)]
pub(super) struct Names {
    slots: Vec<Slot>,
    used: usize,
    hash: RandomState,
}

/// The name that a key node stands for.
pub(super) fn name_of<'s>(text: &'s str, node: &Node) -> Cow<'s, str> {
    decode::toml_key(text.get(node.start as usize..node.end as usize).unwrap_or(""))
}

impl Names {
    /// Where a name of a table stands, or where it would.
    fn slot(&self, text: &str, nodes: &Tape<Node>, table: u32, name: &str) -> usize {
        let mask = self.slots.len() - 1;
        let mut at = self.hash.hash_one((table, name)) as usize & mask;
        loop {
            let (owner, key) = self.slots[at];
            let same = owner == table && nodes.get(key as usize).is_some_and(|node| name_of(text, &node) == name);
            if same || (owner, key) == FREE {
                return at;
            }
            at = (at + 1) & mask;
        }
    }

    /// The key of that name in a table.
    pub fn find(&self, text: &str, nodes: &Tape<Node>, table: u32, name: &str) -> Option<u32> {
        if self.slots.is_empty() {
            return None;
        }
        let slot = self.slots[self.slot(text, nodes, table, name)];
        (slot != FREE).then_some(slot.1)
    }

    /// Remembers a key of a table, unless the table has one of that name.
    pub fn insert(&mut self, text: &str, nodes: &Tape<Node>, table: u32, key: u32) {
        // At most seven of eight slots are taken.
        if self.used * 8 >= self.slots.len() * 7 {
            let grown = vec![FREE; (self.slots.len() * 2).max(64)];
            for (table, key) in std::mem::replace(&mut self.slots, grown) {
                if (table, key) != FREE {
                    let at = self.slot(text, nodes, table, &name_of(text, &nodes.at(key as usize)));
                    self.slots[at] = (table, key);
                }
            }
        }
        let at = self.slot(text, nodes, table, &name_of(text, &nodes.at(key as usize)));
        if self.slots[at] == FREE {
            self.slots[at] = (table, key);
            self.used += 1;
        }
    }
}
