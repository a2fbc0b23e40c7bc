//! Copies that are moved and then turned, each about its own middle, so that all are in one place: in other programs a
//! turn goes about the origin, and they stand in a ring.

use glam::DVec3;
use scene_format::desc::{Object, Transform, with_operands};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};

/// Warns of them, by objects of one place in the file and by operands of solids; the places of those that were told.
pub fn warn(desc: &SceneDesc, diagnostics: &mut Diagnostics) -> BTreeSet<Span> {
    // Of what stands in one place of the file: where it is moved to, and the first turn; whether another turn was met.
    let mut all: BTreeMap<Span, (DVec3, f64, bool)> = BTreeMap::new();
    for object in with_operands(&desc.objects).filter(|object| object.span != Span::NONE) {
        let Some((moved, degrees)) = moved_and_turned(&object.value) else { continue };
        let known = all.entry(object.span).or_insert((moved, degrees, false));
        known.2 |= known.0 == moved && known.1 != degrees;
    }
    let told: BTreeSet<Span> = all.iter().filter(|(_, (.., turns))| *turns).map(|(span, _)| *span).collect();
    diagnostics.extend(told.iter().map(|span| {
        let message = "copies of this shape turn in one place, each about its own middle";
        Diagnostic::warning(codes::IN_ONE_PLACE, *span, message)
            .expected("a ring of copies: each is turned about one point beside it")
            .hint("add `about: (0, 0, 0)` to the `Rotate` that follows a `Translate`, or take a `Ring`")
    }));
    told
}

/// Where an object is moved to before it is turned about its own middle, and by how much.
fn moved_and_turned(object: &Object) -> Option<(DVec3, f64)> {
    let mut moved = DVec3::ZERO;
    for step in object.transform() {
        match step.value {
            Transform::Translate(by) => moved += DVec3::from(by),
            Transform::Rotate { axis, degrees, about: None } => {
                // Along the axis it stays where it is, whatever it turns about.
                return (moved.cross(DVec3::from(axis)) != DVec3::ZERO).then_some((moved, degrees));
            }
            _ => {}
        }
    }
    None
}
