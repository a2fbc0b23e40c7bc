//! Spheres around the casters, at which rays from diffuse surfaces are aimed (`engine::stages::aim`).

use super::casters::Casters;
use crate::scene::Scene;

/// At so many spheres at most; more casters are taken together. Every aimed ray looks at all of them.
pub const MOST: usize = 16;

/// The spheres, as columns.
pub struct Aims {
    /// Middle.
    pub center: [Vec<f32>; 3],
    /// Squared radius.
    pub radius2: Vec<f32>,
}

impl Aims {
    /// Those of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut aims = Aims { center: Default::default(), radius2: Vec::new() };
        for caster in Casters::new(scene, MOST).list.iter().take(MOST) {
            for (column, x) in aims.center.iter_mut().zip(caster.center.to_array()) {
                column.push(x as f32);
            }
            aims.radius2.push((caster.radius * caster.radius) as f32);
        }
        aims
    }

    /// Number of spheres.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.radius2.len()
    }

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.radius2.is_empty()
    }
}
