//! Converts the byte order, type and scale of stored numbers, and finds the range of integers.

use crate::numbers::{Kind, Scaling};
use crate::plan::Stored;

const BATCH: usize = 1024;

/// Calls `$function::<T>($argument, …)` with the Rust type of a kind.
macro_rules! of_kind {
    ($kind:expr, $function:ident($($argument:expr),*)) => {
        match $kind {
            Kind::Int8 => $function::<i8>($($argument),*),
            Kind::Uint8 => $function::<u8>($($argument),*),
            Kind::Int16 => $function::<i16>($($argument),*),
            Kind::Uint16 => $function::<u16>($($argument),*),
            Kind::Int32 => $function::<i32>($($argument),*),
            Kind::Uint32 => $function::<u32>($($argument),*),
            Kind::Int64 => $function::<i64>($($argument),*),
            Kind::Uint64 => $function::<u64>($($argument),*),
            Kind::Float32 => $function::<f32>($($argument),*),
            Kind::Float64 => $function::<f64>($($argument),*),
        }
    };
}

trait Number: Copy + PartialOrd {
    const BYTES: usize;
    fn read(bytes: &[u8], is_big: bool) -> Self;
    fn write(self, bytes: &mut [u8]);
    fn real(self) -> f64;
    fn whole(self) -> i64;
    fn exact(self) -> i128;
    fn of_real(value: f64) -> Self;
    fn of_whole(value: i64) -> Self;
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        #[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
        impl Number for $number {
            const BYTES: usize = size_of::<Self>();

            fn read(bytes: &[u8], is_big: bool) -> Self {
                let mut held = [0; size_of::<Self>()];
                held.copy_from_slice(bytes);
                if is_big { Self::from_be_bytes(held) } else { Self::from_le_bytes(held) }
            }

            fn write(self, bytes: &mut [u8]) {
                bytes.copy_from_slice(&self.to_ne_bytes());
            }

            fn real(self) -> f64 {
                self as f64
            }

            fn whole(self) -> i64 {
                self as i64
            }

            fn exact(self) -> i128 {
                self as i128
            }

            fn of_real(value: f64) -> Self {
                value as Self
            }

            fn of_whole(value: i64) -> Self {
                value as Self
            }
        }
    )*};
}

numbers!(i8, u8, i16, u16, i32, u32, i64, u64, f32, f64);

pub(crate) struct Conversion {
    stored: Stored,
    kind: Kind,
}

impl Conversion {
    pub(crate) fn new(stored: Stored, kind: Kind) -> Self {
        Self { stored, kind }
    }

    pub(crate) fn kind(&self) -> Kind {
        self.kind
    }

    pub(crate) fn is_copy(&self) -> bool {
        let is_native = self.stored.kind.bytes() == 1 || self.stored.is_big == cfg!(target_endian = "big");
        self.is_same_kind() && is_native
    }

    fn is_same_kind(&self) -> bool {
        self.stored.scaling.is_none() && self.stored.kind == self.kind
    }

    /// Converts complete numbers; `to` must have space for all of them.
    pub(crate) fn convert(&self, from: &[u8], to: &mut [u8]) {
        if self.is_same_kind() {
            to.copy_from_slice(from);
            if !self.is_copy() {
                reverse(to, self.stored.kind.bytes());
            }
            return;
        }
        let (unit, size) = (self.stored.kind.bytes(), self.kind.bytes());
        for (from, to) in from.chunks(BATCH * unit).zip(to.chunks_mut(BATCH * size)) {
            if self.stored.kind.is_integer() && self.kind.is_integer() {
                self.convert_whole(from, to);
            } else {
                self.convert_real(from, to);
            }
        }
    }

    fn convert_whole(&self, from: &[u8], to: &mut [u8]) {
        let mut wide = [0; BATCH];
        let wide = &mut wide[..from.len() / self.stored.kind.bytes()];
        of_kind!(self.stored.kind, read_whole(from, self.stored.is_big, wide));
        let Scaling { slope, intercept } = self.stored.scaling;
        let (slope, intercept) = (slope as i64, intercept as i64);
        for value in &mut *wide {
            *value = value.wrapping_mul(slope).wrapping_add(intercept);
        }
        of_kind!(self.kind, write_whole(wide, to));
    }

    fn convert_real(&self, from: &[u8], to: &mut [u8]) {
        let mut wide = [0.0; BATCH];
        let wide = &mut wide[..from.len() / self.stored.kind.bytes()];
        reals(self.stored, from, wide);
        let scaling = self.stored.scaling;
        if !scaling.is_none() {
            for value in &mut *wide {
                *value = *value * scaling.slope + scaling.intercept;
            }
        }
        of_kind!(self.kind, write_real(wide, to));
    }
}

