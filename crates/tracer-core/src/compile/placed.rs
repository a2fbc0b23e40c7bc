//! Where the objects of triangles are.

use super::loading::Loaded;
use super::placing::{Given, Maps, Subject, check, place_all};
use super::polygonal::{Geometry, Polygonal, polygonal};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use scene_format::Diagnostics;
use tracer_mesh::MeshData;

/// Where the objects of triangles are.
pub struct Placed {
    /// Per object: from the frame of its triangles to the world, one per copy.
    pub maps: Vec<Maps>,
    /// The corners of the boxes of the files that there are, in the frame of their triangles.
    boxes: Vec<[DVec3; 2]>,
    /// Per object: its file, where it could be loaded.
    file_of_object: Vec<Option<u32>>,
}

/// Evaluates transforms and placements.
pub fn place(given: Given<'_>, loaded: &Loaded, diagnostics: &mut Diagnostics) -> Placed {
    let boxes: Vec<[DVec3; 2]> = loaded.files.iter().map(|data| corners(data)).collect();
    let file_of_object = loaded.file_of_object.iter().map(|file| file.map(|file| file as u32)).collect();
    let mut placed = Placed { maps: Vec::with_capacity(loaded.file_of_object.len()), boxes, file_of_object };
    for (object, file) in polygonal(given.desc).zip(&loaded.file_of_object) {
        let mut place =
            |subject: &Subject<'_>| place_all(given, object.transform, object.placements, subject, diagnostics);
        let Some(file) = *file else {
            // A placements file is read even when the mesh is missing: all faults in one run.
            place(&Subject::unknown(object.noun));
            placed.maps.push(Maps::new());
            continue;
        };
        let maps = with_subject(&object, &loaded.files[file], placed.boxes[file], place);
        let at = object.transform.first().map_or(object.span, |t| t.span);
        check(&maps, at, object.noun, diagnostics);
        placed.maps.push(maps);
    }
    placed
}

/// The corners of the box of triangles.
pub fn corners(data: &MeshData) -> [DVec3; 2] {
    let positions = data.positions.iter().map(|p| DVec3::from(*p));
    positions.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
}

/// What steps ask of an object of these triangles, the corners of whose box these are.
pub fn with_subject<T>(
    object: &Polygonal<'_>,
    data: &MeshData,
    [low, high]: [DVec3; 2],
    then: impl FnOnce(&Subject<'_>) -> T,
) -> T {
    let reach = |map: &DAffine3, axis: usize| {
        let map = *map * object.local;
        let row = map.matrix3.row(axis);
        let along = data.positions.par_iter().map(|p| row.dot(DVec3::from(*p)) + map.translation[axis]);
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        along.map(|x| [x, x]).reduce(|| [f64::INFINITY, f64::NEG_INFINITY], both)
    };
    let middle = match object.geometry {
        Geometry::Made(shape) => shape.middle().map_or(0.5 * (low + high), DVec3::from),
        Geometry::Heights(field) => DVec3::from(field.center.value),
        _ => object.local.transform_point3(DVec3::from(data.barycentre())),
    };
    then(&Subject { noun: object.noun, local: object.local, middle: Some(middle), reach: &reach })
}

impl Placed {
    /// Where the copies of an object of triangles are.
    pub fn maps_of(&self, object: usize) -> &[DAffine3] {
        self.maps.get(object).map_or(&[], Maps::as_slice)
    }

    /// The corners of its box, in the frame of its triangles.
    pub fn box_of(&self, object: usize) -> [DVec3; 2] {
        let file = self.file_of_object.get(object).copied().flatten();
        file.map_or([DVec3::ZERO; 2], |file| self.boxes[file as usize])
    }

    /// A point of the box of each copy, the nearest to `look_at`; of many copies every so many, 1024 at most per
    /// object.
    pub fn marks(&self, look_at: DVec3) -> impl Iterator<Item = DVec3> {
        (0..self.maps.len()).flat_map(move |object| self.marks_of(object, look_at))
    }

    /// Those of one object.
    pub fn marks_of(&self, object: usize, look_at: DVec3) -> impl Iterator<Item = DVec3> {
        let corners = self.box_of(object);
        self.maps.get(object).into_iter().flat_map(move |maps| {
            maps.iter().step_by(maps.len().div_ceil(1024).max(1)).map(move |map| {
                let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
                for k in 0..8usize {
                    let pick = |axis: usize| corners[k >> axis & 1][axis];
                    let p = map.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
                    (low, high) = (low.min(p), high.max(p));
                }
                look_at.clamp(low, high)
            })
        })
    }
}
