//! The camera, from its words to what the kernels read.

use glam::DVec3;
use scene_format::desc::{self, PixelFilter, SceneDesc, ThinLens};
use tracer_kernels::scene::{Camera, Filter, FisheyeMapping, Frame, Lens, Projection, Stereo};

/// In render space.
pub(super) fn camera(desc: &SceneDesc, frame: &Frame) -> Camera {
    let written = &desc.camera;
    let eye = DVec3::from(written.position.value);
    let forward = (DVec3::from(written.look_at.value) - eye).normalize();
    let right = forward.cross(DVec3::from(written.up.value).normalize()).normalize();
    let up = right.cross(forward);
    // Of two eyes the picture of one.
    let size = written.size_for_one_eye([desc.image.width.value, desc.image.height.value].map(f64::from));
    let [width, height] = size;
    let (projection, [half_height, half_width]) = match &written.projection {
        desc::Projection::Perspective => {
            let half = written.half_extents(size);
            // In picture heights.
            let shift = [written.shift.value[0] * 2.0 * half[0] / half[1], written.shift.value[1] * 2.0];
            let lens = desc.effects.depth_of_field.as_ref();
            let lens = lens.and_then(|lens| of_lens(lens, written, [right, up, forward], frame));
            (Projection::Perspective { shift, lens }, half)
        }
        desc::Projection::Orthographic { height: seen } => {
            let half = frame.length(seen.value) / 2.0;
            (Projection::Orthographic, [half, half * width / height])
        }
        desc::Projection::Panorama => (Projection::Panorama, [1.0; 2]),
        desc::Projection::Fisheye { fov, mapping } => {
            let half_angle = fov.value.to_radians() / 2.0;
            let (mapping, scale) = match mapping {
                desc::FisheyeMapping::Equidistant => (FisheyeMapping::Equidistant, half_angle),
                desc::FisheyeMapping::Equisolid => (FisheyeMapping::Equisolid, libm::sin(half_angle / 2.0)),
                desc::FisheyeMapping::Stereographic => (FisheyeMapping::Stereographic, libm::tan(half_angle / 2.0)),
                desc::FisheyeMapping::Orthographic => (FisheyeMapping::Orthographic, libm::sin(half_angle)),
            };
            let shorter = width.min(height);
            (Projection::Fisheye { mapping, scale }, [height / shorter, width / shorter])
        }
    };
    let mut eye = frame.point(eye);
    let (right, up) = (right * half_width, up * half_height);
    if projection == Projection::Orthographic {
        eye +=
            2.0 * half_height * (written.shift.value[0] * right.normalize() + written.shift.value[1] * up.normalize());
    }
    Camera {
        eye,
        forward,
        right,
        up,
        projection,
        stereo: written.stereo.as_ref().map(|stereo| eyes(stereo, half_width, projection, frame)),
        near: written.near.as_ref().map_or(0.0, |near| frame.length(near.value)),
        filter: filter(&desc.effects.antialiasing),
    }
}

/// Two eyes, each of which sees so much to either side at distance one.
fn eyes(stereo: &desc::Stereo, half_width: f64, projection: Projection, frame: &Frame) -> Stereo {
    let aside = stereo.separation.value / 2.0;
    let inwards = match (&stereo.convergence, projection) {
        // What lies ahead of the middle at this distance is so far beside each eye's own axis.
        (Some(distance), Projection::Perspective { .. }) => aside / distance.value / half_width,
        _ => 0.0,
    };
    Stereo { aside: frame.length(aside), inwards, above: stereo.layout == desc::StereoLayout::TopBottom }
}

/// Of a camera with these axes; none where it has no width.
fn of_lens(lens: &ThinLens, camera: &desc::Camera, [right, up, forward]: [DVec3; 3], frame: &Frame) -> Option<Lens> {
    if lens.aperture.value == 0.0 {
        return None;
    }
    let blades = lens.blades.value;
    let disc = frame.length(lens.aperture.value / 2.0);
    let radius = if blades < 3 {
        disc
    } else {
        // The polygon is as large as the disc: n / 2 R^2 sin(2 pi / n) = pi r^2.
        let n = f64::from(blades);
        disc * libm::sqrt(std::f64::consts::TAU / (n * libm::sin(std::f64::consts::TAU / n)))
    };
    let (distance, tilted) = lens.plane_of_focus(camera);
    let tilted = tilted.map(|[along_right, along_up, _]| forward + along_right * right + along_up * up);
    Some(Lens {
        radius,
        focus_distance: frame.length(distance),
        blades: if blades < 3 { 0 } else { blades },
        rotation: lens.rotation.value.rem_euclid(360.0) / 360.0,
        tilted,
    })
}

fn filter(filter: &PixelFilter) -> Filter {
    match filter {
        PixelFilter::None => Filter::Centre,
        PixelFilter::Box => Filter::Box,
        PixelFilter::Gaussian { sigma } if sigma.value == 0.0 => Filter::Centre,
        PixelFilter::Gaussian { sigma } => Filter::Gaussian(sigma.value),
        PixelFilter::BlackmanHarris { radius } => Filter::BlackmanHarris(radius.value),
    }
}
