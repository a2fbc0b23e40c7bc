//! What other languages have in the middle of a scene: loops, and blocks of POV-Ray. Each is told once, with the way
//! here, and passed over.

use super::{Syntax, arithmetic, declarations};
use crate::codes;
use crate::css_colors;
use crate::diagnostic::{Diagnostic, Edit, Span};

/// A construct may have this many bytes: a file of opening brackets must not take quadratic time.
const LONGEST: usize = 4000;

/// A construct of another language.
pub(super) struct Construct {
    /// All that belongs to it.
    pub length: usize,
    /// What is underlined: its first words.
    head: usize,
    message: String,
    expected: &'static str,
    hint: String,
    /// What to write for all of it, where that is certain.
    mended: Option<String>,
}

impl Construct {
    /// What is said of it, where it stands at `span(start, end)`.
    pub fn fault(self, start: usize, span: impl Fn(usize, usize) -> Span) -> Diagnostic {
        let mut fault = Diagnostic::error(codes::OTHER_LANGUAGE, span(start, start + self.head), self.message)
            .expected(self.expected)
            .hint(self.hint);
        let whole = span(start, start + self.length);
        fault.edit = self.mended.map(|replacement| Edit { span: whole, replacement });
        fault
    }
}

/// The construct that a text begins with. Words of scenes begin with capitals, or have a `:` or `=` behind them.
pub(super) fn at_beginning(rest: &str, syntax: Syntax) -> Option<Construct> {
    if !rest.starts_with(|c: char| c.is_ascii_lowercase()) {
        return None;
    }
    let found = loop_of(rest, syntax).or_else(|| block(rest, syntax)).or_else(|| declaration(rest, syntax));
    let found = found.or_else(|| made_by_new(rest));
    found.or_else(|| color(rest)).or_else(|| conditional(rest))
}

/// `for i in 0..8 { .. }`, `while (..) { .. }`, and the end of a comprehension: `for i in range(8)`.
pub(super) fn loop_of(rest: &str, syntax: Syntax) -> Option<Construct> {
    let word = word(rest);
    if !matches!(word, "for" | "foreach" | "while" | "loop") {
        return None;
    }
    let after = &rest[word.len()..];
    let line = super::line_ahead(after, 0).trim_end();
    let is_loop = match word {
        "for" => line.contains(" in ") || line.contains(" of ") || line.contains(';') || line.trim().starts_with('('),
        "foreach" | "while" | "loop" => line.trim().starts_with('(') || line.ends_with('{'),
        _ => false,
    };
    if !is_loop || after.trim_start().starts_with([':', '=']) {
        return None;
    }
    // Its body follows on the line in braces; else it is the end of a comprehension, or a line of Python.
    let body = line.find('{');
    let head = match body {
        Some(open) => word.len() + line[..open].trim_end().len(),
        None => word.len() + comprehension(line),
    };
    let length = body.and_then(|open| closed(rest, word.len() + open)).unwrap_or(head);
    let (index, count) = counted(&line[..body.unwrap_or(line.len())]);
    let named = |join: &str| if index == "i" { String::new() } else { format!("index{join}\"{index}\", ") };
    let form = match syntax {
        Syntax::Ron => format!("Repeat(count: {count}, {}items: [..])", named(": ")),
        _ => syntax.of_toml(format!("{{ Repeat = {{ count = {count}, {}items = [..] }} }}", named(" = "))).into_owned(),
    };
    Some(Construct {
        length,
        head,
        message: "there are no loops here: a scene says what is, not what to do".to_owned(),
        expected: "items made by a rule, or copies by `placements`",
        hint: format!("write {form}; in its items \"={index}\" counts from 0"),
        mended: None,
    })
}

