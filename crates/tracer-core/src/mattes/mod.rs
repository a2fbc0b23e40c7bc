//! Mattes: of each pixel how much of it which object or material covers, as compositing programs want it (Cryptomatte),
//! and masks of single names. Made of what a film has counted ([`Film::matte`]) and of the names in the scene.

mod cryptomatte;
mod hash;

use crate::film::{Crop, Film, MatteOf, MattesKept};
use cryptomatte::cryptomatte;
use rayon::prelude::*;
use scene_format::SceneDesc;
use scene_format::desc::{Matte, Output};

/// What mattes a picture has, and what is called how.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mattes {
    /// What Cryptomatte tells apart.
    pub cryptomatte: Vec<MatteOf>,
    /// The names that masks are made of.
    pub masks: Vec<String>,
    /// Of each object, then of each light, its name, or where it stands in the scene: `objects[3] Sphere`. Empty where
    /// neither is asked for; so are the materials.
    pub objects: Vec<String>,
    /// Of each material.
    pub materials: Vec<String>,
}

/// Channels that mattes bring to an EXR file, and what it says of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MatteImage {
    /// Names of channels, `mask.lamp.Y`, and their pixels row by row from the top.
    pub channels: Vec<(String, Vec<f32>)>,
    /// Names of attributes and their texts.
    pub attributes: Vec<(String, String)>,
}

/// What the film has to count for the mattes of a picture.
pub fn mattes_kept(output: &Output) -> MattesKept {
    MattesKept {
        objects: output.cryptomatte.contains(&Matte::Objects) || !output.masks.is_empty(),
        materials: output.cryptomatte.contains(&Matte::Materials),
    }
}

/// The name of an object, or where it stands in the scene; behind them come the lights.
pub fn object_name(desc: &SceneDesc, number: usize) -> String {
    let name = |name: Option<&str>, list: &str, k: usize, kind: &str| {
        name.map_or_else(|| format!("{list}[{k}] {kind}"), str::to_owned)
    };
    if let Some(object) = desc.objects.get(number) {
        return name(object.value.name().as_str(), "objects", number, object.value.kind());
    }
    let k = number.saturating_sub(desc.objects.len());
    let light = desc.lights.get(k).map(|light| &light.value);
    light.map_or_else(String::new, |light| name(light.name().as_str(), "lights", k, light.kind()))
}

impl Mattes {
    /// Those that a picture is to have, without any names of what is in it.
    pub fn asked(output: &Output) -> Self {
        let both = [(Matte::Objects, MatteOf::Objects), (Matte::Materials, MatteOf::Materials)];
        let mut masks: Vec<String> = output.masks.iter().map(|mask| mask.value.0.clone()).collect();
        masks.sort_unstable();
        masks.dedup();
        Mattes {
            cryptomatte: both
                .into_iter()
                .filter(|(word, _)| output.cryptomatte.contains(word))
                .map(|(_, of)| of)
                .collect(),
            masks,
            ..Mattes::default()
        }
    }

    /// Those of a scene, whose materials have these names.
    pub(crate) fn of(desc: &SceneDesc, materials: Vec<String>) -> Self {
        let all = if mattes_kept(&desc.output).objects { desc.objects.len() + desc.lights.len() } else { 0 };
        let objects = (0..all).map(|number| object_name(desc, number)).collect();
        Mattes { objects, materials, ..Mattes::asked(&desc.output) }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.cryptomatte.is_empty() && self.masks.is_empty()
    }

    /// What the film has to count for them.
    pub fn kept(&self) -> MattesKept {
        MattesKept {
            objects: self.cryptomatte.contains(&MatteOf::Objects) || !self.masks.is_empty(),
            materials: self.cryptomatte.contains(&MatteOf::Materials),
        }
    }

    /// What files call them: `CryptoObject`, `mask.lamp`.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let masks = self.masks.iter().map(|name| format!("mask.{name}"));
        self.cryptomatte.iter().map(|&of| cryptomatte::name(of).to_owned()).chain(masks)
    }

    /// Channels that they bring to a picture file: twelve for each kind that Cryptomatte tells apart, one for a mask.
    pub fn channels(&self) -> usize {
        self.cryptomatte.len() * cryptomatte::CHANNELS + self.masks.len()
    }

    /// The mattes of a film that was rendered for them, over the threads of rayon's current pool. They do not depend on
    /// their number.
    pub fn develop(&self, film: &Film) -> MatteImage {
        let mut image = MatteImage::default();
        for &of in &self.cryptomatte {
            let names = match of {
                MatteOf::Objects => &self.objects,
                MatteOf::Materials => &self.materials,
            };
            cryptomatte(film, of, names, &mut image);
        }
        for mask in &self.masks {
            let is_of = |number: u32| self.objects.get(number as usize - 1).is_some_and(|name| name == mask);
            let covered = |x: u32, y: u32| -> f64 {
                let shares = film.matte(MatteOf::Objects, x, y);
                shares.iter().filter(|&&(number, _)| is_of(number)).map(|&(_, share)| share).sum()
            };
            let values = of_pixels(film, |x, y| covered(x, y).min(1.0) as f32 + 0.0);
            image.channels.push((format!("mask.{mask}.Y"), values));
        }
        image
    }
}

/// A value of each pixel that a film holds, row by row.
fn of_pixels<T: Send>(film: &Film, value: impl Fn(u32, u32) -> T + Sync) -> Vec<T> {
    let Crop { x, y, width, height } = film.crop();
    (0..width * height).into_par_iter().map(|k| value(x + k % width, y + k / width)).collect()
}
