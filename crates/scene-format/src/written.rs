//! What hints write in RON, as TOML and JSON have it: `Sphere(radius: 1)` is `{ Sphere = { radius = 1 } }`.
//!
//! Hints are written once, in RON, with `..` for what a person fills in. What does not read as RON stays as it is, and
//! so does what is for a command line, which speaks RON.

use crate::desc::Scene;
use crate::diagnostic::{Diagnostic, Source};
use crate::syntax::Syntax;
use std::path::Path;

impl Source {
    /// The syntax that it is in: by its name, else by its looks. `--set` and other options speak RON.
    pub fn syntax(&self) -> Syntax {
        match Syntax::from_path(Path::new(&self.name)) {
            Some(syntax) => syntax,
            None if self.name.starts_with("--") => Syntax::Ron,
            None => Syntax::guess(&self.text),
        }
    }
}

impl Diagnostic {
    /// What is expected and what to do as a person writes it in this syntax; as the readers have it, RON stands there.
    pub fn in_syntax(&self, syntax: Syntax) -> Diagnostic {
        let words = |text: &str| in_syntax(text, syntax);
        Diagnostic { expected: words(&self.expected), hint: words(&self.hint), ..self.clone() }
    }
}

/// What is said in the syntax of the text that it is said of.
pub(crate) fn in_their_syntax(diagnostics: &[Diagnostic], sources: &[Source]) -> Vec<Diagnostic> {
    let syntaxes: Vec<Syntax> = sources.iter().map(Source::syntax).collect();
    let of = |fault: &Diagnostic| *syntaxes.get(fault.span.source as usize).unwrap_or(&Syntax::Ron);
    diagnostics.iter().map(|fault| fault.in_syntax(of(fault))).collect()
}

/// Fields that hints write without backticks, beside those of the scene: other words before a colon are the hint's own.
const FIELDS: &[&str] = &["material", "transform", "placements", "projection", "mapping", "albedo"];

/// A text in which RON stands between backticks, or as a kind with brackets: `write Sphere(radius: 1)`.
fn in_syntax(text: &str, syntax: Syntax) -> String {
    if syntax == Syntax::Ron {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len() + 16);
    for (k, piece) in text.split('`').enumerate() {
        if k > 0 {
            out.push('`');
        }
        if k % 2 == 1 {
            match Written::new(piece, syntax).filter(|_| !piece.contains("--")).and_then(Written::fields_or_kind) {
                Some(written) => out += &written,
                None => out += piece,
            }
        } else {
            kinds_in(piece, syntax, &mut out);
        }
    }
    out
}

/// Adds a text between backticks' pieces, its kinds with brackets in the other syntax, a field's name before them, too.
fn kinds_in(text: &str, syntax: Syntax, out: &mut String) {
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c.is_ascii_alphabetic()) {
        let (before, from) = rest.split_at(at);
        let length = from.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(from.len());
        out.push_str(before);
        // Of an assignment on a command line, of a path, or of what is in brackets itself.
        let is_other = before.ends_with(['=', '.', '/', '-', '(', '[', '{', '"', '\'']);
        let kind = || from.starts_with(|c: char| c.is_ascii_uppercase()) && from[length..].starts_with('(');
        let is_field = Scene::DEF.field(&from[..length]).is_some() || FIELDS.contains(&&from[..length]);
        let named = || {
            let value = from[length..].strip_prefix(": ").unwrap_or("");
            let of_kind = value.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(value.len());
            value.starts_with(|c: char| c.is_ascii_uppercase()) && value[of_kind..].starts_with('(')
        };
        let written = if !is_other && (kind() || is_field && named()) { Written::new(from, syntax) } else { None };
        match written.and_then(|mut written| Some((written.field_or_value()?, written.rest))) {
            Some((words, left)) => {
                out.push_str(&words);
                rest = left;
            }
            None => {
                out.push_str(&from[..length]);
                rest = &from[length..];
            }
        }
    }
    out.push_str(rest);
}

/// RON that is being read.
struct Written<'t> {
    rest: &'t str,
    syntax: Syntax,
}

impl<'t> Written<'t> {
    fn new(rest: &'t str, syntax: Syntax) -> Option<Self> {
        (syntax != Syntax::Ron).then_some(Written { rest, syntax })
    }

