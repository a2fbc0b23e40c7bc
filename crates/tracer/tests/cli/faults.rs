//! What goes wrong: exit codes, messages that help, and that an older picture stays.

use crate::support::{Ran, SCENE, Sandbox};
use std::fs;
use std::process::Stdio;

#[test]
fn a_wrong_command_line_ends_with_2() {
    let sandbox = Sandbox::new();
    let render = |more: &[&str]| sandbox.run(&[&["render", "scene.ron"][..], more].concat()).ends(2);
    sandbox.run(&["rendr"]).ends(2).says(&["unrecognized subcommand", "render"]);
    sandbox.run(&["fix", "a.ron"]).ends(2).says(&["`tracer check --fix scene.ron` mends what is certain"]);
    render(&["-o", "a.gif"]).says(&["a.gif", "`.gif`", "png, exr, hdr, pfm"]);
    render(&["-o", "a"]).says(&["no extension", "a.png"]);
    render(&["-o", "."]).says(&["-o . is a folder", "-o ./scene.png"]);
    render(&["-o", "./"]).says(&["-o ./ is a folder", "-o ./scene.png"]);
    render(&["-o", "./.png"]).says(&["-o ./.png has no name before its extension; name it -o ./scene.png\n"]);
    render(&["-o", ".exr"]).says(&["name it -o scene.exr\n"]);
    render(&["-o", "no/"]).says(&["there is no folder no/; make it, and name the picture in it: -o no/scene.png\n"]);
    render(&["-o", "a.png", "-o", "a.png"]).says(&["a.png is given twice"]);
    render(&["-o", "a.png", "-o", "./a.png"]).says(&["./a.png is given twice (it is a.png)"]);
    render(&["-o", "a.png", "--report", "a.png"]).says(&["-o and --report"]);
    render(&["-o", "a.png", "--report", "./a.png"]).says(&["-o and --report"]);
    render(&["-o", "a.png", "--report", "./scene.ron"]).says(&["./scene.ron would replace the scene"]);
    render(&["-o", "a.png", "--format", "exr"]).says(&["--format"]);
    render(&["-o", "a.exr", "--bits", "16"]).says(&["--bits", "PNG"]);
    render(&["-o", "a.png", "--bits", "12"]).says(&["--bits", "12"]);
    render(&["-o", "a.png", "--samples", "0"]).says(&["--samples", "1..=1000000000"]);
    render(&["-o", "a.png", "--size", "64"]).says(&["--size", "640x480"]);
    render(&["-o", "a.png", "--size", "99999x1"]).says(&["--size", "65536"]);
    render(&["-o", "a.png", "--crop", "1,2,3"]).says(&["--crop", "100,50,64,64"]);
    render(&["-o", "a.png", "--threads", "0"]).says(&["--threads"]);
    render(&["-o", "a.png", "--exposure", "nan"]).says(&["--exposure"]);
    render(&["-o", "a.png", "--smaples", "3"]).says(&["--smaples", "--samples"]);
    let mut lanes = sandbox.command(&["render", "scene.ron", "-o", "a.png"]);
    Ran::of(lanes.env("TRACER_LANES", "4")).ends(2).says(&["TRACER_LANES", "1, 8 or 16"]);
    assert_eq!(sandbox.files(), ["scene.ron"]);
}

#[test]
fn a_thousand_faults_are_enough() {
    let sandbox = Sandbox::new();
    let meshes: String = (0..1500).map(|k| format!("    Mesh(file: \"m{k}.obj\"),\n")).collect();
    sandbox.write("many.ron", format!("Scene(background: 1, objects: [\n{meshes}])\n"));
    sandbox.run(&["check", "many.ron"]).ends(2).says(&["999 more like this", "more than 1000 faults", "1001 errors"]);
}

