//! How a random scene is looked at: projections, lenses, moved film.

use super::draw::{once_in, one_of};
use super::world::World;
use glam::DVec3;
use scene_format::desc::{FisheyeMapping, Focus, FovAxis, Projection, Stereo, StereoLayout, ThinLens};
use tracer_reference::Random;

/// Lets all rays leave from the eye: those of an orthographic camera, of a lens and behind `near` may begin beyond the
/// walls of a room.
pub fn from_the_eye(world: &mut World) {
    let camera = &mut world.desc.camera;
    if matches!(camera.projection, Projection::Orthographic { .. }) {
        camera.projection = Projection::Perspective;
    }
    camera.near = None;
    camera.stereo = None;
    world.desc.effects.depth_of_field = None;
}

/// The camera's words, its place aside; and the lens.
pub fn view(world: &mut World, random: &mut Random) {
    let desc = &mut world.desc;
    let camera = &mut desc.camera;
    let distance = (DVec3::from(camera.look_at.value) - DVec3::from(camera.position.value)).length();
    let height = 2.0 * distance * (camera.fov.value.to_radians() / 2.0).tan();
    let mapping = one_of(
        random,
        &[
            FisheyeMapping::Equidistant,
            FisheyeMapping::Equisolid,
            FisheyeMapping::Stereographic,
            FisheyeMapping::Orthographic,
        ],
    );
    camera.projection = match random.below(12) {
        0 => Projection::Orthographic { height: height.into() },
        1 => Projection::Panorama,
        2 => Projection::Fisheye { fov: random.between(90.0, 180.0).into(), mapping },
        _ => Projection::Perspective,
    };
    if once_in(random, 6) {
        camera.stand_by(camera.rows());
    }
    let planar = matches!(camera.projection, Projection::Perspective | Projection::Orthographic { .. });
    if planar && once_in(random, 6) {
        camera.shift = [random.between(-0.3, 0.3), random.between(-0.3, 0.3)].into();
    }
    if planar && once_in(random, 8) {
        camera.near = Some(random.between(0.05 * distance, 0.7 * distance).into());
    }
    if matches!(camera.projection, Projection::Perspective | Projection::Panorama) && once_in(random, 8) {
        let near = camera.projection == Projection::Perspective && once_in(random, 2);
        camera.stereo = Some(Stereo {
            separation: random.between(0.02, 0.2).into(),
            convergence: near.then(|| random.between(1.0, 6.0).into()),
            layout: one_of(random, &[StereoLayout::SideBySide, StereoLayout::TopBottom]),
        });
    }
    if camera.projection != Projection::Perspective {
        camera.fov = 40.0.into();
        return;
    }
    match random.below(10) {
        0 => {
            // The same width of a square picture.
            let half = (camera.fov.value.to_radians() / 2.0).tan();
            camera.sensor_width = 24.0.into();
            camera.focal_length = Some((12.0 / half).into());
            camera.fov = 40.0.into();
        }
        1 => {
            let axes = [FovAxis::Horizontal, FovAxis::Diagonal, FovAxis::Smaller, FovAxis::Larger];
            camera.fov_axis = one_of(random, &axes);
        }
        _ => {}
    }
    if !once_in(random, 6) {
        return;
    }
    let mut lens = ThinLens::new(random.between(0.02, 0.3), random.between(1.0, 6.0));
    if once_in(random, 3) {
        lens.focus = Focus::On(camera.look_at.value).into();
    }
    if once_in(random, 3) {
        (lens.blades, lens.rotation) = ((3 + random.below(6) as u32).into(), random.between(-90.0, 90.0).into());
    }
    if once_in(random, 3) {
        lens.tilt = [random.between(-60.0, 60.0), random.between(-40.0, 40.0)].into();
    }
    desc.effects.depth_of_field = Some(lens);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::truth::kinds::{case, kind};

    /// Of rooms without light all rays begin within: seed 90766 had an orthographic window that reached through a wall.
    #[test]
    fn dark_rooms_are_seen_from_within() {
        let seeds: Vec<u64> = (0..3000).filter(|&seed| kind(seed) == "dark room").chain([90766]).collect();
        assert!(seeds.len() > 100, "{} dark rooms", seeds.len());
        for seed in seeds {
            let desc = case(seed, 16).world.desc;
            let camera = &desc.camera;
            let beyond = matches!(camera.projection, Projection::Orthographic { .. }) || camera.near.is_some();
            assert!(!beyond && desc.effects.depth_of_field.is_none(), "{seed}");
        }
    }
}
