//! Lights, and the tree by which one of them is chosen.

use super::table::Table;
use super::{Environment, Glow, Sphere};
use crate::shapes::{Lamp, UnitShape};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A light. What it shines it shines in all directions alike from each of its points, and it reflects nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// A sphere of `Scene::spheres`.
    Sphere {
        /// Index into `Scene::spheres`.
        sphere: u32,
        /// Radiance per channel, in `Scene::radiance_unit`.
        radiance: [f64; 3],
        /// It shines inwards, too.
        two_sided: bool,
        /// It is a sky: the camera, and so all that it can see, is within. What it shines is met by rays that go on, as
        /// a background is, and never asked for: it comes from all sides alike, which those rays know best.
        is_sky: bool,
    },
    /// A curved shape of `Scene::shapes`.
    Curved(CurvedLight),
    /// A parallelogram of two triangles: all p = corner + u edges\[0\] + v edges\[1\], u and v from 0 to 1.
    Parallelogram(FlatLight),
    /// A triangle: the same with u + v at most 1.
    Triangle(FlatLight),
}

/// A flat light, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatLight {
    /// A corner.
    pub corner: DVec3,
    /// From there to both next corners. It shines to the side of edges\[0\] x edges\[1\].
    pub edges: [DVec3; 2],
    /// Radiance per channel, in `Scene::radiance_unit`.
    pub radiance: [f64; 3],
    /// It shines to the other side, too.
    pub two_sided: bool,
    /// Rays start and end so far off its plane at least: what lies in its plane may be so far before it
    /// ([`crate::bvh::Accel::coplanar_offset`]).
    pub offset: f64,
}

/// A curved shape that shines, in render space; of a solid an operand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvedLight {
    /// Index into `Scene::shapes`.
    pub shape: u32,
    /// What it is in its object space; a solid with one operand: the one that shines, with the bounds of what may be
    /// left of it.
    pub unit: UnitShape,
    /// From there to render space.
    pub placement: DAffine3,
    /// Radiance per channel, in `Scene::radiance_unit`.
    pub radiance: [f64; 3],
    /// It shines inwards, or to the other side, too.
    pub two_sided: bool,
    /// As [`FlatLight::offset`], of its flat parts.
    pub offset: f64,
}

impl CurvedLight {
    /// Unit normal of the only side that all of it shines to, if there is one.
    fn normal(&self) -> Option<DVec3> {
        let is_flat = matches!(self.unit, UnitShape::Disk { .. }) && !self.two_sided;
        is_flat.then(|| (self.placement.matrix3.inverse().transpose() * DVec3::Z).normalize_or_zero())
    }
}

impl FlatLight {
    /// Unit normal of the side that it shines to; zero where it has no area.
    pub fn normal(&self) -> DVec3 {
        self.edges[0].cross(self.edges[1]).normalize_or_zero()
    }
}

impl Light {
    /// Radiance per channel, in `Scene::radiance_unit`: of one with a texture where that is white.
    pub fn radiance(&self) -> [f64; 3] {
        match self {
            Light::Sphere { radiance, .. } => *radiance,
            Light::Curved(curved) => curved.radiance,
            Light::Parallelogram(flat) | Light::Triangle(flat) => flat.radiance,
        }
    }

    /// Makes it one that shines nothing.
    pub fn darken(&mut self) {
        match self {
            Light::Sphere { radiance, .. } => *radiance = [0.0; 3],
            Light::Curved(curved) => curved.radiance = [0.0; 3],
            Light::Parallelogram(flat) | Light::Triangle(flat) => flat.radiance = [0.0; 3],
        }
    }

    /// Has rays start and end so far off its flat parts at least.
    pub fn keep_off(&mut self, least: f64) {
        match self {
            Light::Sphere { .. } => {}
            Light::Curved(CurvedLight { offset, .. })
            | Light::Parallelogram(FlatLight { offset, .. })
            | Light::Triangle(FlatLight { offset, .. }) => *offset = offset.max(least),
        }
    }

