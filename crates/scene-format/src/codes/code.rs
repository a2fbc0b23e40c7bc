//! What a code is.

use std::fmt;

/// The code of a diagnostic: one of the constants of [`codes`](super).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(&'static str);

impl Code {
    /// For the list in `codes.rs` alone.
    pub(super) const fn new(code: &'static str) -> Self {
        Code(code)
    }

    /// `E0301`
    pub const fn as_str(self) -> &'static str {
        self.0
    }

    /// Whether it is one of the syntax: brackets, quotes, commas.
    pub fn is_syntax(self) -> bool {
        self.0.starts_with("E01")
    }

    /// Whether brackets do not match, as it seems.
    pub(crate) fn is_of_brackets(self) -> bool {
        matches!(self, super::UNCLOSED_BRACKET | super::STRAY_BRACKET | super::TEXT_AFTER_END)
    }

    /// Whether it is one of a value that is of the right kind but out of its range.
    pub fn is_value(self) -> bool {
        self.0.starts_with("E03")
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.0)
    }
}

impl fmt::Debug for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.0, f)
    }
}

/// As it is written: for tests and scripts.
impl PartialEq<str> for Code {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

/// As it is written: for tests and scripts.
impl PartialEq<&str> for Code {
    fn eq(&self, other: &&str) -> bool {
        self.0 == *other
    }
}

/// A code with its documentation.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// `E0301`
    pub code: Code,
    /// What is wrong, in general.
    pub title: &'static str,
    /// Why it is wrong and how to mend it; Markdown, with an example of the fault where one helps.
    pub text: &'static str,
}

/// The explanation of a code, for `tracer explain`; letters may be small. `None`: there is no such code.
pub fn explain(code: &str) -> Option<&'static str> {
    find(code).map(|found| found.text)
}

/// The entry of a code.
pub fn find(code: &str) -> Option<&'static Entry> {
    super::CODES.iter().find(|known| known.code.as_str().eq_ignore_ascii_case(code.trim()))
}
