//! Whole files that are something else: a merge that was not finished, the other syntax, scenes of other programs.

use super::Syntax;
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};

/// What a wrong text is as a whole; asked only where it is wrong. What has an edit counts where that leaves less wrong.
pub(crate) fn whole(text: &str, syntax: Syntax) -> Option<Diagnostic> {
    let other = conflict(text).or_else(|| of_json(text, syntax)).or_else(|| language(text, syntax));
    other.or_else(|| wide_signs(text, syntax)).or_else(|| without_brackets(text, syntax))
}

/// Scenes of other programs in JSON, told by names that ours never have.
fn of_json(text: &str, syntax: Syntax) -> Option<Diagnostic> {
    // (what they are called, the names that tell them, what to do)
    const OTHERS: [(&str, &[&str], &str); 3] = [
        (
            "a dictionary of Mitsuba",
            &["type", "sensor", "integrator"],
            "scenes of other programs are not read; `tracer new scene.json` starts one",
        ),
        (
            "glTF",
            &["asset", "accessors", "bufferViews"],
            "a glTF file is read as a mesh: name it .gltf, and write { \"Mesh\": { \"file\": \"model.gltf\" } } in \
             `objects`",
        ),
        (
            "three.js",
            &["metadata", "geometries", "object"],
            "export the model as GLB, and write { \"Mesh\": { \"file\": \"model.glb\" } } in `objects`",
        ),
    ];
    let start = text.len() - text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
    if !text[start..].starts_with('{') {
        return None;
    }
    let has = |name: &&str| {
        let name = format!("\"{name}\"");
        text.match_indices(&name).any(|(at, _)| text[at + name.len()..].trim_start().starts_with(':'))
    };
    let (name, _, hint) = OTHERS.iter().find(|(_, names, _)| names.iter().all(has))?;
    let length = text[start..].lines().next().map_or(0, |line| line.trim_end().len());
    let span = Span { source: 0, start: start as u32, end: (start + length) as u32 };
    let message = format!("this looks like {name}, not a scene in {}", syntax.name());
    let fault = Diagnostic::error(codes::OTHER_LANGUAGE, span, message);
    Some(fault.expected("a scene in RON (.ron), TOML (.toml) or JSON (.json)").hint(*hint))
}

/// The fields of a scene in RON without the brackets around them, or `Scene: (`.
fn without_brackets(text: &str, syntax: Syntax) -> Option<Diagnostic> {
    // Longer ones are made by programs, and an edit would hold all of it.
    const LONGEST: usize = 1 << 20;
    let mut from = text.len() - text.trim_start_matches('\u{feff}').len();
    for line in text[from..].split_inclusive('\n') {
        if !line.trim().is_empty() && !line.trim().starts_with("//") {
            break;
        }
        from += line.len();
    }
    from += text[from..].len() - text[from..].trim_start().len();
    let body = text[from..].trim_end();
    let name = body.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next().filter(|name| !name.is_empty())?;
    let after = body[name.len()..].trim_start().strip_prefix(':')?;
    if syntax != Syntax::Ron || text.len() > LONGEST {
        return None;
    }
    let span = |start: usize, end: usize| Span { source: 0, start: start as u32, end: end as u32 };
    let colon = from + body.len() - after.len();
    let (at, message, hint, edit) = if name.eq_ignore_ascii_case("scene") && after.trim_start().starts_with('(') {
        let bracket = colon + after.len() - after.trim_start().len();
        let edit = Edit { span: span(from, bracket), replacement: "Scene".to_owned() };
        (span(from, colon), "a kind has no colon behind it", "write `Scene(`", edit)
    } else {
        let edit = Edit { span: span(from, from + body.len()), replacement: format!("(\n{body}\n)") };
        let at = span(from, from + name.len());
        (
            at,
            "the fields of a scene stand in brackets",
            "write `(` before the first one and `)` after the last one",
            edit,
        )
    };
    let mut fault =
        Diagnostic::error(codes::UNEXPECTED_CHARACTER, at, message).expected("(version: 1, objects: [..])").hint(hint);
    fault.edit = Some(edit);
    Some(fault)
}

