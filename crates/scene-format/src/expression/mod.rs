//! Expressions: texts that begin with `=` where a number, a vector, a colour or a truth value may stand.
//!
//! Total: no loops, no functions of one's own, at most [`MAX_BYTES`] long and [`MAX_DEPTH`] deep, so every one ends
//! soon. The same on every machine: own `libm`, angles in degrees.

mod blackbody;
mod functions;
mod parse;
mod value;

pub(crate) use blackbody::TEMPERATURES;
pub(crate) use parse::evaluate;
pub(crate) use value::{List, MOST_LISTS, Value};

use crate::codes::Code;
use std::ops::Range;

/// Longer ones are refused.
pub(crate) const MAX_BYTES: usize = 4096;
/// Deeper ones are refused.
const MAX_DEPTH: usize = 64;

/// Names that stand for numbers of the frame that is seen.
pub(crate) const MOMENT: [&str; 2] = ["frame", "time"];

/// What is wrong with an expression.
#[derive(Debug)]
pub(crate) struct Fault {
    pub code: Code,
    /// The bytes of the text that are meant.
    pub at: Range<usize>,
    pub message: String,
    pub expected: String,
    pub hint: String,
}

/// What a name stands for.
pub(crate) enum Named {
    Value(Value),
    /// Nothing; these names are known.
    Unknown(Vec<String>),
    /// What it stands for could not be read, which was reported.
    Failed,
}

/// Whether a name has a meaning of its own.
pub(crate) fn is_known(name: &str) -> bool {
    // Kinds, which most names are, begin with a capital: they are not held against all functions.
    if !name.starts_with(|c: char| c.is_ascii_lowercase()) {
        return false;
    }
    let constant = functions::CONSTANTS.iter().any(|(constant, _)| *constant == name);
    constant
        || MOMENT.contains(&name)
        || matches!(name, "true" | "false")
        || functions::FUNCTIONS.iter().any(|function| function.name == name)
}

/// The functions, and how each is called.
pub(crate) fn functions() -> impl Iterator<Item = (&'static str, &'static str)> {
    functions::FUNCTIONS.iter().map(|function| (function.name, function.call))
}

/// How a function is called, and what that gives.
pub(crate) fn function(name: &str) -> Option<(&'static str, &'static str)> {
    functions::FUNCTIONS.iter().find(|function| function.name == name).map(|function| (function.call, function.does))
}

/// What a name that stands for a number stands for.
pub(crate) fn constant(name: &str) -> Option<&'static str> {
    Some(match name {
        "frame" => "the number of the frame, from 0",
        "time" => "seconds from the first frame: `frame / fps` of the `animation`",
        "pi" => "3.14159..; angles are in degrees, though",
        _ => return None,
    })
}

/// Whether expressions can use a name: a plain word without a meaning of its own.
pub(crate) fn is_name(name: &str) -> bool {
    let begins = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
    begins && name.chars().all(|c| c.is_alphanumeric() || c == '_') && !is_known(name)
}

/// Why there is no value: `None` where that was reported.
pub(crate) type Failure = Option<Fault>;

#[cfg(test)]
mod tests;