    /// Whether both of its sides shine.
    pub fn two_sided(&self) -> bool {
        match self {
            Light::Sphere { two_sided, .. } => *two_sided,
            Light::Curved(curved) => curved.two_sided,
            Light::Parallelogram(flat) | Light::Triangle(flat) => flat.two_sided,
        }
    }

    /// Whether it is a sky, which is never asked for.
    pub fn is_sky(&self) -> bool {
        matches!(self, Light::Sphere { is_sky: true, .. })
    }

    /// A flat light.
    pub fn flat(&self) -> Option<&FlatLight> {
        match self {
            Light::Sphere { .. } | Light::Curved(_) => None,
            Light::Parallelogram(flat) | Light::Triangle(flat) => Some(flat),
        }
    }

    /// A curved one that is no sphere.
    pub fn curved(&self) -> Option<&CurvedLight> {
        if let Light::Curved(curved) = self { Some(curved) } else { None }
    }

    /// The only side that it shines to, where that is one for all of it.
    pub fn normal(&self) -> Option<DVec3> {
        match self {
            Light::Sphere { .. } => None,
            Light::Curved(curved) => curved.normal(),
            Light::Parallelogram(flat) | Light::Triangle(flat) => (!flat.two_sided).then(|| flat.normal()),
        }
    }

    /// Whether points of it can be drawn, for photons and light paths to start from: not of what is left of an operand.
    pub fn is_drawn(&self) -> bool {
        self.curved().is_none_or(|curved| !matches!(curved.unit, UnitShape::Solid(_)))
    }

    /// Its area, of one side; of an operand that of a sphere about it. `spheres`: those of the scene.
    pub fn area(&self, spheres: &[Sphere]) -> f64 {
        let spanned = |flat: &FlatLight| flat.edges[0].cross(flat.edges[1]).length();
        match self {
            Light::Sphere { sphere, .. } => {
                let radius = spheres.get(*sphere as usize).map_or(0.0, |s| s.radius);
                4.0 * std::f64::consts::PI * radius * radius
            }
            Light::Curved(curved) => curved.unit.area(&curved.placement),
            Light::Parallelogram(flat) => spanned(flat),
            Light::Triangle(flat) => 0.5 * spanned(flat),
        }
    }

    /// Middle and radius of a sphere around it.
    pub fn bounds(&self, spheres: &[Sphere]) -> (DVec3, f64) {
        let (corners, count) = match self {
            Light::Sphere { sphere, .. } => {
                return spheres.get(*sphere as usize).map_or((DVec3::ZERO, 0.0), |s| (s.center, s.radius));
            }
            Light::Curved(CurvedLight { unit: UnitShape::Solid(solid), .. }) => {
                let [low, high] = solid.bounds;
                return (0.5 * (low + high), 0.5 * (high - low).length());
            }
            Light::Curved(curved) => return (curved.placement.translation, curved.unit.radius(&curved.placement)),
            Light::Parallelogram(FlatLight { corner, edges: [a, b], .. }) => {
                ([*corner, *corner + *a, *corner + *b, *corner + *a + *b], 4)
            }
            Light::Triangle(FlatLight { corner, edges: [a, b], .. }) => {
                ([*corner, *corner + *a, *corner + *b, *corner], 3)
            }
        };
        let corners = &corners[..count];
        let center = corners.iter().sum::<DVec3>() / count as f64;
        (center, corners.iter().map(|c| c.distance(center)).fold(0.0, f64::max))
    }
}

/// A curved light as the engine reads it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvedRow {
    /// How it is sampled.
    pub lamp: Lamp,
    /// Radiance.
    pub radiance: [f32; 3],
    /// Its primitive id.
    pub primitive: u32,
    /// It shines inwards, or to the other side, too.
    pub two_sided: bool,
}

