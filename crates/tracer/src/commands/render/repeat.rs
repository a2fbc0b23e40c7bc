//! The command that makes the same pictures again.

use crate::args::{RenderArgs, SyntaxName};
use crate::command_line::quoted;
use crate::write::Bits;
use scene_format::SceneDesc;
use tracer_core::{Crop, LayerSet};

/// Says size, samples and seed even where the scene said them: the scene may change them, the command stays right.
pub(super) fn command(args: &RenderArgs, desc: &SceneDesc) -> String {
    let words = std::iter::once("tracer".to_owned()).chain(words(args, desc));
    words.map(|word| quoted(&word)).collect::<Vec<_>>().join(" ")
}

/// The same as words, without the program.
pub(in super::super) fn words(args: &RenderArgs, desc: &SceneDesc) -> Vec<String> {
    let mut words = vec!["render".to_owned(), args.scene.scene.to_string_lossy().into_owned()];
    let mut option = |name: &str, value: String| words.extend([name.to_owned(), value]);
    for path in &args.output {
        option("-o", path.to_string_lossy().into_owned());
    }
    if let Some(format) = &args.format {
        option("--format", format.clone());
    }
    if let Some(bits) = args.bits {
        let bits = match bits {
            Bits::Eight => "8",
            Bits::Sixteen => "16",
        };
        option("--bits", bits.to_owned());
    }
    if let Some(syntax) = args.scene.syntax {
        let name = match syntax {
            SyntaxName::Ron => "ron",
            SyntaxName::Toml => "toml",
            SyntaxName::Json => "json",
        };
        option("--syntax", name.to_owned());
    }
    for set in &args.scene.set {
        option("--set", set.clone());
    }
    if let Some(camera) = &args.scene.camera {
        option("--camera", camera.clone());
    }
    if let Some(frame) = args.scene.frame {
        option("--frame", frame.to_string());
    }
    option("--size", format!("{}x{}", desc.image.width.value, desc.image.height.value));
    match args.plan {
        Some(plan) => option("--plan", plan.to_string()),
        None => option("--samples", desc.render.samples.value.to_string()),
    }
    if let Some(adaptive) = args.adaptive {
        option("--adaptive", adaptive.name().to_owned());
    }
    option("--seed", desc.render.seed.value.to_string());
    if let Some(exposure) = args.exposure {
        option("--exposure", exposure.to_string());
    }
    if !args.layers.is_empty() {
        option("--layers", args.layers.iter().copied().collect::<LayerSet>().names().collect::<Vec<_>>().join(","));
    }
    if let Some(layer) = args.show {
        option("--show", LayerSet::from_iter([layer]).to_string());
    }
    if let Some(integrator) = args.integrator {
        option("--integrator", integrator.name().to_owned());
    }
    let denoise = args.denoise.words();
    if let Some(Crop { x, y, width, height }) = args.crop {
        option("--crop", format!("{x},{y},{width},{height}"));
    }
    if let Some([k, n]) = args.part {
        option("--part", format!("{k}/{n}"));
    }
    if let Some(split) = args.split {
        option("--split", super::parts::split_name(split.into()).to_owned());
    }
    words.extend(denoise);
    words.extend(args.no_metadata.then(|| "--no-metadata".to_owned()));
    words
}
