use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;

use super::*;
use crate::study::straightened::{Aggregated, Followed};
use crate::study::tests::opened;

const WINDOW: [f64; 2] = [300.0, 900.0];
const PLAIN: CprMessage =
    CprMessage { vessel: 0, angle: 0.0, width: 20.0, pixel_spacing: 0.5, feature: None, roll: None };

fn go() -> bool {
    false
}

#[test]
fn a_click_in_a_feature_aggregation_finds_the_place_that_it_shows() {
    let mut study = opened("y_junction");
    for (feature, is_larger) in [(Aggregated::Max, true), (Aggregated::Min, false)] {
        study.straightened(CprMessage { feature: Some(feature), ..PLAIN }, (WINDOW, &go)).expect("a CFA");
        let laid = study.laid.clone().expect("a CFA");
        let [width, height] = laid.cpr.size();
        let middle = (width - 1) as f64 / 2.0;
        for (column, row) in [(middle + 12.0, height as f64 - 4.0), (middle - 9.0, 20.0), (middle, 10.0)] {
            let pick = study.pick_straightened([column, row]).expect("a pick");
            let along = DVec3::from_array(laid.world([middle, row]));
            let away = DVec3::from_array(pick.point).distance(along);
            assert!((away - (column - middle).abs() * 0.5).abs() < 1e-9, "{column}, {row}");
            assert_eq!(pick.arc_length, row * 0.5);
            let found = pick.value.expect("in the volume");
            let circle = half_circle(&laid.cpr, 0.5, DVec2::new(column, row)).expect("a circle");
            let others: Vec<_> = circle.iter().filter_map(|point| study.at(point.to_array()).value).collect();
            assert!(others.len() > 10);
            assert!(others.iter().all(|value| if is_larger { *value <= found } else { *value >= found }));
        }
    }
    study
        .straightened(CprMessage { feature: Some(Aggregated::Mean), ..PLAIN }, (WINDOW, &go))
        .expect("a CFA");
    let [_, height] = study.laid.as_ref().expect("a CFA").cpr.size();
    let pixel = [4.0, height as f64 / 2.0];
    let pick = study.pick_straightened(pixel).expect("a pick");
    assert_eq!(pick.point, study.laid.as_ref().expect("a CFA").world(pixel));
}

#[test]
fn a_roll_measures_the_lumen_once_and_has_no_angle_of_its_own() {
    let mut study = opened("stenosis");
    let rolled = CprMessage { roll: Some(Followed::Narrowest), ..PLAIN };
    let stopped = study.straightened(rolled, (WINDOW, &|| true)).expect_err("a stop");
    assert_eq!(stopped.kind, "interrupted");
    let asks = AtomicUsize::new(0);
    let counting = || asks.fetch_add(1, Ordering::Relaxed) == usize::MAX;
    let first = study.straightened(rolled, (WINDOW, &counting)).expect("a CPR");
    let measured = asks.swap(0, Ordering::Relaxed);
    let turned = CprMessage { angle: 1.0, ..rolled };
    let again = study.straightened(turned, (WINDOW, &counting)).expect("the same CPR");
    assert_eq!(first, again);
    let kept = asks.load(Ordering::Relaxed);
    assert!(kept < measured, "the picture alone asks whether to stop: {kept} of {measured}");
    let [width, height] = first.size;
    let place = [width as f64 / 2.0 + 3.0, height as f64 / 3.0];
    let pick = study.pick_straightened(place).expect("a pick");
    let back = study.on_straightened(pick.point).expect("a CPR");
    assert!((back[0] - place[0]).abs() < 1e-6 && (back[1] - place[1]).abs() < 1e-6);
    let both = CprMessage { feature: Some(Aggregated::Max), ..rolled };
    let refused = study.straightened(both, (WINDOW, &go)).expect_err("a feature of a roll");
    assert_eq!(refused.subject, "feature of the CFA");
}
