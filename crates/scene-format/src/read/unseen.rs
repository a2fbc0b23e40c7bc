//! What is asked for and cannot be seen: groups of lights where no light is of one, a checkerboard of a single square.

use super::{Reader, Step};
use crate::codes;
use crate::desc::{Albedo, Checkerboard, Material, MaterialRef, Object, Scene, SolidMapping, with_operands};
use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::syntax::Syntax;
use crate::tree::Item;
use std::collections::BTreeMap;

/// Of so many checkerboards it is told.
const MOST: usize = 8;

impl Reader<'_> {
    /// Warns of both, in a scene that has been read without an error.
    pub(super) fn unseen(&mut self, root: Item<'_, '_>, scene: &Scene) {
        if self.sink.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
            return;
        }
        self.no_light_group(root, scene);
        self.single_squares(root, scene);
    }

    /// Groups of lights are asked for, and no light is of one.
    fn no_light_group(&mut self, root: Item<'_, '_>, scene: &Scene) {
        if !scene.output.light_groups {
            return;
        }
        let of_material =
            |material: &Material| material.shines().is_some_and(|shining| shining.group.as_str().is_some());
        let of_object = |object: &Object| match object.material() {
            MaterialRef::Inline(material) => of_material(&material.value),
            MaterialRef::Named { .. } | MaterialRef::Default => false,
        };
        let has_group = scene.lights.iter().any(|light| light.value.group().as_str().is_some())
            || scene.materials.iter().any(|named| of_material(&named.material))
            || scene.background.environment().is_some_and(|sky| sky.group.as_str().is_some())
            || with_operands(&scene.objects.0).any(|object| of_object(&object.value));
        if has_group {
            return;
        }
        let output = field(root, "output");
        let asked = output.and_then(|output| field(output, "light_groups"));
        let message = "the lights are told apart by groups, and no light has a `group`";
        let hint = match root.syntax() {
            Syntax::Ron => {
                "write one in each light, `group: \"key\"`, in a lamp's Emissive(..) or in the Environment(..)"
            }
            Syntax::Toml => "write one in each light, `group = \"key\"`, in a lamp's Emissive or in the Environment",
            Syntax::Json => "write one in each light, \"group\": \"key\", in a lamp's Emissive or in the Environment",
        };
        self.path = vec![Step::Field("output"), Step::Field("light_groups")];
        let at = asked.or(output).unwrap_or(root).span();
        self.report(Diagnostic::warning(codes::NO_LIGHT_GROUP, at, message).hint(hint));
        self.path.clear();
    }

    /// One square of a checkerboard covers all of each thing that has it.
    fn single_squares(&mut self, root: Item<'_, '_>, scene: &Scene) {
        let named: BTreeMap<&str, Option<Square>> =
            scene.materials.iter().map(|named| (&*named.name.value, single_square(&named.material))).collect();
        // Where a thing shows more of it than a square, it is meant so; and each is told once.
        let mut of_names: BTreeMap<&str, Option<(Span, &'static str, Square)>> = BTreeMap::new();
        let mut found: Vec<(Span, &'static str, Square)> = Vec::new();
        for object in with_operands(&scene.objects.0) {
            let told = |square: Square| {
                has_corner_to_corner(&object.value).then(|| (object.span, object.value.kind(), square))
            };
            match object.value.material() {
                MaterialRef::Named { name, .. } => {
                    if let Some(square) = named.get(&**name).copied().flatten() {
                        let told = told(square);
                        of_names.entry(name).and_modify(|known| *known = known.and(told).and(*known)).or_insert(told);
                    }
                }
                MaterialRef::Inline(material) => {
                    let told = single_square(&material.value).and_then(told);
                    found.extend(told.filter(|told| found.last() != Some(told)));
                }
                MaterialRef::Default => {}
            }
        }
        found.extend(of_names.into_values().flatten());
        found.sort_unstable();
        found.dedup();
        let mapping = match root.syntax() {
            Syntax::Ron => "mapping: Uv(scale: 8)".into(),
            syntax => syntax.of_toml("mapping = { Uv = { scale = 8 } }"),
        };
        for (span, kind, square) in found.into_iter().take(MOST) {
            let message =
                format!("one square of the checkerboard covers all of this `{kind}`: only its `{square}` is seen");
            let hint = format!("write `{mapping}` in the Checkerboard, for eight squares along each side");
            self.report(
                Diagnostic::warning(codes::SINGLE_SQUARE, span, message).expected("several squares").hint(hint),
            );
        }
    }
}

fn field<'t, 's>(item: Item<'t, 's>, name: &str) -> Option<Item<'t, 's>> {
    item.fields().take(super::LOOK_AT).find(|(key, _)| key.text() == name).map(|(_, value)| value)
}

/// Whether texture coordinates go from 0 to 1 over all of a shape, or each face of it. Those of a plane have no end,
/// and those of a mesh are its own.
fn has_corner_to_corner(object: &Object) -> bool {
    matches!(
        object,
        Object::Sphere(_)
            | Object::Rectangle(_)
            | Object::Box(_)
            | Object::Disk(_)
            | Object::Cylinder(_)
            | Object::Cone(_)
            | Object::Capsule(_)
            | Object::Lathe(_)
            | Object::Extrude(_)
            | Object::Tube(_)
            | Object::Torus(_)
            | Object::Arrow(_)
            | Object::HeightField(_)
    )
}

/// The name of the colour that a square of a checkerboard has.
type Square = char;

/// Of a checkerboard of which coordinates from 0 to 1 meet one square, whose that is.
fn single_square(material: &Material) -> Option<Square> {
    material.varying().into_iter().find_map(|of| match of.resolved() {
        Albedo::Checkerboard(checkerboard) => square_of(checkerboard),
        _ => None,
    })
}

fn square_of(checkerboard: &Checkerboard) -> Option<Square> {
    let SolidMapping::Uv(uv) = &checkerboard.mapping else { return None };
    // Nothing is lost where both are the same.
    if checkerboard.a == checkerboard.b {
        return None;
    }
    let is_whole = uv.offset.iter().all(|by| by.fract() == 0.0);
    let is_single = is_whole && uv.rotation == 0.0 && uv.scale.0.iter().all(|scale| (0.0..=1.0).contains(scale));
    is_single.then(|| if (uv.offset[0] + uv.offset[1]) % 2.0 == 0.0 { 'a' } else { 'b' })
}
