//! The volume along a ray within one cell. Trilinear interpolation along a straight line is a cubic; here it has the form
//! of Bernstein, whose four coefficients are averages of interpolated values.

use crate::volume::Real;

/// The values at the corners of a cell, i fastest, then j, then k.
pub type Corners<R> = [R; 8];
/// Where N rays meet a cell: weights of its farther corners, axis by axis.
pub type Weights<R, const N: usize> = [[R; N]; 3];

/// The volume along N rays from where each enters a cell to where it leaves it: the coefficients of Bernstein's form.
#[derive(Clone, Copy, Debug)]
pub struct Cubic<R, const N: usize>([[R; N]; 4]);

impl<R: Real, const N: usize> Cubic<R, N> {
    /// The cubic between two places of each ray. Its coefficients are the trilinear form with the weights of the one
    /// place along some axes and those of the other along the rest.
    #[inline(always)]
    pub fn between(corners: &Corners<R>, enter: &Weights<R, N>, leave: &Weights<R, N>) -> Self {
        let zero = R::from_f32(0.0);
        // The first of the indices is 0 with the weight at the entrance along i and 1 with that at the exit; so on for j, k.
        let mut rows = [[[zero; N]; 4]; 2];
        for r in 0..4 {
            let (near, step) = (corners[2 * r], corners[2 * r + 1] - corners[2 * r]);
            for (row, place) in rows.iter_mut().zip([enter, leave]) {
                for l in 0..N {
                    row[r][l] = near + step * place[0][l];
                }
            }
        }
        let mut planes = [[[[zero; N]; 2]; 2]; 2];
        for i in 0..2 {
            for k in 0..2 {
                for (j, place) in [enter, leave].into_iter().enumerate() {
                    for l in 0..N {
                        let (near, far) = (rows[i][2 * k][l], rows[i][2 * k + 1][l]);
                        planes[i][j][k][l] = near + (far - near) * place[1][l];
                    }
                }
            }
        }
        let value = |i: usize, j: usize, k: usize, l: usize| {
            let (near, far) = (planes[i][j][0][l], planes[i][j][1][l]);
            near + (far - near) * [enter, leave][k][2][l]
        };
        let third = R::from_weight(1.0 / 3.0);
        let mut form = [[zero; N]; 4];
        for l in 0..N {
            form[0][l] = value(0, 0, 0, l);
            form[1][l] = (value(1, 0, 0, l) + value(0, 1, 0, l) + value(0, 0, 1, l)) * third;
            form[2][l] = (value(1, 1, 0, l) + value(1, 0, 1, l) + value(0, 1, 1, l)) * third;
            form[3][l] = value(1, 1, 1, l);
        }
        Self(form)
    }

    /// The larger of the values at both ends.
    #[inline(always)]
    pub fn largest_end(&self) -> [R; N] {
        std::array::from_fn(|l| larger(self.0[0][l], self.0[3][l]))
    }

    /// A number that the cubic does not exceed: it lies within the hull of its coefficients.
    #[inline(always)]
    pub fn bound(&self) -> [R; N] {
        let Self([b0, b1, b2, b3]) = self;
        std::array::from_fn(|l| larger(larger(b0[l], b1[l]), larger(b2[l], b3[l])))
    }

    /// The largest value.
    #[inline(always)]
    pub fn largest(&self) -> [R; N] {
        let mut value = self.largest_end();
        let at = self.summit();
        for l in 0..N {
            value[l] = larger(value[l], self.at(l, at[l]));
        }
        value
    }

    /// Where the cubic has its local maximum, from 0 at the entrance to 1 at the exit; any place where it has none there.
    #[inline(always)]
    fn summit(&self) -> [R; N] {
        let Self([b0, b1, b2, b3]) = self;
        let [zero, one, tiny] = [0.0, 1.0, 1e-30].map(R::from_f32);
        let mut at = [zero; N];
        for l in 0..N {
            // A third of the derivative is d0·(1 − u)² + 2·d1·u·(1 − u) + d2·u²; divided by the largest of the three, so
            // that no square overflows.
            let d = [b1[l] - b0[l], b2[l] - b1[l], b3[l] - b2[l]];
            let largest = d.map(|d| larger(d, zero - d)).into_iter().fold(tiny, larger);
            let scale = one / largest;
            let [d0, d1, d2] = d.map(|d| d * scale);
            let (curve, bend) = (d0 - d1 - d1 + d2, d1 - d0);
            let root = larger(d1 * d1 - d0 * d2, zero).square_root();
            // Of the two roots that where the derivative falls, without a difference of almost equal numbers.
            let (above, below) =
                if bend > zero { (zero - (bend + root), curve) } else { (d0, root - bend) };
            let below = if below > tiny { below } else if below < zero - tiny { below } else { tiny };
            let u = above / below;
            let u = if u > zero { u } else { zero };
            at[l] = if u < one { u } else { one };
        }
        at
    }

