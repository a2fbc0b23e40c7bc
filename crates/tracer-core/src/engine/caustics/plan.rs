//! Which photons are sent from which light at which caster, how far they are told apart, and whether it is worth it.

use super::aims::Aims;
use super::casters::{Caster, Casters};
use crate::sampling::sampler::hash3;
use crate::scene::{Light, Scene, Sphere};

/// Pairs of a light and a caster; more casters than this allows are taken together: each pair needs several photons.
const MOST_PAIRS: usize = 256;
/// A light that fills more of a caster's sky than this (squared sine of half the angle) is found well enough by scattered rays.
const WIDE_LIGHT: f64 = 0.4;
/// The smallest and the largest radius within which photons are gathered in the first map, in sizes of their caster: what lies around it
/// is hardly larger.
const DETAIL: [f64; 2] = [0.01, 0.5];
/// The largest such radius, in render space, where scenes are about one in size. Four times as much made half the noise where photons
/// are few, and took 1 % of the light from a floor along a mirror wall.
const LARGEST_RADIUS: f64 = 1.0 / 64.0;
/// Photons are gathered within one of so many radii, each half the one before.
pub const LEVELS: usize = 10;
/// Share of the photons that goes to the pairs by size and distance alone, whatever the trial says.
const UNTRIED: f64 = 0.25;
/// A scene whose casters pass on less of its light than this to diffuse surfaces does without a map.
const LEAST_SHARE: f64 = 4e-5;

/// How the light's surface and the caster's sphere lie to each other.
pub mod aim {
    /// Apart: photons start on the cap that can see the caster.
    pub const OUTSIDE: u32 = 0;
    /// The caster is within the light, which shines inwards, too.
    pub const INSIDE: u32 = 1;
    /// Neither: from all of the light, to both sides.
    pub const EVERYWHERE: u32 = 2;
}

/// Pairs as look-up tables.
#[derive(Default)]
pub struct PairTable {
    /// Middle of the light.
    pub light_center: [Vec<f32>; 3],
    /// Its radius.
    pub light_radius: Vec<f32>,
    /// Its primitive.
    pub light_primitive: Vec<u32>,
    /// Unit vector from the light to the caster.
    pub axis: [Vec<f32>; 3],
    /// 1 - cos of the half angle of the cap that photons start from; 2 is the whole light.
    pub cap: Vec<f32>,
    /// Middle of the caster's sphere.
    pub caster_center: [Vec<f32>; 3],
    /// Its squared radius.
    pub caster_radius2: Vec<f32>,
    /// The caster.
    pub caster: Vec<u32>,
    /// One of [`aim`].
    pub aim: Vec<u32>,
    /// Flux of a photon per cosine and solid angle of the cone it was chosen from ([`aim::EVERYWHERE`]: the flux).
    pub flux: [Vec<f32>; 3],
    /// The smallest radius, below [`LEVELS`].
    pub finest: Vec<u32>,
    /// The largest radius, at most `finest`.
    pub coarsest: Vec<u32>,
    /// A number of its own, for its photons' random choices.
    pub key: Vec<u32>,
}

/// A light and a caster, as numbers in f64.
struct Pair {
    light: usize,
    caster: usize,
    aim: u32,
    cap: f64,
    finest: u32,
    coarsest: u32,
    /// By size and distance alone: what may arrive, but for a factor.
    weight: f64,
    /// Probability that a photon is of this pair.
    probability: f64,
}

/// What does not change from map to map.
pub struct Plan {
    /// The pairs.
    pub pairs: PairTable,
    /// Probability of each pair, and where its count starts (a number in 0 .. 1).
    chances: Vec<(f64, f64)>,
    /// Photons of a map, about.
    pub photons: u32,
    /// Which casters the objects are.
    pub casters: Casters,
    /// Per light: photons carry its light to diffuse surfaces over mirrors and glass, so scattered rays do not.
    pub mapped: Vec<u32>,
    /// Radii of the first map.
    pub radii: [f32; LEVELS],
    /// What rays from diffuse surfaces are aimed at.
    pub aims: Aims,
}

