//! Numbers, texts, paths and lists.

use super::{Reader, describe, elsewhere, plain};
use crate::codes;
use crate::desc::PatternWords;
use crate::diagnostic::{Diagnostic, Edit, Spanned};
use crate::expression::{self, Named, Value};
use crate::files::joined;
use crate::form::Form;
use crate::schema::{FieldDef, Type};
use crate::suggest;
use crate::syntax::{Syntax, decode, units};
use crate::tree::{Item, Kind};
use crate::words::Words;
use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

/// What a field takes, in words and in the item's syntax: `a length > 0, in the scene's unit`.
pub(crate) fn expected_for(at: &FieldDef, item: Item<'_, '_>) -> String {
    let words = expected(at);
    match item.syntax() {
        Syntax::Ron => words,
        syntax => in_braces(&words.replace(": Camera(..)", ", by its fields"), syntax)
            .replace("((a, b, c, x), (d, e, f, y), (g, h, i, z))", "[[a, b, c, x], [d, e, f, y], [g, h, i, z]]")
            .replace("(a, b, c, x)", "[a, b, c, x]")
            .replace("(x, y, z)", "[x, y, z]")
            .replace("(x, y)", "[x, y]")
            .replace("(r, g, b)", "[r, g, b]")
            .replace("or None", &format!("or {}", none(syntax))),
    }
}

/// Kinds with brackets, `Texture(..)`, as TOML and JSON have them.
fn in_braces(words: &str, syntax: Syntax) -> String {
    let (mut out, mut rest) = (String::new(), words);
    while let Some((head, after)) = rest.split_once("(..)") {
        let name = head.rsplit(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or("");
        out += &head[..head.len() - name.len()];
        out += &syntax.of_toml(format!("{{ {name} = .. }}"));
        rest = after;
    }
    out + rest
}

/// What a field takes, in the words of RON.
pub(crate) fn expected(at: &FieldDef) -> String {
    let rule = &at.rule;
    let words = rule.range.words();
    let out = match (at.kind.resolved(), rule.what) {
        (Type::Bool, _) => "true or false".to_owned(),
        (Type::Number | Type::Integer, "") => "a number".to_owned(),
        (Type::Number | Type::Integer, what) => what.to_owned(),
        (Type::Text, _) => "a name between quotes".to_owned(),
        (Type::File, _) => "the name of a file, between quotes, relative to the scene file".to_owned(),
        (Type::Pair, what) => format!("{what}: (x, y)"),
        (Type::Vector, "") => "three numbers: (x, y, z)".to_owned(),
        (Type::Vector, what) => format!("{what}: (x, y, z)"),
        (Type::Rows, what) => format!("{what}: ((a, b, c, x), (d, e, f, y), (g, h, i, z))"),
        (Type::List(Type::Number), "a row") => "four numbers: (a, b, c, x)".to_owned(),
        (Type::Color | Type::Optional(Type::Color), _) => {
            let channels = if words.is_empty() { "channels" } else { "channels " };
            return with_unit(
                format!("a colour with {channels}{words}: (r, g, b), one number for grey, or \"#rrggbb\""),
                at,
            );
        }
        (Type::List(Type::Pair), _) => "a list of points: [(x, y), ..]".to_owned(),
        (Type::List(Type::List(Type::Pair)), _) => "a list of rings of points: [[(x, y), ..], ..]".to_owned(),
        (Type::List(Type::Vector), _) => "a list of points: [(x, y, z), ..]".to_owned(),
        (Type::List(_), _) => "a list: [a, b, c]".to_owned(),
        (Type::Optional(Type::Number), what) => {
            return format!("{}, or None", with_unit(format!("{what} {words}"), at));
        }
        (Type::Value, _) => "a number, a vector, a colour, true or false, or a list of these".to_owned(),
        (Type::Map(_), _) => return "names with their values: { \"name\": .. }".to_owned(),
        (Type::Struct(def), _) => def.noun.to_owned(),
        (Type::Enum(def), _) => super::variant::choices(def, Syntax::Ron),
        (Type::Optional(&Type::Enum(def)), _) => super::variant::choices(def, Syntax::Ron),
        (Type::OneOf([Type::Color, choice]) | Type::Optional(Type::OneOf([Type::Color, choice])), _) => {
            let Type::Enum(def) = choice.resolved() else { return "a colour".to_owned() };
            let choices = super::variant::choices(def, Syntax::Ron);
            let named = if at.kind.is_texture() { ", or a name from `textures`" } else { "" };
            return format!(
                "a colour with channels {words}: (r, g, b), one number for grey, \"#rrggbb\", or {choices}{named}"
            );
        }
        (Type::OneOf([Type::Number, Type::Later(_)]), what) => {
            let Type::Enum(def) = PatternWords::TYPE else { return what.to_owned() };
            let choices = super::variant::choices(def, Syntax::Ron);
            return format!("{what} {words}, or {choices}, or a name from `textures`");
        }
        (Type::OneOf([Type::Number, Type::Pair]), what) => format!("{what}, or one per side: (x, y)"),
        (Type::OneOf([Type::Number, Type::List(_)]), what) => {
            return with_unit(format!("{what} {words}, or a list of such numbers: [a, b, ..]"), at);
        }
        (Type::OneOf([Type::Number, ..]), what) => format!("{what}, or one per axis: (x, y, z)"),
        (Type::OneOf([Type::Text, Type::Struct(_)]), _) => {
            "a name from `cameras`, or a camera written here: Camera(..)".to_owned()
        }
        (Type::OneOf([Type::Text, ..]), _) => "the name of a material, or a material written here".to_owned(),
        (Type::OneOf(_), _) => "a value".to_owned(),
        (Type::Optional(Type::Text), _) => "a name between quotes".to_owned(),
        (Type::Optional(Type::Rows), what) => {
            return format!("{what}: ((a, b, c, x), (d, e, f, y), (g, h, i, z)), or None");
        }
        (Type::Optional(_), what) => format!("{what}: (x, y, z), or None"),
        (Type::Later(_), _) => "a value".to_owned(),
    };
    let out = if words.is_empty() { out } else { format!("{out} {words}") };
    with_unit(out, at)
}

/// How nothing is written in a syntax.
pub(crate) fn none(syntax: Syntax) -> &'static str {
    match syntax {
        Syntax::Ron => "None",
        Syntax::Toml => "\"None\"",
        Syntax::Json => "null",
    }
}

