//! The command line as it is read: help that fits a terminal of 80 columns and 24 lines, and tips for what was probably
//! meant.

use crate::args::Cli;
use crate::command_line::quoted;
use crate::loading::nearby;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory};
use scene_format::Syntax;
use std::ffi::OsString;
use std::path::Path;
use tracer_core::mesh::MeshFormat;

/// The parts of a command's help, without headings.
const TEMPLATE: &str = "{about}\n{usage-heading} {usage}\n{positionals}\n{options}{after-help}";

/// The same of a command that has commands itself.
const TEMPLATE_OF_COMMANDS: &str = "{about}\n{usage-heading} {usage}\n{subcommands}\n{options}{after-help}";

/// The commands that a screen of help names in its line "More" alone.
const MORE: [&str; 10] = [
    "inspect",
    "marks",
    "convert",
    "repro",
    "bench-acceleration",
    "bench-figures",
    "lsp",
    "schema",
    "completions",
    "man",
];

/// The parts of a command's whole help, under headings.
const WHOLE: &str = "{about}\n\n{usage-heading} {usage}\n\n{all-args}{after-help}";

/// Headings of the whole help of `tracer render` and commands with the same options, and what stands under each.
const HEADINGS: [(&str, &[&str]); 7] = [
    ("Picture", &["output", "size", "crop", "exposure", "layers", "show", "format", "bits", "no_metadata", "open"]),
    ("Quality", &["samples", "noise", "adaptive", "time", "plan", "seed", "integrator", "threads"]),
    ("Denoising", &["denoise"]),
    ("Animation", &["frames", "skip_existing"]),
    ("Parts and checkpoints", &["part", "split", "checkpoint", "every", "resume"]),
    ("What is kept and told", &["cache", "cache_size", "cache_verify", "report", "stats", "quiet"]),
    ("Scene", &["set", "camera", "frame", "syntax", "diagnostics"]),
];

/// What holds where an option is not written, of those whose short help has no room for it.
const DEFAULTS: [(&str, &str); 15] = [
    ("size", "the scene's `image`"),
    ("crop", "all of it"),
    ("exposure", "the scene's, 0"),
    ("layers", "the scene's alone"),
    ("format", "by the name of -o; png with none"),
    ("bits", "8"),
    ("samples", "the scene's"),
    ("noise", "none"),
    ("adaptive", "the scene's, with_noise"),
    ("time", "no limit"),
    ("seed", "the scene's"),
    ("integrator", "the scene's"),
    ("camera", "the scene's `camera`"),
    ("frame", "the scene's, 0"),
    ("diagnostics", "text"),
];

/// The words of the command line with all that help has to say: what `--help` shows, where `-h` shows a screen.
pub fn whole() -> Command {
    Cli::command().after_help(without_more(&Cli::command())).mut_subcommands(|command| {
        let inner: Vec<String> = command.get_subcommands().map(|inner| inner.get_name().to_owned()).collect();
        inner.into_iter().fold(whole_of(command), |command, name| command.mut_subcommand(name, whole_of))
    })
}

fn whole_of(command: Command) -> Command {
    let ids: Vec<String> = command.get_arguments().map(|arg| arg.get_id().to_string()).collect();
    // Where there are few options, they need no headings.
    let many = ids.len() > 15;
    let after = without_more(&command);
    let command = command.help_template(WHOLE).after_help(after);
    ids.into_iter().fold(command, |command, id| {
        command.mut_arg(&id, |arg| {
            let heading = HEADINGS.iter().find(|(_, ids)| ids.contains(&&*id)).map(|(heading, _)| *heading);
            let heading = heading.filter(|_| many && !arg.is_positional());
            let arg = if heading.is_some() { arg.help_heading(heading) } else { arg };
            let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
            match DEFAULTS.iter().find(|(of, _)| *of == id) {
                Some((_, default)) if many && !help.contains("[default") => {
                    arg.help(format!("{help} [default: {default}]")).hide_default_value(true)
                }
                _ => arg,
            }
        })
    })
}

/// What stands behind a command's help, without the lines that say where the rest is.
fn without_more(command: &Command) -> String {
    let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let lines =
        after.lines().filter(|line| !line.starts_with("More: ")).map(|line| match line.split_once("`tracer ") {
            Some((before, rest)) if rest.contains(" --help` has ") => before.trim_end(),
            _ => line,
        });
    lines.collect::<Vec<_>>().join("\n").trim_end().to_owned()
}

