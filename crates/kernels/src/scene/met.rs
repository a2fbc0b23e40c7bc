//! What rays meet: all there is, or, where objects are hidden from the camera, what a camera ray meets of it.
//!
//! Camera rays have a tree and lists of their own then, without what is hidden. So no ray asks whether it may see what
//! it meets, and scenes in which nothing is hidden pay nothing. All numbers are those of the scene.

use super::{NONE, PlaneTable, Scene, SphereTable};
use crate::bvh::Accel;
use std::sync::Arc;

/// What finds hits.
#[derive(Clone, Copy)]
pub struct Met<'a> {
    /// Spheres that every ray tests.
    pub spheres: &'a SphereTable,
    /// Planes.
    pub planes: &'a PlaneTable,
    /// The tree.
    pub accel: Option<&'a Accel>,
}

/// What camera rays meet of a scene of which they do not meet all.
pub struct CameraSees {
    /// Which objects they pass, by their place in the scene.
    pub hidden: Vec<bool>,
    /// Spheres that every ray tests.
    pub spheres: SphereTable,
    /// Planes.
    pub planes: PlaneTable,
    /// The tree; `None` where nothing of what they see hangs in one.
    pub accel: Option<Arc<Accel>>,
}

impl Scene {
    /// What rays meet; `camera`: they come from there, or go straight to it.
    #[inline(always)]
    pub fn met(&self, camera: bool) -> Met<'_> {
        match &self.camera_sees {
            Some(seen) if camera => Met { spheres: &seen.spheres, planes: &seen.planes, accel: seen.accel.as_deref() },
            _ => Met { spheres: &self.tables.spheres, planes: &self.tables.planes, accel: self.accel.as_deref() },
        }
    }

    /// Whether an object is hidden from the camera, by its place in the scene.
    pub fn is_hidden(&self, object: u32) -> bool {
        self.camera_sees.as_ref().is_some_and(|seen| seen.hidden.get(object as usize).copied().unwrap_or(false))
    }

    /// Whether what a primitive is of is hidden from the camera.
    pub fn is_hidden_primitive(&self, primitive: u32, instance: u32) -> bool {
        if self.camera_sees.is_none() {
            return false;
        }
        let first = self.spheres.len();
        let object = match (instance, primitive as usize) {
            (NONE, k) if k < first => self.spheres[k].object,
            (NONE, k) => self.shapes.get(k - first).map_or(NONE, |shape| shape.object),
            (instance, _) => self.instances.get(instance as usize).map_or(NONE, |instance| instance.object),
        };
        self.is_hidden(object)
    }
}
