//! Pairs of scenes whose pictures are the same on average, by construction: truths that need no other renderer and no
//! patience, for
//! both sides are the default picture.
//!
//! Each is tested on the difference: whole picture and tiles of 32x32 pixels, pictures with independent seeds on both
//! sides, Welch's
//! test, at a level that all regions of all pairs together fail by chance once in a hundred (Šidák). Passing glass and
//! meeting a mirror count as
//! bounces; so scenes have `BOUNCES` of these, albedos of a half and less, and are open to the dark: what is cut off
//! is less than `CUT_OFF`.

use super::meshes::Shape;
use super::receivers::Receiver;
use super::relation::{PLANE_MIRROR, Relation};
use super::report::{percent, signed};
use super::trial::{Picture, Pictures as _, Source, TILE, regions};
use super::world::{World, diffuse, glass, matt, mirror, tinted};
use scene_format::desc::{Instances, Material, Transform};
use scene_format::diagnostic::Spanned;
use tracer_core::Scene;
use tracer_reference::Random;
use tracer_reference::statistics::{Estimate, sidak, student};

/// Pixels along a side.
const SIZE: u32 = 128;

/// Samples per pixel: with sixteen, items of both shapes that pixels share within occur.
const SAMPLES: u32 = 18;

/// So many that what is cut off does not show.
const BOUNCES: u32 = 30;

/// Fifteen bounces of an albedo of a half and as many passages are left where each bounce comes with one: 2^-15 at
/// most. Doubled; single
/// precision is better than that.
const CUT_OFF: f64 = 6e-5;

/// All pairs together fail by chance so often.
const FAMILY: f64 = 0.01;

/// How far a rounded mean of two films may be from twice the other: both are rounded to multiples of 2^-50.
const FILM_STEP: f64 = 1.0 / (1u64 << 48) as f64;

/// Thin, folded and low-poly ones, and a slab as the control.
const RECEIVERS: [Receiver; 6] =
    [Receiver::Rods, Receiver::Slats, Receiver::Grass, Receiver::Corrugated, Receiver::LowPoly, Receiver::Slab];

/// One of each sort, for pairs of which the receiver is not the point.
const A_FEW: [Receiver; 3] = [Receiver::Grass, Receiver::Corrugated, Receiver::LowPoly];

/// What must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Claim {
    /// The pictures are the same on average.
    Equal,
    /// Ours is the mirror image of theirs on average.
    MirrorImage,
    /// Theirs is twice ours, pixel by pixel.
    Double,
    /// Ours is black.
    Black,
}

/// Scenes that belong together.
pub struct Pair {
    /// `bulb: rods`
    pub name: String,
    ours: World,
    /// Their pictures are summed.
    theirs: Vec<World>,
    claim: Claim,
}

/// What came of a pair.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// `bulb: rods`
    pub name: String,
    /// Where it fails and by how much; empty where it holds.
    pub faults: Vec<String>,
    /// The relative difference of the whole picture, its standard error, and the smallest that would have failed.
    pub whole: [f64; 3],
    /// The smallest relative difference that would have failed in the tile in the middle of those that have light.
    pub tile: f64,
}

/// A floor with a receiver on it, and a lamp over it; seen from a little above the floor.
fn stage(receiver: Receiver) -> World {
    let mut world = World::new(SIZE);
    world.bounces(BOUNCES);
    world.mesh("floor", &Shape::block([-3.0, -0.1, -3.0], [3.0, 0.0, 3.0]), matt(0.4));
    let shape = fixed(receiver).placed(1.1, [1.2, 0.0, 0.0]);
    world.mesh(&name_of(receiver), &shape, diffuse([0.5, 0.4, 0.3]));
    world.camera([1.2, 1.25, 4.0], [1.2, 0.35, 0.0], 42.0);
    world
}

fn name_of(receiver: Receiver) -> String {
    format!("{receiver:?}").to_lowercase()
}

