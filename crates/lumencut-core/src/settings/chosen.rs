//! Settings that exclude each other, and the effect of chosen vessels, which take precedence over all others.

use std::borrow::Cow;

use super::rules::DistanceRule;
use super::table::Settings;
use crate::error::{Error, ErrorKind, Result};

impl Settings {
    /// These settings for `count` vessels: if some are chosen, silhouettes are drawn; if all are, the choice
    /// is dropped. Fails with [`ErrorKind::Settings`] for the id of a missing vessel.
    pub(crate) fn for_vessels(&self, count: usize) -> Result<Cow<'_, Self>> {
        let chosen = &self.focus_vessels;
        if let Some(id) = chosen.iter().find(|id| **id >= count) {
            let found = format!("vessel {id} in a tree of {count}");
            let expected = format!("ids from 0 to {}", count.saturating_sub(1));
            return Err(Error::new(ErrorKind::Settings, "focus_vessels", found, expected));
        }
        if chosen.is_empty() {
            return Ok(Cow::Borrowed(self));
        }
        if (0..count).all(|id| chosen.contains(&id)) {
            return Ok(Cow::Owned(Self { focus_vessels: Vec::new(), ..self.clone() }));
        }
        Ok(Cow::Owned(Self { silhouettes: true, ..self.clone() }))
    }

    /// The name of the setting that highlights vessels, their walls or surroundings, and words for it.
    pub fn focused(&self) -> Option<(&'static str, &'static str)> {
        let chosen = (!self.focus_vessels.is_empty()).then_some(("focus_vessels", "chosen vessels"));
        let rim = self.rim.map(|_| ("rim", "a rim"));
        self.focus.map(|_| ("focus", "a focus")).or(chosen).or(rim)
    }

    /// Rejects chosen vessels without `lumen_first`, since lumen and wall then have no tiers.
    pub(super) fn check_together(&self) -> Result<()> {
        if self.distance_rule == DistanceRule::WholeCurve && self.lumen_first {
            let found = "the whole curve with lumen_first";
            return Err(Error::new(ErrorKind::Settings, "distance_rule", found, "the cost of the paper")
                .mend("use the paper's rules, or set lumen_first to False"));
        }
        if self.rim.is_some() && !self.preserve_lumen {
            let found = "a rim without preserve_lumen";
            return Err(Error::new(
                ErrorKind::Settings,
                "rim",
                found,
                "radii that count, at which the rim lies",
            )
            .mend("set preserve_lumen, or leave the rim out"));
        }
        if let (Some(low), Some(high)) = (self.rim_low, self.rim_high)
            && low >= high
        {
            let found = format!("{low} to {high}");
            return Err(Error::new(
                ErrorKind::Settings,
                "colours of the rim",
                found,
                "rim_low below rim_high",
            ));
        }
        if self.focus_vessels.is_empty() || self.lumen_first {
            return Ok(());
        }
        let found = "chosen vessels without lumen_first";
        let expected = "lumen_first, which chosen vessels need";
        Err(Error::new(ErrorKind::Settings, "focus_vessels", found, expected)
            .mend("set lumen_first, or choose no vessels"))
    }
}
