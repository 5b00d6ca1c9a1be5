//! Finds out which control points of 3D Slicer have a defined position.

use crate::centerlines::Centerlines;
use crate::error::{Error, Result, excerpt};

const FEWEST: usize = 2;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PlacedBy {
    /// Column `defined`, with 0 or 1.
    Flag,
    /// Column `positionStatus`.
    Status,
}

impl PlacedBy {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Flag => "defined",
            Self::Status => "positionStatus",
        }
    }

    /// Whether the point has a position; an empty field means that it has.
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

/// Whether a `positionStatus` (name or number) means that the point has a position.
pub(crate) fn has_place(status: &str) -> Result<bool> {
    match status.to_ascii_lowercase().as_str() {
        "" | "defined" | "2" => Ok(true),
        "undefined" | "preview" | "missing" | "0" | "1" | "3" => Ok(false),
        _ => Err(Error::new("", excerpt(status), "'defined', 'undefined', 'preview' or 'missing'")),
    }
}

/// Notes how many points were skipped. Fails if too few remain.
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
