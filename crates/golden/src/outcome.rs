//! What came of a scene.

use crate::noise::Finding;
use crate::picture::Rgb8;
use std::path::PathBuf;

/// Whether the picture is the expected one.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Pixel by pixel.
    Equal,
    /// Its bytes are others, and it differs by noise alone.
    WithinNoise {
        /// The least probability of all tests, were the picture the same.
        probability: f64,
    },
    /// Its bytes are others, and the folder says that so little is allowed.
    WithinFlip {
        /// The most that is allowed as mean of FLIP.
        limit: f64,
    },
    /// It is another picture.
    Different {
        /// In a sentence.
        why: String,
        /// What the test of noise found.
        findings: Vec<Finding>,
    },
    /// No picture is expected yet.
    Missing,
    /// A picture is expected, and there is no scene.
    Orphan,
    /// There is no picture: the scene is wrong, a file cannot be read.
    Wrong {
        /// What is wrong, in lines.
        what: String,
    },
}

impl Verdict {
    /// Whether the picture is as it should be.
    pub fn passes(&self) -> bool {
        matches!(self, Verdict::Equal | Verdict::WithinNoise { .. } | Verdict::WithinFlip { .. })
    }

    /// In a word, for programs.
    pub fn word(&self) -> &'static str {
        match self {
            Verdict::Equal => "equal",
            Verdict::WithinNoise { .. } => "within_noise",
            Verdict::WithinFlip { .. } => "within_flip",
            Verdict::Different { .. } => "different",
            Verdict::Missing => "missing",
            Verdict::Orphan => "orphan",
            Verdict::Wrong { .. } => "wrong",
        }
    }
}

/// How different the eye finds two pictures (Andersson et al. 2020).
#[derive(Clone, Debug, PartialEq)]
pub struct Flip {
    /// Mean over the pixels, 0 to 1.
    pub mean: f64,
    /// The largest.
    pub max: f64,
    /// In false colours.
    pub map: Rgb8,
}

/// What came of one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The folder, as it was named.
    pub folder: String,
    /// The scene's name in it.
    pub name: String,
    /// The file that is to be looked at: the scene, or the picture without one.
    pub file: PathBuf,
    /// The text of the scene, where it could be read.
    pub scene: String,
    /// Whether it is as it should be.
    pub verdict: Verdict,
    /// Seconds of rendering and comparing.
    pub seconds: f64,
    /// The expected picture, if there is one.
    pub expected: Option<Rgb8>,
    /// What was made.
    pub actual: Option<Rgb8>,
    /// Where both are there and of one size.
    pub flip: Option<Flip>,
}

impl Outcome {
    /// In a sentence, what came of it.
    pub fn sentence(&self) -> String {
        let flip = self
            .flip
            .as_ref()
            .map_or(String::new(), |flip| format!("; FLIP mean {:.4}, max {:.4}", flip.mean, flip.max));
        match &self.verdict {
            Verdict::Equal => "equal".to_owned(),
            Verdict::WithinNoise { probability } => {
                let rarity = if *probability >= 1.0 {
                    "no test near its limit".to_owned()
                } else {
                    format!("p = {probability:.2}")
                };
                format!("other bytes, within the noise of both pictures ({rarity}){flip}")
            }
            Verdict::WithinFlip { limit } => format!("other bytes, within flip = {limit}{flip}"),
            Verdict::Different { why, findings } => {
                let told: String = findings.iter().map(|finding| format!("; {}", finding.what)).collect();
                format!("{why}{told}{flip}")
            }
            Verdict::Missing => "there is no expected picture".to_owned(),
            Verdict::Orphan => {
                "this picture belongs to no scene: remove it, bring the scene back, or name its folder in \
                                `skip` of golden.toml"
                    .to_owned()
            }
            Verdict::Wrong { what } => what.lines().next().unwrap_or("there is no picture").to_owned(),
        }
    }
}

/// A command line that accepts what was made.
pub fn accept_command(folder: &str, name: &str) -> String {
    let plain = |word: &str| word.chars().all(|c| c.is_alphanumeric() || "/._-:\\".contains(c)) && !word.is_empty();
    let quoted = |word: &str| if plain(word) { word.to_owned() } else { format!("'{}'", word.replace('\'', "'\\''")) };
    format!("tracer golden accept {} {} --reason \"why it changed\"", quoted(folder), quoted(name))
}
