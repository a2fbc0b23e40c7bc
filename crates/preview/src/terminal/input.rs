//! What comes from a terminal: keys, and answers to what it was asked.
//!
//! By hand, since the crates that read keys take an answer that comes late, as over a slow line, for keys: the `q` in
//! it would end the program. Here a text between an opening sequence and its end is never a key.

/// A key that was pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// A character.
    Char(char),
    /// A letter with Ctrl.
    Ctrl(char),
    Up,
    Down,
    Left,
    Right,
    Escape,
}

/// What a terminal tells of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// Of kitty's protocol for pictures; whether it can.
    Kitty(bool),
    /// Primary attributes (DA1).
    Attributes(Vec<u32>),
    /// Width and height of a cell in pixels.
    Cell([u32; 2]),
    /// A private mode and how it is: 0 is unknown.
    Mode(u32, u32),
    /// Name and version (XTVERSION).
    Version(String),
    /// The colours that are set (DECRQSS).
    Colours(String),
}

/// Something that came.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Token {
    Key(Key),
    Reply(Reply),
}

/// Texts that are longer are no answers.
const LONGEST: usize = 4096;
const ESCAPE: u8 = 0x1b;

/// Reads bytes as they come.
#[derive(Default)]
pub struct Input {
    /// What is not whole yet.
    bytes: Vec<u8>,
}

/// What stands at the beginning of the bytes.
enum Begins {
    /// So many bytes, and what they are; of no interest: `None`.
    With(usize, Option<Token>),
    /// It is not whole.
    Broken,
}

impl Input {
    /// Takes bytes, and gives what is whole.
    pub fn feed(&mut self, bytes: &[u8]) -> Vec<Token> {
        self.bytes.extend_from_slice(bytes);
        let mut tokens = Vec::new();
        while !self.bytes.is_empty() {
            match begins(&self.bytes) {
                Begins::With(length, token) => {
                    self.bytes.drain(..length);
                    tokens.extend(token);
                }
                Begins::Broken if self.bytes.len() > LONGEST => self.bytes.clear(),
                Begins::Broken => break,
            }
        }
        tokens
    }

    /// Whether something is not whole: the rest may come, or it was Escape, or a key with Alt.
    pub fn is_waiting(&self) -> bool {
        !self.bytes.is_empty()
    }

    /// Nothing more has come for a while: what there is, is all.
    pub fn give_up(&mut self) -> Option<Token> {
        let bytes = std::mem::take(&mut self.bytes);
        (bytes == [ESCAPE]).then_some(Token::Key(Key::Escape))
    }
}

fn begins(bytes: &[u8]) -> Begins {
    match bytes {
        [ESCAPE] => Begins::Broken,
        // Escape was held down, or pressed before another key.
        [ESCAPE, ESCAPE, ..] => Begins::With(1, Some(Token::Key(Key::Escape))),
        [ESCAPE, b'[', rest @ ..] => control(rest),
        [ESCAPE, b'O', key, ..] => Begins::With(3, arrow(*key)),
        [ESCAPE, b'O'] => Begins::Broken,
        [ESCAPE, b'P' | b']' | b'_' | b'^' | b'X', rest @ ..] => string(bytes[1], rest),
        // A key with Alt, which means nothing here.
        [ESCAPE, rest @ ..] => match character(rest) {
            Some((length, _)) => Begins::With(1 + length, None),
            None => Begins::Broken,
        },
        [byte @ 1..=26, ..] => Begins::With(1, Some(Token::Key(Key::Ctrl(char::from(b'a' + byte - 1))))),
        [0x1c, ..] => Begins::With(1, Some(Token::Key(Key::Ctrl('\\')))),
        [byte, ..] if byte.is_ascii_control() => Begins::With(1, None),
        _ => match character(bytes) {
            Some((length, c)) => Begins::With(length, c.map(|c| Token::Key(Key::Char(c)))),
            None => Begins::Broken,
        },
    }
}

/// The first character and its length; what is no character is one byte of nothing, what is not whole nothing.
fn character(bytes: &[u8]) -> Option<(usize, Option<char>)> {
    let whole = &bytes[..bytes.len().min(4)];
    let valid = match std::str::from_utf8(whole) {
        Ok(text) => text,
        Err(error) if error.valid_up_to() > 0 => std::str::from_utf8(&whole[..error.valid_up_to()]).unwrap_or(""),
        Err(error) if error.error_len().is_none() && bytes.len() < 4 => return None,
        Err(_) => "",
    };
    Some(valid.chars().next().map_or((1, None), |c| (c.len_utf8(), Some(c))))
}

fn arrow(key: u8) -> Option<Token> {
    Some(Token::Key(match key {
        b'A' => Key::Up,
        b'B' => Key::Down,
        b'C' => Key::Right,
        b'D' => Key::Left,
        _ => return None,
    }))
}

/// `ESC [`, parameters, a last byte.
fn control(rest: &[u8]) -> Begins {
    // The function keys of Linux's console: the bracket is no last byte.
    if let [b'[', after @ ..] = rest {
        return if after.is_empty() { Begins::Broken } else { Begins::With(4, None) };
    }
    let Some(end) = rest.iter().position(|byte| !(0x20..=0x3f).contains(byte)) else { return Begins::Broken };
    let parameters = String::from_utf8_lossy(&rest[..end]);
    let numbers = |text: &str| text.split(';').filter_map(|number| number.parse().ok()).collect::<Vec<u32>>();
    let token = match (rest[end], parameters.strip_prefix('?')) {
        (key @ b'A'..=b'D', None) => arrow(key),
        (b'c', Some(attributes)) => Some(Token::Reply(Reply::Attributes(numbers(attributes)))),
        (b'y', Some(mode)) => match numbers(mode.trim_end_matches('$'))[..] {
            [mode, is] => Some(Token::Reply(Reply::Mode(mode, is))),
            _ => None,
        },
        (b't', None) => match numbers(&parameters)[..] {
            [6, height, width] => Some(Token::Reply(Reply::Cell([width, height]))),
            _ => None,
        },
        _ => None,
    };
    Begins::With(2 + end + 1, token)
}

