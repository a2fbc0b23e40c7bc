//! Materials by name, and who uses them.

use super::colors_elsewhere::diffuse;
use super::{Reader, Step, is_picture, make_room, shortened};
use crate::codes;
use crate::css_colors::named_color;
use crate::desc::{Material, Metal, NamedMaterial};
use crate::diagnostic::{Diagnostic, Edit, Spanned};
use crate::schema::FieldDef;
use crate::suggest;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind, NOWHERE};
use crate::words::Words;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, RandomState};
use std::sync::Arc;

/// Comparisons of unknown names with known ones.
const MAX_COMPARISONS: usize = 200_000;

/// All materials that are written. Their names are in memory once: whoever uses one shares it.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// Those that could be read, in order of writing.
    read: Vec<NamedMaterial>,
    /// The names of the others, each of which has been reported.
    unread: Vec<Spanned<Arc<str>>>,
    /// Whether an object uses them: those that could be read, and the others. Shorter where the last ones are not used.
    used: [Vec<bool>; 2],
    /// How many materials of included scenes have a name that begins so.
    adopted: HashMap<String, usize>,
    /// The names of these.
    foreign: HashSet<Arc<str>>,
    /// Open addressing over four bytes a name: the number of a name that could be read, or of another, counted down
    /// from `NOWHERE`.
    slots: Vec<u32>,
    hash: RandomState,
    /// Part of `materials` could not be read: names may be missing.
    pub damaged: bool,
    /// Uses of names that are not there.
    unknown: usize,
}

/// In place of a name's number: none.
const FREE: u32 = NOWHERE;

impl Materials {
    /// The materials, which no name is asked of any more.
    pub fn take(&mut self) -> Vec<NamedMaterial> {
        std::mem::take(&mut self.read)
    }

    /// Whether one of them shines.
    pub fn any_shines(&self) -> bool {
        self.read.iter().any(|named| named.material.shines().is_some())
    }

    /// The numbers of those that no object uses.
    pub fn unused(&self) -> impl Iterator<Item = u32> {
        let used = |of: &[bool], k: usize| of.get(k).copied().unwrap_or(false);
        let ([read, unread], first) = (&self.used, self.read.len());
        let of_read = (0..first).filter(move |&k| !used(read, k));
        let of_unread = (0..self.unread.len()).filter(move |&k| !used(unread, k));
        of_read.map(|k| k as u32).chain(of_unread.map(|k| FREE - 1 - k as u32))
    }

    /// The name with this number: first those that could be read, then the others.
    pub fn name(&self, number: u32) -> &Spanned<Arc<str>> {
        match self.read.get(number as usize) {
            Some(named) => &named.name,
            None => &self.unread[(FREE - 1 - number) as usize],
        }
    }

    fn names(&self) -> impl Iterator<Item = &Spanned<Arc<str>>> {
        self.read.iter().map(|named| &named.name).chain(&self.unread)
    }

    /// Where a name stands in the index, or where it would.
    fn slot(&self, name: &str) -> usize {
        let mask = self.slots.len() - 1;
        let mut at = self.hash.hash_one(name) as usize & mask;
        while self.slots[at] != FREE && *self.name(self.slots[at]).value != *name {
            at = (at + 1) & mask;
        }
        at
    }

    fn find(&self, name: &str) -> Option<u32> {
        let slot = (!self.slots.is_empty()).then(|| self.slots[self.slot(name)])?;
        (slot != FREE).then_some(slot)
    }

    /// Remembers a name that is not known yet, and its material.
    fn insert(&mut self, name: Spanned<Arc<str>>, material: Option<Material>) {
        // At most seven of eight slots are taken.
        if (self.read.len() + self.unread.len()) * 8 >= self.slots.len() * 7 {
            let grown = vec![FREE; (self.slots.len() * 2).max(16)];
            for number in std::mem::replace(&mut self.slots, grown) {
                if number != FREE {
                    let at = self.slot(&self.name(number).value);
                    self.slots[at] = number;
                }
            }
        }
        let at = self.slot(&name.value);
        match material {
            Some(material) => {
                self.slots[at] = self.read.len() as u32;
                self.read.push(NamedMaterial { name, material });
            }
            None => {
                self.slots[at] = FREE - 1 - self.unread.len() as u32;
                self.unread.push(name);
            }
        }
    }

