//! What is written beside the picture.

use super::{Color, Vec3};
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_struct, scene_words};

scene_struct! {
    /// What is written beside the picture.
    pub struct Output as "Output", "the output" {
        /// Layers that EXR files get beside the picture: what camera rays hit first. The picture is the same with and
        /// without them.
        layers: Vec<Layer> = Vec::new();
        /// Leaves the background out, to lay the picture over another one: PNG and EXR files say how much of each pixel
        /// is covered. It still lights the scene, and shows in mirrors and through glass.
        alpha: bool = false;
        /// A colour to see instead of the background, whatever exposure and tone map do to the rest: `1` is white
        /// paper. The background still lights the scene, and shows in mirrors and through glass.
        backdrop: Option<Spanned<Color>> = None => Rule::share();
        /// Mattes that EXR files get beside the picture, in the form of Cryptomatte: compositing programs cut out any
        /// object or material by its name, with soft edges.
        cryptomatte: Vec<Matte> = Vec::new();
        /// Masks that EXR files get beside the picture: for each of these names the share of every pixel that the
        /// objects and lights of that name cover, as `mask.NAME.Y`.
        masks: Vec<Spanned<MaskName>> = Vec::new();
        /// Tells apart what each group of lights brings: EXR files get `light.GROUP.R`, `.G`, `.B` for every `group`
        /// that lights, shining objects and the background have, and `light.rest.R`, `.G`, `.B` for those that have
        /// none. They sum to the picture. Each sample is traced once for every group.
        light_groups: bool = false;
        /// Points by names: `{ "A": (0, 1, 0) }`. The report (`--report`) tells for each the pixel that shows it, how
        /// far away it is, and whether something hides it: for labels that are laid over the picture.
        marks: Vec<Mark> = Vec::new();
    }
}

scene_words! {
    /// What Cryptomatte tells apart. Pixels hold the six things of it that cover most of them, each with its share of
    /// the samples; what has no name is called by its place in the scene.
    pub enum Matte, "matte" {
        /// Objects and lights by their `name`; those of one name are one.
        Objects,
        /// Materials by their names. Lamps of `lights` have none.
        Materials,
    }
}

/// A point with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The name.
    pub name: Spanned<String>,
    /// The point.
    pub point: Spanned<Vec3>,
}

/// The name of objects or lights that a mask is made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaskName(pub String);

impl Words for MaskName {
    const TYPE: Type = Type::Text;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.text(item, at).map(|text| MaskName(text.into_owned()))
    }

    fn form(&self, _all: bool) -> Form {
        Form::Text(self.0.clone())
    }
}

scene_words! {
    /// A layer of the picture: of what camera rays hit first, averaged over a pixel's samples as the picture is unless
    /// it says otherwise. Not developed: exposure and tone map are the picture's.
    pub enum Layer, "layer" {
        /// The surface's colour as it is without light, from textures too: the albedo, of mirrors the reflectance, of
        /// glass the transmittance. Black where nothing is hit and where lamps are.
        Albedo,
        /// The unit shading normal in the scene's axes, on the viewer's side. Zero where nothing is hit, so that it is
        /// shorter than one at edges.
        Normal,
        /// The distance from the eye along the view axis, as `focus_distance` is measured; of panoramas and fisheyes
        /// that from the eye itself: the mean over the samples that hit something, infinite where none does.
        Depth,
        /// The point that is hit, in the scene's axes and unit: the mean over the samples that hit something, zero
        /// where none does.
        Position,
        /// Texture coordinates before a texture's mapping, u to the right, v upwards: the mean over the samples that
        /// hit something. Zero where none does and on meshes without any.
        Uv,
        /// What the surface itself sends to the viewer, in W/(sr m^2): lamps. Zero elsewhere, also where the background
        /// is seen.
        Emission,
        /// The object at the sample nearest to the pixel's centre: 1 for the first of `objects` and so on, what a
        /// `Repeat` makes one by one; then the lamps of `lights`. 0: nothing is hit.
        ObjectId,
        /// The material at the sample nearest to the pixel's centre: 1 for the first of `materials` and so on, then
        /// those without a name there. 0: nothing is hit, or a lamp of `lights`.
        MaterialId,
        /// Estimated variance of the pixel's mean luminance, in the square of W/(sr m^2), were its samples independent:
        /// how noisy it still is. Zero below two samples.
        Variance,
        /// The share of the pixel's samples that hit something, mirrors and glass included: 0 where the background is
        /// seen, between at edges.
        Alpha,
        /// The standard error of the pixel relative to its own luminance, were its samples independent: 0.1 is ten per
        /// cent. Zero below two samples and where the picture is black.
        Noise,
        /// Rays that a sample's paths are made of, the mean over the samples: one from the camera, one for each surface
        /// that scatters, both ways at glass, aimed ones. Shadow rays are not among them.
        PathLength,
        /// What a sample costs in the tree: nodes of up to eight boxes that its rays ask, shadow rays too, the mean
        /// over the samples. 0 where there is no tree.
        Nodes,
        /// What a sample costs at the tree's leaves: those of up to four triangles or spheres that its rays ask, shadow
        /// rays too, the mean over the samples. 0 where there is no tree.
        Leaves,
        /// Light that has come over one surface at most, in W/(sr m^2): lamps and background as the camera sees them,
        /// and what surfaces scatter of light that meets them straight. With `Indirect` it is the picture.
        Direct,
        /// Light that has come over two surfaces and more, in W/(sr m^2): from wall to wall, through glass onto a
        /// table, a lit room in a mirror.
        Indirect,
        /// Samples that the pixel has: as many as `render.samples` asks for, fewer here and there where the rendering
        /// was ended early.
        Samples,
        /// How far what is seen moves in the picture within a frame, in pixels to the right and downwards, as fast as
        /// it does on average while `camera.shutter` is open: the mean over the samples that hit something. Zero where
        /// none does, and where nothing moves while the shutter is open. `shutter: 0.01` tells it and blurs next to
        /// nothing.
        Motion,
        /// As `Albedo`, of what is seen over mirrors and through glass, times their tints: what guides a denoiser. One
        /// where nothing is hit, and for lamps there.
        DenoisingAlbedo,
        /// As `Normal`, of what is seen over mirrors and through glass, by the share of light that comes from there:
        /// what guides a denoiser.
        DenoisingNormal,
    }
}

// The macro's structs derive no default of their own.
#[allow(clippy::derivable_impls)]
impl Default for Output {
    fn default() -> Self {
        Output {
            layers: Vec::new(),
            alpha: false,
            backdrop: None,
            cryptomatte: Vec::new(),
            masks: Vec::new(),
            light_groups: false,
            marks: Vec::new(),
        }
    }
}