/// The words of the command line. (Manual pages and completions are made from [`Cli`] itself.)
pub fn command() -> Command {
    MORE.into_iter()
        .fold(Cli::command(), |cli, name| cli.mut_subcommand(name, |command| command.hide(true)))
        .mut_arg("allow", |arg| arg.hide(true))
        .mut_subcommands(|command| command.help_template(TEMPLATE))
        .mut_subcommand("golden", |golden| {
            golden.help_template(TEMPLATE_OF_COMMANDS).mut_subcommands(|command| command.help_template(TEMPLATE))
        })
        .mut_subcommand("farm", |farm| {
            farm.help_template(TEMPLATE_OF_COMMANDS)
                .mut_subcommands(|command| command.help_template(TEMPLATE))
                .mut_subcommand("slurm", |command| {
                    [
                        "camera",
                        "frame",
                        "syntax",
                        "diagnostics",
                        "seed",
                        "exposure",
                        "bits",
                        "split",
                        "crop",
                        "layers",
                        "denoise",
                        "integrator",
                        "adaptive",
                        "no_metadata",
                        "cache",
                        "cache_size",
                        "cache_verify",
                    ]
                    .into_iter()
                    .chain(["pause", "program", "retries"])
                    .fold(command, |command, name| command.mut_arg(name, |arg| arg.hide(true)))
                })
        })
        .mut_subcommand("preview", |command| {
            ["cache", "cache_size", "cache_verify"]
                .into_iter()
                .fold(command, |command, name| command.mut_arg(name, |arg| arg.hide(true)))
        })
        // A screen has no room for all: its last line says where these are.
        .mut_subcommand("render", |command| {
            [
                "adaptive",
                "plan",
                "syntax",
                "diagnostics",
                "seed",
                "exposure",
                "every",
                "format",
                "bits",
                "stats",
                "part",
                "split",
                "crop",
                "layers",
                "open",
                "checkpoint",
                "skip_existing",
                "report",
                "cache",
                "cache_size",
                "cache_verify",
                "integrator",
                "show",
                "no_metadata",
            ]
            .into_iter()
            .fold(command, |command, name| command.mut_arg(name, |arg| arg.hide(true)))
        })
}

/// `tracer help`, `tracer help render` and `tracer scene.ron`, as the commands that they mean; so what is wrong with a
/// scene's name is told as `tracer render` tells it.
pub fn meant(mut arguments: Vec<OsString>) -> Vec<OsString> {
    // Options of all commands may stand before the command.
    let before = leading(&arguments).min(arguments.len());
    let options: Vec<OsString> = arguments.drain(before.min(1)..before).collect();
    let mut arguments = command_of(arguments);
    let place = arguments.len().min(2);
    arguments.splice(place..place, options);
    arguments
}

/// The place of the first word that is no option of all commands, and no value of one.
fn leading(arguments: &[OsString]) -> usize {
    let mut place = 1;
    while let Some(word) = arguments.get(place).and_then(|word| word.to_str()) {
        place += match word {
            "-v" | "--verbose" => 1,
            "--color" | "--allow" => 2,
            _ if word.starts_with("--color=") || word.starts_with("--allow=") => 1,
            _ => break,
        };
    }
    if place < arguments.len() { place } else { 1 }
}

/// The words without options before the command, which is written out.
fn command_of(mut arguments: Vec<OsString>) -> Vec<OsString> {
    let word = |k: usize| arguments.get(k).and_then(|word| word.to_str());
    match word(1) {
        Some("help") => match word(2).is_some_and(|command| !command.starts_with('-')) {
            true => {
                arguments.remove(1);
                arguments.truncate(2);
                arguments.push("--help".into());
            }
            false => {
                arguments.truncate(1);
                arguments.push("--help".into());
            }
        },
        Some(scene) if scene == "-" || is_path(scene) && of_file(scene).is_none() => {
            arguments.insert(1, "render".into());
        }
        _ => {}
    }
    arguments
}

