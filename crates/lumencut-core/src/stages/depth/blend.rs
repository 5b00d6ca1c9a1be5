//! Level selection: which two levels of detail a pixel blends (paper section 3.1.4).

use crate::math::lanes::{PIXELS, smaller};

pub(super) struct LevelBlend {
    /// k0, the finer level, stored as a float; integers up to 2²⁴ compare exactly.
    fine: [f32; PIXELS],
    fine_weight: [f32; PIXELS],
    /// The weight of k0 + 1; 0 if k0 = N.
    coarse_weight: [f32; PIXELS],
}

impl LevelBlend {
    /// Selects the levels at distance D: f = √(N·D/σ) lies between the levels ⌊f⌋ and ⌊f⌋ + 1, capped at N.
    #[inline(always)]
    pub(super) fn select(selection: f32, coarsest: usize, distance: &[f32; PIXELS]) -> Self {
        let zero = [0.0; PIXELS];
        let mut blend = Self { fine: zero, fine_weight: zero, coarse_weight: zero };
        let last = coarsest as f32;
        for l in 0..PIXELS {
            let f = smaller((selection * distance[l]).sqrt(), last);
            let fine = (f as i32) as f32;
            blend.fine[l] = fine;
            blend.fine_weight[l] = fine + 1.0 - f;
            blend.coarse_weight[l] = f - fine;
        }
        blend
    }

    /// Bit k is set if a pixel needs level k.
    #[inline(always)]
    pub(super) fn needed(&self) -> u32 {
        let (mut bits, mut all) = ([0u32; PIXELS], 0);
        for l in 0..PIXELS {
            let pair = if self.coarse_weight[l] > 0.0 { 3 } else { 1 };
            bits[l] = pair << (self.fine[l] as i32);
        }
        for l in 0..PIXELS {
            all |= bits[l];
        }
        all
    }

    #[inline(always)]
    pub(super) fn weight(&self, k: f32, l: usize) -> f32 {
        let coarse = if self.fine[l] + 1.0 == k { self.coarse_weight[l] } else { 0.0 };
        if self.fine[l] == k { self.fine_weight[l] } else { coarse }
    }
}
