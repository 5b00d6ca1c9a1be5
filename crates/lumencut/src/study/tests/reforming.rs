use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::study::tests::opened;

const PANE: [usize; 2] = [240, 180];
const WINDOW: [f64; 2] = [300.0, 900.0];

fn go() -> bool {
    false
}

fn message(text: serde_json::Value) -> ReformationMessage {
    serde_json::from_value(text).expect("a message")
}

fn front() -> serde_json::Value {
    serde_json::json!({"direction": [0.0, 1.0, 0.0], "up": [0.0, 0.0, 1.0]})
}

fn middle_of(study: &Study, vessel: usize) -> DVec3 {
    let points = study.vessel(vessel).expect("a vessel").points();
    points[points.len() / 2]
}

fn all_kinds(vessel: usize) -> Vec<ReformationMessage> {
    [
        serde_json::json!({"kind": "untangled", "side": front()}),
        serde_json::json!({"kind": "uncurl", "vessel": vessel, "side": front(), "amount": 0.5}),
        serde_json::json!({"kind": "spiral", "vessel": vessel, "angle": 0.3}),
        serde_json::json!({"kind": "map", "vessel": vessel, "of": "wall"}),
    ]
    .map(message)
    .to_vec()
}

#[test]
fn each_fits_into_its_pane_and_a_pick_leads_back_to_its_pixel() {
    let mut study = opened("y_junction");
    for asked in all_kinds(1) {
        let picture = study.reformed(asked, PANE, (WINDOW, &go)).expect("a picture");
        let [width, height] = picture.size;
        assert!(width <= PANE[0] && height <= PANE[1], "{asked:?}: {width} × {height}");
        assert!(width >= PANE[0] - 8 || height >= PANE[1] - 8, "{asked:?}: {width} × {height}");
        assert_eq!(picture.bytes.len(), 4 * width * height);
        assert!(picture.words.ends_with('.'), "{}", picture.words);
        // The point is moved off the middle of the vessel, since a point in the middle belongs to no side of the wall.
        let point = middle_of(&study, 1) + DVec3::X * 0.2;
        let pixel =
            study.on_reformed(point.to_array()).unwrap_or_else(|| panic!("{asked:?} does not show {point}"));
        let pick = study.pick_reformed(pixel).expect("a picture").expect("something shown");
        assert_eq!(pick.vessel, Some(1), "{asked:?}");
        let along = pick.arc_length.expect("a place");
        let expected = study.pick_at(point, Some(1)).arc_length.expect("a place");
        assert!((along - expected).abs() < picture.pixel_spacing, "{asked:?}: {along} and {expected}");
        // A map finds the point on the wall around the middle, and a spiral on the nearest winding.
        let bound = match &study.reformed.as_ref().expect("a picture").laid {
            Laid::Map(layout, _) => layout.parameters().mean_radius + BAND[1],
            Laid::Spiral(layout) => layout.parameters().pitch / 2.0,
            _ => 0.05,
        };
        let away = DVec3::from_array(pick.point).distance(point);
        assert!(away <= bound, "{asked:?}: {away} mm of {bound} mm");
    }
}

#[test]
fn names_stand_where_vessels_end_and_where_they_open_into_the_one_that_is_shown() {
    let mut study = opened("y_junction");
    let names = study.content.named.as_ref().expect("vessels").names.clone();
    let [untangled, _, _, map] = all_kinds(0)[..] else { panic!("four kinds") };
    let picture = study.reformed(untangled, PANE, (WINDOW, &go)).expect("a picture");
    let marked: Vec<_> = picture.marks.iter().map(|mark| mark.words.clone()).collect();
    assert_eq!(marked, names);
    for (n, mark) in picture.marks.iter().enumerate() {
        let end = study.vessel(n).expect("a vessel").points().last().expect("points").to_array();
        let place = study.on_reformed(end).expect("an end that is shown");
        assert!(DVec2::from_array(place).distance(DVec2::from_array(mark.pixel)) < 1.0, "{}", mark.words);
    }
    let wall = study.reformed(map, PANE, (WINDOW, &go)).expect("a map");
    assert!(wall.marks.iter().all(|mark| mark.words != names[0]), "no vessel opens into itself");
}