fn with_unit(words: String, at: &FieldDef) -> String {
    if at.rule.unit.is_empty() { words } else { format!("{words}, {}", at.rule.unit) }
}

/// The number of a text that is one with a short word after it: `100 W`.
pub(super) fn before_unit(text: &str) -> Option<&str> {
    let text = text.trim();
    let unit = text.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | '_' | ' '));
    let number = text[..text.len() - unit.len()].trim_end();
    let short = (1..=12).contains(&unit.len()) && unit.starts_with(|c: char| c.is_ascii_alphabetic());
    (short && decode::number(number).is_finite()).then_some(number)
}

/// Words that stand for numbers in other programs, and are no names.
const EVERYDAY: [&str; 17] = [
    "none",
    "null",
    "nil",
    "off",
    "no",
    "never",
    "true",
    "false",
    "yes",
    "on",
    "auto",
    "default",
    "max",
    "min",
    "inf",
    "infinite",
    "unlimited",
];

impl Reader<'_> {
    /// `null`, as JSON has it, for a field that cannot be `None`.
    pub(super) fn null<T>(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<T> {
        let message = format!("{} cannot be null", plain(at.noun));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.span(), message).expected(expected_for(at, item));
        if let Some(default) = at.default {
            fault.hint = "leave it out to get its default".to_owned();
            let replacement = crate::print::json_value(&default());
            if !replacement.is_empty() && replacement.len() <= super::told::SHOWN {
                fault.hint = format!("leave it out to get its default, {replacement}");
                fault.edit = Some(Edit { span: item.span(), replacement });
            }
        }
        self.report(fault);
        None
    }

    /// A number, in range or not.
    pub(crate) fn number(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<f64> {
        if let Some(value) = item.number() {
            return Some(value);
        }
        if let Some(value) = self.expression(item) {
            return value.and_then(|value| self.number_of(value, item, at));
        }
        if self.name_as_value(item, at) {
            return None;
        }
        let mut edit;
        if let Kind::Text | Kind::Word = item.kind() {
            let text = item.text();
            let trimmed = text.trim();
            edit = trimmed.parse::<f64>().ok().filter(|v| v.is_finite()).map(|value| match at.kind {
                // `"1.0"`, of which without quotes another fault would be left.
                Type::Integer if value.fract() == 0.0 => format!("{value}"),
                _ => trimmed.to_owned(),
            });
            let off = ["none", "off", "no", "never"].iter().any(|word| trimmed.eq_ignore_ascii_case(word));
            if off && matches!(at.kind, Type::Optional(Type::Number)) {
                edit = Some(none(item.syntax()).to_owned());
            }
            // A name of `vars` without its quotes, or without its sign.
            if self.knows_var(trimmed) || item.kind() == Kind::Text && self.is_reckoned(trimmed) {
                edit = Some(format!("\"={}\"", trimmed.trim_start_matches(['=', ' '])));
            }
            if hex_color(trimmed).is_some() && at.kind.is_texture() {
                let way = "it is one number for all colours: write 0.1, say".to_owned();
                return self.number_in_text(item, at, way, None);
            }
            if let Some((way, number)) = units::in_text(trimmed).filter(|_| edit.is_none()) {
                return self.number_in_text(item, at, way, number);
            }
        } else if let Kind::Tuple | Kind::List = item.kind() {
            if let Some(way) = of_counts(item, at).or_else(|| of_three(item, at)) {
                let message = format!("{} cannot be {}", plain(at.noun), describe(item));
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected_for(at, item));
                self.report(fault.hint(way));
                return None;
            }
            edit = elsewhere::number_elsewhere(item, at);
            if let Some(name) = item.name().filter(|name| edit.is_none() && name.starts_with(char::is_lowercase)) {
                let message = format!("{} cannot be {}", plain(at.noun), describe(item));
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected_for(at, item));
                self.report(fault.hint(format!(
                    "`{name}` is no function of values: write the number; functions stand in expressions, \"=sqrt(2)\""
                )));
                return None;
            }
        } else {
            edit = super::colors_elsewhere::in_other_brackets(item, at);
        }
        self.wrong_kind(item, at.noun, &expected_for(at, item), edit)
    }

    /// A name with a value in the way of another language, `"$h"`, or one that has none: reported here.
    fn name_as_value(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        if !matches!(item.kind(), Kind::Text | Kind::Word) {
            return false;
        }
        let text = item.text();
        let bare = text.trim();
        let inner = bare.trim_start_matches(['$', '{', '%', '@']).trim_end_matches(['}', '%']).trim();
        let name = inner.strip_prefix("vars.").unwrap_or(inner);
        let marked = name.len() < bare.len();
        let known = self.knows_var(bare);
        // A word where nothing has a name may be one; texts and words of every day are not.
        let word = item.kind() == Kind::Word && name.starts_with(|c: char| c.is_lowercase()) && !self.has_vars();
        let lower = name.to_ascii_lowercase();
        if !expression::is_name(name) || EVERYDAY.contains(&&*lower) || known || !(marked || word) {
            return false;
        }
        let message = format!("{} cannot be {}", plain(at.noun), super::describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected_for(at, item));
        if self.knows_var(name) {
            fault.hint = format!("write \"={name}\"");
            fault.edit = Some(Edit { span: item.span(), replacement: format!("\"={name}\"") });
        } else if item.syntax() == Syntax::Ron {
            fault.hint = crate::syntax::declarations::way(name, "..");
        } else {
            fault.hint = format!("values with names stand in `vars`, and are used so: \"={name}\"");
        }
        self.report(fault);
        true
    }

    /// Reports a number that stands in a text with its unit.
    fn number_in_text(
        &mut self,
        item: Item<'_, '_>,
        at: &'static FieldDef,
        way: String,
        number: Option<String>,
    ) -> Option<f64> {
        let message = format!("{} cannot be {}", plain(at.noun), super::describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected_for(at, item));
        fault.edit = number.map(|replacement| Edit { span: item.span(), replacement });
        self.report(fault.hint(way));
        None
    }

    /// Whether a text without `=` before it is an expression of names that are known: `2*r`.
    pub(super) fn is_reckoned(&self, text: &str) -> bool {
        let body = text.trim_start_matches(['=', ' ']);
        let known = |name: &str| self.knows_var(name) || matches!(name, "time" | "frame");
        let value = expression::evaluate(body, &mut |name| match known(name) {
            true => Named::Value(Value::Number(1.0)),
            false => Named::Unknown(Vec::new()),
        });
        body.bytes().any(|byte| b"+-*/^%(".contains(&byte)) && matches!(value, Ok(Value::Number(_)))
    }

    /// Reports a number that is not finite or not in the field's range; `channel` says which of several it is.
    pub(crate) fn check(
        &mut self,
        value: f64,
        item: Item<'_, '_>,
        at: &'static FieldDef,
        channel: &str,
    ) -> Option<f64> {
        let range = &at.rule.range;
        if range.contains(value) && value.is_finite() {
            return Some(value);
        }
        let noun = if channel.is_empty() { plain(at.noun) } else { format!("{channel} of {}", plain(at.noun)) };
        let (code, message) = if !value.is_finite() {
            (codes::NOT_FINITE, format!("{noun} must be a finite number"))
        } else if range.is_length() && value <= 0.0 {
            (codes::NOT_POSITIVE, format!("{noun} must be positive"))
        } else if range.is_length() && value < range.low {
            (codes::OUT_OF_RANGE, format!("{noun} is too small to reckon with"))
        } else if range.low == 0.0 && !range.above_low && value < 0.0 {
            (codes::NEGATIVE, format!("{noun} must not be negative"))
        } else if value.abs() > crate::schema::MAX_LENGTH && range.high >= crate::schema::MAX_LENGTH {
            (codes::OUT_OF_RANGE, format!("{noun} is too large to reckon with"))
        } else if value < range.low || range.above_low && value == range.low {
            let bound = if range.above_low { "more than" } else { "at least" };
            (codes::OUT_OF_RANGE, format!("{noun} must be {bound} {}", range.low))
        } else {
            let bound = if range.below_high { "less than" } else { "at most" };
            (codes::OUT_OF_RANGE, format!("{noun} must be {bound} {}", range.high))
        };
        let mut fault = Diagnostic::error(code, item.span(), message).expected(expected_for(at, item));
        if code == codes::OUT_OF_RANGE && (value.abs() > range.high.abs() && range.high >= crate::schema::MAX_LENGTH) {
            fault.hint = "numbers so large leave the range of the arithmetic; choose a larger unit".to_owned();
        } else if range.is_length() && value > 0.0 && value < range.low {
            fault.hint = "numbers so small leave the range of the arithmetic; choose a smaller unit".to_owned();
        } else if range.high == 1.0 && value > 1.0 && value <= 255.0 && at.rule.color {
            fault.hint = if value > 2.0 && value.fract() == 0.0 {
                "channels go from 0 to 1; write \"#rrggbb\" for values up to 255".to_owned()
            } else {
                match at.name {
                    "backdrop" => "1 is white paper; nothing on a screen is brighter".to_owned(),
                    "weight" => "1 is all of the second".to_owned(),
                    _ => "a surface cannot reflect more than it gets".to_owned(),
                }
            };
        }
        // Zero and infinity are what other programs write for "no limit".
        if matches!(at.kind, Type::Optional(Type::Number)) && (value == 0.0 || value == f64::INFINITY) {
            fault.hint = format!("{} turns it off", none(item.syntax()));
            fault.edit = Some(Edit { span: item.span(), replacement: none(item.syntax()).to_owned() });
        }
        if at.name == "shutter" && value > 1.0 && value <= 360.0 {
            let share = format!("{}", (value / 360.0 * 1e4).round() / 1e4);
            fault.hint = format!("it is a share of a frame: {value} degrees are {share}");
        }
        if value == 0.0 && at.noun == "the radius of a sphere light" {
            fault.hint = "a light without size is a small sphere: radius: 0.1".to_owned();
        }
        if at.name == "fov" && (180.0..=240.0).contains(&value) && range.high == 180.0 {
            let way = format!(
                "so much is seen by a fisheye, which has its own: projection = {{ Fisheye = {{ fov = {value} }} }}"
            );
            fault.hint = match item.syntax() {
                Syntax::Ron => {
                    format!("so much is seen by a fisheye, which has its own: projection: Fisheye(fov: {value})")
                }
                syntax => syntax.of_toml(way).into_owned(),
            };
        }
        if let (codes::NOT_POSITIVE, Some(way)) = (code, self.never_zero(item)) {
            fault.hint = way;
        }
        self.report(fault);
        None
    }
}

