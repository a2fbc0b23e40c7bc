//! Numbers that say how far two pictures are apart.

use super::{Kind, Picture, flip};
use serde::Serialize;

/// A pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
}

/// How far two pictures are apart. Linear pictures are compared as they are, others as display values of 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// What was compared.
    pub kind: Kind,
    /// The largest difference of a channel.
    pub max: f64,
    /// Where it is.
    pub max_at: Place,
    /// Root of the mean square of all channels' differences.
    pub rmse: f64,
    /// Mean of (a - b)^2 / (b^2 + 0.01), b the picture that is measured against (Rousselle, Knaus, Zwicker 2011).
    pub relmse: f64,
    /// -20 log10 of `rmse`, in decibels: the signal is 1, white. Infinite for equal pictures.
    pub psnr: f64,
    /// Mean of [`flip`] over the pixels.
    pub flip_mean: f64,
    /// Its maximum.
    pub flip_max: f64,
    /// FLIP of each pixel.
    pub flip_map: Vec<f32>,
}

/// One of the numbers, by the name that the command line uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// [`Difference::max`]
    Max,
    /// [`Difference::rmse`]
    Rmse,
    /// [`Difference::relmse`]
    Relmse,
    /// [`Difference::flip_mean`]
    FlipMean,
    /// [`Difference::flip_max`]
    FlipMax,
}

impl Metric {
    /// All of them.
    pub const ALL: [Metric; 5] = [Metric::Max, Metric::Rmse, Metric::Relmse, Metric::FlipMean, Metric::FlipMax];

    /// `flip-mean`
    pub fn name(self) -> &'static str {
        match self {
            Metric::Max => "max",
            Metric::Rmse => "rmse",
            Metric::Relmse => "relmse",
            Metric::FlipMean => "flip-mean",
            Metric::FlipMax => "flip-max",
        }
    }

    /// Its value.
    pub fn of(self, difference: &Difference) -> f64 {
        match self {
            Metric::Max => difference.max,
            Metric::Rmse => difference.rmse,
            Metric::Relmse => difference.relmse,
            Metric::FlipMean => difference.flip_mean,
            Metric::FlipMax => difference.flip_max,
        }
    }
}

/// Measures `a` against `b`; `None` when their sizes differ.
pub fn difference(a: &Picture, b: &Picture) -> Option<Difference> {
    if (a.width, a.height) != (b.width, b.height) {
        return None;
    }
    let kind = if a.kind == Kind::Linear && b.kind == Kind::Linear { Kind::Linear } else { Kind::Display };
    let displayed = [a.display(), b.display()];
    let (left, right) = match kind {
        Kind::Linear => (&a.values, &b.values),
        Kind::Display => (&displayed[0], &displayed[1]),
    };
    let (mut max, mut max_at, mut squares, mut relative) = (0.0, 0, 0.0, 0.0);
    for (k, (&left, &right)) in left.iter().zip(right).enumerate() {
        let (left, right) = (f64::from(left), f64::from(right));
        let difference = (left - right).abs();
        if difference > max {
            (max, max_at) = (difference, k / 3);
        }
        squares += difference * difference;
        relative += difference * difference / (right * right + 0.01);
    }
    let n = left.len() as f64;
    let rmse = (squares / n).sqrt();
    let flip_map = flip::flip(&displayed[1], &displayed[0], a.width as usize);
    let flip_mean = flip_map.iter().map(|&e| f64::from(e)).sum::<f64>() / flip_map.len() as f64;
    Some(Difference {
        kind,
        max,
        max_at: Place { x: max_at as u32 % a.width, y: max_at as u32 / a.width },
        rmse,
        relmse: relative / n,
        psnr: -20.0 * rmse.log10(),
        flip_mean,
        flip_max: flip_map.iter().copied().fold(0.0, f32::max).into(),
        flip_map,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(kind: Kind, values: &[f32]) -> Picture {
        Picture { width: values.len() as u32 / 3, height: 1, kind, values: values.to_vec() }
    }

    #[test]
    fn equal_pictures_do_not_differ() {
        let a = picture(Kind::Display, &[0.1, 0.5, 1.0, 0.0, 0.25, 0.75]);
        let d = difference(&a, &a).expect("one size");
        assert_eq!((d.max, d.rmse, d.relmse, d.flip_mean, d.flip_max), (0.0, 0.0, 0.0, 0.0, 0.0));
        assert_eq!(d.psnr, f64::INFINITY);
    }

    #[test]
    fn numbers_by_hand() {
        let a = picture(Kind::Linear, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.5]);
        let b = picture(Kind::Linear, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let d = difference(&a, &b).expect("one size");
        assert_eq!((d.max, d.max_at), (0.5, Place { x: 1, y: 0 }));
        assert!((d.rmse - (0.25f64 / 6.0).sqrt()).abs() < 1e-12);
        assert!((d.relmse - 0.25 / (36.0 + 0.01) / 6.0).abs() < 1e-12);
        assert!((d.psnr - 10.0 * (24.0f64).log10()).abs() < 1e-9);
        // Both are white on a display.
        assert_eq!(d.flip_max, 0.0);
    }

    #[test]
    fn sizes_must_be_equal() {
        let a = picture(Kind::Linear, &[0.0; 6]);
        let b = picture(Kind::Linear, &[0.0; 3]);
        assert_eq!(difference(&a, &b), None);
    }
}
