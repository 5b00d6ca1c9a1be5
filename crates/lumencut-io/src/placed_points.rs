//! Which control points of 3D Slicer have a place: those that are being placed, or that lost it, have none.

use crate::centerlines::Centerlines;
use crate::error::{Error, Result, excerpt};

/// The fewest points of a line.
const FEWEST: usize = 2;

/// What a column of a table says of its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PlacedBy {
    /// Whether they are defined, 0 or 1.
    Flag,
    /// Their `positionStatus`.
    Status,
}

impl PlacedBy {
    /// The name of such a column.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Flag => "defined",
            Self::Status => "positionStatus",
        }
    }

    /// Whether the point of the `field` has a place; one of an empty field has.
    ///
    /// # Errors
    /// For a word that says neither.
    pub(crate) fn is_placed(self, field: &str) -> Result<bool> {
        match self {
            Self::Flag => is_defined(field),
            Self::Status => has_place(field),
        }
    }
}

fn is_defined(flag: &str) -> Result<bool> {
    match flag.to_ascii_lowercase().as_str() {
        "" | "true" | "yes" => Ok(true),
        "false" | "no" => Ok(false),
        number => match number.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number != 0.0),
            _ => Err(Error::new("", excerpt(flag), "1 or 0")),
        },
    }
}

/// Whether a `positionStatus` of 3D Slicer, its name or its number, is that of a point with a place.
///
/// # Errors
/// For another word or number.
pub(crate) fn has_place(status: &str) -> Result<bool> {
    match status.to_ascii_lowercase().as_str() {
        "" | "defined" | "2" => Ok(true),
        "undefined" | "preview" | "missing" | "0" | "1" | "3" => Ok(false),
        _ => Err(Error::new("", excerpt(status), "'defined', 'undefined', 'preview' or 'missing'")),
    }
}

/// Notes how many points without a place were left out of the lines; `points` and `kept` name both kinds.
///
/// # Errors
/// Where too few are left for a line.
pub(crate) fn note_left_out(out: &mut Centerlines, count: usize, points: &str, kept: &str) -> Result<()> {
    if count == 0 {
        return Ok(());
    }
    if out.lines.iter().all(|line| line.points.len() < FEWEST) {
        return Err(Error::new("points", format!("{count} {points}"), format!("at least {FEWEST} {kept}")));
    }
    out.notes.push(format!("{count} {points} were left out"));
    Ok(())
}