/// A part that a mesh file does not have is told where it is written, with the names that there are.
#[test]
fn parts_of_meshes_that_are_none_are_told() {
    let sandbox = Sandbox::new();
    sandbox.write("car.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no body\nf 1 2 3\ng wheel\nf 3 2 1\n");
    sandbox.write("car.ply", "ply\n");
    let with = |words: &str| {
        sandbox.write("car.ron", format!("Scene(background: 1, objects: [\n    Mesh({words}),\n])\n"));
        sandbox.run(&["check", "car.ron"])
    };
    with("file: \"car.obj\", part: \"wheel\"").ends(0);
    let told = ["E0514", "car.ron:2:33", "there is no part `whel`", "`body`, `wheel`", "did you mean `wheel`?"];
    with("file: \"car.obj\", part: \"whel\"").ends(2).says(&told);
    with("file: \"car.ply\", part: \"wheel\"").ends(2).says(&["E0514", "PLY files have no parts", "OBJ, glTF or GLB"]);
    // Two parts of one file, one of which there is.
    let both = "file: \"car.obj\", part: \"body\"), Mesh(file: \"car.obj\", part: \"door\"";
    with(both).ends(2).says(&["there is no part `door`", "1 error"]);
}

/// A scene with a mesh, its MTL file, its texture, placements, and a texture of the scene.
fn furnished() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "t.png", "-o", "m.png", "--samples", "1"]).ends(0);
    sandbox.write(
        "t.obj",
        "mtllib t.mtl.png\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
    );
    sandbox.write("t.mtl.png", "newmtl a\nmap_Kd m.png\n");
    sandbox.write("t.txt", "0 0 0\n");
    sandbox.write(
        "all.ron",
        "Scene(background: 1, render: Render(samples: 1), image: Image(width: 8, height: 8), objects: [
            Mesh(file: \"t.obj\", placements: \"t.txt\"),
            Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: Texture(file: \"t.png\"))),
        ])",
    );
    sandbox
}

/// A scene that is written replaces no file that the one it was made of names, not even by force.
#[test]
fn converted_scenes_spare_what_they_include() {
    let sandbox = Sandbox::new();
    let library = "Scene(materials: { \"red\": Diffuse(albedo: (0.6, 0.1, 0.1)) })";
    sandbox.write("lib.ron", library);
    sandbox.write(
        "all.toml",
        "include = [\"lib.ron\"]\nbackground = 1\n[[objects]]\n\
         Sphere = { center = [0, 0, 0], radius = 1, material = \"red\" }\n",
    );
    for output in ["lib.ron", "./lib.ron"] {
        let says = format!("-o {output} would replace a file that the scene names");
        sandbox.run(&["convert", "all.toml", "-o", output, "--force"]).ends(2).says(&[&says]);
    }
    assert_eq!(sandbox.text("lib.ron"), library);
    sandbox.run(&["convert", "all.toml", "-o", "all.ron"]).ends(0);
    // A library's own library, though it renders nothing, and what a picture's scene includes.
    sandbox.write("more.toml", "include = [\"lib.ron\"]\n[vars]\nh = 2\n");
    let says = "-o lib.ron would replace a file that the scene names";
    sandbox.run(&["convert", "more.toml", "-o", "lib.ron", "--force"]).ends(2).says(&[says]);
    sandbox.shell("\"$T\" convert - --syntax toml -o lib.ron --force < more.toml").ends(2).says(&[says]);
    sandbox.run(&["render", "all.ron", "-o", "all.png", "-s", "1", "--size", "8x8"]).ends(0);
    sandbox.run(&["new", "lib.ron", "--from", "all.png", "--force"]).ends(2).says(&["is a file that the scene names"]);
    assert_eq!(sandbox.text("lib.ron"), library);
}

