//! What the stages reckon at one vertex of one path, for whoever explains it: one lane, by the functions that they
//! call, with the random numbers that they draw. It traces nothing; that its numbers are those of the picture, whoever
//! asks can see by what the stages have made of them.

use super::stages::lights::{self, LightHit, Receiver};
use super::stages::materials::Bsdf;
use super::stages::shade::weight_of_ratio;
use super::stages::surface::Surface;
use super::stages::surface_at::surface_at;
use crate::lanes::{ArrayF, ArrayU, Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::{Pair, Purpose};
use crate::scene::{NONE, Scene};

type One = ArrayF<1>;

fn number(x: One) -> f32 {
    let mut out = [0.0];
    x.store(&mut out);
    out[0]
}

fn vector(v: V3<One>) -> [f32; 3] {
    [number(v.0), number(v.1), number(v.2)]
}

fn word(x: ArrayU<1>) -> u32 {
    let mut out = [0];
    x.store(&mut out);
    out[0]
}

fn is<M: Mask>(mask: M) -> bool {
    mask.any()
}

/// A path's ray and what it has hit; in render space.
#[derive(Clone, Copy, Debug)]
pub struct RayHit {
    /// Where the ray starts.
    pub origin: [f32; 3],
    /// Unit direction.
    pub direction: [f32; 3],
    /// Shading normal where it starts: lights that it meets had been chosen by it.
    pub normal: [f32; 3],
    /// Density of its direction; `None` where lights are found by such rays only.
    pub pdf: Option<f32>,
    /// Its length.
    pub t: f32,
    /// The primitive, not NONE.
    pub primitive: u32,
    /// Its instance.
    pub instance: u32,
    /// What the batch's hits say of a body behind.
    pub behind: u32,
}

/// Whose random numbers.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    /// Seed of the picture.
    pub seed: u32,
    /// Column and row.
    pub pixel: [u32; 2],
    /// Sample index.
    pub sample: u32,
    /// The vertex of the path.
    pub vertex: u32,
}

impl Draw {
    fn points(&self, purpose: Purpose) -> [f32; 2] {
        Pair::new(self.seed, purpose).point(self.pixel[0], self.pixel[1], self.sample)
    }

    /// What decides whether the path goes on.
    pub fn roulette(&self) -> f32 {
        self.points(Purpose::Roulette(self.vertex))[0]
    }

    fn lobe(&self) -> f32 {
        self.points(Purpose::Roulette(self.vertex))[1]
    }
}

/// What a ray takes on where it is scattered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampledLobe {
    /// By the cosine.
    Diffuse,
    /// About the mirror's direction; where the material has a diffuse lobe too, the density is that of both.
    Glossy,
    /// A mirror's direction.
    Mirror,
    /// Glass: its direction says whether it was reflected or let through.
    Glass,
}

/// Light that a ray met.
#[derive(Clone, Copy, Debug)]
pub struct LightMet {
    /// What comes from there.
    pub radiance: [f32; 3],
    /// Density with which a light sample takes this direction.
    pub pdf: f32,
    /// What it counts, beside light samples.
    pub weight: f32,
}

/// A light sample.
#[derive(Clone, Copy, Debug)]
pub struct LightSampled {
    /// Which light; `None`: the picture of all directions.
    pub light: Option<u32>,
    /// Density of the direction, the choice of the light included; zero where there is none.
    pub pdf: f32,
    /// Unit direction.
    pub direction: [f32; 3],
    /// How far the light is.
    pub distance: f32,
    /// What it sends.
    pub radiance: [f32; 3],
    /// Cosine at the surface.
    pub cos: f32,
    /// f of the material.
    pub f: [f32; 3],
    /// Density with which the material takes the direction.
    pub material_pdf: f32,
    /// What the sample counts where the material's own ray may find the light, too.
    pub weight: f32,
}

/// The vertex where a path's ray has hit something.
pub struct Vertex<'s> {
    scene: &'s Scene,
    ray: RayHit,
    surface: Surface<One>,
    bsdf: Bsdf<'s, One>,
}

impl<'s> Vertex<'s> {
    /// The number of what the surface is of, by which coordinates are found (`Scene::to_object`).
    pub fn body(&self) -> u32 {
        word(self.surface.body)
    }

    /// Of a ray that has hit something.
    pub fn new(scene: &'s Scene, ray: RayHit) -> Self {
        let valid = One::first(1);
        let (origin, direction) = (V3::splat(ray.origin), V3::splat(ray.direction));
        let (primitive, instance) = (ArrayU::splat(ray.primitive), ArrayU::splat(ray.instance));
        let surface = surface_at(scene, origin, direction, One::splat(ray.t), primitive, instance, valid);
        let lamp = !surface.light.eq(ArrayU::splat(0));
        let bsdf = Bsdf::met(scene, &surface, valid & !lamp, &[ray.behind], 0);
        Vertex { scene, ray, surface, bsdf }
    }

    /// The point.
    pub fn point(&self) -> [f32; 3] {
        vector(self.surface.p)
    }

    /// Where rays of light samples start.
    pub fn start(&self) -> [f32; 3] {
        vector(self.surface.start)
    }

    /// Shading normal, on the side that the ray came from.
    pub fn normal(&self) -> [f32; 3] {
        vector(self.surface.ns)
    }

    /// Normal of the surface itself, on the same side.
    pub fn geometric(&self) -> [f32; 3] {
        vector(self.surface.ng)
    }

    /// Whether the ray came from outside.
    pub fn is_outside(&self) -> bool {
        is(self.surface.outside)
    }

