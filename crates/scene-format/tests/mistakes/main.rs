//! One mistake of a person gives one error, at its line: every scene of the repository, in all syntaxes, with
//! mistakes that people make, one at a time.

#[path = "../common/mod.rs"]
mod common;
mod site;

use common::{Random, errors};
use scene_format::{Diagnostic, Syntax, convert};
use site::{Change, Kind, Site, tokens};
use std::fmt::Write;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

struct Mistake {
    name: &'static str,
    syntax: Option<Syntax>,
    make: fn(&Site<'_>) -> Change,
}

const RON: Option<Syntax> = Some(Syntax::Ron);
const TOML: Option<Syntax> = Some(Syntax::Toml);
const JSON: Option<Syntax> = Some(Syntax::Json);
const ALL: Option<Syntax> = None;

macro_rules! mistakes {
    ($($syntax:ident $name:literal |$site:ident| $make:expr;)+) => {
        &[$(Mistake { name: $name, syntax: $syntax, make: |$site| $make },)+]
    };
}

/// `Some` when it holds.
fn when(holds: bool) -> Option<()> {
    holds.then_some(())
}

const MISTAKES: &[Mistake] = mistakes![
    // Signs.
    ALL "no comma" |s| { when(s.sign(0, &[","]) && !s.closes_next())?; s.becomes("") };
    ALL "two commas" |s| { when(s.sign(0, &[","]))?; s.becomes(",,") };
    RON "a semicolon for a comma" |s| { when(s.sign(0, &[","]))?; s.becomes(";") };
    TOML "a semicolon for a comma in TOML" |s| { when(s.sign(0, &[","]))?; s.becomes(";") };
    RON "= for :" |s| { when(s.sign(0, &[":"]))?; s.becomes(" =") };
    TOML ": for =" |s| { when(s.sign(0, &["="]))?; s.becomes(":") };
    ALL "no colon" |s| { when(s.sign(0, &[":", "="]))?; s.becomes("") };
    ALL "colon twice" |s| { when(s.sign(0, &[":", "="]))?; s.becomes(s.here().repeat(2)) };
    ALL "no value" |s| {
        when(s.sign(-1, &[":", "="]) && (s.is(0, Kind::Number, &[]) || s.is(0, Kind::Text, &[])))?;
        s.becomes("")
    };
    // Brackets.
    ALL "no closing bracket" |s| { when(s.sign(0, &[")", "]", "}"]))?; s.becomes("") };
    ALL "closed by another bracket" |s| {
        when(s.sign(0, &[")", "]", "}"]))?;
        s.becomes(match s.here() { ")" => "]", "]" => "}", _ => ")" })
    };
    ALL "opened by another bracket" |s| {
        when(s.sign(0, &["(", "["]) && !s.sign(-1, &["["]) && !s.sign(1, &["["]))?;
        s.becomes(if s.here() == "(" { "[" } else { "{" })
    };
    ALL "one closing bracket too many" |s| { when(s.sign(0, &[")", "]", "}"]))?; s.becomes(s.here().repeat(2)) };
    RON "no opening bracket" |s| { when(s.sign(0, &["(", "["]))?; s.becomes("") };
    RON "one opening bracket too many" |s| { when(s.sign(0, &["(", "["]))?; s.becomes(s.here().repeat(2)) };
    RON "braces of Rust" |s| {
        when(s.is_kind())?;
        let open = Site { index: s.index + 1, ..*s };
        let (from, to) = (s.token(1)?.at.clone(), s.tokens[open.close()?].at.clone());
        Some((from.start..to.end, format!(" {{{}}}", &s.text[from.end..to.start])))
    };
    RON "braces for a list" |s| {
        when(s.sign(0, &["["]) && s.is(1, Kind::Word, &[]))?;
        let (from, to) = (s.token(0)?.at.clone(), s.tokens[s.close()?].at.clone());
        Some((from.start..to.end, format!("{{{}}}", &s.text[from.end..to.start])))
    };
    RON "a list for names" |s| {
        when(s.sign(0, &["{"]) && s.is(1, Kind::Text, &[]))?;
        let (from, to) = (s.token(0)?.at.clone(), s.tokens[s.close()?].at.clone());
        Some((from.start..to.end, format!("[{}]", &s.text[from.end..to.start])))
    };
    ALL "a vector without brackets" |s| {
        when(s.is_vector())?;
        let inner = s.through(6)?;
        Some((inner.clone(), s.text[inner.start + 1..inner.end - 1].to_owned()))
    };
    TOML "round brackets" |s| {
        when(s.is_vector())?;
        let inner = s.through(6)?;
        Some((inner.clone(), format!("({})", &s.text[inner.start + 1..inner.end - 1])))
    };
    RON "a list without its brackets" |s| {
        when(s.sign(-1, &[":"]) && s.sign(0, &["["]) && s.is(1, Kind::Word, &[]))?;
        let open = Site { index: s.index + 2, ..*s };
        let (item, end) = (open.close()?, s.close()?);
        when(item + 1 == end || item + 2 == end)?;
        let (from, to) = (s.token(0)?.at.start, s.tokens[end].at.end);
        Some((from..to, s.text[s.token(1)?.at.start..s.tokens[item].at.end].to_owned()))
    };
    // Texts.
    ALL "no closing quote" |s| { when(s.is(0, Kind::Text, &[]))?; s.becomes(s.here().trim_end_matches('"')) };
    ALL "no opening quote" |s| {
        when(s.is(0, Kind::Text, &[]) && !s.here().starts_with("\"#"))?;
        s.becomes(s.here().trim_start_matches('"'))
    };
    RON "no quotes" |s| { when(s.is(0, Kind::Text, &[]))?; s.becomes(s.here().trim_matches('"')) };
    TOML "no quotes around a value" |s| {
        when(s.is(0, Kind::Text, &[]) && s.sign(-1, &["="]) && !s.here().starts_with("\"#"))?;
        s.becomes(s.here().trim_matches('"'))
    };
    TOML "a colour that is a comment" |s| {
        when(s.is(0, Kind::Text, &[]) && s.here().starts_with("\"#"))?;
        s.becomes(s.here().trim_matches('"'))
    };
    RON "single quotes" |s| { when(s.is(0, Kind::Text, &[]))?; s.becomes(s.here().replace('"', "'")) };
    ALL "quotes of a word processor" |s| {
        when(s.is(0, Kind::Text, &[]))?;
        s.becomes(format!("“{}”", s.here().trim_matches('"')))
    };
    ALL "backslashes in a path" |s| {
        when(s.is(0, Kind::Text, &[]) && s.here().contains("assets/"))?;
        s.becomes(s.here().replace('/', "\\"))
    };
    // Numbers.
    ALL "a number between quotes" |s| { when(s.is(0, Kind::Number, &[]))?; s.becomes(format!("\"{}\"", s.here())) };
    ALL "a unit" |s| { when(s.is(0, Kind::Number, &[]))?; s.becomes(format!("{}deg", s.here())) };
    ALL "a unit after a space" |s| { when(s.is(0, Kind::Number, &[]))?; s.becomes(format!("{} cm", s.here())) };
    ALL "a decimal comma" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().contains('.'))?;
        s.becomes(s.here().replace('.', ","))
    };
    ALL "two points" |s| {
        when(s.is(0, Kind::Number, &[]))?;
        s.becomes(format!("{}.5.1", s.here().split('.').next()?))
    };
    ALL "a sign apart" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().starts_with('-'))?;
        s.becomes(s.here().replacen('-', "- ", 1))
    };
    ALL "a letter for a digit" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().contains('0'))?;
        s.becomes(s.here().replacen('0', "O", 1))
    };
    TOML "no digit before the point" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().starts_with("0."))?;
        s.becomes(&s.here()[1..])
    };
    TOML "a leading zero" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().starts_with(|c: char| c.is_ascii_digit()))?;
        s.becomes(format!("0{}", s.here()))
    };
    ALL "one number short" |s| {
        when(s.is_vector())?;
        let end = s.token(4)?.at.start..s.token(5)?.at.end;
        Some((end, String::new()))
    };
    ALL "one number too many" |s| {
        when(s.is_vector())?;
        let last = s.token(5)?.at.clone();
        Some((last.end..last.end, ", 1".to_owned()))
    };
    ALL "a number for a vector" |s| {
        when(s.is_vector() && s.is(-2, Kind::Word, &["center", "position", "look_at", "axis"]))?;
        Some((s.through(6)?, "1".to_owned()))
    };
    // Names.
    ALL "a field with a capital" |s| {
        when(s.is_field() && s.index > 0 && !s.sign(-1, &["."]))?;
        let mut name = s.here().to_owned();
        name[..1].make_ascii_uppercase();
        s.becomes(name)
    };
    ALL "a field in capitals" |s| { when(s.is_field())?; s.becomes(s.here().to_uppercase()) };
    ALL "a field with a hyphen" |s| {
        when(s.is_field() && s.here().contains('_') && s.sign(1, &["="]))?;
        s.becomes(s.here().replace('_', "-"))
    };
    RON "a hyphen in RON" |s| { when(s.is_field() && s.here().contains('_'))?; s.becomes(s.here().replace('_', "-")) };
    ALL "a field in camel case" |s| {
        when(s.is_field() && s.here().contains('_'))?;
        let (first, second) = s.here().split_once('_')?;
        s.becomes(format!("{first}{}{}", second[..1].to_uppercase(), &second[1..]))
    };
    ALL "a plural" |s| { when(s.is_field() && !s.here().ends_with('s'))?; s.becomes(format!("{}s", s.here())) };
    RON "a singular" |s| { when(s.is_field() && s.here().ends_with('s'))?; s.becomes(s.here().trim_end_matches('s')) };
    ALL "a letter left out" |s| {
        when((s.is_field() || s.is_kind()) && s.here().len() > 4)?;
        s.becomes(format!("{}{}", &s.here()[..2], &s.here()[3..]))
    };
    ALL "a kind without a capital" |s| { when(s.is_kind())?; s.becomes(s.here().to_lowercase()) };
    RON "a kind between quotes" |s| { when(s.is_kind())?; s.becomes(format!("\"{}\"", s.here())) };
    ALL "a field twice" |s| {
        when(s.is_field() && (s.is(2, Kind::Number, &[]) || s.is(2, Kind::Text, &[])) && s.sign(3, &[","]))?;
        let mut field = s.through(2)?;
        // In JSON a quote stands before it.
        field.start -= usize::from(s.text[..field.start].ends_with('"'));
        Some((field.start..field.start, format!("{}, ", &s.text[field.clone()])))
    };
    RON "a field without its name" |s| {
        when(s.is_field() && s.is(2, Kind::Number, &[]) && !s.is(-2, Kind::Word, &["DropTo", "Scale"]))?;
        Some((s.token(0)?.at.start..s.token(1)?.at.end, String::new()))
    };
    RON "no opening bracket" |s| {
        when(s.is_kind() && s.sign(1, &["("]))?;
        let bracket = s.token(1)?.at.clone();
        Some((bracket, " ".to_owned()))
    };
    RON "a vector without its opening bracket" |s| { when(s.is_vector())?; s.becomes("") };
    // Comments.
    RON "# for //" |s| { when(s.is(0, Kind::Comment, &[]))?; s.becomes(s.here().replacen("//", "#", 1)) };
    TOML "// for #" |s| { when(s.is(0, Kind::Comment, &[]))?; s.becomes(s.here().replacen('#', "//", 1)) };
    RON "/ for //" |s| { when(s.is(0, Kind::Comment, &[]))?; s.becomes(s.here().replacen("//", "/", 1)) };
    ALL "-- for a comment" |s| {
        when(s.is(0, Kind::Comment, &[]))?;
        s.becomes(s.here().replacen(['/', '#'], "--", 1).replacen("--/", "--", 1))
    };
    // Lines of TOML.
    TOML "a table for an item of a list" |s| {
        when(s.sign(0, &["["]) && s.sign(1, &["["]) && s.is(2, Kind::Word, &[]) && s.sign(4, &["]"]))?;
        Some((s.through(4)?, format!("[{}]", &s.text[s.token(2)?.at.clone()])))
    };
    TOML "an item of a list for a table" |s| {
        when(s.sign(0, &["["]) && s.is(1, Kind::Word, &[]) && s.sign(2, &["]"]))?;
        when(s.index > 0 && !s.sign(-1, &["[", "="]))?;
        Some((s.through(2)?, format!("[[{}]]", &s.text[s.token(1)?.at.clone()])))
    };
    TOML "a comma at the end of a line" |s| {
        let end = s.tokens[s.index].at.end;
        when(s.text[end..].starts_with('\n') && !s.sign(0, &[",", "{", "["]) && !s.is(0, Kind::Comment, &[]))?;
        Some((end..end, ",".to_owned()))
    };
    TOML "a semicolon at the end of a line" |s| {
        let end = s.tokens[s.index].at.end;
        when(s.text[end..].starts_with('\n') && !s.sign(0, &[",", "{", "["]) && !s.is(0, Kind::Comment, &[]))?;
        Some((end..end, ";".to_owned()))
    };
    TOML "a kind as in RON" |s| {
        when(s.sign(0, &["{"]) && s.is(1, Kind::Word, &["Diffuse", "Mirror", "Transparent"]))?;
        when(s.sign(2, &["="]) && s.sign(3, &["{"]))?;
        let inner = Site { index: s.index + 3, ..*s };
        let (close, end) = (inner.close()?, s.close()?);
        let fields = &s.text[s.token(3)?.at.end..s.tokens[close].at.start];
        let kind = &s.text[s.token(1)?.at.clone()];
        Some((s.token(0)?.at.start..s.tokens[end].at.end, format!("{kind}({})", fields.trim())))
    };
    // JSON.
    JSON "a semicolon for a comma in JSON" |s| { when(s.sign(0, &[","]))?; s.becomes(";") };
    JSON "= for : in JSON" |s| { when(s.sign(0, &[":"]))?; s.becomes(" =") };
    JSON "a comma before a closing bracket" |s| {
        when(s.index > 0 && s.sign(0, &["]", "}"]) && !s.sign(-1, &["[", "{"]))?;
        let before = s.text[..s.token(0)?.at.start].trim_end().len();
        Some((before..before, ",".to_owned()))
    };
    JSON "a name without quotes" |s| {
        when(s.is_field() || s.is_kind())?;
        Some((s.with_quotes(), s.here().to_owned()))
    };
    JSON "a name in single quotes" |s| {
        when(s.is_field() || s.is_kind())?;
        Some((s.with_quotes(), format!("'{}'", s.here())))
    };
    JSON "a name without its first quote" |s| {
        when(s.is_field() || s.is_kind())?;
        Some((s.with_quotes(), format!("{}\"", s.here())))
    };
    JSON "a name without its last quote" |s| {
        when(s.is_field() || s.is_kind())?;
        Some((s.with_quotes(), format!("\"{}", s.here())))
    };
    JSON "a text in single quotes" |s| { when(s.is(0, Kind::Text, &[]))?; s.becomes(s.here().replace('"', "'")) };
    JSON "no quotes around a value in JSON" |s| {
        when(s.is(0, Kind::Text, &[]) && s.sign(-1, &[":"]))?;
        s.becomes(s.here().trim_matches('"'))
    };
    JSON "round brackets in JSON" |s| {
        when(s.is_vector())?;
        let inner = s.through(6)?;
        Some((inner.clone(), format!("({})", &s.text[inner.start + 1..inner.end - 1])))
    };
    JSON "a vector without its opening bracket in JSON" |s| { when(s.is_vector())?; s.becomes("") };
    JSON "a line comment" |s| {
        let end = s.tokens[s.index].at.end;
        when(s.text[end..].starts_with('\n'))?;
        Some((end..end, " // it's mine, isn't it".to_owned()))
    };
    JSON "a comment of Python" |s| {
        let end = s.tokens[s.index].at.end;
        when(s.text[end..].starts_with('\n'))?;
        Some((end..end, "  # mine".to_owned()))
    };
    JSON "a block comment" |s| { when(s.sign(0, &[","]))?; s.becomes("/* \"a\": 1, */,") };
    JSON "not a number" |s| { when(s.is(0, Kind::Number, &[]))?; s.becomes("NaN") };
    JSON "None for a number" |s| { when(s.is(0, Kind::Number, &[]))?; s.becomes("None") };
    JSON "no digit before the point in JSON" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().starts_with("0."))?;
        s.becomes(&s.here()[1..])
    };
    JSON "no digit after the point" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().bytes().all(|byte| byte.is_ascii_digit()))?;
        s.becomes(format!("{}.", s.here()))
    };
    JSON "a leading zero in JSON" |s| {
        when(s.is(0, Kind::Number, &[]) && s.here().starts_with(|c: char| c.is_ascii_digit()))?;
        s.becomes(format!("0{}", s.here()))
    };
    JSON "a plus sign" |s| {
        when(s.is(0, Kind::Number, &[]) && !s.here().starts_with('-'))?;
        s.becomes(format!("+{}", s.here()))
    };
    JSON "braces for a list in JSON" |s| {
        when(s.sign(0, &["["]) && s.sign(1, &["{"]))?;
        let (from, to) = (s.token(0)?.at.clone(), s.tokens[s.close()?].at.clone());
        Some((from.start..to.end, format!("{{{}}}", &s.text[from.end..to.start])))
    };
    JSON "a list for names in JSON" |s| {
        when(s.sign(0, &["{"]) && s.is(1, Kind::Word, &[]))?;
        let (from, to) = (s.token(0)?.at.clone(), s.tokens[s.close()?].at.clone());
        Some((from.start..to.end, format!("[{}]", &s.text[from.end..to.start])))
    };
    JSON "a field without its name in JSON" |s| {
        when(s.is_field() && s.is(2, Kind::Number, &[]))?;
        Some((s.with_quotes().start..s.token(1)?.at.end, String::new()))
    };
];

