//! Volume files without a file system: NIfTI, NRRD and MetaImage.
//!
//! [`open`] reads a header from the bytes that a host has fetched, or states which bytes it still needs. [`Fill`]
//! converts the bytes of a file to voxels, in pieces. [`Written`] and [`Packer`] write files. Hosts with files and
//! hosts with asynchronous reads use the same functions:
//!
//! ```
//! use lumencut_volumes::{Fill, Found, Known, Need, Step, Stop, Window, Written, open};
//!
//! # let world_from_index = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
//! # let kind = lumencut_volumes::Kind::Uint8;
//! # let mut file = Written { size: [2, 2, 1], world_from_index, kind, mark: "" }.nifti();
//! # file.extend([1, 2, 3, 4]);
//! let mut known = Known::new();
//! let plan = loop {
//!     match open("scan.nii", &known, None) {
//!         Ok(plan) => break plan,
//!         Err(Stop::Need(Need::Sizes(names))) => {
//!             for name in names {
//!                 let is_there = name == "scan.nii";
//!                 known.add_size(&name, if is_there { Found::Size(file.len() as u64) } else { Found::Missing });
//!             }
//!         }
//!         Err(Stop::Need(Need::Bytes { name, start, end })) => {
//!             known.add_bytes(&name, start, &file[start as usize..end as usize]);
//!         }
//!         Err(stop) => panic!("{stop:?}"),
//!     }
//! };
//! // The file that `plan.place.name` names.
//! let mut fill = Fill::new(plan, file.len() as u64, false);
//! let (mut window, mut voxels, mut at) = (Window::default(), Vec::new(), 0);
//! loop {
//!     match fill.step(window, &mut voxels[at..]).unwrap() {
//!         Step::Read { start, end } => window = Window { start, bytes: &file[start as usize..end as usize] },
//!         Step::Sound { .. } | Step::Checked(_) => {}
//!         Step::Room { bytes, .. } => voxels = vec![0; bytes as usize],
//!         Step::Filled(count) => at += count,
//!         Step::Done => break,
//!     }
//! }
//! assert_eq!(voxels, [1, 2, 3, 4]);
//! ```

mod built_in;
mod convert;
mod decoder;
mod error;
mod fill;
mod grid;
mod known;
mod label_map;
mod metaimage;
mod nifti;
mod nrrd;
mod numbers;
mod open;
#[cfg(feature = "unpacking")]
mod pack;
mod plan;
mod segments;
mod stream;
mod text;
mod words;
mod write;

pub use error::{Error, ErrorKind, Need, Stop};
pub use fill::{Fill, Step, Window};
pub use grid::grid_fault;
pub use known::{Found, Known};
pub use nifti::{StatedUnits, stated_units};
pub use numbers::{Kind, Scaling};
pub use open::{HEAD, format_of, open};
#[cfg(feature = "unpacking")]
pub use pack::Packer;
pub use plan::{Affine, Format, Grid, Place, Plan, Stored};
pub use segments::{Segment, Segmentation};
pub use stream::Codec;
pub use text::printable;
pub use write::Written;
