//! Reads the fields of NIfTI-1 and -2 headers, and repairs faults in them.

use crate::error::Error;
use crate::plan::Format;
use crate::text::{short, shown};

pub(crate) const HEADER_BYTES: usize = 540;
const MOST_CODE: i32 = 5;

pub(crate) struct Header {
    pub(crate) format: Format,
    /// Whether the voxels are in a separate file.
    pub(crate) is_pair: bool,
    pub(crate) is_big: bool,
    magic: [u8; 4],
    /// Bytes that a conversion of line ends would change; only in NIfTI-2.
    line_ends: Option<[u8; 4]>,
    stated_length: i32,
    /// The number of axes, then their lengths.
    pub(crate) dim: [i64; 8],
    glmin: i32,
    pub(crate) datatype: i16,
    pub(crate) pixdim: [f64; 8],
    offset: f64,
    pub(crate) slope: f64,
    pub(crate) intercept: f64,
    pub(crate) units: i32,
    pub(crate) qform_code: i32,
    pub(crate) sform_code: i32,
    pub(crate) quaternion: [f64; 3],
    pub(crate) shift: [f64; 3],
    pub(crate) rows: [[f64; 4]; 3],
    pub(crate) description: [u8; 80],
}

/// The format that the first bytes of a file state.
pub(crate) fn format_of(head: &[u8]) -> Option<Format> {
    let length: [u8; 4] = head.get(..4)?.try_into().ok()?;
    let lengths = [u32::from_le_bytes(length), u32::from_be_bytes(length)];
    if lengths.contains(&348) {
        return Some(Format::Nifti1);
    }
    lengths.contains(&540).then_some(Format::Nifti2)
}

/// Reads numbers of a header; the flag states whether they are big-endian.
struct Bytes<'a>(&'a [u8], bool);

impl Bytes<'_> {
    fn at<const N: usize>(&self, place: usize) -> [u8; N] {
        let mut bytes = [0; N];
        bytes.copy_from_slice(&self.0[place..place + N]);
        if self.1 {
            bytes.reverse();
        }
        bytes
    }

    fn short(&self, place: usize) -> i16 {
        i16::from_le_bytes(self.at(place))
    }

    fn whole(&self, place: usize) -> i32 {
        i32::from_le_bytes(self.at(place))
    }

    fn long(&self, place: usize) -> i64 {
        i64::from_le_bytes(self.at(place))
    }

    fn float(&self, place: usize) -> f64 {
        f32::from_le_bytes(self.at(place)).into()
    }

    fn double(&self, place: usize) -> f64 {
        f64::from_le_bytes(self.at(place))
    }

    fn letters(&self, place: usize) -> [u8; 80] {
        let mut letters = [0; 80];
        letters.copy_from_slice(&self.0[place..place + 80]);
        letters
    }
}

fn several<T, const N: usize>(place: usize, step: usize, read: impl Fn(usize) -> T) -> [T; N] {
    std::array::from_fn(|at| read(place + at * step))
}

impl Header {
    pub(crate) fn read(path: &str, head: &[u8]) -> Result<Self, Box<Error>> {
        let format = format_of(head);
        let start = if format == Some(Format::Nifti1) { 344 } else { 4 };
        let magic = head.get(start..start + 4).unwrap_or_default();
        let is_known = [b"n+1", b"ni1", b"n+2", b"ni2"].iter().any(|known| magic.starts_with(*known));
        let Some(format) = format.filter(|_| is_known) else {
            let is_old = format.is_some();
            let found =
                if is_old { "an Analyze 7.5 header, which states no space" } else { "no NIfTI header" };
            return Err(Error::new(path, found, "a NIfTI file").mend("convert it to NIfTI"));
        };
        let length = if format == Format::Nifti1 { 348 } else { HEADER_BYTES };
        if head.len() < length {
            let found = format!("{} bytes", head.len());
            return Err(Error::damaged(path, found, format!("a header of {length} bytes")));
        }
        Ok(if format == Format::Nifti1 { Self::first(head) } else { Self::second(head) })
    }

