//! The sizes and bytes of files that a host has fetched so far.

use crate::error::{Error, Need, Opening};
use crate::stream::{Codec, Taken, Unpacker, is_gzip};

/// Bytes of a gzipped file that are requested first; each further request is four times as large.
const FIRST: u64 = 1 << 16;
const PIECE: usize = 1 << 16;

const PACKED: [(&[u8], &str); 4] =
    [(b"BZh", "bzip2"), (b"\xfd7zXZ\0", "xz"), (b"\x28\xb5\x2f\xfd", "zstd"), (b"PK\x03\x04", "zip")];

/// Whether a file exists, and its size (bytes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// It exists.
    Size(u64),
    /// It does not exist.
    Missing,
    /// It is a link to a file outside the folder.
    Outside(u64),
}

/// What is known about files, by their names.
#[derive(Clone, Debug, Default)]
pub struct Known(Vec<File>);

#[derive(Clone, Debug)]
struct File {
    name: String,
    found: Found,
    head: Vec<u8>,
}

impl Known {
    /// No file is known yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds whether a file exists.
    pub fn add_size(&mut self, name: &str, found: Found) {
        match self.0.iter_mut().find(|file| file.name == name) {
            Some(file) => file.found = found,
            None => self.0.push(File { name: name.into(), found, head: Vec::new() }),
        }
    }

    /// Adds requested bytes, which begin at `start`; no bytes mean that the file ends there.
    pub fn add_bytes(&mut self, name: &str, start: u64, bytes: &[u8]) {
        let Some(file) = self.0.iter_mut().find(|file| file.name == name) else { return };
        file.head.truncate(usize::try_from(start).unwrap_or(usize::MAX));
        file.head.extend_from_slice(bytes);
        if bytes.is_empty() {
            file.found = Found::Size(file.head.len() as u64);
        }
    }

    fn file(&self, name: &str) -> Option<&File> {
        self.0.iter().find(|file| file.name == name)
    }

    pub(crate) fn found(&self, name: &str) -> Opening<Found> {
        let unknown = || Need::Sizes(vec![name.into()]).into();
        self.file(name).map(|file| file.found).ok_or_else(unknown)
    }

    pub(crate) fn first_found(&self, names: &[String]) -> Opening<Option<String>> {
        let unknown: Vec<String> = names.iter().filter(|name| self.file(name).is_none()).cloned().collect();
        if !unknown.is_empty() {
            return Err(Need::Sizes(unknown).into());
        }
        let is_there = |name: &&String| self.file(name).is_some_and(|file| file.found != Found::Missing);
        Ok(names.iter().find(is_there).cloned())
    }

    fn size(&self, name: &str) -> Opening<u64> {
        Ok(match self.found(name)? {
            Found::Size(size) | Found::Outside(size) => size,
            Found::Missing => 0,
        })
    }

    pub(crate) fn first(&self, name: &str, count: u64) -> Opening<&[u8]> {
        let count = count.min(self.size(name)?);
        let head = self.file(name).map_or(&[][..], |file| &file.head);
        let wanted = usize::try_from(count).unwrap_or(usize::MAX);
        if head.len() < wanted {
            let start = head.len() as u64;
            return Err(Need::Bytes { name: name.into(), start, end: count }.into());
        }
        Ok(&head[..wanted])
    }

    pub(crate) fn head(&self, name: &str, count: usize) -> Opening<Vec<u8>> {
        let start = self.first(name, 8)?;
        if let Some((_, codec)) = PACKED.iter().find(|(magic, _)| start.starts_with(magic)) {
            let error =
                Error::new(name, format!("a file compressed with {codec}"), "a plain or gzipped file");
            return Err(error.mend("decompress it first").into());
        }
        self.unpacked(name, count)
    }

    /// The first bytes of a file, unpacked if it is gzipped; fewer if the stream ends earlier.
    pub(crate) fn unpacked(&self, name: &str, count: usize) -> Opening<Vec<u8>> {
        let start = self.first(name, count as u64)?;
        if !is_gzip(start) {
            return Ok(start.to_vec());
        }
        let size = self.size(name)?;
        let mut packed = FIRST;
        loop {
            let head = self.first(name, packed)?;
            let (bytes, is_all) = first_unpacked(head, packed >= size, count);
            if bytes.len() >= count || is_all {
                return Ok(bytes);
            }
            packed *= 4;
        }
    }
}

/// The first `count` bytes of a stream; if they are fewer, also whether it yields no further bytes.
fn first_unpacked(packed: &[u8], is_whole: bool, count: usize) -> (Vec<u8>, bool) {
    let mut unpacker = Unpacker::new(Codec::Zlib, count as u128, 0);
    let (mut bytes, mut piece, mut at) = (Vec::new(), vec![0; PIECE.min(count)], 0);
    while bytes.len() < count {
        match unpacker.take(&packed[at..], is_whole, &mut piece) {
            Ok(Taken::Some { read, written }) => {
                at += read;
                bytes.extend_from_slice(&piece[..written]);
            }
            Ok(Taken::Hungry) => return (bytes, is_whole),
            Ok(Taken::Beyond { .. } | Taken::End) | Err(_) => return (bytes, true),
        }
    }
    (bytes, is_whole)
}
