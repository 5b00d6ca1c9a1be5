//! What a header says: the grid, and where and how its voxels are stored.

use crate::error::Error;
use crate::numbers::{Kind, Scaling, settled};
use crate::segments::Segmentation;
use crate::stream::Codec;

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
    /// Its name.
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

/// Where the voxels lie in the patient.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Voxels along i, j, k.
    pub size: [u64; 3],
    /// World (LPS, mm) from index. Its numbers may be no finite ones.
    pub world_from_index: Affine,
    /// Whether lengths in mm are known.
    pub states_spacing: bool,
    /// Whether the sides of the patient are known.
    pub states_orientation: bool,
    /// The patient space as the file states it.
    pub space: String,
}

/// The file and the bytes in it that hold the voxels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name of the file, relative to the folder of the opened one. It may be missing.
    pub name: String,
    /// The byte at which the lines to leave out begin, else the voxels or the compressed stream; None: the voxels
    /// are the last bytes.
    pub start: Option<u64>,
    /// Lines to leave out at `start`.
    pub lines: u64,
    /// Bytes to leave out behind these lines, of the unpacked stream.
    pub skip: u64,
    /// How the voxels are stored.
    pub codec: Codec,
}

/// How the numbers of voxels are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// Their type.
    pub kind: Kind,
    /// Whether the most significant byte comes first.
    pub is_big: bool,
    /// What makes values of them.
    pub scaling: Scaling,
}

/// A volume whose header is read and checked, and whose voxels are not yet read.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The name of the opened file.
    pub name: String,
    /// The format.
    pub format: Format,
    /// Where the voxels lie.
    pub grid: Grid,
    /// How their numbers are stored.
    pub stored: Stored,
    /// Where they are stored.
    pub place: Place,
    /// What every reader must know: assumptions and mended faults.
    pub notes: Vec<String>,
    /// What a report on the file tells.
    pub remarks: Vec<String>,
    /// Names of labels, by value.
    pub label_names: Vec<(i64, String)>,
    /// The segments of a segmentation.
    pub segmentation: Option<Segmentation>,
    /// What the file says that it holds. It may name a patient: only the mark of a straightened vessel is read.
    pub description: String,
}

impl Plan {
    /// The type of the voxels once they are read, as far as the header decides it; `in_engine` as `Fill::new` has it.
    #[must_use]
    pub fn settled(&self, in_engine: bool) -> Option<Kind> {
        let stored = self.stored;
        let kind = match &self.segmentation {
            Some(segmentation) if !segmentation.is_as_stored => Some(segmentation.kind()),
            _ => settled(stored.kind, stored.scaling),
        };
        if in_engine { kind.map(Kind::in_the_engine) } else { kind }
    }

    /// The error for a file of voxels that is not there.
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

/// Rows without the minus signs of zeros.
pub(crate) fn without_negative_zeros(rows: Affine) -> Affine {
    rows.map(|row| row.map(|value| value + 0.0))
}

/// Where the voxels of a file beside the header are: `name` is the text of the header's field `field`.
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
    crate::beside::inside(header, name, field)
}
