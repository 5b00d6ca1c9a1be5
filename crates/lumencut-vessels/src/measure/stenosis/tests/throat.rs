use super::super::made_profile::profile;
use super::*;
use crate::measure::section::flags::NO_EDGE;
use crate::measure::stenosis::{Compared, Method};

/// A vessel of 4 mm with a narrow place of `measured` mm at 10 mm, and a throat of at most 0.7 mm at 30 mm.
fn with_throat(measured: f64) -> Profile {
    let mut made = profile(&[[4.0, 0.1]; 120]);
    for (n, most) in [(59, 0.9), (60, 0.7), (61, 0.8)] {
        (made.area[n], made.at_most[n], made.flags[n]) = (f64::NAN, most, NO_EDGE);
    }
    made.area[19..22].fill(measured * measured * std::f64::consts::PI / 4.0);
    made
}

#[test]
fn a_throat_is_offered_as_a_limit_and_never_as_a_measured_diameter() {
    let made = with_throat(2.0);
    assert_eq!(made.throat(), Some(Spot { at: 30.0, diameter: 0.7 }));
    assert_eq!(made.narrowest(), None);
    let error = made.diameter_at(30.0).expect_err("not measured").to_string();
    assert!(error.contains("no clear wall at 30.0 mm, where the lumen is at most 0.70 mm"), "{error}");
    let compared = Compared { reference: vec![20.0], ..Compared::default() };
    assert!(made.stenosis(30.0, Method::Nascet, &compared).is_err());
    assert!(made.suggested_references(30.0).is_ok_and(|offered| offered.iter().all(Option::is_some)));
}

#[test]
fn a_throat_that_may_be_wider_than_a_measured_place_is_not_offered() {
    let made = with_throat(0.5);
    assert_eq!(made.throat(), None);
    assert!(made.narrowest().is_some_and(|spot| spot.diameter < 0.6));
    assert_eq!(profile(&[[4.0, 0.1]; 20]).throat(), None);
}
