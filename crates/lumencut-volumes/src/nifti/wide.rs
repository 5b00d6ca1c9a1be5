//! Numbers with 64 significant bits, with which nibabel converts quaternions to directions.

use std::ops::{Add, Div, Mul, Sub};

/// The sum of two numbers; the second is at most half of the first one's last binary digit.
#[derive(Clone, Copy)]
pub(crate) struct Wide(f64, f64);

const SPLIT: f64 = 134_217_729.0;

impl Wide {
    pub(crate) const ZERO: Self = Self(0.0, 0.0);

    pub(crate) fn narrow(self) -> f64 {
        self.0
    }

    pub(crate) fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        let rest = self.sub_exact(product(root, root));
        rounded(root, rest.0 / (2.0 * root))
    }

    fn sub_exact(self, other: Self) -> Self {
        let high = sum(self.0, -other.0);
        let low = sum(self.1, -other.1);
        let first = sum(high.0, high.1 + low.0);
        sum(first.0, first.1 + low.1)
    }
}

impl From<f64> for Wide {
    fn from(value: f64) -> Self {
        Self(value, 0.0)
    }
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let total = self.sub_exact(Self(-other.0, -other.1));
        rounded(total.0, total.1)
    }
}

impl Sub for Wide {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self(-other.0, -other.1)
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let whole = product(self.0, other.0);
        rounded(whole.0, whole.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let whole = product(first, other.0);
        let rest = self.sub_exact(Self(whole.0, whole.1 + first * other.1));
        rounded(first, rest.0 / other.0)
    }
}

fn sum(one: f64, other: f64) -> Wide {
    let total = one + other;
    let back = total - one;
    Wide(total, (one - (total - back)) + (other - back))
}

fn product(one: f64, other: f64) -> Wide {
    let halves = |value: f64| {
        let shifted = SPLIT * value;
        let high = shifted - (shifted - value);
        (high, value - high)
    };
    let (total, (a, b), (c, d)) = (one * other, halves(one), halves(other));
    Wide(total, ((a * c - total) + a * d + b * c) + b * d)
}

/// A sum, rounded to 64 significant bits (ties to even).
fn rounded(high: f64, low: f64) -> Wide {
    let Wide(high, low) = sum(high, low);
    if high == 0.0 || !high.is_finite() || !low.is_finite() {
        return Wide(high, 0.0);
    }
    // The last of 64 bits is 2⁻⁶³ of the first one; the sum with 1.5 · 2⁵² of it has no digits after it.
    let first = f64::from_bits(high.to_bits() & (0x7ff << 52));
    let shift = 1.5 * first / 2048.0;
    sum(high, (low + shift) - shift)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_have_64_bits() {
        let wide = |value: f64| Wide::from(value);
        // A third with 64 bits is 0xaaaaaaaaaaaaaaab · 2⁻⁶⁵.
        let third = wide(1.0) / wide(3.0);
        assert_eq!(third.0, 1.0 / 3.0);
        assert_eq!(third.1 * 2_f64.powi(65), f64::from(0x2ab_u16));
        let root = wide(2.0).sqrt();
        assert_eq!((root * root).narrow(), 2.0);
        assert_eq!((wide(1.0) - wide(2_f64.powi(-63))).narrow(), 1.0);
        assert_eq!((wide(1.0) + wide(2_f64.powi(-70))).1, 0.0);
    }
}
