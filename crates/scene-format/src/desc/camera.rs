//! The camera: where it stands, and how it maps what it sees to the picture.

use super::matrix::Rows;
use super::{Stereo, StereoLayout, Vec3};
use crate::diagnostic::{Span, Spanned};
use crate::form::Form;
use crate::plane::cross;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_enum, scene_struct, scene_words};

scene_struct! {
    /// A camera: a pinhole, unless `effects` give it a lens or `projection` makes it another. Pixels are square: of one
    /// whose fx and fy differ, stretch the picture afterwards.
    pub(crate) struct CameraWords as "Camera", "the camera" {
        /// Eye point.
        position: Spanned<Vec3> = [0.0, 0.0, 5.0] => Rule::point();
        /// A point in the middle of the picture.
        look_at: Spanned<Vec3> = [0.0, 0.0, 0.0] => Rule::point();
        /// The direction that is up in the picture.
        up: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// Instead of `position`, `look_at` and `up`, as other programs say it: three rows of four numbers, whose
        /// columns are the directions to the right, upwards and backwards in the picture, and the eye point, as in glTF
        /// and Blender. It turns and moves, nothing else.
        matrix: Option<Spanned<Rows>> = None => Rule::within("three rows", -1e12, 1e12);
        /// Field of view in degrees: the picture's height, unless `fov_axis` says otherwise.
        fov: Spanned<f64> = 40.0 => Rule::between("an angle", 0.0, 180.0).unit("in degrees");
        /// Side of the picture that `fov` is measured along.
        fov_axis: FovAxis = FovAxis::Vertical;
        /// Instead of `fov`, as photographers say it: the focal length of a lens before film that is `sensor_width`
        /// wide. 50 is normal for film of 36 mm, 24 wide, 85 a portrait. The picture's width sees 2 atan(sensor_width /
        /// 2 focal_length). How sharp it is, `effects` say.
        focal_length: Option<Spanned<f64>> = None => Rule::length("a length").unit("in millimetres");
        /// Width of the film for `focal_length`.
        sensor_width: Spanned<f64> = 36.0 => Rule::length("a length").unit("in millimetres");
        /// Moves the film, as a view camera does: what is seen moves by so many picture heights to the right and up,
        /// and upright walls stay parallel where `up` lies in the film. (0, 0.5) shows the upper half twice as high up.
        shift: Spanned<[f64; 2]> = [0.0, 0.0] => Rule::within("two numbers", -1e3, 1e3).unit("in picture heights");
        /// What is nearer than this along the view is not seen by the camera: a wall between it and the room, say. It
        /// still shades and shows in mirrors.
        near: Option<Spanned<f64>> = None => Rule::length("a length");
        /// Motion blur: the shutter is open from the frame's `time` on, for this share of a frame. What is an
        /// expression of `time` moves meanwhile; each sample sees the scene at a moment of its own. 0.5 is what films
        /// have. 0: nothing moves while a picture is taken.
        shutter: Spanned<f64> = 0.0 => Rule::within("a number", 0.0, 1.0).unit("of a frame");
        /// How directions become places in the picture.
        projection: Projection = Projection::Perspective;
        /// Two pictures in one, for two eyes; with `Perspective` and `Panorama`.
        stereo: Option<Stereo> = None;
    }
}

scene_words! {
    /// The side of the picture that the field of view is measured along.
    pub enum FovAxis, "axis of a field of view" {
        /// The height.
        Vertical,
        /// The width.
        Horizontal,
        /// From corner to corner.
        Diagonal,
        /// The shorter side.
        Smaller,
        /// The longer side.
        Larger,
    }
}

