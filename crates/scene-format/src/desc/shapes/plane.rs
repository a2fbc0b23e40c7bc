//! Planes without an end.

use super::{Copies, Placements};
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A plane without an end, to the horizon: a floor, a wall, water. Seen against its normal, right is (0, 1, 0) x
    /// normal, or (1, 0, 0) where the normal is upright; texture coordinates grow to the right and upwards by 1 for
    /// each unit of the scene, from (0, 0) at `point`. It is open: it has no inside. What lies in it is seen where
    /// it is as opaque, or shines. It cannot be dropped, centred or fitted, as it has neither a lowest
    /// point nor a middle nor an extent.
    pub struct Plane as "Plane", "a plane" {
        /// A point of it.
        point: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Direction that it faces.
        normal: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Plane {
    const ALSO: &'static [&'static str] = &["floor", "ground", "infiniteplane", "horizon", "halfspace"];
    const EXAMPLE: &'static str = "Plane(point: (0, -1, 0), material: Diffuse(albedo: Checkerboard(a: 0.2, b: 0.7)))";
}

impl ShapeWords for Plane {
    const MANY: &'static str = "planes";

    fn is_endless(&self) -> bool {
        true
    }
}

impl Faulty for Plane {
    /// A step that asks for what a plane does not have.
    fn faults(&self, _: Span) -> Vec<Diagnostic> {
        let mut placements = &self.placements;
        while let Some(within) = placements.within() {
            placements = &within.own;
        }
        let copies = match placements.copies() {
            Some(Copies::List(list)) => list.iter().flatten().collect(),
            _ => Vec::new(),
        };
        self.transform.iter().chain(copies).find_map(endless_fault).into_iter().collect()
    }
}

fn endless_fault(step: &Spanned<Transform>) -> Option<Diagnostic> {
    let (message, hint) = match step.value {
        Transform::DropTo { .. } => {
            ("a plane has no lowest point", "say where it is: `point`, or move it by Translate((0, y, 0))")
        }
        Transform::CenterTo { .. } => (
            "a plane has no middle that could be centred",
            "say where it is: `point`, or move it by Translate((x, y, z))",
        ),
        Transform::FitTo { .. } => {
            ("a plane has no extent that could be fitted", "to make its pattern larger, scale it: Scale(2)")
        }
        _ => return None,
    };
    let fault = Diagnostic::error(codes::GROUP_DROP, step.span, message);
    Some(fault.expected("Translate, Scale, Rotate, Matrix or Align").hint(hint))
}
