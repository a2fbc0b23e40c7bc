//! Light from all directions as a picture has it, and where most of it comes from.

use glam::DVec3;

/// A picture of all directions (latitude by longitude), in render space, whose directions are the world's.
///
/// With right, up and front as axes, direction d lies in column (1/2 + atan2(d.right, d.front) / 2 pi) width and row
/// acos(d.up) / pi height, row 0 at the top. Radiance lies linearly between the middles of the four nearest texels,
/// round the picture's left and right border, and goes on as it is beyond the middles of the top and the bottom row.
pub struct Environment {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Unit vectors: right, up, and front, where the picture's middle lies.
    pub axes: [DVec3; 3],
    /// Whether the camera sees it.
    pub camera_visible: bool,
    /// Radiance of all texels, three numbers each, in `Scene::radiance_unit`.
    pub texels: Vec<f32>,
    /// Where it is sampled.
    pub density: Density,
}

/// Density of directions, the same in all of the solid angle of each of columns x rows equal cells of the picture: as
/// the light in and beside it.
pub struct Density {
    pub columns: u32,
    pub rows: u32,
    /// The chance of all rows above each row; one at last.
    pub of_rows: Vec<f32>,
    /// The cosine of the angle from `up` where each row begins; -1 at last.
    pub heights: Vec<f32>,
    /// In each row, the chance of all cells left of each cell; one at last.
    pub of_columns: Vec<f32>,
}

/// More cells than this along a side tell little more of where light comes from, and take longer to be looked for.
const MOST_CELLS: [u32; 2] = [1024, 512];

impl Environment {
    /// Of texels in `Scene::radiance_unit`, row by row, row 0 at `up`. `rotation` turns it about `up`, in degrees,
    /// counter-clockwise seen from there.
    pub fn new(
        [width, height]: [u32; 2],
        texels: &[[f32; 3]],
        up: DVec3,
        rotation: f64,
        camera_visible: bool,
    ) -> Environment {
        let density = Density::new([width, height], texels);
        let texels = texels.as_flattened().to_vec();
        Environment { width, height, axes: axes(up, rotation), camera_visible, texels, density }
    }

    /// Radiance of a texel, in `Scene::radiance_unit`, row 0 at the top; `None` beyond the borders.
    pub fn texel(&self, column: u32, row: u32) -> Option<[f32; 3]> {
        if column >= self.width || row >= self.height {
            return None;
        }
        let first = 3 * (row as usize * self.width as usize + column as usize);
        Some([self.texels[first], self.texels[first + 1], self.texels[first + 2]])
    }
}

/// Right, up and front: +x, +y and -z, brought to `up` by the least turn, and turned about it.
fn axes(up: DVec3, degrees: f64) -> [DVec3; 3] {
    let up = up.normalize_or(DVec3::Y);
    // The least turn from +y: v + (a x v) + a x (a x v) / (1 + cos) with a = y x up; half a turn about z where `up` is
    // -y.
    let a = DVec3::Y.cross(up);
    let turned = |v: DVec3| {
        if up.y <= -1.0 + 1e-12 {
            DVec3::new(-v.x, -v.y, v.z)
        } else {
            v + a.cross(v) + a.cross(a.cross(v)) / (1.0 + up.y)
        }
    };
    let (right, front) = (turned(DVec3::X), turned(DVec3::NEG_Z));
    let (sin, cos) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        degrees => (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())),
    };
    [right * cos + front * sin, up, front * cos - right * sin]
}

impl Density {
    fn new([width, height]: [u32; 2], texels: &[[f32; 3]]) -> Density {
        let [columns, rows] = [width.min(MOST_CELLS[0]), height.min(MOST_CELLS[1])];
        let luminance = |column: usize, row: usize| {
            texels[row * width as usize + column].iter().map(|&x| f64::from(x)).sum::<f64>()
        };
        // Texels that begin before a cell ends, and one more at each side: what lies between texels reaches there.
        let touched = |k: u32, of: u32, size: u32| {
            let (k, of, size) = (u64::from(k), u64::from(of), u64::from(size));
            (k * size / of) as i64 - 1..=(((k + 1) * size).div_ceil(of)) as i64
        };
        let cosine = |j: u32| libm::cos(std::f64::consts::PI * f64::from(j) / f64::from(rows)) as f32;
        let heights: Vec<f32> = (0..=rows).map(cosine).collect();
        let mut of_rows = vec![0.0; rows as usize + 1];
        let mut of_columns = vec![0.0f32; rows as usize * (columns as usize + 1)];
        let mut sums = Vec::with_capacity(columns as usize);
        let mut total = 0.0;
        let mut above = vec![0.0];
        for (j, own) in (0..rows).zip(of_columns.chunks_exact_mut(columns as usize + 1)) {
            sums.clear();
            let mut sum = 0.0;
            for i in 0..columns {
                let (mut light, mut count) = (0.0, 0.0);
                for row in touched(j, rows, height) {
                    let row = row.clamp(0, i64::from(height) - 1) as usize;
                    for column in touched(i, columns, width) {
                        light += luminance(column.rem_euclid(i64::from(width)) as usize, row);
                        count += 1.0;
                    }
                }
                sum += light / count;
                sums.push(sum);
            }
            // A row without light is asked for nothing; its cells are as likely as each other.
            for (i, to) in own.iter_mut().enumerate().skip(1) {
                *to = if sum > 0.0 { (sums[i - 1] / sum) as f32 } else { i as f32 / columns as f32 };
            }
            total += sum * f64::from(heights[j as usize] - heights[j as usize + 1]);
            above.push(total);
        }
        for (to, above) in of_rows.iter_mut().zip(&above) {
            *to = if total > 0.0 { (above / total) as f32 } else { 0.0 };
        }
        if total > 0.0 {
            of_rows[rows as usize] = 1.0;
        }
        Density { columns, rows, heights, of_rows, of_columns }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Right-handed whatever `up`, the picture's middle in front, and turned counter-clockwise seen from `up`.
    #[test]
    fn axes_are_turned() {
        let near = |a: [DVec3; 3], b: [DVec3; 3]| (0..3).all(|k| a[k].distance(b[k]) < 1e-12);
        assert!(near(axes(DVec3::Y, 0.0), [DVec3::X, DVec3::Y, DVec3::NEG_Z]));
        assert!(near(axes(DVec3::Y * 3.0, 90.0), [DVec3::NEG_Z, DVec3::Y, DVec3::NEG_X]));
        assert!(near(axes(DVec3::Z, 0.0), [DVec3::X, DVec3::Z, DVec3::Y]));
        assert!(near(axes(DVec3::NEG_Y, 0.0), [DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z]));
        for k in 0..50 {
            let up = DVec3::new(f64::from(k * 7 % 11) - 5.0, f64::from(k * 5 % 13) - 6.0, f64::from(k % 3) - 0.5);
            let [right, up, front] = axes(up, 13.0 * f64::from(k));
            assert!((right.cross(up) + front).length() < 1e-12 && (up.length() - 1.0).abs() < 1e-12);
        }
    }
}
