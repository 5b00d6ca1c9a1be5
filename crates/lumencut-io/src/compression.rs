//! The three compressors of VTK XML files, and the budget that keeps a small file from unpacking without end.

use std::io::Read;

use crate::error::{Error, Result};

/// A `compressor` attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compressor {
    Zlib,
    Lz4,
    Lzma,
}

/// Dictionary (KiB) beyond which an LZMA block is refused: that of the strongest preset and some room.
const LZMA_MEMORY_KIB: u32 = 80 << 10;

impl Compressor {
    /// The compressor with the class name that VTK writes.
    ///
    /// # Errors
    /// For any other name.
    pub fn of_name(name: &str) -> Result<Self> {
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

    /// Unpacks one block of exactly `size` bytes onto `out`. The caller has charged `size` to its budget.
    ///
    /// # Errors
    /// Naming `subject` where the block is damaged or of another size.
    pub fn unpack(self, subject: &str, block: &[u8], size: usize, out: &mut Vec<u8>) -> Result<()> {
        let before = out.len();
        let done = match self {
            Self::Zlib => read_up_to(flate2::read::ZlibDecoder::new(block), size, out),
            Self::Lzma => {
                read_up_to(lzma_rust2::XzReader::new_mem_limit(block, false, LZMA_MEMORY_KIB), size, out)
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
        Err(Error::new(
            subject,
            format!("a block that unpacks to another size than {size} bytes"),
            expected(),
        ))
    }
}

/// Reads at most one byte more than `size`, enough to tell a block that is too long.
fn read_up_to(reader: impl Read, size: usize, out: &mut Vec<u8>) -> std::result::Result<(), String> {
    let limit = u64::try_from(size).unwrap_or(u64::MAX).saturating_add(1);
    reader.take(limit).read_to_end(out).map(|_| ()).map_err(|error| error.to_string())
}

/// How many bytes may still be unpacked from one file.
#[derive(Debug)]
pub struct Budget {
    left: u64,
}

impl Budget {
    /// 16 MiB and 64 times the size of the file: many times what centerlines compress to, and far from the
    /// ratio of a decompression bomb.
    pub fn of_file(size: usize) -> Self {
        Self { left: (size as u64).saturating_mul(64).saturating_add(16 << 20) }
    }

    /// Takes `size` bytes, as a length that fits the machine.
    ///
    /// # Errors
    /// Naming `subject` where that is more than is left.
    pub fn take(&mut self, subject: &str, size: u64) -> Result<usize> {
        let too_much = || {
            let found = format!("{size} bytes to unpack");
            Error::new(subject, found, format!("at most {} bytes from a file of this size", self.left))
                .mend("the file is damaged, or no centerline file")
        };
        let left = self.left.checked_sub(size).ok_or_else(too_much)?;
        let length = usize::try_from(size).map_err(|_| too_much())?;
        self.left = left;
        Ok(length)
    }
}
