//! Surfaces in one place: where triangles lie in one plane, one above the other, one of them wins wherever both are.
//!
//! Which of two triangles in one plane a ray meets first is a matter of rounding, and would be another one from ray to
//! ray: both speckle. So they are found when the tree is built (`find`), each with those that win over it, and once
//! the closest hit is known, whoever it is on, the hit goes to the first of those whose edge functions say that
//! the ray's line passes through it (see [`triangle`](super::triangle)). The answer is a function of the ray and of
//! the triangles alone: of all that lie there the line passes the same ones, whichever of them the tree
//! finds, and each of them has the winner in its list, as what the line passes at one place overlaps. t stays
//! that of the closest.
//!
//! What wins is what shines, then what lets no light through, then what lets it through, then the smaller
//! (primitive, instance). A lamp let into the ceiling shines, and glass on a table shows the table.
//!
//! Where two bodies that let light through touch, one face stands for both: what is behind it is not the outside but
//! the other body ([`Coplanar::touching`]), and light passes from the one into the other at once. Else a ray that goes
//! from body to body would leave twice, or enter twice, and carry the square of an index too much or too little. Where
//! one lies in the other and ends where that ends, water flush with the rim, light passes into both at once. Bodies of
//! the same triangles are one, the first.
//!
//! Rays start off such a surface by more than the others may lie in front of it ([`Coplanar::offsets`]), and rays to a
//! surface end before it by as much; a ray to one that loses is blocked where the winner is. Who has no such
//! triangles pays for one question a batch.
//!
//! Disks and the caps of cones and cylinders take part as triangles do, with a circle in place of edges; a hit is on a
//! cap if the line meets the cap's plane at the t of the hit. Planes without an end are beside the tree and take part
//! with no edge at all. What of the same kind lies in one wins over it: else it would be seen nowhere.
//!
//! What lies farther apart than rounding takes it stays apart: two triangles are in one plane if the corners of one
//! are no farther from the plane of the other than twice what the rounding of both may have moved them.

mod find;
mod grid;
mod pairs;
mod same;

use super::geometry::NONE;
use super::ray_space::RaySpace;
use super::triangle::passes;
use super::{Hits, Occlusion, Rays};
use crate::shapes::FlatFace;

/// Who wins: by (rank, primitive, instance), the least.
#[derive(Debug, Default)]
pub struct Ranks {
    /// Of each triangle, in the order of their primitives; none: 0.
    pub triangles: Vec<u8>,
    /// Of all triangles of an instance whose own is not 0.
    pub instances: Vec<Option<u8>>,
    /// Of each curved shape, and behind them of each plane; none: 0.
    pub shapes: Vec<u8>,
    /// Materials, where any of them lets light through.
    pub materials: Option<Materials>,
}

/// Rank of what lets light through.
pub const TRANSMITS: u8 = 2;

/// Of what is behind a face: its body lies on the same side, so that light passes into both at once.
pub const SAME_SIDE: u32 = 1 << 31;

/// Which material things have.
#[derive(Debug, Default)]
pub struct Materials {
    /// Of each triangle, in the order of their primitives.
    pub triangles: Vec<u32>,
    /// Of all triangles of an instance that do not have their own.
    pub instances: Vec<Option<u32>>,
    /// Of each curved shape, and behind them of each plane.
    pub shapes: Vec<u32>,
}

impl Materials {
    fn of(&self, k: u32, instance: u32) -> Option<u32> {
        let whole = self.instances.get(instance as usize).copied().flatten();
        whole.or_else(|| self.triangles.get(k as usize).copied())
    }
}

impl Ranks {
    /// The rank of the `k`th triangle in an instance.
    fn of(&self, k: u32, instance: u32) -> u8 {
        match self.triangles.get(k as usize) {
            None | Some(0) => 0,
            Some(&own) => self.instances.get(instance as usize).copied().flatten().unwrap_or(own),
        }
    }
}

/// Lists of more winners than this have a grid over them.
const LONG: usize = 16;

/// The triangles and flat parts of curved shapes of a scene that lie in one plane with others and overlap them.
pub struct Coplanar {
    triangles: Offsets,
    shapes: Offsets,
    /// By (primitive, instance), rising; of the caps of a shape the first comes first.
    members: Vec<Member>,
    /// Of all members: indices into `members`.
    winners: Vec<u32>,
    /// Of bodies that touch: indices into `members`, and material + 1 of these, with [`SAME_SIDE`] or without.
    touching: Vec<[u32; 2]>,
    /// Planes without an end, each with the (primitive, instance) of all that lies in it, rising.
    in_planes: Vec<[u32; 3]>,
    /// Over long lists of winners.
    grids: Vec<Grid>,
}

/// How far rays start off primitives whose ids follow each other; 0 where nothing else lies in their planes.
#[derive(Default)]
struct Offsets {
    first: u32,
    of: Vec<f32>,
}

impl Offsets {
    fn get(&self, primitive: u32) -> f32 {
        primitive.checked_sub(self.first).and_then(|k| self.of.get(k as usize)).copied().unwrap_or(0.0)
    }
}

