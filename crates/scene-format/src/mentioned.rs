//! What a scene names anywhere, at whatever frame it is a file.

use crate::SceneDesc;
use crate::files::joined;
use crate::syntax::{Sink, Syntax, parse, ron};
use crate::tree::{Builder, Kind, Text, Tree};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

impl SceneDesc {
    /// All that may name a file, from the place where the scene's folder stands: each text of the scene, of what it
    /// includes and of what was set from outside, in what is not picked and in repetitions too. Most are names of other
    /// things. For those who must not replace a file of the scene, at whatever frame it is one.
    pub fn mentioned(&self) -> BTreeSet<PathBuf> {
        let mut mentioned = BTreeSet::new();
        let first_included = self.sources.len().saturating_sub(self.includes.len());
        for (k, source) in self.sources.iter().enumerate() {
            let include = k.checked_sub(first_included).and_then(|k| self.includes.get(k));
            let folder = include.and_then(|path| path.parent()).unwrap_or(Path::new(""));
            let tree = if k == 0 || include.is_some() {
                tree_of(&source.name, &source.text)
            } else {
                let mut builder = Builder::new(0);
                let from = source.text.find('=').map_or(0, |equals| equals + 1);
                ron::parse_from(&source.text, from, &mut builder, &mut Sink::default());
                let texts = vec![Text { text: &source.text, syntax: Syntax::Ron, folder: Path::new("") }];
                Tree { texts, nodes: builder.nodes, ..Tree::default() }
            };
            let items = (0..tree.nodes.len()).filter_map(|index| tree.item(index));
            let texts = items.filter(|item| item.kind() == Kind::Text);
            mentioned.extend(texts.map(|item| self.base_dir.join(joined(folder, &item.text()))));
        }
        mentioned
    }
}

/// All texts of a scene's own text that may name a file, from the place where its folder stands, whatever is wrong with
/// it; [`SceneDesc::mentioned`] knows what it includes as well.
pub fn mentioned_in(name: &str, text: &str, folder: &Path) -> BTreeSet<PathBuf> {
    let tree = tree_of(name, text);
    let items = (0..tree.nodes.len()).filter_map(|index| tree.item(index));
    items.filter(|item| item.kind() == Kind::Text).map(|item| folder.join(&*item.text())).collect()
}

/// The tree of a text that was read before; its name may tell another syntax than it has.
fn tree_of<'s>(name: &str, text: &'s str) -> Tree<'s> {
    let guess = Syntax::guess(text);
    let named = Syntax::from_path(Path::new(name)).unwrap_or(guess);
    let mut sink = Sink::default();
    let tree = parse(text, named, &mut sink);
    if sink.errors > 0 && named != guess { parse(text, guess, &mut Sink::default()) } else { tree }
}
