//! Shafts against points of their segments, against slab tests, and large spheres against double precision.

use super::*;
use crate::engine::batch::Batch;
use crate::engine::stages::reach::Slabs;
use crate::engine::stages::spheres::{Ray, large_blocks};
use crate::lanes::ArrayF;
use crate::scene::{LargeSphere, SphereTable};
use tracer_reference::Random;

type One = ArrayF<1>;

fn number(random: &mut Random) -> f32 {
    (random.bits() >> 40) as f32 / (1u32 << 23) as f32 - 1.0
}

fn vector(random: &mut Random, size: f32) -> [f32; 3] {
    std::array::from_fn(|_| number(random) * size)
}

/// A group of up to 64 members near each other, some with coordinates that are the same.
fn group(random: &mut Random, batch: &mut Batch) -> Group {
    let (middle, size) = (vector(random, 1.0), 0.2 * number(random).abs());
    let len = 1 + (random.bits() >> 58) as usize;
    for i in 0..len {
        let offset = vector(random, size);
        for axis in 0..3 {
            let flat = axis == 1 && len.is_multiple_of(3);
            batch.members.start[axis][i] = middle[axis] + if flat { 0.0 } else { offset[axis] };
        }
        batch.members.primitive[i] = NONE;
    }
    batch.members.len = len;
    Group { first: 0, len: len as u32 }
}

/// A group's bounds, without spheres.
fn ends<F: Lanes>(batch: &Batch, group: Group) -> Ends {
    let mut ends = Ends::new();
    ends.bound::<F>(&batch.members, group);
    ends
}

fn boxes(random: &mut Random) -> Boxes<64> {
    let mut boxes = Boxes { planes: [[0.0; 64]; 6], len: 64 };
    for k in 0..64 {
        let (middle, half) = (vector(random, 1.2), vector(random, 0.6));
        for axis in 0..3 {
            boxes.planes[2 * axis][k] = middle[axis] - half[axis].abs();
            boxes.planes[2 * axis + 1][k] = middle[axis] + half[axis].abs();
        }
    }
    boxes
}

fn meets<F: Lanes>(batch: &Batch, group: Group, y: [f32; 3], table: &Table) -> u64 {
    Shaft::new(&ends::<F>(batch, group), y).meets::<F>(table)
}

/// The segment from a member to y: where it starts, which way it goes, how far.
fn segment(batch: &Batch, i: usize, y: [f32; 3]) -> (V3<One>, V3<One>, One) {
    let start = V3::<One>::load(&batch.members.start, i);
    let to = V3::splat(y).sub(start);
    let distance = to.dot(to).max(One::splat(1e-15)).sqrt();
    (start, to.scale(One::splat(1.0) / distance), distance)
}

/// Whatever box a segment passes, the shaft meets; of those that none passes it leaves out most; and so for any number
/// of lanes.
#[test]
fn a_shaft_meets_all_that_its_segments_pass() {
    let mut random = Random::new(5);
    let mut batch = Batch::new();
    let (mut passed, mut missed, mut culled) = (0, 0, 0);
    for round in 0..2000 {
        let group = group(&mut random, &mut batch);
        let boxes = boxes(&mut random);
        let mut table = Table::new();
        table.set_all(&boxes);
        let mut y = vector(&mut random, 1.0);
        if round % 4 == 0 {
            // Among the members, or in the plane of one.
            y = std::array::from_fn(|axis| batch.members.start[axis][0]);
            y[round / 4 % 3] += if round % 8 == 0 { 0.0 } else { 0.5 };
        }
        let met = meets::<One>(&batch, group, y, &table);
        assert_eq!(met, meets::<ArrayF<8>>(&batch, group, y, &table), "eight lanes");
        assert_eq!(met, meets::<ArrayF<16>>(&batch, group, y, &table), "sixteen lanes");
        let mut any = 0;
        for i in 0..group.len as usize {
            let (start, direction, distance) = segment(&batch, i, y);
            let slabs = Slabs::<One>::new(start, direction);
            (0..64).for_each(|k| any |= u64::from(slabs.pass_some(&boxes, 1 << k, distance).any()) << k);
        }
        assert_eq!(any & !met, 0, "round {round}: a segment passes a box that the shaft misses");
        passed += any.count_ones();
        missed += (!any).count_ones();
        culled += (!met).count_ones();
    }
    println!("{passed} boxes passed, {missed} not, of which {culled} are left out");
    assert!(passed > 2000 && f64::from(culled) > 0.9 * f64::from(missed), "{passed} {missed} {culled}");
}

