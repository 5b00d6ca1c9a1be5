//! Reads words, lines and number blocks of legacy VTK and MetaIO files.

use crate::data_array::{ByteOrder, NumberType, number_of_word};
use crate::error::{Error, Result, excerpt};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ValueType {
    Bits,
    Text,
    Number(NumberType),
}

impl ValueType {
    pub(crate) fn of_name(subject: &str, name: &str) -> Result<Self> {
        Ok(match name.to_ascii_lowercase().as_str() {
            "bit" => Self::Bits,
            "string" => Self::Text,
            "char" | "signed_char" | "vtktypeint8" => Self::Number(NumberType::I8),
            "unsigned_char" | "vtktypeuint8" => Self::Number(NumberType::U8),
            "short" | "vtktypeint16" => Self::Number(NumberType::I16),
            "unsigned_short" | "vtktypeuint16" => Self::Number(NumberType::U16),
            // Ids in legacy files have 32 bits on every machine.
            "int" | "vtkidtype" | "vtktypeint32" => Self::Number(NumberType::I32),
            "unsigned_int" | "vtktypeuint32" => Self::Number(NumberType::U32),
            "long" | "long_long" | "vtktypeint64" => Self::Number(NumberType::I64),
            "unsigned_long" | "unsigned_long_long" | "vtktypeuint64" => Self::Number(NumberType::U64),
            "float" => Self::Number(NumberType::F32),
            "double" => Self::Number(NumberType::F64),
            _ => return Err(Error::new(subject, format!("the type {}", excerpt(name)), "a VTK number type")),
        })
    }
}

pub(crate) struct Cursor<'a> {
    rest: &'a [u8],
    /// Whether values are big-endian bytes instead of text.
    pub binary: bool,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, binary: false }
    }

    pub(crate) fn line(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| *b == b'\n').unwrap_or(self.rest.len());
        let line = String::from_utf8_lossy(&self.rest[..end]).trim().to_owned();
        self.rest = &self.rest[(end + 1).min(self.rest.len())..];
        Some(line)
    }

    pub(crate) fn next_word(&mut self) -> Option<String> {
        self.rest = self.rest.trim_ascii_start();
        let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        (end > 0).then(|| String::from_utf8_lossy(word).into_owned())
    }

    pub(crate) fn word(&mut self, subject: &str) -> Result<String> {
        self.next_word().ok_or_else(|| Error::truncated(subject, "the end of the file", "another word"))
    }

    pub(crate) fn count(&mut self, subject: &str) -> Result<usize> {
        let word = self.word(subject)?;
        word.parse().map_err(|_| Error::new(subject, excerpt(&word), "a whole number from 0"))
    }

    pub(crate) fn is_next(&self, word: &str) -> bool {
        let next = self.rest.trim_ascii_start();
        next.get(..word.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(word.as_bytes()))
    }

    /// The next `count` values, starting on the next line. For text values, these are character codes.
    pub(crate) fn values(&mut self, subject: &str, kind: ValueType, count: usize) -> Result<Vec<f64>> {
        self.line();
        match kind {
            ValueType::Text => self.texts(subject, count),
            ValueType::Bits if self.binary => {
                let bytes = self.bytes(subject, count.div_ceil(8))?;
                Ok((0..count).map(|i| f64::from(bytes[i / 8] >> (7 - i % 8) & 1)).collect())
            }
            ValueType::Number(number) if self.binary => {
                let bytes = self.bytes(subject, count.saturating_mul(number.size()))?;
                Ok(number.numbers(bytes, ByteOrder::Big))
            }
            ValueType::Bits => self.numbers_of_words(subject, NumberType::U8, count),
            ValueType::Number(number) => self.numbers_of_words(subject, number, count),
        }
    }

    fn numbers_of_words(&mut self, subject: &str, kind: NumberType, count: usize) -> Result<Vec<f64>> {
        let mut out = Vec::new();
        for read in 0..count {
            let word = self.next_word().ok_or_else(|| {
                Error::truncated(subject, format!("{read} numbers"), format!("{count} numbers"))
            })?;
            out.push(number_of_word(subject, &word, kind)?);
        }
        Ok(out)
    }

    pub(crate) fn bytes(&mut self, subject: &str, count: usize) -> Result<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(|| {
            let found = format!("{} bytes to the end of the file", self.rest.len());
            Error::truncated(subject, found, format!("{count} bytes"))
        })?;
        self.rest = rest;
        Ok(taken)
    }

    pub(crate) fn skip_to(&mut self, word: &[u8]) {
        let at = self.rest.windows(word.len()).position(|window| window == word);
        self.rest = at.map_or(&[], |at| &self.rest[at..]);
    }

    /// Reads texts: one per line, or in binary each after its length, whose first two bits state how wide it is.
    fn texts(&mut self, subject: &str, count: usize) -> Result<Vec<f64>> {
        let mut out = Vec::new();
        for _ in 0..count {
            let text = if self.binary {
                let first =
                    *self.rest.first().ok_or_else(|| Error::truncated(subject, "no text", "a text"))?;
                let width = [8, 4, 2, 1][usize::from(first >> 6)];
                let length = self.bytes(subject, width)?.iter().fold(0u64, |sum, b| sum << 8 | u64::from(*b));
                let length = length & (u64::MAX >> (64 - 8 * width + 2));
                self.bytes(subject, usize::try_from(length).unwrap_or(usize::MAX))?.to_vec()
            } else {
                let line = self.line();
                line.ok_or_else(|| Error::truncated(subject, "no text", "a text"))?.into_bytes()
            };
            out.extend(text.iter().map(|b| f64::from(*b)));
        }
        Ok(out)
    }
}
