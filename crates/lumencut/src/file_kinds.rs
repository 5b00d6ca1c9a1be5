//! The kinds of files that hosts open, with their file name extensions, and how the first bytes of a file state its
//! kind. The readers check their formats themselves; here a file may remain unknown.

use serde::Serialize;

/// What a file can be opened as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub enum Role {
    /// A scan or a mask.
    Volume,
    /// Lines, or a session of the viewer.
    Centerlines,
    /// Neither.
    Other,
}

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileKind {
    /// The identifier of the kind, such as `nifti`.
    pub name: &'static str,
    /// What a file of this kind can be opened as.
    pub role: Role,
    /// What a file of this kind is called in messages, such as `a NIfTI volume`. Empty: `a .swc file`, after its extension.
    pub words: &'static str,
    /// The name of the format in lists; empty if it is not read.
    pub title: &'static str,
    /// Its file name extensions, in lower case.
    pub extensions: &'static [&'static str],
    /// The extensions that decide the kind if the content does not.
    pub decisive: &'static [&'static str],
    /// The extensions that are written.
    pub written: &'static [&'static str],
    /// How to make a file of this kind readable; empty if it is read.
    pub mend: &'static str,
}

/// The kind of a file in the words of messages.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct KnownFile {
    /// The identifier of the kind.
    pub kind: &'static str,
    /// What it can be opened as.
    pub role: Role,
    /// What it is called, such as `a NIfTI volume`.
    pub words: String,
    /// How to make it readable; empty if it is read.
    pub mend: &'static str,
}

/// Number of bytes, after decompression of gzip, by which [`kind_of`] decides.
pub const HEAD: usize = 4096;

const CONVERT: &str = "convert it to NIfTI, NRRD or MetaImage";

const fn volume(name: &'static str, words: &'static str, title: &'static str) -> FileKind {
    let none: &[&str] = &[];
    FileKind {
        name,
        role: Role::Volume,
        words,
        title,
        extensions: none,
        decisive: none,
        written: none,
        mend: "",
    }
}

const fn lines(name: &'static str, words: &'static str, title: &'static str) -> FileKind {
    FileKind { role: Role::Centerlines, ..volume(name, words, title) }
}

const NIFTI: FileKind = FileKind {
    extensions: &[".nii", ".nii.gz", ".hdr", ".img"],
    decisive: &[".nii", ".nii.gz", ".hdr", ".hdr.gz"],
    written: &[".nii", ".nii.gz"],
    ..volume("nifti", "a NIfTI volume", "NIfTI")
};
const NRRD: FileKind = FileKind {
    extensions: &[".nrrd", ".nhdr"],
    written: &[".nrrd"],
    ..volume("nrrd", "an NRRD volume", "NRRD")
};
const METAIMAGE: FileKind = FileKind {
    extensions: &[".mha", ".mhd"],
    decisive: &[".mha", ".mhd"],
    ..volume("metaimage", "a MetaImage volume", "MetaImage")
};
const DICOM: FileKind = volume("dicom", "a DICOM image", "");
const ZIP: FileKind = volume("zip", "a zip archive", "");
const FOLDER: FileKind = volume("folder", "a folder", "");
const VTK_IMAGE: FileKind =
    FileKind { mend: CONVERT, ..volume("vtk image", "a VTK image, which is not read", "") };
const JSON_IMAGE: FileKind = FileKind {
    mend: CONVERT,
    ..volume("vtk.js image", "an image in the JSON of vtk.js, which is not read", "")
};
const POLY_DATA: FileKind = FileKind {
    extensions: &[".vtp", ".vtk"],
    decisive: &[".vtp"],
    written: &[".vtp", ".vtk"],
    ..lines("vtk", "VTK PolyData", "VTK")
};
const JSON_LINES: FileKind = FileKind {
    mend: "write it as XML, as the vtkXMLPolyDataWriter of VTK does",
    ..lines("vtk.js lines", "PolyData in the JSON of vtk.js, which is not read", "")
};
const MARKUPS: FileKind = FileKind {
    extensions: &[".mrk.json"],
    decisive: &[".mrk.json"],
    written: &[".mrk.json"],
    ..lines("markups", "3D Slicer markups", "3D Slicer markups")
};
const EMPTY: FileKind =
    FileKind { role: Role::Other, mend: "copy or export it again", ..volume("empty", "an empty file", "") };
const UNKNOWN: FileKind = FileKind { role: Role::Other, ..volume("unknown", "a file of unknown format", "") };