/// The same receiver in every pair.
fn fixed(receiver: Receiver) -> Shape {
    match receiver {
        Receiver::Rods => Shape::rods(15, 0.06, &mut Random::new(3)),
        Receiver::Slats => Shape::slats(0.06),
        Receiver::Grass => Shape::grass(500, &mut Random::new(4)),
        Receiver::Corrugated => Shape::corrugated(50.0, 0.12),
        Receiver::LowPoly => Shape::ball(1).placed(0.6, [0.0, 0.6, 0.0]),
        Receiver::Slab | Receiver::Pebbles => Shape::block([-1.0, 0.2, -1.0], [1.0, 0.3, 1.0]),
    }
}

const LAMP: [f64; 3] = [0.9, 2.3, 0.6];

fn related(name: String, ours: World, relation: Relation) -> Pair {
    let claim = match relation {
        Relation::Flipped => Claim::MirrorImage,
        Relation::Twice => Claim::Double,
        Relation::Dark => Claim::Black,
        _ => Claim::Equal,
    };
    Pair { name, theirs: relation.others(&ours), ours, claim }
}

fn lit(receiver: Receiver) -> World {
    let mut world = stage(receiver);
    world.lamp(LAMP, 0.2, [40.0, 30.0, 20.0]);
    world
}

fn pane(world: &mut World, name: &str, low: f64, material: Material) {
    world.mesh(name, &Shape::block([-6.0, low, -6.0], [6.0, low + 0.04, 6.0]), material);
}

/// Glass of index 1.0 changes nothing.
fn shells(pairs: &mut Vec<Pair>) {
    for receiver in RECEIVERS {
        let mut add = |what: &str, change: &dyn Fn(&mut World)| {
            let mut world = lit(receiver);
            change(&mut world);
            pairs.push(related(format!("{what}: {}", name_of(receiver)), world, Relation::Shells));
        };
        add("bulb", &|world| world.sphere(LAMP, 0.5, glass(1.0)));
        add("pane under the lamp", &|world| pane(world, "pane", 1.7, glass(1.0)));
        add("pane before the camera", &|world| {
            world.mesh("pane", &Shape::block([-3.0, 0.0, 2.6], [4.0, 3.5, 2.64]), glass(1.0));
        });
    }
    for receiver in [Receiver::Grass, Receiver::LowPoly] {
        let mut world = lit(receiver);
        world.sphere(LAMP, 0.3, glass(1.0));
        world.sphere(LAMP, 0.6, glass(1.0));
        world.mesh("shell", &Shape::block([-0.3, 0.01, -1.6], [2.7, 1.5, 1.6]), glass(1.0));
        pairs.push(related(format!("shells in shells: {}", name_of(receiver)), world, Relation::Shells));
    }
}

/// What lies in the floor's plane changes nothing where it is as the floor is, or glass of index 1.0: rugs, lids let
/// into the floor, tumblers.
fn flush(pairs: &mut Vec<Pair>) {
    for receiver in [Receiver::Grass, Receiver::LowPoly] {
        let name = name_of(receiver);
        let mut world = lit(receiver);
        super::curved::standing(&mut world, [0.9, 0.0, 1.3], 0.6, 0.35, glass(1.0));
        super::curved::standing(&mut world, [1.9, 0.0, 1.2], 0.3, 0.3, glass(1.0));
        pairs.push(related(format!("tumblers on the floor: {name}"), world, Relation::Shells));
        let mut world = lit(receiver);
        super::curved::lying(&mut world, [1.2, 0.0, 0.2], 1.4, 0.5, matt(0.4));
        super::curved::lying(&mut world, [0.3, 0.0, 1.2], 0.5, 0.0, matt(0.4));
        super::curved::standing(&mut world, [2.1, 0.0, 1.2], -0.05, 0.4, matt(0.4));
        let (name, theirs) = (format!("rugs and a lid: {name}"), vec![lit(receiver)]);
        pairs.push(Pair { name, ours: world, theirs, claim: Claim::Equal });
    }
}

/// A flat mirror shows the mirrored world. A black screen keeps the lamp's own light from the receiver.
fn mirrors(pairs: &mut Vec<Pair>) {
    for receiver in RECEIVERS {
        let mut world = lit(receiver);
        world.mesh("screen", &Shape::block([0.75, 1.6, -2.0], [3.0, 1.63, 2.0]), matt(0.0));
        let corners = [[0.0, -9.0, 9.0], [0.0, -9.0, -9.0], [0.0, 9.0, -9.0], [0.0, 9.0, 9.0]];
        world.mesh(PLANE_MIRROR, &Shape::quad(corners), mirror());
        // The receiver must not reach through the mirror.
        world.desc.objects.retain(|object| !is_mesh(&object.value, "floor"));
        world.mesh("half-floor", &Shape::block([0.0, -0.1, -3.0], [3.0, 0.0, 3.0]), matt(0.4));
        pairs.push(related(format!("flat mirror: {}", name_of(receiver)), world, Relation::Unfolded));
    }
}

