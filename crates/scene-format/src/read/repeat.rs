//! `Repeat` in a list: its items as often as it says, with an index that counts.

use super::{Reader, Step};
use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::expression;
use crate::schema::{FieldDef, Rule, StructDef, Type};
use crate::tree::{Item, Kind};
use crate::words::Words;
use std::sync::Arc;

/// Repetitions of one `Repeat`, at most.
const MOST_TIMES: f64 = 1e6;
/// `Repeat`s within each other, at most.
const MOST_NESTED: usize = 8;
/// Items that all repetitions and patterns of a scene make, at most.
pub(super) const MOST_ITEMS: u64 = 10_000_000;

/// Its fields.
pub(crate) static REPEAT: StructDef = StructDef {
    name: "Repeat",
    noun: "a repetition",
    doc: &[" Puts its items into the list so many times."],
    fields: &[
        FieldDef {
            name: "count",
            noun: "the count of a repetition",
            doc: &[" How many times."],
            kind: Type::Integer,
            rule: Rule::within("a whole number", 0.0, MOST_TIMES),
            default: None,
        },
        FieldDef {
            name: "index",
            noun: "the index of a repetition",
            doc: &[" The name that counts from 0 in expressions within."],
            kind: Type::Text,
            rule: Rule::ANY,
            default: Some(|| crate::form::Form::Text("i".to_owned())),
        },
        FieldDef {
            name: "vars",
            noun: "the vars of a repetition",
            doc: &[" Values by name, reckoned anew each time."],
            kind: Type::Map(&Type::Value),
            rule: Rule::ANY,
            default: Some(|| crate::form::Form::Map(Vec::new())),
        },
        FieldDef {
            name: "items",
            noun: "the items of a repetition",
            doc: &[" What is put into the list each time."],
            kind: Type::List(&Type::Value),
            rule: Rule::ANY,
            default: None,
        },
    ],
    bare: None,
    exactly_one: &[],
};

/// The fields of an item that is a `Repeat`.
pub(crate) fn repeat_body<'t, 's>(item: Item<'t, 's>) -> Option<Item<'t, 's>> {
    match item.kind() {
        Kind::Struct | Kind::Tuple => (item.name() == Some(REPEAT.name)).then_some(item),
        Kind::Map => {
            let mut fields = item.fields();
            let (key, value) = fields.next()?;
            (key.text() == REPEAT.name && fields.next().is_none()).then_some(value)
        }
        _ => None,
    }
}

/// How many items stand for one that is written, at least: as far as counts within it are numbers.
fn made(item: Item<'_, '_>) -> u64 {
    let Some(body) = repeat_body(item) else { return 1 };
    let field = |name: &str| body.fields().find(|(key, _)| key.text() == name).map(|(_, value)| value);
    let count = field("count").filter(|count| count.kind() == Kind::Integer).and_then(|count| count.number());
    let (Some(count), Some(items)) = (count, field("items")) else { return 0 };
    let each = items.children().map(made).fold(0, u64::saturating_add);
    each.saturating_mul(count.max(0.0) as u64)
}

impl Reader<'_> {
    /// Reads the items of a `Repeat` as often as it says; `None` where it could not.
    pub(super) fn repeat<'t, 's>(
        &mut self,
        body: Item<'t, 's>,
        at: &'static FieldDef,
        read: &mut dyn FnMut(&mut Self, Item<'t, 's>),
    ) -> Option<()> {
        let fields = self.fields_unnamed(body, &REPEAT)?;
        let count =
            fields.get(0).and_then(|count| self.at_field(0, |reader| u32::read(reader, count, &REPEAT.fields[0])));
        let index = match fields.get(1) {
            Some(name) => self.at_field(1, |reader| reader.index_name(name)),
            None => Some("i".to_owned()),
        };
        let (Some(count), Some(index), Some(items)) = (count, index, fields.get(3)) else { return None };
        // That it is too much was told.
        if self.sink.repeated > MOST_ITEMS {
            return None;
        }
        if self.vars.depth() >= MOST_NESTED {
            self.too_much(body, &format!("repetitions stand more than {MOST_NESTED} deep"));
            return None;
        }
        // Before any is made: a thousand times a thousand times a thousand would take its time.
        if self.vars.depth() == 0 {
            let each = items.children().map(made).fold(0, u64::saturating_add);
            if each.saturating_mul(u64::from(count)) > MOST_ITEMS {
                self.sink.repeated = MOST_ITEMS + 1;
                self.too_much(body, &format!("repetitions make more than {MOST_ITEMS} items"));
                return None;
            }
        }
        self.chosen |= count == 0;
        let index: Arc<str> = index.into();
        for k in 0..count {
            let errors = self.sink.errors;
            self.vars.enter(&index, f64::from(k));
            self.indices.push((index.clone(), k));
            if let Some(vars) = fields.get(2) {
                self.at_field(2, |reader| reader.vars_within(vars, &REPEAT.fields[2]));
            }
            let mut made = 0;
            if self.sink.errors == errors {
                self.at_field(3, |reader| {
                    reader.items_into(items, at, &mut |reader, item| {
                        made += 1;
                        read(reader, item);
                    })
                });
            }
            self.vars.leave();
            self.indices.pop();
            self.sink.repeated += made.max(1);
            if self.sink.errors == errors && self.sink.repeated > MOST_ITEMS {
                self.too_much(body, &format!("repetitions make more than {MOST_ITEMS} items"));
                return None;
            }
            if self.sink.errors > errors {
                return None;
            }
        }
        Some(())
    }

    /// Where repetitions are, ` (i = 3, j = 0)`, the outermost first; empty outside of them.
    pub(super) fn where_repeated(&self) -> String {
        let indices: Vec<String> = self.indices.iter().map(|(index, k)| format!("{index} = {k}")).collect();
        if indices.is_empty() { String::new() } else { format!(" ({})", indices.join(", ")) }
    }

    /// Reads with a field on the path.
    fn at_field<T>(&mut self, slot: usize, read: impl FnOnce(&mut Self) -> T) -> T {
        self.path.push(Step::Field(REPEAT.fields[slot].name));
        let value = read(self);
        self.path.pop();
        value
    }

    fn index_name(&mut self, item: Item<'_, '_>) -> Option<String> {
        let name = self.text(item, &REPEAT.fields[1])?.into_owned();
        if expression::is_name(&name) {
            return Some(name);
        }
        let message = format!("`{}` cannot stand in an expression", super::shortened(&name));
        let expected = "a name of letters, digits and `_` without a meaning of its own";
        self.report(Diagnostic::error(codes::BAD_NAME, item.span(), message).expected(expected));
        None
    }

    /// Whether so many copies more, which a pattern makes, are not too many; else it is reported.
    pub(crate) fn takes_copies(&mut self, item: Item<'_, '_>, copies: u64) -> bool {
        if self.sink.repeated > MOST_ITEMS {
            return false;
        }
        self.sink.repeated += copies;
        let too_many = self.sink.repeated > MOST_ITEMS;
        if too_many {
            let message = format!("repetitions and patterns make more than {MOST_ITEMS} items");
            self.report(Diagnostic::error(codes::TOO_MUCH, item.head(), message).expected("fewer"));
        }
        !too_many
    }

    fn too_much(&mut self, item: Item<'_, '_>, message: &str) {
        let fault = Diagnostic::error(codes::TOO_MUCH, item.head(), message).expected("fewer");
        self.report(fault.hint("many copies of one mesh are cheaper by `placements`"));
    }
}
