//! Where a cursor stands in TOML: the header above it, the key of its line, and the brackets that are open there.

use super::place::{Step, Way};

/// An open bracket of a value.
struct Frame {
    bracket: u8,
    key: Vec<String>,
    at_value: bool,
    written: Vec<String>,
}

/// The way to a byte.
// Long: one arm for every sign of the syntax.
pub(super) fn way(text: &str, cursor: usize) -> Way {
    let bytes = &text.as_bytes()[..cursor];
    let mut header: Vec<String> = Vec::new();
    let mut frames = vec![Frame { bracket: 0, key: Vec::new(), at_value: false, written: Vec::new() }];
    let mut last: Vec<String> = Vec::new();
    let mut dotted = false;
    let (mut quoted, mut in_comment, mut at, mut in_header) = (None, false, 0, false);
    while at < bytes.len() {
        let from = at;
        let outermost = frames.len() == 1;
        let at_value = frames.last().is_some_and(|frame| frame.at_value);
        match bytes[at] {
            b'#' => {
                at = bytes[at..].iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |end| at + end);
                in_comment = at == bytes.len();
            }
            b'\n' => {
                if outermost {
                    frames[0].key.clear();
                    frames[0].at_value = false;
                    last.clear();
                }
                at += 1;
            }
            quote @ (b'"' | b'\'') => {
                let end = text_end(bytes, at, quote);
                match end {
                    None => {
                        quoted = Some(from + 1);
                        at = bytes.len();
                    }
                    Some(end) => {
                        push(&mut last, &mut dotted, text.get(from + 1..end - 1).unwrap_or("").to_owned());
                        at = end;
                    }
                }
            }
            byte if is_key(byte) => {
                while at < bytes.len() && is_key(bytes[at]) {
                    at += 1;
                }
                push(&mut last, &mut dotted, text.get(from..at).unwrap_or("").to_owned());
            }
            b'.' => {
                dotted = true;
                at += 1;
            }
            b'[' if outermost && !at_value => {
                in_header = true;
                last.clear();
                at += if bytes.get(at + 1) == Some(&b'[') { 2 } else { 1 };
            }
            b']' if in_header => {
                header = std::mem::take(&mut last);
                frames[0].written.clear();
                in_header = false;
                at += if bytes.get(at + 1) == Some(&b']') { 2 } else { 1 };
            }
            b'=' => {
                if let Some(frame) = frames.last_mut() {
                    frame.written.extend(last.first().cloned());
                    frame.key = std::mem::take(&mut last);
                    frame.at_value = true;
                }
                at += 1;
            }
            bracket @ (b'[' | b'{') => {
                frames.push(Frame { bracket, key: Vec::new(), at_value: bracket == b'[', written: Vec::new() });
                last.clear();
                at += 1;
            }
            b']' | b'}' => {
                if frames.len() > 1 {
                    frames.pop();
                }
                last.clear();
                at += 1;
            }
            b',' => {
                if let Some(frame) = frames.last_mut().filter(|frame| frame.bracket == b'{') {
                    frame.key.clear();
                    frame.at_value = false;
                }
                last.clear();
                at += 1;
            }
            _ => at += 1,
        }
    }
    let begun = bytes.iter().rev().take_while(|byte| is_key(**byte)).count();
    let word = quoted.unwrap_or(cursor - begun)..cursor;
    let mut steps: Vec<Step> = Vec::new();
    if in_header {
        // The last part is being written.
        last.pop_if(|_| begun > 0);
        steps.extend(last.into_iter().map(Step::Key));
        return Way { steps, written: Vec::new(), at_value: false, word, quoted, in_comment, in_header };
    }
    steps.extend(header.into_iter().map(Step::Key));
    for frame in &frames {
        steps.extend(frame.key.iter().cloned().map(Step::Key));
        if frame.bracket == b'[' {
            steps.push(Step::Item);
        }
    }
    // `effects.` goes into the table before it is written.
    if begun > 0 {
        last.pop();
    }
    if frames.last().is_some_and(|frame| !frame.at_value) && (begun > 0 || dotted) {
        steps.extend(last.into_iter().map(Step::Key));
    }
    let (at_value, written) = frames.pop().map_or((false, Vec::new()), |frame| (frame.at_value, frame.written));
    Way { steps, written, at_value, word, quoted, in_comment, in_header }
}

fn is_key(byte: u8) -> bool {
    byte == b'_' || byte == b'-' || byte.is_ascii_alphanumeric()
}

fn push(last: &mut Vec<String>, dotted: &mut bool, part: String) {
    if !std::mem::take(dotted) {
        last.clear();
    }
    last.push(part);
}

/// One past the closing quotes of a text that begins here.
fn text_end(bytes: &[u8], start: usize, quote: u8) -> Option<usize> {
    if bytes[start..].starts_with(&[quote; 3]) {
        return bytes[start + 3..].windows(3).position(|window| window == [quote; 3]).map(|at| start + 3 + at + 3);
    }
    let mut at = start + 1;
    while at < bytes.len() {
        match bytes[at] {
            b'\\' if quote == b'"' => at += 2,
            byte if byte == quote => return Some(at + 1),
            // A text of one line ends there, whether it was closed or not.
            b'\n' => return Some(at),
            _ => at += 1,
        }
    }
    None
}
