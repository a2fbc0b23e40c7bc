//! Where a missing file may be: a file of its name, or of nearly its name, near the scene.

use scene_format::codes;
use scene_format::desc::{Material, MaterialRef, with_operands};
use scene_format::diagnostic::{Edit, Source, Span, Spanned};
use scene_format::{Diagnostics, SceneDesc, nearest};
use std::collections::{BTreeMap, VecDeque};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tracer_mesh::MeshFormat;

/// Names in folders that are looked at, all together: the search must be short wherever the scene lies.
const MAX_NAMES: usize = 5000;
/// Folders that deep below the scene's folder are looked into, and one less below its parent.
const DEPTH: usize = 3;
/// A shorter name is near to too many others.
const SHORTEST: usize = 3;

/// Names a file near the scene in the hint of each error that says there is no such file.
/// `wanted`: the files that the scene names, by their places in it; paths start from `base_dir`.
pub fn suggest(base_dir: &Path, sources: &[Source], wanted: &BTreeMap<Span, &Path>, diagnostics: &mut Diagnostics) {
    if diagnostics.iter().all(|fault| fault.code != codes::FILE_NOT_FOUND) {
        return;
    }
    let near = files_near(base_dir);
    for fault in diagnostics.iter_mut().filter(|fault| fault.code == codes::FILE_NOT_FOUND) {
        let Some(wanted) = wanted.get(&fault.span) else { continue };
        // A file that an MTL file names is reported at the mesh, which is there.
        if base_dir.join(wanted).exists() {
            continue;
        }
        let Some(found) = best(wanted, &near) else { continue };
        let written = slashed(found);
        fault.hint = if found.parent() == wanted.parent() {
            format!("did you mean `{written}`?")
        } else {
            format!("did you mean `{written}`? paths start from the folder of the scene file")
        };
        let text = sources.get(fault.span.source as usize).map_or("", |source| source.text.as_str());
        let lexeme = text.get(fault.span.start as usize..fault.span.end as usize).unwrap_or("");
        if lexeme.starts_with(['"', '\'', 'r']) && !written.contains(['"', '\\']) && !written.contains(char::is_control)
        {
            fault.edit = Some(Edit { span: fault.span, replacement: format!("\"{written}\"") });
        }
    }
}

/// With `/` between folders, as scenes are written everywhere.
fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    parts.join("/")
}

/// All files that the scene names, by their places in it.
pub fn by_place(desc: &SceneDesc) -> BTreeMap<Span, &Path> {
    named(desc).map(|file| (file.span, &*file.value)).collect()
}

/// All files that the scene names, in order of mention, also where it was built in code.
pub fn named(desc: &SceneDesc) -> impl Iterator<Item = &Spanned<Arc<Path>>> {
    let of_objects = with_operands(&desc.objects).flat_map(|object| {
        let file = object.value.file();
        let texture = match object.value.material() {
            MaterialRef::Inline(material) => texture_files(&material.value),
            MaterialRef::Default | MaterialRef::Named { .. } => Vec::new(),
        };
        file.into_iter().chain(object.value.placements().files()).chain(texture)
    });
    let of_background = desc.background.environment().map(|environment| &environment.file);
    of_background
        .into_iter()
        .chain(of_objects)
        .chain(desc.materials.iter().flat_map(|named| texture_files(&named.material)))
}

fn texture_files(material: &Material) -> Vec<&Spanned<Arc<Path>>> {
    material.textures().into_iter().map(|texture| &texture.file).collect()
}

/// Files near the scene, as it would name them, the nearest first.
fn files_near(base: &Path) -> Vec<PathBuf> {
    let base = if base.as_os_str().is_empty() { Path::new(".") } else { base };
    let mut files = Vec::new();
    let mut names = 0;
    let own = base.canonicalize().ok();
    let starts = [(PathBuf::new(), DEPTH), (PathBuf::from(".."), DEPTH - 1)];
    for (start, depth) in starts {
        let mut folders = VecDeque::from([(start, depth)]);
        while let Some((folder, depth)) = folders.pop_front() {
            let Ok(entries) = fs::read_dir(base.join(&folder)) else { continue };
            let room = MAX_NAMES - names;
            let mut entries: Vec<_> = entries.take(room).filter_map(Result::ok).collect();
            names += entries.len();
            // The system gives them in any order; the hint must be the same each time.
            entries.sort_by_key(fs::DirEntry::file_name);
            for entry in entries {
                let path = folder.join(entry.file_name());
                let hidden = entry.file_name().to_string_lossy().starts_with('.');
                // Links are not followed: they may lead in circles.
                let kind = entry.file_type().ok();
                if kind.is_some_and(|kind| kind.is_dir()) {
                    let seen = folder.as_os_str() == ".." && entry.path().canonicalize().ok() == own;
                    if depth > 0 && !hidden && !seen && entry.file_name() != "target" {
                        folders.push_back((path, depth - 1));
                    }
                } else {
                    files.push(path);
                }
            }
        }
    }
    files
}

