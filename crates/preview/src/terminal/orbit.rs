//! The camera moved by keys.

use crate::shared::Pose;
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

/// So near to `up` the camera does not come, in radians: there it would not know which way is up.
const STEEPEST: f64 = 0.02;

/// The camera turned about what it looks at, to its right and upward, by angles in radians.
pub fn orbit(pose: &Pose, right: f64, above: f64) -> Pose {
    let [position, look_at, up] = [pose.position, pose.look_at, pose.up].map(DVec3::from_array);
    let Some(up) = up.try_normalize() else { return *pose };
    let arm = DQuat::from_axis_angle(up, right) * (position - look_at);
    let Some(side) = up.cross(arm).try_normalize() else { return *pose };
    let now = arm.angle_between(up);
    let wanted = (now - above).clamp(STEEPEST, PI - STEEPEST);
    let arm = DQuat::from_axis_angle(side, wanted - now) * arm;
    Pose { position: (look_at + arm).to_array(), ..*pose }
}

/// The camera nearer to what it looks at, or farther: by a factor of the distance.
pub fn dolly(pose: &Pose, factor: f64) -> Pose {
    let [position, look_at] = [pose.position, pose.look_at].map(DVec3::from_array);
    Pose { position: (look_at + (position - look_at) * factor).to_array(), ..*pose }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::check;

    #[test]
    fn orbits_go_round_and_stop_at_the_poles() {
        let pose = Pose {
            position: [1.0, 0.0, 5.0],
            look_at: [1.0, 0.0, 0.0],
            up: [0.0, 2.0, 0.0],
            fov: Some(40.0),
            focal_length: None,
            height: None,
        };
        let near = |pose: &Pose, position: [f64; 3]| {
            let far = (0..3).map(|axis| (pose.position[axis] - position[axis]).abs()).fold(0.0, f64::max);
            assert!(far < 1e-12, "{:?} is not {position:?}", pose.position);
        };
        near(&orbit(&pose, PI / 2.0, 0.0), [6.0, 0.0, 0.0]);
        near(&orbit(&pose, 0.0, PI / 6.0), [1.0, 2.5, 5.0 * 0.75f64.sqrt()]);
        near(&orbit(&orbit(&pose, 0.3, 0.2), -0.3, -0.2), pose.position);
        for above in [-9.0, 9.0] {
            let steep = orbit(&pose, 0.0, above);
            assert_eq!(check(&steep), Ok(()), "{steep:?}");
            assert!(steep.position[1].abs() > 4.99);
        }
        near(&dolly(&pose, 0.5), [1.0, 0.0, 2.5]);
        let lost = Pose { up: [0.0; 3], ..pose };
        assert_eq!(orbit(&lost, 1.0, 1.0), lost);
    }
}
