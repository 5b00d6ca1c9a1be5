//! Checks properties that must hold for any bytes that are read as a centerline file.

mod memory;
mod packed;

use std::time::Duration;

use cpu_time::ThreadTime;
use lumencut_io::{Error, Line, junctions, read, write_mrk_json, write_vtp};

pub use packed::vtp as packed_vtp;

/// Maximum memory for reading a file, as a multiple of the file's size.
const MOST_TIMES: usize = 10;
/// Files smaller than this (bytes) may use as much memory as a file of this size.
const SMALL: usize = 1 << 20;
/// Maximum CPU time for all reading and writing of one file.
const MOST_TIME: Duration = Duration::from_secs(2);

/// Lines with more points than this are not checked in other units.
const FEW_POINTS: usize = 1000;

/// Reads `data` as a file of this name and checks the result. Panics if a line is invalid, if memory or time
/// exceeds its limit, or if written lines differ after reading back.
pub fn check(data: &[u8], name: &str) {
    let start = ThreadTime::now();
    check_what_is_read(data, name);
    let taken = start.elapsed();
    assert!(taken <= MOST_TIME, "{} bytes took {taken:?} of computing, more than {MOST_TIME:?}", data.len());
}

fn check_what_is_read(data: &[u8], name: &str) {
    let (vessels, peak) =
        memory::peak_of(|| read(data, name).and_then(|found| found.scaled(1.0)).map(junctions::vessels));
    let most = MOST_TIMES * data.len().max(SMALL);
    assert!(peak <= most, "reading {} bytes took {peak} bytes, more than {most}", data.len());
    // Coordinates are checked in three units, because their limit depends on the unit.
    let Ok(found) = read(data, name) else { return };
    assert_sound(&found.lines);
    if found.lines.iter().map(|line| line.points.len()).sum::<usize>() <= FEW_POINTS {
        for factor in [10.0, 1e-3] {
            let scaled = found.clone().scaled(factor).map(junctions::vessels);
            scaled.iter().for_each(|vessels| assert_sound(&vessels.lines));
        }
    }
    let Ok(vessels) = vessels else { return };
    // Writes the lines of the file, and then the vessels that they form.
    let lines = found.scaled(1.0).expect("a file that was read before").lines;
    for lines in [lines, vessels.lines] {
        assert_sound(&lines);
        assert_written_alike(lines);
    }
}

fn assert_sound(lines: &[Line]) {
    assert!(!lines.is_empty(), "no line");
    for (i, line) in lines.iter().enumerate() {
        let count = line.points.len();
        assert!(count >= 2, "line {i} has {count} points");
        assert!(line.points.iter().all(|p| p.is_finite()), "line {i} has points that are no places");
        let Some(radius) = &line.radius else { continue };
        assert_eq!(radius.len(), count, "line {i} has another number of radii than of points");
        assert!(radius.iter().all(|r| r.is_finite() && *r >= 0.0), "line {i} has radii that are no sizes");
    }
}

fn assert_written_alike(mut lines: Vec<Line>) {
    type Writer = fn(&[Line]) -> Result<Vec<u8>, Error>;
    // Groups are not written, and text in VTK files ends at a null character.
    let null = lines.iter().any(|line| line.name.as_ref().is_some_and(|name| name.contains('\0')));
    lines.iter_mut().for_each(|line| line.group = None);
    for (write, name, able) in [(write_vtp as Writer, "b.vtp", !null), (write_mrk_json, "b.mrk.json", true)] {
        if able {
            let bytes = write(&lines).unwrap_or_else(|error| panic!("not written as {name}: {error}"));
            let back = read(&bytes, name).unwrap_or_else(|error| panic!("not read back: {error}"));
            let back = junctions::vessels(back).lines;
            // The debug text is compared, because it distinguishes 0 from -0.
            assert!(format!("{back:?}") == format!("{lines:?}"), "read back otherwise from {name}");
        }
    }
}
