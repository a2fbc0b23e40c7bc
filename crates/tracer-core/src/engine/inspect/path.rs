//! The path of a sample in the plain path tracer: the stages that make pictures, run on one path at a time.

use super::super::observer::Unobserved;
use super::super::technique::Engine;
use super::super::trace::{closest, occluded, trace};
use super::super::watcher::Unwatched;
use super::super::{RenderOptions, new_film, painter};
use super::told::{Ended, LightOf, MetTold, PathTold, Roulette, SampledTold, Scattering, Told, VertexTold};
use super::{fill, radiance};
use glam::DVec3;
use tracer_kernels::engine::ROULETTE_FROM;
use tracer_kernels::engine::batch::{Batch, Columns, Paths, path};
use tracer_kernels::engine::pass::{Pass, Task};
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::engine::told::{Draw, LightSampled, RayHit, SampledLobe, Vertex, beyond};
use tracer_kernels::layers::{Layer, Pixel, definition};
use tracer_kernels::sampling::blocks::ITEM_PIXELS;
use tracer_kernels::scene::{Light, NONE, Scene};

/// A path as a batch holds it.
#[derive(Clone, Copy)]
struct Row {
    origin: [f32; 3],
    direction: [f32; 3],
    throughput: [f32; 3],
    normal: [f32; 3],
    eta2: f32,
    pdf: f32,
    film: f32,
    slot: u32,
    from_primitive: u32,
    from_instance: u32,
}

fn column(columns: &Columns, i: usize) -> [f32; 3] {
    [0, 1, 2].map(|c| columns[c][i])
}

fn set(columns: &mut Columns, value: [f32; 3]) {
    for (column, x) in columns.iter_mut().zip(value) {
        column[0] = x;
    }
}

impl Row {
    /// Density of the ray's direction; `None` where lights are found by such rays only.
    fn density(&self) -> Option<f32> {
        (self.slot & path::SPECULAR == 0).then_some(self.pdf)
    }

    fn read(paths: &Paths, i: usize) -> Self {
        Row {
            origin: column(&paths.origin, i),
            direction: column(&paths.direction, i),
            throughput: column(&paths.throughput, i),
            normal: column(&paths.normal, i),
            eta2: paths.eta2[i],
            pdf: paths.pdf[i],
            film: paths.film[i],
            slot: paths.slot[i],
            from_primitive: paths.from_primitive[i],
            from_instance: paths.from_instance[i],
        }
    }

    /// Makes it the only one.
    fn write(&self, paths: &mut Paths) {
        set(&mut paths.origin, self.origin);
        set(&mut paths.direction, self.direction);
        set(&mut paths.throughput, self.throughput);
        set(&mut paths.normal, self.normal);
        (paths.eta2[0], paths.pdf[0], paths.film[0]) = (self.eta2, self.pdf, self.film);
        (paths.slot[0], paths.from_primitive[0], paths.from_instance[0]) =
            (self.slot, self.from_primitive, self.from_instance);
        paths.len = 1;
    }
}

/// A path on its way, and the vertex that it comes from.
struct Alive {
    row: Row,
    from: Option<usize>,
    is_branch: bool,
}

/// What has become of one vertex of one path.
struct Made {
    told: VertexTold,
    /// Light that the ray met, as it was added to the slot.
    met: Option<[f32; 3]>,
    /// What the light sample brings, where it arrives.
    arrives: Option<[f32; 3]>,
    /// The path's next ray.
    next: Option<Row>,
    /// The fainter of both ways at glass.
    branch: Option<Row>,
}

