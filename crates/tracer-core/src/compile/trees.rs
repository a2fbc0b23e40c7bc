//! The trees: over all there is, and, where objects are hidden from the camera, over what its rays meet.

use super::{CompileError, Sources, meshes};
use scene_format::desc::Integrator;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, SceneDesc, codes};
use std::sync::Arc;
use tracer_kernels::bvh::{self, LeftOut};
use tracer_kernels::scene::{CameraSees, Material, PlaneTable, Shape, Solids, Sphere, SphereTable};

/// Which objects are hidden from the camera, by their place in the scene, lamps that are no objects behind them; none
/// where none is.
fn hidden(desc: &SceneDesc) -> Vec<bool> {
    let objects = desc.objects.iter().map(|object| !object.value.camera_visible());
    let hidden: Vec<bool> = objects.chain(desc.lights.iter().map(|light| !light.value.camera_visible())).collect();
    if hidden.contains(&true) { hidden } else { Vec::new() }
}

/// What trees are made of.
pub(super) struct Hung<'a> {
    pub(super) spheres: &'a [Sphere],
    /// So many of the first spheres hang in trees; all others every ray tests.
    pub(super) in_tree: usize,
    pub(super) shapes: &'a [Shape],
    pub(super) solids: &'a Solids,
    pub(super) built: &'a meshes::Built,
    pub(super) materials: &'a [Material],
    pub(super) sources: &'a Sources<'a>,
}

/// All trees of a scene.
pub(super) struct Trees {
    /// What rays meet.
    pub(super) accel: Option<Arc<bvh::Accel>>,
    /// What camera rays meet, where some objects are hidden from them.
    pub(super) camera_sees: Option<Arc<CameraSees>>,
    /// Who shares what goes by its boxes.
    pub(super) hierarchy: Option<Arc<bvh::Accel>>,
}

impl Hung<'_> {
    /// Builds all that a scene needs.
    ///
    /// # Errors
    /// The scene cannot be traced.
    pub(super) fn trees(
        &self,
        desc: &SceneDesc,
        acceleration: bvh::Acceleration,
        spheres: &SphereTable,
        planes: &PlaneTable,
    ) -> Result<Trees, CompileError> {
        let accel = self.tree(acceleration, &[])?;
        let camera_sees = self.camera_sees(acceleration, hidden(desc), spheres, planes)?;
        let full = desc.render.integrator == Integrator::Full;
        // Who shares what goes by the boxes of the hierarchy, whatever finds the hits: the picture must not depend on
        // that.
        let hierarchy = match &accel {
            Some(_) if acceleration != bvh::Acceleration::Bvh && full => self.tree(bvh::Acceleration::Bvh, &[])?,
            accel => accel.clone(),
        };
        Ok(Trees { accel, camera_sees, hierarchy })
    }

    /// The tree over meshes, curved shapes and those spheres that are too many to be tested by every ray, without
    /// hidden objects; none when there is nothing to hang in it.
    fn tree(&self, acceleration: bvh::Acceleration, hidden: &[bool]) -> Result<Option<Arc<bvh::Accel>>, CompileError> {
        let is_hidden = |object: u32| LeftOut::holds(hidden, object as usize);
        let spheres: Vec<bool> = self.spheres[..self.in_tree].iter().map(|sphere| is_hidden(sphere.object)).collect();
        let shapes: Vec<bool> = self.shapes.iter().map(|shape| is_hidden(shape.object)).collect();
        let instances: Vec<bool> = self.built.of_copies.iter().map(|&[_, object]| is_hidden(object)).collect();
        let bounded = shapes.iter().zip(self.shapes).filter(|(_, shape)| !shape.unit.is_endless());
        if spheres.iter().chain(&instances).chain(bounded.map(|(hidden, _)| hidden)).all(|&hidden| hidden) {
            return Ok(None);
        }
        let hung: Vec<bvh::SphereGeometry> =
            self.spheres[..self.in_tree].iter().map(|s| bvh::SphereGeometry::new(s.center, s.radius)).collect();
        let left_out = match hidden.is_empty() {
            true => LeftOut::default(),
            false => LeftOut { spheres: &spheres, shapes: &shapes, instances: &instances },
        };
        let first = self.spheres.len() as u32;
        let of_shapes = (self.shapes, self.solids);
        let built = self.built.tree(acceleration, &hung, of_shapes, first, self.materials, self.sources, left_out);
        built.map(Some).map_err(|error| {
            let message = format!("the scene cannot be traced: {error}");
            let fault = Diagnostic::error(codes::UNTRACEABLE, Span::NONE, message)
                .hint("bring the sizes and distances of the objects closer together");
            CompileError { diagnostics: vec![fault] }
        })
    }

    /// What camera rays meet, where some objects are hidden from them.
    fn camera_sees(
        &self,
        acceleration: bvh::Acceleration,
        hidden: Vec<bool>,
        spheres: &SphereTable,
        planes: &PlaneTable,
    ) -> Result<Option<Arc<CameraSees>>, CompileError> {
        if hidden.is_empty() {
            return Ok(None);
        }
        let is_hidden = |object: u32| LeftOut::holds(&hidden, object as usize);
        let of_spheres: Vec<bool> = self.spheres.iter().map(|sphere| is_hidden(sphere.object)).collect();
        let of_shapes: Vec<bool> = self.shapes.iter().map(|shape| is_hidden(shape.object)).collect();
        let accel = self.tree(acceleration, &hidden)?;
        let (spheres, planes) = (spheres.seen(&of_spheres), planes.seen(&of_shapes, self.spheres.len() as u32));
        Ok(Some(Arc::new(CameraSees { hidden, spheres, planes, accel })))
    }
}
