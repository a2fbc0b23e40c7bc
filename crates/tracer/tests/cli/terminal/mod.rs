//! `tracer preview --terminal` in a terminal of our own: what is seen, what keys do, and how it is left.

mod tty;

use crate::support::Sandbox;
use scene_format::SceneDesc;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use tracer_core::{Film, Look};
use tty::{Answers, Tty, XTERM};

/// A picture of one colour but for a small ball in the middle; as many points as 80 columns and 23 rows have.
const SCENE: &str = "// a backdrop
Scene(
    camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), fov: 40), // the eye
    image: Image(width: 80, height: 46),
    render: Render(samples: 4),
    background: (1, 0, 0),
    objects: [Sphere(center: (0, 0, 0), radius: 0.4)],
)
";

const RED: [u8; 3] = [255, 0, 0];
const GREEN: [u8; 3] = [0, 255, 0];
const BLUE: [u8; 3] = [0, 0, 255];

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("wall.ron", SCENE);
    sandbox
}

/// A command, in a terminal of which the environment says this and nothing else.
fn quiet<'a>(command: &'a mut Command, environment: &[(&str, &str)]) -> &'a mut Command {
    let others = ["TMUX", "STY", "TERM_PROGRAM", "LC_TERMINAL", "COLORTERM", "TERM"];
    others.iter().fold(command, |command, name| command.env_remove(name)).envs(environment.iter().copied())
}

const TRUE_COLOUR: &[(&str, &str)] = &[("TERM", "xterm-256color"), ("COLORTERM", "truecolor")];

fn start(sandbox: &Sandbox, how: &str, size: [u16; 2], answers: Answers) -> Tty {
    let mut command = sandbox.command(&["preview", how, "wall.ron"]);
    Tty::start(quiet(&mut command, TRUE_COLOUR), size, [0, 0], answers)
}

fn coloured(colour: &str) -> String {
    SCENE.replace("(1, 0, 0)", colour)
}

#[test]
fn the_picture_follows_the_file_and_the_terminal_is_left_as_it_was() {
    let sandbox = sandbox();
    let mut tty = start(&sandbox, "--terminal", [80, 24], XTERM);
    let corners = [(0, 0), (79, 0), (0, 45), (79, 45)];
    let shows = |tty: &Tty, colour| corners.iter().all(|&(x, y)| tty.point(x, y) == Some(colour));
    tty.until(|tty| shows(tty, RED) && tty.text().contains("done in"));
    let ball = tty.point(40, 23).expect("a point");
    assert!(ball[1] < 20 && ball[0] > 20 && ball[0] < 250, "a grey ball in red light: {ball:?}");
    let status = tty.text().lines().last().expect("a line").to_owned();
    assert!(status.starts_with("wall.ron  4 samples  ") && status.contains("samples/s  noise "), "{status}");

    sandbox.write("wall.ron", coloured("(0, 0, 1)"));
    tty.until(|tty| shows(tty, BLUE));
    sandbox.write("wall.ron", SCENE.replace("fov: 40", "fov: 400"));
    tty.until(|tty| tty.text().contains("fov") && tty.text().contains("wall.ron:3:"));
    let text = tty.text();
    assert!(text.contains("1 error") && text.contains('^'), "{text}");
    assert!((0..80).any(|x| tty.point(x, 0) == Some(BLUE)), "the last good picture stays:\n{text}");

    sandbox.write("wall.ron", coloured("(0, 1, 0)"));
    tty.until(|tty| shows(tty, GREEN) && !tty.text().contains("error"));
    tty.press("q");
    let (code, bytes) = tty.ends();
    assert_eq!(code, Some(0));
    assert!(!bytes.windows(6).any(|six| six == b"\x1b_Ga=t"), "no pictures where none can be shown");
}

#[test]
fn a_scene_that_is_wrong_at_first_is_told_and_shown_when_it_is_mended() {
    let sandbox = sandbox();
    sandbox.write("wall.ron", "Scene(");
    let mut tty = start(&sandbox, "--terminal", [60, 20], XTERM);
    tty.until(|tty| tty.text().contains("error") && tty.text().contains("1 error"));
    sandbox.write("wall.ron", SCENE);
    tty.until(|tty| tty.point(30, 0) == Some(RED));
    tty.press("\x1b");
    assert_eq!(tty.ends().0, Some(0));
}