    /// The name of a material that is, or is nearest to, a word.
    pub fn nearest(&self, word: &str) -> Option<Arc<str>> {
        if let Some(number) = self.find(word) {
            return Some(Arc::clone(&self.name(number).value));
        }
        let few = (self.read.len() + self.unread.len()) * (self.unknown + 1) <= MAX_COMPARISONS;
        let names = self.names().filter(|_| few).map(|name| &*name.value);
        suggest::nearest(word, names).map(Arc::from)
    }

    /// Remembers that a name is used.
    pub fn use_name(&mut self, name: &str) {
        self.unknown += 1;
        if let Some(number) = self.find(name) {
            self.mark(number);
        }
    }

    fn mark(&mut self, number: u32) {
        let (used, at, all) = match (number as usize) < self.read.len() {
            true => (&mut self.used[0], number as usize, self.read.len()),
            false => (&mut self.used[1], (FREE - 1 - number) as usize, self.unread.len()),
        };
        if used.len() < all {
            used.resize(all, false);
        }
        used[at] = true;
    }

    /// Whether there is one of this name.
    pub fn knows(&self, name: &str) -> bool {
        self.damaged || self.find(name).is_some()
    }

    /// All names.
    pub fn known(&self) -> Vec<Arc<str>> {
        self.names().map(|name| Arc::clone(&name.value)).filter(|name| !self.foreign.contains(name)).collect()
    }

    /// Takes a material of an included file, under a name that says so; the same one only once. Gives the name.
    pub fn adopt(&mut self, file: &str, named: NamedMaterial) -> Arc<str> {
        let base = format!("{file}: {}", named.name.value);
        let called = |k: usize| if k == 1 { base.clone() } else { format!("{base} ({k})") };
        let mut k = self.adopted.get(&base).copied().unwrap_or(0);
        if let Some(number) = self.find(&called(k.max(1)))
            && let Some(last) = self.read.get(number as usize)
            && last.material == named.material
        {
            return Arc::clone(&last.name.value);
        }
        loop {
            k += 1;
            if self.find(&called(k)).is_none() {
                break;
            }
        }
        let name: Arc<str> = called(k).into();
        self.adopted.insert(base, k);
        self.foreign.insert(Arc::clone(&name));
        self.insert(Spanned { value: Arc::clone(&name), span: named.name.span }, Some(named.material));
        name
    }
}

/// A list of materials as a map of them.
fn by_names(list: Item<'_, '_>) -> String {
    const MOST: usize = 3;
    if list.lexeme().starts_with("[[") && list.syntax() == Syntax::Toml {
        return "each has a name here, by which objects have it: [materials.a.Diffuse] begins one".to_owned();
    }
    let written = |(at, item): (usize, Item<'_, '_>)| {
        let name = char::from(b'a' + at as u8);
        let name = if list.syntax() == Syntax::Toml { format!("{name} = ") } else { format!("\"{name}\": ") };
        format!("{name}{}", item.lexeme())
    };
    let few: Vec<String> = list.children().take(MOST).enumerate().map(written).collect();
    let more = if list.children().count() > MOST { ", .." } else { "" };
    let map = format!("{{ {}{more} }}", few.join(", "));
    // A long one is told by its beginning.
    let is_alone = |item: Item<'_, '_>| item.name().is_some() || item.fields().take(2).count() == 1;
    match map.len() <= 120 && !map.contains('\n') && !few.is_empty() && list.children().take(MOST).all(is_alone) {
        true => format!("each has a name here, by which objects have it: {map}"),
        false => "each has a name here, by which objects have it: { \"a\": Diffuse(albedo: 0.5), .. }".to_owned(),
    }
}