/// The others are looked at whatever is wrong with the first; what is there to be included is sound, and is laid out.
#[test]
fn many_scenes_are_checked() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "a.ron",
        "Scene(background: 1, objects: [Mesh(file: \"no.obj\"), Sphere(centre: (0, 0, 0), radius: 1)])",
    );
    sandbox.write("b.ron", "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])");
    sandbox.write("lib.ron", "Scene(vars: {\"h\": 2}, materials: {\"red\": Diffuse(albedo: (0.6, 0.1, 0.1))})");
    sandbox.write("bad.ron", "Scene(materials: {\"red\": Diffuse(albedo: (7, 0.1, 0.1))})");
    sandbox.write("lost.ron", "Scene(materials: {\"red\": Diffuse(albedo: Texture(file: \"no.png\"))})");
    let ran = sandbox.run(&["check", "a.ron", "b.ron", "lib.ron", "bad.ron", "lost.ron"]).ends(2);
    let out = ran.out_text();
    ran.says(&["centre", "no.obj", "the red channel of the albedo", "no.png", "3 of 5 scenes are wrong"]);
    assert!(out.contains("b.ron: ok, 1 object") && out.contains("lib.ron: ok, to be included"), "{out}");
    sandbox.write("style.ron", "Scene(image: Image(width: 90), render: Render(samples: 3), background: 1)");
    assert!(sandbox.run(&["check", "style.ron"]).ends(0).out_text().contains("style.ron: ok, to be included"));
    sandbox.write("begun.ron", "Scene(background: 1)");
    sandbox.run(&["check", "begun.ron"]).ends(2).says(&["the scene has no objects"]);
    sandbox.run(&["fmt", "lib.ron"]).ends(0);
    assert!(sandbox.text("lib.ron").contains("vars: { \"h\": 2 }"), "{}", sandbox.text("lib.ron"));
    // Names that nobody has given and values out of range are laid out all the same.
    sandbox.write("c.ron", "Scene(background: 1, objects: [Sphere(center: (0,0,0), radius: -1, material: \"rde\")])");
    sandbox.run(&["fmt", "c.ron"]).ends(0);
    assert!(sandbox.text("c.ron").contains("radius: -1, material: \"rde\""), "{}", sandbox.text("c.ron"));
}

/// Nothing that the scene is made of is replaced, under none of its names, and nothing that is compared.
#[test]
fn inputs_are_never_overwritten() {
    let sandbox = furnished();
    let before: Vec<Vec<u8>> = sandbox.files().iter().map(|name| sandbox.read(name)).collect();
    let names = sandbox.files();
    for input in ["t.png", "m.png", "t.mtl.png", "./t.png"] {
        let says = format!("-o {input} would replace a file of the scene");
        sandbox.run(&["render", "all.ron", "-o", input]).ends(2).says(&[&says]);
    }
    for input in ["t.obj", "t.txt", "t.png", "t.mtl.png"] {
        let says = format!("--report {input} would replace a file of the scene");
        sandbox.run(&["render", "all.ron", "-o", "out.png", "--report", input]).ends(2).says(&[&says]);
    }
    sandbox
        .run(&["render", "all.ron", "-o", "out.png", "--report", "all.ron"])
        .ends(2)
        .says(&["would replace the scene"]);
    sandbox.run(&["compare", "t.png", "m.png", "-o", "t.png"]).ends(2).says(&["-o t.png would replace a picture"]);
    sandbox.run(&["compare", "t.png", "m.png", "-o", "./m.png"]).ends(2).says(&["./m.png would replace", "(m.png)"]);
    // Parts know the files by what they hold, and the scene by its name.
    for part in ["1/2", "2/2"] {
        let name = format!("{}.tracer", &part[..1]);
        sandbox.run(&["render", "all.ron", "-s", "2", "--part", part, "-o", &name]).ends(0);
    }
    let merge = |more: &[&str]| sandbox.run(&[&["merge", "1.tracer", "2.tracer"][..], more].concat());
    for input in ["t.png", "m.png", "./t.png"] {
        merge(&["-o", input]).ends(2).says(&[&format!("-o {input} would replace a file of the scene")]);
    }
    for input in ["t.obj", "t.txt", "all.ron"] {
        let says = format!("--report {input} would replace a file of the scene");
        merge(&["-o", "out.png", "--report", input]).ends(2).says(&[&says]);
    }
    ["1.tracer", "2.tracer"].iter().for_each(|part| std::fs::remove_file(sandbox.path(part)).expect("it is there"));
    assert_eq!(sandbox.files(), names);
    assert!(names.iter().zip(before).all(|(name, bytes)| sandbox.read(name) == bytes));
    // Pictures and reports of earlier runs are.
    for _ in 0..2 {
        sandbox.run(&["render", "all.ron", "-o", "out.png", "--report", "out.json"]).ends(0);
        sandbox.run(&["compare", "t.png", "m.png", "-o", "map.png"]).ends(0);
    }
}

