//! Textures as the engine reads them: all texels in one buffer of words.

/// The colours of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Of an 8-bit file: sRGB, packed as `0x00BBGGRR`; [`SRGB_TO_LINEAR`](crate::srgb::SRGB_TO_LINEAR) decodes each
    /// byte.
    Srgb8(Vec<u32>),
    /// Of a 16-bit file: linear RGB in 0 to 1, sRGB already decoded.
    Linear(Vec<[f32; 3]>),
}

/// How a texture is looked up between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureFilter {
    /// The four nearest texels, weighted.
    Bilinear,
    /// The nearest texel.
    Nearest,
}

/// How a texture goes on beyond its borders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureWrap {
    /// It begins again.
    Repeat,
    /// Its border goes on.
    Clamp,
    /// It goes back.
    Mirror,
}

/// A picture as textures are made of it: size and texels, row 0 on top.
#[derive(Clone, Copy)]
pub struct Picture<'a> {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Row by row.
    pub texels: &'a Texels,
}

/// Where a texture lies in the buffer, and how it is looked up. Columns, index = texture.
#[derive(Default)]
pub struct TextureTable {
    /// Texels: one word 0x00BBGGRR in sRGB, or three words (linear f32) where `wide` is set. Row 0 is the top.
    pub words: Vec<u32>,
    /// Where its words begin.
    pub offset: Vec<u32>,
    /// Texels across.
    pub width: Vec<u32>,
    /// Texels down.
    pub height: Vec<u32>,
    /// 1: three words per texel.
    pub wide: Vec<u32>,
    /// 1: the nearest texel.
    pub nearest: Vec<u32>,
    /// 0 repeat, 1 clamp, 2 mirror.
    pub wrap: Vec<u32>,
    /// Six numbers a texture: the rows of the matrix from a surface's (u, v, 1) to the texture's; empty where all are
    /// used as they are.
    pub mapping: Vec<f32>,
    /// How each is looked up, as the scene says it.
    pub uses: Vec<TextureUse>,
}

/// A texel as its file holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Texel {
    /// sRGB code values of an 8-bit file.
    Srgb8([u8; 3]),
    /// Linear RGB of a 16-bit file.
    Linear([f32; 3]),
}

/// A texture of a compiled scene, and how it is looked up.
#[derive(Clone, Copy)]
pub struct TextureView<'a> {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Between texels.
    pub filter: TextureFilter,
    /// Beyond the borders.
    pub wrap: TextureWrap,
    /// Rows of the matrix from a surface's (u, v, 1) to the texture's.
    pub mapping: [[f64; 3]; 2],
    words: &'a [u32],
    wide: bool,
}

impl TextureView<'_> {
    /// The texel in a column and a row, from the upper left; `None` beyond the borders.
    pub fn texel(&self, column: u32, row: u32) -> Option<Texel> {
        if column >= self.width || row >= self.height {
            return None;
        }
        let k = row as usize * self.width as usize + column as usize;
        if self.wide {
            let words = self.words.get(3 * k..3 * k + 3)?;
            return Some(Texel::Linear([0, 1, 2].map(|c: usize| f32::from_bits(words[c]))));
        }
        let [red, green, blue, _] = self.words.get(k)?.to_le_bytes();
        Some(Texel::Srgb8([red, green, blue]))
    }
}

/// A texture and how it is looked up.
#[derive(Clone, Copy)]
pub struct TextureUse {
    /// Which picture.
    pub image: usize,
    /// Between texels.
    pub filter: TextureFilter,
    /// Beyond the borders.
    pub wrap: TextureWrap,
    /// Rows of the matrix from a surface's (u, v, 1) to the texture's.
    pub mapping: [[f64; 3]; 2],
}

/// The mapping of textures that are used as they are.
const AS_IT_IS: [[f64; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

impl TextureTable {
    /// The words of each picture once, however many uses it has.
    pub fn new<'a>(images: impl Iterator<Item = Picture<'a>>, uses: &[TextureUse]) -> Self {
        let mut table = TextureTable { uses: uses.to_vec(), ..TextureTable::default() };
        if uses.iter().any(|u| u.mapping != AS_IT_IS) {
            table.mapping = uses.iter().flat_map(|u| u.mapping.as_flattened()).map(|&x| x as f32).collect();
            // Columns are read sixteen at a time.
            table.mapping.resize(table.mapping.len().max(16), 0.0);
        }
        let mut place = Vec::new();
        for image in images {
            let offset = table.words.len() as u32;
            let wide = match image.texels {
                Texels::Srgb8(words) => {
                    table.words.extend_from_slice(words);
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

    /// A texture, by the index that materials name.
    pub fn view(&self, index: u32) -> Option<TextureView<'_>> {
        let k = index as usize;
        let TextureUse { filter, wrap, mapping, .. } = *self.uses.get(k)?;
        let words = &self.words[self.offset[k] as usize..];
        let (width, height) = (self.width[k], self.height[k]);
        Some(TextureView { width, height, filter, wrap, mapping, words, wide: self.wide[k] == 1 })
    }
}
