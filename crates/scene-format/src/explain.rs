//! Words of the language, explained one by one: the pieces of the reference that tell of them.

use crate::examples::{lines, snippet};
use crate::expression;
use crate::read::{PICK, REPEAT, everyday, expected, squeezed, thing};
use crate::reference::reference;
use crate::schema::{StructDef, prose};
use std::fmt::Write;

/// A heading of the reference with what stands below it.
struct Piece<'r> {
    name: &'r str,
    /// The heading above it.
    of: Option<&'r str>,
    lines: Vec<&'r str>,
}

fn pieces(reference: &str) -> Vec<Piece<'_>> {
    let mut pieces: Vec<Piece<'_>> = Vec::new();
    let mut above = None;
    for line in reference.lines() {
        let heading =
            line.strip_prefix("### ").map(|name| (name, above)).or(line.strip_prefix("## ").map(|name| (name, None)));
        match (heading, pieces.last_mut()) {
            (Some((name, of)), _) => {
                if of.is_none() {
                    above = Some(name);
                }
                pieces.push(Piece { name, of, lines: Vec::new() });
            }
            (None, Some(piece)) => piece.lines.push(line),
            (None, None) => {}
        }
    }
    // Chapters of prose have names of several words, or tell of no word.
    pieces.retain(|piece| {
        !piece.name.contains(' ') && piece.name.starts_with(char::is_uppercase) && piece.name != "Expressions"
    });
    pieces
}

/// The cells of a row about a field: its name, what it takes, its default, what it means.
fn row(line: &str) -> Option<[String; 4]> {
    let cells: Vec<String> = line.strip_prefix("| `")?.strip_suffix(" |")?.split(" | ").map(plain).collect();
    let [name, takes, default, means] = <[String; 4]>::try_from(cells).ok()?;
    let takes = takes.replace("Words", "").replace("\\|", "|");
    Some([name.trim_end_matches('`').to_owned(), takes, default, means])
}

/// Text without Markdown's links.
fn plain(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(open) = rest.find('[') {
        let (before, link) = rest.split_at(open);
        let target = link.find("](#").and_then(|middle| Some((middle, middle + link[middle..].find(')')?)));
        out += before;
        rest = match target {
            Some((middle, end)) if !link[1..middle].contains('[') => {
                out += &link[1..middle];
                &link[end + 1..]
            }
            _ => {
                out += "[";
                &link[1..]
            }
        };
    }
    out + rest
}

/// All words of the language: structs, kinds and fields, each once.
pub fn words() -> Vec<String> {
    let reference = reference();
    let mut words: Vec<String> = Vec::new();
    for piece in pieces(&reference) {
        words.push(called(piece.name).to_owned());
        words.extend(piece.lines.iter().filter_map(|line| row(line)).map(|[name, ..]| name));
    }
    let of_bodies = [&PICK, &REPEAT].into_iter().flat_map(|body| body.fields.iter().map(|field| field.name));
    words.extend(of_bodies.map(str::to_owned));
    words.sort();
    words.dedup();
    words
}

/// What a word of the language means: `Sphere` with its fields, or `radius` wherever it stands; one of every day or of
/// another program, and one or many of a thing. `None`: there is no such word.
pub fn explain_word(word: &str) -> Option<String> {
    let reference = reference();
    let pieces = pieces(&reference);
    let word = word.trim();
    let mut forms = vec![word.to_owned()];
    // `depth of field` and `look-at`, `spheres`, `keyframe`.
    let same = squeezed(word);
    let words = words();
    let is_ours = words.iter().any(|known| known.eq_ignore_ascii_case(word));
    let like = words.into_iter().find(|known| known != word && squeezed(known) == same);
    // A word of ours in other letters comes before those of other programs.
    forms.splice(if is_ours { 1..1 } else { 0..0 }, like);
    forms.extend(word.strip_suffix('s').filter(|one| one.len() > 2).map(str::to_owned));
    if word.len() > 2 {
        forms.push(format!("{word}s"));
    }
    if let Some(told) = word.split_once('.').and_then(|(of, field)| of_one(of, field, &pieces)) {
        return Some(told);
    }
    // `camera.fov`, as `--set` has it. Of several words each is asked for by itself.
    let dotted = word.rsplit_once('.').filter(|_| !word.contains(' '));
    forms.extend(dotted.map(|(_, field)| field.to_owned()));
    forms.iter().find_map(|form| explained(form, &pieces))
}

