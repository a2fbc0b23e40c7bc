//! Groups that are dropped or fitted. How far they reach is known when all that stands in them is, so their places are
//! found before those of the objects.

use super::assets::Sources;
use super::csg::{self, SolidObject};
use super::curved::{Written, written};
use super::loading::Loaded;
use super::placed::{self, corners};
use super::placing::{Given, Subject, copies, place, place_in};
use super::polygonal::{Polygonal, polygonal};
use glam::{DAffine3, DVec3};
use scene_format::desc::{Moved, endless_group};
use scene_format::{Diagnostics, SceneDesc};
use std::collections::BTreeMap;
use tracer_mesh::MeshData;

/// Where groups come to whose steps ask how far they reach, by the place of their descriptions in memory.
#[derive(Default)]
pub struct Settled(BTreeMap<usize, (DAffine3, Vec<DAffine3>)>);

fn key(group: &Moved) -> usize {
    std::ptr::from_ref(group).addr()
}

impl Settled {
    /// The transform of a group and its copies, if it is one of those.
    pub fn of(&self, group: &Moved) -> Option<&(DAffine3, Vec<DAffine3>)> {
        self.0.get(&key(group))
    }
}

/// What the objects of a scene are made of.
pub struct Things<'a> {
    pub loaded: &'a Loaded,
    pub solids: &'a [SolidObject],
}

/// One of them.
enum Thing<'a> {
    Curved(Written),
    Triangles(Polygonal<'a>, &'a MeshData, [DVec3; 2]),
    Solid(&'a SolidObject, &'static str),
}

impl Thing<'_> {
    fn with_subject<T>(&self, then: impl FnOnce(&Subject<'_>) -> T) -> T {
        match self {
            Thing::Curved(written) => written.with_subject(then),
            Thing::Triangles(object, data, corners) => placed::with_subject(object, data, *corners, then),
            Thing::Solid(solid, noun) => solid.with_subject(noun, then),
        }
    }
}

impl<'a> Things<'a> {
    /// Those of these numbers, which grow. What could not be read is left out: that is told.
    fn of(&self, desc: &'a SceneDesc, numbers: &[usize]) -> BTreeMap<usize, Thing<'a>> {
        let asked = |number: u32| numbers.binary_search(&(number as usize)).is_ok();
        let mut all = BTreeMap::new();
        for (object, file) in
            polygonal(desc).zip(&self.loaded.file_of_object).filter(|(object, _)| asked(object.number))
        {
            if let Some(file) = file {
                let data = &self.loaded.files[*file];
                let corners = corners(data);
                all.insert(object.number as usize, Thing::Triangles(object, data, corners));
            }
        }
        for solid in self.solids.iter().filter(|solid| asked(solid.number)) {
            let noun = csg::noun(&desc.objects[solid.number as usize].value);
            all.insert(solid.number as usize, Thing::Solid(solid, noun));
        }
        for &number in numbers {
            let object = &desc.objects[number];
            if let Some(written) = written(&object.value)
                && object.value.faults(object.span).is_empty()
            {
                all.insert(number, Thing::Curved(written));
            }
        }
        all
    }
}

/// A group whose steps ask how far it reaches.
struct Asking<'a> {
    group: &'a Moved,
    /// How many groups it stands in.
    depth: usize,
    /// The numbers of the objects in it, which grow.
    numbers: Vec<usize>,
}

/// The groups of a scene whose steps ask, those that stand in others first.
fn asking(desc: &SceneDesc) -> Vec<Asking<'_>> {
    let mut all: Vec<Asking<'_>> = Vec::new();
    let mut known: BTreeMap<usize, usize> = BTreeMap::new();
    for (number, object) in desc.objects.iter().enumerate() {
        let Some(within) = object.value.placements().within() else { continue };
        for (depth, group) in within.groups.outwards().into_iter().rev().enumerate() {
            if group.asks_for_reach().is_some() {
                let index = *known.entry(key(group)).or_insert_with(|| {
                    all.push(Asking { group, depth, numbers: Vec::new() });
                    all.len() - 1
                });
                all[index].numbers.push(number);
            }
        }
    }
    all.sort_by_key(|asking| std::cmp::Reverse(asking.depth));
    all
}

