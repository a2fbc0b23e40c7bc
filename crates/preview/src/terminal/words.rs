//! The lines under the picture: how far it is, what is wrong, what keys do.

use crate::shared::Phase;
use crate::told::Told;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// How far a picture is.
#[derive(Clone, Debug)]
pub struct Status<'a> {
    pub name: &'a str,
    pub phase: Phase,
    pub paused: bool,
    /// Samples per pixel that are there, and that are made; `None`: there is no picture, or only a draft.
    pub samples: Option<u32>,
    pub asked: u32,
    /// Camera samples that were there when the rendering began, that are done, and of how many.
    pub begun: u64,
    pub done: u64,
    pub total: u64,
    pub seconds: f64,
    pub noise: Option<f64>,
    /// Pixels that this leaves out, since nearly all noise is theirs.
    pub noisier: usize,
    /// Stops beside the scene's.
    pub exposure: f64,
    /// The camera is not where the file has it.
    pub moved: bool,
    /// Errors, or warnings.
    pub told: usize,
}

impl Status<'_> {
    /// A line of so many columns; what has no room is left out, the least first.
    pub fn line(&self, columns: usize) -> String {
        let mut parts = self.parts();
        loop {
            let line = parts.iter().map(|(_, part)| part.as_str()).collect::<Vec<_>>().join("  ");
            let least = (0..parts.len()).max_by_key(|&k| parts[k].0);
            match least.filter(|_| parts.len() > 1 && line.width() > columns) {
                Some(least) => drop(parts.remove(least)),
                None => return cut(&line, columns),
            }
        }
    }

    /// What there is to say, in order, each with how soon it is left out: 0 last.
    fn parts(&self) -> Vec<(u8, String)> {
        let mut parts = vec![(6, printable(self.name))];
        let speed = self.done.saturating_sub(self.begun) as f64 / self.seconds;
        let rendering = self.phase == Phase::Rendering;
        match self.phase {
            Phase::Wrong => parts.push((0, counted(self.told, "error"))),
            Phase::Loading => parts.push((0, "loading".to_owned())),
            Phase::Done => {}
            Phase::Rendering if self.paused => parts.push((0, "paused".to_owned())),
            Phase::Rendering if self.samples.is_none() => parts.push((0, "draft".to_owned())),
            Phase::Rendering => {}
        }
        if let Some(samples) = self.samples {
            let of = if rendering { format!("{samples}/{}", self.asked) } else { samples.to_string() };
            parts.push((1, format!("{of} samples")));
        }
        if speed.is_finite() && speed > 0.0 && matches!(self.phase, Phase::Rendering | Phase::Done) {
            parts.push((4, rate(speed)));
        }
        if let Some(noise) = self.noise {
            let but_for = match self.noisier {
                0 => String::new(),
                1 => " but for one pixel".to_owned(),
                pixels => format!(" but for {pixels} pixels"),
            };
            parts.push((3, format!("noise {} %{but_for}", percent(noise))));
        }
        if rendering && !self.paused && speed.is_finite() && speed > 0.0 {
            parts.push((2, format!("{} left", time(self.total.saturating_sub(self.done) as f64 / speed))));
        } else if self.phase == Phase::Done {
            parts.push((2, format!("done in {}", time(self.seconds))));
        }
        if self.exposure != 0.0 {
            parts.push((3, format!("{:+.1} stops", self.exposure)));
        }
        if self.moved {
            parts.push((5, "camera moved".to_owned()));
        }
        if self.told > 0 && self.phase != Phase::Wrong {
            parts.push((4, counted(self.told, "warning")));
        }
        parts.push((7, "? keys, q quits".to_owned()));
        parts
    }
}

