//! Profiles and outlines that bound nothing, or not what was meant: told with all else that is wrong, before they are
//! made into triangles.

use super::Reader;
use crate::codes;
use crate::desc::{Curve, Lathe, Material, MaterialRef, Object, Scene};
use crate::diagnostic::{Diagnostic, Span};
use crate::path::shown;
use std::collections::HashSet;
use std::f64::consts::TAU;

/// Sides that are looked at in all outlines of a scene, at most; what is wrong with others is told when triangles are
/// made of them.
const MOST_SIDES: usize = 200_000;
/// About so many sides a curve has between two points.
const SIDES_OF_A_SPAN: usize = 64;
/// Curves are cut into sides that turn by so much at most.
const STEP: f64 = TAU / 128.0;

impl Reader<'_> {
    /// How much has been told.
    pub(crate) fn told(&self) -> usize {
        self.sink.diagnostics.len()
    }

    /// Leaves the first of the faults that were told since then, where so many are all there are and all have this
    /// code.
    pub(crate) fn once(&mut self, since: usize, code: codes::Code, count: usize) {
        let told = self.sink.diagnostics.get(since..).unwrap_or_default();
        if told.len() == count && told.iter().all(|fault| fault.code == code) {
            self.sink.diagnostics.truncate(since + 1);
            self.sink.errors -= count - 1;
        }
    }

    /// Tells of outlines that cross themselves, and of curves that come too near to the axis that they turn about.
    pub(super) fn outlines(&mut self, scene: &Scene) {
        let (mut sides, mut told) = (0, HashSet::new());
        for object in &scene.objects.0 {
            let (written, count, curve): (_, usize, _) = match &object.value {
                Object::Lathe(lathe) => (lathe.profile.span, lathe.profile.value.0.len(), lathe.curve),
                Object::Extrude(extrude) => {
                    let count = extrude.outline.value.0.iter().map(Vec::len).sum();
                    (extrude.outline.span, count, extrude.curve)
                }
                Object::Polygon(polygon) => (polygon.points.span, polygon.points.value.0.len(), Curve::Linear),
                _ => continue,
            };
            let count = if curve == Curve::CatmullRom { SIDES_OF_A_SPAN * count } else { count };
            if sides + count > MOST_SIDES {
                continue;
            }
            sides += count;
            let at = if written == Span::NONE { object.span } else { written };
            let faults = match &object.value {
                Object::Lathe(lathe) => of_lathe(lathe, at, &scene.materials),
                Object::Extrude(extrude) => {
                    extrude.crossing().into_iter().map(|message| crossed(message, at)).collect()
                }
                Object::Polygon(polygon) => polygon.points.value.fault(at).into_iter().collect(),
                _ => Vec::new(),
            };
            // What is repeated is wrong many times, and told once.
            for fault in faults {
                if told.insert((fault.span, fault.code)) {
                    self.report(fault);
                }
            }
        }
    }
}

fn crossed(message: String, at: Span) -> Diagnostic {
    Diagnostic::error(codes::BAD_OUTLINE, at, message).expected("sides that do not meet but at the points")
}

fn of_lathe(lathe: &Lathe, at: Span, materials: &[crate::desc::NamedMaterial]) -> Vec<Diagnostic> {
    let turning = lathe.profile.value.turned();
    if let Some(fault) = turning.fault(at) {
        return vec![fault];
    }
    let mut faults = Vec::new();
    if lathe.curve == Curve::CatmullRom
        && let Some(([from, to], between)) = turning.thin()
    {
        let message =
            format!("between profile[{from}] and profile[{to}] the curve comes much nearer to the axis than these");
        let fault = Diagnostic::warning(codes::THIN_PROFILE, at, message)
            .expected("points so near each other that the curve between them is as far from the axis as they are");
        faults.push(fault.hint(match between {
            Some(point) => format!("add a point between them: {}", shown(&point)),
            None => "add points between them, or join all by straight lines: `curve: Linear`".to_owned(),
        }));
    }
    if turning.closed
        && is_glass(&lathe.material, materials)
        && let Some(found) = turning.crossing(lathe.curve, STEP)
    {
        let at_place = shown(&found.at);
        let [a, b] = found.sides;
        let message = format!(
            "the profile of this glass crosses itself at {at_place}: after profile[{a}] and after profile[{b}]"
        );
        let fault = Diagnostic::warning(codes::CROSSED_GLASS, at, message)
            .expected("a profile whose sides do not meet, so that inside and outside differ");
        faults.push(fault);
    }
    faults
}

fn is_glass(material: &MaterialRef, materials: &[crate::desc::NamedMaterial]) -> bool {
    let material = match material {
        MaterialRef::Inline(material) => Some(&material.value),
        MaterialRef::Named { name, .. } => {
            materials.iter().find(|known| known.name.value == *name).map(|known| &known.material)
        }
        MaterialRef::Default => None,
    };
    matches!(material, Some(Material::Transparent(_)))
}
