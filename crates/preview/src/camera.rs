//! The camera, moved by whoever looks, and written into the scene's file.

use crate::files::fingerprint;
use crate::shared::{Phase, Pose, Shared, lock};
use scene_format::diagnostic::Edit;
use scene_format::render::apply_edits;
use scene_format::{Override, Syntax, Viewpoint, write_viewpoint};
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

/// What was written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// Places of the text that were changed.
    pub edits: usize,
    /// Those of them that were expressions, and are numbers now.
    pub expressions: usize,
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
    let Pose { position, look_at, up, fov, focal_length, height } = pose;
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
    let is_length = |length: &Option<f64>| length.is_none_or(|x| (1e-12..=1e12).contains(&x));
    if !fov.is_none_or(|fov| fov > 0.0 && fov < 180.0) {
        return Err("the field of view is between 0 and 180 degrees");
    }
    if !is_length(focal_length) {
        return Err("the focal length is a length above zero, in millimetres");
    }
    if !is_length(height) {
        return Err("the height of the projection is a length above zero");
    }
    Ok(())
}

/// Why the camera is not moved: how much it sees is said by another field than the scene's camera goes by.
fn misfit(moves: &Viewpoint, written: &Pose) -> Option<String> {
    let known = [("fov", written.fov), ("focal_length", written.focal_length), ("height", written.height)];
    let asked = [moves.fov, moves.focal_length, moves.height];
    let (name, _) = known.into_iter().zip(asked).find(|((_, known), asked)| asked.is_some() && known.is_none())?.0;
    let goes_by = known.into_iter().find(|(_, known)| known.is_some());
    Some(match goes_by {
        Some((by, _)) => format!("this camera goes by its `{by}`, not by `{name}`; change that"),
        None => "the projection of this camera cannot be zoomed here; write its values by hand".to_owned(),
    })
}

/// Moves the camera, not in the file: by what a pose says otherwise than the one that it was made of, which is the
/// file's where none is named.
///
/// # Errors
/// Why it cannot stand so, in words for the person.
pub fn moved(shared: &Shared, pose: &Pose, from: Option<&Pose>) -> Result<(), String> {
    check(pose)?;
    let written = shared.state().written.ok_or("there is no picture yet")?;
    let moves = pose.changes(from.unwrap_or(&written));
    if let Some(why) = misfit(&moves, &written) {
        return Err(why);
    }
    // Together with what the file has by now.
    check(&written.moved(&moves))?;
    shared.move_camera(moves);
    Ok(())
}

