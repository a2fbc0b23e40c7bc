//! A scene while its camera's shutter is open: compiled again, as it is at other times.

use super::assets::Sources;
use super::kept::Kept;
use super::{CompileError, Like, compile_like};
use crate::mattes::Mattes;
use crate::scene::{Moments, Scene};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::sync::Arc;
use tracer_kernels::scene::Frame;

/// What a scene is compiled of again at other times, where something moves while its camera's shutter is open.
struct OfTexts {
    /// Whatever of it is the same at all times; without objects.
    desc: SceneDesc,
    sources: Sources<'static>,
    kept: Kept,
    frame: Frame,
    radiance_unit: f64,
    mattes: Mattes,
    /// The names of the light groups, where they are told apart.
    light_groups: Option<Vec<String>>,
}

/// Compiles a scene in which something moves: as it is when the shutter opens, with what it is compiled of again.
///
/// # Errors
/// What is wrong with it then, in the middle, or at the end.
pub(super) fn compile(desc: &SceneDesc, sources: &Sources<'_>) -> Result<Scene, CompileError> {
    let own = Kept::default();
    let kept = sources.kept.unwrap_or(&own);
    let in_memory = sources.in_memory();
    let keeping = in_memory.with(kept, sources.store);
    let mut scene = compile_like(desc, &keeping, Like::default())?;
    let mut moments = OfTexts {
        desc: of_all_times(desc),
        sources: in_memory.clone(),
        kept: kept.frozen(),
        frame: scene.frame,
        radiance_unit: scene.radiance_unit,
        mattes: scene.mattes.clone(),
        light_groups: scene.light_groups.as_ref().map(|groups| groups.names.clone()),
    };
    // The film's unit is that of the brightest light of all times, as far as these tell.
    for share in [0.5, 1.0].map(|part| part * desc.camera.shutter.value) {
        let then = moments.compile(share, None)?;
        moments.radiance_unit = moments.radiance_unit.max(then.radiance_unit);
    }
    if moments.radiance_unit > scene.radiance_unit {
        let like = Like { frame: Some(scene.frame), radiance_unit: Some(moments.radiance_unit) };
        scene = compile_like(desc, &keeping, like)?;
    }
    scene.moments = Some(Arc::new(moments));
    Ok(scene)
}

/// What of a description counts at all times.
fn of_all_times(desc: &SceneDesc) -> SceneDesc {
    SceneDesc {
        moments: desc.moments.clone(),
        animation: desc.animation.clone(),
        camera: desc.camera.clone(),
        image: desc.image.clone(),
        render: desc.render.clone(),
        effects: desc.effects.clone(),
        output: desc.output.clone(),
        base_dir: desc.base_dir.clone(),
        ..SceneDesc::default()
    }
}

impl OfTexts {
    fn compile(&self, share: f64, radiance_unit: Option<f64>) -> Result<Scene, CompileError> {
        let desc = self.desc.at(share).map_err(|diagnostics| CompileError { diagnostics })?;
        let sources = self.sources.with(&self.kept, None);
        let scene = compile_like(&desc, &sources, Like { frame: Some(self.frame), radiance_unit })?;
        self.kept.sweep_trees();
        if (&scene.mattes.objects, &scene.mattes.materials) != (&self.mattes.objects, &self.mattes.materials) {
            let shutter = &self.desc.camera.shutter;
            let message = "objects or materials come and go while the shutter is open, and the picture has mattes";
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, shutter.span, message).at_path("camera.shutter");
            let hint = "leave out `masks` and `cryptomatte`, or let counts, names and `Pick`s go by `frame`";
            return Err(CompileError { diagnostics: vec![fault.hint(hint)] });
        }
        if scene.light_groups.as_ref().map(|groups| &groups.names) != self.light_groups.as_ref() {
            let shutter = &self.desc.camera.shutter;
            let message = "groups of lights come and go while the shutter is open, and the picture tells them apart";
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, shutter.span, message).at_path("camera.shutter");
            let hint = "leave out `light_groups`, or let counts and `Pick`s go by `frame`";
            return Err(CompileError { diagnostics: vec![fault.hint(hint)] });
        }
        Ok(scene)
    }
}

impl Moments for OfTexts {
    fn shutter(&self) -> f64 {
        self.desc.camera.shutter.value
    }

    fn at(&self, part: f64) -> Result<Scene, Diagnostics> {
        let share = part * self.desc.camera.shutter.value;
        self.compile(share, Some(self.radiance_unit)).map_err(|error| error.diagnostics)
    }
}
