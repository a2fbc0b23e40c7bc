//! Scenes and sets of rays to time the tree with: camera rays, first bounces in pixel order, second bounces shuffled,
//! shadow rays. Also used by the comparison with Embree.

use std::path::Path;
use tracer_core::bvh::{
    Accel, Acceleration, Coherence, Geometry, Hits, InstanceGeometry, MeshGeometry, NONE, Occlusion, Rays,
};

/// Rays a call: what a stage of the renderer hands over.
pub const BATCH: usize = 4096;

/// A triangle mesh in render space.
pub struct Mesh {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// A camera at `eye` that looks at `target`.
#[derive(Clone, Copy)]
pub struct View {
    pub eye: [f32; 3],
    pub target: [f32; 3],
}

pub struct Scene {
    pub mesh: Mesh,
    pub view: View,
    /// Centre of a small light.
    pub light: [f32; 3],
}

/// One set of rays.
#[derive(Default)]
pub struct Set {
    pub name: &'static str,
    pub coherence: Coherence,
    pub origin: [Vec<f32>; 3],
    pub direction: [Vec<f32>; 3],
    pub from: Vec<u32>,
    /// For shadow rays, where they end; empty for others.
    pub tmax: Vec<f32>,
}

impl Set {
    fn push(&mut self, o: [f32; 3], d: [f32; 3], from: u32) {
        for k in 0..3 {
            self.origin[k].push(o[k]);
            self.direction[k].push(d[k]);
        }
        self.from.push(from);
    }

    pub fn len(&self) -> usize {
        self.from.len()
    }

