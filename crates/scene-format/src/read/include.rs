//! Other files in a scene: libraries ([`super::library`]), and scenes among its objects (`Include`).

use super::check::ROOT;
use super::materials::Materials;
use super::repeat::MOST_ITEMS;
use super::{Reader, shortened, textures, vars};
use crate::codes;
use crate::desc::{IncludeWords, Light, MaterialRef, NamedMaterial, Object, Scene, group};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::expression::Value;
use crate::files::{MOST_FILES, joined};
use crate::form::Form;
use crate::schema::{FieldDef, Type};
use crate::suggest;
use crate::tree::{Item, Kind, NOWHERE, Root};
use crate::words::Words;
use std::collections::HashMap;
use std::sync::Arc;

/// Files within each other, at most.
pub(super) const MOST_DEEP: usize = 8;

/// The field `include`: what it brings stays with the reader.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Includes;

/// Values for vars of an included scene.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct GivenVars(pub Vec<(Spanned<Arc<str>>, Value)>);

/// Materials for names of an included scene.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct GivenMaterials(pub Vec<(Spanned<Arc<str>>, MaterialRef)>);

/// What is taken of a file: nothing else of it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    /// By `include`, first.
    Vars,
    /// By `include`, when all `vars` are known.
    Names,
    /// By `Include`.
    Scene,
}

impl Taken {
    fn fields(self) -> &'static [&'static str] {
        match self {
            Taken::Vars => &["version", "include", "vars"],
            Taken::Names => &["version", "include", "textures", "materials", "cameras"],
            Taken::Scene => &["version", "include", "vars", "textures", "materials", "objects", "lights"],
        }
    }
}

/// A file that is being read.
#[derive(Debug)]
pub(super) struct Open {
    pub taken: Taken,
    /// Where its tree begins.
    root: u32,
    pub name: String,
    /// Where it is named.
    from: Span,
}

impl Open {
    /// Adds where the file is included.
    pub fn labelled(&self, fault: Diagnostic) -> Diagnostic {
        fault.label(self.from, format!("{} is included here", self.name))
    }

    /// Where the file is named, and its name.
    pub fn from(&self) -> (Span, String) {
        (self.from, self.name.clone())
    }
}

impl Words for Includes {
    const TYPE: Type = Type::List(&Type::File);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let read = reader.libraries(item, at);
        read.map(|()| Includes)
    }

    fn form(&self, _all: bool) -> Form {
        Form::List(Vec::new())
    }
}

impl Words for GivenVars {
    const TYPE: Type = Type::Map(&Type::Value);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let expected = "names of its vars with other values: { \"height\": 0.75 }";
        let mut given = Vec::new();
        reader.entries(item, at, expected, |reader, name, value| {
            given.extend(reader.value(value).map(|value| (name, value)));
        })?;
        Some(GivenVars(given))
    }

    fn form(&self, _all: bool) -> Form {
        Form::Map(Vec::new())
    }
}

impl Words for GivenMaterials {
    const TYPE: Type = Type::Map(&MaterialRef::TYPE);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let expected = "names of its materials with others: { \"seat\": \"oak\" }";
        let mut given = Vec::new();
        reader.entries(item, at, expected, |reader, name, value| {
            given.extend(MaterialRef::read(reader, value, at).map(|material| (name, material)));
        })?;
        Some(GivenMaterials(given))
    }

    fn form(&self, _all: bool) -> Form {
        Form::Map(Vec::new())
    }
}

