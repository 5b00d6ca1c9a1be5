//! The reasons why a found vessel is doubtful: a phrase, and a short form for lists.

use lumencut_vessels::kind::Kind;
use lumencut_vessels::trace::find::track::TrackDoubt;
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DoubtRow {
    /// The reason as a phrase, for documents and session files.
    pub words: &'static str,
    pub(crate) short: &'static str,
}

pub(crate) fn doubt_rows() -> Vec<DoubtRow> {
    let rows = |kind: Kind| {
        TrackDoubt::ALL.map(|doubt| DoubtRow { words: doubt.words(kind), short: doubt.short(kind) })
    };
    let mut all = Vec::new();
    for row in Kind::ALL.into_iter().flat_map(rows) {
        if !all.contains(&row) {
            all.push(row);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_other_scans_name_neither_bone_nor_contrast_medium() {
        for doubt in TrackDoubt::ALL {
            for words in [doubt.words(Kind::Vessels), doubt.short(Kind::Vessels)] {
                assert!(
                    !["bone", "marrow", "contrast medium", "agent"].iter().any(|ct| words.contains(ct)),
                    "{words}"
                );
            }
        }
    }

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