/// The file that was probably meant.
fn best<'n>(wanted: &Path, near: &'n [PathBuf]) -> Option<&'n PathBuf> {
    let name = wanted.file_name()?.to_str()?;
    let lower = name.to_lowercase();
    let of_name =
        |file: &Path| file.file_name().and_then(|name| name.to_str()).is_some_and(|n| n.to_lowercase() == lower);
    // Of several with the name: the one in folders of the same names, the one in the same case, the nearest.
    let same = near.iter().filter(|file| of_name(file)).min_by_key(|file| {
        let exact = file.file_name().is_some_and(|found| found == name);
        (!file.ends_with(wanted), !exact)
    });
    same.or_else(|| {
        // In the very folder a file with nearly this name, of a kind that can be read in its place.
        let stem = wanted.file_stem()?.to_str().filter(|stem| stem.chars().count() >= SHORTEST)?;
        let fits = |file: &&PathBuf| {
            let long = file.file_stem().is_some_and(|stem| stem.to_string_lossy().chars().count() >= SHORTEST);
            file.parent() == wanted.parent() && long && kind(file) == kind(wanted)
        };
        let candidates: Vec<(&str, &PathBuf)> =
            near.iter().filter(fits).filter_map(|file| Some((file.file_stem()?.to_str()?, file))).collect();
        let found = nearest(stem, candidates.iter().map(|(stem, _)| *stem))?;
        candidates.iter().find(|(stem, _)| *stem == found).map(|(_, file)| *file)
    })
}

/// What a file is by its extension: meshes stand for meshes, pictures for pictures.
fn kind(file: &Path) -> String {
    let extension = file.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
    match extension.as_str() {
        _ if MeshFormat::of(file).is_some() => "mesh".to_owned(),
        "png" | "jpg" | "jpeg" | "hdr" | "exr" => "picture".to_owned(),
        _ => extension,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn best_of(wanted: &str, near: &[&str]) -> Option<String> {
        let near: Vec<PathBuf> = near.iter().map(PathBuf::from).collect();
        best(Path::new(wanted), &near).map(|file| slashed(file))
    }

    #[test]
    fn the_file_of_the_name_is_found_in_the_order_of_likeness() {
        let near = ["Cat.obj", "old/cat.obj", "../assets/meshes/cat.obj", "../cat.obj"];
        assert_eq!(best_of("cat.obj", &near).as_deref(), Some("old/cat.obj"));
        assert_eq!(best_of("meshes/cat.obj", &near).as_deref(), Some("../assets/meshes/cat.obj"));
        assert_eq!(best_of("cat.obj", &near[..1]).as_deref(), Some("Cat.obj"));
        assert_eq!(best_of("dog.obj", &near), None);
    }

    #[test]
    fn a_typo_of_the_name_is_mended_within_the_folder_and_the_kind() {
        let near = ["meshes/teapot.obj", "teapot.obj", "teapot.txt", "ab.obj"];
        assert_eq!(best_of("taepot.obj", &near).as_deref(), Some("teapot.obj"));
        assert_eq!(best_of("meshes/teepot.off", &near).as_deref(), Some("meshes/teapot.obj"));
        assert_eq!(best_of("models/teepot.obj", &near), None);
        assert_eq!(best_of("xb.obj", &near), None);
    }

    #[test]
    fn a_missing_file_is_found_beside_the_folder_of_the_scene() {
        let root = tempfile::tempdir().expect("a folder");
        let (scenes, assets) = (root.path().join("scenes"), root.path().join("assets/meshes"));
        for folder in [&scenes, &assets] {
            fs::create_dir_all(folder).expect("a folder");
        }
        fs::write(assets.join("cat.obj"), "v 0 0 0").expect("a file");
        let text = "Scene(background: 1, objects: [Mesh(file: \"cat.obj\")])";
        let desc = scene_format::load_str("s.ron", text, scene_format::Syntax::Ron, &scenes, &[]).expect("right").scene;
        let scene_format::desc::Object::Mesh(mesh) = &desc.objects[0].value else { panic!("a mesh") };
        let mut faults = vec![scene_format::Diagnostic::error(
            codes::FILE_NOT_FOUND,
            mesh.file().expect("a file").span,
            "there is no file cat.obj",
        )];
        suggest(&desc.base_dir, &desc.sources, &by_place(&desc), &mut faults);
        assert!(faults[0].hint.starts_with("did you mean `../assets/meshes/cat.obj`?"), "{}", faults[0].hint);
        let edit = faults[0].edit.clone().expect("an edit");
        assert_eq!(edit.replacement, "\"../assets/meshes/cat.obj\"");
        assert_eq!(&text[edit.span.start as usize..edit.span.end as usize], "\"cat.obj\"");
    }
}
