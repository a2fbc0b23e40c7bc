//! The spanned syntax tree: one tree type for all syntaxes, before any word of it has a meaning.
//!
//! The tree is a tape of 16-byte nodes in the order of writing (a node is followed by its children), so that reading a
//! scene of 10^5 objects allocates nothing per node. Nodes hold positions only; names, numbers and texts are read from
//! the source text when somebody asks.
//!
//! TOML may go on with a table after others were written. What comes later stands in an `Added` node where it was
//! written: it belongs not to the node around it but to the table that `added` names, after what that table has
//! already.

use crate::diagnostic::Span;
use crate::syntax::{Syntax, decode};
use crate::tape::Tape;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A syntax error was reported here; nobody may complain again.
    Broken,
    /// `true` or `false`.
    Bool,
    /// A whole number.
    Integer,
    /// A number with a point or an exponent, `inf` or `NaN`.
    Float,
    /// A quoted text.
    Text,
    /// `'c'` in RON.
    Char,
    /// A date or time in TOML.
    Date,
    /// A bare word in RON: `None`, `Bvh`; `null` in JSON.
    Word,
    /// `[a, b]`.
    List,
    /// `(a, b)`, `()`, `Name(a, b)` and `Name()`.
    Tuple,
    /// `(a: 1)` and `Name(a: 1)`: keys and values in turn.
    Struct,
    /// `{ "k": v }`, in RON and JSON, and tables of TOML: keys and values in turn.
    Map,
    /// The key of the value that follows.
    Key,
    /// A table of TOML that a header of a table inside it made; to readers a `Map`, like the next two.
    ImpliedTable,
    /// A table of TOML that its own header made.
    HeaderTable,
    /// A table of TOML that a dotted key made.
    DottedTable,
    /// `[[name]]` in TOML; to readers a `List`.
    TableList,
    /// What belongs to a table elsewhere; `start` is the next node of this kind for the same table. Readers never see
    /// it.
    Added,
}

/// The source of nodes whose spans point nowhere: those of a description that serde gives.
pub(crate) const NO_SOURCE: u16 = u16::MAX;

/// In place of an index: there is none.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// One entry of the tape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub start: u32,
    pub end: u32,
    /// Nodes in this subtree, this one included; 0 while it is open: then it goes to the end of the tape.
    pub size: u32,
    pub source: u16,
    pub kind: Kind,
}

/// A text that nodes point into.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text<'s> {
    pub text: &'s str,
    pub syntax: Syntax,
    /// Where paths in it start, relative to the scene's folder.
    pub folder: &'s Path,
}

/// An included file among the nodes.
#[derive(Clone, Debug)]
pub(crate) struct Root {
    /// Relative to the scene's folder.
    pub path: Arc<Path>,
    /// As messages name it.
    pub name: String,
    /// Its first node; `NOWHERE` where it has none.
    pub root: u32,
    /// How many it has.
    pub nodes: u32,
    /// Why it could not be read.
    pub fault: Option<String>,
}

/// A whole file (and the arguments of `--set` grafted into it) as a tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree<'s> {
    pub texts: Vec<Text<'s>>,
    pub nodes: Tape<Node>,
    /// Tables that were gone on with, and the first `Added` node of each.
    pub added: HashMap<u32, u32>,
    /// Comments of the scene file in order of writing.
    pub comments: Tape<Span>,
    /// Whether a `Broken` node stands anywhere.
    pub damaged: bool,
    /// Included files, whose nodes stand after the scene's.
    pub included: Vec<Root>,
    /// The moment that it is read at: so large a share of a frame after the frame's beginning.
    pub share: f64,
}

impl<'s> Tree<'s> {
    /// A node by its place on the tape.
    pub fn item(&self, index: usize) -> Option<Item<'_, 's>> {
        self.nodes.get(index).map(|node| Item { tree: self, index, node })
    }

    /// The root, when anything was read.
    pub fn root(&self) -> Option<Item<'_, 's>> {
        self.nodes.get(0).map(|node| Item { tree: self, index: 0, node })
    }