fn line(text: &str, at: usize) -> usize {
    text.as_bytes()[..at.min(text.len())].iter().filter(|&&byte| byte == b'\n').count()
}

/// Whether an error points at the line of the mistake, by itself or by its second place.
fn points_at(fault: &Diagnostic, broken: &str, at: usize) -> bool {
    let wanted = line(broken, at);
    let lines = |span: &scene_format::diagnostic::Span| {
        line(broken, span.start as usize)..=line(broken, (span.end as usize).max(span.start as usize + 1) - 1)
    };
    // What is missing at the end of a line is noticed where the next one begins.
    let next = broken[at.min(broken.len())..]
        .find(|c: char| !c.is_whitespace())
        .map_or(wanted, |skip| line(broken, at + skip));
    let seen = |span: &scene_format::diagnostic::Span| lines(span).contains(&wanted) || lines(span).contains(&next);
    // A bracket that is open at the end of the file is told where it was opened; that end has no second place.
    let (opened, noticed) =
        (fault.span.start as usize, fault.labels.first().map_or(broken.len(), |label| label.span.end as usize));
    if fault.code == "E0102" && (opened..noticed).contains(&at) {
        return true;
    }
    let ends = broken[at.min(broken.len())..].trim().is_empty() && fault.code == "E0102";
    ends || seen(&fault.span) || fault.labels.iter().any(|label| seen(&label.span))
}

