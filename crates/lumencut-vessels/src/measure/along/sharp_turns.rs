//! Finds turns of a centerline so sharp that section planes intersect inside the lumen.

use crate::measure::fit::sections::Section;
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::RESTLESS_LINE;
use lumencut_core::math::statistics::median;

/// Maximum turn within one diameter (degrees). The geometric limit is 115°; real vessels reach 70°.
pub(crate) const SHARP: f64 = 75.0;

pub(crate) fn flag_sharp_turns(places: &[SectionPlane], sections: &mut [Section]) {
    let widths = sections.iter().filter_map(|section| section.fit.as_ref());
    let mut widths: Vec<f64> = widths.map(|fit| fit.ellipse.equivalent_diameter()).collect();
    let Some(diameter) = median(&mut widths) else { return };
    for (section, turn) in sections.iter_mut().zip(turns(places, diameter)) {
        if turn > SHARP {
            section.flags |= RESTLESS_LINE;
        }
    }
}

/// Total turn (degrees) within a window of `within` mm around each section.
fn turns(places: &[SectionPlane], within: f64) -> Vec<f64> {
    let mut turned = vec![0.0];
    for two in places.windows(2) {
        let so_far = turned.last().copied().unwrap_or(0.0);
        turned.push(so_far + two[0].normal.angle_between(two[1].normal).to_degrees());
    }
    let ends = |at: f64| {
        let first = places.partition_point(|place| place.at < at - 0.5 * within);
        let behind = places.partition_point(|place| place.at <= at + 0.5 * within);
        turned[behind.max(1) - 1] - turned[first.min(places.len() - 1)]
    };
    places.iter().map(|place| ends(place.at)).collect()
}

#[cfg(test)]
#[path = "tests/sharp_turns.rs"]
mod tests;
