//! Parts of a scene by themselves.

use super::Reader;
use super::variant::NO_FIELD;
use crate::diagnostic::Diagnostic;
use crate::syntax::{Sink, Syntax, parse_as};
use crate::tree::NO_SOURCE;
use crate::words::Words;

/// Reads a part of a scene from JSON that nobody will see: spans point nowhere. Materials that it names are elsewhere.
pub(crate) fn part<T: Words>(text: &str) -> Result<T, Vec<Diagnostic>> {
    let mut sink = Sink::default();
    let tree = parse_as(NO_SOURCE, text, Syntax::Json, &mut sink);
    let value = tree.root().and_then(|root| {
        let mut reader = Reader::new(&mut sink);
        reader.materials.damaged = true;
        let item = reader.picked(root)?;
        T::read(&mut reader, item, &NO_FIELD)
    });
    match value {
        Some(value) if sink.errors == 0 => Ok(value),
        _ => Err(sink.diagnostics),
    }
}
