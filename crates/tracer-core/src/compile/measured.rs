//! What a scene is measured by: where its numbers lie, how it is seen, and what its light counts in.

use super::{Like, Objects, camera, meshes, radiances, unmeant};
use glam::DVec3;
use scene_format::desc::Light;
use scene_format::{Diagnostics, SceneDesc};
use tracer_kernels::scene::{Camera, Frame};

/// What a scene is measured by.
pub(super) struct Measured {
    pub(super) frame: Frame,
    pub(super) camera: Camera,
    pub(super) radiance_unit: f64,
}

impl Measured {
    /// Chosen by the objects, unless another scene has said; `behind`: the most that comes from the background. With it
    /// what copies of objects of triangles shine, by object.
    pub(super) fn new(
        desc: &SceneDesc,
        objects: &Objects,
        behind: [f64; 3],
        like: Like,
        diagnostics: &mut Diagnostics,
    ) -> (Self, Vec<Vec<[f64; 3]>>) {
        let eye = DVec3::from(desc.camera.position.value);
        let look_at = DVec3::from(desc.camera.look_at.value);
        let chosen = || Frame::choose(eye, look_at, &marks(objects, look_at), &beside(desc, objects, look_at));
        let frame = like.frame.unwrap_or_else(chosen);
        let camera = camera::camera(desc, &frame);
        unmeant::far_view(desc, &camera, &frame, diagnostics);
        let Objects { loaded, assigned, curved, solids, placed } = objects;
        let of_meshes = meshes::radiances(loaded, placed, assigned);
        let shining = radiances::of_objects(desc, (curved, solids), &of_meshes);
        let radiance_unit = like.radiance_unit.unwrap_or_else(|| radiances::unit(desc, &shining, behind));
        diagnostics.extend(radiances::too_dark(desc, &shining, behind, radiance_unit));
        (Measured { frame, camera, radiance_unit }, of_meshes)
    }
}

/// One point per object near what the camera looks at, on its surface or in its box. What has no end says nothing of
/// where a scene is, unless there is nothing else.
fn marks(objects: &Objects, look_at: DVec3) -> Vec<DVec3> {
    let of = |endless: bool| {
        let some = objects.curved.iter().filter(move |object| object.is_endless() == endless);
        some.flat_map(move |object| object.marks(look_at))
    };
    let of_solids = objects.solids.iter().flat_map(|object| object.marks(look_at));
    let marks: Vec<DVec3> = of(false).chain(of_solids).chain(objects.placed.marks(look_at)).collect();
    if marks.is_empty() { of(true).collect() } else { marks }
}

/// Points of planes and lamps near what the camera looks at.
fn beside(desc: &SceneDesc, objects: &Objects, look_at: DVec3) -> Vec<DVec3> {
    let endless = objects.curved.iter().filter(|object| object.is_endless());
    let lamps = desc.lights.iter().map(|light| match &light.value {
        Light::SphereLight(lamp) => {
            let center = DVec3::from(lamp.center.value);
            center + (look_at - center).clamp_length_max(lamp.radius.value)
        }
    });
    endless.flat_map(|object| object.marks(look_at)).chain(lamps).collect()
}
