//! Reads and reckons an expression in one go, by recursive descent.
//!
//! ```text
//! or = and {"||" and}; and = cmp {"&&" cmp}; cmp = sum [("<"|"<="|">"|">="|"=="|"!=") sum]
//! sum = term {("+"|"-") term}
//! term = unary {("*"|"/"|"%") unary}; unary = ("-"|"!") unary | power; power = postfix ["^" unary]
//! postfix = atom {"." ("x"|"y"|"z"|"r"|"g"|"b") | "[" or "]"}
//! atom = number | "#rrggbb" | "true" | "false" | name | name "(" [or {"," or}] ")" | "(" or ["," or ["," or]] ")"
//! ```

use super::functions::{CONSTANTS, FUNCTIONS, Function, why_no_keyframes};
use super::{Failure, Fault, MAX_BYTES, MAX_DEPTH, MOMENT, Named, Value};
use crate::codes;
use crate::codes::Code;
use crate::suggest;
use std::borrow::Cow;
use std::ops::Range;

/// Reckons a text; `name` tells what a name stands for.
///
/// # Errors
/// What is wrong, with its place in the text; `None` where that was reported by `name`.
pub(crate) fn evaluate(text: &str, name: &mut dyn FnMut(&str) -> Named) -> Result<Value, Failure> {
    let mut parser = Parser { text, at: 0, depth: 0, idle: false, name };
    if text.len() > MAX_BYTES {
        return Err(parser.syntax(0..0, "the expression is too long", format!("at most {MAX_BYTES} bytes")));
    }
    let value = parser.or()?;
    parser.space();
    if parser.at < text.len() {
        let rest = parser.rest_word();
        let found = &text[rest.clone()];
        let hint = operator_of_others(found).unwrap_or_default();
        let message = format!("`{found}` does not go on the expression");
        let fault = parser.syntax(rest, &message, "an operator, or the end");
        return Err(fault.map(|fault| Fault { hint: hint.to_owned(), ..fault }));
    }
    Ok(value)
}

/// How one does without an operator of other languages.
fn operator_of_others(sign: &str) -> Option<&'static str> {
    Some(match sign {
        "?" | "if" | "else" | "then" => "a choice is written if(condition, a, b)",
        "," => {
            "three numbers in brackets are a point or a colour, (1, 2, 3); else each number is an expression of its own"
        }
        "and" | "AND" | "&" => "both are meant by `&&`",
        "or" | "OR" | "|" => "one of them is meant by `||`",
        "not" | "NOT" => "the opposite is written with `!`",
        "=" => "whether two are the same is asked by `==`",
        "mod" | "div" => "the rest of a division is written with `%`: x%2",
        _ => return None,
    })
}

/// What other languages call constants, or the place where their functions stand.
fn name_of_others(name: &str) -> Option<&'static str> {
    Some(match name {
        "PI" | "Pi" | "M_PI" => "that is `pi`",
        "tau" | "TAU" => "that is 2*pi",
        "e" | "E" | "M_E" => "that is exp(1)",
        "math" | "Math" | "np" | "numpy" | "std" => "functions stand alone: sin(x)",
        "True" | "TRUE" => "that is `true`",
        "False" | "FALSE" => "that is `false`",
        "not" => "the opposite is written with `!`",
        "i" | "index" | "idx" => "`i` counts the times of a `Repeat`, and stands within it",
        _ => return None,
    })
}

/// What other programs call frames and time.
fn moment_of_others(name: &str) -> Option<&'static str> {
    Some(match name.to_ascii_lowercase().as_str() {
        "frame_current" | "current_frame" | "frame_number" | "frame_no" | "framenumber" | "f" => {
            "the number of the frame is `frame`, from 0"
        }
        "clock" | "initial_clock" | "final_clock" => {
            "`time` counts seconds, `frame` frames: with 48 of them POV-Ray's clock, 0 to 1, is \"=frame/47\""
        }
        "t" | "seconds" | "now" | "current_time" | "timestep" | "shutter_time" => {
            "the seconds from the start are `time`"
        }
        "fps" | "frames" | "frame_rate" => {
            "numbers of the animation have no names here: `time` is in seconds, `frame` is the number of the frame"
        }
        _ => return None,
    })
}

