//! What stands where a list is to be: things by their names, `true` for all words that may stand in it.

use super::{Reader, Step, describe, is_expression, plain, squeezed};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::expression::{List, Value};
use crate::schema::{Content, FieldDef, Type, VariantDef};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// What a list takes, where these are words by themselves, and the list that is meant by `true` or one of them; else
/// just that it is a list.
pub(super) fn list_of_words(at: &FieldDef, item: Item<'_, '_>) -> (String, Option<String>) {
    if is_of_points(at) {
        return (super::value::expected_for(at, item), None);
    }
    const MOST: usize = 4;
    let words: Vec<&str> = match at.kind {
        Type::List(Type::Enum(def)) if def.variants.iter().all(|kind| matches!(kind.content, Content::Unit)) => {
            def.variants.iter().map(|variant| variant.name).collect()
        }
        _ => Vec::new(),
    };
    if words.is_empty() || words.len() > MOST {
        return ("a list: [a, b, c]".to_owned(), of_one_word(at, item));
    }
    let written: Vec<String> = words
        .iter()
        .map(|word| if item.syntax() == Syntax::Ron { (*word).to_owned() } else { format!("\"{word}\"") })
        .collect();
    let list = format!("[{}]", written.join(", "));
    let expected = format!("a list: {list}, or some of them");
    let is_all = matches!(item.lexeme(), "true" | "True" | "TRUE");
    (expected, if is_all { Some(list) } else { of_one_word(at, item) })
}

/// A list of the one word that stands in place of it: `[Depth]`.
fn of_one_word(at: &FieldDef, item: Item<'_, '_>) -> Option<String> {
    let Type::List(of) = at.kind else { return None };
    let Type::Enum(def) = of.resolved() else { return None };
    let is_word = matches!(item.kind(), Kind::Word | Kind::Text);
    let same =
        |kind: &&VariantDef| matches!(kind.content, Content::Unit) && squeezed(kind.name) == squeezed(&item.text());
    let word = def.variants.iter().filter(|_| is_word).find(same)?.name;
    Some(if item.syntax() == Syntax::Ron { format!("[{word}]") } else { format!("[\"{word}\"]") })
}

/// What stands in round brackets as a list; a point alone is none.
pub(super) fn in_square_brackets(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    let is_point = is_of_points_or_lists(&at.kind) && item.children().next()?.number().is_some();
    let inner = item.lexeme().get(1..item.lexeme().len() - 1).filter(|_| !is_point)?;
    Some(format!("[{inner}]"))
}

/// Whether a list is one of points or of rings of points.
pub(super) fn is_of_points(at: &FieldDef) -> bool {
    let is_point = |kind: &Type| matches!(kind, Type::Pair | Type::Vector | Type::Number);
    matches!(at.kind, Type::List(of) if is_point(of) || matches!(of, Type::List(of) if is_point(of)))
}

/// Whether the items of a list are more than a number each; a colour may be one, a grey.
fn is_of_points_or_lists(kind: &Type) -> bool {
    matches!(kind, Type::List(of) if !matches!(of, Type::Number | Type::Integer | Type::Color))
}

