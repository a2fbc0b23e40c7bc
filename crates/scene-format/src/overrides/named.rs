//! Objects and lights by their names: `--set objects.lamp.radius=2`.

use super::{Edited, Setter, Step, What, value};
use crate::codes;
use crate::desc::{ITEMS, Light};
use crate::diagnostic::Diagnostic;
use crate::read::{repeat_body, shortened};
use crate::schema::{Content, EnumDef, Type};
use crate::suggest;
use crate::tree::{Item, Kind};

/// So many places of one name are shown, and so many names.
const SHOWN: usize = 8;

/// An item that has a name.
struct Named<'t, 's> {
    name: String,
    item: Item<'t, 's>,
    /// An object or, in a group, a light.
    def: &'static EnumDef,
    /// `objects[2]`, or `objects[2].objects[0]` in a group.
    place: String,
    /// Whether it stands in a `Repeat`, which makes many of it.
    repeated: bool,
}

/// The items with names in one of the scene's lists, and in the groups within it.
fn named_in<'t, 's>(root: Item<'t, 's>, list: &str, def: &'static EnumDef) -> Vec<Named<'t, 's>> {
    let mut named = Vec::new();
    for (_, items) in root.fields().filter(|(key, _)| key.text() == list) {
        collect(items, def, list, false, &mut named);
    }
    named
}

/// Whether items of this type have names.
pub(super) fn have_names(kind: Type) -> Option<&'static EnumDef> {
    let Type::Enum(def) = kind.resolved() else { return None };
    let named = |content: &Content| matches!(content, Content::Struct(fields) if fields.field("name").is_some());
    def.variants.iter().any(|variant| named(&variant.content)).then_some(def)
}

/// The kind of an item, and what holds its fields.
fn kind_and_fields<'t, 's>(item: Item<'t, 's>) -> Option<(String, Item<'t, 's>)> {
    match item.kind() {
        Kind::Struct | Kind::Tuple => Some((item.name()?.to_owned(), item)),
        Kind::Map => item.fields().next().map(|(key, value)| (key.text().into_owned(), value)),
        _ => None,
    }
}

/// All items with names in a list and in the groups and repetitions within it.
fn collect<'t, 's>(
    list: Item<'t, 's>,
    def: &'static EnumDef,
    place: &str,
    repeated: bool,
    found: &mut Vec<Named<'t, 's>>,
) {
    if list.kind() != Kind::List {
        return;
    }
    for (index, item) in list.children().enumerate() {
        let place = format!("{place}[{index}]");
        if let Some(body) = repeat_body(item) {
            for (_, items) in body.fields().filter(|(key, _)| key.text() == "items") {
                collect(items, def, &format!("{place}.items"), true, found);
            }
            continue;
        }
        let Some((kind, fields)) = kind_and_fields(item) else { continue };
        let Some(Content::Struct(words)) = def.variant(&kind).map(|variant| &variant.content) else { continue };
        for (key, value) in fields.fields() {
            let key = key.text();
            if key == "name" && value.without_some().kind() == Kind::Text {
                let (name, place) = (value.without_some().text().into_owned(), place.clone());
                found.push(Named { name, item, def, place, repeated });
            }
            let within = words.field(&key).map(|field| field.kind);
            if let Some(Type::List(inner)) = within
                && let Some(def) = have_names(*inner)
            {
                collect(value, def, &format!("{place}.{key}"), repeated, found);
            }
        }
    }
}