/// Lights as look-up tables, and the tree by which one of them is chosen. Spheres come first, then the curved ones.
#[derive(Clone)]
pub struct LightTable {
    /// Number of lights.
    pub len: u32,
    /// Number of those that shine and are no skies: the others are met as all are, but never asked, and not in the
    /// tree.
    pub asked: u32,
    /// There is a sky that shines.
    pub has_sky: bool,
    /// Number of spheres among them.
    pub spheres: u32,
    /// Of the spheres: centre and radius, radiance, the bits of the primitive id of the light's sphere, 1 where it
    /// shines inwards, else 0, and 1 where it is a sky, else 0.
    pub rows: Table<10>,
    /// The curved ones.
    pub curved: Arc<[CurvedRow]>,
    /// Number of spheres and curved ones.
    pub first_flat: u32,
    /// Of the flat ones, at least one row.
    pub flat: Table<{ LightTable::FLAT }>,
    /// Nodes of [`LightTable::STRIDE`] numbers, the root first, the two children of a node side by side: centre, radius
    /// and power of the lights below, the bits of the first child's index, or of [`LightTable::LEAF`] and a light, and
    /// 1 for [`LightTable::FEW`] lights at most, FEW / n for n; then which way they face ([`Facing`]): slack, axis,
    /// around.
    pub tree: Vec<f32>,
    /// The way from the root to each light, level by level from the lowest bit on: 1 is the second child.
    pub trail: Vec<u32>,
    /// Steps from the root to the deepest light.
    pub depth: u32,
    /// No child of a node that may send something has a smaller chance to be asked: see [`LightTable::LEAST_CHANCE`].
    pub least_chance: f32,
    /// Light from all directions.
    pub environment: Option<Arc<Environment>>,
    /// What is known of lamps whose points shine unlike each other, where there are any.
    pub glow: Option<Arc<Glow>>,
}

/// A light as the tree sees it.
struct Emitter {
    center: DVec3,
    radius: f64,
    /// Radiant intensity but for a factor, the largest of all directions: for spheres radius^2 times the sum of the
    /// channels.
    power: f64,
    /// Normal of the only side that shines.
    normal: Option<DVec3>,
}

impl Emitter {
    /// `share`: how much of its radiance the light has, on average.
    fn new(light: &Light, spheres: &[Sphere], share: f64) -> Self {
        let (center, radius) = light.bounds(spheres);
        let radiance = light.radiance().iter().sum::<f64>() * share;
        let power = match light {
            Light::Sphere { .. } => radius * radius * radiance,
            // What a closed one shows is a quarter of its surface, on average.
            Light::Curved(curved) if !matches!(curved.unit, UnitShape::Disk { .. }) => {
                0.25 * light.area(spheres) / std::f64::consts::PI * radiance
            }
            Light::Curved(_) | Light::Parallelogram(_) | Light::Triangle(_) => {
                light.area(spheres) / std::f64::consts::PI * radiance
            }
        };
        Emitter { center, radius, power, normal: light.normal() }
    }
}

impl LightTable {
    /// Numbers of a flat light: corner, edges, unit normal, radiance, area, how far off its plane rays end, and bits:
    /// [`LightTable::TRIANGLE`], [`LightTable::TWO_SIDED`], [`LightTable::PLANE`].
    pub const FLAT: usize = 18;
    /// Bit of a triangle.
    pub const TRIANGLE: u32 = 1;
    /// Bit of a light with two sides.
    pub const TWO_SIDED: u32 = 2;
    /// Bit of a flat light.
    pub const PLANE: u32 = 4;
    /// Bit of a curved light that is no sphere.
    pub const CURVED: u32 = 8;
    /// No child of a node that may send something has a smaller chance: the other one may be hidden, and its share of
    /// the light may be one to the last bit of single precision, by which the dim one would never be asked, or so
    /// rarely that 24 bits of a random number do not tell it. Ten steps to a light that is all there is take a
    /// twenty-fifth of its samples.
    pub const LEAST_CHANCE: f32 = 1.0 / 256.0;
    /// Nor, where there are few steps, a smaller one than this over their number: a lamp in a room, which a sun outside
    /// is a hundred times as bright as, has a sixteenth of the samples: the sun may shine in by a small window only.
    pub const LEAST_SHARE: f32 = 1.0 / 16.0;
    /// Numbers of a node.
    pub const STRIDE: u32 = 12;
    /// Where a node holds what it is: see [`LightTable::tree`].
    pub const CONTENT: usize = 5;
    /// Where it holds which way it faces.
    pub const FACING: usize = 7;
    /// So many lights may all lie in the highest place of their sphere. Of more it is unlikely.
    const FEW: f64 = 4.0;
    /// Marks a node that is a light.
    pub const LEAF: u32 = 1 << 31;