impl Plan {
    /// By size and distance alone; `None` where no light is to be carried.
    pub fn new(scene: &Scene, seed: u32) -> Option<Plan> {
        if scene.max_bounces == 0 || scene.lights.is_empty() {
            return None;
        }
        let casters = Casters::new(scene, MOST_PAIRS / scene.lights.len());
        let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
        let photons = (pixels / 4).next_power_of_two().clamp(1024, 65536) as u32;
        let mut pairs = Vec::new();
        let mut mapped = vec![0; scene.lights.len().max(1)];
        for (k, Light::Sphere { sphere, radiance }) in scene.lights.iter().enumerate() {
            let light = scene.spheres.get(*sphere as usize)?;
            let power = radiance.iter().sum::<f64>() * light.radius * light.radius;
            let first = pairs.len();
            // How much of the casters' sky it fills, by what they get.
            let (mut filled, mut sum) = (0.0, 0.0);
            for (c, caster) in casters.list.iter().enumerate() {
                let mut pair = Pair::new(light, caster);
                pair.weight *= power;
                (pair.light, pair.caster) = (k, c);
                let distance = caster.center.distance(light.center).max(caster.radius);
                let sine = light.radius / distance;
                filled += pair.weight * (sine * sine).min(1.0);
                sum += pair.weight;
                pairs.push(pair);
            }
            if sum > 0.0 && filled < WIDE_LIGHT * sum {
                mapped[k] = 1;
            } else {
                pairs.truncate(first);
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
        Some(Plan::of_pairs(scene, seed, &pairs, photons, casters, mapped))
    }

    fn of_pairs(scene: &Scene, seed: u32, pairs: &[Pair], photons: u32, casters: Casters, mapped: Vec<u32>) -> Plan {
        let unit = |k: usize, c: u32| (hash3(seed, k as u32, c) >> 40) as f64 / f64::from(1u32 << 24);
        Plan {
            pairs: PairTable::new(scene, seed, pairs, &casters, photons),
            chances: pairs.iter().enumerate().map(|(k, p)| (p.probability, unit(k, 0x0ff5_e700))).collect(),
            photons,
            casters,
            mapped,
            aims: Aims::new(scene),
            radii: std::array::from_fn(|l| (LARGEST_RADIUS / f64::from(1u32 << l)) as f32),
        }
    }

    /// The plan after a trial that stored so much flux of each pair, summed over channels: photons go where they arrived. `None`:
    /// it is not worth it.
    pub fn after(mut self, scene: &Scene, stored_of_pairs: &[f64]) -> Option<Plan> {
        let stored: f64 = stored_of_pairs.iter().sum();
        let emitted: f64 = scene
            .lights
            .iter()
            .filter_map(|Light::Sphere { sphere, radiance }| {
                let radius = scene.spheres.get(*sphere as usize)?.radius;
                let area = 4.0 * std::f64::consts::PI * radius * radius;
                Some(std::f64::consts::PI * area * radiance.iter().sum::<f64>())
            })
            .sum();
        let worth = stored.is_finite() && stored > LEAST_SHARE * emitted;
        if !worth {
            return None;
        }
        for (k, (probability, _)) in self.chances.iter_mut().enumerate() {
            let new = UNTRIED.mul_add(*probability, (1.0 - UNTRIED) * stored_of_pairs[k] / stored);
            let scale = (*probability / new) as f32;
            self.pairs.flux.iter_mut().for_each(|channel| channel[k] *= scale);
            *probability = new;
        }
        Some(self)
    }

    /// The photons of map `map`: per pair that has any, its first index among the pair's photons of all maps, and how many. On
    /// average a pair gets its probability times `photons`, without drawing lots: its count so far is never off by one.
    pub fn shares(&self, map: u32, photons: u32) -> impl Iterator<Item = Share> + '_ {
        let photons = f64::from(photons);
        self.chances.iter().enumerate().filter_map(move |(pair, &(probability, start))| {
            let until = |map: u32| (f64::from(map) * photons).mul_add(probability, start).floor() as u64;
            let (first, end) = (until(map), until(map + 1));
            (end > first).then_some(Share { pair: pair as u32, first: first as u32, count: (end - first) as u32 })
        })
    }
}

/// Photons of a pair in a map.
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
    fn new(light: &Sphere, caster: &Caster) -> Pair {
        let distance = caster.center.distance(light.center);
        let (aim, cap) = if distance > light.radius + caster.radius {
            // Points of the light from which the caster can be seen: those whose tangent plane cuts its sphere.
            (aim::OUTSIDE, 1.0 - (light.radius - caster.radius) / distance)
        } else if distance + caster.radius < light.radius {
            (aim::INSIDE, 2.0)
        } else {
            (aim::EVERYWHERE, 2.0)
        };
        let sine = (caster.radius / distance.max(caster.radius)).min(1.0);
        let sin2 = sine * sine;
        let cone = sin2 / (1.0 + (1.0 - sin2).sqrt());
        let last = LEVELS as u32 - 1;
        let level = |detail: f64| {
            let fits = |level: &u32| LARGEST_RADIUS <= detail * caster.size * f64::from(1u32 << level);
            (0..last).find(fits).unwrap_or(last)
        };
        Pair {
            light: 0,
            caster: 0,
            aim,
            cap: cap.clamp(0.0, 2.0),
            finest: level(DETAIL[0]),
            coarsest: level(DETAIL[1]),
            weight: cone * caster.reflectance,
            probability: 0.0,
        }
    }
}

impl PairTable {
    fn new(scene: &Scene, seed: u32, pairs: &[Pair], casters: &Casters, photons: u32) -> PairTable {
        let mut table = PairTable::default();
        for (k, pair) in pairs.iter().enumerate() {
            let Light::Sphere { sphere, radiance } = scene.lights[pair.light];
            let light = &scene.spheres[sphere as usize];
            let caster = &casters.list[pair.caster];
            let axis = (caster.center - light.center).try_normalize().unwrap_or(glam::DVec3::Z);
            let two_pi = 2.0 * std::f64::consts::PI;
            let area = two_pi * light.radius * light.radius * pair.cap;
            // Over all directions about the normal with a cosine, on both sides: 2 pi in all.
            let directions = if pair.aim == aim::EVERYWHERE { two_pi } else { 1.0 };
            let density = f64::from(photons) * pair.probability;
            for axis_index in 0..3 {
                table.light_center[axis_index].push(light.center[axis_index] as f32);
                table.caster_center[axis_index].push(caster.center[axis_index] as f32);
                table.axis[axis_index].push(axis[axis_index] as f32);
                table.flux[axis_index].push((radiance[axis_index] * area * directions / density) as f32);
            }
            table.light_radius.push(light.radius as f32);
            table.light_primitive.push(sphere);
            table.cap.push(pair.cap as f32);
            table.caster_radius2.push((caster.radius * caster.radius * 1.000_01) as f32);
            table.caster.push(pair.caster as u32);
            table.aim.push(pair.aim);
            table.finest.push(pair.finest);
            table.coarsest.push(pair.coarsest);
            table.key.push(hash3(seed, k as u32, 0xca05_71c5) as u32);
        }
        table
    }
}
