//! Height fields: their pictures are found, told of, and spared as other files of a scene are.

use crate::support::Sandbox;

/// A scene whose only file is a picture of heights, made by the program itself.
fn landscape(field: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "hills.png", "--samples", "1"]).ends(0);
    sandbox.run(&["render", "scene.ron", "-o", "row.png", "--samples", "1", "--crop", "0,0,9,1"]).ends(0);
    sandbox.write(
        "land.ron",
        format!(
            "Scene(background: 1, image: Image(width: 16, height: 12), render: Render(samples: 1), objects: [
    HeightField({field}),
])"
        ),
    );
    sandbox
}

#[test]
fn what_is_wrong_with_heights_is_told_at_their_name() {
    let told = |field: &str, told: &[&str]| {
        landscape(field).run(&["check", "land.ron"]).ends(2).says(&["land.ron:2"]).says(told);
    };
    told("file: \"hill.png\", size: (2, 1, 2)", &["E0501", "did you mean `hills.png`?"]);
    told("file: \"row.png\", size: (2, 1, 2)", &["E0520", "9 x 1 pixels", "one row of them has no surface"]);
    told("file: \"scene.ron\", size: (2, 1, 2)", &["E0520", "HDR, EXR, PNG or JPEG"]);
    // Together with what is wrong with the text.
    told("file: \"row.png\", size: (2, 1, 2), smoth: true", &["E0201", "E0520"]);
    told("file: \"hills.png\", size: (2, 0, 2)", &["E0301"]);
    landscape("file: \"hills.png\", size: (2, 1, 2)").run(&["check", "land.ron"]).ends(0);
}

#[test]
fn the_picture_of_a_height_field_is_never_overwritten() {
    let sandbox = landscape("file: \"hills.png\", size: (2, 1, 2)");
    let before = sandbox.read("hills.png");
    sandbox.run(&["render", "land.ron", "-o", "hills.png"]).ends(2).says(&["hills.png"]);
    sandbox.run(&["render", "land.ron", "-o", "a.png", "--report", "hills.png"]).ends(2).says(&["hills.png"]);
    assert_eq!(sandbox.read("hills.png"), before);
    // Another picture is another scene: a checkpoint is not gone on with.
    let render = |samples: &str, way: &str| {
        sandbox.run(&["render", "land.ron", "-o", "a.png", "--samples", samples, way, "c.film"])
    };
    render("1", "--checkpoint").ends(0);
    render("2", "--resume").ends(0);
    sandbox.run(&["render", "scene.ron", "-o", "hills.png", "--samples", "3"]).ends(0);
    render("3", "--resume").ends(2).says(&["the contents of hills.png have changed"]);
}