/// What keys do, in lines of so many columns.
pub fn help(columns: usize) -> Vec<String> {
    const KEYS: [&str; 9] = [
        "q quit",
        "space pause",
        "arrows or hjkl orbit",
        "+ - nearer, farther",
        "r camera of the file",
        "w write it into the file",
        "u undo that",
        "e E brighter, darker",
        "m twice the samples",
    ];
    let mut lines: Vec<String> = Vec::new();
    for key in KEYS {
        match lines.last_mut() {
            Some(line) if line.width() + 3 + key.width() <= columns => *line += &format!("   {key}"),
            _ => lines.push(cut(key, columns)),
        }
    }
    lines
}

/// A line, and its colour, as a parameter of SGR.
pub type Line = (String, Option<u8>);

/// What is odd about a scene that is shown: the first line of each warning.
pub fn warnings(told: &[Told], columns: usize, most: usize) -> Vec<Line> {
    let first = |told: &Told| (cut(told.text.lines().next().unwrap_or(""), columns), Some(YELLOW));
    told.iter().take(most).map(first).collect()
}

/// Colours of text, as parameters of SGR.
const RED: u8 = 31;
const YELLOW: u8 = 33;

/// What is wrong, in lines of so many columns; no more than `most` of them.
pub fn faults(told: &[Told], columns: usize, most: usize) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    let mut left = 0;
    for told in told {
        let colour = if told.severity == "error" { RED } else { YELLOW };
        let text = told.text.trim_end().lines().enumerate().flat_map(|(k, line)| {
            let colour = (k == 0).then_some(colour);
            wrapped(line, columns).into_iter().map(move |line| (line, colour))
        });
        for line in text {
            if lines.len() < most {
                lines.push(line);
            } else {
                left += 1;
            }
        }
    }
    if left > 0
        && let Some(last) = lines.last_mut()
    {
        *last = (cut(&format!("and {}", counted(left + 1, "more line")), columns), None);
    }
    lines
}

/// A text in lines of so many columns, broken at spaces where there are any. An indent stays with what follows.
pub fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut rest = printable(text);
    let mut lines = Vec::new();
    while rest.width() > columns.max(1) {
        let end = reach(&rest, columns.max(1)).max(rest.chars().next().map_or(0, char::len_utf8));
        let indent = rest.len() - rest.trim_start().len();
        let at = rest[..end].rfind(' ').filter(|&at| at > indent).unwrap_or(end);
        let after = rest[at..].trim_start().to_owned();
        rest.truncate(at);
        lines.push(rest);
        rest = after;
    }
    lines.push(rest);
    lines
}

/// The longest beginning that has room, in bytes.
fn reach(text: &str, columns: usize) -> usize {
    let mut width = 0;
    let fits = |(_, c): &(usize, char)| {
        width += c.width().unwrap_or(0);
        width <= columns
    };
    text.char_indices().take_while(fits).last().map_or(0, |(at, c)| at + c.len_utf8())
}

/// The text, or its beginning with a sign that there is more.
pub fn cut(text: &str, columns: usize) -> String {
    let text = printable(text);
    if text.width() <= columns {
        return text;
    }
    format!("{}{}", &text[..reach(&text, columns.saturating_sub(1))], if columns > 0 { "…" } else { "" })
}

/// Without anything that a terminal would take for an order: names and scenes may have it.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn counted(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

fn rate(per_second: f64) -> String {
    match per_second {
        r if r >= 1e9 => format!("{:.1} G samples/s", r / 1e9),
        r if r >= 1e6 => format!("{:.1} M samples/s", r / 1e6),
        r if r >= 1e3 => format!("{:.1} k samples/s", r / 1e3),
        r => format!("{r:.0} samples/s"),
    }
}

