//! The tables of a TOML file while they are put together on the tape. Headers may come in any order, and a table may be
//! gone on with after others: then what comes stands in an `Added` node (see `tree`).

use super::Sink;
use super::toml_names::{Names, name_of};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::tape::Tape;
use crate::tree::{Builder, Kind, NOWHERE, Node};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// A key: its bytes in the text.
pub(super) type Key = Range<usize>;

/// Tables with more keys than this are searched by hashing.
const LINEAR_SEARCH: usize = 8;

/// The table that is the file.
const ROOT: u32 = 0;

/// Tables that only the names of others imply, as `a` and `b` of `[a.b.c]`: so many are always allowed.
const FREE_IMPLIED: usize = 1 << 16;
/// Beyond that, one for so many bytes of the file. Two letters, `.a`, make a table; a file of them would take thirty
/// times its size. The densest that means something is `Mesh.material.Diffuse.albedo.Texture.file = ".."` below
/// `[[objects]]`.
const BYTES_PER_IMPLIED: usize = 9;

/// A node of the tape that is not closed yet, and the table that is being written in it: the node itself, or the one
/// that an `Added` node belongs to.
#[derive(Clone, Copy, Debug)]
struct Open {
    node: u32,
    table: u32,
}

/// All tables of one file.
#[derive(Debug)]
pub(super) struct Tables<'s> {
    text: &'s str,
    /// Where the next `key = value` goes.
    current: u32,
    /// From the root inwards.
    open: Vec<Open>,
    names: Names,
    /// The first and the last `Added` node of tables that have some.
    added: HashMap<u32, (u32, u32)>,
    implied: usize,
    /// Tables that a `[[header]]` of the same name came after, which was told once.
    one_for_many: HashSet<u32>,
    /// The key of the last `[[header]]` without points: mostly the next one has the same name.
    last_list: u32,
    /// All lists of tables.
    lists: Vec<u32>,
}

/// An inline table whose keys have dots, as deep in `Tables::open`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inline(usize);

