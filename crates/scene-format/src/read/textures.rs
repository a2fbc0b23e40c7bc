//! Textures by name, and who uses them.
//!
//! What a name stands for is read when it is first asked for, so that they may stand in any order. Of a scene that
//! stands among the objects, and of a file of `include` whose names give way, the description has those that are used,
//! under names that say where they come from.

use super::include::MOST_DEEP;
use super::{Reader, Step, pick_body, shortened};
use crate::codes;
use crate::desc::{Albedo, NamedTexture, Nested, PatternWords};
use crate::diagnostic::{Diagnostic, Edit, Span, Spanned};
use crate::files::joined;
use crate::schema::{FieldDef, Rule};
use crate::suggest;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind, NOWHERE};
use crate::words::Words;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

/// Comparisons of unknown names with known ones.
const MAX_COMPARISONS: usize = 200_000;

/// The textures of one scene, and of the files that it includes.
#[derive(Debug, Default)]
pub(super) struct Scope {
    /// In the order in which they are met; those that gave way among them.
    list: Vec<Entry>,
    by_name: HashMap<Arc<str>, usize>,
    /// Those that are being read, each for the one before.
    open: Vec<usize>,
    /// Of a scene among the objects of another one: its file.
    file: Option<String>,
    /// Some could not be read: names may be missing.
    pub damaged: bool,
    /// Uses of names that are not there.
    unknown: usize,
}

#[derive(Debug)]
struct Entry {
    name: Spanned<Arc<str>>,
    /// Where it stands on the tape.
    slot: u32,
    /// The file whose name goes before its own, where it cannot keep that.
    file: Option<String>,
    state: State,
    used: bool,
}

#[derive(Debug)]
enum State {
    NotYet,
    /// Being read: whoever names it now goes round in a circle.
    Open,
    /// As it was read, and what it is made of.
    Read(Albedo, Nested),
    /// As somebody uses it.
    Kept(Arc<NamedTexture>, Nested),
    Failed,
}

/// Names in the description.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// The scene's own: where the one stands that wins.
    own: HashMap<Arc<str>, u32>,
    /// Those that have a file's name before their own, in the order of their first use.
    list: Vec<Arc<NamedTexture>>,
    taken: BTreeSet<String>,
    /// The last one of each such name, and how many there are.
    last: HashMap<String, (usize, Arc<NamedTexture>)>,
}

impl Scope {
    /// That of a scene among the objects of another one.
    pub fn of_file(file: &str) -> Scope {
        Scope { file: Some(file.to_owned()), ..Scope::default() }
    }

    fn find(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    fn names(&self) -> Vec<Arc<str>> {
        let mut known: Vec<&Spanned<Arc<str>>> = self.by_name.values().map(|&k| &self.list[k].name).collect();
        known.sort_by_key(|name| name.span);
        known.into_iter().map(|name| Arc::clone(&name.value)).collect()
    }

    /// The names that nothing uses, and where they stand.
    pub fn unused(&self) -> Vec<(Arc<str>, Span)> {
        let wins = |k: usize, entry: &Entry| self.find(&entry.name.value) == Some(k);
        let unused = self.list.iter().enumerate().filter(|(k, entry)| !entry.used && wins(*k, entry));
        unused.map(|(_, entry)| (Arc::clone(&entry.name.value), entry.name.span)).collect()
    }
}

impl Kept {
    /// A texture under its name, or under a name with that of its file before it; the same one only once.
    fn keep(&mut self, name: Spanned<Arc<str>>, file: Option<&str>, texture: Albedo) -> Arc<NamedTexture> {
        let Some(file) = file else { return Arc::new(NamedTexture { name, texture }) };
        let base = format!("{file}: {}", name.value);
        let mut k = 0;
        if let Some((count, last)) = self.last.get(&base) {
            if last.texture == texture {
                return Arc::clone(last);
            }
            k = *count;
        }
        let called = loop {
            k += 1;
            let called = if k == 1 { base.clone() } else { format!("{base} ({k})") };
            if !self.own.contains_key(&*called) && self.taken.insert(called.clone()) {
                break called;
            }
        };
        let name = Spanned { value: called.into(), span: name.span };
        let named = Arc::new(NamedTexture { name, texture });
        self.list.push(Arc::clone(&named));
        self.last.insert(base, (k, Arc::clone(&named)));
        named
    }
}

impl Reader<'_> {
    /// Notes which names of textures a scene will have for its own: of two files those of the later win, and its own
    /// against all.
    pub(super) fn foretell_textures(&mut self, root: Item<'_, '_>) {
        self.foretell(root, &mut HashSet::new(), 0);
    }

