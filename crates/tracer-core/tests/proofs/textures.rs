//! Texture look-up, texel by texel: the engine's wave arithmetic in f32 against the reference's whole numbers in f64.

use crate::support::describe::*;
use crate::support::meshes::{Mesh, deep_picture, picture};
use crate::support::{compiled, film};
use scene_format::desc::{PixelFilter, Shading, TextureFilter, TextureWrap, Transform};
use tracer_reference::{Smoothing, render};

const SIZE: u32 = 48;

/// A square in z = 0 whose texture coordinates reach far beyond the picture's borders, on both sides.
fn wrapped_square() -> Mesh {
    Mesh {
        positions: vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        normals: Vec::new(),
        uvs: vec![[-2.7, -1.9], [3.3, -1.9], [3.3, 2.6], [-2.7, 2.6]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

/// Every filter, wrap and depth of texture on a mesh and on a ball. Rays through the pixels' middles onto something
/// white all around and not shaded by anything else: each pixel is the albedo there, without noise. Coordinates up to 4
/// are right to 10 roundings of f32 (2.4e-6, on the ball with its arcs twice that); over 7 texels of contrast up to 1
/// the albedo is right to 4e-5.
#[test]
fn every_filter_and_wrap_is_that_of_the_reference() {
    for file in [picture(), deep_picture()] {
        for filter in [TextureFilter::Bilinear, TextureFilter::Nearest] {
            for wrap in [TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror] {
                let steps = vec![rotate([0.0, 0.0, 1.0], 7.0), Transform::Translate([0.013, 0.027, 0.0])];
                let flat =
                    mesh(&wrapped_square().obj("wrapped-square"), textured(&file, filter, wrap), Shading::Flat, steps);
                let ball = sphere([0.0, 0.0, 0.0], 1.0, textured(&file, filter, wrap));
                for (name, object) in [("square", flat), ("ball", ball)] {
                    // From the front a ball shows its poles' side and the picture's middle; from behind the picture's
                    // edges meet.
                    for eye in [[0.3, 0.4, 4.0], [-0.4, -0.5, -4.0]] {
                        let desc = scene(SIZE, vec![], vec![object.clone()])
                            .camera(eye, [0.0; 3], 24.0)
                            .filter(PixelFilter::None)
                            .background([1.0; 3])
                            .bounces(0);
                        let scene = compiled(&desc);
                        let (ours, theirs) = (film(&scene, 1, 1), render(&scene, 1, 1, Smoothing::Hanika));
                        for (x, y) in (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y))) {
                            let expected = theirs.mean[(y * SIZE + x) as usize].to_array();
                            let got = ours.radiance(x, y);
                            let off = (0..3).map(|c| (got[c] - expected[c]).abs()).fold(0.0, f64::max);
                            assert!(
                                off < 4e-5,
                                "{name} from {eye:?}, {filter:?} {wrap:?} {}: pixel ({x}, {y}) {got:?} not \
                                 {expected:?}",
                                file.display()
                            );
                        }
                    }
                }
            }
        }
    }
}