impl<'s> Tables<'s> {
    /// Begins the file's table.
    pub fn new(text: &'s str, builder: &mut Builder) -> Tables<'s> {
        let first = text.len() - text.trim_start_matches('\u{feff}').trim_start().len();
        let line = text[first..].lines().next().unwrap_or("").trim_end().len();
        let root = builder.open_as(Kind::HeaderTable, first, first + line) as u32;
        let open = vec![Open { node: root, table: root }];
        Tables {
            text,
            current: ROOT,
            open,
            names: Names::default(),
            added: HashMap::new(),
            implied: 0,
            one_for_many: HashSet::new(),
            last_list: NOWHERE,
            lists: Vec::new(),
        }
    }

    /// Ends the file's table; gives the first `Added` node of each table that has some.
    pub fn finish(mut self, builder: &mut Builder) -> HashMap<u32, u32> {
        self.close(0, builder);
        for index in std::mem::take(&mut self.lists) {
            // While it was put together, it said where its last table is. It has the place of its first.
            let first = builder.nodes.at(index as usize + 1);
            builder.nodes.at_mut(index as usize).end = first.end;
        }
        self.added.into_iter().map(|(table, (first, _))| (table, first)).collect()
    }

    /// Closes all nodes that are open but the outermost `keep`.
    fn close(&mut self, keep: usize, builder: &mut Builder) {
        for open in self.open.drain(keep..) {
            builder.nodes.at_mut(open.node as usize).size = builder.nodes.len() as u32 - open.node;
        }
    }

    /// Makes the end of the tape the place where `table` is written; it lies in the open node of number `floor`.
    fn reach(&mut self, table: u32, floor: usize, builder: &mut Builder) {
        if let Some(at) = self.open[floor..].iter().rposition(|open| open.table == table) {
            return self.close(floor + at + 1, builder);
        }
        self.close(floor + 1, builder);
        let node = builder.open_as(Kind::Added, NOWHERE as usize, 0) as u32;
        let (_, last) = self.added.entry(table).or_insert((node, NOWHERE));
        let before = std::mem::replace(last, node);
        if before != NOWHERE {
            builder.nodes.at_mut(before as usize).start = node;
        }
        self.open.push(Open { node, table });
    }

    /// Begins a node that holds what nobody will read.
    fn detached(&mut self, builder: &mut Builder) -> u32 {
        self.close(1, builder);
        let node = builder.open_as(Kind::Added, NOWHERE as usize, 0) as u32;
        self.open.push(Open { node, table: node });
        node
    }

    fn table(&mut self, kind: Kind, span: &Range<usize>, builder: &mut Builder) -> u32 {
        let node = builder.open_as(kind, span.start, span.end) as u32;
        self.open.push(Open { node, table: node });
        node
    }

    /// Counts a table that has no header; `false` when there are more than any scene has.
    fn may_imply(&mut self, key: &Key, source: u16, sink: &mut Sink) -> bool {
        self.implied += 1;
        let few = self.implied <= FREE_IMPLIED + self.text.len() / BYTES_PER_IMPLIED;
        if !few && !sink.is_full() {
            let found = key_span(source, key);
            sink.push_last(
                Diagnostic::error(
                    codes::TOO_LARGE,
                    found,
                    "names joined by points make more tables here than any scene has",
                )
                .expected("names of the language, as camera.fov")
                .hint("a scene needs one such table for each of its objects, or a few more"),
            );
        }
        few
    }

    /// The keys of a table in order.
    fn keys<'n>(&self, nodes: &'n Tape<Node>, table: u32) -> Keys<'n> {
        let added = self.added.get(&table).map_or(NOWHERE, |&(first, _)| first);
        Keys { nodes, index: table as usize + 1, end: end_of(nodes, table as usize), added }
    }

    fn find(&self, nodes: &Tape<Node>, table: u32, key: &Key) -> Option<u32> {
        let text = self.text;
        let name = crate::syntax::decode::toml_key(text.get(key.clone()).unwrap_or(""));
        let mut keys = self.keys(nodes, table);
        let near = keys.by_ref().take(LINEAR_SEARCH).find(|&key| name_of(text, &nodes.at(key as usize)) == name);
        near.or_else(|| keys.next().and_then(|_| self.names.find(text, nodes, table, &name)))
    }

    /// Writes a key of `table`, whose value comes next.
    fn key(&mut self, table: u32, key: &Key, builder: &mut Builder) {
        let before = self.keys(&builder.nodes, table).take(LINEAR_SEARCH + 1).count();
        let added = builder.nodes.len() as u32;
        if before == LINEAR_SEARCH {
            let first: Vec<u32> = self.keys(&builder.nodes, table).collect();
            first.into_iter().for_each(|key| self.names.insert(self.text, &builder.nodes, table, key));
        }
        builder.leaf(Kind::Key, key.start, key.end);
        if before >= LINEAR_SEARCH {
            self.names.insert(self.text, &builder.nodes, table, added);
        }
    }

    /// Something that could not be read stands in the current table.
    pub fn add_broken(&mut self, builder: &mut Builder) {
        self.reach(self.current, 0, builder);
        builder.leaf(Kind::Broken, 0, 0);
    }

    /// `path =` in the current table: the value comes next.
    pub fn begin_value(&mut self, path: &[Key], builder: &mut Builder, sink: &mut Sink) {
        if !self.enter(self.current, 0, path, builder, sink) {
            self.detached(builder);
        }
    }

    /// Keys of the inline table that begins at `node` have dots from here on.
    pub fn open_inline(&mut self, node: usize) -> Inline {
        self.open.push(Open { node: node as u32, table: node as u32 });
        Inline(self.open.len() - 1)
    }

    /// `path =` in an inline table: the value comes next.
    pub fn begin_inline_value(&mut self, inline: Inline, path: &[Key], builder: &mut Builder, sink: &mut Sink) {
        let Some(table) = self.open.get(inline.0).map(|open| open.table) else { return };
        if !self.enter(table, inline.0, path, builder, sink) {
            self.close(inline.0 + 1, builder);
            let node = builder.open_as(Kind::Added, NOWHERE as usize, 0) as u32;
            self.open.push(Open { node, table: node });
        }
    }

    /// What comes next stands in the inline table itself.
    pub fn reach_inline(&mut self, inline: Inline, builder: &mut Builder) {
        self.close(inline.0 + 1, builder);
    }

    /// Ends what stands in an inline table, and the table.
    pub fn close_inline(&mut self, inline: Inline, builder: &mut Builder) {
        self.close(inline.0, builder);
    }

    /// Goes down a path from `table` and writes its last key; `false` when that cannot be, which is reported.
    fn enter(&mut self, mut table: u32, floor: usize, path: &[Key], builder: &mut Builder, sink: &mut Sink) -> bool {
        let Some((last, parents)) = path.split_last() else { return false };
        for key in parents {
            match self.find(&builder.nodes, table, key) {
                Some(found) if is_table(&builder.nodes, found + 1) => table = found + 1,
                Some(found) => {
                    self.conflict(key, found, builder, sink);
                    return false;
                }
                None if !self.may_imply(key, builder.source, sink) => return false,
                None => {
                    self.reach(table, floor, builder);
                    self.key(table, key, builder);
                    table = self.table(Kind::DottedTable, key, builder);
                }
            }
        }
        // A key that is there already is reported by the reader, for both syntaxes alike.
        self.reach(table, floor, builder);
        self.key(table, last, builder);
        true
    }

    /// `[path]` or, with `many`, `[[path]]`, at `header`.
    pub fn header(&mut self, path: &[Key], many: bool, header: &Range<usize>, builder: &mut Builder, sink: &mut Sink) {
        // What follows a header in conflict is read, and goes nowhere.
        self.current = match self.headed(path, many, header, builder, sink) {
            Some(table) => table,
            None => self.detached(builder),
        };
    }

    fn headed(
        &mut self,
        path: &[Key],
        many: bool,
        header: &Range<usize>,
        builder: &mut Builder,
        sink: &mut Sink,
    ) -> Option<u32> {
        let Some((last, parents)) = path.split_last() else {
            self.reach(ROOT, 0, builder);
            builder.leaf(Kind::Broken, 0, 0);
            return None;
        };
        let alone = if many { None } else { self.kind_alone(&path[0], parents.is_empty(), builder, sink) };
        let table = self.parent(alone.unwrap_or(ROOT), parents, header, builder, sink)?;
        let alone = many && table == ROOT && parents.is_empty();
        let again = alone && self.is_last_list(last, builder);
        let found = if again { Some(self.last_list) } else { self.find(&builder.nodes, table, last) };
        self.last_list = found.filter(|_| alone).unwrap_or(NOWHERE);
        let Some(found) = found else {
            self.reach(table, 0, builder);
            self.key(table, last, builder);
            return Some(if many {
                let list = self.table(Kind::TableList, header, builder);
                self.lists.push(list);
                self.item(list, header, builder)
            } else {
                self.table(Kind::HeaderTable, header, builder)
            });
        };
        let value = found + 1;
        match builder.nodes.at(value as usize).kind {
            Kind::TableList if many => {
                self.reach(value, 0, builder);
                Some(self.item(value, header, builder))
            }
            Kind::TableList => {
                // [objects] where [[objects]] was meant: told, and taken for it.
                self.conflict(last, found, builder, sink);
                if let Some(fault) = sink.diagnostics.last_mut().filter(|fault| fault.code == codes::TABLE_CONFLICT) {
                    let span = super::span(builder.source, header.start, header.end);
                    let text = self.text.get(header.clone()).unwrap_or("");
                    fault.edit = Some(Edit { span, replacement: format!("[{text}]") });
                }
                self.reach(value, 0, builder);
                Some(self.item(value, header, builder))
            }
            Kind::ImpliedTable if !many => {
                let node = builder.nodes.at_mut(value as usize);
                node.kind = Kind::HeaderTable;
                (node.start, node.end) = (header.start as u32, header.end as u32);
                Some(value)
            }
            kind => {
                // Of a list whose first header lacks its second brackets, all the others would be told.
                let first = !many || kind != Kind::HeaderTable || self.one_for_many.insert(value);
                if first {
                    self.conflict(last, found, builder, sink);
                }
                None
            }
        }
    }

    /// The table that the last name of a header is of: goes down the names before that from `table`, and makes tables
    /// that are not there. `None`: one of them is no table, or there are too many, which has been reported.
    fn parent(
        &mut self,
        mut table: u32,
        names: &[Key],
        header: &Range<usize>,
        builder: &mut Builder,
        sink: &mut Sink,
    ) -> Option<u32> {
        for key in names {
            match self.find(&builder.nodes, table, key) {
                Some(found) if self.one_for_many.contains(&(found + 1)) => return None,
                Some(found) if is_table(&builder.nodes, found + 1) => table = found + 1,
                Some(found) if builder.nodes.at(found as usize + 1).kind == Kind::TableList => {
                    table = builder.nodes.at(found as usize + 1).end;
                }
                Some(found) => {
                    self.conflict(key, found, builder, sink);
                    return None;
                }
                None if !self.may_imply(key, builder.source, sink) => return None,
                None => {
                    self.reach(table, 0, builder);
                    self.key(table, key, builder);
                    table = self.table(Kind::ImpliedTable, header, builder);
                }
            }
        }
        Some(table)
    }

    /// `[Box]` right after `[[objects]]`, or `[Box.material]` after both: the item of the list, for which it is taken;
    /// it is told.
    fn kind_alone(&self, key: &Key, last: bool, builder: &mut Builder, sink: &mut Sink) -> Option<u32> {
        let of_kind = |key: &Key| self.text.get(key.start..).is_some_and(|key| key.starts_with(char::is_uppercase));
        let item = self.lists.last().filter(|_| of_kind(key)).map(|list| builder.nodes.at(*list as usize).end)?;
        let node = builder.nodes.at(item as usize);
        let list = self.text.get(node.start as usize..node.end as usize)?.trim_matches(['[', ']', ' ', '\t']);
        let begins = last && self.current == item;
        let goes_on = !last && self.find(&builder.nodes, item, key).is_some();
        if !(begins || goes_on) || list.contains('.') || self.find(&builder.nodes, ROOT, key).is_some() {
            return None;
        }
        let kind = self.text.get(key.clone()).unwrap_or("");
        let (found, mended) = (key_span(builder.source, key), format!("{list}.{kind}"));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, found, format!("`{kind}` stands outside of [[{list}]]"))
            .expected(format!("[{list}.{kind}]"))
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        sink.push(fault);
        Some(item)
    }

    /// Whether a key of the file's table is spelt like that of the `[[list]]` before.
    fn is_last_list(&self, key: &Key, builder: &Builder) -> bool {
        let spelt = |key: &Key| self.text.as_bytes().get(key.clone());
        let last = builder.nodes.get(self.last_list as usize);
        last.is_some_and(|node| spelt(key) == spelt(&(node.start as usize..node.end as usize)))
    }

    /// The next table of a `[[list]]` that has been reached.
    fn item(&mut self, list: u32, header: &Range<usize>, builder: &mut Builder) -> u32 {
        let item = self.table(Kind::HeaderTable, header, builder);
        builder.nodes.at_mut(list as usize).end = item;
        item
    }

    fn conflict(&mut self, key: &Key, found: u32, builder: &mut Builder, sink: &mut Sink) {
        let before = builder.nodes.at(found as usize);
        let name = name_of(self.text, &before);
        let (message, hint) = match builder.nodes.at(found as usize + 1).kind {
            Kind::TableList => {
                (format!("`{name}` is a list of tables already"), format!("begin each of its items with [[{name}]]"))
            }
            Kind::ImpliedTable | Kind::HeaderTable | Kind::DottedTable => {
                (format!("the table `{name}` is written twice"), "put all its fields below the first header".to_owned())
            }
            _ => (
                format!("`{name}` has a value already and cannot be a table too"),
                "write it as one table, or remove one of the two".to_owned(),
            ),
        };
        let before = key_span(builder.source, &(before.start as usize..before.end as usize));
        sink.push(
            Diagnostic::error(codes::TABLE_CONFLICT, key_span(builder.source, key), message)
                .hint(hint)
                .label(before, "first written here"),
        );
        // What is to be a table is told no more for what it is instead.
        let value = builder.nodes.at_mut(found as usize + 1);
        if matches!(value.kind, Kind::Text | Kind::Integer | Kind::Float | Kind::Bool) {
            value.kind = Kind::Broken;
        }
    }
}

