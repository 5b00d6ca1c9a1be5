use std::f64::consts::PI;

use glam::DVec2;
use lumencut_vessels::measure::profile::CONTOUR_POINTS;

use super::*;
use crate::study::lines::ListedLine;
use crate::study::tests::opened;

const AT: f64 = 20.0;

fn listed(study: &Study, contours: Vec<Contour>) -> Vec<ListedLine> {
    let line = study.content.named.as_ref().expect("vessels").lines[0];
    vec![ListedLine { line, contours, ..ListedLine::default() }]
}

fn circle(at: f64, radius: f64) -> Contour {
    [vec![at, 0.0, 0.0], vec![radius; CONTOUR_POINTS]].concat()
}

#[test]
fn a_contour_by_hand_counts_in_every_number_until_it_is_removed() {
    let mut study = opened("stenosis");
    let automatic = listed(&study, Vec::new());
    let line = automatic[0].line;
    let before = study.measured(line, &|| false).expect("a profile").clone();
    let n = before.nearest_section(AT);
    study.show(&listed(&study, vec![circle(before.arc_length[n], 5.0)])).expect("a contour");
    let drawn = study.measured(line, &|| false).expect("a profile");
    assert!((drawn.area[n] / (25.0 * PI) - 1.0).abs() < 0.01, "{}", drawn.area[n]);
    assert_eq!(drawn.area[n + 1].to_bits(), before.area[n + 1].to_bits());
    let record = study.profile_record(line, &|| false).expect("a record");
    assert!(record.contains("BY_HAND"));
    let at = study.drawn_contour(line, AT, (None, None), &|| false).expect("a contour");
    assert!((at.diameter - 10.0).abs() < 0.05);
    study.show(&automatic).expect("the automatic contour");
    let back = study.measured(line, &|| false).expect("a profile");
    assert_eq!(back.area[n].to_bits(), before.area[n].to_bits());
}

#[test]
fn a_pull_changes_nothing_until_it_is_an_edit() {
    let mut study = opened("stenosis");
    let line = listed(&study, Vec::new())[0].line;
    let before = study.drawn_contour(line, AT, (None, None), &|| false).expect("a contour");
    let profile = study.measured(line, &|| false).expect("a profile").clone();
    let place = profile.place(profile.nearest_section(AT));
    let to = place.point(DVec2::new(9.0, 0.0)).to_array();
    let pulled = study.drawn_contour(line, AT, (None, Some(to)), &|| false).expect("a contour");
    assert!(pulled.area > before.area && pulled.longest > before.longest);
    let after = study.drawn_contour(line, AT, (None, None), &|| false).expect("a contour");
    assert_eq!(after.points, before.points);
    let kept = study.drawn_contour(line, AT, (Some(pulled.contour.clone()), None), &|| false);
    assert_eq!(kept.expect("a contour").points, pulled.points);
}

#[test]
fn impossible_contours_are_refused_with_what_was_found() {
    let mut study = opened("stenosis");
    let few = vec![AT, 0.0, 0.0, 1.0];
    let mut far = circle(AT, 1.0);
    far[1] = 1e9;
    let no_number = circle(AT, f64::NAN);
    for (odd, found) in
        [(few, "4 numbers"), (far, "1000000000 mm"), (no_number, "NaN mm"), (circle(1e4, 1.0), "10000 mm")]
    {
        let refused = study.show(&listed(&study, vec![odd])).expect_err("no contour");
        assert_eq!((refused.kind, refused.found.as_str()), ("measuring", found));
    }
}

#[test]
fn another_line_of_a_vessel_has_no_contours() {
    use crate::study::document::DocumentVessel;
    let mut vessel = DocumentVessel { line: 3, contours: vec![circle(AT, 2.0)], ..DocumentVessel::default() };
    vessel.take_line(3);
    assert_eq!(vessel.contours.len(), 1);
    vessel.take_line(4);
    assert!(vessel.contours.is_empty());
}
