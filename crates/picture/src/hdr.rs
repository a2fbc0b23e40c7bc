//! Radiance HDR (Greg Ward, "Real Pixels", Graphics Gems II, 1991): three 8-bit mantissas and one exponent a pixel,
//! rows run-length encoded per channel. Deviation: mantissas are rounded to the nearest (the original cuts them off),
//! which halves the error.

use super::Provenance;
use tracer_core::Image;

pub(super) fn encode(image: &Image, provenance: &Provenance) -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\n".to_vec();
    let mut line = |text: &str| {
        // A header ends at its first empty line: no text may bring one in.
        bytes.extend(text.bytes().map(|byte| if byte.is_ascii_control() { b' ' } else { byte }));
        bytes.push(b'\n');
    };
    if !provenance.is_hidden {
        line(&format!("SOFTWARE={}", Provenance::SOFTWARE));
    }
    if !provenance.scene_name.is_empty() {
        line(&format!("# scene {}", provenance.scene_name));
    }
    if !provenance.settings.is_empty() {
        line(&format!("# {}", provenance.settings_line()));
    }
    line("PRIMARIES=0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290");
    line("FORMAT=32-bit_rle_rgbe");
    bytes.extend(format!("\n-Y {} +X {}\n", image.height, image.width).bytes());
    for row in image.linear.chunks_exact(3 * image.width as usize) {
        let pixels: Vec<[u8; 4]> = row.chunks_exact(3).map(|p| rgbe([p[0], p[1], p[2]])).collect();
        // The run-length form carries its width in 15 bits, and readers take narrow rows for the old form.
        if (8..0x8000).contains(&image.width) {
            bytes.extend([2, 2, (image.width >> 8) as u8, image.width as u8]);
            for channel in 0..4 {
                run_length(&pixels.iter().map(|p| p[channel]).collect::<Vec<u8>>(), &mut bytes);
            }
        } else {
            bytes.extend(pixels.iter().flatten());
        }
    }
    bytes
}

/// The nearest RGBE value: channel = mantissa / 256 * 2^(exponent - 128). Negative and NaN become 0; what is too large,
/// the largest.
fn rgbe(rgb: [f32; 3]) -> [u8; 4] {
    // 255/256 * 2^127, the largest that there is.
    const LARGEST: f64 = 255.0 / 256.0 * 1.701_411_834_604_692_3e38;
    let rgb = rgb.map(|x| if x > 0.0 { f64::from(x).min(LARGEST) } else { 0.0 });
    let most = rgb[0].max(rgb[1]).max(rgb[2]);
    // f64's own exponent: most = m 2^e with m in 1..2, that is m/2 * 2^(e + 1).
    let mut exponent = ((most.to_bits() >> 52) as i32 - 1023) + 1;
    let mantissas = |exponent: i32| rgb.map(|x| (x * power_of_two(8 - exponent)).round());
    let mut rounded = mantissas(exponent);
    if rounded.contains(&256.0) {
        exponent += 1;
        rounded = mantissas(exponent);
    }
    if exponent < -127 {
        return [0; 4];
    }
    [rounded[0] as u8, rounded[1] as u8, rounded[2] as u8, (exponent + 128) as u8]
}

/// 2^e, e in -1022..=1023.
fn power_of_two(e: i32) -> f64 {
    f64::from_bits(((e.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// One channel of a row: a count above 128 repeats the next byte that many times less 128, others copy that many bytes.
fn run_length(row: &[u8], bytes: &mut Vec<u8>) {
    let mut rest = row;
    while let Some(&first) = rest.first() {
        let run = rest.iter().take(127).take_while(|&&b| b == first).count();
        if run >= 3 {
            bytes.extend([128 + run as u8, first]);
            rest = &rest[run..];
        } else {
            // Up to the next run of three.
            let runs = rest.windows(3).position(|w| w[0] == w[1] && w[1] == w[2]);
            let count = runs.unwrap_or(rest.len()).min(128);
            bytes.push(count as u8);
            bytes.extend(&rest[..count]);
            rest = &rest[count..];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value([r, g, b, e]: [u8; 4]) -> [f64; 3] {
        [r, g, b].map(|m| f64::from(m) / 256.0 * power_of_two(i32::from(e) - 128))
    }

    #[test]
    fn rgbe_is_the_nearest() {
        assert_eq!(rgbe([1.0, 0.5, 0.0]), [128, 64, 0, 129]);
        assert_eq!(rgbe([0.0; 3]), [0; 4]);
        assert_eq!(rgbe([f32::NAN, -1.0, 1.0]), [0, 0, 128, 129]);
        // 0.9999 rounds up to a mantissa of 256, which is 128 with the next exponent.
        assert_eq!(rgbe([0.9999, 0.0, 0.0]), [128, 0, 0, 129]);
        assert_eq!(rgbe([f32::INFINITY, 0.0, 0.0]), [255, 0, 0, 255]);
        for k in 0..2000 {
            let x = 1e-30 * 1.07f64.powi(k);
            let x = [x as f32, (x / 3.0) as f32, (x / 700.0) as f32];
            let back = value(rgbe(x));
            for c in 0..3 {
                // Half a step of the common exponent, whose steps are at most 1/128 of the largest channel.
                assert!((back[c] - f64::from(x[c])).abs() <= f64::from(x[0]) / 256.0 * 1.000_001, "{x:?} {back:?}");
            }
        }
    }

    #[test]
    fn run_lengths_come_back() {
        let rows: [&[u8]; 5] = [&[1], &[7; 300], &[1, 2, 3, 3, 3, 3, 4], &[1, 1, 2, 2, 3, 3], &[0; 128]];
        let long: Vec<u8> = (0..1000u32).map(|k| (k * k / 97) as u8).collect();
        for row in rows.into_iter().chain([long.as_slice()]) {
            let mut bytes = Vec::new();
            run_length(row, &mut bytes);
            let mut decoded = Vec::new();
            let mut at = bytes.iter();
            while let Some(&count) = at.next() {
                if count > 128 {
                    let byte = at.next().expect("a run has a byte");
                    decoded.extend(std::iter::repeat_n(*byte, usize::from(count) - 128));
                } else {
                    decoded.extend(at.by_ref().take(usize::from(count)));
                }
            }
            assert_eq!(decoded, row);
        }
    }
}
