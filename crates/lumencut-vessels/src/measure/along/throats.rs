//! Limits the diameter where the lumen between two clear sections is dim: the throat of a tight stenosis. A lumen
//! narrower than the blur does not reach its level, so its peak limits how wide it can be.

use glam::DVec2;

use crate::measure::estimation::Level;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::{Bench, Section};
use crate::measure::model::ellipse::Ellipse;
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::fwhm_of;
use crate::measure::section::flags::{LEFT_OUT, NO_EDGE};
use crate::measure::section::rays::{RAYS, direction};
use lumencut_core::error::Result;
use lumencut_core::math::statistics::median;

/// A lumen below this fraction of the level of its neighbours is dim: plaque hides it, or it is narrower than the blur.
const DIM: f64 = 0.9;

/// A run holds a throat if the peak of a section is below this fraction of the peaks beside the run.
const THROAT: f64 = 0.75;

/// Sections up to this distance from a run with a throat (mm) are fitted again with the level of the lumen beside it.
const REFITTED_MM: f64 = 3.0;

/// Standard deviation of that level, as a fraction of the contrast.
const LEVEL_DEVIATION: f64 = 0.02;

/// Sections up to this distance from a run (mm) give the level of the lumen on that side.
const LEVEL_REACH_MM: f64 = 10.0;

/// Maximum length of a throat (mm). Contrast medium that fades over a longer part is no stenosis.
const LONGEST_MM: f64 = 30.0;

/// Number of circles within the outline on which values are read, and every how many rays.
const READ: (usize, usize) = (8, 2);

/// Weights of the section before, of the section itself and of the next one, if they are near enough (mm).
const SMOOTHED: ([f64; 3], f64) = ([0.25, 0.5, 0.25], 0.75);

/// Minimum diameter (blur widths) that noise lets a throat show.
const LEAST_WIDTH: f64 = 0.3;

/// The sections of a vessel, and the levels that decide how wide a dim lumen can be (fractions of the contrast).
pub(crate) struct Throats<'a, 'b, 'v> {
    pub bench: &'a Bench<'b, 'v>,
    pub places: &'a [SectionPlane],
    /// Pooled level of the lumen at each section.
    pub lumen: &'a [f64],
    pub noise: f64,
}

/// Part of a vessel between two clear sections.
struct Run {
    from: usize,
    to: usize,
    /// Level of the lumen before and after the run.
    levels: [f64; 2],
    /// Peak on the side with the lower peaks; they are below the level where the vessel is narrow everywhere.
    peak: f64,
}

impl Run {
    fn dimmer(&self) -> f64 {
        self.levels[0].min(self.levels[1])
    }
}

