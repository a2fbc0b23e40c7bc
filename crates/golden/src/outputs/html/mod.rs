//! One page that shows a run: a single file that opens from disk, pictures and all, and asks nobody for anything.

use super::{counts, whole};
use crate::outcome::{Outcome, Verdict, accept_command};
use crate::picture::Rgb8;
use std::fmt::Write as _;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// What the page may do, for the browser: show the pictures that are in it.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// About so wide a picture is shown, each of its pixels being a whole number of the screen's.
const SHOWN_WIDTH: u32 = 384;

/// The page of a run. `colours` gives the false colours of FLIP from 0 to 1.
///
/// # Errors
/// When a picture has no pixels.
pub fn page(outcomes: &[Outcome], colours: &dyn Fn(f32) -> [u8; 3]) -> Result<String, png::EncodingError> {
    let [passed, failed] = counts(outcomes);
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
            content=\"width=device-width\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n<title>{failed} failed, {passed} \
         passed</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>Golden pictures: {failed} failed, {passed} \
         passed</h1>\n"
    );
    page += "<table>\n<thead><tr><th scope=\"col\">scene</th><th scope=\"col\">verdict</th><th scope=\"col\">what \
        came of it</th></tr></thead>\n<tbody>\n";
    // What asks for a person stands first.
    let failures = || outcomes.iter().enumerate().filter(|(_, outcome)| !outcome.verdict.passes());
    let passes = || outcomes.iter().enumerate().filter(|(_, outcome)| outcome.verdict.passes());
    for (k, outcome) in failures().chain(passes()) {
        let name = escaped(&format!("{}/{}", outcome.folder, outcome.name));
        let link = if is_shown(outcome) { format!("<a href=\"#scene-{k}\">{name}</a>") } else { name };
        let (class, word) = if outcome.verdict.passes() { ("good", "passes") } else { ("bad", "fails") };
        let what = escaped(&outcome.sentence());
        let _ = writeln!(page, "<tr><td>{link}</td><td class=\"{class}\">{word}</td><td>{what}</td></tr>");
    }
    page += "</tbody>\n</table>\n";
    for (k, outcome) in failures().chain(passes()).filter(|(_, outcome)| is_shown(outcome)) {
        section(&mut page, k, outcome, colours)?;
    }
    let _ = write!(page, "</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n");
    Ok(page)
}

/// There is nothing to see where both are the same.
fn is_shown(outcome: &Outcome) -> bool {
    outcome.verdict != Verdict::Equal
}

fn section(
    page: &mut String,
    k: usize,
    outcome: &Outcome,
    colours: &dyn Fn(f32) -> [u8; 3],
) -> Result<(), png::EncodingError> {
    let name = escaped(&format!("{}/{}", outcome.folder, outcome.name));
    let _ = writeln!(page, "<section id=\"scene-{k}\" aria-labelledby=\"name-{k}\">\n<h2 id=\"name-{k}\">{name}</h2>");
    let whole = whole(outcome);
    let tag = if whole.contains('\n') { "pre" } else { "p" };
    let _ = writeln!(page, "<{tag}>{}</{tag}>\n<div class=\"pictures\">", escaped(&whole));
    if let Some(expected) = &outcome.expected {
        figure(page, expected, "expected", "")?;
    }
    if let Some(actual) = &outcome.actual {
        figure(page, actual, "actual", "")?;
    }
    if let (Some(expected), Some(actual)) = (&outcome.expected, &outcome.actual)
        && expected.has_size_of(actual)
    {
        let _ = writeln!(
            page,
            "<figure style=\"width:{}px\"><div class=\"wipe\"><img alt=\"expected\" src=\"{}\"><img alt=\"actual\" \
            src=\"{}\"></div>\
             <input type=\"range\" min=\"0\" max=\"100\" step=\"any\" value=\"50\" aria-label=\"wipe of {name}: how \
             much of the expected picture shows\">\
             <figcaption>wipe: expected on the left, actual on the right</figcaption></figure>",
            shown_width(actual),
            data(expected)?,
            data(actual)?
        );
        figure(page, &actual.difference(expected).picture, "difference, times 8", "")?;
    }
    if let Some(flip) = &outcome.flip {
        let caption = format!("FLIP, what the eye sees: mean {:.4}, largest {:.4}", flip.mean, flip.max);
        figure(page, &flip.map, &caption, &scale(colours))?;
    }
    page.push_str("</div>\n");
    if matches!(outcome.verdict, Verdict::Missing | Verdict::Different { .. }) {
        let command = escaped(&accept_command(&outcome.folder, &outcome.name));
        let _ = writeln!(page, "<p>When it is right:</p>\n<pre>{command}</pre>");
    }
    if !outcome.scene.is_empty() {
        let _ =
            writeln!(page, "<details><summary>the scene</summary>\n<pre>{}</pre></details>", escaped(&outcome.scene));
    }
    page.push_str("</section>\n");
    Ok(())
}

fn shown_width(picture: &Rgb8) -> u32 {
    picture.width * (SHOWN_WIDTH / picture.width.max(1)).max(1)
}

/// A picture with what it shows below it, and below that what explains its colours.
fn figure(page: &mut String, picture: &Rgb8, caption: &str, legend: &str) -> Result<(), png::EncodingError> {
    let (width, caption) = (shown_width(picture), escaped(caption));
    let _ = writeln!(
        page,
        "<figure style=\"width:{width}px\"><img alt=\"{caption}\" \
            src=\"{}\"><figcaption>{caption}</figcaption>{legend}</figure>",
        data(picture)?
    );
    Ok(())
}

/// The colours of the FLIP map from 0 to 1, as a bar.
fn scale(colours: &dyn Fn(f32) -> [u8; 3]) -> String {
    let stop = |k: u8| {
        let [r, g, b] = colours(f32::from(k) / 8.0);
        format!("rgb({r} {g} {b})")
    };
    let stops: Vec<String> = (0..=8).map(stop).collect();
    format!("<div class=\"scale\" style=\"background:linear-gradient(90deg,{})\"></div>0 to 1", stops.join(","))
}

/// What has no place in a page becomes U+FFFD.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    text.replace(|c: char| c.is_control() && c != '\n' && c != '\t', "\u{fffd}")
}

/// The picture as the address of an image: a PNG in base 64.
fn data(picture: &Rgb8) -> Result<String, png::EncodingError> {
    Ok(format!("data:image/png;base64,{}", base64(&picture.png()?)))
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = chunk.iter().enumerate().fold(0u32, |word, (k, &byte)| word | u32::from(byte) << (16 - 8 * k));
        for digit in 0..4 {
            let known = digit <= chunk.len();
            text.push(if known { DIGITS[(word >> (18 - 6 * digit) & 63) as usize] as char } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn base64_is_that_of_the_rfc() {
        let vectors =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
        for (bytes, text) in vectors {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }
}
