//! Scenes within a scene.

use super::{Name, Placements, Transform};
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::read::{GivenMaterials, GivenVars};
use crate::schema::Rule;
use crate::words::scene_struct;
use std::path::Path;
use std::sync::Arc;

scene_struct! {
    /// The objects and lights of another scene, moved and copied as one. Its names are its own: materials, textures
    /// and `vars` of this scene are not seen there, nor its own here. Its camera, picture, background and how it is
    /// rendered are not taken.
    pub(crate) struct IncludeWords as "Include", "an included scene" {
        /// The scene file, in any syntax. Paths in it start from its own folder.
        file: Spanned<Arc<Path>> => Rule::file(FileKind::Scene);
        /// Other values for its `vars`.
        vars: GivenVars = GivenVars(Vec::new());
        /// Other materials for names of its `materials`: names of this scene, or written here.
        materials: GivenMaterials = GivenMaterials(Vec::new());
        /// Transforms of all of it, applied first to last. Turns and scales without `about` are about the origin;
        /// `DropTo`, `CenterTo` and `FitTo` go by all that stands in it.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies of all of it: each placement is applied after `transform`. Empty: one, where `transform` puts it. A
        /// text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a
        /// rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees what is in it. If not, camera rays pass as if nothing were there; it still throws
        /// shadows, shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.placements=[]` finds it where no other has this name.
        name: Name = Name::default();
    }
}
