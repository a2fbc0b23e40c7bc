//! `camera.shutter` on the command line: however a picture is rendered, it is the same.

use crate::support::Sandbox;

const FILM: &str = r#"Scene(
    animation: Animation(frames: 4, fps: 2),
    camera: Camera(position: (0, 1, 6), shutter: 0.5),
    image: Image(width: 24, height: 16), render: Render(samples: 8),
    background: 0.8,
    objects: [
        Sphere(center: "=(2*time - 1, 0, 0)", radius: 0.6, material: Diffuse(albedo: 0.4)),
        Box(center: (0, -1.5, 0), size: (4, 1, 4), material: Diffuse(albedo: (0.2, 0.4, 0.3))),
    ],
)"#;

fn film() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("film.ron", FILM);
    sandbox
}

#[test]
fn frames_parts_and_checkpoints_are_the_picture() {
    let sandbox = film();
    sandbox.run(&["render", "film.ron", "--frames", "1-2", "-o", "row_#.pfm"]).ends(0);
    let line = ["render", "film.ron", "--frame", "2", "--no-metadata"];
    let run = |more: &[&str]| sandbox.run(&[&line[..], more].concat()).ends(0);
    run(&["-o", "alone.pfm", "-o", "alone.exr"]);
    assert_eq!(sandbox.read("alone.pfm"), sandbox.read("row_2.pfm"));
    assert_ne!(sandbox.read("row_1.pfm"), sandbox.read("row_2.pfm"));
    run(&["--set", "camera.shutter=0", "-o", "still.pfm"]);
    assert_ne!(sandbox.read("alone.pfm"), sandbox.read("still.pfm"));
    // More samples later.
    run(&["--samples", "3", "--checkpoint", "c.film", "-o", "few.pfm"]);
    run(&["--resume", "c.film", "-o", "more.pfm"]);
    assert_eq!(sandbox.read("more.pfm"), sandbox.read("alone.pfm"));
    for part in ["1/2", "2/2"] {
        run(&["--part", part, "-o", &format!("p{}.tracer", &part[..1])]);
    }
    sandbox.run(&["merge", "p1.tracer", "p2.tracer", "-o", "merged.pfm"]).ends(0);
    assert_eq!(sandbox.read("merged.pfm"), sandbox.read("alone.pfm"));
}

/// Each sample is a pass of its own.
#[test]
fn a_plan_ends_within_one_sample() {
    let sandbox = film();
    let render = |plan: &str, threads: &str, name: &str| {
        sandbox.run(&["render", "film.ron", "--frame", "2", "-o", name, "--plan", plan, "-j", threads])
    };
    render("4,8,1,4", "1", "a.png").ends(2).says(&["the second number is 5 here"]);
    render("4,5,1,4", "1", "a.png").ends(0);
    render("4,5,1,4", "2", "b.png").ends(0);
    assert_eq!(sandbox.read("a.png"), sandbox.read("b.png"));
    sandbox.run(&["repro", "a.png"]).ends(0).says(&["the same bytes"]);
}

/// What goes by samples or by what is hit goes by moments, too: the same bytes by other threads and after a checkpoint.
#[test]
fn what_is_made_beside_the_picture_is_the_same_however_it_is_rendered() {
    for more in [
        &["--denoise"][..],
        &["--set", "render.samples=64", "--noise", "0.05"],
        &["--set", "output.alpha=true", "--layers", "albedo,depth,variance"],
        &["--set", "output.masks=[\"ball\"]", "--set", "output.cryptomatte=[Objects]"],
    ] {
        let sandbox = Sandbox::new();
        sandbox.write("film.ron", FILM.replace("radius: 0.6", "name: \"ball\", radius: 0.6"));
        let line = ["render", "film.ron", "--frame", "2", "--no-metadata", "-q"];
        let run = |own: &[&str]| sandbox.run(&[&line[..], more, own].concat()).ends(0);
        run(&["-j", "1", "-o", "one.exr"]);
        run(&["-j", "2", "-o", "two.exr"]);
        run(&["--samples", "3", "--checkpoint", "c.film", "-o", "few.exr"]);
        run(&["--resume", "c.film", "-o", "more.exr"]);
        for name in ["two.exr", "more.exr"] {
            assert!(sandbox.read(name) == sandbox.read("one.exr"), "{more:?} {name}");
        }
        assert!(sandbox.read("few.exr") != sandbox.read("one.exr"), "{more:?}");
    }
}

/// Where things are at the frame's beginning says nothing of where they go.
#[test]
fn another_way_is_another_scene() {
    let sandbox = film();
    sandbox.run(&["render", "film.ron", "--samples", "2", "--checkpoint", "c.film", "-o", "a.pfm"]).ends(0);
    sandbox.write("film.ron", FILM.replace("2*time", "3*time"));
    sandbox.run(&["render", "film.ron", "--resume", "c.film", "-o", "b.pfm"]).ends(2);
}

#[test]
fn what_is_wrong_later_is_told_with_the_moment() {
    let sandbox = Sandbox::new();
    let wrong = FILM.replace("radius: 0.6", "radius: \"=if(abs(time - 0.05) < 0.04, -1, 1)\"");
    sandbox.write("film.ron", &wrong);
    sandbox.run(&["check", "film.ron"]).ends(0);
    let told = ["must be positive", "while the shutter is open", "film.ron:7"];
    sandbox.run(&["render", "film.ron", "-o", "a.png"]).ends(2).says(&told);
    assert!(!sandbox.files().contains(&"a.png".to_owned()), "{:?}", sandbox.files());
    sandbox.run(&["render", "film.ron", "-o", "a.png", "--integrator", "reference"]).ends(2).says(&told);
    // The end is looked at before anything is rendered, in every frame.
    sandbox.write("film.ron", FILM.replace("radius: 0.6", "radius: \"=1.7 - time\""));
    sandbox
        .run(&["check", "film.ron"])
        .ends(2)
        .says(&["must be positive", "(at frame 3.5, while the shutter is open)"]);
}

#[test]
fn samples_are_explained_at_their_moments() {
    let sandbox = film();
    let inspect = |sample: &str| {
        sandbox
            .run(&["inspect", "film.ron", "--pixel", "11,8", "--sample", sample, "--format", "json"])
            .ends(0)
            .out_text()
    };
    assert!((0..6).map(|k| inspect(&k.to_string())).collect::<std::collections::BTreeSet<_>>().len() > 1);
    sandbox.run(&["render", "film.ron", "--integrator", "reference", "--samples", "4", "-o", "r.png"]).ends(0);
}
