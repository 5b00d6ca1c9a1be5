//! Recognises kinds of files by content and name.

use lumencut::file_kinds::{
    FILE_KINDS, HEAD, KnownFile, Role, centerline_files, folder, kind_of, volume_files, written_centerlines,
    written_volumes,
};
use pyo3::prelude::*;

/// Identifier, role, words and remedy of the kind of a file.
type Known = (&'static str, &'static str, String, &'static str);

fn known(KnownFile { kind, role, words, mend }: KnownFile) -> Known {
    (kind, word(role), words, mend)
}

fn word(role: Role) -> &'static str {
    match role {
        Role::Volume => "volume",
        Role::Centerlines => "centerlines",
        Role::Other => "other",
    }
}

/// The kind of a file by its first bytes and its name; without bytes, the kind of a folder.
#[pyfunction]
#[pyo3(signature = (head, name=""))]
pub(crate) fn file_kind(head: Option<&[u8]>, name: &str) -> Known {
    known(head.map_or_else(folder, |head| kind_of(head, name)))
}

/// Adds to the module: the table (identifier, role, format, extensions to read, extensions to write), the number of
/// bytes that decide, and the words for the files that can be read and written.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let rows = FILE_KINDS.iter().map(|kind| {
        (kind.name, word(kind.role), kind.title, kind.extensions.to_vec(), kind.written.to_vec())
    });
    module.add("FILE_KINDS", rows.collect::<Vec<_>>())?;
    module.add("FILE_HEAD", HEAD)?;
    module.add("VOLUME_FILES", volume_files())?;
    module.add("CENTERLINE_FILES", centerline_files())?;
    module.add("WRITTEN_CENTERLINES", written_centerlines())?;
    module.add("WRITTEN_VOLUMES", written_volumes())
}
