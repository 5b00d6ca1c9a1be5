//! Converts settings from and to JSON. Their names are those of the table in the core.

use lumencut_core::named::Named;
use lumencut_core::settings::{
    Choices, ControlPoint, Focus, Kind, LOOKS, Look, Preset, Setting, Settings, Slab, SlabMode,
    TransferFunction, Value, Window, table,
};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::study::failure::{Failure, Result};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct SettingRow {
    name: &'static str,
    kind: &'static str,
    optional: bool,
    #[cfg_attr(test, ts(type = "SettingValue"))]
    default: Json,
    low: Option<f64>,
    high: Option<f64>,
    /// The unit, if the value is a number with a unit.
    unit: Option<&'static str>,
    choices: Vec<&'static str>,
    /// What the setting means if it is unset, for settings that are unset by default.
    open: Option<&'static str>,
    sentence: String,
}

pub(super) fn rows() -> Vec<SettingRow> {
    let row = |setting: &Setting| SettingRow {
        name: setting.name,
        kind: setting.kind.name(),
        optional: setting.optional,
        default: json_of(setting.default()),
        low: setting.limits.map(|limits| limits.low),
        high: setting.limits.map(|limits| limits.high),
        unit: setting.limits.map(|limits| limits.unit),
        choices: setting.choices(),
        open: setting.open,
        sentence: setting.sentence(),
    };
    table().map(row).collect()
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LookRow {
    /// Name in Python and on the command line.
    pub name: &'static str,
    words: &'static str,
    sentence: &'static str,
    /// The values of all settings that any look sets; the default if this look does not set one.
    #[cfg_attr(test, ts(type = "Settings"))]
    pub settings: Map<String, Json>,
}

pub(crate) fn looks() -> Vec<LookRow> {
    let row = |look: &Look| {
        let settings = settings_of_a_look(&(look.values)());
        LookRow { name: look.name, words: look.words, sentence: look.sentence, settings }
    };
    LOOKS.iter().map(row).collect()
}

/// The values of all settings that any look sets: the chosen value, else the default.
pub(crate) fn settings_of_a_look(chosen: &[(&'static str, Value)]) -> Map<String, Json> {
    let value = |setting: &Setting| {
        let own = chosen.iter().find(|(name, _)| *name == setting.name);
        json_of(own.map_or_else(|| setting.default(), |(_, value)| value.clone()))
    };
    let chosen_by_some = table().filter(|setting| is_chosen_by_a_look(setting.name));
    chosen_by_some.map(|setting| (setting.name.to_owned(), value(setting))).collect()
}

fn is_chosen_by_a_look(name: &str) -> bool {
    LOOKS.iter().any(|look| (look.values)().iter().any(|(chosen, _)| *chosen == name))
}

fn json_of(value: Value) -> Json {
    match value {
        Value::Flag(flag) => flag.into(),
        Value::Number(number) => number.into(),
        Value::Count(count) => count.into(),
        Value::Color(channels) => channels.into(),
        Value::Name(name) => name.into(),
        Value::Focus(Focus { margin, fade }) => vec![margin, fade].into(),
        Value::Vessels(ids) => ids.into(),
        Value::Slab(Slab { thickness, mode }) => Json::Array(vec![thickness.into(), mode.name().into()]),
        Value::None | Value::Window(_) | Value::Opacity(_) | Value::Transfer(_) => Json::Null,
    }
}

/// Settings from names and values, applied after `first`; all other settings have their defaults.
pub(super) fn settings(first: Vec<(&str, Value)>, chosen: &Map<String, Json>) -> Result<Settings> {
    let mut choices = Choices::default();
    for (name, value) in first {
        choices.set(name, value)?;
    }
    for (name, value) in chosen {
        let setting = table().find(|setting| setting.name == name);
        let kind = setting.map_or(Kind::Flag, |setting| setting.kind);
        choices.set(name, self::value(name, kind, value)?)?;
    }
    Ok(choices.settings()?)
}

fn value(name: &str, kind: Kind, json: &Json) -> Result<Value> {
    if json.is_null() {
        return Ok(Value::None);
    }
    let read = match kind {
        Kind::Flag => json.as_bool().map(Value::Flag),
        Kind::Number => json.as_f64().map(Value::Number),
        Kind::Count => json.as_u64().and_then(|count| usize::try_from(count).ok()).map(Value::Count),
        Kind::Color(_) => serde_json::from_value(json.clone()).ok().map(Value::Color),
        Kind::Transfer if json.is_array() => points(json).map(Value::Transfer),
        Kind::Choice | Kind::Transfer => json.as_str().map(|name| Value::Name(name.to_owned())),
        Kind::Window => pair(json).map(|[level, width]| Value::Window(Window { level, width })),
        Kind::Slab => slab(json)?.map(Value::Slab),
        Kind::Focus => pair(json).map(|[margin, fade]| Value::Focus(Focus { margin, fade })),
        Kind::Vessels => serde_json::from_value(json.clone()).ok().map(Value::Vessels),
        Kind::Opacity => None,
    };
    read.ok_or_else(|| Failure::of_message(name, json, &format!("a value of the kind {}", kind.name())))
}

/// A transfer function, from its control points.
fn points(json: &Json) -> Option<TransferFunction> {
    let points: Vec<PointMessage> = serde_json::from_value(json.clone()).ok()?;
    let point = |PointMessage(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
    Some(TransferFunction { points: points.into_iter().map(point).collect() })
}

/// A control point of a transfer function: intensity (unit of the volume), colour (RGB) and opacity per mm.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ControlPoint"))]
pub(crate) struct PointMessage(f64, [u8; 3], f64);

/// The control points of a named transfer function in a window. Fails for an unknown name.
pub(crate) fn preset_points(name: &str, [level, width]: [f64; 2]) -> Result<Vec<PointMessage>> {
    let preset = Preset::named("context_transfer", name)?;
    let window = Window { level, width };
    let points = preset.transfer_function(window).points;
    Ok(points.iter().map(|point| PointMessage(point.intensity, point.color, point.opacity)).collect())
}

fn pair(json: &Json) -> Option<[f64; 2]> {
    serde_json::from_value(json.clone()).ok()
}

/// A slab, from thickness (mm) and mode.
fn slab(json: &Json) -> Result<Option<Slab>> {
    let Ok((thickness, mode)) = serde_json::from_value::<(f64, String)>(json.clone()) else {
        return Ok(None);
    };
    slab_of(thickness, &mode).map(Some)
}

pub(super) fn slab_of(thickness: f64, mode: &str) -> Result<Slab> {
    let slab = Slab { thickness, mode: SlabMode::named("slab mode", mode)? };
    slab.check()?;
    Ok(slab)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn of(json: &Json) -> Result<Settings> {
        settings(Vec::new(), json.as_object().expect("an object"))
    }

    #[test]
    fn names_and_values_become_settings() {
        let made =
            of(&json!({"levels": 3, "context": "mip", "window": [300.0, 900.0], "slab": [5.0, "max"], "focus": [1.0, 4.0]}))
                .expect("settings");
        assert_eq!((made.levels, made.window), (3, Window { level: 300.0, width: 900.0 }));
        assert_eq!(made.slab.map(|slab| slab.thickness), Some(5.0));
        assert_eq!(made.focus, Some(Focus { margin: 1.0, fade: 4.0 }));
        assert!(of(&json!({"context": null})).expect("settings").context.is_none());
    }

    #[test]
    fn control_points_are_read_and_checked() {
        let window = [300.0, 600.0];
        let angio = preset_points("angio", window).expect("a preset");
        let made = of(&json!({"context_transfer": angio, "context": "dvr"})).expect("settings");
        let same = json!({"context_transfer": "angio", "context": "dvr", "context_window": [300.0, 600.0]});
        assert_eq!(
            made.context.expect("dvr").transfer,
            of(&same).expect("settings").context.expect("dvr").transfer
        );
        assert!(preset_points("angia", window).is_err());
        for wrong in
            [json!([]), json!([[0.0, [1, 2, 300], 0.5]]), json!([[0.0, [1, 2, 3], 1.5]]), json!([[0.0]])]
        {
            let error = of(&json!({"context_transfer": wrong})).expect_err("wrong points");
            assert!(error.subject.ends_with("context_transfer"), "{}", error.subject);
        }
    }

    #[test]
    fn odd_values_are_refused_with_their_name() {
        assert_eq!(of(&json!({"levels": "three"})).expect_err("a text").subject, "levels");
        assert_eq!(of(&json!({"levels": 99})).expect_err("too many").kind, "settings");
        assert!(of(&json!({"no_such_setting": true})).is_err());
    }

    #[test]
    fn the_table_has_a_row_for_every_setting() {
        assert_eq!(rows().len(), table().count());
    }
    #[test]
    fn a_look_read_back_is_what_it_chooses_with_the_defaults_of_all_else() {
        for (row, look) in looks().iter().zip(&LOOKS) {
            let mut expected = Choices::default();
            for (name, value) in (look.values)() {
                expected.set(name, value).expect("a setting");
            }
            let chosen = of(&Json::Object(row.settings.clone())).expect("settings");
            assert_eq!(chosen, expected.settings().expect("settings"), "{}", row.name);
        }
    }

    #[test]
    fn looks_differ_and_name_the_same_settings() {
        let looks = looks();
        for (n, look) in looks.iter().enumerate() {
            assert!(look.settings.keys().eq(looks[0].settings.keys()));
            assert!(
                looks[..n].iter().all(|other| other.settings != look.settings && other.name != look.name)
            );
        }
        assert_eq!(of(&Json::Object(looks[0].settings.clone())).expect("settings"), Settings::default());
    }
}
