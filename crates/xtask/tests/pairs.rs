//! Exact pairs: scenes whose default pictures are the same on average by construction (`xtask::truth::pairs`).
//!
//! No truth but these tells what photons do to thin, folded and low-poly things: the plain path tracer hardly finds a
//! lamp in glass.

use xtask::truth::pairs::{all, level};

/// Pictures of each side. What a pair notices with these is printed with it.
const PICTURES: usize = 12;

/// Judges the pairs whose names begin so, side by side.
fn hold(beginning: &str) {
    let pairs = all();
    let level = level(pairs.len());
    let chosen: Vec<_> = pairs.iter().filter(|pair| pair.name.starts_with(beginning)).collect();
    assert!(!chosen.is_empty(), "no pair begins with {beginning:?}");
    let mut failing = Vec::new();
    for pair in chosen {
        let outcome = pair.judge(PICTURES, level, false).unwrap_or_else(|error| panic!("{}: {error}", pair.name));
        println!("{}", outcome.line());
        if !outcome.faults.is_empty() {
            failing.push(outcome.line());
        }
    }
    assert!(failing.is_empty(), "pairs that differ:\n{}", failing.join("\n"));
}

#[test]
fn a_bulb_of_index_one_changes_nothing() {
    hold("bulb");
}

#[test]
fn a_pane_of_index_one_changes_nothing() {
    hold("pane");
}

#[test]
fn shells_of_index_one_change_nothing() {
    hold("shells");
}

#[test]
fn tumblers_of_index_one_on_the_floor_change_nothing() {
    hold("tumblers");
}

#[test]
fn what_is_flush_with_the_floor_and_alike_changes_nothing() {
    hold("rugs");
}

#[test]
fn a_flat_mirror_is_the_mirrored_world() {
    hold("flat mirror");
}

#[test]
fn tinted_panes_are_a_tinted_lamp_in_either_order() {
    hold("tinted");
}

#[test]
fn two_lamps_are_the_sum_of_each() {
    hold("two lamps");
}

#[test]
fn a_scene_and_its_mirror_image() {
    hold("mirror image");
}

#[test]
fn twice_the_light_is_twice_the_picture() {
    hold("twice");
}

#[test]
fn subdivided_meshes_look_the_same() {
    hold("finer");
}

#[test]
fn copies_look_the_same_however_they_are_stored() {
    hold("instances");
}

#[test]
fn a_room_without_light_is_black() {
    hold("a room");
}

/// Every pair is in one of the tests.
#[test]
fn all_pairs_are_tested() {
    let tested = [
        "bulb",
        "pane",
        "shells",
        "tumblers",
        "rugs",
        "flat mirror",
        "tinted",
        "two lamps",
        "mirror image",
        "twice",
        "finer",
        "instances",
        "a room",
    ];
    for pair in all() {
        assert_eq!(tested.iter().filter(|beginning| pair.name.starts_with(**beginning)).count(), 1, "{}", pair.name);
    }
}