    /// Of lights among which the spheres come first, then the curved ones. All shine evenly.
    pub fn new(lights: &[Light], spheres: &[Sphere], environment: Option<Arc<Environment>>) -> Self {
        Self::with_glow(lights, spheres, environment, None)
    }

    /// The same, of lights some of which may shine unevenly.
    pub fn with_glow(
        lights: &[Light],
        spheres: &[Sphere],
        environment: Option<Arc<Environment>>,
        glow: Option<Arc<Glow>>,
    ) -> Self {
        let share = |k: usize| glow.as_ref().map_or(1.0, |glow| f64::from(glow.share[k]));
        let emitter = |(k, light): (usize, &Light)| Emitter::new(light, spheres, share(k));
        let emitters: Vec<Emitter> = lights.iter().enumerate().map(emitter).collect();
        let rows = lights.iter().filter_map(|light| {
            let Light::Sphere { sphere, radiance, two_sided, is_sky } = *light else { return None };
            let s = spheres.get(sphere as usize)?;
            let ([x, y, z], [r, g, b]) = (s.center.as_vec3().to_array(), radiance.map(|x| x as f32));
            let [inwards, sky] = [two_sided, is_sky].map(|is| f32::from(u8::from(is)));
            Some([x, y, z, s.radius as f32, r, g, b, f32::from_bits(sphere), inwards, sky])
        });
        let flat = lights.iter().filter_map(|light| {
            let flat = light.flat()?;
            let triangle = if matches!(light, Light::Triangle(_)) { Self::TRIANGLE } else { 0 };
            Some(Self::flat_row(flat, light.area(spheres), triangle))
        });
        let curved = lights.iter().filter_map(Light::curved).map(|curved| CurvedRow {
            lamp: Lamp::new(&curved.unit, &curved.placement, curved.two_sided).keep_off(curved.offset),
            radiance: curved.radiance.map(|x| x as f32),
            primitive: spheres.len() as u32 + curved.shape,
            two_sided: curved.two_sided,
        });
        let curved: Arc<[CurvedRow]> = curved.collect();
        let pad = |mut v: Vec<u32>| {
            v.resize(v.len().max(16), 0);
            v
        };
        let mut builder = Builder { emitters: &emitters, tree: Vec::new(), trail: vec![0; emitters.len()], depth: 0 };
        let shines = |light: &Light| light.radiance() != [0.0; 3];
        let is_asked = |light: &Light| shines(light) && !light.is_sky();
        let mut order: Vec<u32> = (0..).zip(lights).filter(|(_, light)| is_asked(light)).map(|(k, _)| k).collect();
        let asked = order.len() as u32;
        builder.tree.resize(Self::STRIDE as usize, 0.0);
        if asked > 0 {
            builder.node(0, &mut order, 0, 0);
        }
        let sphere_count = lights.iter().filter(|light| matches!(light, Light::Sphere { .. })).count();
        LightTable {
            len: emitters.len() as u32,
            asked,
            has_sky: lights.iter().any(|light| light.is_sky() && shines(light)),
            spheres: sphere_count as u32,
            rows: Table::new(rows),
            first_flat: (sphere_count + curved.len()) as u32,
            curved,
            flat: Table::new(flat),
            depth: builder.depth,
            least_chance: (Self::LEAST_SHARE / builder.depth.max(1) as f32).max(Self::LEAST_CHANCE),
            trail: pad(builder.trail),
            tree: builder.tree,
            environment,
            glow,
        }
    }

