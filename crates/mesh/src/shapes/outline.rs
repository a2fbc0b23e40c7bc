//! Plane faces with holes, cut into triangles whose corners are the points of their rings and whose sides are sides of
//! rings or lie within.
//!
//! By the constrained Delaunay triangulation of the crate `spade`, which decides by exact arithmetic: no triangle is
//! without area, and no corner lies on another's side, so that what joins the face at its rings joins it without a gap.
//! [`crate::polygon`] cuts faces of meshes, which may be bent and cross themselves, and leaves out triangles without
//! area.

#![expect(clippy::indexing_slicing, reason = "faces and points are numbered by the triangulation")]

use scene_format::path::Point;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// Why rings bound no face. Points are numbered through all rings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// All points lie on one line.
    Flat,
    /// Two points are one.
    Twice([usize; 2]),
    /// The sides that begin at these points cross.
    Crossing([usize; 2]),
    /// A side that begins at this point passes through another one.
    Touching(usize),
    /// This ring, which is not the first, has something outside of it all.
    Outside(usize),
    /// This ring is within a hole.
    WithinHole(usize),
}

/// A point of a ring.
struct Corner {
    place: Point2<f64>,
    number: usize,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

/// Smaller coordinates are taken as zero: the triangulation refuses them.
const LEAST: f64 = 1e-40;

/// Where a triangle lies.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Outside,
    Inside,
    Hole(usize),
}

/// Cuts the face within the first ring and outside of the others. Each is three points or more, the last of which is
/// not the first again, either way round. Gives the corners of each triangle, counter-clockwise, by their numbers
/// through all rings.
pub fn fill(rings: &[Vec<Point>]) -> Result<Vec<[u32; 3]>, Fault> {
    let points: Vec<Point> = rings.iter().flatten().copied().collect();
    let ring_of: Vec<usize> = rings.iter().enumerate().flat_map(|(k, ring)| ring.iter().map(move |_| k)).collect();
    let tidy = |x: f64| if x.abs() < LEAST { 0.0 } else { x };
    let corner = |(number, p): (usize, &Point)| Corner { place: Point2::new(tidy(p[0]), tidy(p[1])), number };
    let corners: Vec<Corner> = points.iter().enumerate().map(corner).collect();
    // Coordinates are finite and within 1e12.
    let mut cut: ConstrainedDelaunayTriangulation<Corner> =
        ConstrainedDelaunayTriangulation::bulk_load(corners).map_err(|_| Fault::Flat)?;
    if cut.num_vertices() < points.len() {
        return Err(Fault::Twice(twice(&points, tidy)));
    }
    if cut.num_inner_faces() == 0 {
        return Err(Fault::Flat);
    }
    let mut handles = vec![FixedVertexHandle::from_index(0); points.len()];
    for vertex in cut.vertices() {
        handles[vertex.data().number] = vertex.fix();
    }
    let mut first = 0;
    for ring in rings {
        let next = |k: usize| if k + 1 == first + ring.len() { first } else { k + 1 };
        for from in first..first + ring.len() {
            let to = next(from);
            let sides = cut.try_add_constraint(handles[from], handles[to]);
            match sides.len() {
                1 => {}
                0 => return Err(Fault::Crossing([from, crossed(&cut, handles[from], handles[to], rings)])),
                _ => return Err(Fault::Touching(from)),
            }
        }
        first += ring.len();
    }
    inside(&cut, &ring_of)
}

/// Two points that are one.
fn twice(points: &[Point], tidy: impl Fn(f64) -> f64) -> [usize; 2] {
    let key = |k: &usize| points[*k].map(|x| (tidy(x) + 0.0).to_bits());
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|k| (key(k), *k));
    let same = order.windows(2).filter(|pair| key(&pair[0]) == key(&pair[1])).min_by_key(|pair| pair[1]);
    same.map_or([0, 0], |pair| [pair[0], pair[1]])
}

/// The point that the side begins at which is in the way of another.
fn crossed(
    cut: &ConstrainedDelaunayTriangulation<Corner>,
    from: FixedVertexHandle,
    to: FixedVertexHandle,
    rings: &[Vec<Point>],
) -> usize {
    let ends =
        cut.get_conflicting_edges_between_vertices(from, to).map(|edge| edge.vertices().map(|v| v.data().number));
    let [a, b] = ends.min().unwrap_or_default();
    let (low, high) = (a.min(b), a.max(b));
    // A ring's last side goes from its last point to its first.
    let mut first = 0;
    for ring in rings {
        if low == first && high + 1 == first + ring.len() && ring.len() > 2 {
            return high;
        }
        first += ring.len();
    }
    low
}

/// The triangles inside: from the outside inwards, over sides of rings.
fn inside(cut: &ConstrainedDelaunayTriangulation<Corner>, ring_of: &[usize]) -> Result<Vec<[u32; 3]>, Fault> {
    let mut places: Vec<Option<Place>> = vec![None; cut.num_all_faces()];
    let outer = cut.outer_face().fix();
    places[outer.index()] = Some(Place::Outside);
    let hull = cut.convex_hull().map(|edge| if edge.face().is_outer() { edge.fix() } else { edge.rev().fix() });
    let mut waiting: Vec<_> = hull.map(|edge| (Place::Outside, edge)).collect();
    while let Some((here, edge)) = waiting.pop() {
        let edge = cut.directed_edge(edge);
        let beyond = edge.rev().face();
        if places[beyond.fix().index()].is_some() {
            continue;
        }
        let place = if edge.as_undirected().is_constraint_edge() {
            let ring = ring_of[edge.from().data().number];
            match here {
                Place::Outside if ring == 0 => Place::Inside,
                Place::Outside => return Err(Fault::Outside(ring)),
                Place::Inside if ring == 0 => Place::Outside,
                Place::Inside => Place::Hole(ring),
                Place::Hole(hole) if hole == ring => Place::Inside,
                Place::Hole(_) => return Err(Fault::WithinHole(ring)),
            }
        } else {
            here
        };
        places[beyond.fix().index()] = Some(place);
        if let Some(face) = beyond.as_inner() {
            waiting.extend(face.adjacent_edges().map(|edge| (place, edge.fix())));
        }
    }
    let within = cut.inner_faces().filter(|face| places[face.fix().index()] == Some(Place::Inside));
    Ok(within.map(|face| face.vertices().map(|vertex| vertex.data().number as u32)).collect())
}

/// Twice the area of a ring, positive counter-clockwise.
pub fn area(ring: &[Point]) -> f64 {
    let [x, y] = ring.first().copied().unwrap_or_default();
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x)).sum()
}

/// Middle and size of the square around points.
pub fn square(points: &[Point]) -> (Point, f64) {
    let bounds = |axis: usize| {
        let along = points.iter().map(|p| p[axis]);
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let [(left, right), (low, high)] = [bounds(0), bounds(1)];
    ([0.5 * (left + right), 0.5 * (low + high)], (right - left).max(high - low))
}