    /// Puts everything below the node that it belongs to, so that the tape can be edited.
    pub fn flatten(&mut self) {
        if self.added.is_empty() {
            return;
        }
        let mut nodes = Tape::default();
        if let Some(root) = self.root() {
            root.copy_to(&mut nodes);
        }
        self.nodes = nodes;
        self.added.clear();
    }
}

/// Writes a tape in order.
#[derive(Debug, Default)]
pub(crate) struct Builder {
    pub nodes: Tape<Node>,
    pub source: u16,
}

impl Builder {
    /// A builder of an empty tape for the text `source`.
    pub fn new(source: u16) -> Builder {
        Builder { nodes: Tape::default(), source }
    }

    pub fn leaf(&mut self, kind: Kind, start: usize, end: usize) {
        self.nodes.push(Node { start: start as u32, end: end as u32, size: 1, source: self.source, kind });
    }

    /// Begins a node with children; `close` ends it.
    pub fn open(&mut self, start: usize) -> usize {
        self.open_as(Kind::Broken, start, start)
    }

    /// As `open`, for a node whose kind and span are known.
    pub fn open_as(&mut self, kind: Kind, start: usize, end: usize) -> usize {
        self.nodes.push(Node { start: start as u32, end: end as u32, size: 0, source: self.source, kind });
        self.nodes.len() - 1
    }

    /// Whether all subtrees end within those around them.
    pub fn is_nested(&self) -> bool {
        let mut around = vec![self.nodes.len()];
        self.nodes.iter().enumerate().all(|(index, node)| {
            while around.len() > 1 && around.last().is_some_and(|&end| end <= index) {
                around.pop();
            }
            let end = index + node.size as usize;
            let within = node.size > 0 && around.last().is_some_and(|&outer| end <= outer);
            around.push(end);
            within
        })
    }

    pub fn close(&mut self, opened: usize, kind: Kind, end: usize) {
        let size = (self.nodes.len() - opened) as u32;
        if let Some(node) = self.nodes.get_mut(opened) {
            node.size = size;
            node.kind = kind;
            node.end = end as u32;
        }
    }
}

/// A node in its tree.
#[derive(Clone, Copy)]
pub(crate) struct Item<'t, 's> {
    tree: &'t Tree<'s>,
    index: usize,
    node: Node,
}

/// ASCII characters that names are made of. A table: names are looked for a dozen times an object.
static IN_NAMES: [bool; 256] = {
    let mut table = [false; 256];
    let mut byte = 0u8;
    while byte < 128 {
        table[byte as usize] = byte.is_ascii_alphanumeric() || byte == b'_';
        byte += 1;
    }
    table
};

impl<'t, 's> Item<'t, 's> {
    /// Where the node stands on the tape.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Another node of the tree; `None` for `NOWHERE`.
    #[inline]
    pub fn other(&self, index: u32) -> Option<Item<'t, 's>> {
        let index = index as usize;
        (index != NOWHERE as usize).then(|| Item { tree: self.tree, index, node: self.tree.nodes.at(index) })
    }

    pub fn kind(&self) -> Kind {
        match self.node.kind {
            Kind::ImpliedTable | Kind::HeaderTable | Kind::DottedTable => Kind::Map,
            Kind::TableList => Kind::List,
            kind => kind,
        }
    }

    pub fn span(&self) -> Span {
        let node = self.node;
        if node.source == NO_SOURCE {
            return Span::NONE;
        }
        Span { source: u32::from(node.source), start: node.start, end: node.end }
    }

    /// Writes the subtree to the end of a tape, without `Added` nodes.
    fn copy_to(&self, nodes: &mut Tape<Node>) {
        let at = nodes.len();
        nodes.push(Node { kind: self.kind(), ..self.node });
        for child in self.children() {
            child.copy_to(nodes);
        }
        nodes.at_mut(at).size = (nodes.len() - at) as u32;
    }

    /// The text that it stands in.
    #[inline]
    fn source(&self) -> &'t Text<'s> {
        let texts = &self.tree.texts;
        match texts.get(usize::from(self.node.source)) {
            Some(text) => text,
            None => &texts[0],
        }
    }

    pub fn syntax(&self) -> Syntax {
        self.source().syntax
    }

