//! Detects the format of a file by its content, and by its name only if the content is ambiguous.

use crate::error::{Error, Result, excerpt};
use crate::table;
use crate::text;
use crate::{npy, rotterdam, swc, xml};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    VtkXml,
    VtkLegacy,
    Markups,
    SimVascular,
    Swc,
    ItkTube,
    Fiducials,
    Rotterdam,
    Table,
    Npy,
}

/// Number of bytes at the start of a file that are searched for binary content.
const BEGINNING: usize = 4096;

/// The format of `content`, which must not start with a byte order mark.
pub(crate) fn of(content: &[u8], file_name: &str) -> Result<Kind> {
    let name = file_name.to_ascii_lowercase();
    let begins = content.trim_ascii_start();
    packed(content, &name)?;
    if content.starts_with(npy::MAGIC) {
        Ok(Kind::Npy)
    } else if begins.starts_with(b"# vtk") {
        Ok(Kind::VtkLegacy)
    } else if begins.starts_with(b"<") {
        let path = matches!(xml::first_element(begins), Some(b"path" | b"format"));
        Ok(if path || name.ends_with(".pth") { Kind::SimVascular } else { Kind::VtkXml })
    } else if begins.starts_with(b"{") {
        Ok(Kind::Markups)
    } else if is_meta_io(begins) {
        Ok(Kind::ItkTube)
    } else if let Some(kind) = text_kind(content, &name)? {
        Ok(kind)
    } else {
        Err(unknown(&name))
    }
}

/// Rejects archives and UTF-16 text with an error that states what they are.
fn packed(content: &[u8], name: &str) -> Result<()> {
    let (found, mend) = match content {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => ("text in UTF-16", "save it as UTF-8"),
        [b'P', b'K', 3, 4, ..] if name.ends_with(".npz") => {
            ("an archive of NumPy arrays (.npz)", "save one array with numpy.save")
        }
        [b'P', b'K', 3, 4, ..] => ("a ZIP archive", "unpack it first"),
        [0x1f, 0x8b, ..] => ("a gzip file", "unpack it first"),
        _ => return Ok(()),
    };
    Err(Error::new("", found, "a centerline file").mend(mend))
}

fn is_meta_io(content: &[u8]) -> bool {
    let key = content.split(|b| *b == b'=').next().unwrap_or_default().trim_ascii();
    key.len() < content.len() && [&b"ObjectType"[..], b"Comment", b"NDims", b"FormTypeName"].contains(&key)
}

fn text_kind(content: &[u8], name: &str) -> Result<Option<Kind>> {
    let ends = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
    let named = if ends(&[".fcsv"]) || content.trim_ascii_start().starts_with(b"# Markups fiducial") {
        Some(Kind::Fiducials)
    } else if ends(&[".swc"]) {
        Some(Kind::Swc)
    } else {
        ends(&[".csv", ".txt", ".tsv", ".dat"]).then_some(Kind::Table)
    };
    if content[..content.len().min(BEGINNING)].contains(&0) {
        let binary = Error::new("", "binary content", "text");
        return if named.is_some() { Err(binary) } else { Ok(None) };
    }
    let first = text::data_lines(content).next();
    let first = first.as_ref().map(|(_, line)| line.trim()).unwrap_or_default();
    Ok(match named {
        Some(Kind::Table) | None if swc::is_node(first) => Some(Kind::Swc),
        Some(Kind::Table) | None if rotterdam::is_row(first, name) => Some(Kind::Rotterdam),
        None if table::is_first_row(first) => Some(Kind::Table),
        named => named,
    })
}

fn unknown(name: &str) -> Error {
    let known: [(&str, &str, &str); 6] = [
        (".vtp", "content that is not XML", "a VTK XML file that begins with '<VTKFile'"),
        (".vtk", "another first line", "a legacy VTK file that begins with '# vtk DataFile Version'"),
        (".json", "content that is not a JSON object", "a 3D Slicer markups file that begins with '{'"),
        (".pth", "content that is not XML", "a SimVascular path file that begins with '<'"),
        (".tre", "another first line", "an ITK tube file that begins with 'ObjectType = '"),
        (".npy", "another beginning", "a NumPy array that begins with '\\x93NUMPY'"),
    ];
    if let Some((_, found, expected)) = known.into_iter().find(|(ending, ..)| name.ends_with(ending)) {
        return Error::new("", found, expected);
    }
    let ending = name.rsplit_once('.').map(|(_, ending)| excerpt(ending));
    let found = ending.map_or_else(
        || "an unknown format".to_owned(),
        |ending| format!("an unknown format (the name ends in {ending})"),
    );
    let expected = "a .vtp, .vtk, .mrk.json, .fcsv, .pth, .swc, .tre or .npy file, or a table (.csv, .txt)";
    Error::new("", found, expected)
}
