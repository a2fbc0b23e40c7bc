//! Where the library lies.

use crate::library::Functions;
use std::path::{Path, PathBuf};

/// The variable of the environment that names the library's file, or the folder that it lies in.
pub const NAMED_BY: &str = "TRACER_OIDN";

/// What the library's file may be called here, the most definite name first.
const NAMES: &[&str] = if cfg!(windows) {
    &["OpenImageDenoise.dll"]
} else if cfg!(target_vendor = "apple") {
    &["libOpenImageDenoise.2.dylib", "libOpenImageDenoise.dylib"]
} else {
    &["libOpenImageDenoise.so.2", "libOpenImageDenoise.so"]
};

/// Where it lies in a folder that was unpacked as a whole.
const BELOW: [&str; 3] = ["", "lib", "bin"];

/// Why there is no library to filter with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NotFound {
    /// A static program has no loader of libraries.
    #[error("this program is static, and a static program cannot load libraries")]
    Static,
    /// What is named is not there.
    #[error("{NAMED_BY} names {}, which is not there", .0.display())]
    Absent(PathBuf),
    /// The folder that is named does not have it.
    #[error(
        "{NAMED_BY} names the folder {}, which has no {}, nor have its folders lib and bin",
        .0.display(),
        NAMES.join(" and no ")
    )]
    NotInFolder(PathBuf),
    /// Nothing is named, and the system's loader knows none.
    #[error("the system has none ({})", .0.join("; "))]
    NotInSystem(
        /// What the loader says of each name.
        Vec<String>,
    ),
    /// There is a file that will not do.
    #[error("{} will not do: {why}", .file.display())]
    Useless {
        /// The file.
        file: PathBuf,
        /// Why.
        why: String,
    },
}

/// Finds and loads it.
pub(crate) fn find(named: Option<&Path>) -> Result<(PathBuf, Functions), NotFound> {
    // Some such targets have a `dlopen`, which says that it cannot.
    if cfg!(target_feature = "crt-static") && !cfg!(windows) {
        return Err(NotFound::Static);
    }
    if let Some(named) = named {
        let file = file(named)?;
        let useless = |why| NotFound::Useless { file: file.clone(), why };
        let functions = Functions::load(&file).map_err(useless)?;
        return Ok((file, functions));
    }
    let mut said = Vec::new();
    for name in NAMES {
        match Functions::load(Path::new(name)) {
            Ok(functions) => return Ok((name.into(), functions)),
            Err(why) if why.contains(name) => said.push(why),
            Err(why) => said.push(format!("{name}: {why}")),
        }
    }
    Err(NotFound::NotInSystem(said))
}

/// The library's file where a file or a folder is named.
fn file(named: &Path) -> Result<PathBuf, NotFound> {
    let absent = |_| NotFound::Absent(named.to_owned());
    // The loader looks for names without a folder elsewhere.
    let whole = std::path::absolute(named).map_err(absent)?;
    let is_folder = whole.metadata().map_err(absent)?.is_dir();
    if !is_folder {
        return Ok(whole);
    }
    let in_folder = |below: &str| NAMES.iter().map(|name| whole.join(below).join(name)).find(|file| file.is_file());
    let found = BELOW.into_iter().find_map(in_folder);
    found.ok_or_else(|| NotFound::NotInFolder(named.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn what_is_named_is_a_file_or_a_folder() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        assert_eq!(file(&at("none")), Err(NotFound::Absent(at("none"))));
        assert_eq!(file(folder.path()), Err(NotFound::NotInFolder(folder.path().to_owned())));
        let told = NotFound::NotInFolder("x".into()).to_string();
        assert!(told.starts_with("TRACER_OIDN names the folder x, which has no ") && told.contains(NAMES[0]), "{told}");
        fs::create_dir(at("lib")).unwrap();
        for (k, name) in NAMES.iter().rev().enumerate() {
            for below in ["lib", ""] {
                let made = at(below).join(name);
                fs::write(&made, "no library").unwrap();
                assert_eq!(file(folder.path()), Ok(made), "{k}");
                fs::remove_file(at(below).join(name)).unwrap();
            }
        }
        // A file may be called as one likes.
        fs::write(at("mine"), "no library").unwrap();
        assert_eq!(file(&at("mine")), Ok(at("mine")));
    }

    #[test]
    fn what_is_no_library_will_not_do() {
        let folder = tempfile::tempdir().unwrap();
        let mine = folder.path().join("mine");
        fs::write(&mine, "no library").unwrap();
        let told = find(Some(&mine)).err().unwrap();
        if cfg!(target_feature = "crt-static") {
            assert_eq!(told, NotFound::Static);
            return;
        }
        let NotFound::Useless { file, why } = told else { panic!("{told:?}") };
        assert!(file == mine && !why.is_empty(), "{why}");
    }
}
