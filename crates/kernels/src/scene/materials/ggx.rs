//! What a rough surface without loss reflects at once: E of GGX with Smith's height-correlated shadowing and masking
//! (Heitz 2014), by alpha and cosine.

use std::sync::LazyLock;

/// Cosines, and roughnesses, at which E is known.
pub const STEPS: usize = 32;

/// E of one alpha.
pub struct Energy {
    /// At the cosines (k / (STEPS - 1))^2.
    pub by_cosine: [f64; STEPS],
    /// 2 times the integral of E(mu) mu dmu.
    pub average: f64,
}

impl Energy {
    /// Linear in the root of alpha between the table's.
    pub fn of(alpha: f64) -> Self {
        let place = alpha.clamp(0.0, 1.0).sqrt() * (STEPS - 1) as f64;
        let low = (place as usize).min(STEPS - 2);
        let t = place - low as f64;
        let by_cosine: [f64; STEPS] = std::array::from_fn(|k| (1.0 - t) * TABLE[low][k] + t * TABLE[low + 1][k]);
        Energy { by_cosine, average: sums(&by_cosine)[STEPS - 1] }
    }
}

/// By roughness k / (STEPS - 1), then by cosine.
static TABLE: LazyLock<Vec<[f64; STEPS]>> = LazyLock::new(|| {
    let share = |k: usize| k as f64 / (STEPS - 1) as f64;
    (0..STEPS).map(|r| std::array::from_fn(|k| reflected(share(r) * share(r), share(k) * share(k)))).collect()
});

/// 2 times the integrals of what is linear in t = sqrt(mu) between the table's places, up to each of them: 2 E mu dmu =
/// 4 E t^3 dt.
pub fn sums(by_cosine: &[f64; STEPS]) -> [f64; STEPS] {
    let step = 1.0 / (STEPS - 1) as f64;
    let mut sums = [0.0; STEPS];
    for (k, pair) in by_cosine.windows(2).enumerate() {
        let (a, b) = (k as f64 * step, (k + 1) as f64 * step);
        let slope = (pair[1] - pair[0]) / step;
        let fourth = |x: f64| x * x * x * x;
        let (moment_4, moment_5) = ((fourth(b) - fourth(a)) / 4.0, (fourth(b) * b - fourth(a) * a) / 5.0);
        sums[k + 1] = sums[k] + 4.0 * ((pair[0] - slope * a) * moment_4 + slope * moment_5);
    }
    sums
}

/// E = integral of G2/G1 over the visible normals, by a grid of their samples (Dupuy and Benyoub 2023).
fn reflected(alpha: f64, mu: f64) -> f64 {
    const ROWS: usize = 64;
    const COLUMNS: usize = 32;
    let alpha2 = alpha * alpha;
    if alpha == 0.0 {
        return 1.0;
    }
    let mu = mu.max(1e-6);
    let sin = (1.0 - mu * mu).max(0.0).sqrt();
    let length = (alpha2 * sin * sin + mu * mu).sqrt();
    let standard = [alpha * sin / length, mu / length];
    let mut sum = 0.0;
    for row in 0..ROWS {
        let z = 1.0 - (row as f64 + 0.5) / ROWS as f64 * (1.0 + standard[1]);
        let radius = (1.0 - z * z).max(0.0).sqrt();
        for column in 0..COLUMNS {
            let angle = std::f64::consts::PI * (column as f64 + 0.5) / COLUMNS as f64;
            let h =
                [alpha * (radius * libm::cos(angle) + standard[0]), alpha * radius * libm::sin(angle), z + standard[1]];
            let h_length = h.iter().map(|x| x * x).sum::<f64>().sqrt();
            let o_h = (sin * h[0] + mu * h[2]) / h_length;
            let cos_i = 2.0 * o_h * h[2] / h_length - mu;
            if cos_i <= 0.0 {
                continue;
            }
            // G2/G1 = (1 + L(o)) / (1 + L(o) + L(i)), 1 + 2 L(c) = sqrt(1 + alpha^2 tan^2).
            let root = |cos: f64| (1.0 + alpha2 * (1.0 - cos * cos).max(0.0) / (cos * cos)).sqrt();
            let (of_o, of_i) = (root(mu), root(cos_i));
            sum += (1.0 + of_o) / (of_o + of_i);
        }
    }
    sum / (ROWS * COLUMNS) as f64
}
