//! Files as hosts of repositories know them, which compare paths letter by letter.

use std::path::{Path, PathBuf};

/// A path without `.` and `..`: `golden/../room.ron` is `room.ron`. Where a link makes that another file, the path as
/// it is.
pub fn host_path(path: &Path) -> PathBuf {
    let plain = scene_format::plain_path(path);
    // Of its folder: the file itself may be a link, and need not be there.
    let real = |path: &Path| {
        let folder = path.parent()?;
        std::fs::canonicalize(if folder.as_os_str().is_empty() { Path::new(".") } else { folder }).ok()
    };
    let is_same =
        plain.file_name() == path.file_name() && real(&plain).is_some_and(|folder| Some(folder) == real(path));
    if is_same { plain } else { path.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_those_of_hosts() {
        let at = tempfile::tempdir().expect("a folder");
        for folder in ["golden", "elsewhere/deep"] {
            std::fs::create_dir_all(at.path().join(folder)).expect("a folder");
        }
        let within = |path: &str| at.path().join(path);
        for (path, expected) in [
            ("golden/../room.ron", "room.ron"),
            ("golden/./a.ron", "golden/a.ron"),
            ("golden/../elsewhere/deep/../deep/b.ron", "elsewhere/deep/b.ron"),
            ("golden/../none.ron", "none.ron"),
            ("nowhere/../room.ron", "nowhere/../room.ron"),
        ] {
            assert_eq!(host_path(&within(path)).as_os_str(), within(expected).as_os_str(), "{path}");
        }
        // `src` is there: tests run in the crate's folder.
        assert_eq!(host_path(Path::new("./src/../Cargo.toml")).as_os_str(), "Cargo.toml");
        assert_eq!(host_path(Path::new("../a.ron")).as_os_str(), "../a.ron");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(within("elsewhere/deep"), within("link")).expect("a link");
            assert_eq!(host_path(&within("link/../deep/b.ron")).as_os_str(), within("link/../deep/b.ron").as_os_str());
        }
    }
}
