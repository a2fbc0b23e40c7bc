//! What is said on standard error: in which colours, how wide, how much.

use crate::args::{DiagnosticsForm, When};
use scene_format::codes::Code;
use scene_format::diagnostic::{Source, Span};
use scene_format::render::{Sarif, Style, github_lines, json_lines, text};
use scene_format::{Diagnostic, Severity};
use std::collections::HashSet;
use std::io::{IsTerminal, Write};
use std::sync::{Mutex, PoisonError};

/// How much is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// Errors.
    Quiet,
    /// Errors and warnings; progress on a terminal.
    Normal,
    /// What is loaded and how long it takes, too.
    Verbose,
}

/// Standard error.
#[derive(Clone, Copy, Debug)]
pub struct Shell {
    color: bool,
    terminal: bool,
    /// How much is said.
    pub verbosity: Verbosity,
    /// Warnings of which nothing is said.
    allowed: &'static [Code],
    /// Warnings are told however little is said: they are what a command fails for.
    denies: bool,
    /// Of a film: what was warned of already, and the frame at hand where it is not the first.
    told: Option<(&'static Told, Option<u32>)>,
}

/// What is to become one document.
static FOUND: Mutex<Option<Sarif>> = Mutex::new(None);

/// The SARIF document of all that was told in that form; `done`: whether the command came to its end.
pub fn sarif(done: bool) -> String {
    let found = FOUND.lock().unwrap_or_else(PoisonError::into_inner).take();
    found.unwrap_or_default().document(env!("CARGO_PKG_VERSION"), done)
}

/// Warnings that were told, which are told once for all frames.
type Told = Mutex<HashSet<(Code, Span)>>;

impl Shell {
    /// Colours as asked for; automatically they are there on a terminal that can, unless NO_COLOR is set. Of warnings
    /// of the allowed codes nothing is said.
    pub fn new(color: When, verbosity: Verbosity, allowed: Vec<Code>) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let color = match color {
            When::Auto => terminal && !dumb && !set("NO_COLOR"),
            When::Always => true,
            When::Never => false,
        };
        // As long as the process.
        let allowed = Vec::leak(allowed);
        Shell { color, terminal: terminal && !dumb, verbosity, allowed, denies: false, told: None }
    }

    /// The same, but silent about warnings.
    pub fn without_warnings(&self) -> Self {
        Shell { verbosity: Verbosity::Quiet, denies: false, ..*self }
    }

    /// The same for who fails because of warnings, or does not.
    pub fn denying(&self, denies: bool) -> Self {
        Shell { denies, ..*self }
    }

    /// The same for a film: what was warned of is not told again.
    pub fn of_film(&self) -> Self {
        // There is one film in a process: it lives as long.
        Shell { told: Some((Box::leak(Box::default()), None)), ..*self }
    }

    /// The same for one of its frames but the first.
    pub fn at_frame(&self, frame: u32) -> Self {
        Shell { told: self.told.map(|(told, _)| (told, Some(frame))), ..*self }
    }

    /// Whether somebody watches: progress is for them alone.
    pub fn is_watched(&self) -> bool {
        self.terminal && self.verbosity > Verbosity::Quiet
    }

    /// Whether anything but errors is said.
    pub fn is_told(&self) -> bool {
        self.verbosity > Verbosity::Quiet
    }

    /// Columns of the terminal.
    pub fn width(&self) -> usize {
        width()
    }

    /// A line on standard error. That it cannot be said is no reason to fail.
    pub fn say(&self, line: &str) {
        let _ = writeln!(std::io::stderr().lock(), "{line}");
    }

    /// `warning: ` and a line, unless only errors are said.
    pub fn warn(&self, line: &str) {
        if self.is_told() {
            self.say(&format!("warning: {line}"));
        }
    }

    /// Leaves warnings out that an earlier frame had; of the others it is said which frame has them.
    fn leave_out_told(&self, shown: &mut Vec<Diagnostic>) {
        let Some((told, frame)) = self.told else { return };
        let mut known = told.lock().unwrap_or_else(PoisonError::into_inner);
        let is_warning = |fault: &Diagnostic| fault.severity == Severity::Warning;
        shown.retain(|fault| !is_warning(fault) || !known.contains(&(fault.code, fault.span)));
        for fault in shown.iter_mut().filter(|fault| is_warning(fault)) {
            known.insert((fault.code, fault.span));
            let frame = frame.map(|frame| format!("frame {frame}")).filter(|frame| !fault.message.contains(frame));
            fault.message += &frame.map_or(String::new(), |frame| format!(" ({frame})"));
        }
    }

    /// A line for those who asked with `-v`.
    pub fn explain(&self, line: impl FnOnce() -> String) {
        if self.verbosity == Verbosity::Verbose {
            self.say(&line());
        }
    }

    /// `error: ` and why.
    pub fn error(&self, error: &anyhow::Error) {
        let (on, off) = if self.color { ("\x1b[1m\x1b[91m", "\x1b[0m") } else { ("", "") };
        self.say(&format!("{on}error{off}: {error:#}"));
    }

    /// How many warnings these are, but for those of which nothing is said.
    pub fn count(&self, warnings: &[Diagnostic]) -> usize {
        warnings.iter().filter(|warning| !self.allowed.contains(&warning.code)).count()
    }

    /// Prints diagnostics (quiet: errors only) and, for people, how many there are.
    pub fn diagnostics(&self, diagnostics: &[Diagnostic], sources: &[Source], form: DiagnosticsForm) {
        let mut shown = diagnostics.to_vec();
        shown.retain(|diagnostic| !self.allowed.contains(&diagnostic.code));
        if self.verbosity == Verbosity::Quiet && !self.denies {
            shown.retain(|diagnostic| diagnostic.severity == Severity::Error);
        }
        self.leave_out_told(&mut shown);
        if shown.is_empty() {
            return;
        }
        let printed = match form {
            DiagnosticsForm::Text => text(&shown, sources, Style { color: self.color, width: width() }),
            DiagnosticsForm::Json => json_lines(&shown, sources),
            DiagnosticsForm::Github => github_lines(&shown, sources),
            DiagnosticsForm::Sarif => {
                let mut found = FOUND.lock().unwrap_or_else(PoisonError::into_inner);
                return found.get_or_insert_default().add(&shown, sources);
            }
        };
        let _ = std::io::stderr().lock().write_all(printed.as_bytes());
        let errors = shown.iter().filter(|diagnostic| diagnostic.severity == Severity::Error).count();
        if form == DiagnosticsForm::Text && errors > 0 {
            let name = sources.first().map_or("the scene", |source| source.name.as_str());
            let warnings = match shown.len() - errors {
                0 => String::new(),
                n => format!(", {}", counted(n, "warning")),
            };
            let code = shown.iter().find(|d| d.severity == Severity::Error).map_or("", |d| d.code.as_str());
            self.error(&anyhow::anyhow!(
                "{name}: {}{warnings}; `tracer explain {code}` tells more",
                counted(errors, "error")
            ));
        }
    }
}

/// `1 sphere`, `2 spheres`
pub fn counted(n: usize, noun: &str) -> String {
    match (n, noun) {
        (1, _) => format!("{n} {noun}"),
        (_, "mesh") => format!("{n} meshes"),
        (_, "leaf") => format!("{n} leaves"),
        _ => format!("{n} {noun}s"),
    }
}

/// Columns of the terminal; of no terminal, a usual width.
fn width() -> usize {
    terminal_size::terminal_size_of(std::io::stderr()).map_or(Style::default().width, |(width, _)| width.0.into())
}
