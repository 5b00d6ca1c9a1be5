//! Compresses volumes to write.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;

/// Compresses pieces of bytes into a gzip stream, at the fastest level. The highest level takes six times as long and
/// makes a noisy scan 0.5 % smaller.
pub struct Packer(GzEncoder<Vec<u8>>);

impl Default for Packer {
    fn default() -> Self {
        Self(GzEncoder::new(Vec::new(), Compression::fast()))
    }
}

impl Packer {
    /// Compresses bytes; returns the part of the stream that is ready.
    pub fn pack(&mut self, bytes: &[u8]) -> Vec<u8> {
        // Writing into memory cannot fail.
        let _ = self.0.write_all(bytes);
        std::mem::take(self.0.get_mut())
    }

    /// Returns the last bytes of the stream.
    #[must_use]
    pub fn end(self) -> Vec<u8> {
        self.0.finish().unwrap_or_default()
    }
}