    /// The last is the first to be noted.
    fn foretell(&mut self, root: Item<'_, '_>, seen: &mut HashSet<usize>, depth: usize) {
        if depth > MOST_DEEP || !seen.insert(root.index()) {
            return;
        }
        let fields = |name: &'static str| root.fields().filter(move |(key, _)| key.text() == name);
        for (_, textures) in fields("textures") {
            match pick_body(textures) {
                None => self.foretell_names(textures, true),
                // Which of them will be read nobody knows yet.
                Some(body) => {
                    for (_, from) in body.fields().filter(|(key, _)| key.text() == "from") {
                        from.children().for_each(|textures| self.foretell_names(textures, false));
                    }
                }
            }
        }
        for (_, include) in fields("include") {
            let names: Vec<Item<'_, '_>> = include.children().filter(|name| name.kind() == Kind::Text).collect();
            for name in names.into_iter().rev() {
                let file = name.included(&joined(name.folder(), &name.text()));
                if let Some(root) = file.and_then(|file| name.other(file.root)) {
                    self.foretell(root, seen, depth + 1);
                }
            }
        }
    }

    fn foretell_names(&mut self, textures: Item<'_, '_>, certain: bool) {
        if textures.kind() == Kind::Map {
            for (key, value) in textures.fields() {
                let slot = if certain { value.index() as u32 } else { NOWHERE };
                self.kept.own.entry(Arc::from(&*key.text())).or_insert(slot);
            }
        }
    }

    /// `{ "name": texture }`. They stay with the reader until all objects are read.
    pub(crate) fn named_textures(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<()> {
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(()),
            _ => {
                // Which names were meant nobody knows, so none is called unknown.
                self.named.damaged = true;
                let expected = match item.syntax() {
                    Syntax::Ron => "names with their textures: { \"clouds\": Noise() }",
                    Syntax::Toml => "a table [textures], with a line for each: clouds = { Noise = {} }",
                    Syntax::Json => "names with their textures: { \"clouds\": { \"Noise\": {} } }",
                };
                return self.wrong_type(item, at, expected);
            }
        }
        self.named.damaged |= item.is_damaged();
        let (start, mut twice) = (self.named.list.len(), Vec::new());
        for (key, value) in item.fields() {
            if self.sink.is_full() {
                break;
            }
            self.path.push(Step::Key(key.text().into_owned()));
            if self.is_new(key) {
                self.take_name(key, value);
            } else {
                twice.push(value);
            }
            self.path.pop();
        }
        for k in start..self.named.list.len() {
            self.read_texture(k, item);
        }
        // What is wrong with them is told all the same.
        for value in twice {
            self.defined(value);
        }
        Some(())
    }

    /// Whether there is none of this name whose place it does not take. What is wrong with the name is told.
    fn is_new(&mut self, key: Item<'_, '_>) -> bool {
        let name = key.text();
        if name.trim().is_empty() {
            self.report(
                Diagnostic::error(codes::EMPTY_TEXT, key.span(), "the name of a texture is empty")
                    .expected("a name between quotes"),
            );
        } else if name.starts_with(['#', '=']) {
            let meant = if name.starts_with('#') { "a colour" } else { "an expression" };
            let message = format!("\"{}\" cannot be the name of a texture", shortened(&name));
            self.report(
                Diagnostic::error(codes::BAD_NAME, key.span(), message)
                    .expected("a name that does not begin with `#` or `=`")
                    .hint(format!("where it is used it would be {meant}")),
            );
        }
        let Some(first) = self.named.find(&name).map(|k| self.named.list[k].name.span) else { return true };
        // What a file includes gives way to its own names.
        if self.gives_way(first, key.span()) {
            return true;
        }
        let message = format!("two textures have the name \"{}\"", shortened(&name));
        let fault = Diagnostic::error(codes::DUPLICATE_NAME, key.span(), message);
        self.report(fault.hint("rename one of the two, or remove it").label(first, "the first one is here"));
        false
    }

