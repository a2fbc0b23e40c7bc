//! Half blocks: each cell is an upper half, the colour of the text, and a lower half, the colour behind it. Cells that
//! are as they were are left out.

use super::ask::Depth;
use super::scaled::Picture;
use std::fmt::Write;

/// What a cell shows; below the picture's last row there may be nothing.
type Cell = ([u8; 3], Option<[u8; 3]>);

/// The cells that are on the screen.
#[derive(Default)]
pub struct Blocks {
    /// Column and row of the first cell, cells in a row.
    at: [u16; 2],
    width: u32,
    cells: Vec<Cell>,
}

impl Blocks {
    /// What changes the screen to this picture, with its first cell at a column and row that count from 0.
    pub fn draw(&mut self, picture: &Picture, at: [u16; 2], depth: Depth) -> String {
        let [width, height] = picture.size;
        let cells: Vec<Cell> = (0..height.div_ceil(2))
            .flat_map(|row| (0..width).map(move |x| (x, row)))
            .map(|(x, row)| {
                let below = (2 * row + 1 < height).then(|| picture.at(x, 2 * row + 1));
                (picture.at(x, 2 * row), below)
            })
            .collect();
        let known = self.at == at && self.width == width && self.cells.len() == cells.len();
        let mut text = String::new();
        let mut pen = None;
        // The cell at which the cursor stands.
        let mut cursor = None;
        for (k, cell) in cells.iter().enumerate() {
            if known && self.cells[k] == *cell {
                continue;
            }
            let (x, y) = (k % width as usize, k / width as usize);
            if cursor != Some((x, y)) {
                let _ = write!(text, "\x1b[{};{}H", usize::from(at[1]) + y + 1, usize::from(at[0]) + x + 1);
            }
            if pen != Some(*cell) {
                text.push_str(&colours(*cell, depth));
                pen = Some(*cell);
            }
            text.push('▀');
            cursor = Some((x + 1, y));
        }
        if pen.is_some() {
            text.push_str("\x1b[0m");
        }
        *self = Blocks { at, width, cells };
        text
    }

    /// Nothing of it is on the screen any more.
    pub fn forget(&mut self) {
        self.cells.clear();
    }
}

fn colours((above, below): Cell, depth: Depth) -> String {
    let colour = |kind: u8, rgb: [u8; 3]| match depth {
        Depth::True => format!("{kind};2;{};{};{}", rgb[0], rgb[1], rgb[2]),
        Depth::Indexed => format!("{kind};5;{}", indexed(rgb)),
    };
    let behind = below.map_or("49".to_owned(), |below| colour(48, below));
    format!("\x1b[{};{behind}m", colour(38, above))
}

/// The steps of the cube of 6x6x6 colours.
const STEPS: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The nearest of the 240 colours that are the same in all terminals: a cube, then greys.
fn indexed(rgb: [u8; 3]) -> u8 {
    let distance = |other: [u8; 3]| (0..3).map(|c| u32::from(rgb[c].abs_diff(other[c])).pow(2)).sum::<u32>();
    let near = rgb.map(|x| (0..6u8).min_by_key(|&k| STEPS[usize::from(k)].abs_diff(x)).unwrap_or(0));
    let of_cube = near.map(|k| STEPS[usize::from(k)]);
    let sum = rgb.iter().map(|&x| u32::from(x)).sum::<u32>();
    let grey = (0..24u8).min_by_key(|k| (3 * (8 + 10 * u32::from(*k))).abs_diff(sum)).unwrap_or(0);
    if distance([8 + 10 * grey; 3]) < distance(of_cube) {
        232 + grey
    } else {
        16 + 36 * near[0] + 6 * near[1] + near[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32) -> Picture {
        let rgb = (0..width * height * 3).map(|k| (k * 37 % 251) as u8).collect();
        Picture { size: [width, height], rgb }
    }

    /// A screen after this text.
    fn screen(text: &str) -> vt100::Parser {
        let side = |n| std::num::NonZero::new(n).expect("some");
        let mut parser = vt100::Parser::new(side(10), side(20), 0);
        parser.process(text.as_bytes());
        parser
    }

    fn colour(rgb: [u8; 3]) -> vt100::Color {
        vt100::Color::Rgb(rgb[0], rgb[1], rgb[2])
    }

    #[test]
    fn a_terminal_shows_every_pixel() {
        for height in [7, 8] {
            let picture = picture(9, height);
            let parser = screen(&Blocks::default().draw(&picture, [3, 2], Depth::True));
            for y in 0..height {
                for x in 0..9 {
                    let cell = parser.screen().cell((2 + y / 2) as u16, (3 + x) as u16).expect("a cell");
                    assert_eq!(cell.contents(), "▀");
                    let shown = if y.is_multiple_of(2) { cell.fgcolor() } else { cell.bgcolor() };
                    assert_eq!(shown, colour(picture.at(x, y)), "{x} {y}");
                }
            }
            if height == 7 {
                let last = parser.screen().cell(5, 3).expect("a cell");
                assert_eq!(last.bgcolor(), vt100::Color::Default);
            }
            let outside = [(1, 3), (2, 2), (2, 12), (6, 3)].map(|(row, column)| parser.screen().cell(row, column));
            assert!(outside.iter().flatten().all(|cell| !cell.has_contents()));
        }
    }

    #[test]
    fn only_what_has_changed_is_drawn_anew() {
        let mut blocks = Blocks::default();
        let mut picture = picture(9, 8);
        let mut all = blocks.draw(&picture, [0, 0], Depth::True);
        assert_eq!(blocks.draw(&picture, [0, 0], Depth::True), "");
        picture.rgb[3 * (9 * 5 + 4)] ^= 0x80;
        let change = blocks.draw(&picture, [0, 0], Depth::True);
        assert_eq!(change.matches('▀').count(), 1);
        all += &change;
        let mut whole = Blocks::default();
        assert_eq!(screen(&all).screen().contents_formatted(), {
            let mut parser = screen(&whole.draw(&picture, [0, 0], Depth::True));
            // The cursor is where the last change was.
            parser.process(b"\x1b[3;6H");
            parser.screen().contents_formatted()
        });
        // Elsewhere, and after it was wiped off, all of it.
        assert_eq!(blocks.draw(&picture, [1, 0], Depth::True).matches('▀').count(), 36);
        blocks.forget();
        assert_eq!(blocks.draw(&picture, [1, 0], Depth::True).matches('▀').count(), 36);
    }

    #[test]
    fn of_256_colours_the_nearest_is_taken() {
        let of = |index: u8| match index {
            16..=231 => [(index - 16) / 36, (index - 16) / 6 % 6, (index - 16) % 6].map(|k| STEPS[usize::from(k)]),
            232..=255 => [8 + 10 * (index - 232); 3],
            _ => unreachable!("the first 16 are another in each terminal"),
        };
        let distance = |a: [u8; 3], b: [u8; 3]| (0..3).map(|c| u32::from(a[c].abs_diff(b[c])).pow(2)).sum::<u32>();
        for k in 0..4096u32 {
            let rgb = [k / 256 * 17, k / 16 % 16 * 17, k % 16 * 17].map(|x| x as u8);
            let taken = distance(rgb, of(indexed(rgb)));
            let least = (16..=255).map(|index| distance(rgb, of(index))).min().expect("some");
            assert_eq!(taken, least, "{rgb:?}");
        }
        let text = Blocks::default().draw(&picture(1, 2), [0, 0], Depth::Indexed);
        assert!(text.contains("38;5;") && text.contains("48;5;") && !text.contains(";2;"), "{text:?}");
    }
}
