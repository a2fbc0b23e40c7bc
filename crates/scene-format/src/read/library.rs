//! What files bring to a scene by `include`: values, textures, materials and cameras by their names, and settings that
//! the scene says nothing else of.
//!
//! All `vars` are known before anything is read that may use them, so that those that win do so in the files, too.

use super::check::ROOT;
use super::include::Taken;
use super::unknown::Others;
use super::{Fields, Reader, Step, shortened};
use crate::codes;
use crate::desc::Scene;
use crate::diagnostic::{Diagnostic, Span};
use crate::files::joined;
use crate::schema::FieldDef;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind, NOWHERE, Root};
use crate::words::Words;
use std::collections::BTreeMap;

/// Groups that are taken field by field, and the background: of each what the scene says wins, then what the later file
/// does.
pub(crate) const SETTINGS: &[&str] = &["image", "render", "effects", "output", "background"];

/// What the files that are included bring beside names.
#[derive(Debug, Default)]
pub(super) struct Libraries {
    /// Settings, and where they stand on the tape; of one that is there twice the later one wins.
    settings: Vec<(&'static str, u32)>,
    /// Per list of files, by its place on the tape, those in it that can be read: their places, and their names.
    readable: BTreeMap<u32, Vec<(u32, String)>>,
    /// The fields of the group that is read next are looked for in these places, too.
    beneath: Option<(&'static str, Vec<u32>)>,
    /// Where the `vars` of the scene stand that is being read.
    vars: u32,
    /// By their numbers among the sources where files are included, the innermost place first.
    ways: BTreeMap<u32, Vec<(Span, String)>>,
}

impl Libraries {
    /// Adds where the file that a fault is in is included.
    pub(super) fn labelled(&self, fault: Diagnostic) -> Diagnostic {
        let way = if fault.span == Span::NONE { None } else { self.ways.get(&fault.span.source) };
        let label =
            |fault: Diagnostic, (from, name): &(Span, String)| fault.label(*from, format!("{name} is included here"));
        way.into_iter().flatten().fold(fault, label)
    }

    /// Whether any settings are there.
    pub(super) fn have_settings(&self) -> bool {
        !self.settings.is_empty()
    }
}

impl Reader<'_> {
    /// Notes where the `vars` of a scene stand whose fields have been found, and leaves out what is not taken of it.
    pub(super) fn begin_scene(&mut self, fields: &mut Fields<'_, '_>) {
        if fields.def.name != Scene::DEF.name {
            return;
        }
        let slot = fields.def.fields.iter().position(|field| field.name == "vars");
        self.libraries.vars = slot.map_or(NOWHERE, |slot| fields.slots[slot]);
        self.leave_out_untaken(fields);
    }

    /// The value of a field of the scene, where it says nothing what a file that it includes says.
    pub(super) fn with_settings<'t, 's>(
        &mut self,
        fields: &Fields<'t, 's>,
        at: &'static FieldDef,
        own: Option<Item<'t, 's>>,
    ) -> Option<Item<'t, 's>> {
        if fields.def.name != Scene::DEF.name || !self.open.is_empty() {
            return own;
        }
        self.libraries.beneath = None;
        let given = self.libraries.settings.iter().rev().filter(|(name, _)| *name == at.name);
        let mut given = given.map(|(_, place)| *place).collect::<Vec<u32>>().into_iter();
        let item = own.or_else(|| fields.of.other(given.next()?));
        self.libraries.beneath = at.kind.group().map(|def| (def.name, given.collect()));
        item
    }

    /// The files of a list, of which the list itself has been told to be one.
    pub(super) fn libraries(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<()> {
        match self.open.last().map(|open| open.taken) {
            Some(Taken::Vars) => self.vars_of_libraries(item, at),
            Some(Taken::Names) => {
                self.names_of_libraries(item);
                Some(())
            }
            None | Some(Taken::Scene) => {
                let own = self.libraries.vars;
                let read = self.vars_of_libraries(item, at);
                if let Some(vars) = item.other(own).filter(|vars| vars.kind() == Kind::Map) {
                    let step = std::mem::replace(&mut self.path, vec![Step::Field("vars")]);
                    self.vars_before(vars);
                    self.path = step;
                }
                self.names_of_libraries(item);
                read
            }
        }
    }

    /// Takes the `vars` of the files of a list, and finds their settings.
    fn vars_of_libraries(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<()> {
        let mut readable = Vec::new();
        let read = self.items(item, at, |reader, name| {
            let Some(text) = reader.text(name, at) else { return };
            let Some((file, root)) = reader.open(name, &text) else { return };
            if reader.begin_library(name, file, root) {
                readable.push((name.index() as u32, text.into()));
            }
        });
        self.libraries.readable.insert(item.index() as u32, readable);
        if read.is_none() {
            self.names_may_be_missing();
        }
        read
    }

    /// Takes the `vars` of a file, if nothing but what is taken is in it.
    fn begin_library(&mut self, name: Item<'_, '_>, file: &Root, root: Item<'_, '_>) -> bool {
        let objects = root
            .fields()
            .find(|(key, value)| matches!(&*key.text(), "objects" | "lights") && value.children().next().is_some());
        // Of itself there is nothing to take, by `Include` neither.
        let is_itself = || name.other(0).is_some_and(|scene| scene.lexeme() == root.lexeme());
        if objects.is_some() && self.open.is_empty() && is_itself() {
            let fault = Diagnostic::error(codes::CIRCLE, name.span(), format!("{} includes itself", file.name));
            self.report(fault.expected("files that do not need themselves").hint(
                "leave it out of `include`: what several scenes share stands in a file of its own, without `objects`",
            ));
            return false;
        }
        if let Some((key, _)) = objects {
            let message = format!("an included file has `{}`, which are not taken", key.text());
            let hint = format!("for its objects write Include(file: {}) among the objects", shortened(name.lexeme()));
            let fault = Diagnostic::error(codes::INCLUDE, name.span(), message)
                .expected("a file with `vars`, `textures`, `materials`, `cameras` and settings")
                .hint(match name.syntax() {
                    Syntax::Ron => hint,
                    syntax => syntax
                        .of_toml(format!(
                            "for its objects write {{ Include = {{ file = {} }} }} among the objects",
                            shortened(name.lexeme())
                        ))
                        .into_owned(),
                })
                .label(key.span(), "they are here");
            self.names_may_be_missing();
            self.report(fault);
            return false;
        }
        self.within(name, file, Taken::Vars, |reader| {
            if super::check::newer_version(root, reader.sink) {
                return false;
            }
            let way = reader.open.iter().rev().map(super::include::Open::from).collect();
            reader.libraries.ways.insert(root.span().source, way);
            reader.not_of_libraries(root);
            Scene::read(reader, root, &ROOT);
            // Those of an included scene are its own, and not taken.
            if reader.open.iter().all(|open| open.taken == Taken::Vars) {
                let settings = root.fields().filter_map(|(key, value)| {
                    let name = SETTINGS.iter().find(|name| key.text() == **name)?;
                    (value.kind() != Kind::Broken).then(|| (*name, value.index() as u32))
                });
                reader.libraries.settings.extend(settings);
            }
            true
        })
    }

    /// Reports what a library has that is the scene's own to say.
    fn not_of_libraries(&mut self, root: Item<'_, '_>) {
        let toml = |words: &str| root.syntax().of_toml(words.to_owned()).into_owned();
        for (key, _) in root.fields().take(super::LOOK_AT) {
            let hint = match (&*key.text(), root.syntax()) {
                ("camera", Syntax::Ron) => {
                    "give it a name, `cameras: { \"front\": Camera(..) }`, and choose it in the scene: \
                     `camera: \"front\"`"
                        .to_owned()
                }
                ("camera", _) => toml(
                    "give it a name, cameras = { front = { position = [0, 1, 5] } }, and choose it in the scene: \
                     camera = \"front\"",
                ),
                ("animation", _) => "write it in the scene itself".to_owned(),
                _ => continue,
            };
            let message = format!("an included file has `{}`, which is not taken", key.text());
            let fault = Diagnostic::error(codes::INCLUDE, key.span(), message)
                .expected("`vars`, `textures`, `materials`, `cameras` and settings");
            self.report(fault.hint(hint));
        }
    }

    /// Takes what has a name in the files of a list.
    fn names_of_libraries(&mut self, item: Item<'_, '_>) {
        let readable = self.libraries.readable.get(&(item.index() as u32)).cloned().unwrap_or_default();
        for (place, text) in readable {
            let Some(name) = item.other(place) else { continue };
            let Some(file) = name.included(&joined(name.folder(), &text)) else { continue };
            let Some(root) = name.other(file.root) else { continue };
            self.within(name, file, Taken::Names, |reader| Scene::read(reader, root, &ROOT));
        }
    }

    /// Looks for fields that a group has not in the same group of files that are included.
    pub(super) fn fields_beneath<'t, 's>(
        &mut self,
        own: Item<'t, 's>,
        fields: &mut Fields<'t, 's>,
        others: &mut Others<'t, 's>,
    ) {
        let def = fields.def;
        let places =
            self.libraries.beneath.take_if(|(name, _)| *name == def.name).map_or(Vec::new(), |(_, places)| places);
        for item in places.into_iter().filter_map(|place| own.other(place)) {
            match item.kind() {
                Kind::Struct | Kind::Map => {}
                Kind::Tuple if item.children().next().is_none() => continue,
                _ => {
                    let _: Option<()> = self.not_a_struct(item, def);
                }
            }
            for (key, value) in item.fields() {
                match def.fields.iter().position(|field| field.name == key.text()) {
                    None => self.other_field(key, value, item, def, others),
                    Some(slot) if fields.get(slot).is_none() => fields.set(slot, value),
                    Some(_) => {}
                }
            }
        }
    }
}
