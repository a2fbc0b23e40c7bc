//! `tracer fmt`, `tracer check --fix` and `--diagnostics github`: scenes are rewritten whole or not at all.

use crate::support::Sandbox;

const UNTIDY: &str = "Scene(background: 1,\n\n\n  objects: [Sphere(center: (0,0,0), radius: 1)], // one\n)\n";
const TIDY: &str = "Scene(\n    background: 1,\n\n    objects: [Sphere(center: (0, 0, 0), radius: 1)], // one\n)\n";

#[test]
fn scenes_are_laid_out_in_their_files() {
    let sandbox = Sandbox::new();
    sandbox.write("a.ron", UNTIDY);
    sandbox.write("b.ron", TIDY);
    sandbox.run(&["fmt", "a.ron", "b.ron", "--check"]).ends(1).says(&["1 scene of 2 would change"]);
    assert_eq!(sandbox.text("a.ron"), UNTIDY);
    assert_eq!(sandbox.run(&["fmt", "a.ron", "b.ron"]).ends(0).silent().out_text(), "a.ron\n");
    assert_eq!(sandbox.text("a.ron"), TIDY);
    sandbox.run(&["fmt", "a.ron", "b.ron", "--check"]).ends(0).silent();
    sandbox.write("untidy.ron", UNTIDY);
    assert_eq!(sandbox.shell("\"$T\" fmt - < untidy.ron").ends(0).silent().out_text(), TIDY);
    // A wrong one is told and left alone; the others are laid out.
    sandbox.write("a.ron", UNTIDY);
    sandbox.write("wrong.ron", "Scene(objects: [Sphere(radus: 1)])");
    sandbox.run(&["fmt", "wrong.ron", "a.ron"]).ends(2).says(&["radus"]);
    assert_eq!(
        (sandbox.text("wrong.ron"), sandbox.text("a.ron")),
        ("Scene(objects: [Sphere(radus: 1)])".into(), TIDY.into())
    );
    sandbox.run(&["fmt", "none.ron"]).ends(2).says(&["none.ron"]);
    sandbox.write("latin.ron", b"Scene(background: 1) // \xe9");
    sandbox.run(&["fmt", "latin.ron"]).ends(2).says(&["UTF-8"]);
}

#[test]
fn what_is_certain_is_mended() {
    let sandbox = Sandbox::new();
    let wrong = "Scene(\n    bakground: 1, // light\n    objects: [Sphere(centre: (0, 0, 0), radus: 1), Sphere(center: \
                 (0, 0, 0))],\n)\n";
    sandbox.write("a.ron", wrong);
    // One sphere has no radius: that is for the person.
    sandbox.run(&["check", "a.ron", "--fix"]).ends(2).says(&[
        "a.ron:2:5: `bakground` is now `background`\n",
        "a.ron:3:22: `centre` is now `center`\na.ron:3:41: `radus` is now `radius`\na.ron: mended 3 faults",
        "radius",
    ]);
    let mended = "Scene(\n    background: 1, // light\n    objects: [Sphere(center: (0, 0, 0), radius: 1), \
                  Sphere(center: (0, 0, 0))],\n)\n";
    assert_eq!(sandbox.text("a.ron"), mended);
    sandbox.run(&["check", "a.ron", "--fix"]).ends(2).says(&["radius"]);
    assert_eq!(sandbox.text("a.ron"), mended);
    sandbox.write("b.ron", mended.replace("Sphere(center: (0, 0, 0))", "Sphere(center: (0, 0, 0), radius: Some(2))"));
    sandbox.run(&["check", "b.ron", "--fix"]).ends(0);
    sandbox.write("c.ron", wrong.replace(", Sphere(center: (0, 0, 0))", ""));
    let record =
        r#"{"severity":"mended","code":"","message":"`radus` is now `radius`","place":{"file":"c.ron","bytes":["#;
    sandbox.run(&["check", "c.ron", "--fix", "--diagnostics", "json"]).ends(0).says(&[record, r#""before":"radus""#]);
    sandbox.run(&["check", "-", "--fix"]).ends(2).says(&["standard input"]);
}

#[test]
fn faults_are_told_to_github() {
    let sandbox = Sandbox::new();
    sandbox.write("a.ron", "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radus: 1)])");
    let line = "::error title=E0201,file=a.ron,line=1,col=58,endLine=1,endColumn=63::";
    sandbox.run(&["check", "a.ron", "--diagnostics", "github"]).ends(2).says(&[line, "%0Ahint: did you mean"]);
}
