//! The camera, moved by whoever looks, and written into the scene's file.

use crate::shared::{Phase, Pose, Shared, lock};
use scene_format::render::apply_edits;
use scene_format::{Syntax, Viewpoint, write_viewpoint};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// The file's text before and after the camera was written, last of all.
pub type Undo = Option<Written>;

/// A text that was replaced.
pub struct Written {
    path: PathBuf,
    before: String,
    after: String,
}

/// Texts that are longer are not held in memory three times.
const LONGEST: u64 = 256 << 20;

/// Why the file is as it was, in words for the person.
#[derive(Debug)]
pub enum Refused {
    /// As things are it cannot be done.
    Now(String),
    /// The file could not be written.
    Unwritten(String),
}

/// Whether a camera can see: what the reader of scenes asks of one.
pub fn check(pose: &Pose) -> Result<(), &'static str> {
    let Pose { position, look_at, up, fov } = pose;
    // What is further away is none that a person means, and its squares may leave the range of numbers.
    let within = |v: &[f64; 3]| v.iter().all(|x| x.abs() <= 1e12);
    if !(within(position) && within(look_at) && within(up)) {
        return Err("the camera is too far away");
    }
    let towards = [0, 1, 2].map(|axis| look_at[axis] - position[axis]);
    let cross = [0, 1, 2].map(|k| {
        let (a, b) = ((k + 1) % 3, (k + 2) % 3);
        towards[a] * up[b] - towards[b] * up[a]
    });
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (area, sides) = (length(cross), length(towards) * length(*up));
    // Also where one of the two has no length.
    if !(area > 1e-6 * sides && sides > 0.0) {
        return Err("the camera looks along `up`, or nowhere");
    }
    if *fov > 0.0 && *fov < 180.0 { Ok(()) } else { Err("the field of view is between 0 and 180 degrees") }
}

/// Six digits of what the camera sees are more than can be told apart, and can be read.
fn rounded(pose: &Pose) -> Viewpoint {
    let distance = (0..3).map(|axis| (pose.look_at[axis] - pose.position[axis]).powi(2)).sum::<f64>().sqrt();
    let step = |size: f64| format!("1e{}", exponent(size) - 5).parse::<f64>().unwrap_or(0.0);
    let to = |step: f64, x: f64| if step > 0.0 { tidy((x / step).round(), step) } else { x };
    let (step_of_place, step_of_up) = (step(distance), step(1.0));
    Viewpoint {
        position: pose.position.map(|x| to(step_of_place, x)),
        look_at: pose.look_at.map(|x| to(step_of_place, x)),
        up: pose.up.map(|x| to(step_of_up, x)),
        fov: to(1e-3, pose.fov),
    }
}

/// The power of ten of a number's first digit.
fn exponent(size: f64) -> i32 {
    let written = format!("{size:e}");
    written.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// So many steps as the number that is written shortest: 0.3, not 0.30000000000000004.
fn tidy(count: f64, step: f64) -> f64 {
    let decimals = usize::try_from(-exponent(step)).unwrap_or(0);
    // Minus zero is zero.
    format!("{:.decimals$}", count * step).parse::<f64>().map_or(count * step, |x| x + 0.0)
}

/// Writes a camera, or the one that is seen, into the scene's file; how many places of it were changed.
pub fn write(shared: &Shared, undo: &Mutex<Undo>, pose: Option<Pose>) -> Result<usize, Refused> {
    let now = |why: &str| Refused::Now(why.to_owned());
    let set = shared.options.overrides.iter().find(|set| set.argument.trim_start().starts_with("camera"));
    if let Some(set) = set {
        return Err(Refused::Now(format!(
            "the camera is set by {}, which counts more than the file; start the preview without it",
            set.option
        )));
    }
    let seen = {
        let state = shared.state();
        if state.phase == Phase::Wrong {
            return Err(now("the scene has errors; mend them first"));
        }
        state.stage.as_ref().map(|stage| Pose::of(&stage.desc)).ok_or_else(|| now("there is no picture yet"))?
    };
    let path = shared.options.scene.clone();
    let before = text(&path)?;
    let syntax = shared.options.syntax.or(Syntax::from_path(&path)).unwrap_or_else(|| Syntax::guess(&before));
    let folder = path.parent().unwrap_or(Path::new(""));
    let pose = rounded(&pose.unwrap_or(seen));
    let edits = write_viewpoint(&before, syntax, folder, &pose).map_err(|why| now(&why.to_string()))?;
    if edits.is_empty() {
        return Ok(0);
    }
    let after = apply_edits(&before, &edits);
    save(shared, &path, &after)?;
    *lock(undo) = Some(Written { path, before, after });
    shared.change(|_| {});
    Ok(edits.len())
}

/// Puts back what stood in the file before the camera was written.
pub fn undo(shared: &Shared, undo: &Mutex<Undo>) -> Result<(), Refused> {
    let mut undo = lock(undo);
    let Some(written) = &*undo else {
        return Err(Refused::Now("nothing was written that could be taken back".to_owned()));
    };
    if text(&written.path)? != written.after {
        return Err(Refused::Now("the file was changed since; undo it in your editor".to_owned()));
    }
    save(shared, &written.path, &written.before)?;
    *undo = None;
    drop(undo);
    shared.change(|_| {});
    Ok(())
}

fn text(path: &Path) -> Result<String, Refused> {
    let unread = |error| Refused::Now(format!("cannot read the scene: {error}"));
    if std::fs::metadata(path).map_err(unread)?.len() > LONGEST {
        return Err(Refused::Now("the file is too large to be written from here".to_owned()));
    }
    std::fs::read_to_string(path).map_err(unread)
}

fn save(shared: &Shared, path: &Path, text: &str) -> Result<(), Refused> {
    shared.host.save(path, text.as_bytes()).map_err(Refused::Unwritten)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_can_be_read() {
        let pose = Pose {
            position: [0.1 + 0.2, -12.345_678_9, 1e-9],
            look_at: [0.0, 0.0, 0.0],
            up: [0.0, 1.0, -1e-9],
            fov: 40.000_01,
        };
        let viewpoint = rounded(&pose);
        assert_eq!(viewpoint.position, [0.3, -12.3457, 0.0]);
        assert_eq!((viewpoint.up, viewpoint.fov), ([0.0, 1.0, 0.0], 40.0));
        let far = rounded(&Pose { position: [1_234_567.8, 0.0, 0.0], ..pose });
        assert_eq!(far.position, [1_234_570.0, 0.0, 0.0]);
    }

    #[test]
    fn cameras_that_see_nothing_are_refused() {
        let good = Pose { position: [0.0, 0.0, 5.0], look_at: [0.0; 3], up: [0.0, 1.0, 0.0], fov: 40.0 };
        assert_eq!(check(&good), Ok(()));
        for bad in [
            Pose { position: [0.0; 3], ..good },
            Pose { position: [0.0, 5.0, 0.0], ..good },
            Pose { up: [0.0; 3], ..good },
            Pose { position: [f64::NAN, 0.0, 5.0], ..good },
            Pose { position: [1e300, 0.0, 5.0], ..good },
            Pose { fov: 180.0, ..good },
            Pose { fov: f64::NAN, ..good },
        ] {
            assert!(check(&bad).is_err(), "{bad:?}");
        }
    }
}