impl Reader<'_> {
    /// `{ "name": material }`. They stay with the reader until all objects are read.
    pub(crate) fn materials(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<()> {
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(()),
            _ => {
                // Which names were meant nobody knows, so none is called unknown.
                self.materials.damaged = true;
                let expected = match item.syntax() {
                    Syntax::Ron => "names with their materials: { \"white\": Diffuse(albedo: 1) }",
                    Syntax::Toml => "a table [materials], with a line for each: white = { Diffuse = { albedo = 1 } }",
                    Syntax::Json => "names with their materials: { \"white\": { \"Diffuse\": { \"albedo\": 1 } } }",
                };
                if item.kind() == Kind::List {
                    let message = format!("{} cannot be {}", super::plain(at.noun), super::describe(item));
                    let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected);
                    self.report(fault.hint(by_names(item)));
                    return None;
                }
                return self.wrong_type(item, at, expected);
            }
        }
        self.materials.damaged |= item.is_damaged();
        let mut fields = item.fields();
        let (mut piece, mut begin) = (0, 0);
        while let Some((key, value)) = fields.next().filter(|_| !self.sink.is_full()) {
            if fields.piece() != piece {
                (piece, begin) = (fields.piece(), value.index());
            }
            if self.open.is_empty() {
                begin = key.release_before(begin);
            }
            let name = key.text();
            self.path.push(Step::Key((*name).to_owned()));
            if name.trim().is_empty() {
                self.report(
                    Diagnostic::error(codes::EMPTY_TEXT, key.span(), "the name of a material is empty")
                        .expected("a name between quotes"),
                );
            }
            let known = self.materials.find(&name);
            let first = known.map(|first| self.materials.name(first).span);
            // What a file includes gives way to its own names.
            let replaces = first.is_some_and(|first| self.gives_way(first, key.span()));
            if let Some(first) = first.filter(|_| !replaces) {
                self.report(
                    Diagnostic::error(
                        codes::DUPLICATE_NAME,
                        key.span(),
                        format!("two materials have the name \"{}\"", shortened(&name)),
                    )
                    .hint("rename one of the two, or remove it")
                    .label(first, "the first one is here"),
                );
            }
            let value = self.picked(value);
            let elsewhere = value.is_some_and(|value| self.material_by_word(value) || self.material_elsewhere(value));
            let material = value.filter(|_| !elsewhere).and_then(|value| Material::read(self, value, at));
            if let (true, Some(number), Some(material)) = (replaces, known, &material)
                && let Some(old) = self.materials.read.get_mut(number as usize)
            {
                (old.name.span, old.material) = (key.span(), material.clone());
            }
            if first.is_none() {
                make_room(&mut self.materials.read, item, key);
                self.materials.insert(Spanned { value: (*name).into(), span: key.span() }, material);
            }
            self.path.pop();
        }
        Some(())
    }

    /// Whether there is a material of this name.
    pub(crate) fn knows_material(&self, name: &str) -> bool {
        self.materials.find(name).is_some()
    }

    /// The name of a material, which an object uses.
    pub(crate) fn material_name(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Arc<str>> {
        let name = self.text(item, at)?;
        if let Some(number) = self.materials.find(&name) {
            self.materials.mark(number);
            return Some(Arc::clone(&self.materials.name(number).value));
        }
        if !self.materials.damaged {
            self.unknown_material(&name, item);
        }
        Some((*name).into())
    }

    /// A colour, a metal or a kind of glass by its name where a material is written, `"red"`: reports it, and says that
    /// it did.
    fn material_by_word(&mut self, item: Item<'_, '_>) -> bool {
        let text = item.text();
        if item.kind() != Kind::Text || Material::DEF.variant(&text).is_some() {
            return false;
        }
        let Some(mended) = self.of_its_name(&text, item) else { return false };
        let message = format!("a material cannot be {}", super::describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected("a material, with its fields")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }

    // Long: one list of what is answered with, and in which order it is asked.
    fn unknown_material(&mut self, name: &str, item: Item<'_, '_>) {
        // That the value is none has been told where it stands.
        if name.strip_prefix('=').is_some_and(|bare| self.uses_failed_var(bare.trim())) {
            self.materials.unknown += 1;
            self.sink.errors += 1;
            return;
        }
        let count = self.materials.read.len() + self.materials.unread.len();
        // Many names times many mistakes would take long: the first mistakes are the ones that are read.
        let few = count * (self.materials.unknown + 1) <= MAX_COMPARISONS;
        let count = count - self.materials.foreign.len();
        let own = |name: &&Spanned<Arc<str>>| few && !self.materials.foreign.contains(&name.value);
        let mut known: Vec<_> = self.materials.names().filter(own).collect();
        known.sort_by_key(|name| name.span);
        let known: Vec<&str> = known.into_iter().map(|name| &*name.value).collect();
        let kind = Material::DEF.variant(name);
        let mut fault = Diagnostic::error(
            codes::UNKNOWN_MATERIAL,
            item.span(),
            format!("there is no material \"{}\"", shortened(name)),
        );
        fault.expected = match count {
            0 => "a material written here: `materials` is empty".to_owned(),
            1..=8 if few => format!("a name from `materials`: {}", suggest::list(&known)),
            count => format!("one of the {count} names in `materials`"),
        };
        let nearest = suggest::nearest(name, known.iter().copied());
        fault.did_you_mean(nearest, |word| crate::print::text(word, item.syntax()));
        if nearest.is_none() && is_picture(name) {
            let replacement = match item.syntax() {
                Syntax::Ron => format!("Diffuse(albedo: Texture(file: {}))", item.lexeme()),
                syntax => {
                    let texture = format!("{{ Texture = {{ file = {} }} }}", item.lexeme());
                    syntax.of_toml(format!("{{ Diffuse = {{ albedo = {texture} }} }}")).into_owned()
                }
            };
            fault.hint = format!("a picture is the texture of a material: {}", super::hinted(&replacement));
            fault.edit = Some(Edit { span: item.span(), replacement });
        } else if nearest.is_none() && self.knows_texture(name) {
            let replacement = match item.syntax() {
                Syntax::Ron => format!("Diffuse(albedo: {})", item.lexeme()),
                syntax => syntax.of_toml(format!("{{ Diffuse = {{ albedo = {} }} }}", item.lexeme())).into_owned(),
            };
            fault.hint = format!("it is a texture, and a material has one: {}", shortened(&replacement));
            fault.edit = Some(Edit { span: item.span(), replacement });
        } else if let Some(bare) = name.strip_prefix('=') {
            let bare = bare.trim();
            match known.contains(&bare) {
                true => {
                    let mended = crate::print::text(bare, item.syntax());
                    fault.hint = format!("write {mended}: names of materials are no expressions");
                    fault.edit = Some(Edit { span: item.span(), replacement: mended });
                }
                false => {
                    // Of those that there are.
                    let two: Vec<String> = known.iter().take(2).map(|name| format!("\"{name}\"")).collect();
                    let from = if two.len() == 2 { two.join(", ") } else { "..".to_owned() };
                    fault.hint = format!(
                        "names of materials are no expressions; one of several is taken by Pick(from: [{from}], index: \
                         \"=i % 2\")"
                    );
                }
            }
        } else if nearest.is_none() {
            fault.hint = match (kind, item.syntax()) {
                (Some(_), Syntax::Ron) => format!("for a material written here, remove the quotes: {name}(..)"),
                (Some(_), syntax) => {
                    syntax.of_toml(format!("for a material written here: {{ {name} = {{ .. }} }}")).into_owned()
                }
                (None, syntax) => {
                    let list = match syntax {
                        Syntax::Ron => "`materials`",
                        Syntax::Toml => "[materials]",
                        Syntax::Json => "\"materials\"",
                    };
                    format!("add it to {list}, or write the material here: {}", self.by_its_name(name, item))
                }
            };
        }
        self.materials.unknown += 1;
        self.report(fault);
    }
}

impl Reader<'_> {
    /// What is most likely meant by the name of a material: its colour, metal or kind of glass where the name tells it.
    fn by_its_name(&self, name: &str, item: Item<'_, '_>) -> String {
        self.of_its_name(name, item).unwrap_or_else(|| diffuse("0.5", item.syntax()))
    }

    /// The same, where the name is that of a texture or of a var, or tells it.
    fn of_its_name(&self, name: &str, item: Item<'_, '_>) -> Option<String> {
        let own = || self.color_by_name(item).map(|color| diffuse(&color, item.syntax()));
        let is_own = self.knows_texture(name) || self.knows_var(name);
        if is_own { own() } else { told_by_name(name, item.syntax()) }
    }
}

