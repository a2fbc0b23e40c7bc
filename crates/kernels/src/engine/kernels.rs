//! The entry functions: each stage compiled once per lane type inside a function with the CPU's features, and the
//! choice of them.

use super::batch::Batch;
use super::guide::Guide;
use super::guide::plan::Plan;
use super::pass::{Pass, PhotonPass};
use super::stages::light_paths::LightPass;
use super::stages::shaft::Obstacles;
use super::stages::{aim, ambient, camera, first_hits, light_paths, photons, reach, seen, shade, share, spheres};
use crate::bvh::TopBoxes;
use crate::lanes::ArrayF;
#[cfg(target_arch = "x86_64")]
use crate::lanes::{F8, F16, Pair};
use crate::layers::LayerSet;
use crate::level::{Level, Set};
use crate::scene::{ConductorTable, Scene, SphereTable};

/// The stages for one lane type. Calling them is `unsafe`: the CPU must have the features of the level they come from.
#[derive(Clone, Copy)]
pub struct Kernels {
    level: Level,
    camera: unsafe fn(&Scene, u32, u32, &mut Batch),
    closest: unsafe fn(&SphereTable, &mut Batch),
    first_hits: unsafe fn(&Scene, u32, LayerSet, &mut Batch),
    seen: unsafe fn(&Scene, LayerSet, u32, &mut Batch),
    lamps: unsafe fn(&Scene, u32, &mut Batch),
    shade: unsafe fn(&Scene, Pass<'_>, u32, &mut Batch),
    ambient: unsafe fn(&Scene, u32, f32, &mut Batch),
    occluded: unsafe fn(&SphereTable, &mut Batch),
    reach_closest: unsafe fn(&TopBoxes, &mut Batch),
    reach_occluded: unsafe fn(&TopBoxes, &mut Batch),
    aim: unsafe fn(Option<&ConductorTable>, &Guide, u32, u32, &mut Batch),
    share_segments: unsafe fn(&Scene, &Obstacles, usize, &mut Batch) -> usize,
    share_gather: unsafe fn(&mut Batch),
    photons_emit: unsafe fn(&Scene, &Plan, PhotonPass<'_>, &mut Batch),
    photons_scatter: unsafe fn(&Scene, &Plan, u32, u32, &mut Batch),
    light_paths: unsafe fn(&Scene, LightPass<'_>, u32, &mut Batch),
}

/// The entry functions of a level: the lanes of all stages but those of the spheres, and of those.
macro_rules! kernels {
    ($name:ident, $lanes:ty, $of_spheres:ty $(, $features:literal)?) => {
        mod $name {
            use super::*;
            $(#[target_feature(enable = $features)])?
            fn camera_entry(scene: &Scene, seed: u32, items: u32, batch: &mut Batch) {
                camera::camera::<$lanes>(scene, seed, items, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn closest_entry(of: &SphereTable, batch: &mut Batch) {
                spheres::spheres_closest::<$of_spheres>(of, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn first_hits_entry(scene: &Scene, seed: u32, layers: LayerSet, batch: &mut Batch) {
                first_hits::first_hits::<$lanes>(scene, seed, layers, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn seen_entry(scene: &Scene, layers: LayerSet, vertex: u32, batch: &mut Batch) {
                seen::seen::<$lanes>(scene, layers, vertex, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn lamps_entry(scene: &Scene, vertex: u32, batch: &mut Batch) {
                seen::lamps::<$lanes>(scene, vertex, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn shade_entry(scene: &Scene, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
                shade::shade::<$lanes>(scene, pass, vertex, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn ambient_entry(scene: &Scene, seed: u32, distance: f32, batch: &mut Batch) {
                ambient::ambient::<$lanes>(scene, seed, distance, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn occluded_entry(of: &SphereTable, batch: &mut Batch) {
                spheres::spheres_occluded::<$of_spheres>(of, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn reach_closest_entry(boxes: &TopBoxes, batch: &mut Batch) {
                reach::reach_closest::<$lanes>(boxes, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn reach_occluded_entry(boxes: &TopBoxes, batch: &mut Batch) {
                reach::reach_occluded::<$lanes>(boxes, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn aim_entry(metals: Option<&ConductorTable>, guide: &Guide, seed: u32, vertex: u32, batch: &mut Batch) {
                aim::aim::<$lanes>(metals, guide, seed, vertex, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn share_segments_entry(scene: &Scene, obstacles: &Obstacles, next: usize, batch: &mut Batch) -> usize {
                share::share_segments::<$lanes>(scene, obstacles, next, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn share_gather_entry(batch: &mut Batch) {
                share::share_gather::<$lanes>(batch)
            }
            $(#[target_feature(enable = $features)])?
            fn photons_emit_entry(scene: &Scene, plan: &Plan, pass: PhotonPass<'_>, batch: &mut Batch) {
                photons::photons_emit::<$lanes>(scene, plan, pass, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn photons_scatter_entry(scene: &Scene, plan: &Plan, seed: u32, event: u32, batch: &mut Batch) {
                photons::photons_scatter::<$lanes>(scene, plan, seed, event, batch)
            }
            $(#[target_feature(enable = $features)])?
            fn light_paths_entry(scene: &Scene, pass: LightPass<'_>, event: u32, batch: &mut Batch) {
                light_paths::light_paths::<$lanes>(scene, pass, event, batch)
            }
            pub fn kernels(level: Level) -> Kernels {
                Kernels {
                level,
                camera: camera_entry,
                closest: closest_entry,
                first_hits: first_hits_entry,
                seen: seen_entry,
                lamps: lamps_entry,
                shade: shade_entry,
                ambient: ambient_entry,
                occluded: occluded_entry,
                reach_closest: reach_closest_entry,
                reach_occluded: reach_occluded_entry,
                aim: aim_entry,
                share_segments: share_segments_entry,
                share_gather: share_gather_entry,
                photons_emit: photons_emit_entry,
                photons_scatter: photons_scatter_entry,
                light_paths: light_paths_entry,
                }
            }
        }
    };
}

type One = ArrayF<1>;
#[cfg(not(target_arch = "x86_64"))]
type Eight = ArrayF<8>;

kernels!(portable, One, One);
#[cfg(not(target_arch = "x86_64"))]
kernels!(portable_8, Eight, Eight);
#[cfg(target_arch = "x86_64")]
kernels!(scalar_fma, One, One, "fma");
// The spheres' chains of operations are long: with twice the lanes they take a tenth less time on Zen 3. Shading takes
// as much more.
#[cfg(target_arch = "x86_64")]
kernels!(avx2, F8, Pair<F8>, "avx2,fma,bmi1,bmi2,lzcnt,popcnt");
#[cfg(target_arch = "x86_64")]
kernels!(avx512, F16, F16, "avx512f,avx512vl,avx512dq,avx512bw,avx512cd,avx2,fma,bmi1,bmi2,lzcnt,popcnt");

impl Kernels {
    /// The stages for a level.
    pub fn new(level: Level) -> Self {
        match level.set() {
            Set::Portable => portable::kernels(level),
            #[cfg(not(target_arch = "x86_64"))]
            Set::Portable8 => portable_8::kernels(level),
            #[cfg(target_arch = "x86_64")]
            Set::Scalar => scalar_fma::kernels(level),
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => avx2::kernels(level),
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => avx512::kernels(level),
        }
    }

    /// The level that they are for: the tree is asked with its instructions, too.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Camera rays for those items of the batch that have a bit set in `items`.
    pub fn camera(&self, scene: &Scene, seed: u32, items: u32, batch: &mut Batch) {
        // SAFETY: `new` took the entry of a `Level`, which exists only where the CPU has the features that the entry
        // was compiled for.
        unsafe { (self.camera)(scene, seed, items, batch) }
    }
    /// The nearest of the spheres that every ray tests.
    pub fn closest(&self, of: &SphereTable, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.closest)(of, batch) }
    }
    /// What the camera rays of the batch hit first, for these layers.
    pub fn first_hits(&self, scene: &Scene, seed: u32, layers: LayerSet, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.first_hits)(scene, seed, layers, batch) }
    }
    /// What the paths of vertex `vertex` see over mirrors and through glass, for these layers.
    pub fn seen(&self, scene: &Scene, layers: LayerSet, vertex: u32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.seen)(scene, layers, vertex, batch) }
    }
    /// What the paths show of lamps, straight or over mirrors and glass only, or in what is nearly a mirror.
    pub fn lamps(&self, scene: &Scene, vertex: u32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.lamps)(scene, vertex, batch) }
    }
    /// Shades the hits of a vertex.
    pub fn shade(&self, scene: &Scene, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.shade)(scene, pass, vertex, batch) }
    }
    /// Rays of this length from what camera rays have hit, for ambient occlusion.
    pub fn ambient(&self, scene: &Scene, seed: u32, distance: f32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.ambient)(scene, seed, distance, batch) }
    }
    /// Which shadow rays the spheres block.
    pub fn occluded(&self, of: &SphereTable, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.occluded)(of, batch) }
    }
    /// Aimed rays from the rough surfaces of vertex `vertex`.
    pub fn aim(&self, scene: &Scene, guide: &Guide, seed: u32, vertex: u32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.aim)(scene.tables.materials.conductors.as_ref(), guide, seed, vertex, batch) }
    }
    /// Segments from suffix `next` on; gives the suffix to go on with.
    pub fn share_segments(&self, scene: &Scene, obstacles: &Obstacles, next: usize, batch: &mut Batch) -> usize {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.share_segments)(scene, obstacles, next, batch) }
    }
    /// Each member's share of each suffix.
    pub fn share_gather(&self, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.share_gather)(batch) }
    }
    /// First rays of photons.
    pub fn photons_emit(&self, scene: &Scene, plan: &Plan, pass: PhotonPass<'_>, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.photons_emit)(scene, plan, pass, batch) }
    }
    /// What becomes of photons where they hit, after `event` mirrors and glass.
    pub fn photons_scatter(&self, scene: &Scene, plan: &Plan, seed: u32, event: u32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.photons_scatter)(scene, plan, seed, event, batch) }
    }
    /// What becomes of light paths where they hit, after `event` mirrors and glass.
    pub fn light_paths(&self, scene: &Scene, pass: LightPass<'_>, event: u32, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.light_paths)(scene, pass, event, batch) }
    }
    /// Which paths the tree is asked about.
    pub fn reach_closest(&self, boxes: &TopBoxes, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.reach_closest)(boxes, batch) }
    }
    /// Which shadow rays the tree is asked about.
    pub fn reach_occluded(&self, boxes: &TopBoxes, batch: &mut Batch) {
        // SAFETY: as in `camera`: the CPU has the features of the level whose entry this is.
        unsafe { (self.reach_occluded)(boxes, batch) }
    }
}
