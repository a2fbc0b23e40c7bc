//! Values by name, and the expressions that use them.

use super::radians::{holds_radians, in_radians};
use super::repeat::repeat_body;
use super::seeds::as_range;
use super::{Reader, Step, hinted, shortened};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::expression::{self, List, MOST_LISTS, Named, Value};
use crate::form::Form;
use crate::schema::{FieldDef, Type};
use crate::suggest;
use crate::tree::{Item, Kind};
use crate::words::Words;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// Vars, and repetitions in them, that are reckoned for each other, at most: with all that may stand in them they take
/// less than the two megabytes of a thread.
const MOST_OPEN: usize = 64;

/// The field `vars`: its values stay with the reader.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Vars;

/// A name and what it stands for.
#[derive(Debug)]
pub(super) struct Var {
    pub(super) name: Arc<str>,
    pub(super) span: Span,
    /// Where the value stands on the tape.
    slot: u32,
    state: State,
    pub(super) used: bool,
    /// Whether it is in radians, as far as its expression tells.
    radians: bool,
}

#[derive(Clone, Debug)]
enum State {
    NotYet,
    /// Being reckoned: whoever asks for it now goes round in a circle.
    Open,
    Done(Value),
    Failed,
}

/// All values by name.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// Those of the scene, then those of the repetitions that are being read, the innermost last.
    pub(super) list: Vec<Var>,
    /// Those of the scene.
    by_name: BTreeMap<Arc<str>, usize>,
    /// Where those of each repetition begin.
    frames: Vec<usize>,
    /// The item of a list that is being read where the expression stands whose place on the tape this is.
    pub(super) element: Option<(u32, Value)>,
    /// So many are being reckoned, each for the one before, repetitions in them among them.
    open: usize,
    /// Where one takes radians for degrees, which was told.
    told_of_radians: BTreeSet<Span>,
    /// Some are in radians, perhaps.
    any_radians: bool,
    /// Seeds that look like a range have been told.
    told_of_seeds: bool,
    /// That they were too many was told.
    waits_too_long: bool,
    /// Some could not be read: names may be missing.
    pub damaged: bool,
    /// Where those of the scene stand that have been read before their turn.
    known: u32,
    /// Values that are given for names of an included scene, and whether it has these.
    given: BTreeMap<Arc<str>, (Value, bool)>,
}

impl Table {
    /// That of an included scene, some of whose values are given.
    pub fn with(given: Vec<(Arc<str>, Value)>) -> Table {
        let given = given.into_iter().map(|(name, value)| (name, (value, false))).collect();
        Table { given, ..Table::default() }
    }

    /// Whether a value was given that there is no var for.
    pub fn is_left(&self, name: &str) -> bool {
        !self.damaged && self.given.get(name).is_some_and(|(_, taken)| !taken)
    }

    /// The names of the scene's vars.
    pub fn names(&self) -> Vec<Arc<str>> {
        self.by_name.keys().cloned().collect()
    }

    /// Repetitions that are being read.
    pub fn depth(&self) -> usize {
        self.frames.len()
    }

    /// Begins a repetition with this index.
    pub fn enter(&mut self, index: &Arc<str>, count: f64) {
        self.frames.push(self.list.len());
        let state = State::Done(Value::Number(count));
        self.list.push(Var { name: Arc::clone(index), span: Span::NONE, slot: 0, state, used: true, radians: false });
    }

    /// Ends it.
    pub fn leave(&mut self) {
        if let Some(start) = self.frames.pop() {
            self.list.truncate(start);
        }
    }

    /// What a name means here: the innermost repetition's, else the scene's.
    fn find(&self, name: &str) -> Option<usize> {
        let scene = self.frames.first().copied().unwrap_or(self.list.len());
        let inner = self.list[scene..].iter().rposition(|var| *var.name == *name).map(|k| scene + k);
        inner.or_else(|| self.by_name.get(name).copied())
    }
}

impl Words for Vars {
    const TYPE: Type = Type::Map(&Type::Value);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.vars(item, at)
    }

    fn form(&self, _all: bool) -> Form {
        Form::Map(Vec::new())
    }
}

/// Whether a text is an expression.
pub(crate) fn is_expression(item: Item<'_, '_>) -> bool {
    item.kind() == Kind::Text && item.lexeme().trim_start_matches(['"', '\'', 'r', '#']).starts_with('=')
}

