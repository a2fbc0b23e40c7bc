//! Finding triangles that lie in one plane and overlap.
//!
//! Rounding has moved a corner by at most half a unit in the last place along each axis, hence a plane with unit
//! normal n by e = k 2^-24 sum |n_i| max |v_i|, k being 1, and some 8 for a mesh that is placed by a matrix (its
//! coordinates, the matrix, its inverse). With twice that for room, the plane of a triangle of height h and centre c is
//! known at a point p to e (1 + 2 |p - c| / h).
//!
//! Triangles are put into the cells of a grid over their planes, given by the squares of the normal's components and
//! the distance from the origin, which know no sign; the coarser the cells, the worse the plane is known. The best
//! known ones gather first, from their own cells and coarser ones, those whose corners are all in their plane. In each
//! plane that has several, a sweep over their boxes and the separating axes of triangles find the pairs that overlap.
//! Triangles too narrow to have a plane, as curved walls of many pieces far from the middle of a scene have, count
//! where all their corners are the same: a wall that two bodies share.

use super::super::geometry::{Geometry, LeftOut, NONE};
use super::grid::grid;
use super::pairs::pairs_in;
use super::same::{Same, bodies, bodies_in_one_place, identical};
use super::{Coplanar, Grid, LONG, Member, Offsets, Outline, Ranks, SAME_SIDE, TRANSMITS};
use crate::shapes::{FlatFace, Row};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// More triangles than this are not looked at, copies counted; meshes with the fewest come first. Surfaces in one plane
/// are those of boxes, rectangles and buildings, and meshes of millions of triangles must not wait for a search.
const MOST_TRIANGLES: usize = 1 << 18;

/// Of what lets light through there may be so many beside them, where several bodies do: water in a glass of fine
/// pieces.
const MOST_TRANSMITTING: usize = 1 << 20;

/// Scenes with more curved shapes have theirs left out.
const MOST_SHAPES: usize = 1 << 16;

/// What the arithmetic in double precision, a shape's map among it, may move a point by, in parts of its coordinates:
/// some ten roundings of 2^-53. In a plane through the origin the roundings of single precision are none.
const DOUBLE: f64 = 16.0 / 9_007_199_254_740_992.0;

/// 2^-24.
pub(super) const UNIT: f64 = 1.0 / 16_777_216.0;

/// The sides of the cells, from fine to coarse.
const CELLS: [f64; 4] = [1.0 / 262_144.0, 1.0 / 8192.0, 1.0 / 256.0, 1.0 / 8.0];

/// A cell is so many times as wide as the doubt about a plane.
const ROOM: f64 = 16.0;

/// A triangle of the scene, in render space.
#[derive(Clone)]
pub(super) struct Face {
    primitive: u32,
    pub(super) instance: u32,
    /// Which of a shape's flat parts.
    part: u8,
    /// What it is half of the square about. Few faces have it, and it is as large as all the rest.
    pub(super) curved: Option<Box<FlatFace>>,
    /// To the outside of its body; `None`: it bounds none.
    pub(super) outward: Option<DVec3>,
    material: Option<u32>,
    pub(super) corners: [DVec3; 3],
    pub(super) normal: DVec3,
    centre: DVec3,
    /// How far its corners may be off along each axis.
    moved: DVec3,
    /// How far its corners may be off across the plane.
    pub(super) error: f64,
    /// The least of its heights.
    height: f64,
    /// The largest coordinate.
    pub(super) reach: f64,
    pub(super) rank: u8,
    /// It is too narrow for its plane to be known.
    narrow: bool,
}

impl Face {
    fn id(&self) -> (u32, u32, u8) {
        (self.primitive, self.instance, self.part)
    }

    /// Whether it is a plane without an end.
    pub(super) fn is_endless(&self) -> bool {
        self.curved.as_ref().is_some_and(|face| face.is_endless())
    }

    /// The least wins.
    pub(super) fn order(&self) -> (u8, bool, (u32, u32, u8)) {
        (self.rank, self.is_endless(), self.id())
    }

