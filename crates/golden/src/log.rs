//! `log.md`: why expected pictures are what they are.

/// The file's name.
pub const FILE: &str = "log.md";

/// What it begins with.
pub const HEAD: &str = "# Why golden pictures are what they are\n\nOne line per accepted picture, the newest last.\n\n";

/// The log with one more line, which it makes of the reason however many it has.
pub fn with_line(log: &str, name: &str, is_new: bool, reason: &str) -> String {
    let change = if is_new { "new" } else { "changed" };
    let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut text = if log.is_empty() { HEAD.to_owned() } else { log.to_owned() };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text + &format!("- {name} ({change}): {reason}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_each() {
        let log = with_line("", "a/b", true, " first\npicture ");
        assert_eq!(log, format!("{HEAD}- a/b (new): first picture\n"));
        assert_eq!(with_line("x", "c", false, "why"), "x\n- c (changed): why\n");
    }
}
