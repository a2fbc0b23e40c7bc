//! Pictures to lay over others: `output.alpha` and `output.backdrop`.

use crate::support::Sandbox;
use image::{ColorType, ImageReader};
use std::path::Path;

/// A red square, half of the picture, that all light meets alike: before a bright background, seen straight on.
const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 0, 10), look_at: (0, 0, 0), fov: 20),
    image: Image(width: 32, height: 32),
    background: (0.5, 2, 8),
    objects: [Rectangle(center: (-2, 0, 0), normal: (0, 0, 1), size: 4, material: Diffuse(albedo: (0.8, 0.1, 0.01)))],
)"#;

fn open(path: &Path) -> image::DynamicImage {
    ImageReader::open(path).expect("a file").decode().expect("a picture")
}

#[test]
fn png_and_exr_say_what_is_covered() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE);
    let clear = ["render", "scene.ron", "-q", "-s", "16", "--set", "output.alpha=true", "-o", "a.png", "-o", "a.exr"];
    sandbox.run(&clear).ends(0).silent();
    let picture = open(&sandbox.path("a.png"));
    assert_eq!(picture.color(), ColorType::Rgba8);
    let picture = picture.into_rgba8();
    // Nothing is there, not even a colour; the square has its own, wherever it covers a part.
    assert_eq!(picture.get_pixel(28, 16).0, [0, 0, 0, 0]);
    let square = picture.get_pixel(8, 16).0;
    assert_eq!(square[3], 255);
    let part: Vec<[u8; 4]> = picture.pixels().map(|pixel| pixel.0).filter(|p| p[3] != 0 && p[3] != 255).collect();
    assert!(!part.is_empty());
    for pixel in part {
        let off = (0..3).map(|c| pixel[c].abs_diff(square[c])).max();
        assert!(off <= Some(1), "{pixel:?} is not of the colour {square:?}");
    }
    // EXR: multiplied, and beside it nothing that was not asked for.
    let picture = open(&sandbox.path("a.exr")).into_rgba32f();
    let [r, g, b, alpha] = picture.get_pixel(8, 16).0;
    assert!((r - 0.4).abs() < 1e-5 && (g - 0.2).abs() < 1e-5 && (b - 0.08).abs() < 1e-5, "{r} {g} {b}");
    assert_eq!((alpha, picture.get_pixel(28, 16).0), (1.0, [0.0; 4]));
    let edges = picture.pixels().map(|pixel| pixel.0).filter(|p| p[3] > 0.0 && p[3] < 1.0);
    assert!(edges.clone().count() > 0 && edges.clone().all(|[r, .., a]| (r - 0.4 * a).abs() < 1e-5));
    // Files that cannot hold it say so.
    let hdr = ["render", "scene.ron", "-s", "1", "--set", "output.alpha=true", "-o", "a.hdr"];
    sandbox.run(&hdr).ends(0).says(&["HDR files hold no alpha"]);
}

#[test]
fn paper_stays_white() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE);
    let paper = ["render", "scene.ron", "-q", "-s", "16", "--set", "output.backdrop=1", "--set", "effects.exposure=-3"];
    sandbox.run(&[&paper[..], &["--set", "effects.tone_map=AgX", "-o", "a.png"]].concat()).ends(0).silent();
    let picture = open(&sandbox.path("a.png"));
    assert_eq!(picture.color(), ColorType::Rgb8);
    let picture = picture.into_rgb8();
    assert_eq!(picture.get_pixel(28, 16).0, [255; 3]);
    assert!(picture.get_pixel(8, 16).0[0] < 120);
    // It is either of the two.
    let both = ["check", "scene.ron", "--set", "output.alpha=true", "--set", "output.backdrop=1"];
    sandbox.run(&both).ends(2).says(&["the output has both `alpha: true` and `backdrop`"]);
}

/// A checkpoint, parts and a denoised picture know of it, too.
#[test]
fn however_it_is_rendered() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE);
    let render = |more: &[&str]| {
        let alpha = ["render", "scene.ron", "-q", "--set", "output.alpha=true"];
        sandbox.run(&[&alpha[..], more].concat()).ends(0)
    };
    render(&["-s", "8", "-o", "a.png"]);
    render(&["-s", "3", "-o", "b.png", "--checkpoint", "b.film"]);
    render(&["-s", "8", "-o", "b.png", "--resume", "b.film"]);
    assert_eq!(sandbox.read("a.png"), sandbox.read("b.png"));
    render(&["-s", "8", "--part", "1/2", "-o", "one.tracer"]);
    render(&["-s", "8", "--part", "2/2", "-o", "two.tracer"]);
    sandbox.run(&["merge", "one.tracer", "two.tracer", "-o", "c.png", "-o", "c.exr", "-q"]).ends(0);
    assert_eq!(sandbox.read("a.png"), sandbox.read("c.png"));
    // The same channels, too: not one that nobody has asked for.
    render(&["-s", "8", "-o", "a.exr"]);
    let layers = |name: &str| {
        let bytes = sandbox.read(name);
        // A name ends with a zero.
        let held = |channel: &str| {
            let name = [channel.as_bytes(), &[0]].concat();
            bytes.windows(name.len()).any(|at| at == name)
        };
        [held("A"), held("alpha.A")]
    };
    assert_eq!((layers("a.exr"), layers("c.exr")), ([true, false], [true, false]));
    sandbox.run(&["merge", "one.tracer", "two.tracer", "-o", "c.hdr"]).ends(0).says(&["HDR files hold no alpha"]);
    render(&["-s", "8", "-o", "d.png", "--denoise"]);
    let [noisy, denoised] = ["a.png", "d.png"].map(|name| open(&sandbox.path(name)).into_rgba8());
    assert!(noisy.pixels().zip(denoised.pixels()).all(|(a, b)| a.0[3] == b.0[3]));
    assert_eq!(denoised.get_pixel(28, 16).0, [0; 4]);
}

/// Black things that cover more or less are other pictures, in either kind of file; one picture is the same in both.
#[test]
fn what_is_covered_is_compared() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE.replace("(0.8, 0.1, 0.01)", "0"));
    for (name, size) in [("a", "4"), ("b", "3")] {
        let (size, png, exr) = (format!("objects[0].size={size}"), format!("{name}.png"), format!("{name}.exr"));
        let render = ["render", "scene.ron", "-q", "-s", "16", "--set", "output.alpha=true", "--set", &size];
        sandbox.run(&[&render[..], &["-o", &png, "-o", &exr]].concat()).ends(0);
    }
    for kind in ["png", "exr"] {
        let [a, b] = ["a", "b"].map(|name| format!("{name}.{kind}"));
        sandbox.run(&["compare", &a, &b, "--fail-above", "max=0.1"]).ends(1);
    }
    // Eight bits of a colour.
    sandbox.run(&["compare", "a.png", "a.exr", "--fail-above", "max=0.006"]).ends(0);
}
