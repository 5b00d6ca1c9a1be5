//! What a header states: the grid, and where and how the voxels are stored.

use crate::error::{Error, Opening};
use crate::known::{Found, Known};
use crate::numbers::{Kind, Scaling, settled};
use crate::segments::Segmentation;
use crate::stream::Codec;
use crate::text::{is_all_printable, shown};

/// A format of volume files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// NIfTI-1.
    Nifti1,
    /// NIfTI-2.
    Nifti2,
    /// NRRD.
    Nrrd,
    /// MetaImage.
    MetaImage,
}

impl Format {
    /// The name of the format.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nifti1 => "NIfTI-1",
            Self::Nifti2 => "NIfTI-2",
            Self::Nrrd => "NRRD",
            Self::MetaImage => "MetaImage",
        }
    }
}

/// World (LPS, mm) from index (i, j, k): the upper three rows of an affine matrix.
pub type Affine = [[f64; 4]; 3];

/// The positions of the voxels in the patient.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Number of voxels along i, j, k.
    pub size: [u64; 3],
    /// World (LPS, mm) from index.
    pub world_from_index: Affine,
    /// Whether lengths in mm are known.
    pub states_spacing: bool,
    /// Whether the sides of the patient are known.
    pub states_orientation: bool,
    /// The patient space as the file states it.
    pub space: String,
}

/// The file that holds the voxels, and their position in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name relative to the folder of the opened file. This file may be missing.
    pub name: String,
    /// The byte at which lines to skip begin, else the voxels or the compressed stream. None if the voxels are the
    /// last bytes.
    pub start: Option<u64>,
    /// Number of lines to skip at `start`.
    pub lines: u64,
    /// Number of bytes to skip after these lines, in the unpacked stream.
    pub skip: u64,
    /// How the voxels are stored.
    pub codec: Codec,
}

/// How the numbers of voxels are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// The type of the numbers.
    pub kind: Kind,
    /// Whether the most significant byte comes first.
    pub is_big: bool,
    /// The scaling that turns the numbers into values.
    pub scaling: Scaling,
}

/// A volume whose header is read and checked, and whose voxels are not yet read.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The name of the opened file.
    pub name: String,
    /// The format.
    pub format: Format,
    /// The grid of the voxels.
    pub grid: Grid,
    /// How the numbers are stored.
    pub stored: Stored,
    /// Where the numbers are stored.
    pub place: Place,
    /// What every user must know: assumptions and repaired faults.
    pub notes: Vec<String>,
    /// Further statements for a report on the file.
    pub remarks: Vec<String>,
    /// Names of labels, by value.
    pub label_names: Vec<(i64, String)>,
    /// The segments of a segmentation.
    pub segmentation: Option<Segmentation>,
    /// The file's description of its content. It may name a patient: use only the mark of a straightened vessel in
    /// it.
    pub description: String,
}

impl Plan {
    /// The type of the voxels once read, if the header decides it; `in_engine` as in [`crate::Fill::new`].
    #[must_use]
    pub fn settled(&self, in_engine: bool) -> Option<Kind> {
        let stored = self.stored;
        let kind = match &self.segmentation {
            Some(segmentation) if !segmentation.is_as_stored => Some(segmentation.kind()),
            _ => settled(stored.kind, stored.scaling),
        };
        if in_engine { kind.map(Kind::in_the_engine) } else { kind }
    }

    /// The error for a missing file of voxels.
    #[must_use]
    pub fn missing(&self) -> Box<Error> {
        Error::missing(&self.place.name, &format!("the voxels of {}", self.name))
    }

    pub(crate) fn voxels(&self) -> u128 {
        product(&self.grid.size)
    }

    pub(crate) fn stored_bytes(&self) -> u128 {
        let layers = self.segmentation.as_ref().map_or(1, |segmentation| segmentation.layers);
        product(&[layers, self.stored.kind.bytes() as u64]).saturating_mul(self.voxels())
    }
}

fn product(numbers: &[u64]) -> u128 {
    numbers.iter().fold(1, |all: u128, &number| all.saturating_mul(number.into()))
}

pub(crate) fn without_negative_zeros(rows: Affine) -> Affine {
    rows.map(|row| row.map(|value| value + 0.0))
}

/// The file next to the header that holds the voxels; `name` is the text of the header's field `field`.
pub(crate) fn detached(
    header: &str,
    name: &str,
    field: &str,
    found: impl FnOnce(&str) -> String,
    single: &str,
) -> Result<String, Box<Error>> {
    if name.split_whitespace().next() == Some("LIST") || name.contains('%') {
        let mend = format!("write a single {single}");
        return Err(Error::new(header, found(name), "voxels in one file").mend(&mend));
    }
    inside(header, name, field)
}

/// The name of a file in the header's folder or a folder below it; Windows separators are accepted.
pub(crate) fn inside(header: &str, name: &str, field: &str) -> Result<String, Box<Error>> {
    let parts: Vec<&str> = name.split(['/', '\\']).filter(|part| !part.is_empty() && *part != ".").collect();
    let is_absolute = name.starts_with(['/', '\\', '~']) || has_drive(name);
    if parts.is_empty() && !is_absolute || !is_all_printable(name) {
        let expected = "the name of a file next to the header";
        return Err(Error::new(header, format!("no file name in {field}"), expected));
    }
    if is_absolute || parts.contains(&"..") {
        return Err(outside(header, name, field));
    }
    Ok(parts.join("/"))
}

fn has_drive(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|letter| letter.is_ascii_alphabetic()) && letters.next() == Some(':')
}

fn outside(header: &str, name: &str, field: &str) -> Box<Error> {
    let found = format!("{field}: a path that leaves the folder ({})", shown(name));
    Error::new(header, found, "a file in the folder of the header or below")
        .mend("copy it there and name it without a path")
}

/// Rejects a link to a file outside the folder. A missing file is reported when it is read.
pub(crate) fn require_inside(known: &Known, header: &str, name: &str, field: &str) -> Opening<()> {
    match known.found(name)? {
        Found::Outside(_) => Err(outside(header, name, field).into()),
        Found::Missing | Found::Size(_) => Ok(()),
    }
}
