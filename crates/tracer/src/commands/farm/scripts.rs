//! The scripts that nodes run, and the words for sbatch that submit them.

use super::record::{Layout, Record, digits};
use super::settings::text;
use crate::args::FarmSlurmArgs;
use crate::command_line::quoted;
use crate::commands::render::repeat;
use crate::failure::Failure;
use crate::write::Bits;
use scene_format::SceneDesc;
use std::time::Duration;

/// The two scripts.
pub struct Scripts {
    pub part: String,
    pub merge: String,
}

/// Their names in the folder.
pub const PART: &str = "part.sh";
pub const MERGE: &str = "merge.sh";

impl Scripts {
    /// Of a farm: all words are quoted, so that names may have spaces and quotes.
    ///
    /// # Errors
    /// A name that is no text; a program that is not found.
    pub fn new(args: &FarmSlurmArgs, desc: &SceneDesc, layout: &Layout, record: &Record) -> Result<Self, Failure> {
        let program = match &args.program {
            // A name without strokes is looked for on the node.
            Some(program) if program.components().count() == 1 => text(program)?,
            Some(program) => text(&super::record::whole(program)?)?,
            None => text(&std::env::current_exe().map_err(|error| {
                Failure::could_not(format!("cannot tell where this program lies: {error}; name it by --program"))
            })?)?,
        };
        let mut render = args.as_render();
        render.output.clear();
        let line = |words: &[String]| words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
        let values = [
            ("@FOLDER@", quoted(&text(&layout.folder)?)),
            ("@DIRECTORY@", quoted(&record.directory)),
            ("@PROGRAM@", quoted(&program)),
            ("@PARTS@", args.parts.to_string()),
            ("@DIGITS@", digits(args.parts).to_string()),
            ("@RETRIES@", args.retries.to_string()),
            ("@PAUSE@", args.pause.as_secs_f64().to_string()),
            ("@EVERY@", time(args.every.unwrap_or(crate::checkpoint::EVERY))),
            ("@RENDER@", line(&[repeat::words(&render, desc), args.cache.words()].concat())),
            ("@MERGE@", line(&merge_words(args, record))),
        ];
        let [part, merge] =
            [include_str!("templates/part.sh"), include_str!("templates/merge.sh")].map(|text| filled(text, &values));
        Ok(Scripts { part, merge })
    }
}

/// A template with its values. What a value holds is not looked at again: a name may look like a place for one.
fn filled(template: &str, values: &[(&str, String)]) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some(at) = rest.find('@') {
        text += &rest[..at];
        rest = &rest[at..];
        match values.iter().find(|(name, _)| rest.starts_with(name)) {
            Some((name, value)) => {
                text += value;
                rest = &rest[name.len()..];
            }
            None => {
                text.push('@');
                rest = &rest[1..];
            }
        }
    }
    text + rest
}

/// What `tracer merge` is told beside the parts.
fn merge_words(args: &FarmSlurmArgs, record: &Record) -> Vec<String> {
    let mut words: Vec<String> =
        record.pictures.iter().flat_map(|picture| ["-o".to_owned(), picture.clone()]).collect();
    if let Some(bits) = args.bits {
        let bits = match bits {
            Bits::Eight => "8",
            Bits::Sixteen => "16",
        };
        words.extend(["--bits".to_owned(), bits.to_owned()]);
    }
    words.extend(args.denoise.words());
    words.extend(args.no_metadata.then(|| "--no-metadata".to_owned()));
    words
}

/// A time as `--every` takes it.
fn time(time: Duration) -> String {
    match time.as_millis() {
        milliseconds if milliseconds % 1000 == 0 => format!("{}s", milliseconds / 1000),
        milliseconds => format!("{milliseconds}ms"),
    }
}

/// The words for sbatch that submit these parts.
///
/// # Errors
/// A name that is no text.
pub fn array(args: &FarmSlurmArgs, layout: &Layout, parts: &[u32]) -> Result<Vec<String>, Failure> {
    // The film of a part is written within the minute before its limit; the shell hands the signal on.
    let words = vec![format!("--array={}", ranges(parts)), "--signal=B:USR1@60".to_owned()];
    submitted(args, layout, words, "part-%a", PART)
}

/// The words for sbatch that submit the merge, after these jobs.
///
/// # Errors
/// A name that is no text.
pub fn merge(args: &FarmSlurmArgs, layout: &Layout, after: &[String]) -> Result<Vec<String>, Failure> {
    // Not `afterok`, of which a single failure leaves a job that never starts: the merge says what is missing.
    let after = after.join(":");
    let words = if after.is_empty() { Vec::new() } else { vec![format!("--dependency=afterany:{after}")] };
    submitted(args, layout, words, "merge", MERGE)
}

fn submitted(
    args: &FarmSlurmArgs,
    layout: &Layout,
    own: Vec<String>,
    log: &str,
    script: &str,
) -> Result<Vec<String>, Failure> {
    let folder = text(&layout.folder)?;
    let name = layout.folder.file_stem().map_or("farm".into(), |stem| stem.to_string_lossy());
    let name: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let mut words = vec!["--parsable".to_owned(), format!("--job-name=tracer-{name}"), "--nodes=1".to_owned()];
    words.extend(["--ntasks=1".to_owned(), "--requeue".to_owned(), "--open-mode=append".to_owned()]);
    // In the names of logs sbatch replaces what follows a percent sign.
    words.push(format!("--output={}/logs/{log}.log", folder.replace('%', "%%")));
    words.push(format!("--chdir={folder}"));
    words.extend(args.threads.map(|threads| format!("--cpus-per-task={threads}")));
    words.extend(args.time_limit.as_ref().map(|limit| format!("--time={limit}")));
    words.extend(args.partition.as_ref().map(|partition| format!("--partition={partition}")));
    words.extend(own);
    // Last, so that they win.
    words.extend(args.sbatch_arg.iter().cloned());
    words.push(format!("{folder}/{script}"));
    Ok(words)
}

