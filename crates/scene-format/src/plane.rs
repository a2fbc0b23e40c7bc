//! The planes of faces in space.

/// A point, or a direction.
pub type Vec3 = [f64; 3];

/// Right, up and normal of a face, and its first corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Right, up, and the way that it faces, of unit length.
    pub axes: [Vec3; 3],
    /// Its first corner.
    pub origin: Vec3,
}

/// a . b.
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x b.
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a - b.
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn unit(a: Vec3) -> Option<Vec3> {
    let most = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if most == 0.0 {
        return None;
    }
    let a = a.map(|x| x / most);
    let length = dot(a, a).sqrt();
    Some(a.map(|x| x / length))
}

impl Frame {
    /// By Newell's normal (Sutherland, Sproull, Schumacker 1974); `None` where the corners have none.
    pub fn of(corners: &[Vec3]) -> Option<Frame> {
        let origin = *corners.first()?;
        let mut normal = [0.0; 3];
        for pair in corners.windows(2) {
            let part = cross(sub(pair[0], origin), sub(pair[1], origin));
            normal = [0, 1, 2].map(|k| normal[k] + part[k]);
        }
        // Less is rounding.
        let size = corners.iter().map(|&p| dot(sub(p, origin), sub(p, origin))).fold(0.0, f64::max);
        if dot(normal, normal).sqrt() <= 1e-12 * size {
            return None;
        }
        let normal = unit(normal)?;
        let right = if normal[1].abs() > 0.9999 { [1.0, 0.0, 0.0] } else { unit(cross([0.0, 1.0, 0.0], normal))? };
        // Where the normal is nearly upright x is not quite across it.
        let up = unit(cross(normal, right))?;
        Some(Frame { axes: [cross(up, normal), up, normal], origin })
    }

    /// A point in it: to the right, upwards, and off its plane.
    pub fn place(&self, point: Vec3) -> Vec3 {
        self.axes.map(|axis| dot(axis, sub(point, self.origin)))
    }
}
