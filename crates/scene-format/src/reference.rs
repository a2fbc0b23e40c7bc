//! The reference of the scene language and of its diagnostics, as Markdown: made from the same schema that the reader
//! goes by.

use crate::codes::CODES;
use crate::desc::Scene;
use crate::examples::{CHOICES, lines, snippet};
use crate::form::Form;
use crate::print::{ron_value, toml_value};
use crate::read::expected;
use crate::schema::{Content, EnumDef, FieldDef, StructDef, Type, prose};
use std::fmt::Write;

const INTRODUCTION: &str = "\
# The scene language

<!-- Generated from the types in crates/scene-format/src/desc by UPDATE_EXPECT=1 cargo test -p scene-format; a test
     fails when it differs. -->

A scene is one file, in RON (`.ron`), TOML (`.toml`) or JSON (`.json`), with the same words in all three:

```ron
Scene(
    lights: [SphereLight(center: (3, 4, 5), radius: 1, radiance: 20)],
    materials: { \"red\": Diffuse(albedo: (0.8, 0.1, 0.1)) },
    objects: [Sphere(center: (0, 0, 0), radius: 1, material: \"red\")],
)
```

```toml
[materials]
red = { Diffuse = { albedo = [0.8, 0.1, 0.1] } }

[[lights]]
SphereLight = { center = [3, 4, 5], radius = 1, radiance = 20 }

[[objects]]
Sphere = { center = [0, 0, 0], radius = 1, material = \"red\" }
```

```json
{
    \"materials\": { \"red\": { \"Diffuse\": { \"albedo\": [0.8, 0.1, 0.1] } } },
    \"lights\": [{ \"SphereLight\": { \"center\": [3, 4, 5], \"radius\": 1, \"radiance\": 20 } }],
    \"objects\": [{ \"Sphere\": { \"center\": [0, 0, 0], \"radius\": 1, \"material\": \"red\" } }]
}
```

