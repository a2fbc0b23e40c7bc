//! Vertex normals: of unit length from files, and computed where a file has none.

#![expect(clippy::indexing_slicing, reason = "readers have checked every index, and this is said under Panics")]

use rayon::prelude::*;

/// The direction of a vector, computed in `f64`; `None` for the zero vector.
pub(super) fn unit(vector: [f64; 3]) -> Option<[f32; 3]> {
    let largest = vector.iter().fold(0.0_f64, |largest, part| largest.max(part.abs()));
    if largest == 0.0 {
        return None;
    }
    // Scaled first: the square of 1e-200 or 1e200 is no number to divide by.
    let scaled = vector.map(|part| part / largest);
    let length = dot(scaled, scaled).sqrt();
    Some(scaled.map(|part| (part / length) as f32))
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Unit vertex normals of a mesh: at each vertex the sum of the normals of its triangles, weighted by their area and by
/// their angle at the vertex, so that neither a dense patch nor the way a face was cut pulls the normal to its side
/// (angle: Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", 1998; area: Gouraud's usual sum).
///
/// One normal per position, outward when the triangles wind counter-clockwise seen from outside. Where the sum is zero
/// (two faces back to back), the normal of the vertex's first triangle; `[0, 0, 0]` for a vertex that no triangle uses.
/// Computed in `f64`, summed in the order of the triangles: the same bytes for any number of threads.
///
/// # Panics
/// When a triangle names a position that is not there, which [`super::load`] never gives.
pub fn vertex_normals(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[f32; 3]> {
    let corners = corners_by_vertex(positions.len(), triangles);
    (0..positions.len())
        .into_par_iter()
        .with_min_len(1024)
        .map(|vertex| {
            let mut sum = [0.0; 3];
            let mut first = None;
            let range = corners.starts[vertex] as usize..corners.starts[vertex + 1] as usize;
            for &corner in &corners.corners[range] {
                let triangle = triangles[corner as usize / 3];
                let [a, b, c] = [0, 1, 2].map(|step| positions[triangle[(corner as usize + step) % 3] as usize]);
                let (to_b, to_c) = (difference(b, a), difference(c, a));
                let normal = cross(to_b, to_c);
                let sine = dot(normal, normal).sqrt();
                let angle = libm::atan2(sine, dot(to_b, to_c));
                for axis in 0..3 {
                    sum[axis] += angle * normal[axis];
                }
                first = first.or(unit(normal));
            }
            unit(sum).or(first).unwrap_or_default()
        })
        .collect()
}

/// The corners of all triangles (numbered 3 * triangle + corner), sorted by vertex and then by number.
struct CornersByVertex {
    /// Where each vertex's part of `corners` starts; one entry more than there are vertices.
    starts: Vec<u64>,
    corners: Vec<u64>,
}

fn corners_by_vertex(vertices: usize, triangles: &[[u32; 3]]) -> CornersByVertex {
    let mut starts = vec![0_u64; vertices + 1];
    for &vertex in triangles.as_flattened() {
        starts[vertex as usize + 1] += 1;
    }
    for vertex in 0..vertices {
        starts[vertex + 1] += starts[vertex];
    }
    let mut ends = starts.clone();
    let mut corners = vec![0; 3 * triangles.len()];
    for (corner, &vertex) in triangles.as_flattened().iter().enumerate() {
        let end = &mut ends[vertex as usize];
        corners[*end as usize] = corner as u64;
        *end += 1;
    }
    CornersByVertex { starts, corners }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: [[f64; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    const CUBE_TRIANGLES: [[u32; 3]; 12] = [
        [0, 2, 1],
        [0, 3, 2],
        [4, 5, 6],
        [4, 6, 7],
        [0, 1, 5],
        [0, 5, 4],
        [1, 2, 6],
        [1, 6, 5],
        [2, 3, 7],
        [2, 7, 6],
        [3, 0, 4],
        [3, 4, 7],
    ];

    /// The cut of a face must not matter: each corner of a cube has the diagonal, although some touch one triangle of a
    /// face and some two. All triangles have the same area, so the angles alone decide.
    #[test]
    fn the_corners_of_a_cube_point_along_its_diagonals() {
        for scale in [1.0, 1e-4, 1e5] {
            let positions = CUBE.map(|p| p.map(|x| 1e5 + scale * x));
            let third = 1.0 / 3.0_f32.sqrt();
            for (position, normal) in CUBE.iter().zip(vertex_normals(&positions, &CUBE_TRIANGLES)) {
                for axis in 0..3 {
                    let expected = if position[axis] > 0.5 { third } else { -third };
                    // Positions near 1e5 are exact to 1.5e-11: 3e-7 of an edge of 1e-4 after two differences.
                    assert!((normal[axis] - expected).abs() < 1e-6, "{scale} {position:?} {normal:?}");
                }
            }
        }
    }

    #[test]
    fn large_triangles_weigh_more() {
        // A right angle between a triangle of area 4.5 and one of area 0.5: the sum leans by 9 to 1.
        let positions = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let normals = vertex_normals(&positions, &[[0, 1, 2], [0, 3, 4]]);
        let length = 82.0_f64.sqrt();
        assert_eq!(normals[0], [(1.0 / length) as f32, 0.0, (9.0 / length) as f32]);
        assert_eq!(normals[1], [0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_normal_is_there_even_where_the_sum_vanishes() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [9.0, 9.0, 9.0]];
        let normals = vertex_normals(&positions, &[[0, 1, 2], [0, 2, 1]]);
        assert_eq!(normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3]]);
    }

    #[test]
    fn threads_do_not_change_the_normals() {
        // A wavy sheet of 200 x 200 quadrilaterals.
        let side = 200_u32;
        let positions: Vec<[f64; 3]> = (0..=side)
            .flat_map(|y| (0..=side).map(move |x| [f64::from(x), f64::from(y), libm::sin(f64::from(x * y) * 0.01)]))
            .collect();
        let triangles: Vec<[u32; 3]> = (0..side)
            .flat_map(|y| (0..side).map(move |x| y * (side + 1) + x))
            .flat_map(|corner| {
                [[corner, corner + 1, corner + side + 2], [corner, corner + side + 2, corner + side + 1]]
            })
            .collect();
        let with_threads = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| vertex_normals(&positions, &triangles))
        };
        assert_eq!(with_threads(1), with_threads(3));
    }
}
