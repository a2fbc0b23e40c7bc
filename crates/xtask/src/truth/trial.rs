//! Pictures of one scene with independent seeds, reduced to what is tested.

use super::world::grey;
use tracer_core::{Film, RenderOptions, Scene, Unobserved};

/// Pixels along a cell's side. Regions that are tested are made of whole cells.
pub const CELL: u32 = 16;

/// Pixels along a tile's side.
pub const TILE: u32 = 32;

/// A way to make pictures of a scene; those of several scenes are summed.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The scenes.
    pub scenes: &'a [Scene],
    /// Whether by the plain path tracer; else as the scene says.
    pub plain: bool,
    /// Samples per pixel.
    pub samples: u32,
    /// Worker threads.
    pub threads: usize,
    /// Whether the pictures are looked at in a mirror.
    pub flip: bool,
}

/// A picture, reduced.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Grey means of cells, row by row.
    pub cells: Vec<f64>,
    /// Pixels of which a channel is below zero.
    pub negative: u32,
    /// The lowest channel of a pixel.
    pub lowest: f64,
    /// Pixels that are not exactly black.
    pub lit: u32,
    /// Samples that were no numbers.
    pub dropped: u64,
}

/// What makes pictures with independent seeds.
pub trait Pictures {
    /// Pictures of seeds from `first` on.
    fn pictures(&self, first: u32, count: usize) -> Vec<Picture>;
}

impl Pictures for Source<'_> {
    fn pictures(&self, first: u32, count: usize) -> Vec<Picture> {
        (first..first + count as u32).map(|seed| self.picture(seed)).collect()
    }
}

impl Source<'_> {
    /// Cells along a side.
    pub fn across(&self) -> usize {
        (self.scenes[0].size[0] / CELL) as usize
    }

    /// The films of a seed, one for each scene.
    pub fn films(&self, seed: u32) -> Vec<Film> {
        let off = self.plain.then_some(false);
        let film = |(k, scene): (usize, &Scene)| {
            // Scenes that are summed must not have the same noise.
            let seed = seed.wrapping_add(0x1000_0000 * k as u32);
            let options = RenderOptions {
                samples: Some(self.samples),
                seed: Some(seed),
                threads: self.threads,
                reuse: off,
                caustics: off,
                ..RenderOptions::default()
            };
            tracer_core::render(scene, &options, &Unobserved)
        };
        self.scenes.iter().enumerate().map(film).collect()
    }

    /// The picture of a seed.
    pub fn picture(&self, seed: u32) -> Picture {
        let mut pictures = self.films(seed).into_iter().map(|film| Picture::of(&film, self.flip));
        // There is at least one scene.
        let mut sum = pictures.next().unwrap_or_else(|| unreachable!("a source without scenes"));
        for picture in pictures {
            sum.cells.iter_mut().zip(&picture.cells).for_each(|(sum, x)| *sum += x);
            sum.negative += picture.negative;
            sum.lowest = sum.lowest.min(picture.lowest);
            sum.lit += picture.lit;
            sum.dropped += picture.dropped;
        }
        sum
    }
}

impl Picture {
    /// Of a film.
    pub fn of(film: &Film, flip: bool) -> Self {
        let [width, height] = film.size();
        let across = (width / CELL) as usize;
        let mut picture = Picture {
            cells: vec![0.0; across * (height / CELL) as usize],
            negative: 0,
            lowest: f64::INFINITY,
            lit: 0,
            dropped: film.counters.dropped,
        };
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let color = film.radiance(if flip { width - 1 - x } else { x }, y);
            let least = color.iter().copied().fold(f64::INFINITY, f64::min);
            picture.lowest = picture.lowest.min(least);
            picture.negative += u32::from(least < 0.0);
            picture.lit += u32::from(color != [0.0; 3]);
            let cell = (y / CELL) as usize * across + (x / CELL) as usize;
            picture.cells[cell] += grey(color) / f64::from(CELL * CELL);
        }
        picture
    }
}

/// A part of the picture: the whole, or a tile.
#[derive(Clone, Debug)]
pub struct Region {
    /// What it is called in reports.
    pub name: String,
    /// Its cells.
    pub cells: Vec<usize>,
}

/// The whole picture first, then its tiles.
pub fn regions(across: usize) -> Vec<Region> {
    let per_tile = (TILE / CELL) as usize;
    let mut regions = vec![Region { name: "picture".into(), cells: (0..across * across).collect() }];
    for (row, column) in (0..across / per_tile).flat_map(|r| (0..across / per_tile).map(move |c| (r, c))) {
        let within = |k: usize| (row * per_tile + k / per_tile) * across + column * per_tile + k % per_tile;
        let name = format!("tile {column},{row}");
        regions.push(Region { name, cells: (0..per_tile * per_tile).map(within).collect() });
    }
    regions
}

impl Region {
    /// Its mean in each picture.
    pub fn means(&self, pictures: &[Picture]) -> Vec<f64> {
        let mean = |picture: &Picture| {
            self.cells.iter().map(|&cell| picture.cells[cell]).sum::<f64>() / self.cells.len() as f64
        };
        pictures.iter().map(mean).collect()
    }
}
