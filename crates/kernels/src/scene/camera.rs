//! The camera in render space, and the pixel's filter.

use glam::DVec3;

/// A camera.
///
/// A place in the picture is x, y from -1 to 1, x to the right and y upwards; what it shows, [`Projection`] says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Eye.
    pub eye: DVec3,
    /// Unit view direction.
    pub forward: DVec3,
    /// To the right, across `forward`: how long, the projection says.
    pub right: DVec3,
    /// Upwards, across both: how long, the projection says.
    pub up: DVec3,
    /// From places in the picture to rays.
    pub projection: Projection,
    /// Two eyes share the picture; all else tells of the middle between them, and of the picture of one of them.
    pub stereo: Option<Stereo>,
    /// Depth, along `forward`, in render units, at which rays start; zero: at the eye.
    pub near: f64,
    /// The pixel's reconstruction filter.
    pub filter: Filter,
}

/// From a place (x, y) in the picture to the ray that sees what is there. Over lanes: `engine/stages/cameras/`, a file
/// a projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Along `forward + x right + y up` from the eye, `right` and `up` being half the picture at distance one.
    Perspective {
        /// Added to x and y.
        shift: [f64; 2],
        /// A pinhole without.
        lens: Option<Lens>,
    },
    /// Along `forward` from `eye + x right + y up`, `right` and `up` being half the picture in render units.
    Orthographic,
    /// All directions: x half a turn to the right of `forward`, y a quarter of a turn upwards; `right` and `up` are
    /// unit vectors.
    Panorama,
    /// In the plane of the picture at `x right + y up`, r long: `forward` turned towards it by an angle that `mapping`
    /// takes from r. `right` and `up` are half the picture's sides over half the shorter one, so that r is one on the
    /// circle in it, beyond which nothing is seen.
    Fisheye {
        /// From r to the angle.
        mapping: FisheyeMapping,
        /// What r is multiplied by to be what the mapping says.
        scale: f64,
    },
}

/// Two eyes that look the same way, each with half of the picture: the left eye has the left half, or the upper one.
/// Those of a panorama stand aside of every direction that they look in: on a circle, whose tangents its rays are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereo {
    /// Half the distance between them, in render units.
    pub aside: f64,
    /// What is added to the left eye's x, and taken from the right one's, in a perspective: in halves of the width of
    /// an eye's picture.
    pub inwards: f64,
    /// The halves lie above each other, and else side by side.
    pub above: bool,
}

impl Stereo {
    /// Whose half of the picture a place lies in: -1 the left eye's, 1 the right one's.
    pub fn eye(&self, [x, y]: [f64; 2]) -> f64 {
        let is_left = if self.above { y > 0.0 } else { x < 0.0 };
        if is_left { -1.0 } else { 1.0 }
    }

    /// A place of the picture as a place in the picture of an eye.
    pub fn in_half(&self, eye: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.above { [x, 2.0 * y + eye] } else { [2.0 * x - eye, y] }
    }

    /// The other way round.
    pub fn in_whole(&self, eye: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.above { [x, 0.5 * (y - eye)] } else { [0.5 * (x + eye), y] }
    }

    /// The sides of the picture of one eye, of those of the whole.
    pub fn half(&self, [width, height]: [f64; 2]) -> [f64; 2] {
        if self.above { [width, height / 2.0] } else { [width / 2.0, height] }
    }
}

/// A thin lens: the rays of one place in the picture meet in the plane of focus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius, in render units: of the disc, or of the corners of the polygon.
    pub radius: f64,
    /// Distance of the plane of focus from the eye along `forward`, in render units.
    pub focus_distance: f64,
    /// Corners of the aperture, a regular polygon; below three it is a disc.
    pub blades: u32,
    /// Where its first corner is, in turns from the right, counter-clockwise as the picture shows it.
    pub rotation: f64,
    /// The normal of the plane of focus, whose part along `forward` is one; `None`: `forward`.
    pub tilted: Option<DVec3>,
}

/// What r is in proportion to, t being the angle to the view direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FisheyeMapping {
    /// t
    Equidistant,
    /// sin(t / 2)
    Equisolid,
    /// tan(t / 2)
    Stereographic,
    /// sin(t)
    Orthographic,
}

/// The pixel's reconstruction filter: samples are placed by its density, so each has weight one (filter importance
/// sampling: Ernst, Stamminger, Greiner 2006).
#[derive(Clone, Debug, Copy, PartialEq)]
pub enum Filter {
    /// Every sample through the pixel's centre.
    Centre,
    /// Uniform over the pixel's square.
    Box,
    /// Normal with this standard deviation in pixels (Box and Muller 1958); not cut off.
    Gaussian(f64),
    /// The 4-term Blackman-Harris window of this half width in pixels, per axis by inversion.
    BlackmanHarris(f64),
}

impl Filter {
    /// How far from its centre, along either axis, a pixel's filter counts for light paths, in pixels. What it has
    /// beyond is left to paths: a light path should not fall onto more than a few pixels.
    pub fn reach(self) -> f32 {
        let reach = match self {
            Filter::Centre => 0.0,
            Filter::Box => 0.5,
            Filter::Gaussian(sigma) => (3.0 * sigma) as f32,
            // Where the window ends it is nearly zero, and its inverse far from exact.
            Filter::BlackmanHarris(radius) => (0.95 * radius) as f32,
        };
        reach.min(MOST_REACH)
    }
}

/// Light paths fall onto five pixels a side at most.
const MOST_REACH: f32 = 2.0;
