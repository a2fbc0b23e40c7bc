//! The picture is the same, byte for byte, in every combination: threads x lanes x crop x acceleration, with batches of
//! 4, 8, 12 and 16 items: all of them with `TRACER_PROOFS=long`, else so many that every two settings meet.
//! [`crate::same_bytes`] goes further along each of these alone. Builds with and without optimisation are compared by
//! the goldens (CONTRIBUTING.md names the command).

use crate::same_bytes::{bits, cut, everything, many_balls, options};
use crate::support::describe::*;
use crate::support::meshes::{icosphere, torus};
use crate::support::{compiled, effort};
use scene_format::SceneDesc;
use scene_format::desc::{Acceleration, Material, PixelFilter, Reuse, Shading, ToneMap, Transform, Transparent};
use scene_format::diagnostic::Spanned;
use tracer_core::{Crop, Level, RenderOptions, Unobserved, develop};

/// What the other two scenes lack: pixels for themselves, tinted glass, a box filter or none, exposure and a tone map,
/// clamping.
fn plain(filter: PixelFilter, tone_map: ToneMap, clamp: Option<f64>) -> SceneDesc {
    let tinted =
        Material::Transparent(Box::new(Transparent { ior: 1.4.into(), transmittance: [0.9, 0.6, 0.4].into() }));
    let objects = vec![
        sphere([0.0, -1000.0, 0.0], 1000.0, diffuse([0.6; 3])),
        sphere([-1.2, 1.0, 0.0], 1.0, tinted.clone()),
        mesh(&icosphere(1).obj("icosphere-1"), tinted, Shading::Flat, vec![Transform::Translate([1.2, 1.0, 0.0])]),
        mesh(
            &torus(0.4, 12, 8).obj("torus-12-8"),
            conserving([0.3, 0.6, 0.9], 20.0, 0.8),
            Shading::Smooth,
            vec![Transform::Translate([0.0, 0.4, 2.5])],
        ),
    ];
    let mut desc = scene(37, vec![light([4.0, 7.0, 5.0], 1.0, [12.0, 11.0, 9.0])], objects)
        .camera([0.5, 3.0, 9.0], [0.0, 1.0, 0.0], 35.0)
        .background([0.1, 0.2, 0.3])
        .bounces(4)
        .filter(filter);
    desc.render.reuse = Reuse::None;
    desc.render.clamp = clamp.map(Spanned::from);
    desc.effects.exposure = 0.7.into();
    desc.effects.tone_map = tone_map;
    desc
}

/// A pass of one sample puts four tiles into a batch: rows of one, two, three and four tiles make batches of 4, 8, 12
/// and 16 items. Each begins or ends within a tile.
const CROPS: [Crop; 4] = [
    Crop { x: 3, y: 17, width: 11, height: 9 },
    Crop { x: 9, y: 2, width: 20, height: 13 },
    Crop { x: 1, y: 19, width: 33, height: 12 },
    Crop { x: 12, y: 12, width: 14, height: 16 },
];

fn every_combination(name: &str, mut desc: SceneDesc) {
    let look = compiled(&desc).look;
    // Under a background, too, where by itself the engine does not share.
    let reuse = Some(desc.render.reuse == Reuse::Blocks);
    // Without hardware fma a sample costs a hundred times more: `same_bytes` has that level.
    let levels: Vec<_> = Level::available().into_iter().filter(|&level| level != Level::PORTABLE).collect();
    let mut expected = None;
    // The first is the whole picture.
    for [acceleration, level, threads, crop] in combinations(levels.len(), effort() > 1) {
        desc.render.acceleration = ACCELERATIONS[acceleration];
        let scene = compiled(&desc);
        let (level, threads) = (levels[level], THREADS[threads]);
        let crop = crop.checked_sub(1).map_or(Crop::whole(scene.size), |crop| CROPS[crop]);
        let options = RenderOptions { threads, level: Some(level), crop: Some(crop), reuse, ..options() };
        let film = tracer_core::render(&scene, &options, &Unobserved);
        let (film_bits, image) = (bits(&film), develop(&film, &look));
        let (pixels, display) = expected.get_or_insert_with(|| (film_bits.clone(), image.display.clone()));
        let place = format!("{name}: {:?}, {}, {threads} threads, {crop:?}", desc.render.acceleration, level.name());
        assert!(film_bits == cut(pixels, scene.size, crop), "the film differs: {place}");
        let colors: Vec<[f32; 3]> = display.chunks(3).map(|c| [c[0], c[1], c[2]]).collect();
        let part = cut(&colors, scene.size, crop);
        assert!(image.display == part.as_flattened(), "the picture differs: {place}");
    }
}

const ACCELERATIONS: [Acceleration; 3] = [Acceleration::Bvh, Acceleration::BoundingBox, Acceleration::None];
const THREADS: [usize; 2] = [1, 3];

/// Numbers of acceleration, level, threads and crop (0: none), so that every two of them meet in every way; all
/// combinations where time does not matter.
fn combinations(levels: usize, all: bool) -> Vec<[usize; 4]> {
    let pairs = || (0..=CROPS.len()).flat_map(|crop| (0..ACCELERATIONS.len()).map(move |way| (crop, way)));
    if all {
        let others = |level| (0..THREADS.len()).map(move |threads| (level, threads));
        let rest = || (0..levels).flat_map(others);
        return pairs()
            .flat_map(|(crop, way)| rest().map(move |(level, threads)| [way, level, threads, crop]))
            .collect();
    }
    pairs()
        .map(|(crop, way)| {
            let sum = crop + way;
            // Where the levels are even in number they would go in step with the threads.
            let turn = if levels.is_multiple_of(2) { sum / levels } else { 0 };
            [way, sum % levels, (sum + turn) % THREADS.len(), crop]
        })
        .collect()
}

/// Every two meet in every way, however many levels a CPU has.
#[test]
fn every_pair_is_covered() {
    for levels in 1..=3 {
        let counts = [ACCELERATIONS.len(), levels, THREADS.len(), CROPS.len() + 1];
        let few = combinations(levels, false);
        assert_eq!(combinations(levels, true).len(), counts.iter().product::<usize>());
        assert!(few.len() <= 3 * (CROPS.len() + 1) && few[0] == [0, 0, 0, 0]);
        for (a, b) in (0..4).flat_map(|a| (a + 1..4).map(move |b| (a, b))) {
            for (x, y) in (0..counts[a]).flat_map(|x| (0..counts[b]).map(move |y| (x, y))) {
                assert!(few.iter().any(|row| row[a] == x && row[b] == y), "{levels} levels: {a} {x}, {b} {y}");
            }
        }
    }
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn everything_in_every_combination() {
    every_combination("everything", everything());
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn many_balls_in_every_combination() {
    let mut desc = many_balls();
    // Three tiles across, as the others.
    (desc.image.width, desc.image.height) = (37.into(), 37.into());
    every_combination("many balls", desc);
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn pixels_for_themselves_in_every_combination() {
    every_combination("box filter, AgX", plain(PixelFilter::Box, ToneMap::AgX, None));
    every_combination("no filter, filmic, clamped", plain(PixelFilter::None, ToneMap::Filmic, Some(1.0)));
}
