//! Groups: objects and lights that are moved and copied as one.
//!
//! A description knows no groups: what stands in one is read as plain objects that remember where their groups put them
//! ([`Within`]), so that nobody after the reader has to walk a tree, and a mesh in a group of a thousand
//! copies is a mesh with a thousand copies. Lights of a group are spheres that shine to both sides, which is the same.

use super::{
    Amount, Copies, Emissive, Groups, IncludeWords, Light, Material, MaterialRef, Moved, Name, Object, Placements,
    Sphere, Transform, Within,
};
use crate::codes;
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::form::{Entry, Form};
use crate::read::{Chosen, Reader, make_room};
use crate::schema::{EnumDef, FieldDef, Rule, Type, VariantDef};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_struct};
use std::sync::Arc;

/// Groups within each other, at most.
pub(crate) const MOST_NESTED: usize = 16;

scene_struct! {
    /// Objects and lights that are moved and copied as one. What stands in it may be a group again, sixteen deep.
    pub(crate) struct GroupWords as "Group", "a group" {
        /// What is in it.
        objects: Objects = Objects(Vec::new());
        /// The material of those objects in it that have none of their own.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms of all of it, applied first to last, after those of the objects in it. Turns and scales without
        /// `about` are about the origin; `DropTo`, `CenterTo` and `FitTo` go by all that stands in it.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies of all of it: each placement is applied after `transform`. Empty: one, where `transform` puts it. A
        /// text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a
        /// rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Lights that move with it. Each copy has one, as bright as it is written.
        lights: Vec<Spanned<Light>> = Vec::new();
        /// Whether the camera sees what is in it. If not, camera rays pass as if nothing were there; it still throws
        /// shadows, shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.placements=[]` finds it where no other has this name.
        name: Name = Name::default();
    }
}

/// Kinds that are objects themselves.
const PLAIN: usize = Object::DEF.variants.len();

/// What may stand among objects: kinds of objects, and groups of them.
pub(crate) static ITEMS: EnumDef =
    EnumDef { name: Object::DEF.name, noun: Object::DEF.noun, doc: Object::DEF.doc, variants: &VARIANTS };

static VARIANTS: [VariantDef; PLAIN + 2] = {
    let mut all = [VariantDef::of_struct(GroupWords::TYPE); PLAIN + 2];
    all[PLAIN + 1] = VariantDef::of_struct(IncludeWords::TYPE);
    let mut k = 0;
    while k < PLAIN {
        all[k] = Object::DEF.variants[k];
        k += 1;
    }
    all
};

/// A list of objects, what stands in groups among them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Objects(pub Vec<Spanned<Object>>);

impl Words for Objects {
    const TYPE: Type = Type::List(&Type::Later(|| Type::Enum(&ITEMS)));

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let few = if item.kind() == Kind::List { item.children().take(64).count() } else { 0 };
        let mut list = Vec::with_capacity(few);
        reader.items(item, at, |reader, child| {
            let Some(chosen) = reader.variant(child, &ITEMS) else { return };
            match chosen.variant.name {
                "Group" => list.extend(group(reader, &chosen, child.head()).unwrap_or_default()),
                "Include" => {
                    let words: Option<IncludeWords> = reader.content(&chosen);
                    list.extend(words.and_then(|words| reader.include(child, words)).unwrap_or_default());
                }
                _ => {
                    if let Some(value) = Object::of_chosen(reader, &chosen) {
                        make_room(&mut list, item, child);
                        list.push(Spanned { value, span: child.span() });
                    }
                }
            }
        })?;
        Some(Objects(list))
    }

    fn form(&self, all: bool) -> Form {
        Form::list(entries(&self.0).map(|entry| form_of_entry(entry, all)))
    }
}

/// The entries of a list that these objects are written as: what stands in the same group is written in one, all else
/// by itself.
pub(crate) fn entries(objects: &[Spanned<Object>]) -> impl Iterator<Item = &[Spanned<Object>]> + Clone {
    objects.chunk_by(|one, other| is_in_one_group(groups_of(one), groups_of(other)))
}

/// One of [`entries`].
pub(crate) fn form_of_entry(objects: &[Spanned<Object>], all: bool) -> Form {
    let objects: Vec<_> = objects.iter().map(|object| (object, groups_of(object))).collect();
    // An entry is one form.
    forms(&objects, all).pop().unwrap_or(Form::Absent)
}

fn groups_of(object: &Spanned<Object>) -> Option<&Groups> {
    object.value.placements().within().map(|within| &*within.groups)
}

/// Whether the outermost group is the same.
fn is_in_one_group(one: Option<&Groups>, other: Option<&Groups>) -> bool {
    one.zip(other).is_some_and(|(one, other)| Arc::ptr_eq(&one.group, &other.group))
}

/// Objects, each with the groups that are to be written around it: from outside, so that a group stays one group,
/// whatever groups are in it.
fn forms(objects: &[(&Spanned<Object>, Option<&Groups>)], all: bool) -> Vec<Form> {
    let entries = objects.chunk_by(|(_, one), (_, other)| is_in_one_group(*one, *other));
    let form = |entry: &[(&Spanned<Object>, Option<&Groups>)]| match entry {
        [(_, Some(outer)), ..] => {
            let within: Vec<_> =
                entry.iter().map(|&(object, of)| (object, of.and_then(|of| of.inner.as_deref()))).collect();
            grouped(forms(&within, all), &outer.group, all)
        }
        [(object, None), ..] => object.value.form(all),
        [] => Form::Absent,
    };
    entries.map(form).collect()
}

