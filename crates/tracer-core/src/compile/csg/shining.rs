//! Solids that shine, whole or in parts: each operand that does is a light of its own.

use super::{SolidObject, behind};
use glam::DAffine3;
use scene_format::Diagnostic;
use scene_format::desc::{Emissive, Object, Radiometric, no_power_of_solid};
use scene_format::diagnostic::{Span, Spanned};
use std::collections::BTreeMap;
use tracer_kernels::scene::{CurvedLight, Frame, Light, Operand};
use tracer_kernels::shapes::{Solid, UnitShape};

/// The lights that solids are added to.
pub struct Lit<'a> {
    /// Those of the scene.
    pub lights: &'a mut Vec<Light>,
    /// The unit of their radiance.
    pub radiance_unit: f64,
    /// The groups of the lights of solids that have one.
    pub groups: &'a mut BTreeMap<u32, String>,
}

/// What a material shines; nothing where it says that of a whole lamp, which is told before.
fn radiance(emissive: &Emissive) -> [f64; 3] {
    match emissive.radiometric() {
        Radiometric::Radiance(radiance) => radiance,
        Radiometric::Intensity(_) | Radiometric::Power(_) => [0.0; 3],
    }
}

/// The fault of a solid, or of a shape in one, that shines by an amount for all of it.
pub(super) fn amount_of_whole(object: &Spanned<Object>, emissive: &Emissive) -> Option<Diagnostic> {
    let what = match &object.value {
        Object::Union(_) => "a union",
        Object::Intersection(_) => "an intersection",
        Object::Difference(_) => "a difference",
        _ => "a part of a solid",
    };
    no_power_of_solid(what, emissive, object.span)
}

impl SolidObject {
    /// Whether an operand shines.
    pub fn shines(&self) -> bool {
        self.operands.iter().any(|operand| operand.emissive.is_some())
    }

    /// What its operands shine that do, in the scene's own unit, and where the first says it; `None`: none does.
    pub fn radiances(&self) -> Option<(Vec<[f64; 3]>, Span)> {
        let shines = || self.operands.iter().filter_map(|operand| operand.emissive.as_ref());
        let first = shines().next()?;
        Some((shines().map(|emissive| radiance(emissive)).collect(), first.amount.span))
            .filter(|_| !self.maps.is_empty())
    }

    /// Adds the lights of a copy, a solid that is the shape of this number.
    pub(super) fn shine(
        &self,
        frame: &Frame,
        (copy, map): (u32, &DAffine3),
        (solid, shape): (&Solid, u32),
        all: &mut [Operand],
        lit: &mut Lit<'_>,
    ) {
        for (number, operand) in self.operands.iter().enumerate() {
            let Some(emissive) = &operand.emissive else { continue };
            let index = solid.operands[0] + number as u32;
            // What is left of it lies in its own box, and in that of the solid.
            let (unit, whole) = self.moved_operand(copy, number, map);
            let [low, high] = if unit.is_endless() { behind(&whole) } else { unit.bounds(&whole) };
            let [a, b] = [low, high].map(|corner| frame.point(corner));
            let [low, high] = [a.min(b).max(solid.bounds[0]), a.max(b).min(solid.bounds[1])];
            if !low.cmple(high).all() {
                continue;
            }
            let own = Solid { operands: [index, 1], bounds: [low, high], ..*solid };
            let light = lit.lights.len() as u32;
            all[index as usize].light = light;
            lit.lights.push(Light::Curved(CurvedLight {
                shape,
                unit: UnitShape::Solid(own),
                placement: DAffine3::IDENTITY,
                radiance: radiance(emissive).map(|x| x / lit.radiance_unit),
                two_sided: emissive.two_sided,
                offset: 0.0,
            }));
            lit.groups.extend(emissive.group.as_str().map(|group| (light, group.to_owned())));
        }
    }
}
