//! `tracer marks`: where points are in the picture, as text, JSON, coordinates of TikZ and labels.

use crate::support::Sandbox;
use serde_json::Value;

/// The camera looks along -z from z = 4, 40 pixels wide and 20 high: a unit of the plane z = 0 is 5 pixels.
const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 0, 4), look_at: (0, 0, 0), fov: 53.130102354),
    image: Image(width: 40, height: 20), render: Render(samples: 1), background: 1,
    objects: [Sphere(radius: 0.5)],
    output: Output(marks: {
        "front": (0, 0, 0.5), "back": (0, 0, -0.5), "aside <&>": (2, 1, 0), "beside": (9, 0, 0), "behind us": (0, 0, 9),
    }),
)"#;

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE);
    sandbox
}

#[test]
fn marks_are_told() {
    let sandbox = sandbox();
    let text = sandbox.run(&["marks", "scene.ron"]).ends(0).silent().out_text();
    assert_eq!(
        text,
        "scene.ron, 40x20 pixels\n  \
           front      at 20.0, 10.0, 3.5 away\n  \
           back       at 20.0, 10.0, 4.5 away, behind something\n  \
           aside <&>  at 30.0, 5.0, 4 away\n  \
           beside     at 65.0, 10.0, 4 away, outside of the picture\n  \
           behind us  the camera cannot show it\n"
    );
    // As the report has them; half as large.
    let told = sandbox.run(&["marks", "scene.ron", "--format", "json", "--size", "20x10"]).ends(0).silent().out_text();
    let told: Value = serde_json::from_str(&told).expect("JSON");
    sandbox.run(&["render", "scene.ron", "--size", "20x10", "-o", "a.png", "--report", "r.json"]).ends(0);
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    assert_eq!(told, report["picture"]["marks"]);
    assert_eq!(told[0]["pixel"][1], 5.0);
}

#[test]
fn coordinates_for_tikz() {
    let sandbox = sandbox();
    let names = ["--set", "output.marks={\"A\": (2, 1, 0), \"my lamp-2\": (0, 0, -1), \"gone\": (0, 0, 9)}"];
    let run = |file: &str| sandbox.run(&[&["marks", "scene.ron", "-o", file], &names[..]].concat());
    assert_eq!(run("a.tex").ends(0).silent().out_text(), "");
    let text = sandbox.text("a.tex");
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("%  ")).skip(1).collect();
    assert_eq!(
        lines,
        [
            r"\path (picture.south west) -- (picture.south east) coordinate[pos=0.750000] (mark x);",
            r"\path (picture.south west) -- (picture.north west) coordinate[pos=0.750000] (mark y);",
            r"\coordinate (A) at (mark x |- mark y);",
            "% my lamp-2: behind something",
            r"\path (picture.south west) -- (picture.south east) coordinate[pos=0.500000] (mark x);",
            r"\path (picture.south west) -- (picture.north west) coordinate[pos=0.500000] (mark y);",
            r"\coordinate (my lamp-2) at (mark x |- mark y);",
            "% gone: the camera cannot show it",
        ]
    );
    // Again over its own, over nothing else, and not with names that are no names there.
    run("a.tex").ends(0);
    sandbox.write("paper.tex", "\\documentclass{article}");
    run("paper.tex").ends(2).says(&["paper.tex", "is there already and is no file of tracer marks"]);
    sandbox
        .run(&["marks", "scene.ron", "-o", "b.tex", "--set", "output.marks={\"a.b\": (0, 0, 0)}"])
        .ends(2)
        .says(&["\"a.b\"", "letters"]);
    assert!(!sandbox.path("b.tex").exists());
}

#[test]
fn labels_over_the_picture() {
    let sandbox = sandbox();
    std::fs::create_dir(sandbox.path("out")).expect("a folder");
    sandbox.run(&["marks", "scene.ron", "-o", "out/a.svg", "--picture", "a.png"]).ends(0).silent();
    let text = sandbox.text("out/a.svg");
    for words in [
        r#"viewBox="0 0 40 20""#,
        r#"<image href="../a.png" width="40" height="20"/>"#,
        r#"<circle class="dot" cx="20.00" cy="10.00""#,
        r#"<circle class="dot hidden" cx="20.00" cy="10.00""#,
        ">aside &lt;&amp;&gt;</text>",
        "<desc>beside: outside of the picture</desc>",
        "<desc>behind us: the camera cannot show it</desc>",
    ] {
        assert!(text.contains(words), "{words}\n{text}");
    }
    sandbox.run(&["marks", "scene.ron", "-o", "out/a.svg"]).ends(0);
    assert!(!sandbox.text("out/a.svg").contains("<image"));
}

#[test]
fn what_cannot_be_is_told() {
    let sandbox = sandbox();
    let says = |line: &[&str], words: &[&str]| {
        sandbox.run(&[&["marks", "scene.ron"], line].concat()).ends(2).says(words);
    };
    says(&["-o", "a.pdf"], &["a.pdf", ".tex", ".svg"]);
    says(&["-o", "-"], &["-o is a file"]);
    says(&["--picture", "a.png"], &["--picture", "-o FILE.svg"]);
    says(&["-o", "a.tex", "--picture", "a.png"], &["--picture", "-o FILE.svg"]);
    says(&["--set", "output.marks={}"], &["names no marks", "Output(marks:"]);
    says(&["-o", "a.svg", "--picture", "a.svg"], &["would replace a file that is read"]);
    // Both eyes' marks.
    let eyes = ["--set", "camera.stereo=Stereo(separation: 0.06, layout: SideBySide)"];
    let text = sandbox.run(&[&["marks", "scene.ron"], &eyes[..]].concat()).ends(0).out_text();
    assert!(text.contains("front-left ") && text.contains("front-right "), "{text}");
}
