//! Textures as the engine reads them: all texels in one buffer of words.

use crate::texture::{Texels, Texture};
use scene_format::desc::{TextureFilter, TextureWrap};

/// Where a texture lies in the buffer, and how it is looked up. Columns, index = texture.
#[derive(Default)]
pub(crate) struct TextureTable {
    /// Texels: one word 0x00BBGGRR in sRGB, or three words (linear f32) where `wide` is set. Row 0 is the top.
    pub words: Vec<u32>,
    pub offset: Vec<u32>,
    pub width: Vec<u32>,
    pub height: Vec<u32>,
    /// 1: three words per texel.
    pub wide: Vec<u32>,
    /// 1: the nearest texel.
    pub nearest: Vec<u32>,
    /// 0 repeat, 1 clamp, 2 mirror.
    pub wrap: Vec<u32>,
}

/// A texture and how it is looked up.
pub(crate) struct TextureUse {
    pub image: usize,
    pub filter: TextureFilter,
    pub wrap: TextureWrap,
}

impl TextureTable {
    /// The words of each picture once, however many uses it has.
    pub fn new(images: Vec<Texture>, uses: &[TextureUse]) -> Self {
        let mut table = TextureTable::default();
        let mut place = Vec::with_capacity(images.len());
        for image in images {
            let offset = table.words.len() as u32;
            let wide = match image.texels {
                Texels::Srgb8(words) => {
                    table.words.extend_from_slice(&words);
                    0
                }
                Texels::Linear(texels) => {
                    table.words.extend(texels.iter().flatten().map(|x| x.to_bits()));
                    1
                }
            };
            place.push((offset, image.width, image.height, wide));
        }
        for u in uses {
            let (offset, width, height, wide) = place[u.image];
            table.offset.push(offset);
            table.width.push(width);
            table.height.push(height);
            table.wide.push(wide);
            table.nearest.push(u32::from(u.filter == TextureFilter::Nearest));
            table.wrap.push(match u.wrap {
                TextureWrap::Repeat => 0,
                TextureWrap::Clamp => 1,
                TextureWrap::Mirror => 2,
            });
        }
        if table.words.is_empty() {
            table.words.push(0);
        }
        for column in [
            &mut table.offset,
            &mut table.width,
            &mut table.height,
            &mut table.wide,
            &mut table.nearest,
            &mut table.wrap,
        ] {
            column.resize(column.len().max(16), 1);
        }
        table
    }
}
