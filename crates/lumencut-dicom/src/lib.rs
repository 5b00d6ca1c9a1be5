//! Plans how to read DICOM series from the values in their headers.
//!
//! A host (the Python package or a browser page) finds files and reads headers. Pure functions here decide
//! which files are images, which series is read, and where its slices lie. They find missing, repeated and
//! uneven slices, and how stored numbers become values. So every host gives the same results and messages.
//! This crate opens no files and reads no pixels.
//!
//! [`judge`] turns [`Headers`] into a [`Plan`] for reading pixels, or an [`Error`]. If a plan treats two
//! frames as equal, the host compares their values ([`Plan::compared`]), and asks again if some differ.
//! [`describe`] returns a [`Report`] per series. [`json`] has the same functions for JSON. [`Keyword::ALL`]
//! lists the attributes to read, [`Keyword::groups`] their functional groups.
//!
//! ```
//! let headers = br#"{
//!     "transfer_syntaxes": ["1.2.840.10008.1.2.1"],
//!     "files": [{
//!         "name": "IM0001.dcm",
//!         "header": {
//!             "sop_class": "1.2.840.10008.5.1.4.1.1.2",
//!             "transfer_syntax": "1.2.840.10008.1.2.1",
//!             "pixels": "PixelData",
//!             "attributes": {
//!                 "Rows": 3, "Columns": 4, "PhotometricInterpretation": "MONOCHROME2",
//!                 "BitsAllocated": 16, "BitsStored": 12, "PixelRepresentation": 0,
//!                 "PixelSpacing": ["0.75", "0.5"], "SliceThickness": "2",
//!                 "ImagePositionPatient": ["0", "0", "4"],
//!                 "ImageOrientationPatient": ["1", "0", "0", "0", "1", "0"]
//!             }
//!         }
//!     }]
//! }"#;
//! let answer = lumencut_dicom::json::judge(headers, b"{}");
//! assert!(answer.starts_with(r#"{"plan":{"size":[4,3,1]"#));
//! ```

mod choice;
mod copies;
mod describing;
mod directions;
mod error;
mod faults;
mod gathering;
mod geometry;
mod grey;
mod grouping;
mod headers;
mod image;
mod images;
pub mod json;
mod judging;
mod keyword;
mod mend;
mod oddities;
mod patients;
mod phases;
mod plan;
mod report;
mod scan;
mod series;
mod shared_places;
mod slices;
mod spacing;
mod uids;
mod uneven;
mod value;
mod wording;

pub use directions::corrected;
pub use error::{Error, ErrorKind, Result};
pub use headers::{Attributes, File, FrameOf, Header, Headers, Unlike};
pub use judging::{Wanted, describe, judge};
pub use keyword::Keyword;
pub use mend::Mend;
pub use patients::PatientId;
pub use plan::{Compared, Details, Fill, Plan, PlannedSlice};
pub use report::Report;
pub use scan::Scan;
pub use value::Value;
