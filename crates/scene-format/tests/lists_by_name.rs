//! Lists in `vars`, and expressions that stand for a whole list of points, numbers or colours.

use scene_format::{Defaults, Diagnostics, LoadError, Override, Syntax, convert, load_str, mend, to_ron};
use std::path::Path;

/// What is wrong with a scene, or the scene with all that it comes to.
fn read(text: &str, syntax: Syntax) -> Result<String, Diagnostics> {
    match load_str("scene", text, syntax, Path::new(""), &[]) {
        Ok(loaded) => Ok(to_ron(&loaded.scene, Defaults::Hidden)),
        Err(LoadError::Invalid { diagnostics, .. }) => Err(diagnostics),
        Err(error) => panic!("{error}"),
    }
}

fn scene(vars: &str, object: &str) -> String {
    format!("Scene(background: 1, vars: {{ {vars} }}, objects: [{object}])")
}

const POINTS: &str = "[(0, 0, 0), (1, 0, 0), (0, 1, 0)]";

/// By its name a list is the list as it is written.
#[test]
fn a_list_by_name_is_the_list() {
    let ring = "[(0.5, 0), (0.4, 1), (0, 1.2)]";
    for (vars, by_name, written) in [
        (format!("\"p\": {ring}"), "Lathe(profile: \"=p\")", format!("Lathe(profile: {ring})")),
        (
            format!("\"p\": {ring}"),
            "Extrude(outline: [\"=p\"], depth: 1)",
            format!("Extrude(outline: [{ring}], depth: 1)"),
        ),
        (
            format!("\"p\": [{ring}]"),
            "Extrude(outline: \"=p\", depth: 1)",
            format!("Extrude(outline: [{ring}], depth: 1)"),
        ),
        (format!("\"p\": {POINTS}"), "Polygon(points: \"=p\")", format!("Polygon(points: {POINTS})")),
        (
            format!("\"p\": {POINTS}, \"r\": [0.1, 0.2, 0.3]"),
            "Tube(points: \"=p\", radius: \"=r\")",
            format!("Tube(points: {POINTS}, radius: [0.1, 0.2, 0.3])"),
        ),
        (
            format!("\"p\": {POINTS}, \"f\": [[0, 1, 2]], \"c\": [\"#ff0000\", (0, 1, 0), (0, 0, 1)]"),
            "Mesh(points: \"=p\", faces: \"=f\", colors: \"=c\")",
            format!("Mesh(points: {POINTS}, faces: [[0, 1, 2]], colors: [\"#ff0000\", (0, 1, 0), (0, 0, 1)])"),
        ),
        (
            format!("\"p\": {POINTS}, \"c\": [0.1, 0.2, 0.3]"),
            "Mesh(points: \"=p\", faces: [[0, 1, 2]], colors: \"=c\")",
            format!("Mesh(points: {POINTS}, faces: [[0, 1, 2]], colors: [0.1, 0.2, 0.3])"),
        ),
        (
            "\"m\": [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]".to_owned(),
            "Box(transform: [Matrix(rows: \"=m\")])",
            "Box(transform: [Matrix(rows: ((1, 0, 0, 5), (0, 1, 0, 0), (0, 0, 1, 0)))])".to_owned(),
        ),
        // Of several lists, and within a repetition, whose own name hides the other.
        (
            format!("\"p\": {POINTS}, \"all\": [\"=p\", \"=p\"]"),
            "Polygon(points: \"=all[1]\")",
            format!("Polygon(points: {POINTS})"),
        ),
        (
            "\"r\": 1, \"p\": [(\"=r\", 0), (0, \"=r\")]".to_owned(),
            "Repeat(count: 1, vars: { \"r\": 5 }, items: [Lathe(profile: \"=p\")])",
            "Lathe(profile: [(1, 0), (0, 1)])".to_owned(),
        ),
    ] {
        let found = read(&scene(&vars, by_name), Syntax::Ron).map_err(|faults| format!("{by_name}: {faults:#?}"));
        let right = read(&scene("", &written), Syntax::Ron).map_err(|faults| format!("{written}: {faults:#?}"));
        assert_eq!(found, right);
    }
}

#[test]
fn toml_and_json_have_it_too() {
    let ron = read(&scene("\"p\": [(0.5, 0), (0, 1)]", "Lathe(profile: \"=p\")"), Syntax::Ron).expect("a scene");
    let toml = "background = 1\nvars = { p = [[0.5, 0], [0, 1]] }\nobjects = [{ Lathe = { profile = \"=p\" } }]\n";
    assert_eq!(read(toml, Syntax::Toml).expect("a scene"), ron);
    let json = "{\"background\": 1, \"vars\": {\"p\": [[0.5, 0], [0, 1]]}, \"objects\": [{\"Lathe\": {\"profile\": \
                \"=p\"}}]}";
    assert_eq!(read(json, Syntax::Json).expect("a scene"), ron);
}

/// On the command line, too, a list stands in square brackets.
#[test]
fn more_numbers_than_a_vector_has_are_a_list() {
    let text = scene("\"data\": [1, 2]", "Box(size: \"=data[0]\")");
    let set = [Override::from("vars.data=1,2,3,4")];
    match load_str("scene", &text, Syntax::Ron, Path::new(""), &set) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            assert!(matches!(&*diagnostics, [only] if only.hint.contains("[1,2,3,4]")), "{diagnostics:#?}");
        }
        other => panic!("{other:?}"),
    }
}

