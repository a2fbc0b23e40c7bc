//! Where in its picture a camera shows a point: [`Projection`] the other way round.

use super::{Camera, FisheyeMapping, Projection};
use glam::DVec3;
use std::f64::consts::PI;

/// How an eye sees a point.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The camera, as if it were the only eye.
    pub of_eye: Camera,
    /// The place in that eye's picture; `None` where no place of it shows the point, however wide.
    pub in_half: Option<[f64; 2]>,
    /// The place in the whole picture.
    pub in_whole: Option<[f64; 2]>,
}

impl Camera {
    /// How a point is seen; by the left eye (-1) or the right one (1) where there are two, else `side` does not count.
    /// A lens is taken for its middle.
    pub fn sees(&self, side: f64, point: DVec3) -> Seen {
        let stereo = self.stereo.as_ref();
        let (mut of_eye, mut beside) = (Camera { stereo: None, ..*self }, true);
        if let Some(stereo) = stereo {
            let Camera { eye, forward, right, .. } = *self;
            let across = right.normalize();
            let aside = side * stereo.aside;
            let [x, z] = [across, forward].map(|axis| (point - eye).dot(axis));
            of_eye.eye += match self.projection {
                // The ray touches the circle of the eyes: `across` turned by its longitude.
                Projection::Panorama => {
                    let level = libm::hypot(x, z);
                    beside = level > stereo.aside;
                    let longitude = libm::atan2(x, z) - libm::asin((aside / level.max(1e-300)).clamp(-1.0, 1.0));
                    aside * (libm::cos(longitude) * across - libm::sin(longitude) * forward)
                }
                _ => aside * across,
            };
            if let Projection::Perspective { shift, .. } = &mut of_eye.projection {
                shift[0] -= side * stereo.inwards;
            }
        }
        let in_half = place(&of_eye, point).filter(|_| beside);
        let in_whole = in_half.map(|place| stereo.map_or(place, |stereo| stereo.in_whole(side, place)));
        Seen { of_eye, in_half, in_whole }
    }
}

/// The place in the picture that shows a point, from -1 to 1 to the right and upwards; the lens' middle is the eye.
fn place(camera: &Camera, point: DVec3) -> Option<[f64; 2]> {
    let Camera { forward, right, up, .. } = *camera;
    let away = point - camera.eye;
    let along = away.dot(forward);
    let [x, y] = [right, up].map(|axis| away.dot(axis) / axis.length_squared());
    match camera.projection {
        Projection::Perspective { shift, .. } => (along > 0.0).then(|| [x / along - shift[0], y / along - shift[1]]),
        Projection::Orthographic => (along > 0.0).then_some([x, y]),
        Projection::Panorama => {
            let level = libm::sqrt(x * x + along * along);
            (away != DVec3::ZERO).then(|| [libm::atan2(x, along) / PI, libm::atan2(y, level) * 2.0 / PI])
        }
        Projection::Fisheye { mapping, scale } => {
            let across = away - along * forward;
            let angle = libm::atan2(across.length(), along);
            let r = match mapping {
                FisheyeMapping::Equidistant => angle,
                FisheyeMapping::Equisolid => libm::sin(angle / 2.0),
                FisheyeMapping::Stereographic => libm::tan(angle / 2.0),
                // Behind the eye the sine would come back.
                FisheyeMapping::Orthographic if along < 0.0 => f64::INFINITY,
                FisheyeMapping::Orthographic => libm::sin(angle),
            } / scale;
            let towards = across.try_normalize().unwrap_or(DVec3::ZERO) * r;
            (r < 1.0).then(|| [right, up].map(|axis| towards.dot(axis) / axis.length_squared()))
        }
    }
}
