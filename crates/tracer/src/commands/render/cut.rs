//! What is not seen in mirrors and through glass since paths end before.

use scene_format::{Diagnostic, SceneDesc, codes};
use tracer_core::Film;

/// From this share of the samples on it shows.
const SEEN: f64 = 0.01;

/// What is said of a picture that is black where mirrors and glass would show more.
pub(super) fn warning(film: &Film, desc: &SceneDesc) -> Option<Diagnostic> {
    let share = film.counters.cut as f64 / film.counters.camera_rays.max(1) as f64;
    let most = &desc.render.max_bounces;
    // Who asks for no bounce or one has meant it.
    if share < SEEN || most.value < 2 {
        return None;
    }
    let percent = (100.0 * share.min(1.0)).round();
    let message = format!(
        "{percent} % of the samples end in mirrors and glass after {} bounces and see nothing but black",
        most.value
    );
    let higher = (2 * most.value).max(8).next_power_of_two().min(1_000_000);
    Some(
        Diagnostic::warning(codes::CUT_PATHS, most.span, message)
            .expected("as many bounces as there are mirrors and sides of glass before what is seen, and some more")
            .hint(format!("try `--set render.max_bounces={higher}`")),
    )
}
