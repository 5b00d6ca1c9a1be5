use super::*;

#[test]
fn each_context_has_its_window() {
    let names = |has_tree| {
        ContextName::NAMES.iter().map(move |(_, context)| DataWindow::of_context(*context, has_tree).name())
    };
    assert!(names(true).eq(["auto", "auto", "auto", "whole", "whole"]));
    assert!(names(false).eq(["auto", "auto", "mip", "whole", "whole"]));
}

#[test]
fn presets_have_names_of_their_own_and_those_of_fixed_values_can_be_windows() {
    for (number, preset) in WINDOW_PRESETS.iter().enumerate() {
        assert!(
            WINDOW_PRESETS[..number]
                .iter()
                .all(|other| other.name != preset.name && other.words != preset.words)
        );
        match preset.source {
            PresetSource::Fixed(window) => assert!(window.width > 0.0),
            PresetSource::Data(window) => assert_eq!(window.name(), preset.name),
        }
    }
}