/// Brackets, colons and the like as Chinese and Japanese keyboards write them, outside of texts and comments: told and
/// mended all at once, since where one is another is.
fn wide_signs(text: &str, syntax: Syntax) -> Option<Diagnostic> {
    const WIDE: [(char, char); 10] = [
        ('（', '('),
        ('）', ')'),
        ('［', '['),
        ('］', ']'),
        ('｛', '{'),
        ('｝', '}'),
        ('：', ':'),
        ('＝', '='),
        ('＂', '"'),
        // Told by itself where there are no others.
        ('，', ','),
    ];
    let plain = |sign: char| WIDE.iter().find(|(wide, _)| *wide == sign).map(|(_, plain)| *plain);
    if !text.contains(|sign| sign != '，' && plain(sign).is_some()) {
        return None;
    }
    let comment = if syntax == Syntax::Toml { "#" } else { "//" };
    let mut found: Vec<(usize, char)> = Vec::new();
    let mut begin = 0;
    for line in text.split_inclusive('\n') {
        let mut quoted = false;
        for (at, sign) in line.char_indices() {
            match sign {
                '"' => quoted = !quoted,
                '/' | '#' if !quoted && line[at..].starts_with(comment) => break,
                _ if !quoted && plain(sign).is_some() => found.push((begin + at, sign)),
                _ => {}
            }
        }
        begin += line.len();
    }
    let (&(first, sign), &(last, last_sign)) = (found.first()?, found.last()?);
    let span = |from: usize, to: usize| Span { source: 0, start: from as u32, end: to as u32 };
    let at = span(first, first + sign.len_utf8());
    let all = span(first, last + last_sign.len_utf8());
    let mut mended = String::new();
    let mut from = first;
    for &(at, sign) in &found {
        mended += &text[from..at];
        mended.extend(plain(sign));
        from = at + sign.len_utf8();
    }
    let mut signs: Vec<char> = found.iter().filter_map(|(_, sign)| plain(*sign)).collect();
    signs.sort_unstable();
    signs.dedup();
    let signs: Vec<String> = signs.iter().map(|sign| format!("`{sign}`")).collect();
    let message = format!("`{sign}` is a wide sign, which means nothing here");
    let mut fault =
        Diagnostic::error(codes::UNEXPECTED_CHARACTER, at, message).hint(format!("write plain {}", signs.join(", ")));
    fault.edit = Some(Edit { span: all, replacement: mended });
    Some(fault)
}

/// The marks that `git merge` leaves.
fn conflict(text: &str) -> Option<Diagnostic> {
    let mut at = 0;
    let mut marks: Vec<(&str, Span)> = Vec::new();
    for line in text.split_inclusive('\n') {
        let shown = line.trim_end();
        let span = Span { source: 0, start: at as u32, end: (at + shown.len()) as u32 };
        at += line.len();
        let next = ["<<<<<<<", "=======", ">>>>>>>"].get(marks.len());
        if let Some(next) = next.filter(|next| shown.strip_prefix(**next).is_some_and(|rest| !rest.starts_with('='))) {
            marks.push((next, span));
        }
    }
    let &[(_, first), (_, middle), (_, last)] = marks.as_slice() else { return None };
    Some(
        Diagnostic::error(codes::MERGE_CONFLICT, first, "a merge was not finished: these are its marks")
            .expected("one of the two versions")
            .hint("keep the lines of one version, and remove the three marks")
            .label(middle, "the other version begins")
            .label(last, "it ends here"),
    )
}

/// Another language, told by the first line that says something.
fn language(text: &str, syntax: Syntax) -> Option<Diagnostic> {
    let mut at = text.len() - text.trim_start_matches('\u{feff}').len();
    let mut lines = text[at..].split_inclusive('\n');
    let comment = |line: &str| {
        let pov = line.starts_with("#include") || line.starts_with("#declare") || line.starts_with("#version");
        line.is_empty() || line.starts_with("//") || line.starts_with('#') && !line.starts_with("#!") && !pov
    };
    let first = loop {
        let line = lines.next()?;
        if !comment(line.trim()) {
            break line.trim_end();
        }
        at += line.len();
    };
    let rest = &text[at + first.len()..];
    if let Some(fault) = include_before(text, at, first).filter(|_| syntax == Syntax::Ron) {
        return Some(fault);
    }
    let (name, hint) = match syntax {
        Syntax::Ron if is_toml(first) => ("TOML", Some("name the file .toml, or give `--syntax toml`")),
        Syntax::Toml if is_ron(first) => ("RON", Some("name the file .ron, or give `--syntax ron`")),
        Syntax::Toml if first.starts_with('{') => ("JSON", Some("name the file .json, or give `--syntax json`")),
        Syntax::Json if is_toml(first) => ("TOML", Some("name the file .toml, or give `--syntax toml`")),
        Syntax::Json if is_ron(first) => ("RON", Some("name the file .ron, or give `--syntax ron`")),
        _ => (of_others(first, rest)?, None),
    };
    let span = Span { source: 0, start: at as u32, end: (at + first.len()) as u32 };
    let mesh = name.contains("mesh").then_some("a mesh stands in a scene: Mesh(file: \"mesh.obj\")");
    let hint = hint.or(mesh).unwrap_or("scenes of other programs are not read; `tracer new scene.ron` starts one");
    Some(
        Diagnostic::error(codes::OTHER_LANGUAGE, span, format!("this looks like {name}, not {}", syntax.name()))
            .expected("a scene in RON (.ron), TOML (.toml) or JSON (.json)")
            .hint(hint),
    )
}

