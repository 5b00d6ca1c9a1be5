use serde_json::json;

use super::*;
use crate::study::tests::opened;

fn pane(study: &mut Study, is_measured: bool) -> MeasureLayout {
    let line = study.report().expect("a report");
    let line = serde_json::to_value(line).expect("JSON")["vessels"][0]["line"].clone();
    let message =
        json!({"line": line, "is_measured": is_measured, "size": [900, 500], "between": 28, "density": 2});
    let message: MeasurePaneMessage = serde_json::from_value(message).expect("a message");
    study.measure_layout(&message, &|| false).expect("a layout")
}

#[test]
fn vessel_and_chart_share_an_axis_and_the_pane() {
    let mut study = opened("stenosis");
    let MeasureLayout { x, strip, chart } = pane(&mut study, true);
    let chart = chart.expect("a chart");
    assert_eq!([x.start, x.end, chart.size[0]], [56.0, 796.0, 900.0]);
    assert_eq!(chart.size[1] + 28.0 + strip.height.round(), 500.0);
    assert!(strip.height <= 200.0 && strip.spacing == ((x.high - x.low) / 740.0 / 2.0).max(0.05));
    assert!(chart.width.starts_with('M') && chart.ticks[0][0].words == "0" && chart.ticks[0][0].at == 56.0);
}

#[test]
fn a_vessel_that_is_not_measured_has_the_same_axis_and_no_chart() {
    let mut study = opened("stenosis");
    let MeasureLayout { x, chart, .. } = pane(&mut study, false);
    assert!(chart.is_none());
    assert!((x.high - pane(&mut study, true).x.high).abs() < 1e-9);
}