    pub fn ray(&self, i: usize) -> ([f32; 3], [f32; 3]) {
        ([0, 1, 2].map(|k: usize| self.origin[k][i]), [0, 1, 2].map(|k: usize| self.direction[k][i]))
    }
}

/// Answers, for all the rays of a set.
pub struct Answers {
    pub t: Vec<f32>,
    pub primitive: Vec<u32>,
    pub instance: Vec<u32>,
    pub occluded: Vec<u32>,
}

impl Answers {
    pub fn new(set: &Set) -> Self {
        let n = set.len();
        Self { t: vec![f32::INFINITY; n], primitive: vec![NONE; n], instance: vec![NONE; n], occluded: vec![0; n] }
    }
}

/// Traces a set in batches.
pub fn trace(accel: &Accel, set: &Set, answers: &mut Answers) {
    batches(
        set,
        answers,
        |rays, active, hits| {
            accel.closest(rays, active, hits, set.coherence);
        },
        |rays, active, ends| {
            accel.occluded(rays, active, ends, set.coherence);
        },
    );
}

/// Hands a set over in batches: to `closest` with its rays, their indices and hits, or to `occluded` with the ends of
/// its segments.
pub fn batches(
    set: &Set,
    answers: &mut Answers,
    mut closest: impl FnMut(&Rays, &[u32], &mut Hits),
    mut occluded: impl FnMut(&Rays, &[u32], &mut Occlusion),
) {
    let active: Vec<u32> = (0..BATCH as u32).collect();
    let none = vec![NONE; BATCH];
    answers.t.fill(f32::INFINITY);
    answers.primitive.fill(NONE);
    answers.occluded.fill(0);
    let n = set.len();
    for start in (0..n).step_by(BATCH) {
        let r = start..n.min(start + BATCH);
        let count = r.len();
        let rays = Rays {
            ox: &set.origin[0][r.clone()],
            oy: &set.origin[1][r.clone()],
            oz: &set.origin[2][r.clone()],
            dx: &set.direction[0][r.clone()],
            dy: &set.direction[1][r.clone()],
            dz: &set.direction[2][r.clone()],
            from_primitive: &set.from[r.clone()],
            from_instance: &none[..count],
        };
        if set.tmax.is_empty() {
            let mut hits = Hits {
                t: &mut answers.t[r.clone()],
                primitive: &mut answers.primitive[r.clone()],
                instance: &mut answers.instance[r],
            };
            closest(&rays, &active[..count], &mut hits);
        } else {
            let mut occlusion = Occlusion {
                tmax: &set.tmax[r.clone()],
                target_primitive: &none[..count],
                target_instance: &none[..count],
                occluded: &mut answers.occluded[r],
            };
            occluded(&rays, &active[..count], &mut occlusion);
        }
    }
}

/// Builds the tree of a scene.
pub fn build(scene: &Scene, acceleration: Acceleration) -> Accel {
    let meshes =
        [MeshGeometry { positions: &scene.mesh.positions, triangles: &scene.mesh.triangles, first_primitive: 0 }];
    let instances = [InstanceGeometry { mesh: 0, placement: None }];
    let geometry = Geometry { meshes: &meshes, instances: &instances, ..Geometry::default() };
    Accel::build(&geometry, acceleration).expect("the mesh is sound")
}

/// `size`² camera rays and what follows from them: (camera, first bounce, second bounce shuffled, shadow rays of the
/// first hits, shadow rays of the second shuffled).
pub fn sets(scene: &Scene, accel: &Accel, size: usize) -> Vec<Set> {
    let mut random = Random(7);
    let camera = camera(scene.view, size);
    let mut answers = Answers::new(&camera);
    trace(accel, &camera, &mut answers);
    let first = bounce(scene, &camera, &answers, "b first bounce", &mut random);
    let shadow = shadows(scene, &camera, &answers, "d shadow", Coherence::Coherent, &mut random);
    let mut answers = Answers::new(&first);
    trace(accel, &first, &mut answers);
    let second = shuffled(bounce(scene, &first, &answers, "c second bounce", &mut random), &mut random);
    let far = shadows(scene, &first, &answers, "e second shadow", Coherence::Incoherent, &mut random);
    vec![camera, first, second, shadow, shuffled(far, &mut random)]
}

fn camera(view: View, size: usize) -> Set {
    let mut set = Set { name: "a camera", coherence: Coherence::Coherent, ..Set::default() };
    let forward = unit(sub(view.target, view.eye));
    let right = unit(cross(forward, [0.0, 1.0, 0.0]));
    let up = cross(right, forward);
    // Blocks of 8x8 pixels, row by row within.
    for block in 0..(size / 8) * (size / 8) {
        let (bx, by) = (block % (size / 8) * 8, block / (size / 8) * 8);
        for pixel in 0..64 {
            let x = ((bx + pixel % 8) as f32 + 0.5) / size as f32 * 2.0 - 1.0;
            let y = 1.0 - ((by + pixel / 8) as f32 + 0.5) / size as f32 * 2.0;
            let d = [0, 1, 2].map(|k: usize| forward[k] + 0.45 * (x * right[k] + y * up[k]));
            set.push(view.eye, unit(d), NONE);
        }
    }
    set
}

fn bounce(scene: &Scene, from: &Set, answers: &Answers, name: &'static str, random: &mut Random) -> Set {
    let mut set = Set { name, ..Set::default() };
    for i in (0..from.len()).filter(|&i| answers.primitive[i] != NONE) {
        let (p, n) = surface(scene, from, answers, i);
        let about = random.sphere();
        set.push(p, unit([0, 1, 2].map(|k: usize| n[k] + 0.999 * about[k])), answers.primitive[i]);
    }
    set
}

fn shadows(
    scene: &Scene,
    from: &Set,
    answers: &Answers,
    name: &'static str,
    coherence: Coherence,
    random: &mut Random,
) -> Set {
    let mut set = Set { name, coherence, ..Set::default() };
    for i in (0..from.len()).filter(|&i| answers.primitive[i] != NONE) {
        let (p, n) = surface(scene, from, answers, i);
        let about = random.sphere();
        let d = sub([0, 1, 2].map(|k: usize| scene.light[k] + 0.05 * about[k]), p);
        if dot(d, n) > 0.0 {
            set.push(p, d, answers.primitive[i]);
            set.tmax.push(1.0);
        }
    }
    set
}

fn surface(scene: &Scene, from: &Set, answers: &Answers, i: usize) -> ([f32; 3], [f32; 3]) {
    let (o, d) = from.ray(i);
    let [a, b, c] = scene.mesh.triangles[answers.primitive[i] as usize].map(|v| scene.mesh.positions[v as usize]);
    let n = unit(cross(sub(b, a), sub(c, a)));
    let n = if dot(n, d) > 0.0 { n.map(|x| -x) } else { n };
    // Lifted off by more than rounding, so that every tracer agrees on what the ray leaves.
    ([0, 1, 2].map(|k: usize| o[k] + answers.t[i] * d[k] + 1e-5 * n[k]), n)
}

fn shuffled(set: Set, random: &mut Random) -> Set {
    let mut order: Vec<usize> = (0..set.len()).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, ((u64::from(random.bits()) * (i as u64 + 1)) >> 32) as usize);
    }
    let pick = |values: &[f32]| order.iter().map(|&i| values[i]).collect::<Vec<f32>>();
    Set {
        name: set.name,
        coherence: set.coherence,
        origin: [0, 1, 2].map(|k: usize| pick(&set.origin[k])),
        direction: [0, 1, 2].map(|k: usize| pick(&set.direction[k])),
        from: order.iter().map(|&i| set.from[i]).collect(),
        tmax: if set.tmax.is_empty() { Vec::new() } else { pick(&set.tmax) },
    }
}

