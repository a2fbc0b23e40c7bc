//! How far what is seen moves in the picture within a frame, in pixels to the right and downwards: as fast as it does
//! on average while the shutter is open. Compositors blur or follow it by that.

use super::{FirstHit, PictureLayer, Pixel};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use glam::DVec3;

pub(super) struct Motion;

/// Lanes of the widest registers.
const MOST: usize = 32;

impl PictureLayer for Motion {
    const NAME: &'static str = "motion";
    const CHANNELS: &'static [&'static str] = &["X", "Y"];
    // What is not there does not move; depth tells where nothing is hit.
    const PIXEL: Pixel = Pixel::MeanOfHits(0.0);

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        let (mut x, mut y) = ([0.0; MOST], [0.0; MOST]);
        if hit.scene.ends.is_some() {
            let columns = |v: V3<F>| {
                let mut columns = [[0.0; MOST]; 3];
                [v.0, v.1, v.2].into_iter().zip(&mut columns).for_each(|(of, column)| of.store(column));
                columns
            };
            let point = hit.surface.p;
            let (points, origins) = (columns(point), columns(point.sub(hit.direction.scale(hit.t))));
            let (mut body, mut primitive) = ([0; MOST], [0; MOST]);
            hit.surface.body.store(&mut body);
            hit.surface.primitive.store(&mut primitive);
            let bits = hit.valid.bits();
            for lane in (0..F::N).filter(|lane| bits >> lane & 1 == 1) {
                let of =
                    |columns: &[[f32; MOST]; 3]| DVec3::from([0, 1, 2].map(|k: usize| f64::from(columns[k][lane])));
                let moved = hit.scene.motion(body[lane], primitive[lane], of(&origins), of(&points));
                [x[lane], y[lane]] = moved.map(|pixels| pixels as f32);
            }
        }
        [F::load(&x), F::load(&y), F::splat(0.0)]
    }
}
