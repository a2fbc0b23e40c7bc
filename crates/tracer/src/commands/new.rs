//! `tracer new`: a small scene that renders well, to start from.

use crate::args::NewArgs;
use crate::command_line::quoted;
use crate::failure::{Failure, exit};
use crate::loading::is_dash;
use crate::shell::{Shell, Verbosity};
use crate::write::{save, spare};
use clap::ValueEnum;
use scene_format::Syntax;
use std::io::Write;
use std::process::ExitCode;

/// What to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// A ball on a floor
    Ball,
    /// Every material, side by side
    Materials,
    /// A closed room with a lamp and two balls
    Room,
}

impl Template {
    /// Its text, in RON.
    pub fn text(self) -> &'static str {
        match self {
            Template::Ball => include_str!("../../templates/ball.ron"),
            Template::Materials => include_str!("../../templates/materials.ron"),
            Template::Room => include_str!("../../templates/room.ron"),
        }
    }
}

pub(super) fn run(args: &NewArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let path = &args.scene;
    let shown = path.display();
    if is_dash(path) {
        let mut out = std::io::stdout().lock();
        out.write_all(args.template.text().as_bytes())?;
        out.flush()?;
        return Ok(ExitCode::from(exit::DONE));
    }
    let syntax = Syntax::from_path(path).ok_or_else(|| {
        Failure::wrong(format!("{shown} is no name for a scene file; expected .ron, .toml or .json at its end"))
    })?;
    spare(path, args.force)?;
    let text = match syntax {
        Syntax::Ron => args.template.text().to_owned(),
        Syntax::Toml | Syntax::Json => scene_format::convert("template", args.template.text(), Syntax::Ron, syntax)
            .map_err(|error| Failure::could_not(error.to_string()))?,
    };
    save(path, text.as_bytes())?;
    if shell.verbosity > Verbosity::Quiet {
        let picture = path.with_extension("png");
        let (scene, picture) = (path.to_string_lossy(), picture.to_string_lossy());
        shell.say(&format!("made {shown}; see it by: tracer render {} -o {}", quoted(&scene), quoted(&picture)));
    }
    Ok(ExitCode::from(exit::DONE))
}
