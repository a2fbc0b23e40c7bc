//! Every lane type against arrays of as many lanes: the same bits from every operation.

use super::*;

/// Words with all kinds of bits in them.
fn words(count: usize, seed: u32) -> Vec<u32> {
    (0..count as u32)
        .map(|k| (k ^ seed).wrapping_mul(0x9e37_79b1).rotate_left(k % 31).wrapping_mul(0x85eb_ca77))
        .collect()
}

/// Ordinary numbers of both signs, zeros among them.
fn numbers(count: usize, seed: u32) -> Vec<f32> {
    let number = |word: u32| if word.is_multiple_of(11) { 0.0 } else { (word as i32) as f32 * 3e-8 };
    words(count, seed).into_iter().map(number).collect()
}

/// The bits of lane values, one after the other.
struct Log(Vec<u32>);

impl Log {
    fn floats<F: Lanes>(&mut self, value: F) {
        self.words::<F>(value.to_bits());
    }
    fn words<F: Lanes>(&mut self, value: F::U) {
        let mut words = [0; 32];
        value.store(&mut words);
        self.0.extend(&words[..F::N]);
    }
    fn mask<F: Lanes>(&mut self, mask: F::M) {
        self.0.extend([mask.bits(), u32::from(mask.any()), mask.count() as u32]);
    }
}

/// What every operation gives for the same input.
#[inline(always)]
fn everything<F: Lanes>() -> Vec<u32> {
    let mut log = Log(Vec::new());
    for seed in 0..20 {
        let (a, b) = (F::load(&numbers(F::N, seed)), F::load(&numbers(F::N, seed + 100)));
        let (u, w) = (F::U::load(&words(F::N, seed)), F::U::load(&words(F::N, seed + 100)));
        let mask = a.lt(b);
        for value in
            [a + b, a - b, a * b, a / (b.abs() + F::splat(1.0)), -a, a.abs().sqrt(), a.abs(), a.min(b), a.max(b)]
        {
            log.floats(value);
        }
        for value in [a.fma(b, a), a.fnma(b, a), F::select(mask, a, b), F::from_bits(a.to_bits())] {
            log.floats(value);
        }
        log.floats(F::from_int(u.shr::<1>()));
        log.words::<F>((a.abs() * F::splat(1000.0)).to_int());
        for mask in [
            mask,
            a.le(b),
            u.eq(w),
            u.eq(u),
            u.lt(w),
            !mask,
            mask & a.le(F::splat(0.0)),
            mask | u.lt(w),
        ] {
            log.mask::<F>(mask);
        }
        log.mask::<F>(F::M::from_bits(mask.bits()));
        for n in 0..=F::N {
            log.mask::<F>(F::first(n));
        }
        for value in [u + w, u - w, u * w, u ^ w, u & w, u | w, u.shr::<5>(), u.shl::<5>(), u.reverse_bits()] {
            log.words::<F>(value);
        }
        log.words::<F>(F::U::select(mask, u, w));
        // Tables of every size that is looked up in its own way, and of some between; places within them, to the last.
        for size in [1, 2, 3, 7, 8, 9, 16, 17, 31, 32, 33, 100] {
            let (floats, integers) = (numbers(size, seed), words(size, seed));
            let at = |room: usize| {
                let places: Vec<u32> = words(F::N, seed).iter().map(|word| word % (size + 1 - room) as u32).collect();
                F::U::load(&places)
            };
            log.floats(F::gather(&floats, at(1)));
            log.words::<F>(F::U::gather(&integers, at(1)));
            if size >= 2 {
                F::gather2(&floats, at(2)).into_iter().for_each(|value| log.floats(value));
            }
            if size >= 3 {
                F::gather3(&floats, at(3)).into_iter().for_each(|value| log.floats(value));
                F::U::gather3(&integers, at(3)).into_iter().for_each(|value| log.words::<F>(value));
            }
            if size >= 4 {
                F::gather4(&floats, at(4)).into_iter().for_each(|value| log.floats(value));
            }
        }
        // Past the end is the last entry.
        log.floats(F::gather(&numbers(5, seed), F::U::splat(NOWHERE)));
        let (mut floats, mut integers) = (vec![0.0; 2 * F::N], vec![0; 2 * F::N]);
        a.compress(mask, &mut floats);
        u.compress(mask, &mut integers);
        log.0.extend(floats[..mask.count()].iter().map(|value| value.to_bits()));
        log.0.extend(&integers[..mask.count()]);
    }
    log.0
}

const NOWHERE: u32 = u32::MAX;

#[test]
fn pairs_are_twice_the_lanes() {
    assert_eq!(everything::<Pair<ArrayF<1>>>(), everything::<ArrayF<2>>());
    assert_eq!(everything::<Pair<ArrayF<8>>>(), everything::<ArrayF<16>>());
    assert_eq!(everything::<Pair<Pair<ArrayF<8>>>>(), everything::<ArrayF<32>>());
}

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use super::*;
    use crate::level::{Level, Set};

    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    fn of_avx2() -> [Vec<u32>; 2] {
        [everything::<F8>(), everything::<Pair<F8>>()]
    }

    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx512cd,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    fn of_avx512() -> [Vec<u32>; 2] {
        [everything::<F16>(), everything::<Pair<F16>>()]
    }

    #[test]
    fn registers_are_arrays() {
        let has = |set| Level::available().iter().any(|level| level.set() == set);
        if has(Set::Avx2) {
            // SAFETY: the CPU was seen to have the features.
            let [eight, sixteen] = unsafe { of_avx2() };
            assert!(eight == everything::<ArrayF<8>>() && sixteen == everything::<ArrayF<16>>());
        }
        if has(Set::Avx512) {
            // SAFETY: as above.
            let [sixteen, thirty_two] = unsafe { of_avx512() };
            assert!(sixteen == everything::<ArrayF<16>>() && thirty_two == everything::<ArrayF<32>>());
        }
    }
}
