//! `tracer compare` of two folders: the pictures of the same names, a line each.

use super::compare::{Limit, as_json, picture, print};
use crate::args::CompareArgs;
use crate::compare::{Difference, difference};
use crate::failure::{Failure, exit, why};
use crate::loading::is_picture;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What came of a name.
enum Pair {
    /// Both are there and of one size; which limits it is above.
    Compared(Difference, Vec<&'static str>),
    /// Why there is nothing to compare.
    Not(String),
}

impl Pair {
    fn passes(&self) -> bool {
        matches!(self, Pair::Compared(_, above) if above.is_empty())
    }

    fn verdict(&self) -> String {
        match self {
            Pair::Compared(difference, _) if difference.max == 0.0 => "equal".to_owned(),
            Pair::Compared(_, above) if above.is_empty() => "differs".to_owned(),
            Pair::Compared(_, above) => format!("{} above the limit", above.join(", ")),
            Pair::Not(why) => why.clone(),
        }
    }
}

pub(super) fn run(args: &CompareArgs, limits: &[Limit]) -> Result<ExitCode, Failure> {
    if let Some(path) = &args.output {
        let shown = path.display();
        return Err(Failure::wrong(format!("-o {shown} is for two pictures; of two folders there are many maps")));
    }
    let (a, b) = (pictures(&args.a)?, pictures(&args.b)?);
    if a.is_empty() && b.is_empty() {
        let (a, b) = (args.a.display(), args.b.display());
        return Err(Failure::wrong(format!("there is no picture in {a}, and none in {b}")));
    }
    let names: std::collections::BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    let mut pairs = Vec::new();
    for name in names {
        let pair = match (a.get(name), b.get(name)) {
            (Some(a), Some(b)) => of(a, b, limits)?,
            (Some(_), None) => Pair::Not(format!("is in {} alone", args.a.display())),
            _ => Pair::Not(format!("is in {} alone", args.b.display())),
        };
        pairs.push((name.as_str(), pair));
    }
    print(args, || match args.json {
        true => format!("{:#}\n", json!(pairs.iter().map(|(name, pair)| value(name, pair)).collect::<Vec<_>>())),
        false => table(&pairs),
    })?;
    // As of two pictures: 1 says that all were compared.
    let all_compared = pairs.iter().all(|(_, pair)| matches!(pair, Pair::Compared(..)));
    let passes = pairs.iter().all(|(_, pair)| pair.passes());
    Ok(ExitCode::from(match (all_compared, passes) {
        (false, _) => exit::WRONG,
        (true, false) => exit::FAILED,
        (true, true) => exit::DONE,
    }))
}

/// The pictures of a folder and below by their paths in it; hidden ones are left out.
fn pictures(folder: &Path) -> Result<BTreeMap<String, PathBuf>, Failure> {
    fn list(top: &Path, folder: &Path, found: &mut BTreeMap<String, PathBuf>) -> std::io::Result<()> {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.')) {
                continue;
            }
            if path.is_dir() {
                // A link may lead back to where it stands.
                if !path.is_symlink() {
                    list(top, &path, found)?;
                }
                continue;
            }
            if is_picture(&path) {
                let parts = path.strip_prefix(top).unwrap_or(&path).iter().map(|part| part.to_string_lossy());
                found.insert(parts.collect::<Vec<_>>().join("/"), path);
            }
        }
        Ok(())
    }
    let mut found = BTreeMap::new();
    let unlisted =
        |error: std::io::Error| Failure::could_not(format!("cannot list {}: {}", folder.display(), why(&error)));
    list(folder, folder, &mut found).map_err(unlisted)?;
    Ok(found)
}

fn of(a: &Path, b: &Path, limits: &[Limit]) -> Result<Pair, Failure> {
    let (a, b) = (picture(a)?, picture(b)?);
    Ok(match difference(&a, &b) {
        None => Pair::Not(format!("is {}x{}, and {}x{}", a.width, a.height, b.width, b.height)),
        Some(difference) => {
            let above = limits.iter().filter(|limit| limit.is_exceeded_by(&difference));
            let above = above.map(Limit::name).collect();
            Pair::Compared(difference, above)
        }
    })
}

fn table(pairs: &[(&str, Pair)]) -> String {
    let width = pairs.iter().map(|(name, _)| name.chars().count()).chain([7]).max().unwrap_or(0);
    let mut text =
        format!("{:<width$}  {:>9}  {:>9}  {:>9}  {:>9}\n", "picture", "max", "RMSE", "FLIP mean", "FLIP max");
    for (name, pair) in pairs {
        text += &match pair {
            Pair::Compared(d, _) => format!(
                "{name:<width$}  {:>9.6}  {:>9.6}  {:>9.6}  {:>9.6}  {}\n",
                d.max,
                d.rmse,
                d.flip_mean,
                d.flip_max,
                pair.verdict()
            ),
            Pair::Not(_) => format!("{name:<width$}  {:>42}  {}\n", "", pair.verdict()),
        };
    }
    let equal = pairs.iter().filter(|(_, pair)| pair.verdict() == "equal").count();
    let failed = pairs.iter().filter(|(_, pair)| !pair.passes()).count();
    text + &format!("{} pictures, {equal} equal, {failed} failed\n", pairs.len())
}

fn value(name: &str, pair: &Pair) -> Value {
    let mut value = match pair {
        Pair::Compared(difference, above) => as_json(difference, above),
        Pair::Not(_) => json!({}),
    };
    value["picture"] = name.into();
    value["verdict"] = pair.verdict().into();
    value["passed"] = pair.passes().into();
    value
}
