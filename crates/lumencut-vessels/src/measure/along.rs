//! What sections of a vessel share. If the width of a vessel changes, blur along it mixes a section with its neighbours:
//! to first order, the measured area is the true area plus half of the blur variance times the second derivative of
//! the area. If a centerline turns too sharply, section planes intersect inside the lumen.

pub(crate) mod all_sections;
pub(crate) mod assumed_spread;
pub(crate) mod calcified;
pub(crate) mod contradicted;
pub(crate) mod dim_plaque;
pub(crate) mod levels;
pub(crate) mod point_spread;
pub(crate) mod rings;
pub(crate) mod struts;
pub(crate) mod throats;

use crate::measure::fit::sections::Section;
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::RESTLESS_LINE;
use lumencut_core::math::same_place::REPEATED_POINT;
use lumencut_core::math::statistics::median;

/// Half-length (mm) of the window in which a parabola is fitted to the areas, and its minimum number of sections.
const PARABOLA: (f64, usize) = (2.0, 5);

/// Maximum relative correction of an area, because the formula is only a first-order approximation.
const MAX_CORRECTION: f64 = 0.25;

/// Maximum turn within one diameter (degrees). The geometric limit is 115°; real vessels reach 70°.
pub(crate) const SHARP: f64 = 75.0;

/// Corrects the areas of sections at arc lengths `at` (mm); `variance` is the blur variance along the vessel (mm²).
pub(crate) fn sharpen(sections: &mut [Section], at: &[f64], variance: &[f64]) {
    let areas: Vec<f64> =
        sections.iter().map(|section| section.fit.map_or(f64::NAN, |fit| fit.ellipse.area())).collect();
    for n in 0..sections.len() {
        let Some(bend) = second_derivative(at, &areas, n) else { continue };
        let change = -0.5 * variance[n] * bend / areas[n];
        sections[n].scale((1.0 + change.clamp(-MAX_CORRECTION, MAX_CORRECTION)).sqrt());
    }
}

/// Second derivative of the area at section `n`; None if too few neighbouring sections have an area.
fn second_derivative(at: &[f64], areas: &[f64], n: usize) -> Option<f64> {
    let (reach, least) = PARABOLA;
    let first = at.partition_point(|there| *there < at[n] - reach - REPEATED_POINT);
    let last = at.partition_point(|there| *there <= at[n] + reach + REPEATED_POINT);
    // The window is symmetric, so that linear growth of the areas does not change the result.
    let side = (n - first).min(last - 1 - n);
    let around = n - side..=n + side;
    if 2 * side + 1 < least || around.clone().any(|m| areas[m].is_nan()) {
        return None;
    }
    let count = (2 * side + 1) as f64;
    let square = |m: usize| (at[m] - at[n]).powi(2);
    let mean = around.clone().map(square).sum::<f64>() / count;
    let (mut product, mut norm) = (0.0, 0.0);
    for m in around {
        let off = square(m) - mean;
        product += off * areas[m];
        norm += off * off;
    }
    Some(2.0 * product / norm)
}

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
mod tests {
    use super::*;

    #[test]
    fn the_bend_of_a_parabola_is_found_where_both_sides_are_known() {
        let at: Vec<f64> = (0..21).map(|n| f64::from(n) * 0.5).collect();
        let mut areas: Vec<f64> = at.iter().map(|at| 4.0 + 0.3 * at + 0.7 * at * at).collect();
        assert!((second_derivative(&at, &areas, 10).unwrap() - 1.4).abs() < 1e-9);
        assert!((second_derivative(&at, &areas, 2).unwrap() - 1.4).abs() < 1e-9);
        assert!(second_derivative(&at, &areas, 1).is_none());
        areas[12] = f64::NAN;
        assert!(second_derivative(&at, &areas, 10).is_none());
    }
}

#[cfg(test)]
#[path = "along/tests/sharp_turns.rs"]
mod sharp_turns;
