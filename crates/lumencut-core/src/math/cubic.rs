//! The volume along a ray within one cell, as a cubic in Bernstein form. Its coefficients average
//! interpolated values.

use super::lanes::larger;
use crate::volume::Real;

/// Divisors below this count as 0.
pub const TINY: f32 = 1e-30;

/// The values at the corners of the cells of N rays, i fastest, then j, then k.
pub(crate) type Corners<R, const N: usize> = [[R; N]; 8];
/// Positions of N rays in their cells, as weights of the farther corners, axis by axis.
pub(crate) type Weights<R, const N: usize> = [[R; N]; 3];

/// The volume along N rays between entering and leaving a cell: Bernstein coefficients.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cubic<R, const N: usize>([[R; N]; 4]);

impl<R: Real, const N: usize> Cubic<R, N> {
    /// The cubic between two positions of each ray: its coefficients mix the weights of both, axis by axis.
    #[inline(always)]
    pub(crate) fn between(corners: &Corners<R, N>, enter: &Weights<R, N>, leave: &Weights<R, N>) -> Self {
        let third = R::from_weight(1.0 / 3.0);
        let mut form = [[R::from_f32(0.0); N]; 4];
        // The three letters of a name are for i, j and k: e where the ray enters, l where it leaves.
        for n in 0..N {
            let [e, l] = [enter, leave].map(|place| [place[0][n], place[1][n], place[2][n]]);
            let [xe, xl] = [e[0], l[0]].map(|x| {
                let row = |r: usize| corners[2 * r][n] + (corners[2 * r + 1][n] - corners[2 * r][n]) * x;
                [row(0), row(1), row(2), row(3)]
            });
            let plane = |x: [R; 4], y: R| [x[0] + (x[1] - x[0]) * y, x[2] + (x[3] - x[2]) * y];
            let value = |[near, far]: [R; 2], z: R| near + (far - near) * z;
            let (ee, el, le, ll) = (plane(xe, e[1]), plane(xe, l[1]), plane(xl, e[1]), plane(xl, l[1]));
            form[0][n] = value(ee, e[2]);
            form[1][n] = (value(le, e[2]) + value(el, e[2]) + value(ee, l[2])) * third;
            form[2][n] = (value(ll, e[2]) + value(le, l[2]) + value(el, l[2])) * third;
            form[3][n] = value(ll, l[2]);
        }
        Self(form)
    }

    /// An upper bound on the values: the cubic lies within the hull of its coefficients.
    #[inline(always)]
    pub(crate) fn bound(&self) -> [R; N] {
        let mut bound = self.0[0];
        for form in &self.0[1..] {
            for n in 0..N {
                bound[n] = larger(bound[n], form[n]);
            }
        }
        bound
    }

    #[inline(always)]
    pub(crate) fn largest_end(&self) -> [R; N] {
        let mut largest = self.0[0];
        for n in 0..N {
            largest[n] = larger(largest[n], self.0[3][n]);
        }
        largest
    }

    /// The value at the local maximum; if there is none, a value that does not exceed the larger end.
    #[inline(always)]
    pub(crate) fn at_summit(&self) -> [R; N] {
        let mut value = self.0[0];
        for n in 0..N {
            let form = [self.0[0][n], self.0[1][n], self.0[2][n], self.0[3][n]];
            value[n] = at(form, summit(form));
        }
        value
    }

    /// The mean value by Simpson's rule, which is exact for a cubic.
    #[inline(always)]
    pub(crate) fn mean(&self) -> [R; N] {
        let (mut mean, quarter) = (self.0[0], R::from_f32(0.25));
        for n in 0..N {
            mean[n] = ((self.0[0][n] + self.0[3][n]) + (self.0[1][n] + self.0[2][n])) * quarter;
        }
        mean
    }
}