impl Words for f64 {
    const TYPE: Type = Type::Number;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let value = reader.number(item, at)?;
        reader.check(value, item, at, "")
    }

    fn form(&self, _all: bool) -> Form {
        Form::Number(*self)
    }
}

impl Words for u32 {
    const TYPE: Type = Type::Integer;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let value = reader.number(item, at)?;
        if (item.kind() == Kind::Float || value.fract() != 0.0) && value.is_finite() {
            let mut fault =
                Diagnostic::error(codes::NOT_WHOLE, item.span(), format!("{} must be a whole number", plain(at.noun)))
                    .expected(expected_for(at, item));
            if item.kind() == Kind::Text {
                fault.hint = format!("the expression is {value}");
            }
            if value.fract() == 0.0 && at.rule.range.contains(value) {
                fault.hint = format!("write {value}");
                fault.edit = Some(Edit { span: item.span(), replacement: format!("{value}") });
            }
            reader.report(fault);
            return None;
        }
        let value = reader.check(value, item, at, "")?;
        // The ranges of whole numbers end within u32.
        Some(value as u32)
    }

    fn form(&self, _all: bool) -> Form {
        Form::Integer(u64::from(*self))
    }
}

impl Words for bool {
    const TYPE: Type = Type::Bool;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if item.kind() == Kind::Bool {
            return Some(item.lexeme() == "true");
        }
        if let Some(value) = reader.expression(item) {
            return match value? {
                Value::Bool(value) => Some(value),
                other => reader.wrong_value(&other, item, at),
            };
        }
        let text = item.text().to_ascii_lowercase();
        let edit = match text.as_str() {
            "true" | "yes" | "on" | "1" => Some("true".to_owned()),
            "false" | "no" | "off" | "0" => Some("false".to_owned()),
            _ => suggest::nearest(&text, ["true", "false"]).map(str::to_owned),
        };
        reader.wrong_kind(item, at.noun, &expected_for(at, item), edit)
    }

    fn form(&self, _all: bool) -> Form {
        Form::Bool(*self)
    }
}