    /// How well its plane is known, in parts of the scene's reach.
    fn doubt(&self, scene: f64) -> f64 {
        let angle = 2.0 * self.error / self.height;
        angle.max((self.error + angle * self.reach) / scene)
    }

    /// Whether all of another one lies in its plane; and how far off its plane may be there.
    fn holds(&self, other: &Self) -> Option<f64> {
        let mut most: f64 = 0.0;
        for corner in other.corners {
            let beside = corner - self.centre;
            let known = self.error * (1.0 + 2.0 * beside.length() / self.height) + other.error;
            if beside.dot(self.normal).abs() > known {
                return None;
            }
            most = most.max(known);
        }
        Some(most)
    }
}

impl Coplanar {
    /// Those of a scene, if it has any.
    pub fn find(geometry: &Geometry, ranks: &Ranks) -> Option<Self> {
        let faces = faces(geometry, ranks);
        let scene = faces.iter().map(|face| face.reach).fold(0.0, f64::max);
        let mut faces = sorted(faces, scene, geometry.planes.len());
        let flat = faces.partition_point(|face| !face.narrow);
        let same = Same::of(&faces[..flat]);
        let mut pairs = pairs_in(planes(&faces[..flat], scene, &same), &faces);
        pairs.extend(identical(&faces, flat));
        pairs.extend(in_planes(geometry, ranks, &mut faces, &same));
        pairs.sort_unstable_by_key(|pair| (pair.0, pair.1));
        if pairs.is_empty() { None } else { Some(of_pairs(geometry, &faces, &pairs, &same)) }
    }
}

/// Those with a plane first, the best known ones before the others; with room for so many planes behind them.
fn sorted(faces: Vec<Face>, scene: f64, planes: usize) -> Vec<Face> {
    // Of a number that is not below zero the bits rise with it. Keys are sorted, not faces, which are ten times as
    // large.
    let key = |(k, face): (usize, &Face)| (face.narrow, face.doubt(scene).to_bits(), face.id(), k as u32);
    let mut order: Vec<_> = faces.par_iter().enumerate().map(key).collect();
    order.par_sort_unstable();
    let mut sorted = Vec::with_capacity(order.len() + planes);
    sorted.par_extend(order.into_par_iter().map(|(.., k)| faces[k as usize].clone()));
    sorted
}

/// The id of the scene's first triangle.
fn first_primitive(geometry: &Geometry) -> u32 {
    geometry.meshes.iter().map(|mesh| mesh.first_primitive).min().unwrap_or(0)
}

/// Which meshes are looked at.
fn looked_at(geometry: &Geometry, ranks: &Ranks) -> Vec<bool> {
    let mut copies = vec![0; geometry.meshes.len()];
    let mut transmit = vec![false; geometry.meshes.len()];
    let first = first_primitive(geometry);
    for (k, instance) in geometry.instances.iter().enumerate() {
        let mesh = &geometry.meshes[instance.mesh as usize];
        if LeftOut::holds(geometry.left_out.instances, k) {
            continue;
        }
        copies[instance.mesh as usize] += 1;
        let from = mesh.first_primitive - first;
        let to = from + mesh.triangles.len() as u32;
        transmit[instance.mesh as usize] |= (from..to).any(|triangle| ranks.of(triangle, k as u32) == TRANSMITS);
    }
    let bodies: usize = transmit.iter().zip(&copies).filter(|(transmit, _)| **transmit).map(|(_, copies)| copies).sum();
    let counts = copies.iter().zip(geometry.meshes).map(|(copies, mesh)| copies * mesh.triangles.len());
    let mut order: Vec<(usize, usize)> = counts.zip(0..).collect();
    order.sort_unstable();
    let (mut looked_at, mut sum, mut transmitting) = (vec![false; order.len()], 0usize, 0usize);
    for (count, mesh) in order {
        sum = sum.saturating_add(count);
        looked_at[mesh] = sum <= MOST_TRIANGLES;
        if !looked_at[mesh] && transmit[mesh] && bodies > 1 {
            transmitting = transmitting.saturating_add(count);
            looked_at[mesh] = transmitting <= MOST_TRANSMITTING;
        }
    }
    looked_at
}

