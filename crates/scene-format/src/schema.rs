//! The schema: types, fields, defaults, units and ranges as data. The macros of `words` make it from the Rust types and
//! their doc comments; the reader, the writer, the JSON Schema and the reference all go by it.

use crate::files::FileKind;
use crate::form::Form;
use crate::tree::{Item, Kind};

/// What a value of the language is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Type {
    Bool,
    Number,
    Integer,
    /// A name.
    Text,
    /// A path, relative to the scene file.
    File,
    /// Two numbers.
    Pair,
    /// Three numbers.
    Vector,
    /// Three rows of four numbers.
    Rows,
    /// Three numbers, one for grey, or `"#rrggbb"`.
    Color,
    List(&'static Type),
    /// What may stand in `vars`: numbers, vectors, colours, truth values, lists of these, expressions.
    Value,
    /// Names with values.
    Map(&'static Type),
    Struct(&'static StructDef),
    Enum(&'static EnumDef),
    /// `None` or a value.
    Optional(&'static Type),
    /// One of several, told apart by how they are written.
    OneOf(&'static [Type]),
    /// What holds the type that it is within: objects of a group.
    Later(fn() -> Type),
}

impl Type {
    /// Whether it may be `None`.
    pub fn takes_none(self) -> bool {
        match self.resolved() {
            Type::Optional(_) => true,
            Type::Enum(def) => def.variant("None").is_some(),
            Type::OneOf(kinds) => kinds.iter().any(|kind| kind.takes_none()),
            _ => false,
        }
    }

    /// Whether it is a colour or a number that may differ from place to place: a text that is neither a colour nor an
    /// expression is the name of a texture.
    pub fn is_texture(self) -> bool {
        match self.resolved() {
            Type::OneOf([Type::Color | Type::Number, Type::Later(_)]) => true,
            Type::Optional(inner) => inner.is_texture(),
            _ => false,
        }
    }

    /// Whether it is a list of values that stand in `vars`: numbers, points and colours, or lists of these. An
    /// expression may stand for it.
    pub fn is_of_values(self) -> bool {
        match self {
            Type::List(of) => {
                let is_value = matches!(of, Type::Number | Type::Integer | Type::Pair | Type::Vector | Type::Color);
                is_value || of.is_of_values()
            }
            Type::OneOf(kinds) => kinds.iter().any(|kind| kind.is_of_values()),
            _ => false,
        }
    }

    /// The fields of a group of the scene, also where a name may stand for it.
    pub fn group(self) -> Option<&'static StructDef> {
        match self {
            Type::Struct(def) => Some(def),
            Type::OneOf([Type::Text, Type::Struct(def)]) => Some(*def),
            _ => None,
        }
    }

    /// The type itself, where it is one that is told later.
    pub fn resolved(self) -> Type {
        match self {
            Type::Later(kind) => kind(),
            kind => kind,
        }
    }
}

/// A group of named fields.
#[derive(Debug)]
pub(crate) struct StructDef {
    /// `Sphere`
    pub name: &'static str,
    /// `a sphere`
    pub noun: &'static str,
    pub doc: &'static [&'static str],
    pub fields: &'static [FieldDef],
    /// The field that a single value without a name stands for: `Scale(2)`.
    pub bare: Option<&'static str>,
    /// Exactly one of these fields is written.
    pub exactly_one: &'static [&'static str],
}

/// A named field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FieldDef {
    pub name: &'static str,
    /// `the radius of a sphere`
    pub noun: &'static str,
    pub doc: &'static [&'static str],
    pub kind: Type,
    pub rule: Rule,
    /// `None`: the field must be written.
    pub default: Option<fn() -> Form>,
}

/// A choice.
#[derive(Debug)]
pub(crate) struct EnumDef {
    pub name: &'static str,
    /// `material`
    pub noun: &'static str,
    pub doc: &'static [&'static str],
    pub variants: &'static [VariantDef],
}

/// One of several kinds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VariantDef {
    pub name: &'static str,
    pub doc: &'static [&'static str],
    pub content: Content,
}

impl VariantDef {
    /// The kind that is a struct of its own, which tells its name and what it is.
    pub const fn of_struct(kind: Type) -> Self {
        match kind {
            Type::Struct(def) => VariantDef { name: def.name, doc: def.doc, content: Content::Struct(def) },
            _ => panic!("a kind has fields"),
        }
    }
}

impl VariantDef {
    /// All that is told of it: where its fields are a type of their own, what that says too, if it says more.
    pub fn prose(&self) -> String {
        let short = prose(self.doc);
        match &self.content {
            Content::Struct(def) if def.doc != self.doc => {
                let long = prose(def.doc);
                match long.starts_with(short.trim_end_matches('.')) {
                    true => long,
                    false => format!("{short}\n\n{long}"),
                }
            }
            _ => short,
        }
    }
}

