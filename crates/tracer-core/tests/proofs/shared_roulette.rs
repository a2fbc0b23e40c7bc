//! Pixels share vertices that lie behind so much glass that roulette has begun.

use crate::support::describe::*;
use crate::support::{compiled, film};
use scene_format::desc::Reuse;
use tracer_reference::statistics::Estimate;

/// The eye in the middle of four panes as thin as air (spheres of index 1), in a diffuse ball under a lamp. The first
/// vertex that is shared is the fifth, and goes on with the chance 1/2, its albedo: the others must reckon with that.
/// Without it half of what is shared, a fifth of the picture or more, would be lost; the pictures' means are known to a
/// hundredth, and agree within four standard errors.
#[test]
fn roulette_before_the_first_shared_vertex() {
    let eye = [0.0, -3.0, 0.0];
    let mut objects: Vec<_> = [0.1, 0.2, 0.3, 0.4].map(|radius| sphere(eye, radius, glass(1.0))).into();
    objects.push(sphere([0.0; 3], 10.0, diffuse([0.5; 3])));
    let mut desc = scene(16, vec![light([0.0, 5.0, 0.0], 2.0, [10.0; 3])], objects)
        .camera(eye, [0.0, -3.0, -10.0], 60.0)
        .bounces(9);
    let mut mean = |reuse: Reuse, samples: u32| {
        desc.render.reuse = reuse;
        let scene = compiled(&desc);
        let means: Vec<f64> = (0..8)
            .map(|seed| {
                let film = film(&scene, samples, seed);
                let pixels = (0..16).flat_map(|y| (0..16).map(move |x| (x, y)));
                pixels.map(|(x, y)| film.radiance(x, y)[1]).sum::<f64>() / 256.0
            })
            .collect();
        Estimate::of(&means)
    };
    let (shared, alone) = (mean(Reuse::Blocks, 32), mean(Reuse::None, 64));
    let line = format!("{} +- {} shared, {} +- {} alone", shared.mean, shared.error(), alone.mean, alone.error());
    println!("{line}");
    assert!(shared.error().hypot(alone.error()) < 0.01 * alone.mean, "too little is known: {line}");
    assert!(shared.compare(&alone).z.abs() < 4.0, "{line}");
}
