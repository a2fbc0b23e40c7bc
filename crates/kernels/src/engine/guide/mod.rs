//! Guides: where rays from diffuse and glossy surfaces are aimed to find lights over mirrors, glass and narrow glossy
//! lobes.
//!
//! A path that scatters from a rough surface, goes on over mirrors, glass and narrow lobes only and then meets a
//! small light carries nearly all of the noise of a picture with such objects (E D S+ L in Heckbert's notation),
//! because the ray that happens to take this way is rare and bright. Photons know these ways: sent from the lights at
//! the casters ([`casters`], [`plan`]) and followed over mirrors, glass and narrow lobes
//! (`engine::techniques::photons`), they tell at every place that they reach from where the light comes: from the
//! last mirror or glass that they met, or from the light's image where that looks smaller. The guide keeps these as
//! spheres in space, for the cells of an octree ([`cells`]), and more rays are aimed into the cones around them
//! (`engine::stages::aim`). So photons guide paths and bring no light themselves (Jensen: Importance Driven Path
//! Tracing Using the Photon Map, 1995): the estimate is that of paths, unbiased, on thin, small, folded and bent
//! receivers as on large flat ones; a bad guide makes noise, never an error (light paths, which start as photons do,
//! bring light: see [`approach`]). A density estimate of the photons lost up to two thirds of the light there.
//!
//! How guides are made, `engine::techniques::guides` says.

pub mod approach;
pub mod bright;
pub mod casters;
pub mod cells;
pub mod plan;
pub mod sky;

use cells::{Cells, SphereRows};

/// Rays may be aimed at the casters themselves, too, so many at most; more of them are taken together.
pub const MOST_CASTERS: usize = 16;

/// What rays are aimed at.
#[derive(Default)]
pub struct Guide {
    /// Where lights are found over mirrors, glass and glossy surfaces, by place; where the scene has a way for photons.
    pub lights: Option<Cells>,
    /// Spheres around the casters, for what no photon has found.
    pub casters: SphereRows,
    /// Where the sky is seen, where that is worth its while ([`sky`]).
    pub sky: Option<Cells>,
}
