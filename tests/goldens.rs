//! Golden pictures: every `golden/<family>/<case>.ron` is rendered and compared with the `.png` beside it, byte for byte.
//!
//! A scene with a layer is rendered for that one. A missing picture fails, and so do a picture without a scene and a combination of material, shape and effect that no scene shows. A failure writes what was made, what was expected, the difference and one page
//! that shows them with a wipe, the FLIP map and the scene (`target/goldens/<family>/<case>/index.html`), and prints the command
//! that accepts the new picture.

#[path = "goldens/coverage.rs"]
mod coverage;
#[path = "goldens/page.rs"]
mod page;

use libtest_mimic::{Arguments, Failed, Trial};
use page::{Page, command, difference};
use std::path::{Path, PathBuf};
use tracer_core::{LayerImage, RenderOptions, Unobserved};

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let golden = root.join("golden");
    let mut arguments = Arguments::from_args();
    // One picture at a time: each is rendered on all cores.
    arguments.test_threads = Some(1);
    let mut trials = vec![Trial::test("page", page::check_page)];
    let mut scenes = Vec::new();
    for family in sorted(&golden).into_iter().filter(|p| p.is_dir() && !p.ends_with("assets")) {
        for file in sorted(&family) {
            let name = case_name(&golden, &file);
            match file.extension().and_then(|e| e.to_str()) {
                Some("ron" | "toml") => {
                    let output = root.join("target/goldens").join(&name);
                    let title = name.clone();
                    scenes.push(file.clone());
                    trials.push(Trial::test(name, move || compare(&title, &file, &output)));
                }
                Some("png") if file.with_extension("ron").exists() || file.with_extension("toml").exists() => {}
                _ => trials.push(Trial::test(name, move || {
                    Err(Failed::from(format!("{} belongs to no scene: remove it", file.display())))
                })),
            }
        }
    }
    assert!(!scenes.is_empty(), "no golden scenes under {}", golden.display());
    trials.push(Trial::test("coverage", move || coverage::check_coverage(&scenes)));
    libtest_mimic::run(&arguments, trials).exit();
}

/// The entries of a folder, by name.
fn sorted(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("cannot read {}: {e}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("a readable folder").path()).collect();
    paths.sort();
    paths
}

/// `family/case`.
fn case_name(golden: &Path, file: &Path) -> String {
    let relative = file.strip_prefix(golden).unwrap_or(file).with_extension("");
    relative.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// An 8-bit RGB picture.
#[derive(PartialEq)]
struct Picture {
    width: u32,
    height: u32,
    rgb: Vec<u8>,
}

impl Picture {
    fn read(path: &Path) -> Result<Self, Failed> {
        let image = image::open(path).map_err(|e| format!("cannot read {}: {e}", path.display()))?.into_rgb8();
        Ok(Picture { width: image.width(), height: image.height(), rgb: image.into_raw() })
    }

    /// As the bytes of a PNG file.
    fn png(&self) -> Result<Vec<u8>, Failed> {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::write_buffer_with_format(
            &mut bytes,
            &self.rgb,
            self.width,
            self.height,
            image::ColorType::Rgb8,
            image::ImageFormat::Png,
        )
        .map_err(|e| format!("cannot encode a picture: {e}"))?;
        Ok(bytes.into_inner())
    }

    fn write(&self, path: &Path) -> Result<(), Failed> {
        std::fs::write(path, self.png()?).map_err(|e| format!("cannot write {}: {e}", path.display()).into())
    }
}

/// Renders a scene with the settings that it says.
fn render(scene: &Path) -> Result<Picture, Failed> {
    let loaded = scene_format::load(scene).map_err(|e| match &e {
        scene_format::LoadError::Invalid { diagnostics, .. } => {
            format!("{e}: {}", diagnostics.iter().map(|d| d.message.as_str()).collect::<Vec<_>>().join("; "))
        }
        scene_format::LoadError::Io { .. } => e.to_string(),
    })?;
    let compiled = tracer_core::compile(&loaded.scene).map_err(|e| e.to_string())?;
    let film = tracer_core::render(&compiled, &RenderOptions::default(), &Unobserved);
    if film.counters.dropped > 0 {
        return Err(format!("{} samples were not finite", film.counters.dropped).into());
    }
    let image = tracer_core::develop(&film, &compiled.look);
    if let Some(layer) = image.layers.first() {
        return Ok(Picture { width: image.width, height: image.height, rgb: shown(layer) });
    }
    // As the program writes files: in single precision a value just below a half is rounded up.
    let rgb = image.display.iter().map(|&x| (f64::from(x) * 255.0 + 0.5) as u8).collect();
    Ok(Picture { width: image.width, height: image.height, rgb })
}

/// A layer as it can be looked at: its least number black and its greatest white, and what is not finite, too.
fn shown(layer: &LayerImage) -> Vec<u8> {
    let finite = || layer.values.iter().copied().filter(|x| x.is_finite()).map(f64::from);
    let (least, most) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let code = |x: f32| if x.is_finite() { ((f64::from(x) - least) / (most - least) * 255.0 + 0.5) as u8 } else { 255 };
    let pixels = layer.values.chunks_exact(layer.channels.len());
    pixels.flat_map(|pixel| [0, 1, 2].map(|c| code(pixel[c % pixel.len()]))).collect()
}

fn compare(name: &str, scene: &Path, output: &Path) -> Result<(), Failed> {
    let actual = render(scene)?;
    let golden = scene.with_extension("png");
    let expected = if golden.exists() { Some(Picture::read(&golden)?) } else { None };
    if expected.as_ref() == Some(&actual) {
        return Ok(());
    }
    std::fs::create_dir_all(output).map_err(|e| format!("cannot make {}: {e}", output.display()))?;
    actual.write(&output.join("actual.png"))?;
    let what = match &expected {
        None => "there is no golden picture".to_owned(),
        Some(e) if (e.width, e.height) != (actual.width, actual.height) => {
            e.write(&output.join("expected.png"))?;
            format!("the size is {}x{}, expected {}x{}", actual.width, actual.height, e.width, e.height)
        }
        Some(e) => {
            e.write(&output.join("expected.png"))?;
            let difference = difference(&actual, e);
            difference.picture.write(&output.join("difference.png"))?;
            format!("{} pixels differ, by up to {} of 255", difference.count, difference.largest)
        }
    };
    let page = output.join("index.html");
    let text = std::fs::read_to_string(scene).map_err(|e| format!("cannot read {}: {e}", scene.display()))?;
    let shown = Page { name, what: &what, scene: &text, actual: &actual, expected: expected.as_ref() };
    std::fs::write(&page, shown.html()?).map_err(|e| format!("cannot write {}: {e}", page.display()))?;
    Err(format!("{what}\n  look at {}\n  accept it with: {}", page.display(), command(name)).into())
}
