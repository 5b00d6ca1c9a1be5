//! One pass over the stored bytes of all voxels: raw, unpacked or from text.

use crate::error::Error;
use crate::plan::Plan;
use crate::stream::{Codec, Taken, Unpacker};
use crate::words::Words;

const SKIPPED: usize = 1 << 14;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Piece {
    /// The number of bytes written; 0 while bytes are skipped.
    Bytes(usize),
    /// This many bytes after the voxels were unpacked, to verify the checksum.
    Beyond(usize),
    /// More of the file is needed.
    Hungry,
    Full,
    /// All bytes were written, and checksums match.
    End,
}

pub(crate) struct Pass {
    subject: String,
    /// The smallest output (bytes) to which it can write.
    unit: usize,
    pub(crate) start: u64,
    skip: u64,
    needed: u128,
    given: u128,
    source: Source,
}

enum Source {
    Plain,
    Packed(Box<Unpacker>),
    Text(Words),
    Ended,
}

impl Pass {
    /// A pass over `needed` bytes, which are `numbers` stored numbers, from byte `start` of the file on. In a
    /// compressed stream at most `beyond` bytes may follow them.
    pub(crate) fn new(plan: &Plan, start: u64, needed: u128, numbers: u128, beyond: u64) -> Self {
        let place = &plan.place;
        let is_packed = matches!(place.codec, Codec::Zlib | Codec::Bzip2);
        let skip = if is_packed { place.skip } else { 0 };
        let source = match place.codec {
            Codec::Raw => Source::Plain,
            Codec::Text => Source::Text(Words::new(&place.name, plan.stored.kind, numbers)),
            codec => {
                let wanted = needed.saturating_add(skip.into());
                Source::Packed(Box::new(Unpacker::new(codec, wanted, beyond)))
            }
        };
        let unit = if place.codec == Codec::Text { plan.stored.kind.bytes() } else { 1 };
        Self { subject: place.name.clone(), unit, start, skip, needed, given: 0, source }
    }

    /// Reads `input`, which holds the bytes of the file from `at` on, and writes stored bytes.
    pub(crate) fn take(
        &mut self,
        at: &mut u64,
        size: u64,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<Piece, Box<Error>> {
        if output.len() < self.unit && self.given < self.needed {
            return Ok(Piece::Full);
        }
        let is_last = at.saturating_add(input.len() as u64) >= size;
        let (read, piece) = match &self.source {
            Source::Plain => self.plain(input, is_last, output)?,
            Source::Packed(_) if self.skip > 0 => {
                let mut scratch = [0; SKIPPED];
                let most = usize::try_from(self.skip).unwrap_or(SKIPPED).min(SKIPPED);
                let (read, piece) = self.unpacked(input, is_last, &mut scratch[..most])?;
                let skipped = if let Piece::Bytes(count) = piece { count } else { 0 };
                self.skip -= skipped as u64;
                (read, if skipped > 0 { Piece::Bytes(0) } else { piece })
            }
            Source::Packed(_) => self.unpacked(input, is_last, output)?,
            Source::Text(_) => self.words(input, is_last, output)?,
            Source::Ended => (0, Piece::End),
        };
        *at += read as u64;
        if let (Piece::Bytes(count), 0) = (piece, self.skip) {
            self.given += count as u128;
        }
        Ok(piece)
    }

    fn plain(
        &mut self,
        input: &[u8],
        is_last: bool,
        output: &mut [u8],
    ) -> Result<(usize, Piece), Box<Error>> {
        let left = usize::try_from(self.needed - self.given).unwrap_or(usize::MAX);
        let count = left.min(input.len()).min(output.len());
        output[..count].copy_from_slice(&input[..count]);
        if left == 0 {
            return Ok((0, Piece::End));
        }
        if count > 0 {
            return Ok((count, Piece::Bytes(count)));
        }
        if is_last { Err(self.too_short()) } else { Ok((0, Piece::Hungry)) }
    }

    fn unpacked(
        &mut self,
        input: &[u8],
        is_last: bool,
        output: &mut [u8],
    ) -> Result<(usize, Piece), Box<Error>> {
        let Source::Packed(unpacker) = &mut self.source else { return Ok((0, Piece::End)) };
        match unpacker.take(input, is_last, output) {
            Ok(Taken::Some { read, written }) => Ok((read, Piece::Bytes(written))),
            Ok(Taken::Beyond { read, count }) => Ok((read, Piece::Beyond(count))),
            Ok(Taken::Hungry) => Ok((0, Piece::Hungry)),
            Ok(Taken::End) if self.given < self.needed => Err(self.too_short()),
            Ok(Taken::End) => {
                self.source = Source::Ended;
                Ok((0, Piece::End))
            }
            Err(fault) => Err(fault.of(&self.subject)),
        }
    }

    fn words(
        &mut self,
        input: &[u8],
        is_last: bool,
        output: &mut [u8],
    ) -> Result<(usize, Piece), Box<Error>> {
        let Source::Text(words) = &mut self.source else { return Ok((0, Piece::End)) };
        let (read, mut written) = words.take(input, output)?;
        if read < input.len() || written > 0 {
            return Ok((read, Piece::Bytes(written)));
        }
        if !is_last {
            return Ok((read, if read > 0 { Piece::Bytes(0) } else { Piece::Hungry }));
        }
        written = words.end(output)?;
        self.source = Source::Ended;
        Ok((read, Piece::Bytes(written)))
    }

    fn too_short(&self) -> Box<Error> {
        Error::too_short(&self.subject, "", self.given, self.needed)
    }
}
