//! Words of other programs whose edits are offered: each edit is made, and makes the file better.

use scene_format::render::apply_edits;
use scene_format::{Diagnostic, LoadError, Severity, Syntax, load_str, mend};
use std::path::Path;

fn errors(text: &str, syntax: Syntax) -> Vec<Diagnostic> {
    match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect()
        }
        _ => Vec::new(),
    }
}

/// A scene of this object.
fn scene(object: &str, syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => format!("Scene(background: 1, vars: {{ \"gap\": 2 }}, objects: [{object}])"),
        Syntax::Toml => format!("background = 1\nvars = {{ gap = 2 }}\nobjects = [{object}]\n"),
        Syntax::Json => {
            format!("{{\"background\": 1, \"vars\": {{\"gap\": 2}}, \"objects\": [{object}]}}")
        }
    }
}

/// All edits that are offered, one after the other, each of which has to leave fewer errors.
fn mended(object: &str, syntax: Syntax) -> String {
    let mut text = scene(object, syntax);
    for _ in 0..9 {
        let before = errors(&text, syntax);
        let Some(edit) = before.iter().find_map(|fault| fault.edit.clone()) else { break };
        let after = apply_edits(&text, std::slice::from_ref(&edit));
        let left = errors(&after, syntax);
        assert!(left.len() < before.len(), "{text}\nbecomes\n{after}\n{left:#?}");
        text = after;
    }
    // As `check --fix` does it.
    let at_once = mend("scene", &scene(object, syntax), syntax, Path::new("")).text;
    assert_eq!(at_once, text, "{object}");
    text
}