scene_enum! {
    /// How directions become places in the picture.
    pub enum Projection, "projection" {
        /// As the eye and lenses see: what is far is small, and straight lines are straight.
        Perspective;
        /// Parallel rays from the plane of `position`: nothing becomes smaller with distance, as in plans and figures.
        /// What lies behind that plane is not seen.
        Orthographic as "an orthographic projection" {
            /// What the picture's height shows.
            height: Spanned<f64> => Rule::length("a length");
        };
        /// All directions around the camera: 360 degrees across, 180 from top to bottom, the view in the middle, as
        /// `Environment` is laid out.
        Panorama;
        /// A fisheye lens: a round picture in the middle of the frame, as large as its shorter side. Around it there
        /// is nothing: black, and no part of `alpha`.
        Fisheye as "a fisheye projection" {
            /// The whole angle that the circle shows; 360 is all there is.
            fov: Spanned<f64> = 180.0 => Rule::within("an angle", 1e-3, 360.0).unit("in degrees");
            /// From the angle to the view direction to the distance from the middle.
            mapping: FisheyeMapping = FisheyeMapping::Equidistant;
        };
    }
}

scene_words! {
    /// From the angle t to the view direction to the distance from the middle of a fisheye's picture.
    pub enum FisheyeMapping, "mapping of a fisheye" {
        /// In proportion to t: the usual one, angles can be read off with a ruler.
        Equidistant,
        /// sin(t / 2): equal areas are equal solid angles.
        Equisolid,
        /// tan(t / 2): small things keep their shapes. Less than 360 degrees.
        Stereographic,
        /// sin(t): the hemisphere as seen from far away; weighs the sky as a level plane receives it. 180 degrees at
        /// most.
        Orthographic,
    }
}

/// A camera: a pinhole, unless `effects` give it a lens or `projection` makes it another.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Eye point.
    pub position: Spanned<Vec3>,
    /// A point in the middle of the picture.
    pub look_at: Spanned<Vec3>,
    /// The direction that is up in the picture.
    pub up: Spanned<Vec3>,
    /// Rows of the matrix that says the three above, if one was written. Who changes them need not change it: it counts
    /// only as long as it says the same.
    pub matrix: Option<Box<[[f64; 4]; 3]>>,
    /// Field of view in degrees: the picture's height, unless `fov_axis` says otherwise.
    pub fov: Spanned<f64>,
    /// Side of the picture that `fov` is measured along.
    pub fov_axis: FovAxis,
    /// Instead of `fov`: the focal length of a lens before film that is `sensor_width` wide, in millimetres.
    pub focal_length: Option<Spanned<f64>>,
    /// Width of the film for `focal_length`, in millimetres.
    pub sensor_width: Spanned<f64>,
    /// What is seen moves by so many picture heights to the right and up.
    pub shift: Spanned<[f64; 2]>,
    /// What is nearer than this along the view is not seen by the camera.
    pub near: Option<Spanned<f64>>,
    /// The share of a frame that the shutter is open for.
    pub shutter: Spanned<f64>,
    /// How directions become places in the picture.
    pub projection: Projection,
    /// Two pictures in one.
    pub stereo: Option<Stereo>,
}

impl Words for Camera {
    const TYPE: Type = CameraWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let words = CameraWords::read(reader, item, at)?;
        let mut camera = Camera {
            position: words.position,
            look_at: words.look_at,
            up: words.up,
            matrix: None,
            fov: words.fov,
            fov_axis: words.fov_axis,
            focal_length: words.focal_length,
            sensor_width: words.sensor_width,
            shift: words.shift,
            near: words.near,
            shutter: words.shutter,
            projection: words.projection,
            stereo: words.stereo,
        };
        if let Some(matrix) = words.matrix {
            reader.camera_matrix(&camera, &matrix, item.syntax())?;
            let span = matrix.span;
            camera.stand_by(*matrix.value.0);
            for place in [&mut camera.position, &mut camera.look_at, &mut camera.up] {
                place.span = span;
            }
        }
        Some(camera)
    }

    fn form(&self, all: bool) -> Form {
        let camera = self.clone();
        let matrix = self.matrix.as_ref().filter(|rows| {
            let mut other = Camera::default();
            other.stand_by(***rows);
            (other.position, other.look_at, other.up) == (self.position.clone(), self.look_at.clone(), self.up.clone())
        });
        let mut form = CameraWords {
            position: camera.position,
            look_at: camera.look_at,
            up: camera.up,
            matrix: matrix.map(|rows| Rows(rows.clone()).into()),
            fov: camera.fov,
            fov_axis: camera.fov_axis,
            focal_length: camera.focal_length,
            sensor_width: camera.sensor_width,
            shift: camera.shift,
            near: camera.near,
            shutter: camera.shutter,
            projection: camera.projection,
            stereo: camera.stereo,
        }
        .form(all);
        if let (Form::Struct { fields, .. }, Some(_)) = (&mut form, &self.matrix) {
            let by_matrix = fields.iter().any(|field| field.name == "matrix" && field.value != Form::word("None"));
            fields.retain(|field| !by_matrix || !matches!(&*field.name, "position" | "look_at" | "up"));
        }
        if let Form::Struct { fields, .. } = &mut form {
            // What nothing is said by is not written beside what says it.
            let is_other = self.projection != Projection::Perspective;
            let is_idle = |name: &str| match name {
                "fov" | "fov_axis" => is_other || self.focal_length.is_some(),
                "focal_length" | "sensor_width" => is_other,
                _ => false,
            };
            fields.retain(|field| !is_idle(&field.name));
        }
        form
    }
}

