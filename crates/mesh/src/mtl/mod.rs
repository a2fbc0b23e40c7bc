//! MTL, the materials of OBJ files, turned into materials of the scene language.
//!
//! What is true first, counts:
//!
//! - `Ke` not black: emissive, to both sides, `radiance` = `Ke`; such surfaces reflect nothing;
//! - `illum` 4, 6, 7 or 9, or `d` < 1 (or `Tr` > 0 without `d`): transparent, `ior` = `Ni` (1.5 if absent),
//!   `transmittance` = `Tf`;
//! - `illum` 3 or 5, and `Ks` not black: a mirror, `reflectance` = `Ks` (1 if absent);
//! - `Ks` not black and `Ns` > 0, and `illum` not 0 or 1: Blinn-Phong, `albedo` = `Kd` + `Ks`, `specular` = the share
//!   of `Ks` in it, `exponent` = `Ns`, 1 to 100000;
//! - else diffuse, `albedo` = `Kd` (0.8 if absent).
//!
//! Colours are taken as linear RGB. A picture of `map_Kd` replaces the albedo. `Ka` and `map_Ka` stand for indirect
//! light, which is computed here, and are passed over. What goes beyond this (other statements and maps, partial
//! opacity, a tint of the picture, values out of range, which are clipped) is told in one warning `W0511` per mesh, as
//! are missing MTL files, materials and pictures: the mesh renders without them. A broken MTL file is an error. Only
//! materials that faces use are turned.

mod library;

use super::error::MeshError;
use super::files::Files;
use super::notes::{Notes, find_beside};
use library::{Library, MtlMaterial};
use scene_format::Diagnostic;
use scene_format::desc::{
    Albedo, Amount, BlinnPhong, Color, Diffuse, Emissive, LightGroup, Material, Mirror, NamedMaterial, Texture,
    TextureWrap, Transparent,
};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Index of refraction where MTL gives none.
const DEFAULT_IOR: f64 = 1.5;

/// The exponents of Blinn-Phong.
const EXPONENTS: std::ops::RangeInclusive<f64> = 1.0..=1e5;

/// The materials of a mesh.
#[derive(Default)]
pub(super) struct MeshMaterials {
    pub(super) materials: Vec<NamedMaterial>,
    /// For each used name, which of `materials` it is; `None`: it is not defined.
    pub(super) index_of_name: Vec<Option<u32>>,
    pub(super) warning: Option<Diagnostic>,
    /// The files that were read.
    pub(super) libraries: Vec<PathBuf>,
}

impl MeshMaterials {
    /// The used names, each with whether it is defined.
    pub(super) fn defined<'n>(&self, used: &[&'n str]) -> impl Iterator<Item = (&'n str, bool)> {
        used.iter().zip(&self.index_of_name).map(|(&name, index)| (name, index.is_some()))
    }
}

/// Reads the MTL files that `mtllib` names in the OBJ file at `obj_path`, and turns the used materials.
pub(super) fn load(
    libraries: &[&str],
    used: &[&str],
    obj_path: &Path,
    files: &Files,
) -> Result<MeshMaterials, MeshError> {
    let mut found = MeshMaterials::default();
    if used.is_empty() {
        return Ok(found);
    }
    let mut notes = Notes::new("`Kd`");
    let mut defined: BTreeMap<String, MtlMaterial> = BTreeMap::new();
    for path in library_paths(libraries, obj_path, files, &mut notes) {
        let text = match files.read(&path) {
            Ok(text) => text,
            Err(error) => {
                notes.missing.insert(error.to_string());
                continue;
            }
        };
        found.libraries.push(path.clone());
        for material in Library::parse(&text, &path)?.materials {
            // Of two definitions the first counts.
            defined.entry(material.name.clone()).or_insert(material);
        }
    }
    for &name in used {
        let Some(mtl) = defined.get(name) else {
            notes.undefined.insert(name.to_owned());
            found.index_of_name.push(None);
            continue;
        };
        if used.len() > 1 {
            notes.current = name.to_owned();
        }
        found.index_of_name.push(Some(found.materials.len() as u32));
        found.materials.push(NamedMaterial { name: name.to_owned().into(), material: turn(mtl, files, &mut notes) });
    }
    found.warning = notes.into_warning(obj_path);
    Ok(found)
}

/// The MTL files to read, each once: `mtllib` names one, with blanks in its name, or several.
fn library_paths(libraries: &[&str], obj_path: &Path, files: &Files, notes: &mut Notes) -> Vec<PathBuf> {
    let mut known = BTreeSet::new();
    let mut paths = Vec::new();
    for &names in libraries {
        if !known.insert(names) {
            continue;
        }
        let whole = find_beside(obj_path, names, files);
        let found: Vec<Option<PathBuf>> = match whole {
            Some(path) => vec![Some(path)],
            None => names.split_whitespace().map(|name| find_beside(obj_path, name, files)).collect(),
        };
        if found.contains(&None) {
            notes.missing.insert(format!("there is no file {names}"));
        }
        paths.extend(found.into_iter().flatten());
    }
    let mut unique = BTreeSet::new();
    paths.retain(|path| unique.insert(path.clone()));
    paths
}

