//! The record that a picture carries of how it was made: with the scene's text, which is beside it, all that it takes
//! to make it again, but for the files that the scene names. Of them it knows the contents by their hashes.

use super::picture::{all, first};
use crate::args::AdaptiveName;
use crate::command_line::quoted;
use crate::write::sha256;
use serde::{Deserialize, Serialize};
use std::path::Path;
use tracer_core::{Crop, Film, Layer, LayerSet, Note, PROGRAM, Plan};

/// What a picture was made with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Version of this record.
    pub record: u32,
    /// Version of the program, and a checksum of its engine's sources.
    pub program: String,
    /// The scene file's name, without its folders.
    pub scene: String,
    /// SHA-256 of the scene file's text.
    pub scene_sha256: String,
    /// Fields of the scene that the command line set.
    pub set: Vec<String>,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Fewest and most samples of a pixel, but for quiet tiles.
    pub samples: [u32; 2],
    /// Where it was ended within a pass ([`Plan`]).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<String>,
    /// Quiet tiles have taken fewer samples than these.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub adaptive: bool,
    /// Of all random choices.
    pub seed: u32,
    /// Stops.
    pub exposure: f64,
    /// What of the picture was rendered: left, top, width, height.
    pub crop: [u32; 4],
    /// How it was denoised; none where it was not.
    pub denoise: Option<String>,
    /// The layer that it shows in place of the picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub show: Option<String>,
    /// The files of the scene; none where they are not told.
    pub files: Option<Vec<RecordedFile>>,
    /// Hash over their contents.
    pub assets: Option<String>,
}

/// A file that a picture was made of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordedFile {
    /// As the scene names it, from its own folder.
    pub name: String,
    /// SHA-256 of its contents.
    pub sha256: String,
}

/// The version that is written, and the only one that is read.
pub const RECORD_VERSION: u32 = 1;

/// How the names of notes of files begin.
const FILE: &str = "file:";

/// The hashes of the contents of all files, as one that does not depend on their names and order: of the hashes in
/// hexadecimal, sorted, a line each. None where there is no file.
pub fn assets_hash(notes: &[Note]) -> Option<String> {
    let mut hashes: Vec<&str> =
        notes.iter().filter(|(name, _)| name.starts_with(FILE)).map(|(_, hash)| hash.as_str()).collect();
    hashes.sort_unstable();
    let lines: String = hashes.iter().map(|hash| format!("{hash}\n")).collect();
    (!hashes.is_empty()).then(|| sha256(lines.as_bytes()))
}

/// The name of a file as a picture may tell it. One by its whole path would tell where things lie on this machine, so
/// it stands there only if the scene's text, which the picture holds, has it.
pub fn told_name<'a>(name: &'a str, scene: &str) -> &'a str {
    let path = Path::new(name);
    let is_told = !path.is_absolute() || scene.contains(name);
    path.file_name().and_then(|file| file.to_str()).filter(|_| !is_told).unwrap_or(name)
}

impl Record {
    /// Of a film, by the notes beside it; of the files where `files` are known.
    pub fn new(notes: &[Note], film: &Film, denoise: Option<&str>) -> Self {
        let scene = first(notes, "scene_text");
        let of_file = |(name, hash): &Note| {
            let name = told_name(name.strip_prefix(FILE)?, scene).to_owned();
            Some(RecordedFile { name, sha256: hash.clone() })
        };
        let (fewest, most) = film.samples().into_inner();
        let Crop { x, y, width, height } = film.crop();
        let is_told = first(notes, "files") == "told" || notes.iter().any(|(name, _)| name.starts_with(FILE));
        Record {
            record: RECORD_VERSION,
            program: PROGRAM.to_owned(),
            scene: first(notes, "scene_name").to_owned(),
            scene_sha256: first(notes, "scene_sha256").to_owned(),
            set: all(notes, "set").map(str::to_owned).collect(),
            size: film.size(),
            samples: [fewest, most],
            plan: film.plan().map(|plan| plan.to_string()),
            adaptive: film.is_adaptive(),
            seed: film.seed(),
            exposure: first(notes, "exposure").parse().unwrap_or_default(),
            crop: [x, y, width, height],
            denoise: denoise.map(str::to_owned),
            show: Some(first(notes, "show").to_owned()).filter(|show| !show.is_empty()),
            files: is_told.then(|| notes.iter().filter_map(of_file).collect()),
            assets: assets_hash(notes),
        }
    }

    /// As one line; where its files are too many, without them.
    pub fn to_json(&self) -> String {
        let json = |record: &Record| serde_json::to_string(record).unwrap_or_default();
        let whole = json(self);
        if whole.len() <= crate::write::Provenance::MAX_RECORD_BYTES {
            return whole;
        }
        json(&Record { files: None, ..self.clone() })
    }

    /// Reads one that a picture holds, whoever wrote it.
    ///
    /// # Errors
    /// Why it cannot be used.
    pub fn read(text: &str) -> Result<Self, String> {
        let version = serde_json::from_str::<serde_json::Value>(text).ok();
        let version = version.and_then(|record| record.get("record")?.as_u64());
        if version.is_some_and(|version| version != u64::from(RECORD_VERSION)) {
            return Err(
                "another version of tracer has written how it was made, in a way that this one cannot read".into()
            );
        }
        let record: Record = serde_json::from_str(text)
            .map_err(|error| format!("what it tells of how it was made is damaged: {error}"))?;
        const MAX_SIDE: u32 = 65_536;
        let [width, height] = record.size;
        let [fewest, most] = record.samples;
        let is_size = (1..=MAX_SIDE).contains(&width) && (1..=MAX_SIDE).contains(&height);
        let is_crop = record.crop().width > 0 && record.crop().height > 0;
        let is_sound = is_size
            && is_crop
            && record.crop().within(record.size) == record.crop()
            && 1 <= fewest
            && fewest <= most
            && most <= 1_000_000_000
            && record.plan.as_ref().is_none_or(|plan| plan.parse::<Plan>().is_ok())
            && record.exposure.abs() <= 64.0;
        if is_sound { Ok(record) } else { Err("what it tells of how it was made is damaged".into()) }
    }