/// `new THREE.Mesh(geometry, material)`
fn made_by_new(rest: &str) -> Option<Construct> {
    let name = rest.strip_prefix("new ")?.trim_start();
    let open = rest.len() - name.len() + name.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'))?;
    // Vectors and colours are told with theirs; a kind of ours needs `new` left out.
    let class = rest[..open].rsplit_once('.').map(|(_, class)| class)?;
    let value = ["Vector", "Color", "Euler", "Quaternion"].iter().any(|head| class.starts_with(head));
    if value || !name.starts_with(|c: char| c.is_ascii_uppercase()) || !rest[open..].starts_with('(') {
        return None;
    }
    Some(Construct {
        length: closed(rest, open)?,
        head: open,
        message: "this is JavaScript: a scene says what is, not what to do".to_owned(),
        expected: "a kind with its fields, as Sphere(center: (0, 1, 0), radius: 1)",
        hint: "write the object itself: Box(size: 1, material: Diffuse(albedo: (0.8, 0.2, 0.2)))".to_owned(),
        mended: None,
    })
}

/// `hsl(200, 50%, 50%)`
pub(super) fn color(rest: &str) -> Option<Construct> {
    let begins = ["hsl", "hsv", "hsb"].iter().any(|name| rest.starts_with(name));
    let (hex, length) = begins.then(|| css_colors::function(rest)).flatten()?;
    Some(Construct {
        length,
        head: length,
        message: format!("colours are not written `{}(..)` here", word(rest)),
        expected: "red, green and blue from 0 to 1, or \"#rrggbb\"",
        hint: format!("write \"{hex}\""),
        mended: Some(format!("\"{hex}\"")),
    })
}

/// `if a then b else c`
fn conditional(rest: &str) -> Option<Construct> {
    let line = rest.starts_with("if ").then(|| super::line_ahead(rest, 0))?;
    let (body, length) = arithmetic::conditional(line)?;
    Some(Construct {
        length,
        head: length,
        message: "an expression stands between quotes".to_owned(),
        expected: "a text that begins with `=`",
        hint: format!("write \"={body}\""),
        mended: Some(format!("\"={body}\"")),
    })
}

/// The length of what belongs to the end of a comprehension.
fn comprehension(line: &str) -> usize {
    let mut depth = 0usize;
    let end = line.bytes().position(|byte| {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' if depth == 0 => return true,
            b')' | b']' => depth -= 1,
            b',' => return depth == 0,
            _ => {}
        }
        false
    });
    line[..end.unwrap_or(line.len())].trim_end().len()
}

/// The name that a loop's head counts by, and how often it runs.
fn counted(head: &str) -> (&str, String) {
    let name = head.trim_start_matches([' ', '(']);
    let name = ["let ", "int ", "var ", "auto "].iter().find_map(|kind| name.strip_prefix(kind)).unwrap_or(name);
    let name = word(name);
    let name = if name.is_empty() { "i" } else { name };
    let many = || "..".to_owned();
    let whole = |text: &str| text.trim().parse::<u64>().ok();
    let until = |from: u64, to: Option<u64>| to.and_then(|to| to.checked_sub(from)).map(|count| count.to_string());
    if let Some((from, to)) = head.split_once("..") {
        let from = whole(from.rsplit(' ').next().unwrap_or(""));
        let inclusive = to.starts_with('=');
        let to = whole(to.trim_start_matches('=')).map(|to| to + u64::from(inclusive));
        return (name, from.and_then(|from| until(from, to)).unwrap_or_else(many));
    }
    if let Some((_, inner)) = head.split_once("range(") {
        let numbers: Vec<Option<u64>> = inner.split(')').next().unwrap_or("").split(',').map(whole).collect();
        return match numbers[..] {
            [Some(to)] => (name, to.to_string()),
            [Some(from), to] => (name, until(from, to).unwrap_or_else(many)),
            _ => (name, many()),
        };
    }
    let below = head.split_once('<').and_then(|(_, to)| whole(to.split(';').next().unwrap_or("")));
    (name, below.map_or_else(many, |to| to.to_string()))
}

