//! Lanes and instruction sets: kernels are written once over small arrays, compiled once per instruction set, and
//! chosen at run time. The compiler never fuses a multiplication with an addition here and every square root is
//! correctly rounded, so all instruction sets give the same bits.

/// The width of a tile (pixels).
pub(crate) const COLUMNS: usize = 16;
/// The height of a tile (pixels).
pub(crate) const ROWS: usize = 8;
pub(crate) const PIXELS: usize = COLUMNS * ROWS;
/// Number of children of a node and of slots of a bundle; they are tested together.
pub const FAN: usize = 16;
pub(crate) const PART_SIDE: usize = 8;
pub(crate) const PART_PIXELS: usize = PART_SIDE * PART_SIDE;
pub(crate) const PARTS: usize = PIXELS / PART_PIXELS;

/// A key above that of every piece: no piece was found yet. Finite, so that no kernel ever meets inf or NaN.
pub const UNSET: f32 = 1e30;
/// The depth of a missing piece; it stays above [`UNSET`] after any addition.
pub const ABSENT: f32 = 3e30;
/// Coordinate of slots without a point (mm): far outside every scene, but with a finite square.
pub const FAR: f32 = 1e9;
/// A key that no piece beats, for pixels that take no part in the search.
pub const EXCLUDED: f32 = -1e30;

/// The larger of two numbers, the second if the first is NaN: one instruction; `f32::max` needs three.
#[inline(always)]
pub fn larger<R: PartialOrd>(a: R, b: R) -> R {
    if a > b { a } else { b }
}

/// The smaller of two numbers that are not NaN.
#[inline(always)]
pub fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// An integer that sorts like the number, since the compiler vectorises only reductions of integers.
#[inline(always)]
fn ordered(number: f32) -> i32 {
    let bits = number.to_bits() as i32;
    bits ^ ((bits >> 31) & i32::MAX)
}

#[inline(always)]
fn number(ordered: i32) -> f32 {
    f32::from_bits((ordered ^ ((ordered >> 31) & i32::MAX)) as u32)
}

#[inline(always)]
pub fn largest<const N: usize>(numbers: &[f32; N]) -> f32 {
    let mut most = i32::MIN;
    for l in 0..N {
        most = most.max(ordered(numbers[l]));
    }
    number(most)
}

/// The smallest of a node's numbers, none of them NaN.
#[inline(always)]
pub fn smallest(numbers: &[f32; FAN]) -> f32 {
    let mut least = i32::MAX;
    for n in 0..FAN {
        least = least.min(ordered(numbers[n]));
    }
    number(least)
}

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Bits([u32; FAN]);

impl Bits {
    /// Bit n for lane n. The constants are hidden from the compiler, which would otherwise split the vectors.
    #[inline(always)]
    pub fn new() -> Self {
        let mut bits = [1; FAN];
        for n in 0..FAN {
            bits[n] <<= n;
        }
        Self(std::hint::black_box(bits))
    }

    /// Bit n is set if number n is at most `limit`.
    #[inline(always)]
    pub fn within(&self, numbers: &[f32; FAN], limit: f32) -> u32 {
        let mut all = 0;
        for n in 0..FAN {
            all |= if numbers[n] <= limit { self.0[n] } else { 0 };
        }
        all
    }
}

impl Default for Bits {
    fn default() -> Self {
        Self::new()
    }
}

#[inline(always)]
pub fn places(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = bits.trailing_zeros() as usize;
        let any = bits != 0;
        bits &= bits.wrapping_sub(1);
        any.then_some(place)
    })
}

/// The distance along one axis from the interval `center` ± `half` to the interval from `low` to `high`.
#[inline(always)]
pub(crate) fn gap(low: f32, high: f32, center: f32, half: f32) -> f32 {
    larger(larger(low - center, center - high) - half, 0.0)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// The instructions of every processor of the target (SSE2, NEON, wasm simd128 if enabled).
    Baseline,
    /// x86-64 with AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// x86-64 with AVX-512 F, BW, DQ and VL.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)]
        let mut sets = vec![Self::Baseline];
        #[cfg(target_arch = "x86_64")]
        {
            if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("bmi2") {
                sets.push(Self::Avx2);
            }
            if ["avx512f", "avx512bw", "avx512dq", "avx512vl"].iter().all(|f| has(f)) {
                sets.push(Self::Avx512);
            }
        }
        sets
    }

    pub fn widest() -> Self {
        static WIDEST: std::sync::OnceLock<Isa> = std::sync::OnceLock::new();
        *WIDEST.get_or_init(|| Self::available().pop().unwrap_or(Self::Baseline))
    }
}

#[cfg(target_arch = "x86_64")]
fn has(feature: &str) -> bool {
    match feature {
        "avx512f" => std::is_x86_feature_detected!("avx512f"),
        "avx512bw" => std::is_x86_feature_detected!("avx512bw"),
        "avx512dq" => std::is_x86_feature_detected!("avx512dq"),
        _ => std::is_x86_feature_detected!("avx512vl"),
    }
}

/// Work compiled for every instruction set; `run` and all it calls must be `#[inline(always)]`.
pub trait Kernel {
    /// The result.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
}

/// Runs `kernel` as compiled for `isa`, one of [`Isa::available`] (others run as baseline).
pub fn dispatch<K: Kernel>(isa: Isa, kernel: K) -> K::Output {
    match isa {
        Isa::Baseline => baseline(kernel),
        #[cfg(target_arch = "x86_64")]
        Isa::Avx2 | Isa::Avx512 => x86::dispatch(isa, kernel),
    }
}

/// Not inlined: optimising the kernel in each caller would take a third of the compile time.
#[cfg_attr(target_arch = "x86_64", inline(never))]
fn baseline<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Isa, Kernel, baseline};

    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    fn avx2<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt")]
    fn avx512<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    /// The only `unsafe` code of the crate.
    #[allow(unsafe_code)]
    pub(super) fn dispatch<K: Kernel>(isa: Isa, kernel: K) -> K::Output {
        let widest = Isa::widest();
        match isa {
            // SAFETY: `widest` was detected on this processor and includes the narrower sets.
            Isa::Avx512 if widest == Isa::Avx512 => unsafe { avx512(kernel) },
            Isa::Avx2 if widest != Isa::Baseline => unsafe { avx2(kernel) },
            _ => baseline(kernel),
        }
    }
}