/// Whether a bracket is told to be one too many, and nothing is wrong without it: of two in a row, on two lines, it may
/// be either.
fn may_go(fault: &Diagnostic, broken: &str, syntax: Syntax) -> bool {
    fault.code == "E0103"
        && fault.edit.as_ref().is_some_and(|edit| {
            let (start, end) = (edit.span.start as usize, edit.span.end as usize);
            errors(&format!("{}{}{}", &broken[..start], edit.replacement, &broken[end..]), syntax).is_empty()
        })
}

/// Expressions of all kinds, without `vars`.
const EXPRESSIONS: &str = r#"Scene(
    background: "=2*(1, 2, 3)/7",
    objects: [
        Sphere(center: (0, "=2*0.4", 0), radius: "=1/3 + 0.2", material: Diffuse(albedo: "=hsv(120, 0.5, 0.8)")),
        Group(objects: [Box(size: "=3*(1, 0.5, 1)")], transform: [Translate((0, "=sqrt(2)", 0)), Scale("=2^0.5")]),
        Repeat(count: "=2*3", items: [Box(center: "=i*(1, 0, 0)", size: 0.4,
            material: Pick(from: [Mirror(), Diffuse()], index: "=i"))]),
    ],
)
"#;

fn scenes() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut folders = vec![root.join("scenes"), root.join("golden"), root.join("crates/tracer/templates")];
    let mut found = vec![("expressions".to_owned(), EXPRESSIONS.to_owned())];
    while let Some(folder) = folders.pop() {
        let mut entries: Vec<_> = std::fs::read_dir(folder)
            .expect("a folder of scenes")
            .map(|entry| entry.expect("an entry").path())
            .collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "ron") {
                let text = std::fs::read_to_string(&path).expect("a scene");
                // Names that a scene gives itself are free: a mistake in one is told where it is used (`one_fault.rs`,
                // `broken`). The files that one includes do not lie beside it here.
                if text.contains("vars:") || text.contains("nclude") {
                    continue;
                }
                found.push((path.file_name().expect("a name").to_string_lossy().into_owned(), text));
            }
        }
    }
    found
}

