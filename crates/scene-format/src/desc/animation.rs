//! Frames and time.

use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_struct};

scene_struct! {
    /// A film of this scene, frame by frame. In expressions `frame` is the frame's number, from 0, and `time` its
    /// seconds from the start. Each frame is a picture of its own; `shutter` of the camera blurs what moves in it.
    pub struct Animation as "Animation", "the animation" {
        /// How many frames there are.
        frames: Spanned<u32> = 1 => Rule::within("a whole number", 1.0, 1e6);
        /// Frames in a second: `time` is `frame / fps`.
        fps: Spanned<f64> = 24.0 => Rule::within("a number", 1e-3, 1e6).unit("per second");
        /// The frame that is seen unless the command line names others (`--frame 12`, `--frames 0-47`).
        frame: Spanned<u32> = 0 => Rule::within("a whole number", 0.0, 999_999.0);
    }
}

impl Default for Animation {
    fn default() -> Self {
        Animation { frames: 1.into(), fps: 24.0.into(), frame: 0.into() }
    }
}

impl Animation {
    /// Seconds from the start to the frame that is seen.
    pub fn time(&self) -> f64 {
        self.time_at(0.0)
    }

    /// Seconds from the start to a moment so large a share of a frame later.
    pub fn time_at(&self, share: f64) -> f64 {
        (f64::from(self.frame.value) + share) / self.fps.value
    }
}

/// The field of the scene: what it says, the reader knows before.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Film(pub Animation);

impl Words for Film {
    const TYPE: Type = Animation::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.animation(item, at).map(Film)
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}
