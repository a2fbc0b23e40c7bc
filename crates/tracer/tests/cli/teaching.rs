//! Every command of `docs/teaching.md` is run, and what the page shows of their output is their output.

use crate::support::{Sandbox, repository};
use std::fs;

/// Fenced blocks of a page: their language and text.
fn blocks(page: &str) -> Vec<(String, String)> {
    let mut blocks: Vec<(String, String)> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        if let Some(language) = line.strip_prefix("```") {
            open = !open;
            if open {
                blocks.push((language.to_owned(), String::new()));
            }
        } else if open && let Some((_, text)) = blocks.last_mut() {
            *text += line;
            text.push('\n');
        }
    }
    blocks
}

#[cfg(unix)]
#[test]
fn the_page_is_true() {
    let page = fs::read_to_string(repository().join("docs/teaching.md")).expect("the page");
    let sandbox = Sandbox::new();
    for folder in ["scenes", "assets"] {
        std::os::unix::fs::symlink(repository().join(folder), sandbox.path(folder)).expect("a link");
    }
    let (mut commands, mut shown) = (0, 0);
    let mut last = String::new();
    for (language, text) in blocks(&page) {
        match language.as_str() {
            "sh" => {
                for line in text.lines() {
                    let line = line.replacen("tracer ", "\"$T\" ", 1);
                    last = sandbox.shell(&line).ends(0).out_text();
                    commands += 1;
                }
            }
            // Part of what the last command printed; lines that are left out are told by dots.
            "text" => {
                for part in text.split("...\n").map(str::trim_end).filter(|part| !part.is_empty()) {
                    assert!(last.contains(part), "this is not printed:\n{part}\nbut:\n{last}");
                    shown += 1;
                }
            }
            "ron" => {}
            other => panic!("a block of {other:?}"),
        }
    }
    assert!(commands >= 8 && shown >= 2, "{commands} commands, {shown} outputs");
}
