//! Which photons are sent from which light at which caster.

use super::approach::{Start, Ways, is_astray};
use super::bright::Bright;
use super::casters::{Caster, Casters};
use crate::lanes::{Bits, Lanes};
use crate::sampling::sampler::hash3;
use crate::scene::{CurvedRow, Light, LightTable, NONE, Scene};
use glam::DVec3;
use std::sync::Arc;

/// Pairs of a light and a caster; more casters than this allows are taken together: each pair needs several photons.
const MOST_PAIRS: usize = 256;

/// How the light's surface and the caster's sphere lie to each other.
pub mod aim {
    /// Apart: photons start on the cap that can see the caster.
    pub const OUTSIDE: u32 = 0;
    /// The caster is within the light, which shines inwards.
    pub const INSIDE: u32 = 1;
    /// Neither: from all of the light, to both sides, if it has two.
    pub const EVERYWHERE: u32 = 2;
    /// The light is the bright part of the sky: photons start on a disc before the caster.
    pub const SKY: u32 = 3;
}

/// Pairs as look-up tables.
#[derive(Default)]
pub struct PairTable {
    /// The light.
    pub light: Vec<u32>,
    /// Middle of the light, of flat ones a corner.
    pub light_center: [Vec<f32>; 3],
    /// Its radius; read of spheres only.
    pub light_radius: Vec<f32>,
    /// Its primitive; [`NONE`] of flat ones, from which rays start off their plane.
    pub light_primitive: Vec<u32>,
    /// Unit vector from the light to the caster; of flat ones one edge.
    pub axis: [Vec<f32>; 3],
    /// Of flat lights the other edge; empty where there are none.
    pub edge: [Vec<f32>; 3],
    /// Of flat lights the unit normal; empty where there are none.
    pub normal: [Vec<f32>; 3],
    /// Of flat lights, and such with flat parts, how far off their plane rays start.
    pub offset: Vec<f32>,
    /// Of curved lights their row in [`Plan::curved`].
    pub row: Vec<u32>,
    /// Bits as in [`LightTable::FLAT`], of others, too, and [`LightTable::CURVED`].
    pub flags: Vec<u32>,
    /// 1 - cos of the half angle of the cap that photons start from; 2 is the whole light.
    pub cap: Vec<f32>,
    /// Middle of the caster's sphere.
    pub caster_center: [Vec<f32>; 3],
    /// Its squared radius.
    pub caster_radius2: Vec<f32>,
    /// How far before that middle photons start; infinite where they start at the light (see [`super::approach`]).
    pub approach: Vec<f32>,
    /// They go astray: no light paths are made of them.
    pub strays: Vec<bool>,
    /// Some start before their caster.
    pub any_far: bool,
    /// The caster.
    pub caster: Vec<u32>,
    /// One of [`aim`].
    pub aim: Vec<u32>,
    /// Flux of a photon, were it the only one, per cosine and solid angle of the cone it was chosen from
    /// ([`aim::EVERYWHERE`]: the flux).
    pub flux: [Vec<f32>; 3],
    /// Radiance of the light.
    pub radiance: [Vec<f32>; 3],
    /// Area of the light that photons start from, times the measure of directions of [`aim::EVERYWHERE`]; of the sky
    /// that of the disc before the caster.
    pub area: Vec<f32>,
    /// A number of its own, for its photons' random choices.
    pub key: Vec<u32>,
}

/// A light and a caster, as numbers in f64.
struct Pair {
    light: usize,
    caster: usize,
    aim: u32,
    cap: f64,
    /// By size and distance alone: what may arrive, but for a factor.
    weight: f64,
    /// Probability that a photon is of this pair.
    probability: f64,
}

/// What does not change from guide to guide.
pub struct Plan {
    /// The pairs.
    pub pairs: PairTable,
    /// Probability of each pair, and where its count starts (a number in 0 .. 1).
    chances: Vec<(f64, f64)>,
    /// Light and caster of each pair.
    pub ends: Vec<[usize; 2]>,
    /// Which casters the objects are.
    pub casters: Casters,
    /// The curved lights.
    pub curved: Arc<[CurvedRow]>,
    /// The bright part of the sky, a light behind the numbered ones, where photons are sent from there.
    pub bright: Option<Bright>,
    /// What all lights send towards the middle of the scene: flux, the sum of the channels, over the squared distance
    /// in units, which counts as one at least, and as the light's radius.
    pub sent: f32,
    /// How many photons all casters are worth, of those of mirrors in their place.
    worth: f64,
}