/// A closed room with 27 bumpy balls in it, about `triangles` triangles in all.
pub fn room(triangles: usize) -> Scene {
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
    let down = ((triangles / 27) as f32 / 4.0).sqrt().max(3.0) as u32;
    for ball in 0..27 {
        let place = [ball % 3, ball / 3 % 3, ball / 9].map(|i| (i as f32 - 1.0) * 0.6);
        add_ball(&mut mesh, place, 0.22 + 0.015 * (ball % 5) as f32, down * 2, down);
    }
    let first = mesh.positions.len() as u32;
    for corner in 0..8 {
        mesh.positions.push([0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { -1.5 } else { 1.5 }));
    }
    let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    for [a, b, c, d] in quads.map(|quad: [u32; 4]| quad.map(|v| v + first)) {
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    let view = View { eye: [0.2, 0.3, 1.45], target: [0.0, 0.0, 0.0] };
    Scene { mesh, view, light: [0.3, 1.35, 0.3] }
}

/// Rolling, rough ground of about `triangles` triangles, seen from low above.
pub fn field(triangles: usize) -> Scene {
    let n = ((triangles / 2) as f32).sqrt() as u32;
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
    let mut random = Random(3);
    let waves: Vec<[f32; 4]> = (0..24)
        .map(|i| {
            let frequency = 2.0 * 1.35f32.powi(i);
            let about = random.sphere();
            [frequency * about[0], frequency * about[1], 6.0 * about[2], 0.25 / frequency]
        })
        .collect();
    for y in 0..=n {
        for x in 0..=n {
            let (px, pz) = (x as f32 / n as f32 * 2.0 - 1.0, y as f32 / n as f32 * 2.0 - 1.0);
            let wave = |w: &[f32; 4]| w[3] * (w[0] * px + w[1] * pz + w[2]).sin();
            let rough = (random.bits() >> 8) as f32 / 16_777_216.0 * 0.7 / n as f32;
            mesh.positions.push([px, waves.iter().map(wave).sum::<f32>() + rough, pz]);
        }
    }
    for y in 0..n {
        for x in 0..n {
            let a = y * (n + 1) + x;
            mesh.triangles.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
        }
    }
    let view = View { eye: [0.0, 0.75, 1.3], target: [0.0, -0.15, 0.0] };
    Scene { mesh, view, light: [0.5, 0.6, 0.3] }
}

/// The meshes of an OBJ file, centred and scaled to fit into [−1, 1]³, on a ground.
pub fn load(path: &Path) -> Result<Scene, tobj::LoadError> {
    let options = tobj::LoadOptions { triangulate: true, single_index: false, ..Default::default() };
    let (models, _) = tobj::load_obj(path, &options)?;
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
    for model in models {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(model.mesh.positions.chunks_exact(3).map(|p| [p[0], p[1], p[2]]));
        mesh.triangles.extend(model.mesh.indices.chunks_exact(3).map(|t| [t[0] + first, t[1] + first, t[2] + first]));
    }
    let (mut lower, mut upper) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for p in &mesh.positions {
        for k in 0..3 {
            lower[k] = lower[k].min(p[k]);
            upper[k] = upper[k].max(p[k]);
        }
    }
    let size = [0, 1, 2].map(|k: usize| upper[k] - lower[k]);
    let scale = 2.0 / size[0].max(size[1]).max(size[2]);
    for p in &mut mesh.positions {
        *p = [0, 1, 2].map(|k: usize| (p[k] - 0.5 * (lower[k] + upper[k])) * scale);
    }
    let (first, y) = (mesh.positions.len() as u32, -0.5 * size[1] * scale);
    mesh.positions.extend([[-4.0, y, -4.0], [4.0, y, -4.0], [4.0, y, 4.0], [-4.0, y, 4.0]]);
    mesh.triangles.extend([[first, first + 2, first + 1], [first, first + 3, first + 2]]);
    let view = View { eye: [0.8, 0.6, 2.6], target: [0.0, 0.0, 0.0] };
    Ok(Scene { mesh, view, light: [1.5, 2.5, 1.5] })
}

fn add_ball(mesh: &mut Mesh, center: [f32; 3], radius: f32, around: u32, down: u32) {
    let first = mesh.positions.len() as u32;
    for row in 0..=down {
        for column in 0..around {
            let theta = std::f32::consts::PI * row as f32 / down as f32;
            let phi = std::f32::consts::TAU * column as f32 / around as f32;
            let bumps =
                0.06 * (9.0 * phi).sin() * (7.0 * theta).sin() + 0.01 * (60.0 * phi).sin() * (50.0 * theta).sin();
            let r = radius * (1.0 + bumps);
            let about = [theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()];
            mesh.positions.push([0, 1, 2].map(|k: usize| center[k] + r * about[k]));
        }
    }
    for row in 0..down {
        for column in 0..around {
            let at = |row: u32, column: u32| first + row * around + column % around;
            let [a, b, c, d] = [at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
}

/// A small generator with a fixed seed (Steele, Lea and Flood, *Fast splittable pseudorandom number generators*, 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// A point on the unit sphere, by rejection.
    fn sphere(&mut self) -> [f32; 3] {
        loop {
            let p = [0; 3].map(|_| (self.bits() >> 8) as f32 / 8_388_608.0 - 1.0);
            let square = dot(p, p);
            if square <= 1.0 && square > 1e-4 {
                return p.map(|x| x / square.sqrt());
            }
        }
    }
}

fn sub(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f32; 3]) -> [f32; 3] {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}
