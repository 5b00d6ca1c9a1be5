//! Where a NIfTI header places its grid: by the sform (including shear), else by the qform, else centred at the
//! origin.

use super::header::Header;
use super::wide::Wide;
use crate::error::Error;
use crate::plan::{Affine, Format, without_negative_zeros};
use crate::text::short;

/// Codes of units of time, which are in the same field as the unit of length.
const TIMES: [i32; 7] = [0, 8, 16, 24, 32, 40, 48];
/// A larger difference between two placements (mm) is noted.
const APART: f64 = 0.01;
/// Axes with at most this angle between them count as equal (degrees).
const SAME_AXIS: f64 = 25.0;

impl Header {
    pub(crate) fn placement(
        &self,
        path: &str,
        size: [u64; 3],
        notes: &mut Vec<String>,
    ) -> Result<Affine, Box<Error>> {
        let ras = self.best_affine(path)?;
        let millimetres = self.millimetres(notes);
        self.note_forms(size, notes);
        let signs = [-1.0, -1.0, 1.0];
        let lps = std::array::from_fn(|row| ras[row].map(|value| value * signs[row] * millimetres));
        Ok(without_negative_zeros(lps))
    }

    fn best_affine(&self, path: &str) -> Result<Affine, Box<Error>> {
        if self.sform_code != 0 {
            return Ok(self.rows);
        }
        if self.qform_code == 0 {
            return Ok(self.centred());
        }
        let refused =
            || Error::new(path, "a qform that is no rotation", "a unit quaternion").mend("state an sform");
        self.qform().ok_or_else(refused)
    }

    fn centred(&self) -> Affine {
        let sides = [-self.pixdim[1], self.pixdim[2], self.pixdim[3]];
        std::array::from_fn(|axis| {
            let mut row = [0.0, 0.0, 0.0, -(self.dim[axis + 1] as f64 - 1.0) / 2.0 * sides[axis]];
            row[axis] = sides[axis];
            row
        })
    }

    fn qform(&self) -> Option<Affine> {
        let [x, y, z] = self.quaternion.map(Wide::from);
        let [one, two] = [1.0, 2.0].map(Wide::from);
        // The stored precision decides by how much the squared length may exceed 1.
        let precision = if self.format == Format::Nifti1 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        let square = one - (x * x + y * y + z * z);
        let is_nothing = square.narrow().abs() < 3.0 * precision;
        if !is_nothing && square.narrow() < 0.0 {
            return None;
        }
        let w = if is_nothing { Wide::ZERO } else { square.sqrt() };
        let double = two / (w * w + x * x + y * y + z * z);
        let (dx, dy, dz) = (x * double, y * double, z * double);
        let (wx, wy, wz) = (w * dx, w * dy, w * dz);
        let (xx, xy, xz) = (x * dx, x * dy, x * dz);
        let (yy, yz, zz) = (y * dy, y * dz, z * dz);
        let rotation = [
            [one - (yy + zz), xy - wz, xz + wy],
            [xy + wz, one - (xx + zz), yz - wx],
            [xz - wy, yz + wx, one - (xx + yy)],
        ];
        let sides = [self.pixdim[1], self.pixdim[2], self.pixdim[3] * self.pixdim[0]].map(Wide::from);
        Some(std::array::from_fn(|row| {
            let [i, j, k] = std::array::from_fn(|column| (rotation[row][column] * sides[column]).narrow());
            [i, j, k, self.shift[row]]
        }))
    }

    /// The unit of length and its millimetres; None if the header states no known unit.
    fn unit(&self) -> Option<(&'static str, f64)> {
        let code = self.units.rem_euclid(8);
        if !TIMES.contains(&(self.units - code)) {
            return None;
        }
        match code {
            1 => Some(("meter", 1000.0)),
            2 => Some(("mm", 1.0)),
            3 => Some(("micron", 0.001)),
            _ => None,
        }
    }

    pub(crate) fn millimetres(&self, notes: &mut Vec<String>) -> f64 {
        match self.unit() {
            None => notes.push("the unit of length is not stated: mm assumed".into()),
            Some(("mm", _)) => {}
            Some((unit, _)) => notes.push(format!("lengths are in {unit}s: converted to mm")),
        }
        self.unit().map_or(1.0, |(_, millimetres)| millimetres)
    }

    fn is_placed(&self) -> bool {
        self.sform_code > 0 || self.qform_code > 0
    }

    pub(crate) fn space(&self) -> &'static str {
        match (self.sform_code > 0, self.qform_code > 0) {
            (true, _) => "RAS by sform",
            (false, true) => "RAS by qform",
            (false, false) => "none stated",
        }
    }

    /// Whether lengths in mm are known; a placement is in mm by convention.
    pub(crate) fn states_spacing(&self) -> bool {
        self.is_placed() || self.unit().is_some()
    }

    /// Whether the axes are placed in the patient, without a second placement that differs by more than 25 degrees.
    pub(crate) fn states_orientation(&self) -> bool {
        if !(self.sform_code > 0 && self.qform_code > 0) {
            return self.is_placed();
        }
        let Some(other) = self.qform() else { return true };
        (0..3).all(|axis| {
            let column = |rows: &Affine| [rows[0][axis], rows[1][axis], rows[2][axis]];
            let (one, two) = (column(&self.rows), column(&other));
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            dot(one, two) / (dot(one, one).sqrt() * dot(two, two).sqrt()) > SAME_AXIS.to_radians().cos()
        })
    }

    fn note_forms(&self, size: [u64; 3], notes: &mut Vec<String>) {
        if !self.is_placed() {
            let assumed = "centred at the origin, i to the left, like nibabel";
            notes.push(format!("no placement (qform_code = sform_code = 0): {assumed}"));
        }
        if self.sform_code == 0 || self.qform_code == 0 {
            return;
        }
        let Some(other) = self.qform() else {
            notes.push("the qform is no rotation: the sform is used".into());
            return;
        };
        let apart = farthest(&self.rows, &other, size);
        if apart > APART || apart.is_nan() {
            notes.push(format!("sform and qform lie up to {} apart: the sform is used", short(apart, 3)));
        }
    }
}

/// The largest difference between two placements at a corner of the grid, along one axis; NaN if unknown.
fn farthest(one: &Affine, other: &Affine, size: [u64; 3]) -> f64 {
    let mut apart: f64 = 0.0;
    for corner in 0..8 {
        let index = |axis: usize| if corner >> axis & 1 == 1 { size[axis] as f64 } else { 0.0 };
        for (row, rest) in one.iter().zip(other) {
            let off: f64 = (0..3).map(|axis| (row[axis] - rest[axis]) * index(axis)).sum();
            let off = (off + (row[3] - rest[3])).abs();
            if off.is_nan() {
                return off;
            }
            apart = apart.max(off);
        }
    }
    apart
}
