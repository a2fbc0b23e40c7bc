//! Copies of an object.

use super::PlacementPattern;
use crate::codes;
use crate::desc::{Transform, TransformWords};
use crate::diagnostic::{Diagnostic, Spanned};
use crate::form::Form;
use crate::read::{Reader, is_expression, make_room};
use crate::schema::{FieldDef, Type};
use crate::tree::{Item, Kind};
use crate::words::Words;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where an object is. Eight bytes long, as a scene may have millions of objects that are in one place.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Placements {
    /// One copy, where `transform` puts it.
    #[default]
    One,
    /// As many as these say.
    Many(Box<Copies>),
}

/// Copies of one object.
#[derive(Clone, Debug, PartialEq)]
pub enum Copies {
    /// Each with its own transforms (about the origin of the scene unless they say `about`).
    List(Box<PlacementList>),
    /// A text file of placements, one a line, relative to the scene file.
    File(Box<Spanned<Arc<Path>>>),
    /// By a rule.
    Pattern(Box<Spanned<PlacementPattern>>),
    /// Those of an object in a group: its own, and the group's of them.
    Within(Within),
}

/// Copies of an object that stands in groups: for each copy of a group one of each copy within.
#[derive(Clone, Debug, PartialEq)]
pub struct Within {
    /// The object's own.
    pub own: Placements,
    /// The groups that it stands in.
    pub groups: Arc<Groups>,
}

/// The groups that an object stands in.
#[derive(Clone, Debug, PartialEq)]
pub struct Groups {
    /// Those within `group`.
    pub inner: Option<Arc<Groups>>,
    /// The outermost.
    pub group: Arc<Moved>,
}

/// Where a group puts what is in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Transforms, applied first to last, about the origin unless they say `about`.
    pub transform: Vec<Spanned<Transform>>,
    /// Copies, after `transform`.
    pub placements: Placements,
}

impl Moved {
    /// The first of its steps that asks how far reaches what stands in the group, in its placements, too.
    pub fn asks_for_reach(&self) -> Option<&Spanned<Transform>> {
        match self.placements.copies() {
            Some(Copies::List(list)) => asks(&self.transform).or_else(|| list.iter().find_map(asks)),
            _ => asks(&self.transform),
        }
    }
}

fn asks(steps: &[Spanned<Transform>]) -> Option<&Spanned<Transform>> {
    steps.iter().find(|step| step.value.asks_for_reach())
}

impl Groups {
    /// The groups from the innermost to the outermost.
    pub fn outwards(&self) -> Vec<&Moved> {
        let mut groups = self.inner.as_ref().map_or_else(Vec::new, |inner| inner.outwards());
        groups.push(&self.group);
        groups
    }
}

impl Placements {
    /// Its copies, where it is not just one.
    pub fn copies(&self) -> Option<&Copies> {
        match self {
            Placements::One => None,
            Placements::Many(copies) => Some(copies),
        }
    }

    /// Its groups, where it stands in some, and what it is in the innermost.
    pub fn within(&self) -> Option<&Within> {
        match self.copies()? {
            Copies::Within(within) => Some(within),
            _ => None,
        }
    }

    /// How many copies they make, as far as the scene says it: a file counts as one.
    pub fn known_copies(&self) -> u64 {
        match self.copies() {
            None | Some(Copies::File(_)) => 1,
            Some(Copies::List(list)) => list.iter().len() as u64,
            Some(Copies::Pattern(pattern)) => pattern.value.count(),
            Some(Copies::Within(within)) => {
                let groups = within.groups.outwards();
                let copies = groups.iter().map(|group| group.placements.known_copies());
                copies.fold(within.own.known_copies(), u64::saturating_mul)
            }
        }
    }

    /// The placements files that they name.
    pub fn files(&self) -> Vec<&Spanned<Arc<Path>>> {
        match self.copies() {
            Some(Copies::File(file)) => vec![file],
            Some(Copies::Within(within)) => {
                let groups = within.groups.outwards();
                within.own.files().into_iter().chain(groups.iter().flat_map(|group| group.placements.files())).collect()
            }
            None | Some(Copies::List(_) | Copies::Pattern(_)) => Vec::new(),
        }
    }
}

impl From<Copies> for Placements {
    fn from(copies: Copies) -> Self {
        Placements::Many(Box::new(copies))
    }
}

impl From<PlacementList> for Placements {
    fn from(list: PlacementList) -> Self {
        Copies::List(Box::new(list)).into()
    }
}

/// Of a placements file.
impl From<Spanned<Arc<Path>>> for Placements {
    fn from(file: Spanned<Arc<Path>>) -> Self {
        Copies::File(Box::new(file)).into()
    }
}

/// Of a placements file.
impl From<PathBuf> for Placements {
    fn from(file: PathBuf) -> Self {
        Placements::from(Spanned::<Arc<Path>>::from(file))
    }
}

impl From<Spanned<PlacementPattern>> for Placements {
    fn from(pattern: Spanned<PlacementPattern>) -> Self {
        Copies::Pattern(Box::new(pattern)).into()
    }
}

impl From<Within> for Placements {
    fn from(within: Within) -> Self {
        Copies::Within(within).into()
    }
}

/// Copies, each with its own transforms.
impl FromIterator<Vec<Spanned<Transform>>> for Placements {
    fn from_iter<I: IntoIterator<Item = Vec<Spanned<Transform>>>>(placements: I) -> Self {
        placements.into_iter().collect::<PlacementList>().into()
    }
}

