//! Golden pictures: every `golden/<family>/<case>.ron` is rendered and compared with the `.png` beside it, byte for byte.
//!
//! A missing picture fails, and so does a picture without a scene. A failure writes what was made, what was expected, the difference and a page
//! that shows them (`target/goldens/<family>/<case>/index.html`), and prints the command that accepts the new picture.

use libtest_mimic::{Arguments, Failed, Trial};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use tracer_core::{RenderOptions, Unobserved};

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let golden = root.join("golden");
    let mut arguments = Arguments::from_args();
    // One picture at a time: each is rendered on all cores.
    arguments.test_threads = Some(1);
    let mut trials = Vec::new();
    for family in sorted(&golden).into_iter().filter(|p| p.is_dir() && !p.ends_with("assets")) {
        for file in sorted(&family) {
            let name = case_name(&golden, &file);
            match file.extension().and_then(|e| e.to_str()) {
                Some("ron" | "toml") => {
                    let output = root.join("target/goldens").join(&name);
                    let title = name.clone();
                    trials.push(Trial::test(name, move || compare(&title, &file, &output)));
                }
                Some("png") if file.with_extension("ron").exists() || file.with_extension("toml").exists() => {}
                _ => trials.push(Trial::test(name, move || {
                    Err(Failed::from(format!("{} belongs to no scene: remove it", file.display())))
                })),
            }
        }
    }
    assert!(!trials.is_empty(), "no golden scenes under {}", golden.display());
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

    fn write(&self, path: &Path) -> Result<(), Failed> {
        image::save_buffer(path, &self.rgb, self.width, self.height, image::ColorType::Rgb8)
            .map_err(|e| format!("cannot write {}: {e}", path.display()).into())
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
    let rgb = image.display.iter().map(|x| (x * 255.0 + 0.5) as u8).collect();
    Ok(Picture { width: image.width, height: image.height, rgb })
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
            let (difference, count, largest) = difference(&actual, e);
            difference.write(&output.join("difference.png"))?;
            format!("{count} pixels differ, by up to {largest} of 255")
        }
    };
    let page = output.join("index.html");
    std::fs::write(&page, html(name, &what, scene, expected.is_some()))
        .map_err(|e| format!("cannot write {}: {e}", page.display()))?;
    Err(format!(
        "{what}\n  look at {}\n  accept it with: cargo xtask golden accept {name} --reason \"why it changed\"",
        page.display()
    )
    .into())
}

/// The difference times eight, the number of pixels that differ, and the largest difference of a channel.
fn difference(actual: &Picture, expected: &Picture) -> (Picture, usize, u8) {
    let rgb: Vec<u8> = actual.rgb.iter().zip(&expected.rgb).map(|(a, e)| a.abs_diff(*e)).collect();
    let count = rgb.chunks(3).filter(|pixel| pixel.iter().any(|&d| d > 0)).count();
    let largest = rgb.iter().copied().max().unwrap_or(0);
    let shown = rgb.iter().map(|d| d.saturating_mul(8)).collect();
    (Picture { width: actual.width, height: actual.height, rgb: shown }, count, largest)
}

/// One page that opens from disk: side by side, a wipe between both, the difference, the scene.
fn html(name: &str, what: &str, scene: &Path, expected: bool) -> String {
    let text = std::fs::read_to_string(scene).unwrap_or_default();
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
    let mut page = String::new();
    let _ = write!(
        page,
        "<!doctype html><meta charset=utf-8><title>{name}</title><style>body{{font:14px sans-serif;background:#222;color:#ddd}}\
         img{{width:384px;image-rendering:pixelated;background:#000}}figure{{display:inline-block;margin:8px}}\
         #wipe{{position:relative;width:384px;display:inline-block}}#wipe img+img{{position:absolute;left:0;top:0;clip-path:inset(0 0 0 50%)}}\
         </style><h1>{name}</h1><p>{what}</p><figure><img src=actual.png><figcaption>actual</figcaption></figure>"
    );
    if expected {
        page.push_str(
            "<figure><img src=expected.png><figcaption>expected</figcaption></figure>\
             <figure><img src=difference.png><figcaption>difference, times 8</figcaption></figure>\
             <figure><div id=wipe><img src=expected.png><img id=top src=actual.png></div><br>\
             <input type=range style=width:384px oninput=\"document.getElementById('top').style.clipPath='inset(0 0 0 '+this.value+'%)'\">\
             <figcaption>wipe: expected | actual</figcaption></figure>",
        );
    }
    let _ = write!(page, "<pre>{escaped}</pre>");
    page
}
