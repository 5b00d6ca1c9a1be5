//! The reasons why a found vessel is doubtful: a phrase, and a short form for lists.

use lumencut_vessels::trace::find::track::TrackDoubt;
use serde::Serialize;

#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DoubtRow {
    /// The reason as a phrase, for documents and session files.
    pub words: &'static str,
    pub(crate) short: &'static str,
}

pub(crate) fn doubt_rows() -> Vec<DoubtRow> {
    TrackDoubt::ALL.iter().map(|doubt| DoubtRow { words: doubt.words(), short: doubt.short() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_differ_and_are_shorter_in_a_word() {
        let rows = doubt_rows();
        for (n, row) in rows.iter().enumerate() {
            assert!(row.short.len() < row.words.len(), "{row:?}");
            assert!(row.short.len() < 20, "it stands in a row of a narrow list: {row:?}");
            assert!(rows[..n].iter().all(|other| other.short != row.short && other.words != row.words));
        }
    }
}
