//! Where a cursor stands in RON: from the text before it alone, so that what is half written behind it does not matter.

use super::place::{Step, Way};

/// An open bracket.
struct Frame {
    bracket: u8,
    name: String,
    key: Option<String>,
    written: Vec<String>,
}

impl Frame {
    fn step(&self, within_list: bool) -> Option<Step> {
        match self.bracket {
            b'(' if !self.name.is_empty() => Some(Step::Kind(self.name.clone())),
            b'(' if within_list => None,
            _ => None,
        }
    }
}

/// The way to a byte.
// Long: one arm for every sign of the syntax.
pub(super) fn way(text: &str, cursor: usize) -> Way {
    let bytes = &text.as_bytes()[..cursor];
    let mut frames: Vec<Frame> = Vec::new();
    // The last word or text, which a colon makes a key and a bracket makes a name.
    let mut last = String::new();
    let (mut quoted, mut in_comment, mut at) = (None, false, 0);
    while at < bytes.len() {
        let from = at;
        match bytes[at] {
            b'/' if bytes.get(at + 1) == Some(&b'/') => {
                at = find(bytes, at, b"\n").unwrap_or(bytes.len());
                in_comment = at == bytes.len();
            }
            b'/' if bytes.get(at + 1) == Some(&b'*') => {
                at = find(bytes, at + 2, b"*/").map_or(bytes.len(), |end| end + 2);
                in_comment = at == bytes.len() && !bytes.ends_with(b"*/");
            }
            b'"' => {
                at += 1;
                while at < bytes.len() && bytes[at] != b'"' && bytes[at] != b'\n' {
                    at += if bytes[at] == b'\\' { 2 } else { 1 };
                }
                at = at.min(bytes.len());
                if at == bytes.len() {
                    quoted = Some(from + 1);
                } else {
                    last = text[from + 1..at].to_owned();
                    at += 1;
                }
            }
            byte if byte == b'_' || byte.is_ascii_alphanumeric() || !byte.is_ascii() => {
                while at < bytes.len()
                    && (bytes[at] == b'_' || bytes[at].is_ascii_alphanumeric() || !bytes[at].is_ascii())
                {
                    at += 1;
                }
                last = text.get(from..at).unwrap_or("").to_owned();
            }
            bracket @ (b'(' | b'[' | b'{') => {
                let name = if bracket == b'(' { std::mem::take(&mut last) } else { String::new() };
                frames.push(Frame { bracket, name, key: None, written: Vec::new() });
                at += 1;
            }
            b')' | b']' | b'}' => {
                frames.pop();
                last.clear();
                at += 1;
            }
            b':' => {
                if let Some(frame) = frames.last_mut() {
                    frame.written.push(last.clone());
                    frame.key = Some(std::mem::take(&mut last));
                }
                at += 1;
            }
            b',' => {
                if let Some(frame) = frames.last_mut() {
                    frame.key = None;
                }
                last.clear();
                at += 1;
            }
            _ => at += 1,
        }
    }
    let word = quoted.unwrap_or_else(|| {
        let is_word = |byte: &u8| *byte == b'_' || byte.is_ascii_alphanumeric();
        cursor - bytes.iter().rev().take_while(|byte| is_word(byte)).count()
    })..cursor;
    let mut steps = Vec::new();
    for (index, frame) in frames.iter().enumerate() {
        let list = index > 0 && frames[index - 1].bracket == b'[';
        // Brackets without a name are a vector, a struct whose name may be left out, or the scene itself.
        match frame.step(list) {
            Some(step) => steps.push(step),
            None if frame.bracket == b'(' => steps.push(Step::Kind(String::new())),
            None => {}
        }
        match (&frame.key, frame.bracket) {
            (Some(key), b'(' | b'{') => steps.push(Step::Key(key.clone())),
            (None, b'[') => steps.push(Step::Item),
            _ => {}
        }
    }
    let top = frames.last();
    let at_value = match top {
        None => true,
        Some(frame) => frame.bracket == b'[' || frame.key.is_some(),
    };
    // `Scale(` has one value without a name, too; whoever asks for names there gets them first.
    let written = top.map(|frame| frame.written.clone()).unwrap_or_default();
    Way { steps, written, at_value, word, quoted, in_comment, in_header: false }
}

fn find(bytes: &[u8], from: usize, what: &[u8]) -> Option<usize> {
    let rest = bytes.get(from..)?;
    rest.windows(what.len()).position(|window| window == what).map(|at| from + at)
}
