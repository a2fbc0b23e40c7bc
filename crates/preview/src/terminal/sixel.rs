//! Sixels: bands of six rows, and for each colour in a band a character for six pixels.
//!
//! The 256 colours, and what becomes of those between them, is the work of `quantizr`; the words are few enough to be
//! written here. (The crate `icy_sixel` brings seventeen more crates, and features of shared ones that have the kernels
//! compiled anew; the colours of `color_quant` leave out the brightest.)

use super::scaled::Picture;
use std::fmt::Write;

/// The picture, for a terminal to draw at its cursor.
///
/// # Errors
/// When there are too many pixels for one.
pub fn sixel(picture: &Picture) -> Result<String, quantizr::Error> {
    let [width, height] = picture.size.map(|side| side as usize);
    let (palette, indices) = quantized(picture)?;
    let mut text = String::with_capacity(indices.len());
    // Square pixels; those of the last band that the picture has not are left as they are.
    let _ = write!(text, "\x1bP0;1;0q\"1;1;{width};{height}");
    for (k, rgb) in palette.iter().enumerate() {
        let [r, g, b] = rgb.map(|x| (u32::from(x) * 100 + 127) / 255);
        let _ = write!(text, "#{k};2;{r};{g};{b}");
    }
    let mut rows = vec![0u8; palette.len() * width];
    for (k, band) in indices.chunks(6 * width).enumerate() {
        if k > 0 {
            text.push('-');
        }
        let mut used = vec![false; palette.len()];
        for (y, row) in band.chunks(width).enumerate() {
            for (x, &index) in row.iter().enumerate() {
                let index = usize::from(index);
                if !std::mem::replace(&mut used[index], true) {
                    rows[index * width..][..width].fill(0);
                }
                rows[index * width + x] |= 1 << y;
            }
        }
        let mut first = true;
        for (index, row) in rows.chunks(width).enumerate().filter(|(index, _)| used[*index]) {
            if !std::mem::take(&mut first) {
                text.push('$');
            }
            let _ = write!(text, "#{index}");
            runs(&mut text, row);
        }
    }
    text.push_str("\x1b\\");
    Ok(text)
}

/// The characters of a row; what is the same is counted, and nothing at the end left out.
fn runs(text: &mut String, row: &[u8]) {
    let end = row.iter().rposition(|&six| six != 0).map_or(0, |last| last + 1);
    for run in row[..end].chunk_by(|a, b| a == b) {
        let character = char::from(b'?' + run[0]);
        if run.len() > 3 {
            let _ = write!(text, "!{}{character}", run.len());
        } else {
            text.extend(std::iter::repeat_n(character, run.len()));
        }
    }
}

