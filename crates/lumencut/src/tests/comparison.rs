use glam::DVec3;
use lumencut_vessels::measure::comparison::compare;
use lumencut_vessels::measure::profile::Profile;

use super::{Compared, signed};
use crate::report::comparison::comparison_html;
use crate::tube::tube;

/// A measured tube, and the same with a wider lumen between 8 and 16 mm.
fn both(grown: f64) -> [Profile; 2] {
    let first = tube();
    let mut second = first.clone();
    for n in 0..second.len() {
        if (8.0..=16.0).contains(&second.arc_length[n]) {
            second.area[n] *= grown * grown;
        }
        second.on_vessel[n] += DVec3::new(5.0, 0.0, 90.0);
    }
    [first, second]
}

fn compared_by(grown: f64, check: impl Fn(&Compared)) {
    let [first, second] = both(grown);
    let middle = first.length() / 2.0;
    let comparison = compare(&first, &second, &[[middle, middle]]).expect("the same vessel");
    let scans = ["2024 <i>".to_owned(), "2026".to_owned()];
    let doubts = vec!["another patient?".to_owned()];
    check(&Compared {
        vessel: "Aorta".to_owned(),
        scans,
        comparison: &comparison,
        doubts,
        pictures: Vec::new(),
    });
}

#[test]
fn words_table_json_and_report_state_the_same_change() {
    compared_by(1.3, |compared| {
        let lines = compared.lines();
        assert_eq!(lines[0], "another patient?");
        assert_eq!(compared.all_doubts(), ["another patient?"]);
        assert!(lines[1].starts_with("wider from ") && lines[1].contains(" difference +"), "{lines:?}");
        assert!(compared.matched().starts_with("matched by given places, ± 1.0 mm along the vessel"));
        let csv = compared.csv();
        let rows: Vec<&str> = csv.lines().collect();
        assert_eq!(rows.len(), compared.comparison.places.len() + 1);
        assert!(rows.iter().all(|row| row.split(',').count() == 10));
        let changed = rows.iter().filter(|row| row.ends_with(",1")).count();
        assert!((16..=18).contains(&changed), "{changed}");
        let json: serde_json::Value = serde_json::from_str(&compared.json()).expect("JSON");
        assert_eq!(json["changes"].as_array().expect("changes").len(), 1);
        assert_eq!(json["scans"][1], "2026");
        let html = comparison_html(std::slice::from_ref(compared)).expect("a report");
        assert!(
            html.contains("2024 &lt;i&gt;") && html.contains("class=\"change\"") && !html.contains("NaN")
        );
        assert!(html.contains("another patient?") && html.contains("Wider from "));
    });
}

#[test]
fn without_a_change_they_say_so() {
    compared_by(1.002, |compared| assert_eq!(compared.all_doubts(), ["another patient?"]));
    compared_by(1.0, |compared| {
        assert!(compared.lines()[1].starts_with("both profiles are equal in every section"));
        assert_eq!(compared.lines()[2], "no change beyond 2 standard deviations of both diameters");
        assert!(compared.csv().lines().skip(1).all(|row| row.ends_with(",0")));
        assert!(
            comparison_html(std::slice::from_ref(compared)).expect("a report").contains("No change beyond 2")
        );
    });
}

#[test]
fn a_difference_has_its_sign_unless_it_is_zero() {
    assert_eq!([1.256, -0.3, -0.001, 0.002].map(signed), ["+1.26", "-0.30", "0.00", "0.00"]);
}
