//! Cutting polygons into triangles.
//!
//! Convex polygons (and all that are star-shaped around their first corner) become the fan that every program makes.
//! Others are cut by ear clipping (Meisters, "Polygons have ears", 1975) in the plane of Newell's normal; a
//! bent quadrilateral along the diagonal that folds it less. Corners that are not
//! strictly convex are kept in a grid, and only those near an ear are tested against it. Corners on a straight edge are
//! kept as corners of triangles, so that no gap opens against the neighbouring face.

#![expect(
    clippy::indexing_slicing,
    reason = "corners are numbered by the polygon's own border; what a file says has become coordinates"
)]

mod blockers;

use super::cursor::Fault;
use blockers::BlockerGrid;
use std::collections::VecDeque;

/// How many tests one polygon may cost: rings, spirals and combs of 20,000 corners take up to 100 for each corner. An
/// outline made to be slow is refused in time.
const TESTS_PER_CORNER: u64 = 512;

/// Tests that any polygon may cost besides.
const FREE_TESTS: u64 = 1 << 16;

/// The polygon would take too long to cut.
#[derive(Debug, PartialEq)]
pub(super) struct TooIntricate;

impl TooIntricate {
    /// The fault of a face that starts at a byte.
    pub(super) fn fault(at: usize, corners: usize) -> Box<Fault> {
        let message = format!("a face of {corners} corners is too intricate to be cut into triangles");
        Fault::new(at, message, "a simple outline; let the modelling program triangulate this face")
    }
}

/// The triangles of one polygon.
#[derive(Debug, PartialEq)]
pub(super) struct Triangulation<'a> {
    /// Numbers of corners (0-based, in the order of the polygon's border), with the polygon's winding.
    pub(super) triangles: &'a [[u32; 3]],
    /// The border crosses itself, so the triangles cover it only roughly.
    pub(super) crossing: bool,
}

