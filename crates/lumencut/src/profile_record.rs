//! The record of a profile: text from which Rust, Python or the page restores the profile exactly.

use std::collections::BTreeMap;

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_vessels::measure::profile::{CONTOUR_POINTS, Profile, Source};
use lumencut_vessels::measure::section::MOST_SECTIONS;
use lumencut_vessels::measure::wall::WallSource;
use lumencut_vessels::measure::wall::tree::PooledWall;
use serde::{Deserialize, Serialize};

use crate::flag_table::FLAGS;
use crate::profile_columns::{columns, empty, lengths, whole};
use crate::recorded_number::{Numbers, recorded, restored};
use crate::scan_details::ScanDetails;

const SUBJECT: &str = "record of a profile";

const FORMAT: u32 = 1;

/// A measured profile as JSON. Numbers keep all bits; null means NaN, since JSON has no NaN.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileRecord {
    format: u32,
    /// The bit of each flag name, for other programs. Our reader uses only the bits in `flags`.
    flag_names: BTreeMap<String, u32>,
    flags: Vec<u32>,
    /// The columns, in mm, LPS or the volume's unit. A contour is its number of points, then their coordinates.
    columns: BTreeMap<String, Numbers>,
    /// The source of the point spread: kind and words.
    fwhm_source: (String, String),
    /// The source of the wall level: kind and numbers.
    wall_source: (String, Numbers),
    scan: ScanDetails,
}

impl ProfileRecord {
    /// The record of a profile.
    pub fn of(profile: &Profile, scan: &ScanDetails) -> Self {
        let mut profile = profile.clone();
        let columns =
            columns(&mut profile).map(|(name, column)| (name.to_owned(), recorded(column.stored())));
        let (kind, numbers) = stored_wall(&profile.wall_source);
        Self {
            format: FORMAT,
            flag_names: FLAGS.iter().map(|flag| (flag.name.to_owned(), flag.bit)).collect(),
            columns: columns.into(),
            fwhm_source: stored_source(&profile.fwhm_source),
            wall_source: (kind, recorded(numbers)),
            flags: profile.flags,
            scan: scan.clone(),
        }
    }

    /// The record as text.
    pub fn text(&self) -> String {
        let text = serde_json::to_string(self);
        // Numbers and texts can always be written.
        debug_assert!(text.is_ok(), "{text:?}");
        text.unwrap_or_default()
    }

    /// Reads the text of a record. Fails with [`ErrorKind::Measuring`] for another text, or a record of another
    /// version.
    pub fn read(text: &str) -> Result<Self> {
        #[derive(Deserialize)]
        struct Version {
            format: u32,
        }
        let no_record = |error: serde_json::Error| damaged(format!("{:.120}", error.to_string()));
        let Version { format } = serde_json::from_str(text).map_err(no_record)?;
        if format != FORMAT {
            let expected = format!("version {FORMAT}");
            let error = Error::new(ErrorKind::Measuring, SUBJECT, format!("version {format}"), expected);
            return Err(error.mend("measure the vessel again"));
        }
        serde_json::from_str(text).map_err(no_record)
    }

    /// Restores the profile, which is bit-identical, and how the scan was made. Fails with [`ErrorKind::Measuring`]
    /// for columns that do not make up a profile, and for unknown flags.
    pub fn profile(self) -> Result<(Profile, ScanDetails)> {
        let mut stored = self.columns;
        let mut profile = empty();
        for (name, column) in columns(&mut profile) {
            let numbers = restored(&stored.remove(name).ok_or_else(|| damaged(format!("no column {name}")))?);
            column.filled(&numbers).ok_or_else(|| damaged(format!("{} numbers as {name}", numbers.len())))?;
        }
        if let Some((name, _)) = stored.first_key_value() {
            return Err(damaged(format!("a column {name:.40}")));
        }
        profile.flags = self.flags;
        profile.fwhm_source = restored_source(&self.fwhm_source)?;
        profile.wall_source = restored_wall((&self.wall_source.0, &restored(&self.wall_source.1)))?;
        check(&profile)?;
        Ok((profile, self.scan))
    }
}