/// How far a member reaches in its plane.
enum Outline {
    /// Corners in render space, as the tree tests them where the mesh is there already.
    Triangle([[f32; 3]; 3]),
    Curved(FlatFace),
}

impl Outline {
    /// Whether a ray's line passes within it.
    fn is_passed(&self, space: &RaySpace, origin: [f32; 3], direction: [f32; 3]) -> bool {
        match self {
            Outline::Triangle(corners) => passes(space, *corners),
            Outline::Curved(face) => face.passed(origin, direction).is_some(),
        }
    }
}

struct Member {
    primitive: u32,
    instance: u32,
    outline: Outline,
    normal: [f32; 3],
    /// Where those that win over it stand in `Coplanar::winners`, the first to win first.
    winners: [u32; 2],
    /// Where those of other bodies stand in `Coplanar::touching`.
    touching: [u32; 2],
    /// Which of `Coplanar::grids` has them by place.
    grid: Option<usize>,
}

impl Member {
    /// How much of a direction leads across its plane.
    fn across(&self, d: [f32; 3]) -> f32 {
        let n = self.normal;
        (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]).abs()
    }
}

/// Squares over a triangle, for those that have hundreds of others on them.
struct Grid {
    axes: [usize; 2],
    lower: [f32; 2],
    /// Cells per length.
    scale: [f32; 2],
    /// Cells along each side.
    cells: usize,
    /// The winners that reach into each cell: where they begin in `lists`, and the end of the last.
    starts: Vec<u32>,
    lists: Vec<u32>,
}

impl Grid {
    /// The winners near the place where a ray meets the plane, the first to win first.
    fn near(&self, origin: [f32; 3], direction: [f32; 3], t: f32) -> &[u32] {
        let cell = [0, 1].map(|k: usize| {
            let at = t.mul_add(direction[self.axes[k]], origin[self.axes[k]]);
            // NaN and what lies beyond end up in a cell at the border.
            ((at - self.lower[k]) * self.scale[k]).max(0.0).min((self.cells - 1) as f32) as usize
        });
        let place = cell[1] * self.cells + cell[0];
        &self.lists[self.starts[place] as usize..self.starts[place + 1] as usize]
    }
}

impl Coplanar {
    /// How far rays start off each triangle at least, by its place among the triangles.
    pub fn offsets(&self) -> &[f32] {
        &self.triangles.of
    }

    /// How far rays start off each curved shape at least, by its place among the shapes; empty where none takes part.
    pub fn shape_offsets(&self) -> &[f32] {
        &self.shapes.of
    }

    /// How far rays start off a primitive at least, and end before it; 0 where nothing else lies in its plane.
    pub fn offset(&self, primitive: u32) -> f32 {
        self.triangles.get(primitive).max(self.shapes.get(primitive))
    }

    /// Whether another one wins over some part of a primitive.
    pub fn is_covered(&self, primitive: u32, instance: u32) -> bool {
        let from = self.members.partition_point(|m| (m.primitive, m.instance) < (primitive, instance));
        let of_primitive = |m: &&Member| (m.primitive, m.instance) == (primitive, instance);
        self.members[from..].iter().take_while(of_primitive).any(|m| m.winners[0] < m.winners[1])
    }

    /// Whether another one wins over a primitive where a ray's line passes it at t, which may be that of a plane so far
    /// beside.
    pub fn is_covered_at(&self, target: (u32, u32), rays: &Rays, ray: usize, t: f32, slack: f32) -> bool {
        self.member(target, rays, ray, t, slack).is_some_and(|member| self.winner(member, rays, ray, t).is_some())
    }

    /// All primitives that take part, rising.
    pub fn primitives(&self) -> Vec<u32> {
        let mut all: Vec<u32> = self.members.iter().map(|member| member.primitive).collect();
        all.dedup();
        all
    }

    /// The member that a primitive is in which a ray goes to or hits, at t, which may be that of a plane so far beside.
    fn member(
        &self,
        (primitive, instance): (u32, u32),
        rays: &Rays,
        ray: usize,
        t: f32,
        slack: f32,
    ) -> Option<&Member> {
        if primitive == NONE {
            return None;
        }
        if self.triangles.get(primitive) > 0.0 {
            let at = self.members.binary_search_by_key(&(primitive, instance), |m| (m.primitive, m.instance)).ok()?;
            return Some(&self.members[at]);
        }
        if self.shapes.get(primitive) == 0.0 {
            return None;
        }
        let (origin, direction) = ray_of(rays, ray);
        let from = self.members.partition_point(|m| m.primitive < primitive);
        self.members[from..].iter().take_while(|m| m.primitive == primitive).find(|m| match &m.outline {
            // A plane is nothing else.
            Outline::Curved(face) if face.is_endless() => true,
            // Not the side of the shape: t is that of the plane, rounded.
            Outline::Curved(face) => face.passed(origin, direction).is_some_and(|at| {
                let beside = (at as f32 - t).abs();
                beside <= t * f32::EPSILON || beside * m.across(direction) <= slack
            }),
            Outline::Triangle(_) => false,
        })
    }

