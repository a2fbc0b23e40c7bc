//! Scenes without light, and lamps that give none.

use super::meshes::Assigned;
use super::radiances;
use scene_format::desc::{
    Albedo, Background, Emissive, Integrator, Light, Material, MaterialRef, Object, Radiometric, with_operands,
};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};

/// Warns of each lamp that gives no light, or, where there is no other light, of all of them at once. That a scene has
/// no lamps at all the reader has told, as far as not only the files of meshes could tell.
pub fn warn<'d>(desc: &'d SceneDesc, assigned: &Assigned, diagnostics: &mut Diagnostics) {
    if matches!(desc.render.integrator, Integrator::AmbientOcclusion { .. }) {
        return;
    }
    let materials: BTreeMap<&str, &Material> =
        desc.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    let (mut any, mut known, mut dark) = (false, BTreeSet::new(), Vec::new());
    let mut shines = assigned.shines_by_file();
    let mut lamp = |is_dark: bool, at: Span, fallback: Span, name: &dyn Fn() -> String| {
        any = true;
        if !is_dark || is_said_by_expression(desc, at) {
            shines = true;
        } else if at == Span::NONE || known.insert(at) {
            dark.push((if at == Span::NONE { fallback } else { at }, name()));
        }
    };
    for (index, light) in desc.lights.iter().enumerate() {
        let Light::SphereLight(sphere) = &light.value;
        let is_dark = radiances::of_light(sphere) == [0.0; 3];
        lamp(is_dark, sphere.amount.span, light.span, &|| format!("lights[{index}]"));
    }
    let parts = |(index, object): (usize, &'d Spanned<Object>)| {
        with_operands(std::slice::from_ref(object)).map(move |part| (index, object.span, &part.value))
    };
    for (index, span, object) in desc.objects.iter().enumerate().flat_map(parts) {
        let (material, name) = match object.material() {
            MaterialRef::Default => continue,
            MaterialRef::Inline(material) => (Some(&material.value), None),
            MaterialRef::Named { name, .. } => (materials.get(&**name).copied(), Some(name)),
        };
        let Some(emissive) = material.and_then(Material::shines) else { continue };
        lamp(is_dark(emissive), emissive.amount.span, span, &|| match name {
            Some(name) => format!("the material \"{name}\""),
            None => format!("the material of objects[{index}]"),
        });
    }
    shines |= match &desc.background {
        Background::Color(color) => *color != [0.0; 3],
        Background::Environment(environment) => environment.scale != [0.0; 3],
    };
    if shines {
        diagnostics.extend(dark.into_iter().map(|(at, name)| {
            Diagnostic::warning(codes::DARK_LAMP, at, format!("{name} shines with nothing: it gives no light"))
                .expected("an amount of light above 0, and a colour that is not black")
                .hint("give it light, or leave it out")
        }));
    } else if let Some((first, others)) = dark.split_first() {
        let (at, name) = first;
        let message = match others.len() {
            0 => format!("{name} shines with nothing, and there is no other light: the picture will be black"),
            more => {
                format!(
                    "{name} and {more} more shine with nothing, and there is no other light: the picture will be black"
                )
            }
        };
        diagnostics.push(
            Diagnostic::warning(codes::BLACK_PICTURE, *at, message)
                .expected("an amount of light above 0, and a colour that is not black"),
        );
    } else if !any && let Some(mesh) = desc.objects.iter().find(|object| object.value.has_materials_of_file()) {
        let unused = desc.materials.iter().any(|named| named.material.shines().is_some());
        let message = "the scene has no light, so the picture will be black";
        diagnostics.extend((!unused).then(|| {
            Diagnostic::warning(codes::BLACK_PICTURE, mesh.span, message)
                .expected("a light, a `background`, or an object that shines")
                .hint("add a `SphereLight` to `lights`, or a `background`")
        }));
    }
}

/// Whether a material shines with nothing at all, wherever one looks.
fn is_dark(emissive: &Emissive) -> bool {
    // Where a texture is not black only the amount can be nothing.
    let color = match emissive.color.resolved() {
        Albedo::Color(color) => color.value,
        _ => [1.0; 3],
    };
    let (Radiometric::Radiance(amount) | Radiometric::Intensity(amount) | Radiometric::Power(amount)) =
        emissive.amount.value.radiometric(color);
    amount == [0.0; 3]
}

/// Whether an amount is an expression, or was set on the command line: a lamp that is off by turns, or for a trial.
fn is_said_by_expression(desc: &SceneDesc, at: Span) -> bool {
    let Some(source) = desc.sources.get(at.source as usize) else { return false };
    let said = source.text.get(at.start as usize..at.end as usize).unwrap_or_default();
    source.name.starts_with("--") || said.contains('=')
}