#[test]
fn a_terminal_that_never_answers_gets_half_blocks_and_keys_are_not_lost() {
    let sandbox = sandbox();
    let mut tty = start(&sandbox, "--terminal", [80, 24], &[]);
    tty.until(|tty| tty.point(0, 0) == Some(RED));
    tty.press("\x03");
    assert_eq!(tty.ends().0, Some(130));
    // One that was pressed while it was being asked.
    let mut tty = start(&sandbox, "--terminal", [80, 24], &[]);
    tty.until(|tty| tty.wrote("\x1b[c"));
    tty.press("q");
    let began = Instant::now();
    assert_eq!(tty.ends().0, Some(0));
    assert!(began.elapsed() < Duration::from_secs(20));
}

#[test]
fn narrow_terminals_and_those_that_change_have_room_for_it() {
    let sandbox = sandbox();
    let mut tty = start(&sandbox, "--terminal=blocks", [20, 6], XTERM);
    // 80 by 46 in 20 columns and 5 rows: 17 by 10 points, in the middle.
    tty.until(|tty| tty.point(1, 0) == Some(RED) && tty.point(17, 9) == Some(RED));
    assert_eq!((tty.point(0, 0), tty.point(18, 0)), (None, None));
    tty.until(|tty| tty.text().lines().last().is_some_and(|line| line.contains("4 samples")));
    sandbox.write("wall.ron", SCENE.replace("fov: 40", "fov: 400"));
    tty.until(|tty| tty.text().contains("1 error"));
    assert!((0..20).any(|x| tty.point(x, 0) == Some(RED)), "{}", tty.text());
    sandbox.write("wall.ron", SCENE);
    tty.until(|tty| !tty.text().contains("error"));
    tty.resize([60, 20]);
    // 60 by 35 points.
    tty.until(|tty| [(0, 0), (59, 34)].iter().all(|&(x, y)| tty.point(x, y) == Some(RED)));
    tty.resize([1, 1]);
    tty.resize([9, 2]);
    tty.until(|tty| tty.point(3, 0) == Some(RED));
    tty.press("q");
    assert_eq!(tty.ends().0, Some(0));
}

/// At its own size this would take an hour.
#[test]
fn a_picture_is_rendered_no_larger_than_it_is_seen() {
    let sandbox = sandbox();
    sandbox.write("wall.ron", SCENE.replace("width: 80, height: 46", "width: 8000, height: 4600"));
    let mut command = sandbox.command(&["preview", "--terminal", "--samples", "256", "wall.ron"]);
    let mut tty = Tty::start(quiet(&mut command, TRUE_COLOUR), [80, 24], [0, 0], XTERM);
    tty.until(|tty| tty.text().contains("256 samples") && tty.text().contains("done in"));
    assert_eq!((tty.point(0, 0), tty.point(79, 45)), (Some(RED), Some(RED)));
    tty.press("q");
    assert_eq!(tty.ends().0, Some(0));
}

#[test]
fn the_camera_moves_and_is_written_and_the_file_put_back() {
    let sandbox = sandbox();
    let mut tty = start(&sandbox, "--terminal", [80, 24], XTERM);
    tty.until(|tty| tty.text().contains("done in"));
    let middle = tty.point(40, 23);
    tty.press("\x1b[Cll++?");
    tty.until(|tty| tty.text().contains("hjkl") && tty.text().contains("camera moved"));
    assert_eq!(sandbox.text("wall.ron"), SCENE);
    tty.press("?w");
    tty.until(|_| sandbox.text("wall.ron") != SCENE);
    let text = sandbox.text("wall.ron");
    assert!(text.contains("// the eye") && !text.contains("(0, 0, 5)"), "{text}");
    tty.until(|tty| tty.text().contains("the camera is written"));
    tty.press("u");
    tty.until(|_| sandbox.text("wall.ron") == SCENE);
    tty.press("u");
    tty.until(|tty| tty.text().contains("nothing was written"));
    // Two stops, in six steps, and back.
    tty.press("EEEEEE");
    tty.until(|tty| tty.point(0, 0).is_some_and(|rgb| rgb[0] < 150));
    tty.press("eeeeee");
    tty.until(|tty| tty.point(0, 0) == Some(RED) && tty.point(40, 23) == middle);
    tty.press("q");
    assert_eq!(tty.ends().0, Some(0));
}