/// A scene is written once: whoever wants to replace one says so.
#[test]
fn scenes_are_replaced_only_by_force() {
    let sandbox = Sandbox::new();
    sandbox.write("b.toml", "mine");
    for command in [&["convert", "scene.ron", "-o", "b.toml"][..], &["new", "b.toml"]] {
        sandbox.run(command).ends(2).says(&["b.toml is there already", "--force"]);
        assert_eq!(sandbox.text("b.toml"), "mine");
    }
    sandbox.run(&["convert", "scene.ron", "-o", "b.toml", "--force"]).ends(0).silent();
    assert!(sandbox.text("b.toml").contains("[camera]"));
    sandbox
        .run(&["convert", "scene.ron", "--to", "ron", "-o", "./scene.ron", "--force"])
        .ends(2)
        .says(&["is the scene itself"]);
}

/// What is wrong with the text and what is wrong with the files it names is told in one run.
#[test]
fn text_and_files_in_one_run() {
    let sandbox = Sandbox::new();
    sandbox.write("m.stl", "solid");
    sandbox.write(
        "wrong.ron",
        "Scene(backgrond: 1, objects: [
            Mesh(file: \"no.obj\"), Mesh(file: \"m.stl\", colour: 1),
            Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: Texture(file: \"no.png\"))),
        ])",
    );
    let ran = sandbox.run(&["check", "wrong.ron"]).ends(2);
    ran.says(&["`backgrond`", "no.obj", "m.stl", "`colour`", "no.png", "5 errors"]);
}

/// A material that adds light is told with the number and the word that mends it; with that word nothing is said.
#[test]
fn a_material_that_adds_light_is_told() {
    let sandbox = Sandbox::new();
    let scene = |more: &str| {
        format!(
            "Scene(background: 1, render: Render(samples: 1), image: Image(width: 8, height: 8), materials: {{ \
             \"loud\": BlinnPhong(albedo: 0.9, exponent: 1000, specular: 0.5{more}) }}, objects: [\
             Sphere(center: (0, 0, 0), radius: 1, material: \"loud\"), \
             Sphere(center: (3, 0, 0), radius: 1, material: \"loud\")])"
        )
    };
    sandbox.write("loud.ron", scene(""));
    sandbox.write("mended.ron", scene(", energy_conserving: true"));
    for command in [&["check", "loud.ron"][..], &["render", "loud.ron", "-o", "a.png"]] {
        let ran = sandbox.run(command).ends(0).says(&["W0302", "up to 2.24 times", "energy_conserving: true"]);
        assert_eq!(ran.err.matches("W0302").count(), 1, "{}", ran.err);
    }
    sandbox.run(&["render", "mended.ron", "-o", "a.png"]).ends(0).silent();
}

/// Two names of one file, whether it is there or not.
#[cfg(unix)]
#[test]
fn a_file_is_known_under_all_its_names() {
    use std::os::unix::fs::symlink;
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("folder")).expect("a folder");
    symlink("folder", sandbox.path("other")).expect("a link");
    symlink("folder/b.png", sandbox.path("link.png")).expect("a link to nothing yet");
    let twice = |one: &str, two: &str| {
        sandbox.run(&["render", "scene.ron", "-o", one, "-o", two]).ends(2).says(&[two, "is given twice", one]);
    };
    twice("a.png", "folder/../a.png");
    twice("folder/a.png", "other/a.png");
    twice("link.png", "folder/b.png");
    sandbox.write("a.png", "PF old");
    twice("a.png", "other/../a.png");
    assert_eq!(sandbox.text("a.png"), "PF old");
    // Two files are two, also under one name in two folders.
    sandbox.run(&["render", "scene.ron", "-o", "a.png", "-o", "folder/a.png"]).ends(0);
}

