//! `--denoise`, as `tracer render` and `tracer merge` have it.

use clap::Args;

/// Whether the picture is denoised.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct DenoiseArgs {
    /// Take the noise out of the picture: on or off [default: off; alone: on]
    #[arg(long, value_name = "WHAT", num_args = 0..=1, default_missing_value = "on", value_parser = switch)]
    #[arg(help = "Take the noise out of the picture, its errors told")]
    pub denoise: Option<bool>,
}

impl DenoiseArgs {
    /// Whether it is.
    pub fn is_on(self) -> bool {
        self.denoise == Some(true)
    }

    /// The words of a command line that says the same.
    pub fn words(self) -> Option<String> {
        self.is_on().then(|| "--denoise=on".to_owned())
    }
}

fn switch(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        "oidn" => {
            Err("Open Image Denoise cannot be used yet; --denoise alone is the denoiser that is built in".to_owned())
        }
        _ => Err("expected on or off; before the name of a file write --denoise=on".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_on_or_off() {
        assert_eq!((switch("on"), switch("off")), (Ok(true), Ok(false)));
        for bad in ["", "oidn", "scene.ron", "On", "1"] {
            assert!(switch(bad).is_err(), "{bad}");
        }
    }
}
