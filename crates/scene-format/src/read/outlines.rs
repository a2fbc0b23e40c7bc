//! Shapes whose numbers do not go together, profiles and outlines that bound nothing or not what was meant: told with
//! all else that is wrong, before they are made into triangles.

use super::Reader;
use crate::codes;
use crate::desc::{Curve, Lathe, Material, MaterialRef, NamedMaterial, Object, Scene};
use crate::diagnostic::{Diagnostic, Span, Spanned};
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

    /// Whether a fault of syntax has been told.
    fn is_damaged(&self) -> bool {
        self.sink.diagnostics.iter().any(|told| told.code.as_str().starts_with("E01"))
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

    /// Tells of shapes whose numbers do not go together: ends at one point, outlines that cross themselves, curves that
    /// come too near to the axis that they turn about.
    pub(super) fn shapes(&mut self, scene: &Scene) {
        let (mut sides, mut told) = (0, HashSet::new());
        let intense: HashSet<&str> = match self.intense {
            true => scene.materials.iter().filter(|of| is_intense(&of.material)).map(|of| &*of.name.value).collect(),
            false => HashSet::new(),
        };
        for (number, object) in scene.objects.0.iter().enumerate() {
            sides += sides_of(&object.value);
            let mut faults = Vec::new();
            if sides <= MOST_SIDES {
                faults = match &object.value {
                    Object::Lathe(lathe) => of_lathe(lathe, object.span, &scene.materials),
                    shape => shape.faults(object.span),
                };
            } else {
                sides -= sides_of(&object.value);
            }
            // How many there have to be goes by words beside them, and of a damaged text those may be lost.
            if faults.iter().any(|fault| fault.code == codes::WRONG_COUNT) && self.is_damaged() {
                faults.retain(|fault| fault.code != codes::WRONG_COUNT);
            }
            if self.intense {
                faults.extend(no_intensity(&object.value, &intense));
            }
            // What is repeated is wrong many times, and told once.
            for mut fault in faults {
                if told.insert((fault.span, fault.code)) {
                    // Each is looked for among all: not for thousands of faults, of which few are shown.
                    if told.len() <= MOST_PLACED {
                        fault.message += &which_of_many(&scene.objects.0, number);
                    }
                    self.report(fault);
                }
            }
        }
    }
}

/// Of so many faults it is said which of the objects they are of.
const MOST_PLACED: usize = 64;

/// ` (number 2 of the 9 that are made here, from 0)`, of an object that a repetition makes with others at the same
/// place.
fn which_of_many(objects: &[Spanned<Object>], number: usize) -> String {
    let span = objects[number].span;
    let made_here = |objects: &[Spanned<Object>]| objects.iter().filter(|object| object.span == span).count();
    match (made_here(&objects[..number]), made_here(objects)) {
        (_, 0 | 1) => String::new(),
        (before, all) => format!(" (number {before} of the {all} that are made here, from 0)"),
    }
}

/// How many sides have to be looked at.
fn sides_of(object: &Object) -> usize {
    let (count, curve) = match object {
        Object::Lathe(lathe) => (lathe.profile.value.0.len(), lathe.curve),
        Object::Extrude(extrude) => (extrude.outline.value.0.iter().map(Vec::len).sum(), extrude.curve),
        Object::Polygon(polygon) => (polygon.points.value.0.len(), Curve::Linear),
        Object::Tube(tube) => (tube.points.value.0.len(), Curve::Linear),
        _ => return 0,
    };
    if curve == Curve::CatmullRom { SIDES_OF_A_SPAN * count } else { count }
}

fn of_lathe(lathe: &Lathe, span: Span, materials: &[NamedMaterial]) -> Vec<Diagnostic> {
    let at = if lathe.profile.span == Span::NONE { span } else { lathe.profile.span };
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

fn is_intense(material: &Material) -> bool {
    material.shines().is_some_and(|shines| shines.amount.value.is_intensity())
}

/// Of what is neither flat nor a ball nobody can say how bright it is from afar. `intense`: materials that say it.
fn no_intensity(object: &Object, intense: &HashSet<&str>) -> Option<Diagnostic> {
    let span = match object.material() {
        MaterialRef::Named { name, span } => intense.contains(&**name).then_some(*span)?,
        MaterialRef::Inline(material) if is_intense(&material.value) => material.value.shines()?.amount.span,
        MaterialRef::Inline(_) | MaterialRef::Default => return None,
    };
    let has = matches!(object, Object::Sphere(_) | Object::Rectangle(_) | Object::Disk(_) | Object::Polygon(_));
    // Solids have a fault of their own.
    (!has && object.operands().is_none()).then(|| {
        Diagnostic::error(codes::NO_USE, span, "only a sphere, a rectangle, a disk and a polygon shine by an intensity")
            .expected("`radiance`, `power`, `luminance` or `luminous_power`")
    })
}

fn is_glass(material: &MaterialRef, materials: &[NamedMaterial]) -> bool {
    let material = match material {
        MaterialRef::Inline(material) => Some(&material.value),
        MaterialRef::Named { name, .. } => {
            materials.iter().find(|known| known.name.value == *name).map(|known| &known.material)
        }
        MaterialRef::Default => None,
    };
    matches!(material, Some(Material::Transparent(_)))
}
