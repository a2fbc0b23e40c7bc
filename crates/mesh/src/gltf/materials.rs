//! Materials of glTF (section 3.9 of its specification, and extensions of Khronos), turned into materials of the scene
//! language.
//!
//! What is true first, counts:
//!
//! - `KHR_materials_unlit`: emissive, `radiance` = the base colour, which is what viewers show of it;
//! - `emissiveFactor` (times `emissiveStrength`) not black: emissive to both sides, `radiance` = that; such surfaces
//!   reflect nothing.
//!   With an `emissiveTexture`, which mostly lets a few places shine, only where the base colour is black;
//! - `transmissionFactor` at least 1/2: transparent, `ior` its own (1.5 if absent), `transmittance` = the base colour.
//!   It is a body, also where glTF has a thin wall, which would not refract: programs export closed glass so, and of
//!   open one a warning tells;
//! - `metallicFactor` at least 1/2, and no picture that says where: a conductor, `reflectance` = the base colour,
//!   `roughness` as glTF has it;
//! - `roughnessFactor` below 1/2, and no picture: Blinn-Phong with the lobe of that width (alpha = roughness^2,
//!   exponent = 2 / alpha^2 - 2), a share of 0.04 of it;
//! - else diffuse, `albedo` = the base colour. The gloss of 4 % that glTF gives all that is no metal is left out.
//!
//! The base colour is `baseColorFactor` times the picture of `baseColorTexture`, with `KHR_texture_transform`; that of
//! `KHR_materials_pbrSpecularGlossiness` is its diffuse colour. Occlusion is reckoned here, and its picture passed
//! over. What goes beyond this is told in one warning `W0511` per mesh. Only materials that triangles use are turned.

use super::accessor::is_data;
use super::document::{Document, Element, List};
use crate::cursor::Fault;
use crate::files::Files;
use crate::notes::{Notes, find_beside};
use scene_format::Diagnostic;
use scene_format::desc::{
    Albedo, Amount, BlinnPhong, Color, Conductor, Diffuse, Emissive, LightGroup, Mapping, Material, Multiply,
    NamedMaterial, Reflectance, Texture, TextureFilter, TextureWrap, Transparent,
};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::value::RawValue;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The share of light that what is no metal reflects at normal incidence.
const GLOSS: f64 = 0.04;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Words<'a> {
    name: Option<String>,
    #[serde(default)]
    pbr_metallic_roughness: MetallicRoughness,
    #[serde(default)]
    emissive_factor: [f64; 3],
    emissive_texture: Option<Place>,
    normal_texture: Option<IgnoredAny>,
    alpha_mode: Option<String>,
    #[serde(borrow, default)]
    extensions: BTreeMap<String, &'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct MetallicRoughness {
    base_color_factor: [f64; 4],
    base_color_texture: Option<Place>,
    metallic_factor: f64,
    roughness_factor: f64,
    metallic_roughness_texture: Option<Place>,
}

impl Default for MetallicRoughness {
    fn default() -> Self {
        MetallicRoughness {
            base_color_factor: [1.0; 4],
            base_color_texture: None,
            metallic_factor: 1.0,
            roughness_factor: 1.0,
            metallic_roughness_texture: None,
        }
    }
}

/// `KHR_materials_pbrSpecularGlossiness`, of older files.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct SpecularGlossiness {
    #[serde(default = "ones")]
    diffuse_factor: [f64; 4],
    diffuse_texture: Option<Place>,
}

fn ones() -> [f64; 4] {
    [1.0; 4]
}

/// A texture, and where it lies.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Place {
    index: u32,
    #[serde(default)]
    tex_coord: u32,
    #[serde(default)]
    extensions: PlaceExtensions,
}

