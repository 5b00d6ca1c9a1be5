//! The compressors of VTK XML files, and a budget that protects against decompression bombs.

use std::io::Read;

use crate::error::{Error, Result};
use crate::xz;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Compressor {
    Zlib,
    Lz4,
    Lzma,
}

impl Compressor {
    pub(crate) fn of_name(name: &str) -> Result<Self> {
        match name {
            "vtkZLibDataCompressor" => Ok(Self::Zlib),
            "vtkLZ4DataCompressor" => Ok(Self::Lz4),
            "vtkLZMADataCompressor" => Ok(Self::Lzma),
            _ => {
                let expected = "vtkZLibDataCompressor, vtkLZ4DataCompressor or vtkLZMADataCompressor";
                Err(Error::new("compressor", crate::error::excerpt(name), expected))
            }
        }
    }

    fn largest_ratio(self) -> usize {
        match self {
            Self::Zlib => 1032,
            Self::Lz4 => 255,
            // An LZMA match of 273 bytes takes at least a third of a bit, so a byte gives at most about 7000.
            Self::Lzma => 1 << 14,
        }
    }

    /// Unpacks a block to exactly `size` bytes and appends them to `out`. The caller checks the budget.
    pub(crate) fn unpack(self, subject: &str, block: &[u8], size: usize, out: &mut Vec<u8>) -> Result<()> {
        let before = out.len();
        let most = block.len().saturating_mul(self.largest_ratio());
        if size > most {
            let found = format!("a block of {} bytes", block.len());
            return Err(Error::new(subject, found, format!("{self:?} data for {size} bytes")));
        }
        out.reserve_exact(size);
        let done = match self {
            Self::Zlib => read_up_to(flate2::read::ZlibDecoder::new(block), size, out),
            Self::Lzma => {
                let (block, memory) = xz::with_small_dictionary(block, size);
                read_up_to(lzma_rust2::XzReader::new_mem_limit(&block[..], false, memory), size, out)
            }
            Self::Lz4 => {
                out.resize(before + size, 0);
                lz4_flex::block::decompress_into(block, &mut out[before..])
                    .map(|n| out.truncate(before + n))
                    .map_err(|error| error.to_string())
            }
        };
        let expected = || format!("a {self:?} block of {size} bytes");
        done.map_err(|cause| Error::new(subject, format!("a damaged block ({cause})"), expected()))?;
        if out.len() - before == size {
            return Ok(());
        }
        Err(Error::new(subject, format!("a block that does not unpack to {size} bytes"), expected()))
    }
}

/// Reads at most one byte more than `size`, which is enough to detect a block that is too large.
fn read_up_to(reader: impl Read, size: usize, out: &mut Vec<u8>) -> std::result::Result<(), String> {
    let limit = u64::try_from(size).unwrap_or(u64::MAX).saturating_add(1);
    reader.take(limit).read_to_end(out).map(|_| ()).map_err(|error| error.to_string())
}

#[derive(Debug)]
pub(crate) struct Budget {
    left: u64,
}

impl Budget {
    /// The budget for a file: 1 MiB plus 16 times its size. A point with radius and line entry takes 66 bytes;
    /// compressed, it rarely takes less than 8. A decompression bomb unpacks to thousands of times its size.
    pub(crate) fn of_file(size: usize) -> Self {
        Self { left: (size as u64).saturating_mul(16).saturating_add(1 << 20) }
    }

    pub(crate) fn take(&mut self, subject: &str, size: u64) -> Result<usize> {
        let too_much = || {
            let found = format!("{size} bytes to unpack");
            Error::new(subject, found, format!("at most {} bytes from a file of this size", self.left))
                .mend("the file is damaged or not a centerline file")
        };
        let left = self.left.checked_sub(size).ok_or_else(too_much)?;
        let length = usize::try_from(size).map_err(|_| too_much())?;
        self.left = left;
        Ok(length)
    }
}
