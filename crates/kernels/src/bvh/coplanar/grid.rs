//! Where in a triangle or plane with many winners each of them reaches.

use super::Grid;
use super::find::Face;
use super::pairs::{other_axes, span};
use glam::DVec3;
use std::ops::RangeInclusive;

/// The lists of all cells are at most so many times as long as the list of all winners: where each reaches nearly
/// everywhere cells part nothing.
const SPREAD: usize = 16;

/// A grid over the winners of a triangle or plane, some one to a cell. Each reaches a quarter of a cell beyond its box:
/// the point where a ray meets the plane is known so well unless the ray hardly leaves it.
pub(super) fn grid(face: &Face, list: &[u32], faces: &[Face], named: &[u32]) -> Grid {
    let axes = other_axes(face.normal);
    let corners_of =
        |face: &Face| face.curved.as_ref().map_or(face.corners.to_vec(), |curved| curved.corners().to_vec());
    let others = || list.iter().map(|&member| &faces[named[member as usize] as usize]);
    let spanned: Vec<DVec3> = match face.is_endless() {
        true => others().flat_map(corners_of).collect(),
        false => face.corners.to_vec(),
    };
    let spans = axes.map(|axis| span(spanned.iter().map(|corner| corner[axis])));
    let scale = |cells: usize, k: usize| cells as f64 / (spans[k].1 - spans[k].0);
    let reach = |other: &Face, cells: usize| -> [RangeInclusive<usize>; 2] {
        let corners = corners_of(other);
        [0, 1].map(|k| {
            let (lower, upper) = match other.is_endless() {
                true => spans[k],
                false => span(corners.iter().map(|corner| corner[axes[k]])),
            };
            let scale = scale(cells, k);
            let cell = |x: f64| ((x - spans[k].0) * scale).clamp(0.0, (cells - 1) as f64) as usize;
            cell(lower - 0.25 / scale)..=cell(upper + 0.25 / scale)
        })
    };
    let mut cells = (list.len() as f64).sqrt().ceil().min(256.0) as usize;
    let area = |[x, y]: [RangeInclusive<usize>; 2]| (x.end() + 1 - x.start()) * (y.end() + 1 - y.start());
    while cells > 1 && others().map(|other| area(reach(other, cells))).sum::<usize>() > SPREAD * list.len() {
        cells /= 2;
    }
    let mut held: Vec<Vec<u32>> = vec![Vec::new(); cells * cells];
    for (&member, other) in list.iter().zip(others()) {
        let [x, y] = reach(other, cells);
        for row in y {
            x.clone().for_each(|column| held[row * cells + column].push(member));
        }
    }
    let mut grid = Grid {
        axes,
        lower: spans.map(|span| span.0 as f32),
        scale: [0, 1].map(|k| scale(cells, k) as f32),
        cells,
        starts: vec![0],
        lists: Vec::new(),
    };
    for mut cell in held {
        grid.lists.append(&mut cell);
        grid.starts.push(grid.lists.len() as u32);
    }
    grid
}
