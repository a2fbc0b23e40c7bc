//! The JSON of a glTF file. Elements of its lists are kept as text and read when they are asked for: what nobody asks
//! for costs next to nothing, and every fault knows its place.

use crate::cursor::{Fault, shown};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::value::RawValue;

pub(super) const EXPECTED: &str = "a glTF 2.0 file";

/// A list of the file that others point into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum List {
    Scenes,
    Nodes,
    Meshes,
    Accessors,
    BufferViews,
    Buffers,
    Materials,
    Textures,
    Images,
    Samplers,
}

impl List {
    const fn name(self) -> &'static str {
        match self {
            List::Scenes => "scenes",
            List::Nodes => "nodes",
            List::Meshes => "meshes",
            List::Accessors => "accessors",
            List::BufferViews => "bufferViews",
            List::Buffers => "buffers",
            List::Materials => "materials",
            List::Textures => "textures",
            List::Images => "images",
            List::Samplers => "samplers",
        }
    }

    /// `nodes[3]`
    pub(super) fn shown(self, index: u32) -> String {
        format!("{}[{index}]", self.name())
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Top<'a> {
    #[serde(borrow)]
    asset: Option<&'a RawValue>,
    scene: Option<u32>,
    #[serde(borrow, default)]
    scenes: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    nodes: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    meshes: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    accessors: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    buffer_views: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    buffers: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    materials: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    textures: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    images: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    samplers: Vec<&'a RawValue>,
    #[serde(default)]
    skins: Vec<IgnoredAny>,
    #[serde(default)]
    animations: Vec<IgnoredAny>,
    #[serde(default)]
    extensions_used: Vec<String>,
    #[serde(default)]
    extensions_required: Vec<String>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

#[derive(Deserialize)]
struct Named {
    name: Option<String>,
}

/// The JSON of a file.
pub(super) struct Document<'a> {
    text: &'a str,
    top: Top<'a>,
    /// Extensions that the file says it uses.
    pub(super) used: Vec<String>,
    /// Extensions without which it cannot be read.
    pub(super) required: Vec<String>,
    pub(super) skins: usize,
    pub(super) animations: usize,
}

/// An element of a list, and where it starts.
pub(super) struct Element<T> {
    pub(super) value: T,
    pub(super) at: usize,
}

impl<'a> Document<'a> {
    pub(super) fn parse(text: &'a str) -> Result<Document<'a>, Box<Fault>> {
        // Text editors begin files with a mark of their encoding, and some writers fill the chunk with zeros.
        let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let json = text.get(start..).unwrap_or_default().trim_end_matches('\0');
        let mut top: Top<'a> =
            serde_json::from_str(json).map_err(|error| fault_of(json, start, "the JSON is broken", &error))?;
        let Some(asset) = top.asset else {
            return Err(Fault::new(0, "the file has no `asset`, so it is no glTF", EXPECTED));
        };
        let (used, required) = (std::mem::take(&mut top.extensions_used), std::mem::take(&mut top.extensions_required));
        let (skins, animations) = (top.skins.len(), top.animations.len());
        let document = Document { text, top, used, required, skins, animations };
        let Element { value: Asset { version }, at } = document.read(asset, || "asset".to_owned())?;
        if version != "2" && !version.starts_with("2.") {
            let message = format!("version {} of glTF cannot be read", shown(version.as_bytes()));
            return Err(Fault::new(at, message, EXPECTED));
        }
        Ok(document)
    }

    /// The number of the default scene, if the file names one.
    pub(super) fn scene(&self) -> Option<u32> {
        self.top.scene
    }

    fn list(&self, list: List) -> &[&'a RawValue] {
        match list {
            List::Scenes => &self.top.scenes,
            List::Nodes => &self.top.nodes,
            List::Meshes => &self.top.meshes,
            List::Accessors => &self.top.accessors,
            List::BufferViews => &self.top.buffer_views,
            List::Buffers => &self.top.buffers,
            List::Materials => &self.top.materials,
            List::Textures => &self.top.textures,
            List::Images => &self.top.images,
            List::Samplers => &self.top.samplers,
        }
    }

    /// How many elements a list has.
    pub(super) fn count(&self, list: List) -> usize {
        self.list(list).len()
    }

    /// How many bytes of words an element of a list has.
    pub(super) fn length(&self, list: List, index: u32) -> u64 {
        self.list(list).get(index as usize).map_or(0, |raw| raw.get().len() as u64)
    }

    /// The name of an element of a list, where it has one.
    pub(super) fn name_of(&self, list: List, index: u32) -> Option<String> {
        let named: Named = serde_json::from_str(self.list(list).get(index as usize)?.get()).ok()?;
        named.name
    }

    /// An element of a list, named at a byte.
    pub(super) fn element<T: Deserialize<'a>>(
        &self,
        list: List,
        index: u32,
        named_at: usize,
    ) -> Result<Element<T>, Box<Fault>> {
        match self.list(list).get(index as usize) {
            Some(raw) => self.read(raw, || list.shown(index)),
            None => {
                let expected = match self.list(list).len() {
                    0 => format!("no number, as the file has no `{}`", list.name()),
                    count => format!("a number from 0 to {}", count - 1),
                };
                Err(Fault::new(named_at, format!("there is no {}", list.shown(index)), expected))
            }
        }
    }

    /// A piece of the text; `label` says what it is.
    pub(super) fn read<T: Deserialize<'a>>(
        &self,
        raw: &'a RawValue,
        label: impl Fn() -> String,
    ) -> Result<Element<T>, Box<Fault>> {
        // Pieces are parts of the text: the difference of addresses is where they start.
        let at = (raw.get().as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        match serde_json::from_str(raw.get()) {
            Ok(value) => Ok(Element { value, at }),
            Err(error) => Err(fault_of(raw.get(), at, &label(), &error)),
        }
    }
}

/// What the parser of JSON says, at its place in a piece of the text that starts at a byte.
#[cold]
fn fault_of(piece: &str, start: usize, label: &str, error: &serde_json::Error) -> Box<Fault> {
    let before = piece.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum::<usize>();
    let at = (before + error.column().saturating_sub(1)).min(piece.len());
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or_default();
    Fault::new(start + at, format!("{label}: {said}"), EXPECTED)
}
