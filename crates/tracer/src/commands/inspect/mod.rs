//! `tracer inspect`: how one sample of a pixel came about.

mod json;
mod svg;
mod text;

use crate::args::{InspectArgs, InspectForm};
use crate::failure::{Failure, exit};
use crate::loading::{Known, asset_files, compile, is_dash, load};
use crate::shell::Shell;
use crate::write::{OutputKind, is_one_file, probe, save, spare_other};
use scene_format::SceneDesc;
use scene_format::desc::Integrator;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tracer_core::{Inspection, LightOf, RenderOptions, Scene, inspect, object_name, quarter_of};

/// A sample, explained, and what is needed to call things by their names.
struct Explained {
    desc: SceneDesc,
    scene: Scene,
    told: Inspection,
}

pub(super) fn run(args: &InspectArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let level = crate::lanes::from_environment()?;
    let mut desc = load(&args.scene, shell)?;
    if let Some(size) = args.size {
        (desc.image.width, desc.image.height) = (size.width.into(), size.height.into());
    }
    if let Some(seed) = args.seed {
        desc.render.seed = seed.into();
    }
    let [x, y] = args.pixel;
    let [width, height] = [desc.image.width.value, desc.image.height.value];
    if x >= width || y >= height {
        return Err(Failure::wrong(format!(
            "--pixel {x},{y} does not lie in the picture, which has {width}x{height} pixels: 0,0 to {},{}",
            width - 1,
            height - 1
        )));
    }
    if matches!(desc.render.integrator, Integrator::AmbientOcclusion { .. }) {
        return Err(Failure::wrong(
            "ambient occlusion follows no paths; --set render.integrator=Path shows those of the scene's light",
        ));
    }
    let named: Vec<PathBuf> = asset_files(&desc).into_iter().map(|file| desc.base_dir.join(file)).collect();
    spare_inputs(args, &named)?;
    if let Some(svg) = &args.svg {
        probe(svg)?;
        spare_other(svg, OutputKind::Drawing)?;
    }
    let scene = compile(&desc, args.scene.diagnostics, Known::Nothing, shell)?;
    spare_inputs(args, &scene.files)?;
    let options = RenderOptions { level: Some(level), ..RenderOptions::default() };
    let seed = options.seed.unwrap_or(scene.seed);
    if let Some(Err(faults)) = scene.at_sample(args.sample, quarter_of(&scene, args.pixel, args.sample, seed), seed) {
        shell.diagnostics(&faults, &desc.sources, args.scene.diagnostics);
        return Err(Failure::WrongScene);
    }
    let told = inspect(&scene, &options, args.pixel, args.sample)
        .ok_or_else(|| Failure::could_not("the picture has no such pixel"))?;
    let explained = Explained { desc, scene, told };
    let printed = match args.format {
        InspectForm::Text => text::text(&explained),
        InspectForm::Json => format!("{:#}\n", json::json(&explained)),
    };
    if let Some(svg) = &args.svg {
        save(svg, svg::svg(&explained).as_bytes())?;
    }
    let mut out = std::io::stdout().lock();
    out.write_all(printed.as_bytes())?;
    out.flush()?;
    if !explained.agrees() {
        shell.error(&anyhow::anyhow!("what is told is not what the picture has: this is a fault of the program"));
        return Ok(ExitCode::from(exit::FAILED));
    }
    Ok(ExitCode::from(exit::DONE))
}

/// Sees that the drawing replaces nothing that the scene is made of.
fn spare_inputs(args: &InspectArgs, files: &[PathBuf]) -> Result<(), Failure> {
    let Some(svg) = &args.svg else { return Ok(()) };
    if is_dash(svg) {
        return Err(Failure::wrong("--svg is a file: standard output has the text"));
    }
    if svg.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("svg")) {
        return Err(Failure::wrong(format!("--svg {} is to end in .svg", svg.display())));
    }
    let scene = &args.scene.scene;
    let is_input = |file: &Path| is_one_file(svg, file);
    if (!is_dash(scene) && is_input(scene)) || files.iter().any(|file| is_input(file)) {
        let shown = svg.display();
        return Err(Failure::wrong(format!("--svg {shown} would replace a file of the scene; name another file")));
    }
    Ok(())
}

impl Explained {
    /// Whether all sums are those of the picture.
    fn agrees(&self) -> bool {
        self.told.path.agrees && self.told.whole.as_ref().is_none_or(|whole| whole.agrees)
    }

    /// `objects[3] Sphere`, or its name.
    fn object(&self, number: u32) -> String {
        object_name(&self.desc, number as usize)
    }

    fn light(&self, light: LightOf) -> String {
        match light {
            LightOf::Object(number) => self.object(number),
            LightOf::Environment => "the background".to_owned(),
        }
    }

    /// The name of a material; those that are written into objects have none.
    fn material(&self, number: u32) -> Option<String> {
        self.desc.materials.get(number as usize).map(|named| named.name.value.to_string())
    }

    /// What is brought, in the order in which it is summed: the number of the vertex, by what, and how much.
    fn contributions(&self) -> Vec<(usize, &'static str, [f64; 3])> {
        let vertices = &self.told.path.vertices;
        let mut all = Vec::new();
        let deepest = vertices.iter().map(|vertex| vertex.depth).max().unwrap_or(0);
        for depth in 0..=deepest {
            let there = || vertices.iter().enumerate().filter(move |(_, vertex)| vertex.depth == depth);
            let met = there().filter_map(|(k, vertex)| Some((k + 1, "light met", vertex.met.as_ref()?.brings)));
            all.extend(met);
            let sampled = there().filter_map(|(k, vertex)| Some((k + 1, vertex.sampled.as_ref()?)));
            let arrive = sampled.filter(|(_, sampled)| sampled.arrives == Some(true));
            all.extend(arrive.map(|(k, sampled)| (k, "light sampled", sampled.carries)));
        }
        all.retain(|(_, _, brings)| *brings != [0.0; 3]);
        all
    }
}
