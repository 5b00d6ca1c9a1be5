//! Files that a header names. They must be in its folder or below, since a sender must not choose what is read.

use crate::error::{Error, Opening};
use crate::known::{Found, Known};
use crate::text::{is_all_printable, shown};

/// The name of a file in the header's folder or a folder below it; Windows separators are accepted.
pub(crate) fn inside(header: &str, name: &str, field: &str) -> Result<String, Box<Error>> {
    let parts: Vec<&str> = name.split(['/', '\\']).filter(|part| !part.is_empty() && *part != ".").collect();
    let is_absolute = name.starts_with(['/', '\\', '~']) || has_drive(name);
    if parts.is_empty() && !is_absolute || !is_all_printable(name) {
        let expected = "the name of a file next to the header";
        return Err(Error::new(header, format!("no file name in {field}"), expected));
    }
    if is_absolute || parts.contains(&"..") {
        return Err(outside(header, name, field));
    }
    Ok(parts.join("/"))
}

fn has_drive(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|letter| letter.is_ascii_alphabetic()) && letters.next() == Some(':')
}

fn outside(header: &str, name: &str, field: &str) -> Box<Error> {
    let found = format!("{field}: a path that leaves the folder ({})", shown(name));
    Error::new(header, found, "a file in the folder of the header or below")
        .mend("copy it there and name it without a path")
}

/// Rejects a link to a file outside the folder. A missing file is reported when it is read.
pub(crate) fn require_inside(known: &Known, header: &str, name: &str, field: &str) -> Opening<()> {
    match known.found(name)? {
        Found::Outside(_) => Err(outside(header, name, field).into()),
        Found::Missing | Found::Size(_) => Ok(()),
    }
}