/// The scene's material for one of MTL.
fn turn(mtl: &MtlMaterial, files: &Files, notes: &mut Notes) -> Material {
    for statement in &mtl.unsupported {
        notes.unsupported(statement);
    }
    if let Some(emission) = mtl.emission.map(|color| light("Ke", color, notes)).filter(|color| *color != [0.0; 3]) {
        for statement in lost_by_shining(mtl) {
            notes.unsupported(&format!("`{statement}` beside `Ke` (what shines reflects nothing)"));
        }
        return Material::Emissive(Box::new(Emissive {
            amount: Amount::Radiance(emission).into(),
            color: [1.0; 3].into(),
            two_sided: true,
            group: LightGroup::default(),
        }));
    }
    let diffuse = mtl.diffuse.map(|color| clipped("Kd", color, notes));
    let specular = mtl.specular.map(|color| clipped("Ks", color, notes));
    let is_specular = specular.is_none_or(|color| color != [0.0; 3]);
    let opacity = mtl.opacity.unwrap_or(1.0);
    if matches!(mtl.illumination, Some(4 | 6 | 7 | 9)) || opacity < 1.0 {
        if opacity > 0.0 && opacity < 1.0 {
            notes.unsupported("`d` between 0 and 1 (taken as clear glass)");
        }
        if mtl.picture.is_some() {
            notes.unsupported("`map_Kd` of a transparent material");
        }
        let ior = mtl.ior.unwrap_or(DEFAULT_IOR);
        if ior < 1.0 {
            notes.unsupported("`Ni` below 1 (1.5 is taken)");
        }
        let transmittance = mtl.transmission.map_or([1.0; 3], |color| clipped("Tf", color, notes));
        let ior = if ior < 1.0 { DEFAULT_IOR } else { ior };
        let glass = Transparent { ior: ior.into(), transmittance: transmittance.into() };
        return Material::Transparent(Box::new(glass));
    }
    if matches!(mtl.illumination, Some(3 | 5)) && is_specular {
        if mtl.picture.is_some() || diffuse.is_some_and(|color| color != [0.0; 3]) {
            notes.unsupported("`Kd` and `map_Kd` of a mirror (`illum` 3 or 5)");
        }
        return Material::Mirror(Mirror { reflectance: specular.unwrap_or([1.0; 3]).into() });
    }
    let picture = picture_of(mtl, diffuse, files, notes);
    let glossy = specular.filter(|_| is_specular && !matches!(mtl.illumination, Some(0 | 1)));
    if let (Some(specular), Some(exponent)) = (glossy, mtl.exponent.filter(|&exponent| exponent > 0.0)) {
        if exponent > *EXPONENTS.end() {
            notes.unsupported("`Ns` above 100000 (clipped)");
        }
        // MTL adds the lobes, Kd + Ks; here one colour is shared out between them. A picture counts as white.
        let diffuse = if picture.is_some() { [1.0; 3] } else { diffuse.unwrap_or(default_albedo()) };
        let [[r, g, b], [r2, g2, b2]] = [diffuse, specular];
        let sum: Color = [r + r2, g + g2, b + b2];
        let largest = sum.iter().fold(1.0_f64, |largest, &part| largest.max(part));
        if largest > 1.0 && picture.is_none() {
            notes.unsupported("`Kd` + `Ks` above 1 (both scaled down)");
        }
        let share = specular.iter().sum::<f64>() / sum.iter().sum::<f64>();
        return Material::BlinnPhong(Box::new(BlinnPhong {
            albedo: picture.unwrap_or(Albedo::Color(sum.map(|part| part / largest).into())),
            exponent: exponent.clamp(*EXPONENTS.start(), *EXPONENTS.end()).into(),
            specular: share.into(),
            energy_conserving: false,
        }));
    }
    let color = diffuse.unwrap_or(default_albedo());
    Material::Diffuse(Diffuse { albedo: picture.unwrap_or(Albedo::Color(color.into())) })
}

fn default_albedo() -> Color {
    match Albedo::default() {
        Albedo::Color(color) => color.value,
        _ => [0.8; 3],
    }
}

/// The picture of `map_Kd`, when it is there.
fn picture_of(mtl: &MtlMaterial, diffuse: Option<Color>, files: &Files, notes: &mut Notes) -> Option<Albedo> {
    let picture = mtl.picture.as_ref()?;
    let Some(file) = find_beside(&mtl.file, &picture.name, files) else {
        notes.pictures.insert(picture.name.clone());
        return None;
    };
    if diffuse.is_some_and(|color| color != [1.0; 3]) {
        notes.unsupported("`Kd` other than 1 beside `map_Kd`");
    }
    let wrap = if picture.clamp { TextureWrap::Clamp } else { TextureWrap::Repeat };
    Some(Albedo::Texture(Texture { wrap, ..Texture::of(file.into()) }))
}

/// What a material says of light that meets it.
fn lost_by_shining(mtl: &MtlMaterial) -> impl Iterator<Item = &'static str> {
    let colored = |color: Option<Color>| color.is_some_and(|color| color != [0.0; 3]);
    let is_clear = mtl.opacity.is_some_and(|opacity| opacity < 1.0) || matches!(mtl.illumination, Some(4 | 6 | 7 | 9));
    let all = [
        ("Kd", colored(mtl.diffuse)),
        ("map_Kd", mtl.picture.is_some()),
        ("Ks", colored(mtl.specular) && !matches!(mtl.illumination, Some(0 | 1))),
        ("d", is_clear),
    ];
    all.into_iter().filter_map(|(statement, is_said)| is_said.then_some(statement))
}

/// Light that a scene can have.
fn light(statement: &str, color: Color, notes: &mut Notes) -> Color {
    const MOST: f64 = 1e30;
    let within = color.map(|channel| channel.clamp(0.0, MOST));
    if within != color {
        notes.unsupported(&format!("`{statement}` outside 0 to 1e30 (clipped)"));
    }
    within
}

fn clipped(statement: &str, color: Color, notes: &mut Notes) -> Color {
    if color.iter().any(|part| !(0.0..=1.0).contains(part)) {
        notes.unsupported(&format!("`{statement}` outside 0 to 1 (clipped)"));
    }
    color.map(|part| part.clamp(0.0, 1.0))
}
