//! Names that nothing uses, of materials, of textures and of vars.

use super::{Reader, Step, shortened};
use crate::codes;
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::expression;
use crate::tree::{Kind, Tree};
use std::collections::BTreeSet;
use std::sync::Arc;

/// A name that was not used while the scene was read.
type Unused = (Arc<str>, Span);

impl Reader<'_> {
    /// Warns of them.
    pub(super) fn unused_names(&mut self, tree: &Tree<'_>) {
        // Numbers: of names there may be millions.
        let own = |number: &u32| !self.is_included(self.materials.name(*number).span);
        let mut materials: Vec<u32> = self.materials.unused().filter(own).collect();
        let vars = self.vars.list.iter().filter(|var| !var.used && !self.is_included(var.span));
        let mut vars: Vec<Unused> = vars.map(|var| (Arc::clone(&var.name), var.span)).collect();
        let textures = self.named.unused().into_iter().filter(|(_, span)| !self.is_included(*span));
        let mut textures: Vec<Unused> = textures.collect();
        // What was passed over may be taken at another frame, or when a number is changed.
        if self.chosen && !(materials.is_empty() && textures.is_empty() && vars.is_empty()) {
            let of_materials = materials.iter().map(|number| Arc::clone(&self.materials.name(*number).value));
            let of_vars = vars.iter().map(|(name, _)| Arc::clone(name));
            let of_textures = textures.iter().map(|(name, _)| Arc::clone(name));
            let (texts, words) = mentioned(tree, of_materials.chain(of_textures).collect(), of_vars.collect());
            materials.retain(|number| !texts.contains(&self.materials.name(*number).value));
            textures.retain(|(name, _)| !texts.contains(name));
            vars.retain(|(name, _)| !words.contains(name));
        }
        for number in materials {
            if self.sink.is_full() {
                break;
            }
            let Spanned { value: name, span } = self.materials.name(number).clone();
            let message = format!("no object uses the material \"{}\"", shortened(&name));
            let fault = Diagnostic::warning(codes::UNUSED_MATERIAL, span, message);
            self.path = vec![Step::Field("materials"), Step::Key((*name).to_owned())];
            self.report(fault.hint("remove it, or give its name to an object"));
        }
        for (name, span) in textures {
            if self.sink.is_full() {
                break;
            }
            let message = format!("nothing uses the texture \"{}\"", shortened(&name));
            self.path = vec![Step::Field("textures"), Step::Key((*name).to_owned())];
            let fault = Diagnostic::warning(codes::UNUSED_NAME, span, message);
            self.report(fault.hint("remove it, or write its name where a colour is due"));
        }
        for (name, span) in vars {
            let message = format!("nothing uses the var \"{}\"", shortened(&name));
            let used = self.vars.list.iter().filter(|var| var.used).map(|var| &*var.name);
            let near = crate::suggest::nearest(&name, used);
            let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? If not "));
            let hint = format!("{near}remove it, or write \"={name}\" where its value is due");
            self.path = vec![Step::Field("vars"), Step::Key((*name).to_owned())];
            self.report(Diagnostic::warning(codes::UNUSED_NAME, span, message).hint(hint));
        }
        self.path.clear();
    }
}

/// Those of the `texts` that stand as a text anywhere, and those of the `words` that stand in an expression.
fn mentioned(
    tree: &Tree<'_>,
    texts: BTreeSet<Arc<str>>,
    words: BTreeSet<Arc<str>>,
) -> (BTreeSet<Arc<str>>, BTreeSet<Arc<str>>) {
    let (mut found_texts, mut found_words) = (BTreeSet::new(), BTreeSet::new());
    let items = (0..tree.nodes.len()).filter_map(|index| tree.item(index));
    for item in items.filter(|item| item.kind() == Kind::Text) {
        let text = item.text();
        let Some(body) = text.strip_prefix('=') else {
            found_texts.extend(texts.get(&*text).cloned());
            continue;
        };
        let parts = body.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        found_words.extend(parts.filter(|part| expression::is_name(part)).filter_map(|part| words.get(part).cloned()));
    }
    (found_texts, found_words)
}

#[cfg(test)]
mod tests {
    use crate::{Syntax, load_str};
    use std::path::Path;

    fn warned(rest: &str) -> Vec<String> {
        let text = format!(
            "Scene(animation: Animation(frames: 4), background: 1, vars: {{ \"q\": 2 }}, \
             materials: {{ \"a\": Mirror(), \"b\": Mirror() }}, objects: [{rest}])"
        );
        let loaded = load_str("s", &text, Syntax::Ron, Path::new(""), &[]).expect("it is right");
        loaded.warnings.iter().map(|fault| fault.code.as_str().to_owned()).collect()
    }

    #[test]
    fn what_other_frames_use_is_used() {
        let ball = |radius: &str, material: &str| {
            format!("Sphere(center: (0, 0, 0), radius: {radius}, material: {material}),")
        };
        let picked = |from: &str| format!("Pick(from: [{from}], index: \"=frame\")");
        assert_eq!(warned(&ball("1", "\"a\"")), ["W0403", "W0402", "W0401"]);
        assert!(warned(&ball(&picked("1, \"=2*q\""), &picked("\"a\", \"b\""))).is_empty());
        // A repetition of none at frame 0.
        let none = format!("Repeat(count: \"=frame\", items: [{}])", ball("\"=q\"", "\"b\""));
        assert!(warned(&(ball("1", "\"a\"") + &none)).is_empty());
        // What no frame uses is told beside a pick, too.
        assert_eq!(warned(&ball(&picked("1, \"=frame + qq.x\"").replace("qq.x", "1"), "\"a\"")), ["W0402", "W0401"]);
    }
}
