//! Luminous spheres, and the tree by which one of them is chosen.

use super::Sphere;
use super::table::Table;
use glam::DVec3;

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// A sphere of `Scene::spheres` that emits the same radiance everywhere, outwards and inwards, and reflects nothing.
    Sphere {
        /// Index into `Scene::spheres`.
        sphere: u32,
        /// Radiance per channel, in `Scene::radiance_unit`.
        radiance: [f64; 3],
    },
}

/// Lights as look-up tables, index = light, and the tree by which one of them is chosen.
pub(crate) struct LightTable {
    /// Number of lights.
    pub len: u32,
    /// Centre and radius, radiance, and the bits of the primitive id of the light's sphere.
    pub rows: Table<8>,
    /// Nodes of [`LightTable::STRIDE`] numbers, the root first, the two children of a node side by side: centre, radius and
    /// power of the lights below, the bits of the first child's index, or of [`LightTable::LEAF`] and a light, and 1 for
    /// [`LightTable::FEW`] lights at most, FEW / n for n.
    pub tree: Vec<f32>,
    /// The way from the root to each light, level by level from the lowest bit on: 1 is the second child.
    pub trail: Vec<u32>,
    /// Steps from the root to the deepest light.
    pub depth: u32,
}

struct Emitter {
    center: DVec3,
    radius: f64,
    radiance: [f64; 3],
    primitive: u32,
}

impl Emitter {
    /// Power but for a factor: radius^2 times the sum of the channels.
    fn power(&self) -> f64 {
        self.radius * self.radius * self.radiance.iter().sum::<f64>()
    }
}

impl LightTable {
    /// Numbers of a node.
    pub const STRIDE: u32 = 8;
    /// Where a node holds what it is: see [`LightTable::tree`].
    pub const CONTENT: usize = 5;
    /// So many lights may all lie in the highest place of their sphere. Of more it is unlikely.
    const FEW: f64 = 4.0;
    /// Marks a node that is a light.
    pub const LEAF: u32 = 1 << 31;

    pub fn new(lights: &[Light], spheres: &[Sphere]) -> Self {
        let emitters: Vec<Emitter> = lights
            .iter()
            .filter_map(|light| {
                let Light::Sphere { sphere, radiance } = *light;
                let s = spheres.get(sphere as usize)?;
                Some(Emitter { center: s.center, radius: s.radius, radiance, primitive: sphere })
            })
            .collect();
        let rows = emitters.iter().map(|e| {
            let ([x, y, z], [r, g, b]) = (e.center.as_vec3().to_array(), e.radiance.map(|x| x as f32));
            [x, y, z, e.radius as f32, r, g, b, f32::from_bits(e.primitive)]
        });
        let pad = |mut v: Vec<u32>| {
            v.resize(v.len().max(16), 0);
            v
        };
        let mut builder = Builder { emitters: &emitters, tree: Vec::new(), trail: vec![0; emitters.len()], depth: 0 };
        if !emitters.is_empty() {
            let mut order: Vec<u32> = (0..emitters.len() as u32).collect();
            builder.tree.resize(Self::STRIDE as usize, 0.0);
            builder.node(0, &mut order, 0, 0);
        }
        LightTable {
            len: emitters.len() as u32,
            rows: Table::new(rows),
            depth: builder.depth,
            trail: pad(builder.trail),
            tree: builder.tree,
        }
    }
}

/// Builds the tree: halves by number along the widest axis of the centres, so that no way is longer than log2 of their number.
struct Builder<'a> {
    emitters: &'a [Emitter],
    tree: Vec<f32>,
    trail: Vec<u32>,
    depth: u32,
}

impl Builder<'_> {
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
        let power: f64 = lights.iter().map(|&l| of(l).power()).sum();
        let content = if let [light] = *lights {
            self.trail[light as usize] = trail;
            self.depth = self.depth.max(depth);
            LightTable::LEAF | light
        } else {
            let size = high - low;
            let axis = (0..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest });
            // The index decides between equal places, so that the tree depends on nothing else.
            lights.sort_unstable_by(|&a, &b| of(a).center[axis].total_cmp(&of(b).center[axis]).then(a.cmp(&b)));
            let first = self.tree.len();
            self.tree.resize(first + 2 * LightTable::STRIDE as usize, 0.0);
            let (left, right) = lights.split_at_mut(lights.len() / 2);
            self.node(first, left, trail, depth + 1);
            self.node(first + LightTable::STRIDE as usize, right, trail | 1 << depth, depth + 1);
            first as u32 / LightTable::STRIDE
        };
        let numbers = [center.x, center.y, center.z, radius, power].map(|x| x as f32);
        self.tree[at..at + 5].copy_from_slice(&numbers);
        self.tree[at + LightTable::CONTENT] = f32::from_bits(content);
        self.tree[at + LightTable::CONTENT + 1] = (LightTable::FEW / lights.len() as f64).min(1.0) as f32;
    }
}
