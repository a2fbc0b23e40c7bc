//! All that is asked of one scene.

use super::judge::{self, Question, Told};
use super::kinds::Case;
use super::relation::Relation;
use super::report::{percent, signed};
use super::squares::{LIMIT, PICTURES, squares};
use super::trial::{Picture, Pictures as _, Source};
use super::world::World;
use scene_format::desc::{Material, Object};
use std::panic::AssertUnwindSafe;
use tracer_core::Scene;

/// Samples of the pictures that are compared.
const SAMPLES: u32 = 16;

/// Samples of pictures with few.
const FEW: u32 = 4;

/// Of pictures with few samples, one pixel in so many may be below zero.
const SELDOM: f64 = 10_000.0;

/// Lobes of larger exponents find lamps by chance rather than by light samples.
const NARROW: f64 = 20.0;

/// The chance of squares by chance in a scene: with two sizes of blocks at three numbers of samples, in a third of a
/// thousand scenes, that
/// is one in a thousand at most.
const SQUARES_LEVEL: f64 = 5e-7;

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// It panicked.
    Panic,
    /// A scene that should be legal is refused.
    Refused,
    /// The mean of the picture is wrong.
    Mean,
    /// A tile's mean is wrong.
    Tile,
    /// Light where none can come.
    Dark,
    /// Pixels below zero.
    Negative,
    /// Squares.
    Squares,
    /// Samples that are no numbers.
    Dropped,
}

/// A fault with what was measured.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What kind.
    pub fault: Fault,
    /// In words.
    pub text: String,
}

/// What was found out about a scene.
#[derive(Clone, Debug, Default)]
pub struct Examined {
    /// Faults.
    pub findings: Vec<Finding>,
    /// How well means are known; empty for dark rooms.
    pub told: Told,
    /// The largest upper bound of squares at 95 %; zero where that was not asked.
    pub squares: f64,
}

/// The scenes of a case, compiled.
pub struct Compiled {
    ours: Vec<Scene>,
    theirs: Vec<Scene>,
    brightest: f64,
}

impl Compiled {
    /// Compiles a case's scenes.
    ///
    /// # Errors
    /// One is refused.
    pub fn new(world: &World, relation: Relation) -> anyhow::Result<Self> {
        let theirs = relation.others(world).iter().map(World::compiled).collect::<Result<_, _>>()?;
        let gains = |object: &Object| {
            let material = super::draw::material_of(world, object);
            matches!(material, Some(Material::BlinnPhong(words)) if !words.energy_conserving)
        };
        let narrow = |object: &Object| match super::draw::material_of(world, object) {
            Some(Material::Diffuse(_) | Material::Emissive(_)) | None => false,
            Some(Material::BlinnPhong(words)) => words.exponent.constant().is_none_or(|exponent| exponent > NARROW),
            // As a lobe of that exponent: alpha^2 = 2 / (exponent + 2).
            Some(Material::Conductor(words)) => {
                let wide = |roughness: f64| roughness.powi(4) * (NARROW + 2.0) >= 2.0;
                !words.roughness.constant().is_some_and(wide)
            }
            Some(Material::Mirror(_) | Material::Transparent(_)) => true,
        };
        let objects = || world.desc.objects.iter().map(|object| &object.value);
        let by_chance = relation == Relation::Path && objects().any(narrow);
        let gain = if objects().any(gains) { judge::GAIN } else { 1.0 };
        let ours = world.compiled()?;
        let brightest = if by_chance { gain * super::world::brightest(&ours) } else { 0.0 };
        Ok(Compiled { ours: vec![ours], theirs, brightest })
    }

    /// Our side of the question.
    pub fn ours(&self, samples: u32, threads: usize) -> Source<'_> {
        Source { scenes: &self.ours, plain: false, samples, threads, flip: false }
    }

    /// The other side.
    pub fn theirs(&self, relation: Relation, samples: u32, threads: usize) -> Source<'_> {
        let (plain, flip) = (relation == Relation::Path, relation == Relation::Flipped);
        Source { scenes: &self.theirs, plain, samples, threads, flip }
    }
}

