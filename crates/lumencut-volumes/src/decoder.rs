//! Decoders of gzip, zlib and bzip2. Without the feature `unpacking` every compressed stream counts as damaged.

#[cfg(not(feature = "unpacking"))]
pub(crate) use none::Decoder;
#[cfg(feature = "unpacking")]
pub(crate) use real::Decoder;

/// The numbers of bytes read and written, and whether the stream ended with a valid checksum.
pub(crate) struct Moved {
    pub(crate) read: usize,
    pub(crate) written: usize,
    pub(crate) has_ended: bool,
}

#[cfg(not(feature = "unpacking"))]
mod none {
    use super::Moved;

    pub(crate) struct Decoder;

    impl Decoder {
        pub(crate) fn gzip() -> Self {
            Self
        }

        pub(crate) fn zlib() -> Self {
            Self
        }

        pub(crate) fn bzip2() -> Self {
            Self
        }

        pub(crate) fn take(&mut self, _input: &[u8], _output: &mut [u8], _is_beyond: bool) -> Option<Moved> {
            None
        }
    }
}

#[cfg(feature = "unpacking")]
mod real {
    use super::Moved;
    use flate2::{Decompress as Inflate, FlushDecompress, Status};

    pub(crate) enum Decoder {
        Inflate(Box<Inflate>),
        Bzip2(Box<bzip2::Decompress>),
    }

    impl Decoder {
        pub(crate) fn gzip() -> Self {
            Self::Inflate(Box::new(Inflate::new_gzip(15)))
        }

        pub(crate) fn zlib() -> Self {
            Self::Inflate(Box::new(Inflate::new(true)))
        }

        pub(crate) fn bzip2() -> Self {
            Self::Bzip2(Box::new(bzip2::Decompress::new(false)))
        }

        /// None if the stream is damaged; with `is_beyond`, also if bytes came before the damage.
        pub(crate) fn take(&mut self, input: &[u8], output: &mut [u8], is_beyond: bool) -> Option<Moved> {
            match self {
                Self::Inflate(part) => inflated(part, input, output, is_beyond),
                Self::Bzip2(part) => unpacked(part, input, output),
            }
        }
    }

    fn inflated(part: &mut Inflate, input: &[u8], output: &mut [u8], is_beyond: bool) -> Option<Moved> {
        let before = (part.total_in(), part.total_out());
        let status = part.decompress(input, output, FlushDecompress::None);
        let has_ended = matches!(status, Ok(Status::StreamEnd));
        let moved = moved(before, (part.total_in(), part.total_out()), has_ended);
        // Bytes before the damage are returned, since they may identify the file. The next call fails again.
        let is_damaged = status.is_err() && (moved.written == 0 || is_beyond);
        (!is_damaged).then_some(moved)
    }

    fn unpacked(part: &mut bzip2::Decompress, input: &[u8], output: &mut [u8]) -> Option<Moved> {
        let before = (part.total_in(), part.total_out());
        let status = part.decompress(input, output).ok()?;
        let has_ended = status == bzip2::Status::StreamEnd;
        Some(moved(before, (part.total_in(), part.total_out()), has_ended))
    }

    fn moved(before: (u64, u64), after: (u64, u64), has_ended: bool) -> Moved {
        let count = |after: u64, before: u64| usize::try_from(after - before).unwrap_or(0);
        Moved { read: count(after.0, before.0), written: count(after.1, before.1), has_ended }
    }
}