/// Finds where the groups come to whose steps ask how far they reach.
pub fn settle<'a>(
    desc: &'a SceneDesc,
    sources: &Sources<'_>,
    things: &Things<'a>,
    diagnostics: &mut Diagnostics,
) -> Settled {
    let mut settled = Settled::default();
    for Asking { group, numbers, .. } in asking(desc) {
        let all = things.of(desc, &numbers);
        let endless = numbers.iter().any(|&number| desc.objects[number].value.is_endless());
        if let (true, Some(step)) = (endless, group.asks_for_reach()) {
            // Of a scene that was built in code.
            diagnostics.push(endless_group(step));
            continue;
        }
        // Something else is wrong, and told.
        if all.len() < numbers.len() {
            continue;
        }
        let given = Given { desc, sources, settled: &settled };
        let mut members = Vec::with_capacity(numbers.len());
        for number in &numbers {
            let (thing, object) = (&all[number], &desc.objects[*number].value);
            // Their faults are told where they are placed.
            let place = |subject: &Subject<'_>| place_in(given, object, group, subject, &mut Diagnostics::new());
            members.push((thing, thing.with_subject(place)));
        }
        let reach = |map: &DAffine3, axis: usize| {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for (thing, maps) in &members {
                thing.with_subject(|subject| {
                    for inner in maps {
                        let [from, to] = (subject.reach)(&(*map * *inner), axis);
                        (low, high) = (low.min(from), high.max(to));
                    }
                });
            }
            if low <= high { [low, high] } else { [0.0, 0.0] }
        };
        let subject = Subject { noun: "group", local: DAffine3::IDENTITY, middle: None, reach: &reach };
        let transform = place(&group.transform, &subject, diagnostics);
        let around = subject.under(&transform, |moved| copies(given, &group.placements, None, moved, diagnostics));
        settled.0.insert(key(group), (transform, around));
    }
    settled
}

#[cfg(test)]
mod tests {
    use super::super::assets::DISK;
    use super::super::gather;
    use scene_format::desc::SceneDesc;
    use scene_format::{Syntax, load_str};
    use std::path::Path;

    fn scene(objects: &str) -> SceneDesc {
        let text = format!("Scene(version: 1, background: 1, objects: [{objects}])");
        load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene that is right").scene
    }

    /// The middles of all balls, in order, and half the sides of all boxes with their middles.
    fn places(objects: &str) -> Vec<[f64; 3]> {
        let desc = scene(objects);
        let gathered = gather(&desc, &DISK).expect("a scene that compiles");
        let balls = gathered.objects.curved.iter().flat_map(|curved| &curved.maps);
        let boxes = gathered.objects.placed.maps.iter().flatten();
        balls.chain(boxes).map(|map| map.translation.to_array()).collect()
    }

    fn same(found: &[[f64; 3]], right: &[[f64; 3]]) {
        assert_eq!(found.len(), right.len(), "{found:?}");
        for (a, b) in found.iter().flatten().zip(right.iter().flatten()) {
            assert!((a - b).abs() < 1e-9, "{found:?} instead of {right:?}");
        }
    }

