//! The reference with a picture behind the words of every entry.

use scene_format::{Example, examples};

/// The name of a picture, from the folder of the reference.
pub fn picture_of(title: &str) -> String {
    format!("reference/{}.png", title.replace("::", "-"))
}

/// The page with a picture behind the example of every entry, and the examples that are shown.
pub fn with_pictures(page: &str) -> (String, Vec<Example>) {
    let examples = examples();
    let (mut text, mut shown) = (String::new(), Vec::new());
    let (mut entry, mut block, mut is_code) = (None::<&str>, String::new(), false);
    for line in page.lines() {
        text += line;
        text.push('\n');
        if line.starts_with("```") {
            is_code = !is_code;
            // Behind the first block of an entry, which shows it.
            if !is_code && let Some(example) = entry.take().and_then(|kind| of_entry(&examples, kind, &block)) {
                let title = &example.title;
                text += &format!("\n![{}]({})\n", title.replace("::", " "), picture_of(title));
                shown.push(example.clone());
            }
            block.clear();
        } else if is_code {
            block += line;
            block.push('\n');
        } else if line.starts_with("## ") {
            entry = None;
        } else if let Some(heading) = line.strip_prefix("### ") {
            entry = Some(heading);
        }
    }
    (text, shown)
}

/// The example of a kind in which these words stand.
fn of_entry<'a>(examples: &'a [Example], kind: &str, words: &str) -> Option<&'a Example> {
    let of_kind = |example: &&Example| example.title.split_once("::").is_some_and(|(_, of)| of == kind);
    examples.iter().filter(of_kind).find(|example| example.ron.contains(words.trim()))
}
