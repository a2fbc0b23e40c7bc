//! One sample of a pixel, explained: the path that the plain path tracer follows for it, vertex by vertex, and what the
//! techniques of the default bring beside it.
//!
//! It is no renderer of its own: the stages that make pictures are run on one path at a time, and what stands in the
//! batch between them is read. That all contributions sum to the very number that a batch of pictures has is checked
//! each time.

mod path;
mod told;
mod whole;

pub use told::{
    Brought, Ended, Inspection, LightOf, MetTold, PathTold, Roulette, SampledTold, Scattering, Shared, Told,
    VertexTold, Whole,
};

use super::passes::Painter;
use super::technique::Engine;
use super::{RenderOptions, quarter_of};
use crate::film::{Crop, Part};
use crate::scene::Scene;
use tracer_kernels::engine::batch::Batch;
use tracer_kernels::engine::kernels::Kernels;
use tracer_kernels::layers::LayerSet;
use tracer_kernels::level::Level;
use tracer_kernels::sampling::blocks::ITEM_PIXELS;
use tracer_kernels::scene::Integrator;

/// Explains a sample of a pixel, lit by all lights at once also where the picture tells light groups apart; `None`
/// where the picture has no such pixel or is of no light (`render.integrator: AmbientOcclusion`), or something is
/// wrong with the scene as the sample sees it ([`Scene::at_sample`]).
///
/// # Examples
///
/// ```
/// use scene_format::{Syntax, load_str};
/// use std::path::Path;
/// use tracer_core::{RenderOptions, compile, inspect};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = r#"Scene(
///     image: Image(width: 9, height: 9),
///     lights: [SphereLight(center: (2, 3, 4), radius: 1, power: 500)],
///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
/// )"#;
/// let loaded = load_str("ball.ron", text, Syntax::Ron, Path::new("."), &[])?;
/// let scene = compile(&loaded.scene)?;
/// let told = inspect(&scene, &RenderOptions::default(), [4, 4], 0).ok_or("the picture has it")?;
/// assert!(told.path.agrees);
/// let first = &told.path.vertices[0];
/// assert!((first.told.as_ref().ok_or("the ball is hit")?.point[2] - 1.0).abs() < 0.1);
/// # Ok(())
/// # }
/// ```
pub fn inspect(scene: &Scene, options: &RenderOptions, pixel: [u32; 2], sample: u32) -> Option<Inspection> {
    let is_there = pixel.iter().zip(scene.size).all(|(&k, size)| k < size) && sample < u32::MAX;
    if !is_there || matches!(scene.integrator, Integrator::AmbientOcclusion { .. }) {
        return None;
    }
    let crop = Crop { x: pixel[0], y: pixel[1], width: 1, height: 1 };
    let part = Part { crop, first: sample, end: sample + 1, of_crop: crop, of_samples: sample + 1 };
    let kernels = Kernels::new(options.level.unwrap_or_else(Level::best));
    let seed = options.seed.unwrap_or(scene.seed);
    let quarter = quarter_of(scene, pixel, sample, seed);
    let now = scene.at_sample(sample, quarter, seed).transpose().ok()?;
    let engine = Engine::new(now.as_ref().unwrap_or(scene), &kernels);
    let all = RenderOptions { part: Some(part), layers: Some(LayerSet::default()), ..*options };
    let plain = RenderOptions { reuse: Some(false), caustics: Some(false), ..all };
    let path = path::follow(engine, &plain, pixel, sample)?;
    let whole = whole::explain(engine, (scene, quarter), &all, pixel, sample)?;
    Some(Inspection { pixel, sample, path, whole })
}

/// Makes a batch's items those of the block that holds a pixel; gives the pixel's slot.
fn fill(painter: &Painter<'_>, pixel: [u32; 2], sample: u32, batch: &mut Batch) -> Option<usize> {
    for place in painter.places_now() {
        painter.fill(&(place..place + 1), sample..sample + 1, batch);
        painter.lightings[0].mark(batch);
        batch.pixels.find(&batch.items);
        let at = pixel.map(|k| k as f32);
        let slots = batch.items.len() * ITEM_PIXELS;
        let found = (0..slots).find(|&slot| [batch.pixels.x[slot], batch.pixels.y[slot]] == at);
        if found.is_some() {
            return found;
        }
    }
    None
}

/// The radiance of a slot.
fn radiance(batch: &Batch, slot: usize) -> [f32; 3] {
    [0, 1, 2].map(|c| batch.radiance[c][slot])
}