impl Reader<'_> {
    /// The items of a list that an expression stands for, `"=profile"`: each is read at the place of the expression.
    pub(super) fn items_of_value<'t, 's>(
        &mut self,
        item: Item<'t, 's>,
        at: &'static FieldDef,
        read: &mut dyn FnMut(&mut Self, Item<'t, 's>),
    ) -> Option<()> {
        if !at.kind.is_of_values() {
            return self.not_a_list(item, at);
        }
        if !is_expression(item) {
            // A name of `vars` without its sign.
            let name = item.text();
            let is_word = matches!(item.kind(), Kind::Text | Kind::Word) && at.name != "placements";
            if let Some(near) = self.nearest_var(&name).filter(|near| is_word && **near != *name) {
                let message = format!("{} cannot be {}", plain(at.noun), describe(item));
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message);
                let fault = fault.expected(super::value::expected_for(at, item));
                self.report(fault.hint(format!("did you mean \"={near}\"?")));
                return None;
            }
            if is_word && self.knows_var(&name) {
                let (expected, _) = list_of_words(at, item);
                return self.wrong_kind(item, at.noun, &expected, Some(format!("\"={name}\"")));
            }
            return self.not_a_list(item, at);
        }
        let value = self.expression(item)??;
        let items = match &value {
            Value::List(list) => list.clone(),
            // Two or three numbers are a pair or a vector there.
            Value::Pair(_) | Value::Triple(_) if !is_of_points_or_lists(&at.kind) => {
                List::new(value.numbers().iter().map(|number| Value::Number(*number)).collect())?
            }
            // One point or one face where several are due.
            Value::Pair(_) | Value::Triple(_) => {
                let message = format!("{} cannot be {}", plain(at.noun), value.noun());
                let fault = Diagnostic::error(codes::EXPRESSION_TYPE, item.span(), message);
                let fault = fault.expected(super::value::expected_for(at, item));
                self.report(fault.hint(format!("a list of this one is [{}]", item.lexeme())));
                return None;
            }
            _ => return self.wrong_value(&value, item, at),
        };
        if self.is_of_another_depth(&items, item, at) || !self.takes_copies(item, items.items().len() as u64) {
            return None;
        }
        let around = self.vars.element.take();
        for (index, value) in items.items().iter().enumerate() {
            if self.sink.is_full() {
                break;
            }
            self.vars.element = Some((item.index() as u32, value.clone()));
            self.path.push(Step::Index(index));
            let told = self.sink.diagnostics.len();
            read(self, item);
            // All stand at one place: which one is wrong has to be said.
            for fault in self.sink.diagnostics.iter_mut().skip(told) {
                fault.message += &format!(" (item {index} of the list, from 0)");
            }
            self.path.pop();
        }
        self.vars.element = around;
        Some(())
    }

    /// One ring where a list of them stands, or numbers one after the other where points do: told once.
    fn is_of_another_depth(&mut self, items: &List, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        let (Some(first), Type::List(of)) = (items.items().first(), at.kind) else { return false };
        let way = match (first, of) {
            (Value::Pair(_), Type::List(Type::Pair)) => Some(format!("[{}]", item.lexeme())),
            (Value::Number(_), Type::Pair | Type::Vector | Type::List(_)) => None,
            _ => return false,
        };
        let message = format!(
            "{} cannot be a list of {}",
            plain(at.noun),
            match first {
                Value::Pair(_) => "points",
                _ => "numbers",
            }
        );
        let expected = super::value::expected_for(at, item);
        let mut fault = Diagnostic::error(codes::EXPRESSION_TYPE, item.span(), message).expected(expected);
        if let Some(way) = way {
            fault.hint = format!("write {way}");
            fault.edit = Some(Edit { span: item.span(), replacement: way });
        } else if let Type::Pair | Type::Vector = of {
            fault.hint = "in `vars`, too, each point stands in brackets of its own".to_owned();
        }
        self.report(fault);
        true
    }

    /// Objects or lights by their names, `{ "ball": Sphere(..) }`: reported here, with the list that is meant. `false`:
    /// it is something else.
    pub(super) fn list_by_names(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        // No one names more than this by hand.
        const MOST: usize = 64;
        let Type::List(of) = at.kind else { return false };
        let Type::Enum(def) = of.resolved() else { return false };
        let is_kind = |word: &str| def.variant(word).is_some();
        let named: Vec<_> = item.fields().take(MOST).collect();
        let is_thing = |value: &Item<'_, '_>| match value.kind() {
            Kind::Struct | Kind::Tuple => value.name().is_some_and(is_kind),
            Kind::Map => value.fields().next().is_some_and(|(key, _)| is_kind(&key.text())),
            _ => false,
        };
        let right = |(key, value): &(Item<'_, '_>, Item<'_, '_>)| !is_kind(&key.text()) && is_thing(value);
        if !matches!(at.name, "objects" | "lights") || named.is_empty() || !named.iter().all(right) {
            return false;
        }
        let message = format!("{} cannot be {}", plain(at.noun), describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message);
        (fault.expected, fault.hint) = match item.syntax() {
            Syntax::Ron => (
                "a list: [Sphere(..), Box(..)]".to_owned(),
                "they stand in a list, and what one is called is its `name`: [Sphere(.., name: \"ball\"), ..]"
                    .to_owned(),
            ),
            Syntax::Toml => (
                format!("[[{}]] before each", at.name),
                "they stand in a list, and what one is called is its `name`, beside its other fields".to_owned(),
            ),
            Syntax::Json => (
                "a list: [{ \"Sphere\": .. }, { \"Box\": .. }]".to_owned(),
                "they stand in a list, and what one is called is its `name`: [{ \"Sphere\": { .., \"name\": \"ball\" } \
                 }, ..]"
                    .to_owned(),
            ),
        };
        let with_name = |(key, value): &(Item<'_, '_>, Item<'_, '_>)| {
            let own = value.fields().any(|(field, _)| field.text() == "name");
            // `Plane()` has no fields, and no values without names.
            let has_fields = value.kind() == Kind::Struct || value.children().next().is_none();
            let inner = value.lexeme().strip_suffix(')').filter(|_| has_fields && !own)?;
            let inner = inner.trim_end().trim_end_matches(',').trim_end();
            let comma = if inner.ends_with('(') { "" } else { ", " };
            // A comment behind the last field would swallow the name.
            let is_plain = !inner.contains("//");
            is_plain.then(|| format!("{inner}{comma}name: {:?})", key.text()))
        };
        if item.syntax() == Syntax::Ron && named.len() < MOST {
            let list: Option<Vec<String>> = named.iter().map(with_name).collect();
            fault.edit = list.map(|list| Edit { span: item.span(), replacement: format!("[{}]", list.join(", ")) });
        }
        self.report(fault);
        true
    }
}