    /// Where paths in its file start, relative to the scene's folder.
    pub fn folder(&self) -> &'s Path {
        self.source().folder
    }

    /// An included file by its path from the scene's folder.
    pub fn included(&self, path: &Path) -> Option<&'t Root> {
        self.tree.included.iter().find(|file| *file.path == *path)
    }

    /// How many files are included.
    pub fn included_files(&self) -> usize {
        self.tree.included.len()
    }

    /// The texts that stand in it, however deep; it may be one itself. What is added to lists from outside is not among
    /// them.
    pub fn texts(&self) -> impl Iterator<Item = Item<'t, 's>> {
        let (tree, index) = (self.tree, self.index);
        let all = (index..index + self.node.size as usize).filter_map(move |index| tree.item(index));
        all.filter(|item| item.kind() == Kind::Text)
    }

    /// What stands between two bytes of its text.
    pub fn text_between(&self, start: usize, end: usize) -> Option<&'s str> {
        let text: &'s str = self.source().text;
        text.get(start..end)
    }

    /// The node as it was written.
    pub fn lexeme(&self) -> &'s str {
        let node = self.node;
        let text: &'s str = self.source().text;
        text.get(node.start as usize..node.end as usize).unwrap_or("")
    }

    /// `Name` of `Name(..)`.
    pub fn name(&self) -> Option<&'s str> {
        if !matches!(self.kind(), Kind::Tuple | Kind::Struct) {
            return None;
        }
        let lexeme = self.lexeme();
        let bytes = lexeme.as_bytes();
        let plain = bytes.iter().position(|byte| !IN_NAMES[usize::from(*byte)]).unwrap_or(bytes.len());
        let end = match bytes.get(plain) {
            Some(byte) if !byte.is_ascii() => {
                lexeme.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(lexeme.len())
            }
            _ => plain,
        };
        (end > 0).then(|| &lexeme[..end])
    }

    /// The value in `Some(value)`, for fields that may be `None`; RON writes them so.
    pub fn without_some(self) -> Item<'t, 's> {
        if self.kind() == Kind::Tuple && self.name() == Some("Some") {
            let mut children = self.children();
            if let (Some(only), None) = (children.next(), children.next()) {
                return only;
            }
        }
        self
    }

    /// Whether it is the word `name`: `name` in RON, `"name"` in TOML and JSON, where `null` is `None`.
    pub fn is_word(&self, name: &str) -> bool {
        match self.kind() {
            Kind::Word => self.lexeme() == name || name == "None" && self.is_null(),
            Kind::Text => self.syntax() != Syntax::Ron && self.text() == name,
            _ => false,
        }
    }

    /// Whether it is the `null` of JSON.
    pub fn is_null(&self) -> bool {
        self.kind() == Kind::Word && self.syntax() == Syntax::Json
    }

    /// What to underline when the node as a whole is meant: its name, its opening bracket, or the whole of a leaf.
    pub fn head(&self) -> Span {
        let mut span = self.span();
        match self.kind() {
            Kind::Tuple | Kind::Struct | Kind::List | Kind::Map => {
                let lexeme = self.lexeme();
                if let Some(name) = self.name() {
                    span.end = span.start + name.len() as u32;
                } else if lexeme.contains('\n') || self.index == 0 {
                    let line = lexeme.lines().next().unwrap_or("").trim_end();
                    span.end = span.start + line.len().max(usize::from(!lexeme.is_empty())) as u32;
                }
            }
            _ => {}
        }
        span
    }

    /// The text of a key or a quoted text.
    pub fn text(&self) -> Cow<'s, str> {
        match (self.kind(), self.syntax()) {
            (Kind::Key | Kind::Text | Kind::Char, Syntax::Ron) => decode::ron_text(self.lexeme()),
            (Kind::Key, Syntax::Toml) => decode::toml_key(self.lexeme()),
            (Kind::Text, Syntax::Toml) => decode::toml_text(self.lexeme()),
            (Kind::Key | Kind::Text, Syntax::Json) => decode::json_text(self.lexeme()),
            _ => Cow::Borrowed(self.lexeme()),
        }
    }

    /// The value of a number.
    pub fn number(&self) -> Option<f64> {
        matches!(self.kind(), Kind::Integer | Kind::Float).then(|| decode::number(self.lexeme()))
    }

    /// `[1, 2, 3]` or `(1, 2, 3)`, as most vectors are written: its numbers.
    #[inline]
    pub fn three_numbers(&self) -> Option<[f64; 3]> {
        let bare = matches!(self.node.kind, Kind::List | Kind::Tuple) && self.lexeme().starts_with(['(', '[']);
        if !bare || self.node.size != 4 {
            return None;
        }
        let mut numbers = [0.0; 3];
        for (number, index) in numbers.iter_mut().zip(self.index + 1..) {
            *number = Item { tree: self.tree, index, node: self.tree.nodes.at(index) }.number()?;
        }
        Some(numbers)
    }

    /// Children; for structs and maps see [`Item::fields`].
    pub fn children(&self) -> Children<'t, 's> {
        let added = match self.tree.added.is_empty() {
            true => NOWHERE,
            false => self.tree.added.get(&(self.index as u32)).copied().unwrap_or(NOWHERE),
        };
        let (index, end) = (self.index + 1, self.index + self.node.size as usize);
        Children { tree: self.tree, index, end, added, begin: index }
    }

    /// Gives back the memory of children that were read for the last time: those from `begin` to this one, which stand
    /// in one piece. Gives where the next that can be given back begin.
    pub fn release_before(&self, begin: usize) -> usize {
        self.tree.nodes.release(begin..self.index)
    }

    /// How many nodes of this subtree stand before a child, and how many from it on.
    pub fn nodes_around(&self, child: Item<'_, '_>) -> (usize, usize) {
        let before = child.index.saturating_sub(self.index + 1);
        (before, (self.node.size as usize).saturating_sub(before + 1))
    }

    /// Children that could be read.
    pub fn solid_children(&self) -> impl Iterator<Item = Item<'t, 's>> + use<'t, 's> {
        self.children().filter(|child| child.kind() != Kind::Broken)
    }

    /// Keys with their values. A value without a key is a broken one and left out.
    pub fn fields(&self) -> Fields<'t, 's> {
        Fields { children: self.children() }
    }

    /// Whether a syntax error stands anywhere inside.
    pub fn holds_damage(&self) -> bool {
        if !self.tree.damaged {
            return false;
        }
        if self.tree.added.is_empty() {
            let end = self.index + self.node.size as usize;
            return (self.index..end).any(|index| self.tree.nodes.at(index).kind == Kind::Broken);
        }
        self.kind() == Kind::Broken || self.children().any(|child| child.holds_damage())
    }

    /// Whether a syntax error stands directly inside: what is missing may have been there.
    pub fn is_damaged(&self) -> bool {
        self.tree.damaged && (self.kind() == Kind::Broken || self.children().any(|child| child.kind() == Kind::Broken))
    }
}