/// How often a mistake was made, how often it was not one error at its place, and examples of that.
type Count = (usize, usize, String);

/// Makes each mistake at some places of a scene, in all syntaxes.
fn make_mistakes(name: &str, ron: &str, tries: usize, random: &mut Random) -> Vec<Count> {
    let mut counts = vec![Count::default(); MISTAKES.len()];
    let toml = convert(name, ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    let json = convert(name, ron, Syntax::Ron, Syntax::Json).expect("the scene is right");
    for (text, syntax) in [(ron, Syntax::Ron), (&toml, Syntax::Toml), (&json, Syntax::Json)] {
        // Without a quote TOML's own `=` and `,` are told from those of an expression by nobody.
        if syntax == Syntax::Toml && text.contains("\"=") {
            continue;
        }
        assert!(errors(text, syntax).is_empty(), "{name} in {} is right", syntax.name());
        let tokens = tokens(text, syntax);
        for (mistake, count) in MISTAKES.iter().zip(&mut counts) {
            if mistake.syntax.is_some_and(|only| only != syntax) {
                continue;
            }
            let mut sites: Vec<(Range<usize>, String)> =
                (0..tokens.len()).filter_map(|index| (mistake.make)(&Site { text, tokens: &tokens, index })).collect();
            for _ in 0..tries.min(sites.len()) {
                let (at, replacement) = sites.swap_remove(random.below(sites.len()));
                let broken = format!("{}{replacement}{}", &text[..at.start], &text[at.end..]);
                let found = errors(&broken, syntax);
                // A mistake may mean something: a plural that is a name, too.
                count.0 += 1;
                let is_right = |fault| points_at(fault, &broken, at.start) || may_go(fault, &broken, syntax);
                let right = matches!(found.as_slice(), [fault] if is_right(fault));
                if right {
                    continue;
                }
                count.1 += 1;
                let start = broken[..at.start].rfind('\n').map_or(0, |newline| newline + 1);
                let shown = broken[start..].lines().next().unwrap_or("");
                let _ = writeln!(count.2, "    {name} {}:{}: {shown}", syntax.name(), line(&broken, at.start) + 1);
                for fault in found.iter().take(4) {
                    let at = line(&broken, fault.span.start as usize) + 1;
                    let _ = writeln!(count.2, "        {at}: {} {}", fault.code, fault.message);
                }
            }
        }
    }
    counts
}

#[test]
fn one_mistake_is_one_error_at_its_line() {
    /// Sites that are tried of each mistake in each scene.
    const TRIES: usize = 3;
    let tries = std::env::var("SCENE_MISTAKES").map_or(TRIES, |tries| tries.parse().expect("a number of sites"));
    let scenes = scenes();
    assert!(scenes.len() > 100, "only {} scenes", scenes.len());
    let next = AtomicUsize::new(0);
    let work = || {
        let mut counts = vec![Count::default(); MISTAKES.len()];
        while let index = next.fetch_add(1, Ordering::Relaxed)
            && let Some((name, ron)) = scenes.get(index)
        {
            // By name, so that a scene more changes no other's.
            let seed = name.bytes().fold(0u64, |seed, byte| seed.wrapping_mul(257).wrapping_add(u64::from(byte)));
            let of_scene = make_mistakes(name, ron, tries, &mut Random(seed));
            add(&mut counts, of_scene);
        }
        counts
    };
    let mut counts = vec![Count::default(); MISTAKES.len()];
    std::thread::scope(|scope| {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running.into_iter().for_each(|thread| add(&mut counts, thread.join().expect("no panic")));
    });
    let mut report = String::new();
    for (mistake, (tried, wrong, examples)) in MISTAKES.iter().zip(&counts) {
        assert!(*tried > 0, "nowhere can one make the mistake \"{}\"", mistake.name);
        if *wrong > 0 {
            let shown: Vec<&str> = examples.lines().take(12).collect();
            let _ = writeln!(report, "{}: {wrong} of {tried}\n{}", mistake.name, shown.join("\n"));
        }
    }
    assert!(report.is_empty(), "not one error at the line of the mistake:\n{report}");
}

fn add(counts: &mut [Count], more: Vec<Count>) {
    for (count, (tried, wrong, examples)) in counts.iter_mut().zip(more) {
        count.0 += tried;
        count.1 += wrong;
        count.2 += &examples;
    }
}
