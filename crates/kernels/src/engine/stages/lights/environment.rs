//! Light from all directions as a picture has it: a direction to where most of it comes from, and its density.

use super::LightSample;
use crate::lanes::{Bits, Lanes};
use crate::math::{V3, acos, atan2_turns, sincos_turns};
use crate::scene::{Environment, NONE};
use std::f32::consts::{PI, TAU};

/// Farther than everything: render space is about one in size.
const FAR: f32 = 1e30;

/// A direction by the picture's density.
#[inline(always)]
pub fn sample<F: Lanes>(environment: &Environment, u: F, v: F) -> LightSample<F> {
    let c = F::splat;
    let density = &environment.density;
    let (row, in_row, of_row) = find(&density.of_rows, F::U::splat(0), density.rows, v);
    let first = row * F::U::splat(density.columns + 1);
    let (column, in_column, of_column) = find(&density.of_columns, first, density.columns, u);
    let chance = of_row * of_column;
    let x = (F::from_int(column) + in_column) * c(1.0 / density.columns as f32);
    // Alike in all of the cell's solid angle.
    let [above, below] = F::gather2(&density.heights, row);
    let cos = in_row.fma(below - above, above);
    let sin = cos.fnma(cos, c(1.0)).max(c(0.0)).sqrt();
    let y = acos(cos) * c(1.0 / PI);
    let (sin_around, cos_around) = sincos_turns(x - c(0.5));
    let [right, up, front] = axes(environment);
    let wi = right.scale(sin * sin_around).add(up.scale(cos)).add(front.scale(sin * cos_around)).normalise();
    LightSample {
        wi,
        distance: c(FAR),
        inverse_pdf: F::select(c(0.0).lt(chance), (above - below) * c(TAU / density.columns as f32) / chance, c(0.0)),
        radiance: at(environment, x, y),
        primitive: F::U::splat(NONE),
    }
}

/// The density of [`sample`] in solid angle and the radiance, where a direction leaves the scene. The density may be
/// zero where there is hardly any light.
#[inline(always)]
pub fn pdf_and_radiance<F: Lanes>(environment: &Environment, direction: V3<F>) -> (F, V3<F>) {
    let c = F::splat;
    let density = &environment.density;
    let [right, up, front] = axes(environment);
    let (along, height, ahead) = (direction.dot(right), direction.dot(up), direction.dot(front));
    let x = atan2_turns(along, ahead) + c(0.5);
    let y = acos(height) * c(1.0 / PI);
    let (row, column) = (cell(y, density.rows), cell(x, density.columns));
    let first = row * F::U::splat(density.columns + 1);
    let chance = chance_of::<F>(&density.of_rows, row).1 * chance_of::<F>(&density.of_columns, first + column).1;
    let [above, below] = F::gather2(&density.heights, row);
    (chance / ((above - below) * c(TAU / density.columns as f32)), at(environment, x, y))
}

/// Which of so many equal parts a number from 0 to 1 lies in.
#[inline(always)]
fn cell<F: Lanes>(x: F, count: u32) -> F::U {
    let k = (x * F::splat(count as f32)).max(F::splat(0.0)).to_int();
    let last = F::U::splat(count - 1);
    F::U::select(last.lt(k), last, k)
}

/// Where the chances of a cell begin, and its own.
#[inline(always)]
fn chance_of<F: Lanes>(table: &[f32], place: F::U) -> (F, F) {
    let [before, after] = F::gather2(table, place);
    (before, after - before)
}

#[inline(always)]
fn axes<F: Lanes>(environment: &Environment) -> [V3<F>; 3] {
    let [right, up, front] = environment.axes.map(|axis| axis.as_vec3().to_array());
    [V3::splat(right), V3::splat(up), V3::splat(front)]
}

