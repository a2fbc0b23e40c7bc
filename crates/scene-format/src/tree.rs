//! The spanned syntax tree: one tree type for both syntaxes, before any word of it has a meaning.
//!
//! The tree is a tape of 16-byte nodes in the order of writing (a node is followed by its children), so that reading a scene of
//! 10^5 objects allocates nothing per node. Nodes hold positions only; names, numbers and texts are read from the source text
//! when somebody asks. This is the stage where `include`, `vars` and `repeat` will expand.

use crate::diagnostic::Span;
use crate::syntax::{Syntax, decode};
use std::borrow::Cow;

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
    /// A bare word in RON: `None`, `Bvh`.
    Word,
    /// `[a, b]`.
    List,
    /// `(a, b)`, `()`, `Name(a, b)` and `Name()`.
    Tuple,
    /// `(a: 1)` and `Name(a: 1)`: keys and values in turn.
    Struct,
    /// `{ "k": v }`, and tables of TOML: keys and values in turn.
    Map,
    /// The key of the value that follows.
    Key,
}

/// One entry of the tape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub start: u32,
    pub end: u32,
    /// Nodes in this subtree, this one included.
    pub size: u32,
    pub source: u16,
    pub kind: Kind,
}

/// A text that nodes point into.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text<'s> {
    pub text: &'s str,
    pub syntax: Syntax,
}

/// A whole file (and the arguments of `--set` grafted into it) as a tree.
#[derive(Clone, Debug)]
pub(crate) struct Tree<'s> {
    pub texts: Vec<Text<'s>>,
    pub nodes: Vec<Node>,
    /// Comments of the scene file in order of writing.
    pub comments: Vec<Span>,
}

impl<'s> Tree<'s> {
    /// The root, when anything was read.
    pub fn root(&self) -> Option<Item<'_, 's>> {
        (!self.nodes.is_empty()).then_some(Item { tree: self, index: 0 })
    }
}

/// Writes a tape in order.
#[derive(Debug, Default)]
pub(crate) struct Builder {
    pub nodes: Vec<Node>,
    pub source: u16,
}

impl Builder {
    /// A builder for a text of `bytes` bytes: one node for every seven bytes is what scenes have.
    pub fn new(source: u16, bytes: usize) -> Builder {
        Builder { nodes: Vec::with_capacity(bytes / 7 + 8), source }
    }

    pub fn leaf(&mut self, kind: Kind, start: usize, end: usize) {
        self.nodes.push(Node { start: start as u32, end: end as u32, size: 1, source: self.source, kind });
    }

    /// Begins a node with children; `close` ends it.
    pub fn open(&mut self, start: usize) -> usize {
        self.leaf(Kind::Broken, start, start);
        self.nodes.len() - 1
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
}

impl<'t, 's> Item<'t, 's> {
    fn node(&self) -> &'t Node {
        &self.tree.nodes[self.index]
    }

    /// Where the node stands on the tape.
    pub fn index(&self) -> usize {
        self.index
    }

    pub fn kind(&self) -> Kind {
        self.node().kind
    }

    pub fn span(&self) -> Span {
        let node = self.node();
        Span { source: u32::from(node.source), start: node.start, end: node.end }
    }

    pub fn syntax(&self) -> Syntax {
        self.tree.texts[usize::from(self.node().source)].syntax
    }

    /// The node as it was written.
    pub fn lexeme(&self) -> &'s str {
        let node = self.node();
        let text: &'s str = self.tree.texts[usize::from(node.source)].text;
        text.get(node.start as usize..node.end as usize).unwrap_or("")
    }

    /// `Name` of `Name(..)`.
    pub fn name(&self) -> Option<&'s str> {
        if !matches!(self.kind(), Kind::Tuple | Kind::Struct) {
            return None;
        }
        let lexeme = self.lexeme();
        let end = lexeme.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(lexeme.len());
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

    /// Whether it is the word `name`: `name` in RON, `"name"` in TOML.
    pub fn is_word(&self, name: &str) -> bool {
        match self.kind() {
            Kind::Word => self.lexeme() == name,
            Kind::Text => self.syntax() == Syntax::Toml && self.text() == name,
            _ => false,
        }
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
            _ => Cow::Borrowed(self.lexeme()),
        }
    }

    /// The value of a number.
    pub fn number(&self) -> Option<f64> {
        matches!(self.kind(), Kind::Integer | Kind::Float).then(|| decode::number(self.lexeme()))
    }

    /// Children; for structs and maps see [`Item::fields`].
    pub fn children(&self) -> Children<'t, 's> {
        let index = self.index + 1;
        Children { tree: self.tree, index, end: self.index + self.node().size as usize }
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
        let end = self.index + self.node().size as usize;
        self.tree.nodes[self.index..end].iter().any(|node| node.kind == Kind::Broken)
    }

    /// Whether a syntax error stands directly inside: what is missing may have been there.
    pub fn is_damaged(&self) -> bool {
        self.kind() == Kind::Broken || self.children().any(|child| child.kind() == Kind::Broken)
    }
}

#[derive(Clone)]
pub(crate) struct Children<'t, 's> {
    tree: &'t Tree<'s>,
    index: usize,
    end: usize,
}

impl<'t, 's> Iterator for Children<'t, 's> {
    type Item = Item<'t, 's>;

    fn next(&mut self) -> Option<Item<'t, 's>> {
        if self.index >= self.end {
            return None;
        }
        let item = Item { tree: self.tree, index: self.index };
        self.index += item.node().size as usize;
        Some(item)
    }
}

#[derive(Clone)]
pub(crate) struct Fields<'t, 's> {
    children: Children<'t, 's>,
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