/// Seeds of the pictures of a scene: others for each scene and question.
pub fn first_seed(case: &Case) -> u32 {
    (case.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u32
}

/// Which picture is held against the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The default.
    Truth,
    /// The plain path tracer's, with other seeds: a difference is a false alarm.
    Itself,
}

/// Asks everything; a panic is a finding.
pub fn examine(case: &Case, against: Against, threads: usize) -> Examined {
    match std::panic::catch_unwind(AssertUnwindSafe(|| unguarded(case, against, threads))) {
        Ok(Ok(examined)) => examined,
        Ok(Err(error)) => only(Fault::Refused, format!("{error}")),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without words");
            only(Fault::Panic, text.to_owned())
        }
    }
}

fn only(fault: Fault, text: String) -> Examined {
    Examined { findings: vec![Finding { fault, text }], ..Examined::default() }
}

fn unguarded(case: &Case, against: Against, threads: usize) -> anyhow::Result<Examined> {
    let compiled = Compiled::new(&case.world, case.relation)?;
    let seed = first_seed(case);
    let mut examined = Examined::default();
    if against == Against::Itself && case.relation != Relation::Path {
        return Ok(examined);
    }
    if case.relation == Relation::Dark {
        let pictures = compiled.ours(SAMPLES, threads).pictures(seed, 4);
        examined.findings.extend(light_in_the_dark(&pictures));
        return Ok(examined);
    }
    if case.relation == Relation::Furnace {
        let pictures = compiled.ours(SAMPLES, threads).pictures(seed, 4);
        examined.findings.extend(brighter_than_white(&pictures));
        return Ok(examined);
    }
    let (mut ours, theirs) = (compiled.ours(SAMPLES, threads), compiled.theirs(case.relation, SAMPLES, threads));
    ours.plain = against == Against::Itself;
    let question = Question {
        ours: &ours,
        theirs: &theirs,
        across: ours.across(),
        samples: SAMPLES,
        brightest: compiled.brightest,
    };
    examined.told = judge::judge(&question, seed);
    examined.findings.extend(differences(&examined.told));
    if against == Against::Itself {
        return Ok(examined);
    }
    let few = compiled.ours(FEW, threads).pictures(seed + 3000, 2);
    let negative = [below_zero(&examined.told.ours, SAMPLES), below_zero(&few, FEW)];
    examined.findings.extend(
        negative.into_iter().flatten().reduce(|a, b| Finding { fault: Fault::Negative, text: a.text + "\n" + &b.text }),
    );
    examined.findings.extend(dropped(&examined.told.ours));
    if let Some(samples) = asked_at(case).filter(|_| case.hard) {
        let (found, upper) = in_squares(&compiled, samples, seed + 4000, threads);
        examined.findings.extend(found);
        examined.squares = upper;
    }
    Ok(examined)
}

fn differences(told: &Told) -> Vec<Finding> {
    let line = |d: &judge::Difference| {
        format!(
            "{}: {} +- {} ({:.6} against {:.6}; {} pictures of each)",
            d.region,
            signed(d.relative, 2),
            percent(d.error, 2),
            d.means[0],
            d.means[1],
            d.pictures
        )
    };
    let finding = |fault: Fault, whole: bool| {
        let lines: Vec<String> =
            told.differences.iter().filter(|d| (d.region == "picture") == whole).map(line).collect();
        (!lines.is_empty()).then(|| Finding { fault, text: lines.join("\n") })
    };
    [finding(Fault::Mean, true), finding(Fault::Tile, false)].into_iter().flatten().collect()
}

/// No sample is worth much more than one, so a cell's mean over all is right to a thousandth; what metals reflect
/// several times is told to 3e-3 between the places of a table, at each of some bounces.
fn brighter_than_white(pictures: &[Picture]) -> Option<Finding> {
    let count = pictures.len().max(1) as f64;
    let cells = pictures.first().map_or(0, |picture| picture.cells.len());
    let mean = |cell: usize| pictures.iter().map(|picture| picture.cells[cell]).sum::<f64>() / count;
    let most = (0..cells).map(mean).fold(0.0, f64::max);
    (most > 1.02).then(|| Finding { fault: Fault::Mean, text: format!("a cell is {most:.3} times the sky") })
}

