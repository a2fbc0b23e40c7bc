//! Rings with a round section.

use super::axis::stand;
use super::lathe::Plan;
use super::{Triangulated, check_count, first_fault};
use crate::data::MeshData;
use scene_format::Diagnostic;
use scene_format::desc::Torus;
use scene_format::diagnostic::Span;
use scene_format::path::Piece;
use std::f64::consts::{PI, TAU};

impl Triangulated for Torus {
    fn noun(&self) -> &'static str {
        "torus"
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn middle(&self) -> Option<[f64; 3]> {
        Some(self.center.value)
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        let (radius, tube) = (self.radius.value, self.tube_radius.value);
        if let Some(fault) = first_fault(self, span) {
            return Err(fault);
        }
        let segments = self.segments.value;
        // From the inside downwards, so that it goes up on the outside.
        let around = |k: u32| {
            let angle = PI + TAU * f64::from(k % segments) / f64::from(segments);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            // Where it touches its axis it does to the bit.
            let out = if k.is_multiple_of(segments) { radius - tube } else { radius + tube * cos };
            ([out, tube * sin], [-sin, cos])
        };
        let piece = |k: u32| {
            let [(from, begin), (to, end)] = [around(k), around(k + 1)];
            Piece { from, to, directions: [begin, end], number: 0 }
        };
        let section: Vec<Piece> = (0..segments).map(piece).collect();
        let plan = Plan::new(&section);
        check_count(plan.triangles(segments), "torus", span, "fewer `segments`")?;
        Ok(stand(plan.turned(segments, true), self.center.value, self.axis.value))
    }
}
