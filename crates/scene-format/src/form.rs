//! A value in the words of the language, ready to be printed in any syntax or hashed: what the writer, the converter
//! and the defaults of the reference speak.

use std::borrow::Cow;

/// A value as it will be written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    /// What has no words: a material that was not written. As an entry: comments behind the last one alone.
    Absent,
    Bool(bool),
    Number(f64),
    Integer(u64),
    /// A number as somebody wrote it (the converter keeps `1_000` and `1e3`).
    Lexeme(String),
    Text(String),
    /// Three numbers.
    Vector(Vec<Form>),
    List(Vec<Entry>),
    Map(Vec<Entry>),
    Struct {
        name: &'static str,
        fields: Vec<Entry>,
    },
    Variant {
        name: &'static str,
        content: Option<Box<Form>>,
    },
}

/// Among comments: an empty line. No comment has an end of a line in it.
pub(crate) const BLANK_LINE: &str = "\n";

/// Before the comments of the first entry: it stood on a line of its own, and all of them will.
pub(crate) const OWN_LINES: &str = "\n\n";

/// Before the comments of the first entry: entries shared a line, and lines will be filled.
pub(crate) const FILLED: &str = "\n\n\n";

/// A value with its name (in lists: none) and the comments that belong to it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub name: Cow<'static, str>,
    pub value: Form,
    /// Comments on the lines before it, without their signs.
    pub before: Vec<String>,
    /// A comment after it, on its line.
    pub after: Option<String>,
}

impl Entry {
    pub fn new(name: impl Into<Cow<'static, str>>, value: Form) -> Entry {
        Entry { name: name.into(), value, before: Vec::new(), after: None }
    }
}

impl Entry {
    /// Adds a field, unless it has no words.
    pub fn push(fields: &mut Vec<Entry>, name: &'static str, value: Form) {
        if value != Form::Absent {
            fields.push(Entry::new(name, value));
        }
    }
}

impl Form {
    pub fn vector(value: [f64; 3]) -> Form {
        Form::Vector(value.iter().map(|&v| Form::Number(v)).collect())
    }

    pub fn word(name: &'static str) -> Form {
        Form::Variant { name, content: None }
    }

    pub fn list(items: impl IntoIterator<Item = Form>) -> Form {
        Form::List(items.into_iter().map(|item| Entry::new("", item)).collect())
    }
}
