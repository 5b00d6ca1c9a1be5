//! The profiles that are kept, by their lines.
//!
//! The vessels of a list tell the point spread and where branches are, also those of them that are hidden: hiding a vessel changes no
//! number. So a profile holds for the list that it was measured among: with other lines, or the same in another order, all
//! profiles are forgotten, and measured anew when they are asked for. They are also forgotten with the volume. Names do not matter.

use std::collections::HashMap;

use lumencut_core::stop::Stop;
use lumencut_vessels::measure::measuring::STEP;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::wall_level::WallRequest;

use crate::kept_profiles::{self, KeptProfiles, Scan};
use crate::study::content::{Content, NamedTree};
use crate::study::failure::Result;
use crate::study::held_volume::{HeldVolume, no_volume};
use crate::study::lines::wrong;

/// The profiles that are kept, and how they were asked for.
#[derive(Default)]
pub(crate) struct Profiles {
    /// The lines that they were measured among.
    listed: Vec<usize>,
    kept: KeptProfiles<usize>,
    /// The width of the point spread that each line was asked for with last.
    widths: HashMap<usize, Option<f64>>,
}

impl Profiles {
    /// The number among those kept of a line's profile, measured where it is not there.
    ///
    /// # Errors
    /// `vessel tree` for a line that is not shown, `volume` where none is open, and those of measuring.
    pub(crate) fn of(&mut self, content: &Content, line: usize, asking: &Asking) -> Result<usize> {
        let (listed, tree) = content.named.as_ref().map_or((&[][..], &[][..]), NamedTree::measured_among);
        if self.listed != listed {
            self.kept = KeptProfiles::default();
            self.listed = listed.to_vec();
        }
        let volume = &content.held.as_ref().map(HeldVolume::volume).transpose()?.ok_or_else(no_volume)?;
        let number = listed.iter().position(|own| *own == line);
        let not_shown = || wrong("number", line.to_string(), "one of the lines that are shown");
        let number = number.ok_or_else(not_shown)?;
        let asking = kept_profiles::Asking {
            step: STEP,
            fwhm: asking.fwhm,
            wall: WallRequest::Automatic,
            stop: asking.stop,
        };
        Ok(self.kept.of(line, &tree[number], Scan { volume, tree }, &asking)?)
    }

    /// The profile of a number that [`Profiles::of`] gave last.
    pub(crate) fn kept(&self, number: usize) -> &Profile {
        self.kept.kept(number)
    }

    /// A profile of a line, if any is kept; its planes do not depend on the point spread.
    pub(crate) fn any_of(&self, line: usize) -> Option<&Profile> {
        self.kept.any_of(&line)
    }

    /// From now on a line is asked for with this width of the point spread (mm), or the one that the tree tells.
    pub(crate) fn ask_with(&mut self, line: usize, fwhm: Option<f64>) {
        self.widths.insert(line, fwhm);
    }

    /// The width (mm) that a line was asked for with last.
    pub(crate) fn width(&self, line: usize) -> Option<f64> {
        self.widths.get(&line).copied().flatten()
    }
}

/// How a line is asked for: the width of the point spread (mm), where it is given, and a way to stop.
pub(crate) struct Asking<'a> {
    /// The width (mm).
    pub fwhm: Option<f64>,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}