    /// How much of its radiance light `k` has, on average.
    pub fn share(&self, k: usize) -> f64 {
        self.glow.as_ref().and_then(|glow| glow.share.get(k)).map_or(1.0, |&share| f64::from(share))
    }

    /// Whether there is none to ask.
    pub fn is_empty(&self) -> bool {
        self.asked == 0 && self.environment.is_none()
    }

    /// Whether one is to be chosen.
    #[inline(always)]
    pub fn several(&self) -> bool {
        self.asked > 1 || (self.asked == 1 && self.environment.is_some())
    }

    /// Whether there are lights other than spheres.
    #[inline(always)]
    pub fn has_others(&self) -> bool {
        self.spheres < self.len
    }

    /// Whether there are flat ones.
    #[inline(always)]
    pub fn has_flat(&self) -> bool {
        self.first_flat < self.len
    }

    /// Whether there are curved ones that are no spheres.
    #[inline(always)]
    pub fn has_curved(&self) -> bool {
        self.spheres < self.first_flat
    }

    fn flat_row(flat: &FlatLight, area: f64, triangle: u32) -> [f32; Self::FLAT] {
        let mut row = [0.0; Self::FLAT];
        let vectors = [flat.corner, flat.edges[0], flat.edges[1], flat.normal(), DVec3::from(flat.radiance)];
        for (k, vector) in vectors.iter().enumerate() {
            row[3 * k..3 * k + 3].copy_from_slice(&vector.as_vec3().to_array());
        }
        let (offset, flags) = Self::offset_and_flags(flat, triangle);
        row[15] = area as f32;
        row[16] = offset;
        row[17] = f32::from_bits(flags);
        row
    }

    /// How far off its plane rays start and end, and the bits of a flat light: twice the bound of a hit's error there
    /// (see `stages::surface`), so that they do not meet it, and as far as it says itself.
    pub fn offset_and_flags(flat: &FlatLight, triangle: u32) -> (f32, u32) {
        let [a, b] = flat.edges;
        let corners = [flat.corner, flat.corner + a, flat.corner + b, flat.corner + a + b];
        let magnitude = corners.iter().map(|c| c.abs().element_sum()).fold(0.0, f64::max);
        let offset = flat.offset.max(magnitude * 7.0 * f64::from(f32::EPSILON));
        (offset as f32, Self::PLANE | triangle | if flat.two_sided { Self::TWO_SIDED } else { 0 })
    }
}

/// Which way the lights of a node face: towards a receiver in the unit direction w and the distance d from the node's
/// middle they turn max(0, min(1, axis . w + around + slack / d)) of their faces, about.
///
/// It is above zero wherever one of them faces the receiver. With normals at most a < 90 degrees off the axis, and all
/// within r of the middle, that is where w is less than 90 degrees + a + asin(r / d) off it (Conty Estevez and Kulla
/// 2018, section 4.1), so at cosines above -sin(a + asin(r / d)) >= -(sin a + r / d); from there on this grows with the
/// cosine up to 1 on the axis, without an angle to be found.
struct Facing {
    axis: DVec3,
    around: f64,
    slack: f64,
}

impl Facing {
    /// Where nothing is known.
    const ALL: Facing = Facing { axis: DVec3::ZERO, around: 1.0, slack: 0.0 };
    /// Added around, so that no light that faces a receiver is lost to roundings.
    const LEAST: f64 = 0.01;

    /// Of lights in a sphere of this radius.
    fn new<'a>(lights: impl Iterator<Item = &'a Emitter> + Clone, radius: f64) -> Self {
        let Some(normals) = lights.clone().map(|light| light.normal).collect::<Option<Vec<DVec3>>>() else {
            return Facing::ALL;
        };
        if let [normal] = normals[..] {
            return Facing { axis: normal, around: 0.0, slack: 0.0 };
        }
        let power: f64 = lights.clone().map(|light| light.power).sum();
        let mean = normals.iter().zip(lights).map(|(&normal, light)| light.power * normal).sum::<DVec3>() / power;
        let Some(axis) = mean.try_normalize() else { return Facing::ALL };
        let cos = normals.iter().map(|normal| normal.dot(axis)).fold(1.0, f64::min);
        if cos <= 0.0 {
            // They may face any way: most of them as the mean does.
            return Facing { axis: 0.5 * axis * mean.length().min(0.9), around: 0.5, slack: 0.0 };
        }
        let sin = (1.0 - cos * cos).sqrt();
        let scale = 1.0 / (1.0 + sin);
        Facing { axis: axis * scale, around: sin * scale + Self::LEAST, slack: radius * scale }
    }
}