    /// The first of those that win over a member whose outlines the ray's line passes within, but for the one that the
    /// ray leaves, `from`.
    fn winner(&self, member: &Member, rays: &Rays, ray: usize, t: f32) -> Option<&Member> {
        let [first, end] = member.winners;
        if first == end {
            return None;
        }
        let (origin, direction) = ray_of(rays, ray);
        let from = (rays.from_primitive[ray], rays.from_instance[ray]);
        let space = RaySpace::new(origin, direction)?;
        let list = match member.grid {
            Some(grid) => self.grids[grid].near(origin, direction, t),
            None => &self.winners[first as usize..end as usize],
        };
        // A ray may leave one cap of a shape and come to the other.
        let is_one = |m: &Member| match &m.outline {
            Outline::Triangle(_) => true,
            Outline::Curved(face) => face.is_endless(),
        };
        let left = |m: &Member| is_one(m) && (m.primitive, m.instance) == from;
        let mut others =
            list.iter().map(|&k| &self.members[k as usize]).filter(|m| !left(m) && !std::ptr::eq(*m, member));
        others.find(|m| m.outline.is_passed(&space, origin, direction))
    }

    /// Gives the closest hits of some rays to those who win there.
    pub fn settle(&self, rays: &Rays, active: &[u32], hits: &mut Hits) {
        for ray in active.iter().map(|&ray| ray as usize) {
            let hit = (hits.primitive[ray], hits.instance[ray]);
            let Some(member) = self.member(hit, rays, ray, hits.t[ray], 0.0) else { continue };
            if let Some(winner) = self.winner(member, rays, ray, hits.t[ray]) {
                hits.primitive[ray] = winner.primitive;
                hits.instance[ray] = winner.instance;
            }
        }
    }

    /// Whether something lies in a plane without an end.
    pub fn lies_in(&self, plane: u32, primitive: u32, instance: u32) -> bool {
        self.in_planes.binary_search(&[plane, primitive, instance]).is_ok()
    }

    /// Whether bodies that let light through touch anywhere.
    pub fn has_touching(&self) -> bool {
        !self.touching.is_empty()
    }

    /// The body that begins where some rays meet one that lets light through, for hits that were settled: its
    /// material + 1, with [`SAME_SIDE`] where it begins or ends with the first. Nothing is written where nothing
    /// touches.
    pub fn touching(&self, rays: &Rays, active: &[u32], hits: &Hits, behind: &mut [u32]) {
        for ray in active.iter().map(|&ray| ray as usize) {
            let hit = (hits.primitive[ray], hits.instance[ray]);
            let slack = self.shapes.get(hit.0);
            let Some(member) = self.member(hit, rays, ray, hits.t[ray], slack) else { continue };
            let [first, end] = member.touching;
            let (origin, direction) = ray_of(rays, ray);
            let Some(space) = RaySpace::new(origin, direction) else { continue };
            let touching = &self.touching[first as usize..end as usize];
            let passed = |other: u32| self.members[other as usize].outline.is_passed(&space, origin, direction);
            if let Some([_, material]) = touching.iter().find(|[other, _]| passed(*other)) {
                behind[ray] = *material;
            }
        }
    }

    /// The ends of shadow rays, each before all that lies in the plane that it goes to. The plane is nearer than `tmax`
    /// by the offset over the cosine.
    pub fn ends(&self, rays: &Rays, active: &[u32], occlusion: &Occlusion) -> Vec<f32> {
        let mut ends = occlusion.tmax.to_vec();
        for ray in active.iter().map(|&ray| ray as usize) {
            let (primitive, instance) = (occlusion.target_primitive[ray], occlusion.target_instance[ray]);
            let target = (primitive, instance);
            let Some(member) = self.member(target, rays, ray, occlusion.tmax[ray], 0.0) else { continue };
            let (_, d) = ray_of(rays, ray);
            let before = self.triangles.get(primitive) / member.across(d);
            // Along the plane nothing is left, nor is anything to be seen there.
            ends[ray] = if before < ends[ray] { ends[ray] - before } else { 0.0 };
        }
        ends
    }

    /// Blocks the rays that go to what another one covers.
    pub fn cover(&self, rays: &Rays, active: &[u32], occlusion: &mut Occlusion) {
        for ray in active.iter().map(|&ray| ray as usize) {
            let (primitive, instance) = (occlusion.target_primitive[ray], occlusion.target_instance[ray]);
            let target = (primitive, instance);
            let Some(member) = self.member(target, rays, ray, occlusion.tmax[ray], 0.0) else { continue };
            if self.winner(member, rays, ray, occlusion.tmax[ray]).is_some() {
                occlusion.occluded[ray] = 1;
            }
        }
    }
}

fn ray_of(rays: &Rays, ray: usize) -> ([f32; 3], [f32; 3]) {
    ([rays.ox[ray], rays.oy[ray], rays.oz[ray]], [rays.dx[ray], rays.dy[ray], rays.dz[ray]])
}
