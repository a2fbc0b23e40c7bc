//! The materials of a mesh that was kept without them.

use super::data::MeshData;
use super::error::MeshError;
use super::files::Files;
use super::format::MeshFormat;
use super::{gltf, mtl};
use std::path::Path;

impl MeshData {
    /// Reads the materials of its triangles anew, for a mesh that was kept without them: what its file, its MTL files
    /// and the pictures that these name are now. Says whether the same names are defined as when `triangle_material`
    /// was made.
    ///
    /// # Errors
    /// When an MTL file is broken, or the materials of a glTF file are.
    pub fn read_materials(&mut self, path: &Path, files: &Files) -> Result<bool, MeshError> {
        let names = &self.material_names;
        if matches!(MeshFormat::of(path), Some(MeshFormat::Gltf | MeshFormat::Glb)) {
            let used: Option<Vec<u32>> = names.used.iter().map(|(number, _)| number.parse().ok()).collect();
            let Some(used) = used else { return Ok(false) };
            let (materials, warning) = gltf::materials(path, files, &used)?;
            self.materials = materials;
            self.warnings.extend(warning);
            return Ok(true);
        }
        let libraries: Vec<&str> = names.libraries.iter().map(String::as_str).collect();
        let used: Vec<&str> = names.used.iter().map(|(name, _)| name.as_str()).collect();
        let found = mtl::load(&libraries, &used, path, files)?;
        let is_as_before = found.defined(&used).eq(names.used.iter().map(|(name, known)| (name.as_str(), *known)));
        self.materials = found.materials;
        self.libraries.extend(found.libraries);
        // The mesh's own warning comes before that of its materials.
        self.warnings.extend(found.warning);
        Ok(is_as_before)
    }
}
