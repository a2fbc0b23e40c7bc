//! A shaft and a head.

#![expect(clippy::indexing_slicing, reason = "axes are numbered here")]

use super::axis::stand;
use super::lathe::Plan;
use super::{Triangulated, check_count, first_fault};
use crate::data::MeshData;
use scene_format::Diagnostic;
use scene_format::desc::Arrow;
use scene_format::diagnostic::Span;
use scene_format::path::{Ends, Point, Point3, length, pieces, sub};
use std::f64::consts::TAU;

/// Radius of a head whose radius is not written, over that of the shaft.
const HEAD_RADIUS: f64 = 2.5;

/// Its length, over the radius of the shaft.
const HEAD_LENGTH: f64 = 6.0;

/// A head is as long as the arrow where its length is so but for rounding.
const LONGER: f64 = 1.0 + 1e-12;

impl Triangulated for Arrow {
    fn noun(&self) -> &'static str {
        "arrow"
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn middle(&self) -> Option<[f64; 3]> {
        let [from, to]: [Point3; 2] = [self.from.value, self.to.value];
        Some([0, 1, 2].map(|axis| 0.5 * (from[axis] + to[axis])))
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        let [from, to]: [Point3; 2] = [self.from.value, self.to.value];
        if let Some(fault) = first_fault(self, span) {
            return Err(fault);
        }
        let (direction, shaft) = (sub(to, from), self.radius.value);
        let whole = length(direction);
        let head = self.head_length.as_ref().map_or((HEAD_LENGTH * shaft).min(0.5 * whole), |length| length.value);
        let wide = self.head_radius.as_ref().map_or(HEAD_RADIUS * shaft, |radius| radius.value);
        let neck = whole - head;
        // A head as long as the arrow leaves no shaft.
        let mut profile: Vec<Point> = match head >= whole / LONGER {
            true => vec![[0.0, 0.0], [wide, 0.0], [0.0, whole]],
            false => vec![[0.0, 0.0], [shaft, 0.0], [shaft, neck], [wide, neck], [0.0, whole]],
        };
        profile.dedup();
        let (segments, outline) = (self.segments.value, pieces(&profile, Ends::Open, false, TAU));
        let plan = Plan::new(&outline);
        check_count(plan.triangles(segments), "arrow", span, "fewer `segments`")?;
        Ok(stand(plan.turned(segments, true), from, direction))
    }
}