/// The cell of `count` whose chance a number in [0, 1) falls to, how far it lies in it, and its chance. `table`: from
/// `first` on the chances of all before each, and one.
#[inline(always)]
fn find<F: Lanes>(table: &[f32], first: F::U, count: u32, x: F) -> (F::U, F, F) {
    // The last one that begins at or before x: by halves.
    let mut at = F::U::splat(0);
    let mut step = count.next_power_of_two();
    while step > 1 {
        step /= 2;
        let next = at + F::U::splat(step);
        let within = next.lt(F::U::splat(count));
        let begins = F::gather(table, first + F::U::select(within, next, at));
        at = F::U::select(within & begins.le(x), next, at);
    }
    let (before, chance) = chance_of::<F>(table, first + at);
    let some = F::splat(0.0).lt(chance);
    let part = ((x - before) / F::select(some, chance, F::splat(1.0))).max(F::splat(0.0)).min(F::splat(1.0));
    (at, part, chance)
}

/// Radiance at a place of the picture, both coordinates from 0 to 1, y down.
#[inline(always)]
fn at<F: Lanes>(environment: &Environment, x: F, y: F) -> V3<F> {
    let c = F::splat;
    let word = F::U::splat;
    let [width, height] = [environment.width, environment.height];
    // A whole texel further on, so that the number is above zero.
    let (px, py) = (x * c(width as f32) + c(0.5), y * c(height as f32) + c(0.5));
    let (i, j) = (px.to_int(), py.to_int());
    let (fx, fy) = (px - F::from_int(i), py - F::from_int(j));
    // The texels at i - 1 and i, j - 1 and j.
    let (left, right) = (around(i + word(width - 1), width), around(i, width));
    let above = F::U::select(j.eq(word(0)), j, j - word(1));
    let below = F::U::select(j.lt(word(height)), j, word(height - 1));
    let (above, below) = (above * word(width), below * word(width));
    let top = mix(texel(environment, above + left), texel(environment, above + right), fx);
    mix(top, mix(texel(environment, below + left), texel(environment, below + right), fx), fy)
}

/// A column below twice the width, brought into the picture.
#[inline(always)]
fn around<U: Bits>(column: U, width: u32) -> U {
    U::select(column.lt(U::splat(width)), column, column - U::splat(width))
}

#[inline(always)]
fn texel<F: Lanes>(environment: &Environment, index: F::U) -> V3<F> {
    let [red, green, blue] = F::gather3(&environment.texels, index * F::U::splat(3));
    V3(red, green, blue)
}

