//! Reads voxels that are written as text.

use crate::built_in::real;
use crate::convert::write_number;
use crate::error::Error;
use crate::numbers::Kind;
use crate::text::{latin1, ungrouped};

const LONGEST: usize = 400;

pub(crate) struct Words {
    subject: String,
    kind: Kind,
    begun: Vec<u8>,
    found: u128,
    wanted: u128,
}

impl Words {
    pub(crate) fn new(subject: &str, kind: Kind, wanted: u128) -> Self {
        Self { subject: subject.into(), kind, begun: Vec::new(), found: 0, wanted }
    }

    /// Reads words and writes their numbers in this machine's byte order; returns the numbers of bytes read and
    /// written.
    pub(crate) fn take(&mut self, from: &[u8], to: &mut [u8]) -> Result<(usize, usize), Box<Error>> {
        let unit = self.kind.bytes();
        let mut written = 0;
        for (at, &byte) in from.iter().enumerate() {
            if !is_blank(byte) {
                self.begun.push(byte);
                if self.begun.len() > LONGEST {
                    let found = "a word of many letters among the voxels";
                    return Err(Error::new(&self.subject, found, "numbers"));
                }
            } else if !self.begun.is_empty() {
                if self.found < self.wanted && to.len() - written < unit {
                    return Ok((at, written));
                }
                written += self.end_word(&mut to[written..])?;
            }
        }
        Ok((from.len(), written))
    }

    pub(crate) fn end(&mut self, to: &mut [u8]) -> Result<usize, Box<Error>> {
        let written = if self.begun.is_empty() { 0 } else { self.end_word(to)? };
        if self.found != self.wanted {
            let found = format!("{} numbers", self.found);
            let expected = format!("{} numbers as the header says", self.wanted);
            return Err(Error::new(&self.subject, found, expected));
        }
        Ok(written)
    }

    fn end_word(&mut self, to: &mut [u8]) -> Result<usize, Box<Error>> {
        self.found += 1;
        let word = latin1(&std::mem::take(&mut self.begun));
        if self.found > self.wanted {
            return Ok(0);
        }
        let (whole, real) = self.number(&ungrouped(&word))?;
        let unit = self.kind.bytes();
        write_number(self.kind, whole, real, &mut to[..unit]);
        Ok(unit)
    }

    fn number(&self, word: &str) -> Result<(i128, f64), Box<Error>> {
        let kind = self.kind.name();
        if !self.kind.is_integer() {
            if let Some(value) = real(word) {
                return Ok((0, value));
            }
        } else if is_whole(word) {
            let (least, most) = self.kind.limits();
            let value = word.parse().ok().filter(|value| (least..=most).contains(value));
            let found = || crate::text::shown(&format!("a voxel of {word}"));
            let refused =
                || Error::new(&self.subject, found(), format!("{least} to {most}, as {kind} holds"));
            return Ok((value.ok_or_else(refused)?, 0.0));
        }
        Err(Error::new(&self.subject, "voxels that are no numbers", format!("numbers of type {kind}")))
    }
}

fn is_whole(word: &str) -> bool {
    let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
    !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit())
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}