/// What other programs call an option of ours.
fn option_elsewhere(option: &str) -> Option<&'static str> {
    let name = option.split('=').next().unwrap_or(option).to_ascii_lowercase();
    Some(match name.as_str() {
        "--spp" | "--samples-per-pixel" | "--nsamples" | "--pixelsamples" | "-spp" => "--samples 64",
        "--width" | "--height" | "--resolution" | "--res" => "--size 640x480",
        "--out" | "--outfile" | "--outputfile" | "--output-file" | "--image" => "-o picture.png",
        "--nthreads" | "--jobs" | "--cores" | "--cpus" => "--threads 4",
        "--preview" | "--quick" | "--draft" | "--fast" => "--samples 4 --size 160x120",
        "--fov" | "--define" | "-d" => "--set camera.fov=40, for any field of the scene",
        "--depth" | "--max-depth" | "--max_depth" | "--bounces" | "--max-bounces" => "--set render.max_bounces=8",
        "--transparent" | "--alpha" | "--rgba" => "--set output.alpha=true",
        "-w" | "--werror" | "--strict" | "--fail-on-warnings" | "--warnings-as-errors" => "--deny-warnings",
        "--dpi" => "--size 1800x1200, which are 6 by 4 inches at 300 dots per inch",
        "--verbose-level" | "--log-level" | "--debug" => "--verbose",
        "--pixel-debug" | "--debug-pixel" | "--pixelmaterial" => "`tracer inspect SCENE --pixel 12,34`",
        "--view" | "--cam" => "--camera NAME",
        "--all-cameras" | "--cameras" | "--all-views" => "--camera NAME, in one run for each of them",
        "--animation" | "--anim" | "--frame-range" | "--frame-start" | "--frame-end" => {
            "--frames 0-47 -o shot_####.png"
        }
        "--region" | "--cropwindow" | "--window" | "--tile" => "--crop 100,50,64,64",
        "--watch" | "--live" | "--serve" => "`tracer preview SCENE`, which renders it again at every save",
        "--continue" | "--restart" => "--resume FILE",
        _ => return None,
    })
}

/// `-w 100 -h 80`, the sides of a picture by options of their own: ours for both.
fn size_of(option: &str, words: &[String]) -> Option<String> {
    const WIDTH: [&str; 3] = ["-w", "-W", "--width"];
    const HEIGHT: [&str; 3] = ["-h", "-H", "--height"];
    let side = |names: [&str; 3]| {
        let mut pairs = words.iter().zip(words.iter().skip(1));
        pairs.find_map(|(name, value)| value.parse::<u32>().ok().filter(|_| names.contains(&name.as_str())))
    };
    let is_side = WIDTH.contains(&option) || HEIGHT.contains(&option);
    match (side(WIDTH), side(HEIGHT)) {
        (Some(width), Some(height)) if is_side => Some(format!("--size {width}x{height}")),
        (Some(_), None) | (None, Some(_)) if is_side => Some("--size 640x480".to_owned()),
        _ => None,
    }
}

/// What other programs call a command of ours.
fn command_elsewhere(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_lowercase().as_str() {
        "serve" | "view" | "show" | "live" | "open" | "gui" => "preview",
        "format" | "tidy" | "pretty" => "fmt",
        "init" | "create" | "start" => "new",
        "test" | "snapshot" | "regress" => "golden",
        "validate" | "lint" | "verify" => "check",
        "diff" | "cmp" => "compare",
        "trace" | "draw" | "make" | "run" | "animate" => "render",
        _ => return None,
    })
}

