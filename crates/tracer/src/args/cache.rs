//! The words of `--cache`.

use super::bytes;
use clap::Args;
use std::path::PathBuf;

/// What is kept from one run to the next.
#[derive(Clone, Debug, Default, Args)]
pub struct CacheArgs {
    /// Keep meshes that were read and trees that were built in this folder, and take them from there
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Most that the folder may take: 20GiB, 500MB; what was used longest ago goes [default: 10GiB]
    #[arg(long, value_name = "SIZE", value_parser = bytes, requires = "cache")]
    pub cache_size: Option<u64>,
    /// Take nothing for what a file holds but its contents: they are hashed anew
    #[arg(long, requires = "cache")]
    pub cache_verify: bool,
}

impl CacheArgs {
    /// The same as words.
    pub fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        if let Some(folder) = &self.cache {
            words.extend(["--cache".to_owned(), folder.to_string_lossy().into_owned()]);
        }
        words.extend(self.cache_size.iter().flat_map(|bytes| ["--cache-size".to_owned(), format!("{bytes}B")]));
        words.extend(self.cache_verify.then(|| "--cache-verify".to_owned()));
        words
    }
}
