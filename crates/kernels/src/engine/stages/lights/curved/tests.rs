//! Curved lights among others, over lanes.

use super::super::{self as lights, Choice, LightHit, LightSample, Receiver, Start};
use crate::lanes::{ArrayF, Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{CurvedLight, FlatLight, Light, LightTable, NONE, Sphere};
use crate::shapes::UnitShape;
use glam::{DAffine3, DVec3};
use tracer_reference::Random;

/// Lanes, and they are few, and functions that are not inlined into one: the optimizer takes minutes for a function of
/// thousands of loops.
const N: usize = 2;
type S = ArrayF<N>;
type U = <S as Lanes>::U;
type M = <S as Lanes>::M;

fn stored(x: S) -> [f32; N] {
    let mut out = [0.0; N];
    x.store(&mut out);
    out
}

#[inline(never)]
fn sample(table: &LightTable, choice: &Choice<S>, p: V3<S>, [u, v]: [S; 2], lanes: M) -> LightSample<S> {
    lights::sample(table, choice, Start::free(p), u, v, lanes)
}

#[inline(never)]
fn pdf(table: &LightTable, k: U, at: Receiver<S>, hit: &LightHit<S>) -> S {
    lights::pdf(table, k, at, hit)
}

/// A ball, a disk with one side, a capsule, a square, a cylinder open at both ends with two sides, a torus.
fn table() -> LightTable {
    let sphere = Sphere {
        center: DVec3::new(3.0, 0.0, 0.0),
        radius: 0.5,
        material: NONE,
        object: 0,
        copy: 0,
        light: 0,
        coordinates: 0,
    };
    let curved = |shape: u32, unit: UnitShape, two_sided: bool| {
        let placement = DAffine3::from_translation(DVec3::new(0.0, 0.0, 3.0 * f64::from(shape)));
        Light::Curved(CurvedLight {
            shape,
            unit,
            placement,
            radiance: [1.0, 2.0, f64::from(shape)],
            two_sided,
            offset: 0.0,
        })
    };
    let edges = [DVec3::X, DVec3::Y];
    let square =
        FlatLight { corner: DVec3::new(-3.0, 0.0, 0.0), edges, radiance: [5.0; 3], two_sided: true, offset: 0.0 };
    let lights = [
        Light::Sphere { sphere: 0, radiance: [9.0; 3], two_sided: true, is_sky: false },
        curved(0, UnitShape::Disk { inner: 0.2 }, false),
        curved(1, UnitShape::Capsule { half: 0.5 }, false),
        curved(2, UnitShape::Cone { radii: [1.0; 2], caps: false, upright: false }, true),
        curved(3, UnitShape::Torus { tube: 0.4 }, false),
        Light::Parallelogram(square),
    ];
    LightTable::new(&lights, &[sphere], None)
}

/// Whichever light a lane has chosen: the density of a hit is that of the sample, and the radiance, too; lanes do not
/// depend on each other.
#[test]
fn lanes_have_lights_of_their_own() {
    let table = table();
    assert!(table.has_curved() && table.has_flat() && table.first_flat == 5);
    let mut random = Random::new(1);
    let mut lit = [0; 6];
    for _ in 0..8000 {
        let which: [u32; N] = std::array::from_fn(|_| random.below(6) as u32);
        let mut column = |scale: f64| std::array::from_fn::<f32, N, _>(|_| (scale * (random.number() - 0.5)) as f32);
        let (x, y, z) = (column(8.0), column(8.0), column(16.0));
        let (u, v) = (column(1.0).map(|x| x + 0.5), column(1.0).map(|x| x + 0.5));
        let (k, p) = (U::load(&which), V3(S::load(&x), S::load(&y), S::load(&z)));
        let choice = Choice { light: k, probability: S::splat(1.0), environment: M::from_bits(0) };
        let s = sample(&table, &choice, p, [S::load(&u), S::load(&v)], S::first(N));
        let alone = sample(&table, &choice, p, [S::load(&u), S::load(&v)], M::from_bits(1));
        assert_eq!(stored(alone.distance)[0].to_bits(), stored(s.distance)[0].to_bits());
        let (distance, inverse) = (stored(s.distance), stored(s.inverse_pdf));
        let (red, wz) = (stored(s.radiance.0), stored(s.wi.2));
        let mut primitives = [0; N];
        s.primitive.store(&mut primitives);
        let front = M::from_bits((0..N).map(|lane| u32::from(wz[lane] < 0.0) << lane).sum());
        let met = LightHit { direction: s.wi, distance: s.distance, cos: s.wi.2.abs(), front, lanes: S::first(N) };
        // It faces what it has chosen: lights below its horizon are never chosen.
        let at = Receiver { p, n: s.wi };
        let density = stored(pdf(&table, k, at, &met));
        let sent = stored(lights::radiance(&table, k, &met).0);
        for lane in 0..N {
            let light = which[lane] as usize;
            if distance[lane] <= 0.0 || red[lane] <= 0.0 {
                continue;
            }
            lit[light] += 1;
            // Which of several lights: one of six, by a rule of its own.
            let (density, inverse) = (density[lane], inverse[lane]);
            let is_one = density > 0.0 && inverse > 0.0 && density * inverse < 1.001;
            assert!(is_one, "light {light}: {density} times {inverse}");
            assert_eq!(primitives[lane], [0, 1, 2, 3, 4, NONE][light]);
            if light == 1 || light == 3 {
                assert_eq!(sent[lane], 1.0, "light {light}");
            }
        }
    }
    assert!(lit.iter().all(|&count| count > 200), "{lit:?}");
}
