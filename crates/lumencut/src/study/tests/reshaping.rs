use lumencut_core::progress::Progress;

use super::*;
use crate::study::edits::{Edit, EditMessage, Edited};
use crate::study::lines::ListedLine;
use crate::study::tests::opened;
use crate::study::tracing::Watch;

fn straight(length: usize) -> Line {
    let points: Vec<DVec3> = (0..=length).map(|n| DVec3::new(1.0, 2.0, n as f64)).collect();
    Line { radius: Some(vec![2.0; points.len()]), points, ..Line::default() }
}

fn bend(at: f64, to: [f64; 3]) -> Reshaping {
    Reshaping::Bend { at, to }
}

fn edited(study: &mut Study, edit: Edit) -> Result<Edited> {
    let document = study.begin_document();
    let watch = Watch { stop: &|| false, progress: &Progress::default() };
    study.edit(&EditMessage { document, edit, bridging: false }, watch)
}

#[test]
fn a_pull_moves_its_point_there_and_its_neighbours_by_a_cosine() {
    let line = straight(60);
    let bent = reshaped(&line, &bend(30.0, [5.0, 2.0, 30.0])).expect("a line");
    // The reach is three times the pull of 4 mm.
    for (n, point) in bent.points.iter().enumerate() {
        let share = ((n as f64 - 30.0).abs() / 12.0).min(1.0);
        let expected = DVec3::new(1.0 + 4.0 * (FRAC_PI_2 * share).cos().powi(2), 2.0, n as f64);
        assert!(point.distance(expected) < 1e-12, "{n}: {point}");
    }
    assert_eq!(bent.radius, line.radius);
    assert_eq!(bent.stretches_by_hand().len(), 1);
    let moved: Vec<usize> = (0..=60).filter(|n| bent.by_hand.as_ref().expect("moved")[*n]).collect();
    assert_eq!((moved[0], moved[moved.len() - 1]), (19, 41));
}

#[test]
fn a_place_between_points_goes_where_it_is_pulled() {
    let line = straight(60);
    let bent = reshaped(&line, &bend(30.5, [5.0, 2.0, 30.5])).expect("a line");
    let middle = place_at(&bent.points, &(0..=60).map(f64::from).collect::<Vec<_>>(), 30.5);
    assert!(middle.distance(DVec3::new(5.0, 2.0, 30.5)) < 0.1, "{middle}");
}

#[test]
fn ends_stay_unless_they_are_pulled() {
    let line = straight(20);
    for at in [1.0, 3.0, 10.0, 17.0] {
        let bent = reshaped(&line, &bend(at, [9.0, 2.0, at])).expect("a line");
        assert_eq!([bent.points[0], bent.points[20]], [line.points[0], line.points[20]], "at {at} mm");
    }
    let bent = reshaped(&line, &bend(20.0, [1.0, 4.0, 21.0])).expect("a line");
    assert_eq!([bent.points[0], bent.points[20]], [line.points[0], DVec3::new(1.0, 4.0, 21.0)]);
}

#[test]
fn smoothing_flattens_a_zigzag_and_leaves_a_straight_line_as_it_is() {
    let line = straight(60);
    let same = reshaped(&line, &Reshaping::Smooth { sigma: 5.0 }).expect("a line");
    assert_eq!(same.by_hand, None);
    let mut zigzag = line;
    for (n, point) in zigzag.points.iter_mut().enumerate() {
        point.x += if n % 2 == 0 { 1.0 } else { -1.0 };
    }
    let smooth = reshaped(&zigzag, &Reshaping::Smooth { sigma: 5.0 }).expect("a line");
    assert!(smooth.points[20..40].iter().all(|point| (point.x - 1.0).abs() < 0.05));
    assert_eq!(smooth.points[0], zigzag.points[0]);
    let none = reshaped(&zigzag, &Reshaping::Smooth { sigma: 0.0 }).expect("a line");
    assert_eq!((none.points, none.by_hand), (zigzag.points, None));
}

#[test]
fn impossible_changes_are_refused_with_what_was_found() {
    let line = straight(20);
    let no = [f64::NAN, 0.0, 0.0];
    for how in [bend(-1.0, [0.0; 3]), bend(21.0, [0.0; 3]), bend(f64::NAN, [0.0; 3]), bend(5.0, no)] {
        assert_eq!(reshaped(&line, &how).expect_err("no place").kind, "vessel tree");
    }
    for sigma in [-1.0, f64::NAN, 1e9] {
        let failure = reshaped(&line, &Reshaping::Smooth { sigma }).expect_err("no smoothing");
        assert_eq!(failure.subject, "smoothing of the line");
    }
    let mut study = opened("y_junction");
    let id = study.begin_document().vessels[0].id;
    let outside = Edit::Bend { id, at: 10.0, to: [1e4, 0.0, 0.0] };
    assert_eq!(edited(&mut study, outside).expect_err("outside").found, "a point outside the scan");
}

#[test]
fn branches_follow_the_line_that_they_leave_and_keep_their_other_end() {
    let mut study = opened("y_junction");
    let document = study.begin_document();
    let lines: Vec<_> =
        document.vessels.iter().map(|vessel| study.lines.get(vessel.line).expect("a line")).collect();
    let end = *lines[0].points.last().expect("a point");
    let meeting = |line: &Line| {
        [line.points[0], line.points[line.points.len() - 1]].iter().any(|point| point.distance(end) < MEETING)
    };
    let branches: Vec<usize> = (1..lines.len()).filter(|n| meeting(&lines[*n])).collect();
    assert!(!branches.is_empty());
    let to = end + DVec3::new(0.0, 1.5, 0.0);
    let at = arc_lengths(&lines[0].points).last().copied().expect("a length");
    let edit = Edit::Bend { id: document.vessels[0].id, at, to: to.to_array() };
    let after = edited(&mut study, edit).expect("an edit");
    assert_eq!(after.words, "move a line");
    for (n, vessel) in after.document.vessels.iter().enumerate() {
        let line = study.lines.get(vessel.line).expect("a line");
        let ends = [line.points[0], line.points[line.points.len() - 1]];
        let touches = ends.iter().any(|point| point.distance(to) < MEETING);
        assert_eq!(touches, n == 0 || branches.contains(&n), "vessel {n}");
        assert_eq!(line.by_hand.is_some(), touches, "vessel {n}");
    }
}

#[test]
fn sections_of_the_moved_stretch_say_so_in_every_number() {
    let mut study = opened("stenosis");
    let document = study.begin_document();
    let before = study.lines.get(document.vessels[0].line).expect("a line");
    let to = (before.points[40] + DVec3::new(0.5, 0.0, 0.0)).to_array();
    let at = arc_lengths(&before.points)[40];
    let after = edited(&mut study, Edit::Bend { id: document.vessels[0].id, at, to });
    let line = after.expect("an edit").document.vessels[0].line;
    study.show(&[ListedLine { line, ..ListedLine::default() }]).expect("shown");
    let [from, to] = study.lines.get(line).expect("a line").stretches_by_hand()[0];
    let profile = study.measured(line, &|| false).expect("a profile");
    for (n, place) in profile.arc_length.iter().enumerate() {
        let is_flagged = profile.flags[n] & lumencut_vessels::measure::section::flags::LINE_BY_HAND > 0;
        assert!(is_flagged || *place < from + 0.5 || *place > to - 0.5, "{place} mm");
        assert!(!is_flagged || (*place > from - 0.5 && *place < to + 0.5), "{place} mm");
    }
    assert!(study.profile_record(line, &|| false).expect("a record").contains("LINE_BY_HAND"));
}