#[test]
fn a_rendering_rests_and_goes_on() {
    let sandbox = sandbox();
    sandbox.write("wall.ron", SCENE.replace("samples: 4", "samples: 1000000"));
    let mut tty = start(&sandbox, "--terminal", [80, 24], XTERM);
    let done = |tty: &Tty| -> u32 {
        let text = tty.text();
        let part = text.split("/1000000 samples").next().unwrap_or("");
        part.rsplit(' ').next().and_then(|number| number.parse().ok()).unwrap_or(0)
    };
    tty.until(|tty| done(tty) >= 7 && tty.text().contains(" left"));
    tty.press(" ");
    tty.until(|tty| tty.text().contains("paused"));
    let rests = done(&tty);
    std::thread::sleep(Duration::from_millis(400));
    let still = done(&tty);
    tty.press(" ");
    tty.until(|tty| done(tty) > still && !tty.text().contains("paused"));
    // What was under way when the key came may have been drawn after it.
    assert!(still <= 2 * rests + 1, "{rests} samples, then {still}");
    tty.press("q");
    assert_eq!(tty.ends().0, Some(0));
}

#[test]
fn signals_end_it_and_the_terminal_is_left_as_it_was() {
    for (signal, code) in [("TERM", 143), ("HUP", 129), ("INT", 130)] {
        let sandbox = sandbox();
        let tty = start(&sandbox, "--terminal", [80, 24], XTERM);
        tty.until(|tty| tty.point(0, 0) == Some(RED));
        tty.signal(signal);
        assert_eq!(tty.ends().0, Some(code), "{signal}");
    }
    // While it is asked, and while nobody reads what is written.
    let sandbox = sandbox();
    let tty = start(&sandbox, "--terminal", [80, 24], &[]);
    tty.until(|tty| tty.wrote("\x1b[c"));
    tty.signal("TERM");
    assert_eq!(tty.ends().0, Some(143));
    let mut command = sandbox.command(&["preview", "--terminal=kitty", "--size", "2000x2000", "wall.ron"]);
    let mut tty = Tty::deaf(quiet(&mut command, TRUE_COLOUR), [250, 80], [10, 20]);
    std::thread::sleep(Duration::from_millis(2500));
    tty.signal("TERM");
    let began = Instant::now();
    assert_eq!(tty.waits(), Some(143));
    assert!(began.elapsed() < Duration::from_secs(20));
}

#[test]
fn each_terminal_gets_what_it_can_show() {
    const KITTY: Answers = &[("\x1b_Gi=31", "\x1b_Gi=31;OK\x1b\\"), ("\x1b[c", "\x1b[?62;c")];
    const SIXEL: Answers = &[("\x1b[?2026$p", "\x1b[?2026;2$y"), ("\x1b[c", "\x1b[?62;4;22c")];
    const WEZTERM: Answers = &[("\x1b[>q", "\x1bP>|WezTerm 1\x1b\\"), ("\x1b[c", "\x1b[?65;4c")];
    let (kitty, sixel, iterm) = ("\x1b_Ga=t,f=100", "\x1bP0;1;0q\"1;1;", "\x1b]1337;File=inline=1");
    let cases: [(&str, Answers, &str, &str); 6] = [
        ("--terminal", KITTY, kitty, "\x1b_Ga=d"),
        ("--terminal", SIXEL, sixel, "\x1b[?2026h"),
        ("--terminal", WEZTERM, iterm, "width="),
        ("--terminal=sixel", &[], sixel, "#0;2;"),
        ("--terminal=iterm", XTERM, iterm, "width="),
        ("--terminal=blocks", KITTY, "▀", "38;2;"),
    ];
    let sandbox = sandbox();
    for (how, answers, picture, also) in cases {
        let mut command = sandbox.command(&["preview", how, "wall.ron"]);
        let mut tty = Tty::start(quiet(&mut command, TRUE_COLOUR), [80, 24], [10, 20], answers);
        tty.until(|tty| tty.wrote(picture) && tty.text().contains("done in"));
        tty.press("q");
        let (code, bytes) = tty.ends();
        let bytes = String::from_utf8_lossy(&bytes).into_owned();
        assert_eq!(code, Some(0), "{how}");
        assert!(bytes.contains(also), "{how}");
        // What is told is not asked for.
        assert_eq!(bytes.contains("a=q"), how == "--terminal", "{how}");
        for other in [kitty, sixel, iterm, "▀"].into_iter().filter(|other| *other != picture) {
            assert!(!bytes.contains(other), "{how} has {other:?}");
        }
    }
    // In tmux nothing is known to get through.
    let tmux = [("TERM", "tmux-256color"), ("TMUX", "/tmp/x,1,0")];
    let mut command = sandbox.command(&["preview", "--terminal", "wall.ron"]);
    let mut tty = Tty::start(quiet(&mut command, &tmux), [80, 24], [10, 20], KITTY);
    tty.until(|tty| tty.wrote("▀"));
    tty.press("q");
    let (code, bytes) = tty.ends();
    assert_eq!(code, Some(0));
    // tmux would take a question for the title of its window.
    assert!(!bytes.windows(2).any(|two| two == b"\x1b_"), "no words of kitty's");
}

