//! Pictures within glTF files, as paths that lead into them: `duck.glb/images[0]`.

use super::files::{FileError, Files};
use super::format::MeshFormat;
use super::gltf;
use std::path::Path;

/// The file of the disk that a path leads into: of a picture within a glTF file, `duck.glb/images[0]`, that file.
pub fn file_of(path: &Path) -> &Path {
    within(path).map_or(path, |(file, _)| file)
}

/// The glTF file that a path leads into, and the number of its picture.
fn within(path: &Path) -> Option<(&Path, u32)> {
    let (name, file) = (path.file_name()?.to_str()?, path.parent()?);
    let index = name.strip_prefix("images[")?.strip_suffix(']')?.parse().ok()?;
    matches!(MeshFormat::of(file), Some(MeshFormat::Gltf | MeshFormat::Glb)).then_some((file, index))
}

impl Files {
    /// All bytes of a picture: a file, or a part of a glTF file ([`file_of`]).
    ///
    /// # Errors
    /// As [`read_regular_file`](crate::read_regular_file), and where a glTF file has no such picture.
    pub fn read_picture(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let Some((file, index)) = within(path) else { return self.read(path) };
        let bytes = self.read(file)?;
        let found = gltf::picture(&bytes, (file, self), index);
        found.map_err(|why| FileError::Within { file: file.to_owned(), why })
    }
}
