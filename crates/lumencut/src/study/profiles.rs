//! The profiles that are kept, by their lines.
//!
//! The tree tells the point spread and where branches are. So a profile holds for the lines that were shown when it was measured:
//! once other ones are shown, or the same in another order, all profiles are forgotten, and measured anew when they are asked
//! for. They are also forgotten with the volume. Names do not matter.

use std::collections::HashMap;

use lumencut_core::stop::Stop;
use lumencut_vessels::measure::measuring::{Request, STEP, measure_under, point_spread_of};
use lumencut_vessels::measure::profile::{Profile, Source};

use crate::study::content::Content;
use crate::study::failure::{Failure, Result};
use crate::study::held_volume::HeldVolume;
use crate::study::lines::wrong;

/// The profiles that are kept.
#[derive(Default)]
pub struct Profiles {
    /// The lines that were shown when they were measured.
    shown: Vec<usize>,
    /// The point spread that these tell, for all of them.
    told: Option<(f64, Source)>,
    kept: Vec<Kept>,
    /// The width of the point spread that each line was asked for with last.
    widths: HashMap<usize, Option<f64>>,
}

/// A profile of a line, and the width of the point spread (mm) that it was asked for with.
struct Kept {
    line: usize,
    fwhm: Option<f64>,
    profile: Profile,
}

impl Profiles {
    /// The number among those kept of a line's profile, measured where it is not there.
    ///
    /// # Errors
    /// `vessel tree` for a line that is not shown, `volume` where none is open, and those of measuring.
    pub fn of(&mut self, content: &Content, line: usize, asking: &Asking) -> Result<usize> {
        let shown = content.named.as_ref().map_or(&[][..], |named| &named.lines[..]);
        if self.shown != shown {
            self.kept.clear();
            self.told = None;
            self.shown = shown.to_vec();
        }
        let found = self.kept.iter().position(|kept| kept.line == line && kept.fwhm == asking.fwhm);
        if let Some(found) = found {
            return Ok(found);
        }
        let profile = self.measured(content, line, asking)?;
        self.kept.push(Kept { line, fwhm: asking.fwhm, profile });
        Ok(self.kept.len() - 1)
    }

    /// The profile of a line among those that are shown.
    fn measured(
        &mut self,
        content: &Content,
        line: usize,
        &Asking { fwhm, stop }: &Asking,
    ) -> Result<Profile> {
        let volume = content.held.as_ref().map(HeldVolume::volume).transpose()?.ok_or_else(no_volume)?;
        let named = content.named.as_ref().ok_or_else(|| not_shown(line))?;
        let tree = named.leveled.tree().vessels();
        let number = named.lines.iter().position(|own| *own == line).ok_or_else(|| not_shown(line))?;
        let request = Request { step: STEP, fwhm, tree, stop };
        let spread = match (fwhm, &self.told) {
            (None, Some(told)) => told.clone(),
            _ => point_spread_of(&volume, &request)?,
        };
        if fwhm.is_none() {
            self.told = Some(spread.clone());
        }
        Ok(measure_under(spread, &volume, &tree[number], &request)?)
    }

    /// The profile of a number that [`Profiles::of`] gave last.
    pub fn kept(&self, number: usize) -> &Profile {
        &self.kept[number].profile
    }

    /// A profile of a line, if any is kept; its planes do not depend on the point spread.
    pub fn any_of(&self, line: usize) -> Option<&Profile> {
        self.kept.iter().find(|kept| kept.line == line).map(|kept| &kept.profile)
    }

    /// From now on a line is asked for with this width of the point spread (mm), or the one that the tree tells.
    pub fn ask_with(&mut self, line: usize, fwhm: Option<f64>) {
        self.widths.insert(line, fwhm);
    }

    /// The width (mm) that a line was asked for with last.
    pub fn width(&self, line: usize) -> Option<f64> {
        self.widths.get(&line).copied().flatten()
    }
}

/// How a line is asked for: the width of the point spread (mm), where it is given, and a way to stop.
pub struct Asking<'a> {
    /// The width (mm).
    pub fwhm: Option<f64>,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}

fn no_volume() -> Failure {
    Failure { kind: "volume", ..Failure::of_message("volume", &"none", "one that is open") }
}

fn not_shown(line: usize) -> Failure {
    wrong("number", line.to_string(), "one of the lines that are shown").into()
}
