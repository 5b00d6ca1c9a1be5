//! All tests of the core in one program, except `memory.rs`, which counts allocations in its own process.

mod along_rays;
mod bad_input;
mod centerline_smoothing;
mod chosen;
mod context;
mod cr;
mod cut_surface;
mod depth_filter;
mod errors;
mod focus;
mod hierarchy_equals_brute_force;
mod independence;
mod leaps;
mod lines;
mod mpcpr;
mod one_decision;
mod paper;
mod scene;
mod settings;
mod stages;
mod table;
mod three_tiers;

/// A test file missing here would never run.
#[test]
fn every_file_of_tests_is_named_here() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let files = std::fs::read_dir(&folder).expect("the folder of the tests");
    let stems = files.filter_map(|file| {
        let path = file.ok()?.path();
        (path.extension()? == "rs").then(|| path.file_stem()?.to_str().map(str::to_owned))?
    });
    let named: Vec<_> =
        include_str!("main.rs").lines().filter_map(|line| line.strip_prefix("mod ")).collect();
    let forgotten: Vec<_> = stems
        .filter(|stem| {
            !["main", "memory"].contains(&stem.as_str()) && !named.contains(&format!("{stem};").as_str())
        })
        .collect();
    assert!(named.len() > 15);
    assert_eq!(forgotten, [] as [&str; 0]);
}