/// Six digits of what the camera sees are more than can be told apart, and can be read. `pose`: the whole camera.
fn rounded(moves: &Viewpoint, pose: &Pose) -> Viewpoint {
    let distance = (0..3).map(|axis| (pose.look_at[axis] - pose.position[axis]).powi(2)).sum::<f64>().sqrt();
    let step = |size: f64| format!("1e{}", exponent(size) - 5).parse::<f64>().unwrap_or(0.0);
    let to = |step: f64, x: f64| if step > 0.0 { tidy((x / step).round(), step) } else { x };
    let (step_of_place, step_of_up) = (step(distance), step(1.0));
    Viewpoint {
        position: moves.position.map(|v| v.map(|x| to(step_of_place, x))),
        look_at: moves.look_at.map(|v| v.map(|x| to(step_of_place, x))),
        up: moves.up.map(|v| v.map(|x| to(step_of_up, x))),
        fov: moves.fov.map(|fov| to(1e-3, fov)),
        focal_length: moves.focal_length.map(|length| to(step(length), length)),
        height: moves.height.map(|height| to(step(height), height)),
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

/// What an option has set of what would be written: there the file does not count. Where nothing would be written, of
/// all that could be.
fn set_by_option(overrides: &[Override], moves: &Viewpoint) -> Option<String> {
    let place = moves.position.is_some() || moves.look_at.is_some() || moves.up.is_some();
    let zoom = moves.fov.is_some() || moves.focal_length.is_some() || moves.height.is_some();
    let none = moves.is_empty();
    let set = overrides.iter().find_map(|set| {
        let path = set.argument.split('=').next().unwrap_or_default().trim();
        let mut steps = path.split(['.', '[']).map(str::trim);
        let counts = match (steps.next(), steps.next()) {
            (Some("cameras"), _) | (Some("camera"), None) => true,
            (Some("camera"), Some(field)) => match field {
                "position" => none || moves.position.is_some(),
                "look_at" => none || moves.look_at.is_some(),
                "up" => none || moves.up.is_some(),
                "matrix" => none || place,
                "fov" | "fov_axis" | "focal_length" | "sensor_width" | "projection" => none || zoom,
                _ => false,
            },
            _ => false,
        };
        counts.then_some((path, set.option))
    });
    let (path, option) = set?;
    // `--camera above` has no path that a person has written.
    let what = if path == "camera" { "the camera".to_owned() } else { format!("`{path}`") };
    Some(format!("{what} is set by {option}, which counts more than the file; start the preview without it"))
}

/// Writes what was changed of the camera into the scene's file, and nothing else of it.
pub fn write(shared: &Shared, undo: &Mutex<Undo>) -> Result<Outcome, Refused> {
    let now = |why: &str| Refused::Now(why.to_owned());
    // An editor that saves meanwhile must not lose what it has saved.
    let saved = || now("the file was saved meanwhile, and this is not its picture yet; write again when it is");
    let (moves, written, read) = {
        let state = shared.state();
        if state.phase == Phase::Wrong {
            return Err(now("the scene has errors; mend them first"));
        }
        let written = state.written.filter(|_| state.stage.is_some()).ok_or_else(|| now("there is no picture yet"))?;
        (state.moves, written, state.read)
    };
    if let Some(why) = set_by_option(&shared.options.overrides, &moves) {
        return Err(Refused::Now(why));
    }
    let path = shared.options.scene.clone();
    let before = text(&path)?;
    if read != Some(fingerprint(before.as_bytes())) {
        return Err(saved());
    }
    let syntax = shared.options.syntax.or(Syntax::from_path(&path)).unwrap_or_else(|| Syntax::guess(&before));
    let folder = path.parent().unwrap_or(Path::new(""));
    let viewpoint = rounded(&moves, &written.moved(&moves));
    let edits = write_viewpoint(&before, syntax, folder, &viewpoint).map_err(|why| now(&why.to_string()))?;
    if edits.is_empty() {
        return Ok(Outcome::default());
    }
    let after = apply_edits(&before, &edits);
    if text(&path)? != before {
        return Err(saved());
    }
    save(shared, &path, &after)?;
    let expressions = edits.iter().filter(|edit| was_expression(&before, edit)).count();
    *lock(undo) = Some(Written { path, before, after });
    shared.change(|_| {});
    Ok(Outcome { edits: edits.len(), expressions })
}

/// Whether what is replaced is or has an expression.
fn was_expression(text: &str, edit: &Edit) -> bool {
    let replaced = text.get(edit.span.start as usize..edit.span.end as usize).unwrap_or_default();
    replaced.split(['"', '\'']).skip(1).any(|inner| inner.trim_start().starts_with('='))
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
    let file = std::fs::metadata(path).map_err(unread)?;
    if !file.is_file() {
        return Err(Refused::Now("the scene is no regular file".to_owned()));
    }
    if file.len() > LONGEST {
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

    const POSE: Pose = Pose {
        position: [0.0, 0.0, 5.0],
        look_at: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        fov: Some(40.0),
        focal_length: None,
        height: None,
    };

    #[test]
    fn what_is_written_can_be_read() {
        let pose =
            Pose { position: [0.1 + 0.2, -12.345_678_9, 1e-9], up: [0.0, 1.0, -1e-9], fov: Some(40.000_01), ..POSE };
        let all =
            |pose: Pose| rounded(&pose.changes(&Pose { position: [9.0; 3], up: [9.0; 3], fov: None, ..pose }), &pose);
        let viewpoint = all(pose);
        assert_eq!(viewpoint.position, Some([0.3, -12.3457, 0.0]));
        assert_eq!((viewpoint.up, viewpoint.fov), (Some([0.0, 1.0, 0.0]), Some(40.0)));
        assert_eq!((viewpoint.look_at, viewpoint.focal_length, viewpoint.height), (None, None, None), "as they were");
        assert_eq!(all(Pose { position: [1_234_567.8, 0.0, 0.0], ..pose }).position, Some([1_234_570.0, 0.0, 0.0]));
        let wide =
            Viewpoint { focal_length: Some(35.123_456_7), height: Some(0.001_234_567_8), ..Viewpoint::default() };
        let wide = rounded(&wide, &POSE);
        assert_eq!((wide.focal_length, wide.height), (Some(35.1235), Some(0.001_234_57)));
    }

    #[test]
    fn cameras_that_see_nothing_are_refused() {
        assert_eq!(check(&POSE), Ok(()));
        for bad in [
            Pose { position: [0.0; 3], ..POSE },
            Pose { position: [0.0, 5.0, 0.0], ..POSE },
            Pose { up: [0.0; 3], ..POSE },
            Pose { position: [f64::NAN, 0.0, 5.0], ..POSE },
            Pose { position: [1e300, 0.0, 5.0], ..POSE },
            Pose { fov: Some(180.0), ..POSE },
            Pose { fov: Some(f64::NAN), ..POSE },
            Pose { fov: None, focal_length: Some(0.0), ..POSE },
            Pose { fov: None, focal_length: Some(f64::NAN), ..POSE },
            Pose { fov: None, height: Some(-1.0), ..POSE },
            Pose { fov: None, height: Some(1e13), ..POSE },
        ] {
            assert!(check(&bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn what_an_option_sets_is_not_written() {
        let none = Viewpoint::default();
        let place = Viewpoint { position: Some([1.0; 3]), ..none };
        let zoom = Viewpoint { focal_length: Some(50.0), ..none };
        for (set, moves, is_set) in [
            (Override::camera("above"), &place, true),
            (" camera . fov = 30".into(), &zoom, true),
            ("camera.focal_length=30".into(), &zoom, true),
            ("camera.focal_length=30".into(), &place, false),
            ("camera.position[0]=30".into(), &place, true),
            ("camera.position.x=30".into(), &zoom, false),
            ("camera.near=3".into(), &none, false),
            ("camera.up=(0, 0, 1)".into(), &none, true),
            ("cameras.above.fov=3".into(), &place, true),
            ("vars.camera=3".into(), &place, false),
        ] {
            let found = set_by_option(std::slice::from_ref(&set), moves);
            assert_eq!(found.is_some(), is_set, "{set:?}: {found:?}");
        }
    }

    #[test]
    fn expressions_are_told_from_texts() {
        let is = |text: &str| {
            let span = scene_format::diagnostic::Span { source: 0, start: 0, end: text.len() as u32 };
            was_expression(text, &Edit { span, replacement: String::new() })
        };
        assert!(is("\"=a\"") && is("(0, \"= a * 2\", 1)") && is("'=a'") && !is("(0, 1, 2)") && !is(""));
    }
}
