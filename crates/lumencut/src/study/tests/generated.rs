//! Files of the page that are generated from tables; `make generate` writes them.

use std::path::PathBuf;

/// Writes a generated file of the page if `make generate` runs, and fails if the file is out of date.
pub(crate) fn require_current(name: &str, expected: &str) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../web/src/core/generated");
    let path = folder.join(name);
    if std::env::var_os("LUMENCUT_WRITE_TYPES").is_some() {
        std::fs::write(&path, expected).expect("a file that can be written");
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    let stale = found.lines().zip(expected.lines()).position(|(found, expected)| found != expected);
    assert!(
        found == expected,
        "web/src/core/generated/{name} is stale from line {}: run `make generate`, and commit it",
        stale.unwrap_or(found.lines().count().min(expected.lines().count())) + 1
    );
}
