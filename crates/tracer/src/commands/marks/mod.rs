//! `tracer marks`: where the points that a scene names are in its picture, for labels.

mod svg;
mod tikz;

use super::info::short;
use crate::args::{MarksArgs, MarksForm};
use crate::failure::{Failure, exit};
use crate::loading::{Known, asset_files, compile, is_dash, load};
use crate::report::MarkReport;
use crate::shell::Shell;
use crate::write::{OutputKind, is_one_file, probe, save, spare_other};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Marks in a picture.
struct Placed {
    /// The scene's file, as it is shown.
    scene: String,
    /// Pixels of the picture.
    size: [u32; 2],
    marks: Vec<MarkReport>,
}

/// What they are written as.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Overlay {
    Tikz,
    Svg,
}

pub(super) fn run(args: &MarksArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let overlay = args.output.as_deref().map(overlay).transpose()?;
    if args.picture.is_some() && overlay != Some(Overlay::Svg) {
        return Err(Failure::wrong("--picture is what the labels of -o FILE.svg are laid over"));
    }
    let mut desc = load(&args.scene, shell)?;
    if let Some(size) = args.size {
        (desc.image.width, desc.image.height) = (size.width.into(), size.height.into());
    }
    if desc.output.marks.is_empty() {
        return Err(Failure::wrong("the scene names no marks: output: Output(marks: { \"A\": (0, 1, 0) })"));
    }
    let named: Vec<PathBuf> = asset_files(&desc).into_iter().map(|file| desc.base_dir.join(file)).collect();
    spare_inputs(args, &named)?;
    if let Some(output) = &args.output {
        probe(output)?;
        spare_other(output, OutputKind::Marks)?;
    }
    let mut scene = compile(&desc, args.scene.diagnostics, Known::Nothing, shell)?;
    spare_inputs(args, &scene.files)?;
    let placed = Placed {
        scene: desc.sources.first().map(|source| source.name.clone()).unwrap_or_default(),
        size: scene.size,
        marks: tracer_core::marks(&mut scene, &desc).into_iter().map(Into::into).collect(),
    };
    if let (Some(output), Some(overlay)) = (&args.output, overlay) {
        let text = match overlay {
            Overlay::Tikz => tikz::tikz(&placed)?,
            Overlay::Svg => svg::svg(&placed, args.picture.as_deref().map(|picture| beside(output, picture))),
        };
        save(output, text.as_bytes())?;
        if args.format == MarksForm::Text {
            return Ok(ExitCode::from(exit::DONE));
        }
    }
    let printed = match args.format {
        MarksForm::Text => text(&placed),
        MarksForm::Json => serde_json::to_string_pretty(&placed.marks).unwrap_or_default() + "\n",
    };
    let mut out = std::io::stdout().lock();
    out.write_all(printed.as_bytes())?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

fn overlay(output: &Path) -> Result<Overlay, Failure> {
    if is_dash(output) {
        return Err(Failure::wrong("-o is a file, .tex or .svg; without it marks are printed"));
    }
    match output.extension().map(|extension| extension.to_string_lossy().to_lowercase()).as_deref() {
        Some("tex") => Ok(Overlay::Tikz),
        Some("svg") => Ok(Overlay::Svg),
        _ => Err(Failure::wrong(format!("{} is to end in .tex (TikZ) or .svg", output.display()))),
    }
}

/// Sees that nothing is replaced that the scene is made of, or the picture.
fn spare_inputs(args: &MarksArgs, files: &[PathBuf]) -> Result<(), Failure> {
    let Some(output) = &args.output else { return Ok(()) };
    let scene = Some(&args.scene.scene).filter(|scene| !is_dash(scene));
    let mut inputs = scene.into_iter().chain(&args.picture).chain(files);
    if inputs.any(|file| is_one_file(output, file)) {
        return Err(Failure::wrong(format!("-o {} would replace a file that is read", output.display())));
    }
    Ok(())
}

/// The way from a file to one beside it: both as they are called from here.
fn beside(file: &Path, other: &Path) -> String {
    let folder = |path: &Path| {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        parent.canonicalize().unwrap_or_else(|_| parent.to_owned())
    };
    let (from, to) = (folder(file), folder(other));
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().skip(common).map(|_| "..".to_owned());
    let down = to.components().skip(common).map(|part| part.as_os_str().to_string_lossy().into_owned());
    let name = other.file_name().map(|name| name.to_string_lossy().into_owned());
    up.chain(down).chain(name).collect::<Vec<_>>().join("/")
}

impl MarkReport {
    /// What a label is called: its name, and whose eye sees it so.
    fn label(&self) -> String {
        self.eye.map_or_else(|| self.name.clone(), |eye| format!("{}-{eye}", self.name))
    }

    /// How it is seen, where it is not.
    fn unseen(&self, [width, height]: [u32; 2]) -> Option<&'static str> {
        match self.pixel {
            _ if self.seen => None,
            None => Some("the camera cannot show it"),
            Some([x, y]) if x < 0.0 || y < 0.0 || x > f64::from(width) || y > f64::from(height) => {
                Some("outside of the picture")
            }
            Some(_) => Some("behind something"),
        }
    }
}

/// A line each.
fn text(placed: &Placed) -> String {
    let [width, height] = placed.size;
    let mut out = format!("{}, {width}x{height} pixels\n", placed.scene);
    let longest = placed.marks.iter().map(|mark| mark.label().chars().count()).max().unwrap_or(0);
    for mark in &placed.marks {
        let _ = write!(out, "  {:longest$}  ", mark.label());
        if let Some([x, y]) = mark.pixel {
            let _ = write!(out, "at {x:.1}, {y:.1}, {} away", short(mark.depth));
        }
        let _ = match (mark.unseen(placed.size), mark.pixel) {
            (Some(why), Some(_)) => writeln!(out, ", {why}"),
            (Some(why), None) => writeln!(out, "{why}"),
            (None, _) => writeln!(out),
        };
    }
    out
}
