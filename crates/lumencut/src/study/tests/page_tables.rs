//! Generates `web/src/core/generated/tables.ts`, the tables of the facade that the page reads before the engine has started.

use lumencut_io::session_file::FIELD;

use super::generated::require_current;
use crate::defaults::{PIXEL_SIDES, QUANTITIES};
use crate::drags::GESTURES;
use crate::file_kinds::{Role, centerline_files, extensions, saved_by_the_page, volume_files};
use crate::report::chart::DEVIATIONS;
use crate::report::pictures::PAGE_PIXELS;
use crate::study::palette::PALETTE;
use crate::vessel_names::{NamedVessel, VESSEL_NAMES};

const HEAD: &str = "/** Tables of the facade, written from crates/lumencut by `make generate`. */\n";

fn table<T: serde::Serialize>(about: &str, name: &str, rows: &[T]) -> String {
    let rows: String = rows
        .iter()
        .map(|row| format!("  {},\n", serde_json::to_string(row).expect("a row without maps")))
        .collect();
    format!("\n/** {about} */\nexport const {name} = [\n{rows}] as const;\n")
}

fn record<T: serde::Serialize>(about: &str, name: &str, rows: &[(&str, T)]) -> String {
    let rows: String = rows
        .iter()
        .map(|(key, value)| {
            format!("  '{key}': {},\n", serde_json::to_string(value).expect("a value without maps"))
        })
        .collect();
    format!("\n/** {about} */\nexport const {name} = {{\n{rows}}} as const;\n")
}

fn constants() -> String {
    let rows: String = GESTURES
        .iter()
        .map(|row| format!("  /** {} ({}). */\n  {}: {},\n", row.about, row.unit, row.name, row.value))
        .collect();
    format!(
        "\n/** Constants of drags, the wheel and keys. */\nexport const GESTURES = {{\n{rows}}} as const;\n"
    )
}

fn number(about: &str, name: &str, value: impl std::fmt::Display) -> String {
    format!("\n/** {about} */\nexport const {name} = {value};\n")
}

#[test]
fn the_tables_of_the_page_are_those_of_the_facade() {
    let names: Vec<String> = VESSEL_NAMES.iter().flat_map(NamedVessel::offered).collect();
    let defaults: Vec<_> = QUANTITIES.iter().map(|row| (row.name, row.default)).collect();
    let files = [("volumes", volume_files()), ("centerlines", centerline_files())];
    let tables = [
        table("Names of vessels that have a code in reports.", "VESSEL_NAMES", &names),
        table("Colours of vessels with their names, in the order of their use.", "PALETTE", &PALETTE),
        record("What is taken unless the user chooses, by function and parameter.", "DEFAULTS", &defaults),
        table(
            "Smallest and largest pixel side of reformations by default (mm).",
            "PIXEL_SIDES",
            &PIXEL_SIDES,
        ),
        record("Files that can be opened, in the words of messages.", "FILES", &files),
        table("File name extensions of volumes.", "VOLUME_EXTENSIONS", &extensions(Role::Volume)),
        table(
            "File name extensions of centerlines.",
            "CENTERLINE_EXTENSIONS",
            &extensions(Role::Centerlines),
        ),
        table("Formats in which centerlines are saved.", "SAVED_CENTERLINES", &saved_by_the_page()),
        number("Name of the field that only sessions have.", "SESSION_FIELD", format_args!("'{FIELD}'")),
        constants(),
        number("Side of a section picture in a report (pixels).", "SECTION_PIXELS", PAGE_PIXELS),
        number("Half width of the uncertainty band, in standard deviations.", "DEVIATIONS", DEVIATIONS),
    ];
    require_current("tables.ts", &(HEAD.to_owned() + &tables.concat()));
}
