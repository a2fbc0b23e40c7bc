//! Height fields against the surfaces that they are taken from.

use super::*;
use scene_format::desc::HeightField;
use std::path::PathBuf;

fn field(size: Vector, center: Vector, smooth: bool) -> HeightField {
    HeightField {
        file: PathBuf::from("heights.png").into(),
        size: size.into(),
        center: center.into(),
        smooth,
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }
}

/// Heights by their column and row.
fn heights(width: u32, depth: u32, height: impl Fn(f64, f64) -> f64) -> Heights {
    let point = |k: u32| height(f64::from(k % width), f64::from(k / width)) as f32;
    Heights { width, depth, values: (0..width * depth).map(point).collect() }
}

fn mesh_of(field: &HeightField, heights: &Heights) -> MeshData {
    let mesh = height_field(field, heights, Span::NONE).expect("a mesh");
    check(&mesh);
    assert_eq!(mesh.triangles.len() as u32, 2 * (heights.width - 1) * (heights.depth - 1));
    assert!(mesh.triangles.iter().all(|&t| area(&mesh, t)[1] > 0.0), "the front is above");
    mesh
}

/// Row 0 lies at -z, column 0 at -x, black at the middle's height; u grows along x, v along -z.
#[test]
fn seen_from_above_it_is_the_picture() {
    let spike = heights(5, 4, |column, row| if (column, row) == (3.0, 1.0) { 1.0 } else { 0.0 });
    let mesh = mesh_of(&field([8.0, 3.0, 6.0], [10.0, 20.0, 30.0], false), &spike);
    let at = mesh.positions.iter().position(|p| p[1] == 23.0).expect("a spike");
    assert_eq!(mesh.positions[at], [12.0, 23.0, 29.0]);
    assert_eq!(mesh.uvs[at], [0.75, (1.0 - 1.0 / 3.0) as f32]);
    let corner = |position: Vector| mesh.positions.iter().position(|p| *p == position).map(|k| mesh.uvs[k]);
    assert_eq!(corner([6.0, 20.0, 27.0]), Some([0.0, 1.0]));
    assert_eq!(corner([14.0, 20.0, 33.0]), Some([1.0, 0.0]));
    assert!(mesh.normals.is_empty() && mesh.normal_triangles.is_none());
}

#[test]
fn a_plane_is_one() {
    let slanted = heights(7, 5, |column, row| (4.0 + column - 2.0 * row) / 16.0);
    for smooth in [false, true] {
        let mesh = mesh_of(&field([6.0, 16.0, 4.0], [0.0; 3], smooth), &slanted);
        // y = x - 2 z, but for where it begins.
        let cut = mesh.triangles.iter().map(|&t| area(&mesh, t));
        for [x, y, z] in cut {
            assert!((x + 1.0).abs() < 1e-12 && (y - 1.0).abs() < 1e-12 && (z - 2.0).abs() < 1e-12);
        }
        let length = 6.0_f64.sqrt();
        for normal in &mesh.normals {
            let expected = [-1.0, 1.0, 2.0].map(|x| (x / length) as f32);
            assert!((0..3).all(|k| (normal[k] - expected[k]).abs() < 1e-7), "{normal:?}");
        }
        assert_eq!(mesh.normals.len(), if smooth { 35 } else { 0 });
        assert!(mesh.normal_triangles.is_none());
    }
    let two = mesh_of(&field([1.0; 3], [0.0; 3], true), &heights(2, 2, |_, _| 0.5));
    assert_eq!((two.positions.len(), two.triangles.len(), two.normals.len()), (4, 2, 4));
}

/// Inside, normals are those of the paraboloid itself: differences of squares are exact.
#[test]
fn normals_of_a_paraboloid_are_exact() {
    let n = 33;
    let side = |k: f64| 2.0 * k / f64::from(n - 1) - 1.0;
    let bowl = heights(n, n, |column, row| 0.25 * (side(column) * side(column) + 2.0 * side(row) * side(row)));
    let mesh = mesh_of(&field([2.0, 2.0, 2.0], [0.0; 3], true), &bowl);
    let mut seen = 0;
    for (p, normal) in mesh.positions.iter().zip(&mesh.normals) {
        let [x, y, z] = *p;
        assert!((y - 0.5 * (x * x + 2.0 * z * z)).abs() < 1e-7);
        let inside = x.abs() < 0.99 && z.abs() < 0.99;
        let slope = [-x, 1.0, -2.0 * z];
        let length = dot(slope, slope).sqrt();
        // At the border it is the slope half a cell further in.
        let tolerance = if inside { 1e-6 } else { 0.07 };
        assert!((0..3).all(|k| (f64::from(normal[k]) - slope[k] / length).abs() < tolerance), "{p:?} {normal:?}");
        seen += u32::from(inside);
    }
    assert_eq!(seen, 31 * 31);
}

/// A roof that bends by more than 40 degrees has two normals along its ridge, one that bends by less has one.
#[test]
fn creases_of_more_than_40_degrees_are_sharp() {
    for (degrees, sharp) in [(19.0_f64, false), (21.0, true)] {
        let slope = libm::tan(degrees.to_radians());
        let roof = heights(9, 4, |column, _| 1.0 - (column - 4.0).abs() / 4.0);
        let mesh = mesh_of(&field([8.0, 4.0 * slope, 3.0], [0.0; 3], true), &roof);
        let corners = mesh.normal_triangles.as_ref();
        assert_eq!(corners.is_some(), sharp);
        assert_eq!(mesh.normals.len(), if sharp { 36 + 4 } else { 36 });
        for (triangle, &vertices) in mesh.triangles.iter().enumerate() {
            let normals = corners.map_or(vertices, |corners| corners[triangle]);
            for (vertex, normal) in vertices.into_iter().zip(normals) {
                let [x, ..] = mesh.positions[vertex as usize];
                let upright = x.abs() < 1e-9 && !sharp;
                let side = area(&mesh, vertices)[0].signum();
                let expected = if upright { 0.0 } else { side * libm::sin(degrees.to_radians()) };
                let found = f64::from(mesh.normals[normal as usize][0]);
                assert!((found - expected).abs() < 1e-6, "{degrees}: at {x}: {found}, not {expected}");
            }
        }
    }
}

/// Around a needle every side is apart, around a pit too; the normals of each are on its front, as `check` sees.
#[test]
fn needles_and_pits_have_a_normal_for_each_side() {
    for height in [5.0, -5.0] {
        let needle = heights(5, 5, |column, row| if (column, row) == (2.0, 2.0) { height } else { 0.0 });
        let mesh = mesh_of(&field([4.0, 1.0, 4.0], [0.0; 3], true), &needle);
        let corners = mesh.normal_triangles.as_ref().expect("creases");
        let at_tip = |(vertices, normals): (&[u32; 3], &[u32; 3])| {
            vertices.iter().position(|&v| mesh.positions[v as usize][1] != 0.0).map(|k| normals[k])
        };
        let tips: std::collections::BTreeSet<u32> = mesh.triangles.iter().zip(corners).filter_map(at_tip).collect();
        assert_eq!(tips.len(), 6);
    }
}

#[test]
fn heights_beyond_the_arithmetic_are_told() {
    let far = heights(2, 2, |column, _| if column > 0.0 { 1e38 } else { 0.0 });
    let fault = height_field(&field([1.0, 10.0, 1.0], [0.0; 3], true), &far, Span::NONE).expect_err("too high");
    assert_eq!(fault.code, scene_format::codes::OUT_OF_RANGE);
}
