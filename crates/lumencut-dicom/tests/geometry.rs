//! Tests of order, affine, tilt, gaps, duplicates, phases and uneven distances.

use std::time::Instant;

use crate::made::{as_they_are, even, judged, plan, refused, stack, with};
use lumencut_dicom::Mend;
use serde_json::{Value, json};

/// Positions of slices if the gantry is tilted by `degrees` and the table moves along z.
fn tilted(degrees: f64) -> impl Fn(usize, &mut Value) {
    let angle = degrees.to_radians();
    move |_, attributes| {
        attributes["ImageOrientationPatient"] = json!([1, 0, 0, 0, angle.cos(), angle.sin()]);
    }
}

#[test]
fn slices_are_sorted_along_their_normal() {
    let plan = plan(&stack(&[4.0, 0.0, 8.0, 6.0, 2.0], as_they_are));
    assert_eq!(plan.slices.iter().map(|one| one.file).collect::<Vec<_>>(), [1, 4, 0, 3, 2]);
    assert_eq!(plan.slices.iter().map(|one| one.place).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert_eq!(plan.size, [4, 3, 5]);
    let affine = [[0.5, 0.0, 0.0, 0.0], [0.0, 0.75, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    assert_eq!(plan.world_from_index, affine);
    assert_eq!((plan.slices[0].slope, plan.slices[0].intercept), (1.0, -1024.0));
    assert_eq!((plan.stored_type.as_str(), plan.notes.len(), plan.fills.len()), ("u2", 0, 0));
}

#[test]
fn a_tilted_gantry_shears_the_stack() {
    for degrees in [16.5, -18.0_f64] {
        let plan = plan(&stack(&even(6), tilted(degrees)));
        let column = plan.world_from_index.map(|row| row[2]);
        assert_eq!(column, [0.0, 0.0, 2.0, 0.0]);
        assert!((plan.world_from_index[2][1] - 0.75 * degrees.to_radians().sin()).abs() < 1e-15);
        let told = format!("the stack is sheared by {:.2} degrees", degrees.abs());
        assert!(plan.notes[0].starts_with(&told), "{:?}", plan.notes);
    }
    let stated = plan(&stack(&even(6), with("GantryDetectorTilt", "5.0")));
    assert_eq!(
        stated.notes,
        ["GantryDetectorTilt is 5 degrees, but the positions show no tilt: positions are used"]
    );
}

#[test]
fn missing_slices_are_named_and_filled() {
    let heights: Vec<f64> = even(12).into_iter().filter(|z| ![6.0, 14.0, 16.0].contains(z)).collect();
    let files = stack(&heights, as_they_are);
    let error = refused(&files);
    assert_eq!(
        error.found,
        "3 missing slices: 1 between IM2 and IM3 (4 mm apart at (0, 0, 4)), \
         2 between IM5 and IM6 (6 mm apart at (0, 0, 12))"
    );
    assert_eq!((error.expected.as_str(), error.file), ("slices every 2 mm", None));
    assert_eq!(error.advice, "add the missing files");
    assert_eq!(error.mended_by.as_deref(), Some(&Mend::FillGaps));
    let plan = judged(&files, json!({"fill_gaps": true})).expect("a volume");
    assert_eq!((plan.size[2], &plan.missing), (12, &vec![3, 7, 8]));
    let fills: Vec<_> = plan.fills.iter().map(|fill| (fill.k, fill.before, fill.after, fill.part)).collect();
    assert_eq!(fills, [(3, 2, 3, 0.5), (7, 5, 6, 1.0 / 3.0), (8, 5, 6, 2.0 / 3.0)]);
    assert_eq!(plan.notes, ["3 missing slices interpolated: k = 3, 7, 8"]);
}

#[test]
fn more_is_not_made_up_than_was_measured() {
    let files = stack(&[0.0, 2.0, 4.0, 20.0], as_they_are);
    let error = judged(&files, json!({"fill_gaps": true})).expect_err("too few slices");
    assert_eq!((error.advice.as_str(), error.mended_by), ("add the missing files", None));
    let far = stack(&[0.0, 2.0, 4.0, 1e300], as_they_are);
    let error = judged(&far, json!({"fill_gaps": true, "resample_slices": true})).expect_err("too far");
    assert!(error.found.contains("missing slices"), "{}", error.found);
}

#[test]
fn phases_are_named_and_chosen_among() {
    let heights = [even(3), even(3)].concat();
    let late = |k: usize| if k < 3 { "0" } else { "400" };
    let files = stack(&heights, |k, attributes| {
        attributes["SOPInstanceUID"] = format!("1.2.{k}").into();
        attributes["TriggerTime"] = late(k).into();
    });
    let error = refused(&files);
    assert!(
        error.found.ends_with("TriggerTime differs (0 in 3 slices, 400 in 3 slices): mixed phases"),
        "{}",
        error.found
    );
    let plan = judged(&files, json!({"phase": "400.0"})).expect("one phase");
    assert_eq!(plan.slices.iter().map(|one| one.file).collect::<Vec<_>>(), [3, 4, 5]);
    let error = judged(&files, json!({"phase": "it's 7"})).expect_err("no such phase");
    assert!(error.found.starts_with("no phase \"it's 7\": TriggerTime is 0 in 3 slices, 400 in 3 slices"));
}

#[test]
fn phases_between_each_other_are_refused() {
    let files = stack(&even(8), |k, attributes| attributes["TemporalPositionIdentifier"] = (k % 2).into());
    assert_eq!(
        refused(&files).found,
        "slices that alternate between phases: TemporalPositionIdentifier is 0 in 4 slices, 1 in 4 slices"
    );
    let files = stack(&even(8), |k, attributes| attributes["AcquisitionNumber"] = (k % 2).into());
    assert_eq!(plan(&files).size[2], 8);
}

#[test]
fn uneven_slices_are_named_or_resampled() {
    let files = stack(&[0.0, 2.0, 4.0, 6.0, 9.0, 12.0], as_they_are);
    let error = refused(&files);
    assert_eq!(error.found, "uneven slices at mixed distances (3 of 2 mm, 2 of 3 mm)");
    let plan = judged(&files, json!({"resample_slices": true})).expect("a grid");
    assert_eq!(plan.slices.iter().map(|one| one.place).collect::<Vec<_>>(), [0.0, 2.0, 4.0, 6.0, 9.0, 12.0]);
    assert_eq!((plan.is_resampled, plan.size[2], plan.world_from_index[2][2]), (true, 13, 1.0));
    let (seventh, tenth) = (&plan.fills[3], &plan.fills[5]);
    assert_eq!((seventh.k, seventh.before, seventh.after, seventh.part), (7, 3, 4, 1.0 / 3.0));
    assert_eq!((tenth.k, tenth.before, tenth.after, tenth.part), (10, 4, 5, 1.0 / 3.0));
    assert!(plan.notes[0].contains("resampled to 13 slices every 1 mm"), "{:?}", plan.notes);
}

#[test]
fn a_part_with_wider_steps_is_no_row_of_holes() {
    let heights = [even(10), vec![28.0, 38.0, 48.0]].concat();
    let error = judged(&stack(&heights, as_they_are), json!({"fill_gaps": true})).expect_err("two parts");
    assert_eq!(error.found, "uneven slices at mixed distances (9 of 2 mm, 3 of 10 mm)");
    let error = refused(&stack(&heights[..12], as_they_are));
    assert!(error.found.starts_with("8 missing slices"), "{}", error.found);
}

#[test]
fn holes_between_uneven_slices_are_filled_only_where_that_is_asked_for() {
    let heights = [0.0, 4.0, 8.0, 12.0, 28.0, 31.1, 34.2, 37.3, 40.4];
    let files = stack(&heights, as_they_are);
    let error = refused(&files);
    assert_eq!(error.advice, "add the missing slices of 16 mm between IM3 and IM4");
    assert_eq!(error.mended_by.as_deref(), Some(&Mend::ResampleAndFill));
    let error = judged(&files, json!({"resample_slices": true})).expect_err("a hole");
    assert!(error.found.ends_with("with a gap of 16 mm between IM3 and IM4"), "{}", error.found);
    assert_eq!(error.mended_by.as_deref(), Some(&Mend::FillGaps));
    let wanted = json!({"resample_slices": true, "fill_gaps": true});
    assert!(judged(&files, wanted.clone()).expect("a grid").is_resampled);
    let far = heights.map(|height| if height > 20.0 { height + 40.0 } else { height });
    let error = judged(&stack(&far, as_they_are), wanted).expect_err("mostly a hole");
    assert_eq!((error.advice.as_str(), error.mended_by), ("add the missing files", None));
    let error = refused(&stack(&far, as_they_are));
    assert_eq!(
        (error.advice.as_str(), error.mended_by),
        ("add the missing slices of 56 mm between IM3 and IM4", None)
    );
}

#[test]
fn fractions_of_places_weigh_their_neighbours() {
    let heights = [0.0, 4.0, 8.0, 12.0, 16.0, 19.1, 22.2, 25.3];
    let plan = judged(&stack(&heights, as_they_are), json!({"resample_slices": true})).expect("a grid");
    let step = plan.world_from_index[2][2];
    let height = |slice: usize| heights[slice];
    for fill in &plan.fills {
        let made = (1.0 - fill.part) * height(fill.before) + fill.part * height(fill.after);
        assert!((made - fill.k as f64 * step).abs() < 1e-12, "{fill:?}");
    }
    assert_eq!(plan.missing.len() as i64, plan.size[2] - 2);
}

#[test]
fn slices_beside_their_line_are_refused() {
    let shifted = |k: usize, attributes: &mut Value| {
        if k == 2 {
            attributes["ImagePositionPatient"] = json!(["0.3", "0", "4"]);
        }
    };
    let error =
        judged(&stack(&even(5), shifted), json!({"resample_slices": true})).expect_err("beside the line");
    assert_eq!(error.found, "uneven slices: IM2 is 0.3 mm off the line through the others");
}

#[test]
fn positions_too_large_to_be_compared_are_refused() {
    let huge = |k: usize, attributes: &mut Value| {
        let x = if k == 3 { "1.7e308" } else { "-1.7e308" };
        attributes["ImagePositionPatient"] = json!([x, "0", (2 * k).to_string()]);
    };
    for wanted in [json!({}), json!({"fill_gaps": true, "resample_slices": true})] {
        let error = judged(&stack(&even(4), huge), wanted).expect_err("beside the line");
        assert!(error.found.ends_with("mm off the line through the others"), "{}", error.found);
    }
}

#[test]
fn slices_that_differ_are_named() {
    for (keyword, value, words) in [
        ("Rows", json!(5), "slices of different size: (4, 3) in IM0 and 3 more, (4, 5) in IM3"),
        (
            "PixelSpacing",
            json!([0.8, 0.5]),
            "different spacing: (0.5, 0.75) in IM0 and 3 more, (0.5, 0.8) in IM3",
        ),
        ("ImageOrientationPatient", json!([1, 0, 0, 0, 0, 1]), "different orientation: (0, 1, 0) in IM0"),
    ] {
        let files = stack(&even(5), |k, attributes| {
            if k == 3 {
                attributes[keyword] = value.clone();
            }
        });
        let error = refused(&files);
        assert!(error.found.contains(words), "{}", error.found);
    }
}

#[test]
fn a_single_slice_is_as_thick_as_it_says() {
    let plan = plan(&stack(&[3.0], as_they_are));
    assert_eq!((plan.world_from_index[2][2], plan.size), (2.0, [4, 3, 1]));
    assert_eq!(plan.notes, ["a single slice: SliceThickness 2 mm is used as its thickness"]);
    let error = refused(&stack(&[3.0], with("SliceThickness", Value::Null)));
    assert_eq!((error.found.as_str(), error.file), ("a single slice without SliceThickness", Some(0)));
}

#[test]
fn long_series_take_no_time() {
    let files = stack(&even(5000), as_they_are);
    let headers = crate::made::headers(&files);
    let start = Instant::now();
    let plan = lumencut_dicom::judge(&headers, &lumencut_dicom::Wanted::default()).expect("a volume");
    assert_eq!(plan.size[2], 5000);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}
