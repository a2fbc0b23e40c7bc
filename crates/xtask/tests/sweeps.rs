//! A short form of `cargo xtask sweeps` and `cargo xtask rooms`.

use xtask::sweeps::{self, Options, scenes};
use xtask::truth::{rooms, written::compiled};

/// Few of the steps, of small pictures: cliffs of several times are told. Where a lamp begins to fill its bulb was one
/// of eleven times.
#[test]
fn nothing_jumps() {
    for (name, only) in [("lamp radius", 26..32), ("a moving marble", 9..15)] {
        let options = Options { steps: 40, pictures: 8, samples: 4, size: 32, name: name.to_owned(), only };
        let jumps = sweeps::run(&options).expect("the scenes are legal");
        assert_eq!(jumps, 0, "{name}");
    }
}

/// All scenes that only the long form renders are legal, from end to end.
#[test]
fn all_scenes_are_legal() {
    for sweep in &scenes::ALL {
        for step in [0, 3, 6] {
            compiled(&(sweep.scene)(sweep.value(step, 7), 32))
                .unwrap_or_else(|error| panic!("{}: {error}", sweep.name));
        }
    }
    let rooms = rooms::all();
    assert_eq!(rooms.len(), 10);
    for (name, text) in rooms {
        compiled(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