    /// The light that it is.
    pub fn light(&self) -> Option<u32> {
        word(self.surface.light).checked_sub(1)
    }

    /// The material's colour, textures included.
    pub fn color(&self) -> [f32; 3] {
        vector(self.bsdf.color)
    }

    /// Whether light samples are taken here.
    pub fn is_rough(&self) -> bool {
        is(self.bsdf.rough())
    }

    /// Whether light leaves alike in all directions.
    pub fn is_diffuse(&self) -> bool {
        is(self.bsdf.diffuse)
    }

    /// Of glass: the share that it reflects, and the index of refraction that the ray meets.
    pub fn glass(&self) -> Option<[f32; 2]> {
        let wo = V3::<One>::splat(self.ray.direction).neg();
        let of_glass = || [number(self.bsdf.dielectric(&self.surface, wo).reflectance), number(self.bsdf.ior())];
        is(self.bsdf.transparent).then(of_glass)
    }

    /// By what lobe the path goes on; `None` where nothing is scattered.
    pub fn lobe(&self, draw: &Draw) -> Option<SampledLobe> {
        let glossy = || is(self.bsdf.takes_glossy(One::splat(draw.lobe())));
        let rough = || if glossy() { SampledLobe::Glossy } else { SampledLobe::Diffuse };
        match self {
            _ if is(self.bsdf.mirror) => Some(SampledLobe::Mirror),
            _ if is(self.bsdf.transparent) => Some(SampledLobe::Glass),
            _ if self.is_rough() => Some(rough()),
            _ => None,
        }
    }

    /// The light that the ray met here; `None` where it met none.
    pub fn met(&self) -> Option<LightMet> {
        let light = ArrayU::splat(self.light()?);
        let lights = &self.scene.tables.lights;
        let direction = V3::<One>::splat(self.ray.direction);
        let s = &self.surface;
        let (distance, cos) = (One::splat(self.ray.t), direction.dot(s.ng).abs());
        let met = LightHit { direction, distance, cos, front: s.outside, lanes: One::first(1) };
        let at = Receiver { p: V3::splat(self.ray.origin), n: V3::splat(self.ray.normal) };
        let pdf = number(lights::pdf(lights, light, at, &met));
        let mut radiance = lights::radiance(lights, light, &met);
        if lights.glow.is_some() {
            radiance = radiance.mul(lights::share_at(self.scene, s, One::first(1)));
        }
        Some(LightMet { radiance: vector(radiance), pdf, weight: met_weight(self.ray.pdf, pdf) })
    }

    /// The light sample that is taken here; `None` where there is none to take.
    pub fn light_sample(&self, draw: &Draw) -> Option<LightSampled> {
        let lights = &self.scene.tables.lights;
        if !self.is_rough() || lights.is_empty() {
            return None;
        }
        let c = One::splat;
        let [u, v] = if lights.several() { draw.points(Purpose::Choice(draw.vertex)) } else { [0.0; 2] };
        let s = &self.surface;
        let choice = lights::choose(lights, Receiver { p: s.start, n: s.ns }, c(u), c(v));
        let [u, v] = draw.points(Purpose::Light(draw.vertex));
        let on = if self.ray.instance == NONE { self.ray.primitive } else { NONE };
        let from = lights::Start { p: s.start, on: ArrayU::splat(on), parts: &self.scene.tables.shapes.parts };
        let l = lights::sample(lights, &choice, from, c(u), c(v), One::first(1));
        let mut radiance = l.radiance;
        if lights.glow.is_some() {
            let on_lamp = One::first(1) & !choice.environment;
            let ray = (s.start, l.wi);
            radiance = radiance.mul(lights::share_towards(self.scene, choice.light, ray, l.distance, on_lamp));
        }
        let cos = s.ns.dot(l.wi);
        let wo = V3::<One>::splat(self.ray.direction).neg();
        let (f, pdf) = self.bsdf.evaluate(s.ns, wo, l.wi, cos);
        let comes = is(self.bsdf.reaches(cos) & c(0.0).lt(l.distance));
        let inverse = number(l.inverse_pdf);
        Some(LightSampled {
            light: (!is(choice.environment)).then(|| word(choice.light)),
            pdf: if inverse > 0.0 { 1.0 / inverse } else { 0.0 },
            direction: vector(l.wi),
            distance: number(l.distance),
            radiance: vector(radiance),
            cos: number(cos),
            f: if comes { vector(f) } else { [0.0; 3] },
            material_pdf: if comes { number(pdf) } else { 0.0 },
            weight: number(weight_of_ratio(pdf * l.inverse_pdf)),
        })
    }
}

/// What light counts that a ray of this density met, where a light sample takes its direction with that one.
fn met_weight(pdf: Option<f32>, sampled: f32) -> f32 {
    pdf.map_or(1.0, |pdf| number(weight_of_ratio(One::splat(sampled) / One::splat(pdf))))
}

/// What a ray of this direction and density meets where nothing is.
pub fn beyond(scene: &Scene, direction: [f32; 3], pdf: Option<f32>) -> LightMet {
    let lights = &scene.tables.lights;
    let Some(environment) = &lights.environment else {
        return LightMet { radiance: scene.background, pdf: 0.0, weight: 1.0 };
    };
    let lights::Beyond { sampled, radiance, .. } = lights::beyond(lights, environment, V3::<One>::splat(direction));
    let sampled = number(sampled);
    LightMet { radiance: vector(radiance), pdf: sampled, weight: met_weight(pdf, sampled) }
}