#[derive(Clone)]
pub(crate) struct Children<'t, 's> {
    tree: &'t Tree<'s>,
    index: usize,
    end: usize,
    /// The `Added` node to go on with.
    added: u32,
    /// Where the piece begins that the next child stands in.
    pub begin: usize,
}

impl<'t, 's> Iterator for Children<'t, 's> {
    type Item = Item<'t, 's>;

    fn next(&mut self) -> Option<Item<'t, 's>> {
        loop {
            if self.index >= self.end {
                let added = self.tree.nodes.get(self.added as usize)?;
                self.index = self.added as usize + 1;
                self.begin = self.index;
                self.end = self.added as usize + added.size as usize;
                self.added = added.start;
                continue;
            }
            let node = self.tree.nodes.at(self.index);
            let item = Item { tree: self.tree, index: self.index, node };
            self.index += node.size as usize;
            if node.kind != Kind::Added {
                return Some(item);
            }
        }
    }
}

#[derive(Clone)]
pub(crate) struct Fields<'t, 's> {
    children: Children<'t, 's>,
}

impl Fields<'_, '_> {
    /// Where the piece begins that the last field stands in.
    pub fn piece(&self) -> usize {
        self.children.begin
    }
}

impl<'t, 's> Iterator for Fields<'t, 's> {
    type Item = (Item<'t, 's>, Item<'t, 's>);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let key = self.children.next()?;
            if key.kind() == Kind::Key {
                return Some((key, self.children.next()?));
            }
        }
    }
}
