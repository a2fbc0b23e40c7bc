//! `tracer preview`: the picture in the browser, or in the terminal, while the scene is edited.

use super::from_picture;
use crate::args::{PreviewArgs, TerminalName};
use crate::cache::Cache;
use crate::checkpoint::{picture_notes, provenance};
use crate::command_line::quoted;
use crate::failure::{Failure, exit};
use crate::loading::expect_scene;
use crate::memory;
use crate::opening::open;
use crate::shell::{Shell, Verbosity};
use crate::write::{Bits, Encoding, encode, save};
use scene_format::{SceneDesc, hash_hex};
use std::io::{Error, ErrorKind, Write};
use std::net::SocketAddr;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use tracer_core::{Film, Look, Mattes, Store, develop};
use tracer_preview::{Editor, Host, Kind, Listen, Options, Preview, StartError};

pub(super) fn run(args: &PreviewArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    expect_scene(&args.scene)?;
    let editor = match &args.editor {
        Some(command) => Some(Editor::new(command).map_err(|why| Failure::wrong(format!("--editor: {why}")))?),
        None => Editor::from_environment(),
    };
    let options = Options {
        scene: args.scene.clone(),
        syntax: args.syntax.map(Into::into),
        overrides: args.overrides(),
        samples: args.samples,
        size: args.size.map(|size| [size.width, size.height]),
        threads: args.threads.map_or(0, usize::from),
        editor,
    };
    let program = Box::new(Program {
        set: args.overrides().into_iter().map(|set| set.argument).collect(),
        cache: Cache::open(&args.cache, None, shell)?,
        // What is drawn in the terminal is all that stands there.
        told: Some(*shell).filter(|shell| args.terminal.is_none() && shell.verbosity > Verbosity::Quiet),
    });
    if let Some(how) = args.terminal {
        return in_terminal(args, options, program, how);
    }
    let listen = Listen { address: args.address, port: args.port };
    let preview = Preview::start(options, listen, program).map_err(|error| match error {
        StartError::Listen { at, source } => Failure::wrong(unheard(at, &source).unwrap_or_else(|| {
            let error = StartError::Listen { at, source };
            format!("--port, --address: {error}")
        })),
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
        let told = |why| shell.say(&format!("warning: cannot open the page: {why}; open the address yourself"));
        open(&address).unwrap_or_else(told);
    }
    preview.wait();
    Ok(ExitCode::from(exit::FAILED))
}

/// Why it cannot be listened at an address, where whoever named that can mend it.
fn unheard(at: SocketAddr, error: &Error) -> Option<String> {
    let (address, port) = (at.ip(), at.port());
    match error.kind() {
        ErrorKind::AddrNotAvailable => Some(format!(
            "--address {address}: this machine has no such address; 0.0.0.0 is all that it has, 127.0.0.1 itself alone"
        )),
        ErrorKind::PermissionDenied => {
            Some(format!("--port {port}: the system does not give it to everybody; name one from 1024, or none"))
        }
        _ => None,
    }
}

/// Draws in the terminal until a key or a signal ends it.
#[cfg(unix)]
fn in_terminal(
    args: &PreviewArgs,
    options: Options,
    program: Box<Program>,
    how: TerminalName,
) -> Result<ExitCode, Failure> {
    use std::io::IsTerminal;
    use tracer_preview::terminal::{self, End, Protocol};
    let elsewhere = elsewhere(args);
    if !std::io::stdout().is_terminal() {
        return Err(Failure::wrong(format!("--terminal: standard output is no terminal; {elsewhere}")));
    }
    if std::env::var_os("TERM").is_some_and(|term| term == "dumb") {
        return Err(Failure::wrong(format!(
            "--terminal: this terminal cannot place a picture (TERM=dumb); {elsewhere}"
        )));
    }
    let wanted = match how {
        TerminalName::Auto => None,
        TerminalName::Kitty => Some(Protocol::Kitty),
        TerminalName::Iterm => Some(Protocol::Iterm),
        TerminalName::Sixel => Some(Protocol::Sixel),
        TerminalName::Blocks => Some(Protocol::Blocks),
    };
    let end = terminal::run(options, program, wanted)
        .map_err(|error| Failure::could_not(format!("cannot draw in the terminal: {error}; {elsewhere}")))?;
    Ok(ExitCode::from(match end {
        End::Quit => exit::DONE,
        End::Interrupted => exit::INTERRUPTED,
        End::Gone => exit::HUNG_UP,
        // As shells count.
        End::Signal(signal) => u8::try_from(128 + signal).unwrap_or(exit::FAILED),
    }))
}

/// There is none yet that it was tried in.
#[cfg(not(unix))]
fn in_terminal(args: &PreviewArgs, _: Options, _: Box<Program>, _: TerminalName) -> Result<ExitCode, Failure> {
    Err(Failure::could_not(format!("--terminal: on this system it does not draw in terminals; {}", elsewhere(args))))
}

/// What shows the picture where a terminal cannot.
fn elsewhere(args: &PreviewArgs) -> String {
    let scene = quoted(&args.scene.display().to_string());
    format!("`tracer preview {scene}` shows it in the browser, `tracer render {scene}` writes it")
}

/// What the preview asks of the program.
struct Program {
    set: Vec<String>,
    cache: Option<Cache>,
    /// Where a wrong scene is told of beside the page.
    told: Option<Shell>,
}

impl Program {
    /// Whether a scene is what its text and the options say.
    fn is_as_written(&self, desc: &SceneDesc) -> bool {
        let Some(source) = desc.sources.first() else { return false };
        let written = from_picture::load(&source.name, &source.text, &desc.base_dir, &self.set);
        let place = |desc: &SceneDesc| hash_hex(&SceneDesc { camera: desc.camera.clone(), ..SceneDesc::default() });
        written.is_ok_and(|written| place(&written) == place(desc))
    }
}

impl Host for Program {
    fn wrong(&self, faults: Option<&str>) {
        if let Some(shell) = &self.told {
            shell.say(faults.unwrap_or("the scene is right again"));
        }
    }

    fn encode(&self, desc: &SceneDesc, film: &Film, look: &Look, kind: Kind) -> Result<Vec<u8>, String> {
        let encoding = match kind {
            Kind::Png => Encoding::Png(Bits::Eight),
            Kind::Exr => Encoding::Exr,
        };
        let image = develop(film, look);
        let mut told = provenance(&picture_notes(desc, &Mattes::default(), &self.set), film, None);
        if !self.is_as_written(desc) {
            // The camera was moved by whoever looks: no text says where it is.
            told.record.clear();
        }
        encode(&image, encoding, &told).map_err(|error| error.to_string())
    }

    fn save(&self, path: &Path, bytes: &[u8]) -> Result<(), String> {
        save(path, bytes).map_err(|error| error.to_string())
    }

    fn free_memory(&self) -> Option<u64> {
        memory::available()
    }

    fn store(&self) -> Option<Arc<dyn Store>> {
        self.cache.as_ref().map(Cache::store)
    }
}
