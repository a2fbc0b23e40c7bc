//! What the proofs share.

pub mod compare;
pub mod describe;
pub mod meshes;
pub mod skies;

use tracer_core::{Film, RenderOptions, Scene, Unobserved, compile};

/// How much the statistical proofs do: 1, or 16 with `TRACER_PROOFS=long`.
pub fn effort() -> u32 {
    match std::env::var("TRACER_PROOFS") {
        Ok(word) if word == "long" => 16,
        Ok(word) => panic!("TRACER_PROOFS is {word:?}; only \"long\" means something"),
        Err(_) => 1,
    }
}

/// Compiles a scene that is right.
pub fn compiled(desc: &scene_format::SceneDesc) -> Scene {
    compile(desc).unwrap_or_else(|error| panic!("{error}: {:?}", error.diagnostics))
}

/// Renders on one thread: other tests and other seeds keep the others busy.
pub fn film(scene: &Scene, samples: u32, seed: u32) -> Film {
    let options = RenderOptions { samples: Some(samples), seed: Some(seed), threads: 1, ..RenderOptions::default() };
    let film = tracer_core::render(scene, &options, &Unobserved);
    assert_eq!(film.counters.dropped, 0, "samples that are no numbers, seed {seed}");
    film
}
