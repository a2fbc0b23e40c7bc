//! Curved shapes in one place: one of them is seen wherever both are, as of triangles in one plane
//! ([`tracer_kernels::bvh`]), and the others are left out, so that rays that leave the one do not meet the other.
//! Disks are told apart by the tree, and what lies in a plane without an end from that; planes are told apart here.

use super::curved::{Curved, equation, is_similar};
use glam::{DAffine3, DMat3, DVec3};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};
use tracer_kernels::scene::Material;
use tracer_kernels::scene::materials::BxdfFlags;
use tracer_kernels::shapes::UnitShape;

/// Where a copy is, to the last bit of single precision.
fn place(object: &Curved, map: &DAffine3) -> [u32; 12] {
    // How a ball is turned does not show, but in a pattern; that of the one that is seen does.
    let ball = object.unit == UnitShape::Sphere && is_similar(map);
    let size = DMat3::from_diagonal(DVec3::splat(map.matrix3.x_axis.length()));
    let matrix3 = if ball { size } else { map.matrix3 };
    // Zeros of either sign are one place.
    DAffine3 { matrix3, ..*map }.to_cols_array().map(|x| (x as f32 + 0.0).to_bits())
}

/// Planes that are so near to each other where the camera looks, in parts of the view's size, are one: rays start off
/// them in single precision.
const NEAR: f64 = 1.0 / 4_194_304.0;
/// No more planes than this are held against each other.
const MOST_PLANES: usize = 1000;

/// Planes that are seen, each by its normal and a point near what the camera looks at.
struct Planes {
    eye: DVec3,
    look_at: DVec3,
    taken: Vec<(DVec3, DVec3)>,
}

impl Planes {
    /// Whether a plane is not in the place of another; it is taken then.
    fn is_free(&mut self, map: &DAffine3) -> bool {
        let (normal, point) = equation(map, self.look_at);
        let size = self.eye.distance(self.look_at) + point.distance(self.look_at) + point.abs().max_element();
        let is_same = |(other, there): &(DVec3, DVec3)| {
            normal.cross(*other).length() <= NEAR && normal.dot(point - *there).abs() <= NEAR * size
        };
        let free = !self.taken.iter().any(is_same);
        if free && self.taken.len() < MOST_PLANES {
            self.taken.push((normal, point));
        }
        free
    }
}

/// Who is seen: what the camera sees, of this what shines, then what lets no light through, then what comes first.
fn rank(desc: &SceneDesc, object: &Curved, materials: &[Material]) -> (bool, u32) {
    let hidden = desc.objects.get(object.number as usize).is_some_and(|written| !written.value.camera_visible());
    let transmits =
        |index: u32| materials.get(index as usize).is_some_and(|m| m.traits().flags.has(BxdfFlags::TRANSMISSION));
    let of_material = match object.emissive {
        Some(_) => 0,
        None => 1 + u32::from(transmits(object.material)),
    };
    (hidden, of_material)
}

/// The copies that are in the place of an earlier one of the same shape, as (turn, copy), rising; `order`: who has the
/// first turn. Sixteen bytes a copy: there may be millions, hardly ever two in one place.
fn covered(curved: &[Curved], order: &[usize]) -> Vec<(u32, u32)> {
    let hash = |place: [u32; 12]| {
        // FNV-1a, word by word; what it takes for one is looked at.
        place.iter().fold(0xcbf2_9ce4_8422_2325u64, |h, x| (h ^ u64::from(*x)).wrapping_mul(0x0100_0000_01b3))
    };
    let of = |turn: u32, copy: u32| {
        let object = &curved[order[turn as usize]];
        (place(object, &object.maps[copy as usize]), object.unit)
    };
    let bounded = (0u32..).zip(order).filter(|&(_, &k)| !curved[k].is_endless());
    let copies = bounded.flat_map(|(turn, &k)| (0..curved[k].maps.len() as u32).map(move |copy| (turn, copy)));
    let mut all: Vec<(u64, u32, u32)> = copies.map(|(turn, copy)| (hash(of(turn, copy).0), turn, copy)).collect();
    all.sort_unstable();
    let mut covered = Vec::new();
    for alike in all.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > 1) {
        let mut seen: Vec<([u32; 12], UnitShape)> = Vec::new();
        for &(_, turn, copy) in alike {
            let this = of(turn, copy);
            if seen.contains(&this) {
                covered.push((turn, copy));
            } else {
                seen.push(this);
            }
        }
    }
    covered.sort_unstable();
    covered
}

/// Leaves out the copies that are in the place of others, and warns of them but for those that were told.
pub fn leave_out(
    desc: &SceneDesc,
    curved: &mut [Curved],
    (materials, told): (&[Material], &BTreeSet<Span>),
    diagnostics: &mut Diagnostics,
) {
    let mut order: Vec<usize> =
        (0..curved.len()).filter(|&k| !matches!(curved[k].unit, UnitShape::Disk { .. })).collect();
    order.sort_by_key(|&k| rank(desc, &curved[k], materials));
    let [eye, look_at] = [&desc.camera.position, &desc.camera.look_at].map(|point| DVec3::from(point.value));
    let mut planes = Planes { eye, look_at, taken: Vec::new() };
    let mut left_out: BTreeMap<Span, usize> = BTreeMap::new();
    let mut covered = covered(curved, &order).into_iter().peekable();
    for (turn, k) in order.into_iter().enumerate() {
        let endless = curved[k].is_endless();
        let before = curved[k].maps.len();
        let mut copy = 0;
        curved[k].maps.retain(|map| {
            let is_covered = covered.next_if_eq(&(turn as u32, copy)).is_some();
            copy += 1;
            if endless { planes.is_free(map) } else { !is_covered }
        });
        let lost = before - curved[k].maps.len();
        if lost > 0 {
            let span = desc.objects.get(curved[k].number as usize).map_or(Span::NONE, |object| object.span);
            *left_out.entry(span).or_default() += lost;
        }
    }
    for (span, count) in left_out.into_iter().filter(|(span, _)| !told.contains(span)) {
        let message = match count {
            1 => "this shape lies in one place with another: one of the two is seen".to_owned(),
            _ => format!("{count} copies of this shape lie in one place with others: one of them is seen"),
        };
        diagnostics.push(
            Diagnostic::warning(codes::IN_ONE_PLACE, span, message)
                .hint("give them places of their own; in a `Repeat` by its index: `center: \"=(2 * i, 0, 0)\"`"),
        );
    }
}