#[derive(Deserialize, Default)]
struct PlaceExtensions {
    #[serde(rename = "KHR_texture_transform")]
    transform: Option<UvTransform>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct UvTransform {
    #[serde(default)]
    offset: [f64; 2],
    #[serde(default)]
    rotation: f64,
    #[serde(default = "whole")]
    scale: [f64; 2],
    tex_coord: Option<u32>,
}

fn whole() -> [f64; 2] {
    [1.0; 2]
}

#[derive(Deserialize, Clone, Copy)]
struct TextureWords {
    sampler: Option<u32>,
    source: Option<u32>,
}

#[derive(Deserialize, Clone, Copy, Default)]
#[serde(rename_all = "camelCase")]
struct Sampler {
    mag_filter: Option<u32>,
    wrap_s: Option<u32>,
    wrap_t: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Image {
    uri: Option<String>,
    mime_type: Option<String>,
}

/// Turns the materials of these numbers.
pub(super) fn turn(
    document: &Document<'_>,
    used: &[u32],
    path: &Path,
    files: &Files,
) -> Result<(Vec<NamedMaterial>, Option<Diagnostic>), Box<Fault>> {
    let notes = Notes::new("the colour alone");
    let mut turn = Turn { document, path, files, notes, textures: BTreeMap::new(), images: BTreeMap::new() };
    let mut names = BTreeSet::new();
    let mut materials = Vec::new();
    for &number in used {
        let Element { value: words, at } = document.element::<Words<'_>>(List::Materials, number, 0)?;
        // Two may have one name.
        let own = words.name.clone().filter(|name| !name.trim().is_empty() && !names.contains(name));
        let name = own.unwrap_or_else(|| List::Materials.shown(number));
        if used.len() > 1 {
            turn.notes.current.clone_from(&name);
        }
        let material = turn.material(&words, at)?;
        names.insert(name.clone());
        materials.push(NamedMaterial { name: name.into(), material });
    }
    Ok((materials, turn.notes.into_warning(path)))
}

/// Materials on their way.
struct Turn<'a> {
    document: &'a Document<'a>,
    path: &'a Path,
    files: &'a Files,
    notes: Notes,
    textures: BTreeMap<u32, (TextureWords, Sampler)>,
    /// Where each picture is; `None`: nowhere, which has been told.
    images: BTreeMap<u32, Option<PathBuf>>,
}

impl<'a> Turn<'a> {
    fn material(&mut self, words: &Words<'a>, at: usize) -> Result<Material, Box<Fault>> {
        let pbr = &words.pbr_metallic_roughness;
        let glossy: Option<SpecularGlossiness> = self.extension(words, "KHR_materials_pbrSpecularGlossiness")?;
        let (factor, place) = match &glossy {
            Some(old) => (old.diffuse_factor, old.diffuse_texture.as_ref()),
            None => (pbr.base_color_factor, pbr.base_color_texture.as_ref()),
        };
        let [r, g, b, opacity] = factor;
        let color = self.clipped("a colour", [r, g, b]);
        self.rest(words, opacity, glossy.is_some());
        if words.extensions.contains_key("KHR_materials_unlit") {
            let share = self.picture(place, at)?.map_or(Albedo::from([1.0; 3]), Albedo::Texture);
            return Ok(shining(color, share));
        }
        let strength = self.number(words, "KHR_materials_emissive_strength", "emissiveStrength")?.unwrap_or(1.0);
        let emission = words.emissive_factor.map(|part| (part * strength).clamp(0.0, 1e30));
        if emission != [0.0; 3] {
            match &words.emissive_texture {
                None => return Ok(shining(emission, [1.0; 3].into())),
                Some(place) if color == [0.0; 3] => {
                    let share = self.picture(Some(place), at)?.map_or(Albedo::from([1.0; 3]), Albedo::Texture);
                    return Ok(shining(emission, share));
                }
                Some(_) => self.notes.unsupported("`emissiveTexture` beside a colour (it does not shine)"),
            }
        }
        let base = self.base(place, color, at)?;
        let transmission = self.number(words, "KHR_materials_transmission", "transmissionFactor")?.unwrap_or(0.0);
        if transmission >= 0.5 {
            if transmission < 1.0 {
                self.notes.unsupported("`transmissionFactor` between 0 and 1 (taken as clear)");
            }
            if pbr.roughness_factor > 0.1 {
                self.notes.unsupported("rough glass (taken as smooth)");
            }
            let own = self.number(words, "KHR_materials_ior", "ior")?.filter(|ior| (0.01..=100.0).contains(ior));
            let ior = own.unwrap_or(1.5);
            let depth = self.number(words, "KHR_materials_volume", "attenuationDistance")?;
            if depth.is_some_and(f64::is_finite) {
                self.notes.unsupported("what a body of glass takes (`attenuationDistance`)");
            }
            return Ok(Material::Transparent(Box::new(Transparent { ior: ior.into(), transmittance: base })));
        }
        let rough = pbr.metallic_roughness_texture.as_ref().filter(|_| glossy.is_none());
        let (metallic, roughness) = (pbr.metallic_factor, pbr.roughness_factor.clamp(0.0, 1.0));
        if rough.is_none() && metallic >= 0.5 && glossy.is_none() {
            if metallic < 1.0 {
                self.notes.unsupported("`metallicFactor` between 0 and 1 (taken as 1)");
            }
            let reflectance = Reflectance::Tinted { reflectance: base, edge_tint: [1.0; 3].into() };
            let conductor = Conductor { reflectance, roughness: roughness.into(), multiple_scattering: true };
            return Ok(Material::Conductor(Box::new(conductor)));
        }
        if rough.is_some() {
            self.notes.unsupported("`metallicRoughnessTexture` (taken as matt)");
        }
        if rough.is_none() && glossy.is_none() && roughness < 0.5 {
            let alpha = (roughness * roughness).max(1e-3);
            let exponent = (2.0 / (alpha * alpha) - 2.0).clamp(1.0, 1e5);
            return Ok(Material::BlinnPhong(Box::new(BlinnPhong {
                albedo: base,
                exponent: exponent.into(),
                specular: GLOSS.into(),
                energy_conserving: true,
            })));
        }
        Ok(Material::Diffuse(Diffuse { albedo: base }))
    }