/// `sphere { <0, 1, 0>, 1 pigment { .. } }`, and `sphere { radius: 1 }`.
fn block(rest: &str, syntax: Syntax) -> Option<Construct> {
    let word = word(rest);
    let open = rest[word.len()..].find(|c: char| !c.is_whitespace()).map(|at| word.len() + at)?;
    if !rest[open..].starts_with('{') {
        return None;
    }
    let length = closed(rest, open)?;
    let inner = &rest[open + 1..length - 1];
    let known = SHAPES.iter().chain(POV).find(|(names, ..)| names.contains(&word));
    let shape = SHAPES.iter().any(|(names, ..)| names.contains(&word));
    let named = inner.contains([':', '"']);
    // What has names with colons is ours, in brackets of another kind; but no field is called as a shape is.
    let of_pov = inner.contains('<') || known.is_some() && !inner.trim().is_empty();
    if !shape && (named || !of_pov) {
        return None;
    }
    let hint = match (known, syntax) {
        (Some((_, ron, _)), Syntax::Ron) => format!("write {ron}"),
        (Some((.., toml)), _) => format!("write {}", syntax.of_toml(*toml)),
        (None, _) => "write what there is for it here: `tracer explain Object` lists the kinds of objects".to_owned(),
    };
    let (message, mended) = if shape && !inner.contains('<') && named {
        // Of a shape that there is: its kind stands before the bracket.
        let kind = known.and_then(|(_, ron, _)| ron.split_once('(')).map(|(kind, _)| kind);
        let kind = kind.filter(|kind| syntax == Syntax::Ron && kind.eq_ignore_ascii_case(word));
        let message = format!("an object is not written `{word} {{ .. }}`");
        (message, kind.map(|kind| format!("{kind}({inner})")))
    } else {
        (format!("this looks like POV-Ray: `{word} {{ .. }}`"), None)
    };
    Some(Construct {
        length,
        head: open + 1,
        message,
        expected: match syntax {
            Syntax::Ron => "Name(field: value, ..), with vectors as (x, y, z)",
            Syntax::Toml => "{ Name = { field = value } }, with vectors as [x, y, z]",
            Syntax::Json => "{ \"Name\": { \"field\": value } }, with vectors as [x, y, z]",
        },
        hint,
        mended,
    })
}

/// `Material "diffuse" "rgb reflectance" [ .5 .5 .5 ]`, a directive of pbrt with its parameters.
pub(super) fn directive_of_pbrt(rest: &str, syntax: Syntax) -> Option<Construct> {
    let word = word(rest);
    let (_, ron, toml) = PBRT.iter().find(|(names, ..)| names.contains(&word))?;
    let mut length = word.len();
    let mut texts = 0;
    while length < LONGEST {
        let after = &rest[length..];
        let blank = after.len() - after.trim_start().len();
        let next = &after[blank..];
        length += match next.bytes().next() {
            Some(b'"') => {
                texts += 1;
                blank + 2 + next[1..].find(['"', '\n']).filter(|end| next[1 + end..].starts_with('"'))?
            }
            Some(b'[') if texts > 0 => blank + closed(next, 0)?,
            Some(b'0'..=b'9' | b'.' | b'-') if texts > 0 && !after[..blank].contains('\n') => {
                blank + next.find(|c: char| c.is_whitespace() || matches!(c, ',' | ')' | ']')).unwrap_or(next.len())
            }
            _ => break,
        };
    }
    Some(Construct {
        length,
        head: length.min(super::line_ahead(rest, 0).trim_end().len()),
        message: format!("this looks like pbrt: `{word} \"..\"`"),
        expected: match syntax {
            Syntax::Ron => "Name(field: value, ..)",
            Syntax::Toml => "{ Name = { field = value } }",
            Syntax::Json => "{ \"Name\": { \"field\": value } }",
        },
        hint: match syntax {
            Syntax::Ron => format!("write {ron}"),
            _ => format!("write {}", syntax.of_toml(*toml)),
        },
        mended: None,
    })
    .filter(|_| texts > 0)
}

/// `let x = 3;`
fn declaration(rest: &str, syntax: Syntax) -> Option<Construct> {
    let (name, value, head, length) = declarations::declaration(rest)?;
    let hint = match syntax {
        Syntax::Ron => declarations::way(name, value),
        _ => format!("values with names stand in `vars`, and are used so: \"={name}\""),
    };
    Some(Construct {
        length,
        head,
        message: format!("`{}` is of another language", rest[..head].trim_end()),
        expected: "fields, and names with their values in `vars`",
        hint,
        mended: None,
    })
}

type Block = (&'static [&'static str], &'static str, &'static str);