    /// All of it: fields with their values, or a kind with brackets.
    fn fields_or_kind(mut self) -> Option<String> {
        let is_field = self.name_ahead().is_some_and(|name| self.rest[name.len()..].starts_with(": "));
        let is_kind = self.name_ahead().is_some_and(|name| self.rest[name.len()..].starts_with('('));
        let words = match (is_field, is_kind) {
            (true, _) => self.fields("")?,
            (_, true) => self.value()?,
            _ => return None,
        };
        self.rest.is_empty().then_some(words)
    }

    fn field_or_value(&mut self) -> Option<String> {
        let is_field = self.name_ahead().is_some_and(|name| self.rest[name.len()..].starts_with(": "));
        if is_field { self.field() } else { self.value() }
    }

    fn name_ahead(&self) -> Option<&'t str> {
        let length = self.rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(self.rest.len());
        Some(&self.rest[..length]).filter(|name| name.starts_with(|c: char| c.is_ascii_alphabetic()))
    }

    fn take(&mut self, sign: &str) -> Option<()> {
        self.rest = self.rest.strip_prefix(sign)?;
        Some(())
    }

    /// A name and its value.
    fn field(&mut self) -> Option<String> {
        let name = self.name_ahead()?;
        self.rest = &self.rest[name.len()..];
        self.take(": ")?;
        let value = self.value()?;
        Some(match self.syntax {
            Syntax::Json => format!("\"{name}\": {value}"),
            _ => format!("{name} = {value}"),
        })
    }

    /// Fields up to a sign, which is taken; `..` may stand for some.
    fn fields(&mut self, end: &str) -> Option<String> {
        let mut all = Vec::new();
        loop {
            if self.take("..").is_some() {
                all.push("..".to_owned());
            } else {
                all.push(self.field()?);
            }
            if self.take(", ").is_some() {
                continue;
            }
            self.take(end)?;
            return Some(all.join(", "));
        }
    }

    /// Values up to a sign, which is taken.
    fn values(&mut self, end: &str) -> Option<Vec<String>> {
        let mut all = Vec::new();
        while self.take(end).is_none() {
            if !all.is_empty() {
                self.take(", ")?;
            }
            all.push(self.value()?);
        }
        Some(all)
    }

    fn value(&mut self) -> Option<String> {
        if self.take("..").is_some() {
            return Some("..".to_owned());
        }
        if self.take("(").is_some() {
            return Some(format!("[{}]", self.values(")")?.join(", ")));
        }
        if self.take("[").is_some() {
            return Some(format!("[{}]", self.values("]")?.join(", ")));
        }
        if self.take("{ ").is_some() {
            return self.map();
        }
        if self.rest.starts_with('"') {
            let length = self.rest[1..].find('"')? + 2;
            let (text, rest) = self.rest.split_at(length);
            self.rest = rest;
            return Some(text.to_owned());
        }
        let Some(name) = self.name_ahead() else { return self.number() };
        self.rest = &self.rest[name.len()..];
        let is_kind = name.starts_with(|c: char| c.is_ascii_uppercase());
        if !is_kind {
            // `true`, or a letter that stands for a number.
            return Some(name.to_owned());
        }
        if self.take("(").is_none() {
            return Some(match (name, self.syntax) {
                ("None", Syntax::Json) => "null".to_owned(),
                _ => format!("\"{name}\""),
            });
        }
        let inner = self.within()?;
        // Groups of the scene have their name from the field.
        let is_group = Scene::DEF.fields.iter().any(|field| field.kind.group().is_some_and(|def| def.name == name));
        Some(match self.syntax {
            _ if is_group => inner,
            Syntax::Json => format!("{{ \"{name}\": {inner} }}"),
            _ => format!("{{ {name} = {inner} }}"),
        })
    }

    /// What stands between the brackets of a kind.
    fn within(&mut self) -> Option<String> {
        if self.take(")").is_some() {
            return Some("{}".to_owned());
        }
        if self.take("..)").is_some() {
            return Some("{ .. }".to_owned());
        }
        let is_field = self.rest.starts_with("..")
            || self.name_ahead().is_some_and(|name| self.rest[name.len()..].starts_with(": "));
        if is_field {
            return Some(format!("{{ {} }}", self.fields(")")?));
        }
        let mut values = self.values(")")?;
        if values.len() == 1 { values.pop() } else { None }
    }

    /// A map's entries, its bracket having been taken.
    fn map(&mut self) -> Option<String> {
        let mut all = Vec::new();
        loop {
            if self.take("..").is_some() {
                all.push("..".to_owned());
            } else {
                let name = self.value().filter(|name| name.starts_with('"'))?;
                self.take(": ")?;
                let value = self.value()?;
                all.push(match self.syntax {
                    Syntax::Json => format!("{name}: {value}"),
                    _ if crate::expression::is_name(name.trim_matches('"')) => {
                        format!("{} = {value}", name.trim_matches('"'))
                    }
                    _ => format!("{name} = {value}"),
                });
            }
            if self.take(", ").is_none() {
                self.take(" }")?;
                return Some(format!("{{ {} }}", all.join(", ")));
            }
        }
    }

    fn number(&mut self) -> Option<String> {
        let length = self.rest.find(|c: char| !(c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | 'e' | '_')));
        let (number, rest) = self.rest.split_at(length.unwrap_or(self.rest.len()));
        // Of a range, or the end of a sentence.
        let number = number.trim_end_matches('.');
        let is_number = number.bytes().any(|byte| byte.is_ascii_digit());
        self.rest = &self.rest[number.len()..];
        let _ = rest;
        is_number.then(|| number.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_in_the_words_of_toml_and_json() {
        for (ron, toml, json) in [
            ("add `energy_conserving: true`", "add `energy_conserving = true`", "add `\"energy_conserving\": true`"),
            (
                "write Sphere(radius: 1.5)",
                "write { Sphere = { radius = 1.5 } }",
                "write { \"Sphere\": { \"radius\": 1.5 } }",
            ),
            (
                "it is `transform: [Translate((x, y, z)), Scale(2)]`.",
                "it is `transform = [{ Translate = [x, y, z] }, { Scale = 2 }]`.",
                "it is `\"transform\": [{ \"Translate\": [x, y, z] }, { \"Scale\": 2 }]`.",
            ),
            (
                "marks: `output: Output(marks: { \"A\": (0, 1, 0) })` tells",
                "marks: `output = { marks = { A = [0, 1, 0] } }` tells",
                "marks: `\"output\": { \"marks\": { \"A\": [0, 1, 0] } }` tells",
            ),
            (
                "as in animation: Animation(frames: 7), say",
                "as in animation = { frames = 7 }, say",
                "as in \"animation\": { \"frames\": 7 }, say",
            ),
            (
                "`projection: Orthographic` and `near: None`",
                "`projection = \"Orthographic\"` and `near = \"None\"`",
                "`\"projection\": \"Orthographic\"` and `\"near\": null`",
            ),
            (
                "`Box(size: 1, placements: Grid(count: (3, 4, 1), ..))`",
                "`{ Box = { size = 1, placements = { Grid = { count = [3, 4, 1], .. } } } }`",
                "`{ \"Box\": { \"size\": 1, \"placements\": { \"Grid\": { \"count\": [3, 4, 1], .. } } } }`",
            ),
            (
                "Mesh(file: ..) or Plane()",
                "{ Mesh = { file = .. } } or { Plane = {} }",
                "{ \"Mesh\": { \"file\": .. } } or { \"Plane\": {} }",
            ),
        ] {
            assert_eq!(in_syntax(ron, Syntax::Toml), toml);
            assert_eq!(in_syntax(ron, Syntax::Json), json);
            assert_eq!(in_syntax(ron, Syntax::Ron), ron);
        }
        // What is none stays, and so does what is for a command line.
        for same in [
            "did you mean `Box`?",
            "`camera` belongs to the scene itself",
            "try `tracer render a.toml --set 'objects=[Box(size: 1)]'`",
            "set cameras.front=Camera(fov: 20)",
            "one of `radius`, `center`",
            "functions are sqrt(x) and `sqrt(2)`",
            "Gary and Greinert (Siggraph 1999)",
            "`{ Box = { size = 1 } }`",
            "note: a thing",
            "as a file of OBJ: a mesh",
        ] {
            assert_eq!(in_syntax(same, Syntax::Toml), same);
        }
    }
}