fn time(seconds: f64) -> String {
    match seconds {
        s if s < 9.95 => format!("{s:.1} s"),
        s if s < 60.0 => format!("{s:.0} s"),
        s if s < 3600.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 10.0 { format!("{percent:.0}") } else { format!("{percent:.1}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status() -> Status<'static> {
        Status {
            name: "scene.ron",
            phase: Phase::Rendering,
            paused: false,
            samples: Some(12),
            asked: 64,
            begun: 0,
            done: 12_000_000,
            total: 64_000_000,
            seconds: 4.0,
            noise: Some(0.0213),
            noisier: 0,
            exposure: 0.0,
            moved: false,
            told: 0,
        }
    }

    #[test]
    fn a_line_says_what_it_has_room_for() {
        let whole = "scene.ron  12/64 samples  3.0 M samples/s  noise 2.1 %  17 s left  ? keys, q quits";
        assert_eq!(status().line(100), whole);
        assert_eq!(status().line(80), "scene.ron  12/64 samples  3.0 M samples/s  noise 2.1 %  17 s left");
        assert_eq!(status().line(40), "12/64 samples  noise 2.1 %  17 s left");
        assert_eq!(status().line(20), "12/64 samples");
        assert_eq!(status().line(8), "12/64 s…");
        assert_eq!(status().line(0), "");
        for columns in 0..120 {
            assert!(status().line(columns).width() <= columns);
        }
    }

    #[test]
    fn a_line_says_how_it_stands() {
        let at = |change: fn(&mut Status<'static>)| {
            let mut status = status();
            change(&mut status);
            status.line(200)
        };
        assert!(at(|s| s.paused = true).contains("paused  12/64 samples") && !at(|s| s.paused = true).contains("left"));
        assert!(at(|s| s.samples = None).contains("draft"));
        assert!(at(|s| s.noisier = 3).contains("  noise 2.1 % but for 3 pixels  "));
        assert!(at(|s| s.phase = Phase::Done).contains("  12 samples  3.0 M samples/s  noise 2.1 %  done in 4.0 s"));
        let wrong = at(|s| (s.phase, s.told) = (Phase::Wrong, 2));
        assert!(wrong.contains("2 errors") && !wrong.contains("samples/s"), "{wrong}");
        assert!(at(|s| s.told = 1).contains("1 warning"));
        assert!(at(|s| s.exposure = -2.0 / 3.0).contains("-0.7 stops"));
        assert!(at(|s| s.seconds = 0.0).contains("12/64 samples"));
    }

    #[test]
    fn faults_are_wrapped_and_cut() {
        let told = |severity, text: &str| Told { severity, ..Told::plain(text) };
        let two = [told("error", "error: the radius is below zero\n  | ^^ here"), told("warning", "warning: dark")];
        let lines = faults(&two, 40, 10);
        let expected =
            [("error: the radius is below zero", Some(31)), ("  | ^^ here", None), ("warning: dark", Some(33))];
        assert_eq!(lines, expected.map(|(line, colour)| (line.to_owned(), colour)));
        let narrow: Vec<String> = faults(&two, 12, 10).into_iter().map(|(line, _)| line).collect();
        assert_eq!(narrow, ["error: the", "radius is", "below zero", "  | ^^ here", "warning:", "dark"]);
        assert_eq!(faults(&two, 40, 2)[1].0, "and 2 more lines");
        assert_eq!(faults(&two, 40, 0), []);
        assert_eq!(warnings(&two[1..], 9, 3), [("warning:…".to_owned(), Some(33))]);
        // No orders to the terminal, no line beyond its columns.
        let evil = [told("error", "a\x1b[31mb\u{9b}2J日本語日本語")];
        for columns in 1..30 {
            let lines = faults(&evil, columns, 99);
            assert!(lines.iter().all(|(line, _)| !line.contains(|c: char| c.is_control())));
            assert!(lines.iter().all(|(line, _)| line.width() <= columns.max(2)), "{lines:?}");
        }
    }

    #[test]
    fn help_is_whole_in_any_width() {
        assert!(help(500).len() == 1 && help(30).len() > 4);
        assert!(help(20).iter().all(|line| line.width() <= 20));
    }

    #[test]
    fn what_is_long_is_said_to_its_end() {
        let note = "the camera is set by --camera, which counts more than the file; start the preview without it";
        let lines = wrapped(note, 40);
        assert!(lines.len() == 3 && lines.iter().all(|line| line.width() <= 40), "{lines:?}");
        assert_eq!(lines.join(" "), note);
    }
}