impl Default for Camera {
    fn default() -> Self {
        Camera {
            position: [0.0, 0.0, 5.0].into(),
            look_at: [0.0, 0.0, 0.0].into(),
            up: [0.0, 1.0, 0.0].into(),
            matrix: None,
            fov: 40.0.into(),
            fov_axis: FovAxis::Vertical,
            focal_length: None,
            sensor_width: 36.0.into(),
            shift: [0.0, 0.0].into(),
            near: None,
            shutter: 0.0.into(),
            projection: Projection::Perspective,
            stereo: None,
        }
    }
}

impl Camera {
    /// Stands as these rows say, whose columns are right, up, back and the eye.
    pub fn stand_by(&mut self, rows: [[f64; 4]; 3]) {
        let column = |k: usize| rows.map(|row| row[k]);
        let (up, back, eye) = (column(1), unit(column(2)), column(3));
        // As far as the eye is from the origin: no digit of the direction is lost there.
        let distance = eye.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        self.position = eye.into();
        self.look_at = std::array::from_fn(|axis| eye[axis] - distance * back[axis]).into();
        self.up = up.into();
        self.matrix = Some(Box::new(rows));
    }

    /// The rows of [`Camera::stand_by`] that say where it stands.
    pub fn rows(&self) -> [[f64; 4]; 3] {
        let ([right, up, forward], eye) = (self.axes(), self.position.value);
        std::array::from_fn(|axis| [right[axis], up[axis], 0.0 - forward[axis], eye[axis]])
    }

    /// Unit vectors to the picture's right, up, and into it.
    pub fn axes(&self) -> [Vec3; 3] {
        let (position, look_at) = (self.position.value, self.look_at.value);
        let forward = unit(std::array::from_fn(|axis| look_at[axis] - position[axis]));
        let right = unit(cross(forward, unit(self.up.value)));
        [right, cross(right, forward), forward]
    }

    /// The sides of the picture of one eye, of those of the whole.
    pub fn size_for_one_eye(&self, [width, height]: [f64; 2]) -> [f64; 2] {
        match self.stereo.as_ref().map(|stereo| stereo.layout) {
            None => [width, height],
            Some(StereoLayout::SideBySide) => [width / 2.0, height],
            Some(StereoLayout::TopBottom) => [width, height / 2.0],
        }
    }

    /// Half the height and half the width of what a perspective camera sees at distance one, for a picture with these
    /// sides; of two eyes for that of one.
    pub fn half_extents(&self, [width, height]: [f64; 2]) -> [f64; 2] {
        let aspect = width / height;
        if let Some(focal_length) = &self.focal_length {
            let half_width = self.sensor_width.value / 2.0 / focal_length.value;
            return [half_width / aspect, half_width];
        }
        let half = libm::tan(self.fov.value.to_radians() / 2.0);
        let along_width = match self.fov_axis {
            FovAxis::Vertical => false,
            FovAxis::Horizontal => true,
            FovAxis::Smaller => width < height,
            FovAxis::Larger => width > height,
            FovAxis::Diagonal => {
                let half_height = half / libm::hypot(aspect, 1.0);
                return [half_height, half_height * aspect];
            }
        };
        if along_width { [half / aspect, half] } else { [half, half * width / height] }
    }

