//! Transforms of the scene language as matrices.

use super::assets::Sources;
use super::patterns;
use super::settled::Settled;
use glam::{DAffine3, DMat3, DVec3};
use scene_format::desc::{Copies, Extent, Moved, Object, Placements, Transform};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use smallvec::SmallVec;
use tracer_mesh::placements::rotation;

/// What steps ask of what they move.
pub struct Subject<'a> {
    /// What it is called.
    pub noun: &'a str,
    /// From its own frame to the one that it is written in.
    pub local: DAffine3,
    /// The fixed point of steps that name none, where it is written, which goes with what is moved; `None`: the origin,
    /// which stays where it is.
    pub middle: Option<DVec3>,
    /// How far it reaches where a map puts what is written.
    pub reach: Reach<'a>,
}

/// How far a thing reaches along an axis of the world (0, 1 or 2) under a map, from and to.
pub type Reach<'a> = &'a dyn Fn(&DAffine3, usize) -> [f64; 2];

impl Subject<'_> {
    /// A thing that is not known, since something else is wrong with it, of which no fault is told; or of which nothing
    /// is asked.
    pub fn unknown(noun: &str) -> Subject<'_> {
        Subject { noun, local: DAffine3::IDENTITY, middle: None, reach: &|_, _| [0.0, 1.0] }
    }

    /// The same under a map: what placements move.
    pub fn under<T>(&self, map: &DAffine3, then: impl FnOnce(&Subject<'_>) -> T) -> T {
        let reach = |placement: &DAffine3, axis: usize| (self.reach)(&(*placement * *map), axis);
        then(&Subject { noun: self.noun, local: DAffine3::IDENTITY, middle: None, reach: &reach })
    }
}

/// What places are read of.
#[derive(Clone, Copy)]
pub struct Given<'a> {
    pub desc: &'a SceneDesc,
    pub sources: &'a Sources<'a>,
    pub settled: &'a Settled,
}

/// From an object's own frame to the world, one per copy. Of millions most have one: those need no memory of their own,
/// which would stay with the program when it is given back piece by piece.
pub type Maps = SmallVec<[DAffine3; 1]>;

/// From an object's own frame to the world: its transforms and, after them, each copy's.
pub fn place_all(
    given: Given<'_>,
    transforms: &[Spanned<Transform>],
    placements: &Placements,
    subject: &Subject<'_>,
    diagnostics: &mut Diagnostics,
) -> Maps {
    let map = place(transforms, subject, diagnostics);
    if matches!(placements, Placements::One) {
        return Maps::from_buf([DAffine3::IDENTITY * (map * subject.local)]);
    }
    let copies = subject.under(&map, |moved| copies(given, placements, None, moved, diagnostics));
    let map = map * subject.local;
    let mut maps: Vec<DAffine3> = copies.into_iter().map(|copy| copy * map).collect();
    // A list of one that has room for more would not be kept without memory of its own.
    maps.shrink_to_fit();
    Maps::from_vec(maps)
}

