//! Vectors, colours and factors: three numbers, or what stands for three.

use super::value::expected_for;
use super::{Reader, colors_elsewhere, describe, elsewhere, plain};
use crate::codes;
use crate::desc::{Vec3, is_texture};
use crate::diagnostic::{Diagnostic, Edit};
use crate::expression::Value;
use crate::form::Form;
use crate::schema::{FieldDef, Type};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};
use crate::words::Words;

/// More numbers than this in a vector are not counted.
const MANY: usize = 1000;
/// Names of the three numbers of a vector.
const AXES: [&str; 3] = ["the x coordinate", "the y coordinate", "the z coordinate"];
/// Names of the three numbers of a colour.
const CHANNELS: [&str; 3] = ["the red channel", "the green channel", "the blue channel"];

/// What is said of a long expression that comes to 0 or less.
const ABOVE_ZERO: &str = "write \"=max(.., 0.001)\" around the expression, which stays above 0";

/// Whether a texture is written here.
fn is_of_texture(item: Item<'_, '_>) -> bool {
    let of_map = || item.kind() == Kind::Map && item.fields().next().is_some_and(|(key, _)| is_texture(&key.text()));
    item.name().is_some_and(is_texture) || of_map()
}

/// A texture that stands where an amount of light is due.
fn texture_as_amount(item: Item<'_, '_>, at: &'static FieldDef) -> Diagnostic {
    let message = format!("{} cannot be {}", plain(at.noun), describe(item));
    let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected_for(at, item));
    fault.hint(match item.syntax() {
        Syntax::Ron => "the texture of a lamp is the `color` of `Emissive`: radiance: 5, color: Noise()",
        Syntax::Toml => "the texture of a lamp is the color of Emissive: radiance = 5, color = { Noise = {} }",
        Syntax::Json => "the texture of a lamp is the \"color\" of Emissive: { \"Noise\": {} }, say",
    })
}

/// How many numbers each item of a list has, and what these are.
fn of_groups(at: &FieldDef) -> Option<(usize, &'static str)> {
    match at.kind {
        Type::List(Type::Vector) => Some((3, "points")),
        Type::List(Type::Pair) => Some((2, "points")),
        Type::List(Type::List(Type::Integer)) => Some((3, "faces")),
        _ => None,
    }
}

fn group(numbers: &[&str], what: &str, syntax: Syntax) -> String {
    match (syntax, what) {
        (Syntax::Ron, "points") => format!("({})", numbers.join(", ")),
        _ => format!("[{}]", numbers.join(", ")),
    }
}

/// Numbers one after the other in brackets of their own, as the items of a list.
pub(super) fn in_groups(item: Item<'_, '_>, at: &FieldDef) -> Option<String> {
    // Of longer ones the hint is enough.
    const MOST: usize = 300;
    let (count, what) = of_groups(at)?;
    let numbers: Option<Vec<&str>> =
        item.children().take(MOST + 1).map(|child| child.number().map(|_| child.lexeme())).collect();
    let all = numbers.filter(|all| !all.is_empty() && all.len() <= MOST && all.len() % count == 0)?;
    let groups: Vec<String> = all.chunks(count).map(|numbers| group(numbers, what, item.syntax())).collect();
    Some(format!("[{}]", groups.join(", ")))
}

