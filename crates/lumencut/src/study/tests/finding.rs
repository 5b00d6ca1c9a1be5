//! Tests of edits that find the vessels of a scan.

use serde_json::json;

use super::edits::{called, edited, three, tried};
use super::opened;
use super::tracing::holding;
use crate::study::document::Document;

#[test]
fn all_vessels_are_found_in_one_step_beside_those_that_there_are() {
    let mut study = opened("y_junction");
    let before = three(&mut study, ["a", "b", "c"]);
    let found = edited(&mut study, &before, &json!({"kind": "find_vessels", "doubtful": false}));
    assert_eq!(found.words, "find all vessels");
    assert_eq!(called(&found.document)[..4], ["a", "b", "c", "Vessel 1"]);
    assert!(found.added.len() >= 2 && found.document.vessels.len() == 3 + found.added.len());
    assert!(found.notes[0].starts_with("the lumen of the vessels has about 3"));
}

#[test]
fn where_no_vessel_is_sure_the_doubtful_ones_are_given_to_who_wants_them() {
    let mut scan = lumencut_phantom::y_junction().expect("a phantom");
    // A short piece of unenhanced blood, surrounded by fat.
    let (slice, slices) = (scan.size[0] * scan.size[1], scan.size[2]);
    for (n, voxel) in scan.voxels.iter_mut().enumerate() {
        let is_blood = *voxel > 200 && (slices / 2..slices / 2 + 12).contains(&(n / slice));
        *voxel = if is_blood { 45 } else { -90 } + *voxel % 7;
    }
    let mut study = holding(scan);
    let find = |doubtful: bool| json!({"kind": "find_vessels", "doubtful": doubtful});
    let refused =
        tried(&mut study, &Document::default(), &find(false), false).expect_err("no certain vessel");
    assert!(refused.found.starts_with("no certain vessel, but "), "{refused:?}");
    assert_eq!(refused.mend, "trace between two points along a vessel");
    let mends: Vec<&str> = refused.more.mends.iter().map(crate::mends::Mend::name).collect();
    assert_eq!(mends, ["doubtful"]);
    let found = edited(&mut study, &Document::default(), &find(true));
    assert!(!found.added.is_empty() && found.document.vessels.iter().all(|vessel| vessel.doubt.is_some()));
    let mut nothing = lumencut_phantom::y_junction().expect("a phantom");
    nothing.voxels.fill(0);
    let mut study = holding(nothing);
    let refused = tried(&mut study, &Document::default(), &find(true), false).expect_err("nothing");
    assert!(refused.found.starts_with("none whose radius"), "{refused:?}");
}
