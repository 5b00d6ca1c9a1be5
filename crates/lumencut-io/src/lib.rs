//! Readers and writers of centerline files: one room per format.
//!
//! [`read`] turns the bytes of a file into the [`Centerlines`] that stand in it, in the file's own space;
//! [`junctions::vessels`] turns lines that repeat a trunk into vessels that meet at shared end points.
//!
//! Every reader is bounded by its input: no count or offset that a file states is believed before the bytes
//! that it speaks of are there, and what is unpacked stays within a budget that grows with the size of the
//! file.

mod centerlines;
mod compression;
mod data_array;
mod encoding;
mod error;
pub mod junctions;
mod mrk_json;
mod poly_data;
mod vtk_cursor;
mod vtk_legacy;
mod vtp;
mod vtp_xml;
mod write;
mod xz;

#[cfg(test)]
mod tests;

pub use centerlines::{Centerlines, Line, Space};
pub use error::{Error, Result};
pub use write::{write_mrk_json, write_vtp};

/// The centerlines of a `.vtp`, legacy `.vtk` or `.mrk.json` file, in mm, in the file's own space.
///
/// The format is told by how the content begins; `file_name` is for the error messages.
///
/// # Errors An [`Error`] that names the file and place: an unknown format, content that is not what the
/// format promises, or a file without lines.
pub fn read(bytes: &[u8], file_name: &str) -> Result<Centerlines> {
    read_unnamed(bytes, file_name).map_err(|error| error.in_file(file_name))
}

fn read_unnamed(bytes: &[u8], file_name: &str) -> Result<Centerlines> {
    if bytes.is_empty() {
        return Err(Error::truncated("", "an empty file", "a centerline file"));
    }
    let name = file_name.to_ascii_lowercase();
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let begins = text.trim_ascii_start();
    if begins.starts_with(b"# vtk") {
        vtk_legacy::read(text)
    } else if begins.starts_with(b"<") {
        vtp::read(text)
    } else if begins.starts_with(b"{") {
        mrk_json::read(text)
    } else {
        Err(unknown(&name))
    }
}

fn unknown(name: &str) -> Error {
    let (found, expected) = if name.ends_with(".vtp") {
        ("content that is no XML", "a VTK XML file that begins with '<VTKFile'")
    } else if name.ends_with(".vtk") {
        ("another first line", "a legacy VTK file that begins with '# vtk DataFile Version'")
    } else if name.ends_with(".json") {
        ("content that is no JSON object", "a 3D Slicer markups file that begins with '{'")
    } else {
        ("an unknown format", "a .vtp, legacy .vtk or .mrk.json file")
    };
    Error::new("", found, expected)
}