impl Reader<'_> {
    /// Numbers one after the other where points or faces stand, `[0, 0, 0, 1, 0, 0]`: reports them once, and says that
    /// it did.
    pub(super) fn flat_list(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        let Some((count, what)) = of_groups(at) else { return false };
        if item.children().next().is_none_or(|first| first.number().is_none()) {
            return false;
        }
        let names = ["a", "b", "c"];
        let message = format!("{} are {what}, {count} numbers each in brackets of their own", plain(at.noun));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected(format!("[{}, ..]", group(&names[..count], what, item.syntax())));
        if let Some(mended) = in_groups(item, at) {
            fault = fault.hint(format!("write {}", super::hinted(&mended)));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        }
        self.report(fault);
        true
    }

    /// Three numbers in brackets of either kind, each in the field's range.
    fn three(&mut self, item: Item<'_, '_>, at: &'static FieldDef, names: [&str; 3]) -> Option<Vec3> {
        if let Some(value) = item.three_numbers()
            && value.iter().all(|number| number.is_finite() && at.rule.range.contains(*number))
        {
            return Some(value);
        }
        self.numbers(item, at, names)
    }

    /// So many numbers in brackets of either kind, each in the field's range.
    pub(crate) fn numbers<const N: usize>(
        &mut self,
        item: Item<'_, '_>,
        at: &'static FieldDef,
        names: [&str; N],
    ) -> Option<[f64; N]> {
        if let Some(value) = self.expression(item) {
            return self.numbers_of(&value?, item, at, names);
        }
        let is_vector = matches!(item.kind(), Kind::List | Kind::Tuple) && item.name().is_none();
        if N == 3 && self.bytes_as_color(item, at) {
            return None;
        }
        if !is_vector {
            if at.name == "radiance" && is_of_texture(item) {
                self.report(texture_as_amount(item, at));
                return None;
            }
            if let Some(way) = elsewhere::dotted(item, at, N) {
                let message = format!("{} cannot be {}", plain(at.noun), describe(item));
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message);
                self.report(fault.expected(expected_for(at, item)).hint(way));
                return None;
            }
            if let Some(size) = item.number().filter(|_| at.noun == "the size of a height field") {
                let message = format!("{} cannot be {}", plain(at.noun), describe(item));
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message);
                let way = elsewhere::vector(item, &[item.lexeme(), &format!("{}", size / 4.0), item.lexeme()]);
                let way = format!("write {way}, say: along x, how high white is, along z");
                self.report(fault.expected(expected_for(at, item)).hint(way));
                return None;
            }
            let by_name = || {
                self.constant_by_name(item).filter(|_| at.rule.color && matches!(item.kind(), Kind::Word | Kind::Char))
            };
            let edit = elsewhere::vector_elsewhere(item, at, N).or_else(by_name);
            return self.wrong_kind(item, at.noun, &expected_for(at, item), edit);
        }
        let mut children = item.children();
        let first: [Option<Item<'_, '_>>; N] = std::array::from_fn(|_| children.next());
        let count = first.iter().flatten().count() + children.take(MANY).count();
        let mut value = [0.0; N];
        let mut good = true;
        // Which of four numbers is wrong nobody knows: then only their number is told.
        for ((child, slot), name) in first.into_iter().flatten().zip(&mut value).zip(names).take_while(|_| count == N) {
            if child.kind() == Kind::Broken {
                good = false;
                continue;
            }
            // Numbers of the wrong kind are reported one by one.
            match self.number(child, at).and_then(|number| self.check(number, child, at, name)) {
                Some(number) => *slot = number,
                None => good = false,
            }
        }
        if count == N {
            return good.then_some(value);
        }
        if !item.is_damaged() {
            self.wrong_count(item, at, count, N);
        }
        None
    }

    /// Reports `count` numbers where there should be `right`.
    pub(super) fn wrong_count(&mut self, item: Item<'_, '_>, at: &'static FieldDef, count: usize, right: usize) {
        let numbers = match count {
            0 => "none".to_owned(),
            1 => "one".to_owned(),
            count if count > MANY => "so many".to_owned(),
            count => count.to_string(),
        };
        let right_word = ["two", "three", "four"].get(right.wrapping_sub(2)).copied().unwrap_or("more");
        let message = format!("{} has {right_word} numbers, not {numbers}", plain(at.noun));
        let mut fault = Diagnostic::error(codes::WRONG_COUNT, item.head(), message).expected(expected_for(at, item));
        let inner = item.children().next().filter(|inner| count == 1 && inner.name().is_none());
        let inner = inner.filter(|inner| elsewhere::numbers(*inner).is_some_and(|numbers| numbers.len() == right));
        if let Some(inner) = inner {
            fault = fault.hint(format!("one pair of brackets is too many: write {}", inner.lexeme()));
            fault.edit = Some(Edit { span: item.span(), replacement: inner.lexeme().to_owned() });
        } else if let Some(mended) = with_decimal_points(item, right) {
            fault = fault.hint(format!("numbers have a decimal point: {mended}"));
            // One comma alone without a blank may be a slip: `(1,0, 0, 1)`.
            let is_certain = count > right + 1;
            fault.edit = is_certain.then(|| Edit { span: item.span(), replacement: mended });
            if let Some(opaque) = colors_elsewhere::without_alpha(item, at, right) {
                fault.hint = format!("{}; or, without an alpha, {opaque}", fault.hint);
            }
        } else if let Some(mended) = colors_elsewhere::without_alpha(item, at, right) {
            fault = fault.hint(format!("colours have no alpha here: write {mended}"));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        } else if let Some(mended) = elsewhere::grid(item, at).filter(|_| count == 2) {
            let replacement = elsewhere::vector(item, &mended.each_ref().map(|number| &**number));
            fault = fault.hint(format!("y is up: write {replacement}"));
            fault.edit = Some(Edit { span: item.span(), replacement });
        } else if at.rule.color && count == 4 {
            fault = fault.hint(match at.name {
                "background" => "colours have no alpha here; a picture without background: output: Output(alpha: true)",
                _ => "colours have no alpha here; what is seen through has the material Transparent(..)",
            });
        }
        self.report(fault);
    }

    /// So many numbers that an expression has come to, each in the field's range.
    fn numbers_of<const N: usize>(
        &mut self,
        value: &Value,
        item: Item<'_, '_>,
        at: &'static FieldDef,
        names: [&str; N],
    ) -> Option<[f64; N]> {
        let Ok(numbers) = <[f64; N]>::try_from(value.numbers()) else { return self.wrong_value(value, item, at) };
        for (number, name) in numbers.into_iter().zip(names) {
            self.check(number, item, at, name)?;
        }
        Some(numbers)
    }

    /// One number for all, or so many; for fields that take both.
    pub(crate) fn one_or_more<const N: usize>(
        &mut self,
        item: Item<'_, '_>,
        at: &'static FieldDef,
        names: [&str; N],
    ) -> Option<[f64; N]> {
        if let Some(value) = self.expression(item) {
            return match value? {
                Value::Number(number) => Some([self.check(number, item, at, "")?; N]),
                value => self.numbers_of(&value, item, at, names),
            };
        }
        if let Kind::List | Kind::Tuple = item.kind() {
            return self.numbers(item, at, names);
        }
        if let Some(mended) = colors_elsewhere::numbers_in_text(item, N) {
            return self.wrong_kind(item, at.noun, &expected_for(at, item), Some(mended));
        }
        let number = self.number(item, at)?;
        Some([self.check(number, item, at, "")?; N])
    }

    /// What keeps an expression above zero; `None` where the value is none of an expression.
    pub(super) fn never_zero(&mut self, item: Item<'_, '_>) -> Option<String> {
        let is_item = self.vars.element.as_ref().is_some_and(|(of, _)| *of == item.index() as u32);
        if is_item || !super::is_expression(item) {
            return None;
        }
        if self.expression(item)??.numbers().is_empty() {
            return None;
        }
        let text = item.text();
        let body = text.trim_start_matches('=').trim();
        let short = body.chars().count() <= super::SHOWN;
        Some(if short { format!("write \"=max({body}, 0.001)\", which stays above 0") } else { ABOVE_ZERO.to_owned() })
    }

    /// A factor per axis, or one for all; none may be zero.
    pub(crate) fn factor(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Vec3> {
        let factor = match item.kind() {
            Kind::List | Kind::Tuple => self.three(item, at, AXES)?,
            _ => self.one_or_more(item, at, AXES)?,
        };
        if factor.iter().any(|f| f.abs() < crate::schema::MIN_LENGTH) {
            self.report(
                Diagnostic::error(
                    codes::SINGULAR_TRANSFORM,
                    item.head(),
                    "a scale of zero leaves nothing of the object",
                )
                .expected("factors other than zero; negative ones mirror"),
            );
            return None;
        }
        Some(factor)
    }
}