impl Plan {
    /// By size and distance; `None` where no light can reach anything over a caster.
    pub fn new(scene: &Scene, seed: u32) -> Option<Plan> {
        let sources = scene.lights.len() + usize::from(scene.environment().is_some());
        if scene.max_bounces == 0 || sources == 0 {
            return None;
        }
        let casters = Casters::new(scene, MOST_PAIRS / sources);
        let bright = if casters.list.is_empty() { None } else { Bright::new(scene) };
        let mut pairs = Vec::new();
        let (mut all, mut of_mirrors) = (0.0, 0.0);
        for (k, light) in scene.lights.iter().enumerate().filter(|(_, light)| light.is_drawn() && !light.is_sky()) {
            let pi = std::f64::consts::PI;
            let radiance = light.radiance().iter().sum::<f64>() * scene.tables.lights.share(k);
            // Area over 4 pi.
            let power = match light {
                Light::Sphere { .. } => {
                    let (_, radius) = light.bounds(&scene.spheres);
                    radiance * radius * radius
                }
                Light::Curved(_) | Light::Parallelogram(_) | Light::Triangle(_) => {
                    let faces = if light.two_sided() { 2.0 } else { 1.0 };
                    radiance * faces * light.area(&scene.spheres) / (4.0 * pi)
                }
            };
            // What is nearer than one unit, or within the light, counts as that far from it.
            let (center, radius) = light.bounds(&scene.spheres);
            all += power * 4.0 * pi * pi / center.length_squared().max(radius * radius).max(1.0);
            for (c, caster) in casters.list.iter().enumerate() {
                let mut pair = Pair::new(scene, light, caster);
                pair.weight *= power;
                of_mirrors += pair.weight;
                pair.weight *= caster.narrow;
                (pair.light, pair.caster) = (k, c);
                pairs.push(pair);
            }
        }
        if let Some(bright) = &bright {
            // What comes to a unit of area from a light at the distance d is, in these units, 4 pi^2 power / (pi d^2).
            all += 4.0 * std::f64::consts::PI * bright.fluence;
            for (c, caster) in casters.list.iter().enumerate() {
                let mut pair = Pair::of_sky(bright, caster);
                of_mirrors += pair.weight;
                pair.weight *= caster.narrow;
                (pair.light, pair.caster) = (scene.lights.len(), c);
                pairs.push(pair);
            }
        }
        let sum: f64 = pairs.iter().map(|p| p.weight).sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        pairs.retain(|p| p.weight > 0.0);
        for pair in &mut pairs {
            pair.probability = pair.weight / sum;
        }
        let unit = |k: usize, c: u32| (hash3(seed, k as u32, c) >> 40) as f64 / f64::from(1u32 << 24);
        Some(Plan {
            pairs: PairTable::new(scene, seed, &pairs, &casters, bright.as_ref()),
            chances: pairs.iter().enumerate().map(|(k, p)| (p.probability, unit(k, 0x0ff5_e700))).collect(),
            ends: pairs.iter().map(|p| [p.light, p.caster]).collect(),
            casters,
            curved: scene.tables.lights.curved.clone(),
            bright,
            sent: all as f32,
            worth: sum / of_mirrors,
        })
    }

    /// Lanes of the mask whose surface belongs to the caster of their pair.
    #[inline(always)]
    pub fn on_caster<F: Lanes>(&self, pair: F::U, primitive: F::U, instance: F::U, mask: F::M) -> F::M {
        let none = F::U::splat(0);
        let on_sphere = mask & instance.eq(F::U::splat(NONE));
        let on_instance = mask & !on_sphere;
        let of_sphere = F::U::gather(&self.casters.of_sphere, F::U::select(on_sphere, primitive, none));
        let of_instance = F::U::gather(&self.casters.of_instance, F::U::select(on_instance, instance, none));
        mask & F::U::select(on_instance, of_instance, of_sphere).eq(F::U::gather(&self.pairs.caster, pair))
    }

    /// How many photons are sent where of mirrors it would be so many.
    pub fn worth(&self, photons: u32) -> u32 {
        (f64::from(photons) * self.worth).ceil() as u32
    }

    /// Which of so many photons each pair has, without drawing lots.
    pub fn shares(&self, photons: u32) -> impl Iterator<Item = Share> + '_ {
        self.chances.iter().enumerate().filter_map(move |(pair, &(probability, start))| {
            let count = f64::from(photons).mul_add(probability, start).floor() as u32;
            (count > 0).then_some(Share { pair: pair as u32, first: 0, count })
        })
    }
}

