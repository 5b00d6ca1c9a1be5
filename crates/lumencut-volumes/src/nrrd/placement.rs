//! Where an NRRD header places its grid.

use super::fields::Header;
use crate::error::Error;
use crate::plan::{Affine, without_negative_zeros};
use crate::text::{quoted, shown};

const TO_LPS: [(&str, &str, [f64; 3]); 3] = [
    ("left-posterior-superior", "lps", [1.0, 1.0, 1.0]),
    ("right-anterior-superior", "ras", [-1.0, -1.0, 1.0]),
    ("left-anterior-superior", "las", [1.0, -1.0, 1.0]),
];
const MILLIMETRES: [(&str, f64); 7] = [
    ("mm", 1.0),
    ("millimeter", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("um", 0.001),
    ("µm", 0.001),
    ("micron", 0.001),
];

fn millimetres(unit: &str) -> Option<f64> {
    MILLIMETRES.iter().find(|(name, _)| *name == unit).map(|&(_, factor)| factor)
}

impl Header<'_> {
    pub(crate) fn affine(&self, axes: &[usize; 3], notes: &mut Vec<String>) -> Result<Affine, Box<Error>> {
        let columns = self.columns(axes, notes)?;
        let origin = self.origin_or_zero(notes)?;
        let unit = self.unit_noted(notes)?;
        let signs = self.signs(notes);
        let row = |axis: usize| {
            let row = [columns[0][axis], columns[1][axis], columns[2][axis], origin[axis]];
            row.map(|value| value * unit * signs[axis])
        };
        Ok(without_negative_zeros([row(0), row(1), row(2)]))
    }

    fn columns(&self, axes: &[usize; 3], notes: &mut Vec<String>) -> Result<[[f64; 3]; 3], Box<Error>> {
        let Some(directions) = self.directions()? else {
            return self.along_axes(axes, notes);
        };
        let mut columns = [[0.0; 3]; 3];
        for (column, &axis) in columns.iter_mut().zip(axes) {
            let stated = directions.get(axis).and_then(Option::as_deref).unwrap_or_default();
            *column = stated.try_into().map_err(|_| {
                let found = format!("space directions: {} numbers", stated.len());
                Error::new(self.path, found, "3 numbers per axis")
            })?;
        }
        Ok(columns)
    }

    fn along_axes(&self, axes: &[usize; 3], notes: &mut Vec<String>) -> Result<[[f64; 3]; 3], Box<Error>> {
        let steps = self.spacings(axes)?;
        if !steps.iter().all(|step| step.is_finite()) {
            notes.push("no spacing stated: 1 mm assumed".into());
        }
        let step = |axis: usize| if steps[axis].is_finite() { steps[axis] } else { 1.0 };
        Ok(std::array::from_fn(|column| {
            std::array::from_fn(|row| if row == column { step(column) } else { 0.0 })
        }))
    }

    fn spacings(&self, axes: &[usize; 3]) -> Result<[f64; 3], Box<Error>> {
        let stated = self.numbers("spacings")?;
        Ok(axes.map(|axis| stated.get(axis).copied().unwrap_or(f64::NAN)))
    }

    fn origin_or_zero(&self, notes: &mut Vec<String>) -> Result<[f64; 3], Box<Error>> {
        let Some(origin) = self.origin()? else {
            let unused = if self.has("axis mins") { ", axis mins are not used" } else { "" };
            notes.push(format!("no space origin stated{unused}: (0, 0, 0) assumed"));
            return Ok([0.0; 3]);
        };
        let found = || format!("space origin: {} numbers", origin.len());
        origin.as_slice().try_into().map_err(|_| Error::new(self.path, found(), "3 numbers"))
    }

    /// Whether lengths in mm are known: they are stated, and not in an unknown unit.
    pub(crate) fn states_spacing(&self, axes: &[usize; 3]) -> Result<bool, Box<Error>> {
        let has_spacings = self.spacings(axes)?.iter().all(|step| step.is_finite());
        let unit = self.unit()?;
        Ok((self.has("space directions") || has_spacings)
            && (unit.is_empty() || millimetres(&unit).is_some()))
    }

    fn patient_space(&self) -> String {
        let space = self.text("space").to_ascii_lowercase();
        space.strip_suffix("-time").unwrap_or(&space).to_owned()
    }

    fn to_lps(&self) -> Option<[f64; 3]> {
        let stated = self.patient_space();
        TO_LPS.iter().find(|(name, short, _)| *name == stated || *short == stated).map(|found| found.2)
    }

    pub(crate) fn names_patient_axes(&self) -> bool {
        self.to_lps().is_some()
    }

    fn signs(&self, notes: &mut Vec<String>) -> [f64; 3] {
        self.to_lps().unwrap_or_else(|| {
            let stated = self.patient_space();
            notes.push(if stated.is_empty() {
                "no space stated: LPS assumed".into()
            } else {
                format!("space {} names no patient axes: LPS assumed", quoted(&shown(&stated)))
            });
            [1.0; 3]
        })
    }

    fn unit_noted(&self, notes: &mut Vec<String>) -> Result<f64, Box<Error>> {
        let unit = self.unit()?;
        if unit.is_empty() {
            return Ok(1.0);
        }
        let factor = millimetres(&unit);
        if factor.is_none() {
            notes.push(format!("space units {} are not known: mm assumed", quoted(&shown(&unit))));
        } else if factor != Some(1.0) {
            notes.push(format!("lengths are in {unit}: converted to mm"));
        }
        Ok(factor.unwrap_or(1.0))
    }

    /// The unit of the first axis of the space, in the singular if it is known; empty if none is stated.
    fn unit(&self) -> Result<String, Box<Error>> {
        let words = self.words("space units")?;
        let stated = words.first().map_or("", |word| word.trim_matches(['"', ' '])).to_ascii_lowercase();
        if stated == "???" {
            return Ok(String::new());
        }
        let singular = stated.strip_suffix('s').unwrap_or(&stated);
        let is_plural = millimetres(&stated).is_none() && millimetres(singular).is_some();
        Ok(if is_plural { singular.to_owned() } else { stated })
    }
}