fn is_mesh(object: &scene_format::desc::Object, name: &str) -> bool {
    match object {
        scene_format::desc::Object::Mesh(mesh) => {
            mesh.file().is_some_and(|file| file.value.to_string_lossy().starts_with(name))
        }
        _ => false,
    }
}

/// Tinted panes of index 1.0 between the lamp and all else: in either order, and as a tint of the lamp.
fn tints(pairs: &mut Vec<Pair>) {
    let (a, b): ([f64; 3], [f64; 3]) = ([0.9, 0.6, 0.8], [0.5, 0.9, 0.7]);
    for receiver in RECEIVERS {
        let with = |upper: [f64; 3], lower: [f64; 3]| {
            let mut world = lit(receiver);
            pane(&mut world, "upper", 1.8, tinted(1.0, upper));
            pane(&mut world, "lower", 1.6, tinted(1.0, lower));
            world
        };
        let mut bare = stage(receiver);
        let through = [0, 1, 2].map(|k| [40.0, 30.0, 20.0][k] * (a[k] * b[k]).powi(2));
        bare.lamp(LAMP, 0.2, through);
        let name = name_of(receiver);
        let pair = |name: String, theirs| Pair { name, ours: with(a, b), theirs: vec![theirs], claim: Claim::Equal };
        pairs.push(pair(format!("tinted panes, a tinted lamp: {name}"), bare));
        if A_FEW.contains(&receiver) {
            pairs.push(pair(format!("tinted panes in either order: {name}"), with(b, a)));
        }
    }
}

/// A lamp in a glass bulb and a lamp without, beside a glass ball: the scene with everything in it.
fn furnished(receiver: Receiver) -> World {
    let mut world = lit(receiver);
    world.sphere(LAMP, 0.4, glass(1.5));
    world.lamp([2.4, 1.9, 0.4], 0.15, [20.0, 30.0, 40.0]);
    world.sphere([2.0, 0.3, 1.1], 0.3, glass(1.5));
    world.mesh("ball", &Shape::ball(1).placed(0.3, [0.4, 0.3, 1.2]), mirror());
    world
}

/// What must not change a picture, or changes it in a known way.
fn rewritten(pairs: &mut Vec<Pair>) {
    for receiver in RECEIVERS {
        let name = name_of(receiver);
        pairs.push(related(format!("two lamps, each alone: {name}"), furnished(receiver), Relation::Sum));
        if !A_FEW.contains(&receiver) {
            continue;
        }
        pairs.push(related(format!("mirror image: {name}"), furnished(receiver), Relation::Flipped));
        pairs.push(related(format!("twice the light: {name}"), furnished(receiver), Relation::Twice));
        let finer = |times: u32| {
            let mut world = lit(receiver);
            world.sphere(LAMP, 0.4, glass(1.5));
            world.mesh("cube", &Shape::block([0.0, 0.01, 1.0], [0.4, 0.4, 1.4]).subdivided(times), glass(1.5));
            let floor = Shape::block([-3.0, 0.0, -3.0], [3.0, 0.003, 3.0]).subdivided(2 * times);
            world.mesh("cloth", &floor, matt(0.4));
            if receiver != Receiver::LowPoly {
                let shape = fixed(receiver).placed(0.4, [2.2, 0.0, 1.2]).subdivided(times);
                world.mesh("finer", &shape, matt(0.5));
            }
            world
        };
        let (ours, theirs) = (finer(0), vec![finer(2)]);
        pairs.push(Pair { name: format!("finer meshes: {name}"), ours, theirs, claim: Claim::Equal });
        pairs.push(related(format!("instances: {name}"), copies(receiver), Relation::Instances));
    }
}

