//! Reduces the dictionary size that an LZMA block states, because the decoder allocates that much memory.

use std::borrow::Cow;

/// Bytes of the stream header: magic bytes, flags, checksum.
const STREAM_HEADER: usize = 12;
/// Memory that the reader needs besides the dictionary (KiB), with a margin.
const READER_KIB: u32 = 256;
const CODES: std::ops::Range<u8> = 0..40;

/// The block with the smallest dictionary that its content of `size` bytes needs, and a memory limit (KiB).
/// Unusual blocks are returned unchanged.
pub(crate) fn with_small_dictionary(block: &[u8], size: usize) -> (Cow<'_, [u8]>, u32) {
    let code = CODES.into_iter().find(|code| dictionary(*code) >= size as u64).unwrap_or(CODES.end);
    let memory = READER_KIB.saturating_add(u32::try_from(dictionary(code) >> 10).unwrap_or(u32::MAX));
    let smaller = dictionary_field(block).filter(|place| block[place.code] > code).map(|place| {
        let mut changed = block.to_vec();
        changed[place.code] = code;
        let mut sum = flate2::Crc::new();
        sum.update(&changed[STREAM_HEADER..place.sum]);
        changed[place.sum..place.sum + 4].copy_from_slice(&sum.sum().to_le_bytes());
        Cow::Owned(changed)
    });
    (smaller.unwrap_or(Cow::Borrowed(block)), memory)
}

fn dictionary(code: u8) -> u64 {
    u64::from(2 | code & 1) << (code / 2 + 11)
}

struct DictionaryField {
    code: usize,
    sum: usize,
}

fn dictionary_field(block: &[u8]) -> Option<DictionaryField> {
    let [size, flags, fields @ ..] = block.get(STREAM_HEADER..)? else { return None };
    let sum = STREAM_HEADER + usize::from(*size) * 4;
    if block.len() < sum + 4 || flags & 0x3f != 0 {
        return None;
    }
    // The size of a block is stored in a variable number of bytes; only its last byte is below 128.
    let mut at = 0;
    for _ in 0..(flags >> 6).count_ones() {
        at += 1 + fields[at..].iter().position(|byte| *byte < 128)?;
    }
    let is_lzma2 = fields.get(at..at + 2)? == [0x21, 1];
    let code = STREAM_HEADER + 2 + at + 2;
    (is_lzma2 && code < sum).then_some(DictionaryField { code, sum })
}