    pub(crate) fn length(&self) -> usize {
        if self.format == Format::Nifti1 { 348 } else { HEADER_BYTES }
    }

    fn first(head: &[u8]) -> Self {
        let is_big = is_big_endian(i64::from(Bytes(head, false).short(40)), head, 348);
        let bytes = Bytes(head, is_big);
        let float = |place| bytes.float(place);
        Self {
            format: Format::Nifti1,
            is_pair: head[345] == b'i',
            is_big,
            magic: Bytes(head, false).at(344),
            line_ends: None,
            stated_length: bytes.whole(0),
            dim: several(40, 2, |place| bytes.short(place).into()),
            glmin: bytes.whole(144),
            datatype: bytes.short(70),
            pixdim: several(76, 4, float),
            offset: bytes.float(108),
            slope: bytes.float(112),
            intercept: bytes.float(116),
            units: head[123].into(),
            qform_code: bytes.short(252).into(),
            sform_code: bytes.short(254).into(),
            quaternion: several(256, 4, float),
            shift: several(268, 4, float),
            rows: several(280, 16, |row| several(row, 4, float)),
            description: bytes.letters(148),
        }
    }

    fn second(head: &[u8]) -> Self {
        let is_big = is_big_endian(Bytes(head, false).long(16), head, 540);
        let bytes = Bytes(head, is_big);
        let double = |place| bytes.double(place);
        Self {
            format: Format::Nifti2,
            is_pair: head[5] == b'i',
            is_big,
            magic: Bytes(head, false).at(4),
            line_ends: Some(Bytes(head, false).at(8)),
            stated_length: bytes.whole(0),
            dim: several(16, 8, |place| bytes.long(place)),
            glmin: 0,
            datatype: bytes.short(12),
            pixdim: several(104, 8, double),
            offset: bytes.long(168) as f64,
            slope: bytes.double(176),
            intercept: bytes.double(184),
            units: bytes.whole(500),
            qform_code: bytes.whole(344),
            sform_code: bytes.whole(348),
            quaternion: several(352, 8, double),
            shift: several(376, 8, double),
            rows: several(400, 32, |row| several(row, 8, double)),
            description: bytes.letters(240),
        }
    }

    /// The first byte of the voxels; in a single file it follows the header.
    pub(crate) fn voxel_offset(
        &self,
        path: &str,
        is_single: bool,
        notes: &mut Vec<String>,
    ) -> Result<u64, Box<Error>> {
        let behind: u64 = if self.format == Format::Nifti1 { 352 } else { 544 };
        if is_single && self.offset == 0.0 {
            notes.push(format!("vox_offset is 0: {behind} assumed, where the header ends"));
            return Ok(behind);
        }
        let least = if is_single { behind } else { 0 };
        let is_whole = self.offset.is_finite() && self.offset.fract() == 0.0;
        if !is_whole || self.offset < least as f64 {
            let found = format!("vox_offset {}", short(self.offset, 6));
            return Err(Error::damaged(path, found, format!("a whole number from {least}")));
        }
        Ok(self.offset as u64)
    }

    pub(crate) fn size(&self, path: &str) -> Result<[u64; 3], Box<Error>> {
        let shape = self.shape();
        let written: Vec<String> = shape.iter().map(ToString::to_string).collect();
        let comma = if shape.len() == 1 { "," } else { "" };
        let written = format!("({}{comma})", written.join(", "));
        if shape.get(3).is_some_and(|&length| length > 1) {
            let found = format!("{} time points", shape[3]);
            return Err(Error::new(path, found, "one").mend("write one time point"));
        }
        if shape.iter().skip(3).any(|&length| length != 1) {
            let found = format!("several components per voxel (shape {written})");
            return Err(Error::new(path, found, "one").mend("write one component"));
        }
        if shape.len() < 3 || shape.iter().any(|&length| length < 1) {
            return Err(Error::new(path, format!("shape {written}"), "3 axes, none empty"));
        }
        Ok([shape[0], shape[1], shape[2]].map(i64::cast_unsigned))
    }

