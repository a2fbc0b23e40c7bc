//! Clouds of noise.

use super::{Albedo, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::{scene_struct, scene_words};

scene_struct! {
    /// Perlin's improved noise (2002), mixed from octaves: clouds, dirt, wear. It seldom comes near its two colours: of
    /// `Fbm` with six octaves 98 % of all points have t from 0.32 to 0.68, of `Perlin` from 0.21 to 0.80, of
    /// `Turbulence` from 0.06 to 0.46 (half of them below 0.21). For more contrast take `a` darker and `b` lighter than
    /// what is to be seen.
    pub struct Noise as "Noise", "noise" {
        /// The colour where the noise is lowest.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour where it is highest.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How octaves are mixed.
        kind: NoiseKind = NoiseKind::Fbm;
        /// How many; Perlin has one whatever is said here.
        octaves: u32 = 6u32 => Rule::within("a number of octaves", 1.0, 16.0);
        /// Each octave is so many times finer than the last.
        lacunarity: f64 = 2.0 => Rule::within("a factor", 1.0, 8.0);
        /// Each octave counts so many times what the last does.
        gain: f64 = 0.5 => Rule::within("a factor", 0.0, 1.0);
        /// How it lies: `Object(scale: 4)` puts four cells of noise along a unit of length.
        mapping: SolidMapping = SolidMapping::object();
    }
}

scene_words! {
    /// How octaves of noise are mixed.
    pub enum NoiseKind, "kind of noise" {
        /// Octaves added up: clouds.
        Fbm,
        /// One octave: soft spots, all of a size.
        Perlin,
        /// Octaves without their signs added up: billows with dark creases.
        Turbulence,
    }
}

impl Pattern for Noise {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone())
    }
}
