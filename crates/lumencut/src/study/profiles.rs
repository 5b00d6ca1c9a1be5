//! Caches the profiles of vessels by the number of the line. Point spread and branches are determined from all listed
//! vessels, hidden ones included, so hiding a vessel changes no number. Profiles are valid only for one list of
//! vessels in one order, and are discarded with the volume. Names of vessels do not matter.

use std::collections::HashMap;

use lumencut_core::stop::Stop;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::by_hand::Outline;
use lumencut_vessels::measure::profile::measuring::STEP;
use lumencut_vessels::measure::wall::WallRequest;

use crate::kept_profiles::{self, KeptProfiles, Scan};
use crate::study::content::{Content, NamedTree};
use crate::study::failure::Result;
use crate::study::held_volume::{HeldVolume, no_volume};
use crate::study::lines::wrong;

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ByHand {
    pub(crate) outlines: Vec<Outline>,
    /// Arc lengths (mm) of the ends of the stretches of the line that were moved.
    pub(crate) stretches: Vec<[f64; 2]>,
}

#[derive(Default)]
pub(crate) struct Profiles {
    listed: Vec<usize>,
    kept: KeptProfiles<usize>,
    /// The last requested point-spread width of each line.
    widths: HashMap<usize, Option<f64>>,
    by_hand: Vec<(usize, ByHand)>,
    /// The profiles with it, by cache index.
    drawn: Vec<(usize, Profile)>,
}

impl Profiles {
    /// The cache index of a line's profile. The line is measured if necessary.
    pub(crate) fn of(
        &mut self,
        content: &Content,
        line: usize,
        parameters: &ProfileParameters,
    ) -> Result<usize> {
        let (listed, tree) = content.named.as_ref().map_or((&[][..], &[][..]), NamedTree::measured_among);
        if self.listed != listed {
            self.kept = KeptProfiles::default();
            self.drawn.clear();
            self.listed = listed.to_vec();
        }
        let volume = &content.held.as_ref().map(HeldVolume::volume).transpose()?.ok_or_else(no_volume)?;
        let number = listed.iter().position(|own| *own == line);
        let not_shown = || wrong("number", line.to_string(), "one of the lines that are shown");
        let number = number.ok_or_else(not_shown)?;
        let parameters = kept_profiles::MeasureParameters {
            step: STEP,
            fwhm: parameters.fwhm,
            wall: WallRequest::Automatic,
            stop: parameters.stop,
        };
        let number = self.kept.of(line, &tree[number], Scan { volume, tree }, &parameters)?;
        let by_hand = self.by_hand.iter().find(|(own, _)| *own == line);
        if let Some((_, made)) = by_hand.filter(|_| self.drawn.iter().all(|(own, _)| *own != number)) {
            let side = volume.world_from_index().matrix3.determinant().abs().cbrt();
            let drawn = self.kept.kept(number).drawn(&made.outlines, side);
            self.drawn.push((number, drawn.with_line_by_hand(&made.stretches)));
        }
        Ok(number)
    }

    pub(crate) fn draw(&mut self, line: usize, made: ByHand) {
        let known = self.by_hand.iter().position(|(own, _)| *own == line);
        if known.map_or(made == ByHand::default(), |known| self.by_hand[known].1 == made) {
            return;
        }
        self.by_hand.retain(|(own, _)| *own != line);
        self.by_hand.push((line, made));
        self.drawn.clear();
    }

    /// The profile at an index that [`Profiles::of`] returned last.
    pub(crate) fn kept(&self, number: usize) -> &Profile {
        let drawn = self.drawn.iter().find(|(own, _)| *own == number);
        drawn.map_or_else(|| &**self.kept.kept(number), |(_, profile)| profile)
    }

    /// Any cached profile of a line. The planes of its sections do not depend on the point spread.
    pub(crate) fn any_of(&self, line: usize) -> Option<&Profile> {
        self.kept.any_of(&line)
    }

    /// The profile of a line that was measured last, with what was drawn by hand.
    pub(crate) fn last_of(&self, line: usize) -> Option<&Profile> {
        self.kept.last_of(&line).map(|number| self.kept(number))
    }

    /// Stores the point-spread width (mm) requested for a line; None estimates it from the tree.
    pub(crate) fn ask_with(&mut self, line: usize, fwhm: Option<f64>) {
        self.widths.insert(line, fwhm);
    }

    /// The last requested width (mm); None estimates it.
    pub(crate) fn width(&self, line: usize) -> Option<f64> {
        self.widths.get(&line).copied().flatten()
    }
}

pub(crate) struct ProfileParameters<'a> {
    /// Point-spread width (mm), if given.
    pub fwhm: Option<f64>,
    pub stop: Stop<'a>,
}
