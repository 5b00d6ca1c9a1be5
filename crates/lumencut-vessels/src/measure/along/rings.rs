//! Decides along a vessel which sections lie in a stent. Its struts may look like calcium or a vessel beside.

use std::ops::Range;

use crate::measure::fit::sections::{Bench, Section};
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::{CALCIUM, METAL, NEIGHBOR};

use super::struts::lies_in_metal;

/// Maximum distance (mm) between two rings of one stent; a longer stretch of metal is a stent. Single sections may miss struts.
const RINGS: f64 = 6.0;

/// Maximum distance (mm) between two rings if all sections between them contain bright material, and from a stent to
/// its end. Blurred struts look like calcium, but calcium does not start and end with metal.
const BRIGHT_BETWEEN: f64 = 40.0;

/// Maximum distance (mm) between two stents if what lies between may be struts.
const BETWEEN_STENTS: f64 = 80.0;

/// What the struts of a stent may look like.
const LIKE_STRUTS: u32 = CALCIUM | NEIGHBOR;

/// Flags the sections of stents as metal, which are then measured only as well as within clear struts.
pub(crate) fn flag_stents(bench: &Bench, places: &[SectionPlane], sections: &mut [Section]) {
    let at: Vec<f64> = places.iter().map(|place| place.at).collect();
    let before: Vec<u32> = sections.iter().map(|section| section.flags).collect();
    let mut flags = before.clone();
    join_rings(&at, &mut flags);
    for (n, section) in sections.iter_mut().enumerate() {
        section.flags = flags[n];
        if flags[n] & !before[n] & METAL != 0 {
            lies_in_metal(bench, &places[n], section);
        }
    }
}

/// Flags the sections between and next to rings of a stent as metal instead of calcium or a vessel beside.
fn join_rings(at: &[f64], flags: &mut [u32]) {
    join(at, flags, |between| between.length <= RINGS);
    for run in runs(flags, METAL).into_iter().filter(|run| is_stent(at, run)) {
        let [first, last] = [run.start, run.end - 1];
        let before = (0..first).rev().take_while(|n| at[first] - at[*n] <= BRIGHT_BETWEEN);
        let after = (last + 1..at.len()).take_while(|n| at[*n] - at[last] <= BRIGHT_BETWEEN);
        let [before, after] = [struts(before, flags), struts(after, flags)];
        for n in before.into_iter().chain(after) {
            flags[n] |= METAL;
        }
    }
    join(at, flags, |between| match between.stents {
        true => between.longest_dark <= RINGS && between.length <= BETWEEN_STENTS,
        false => between.longest_dark == 0.0 && between.length <= BRIGHT_BETWEEN,
    });
    for flags in flags.iter_mut().filter(|flags| **flags & METAL != 0) {
        *flags &= !LIKE_STRUTS;
    }
}

struct Between {
    length: f64,
    longest_dark: f64,
    stents: bool,
}

fn join(at: &[f64], flags: &mut [u32], is_one: impl Fn(&Between) -> bool) {
    for two in runs(flags, METAL).windows(2) {
        let [first, last] = [two[0].end - 1, two[1].start];
        let stents = two.iter().all(|run| is_stent(at, run));
        let like = METAL | if stents { LIKE_STRUTS } else { CALCIUM };
        let bright = runs(&flags[first..=last], like);
        let dark = bright.windows(2).map(|two| at[first + two[1].start] - at[first + two[0].end - 1]);
        let between =
            Between { length: at[last] - at[first], longest_dark: dark.fold(0.0, f64::max), stents };
        if is_one(&between) {
            for flags in &mut flags[first..last] {
                *flags |= METAL;
            }
        }
    }
}

fn runs(flags: &[u32], of: u32) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for n in (0..flags.len()).filter(|n| flags[*n] & of != 0) {
        match found.last_mut() {
            Some(run) if run.end == n => run.end = n + 1,
            _ => found.push(n..n + 1),
        }
    }
    found
}

fn is_stent(at: &[f64], run: &Range<usize>) -> bool {
    at[run.end - 1] - at[run.start] >= RINGS
}

/// The sections, beginning next to a stent, up to the last one that may contain its struts.
fn struts(beside: impl Iterator<Item = usize>, flags: &[u32]) -> Vec<usize> {
    let mut found: Vec<usize> = beside.take_while(|n| flags[*n] & LIKE_STRUTS != 0).collect();
    let count = found.iter().rposition(|n| flags[*n] & CALCIUM != 0).map_or(0, |last| last + 1);
    found.truncate(count);
    found
}

#[cfg(test)]
#[path = "tests/rings.rs"]
mod tests;
