//! Where a cursor stands in JSON: from the text before it alone, so that what is half written behind it does not
//! matter.

use super::place::{Step, Way};

/// An open bracket.
struct Frame {
    is_list: bool,
    key: Option<String>,
    written: Vec<String>,
}

/// The way to a byte.
pub(super) fn way(text: &str, cursor: usize) -> Way {
    let bytes = &text.as_bytes()[..cursor];
    let mut frames: Vec<Frame> = Vec::new();
    // The last text, which a colon makes a key.
    let mut last = String::new();
    let (mut quoted, mut at) = (None, 0);
    while at < bytes.len() {
        let from = at;
        at += 1;
        match bytes[from] {
            b'"' => {
                while at < bytes.len() && !matches!(bytes[at], b'"' | b'\n') {
                    at += if bytes[at] == b'\\' { 2 } else { 1 };
                }
                if at >= bytes.len() {
                    quoted = Some(from + 1);
                } else {
                    last = text.get(from + 1..at).unwrap_or("").to_owned();
                    at += 1;
                }
            }
            bracket @ (b'[' | b'{') => {
                frames.push(Frame { is_list: bracket == b'[', key: None, written: Vec::new() });
                last.clear();
            }
            b']' | b'}' => {
                frames.pop();
                last.clear();
            }
            b':' => {
                if let Some(frame) = frames.last_mut().filter(|frame| !frame.is_list) {
                    frame.written.push(last.clone());
                    frame.key = Some(std::mem::take(&mut last));
                }
            }
            b',' => {
                if let Some(frame) = frames.last_mut() {
                    frame.key = None;
                }
                last.clear();
            }
            _ => {}
        }
    }
    let word = quoted.unwrap_or_else(|| {
        let is_word = |byte: &u8| *byte == b'_' || byte.is_ascii_alphanumeric();
        cursor - bytes.iter().rev().take_while(|byte| is_word(byte)).count()
    })..cursor;
    let mut steps = Vec::new();
    for frame in &frames {
        match &frame.key {
            Some(key) => steps.push(Step::Key(key.clone())),
            None if frame.is_list => steps.push(Step::Item),
            None => {}
        }
    }
    let top = frames.last();
    let at_value = top.is_none_or(|frame| frame.is_list || frame.key.is_some());
    let written = top.map(|frame| frame.written.clone()).unwrap_or_default();
    Way { steps, written, at_value, word, quoted, in_comment: false, in_header: false }
}