fn light_in_the_dark(pictures: &[Picture]) -> Option<Finding> {
    let lit = pictures.iter().map(|picture| picture.lit).max().unwrap_or(0);
    let mean = pictures.iter().flat_map(|p| &p.cells).sum::<f64>()
        / pictures.iter().map(|p| p.cells.len()).sum::<usize>().max(1) as f64;
    (lit > 0).then(|| Finding { fault: Fault::Dark, text: format!("{lit} pixels have light, {mean:.3e} on average") })
}

fn below_zero(pictures: &[Picture], samples: u32) -> Option<Finding> {
    let pixels = |picture: &Picture| picture.cells.len() as f64 * f64::from(super::trial::CELL * super::trial::CELL);
    let allowed = |picture: &Picture| if samples < 16 { pixels(picture) / SELDOM } else { 0.0 };
    let worst = pictures.iter().max_by_key(|picture| picture.negative)?;
    (f64::from(worst.negative) > allowed(worst)).then(|| Finding {
        fault: Fault::Negative,
        text: format!("{} pixels below zero at {samples} samples, the lowest {:.3e}", worst.negative, worst.lowest),
    })
}

fn dropped(pictures: &[Picture]) -> Option<Finding> {
    let dropped: u64 = pictures.iter().map(|picture| picture.dropped).sum();
    (dropped > 0).then(|| Finding { fault: Fault::Dropped, text: format!("{dropped} samples are no numbers") })
}

/// At how many samples per pixel a scene is asked for squares: seventeen pictures of 64 samples cost more than all else
/// that is asked of a
/// scene, so few are; `None` is not asked. Half of the kinds of rooms where light is hard to find are.
fn asked_at(case: &Case) -> Option<u32> {
    let turn = (first_seed(case) % 12) as usize;
    [4, 4, 16, 16, 16, 64].get(turn).copied()
}

/// Squares at so many samples per pixel; the largest upper bound.
fn in_squares(compiled: &Compiled, samples: u32, seed: u32, threads: usize) -> (Option<Finding>, f64) {
    let mut lines = Vec::new();
    let mut upper = 0.0f64;
    for s in squares(&compiled.ours(samples, threads), seed, PICTURES) {
        upper = upper.max(s.upper());
        if s.chance() < SQUARES_LEVEL {
            lines.push(format!(
                "steps at borders of {} pixels are {:.2} times the others (+- {:.2}; at most {LIMIT} is right) at \
                 {samples} samples",
                s.block,
                s.ratio,
                s.ratio * s.error
            ));
        }
    }
    let finding = (!lines.is_empty()).then(|| Finding { fault: Fault::Squares, text: lines.join("\n") });
    (finding, upper)
}

/// Whether a scene still has a fault of this kind, by a test that is quicker and less strict than the one that found
/// it.
pub fn still(case: &Case, fault: Fault, threads: usize) -> Option<Finding> {
    let any = || {
        let examined = examine(&Case { hard: false, ..case.clone() }, Against::Truth, threads);
        examined.findings.into_iter().find(|finding| finding.fault == fault)
    };
    if fault == Fault::Panic {
        return any();
    }
    let compiled = Compiled::new(&case.world, case.relation);
    let seed = first_seed(case);
    match (fault, &compiled) {
        (Fault::Refused, Err(error)) => Some(Finding { fault, text: format!("{error}") }),
        (Fault::Squares, Ok(compiled)) => in_squares(compiled, asked_at(case)?, seed + 4000, threads).0,
        (Fault::Negative, Ok(compiled)) => {
            let pictures = compiled.ours(SAMPLES, threads).pictures(seed, 4);
            let few = || compiled.ours(FEW, threads).pictures(seed + 3000, 2);
            below_zero(&pictures, SAMPLES).or_else(|| below_zero(&few(), FEW))
        }
        (Fault::Mean | Fault::Tile | Fault::Dark | Fault::Dropped, Ok(_)) => any(),
        _ => None,
    }
}
