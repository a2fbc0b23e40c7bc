//! `tracer preview`: the picture in the browser while the scene is edited.

use crate::args::PreviewArgs;
use crate::checkpoint::{picture_notes, provenance};
use crate::failure::{Failure, exit};
use crate::loading::expect_scene;
use crate::memory;
use crate::shell::{Shell, Verbosity};
use crate::write::{Bits, Encoding, encode, save};
use scene_format::{Override, SceneDesc};
use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use tracer_core::{Film, Look, develop};
use tracer_preview::{Editor, Host, Kind, Options, Preview, StartError};

pub(super) fn run(args: &PreviewArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    expect_scene(&args.scene)?;
    let editor = match &args.editor {
        Some(command) => Some(Editor::new(command).map_err(|why| Failure::wrong(format!("--editor: {why}")))?),
        None => Editor::from_environment(),
    };
    let options = Options {
        scene: args.scene.clone(),
        syntax: args.syntax.map(Into::into),
        overrides: args.set.iter().cloned().map(Override::from).collect(),
        samples: args.samples,
        size: args.size.map(|size| [size.width, size.height]),
        threads: args.threads.map_or(0, usize::from),
        address: args.address,
        port: args.port,
        editor,
    };
    let preview =
        Preview::start(options, Box::new(Program { set: args.set.clone() })).map_err(|error| match error {
            StartError::Listen { .. } => Failure::wrong(format!("--port, --address: {error}")),
            StartError::System(_) => Failure::could_not(error.to_string()),
        })?;
    let address = preview.address();
    let mut out = std::io::stdout().lock();
    writeln!(out, "{address}")?;
    out.flush()?;
    drop(out);
    if shell.verbosity > Verbosity::Quiet {
        let name = args.scene.display();
        shell.say(&format!("{name} is shown there, and again whenever it is saved; Ctrl-C ends"));
        if !args.address.is_loopback() {
            shell.say("warning: other computers can reach it; whoever has the address sees the picture");
        }
    }
    if args.open {
        open(&address).unwrap_or_else(|why| shell.say(&format!("warning: {why}; open the address yourself")));
    }
    preview.wait();
    Ok(ExitCode::from(exit::FAILED))
}

/// What the preview asks of the program.
struct Program {
    set: Vec<String>,
}

impl Host for Program {
    fn encode(&self, desc: &SceneDesc, film: &Film, look: &Look, kind: Kind) -> Result<Vec<u8>, String> {
        let encoding = match kind {
            Kind::Png => Encoding::Png(Bits::Eight),
            Kind::Exr => Encoding::Exr,
        };
        let image = develop(film, look);
        encode(&image, encoding, &provenance(&picture_notes(desc, &self.set), film, false))
            .map_err(|error| error.to_string())
    }

    fn save(&self, path: &Path, bytes: &[u8]) -> Result<(), String> {
        save(path, bytes).map_err(|error| error.to_string())
    }

    fn free_memory(&self) -> Option<u64> {
        memory::available()
    }
}

/// Opens an address in the person's browser.
fn open(address: &str) -> Result<(), String> {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/C", "start", ""])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(arguments).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().map_err(|error| format!("cannot start {program}: {error}"))?;
    // Somebody has to wait for it, or it stays in the system's table when it has ended.
    let waits = std::thread::Builder::new().name("browser".to_owned()).spawn(move || child.wait());
    waits.map(drop).map_err(|error| format!("cannot wait for {program}: {error}"))
}
