//! Cameras over lanes: from a place in the picture to the ray that sees it, and from a point to the place that shows
//! it. A file a projection.
//!
//! A place is x, y from -1 to 1 over the picture, x to the right, y upwards ([`crate::scene::Camera`]); a pixel's
//! filter may reach beyond. Both ways, a camera tells its **measure**: what light paths need to count as much as paths
//! do ([`super::light_paths`]), J being the area of a surface that a pixel's area of film sees:
//!
//! - cameras that see from a point: J = measure distance^2 / cosine at the surface, the measure being the solid angle
//!   of a pixel there, which may depend on the direction;
//! - parallel rays: J = measure / cosine, the measure being the area of a pixel.
//!
//! The part of a perspective camera that goes by the direction alone is left out of its measure ([`View::area`]):
//! stages know the direction, and the measure is one then.

mod fisheye;
mod lens;
mod orthographic;
mod panorama;
mod perspective;
mod stereo;

use super::surface::Surface;
use crate::lanes::{Lanes, Mask};
use crate::math::V3;
use crate::scene::{Camera, Projection};
use stereo::Eyes;

/// The camera, splatted.
pub struct View<F: Lanes> {
    eye: V3<F>,
    forward: V3<F>,
    right: V3<F>,
    up: V3<F>,
    projection: Projection,
    eyes: Option<Eyes<F>>,
    /// Depth at which rays start.
    near: f32,
    /// Half the picture's columns and rows.
    pub middle: [f32; 2],
    /// As many of the picture of one eye, where there are two.
    middle_of_eye: [f32; 2],
    /// |right| |up| over the pixels of a quarter of that: a pixel's area at distance one, or in the plane.
    pixel_area: F,
}

/// What sees a place.
pub struct CameraRay<F: Lanes> {
    /// Where it starts.
    pub origin: V3<F>,
    /// Where it goes, of any length.
    pub direction: V3<F>,
    /// The measure of the place; zero where light paths do not go.
    pub measure: F,
    /// Whether the place shows anything.
    pub seen: F::M,
}

/// Where a point is seen.
pub struct Place<F: Lanes> {
    /// Unit direction from the point to the camera.
    pub wo: V3<F>,
    /// Distance from the point to where the camera sees from.
    pub distance: F,
    /// How far along `wo` nothing may stand before the point.
    pub free: F,
    /// Column and row, in pixels from the picture's corner.
    pub x: F,
    /// See `x`.
    pub y: F,
    /// Cosine of the direction to the view direction.
    pub cos: F,
    /// The measure of the place.
    pub measure: F,
    /// Whether it is seen, if nothing stands before it and it lies in the picture.
    pub seen: F::M,
}

/// How far a vector goes along a side of the picture, that side being one.
#[inline(always)]
fn along<F: Lanes>(v: V3<F>, side: V3<F>) -> F {
    v.dot(side) / side.dot(side)
}

/// A place as a projection tells it.
struct Seen<F: Lanes> {
    x: F,
    y: F,
    measure: F,
    seen: F::M,
}

