//! Landscapes from pictures.

use super::Placements;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};
use std::path::Path;
use std::sync::Arc;

scene_struct! {
    /// A landscape: a picture whose pixels are heights. Each pixel is a point, so a picture has two pixels or more
    /// along each side; between four of them are two triangles. Seen from above with -z up it looks as the picture
    /// does: its top row lies at -z, its first column at -x. Texture coordinates: u from 0 to 1 along x, v from 0 to 1
    /// along -z, so that the same picture as a texture lies on its heights.
    pub struct HeightField as "HeightField", "a height field" {
        /// PNG, JPEG, EXR or HDR file, relative to the scene file, of at most 8192 x 8192 pixels. Grey of 16 bits has
        /// the finest steps. Heights are its numbers as they stand, without a curve: 0.5 or 128 is half. Of colours
        /// their luminance is taken. EXR and HDR may go below 0 and above 1.
        file: Spanned<Arc<Path>> => Rule::file(FileKind::Heights);
        /// How far it reaches along x, how high white is over black, and how far it reaches along z.
        size: Spanned<Vec3> => Rule::length("three lengths");
        /// Its middle along x and z; black is as high as this.
        center: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Whether it is shaded as round, but at creases of more than 40 degrees; else every triangle is flat.
        smooth: bool = true;
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about its `center`.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.smooth=false` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for HeightField {
    const ALSO: &'static [&'static str] =
        &["height_field", "heightmap", "height_map", "terrain", "landscape", "elevation", "elevationgrid", "relief"];
    const EXAMPLE: &'static str = "HeightField(file: \"checker.png\", size: (2, 0.5, 2))";
}

impl ShapeWords for HeightField {
    const MANY: &'static str = "height fields";

    fn named_file(&self) -> Option<&Spanned<Arc<Path>>> {
        Some(&self.file)
    }
}

impl Faulty for HeightField {}