/// The triangles that are looked at.
fn faces(geometry: &Geometry, ranks: &Ranks) -> Vec<Face> {
    let looked_at = looked_at(geometry, ranks);
    let first = first_primitive(geometry);
    // Per instance that is looked at, the number of its first triangle among all of them.
    let (mut starts, mut count) = (Vec::new(), 0usize);
    for (index, instance) in geometry.instances.iter().enumerate() {
        if looked_at[instance.mesh as usize] && !LeftOut::holds(geometry.left_out.instances, index) {
            starts.push((count, index));
            count += geometry.meshes[instance.mesh as usize].triangles.len();
        }
    }
    let triangle = |number: usize| {
        let (start, index) = starts[starts.partition_point(|start| start.0 <= number) - 1];
        let instance = &geometry.instances[index];
        let (mesh, k) = (&geometry.meshes[instance.mesh as usize], number - start);
        let corners = mesh.triangles[k].map(|vertex| DVec3::from(mesh.positions[vertex as usize].map(f64::from)));
        let id = (mesh.first_primitive + k as u32, index as u32);
        let material = ranks.materials.as_ref().and_then(|of| of.of(id.0 - first, id.1));
        face(corners, instance.placement, id, ranks.of(id.0 - first, id.1)).map(|face| Face { material, ..face })
    };
    // Where as many are known to come nothing grows, and what is none is taken out in place.
    let found: Vec<Option<Face>> = (0..count).into_par_iter().map(triangle).collect();
    let mut faces: Vec<Face> = found.into_iter().flatten().collect();
    if geometry.shapes.len() <= MOST_SHAPES {
        let shapes = (0..).zip(geometry.shapes);
        let shapes = shapes.filter(|(k, _)| !LeftOut::holds(geometry.left_out.shapes, *k as usize));
        faces.extend(shapes.flat_map(|(k, shape)| of_shape(geometry, ranks, k, &shape.row)));
    }
    faces
}

/// The squares about the flat parts of a shape, two triangles each.
fn of_shape(geometry: &Geometry, ranks: &Ranks, k: u32, row: &Row) -> impl Iterator<Item = Face> + use<> {
    let rank = ranks.shapes.get(k as usize).copied().unwrap_or(0);
    let id = (geometry.first_shape + k, NONE);
    let material = ranks.materials.as_ref().and_then(|of| of.shapes.get(k as usize)).copied();
    (0..).zip(row.flat_faces()).flat_map(move |(part, curved)| {
        let [a, b, c, d] = curved.corners();
        let half = move |corners| face(corners, None, id, rank);
        [half([a, b, c]), half([a, c, d])].into_iter().flatten().map(move |face| Face {
            part,
            curved: Some(Box::new(curved)),
            outward: curved.outward(),
            material,
            ..face
        })
    })
}

/// The pairs of a plane without an end and what lies in it, winner first; the planes are put behind the faces. A face
/// is in a plane if its corners are no farther off than twice what rounding may have moved them.
fn in_planes(geometry: &Geometry, ranks: &Ranks, faces: &mut Vec<Face>, same: &Same) -> Vec<(u32, u32, f64)> {
    let (count, mut pairs) = (faces.len(), Vec::new());
    for (k, row) in (geometry.shapes.len()..).zip(geometry.planes) {
        let Some(curved) = row.flat_faces().next() else { continue };
        if LeftOut::holds(geometry.left_out.shapes, k) {
            continue;
        }
        let (normal, offset) = curved.equation();
        let plane = Face {
            primitive: geometry.first_shape + k as u32,
            instance: NONE,
            part: 0,
            curved: Some(Box::new(curved)),
            outward: None,
            material: ranks.materials.as_ref().and_then(|of| of.shapes.get(k)).copied(),
            corners: [normal * offset; 3],
            normal,
            centre: normal * offset,
            moved: DVec3::ZERO,
            error: 0.0,
            height: f64::INFINITY,
            reach: 0.0,
            rank: ranks.shapes.get(k).copied().unwrap_or(0),
            narrow: false,
        };
        let place = faces.len() as u32;
        pairs.par_extend(faces[..count].par_iter().enumerate().filter_map(|(other, face)| {
            let known = normal.abs().dot(face.moved) + DOUBLE * (face.reach + offset.abs());
            let stands = !same.stood_for(other as u32);
            let lies_in = stands && face.corners.iter().all(|corner| (normal.dot(*corner) - offset).abs() <= known);
            let pair = if face.order() < plane.order() { [other as u32, place] } else { [place, other as u32] };
            lies_in.then_some((pair[0], pair[1], known))
        }));
        faces.push(plane);
    }
    pairs
}

