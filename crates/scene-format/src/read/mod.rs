//! From the tree to the typed description, with all faults in one run.
//!
//! The types' readers (made by the macros of `words`) call the methods here; each method goes by the schema, reports
//! what is wrong at the very value, and returns `None`, so that the rest is read all the same and nothing is said
//! twice.

mod ambiguous;
mod camera;
mod check;
mod clock;
mod colors_elsewhere;
mod elsewhere;
mod everyday;
mod figures;
mod hints;
mod include;
mod kinds_elsewhere;
mod kinds_of_figures;
mod library;
mod listed;
mod marks;
mod materials;
mod nameless;
mod of_fields;
mod of_kinds;
mod of_lights;
mod outlines;
mod part;
mod pattern_fields;
mod pick;
mod radians;
mod repeat;
mod seeds;
mod shape_fields;
mod synonyms;
mod textures;
mod together;
mod told;
mod transforms_elsewhere;
mod typed;
mod unknown;
mod unseen;
mod unused;
mod value;
mod variant;
mod vars;
mod vector;

pub(crate) use camera::are_cameras;
pub(crate) use check::{Whole, scene};
pub(crate) use everyday::{everyday, thing};
pub(crate) use hints::command_line;
pub(crate) use include::{GivenMaterials, GivenVars, Includes};
pub(crate) use library::SETTINGS;
pub(crate) use nameless::field_of;
pub(crate) use part::part;
pub(crate) use pick::{PICK, pick_body};
pub(crate) use repeat::{REPEAT, repeat_body};
pub(crate) use synonyms::{squeezed, synonyms};
use told::{SHOWN, article_free, field_list, field_words, one_of};
pub(crate) use told::{describe, hinted, plain, shortened};
pub(crate) use value::{expected, expected_for, hex_color, is_picture, linear_from_srgb, none};
pub(crate) use variant::{Chosen, choices};
pub(crate) use vars::{Vars, is_expression};

use crate::codes;
use crate::desc::{ITEMS, Nested, Object, Scene};
use crate::diagnostic::{Diagnostic, Edit, Severity, Span};
use crate::schema::{FieldDef, StructDef, Type};
use crate::suggest;
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, NOWHERE};
use crate::words::Words;
use materials::Materials;
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;
use unknown::Others;

/// Where a value stands: a step of a field path.
#[derive(Clone, Debug)]
enum Step {
    Field(&'static str),
    Index(usize),
    Key(String),
}

/// Reads values and collects what is wrong with them.
pub(crate) struct Reader<'r> {
    sink: &'r mut Sink,
    path: Vec<Step>,
    materials: Materials,
    cameras: camera::Cameras,
    named: textures::Scope,
    kept: textures::Kept,
    vars: vars::Table,
    clock: clock::Clock,
    /// The item whose kind was told to be another.
    renamed: u32,
    /// The item whose kind a field was told to tell.
    typed: u32,
    /// The indices of the repetitions that are being read, the outermost first.
    indices: Vec<(Arc<str>, u32)>,
    /// Included files that are being read, one within the other.
    open: Vec<include::Open>,
    libraries: library::Libraries,
    /// The number of the first source that is an included file.
    first_included: u32,
    /// Groups that are being read, one within the other.
    pub(crate) groups: usize,
    /// Textures that are being read, one within the other.
    pub(crate) textures: Nested,
    /// The file that was named last: a mesh that stands in a scene many times has its name in memory once.
    file: Option<Arc<Path>>,
    /// How many points the mesh that is being read has, once they are read.
    pub(crate) points: Option<usize>,
    /// Whether an item of a list was passed over that somebody meant: its number of items is not what it will be.
    pub(crate) passed_over: bool,
    /// Whether a surface shines by an intensity, which only some shapes have.
    pub(crate) intense: bool,
    /// Whether something of the scene was not read since no `Pick` took it or no `Repeat` made it: another frame may.
    chosen: bool,
}

/// Fields of one struct, by their number in the schema.
pub(crate) struct Fields<'t, 's> {
    def: &'static StructDef,
    /// Any item of the tree.
    of: Item<'t, 's>,
    /// Places on the tape: the items themselves are eight times as large, and each struct of a scene is moved about
    /// like this.
    slots: [u32; MAX_FIELDS],
    next: usize,
}

impl<'t, 's> Fields<'t, 's> {
    fn new(def: &'static StructDef, of: Item<'t, 's>) -> Fields<'t, 's> {
        Fields { def, of, slots: [NOWHERE; MAX_FIELDS], next: 0 }
    }

    fn get(&self, slot: usize) -> Option<Item<'t, 's>> {
        self.of.other(self.slots[slot])
    }