/// Adds to a fault of the command line what was probably meant.
pub fn with_tip(mut error: clap::Error, arguments: &[OsString]) -> clap::Error {
    let words: Vec<String> = arguments.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let tip = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let word = context(&error, ContextKind::InvalidSubcommand);
            let near = word.as_deref().and_then(|word| near_command(word, &words));
            // Within a command there is no place for a scene.
            let scene =
                word.as_deref().filter(|word| near.is_none() && words.first().is_some_and(|first| first == word));
            let scene = scene.and_then(of_scene);
            if scene.is_some() {
                error.remove(ContextKind::SuggestedSubcommand);
            }
            if let Some(near) = near {
                error.insert(ContextKind::SuggestedSubcommand, ContextValue::String(near));
            }
            match word.as_deref() {
                Some("fix" | "mend" | "repair" | "correct") => {
                    error.remove(ContextKind::SuggestedSubcommand);
                    Some("`tracer check --fix scene.ron` mends what is certain".to_owned())
                }
                Some("version") => Some("the version is told by tracer --version".to_owned()),
                word => word.and_then(of_file).or(scene),
            }
        }
        ErrorKind::UnknownArgument => {
            // An option of a command, without the command.
            let before = words.iter().all(|word| Cli::command().find_subcommand(word).is_none());
            let option = context(&error, ContextKind::InvalidArg);
            let size = option.as_deref().and_then(|option| size_of(option, &words));
            let elsewhere = size.as_deref().or_else(|| option.as_deref().and_then(option_elsewhere));
            let elsewhere = elsewhere.map(|ours| here(ours, words.first()));
            let of_option = || option.as_deref().filter(|_| before).and_then(of_option);
            let of_others = || of_other_commands(words.first()?, option.as_deref().filter(|_| !before)?);
            if elsewhere.is_some() {
                // An option that is spelt alike is not what it means.
                error.remove(ContextKind::SuggestedArg);
            }
            let tip = elsewhere.or_else(of_option).or_else(|| one_more(&words, option.as_deref()?)).or_else(of_others);
            if tip.is_none() && error.get(ContextKind::Suggested).is_some() {
                // That it might be a value behind `--` is hardly ever meant.
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(Vec::new()));
            }
            tip
        }
        ErrorKind::MissingRequiredArgument if words.iter().take(2).eq(["golden", "accept"]) => {
            let line = "tracer golden accept golden room --reason \"another lamp\"";
            Some(format!("name the scenes, as in {line}, or give --all-failed in place of names"))
        }
        _ => None,
    };
    if let Some(tip) = tip {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
    }
    error
}

/// What is said of an option of ours that was called otherwise: of a command that has it not, who has.
fn here(ours: &str, command: Option<&String>) -> String {
    let name = ours.split([' ', ',']).next().unwrap_or(ours);
    let cli = Cli::command();
    match command.and_then(|word| cli.find_subcommand(word)).filter(|of| name.starts_with('-') && !takes(of, name)) {
        Some(of) => of_other_commands(of.get_name(), name).unwrap_or_else(|| format!("elsewhere it is {ours}")),
        None => format!("here it is {ours}"),
    }
}

/// The command that a mistyped word is nearest to; within `golden` and `farm`, one of theirs.
fn near_command(word: &str, words: &[String]) -> Option<String> {
    let cli = Cli::command();
    let of = words.first().and_then(|first| cli.find_subcommand(first)).unwrap_or(&cli);
    if let Some(ours) = command_elsewhere(word).filter(|_| words.first().is_some_and(|first| first == word)) {
        return Some(ours.to_owned());
    }
    let names: Vec<&str> = of.get_subcommands().map(Command::get_name).chain(["help"]).collect();
    scene_format::nearest(word, names.iter().copied()).map(str::to_owned)
}

/// That other commands take an option that this one has not.
fn of_other_commands(command: &str, option: &str) -> Option<String> {
    let cli = Cli::command();
    let option = option.split('=').next().unwrap_or(option);
    let takers: Vec<&str> = cli.get_subcommands().filter(|of| takes(of, option)).map(Command::get_name).collect();
    let listed = match takers.as_slice() {
        [] => return None,
        [only] => (*only).to_owned(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    };
    Some(format!(
        "tracer {command} has no {option}, which {listed} {}",
        if takers.len() == 1 { "takes" } else { "take" }
    ))
}

/// Whether a command takes an option.
fn takes(command: &Command, option: &str) -> bool {
    command.get_arguments().any(|arg| {
        let long = arg.get_long().is_some_and(|long| option.strip_prefix("--") == Some(long));
        long || arg.get_short().is_some_and(|short| option == format!("-{short}"))
    })
}

fn context(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.clone()),
        _ => None,
    }
}

fn is_scene(word: &str) -> bool {
    Syntax::from_path(Path::new(word)).is_some()
}

/// Whether a word is a file's name or leads to one, which no command and no option does.
fn is_path(word: &str) -> bool {
    !word.starts_with('-') && (Path::new(word).extension().is_some() || word.contains(std::path::is_separator))
}

/// A folder, or a scene without its extension, stands where the command should.
fn of_scene(word: &str) -> Option<String> {
    let path = Path::new(word);
    if path.is_dir() {
        return Some(format!("{word} is a folder; name a scene file in it"));
    }
    nearby(path, |name| Syntax::from_path(name).is_some()).map(|near| format!("did you mean {near}?"))
}

