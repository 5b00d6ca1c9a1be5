//! The table of settings, and settings chosen by name.
#![allow(clippy::unwrap_used)]

use std::collections::HashSet;

use lumencut_core::named::Named;
use lumencut_core::settings::{
    Choices, Context, ContextMode, ContextName, ControlPoint, Kind, Opacity, Preset, Settings, Slab,
    SlabMode, TransferFunction, Value, Window, table,
};

fn chosen(given: &[(&str, Value)]) -> Result<Settings, String> {
    let mut choices = Choices::default();
    for (name, value) in given {
        choices.set(name, value.clone()).map_err(|error| error.to_string())?;
    }
    choices.settings().map_err(|error| error.to_string())
}

fn name(name: &str) -> Value {
    Value::Name(name.to_owned())
}

#[test]
fn nothing_chosen_is_the_default() {
    assert_eq!(chosen(&[]), Ok(Settings::default()));
    for setting in table() {
        assert_eq!(chosen(&[(setting.name, setting.default())]), Ok(Settings::default()), "{}", setting.name);
    }
}

#[test]
fn every_setting_is_explained() {
    let names: HashSet<_> = table().map(|setting| setting.name).collect();
    assert_eq!(names.len(), table().count());
    for setting in table() {
        let sentence = setting.sentence();
        assert!(sentence.ends_with('.') && !sentence.contains('\n'), "{sentence}");
        let is_a_number = matches!(setting.kind, Kind::Number | Kind::Count);
        assert_eq!(setting.limits.is_some(), is_a_number, "{}", setting.name);
        if let (Kind::Count, Some(limits)) = (setting.kind, setting.limits) {
            assert!(sentence.contains(&format!("{} to {}", limits.low, limits.high)), "{sentence}");
        }
        let is_open = setting.optional && setting.default() == Value::None;
        assert_eq!(setting.open.is_some(), is_open, "{}", setting.name);
    }
    let transfer = table().find(|setting| setting.kind == Kind::Transfer).unwrap();
    assert!(transfer.sentence().contains(&Preset::names().join(", ")));
}

#[test]
fn values_end_in_their_settings() {
    let opacity = Opacity { transparent: 1.0, opaque: 2.0 };
    let slab = Slab { thickness: 4.0, mode: SlabMode::Mean };
    let window = Window { level: 40.0, width: 400.0 };
    let found = chosen(&[
        ("lumen_first", Value::Flag(true)),
        ("cost_weight", Value::Number(3.0)),
        ("levels", Value::Count(2)),
        ("background", Value::Color(vec![1, 2, 3, 4])),
        ("window", Value::Window(window)),
        ("opacity", Value::Opacity(opacity)),
        ("slab", Value::Slab(slab)),
        ("context_step", Value::Number(0.5)),
        ("context_transfer", name("bone")),
        ("context_window", Value::Window(window)),
    ]);
    let expected = Settings {
        lumen_first: true,
        cost_weight: 3.0,
        levels: 2,
        background: [1, 2, 3, 4],
        window,
        opacity: Some(opacity),
        slab: Some(slab),
        context: Some(Context {
            step: Some(0.5),
            transfer: Preset::Bone.transfer_function(window),
            window,
            ..Context::default()
        }),
        ..Settings::default()
    };
    assert_eq!(found, Ok(expected));
    assert_eq!(chosen(&[("context", Value::None)]).unwrap().context, None);
}

#[test]
fn the_context_that_is_not_wanted_is_checked_too() {
    let message = "context_step: found 0; expected between 0.001 and 1000 mm";
    let given = [("context", Value::None), ("context_step", Value::Number(0.0))];
    assert_eq!(chosen(&given), Err(message.to_owned()));
}

#[test]
fn gamma_is_that_of_mida() {
    let gamma = Value::Number(0.5);
    let mida = chosen(&[("context_gamma", gamma.clone())]).unwrap();
    assert_eq!(mida.context.unwrap().mode, ContextMode::Blend { gamma: 0.5 });
    for other in ContextName::names().into_iter().skip(1) {
        for order in [[0, 1], [1, 0]] {
            let given = [("context_gamma", gamma.clone()), ("context", name(other))];
            let message = format!(
                "context_gamma: found 0.5 with the context '{other}'; expected 0, or the context 'mida', the only \
                 one that has a gamma"
            );
            assert_eq!(chosen(&order.map(|n| given[n].clone())), Err(message));
        }
    }
}

#[test]
fn a_step_is_for_contexts_with_samples_alone() {
    for (context, gamma) in [("mip", 0.0), ("minip", 0.0), ("average", 0.0), ("mida", 1.0)] {
        let numbers = [("context_gamma", Value::Number(gamma)), ("context_step", Value::Number(3.0))];
        let given = [numbers.to_vec(), vec![("context", name(context))]].concat();
        let message = chosen(&given).unwrap_err();
        let start = format!("context_step: found 3 mm with the context '{context}'; expected no step: ");
        assert!(message.starts_with(&start), "{message}");
    }
}

#[test]
fn a_maximum_is_grey_unless_chosen_otherwise() {
    for (context, preset) in [("mip", Preset::Grey), ("dvr", Preset::Angio), ("mida", Preset::Angio)] {
        let found = chosen(&[("context", name(context))]).unwrap().context.unwrap();
        assert_eq!(found.transfer, preset.transfer_function(Window::default()), "{context}");
    }
    let points = vec![ControlPoint { intensity: 1.0, color: [1, 2, 3], opacity: 0.5 }];
    let function = TransferFunction { points };
    let given = [("context", name("mip")), ("context_transfer", Value::Transfer(function.clone()))];
    assert_eq!(chosen(&given).unwrap().context.unwrap().transfer, function);
}

#[test]
fn what_is_no_setting_or_no_value_of_it_is_refused_by_name() {
    let error = |given: (&str, Value)| chosen(&[given]).unwrap_err();
    let unknown = error(("sharpness", Value::None));
    assert!(unknown.starts_with("name of a setting: found 'sharpness'; expected cost_weight, "), "{unknown}");
    assert_eq!(
        error(("context", name("xray"))),
        "context: found 'xray'; expected one of 'mida', 'dvr', 'mip', 'minip', 'average'"
    );
    for setting in table() {
        // No setting takes a colour of five channels.
        let message = error((setting.name, Value::Color(vec![0; 5])));
        let start = format!("{}: found Color([0, 0, 0, 0, 0]); expected a value of the kind ", setting.name);
        assert_eq!(message, format!("{start}{}", setting.kind.name()));
    }
}
