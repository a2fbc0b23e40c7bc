//! The engine of tracer: a scene description becomes a picture.
//!
//! [`compile`] turns a [`scene_format::SceneDesc`] into a [`Scene`], [`render`] path-traces it into a [`Film`],
//! [`develop`] makes a picture of the film. The picture depends on the scene, the seed and the number of samples, and
//! on nothing else.
//!
//! The whole way, from text to the bytes of a picture file:
//!
//! ```
//! use scene_format::{Syntax, load_str};
//! use std::path::Path;
//! use tracer_core::{RenderOptions, Unobserved, compile, develop, render};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = r#"Scene(
//!     version: 1,
//!     image: Image(width: 32, height: 24),
//!     render: Render(samples: 4),
//!     lights: [SphereLight(center: (2, 3, 4), radius: 1, power: 500)],
//!     objects: [Sphere(center: (0, 0, 0), radius: 1)],
//! )"#;
//! let loaded = load_str("ball.ron", text, Syntax::Ron, Path::new("."), &[])?;
//! let scene = compile(&loaded.scene)?;
//! let film = render(&scene, &RenderOptions::default(), &Unobserved);
//! let image = develop(&film, &scene.look);
//! let mut ppm = format!("P6 {} {} 255\n", image.width, image.height).into_bytes();
//! ppm.extend(image.display.iter().map(|x| (x * 255.0 + 0.5) as u8));
//! assert_eq!(ppm.len(), 13 + 3 * 32 * 24);
//! assert!(ppm.iter().skip(13).any(|&byte| byte > 128), "the ball is lit");
//! # Ok(())
//! # }
//! ```

// What a test expects reaches no picture: it may be computed by std. See clippy.toml.
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![forbid(unsafe_code)]

mod compile;
mod denoise;
mod develop;
mod engine;
mod film;
mod marks;
mod mattes;
pub mod scene;
pub mod texture;
mod whereabouts;

pub use compile::{Asset, Assets, compile_from};
pub use compile::{CompileError, Kept, check_files, check_files_from, compile, compile_keeping, named_files};
pub use compile::{ContentHash, Fill, KeptError, KeptFile, KeptKind, Stamp, Store, Told as StoreTold};
pub use compile::{LookedAt, Looking, ToldFrame, check_frames, compile_storing, is_kept_file};
pub use compile::{most_light_groups, shining_objects, way_into_view};
pub use denoise::{
    DENOISE_REACH, DenoiseError, DenoiseTold, Denoised, GUIDES, Noisy, denoise, denoise_while, lacks as denoise_lacks,
};
pub use develop::{Backdrop, Image, Look, develop, develop_denoised, develop_radiance, srgb_decode, srgb_encode};
pub use engine::{
    Brought, Ended, Inspection, LightOf, MetTold, PathTold, Roulette, SampledTold, Scattering, Shared, Told,
    VertexTold, Whole, inspect,
};
pub use engine::{Misfit, Observer, Progress, RenderOptions, Unobserved, quarter_of, render, resume};
pub use film::{Clamped, Crop, Film, FilmError, FilmHead, FilmState, LayerImage, Note, PROGRAM, SavedFilm};
pub use film::{FewNoisy, Gap, Gaps, MergeError, NoPlan, Part, Plan, Split, faults as film_faults};
pub use film::{MatteOf, MattesKept};
pub use marks::{Eye, MarkSeen, marks};
pub use mattes::{MatteImage, Mattes, mattes_kept, object_name};
pub use scene::{CompileTimes, LightGroups, Moments, Scene, film_layers, layer_set, layer_word};
pub use tracer_kernels::layers::{Layer, LayerSet};
pub use tracer_kernels::level::Level;
pub use tracer_kernels::report::{Costs, Counters, Stage, Statistics, TreeWork};
pub use tracer_kernels::{bvh, sampling, shapes};
pub use tracer_mesh as mesh;
pub use whereabouts::{SeenAt, Whereabouts, whereabouts};
