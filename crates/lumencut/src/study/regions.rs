//! For each body region: the look (group of settings), window and slab with which readers usually view it.

use lumencut_core::named::Named;
use lumencut_core::settings::{ContextName, Focus, LOOKS, Slab, SlabMode, Value};
use serde::Serialize;
use serde_json::{Map, Value as Json};

use crate::study::settings::settings_of_a_look;

struct Region {
    name: &'static str,
    words: &'static str,
    sentence: &'static str,
    look: &'static str,
    /// Settings that are not those of the look.
    more: fn() -> Vec<(&'static str, Value)>,
    /// Names of the windows for Hounsfield units and for other units.
    presets: [&'static str; 2],
}

/// For heavily calcified vessels the window is at least 1500 HU wide, so that calcium does not hide the lumen (Fleischmann et al.
/// 2006, doi:10.1097/01.RVI.0000191361.02857.DE, leg arteries). For coronary arteries a 5 mm slab is usual (SCCT, Leipsic et al.
/// 2014, doi:10.1016/j.jcct.2014.07.003). The other values are our choice.
const REGIONS: [Region; 6] = [
    Region {
        name: "aorta",
        words: "Aorta",
        sentence: "the cut around the vessels within the shaded body, in the CT angiography window",
        look: "focus",
        more: Vec::new,
        presets: ["cta", "mra"],
    },
    Region {
        name: "carotid",
        words: "Carotid",
        sentence: "the cut through the middle of every vessel, in the CT angiography window",
        look: "lumen",
        more: Vec::new,
        presets: ["cta", "mra"],
    },
    Region {
        name: "runoff",
        words: "Run-off",
        sentence: "the largest value within 10 mm around the cut, in a wide window: calcium does not hide the lumen",
        look: "slab",
        more: Vec::new,
        presets: ["stent", "mra"],
    },
    Region {
        name: "coronary",
        words: "Coronary",
        sentence: "the largest value within 5 mm around the cut, in the CT angiography window",
        look: "slab",
        more: thin_slab,
        presets: ["cta", "mra"],
    },
    Region {
        name: "tof",
        words: "TOF",
        sentence: "for time-of-flight MR: the largest value along each ray, in the MR angiography window",
        look: "mip",
        more: Vec::new,
        presets: ["mra", "mra"],
    },
    Region {
        name: "airways",
        words: "Airways",
        sentence: "the cut around dark lumens amid the smallest value along each ray, in the lung window",
        look: "lumen",
        more: amid_minima,
        presets: ["lung", "auto"],
    },
];

fn thin_slab() -> Vec<(&'static str, Value)> {
    vec![("slab", Value::Slab(Slab { thickness: 5.0, mode: SlabMode::Max }))]
}

fn amid_minima() -> Vec<(&'static str, Value)> {
    vec![
        ("focus", Value::Focus(Focus::default())),
        ("context", Value::Name(ContextName::Minip.name().to_owned())),
    ]
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct RegionRow {
    pub name: &'static str,
    pub words: &'static str,
    pub sentence: &'static str,
    /// Values of all settings that any look sets.
    #[cfg_attr(test, ts(type = "Settings"))]
    pub settings: Map<String, Json>,
    /// Window name for Hounsfield units.
    pub(crate) preset: &'static str,
    /// Window name for other units.
    pub(crate) preset_of_other_units: &'static str,
}

pub(crate) fn regions() -> Vec<RegionRow> {
    REGIONS.iter().map(row).collect()
}

fn row(region: &Region) -> RegionRow {
    let look = LOOKS.iter().find(|look| look.name == region.look);
    let mut chosen = look.map_or_else(Vec::new, |look| (look.values)());
    let more = (region.more)();
    chosen.retain(|(name, _)| more.iter().all(|(own, _)| own != name));
    chosen.extend(more);
    let [preset, preset_of_other_units] = region.presets;
    RegionRow {
        name: region.name,
        words: region.words,
        sentence: region.sentence,
        settings: settings_of_a_look(&chosen),
        preset,
        preset_of_other_units,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::study::settings::looks;
    use crate::window_presets::WINDOW_PRESETS;

    #[test]
    fn every_region_has_a_look_and_windows_that_there_are() {
        for region in &REGIONS {
            assert!(LOOKS.iter().any(|look| look.name == region.look), "{}", region.look);
            assert!(
                region.presets.iter().all(|name| WINDOW_PRESETS.iter().any(|preset| preset.name == *name))
            );
        }
    }

    #[test]
    fn a_region_chooses_what_its_look_chooses_and_a_slab_of_its_own() {
        let (regions, looks) = (regions(), looks());
        let settings = |name: &str| &regions.iter().find(|one| one.name == name).expect("a region").settings;
        assert!(regions.iter().all(|one| one.settings.keys().eq(looks[0].settings.keys())));
        assert_eq!(settings("aorta"), &looks.iter().find(|look| look.name == "focus").expect("one").settings);
        assert_eq!(settings("coronary")["slab"], json!([5.0, "max"]));
        assert_eq!(settings("runoff")["slab"], json!([10.0, "max"]));
        assert_eq!(settings("tof")["context"], json!("mip"));
    }
}