/// Placements that a scene writes out. The steps of all of them stand in one list: a scene may have millions.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct PlacementList {
    steps: Vec<Spanned<Transform>>,
    /// Where the steps of each placement end.
    ends: Vec<u32>,
}

impl PlacementList {
    /// Adds a step to the last placement, which [`PlacementList::end`] ends.
    pub fn push(&mut self, step: Spanned<Transform>) {
        self.steps.push(step);
    }

    /// Ends a placement.
    pub fn end(&mut self) {
        self.ends.push(self.steps.len() as u32);
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The placements, each with its steps from first to last.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[Spanned<Transform>]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let steps = &self.steps[start..end as usize];
            start = end as usize;
            steps
        })
    }
}

impl FromIterator<Vec<Spanned<Transform>>> for PlacementList {
    fn from_iter<I: IntoIterator<Item = Vec<Spanned<Transform>>>>(placements: I) -> Self {
        let mut list = PlacementList::default();
        for steps in placements {
            list.steps.extend(steps);
            list.end();
        }
        list
    }
}

/// The text in `File("..")` or `{ File = ".." }`: the name of a file needs no word around it.
fn wrapped_text(item: Item<'_, '_>) -> Option<String> {
    let mut inside = match item.kind() {
        Kind::Map if item.lexeme().starts_with('{') => item.fields().map(|(_, value)| value).collect::<Vec<_>>(),
        Kind::Tuple => item.children().collect(),
        _ => Vec::new(),
    };
    let only = inside.pop().filter(|only| only.kind() == Kind::Text && inside.is_empty())?;
    Some(only.lexeme().to_owned())
}

/// Whether a pattern seems to be meant: a kind in brackets that is no single transform.
fn names_a_pattern(item: Item<'_, '_>) -> bool {
    let name = match item.kind() {
        Kind::Struct | Kind::Tuple => item.name().map(str::to_owned),
        Kind::Map => item.fields().next().map(|(key, _)| key.text().into_owned()),
        _ => None,
    };
    name.is_some_and(|name| TransformWords::DEF.variant(&name).is_none()) && wrapped_text(item).is_none()
}

impl Words for Placements {
    const TYPE: Type = Type::OneOf(&[Type::List(&Type::List(&Transform::TYPE)), Type::File, PlacementPattern::TYPE]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        match item.kind() {
            Kind::Text if is_expression(item) => {
                let way = "a Repeat makes copies by a list in `vars`, a step from each item: [Repeat(count: \
                           \"=len(p)\", items: [[Translate(\"=p[i]\")]])]";
                let message = "placements cannot be an expression: they are lists of transforms";
                let fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message);
                reader.report(fault.expected("[[a transform, ..], ..]").hint(way));
                None
            }
            Kind::Text => <Spanned<Arc<Path>>>::read(reader, item, at).map(Placements::from),
            Kind::List => {
                if reader.pattern_in_brackets(item, at) || reader.placements_elsewhere(item, at) {
                    return None;
                }
                let mut list = PlacementList::default();
                let errors = reader.errors();
                reader.items(item, at, |reader, placement| {
                    if reader.placement_elsewhere(placement) {
                        return;
                    }
                    let steps = reader.items(placement, at, |reader, step| {
                        let value = <Spanned<Transform>>::read(reader, step, at);
                        make_room(&mut list.steps, item, step);
                        list.steps.extend(value);
                    });
                    if steps.is_some() {
                        make_room(&mut list.ends, item, placement);
                        list.end();
                    }
                });
                // A list with something in it that comes to nothing is not what no list is.
                if list.is_empty() && item.children().next().is_some() {
                    if reader.errors() == errors {
                        let message = "the placements come to none: an object stands once at least";
                        let hint =
                            "a Repeat around the object leaves it out: Repeat(count: \"=min(n, 1)\", items: [..])";
                        let fault = Diagnostic::error(codes::OUT_OF_RANGE, item.head(), message);
                        reader.report(fault.expected("one or more; [] is one, where `transform` puts it").hint(hint));
                    }
                    return None;
                }
                Some(if list.is_empty() { Placements::One } else { list.into() })
            }
            // It stands in a list, also where it is all of it.
            Kind::Struct if item.name() == Some("Repeat") => {
                let edit = Some(format!("[{}]", item.lexeme()));
                reader.wrong_kind(item, at.noun, "a list: [Repeat(count: .., items: [[a transform, ..]])]", edit)
            }
            _ if names_a_pattern(item) => {
                let pattern = <Spanned<PlacementPattern>>::read(reader, item, at)?;
                reader.takes_copies(item, pattern.value.count()).then(|| pattern.into())
            }
            _ => {
                let expected =
                    "a list of lists of transforms, a pattern, or the name of a placements file between quotes";
                reader.wrong_kind(item, at.noun, expected, wrapped_text(item))
            }
        }
    }

    fn form(&self, all: bool) -> Form {
        match self.copies() {
            None => Form::List(Vec::new()),
            Some(Copies::List(list)) => {
                let placement = |steps: &[Spanned<Transform>]| Form::list(steps.iter().map(|step| step.form(all)));
                Form::list(list.iter().map(placement))
            }
            Some(Copies::File(file)) => file.form(all),
            Some(Copies::Pattern(pattern)) => pattern.form(all),
            // The groups are written around the object.
            Some(Copies::Within(within)) => within.own.form(all),
        }
    }
}
