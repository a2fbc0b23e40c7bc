//! Materials: names and inline ones become indices, textures are loaded once each.

use super::assets::Sources;
use super::textures::pattern;
use crate::mattes::mattes_kept;
use crate::texture::{Texels, Texture};
use rayon::prelude::*;
use scene_format::codes;
use scene_format::desc::{self, Emissive, MaterialRef, SolidMapping};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tracer_kernels::scene::{Albedo, Material, Pattern, PatternKey, TextureFilter, TextureUse, TextureWrap, materials};

/// From the words to what is rendered, one line a material; `color` is what the words' own colour became.
fn compiled(material: &desc::Material, color: Albedo) -> Material {
    match material {
        desc::Material::Diffuse(_) => Material::Diffuse(materials::Diffuse { albedo: color }),
        desc::Material::Mirror(words) => Material::Mirror(mirror(words)),
        desc::Material::Transparent(words) => Material::Transparent(transparent(words)),
        desc::Material::BlinnPhong(words) => Material::BlinnPhong(blinn_phong(words, color)),
        desc::Material::Conductor(words) => Material::Conductor(conductor(words, color)),
        desc::Material::Emissive(_) => Material::Emissive(materials::Emissive),
    }
}

fn mirror(words: &desc::Mirror) -> materials::Mirror {
    materials::Mirror { reflectance: words.reflectance.value }
}

fn transparent(words: &desc::Transparent) -> materials::Transparent {
    materials::Transparent { ior: words.ior.value, transmittance: words.transmittance.value }
}

fn blinn_phong(words: &desc::BlinnPhong, albedo: Albedo) -> materials::BlinnPhong {
    let (exponent, specular) = (words.exponent.value, words.specular.value);
    materials::BlinnPhong { albedo, exponent, specular, energy_conserving: words.energy_conserving }
}

fn conductor(words: &desc::Conductor, color: Albedo) -> materials::Conductor {
    let fresnel = match &words.reflectance {
        desc::Reflectance::Metal(metal) => {
            let [ior, k] = metal.ior_and_k();
            materials::Fresnel::Complex { ior, k }
        }
        desc::Reflectance::Complex { ior, k } => materials::Fresnel::Complex { ior: ior.value, k: k.value },
        desc::Reflectance::Tinted { edge_tint, .. } => {
            materials::Fresnel::Tinted { reflectance: color, edge_tint: edge_tint.value }
        }
    };
    let alpha = words.roughness.value * words.roughness.value;
    materials::Conductor { fresnel, alpha, multiple_scattering: words.multiple_scattering }
}

fn filter(word: desc::TextureFilter) -> TextureFilter {
    match word {
        desc::TextureFilter::Bilinear => TextureFilter::Bilinear,
        desc::TextureFilter::Nearest => TextureFilter::Nearest,
    }
}

fn wrap(word: desc::TextureWrap) -> TextureWrap {
    match word {
        desc::TextureWrap::Repeat => TextureWrap::Repeat,
        desc::TextureWrap::Clamp => TextureWrap::Clamp,
        desc::TextureWrap::Mirror => TextureWrap::Mirror,
    }
}

/// Where a picture comes from.
enum Image {
    /// A file, and the place in the scene that names it first.
    File(PathBuf, Span),
    /// Two by two squares of a checkerboard.
    Squares([desc::Color; 2]),
}

/// Two by two squares of a checkerboard, over which coordinates go from 0 to 2.
fn squares(colors: [desc::Color; 2]) -> Texture {
    let [a, b] = colors.map(|color| color.map(|x| x as f32));
    // Row 0 is the top.
    Texture { width: 2, height: 2, texels: Texels::Linear(vec![b, a, a, b]), warnings: Diagnostics::new() }
}

/// What [`MaterialBuilder::finish`] gives.
pub struct Finished {
    /// All materials.
    pub materials: Vec<Material>,
    /// The pictures of the textures.
    pub images: Vec<Arc<Texture>>,
    /// The textures.
    pub uses: Vec<TextureUse>,
    /// The textures that are reckoned.
    pub patterns: Vec<Pattern>,
}

