//! Where render space lies in the person's world.

use glam::DVec3;

/// Render space: `render = (world - centre) * scale`, scale a power of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The point of the world that is the origin.
    pub centre: DVec3,
    /// Render units per world unit; a power of two, so that scaling loses nothing.
    pub scale: f64,
}

/// What lies this much farther from the origin than from the eye is seen in steps of 2^-24 times this, a quarter of a
/// thousandth of its distance.
const COARSE: f64 = 4096.0;

impl Frame {
    /// Chooses the frame. `marks` is one point per object, on its surface, near what the camera looks at; their median
    /// is the origin (a single far or huge object does not move it), and the largest distance of a mark or the eye from
    /// it is about one. Where a mark would be seen too coarsely so, the eye is the origin, and the distance to
    /// `look_at` about one.
    /// `beside`: marks of what says nothing of where the scene is, planes and lamps, but is to be fine, too.
    pub fn choose(eye: DVec3, look_at: DVec3, marks: &[DVec3], beside: &[DVec3]) -> Self {
        let median = |axis: usize| {
            let mut values: Vec<f64> = marks.iter().map(|m| m[axis]).collect();
            values.sort_unstable_by(f64::total_cmp);
            values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(eye[axis])
        };
        let middle = DVec3::new(median(0), median(1), median(2));
        // How much farther from a centre than from the eye something lies: what is small there is seen so much too
        // coarsely. Seen from afar a scene is fine about its middle; where most of it is far and some of it near, as
        // stars about a ship, only the eye will do.
        let looks = (look_at - eye).length();
        let coarse = |mark: &DVec3| (*mark - middle).length() > COARSE * (*mark - eye).length().max(1e-3 * looks);
        let near_some = looks > 0.0 && marks.iter().chain(beside).any(coarse);
        let centre = if near_some { eye } else { middle };
        let mut distances: Vec<f64> = marks.iter().map(|m| (*m - centre).length()).collect();
        distances.sort_unstable_by(f64::total_cmp);
        // Nine tenths of the marks, so that one far object does not shrink the rest to nothing.
        let typical = distances.get(distances.len().saturating_sub(1) * 9 / 10).copied().unwrap_or(0.0);
        let size = if near_some { looks } else { typical.max((eye - centre).length()) };
        // Within f32's exponent range whatever the person wrote.
        let exponent = if size > 0.0 && size.is_finite() { (libm::ilogb(size) + 1).clamp(-500, 500) } else { 0 };
        Frame { centre, scale: libm::scalbn(1.0, -exponent) }
    }

    /// A point of the world in render space.
    pub fn point(&self, p: DVec3) -> DVec3 {
        (p - self.centre) * self.scale
    }

    /// A length of the world in render space.
    pub fn length(&self, x: f64) -> f64 {
        x * self.scale
    }
}
