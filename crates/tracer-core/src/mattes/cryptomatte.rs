//! Cryptomatte (Friedman and Jones, 2015), after its published specification 1.2.0: pairs of a name's number and of
//! what it covers of the pixel, most first, two pairs in each of the layers `CryptoObject00`, `CryptoObject01`, `..02`;
//! and what the numbers mean, in the file's attributes.

use super::hash::{id, murmur3};
use super::{MatteImage, of_pixels};
use crate::film::{Film, MatteOf};
use std::collections::BTreeMap;

/// Layers of four channels, two pairs each.
const LAYERS: usize = 3;
/// Pairs that a pixel has.
const RANKS: usize = 2 * LAYERS;
/// Channels of all layers.
pub const CHANNELS: usize = 4 * LAYERS;

/// What the layers' names begin with.
pub fn name(of: MatteOf) -> &'static str {
    match of {
        MatteOf::Objects => "CryptoObject",
        MatteOf::Materials => "CryptoMaterial",
    }
}

/// What is in one pixel: numbers and what they cover.
type Ranks = [(f32, f32); RANKS];

/// Adds the layers that tell this apart to a picture's channels and attributes. `names`: of its numbers, the first of
/// which is 1.
pub fn cryptomatte(film: &Film, of: MatteOf, names: &[String], image: &mut MatteImage) {
    let name = name(of);
    let ids: Vec<f32> = names.iter().map(|name| id(name)).collect();
    let ranks = of_pixels(film, |x, y| ranks(&film.matte(of, x, y), &ids));
    for layer in 0..LAYERS {
        for (c, channel) in ["R", "G", "B", "A"].into_iter().enumerate() {
            let of_pixel = |ranks: &Ranks| {
                let (id, share) = ranks[2 * layer + c / 2];
                if c % 2 == 0 { id } else { share }
            };
            image.channels.push((format!("{name}{layer:02}.{channel}"), ranks.iter().map(of_pixel).collect()));
        }
    }
    let key = format!("{:08x}", murmur3(name.as_bytes(), 0));
    let values = [
        ("name", name.to_owned()),
        ("hash", "MurmurHash3_32".to_owned()),
        ("conversion", "uint32_to_float32".to_owned()),
        ("manifest", manifest(names)),
    ];
    image.attributes.extend(values.map(|(what, value)| (format!("cryptomatte/{}/{what}", &key[..7]), value)));
}

/// The six that cover most of a pixel, things of one name together. Of equal shares the smaller number is first.
fn ranks(shares: &[(u32, f64)], ids: &[f32]) -> Ranks {
    let mut of_id: BTreeMap<u32, f64> = BTreeMap::new();
    for &(number, share) in shares {
        // A film of another scene may have more; nobody could tell what they are.
        if let Some(id) = ids.get(number as usize - 1) {
            *of_id.entry(id.to_bits()).or_default() += share;
        }
    }
    let mut all: Vec<(u32, f64)> = of_id.into_iter().collect();
    // Stable, and by number before.
    all.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut ranks = [(0.0, 0.0); RANKS];
    for (rank, (id, share)) in ranks.iter_mut().zip(all) {
        *rank = (f32::from_bits(id), rounded_down(share));
    }
    ranks
}

/// In single precision, but never more: what a pixel's pairs cover must not sum to more than all of it.
fn rounded_down(share: f64) -> f32 {
    let near = share.min(1.0) as f32;
    if f64::from(near) > share { f32::from_bits(near.to_bits() - 1) } else { near }
}

/// Names and the numbers that stand for them, as JSON, in order of the names.
fn manifest(names: &[String]) -> String {
    let all: BTreeMap<&str, u32> = names.iter().map(|name| (name.as_str(), id(name).to_bits())).collect();
    let entries: Vec<String> = all.iter().map(|(name, id)| format!("{}:\"{id:08x}\"", quoted(name))).collect();
    format!("{{{}}}", entries.join(","))
}

/// A text as JSON has it, in ASCII alone: some decoders read the attributes of EXR files so.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for unit in text.encode_utf16() {
        match char::from_u32(unit.into()) {
            Some(c @ ('"' | '\\')) => out.extend(['\\', c]),
            Some(c @ ' '..='~') => out.push(c),
            _ => out += &format!("\\u{unit:04x}"),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_sorted_and_sum_to_no_more_than_all() {
        let names: Vec<String> = ["a", "b", "c", "b", "d", "e", "f", "g"].map(str::to_owned).to_vec();
        let ids: Vec<f32> = names.iter().map(|name| id(name)).collect();
        let shares: Vec<(u32, f64)> =
            [5, 11, 13, 9, 1, 2, 3, 3].into_iter().zip(1..).map(|(n, k)| (k, f64::from(n) / 47.0)).collect();
        let found = ranks(&shares, &ids);
        let ids = ["b", "c", "a", "f", "g", "e"].map(id);
        // Both of one name are one; of equal shares the smaller number comes first; the seventh is left out.
        let mut expected = ids;
        expected[3..5].sort_by_key(|id| id.to_bits());
        assert_eq!(found.map(|(id, _)| id), expected);
        let sum: f64 = found.iter().map(|&(_, share)| f64::from(share)).sum();
        assert!(found.is_sorted_by(|a, b| a.1 >= b.1) && sum <= 1.0 && sum > 45.9 / 47.0, "{found:?}");
        assert_eq!(ranks(&[(1, 1.0)], &[2.0])[..2], [(2.0, 1.0), (0.0, 0.0)]);
        for n in 1..200 {
            let thirds: Vec<(u32, f64)> =
                (1..=6).map(|k| (k, f64::from(k) / f64::from(21 * n) * f64::from(n))).collect();
            let of: Vec<f32> = (1..=6).map(|k| k as f32).collect();
            assert!(ranks(&thirds, &of).iter().map(|&(_, share)| f64::from(share)).sum::<f64>() <= 1.0);
        }
    }

    #[test]
    fn manifests_are_json() {
        let names = ["ball", "a \"b\"\\", "ü\n😀", "ball"].map(str::to_owned);
        let expected = format!(
            "{{\"a \\\"b\\\"\\\\\":\"{:08x}\",\"ball\":\"{:08x}\",\"\\u00fc\\u000a\\ud83d\\ude00\":\"{:08x}\"}}",
            id("a \"b\"\\").to_bits(),
            id("ball").to_bits(),
            id("ü\n😀").to_bits()
        );
        assert_eq!(manifest(&names), expected);
    }
}