impl Reader<'_> {
    /// A text that is not empty.
    pub(crate) fn text<'s>(&mut self, item: Item<'_, 's>, at: &'static FieldDef) -> Option<Cow<'s, str>> {
        if item.kind() != Kind::Text {
            let word = (matches!(item.kind(), Kind::Word | Kind::Char) && !item.is_null())
                .then(|| crate::print::text(&item.text(), item.syntax()));
            return self.wrong_kind(item, at.noun, &expected_for(at, item), word);
        }
        let text = item.text();
        if text.trim().is_empty() {
            self.report(
                Diagnostic::error(codes::EMPTY_TEXT, item.span(), format!("{} is empty", plain(at.noun)))
                    .expected(expected_for(at, item)),
            );
            return None;
        }
        Some(text)
    }
}

impl Words for Arc<Path> {
    const TYPE: Type = Type::File;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let text = reader.text(item, at)?;
        let folder = item.folder();
        // Paths in an included file start from that file.
        let path = match folder.as_os_str().is_empty() {
            true => std::borrow::Cow::Borrowed(Path::new(&*text)),
            false => std::borrow::Cow::Owned(joined(folder, &text)),
        };
        let known = reader.file.as_ref().filter(|file| file.as_os_str() == path.as_os_str());
        let file = known.map_or_else(|| Arc::from(&*path), Arc::clone);
        reader.file = Some(Arc::clone(&file));
        if let Some(kind) = at.rule.file {
            reader.sink.files.add(kind, &file, item.span());
        }
        Some(file)
    }

    fn form(&self, _all: bool) -> Form {
        Form::Text(self.to_string_lossy().into_owned())
    }
}