/// Builds the tree: halves by number along the widest axis of the centres, so that no way is much longer than log2 of
/// their number. A light that all others stand in is split off before them: it would make any group that it is of as
/// wide and as strong as itself.
struct Builder<'a> {
    emitters: &'a [Emitter],
    tree: Vec<f32>,
    trail: Vec<u32>,
    depth: u32,
}

/// So many lights around all others, one around the other, are split off at most.
const MOST_AROUND: u32 = 8;

impl Builder<'_> {
    /// Which of these lights all others stand in, if one does.
    fn around_all(&self, lights: &[u32]) -> Option<usize> {
        let of = |k: usize| &self.emitters[lights[k] as usize];
        let (widest, _) = (0..lights.len()).map(|k| (k, of(k).radius)).max_by(|a, b| a.1.total_cmp(&b.1))?;
        let (center, radius) = (of(widest).center, of(widest).radius);
        // By twice their size: of many in one place none is around the others.
        let is_within = |k: usize| of(k).center.distance(center) + 2.0 * of(k).radius <= radius;
        (0..lights.len()).all(|k| k == widest || is_within(k)).then_some(widest)
    }

    /// Fills node `at` with these lights, which lie `depth` steps below the root along `trail`.
    fn node(&mut self, at: usize, lights: &mut [u32], trail: u32, depth: u32) {
        let emitters = self.emitters;
        let of = |light: u32| &emitters[light as usize];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &light in lights.iter() {
            (low, high) = (low.min(of(light).center), high.max(of(light).center));
        }
        let center = (low + high) * 0.5;
        let radius = lights.iter().map(|&l| (of(l).center - center).length() + of(l).radius).fold(0.0, f64::max);
        let power: f64 = lights.iter().map(|&l| of(l).power).sum();
        let content = if let [light] = *lights {
            self.trail[light as usize] = trail;
            self.depth = self.depth.max(depth);
            LightTable::LEAF | light
        } else {
            let size = high - low;
            let axis = (0..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest });
            // The index decides between equal places, so that the tree depends on nothing else.
            lights.sort_unstable_by(|&a, &b| of(a).center[axis].total_cmp(&of(b).center[axis]).then(a.cmp(&b)));
            let mut middle = lights.len() / 2;
            let may_be_split = lights.len() > 2 && depth < MOST_AROUND;
            if let Some(around) = may_be_split.then(|| self.around_all(lights)).flatten() {
                lights[..=around].rotate_right(1);
                middle = 1;
            }
            let first = self.tree.len();
            self.tree.resize(first + 2 * LightTable::STRIDE as usize, 0.0);
            let (left, right) = lights.split_at_mut(middle);
            self.node(first, left, trail, depth + 1);
            self.node(first + LightTable::STRIDE as usize, right, trail | 1 << depth, depth + 1);
            first as u32 / LightTable::STRIDE
        };
        let numbers = [center.x, center.y, center.z, radius, power].map(|x| x as f32);
        self.tree[at..at + 5].copy_from_slice(&numbers);
        self.tree[at + LightTable::CONTENT] = f32::from_bits(content);
        self.tree[at + LightTable::CONTENT + 1] = (LightTable::FEW / lights.len() as f64).min(1.0) as f32;
        let Facing { axis, around, slack } = Facing::new(lights.iter().map(|&light| of(light)), radius);
        let facing = [slack, axis.x, axis.y, axis.z, around].map(|x| x as f32);
        self.tree[at + LightTable::FACING..][..5].copy_from_slice(&facing);
    }
}