/// A place in an expression, whose text this is. Without escapes that stands in the file as it is.
fn within(item: Item<'_, '_>, text: &str, at: &Range<usize>) -> Span {
    let mut span = item.span();
    if item.lexeme().get(1..item.lexeme().len().max(2) - 1) == Some(text) {
        let from = span.start + 2;
        (span.start, span.end) = (from + at.start as u32, from + at.end as u32);
    }
    span
}

impl Reader<'_> {
    /// Those of a scene that includes files, before anything of these is read that may use them.
    pub(super) fn vars_before(&mut self, item: Item<'_, '_>) {
        self.vars.damaged |= item.is_damaged();
        self.vars.known = item.index() as u32;
        self.named_values(item);
    }

    /// `{ "name": value }`
    fn vars(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Vars> {
        if self.vars.known == item.index() as u32 {
            return Some(Vars);
        }
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(Vars),
            _ => {
                self.vars.damaged = true;
                return self.wrong_type(item, at, "names with their values: { \"height\": 0.75 }");
            }
        }
        self.vars.damaged |= item.is_damaged();
        self.named_values(item);
        Some(Vars)
    }

    /// The `vars` of a repetition, for one of its times.
    pub(super) fn vars_within(&mut self, item: Item<'_, '_>, at: &'static FieldDef) {
        match item.kind() {
            Kind::Map => self.named_values(item),
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => {}
            _ => {
                let _: Option<()> = self.wrong_type(item, at, "names with their values: { \"angle\": \"=30*i\" }");
            }
        }
    }

    /// Takes names with their values, and reckons them.
    fn named_values(&mut self, item: Item<'_, '_>) {
        let start = self.vars.frames.last().copied().unwrap_or(0);
        for (key, value) in item.fields() {
            let name = key.text();
            if !expression::is_name(&name) {
                let known = expression::is_known(&name);
                let call = expression::function(&name).map_or(String::new(), |(call, _)| format!("`{call}` is one; "));
                let why =
                    if known { "has a meaning of its own in expressions" } else { "cannot stand in an expression" };
                self.path.push(Step::Key(name.clone().into_owned()));
                self.report(
                    Diagnostic::error(codes::BAD_NAME, key.span(), format!("`{}` {why}", shortened(&name)))
                        .expected("a name of letters, digits and `_` without a meaning of its own")
                        .hint(if known { format!("{call}choose another name, as `my_{name}`") } else { String::new() }),
                );
                self.path.pop();
                continue;
            }
            // What a file includes gives way to its own names.
            let gives_way = |first: Span| self.gives_way(first, key.span());
            let first = self.vars.find(&name).filter(|&first| first >= start).map(|first| self.vars.list[first].span);
            if let Some(first) = first.filter(|&first| !gives_way(first)) {
                self.path.push(Step::Key(name.clone().into_owned()));
                let mut fault =
                    Diagnostic::error(codes::DUPLICATE_NAME, key.span(), format!("two vars have the name \"{name}\""))
                        .hint("rename one of the two, or remove it");
                if first == Span::NONE {
                    fault.message = format!("`{name}` counts the copies already");
                    fault.hint = "leave it out, or give it another name".to_owned();
                } else {
                    fault = fault.label(first, "the first one is here");
                }
                self.report(fault);
                self.path.pop();
                continue;
            }
            let name: Arc<str> = (*name).into();
            if self.vars.frames.is_empty() {
                self.vars.by_name.insert(Arc::clone(&name), self.vars.list.len());
            }
            let slot = value.index() as u32;
            let given = self.vars.given.get_mut(&*name).filter(|_| self.vars.frames.is_empty());
            let state = given.map_or(State::NotYet, |given| {
                given.1 = true;
                State::Done(given.0.clone())
            });
            self.vars.list.push(Var { name, span: key.span(), slot, state, used: false, radians: false });
        }
        // Those of a scene are reckoned when all files that it includes have told theirs.
        if !self.vars.frames.is_empty() || self.open.is_empty() && !self.is_included(item.span()) {
            self.reckon(start, item);
        }
    }

    /// Reckons what is left, when a scene has been read.
    pub(super) fn pending_vars(&mut self, root: Item<'_, '_>) {
        self.path.push(Step::Field("vars"));
        self.reckon(0, root);
        self.path.pop();
    }

    /// Reckons the vars from number `start` on. `near`: any item of the tree.
    fn reckon(&mut self, start: usize, near: Item<'_, '_>) {
        for k in start..self.vars.list.len() {
            let Var { name, state: State::NotYet, .. } = &self.vars.list[k] else { continue };
            let replaced = self.vars.frames.is_empty() && self.vars.by_name.get(name) != Some(&k);
            if !replaced {
                self.path.push(Step::Key((**name).to_owned()));
                self.var(k, near);
                self.path.pop();
            }
        }
    }

    /// The value of a name, reckoned when it is first asked for. `near`: any item of the tree.
    fn var(&mut self, k: usize, near: Item<'_, '_>) -> State {
        if let State::NotYet = self.vars.list[k].state {
            if self.vars.open >= MOST_OPEN {
                if !std::mem::replace(&mut self.vars.waits_too_long, true) {
                    let span = self.vars.list[k].span;
                    let message = format!("more than {MOST_OPEN} vars and repetitions in them wait for each other");
                    let fault = Diagnostic::error(codes::TOO_MUCH, span, message).expected("fewer");
                    self.report(fault.hint("write those first that others need"));
                }
                self.vars.list[k].state = State::Failed;
                return State::Failed;
            }
            self.vars.open += 1;
            self.vars.list[k].state = State::Open;
            let item = near.other(self.vars.list[k].slot);
            let value = item.and_then(|item| match self.vars.frames.first() {
                Some(&first) if k < first => self.value_of_scene(item, first),
                _ => self.value(item),
            });
            self.vars.open -= 1;
            // A circle has been told where it closes.
            if let State::Open = self.vars.list[k].state {
                self.vars.list[k].state = value.map_or(State::Failed, State::Done);
                self.mark_radians(k, near);
            }
        }
        self.vars.list[k].state.clone()
    }

    /// The value of a var of the scene, which sees no names of the repetition that asks for it: those from number
    /// `first` on.
    fn value_of_scene(&mut self, item: Item<'_, '_>, first: usize) -> Option<Value> {
        let hidden = self.vars.list.split_off(first);
        let (frames, indices) = (std::mem::take(&mut self.vars.frames), std::mem::take(&mut self.indices));
        let value = self.value(item);
        self.vars.list.extend(hidden);
        (self.vars.frames, self.indices) = (frames, indices);
        value
    }

    /// A value of `vars`.
    pub(super) fn value(&mut self, item: Item<'_, '_>) -> Option<Value> {
        let item = self.picked(item)?;
        match item.kind() {
            Kind::Broken => None,
            Kind::Integer | Kind::Float => {
                let number = item.number().filter(|number| number.is_finite());
                if number.is_none() {
                    self.report(
                        Diagnostic::error(codes::NOT_FINITE, item.span(), "the value of a var must be a finite number")
                            .expected("a number"),
                    );
                }
                number.map(Value::Number)
            }
            Kind::Bool => Some(Value::Bool(item.lexeme() == "true")),
            Kind::Text => match self.expression(item) {
                Some(value) => value,
                None => self.text_color(item, &VAR).map(Value::Triple),
            },
            Kind::List | Kind::Tuple if item.name().is_none() => {
                let items = self.values(item)?;
                let numbers: Option<Vec<f64>> =
                    items.iter().map(|item| if let Value::Number(x) = item { Some(*x) } else { None }).collect();
                let is_vector =
                    item.kind() == Kind::Tuple || numbers.as_ref().is_some_and(|n| matches!(n.len(), 2 | 3));
                if is_vector && !matches!(items.len(), 2 | 3) {
                    self.list_in_round_brackets(item, items.len());
                    return None;
                }
                let vector = numbers.filter(|_| is_vector).and_then(|numbers| Value::of(&numbers));
                if vector.is_some() {
                    return vector;
                }
                let list = List::new(items);
                if list.is_none() {
                    let message = format!("lists stand more than {MOST_LISTS} deep");
                    self.report(Diagnostic::error(codes::TOO_MUCH, item.head(), message).expected("fewer"));
                }
                list.map(Value::List)
            }
            _ if repeat_body(item).is_some() => {
                let message = "a repetition stands in a list";
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected());
                self.report(fault.hint("write it in square brackets: [Repeat(..)]"));
                None
            }
            _ => self.wrong_kind(item, "the value of a var", expected(), None),
        }
    }

    /// The values of a list; a `Repeat` among them stands for its items.
    fn values(&mut self, item: Item<'_, '_>) -> Option<Vec<Value>> {
        let mut values = Vec::new();
        for child in item.children() {
            let Some(body) = repeat_body(child).filter(|_| item.kind() == Kind::List) else {
                values.push(self.value(child)?);
                continue;
            };
            let mut whole = true;
            self.vars.open += 1;
            let repeated = self.repeat(body, &VAR, &mut |reader, child| match reader.value(child) {
                Some(value) => values.push(value),
                None => whole = false,
            });
            self.vars.open -= 1;
            repeated.filter(|()| whole)?;
        }
        Some(values)
    }

    /// Reports more numbers than a vector has in the brackets of one: a list has its own.
    fn list_in_round_brackets(&mut self, item: Item<'_, '_>, count: usize) {
        if count < 4 || item.syntax() != crate::syntax::Syntax::Ron {
            return self.wrong_count(item, &VAR, count, 3);
        }
        let message = format!("{count} values in round brackets are no vector");
        let fault = Diagnostic::error(codes::WRONG_COUNT, item.head(), message);
        let mut fault = fault.expected("a vector, (x, y, z), or a list in square brackets");
        let inner = item.lexeme().trim_start_matches('(').trim_end_matches(')');
        let replacement = format!("[{inner}]");
        fault.hint = format!("write {}", hinted(&replacement));
        if item.lexeme() == format!("({inner})") {
            fault.edit = Some(Edit { span: item.span(), replacement });
        }
        self.report(fault);
    }

    /// Whether a name stands for a value that could not be read, which was told; then it is used.
    pub(super) fn uses_failed_var(&mut self, name: &str) -> bool {
        let var = self.vars.find(name).and_then(|k| self.vars.list.get_mut(k));
        var.filter(|var| matches!(var.state, State::Failed)).is_some_and(|var| {
            var.used = true;
            true
        })
    }

    /// Whether any name has a value.
    pub(super) fn has_vars(&self) -> bool {
        !self.vars.list.is_empty()
    }

    /// The var whose name is most like this one.
    pub(super) fn nearest_var(&self, name: &str) -> Option<Arc<str>> {
        let known: Vec<&str> = self.vars.list.iter().map(|var| &*var.name).collect();
        suggest::nearest(name, known).map(Arc::from)
    }

    /// Whether there is a var of this name.
    pub(super) fn knows_var(&self, name: &str) -> bool {
        self.vars.find(name).is_some()
    }

    /// The value of an expression; `None` where the item is none, `Some(None)` where it is a wrong one, which has been
    /// reported.
    pub(crate) fn expression(&mut self, item: Item<'_, '_>) -> Option<Option<Value>> {
        if !is_expression(item) {
            return None;
        }
        if let Some((_, value)) = self.vars.element.as_ref().filter(|(place, _)| *place == item.index() as u32) {
            return Some(Some(value.clone()));
        }
        let text = item.text();
        let body = text.strip_prefix('=')?;
        let result = expression::evaluate(body, &mut |name| {
            let Some(k) = self.vars.find(name) else {
                if let Some(moment) = self.moment(name, item) {
                    return moment;
                }
                if self.vars.damaged {
                    return Named::Failed;
                }
                return Named::Unknown(self.vars.list.iter().map(|var| (*var.name).to_owned()).collect());
            };
            self.vars.list[k].used = true;
            match self.var(k, item) {
                State::Done(value) => Named::Value(value),
                State::Open => {
                    self.circle(k, item);
                    Named::Failed
                }
                State::Failed | State::NotYet => Named::Failed,
            }
        });
        let fault = match result {
            Ok(value) => {
                self.warn_of_radians(item, &text);
                self.warn_of_seeds(item, &text);
                return Some(Some(value));
            }
            Err(None) => return Some(None),
            Err(Some(fault)) => fault,
        };
        let span = within(item, &text, &fault.at);
        let mut diagnostic = Diagnostic::error(fault.code, span, fault.message).expected(fault.expected);
        diagnostic.hint = match body.contains("random(") && body.contains(':') {
            true => "its arguments are seeds: a number from 2 to 5 is mix(2, 5, random(i))".to_owned(),
            false => fault.hint,
        };
        self.report(diagnostic);
        Some(None)
    }

    /// Keeps in mind whether a var is in radians, once it is reckoned: so are those then that it is made of.
    fn mark_radians(&mut self, k: usize, near: Item<'_, '_>) {
        let item = near.other(self.vars.list[k].slot).filter(|item| is_expression(*item));
        let Some(text) = item.map(|item| item.text()) else { return };
        if (self.vars.any_radians || text.contains("pi")) && holds_radians(&text[1..], &|name| self.is_radians(name)) {
            (self.vars.list[k].radians, self.vars.any_radians) = (true, true);
        }
    }

    fn is_radians(&self, name: &str) -> bool {
        self.vars.find(name).is_some_and(|k| self.vars.list[k].radians)
    }

    /// Warns of radians in what counts in degrees, once at each place: what is repeated is doubtful each time.
    fn warn_of_radians(&mut self, item: Item<'_, '_>, text: &str) {
        // Hardly any has one, and there may be millions.
        if !self.vars.any_radians && !text.contains("pi") {
            return;
        }
        let Some(found) = in_radians(&text[1..], &|name| self.is_radians(name)) else { return };
        if !self.vars.told_of_radians.insert(item.span()) {
            return;
        }
        let message = format!("`{}` has an angle in radians", shortened(&text[1..][found.at.clone()]));
        let warning = Diagnostic::warning(codes::OTHER_SCALE, within(item, text, &found.at), message);
        let hint = format!("write `{}`: a half turn is 180", hinted(&found.degrees));
        let mut warning = warning.expected("an angle in degrees").hint(hint);
        if let Some(k) = found.by.and_then(|name| self.vars.find(&name)) {
            warning = warning.label(self.vars.list[k].span, "this is in radians, by `pi`");
        }
        self.report(warning);
    }

    /// Warns of seeds that look like a range, once in a scene.
    fn warn_of_seeds(&mut self, item: Item<'_, '_>, text: &str) {
        if self.vars.told_of_seeds {
            return;
        }
        let Some((at, mended)) = as_range(&text[1..]) else { return };
        self.vars.told_of_seeds = true;
        let message = format!("`{}` is always the same number from 0 to 1", shortened(&text[1..][at.clone()]));
        let warning = Diagnostic::warning(codes::OTHER_SCALE, within(item, text, &at), message);
        let hint = format!("numbers of that range: `{mended}`, another for each `i`");
        self.report(warning.expected("seeds, of which one at least differs from copy to copy").hint(hint));
    }

    fn circle(&mut self, k: usize, item: Item<'_, '_>) {
        let open: Vec<&str> =
            (self.vars.list.iter()).filter(|var| matches!(var.state, State::Open)).map(|var| &*var.name).collect();
        let var = &self.vars.list[k];
        let message = match open.len() {
            1 => format!("`{}` stands for itself", var.name),
            _ => format!("{} stand for each other", suggest::join(&open, "and")),
        };
        let fault = Diagnostic::error(codes::CIRCLE, item.span(), message)
            .expected("values that do not need themselves")
            .label(var.span, "the circle begins here");
        self.vars.list[k].state = State::Failed;
        self.report(fault);
    }

    /// An expression where a number stands.
    pub(super) fn number_of(&mut self, value: Value, item: Item<'_, '_>, at: &'static FieldDef) -> Option<f64> {
        match value {
            Value::Number(number) => Some(number),
            other => self.wrong_value(&other, item, at),
        }
    }

    /// Reports an expression whose value is of the wrong kind.
    pub(super) fn wrong_value<T>(&mut self, value: &Value, item: Item<'_, '_>, at: &'static FieldDef) -> Option<T> {
        let message = format!("{} cannot be {}", super::plain(at.noun), value.noun());
        let expected = super::value::expected_for(at, item);
        self.report(Diagnostic::error(codes::EXPRESSION_TYPE, item.span(), message).expected(expected));
        None
    }
}

/// What may stand in `vars`.
fn expected() -> &'static str {
    "a number, a vector, a colour, true or false, a list of these, or an expression: \"=2*r\""
}

/// For colours in `vars`.
static VAR: FieldDef = FieldDef {
    name: "",
    noun: "the value of a var",
    doc: &[],
    kind: Type::Value,
    rule: crate::schema::Rule::ANY,
    default: None,
};