/// How one does without a function of other programs.
fn function_of_others(name: &str) -> Option<&'static str> {
    Some(match name.to_ascii_lowercase().as_str() {
        "deg" | "degrees" | "rad2deg" | "todegrees" | "to_degrees" => {
            "angles are in degrees already; x in radians is x*180/pi of them"
        }
        "rad" | "radians" | "deg2rad" | "toradians" | "to_radians" => {
            "angles are in degrees, sin(30) is 0.5: leave it out; a number of radians by itself is x*pi/180"
        }
        "pow" | "power" => "a power is written with `^`: x^2",
        "mod" | "fmod" | "modulo" => "the rest of a division is written with `%`: x%2",
        "lerp" => "that is `mix(a, b, t)`",
        "fract" | "frac" => "the part behind the point is x - floor(x)",
        "int" | "trunc" => "whole numbers are made by `floor(x)` and `round(x)`",
        "rand" | "rnd" | "noise" => "that is `random(n)`, the same for the same n",
        "kelvin" | "temperature" | "color_temperature" | "black_body" => "that is `blackbody(2700)`, in kelvins",
        "ln" => "that is `log(x)`",
        "vec3" | "vec" | "vector" | "vector3" | "vec3f" | "point" | "rgb" | "color" | "colour" => {
            "a vector or colour needs no name: (1, 2, 3)"
        }
        "range" | "seq" | "linspace" => {
            "what is counted is counted by `Repeat(count: 3, items: [..])`, in which `i` is 0, 1, 2"
        }
        _ => return None,
    })
}

struct Parser<'t, 'n> {
    text: &'t str,
    at: usize,
    depth: usize,
    /// What is read is not chosen: it must be an expression, of whatever value.
    idle: bool,
    name: &'n mut dyn FnMut(&str) -> Named,
}

impl Parser<'_, '_> {
    fn fault(&self, code: Code, at: Range<usize>, message: &str, expected: impl Into<String>) -> Failure {
        Some(Fault { code, at, message: message.to_owned(), expected: expected.into(), hint: String::new() })
    }

    fn syntax(&self, at: Range<usize>, message: &str, expected: impl Into<String>) -> Failure {
        self.fault(codes::EXPRESSION_SYNTAX, at, message, expected)
    }

    /// A fault of values, which what is not chosen may have: some value, then.
    fn unless_idle(&self, fault: Failure) -> Result<Value, Failure> {
        if self.idle { Ok(Value::Number(0.0)) } else { Err(fault) }
    }

    /// Reads what is chosen or not.
    fn chosen(
        &mut self,
        chosen: bool,
        read: impl FnOnce(&mut Self) -> Result<Value, Failure>,
    ) -> Result<Value, Failure> {
        let idle = self.idle;
        self.idle = idle || !chosen;
        let value = read(self);
        self.idle = idle;
        value
    }

    fn space(&mut self) {
        let rest = &self.text[self.at..];
        // Printing characters of ASCII, and the end, are no space: expressions are read a million times.
        if rest.as_bytes().first().is_some_and(|byte| !byte.is_ascii_graphic()) {
            self.at += rest.len() - rest.trim_start().len();
        }
    }

    /// The next word or sign, for messages.
    fn rest_word(&self) -> Range<usize> {
        let rest = &self.text[self.at..];
        let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let sign = rest.chars().next().map_or(0, char::len_utf8);
        self.at..self.at + word.max(sign)
    }