    fn set(&mut self, slot: usize, item: Item<'t, 's>) {
        self.slots[slot] = item.index() as u32;
    }
}

/// So many written fields are looked at for a suggestion: more are no scene, and must not take quadratic time.
const LOOK_AT: usize = 64;
/// No struct of the language has more fields: counted in the schema when this is compiled.
const MAX_FIELDS: usize = {
    // Objects are told later there, since groups hold them.
    let (scene, items) = (Scene::DEF.most_fields(), ITEMS.most_fields());
    if scene > items { scene } else { items }
};
/// Lists of fewer items get room for all of them at once.
const SHORT_LIST: usize = 64;

/// Makes room in the list that `item` is read into, `child` being read next. A list that grows by doubling is in memory
/// one and a half times too often; after a few items one can tell how many more there will be.
pub(crate) fn make_room<T>(list: &mut Vec<T>, item: Item<'_, '_>, child: Item<'_, '_>) {
    if list.len() == list.capacity() && list.len() >= SHORT_LIST {
        let (read, rest) = item.nodes_around(child);
        // A few more than that, so that a good guess is not a little too small.
        let guess = rest * list.len() / read.max(1);
        let more = (guess + guess / 64).max(list.len() / 4);
        // Long lists grow in steps, while the memory of what was read is given back.
        let step = if list.len() < 16 * SHORT_LIST { list.len() } else { list.len() / 8 };
        list.reserve_exact(more.min(step));
    }
}

impl<'r> Reader<'r> {
    pub fn new(sink: &'r mut Sink) -> Reader<'r> {
        Reader {
            sink,
            path: Vec::new(),
            materials: Materials::default(),
            cameras: camera::Cameras::default(),
            named: textures::Scope::default(),
            kept: textures::Kept::default(),
            vars: vars::Table::default(),
            clock: clock::Clock::default(),
            renamed: NOWHERE,
            typed: NOWHERE,
            indices: Vec::new(),
            open: Vec::new(),
            libraries: library::Libraries::default(),
            first_included: u32::MAX,
            groups: 0,
            textures: Nested::default(),
            file: None,
            points: None,
            passed_over: false,
            intense: false,
            chosen: false,
        }
    }

    pub(crate) fn path(&self) -> String {
        let mut out = String::new();
        for step in &self.path {
            let _ = match step {
                Step::Field(name) if out.is_empty() => write!(out, "{name}"),
                Step::Field(name) => write!(out, ".{name}"),
                Step::Index(index) => write!(out, "[{index}]"),
                Step::Key(key) if unknown::is_plain(key) => write!(out, ".{key}"),
                Step::Key(key) => write!(out, "[\"{key}\"]"),
            };
        }
        out
    }

    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        let path = self.path();
        let mut diagnostic = diagnostic.at_path(path);
        // What is doubtful is so each time, and told alike.
        if diagnostic.severity == Severity::Error {
            diagnostic.message += &self.where_repeated();
        }
        if !self.open.is_empty() {
            // What is included twice is wrong twice, and told once.
            let known = |other: &Diagnostic| other.span == diagnostic.span && other.message == diagnostic.message;
            if self.sink.diagnostics.iter().any(known) {
                self.sink.errors += usize::from(diagnostic.severity == Severity::Error);
                return;
            }
            diagnostic = self.open.iter().rev().fold(diagnostic, |fault, open| open.labelled(fault));
        } else {
            diagnostic = self.libraries.labelled(diagnostic);
        }
        self.sink.push(diagnostic);
    }

    /// Whether a place is in an included file.
    fn is_included(&self, span: Span) -> bool {
        span != Span::NONE && span.source >= self.first_included
    }

    /// Whether a name given at one place gives way to the same name at another: that of an included file does, also to
    /// itself where the file is included again.
    fn gives_way(&self, first: Span, again: Span) -> bool {
        self.is_included(first) && (first.source != again.source || first == again)
    }

    /// Finds the fields of a struct; reports unknown, double and missing ones.
    pub fn fields<'t, 's>(&mut self, item: Item<'t, 's>, def: &'static StructDef) -> Option<Fields<'t, 's>> {
        if let Some(name) = item.name()
            && name != def.name
            && self.renamed != item.index() as u32
        {
            self.wrong_name(item, name, def);
            suggest::nearest(name, [def.name])?;
        }
        self.fields_unnamed(item, def)
    }

