//! Opacity at another thickness: 1 − (1 − α)^h, without the system's logarithm, so equal on every platform.

use super::lanes::{FAN, larger, smaller};

pub const ROOT_HALF: u32 = 0x3F35_04F3;

/// The opacity of a layer `thickness` ≥ 0 mm thick, with `opacity` per mm.
#[inline(always)]
pub(crate) fn of_thickness(opacity: &[f32; FAN], thickness: &[f32; FAN]) -> [f32; FAN] {
    let mut result = [0.0; FAN];
    for l in 0..FAN {
        let through =
            one_minus_power_of_two(thickness[l] * log2_of_one_minus(smaller(opacity[l], 1.0 - 1e-7)));
        result[l] = if opacity[l] >= 1.0 { 1.0 } else { through };
    }
    result
}

/// log₂(1 − a) for a in [0, 1), to a few units in the last place, also for small a.
#[inline(always)]
fn log2_of_one_minus(a: f32) -> f32 {
    // 1 − a = 2^e · m with m between √½ and √2; log₂ m = 2/ln 2 · artanh((m − 1)/(m + 1)).
    let rest = 1.0 - a;
    let exponent = (rest.to_bits().wrapping_sub(ROOT_HALF) as i32) >> 23;
    let m = f32::from_bits(rest.to_bits().wrapping_sub((exponent << 23) as u32));
    // If the exponent is 0, m − 1 equals −a; −a avoids the rounding of 1 − a.
    let above_one = if exponent == 0 { -a } else { m - 1.0 };
    let s = above_one / (above_one + 2.0);
    let s2 = s * s;
    let series = 1.0 + s2 * (1.0 / 3.0 + s2 * (0.2 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0))));
    exponent as f32 + s * series * std::f32::consts::LOG2_E * 2.0
}

/// 1 − 2^y for y ≤ 0, to a few units in the last place, also for small y.
#[inline(always)]
pub(crate) fn one_minus_power_of_two(y: f32) -> f32 {
    // y = n + r with |r| ≤ ½; 2^y − 1 = 2^n·(2^r − 1) + (2^n − 1). Adding 1.5·2²³ rounds y to the integer n.
    const ONES: f32 = 12_582_912.0;
    let y = larger(y, -125.0);
    let shifted = y + ONES;
    let n = shifted - ONES;
    let r = (y - n) * std::f32::consts::LN_2;
    let series = 1.0
        + r * (0.5
            + r * (1.0 / 6.0
                + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0))))));
    let scale = f32::from_bits(((n as i32 + 127) << 23) as u32);
    (1.0 - scale) - scale * (r * series)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(opacity: f32, thickness: f32) -> f64 {
        -(f64::from(thickness) * (-f64::from(opacity)).ln_1p()).exp_m1()
    }

    #[test]
    fn opacities_agree_with_the_power_to_a_few_units_in_the_last_place() {
        for o in 0..=4000 {
            let opacity = 10f32.powf(-(o as f32) / 500.0) * 0.999_99;
            let thickness = std::array::from_fn(|l| 1e-3 * 3f32.powf(l as f32 * 0.6));
            let found = of_thickness(&[opacity; FAN], &thickness);
            for l in 0..FAN {
                let expected = exact(opacity, thickness[l]);
                let error = (f64::from(found[l]) - expected).abs() / expected;
                assert!(error < 2e-6, "{opacity} {} {} {expected} {error}", thickness[l], found[l]);
            }
        }
    }

    #[test]
    fn nothing_stays_nothing_and_all_stays_all() {
        let thickness = std::array::from_fn(|l| 0.001 + l as f32);
        assert_eq!(of_thickness(&[0.0; FAN], &thickness), [0.0; FAN]);
        assert_eq!(of_thickness(&[1.0; FAN], &thickness), [1.0; FAN]);
    }
}