    /// Fields that are written, or say something else than their defaults, and nothing beside what others say: each
    /// with its place, and why.
    pub(crate) fn of_no_use(&self) -> Vec<(&'static str, Span, &'static str)> {
        let place = |field: Option<Span>| field.unwrap_or(Span::NONE);
        let default = Camera::default();
        let said = |field: &Spanned<f64>, default: &Spanned<f64>| {
            (field.span != Span::NONE || field.value != default.value).then_some(field.span)
        };
        let fov = said(&self.fov, &default.fov);
        let fov_axis = (self.fov_axis != FovAxis::Vertical).then_some(Span::NONE);
        let focal_length = self.focal_length.as_ref().map(|length| length.span);
        let shift = (self.shift.value != default.shift.value).then_some(self.shift.span);
        let near = self.near.as_ref().map(|near| near.span);
        let stereo = self.stereo.as_ref().map(|stereo| stereo.separation.span);
        let mut fields = Vec::new();
        let mut none_of = |why: &'static str, list: &[(&'static str, Option<Span>)]| {
            let there = list.iter().filter(|(_, span)| span.is_some());
            fields.extend(there.map(|&(name, span)| (name, place(span), why)));
        };
        let width = said(&self.sensor_width, &default.sensor_width);
        match self.projection {
            Projection::Perspective if focal_length.is_some() => {
                none_of("`focal_length` says how wide the view is", &[("fov_axis", fov_axis)]);
            }
            Projection::Perspective => {
                // Its default may be written out.
                let width = width.filter(|_| self.sensor_width.value != default.sensor_width.value);
                none_of("it goes with a `focal_length`", &[("sensor_width", width)]);
            }
            Projection::Orthographic { .. } => {
                let angles =
                    [("fov", fov), ("fov_axis", fov_axis), ("focal_length", focal_length), ("sensor_width", width)];
                none_of("the `height` of the projection says what is seen", &angles);
                none_of("parallel rays show both eyes the same", &[("stereo", stereo)]);
            }
            Projection::Panorama => {
                let angles =
                    [("fov", fov), ("fov_axis", fov_axis), ("focal_length", focal_length), ("sensor_width", width)];
                none_of("a panorama shows all directions", &angles);
                none_of("a panorama has no plane", &[("shift", shift), ("near", near)]);
            }
            Projection::Fisheye { .. } => {
                let angles =
                    [("fov", fov), ("fov_axis", fov_axis), ("focal_length", focal_length), ("sensor_width", width)];
                none_of("the projection has a `fov` of its own", &angles);
                none_of("a fisheye has no plane", &[("shift", shift), ("near", near)]);
                none_of("a fisheye has one eye, `Perspective` and `Panorama` two", &[("stereo", stereo)]);
            }
        }
        fields
    }
}

fn unit(v: Vec3) -> Vec3 {
    let length = libm::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    v.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What says nothing beside the rest is told; defaults that are written out are not.
    #[test]
    fn fields_of_no_use() {
        let told = |camera: Camera| camera.of_no_use().iter().map(|(name, ..)| *name).collect::<Vec<_>>();
        let (panorama, default) = (Projection::Panorama, Camera::default);
        assert!(told(Camera { projection: panorama.clone(), ..default() }).is_empty());
        assert_eq!(
            told(Camera { fov: 30.0.into(), near: Some(1.0.into()), projection: panorama, ..default() }).len(),
            2
        );
        assert_eq!(told(Camera { sensor_width: 24.0.into(), ..default() }), ["sensor_width"]);
        let lens = Camera { sensor_width: 24.0.into(), focal_length: Some(50.0.into()), ..default() };
        assert!(told(lens.clone()).is_empty());
        assert_eq!(told(Camera { fov_axis: FovAxis::Larger, ..lens }), ["fov_axis"]);
    }
}
