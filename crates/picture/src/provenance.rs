//! What a picture was made from, for the files that can say it.

/// One setting, as the file shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// `samples`
    pub name: &'static str,
    /// `1000`
    pub value: String,
}

/// What a picture was made from. It goes into PNG, EXR and HDR files, so that a picture found years later can be made
/// again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// The scene file's name, without its folders.
    pub scene_name: String,
    /// The scene file's text.
    pub scene_text: String,
    /// Seed, samples, size and whatever else the picture depends on beside the scene file.
    pub settings: Vec<Setting>,
    /// The same for programs, one line: what it takes to make the picture again. PNG and EXR hold it.
    pub record: String,
    /// Nothing of it is told, nor the program: the file is the picture alone.
    pub is_hidden: bool,
}

impl Provenance {
    /// A picture that tells nothing of itself.
    pub fn hidden() -> Self {
        Provenance { is_hidden: true, ..Provenance::default() }
    }

    /// Longer scene files are named but not put into the picture (256 KiB).
    pub const MAX_SCENE_BYTES: usize = 1 << 18;

    /// Longer records are left out (1 MiB).
    pub const MAX_RECORD_BYTES: usize = 1 << 20;

    /// Keyword and attribute of the record.
    pub const RECORD: &str = "tracer";

    /// Name and version of this program.
    pub const SOFTWARE: &str = concat!("tracer ", env!("CARGO_PKG_VERSION"));

    /// The settings in one line: `seed 0, samples 64`.
    pub fn settings_line(&self) -> String {
        self.settings.iter().map(|s| format!("{} {}", s.name, s.value)).collect::<Vec<_>>().join(", ")
    }

    /// The scene's text, unless there is none or it is too long.
    pub fn embedded_scene(&self) -> Option<&str> {
        let length = self.scene_text.len();
        (length > 0 && length <= Self::MAX_SCENE_BYTES).then_some(&self.scene_text)
    }

    /// The record, unless there is none or it is too long.
    pub fn embedded_record(&self) -> Option<&str> {
        let length = self.record.len();
        (length > 0 && length <= Self::MAX_RECORD_BYTES).then_some(&self.record)
    }
}
