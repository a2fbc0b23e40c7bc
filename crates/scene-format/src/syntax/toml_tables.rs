//! The tables of a TOML file while they are put together: headers may come in any order, the tape is written at the end.

use super::Sink;
use crate::codes;
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::decode;
use crate::tree::{Builder, Kind, Node};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

/// A key: its bytes in the text.
pub(super) type Key = Range<usize>;

/// How a table came to be, which says whether it may be continued.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Origin {
    /// By the header of a table inside it.
    Implied,
    /// By its own header.
    Header,
    /// By a dotted key.
    Dotted,
}

#[derive(Debug)]
enum Child {
    /// Nodes in the tape of values.
    Value(Range<usize>),
    Table(usize),
    /// `[[name]]`
    Tables(Vec<usize>),
    /// A syntax error stood here.
    Broken,
}

#[derive(Debug)]
struct Table<'s> {
    span: Range<usize>,
    origin: Origin,
    children: Vec<(Key, Child)>,
    /// Children by name, once there are many.
    index: HashMap<Cow<'s, str>, usize>,
}

/// Tables with more keys than this are searched by hashing.
const LINEAR_SEARCH: usize = 8;

/// All tables of one file.
#[derive(Debug)]
pub(super) struct Tables<'s> {
    text: &'s str,
    tables: Vec<Table<'s>>,
    /// Where the next `key = value` goes.
    current: usize,
}

const ROOT: usize = 0;

impl<'s> Tables<'s> {
    pub fn new(text: &'s str) -> Tables<'s> {
        let mut tables = Tables { text, tables: Vec::new(), current: ROOT };
        let first = text.len() - text.trim_start_matches('\u{feff}').trim_start().len();
        let line = text[first..].lines().next().unwrap_or("").trim_end().len();
        tables.table(first..first + line, Origin::Header);
        tables
    }

    fn table(&mut self, span: Range<usize>, origin: Origin) -> usize {
        self.tables.push(Table { span, origin, children: Vec::new(), index: HashMap::new() });
        self.tables.len() - 1
    }

    fn name(&self, key: &Key) -> Cow<'s, str> {
        let text: &'s str = self.text;
        decode::toml_key(text.get(key.clone()).unwrap_or(""))
    }

    fn find(&self, table: usize, key: &Key) -> Option<usize> {
        let name = self.name(key);
        let table = &self.tables[table];
        if table.children.len() <= LINEAR_SEARCH {
            table.children.iter().position(|(key, _)| !key.is_empty() && self.name(key) == name)
        } else {
            table.index.get(&name).copied()
        }
    }

    fn add(&mut self, table: usize, key: Key, child: Child) {
        let count = self.tables[table].children.len();
        if count == LINEAR_SEARCH {
            for position in 0..count {
                let name = self.name(&self.tables[table].children[position].0.clone());
                self.tables[table].index.entry(name).or_insert(position);
            }
        }
        if count >= LINEAR_SEARCH {
            let name = self.name(&key);
            self.tables[table].index.entry(name).or_insert(count);
        }
        self.tables[table].children.push((key, child));
    }

    /// Something that could not be read stands in the current table.
    pub fn add_broken(&mut self) {
        self.tables[self.current].children.push((0..0, Child::Broken));
    }

    /// `path = value` in the current table.
    pub fn add_value(&mut self, path: &[Key], value: Range<usize>, source: u16, sink: &mut Sink) {
        let Some((last, parents)) = path.split_last() else { return };
        let mut table = self.current;
        for key in parents {
            match self.find(table, key) {
                Some(position) => match self.tables[table].children[position].1 {
                    Child::Table(inner) => table = inner,
                    _ => {
                        self.conflict(key, table, position, source, sink);
                        return;
                    }
                },
                None => {
                    let inner = self.table(key.clone(), Origin::Dotted);
                    self.add(table, key.clone(), Child::Table(inner));
                    table = inner;
                }
            }
        }
        // A key that is there already is reported by the reader, for both syntaxes alike.
        self.add(table, last.clone(), Child::Value(value));
    }

    /// `[path]` or, with `many`, `[[path]]`, at `span`.
    pub fn header(&mut self, path: &[Key], many: bool, header: Range<usize>, source: u16, sink: &mut Sink) {
        // What follows a header in conflict is read, and goes nowhere.
        self.current = self.table(header.clone(), Origin::Header);
        let Some((last, parents)) = path.split_last() else {
            self.tables[ROOT].children.push((0..0, Child::Broken));
            return;
        };
        let detached = self.current;
        let mut table = ROOT;
        for key in parents {
            match self.find(table, key) {
                Some(position) => match &self.tables[table].children[position].1 {
                    Child::Table(inner) => table = *inner,
                    Child::Tables(all) => table = all.last().copied().unwrap_or(ROOT),
                    _ => return self.conflict(key, table, position, source, sink),
                },
                None => {
                    let inner = self.table(header.clone(), Origin::Implied);
                    self.add(table, key.clone(), Child::Table(inner));
                    table = inner;
                }
            }
        }
        let Some(position) = self.find(table, last) else {
            let child = if many { Child::Tables(vec![detached]) } else { Child::Table(detached) };
            return self.add(table, last.clone(), child);
        };
        let implied = match self.tables[table].children[position].1 {
            Child::Table(inner) if !many && self.tables[inner].origin == Origin::Implied => Some(inner),
            _ => None,
        };
        match (&mut self.tables[table].children[position].1, implied) {
            (Child::Tables(all), _) if many => all.push(detached),
            (_, Some(inner)) => {
                self.tables[inner].origin = Origin::Header;
                self.tables[inner].span = header;
                self.current = inner;
            }
            _ => self.conflict(last, table, position, source, sink),
        }
    }