/// Stored numbers as 64-bit floats, without scaling.
pub(crate) fn reals(stored: Stored, from: &[u8], to: &mut [f64]) {
    of_kind!(stored.kind, read_real(from, stored.is_big, to));
}

pub(crate) fn widened(stored: Stored, from: &[u8], range: (i128, i128)) -> (i128, i128) {
    of_kind!(stored.kind, widened_by(from, stored.is_big, range))
}

/// Writes a number in this machine's byte order: `whole` for integer types, else `real`.
pub(crate) fn write_number(kind: Kind, whole: i128, real: f64, to: &mut [u8]) {
    match kind {
        Kind::Uint64 => (whole as u64).write(to),
        _ if kind.is_integer() => of_kind!(kind, write_whole(&[whole as i64], to)),
        _ => of_kind!(kind, write_real(&[real], to)),
    }
}

fn reverse(bytes: &mut [u8], unit: usize) {
    match unit {
        2 => reverse_each::<2>(bytes),
        4 => reverse_each::<4>(bytes),
        8 => reverse_each::<8>(bytes),
        _ => {}
    }
}

fn reverse_each<const N: usize>(bytes: &mut [u8]) {
    for number in bytes.as_chunks_mut::<N>().0 {
        number.reverse();
    }
}

fn read_whole<T: Number>(from: &[u8], is_big: bool, to: &mut [i64]) {
    for (bytes, value) in from.chunks_exact(T::BYTES).zip(to) {
        *value = T::read(bytes, is_big).whole();
    }
}

fn read_real<T: Number>(from: &[u8], is_big: bool, to: &mut [f64]) {
    for (bytes, value) in from.chunks_exact(T::BYTES).zip(to) {
        *value = T::read(bytes, is_big).real();
    }
}

fn write_whole<T: Number>(from: &[i64], to: &mut [u8]) {
    for (&value, bytes) in from.iter().zip(to.chunks_exact_mut(T::BYTES)) {
        T::of_whole(value).write(bytes);
    }
}

fn write_real<T: Number>(from: &[f64], to: &mut [u8]) {
    for (&value, bytes) in from.iter().zip(to.chunks_exact_mut(T::BYTES)) {
        T::of_real(value).write(bytes);
    }
}

fn widened_by<T: Number>(from: &[u8], is_big: bool, (low, high): (i128, i128)) -> (i128, i128) {
    let mut numbers = from.chunks_exact(T::BYTES).map(|bytes| T::read(bytes, is_big));
    let Some(first) = numbers.next() else { return (low, high) };
    let (mut least, mut most) = (first, first);
    for number in numbers {
        least = if number < least { number } else { least };
        most = if number > most { number } else { most };
    }
    (low.min(least.exact()), high.max(most.exact()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn converted(kind: Kind, is_big: bool, scaling: Scaling, to: Kind, from: &[u8]) -> Vec<u8> {
        let mut out = vec![0; from.len() / kind.bytes() * to.bytes()];
        Conversion::new(Stored { kind, is_big, scaling }, to).convert(from, &mut out);
        out
    }

    #[test]
    fn integers_are_scaled_without_loss() {
        let scaling = Scaling { slope: 2.0, intercept: -1.0 };
        let from = [(1_i64 << 60).to_be_bytes(), 5_i64.to_be_bytes()].concat();
        let to = converted(Kind::Int64, true, scaling, Kind::Int64, &from);
        assert_eq!(to, [((1_i64 << 61) - 1).to_ne_bytes(), 9_i64.to_ne_bytes()].concat());
    }

    #[test]
    fn numbers_of_other_types_become_floats() {
        let to = converted(Kind::Int32, false, Scaling::NONE, Kind::Float32, &7_i32.to_le_bytes());
        assert_eq!(to, 7.0_f32.to_ne_bytes());
        let halved = Scaling { slope: 0.5, intercept: 1.0 };
        let to = converted(Kind::Float64, true, halved, Kind::Float64, &3.0_f64.to_be_bytes());
        assert_eq!(to, 2.5_f64.to_ne_bytes());
    }

    #[test]
    fn ranges_cover_all_integers() {
        let stored = Stored { kind: Kind::Uint64, is_big: false, scaling: Scaling::NONE };
        let from = [u64::MAX.to_le_bytes(), 3_u64.to_le_bytes()].concat();
        assert_eq!(widened(stored, &from, (5, 9)), (3, u64::MAX.into()));
    }
}