/// Collects materials and texture uses.
pub struct MaterialBuilder<'a> {
    desc: &'a SceneDesc,
    materials: Vec<Material>,
    /// Those that shine, and how.
    emissive: BTreeMap<u32, Emissive>,
    /// Index of each named material in `materials`.
    named: BTreeMap<&'a str, u32>,
    default: Option<u32>,
    /// What each is called, where anybody asks.
    names: Option<Vec<String>>,
    images: Vec<Image>,
    index_of_file: BTreeMap<PathBuf, usize>,
    /// By the bits of both colours.
    index_of_squares: BTreeMap<[[u64; 3]; 2], usize>,
    uses: Vec<TextureUse>,
    patterns: Vec<Pattern>,
    index_of_pattern: BTreeMap<PatternKey, u32>,
    /// Per image the indices of its uses, at most one for each filter, wrap and mapping.
    uses_of_image: Vec<Vec<u32>>,
}

impl<'a> MaterialBuilder<'a> {
    /// With the named materials of the scene.
    pub fn new(desc: &'a SceneDesc) -> Self {
        let mut builder = MaterialBuilder {
            desc,
            materials: Vec::new(),
            emissive: BTreeMap::new(),
            named: BTreeMap::new(),
            default: None,
            names: mattes_kept(&desc.output).materials.then(Vec::new),
            images: Vec::new(),
            index_of_file: BTreeMap::new(),
            index_of_squares: BTreeMap::new(),
            uses: Vec::new(),
            patterns: Vec::new(),
            index_of_pattern: BTreeMap::new(),
            uses_of_image: Vec::new(),
        };
        for named in &desc.materials {
            let index = builder.add(&named.material, Some(&desc.base_dir), || named.name.value.to_string());
            builder.named.insert(&named.name.value, index);
        }
        builder
    }

    /// The index of what an object of this number names.
    pub fn resolve(&mut self, reference: &MaterialRef, number: u32, diagnostics: &mut Diagnostics) -> u32 {
        self.resolve_as(reference, || format!("objects[{number}].material"), diagnostics)
    }

    /// As [`resolve`](Self::resolve), with the name of a material that is written where it is used.
    pub fn resolve_as(
        &mut self,
        reference: &MaterialRef,
        name: impl FnOnce() -> String,
        diagnostics: &mut Diagnostics,
    ) -> u32 {
        match reference {
            MaterialRef::Default => self.default_material(),
            MaterialRef::Inline(material) => {
                let base = self.desc.base_dir.clone();
                self.add(&material.value, Some(&base), name)
            }
            MaterialRef::Named { name, span } => self.named.get(&**name).copied().unwrap_or_else(|| {
                diagnostics.push(
                    Diagnostic::error(codes::UNKNOWN_MATERIAL, *span, format!("there is no material named {name:?}"))
                        .expected("the name of an entry of `materials`"),
                );
                0
            }),
        }
    }

    /// How a material shines, if it does.
    pub fn emissive(&self, material: u32) -> Option<&Emissive> {
        self.emissive.get(&material)
    }

    /// The default material's index.
    pub fn default_material(&mut self) -> u32 {
        if let Some(index) = self.default {
            return index;
        }
        let index = self.add(&desc::Material::default(), None, || "default".to_owned());
        self.default = Some(index);
        index
    }

    /// Adds a material of this name. Texture paths start from `base`; `None`: they are complete.
    pub fn add(&mut self, material: &desc::Material, base: Option<&Path>, name: impl FnOnce() -> String) -> u32 {
        if let Some(names) = &mut self.names {
            names.push(name());
        }
        if let Some(emissive) = material.shines() {
            self.emissive.insert(self.materials.len() as u32, emissive.clone());
        }
        let color = material.color().map(|albedo| self.albedo(albedo, base));
        let compiled = compiled(material, color.unwrap_or(Albedo::Color([1.0; 3])));
        self.materials.push(compiled);
        self.materials.len() as u32 - 1
    }