    fn take_name(&mut self, key: Item<'_, '_>, value: Item<'_, '_>) {
        let name: Arc<str> = Arc::from(&*key.text());
        let slot = value.index() as u32;
        let wins = |own: &HashMap<Arc<str>, u32>| own.get(&name).is_none_or(|winner| *winner == slot);
        let file = match (&self.named.file, self.open.last()) {
            (Some(file), _) => Some(file.clone()),
            (None, Some(open)) if !wins(&self.kept.own) => Some(open.name.clone()),
            _ => None,
        };
        self.named.by_name.insert(Arc::clone(&name), self.named.list.len());
        let name = Spanned { value: name, span: key.span() };
        self.named.list.push(Entry { name, slot, file, state: State::NotYet, used: false });
    }

    /// Reads what a name stands for, if that has not been done. `near`: any item of the tree; where it is named.
    fn read_texture(&mut self, k: usize, near: Item<'_, '_>) {
        match &self.named.list[k].state {
            State::NotYet if self.named.open.len() > Nested::MOST => {
                let message = format!("textures stand more than {} deep", Nested::MOST);
                self.report(Diagnostic::error(codes::TOO_MUCH, near.head(), message).expected("fewer"));
                self.named.list[k].state = State::Failed;
            }
            State::NotYet => {
                let entry = &mut self.named.list[k];
                entry.state = State::Open;
                let (slot, step) = (entry.slot, Step::Key((*entry.name.value).to_owned()));
                let path = std::mem::replace(&mut self.path, vec![Step::Field("textures"), step]);
                self.named.open.push(k);
                let read = near.other(slot).and_then(|item| self.defined(item));
                self.named.open.pop();
                self.path = path;
                // A circle has been told where it closes.
                if let State::Open = self.named.list[k].state {
                    self.named.list[k].state = read.map_or(State::Failed, |(texture, made)| State::Read(texture, made));
                }
            }
            State::Open => self.circle_of_textures(k, near),
            State::Read(..) | State::Kept(..) | State::Failed => {}
        }
    }

    /// What stands at a name of `textures`.
    fn defined(&mut self, item: Item<'_, '_>) -> Option<(Albedo, Nested)> {
        let around = std::mem::take(&mut self.textures);
        let read = match self.picked(item) {
            Some(item) if item.is_null() => self.null(item, &TEXTURE),
            Some(item) => {
                // Names of names go deeper, too.
                let named = (item.kind() == Kind::Text).then(|| self.textures.enter(&TEXTURE));
                let texture = Albedo::read(self, item, &TEXTURE);
                if let Some(before) = named {
                    self.textures.leave(before);
                }
                texture
            }
            None => None,
        };
        let made = std::mem::replace(&mut self.textures, around);
        read.map(|texture| (texture, made))
    }

    fn circle_of_textures(&mut self, k: usize, item: Item<'_, '_>) {
        let first = self.named.open.iter().position(|open| *open == k).unwrap_or(0);
        let open = &self.named.open[first..];
        let quoted = |k: &usize| format!("\"{}\"", shortened(&self.named.list[*k].name.value));
        let names: Vec<String> = open.iter().map(quoted).collect();
        let message = match names.as_slice() {
            [only] => format!("the texture {only} names itself"),
            [first, rest @ ..] => {
                let then: String = rest.iter().map(|name| format!(" {name}, which names")).collect();
                format!("the texture {first} names{then} {first}")
            }
            [] => return,
        };
        let fault = Diagnostic::error(codes::CIRCLE, item.span(), message)
            .expected("textures that do not need themselves")
            .label(self.named.list[k].name.span, "the circle begins here");
        self.named.list[k].state = State::Failed;
        self.report(fault);
    }