#[test]
fn a_window_alone_changes_the_picture_and_nothing_is_laid_out_again() {
    let mut study = opened("y_junction");
    let asked = all_kinds(0)[0];
    let asks = AtomicUsize::new(0);
    let counting = || asks.fetch_add(1, Ordering::Relaxed) == usize::MAX;
    let first = study.reformed(asked, PANE, (WINDOW, &counting)).expect("a picture");
    let laid_out = asks.swap(0, Ordering::Relaxed);
    let brighter = study.reformed(asked, PANE, ([0.0, 900.0], &counting)).expect("a picture kept");
    let kept = asks.load(Ordering::Relaxed);
    assert!(kept < laid_out, "the picture alone asks whether to stop: {kept} of {laid_out}");
    assert_eq!(brighter.size, first.size);
    assert_ne!(brighter.bytes, first.bytes);
    // In a pane of another size, the layout of the tree stays.
    let wide = study.reformed(asked, [480, 360], (WINDOW, &go)).expect("the same layout");
    assert!((wide.pixel_spacing - first.pixel_spacing / 2.0).abs() < 0.01 * first.pixel_spacing);
    // Seen from another side, the tree needs a new layout, which can be stopped.
    let side = serde_json::json!({"direction": [1.0, 0.0, 0.0], "up": [0.0, 0.0, 1.0]});
    let other = message(serde_json::json!({"kind": "untangled", "side": side}));
    let stopped = study.reformed(other, PANE, (WINDOW, &|| true)).expect_err("a stop");
    assert_eq!(stopped.kind, "interrupted");
}

#[test]
fn nothing_is_told_of_a_place_that_shows_nothing_and_of_none_at_all() {
    let mut study = opened("y_junction");
    assert_eq!(study.pick_reformed([0.0, 0.0]).expect_err("none is shown").subject, "reformation");
    assert!(study.on_reformed([0.0; 3]).is_none());
    study.reformed(all_kinds(0)[0], PANE, (WINDOW, &go)).expect("a picture");
    assert!(study.pick_reformed([-500.0, -500.0]).expect("a picture").is_none());
    study.show(&[]).expect("no vessels");
    assert!(study.on_reformed([0.0; 3]).is_none());
    let none = study.reformed(all_kinds(0)[0], PANE, (WINDOW, &go)).expect_err("no vessels");
    assert_eq!(none.found, "none");
}

#[test]
fn colours_of_a_map_tell_the_radius_of_the_wall() {
    let mut study = opened("stenosis");
    let asked = message(serde_json::json!({"kind": "map", "vessel": 0, "of": "radius"}));
    let picture = study.reformed(asked, PANE, (WINDOW, &go)).expect("a map");
    assert!(picture.words.contains("Colours: from 0 (dark blue) to 4"), "{}", picture.words);
    let [width, height] = picture.size;
    let green = |row: usize| picture.bytes[4 * (row * width + width / 2) + 1];
    // In the middle the vessel is half as wide, so its colour is half way down the scale.
    assert!(green(height / 2) + 40 < green(height / 8));
    let value = &study.reformed.as_ref().expect("a map").value;
    assert!((value[height / 8 * width] - 4.0).abs() < 0.3);
    // The vessel has no calcium at its wall.
    let thick = message(serde_json::json!({"kind": "map", "vessel": 0, "of": "thickness"}));
    study.reformed(thick, PANE, (WINDOW, &go)).expect("a map");
    assert!(
        study.reformed.as_ref().expect("a map").value.iter().all(|value| value.is_nan() || *value <= 0.5)
    );
}

#[test]
fn a_vessel_without_radii_is_refused_in_words() {
    let mut study = opened("y_junction");
    let points: Vec<_> = study.vessel(0).expect("a vessel").points().to_vec();
    let bare =
        lumencut_core::vessel_tree::VesselTree::new(vec![Vessel::new(points, None).expect("a vessel")]);
    study.show_tree(bare.expect("a tree"), vec![String::new()]).expect("shown");
    let asked = message(serde_json::json!({"kind": "spiral", "vessel": 0, "angle": 0.0}));
    let refused = study.reformed(asked, PANE, (WINDOW, &go)).expect_err("no radii");
    assert_eq!(refused.subject, "radius of the vessel");
}
