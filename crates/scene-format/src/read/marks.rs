//! Reads marks: points by names.

use super::{Reader, Step, shortened};
use crate::codes;
use crate::desc::{Mark, Vec3};
use crate::diagnostic::{Diagnostic, Spanned};
use crate::form::{Entry, Form};
use crate::schema::{FieldDef, Rule, Type};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};
use crate::words::Words;

static POINT: FieldDef =
    FieldDef { name: "mark", noun: "a mark", doc: &[], kind: Type::Vector, rule: Rule::point(), default: None };

/// `{ "name": point }`
impl Words for Vec<Mark> {
    const TYPE: Type = Type::Map(&Type::Vector);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(Vec::new()),
            _ => {
                let expected = match item.syntax() {
                    Syntax::Ron => "names with their points: { \"A\": (0, 1, 0) }",
                    Syntax::Toml => "names with their points: { A = [0, 1, 0] }",
                    Syntax::Json => "names with their points: { \"A\": [0, 1, 0] }",
                };
                return reader.wrong_type(item, at, expected);
            }
        }
        let mut marks: Vec<Mark> = Vec::new();
        for (key, value) in item.fields() {
            if reader.sink.is_full() {
                break;
            }
            let name = key.text().into_owned();
            reader.path.push(Step::Key(name.clone()));
            if name.trim().is_empty() {
                let fault = Diagnostic::error(codes::EMPTY_TEXT, key.span(), "the name of a mark is empty");
                reader.report(fault.expected("a name between quotes"));
            }
            if let Some(first) = marks.iter().find(|mark| mark.name.value == name) {
                let message = format!("the mark \"{}\" is there twice", shortened(&name));
                let fault = Diagnostic::error(codes::DUPLICATE_NAME, key.span(), message);
                reader.report(fault.expected("a name of its own for each mark").label(first.name.span, "the first"));
            } else if let Some(point) = Spanned::<Vec3>::read(reader, value, &POINT) {
                marks.push(Mark { name: Spanned { value: name, span: key.span() }, point });
            }
            reader.path.pop();
        }
        Some(marks)
    }

    fn form(&self, all: bool) -> Form {
        Form::Map(self.iter().map(|mark| Entry::new(mark.name.value.clone(), mark.point.form(all))).collect())
    }
}