/// A kind of centerlines that is recognised only by the file name.
const fn named(
    name: &'static str,
    title: &'static str,
    extensions: &'static [&'static str],
    written: &'static [&'static str],
) -> FileKind {
    FileKind { extensions, decisive: extensions, written, ..lines(name, "", title) }
}

/// All kinds, in the order of the documentation.
pub const FILE_KINDS: &[FileKind] = &[
    NIFTI,
    NRRD,
    METAIMAGE,
    DICOM,
    ZIP,
    FOLDER,
    VTK_IMAGE,
    JSON_IMAGE,
    POLY_DATA,
    MARKUPS,
    JSON_LINES,
    named("fiducials", "3D Slicer fiducials", &[".fcsv"], &[]),
    named("simvascular", "SimVascular paths", &[".pth"], &[]),
    named("swc", "SWC", &[".swc"], &[".swc"]),
    named("itk tubes", "ITK tubes", &[".tre"], &[]),
    named("table", "tables", &[".csv"], &[".csv"]),
    // `.txt` files often have other content, so they are read only if the caller expects centerlines.
    FileKind { extensions: &[".txt"], ..lines("text table", "", "tables") },
    FileKind { extensions: &[".npy"], ..lines("numpy", "", "NumPy") },
    EMPTY,
    UNKNOWN,
];

/// The kind of a file by its first bytes (up to [`HEAD`]; of a gzip file, those of its content), and by its name if they do not
/// state it. [`Role::Other`] if neither does.
pub fn kind_of(head: &[u8], file_name: &str) -> KnownFile {
    let name = file_name.to_ascii_lowercase();
    if head.is_empty() {
        return known(&EMPTY, "");
    }
    if let Some(kind) = of_bytes(head, &name).or_else(|| of_text(head)) {
        return known(&kind, "");
    }
    let ends = |kind: &FileKind| kind.decisive.iter().copied().find(|ending| name.ends_with(ending));
    let named = FILE_KINDS.iter().find_map(|kind| Some((kind, ends(kind)?)));
    named.map_or_else(|| known(&UNKNOWN, ""), |(kind, ending)| known(kind, ending))
}

/// The kind of a folder, which is opened as a DICOM series.
pub fn folder() -> KnownFile {
    known(&FOLDER, "")
}

/// `ending` is the extension if only the name states the kind.
fn known(kind: &FileKind, ending: &str) -> KnownFile {
    let is_of_name = !ending.is_empty() && kind.role == Role::Centerlines;
    let words = if is_of_name { format!("a {ending} file") } else { kind.words.to_owned() };
    KnownFile { kind: kind.name, role: kind.role, words, mend: kind.mend }
}

fn of_bytes(head: &[u8], name: &str) -> Option<FileKind> {
    if (head.starts_with(b"PK\x03\x04") && !name.ends_with(".npz")) || head.starts_with(b"PK\x05\x06") {
        return Some(ZIP);
    }
    if head.starts_with(b"NRRD") {
        return Some(NRRD);
    }
    // Without a preamble, DICOM begins with the group 0008 or 0002.
    let is_bare = matches!(head, [8 | 2, 0, _, 0, ..]);
    if head.get(128..132) == Some(b"DICM") || is_bare {
        return Some(DICOM);
    }
    let is_image =
        |line: &[u8]| value_after(line, b"ObjectType", b'=').is_some_and(|v| v.starts_with(b"Image"));
    if METAIMAGE.decisive.iter().any(|ending| name.ends_with(ending)) || lines_of(head).any(is_image) {
        return Some(METAIMAGE);
    }
    let length =
        head.first_chunk::<4>().map(|bytes| [u32::from_le_bytes(*bytes), u32::from_be_bytes(*bytes)]);
    length.is_some_and(|both| both.iter().any(|length| matches!(length, 348 | 540))).then_some(NIFTI)
}

fn of_text(head: &[u8]) -> Option<FileKind> {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    if text.starts_with(b"{") {
        return of_json(text);
    }
    if text.starts_with(b"<") {
        return of_vtk(type_of_xml(text)?);
    }
    if !text.starts_with(b"# vtk DataFile") {
        return None;
    }
    let dataset = lines_of(text).find_map(|line| {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        words.next().filter(|word| word.eq_ignore_ascii_case(b"DATASET")).and_then(|_| words.next())
    });
    of_vtk(dataset?)
}

fn of_vtk(kind: &[u8]) -> Option<FileKind> {
    match kind.to_ascii_lowercase().as_slice() {
        b"imagedata" | b"structured_points" => Some(VTK_IMAGE),
        b"polydata" => Some(POLY_DATA),
        _ => None,
    }
}