/// A text up to `ESC \`, or BEL.
fn string(kind: u8, rest: &[u8]) -> Begins {
    let bell = rest.iter().position(|&byte| byte == 0x07);
    let end = rest.windows(2).position(|two| two == [ESCAPE, b'\\']);
    let (length, after) = match (bell, end) {
        (Some(bell), end) if end.is_none_or(|end| bell < end) => (bell, 1),
        (_, Some(end)) => (end, 2),
        (_, None) => return Begins::Broken,
    };
    let text = String::from_utf8_lossy(&rest[..length]);
    let reply = match kind {
        b'_' => text.strip_prefix('G').map(|answer| Reply::Kitty(answer.ends_with(";OK"))),
        b'P' => match (text.strip_prefix(">|"), text.strip_prefix("1$r").and_then(|set| set.strip_suffix('m'))) {
            (Some(version), _) => Some(Reply::Version(version.to_owned())),
            (None, Some(colours)) => Some(Reply::Colours(colours.to_owned())),
            (None, None) => None,
        },
        _ => None,
    };
    Begins::With(2 + length + after, reply.map(Token::Reply))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(bytes: &[u8]) -> Vec<Token> {
        Input::default().feed(bytes)
    }

    #[test]
    fn keys_are_told_apart() {
        use Key::{Char, Ctrl, Down, Escape, Left, Right, Up};
        let cases: [(&[u8], &[Key]); 9] = [
            (b"q ?", &[Char('q'), Char(' '), Char('?')]),
            (b"\x1b[A\x1b[B\x1bOC\x1b[D", &[Up, Down, Right, Left]),
            (b"\x1b[1;2A", &[Up]),
            (b"\x03\x1a\x0c\x1c", &[Ctrl('c'), Ctrl('z'), Ctrl('l'), Ctrl('\\')]),
            ("äé€🦀".as_bytes(), &[Char('ä'), Char('é'), Char('€'), Char('🦀')]),
            // With Alt, page up, F1 on the console, focus, no UTF-8.
            (b"\x1bq\x1b[5~\x1b[[A\x1b[I\xff+", &[Char('+')]),
            (b"\x1b\x1b[A", &[Escape, Up]),
            (b"\x1b[Mq", &[Char('q')]),
            (b"", &[]),
        ];
        for (bytes, expected) in cases {
            let expected: Vec<Token> = expected.iter().map(|key| Token::Key(*key)).collect();
            assert_eq!(keys(bytes), expected, "{bytes:?}");
            // The same, byte by byte.
            let mut input = Input::default();
            let slowly: Vec<Token> = bytes.iter().flat_map(|byte| input.feed(&[*byte])).collect();
            assert_eq!(slowly, expected, "{bytes:?}");
            assert!(!input.is_waiting(), "{bytes:?}");
        }
    }

    #[test]
    fn answers_are_no_keys_and_keys_between_them_are_kept() {
        let mut bytes = b"\x1b_Gi=31;OK\x1b\\k\x1bP>|tmux 3.4q\x1b\\\x1b[?2026;2$y\x1b[6;20;10t".to_vec();
        bytes.extend_from_slice(b"\x1bP1$r0;48:2::1:2:3m\x1b\\\x1b]11;rgb:0/0/0\x07\x1b[?62;4;22cq");
        let expected = [
            Token::Reply(Reply::Kitty(true)),
            Token::Key(Key::Char('k')),
            Token::Reply(Reply::Version("tmux 3.4q".to_owned())),
            Token::Reply(Reply::Mode(2026, 2)),
            Token::Reply(Reply::Cell([10, 20])),
            Token::Reply(Reply::Colours("0;48:2::1:2:3".to_owned())),
            Token::Reply(Reply::Attributes(vec![62, 4, 22])),
            Token::Key(Key::Char('q')),
        ];
        assert_eq!(keys(&bytes), expected);
        let mut input = Input::default();
        assert_eq!(bytes.iter().flat_map(|byte| input.feed(&[*byte])).collect::<Vec<_>>(), expected);
        assert_eq!(keys(b"\x1b_Gi=31;ENOTSUPPORTED:no q\x1b\\"), [Token::Reply(Reply::Kitty(false))]);
    }

    #[test]
    fn what_never_ends_is_given_up() {
        let mut input = Input::default();
        assert_eq!(input.feed(b"\x1b"), []);
        assert!(input.is_waiting());
        assert_eq!(input.give_up(), Some(Token::Key(Key::Escape)));
        assert_eq!(input.feed(b"\x1b]qqq"), []);
        assert_eq!(input.give_up(), None);
        assert_eq!(input.feed(b"j"), [Token::Key(Key::Char('j'))]);
        let long: Vec<u8> = b"\x1bP".iter().copied().chain(std::iter::repeat_n(b'q', LONGEST)).collect();
        assert_eq!(input.feed(&long), []);
        assert!(!input.is_waiting());
    }
}