/// The words of a group with these objects.
fn grouped(objects: Vec<Form>, group: &Moved, all: bool) -> Form {
    let mut fields = vec![Entry::new("objects", Form::list(objects))];
    if all || !group.transform.is_empty() {
        fields.push(Entry::new("transform", group.transform.form(all)));
    }
    if all || group.placements != Placements::One {
        fields.push(Entry::new("placements", group.placements.form(all)));
    }
    let content = Form::Struct { name: GroupWords::DEF.name, fields };
    Form::Variant { name: GroupWords::DEF.name, content: Some(Box::new(content)) }
}

/// Reads a group: the objects in it.
fn group(reader: &mut Reader<'_>, chosen: &Chosen<'_, '_>, at: Span) -> Option<Vec<Spanned<Object>>> {
    if reader.groups >= MOST_NESTED {
        let message = format!("groups stand more than {MOST_NESTED} deep");
        reader.report(Diagnostic::error(codes::TOO_MUCH, at, message).expected("fewer"));
        return None;
    }
    reader.groups += 1;
    let words: Option<GroupWords> = reader.content(chosen);
    reader.groups -= 1;
    let words = words?;
    let mut objects = words.objects.0;
    objects.extend(words.lights.into_iter().map(of_light));
    if words.material != MaterialRef::Default {
        for object in &mut objects {
            let material = object.value.material_mut();
            if let MaterialRef::Default = material {
                *material = words.material.clone();
            }
        }
    }
    hide(words.camera_visible, &mut objects);
    if moved(reader, words.transform, words.placements, &mut objects) { Some(objects) } else { None }
}

/// Hides objects from the camera that stand in what it does not see.
pub(crate) fn hide(camera_visible: bool, objects: &mut [Spanned<Object>]) {
    if !camera_visible {
        objects.iter_mut().for_each(|object| *object.value.camera_visible_mut() = false);
    }
}

/// The diagnostic of a step of a group that needs to know how far it reaches, in which something has no end.
pub fn endless_group(step: &Spanned<Transform>) -> Diagnostic {
    let message = match step.value {
        Transform::FitTo { .. } => "a group with a plane in it has no extent that could be fitted",
        Transform::CenterTo { .. } => "a group with a plane in it has no middle that could be centred",
        _ => "a group with a plane in it has no lowest point",
    };
    Diagnostic::error(codes::GROUP_DROP, step.span, message)
        .expected("Translate, Scale, Rotate, Matrix or Align")
        .hint("take the plane out of the group")
}

/// Puts objects where a group with this transform and these placements puts them. `false`: it cannot, which is
/// reported.
pub(crate) fn moved(
    reader: &mut Reader<'_>,
    transform: Vec<Spanned<Transform>>,
    placements: Placements,
    objects: &mut [Spanned<Object>],
) -> bool {
    if transform.is_empty() && placements == Placements::One {
        return true;
    }
    let group = Arc::new(Moved { transform, placements });
    if let Some(step) = group.asks_for_reach()
        && objects.iter().any(|object| object.value.is_endless())
    {
        reader.report(endless_group(step));
        return false;
    }
    // Neighbours that stand in the same inner groups share what is made for them.
    let mut last: Option<Arc<Groups>> = None;
    for object in objects {
        let placements = object.value.placements_mut();
        let (own, inner) = match std::mem::take(placements) {
            Placements::Many(copies) => match *copies {
                Copies::Within(within) => (within.own, Some(within.groups)),
                own => (own.into(), None),
            },
            Placements::One => (Placements::One, None),
        };
        let same = last.as_ref().filter(|last| match (&last.inner, &inner) {
            (None, None) => true,
            (Some(last), Some(inner)) => Arc::ptr_eq(last, inner),
            _ => false,
        });
        let groups = match same {
            Some(groups) => Arc::clone(groups),
            None => Arc::new(Groups { inner, group: Arc::clone(&group) }),
        };
        last = Some(Arc::clone(&groups));
        *placements = Within { own, groups }.into();
    }
    true
}

/// A light of a group: the sphere that shines as it does.
pub(crate) fn of_light(light: Spanned<Light>) -> Spanned<Object> {
    let span = light.span;
    let Light::SphereLight(light) = light.value;
    // What it gives outwards; the material's power is that of both sides.
    let amount = match light.amount.value {
        Amount::Power(_) | Amount::LuminousPower(_) => light.amount.value.scaled(2.0),
        other => other,
    };
    let emissive = Emissive {
        amount: Spanned { value: amount, span: light.amount.span },
        color: light.color.into(),
        two_sided: true,
        group: light.group,
    };
    let material = Spanned { value: Material::Emissive(Box::new(emissive)), span };
    let sphere = Sphere {
        center: light.center,
        radius: light.radius,
        material: MaterialRef::Inline(Box::new(material)),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: light.camera_visible,
        name: light.name,
    };
    Spanned { value: Object::from(sphere), span }
}
