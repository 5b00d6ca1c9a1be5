//! Reads binary data of VTK XML files: raw or base64, after a length header, maybe in compressed blocks.

use crate::compression::{Budget, Compressor};
use crate::data_array::ByteOrder;
use crate::error::{Error, Result};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    pub order: ByteOrder,
    /// Number of bytes of a number in the header: 4 or 8.
    pub header_size: usize,
    pub compressor: Option<Compressor>,
}

pub(crate) enum Bytes<'a> {
    Raw(&'a [u8]),
    /// Base64 text, and the bytes already decoded from it. Padding may occur inside the text, because writers
    /// may encode the header separately.
    Base64 {
        text: &'a [u8],
        ahead: Vec<u8>,
    },
}

impl<'a> Bytes<'a> {
    pub(crate) fn raw(bytes: &'a [u8]) -> Self {
        Self::Raw(bytes)
    }

    pub(crate) fn base64(text: &'a [u8]) -> Self {
        Self::Base64 { text, ahead: Vec::new() }
    }

    pub(crate) fn take(&mut self, subject: &str, count: u64) -> Result<Vec<u8>> {
        let short = |left: usize| {
            Error::truncated(subject, format!("at most {left} bytes"), format!("{count} bytes of data"))
        };
        match self {
            Self::Raw(bytes) => {
                let split = usize::try_from(count).ok().and_then(|n| bytes.split_at_checked(n));
                let (taken, rest) = split.ok_or_else(|| short(bytes.len()))?;
                *bytes = rest;
                Ok(taken.to_vec())
            }
            Self::Base64 { text, ahead } => {
                let left = text.len() / 4 * 3 + ahead.len() + 3;
                let count = usize::try_from(count).ok().filter(|n| *n <= left).ok_or_else(|| short(left))?;
                while ahead.len() < count {
                    let group = next_group(text).ok_or_else(|| short(ahead.len()))?;
                    decode_group(subject, group, ahead)?;
                }
                let rest = ahead.split_off(count);
                Ok(std::mem::replace(ahead, rest))
            }
        }
    }
}

fn next_group(text: &mut &[u8]) -> Option<[u8; 4]> {
    let mut group = [0; 4];
    let mut filled = 0;
    while filled < 4 {
        let (first, rest) = text.split_first()?;
        *text = rest;
        if !first.is_ascii_whitespace() {
            group[filled] = *first;
            filled += 1;
        }
    }
    Some(group)
}

fn decode_group(subject: &str, group: [u8; 4], out: &mut Vec<u8>) -> Result<()> {
    let padding = group.iter().rev().take_while(|c| **c == b'=').count();
    let mut bits = 0u32;
    for (place, character) in group.iter().enumerate() {
        let value = match character {
            b'A'..=b'Z' => character - b'A',
            b'a'..=b'z' => character - b'a' + 26,
            b'0'..=b'9' => character - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' if padding <= 2 && place >= 4 - padding => 0,
            _ => {
                let found = format!("the character '{}'", char::from(*character).escape_debug());
                return Err(Error::new(subject, found, "base64 text"));
            }
        };
        bits = bits << 6 | u32::from(value);
    }
    out.extend_from_slice(&bits.to_be_bytes()[1..4 - padding]);
    Ok(())
}

/// Decodes the content of one array: reads its header, and unpacks its blocks within the budget.
pub(crate) fn content(
    subject: &str,
    mut bytes: Bytes,
    layout: Layout,
    budget: &mut Budget,
) -> Result<Vec<u8>> {
    let Some(compressor) = layout.compressor else {
        let size = header_number(subject, &mut bytes, layout)?;
        budget.take(subject, size)?;
        return bytes.take(subject, size);
    };
    let blocks = header_number(subject, &mut bytes, layout)?;
    let block_size = header_number(subject, &mut bytes, layout)?;
    let last_size = header_number(subject, &mut bytes, layout)?;
    let table = bytes.take(subject, blocks.saturating_mul(layout.header_size as u64))?;
    let packed_sizes: Vec<u64> =
        table.chunks_exact(layout.header_size).map(|word| number_of_bytes(word, layout.order)).collect();
    let mut out = Vec::new();
    for (i, packed_size) in packed_sizes.iter().enumerate() {
        let partial = i + 1 == packed_sizes.len() && last_size != 0;
        let size = budget.take(subject, if partial { last_size } else { block_size })?;
        budget.take(subject, *packed_size)?;
        let block = bytes.take(subject, *packed_size)?;
        compressor.unpack(subject, &block, size, &mut out)?;
    }
    Ok(out)
}

fn header_number(subject: &str, bytes: &mut Bytes, layout: Layout) -> Result<u64> {
    Ok(number_of_bytes(&bytes.take(subject, layout.header_size as u64)?, layout.order))
}

fn number_of_bytes(bytes: &[u8], order: ByteOrder) -> u64 {
    let join = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
    match order {
        ByteOrder::Little => bytes.iter().rev().fold(0, join),
        ByteOrder::Big => bytes.iter().fold(0, join),
    }
}
