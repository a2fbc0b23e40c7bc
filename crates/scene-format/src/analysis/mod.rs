//! What an editor asks about a scene while it is written: what may stand here, what a word means, where a name is
//! defined.
//!
//! Everything goes by the schema, so that a new word needs nothing here. Places are bytes of the text. Texts may be
//! wrong or half written: what stands before the cursor is read by `place`, whole texts by the reader's own tree, as
//! far as it goes.

mod across;
mod added;
mod colors;
mod complete;
mod hover;
mod names;
mod place;
mod place_json;
mod place_ron;
mod place_toml;
mod symbols;
mod visit;

pub use across::{Given, given_at, includes, place_of, rename_used, used_at};
pub use added::material_to_add;
pub use colors::{ColorPlace, color_texts, colors};
pub use complete::{Completion, CompletionKind, Completions, complete};
pub use hover::{Hover, hover};
pub use names::{definition, file_at, name_at, name_meant, occurrences, rename};
pub use symbols::{Symbol, SymbolKind, symbols, words_at_top};

#[cfg(test)]
mod tests;
