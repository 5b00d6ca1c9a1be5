//! Random numbers without state: hashes of seed and position. So neither evaluation order nor threads change a phantom.

/// A hash of two numbers (SplitMix64's finaliser over a Weyl sequence).
#[inline(always)]
pub fn hash(seed: u64, place: u64) -> u64 {
    let mut x = seed ^ place.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// A uniform number in [0, 1).
#[inline(always)]
pub fn uniform(seed: u64, place: u64) -> f64 {
    (hash(seed, place) >> 11) as f64 / (1u64 << 53) as f64
}

/// A nearly normal number within ±4.9, mean 0, standard deviation 1. One multiplication adds the eight bytes of a hash.
#[inline(always)]
pub(crate) fn normal(seed: u64, place: u64) -> f32 {
    const BYTES: u64 = 0x00FF_00FF_00FF_00FF;
    const MEAN: f32 = 8.0 * 127.5;
    // A uniform random byte has the variance (256² − 1) / 12; the variances of eight bytes add up.
    const DEVIATION: f32 = 209.020_73;
    let h = hash(seed, place);
    let pairs = (h & BYTES) + ((h >> 8) & BYTES);
    let sum = pairs.wrapping_mul(0x0001_0001_0001_0001) >> 48;
    (sum as f32 - MEAN) / DEVIATION
}

/// Smooth noise in [0, 1] on one slice: a random lattice with smoothstep interpolation.
pub(crate) struct SmoothNoise {
    origin: [f32; 2],
    per_mm: f32,
    columns: usize,
    rows: usize,
    nodes: Vec<f32>,
}

impl SmoothNoise {
    /// Noise at height `z`, over the rectangle from `low` to `high` (mm), with wavelengths in the plane and across slices (mm).
    pub(crate) fn new(
        seed: u64,
        wavelength: f32,
        wavelength_z: f32,
        z: f32,
        low: [f32; 2],
        high: [f32; 2],
    ) -> Self {
        let count = |axis: usize| ((high[axis] - low[axis]) / wavelength).ceil().max(0.0) as usize + 2;
        let (columns, rows) = (count(0), count(1));
        let layer = (z / wavelength_z).floor();
        let t = smooth_step(z / wavelength_z - layer);
        let layer = layer as i64;
        let node = |n: usize| {
            let at = |k: i64| uniform(hash(seed, k as u64), n as u64) as f32;
            at(layer) + t * (at(layer + 1) - at(layer))
        };
        let nodes = (0..columns * rows).map(node).collect();
        Self { origin: low, per_mm: 1.0 / wavelength, columns, rows, nodes }
    }

    /// The noise at (x, y) (mm).
    #[inline(always)]
    pub(crate) fn at(&self, x: f32, y: f32) -> f32 {
        let (u, v) = ((x - self.origin[0]) * self.per_mm, (y - self.origin[1]) * self.per_mm);
        let i = (u.max(0.0) as usize).min(self.columns - 2);
        let j = (v.max(0.0) as usize).min(self.rows - 2);
        let (s, t) = (smooth_step(u - i as f32), smooth_step(v - j as f32));
        let n = j * self.columns + i;
        let (a, b) = (self.nodes[n], self.nodes[n + 1]);
        let (c, d) = (self.nodes[n + self.columns], self.nodes[n + self.columns + 1]);
        let (near, far) = (a + s * (b - a), c + s * (d - c));
        near + t * (far - near)
    }
}

/// The smoothstep function; 0 below 0 and 1 above 1.
#[inline(always)]
pub(crate) fn smooth_step(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_has_mean_zero_and_deviation_one() {
        let n = 200_000u64;
        let values: Vec<f64> = (0..n).map(|i| f64::from(normal(7, i))).collect();
        let mean = values.iter().sum::<f64>() / n as f64;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n as f64;
        assert!(mean.abs() < 0.01, "{mean}");
        assert!((variance - 1.0).abs() < 0.01, "{variance}");
    }

    #[test]
    fn smooth_noise_is_continuous_across_cells_and_slices() {
        let field = |z: f32| SmoothNoise::new(3, 10.0, 20.0, z, [-50.0; 2], [50.0; 2]);
        let here = field(19.999);
        for x in [-40.0f32, -0.001, 9.999] {
            assert!((here.at(x, 5.0) - here.at(x + 0.002, 5.0)).abs() < 1e-3);
        }
        assert!((here.at(3.0, 4.0) - field(20.001).at(3.0, 4.0)).abs() < 1e-3);
    }
}