#[test]
fn a_wrong_command_gets_a_tip() {
    let sandbox = Sandbox::new();
    let wrong = |arguments: &[&str], tip: &str| {
        sandbox.run(arguments).ends(2).says(&["tip: ", tip]);
    };
    wrong(&["rende"], "'render'");
    wrong(&["rende", "scene.ron", "-o", "a.png"], "'render'");
    wrong(&["cat.obj"], "tracer new scene.ron");
    wrong(&["a.png"], "tracer compare a.png");
    wrong(&["--output", "x"], "--output belongs to a command, as in tracer render");
    wrong(&["-o", "x"], "-o belongs to a command");
    wrong(&["--samples", "3"], "--samples belongs to a command");
    wrong(&["--resolved"], "--resolved belongs to tracer info");
    wrong(&["render", "scene.ron", "--spp", "3"], "--samples 64");
    wrong(&["render", "scene.ron", "--width=3"], "--size 640x480");
    wrong(&["render", "scene.ron", "-w", "100", "-h", "80"], "--size 100x80");
    wrong(&["render", "scene.ron", "--all-cameras"], "--camera NAME, in one run for each");
    for words in ["serve preview", "view preview", "format fmt", "init new", "test golden", "validate check"] {
        let (word, ours) = words.split_once(' ').expect("two");
        wrong(&[word], &format!("'{ours}'"));
    }
    wrong(&["version"], "tracer --version");
    wrong(&["render", "scene.ron", "--watch"], "tracer preview SCENE");
    let ran = sandbox.run(&["render", "scene.ron", "--watch"]);
    assert_eq!(ran.err.matches("tip: ").count(), 1, "{}", ran.err);
    sandbox.run(&["preview", "scene.ron", "--port", "abc"]).ends(2).says(&["expected a whole number in 0..=65535"]);
    sandbox.run(&["render", "scene.ron", "--seed", "-1"]).ends(2).says(&["expected a whole number in 0..=4294967295"]);
    sandbox.run(&["bench-figures", "foo"]).ends(2).says(&["expected the number of a figure, in 1..=9"]);
    wrong(&["render", "scene.ron", "--outptu", "a.png"], "'--output'");
    assert_eq!(sandbox.files(), ["scene.ron"]);
}

#[test]
fn a_wrong_scene_ends_with_2_and_shows_every_fault() {
    let sandbox = Sandbox::new();
    sandbox.write("bad.ron", SCENE.replace("fov: 40", "fvo: 40").replace("radius: 100)", "radius: -100)"));
    let ran = sandbox.run(&["render", "bad.ron", "-o", "a.png"]).ends(2);
    let ran = ran.says(&["bad.ron:3:", "did you mean `fov`?", "bad.ron:10:", "2 errors", "tracer explain E0201"]);
    assert_eq!(ran.out, b"");
    assert_eq!(sandbox.files(), ["bad.ron", "scene.ron"]);
    // The caret of --set points into the argument.
    sandbox
        .run(&["render", "scene.ron", "-o", "a.png", "--set", "camera.fov=-3"])
        .ends(2)
        .says(&["--set:1:12", "camera.fov=-3"]);
}

#[test]
fn missing_assets_are_shown_in_the_scene() {
    let sandbox = Sandbox::new();
    sandbox.write("mesh.ron", r#"Scene(objects: [Mesh(file: "nowhere.obj")], background: 1)"#);
    for command in [&["check", "mesh.ron"][..], &["render", "mesh.ron", "-o", "a.png"], &["info", "mesh.ron"]] {
        sandbox.run(command).ends(2).says(&["mesh.ron:1:28", "nowhere.obj", "1 error"]);
    }
    let ran = sandbox.run(&["check", "mesh.ron", "--diagnostics", "json"]).ends(2);
    let line: serde_json::Value = serde_json::from_str(&ran.err).expect("one JSON object and nothing else");
    assert_eq!(line["severity"], "error");
    assert_eq!(line["start"]["column"], 28);
}

#[test]
fn diagnostics_as_json_are_one_object_a_line() {
    let sandbox = Sandbox::new();
    sandbox.write("bad.toml", "[camera]\nfvo = 3\n[[objects]]\nSphere = { radius = -1 }\n");
    let ran = sandbox.run(&["check", "bad.toml", "--diagnostics", "json"]).ends(2);
    let lines: Vec<serde_json::Value> =
        ran.err.lines().map(|line| serde_json::from_str(line).expect("a JSON object")).collect();
    assert!(lines.iter().any(|line| line["code"] == "E0201" && line["edit"]["replacement"] == "fov"));
    assert!(lines.iter().all(|line| line["file"] == "bad.toml"));
}

#[test]
fn what_is_not_there_ends_with_2() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "nowhere.ron", "-o", "a.png"]).ends(2).says(&["nowhere.ron", "tracer new nowhere.ron"]);
    sandbox.run(&["info", "."]).ends(2).says(&["cannot read .: it is a folder; name a scene file in it"]);
    for near in ["scen.ron", "scene.toml", "./scnee.ron"] {
        sandbox.run(&["check", near]).ends(2).says(&["there is no scene file", near, "did you mean", "scene.ron?"]);
    }
    sandbox.run(&["convert", "nowhere.ron"]).ends(2).says(&["there is no scene file nowhere.ron"]);
    sandbox.run(&["render", "scene.ron", "-o", "a.png"]).ends(0);
    sandbox.run(&["compare", "a.png", "b.png"]).ends(2).says(&["there is no picture b.png; did you mean a.png?"]);
}

