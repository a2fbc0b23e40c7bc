//! `tracer check`: everything that is wrong with a scene, meshes and textures included.

use crate::args::{CheckArgs, DiagnosticsForm};
use crate::failure::{Failure, exit};
use crate::loading::{compile, load};
use crate::shell::{Shell, counted};
use std::io::Write;
use std::process::ExitCode;

pub(super) fn run(args: &CheckArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let form = args.scene.diagnostics;
    let desc = load(&args.scene, shell)?;
    let scene = compile(&desc, form, shell)?;
    if form == DiagnosticsForm::Text {
        let name = desc.sources.first().map_or("", |source| source.name.as_str());
        let (objects, lights) = (counted(desc.objects.len(), "object"), counted(scene.lights.len(), "light"));
        writeln!(std::io::stdout().lock(), "{name}: ok, {objects}, {lights}")?;
    }
    Ok(ExitCode::from(exit::DONE))
}
