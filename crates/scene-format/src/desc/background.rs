//! What is seen where no object is: the background, which is light, too.

use super::{Color, LightGroup, Vec3, is_color};
use crate::codes;
use crate::diagnostic::{Diagnostic, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::read::{Reader, describe};
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_enum, scene_struct};
use std::path::Path;
use std::sync::Arc;

/// Radiance of everything that no object covers.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// The same in all directions, in W/(sr m^2).
    Color(Color),
    /// From a picture of all directions.
    Environment(Box<Environment>),
}

impl Background {
    /// Whether it is no light at all.
    pub fn is_black(&self) -> bool {
        *self == Background::default()
    }

    /// So many times as bright.
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |color: Color| color.map(|x| factor * x);
        match self {
            Background::Color(color) => Background::Color(scaled(*color)),
            Background::Environment(environment) => {
                let scale = scaled(environment.scale);
                Background::Environment(Box::new(Environment { scale, ..(**environment).clone() }))
            }
        }
    }

    /// The picture of all directions, where there is one.
    pub fn environment(&self) -> Option<&Environment> {
        match self {
            Background::Color(_) => None,
            Background::Environment(environment) => Some(environment),
        }
    }
}

impl Default for Background {
    fn default() -> Self {
        Background::Color([0.0; 3])
    }
}

impl From<Color> for Background {
    fn from(color: Color) -> Self {
        Background::Color(color)
    }
}

scene_struct! {
    /// Light from all directions as a picture has it: 360 degrees across, 180 down. Its middle lies where a camera
    /// looks by default, to -z, what is right of there to +x, and its top row at `up`. It is linear between the middles
    /// of its texels, so that a sun of one texel is two wide, and at the poles as in its first and last row.
    pub struct Environment as "Environment", "an environment" {
        /// HDR, EXR, PNG or JPEG, relative to the scene file; twice as wide as it is high.
        file: Spanned<Arc<Path>> => Rule::file(FileKind::Environment);
        /// Radiance where the picture has 1: one number, or three of red, green and blue.
        scale: Color = [1.0; 3] => Rule::light("in W/(sr m^2)");
        /// Turns it about `up`, counter-clockwise seen from there.
        rotation: f64 = 0.0 => Rule::within("an angle", -1e9, 1e9).unit("in degrees");
        /// Direction of the top row.
        up: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// Whether the camera sees it; what it lights, and mirrors and glass show it in any case.
        camera_visible: bool = true;
        /// The group of lights that it is of: with `output.light_groups`, what each group brings to the picture is told
        /// apart. Several may have one.
        group: LightGroup = LightGroup::default();
    }
}

scene_enum! {
    /// Light from where no object is.
    pub(crate) enum BackgroundWords, "background" {
        /// From a picture of all directions.
        Environment(Box<Environment>);
    }
}

/// Warns of three whole numbers up to 255 that are a colour in bytes, and of 255 alone. Other greys may be meant so,
/// and so may what is dark.
fn warn_of_bytes(reader: &mut Reader<'_>, item: Item<'_, '_>, color: Color) {
    let bytes = color.iter().all(|channel| channel.fract() == 0.0 && (0.0..=255.0).contains(channel));
    let bright = color.iter().any(|channel| *channel > 100.0);
    let grey = color[0] != 255.0 && color.iter().all(|channel| *channel == color[0]);
    if !bytes || !bright || grey || !matches!(item.kind(), Kind::Tuple | Kind::List | Kind::Integer) {
        return;
    }
    let hex: String = color.iter().map(|channel| format!("{:02x}", *channel as u8)).collect();
    reader.report(
        Diagnostic::warning(
            codes::OTHER_SCALE,
            item.head(),
            "the background is hundreds of times as bright as white; it looks like a colour in bytes",
        )
        .expected("radiance: 1 is white")
        .hint(format!("write \"#{hex}\"")),
    );
}

impl Words for Background {
    const TYPE: Type = Type::OneOf(&[Type::Color, BackgroundWords::TYPE]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if let Some(mended) = reader.constant_by_name(item).filter(|_| item.kind() == Kind::Word) {
            return reader.wrong_kind(item, at.noun, "a colour, or a picture: Environment(file: ..)", Some(mended));
        }
        if item.name().is_some_and(|name| name.starts_with(char::is_lowercase) && is_color(name)) {
            return Color::read(reader, item, at).map(Background::Color);
        }
        if matches!(item.kind(), Kind::Struct | Kind::Map) || item.name().is_some() || item.kind() == Kind::Word {
            let BackgroundWords::Environment(environment) = BackgroundWords::read(reader, item, at)?;
            return Some(Background::Environment(environment));
        }
        // As it is without its quotes.
        if item.kind() == Kind::Text && matches!(&*item.text().to_ascii_lowercase(), "transparent" | "none" | "clear") {
            let message = format!("{} cannot be {}", at.noun, describe(item));
            let fault = Diagnostic::error(codes::WRONG_TYPE, item.span(), message);
            reader.report(fault.expected("a colour, or a picture: Environment(file: ..)").hint(
                "leave `background` out: then it is black; what is to be laid over other pictures has `output: \
                 Output(alpha: true)`",
            ));
            return None;
        }
        let color = Color::read(reader, item, at)?;
        warn_of_bytes(reader, item, color);
        Some(Background::Color(color))
    }

    fn form(&self, all: bool) -> Form {
        match self {
            Background::Color(color) => color.form(all),
            Background::Environment(environment) => BackgroundWords::Environment(environment.clone()).form(all),
        }
    }
}