/// `(0.5, 1, 2)` for `(0,5, 1, 2)`: commas with no space after them, when that makes so many numbers.
fn with_decimal_points(item: Item<'_, '_>, count: usize) -> Option<String> {
    let lexeme = item.lexeme();
    let inner = lexeme.get(1..lexeme.len().checked_sub(1)?)?;
    let numbers: Vec<&str> = inner.split(", ").collect();
    let decimal = |number: &str| match number.trim().split_once(',') {
        Some((whole, fraction)) => {
            let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            digits(whole.trim_start_matches(['-', '+'])) && digits(fraction)
        }
        None => true,
    };
    (numbers.len() == count && numbers.iter().all(|number| decimal(number))).then(|| {
        let numbers: Vec<String> = numbers.iter().map(|number| number.trim().replace(',', ".")).collect();
        format!("{}{}{}", &lexeme[..1], numbers.join(", "), &lexeme[lexeme.len() - 1..])
    })
}

impl Words for Vec3 {
    const TYPE: Type = Type::Vector;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        // Colours and points are the same Rust type; what they are in the language stands in the rule.
        if at.rule.color {
            return match item.kind() {
                Kind::Integer if item.lexeme().starts_with("0x") && item.lexeme().len() == 8 => {
                    reader.hexadecimal(item, at)
                }
                Kind::Integer | Kind::Float => {
                    let grey = reader.number(item, at)?;
                    Some([reader.check(grey, item, at, "")?; 3])
                }
                Kind::Text if super::is_expression(item) => reader.one_or_more(item, at, CHANNELS),
                Kind::Text => reader.text_color(item, at),
                _ => reader.three(item, at, CHANNELS),
            };
        }
        let vector = reader.three(item, at, AXES)?;
        let length2: f64 = vector.iter().map(|v| v * v).sum();
        if at.rule.direction && length2 == 0.0 {
            reader.report(
                Diagnostic::error(
                    codes::ZERO_DIRECTION,
                    item.head(),
                    format!("{} has no length, so it points nowhere", plain(at.noun)),
                )
                .expected(expected_for(at, item)),
            );
            return None;
        }
        Some(vector)
    }

    fn form(&self, _all: bool) -> Form {
        Form::vector(*self)
    }
}
