//! The words of `tracer inspect`.

use super::SceneArgs;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const INSPECT_EXAMPLES: &str = "\
Examples:
  tracer inspect scenes/fig4.ron --pixel 256,300
  tracer inspect room.ron --pixel 40,60 --sample 3 --svg path.svg
docs/teaching.md explains it.";

/// `tracer inspect`
#[derive(Debug, Args)]
#[command(after_help = INSPECT_EXAMPLES)]
pub struct InspectArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneArgs,
    /// Pixel: column and row
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub pixel: [u32; 2],
    /// Which of its samples, from 0
    #[arg(long, value_name = "K", default_value_t = 0, hide_default_value = true)]
    #[arg(allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(..1_000_000_000))]
    pub sample: u32,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = super::size)]
    pub size: Option<super::Size>,
    /// Seed of all random choices
    #[arg(long, value_name = "N", value_parser = super::whole::<u32>, allow_negative_numbers = true)]
    pub seed: Option<u32>,
    /// Draw the path from above and from the side
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// How to print it: text or json
    #[arg(long, value_enum, value_name = "FORM", default_value_t = InspectForm::Text)]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub format: InspectForm,
}

/// How `tracer inspect` prints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum InspectForm {
    /// For people.
    #[default]
    Text,
    /// For programs.
    Json,
}

/// A pixel: 12,34.
fn pixel(text: &str) -> Result<[u32; 2], String> {
    let expected = || "expected column and row, counted from 0 at the upper left, as in 120,80".to_owned();
    let (x, y) = text.split_once(',').ok_or_else(expected)?;
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| expected());
    Ok([number(x)?, number(y)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_read() {
        assert_eq!((pixel("12,34"), pixel("0, 7")), (Ok([12, 34]), Ok([0, 7])));
        for bad in ["", "1", "1,2,3", "-1,2", "1.5,2", "a,b", "1x2"] {
            assert!(pixel(bad).is_err(), "{bad}");
        }
    }
}