fn face(corners: [DVec3; 3], placement: Option<[[f32; 4]; 3]>, id: (u32, u32), rank: u8) -> Option<Face> {
    let (mut terms, mut units, mut placed, mut mirrored) = (DVec3::ZERO, 2.0, corners, false);
    match placement {
        None => corners.iter().for_each(|corner| terms = terms.max(corner.abs())),
        Some(rows) => {
            let column = |k: usize| DVec3::new(rows[0][k].into(), rows[1][k].into(), rows[2][k].into());
            let matrix = DMat3::from_cols(column(0), column(1), column(2));
            let size = DMat3::from_cols(matrix.x_axis.abs(), matrix.y_axis.abs(), matrix.z_axis.abs());
            corners.iter().for_each(|corner| terms = terms.max(size * corner.abs() + column(3).abs()));
            placed = corners.map(|corner| matrix * corner + column(3));
            units = 16.0;
            mirrored = matrix.determinant() < 0.0;
        }
    }
    let [a, b, c] = placed;
    let across = (b - a).cross(c - a);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let (area, normal) = (across.length(), across.normalize_or_zero());
    let moved = units * UNIT * terms;
    let error = normal.abs().dot(moved) + DOUBLE * terms.max_element();
    let height = area / longest;
    let centre = (a + b + c) / 3.0;
    let face = Face {
        primitive: id.0,
        instance: id.1,
        part: 0,
        curved: None,
        outward: Some(if mirrored { -normal } else { normal }),
        material: None,
        corners: placed,
        normal,
        centre,
        moved,
        error,
        height,
        reach: terms.max_element(),
        rank,
        narrow: error >= height / 512.0,
    };
    (area > 0.0 && area.is_finite()).then_some(face)
}

/// Groups of triangles in one plane, the best known one first, with how far off the planes may be; without those that
/// others stand for.
fn planes(faces: &[Face], scene: f64, same: &Same) -> Vec<(Vec<u32>, f64)> {
    let level_of =
        |face: &Face| CELLS.iter().position(|cell| *cell >= ROOM * face.doubt(scene)).unwrap_or(CELLS.len() - 1);
    let mut cells: Vec<Vec<(u64, u32)>> = vec![Vec::new(); CELLS.len()];
    for (k, face) in (0..).zip(faces).filter(|(k, _)| !same.stood_for(*k)) {
        let level = level_of(face);
        let ball = 4.0 * face.doubt(scene) / CELLS[level];
        let at = coordinates(face, scene).map(|x| x / CELLS[level]);
        let ends = at.map(|x| [(x - ball).floor() as i64, (x + ball).floor() as i64]);
        let mut corners: Vec<u64> = (0..8).map(|corner| key([0, 1, 2].map(|i| ends[i][corner >> i & 1]))).collect();
        corners.sort_unstable();
        corners.dedup();
        cells[level].extend(corners.into_iter().map(|key| (key, k)));
    }
    cells.par_iter_mut().for_each(|cells| cells.par_sort_unstable());
    let mut free: Vec<bool> = (0..faces.len() as u32).map(|k| !same.stood_for(k)).collect();
    let mut planes = Vec::new();
    for (k, face) in (0u32..).zip(faces) {
        if !free[k as usize] {
            continue;
        }
        let (mut members, mut gap) = (vec![k], 0f64);
        free[k as usize] = false;
        for level in level_of(face)..CELLS.len() {
            let key = key(coordinates(face, scene).map(|x| (x / CELLS[level]).floor() as i64));
            let from = cells[level].partition_point(|entry| entry.0 < key);
            for &(_, other) in cells[level][from..].iter().take_while(|entry| entry.0 == key) {
                if free[other as usize]
                    && let Some(known) = face.holds(&faces[other as usize])
                {
                    free[other as usize] = false;
                    members.push(other);
                    gap = gap.max(known);
                }
            }
        }
        if members.len() > 1 {
            planes.push((members, gap));
        }
    }
    planes
}

