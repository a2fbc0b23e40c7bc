//! The committed cat: what a renderer may rely on, and that `cargo xtask cat` still makes it.

use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::path::PathBuf;

fn asset(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(name)
}

/// What the OBJ writer writes: `v`, `vt`, `vn` and triangles `f v/vt/vn`.
#[derive(Default)]
struct Obj {
    v: Vec<DVec3>,
    vt: Vec<DVec2>,
    vn: Vec<DVec3>,
    f: Vec<[[usize; 3]; 3]>,
}

impl Obj {
    fn read(name: &str) -> Obj {
        let text = std::fs::read_to_string(asset(name)).unwrap();
        let mut obj = Obj::default();
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let numbers = || words[1..].iter().map(|w| w.parse().unwrap()).collect::<Vec<f64>>();
            match words.first() {
                Some(&"v") => obj.v.push(DVec3::from_slice(&numbers())),
                Some(&"vt") => obj.vt.push(DVec2::from_slice(&numbers())),
                Some(&"vn") => obj.vn.push(DVec3::from_slice(&numbers())),
                Some(&"f") => obj.f.push(std::array::from_fn(|corner| {
                    let mut indices = words[1 + corner].split('/').map(|w| w.parse::<usize>().unwrap() - 1);
                    std::array::from_fn(|_| indices.next().unwrap())
                })),
                _ => {}
            }
        }
        obj
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.f[triangle].map(|c| self.v[c[0]])
    }
}

const MESHES: [(&str, usize); 2] = [("cat.obj", 4_000), ("cat_60k.obj", 60_000)];

#[test]
fn triangle_counts() {
    for (name, expected) in MESHES {
        let count = Obj::read(name).f.len();
        assert!(count.abs_diff(expected) <= expected / 10, "{name}: {count} triangles");
    }
}

/// Glass and mirrors need a closed surface: each edge is used by two triangles, once in each direction, about each
/// vertex lies one ring of triangles, and there is one piece without handles (V - E + F = 2).
#[test]
fn closed_in_one_piece() {
    for (name, _) in MESHES {
        let obj = Obj::read(name);
        let mut next = HashMap::new();
        for t in &obj.f {
            for i in 0..3 {
                let (from, to, opposite) = (t[i][0], t[(i + 1) % 3][0], t[(i + 2) % 3][0]);
                assert!(next.insert((from, to), opposite).is_none(), "{name}: edge {from}-{to} twice in one direction");
            }
        }
        assert!(next.keys().all(|&(a, b)| next.contains_key(&(b, a))), "{name}: has a border");
        assert_eq!(obj.v.len() + obj.f.len(), next.len() / 2 + 2, "{name}: V - E + F");

        let mut triangles_at = vec![0; obj.v.len()];
        let mut spoke = vec![None; obj.v.len()];
        for &(from, to) in next.keys() {
            triangles_at[from] += 1;
            spoke[from] = Some(to);
        }
        for v in 0..obj.v.len() {
            let first = spoke[v].unwrap_or_else(|| panic!("{name}: vertex {v} is not used"));
            let (mut around, mut at) = (0, first);
            loop {
                at = next[&(v, at)];
                around += 1;
                if at == first {
                    break;
                }
            }
            assert_eq!(around, triangles_at[v], "{name}: two sheets touch at vertex {v}");
        }
    }
}

#[test]
fn faces_and_normals_point_outwards() {
    for (name, _) in MESHES {
        let obj = Obj::read(name);
        let volume: f64 = (0..obj.f.len()).map(|t| obj.corners(t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
        assert!(volume > 1000.0, "{name}: volume {volume}");
        for (t, face) in obj.f.iter().enumerate() {
            let [a, b, c] = obj.corners(t);
            let n = (b - a).cross(c - a).normalize();
            let mean: DVec3 = face.iter().map(|corner| obj.vn[corner[2]]).sum();
            assert!(n.dot(mean.normalize()) > 0.4, "{name}: face {t} and its vertex normals disagree");
        }
        assert!(obj.vn.iter().all(|n| (n.length() - 1.0).abs() < 2e-3), "{name}: vn not of unit length");
    }
}

/// Every triangle's texture coordinates are its corners seen from one side: inside the picture, and no longer than the
/// triangle at the atlas' density, which a triangle smeared over a seam would be.
#[test]
fn texture_coordinates_in_range_and_unsmeared() {
    for (name, _) in MESHES {
        let obj = Obj::read(name);
        assert!(obj.vt.iter().all(|uv| uv.min_element() >= 0.0 && uv.max_element() <= 1.0), "{name}: vt out of 0..1");
        for (t, face) in obj.f.iter().enumerate() {
            let p = obj.corners(t);
            for i in 0..3 {
                let j = (i + 1) % 3;
                let along_texture = (obj.vt[face[i][1]] - obj.vt[face[j][1]]).length();
                // The head's charts, the densest, have 22.5 of 1024 texels per unit; vt are rounded to 1e-5.
                assert!(along_texture <= 0.024 * (p[i] - p[j]).length() + 2e-5, "{name}: face {t} is smeared");
            }
        }
    }
}

#[test]
fn triangles_are_well_shaped() {
    for (name, _) in MESHES {
        let obj = Obj::read(name);
        let mut quality: Vec<f64> = (0..obj.f.len()).map(|t| xtask::cat::mesh::quality(obj.corners(t))).collect();
        quality.sort_by(f64::total_cmp);
        assert!(quality[0] > 0.1, "{name}: worst triangle {}", quality[0]);
        assert!(
            quality[quality.len() / 20] > 0.5,
            "{name}: the worst twentieth begin at {}",
            quality[quality.len() / 20]
        );
    }
}

/// The scenes place the cat by these.
#[test]
fn stands_on_the_floor_and_looks_along_x() {
    for (name, _) in MESHES {
        let v = Obj::read(name).v;
        let min = v.iter().copied().reduce(DVec3::min).unwrap();
        let max = v.iter().copied().reduce(DVec3::max).unwrap();
        assert!(min.y.abs() < 0.05, "{name}: lowest point at {}", min.y);
        let nose = v.iter().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
        assert!(nose.y > 25.0 && nose.z.abs() < 1.0, "{name}: nose at {nose}");
        assert!((40.0..44.0).contains(&max.y) && max.z < 8.0 && min.z > -8.0, "{name}: {min} to {max}");
    }
}