/// Whether a triangle has no area in `f64` arithmetic.
pub(super) fn is_degenerate([a, b, c]: [[f64; 3]; 3]) -> bool {
    cross(difference(b, a), difference(c, a)) == [0.0; 3]
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Cuts polygons, one after the other, in the same memory.
#[derive(Default)]
pub(super) struct PolygonCutter {
    corners: Vec<[f64; 3]>,
    flat: Vec<[f64; 2]>,
    previous: Vec<u32>,
    next: Vec<u32>,
    alive: Vec<bool>,
    /// Corners to be looked at.
    queue: VecDeque<Turn>,
    /// Number of each corner's latest turn.
    turns: Vec<u32>,
    grid: BlockerGrid,
    triangles: Vec<[u32; 3]>,
    tests: u64,
}

/// When a corner is looked at.
struct Turn {
    corner: u32,
    /// Counts the corner's turns; this one is void when it got a later one.
    number: u32,
}

/// What became of a quadrilateral.
#[derive(PartialEq)]
enum Quadrilateral {
    Cut,
    /// Both diagonals leave triangles that face apart.
    Unclear,
}

/// How much an ear must look like one to be cut off, strictest first.
#[derive(Clone, Copy, PartialEq)]
enum Ear {
    /// Clearly convex, no other corner inside or on its border.
    Clear,
    /// Convex by any amount, no other corner inside or on its border.
    Thin,
    /// Convex, whatever lies inside: the border crosses itself.
    Forced,
    /// Anything: a spike without area, or what is left of a border that crosses itself.
    Any,
}

impl PolygonCutter {
    /// Cuts the polygon with these corners, in order along its border. Triangles without area are left out.
    pub(super) fn cut(&mut self, corners: impl Iterator<Item = [f64; 3]>) -> Result<Triangulation<'_>, TooIntricate> {
        self.corners.clear();
        self.corners.extend(corners);
        self.triangles.clear();
        let count = self.corners.len();
        let mut crossing = false;
        if count == 3 {
            self.emit([0, 1, 2]);
        } else if count > 3 {
            if self.project() {
                if self.is_fan() {
                    (1..count as u32 - 1).for_each(|corner| self.emit([0, corner, corner + 1]));
                } else if count > 4 || self.cut_quadrilateral() == Quadrilateral::Unclear {
                    crossing = self.clip_ears()?;
                }
            } else {
                // No area on balance: all corners on one line, or a bow tie of two equal halves.
                (1..count as u32 - 1).for_each(|corner| self.emit([0, corner, corner + 1]));
                crossing = !self.triangles.is_empty();
            }
        }
        Ok(Triangulation { triangles: &self.triangles, crossing })
    }

    fn emit(&mut self, triangle: [u32; 3]) {
        if !is_degenerate(triangle.map(|corner| self.corners[corner as usize])) {
            self.triangles.push(triangle);
        }
    }

    /// Projects the corners along Newell's normal so that the polygon runs counter-clockwise; `false` when it has none.
    fn project(&mut self) -> bool {
        // From the first corner, so that a polygon far away keeps its digits.
        let origin = self.corners[0];
        let mut normal = [0.0; 3];
        let mut from = [0.0; 3];
        for &corner in self.corners.iter().skip(1) {
            let to = difference(corner, origin);
            let part = cross(from, to);
            for axis in 0..3 {
                normal[axis] += part[axis];
            }
            from = to;
        }
        let length = dot(normal, normal).sqrt();
        if length == 0.0 {
            return false;
        }
        let normal = normal.map(|part| part / length);
        let mut across = [0.0; 3];
        let smallest =
            (0..3).fold(0, |least, axis| if normal[axis].abs() < normal[least].abs() { axis } else { least });
        across[smallest] = 1.0;
        let v = cross(normal, across);
        let length = dot(v, v).sqrt();
        let v = v.map(|part| part / length);
        let u = cross(v, normal);
        self.flat.clear();
        self.flat.extend(self.corners.iter().map(|&corner| {
            let from_origin = difference(corner, origin);
            [dot(from_origin, u), dot(from_origin, v)]
        }));
        true
    }

    /// Cuts a quadrilateral that is bent, or whose fan is not clear, along the diagonal with the smaller fold.
    fn cut_quadrilateral(&mut self) -> Quadrilateral {
        let fold = |[a, b, c, d]: [usize; 4]| {
            let [first, second] = [[a, b, c], [a, c, d]].map(|triangle| {
                let [a, b, c] = triangle.map(|corner| self.corners[corner]);
                cross(difference(b, a), difference(c, a))
            });
            let lengths = dot(first, first).sqrt() * dot(second, second).sqrt();
            // The cosine of the angle between the triangles; a triangle without area is no good half.
            if lengths > 0.0 { dot(first, second) / lengths } else { 0.0 }
        };
        let (first, second) = (fold([0, 1, 2, 3]), fold([1, 2, 3, 0]));
        if first.max(second) <= 0.0 {
            return Quadrilateral::Unclear;
        }
        let halves = if first >= second { [[0, 1, 2], [0, 2, 3]] } else { [[1, 2, 3], [1, 3, 0]] };
        halves.into_iter().for_each(|half| self.emit(half));
        Quadrilateral::Cut
    }

    /// Twice the signed area of a projected triangle.
    fn area(&self, a: u32, b: u32, c: u32) -> f64 {
        let [a, b, c] = [a, b, c].map(|corner| self.flat[corner as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Whether the corner `b` between `a` and `c` turns clearly to the inside: by more than rounded coordinates of a
    /// straight edge do.
    fn is_clearly_convex(&self, a: u32, b: u32, c: u32) -> bool {
        self.area(a, b, c) > 1e-6 * self.longest_squared(a, b, c)
    }

    /// The square of a projected triangle's longest edge.
    fn longest_squared(&self, a: u32, b: u32, c: u32) -> f64 {
        let squared = |p: u32, q: u32| {
            let (p, q) = (self.flat[p as usize], self.flat[q as usize]);
            (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1])
        };
        squared(a, b).max(squared(b, c)).max(squared(c, a))
    }

    /// Whether the fan around the first corner covers the polygon with well-shaped triangles that do not overlap: they
    /// stay within half a circle around it, or there are only two.
    fn is_fan(&self) -> bool {
        let count = self.flat.len() as u32;
        (1..count - 1).all(|corner| {
            self.is_clearly_convex(0, corner, corner + 1) && (count == 4 || self.area(0, 1, corner + 1) > 0.0)
        })
    }

    /// Cuts ears off until three corners are left; says whether the border crosses itself.
    fn clip_ears(&mut self) -> Result<bool, TooIntricate> {
        let count = self.flat.len() as u32;
        self.next.clear();
        self.next.extend((1..count).chain([0]));
        self.previous.clear();
        self.previous.extend([count - 1].into_iter().chain(0..count - 1));
        self.alive.clear();
        self.alive.resize(count as usize, true);
        self.turns.clear();
        self.turns.resize(count as usize, 0);
        self.tests = 0;
        self.fill_grid();
        let mut crossing = false;
        let mut left = count;
        let mut ear = Ear::Clear;
        while left > 3 {
            self.queue_all();
            self.tests += u64::from(count);
            let left_before = left;
            while let (true, Some(turn)) = (left > 3, self.queue.pop_front()) {
                let Turn { corner, number } = turn;
                if !self.alive[corner as usize] || self.turns[corner as usize] != number {
                    continue;
                }
                let (before, after) = (self.previous[corner as usize], self.next[corner as usize]);
                if !self.is_ear(before, corner, after, ear)? {
                    continue;
                }
                crossing |= ear == Ear::Forced || (ear == Ear::Any && self.area(before, corner, after) != 0.0);
                self.emit([before, corner, after]);
                self.alive[corner as usize] = false;
                self.next[before as usize] = after;
                self.previous[after as usize] = before;
                left -= 1;
                ear = Ear::Clear;
                if self.grid.is_stale_after_removing(corner) {
                    self.fill_grid();
                }
                // The neighbours may be ears now. Their turn comes last: cutting on at once would make a fan of long
                // thin triangles, and looking through all others first would take quadratic time.
                self.queue_corner(before);
                self.queue_corner(after);
            }
            if left == left_before {
                ear = match ear {
                    Ear::Clear => Ear::Thin,
                    Ear::Thin => Ear::Forced,
                    Ear::Forced | Ear::Any => Ear::Any,
                };
            }
        }
        let Some(corner) = (0..count).find(|&corner| self.alive[corner as usize]) else { return Ok(crossing) };
        let (before, after) = (self.previous[corner as usize], self.next[corner as usize]);
        crossing |= self.area(before, corner, after) < 0.0;
        self.emit([before, corner, after]);
        Ok(crossing)
    }

    /// Puts those corners that are left and can lie in an ear into the grid.
    fn fill_grid(&mut self) {
        let mut blockers = self.grid.take_corners();
        blockers.clear();
        blockers.extend((0..self.alive.len() as u32).filter(|&corner| {
            let (before, after) = (self.previous[corner as usize], self.next[corner as usize]);
            self.alive[corner as usize] && !self.is_clearly_convex(before, corner, after)
        }));
        self.tests += self.alive.len() as u64;
        self.grid.fill(blockers, &self.flat);
    }

    /// Lets every corner that is left have a turn.
    fn queue_all(&mut self) {
        self.queue.clear();
        for corner in 0..self.alive.len() as u32 {
            if self.alive[corner as usize] {
                self.queue_corner(corner);
            }
        }
    }

    /// Gives a corner a turn after all others; it loses an earlier one.
    fn queue_corner(&mut self, corner: u32) {
        let number = &mut self.turns[corner as usize];
        *number += 1;
        self.queue.push_back(Turn { corner, number: *number });
    }

    fn is_ear(&mut self, before: u32, corner: u32, after: u32, ear: Ear) -> Result<bool, TooIntricate> {
        self.tests += 1;
        let convex = match ear {
            Ear::Clear => self.is_clearly_convex(before, corner, after),
            Ear::Thin | Ear::Forced => self.area(before, corner, after) > 0.0,
            Ear::Any => true,
        };
        let free = convex && (matches!(ear, Ear::Forced | Ear::Any) || !self.is_blocked(before, corner, after));
        if self.tests > FREE_TESTS + TESTS_PER_CORNER * self.flat.len() as u64 {
            return Err(TooIntricate);
        }
        Ok(free)
    }

    /// Whether a corner of what is left lies in the triangle or on its border, other than at its corners (polygons with
    /// holes pass twice through the ends of the bridge to the hole).
    fn is_blocked(&mut self, a: u32, b: u32, c: u32) -> bool {
        let points = [a, b, c].map(|corner| self.flat[corner as usize]);
        // A corner on the border is there only up to rounding.
        let rounding = -1e-12 * self.longest_squared(a, b, c);
        let search = self.grid.any_near(points, |blocker| {
            let point = self.flat[blocker as usize];
            self.alive[blocker as usize]
                && !points.contains(&point)
                && self.area(a, b, blocker) >= rounding
                && self.area(b, c, blocker) >= rounding
                && self.area(c, a, blocker) >= rounding
        });
        self.tests += search.cost;
        search.found
    }
}

#[cfg(test)]
mod tests;
