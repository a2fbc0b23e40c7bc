//! `Pick` in place of a value: one of several, by a number.

use super::{Reader, Step, is_expression};
use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::schema::{FieldDef, Rule, StructDef, Type};
use crate::tree::{Item, Kind};

/// Values to pick from, at most: they are counted each time.
const MOST_VALUES: usize = 1000;

/// Its fields.
pub(crate) static PICK: StructDef = StructDef {
    name: "Pick",
    noun: "a pick",
    doc: &[" One of several values, by a number: `Pick(from: [\"red\", \"blue\"], index: \"=i\")`."],
    fields: &[
        FieldDef {
            name: "from",
            noun: "the from of a pick",
            doc: &[" The values, a thousand at most: anything that may stand where the pick does."],
            kind: Type::List(&Type::Value),
            rule: Rule::ANY,
            default: None,
        },
        FieldDef {
            name: "index",
            noun: "the index of a pick",
            doc: &[" Which of them, counted from 0; after the last one the first follows again."],
            kind: Type::Integer,
            rule: Rule::within("a whole number", -1e15, 1e15),
            default: None,
        },
    ],
    bare: None,
    exactly_one: &[],
};

/// The fields of a value that is a `Pick`.
pub(crate) fn pick_body<'t, 's>(item: Item<'t, 's>) -> Option<Item<'t, 's>> {
    match item.kind() {
        Kind::Struct | Kind::Tuple => {
            (item.lexeme().starts_with(PICK.name) && item.name() == Some(PICK.name)).then_some(item)
        }
        Kind::Map => {
            let mut fields = item.fields();
            let (key, value) = fields.next()?;
            (key.lexeme().trim_matches('"') == PICK.name && fields.next().is_none()).then_some(value)
        }
        _ => None,
    }
}

impl Reader<'_> {
    /// The value that a `Pick` stands for, or the item itself where it is none. `None`: the pick is wrong, which is
    /// reported.
    #[inline]
    pub(crate) fn picked<'t, 's>(&mut self, item: Item<'t, 's>) -> Option<Item<'t, 's>> {
        match pick_body(item) {
            None => Some(item),
            Some(body) => self.pick(body),
        }
    }

    fn pick<'t, 's>(&mut self, body: Item<'t, 's>) -> Option<Item<'t, 's>> {
        let fields = self.fields_unnamed(body, &PICK)?;
        let index = fields.get(1).and_then(|index| {
            self.path.push(Step::Field("index"));
            let number = self.number(index, &PICK.fields[1]);
            if number.is_some_and(|number| number.fract() != 0.0) {
                let fault =
                    Diagnostic::error(codes::NOT_WHOLE, index.span(), "the index of a pick must be a whole number");
                self.report(fault.expected("a whole number").hint("floor(..) of an expression is one"));
            }
            self.path.pop();
            number.filter(|number| number.fract() == 0.0)
        });
        let from = fields.get(0)?;
        self.path.push(Step::Field("from"));
        let found = self.pick_from(from, index);
        self.path.pop();
        // Picks may stand in picks, as deep as brackets may.
        found.and_then(|found| self.picked(found))
    }

    fn pick_from<'t, 's>(&mut self, from: Item<'t, 's>, index: Option<f64>) -> Option<Item<'t, 's>> {
        if is_expression(from) {
            let body = from.text().trim_start_matches('=').trim().to_owned();
            let message = "the `from` of a pick cannot be an expression";
            let fault = Diagnostic::error(codes::WRONG_TYPE, from.head(), message).expected("a list: [a, b, c]");
            let index = self.indices.last().map_or("0", |(index, _)| &**index);
            let way = format!("an item of a list in `vars` needs no pick: \"={body}[{index}]\"");
            self.report(fault.hint(way));
            return None;
        }
        if from.kind() != Kind::List {
            return self.wrong_type(from, &PICK.fields[0], "a list: [a, b, c]");
        }
        let count = from.solid_children().take(MOST_VALUES + 1).count();
        let fault = match count {
            0 if from.holds_damage() => return None,
            0 => {
                Diagnostic::error(codes::WRONG_COUNT, from.head(), "there is nothing to pick from").expected("a value")
            }
            count if count > MOST_VALUES => {
                let message = format!("there are more than {MOST_VALUES} values to pick from");
                Diagnostic::error(codes::TOO_MUCH, from.head(), message).expected("fewer")
            }
            _ => {
                self.chosen |= count > 1;
                return from.solid_children().nth(index?.rem_euclid(count as f64) as usize);
            }
        };
        self.report(fault);
        None
    }
}