/// Where a plane is, whatever the sign of its normal. Squares of components change by at most twice the angle between
/// two planes, which is at most twice the larger doubt.
fn coordinates(face: &Face, scene: f64) -> [f64; 3] {
    [face.normal.x * face.normal.x, face.normal.y * face.normal.y, face.normal.dot(face.centre).abs() / scene]
}

/// A number of a cell, of few that share it.
fn key(cell: [i64; 3]) -> u64 {
    cell.iter().fold(0, |key: u64, &x| (key ^ x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29))
}

// Long: one table is filled by all pairs.
fn of_pairs(geometry: &Geometry, faces: &[Face], pairs: &[(u32, u32, f64)], same: &Same) -> Coplanar {
    // One of the halves of a square stands for both.
    let mut named: Vec<u32> = pairs.iter().flat_map(|pair| [pair.0, pair.1]).collect();
    named.sort_unstable();
    named.dedup();
    // Of planes that were left out nobody is told apart.
    let told = |k: u32| named.binary_search(&k).is_ok();
    let beside: Vec<u32> = same.pairs.iter().filter(|pair| told(pair.1)).map(|pair| pair.0).collect();
    named.extend(beside);
    named.sort_unstable_by_key(|&k| (faces[k as usize].id(), k));
    named.dedup_by_key(|&mut k| faces[k as usize].id());
    let member_of = |k: u32| {
        let id = faces[k as usize].id();
        named.binary_search_by_key(&id, |&k| faces[k as usize].id()).unwrap_or_default()
    };
    let first = first_primitive(geometry);
    let end = geometry.meshes.iter().map(|mesh| mesh.first_primitive + mesh.triangles.len() as u32).max().unwrap_or(0);
    let mut triangles = Offsets { first, of: vec![0f32; (end - first) as usize] };
    let curved = named.iter().any(|&k| faces[k as usize].curved.is_some());
    let mut shapes = Offsets {
        first: geometry.first_shape,
        of: vec![0.0; if curved { geometry.shapes.len() + geometry.planes.len() } else { 0 }],
    };
    let mut lists: Vec<Vec<u32>> = vec![Vec::new(); named.len()];
    let mut touching: Vec<Vec<[u32; 2]>> = vec![Vec::new(); named.len()];
    let in_one_place = bodies_in_one_place(faces, pairs);
    for &(winner, loser, gap) in pairs {
        let both = bodies(&faces[winner as usize], &faces[loser as usize]);
        let are_one = in_one_place.binary_search(&both).is_ok();
        for (one, other) in [(winner, loser), (loser, winner)].into_iter().filter(|_| !are_one) {
            if let Some(behind) = touches(&faces[one as usize], &faces[other as usize]) {
                touching[member_of(one)].push([member_of(other) as u32, behind]);
            }
        }
        lists[member_of(loser)].push(member_of(winner) as u32);
        // A ray that starts near a plane is off across it by some five units of the farthest corner (see `RaySpace`).
        let reach = faces[winner as usize].reach.max(faces[loser as usize].reach);
        let offset = (gap + 8.0 * UNIT * reach) as f32;
        for face in [winner, loser].map(|k| &faces[k as usize]) {
            let offsets = match face.curved {
                None => &mut triangles,
                Some(_) => &mut shapes,
            };
            let place = (face.primitive - offsets.first) as usize;
            offsets.of[place] = offsets.of[place].max(offset);
        }
    }
    let index = |k: u32| named.binary_search_by_key(&faces[k as usize].id(), |&k| faces[k as usize].id());
    let stood_for: Vec<(usize, usize)> =
        same.pairs.iter().filter_map(|&(k, winner)| Some((index(k).ok()?, index(winner).ok()?))).collect();
    let mut stands = vec![false; named.len()];
    stood_for.iter().for_each(|&(_, winner)| stands[winner] = true);
    let (mut winners, mut all_touching): (Vec<u32>, Vec<[u32; 2]>) = (Vec::new(), Vec::new());
    let (mut members, mut grids): (Vec<Member>, Vec<Grid>) = (Vec::with_capacity(named.len()), Vec::new());
    for (member, ((&k, mut list), mut touching)) in (0u32..).zip(named.iter().zip(lists).zip(touching)) {
        touching.sort_unstable();
        touching.dedup();
        let begin = all_touching.len() as u32;
        all_touching.append(&mut touching);
        let touching = [begin, all_touching.len() as u32];
        list.sort_unstable_by_key(|&member| faces[named[member as usize] as usize].order());
        list.dedup();
        // Who stands for others is among the winners that it shares with them.
        list.extend(stands[member as usize].then_some(member));
        let face = &faces[k as usize];
        let begin = winners.len() as u32;
        winners.extend_from_slice(&list);
        let gridded = list.len() > LONG;
        grids.extend(gridded.then(|| grid(face, &list, faces, &named)));
        members.push(Member {
            primitive: face.primitive,
            instance: face.instance,
            outline: match face.curved.as_deref() {
                None => Outline::Triangle(face.corners.map(|corner| corner.as_vec3().to_array())),
                Some(curved) => Outline::Curved(*curved),
            },
            normal: face.normal.as_vec3().to_array(),
            winners: [begin, winners.len() as u32],
            touching,
            grid: gridded.then(|| grids.len() - 1),
        });
    }
    for (member, winner) in stood_for {
        (members[member].winners, members[member].grid) = (members[winner].winners, members[winner].grid);
        let offset = triangles.get(members[winner].primitive);
        let place = (members[member].primitive - first) as usize;
        triangles.of[place] = triangles.of[place].max(offset);
    }
    let in_planes = what_lies_in(pairs, faces, same);
    Coplanar { triangles, shapes, members, winners, touching: all_touching, in_planes, grids }
}

