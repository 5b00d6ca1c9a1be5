//! Values along vessels against closed forms.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::named::Named;
use lumencut_vessels::measure::stenosis::{Compared, Method};

use super::*;
use crate::tube::tube;

/// A straight vessel of 60 mm, as `tube` has it, with a radius that grows from 2 to 5 mm.
fn cone() -> Vessel {
    let points = (0..=60).map(|z| DVec3::Z * f64::from(z)).collect();
    let radius = (0..=60).map(|z| 2.0 + f64::from(z) / 20.0).collect();
    Vessel::new(points, Some(radius)).unwrap()
}

fn values(kind: RimValue, profile: Option<&Profile>, stenoses: &[Stenosis]) -> ValuesAlong {
    ValuesAlong::new(kind, &[Along { vessel: &cone(), profile, stenoses }]).unwrap()
}

fn at(along: &ValuesAlong, place: f64) -> f32 {
    along.values[0][(place / 60.0 * (along.values[0].len() - 1) as f64).round() as usize]
}

#[test]
fn diameters_of_a_cone_are_linear_and_so_are_its_colours() {
    let along = values(RimValue::Diameter, None, &[]);
    for place in [0.0, 10.0, 30.25, 60.0] {
        assert!((f64::from(at(&along, place)) - (4.0 + place / 10.0)).abs() < 1e-6, "at {place}");
    }
    assert_eq!((along.legend.ends, along.legend.unit), ([4.0, 10.0], "mm"));
    let colors = along.rim().unwrap();
    assert_eq!((colors.colors()[0], colors.vessels()), ([65, 61, 123, 255], 1));
    assert_eq!(colors.colors().last(), Some(&[222, 245, 229, 255]));
    // The middle of six colours is half way between the third and the fourth.
    assert_eq!(colors.colors()[colors.colors().len() / 2], [58, 163, 170, 255]);
}

#[test]
fn one_value_alone_gives_a_scale_of_half_a_millimetre() {
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z], Some(vec![3.0; 2])).unwrap();
    let along = Along { vessel: &vessel, profile: None, stenoses: &[] };
    assert_eq!(ValuesAlong::new(RimValue::Diameter, &[along]).unwrap().legend.ends, [6.0, 6.5]);
}

#[test]
fn chosen_ends_of_the_colours_replace_those_of_the_values() {
    let along = values(RimValue::Diameter, None, &[]);
    let chosen = along.clone().ranged([Some(5.0), Some(8.0)]).unwrap();
    assert_eq!(chosen.legend.ends, [5.0, 8.0]);
    // Beyond the ends, the first and the last colour continue.
    let colors = chosen.colours()[0].clone();
    assert_eq!((colors[0], colors.last()), ([65, 61, 123, 255], Some(&[222, 245, 229, 255])));
    assert_eq!(along.clone().ranged([None, Some(8.0)]).unwrap().legend.ends, [4.0, 8.0]);
    assert_eq!(along.clone().ranged([None; 2]).unwrap(), along);
    for ends in [[Some(8.0); 2], [Some(10.0), None], [None, Some(3.0)]] {
        let error = along.clone().ranged(ends).unwrap_err();
        assert!(error.to_string().contains("mm; expected rim_low below rim_high"), "{error}");
    }
}

#[test]
fn profiles_precede_radii_and_sections_that_do_not_count_have_no_value() {
    let mut tube = tube();
    let along = values(RimValue::Diameter, Some(&tube), &[]);
    assert_eq!([10.0, 30.0].map(|place| at(&along, place)), [8.0, 4.0]);
    tube.area[20] = f64::NAN;
    assert!(at(&values(RimValue::Diameter, Some(&tube), &[]), 10.0).is_nan());
    let unsure = values(RimValue::Uncertainty, Some(&tube), &[]);
    assert!((at(&unsure, 30.0) - 0.1).abs() < 1e-6);
    assert_eq!(unsure.legend.ends, [0.0, 0.5]);
}

fn graded(method: Method, references: &[f64]) -> Stenosis {
    let original = (method == Method::Ecst).then_some(8.0);
    let compared = Compared { reference: references.to_vec(), original, comparison: None };
    tube().stenosis(30.0, method, &compared).unwrap()
}

#[test]
fn narrowing_is_the_percentage_at_a_graded_stenosis_and_nothing_elsewhere() {
    for (method, references) in
        [(Method::Nascet, &[18.0, 42.0][..]), (Method::Area, &[42.0]), (Method::Ecst, &[])]
    {
        let stenosis = graded(method, references);
        let along = values(RimValue::Narrowing, Some(&tube()), std::slice::from_ref(&stenosis));
        assert!((f64::from(at(&along, 30.0)) - stenosis.percent).abs() < 1e-4, "{}", method.name());
        // The narrow part ends within 0.5 mm of 26 and 34 mm.
        assert!([27.0, 33.0].iter().all(|place| at(&along, *place) > 10.0));
        assert!([0.0, 25.0, 35.0, 50.0].iter().all(|place| at(&along, *place).is_nan()));
    }
}

#[test]
fn deviation_is_the_difference_from_the_reference() {
    let stenosis = graded(Method::Nascet, &[18.0, 42.0]);
    let along = values(RimValue::Deviation, Some(&tube()), &[stenosis]);
    assert_eq!([10.0, 30.0].map(|place| at(&along, place)), [0.0, -4.0]);
    assert_eq!(along.legend.ends, [-4.0, 4.0]);
    assert_eq!(along.colours()[0][40], [225, 225, 225, 255], "zero has the middle colour");
}

#[test]
fn what_has_no_values_names_what_gives_some() {
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 60.0], None).unwrap();
    let profile = &tube();
    for (kind, profile, found) in [
        (RimValue::Diameter, None, "neither radii nor profiles"),
        (RimValue::Narrowing, Some(profile), "no graded stenosis"),
        (RimValue::Deviation, None, "no graded stenosis"),
        (RimValue::Uncertainty, None, "no measured diameter"),
    ] {
        let error = ValuesAlong::new(kind, &[Along { vessel: &vessel, profile, stenoses: &[] }]).unwrap_err();
        assert_eq!(error.found, found);
    }
}

#[test]
fn a_rim_needs_radii() {
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 60.0], None).unwrap();
    let profile = tube();
    let along = Along { vessel: &vessel, profile: Some(&profile), stenoses: &[] };
    let error = ValuesAlong::new(RimValue::Diameter, &[along]).unwrap().rim().unwrap_err();
    assert_eq!((error.kind, error.found.as_str()), (ErrorKind::VesselTree, "vessels without radii"));
}

#[test]
fn a_profile_belongs_to_the_vessel_that_it_follows() {
    let line = |x: f64, length: f64| {
        Vessel::new(vec![DVec3::X * x, DVec3::new(x, 0.0, length)], Some(vec![4.0; 2])).unwrap()
    };
    let [near, own, short, far] = [line(3.0, 60.0), line(0.5, 60.0), line(0.0, 55.0), line(30.0, 60.0)];
    assert_eq!(vessel_of(&tube(), &[near.clone(), own, short.clone()]).unwrap(), 1);
    assert_eq!(vessel_of(&tube(), &[short.clone(), near]).unwrap(), 1);
    let error = vessel_of(&tube(), &[short, far]).unwrap_err();
    assert_eq!(error.found, "one of 60.0 mm that follows no vessel of the tree");
}