impl Reader<'_> {
    /// Goes through names with what stands at them.
    fn entries<'t, 's>(
        &mut self,
        item: Item<'t, 's>,
        at: &'static FieldDef,
        expected: &str,
        mut read: impl FnMut(&mut Self, Spanned<Arc<str>>, Item<'t, 's>),
    ) -> Option<()> {
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(()),
            _ => return self.wrong_type(item, at, expected),
        }
        for (key, value) in item.fields() {
            self.path.push(super::Step::Key(key.text().into_owned()));
            if let Some(value) = self.picked(value) {
                read(self, Spanned { value: Arc::from(&*key.text()), span: key.span() }, value);
            }
            self.path.pop();
        }
        Some(())
    }

    /// The tree of a file that an item names; what is wrong with it is reported.
    pub(super) fn open<'t, 's>(&mut self, name: Item<'t, 's>, text: &str) -> Option<(&'t Root, Item<'t, 's>)> {
        let opened = self.opened(name, text);
        if opened.is_none() {
            self.names_may_be_missing();
        }
        opened
    }

    /// Notes that a file has not brought its names, for that no other fault is to be told.
    pub(super) fn names_may_be_missing(&mut self) {
        (self.materials.damaged, self.cameras.damaged) = (true, true);
        (self.named.damaged, self.vars.damaged) = (true, true);
    }

    fn opened<'t, 's>(&mut self, name: Item<'t, 's>, text: &str) -> Option<(&'t Root, Item<'t, 's>)> {
        let path = joined(name.folder(), text);
        let shown = shortened(text);
        let fault = |message: String, code| Diagnostic::error(code, name.span(), message);
        let Some(file) = name.included(&path) else {
            let fault = match name.span() {
                // A description that serde gives.
                Span::NONE => fault(format!("cannot include {shown}: no file is looked at here"), codes::INCLUDE)
                    .expected("a scene that stands alone; `load` reads one with what it includes"),
                _ if name.included_files() >= MOST_FILES => {
                    fault(format!("more than {MOST_FILES} files are included"), codes::TOO_MUCH).expected("fewer")
                }
                // Where the word before it is wrong, that is told.
                _ if self.sink.errors > 0 => return None,
                _ => fault(format!("cannot include {shown}: it is not known before the scene is read"), codes::INCLUDE)
                    .expected("the name as it is, in `include` or as the `file` of an `Include`"),
            };
            // All that are too many are so by one fault.
            let known = |other: &Diagnostic| other.code == codes::TOO_MUCH && other.message == fault.message;
            if self.sink.diagnostics.iter().any(known) {
                self.sink.errors += 1;
                return None;
            }
            self.report(fault);
            return None;
        };
        if let Some(why) = &file.fault {
            let fault = fault(format!("cannot include {shown}: {why}"), codes::INCLUDE)
                .expected("a scene file; names start from the folder of the file that they stand in");
            // A name without its ending, as modules have.
            let is_bare = std::path::Path::new(text).extension().is_none();
            let hint = is_bare
                .then(|| format!("names have their ending: \"{shown}.{}\"", name.syntax().name().to_lowercase()));
            self.report(match hint {
                Some(hint) => fault.hint(hint),
                None => fault,
            });
            return None;
        }
        if let Some(first) = self.open.iter().position(|open| open.root == file.root) {
            let names: Vec<&str> = self.open[first..].iter().map(|open| open.name.as_str()).collect();
            let message = match names.as_slice() {
                [only] => format!("{only} includes itself"),
                names => format!("{} include each other", suggest::join(names, "and")),
            };
            self.report(fault(message, codes::CIRCLE).expected("files that do not need themselves"));
            return None;
        }
        if self.open.len() >= MOST_DEEP {
            let message = format!("files include each other more than {MOST_DEEP} deep");
            self.report(fault(message, codes::TOO_MUCH).expected("fewer"));
            return None;
        }
        // An empty file, or one whose faults of syntax have been told.
        let root = name.other(file.root)?;
        // What is included again is read again: that counts as what repetitions make.
        if self.sink.repeated > MOST_ITEMS {
            return None;
        }
        self.sink.repeated += 10 + u64::from(file.nodes) / 4;
        if self.sink.repeated > MOST_ITEMS {
            let message = format!("includes and repetitions make more than {MOST_ITEMS} items");
            self.report(fault(message, codes::TOO_MUCH).expected("fewer").hint("copies are cheaper by `placements`"));
            return None;
        }
        Some((file, root))
    }

    /// Reads a file that is open, with paths of its own in messages.
    pub(super) fn within<T>(
        &mut self,
        name: Item<'_, '_>,
        file: &Root,
        taken: Taken,
        read: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let path = std::mem::take(&mut self.path);
        self.open.push(Open { taken, root: file.root, name: file.name.clone(), from: name.span() });
        let value = read(self);
        self.open.pop();
        self.path = path;
        value
    }

    /// Leaves out the fields of an included scene that are not taken: its background's picture is not looked at.
    pub(super) fn leave_out_untaken(&self, fields: &mut super::Fields<'_, '_>) {
        let Some(open) = self.open.last() else { return };
        for (field, slot) in fields.def.fields.iter().zip(&mut fields.slots) {
            if !open.taken.fields().contains(&field.name) {
                *slot = NOWHERE;
            }
        }
    }

    /// Reads an `Include`: the objects and lights of another scene, with names of their own.
    pub(crate) fn include(&mut self, item: Item<'_, '_>, words: IncludeWords) -> Option<Vec<Spanned<Object>>> {
        let body = if item.kind() == Kind::Map { item.fields().next()?.1 } else { item };
        let (_, name) = body.fields().find(|(key, _)| key.text() == "file")?;
        let name = self.picked(name)?;
        let (file, root) = self.open(name, &name.text())?;
        // Its own names.
        let materials = std::mem::take(&mut self.materials);
        let cameras = std::mem::take(&mut self.cameras);
        let named = std::mem::replace(&mut self.named, textures::Scope::of_file(&file.name));
        let given = words.vars.0.iter().map(|(name, value)| (Arc::clone(&name.value), value.clone())).collect();
        let vars = std::mem::replace(&mut self.vars, vars::Table::with(given));
        let scene = self.within(name, file, Taken::Scene, |reader| {
            if super::check::newer_version(root, reader.sink) {
                return None;
            }
            let scene = Scene::read(reader, root, &ROOT);
            reader.pending_vars(root);
            scene
        });
        let inner = std::mem::replace(&mut self.materials, materials);
        (self.cameras, self.named) = (cameras, named);
        let table = std::mem::replace(&mut self.vars, vars);
        let mut objects = scene.map(|scene| of_scene(scene.objects.0, scene.lights))?;
        for (name, _) in words.vars.0.iter().filter(|(name, _)| table.is_left(&name.value)) {
            self.unknown_name(codes::UNKNOWN_NAME, "var", &file.name, name, &table.names());
        }
        self.take_materials(&mut objects, inner, words.materials, &file.name);
        group::hide(words.camera_visible, &mut objects);
        group::moved(self, words.transform, words.placements, &mut objects).then_some(objects)
    }

    /// That an included file has no var or material of this name.
    fn unknown_name(
        &mut self,
        code: codes::Code,
        what: &str,
        file: &str,
        name: &Spanned<Arc<str>>,
        known: &[Arc<str>],
    ) {
        let known: Vec<&str> = known.iter().map(|name| &**name).collect();
        let message = format!("{file} has no {what} \"{}\"", shortened(&name.value));
        let mut fault = Diagnostic::error(code, name.span, message).expected(match known.len() {
            0 => format!("none: it has no {what}s"),
            1..=8 => format!("one of {}", suggest::list(&known)),
            count => format!("one of its {count} {what}s"),
        });
        let nearest = suggest::nearest(&name.value, known.iter().copied());
        fault.did_you_mean(nearest, |word| crate::print::text(word, crate::Syntax::Ron));
        self.report(fault);
    }

    /// Gives the objects of an included scene materials of this one: those that are given for its own, else its own
    /// under names that say where they come from.
    fn take_materials(
        &mut self,
        objects: &mut [Spanned<Object>],
        mut inner: Materials,
        given: GivenMaterials,
        file: &str,
    ) {
        let mut names: HashMap<Arc<str>, MaterialRef> = HashMap::new();
        for (name, material) in given.0 {
            if !inner.knows(&name.value) {
                self.unknown_name(codes::UNKNOWN_MATERIAL, "material", file, &name, &inner.known());
            }
            names.insert(name.value, material);
        }
        let read = inner.take();
        let mut own: HashMap<Arc<str>, NamedMaterial> =
            read.into_iter().map(|named| (Arc::clone(&named.name.value), named)).collect();
        for_materials(objects, &mut |material| {
            let MaterialRef::Named { name, span } = material else { return };
            let (name, span) = (Arc::clone(name), *span);
            let taken = names.entry(Arc::clone(&name)).or_insert_with(|| match own.remove(&name) {
                Some(named) => MaterialRef::Named { name: self.materials.adopt(file, named), span },
                // That there is none has been told.
                None => MaterialRef::Named { name, span },
            });
            *material = taken.clone();
        });
    }
}

/// The materials of objects, and of what they are made of.
fn for_materials(objects: &mut [Spanned<Object>], change: &mut dyn FnMut(&mut MaterialRef)) {
    for object in objects {
        change(object.value.material_mut());
        if let Some(operands) = object.value.operands_mut() {
            for_materials(&mut operands.0, change);
        }
    }
}

fn of_scene(mut objects: Vec<Spanned<Object>>, lights: Vec<Spanned<Light>>) -> Vec<Spanned<Object>> {
    objects.extend(lights.into_iter().map(group::of_light));
    objects
}
