//! Renderings that end because they are good enough, or because their time is up.

use crate::support::Sandbox;
use serde_json::Value;

fn report(sandbox: &Sandbox, name: &str) -> Value {
    serde_json::from_slice(&sandbox.read(name)).expect("a report")
}

#[test]
fn a_noise_goal_ends_the_rendering_where_it_is_reached() {
    let sandbox = Sandbox::new();
    let line = ["render", "scene.ron", "-o", "a.pfm", "--noise", "5%", "--report", "a.json"];
    sandbox.run(&line).ends(0).says(&["that is good enough"]);
    let report = report(&sandbox, "a.json");
    let samples = report["picture"]["samples_min"].as_u64().expect("a number");
    assert_eq!(report["picture"]["samples_max"], samples);
    assert!(report["noise"]["relative"].as_f64().is_some_and(|noise| noise <= 0.05), "{report}");
    assert_eq!(report["interrupted"], false);
    let apart = (1 << samples.ilog2()) / 4;
    assert!(samples >= 16 && samples.is_multiple_of(apart), "{samples}");
    // As the report says, on one thread, and by the scene: the same bytes.
    let samples = samples.to_string();
    assert!(report["command"].as_str().is_some_and(|command| command.contains(&format!("--samples {samples}"))));
    sandbox.run(&["render", "scene.ron", "-o", "b.pfm", "--samples", &samples, "-j", "1"]).ends(0);
    let by_scene =
        ["render", "scene.ron", "-o", "c.pfm", "--set", "render.noise=0.05", "--set", "render.samples=100000"];
    sandbox.run(&by_scene).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("c.pfm"));
}

/// A lamp smaller than a pixel is most of the noise, and no goal will be reached: that is told, with the way.
#[test]
fn a_noise_that_few_pixels_bear_is_told() {
    let sandbox = Sandbox::new();
    let scene = |visible: bool| {
        format!(
            r#"Scene(
    version: 1,
    image: Image(width: 96, height: 64),
    camera: Camera(position: (0, 0.2, 6), look_at: (0, 0, 0), fov: 40),
    lights: [SphereLight(center: (0.3, 1.2, 0), radius: 0.012, power: 60, camera_visible: {visible})],
    objects: [Rectangle(center: (0, 0, -2), size: (20, 20), normal: (0, 0, 1))],
)"#
        )
    };
    sandbox.write("lamp.ron", scene(true));
    let line = ["render", "lamp.ron", "-o", "a.png", "--noise", "3%", "--samples", "256", "--report", "a.json"];
    let says = ["the others have", "which is good enough", "camera_visible: false", "256 samples came first"];
    sandbox.run(&line).ends(0).says(&says);
    let noise = report(&sandbox, "a.json")["noise"].clone();
    assert!(noise["few"]["rest"].as_f64().is_some_and(|rest| rest < 0.03), "{noise}");
    assert!(noise["few"]["pixels"].as_u64().is_some_and(|pixels| pixels <= 6), "{noise}");
    sandbox.write("lamp.ron", scene(false));
    sandbox.run(&line).ends(0).says(&["that is good enough"]);
    assert_eq!(report(&sandbox, "a.json")["noise"]["few"], Value::Null);
}

#[test]
fn samples_come_before_a_noise_that_is_not_reached() {
    let sandbox = Sandbox::new();
    let line = ["render", "scene.ron", "-o", "a.png", "--noise", "0.0001", "--samples", "17"];
    sandbox.run(&line).ends(0).says(&["17 samples came first"]);
    sandbox.run(&["render", "scene.ron", "-o", "b.png", "--samples", "17"]).ends(0);
    assert_eq!(sandbox.read("a.png"), sandbox.read("b.png"));
    sandbox.run(&["render", "scene.ron", "-o", "a.png", "--noise", "5%", "--quiet"]).ends(0).silent();
    sandbox.run(&["render", "scene.ron", "-o", "a.png", "--noise", "2"]).ends(2).says(&["a relative error"]);
}

#[test]
fn a_time_ends_the_rendering_with_all_written() {
    let sandbox = Sandbox::new();
    let line =
        ["render", "scene.ron", "-o", "a.png", "--time", "500ms", "--report", "a.json", "--checkpoint", "a.tracer"];
    sandbox.run(&line).ends(0).says(&["the time is up"]);
    let first = report(&sandbox, "a.json");
    assert!(first["picture"]["samples_min"].as_u64().is_some_and(|samples| samples > 0));
    assert_eq!(first["interrupted"], false);
    assert!(!sandbox.read("a.png").is_empty());
    sandbox.run(&["repro", "a.png"]).ends(0).says(&["the same bytes"]);
    // What was rendered goes on.
    sandbox
        .run(&["render", "scene.ron", "-o", "a.png", "--time", "300ms", "--report", "b.json", "--resume", "a.tracer"])
        .ends(0);
    let second = report(&sandbox, "b.json");
    assert!(second["samples"]["total"].as_u64() > first["samples"]["total"].as_u64());
    // With samples to spare the time is not used.
    sandbox.run(&["render", "scene.ron", "-o", "c.png", "--time", "1h", "--samples", "2"]).ends(0);
    sandbox.run(&["render", "scene.ron", "-o", "d.png", "--samples", "2"]).ends(0);
    assert_eq!(sandbox.read("c.png"), sandbox.read("d.png"));
}