    fn wrong_name(&mut self, item: Item<'_, '_>, name: &str, def: &'static StructDef) {
        let message = format!("{} is called `{}` here, not `{name}`", article_free(def.noun), def.name);
        let mut fault = Diagnostic::error(codes::UNKNOWN_VARIANT, item.head(), message)
            .expected(format!("{}(..), or brackets without a name", def.name));
        match camera::projection_elsewhere(name, def, item) {
            Some(way) => fault.hint = way,
            // An object alone.
            None if def.name == Scene::DEF.name && Object::DEF.variant(name).is_some() => {
                fault.message = format!("an object stands in a scene: this is a `{name}` alone");
                fault.hint = format!("write Scene(background: 1, objects: [{name}(..)])");
                let replacement = format!("Scene(background: 1, objects: [{}])", item.lexeme());
                fault.edit = Some(Edit { span: item.span(), replacement });
            }
            None => {
                fault.edit = Some(Edit { span: item.head(), replacement: def.name.to_owned() });
                fault.hint = format!("write `{}`", def.name);
            }
        }
        self.report(fault);
    }

    /// As [`Reader::fields`], for an item whose name has been seen to.
    pub(crate) fn fields_unnamed<'t, 's>(
        &mut self,
        item: Item<'t, 's>,
        def: &'static StructDef,
    ) -> Option<Fields<'t, 's>> {
        if item.kind() == Kind::Map
            && let Some(inner) = self.named_within(item, def)
        {
            return self.fields_unnamed(inner, def);
        }
        let mut fields = Fields::new(def, item);
        match item.kind() {
            Kind::Broken => return None,
            Kind::Struct | Kind::Map => {}
            Kind::Tuple if item.is_damaged() && def.bare.is_none() => return None,
            _ if def.name == "Image" && elsewhere::image(item).is_some() => {
                return self.wrong_kind(item, def.noun, "Image(width: .., height: ..)", elsewhere::image(item));
            }
            Kind::Tuple => {
                let mut children = item.solid_children();
                match (children.next(), children.next(), def.bare) {
                    (None, ..) => {}
                    (Some(only), None, Some(bare)) => {
                        let slot = def.fields.iter().position(|field| field.name == bare)?;
                        fields.set(slot, only);
                    }
                    (Some(_), ..) => return self.without_names(item, def),
                }
            }
            Kind::Text if def.name == "Output" => return self.output_as_text(item),
            _ => return self.not_a_struct(item, def),
        }
        let mut guess = 0;
        let mut others = Others::default();
        for (key, value) in item.fields() {
            if self.sink.is_full() {
                break;
            }
            match slot_of(def, key, guess) {
                None => self.other_field(key, value, item, def, &mut others),
                Some(slot) => {
                    guess = slot + 1;
                    if let Some(first) = fields.get(slot) {
                        self.path.push(Step::Field(def.fields[slot].name));
                        self.duplicate(key, def.fields[slot].name, first);
                        self.path.pop();
                    } else {
                        fields.set(slot, value);
                    }
                }
            }
        }
        self.fields_beneath(item, &mut fields, &mut others);
        // What a mistyped name stands for is read as well, so that what is wrong with it is told in the same run.
        for (meant, value) in others.mistyped {
            let slot = def.fields.iter().position(|field| field.name == meant);
            if let Some(slot) = slot.filter(|slot| fields.get(*slot).is_none()) {
                fields.set(slot, value);
            }
        }
        if !item.is_damaged() {
            self.missing_fields(item, def, &fields, &others.excused);
        }
        self.begin_scene(&mut fields);
        Some(fields)
    }