/// From where an object of a group is written to the group, before that moves it, one map for each of its copies there.
pub fn place_in(
    given: Given<'_>,
    object: &Object,
    group: &Moved,
    subject: &Subject<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<DAffine3> {
    let map = place(object.transform(), subject, diagnostics);
    let placements = object.placements();
    let copies = subject.under(&map, |moved| copies(given, placements, Some(group), moved, diagnostics));
    copies.into_iter().map(|copy| copy * map).collect()
}

/// Applies the transforms first to last. A step that cannot be done is left out, and told.
pub fn place(transforms: &[Spanned<Transform>], subject: &Subject<'_>, diagnostics: &mut Diagnostics) -> DAffine3 {
    let mut map = DAffine3::IDENTITY;
    for transform in transforms {
        let here = |about: &Option<Box<[f64; 3]>>, map: &DAffine3| {
            let middle = || subject.middle.map_or(DVec3::ZERO, |middle| map.transform_point3(middle));
            about.as_deref().map_or_else(middle, |about| DVec3::from(*about))
        };
        let step = match &transform.value {
            Transform::Translate(by) => Ok(DAffine3::from_translation(DVec3::from(*by))),
            Transform::Scale { factor, about } => {
                Ok(about_point(DMat3::from_diagonal(DVec3::from(*factor)), here(about, &map)))
            }
            Transform::Rotate { axis, degrees, about } => {
                Ok(about_point(rotation(DVec3::from(*axis), *degrees), here(about, &map)))
            }
            Transform::DropTo { y } => {
                Ok(DAffine3::from_translation(DVec3::new(0.0, y - (subject.reach)(&map, 1)[0], 0.0)))
            }
            Transform::CenterTo { point } => {
                let middle = [0, 1, 2].map(|axis| {
                    let [low, high] = (subject.reach)(&map, axis);
                    0.5 * (low + high)
                });
                Ok(DAffine3::from_translation(DVec3::from(*point) - DVec3::from(middle)))
            }
            Transform::Matrix { rows } => Ok(of_rows(rows)),
            Transform::Align { from, to, about } => {
                Ok(about_point(alignment(DVec3::from(**from), DVec3::from(**to)), here(about, &map)))
            }
            Transform::FitTo { extent, length, about } => {
                let factor = fit(*extent, *length, subject.noun, transform.span, &|axis| (subject.reach)(&map, axis));
                factor.map(|factor| about_point(DMat3::from_diagonal(DVec3::splat(factor)), here(about, &map)))
            }
        };
        match step {
            Ok(step) => map = step * map,
            // A million copies have one fault.
            Err(fault) if diagnostics.last() == Some(&*fault) => {}
            Err(fault) => diagnostics.push(*fault),
        }
    }
    map
}

/// Rows of four numbers, the last of which moves.
fn of_rows(rows: &[[f64; 4]; 3]) -> DAffine3 {
    let [[a, b, c, x], [d, e, f, y], [g, h, i, z]] = *rows;
    DAffine3 { matrix3: DMat3::from_cols_array(&[a, d, g, b, e, h, c, f, i]), translation: DVec3::new(x, y, z) }
}

/// The least rotation from one direction to another, of any length but zero. Where they are opposite it is half a turn
/// about the first one's right ([`sides`]).
fn alignment(from: DVec3, to: DVec3) -> DMat3 {
    let unit = |n: DVec3| (n / n.abs().max_element()).normalize();
    let (from, to) = (unit(from), unit(to));
    let (across, cosine) = (from.cross(to), from.dot(to));
    if cosine > -0.5 {
        // Rodrigues' formula, where the axis is not needed.
        let outer = DMat3::from_cols(across * across.x, across * across.y, across * across.z) * (1.0 / (1.0 + cosine));
        let turned =
            DMat3::from_cols_array(&[0.0, across.z, -across.y, -across.z, 0.0, across.x, across.y, -across.x, 0.0]);
        return DMat3::from_diagonal(DVec3::splat(cosine)) + turned + outer;
    }
    // Near to half a turn: the axis, and what is across it and either direction.
    let axis = if across.length() > 1e-14 { across.normalize() } else { sides(from)[0] };
    let axis = (axis - from * axis.dot(from)).normalize();
    let frame = |n: DVec3| DMat3::from_cols(n, axis, n.cross(axis).normalize());
    let to = (to - axis * axis.dot(to)).normalize();
    frame(to) * frame(from).transpose()
}

/// The factor by which a thing with this reach along each axis comes to an extent.
fn fit(
    extent: Extent,
    length: f64,
    noun: &str,
    at: Span,
    reach: &dyn Fn(usize) -> [f64; 2],
) -> Result<f64, Box<Diagnostic>> {
    let (mut extents, mut largest) = ([0.0; 3], 0.0_f64);
    for (axis, extent) in extents.iter_mut().enumerate() {
        let [low, high] = reach(axis);
        *extent = high - low;
        largest = largest.max(low.abs()).max(high.abs());
    }
    let (found, name, along) = match extent {
        Extent::Height => (extents[1], "height", "along y"),
        Extent::Width => (extents[0], "width", "along x"),
        Extent::Depth => (extents[2], "depth", "along z"),
        Extent::Size => (extents[0].max(extents[1]).max(extents[2]), "size", "along any axis"),
    };
    // What is flat is so but for rounding.
    if found > 1e-12 * largest {
        return Ok(length / found);
    }
    let fault = Diagnostic::error(codes::NO_EXTENT, at, format!("the {noun} has no {name} that could be fitted"))
        .expected(format!("an extent of more than zero {along}"));
    Err(Box::new(match extent {
        Extent::Size => fault,
        _ => fault.hint("fit another of `height`, `width`, `depth` and `size`, or turn it before"),
    }))
}

/// A linear map with this fixed point.
fn about_point(matrix: DMat3, point: DVec3) -> DAffine3 {
    DAffine3 { matrix3: matrix, translation: point - matrix * point }
}

/// Copies of one object, at most, those of the groups around it counted.
const MOST_COPIES: u64 = 100_000_000;

/// The maps of the copies: in the world, or in `group`. A fault of a group is told once, whatever stands in it.
pub fn copies(
    given: Given<'_>,
    placements: &Placements,
    group: Option<&Moved>,
    subject: &Subject<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<DAffine3> {
    match placements.copies() {
        None => vec![DAffine3::IDENTITY],
        Some(Copies::List(list)) => list.iter().map(|steps| place(steps, subject, diagnostics)).collect(),
        Some(Copies::File(file)) => match given.sources.placements(&given.desc.base_dir.join(&file.value)) {
            Ok(maps) => maps,
            Err(error) => {
                diagnostics.push(error.to_diagnostic(file.span));
                Vec::new()
            }
        },
        Some(Copies::Pattern(pattern)) => patterns::maps(pattern, diagnostics),
        Some(Copies::Within(within)) => {
            let mut maps = copies(given, &within.own, None, subject, diagnostics);
            let mut found = Diagnostics::new();
            let inner = |outer: &&Moved| group.is_none_or(|group| !std::ptr::eq(*outer, group));
            for group in within.groups.outwards().into_iter().take_while(inner) {
                let unasked;
                let (step, around) = match given.settled.of(group) {
                    Some(settled) => settled,
                    // It asks nothing, or something else is wrong with what stands in it.
                    None => {
                        let of_group = Subject::unknown("group");
                        let step = place(&group.transform, &of_group, &mut found);
                        unasked = (step, copies(given, &group.placements, None, &of_group, &mut found));
                        &unasked
                    }
                };
                if maps.len() as u64 * around.len() as u64 > MOST_COPIES {
                    let at = group.placements.files().first().map_or(Span::NONE, |file| file.span);
                    let message = format!("groups make more than {MOST_COPIES} copies of an object");
                    found.push(Diagnostic::error(codes::TOO_MUCH, at, message).expected("fewer copies"));
                    maps.clear();
                    break;
                }
                let outer = around.iter().map(|outer| *outer * *step);
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
    use super::super::assets::DISK;
    use super::*;

    /// Without groups that ask how far they reach.
    fn given(desc: &SceneDesc) -> Given<'_> {
        Given { desc, sources: &DISK, settled: Box::leak(Box::default()) }
    }

    fn near(a: DVec3, b: [f64; 3]) {
        assert!((a - DVec3::from(b)).length() < 1e-12, "{a} {b:?}");
    }

    #[test]
    fn rotation_by_the_right_hand_rule() {
        near(rotation(DVec3::Y, 90.0) * DVec3::Z, [1.0, 0.0, 0.0]);
        near(rotation(DVec3::Z * 2.0, 90.0) * DVec3::X, [0.0, 1.0, 0.0]);
        near(rotation(DVec3::ONE, 120.0) * DVec3::X, [0.0, 1.0, 0.0]);
    }

    /// Where steps put a thing whose lowest point is at (0, -1, 0).
    fn placed(steps: &[Spanned<Transform>], middle: DVec3) -> DAffine3 {
        let low = |map: &DAffine3, axis: usize| {
            let y = map.transform_point3(DVec3::new(0.0, -1.0, 0.0))[axis];
            [y, y + 1.0]
        };
        let mut found = Diagnostics::new();
        let map = place(
            steps,
            &Subject { noun: "cube", local: DAffine3::IDENTITY, middle: Some(middle), reach: &low },
            &mut found,
        );
        assert!(found.is_empty(), "{found:?}");
        map
    }

    #[test]
    fn scale_and_rotate_act_about_the_barycentre_which_moves_along() {
        let steps = [
            Transform::Translate([10.0, 0.0, 0.0]),
            Transform::Scale { factor: [2.0; 3], about: None },
            Transform::Rotate { axis: [0.0, 0.0, 1.0], degrees: 90.0, about: None },
        ]
        .map(Spanned::from);
        let map = placed(&steps, DVec3::new(1.0, 0.0, 0.0));
        near(map.transform_point3(DVec3::new(1.0, 0.0, 0.0)), [11.0, 0.0, 0.0]);
        near(map.transform_point3(DVec3::new(2.0, 0.0, 0.0)), [11.0, 2.0, 0.0]);
    }

    /// In `placements`, and of groups, steps that name no point are about the origin, wherever a move has brought the
    /// thing.
    #[test]
    fn placements_and_groups_are_about_the_origin() {
        let text = r#"Scene(background: 1, objects: [
            Sphere(center: (0, 0, 0), radius: 1, placements: [
                [Translate((1, 0, 0)), Rotate(axis: (0, 0, 1), degrees: 90)],
                [Translate((1, 0, 0)), Scale(0.5)],
                [Translate((1, 0, 0)), Rotate(axis: (0, 0, 1), degrees: 90, about: (1, 0, 0))],
            ]),
            Group(transform: [Translate((1, 0, 0)), Rotate(axis: (0, 0, 1), degrees: 90)], objects: [
                Sphere(center: (0, 0, 0), radius: 1),
            ]),
        ])"#;
        let loaded = scene_format::load_str("s", text, scene_format::Syntax::Ron, std::path::Path::new(""), &[]);
        let desc = loaded.expect("a scene").scene;
        let centres = |object: usize| -> Vec<DVec3> {
            let placements = desc.objects[object].value.placements();
            let subject = Subject::unknown("sphere");
            let maps = place_all(given(&desc), &[], placements, &subject, &mut Diagnostics::new());
            maps.iter().map(|map| map.transform_point3(DVec3::ZERO)).collect()
        };
        let of = centres(0);
        assert_eq!((of.len(), centres(1).len()), (3, 1));
        near(of[0], [0.0, 1.0, 0.0]);
        near(of[1], [0.5, 0.0, 0.0]);
        near(of[2], [1.0, 0.0, 0.0]);
        near(centres(1)[0], [0.0, 1.0, 0.0]);
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
        let of = |object: usize| {
            let placements = desc.objects[object].value.placements();
            place_all(given(&desc), &[], placements, &Subject::unknown("sphere"), &mut Diagnostics::new())
        };
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
        let map = placed(&steps, DVec3::ONE);
        near(map.transform_point3(DVec3::new(1.0, -1.0, 1.0)), [3.0, -20.0, -3.0]);
    }

    /// Rows are rows, whatever came before.
    #[test]
    fn a_matrix_takes_points_by_its_rows() {
        let rows = Box::new([[1.0, 2.0, 3.0, 10.0], [4.0, 5.0, 6.0, 20.0], [7.0, 8.0, 10.0, 30.0]]);
        let steps = [Transform::Translate([1.0, 0.0, 0.0]), Transform::Matrix { rows }].map(Spanned::from);
        let map = placed(&steps, DVec3::ONE);
        near(map.transform_point3(DVec3::new(0.0, 1.0, -1.0)), [10.0 + 1.0 + 2.0 - 3.0, 20.0 + 3.0, 30.0 + 5.0]);
    }

    #[test]
    fn alignments_are_the_least_rotations() {
        let mut random = 1u64;
        let mut unit = || loop {
            let p = DVec3::from_array([(); 3].map(|()| {
                random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (random >> 11) as f64 / (1u64 << 52) as f64 - 1.0
            }));
            if p.length() > 0.1 && p.length() < 1.0 {
                break p.normalize();
            }
        };
        for k in 0..2000 {
            let from = unit();
            // All angles, those near 0 and 180 degrees among them.
            let other = unit();
            let to = match k % 4 {
                0 => other,
                1 => (from + other * libm::pow(10.0, f64::from(-(k % 17)))).normalize(),
                2 => (other * libm::pow(10.0, f64::from(-(k % 17))) - from).normalize(),
                _ => -from,
            };
            let turn = alignment(from * libm::pow(10.0, f64::from(k % 25 - 12)), to * 3.0);
            assert!((turn * from - to).length() < 1e-14, "{from} {to}");
            let product = turn * turn.transpose() - DMat3::IDENTITY;
            assert!(product.to_cols_array().iter().all(|x| x.abs() < 1e-14), "{from} {to}: {turn}");
            assert!((turn.determinant() - 1.0).abs() < 1e-14);
            // The trace tells the angle: no more than that between the two.
            let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
            assert!((trace - (1.0 + 2.0 * from.dot(to))).abs() < 1e-14, "{from} {to}");
        }
        // Half a turn about x; nothing at all.
        near(alignment(DVec3::Y, DVec3::NEG_Y) * DVec3::X, [1.0, 0.0, 0.0]);
        near(alignment(DVec3::Z, DVec3::NEG_Z) * DVec3::X, [1.0, 0.0, 0.0]);
        near(alignment(DVec3::X, DVec3::NEG_X) * DVec3::Z, [0.0, 0.0, 1.0]);
        assert_eq!(alignment(DVec3::Y, DVec3::Y * 5.0), DMat3::IDENTITY);
    }

    /// A cube from (-1, -1, -1) to (1, 1, 1).
    fn cube(map: &DAffine3, axis: usize) -> [f64; 2] {
        let rows = map.matrix3.row(axis).abs();
        let reach = rows.x + rows.y + rows.z;
        [map.translation[axis] - reach, map.translation[axis] + reach]
    }

    #[test]
    fn things_are_fitted_to_an_extent_of_the_world() {
        let stretched = Transform::Scale { factor: [1.0, 2.0, -3.0], about: None };
        let turned = Transform::Rotate { axis: [0.0, 1.0, 0.0], degrees: 90.0, about: None };
        let fitted = |extent, about: Option<[f64; 3]>| {
            let fit = Transform::FitTo { extent, length: 12.0, about: about.map(Box::new) };
            let steps = [Transform::Translate([5.0, 0.0, 0.0]), stretched.clone(), turned.clone(), fit];
            let subject = Subject { noun: "cube", local: DAffine3::IDENTITY, middle: Some(DVec3::ZERO), reach: &cube };
            let mut found = Diagnostics::new();
            let map = place(&steps.map(Spanned::from), &subject, &mut found);
            assert!(found.is_empty(), "{found:?}");
            ([0, 1, 2].map(|axis| cube(&map, axis)), map.translation)
        };
        for (extent, axis, factor) in
            [(Extent::Width, 0, 2.0), (Extent::Height, 1, 3.0), (Extent::Depth, 2, 6.0), (Extent::Size, 0, 2.0)]
        {
            let (reach, middle) = fitted(extent, None);
            assert!((reach[axis][1] - reach[axis][0] - 12.0).abs() < 1e-12);
            near(middle, [5.0, 0.0, 0.0]);
            near(fitted(extent, Some([0.0; 3])).1, [5.0 * factor, 0.0, 0.0]);
        }
    }

    #[test]
    fn what_has_no_extent_cannot_be_fitted() {
        let flat = |map: &DAffine3, axis: usize| {
            let rows = map.matrix3.row(axis).abs();
            [map.translation[axis] - rows.x - rows.z, map.translation[axis] + rows.x + rows.z]
        };
        let subject = Subject { noun: "rectangle", local: DAffine3::IDENTITY, middle: Some(DVec3::ZERO), reach: &flat };
        let fit = |extent| Transform::FitTo { extent, length: 1.0, about: None };
        let turn = Transform::Rotate { axis: [1.0, 0.3, 0.0], degrees: 90.0, about: None };
        let back = Transform::Rotate { axis: [1.0, 0.3, 0.0], degrees: -90.0, about: None };
        let faults = |steps: Vec<Transform>, subject: &Subject<'_>| {
            let steps: Vec<_> = steps.into_iter().map(Spanned::from).collect();
            let mut found = Diagnostics::new();
            place(&steps, subject, &mut found);
            found.iter().map(|fault| (fault.code, fault.message.clone())).collect::<Vec<_>>()
        };
        let told = vec![(codes::NO_EXTENT, "the rectangle has no height that could be fitted".to_owned())];
        assert_eq!(faults(vec![fit(Extent::Height)], &subject), told);
        let far = Transform::Translate([1e9, 1e9, 0.0]);
        assert_eq!(faults(vec![far, turn.clone(), back, fit(Extent::Height)], &subject), told);
        assert!(faults(vec![turn, fit(Extent::Height), fit(Extent::Size)], &subject).is_empty());
    }

    /// By what it reaches where the steps before have put it, whatever its fixed point is.
    #[test]
    fn things_are_centred_by_their_bounds_in_the_world() {
        // A wedge of four corners, far away: its middle is none of them, and not their mean.
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]].map(DVec3::from);
        let far = DVec3::new(3e5, -5e6, 4e4);
        let reach = |map: &DAffine3, axis: usize| {
            let along = corners.map(|corner| map.transform_point3(far + corner)[axis]);
            along.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(*x), high.max(*x)])
        };
        let turn = Transform::Rotate { axis: [0.3, 1.0, -0.2], degrees: 50.0, about: None };
        let centre = |point| Transform::CenterTo { point };
        let fit = Transform::FitTo { extent: Extent::Size, length: 2.0, about: None };
        let subject = Subject { noun: "mesh", local: DAffine3::IDENTITY, middle: Some(far), reach: &reach };
        for (steps, point) in [
            (vec![centre([1.0, 2.0, 3.0])], [1.0, 2.0, 3.0]),
            (vec![turn.clone(), centre([1.0, 2.0, 3.0])], [1.0, 2.0, 3.0]),
            (vec![turn.clone(), fit.clone(), centre([-1.0, 0.5, 0.0])], [-1.0, 0.5, 0.0]),
            // What comes after moves it on, also from one middle to another.
            (vec![centre([9.0; 3]), Transform::Translate([0.0, 1.0, 0.0])], [9.0, 10.0, 9.0]),
            (vec![centre([9.0; 3]), centre([0.0; 3])], [0.0; 3]),
        ] {
            let steps: Vec<_> = steps.into_iter().map(Spanned::from).collect();
            let mut found = Diagnostics::new();
            let map = place(&steps, &subject, &mut found);
            assert!(found.is_empty(), "{found:?}");
            let middle = [0, 1, 2].map(|axis| reach(&map, axis)).map(|[low, high]| 0.5 * (low + high));
            assert!((DVec3::from(middle) - DVec3::from(point)).length() < 1e-8, "{steps:?}: {middle:?}");
            let before = place(&steps[..steps.len() - 1], &subject, &mut found);
            assert_eq!(map.matrix3, before.matrix3);
        }
    }

    /// Copies are dropped, fitted and centred where their own steps have put them.
    #[test]
    fn copies_are_dropped_fitted_and_centred_one_by_one() {
        let steps = [
            vec![Transform::Translate([0.0, 7.0, 0.0]), Transform::DropTo { y: 1.0 }],
            vec![Transform::FitTo { extent: Extent::Height, length: 8.0, about: None }],
            vec![Transform::Translate([0.0, 7.0, 0.0]), Transform::CenterTo { point: [5.0, 3.0, 0.0] }],
        ];
        let list = steps.into_iter().map(|steps| steps.into_iter().map(Spanned::from).collect::<Vec<_>>());
        let placements = list.collect();
        let own = [Transform::Scale { factor: [1.0, 2.0, 1.0], about: None }].map(Spanned::from);
        let subject = Subject { noun: "cube", local: DAffine3::IDENTITY, middle: Some(DVec3::ZERO), reach: &cube };
        let desc = scene_format::load_str(
            "s",
            "Scene(objects: [Box(size: 1)])",
            scene_format::Syntax::Ron,
            std::path::Path::new(""),
            &[],
        );
        let maps =
            place_all(given(&desc.expect("a scene").scene), &own, &placements, &subject, &mut Diagnostics::new());
        assert_eq!(maps.iter().map(|map| cube(map, 1)).collect::<Vec<_>>(), [[1.0, 5.0], [-4.0, 4.0], [1.0, 5.0]]);
        near(maps[2].translation, [5.0, 3.0, 0.0]);
    }
}
