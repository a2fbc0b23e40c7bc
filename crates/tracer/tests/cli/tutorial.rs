//! `docs/tutorial.md`, done step by step: every command is run, every edit made, every output and picture compared.
//!
//! A block ```` ```ron FILE ```` shows a whole file as it is, or makes it, ```` ```obj FILE ```` makes one,
//! ```` ```diff FILE ```` edits one, ```` ```sh ```` runs commands, and the ```` ```text ```` after it is what they
//! print (`...` stands for lines left out, and a number in it for any number).
//!
//! `TUTORIAL=write cargo test -p tracer --test cli tutorial` makes the pictures anew; look at them before committing
//! them.

use crate::support::{Ran, Sandbox, is_done, repository};
use std::fs;
use std::path::Path;

/// What is added to every rendering: small pictures, in a test's time.
const SMALL: [&str; 2] = ["--size", "256x160"];

/// Pictures of this page may have so many bytes.
const MOST_BYTES: u64 = 60 * 1024;

struct Step {
    kind: String,
    file: String,
    lines: Vec<String>,
    /// Where it stands in the page.
    line: usize,
}

/// The fenced blocks of a page, and its pictures as blocks of the kind `picture`.
fn steps(page: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut open = false;
    for (number, line) in page.lines().enumerate() {
        if let Some(info) = line.strip_prefix("```") {
            open = !open;
            if open {
                let (kind, file) = info.split_once(' ').unwrap_or((info, ""));
                let (kind, file) = (kind.to_owned(), file.to_owned());
                steps.push(Step { kind, file, lines: Vec::new(), line: number + 1 });
            }
        } else if open {
            steps.last_mut().expect("a block is open").lines.push(line.to_owned());
        } else if let Some((_, picture)) = line.strip_prefix("![").and_then(|rest| rest.split_once("](")) {
            let file = picture.trim_end_matches(')').to_owned();
            steps.push(Step { kind: "picture".to_owned(), file, lines: Vec::new(), line: number + 1 });
        }
    }
    assert!(!open, "a block is never closed");
    steps
}

/// The lines of a `diff` block: before, and after.
fn edit(lines: &[String]) -> (String, String) {
    let side = |sign: char| {
        let of_side = lines.iter().filter_map(|line| {
            let (first, rest) = line.split_at_checked(1).expect("a line of a diff begins with a sign");
            (first == " " || first.starts_with(sign)).then(|| format!("{rest}\n"))
        });
        of_side.collect::<String>()
    };
    (side('-'), side('+'))
}

/// Words of a line, numbers alike.
fn words(line: &str) -> Vec<String> {
    let word = |word: &str| {
        let bare = word.trim_matches(['(', ')', ',']);
        if bare.parse::<f64>().is_ok() { word.replace(bare, "0") } else { word.to_owned() }
    };
    line.split_whitespace().map(word).collect()
}

/// Whether an output is what the page shows.
fn prints(output: &str, shown: &[String]) -> bool {
    let output: Vec<&str> = output.trim_end().lines().collect();
    let mut at = 0;
    let mut skip = false;
    let loose = shown.iter().any(|line| line == "...");
    for line in shown {
        if line == "..." {
            skip = true;
            continue;
        }
        let same = |other: &&&str| if loose { words(other) == words(line) } else { **other == line };
        let Some(found) = output[at..].iter().position(|other| same(&other)) else { return false };
        if found > 0 && !skip {
            return false;
        }
        (at, skip) = (at + found + 1, false);
    }
    skip || at == output.len()
}

/// Display values of a picture, 0 to 1.
fn pixels(path: &Path) -> (u32, u32, Vec<f64>) {
    let picture = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).to_rgb8();
    let (width, height) = picture.dimensions();
    (width, height, picture.into_raw().into_iter().map(|value| f64::from(value) / 255.0).collect())
}

fn mean_square(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / a.len() as f64
}

struct Page {
    sandbox: Sandbox,
    /// What the last commands printed, standard error and output.
    printed: String,
    /// The last rendering, and its picture.
    rendering: Option<(Vec<String>, String)>,
}

impl Page {
    fn run(&mut self, line: &str, more: &[&str]) -> Ran {
        let mut arguments: Vec<&str> = line.split_whitespace().collect();
        assert_eq!(arguments.remove(0), "tracer", "{line}");
        arguments.extend(more);
        self.sandbox.run(&arguments)
    }

