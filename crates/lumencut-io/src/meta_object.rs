//! Reads the fields of a MetaIO object, and its transform.

use glam::{DAffine3, DMat3, DVec3};

use crate::centerlines::Line;
use crate::error::{Error, Result, excerpt};

/// Names of the fields that are read.
const KNOWN: [&str; 18] = [
    "NDims",
    "ID",
    "ParentID",
    "Name",
    "PointDim",
    "NPoints",
    "BinaryData",
    "CompressedData",
    "ElementType",
    "BinaryDataByteOrderMSB",
    "ElementByteOrderMSB",
    "ElementSpacing",
    "TransformMatrix",
    "Rotation",
    "Orientation",
    "Offset",
    "Position",
    "Origin",
];

pub(crate) struct MetaObject {
    kind: String,
    fields: Vec<(&'static str, String)>,
    /// The line, in units of the object.
    pub line: Option<Line>,
}

pub(crate) fn one_of(name: &str, wanted: &[&str]) -> bool {
    wanted.iter().any(|wanted| name.eq_ignore_ascii_case(wanted))
}

impl MetaObject {
    pub(crate) fn new(kind: &str) -> Self {
        Self { kind: kind.to_owned(), fields: Vec::new(), line: None }
    }

    pub(crate) fn is_tube(&self) -> bool {
        one_of(&self.kind, &["Tube", "VesselTube", "DTITube"])
    }

    /// Fails if the object is a tube without points.
    pub(crate) fn check_points(&self) -> Result<()> {
        if self.is_tube() && self.line.is_none() {
            return Err(Error::truncated(self.title(), "no Points", "the points of the tube"));
        }
        Ok(())
    }

    pub(crate) fn set(&mut self, key: &str, value: &str) {
        if let Some(key) = KNOWN.iter().find(|known| **known == key).filter(|key| self.get(key).is_none()) {
            self.fields.push((key, value.to_owned()));
        }
    }

    pub(crate) fn get(&self, key: &str) -> Option<&str> {
        self.fields.iter().find(|(known, _)| *known == key).map(|(_, value)| value.as_str())
    }

    pub(crate) fn is_true(&self, key: &str) -> bool {
        self.get(key).is_some_and(|value| one_of(value, &["True", "T", "1"]))
    }

    pub(crate) fn id(&self, key: &str) -> Option<i64> {
        self.get(key)?.parse().ok().filter(|id| *id >= 0)
    }

    pub(crate) fn title(&self) -> String {
        format!("{} {}", self.kind, self.get("ID").unwrap_or("without ID"))
    }

    /// Point spacing along each axis; 1 if not stated.
    pub(crate) fn spacing(&self) -> Result<DVec3> {
        let Some(spacing) = self.numbers::<3>(&["ElementSpacing"])? else { return Ok(DVec3::ONE) };
        if spacing.iter().all(|size| *size > 0.0) {
            return Ok(DVec3::from(spacing));
        }
        Err(Error::new("ElementSpacing", format!("{spacing:?}"), "3 numbers above 0"))
    }

    /// The transform to the parent: a row-major matrix, and an offset that includes the centre of rotation.
    pub(crate) fn parent_from_object(&self) -> Result<DAffine3> {
        let matrix = self.numbers::<9>(&["TransformMatrix", "Rotation", "Orientation"])?;
        let matrix = matrix.map_or(DMat3::IDENTITY, |rows| DMat3::from_cols_array(&rows).transpose());
        let offset = self.numbers::<3>(&["Offset", "Position", "Origin"])?;
        Ok(DAffine3::from_mat3_translation(matrix, offset.map_or(DVec3::ZERO, DVec3::from)))
    }

    fn numbers<const N: usize>(&self, keys: &[&str]) -> Result<Option<[f64; N]>> {
        let Some(text) = keys.iter().find_map(|key| self.get(key)) else { return Ok(None) };
        let numbers: Option<Vec<f64>> = text
            .split_whitespace()
            .map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()))
            .collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        let wrong =
            || Error::new(format!("{}: {}", self.title(), keys[0]), excerpt(text), format!("{N} numbers"));
        numbers.map(Some).ok_or_else(wrong)
    }
}
