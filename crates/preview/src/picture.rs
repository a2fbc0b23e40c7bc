//! Pictures for page and terminal: a film, developed, as bytes for a canvas.

use crate::shared::Stage;
use tracer_core::{Backdrop, Film, Look, develop};

/// The look of a scene where it is shown: there is nothing to lay the picture over.
pub fn look(stage: Option<&Stage>) -> Look {
    let look = stage.map_or(Look::default(), |stage| stage.scene.look);
    let backdrop = if look.backdrop == Backdrop::Clear { Backdrop::Background } else { look.backdrop };
    Look { backdrop, ..look }
}

/// Four bytes a pixel, row by row from the top, as a canvas takes them: the code values that a PNG has.
pub fn developed(film: &Film, look: &Look) -> Vec<u8> {
    let image = develop(film, look);
    let mut bytes = vec![u8::MAX; image.display.len() / 3 * 4];
    for (pixel, display) in bytes.chunks_exact_mut(4).zip(image.display.chunks_exact(3)) {
        for (byte, x) in pixel.iter_mut().zip(display) {
            // Rounds to the nearest.
            *byte = (f64::from(*x).clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        }
    }
    bytes
}
