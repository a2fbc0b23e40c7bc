//! Which object each light of a compiled scene is, and of which group.

use crate::scene::LightGroups;
use scene_format::SceneDesc;
use scene_format::desc::{Emissive, Light, LightGroup, Material, MaterialRef, with_operands};
use std::collections::{BTreeMap, BTreeSet};
use tracer_kernels::scene::{Integrator, NONE, Scene};
use tracer_kernels::shapes::{Solid, UnitShape};

/// The groups of a scene's lights; `of_solids`: of those that are parts of solids. A picture that is of no light has
/// none.
pub(super) fn of(desc: &SceneDesc, scene: &Scene, of_solids: &BTreeMap<u32, String>) -> LightGroups {
    if matches!(scene.integrator, Integrator::AmbientOcclusion { .. }) {
        return LightGroups::default();
    }
    let named: BTreeMap<&str, &Emissive> =
        desc.materials.iter().filter_map(|named| Some((&*named.name.value, named.material.shines()?))).collect();
    let of_lights = (0..).zip(of_lights(scene)).map(|(light, object)| {
        let is_solid = desc.objects.get(object as usize).is_some_and(|object| object.value.operands().is_some());
        if is_solid { of_solids.get(&light).map(String::as_str) } else { group_of(desc, &named, object) }
    });
    let groups: Vec<Option<&str>> = of_lights.collect();
    let of_background = desc.background.environment().and_then(|environment| environment.group.as_str());
    let background = scene.is_open().then_some(of_background);

    let names: BTreeSet<&str> = groups.iter().copied().chain(background).flatten().collect();
    let has_rest = groups.contains(&None) || background == Some(None);
    let place = |group: Option<&str>| {
        group.map_or(names.len(), |group| names.iter().take_while(|name| **name < group).count()) as u32
    };
    LightGroups {
        of_light: groups.iter().map(|&group| place(group)).collect(),
        of_background: background.map(place),
        names: names.iter().copied().chain(has_rest.then_some(LightGroups::REST)).map(str::to_owned).collect(),
    }
}

/// How many groups the lights of a scene may be of; 0 where they are not told apart.
pub fn most_light_groups(desc: &SceneDesc) -> usize {
    if !desc.output.light_groups {
        return 0;
    }
    let of_material = |material: &'_ Material| Some(material.shines()?.group.clone());
    let inline = with_operands(&desc.objects).filter_map(|object| match object.value.material() {
        MaterialRef::Inline(material) => of_material(&material.value),
        _ => None,
    });
    let named = desc.materials.iter().filter_map(|named| of_material(&named.material));
    let lamps = desc.lights.iter().map(|lamp| lamp.value.group().clone());
    let background = desc.background.environment().map(|environment| environment.group.clone());
    let all = inline.chain(named).chain(lamps).chain(background);
    let names: BTreeSet<String> = all.filter_map(|group| group.as_str().map(str::to_owned)).collect();
    names.len() + 1
}

/// How many things of a scene shine: its lamps, and objects that do, in whole or in part, each with all its copies one.
pub fn shining_objects(scene: &crate::Scene) -> usize {
    of_lights(scene).into_iter().filter(|&object| object != NONE).collect::<BTreeSet<u32>>().len()
}

/// The object that each light is, as surfaces name it: behind the objects of the scene come its lamps.
fn of_lights(scene: &Scene) -> Vec<u32> {
    let mut objects = vec![NONE; scene.lights.len()];
    let mut note = |light: u32, object: u32| {
        if let Some(of) = objects.get_mut(light as usize) {
            *of = object;
        }
    };
    scene.spheres.iter().for_each(|sphere| note(sphere.light, sphere.object));
    for shape in &*scene.shapes {
        match shape.unit {
            UnitShape::Solid(Solid { operands: [first, count], .. }) => {
                let operands = scene.solids.operands.iter().skip(first as usize).take(count as usize);
                operands.for_each(|operand| note(operand.light, shape.object));
            }
            _ => note(shape.light, shape.object),
        }
    }
    for instance in scene.instances.iter() {
        let mesh = scene.meshes[instance.mesh as usize];
        let triangles = mesh.first_triangle as usize..(mesh.first_triangle + mesh.triangle_count) as usize;
        // None shines beyond the last one that does.
        let lights = &scene.triangles.light[triangles.start.min(scene.triangles.light.len())..];
        lights.iter().take(triangles.len()).for_each(|&light| note(light, instance.object));
    }
    objects
}

/// The group of an object or lamp.
fn group_of<'d>(desc: &'d SceneDesc, named: &BTreeMap<&str, &'d Emissive>, object: u32) -> Option<&'d str> {
    let shines = match desc.objects.get(object as usize).map(|object| object.value.material()) {
        Some(MaterialRef::Inline(material)) => material.value.shines(),
        Some(MaterialRef::Named { name, .. }) => named.get(&**name).copied(),
        Some(MaterialRef::Default) => None,
        None => {
            let lamp = (object as usize).checked_sub(desc.objects.len()).and_then(|k| desc.lights.get(k));
            return lamp.map(|lamp| &lamp.value).map(Light::group).and_then(LightGroup::as_str);
        }
    };
    shines.and_then(|emissive| emissive.group.as_str())
}
