//! Meshes that stand in a scene itself: points, and faces that name them.

use super::builder::Builder;
use super::colors::VertexColors;
use super::data::MeshData;
use super::error::MeshError;
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::desc::InlineMesh;
use scene_format::diagnostic::Span;
use std::path::Path;

/// The mesh that a scene writes out: faces cut into triangles as those of files are. It stands at `span` of the scene
/// file, which its warnings name, too.
///
/// # Errors
/// The diagnostic that no triangle is left (`E0511`), or that a face names a point that is not there or has too many
/// corners or crossings to be cut (`E0510`); `scene_format` makes sure that points are there.
pub fn mesh_of(inline: &InlineMesh, span: Span) -> Result<MeshData, Box<Diagnostic>> {
    let mut builder = Builder::default();
    builder.mesh.positions = inline.points.clone();
    let colors = (inline.colors.len() == inline.points.len())
        .then(|| VertexColors::new(inline.colors.iter().map(|color| color.map(|x| x as f32)).collect(), false));
    for (number, face) in inline.faces.iter().enumerate() {
        let added = face.iter().try_for_each(|&corner| builder.corner(i64::from(corner), number).map(drop));
        added.and_then(|()| builder.add_face(face, number)).map_err(|fault| {
            let message = format!("faces[{number}] of the mesh: {}", fault.message);
            Box::new(Diagnostic::error(codes::BROKEN_MESH, span, message).expected(fault.expected))
        })?;
    }
    let count = |count: usize, one: &str| if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") };
    let found =
        format!("it has {} and {}", count(inline.points.len(), "point"), count(inline.faces.iter().len(), "face"));
    let mut mesh = builder.finish(Path::new(""), &found).map_err(|error| {
        Box::new(match error {
            MeshError::Empty { hint, .. } => Diagnostic::error(codes::EMPTY_MESH, span, "the mesh has no triangles")
                .expected("at least one triangle with an area")
                .hint(hint),
            other => other.to_diagnostic(span),
        })
    })?;
    mesh.colors = colors;
    // They are about the scene, not about another file.
    for warning in &mut mesh.warnings {
        *warning = Diagnostic::warning(warning.code, span, std::mem::take(&mut warning.message));
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_format::desc::Faces;

    fn inline(points: &[[f64; 3]], faces: &[&[u32]]) -> InlineMesh {
        let mut list = Faces::default();
        faces.iter().for_each(|face| list.push(face));
        InlineMesh { points: points.to_vec(), faces: list, colors: Vec::new() }
    }

    const ARROW: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, -1.0, 0.0], [0.0, 3.0, 0.0], [-2.0, -1.0, 0.0]];

    /// An arrowhead must be cut at its notch.
    #[test]
    fn faces_are_cut_as_those_of_files_are() {
        let mesh = mesh_of(&inline(&ARROW, &[&[0, 1, 2, 3]]), Span::NONE).expect("a mesh");
        assert_eq!(mesh.positions, ARROW);
        let mut corners: Vec<[u32; 3]> = mesh.triangles.clone();
        corners.iter_mut().for_each(|triangle| {
            let first = (0..3).min_by_key(|&k| triangle[k]).expect("three");
            triangle.rotate_left(first);
        });
        corners.sort_unstable();
        assert_eq!(corners, [[0, 1, 2], [0, 2, 3]]);
        assert!(mesh.warnings.is_empty() && mesh.normals.is_empty() && mesh.uvs.is_empty());
    }

    #[test]
    fn what_is_odd_or_wrong_is_told_at_the_mesh() {
        let span = Span { source: 0, start: 5, end: 9 };
        let mesh = mesh_of(&inline(&ARROW, &[&[0, 1, 2], &[0, 0, 1]]), span).expect("a mesh");
        let told: Vec<_> = mesh.warnings.iter().map(|w| (w.code.as_str(), w.message.as_str(), w.span)).collect();
        assert_eq!(told, [("W0510", "the mesh has oddities: 1 triangle without area (left out)", span)]);
        assert!(mesh.warnings.iter().all(|warning| warning.elsewhere.is_none()));

        let error = mesh_of(&inline(&ARROW, &[&[0, 0, 1]]), span).expect_err("no triangle");
        assert_eq!(
            (error.code.as_str(), error.message.as_str(), error.span),
            ("E0511", "the mesh has no triangles", span)
        );
        assert_eq!(error.hint, "it has 4 points and 1 face: 1 triangle without area (left out)");

        let error = mesh_of(&inline(&ARROW, &[&[0, 1, 2], &[0, 1, 4]]), span).expect_err("no point");
        assert_eq!(error.message, "faces[1] of the mesh: there is no vertex 4");
    }
}