/// `Sphere.radius`, a field of one thing alone.
fn of_one(of: &str, field: &str, pieces: &[Piece<'_>]) -> Option<String> {
    let piece = pieces.iter().find(|piece| called(piece.name).eq_ignore_ascii_case(of))?;
    let mut rows = piece.lines.iter().filter_map(|line| row(line));
    let [name, takes, default, means] = rows.find(|[name, ..]| name.eq_ignore_ascii_case(field))?;
    let of = called(piece.name);
    let mut told = format!("{name} of {of}: {takes}; {}.\n  {means}\n", said(&default));
    lines::field(&name, of).iter().for_each(|line| told += &format!("  As in: {line}\n"));
    Some(told)
}

fn explained(word: &str, pieces: &[Piece<'_>]) -> Option<String> {
    let mut out = String::new();
    // Choices first: `Object` is what is to be seen before it is a mapping.
    let is_it = |piece: &&Piece<'_>| called(piece.name).eq_ignore_ascii_case(word);
    let choices = pieces.iter().filter(|piece| piece.of.is_none());
    let found = choices.chain(pieces.iter().filter(|piece| piece.of.is_some())).filter(is_it);
    for piece in found {
        let of = piece.of.map_or(String::new(), |of| format!(", a kind of {}", called(of)));
        let apart = if out.is_empty() { "" } else { "\n" };
        let _ = writeln!(out, "{apart}{}{of}", called(piece.name));
        let mut blank = true;
        for line in &piece.lines {
            let shown = match row(line) {
                Some([name, takes, default, means]) => format!("  {name}: {takes}; {}. {means}", said(&default)),
                None if line.starts_with('|') => continue,
                None => plain(line),
            };
            if !(blank && shown.is_empty()) {
                let _ = writeln!(out, "{shown}");
            }
            blank = shown.is_empty();
        }
        out.truncate(out.trim_end().len());
        out.push('\n');
        if piece.of.is_none() {
            let kinds = kinds(piece.name, pieces);
            let is_shown = piece.lines.contains(&"```ron") || kinds.is_empty();
            let shown = pieces.iter().find(|kind| kind.of == Some(piece.name)).filter(|_| !is_shown);
            let words = shown.and_then(|kind| snippet(choice_of(piece.name), kind.name));
            words.iter().for_each(|words| out += &format!("\n```ron\n{words}\n```\n"));
            out += &kinds;
        }
    }
    // A field in small letters is no kind of that name: `albedo` and the layer `Albedo`.
    if !pieces.iter().any(|piece| called(piece.name) == word) {
        let mut apart = if out.is_empty() { "" } else { "\n" };
        for piece in pieces {
            for [name, takes, default, means] in piece.lines.iter().filter_map(|line| row(line)) {
                if name.eq_ignore_ascii_case(word) {
                    let of = called(piece.name);
                    let told = format!("{name} of {of}: {takes}; {}.\n  {means}\n", said(&default));
                    // Mappings of plane and of solid patterns have kinds of one name.
                    if out.contains(&told) {
                        continue;
                    }
                    out += &format!("{apart}{told}");
                    if let Some(line) = lines::field(&name, of) {
                        let _ = writeln!(out, "  As in: {line}");
                    }
                    apart = "";
                }
            }
        }
    }
    for body in [&PICK, &REPEAT] {
        if body.name.eq_ignore_ascii_case(word) {
            out.insert_str(0, &of_body(body, !out.is_empty()));
        }
        if let Some(field) = body.fields.iter().find(|field| field.name.eq_ignore_ascii_case(word)) {
            let apart = if out.is_empty() { "" } else { "\n" };
            let (name, of) = (field.name, body.name);
            let _ = writeln!(out, "{apart}{name} of {of}: {}.\n  {}", expected(field), prose(field.doc));
            lines::field(name, of).iter().for_each(|line| out += &format!("  As in: {line}\n"));
        }
    }
    let apart = if out.is_empty() { "" } else { "\n" };
    if let Some((call, does)) = expression::function(word) {
        let _ = writeln!(out, "{apart}{call}\n  {does}. It stands in expressions, as in \"={word}(..)\".");
        // `floor` is also what one stands on.
        thing(word).iter().for_each(|line| out += &format!("\n{line}\n"));
    } else if let Some(means) = expression::constant(word) {
        let _ = writeln!(out, "{apart}{word}, in expressions: {means}.");
    }
    if out.is_empty() {
        everyday(word).iter().for_each(|line| out += &format!("{line}\n"));
    }
    (!out.is_empty()).then_some(out)
}

/// What stands in place of any value or item.
fn of_body(def: &StructDef, more: bool) -> String {
    let mut out = format!("{}\n{}\n", def.name, prose(def.doc));
    for field in def.fields {
        let _ = writeln!(out, "  {}: {}. {}", field.name, expected(field), prose(field.doc));
    }
    lines::group(def.name).iter().for_each(|line| out += &format!("  As in: {line}\n"));
    out + if more { "\n" } else { "" }
}

/// The choice that a heading is of.
fn choice_of(heading: &str) -> &str {
    match heading {
        "Transform" => "TransformWords",
        "Texture" => "PatternWords",
        "Antialiasing" => "PixelFilter",
        name => name,
    }
}

/// What a heading is called in scenes.
fn called(heading: &str) -> &str {
    heading.strip_suffix("Words").unwrap_or(heading)
}

/// The kinds of a choice, a line each: a name, and the first sentence of what is told of it.
fn kinds(choice: &str, pieces: &[Piece<'_>]) -> String {
    let mut out = String::new();
    for kind in pieces.iter().filter(|piece| piece.of == Some(choice)) {
        let text = kind.lines.iter().find(|line| !line.is_empty()).map_or(String::new(), |line| plain(line));
        let first = text.split_inclusive(". ").next().unwrap_or("").trim_end();
        let head = if out.is_empty() { "\nKinds:\n" } else { "" };
        let _ = writeln!(out, "{head}  {}: {first}", kind.name);
    }
    if !out.is_empty() {
        out += "`tracer explain` with a kind's name tells more.\n";
    }
    out
}

fn said(default: &str) -> String {
    // Two pieces of code with words between them have no quotes around both.
    let default = default.replace('`', "");
    let default = default.as_str();
    if default == "see right" {
        return "may be left out".to_owned();
    }
    if default.starts_with("must") || default.starts_with("one of") {
        default.to_owned()
    } else {
        format!("default {default}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_and_fields_are_explained() {
        let sphere = explain_word("sphere").expect("a word");
        assert!(sphere.starts_with("Sphere, a kind of Object\n"), "{sphere}");
        assert!(sphere.contains("  radius: a length > 0") && !sphere.contains("| "), "{sphere}");
        let one = explain_word("Sphere.radius").expect("a word");
        assert!(one.starts_with("radius of Sphere: ") && !one.contains("SphereLight:"), "{one}");
        let radius = explain_word("radius").expect("a word");
        assert!(radius.contains("radius of Sphere: ") && radius.contains("radius of SphereLight: "), "{radius}");
        assert!(explain_word("Camera").expect("a word").contains("fov: "));
        assert!(explain_word("radus").is_none() && explain_word("").is_none());
        let material = explain_word("Material").expect("a word");
        assert!(material.contains("Kinds:\n  Diffuse: ") && material.contains("\n  Emissive: "), "{material}");
        assert!(explain_word("Object").expect("a word").starts_with("Object\n"));
        let albedo = explain_word("albedo").expect("a word");
        assert!(albedo.contains("a kind of Layer") && albedo.contains("albedo of Diffuse: "), "{albedo}");
        assert!(explain_word("Mapping").is_some_and(|text| text.starts_with("Mapping\n")));
        let lathe = explain_word("Lathe").expect("a word");
        assert!(lathe.contains("curve: Curve; default Linear, in TOML \"Linear\"."), "{lathe}");
        assert!(lathe.contains("v grows from 0 at the first point to 1"), "{lathe}");
    }

    #[test]
    fn the_manual_has_every_function() {
        let manual = crate::reference::reference();
        let (_, list) = manual.split_once("- Functions: ").expect("a list");
        let (list, _) = list.split_once("\n\n").expect("its end");
        let words: Vec<&str> = list.split(|letter: char| !letter.is_alphanumeric()).collect();
        for (name, _) in crate::expression::functions() {
            assert!(words.contains(&name), "{name}");
        }
    }

    #[test]
    fn functions_and_words_of_every_day_are_explained() {
        for (word, told) in [
            ("keyframes", "keyframes(t, t0, value0"),
            ("random", "the same for the same"),
            ("hsv", "hue"),
            ("blackbody", "what glows at that temperature"),
            ("Pick", "One of several values"),
            ("repeat", "Puts its items into the list"),
            ("index", "index of Repeat"),
            ("frame", "from 0"),
            ("sky", "`background`"),
            ("sun", "SphereLight"),
            ("plane", "Plane, a kind of Object"),
            ("blur", "depth_of_field"),
            ("window", "Difference"),
            ("Checker", "Checkerboard"),
            ("dof", "depth_of_field"),
            ("glow", "Emissive"),
            ("cube", "called Box here"),
            ("fog", "surfaces only"),
            ("pointlight", "SphereLight"),
            ("spheres", "Sphere, a kind of Object"),
            ("keyframe", "keyframes(t, t0, value0"),
            ("depth of field", "ThinLens: A thin lens"),
            ("Look-At", "look_at of Camera"),
            ("placement", "placements of Sphere"),
            ("spp", "`samples`"),
            ("bounce", "`max_bounces`"),
            ("table", "Group"),
            ("brightness", "exposure"),
            ("png", "-o picture.png"),
            ("video", "--frames"),
            ("grass", "Scatter"),
            ("zoom", "`fov`"),
            ("stairs", "Repeat("),
            ("vase", "Lathe("),
            ("leather", "BlinnPhong("),
            ("data", "len(data)"),
            ("fire", "Emissive("),
            ("svg", "Extrude("),
            ("planet", "Texture(file"),
            ("stars", "Environment("),
            ("sunset", "blackbody("),
            ("dice", "Intersection("),
            ("section", "Difference("),
            ("hollow", "`caps: false`"),
            ("rays", "Arrow"),
            ("chart", "Repeat"),
            ("json", "tracer convert"),
            ("golden", "tracer golden"),
            ("python", "import tracer"),
            ("ffmpeg", "-framerate"),
            ("bloom", "beyond its edge"),
            ("vignette", "corners"),
            ("cutaway", "`camera: Camera(near: 4)`"),
            ("variable", "`vars`"),
            ("list", "len(sizes)"),
            ("scale bar", "thin Box"),
            ("thumbnail", "--size 160x120"),
            ("shadow catcher", "there is no shadow catcher"),
            ("radiosity", "max_bounces"),
        ] {
            let text = explain_word(word).unwrap_or_default();
            assert!(text.contains(told), "{word}: {text}");
        }
    }

    #[test]
    fn every_word_is_explained() {
        let words = words();
        assert!(words.len() > 60, "{words:?}");
        let without = words.into_iter().filter(|word| {
            let text = explain_word(word).unwrap_or_default();
            assert!(!text.is_empty() && !text.contains("](#"), "{word}: {text}");
            // With an example.
            !text.contains("```ron\n") && !text.contains("  As in: ")
        });
        assert_eq!(without.collect::<Vec<_>>(), [""; 0]);
    }
}
