//! Readers and writers of centerline files: one room per format.
//!
//! [`read`] turns the bytes of a file into the [`Centerlines`] that stand in it, in the file's own space and
//! unit; [`Centerlines::scaled`] brings them to mm; [`junctions::vessels`] turns lines that repeat a trunk, or
//! that are single segments, into vessels that meet at shared end points.
//!
//! | format | told by | unit and space | radius |
//! |---|---|---|---|
//! | VTK XML poly data, `.vtp` | `<VTKFile` | none; `SPACE` | a point array |
//! | legacy VTK, `.vtk` | `# vtk` | none; `SPACE=` in the title | a point array |
//! | 3D Slicer markups, `.mrk.json` | `{` | stated, else mm; stated | the measurement `Radius` |
//! | SimVascular path, `.pth` | `<path` or `<format` | none, usually cm; none | none |
//! | SWC, `.swc` | seven columns, or its name | none; none | the sixth column |
//! | ITK tube, `.tre` | `ObjectType =` | mm; LPS | `r` of `PointDim` |
//! | 3D Slicer fiducials, `.fcsv` | `# Markups fiducial`, or its name | mm; stated | none |
//! | Rotterdam reference, `.txt` | five columns of numbers, or its name | none; none | the fourth column |
//! | text table, `.csv`, `.tsv`, `.txt` | numbers or a header | the header's | the header's, or a fourth column |
//! | NumPy array, `.npy` | `\x93NUMPY` | none; none | a fourth column |
//!
//! Every reader is bounded by its input: no count or offset that a file states is believed before the bytes
//! that it speaks of are there, and what is unpacked stays within a budget that grows with the size of the
//! file.

mod centerlines;
mod compression;
mod data_array;
mod encoding;
mod error;
mod fcsv;
mod itk_tube;
mod json;
mod jumps;
pub mod junctions;
mod kind;
mod mend;
mod meta_object;
mod mrk_json;
mod npy;
mod placed_points;
mod poly_data;
mod rotterdam;
pub mod session_file;
mod simvascular;
mod space;
mod swc;
mod table;
mod table_columns;
mod text;
mod unit;
mod vtk_cursor;
mod vtk_legacy;
mod vtp;
mod vtp_xml;
mod write;
mod xml;
mod xz;

#[cfg(test)]
mod tests;

pub use centerlines::{Centerlines, Line};
pub use error::{Error, Result};
pub use mend::Mend;
pub use space::Space;
pub use unit::Unit;
pub use write::{marked_cell, write_csv, write_mrk_json, write_swc, write_vtk, write_vtp};

use kind::Kind;

/// The centerlines of a file, in its own unit and space.
///
/// The lines are for [`Centerlines::scaled`], which holds them to the limit of 1e6 mm that cannot be checked
/// where the unit is not known; its factor may be 1.
///
/// The format is told by the content; the ending of `file_name` decides only where the content does not tell.
///
/// # Errors
/// An [`Error`] that names the file and place: an unknown format, content that is not what the format
/// promises, or a file without lines.
pub fn read(bytes: &[u8], file_name: &str) -> Result<Centerlines> {
    read_unnamed(bytes, file_name).map_err(|error| error.in_file(file_name))
}

fn read_unnamed(bytes: &[u8], file_name: &str) -> Result<Centerlines> {
    if bytes.is_empty() {
        return Err(Error::truncated("", "an empty file", "a centerline file"));
    }
    let content = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match kind::of(content, file_name)? {
        Kind::VtkXml => vtp::read(content),
        Kind::VtkLegacy => vtk_legacy::read(content),
        Kind::Markups => mrk_json::read(content),
        Kind::SimVascular => simvascular::read(content),
        Kind::Swc => swc::read(content),
        Kind::ItkTube => itk_tube::read(content),
        Kind::Fiducials => fcsv::read(content),
        Kind::Rotterdam => rotterdam::read(content),
        Kind::Table => table::read(content),
        Kind::Npy => npy::read(content),
    }
}
