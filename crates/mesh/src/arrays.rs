//! Meshes from arrays in memory, as programs have them.

use super::builder::Builder;
use super::colors::VertexColors;
use super::data::{MAX_COORDINATE, MeshData};
use super::error::MeshError;
use scene_format::desc::Faces;
use std::path::Path;

/// A mesh as arrays: points, faces that name them by number, and what points carry.
///
/// ```
/// use scene_format::desc::Faces;
/// use std::path::Path;
/// use tracer_mesh::MeshArrays;
///
/// let mut faces = Faces::default();
/// faces.push(&[0, 1, 2, 3]);
/// let square = MeshArrays {
///     points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
///     faces,
///     uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
///     ..MeshArrays::default()
/// };
/// assert_eq!(square.mesh(Path::new("square"))?.triangles.len(), 2);
/// # Ok::<(), tracer_mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshArrays {
    /// The points.
    pub points: Vec<[f64; 3]>,
    /// The faces; those of more than three corners are cut.
    pub faces: Faces,
    /// A normal for each point, of any length; or none at all.
    pub normals: Vec<[f64; 3]>,
    /// Texture coordinates for each point (u to the right, v upwards); or none at all.
    pub uvs: Vec<[f64; 2]>,
    /// A colour for each point; or none at all.
    pub colors: Option<VertexColors>,
}

impl MeshArrays {
    /// The mesh: every index checked, faces cut into triangles, those without area left out. `name` is what messages
    /// call it.
    ///
    /// # Errors
    /// When numbers are not finite or too large, lists are not as long as that of the points, a face names a point that
    /// is not there, or no triangle is left.
    pub fn mesh(&self, name: &Path) -> Result<MeshData, MeshError> {
        let fault = |message: String, expected: String| MeshError::Arrays { path: name.to_owned(), message, expected };
        let largest = format!("numbers of a magnitude of at most {MAX_COORDINATE:e}");
        finite("points", &self.points, MAX_COORDINATE).map_err(|message| fault(message, largest.clone()))?;
        finite("normals", &self.normals, MAX_COORDINATE).map_err(|message| fault(message, largest))?;
        let most = f64::from(f32::MAX);
        finite("uvs", &self.uvs, most).map_err(|message| fault(message, "numbers of at most 3.4e38".to_owned()))?;
        let colors = self.colors.as_ref().map_or(0, VertexColors::len);
        for (what, count) in [("normals", self.normals.len()), ("uvs", self.uvs.len()), ("colors", colors)] {
            if count != 0 && count != self.points.len() {
                let expected = format!("one for each of the {} points, or none", self.points.len());
                return Err(fault(format!("there are {count} {what}"), expected));
            }
        }
        let mut builder = Builder::default();
        builder.mesh.positions.clone_from(&self.points);
        self.normals.iter().for_each(|normal| builder.add_normal(*normal));
        builder.mesh.uvs = self.uvs.iter().map(|uv| uv.map(|x| x as f32)).collect();
        for (number, face) in self.faces.iter().enumerate() {
            let known = face.iter().try_for_each(|&corner| builder.corner(i64::from(corner), number).map(drop));
            known
                .and_then(|()| builder.add_face(face, number))
                .map_err(|found| fault(format!("faces[{number}]: {}", found.message), found.expected))?;
        }
        let found = format!("it has {} points and {} faces", self.points.len(), self.faces.iter().len());
        let colors = self.colors.clone().filter(|colors| !colors.is_empty());
        Ok(MeshData { colors, ..builder.finish(name, &found)? })
    }
}

/// What is wrong with the first number that is.
fn finite<const N: usize>(what: &str, rows: &[[f64; N]], most: f64) -> Result<(), String> {
    // No number is larger than nothing: NaN is none of those.
    let wrong = |row: &[f64; N]| !row.iter().all(|x| x.abs() <= most);
    match rows.iter().enumerate().find(|(_, row)| wrong(row)) {
        Some((number, row)) => Err(format!("{what}[{number}] is {row:?}")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> MeshArrays {
        let mut faces = Faces::default();
        faces.push(&[0, 1, 2]);
        MeshArrays { points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], faces, ..MeshArrays::default() }
    }

    fn told(mesh: &MeshArrays) -> String {
        let diagnostic = mesh.mesh(Path::new("m")).expect_err("a fault").to_diagnostic(Default::default());
        format!("{} {}; {}", diagnostic.code.as_str(), diagnostic.message, diagnostic.expected)
    }

    #[test]
    fn arrays_are_what_a_file_would_be() {
        let mut mesh = triangle();
        mesh.normals = vec![[0.0, 0.0, 2.0]; 3];
        mesh.uvs = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let made = mesh.mesh(Path::new("m")).expect("a mesh");
        let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
            property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n\
            element face 1\nproperty list uchar int vertex_indices\nend_header\n\
            0 0 0 0 0 2 0 0\n1 0 0 0 0 2 1 0\n0 1 0 0 0 2 0 1\n3 0 1 2\n";
        let read = crate::parse(ply.as_bytes(), crate::MeshFormat::Ply, Path::new("m")).expect("a mesh");
        assert_eq!(made, read);
    }

    #[test]
    fn what_is_wrong_with_arrays_is_told_with_its_place() {
        let mut far = triangle();
        far.faces.push(&[0, 1, 3]);
        assert_eq!(
            told(&far),
            "E0510 the mesh m: faces[1]: there is no vertex 3; an index from 0 to 2, as there are 3 vertices"
        );
        let mut none = triangle();
        none.points[1][2] = f64::NAN;
        assert!(told(&none).starts_with("E0510 the mesh m: points[1] is [1.0, 0.0, NaN]; "), "{}", told(&none));
        let short = MeshArrays { uvs: vec![[0.0; 2]], ..triangle() };
        assert_eq!(told(&short), "E0510 the mesh m: there are 1 uvs; one for each of the 3 points, or none");
        let few = MeshArrays { colors: Some(VertexColors::new(vec![[0.5; 3]; 2], false)), ..triangle() };
        assert_eq!(told(&few), "E0510 the mesh m: there are 2 colors; one for each of the 3 points, or none");
        let mut flat = triangle();
        flat.points[2] = [2.0, 0.0, 0.0];
        assert!(told(&flat).starts_with("E0511 m: the mesh has no triangles"), "{}", told(&flat));
    }
}
