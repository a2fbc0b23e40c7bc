//! Two eyes: two pictures in one.

use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum, scene_struct, scene_words};

scene_struct! {
    /// Two pictures in one, for two eyes that stand to the left and right of `position` and look the same way. Each has
    /// half of `image`: for two pictures of 1280x720 side by side it is 2560x720. With `Panorama` they are
    /// omnidirectional: whichever way one looks, the eyes stand beside each other across it.
    pub struct Stereo as "Stereo", "`Stereo`" {
        /// From eye to eye: 0.064 for people, where the scene's unit is the metre.
        separation: Spanned<f64> => Rule::length("a length");
        /// How far away, along the view axis, things are that both eyes see at the same place of their pictures: they
        /// seem to lie in the screen, nearer ones before it. `None`: infinitely far, both look straight ahead.
        convergence: Option<Spanned<f64>> = None => Rule::length("a length");
        /// How the two pictures lie in the one.
        layout: StereoLayout = StereoLayout::SideBySide;
    }
}

scene_words! {
    /// How the pictures of two eyes lie in one.
    pub enum StereoLayout, "layout of a stereo picture" {
        /// The left eye's to the left.
        SideBySide,
        /// The left eye's above the right one's.
        TopBottom,
    }
}

scene_enum! {
    /// One eye, or two.
    pub(crate) enum Stereoscopy, "stereo" {
        /// One picture.
        None;
        /// Two pictures in one.
        Stereo(Stereo);
    }
}

/// In the scene it is a kind (`Stereo(..)` or `None`), as a lens is.
impl Words for Option<Stereo> {
    const TYPE: Type = Stereoscopy::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        Stereoscopy::read(reader, item.without_some(), at).map(|eyes| match eyes {
            Stereoscopy::None => None,
            Stereoscopy::Stereo(stereo) => Some(stereo),
        })
    }

    fn form(&self, all: bool) -> Form {
        match self {
            None => Stereoscopy::None.form(all),
            Some(stereo) => Stereoscopy::Stereo(stereo.clone()).form(all),
        }
    }
}