/// Shapes as POV-Ray writes them, and what is written here, in RON and TOML.
const SHAPES: &[Block] = &[
    (&["sphere"], "Sphere(center: (x, y, z), radius: ..)", "{ Sphere = { center = [x, y, z], radius = .. } }"),
    (&["box"], "Box(center: (x, y, z), size: (x, y, z))", "{ Box = { center = [x, y, z], size = [x, y, z] } }"),
    (
        &["cylinder"],
        "Cylinder(from: (x, y, z), to: (x, y, z), radius: ..)",
        "{ Cylinder = { from = [x, y, z], to = [x, y, z], radius = .. } }",
    ),
    (
        &["cone"],
        "Cone(from: (x, y, z), to: (x, y, z), radius: .., tip_radius: ..)",
        "{ Cone = { from = [x, y, z], to = [x, y, z], radius = .., tip_radius = .. } }",
    ),
    (&["plane"], "Plane(point: (x, y, z), normal: (0, 1, 0))", "{ Plane = { point = [x, y, z], normal = [0, 1, 0] } }"),
    (&["disc"], "Disk(radius: ..)", "{ Disk = { radius = .. } }"),
    (&["mesh", "mesh2", "triangle"], "Mesh(file: \"shape.obj\")", "{ Mesh = { file = \"shape.obj\" } }"),
    (
        &["lathe", "sor"],
        "Lathe(profile: [(radius, y), ..], curve: CatmullRom)",
        "{ Lathe = { profile = [[radius, y], ..], curve = \"CatmullRom\" } }",
    ),
    (
        &["prism", "extrude"],
        "Extrude(outline: [[(x, y), ..]], depth: ..), which goes along z; its holes are more rings",
        "{ Extrude = { outline = [[[x, y], ..]], depth = .. } }, which goes along z; its holes are more rings",
    ),
    (&["polygon"], "Polygon(points: [(x, y, z), ..])", "{ Polygon = { points = [[x, y, z], ..] } }"),
    (
        &["height_field"],
        "HeightField(file: \"heights.png\", size: (x, y, z))",
        "{ HeightField = { file = \"heights.png\", size = [x, y, z] } }",
    ),
    (&["torus"], "Torus(radius: .., tube_radius: ..)", "{ Torus = { radius = .., tube_radius = .. } }"),
    (
        &["sphere_sweep"],
        "Tube(points: [(x, y, z), ..], radius: ..)",
        "{ Tube = { points = [[x, y, z], ..], radius = .. } }",
    ),
    (
        &["superellipsoid", "blob", "text", "isosurface", "bicubic_patch"],
        "Mesh(file: \"shape.obj\"): there is no such shape yet, so make a mesh of it, in OBJ, OFF, PLY, STL, glTF or \
         GLB",
        "{ Mesh = { file = \"shape.obj\" } }: there is no such shape yet, so make a mesh of it, in OBJ, OFF, PLY, STL, \
         glTF or GLB",
    ),
];

/// Other blocks of it.
const POV: &[Block] = &[
    (
        &["union", "merge"],
        "Union(objects: [..]), which has no inner walls, as `merge`",
        "{ Union = { objects = [..] } }, which has no inner walls, as `merge`",
    ),
    (&["intersection"], "Intersection(objects: [..])", "{ Intersection = { objects = [..] } }"),
    (
        &["difference"],
        "Difference(objects: [..]), the first without the others",
        "{ Difference = { objects = [..] } }, the first without the others",
    ),
    (&["object"], "Group(objects: [..])", "{ Group = { objects = [..] } }"),
    (
        &["light_source"],
        "SphereLight(center: (x, y, z), radius: .., power: ..) in `lights`",
        "{ SphereLight = { center = [x, y, z], radius = .., power = .. } } in `lights`",
    ),
    (
        &["camera"],
        "camera: Camera(position: (x, y, z), look_at: (x, y, z), fov: 40)",
        "camera = { position = [x, y, z], look_at = [x, y, z], fov = 40 }",
    ),
    (
        &["texture", "pigment", "finish", "material", "interior"],
        "material: Diffuse(albedo: (r, g, b)), or another kind of material",
        "material = { Diffuse = { albedo = [r, g, b] } }, or another kind of material",
    ),
    (&["background", "sky_sphere"], "background: (r, g, b)", "background = [r, g, b]"),
];

