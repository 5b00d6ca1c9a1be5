use super::*;
use crate::tube::tube;
use lumencut_vessels::measure::section::flags::CALCIUM;

#[test]
fn a_narrower_place_has_the_diameter_that_the_list_of_places_shows() {
    let mut vessel = tube();
    let suggested = vessel.narrowest().expect("a place");
    let far = vessel.nearest_section(if suggested.at < 30.0 { 45.0 } else { 15.0 });
    for (n, diameter) in [(far - 1, 2.3_f64), (far, 2.1), (far + 1, 2.2)] {
        (vessel.area[n], vessel.flags[n]) = (std::f64::consts::PI * diameter * diameter / 4.0, CALCIUM);
    }
    let words = narrower(&vessel, None).expect("a place");
    let (diameter, _) = vessel.diameter_at(vessel.passed_over().expect("a place").0.at).expect("measured");
    assert!(words.contains(&format!(": {diameter:.2} mm at ")), "{words}");
}