#[test]
fn a_picture_or_a_mesh_is_no_scene() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "a.png"]).ends(0);
    sandbox
        .run(&["render", "a.png", "-o", "b.png"])
        .ends(2)
        .says(&["a.png is a picture, not a scene", "Texture(file:"]);
    for mesh in ["cat.obj", "cat.off", "cat.PLY", "cat.stl"] {
        sandbox.write(mesh, "v 0 0 0\n");
        let no_scene = format!("{mesh} is a mesh, not a scene");
        sandbox.run(&["check", mesh]).ends(2).says(&[&no_scene, "Mesh(file:", "tracer new"]);
    }
    sandbox.write("cat.mtl", "newmtl fur\n");
    sandbox.run(&["info", "cat.mtl"]).ends(2).says(&["cat.mtl holds the materials of an OBJ mesh"]);
    sandbox.run(&["compare", "scene.ron", "a.png"]).ends(2).says(&["scene.ron is not a picture"]);
    // A name is only a name: what is said to be a scene is one.
    sandbox.write("odd.png", SCENE);
    sandbox.run(&["check", "odd.png", "--syntax", "ron"]).ends(0);
}

#[test]
fn what_cannot_be_written_ends_with_1_before_rendering() {
    let sandbox = Sandbox::new();
    // So many samples that the test would not end if it rendered first.
    let render = |output: &[&str]| {
        let ran = sandbox.run(&[&["render", "scene.ron", "--samples", "100000000"][..], output].concat());
        ran.ends(1)
    };
    render(&["-o", "no/such/folder.png"]).says(&["there is no folder no/such"]);
    fs::create_dir(sandbox.path("folder.png")).expect("a folder");
    render(&["-o", "folder.png"]).says(&["folder.png", "it is a folder"]);
    // No one can make files there, whoever runs the tests.
    render(&["-o", "/proc/picture.png"]).says(&["/proc/picture.png"]);
    render(&["-o", "a.png", "--report", "no/report.json"]).says(&["no/report.json", "there is no folder no"]);
    sandbox.write("old.png", "old");
    let mut permissions = fs::metadata(sandbox.path("old.png")).expect("a file").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(sandbox.path("old.png"), permissions).expect("my file");
    render(&["-o", "old.png"]).says(&["old.png", "read-only"]);
    assert_eq!(sandbox.text("old.png"), "old");
    assert_eq!(sandbox.files(), ["folder.png", "old.png", "scene.ron"]);
}

#[test]
fn a_read_only_folder_ends_with_1() {
    let sandbox = Sandbox::new();
    let folder = sandbox.path("closed");
    fs::create_dir(&folder).expect("a folder");
    let mut permissions = fs::metadata(&folder).expect("a folder").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&folder, permissions).expect("my folder");
    // Root may write everywhere; then there is nothing to be seen.
    if fs::write(folder.join("probe"), "").is_ok() {
        return;
    }
    sandbox.run(&["render", "scene.ron", "-o", "closed/a.png"]).ends(1).says(&["closed/a.png"]);
}

#[test]
fn a_full_disk_keeps_the_older_picture() {
    let sandbox = Sandbox::new();
    sandbox.write("a.png", "PF old");
    // Files may have one block: the write fails in its middle, as on a full disk.
    let line = r#"trap '' XFSZ; ulimit -f 1; exec "$T" render scene.ron -o a.png --size 200x200"#;
    sandbox.shell(line).ends(1).says(&["cannot write a.png"]);
    assert_eq!(sandbox.text("a.png"), "PF old");
    assert_eq!(sandbox.files(), ["a.png", "scene.ron"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_ends_with_1() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "/dev/full", "--format", "png"]).ends(1).says(&["/dev/full", "space"]);
    let full = || Stdio::from(fs::OpenOptions::new().write(true).open("/dev/full").expect("a device"));
    let mut picture = sandbox.command(&["render", "scene.ron", "-o", "-", "--format", "png"]);
    Ran::of(picture.stdout(full())).ends(1).says(&["standard output", "space"]);
    Ran::of(sandbox.command(&["schema"]).stdout(full())).ends(1).says(&["standard output"]);
}