    /// The lengths of the axes, including those that FreeSurfer encodes because they do not fit in the header.
    fn shape(&self) -> Vec<i64> {
        // A negative count drops axes from the end, as in nibabel.
        let count = match self.dim[0] {
            0 => return vec![0],
            -1 => 0,
            count if count < 0 => count.saturating_add(8).max(0),
            count => count.min(7),
        };
        let shape: Vec<i64> = self.dim[1..=count as usize].to_vec();
        if self.format == Format::Nifti1 && shape.len() >= 3 {
            let first = match shape[..3] {
                [-1, 1, 1] => Some(i64::from(self.glmin)),
                [27307, 1, 6] => Some(163_842),
                _ => None,
            };
            if let Some(first) = first {
                return [first, 1, 1].into_iter().chain(shape[3..].iter().copied()).collect();
            }
        }
        shape
    }

    /// Repairs what nibabel repairs, noted in nibabel's words; rejects what nibabel rejects.
    pub(crate) fn mend(&mut self, path: &str, notes: &mut Vec<String>) -> Result<(), Box<Error>> {
        let length = self.length();
        if usize::try_from(self.stated_length) != Ok(length) {
            notes.push(format!("sizeof_hdr should be {length}; set sizeof_hdr to {length}"));
        }
        self.mend_sides(notes);
        if self.pixdim[0] != -1.0 {
            self.pixdim[0] = 1.0;
        }
        let version = if self.format == Format::Nifti1 { b'1' } else { b'2' };
        if self.magic[2] != version || self.magic[3] != 0 {
            let expected = format!("the magic string of {}", self.format.name());
            return Err(Error::damaged(path, "a magic string that is not valid", expected));
        }
        self.qform_code = mended_code("qform_code", self.qform_code, notes);
        self.sform_code = mended_code("sform_code", self.sform_code, notes);
        if self.line_ends.is_some_and(|ends| ends != *b"\r\n\x1a\n" && ends != [0; 4]) {
            let found = "EOL check not 0 or 13, 10, 26, 10: line ends may have been converted";
            return Err(Error::damaged(path, found, "a file without conversion of line ends"));
        }
        Ok(())
    }

    fn mend_sides(&mut self, notes: &mut Vec<String>) {
        let sides = &mut self.pixdim[1..4];
        let has_zero = sides.contains(&0.0);
        let has_negative = sides.iter().any(|&side| side < 0.0);
        if !has_zero && !has_negative {
            return;
        }
        let joined = |zero: &str, negative: &str| match (has_zero, has_negative) {
            (true, true) => format!("{zero} and {negative}"),
            (true, false) => zero.to_owned(),
            _ => negative.to_owned(),
        };
        let fault = joined("pixdim[1,2,3] should be non-zero", "pixdim[1,2,3] should be positive");
        let mend = joined("setting 0 dims to 1", "setting to abs of pixdim values");
        notes.push(shown(&format!("{fault}; {mend}")));
        for side in sides {
            *side = if *side == 0.0 { 1.0 } else { side.abs() };
        }
    }
}

fn mended_code(name: &str, stated: i32, notes: &mut Vec<String>) -> i32 {
    if (0..=MOST_CODE).contains(&stated) {
        return stated;
    }
    notes.push(format!("{name} {stated} not valid; setting to 0"));
    0
}

/// The byte order is that in which the number of axes is from 1 to 7; if it is 0, the header's length decides.
fn is_big_endian(little_count: i64, head: &[u8], length: u32) -> bool {
    if little_count == 0 { head[..4] == length.to_be_bytes() } else { !(1..=7).contains(&little_count) }
}
