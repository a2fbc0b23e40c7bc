//! Small meshes.

use crate::cat::write::line;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Sides of the rod.
const SIDES: usize = 48;

/// A closed round rod of radius 1 about the y axis, from y = 0 to y = 1: smooth around, flat at the ends.
pub fn rod() -> String {
    let mut text = String::from("# A rod, made by `cargo xtask gallery`: radius 1, from y = 0 to y = 1.\n");
    let directions: Vec<[f64; 2]> =
        (0..SIDES).map(|i| TAU * i as f64 / SIDES as f64).map(|angle| [libm::cos(angle), libm::sin(angle)]).collect();
    for y in [0.0, 1.0] {
        for [x, z] in &directions {
            line(&mut text, "v", &[*x, y, *z], 6);
        }
    }
    for [x, z] in &directions {
        line(&mut text, "vn", &[*x, 0.0, *z], 6);
    }
    text.push_str("vn 0 -1 0\nvn 0 1 0\n");
    let (down, up) = (SIDES + 1, SIDES + 2);
    for i in 0..SIDES {
        let (a, b) = (i + 1, (i + 1) % SIDES + 1);
        let (c, d) = (b + SIDES, a + SIDES);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "f {a}//{a} {d}//{a} {c}//{b} {b}//{b}");
    }
    let end = |indices: &mut dyn Iterator<Item = usize>, normal: usize| {
        indices.fold(String::from("f"), |face, i| face + &format!(" {i}//{normal}")) + "\n"
    };
    text += &end(&mut (1..=SIDES), down);
    text += &end(&mut (SIDES + 1..=2 * SIDES).rev(), up);
    text
}

/// A table top: a square from -1 to 1 in x and z at y = 0, facing up, with texture coordinates 0 to 1.
pub fn table() -> String {
    "# A table top, made by `cargo xtask gallery`.\n\
     v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\n\
     vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
     vn 0 1 0\n\
     f 1/1/1 2/2/1 3/3/1 4/4/1\n"
        .to_owned()
}
