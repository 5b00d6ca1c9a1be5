//! Finds contours inside a lumen: the outlines of both neighbours are filled with lumen at their section too.

use crate::measure::fit::Fit;
use crate::measure::fit::sections::{Bench, Section};
use crate::measure::model::ellipse::Ellipse;
use crate::measure::section::SectionPlane;
use crate::measure::section::contour_check::{BLURRED_WIDTHS, encloses_lumen, lumen_shares};
use crate::measure::section::flags::{LEFT_OUT, NO_EDGE};
use crate::measure::section::rays::{RAYS, direction};
use std::f64::consts::PI;

/// A section contradicts its neighbours if their area is more than this multiple of its own.
const LARGER: f64 = 2.0;

/// Flags sections that the nearest larger sections within one of their diameters contradict on both sides.
pub(crate) fn flag_contradicted(bench: &Bench, places: &[SectionPlane], sections: &mut [Section]) {
    let doubted: Vec<usize> =
        (0..sections.len()).filter(|n| is_doubted(bench, places, sections, *n)).collect();
    for n in doubted {
        sections[n].flags |= NO_EDGE;
    }
}

fn is_doubted(bench: &Bench, places: &[SectionPlane], sections: &[Section], n: usize) -> bool {
    let Some(own) = counted(&sections[n]) else { return false };
    let larger = |m: &usize| {
        let fit = counted(&sections[*m]).filter(|fit| fit.ellipse.area() > LARGER * own.ellipse.area());
        fit.filter(|fit| (places[*m].at - places[n].at).abs() <= fit.ellipse.equivalent_diameter())
            .map(|fit| (*m, fit))
    };
    let (Some((before, one)), Some((after, other))) =
        ((0..n).rev().find_map(|m| larger(&m)), (n + 1..sections.len()).find_map(|m| larger(&m)))
    else {
        return false;
    };
    let share = (places[n].at - places[before].at) / (places[after].at - places[before].at);
    let level = |of: fn(&Fit) -> f64| of(&one) + share * (of(&other) - of(&one));
    let outline = one.ellipse.towards(&other.ellipse, share);
    let width = bench.blur.width(&places[n]);
    let walls: [f64; RAYS] = std::array::from_fn(|ray| outline.radius_towards(direction(ray)));
    // In a narrow vessel, blur hides most of what the outline encloses.
    let checked = Ellipse { mean: outline.mean - BLURRED_WIDTHS * width, ..outline };
    let is_checked = checked.mean > 0.0 && PI * checked.mean.powi(2) > LARGER * own.ellipse.area();
    let shares = lumen_shares(level(|fit| fit.lumen[0]), level(|fit| fit.background));
    is_checked && encloses_lumen(&bench.rays, &places[n], outline.center, &walls, width, shares)
}

fn counted(section: &Section) -> Option<Fit> {
    section.fit.filter(|_| section.flags & LEFT_OUT == 0)
}

#[cfg(test)]
#[path = "tests/contradicted.rs"]
mod tests;