/// Rejects values that no measurement yields.
fn check(profile: &Profile) -> Result<()> {
    let sections = profile.arc_length.len();
    if sections == 0 || lengths(profile).iter().any(|length| *length != sections) {
        return Err(damaged(format!("columns of {sections} and other numbers of sections")));
    }
    if sections > MOST_SECTIONS as usize {
        return Err(damaged(format!("{sections} sections, more than {MOST_SECTIONS}")));
    }
    let ascend = profile.arc_length.windows(2).all(|two| two[0] < two[1]);
    if !(ascend && profile.arc_length.iter().all(|at| at.is_finite())) {
        return Err(damaged("arc lengths that do not ascend".to_owned()));
    }
    if !(profile.fwhm.is_finite() && profile.fwhm > 0.0) {
        return Err(damaged(format!("a point spread of {} mm", profile.fwhm)));
    }
    let is_contour = |points: &Vec<DVec3>| [0, CONTOUR_POINTS].contains(&points.len());
    let lumens = profile.contour.iter().chain(&profile.own_lumen).chain(&profile.other_lumen);
    if let Some(odd) = lumens.chain(&profile.outer_contour).find(|points| !is_contour(points)) {
        return Err(damaged(format!("a contour of {} points", odd.len())));
    }
    let known = FLAGS.iter().fold(0, |bits, flag| bits | flag.bit);
    if let Some(odd) = profile.flags.iter().map(|flags| flags & !known).find(|unknown| *unknown > 0) {
        let found = format!("unknown flags (bits {odd:#x})");
        let expected = format!("flags of this version (bits {known:#x})");
        return Err(
            Error::new(ErrorKind::Measuring, SUBJECT, found, expected).mend("measure the vessel again")
        );
    }
    Ok(())
}

fn stored_source(source: &Source) -> (String, String) {
    let (name, words) = match source {
        Source::Given => ("given", ""),
        Source::Estimated { on } => ("estimated", on.as_str()),
        Source::Assumed { from } => ("assumed", from.as_str()),
    };
    (name.to_owned(), words.to_owned())
}

fn restored_source((name, words): &(String, String)) -> Result<Source> {
    match name.as_str() {
        "given" => Ok(Source::Given),
        "estimated" => Ok(Source::Estimated { on: words.clone() }),
        "assumed" => Ok(Source::Assumed { from: words.clone() }),
        _ => Err(damaged(format!("a point spread from '{name}'"))),
    }
}

fn stored_wall(source: &WallSource) -> (String, Vec<f64>) {
    let (name, numbers) = match source {
        WallSource::Hounsfield => ("hounsfield", vec![]),
        WallSource::Given(level) => ("given", level.to_vec()),
        WallSource::Pooled { given, by_others } => {
            let by_others = [by_others.level[0], by_others.level[1], by_others.vessels as f64];
            ("pooled", given.iter().flatten().copied().chain(by_others).collect())
        }
        WallSource::Bright => ("bright", vec![]),
        WallSource::PerhapsBright => ("perhaps bright", vec![]),
        WallSource::NotAsked => ("not asked", vec![]),
        WallSource::DarkLumen => ("dark lumen", vec![]),
        WallSource::OtherUnit => ("other unit", vec![]),
        WallSource::AsBright => ("as bright", vec![]),
    };
    (name.to_owned(), numbers)
}

fn restored_wall((name, numbers): (&str, &[f64])) -> Result<WallSource> {
    let pooled = |given, level, vessels: f64| {
        let by_others = PooledWall { level, vessels: whole(vessels)? };
        Some(WallSource::Pooled { given, by_others })
    };
    let found = match (name, numbers) {
        ("hounsfield", []) => Some(WallSource::Hounsfield),
        ("given", [level, deviation]) => Some(WallSource::Given([*level, *deviation])),
        ("pooled", [a, b, vessels]) => pooled(None, [*a, *b], *vessels),
        ("pooled", [given, deviation, a, b, vessels]) => {
            pooled(Some([*given, *deviation]), [*a, *b], *vessels)
        }
        ("bright", []) => Some(WallSource::Bright),
        ("perhaps bright", []) => Some(WallSource::PerhapsBright),
        ("not asked", []) => Some(WallSource::NotAsked),
        ("dark lumen", []) => Some(WallSource::DarkLumen),
        ("other unit", []) => Some(WallSource::OtherUnit),
        ("as bright", []) => Some(WallSource::AsBright),
        _ => None,
    };
    found.ok_or_else(|| damaged(format!("a wall from '{name}' with {} numbers", numbers.len())))
}

fn damaged(found: String) -> Error {
    Error::new(ErrorKind::Measuring, SUBJECT, found, "the columns of one profile")
}

#[cfg(test)]
#[path = "tests/profile_record.rs"]
mod tests;
