//! Materials: names and inline ones become indices, textures are loaded once each.

use super::assets::Sources;
use super::textures::{Lies, Lying, lying, pattern};
use crate::mattes::mattes_kept;
use crate::texture::{Channel, ColorSpace, Reading, Texels, Texture};
use rayon::prelude::*;
use scene_format::codes;
use scene_format::desc::{self, Emissive, MaterialRef, SolidMapping};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tracer_kernels::scene::{
    Albedo, Material, Pattern, PatternKey, Program, TextureFilter, TextureUse, TextureWrap, materials,
};

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

/// How a picture is read, where a number is wanted or where a colour is.
fn reading(words: &desc::Texture, number: bool) -> Reading {
    let space = match words.color_space {
        desc::TextureColorSpace::Auto if number => ColorSpace::Linear,
        desc::TextureColorSpace::Auto => ColorSpace::Auto,
        desc::TextureColorSpace::Srgb => ColorSpace::Srgb,
        desc::TextureColorSpace::Linear => ColorSpace::Linear,
    };
    let channel = match words.channel {
        desc::TextureChannel::Auto => Channel::Color,
        desc::TextureChannel::Red => Channel::Red,
        desc::TextureChannel::Green => Channel::Green,
        desc::TextureChannel::Blue => Channel::Blue,
        desc::TextureChannel::Alpha => Channel::Alpha,
        desc::TextureChannel::Luminance => Channel::Luminance,
    };
    Reading { space, channel }
}

/// Where a picture comes from.
enum Image {
    /// A file, the place in the scene that names it first, and how it is read.
    File(PathBuf, Span, Reading),
    /// Two by two squares of a checkerboard.
    Squares([desc::Color; 2]),
}

/// Two by two squares of a checkerboard, over which coordinates go from 0 to 2.
fn squares(colors: [desc::Color; 2]) -> Texture {
    let [a, b] = colors.map(|color| color.map(|x| x as f32));
    // Row 0 is the top.
    Texture { width: 2, height: 2, texels: Texels::Linear(vec![b, a, a, b]), warnings: Diagnostics::new() }
}

/// The two colours of a pattern that has no other parts than these.
pub(super) fn constants(words: &desc::Albedo) -> Option<[desc::Color; 2]> {
    let parts: Vec<&desc::Albedo> = words.pattern()?.parts().into_iter().map(desc::Albedo::resolved).collect();
    match parts[..] {
        [desc::Albedo::Color(a), desc::Albedo::Color(b)] => Some([a.value, b.value]),
        _ => None,
    }
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
    /// Those that are made of others.
    pub programs: Vec<Program>,
}

