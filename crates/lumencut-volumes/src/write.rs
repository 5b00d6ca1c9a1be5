//! Writes volumes as NIfTI-1 and NRRD files.

use crate::numbers::Kind;
use crate::plan::Affine;

const DESCRIPTION: usize = 79;
/// NIfTI's code for a placement in the space of another scan.
const ALIGNED: i16 = 2;
const MILLIMETRES: u8 = 2;
const LONGEST_AXIS: u64 = i16::MAX as u64;

/// A volume to write.
#[derive(Clone, Debug)]
pub struct Written<'a> {
    /// Number of voxels along i, j, k.
    pub size: [u64; 3],
    /// World (LPS, mm) from index.
    pub world_from_index: Affine,
    /// The type of the voxels, in this machine's byte order.
    pub kind: Kind,
    /// A description of the content, at most 79 ASCII characters.
    pub mark: &'a str,
}

impl Written<'_> {
    /// The header of a NIfTI file, up to its first voxel: NIfTI-1, or NIfTI-2 if an axis is too long for NIfTI-1.
    #[must_use]
    pub fn nifti(&self) -> Vec<u8> {
        let is_long = self.size.iter().any(|&side| side > LONGEST_AXIS);
        if is_long { self.second_nifti() } else { self.first_nifti() }
    }

    fn first_nifti(&self) -> Vec<u8> {
        let mut bytes = vec![0; 352];
        let mut put = |at: usize, value: &[u8]| bytes[at..at + value.len()].copy_from_slice(value);
        let floats = |values: &[f64]| -> Vec<u8> {
            values.iter().flat_map(|&value| (value as f32).to_ne_bytes()).collect()
        };
        let dim = self.dim().map(|side| (side as i16).to_ne_bytes()).concat();
        put(0, &348_i32.to_ne_bytes());
        put(40, &dim);
        put(70, &self.code().to_ne_bytes());
        put(72, &self.bits().to_ne_bytes());
        put(76, &floats(&self.pixdim()));
        put(108, &floats(&[352.0, 1.0, 0.0]));
        put(123, &[MILLIMETRES]);
        put(148, self.description());
        put(254, &ALIGNED.to_ne_bytes());
        put(280, &floats(self.ras().as_flattened()));
        put(344, b"n+1\0");
        bytes
    }

    fn second_nifti(&self) -> Vec<u8> {
        let mut bytes = vec![0; 544];
        let mut put = |at: usize, value: &[u8]| bytes[at..at + value.len()].copy_from_slice(value);
        let floats =
            |values: &[f64]| -> Vec<u8> { values.iter().flat_map(|&value| value.to_ne_bytes()).collect() };
        put(0, &540_i32.to_ne_bytes());
        put(4, b"n+2\0\r\n\x1a\n");
        put(12, &self.code().to_ne_bytes());
        put(14, &self.bits().to_ne_bytes());
        put(16, &self.dim().map(i64::to_ne_bytes).concat());
        put(104, &floats(&self.pixdim()));
        put(168, &544_i64.to_ne_bytes());
        put(176, &floats(&[1.0, 0.0]));
        put(240, self.description());
        put(348, &i32::from(ALIGNED).to_ne_bytes());
        put(400, &floats(self.ras().as_flattened()));
        put(500, &i32::from(MILLIMETRES).to_ne_bytes());
        bytes
    }

    fn dim(&self) -> [i64; 8] {
        let [i, j, k] = self.size.map(u64::cast_signed);
        [3, i, j, k, 1, 1, 1, 1]
    }

    fn pixdim(&self) -> [f64; 8] {
        let rows = &self.world_from_index;
        let side = |axis: usize| rows.iter().map(|row| row[axis] * row[axis]).sum::<f64>().sqrt();
        [1.0, side(0), side(1), side(2), 1.0, 1.0, 1.0, 1.0]
    }

    /// NIfTI's axes point to the right and the front, those of volumes to the left and the back.
    fn ras(&self) -> Affine {
        let [x, y, z] = self.world_from_index;
        [x.map(|value| 0.0 - value), y.map(|value| 0.0 - value), z]
    }

    fn code(&self) -> i16 {
        match self.kind {
            Kind::Uint8 => 2,
            Kind::Int16 => 4,
            Kind::Int32 => 8,
            Kind::Float32 => 16,
            Kind::Float64 => 64,
            Kind::Int8 => 256,
            Kind::Uint16 => 512,
            Kind::Uint32 => 768,
            Kind::Int64 => 1024,
            Kind::Uint64 => 1280,
        }
    }

    fn bits(&self) -> i16 {
        8 * self.kind.bytes() as i16
    }

    fn description(&self) -> &[u8] {
        let mark = self.mark.as_bytes();
        &mark[..mark.len().min(DESCRIPTION)]
    }

    /// The header of an NRRD file, up to its first voxel or gzip stream.
    #[must_use]
    pub fn nrrd(&self, is_packed: bool) -> String {
        let vector =
            |numbers: [f64; 3]| format!("({})", numbers.map(|number| format!("{number:?}")).join(","));
        let column = |axis: usize| vector([0, 1, 2].map(|row| self.world_from_index[row][axis]));
        let kind = match self.kind {
            Kind::Float32 => "float",
            Kind::Float64 => "double",
            kind => kind.name(),
        };
        let content = if self.mark.is_empty() { String::new() } else { format!("content: {}\n", self.mark) };
        let endian = if cfg!(target_endian = "big") { "big" } else { "little" };
        format!(
            "NRRD0005\n# http://teem.sourceforge.net/nrrd/format.html\n{content}type: {kind}\ndimension: 3\n\
             space: left-posterior-superior\nsizes: {}\nspace directions: {} {} {}\nkinds: domain domain domain\n\
             endian: {endian}\nencoding: {}\nspace origin: {}\n\n",
            self.size.map(|side| side.to_string()).join(" "),
            column(0),
            column(1),
            column(2),
            if is_packed { "gzip" } else { "raw" },
            column(3),
        )
    }
}