/// Three small copies of the receiver under a lamp in its bulb.
fn copies(receiver: Receiver) -> World {
    let mut world = lit(receiver);
    world.sphere(LAMP, 0.4, glass(1.5));
    let shape = fixed(receiver).placed(0.3, [0.0; 3]);
    let file = world.file("copy", "obj", shape.obj().into_bytes());
    world.placed(file, matt(0.5), Vec::new());
    let placement = |k: i32| {
        let turn = Transform::Rotate { axis: [0.0, 1.0, 0.0], degrees: 40.0 * f64::from(k), about: None };
        let to = [0.3 + 0.8 * f64::from(k), 0.0, 1.3];
        vec![Spanned::from(turn), Spanned::from(Transform::Translate(to))]
    };
    super::draw::last_mesh(&mut world, |mesh| {
        mesh.placements = (0..3).map(placement).collect();
        mesh.instances = Instances::Always;
    });
    world
}

/// A room without a lamp beside one with a lamp in a bulb, a thin wall between.
fn dark(pairs: &mut Vec<Pair>) {
    for receiver in RECEIVERS {
        let mut world = stage(receiver);
        world.bounces(8);
        let t = 0.02;
        for (low, high) in [
            ([-3.0, -0.2, -3.0], [3.0, -0.1, 3.0]),
            ([-3.0, 3.0, -3.0], [3.0, 3.1, 3.0]),
            ([-3.1, -0.2, -3.0], [-3.0, 3.1, 3.0]),
            ([3.0, -0.2, -3.0], [3.1, 3.1, 3.0]),
            ([-3.1, -0.2, -3.1], [3.1, 3.1, -3.0]),
            ([-3.1, -0.2, 3.0], [3.1, 3.1, 3.1]),
            ([-t, -0.15, -3.05], [0.0, 3.05, 3.05]),
        ] {
            world.mesh("wall", &Shape::block(low, high), matt(0.8));
        }
        world.lamp([-1.5, 1.5, 0.0], 0.25, [40.0; 3]);
        world.sphere([-1.5, 1.5, 0.0], 0.4, glass(1.5));
        world.sphere([0.4, 0.3, 1.2], 0.3, glass(1.5));
        world.camera([1.5, 1.5, 2.8], [1.2, 0.4, 0.0], 60.0);
        pairs.push(related(format!("a room without light: {}", name_of(receiver)), world, Relation::Dark));
    }
}

/// All pairs.
pub fn all() -> Vec<Pair> {
    let mut pairs = Vec::new();
    shells(&mut pairs);
    flush(&mut pairs);
    mirrors(&mut pairs);
    tints(&mut pairs);
    rewritten(&mut pairs);
    dark(&mut pairs);
    pairs
}

/// The level of each region's test so that all of them together fail by chance once in a hundred.
pub fn level(pairs: usize) -> f64 {
    let tiles = (SIZE / TILE) as usize;
    sidak(FAMILY, pairs * (tiles * tiles + 1))
}

impl Pair {
    /// Renders so many pictures of each side, and compares them; `plain`: those of the plain path tracer, which shows
    /// whether the pair is
    /// a pair.
    ///
    /// # Errors
    /// A scene is refused.
    pub fn judge(&self, pictures: usize, level: f64, plain: bool) -> anyhow::Result<Outcome> {
        let ours = [self.ours.compiled()?];
        let theirs: Vec<Scene> = self.theirs.iter().map(World::compiled).collect::<Result<_, _>>()?;
        let source = |scenes, flip| Source { scenes, plain, samples: SAMPLES, threads: 1, flip };
        let (ours, theirs) = (source(&ours[..], false), source(&theirs[..], self.claim == Claim::MirrorImage));
        let outcome = |faults| Outcome { name: self.name.clone(), faults, whole: [0.0; 3], tile: 0.0 };
        match self.claim {
            Claim::Black => {
                let lit = ours.pictures(1, 2).iter().map(|picture| picture.lit).max().unwrap_or(0);
                Ok(outcome(if lit == 0 { vec![] } else { vec![format!("{lit} pixels have light")] }))
            }
            Claim::Double => Ok(outcome(double(&ours, &theirs))),
            Claim::Equal | Claim::MirrorImage => {
                let (a, b) = (ours.pictures(100, pictures), theirs.pictures(5000, pictures));
                Ok(Outcome { name: self.name.clone(), ..equal(&a, &b, ours.across(), level) })
            }
        }
    }
}

