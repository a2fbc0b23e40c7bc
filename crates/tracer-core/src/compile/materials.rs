//! Materials: names and inline ones become indices, textures are loaded once each.

use crate::scene::{Albedo, Material, TextureUse};
use crate::texture::{self, Texture};
use rayon::prelude::*;
use scene_format::codes;
use scene_format::desc::{self, MaterialRef};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Collects materials and texture uses.
pub struct MaterialBuilder<'a> {
    desc: &'a SceneDesc,
    materials: Vec<Material>,
    /// Index of each named material in `materials`.
    named: BTreeMap<&'a str, u32>,
    default: Option<u32>,
    images: Vec<(PathBuf, Span)>,
    index_of_image: BTreeMap<PathBuf, usize>,
    uses: Vec<TextureUse>,
    /// Per image the indices of its uses, at most one for each filter and wrap.
    uses_of_image: Vec<Vec<u32>>,
}

impl<'a> MaterialBuilder<'a> {
    /// With the named materials of the scene.
    pub fn new(desc: &'a SceneDesc) -> Self {
        let mut builder = MaterialBuilder {
            desc,
            materials: Vec::new(),
            named: BTreeMap::new(),
            default: None,
            images: Vec::new(),
            index_of_image: BTreeMap::new(),
            uses: Vec::new(),
            uses_of_image: Vec::new(),
        };
        for named in &desc.materials {
            let index = builder.add(&named.material, Some(&desc.base_dir));
            builder.named.insert(&named.name.value, index);
        }
        builder
    }

    /// The index of what an object names.
    pub fn resolve(&mut self, reference: &MaterialRef, diagnostics: &mut Diagnostics) -> u32 {
        match reference {
            MaterialRef::Default => self.default_material(),
            MaterialRef::Inline(material) => {
                let base = self.desc.base_dir.clone();
                self.add(&material.value, Some(&base))
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

    /// The default material's index.
    pub fn default_material(&mut self) -> u32 {
        if let Some(index) = self.default {
            return index;
        }
        let index = self.add(&desc::Material::default(), None);
        self.default = Some(index);
        index
    }

    /// Adds a material. Texture paths start from `base`; `None`: they are complete.
    pub fn add(&mut self, material: &desc::Material, base: Option<&Path>) -> u32 {
        let compiled = match material {
            desc::Material::Diffuse { albedo } => Material::Diffuse { albedo: self.albedo(albedo, base) },
            desc::Material::Mirror { reflectance } => Material::Mirror { reflectance: reflectance.value },
            desc::Material::Transparent { ior, transmittance } => {
                Material::Transparent { ior: ior.value, transmittance: transmittance.value }
            }
            desc::Material::BlinnPhong { albedo, exponent, specular, energy_conserving } => Material::BlinnPhong {
                albedo: self.albedo(albedo, base),
                exponent: exponent.value,
                specular: specular.value,
                energy_conserving: *energy_conserving,
            },
        };
        self.materials.push(compiled);
        self.materials.len() as u32 - 1
    }

    fn albedo(&mut self, albedo: &desc::Albedo, base: Option<&Path>) -> Albedo {
        let t = match albedo {
            desc::Albedo::Color(c) => return Albedo::Color(c.value),
            desc::Albedo::Texture(t) => t,
        };
        let path = base.map_or_else(|| t.file.value.to_path_buf(), |base| base.join(&t.file.value));
        let image = *self.index_of_image.entry(path).or_insert_with_key(|path| {
            self.images.push((path.clone(), t.file.span));
            self.uses_of_image.push(Vec::new());
            self.images.len() - 1
        });
        let same =
            |&&index: &&u32| self.uses.get(index as usize).is_some_and(|u| u.filter == t.filter && u.wrap == t.wrap);
        if let Some(&index) = self.uses_of_image[image].iter().find(same) {
            return Albedo::Texture(index);
        }
        let index = self.uses.len() as u32;
        self.uses.push(TextureUse { image, filter: t.filter, wrap: t.wrap });
        self.uses_of_image[image].push(index);
        Albedo::Texture(index)
    }

    /// The pictures that materials name.
    pub fn textures(&self) -> impl Iterator<Item = &PathBuf> {
        self.images.iter().map(|(path, _)| path)
    }

    /// Loads the textures.
    pub fn finish(self, diagnostics: &mut Diagnostics) -> (Vec<Material>, Vec<Texture>, Vec<TextureUse>) {
        let loaded: Vec<_> = self.images.par_iter().map(|(path, _)| texture::load(path)).collect();
        let mut images = Vec::with_capacity(loaded.len());
        for (result, (_, span)) in loaded.into_iter().zip(&self.images) {
            match result {
                Ok(mut texture) => {
                    diagnostics.extend(texture.warnings.drain(..).map(|w| Diagnostic { span: *span, ..w }));
                    images.push(texture);
                }
                Err(error) => diagnostics.push(error.to_diagnostic(*span)),
            }
        }
        if images.len() == self.images.len() {
            let texture = |path: &Path| self.index_of_image.get(path).and_then(|&index| images.get(index));
            super::energy::warn(self.desc, texture, diagnostics);
        }
        (self.materials, images, self.uses)
    }
}
