//! Decompresses streams of several parts in pieces of bounded size, and verifies checksums.

use crate::decoder::{Decoder, Moved};
use crate::error::Error;

/// How the voxels are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Codec {
    /// Uncompressed.
    Raw,
    /// A zlib or a gzip stream.
    Zlib,
    /// A bzip2 stream.
    Bzip2,
    /// Numbers written as text.
    Text,
}

/// Maximum number of consecutive empty parts; real files have at most one, which marks the end.
const MOST_EMPTY: u32 = 1000;
/// Number of bytes that show whether another part begins.
const MAGIC: usize = 3;
/// Bytes after the wanted ones that are unpacked at once.
const BEYOND: usize = 1 << 14;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    Damaged,
    BreaksOff,
    /// Far more bytes than voxels.
    GoesOn(u64),
}

impl Fault {
    pub(crate) fn of(self, subject: &str) -> Box<Error> {
        let found = match self {
            Self::Damaged => "a compressed stream that is damaged",
            Self::BreaksOff => "a compressed stream that breaks off",
            Self::GoesOn(most) => {
                let found = format!("a compressed stream with over {most} bytes after the voxels");
                return Error::new(subject, found, "a stream of voxels").mend("write the volume again");
            }
        };
        Error::damaged(subject, found, "a whole one")
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Taken {
    /// The numbers of bytes read and written; one of them may be 0.
    Some { read: usize, written: usize },
    /// The numbers of bytes read, and of bytes unpacked that follow the wanted ones.
    Beyond { read: usize, count: usize },
    /// More input is needed.
    Hungry,
    /// All wanted bytes were written and checksums match, or the stream has no more bytes.
    End,
}

/// Decompresses at most `wanted` bytes, and verifies the checksum of the part in which they end. Ignores what follows
/// this part.
pub(crate) struct Unpacker {
    codec: Codec,
    part: Part,
    wanted: u128,
    /// Number of bytes that this part may have after the wanted ones, and how many are left of them.
    most: u64,
    beyond: u64,
    empty: u32,
}

enum Part {
    /// Another part may begin.
    Between {
        is_first: bool,
    },
    Begun(Decoder),
    Over,
}

pub(crate) fn is_gzip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x1f\x8b")
}

impl Unpacker {
    pub(crate) fn new(codec: Codec, wanted: u128, most: u64) -> Self {
        Self { codec, part: Part::Between { is_first: true }, wanted, most, beyond: most, empty: 0 }
    }

    /// Reads `input` and writes `output`; `is_last` states that no more input follows.
    pub(crate) fn take(&mut self, input: &[u8], is_last: bool, output: &mut [u8]) -> Result<Taken, Fault> {
        if let Part::Between { is_first } = self.part {
            if input.len() < MAGIC && !is_last {
                return Ok(Taken::Hungry);
            }
            self.part = self.begun(input, is_first);
        }
        let is_beyond = self.wanted == 0;
        let most = usize::try_from(self.wanted).unwrap_or(usize::MAX).min(output.len());
        let mut beyond;
        let room = if is_beyond {
            beyond = [0; BEYOND];
            &mut beyond[..]
        } else {
            &mut output[..most]
        };
        let Part::Begun(decoder) = &mut self.part else { return Ok(Taken::End) };
        let Moved { read, written, has_ended } =
            decoder.take(input, room, is_beyond).ok_or(Fault::Damaged)?;
        if is_beyond {
            self.beyond = self.beyond.checked_sub(written as u64).ok_or(Fault::GoesOn(self.most))?;
        } else {
            self.wanted -= written as u128;
        }
        if written > 0 {
            self.empty = 0;
        }
        if has_ended {
            self.empty += 1;
            let is_over = self.wanted == 0 || self.empty > MOST_EMPTY;
            self.part = if is_over { Part::Over } else { Part::Between { is_first: false } };
        } else if read == 0 && written == 0 {
            return if is_last { self.broken_off() } else { Ok(Taken::Hungry) };
        }
        Ok(if is_beyond { Taken::Beyond { read, count: written } } else { Taken::Some { read, written } })
    }

    fn broken_off(&mut self) -> Result<Taken, Fault> {
        self.part = Part::Over;
        if self.wanted == 0 { Err(Fault::BreaksOff) } else { Ok(Taken::End) }
    }

    fn begun(&self, input: &[u8], is_first: bool) -> Part {
        match self.codec {
            Codec::Zlib if is_gzip(input) => Part::Begun(Decoder::gzip()),
            Codec::Zlib if is_first => Part::Begun(Decoder::zlib()),
            Codec::Bzip2 if is_first || input.starts_with(b"BZh") => Part::Begun(Decoder::bzip2()),
            _ => Part::Over,
        }
    }
}