/// Follows it; `None` where there is no such pixel.
pub fn follow(engine: Engine<'_>, options: &RenderOptions, pixel: [u32; 2], sample: u32) -> Option<PathTold> {
    let scene = engine.scene;
    let film = new_film(scene, options);
    let pool = Pool::new(1, false);
    let painter = painter(engine, &[], options, &film, sample + 1, &pool, &Unobserved);
    let pass = painter.lightings[0].pass(painter.plain);
    let mut batch = Batch::new();
    let slot = fill(&painter, pixel, sample, &mut batch)?;
    trace(engine, pass, &[], &mut batch, &mut Unwatched);
    let of_batch = radiance(&batch, slot);

    batch.start();
    engine.kernels.camera(scene, pass.seed, 1 << (slot / ITEM_PIXELS), &mut batch);
    let first = (0..batch.paths.len).find(|&i| (batch.paths.slot[i] & path::SLOT) as usize == slot);
    let mut alive: Vec<Alive> =
        first.map(|i| Alive { row: Row::read(&batch.paths, i), from: None, is_branch: false }).into_iter().collect();
    let camera = alive.first().map(|first| Told::place(scene, first.row.origin));
    let mut follower = Follower { engine, pass, pixel, sample, slot, batch };
    let (mut vertices, mut sum) = (Vec::new(), [0.0f32; 3]);
    let add = |sum: &mut [f32; 3], x: [f32; 3]| sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
    let mut depth = 0;
    while !alive.is_empty() {
        let (mut next, mut branches, mut arrives) = (Vec::new(), Vec::new(), Vec::new());
        for path in alive.drain(..) {
            let made = follower.vertex(&path, depth);
            let from = Some(vertices.len());
            made.met.into_iter().for_each(|met| add(&mut sum, met));
            arrives.extend(made.arrives);
            next.extend(made.next.map(|row| Alive { row, from, is_branch: path.is_branch }));
            branches.extend(made.branch.map(|row| Alive { row, from, is_branch: true }));
            vertices.push(made.told);
        }
        arrives.into_iter().for_each(|arrives| add(&mut sum, arrives));
        next.append(&mut branches);
        alive = next;
        depth += 1;
    }
    let unit = scene.radiance_unit;
    let all = sum.map(|x| f64::from(x) * unit);
    let counts = clamped(sum, painter.limit).map(|x| f64::from(x) * unit);
    let agrees = sum.map(f32::to_bits) == of_batch.map(f32::to_bits);
    Some(PathTold { camera, vertices, radiance: all, counts, agrees })
}

/// As the film clamps a sample.
fn clamped(sample: [f32; 3], limit: Option<f64>) -> [f32; 3] {
    let largest = f64::from(sample[0].max(sample[1]).max(sample[2]));
    match limit {
        Some(limit) if largest > limit && largest.is_finite() => {
            sample.map(|x| (f64::from(x) * limit / largest) as f32)
        }
        _ => sample,
    }
}

impl Told {
    /// A point of the scene.
    fn place(scene: &Scene, p: [f32; 3]) -> [f64; 3] {
        (DVec3::from(p.map(f64::from)) / scene.frame.scale + scene.frame.centre).to_array()
    }
}

/// Runs the stages on single paths.
struct Follower<'a> {
    engine: Engine<'a>,
    pass: Pass<'a>,
    pixel: [u32; 2],
    sample: u32,
    slot: usize,
    batch: Batch,
}