/// What stands in the brackets after a variant's name.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Content {
    /// Nothing, and no brackets.
    Unit,
    /// One value.
    Value(FieldDef),
    /// Fields.
    Struct(&'static StructDef),
}

impl Type {
    /// Points and colours are one Rust type; the rule of a field says which of the two it holds.
    pub const fn of_field(self, rule: &Rule) -> Type {
        match self {
            Type::Vector if rule.color => Type::Color,
            Type::Optional(Type::Vector) if rule.color => Type::Optional(&Type::Color),
            other => other,
        }
    }
}

impl StructDef {
    pub fn field(&self, name: &str) -> Option<&'static FieldDef> {
        self.fields.iter().find(|field| field.name == name)
    }
}

impl Type {
    /// The most fields that a struct within it has.
    const fn most_fields(&self) -> usize {
        match self {
            Type::List(inner) | Type::Map(inner) | Type::Optional(inner) => inner.most_fields(),
            Type::Struct(def) => def.most_fields(),
            Type::Enum(def) => def.most_fields(),
            Type::OneOf(kinds) => {
                let (mut most, mut k) = (0, 0);
                while k < kinds.len() {
                    let of_kind = kinds[k].most_fields();
                    most = if of_kind > most { of_kind } else { most };
                    k += 1;
                }
                most
            }
            _ => 0,
        }
    }
}

impl StructDef {
    /// The most fields that it or a struct within it has. A `const fn`, so without iterators.
    pub const fn most_fields(&self) -> usize {
        let (mut most, mut k) = (self.fields.len(), 0);
        while k < self.fields.len() {
            let of_field = self.fields[k].kind.most_fields();
            most = if of_field > most { of_field } else { most };
            k += 1;
        }
        most
    }
}

impl EnumDef {
    /// The most fields that one of its kinds, or a struct within it, has.
    pub const fn most_fields(&self) -> usize {
        let (mut most, mut k) = (0, 0);
        while k < self.variants.len() {
            let of_variant = match &self.variants[k].content {
                Content::Unit => 0,
                Content::Value(field) => field.kind.most_fields(),
                Content::Struct(def) => def.most_fields(),
            };
            most = if of_variant > most { of_variant } else { most };
            k += 1;
        }
        most
    }

    pub fn variant(&self, name: &str) -> Option<&'static VariantDef> {
        self.variants.iter().find(|variant| variant.name == name)
    }
}

/// Which numbers a field takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    pub low: f64,
    pub high: f64,
    /// Whether `low` itself is out.
    pub above_low: bool,
    /// Whether `high` itself is out.
    pub below_high: bool,
}

/// What is asked of a value beyond its type.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule {
    pub range: Range,
    /// `a length`
    pub what: &'static str,
    /// `in the scene's unit`
    pub unit: &'static str,
    /// A vector that must not be zero.
    pub direction: bool,
    /// Three numbers that are a colour, and so may be written in other ways.
    pub color: bool,
    /// What a file that is named here holds.
    pub file: Option<FileKind>,
    /// A texture's own colour: its range is that of what the texture is of.
    pub of_texture: bool,
    /// Textures that are written here say what share of it is there: their colours go from 0 to 1 all the same.
    pub shared_out: bool,
}

/// Coordinates and lengths beyond this are refused: products of them would leave the range of 32-bit floats.
pub(crate) const MAX_LENGTH: f64 = 1e12;
/// Lengths below this are refused, for the same reason.
pub(crate) const MIN_LENGTH: f64 = 1e-12;
/// Light beyond this is refused: pictures hold 32-bit floats, and brighter things than lamps are in them.
pub(crate) const MAX_LIGHT: f64 = 1e30;

impl Rule {
    pub const ANY: Rule = Rule {
        range: Range { low: f64::NEG_INFINITY, high: f64::INFINITY, above_low: false, below_high: false },
        what: "",
        unit: "",
        direction: false,
        color: false,
        file: None,
        of_texture: false,
        shared_out: false,
    };

    /// The name of a file.
    pub const fn file(kind: FileKind) -> Rule {
        Rule { file: Some(kind), ..Rule::ANY }
    }

    /// A value from `low` to `high`, both allowed.
    pub const fn within(what: &'static str, low: f64, high: f64) -> Rule {
        Rule { range: Range { low, high, above_low: false, below_high: false }, what, ..Rule::ANY }
    }

    /// A value between `low` and `high`, neither allowed.
    pub const fn between(what: &'static str, low: f64, high: f64) -> Rule {
        Rule { range: Range { low, high, above_low: true, below_high: true }, what, ..Rule::ANY }
    }

    /// A coordinate of a point.
    pub const fn point() -> Rule {
        Rule::within("a point", -MAX_LENGTH, MAX_LENGTH).unit("in the scene's unit")
    }

