//! Pictures in the size in which they are shown.

use tracer_core::srgb_encode;

/// A picture of display values, three bytes a pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub size: [u32; 2],
    pub rgb: Vec<u8>,
}

impl Picture {
    pub fn at(&self, x: u32, y: u32) -> [u8; 3] {
        let k = 3 * (y as usize * self.size[0] as usize + x as usize);
        [self.rgb[k], self.rgb[k + 1], self.rgb[k + 2]]
    }
}

/// A picture of four bytes a pixel in another size: each pixel is the mean of what it covers, of light, not of code
/// values. A larger one by a whole factor has the same pixels.
pub fn scaled(rgba: &[u8], from: [u32; 2], to: [u32; 2]) -> Picture {
    let [width, height] = from.map(|side| side as usize);
    let light: Vec<f32> = (0..=255u8).map(linear).collect();
    let code: Vec<u8> =
        (0..=CODES).map(|k| (srgb_encode(f64::from(k) / f64::from(CODES)) * 255.0 + 0.5) as u8).collect();
    let encoded = |x: f32| code[((x * CODES as f32 + 0.5) as usize).min(CODES as usize)];
    let (columns, rows) = (shares(from[0], to[0]), shares(from[1], to[1]));
    let mut rgb = Vec::with_capacity(3 * to[0] as usize * to[1] as usize);
    let mut sums = vec![[0f32; 3]; width];
    for (top, of_rows) in &rows {
        if let ([_], true) = (of_rows.as_slice(), columns.iter().all(|(_, of_columns)| of_columns.len() == 1)) {
            // Nothing is mixed.
            for (left, _) in &columns {
                let k = 4 * (top * width + left);
                rgb.extend_from_slice(&rgba[k..k + 3]);
            }
            continue;
        }
        sums.fill([0.0; 3]);
        for (y, share) in (*top..height).zip(of_rows) {
            for (sum, pixel) in sums.iter_mut().zip(rgba[4 * y * width..].chunks_exact(4)) {
                for (sum, byte) in sum.iter_mut().zip(pixel) {
                    *sum += share * light[*byte as usize];
                }
            }
        }
        for (left, of_columns) in &columns {
            let mut mean = [0f32; 3];
            for (sum, share) in sums[*left..].iter().zip(of_columns) {
                for (mean, sum) in mean.iter_mut().zip(sum) {
                    *mean += share * sum;
                }
            }
            rgb.extend(mean.map(encoded));
        }
    }
    Picture { size: to, rgb }
}

/// Steps of light that code values are looked up by: finer than code values are anywhere.
const CODES: u32 = 8191;

/// Light of a code value: sRGB.
fn linear(code: u8) -> f32 {
    let x = f64::from(code) / 255.0;
    (if x <= 0.040_45 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }) as f32
}

/// For each of `to` parts of a line: the first of `from` parts that it covers, and their shares in it.
fn shares(from: u32, to: u32) -> Vec<(usize, Vec<f32>)> {
    // In units of which a part of the one has `to` and a part of the other `from`: whole numbers.
    let (from, to) = (u64::from(from), u64::from(to));
    (0..to)
        .map(|k| {
            let (begin, end) = (k * from, (k + 1) * from);
            let (first, last) = (begin / to, (end - 1) / to);
            let share = |part: u64| (end.min((part + 1) * to) - begin.max(part * to)) as f32 / from as f32;
            (first as usize, (first..=last).map(share).collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rgba(pixels: &[[u8; 3]]) -> Vec<u8> {
        pixels.iter().flat_map(|[r, g, b]| [*r, *g, *b, 255]).collect()
    }

    #[test]
    fn the_same_size_and_whole_factors_keep_every_pixel() {
        let pixels = [[1, 2, 3], [250, 128, 0], [0, 0, 0], [255, 255, 255], [7, 8, 9], [90, 80, 70]];
        let same = scaled(&rgba(&pixels), [3, 2], [3, 2]);
        assert_eq!(same.rgb, pixels.concat());
        let large = scaled(&rgba(&pixels), [3, 2], [9, 6]);
        for y in 0..6 {
            for x in 0..9 {
                assert_eq!(large.at(x, y), same.at(x / 3, y / 3));
            }
        }
    }

    #[test]
    fn smaller_pictures_have_the_mean_of_the_light() {
        // Half of the light is code 188.
        let small = scaled(&rgba(&[[0, 255, 10], [255, 0, 10], [255, 255, 10], [0, 0, 10]]), [2, 2], [1, 1]);
        assert_eq!(small.rgb, [188, 188, 10]);
        // A third of a pixel counts as a third.
        let third = scaled(&rgba(&[[255; 3], [0; 3]]), [2, 1], [3, 1]);
        assert_eq!((third.at(0, 0), third.at(1, 0), third.at(2, 0)), ([255; 3], [188; 3], [0; 3]));
    }

    #[test]
    fn every_code_value_survives_mixing() {
        for code in 0..=255u8 {
            let mixed = scaled(&rgba(&[[code; 3]; 6]), [3, 2], [2, 1]);
            assert_eq!(mixed.rgb, [code; 6], "{code}");
        }
    }
}