#[test]
fn an_older_picture_is_replaced_and_its_permissions_stay() {
    let sandbox = Sandbox::new();
    sandbox.write("a.png", "PF old");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(sandbox.path("a.png"), fs::Permissions::from_mode(0o640)).expect("my file");
        std::os::unix::fs::symlink("a.png", sandbox.path("link.png")).expect("a link");
        sandbox.run(&["render", "scene.ron", "-o", "link.png"]).ends(0);
        let mode = fs::metadata(sandbox.path("a.png")).expect("a file").permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
        assert!(fs::symlink_metadata(sandbox.path("link.png")).expect("a link").is_symlink());
    }
    #[cfg(not(unix))]
    sandbox.run(&["render", "scene.ron", "-o", "a.png"]).ends(0);
    assert!(sandbox.read("a.png").starts_with(b"\x89PNG"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_picture_larger_than_the_memory_is_refused() {
    let sandbox = Sandbox::new();
    let arguments = ["render", "scene.ron", "-o", "a.png", "--size", "65536x65536", "--samples", "1"];
    sandbox.run(&arguments).ends(1).says(&["65536x65536", "GiB", "--size", "--crop"]);
}

#[test]
fn colours_when_they_are_asked_for() {
    let sandbox = Sandbox::new();
    let plain = sandbox.run(&["check", "nowhere.ron"]).ends(2);
    assert!(!plain.err.contains('\x1b'));
    let coloured = sandbox.run(&["check", "nowhere.ron", "--color", "always"]).ends(2);
    assert!(coloured.err.contains('\x1b'));
    sandbox.write("bad.ron", "Scene(");
    assert!(sandbox.run(&["check", "bad.ron", "--color=always"]).ends(2).err.contains('\x1b'));
    assert!(sandbox.run(&["nothing", "--color=always"]).ends(2).err.contains('\x1b'));
}

#[test]
fn quiet_prints_errors_only() {
    let sandbox = Sandbox::new();
    // A material that nothing uses is a warning.
    sandbox.write("odd.ron", SCENE.replace("materials: {", r#"materials: { "spare": Diffuse(albedo: 0.5),"#));
    sandbox.run(&["render", "odd.ron", "-o", "a.png"]).ends(0).says(&["warning", "spare"]);
    sandbox.run(&["render", "odd.ron", "-o", "a.png", "--quiet"]).ends(0).silent();
    sandbox.run(&["render", "odd.ron", "-o", "a.png", "--quiet", "--set", "camera.fov=0"]).ends(2).says(&["fov"]);
}

/// A file that an included scene names and that is not there is told with how one gets to that scene; what an include
/// does not take, its background's picture among it, is not looked at.
#[test]
fn missing_files_of_included_scenes_are_told_with_the_way_there() {
    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("parts")).expect("a folder");
    let mesh = "Mesh(file: \"none.obj\")";
    sandbox.write(
        "parts/chair.ron",
        format!("Scene(background: Environment(file: \"none.hdr\"), camera: Camera(fov: 400),\n  objects: [{mesh}])"),
    );
    sandbox.write("parts/room.ron", "Scene(objects: [Include(file: \"chair.ron\")])");
    for fault in ["", ", fault: 1"] {
        sandbox.write(
            "house.ron",
            format!("Scene(background: 1{fault}, objects: [\n    Include(file: \"parts/room.ron\")])"),
        );
        let ran = sandbox.run(&["check", "house.ron"]).ends(2);
        let ran = ran.says(&[
            "E0501",
            "none.obj",
            "parts/chair.ron is included here",
            "house.ron:2:19: parts/room.ron is included",
        ]);
        assert!(!ran.err.contains("none.hdr"), "{}", ran.err);
    }
}

/// Of a mesh file that is text the very line is shown.
#[test]
fn faults_of_meshes_show_their_line() {
    let sandbox = Sandbox::new();
    sandbox.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n");
    sandbox.write("a.ron", "Scene(background: 1, objects: [Mesh(file: \"a.obj\")])");
    let ran = sandbox.run(&["check", "a.ron"]).ends(2);
    ran.says(&["E0510", "a.ron:1:43", "a.obj:3:5", "3 | v 0 one 0\n  |     ^^^"]);
}

/// One document on standard output, whatever is wrong with how many scenes.
#[test]
fn check_writes_sarif() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "bad.ron",
        "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radus: 1), Mesh(file: \"none.obj\")])",
    );
    let check = |scenes: &[&str], code: i32| -> serde_json::Value {
        let ran = sandbox.run(&[&["check", "--diagnostics", "sarif"], scenes].concat()).ends(code);
        serde_json::from_str(&ran.out_text()).expect("JSON")
    };
    let ids = |document: &serde_json::Value| -> Vec<String> {
        let results = document["runs"][0]["results"].as_array().expect("results").iter();
        results.map(|result| result["ruleId"].as_str().unwrap_or_default().to_owned()).collect()
    };
    assert_eq!(ids(&check(&["bad.ron", "scene.ron", "./bad.ron"], 2)), ["E0201", "E0501"]);
    let right = check(&["scene.ron"], 0);
    assert!(ids(&right).is_empty() && right["runs"][0]["tool"]["driver"]["name"] == "tracer");
    let missing = check(&["none.ron"], 2);
    assert_eq!(missing["runs"][0]["invocations"][0]["executionSuccessful"], false);
    // Others print as they go.
    sandbox
        .run(&["info", "scene.ron", "--diagnostics", "sarif"])
        .ends(2)
        .says(&["possible values: text, json, github"]);
}

/// Tips of the command line are ones that help.
#[test]
fn mistyped_commands_and_options_of_others_get_tips_that_help() {
    let sandbox = Sandbox::new();
    sandbox.run(&["hlep"]).ends(2).says(&["'help'"]);
    sandbox.run(&["golden", "rnu"]).ends(2).says(&["'run'"]);
    sandbox.run(&["info", "-q"]).ends(2).says(&["tracer info has no -q, which render, merge, "]);
    let ran = sandbox.run(&["render", "scene.ron", "--foo"]).ends(2);
    assert!(!ran.err.contains("as a value"), "{}", ran.err);
}

/// What is said of the materials of many mesh files is said once.
#[test]
fn materials_of_many_files_are_told_once() {
    let sandbox = Sandbox::new();
    let mut objects = String::new();
    for k in 0..5 {
        sandbox.write(&format!("{k}.obj"), format!("mtllib {k}.mtl\nusemtl x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
        sandbox.write(&format!("{k}.mtl"), "newmtl x\nKd 1 1 1\nPr 0.4\n");
        objects += &format!("Mesh(file: \"{k}.obj\"),");
    }
    sandbox.write("many.ron", format!("Scene(background: 1, objects: [{objects}])"));
    let ran = sandbox.run(&["check", "many.ron"]).ends(0);
    assert_eq!(ran.err.matches("W0511").count(), 1, "{}", ran.err);
    assert!(ran.err.contains("not supported: `Pr`; the same goes for 4 more mesh files"), "{}", ran.err);
}

/// A part of a solid that shines is a light. By what nobody knows of it is one fault: whether the scene has light is
/// not asked then.
#[test]
fn a_shining_part_of_a_solid_is_one_fault() {
    let sandbox = Sandbox::new();
    let lamp = "Difference(objects: [Box(size: 2, material: Emissive(radiance: 3)), Box(size: 1)])";
    sandbox.write("lamp.ron", format!("Scene(objects: [{lamp}])"));
    let ran = sandbox.run(&["check", "lamp.ron"]).ends(0);
    assert!(!ran.err.contains("W0301"), "{}", ran.err);
    let powered = lamp.replace("radiance", "power");
    sandbox.write("lamp.ron", format!("Scene(objects: [{powered}])"));
    let ran = sandbox.run(&["check", "lamp.ron"]).ends(2);
    assert!(ran.err.contains("E0544") && !ran.err.contains("W0301"), "{}", ran.err);
}
