//! The remedies ("mends") for errors of all crates: a name and choices. Python package and viewer state them in their own words.

use serde::ser::{Serialize, SerializeStruct, Serializer};

pub use lumencut_core::error::Mend as OfCore;
pub use lumencut_dicom::Mend as OfDicom;
pub use lumencut_io::Mend as OfCenterlines;

/// A remedy of any crate; in JSON `{"name": …, "values": […]}`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mend {
    /// For views, devices, volumes, tracing and measuring.
    Core(OfCore),
    /// Of centerline files.
    Centerlines(OfCenterlines),
    /// Of DICOM series.
    Dicom(OfDicom),
}

impl Mend {
    /// The name of the remedy, the same in Python package and viewer.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Core(mend) => mend.name(),
            Self::Centerlines(mend) => mend.name(),
            Self::Dicom(mend) => mend.name(),
        }
    }

    /// The choices, such as units or phases; may be empty.
    pub fn values(&self) -> Vec<&str> {
        match self {
            Self::Core(_) => Vec::new(),
            Self::Centerlines(mend) => mend.values(),
            Self::Dicom(mend) => mend.values().iter().map(String::as_str).collect(),
        }
    }
}

impl From<OfCore> for Mend {
    fn from(mend: OfCore) -> Self {
        Self::Core(mend)
    }
}

impl From<OfCenterlines> for Mend {
    fn from(mend: OfCenterlines) -> Self {
        Self::Centerlines(mend)
    }
}

impl From<OfDicom> for Mend {
    fn from(mend: OfDicom) -> Self {
        Self::Dicom(mend)
    }
}

impl Serialize for Mend {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut fields = to.serialize_struct("Mend", 2)?;
        fields.serialize_field("name", self.name())?;
        fields.serialize_field("values", &self.values())?;
        fields.end()
    }
}

/// The names of all remedies. Python package and viewer have words for each.
pub fn names() -> Vec<&'static str> {
    let of_core = OfCore::ALL.into_iter().map(OfCore::name);
    of_core.chain(OfCenterlines::NAMES).chain(OfDicom::NAMES).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_differ_across_crates() {
        let names = names();
        assert!(names.iter().enumerate().all(|(n, name)| !names[..n].contains(name)), "{names:?}");
    }

    #[test]
    fn a_mend_is_told_by_its_name_and_values() {
        let json = |mend: Mend| serde_json::to_string(&mend).expect("JSON");
        assert_eq!(json(OfCore::Bridge.into()), r#"{"name":"bridge","values":[]}"#);
        assert_eq!(
            json(OfCenterlines::Coordinates.into()),
            r#"{"name":"coordinates","values":["lps","ras"]}"#
        );
        assert_eq!(json(OfDicom::Phase(vec!["400".into()]).into()), r#"{"name":"phase","values":["400"]}"#);
    }
}