    /// Takes the first of these signs that stands here.
    fn take<'s>(&mut self, signs: &[&'s str]) -> Option<&'s str> {
        self.space();
        let rest = &self.text[self.at..];
        let first = rest.as_bytes().first()?;
        let sign = signs.iter().find(|sign| sign.as_bytes().first() == Some(first) && rest.starts_with(**sign))?;
        self.at += sign.len();
        Some(sign)
    }

    fn need(&mut self, sign: &str) -> Result<(), Failure> {
        if self.take(&[sign]).is_some() {
            return Ok(());
        }
        let at = self.rest_word();
        let hint = operator_of_others(&self.text[at.clone()]).filter(|_| self.text[at.clone()] != *",");
        let fault = self.syntax(at, &format!("`{sign}` is missing"), format!("`{sign}`"));
        Err(fault.map(|fault| Fault { hint: hint.unwrap_or_default().to_owned(), ..fault }))
    }

    /// Goes one level deeper.
    fn deeper(&mut self, read: fn(&mut Self) -> Result<Value, Failure>) -> Result<Value, Failure> {
        if self.depth >= MAX_DEPTH {
            let at = self.rest_word();
            return Err(self.syntax(at, "the expression is nested too deep", format!("at most {MAX_DEPTH} levels")));
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    /// The result of an operator at `at`, which must be there and finite.
    fn result(&self, at: Range<usize>, sign: &str, value: Option<Value>, of: &[&Value]) -> Result<Value, Failure> {
        let Some(value) = value else {
            let nouns: Vec<&str> = of.iter().map(|value| value.noun()).collect();
            let message = format!("`{sign}` does not go with {}", suggest::join(&nouns, "and"));
            let expected =
                if matches!(sign, "<" | ">" | "<=" | ">=") { "numbers" } else { "numbers, or vectors of one length" };
            let fault = self.fault(codes::EXPRESSION_TYPE, at, &message, expected);
            return self.unless_idle(fault);
        };
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!("`{sign}` gives no finite number");
        self.unless_idle(self.fault(codes::EXPRESSION_NOT_FINITE, at, &message, "a finite number"))
    }

    fn or(&mut self) -> Result<Value, Failure> {
        self.deeper(|parser| {
            let mut value = parser.and()?;
            while let Some(sign) = parser.take(&["||"]) {
                let at = parser.at - sign.len()..parser.at;
                let known = value == Value::Bool(true);
                let other = parser.chosen(!known, Self::and)?;
                value = if known { value } else { parser.truth(at, sign, &value, &other, |a, b| a || b)? };
            }
            Ok(value)
        })
    }

    fn and(&mut self) -> Result<Value, Failure> {
        let mut value = self.comparison()?;
        while let Some(sign) = self.take(&["&&"]) {
            let at = self.at - sign.len()..self.at;
            let known = value == Value::Bool(false);
            let other = self.chosen(!known, Self::comparison)?;
            value = if known { value } else { self.truth(at, sign, &value, &other, |a, b| a && b)? };
        }
        Ok(value)
    }

    fn truth(
        &self,
        at: Range<usize>,
        sign: &str,
        a: &Value,
        b: &Value,
        f: fn(bool, bool) -> bool,
    ) -> Result<Value, Failure> {
        if let (Value::Bool(a), Value::Bool(b)) = (a, b) {
            return Ok(Value::Bool(f(*a, *b)));
        }
        let nouns = suggest::join(&[a.noun(), b.noun()], "and");
        let message = format!("`{sign}` does not go with {nouns}");
        self.unless_idle(self.fault(codes::EXPRESSION_TYPE, at, &message, "comparisons on both sides"))
    }

    fn comparison(&mut self) -> Result<Value, Failure> {
        let a = self.sum()?;
        let Some(sign) = self.take(&["<=", ">=", "==", "!=", "<", ">"]) else { return Ok(a) };
        let at = self.at - sign.len()..self.at;
        let b = self.sum()?;
        if let (Value::Number(a), Value::Number(b)) = (&a, &b) {
            return Ok(Value::Bool(match sign {
                "<=" => a <= b,
                ">=" => a >= b,
                "<" => a < b,
                ">" => a > b,
                "==" => a == b,
                _ => a != b,
            }));
        }
        let lists = matches!((&a, &b), (Value::List(_), _) | (_, Value::List(_)));
        match sign {
            "==" if !lists => Ok(Value::Bool(a == b)),
            "!=" if !lists => Ok(Value::Bool(a != b)),
            _ => self.result(at, sign, None, &[&a, &b]),
        }
    }

    fn sum(&mut self) -> Result<Value, Failure> {
        let mut value = self.term()?;
        while let Some(sign) = self.take(&["+", "-"]) {
            let at = self.at - 1..self.at;
            let other = self.term()?;
            let sum = value.zip(&other, if sign == "+" { |a, b| a + b } else { |a, b| a - b });
            value = self.result(at, sign, sum, &[&value, &other])?;
        }
        Ok(value)
    }

    fn term(&mut self) -> Result<Value, Failure> {
        let mut value = self.unary()?;
        while let Some(sign) = self.take(&["*", "/", "%"]) {
            let at = self.at - 1..self.at;
            let other = self.unary()?;
            let product = value.zip(
                &other,
                match sign {
                    "*" => |a, b| a * b,
                    "/" => |a, b| a / b,
                    // With the divisor's sign.
                    _ => |a: f64, b: f64| a - b * (a / b).floor(),
                },
            );
            value = self.result(at, sign, product, &[&value, &other])?;
        }
        Ok(value)
    }

    fn unary(&mut self) -> Result<Value, Failure> {
        let Some(sign) = self.take(&["-", "!"]) else { return self.power() };
        let at = self.at - 1..self.at;
        let value = self.deeper(Self::unary)?;
        let result = match (sign, &value) {
            ("!", Value::Bool(value)) => Some(Value::Bool(!value)),
            ("!", _) => None,
            _ => value.map(|x| -x),
        };
        self.result(at, sign, result, &[&value])
    }

    fn power(&mut self) -> Result<Value, Failure> {
        let value = self.postfix()?;
        if self.take(&["**"]).is_some() {
            let fault = self.syntax(self.at - 2..self.at, "`**` is no operator", "an operator, or the end");
            return Err(fault.map(|fault| Fault { hint: "a power is written with `^`: x^2".to_owned(), ..fault }));
        }
        if self.take(&["^"]).is_none() {
            return Ok(value);
        }
        let at = self.at - 1..self.at;
        let other = self.deeper(Self::unary)?;
        self.result(at, "^", value.zip(&other, libm::pow), &[&value, &other])
    }

    fn postfix(&mut self) -> Result<Value, Failure> {
        let mut value = self.atom()?;
        loop {
            if self.text[self.at..].starts_with('.') {
                self.at += 1;
                let at = self.rest_word();
                self.at = at.end;
                let part = match &self.text[at.clone()] {
                    "x" | "r" => Some(0),
                    "y" | "g" => Some(1),
                    "z" | "b" => Some(2),
                    _ => None,
                };
                let is_vector = matches!(value, Value::Pair(_) | Value::Triple(_));
                value = match part.filter(|_| is_vector).and_then(|k: usize| value.numbers().get(k).copied()) {
                    Some(x) => Value::Number(x),
                    None => {
                        let message = format!("{} has no part `{}`", value.noun(), &self.text[at.clone()]);
                        self.unless_idle(self.fault(codes::EXPRESSION_TYPE, at, &message, "x, y or z of a vector"))?
                    }
                };
            } else if self.take(&["["]).is_some() {
                let start = self.at;
                let index = self.or()?;
                let at = start..self.at;
                self.need("]")?;
                value = self.item(&value, &index, at)?;
            } else {
                return Ok(value);
            }
        }
    }

    /// The item of a list or vector.
    fn item(&self, value: &Value, index: &Value, at: Range<usize>) -> Result<Value, Failure> {
        let count = match value {
            Value::List(list) => list.items().len(),
            Value::Pair(_) | Value::Triple(_) => value.numbers().len(),
            _ => {
                let message = format!("{} has no items", value.noun());
                let fault = self.fault(codes::EXPRESSION_TYPE, at, &message, "a list or a vector before `[`");
                return self.unless_idle(fault);
            }
        };
        let found = match index {
            Value::Number(k) if *k >= 0.0 && k.fract() == 0.0 && (*k as usize) < count => Some(*k as usize),
            _ => None,
        };
        let found = found.and_then(|k| match value {
            Value::List(list) => list.items().get(k).cloned(),
            _ => value.numbers().get(k).copied().map(Value::Number),
        });
        found.map_or_else(
            || {
                let expected = format!("a whole number from 0 to {}", count.max(1) - 1);
                self.unless_idle(self.fault(codes::EXPRESSION_INDEX, at, "the list has no such item", expected))
            },
            Ok,
        )
    }

    fn atom(&mut self) -> Result<Value, Failure> {
        self.space();
        let rest = &self.text[self.at..];
        match rest.chars().next() {
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some('#') => {
                let at = self.at..self.at + rest.len().min(7);
                let color = self.text.get(at.clone()).and_then(crate::read::hex_color);
                self.at = at.end;
                color.map(Value::Triple).ok_or_else(|| self.syntax(at, "this is no colour", "#rrggbb"))
            }
            Some(c) if c.is_alphabetic() || c == '_' => self.named(),
            Some('(') => {
                self.at += 1;
                self.brackets()
            }
            _ => {
                let at = self.rest_word();
                let message = if rest.is_empty() {
                    "the expression ends too early".to_owned()
                } else {
                    format!("`{}` cannot stand here", &self.text[at.clone()])
                };
                let hint = if rest.starts_with('[') { "the brackets of a point are round: (1, 2, 3)" } else { "" };
                let fault = self.syntax(at, &message, "a number, a name, or a bracket");
                Err(fault.map(|fault| Fault { hint: hint.to_owned(), ..fault }))
            }
        }
    }

    fn number(&mut self) -> Result<Value, Failure> {
        let rest = &self.text[self.at..];
        let digits = |text: &str| text.bytes().take_while(|b| b.is_ascii_digit() || *b == b'_').count();
        let mut end = digits(rest);
        if rest[end..].starts_with('.') {
            end += 1 + digits(&rest[end + 1..]);
        }
        if rest[end..].starts_with(['e', 'E']) {
            let sign = usize::from(rest[end + 1..].starts_with(['+', '-']));
            let exponent = digits(&rest[end + 1 + sign..]);
            if exponent > 0 {
                end += 1 + sign + exponent;
            }
        }
        let at = self.at..self.at + end;
        self.at = at.end;
        let text = &self.text[at.clone()];
        // Of a thing that comes a million times nothing is copied.
        let plain = if text.contains('_') { Cow::Owned(text.replace('_', "")) } else { Cow::Borrowed(text) };
        match plain.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Value::Number(number)),
            _ => Err(self.syntax(at, "this is no number", "a number such as 2, 0.5 or 1e3")),
        }
    }

    /// A name: a constant, a function's call, or what the scene says.
    fn named(&mut self) -> Result<Value, Failure> {
        let at = self.rest_word();
        let name = &self.text[at.clone()];
        self.at = at.end;
        if self.take(&["("]).is_some() {
            return self.call(at);
        }
        match name {
            "true" => return Ok(Value::Bool(true)),
            "false" => return Ok(Value::Bool(false)),
            _ => {}
        }
        if let Some((_, value)) = CONSTANTS.iter().find(|(constant, _)| *constant == name) {
            return Ok(Value::Number(*value));
        }
        match (self.name)(name) {
            Named::Value(value) => Ok(value),
            Named::Failed => Err(None),
            Named::Unknown(known) => {
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                let function = FUNCTIONS.iter().find(|function| function.name == name);
                let expected = match known.len() {
                    0 => "a name from `vars`, which has none".to_owned(),
                    _ => format!("a name from `vars`: {}", suggest::list(&known)),
                };
                let mut fault =
                    Fault { code: codes::EXPRESSION_NAME, at, message: String::new(), expected, hint: String::new() };
                fault.message = format!("there is no `{name}`");
                if let Some(function) = function {
                    fault.message = format!("`{name}` is a function");
                    fault.hint = format!("write {}", function.call);
                } else if let Some(ours) = moment_of_others(name).or_else(|| name_of_others(name)) {
                    fault.hint = ours.to_owned();
                } else if let Some(near) = suggest::nearest(name, known.iter().copied().chain(MOMENT)) {
                    fault.hint = format!("did you mean `{near}`?");
                }
                Err(Some(fault))
            }
        }
    }

    /// The call of a function, whose name stands at `at`; the bracket is open.
    fn call(&mut self, at: Range<usize>) -> Result<Value, Failure> {
        let (mut arguments, chooses) = (Vec::new(), self.text[at.clone()] == *"if");
        if self.take(&[")"]).is_none() {
            loop {
                let chosen = match (chooses, arguments.first(), arguments.len()) {
                    (true, Some(Value::Bool(condition)), 1) => *condition,
                    (true, Some(Value::Bool(condition)), 2) => !condition,
                    _ => true,
                };
                arguments.push(self.chosen(chosen, Self::or)?);
                if self.take(&[","]).is_none() {
                    break;
                }
            }
            self.need(")")?;
        }
        let name = &self.text[at.clone()];
        let Some(Function { call, apply, .. }) = FUNCTIONS.iter().find(|function| function.name == name) else {
            let names: Vec<&str> = FUNCTIONS.iter().map(|function| function.name).collect();
            let mut fault = Fault {
                code: codes::EXPRESSION_NAME,
                at,
                message: format!("there is no function `{name}`"),
                expected: format!("one of {}", suggest::list(&names)),
                hint: String::new(),
            };
            if let Some(way) = function_of_others(name) {
                fault.hint = way.to_owned();
            } else if let Some(near) = suggest::nearest(name, names.iter().copied()) {
                fault.hint = format!("did you mean `{near}`?");
            }
            return Err(Some(fault));
        };
        match apply(&arguments) {
            Some(value) if value.is_finite() => Ok(value),
            Some(_) => {
                let message = format!("`{name}` gives no finite number");
                self.unless_idle(self.fault(codes::EXPRESSION_NOT_FINITE, at, &message, "a finite number"))
            }
            None => {
                let why = if name == "keyframes" { why_no_keyframes(&arguments) } else { None };
                let message =
                    format!("`{name}` cannot be called so{}", why.map_or(String::new(), |why| format!(": {why}")));
                let hint = match (name, &arguments[..]) {
                    ("if", [Value::Number(_), _, _]) => "the condition is a number: compare it, as in `x != 0`",
                    ("random", []) => "a number that is another for each i: random(i)",
                    _ => "",
                };
                let fault = self.fault(codes::EXPRESSION_TYPE, at, &message, (*call).to_owned());
                self.unless_idle(fault.map(|fault| Fault { hint: hint.to_owned(), ..fault }))
            }
        }
    }

    /// What stands in brackets: one value, or the numbers of a vector.
    fn brackets(&mut self) -> Result<Value, Failure> {
        let start = self.at - 1;
        let only = self.or()?;
        if self.take(&[")"]).is_some() {
            return Ok(only);
        }
        let mut items = vec![only];
        while self.take(&[","]).is_some() {
            items.push(self.or()?);
        }
        self.need(")")?;
        let numbers: Option<Vec<f64>> =
            items.iter().map(|item| if let Value::Number(x) = item { Some(*x) } else { None }).collect();
        let vector = numbers.and_then(|numbers| Value::of(&numbers));
        let at = start..self.at;
        vector.map_or_else(
            || self.unless_idle(self.fault(codes::EXPRESSION_TYPE, at, "this is no vector", "two or three numbers")),
            Ok,
        )
    }
}
