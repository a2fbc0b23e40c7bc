//! `#![enable(implicit_some)]` at the head of a RON file: accepted, and without effect.

use super::ron::Parser;
use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::suggest;

/// The RON extensions that may be named in `#![enable(..)]`; the scene language has what they are for.
const EXTENSIONS: [&str; 4] = ["implicit_some", "unwrap_newtypes", "unwrap_variant_newtypes", "explicit_struct_names"];

impl Parser<'_> {
    /// `#![enable(a, b)]`
    pub(super) fn extensions(&mut self) {
        let start = self.at;
        let end = self.rest().find(']').map_or(self.text.len(), |close| start + close + 1);
        let line = &self.text[start..end];
        let inner = line
            .strip_prefix("#!")
            .map(str::trim_start)
            .and_then(|l| l.strip_prefix('['))
            .map(str::trim_start)
            .and_then(|l| l.strip_prefix("enable"))
            .map(str::trim_start)
            .and_then(|l| l.strip_prefix('('))
            .and_then(|l| l.split_once(')'));
        match inner {
            Some((names, _)) => {
                for name in names.split(',') {
                    let trimmed = name.trim();
                    if trimmed.is_empty() || EXTENSIONS.contains(&trimmed) {
                        continue;
                    }
                    let offset = trimmed.as_ptr() as usize - self.text.as_ptr() as usize;
                    let found = self.span(offset, offset + trimmed.len());
                    let mut fault = Diagnostic::error(
                        codes::UNKNOWN_EXTENSION,
                        found,
                        format!("RON has no extension `{trimmed}` that a scene could use"),
                    )
                    .expected(format!("one of {}", suggest::list(&EXTENSIONS)))
                    .hint("a scene needs none: remove it");
                    fault.did_you_mean(suggest::nearest(trimmed, EXTENSIONS), |word| word.to_owned());
                    self.sink.push(fault);
                }
            }
            None => {
                let found = self.span(start, end);
                self.sink.push(
                    Diagnostic::error(codes::UNKNOWN_EXTENSION, found, "this line is no RON attribute")
                        .expected("#![enable(implicit_some)], or nothing")
                        .hint("a scene needs none: remove it"),
                );
            }
        }
        self.at = end;
    }
}
