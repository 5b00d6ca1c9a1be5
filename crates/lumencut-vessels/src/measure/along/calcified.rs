//! Compares sections at calcium with the free sections on both sides. Blooming reaches along the vessel, and a fit
//! between bright walls may collapse.

use crate::measure::fit::sections::Section;
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::{CALCIUM, LEFT_OUT, METAL, NO_EDGE};
use lumencut_core::math::statistics::median;

/// Blooming reaches this many blur widths along the vessel.
const BLOOMING_WIDTHS: f64 = 2.0;

/// A section next to calcium that is wider than the free ones by this factor shows blooming.
const WIDER: f64 = 1.06;

/// If bright material hides the wall, a fit narrower than this fraction of the free lumens is not a lumen.
const COLLAPSED: f64 = 0.3;

/// Sections up to this distance give the free diameter on a side (mm), for stretches up to this length (mm).
const REACH_MM: f64 = 10.0;
const LONGEST_MM: f64 = 40.0;

/// Flags blooming, drops collapsed fits, and limits the lower bound by the free diameter; `width` is the blur (mm).
pub(crate) fn settle(places: &[SectionPlane], sections: &mut [Section], width: f64) {
    let reach = BLOOMING_WIDTHS * width;
    let bright: Vec<f64> =
        (0..places.len()).filter(|n| is_bright(&sections[*n])).map(|n| places[n].at).collect();
    let is_near = |n: usize| bright.iter().any(|at| (at - places[n].at).abs() <= reach);
    let is_free =
        |n: &usize| sections[*n].flags & LEFT_OUT == 0 && sections[*n].fit.is_some() && !is_near(*n);
    let free: Vec<(usize, f64)> =
        (0..places.len()).filter(is_free).map(|n| (n, diameter(&sections[n]))).collect();
    for two in free.windows(2) {
        let [from, to] = [two[0].0, two[1].0];
        let [first, last] = [places[from].at, places[to].at];
        if last - first > LONGEST_MM {
            continue;
        }
        let beside = |is_there: &dyn Fn(f64) -> bool| {
            let there = free.iter().filter(|(n, _)| is_there(places[*n].at));
            median(&mut there.map(|(_, diameter)| *diameter).collect::<Vec<f64>>())
        };
        let before = beside(&|at| at <= first && at >= first - REACH_MM);
        let after = beside(&|at| at >= last && at <= last + REACH_MM);
        let (Some(before), Some(after)) = (before, after) else { continue };
        for n in from + 1..to {
            let share = (places[n].at - first) / (last - first);
            judge(&mut sections[n], before + share * (after - before), is_near(n));
        }
    }
}

/// Judges a section by the free diameter (mm) that its neighbours let expect.
fn judge(section: &mut Section, free: f64, is_near: bool) {
    let measured = diameter(section);
    if is_bright(section) {
        if measured < COLLAPSED * free {
            let (flags, [low, high]) = (section.flags | NO_EDGE, section.bounds);
            let bounds = [low, high.max(free)];
            *section = Section { flags, bounds, ..Section::none() };
        }
        // Thin struts have no bounds, and `min` would ignore their NaN.
        if section.bounds[0] > free {
            section.bounds[0] = free;
        }
    } else if is_near && section.flags & LEFT_OUT == 0 && measured > WIDER * free {
        section.flags |= CALCIUM;
        section.bounds = [free, measured];
    }
}

fn is_bright(section: &Section) -> bool {
    section.flags & (CALCIUM | METAL) != 0
}

fn diameter(section: &Section) -> f64 {
    section.fit.map_or(f64::NAN, |fit| fit.ellipse.equivalent_diameter())
}

#[cfg(test)]
#[path = "tests/calcified.rs"]
mod tests;
