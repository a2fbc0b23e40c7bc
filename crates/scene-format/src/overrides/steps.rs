//! The path of an argument of `--set`, taken apart.

use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::syntax::span;

/// One step of a path: where it stands in the argument, and what it says.
#[derive(Clone, Debug)]
pub(super) struct Step<'a> {
    pub start: usize,
    pub end: usize,
    pub what: What<'a>,
}

#[derive(Clone, Debug)]
pub(super) enum What<'a> {
    Name(&'a str),
    Index(usize),
}

/// The first `=` outside quotes and brackets.
pub(super) fn end_of_path(argument: &str) -> Option<usize> {
    let mut quoted = false;
    for (at, byte) in argument.bytes().enumerate() {
        match byte {
            b'"' => quoted = !quoted,
            b'=' if !quoted => return Some(at),
            _ => {}
        }
    }
    None
}

/// Splits `objects[2].radius`, `materials."my glass".ior`, `materials["my glass"]`.
pub(super) fn steps(path: &str, source: u16) -> Result<Vec<Step<'_>>, Diagnostic> {
    let bad = |start: usize, end: usize, message: &str| {
        Err(Diagnostic::error(codes::BAD_SET_SYNTAX, span(source, start, end), message)
            .expected("names joined by points, and numbers in brackets: objects[2].radius"))
    };
    let mut steps = Vec::new();
    let mut at = 0;
    loop {
        at += path[at..].len() - path[at..].trim_start().len();
        let rest = &path[at..];
        if let Some(quoted) = rest.strip_prefix('"') {
            let Some(length) = quoted.find('"') else { return bad(at, path.len(), "this quote is never closed") };
            steps.push(Step { start: at, end: at + length + 2, what: What::Name(&quoted[..length]) });
            at += length + 2;
        } else if let Some(inner) = rest.strip_prefix('[') {
            let Some(length) = inner.find(']') else { return bad(at, path.len(), "this bracket is never closed") };
            let index = inner[..length].trim();
            let end = at + length + 2;
            let what = match (index.strip_prefix('"').and_then(|i| i.strip_suffix('"')), index.parse()) {
                (Some(name), _) => What::Name(name),
                (None, Ok(index)) => What::Index(index),
                _ => return bad(at, end, "in brackets stands the number of an item, counted from 0"),
            };
            steps.push(Step { start: at, end, what });
            at = end;
        } else {
            let length = rest.find(['.', '[']).unwrap_or(rest.len());
            let name = rest[..length].trim_end();
            if name.is_empty() {
                return bad(at.min(path.len()), path.len().max(at), "a name is missing in this path");
            }
            steps.push(Step { start: at, end: at + name.len(), what: What::Name(name) });
            at += length;
        }
        match path[at..].bytes().next() {
            None => return Ok(steps),
            Some(b'.') => at += 1,
            Some(b'[') => {}
            Some(_) if path[at..].trim().is_empty() => return Ok(steps),
            Some(_) => return bad(at, path.len(), "a point or a bracket is missing in this path"),
        }
    }
}