#[test]
fn without_24_bits_there_are_256_colours() {
    let sandbox = sandbox();
    let mut command = sandbox.command(&["preview", "--terminal", "wall.ron"]);
    let mut tty = Tty::start(quiet(&mut command, &[("TERM", "xterm-256color")]), [80, 24], [0, 0], XTERM);
    // Red is 196.
    tty.until(|tty| tty.wrote("38;5;196"));
    tty.press("q");
    let (_, bytes) = tty.ends();
    let pictures = String::from_utf8_lossy(&bytes).into_owned();
    assert!(!pictures.contains("38;2;"), "no colour that it may not know");
}

#[test]
fn where_there_is_no_terminal_it_is_said_what_shows_the_picture() {
    let sandbox = sandbox();
    let ran = sandbox.run(&["preview", "--terminal", "wall.ron"]).ends(2);
    let ran = ran.says(&["standard output is no terminal", "`tracer preview wall.ron`", "`tracer render wall.ron`"]);
    assert!(ran.out.is_empty());
    let mut command = sandbox.command(&["preview", "--terminal", "wall.ron"]);
    let mut tty = Tty::start(quiet(&mut command, &[("TERM", "dumb")]), [80, 24], [0, 0], XTERM);
    assert_eq!(tty.waits(), Some(2));
    tty.until(|tty| tty.text().contains("TERM=dumb"));
    for other in [&["--open"][..], &["--port", "8000"], &["--editor", "code"]] {
        let arguments = [&["preview", "--terminal", "wall.ron"], other].concat();
        sandbox.run(&arguments).ends(2).says(&["cannot be used with", other[0]]);
    }
}

/// A host that fails while the terminal is ours.
struct Falls;

impl tracer_preview::Host for Falls {
    fn encode(&self, _: &SceneDesc, _: &Film, _: &Look, _: tracer_preview::Kind) -> Result<Vec<u8>, String> {
        Err("nothing is encoded here".to_owned())
    }

    fn save(&self, _: &Path, _: &[u8]) -> Result<(), String> {
        panic!("the host has fallen");
    }

    fn free_memory(&self) -> Option<u64> {
        None
    }
}

const FALLS: &str = "TRACER_TEST_SCENE";

/// The test is its own program in the terminal.
#[test]
fn a_panic_leaves_the_terminal_and_is_told_after_that() {
    if let Ok(scene) = std::env::var(FALLS) {
        let options = tracer_preview::Options {
            scene: scene.into(),
            syntax: None,
            overrides: Vec::new(),
            samples: None,
            size: None,
            threads: 1,
            editor: None,
        };
        let end = tracer_preview::terminal::run(options, Box::new(Falls), None);
        unreachable!("it ended: {end:?}");
    }
    let sandbox = sandbox();
    let this = std::env::current_exe().expect("a program");
    let mut command = Command::new(this);
    let name = "terminal::a_panic_leaves_the_terminal_and_is_told_after_that";
    command.args(["--exact", name, "--nocapture"]).env(FALLS, sandbox.path("wall.ron"));
    let mut tty = Tty::start(quiet(&mut command, TRUE_COLOUR), [80, 24], [0, 0], XTERM);
    tty.until(|tty| tty.text().contains("done in"));
    tty.press("lw");
    let (code, bytes) = tty.ends();
    assert_eq!(code, Some(101));
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (before, after) = text.rsplit_once("\x1b[?1049l").expect("the screen is left");
    assert!(after.contains("the host has fallen") && !before.contains("the host has fallen"), "{after}");
}
