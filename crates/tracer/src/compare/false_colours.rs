//! Numbers as colours.

use tracer_core::Image;

/// A picture of numbers in 0..=1, by [`magma`].
pub fn false_colours(numbers: &[f32], width: u32, height: u32) -> Image {
    let display: Vec<f32> = numbers.iter().flat_map(|&x| magma(x)).collect();
    Image {
        width,
        height,
        linear: display.clone(),
        display,
        alpha: None,
        layers: Vec::new(),
        mattes: Default::default(),
        light_groups: Vec::new(),
    }
}

/// Display values of the colour map "magma" (Stéfan van der Walt, Nathaniel Smith, 2015: dark is none, bright is much,
/// evenly for the eye) in the polynomial form by Matt Zucker (2019), within 0.02 of the table.
pub fn magma(x: f32) -> [f32; 3] {
    const C: [[f32; 3]; 7] = [
        [-0.002_136_485, -0.000_749_655, -0.005_386_128],
        [0.251_660_54, 0.677_523_24, 2.494_026_6],
        [8.353_717, -3.577_719_5, 0.314_467_9],
        [-27.668_733, 14.264_731, -13.649_213],
        [52.176_14, -27.943_606, 12.944_17],
        [-50.768_525, 29.046_583, 4.234_153],
        [18.655_706, -11.489_773, -5.601_961_5],
    ];
    let x = x.clamp(0.0, 1.0);
    [0, 1, 2].map(|c: usize| C.iter().rev().fold(0.0, |sum, row| sum * x + row[c]).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table begins at (0.001, 0.000, 0.014), has (0.716, 0.215, 0.475) in its middle and ends at (0.987, 0.991,
    /// 0.750).
    #[test]
    fn magma_is_the_table_within_its_error() {
        for (x, expected) in [(0.0, [0.001, 0.0, 0.014]), (0.5, [0.716, 0.215, 0.475]), (1.0, [0.987, 0.991, 0.75])] {
            for (got, expected) in magma(x).into_iter().zip(expected) {
                assert!((got - expected).abs() < 0.021, "{x}: {got} {expected}");
            }
        }
    }

    #[test]
    fn more_is_brighter() {
        let light = |x: f32| magma(x).iter().zip([0.2126, 0.7152, 0.0722]).map(|(c, w)| c * w).sum::<f32>();
        for k in 0..100 {
            let x = k as f32 / 100.0;
            assert!(light(x + 0.01) > light(x), "at {x}");
        }
    }
}
