//! The other scan of a comparison in a session file.

use serde::{Deserialize, Serialize};

use super::{Point, Scan};

/// A scan that the reader compares with the scan of the session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedComparison"))]
#[serde(deny_unknown_fields)]
pub struct ComparedScan {
    /// Its grid, by which it is recognised.
    pub scan: Scan,
    /// Whether it is the earlier one.
    pub is_earlier: bool,
    /// Places in the session's scan and in this one that belong together (mm, LPS).
    pub pairs_mm: Vec<[Point; 2]>,
}
