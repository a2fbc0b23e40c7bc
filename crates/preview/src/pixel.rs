//! The pixel inspector: what a pixel is, and what is seen there.

use crate::shared::{Frame, Stage};
use crate::told::{Place, of_span};
use scene_format::diagnostic::{Source, Span};
use serde::Serialize;
use std::path::Path;
use tracer_core::{Crop, LayerSet, RenderOptions, Unobserved, render};

/// Samples that tell what is seen: a pixel's edge is where it is by a sixteenth.
const SAMPLES: u32 = 16;

/// A pixel, and what is seen there.
#[derive(Debug, Serialize)]
pub struct Pixel {
    pub x: u32,
    pub y: u32,
    /// Linear radiance, in W/(sr m^2), before exposure.
    pub radiance: [f64; 3],
    /// What is seen nearest to its middle.
    pub object: Option<Named>,
    pub material: Option<Named>,
    /// All layers, by name.
    pub layers: Vec<LayerValue>,
}

/// A thing of the scene.
#[derive(Debug, Serialize)]
pub struct Named {
    /// `objects[3] Sphere`, `glass`
    pub name: String,
    /// Where it is written.
    pub place: Option<Place>,
}

/// A layer at a pixel.
#[derive(Debug, Serialize)]
pub struct LayerValue {
    pub name: &'static str,
    /// What is infinite is null.
    pub values: Vec<f32>,
}

/// A pixel of a frame's picture. What is seen there is rendered for this pixel alone, which takes no time worth naming.
pub fn at(stage: &Stage, frame: &Frame, [x, y]: [u32; 2], scene: &Path) -> Option<Pixel> {
    let size = stage.scene.size;
    if x >= size[0] || y >= size[1] {
        return None;
    }
    // A draft has fewer pixels.
    let of_film = frame.film.size();
    let place = |axis: usize, k: u32| (u64::from(k) * u64::from(of_film[axis]) / u64::from(size[axis])) as u32;
    let radiance = frame.film.radiance(place(0, x), place(1, y));
    let options = RenderOptions {
        samples: Some(SAMPLES),
        crop: Some(Crop { x, y, width: 1, height: 1 }),
        reuse: Some(false),
        caustics: Some(false),
        layers: Some(LayerSet::all()),
        light_groups: Some(false),
        threads: 1,
        ..RenderOptions::default()
    };
    let film = render(&stage.scene, &options, &Unobserved);
    let layers: Vec<LayerValue> = film
        .layers()
        .iter()
        .filter_map(|layer| film.layer(layer))
        .map(|image| LayerValue { name: image.name, values: image.values })
        .collect();
    let number = |name: &str| {
        let layer = layers.iter().find(|layer| layer.name == name);
        layer.and_then(|layer| layer.values.first()).map_or(0, |&number| number as usize)
    };
    let object = number("object_id").checked_sub(1).and_then(|k| object(stage, k, scene));
    let material = number("material_id").checked_sub(1).map(|k| material(stage, k, scene));
    Some(Pixel { x, y, radiance, object, material, layers })
}

fn object(stage: &Stage, k: usize, scene: &Path) -> Option<Named> {
    let desc = &stage.desc;
    let (list, k, span) = match desc.objects.get(k) {
        Some(object) => ("objects", k, object.span),
        None => {
            let k = k - desc.objects.len();
            ("lights", k, desc.lights.get(k)?.span)
        }
    };
    let kind = first_word(&desc.sources, span);
    Some(Named {
        name: format!("{list}[{k}] {kind}").trim_end().to_owned(),
        place: of_span(span, &desc.sources, scene),
    })
}

fn material(stage: &Stage, k: usize, scene: &Path) -> Named {
    match stage.desc.materials.get(k) {
        Some(named) => {
            Named { name: named.name.value.to_string(), place: of_span(named.name.span, &stage.desc.sources, scene) }
        }
        None => Named { name: "without a name".to_owned(), place: None },
    }
}

/// `Sphere` of `Sphere(center: ..)`.
fn first_word(sources: &[Source], span: Span) -> &str {
    let text = sources.get(span.source as usize).map_or("", |source| source.text.as_str());
    let text = text
        .get(span.start as usize..span.end as usize)
        .unwrap_or("")
        .trim_start_matches(['{', ' ', '"', '\n', '\r', '\t']);
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..end]
}