/// Collects materials and texture uses.
pub struct MaterialBuilder<'a> {
    desc: &'a SceneDesc,
    materials: Vec<Material>,
    /// Those that shine, and how.
    emissive: BTreeMap<u32, Arc<Emissive>>,
    /// Index of each named material in `materials`.
    named: BTreeMap<&'a str, u32>,
    default: Option<u32>,
    /// What each is called, where anybody asks.
    names: Option<Vec<String>>,
    images: Vec<Image>,
    index_of_file: BTreeMap<(PathBuf, Reading), usize>,
    /// By the bits of both colours.
    index_of_squares: BTreeMap<[[u64; 3]; 2], usize>,
    uses: Vec<TextureUse>,
    patterns: Vec<Pattern>,
    index_of_pattern: BTreeMap<PatternKey, u32>,
    pub(super) programs: Vec<Program>,
    /// By all that it says.
    pub(super) index_of_program: BTreeMap<String, u32>,
    /// What is wrong with textures.
    pub(super) faults: Diagnostics,
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
            programs: Vec::new(),
            index_of_program: BTreeMap::new(),
            faults: Diagnostics::new(),
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
    pub fn emissive(&self, material: u32) -> Option<&Arc<Emissive>> {
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
            self.faults.extend(emissive.fault());
            self.emissive.insert(self.materials.len() as u32, Arc::new(emissive.clone()));
        }
        let compiled = self.compiled(material, base);
        self.materials.push(compiled);
        self.materials.len() as u32 - 1
    }

    /// From the words to what is rendered, one line a material.
    fn compiled(&mut self, material: &desc::Material, base: Option<&Path>) -> Material {
        match material {
            desc::Material::Diffuse(words) => {
                Material::Diffuse(materials::Diffuse { albedo: self.color(&words.albedo, base) })
            }
            desc::Material::Mirror(words) => {
                Material::Mirror(materials::Mirror { reflectance: self.color(&words.reflectance, base) })
            }
            desc::Material::Transparent(words) => Material::Transparent(materials::Transparent {
                ior: words.ior.value,
                transmittance: self.color(&words.transmittance, base),
            }),
            desc::Material::BlinnPhong(words) => Material::BlinnPhong(materials::BlinnPhong {
                albedo: self.color(&words.albedo, base),
                exponent: self.number(&words.exponent, base),
                specular: self.number(&words.specular, base),
                energy_conserving: words.energy_conserving,
            }),
            desc::Material::Conductor(words) => Material::Conductor(self.conductor(words, base)),
            desc::Material::Emissive(words) => {
                let glow = words.texture().map(|texture| self.color(texture, base));
                Material::Emissive(glow.map_or(materials::Emissive::EVEN, |glow| materials::Emissive { glow }))
            }
        }
    }

    fn conductor(&mut self, words: &desc::Conductor, base: Option<&Path>) -> materials::Conductor {
        let fresnel = match &words.reflectance {
            desc::Reflectance::Metal(metal) => {
                let [ior, k] = metal.ior_and_k();
                materials::Fresnel::Complex { ior, k }
            }
            desc::Reflectance::Complex { ior, k } => materials::Fresnel::Complex { ior: ior.value, k: k.value },
            desc::Reflectance::Tinted { reflectance, edge_tint } => materials::Fresnel::Tinted {
                reflectance: self.color(reflectance, base),
                edge_tint: self.color(edge_tint, base),
            },
        };
        let roughness = self.number(&words.roughness, base);
        materials::Conductor { fresnel, roughness, multiple_scattering: words.multiple_scattering }
    }

    fn color(&mut self, words: &desc::Albedo, base: Option<&Path>) -> Albedo {
        self.albedo(words, false, base)
    }

    fn number(&mut self, words: &desc::Number, base: Option<&Path>) -> Albedo {
        match words.constant() {
            Some(number) => Albedo::number(number),
            None => self.albedo(&words.0, true, base),
        }
    }

    /// A colour, or a number where one is wanted.
    fn albedo(&mut self, albedo: &desc::Albedo, number: bool, base: Option<&Path>) -> Albedo {
        let by_uv = |mapping: &SolidMapping| if let SolidMapping::Uv(uv) = mapping { Some(uv.rows()) } else { None };
        let albedo = albedo.resolved();
        let constants = constants(albedo);
        match albedo {
            desc::Albedo::Color(c) => return Albedo::Color(c.value),
            desc::Albedo::Texture(t) if let Some(uv) = t.mapping.by_uv() => {
                return Albedo::Texture(self.picture(t, number, uv.rows(), base));
            }
            desc::Albedo::Checkerboard(t) if let (Some(rows), Some(colors)) = (by_uv(&t.mapping), constants) => {
                // The squares are the texels of a picture that is laid over two of them.
                let (image, mapping) = (self.squares(colors), rows.map(|row| row.map(|x| 0.5 * x)));
                return Albedo::Texture(self.texture_use(image, TextureFilter::Nearest, TextureWrap::Repeat, mapping));
            }
            _ => {}
        }
        let mapping = albedo.pattern().and_then(|pattern| pattern.mapping());
        if let (Some(colors), Some(Lying::Once(lies))) = (constants, mapping.as_ref().map(lying)) {
            return self.pattern(albedo, &lies, colors).map_or(Albedo::Color([1.0; 3]), Albedo::Pattern);
        }
        self.program(albedo, number, base)
    }

    /// A picture and how it is looked up.
    pub(super) fn picture(
        &mut self,
        words: &desc::Texture,
        number: bool,
        mapping: [[f64; 3]; 2],
        base: Option<&Path>,
    ) -> u32 {
        let image = self.file(words, number, base);
        self.texture_use(image, filter(words.filter), wrap(words.wrap), mapping)
    }

    /// How a picture is looked up.
    fn texture_use(&mut self, image: usize, filter: TextureFilter, wrap: TextureWrap, mapping: [[f64; 3]; 2]) -> u32 {
        let same = |&&index: &&u32| {
            self.uses.get(index as usize).is_some_and(|u| u.filter == filter && u.wrap == wrap && u.mapping == mapping)
        };
        if let Some(&index) = self.uses_of_image[image].iter().find(same) {
            return index;
        }
        let index = self.uses.len() as u32;
        self.uses.push(TextureUse { image, filter, wrap, mapping });
        self.uses_of_image[image].push(index);
        index
    }

    /// A texture that is reckoned, between two colours.
    pub(super) fn pattern(&mut self, words: &desc::Albedo, lies: &Lies, colors: [desc::Color; 2]) -> Option<u32> {
        let pattern = pattern(words, lies, colors)?;
        let next = self.patterns.len() as u32;
        let index = *self.index_of_pattern.entry(pattern.key()).or_insert(next);
        if index == next {
            self.patterns.push(pattern);
        }
        Some(index)
    }

    fn add_image(&mut self, image: Image) -> usize {
        self.images.push(image);
        self.uses_of_image.push(Vec::new());
        self.images.len() - 1
    }

    /// The image of a file, for a number or a colour.
    fn file(&mut self, texture: &desc::Texture, number: bool, base: Option<&Path>) -> usize {
        let file = &texture.file;
        let path = base.map_or_else(|| file.value.to_path_buf(), |base| base.join(&file.value));
        let key = (path, reading(texture, number));
        if let Some(&index) = self.index_of_file.get(&key) {
            return index;
        }
        let index = self.add_image(Image::File(key.0.clone(), file.span, key.1));
        self.index_of_file.insert(key, index);
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
            Image::File(path, ..) => Some(path),
            Image::Squares(_) => None,
        })
    }

    /// What each material is called; nothing where nobody asks.
    pub fn names(&mut self) -> Vec<String> {
        self.names.take().unwrap_or_default()
    }

    /// Loads the textures.
    pub fn finish(mut self, sources: &Sources<'_>, diagnostics: &mut Diagnostics) -> Finished {
        diagnostics.append(&mut self.faults);
        let load = |image: &Image| match image {
            Image::File(path, span, reading) => {
                sources.texture(path, *reading).map_err(|error| Box::new(error.to_diagnostic(*span)))
            }
            Image::Squares(colors) => Ok(Arc::new(squares(*colors))),
        };
        let loaded: Vec<_> = self.images.par_iter().map(load).collect();
        let mut images = Vec::with_capacity(loaded.len());
        for (result, image) in loaded.into_iter().zip(&self.images) {
            match result {
                Ok(texture) => {
                    if let Image::File(_, span, _) = image {
                        diagnostics.extend(texture.warnings.iter().cloned().map(|w| Diagnostic { span: *span, ..w }));
                    }
                    images.push(texture);
                }
                Err(error) => diagnostics.push(*error),
            }
        }
        if images.len() == self.images.len() {
            let texture = |words: &desc::Texture, number: bool| {
                let key = (self.desc.base_dir.join(&words.file.value), reading(words, number));
                self.index_of_file.get(&key).and_then(|&index| images.get(index)).map(|image: &Arc<Texture>| &**image)
            };
            super::energy::warn(self.desc, texture, diagnostics);
        }
        let MaterialBuilder { materials, uses, patterns, programs, .. } = self;
        Finished { materials, images, uses, patterns, programs }
    }
}
