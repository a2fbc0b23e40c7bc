//! Parts of mesh files, by their names.

use super::cursor::shown;
use super::data::NO_INDEX;
use super::error::MeshError;
use std::collections::BTreeSet;
use std::path::Path;

/// How many names a message shows.
const NAMES: usize = 12;

/// That a file has no part of this name. `names`: those that it has, in their order; some may come again. `kinds`: what
/// they are names of.
#[cold]
pub(super) fn unknown<'n>(
    path: &Path,
    part: &str,
    names: impl Iterator<Item = &'n str>,
    kinds: &'static str,
) -> MeshError {
    let mut known = BTreeSet::new();
    let names: Vec<&str> = names.filter(|&name| !name.is_empty() && known.insert(name)).collect();
    let plain = |name: &&str| shown(name.as_bytes());
    MeshError::UnknownPart {
        path: path.to_owned(),
        part: shown(part.as_bytes()),
        kinds,
        nearest: scene_format::nearest(part, names.iter().copied()).map(|name| shown(name.as_bytes())),
        names: names.iter().take(NAMES).map(plain).collect(),
        count: names.len(),
    }
}

/// The numbers that values have when only those are left that corners name; [`NO_INDEX`]: it is not.
#[expect(clippy::indexing_slicing, reason = "readers have checked every index")]
pub(super) fn numbers_of_named(count: usize, corners: &[[u32; 3]]) -> Vec<u32> {
    let mut numbers = vec![NO_INDEX; count];
    for &corner in corners.as_flattened().iter().filter(|&&corner| corner != NO_INDEX) {
        numbers[corner as usize] = 0;
    }
    for (next, number) in (0..).zip(numbers.iter_mut().filter(|number| **number != NO_INDEX)) {
        *number = next;
    }
    numbers
}

/// Leaves the values that have a number.
pub(super) fn keep_numbered<T>(values: &mut Vec<T>, numbers: &[u32]) {
    let mut numbers = numbers.iter();
    values.retain(|_| numbers.next().is_some_and(|&number| number != NO_INDEX));
    values.shrink_to_fit();
}

/// Has corners name values by their new numbers.
#[expect(clippy::indexing_slicing, reason = "as `numbers_of_named`")]
pub(super) fn number_anew(corners: &mut [[u32; 3]], numbers: &[u32]) {
    for corner in corners.as_flattened_mut().iter_mut().filter(|corner| **corner != NO_INDEX) {
        *corner = numbers[*corner as usize];
    }
}