impl Follower<'_> {
    fn vertex(&mut self, alive: &Alive, depth: u32) -> Made {
        let Engine { scene, kernels, .. } = self.engine;
        let (row, batch) = (&alive.row, &mut self.batch);
        row.write(&mut batch.paths);
        (0..3).for_each(|c| batch.radiance[c][self.slot] = 0.0);
        closest(self.engine, depth == 0, batch);
        let hit = (batch.hits.primitive[0] != NONE).then(|| RayHit {
            origin: row.origin,
            direction: row.direction,
            normal: row.normal,
            pdf: row.density(),
            t: batch.hits.t[0],
            primitive: batch.hits.primitive[0],
            instance: batch.hits.instance[0],
            behind: if scene.has_touching() { batch.hits.behind[0] } else { 0 },
        });
        kernels.shade(scene, self.pass, depth, batch);
        let met = radiance(batch, self.slot);
        let branches = batch.branches.len;
        let own = batch.paths.len - branches;
        let next = (own > 0).then(|| Row::read(&batch.paths, 0));
        let branch = (branches > 0).then(|| Row::read(&batch.paths, own));
        let cast = (batch.shadows.len > 0).then(|| column(&batch.shadows.contribution, 0));
        occluded(self.engine, false, batch);
        let is_free = cast.is_some() && batch.shadows.occluded[0] == 0;

        let draw = Draw { seed: self.pass.seed, pixel: self.pixel, sample: self.sample, vertex: depth };
        let vertex = hit.map(|hit| Vertex::new(scene, hit));
        let scatters = vertex.as_ref().filter(|vertex| self.scatters(row, vertex, depth));
        let sampled =
            scatters.and_then(|vertex| Some(self.sampled(&vertex.light_sample(&draw)?, vertex, depth, cast, is_free)));
        let scattering = match scatters {
            Some(vertex) if self.goes_on(vertex, depth) => self.scattering(row, vertex, &draw, next.as_ref()),
            _ => None,
        };
        let ended = next.is_none().then(|| self.ended(vertex.as_ref(), scattering.as_ref(), row, depth));
        let told = VertexTold {
            depth,
            from: alive.from,
            is_branch: alive.is_branch,
            origin: Told::place(scene, row.origin),
            direction: row.direction.map(f64::from),
            throughput: row.throughput.map(|x| f64::from(x) * f64::from(row.eta2)),
            pdf: row.density().map(f64::from),
            told: vertex.as_ref().zip(hit).map(|(vertex, hit)| told(scene, vertex, &hit)),
            met: self.met(row, vertex.as_ref(), met, depth),
            sampled,
            scattering,
            ended,
        };
        let has_met = told.met.is_some();
        Made { told, met: has_met.then_some(met), arrives: cast.filter(|_| is_free), next, branch }
    }

    /// Whether paths are scattered and lights sampled there.
    fn scatters(&self, row: &Row, vertex: &Vertex<'_>, depth: u32) -> bool {
        depth <= self.engine.scene.max_bounces && !self.is_direct_end(row) && vertex.light().is_none()
    }

    /// Whether the ray has left a rough surface where only direct light is wanted.
    fn is_direct_end(&self, row: &Row) -> bool {
        self.pass.task == Task::Direct && row.slot & path::OWN != 0
    }

    /// Whether a further ray is cast from there.
    fn goes_on(&self, vertex: &Vertex<'_>, depth: u32) -> bool {
        let scene = self.engine.scene;
        let is_last = depth == scene.max_bounces || self.pass.task == Task::Direct;
        scene.is_under_sky() || !is_last || !vertex.is_diffuse()
    }

    fn met(&self, row: &Row, vertex: Option<&Vertex<'_>>, brings: [f32; 3], depth: u32) -> Option<MetTold> {
        let scene = self.engine.scene;
        let hidden = || depth == 0 && scene.environment().is_some_and(|sky| !sky.camera_visible);
        let met = match vertex {
            Some(vertex) => vertex.met()?,
            None if !scene.is_open() || hidden() => return None,
            None => beyond(scene, row.direction, row.density()),
        };
        let unit = scene.radiance_unit;
        Some(MetTold {
            radiance: met.radiance.map(|x| f64::from(x) * unit),
            light_pdf: (row.density().is_some() && met.pdf > 0.0).then(|| f64::from(met.pdf)),
            weight: f64::from(met.weight),
            brings: brings.map(|x| f64::from(x) * unit),
        })
    }

    fn sampled(
        &self,
        light: &LightSampled,
        vertex: &Vertex<'_>,
        depth: u32,
        cast: Option<[f32; 3]>,
        is_free: bool,
    ) -> SampledTold {
        let scene = self.engine.scene;
        let unit = scene.radiance_unit;
        let wide = |x: [f32; 3]| x.map(f64::from);
        let start = vertex.start();
        let end = [0, 1, 2].map(|c| start[c] + light.distance * light.direction[c]);
        SampledTold {
            light: light.light.map_or(LightOf::Environment, |k| LightOf::Object(object_of_light(scene, k))),
            point: light.light.map(|_| Told::place(scene, end)),
            direction: wide(light.direction),
            pdf: f64::from(light.pdf),
            material_pdf: f64::from(light.material_pdf),
            // Where no further ray looks for lights, the sample counts whole.
            weight: if self.goes_on(vertex, depth) { f64::from(light.weight) } else { 1.0 },
            f: wide(light.f),
            radiance: light.radiance.map(|x| f64::from(x) * unit),
            cos: f64::from(light.cos),
            carries: cast.unwrap_or([0.0; 3]).map(|x| f64::from(x) * unit),
            arrives: cast.map(|_| is_free),
        }
    }

    /// How the path goes on from there.
    fn scattering(&mut self, row: &Row, vertex: &Vertex<'_>, draw: &Draw, next: Option<&Row>) -> Option<Scattering> {
        let lobe = vertex.lobe(draw)?;
        // Roulette goes by the throughput. With a large one nobody is lost: so the stage itself says where those would
        // have gone that are, and with what weight.
        let raised = (draw.vertex >= ROULETTE_FROM).then_some(Row { throughput: [RAISED; 3], ..*row });
        let (before, after) = match &raised {
            Some(raised) => (raised, self.shaded(raised, draw.vertex)?),
            None => (row, *next?),
        };
        let of_color = [0, 1, 2].map(|c| match before.throughput[c] {
            0.0 => 0.0,
            throughput => after.throughput[c] / throughput,
        });
        let carried = [0, 1, 2].map(|c| row.throughput[c] * of_color[c]);
        let survival = carried[0].max(carried[1]).max(carried[2]).min(1.0);
        let roulette = raised.map(|_| Roulette { survival: survival.into(), drawn: draw.roulette().into() });
        let normal = vertex.geometric();
        let passes = (0..3).map(|c| after.direction[c] * normal[c]).sum::<f32>() < 0.0;
        Some(Scattering {
            lobe: match lobe {
                SampledLobe::Diffuse => "diffuse",
                SampledLobe::Glossy => "glossy",
                SampledLobe::Mirror => "mirror",
                SampledLobe::Glass if passes => "refraction",
                SampledLobe::Glass => "reflection",
            },
            direction: after.direction.map(f64::from),
            pdf: after.density().map(f64::from),
            weight: of_color.map(|x| f64::from(x) * f64::from(after.eta2) / f64::from(row.eta2)),
            roulette,
        })
    }

    /// The next ray of a path that has hit what the batch's first has hit.
    fn shaded(&mut self, row: &Row, depth: u32) -> Option<Row> {
        let batch = &mut self.batch;
        row.write(&mut batch.paths);
        self.engine.kernels.shade(self.engine.scene, self.pass, depth, batch);
        (batch.paths.len > 0).then(|| Row::read(&batch.paths, 0))
    }

    fn ended(&self, vertex: Option<&Vertex<'_>>, scattering: Option<&Scattering>, row: &Row, depth: u32) -> Ended {
        let Some(vertex) = vertex else { return Ended::Left };
        let roulette = scattering.and_then(|scattering| scattering.roulette.as_ref());
        let most = self.engine.scene.max_bounces;
        match vertex {
            _ if vertex.light().is_some() => Ended::AtLight,
            _ if self.is_direct_end(row) => Ended::Direct,
            _ if depth > most => Ended::Bounces,
            _ if !self.goes_on(vertex, depth) && depth < most => Ended::Direct,
            _ if !self.goes_on(vertex, depth) => Ended::Bounces,
            _ if roulette.is_some_and(|roulette| roulette.drawn >= roulette.survival) => Ended::Roulette,
            _ => Ended::Nothing,
        }
    }
}