/// Pixels of which theirs is not twice ours, of the same seed.
fn double(ours: &Source<'_>, theirs: &Source<'_>) -> Vec<String> {
    let (once, twice) = (ours.films(7), theirs.films(7));
    let mut worst = 0.0f64;
    let mut count = 0;
    for (x, y) in (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y))) {
        let (a, b) = (once[0].radiance(x, y), twice[0].radiance(x, y));
        let off = (0..3).map(|k| (b[k] - 2.0 * a[k]).abs()).fold(0.0, f64::max);
        worst = worst.max(off);
        count += u32::from(off > FILM_STEP);
    }
    if count == 0 { vec![] } else { vec![format!("{count} pixels are not doubled, by {worst:.3e} at most")] }
}

fn equal(ours: &[Picture], theirs: &[Picture], across: usize, level: f64) -> Outcome {
    let mut outcome = Outcome { name: String::new(), faults: Vec::new(), whole: [0.0; 3], tile: 0.0 };
    let mut noticed = Vec::new();
    for (k, region) in regions(across).iter().enumerate() {
        let (a, b) = (Estimate::of(&region.means(ours)), Estimate::of(&region.means(theirs)));
        if b.mean == 0.0 && a.mean == 0.0 {
            continue;
        }
        let apart = a.mean - b.mean;
        let excess = (apart.abs() - CUT_OFF * b.mean.abs()).max(0.0).copysign(apart);
        let compared = Estimate { mean: b.mean + excess, ..a }.compare(&b);
        let error = (a.variance + b.variance).sqrt();
        let part = |e: &Estimate| e.variance * e.variance / e.freedom;
        let freedom = (a.variance + b.variance).powi(2) / (part(&a) + part(&b));
        let least = (critical(level, freedom) * error / b.mean).abs();
        if k == 0 {
            outcome.whole = [apart / b.mean, error / b.mean, least];
        } else {
            noticed.push(least);
        }
        // False for no number, too.
        let same = compared.probability >= level;
        if !same {
            let (off, error) = (signed(apart / b.mean, 2), percent(error / b.mean, 2));
            let (name, z) = (&region.name, compared.z);
            outcome.faults.push(format!("{name}: {off} +- {error}, z {z:.1} ({:.6}, {:.6})", a.mean, b.mean));
        }
    }
    noticed.sort_by(f64::total_cmp);
    outcome.tile = noticed.get(noticed.len() / 2).copied().unwrap_or(0.0);
    outcome
}

/// Student's t that is exceeded with this probability, by halving.
fn critical(level: f64, freedom: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if student(middle, freedom) > level { low = middle } else { high = middle }
    }
    high
}

/// Judges those pairs whose name contains `filter`, prints a line of each, and gives how many fail.
///
/// # Errors
/// A scene is refused.
pub fn run(pictures: usize, filter: &str, plain: bool) -> anyhow::Result<usize> {
    use rayon::prelude::*;
    let pairs = all();
    let level = level(pairs.len());
    let judged = |pair: &Pair| {
        let outcome = pair.judge(pictures, level, plain)?;
        println!("{}", outcome.line());
        Ok(outcome)
    };
    let chosen: Vec<&Pair> = pairs.iter().filter(|pair| pair.name.contains(filter)).collect();
    let outcomes: Vec<Outcome> = chosen.into_par_iter().map(judged).collect::<anyhow::Result<_>>()?;
    let failing = outcomes.iter().filter(|outcome| !outcome.faults.is_empty()).count();
    println!("{failing} of {} pairs differ", outcomes.len());
    Ok(failing)
}

impl Outcome {
    /// What came of it, in a line and one more for each fault.
    pub fn line(&self) -> String {
        let [off, error, least] = self.whole;
        let mut line = format!(
            "{:<46} {:>9} +- {}; would notice {}, in a tile {}",
            self.name,
            signed(off, 2),
            percent(error, 2),
            percent(least, 1),
            percent(self.tile, 1)
        );
        for fault in &self.faults {
            line += &format!("\n    {fault}");
        }
        line
    }
}
