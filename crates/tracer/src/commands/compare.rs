//! `tracer compare`: how two pictures differ, in numbers and in false colours.

use super::compare_folders;
use crate::args::CompareArgs;
use crate::compare::{Difference, Kind, Metric, Picture, difference, false_colours};
use crate::failure::{Failure, exit};
use crate::loading::{is_picture, nearby};
use crate::write::{Bits, Encoding, OutputKind, Place, Provenance, is_one_file, probe, spare_other, write};
use serde_json::json;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

pub(super) fn run(args: &CompareArgs) -> Result<ExitCode, Failure> {
    let limits = args.fail_above.iter().map(|text| limit(text)).collect::<Result<Vec<Limit>, Failure>>()?;
    if args.a.is_dir() && args.b.is_dir() {
        return compare_folders::run(args, &limits);
    }
    if let Some(path) = &args.output {
        if !matches!(Encoding::from_path(path, Bits::Eight), Ok(Encoding::Png(_))) {
            return Err(Failure::wrong(format!("-o {}: the map is a PNG; name it .png", path.display())));
        }
        if let Some(input) = [&args.a, &args.b].into_iter().find(|input| is_one_file(path, input)) {
            let shown = path.display();
            let also = if path == input { String::new() } else { format!(" ({})", input.display()) };
            return Err(Failure::wrong(format!(
                "-o {shown} would replace a picture that is compared{also}; name another file"
            )));
        }
        probe(path)?;
        spare_other(path, OutputKind::Picture)?;
    }
    let (a, b) = (picture(&args.a)?, picture(&args.b)?);
    let Some(difference) = difference(&a, &b) else {
        return Err(Failure::wrong(format!(
            "{} has {}x{} pixels and {} has {}x{}: only pictures of one size can be compared",
            args.a.display(),
            a.width,
            a.height,
            args.b.display(),
            b.width,
            b.height
        )));
    };
    if let Some(path) = &args.output {
        let map = false_colours(&difference.flip_map, a.width, a.height);
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let scene_name = format!("FLIP of {} against {}", name(&args.a), name(&args.b));
        let provenance = Provenance { scene_name, ..Provenance::default() };
        write(&map, Encoding::Png(Bits::Eight), &Place::File(path.clone()), &provenance)?;
    }
    let above: Vec<&Limit> = limits.iter().filter(|limit| limit.is_exceeded_by(&difference)).collect();
    print(args, || match args.json {
        true => format!("{:#}\n", as_json(&difference, &above.iter().map(|limit| limit.name()).collect::<Vec<_>>())),
        false => as_text(&difference, &above),
    })?;
    Ok(ExitCode::from(if above.is_empty() { exit::DONE } else { exit::FAILED }))
}

/// Prints what came of it, unless nothing is to be printed.
pub(super) fn print(args: &CompareArgs, text: impl FnOnce() -> String) -> std::io::Result<()> {
    if args.quiet {
        return Ok(());
    }
    let mut out = std::io::stdout().lock();
    out.write_all(text().as_bytes())?;
    out.flush()
}

/// What `--fail-above` says.
pub(super) struct Limit {
    metric: Metric,
    most: f64,
}

impl Limit {
    pub(super) fn is_exceeded_by(&self, difference: &Difference) -> bool {
        self.metric.of(difference) > self.most
    }

    pub(super) fn name(&self) -> &'static str {
        self.metric.name()
    }
}

fn limit(text: &str) -> Result<Limit, Failure> {
    let names = Metric::ALL.map(Metric::name).join(", ");
    let wrong = |what: &str| {
        Failure::wrong(format!(
            "--fail-above {text}: {what}; expected METRIC=LIMIT with one of {names}, as in flip-mean=0.01"
        ))
    };
    let (name, most) = text.split_once('=').ok_or_else(|| wrong("there is no `=`"))?;
    let metric = Metric::ALL.into_iter().find(|metric| metric.name().eq_ignore_ascii_case(name.trim()));
    let metric = metric.ok_or_else(|| wrong(&format!("there is no metric `{name}`")))?;
    let most = most.trim().parse().ok().filter(|most: &f64| *most >= 0.0);
    Ok(Limit { metric, most: most.ok_or_else(|| wrong("the limit is no number from 0"))? })
}

/// Whatever is wrong with a picture ends with 2: 1 says that both were compared.
pub(super) fn picture(path: &Path) -> Result<Picture, Failure> {
    let shown = path.display();
    if path.is_dir() {
        return Err(Failure::wrong(format!(
            "cannot read {shown}: it is a folder; name a picture in it, or two folders"
        )));
    }
    if !path.exists() {
        let tip = nearby(path, is_picture).map_or(String::new(), |near| format!("; did you mean {near}?"));
        return Err(Failure::wrong(format!("there is no picture {shown}{tip}")));
    }
    Picture::load(path).map_err(|error| Failure::Wrong(error.into()))
}

fn kind(difference: &Difference) -> &'static str {
    match difference.kind {
        Kind::Linear => "linear radiance",
        Kind::Display => "display values",
    }
}

fn as_text(d: &Difference, above: &[&Limit]) -> String {
    let psnr = if d.psnr.is_finite() { format!("{:.2} dB", d.psnr) } else { "infinite".to_owned() };
    let mut text = format!(
        "compared   {}\nmax        {:.6} at ({}, {})\nRMSE       {:.6}\nrelMSE     {:.6}\nPSNR       {psnr}\n\
         FLIP mean  {:.6}\nFLIP max   {:.6}\n",
        kind(d),
        d.max,
        d.max_at.x,
        d.max_at.y,
        d.rmse,
        d.relmse,
        d.flip_mean,
        d.flip_max,
    );
    for limit in above {
        text += &format!("{} is above {}\n", limit.metric.name(), limit.most);
    }
    text
}

pub(super) fn as_json(d: &Difference, above: &[&str]) -> serde_json::Value {
    json!({
        "compared": kind(d),
        "max": d.max,
        "max_at": d.max_at,
        "rmse": d.rmse,
        "relmse": d.relmse,
        // Infinite for equal pictures, which JSON has no word for.
        "psnr": d.psnr.is_finite().then_some(d.psnr),
        "flip_mean": d.flip_mean,
        "flip_max": d.flip_max,
        "above": above,
    })
}
