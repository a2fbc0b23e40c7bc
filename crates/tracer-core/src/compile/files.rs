//! The files of a scene whose text is wrong: what is wrong with them is told in the same run.

use super::assets::{Assets, DISK, Sources};
use super::nearby;
use crate::texture::Reading;
use rayon::prelude::*;
use scene_format::desc::Material;
use scene_format::diagnostic::{Source, Span, say_where_included};
use scene_format::{Diagnostics, FileKind, NamedFile};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tracer_mesh::Wanted;

/// Looks at files that a scene names, without the scene: each is read as [`compile`](crate::compile) would read it,
/// and its faults come back in order of their places in the scene. Warnings are left out, as the scene is going to be
/// mended first. Paths start from `base_dir`; `sources` are the texts that the places point into.
pub fn check_files(files: &[NamedFile], base_dir: &Path, sources: &[Source]) -> Diagnostics {
    check(files, base_dir, sources, &DISK)
}

/// As [`check_files`], where files may be in memory.
pub fn check_files_from(files: &[NamedFile], base_dir: &Path, sources: &[Source], assets: &Assets) -> Diagnostics {
    check(files, base_dir, sources, &Sources::new(assets, base_dir))
}

fn check(files: &[NamedFile], base_dir: &Path, sources: &[Source], from: &Sources<'_>) -> Diagnostics {
    let of_file = |file: &NamedFile| faults_of(file, &base_dir.join(&file.path), from);
    let faults: Vec<Diagnostics> = files.par_iter().map(of_file).collect();
    let mut faults: Diagnostics = faults.into_iter().flatten().collect();
    faults.sort_by_key(|fault| fault.span);
    let wanted: BTreeMap<Span, &Path> = files.iter().map(|file| (file.span, &*file.path)).collect();
    nearby::suggest(base_dir, sources, &wanted, &mut faults);
    faults.iter_mut().for_each(|fault| say_where_included(fault, sources));
    faults
}

fn faults_of(file: &NamedFile, path: &Path, from: &Sources<'_>) -> Diagnostics {
    let of_texture =
        |path: &Path| from.texture(path, Reading::default()).err().map(|error| error.to_diagnostic(file.span));
    match file.kind {
        FileKind::Texture => of_texture(path).into_iter().collect(),
        FileKind::Environment => {
            from.environment(path).err().map(|error| error.to_environment_diagnostic(file.span)).into_iter().collect()
        }
        FileKind::Heights => {
            let error = from.heights(path).err();
            error.map(|error| error.to_heights_diagnostic(file.span)).into_iter().collect()
        }
        // The loader has read it, and told what is wrong with it.
        FileKind::Scene => Vec::new(),
        FileKind::Placements => {
            from.placements(path).err().map(|error| error.to_diagnostic(file.span)).into_iter().collect()
        }
        FileKind::Mesh => match from.mesh(path, Wanted::default()) {
            Err(error) => vec![error.to_diagnostic(file.span)],
            Ok(data) => {
                let mut textures: Vec<PathBuf> =
                    data.materials.iter().flat_map(|named| pictures(&named.material)).collect();
                textures.sort();
                textures.dedup();
                textures.iter().filter_map(|path| of_texture(path)).collect()
            }
        },
    }
}

/// The pictures that a material of a mesh.s own file names; their paths are complete.
fn pictures(material: &Material) -> impl Iterator<Item = PathBuf> {
    material.textures().into_iter().map(|texture| texture.file.value.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_format::{LoadError, Syntax, load_str};

    #[test]
    fn the_files_of_a_scene_with_a_mistyped_word_are_looked_at() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("broken.obj"), "v 0 0\n").expect("a file");
        let text = r#"Scene(backgrond: 1, objects: [
            Mesh(file: "broken.obj", colour: 1), Mesh(file: "none.obj", placements: "none.txt"), Mesh(file: "none.obj"),
            Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: Texture(file: "none.png"))),
        ])"#;
        let load = |text: &str| load_str("s.ron", text, Syntax::Ron, folder.path(), &[]);
        let Err(LoadError::Invalid { files, sources, .. }) = load(text) else { panic!("two words are wrong") };
        let faults = check_files(&files, folder.path(), &sources);
        let codes: Vec<&str> = faults.iter().map(|fault| fault.code.as_str()).collect();
        assert_eq!(codes, ["E0510", "E0501", "E0501", "E0501"]);
        // Where a quote is missing, nobody knows what on that line is a name.
        let Err(LoadError::Invalid { files, .. }) = load(&text.replacen("broken.obj\"", "broken.obj", 1)) else {
            panic!("a quote is missing")
        };
        let left: Vec<&Path> = files.iter().map(|file| &*file.path).collect();
        assert_eq!(left, [Path::new("none.png")]);
    }
}
