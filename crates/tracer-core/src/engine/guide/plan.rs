//! Which photons are sent from which light at which caster.

use super::casters::{Caster, Casters};
use crate::lanes::{Bits, Lanes};
use crate::sampling::sampler::hash3;
use crate::scene::{Light, NONE, Scene, Sphere};

/// Pairs of a light and a caster; more casters than this allows are taken together: each pair needs several photons.
const MOST_PAIRS: usize = 256;

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
    /// Flux of a photon, were it the only one, per cosine and solid angle of the cone it was chosen from ([`aim::EVERYWHERE`]: the flux).
    pub flux: [Vec<f32>; 3],
    /// Radiance of the light.
    pub radiance: [Vec<f32>; 3],
    /// Area of the light that photons start from, times the measure of directions of [`aim::EVERYWHERE`].
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
    /// Flux of all lights, the sum of the channels.
    pub power: f32,
}

impl Plan {
    /// By size and distance; `None` where no light can reach anything over a caster.
    pub fn new(scene: &Scene, seed: u32) -> Option<Plan> {
        if scene.max_bounces == 0 || scene.lights.is_empty() {
            return None;
        }
        let casters = Casters::new(scene, MOST_PAIRS / scene.lights.len());
        let mut pairs = Vec::new();
        let mut all = 0.0;
        for (k, Light::Sphere { sphere, radiance }) in scene.lights.iter().enumerate() {
            let light = scene.spheres.get(*sphere as usize)?;
            let power = radiance.iter().sum::<f64>() * light.radius * light.radius;
            all += power * 4.0 * std::f64::consts::PI * std::f64::consts::PI;
            for (c, caster) in casters.list.iter().enumerate() {
                let mut pair = Pair::new(light, caster);
                pair.weight *= power;
                (pair.light, pair.caster) = (k, c);
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
            pairs: PairTable::new(scene, seed, &pairs, &casters),
            chances: pairs.iter().enumerate().map(|(k, p)| (p.probability, unit(k, 0x0ff5_e700))).collect(),
            ends: pairs.iter().map(|p| [p.light, p.caster]).collect(),
            casters,
            power: all as f32,
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
        Pair { light: 0, caster: 0, aim, cap: cap.clamp(0.0, 2.0), weight: cone * caster.reflectance, probability: 0.0 }
    }
}

impl PairTable {
    fn new(scene: &Scene, seed: u32, pairs: &[Pair], casters: &Casters) -> PairTable {
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
            let density = pair.probability;
            for axis_index in 0..3 {
                table.light_center[axis_index].push(light.center[axis_index] as f32);
                table.caster_center[axis_index].push(caster.center[axis_index] as f32);
                table.axis[axis_index].push(axis[axis_index] as f32);
                table.radiance[axis_index].push(radiance[axis_index] as f32);
                table.flux[axis_index].push((radiance[axis_index] * area * directions / density) as f32);
            }
            table.area.push((area * directions) as f32);
            table.light_radius.push(light.radius as f32);
            table.light_primitive.push(sphere);
            table.cap.push(pair.cap as f32);
            table.caster_radius2.push((caster.radius * caster.radius * 1.000_01) as f32);
            table.caster.push(pair.caster as u32);
            table.aim.push(pair.aim);
            table.key.push(hash3(seed, k as u32, 0xca05_71c5) as u32);
        }
        table
    }
}