/// At most 256 colours, and which of them each pixel has.
fn quantized(picture: &Picture) -> Result<(Vec<[u8; 3]>, Vec<u8>), quantizr::Error> {
    let [width, height] = picture.size.map(|side| side as usize);
    let rgba: Vec<u8> = picture.rgb.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], u8::MAX]).collect();
    let image = quantizr::Image::new(&rgba, width, height)?;
    let mut chosen = quantizr::QuantizeResult::quantize(&image, &quantizr::Options::default());
    chosen.set_dithering_level(1.0)?;
    let mut indices = vec![0; width * height];
    chosen.remap_image(&image, &mut indices)?;
    let palette = chosen.get_palette();
    let colours = palette.entries.iter().take(palette.count as usize);
    Ok((colours.map(|colour| [colour.r, colour.g, colour.b]).collect(), indices))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a terminal makes of it; pixels that nothing was said of are `None`.
    fn decoded(text: &str) -> ([usize; 2], Vec<Option<[u8; 3]>>) {
        let body = text.strip_prefix("\x1bP0;1;0q").and_then(|text| text.strip_suffix("\x1b\\")).expect("sixels");
        let mut rest = body.strip_prefix("\"1;1;").expect("a size");
        let number = |rest: &mut &str| {
            let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            let (digits, after) = rest.split_at(end);
            *rest = after.strip_prefix(';').unwrap_or(after);
            digits.parse::<usize>().expect("a number")
        };
        let size = [number(&mut rest), number(&mut rest)];
        let mut pixels = vec![None; size[0] * size[1].div_ceil(6) * 6];
        let (mut colours, mut colour) = ([[0u8; 3]; 256], 0);
        let (mut x, mut y) = (0, 0);
        while let Some(c) = rest.chars().next() {
            rest = &rest[1..];
            let mut count = 1;
            let mut six = c;
            match c {
                '$' => x = 0,
                '-' => (x, y) = (0, y + 6),
                '#' => {
                    let defines = rest.trim_start_matches(|c: char| c.is_ascii_digit()).starts_with(';');
                    colour = number(&mut rest);
                    if defines {
                        assert_eq!(number(&mut rest), 2, "RGB");
                        colours[colour] = [0; 3].map(|_: u8| ((number(&mut rest) * 255 + 50) / 100) as u8);
                    }
                }
                '!' => {
                    count = number(&mut rest);
                    six = rest.chars().next().expect("what is repeated");
                    rest = &rest[1..];
                }
                _ => {}
            }
            if ('?'..='~').contains(&six) {
                let bits = six as u8 - b'?';
                for _ in 0..count {
                    for row in (0..6).filter(|row| bits >> row & 1 == 1) {
                        let pixel = &mut pixels[(y + row) * size[0] + x];
                        assert!(pixel.is_none(), "a pixel is drawn twice");
                        *pixel = Some(colours[colour]);
                    }
                    x += 1;
                }
                assert!(x <= size[0], "beyond the picture");
            }
        }
        (size, pixels)
    }

    #[test]
    fn few_colours_are_what_they_are() {
        let palette = [[204, 51, 51], [0, 0, 0], [255, 255, 255], [128, 64, 200]];
        for height in [6, 7, 17] {
            let rgb = (0..23 * height).flat_map(|k| palette[(k / 5 + k / 23) % 4]).collect();
            let picture = Picture { size: [23, height as u32], rgb };
            let (size, pixels) = decoded(&sixel(&picture).expect("sixels"));
            assert_eq!(size, [23, height]);
            for (k, pixel) in pixels.iter().enumerate().take(23 * height) {
                let (was, is) = (picture.at((k % 23) as u32, (k / 23) as u32), pixel.expect("drawn"));
                // Sixels have colours in percent.
                assert!((0..3).all(|c| was[c].abs_diff(is[c]) <= 2), "{was:?} is {is:?}");
            }
            assert!(pixels[23 * height..].iter().all(Option::is_none), "nothing below");
        }
    }

    #[test]
    fn many_colours_are_nearly_what_they_are() {
        // All hues, light and dark.
        let (width, height) = (160u32, 96u32);
        let rgb = (0..height).flat_map(|y| {
            (0..width).flat_map(move |x| {
                let light = f64::from(y) / f64::from(height);
                [0.0, 2.1, 4.2].map(|turn| (light * (127.5 + 127.5 * libm::sin(f64::from(x) / 20.0 + turn))) as u8)
            })
        });
        let picture = Picture { size: [width, height], rgb: rgb.collect() };
        let (_, pixels) = decoded(&sixel(&picture).expect("sixels"));
        let shown = |x: u32, y: u32| pixels[(y * width + x) as usize].expect("drawn");
        let mut worst = 0.0f64;
        for y in (0..height).step_by(8) {
            for x in (0..width).step_by(8) {
                for c in 0..3 {
                    let mean = |of: &dyn Fn(u32, u32) -> [u8; 3]| {
                        (0..64).map(|k| f64::from(of(x + k % 8, y + k / 8)[c])).sum::<f64>() / 64.0
                    };
                    worst = worst.max((mean(&|x, y| picture.at(x, y)) - mean(&shown)).abs());
                }
            }
        }
        assert!(worst < 6.0, "in the mean over 8x8 pixels it is {worst:.1} of 255 off");
    }

    #[test]
    fn a_row_is_counted() {
        let mut text = String::new();
        runs(&mut text, &[1, 1, 1, 1, 1, 0, 0, 63, 63, 0, 0]);
        assert_eq!(text, "!5@??~~");
    }
}