/// A material where a word of its name tells it.
fn told_by_name(name: &str, syntax: Syntax) -> Option<String> {
    let word = |word: &str| {
        let clear = match word {
            "glass" | "window" | "bottle" => "1.5",
            "water" => "1.33",
            "ice" => "1.31",
            "diamond" => "2.42",
            _ => "",
        };
        let metal = Metal::DEF.variants.iter().find(|metal| metal.name.eq_ignore_ascii_case(word));
        match named_color(word) {
            _ if !clear.is_empty() => Some(("Transparent", "ior", clear.to_owned())),
            _ if word == "mirror" => Some(("Mirror", "reflectance", "0.9".to_owned())),
            _ if let Some(metal) = metal => Some(("Conductor", "metal", metal.name.to_owned())),
            Some(hex) => Some(("Diffuse", "albedo", format!("\"{hex}\""))),
            None => None,
        }
    };
    let lower = name.to_ascii_lowercase();
    let found = lower.split(|c: char| !c.is_ascii_alphabetic()).take(8).find_map(word);
    let (kind, field, value) = found?;
    Some(match syntax {
        Syntax::Ron => format!("{kind}({field}: {value})"),
        _ if field == "metal" => syntax.of_toml(format!("{{ {kind} = {{ {field} = \"{value}\" }} }}")).into_owned(),
        syntax => syntax.of_toml(format!("{{ {kind} = {{ {field} = {value} }} }}")).into_owned(),
    })
}