/// What lies behind the one face by the other one, where both bodies let light through: the other's material + 1, and
/// [`SAME_SIDE`] where both lie behind.
fn touches(face: &Face, other: &Face) -> Option<u32> {
    let transmit = face.rank == TRANSMITS && other.rank == TRANSMITS;
    let opposite = transmit && face.outward?.dot(other.outward?) < 0.0;
    let behind = other.material.filter(|_| transmit)? + 1;
    Some(if opposite { behind } else { behind | SAME_SIDE })
}

/// Each plane without an end of a pair, with what lies in it.
fn what_lies_in(pairs: &[(u32, u32, f64)], faces: &[Face], same: &Same) -> Vec<[u32; 3]> {
    let both = |&(one, other, _): &(u32, u32, f64)| [(one, other), (other, one)];
    let mut ends: Vec<(u32, u32)> =
        pairs.iter().flat_map(both).filter(|(plane, _)| faces[*plane as usize].is_endless()).collect();
    ends.sort_unstable_by_key(|&(plane, other)| (other, plane));
    let mut beside: Vec<(u32, u32)> = Vec::new();
    for &(k, winner) in &same.pairs {
        let from = ends.partition_point(|end| end.1 < winner);
        beside.extend(ends[from..].iter().take_while(|end| end.1 == winner).map(|&(plane, _)| (plane, k)));
    }
    let mut found: Vec<[u32; 3]> = ends
        .iter()
        .chain(&beside)
        .map(|&(plane, other)| (&faces[plane as usize], &faces[other as usize]))
        .map(|(plane, other)| [plane.primitive, other.primitive, other.instance])
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}
