//! Transforms of the scene language as matrices.

use super::patterns;
use glam::{DAffine3, DMat3, DVec3};
use scene_format::desc::{Placements, Transform};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use tracer_mesh::placements::{load_placements, rotation};

/// Applies the transforms first to last. `barycentre` is the fixed point of those that name none: it moves along.
/// `lowest` gives the smallest y of the shape under a map (asked only by `DropTo`).
pub fn place(transforms: &[Spanned<Transform>], barycentre: DVec3, lowest: &dyn Fn(&DAffine3) -> f64) -> DAffine3 {
    let mut map = DAffine3::IDENTITY;
    for transform in transforms {
        let here = |about: &Option<Box<[f64; 3]>>, map: &DAffine3| {
            about.as_deref().map_or_else(|| map.transform_point3(barycentre), |about| DVec3::from(*about))
        };
        let step = match &transform.value {
            Transform::Translate(by) => DAffine3::from_translation(DVec3::from(*by)),
            Transform::Scale { factor, about } => {
                about_point(DMat3::from_diagonal(DVec3::from(*factor)), here(about, &map))
            }
            Transform::Rotate { axis, degrees, about } => {
                about_point(rotation(DVec3::from(*axis), *degrees), here(about, &map))
            }
            Transform::DropTo { y } => DAffine3::from_translation(DVec3::new(0.0, y - lowest(&map), 0.0)),
        };
        map = step * map;
    }
    map
}

/// A linear map with this fixed point.
fn about_point(matrix: DMat3, point: DVec3) -> DAffine3 {
    DAffine3 { matrix3: matrix, translation: point - matrix * point }
}

/// Copies of one object, at most, those of the groups around it counted.
const MOST_COPIES: u64 = 100_000_000;

/// The maps of the copies, in the world. A fault of a group is told once, whatever stands in it.
pub fn copies(desc: &SceneDesc, placements: &Placements, diagnostics: &mut Diagnostics) -> Vec<DAffine3> {
    match placements {
        Placements::One => vec![DAffine3::IDENTITY],
        Placements::List(list) => list.iter().map(|steps| place(steps, DVec3::ZERO, &|_| 0.0)).collect(),
        Placements::File(file) => match load_placements(&desc.base_dir.join(&file.value)) {
            Ok(maps) => maps,
            Err(error) => {
                diagnostics.push(error.to_diagnostic(file.span));
                Vec::new()
            }
        },
        Placements::Pattern(pattern) => patterns::maps(pattern, diagnostics),
        Placements::Within(within) => {
            let mut maps = copies(desc, &within.own, diagnostics);
            let mut found = Diagnostics::new();
            for group in within.groups.outwards() {
                let step = place(&group.transform, DVec3::ZERO, &|_| 0.0);
                let around = copies(desc, &group.placements, &mut found);
                if maps.len() as u64 * around.len() as u64 > MOST_COPIES {
                    let at = group.placements.files().first().map_or(Span::NONE, |file| file.span);
                    let message = format!("groups make more than {MOST_COPIES} copies of an object");
                    found.push(Diagnostic::error(codes::TOO_MUCH, at, message).expected("fewer copies"));
                    maps.clear();
                    break;
                }
                let outer = around.iter().map(|outer| *outer * step);
                maps = outer.flat_map(|outer| maps.iter().map(move |inner| outer * *inner)).collect();
            }
            for fault in found {
                if !diagnostics.contains(&fault) {
                    diagnostics.push(fault);
                }
            }
            maps
        }
    }
}

/// An error where a map cannot be undone; `at`: the transforms, or what they belong to.
pub fn check(maps: &[DAffine3], at: Span, noun: &str, diagnostics: &mut Diagnostics) {
    let usable = |m: &DAffine3| m.is_finite() && m.matrix3.determinant() != 0.0 && m.matrix3.inverse().is_finite();
    if let Some(copy) = maps.iter().position(|m| !usable(m)) {
        let which = if maps.len() > 1 { format!(" (copy {})", copy + 1) } else { String::new() };
        let message = format!("the transforms flatten the {noun} to nothing{which}");
        diagnostics.push(
            Diagnostic::error(codes::SINGULAR_TRANSFORM, at, message)
                .expected("transforms that can be undone: no scale of 0, no overflow"),
        );
    }
}