    /// `excused`: fields that something else was written for, which has been told.
    fn missing_fields(
        &mut self,
        item: Item<'_, '_>,
        def: &'static StructDef,
        fields: &Fields<'_, '_>,
        excused: &[&'static str],
    ) {
        for (field, &slot) in def.fields.iter().zip(&fields.slots) {
            if slot == NOWHERE && field.default.is_none() && !excused.contains(&field.name) {
                let mut fault = Diagnostic::error(
                    codes::MISSING_FIELD,
                    item.head(),
                    format!("{} needs the field `{}`", def.noun, field.name),
                )
                .expected(value::expected_for(field, item));
                fault.hint = match item.syntax() {
                    Syntax::Ron => format!("add `{}: ..`", field.name),
                    syntax => syntax.of_toml(format!("add `{} = ..`", field.name)).into_owned(),
                };
                self.path.push(Step::Field(field.name));
                self.report(fault);
                self.path.pop();
            }
        }
        if def.exactly_one.is_empty() || def.exactly_one.iter().any(|field| excused.contains(field)) {
            return;
        }
        let written = || {
            let all = def.fields.iter().enumerate().map(|(slot, field)| (field, fields.get(slot)));
            // `None` says that it is another one.
            let says = |slot: &Option<Item<'_, '_>>| slot.is_some_and(|item| !item.is_word("None"));
            all.filter(move |(field, slot)| says(slot) && def.exactly_one.contains(&field.name))
        };
        let choice = suggest::list(def.exactly_one);
        match written().count() {
            1 => {}
            0 => self.report(
                Diagnostic::error(codes::EXACTLY_ONE, item.head(), format!("{} needs one of {choice}", def.noun))
                    .expected(format!("exactly one of {choice}"))
                    .hint(one_of(def, item.syntax())),
            ),
            _ => {
                let mut slots: Vec<_> =
                    written().filter_map(|(field, slot)| slot.map(|item| (item.head(), field.name))).collect();
                slots.sort();
                let [(at, first), (span, second), ..] = slots[..] else { return };
                let message = format!("{} has both `{first}` and `{second}`", def.noun);
                let fault = Diagnostic::error(codes::EXACTLY_ONE, span, message);
                let fault = fault.expected(format!("exactly one of {choice}")).hint("remove all but one");
                self.report(fault.label(at, format!("`{first}` is written here")));
            }
        }
    }

    /// How many errors have been reported.
    pub(crate) fn errors(&self) -> usize {
        self.sink.errors
    }

    fn duplicate(&mut self, key: Item<'_, '_>, name: &str, first: Item<'_, '_>) {
        let lists = matches!(first.kind(), Kind::List | Kind::Map);
        let way = if lists { "put both into one, or remove one of the two" } else { "remove one of the two" };
        self.report(
            Diagnostic::error(codes::DUPLICATE_FIELD, key.span(), format!("`{name}` is written twice"))
                .hint(way)
                .label(first.head(), "the first value is here"),
        );
    }

    /// Reads the next field of the schema.
    pub fn field<T: Words>(&mut self, fields: &mut Fields<'_, '_>, default: Option<fn() -> T>) -> Option<T> {
        let at = fields.def.fields.get(fields.next)?;
        let mut item = fields.get(fields.next);
        if self.libraries.have_settings() {
            item = self.with_settings(fields, at, item);
        }
        fields.next += 1;
        match item {
            Some(item) if item.kind() == Kind::Broken => default.map(|default| default()),
            Some(item) => {
                self.path.push(Step::Field(at.name));
                let value = match item.is_null() && !at.kind.takes_none() {
                    true => self.null(item, at),
                    false => self.picked(item).and_then(|item| T::read(self, item, at)),
                };
                self.path.pop();
                // What is wrong has been said: go on with the default, to see the rest.
                value.or_else(|| default.map(|default| default()))
            }
            None => default.map(|default| default()),
        }
    }

    /// Reads the items of a list; those that are wrong are left out.
    pub(crate) fn list<T: Words>(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Vec<T>> {
        let few = if item.kind() == Kind::List { item.children().take(SHORT_LIST).count() } else { 0 };
        let mut list = Vec::with_capacity(few);
        self.items(item, at, |reader, child| {
            if let Some(value) = T::read(reader, child, at) {
                make_room(&mut list, item, child);
                list.push(value);
            }
        })?;
        Some(list)
    }

    /// Goes through the items of a list, and gives back the memory of those that were read. `None`: it is no list,
    /// which is reported.
    #[inline]
    pub(crate) fn items<'t, 's>(
        &mut self,
        item: Item<'t, 's>,
        at: &'static FieldDef,
        mut read: impl FnMut(&mut Self, Item<'t, 's>),
    ) -> Option<()> {
        self.items_into(item, at, &mut read)
    }

    /// As [`Reader::items`]; a `Repeat` among them stands for its items.
    pub(super) fn items_into<'t, 's>(
        &mut self,
        item: Item<'t, 's>,
        at: &'static FieldDef,
        read: &mut dyn FnMut(&mut Self, Item<'t, 's>),
    ) -> Option<()> {
        if item.kind() != Kind::List {
            return self.items_of_value(item, at, read);
        }
        if self.flat_list(item, at) {
            return None;
        }
        let mut children = item.children();
        let (mut piece, mut begin) = (0, 0);
        for index in 0.. {
            let Some(child) = children.next().filter(|_| !self.sink.is_full()) else { break };
            if children.begin != piece {
                // The first one stays: whoever asks later whether the list is empty asks for it.
                (piece, begin) = (children.begin, child.index() + 1);
            }
            // What is repeated or included is read again.
            if self.vars.depth() == 0 && self.open.is_empty() {
                begin = child.release_before(begin);
            }
            if child.kind() == Kind::Broken {
                self.passed_over = true;
                continue;
            }
            self.path.push(Step::Index(index));
            match self.picked(child) {
                Some(child) => match repeat_body(child) {
                    Some(body) => self.passed_over |= self.repeat(body, at, read).is_none(),
                    None => read(self, child),
                },
                None => self.passed_over = true,
            }
            self.path.pop();
        }
        Some(())
    }

    fn not_a_list<T>(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<T> {
        let lexeme = item.lexeme();
        let header = item.syntax() == Syntax::Toml && item.kind() == Kind::Map && lexeme.starts_with('[');
        // `[objects.Sphere]` is a table in one: each item of a list begins with its own `[[objects]]`.
        let dotted = lexeme.trim_start_matches('[').trim_end_matches(']').split_once('.').filter(|_| header);
        if let Some((list, kind)) = dotted.filter(|(list, kind)| *list == at.name && !kind.contains('.')) {
            let mended = format!("[[{list}]]\n[{list}.{kind}]");
            let message = format!("{} cannot be {}", plain(at.noun), describe(item));
            let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected("a list: [[list]]");
            fault.hint = format!("each begins with two lines: [[{list}]] and [{list}.{kind}]");
            if !lexeme.starts_with("[[") {
                fault.edit = Some(Edit { span: item.span(), replacement: mended });
            }
            self.report(fault);
            return None;
        }
        if item.kind() == Kind::Map && !header && self.list_by_names(item, at) {
            return None;
        }
        let of_fields = match item.name() {
            None => matches!(item.kind(), Kind::Map | Kind::Struct),
            Some(name) => item.kind() == Kind::Struct && name.eq_ignore_ascii_case("transform"),
        };
        if at.name == "transform" && of_fields && !header {
            return self.transforms_in_braces(item, at);
        }
        let transform = || transforms_elsewhere::lone_transform(item).filter(|_| at.name == "transform");
        let edit = match item.kind() {
            _ if header => (!lexeme.starts_with("[[")).then(|| format!("[{lexeme}]")),
            Kind::Struct | Kind::Map | Kind::Tuple if item.name().is_some() || item.kind() == Kind::Map => {
                transform().or_else(|| (!listed::is_of_points(at)).then(|| format!("[{lexeme}]")))
            }
            Kind::Tuple => listed::in_square_brackets(item, at),
            Kind::Text if matches!(at.kind, Type::List(Type::File)) => Some(format!("[{lexeme}]")),
            _ => None,
        };
        // A table under a TOML header is not between brackets that could be edited.
        let edit = edit.filter(|_| item.syntax() == Syntax::Ron || lexeme.starts_with(['{', '[', '"']));
        let (expected, words) = listed::list_of_words(at, item);
        self.wrong_kind(item, at.noun, &expected, edit.or(words))
    }

    /// Reports a value of the wrong kind for a field.
    pub(crate) fn wrong_type<T>(&mut self, item: Item<'_, '_>, at: &'static FieldDef, expected: &str) -> Option<T> {
        self.wrong_kind(item, at.noun, expected, colors_elsewhere::in_other_brackets(item, at))
    }

    pub(crate) fn wrong_kind<T>(
        &mut self,
        item: Item<'_, '_>,
        noun: &str,
        expected: &str,
        edit: Option<String>,
    ) -> Option<T> {
        if item.kind() == Kind::Broken {
            return None;
        }
        let mut fault =
            Diagnostic::error(codes::WRONG_TYPE, item.head(), format!("{} cannot be {}", plain(noun), describe(item)))
                .expected(expected);
        if let Some(replacement) = edit {
            fault.hint = if replacement.chars().count() > 3 * SHOWN && replacement.starts_with('[') {
                "put square brackets around it".to_owned()
            } else {
                format!("write {}", hinted(&replacement))
            };
            fault.edit = Some(Edit { span: item.span(), replacement });
        } else if let Some(way) = told::of_value(item, noun) {
            fault.hint = way;
        }
        self.report(fault);
        None
    }
}

pub(crate) fn names(def: &'static StructDef) -> impl Iterator<Item = &'static str> {
    def.fields.iter().map(|field| field.name)
}

/// The number of the field of this name. Most fields are written in order and without quotes: then it is `guess`.
#[inline]
fn slot_of(def: &'static StructDef, key: Item<'_, '_>, guess: usize) -> Option<usize> {
    let written = key.lexeme();
    match def.fields.get(guess) {
        Some(field) if field.name == written => Some(guess),
        _ => {
            let name = key.text();
            def.fields.iter().position(|field| field.name == name)
        }
    }
}
