//! The stages of a bounce, each a function over lanes from arrays to arrays.

pub mod aim;
pub mod ambient;
pub mod camera;
pub mod cameras;
pub mod deposit;
pub mod fan;
pub mod first_hits;
pub mod light_paths;
pub mod lights;
pub mod materials;
pub mod patterns;
pub mod photons;
pub mod planes;
pub mod points;
pub mod reach;
pub mod seen;
pub mod shade;
pub mod shaft;
pub mod shapes;
pub mod share;
pub mod spheres;
pub mod surface;
pub mod surface_at;
pub mod textures;
pub mod triangles;