/// Directives of pbrt.
const PBRT: &[Block] = &[
    (
        &["Material", "MakeNamedMaterial", "NamedMaterial"],
        "Diffuse(albedo: (r, g, b)), or another kind of material",
        "{ Diffuse = { albedo = [r, g, b] } }, or another kind of material",
    ),
    (
        &["Shape"],
        "Sphere(center: (x, y, z), radius: ..), or another shape",
        "{ Sphere = { center = [x, y, z], radius = .. } }, or another shape",
    ),
    (
        &["AreaLightSource"],
        "the shape with `material: Emissive(radiance: ..)`",
        "the shape with `material = { Emissive = { radiance = .. } }`",
    ),
    (
        &["LightSource"],
        "SphereLight(center: (x, y, z), radius: .., power: ..) in `lights`",
        "{ SphereLight = { center = [x, y, z], radius = .., power = .. } } in `lights`",
    ),
    (
        &["Texture"],
        "Texture(file: \"picture.png\") where its colour stands",
        "{ Texture = { file = \"picture.png\" } } where its colour stands",
    ),
    (
        &["Camera"],
        "camera: Camera(position: (x, y, z), look_at: (x, y, z), fov: 40)",
        "camera = { position = [x, y, z], look_at = [x, y, z], fov = 40 }",
    ),
    (&["Film"], "image: Image(width: .., height: ..)", "image = { width = .., height = .. }"),
    (&["Sampler", "Integrator"], "render: Render(samples: ..)", "render = { samples = .. }"),
];

/// What is said of `#declare` and its like, in RON.
pub(super) fn directive(rest: &str) -> Option<(usize, &'static str)> {
    let word = word(rest.strip_prefix('#')?);
    let way = match word {
        "declare" | "local" | "define" => "write values with names into `vars`, and use them so: \"=2 * height\"",
        "include" | "import" => {
            "write `include: [\"materials.ron\"]` for values and materials, `Include(file: ..)` for objects"
        }
        "for" | "while" => "write `Repeat(count: 8, items: [..])`; in its items \"=i\" counts from 0",
        "if" | "ifdef" | "ifndef" | "else" | "switch" | "case" => {
            "an expression chooses by `if`: \"=if(i > 2, 1, 0.5)\""
        }
        "macro" => "write what is to be used many times into a file, and take it in by `Include(file: .., vars: {..})`",
        "end" | "endif" | "version" | "default" => "leave it out",
        _ => return None,
    };
    Some((1 + word.len(), way))
}

fn word(text: &str) -> &str {
    let end = text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(text.len());
    &text[..end]
}

/// Where the bracket is closed that opens at a byte; `None` where that is too far away.
pub(super) fn closed(text: &str, open: usize) -> Option<usize> {
    let (mut depth, mut quoted) = (0usize, false);
    for (at, byte) in text.bytes().enumerate().skip(open).take(LONGEST) {
        match byte {
            b'"' => quoted = !quoted,
            b'\n' => quoted = false,
            _ if quoted => {}
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(at + 1);
                }
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_are_told_with_their_counts() {
        for (written, hint) in [
            ("for i in 0..8 { Group() }", "Repeat(count: 8, items: [..])"),
            ("for k in 2..=8 { Group() }", "Repeat(count: 7, index: \"k\", items: [..])"),
            ("for i in range(5)]", "Repeat(count: 5, items: [..])"),
            ("for x in range(2, 5):\n", "Repeat(count: 3, index: \"x\", items: [..])"),
            ("for (let i = 0; i < 12; i++) { a() }", "Repeat(count: 12, items: [..])"),
            ("for i in list {}", "Repeat(count: .., items: [..])"),
        ] {
            let found = at_beginning(written, Syntax::Ron).expect(written);
            assert!(found.hint.contains(hint), "{written}: {}", found.hint);
        }
        let braces = at_beginning("for i in 0..2 { \"}\" { } } rest", Syntax::Ron).expect("a loop");
        assert_eq!(braces.length, "for i in 0..2 { \"}\" { } }".len());
        for scene in [
            "for: 1",
            "format: 2",
            "while",
            "sphere: { }",
            "camera {}",
            "materials { \"a\": 1 }",
            "vars {}",
            "objects { Sphere() }",
        ] {
            assert!(at_beginning(scene, Syntax::Ron).is_none(), "{scene}");
        }
    }
}