impl<F: Lanes> View<F> {
    /// The camera of a picture of this size.
    #[inline(always)]
    pub fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let splat = |v: glam::DVec3| V3::<F>::splat(v.as_vec3().to_array());
        let middle = size.map(|side| side as f32 / 2.0);
        let middle_of_eye = match &camera.stereo {
            Some(stereo) => stereo.half(middle.map(f64::from)).map(|side| side as f32),
            None => middle,
        };
        let quarter = f64::from(middle_of_eye[0]) * f64::from(middle_of_eye[1]);
        let area = camera.right.length() * camera.up.length() / quarter;
        View {
            eye: splat(camera.eye),
            forward: splat(camera.forward),
            right: splat(camera.right),
            up: splat(camera.up),
            projection: camera.projection,
            eyes: Eyes::of(camera),
            near: camera.near as f32,
            middle,
            middle_of_eye,
            pixel_area: F::splat(area as f32),
        }
    }

    /// Which eye sees a place ([`crate::scene::Stereo::eye`]); zero where there is one.
    #[inline(always)]
    pub fn eye(&self, x: F, y: F) -> F {
        match &self.eyes {
            Some(eyes) => eyes.eye(x, y),
            None => F::splat(0.0),
        }
    }

    /// The ray of a place for one of the eyes, which the pixel says: its filter may reach into the other's half; `lens`
    /// is a uniform point of the unit square.
    #[inline(always)]
    pub fn ray(&self, eye: F, mut x: F, mut y: F, lens: (F, F)) -> CameraRay<F> {
        let mut place = (x, y);
        if let Some(eyes) = &self.eyes {
            place = eyes.in_half(eye, x, y);
            (x, y) = (eyes.outwards(eye, place.0), place.1);
        }
        let mut ray = match self.projection {
            Projection::Perspective { shift, lens: through } => self.perspective_ray(x, y, shift, through, lens),
            Projection::Orthographic => self.orthographic_ray(x, y),
            Projection::Panorama => self.panorama_ray(x, y),
            Projection::Fisheye { mapping, scale } => self.fisheye_ray(x, y, mapping, scale as f32),
        };
        if let Some(eyes) = &self.eyes {
            ray.origin = ray.origin.add(self.aside(eyes, eye, x));
            ray.measure = eyes.measure(place, ray.measure);
        }
        if self.near > 0.0 {
            let along = F::splat(self.near) / ray.direction.dot(self.forward);
            ray.origin = ray.direction.mad(along, ray.origin);
        }
        ray
    }

    /// Where a point is seen, by one of two eyes at random; `lens` is a uniform point of the unit square.
    #[inline(always)]
    pub fn place(&self, point: V3<F>, mut lens: (F, F)) -> Place<F> {
        let c = F::splat;
        let (mut which, mut middle, mut within_reach) = (c(0.0), self.eye, F::M::from_bits(!0));
        if let Some(eyes) = &self.eyes {
            (which, lens.0) = eyes.choose(lens.0);
            let (aside, reaches) = self.aside_for(eyes, which, point);
            (middle, within_reach) = (self.eye.add(aside), reaches);
        }
        let eye = match self.projection {
            Projection::Orthographic => self.under(point),
            Projection::Perspective { lens: through, .. } => self.lens(middle, through, lens),
            Projection::Panorama | Projection::Fisheye { .. } => middle,
        };
        let to = eye.sub(point);
        let distance = to.dot(to).sqrt();
        let wo = match self.projection {
            Projection::Orthographic => self.forward.neg(),
            _ => to.scale(c(1.0) / distance),
        };
        let direction = wo.neg();
        let cos = direction.dot(self.forward);
        let mut at = match self.projection {
            Projection::Perspective { shift, lens: through } => {
                self.perspective_place(eye.sub(middle), direction, cos, shift, through)
            }
            Projection::Orthographic => self.orthographic_place(point),
            Projection::Panorama => self.panorama_place(direction, cos),
            Projection::Fisheye { mapping, scale } => self.fisheye_place(direction, cos, mapping, scale as f32),
        };
        if let Some(eyes) = &self.eyes {
            at = eyes.in_whole(which, at);
        }
        let (mut free, mut seen) = (distance, at.seen & within_reach);
        if self.near > 0.0 {
            free = distance - c(self.near) / cos;
            seen = seen & c(0.0).lt(free);
        }
        let (x, y) = ((at.x + c(1.0)) * c(self.middle[0]), (c(1.0) - at.y) * c(self.middle[1]));
        Place { wo, distance, free, x, y, cos, measure: at.measure, seen }
    }

    /// J over the measure: the area of a surface, whose cosine to the ray this is, that a pixel sees at a distance.
    #[inline(always)]
    pub fn area(&self, distance: F, cos_to_view: F, cos_at_surface: F) -> F {
        let below = cos_at_surface.max(F::splat(1e-6));
        match self.projection {
            Projection::Perspective { .. } => {
                let seen = self.pixel_area * cos_to_view * cos_to_view * cos_to_view;
                distance * distance * seen / below
            }
            Projection::Orthographic => F::splat(1.0) / below,
            Projection::Panorama | Projection::Fisheye { .. } => distance * distance / below,
        }
    }

    /// [`View::area`] of a camera ray's hit.
    #[inline(always)]
    pub fn area_of(&self, direction: V3<F>, mut distance: F, s: &Surface<F>) -> F {
        let cos = direction.dot(self.forward);
        if self.near > 0.0 {
            distance = distance + F::splat(self.near) / cos;
        }
        self.area(distance, cos, -direction.dot(s.ng))
    }
}

/// The depth that the layer of this name shows of a hit at distance `t` of a camera ray along a unit direction: along
/// the view axis, or of cameras that see all around the distance itself.
#[inline(always)]
pub fn depth<F: Lanes>(camera: &Camera, t: F, direction: V3<F>) -> F {
    match camera.projection {
        Projection::Perspective { .. } | Projection::Orthographic => {
            let forward = V3::<F>::splat(camera.forward.as_vec3().to_array());
            let depth = t * direction.dot(forward);
            if camera.near > 0.0 { depth + F::splat(camera.near as f32) } else { depth }
        }
        Projection::Panorama | Projection::Fisheye { .. } => t,
    }
}

#[cfg(test)]
mod tests;
