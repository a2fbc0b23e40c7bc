//! `--show`: a layer as a picture. What is one number a pixel becomes a heat map, with a legend of its range; light is
//! developed as the picture is, so that layers of it can be compared; colours, directions and numbers of things look as
//! the preview shows them.

use crate::compare::magma;
use tracer_core::{Image, LayerImage, Look, develop_radiance};

/// Rows below the picture for the legend.
const LEGEND: usize = 28;
/// Pixels of a digit, the space beside it too, and its height.
const DIGIT: [usize; 2] = [6, 7];
/// From so many columns on there is room for numbers.
const ROOM: usize = 96;

/// The numbers that the darkest and the brightest colour stand for.
pub type Range = [f64; 2];

/// Layers of light.
const LIGHT: [&str; 3] = ["direct", "indirect", "emission"];

/// The picture, so many pixels across and with the look of the scene's, and what its colours stand for.
pub fn picture(layer: &LayerImage, width: u32, look: &Look) -> (Image, Option<Range>) {
    let across = (width as usize).max(1);
    let rows = layer.values.len() / layer.channels.len().max(1) / across;
    if LIGHT.contains(&layer.name) {
        let radiance: Vec<[f64; 3]> = layer.values.as_chunks::<3>().0.iter().map(|rgb| rgb.map(f64::from)).collect();
        return (develop_radiance([across, rows].map(|side| side as u32), look, &radiance), None);
    }
    let is_heat = layer.channels.len() == 1 && !layer.name.ends_with("_id");
    if !is_heat {
        let bytes = tracer_preview::layer_colours(layer, 0.0);
        let display = bytes.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b].map(|x| f32::from(x) / 255.0));
        return (image(across, rows, display.collect()), None);
    }
    let range = range(&layer.values);
    let [low, high] = range;
    let share = |x: f32| ((f64::from(x) - low) / (high - low).max(f64::MIN_POSITIVE)) as f32;
    // What is infinitely far is black, darker than all that there is.
    let colour = |&x: &f32| if x.is_finite() { magma(share(x)) } else { [0.0; 3] };
    let mut display: Vec<f32> = layer.values.iter().flat_map(colour).collect();
    display.extend(legend(across, range).into_iter().flatten());
    (image(across, rows + LEGEND, display), Some(range))
}

fn image(width: usize, height: usize, display: Vec<f32>) -> Image {
    Image {
        width: width as u32,
        height: height as u32,
        linear: display.clone(),
        display,
        alpha: None,
        layers: Vec::new(),
        mattes: Default::default(),
        light_groups: Vec::new(),
    }
}

/// From the least number to the one that 99 of 100 pixels are not above: one pixel of many times as much would leave
/// all others black.
fn range(values: &[f32]) -> Range {
    let mut finite: Vec<f32> = values.iter().copied().filter(|x| x.is_finite()).collect();
    finite.sort_unstable_by(f32::total_cmp);
    let at = |k: usize| finite.get(k).map_or(0.0, |&x| f64::from(x));
    let last = finite.len().saturating_sub(1);
    let (low, most) = (at(0), at(last));
    let high = at(last - last / 100);
    if high > low { [low, high] } else { [low, most] }
}

/// Rows of a bar from the darkest to the brightest, and the numbers of both ends under it.
fn legend(width: usize, [low, high]: Range) -> Vec<[f32; 3]> {
    const PAPER: [f32; 3] = [1.0; 3];
    let mut pixels = vec![PAPER; width * LEGEND];
    for row in 4..16 {
        for x in 0..width {
            pixels[row * width + x] = magma(x as f32 / (width - 1).max(1) as f32);
        }
    }
    if width >= ROOM {
        let (low, high) = (number(low), number(high));
        write(&low, 2, width, &mut pixels);
        write(&high, width.saturating_sub(2 + DIGIT[0] * high.len()), width, &mut pixels);
    }
    pixels
}

