//! Finds plaque that the fit takes for lumen: a section is dimmer and narrower than those beside it. In narrow vessels
//! blur joins bright plaque and lumen, so that no edge lies between them.

use crate::measure::fit::sections::Section;
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::{BRANCH, CALCIUM, LEFT_OUT, METAL, NEIGHBOR, PLAQUE};
use lumencut_core::math::statistics::median;

/// A lumen is dim below this fraction of the level along the vessel: 0 is the level of a wall.
const DIM: f64 = 0.93;

/// A section is narrow below this fraction of the median diameter of bright sections up to this distance (mm), of which
/// there are at least this number.
const NARROW: f64 = 0.97;
const BESIDE_MM: f64 = 10.0;
const LEAST_BESIDE: usize = 4;

/// Level of such plaque, as a fraction like that of [`DIM`], and minimum share of the area that is lumen.
const PLAQUE_LEVEL: f64 = 0.3;
const LEAST_LUMEN: f64 = 0.05;

const OTHER_REASON: u32 = LEFT_OUT | BRANCH | CALCIUM | METAL | NEIGHBOR;

/// Flags such sections. `lumen` is the level of the lumen along the vessel, and `wall` that of a wall.
pub(crate) fn flag_dim_plaque(places: &[SectionPlane], sections: &mut [Section], lumen: &[f64], wall: f64) {
    let share = |n: usize, section: &Section| {
        let fit = section.fit.as_ref().filter(|_| section.flags & OTHER_REASON == 0)?;
        Some((fit.ellipse.equivalent_diameter(), (fit.lumen[0] - wall) / (lumen[n] - wall)))
    };
    let shares: Vec<Option<(f64, f64)>> = sections.iter().enumerate().map(|(n, one)| share(n, one)).collect();
    let beside = |n: usize| {
        let near = (0..places.len()).filter(|m| (places[*m].at - places[n].at).abs() <= BESIDE_MM);
        let bright = near.filter_map(|m| shares[m]).filter(|(_, share)| *share >= DIM);
        let mut diameters: Vec<f64> = bright.map(|(diameter, _)| diameter).collect();
        median(&mut diameters).filter(|_| diameters.len() >= LEAST_BESIDE)
    };
    for (n, section) in sections.iter_mut().enumerate() {
        let Some((diameter, share)) = shares[n].filter(|(_, share)| *share < DIM) else { continue };
        if beside(n).is_none_or(|usual| diameter >= NARROW * usual) {
            continue;
        }
        section.flags |= PLAQUE;
        if let Some(fit) = &mut section.fit {
            let is_lumen = ((share - PLAQUE_LEVEL) / (1.0 - PLAQUE_LEVEL)).max(LEAST_LUMEN);
            fit.parts.surroundings = fit.parts.surroundings.max(diameter * (1.0 - is_lumen.sqrt()));
            fit.uncertainty = fit.parts.total();
        }
    }
}

#[cfg(test)]
#[path = "tests/dim_plaque.rs"]
mod tests;
