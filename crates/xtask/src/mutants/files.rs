//! Faults in what reads meshes, placements, materials and textures.

use super::{Mutant, kernel_units, mesh_suite, mesh_units, suite};

const PIECE: &str = "crates/mesh/src/obj/piece.rs";
const PLY: &str = "crates/mesh/src/ply/mod.rs";
const PLY_SOURCE: &str = "crates/mesh/src/ply/source.rs";
const STL: &str = "crates/mesh/src/stl.rs";
const MESH: &str = "crates/mesh/src/data.rs";
const GLTF: &str = "crates/mesh/src/gltf/walk.rs";
const ACCESSOR: &str = "crates/mesh/src/gltf/accessor.rs";
const NORMALS: &str = "crates/mesh/src/normals.rs";
const POLYGON: &str = "crates/mesh/src/polygon.rs";
const PLACEMENTS: &str = "crates/mesh/src/placements.rs";
const MTL: &str = "crates/mesh/src/mtl/library.rs";
const NAMED: &str = "crates/tracer-core/src/compile/materials.rs";
const PROGRAMS: &str = "crates/tracer-core/src/compile/programs.rs";
const SRGB: &str = "crates/kernels/src/srgb.rs";
const READING: &str = "crates/tracer-core/src/texture/reading.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "obj-negative-index-off-by-one",
        file: PIECE,
        find: "(count as i64).saturating_add(number)",
        replace: "(count as i64).saturating_add(number - 1)",
        caught_by: mesh_suite("mesh_obj", &["negative_indices_count_back_from_the_face"]),
    },
    Mutant {
        name: "obj-indices-from-zero",
        file: PIECE,
        find: "u32::try_from(number - 1).ok()",
        replace: "u32::try_from(number).ok()",
        caught_by: mesh_suite("mesh_obj", &["faces_of_positions_alone"]),
    },
    Mutant {
        name: "obj-normal-counted-among-texture-coordinates",
        file: PIECE,
        find: "normal = parse_index(cursor, self.normals.len(), start)?;",
        replace: "normal = parse_index(cursor, self.uvs.len(), start)?;",
        caught_by: mesh_suite("mesh_obj", &[]),
    },
    Mutant {
        name: "ply-bytes-in-the-other-order",
        file: PLY_SOURCE,
        find: "if BIG {",
        replace: "if !BIG {",
        caught_by: mesh_suite("mesh_ply", &["a_cube_is_the_same_in_every_encoding_and_type"]),
    },
    Mutant {
        name: "ply-lists-skipped-by-their-length",
        file: PLY,
        find: "length.saturating_mul(item.bytes())",
        replace: "length.saturating_mul(item.bytes().min(1))",
        caught_by: mesh_suite("mesh_ply", &["what_is_not_needed_is_stepped_over"]),
    },
    Mutant {
        name: "ply-strips-wound-one-way",
        file: PLY,
        find: "odd = !odd;",
        replace: "odd = false;",
        caught_by: mesh_suite("mesh_ply", &["strips_of_triangles_are_unwound"]),
    },
    Mutant {
        name: "gltf-mirrored-nodes-inside-out",
        file: GLTF,
        find: "if mirrored { [a, c, b] } else { [a, b, c] }",
        replace: "[a, b, c]",
        caught_by: mesh_suite("mesh_gltf", &["mirrored_nodes_keep_their_fronts_and_normals"]),
    },
    Mutant {
        name: "gltf-normals-by-the-matrix",
        file: GLTF,
        find: "let normal = placed.normals * DVec3::from(normals.get(k)?);",
        replace: "let normal = placed.map.matrix3 * DVec3::from(normals.get(k)?);",
        caught_by: mesh_suite("mesh_gltf", &["mirrored_nodes_keep_their_fronts_and_normals"]),
    },
    Mutant {
        name: "gltf-strips-wound-one-way",
        file: GLTF,
        find: "[k, k + 1 + k % 2, k + 2 - k % 2]",
        replace: "[k, k + 1, k + 2]",
        caught_by: mesh_suite("mesh_gltf", &["strips_and_fans_are_unwound"]),
    },
    Mutant {
        name: "gltf-textures-upside-down",
        file: GLTF,
        find: "[u, 1.0 - v]",
        replace: "[u, v]",
        caught_by: mesh_suite("mesh_gltf", &["mirrored_nodes_keep_their_fronts_and_normals"]),
    },
    Mutant {
        name: "gltf-normalized-by-256",
        file: ACCESSOR,
        find: "Component::I8 => 127.0,",
        replace: "Component::I8 => 128.0,",
        caught_by: mesh_suite("mesh_gltf", &["accessors_may_be_interleaved_sparse_and_normalized"]),
    },
    Mutant {
        name: "stl-joins-nothing",
        file: STL,
        find: "vertices[number] = vertices[first];",
        replace: "vertices[number] = first as u32;",
        caught_by: mesh_suite("mesh_stl", &["corners_are_one_vertex_where_all_their_bits_are_the_same"]),
    },
    Mutant {
        name: "stl-text-for-binary",
        file: STL,
        find: " && !text.iter().take(LOOKED_AT).any(|&byte| byte == 0)",
        replace: "",
        caught_by: mesh_suite("mesh_stl", &["binary_files_may_start_with_solid"]),
    },
    Mutant {
        name: "barycentre-by-the-triangles",
        file: MESH,
        find: "for position in &self.positions {",
        replace: "for position in self.triangles.as_flattened().iter().map(|&k| &self.positions[k as usize]) {",
        caught_by: mesh_suite("mesh_obj", &["the_barycentre_is_the_mean_of_all_vertices"]),
    },
    Mutant {
        name: "vertex-normals-without-angles",
        file: NORMALS,
        find: "sum[axis] += angle * normal[axis];",
        replace: "sum[axis] += normal[axis] + 0.0 * angle;",
        caught_by: mesh_units(&["normals"]),
    },
    Mutant {
        name: "quadrilateral-along-the-worse-diagonal",
        file: POLYGON,
        find: "let halves = if first >= second",
        replace: "let halves = if first < second",
        caught_by: mesh_units(&["polygon"]),
    },
    Mutant {
        name: "rotation-by-the-left-hand-rule",
        file: PLACEMENTS,
        find: "+ cross * sin + outer",
        replace: "- cross * sin + outer",
        caught_by: mesh_units(&["placements"]),
    },
    Mutant {
        name: "placement-matrix-by-columns",
        file: PLACEMENTS,
        find: "DMat3::from_cols_array(&[a, d, g, b, e, h, c, f, i])",
        replace: "DMat3::from_cols_array(&[a, b, c, d, e, f, g, h, i])",
        caught_by: mesh_units(&["placements"]),
    },
    Mutant {
        name: "mtl-transparency-for-opacity",
        file: MTL,
        find: "self.opacity = Some(1.0 - parse_number(cursor)?)",
        replace: "self.opacity = Some(parse_number(cursor)?)",
        caught_by: mesh_suite("mesh_load", &["materials_of_mtl_become_ours"]),
    },
    Mutant {
        name: "srgb-left-out",
        file: SRGB,
        find: "if code <= 0.04045 { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) }",
        replace: "code",
        caught_by: kernel_units(&["srgb"]),
    },
    Mutant {
        name: "texture-blue-for-red",
        file: READING,
        find: "u32::from_le_bytes([p[which[0]], p[which[1]], p[which[2]], 0])",
        replace: "u32::from_le_bytes([p[which[2]], p[which[1]], p[which[0]], 0])",
        caught_by: suite("texture_load", &["eight_bit_pictures_keep_their_code_values_row_by_row_from_the_top"]),
    },
    Mutant {
        name: "sixteen-bits-by-65536",
        file: SRGB,
        find: "linear_of_srgb(f64::from(value) / 65535.0)",
        replace: "linear_of_srgb(f64::from(value) / 65536.0)",
        caught_by: kernel_units(&["srgb"]),
    },
    Mutant {
        name: "texture-name-for-a-pattern",
        file: NAMED,
        find: "let albedo = albedo.resolved();",
        replace: "",
        caught_by: suite("proofs", &["names_of_textures_change_nothing"]),
    },
    Mutant {
        name: "texture-name-within-a-texture",
        file: PROGRAMS,
        find: "parts.into_iter().map(desc::Albedo::resolved).collect();",
        replace: "parts.into_iter().collect();",
        caught_by: suite("proofs", &["names_of_textures_change_nothing"]),
    },
];
