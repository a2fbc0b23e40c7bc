//! The words of `tracer preview`.

use super::{CacheArgs, Size, SyntaxName, count, overrides, size};
use clap::{Args, ValueEnum};
use scene_format::Override;
use std::net::IpAddr;
use std::path::PathBuf;

const PREVIEW_EXAMPLES: &str = "\
Examples:
  tracer preview scenes/fig4.ron --open --editor code
  tracer preview --terminal scenes/fig4.ron

Prints the address of the page; docs/preview.md tells the rest.";

/// How a picture is drawn in a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TerminalName {
    /// As well as the terminal can.
    Auto,
    /// kitty's graphics.
    Kitty,
    /// iTerm2's inline images.
    Iterm,
    /// Sixel.
    Sixel,
    /// Half blocks.
    Blocks,
}

/// `tracer preview`
#[derive(Debug, Args)]
#[command(after_help = PREVIEW_EXAMPLES)]
pub struct PreviewArgs {
    /// Scene file (.ron, .toml, .json)
    pub scene: PathBuf,
    /// Open the page in the browser
    #[arg(long)]
    pub open: bool,
    /// Draw in the terminal, as well as it can or as told: kitty, iterm, sixel, blocks
    #[arg(long, value_enum, value_name = "HOW", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "auto", hide_possible_values = true)]
    #[arg(conflicts_with_all = ["open", "port", "address", "editor"])]
    #[arg(help = "Draw in the terminal [kitty, iterm, sixel, blocks]")]
    pub terminal: Option<TerminalName>,
    /// Port [default: one that is free]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::whole::<u16>, allow_negative_numbers = true)]
    pub port: u16,
    /// Address to listen at [default: 127.0.0.1, this computer alone]
    #[arg(long, value_name = "IP", default_value = "127.0.0.1", hide_default_value = true)]
    #[arg(help = "Listen at this address [default: 127.0.0.1]")]
    pub address: IpAddr,
    /// Command that opens a file at a line: code, or \"vi +{line} {file}\" [default: that of TRACER_EDITOR, VISUAL or
    /// EDITOR]
    #[arg(long, value_name = "COMMAND", help = "Opens the lines of errors: code, \"ed +{line} {file}\"")]
    pub editor: Option<String>,
    /// Set a field of the scene: camera.fov=40 (repeatable)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Use this one of the scene's `cameras`
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Frame of the scene's `animation`, from 0
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = super::frame)]
    pub frame: Option<u32>,
    /// Syntax of the scene [default: by its name]
    #[arg(long, value_enum, value_name = "SYNTAX", hide_possible_values = true)]
    #[arg(help = "Syntax: ron, toml, json [default: by its name]")]
    pub syntax: Option<SyntaxName>,
    /// Samples per pixel
    #[arg(short, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub samples: Option<u32>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub cache: CacheArgs,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

impl PreviewArgs {
    /// The fields to set.
    pub fn overrides(&self) -> Vec<Override> {
        overrides(&self.set, self.camera.as_deref(), self.frame)
    }
}
