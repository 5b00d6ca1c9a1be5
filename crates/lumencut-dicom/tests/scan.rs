//! Tests of the scan parameters, which contain no patient data.

use crate::made::{as_they_are, even, file, plan, stack, with};
use serde_json::{Value, json};

fn told(change: impl Fn(usize, &mut Value)) -> Value {
    serde_json::to_value(plan(&stack(&even(4), change)).scan).expect("JSON")
}

#[test]
fn what_is_stated_alike_for_all_slices_is_told() {
    let scan = told(|_, attributes| {
        attributes["ConvolutionKernel"] = json!(["Bv40f", "3"]);
        attributes["SliceThickness"] = json!("0.75");
        attributes["NominalPercentageOfCardiacPhase"] = json!(70);
        attributes["TriggerTime"] = json!("400");
        attributes["ContrastBolusAgentPhase"] = json!("PORTAL_VENOUS");
        attributes["TemporalPositionIdentifier"] = json!("2");
    });
    let expected = json!({
        "series_number": "7", "series_description": "made",
        "phase": "70 % of the cardiac cycle, contrast phase portal venous, temporal position 2",
        "slice_thickness_mm": 0.75, "kernel": "Bv40f, 3",
    });
    assert_eq!(scan, expected);
    assert_eq!(told(with("TriggerTime", "400"))["phase"], "trigger time 400 ms");
}

#[test]
fn what_is_not_stated_damaged_or_differs_is_none() {
    let scan = told(|_, attributes| {
        for keyword in ["SeriesNumber", "SeriesDescription", "SliceThickness"] {
            attributes[keyword] = Value::Null;
        }
    });
    for (name, value) in scan.as_object().expect("an object") {
        assert!(value.is_null(), "{name}");
    }
    let odd = told(|k, attributes| {
        attributes["SliceThickness"] = json!(k + 1);
        attributes["ConvolutionKernel"] = json!(true);
        attributes["TriggerTime"] = json!("DOE^JOHN");
    });
    for name in ["slice_thickness_mm", "kernel", "phase"] {
        assert!(odd[name].is_null(), "{name}");
    }
    assert!(told(with("SliceThickness", "0"))["slice_thickness_mm"].is_null());
    assert_eq!(told(as_they_are)["slice_thickness_mm"], 2.0);
}

#[test]
fn a_phase_that_is_chosen_is_the_one_that_is_told() {
    let both = [("1", "30"), ("2", "70")].map(|(name, phase)| {
        stack(&even(3), move |k, attributes| {
            attributes["SOPInstanceUID"] = format!("1.2.{name}.{k}").into();
            attributes["NominalPercentageOfCardiacPhase"] = phase.into();
        })
    });
    let plan = crate::made::judged(&both.concat(), json!({"phase": "70"})).expect("one phase");
    assert_eq!(plan.scan.phase.as_deref(), Some("70 % of the cardiac cycle"));
}

#[test]
fn enhanced_images_state_it_in_functional_groups() {
    let mut attributes = crate::made::axial(0.0);
    attributes["NumberOfFrames"] = json!("3");
    let mut one = file("IM0", &attributes);
    let frame = |k: i32| json!({"ImagePositionPatient": ["0", "0", format!("{}", 2 * k)]});
    one["header"]["frames"] = (0..3).map(frame).collect();
    one["header"]["shared"] = json!({"ConvolutionKernel": "FC08", "SliceThickness": "3"});
    let scan = plan(&[one]).scan;
    assert_eq!((scan.kernel.as_deref(), scan.slice_thickness_mm), (Some("FC08"), Some(3.0)));
}