    /// A direction of any length but zero.
    pub const fn direction() -> Rule {
        Rule { direction: true, ..Rule::within("a direction of any length but zero", -MAX_LENGTH, MAX_LENGTH) }
    }

    /// A length more than zero.
    pub const fn length(what: &'static str) -> Rule {
        let range = Range { low: MIN_LENGTH, high: MAX_LENGTH, above_low: false, below_high: false };
        Rule { range, what, unit: "in the scene's unit", ..Rule::ANY }
    }

    /// A share of light, 0 to 1 per channel.
    pub const fn share() -> Rule {
        Rule { color: true, ..Rule::within("a colour", 0.0, 1.0) }
    }

    /// What a texture has at one end: a share of light, or whatever the texture is of.
    pub const fn part() -> Rule {
        Rule { of_texture: true, ..Rule::share() }
    }

    /// Light, per channel.
    pub const fn light(unit: &'static str) -> Rule {
        Rule { color: true, unit, ..Rule::within("a colour", 0.0, MAX_LIGHT) }
    }

    /// What light is of, constant; or, by a texture, which share of it is where.
    pub const fn tint() -> Rule {
        Rule { shared_out: true, ..Rule::light("") }
    }

    /// Light as people see it.
    pub const fn amount(what: &'static str, unit: &'static str) -> Rule {
        Rule { unit, ..Rule::within(what, 0.0, MAX_LIGHT) }
    }

    /// A number for each channel, or one that a texture gives, none of which is light.
    pub const fn per_channel(what: &'static str, low: f64, high: f64) -> Rule {
        Rule { color: true, ..Rule::within(what, low, high) }
    }

    pub const fn unit(self, unit: &'static str) -> Rule {
        Rule { unit, ..self }
    }
}

impl Range {
    pub fn contains(&self, value: f64) -> bool {
        let low = if self.above_low { value > self.low } else { value >= self.low };
        let high = if self.below_high { value < self.high } else { value <= self.high };
        low && high
    }

    /// Whether this is a length: anything more than zero that can be reckoned with.
    pub fn is_length(&self) -> bool {
        self.low == MIN_LENGTH
    }

    /// `> 0`, `from 0 to 1`, `between 0 and 180`; empty when all numbers are in it.
    pub fn words(&self) -> String {
        let huge = self.high >= MAX_LENGTH;
        if self.is_length() || self.above_low && huge {
            "> 0".to_owned()
        } else if self.low.is_finite() && self.low > -MAX_LENGTH && huge {
            format!(">= {}", self.low)
        } else if huge {
            String::new()
        } else if self.low == self.high {
            format!("{}", self.low)
        } else if self.above_low && self.below_high {
            format!("between {} and {}, both excluded", self.low, self.high)
        } else if self.above_low {
            format!("> {}, at most {}", self.low, self.high)
        } else {
            format!("from {} to {}", grouped(self.low), grouped(self.high))
        }
    }
}

/// Whether a value is written as this kind is.
pub(crate) fn fits(item: Item<'_, '_>, kind: &Type) -> bool {
    let compound = matches!(item.kind(), Kind::Struct | Kind::Map) || item.name().is_some();
    match &kind.resolved() {
        Type::Text | Type::File => item.kind() == Kind::Text,
        Type::Enum(_) | Type::Struct(_) => compound,
        Type::List(_) => item.kind() == Kind::List,
        Type::Color => !compound,
        Type::Number | Type::Integer => matches!(item.kind(), Kind::Integer | Kind::Float),
        Type::Vector | Type::Pair => matches!(item.kind(), Kind::List | Kind::Tuple) && !compound,
        Type::Rows => is_rows(item),
        _ => !compound && item.kind() != Kind::Text,
    }
}

/// Whether these are three rows of four, each in brackets of its own.
pub(crate) fn is_rows(item: Item<'_, '_>) -> bool {
    let listed = |item: Item<'_, '_>| matches!(item.kind(), Kind::List | Kind::Tuple) && item.name().is_none();
    let four = |row: Item<'_, '_>| listed(row) && row.children().take(5).count() == 4;
    listed(item) && item.children().take(4).count() == 3 && item.children().all(four)
}

/// A number, with its digits in groups of three when there are many.
fn grouped(value: f64) -> String {
    let digits = format!("{value}");
    if value.fract() != 0.0 || value.abs() < 1e5 {
        return digits;
    }
    let (sign, digits) = digits.split_at(usize::from(value < 0.0));
    let mut out = sign.to_owned();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index) % 3 == 0 {
            out.push('_');
        }
        out.push(digit);
    }
    out
}

/// Doc comments as one paragraph.
pub(crate) fn prose(doc: &[&str]) -> String {
    doc.iter().map(|line| line.trim()).collect::<Vec<&str>>().join(" ")
}