    fn albedo(&mut self, albedo: &desc::Albedo, base: Option<&Path>) -> Albedo {
        let (image, filter, wrap, mapping) = match albedo {
            desc::Albedo::Color(c) => return Albedo::Color(c.value),
            desc::Albedo::Texture(t) => (self.file(t, base), filter(t.filter), wrap(t.wrap), t.mapping.rows()),
            desc::Albedo::Checkerboard(t) if let SolidMapping::Uv(uv) = &t.mapping => {
                // The squares are the texels of a picture that is laid over two of them.
                let mapping = uv.rows().map(|row| row.map(|x| 0.5 * x));
                (self.squares([t.a.value, t.b.value]), TextureFilter::Nearest, TextureWrap::Repeat, mapping)
            }
            reckoned => return self.pattern(reckoned),
        };
        let same = |&&index: &&u32| {
            self.uses.get(index as usize).is_some_and(|u| u.filter == filter && u.wrap == wrap && u.mapping == mapping)
        };
        if let Some(&index) = self.uses_of_image[image].iter().find(same) {
            return Albedo::Texture(index);
        }
        let index = self.uses.len() as u32;
        self.uses.push(TextureUse { image, filter, wrap, mapping });
        self.uses_of_image[image].push(index);
        Albedo::Texture(index)
    }

    /// A texture that is reckoned.
    fn pattern(&mut self, words: &desc::Albedo) -> Albedo {
        let Some(pattern) = pattern(words) else { return Albedo::Color([1.0; 3]) };
        let next = self.patterns.len() as u32;
        let index = *self.index_of_pattern.entry(pattern.key()).or_insert(next);
        if index == next {
            self.patterns.push(pattern);
        }
        Albedo::Pattern(index)
    }

    fn add_image(&mut self, image: Image) -> usize {
        self.images.push(image);
        self.uses_of_image.push(Vec::new());
        self.images.len() - 1
    }

    /// The image of a file.
    fn file(&mut self, texture: &desc::Texture, base: Option<&Path>) -> usize {
        let file = &texture.file;
        let path = base.map_or_else(|| file.value.to_path_buf(), |base| base.join(&file.value));
        if let Some(&index) = self.index_of_file.get(&path) {
            return index;
        }
        let index = self.add_image(Image::File(path.clone(), file.span));
        self.index_of_file.insert(path, index);
        index
    }

    /// The image of a checkerboard's colours.
    fn squares(&mut self, colors: [desc::Color; 2]) -> usize {
        let key = colors.map(|color| color.map(f64::to_bits));
        if let Some(&index) = self.index_of_squares.get(&key) {
            return index;
        }
        let index = self.add_image(Image::Squares(colors));
        self.index_of_squares.insert(key, index);
        index
    }

    /// The pictures that materials name.
    pub fn textures(&self) -> impl Iterator<Item = &PathBuf> {
        self.images.iter().filter_map(|image| match image {
            Image::File(path, _) => Some(path),
            Image::Squares(_) => None,
        })
    }

    /// What each material is called; nothing where nobody asks.
    pub fn names(&mut self) -> Vec<String> {
        self.names.take().unwrap_or_default()
    }

    /// Loads the textures.
    pub fn finish(self, sources: &Sources<'_>, diagnostics: &mut Diagnostics) -> Finished {
        let load = |image: &Image| match image {
            Image::File(path, span) => sources.texture(path).map_err(|error| Box::new(error.to_diagnostic(*span))),
            Image::Squares(colors) => Ok(Arc::new(squares(*colors))),
        };
        let loaded: Vec<_> = self.images.par_iter().map(load).collect();
        let mut images = Vec::with_capacity(loaded.len());
        for (result, image) in loaded.into_iter().zip(&self.images) {
            match result {
                Ok(texture) => {
                    if let Image::File(_, span) = image {
                        diagnostics.extend(texture.warnings.iter().cloned().map(|w| Diagnostic { span: *span, ..w }));
                    }
                    images.push(texture);
                }
                Err(error) => diagnostics.push(*error),
            }
        }
        if images.len() == self.images.len() {
            let texture = |path: &Path| {
                self.index_of_file.get(path).and_then(|&index| images.get(index)).map(|image: &Arc<Texture>| &**image)
            };
            super::energy::warn(self.desc, texture, diagnostics);
        }
        Finished { materials: self.materials, images, uses: self.uses, patterns: self.patterns }
    }
}
