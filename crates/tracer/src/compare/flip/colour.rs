//! The colour spaces of FLIP, for sRGB primaries and the white of the display (D65).

/// The opponent space YyCxCz, linear in light: luminance, red against green, blue against yellow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Opponent {
    pub y: f32,
    pub cx: f32,
    pub cz: f32,
}

/// CIELAB with chroma scaled by lightness (the Hunt effect: dark colours look less colourful).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lab {
    l: f32,
    a: f32,
    b: f32,
}

/// XYZ of the sRGB primaries, as fractions that are exact for the standard's chromaticities.
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// The inverse of [`XYZ_FROM_RGB`].
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_275, -1.537_398_934, -0.498_615_861],
    [-0.969_224_334, 1.875_930_071, 0.041_554_224],
    [0.055_639_423, -0.204_011_202, 1.057_148_933],
];

fn multiply(m: &[[f64; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    let v = v.map(f64::from);
    [0, 1, 2].map(|row: usize| (m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2]) as f32)
}

/// XYZ relative to white.
fn normalised_xyz(rgb: [f32; 3]) -> [f32; 3] {
    let xyz = multiply(&XYZ_FROM_RGB, rgb);
    let white = white();
    [0, 1, 2].map(|c: usize| xyz[c] / white[c])
}

fn white() -> [f32; 3] {
    multiply(&XYZ_FROM_RGB, [1.0; 3])
}

/// Linear light of an sRGB value.
fn linear(display: f32) -> f32 {
    if display <= 0.040_45 { display / 12.92 } else { ((display + 0.055) / 1.055).powf(2.4) }
}

impl Opponent {
    pub fn from_display(display: [f32; 3]) -> Self {
        let [x, y, z] = normalised_xyz(display.map(linear));
        Opponent { y: 116.0 * y - 16.0, cx: 500.0 * (x - y), cz: 200.0 * (y - z) }
    }

    /// Through linear RGB, clipped to what a display can show.
    pub fn to_lab(self) -> Lab {
        let y = (self.y + 16.0) / 116.0;
        let white = white();
        let xyz = [(y + self.cx / 500.0) * white[0], y * white[1], (y - self.cz / 200.0) * white[2]];
        Lab::from_linear(multiply(&RGB_FROM_XYZ, xyz).map(|c| c.clamp(0.0, 1.0)))
    }
}

impl Lab {
    pub fn from_linear(rgb: [f32; 3]) -> Self {
        const DELTA: f32 = 6.0 / 29.0;
        let f = |t: f32| if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
        let [x, y, z] = normalised_xyz(rgb).map(f);
        let l = 116.0 * y - 16.0;
        // The Hunt effect.
        let chroma = 0.01 * l;
        Lab { l, a: chroma * 500.0 * (x - y), b: chroma * 200.0 * (y - z) }
    }

    /// The HyAB distance (Abasi, Tehran, Fairchild 2020): right for large differences, where Euclid's is not.
    pub fn hyab(&self, other: &Lab) -> f32 {
        (self.l - other.l).abs() + (self.a - other.a).hypot(self.b - other.b)
    }
}

/// The largest distance of two colours that a display can show: between its green and its blue.
pub(super) fn largest_difference() -> f32 {
    Lab::from_linear([0.0, 1.0, 0.0]).hyab(&Lab::from_linear([0.0, 0.0, 1.0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_black_are_at_the_ends() {
        let white = Lab::from_linear([1.0; 3]);
        assert!((white.l - 100.0).abs() < 1e-4 && white.a.abs() < 1e-3 && white.b.abs() < 1e-3);
        let black = Lab::from_linear([0.0; 3]);
        assert!(black.l.abs() < 1e-4);
        assert!((white.hyab(&black) - 100.0).abs() < 2e-3);
    }

    /// Red of sRGB in CIELAB is (53.24, 80.09, 67.20); the chroma is scaled by 0.5324 here.
    #[test]
    fn red_is_where_the_tables_say() {
        let red = Lab::from_linear([1.0, 0.0, 0.0]);
        assert!((red.l - 53.24).abs() < 0.01);
        assert!((red.a - 80.09 * 0.5324).abs() < 0.02, "{}", red.a);
        assert!((red.b - 67.20 * 0.5324).abs() < 0.02, "{}", red.b);
    }

    #[test]
    fn opponent_space_comes_back() {
        for rgb in [[0.2f32, 0.5, 0.9], [1.0, 0.0, 0.3], [0.04, 0.04, 0.04], [1.0, 1.0, 1.0]] {
            let there = Lab::from_linear(rgb.map(linear));
            let back = Opponent::from_display(rgb).to_lab();
            assert!(there.hyab(&back) < 0.01, "{rgb:?}: {there:?} {back:?}");
        }
    }

    #[test]
    fn no_two_colours_of_a_display_are_farther_apart() {
        let corner = |k: usize| Lab::from_linear([0, 1, 2].map(|c| (k >> c & 1) as f32));
        for i in 0..8 {
            for j in 0..8 {
                assert!(corner(i).hyab(&corner(j)) <= largest_difference() + 1e-3);
            }
        }
    }
}