impl Setter {
    /// A number of a vector: `position.x`, `position[0]`.
    pub(super) fn find_part(
        &self,
        item: Item<'_, '_>,
        step: &Step<'_>,
        rest: &[Step<'_>],
        noun: &str,
    ) -> Result<Option<Edited>, Diagnostic> {
        let number = match step.what {
            What::Index(index) => Some(index),
            What::Name(name) => ["x", "y", "z"].iter().position(|axis| *axis == name),
        };
        let bare = matches!(item.kind(), Kind::Tuple | Kind::List) && item.name().is_none();
        let part = number.filter(|_| bare && rest.is_empty()).and_then(|number| item.children().nth(number));
        match part {
            Some(part) => Ok(Some(Edited::Replace(part.index()))),
            None if bare && rest.is_empty() => Err(self
                .fault(codes::BAD_SET_PATH, step, format!("{} has no such part", crate::read::plain(noun)))
                .expected("`x`, `y`, `z`, or a number from 0 in brackets")),
            None => Err(self.no_parts(item, step, noun)),
        }
    }

    /// Goes on from the light of a group, where `lights.NAME` is none of the scene's own `lights`; `None`: it is for
    /// nobody here.
    pub(super) fn find_light_in_group(
        &self,
        root: Item<'_, '_>,
        steps: &[Step<'_>],
    ) -> Option<Result<Option<Edited>, Diagnostic>> {
        let [Step { what: What::Name("lights"), .. }, Step { what: What::Name(name), .. }, rest @ ..] = steps else {
            return None;
        };
        if named_in(root, "lights", &Light::DEF).iter().any(|light| light.name == *name) {
            return None;
        }
        let mut lights = named_in(root, "objects", &ITEMS);
        lights.retain(|one| one.def.noun == Light::DEF.noun && one.name == *name && !one.repeated);
        let [light] = lights.as_slice() else { return None };
        Some(self.find(light.item, Type::Enum(light.def), rest, &format!("the light \"{name}\"")))
    }

    /// Goes on from the item of a list that has this name.
    pub(super) fn find_named(
        &self,
        list: Item<'_, '_>,
        def: &'static EnumDef,
        name: &str,
        noun: &str,
        step: &Step<'_>,
        rest: &[Step<'_>],
    ) -> Result<Option<Edited>, Diagnostic> {
        let mut named = Vec::new();
        let group = noun.trim_start_matches("the ").split(' ').next().unwrap_or(noun);
        collect(list, def, group, false, &mut named);
        let (these, others): (Vec<_>, Vec<_>) = named.into_iter().partition(|one| one.name == name);
        match these.as_slice() {
            [only] if !only.repeated => {
                self.find(only.item, Type::Enum(only.def), rest, &format!("the {} \"{name}\"", only.def.noun))
            }
            [] => {
                let message = format!("no {} has the name \"{}\"", def.noun, shortened(name));
                let mut names: Vec<&str> = others.iter().map(|other| other.name.as_str()).collect();
                names.sort_unstable();
                names.dedup();
                let fault = self.fault(codes::BAD_SET_PATH, step, message);
                let mut fault = match names.len() {
                    0 => fault
                        .expected("the number of an item in brackets, counted from 0: [0]")
                        .hint(format!("names are given in the scene: `name: \"{}\"`", shortened(name))),
                    1..=SHOWN => fault.expected(format!("one of {}", suggest::list(&names))),
                    count => fault.expected(format!("one of the {count} names in `{group}`, or a number in brackets")),
                };
                let near = suggest::nearest(name, names.iter().copied()).map(value::step);
                fault.did_you_mean(near.as_deref(), str::to_owned);
                if name.bytes().all(|byte| byte.is_ascii_digit()) {
                    // jq and JavaScript say it so.
                    fault.hint = format!("an item of a list is named by its number in brackets: `{group}[{name}]`");
                }
                Err(fault)
            }
            [only] => {
                let message = format!("the {} \"{}\" stands in a `Repeat`", def.noun, shortened(name));
                Err(self.fault(codes::BAD_SET_PATH, step, message).expected("an item that stands for itself").hint(
                    format!(
                        "{} makes many of it: give what differs a name in `vars`, and set that: --set vars.height=2",
                        only.place.split(".items").next().unwrap_or(&only.place)
                    ),
                ))
            }
            several => {
                let count = several.len();
                let places: Vec<&str> = several.iter().take(SHOWN).map(|one| one.place.as_str()).collect();
                let more = if count > SHOWN { format!(" and {} more", count - SHOWN) } else { String::new() };
                let message = format!("{count} {}s have the name \"{}\"", def.noun, shortened(name));
                Err(self
                    .fault(codes::BAD_SET_PATH, step, message)
                    .expected("a name that only one has, or a number")
                    .hint(format!("they are {}{more}", suggest::join(&places, "and"))))
            }
        }
    }
}