RON is made for people, TOML for those who have editors for it, JSON for [programs](#from-programs).

- Numbers: `3`, `-0.25`, `1.5e3`, and `1_000` but in JSON; a whole number may stand where any number may.
- Vectors: `(x, y, z)` or `[x, y, z]`; in TOML and JSON `[x, y, z]`.
- Colours: `(r, g, b)` linear RGB, one number for grey, or `\"#rrggbb\"` (sRGB). Where a texture may stand, too, \
another text is [the name of one](#textures-by-name).
- Kinds: `Name(field: value)` in RON, `{ Name = { field = value } }` in TOML, `{ \"Name\": { \"field\": value } }` in \
JSON; kinds without
  fields are `Name`, and in TOML and JSON `\"Name\"`. What is said of values in TOML below holds in JSON, too, where \
`null` is `\"None\"`.
- Angles are in degrees, lengths in the scene's own unit, paths relative to the scene file.
- Comments: `//` and `/* */` in RON, `#` in TOML, none in JSON.
- No field is called `repeat`, `keyframes`, `for` or `let`: these words are kept for later versions.
- `--set path=value` sets any field from the command line, the value in RON: `--set camera.fov=40`,
  `--set 'materials.red=Mirror()'`, `--set objects[0].radius=2`. An object or a light with a `name` that no other has \
is found by it,
  in groups, too: `--set objects.lamp.radius=2`, `--set objects.\"left leg\".size=2`. What begins with a second `=` is
  an expression, `--set 'camera.fov==30+5'`; a new name is added to `vars`, `materials`, `textures` or `cameras`.

## Expressions

A text that begins with `=` stands for a number, a vector, a colour or a truth value, wherever one may stand; `vars` \
names values for them:

```ron
Scene(
    background: 1,
    vars: { \"height\": 0.75, \"leg\": 0.06, \"wood\": \"#804020\", \"corner\": (0.5, \"=height/2\", 0.3) },
    objects: [
        Box(center: (0, \"=height\", 0), size: (1.2, 0.05, 0.8), material: Diffuse(albedo: \"=wood\")),
        Box(center: \"=corner\", size: (\"=leg\", \"=height\", \"=leg\")),
        Box(center: \"=corner*(-1, 1, -1)\", size: (\"=leg\", \"=height\", \"=leg\")),
    ],
)
```

- `vars` stand in any order and may use each other; `--set vars.height=1` sets one from the command line.
- A list of points, numbers or colours stands by its name, too, wherever such a list may stand: `vars: { \"profile\": \
[(0.5, 0), (0.3, 1), (0, 1.2)] }` and
  `Lathe(profile: \"=profile\")`, in as many shapes as use it; `list[0]` is its first item, `len(list)` says how many \
there are.
- `+ - * / % ^`, comparisons, `&& || !`; `%` has the divisor's sign; `-2^2` is -4. Vectors go component by component, \
also with
  numbers; `p.x`, `c.r` and `list[0]` are their parts.
- Functions: `abs sign floor ceil round sqrt exp log`, `sin cos tan asin acos atan atan2(y, x)` in degrees, `min max \
clamp(x, low, high)
  mix(a, b, t) step(edge, x) smoothstep(low, high, x)`, `keyframes(t, t0, value0, t1, value1, ..)`
  (linear between rising times, the first or last value outside), `length normalize dot cross`, `hsv(hue, saturation, \
value)` (as screens have it: grey of value 0.5 is \"#808080\", which is 0.214),
  `blackbody(kelvin)` (the colour of what glows at 500 to 40000 K, of luminance 1),
  `random(n, ..)` (0 to 1, the same for the same one to four numbers), `len(list)`, `if(condition, a, b)`, \
where what is not chosen may have no value (`if(i > 0, 1/i, 0)`; so behind `&&` and `||`); `pi`;
  `frame` and `time` of the [animation](#animation).

`Repeat`, an item of any list, puts its items into the list so many times; `i`, or what `index` says, counts from 0:

```ron
Scene(
    background: 1,
    objects: [
        Repeat(count: 12, vars: { \"turn\": \"=30*i\" }, items: [
            Sphere(center: \"=3*(cos(turn), 0, sin(turn))\", radius: \"=0.2 + 0.02*i\", material: Diffuse(albedo: \
\"=hsv(turn, 0.6, 0.9)\")),
        ]),
        Box(size: 0.2, placements: [Repeat(count: 5, index: \"k\", items: [[Translate((\"=k - 2\", 0, 0))]])]),
    ],
)
```

- `count` up to a million, `vars` reckoned anew each time, `Repeat`s within each other up to eight deep. Names within \
hide those around.
- `Pick(from: [..], index: ..)` stands for one of its values, any kind of value, counted from 0; after the last the \
first follows again:
  `material: Pick(from: [\"red\", \"blue\"], index: \"=i\")`. Those that are not picked are not read.
- A list in `vars` may be made so, for all that go by it:
  `vars: { \"spiral\": [Repeat(count: 50, items: [\"=0.1*sqrt(i)*(cos(137.5*i), 0, \
sin(137.5*i))\"])] }`, `Tube(points: \"=spiral\", radius: 0.01)`.
- With a count of 0 its items are not read. `--set` reaches nothing within; it sets the `vars` that it goes by.
- Expressions are never read in names, files and kinds. They have no loops and end always; the same values on every \
machine.

## Textures by name

`textures` gives names to textures, and to colours, as `materials` does to materials. Wherever a colour or a number \
may be a texture, the name may stand, in
other textures too:

```ron
Scene(
    background: 1,
    textures: {
        \"clay\": Noise(a: \"#5c1f12\", b: \"#c46a4a\", mapping: Object(scale: 3)),
        \"bricks\": Lines(a: 0.6, b: \"clay\", width: 0.08, mapping: Triplanar(scale: 5)),
    },
    materials: { \"wall\": Diffuse(albedo: \"bricks\") },
    objects: [
        Box(size: (3, 1, 0.2), material: \"wall\"),
        Sphere(center: (0, 0.8, 0), radius: 0.3, material: Diffuse(albedo: Mix(a: \"bricks\", b: \"clay\"))),
    ],
)
```

- A text that begins with `#` is a colour, one that begins with `=` an expression, any other a name: no texture's name \
begins so.
- A name is what stands at it, as if that were written in its place: the picture is the same to the byte, and where a \
number is wanted a
  picture is read as numbers. They stand in any order and may use each other, but not in a circle; what is within \
each other to sixteen deep counts through names.
- Colours in `textures` go from 0 to 1. Where larger numbers are wanted, multiply: \
`exponent: Multiply(a: \"clouds\", b: 1000)`.
- `--set textures.bricks.width=0.1` sets a part of one.

## Groups and other files

A `Group` is moved and copied as one; what has no material in it takes the group's:

```ron
Scene(
    background: 1,
    objects: [
        Group(name: \"chairs\", material: Diffuse(albedo: \"#804020\"), placements: Ring(count: 4, radius: 1), \
objects: [
            Box(center: (0, 0.45, 0), size: (0.45, 0.05, 0.45)),
            Box(center: (0, 0.75, 0.2), size: (0.45, 0.3, 0.04)),
            Group(placements: Grid(count: (2, 1, 2), spacing: (0.38, 1, 0.38)), objects: [
                Cylinder(from: (0, 0, 0), to: (0, 0.45, 0), radius: 0.02),
            ]),
        ]),
    ],
)
```

- An object's own `transform` and `placements` come first, then those of the group around it, then those of the group \
around that: up to
  sixteen deep, and a hundred million objects in all, copies counted. Copies of meshes share their triangles as they \
do elsewhere.
- Turns and scales of a group without `about` are about the origin. Its `lights` are moved and copied with it. \
`DropTo`, `CenterTo` and `FitTo` go by all that stands in
  it: a table of boxes comes to stand on the floor by one `DropTo(0)`.

`include: [\"house.ron\"]` at the scene's top takes `vars`, `textures`, `materials`, `cameras` and settings of other \
files. Among the \
objects, `Include(file: \"chair.ron\", vars: {
\"height\": 0.5 }, materials: { \"seat\": \"oak\" }, placements: Ring(count: 4, radius: 1))` takes another scene's \
objects and lights.

- Names of the including file win against those of `include`, and of two files those of the later; all expressions of \
the files see the `vars` that won, those of `--set`, too. Materials and textures of a file keep the textures that it \
names itself.
- Settings, `image`, `render`, `effects`, `output` and `background`, are taken field by field where the scene itself \
says nothing: six figures of one style include one file that says how large they are and how they are rendered. A file \
that is included has no `camera` (but `cameras`), no `animation`, no `objects` and `lights`, which is told.
- An `Include` has names of its own: it sees no `vars`, textures and materials of this scene, nor \
this scene its. `vars` and \
`materials` give names that
  it has other values. Its camera, picture, background and settings are not taken.
- Files may be in any syntax, whatever this one is. Paths in a file start from its own folder. Files may include \
others, eight deep, 256 in all, and
  not themselves. Messages say where a file is included; `tracer preview` renders again when one changes.

## Placements files

`placements: \"copies.txt\"` takes many copies of an object from a text file, one a line. Numbers are parted by blanks \
or commas, `#` begins a
comment, empty lines are passed over. How many numbers stand on a line says what they are:

| numbers | placement |
|---|---|
| 3 | moves by `x y z` |
| 4 | moves by `x y z`, after scaling by one factor |
| 8 | moves by `x y z`, after scaling by one factor, after that turned about an axis (three numbers, any length) by an \
angle in degrees |
| 12 | a matrix of 3 rows and 4 columns, row by row; the last number of each row moves |

```text
# x y z, factor, axis, degrees
0 0 0
2 0 0   0.5
4 0 0   1   0 1 0  45
1 0 0 6  0 1 0 0  0 0 1 0
```

A placement scales, then turns, then moves, all about the origin, and comes after the object's own `transform`.

## Materials of OBJ files

A mesh from an OBJ file without a `material` in the scene has those of its MTL file:

| MTL | material |
|---|---|
| `Ke` not black | `Emissive(two_sided: true)`: `radiance` is `Ke`; what shines so reflects nothing |
| else `illum` 4, 6, 7 or 9, or `d` below 1 (or `Tr` above 0 without `d`) | `Transparent`: `ior` is `Ni` (1.5 where \
there is none), `transmittance` is `Tf` |
| else `illum` 3 or 5, and `Ks` not black | `Mirror`: `reflectance` is `Ks` (1 where there is none) |
| else `Ks` not black and `Ns` above 0, `illum` neither 0 nor 1 | `BlinnPhong`: `albedo` is `Kd` + `Ks`, `specular` \
the share of `Ks` in it, `exponent` is `Ns` |
| else | `Diffuse`: `albedo` is `Kd` (0.8 where there is none) |

`map_Kd` replaces the albedo by a picture. Colours are linear RGB. `Ka` is passed over, since light from all around is \
computed here. All
else (other maps, `d` between 0 and 1) is not taken, and W0511 says so once for a mesh, with the materials' \
names. Of a
mesh in so many copies that they share their triangles (`instances`) none shines by `Ke`, which W0511 tells, too.

Glass needs to know where its inside is: seen from outside, the corners of a face go round counterclockwise (W0305 \
tells of meshes that
are inside out).

## From programs

A program writes a scene as JSON and calls `tracer`. In Python:

```python
import json
import math
import subprocess

balls = [
    {\"Sphere\": {
        \"center\": [3 * math.cos(k), 0, 3 * math.sin(k)],
        \"radius\": 0.5,
        \"material\": {\"Diffuse\": {\"albedo\": [0.8, 0.1 * k, 0.1]}},
    }}
    for k in range(6)
]
scene = {
    \"camera\": {\"position\": [0, 4, 8]},
    \"render\": {\"samples\": 16},
    \"background\": 1,
    \"objects\": balls,
}
with open(\"balls.json\", \"w\") as file:
    json.dump(scene, file)
subprocess.run([\"tracer\", \"render\", \"balls.json\", \"-o\", \"balls.png\"], check=True)
```

`tracer render - -o balls.png` takes the scene from standard input. What is wrong with it is told with its line and \
column, as in any
scene; `--diagnostics json` says so to programs. Where a field may be `None`, `null` is that; elsewhere it is a fault: \
leave the field out
to get its default.

In Rust, `SceneDesc` of the crate `scene-format` and all that is in it are `Serialize` and `Deserialize`: \
`serde_json`, `ron` and `toml` write
scenes that `tracer` reads, and read those that include no others.

## In an editor

`tracer lsp` is a language server for scenes in all syntaxes ([how](editors.md)). Without it:

`tracer schema > scene.schema.json` writes a JSON Schema (draft-07) with all descriptions, defaults and ranges. With
[taplo](https://taplo.tamasfe.dev) (the extension Even Better TOML in VS Code; its language server in others) an \
editor completes the
words of a TOML scene, explains them and marks what is wrong, if the scene's first line names the schema:

```toml
#:schema ./scene.schema.json
```

On the command line `taplo check scene.toml` says the same. A JSON scene names it by `\"$schema\": \
\"./scene.schema.json\"`, which most
editors know. For RON, and for what a schema cannot tell (names that are missing, files),
an editor can run `tracer check scene.ron --diagnostics json`: one JSON object a line, with the bytes, lines and \
columns of each fault
and of the edit that mends it.
";

/// `docs/scene-reference.md`: every field, kind, default, unit and range.
pub fn reference() -> String {
    let mut out = INTRODUCTION.to_owned();
    let mut done = Done::default();
    section(&mut out, &Scene::DEF, &mut done);
    out
}

/// `docs/diagnostics.md`: every code with its explanation.
pub fn diagnostics_reference() -> String {
    let mut out = "\
# Diagnostics

This file is generated from `crates/scene-format/src/codes.rs`; a test fails when it differs
(`UPDATE_EXPECT=1 cargo test -p scene-format` writes it anew). `tracer explain E0301` prints one of these.

`E01xx` syntax, `E02xx` structure, `E03xx` values, `E04xx` names, `E05xx` files; `W` warnings. A code never changes \
its meaning.
"
    .to_owned();
    for code in CODES {
        let text: String =
            code.text.lines().map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line))).collect();
        let _ = write!(out, "\n## {}: {}\n\n{text}", code.code, code.title);
    }
    out
}

/// What has its section; a kind may have the name of a choice.
#[derive(Default)]
struct Done {
    structs: Vec<&'static str>,
    choices: Vec<&'static str>,
}

fn section(out: &mut String, def: &'static StructDef, done: &mut Done) {
    if done.structs.contains(&def.name) {
        return;
    }
    done.structs.push(def.name);
    let _ = write!(out, "\n## {}\n\n{}\n", def.name, prose(def.doc));
    if let Some(line) = lines::group(def.name) {
        let _ = write!(out, "\n```ron\n{line}\n```\n");
    }
    table(out, def);
    for field in def.fields {
        parts(out, field.kind, done);
    }
}

/// The sections of what a field's type is made of.
fn parts(out: &mut String, kind: Type, done: &mut Done) {
    match kind.resolved() {
        Type::Struct(def) => section(out, def, done),
        Type::Enum(def) => choice(out, def, done),
        Type::List(inner) | Type::Map(inner) | Type::Optional(inner) => parts(out, *inner, done),
        Type::OneOf(kinds) => kinds.iter().for_each(|kind| parts(out, *kind, done)),
        _ => {}
    }
}

fn choice(out: &mut String, def: &'static EnumDef, done: &mut Done) {
    if done.choices.contains(&def.name) {
        return;
    }
    done.choices.push(def.name);
    let _ = write!(out, "\n## {}\n\n{}\n", title(def.name), prose(def.doc));
    debug_assert!(CHOICES.iter().any(|choice| choice.name == def.name), "{} is not among the choices", def.name);
    for variant in def.variants {
        let _ = write!(out, "\n### {}\n\n{}\n", variant.name, variant.prose());
        if let Some(words) = snippet(def.name, variant.name) {
            let _ = write!(out, "\n```ron\n{words}\n```\n");
        }
        match &variant.content {
            Content::Unit => {}
            Content::Value(at) => {
                let _ = write!(out, "\nValue: {}.\n", expected(at));
            }
            Content::Struct(fields) => {
                done.structs.push(fields.name);
                table(out, fields);
            }
        }
    }
    for variant in def.variants {
        if let Content::Struct(fields) = &variant.content {
            fields.fields.iter().for_each(|field| parts(out, field.kind, done));
        }
    }
}

fn title(name: &'static str) -> &'static str {
    match name {
        "TransformWords" => "Transform",
        "PatternWords" => "Texture",
        "PlacementPattern" => "Patterns of placements",
        "PixelFilter" => "Antialiasing",
        name => name,
    }
}

fn table(out: &mut String, def: &'static StructDef) {
    out.push_str("\n| field | value | default | meaning |\n|---|---|---|---|\n");
    for field in def.fields {
        let _ = writeln!(
            out,
            "| `{}` | {} | {} | {} |",
            field.name,
            value(field, def).replace('|', "\\|"),
            default(field, def),
            prose(field.doc)
        );
    }
    if !def.exactly_one.is_empty() {
        let _ = write!(out, "\nExactly one of {} is written.\n", crate::suggest::list(def.exactly_one));
    }
}

fn value(field: &FieldDef, def: &StructDef) -> String {
    if let Type::List(inner) = field.kind
        && let Type::Enum(def) = inner.resolved()
    {
        return format!("list of {}", link(title(def.name)));
    }
    if let Type::List(Type::Struct(def)) = field.kind {
        return format!("list of {}", link(def.name));
    }
    match field.kind {
        Type::Struct(def) => link(def.name),
        Type::Enum(def) => link(title(def.name)),
        Type::Map(Type::Enum(def)) => format!("{{ \"name\": {} }}", link(def.name)),
        Type::Map(Type::Struct(def)) => format!("{{ \"name\": {} }}", link(def.name)),
        Type::Map(inner) if inner.is_texture() => format!("{{ \"name\": colour or {} }}", link("Texture")),
        Type::OneOf([Type::Text, Type::Struct(def)]) => format!("a name from `cameras`, or a {}", link(def.name)),
        Type::OneOf([Type::Text, Type::Enum(def)]) => format!("a name from `materials`, or a {}", link(def.name)),
        // Twelve kinds, in a dozen places.
        Type::OneOf([Type::Color, Type::Later(_)]) | Type::Optional(Type::OneOf([Type::Color, Type::Later(_)])) => {
            let words = field.rule.range.words();
            format!(
                "a colour with channels {words}: (r, g, b), one number for grey, \"#rrggbb\", a {}, or a name from \
                 `textures`",
                link("Texture")
            )
        }
        Type::OneOf([Type::Number, Type::Later(_)]) => {
            let (what, words) = (field.rule.what, field.rule.range.words());
            format!("{what} {words}, a {}, or a name from `textures`", link("Texture"))
        }
        Type::OneOf([Type::List(_), Type::File]) => {
            format!("list of lists of {}, or a file name", link("Transform"))
        }
        // Of several one has to be.
        _ if def.exactly_one.contains(&field.name) => expected(field).replace(", or None", ""),
        _ => expected(field),
    }
}

fn link(name: &str) -> String {
    format!("[{name}](#{})", name.to_lowercase())
}

fn default(field: &FieldDef, def: &'static StructDef) -> String {
    if def.name == "Scene" && field.name == "objects" {
        return "at least one".to_owned();
    }
    match field.default.map(|default| default()) {
        None => "must be written".to_owned(),
        _ if def.exactly_one.contains(&field.name) => "one of them".to_owned(),
        Some(Form::Absent) => "see right".to_owned(),
        Some(Form::Struct { .. }) => "its defaults".to_owned(),
        Some(form) => {
            let (ron, toml) = (ron_value(&form), toml_value(&form));
            if ron == toml || matches!(form, Form::Vector(_)) {
                format!("`{ron}`")
            } else {
                format!("`{ron}`, in TOML `{toml}`")
            }
        }
    }
}