/// A file stands where the command should.
fn of_file(word: &str) -> Option<String> {
    let extension = Path::new(word).extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some(_) if MeshFormat::of(Path::new(word)).is_some() => {
            Some("a mesh stands in a scene, as Mesh(file: \"..\"); to start a scene: tracer new scene.ron".to_owned())
        }
        Some("png" | "exr" | "hdr" | "pfm") => Some(format!("to compare pictures: tracer compare {} ..", quoted(word))),
        _ => None,
    }
}

/// A word where a command takes no more: what it was probably meant for.
fn one_more(words: &[String], more: &str) -> Option<String> {
    if more.starts_with('-') {
        return None;
    }
    let word = quoted(more);
    let sets = words.iter().any(|word| word == "--set" || word.starts_with("--set="));
    if more == "=" {
        let at = words.iter().position(|word| word == more)?;
        let (field, value) = (words.get(at.checked_sub(1)?)?, words.get(at + 1)?);
        return Some(format!("without spaces: --set {}", quoted(&format!("{field}={value}"))));
    }
    if sets && more.contains('=') {
        return Some(format!("--set stands before each of them: --set {word}"));
    }
    let before = |k: usize| words.iter().position(|word| word == more).and_then(|at| words.get(at.checked_sub(k)?));
    if let (Some(option), Some(field)) = (before(2), before(1)) {
        match option.as_str() {
            "--set" => return Some(format!("without spaces: --set {}", quoted(&format!("{field}={more}")))),
            "--layers" => return Some(format!("without spaces: --layers {}", quoted(&format!("{field},{more}")))),
            _ => {}
        }
    }
    let command: Vec<&str> = words.iter().map(String::as_str).take(2).collect();
    Some(match command.as_slice() {
        ["convert", ..] => format!("the file to write: -o {word}"),
        ["render", ..] if is_scene(more) => {
            "scenes are rendered one after the other, each by a line of its own".to_owned()
        }
        ["render", ..] => format!("the picture to write: -o {word}"),
        ["golden", "new"] => format!("each scene has its option: --scene {word}"),
        [command, ..] if is_scene(more) => format!("{command} takes one scene at a time"),
        _ => return None,
    })
}

/// The commands that take an option.
fn of_option(option: &str) -> Option<String> {
    let cli = Cli::command();
    let names: Vec<String> = cli
        .get_subcommands()
        .filter(|command| takes(command, option))
        .map(|command| format!("tracer {}", command.get_name()))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    match names.as_slice() {
        [] => None,
        [only] => Some(format!("{option} belongs to {only}")),
        [first, ..] => Some(format!("{option} belongs to a command, as in {first}; write the command first")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_help_hides_its_last_lines_name() {
        let help = command().render_help().to_string();
        let more = help.lines().filter_map(|line| line.strip_prefix("More: ")).flat_map(|line| line.split(' '));
        assert!(more.eq(MORE), "{help}");
    }

    #[test]
    fn every_option_of_render_stands_under_a_heading() {
        let whole = whole();
        let render = whole.find_subcommand("render").expect("a command");
        for arg in render.get_arguments().filter(|arg| !arg.is_positional()) {
            let id = arg.get_id().as_str();
            assert!(arg.get_help_heading().is_some(), "--{id} stands under none");
        }
        for (_, ids) in HEADINGS {
            assert!(ids.iter().all(|id| render.get_arguments().any(|arg| arg.get_id() == id)), "{ids:?}");
        }
    }

    #[test]
    fn help_and_scenes_are_commands() {
        let cases = [
            (&["tracer", "help"][..], &["tracer", "--help"][..]),
            (&["tracer", "help", "render"], &["tracer", "render", "--help"]),
            (&["tracer", "help", "render", "-v"], &["tracer", "render", "--help"]),
            (&["tracer", "a.ron", "-o", "b.png"], &["tracer", "render", "a.ron", "-o", "b.png"]),
            (&["tracer", "a.ro"], &["tracer", "render", "a.ro"]),
            (&["tracer", "./folder", "-v"], &["tracer", "render", "./folder", "-v"]),
            (&["tracer", "a.png"], &["tracer", "a.png"]),
            (&["tracer", "-o", "a.png"], &["tracer", "-o", "a.png"]),
            (&["tracer", "check", "help"], &["tracer", "check", "help"]),
            (&["tracer"], &["tracer"]),
        ];
        for (written, expected) in cases {
            let words = |words: &[&str]| words.iter().map(OsString::from).collect::<Vec<_>>();
            assert_eq!(meant(words(written)), words(expected));
        }
    }
}