    fn commands(&mut self, lines: &[String]) {
        self.printed.clear();
        for line in lines {
            let is_rendering = line.starts_with("tracer render ");
            let ran = self.run(line, if is_rendering { &SMALL } else { &[] });
            // How long it took differs from machine to machine.
            self.printed.extend(ran.err.split_inclusive('\n').filter(|line| !is_done(line)));
            self.printed += &ran.out_text();
            let wrong = ran.err.lines().any(|line| line.starts_with("error"));
            assert_eq!(ran.code, Some(if wrong { 2 } else { 0 }), "{line}\n{}", self.printed);
            if is_rendering {
                let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
                let output = words.iter().position(|word| word == "-o").and_then(|at| words.get(at + 1));
                let output = output.expect("the picture is named").clone();
                self.rendering = Some((words, output));
            }
        }
    }

    /// Compares the last rendering with a picture of the page.
    ///
    /// The same program makes the same bytes. Another one may differ in its noise, and in nothing else: then the
    /// picture and the rendering are two independent estimates of the same values with as many samples, and so are two
    /// renderings with other seeds. The mean square difference of two such is twice the variance of one, in display
    /// values clipped to 0 to 1, whatever the tone curve does to their means. If the noise has stayed as it was, the
    /// two mean squares have the same expectation; each is a mean over 122 880 numbers in [0, 1], so that a ratio of
    /// two stands for a change of the picture or for a program whose variance has fallen to less than a third of what
    /// it was: in both cases the pictures are worth making anew.
    fn picture(&mut self, file: &str) {
        let kept = repository().join("docs").join(file);
        let (words, output) = self.rendering.take().expect("a picture follows its rendering");
        let made = self.sandbox.path(&output);
        if std::env::var("TUTORIAL").is_ok_and(|what| what == "write") {
            fs::copy(&made, &kept).expect("the picture can be written");
        }
        let bytes = fs::metadata(&kept).unwrap_or_else(|error| panic!("{}: {error}", kept.display())).len();
        assert!(bytes <= MOST_BYTES, "{file} has {bytes} bytes");
        let (width, height, shown) = pixels(&kept);
        let (made_width, made_height, made) = pixels(&made);
        assert_eq!((width, height), (made_width, made_height), "{file}");
        if shown == made {
            return;
        }
        let mut noisy = |seed: &str| {
            self.run(&words.join(" "), &[&SMALL[..], &["--seed", seed]].concat()).ends(0);
            pixels(&self.sandbox.path(&output)).2
        };
        let noise = mean_square(&noisy("1"), &noisy("2"));
        let difference = mean_square(&shown, &made);
        assert!(
            difference <= 2.0 * noise,
            "{file} differs by {:.4} (RMSE of display values), and noise by {:.4}: look at it, and make it anew as \
             this test says",
            difference.sqrt(),
            noise.sqrt()
        );
    }
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn the_tutorial_does_what_it_shows() {
    let text = fs::read_to_string(repository().join("docs/tutorial.md")).expect("the tutorial");
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("assets")).expect("a folder");
    fs::copy(repository().join("assets/globe.png"), sandbox.path("assets/globe.png")).expect("the texture");
    let mut page = Page { sandbox, printed: String::new(), rendering: None };
    let mut kinds = std::collections::BTreeMap::<String, usize>::new();
    for Step { kind, file, lines, line } in steps(&text) {
        *kinds.entry(kind.clone()).or_default() += 1;
        let whole = lines.iter().map(|line| format!("{line}\n")).collect::<String>();
        match kind.as_str() {
            "sh" => page.commands(&lines),
            "text" => assert!(prints(&page.printed, &lines), "line {line} of the tutorial; printed:\n{}", page.printed),
            "ron" if page.sandbox.path(&file).exists() => {
                assert_eq!(page.sandbox.text(&file), whole, "line {line} of the tutorial");
            }
            "ron" => page.sandbox.write(&file, whole),
            "obj" => page.sandbox.write(&file, whole),
            "diff" => {
                let (before, after) = edit(&lines);
                let text = page.sandbox.text(&file);
                assert_eq!(text.matches(&before).count(), 1, "line {line} of the tutorial: {before}\nin\n{text}");
                page.sandbox.write(&file, text.replace(&before, &after));
            }
            "picture" => page.picture(&file),
            other => panic!("line {line} of the tutorial: blocks of the kind `{other}` are not run"),
        }
    }
    assert!(kinds["sh"] >= 12 && kinds["diff"] >= 10 && kinds["picture"] >= 8, "{kinds:?}");
}