/// Photons of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// The pair.
    pub pair: u32,
    /// Index of the first photon among those of the pair.
    pub first: u32,
    /// Number of photons.
    pub count: u32,
}

impl Pair {
    /// A light and a caster; the weight without the light's power.
    fn new(scene: &Scene, light: &Light, caster: &Caster) -> Pair {
        let (center, radius) = light.bounds(&scene.spheres);
        let distance = caster.center.distance(center);
        let (aim, cap) = match light.flat() {
            None if light.curved().is_some() => {
                let apart = distance > radius + caster.radius;
                (if apart { aim::OUTSIDE } else { aim::EVERYWHERE }, 2.0)
            }
            None if distance > radius + caster.radius => {
                // Points of the light from which the caster can be seen: those whose tangent plane cuts its sphere.
                (aim::OUTSIDE, 1.0 - (radius - caster.radius) / distance)
            }
            None if distance + caster.radius < radius && light.two_sided() => (aim::INSIDE, 2.0),
            None => (aim::EVERYWHERE, 2.0),
            Some(flat) => {
                let height = (caster.center - flat.corner).dot(flat.normal());
                let apart = distance > radius + caster.radius || height.abs() > caster.radius;
                (if apart { aim::OUTSIDE } else { aim::EVERYWHERE }, 2.0)
            }
        };
        // What lies within a light, or close to a flat one, gets no more than what is as far from its middle as its
        // rim is.
        let sine = (caster.radius / distance.max(radius).max(caster.radius)).min(1.0);
        let sin2 = sine * sine;
        let cone = sin2 / (1.0 + (1.0 - sin2).sqrt());
        // From a light with one side nothing goes where its back is seen.
        let shines = match light.normal() {
            Some(normal) => {
                let on_plane = light.flat().map_or(center, |flat| flat.corner);
                (caster.center - on_plane).dot(normal) > -caster.radius
            }
            None => light.two_sided() || light.curved().is_some() || distance + caster.radius > radius,
        };
        let weight = if shines { cone * caster.reflectance } else { 0.0 };
        Pair { light: 0, caster: 0, aim, cap: cap.clamp(0.0, 2.0), weight, probability: 0.0 }
    }

    /// The sky and a caster, the weight in the unit of [`Pair::new`] times a light's power: a light of radiance L and
    /// radius r at the distance d sends pi^2 L r^2 R^2 / d^2 to a caster of radius R and weighs L r^2 R^2 / (2 d^2).
    fn of_sky(bright: &Bright, caster: &Caster) -> Pair {
        let (_, radius) = bright.target(caster);
        let weight = bright.fluence * radius * radius / (2.0 * std::f64::consts::PI) * caster.reflectance;
        Pair { light: 0, caster: 0, aim: aim::SKY, cap: 0.0, weight, probability: 0.0 }
    }

    /// Area of the light that photons of the pair start from.
    fn area(&self, scene: &Scene, light: &Light) -> f64 {
        match light {
            Light::Sphere { .. } => {
                let (_, radius) = light.bounds(&scene.spheres);
                2.0 * std::f64::consts::PI * radius * radius * self.cap
            }
            Light::Curved(_) | Light::Parallelogram(_) | Light::Triangle(_) => light.area(&scene.spheres),
        }
    }
}