/// Position (0 to 1) of the local maximum of a Bernstein cubic; arbitrary if it has none.
#[inline(always)]
fn summit<R: Real>([b0, b1, b2, b3]: [R; 4]) -> R {
    let (zero, one, tiny) = (R::from_f32(0.0), R::from_f32(1.0), R::from_f32(TINY));
    // A third of the derivative is d0·(1 − u)² + 2·d1·u·(1 − u) + d2·u², scaled so that no square overflows.
    let (d0, d1, d2) = (b1 - b0, b2 - b1, b3 - b2);
    let size = |d: R| larger(d, zero - d);
    let scale = one / larger(larger(size(d0), size(d1)), larger(size(d2), tiny));
    let (d0, d1, d2) = (d0 * scale, d1 * scale, d2 * scale);
    let (curve, bend) = (d0 - d1 - d1 + d2, d1 - d0);
    let root = larger(d1 * d1 - d0 * d2, zero).square_root();
    // The root at which the derivative turns negative, computed without subtracting almost equal numbers.
    let above = if bend > zero { zero - (bend + root) } else { d0 };
    let below = if bend > zero { curve } else { root - bend };
    let below = if size(below) > tiny { below } else { tiny };
    let u = above / below;
    let u = if u > zero { u } else { zero };
    if u < one { u } else { one }
}

#[inline(always)]
fn at<R: Real>([b0, b1, b2, b3]: [R; 4], u: R) -> R {
    let mix = |a: R, b: R| a + (b - a) * u;
    let (c0, c1, c2) = (mix(b0, b1), mix(b1, b2), mix(b2, b3));
    mix(mix(c0, c1), mix(c1, c2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn largest_of<R: Real>(cubic: &Cubic<R, 1>) -> R {
        larger(cubic.largest_end()[0], cubic.at_summit()[0])
    }

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
            let cubic =
                Cubic::<f64, 1>::between(&corners.map(|c| [c]), &enter.map(|w| [w]), &leave.map(|w| [w]));
            let steps = 4000;
            let values: Vec<f64> = (0..=steps)
                .map(|n| {
                    let u = f64::from(n) / f64::from(steps);
                    trilinear(&corners, std::array::from_fn(|a| enter[a] + (leave[a] - enter[a]) * u))
                })
                .collect();
            let largest = values.iter().copied().fold(f64::MIN, f64::max);
            let found = largest_of(&cubic);
            assert!(found >= largest - 1e-9 && found <= largest + 1e-3, "{found} for {largest}");
            let [bound] = cubic.bound();
            assert!(found <= bound + 1e-9);
            inside += u32::from(found > values[0].max(values[steps as usize]) + 1e-9);
            let simpson = (values[0] + 4.0 * values[steps as usize / 2] + values[steps as usize]) / 6.0;
            assert!((cubic.mean()[0] - simpson).abs() < 1e-9);
        }
        assert!(inside > 300, "the maximum lies between both ends {inside} times");
    }

    #[test]
    fn numbers_of_every_size_have_their_maximum() {
        for size in [1e-20f32, 1.0, 1e18, 1e30] {
            // Values along the cell's diagonal: 0 at the start, up to the middle, and back to 0.
            let corners = [0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0].map(|c: f32| c * size);
            let cubic = Cubic::<f32, 1>::between(&corners.map(|c| [c]), &[[0.0]; 3], &[[1.0]; 3]);
            // 3·u·(1 − u)² is largest at u = 1/3.
            let expected = size * 4.0 / 9.0;
            let found = largest_of(&cubic);
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} for {expected}");
        }
        let flat = Cubic::<f32, 1>::between(&[[7.0]; 8], &[[0.1]; 3], &[[0.8]; 3]);
        assert!((largest_of(&flat) - 7.0).abs() < 1e-5 && (flat.mean()[0] - 7.0).abs() < 1e-5);
    }

    #[test]
    fn a_corner_without_a_number_leaves_none() {
        for n in 0..8 {
            let mut corners = [1.0f32; 8];
            corners[n] = f32::NAN;
            let cubic = Cubic::<f32, 1>::between(&corners.map(|c| [c]), &[[0.0]; 3], &[[1.0]; 3]);
            assert!(largest_of(&cubic).is_nan() && cubic.mean()[0].is_nan(), "corner {n}");
        }
    }
}
