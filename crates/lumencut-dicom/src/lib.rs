//! Judges DICOM series by the values of their headers.
//!
//! A host (the Python package, a browser) finds files and reads their headers. Which of them are images, which
//! series is read, where its slices lie, what is missing, doubled or uneven, and how stored numbers become values
//! is decided here, by pure functions, so that every host decides alike and says so in the same words. This crate
//! opens no file and knows no pixels.
//!
//! [`Headers`] go in. [`judge`] gives a [`Plan`] by which the host reads pixels into a volume, or an [`Error`].
//! Where a plan takes two frames for one, the host compares their values ([`Plan::compared`]) and asks again with those that
//! differ;
//! [`describe`] gives a [`Report`] of each series. [`json`] does the same with documents. [`Keyword::ALL`] lists the
//! attributes that a host has to read, [`Keyword::groups`] where enhanced multi-frame images keep them.
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
pub use plan::{Compared, Details, Fill, Plan, PlannedSlice};
pub use report::Report;
pub use scan::Scan;
pub use value::Value;
