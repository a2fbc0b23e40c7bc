//! `tracer farm status`: how far each part is.

use super::parts::{self, State, Told};
use super::queue;
use super::record::{Layout, Record, find};
use super::scripts::ranges;
use crate::args::FarmStatusArgs;
use crate::command_line::quoted;
use crate::failure::{Failure, exit};
use serde_json::json;
use std::io::Write;
use std::process::ExitCode;

/// Of scripts that wait: parts or the merge wait or run.
const AT_WORK: u8 = 3;

pub(super) fn run(args: &FarmStatusArgs) -> Result<ExitCode, Failure> {
    let farms = args.farms.iter().map(|farm| find(farm)).collect::<Result<Vec<_>, Failure>>()?;
    let all = farms.iter().map(|(layout, record)| Status::new(layout, record)).collect::<Result<Vec<_>, Failure>>()?;
    let text = match (args.json, all.as_slice()) {
        (true, [one]) => format!("{:#}\n", one.as_json()),
        (true, many) => format!("{:#}\n", many.iter().map(Status::as_json).collect::<serde_json::Value>()),
        (false, many) => many.iter().map(Status::as_text).collect(),
    };
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()?;
    let codes: Vec<u8> = all.iter().map(Status::exit_code).collect();
    let worst = [exit::FAILED, AT_WORK].into_iter().find(|code| codes.contains(code));
    Ok(ExitCode::from(worst.unwrap_or(exit::DONE)))
}

/// All that there is to tell.
struct Status<'a> {
    layout: &'a Layout,
    record: &'a Record,
    parts: Vec<Told>,
    merge: Told,
}

impl<'a> Status<'a> {
    fn new(layout: &'a Layout, record: &'a Record) -> Result<Self, Failure> {
        // Before the films are looked at: a part that leaves the queue has written its film.
        let is_merged = layout.state("merge", "done").exists();
        let jobs: Vec<String> = record.arrays.iter().chain(&record.merge).cloned().collect();
        let queued = if is_merged { Vec::new() } else { queue::queue(&jobs)? };
        let parts = parts::parts(layout, record, &queued);
        let merge = parts::merge(layout, record, &queued);
        Ok(Status { layout, record, parts, merge })
    }

    fn all(&self) -> impl Iterator<Item = &Told> {
        self.parts.iter().chain([&self.merge])
    }

    fn exit_code(&self) -> u8 {
        if self.merge.state == State::Done {
            exit::DONE
        } else if self.all().any(|told| told.state.is_lost()) {
            exit::FAILED
        } else {
            AT_WORK
        }
    }

    /// Parts of a state.
    fn count(&self, state: State) -> usize {
        self.parts.iter().filter(|told| told.state == state).count()
    }

    /// The share of all samples that films have.
    fn share(&self) -> f64 {
        let of_part = |told: &Told| match told.samples {
            Some([held, asked]) => f64::from(held) / f64::from(asked.max(1)),
            None => 0.0,
        };
        self.parts.iter().map(of_part).sum::<f64>() / self.parts.len().max(1) as f64
    }

    fn as_text(&self) -> String {
        let Record { scene, parts, pictures, arrays, merge, .. } = self.record;
        let folder = self.layout.folder.display();
        let jobs = arrays.iter().chain(merge).map(String::as_str).collect::<Vec<_>>().join(", ");
        let mut text = format!("{folder}: {scene} in {parts} parts, jobs {jobs}\n");
        let mut line = |name: &str, told: &Told| {
            let samples = match (told.state, told.samples) {
                (State::Done, _) | (_, None) => String::new(),
                (_, Some([held, asked])) => format!("{held} of {asked} samples"),
            };
            let line = format!("{name:<11} {:<8} {samples:<22} {}", told.state.word(), told.note);
            text += &format!("{}\n", line.trim_end());
            told.log.iter().for_each(|log| text += &format!("            | {log}\n"));
        };
        // Parts of which the same is told are told together.
        let is_alike = |a: &Told, b: &Told| {
            (a.state, &a.note, &a.log) == (b.state, &b.note, &b.log)
                && (a.state == State::Done || a.samples == b.samples)
        };
        let mut first = 0;
        while first < self.parts.len() {
            let told = &self.parts[first];
            let alike = self.parts[first..].iter().take_while(|other| is_alike(told, other)).count();
            let numbers: Vec<u32> = (first..first + alike).map(|k| k as u32 + 1).collect();
            line(&ranges(&numbers), told);
            first += alike;
        }
        line("merge", &self.merge);
        text + &self.end(&pictures.join(", "))
    }

    /// The last lines: how far all is, and what to type where it will not go on by itself.
    fn end(&self, pictures: &str) -> String {
        let states = [State::Done, State::Running, State::Waiting, State::Failed, State::Stopped];
        let counts = states.into_iter().filter(|state| self.count(*state) > 0);
        let counts = counts.map(|state| format!("{} {}", self.count(state), state.word())).collect::<Vec<_>>();
        let mut text = format!("{}; {:.0} % of the samples", counts.join(", "), (100.0 * self.share()).floor());
        match self.exit_code() {
            exit::DONE => text += &format!("; merged: {pictures}\n"),
            exit::FAILED => {
                let words: Vec<String> = self.record.command.iter().map(|word| quoted(word)).collect();
                let directory = quoted(&self.record.directory);
                text += &format!("\nto go on with what is missing: cd {directory} && {}\n", words.join(" "));
            }
            _ => text.push('\n'),
        }
        text
    }

    fn as_json(&self) -> serde_json::Value {
        let told = |told: &Told| {
            let Told { state, samples, note, log } = told;
            json!({ "state": state.word(), "samples": samples, "note": note, "log": log })
        };
        let of_part = |(k, part): (usize, &Told)| {
            let mut json = told(part);
            json["part"] = (k + 1).into();
            json
        };
        json!({
            "folder": self.layout.folder,
            "scene": self.record.scene,
            "pictures": self.record.pictures,
            "arrays": self.record.arrays,
            "merge_job": self.record.merge,
            "share": self.share(),
            "parts": self.parts.iter().enumerate().map(of_part).collect::<Vec<_>>(),
            "merge": told(&self.merge),
        })
    }
}
