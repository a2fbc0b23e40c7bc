//! Names across files: what one text gives and another one, which includes it, uses.

use super::names::{Of, Place, defined_of, edit_of, holds_byte, places};
use super::visit::{tree, visit};
use crate::diagnostic::Edit;
use crate::syntax::Syntax;
use crate::tree::Kind;
use std::ops::Range;

/// A name, whichever file gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    of: Of,
    name: String,
}

impl Given {
    fn of(place: &Place<'_>) -> Self {
        Given { of: place.of, name: place.name.to_string() }
    }

    /// Another name of the same kind.
    pub fn named(&self, name: &str) -> Given {
        Given { of: self.of, name: name.to_owned() }
    }

    fn is_of(&self, place: &Place<'_>) -> bool {
        place.of == self.of && place.name == self.name
    }
}

/// The files that a scene includes, as they are written: what they give is known in it.
pub fn includes(text: &str, syntax: Syntax) -> Vec<String> {
    let mut found = Vec::new();
    visit(&tree(text, syntax), &mut |visit| {
        if visit.section == "include" && visit.item.kind() == Kind::Text {
            found.push(visit.item.text().into_owned());
        }
    });
    found
}

/// The name at a byte that the text itself gives to all of it, and so to those that include it.
pub fn given_at(text: &str, syntax: Syntax, byte: usize) -> Option<Given> {
    let places = places(&tree(text, syntax), text, syntax);
    let at = places.iter().find(|place| holds_byte(&place.range, byte))?;
    let given = defined_of(&places, at)?;
    (given.scope.is_none() && given.of != Of::Thing).then(|| Given::of(given))
}

/// The name at a byte that the text uses and does not give: one of its included files may.
pub fn used_at(text: &str, syntax: Syntax, byte: usize) -> Option<Given> {
    let places = places(&tree(text, syntax), text, syntax);
    let at = places.iter().find(|place| holds_byte(&place.range, byte))?;
    (defined_of(&places, at).is_none() && at.of != Of::Thing).then(|| Given::of(at))
}

/// Where a text gives a name.
pub fn place_of(text: &str, syntax: Syntax, given: &Given) -> Option<Range<usize>> {
    let places = places(&tree(text, syntax), text, syntax);
    places.iter().find(|place| place.defines && place.scope.is_none() && given.is_of(place)).map(|p| p.range.clone())
}

/// What is to be changed in a text that includes the one that gives a name, where that gets another: none where it has
/// one of its own.
pub fn rename_used(text: &str, syntax: Syntax, given: &Given, name: &str) -> Vec<Edit> {
    let places = places(&tree(text, syntax), text, syntax);
    let used = places.iter().filter(|place| given.is_of(place) && defined_of(&places, place).is_none());
    used.map(|place| edit_of(place, name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use Syntax::Ron;

    #[test]
    fn names_of_included_files_are_found_and_renamed() {
        let library = "Scene(vars: { \"h\": 2 }, materials: { \"red\": Mirror() })";
        let scene = "Scene(include: [\"lib.ron\", \"b.toml\"], objects: [Box(size: \"=h*2\", material: \"red\"), \
                     Repeat(count: 2, index: \"h\", items: [Box(size: \"=h\")])])";
        assert_eq!(includes(scene, Ron), ["lib.ron", "b.toml"]);
        for (word, name) in [("h\": 2", "k"), ("red", "blue")] {
            let given = given_at(library, Ron, library.find(word).expect("it is there")).expect("it is given");
            assert_eq!(place_of(library, Ron, &given).map(|range| range.start), library.find(word));
            let edits = rename_used(scene, Ron, &given, name);
            assert_eq!(edits.len(), 1, "{edits:?}");
            let changed = crate::render::apply_edits(scene, &edits);
            assert!(changed.contains(if name == "k" { "\"=k*2\"" } else { "material: \"blue\"" }), "{changed}");
            let at = edits[0].span.start as usize;
            assert_eq!(used_at(scene, Ron, at), Some(given.clone()));
            // What the scene gives itself is its own.
            assert_eq!(used_at(library, Ron, library.find(word).expect("it is there")), None);
        }
        let own = scene.replace("include", "materials: { \"red\": Mirror() }, include");
        let given = given_at(library, Ron, library.find("red").expect("it is there")).expect("it is given");
        assert_eq!(rename_used(&own, Ron, &given, "blue"), []);
    }
}