    /// What of a material is not taken, whatever becomes of it.
    fn rest(&mut self, words: &Words<'_>, opacity: f64, glossy: bool) {
        const TAKEN: [&str; 7] = [
            "KHR_materials_unlit",
            "KHR_materials_emissive_strength",
            "KHR_materials_transmission",
            "KHR_materials_volume",
            "KHR_materials_ior",
            "KHR_materials_pbrSpecularGlossiness",
            "KHR_materials_variants",
        ];
        for name in words.extensions.keys().filter(|name| name.starts_with("KHR_") && !TAKEN.contains(&name.as_str())) {
            self.notes.unsupported(&format!("`{name}`"));
        }
        if glossy {
            self.notes.unsupported("the gloss of `KHR_materials_pbrSpecularGlossiness`");
        }
        if words.normal_texture.is_some() {
            self.notes.unsupported("`normalTexture`");
        }
        if let Some(mode) = words.alpha_mode.as_deref().filter(|mode| *mode != "OPAQUE") {
            let part = if opacity < 1.0 { format!(" and an opacity of {opacity}") } else { String::new() };
            let mode: String = mode.chars().take(8).collect();
            self.notes.unsupported(&format!("`alphaMode` {mode}{part} (taken as opaque)"));
        }
    }

    /// What an extension says.
    fn extension<T: Deserialize<'a>>(&self, words: &Words<'a>, name: &str) -> Result<Option<T>, Box<Fault>> {
        let Some(raw) = words.extensions.get(name) else { return Ok(None) };
        self.document.read::<T>(raw, || name.to_owned()).map(|element| Some(element.value))
    }

    /// A number of an extension.
    fn number(&self, words: &Words<'a>, name: &str, field: &str) -> Result<Option<f64>, Box<Fault>> {
        let fields: Option<BTreeMap<String, &RawValue>> = self.extension(words, name)?;
        let Some(raw) = fields.and_then(|fields| fields.get(field).copied()) else { return Ok(None) };
        self.document.read::<f64>(raw, || format!("{name}.{field}")).map(|element| Some(element.value))
    }

    fn clipped(&mut self, what: &str, color: Color) -> Color {
        if color.iter().any(|part| !(0.0..=1.0).contains(part)) {
            self.notes.unsupported(&format!("{what} beyond 0 to 1 (clipped)"));
        }
        color.map(|part| part.clamp(0.0, 1.0))
    }

    /// A colour times its picture.
    fn base(&mut self, place: Option<&Place>, color: Color, at: usize) -> Result<Albedo, Box<Fault>> {
        Ok(match self.picture(place, at)? {
            None => color.into(),
            Some(picture) if color == [1.0; 3] => Albedo::Texture(picture),
            Some(picture) => Albedo::Multiply(Box::new(Multiply { a: Albedo::Texture(picture), b: color.into() })),
        })
    }

