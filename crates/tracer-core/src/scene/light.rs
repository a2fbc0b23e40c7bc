//! Luminous spheres and how one of them is chosen.

use super::{Sphere, padded};

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// A sphere of `Scene::spheres` that emits the same radiance everywhere, outwards and inwards, and reflects nothing.
    Sphere {
        /// Index into `Scene::spheres`.
        sphere: u32,
        /// Radiance in W/(sr m^2) per channel.
        radiance: [f64; 3],
    },
}

/// Lights as look-up tables, index = light.
pub(crate) struct LightTable {
    /// Number of lights.
    pub len: u32,
    pub center: [Vec<f32>; 3],
    pub radius: Vec<f32>,
    pub radiance: [Vec<f32>; 3],
    /// Primitive id of the light's sphere.
    pub primitive: Vec<u32>,
    /// Probability that the light is chosen.
    pub probability: Vec<f32>,
    /// Alias method (Walker 1977): keep entry k when the second random number is below `keep[k]`, else take `alias[k]`.
    pub keep: Vec<f32>,
    pub alias: Vec<u32>,
}

impl LightTable {
    /// Lights are chosen by power: radius^2 times the sum of the channels.
    pub fn new(lights: &[Light], spheres: &[Sphere]) -> Self {
        struct Emitter {
            center: [f32; 3],
            radius: f32,
            radiance: [f32; 3],
            primitive: u32,
        }
        let emitters: Vec<Emitter> = lights
            .iter()
            .filter_map(|light| {
                let Light::Sphere { sphere, radiance } = light;
                spheres.get(*sphere as usize).map(|s| Emitter {
                    center: s.center.as_vec3().to_array(),
                    radius: s.radius as f32,
                    radiance: radiance.map(|x| x as f32),
                    primitive: *sphere,
                })
            })
            .collect();
        let weight: Vec<f64> = emitters
            .iter()
            .map(|e| f64::from(e.radius) * f64::from(e.radius) * e.radiance.iter().map(|&x| f64::from(x)).sum::<f64>())
            .collect();
        let total: f64 = weight.iter().sum();
        let n = emitters.len();
        let probability: Vec<f64> =
            weight.iter().map(|w| if total > 0.0 { w / total } else { 1.0 / n as f64 }).collect();
        let (keep, alias) = alias_table(&probability);
        let column = |f: &dyn Fn(&Emitter) -> f32| padded(emitters.iter().map(f).collect());
        let pad = |mut v: Vec<u32>| {
            v.resize(v.len().max(16), 0);
            v
        };
        LightTable {
            len: n as u32,
            center: [0, 1, 2].map(|a| column(&|e| e.center[a])),
            radius: column(&|e| e.radius),
            radiance: [0, 1, 2].map(|a| column(&|e| e.radiance[a])),
            primitive: pad(emitters.iter().map(|e| e.primitive).collect()),
            probability: padded(probability.iter().map(|&p| p as f32).collect()),
            keep: padded(keep),
            alias: pad(alias),
        }
    }
}

/// Vose's construction of the alias table, in the order of the entries.
fn alias_table(probability: &[f64]) -> (Vec<f32>, Vec<u32>) {
    let n = probability.len();
    let mut scaled: Vec<f64> = probability.iter().map(|p| p * n as f64).collect();
    let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..n).partition(|&k| scaled[k] < 1.0);
    let mut keep = vec![1.0; n];
    let mut alias: Vec<u32> = (0..n as u32).collect();
    while let (Some(s), Some(&l)) = (small.pop(), large.last()) {
        keep[s] = scaled[s] as f32;
        alias[s] = l as u32;
        scaled[l] -= 1.0 - scaled[s];
        if scaled[l] < 1.0 {
            large.pop();
            small.push(l);
        }
    }
    (keep, alias)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alias_table_gives_back_the_probabilities() {
        let p = [0.5, 0.01, 0.2, 0.09, 0.2];
        let (keep, alias) = alias_table(&p);
        let mut q = [0.0; 5];
        for k in 0..5 {
            q[k] += f64::from(keep[k]) / 5.0;
            q[alias[k] as usize] += (1.0 - f64::from(keep[k])) / 5.0;
        }
        for k in 0..5 {
            // keep is held in f32.
            assert!((p[k] - q[k]).abs() < 1e-6, "{k}: {} {}", p[k], q[k]);
        }
    }
}