    /// The texture whose name stands where a colour is due.
    pub(crate) fn texture_by_name(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Arc<NamedTexture>> {
        let name = item.text();
        let Some(k) = self.named.find(&name) else {
            self.unknown_texture(&name, item, at);
            return None;
        };
        self.named.list[k].used = true;
        self.read_texture(k, item);
        let (named, made) = self.kept_texture(k)?;
        if let Some(message) = self.textures.add(made) {
            self.report(Diagnostic::error(codes::TOO_MUCH, item.head(), message).expected("fewer"));
            return None;
        }
        Some(named)
    }

    /// A texture that was read, as the description has it.
    fn kept_texture(&mut self, k: usize) -> Option<(Arc<NamedTexture>, Nested)> {
        let Entry { name, file, state, .. } = &mut self.named.list[k];
        match std::mem::replace(state, State::Failed) {
            State::Read(texture, made) => {
                *state = State::Kept(self.kept.keep(name.clone(), file.as_deref(), texture), made);
            }
            other => *state = other,
        }
        match state {
            State::Kept(named, made) => Some((Arc::clone(named), *made)),
            _ => None,
        }
    }

    /// The scene's textures, when all of it has been read: its own in order of writing, then those with a file's name.
    pub(super) fn take_textures(&mut self) -> Vec<Arc<NamedTexture>> {
        let mut textures = Vec::new();
        for k in 0..self.named.list.len() {
            let entry = &self.named.list[k];
            if entry.file.is_none() && self.named.find(&entry.name.value) == Some(k) {
                textures.extend(self.kept_texture(k).map(|(named, _)| named));
            }
        }
        textures.append(&mut self.kept.list);
        textures
    }

    /// The name of a texture without its quotes: reports it, and says that it did.
    pub(crate) fn name_without_quotes(&mut self, item: Item<'_, '_>) -> bool {
        let known = matches!(item.kind(), Kind::Word | Kind::Char).then(|| self.named.find(&item.text())).flatten();
        let Some(k) = known else { return false };
        self.named.list[k].used = true;
        let mended = crate::print::text(&item.text(), item.syntax());
        let message = "names of textures stand between double quotes";
        let mut fault = Diagnostic::error(codes::WORD_NOT_QUOTED, item.span(), message)
            .expected("the name of a texture between quotes, or a colour or texture written here")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }

    /// Whether there is a texture of this name.
    pub(super) fn knows_texture(&self, name: &str) -> bool {
        self.named.find(name).is_some()
    }

    /// A text that is neither a colour nor a name. Never gives a value.
    fn unknown_texture(&mut self, name: &str, item: Item<'_, '_>, at: &'static FieldDef) {
        if self.is_another_color(name) {
            self.text_color(item, at);
            return;
        }
        // Many names times many mistakes would take long: the first mistakes are the ones that are read.
        let count = self.named.by_name.len();
        let few = count * (self.named.unknown + 1) <= MAX_COMPARISONS;
        self.named.unknown += 1;
        let known = if few { self.named.names() } else { Vec::new() };
        let known: Vec<&str> = known.iter().map(|name| &**name).collect();
        let nearest = suggest::nearest(name, known.iter().copied());
        if nearest.is_none() && (self.named.damaged || self.texture_elsewhere(item, &PatternWords::DEF)) {
            return;
        }
        let message = format!("there is no texture \"{}\"", shortened(name));
        let mut fault = Diagnostic::error(codes::UNKNOWN_NAME, item.span(), message);
        fault.expected = match count {
            0 => "a colour, or a texture written here: `textures` is empty".to_owned(),
            1..=8 if few => format!("a colour, or a name from `textures`: {}", suggest::list(&known)),
            count => format!("a colour, or one of the {count} names in `textures`"),
        };
        fault.did_you_mean(nearest, |word| crate::print::text(word, item.syntax()));
        if nearest.is_none()
            && let Some(mended) = super::colors_elsewhere::numbers_in_text(item, 3)
        {
            fault.hint = format!("write {mended}");
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        } else if nearest.is_none()
            && let Some(metal) = super::colors_elsewhere::metal(name, item)
        {
            fault.hint = metal;
        } else if nearest.is_none()
            && let Some(ramp) = super::figures::ramp_of_map(name, item.syntax())
        {
            fault.hint = format!("a colour map is a ramp over another texture, here over v: {ramp}");
        } else if nearest.is_none() {
            fault.hint = match (self.knows_material(name), item.syntax()) {
                (true, _) => format!("\"{}\" is a material, which has a colour of its own", shortened(name)),
                (_, Syntax::Ron) => {
                    "add it to `textures`; colours have no names here: red is (1, 0, 0) or \"#ff0000\"".to_owned()
                }
                (_, Syntax::Toml) => {
                    "add it to [textures]; colours have no names here: red is [1, 0, 0] or \"#ff0000\"".to_owned()
                }
                (_, Syntax::Json) => {
                    "add it to \"textures\"; colours have no names here: red is [1, 0, 0] or \"#ff0000\"".to_owned()
                }
            };
        }
        self.report(fault);
    }
}

/// For what stands at a name.
static TEXTURE: FieldDef =
    FieldDef { name: "", noun: "the texture", doc: &[], kind: Albedo::TYPE, rule: Rule::share(), default: None };