/// Where a coordinate is no number nothing is left out.
#[test]
fn what_is_no_number_leaves_all_boxes() {
    let mut random = Random::new(6);
    let mut batch = Batch::new();
    let group = group(&mut random, &mut batch);
    let mut table = Table::new();
    table.set_all(&boxes(&mut random));
    let far = [50.0, 0.0, 0.0];
    assert_eq!(meets::<ArrayF<8>>(&batch, group, [f32::NAN, 0.0, 0.0], &table), u64::MAX);
    assert_ne!(meets::<ArrayF<8>>(&batch, group, far, &table), u64::MAX);
    batch.members.start[1][group.len as usize - 1] = f32::NAN;
    assert_eq!(meets::<ArrayF<8>>(&batch, group, far, &table), u64::MAX);
}

/// A sphere through a point with a normal there, in f64 and as the scene holds it.
fn large(random: &mut Random) -> (LargeSphere, impl Fn([f32; 3]) -> f64 + use<>) {
    let p = vector(random, 1.0).map(f64::from);
    let n = glam::Vec3::from(vector(random, 1.0)).as_dvec3().normalize();
    let k = 10f64.powf(f64::from(number(random)) * 1.6 - 1.95);
    let center = glam::DVec3::from(p) - n / k;
    let sphere =
        crate::scene::Sphere { center, radius: 1.0 / k, material: 0, object: 0, copy: 0, light: NONE, coordinates: 0 };
    let large = SphereTable::new(&[sphere], 1).large[0];
    let f = move |x: [f32; 3]| {
        let to = glam::Vec3::from(x).as_dvec3() - center;
        k * (to.length() - 1.0 / k) * (to.length() + 1.0 / k)
    };
    (large, f)
}

/// A large sphere that is left out blocks no segment, neither by the test over lanes nor in double precision: members
/// before it, behind it, in it and on it.
#[test]
fn large_spheres_that_are_left_out_block_nothing() {
    let mut random = Random::new(7);
    let mut batch = Batch::new();
    let (mut clear, mut culled) = (0, 0);
    for round in 0..20_000 {
        let group = group(&mut random, &mut batch);
        let (sphere, f) = large(&mut random);
        let on = round % 3 == 0;
        if on {
            (0..group.len as usize).for_each(|i| put_on(&sphere, &mut batch, i));
        }
        let y = vector(&mut random, 1.0);
        let mut ends = ends::<One>(&batch, group);
        (ends.least[0], ends.most[0]) = range::<One>(&sphere, &batch.members, group);
        assert_eq!((ends.least[0], ends.most[0]), range::<ArrayF<8>>(&sphere, &batch.members, group));
        let mut table = LargeTable::new();
        table.push(&sphere);
        let shaft = Shaft::new(&ends, y);
        let left = table.left::<One>(&ends, &shaft, NONE);
        assert_eq!(left, table.left::<ArrayF<8>>(&ends, &shaft, NONE));
        assert_eq!(table.left::<One>(&ends, &shaft, 0), 0, "its own sphere");
        let mut blocked = false;
        for i in 0..group.len as usize {
            let (start, direction, distance) = segment(&batch, i, y);
            let from = <One as Lanes>::U::splat(batch.members.primitive[i]);
            blocked |= large_blocks(&sphere, &Ray::<One>::new(start, direction, from), distance).any();
            let x: [f32; 3] = std::array::from_fn(|axis| batch.members.start[axis][i]);
            if left == 0 && f(y) > 0.0 {
                let along = (1..32).map(|s| s as f32 / 32.0);
                let least = along.map(|s| f(std::array::from_fn(|k| x[k] + s * (y[k] - x[k])))).fold(1.0, f64::min);
                assert!(least > -1e-5, "round {round}: {least} between");
            }
        }
        assert!(left != 0 || !blocked, "round {round}: one that blocks is left out");
        clear += i32::from(!blocked);
        culled += i32::from(left == 0);
    }
    println!("{clear} block nothing, of which {culled} are left out");
    assert!(f64::from(culled) > 0.5 * f64::from(clear), "{clear} {culled}");
}

/// Moves a member onto a sphere, to rounding.
fn put_on(sphere: &LargeSphere, batch: &mut Batch, i: usize) {
    let m = glam::Vec3::from(sphere.m).as_dvec3();
    let (k, c) = (f64::from(sphere.k), f64::from(sphere.c));
    let center = -m / k;
    let radius = (m.length_squared() / (k * k) - c / k).sqrt();
    let x = glam::Vec3::from(std::array::from_fn(|axis| batch.members.start[axis][i])).as_dvec3();
    let on = (center + (x - center).normalize() * radius).as_vec3();
    (0..3).for_each(|axis| batch.members.start[axis][i] = on[axis]);
    batch.members.primitive[i] = sphere.id;
}