    fn conflict(&mut self, key: &Key, table: usize, position: usize, source: u16, sink: &mut Sink) {
        let found = super::span(source, key.start, key.end);
        let name = self.name(key);
        let (before, child) = &self.tables[table].children[position];
        let before = super::span(source, before.start, before.end);
        let (message, hint) = match child {
            Child::Tables(_) => {
                (format!("`{name}` is a list of tables already"), format!("begin each of its items with [[{name}]]"))
            }
            Child::Table(_) => {
                (format!("the table `{name}` is written twice"), "put all its fields below the first header".to_owned())
            }
            _ => (
                format!("`{name}` has a value already and cannot be a table too"),
                "write it as one table, or remove one of the two".to_owned(),
            ),
        };
        sink.push(
            Diagnostic::error(codes::TABLE_CONFLICT, found, message).hint(hint).label(before, "first written here"),
        );
    }

    /// Writes the tape.
    pub fn emit(&self, values: &[Node], builder: &mut Builder) {
        self.emit_table(ROOT, values, builder);
    }

    fn emit_table(&self, index: usize, values: &[Node], builder: &mut Builder) {
        let table = &self.tables[index];
        let opened = builder.open(table.span.start);
        for (key, child) in &table.children {
            if let Child::Broken = child {
                builder.leaf(Kind::Broken, key.start, key.end);
                continue;
            }
            builder.leaf(Kind::Key, key.start, key.end);
            match child {
                Child::Value(range) => builder.nodes.extend_from_slice(&values[range.clone()]),
                Child::Table(inner) => self.emit_table(*inner, values, builder),
                Child::Tables(all) => {
                    let first = all.first().map_or(0..0, |&first| self.tables[first].span.clone());
                    let list = builder.open(first.start);
                    for &inner in all {
                        self.emit_table(inner, values, builder);
                    }
                    builder.close(list, Kind::List, first.end);
                }
                Child::Broken => {}
            }
        }
        builder.close(opened, Kind::Map, table.span.end);
    }
}

/// Puts the dotted keys of an inline table together: `{ a.b = 1, a.c = 2 }` becomes `{ a = { b = 1, c = 2 } }`.
/// On the tape a dotted key is a run of keys before one value.
pub(super) fn regroup(text: &str, builder: &mut Builder, opened: usize) {
    let nodes = builder.nodes.split_off(opened + 1);
    let mut entries = Vec::new();
    let mut at = 0;
    while at < nodes.len() {
        let keys = at;
        while nodes.get(at).is_some_and(|node| node.kind == Kind::Key) {
            at += 1;
        }
        let value = at;
        at += nodes.get(at).map_or(1, |node| node.size as usize);
        entries.push((&nodes[keys..value], &nodes[value..at.min(nodes.len())]));
    }
    emit_group(text, builder, &entries);
}

/// The keys before a value, and the value's nodes.
type Dotted<'n> = (&'n [Node], &'n [Node]);

fn emit_group(text: &str, builder: &mut Builder, entries: &[Dotted<'_>]) {
    let mut groups: Vec<(&[Node], Vec<Dotted<'_>>)> = Vec::new();
    let mut index: HashMap<Cow<'_, str>, usize> = HashMap::new();
    for &(path, value) in entries {
        let Some((first, tail)) = path.split_first().filter(|(_, tail)| !tail.is_empty()) else {
            groups.push((path, vec![(&[], value)]));
            continue;
        };
        let name = decode::toml_key(text.get(first.start as usize..first.end as usize).unwrap_or(""));
        let group = *index.entry(name).or_insert_with(|| {
            groups.push((&path[..1], Vec::new()));
            groups.len() - 1
        });
        if let Some((_, members)) = groups.get_mut(group) {
            members.push((tail, value));
        }
    }
    for (key, members) in groups {
        builder.nodes.extend_from_slice(key);
        match members.as_slice() {
            [([], value)] => builder.nodes.extend_from_slice(value),
            members => {
                let (start, end) = key.first().map_or((0, 0), |key| (key.start as usize, key.end as usize));
                let opened = builder.open(start);
                emit_group(text, builder, members);
                builder.close(opened, Kind::Map, end);
            }
        }
    }
}

/// A span of the whole range, for diagnostics.
pub(super) fn key_span(source: u16, key: &Key) -> Span {
    super::span(source, key.start, key.end)
}
