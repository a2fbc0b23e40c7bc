//! Textures made of others, step by step. Lanes with one program do its steps together, so that no step has to be
//! looked up lane by lane: as many rounds as there are programs among the lanes, and hardly ever are there two.

use super::{At, Lookup, luminance, mapped, on_sphere, vertex_color};
use crate::engine::stages::textures::texture_color;
use crate::lanes::{Bits, Lanes, Mask, Part};
use crate::math::{V3, exp, ln};
use crate::scene::{Between, Made, Op, PLACES, PatternTable, Scene, Space};

/// Patterns and programs are looked up.
pub(super) struct Mixed<'t, F: Lanes> {
    pub scene: &'t Scene,
    pub id: F::U,
    pub at: At<F>,
    /// The shading normal, on either side.
    pub normal: V3<F>,
    pub mask: F::M,
}

/// Most lanes that there are.
const MOST_LANES: usize = 32;

impl<F: Lanes> Part<F> for Mixed<'_, F> {
    type Out = V3<F>;
    #[inline(always)]
    fn run(self) -> V3<F> {
        let mut ids = [0; MOST_LANES];
        self.id.store(&mut ids);
        let mut color = V3::zero();
        let mut left = self.mask;
        while left.any() {
            let id = ids[left.bits().trailing_zeros() as usize % MOST_LANES];
            let on = left & self.id.eq(F::U::splat(id));
            left = left & !on;
            color = V3::select(on, self.one(id, on), color);
        }
        color
    }
}

impl<F: Lanes> Mixed<'_, F> {
    /// The colour of one pattern or program.
    #[inline(always)]
    fn one(&self, id: u32, on: F::M) -> V3<F> {
        let table = &self.scene.tables.patterns;
        let pattern = [Op { to: 0, made: Made::Pattern(id) }];
        let (ops, stops) = match table.programs.get((id as usize).wrapping_sub(table.patterns.len())) {
            Some(program) => (&program.ops[..], &program.stops[..]),
            None => (&pattern[..], &[][..]),
        };
        let mut places = [V3::zero(); PLACES];
        for op in ops {
            let made = match op.made {
                Made::Color(color) => splat(color),
                Made::Pattern(id) => F::apart(Lookup { table, id: F::U::splat(id), at: self.at, mask: on }),
                Made::Texture { texture, space, ref map } => {
                    let (u, v) = self.coordinates(space, map, on);
                    texture_color(&self.scene.tables.textures, F::U::splat(texture), u, v, on)
                }
                Made::VertexColor(space) => vertex_color::color(self.scene, space, &self.at, on),
                Made::Mix([a, b, weight]) => {
                    let (a, b) = (at(&places, a), at(&places, b));
                    b.sub(a).mad(luminance(at(&places, weight)), a)
                }
                Made::Multiply([a, b]) => at(&places, a).mul(at(&places, b)),
                Made::Ramp { input, first, count, between } => {
                    let end = (first as usize).saturating_add(count as usize).min(stops.len());
                    ramp(luminance(at(&places, input)), &stops[(first as usize).min(end)..end], between)
                }
                Made::Triplanar { colors: [x, y, z], sharpness } => {
                    let V3(a, b, c) = self.weights(sharpness as f32, on);
                    at(&places, z).mad(c, at(&places, y).mad(b, at(&places, x).scale(a)))
                }
            };
            places[op.to as usize % PLACES] = made;
        }
        places[0]
    }

    /// What a picture's mapping starts from.
    #[inline(always)]
    fn coordinates(&self, space: Space, map: &[[f64; 4]; 3], on: F::M) -> (F, F) {
        if space == Space::Uv {
            return (self.at.u, self.at.v);
        }
        let p = mapped(&self.scene.tables.patterns.to_object, self.entry(space, on), self.at.p);
        let p = V3(along(&map[0], p), along(&map[1], p), along(&map[2], p));
        if space == Space::Spherical { on_sphere(p) } else { (p.0, p.1) }
    }

    /// Where the matrix to the coordinates of a space begins.
    #[inline(always)]
    fn entry(&self, space: Space, on: F::M) -> F::U {
        let world = F::U::splat(0);
        if space == Space::World {
            return world;
        }
        let entry = F::U::gather(&self.scene.tables.patterns.entry, F::U::select(on, self.at.body, world));
        F::U::select(on, entry, world) * F::U::splat(12)
    }

    /// |n|^sharpness along each axis of the coordinates that the surface is written in, together 1.
    #[inline(always)]
    fn weights(&self, sharpness: f32, on: F::M) -> V3<F> {
        let n = normal_of::<F>(&self.scene.tables.patterns, self.entry(Space::Object, on), self.normal).abs();
        let most = n.max_component();
        let usable = F::splat(0.0).lt(most);
        let n = n.scale(F::splat(1.0) / F::select(usable, most, F::splat(1.0)));
        let power = F::splat(sharpness);
        let (x, y, z) = (powered(n.0, power), powered(n.1, power), powered(n.2, power));
        let sum = x + y + z;
        V3(x, y, z).scale(F::splat(1.0) / sum)
    }
}

/// The direction of a normal in the coordinates that a matrix leads to: by its cofactors, up to a factor.
#[inline(always)]
fn normal_of<F: Lanes>(table: &PatternTable, place: F::U, n: V3<F>) -> V3<F> {
    let four = F::U::splat(4);
    let [ax, ay, az] = F::gather3(&table.to_object, place);
    let [bx, by, bz] = F::gather3(&table.to_object, place + four);
    let [cx, cy, cz] = F::gather3(&table.to_object, place + four + four);
    let (a, b, c) = (V3(ax, ay, az), V3(bx, by, bz), V3(cx, cy, cz));
    V3(b.cross(c).dot(n), c.cross(a).dot(n), a.cross(b).dot(n))
}

/// x^power, x from 0 to 1.
#[inline(always)]
fn powered<F: Lanes>(x: F, power: F) -> F {
    exp(ln(x.max(F::splat(1e-30))) * power)
}

/// A row of a matrix at a point.
#[inline(always)]
fn along<F: Lanes>(row: &[f64; 4], p: V3<F>) -> F {
    let c = F::splat;
    c(row[2] as f32).fma(p.2, c(row[1] as f32).fma(p.1, c(row[0] as f32).fma(p.0, c(row[3] as f32))))
}

#[inline(always)]
fn at<F: Lanes>(places: &[V3<F>; PLACES], place: u8) -> V3<F> {
    places[place as usize % PLACES]
}

#[inline(always)]
fn splat<F: Lanes>(color: [f64; 3]) -> V3<F> {
    V3::splat([color[0] as f32, color[1] as f32, color[2] as f32])
}

/// The colour at x between stops that never fall, the first and the last beyond them.
#[inline(always)]
fn ramp<F: Lanes>(x: F, stops: &[(f64, [f64; 3])], between: Between) -> V3<F> {
    let c = F::splat;
    let mut color = V3::zero();
    let mut last = (0.0, V3::zero());
    let mut first = true;
    for stop in stops {
        let (place, next) = (stop.0 as f32, splat(stop.1));
        if first {
            color = next;
        } else {
            let width = place - last.0;
            if between != Between::Constant && 0.0 < width {
                let f = ((x - c(last.0)) / c(width)).max(c(0.0)).min(c(1.0));
                let f = if between == Between::Smooth { f * f * f.fma(c(-2.0), c(3.0)) } else { f };
                color = V3::select(c(last.0).le(x), next.sub(last.1).mad(f, last.1), color);
            }
            color = V3::select(c(place).le(x), next, color);
        }
        first = false;
        last = (place, next);
    }
    color
}