impl PairTable {
    fn new(scene: &Scene, seed: u32, pairs: &[Pair], casters: &Casters, bright: Option<&Bright>) -> PairTable {
        let mut table = PairTable::default();
        let any_flat = scene.lights.iter().any(|light| light.flat().is_some());
        let mut ways = Ways::new(scene);
        for (k, pair) in pairs.iter().enumerate() {
            let caster = &casters.list[pair.caster];
            table.caster.push(pair.caster as u32);
            table.aim.push(pair.aim);
            table.key.push(hash3(seed, k as u32, 0xca05_71c5) as u32);
            let Some(light) = scene.lights.get(pair.light) else {
                if let Some(bright) = bright {
                    table.push_sky(bright, caster, pair.probability, any_flat);
                }
                continue;
            };
            let radiance = light.radiance();
            let area = pair.area(scene, light);
            // Over all directions about the normal with a cosine, on each side that shines: pi.
            let sides = if light.two_sided() { 2.0 } else { 1.0 };
            let directions = if pair.aim == aim::EVERYWHERE { sides * std::f64::consts::PI } else { 1.0 };
            let density = pair.probability;
            table.push_light(scene, pair.light, caster.center, any_flat);
            for (axis, radiance) in radiance.into_iter().enumerate() {
                table.caster_center[axis].push(caster.center[axis] as f32);
                table.radiance[axis].push(radiance as f32);
                table.flux[axis].push((radiance * area * directions / density) as f32);
            }
            table.area.push((area * directions) as f32);
            table.cap.push(pair.cap as f32);
            table.caster_radius2.push((caster.radius * caster.radius * 1.000_01) as f32);
            let start = match pair.aim {
                aim::EVERYWHERE => Start::Light,
                other => ways.start(light, caster, other == aim::INSIDE),
            };
            table.approach.push(if let Start::Before(way) = start { way as f32 } else { f32::INFINITY });
            table.any_far |= matches!(start, Start::Before(_));
            table.strays.push(start == Start::Stray);
        }
        table
    }

    /// The bright part of the sky, from where photons come to a disc before the caster.
    fn push_sky(&mut self, bright: &Bright, caster: &Caster, probability: f64, any_flat: bool) {
        let target = bright.target(caster);
        let (center, radius) = target;
        // A little more, so that none of the caster's rim lies beside the disc.
        let radius2 = radius * radius * 1.000_01;
        let area = std::f64::consts::PI * radius2;
        let before = bright.before(target);
        for axis in 0..3 {
            self.caster_center[axis].push(center[axis] as f32);
            self.flux[axis].push((area / probability) as f32);
            let unused = [&mut self.light_center, &mut self.axis, &mut self.radiance].map(|columns| &mut columns[axis]);
            unused.into_iter().for_each(|column| column.push(0.0));
            if any_flat {
                [&mut self.edge, &mut self.normal]
                    .map(|columns| &mut columns[axis])
                    .into_iter()
                    .for_each(|c| c.push(0.0));
            }
        }
        self.caster_radius2.push(radius2 as f32);
        self.approach.push(before as f32);
        // Light paths are made where the disc is before all of the caster.
        self.strays.push(center != caster.center || is_astray(before, caster));
        self.area.push(area as f32);
        self.light.push(0);
        self.light_radius.push(0.0);
        self.light_primitive.push(NONE);
        self.offset.push(0.0);
        self.row.push(0);
        self.flags.push(0);
        self.cap.push(0.0);
    }

    /// Where photons of a light start. `any_flat`: the scene has flat lights.
    fn push_light(&mut self, scene: &Scene, number: usize, caster: DVec3, any_flat: bool) {
        let (light, lights) = (&scene.lights[number], &scene.tables.lights);
        let push = |columns: &mut [Vec<f32>; 3], v: DVec3| {
            columns.iter_mut().zip(v.to_array()).for_each(|(column, x)| column.push(x as f32));
        };
        let (center, radius) = light.bounds(&scene.spheres);
        let sphere_flags = if light.two_sided() { LightTable::TWO_SIDED } else { 0 };
        let [start, axis, edge, normal] = match light.flat() {
            None => [center, (caster - center).try_normalize().unwrap_or(DVec3::Z), DVec3::ZERO, DVec3::ZERO],
            Some(flat) => [flat.corner, flat.edges[0], flat.edges[1], flat.normal()],
        };
        push(&mut self.light_center, start);
        push(&mut self.axis, axis);
        if any_flat {
            push(&mut self.edge, edge);
            push(&mut self.normal, normal);
        }
        let (mut offset, mut flags, mut primitive, mut row) = (0.0, sphere_flags, NONE, 0);
        match light {
            Light::Sphere { sphere, .. } => primitive = *sphere,
            Light::Curved(_) => {
                row = number as u32 - lights.spheres;
                let curved = &lights.curved[row as usize];
                (offset, primitive) = (curved.lamp.offset() as f32, curved.primitive);
                flags |= LightTable::CURVED;
            }
            Light::Parallelogram(flat) => (offset, flags) = LightTable::offset_and_flags(flat, 0),
            Light::Triangle(flat) => (offset, flags) = LightTable::offset_and_flags(flat, LightTable::TRIANGLE),
        }
        self.light.push(number as u32);
        self.light_radius.push(radius as f32);
        self.light_primitive.push(primitive);
        self.offset.push(offset);
        self.flags.push(flags);
        self.row.push(row);
    }
}