fn is_table(nodes: &Tape<Node>, index: u32) -> bool {
    let kind = nodes.get(index as usize).map(|node| node.kind);
    matches!(kind, Some(Kind::ImpliedTable | Kind::HeaderTable | Kind::DottedTable))
}

/// One past the subtree of a node that may be open.
fn end_of(nodes: &Tape<Node>, index: usize) -> usize {
    match nodes.get(index).map_or(0, |node| node.size as usize) {
        0 => nodes.len(),
        size => index + size,
    }
}

/// The keys of a table that may be open.
struct Keys<'n> {
    nodes: &'n Tape<Node>,
    index: usize,
    end: usize,
    added: u32,
}

impl Iterator for Keys<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        loop {
            if self.index >= self.end {
                let added = self.added as usize;
                self.added = self.nodes.get(added)?.start;
                (self.index, self.end) = (added + 1, end_of(self.nodes, added));
                continue;
            }
            let index = self.index;
            if self.nodes.get(index)?.kind == Kind::Key {
                // Past the key and its value.
                self.index = end_of(self.nodes, index + 1);
                return Some(index as u32);
            }
            self.index = end_of(self.nodes, index);
        }
    }
}

/// A span of the whole range, for diagnostics.
pub(super) fn key_span(source: u16, key: &Key) -> Span {
    super::span(source, key.start, key.end)
}

