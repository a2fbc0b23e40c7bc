//! The lens before the film.

use super::{Camera, Vec3};
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::plane::{dot, sub};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum, scene_struct};

/// A thin lens: the points of one plane are sharp.
#[derive(Clone, Debug, PartialEq)]
pub struct ThinLens {
    /// Diameter of the lens, in the scene's unit.
    pub aperture: Spanned<f64>,
    /// Where the plane of focus is.
    pub focus: Spanned<Focus>,
    /// Corners of the aperture, three or more; 0: it is a disc.
    pub blades: Spanned<u32>,
    /// Degrees by which the aperture is turned, counter-clockwise in the picture.
    pub rotation: Spanned<f64>,
    /// Degrees by which the plane of focus is turned about the picture's right, then about its up.
    pub tilt: Spanned<[f64; 2]>,
}

/// What is sharp.
#[derive(Clone, Debug, PartialEq)]
pub enum Focus {
    /// What lies this far from the eye, along the view axis.
    Distance(f64),
    /// This point.
    On(Vec3),
}

scene_struct! {
    /// A thin lens: a disc-shaped aperture, or one with blades, sharp at the plane of focus. Where that is, is said by
    /// exactly one of `focus_distance` and `focus_on`.
    pub(crate) struct ThinLensWords as "ThinLens", "a thin lens", exactly one of [focus_distance, focus_on] {
        /// Diameter of the lens, in the scene's unit: a point at distance d along the view axis is blurred to a disc
        /// that is aperture * |d - focus_distance| / d across in the plane of focus. A photographer's f-number is
        /// focal length over aperture.
        aperture: Spanned<f64> => Rule::within("a length", 0.0, 1e12).unit("in the scene's unit");
        /// Distance from the eye to the plane of focus, along the view axis.
        focus_distance: Option<Spanned<f64>> = None => Rule::length("a length");
        /// A point that is sharp: the plane of focus goes through it.
        focus_on: Option<Spanned<Vec3>> = None => Rule::point();
        /// Blades of the aperture, three or more: blurred lights become polygons with so many corners, as large as the
        /// disc. 0: discs.
        blades: Spanned<u32> = 0u32 => Rule::within("a whole number (not 1 or 2)", 0.0, 64.0);
        /// Turns the aperture, counter-clockwise as the picture shows it; at 0 it has a corner to the right.
        /// A disc has none.
        rotation: Spanned<f64> = 0.0 => Rule::within("an angle", -1e9, 1e9).unit("in degrees");
        /// Turns the plane of focus about the picture's right, then about its up, as a view camera does: (-80, 0) makes
        /// a table sharp from front to back.
        tilt: Spanned<[f64; 2]> = [0.0, 0.0] => Rule::within("two angles", -89.0, 89.0).unit("in degrees");
    }
}

scene_enum! {
    /// The lens before the film: none, which is a pinhole and sharp everywhere, or a thin one.
    pub(crate) enum DepthOfField, "lens" {
        /// A pinhole: sharp everywhere.
        None;
        /// A thin lens: sharp at the plane of focus.
        ThinLens(ThinLens);
    }
}

impl Words for ThinLens {
    const TYPE: Type = ThinLensWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let words = ThinLensWords::read(reader, item, at)?;
        let focus = match (words.focus_distance, words.focus_on) {
            (Some(by), _) => Spanned { value: Focus::Distance(by.value), span: by.span },
            (_, Some(on)) => Spanned { value: Focus::On(on.value), span: on.span },
            // None was written, or what was written could not be read: reported.
            _ => return None,
        };
        let ThinLensWords { aperture, blades, rotation, tilt, .. } = words;
        Some(ThinLens { aperture, focus, blades, rotation, tilt })
    }

    fn form(&self, all: bool) -> Form {
        let ThinLens { aperture, focus, blades, rotation, tilt } = self.clone();
        let (focus_distance, focus_on) = match focus.value {
            Focus::Distance(by) => (Some(by.into()), None),
            Focus::On(point) => (None, Some(point.into())),
        };
        let mut form = ThinLensWords { aperture, focus_distance, focus_on, blades, rotation, tilt }.form(all);
        // Of the two the one that is not written has no default to show: only one may be there.
        if let Form::Struct { fields, .. } = &mut form {
            fields.retain(|field| !matches!(field.value, Form::Variant { name: "None", .. }));
        }
        form
    }
}

/// In the scene a lens is a kind (`ThinLens(..)` or `None`), so that other lenses can come beside it.
impl Words for Option<ThinLens> {
    const TYPE: Type = DepthOfField::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        DepthOfField::read(reader, item.without_some(), at).map(|lens| match lens {
            DepthOfField::None => None,
            DepthOfField::ThinLens(lens) => Some(lens),
        })
    }

    fn form(&self, all: bool) -> Form {
        match self {
            None => DepthOfField::None.form(all),
            Some(lens) => DepthOfField::ThinLens(lens.clone()).form(all),
        }
    }
}

impl ThinLens {
    /// A round lens of this diameter, whose plane of focus lies at this distance along the view axis.
    pub fn new(aperture: f64, focus_distance: f64) -> Self {
        ThinLens {
            aperture: aperture.into(),
            focus: Focus::Distance(focus_distance).into(),
            blades: 0.into(),
            rotation: 0.0.into(),
            tilt: [0.0; 2].into(),
        }
    }

    /// The plane of focus: how far from the eye it crosses the view axis, not above zero where the point in focus does
    /// not lie before the camera; and, where it is tilted, its normal in the picture's own axes (right, up, forward),
    /// the part along the view being one.
    pub fn plane_of_focus(&self, camera: &Camera) -> (f64, Option<Vec3>) {
        let [about_right, about_up] = self.tilt.value.map(f64::to_radians);
        // The view direction, turned right-handed about right and then up.
        let normal = [-libm::tan(about_up), libm::tan(about_right) / libm::cos(about_up), 1.0];
        let tilted = (self.tilt.value != [0.0; 2]).then_some(normal);
        let distance = match self.focus.value {
            Focus::Distance(distance) => distance,
            Focus::On(point) => {
                let [right, up, forward] = camera.axes();
                let eye = camera.position.value;
                let from_eye = sub(point, eye);
                let along = [right, up, forward].map(|axis| dot(from_eye, axis));
                tilted.map_or(along[2], |normal| dot(along, normal))
            }
        };
        (distance, tilted)
    }
}