    /// The picture at a place, where it can be read.
    fn picture(&mut self, place: Option<&Place>, at: usize) -> Result<Option<Texture>, Box<Fault>> {
        let Some(place) = place else { return Ok(None) };
        let transform = place.extensions.transform.as_ref();
        if transform.and_then(|transform| transform.tex_coord).unwrap_or(place.tex_coord) != 0 {
            self.notes.unsupported("a picture by other texture coordinates than the first");
            return Ok(None);
        }
        let (TextureWords { source, .. }, sampler) = self.texture(place.index, at)?;
        let Some(source) = source else {
            self.notes.unsupported("a picture that only an extension has (WebP, KTX)");
            return Ok(None);
        };
        let Some(file) = self.image(source, at)? else { return Ok(None) };
        let mut texture = Texture::of(file.into());
        if sampler.mag_filter == Some(9728) {
            texture.filter = TextureFilter::Nearest;
        }
        if sampler.wrap_s.unwrap_or(10497) != sampler.wrap_t.unwrap_or(10497) {
            self.notes.unsupported("borders of a picture that go on in two ways (the first is taken)");
        }
        texture.wrap = match sampler.wrap_s {
            Some(33071) => TextureWrap::Clamp,
            Some(33648) => TextureWrap::Mirror,
            _ => TextureWrap::Repeat,
        };
        if let Some(transform) = transform {
            // Beyond, the picture would be noise.
            let UvTransform { offset: [x, y], rotation, scale: [u, v], .. } = *transform;
            if [x, y, rotation, u, v].iter().any(|number| number.abs() > 1e5) {
                self.notes.unsupported("`KHR_texture_transform` with numbers beyond 100000");
                return Ok(None);
            }
            texture.mapping = upwards(transform);
        }
        Ok(Some(texture))
    }

    fn texture(&mut self, index: u32, at: usize) -> Result<(TextureWords, Sampler), Box<Fault>> {
        if let Some(known) = self.textures.get(&index) {
            return Ok(*known);
        }
        let Element { value, at } = self.document.element::<TextureWords>(List::Textures, index, at)?;
        let sampler = value.sampler.map(|sampler| self.document.element::<Sampler>(List::Samplers, sampler, at));
        let found = (value, sampler.transpose()?.map_or(Sampler::default(), |sampler| sampler.value));
        self.textures.insert(index, found);
        Ok(found)
    }

    /// Where a picture is: a file beside the mesh, or a part of it.
    fn image(&mut self, index: u32, at: usize) -> Result<Option<PathBuf>, Box<Fault>> {
        if let Some(known) = self.images.get(&index) {
            return Ok(known.clone());
        }
        let Element { value: Image { uri, mime_type }, .. } =
            self.document.element::<Image>(List::Images, index, at)?;
        let within = self.path.join(List::Images.shown(index));
        let found = match uri {
            _ if matches!(mime_type.as_deref(), Some("image/webp" | "image/ktx2")) => {
                self.notes.unsupported("pictures in WebP or KTX");
                None
            }
            None => Some(within),
            Some(uri) if is_data(&uri) => Some(within),
            Some(uri) => {
                let name = percent_encoding::percent_decode_str(&uri).decode_utf8_lossy();
                let found = find_beside(self.path, &name, self.files);
                if found.is_none() {
                    self.notes.pictures.insert(name.into_owned());
                }
                found
            }
        };
        self.images.insert(index, found.clone());
        Ok(found)
    }
}

/// To both sides, as all surfaces of mesh files that shine.
fn shining(radiance: Color, color: Albedo) -> Material {
    let amount = Amount::Radiance(radiance).into();
    Material::Emissive(Box::new(Emissive { amount, color, two_sided: true, group: LightGroup::default() }))
}

/// `KHR_texture_transform`, whose v runs downwards, in coordinates whose v runs upwards. There it is offset + R(scale
/// uv) with a rotation that is counter-clockwise to the eye, so that u' = c s_u u + s s_v v and v' = -s s_u u + c s_v
/// v.
fn upwards(transform: &UvTransform) -> Mapping {
    let UvTransform { offset: [x, y], rotation, scale: [u, v], .. } = *transform;
    let (sin, cos) = (libm::sin(rotation), libm::cos(rotation));
    Mapping::uv([u, v], rotation.to_degrees(), [x + v * sin, 1.0 - y - v * cos])
}
