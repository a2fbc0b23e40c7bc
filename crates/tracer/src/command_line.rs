//! Command lines as a shell reads them.

/// A word, in quotes where a shell would take it apart.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=,:@%+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// A text from a file that anybody may have made, as it can be shown: a terminal would take other signs for orders.
pub fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_when_they_must_be() {
        assert_eq!(quoted("scenes/fig4.ron"), "scenes/fig4.ron");
        assert_eq!(quoted("camera.fov=40"), "camera.fov=40");
        assert_eq!(quoted(""), "''");
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(printable("a\x1b[2J\n\u{9b}é"), "a\u{fffd}[2J\u{fffd}\u{fffd}é");
        assert_eq!(quoted("objects[2].radius=3"), "'objects[2].radius=3'");
    }
}