impl<T: Words> Words for Spanned<T> {
    const TYPE: Type = T::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let value = T::read(reader, item, at)?;
        Some(Spanned { value, span: item.span() })
    }

    fn form(&self, all: bool) -> Form {
        self.value.form(all)
    }
}

impl<T: Words> Words for Box<T> {
    const TYPE: Type = T::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        T::read(reader, item, at).map(Box::new)
    }

    fn form(&self, all: bool) -> Form {
        (**self).form(all)
    }
}

impl<T: Words> Words for Vec<T> {
    const TYPE: Type = Type::List(&T::TYPE);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.list(item, at)
    }

    fn form(&self, all: bool) -> Form {
        Form::list(self.iter().map(|item| item.form(all)))
    }
}

/// Values that may be `None`.
macro_rules! optional {
    ($($ty:ty),+) => {$(
        impl Words for Option<$ty> {
            const TYPE: Type = Type::Optional(&<$ty as Words>::TYPE);

            fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
                if item.is_word("None") {
                    return Some(None);
                }
                <$ty>::read(reader, item.without_some(), at).map(Some)
            }

            fn form(&self, all: bool) -> Form {
                self.as_ref().map_or(Form::word("None"), |value| value.form(all))
            }
        }
    )+};
}

optional!(
    f64,
    crate::desc::Vec3,
    Spanned<crate::desc::matrix::Rows>,
    Spanned<crate::desc::Color>,
    Spanned<f64>,
    crate::desc::Metal,
    crate::desc::Albedo
);