/// Without its sign the name is not read, and the hint says how: once, and mended.
#[test]
fn what_is_wrong_with_such_a_list_is_told_once() {
    let mut wrong = Vec::new();
    for (vars, object, hint, right) in [
        ("\"p\": [(1, 0), (0, 1)]", "Lathe(profile: p)", "write \"=p\"", Some("Lathe(profile: \"=p\")")),
        ("\"p\": [(1, 0), (0, 1)]", "Lathe(profile: \"p\")", "write \"=p\"", Some("Lathe(profile: \"=p\")")),
        (
            "\"p\": [(1, 0), (0, 1), (0, 0)]",
            "Extrude(outline: \"=p\", depth: 1)",
            "write [\"=p\"]",
            Some("Extrude(outline: [\"=p\"], depth: 1)"),
        ),
        ("\"p\": [1, 0, 0, 0, 1, 0]", "Polygon(points: \"=p\")", "each point stands in brackets", None),
        ("\"p\": 3", "Polygon(points: \"=p\")", "", None),
        ("\"p\": [(0, 0), (1, 0), (1, 1)]", "Polygon(points: \"=p\")", "", None),
        ("\"p\": [(0, 0, 0), (1, 0, 0)]", "Polygon(points: \"=p\")", "", None),
        ("\"p\": [(0, 0)]", "Lathe(profile: \"=q\")", "", None),
        ("\"outer\": [(0, 0), (1, 1)]", "Lathe(profile: outre)", "did you mean \"=outer\"?", None),
        ("\"f\": [0, 1, 2]", "Mesh(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: \"=f\")", "[\"=f\"]", None),
        ("\"c\": [(0, 0, 0), (1, 0, 0)]", "Box(placements: \"=c\")", "[Repeat(count: \"=len(p)\"", None),
        (
            "\"c\": [(0, 0, 0), (1, 0, 0)]",
            "Repeat(count: 2, items: [Box(center: Pick(from: \"=c\", index: \"=i\"))])",
            "\"=c[i]\"",
            None,
        ),
    ] {
        let text = scene(vars, object);
        match read(&text, Syntax::Ron) {
            Err(faults) if matches!(&*faults, [only] if only.hint.contains(hint)) => {}
            other => wrong.push(format!("{object}, not {hint:?}: {other:#?}")),
        }
        let mended = mend("scene", &text, Syntax::Ron, Path::new("")).text;
        let right = right.map_or(text, |right| scene(vars, right));
        if mended != right {
            wrong.push(format!("{object} becomes {mended}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// All items stand at one place: which is wrong is said.
#[test]
fn the_item_that_is_wrong_is_told() {
    let text = scene(
        &format!("\"p\": {POINTS}, \"c\": [1, 0.5, 3]"),
        "Mesh(points: \"=p\", faces: [[0, 1, 2]], colors: \"=c\")",
    );
    let faults = read(&text, Syntax::Ron).expect_err("a colour is too bright");
    assert!(matches!(&*faults, [only] if only.message.ends_with("(item 2 of the list, from 0)")), "{faults:#?}");
}

/// What repetitions put into a list of `vars` is the list as it is written, in all syntaxes.
#[test]
fn a_repeated_list_is_the_list() {
    for (vars, object, written) in [
        // Names of the scene that are reckoned later, an index and vars of its own.
        (
            "\"p\": [Repeat(count: \"=n\", index: \"k\", vars: { \"x\": \"=2*k\" }, items: [\"=(x, k*k, c)\"])], \
             \"n\": 3, \"c\": \"=n + 1\"",
            "Tube(points: \"=p\", radius: 0.1)",
            "Tube(points: [(0, 0, 4), (2, 1, 4), (4, 4, 4)], radius: 0.1)",
        ),
        // Beside others, and within each other.
        (
            "\"p\": [(9, 9), Repeat(count: 2, items: [Repeat(count: 2, index: \"j\", items: [\"=(i, 2 + j)\"])])]",
            "Lathe(profile: \"=p\")",
            "Lathe(profile: [(9, 9), (0, 2), (0, 3), (1, 2), (1, 3)])",
        ),
        // Of a var that another repetition asks for first.
        (
            "\"a\": [Repeat(count: 4, items: [\"=b[i]/10\"])], \"b\": [Repeat(count: 4, items: [\"=i + 1\"])]",
            "Sphere(radius: \"=a[3]\")",
            "Sphere(radius: 0.4)",
        ),
    ] {
        let ron = scene(vars, object);
        let expected = read(&scene("", written), Syntax::Ron).expect("it is right");
        assert_eq!(read(&ron, Syntax::Ron).expect("it is right"), expected, "{ron}");
        for syntax in [Syntax::Toml, Syntax::Json] {
            let other = convert("scene", &ron, Syntax::Ron, syntax).expect("it is right");
            assert_eq!(read(&other, syntax).expect("it is right"), expected, "{other}");
        }
    }
}

/// Vars that wait for each other, repetitions among them, are too many before they take all of a thread's stack.
#[test]
fn vars_that_wait_end_before_the_stack() {
    let repeat = "Repeat(count: 1, items: [";
    for nested in [0, 8] {
        let vars: Vec<String> = (0..250)
            .map(|k| format!("\"v{k}\": [{}\"=v{}[0]\"{}]", repeat.repeat(nested), k + 1, "])".repeat(nested)))
            .collect();
        let text = scene(&format!("{}, \"v250\": [1, 2, 3, 4]", vars.join(", ")), "Sphere(radius: \"=v0[0]\")");
        let read = std::thread::Builder::new().stack_size(2 << 20).spawn(move || read(&text, Syntax::Ron));
        let faults = read.expect("a thread").join().expect("it ends").expect_err("they are too many");
        assert!(faults.iter().any(|fault| fault.message.contains("wait for each other")), "{faults:?}");
    }
}