/// A number as legends and messages have it.
pub fn number(x: f64) -> String {
    let size = x.abs();
    let text = match size {
        0.0 => return "0".to_owned(),
        _ if !(1e-3..1e5).contains(&size) => return format!("{x:.1e}"),
        _ if size >= 100.0 => format!("{x:.0}"),
        _ if size >= 1.0 => format!("{x:.2}"),
        _ => format!("{x:.4}"),
    };
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn write(text: &str, left: usize, width: usize, pixels: &mut [[f32; 3]]) {
    for (k, letter) in text.chars().enumerate() {
        for (row, bits) in glyph(letter).into_iter().enumerate() {
            for column in (0..5).filter(|column| bits >> (4 - column) & 1 == 1) {
                let x = left + k * DIGIT[0] + column;
                let place = (19 + row) * width + x;
                if x < width && place < pixels.len() {
                    pixels[place] = [0.1; 3];
                }
            }
        }
    }
}

/// Five by seven pixels of what numbers are made of.
fn glyph(letter: char) -> [u8; DIGIT[1]] {
    match letter {
        '0' => [14, 17, 19, 21, 25, 17, 14],
        '1' => [4, 12, 4, 4, 4, 4, 14],
        '2' => [14, 17, 1, 2, 4, 8, 31],
        '3' => [31, 2, 4, 2, 1, 17, 14],
        '4' => [2, 6, 10, 18, 31, 2, 2],
        '5' => [31, 16, 30, 1, 1, 17, 14],
        '6' => [6, 8, 16, 30, 17, 17, 14],
        '7' => [31, 1, 2, 4, 8, 8, 8],
        '8' => [14, 17, 17, 14, 17, 17, 14],
        '9' => [14, 17, 17, 15, 1, 2, 12],
        '.' => [0, 0, 0, 0, 0, 12, 12],
        '-' => [0, 0, 0, 31, 0, 0, 0],
        'e' => [0, 0, 14, 17, 31, 16, 14],
        _ => [0; DIGIT[1]],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_format::desc::ToneMap;
    use tracer_core::Backdrop;

    fn heat(values: Vec<f32>, width: u32) -> (Image, Range) {
        let look = Look { exposure: 0.0, tone_map: ToneMap::None, backdrop: Backdrop::Background };
        let (image, range) = picture(&LayerImage { name: "nodes", channels: &["Y"], values }, width, &look);
        (image, range.expect("it is one number"))
    }

    /// Light is as bright as in the picture, and what is grey is grey.
    #[test]
    fn light_is_developed_as_the_picture_is() {
        let look = Look { exposure: 1.0, tone_map: ToneMap::None, backdrop: Backdrop::Background };
        for name in LIGHT {
            let values = vec![0.2, 0.2, 0.2, 0.1, 0.4, 0.05];
            let (image, range) = picture(&LayerImage { name, channels: &["R", "G", "B"], values }, 2, &look);
            let expected = [0.4, 0.4, 0.4, 0.2, 0.8, 0.1].map(|x| tracer_core::srgb_encode(x) as f32);
            assert!(range.is_none() && (image.width, image.height) == (2, 1));
            assert!(image.display.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{:?}", image.display);
        }
    }

    #[test]
    fn more_is_brighter_and_the_legend_says_how_much() {
        let values: Vec<f32> = (0..200u16).map(f32::from).collect();
        let (image, range) = heat(values, 100);
        assert_eq!((image.width, image.height), (100, 2 + LEGEND as u32));
        assert_eq!(range, [0.0, 198.0]);
        let light = |k: usize| image.display[3 * k..3 * k + 3].iter().sum::<f32>();
        assert!(light(0) < light(50) && light(50) < light(150) && light(150) < light(198));
        // Ink of both numbers, on white.
        let row = |y: usize| (0..100).filter(|x| image.display[3 * (y * 100 + x)] < 0.5).count();
        assert!(row(2 + 22) > 5 && row(2 + 17) == 0);
    }

    /// One pixel of a thousand times as much does not leave the others black, nor one that is infinitely far.
    #[test]
    fn outliers_do_not_darken_the_rest() {
        let mut values = vec![1.0; 300];
        (values[7], values[8], values[9]) = (1000.0, f32::INFINITY, 0.0);
        let (image, range) = heat(values, 300);
        assert_eq!(range, [0.0, 1.0]);
        assert_eq!(image.display[3 * 8..3 * 8 + 3], [0.0; 3]);
        assert!(image.display[0] > 0.9);
    }

    #[test]
    fn numbers_fit() {
        for (x, text) in [(0.0, "0"), (2.5, "2.5"), (0.012, "0.012"), (1234.5, "1234"), (1e-9, "1.0e-9")] {
            assert_eq!(number(x), text);
        }
        assert!("0123456789.-e".chars().all(|letter| glyph(letter) != [0; 7]));
    }

    #[test]
    fn pictures_of_one_value_and_of_none_are_pictures() {
        assert_eq!(heat(vec![3.0; 4], 2).1, [3.0, 3.0]);
        assert_eq!(heat(vec![f32::INFINITY; 4], 2).1, [0.0, 0.0]);
    }
}
