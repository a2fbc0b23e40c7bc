//! `--denoise`, as `tracer render` and `tracer merge` have it.

use clap::Args;

/// Whether the picture is denoised.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct DenoiseArgs {
    /// Take the noise out of the picture: on, off, or oidn, which is Open Image Denoise where the machine has it
    /// (TRACER_OIDN names its file or folder) [default: off; alone: on]
    #[arg(long, value_name = "WHAT", num_args = 0..=1, default_missing_value = "on", value_parser = what)]
    #[arg(help = "Take the noise out of the picture: on, off or oidn")]
    pub denoise: Option<DenoiseName>,
}

/// How a picture is denoised, by the words of the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DenoiseName {
    /// It is not.
    Off,
    /// By what is built in.
    On,
    /// By Open Image Denoise.
    Oidn,
}

impl DenoiseName {
    /// The word.
    pub fn name(self) -> &'static str {
        match self {
            DenoiseName::Off => "off",
            DenoiseName::On => "on",
            DenoiseName::Oidn => "oidn",
        }
    }

    /// Of its word.
    pub fn by_name(word: &str) -> Option<Self> {
        [DenoiseName::Off, DenoiseName::On, DenoiseName::Oidn].into_iter().find(|of| of.name() == word)
    }

    /// Whether it is denoised at all.
    pub fn is_on(self) -> bool {
        self != DenoiseName::Off
    }
}

impl DenoiseArgs {
    /// How.
    pub fn how(self) -> DenoiseName {
        self.denoise.unwrap_or(DenoiseName::Off)
    }

    /// Whether it is.
    pub fn is_on(self) -> bool {
        self.how().is_on()
    }

    /// The words of a command line that says the same.
    pub fn words(self) -> Option<String> {
        self.is_on().then(|| format!("--denoise={}", self.how().name()))
    }
}

fn what(text: &str) -> Result<DenoiseName, String> {
    DenoiseName::by_name(text)
        .ok_or_else(|| "expected on, off or oidn; before the name of a file write --denoise=on".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_on_or_off_or_by_a_library() {
        let all = [DenoiseName::Off, DenoiseName::On, DenoiseName::Oidn];
        assert_eq!(["off", "on", "oidn"].map(what), all.map(Ok));
        for bad in ["", "OIDN", "scene.ron", "On", "1"] {
            assert!(what(bad).is_err(), "{bad}");
        }
        let words = |denoise| DenoiseArgs { denoise }.words();
        assert_eq!([words(None), words(Some(DenoiseName::Off))], [None, None]);
        assert_eq!(words(Some(DenoiseName::Oidn)).as_deref(), Some("--denoise=oidn"));
    }
}
