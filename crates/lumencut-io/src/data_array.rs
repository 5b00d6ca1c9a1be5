//! Reads numbers of VTK files, of any number type, from bytes or text.

use crate::error::{Error, Result, excerpt};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ByteOrder {
    Little,
    Big,
}

impl NumberType {
    pub(crate) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The numbers in `bytes`; an incomplete last one is ignored. Integers beyond 2⁵³ are rounded, but no
    /// readable file needs them.
    pub(crate) fn numbers(self, bytes: &[u8], order: ByteOrder) -> Vec<f64> {
        match self {
            Self::I8 => bytes.iter().map(|b| f64::from(b.cast_signed())).collect(),
            Self::U8 => bytes.iter().map(|b| f64::from(*b)).collect(),
            Self::I16 => each(bytes, order, |b| f64::from(i16::from_le_bytes(b))),
            Self::U16 => each(bytes, order, |b| f64::from(u16::from_le_bytes(b))),
            Self::I32 => each(bytes, order, |b| f64::from(i32::from_le_bytes(b))),
            Self::U32 => each(bytes, order, |b| f64::from(u32::from_le_bytes(b))),
            Self::F32 => each(bytes, order, |b| f64::from(f32::from_le_bytes(b))),
            Self::I64 => each(bytes, order, |b| i64::from_le_bytes(b) as f64),
            Self::U64 => each(bytes, order, |b| u64::from_le_bytes(b) as f64),
            Self::F64 => each(bytes, order, f64::from_le_bytes),
        }
    }
}

fn each<const N: usize>(bytes: &[u8], order: ByteOrder, number: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    let (chunks, _) = bytes.as_chunks::<N>();
    chunks
        .iter()
        .map(|chunk| {
            let mut chunk = *chunk;
            if order == ByteOrder::Big {
                chunk.reverse();
            }
            number(chunk)
        })
        .collect()
}

pub(crate) fn numbers_of_text(subject: &str, text: &str, kind: NumberType) -> Result<Vec<f64>> {
    text.split_ascii_whitespace().map(|word| number_of_word(subject, word, kind)).collect()
}

/// Parses a number. 32-bit floats are rounded, so that text and binary files give the same numbers.
pub(crate) fn number_of_word(subject: &str, word: &str, kind: NumberType) -> Result<f64> {
    let number = match kind {
        NumberType::F32 => word.parse::<f32>().map(f64::from),
        _ => word.parse::<f64>(),
    };
    number.map_err(|_| Error::new(subject, excerpt(word), "a number"))
}

pub(crate) fn index(subject: &str, number: f64, limit: usize) -> Result<usize> {
    if number >= 0.0 && number < limit as f64 && number.fract() == 0.0 {
        Ok(number as usize)
    } else {
        Err(Error::new(subject, format!("{number}"), format!("a whole number from 0 to below {limit}")))
    }
}
