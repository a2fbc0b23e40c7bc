//! A failing scene made smaller while it still fails.

use super::draw::{material_of, set_material};
use super::examine::{Finding, still};
use super::kinds::Case;
use super::world::{World, matt};
use scene_format::desc::{Background, Effects, Instances, Material, MaterialRef, Object, Placements};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The smallest scene that was found, and what is wrong with it.
#[derive(Clone, Debug)]
pub struct Smallest {
    /// The scene.
    pub case: Case,
    /// What is still wrong.
    pub finding: Finding,
    /// Scenes that were tried.
    pub tried: usize,
}

/// Drops and simplifies what it can within this time.
pub fn shrink(case: &Case, finding: &Finding, limit: Duration, threads: usize) -> Smallest {
    let start = Instant::now();
    let mut smallest = Smallest { case: case.clone(), finding: finding.clone(), tried: 0 };
    loop {
        let before = smallest.case.world.text("");
        for step in 0.. {
            let Some(world) = simpler(&smallest.case.world, step) else { break };
            if start.elapsed() > limit {
                return smallest;
            }
            let Some(world) = world else { continue };
            smallest.tried += 1;
            let case = Case { world, ..smallest.case.clone() };
            if let Some(finding) = still(&case, finding.fault, threads) {
                (smallest.case, smallest.finding) = (case, finding);
            }
        }
        if smallest.case.world.text("") == before {
            return smallest;
        }
    }
}

/// The world with the `step`th simplification; `None` after the last, `Some(None)` for one that changes nothing.
fn simpler(world: &World, step: usize) -> Option<Option<World>> {
    let mut other = world.clone();
    let (objects, lights) = (world.desc.objects.len(), world.desc.lights.len());
    let desc = &mut other.desc;
    // From the last to the first, so that what is dropped does not move what comes.
    match step {
        0 => {
            desc.effects = Effects { antialiasing: desc.effects.antialiasing.clone(), ..Effects::default() };
        }
        1 => desc.background = Background::default(),
        _ if step < 2 + objects => {
            let k = 2 + objects - 1 - step;
            if k < desc.objects.len() {
                desc.objects.remove(k);
            }
        }
        _ if step < 2 + objects + lights => {
            let k = step - 2 - objects;
            if k < desc.lights.len() {
                desc.lights.remove(k);
            }
        }
        _ if step < 2 + 2 * objects + lights => {
            let k = step - 2 - objects - lights;
            plainer(world, &mut other, k);
        }
        _ if step < 4 + 2 * objects + lights => {
            let least = if step.is_multiple_of(2) { 1 } else { 2 };
            if desc.render.max_bounces.value > least && desc.render.max_bounces.value < 16 {
                desc.render.max_bounces = least.into();
            }
        }
        _ => return None,
    }
    drop_unused_materials(&mut other);
    let changed = other.text("") != world.text("");
    Some(changed.then_some(other))
}

fn drop_unused_materials(world: &mut World) {
    let used: Vec<Arc<str>> = world
        .desc
        .objects
        .iter()
        .filter_map(|object| {
            if let MaterialRef::Named { name, .. } = object.value.material() { Some(name.clone()) } else { None }
        })
        .collect();
    world.desc.materials.retain(|named| used.contains(&named.name.value));
}

/// A plainer material for an object; glass, mirrors and what they stand for stay what they are.
fn plainer(world: &World, other: &mut World, k: usize) {
    let Some(object) = other.desc.objects.get_mut(k) else { return };
    let material = material_of(world, &object.value);
    if material.is_some_and(|material| matches!(material, Material::Diffuse(_) | Material::BlinnPhong(_))) {
        set_material(&mut object.value, matt(0.5));
    }
    if let Object::Mesh(mesh) = &mut object.value
        && matches!(mesh.placements, Placements::One)
    {
        mesh.instances = Instances::Auto;
    }
}