#[cfg(test)]
mod tests {
    use crate::syntax::parse;
    use crate::syntax::{Sink, Syntax};
    use crate::tree::{Item, Kind};
    use toml::Value;

    fn value(item: Item<'_, '_>) -> Value {
        match item.kind() {
            Kind::Map => {
                let fields: Vec<_> =
                    item.fields().map(|(key, inner)| (key.text().into_owned(), value(inner))).collect();
                let count = fields.len();
                let table: toml::Table = fields.into_iter().collect();
                // A name that stands twice is for the reader to report.
                if table.len() < count { Value::String("twice".to_owned()) } else { Value::Table(table) }
            }
            Kind::List => Value::Array(item.children().map(value).collect()),
            Kind::Integer => Value::Integer(item.number().unwrap_or(f64::NAN) as i64),
            // A value that would have to be a table.
            Kind::Broken => Value::String("broken".to_owned()),
            other => panic!("{other:?} was not written"),
        }
    }

    /// A generator of random numbers that is enough for a test (Knuth's MMIX constants).
    fn below(state: &mut u64, count: u64) -> u64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 33) % count
    }

    fn path(state: &mut u64, names: u64) -> String {
        let name = |state: &mut u64| char::from(b'a' + below(state, names) as u8).to_string();
        (0..1 + below(state, 3)).map(|_| name(state)).collect::<Vec<_>>().join(".")
    }

    fn written(state: &mut u64, names: u64, depth: u64) -> String {
        match below(state, 4 + depth) {
            0 if depth < 3 => {
                let entries = (0..below(state, 5)).map(|_| {
                    let key = path(state, names);
                    format!("{key} = {}", written(state, names, depth + 1))
                });
                format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
            }
            1 if depth < 3 => {
                let items: Vec<String> = (0..below(state, 3)).map(|_| written(state, names, depth + 1)).collect();
                format!("[{}]", items.join(", "))
            }
            _ => below(state, 100).to_string(),
        }
    }

    /// Tables in any order, gone on with after others, in braces and by dotted keys: what the `toml` crate takes is
    /// read without a fault and as the same values, also when the tape has been made flat for `--set`.
    #[test]
    fn tables_are_those_of_the_toml_crate() {
        let mut state = 7;
        let (mut taken, mut apart) = (0, 0);
        for round in 0..6000 {
            let names = 2 + below(&mut state, 18);
            let mut text = String::new();
            for _ in 0..2 + below(&mut state, 24) {
                let path = path(&mut state, names);
                text += &match below(&mut state, 5) {
                    0 => format!("[{path}]\n"),
                    1 => format!("[[{path}]]\n"),
                    _ => format!("{path} = {}\n", written(&mut state, names, 0)),
                };
            }
            let oracle = toml::from_str::<Value>(&text);
            let mut sink = Sink::default();
            let mut tree = parse(&text, Syntax::Toml, &mut sink);
            let right = sink.errors == 0;
            let read = tree.root().map(value);
            // The crate lets a dotted key go on with the last table of a [[list]], which TOML does not.
            let lenient = sink.diagnostics.iter().all(|fault| fault.message.ends_with("is a list of tables already"));
            if let Ok(oracle) = &oracle
                && (right || !lenient)
            {
                assert!(right, "{round}: {:?}\n{text}", sink.diagnostics);
                assert_eq!(read.as_ref(), Some(oracle), "{round}\n{text}");
                taken += 1;
                apart += usize::from(!tree.added.is_empty());
            }
            tree.flatten();
            assert!(tree.added.is_empty());
            assert_eq!(tree.root().map(value), read, "{round}\n{text}");
        }
        // Enough of them must be right, and enough in an order that needs `Added` nodes.
        assert!(taken > 1000 && apart > 100, "{taken} right, {apart} with tables gone on with");
    }
}
