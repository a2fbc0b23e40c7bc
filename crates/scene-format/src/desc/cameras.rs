//! Cameras by name, and which of them is meant.

use super::Camera;
use crate::diagnostic::{Span, Spanned};
use crate::form::{Entry, Form};
use crate::read::{Reader, are_cameras, expected_for, is_expression};
use crate::schema::{FieldDef, Type};
use crate::tree::{Item, Kind};
use crate::words::Words;
use std::sync::Arc;

/// A camera with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCamera {
    /// The name.
    pub name: Spanned<Arc<str>>,
    /// The camera.
    pub camera: Camera,
}

/// `{ "name": camera }`
impl Words for Vec<NamedCamera> {
    const TYPE: Type = Type::Map(&Camera::TYPE);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        // They stay with the reader, as materials do.
        reader.cameras(item, at).map(|()| Vec::new())
    }

    fn form(&self, all: bool) -> Form {
        Form::Map(self.iter().map(|named| Entry::new(named.name.value.to_string(), named.camera.form(all))).collect())
    }
}

/// What stands at `camera`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum CameraChoice {
    /// Nothing: the only one of the scene's own `cameras`, if it has one.
    Only,
    /// One of `cameras`.
    Named(Spanned<Arc<str>>),
    /// One that is written there.
    Written(Box<Camera>),
}

impl Words for CameraChoice {
    const TYPE: Type = Type::OneOf(&[Type::Text, Camera::TYPE]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        match item.kind() {
            Kind::Text if !is_expression(item) => {
                let name = reader.text(item, at)?;
                Some(CameraChoice::Named(Spanned { value: (*name).into(), span: item.span() }))
            }
            Kind::Word | Kind::List if !item.lexeme().starts_with("[[") => {
                // A name without its quotes.
                let quoted = (item.kind() == Kind::Word && reader.knows_camera(&item.text()))
                    .then(|| format!("\"{}\"", item.text()));
                reader.wrong_kind(item, at.noun, &expected_for(at, item), quoted)
            }
            Kind::List if item.lexeme().starts_with("[[") => Camera::read(reader, item, at).and(None),
            // Told when the whole scene has been read.
            _ if are_cameras(item) => None,
            _ => Camera::read(reader, item, at).map(|camera| CameraChoice::Written(Box::new(camera))),
        }
    }

    fn form(&self, all: bool) -> Form {
        match self {
            CameraChoice::Only => Camera::default().form(all),
            CameraChoice::Named(name) => Form::Text(name.value.to_string()),
            CameraChoice::Written(camera) => camera.form(all),
        }
    }
}

/// The camera of a scene, and the name that it has among its cameras.
pub(crate) struct Chosen {
    pub camera: Camera,
    pub name: Option<Arc<str>>,
}

impl Chosen {
    /// One that is written where it is used.
    pub fn written(camera: Camera) -> Self {
        Chosen { camera, name: None }
    }

    /// Where it was chosen by name, that name; for faults of the camera itself.
    pub fn place(&self) -> Option<&str> {
        self.name.as_deref()
    }
}

impl CameraChoice {
    /// What a scene with this camera writes: the name only where it says the same.
    pub fn of(camera: &Camera, name: Option<&Arc<str>>, cameras: &[NamedCamera]) -> Self {
        let same = |named: &&NamedCamera| Some(&named.name.value) == name && named.camera == *camera;
        match cameras.iter().find(same) {
            Some(named) => CameraChoice::Named(Spanned { value: Arc::clone(&named.name.value), span: Span::NONE }),
            None if cameras.is_empty() && *camera == Camera::default() => CameraChoice::Only,
            None => CameraChoice::Written(Box::new(camera.clone())),
        }
    }
}