/// What is said of more counts than one.
fn of_counts(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    let counts = elsewhere::numbers(item).filter(|_| at.noun == "the count of a repetition")?;
    let deep = counts.last().filter(|_| counts.len() > 1)?;
    let grid = elsewhere::vector(item, &[counts[0], "1", deep]);
    let grid = match item.syntax() {
        Syntax::Ron => format!("Grid(count: {grid})"),
        syntax => syntax.of_toml(format!("{{ Grid = {{ count = {grid} }} }}")).into_owned(),
    };
    Some(format!("it counts one way: a `Repeat` in its `items` makes rows, or the `placements` of one object: {grid}"))
}

/// What is said of three numbers where one stands: an ellipsoid's radii, indices of refraction by wavelengths.
fn of_three(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    let three = elsewhere::numbers(item).filter(|three| three.len() == 3 && item.name().is_none())?;
    match (at.name, at.noun) {
        ("radius", "the radius of a sphere") => {
            let origin = elsewhere::vector(item, &["0", "0", "0"]);
            let way = elsewhere::ellipsoid(item, Some(&origin))?;
            Some(format!("an ellipsoid is a sphere that is stretched about its centre: `{way}`"))
        }
        ("ior", _) => Some(format!("there are no wavelengths: write one number, {}", three[1])),
        _ => None,
    }
}

/// The value of a hexadecimal colour `#rrggbb` (sRGB), linear.
pub(crate) fn hex_color(text: &str) -> Option<[f64; 3]> {
    let digits =
        text.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let value = u32::from_str_radix(digits, 16).ok()?;
    Some([value >> 16, value >> 8, value].map(|channel| linear_from_srgb(f64::from(channel & 0xff) / 255.0)))
}

/// Whether a text looks like the path of a picture.
pub(crate) fn is_picture(text: &str) -> bool {
    let (_, suffix) = text.rsplit_once('.').unwrap_or_default();
    ["png", "jpg", "jpeg", "hdr", "exr"].iter().any(|known| suffix.eq_ignore_ascii_case(known))
}

/// The sRGB decoding of IEC 61966-2-1, by `libm`, so that it gives the same bits everywhere.
pub(crate) fn linear_from_srgb(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}
