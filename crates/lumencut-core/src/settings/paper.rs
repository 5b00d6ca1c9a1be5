//! The settings that select the paper's rules.

use super::rules::{LevelChoice, SilhouetteRule};
use super::table::Settings;
use super::value::Value;

impl Settings {
    /// The paper's rules, with the defaults of all other settings.
    pub fn paper() -> Self {
        Self {
            lumen_first: false,
            lumen_margin: 0.0,
            level_choice: LevelChoice::Nearest,
            zone_filter: false,
            silhouette_rule: SilhouetteRule::Gradient,
            silhouette_reach: None,
            ..Self::default()
        }
    }

    /// The settings in which [`Settings::paper`] differs from the defaults, with the paper's values.
    pub fn paper_values() -> Vec<(&'static str, Value)> {
        let defaults = Self::default().values();
        Self::paper()
            .values()
            .into_iter()
            .zip(defaults)
            .filter(|(paper, own)| paper != own)
            .map(|(paper, _)| paper)
            .collect()
    }
}
