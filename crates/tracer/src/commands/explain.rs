//! `tracer explain`: what a diagnostic's code means, or a word of the language.

use crate::args::ExplainArgs;
use crate::failure::{Failure, exit};
use scene_format::codes::{CODES, Entry, find};
use std::io::Write;
use std::process::ExitCode;

pub(super) fn run(args: &ExplainArgs) -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    match args.code.as_slice() {
        [] => {
            for code in CODES {
                writeln!(out, "{}  {}", code.code, code.title)?;
            }
            writeln!(
                out,
                "\n`tracer explain` with a code tells more; so it does with a word: `object` lists all shapes, \
                 `material` all\nmaterials, `texture`, `light`, `transform`, `layer` and `projection` theirs, and \
                 `camera.fov` is one field."
            )?;
        }
        words => {
            let whole = words.join(" ");
            // Several words are one, `depth of field`, or codes and words one after the other.
            let all = match told(&whole) {
                Some(text) => vec![text],
                None if words.len() > 1 => {
                    words.iter().map(|word| told(word).ok_or_else(|| unknown(&whole))).collect::<Result<_, _>>()?
                }
                None => return Err(unknown(whole.trim())),
            };
            out.write_all(all.join("\n").as_bytes())?;
        }
    }
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

/// What there is of a code, by its number too, or of a word.
fn told(asked: &str) -> Option<String> {
    let asked = asked.trim();
    let digits = asked.trim_start_matches(['E', 'W', 'e', 'w']);
    let kinds = match &asked[..asked.len() - digits.len()] {
        "" => &["E", "W"][..],
        "E" | "e" => &["E"],
        "W" | "w" => &["W"],
        _ => &[],
    };
    let codes: Vec<&Entry> = match digits.parse::<u16>().ok() {
        Some(number) => kinds.iter().filter_map(|kind| find(&format!("{kind}{number:04}"))).collect(),
        None => find(asked).into_iter().collect(),
    };
    if codes.is_empty() {
        return scene_format::explain_word(asked);
    }
    let text = |code: &&Entry| format!("{}: {}\n\n{}\n", code.code, code.title, unindented(code.text));
    Some(codes.iter().map(text).collect::<Vec<_>>().join("\n"))
}

fn unknown(asked: &str) -> Failure {
    // Of a short word that begins otherwise nobody would think.
    let alike = |near: &&str| asked.len() > 4 || near[..1].eq_ignore_ascii_case(asked.get(..1).unwrap_or(""));
    let tip = scene_format::nearest(asked, scene_format::words().iter().map(String::as_str))
        .filter(alike)
        .map_or(String::new(), |near| format!(" did you mean {near}?"));
    Failure::wrong(format!("there is no code and no word `{asked}`;{tip} `tracer explain` lists all codes"))
}

/// Doc comments begin each line with a space.
fn unindented(text: &str) -> String {
    text.trim_end().lines().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect::<Vec<_>>().join("\n")
}