    /// The value at `u` of ray `l`, by de Casteljau's scheme.
    #[inline(always)]
    fn at(&self, l: usize, u: R) -> R {
        let mix = |a: R, b: R| a + (b - a) * u;
        let [b0, b1, b2, b3] = [0, 1, 2, 3].map(|n: usize| self.0[n][l]);
        let (c0, c1, c2) = (mix(b0, b1), mix(b1, b2), mix(b2, b3));
        mix(mix(c0, c1), mix(c1, c2))
    }

    /// The mean value, as Simpson's rule gives it: exact for a cubic.
    #[inline(always)]
    pub fn mean(&self) -> [R; N] {
        let (Self([b0, b1, b2, b3]), quarter) = (self, R::from_f32(0.25));
        std::array::from_fn(|l| ((b0[l] + b3[l]) + (b1[l] + b2[l])) * quarter)
    }
}

/// The larger of two numbers; the second where the first is NaN.
#[inline(always)]
pub fn larger<R: Real>(a: R, b: R) -> R {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers from −1 to 1 without order.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 88_172_645_463_325_252u64;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn trilinear(corners: &[f64; 8], [x, y, z]: [f64; 3]) -> f64 {
        (0..8)
            .map(|n| {
                let weight = |bit: usize, w: f64| if n >> bit & 1 == 1 { w } else { 1.0 - w };
                corners[n] * weight(0, x) * weight(1, y) * weight(2, z)
            })
            .sum()
    }

    #[test]
    fn the_maximum_and_the_mean_are_those_of_many_samples() {
        let mut number = numbers();
        let mut inside = 0;
        for _ in 0..5000 {
            let corners: [f64; 8] = std::array::from_fn(|_| number() * 1000.0);
            let mut place = || [0; 3].map(|_| 0.5 + 0.5 * number());
            let (enter, leave) = (place(), place());
            let cubic = Cubic::<f64, 1>::between(&corners, &enter.map(|w| [w]), &leave.map(|w| [w]));
            let steps = 4000;
            let values: Vec<f64> = (0..=steps)
                .map(|n| {
                    let u = f64::from(n) / f64::from(steps);
                    trilinear(&corners, std::array::from_fn(|a| enter[a] + (leave[a] - enter[a]) * u))
                })
                .collect();
            let largest = values.iter().copied().fold(f64::MIN, f64::max);
            let [found] = cubic.largest();
            assert!(found >= largest - 1e-9 && found <= largest + 1e-3, "{found} for {largest}");
            let [bound] = cubic.bound();
            assert!(found <= bound + 1e-9);
            inside += u32::from(found > cubic.largest_end()[0] + 1e-9);
            // Simpson's rule with one interval.
            let simpson = (values[0] + 4.0 * values[steps as usize / 2] + values[steps as usize]) / 6.0;
            assert!((cubic.mean()[0] - simpson).abs() < 1e-9);
        }
        assert!(inside > 300, "the maximum lies between both ends {inside} times");
    }

    #[test]
    fn numbers_of_every_size_have_their_maximum() {
        for size in [1e-20f32, 1.0, 1e18, 1e30] {
            // Along the diagonal: 0, up to the middle, and back.
            let corners = [0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0].map(|c: f32| c * size);
            let cubic = Cubic::<f32, 1>::between(&corners, &[[0.0]; 3], &[[1.0]; 3]);
            // 3·u·(1 − u)² is largest at u = 1/3.
            let expected = size * 4.0 / 9.0;
            let [found] = cubic.largest();
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} for {expected}");
        }
        let flat = Cubic::<f32, 1>::between(&[7.0; 8], &[[0.1]; 3], &[[0.8]; 3]);
        assert!((flat.largest()[0] - 7.0).abs() < 1e-5 && (flat.mean()[0] - 7.0).abs() < 1e-5);
    }

    #[test]
    fn a_corner_without_a_number_leaves_none() {
        for n in 0..8 {
            let mut corners = [1.0f32; 8];
            corners[n] = f32::NAN;
            let cubic = Cubic::<f32, 1>::between(&corners, &[[0.0]; 3], &[[1.0]; 3]);
            assert!(cubic.largest()[0].is_nan() && cubic.mean()[0].is_nan(), "corner {n}");
        }
    }
}
