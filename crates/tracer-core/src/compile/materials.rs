//! Materials: names and inline ones become indices, textures are loaded once each.

use crate::scene::{Albedo, Material, TextureUse};
use crate::texture::{self, Texture};
use rayon::prelude::*;
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
    uses: Vec<TextureUse>,
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
            uses: Vec::new(),
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
                    Diagnostic::error("E0402", *span, format!("there is no material named {name:?}"))
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
        let image = self.images.iter().position(|(known, _)| *known == path).unwrap_or_else(|| {
            self.images.push((path, t.file.span));
            self.images.len() - 1
        });
        let same = |u: &TextureUse| u.image == image && u.filter == t.filter && u.wrap == t.wrap;
        let index = self.uses.iter().position(same).unwrap_or_else(|| {
            self.uses.push(TextureUse { image, filter: t.filter, wrap: t.wrap });
            self.uses.len() - 1
        });
        Albedo::Texture(index as u32)
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
        (self.materials, images, self.uses)
    }
}