/// A throughput that roulette lets pass: 2^40.
const RAISED: f32 = 1_099_511_627_776.0;

/// What has been hit, in the scene's own units.
fn told(scene: &Scene, vertex: &Vertex<'_>, hit: &RayHit) -> Told {
    let wide = |x: [f32; 3]| x.map(f64::from);
    let number = |layer: Layer| match definition(layer).pixel {
        Pixel::Nearest(number) => number(scene, hit.primitive, hit.instance, vertex.body()).checked_sub(1),
        _ => None,
    };
    let is_light = vertex.light().is_some();
    Told {
        point: Told::place(scene, vertex.point()),
        normal: wide(vertex.normal()),
        geometric: wide(vertex.geometric()),
        distance: f64::from(hit.t) / scene.frame.scale,
        object: number(Layer::ObjectId),
        material: number(Layer::MaterialId),
        is_light,
        color: if is_light { [0.0; 3] } else { wide(vertex.color()) },
        is_outside: vertex.is_outside(),
        glass: vertex.glass().map(|numbers| numbers.map(f64::from)),
    }
}

/// The object that a light is, or is a part of.
fn object_of_light(scene: &Scene, light: u32) -> u32 {
    if let Some(Light::Sphere { sphere, .. }) = scene.lights.get(light as usize) {
        return scene.spheres.get(*sphere as usize).map_or(NONE, |sphere| sphere.object);
    }
    if let Some(curved) = scene.lights.get(light as usize).and_then(Light::curved) {
        return scene.shapes.get(curved.shape as usize).map_or(NONE, |shape| shape.object);
    }
    let triangle = scene.triangles.light.iter().position(|&of| of == light).unwrap_or(usize::MAX);
    let has_it = |mesh: u32| {
        let mesh = scene.meshes.get(mesh as usize);
        mesh.is_some_and(|m| {
            (m.first_triangle as usize..(m.first_triangle + m.triangle_count) as usize).contains(&triangle)
        })
    };
    scene.instances.iter().find(|instance| has_it(instance.mesh)).map_or(NONE, |instance| instance.object)
}