impl Throats<'_, '_, '_> {
    /// Fits the sections in and beside a throat again: the lumen there has the level that it has on both sides. Without
    /// this, the fit takes the plaque for a dim lumen.
    pub(crate) fn refit(
        &self,
        sections: &mut [Section],
        section: impl Fn(usize, Level) -> Result<Section>,
    ) -> Result<()> {
        for run in self.throats(sections) {
            let [from, to] = [self.places[run.from].at, self.places[run.to].at];
            for n in 0..sections.len() {
                let at = self.places[n].at;
                if at < from - REFITTED_MM || at > to + REFITTED_MM {
                    continue;
                }
                let share = ((at - from) / (to - from)).clamp(0.0, 1.0);
                let level = run.levels[0] + share * (run.levels[1] - run.levels[0]);
                sections[n] = section(n, [level, LEVEL_DEVIATION])?;
            }
        }
        Ok(())
    }

    /// Replaces sections that the peak of a dim lumen refutes by the diameter that it allows ([`Section::at_most`]).
    pub(crate) fn limit(&self, sections: &mut [Section]) {
        let mut limited = Vec::new();
        for run in self.throats(sections) {
            for n in run.from + 1..run.to {
                let Some(most) = self.most(&run, sections, n) else { continue };
                let section = &sections[n];
                let is_sure = |fit: &Fit| {
                    fit.lumen[0] >= DIM * run.dimmer() && fit.ellipse.equivalent_diameter() <= most
                };
                if section.flags & LEFT_OUT != 0 || !section.fit.as_ref().is_some_and(is_sure) {
                    let flags = section.flags | NO_EDGE;
                    limited.push((n, Section { flags, at_most: most, ..Section::none() }));
                }
            }
        }
        for (n, section) in limited {
            sections[n] = section;
        }
    }

    fn is_clear(&self, n: usize, section: &Section) -> bool {
        let is_bright = |level: f64| level >= DIM * self.lumen[n];
        section.flags & LEFT_OUT == 0 && section.fit.is_some_and(|fit| is_bright(fit.lumen[0]))
    }

    /// Runs with a section whose peak is far below the level beside the run.
    fn throats(&self, sections: &[Section]) -> Vec<Run> {
        let is_low = |run: &Run, n: usize| {
            let peak = self.share(run, run.peak).min(1.0);
            self.peak_in(run, sections, n)
                .is_some_and(|here| self.share(run, here + self.noise) < THROAT * peak)
        };
        let mut runs = self.runs(sections);
        runs.retain(|run| (run.from + 1..run.to).any(|n| is_low(run, n)));
        runs
    }

    fn runs(&self, sections: &[Section]) -> Vec<Run> {
        let clear: Vec<usize> = (0..sections.len()).filter(|n| self.is_clear(*n, &sections[*n])).collect();
        let at = |n: usize| self.places[n].at;
        let run = |two: &[usize]| {
            let (from, to) = (two[0], two[1]);
            if to == from + 1 || at(to) - at(from) > LONGEST_MM {
                return None;
            }
            let beside = |is_beside: &dyn Fn(f64) -> bool| {
                let fits = clear.iter().filter(|n| is_beside(at(**n)));
                let fits: Vec<(usize, Fit)> =
                    fits.filter_map(|n| sections[*n].fit.map(|fit| (*n, fit))).collect();
                let mut levels: Vec<f64> = fits.iter().map(|(_, fit)| fit.lumen[0]).collect();
                let mut peaks: Vec<f64> =
                    fits.iter().filter_map(|(n, fit)| self.peak(*n, &fit.ellipse)).collect();
                median(&mut levels).zip(median(&mut peaks))
            };
            let before = beside(&|there| there <= at(from) && there >= at(from) - LEVEL_REACH_MM)?;
            let after = beside(&|there| there >= at(to) && there <= at(to) + LEVEL_REACH_MM)?;
            Some(Run { from, to, levels: [before.0, after.0], peak: before.1.min(after.1) })
        };
        clear.windows(2).filter_map(run).collect()
    }

    /// Largest diameter (mm) that the values in section `n` of a run allow; None if the lumen there is not dim.
    fn most(&self, run: &Run, sections: &[Section], n: usize) -> Option<f64> {
        let peak = self.peak_in(run, sections, n)? + self.noise;
        let share = Some(self.share(run, peak)).filter(|share| *share < DIM)?;
        // A wider point spread lets a wider lumen be as dim.
        let wider = self.bench.doubt.as_ref().and_then(|doubt| doubt.wider);
        let blur = wider.unwrap_or(self.bench.blur).interpolated(&self.places[n]);
        let width = fwhm_of(blur.determinant().sqrt());
        Some(width * (-(1.0 - share).log2()).max(LEAST_WIDTH.powi(2)).sqrt())
    }

    /// A value as a fraction: 0 is the level of dark plaque, 1 that of the lumen beside the run.
    fn share(&self, run: &Run, value: f64) -> f64 {
        let plaque = self.bench.wall.map_or(0.0, |wall| wall.level[0] - wall.level[1]);
        (value - plaque) / (run.dimmer() - plaque)
    }

    /// Brightest value in section `n` of a run, within the outline that the clear sections at its ends let expect.
    fn peak_in(&self, run: &Run, sections: &[Section], n: usize) -> Option<f64> {
        let ends = [&sections[run.from], &sections[run.to]].map(|section| section.fit.map(|fit| fit.ellipse));
        let [Some(before), Some(after)] = ends else { return None };
        let [from, to] = [run.from, run.to].map(|end| self.places[end].at);
        self.peak(n, &before.towards(&after, (self.places[n].at - from) / (to - from)))
    }

    /// Brightest value of a section within an outline.
    fn peak(&self, n: usize, outline: &Ellipse) -> Option<f64> {
        let radius = outline.semi_axes()[1];
        let mut points = vec![outline.center];
        for circle in 1..=READ.0 {
            let away = radius * circle as f64 / READ.0 as f64;
            points.extend((0..RAYS).step_by(READ.1).map(|ray| outline.center + direction(ray) * away));
        }
        let values = points.into_iter().map(|point| self.smoothed(n, point));
        values.filter(|value| value.is_finite()).reduce(f64::max)
    }

    fn smoothed(&self, n: usize, point: DVec2) -> f64 {
        let (weights, near) = SMOOTHED;
        let others = [n.checked_sub(1), Some(n), Some(n + 1).filter(|next| *next < self.places.len())];
        let (mut sum, mut all) = (0.0, 0.0);
        for (other, weight) in others.into_iter().zip(weights) {
            let Some(other) = other else { continue };
            if (self.places[other].at - self.places[n].at).abs() <= near {
                sum += weight * self.bench.rays.at(&self.places[other], point);
                all += weight;
            }
        }
        sum / all
    }
}
