//! The camera in render space, and the pixel's filter.

use glam::DVec3;

/// A thin-lens camera (a pinhole when the lens has no radius).
///
/// A point of the picture plane is `forward + x right + y up` from the eye, with x, y from -1 to 1 times the half
/// extents that are already multiplied into `right` and `up`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Eye.
    pub eye: DVec3,
    /// Unit view direction.
    pub forward: DVec3,
    /// To the right edge of the picture, at distance 1 from the eye.
    pub right: DVec3,
    /// To the upper edge of the picture, at distance 1 from the eye.
    pub up: DVec3,
    /// Radius of the lens, in render units.
    pub lens_radius: f64,
    /// Distance of the plane of focus from the eye along `forward`, in render units.
    pub focus_distance: f64,
    /// The pixel's reconstruction filter.
    pub filter: Filter,
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
