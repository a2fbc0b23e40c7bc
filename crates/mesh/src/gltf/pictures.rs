//! Pictures within a glTF file: in a view of its buffers, or as a `data:` URI.

use super::accessor::{Buffers, decoded, is_data};
use super::document::{Document, Element, List};
use crate::cursor::Fault;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Image {
    uri: Option<String>,
    buffer_view: Option<u32>,
}

/// The bytes of a picture.
pub(super) fn read(document: &Document<'_>, buffers: &mut Buffers<'_>, index: u32) -> Result<Vec<u8>, Box<Fault>> {
    let Element { value: Image { uri, buffer_view }, at } = document.element::<Image>(List::Images, index, 0)?;
    let label = List::Images.shown(index);
    match (uri, buffer_view) {
        (Some(uri), _) if is_data(&uri) => decoded(&uri, at, &label),
        (_, Some(view)) => buffers.view(view, at),
        _ => Err(Fault::new(at, format!("{label} is a file beside it"), "a picture within the file")),
    }
}