    /// Where it was ended within a pass.
    pub fn plan(&self) -> Option<Plan> {
        self.plan.as_ref()?.parse().ok()
    }

    /// What of the picture was rendered.
    pub fn crop(&self) -> Crop {
        let [x, y, width, height] = self.crop;
        Crop { x, y, width, height }
    }

    /// The layer that it shows in place of the picture.
    pub fn shown(&self) -> Option<Layer> {
        LayerSet::by_name(self.show.as_deref()?)
    }

    /// The options that make the picture of the scene file, with these layers.
    fn options(&self, layers: LayerSet) -> Vec<String> {
        let mut words = Vec::new();
        let mut option = |name: &str, value: String| words.extend([name.to_owned(), value]);
        for set in &self.set {
            option("--set", set.clone());
        }
        option("--size", format!("{}x{}", self.size[0], self.size[1]));
        match &self.plan {
            Some(plan) => option("--plan", plan.clone()),
            None => option("--samples", self.samples[0].to_string()),
        }
        if self.adaptive {
            option("--adaptive", AdaptiveName::Always.name().to_owned());
        }
        option("--seed", self.seed.to_string());
        option("--exposure", self.exposure.to_string());
        let [x, y, width, height] = self.crop;
        if self.crop() != Crop::whole(self.size) {
            option("--crop", format!("{x},{y},{width},{height}"));
        }
        if let Some(show) = &self.show {
            option("--show", show.clone());
        }
        if !layers.is_empty() {
            option("--layers", layers.names().collect::<Vec<_>>().join(","));
        }
        words.extend(self.denoise.iter().map(|denoise| format!("--denoise={denoise}")));
        words
    }

    /// The command line that makes such a picture, with these layers, of its scene file.
    pub fn command(&self, picture: &str, layers: LayerSet) -> String {
        let scene = self.scene.as_str();
        let words =
            ["tracer", "render", scene, "-o", picture].map(str::to_owned).into_iter().chain(self.options(layers));
        words.map(|word| quoted(&word)).collect::<Vec<_>>().join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        Record {
            record: RECORD_VERSION,
            program: PROGRAM.to_owned(),
            scene: "a.ron".to_owned(),
            scene_sha256: String::new(),
            set: vec!["camera=\"oben\"".to_owned()],
            size: [40, 24],
            samples: [2, 2],
            plan: None,
            adaptive: false,
            seed: 1,
            exposure: -0.5,
            crop: [8, 0, 16, 24],
            denoise: Some("on".to_owned()),
            show: None,
            files: Some(Vec::new()),
            assets: None,
        }
    }

    #[test]
    fn records_come_back_and_tell_the_command() {
        let record = record();
        assert_eq!(Record::read(&record.to_json()).as_ref(), Ok(&record));
        let layers = ["depth"].iter().filter_map(|name| LayerSet::by_name(name)).collect();
        let command = "tracer render a.ron -o a.png --set 'camera=\"oben\"' --size 40x24 --samples 2 --seed 1 \
                       --exposure -0.5 --crop 8,0,16,24 --layers depth --denoise=on";
        assert_eq!(record.command("a.png", layers), command);
    }

    #[test]
    fn what_is_no_record_is_refused() {
        let bad = [
            Record { size: [0, 24], ..record() },
            Record { size: [70_000, 24], ..record() },
            Record { samples: [0, 0], ..record() },
            Record { samples: [3, 2], ..record() },
            Record { samples: [2, u32::MAX], ..record() },
            Record { plan: Some("3,2,1,0".to_owned()), ..record() },
            Record { exposure: 1e9, ..record() },
            Record { crop: [8, 0, 40, 24], ..record() },
            Record { crop: [8, 0, 0, 24], ..record() },
            Record { crop: [u32::MAX, 0, u32::MAX, 1], ..record() },
        ];
        for bad in bad {
            assert!(Record::read(&bad.to_json()).is_err_and(|why| why.contains("damaged")), "{bad:?}");
        }
        assert!(Record::read("{}").is_err() && Record::read("").is_err() && Record::read("[[[").is_err());
        let newer = Record { record: 2, ..record() };
        assert!(Record::read(&newer.to_json()).is_err_and(|why| why.contains("another version")));
        assert!(Record::read(&"[".repeat(100_000)).is_err());
    }

    /// As `sha256sum FILES | cut -c1-64 | sort | sha256sum` has it.
    #[test]
    fn one_hash_stands_for_all_files() {
        let note = |name: &str, hash: &str| (name.to_owned(), hash.to_owned());
        let notes = [note("file:b", "aa"), note("hash", "00"), note("file:a", "bb")];
        assert_eq!(assets_hash(&notes), Some(sha256(b"aa\nbb\n")));
        assert_eq!(assets_hash(&notes[1..2]), None);
    }

    #[test]
    fn pictures_do_not_tell_where_files_lie() {
        assert_eq!(told_name("assets/cat.obj", ""), "assets/cat.obj");
        assert_eq!(told_name("../cat.obj", ""), "../cat.obj");
        assert_eq!(told_name("/home/me/cat.png", "Mesh(file: \"cat.obj\")"), "cat.png");
        assert_eq!(told_name("/share/cat.obj", "Mesh(file: \"/share/cat.obj\")"), "/share/cat.obj");
    }
}