/// What is written, what it becomes.
fn check(cases: &[(&str, &str)], syntax: Syntax) {
    let mut wrong = Vec::new();
    for (written, right) in cases {
        let now = mended(written, syntax);
        let left = errors(&now, syntax);
        if now != scene(right, syntax) || !left.is_empty() {
            wrong.push(format!("{written}\nbecomes {now}\n{left:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn fields_of_shapes() {
    check(
        &[
            (
                "Cylinder(base: (0, 0, 0), cap: (0, 1, 0), radius: 1)",
                "Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1)",
            ),
            ("Cylinder(p0: (0, 0, 0), p1: (0, 1, 0), r: 1)", "Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1)"),
            ("Cylinder(end: (0, 2, 0), radius: 1, cap: false)", "Cylinder(to: (0, 2, 0), radius: 1, caps: false)"),
            ("Cone(base: (0, 0, 0), apex: (0, 1, 0), radius: 1)", "Cone(from: (0, 0, 0), to: (0, 1, 0), radius: 1)"),
            ("Cone(tip: (0, 1, 0), r: 1)", "Cone(to: (0, 1, 0), radius: 1)"),
            (
                "Capsule(start: (0, 0, 0), end: (0, 1, 0), radius: 1)",
                "Capsule(from: (0, 0, 0), to: (0, 1, 0), radius: 1)",
            ),
            (
                "Arrow(tail: (0, 0, 0), head: (0, 1, 0), radius: 0.1)",
                "Arrow(from: (0, 0, 0), to: (0, 1, 0), radius: 0.1)",
            ),
            ("Box(size: 1, visible_camera: false)", "Box(size: 1, camera_visible: false)"),
            ("Torus(R: 1, r: 0.2)", "Torus(radius: 1, tube_radius: 0.2)"),
            ("Torus(major: 1, minor: 0.2)", "Torus(radius: 1, tube_radius: 0.2)"),
            ("Torus(major_radius: 1, minor_radius: 0.2)", "Torus(radius: 1, tube_radius: 0.2)"),
            ("Disk(outer_radius: 2, inner: 1)", "Disk(radius: 2, inner_radius: 1)"),
            ("Sphere(location: (0, 1, 0), r: 1)", "Sphere(center: (0, 1, 0), radius: 1)"),
            ("Sphere(pos: (0, 1, 0), radius: 1)", "Sphere(center: (0, 1, 0), radius: 1)"),
            ("Box(dimensions: (1, 2, 3))", "Box(size: (1, 2, 3))"),
            ("Box(min: (0, 0, -0.1), max: (1, 2, 0.2))", "Box(center: (0.5, 1, 0.05), size: (1, 2, 0.3))"),
            ("Box(width: 1, height: 2, depth: 3)", "Box(size: (1, 2, 3))"),
            ("Rectangle(width: 2, height: 3, normal: (0, 0, 1))", "Rectangle(size: (2, 3), normal: (0, 0, 1))"),
        ],
        Syntax::Ron,
    );
    check(&[("{ Rectangle = { width = 2, height = 3 } }", "{ Rectangle = { size = [2, 3] } }")], Syntax::Toml);
    check(
        &[(
            r#"{"Box": {"min": [0, 0, 0], "max": [1, 2, 3]}}"#,
            r#"{"Box": {"center": [0.5, 1, 1.5], "size": [1, 2, 3]}}"#,
        )],
        Syntax::Json,
    );
}

/// Where a value does not fit, or stands there already, nothing is edited, and the field is told of once.
#[test]
fn what_does_not_fit_is_no_edit() {
    let lens = |lens: &str| {
        format!(
            "Sphere(center: (0, 0, 0), radius: 1)], effects: Effects(depth_of_field: {lens}), lights: \
             [SphereLight(center: (0, 9, 0), radius: 1, radiance: 1)"
        )
    };
    let cases = [
        (lens("ThinLens(aperture: 1, focus: \"bottle\")"), "`focus_distance`, which takes a length"),
        (lens("ThinLens(focus_distance: 5, f_stop: 2.8)"), "focal length over"),
        ("Cylinder(from: (0, 0, 0), base: (0, 0, 0), radius: 1)".to_owned(), "`from` is written already"),
        ("Sphere(center: (0, 0, 0), radius: 1, r: 2)".to_owned(), "`radius` is written already"),
        ("Sphere(center: (0, 0, 0), radius: 1, diameter: 2)".to_owned(), "`radius` is written already"),
        ("Sphere(center: (0, 0, 0), raduis: (1, 2))".to_owned(), "`radius`, which takes a length"),
        ("Torus(outer: 1, inner: 0.5)".to_owned(), "`tube_radius`"),
        (
            "Box(min: (0, 0, 0), size: 1, max: (1, 1, 1))".to_owned(),
            "`size` is written already: leave these out, or write all of it as `center: (x, y, z), size: (x, y, z)`",
        ),
    ];
    let mut wrong = Vec::new();
    for (object, way) in &cases {
        let found = errors(&scene(object, Syntax::Ron), Syntax::Ron);
        let good = matches!(found.as_slice(), [only] if only.edit.is_none() && only.hint.contains(way));
        if !good {
            wrong.push(format!("{object}, not {way}: {found:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn expressions_without_quotes_or_sign() {
    check(
        &[
            ("Sphere(center: (cos(30), 0, 0), radius: 1)", "Sphere(center: (\"=cos(30)\", 0, 0), radius: 1)"),
            ("Sphere(center: (0, cos(30), 0), radius: 1)", "Sphere(center: (0, \"=cos(30)\", 0), radius: 1)"),
            ("Sphere(center: (0, \"gap\", 0), radius: \"gap\")", "Sphere(center: (0, \"=gap\", 0), radius: \"=gap\")"),
        ],
        Syntax::Ron,
    );
    for (object, count) in
        [("Sphere(center: (max(1, 2), 0, 0), radius: 1)", 1), ("Sphere(center: (0, \"gpa\", 0), radius: 1)", 1)]
    {
        let found = errors(&scene(object, Syntax::Ron), Syntax::Ron);
        assert_eq!(found.len(), count, "{found:#?}");
    }
}

#[test]
fn kinds_told_by_a_field() {
    check(
        &[
            (
                r#"{"type": "Sphere", "center": [0, 0, 0], "radius": 1}"#,
                r#"{"Sphere": {"center": [0, 0, 0], "radius": 1}}"#,
            ),
            (r#"{"size": 1, "type": "box"}"#, r#"{"Box": {"size": 1}}"#),
            (
                r#"{"Box": {"size": 1, "material": {"type": "diffuse", "albedo": 0.5}}}"#,
                r#"{"Box": {"size": 1, "material": {"Diffuse": {"albedo": 0.5}}}}"#,
            ),
        ],
        Syntax::Json,
    );
    check(&[("{ type = \"Box\", size = 2 }", "{ Box = { size = 2 } }")], Syntax::Toml);
    check(
        &[
            (
                "(shape: Sphere(center: (0, 1, 0), radius: 1), material: Mirror())",
                "Sphere(center: (0, 1, 0), radius: 1, material: Mirror())",
            ),
            ("(geometry: Box(), material: Diffuse(albedo: 0.5))", "Box(material: Diffuse(albedo: 0.5))"),
            ("Box(material: (bsdf: Diffuse(albedo: 0.5)))", "Box(material: Diffuse(albedo: 0.5))"),
        ],
        Syntax::Ron,
    );
    let found = errors(&scene("(shape: Sphere(raduis: 1), material: Mirror())", Syntax::Ron), Syntax::Ron);
    let codes: Vec<&str> = found.iter().map(|fault| fault.code.as_str()).collect();
    assert_eq!(codes, ["E0203", "E0201"], "{found:#?}");
    let rest = "\"objects\": [{\"Box\": {\"size\": 1}}]";
    let light = "{\"type\": \"SphereLight\", \"center\": [0, 5, 0], \"radius\": 1, \"radiance\": 5}";
    let text = format!("{{\"lights\": [{light}], {rest}}}");
    let found = errors(&text, Syntax::Json);
    assert!(matches!(found.as_slice(), [only] if only.hint.starts_with("write `{\"SphereLight\": {")), "{found:#?}");
    // A header of TOML is not edited where other fields stand between: it is not in one piece.
    let found = errors("background = 1\n[[objects]]\nsize = 1\ntype = \"Box\"\n", Syntax::Toml);
    assert!(
        matches!(found.as_slice(), [only] if only.edit.is_none() && only.hint.contains("[objects.Box]")),
        "{found:#?}"
    );
    // What else is wrong is told in the same run.
    let found = errors(&scene("{\"type\": \"Sphere\", \"raduis\": 1}", Syntax::Json), Syntax::Json);
    let codes: Vec<&str> = found.iter().map(|fault| fault.code.as_str()).collect();
    assert_eq!(codes, ["E0203", "E0201"], "{found:#?}");
    let found = errors(&scene("{\"type\": \"spotlight\", \"radius\": 1}", Syntax::Json), Syntax::Json);
    assert!(matches!(found.as_slice(), [only] if only.hint.contains("`lights`")), "{found:#?}");
}

/// What begins with a name and goes on with an operator is an expression, and never two values.
#[test]
fn arithmetic_without_quotes() {
    let ball = |center: &str, radius: &str| format!("Sphere(center: {center}, radius: {radius})");
    let bodies = [
        "gap*2",
        "gap + 1",
        "gap^2",
        "gap % 3",
        "gap/2",
        "gap-1",
        "gap - 1",
        "gap -1",
        "gap*2 + 1",
        "gap * (1 + gap)",
        "-gap",
        "2*gap",
        "sqrt(gap)",
    ];
    for body in bodies {
        let quoted = format!("\"={body}\"");
        let written = ball(&format!("({body}, 0, {body})"), "0.5");
        check(&[(&written, &ball(&format!("({quoted}, 0, {quoted})"), "0.5"))], Syntax::Ron);
        let json = |x: &str| format!("{{\"Sphere\": {{\"center\": [{x}, 0, 0], \"radius\": 1}}}}");
        check(&[(&json(body), &json(&quoted))], Syntax::Json);
        let toml = |x: &str| format!("{{ Sphere = {{ center = [{x}, 0, 0], radius = 1 }} }}");
        check(&[(&toml(body), &toml(&quoted))], Syntax::Toml);
    }
    let lone = |transform: &str| format!("Sphere(center: (0, 0, 0), radius: 1, transform: {transform})");
    for written in ["Translate(x: 1, y: 2, z: 3)", "translate(1, 2, 3)", "Translate((1, 2, 3))"] {
        check(&[(&lone(written), &lone("[Translate((1, 2, 3))]"))], Syntax::Ron);
    }
    check(&[(&lone("[Rotate(30, (0, 1, 0))]"), &lone("[Rotate(axis: (0, 1, 0), degrees: 30)]"))], Syntax::Ron);
    check(&[(&ball("(0, 0, 0)", "\"2*gap\""), &ball("(0, 0, 0)", "\"=2*gap\""))], Syntax::Ron);
    // Texts and units stay what they are.
    for written in [ball("(0, 0, 0)", "my-file.obj"), ball("(0, 0, 0)", "a/b.obj"), ball("(0, 0, 0)", "5 cm")] {
        let told = errors(&scene(&written, Syntax::Ron), Syntax::Ron);
        assert!(told.iter().all(|fault| fault.code.as_str() != "E0607"), "{written}: {told:#?}");
    }
}

#[test]
fn calls_and_brackets() {
    check(
        &[
            ("Sphere(center: new THREE.Vector3(0, 1, 6), radius: 1)", "Sphere(center: (0, 1, 6), radius: 1)"),
            ("Sphere(center: np.array([0, 1, 6]), radius: 1)", "Sphere(center: (0, 1, 6), radius: 1)"),
            ("new Sphere(center: (0, 0, 0), radius: 1)", "Sphere(center: (0, 0, 0), radius: 1)"),
            ("Sphere(center: {0, 1, 6}, radius: 1)", "Sphere(center: (0, 1, 6), radius: 1)"),
            ("Box(size: 1, transform: [Scale(x: 2)])", "Box(size: 1, transform: [Scale(factor: (2, 1, 1))])"),
            (
                "Box(size: 1, transform: [Rotate(z: 40)])",
                "Box(size: 1, transform: [Rotate(axis: (0, 0, 1), degrees: 40)])",
            ),
            (
                "Box(size: 1, transform: [Matrix([1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9])])",
                "Box(size: 1, transform: [Matrix(rows: ((1, 0, 0, 7), (0, 1, 0, 8), (0, 0, 1, 9)))])",
            ),
            ("Difference(a: Box(size: 2), b: Box(size: 1))", "Difference(objects: [Box(size: 2), Box(size: 1)])"),
            ("Box(size: 1, material: Emissive(power: \"100 W\"))", "Box(size: 1, material: Emissive(power: 100))"),
        ],
        Syntax::Ron,
    );
    check(
        &[
            (
                "{ Box = { size = 1, transform = [{ Scale = { x = 2 } }] } }",
                "{ Box = { size = 1, transform = [{ Scale = { factor = [2, 1, 1] } }] } }",
            ),
            (
                "{ Box = { size = 1, transform = [{ Rotate = { y = 40 } }] } }",
                "{ Box = { size = 1, transform = [{ Rotate = { axis = [0, 1, 0], degrees = 40 } }] } }",
            ),
        ],
        Syntax::Toml,
    );
}

/// What is one mistake is told once, mends at once, and what it becomes is right.
fn check_once(cases: &[(&str, &str)]) {
    for (written, _) in cases {
        let found = errors(&scene(written, Syntax::Ron), Syntax::Ron);
        let told: Vec<&str> = found.iter().map(|fault| fault.message.as_str()).collect();
        assert_eq!(found.len(), 1, "{written}: {told:?}");
    }
    check(cases, Syntax::Ron);
}

#[test]
fn arithmetic_in_and_behind_brackets_and_quotes() {
    let ball = |radius: &str| format!("Sphere(center: (0, 0, 0), radius: {radius})");
    let cases = [
        ("(gap*0.5)", "\"=(gap*0.5)\""),
        ("(1+2)", "\"=(1+2)\""),
        ("(gap + 1)/2", "\"=(gap + 1)/2\""),
        ("\"=gap\" + 1", "\"=gap + 1\""),
        ("\"=gap/10\"*2", "\"=(gap/10)*2\""),
        ("gap > 1 ? 4 : 5", "\"=if(gap > 1, 4, 5)\""),
        ("5\u{a0}", "5"),
        ("<5>", "5"),
        ("if gap > 1 then 4 else 5", "\"=if(gap > 1, 4, 5)\""),
        ("if true then 4 else gap/2", "\"=if(true, 4, gap/2)\""),
    ]
    .map(|(written, right)| (ball(written), ball(right)));
    check_once(&cases.each_ref().map(|(written, right)| (written.as_str(), right.as_str())));
}

#[test]
fn colors_without_quotes_and_of_other_languages() {
    let ball = |albedo: &str| {
        format!("Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: {albedo}), name: \"a\")")
    };
    let cases = [
        ("#f00", "\"#ff0000\""),
        ("#ff8800", "\"#ff8800\""),
        ("new THREE.Color(0x87ceeb)", "\"#87ceeb\""),
        ("THREE.Color(\"#87ceeb\")", "\"#87ceeb\""),
        ("0.1 0.2 0.3", "(0.1, 0.2, 0.3)"),
        ("skyblue", "\"#87ceeb\""),
        ("\"goldenrod\"", "\"#daa520\""),
        ("hsl(270, 50%, 40%)", "\"#663399\""),
        ("hsv(0, 0, 50)", "\"#808080\""),
        ("\"hsl(270deg 50% 40%)\"", "\"#663399\""),
        ("\"rgb(102, 51, 153)\"", "\"#663399\""),
    ]
    .map(|(written, right)| (ball(written), ball(right)));
    check_once(&cases.each_ref().map(|(written, right)| (written.as_str(), right.as_str())));
}

/// The colour of a temperature is one of light: its red is more than 1, which nothing reflects.
#[test]
fn temperatures_in_kelvin_are_colors_of_light() {
    let text =
        |background: &str| format!("Scene(background: {background}, objects: [Sphere(center: (0, 0, 0), radius: 1)])");
    let found = errors(&text("\"5000K\""), Syntax::Ron);
    assert_eq!(found.len(), 1, "{found:?}");
    let mended = apply_edits(&text("\"5000K\""), &[found[0].edit.clone().expect("an edit")]);
    assert_eq!(mended, text("\"=blackbody(5000)\""));
    assert!(errors(&mended, Syntax::Ron).is_empty());
    let ball = "Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: \"5000K\"))";
    assert!(errors(&scene(ball, Syntax::Ron), Syntax::Ron).iter().all(|fault| fault.edit.is_none()));
}

#[test]
fn signs_of_other_keyboards() {
    check_once(&[
        ("Sphere（center: (0, 0, 0), radius: 1)", "Sphere(center: (0, 0, 0), radius: 1)"),
        ("Sphere（center：（0, 0, 0），radius: 1）", "Sphere(center:(0, 0, 0),radius: 1)"),
        ("Sphere(center: (0, 0, 0), radius：1, name: \"：\")", "Sphere(center: (0, 0, 0), radius:1, name: \"：\")"),
    ]);
    // Where they stand in comments, and something else is wrong, that is told.
    for (text, syntax) in [
        ("Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radus: 1)]) // （a）", Syntax::Ron),
        ("Scene(background: 1, /* （ */ objects: [Sphere(center: (0, 0, 0), radus: 1)])", Syntax::Ron),
        ("# （a）\nbackground = 1\n[[objects]]\nSphere = { center = [0, 0, 0], radus = 1 }", Syntax::Toml),
    ] {
        let found = errors(text, syntax);
        assert!(found.iter().all(|fault| fault.message.contains("radus")) && found.len() == 1, "{text}: {found:?}");
    }
    // What is right may have such signs in texts.
    assert!(errors(&scene("Sphere(center: (0, 0, 0), radius: 1, name: \"（\")", Syntax::Ron), Syntax::Ron).is_empty());
}

#[test]
fn a_name_in_braces_without_its_colon() {
    let text = "Scene(background: 1, materials: { \"white\" Diffuse(albedo: 0.8), \"red\": Mirror() },
        objects: [Sphere(center: (0, 0, 0), radius: 1, material: \"white\")])";
    let found = errors(text, Syntax::Ron);
    assert_eq!(
        found.iter().map(|fault| fault.message.as_str()).collect::<Vec<_>>(),
        ["a `:` is missing after this name"]
    );
    let mended = apply_edits(text, &[found[0].edit.clone().expect("an edit")]);
    assert!(mended.contains("\"white\": Diffuse") && errors(&mended, Syntax::Ron).is_empty(), "{mended}");
}

/// Constants of other languages are no texts; in which unit an angle was meant nobody knows, so no edit is offered.
#[test]
fn constants_of_other_languages_are_told() {
    for (written, hint) in [
        ("PI/3", "write \"=pi/3\"; angles are in degrees"),
        ("Math.PI / 4", "write \"=pi / 4\"; angles are in degrees"),
        ("M_PI/4", "write \"=pi/4\"; angles are in degrees"),
        ("np.sqrt(2)", "write \"=sqrt(2)\"; angles are in degrees"),
    ] {
        let text = scene(&format!("Sphere(center: (0, 0, 0), radius: {written})"), Syntax::Ron);
        let found = errors(&text, Syntax::Ron);
        assert_eq!(found.len(), 1, "{text} {found:#?}");
        assert_eq!((found[0].hint.as_str(), &found[0].edit), (hint, &None), "{text}");
    }
}

#[test]
fn kinds_of_other_programs() {
    let ball = "Sphere(center: (0, 0, 0), radius: 1";
    let cases = [
        (format!("{ball}, material: Metal(Gold))"), format!("{ball}, material: Conductor(metal: Gold))")),
        (format!("Difference(of: [{ball}), Box(size: 1)])"), format!("Difference(objects: [{ball}), Box(size: 1)])")),
    ];
    check_once(&cases.each_ref().map(|(written, right)| (written.as_str(), right.as_str())));
    // Other languages take radians: they say so 50 degrees.
    let scene = |fov: &str| format!("Scene(background: 1, camera: Camera(fov: {fov}), objects: [{ball})])");
    let found = errors(&scene("radians(50)"), Syntax::Ron);
    assert_eq!(found.len(), 1, "{found:?}");
    let mended = apply_edits(&scene("radians(50)"), &[found[0].edit.clone().expect("an edit")]);
    assert_eq!(mended, scene("50"));
}

/// A value among fields that has no name of its own is told so, whatever brackets it has.
#[test]
fn values_without_names() {
    check_once(&[
        (
            "Sphere(center: (0, 0, 0), radius: 1, Mirror()), Box(size: 2)",
            "Sphere(center: (0, 0, 0), radius: 1, material: Mirror()), Box(size: 2)",
        ),
        ("Box(size: 1, Translate((1, 0, 0)))", "Box(size: 1, transform: [Translate((1, 0, 0))])"),
        ("Box(size: 1, Ring(count: 3, radius: 4))", "Box(size: 1, placements: Ring(count: 3, radius: 4))"),
        ("Box(Translate((1, 0, 0)))", "Box(transform: [Translate((1, 0, 0))])"),
        ("Group(Box(size: 1), Box(size: 2))", "Group(objects: [Box(size: 1), Box(size: 2)])"),
        ("Sphere((0, 0, 0), 1)", "Sphere(center: (0, 0, 0), radius: 1)"),
        ("Box(size: 1, rotation: (0, 45, 0))", "Box(size: 1, transform: [Rotate(axis: (0, 1, 0), degrees: 45)])"),
        ("Mesh(file: assets\\cat.obj)", "Mesh(file: \"assets/cat.obj\")"),
    ]);
    for (written, told) in [
        ("Box(size: 1, Texture(file: \"x.png\"))", "this value has no field name"),
        ("Box((0, 0, 0), (1, 1, 1))", "the values of a box are written with their names"),
        ("Wall()", "`Wall` is not a kind of object"),
    ] {
        let found = errors(&scene(written, Syntax::Ron), Syntax::Ron);
        let told_of: Vec<(&str, bool)> = found.iter().map(|fault| (&*fault.message, fault.edit.is_some())).collect();
        assert_eq!(told_of, [(told, false)], "{written}");
    }
    // In braces, too, where nobody knows the name.
    let ball = "Sphere(center: (0, 0, 0), radius: 1, material: \"a\")";
    let text =
        format!("Scene(background: 1, materials: {{ \"a\": Diffuse(albedo: 0.5), Mirror() }}, objects: [{ball}])");
    let found = errors(&text, Syntax::Ron);
    assert_eq!((found.len(), &*found[0].message, found[0].edit.is_some()), (1, "this entry has no name", false));
    // POV-Ray's angle is along the width.
    let text = |camera: &str| format!("Scene(background: 1, camera: Camera({camera}), objects: [Box(size: 1)])");
    let mended = mend("scene", &text("angle: 60"), Syntax::Ron, Path::new("")).text;
    assert_eq!(mended, text("fov: 60, fov_axis: Horizontal"));
}

/// What is missing or too much around the whole of a scene.
#[test]
fn a_scene_without_its_brackets() {
    let fields = "version: 1,\n    background: 1,\n    objects: [Sphere(center: (0, 0, 0), radius: 1)],";
    for (written, right) in [
        (format!("// one\n{fields}\n"), format!("// one\n(\n{fields}\n)\n")),
        (format!("Scene: (\n{fields}\n)"), format!("Scene(\n{fields}\n)")),
    ] {
        let found = errors(&written, Syntax::Ron);
        assert_eq!(found.len(), 1, "{written}: {found:?}");
        let mended = apply_edits(&written, &[found[0].edit.clone().expect("an edit")]);
        assert_eq!(mended, right);
        assert!(errors(&mended, Syntax::Ron).is_empty(), "{mended}");
    }
}

#[test]
fn what_stands_in_other_places_is_put_right() {
    check(
        &[
            (
                "Box(size: 1), ball: Sphere(center: (0, 1, 0), radius: 1), Box(size: 2)",
                "Box(size: 1), Sphere(name: \"ball\", center: (0, 1, 0), radius: 1), Box(size: 2)",
            ),
            ("\"lid\": Box(size: 1)", "Box(name: \"lid\", size: 1)"),
            ("Repeat(times: 3, items: [Box(size: 1)])", "Repeat(count: 3, items: [Box(size: 1)])"),
            ("Plane(y: -1)", "Plane(point: (0, -1, 0))"),
            (
                "Cylinder(center: (0, 1, 0), radius: 1, height: 2)",
                "Cylinder(from: (0, 0, 0), to: (0, 2, 0), radius: 1)",
            ),
            ("Cone(base: (1, 0, 2), height: 0.5, radius: 1)", "Cone(from: (1, 0, 2), to: (1, 0.5, 2), radius: 1)"),
        ],
        Syntax::Ron,
    );
    check(&[("{ \"Plane\": { \"y\": -1 } }", "{ \"Plane\": { \"point\": [0, -1, 0] } }")], Syntax::Json);
    let text = "Scene(\n    background: 1,\n        Box(size: 1),\n        Box(size: 2),\n    ],\n)\n";
    let right =
        "Scene(\n    background: 1,\n        objects: [\n        Box(size: 1),\n        Box(size: 2),\n    ],\n)\n";
    assert_eq!(errors(text, Syntax::Ron).len(), 1);
    assert_eq!(mend("scene", text, Syntax::Ron, Path::new("")).text, right);
}

#[test]
fn tables_of_toml_that_tell_their_kind_by_a_field() {
    for (text, right) in [
        (
            "background = 1\n[materials.stone]\ntype = \"diffuse\"\nalbedo = 0.5\n[[objects]]\ntype = \"box\"\n\
             size = 1\n",
            "background = 1\n[materials.stone.Diffuse]\nalbedo = 0.5\n[[objects]]\n[objects.Box]\nsize = 1\n",
        ),
        (
            "background = 1\nobjects = [{ Box = { size = 1 } }]\n[[lights]]\ntype = \"sphere\"\ncenter = [0, 1, 2]\n\
             radius = 1\npower = 5\n",
            "background = 1\nobjects = [{ Box = { size = 1 } }]\n[[lights]]\n[lights.SphereLight]\n\
             center = [0, 1, 2]\nradius = 1\npower = 5\n",
        ),
        (
            "background = 1\n[[objects]]\n[objects.Plane]\n[objects.Box]\nsize = 1\n",
            "background = 1\n[[objects]]\n[objects.Plane]\n[[objects]]\n[objects.Box]\nsize = 1\n",
        ),
        (
            "background = 1\n[[objects]]\nBox = { size = 1, transform = { Scale = 2 } } // lamp\n",
            "background = 1\n[[objects]]\nBox = { size = 1, transform = [{ Scale = 2 }] } # lamp\n",
        ),
    ] {
        let mended = mend("scene", text, Syntax::Toml, Path::new("")).text;
        assert_eq!(mended, right);
        assert_eq!(errors(&mended, Syntax::Toml), [], "{mended}");
    }
    let found =
        errors("background = 1\nmaterials.\"a\\i\".Mirror = {}\n[[objects]]\nBox = { size = 1 }\n", Syntax::Toml);
    assert!(matches!(found.as_slice(), [only] if only.code.as_str() == "E0108"), "{found:#?}");
    let text = "{ \"background\": 1, \"objects\": [{ \"Box\": { \"size: 1\", \"name\": \"a\" } }] }";
    assert_eq!(errors(text, Syntax::Json).len(), 1);
    assert_eq!(mend("scene", text, Syntax::Json, Path::new("")).text, text.replace("\"size: 1\"", "\"size\": 1"));
}

#[test]
fn an_object_alone_and_a_name_without_its_last_quote() {
    let text = "Sphere(center: (0, 1, 0), radius: 1)";
    assert_eq!(errors(text, Syntax::Ron).len(), 1);
    let right = format!("Scene(background: 1, objects: [{text}])");
    assert_eq!(mend("scene", text, Syntax::Ron, Path::new("")).text, right);
    let right = "Scene(background: 1, materials: {\n\"wood\": Diffuse(albedo: Texture(file: \"a.png\")),\n}, \
                 objects: [Box(size: 1, material: \"wood\")])";
    let text = right.replacen("\"wood\":", "\"wood:", 1);
    assert_eq!(errors(&text, Syntax::Ron).len(), 1);
    assert_eq!(mend("scene", &text, Syntax::Ron, Path::new("")).text, right);
}

/// What is one fault, of which nobody knows what was meant: nothing is edited.
#[test]
fn what_is_not_certain_stays() {
    for (object, faults) in [
        ("Box(size: 1), new THREE.Mesh(geometry, material), Box(size: 2)", 1),
        ("Box(size: 1),\n/  Box(size: 2),\n  Box(size: 3)", 1),
        ("Box(size: 1, material: \"wall 3\")", 1),
        // Which of several is meant, and by what measure.
        ("Box(transform: [FitTo(2)])", 1),
        ("Box(length: 1, width: 2, height: 3)", 1),
        ("Torus(radius: 1, thickness: 0.4)", 1),
        ("Box(material: Diffuse(albedo: Perlin()))", 1),
        ("Box(material: Diffuse(albedo: Voronoi(feature: F2)))", 1),
        ("Box(size: 1),\n radius: 1, material: Mirror()),\n Box(size: 2)", 1),
        ("Box(size: 1),\n  b Sphere(center: (0, 0, 0), radius: 1)", 2),
    ] {
        let text = scene(object, Syntax::Ron).replace("vars:", "materials: {\"wall 1\": Mirror()}, vars:");
        let found = errors(&text, Syntax::Ron);
        assert_eq!(found.len(), faults, "{object}: {found:#?}");
        let mended = mend("scene", &text, Syntax::Ron, Path::new("")).text;
        assert!(mended == text || faults > 1 && !mended.contains("Box()"), "{object} becomes {mended}");
    }
    // A line that edits bring no nearer to a scene is left as it was.
    for line in ["b ackground: (0.35, 0.45, 0.6),", "radiu s: 0.5,"] {
        let text = format!("Scene(\n    background: 1,\n    {line}\n    objects: [Box(size: 1)],\n)\n");
        assert_eq!(mend("scene", &text, Syntax::Ron, Path::new("")).text, text);
    }
}
