//! Solids that are surely not meant: those of which nothing is left, and differences that take something away where
//! there is nothing.

use super::{
    DAffine3, DVec3, Frame, Node, Object, Operation, Side, SolidObject, Spanned, UnitShape, bounds, noun, side,
};
use crate::compile::bodies::Extent;
use scene_format::codes::Code;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::BTreeMap;
use tracer_kernels::scene::Solids;
use tracer_kernels::shapes::{Row, Solid};

/// More solids than this are not looked at: where there are so many, they are copies of few.
const MOST_SOLIDS: usize = 1000;

/// So many lines go through the box of a solid before nothing is said to be left of it. A line is aimed at a point of
/// the box, so of a cube the share pi r^2 meets a ball of r of its side: some three of them what is a thirtieth across.
const LINES: u32 = 4096;

/// What was found of all objects that stand in one place of the file: copies by `Repeat` may be cut away where others
/// are not, so it is told where it is so of all.
#[derive(Default)]
struct Found(BTreeMap<(Span, bool), (Diagnostic, bool)>);

impl Found {
    /// `is_so` of the object, of which this would be said.
    fn note(&mut self, is_so: bool, span: Span, code: Code, told: impl FnOnce(Diagnostic) -> Diagnostic) {
        let key = (span, code == codes::TAKES_NOTHING);
        let made = || (told(Diagnostic::warning(code, span, "")), true);
        self.0.entry(key).or_insert_with(made).1 &= is_so;
    }
}

/// Warns of them.
pub fn warn(desc: &SceneDesc, solids: &[SolidObject], diagnostics: &mut Diagnostics) {
    if solids.len() > MOST_SOLIDS {
        return;
    }
    let mut found = Found::default();
    for solid in solids {
        let Some(object) = desc.objects.get(solid.number as usize) else { continue };
        solid.look(&solid.node, object, &format!("objects[{}]", solid.number), &mut found);
    }
    diagnostics.extend(found.0.into_values().filter(|(_, is_so)| *is_so).map(|(told, _)| told));
}

impl SolidObject {
    /// Looks at a node and all that it is made of. Whether something in it is told.
    fn look(&self, node: &Node, object: &Spanned<Object>, path: &str, found: &mut Found) -> bool {
        let (Node::Made(operation, nodes), Some(parts)) = (node, object.value.operands()) else { return false };
        let mut is_told = false;
        for (k, (node, part)) in nodes.iter().zip(&parts.0).enumerate() {
            is_told |= self.look(node, part, &format!("{path}.objects[{k}]"), found);
        }
        if *operation == Operation::Union || is_told {
            return is_told;
        }
        let is_empty = !self.is_anything_left(node);
        let noun = noun(&object.value);
        found.note(is_empty, object.span, codes::NOTHING_LEFT, |told| Diagnostic {
            message: format!("nothing is left of this {noun}, {path}"),
            ..told
                .expected(match operation {
                    Operation::Intersection => "parts that overlap, all of them in one place",
                    _ => "a first part that sticks out of what is taken away from it",
                })
                .hint("render its parts as a Union to see where they are")
        });
        if *operation != Operation::Difference || is_empty {
            return is_empty;
        }
        let [first, taken @ ..] = nodes.as_slice() else { return false };
        for (k, (node, part)) in (1..).zip(taken.iter().zip(parts.0.iter().skip(1))) {
            let misses = self.is_apart(first, node);
            found.note(misses, part.span, codes::TAKES_NOTHING, |told| Diagnostic {
                message: format!(
                    "{path}.objects[{k}] takes nothing away: it lies beside the first part of the difference"
                ),
                ..told
                    .expected("a part that reaches into the first one")
                    .hint("move it there, or leave it out; render the parts as a Union to see where they are")
            });
        }
        false
    }

    /// Whether lines through its box meet anything of a node.
    fn is_anything_left(&self, node: &Node) -> bool {
        let [low, high] = bounds(node, &self.operands, &DAffine3::IDENTITY);
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let size = half.length();
        if !size.is_finite() || !centre.is_finite() {
            // Without an end, which is more than nothing.
            return true;
        }
        if size == 0.0 {
            return false;
        }
        let frame = Frame { centre, scale: 1.0 / size };
        let mut made = Solids::default();
        let placed = |_: usize, map: &DAffine3| DAffine3 {
            matrix3: map.matrix3 * frame.scale,
            translation: frame.point(map.translation),
        };
        self.steps(node, &placed, 0, &mut made);
        let parts = [0, made.parts.len() as u32];
        let solid = Solid { parts, steps: [0; 2], operands: [0; 2], bounds: [low, high].map(|p| frame.point(p)) };
        let row = Row::new(&UnitShape::Solid(solid), &DAffine3::IDENTITY);
        (0..LINES).any(|k| {
            let [x, y, z, turn, height] = additive(k);
            let target = (DVec3::new(x, y, z) * 2.0 - 1.0) * half / size;
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
            let z = 2.0 * height - 1.0;
            let across = (1.0 - z * z).max(0.0).sqrt();
            let direction = DVec3::new(across * cos, across * sin, z);
            let [origin, direction] = [target - 3.0 * direction, direction].map(|v| v.as_vec3().to_array());
            row.hit_among(&made.parts, origin, direction, false).is_some()
        })
    }

    /// Whether two nodes surely have nothing in common.
    fn is_apart(&self, a: &Node, b: &Node) -> bool {
        let identity = DAffine3::IDENTITY;
        let lies = |of: &Node, in_: &Node| {
            let extent = match of {
                Node::Operand(k) => {
                    let operand = &self.operands[*k];
                    (!operand.unit.is_endless())
                        .then(|| Extent::of_unit(&operand.unit, &(operand.moved * operand.local)))
                }
                Node::Made(..) => {
                    let corners = bounds(of, &self.operands, &identity);
                    corners.iter().all(|p| p.is_finite()).then(|| Extent::of_box(corners, &identity))
                }
            };
            extent.is_some_and(|extent| side(in_, &self.operands, &identity, &extent) == Side::Out)
        };
        lies(a, b) || lies(b, a)
    }
}

/// Five numbers from 0 to 1, evenly spread (Roberts 2018, the R5 sequence: powers of the root of x^6 = x + 1).
fn additive(k: u32) -> [f64; 5] {
    const ROOT: f64 = 1.134_724_138_401_519_5;
    let mut step = 1.0;
    [(); 5].map(|()| {
        step /= ROOT;
        (0.5 + f64::from(k) * step).fract()
    })
}
