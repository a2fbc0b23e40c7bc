//! Pictures as PNG files in the stream: kitty's protocol and iTerm2's.

use super::scaled::Picture;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

/// The longest part of a picture that kitty's protocol takes.
const CHUNK: usize = 4096;

/// The bytes of a PNG, made quickly.
///
/// # Errors
/// When there are too many pixels for one.
pub fn png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.size[0], picture.size[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fastest);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// The pictures of kitty's protocol that are shown. Two numbers take turns: the new picture is there before the old
/// one is taken away, or the screen would flicker.
pub struct Kitty {
    numbers: [u32; 2],
    shown: Option<usize>,
}

impl Kitty {
    /// Numbers that no other program in this terminal has, most likely.
    pub fn new() -> Self {
        let own = std::process::id() & 0x3fff_ffff;
        Kitty { numbers: [2 * own + 1, 2 * own + 2], shown: None }
    }

    /// What sends a picture, shows it at the cursor, over so many cells where the size of one is not known, and takes
    /// the old one away. Only the second depends on the cursor.
    pub fn draw(&mut self, png: &[u8], cells: Option<[u16; 2]>) -> [String; 3] {
        let next = self.shown.map_or(0, |shown| 1 - shown);
        let number = self.numbers[next];
        let data = STANDARD.encode(png);
        let mut sends = String::with_capacity(data.len() + data.len() / 256 + 128);
        let mut chunks = data.as_bytes().chunks(CHUNK).peekable();
        let mut first = true;
        while let Some(chunk) = chunks.next() {
            let more = u8::from(chunks.peek().is_some());
            let keys = if std::mem::take(&mut first) { format!("a=t,f=100,t=d,i={number},") } else { String::new() };
            // Silent (q).
            let _ = write!(sends, "\x1b_G{keys}q=2,m={more};{}\x1b\\", String::from_utf8_lossy(chunk));
        }
        let over = cells.map_or(String::new(), |[columns, rows]| format!(",c={columns},r={rows}"));
        // The cursor stays (C).
        let shows = format!("\x1b_Ga=p,i={number},p=1,q=2,C=1{over}\x1b\\");
        let removes = self.shown.replace(next).map_or(String::new(), |old| self.delete(old));
        [sends, shows, removes]
    }

    /// Takes the picture off the screen, and its memory from the terminal.
    pub fn clear(&mut self) -> String {
        self.shown.take().map_or(String::new(), |shown| self.delete(shown))
    }

    /// What takes all of its pictures away, whatever is shown.
    pub fn farewell(&self) -> String {
        self.delete(0) + &self.delete(1)
    }

    fn delete(&self, which: usize) -> String {
        format!("\x1b_Ga=d,d=I,i={},q=2\x1b\\", self.numbers[which])
    }
}

/// iTerm2's words for a picture at the cursor that fits into so many cells.
pub fn iterm(png: &[u8], cells: [u16; 2]) -> String {
    let ([columns, rows], length, data) = (cells, png.len(), STANDARD.encode(png));
    format!(
        "\x1b]1337;File=inline=1;size={length};width={columns};height={rows};preserveAspectRatio=1;\
         doNotMoveCursor=1:{data}\x07"
    )
}

/// What tmux hands on to the terminal behind it, where its option `allow-passthrough` is on.
pub fn through_tmux(text: &str) -> String {
    format!("\x1bPtmux;{}\x1b\\", text.replace('\x1b', "\x1b\x1b"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        let mut noise = 1u32;
        let rgb = (0..97 * 61 * 3).map(|_| {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (noise >> 24) as u8
        });
        Picture { size: [97, 61], rgb: rgb.collect() }
    }

    fn decoded(png: &[u8]) -> Picture {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut rgb).expect("a picture");
        assert_eq!(info.color_type, png::ColorType::Rgb);
        Picture { size: [info.width, info.height], rgb }
    }

    /// The commands of kitty's protocol in a text: keys and data.
    fn commands(text: &str) -> Vec<(String, String)> {
        let parts: Vec<&str> = text.split("\x1b\\").collect();
        assert_eq!(parts.last(), Some(&""), "the last one is ended");
        let command = |part: &&str| {
            let body = part.strip_prefix("\x1b_G").unwrap_or_else(|| panic!("no command: {part:?}"));
            let (keys, data) = body.split_once(';').unwrap_or((body, ""));
            (keys.to_owned(), data.to_owned())
        };
        parts[..parts.len() - 1].iter().map(command).collect()
    }

    #[test]
    fn kitty_gets_the_picture_in_parts_and_the_old_one_goes() {
        let picture = picture();
        let png = png(&picture).expect("a PNG");
        let mut kitty = Kitty::new();
        let [sends, shows, removes] = kitty.draw(&png, None);
        let first = commands(&sends);
        assert!(first.len() > 3, "in parts");
        assert!(first[0].0.starts_with("a=t,f=100,t=d,i=") && first[0].0.ends_with(",q=2,m=1"), "{}", first[0].0);
        let (last, others) = first.split_last().expect("some");
        assert!(others.iter().all(|(keys, data)| keys.ends_with("m=1") && data.len() == CHUNK));
        assert!(last.0 == "q=2,m=0" && last.1.len() <= CHUNK);
        let data: String = first.iter().map(|(_, data)| data.as_str()).collect();
        assert_eq!(decoded(&STANDARD.decode(data).expect("base64")), picture);
        let number = |keys: &str| {
            let number = keys.split(',').find_map(|key| key.strip_prefix("i="));
            number.expect("a number").to_owned()
        };
        let old = number(&first[0].0);
        assert_eq!(commands(&shows)[0].0, format!("a=p,i={old},p=1,q=2,C=1"));
        assert_eq!(removes, "");

        let [sends, shows, removes] = kitty.draw(&png, Some([10, 5]));
        let new = number(&commands(&sends)[0].0);
        assert_ne!(old, new);
        assert_eq!(commands(&shows)[0].0, format!("a=p,i={new},p=1,q=2,C=1,c=10,r=5"));
        assert_eq!(commands(&removes)[0].0, format!("a=d,d=I,i={old},q=2"));
        let [sends, _, removes] = kitty.draw(&png, None);
        assert_eq!(number(&commands(&sends)[0].0), old);
        assert_eq!(commands(&removes)[0].0, format!("a=d,d=I,i={new},q=2"));
        assert_eq!(commands(&kitty.clear()), [(format!("a=d,d=I,i={old},q=2"), String::new())]);
        assert_eq!(kitty.clear(), "");
        assert_eq!(commands(&kitty.farewell()).len(), 2);
    }

    #[test]
    fn iterm_gets_a_file() {
        let picture = picture();
        let png = png(&picture).expect("a PNG");
        let text = iterm(&png, [40, 12]);
        let body = text.strip_prefix("\x1b]1337;File=").and_then(|text| text.strip_suffix('\x07')).expect("a command");
        let (words, data) = body.split_once(':').expect("data");
        let words: Vec<&str> = words.split(';').collect();
        for word in ["inline=1", "width=40", "height=12", &format!("size={}", png.len())] {
            assert!(words.contains(&word), "{word} is not in {words:?}");
        }
        assert_eq!(decoded(&STANDARD.decode(data).expect("base64")), picture);
    }

    #[test]
    fn tmux_gets_escapes_twice() {
        assert_eq!(through_tmux("\x1b_Ga\x1b\\"), "\x1bPtmux;\x1b\x1b_Ga\x1b\x1b\\\x1b\\");
    }
}