fn of_json(text: &[u8]) -> Option<FileKind> {
    match after(text, b"\"vtkClass\"").and_then(|rest| quoted(separated(rest, b':')?)) {
        Some(b"vtkImageData") => Some(JSON_IMAGE),
        Some(b"vtkPolyData") => Some(JSON_LINES),
        _ => after(text, b"\"markups\"").map(|_| MARKUPS),
    }
}

/// The attribute `type` of the element `VTKFile`.
fn type_of_xml(text: &[u8]) -> Option<&[u8]> {
    let mut rest = after(text, b"<VTKFile")?.split(|byte| *byte == b'>').next()?;
    while let Some(next) = after(rest, b"type") {
        let before = rest[..rest.len() - next.len() - b"type".len()].last();
        let value = separated(next, b'=').and_then(quoted);
        if before.is_some_and(u8::is_ascii_whitespace) && value.is_some() {
            return value;
        }
        rest = next;
    }
    None
}

fn lines_of(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(|byte| matches!(byte, b'\n' | b'\r'))
}

fn after<'a>(text: &'a [u8], words: &[u8]) -> Option<&'a [u8]> {
    text.windows(words.len()).position(|window| window == words).map(|at| &text[at + words.len()..])
}

/// The text after a separator at the beginning, without spaces around the separator.
fn separated(text: &[u8], separator: u8) -> Option<&[u8]> {
    text.trim_ascii_start().strip_prefix(&[separator]).map(<[u8]>::trim_ascii_start)
}

fn value_after<'a>(line: &'a [u8], key: &[u8], separator: u8) -> Option<&'a [u8]> {
    separated(line.strip_prefix(key)?, separator)
}

/// The word in quotes at the beginning.
fn quoted(text: &[u8]) -> Option<&[u8]> {
    let rest = text.strip_prefix(b"\"").or_else(|| text.strip_prefix(b"'"))?;
    let length = rest.iter().position(|byte| !(byte.is_ascii_alphanumeric() || *byte == b'_'));
    length.map(|length| &rest[..length]).filter(|word| !word.is_empty())
}

/// The volume files that can be read, in the words of messages.
pub fn volume_files() -> String {
    let formats: Vec<String> = read(Role::Volume)
        .map(|kind| {
            format!("{} ({})", kind.title, kind.extensions.join(", ").replace(".hdr, .img", ".hdr + .img"))
        })
        .collect();
    format!("a DICOM folder, file or zip archive, {}", listed(&formats))
}

/// The extensions of centerline files that are written, in the words of messages: SWC, which keeps least, is last.
pub fn written_centerlines() -> String {
    let (swc, others): (Vec<&FileKind>, Vec<&FileKind>) =
        read(Role::Centerlines).partition(|kind| kind.name == "swc");
    either(others.iter().chain(&swc).flat_map(|kind| kind.written))
}

/// The extensions of volume files that are written, in the words of messages.
pub fn written_volumes() -> String {
    either([NRRD, NIFTI].iter().flat_map(|kind| kind.written))
}

/// The formats in which the page saves centerlines, without a dot: those that keep all properties of vessels.
pub fn saved_by_the_page() -> [&'static str; 2] {
    [POLY_DATA, MARKUPS].map(|kind| kind.written[0].trim_start_matches('.'))
}

/// The centerline files that are recognised by their file name extensions, in the words of messages.
pub fn centerline_files() -> String {
    let recognised = read(Role::Centerlines).filter(|kind| !kind.decisive.is_empty());
    let extensions: Vec<&str> = recognised.flat_map(|kind| kind.extensions).copied().collect();
    format!("centerlines ({})", extensions.join(", "))
}

/// The extensions of files that are read as volumes or centerlines.
pub fn extensions(role: Role) -> Vec<&'static str> {
    read(role).flat_map(|kind| kind.extensions).copied().collect()
}

fn read(role: Role) -> impl Iterator<Item = &'static FileKind> {
    FILE_KINDS.iter().filter(move |kind| kind.role == role && !kind.title.is_empty())
}

fn either(extensions: impl Iterator<Item = &'static &'static str>) -> String {
    listed(&extensions.map(|extension| (*extension).to_owned()).collect::<Vec<_>>())
}

fn listed(words: &[String]) -> String {
    match words {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => words.concat(),
    }
}

#[cfg(test)]
#[path = "tests/file_kinds.rs"]
mod tests;