/// Where right and up are on a surface that faces along n (any length), as it is seen from the front, and n as a unit
/// vector: right is y x n, or x where n is upright.
pub fn sides(n: DVec3) -> [DVec3; 3] {
    let n = (n / n.abs().max_element()).normalize();
    let right = if n.y.abs() > 0.9999 { DVec3::X } else { DVec3::Y.cross(n).normalize() };
    // Where n is nearly upright x is not quite across it.
    let up = n.cross(right).normalize();
    [up.cross(n), up, n]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: DVec3, b: [f64; 3]) {
        assert!((a - DVec3::from(b)).length() < 1e-12, "{a} {b:?}");
    }

    #[test]
    fn rotation_by_the_right_hand_rule() {
        near(rotation(DVec3::Y, 90.0) * DVec3::Z, [1.0, 0.0, 0.0]);
        near(rotation(DVec3::Z * 2.0, 90.0) * DVec3::X, [0.0, 1.0, 0.0]);
        near(rotation(DVec3::ONE, 120.0) * DVec3::X, [0.0, 1.0, 0.0]);
    }

    #[test]
    fn scale_and_rotate_act_about_the_barycentre_which_moves_along() {
        let steps = [
            Transform::Translate([10.0, 0.0, 0.0]),
            Transform::Scale { factor: [2.0; 3], about: None },
            Transform::Rotate { axis: [0.0, 0.0, 1.0], degrees: 90.0, about: None },
        ]
        .map(Spanned::from);
        let map = place(&steps, DVec3::new(1.0, 0.0, 0.0), &|_| 0.0);
        near(map.transform_point3(DVec3::new(1.0, 0.0, 0.0)), [11.0, 0.0, 0.0]);
        near(map.transform_point3(DVec3::new(2.0, 0.0, 0.0)), [11.0, 2.0, 0.0]);
    }

    #[test]
    fn copies_in_groups_are_the_product_from_the_inside_outwards() {
        let text = r#"Scene(background: 1, objects: [
            Group(transform: [Translate((0, 0, 1))], placements: [[], [Translate((100, 0, 0))]], objects: [
                Group(placements: [[Scale(2)], [Rotate(axis: (0, 1, 0), degrees: 90)]], objects: [
                    Sphere(center: (0, 0, 0), radius: 1, placements: [[Translate((1, 0, 0))], [Translate((0, 3, 0))]]),
                ]),
                Sphere(center: (0, 0, 0), radius: 1),
            ]),
        ])"#;
        let loaded = scene_format::load_str("s", text, scene_format::Syntax::Ron, std::path::Path::new(""), &[]);
        let desc = loaded.expect("a scene").scene;
        let of = |object: usize| copies(&desc, desc.objects[object].value.placements(), &mut Diagnostics::new());
        let centres: Vec<DVec3> = of(0).iter().map(|map| map.transform_point3(DVec3::ZERO)).collect();
        let inner = [[2.0, 0.0, 1.0], [0.0, 6.0, 1.0], [0.0, 0.0, 0.0], [0.0, 3.0, 1.0]];
        assert_eq!(centres.len(), 8);
        for (k, centre) in centres.iter().enumerate() {
            near(*centre, [inner[k % 4][0] + 100.0 * (k / 4) as f64, inner[k % 4][1], inner[k % 4][2]]);
        }
        assert_eq!(of(1).len(), 2);
    }

    #[test]
    fn about_a_point_and_drop() {
        let steps = [
            Transform::Scale { factor: [3.0, 3.0, -3.0], about: Some(Box::new([0.0; 3])) },
            Transform::DropTo { y: -20.0 },
        ]
        .map(Spanned::from);
        let map = place(&steps, DVec3::ONE, &|m| m.transform_point3(DVec3::new(0.0, -1.0, 0.0)).y);
        near(map.transform_point3(DVec3::new(1.0, -1.0, 1.0)), [3.0, -20.0, -3.0]);
    }
}