    #[test]
    fn a_group_is_dropped_by_the_lowest_point_of_all_that_stands_in_it() {
        // A quarter turn about z takes x to y: the ball of radius 1 at x = 2 is above, the box of side 4 reaches down.
        let objects = "Group(transform: [Rotate(axis: (0, 0, 1), degrees: 90), DropTo(0.5)], objects: [
            Sphere(center: (2, 0, 0), radius: 1), Box(center: (0, 1, 0), size: 4)])";
        same(&places(objects), &[[0.0, 4.5, 0.0], [-1.0, 2.5, 0.0]]);
        // What its objects do by themselves comes before: copies, turns, and solids.
        let objects = "Group(transform: [DropTo(0)], objects: [
            Sphere(center: (0, 0, 0), radius: 1, placements: [[], [Translate((0, -7, 0))]]),
            Sphere(center: (0, 0, 0), radius: 1, transform: [Scale(2)]),
            Union(objects: [Sphere(center: (0, 5, 0), radius: 1), Box(size: 20)])])";
        same(&places(objects), &[[0.0, 10.0, 0.0], [0.0, 3.0, 0.0], [0.0, 10.0, 0.0]]);
    }

    #[test]
    fn groups_in_groups_are_settled_from_the_inside() {
        let objects = "Group(transform: [DropTo(0)], objects: [
            Sphere(center: (0, 0, 0), radius: 1),
            Group(transform: [DropTo(-5)], objects: [Sphere(center: (0, 100, 0), radius: 2)]),
        ])";
        same(&places(objects), &[[0.0, 5.0, 0.0], [0.0, 2.0, 0.0]]);
    }

    #[test]
    fn copies_of_a_group_are_dropped_one_by_one() {
        let objects = "Group(transform: [Translate((0, 50, 0))], objects: [Sphere(center: (0, 0, 0), radius: 1)],
            placements: [[DropTo(0)], [Scale(3), DropTo(1), Translate((9, 0, 0))]])";
        same(&places(objects), &[[0.0, 1.0, 0.0], [9.0, 4.0, 0.0]]);
    }

    #[test]
    fn a_group_is_centred_by_all_that_stands_in_it() {
        // From -1 to 4 along x and from -1 to 3 along y; a quarter turn about z takes x to y and y to -x.
        let objects = "Group(transform: [Rotate(axis: (0, 0, 1), degrees: 90), CenterTo((7, 0, -2))], objects: [
            Sphere(center: (0, 0, 0), radius: 1), Box(center: (3, 2, 5), size: 2)])";
        same(&places(objects), &[[8.0, -1.5, -4.5], [6.0, 1.5, 0.5]]);
        // Copies one by one, and a group within one that is centred itself.
        let objects = "Group(placements: [[CenterTo((0, 0, 0))], [Scale(2), CenterTo((0, 9, 0))]], objects: [
            Group(transform: [CenterTo((50, 0, 0))], objects: [Sphere(center: (1, 2, 3), radius: 1)]),
            Sphere(center: (54, 0, 0), radius: 1)])";
        same(&places(objects), &[[-2.0, 0.0, 0.0], [-4.0, 9.0, 0.0], [2.0, 0.0, 0.0], [4.0, 9.0, 0.0]]);
        // A solid goes by the boxes of its shapes; what stands beside the group is not asked.
        let objects = "Sphere(center: (3, 3, 3), radius: 1), Group(transform: [CenterTo((0, 0, 0))], objects: [
            Union(objects: [Sphere(center: (0, 4, 0), radius: 1), Box(center: (10, 0, 0), size: 2)]),
            Sphere(center: (2, 2, 0), radius: 1)])";
        same(&places(objects), &[[3.0, 3.0, 3.0], [-3.0, 0.0, 0.0]]);
    }

    #[test]
    fn a_group_is_fitted_by_all_that_stands_in_it() {
        let objects = "Group(transform: [FitTo(width: 1)], objects: [
            Sphere(center: (-4, 0, 0), radius: 1), Sphere(center: (4, 2, 0), radius: 1)])";
        same(&places(objects), &[[-0.4, 0.0, 0.0], [0.4, 0.2, 0.0]]);
        let flat = scene("Group(transform: [FitTo(height: 1)], objects: [Rectangle(normal: (0, 1, 0), size: 2)])");
        let found = gather(&flat, &DISK).err().expect("a fault").diagnostics;
        let told: Vec<&str> = found.iter().map(|fault| fault.message.as_str()).collect();
        assert_eq!(told, ["the group has no height that could be fitted"]);
    }
}