/// `1-3,7` of numbers in order.
pub fn ranges(numbers: &[u32]) -> String {
    let mut ranges: Vec<(u32, u32)> = Vec::new();
    for &number in numbers {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => ranges.push((number, number)),
        }
    }
    let told = |(first, last): (u32, u32)| if first == last { first.to_string() } else { format!("{first}-{last}") };
    ranges.into_iter().map(told).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command, FarmArgs, FarmCommand, RenderArgs};
    use clap::{CommandFactory, Parser};

    /// Options of `render` that are none of the farm's, or not handed on as they are, and why.
    const OWN: [(&str, &str); 16] = [
        ("format", "pictures are files"),
        ("noise", "parts end at their samples"),
        ("time", "parts end at their samples"),
        ("plan", "parts end at their samples"),
        ("part", "each part has its own"),
        ("threads", "Slurm gives cores"),
        ("checkpoint", "each part has its own"),
        ("resume", "each part has its own"),
        ("report", "of what one process did"),
        ("stats", "of what one process did"),
        ("open", "nobody looks at a node's screen"),
        ("frames", "each frame has a farm of its own"),
        ("skip-existing", "a farm that is done stays done"),
        ("show", "parts are no pictures"),
        ("quiet", "a part's log is all that tells of it"),
        ("diagnostics", "faults are told before parts are submitted"),
    ];

    /// A value of each of the others; those that stand in the part's script by themselves are marked.
    const HANDED_ON: [(&str, &[&str], bool); 21] = [
        ("output", &["--output", "b.exr"], true),
        ("bits", &["--bits", "16"], true),
        ("samples", &["--samples", "7"], false),
        ("adaptive", &["--adaptive", "always"], true),
        ("size", &["--size", "40x30"], false),
        ("crop", &["--crop", "1,2,3,4"], true),
        ("split", &["--split", "rows"], true),
        ("seed", &["--seed", "5"], false),
        ("exposure", &["--exposure", "1.5"], true),
        ("layers", &["--layers", "depth,albedo"], true),
        ("denoise", &["--denoise=on"], true),
        ("integrator", &["--integrator", "direct"], true),
        ("no-metadata", &["--no-metadata"], true),
        ("every", &["--every", "5s"], false),
        ("set", &["--set", "camera.fov=40"], true),
        ("camera", &["--camera", "a"], true),
        ("frame", &["--frame", "3"], true),
        ("syntax", &["--syntax", "toml"], true),
        ("cache", &["--cache", "kept"], false),
        ("cache-size", &["--cache", "kept", "--cache-size", "5GB"], false),
        ("cache-verify", &["--cache", "kept", "--cache-verify"], false),
    ];

    /// What the farm is told with these words.
    fn farm(words: &[&str]) -> RenderArgs {
        let line = [&["tracer", "farm", "slurm", "s.ron", "-o", "a.png", "--parts", "2"], words].concat();
        match Cli::try_parse_from(line).expect("a command line").command {
            Command::Farm(FarmArgs { command: FarmCommand::Slurm(args) }) => args.as_render(),
            other => panic!("{other:?}"),
        }
    }

    /// An option of `render` is one of the farm's, too, and is told to each part; or it stands above with the reason.
    #[test]
    fn options_of_render_are_handed_on() {
        let cli = Cli::command();
        let render = cli.find_subcommand("render").expect("it is there");
        let all = || render.get_arguments().filter_map(|arg| arg.get_long());
        for name in all() {
            let both = [OWN.iter().any(|own| own.0 == name), HANDED_ON.iter().any(|of| of.0 == name)];
            assert!(
                both == [true, false] || both == [false, true],
                "--{name}: hand it on in as_render, or say why not"
            );
        }
        assert_eq!(all().count(), OWN.len() + HANDED_ON.len());
        for (name, words, stands) in HANDED_ON {
            // Only parts can be split.
            let part = if name == "split" { &["--part", "1/2"][..] } else { &[] };
            let line = [&["tracer", "render", "s.ron", "-o", "a.png"], words, part].concat();
            let Command::Render(rendered) = Cli::try_parse_from(line).expect("a command line").command else {
                panic!()
            };
            let handed = farm(words);
            let expected = format!("{:?}", RenderArgs { part: None, ..*rendered });
            assert_eq!(format!("{handed:?}"), expected, "--{name}");
            if stands {
                let [told, without] = [handed, farm(&[])].map(|args| repeat::words(&args, &SceneDesc::default()));
                assert!(told.len() > without.len(), "--{name} is not told to the parts: {told:?}");
            }
        }
    }

    #[test]
    fn a_cache_is_told_to_each_part() {
        let words = ["--cache", "a b", "--cache-size", "5000000000B", "--cache-verify"];
        assert_eq!(farm(&words).cache.words(), words);
    }

    #[test]
    fn numbers_are_told_in_ranges() {
        for (numbers, told) in [(&[][..], ""), (&[3], "3"), (&[1, 2, 3, 7, 9, 10], "1-3,7,9-10")] {
            assert_eq!(ranges(numbers), told);
        }
    }

    #[test]
    fn values_are_not_templates() {
        let values = [("@A@", "x@B@y@".to_owned()), ("@B@", "b".to_owned())];
        assert_eq!(filled("$@ @A@@B@ @", &values), "$@ x@B@y@b @");
    }

    #[test]
    fn times_are_those_of_the_command_line() {
        assert_eq!((time(Duration::from_secs(60)), time(Duration::from_millis(1500))), ("60s".into(), "1500ms".into()));
    }
}
