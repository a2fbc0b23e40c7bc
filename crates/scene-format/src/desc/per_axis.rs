//! Numbers per axis, or one for all.

use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::Item;
use crate::words::Words;

/// A number for each axis, written as so many numbers or as one for all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerAxis<const N: usize>(pub [f64; N]);

/// How numbers are told apart in messages.
const NAMES: [&str; 3] = ["the first number", "the second number", "the third number"];

impl<const N: usize> PerAxis<N> {
    fn read_numbers(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.one_or_more(item, at, std::array::from_fn(|k| NAMES[k])).map(PerAxis)
    }

    fn as_form(&self) -> Form {
        let all = self.0[0];
        if self.0.iter().all(|&x| x == all) {
            Form::Number(all)
        } else {
            Form::Vector(self.0.iter().map(|&x| Form::Number(x)).collect())
        }
    }
}

impl Words for PerAxis<2> {
    const TYPE: Type = Type::OneOf(&[Type::Number, Type::Pair]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        Self::read_numbers(reader, item, at)
    }

    fn form(&self, _all: bool) -> Form {
        self.as_form()
    }
}

impl Words for PerAxis<3> {
    const TYPE: Type = Type::OneOf(&[Type::Number, Type::Vector]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        Self::read_numbers(reader, item, at)
    }

    fn form(&self, _all: bool) -> Form {
        self.as_form()
    }
}

/// Two numbers.
impl Words for [f64; 2] {
    const TYPE: Type = Type::Pair;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.numbers(item, at, [NAMES[0], NAMES[1]])
    }

    fn form(&self, _all: bool) -> Form {
        Form::Vector(self.iter().map(|&x| Form::Number(x)).collect())
    }
}

/// Three whole numbers.
impl Words for [u32; 3] {
    const TYPE: Type = Type::Vector;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let numbers = reader.numbers(item, at, NAMES)?;
        if numbers.iter().all(|x| x.fract() == 0.0) {
            return Some(numbers.map(|x| x as u32));
        }
        let message = format!("{} must be whole numbers", at.noun);
        reader.report(
            Diagnostic::error(codes::NOT_WHOLE, item.span(), message)
                .expected("three whole numbers, such as (5, 1, 5)"),
        );
        None
    }

    fn form(&self, _all: bool) -> Form {
        Form::Vector(self.iter().map(|&x| Form::Number(f64::from(x))).collect())
    }
}