/// a (1 - f) + b f.
#[inline(always)]
fn mix<F: Lanes>(a: V3<F>, b: V3<F>, f: F) -> V3<F> {
    b.sub(a).mad(f, a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::ArrayF;
    use glam::DVec3;
    use tracer_reference::Random;
    use tracer_reference::statistics::{chi_square, sidak};

    type S = ArrayF<1>;

    fn scalar(x: S) -> f64 {
        let mut out = [0.0];
        x.store(&mut out);
        f64::from(out[0])
    }
    fn vector(v: V3<S>) -> DVec3 {
        DVec3::new(scalar(v.0), scalar(v.1), scalar(v.2))
    }
    fn lanes(v: DVec3) -> V3<S> {
        V3::splat(v.as_vec3().to_array())
    }
    fn number(random: &mut Random) -> S {
        S::splat((random.bits() >> 40) as f32 / 16_777_216.0)
    }

    /// Dark and bright texels, a black half, and a sun; black all over; one texel; wide ones.
    fn skies() -> Vec<Environment> {
        let texels = |width: u32, height: u32| {
            move |random: &mut Random| -> Vec<[f32; 3]> {
                let dark = |k: u32| k % width > width / 2;
                (0..width * height)
                    .map(|k| if dark(k) { [0.0; 3] } else { [0; 3].map(|_| random.between(0.0, 1.0).powi(3) as f32) })
                    .collect()
            }
        };
        let mut random = Random::new(3);
        let up = [DVec3::Y, DVec3::new(0.3, -0.5, 0.8)];
        let mut skies = Vec::new();
        for (k, [width, height]) in [[16, 8], [7, 5], [1, 1], [2, 1], [1, 9], [40, 3]].into_iter().enumerate() {
            let mut texels = texels(width, height)(&mut random);
            if k == 0 {
                texels[3 * 16 + 2] = [500.0, 400.0, 300.0];
            }
            skies.push(Environment::new([width, height], &texels, up[k % 2], 33.0 * k as f64, true));
        }
        skies.push(Environment::new([4, 2], &[[0.0; 3]; 8], DVec3::Y, 0.0, true));
        skies
    }

    /// Directions on a grid of equal solid angles, with theirs.
    fn over_directions(n: usize, mut f: impl FnMut(DVec3, f64)) {
        let area = 4.0 * std::f64::consts::PI / (2 * n * n) as f64;
        for (i, j) in (0..n).flat_map(|i| (0..2 * n).map(move |j| (i, j))) {
            let z = 1.0 - 2.0 * (i as f64 + 0.5) / n as f64;
            let (sin, cos) = (std::f64::consts::TAU * (j as f64 + 0.5) / (2 * n) as f64).sin_cos();
            f(DVec3::new((1.0 - z * z).sqrt() * cos, z, (1.0 - z * z).sqrt() * sin), area);
        }
    }

    /// The density of directions is one in all and is that of the sample; what is sampled sums to the light from all
    /// directions; and directions fall where the density says (chi-square over octants of longitude and eighths of
    /// height; Sidak over the skies).
    #[test]
    fn directions_come_with_their_density() {
        let skies = skies();
        for (k, sky) in skies.iter().enumerate() {
            let black = sky.texels.iter().all(|&x| x == 0.0);
            let (mut whole, mut light) = (0.0, 0.0);
            let cell = |d: DVec3| {
                let around = (d.z.atan2(d.x) / std::f64::consts::TAU + 0.5) * 8.0;
                (around as usize).min(7) * 8 + (((d.y + 1.0) * 4.0) as usize).min(7)
            };
            let mut expected = vec![0.0; 64];
            over_directions(700, |d, area| {
                let (pdf, radiance) = pdf_and_radiance(sky, lanes(d));
                whole += scalar(pdf) * area;
                light += vector(radiance).element_sum() * area;
                expected[cell(d)] += scalar(pdf) * area;
            });
            // The grid's steps against the borders of cells: a thousandth.
            assert!((whole - if black { 0.0 } else { 1.0 }).abs() < 2e-3, "sky {k}: {whole}");
            let mut random = Random::new(100 + k as u64);
            const N: usize = 200_000;
            let (mut sum, mut squares, mut counts, mut odd) = (0.0, 0.0, vec![0u64; 64], 0);
            for _ in 0..N {
                let s = sample::<S>(sky, number(&mut random), number(&mut random));
                let wi = vector(s.wi);
                assert!((wi.length() - 1.0).abs() < 1e-6, "sky {k}");
                let value = vector(s.radiance).element_sum() * scalar(s.inverse_pdf);
                sum += value;
                squares += value * value;
                counts[cell(wi)] += 1;
                let (pdf, radiance) = pdf_and_radiance(sky, s.wi);
                let same = (scalar(pdf) * scalar(s.inverse_pdf) - 1.0).abs() < 2e-3;
                let near = vector(radiance).distance(vector(s.radiance)) <= 1e-3 * (1.0 + vector(s.radiance).length());
                odd += usize::from(!(black || same && near));
            }
            // Directions on a cell's border may round into the next.
            assert!(odd < N / 500, "sky {k}: {odd}");
            let (mean, n) = (sum / N as f64, N as f64);
            let error = ((squares / n - mean * mean).max(0.0) / n).sqrt();
            assert!((mean - light).abs() <= 4.5 * error + 2e-3 * light, "sky {k}: {mean} +- {error}, not {light}");
            if !black {
                let total: f64 = expected.iter().sum();
                let expected: Vec<f64> = expected.iter().map(|x| x / total * n).collect();
                assert!(chi_square(&counts, &expected) > sidak(1e-4, skies.len()), "sky {k}");
            }
        }
    }
}