/// A time may end it between two passes, too, and then there is no plan: until one is told.
#[test]
fn what_a_time_has_ended_is_made_again_by_its_plan() {
    let sandbox = Sandbox::new();
    let plan = (0..40).find_map(|k| {
        let time = format!("{}ms", 200 + 37 * k);
        sandbox.run(&["render", "scene.ron", "-o", "a.png", "--time", &time, "--report", "a.json"]).ends(0);
        let told = report(&sandbox, "a.json");
        let plan = told["command"].as_str()?.split(" --plan ").nth(1)?;
        Some(plan.split(' ').next().unwrap_or(plan).to_owned())
    });
    let plan = plan.expect("one of forty is ended within a pass");
    sandbox.run(&["render", "scene.ron", "-o", "again.png", "--plan", &plan, "-j", "1"]).ends(0);
    assert_eq!(sandbox.read("a.png"), sandbox.read("again.png"));
    sandbox.run(&["repro", "a.png"]).ends(0).says(&["the same bytes"]);
}

#[test]
fn a_plan_is_the_same_bytes_on_any_threads() {
    let sandbox = Sandbox::new();
    for (threads, name) in [("1", "a.png"), ("2", "b.png"), ("3", "c.png")] {
        let line = ["render", "scene.ron", "-o", name, "--plan", "8,16,1,8", "-j", threads, "--report", "a.json"];
        sandbox.run(&line).ends(0);
        let picture = &report(&sandbox, "a.json")["picture"];
        assert_eq!([&picture["samples_min"], &picture["samples_max"]], [8, 16]);
        assert_eq!(sandbox.read("a.png"), sandbox.read(name));
    }
    sandbox.run(&["repro", "b.png"]).ends(0).says(&["the same bytes"]);
    for bad in ["8,16,1", "0,1,1,1", "1,4294967295,2,1"] {
        sandbox.run(&["render", "scene.ron", "-o", "e.png", "--plan", bad]).ends(2).says(&["four numbers"]);
    }
}

/// What a noise goal has ended while quiet tiles rest is told, and made again to the byte: by the report's command,
/// from the picture, and wherever it was interrupted.
#[test]
fn quiet_tiles_rest_where_a_noise_is_asked_for() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "glass.ron",
        r#"Scene(
    version: 1,
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 72, height: 56),
    background: (0.2, 0.3, 0.4),
    render: Render(max_bounces: 4, caustics: None),
    lights: [SphereLight(center: (4, 5, 1), radius: 0.4, radiance: 200)],
    objects: [
        Disk(center: (1.3, 0, 0.3), radius: 1.3, normal: (0, 1, 0)),
        Sphere(center: (1.6, 0.6, 0), radius: 0.6, material: Transparent(ior: 1.5)),
    ],
)"#,
    );
    let noise = |samples: &str| {
        sandbox.run(&["render", "glass.ron", "-o", "x.png", "--samples", samples, "--report", "x.json"]).ends(0);
        report(&sandbox, "x.json")["noise"]["relative"].as_f64().expect("a number")
    };
    let goal = (0.6 * noise("64")).to_string();
    let line = ["render", "glass.ron", "-o", "a.png", "--noise", &goal, "--report", "a.json"];
    sandbox.run(&line).ends(0).says(&["on average: that is good enough"]);
    let of_first = report(&sandbox, "a.json");
    let picture = of_first["picture"].clone();
    assert_eq!(picture["adaptive"], true);
    let [least, mean, most] =
        ["samples_min", "samples_mean", "samples_max"].map(|name| picture[name].as_f64().expect("a number"));
    assert!(64.0 < least && least < 0.8 * most && least <= mean && mean < most, "{picture}");
    let command = of_first["command"].as_str().expect("a command");
    assert!(command.contains("--adaptive always"), "{command}");
    let again = command.replace("a.png", "b.png");
    sandbox.run(&again.split(' ').skip(1).chain(["-j", "1"]).collect::<Vec<_>>()).ends(0);
    assert_eq!(sandbox.read("a.png"), sandbox.read("b.png"));
    sandbox.run(&["repro", "a.png"]).ends(0).says(&["the same"]);
    // Of what one part has, all make the whole.
    let most = most.to_string();
    let whole = ["--samples", &most, "--adaptive", "always", "--seed", "3"];
    sandbox.run(&[&["render", "glass.ron", "-o", "c.pfm"][..], &whole].concat()).ends(0);
    for part in ["1/2", "2/2"] {
        let file = format!("{}.tracer", &part[..1]);
        sandbox.run(&[&["render", "glass.ron", "--part", part, "-o", &file][..], &whole].concat()).ends(0);
    }
    sandbox.run(&["merge", "1.tracer", "2.tracer", "-o", "d.pfm"]).ends(0);
    assert_eq!(sandbox.read("c.pfm"), sandbox.read("d.pfm"));
    // A checkpoint of it is gone on with, and no other way.
    let kept = ["render", "glass.ron", "-o", "e.pfm", "--resume", "e.tracer"];
    sandbox.run(&[&kept[..], &["--samples", "100", "--adaptive", "always", "--seed", "3"]].concat()).ends(0);
    sandbox
        .run(&[&kept[..], &["--samples", "120", "--adaptive", "never", "--seed", "3"]].concat())
        .ends(2)
        .says(&["adaptive sampling"]);
    sandbox.run(&[&kept[..], &whole].concat()).ends(0);
    assert_eq!(sandbox.read("c.pfm"), sandbox.read("e.pfm"));
}