/// `include: "lib.ron"` on a line before the scene, which has it as a field.
fn include_before(text: &str, at: usize, first: &str) -> Option<Diagnostic> {
    let word = ["include", "import"].into_iter().find(|word| first.starts_with(word))?;
    let after = first[word.len()..].trim_start();
    let value = after.strip_prefix([':', '=']).unwrap_or(after).trim().trim_end_matches([',', ';']).trim_end();
    let list = match (value.starts_with('['), value.starts_with('"') && value.len() > 2 && value.ends_with('"')) {
        (true, _) if value.ends_with(']') => value.to_owned(),
        (false, true) => format!("[{value}]"),
        _ => return None,
    };
    let end = at + first.len();
    let gap = text[end..].len() - text[end..].trim_start().len();
    let scene = "Scene(";
    let begin = Some(end + gap).filter(|begin| text[*begin..].starts_with(scene))?;
    let span = |start: usize, end: usize| Span { source: 0, start: start as u32, end: end as u32 };
    let message = format!("`{word}` stands within `Scene(..)`, not before it");
    let mut fault = Diagnostic::error(codes::MIXED_FIELDS, span(at, end), message).expected("Scene(..)");
    let mended = format!("Scene(include: {list}, ");
    fault.hint = format!("write `Scene(include: {list}, ..)`");
    fault.edit = Some(Edit { span: span(at, begin + scene.len()), replacement: mended });
    Some(fault)
}

/// `[camera]`, `[[objects]]` or `fov = 40`.
fn is_toml(line: &str) -> bool {
    let line = line.split('#').next().unwrap_or("").trim_end();
    let word = |text: &str| {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || matches!(c, '_' | '.' | ' ');
        text.starts_with(|c: char| c.is_ascii_lowercase()) && text.chars().all(plain)
    };
    let header = line.strip_prefix('[').and_then(|line| line.strip_suffix(']'));
    let header = header.map(|line| line.strip_prefix('[').and_then(|line| line.strip_suffix(']')).unwrap_or(line));
    header.is_some_and(word)
        || line.split_once('=').is_some_and(|(key, value)| {
            let key = key.trim_end();
            word(key) && !key.contains(' ') && !value.starts_with('=')
        })
}

/// `Scene(`, `(` or `#![enable(..)]`.
fn is_ron(line: &str) -> bool {
    let line = line.trim_start();
    line.strip_prefix("Scene").is_some_and(|rest| rest.trim_start().starts_with('(') || rest.trim().is_empty())
        || line.starts_with('(')
        || line.starts_with("#![")
}

fn is_of_name(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '_' | '$' | '{' | '[')
}

/// The languages that scenes of other programs are written in.
fn of_others(first: &str, rest: &str) -> Option<&'static str> {
    const POV: [&str; 9] =
        ["camera", "sphere", "box", "plane", "light_source", "background", "global_settings", "union", "mesh2"];
    const PBRT: [&str; 11] = [
        "LookAt",
        "Camera",
        "Film",
        "Sampler",
        "Integrator",
        "WorldBegin",
        "AttributeBegin",
        "Shape",
        "Scale",
        "PixelFilter",
        "Transform",
    ];
    let word = first.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next().unwrap_or("");
    let after = first[word.len()..].trim_start();
    if first.starts_with("<?xml") || first.starts_with("<scene") {
        return Some("XML, as Mitsuba has it");
    }
    if first.starts_with("<!DOCTYPE") || first.starts_with("<html") {
        return Some("HTML");
    }
    let directive = ["#include", "#declare", "#version"].iter().any(|sign| first.starts_with(sign));
    if directive
        || POV.contains(&word) && (after.starts_with('{') || after.is_empty() && rest.trim_start().starts_with('{'))
    {
        return Some("POV-Ray");
    }
    const OPENSCAD: [&str; 13] = [
        "translate",
        "rotate",
        "scale",
        "mirror",
        "color",
        "cube",
        "sphere",
        "cylinder",
        "union",
        "difference",
        "intersection",
        "linear_extrude",
        "rotate_extrude",
    ];
    let called = OPENSCAD.contains(&word) && after.starts_with('(');
    let setting = ["$fn", "$fa", "$fs"].iter().any(|sign| first.starts_with(sign));
    let module = word == "module" && after.contains('(');
    if setting || module || called && (first.ends_with(';') || first.ends_with('{') || first.contains("])")) {
        return Some("OpenSCAD");
    }
    let argument = after.is_empty() || after.starts_with(|c: char| c == '"' || c == '-' || c.is_ascii_digit());
    if PBRT.contains(&word) && argument {
        return Some("pbrt");
    }
    if matches!(word, "v" | "vn" | "vt") && argument && !after.is_empty() || word == "mtllib" {
        return Some("a mesh in OBJ");
    }
    if first.starts_with("import ") || first.starts_with("from ") && first.contains(" import ") {
        return Some("Python");
    }
    if ["const", "let", "var", "function", "export"].contains(&word) && after.starts_with(is_of_name) {
        return Some("JavaScript");
    }
    let next = rest.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    let key = after.strip_prefix(':').filter(|value| value.is_empty() || value.starts_with(' '));
    let open = first.ends_with([',', '(', '[', '{']);
    let goes_on = next.starts_with(' ') || next.starts_with("- ") || next.contains(':') && !next.ends_with(',');
    if first == "---" || first.starts_with("%YAML") || !word.is_empty() && key.is_some() && !open && goes_on {
        return Some("YAML");
    }
    None
}
