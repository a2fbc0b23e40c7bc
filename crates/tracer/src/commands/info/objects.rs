//! Where the objects and lights of a scene are, one by one.

use super::short;
use scene_format::SceneDesc;
use serde_json::json;
use tracer_core::{Scene, SeenAt, Whereabouts, object_name, whereabouts};

/// So many names at most stand in one line.
const NAMED: usize = 6;

/// As a table, a line for each.
pub(super) fn as_text(scene: &Scene, desc: &SceneDesc) -> String {
    let all = whereabouts(scene);
    let rows: Vec<[String; 4]> = all
        .iter()
        .enumerate()
        .map(|(number, of)| {
            let place = match of.bounds {
                Some(corners) => {
                    // What is a rounding error of the others is none.
                    let most = corners.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
                    let [low, high] = corners.map(|p| p.map(|x| if x.abs() < 1e-6 * most { 0.0 } else { x }));
                    format!("{} to {}", point(low), point(high))
                }
                None if of.copies == 0 => "nowhere".to_owned(),
                None => "without an end".to_owned(),
            };
            let copies = if of.copies == 1 { String::new() } else { format!("x{}", of.copies) };
            [object_name(desc, number), copies, place, seen(of)]
        })
        .collect();
    let widths = [0, 1, 2].map(|column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let mut text = String::new();
    for [name, copies, place, seen] in &rows {
        let line = format!("{name:<0$}  {copies:<1$}  {place:<2$}  {seen}", widths[0], widths[1], widths[2]);
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// As JSON, an entry for each.
pub(super) fn as_json(scene: &Scene, desc: &SceneDesc) -> serde_json::Value {
    let all = whereabouts(scene);
    let entry = |(number, of): (usize, &Whereabouts)| {
        json!({
            "object": object_name(desc, number),
            "copies": of.copies,
            "bounds": of.bounds.map(|[min, max]| json!({ "min": min, "max": max })),
            "seen": match of.seen {
                SeenAt::Pixels([left, top, right, bottom]) => {
                    json!({ "left": left, "top": top, "right": right, "bottom": bottom })
                }
                SeenAt::Middle([x, y]) => json!({ "middle": [x, y] }),
                SeenAt::Around => json!("around"),
                SeenAt::Behind => json!("behind"),
                SeenAt::Left => json!("left"),
                SeenAt::Right => json!("right"),
                SeenAt::Above => json!("above"),
                SeenAt::Below => json!("below"),
                SeenAt::Nowhere => json!("nowhere"),
            },
        })
    };
    all.iter().enumerate().map(entry).collect()
}

/// The objects that are not in view, in a few words; `None`: all are. Lights rarely are.
pub(super) fn not_in_view(scene: &Scene, desc: &SceneDesc) -> Option<String> {
    let all = whereabouts(scene);
    let objects = desc.objects.len();
    let beside: Vec<usize> = (0..objects.min(all.len())).filter(|&number| is_beside(&all[number])).collect();
    let named: Vec<String> = beside.iter().take(NAMED).map(|&number| object_name(desc, number)).collect();
    let more = if beside.len() > NAMED { ", .." } else { "" };
    let told = format!("{} of {objects}: {}{more} (`--objects` tells where they are)", beside.len(), named.join(", "));
    (!beside.is_empty()).then_some(told)
}

fn is_beside(of: &Whereabouts) -> bool {
    !matches!(of.seen, SeenAt::Pixels(_) | SeenAt::Middle(_) | SeenAt::Around)
}

fn seen(of: &Whereabouts) -> String {
    match of.seen {
        SeenAt::Pixels([left, top, right, bottom]) => {
            format!("pixels {left},{top} to {},{}", right.max(left + 1) - 1, bottom.max(top + 1) - 1)
        }
        SeenAt::Middle([x, y]) => format!("about pixel {x},{y}"),
        SeenAt::Around if of.bounds.is_none() => String::new(),
        SeenAt::Around => "in view, and around the camera".to_owned(),
        SeenAt::Behind => "not in view: behind the camera".to_owned(),
        SeenAt::Left => "not in view: to the left".to_owned(),
        SeenAt::Right => "not in view: to the right".to_owned(),
        SeenAt::Above => "not in view: above".to_owned(),
        SeenAt::Below => "not in view: below".to_owned(),
        SeenAt::Nowhere if of.copies == 0 => String::new(),
        SeenAt::Nowhere => "not in view".to_owned(),
    }
}

fn point(p: [f64; 3]) -> String {
    format!("({}, {}, {})", short(p[0]), short(p[1]), short(p[2]))
}
