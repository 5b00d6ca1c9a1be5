//! Lanes and instruction sets: the kernels are written once over small arrays, compiled once per instruction
//! set, and picked at run time.
//!
//! The compiler never fuses a multiplication with an addition here and every square root is correctly
//! rounded, so all instruction sets give the same bits.

/// The side of a tile of pixels.
pub const TILE: usize = 8;
/// The pixels of a tile, evaluated together.
pub const PIXELS: usize = TILE * TILE;
/// The children of a node of the hierarchy, tested together.
pub const FAN: usize = 16;

/// A key no piece reaches: the pixel has no winner yet. Finite, so that no kernel ever meets inf or NaN.
pub const UNSET: f32 = 1e30;
/// The depth of a piece that is not there; beyond [`UNSET`] whatever is added.
pub const ABSENT: f32 = 3e30;
/// Where slots without a point lie (mm): beyond every scene, and its square is still finite.
pub const FAR: f32 = 1e9;
/// A key that no piece beats: the pixel does not take part.
pub const SETTLED: f32 = -1e30;

/// An instruction set that the kernels are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// What every processor of the target has (SSE2, NEON, wasm simd128 where enabled).
    Baseline,
    /// x86-64 with AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// x86-64 with AVX-512 F, BW, DQ and VL.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// The instruction sets this processor has, the widest last.
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

    /// The widest instruction set this processor has.
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

/// Work to be compiled for every instruction set; `run` and all it calls must be `#[inline(always)]`.
pub trait Kernel {
    /// What the work gives.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
}

/// Runs `kernel` as compiled for `isa`, which must be one of [`Isa::available`] (others run as baseline).
pub fn dispatch<K: Kernel>(isa: Isa, kernel: K) -> K::Output {
    match isa {
        Isa::Baseline => kernel.run(),
        #[cfg(target_arch = "x86_64")]
        Isa::Avx2 | Isa::Avx512 => x86::dispatch(isa, kernel),
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Isa, Kernel};

    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    fn avx2<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt")]
    fn avx512<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    /// The one place where the crate promises the compiler something it cannot check.
    #[allow(unsafe_code)]
    pub fn dispatch<K: Kernel>(isa: Isa, kernel: K) -> K::Output {
        let widest = Isa::widest();
        match isa {
            // SAFETY: `widest` was detected on this processor and includes the narrower sets.
            Isa::Avx512 if widest == Isa::Avx512 => unsafe { avx512(kernel) },
            Isa::Avx2 if widest != Isa::Baseline => unsafe { avx2(kernel) },
            _ => kernel.run(),
        }
    }
}
