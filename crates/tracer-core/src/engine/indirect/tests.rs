//! The map knows the mean of what it was told, where it may know it.

use super::*;

const UP: [f32; 3] = [0.0, 1.0, 0.0];

/// A number in 0 .. 1.
fn unit(k: u32, what: u32) -> f32 {
    (hash3(k, what, 0x7e57) >> 40) as f32 / (1u32 << 24) as f32
}

/// So many records on a square of 0.4 around the origin, from far away; their light is their number.
fn records(count: u32) -> Vec<Record> {
    let place = |k, axis| 0.4 * (unit(k, axis) - 0.5);
    let record = |k| Record {
        point: [place(k, 0), 0.0, place(k, 1)],
        normal: UP,
        light: [k as f32, 1.0, 0.0],
        vertex: 1,
        distance: 100.0,
    };
    (0..count).map(record).collect()
}

/// Where the records lie nearly every one of them is answered, by a mean of [`LEAST`] or more around it; together the answers keep the sum, for
/// each cell gives to those that ask it what they have brought.
#[test]
fn the_sum_is_kept() {
    let mut records = records(4096);
    for (k, record) in records.iter_mut().enumerate() {
        // From far and from near, with more light where they lie dense and come from afar.
        record.distance = [1e-3, 0.02, 0.2, 2.0][k % 4];
        record.light[0] += 3000.0 * record.distance;
    }
    let map = IndirectMap::new(3, &records);
    let (mut asked, mut known, mut brought) = (0, 0.0, 0.0);
    for record in &records {
        let Some(light) = map.find(record.point, UP, 1, record.distance) else { continue };
        assert!((light[1] - 1.0).abs() < 1e-6 && light[2] == 0.0);
        asked += 1;
        known += f64::from(light[0]);
        brought += f64::from(record.light[0]);
    }
    assert!((2000..4096).contains(&asked), "{asked}");
    assert!((known / brought - 1.0).abs() < 1e-6, "{}", known / brought);
}

/// Nothing is known of other sides, other vertices, places without records or beyond the grid; nor for those that come from near.
#[test]
fn what_it_does_not_know() {
    let map = IndirectMap::new(0, &records(4096));
    let find = |point, normal, vertex, distance| map.find(point, normal, vertex, distance).is_some();
    assert!(find([0.0; 3], UP, 1, 1.0));
    assert!(find([0.0; 3], [0.6, 0.7, 0.3], 1, 1.0), "the same side of six");
    assert!(!find([0.0; 3], [0.0, -1.0, 0.0], 1, 1.0));
    assert!(!find([0.0; 3], [0.8, 0.5, 0.3], 1, 1.0));
    assert!(!find([0.0; 3], UP, 2, 1.0));
    assert!(!find([5.0, 0.0, 0.0], UP, 1, 1.0));
    for far in [1e4, -1e4, 1e30, f32::INFINITY, f32::NAN] {
        assert!(!find([far, 0.0, 0.0], UP, 1, 1.0), "{far}");
    }
    assert!(!find([0.0; 3], UP, 1, 0.001));
    let few = IndirectMap::new(0, &records(ENOUGH as u32 - 1));
    assert!(few.find([0.0; 3], UP, 1, 1.0).is_none());
    assert!(IndirectMap::new(0, &[]).find([0.0; 3], UP, 1, 1.0).is_none());
}

/// Those that come from far ask for the light of those that come from far: here they have 1, the others 0.
#[test]
fn from_far_and_from_near() {
    let mut records = records(4096);
    for (k, record) in records.iter_mut().enumerate() {
        let far = k % 2 == 0;
        record.distance = if far { 10.0 } else { 1e-3 };
        record.light = [if far { 1.0 } else { 0.0 }; 3];
    }
    let map = IndirectMap::new(0, &records);
    assert_eq!(map.find([0.0; 3], UP, 1, 10.0), Some([1.0; 3]));
    assert_eq!(map.find([0.0; 3], UP, 1, 1e-3), None);
}

/// Cells are asked from ever farther: the bias goes.
#[test]
fn the_reach_grows_without_end() {
    assert_eq!(reach(0), 1.0);
    assert!((reach(63) - 2.0).abs() < 1e-6);
    assert!((0..10_000).all(|number| reach(number) < reach(number + 1)));
}

/// All cells of a vertex have keys of their own, none of them 0.
#[test]
fn keys_are_unique() {
    let mut keys = Vec::new();
    let end = (1 << BITS) - 1;
    for level in 0..LEVELS {
        let step = 1 << (LEVELS - 1 - level);
        for side in 0..6 {
            for [x, y, z] in [[0, 0, 0], [step, 0, 0], [0, step, 0], [0, 0, step], [end, end, end], [end, 0, end]] {
                keys.push(key_of([x, y, z], side, 0, level));
            }
        }
    }
    let count = keys.len();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), count);
    assert!(keys[0] > 0);
}

/// Items of all sizes of pictures lie within them, each once.
#[test]
fn items_lie_in_the_picture() {
    for [width, height] in [[1, 1], [16, 16], [37, 21], [300, 200], [4000, 3000]] {
        let tiles = [width, height].map(|x: u32| x.div_ceil(TILE));
        for number in 0..5 {
            let items = items([width, height], 7, number, MOST_ITEMS);
            let all = u64::from(tiles[0] * tiles[1] * QUARTERS);
            let least = (1024 / BLOCK_PIXELS as u64).min(all);
            assert!((least..=32768 / BLOCK_PIXELS as u64).contains(&(items.len() as u64)), "{}", items.len());
            let mut seen = std::collections::BTreeSet::new();
            for item in items {
                assert!((0..width as i32).contains(&item.x) && (0..height as i32).contains(&item.y));
                assert!(item.quarter < QUARTERS && item.sample == number);
                assert!(seen.insert((item.x, item.y, item.quarter)));
            }
        }
    }
}

/// A trial has one item from each of sixteen equal shares of the picture, anywhere in it: not one column of tiles, which are a power of two here.
#[test]
fn trials_see_the_whole_picture() {
    let items = items([512, 512], 7, u32::MAX, ITEMS as u64);
    assert_eq!(items.len(), ITEMS);
    let columns: std::collections::BTreeSet<i32> = items.iter().map(|item| item.x).collect();
    let rows: std::collections::BTreeSet<i32> = items.iter().map(|item| item.y).collect();
    assert!(columns.len() >= 8 && rows.len() == 16, "{columns:?} {rows:?}");
}
