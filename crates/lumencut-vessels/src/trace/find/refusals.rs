//! Error messages for scans and seeds in which no vessels can be found.

use glam::DVec3;

use crate::trace::find::found::{Below, NoVessel, Trees};
use crate::trace::lumen::lumen_model::in_words;
use lumencut_core::error::{Error, ErrorKind, Mend};

/// The error if no vessel is sure. It states the number of doubtful ones, and what a smaller radius finds.
pub fn no_vessel(trees: &Trees) -> Error {
    let doubtful = trees.vessels.len();
    let found = match doubtful {
        0 => format!("none whose radius is {} mm or more", rounded(trees.smallest_radius)),
        1 => "no certain vessel, but one doubtful vessel".to_owned(),
        several => format!("no certain vessel, but {several} doubtful vessels"),
    };
    let subject = "no vessel found";
    if let Some(Below { smallest_radius, length }) = trees.below {
        let found = format!("{found}; from {} mm on, {length:.0} mm of sure ones", rounded(smallest_radius));
        let expected = "vessels as wide as the smallest radius";
        return Error::new(ErrorKind::Tracing, subject, found, expected).mended_by(Mend::SmallerRadius);
    }
    let expected = "an angiography, whose vessels are brighter than the tissue around them";
    let error = Error::new(ErrorKind::Tracing, subject, found, expected);
    let mend = if doubtful > 0 { Mend::Doubtful } else { Mend::SmallerRadius };
    error.mend("trace between two points along a vessel").mended_by(mend)
}

/// A length (mm) in hundredths.
fn rounded(length: f64) -> f64 {
    (100.0 * length).round() / 100.0
}

/// The error for a seed outside the volume.
pub fn outside(seed: DVec3) -> Error {
    let found = format!("{}, outside the volume", in_words(seed));
    Error::new(ErrorKind::Tracing, "seed", found, "a point within the volume")
}

/// The error for a seed in no vessel. It states the value at the seed, and position and distance (mm) of the
/// nearest vessel.
pub(crate) fn not_here(seed: DVec3, value: f64, nearest: DVec3, distance: f64) -> Error {
    let found = format!("no vessel here; the nearest one is {distance:.1} mm away, at {}", in_words(nearest));
    let expected = "a point within a vessel";
    let error = Error::new(ErrorKind::Tracing, format!("seed {}", in_words(seed)), found, expected);
    error.mend("put the seed into a vessel, or trace between two points along it").at(seed, value)
}

/// The error for a click (mm, LPS) that gives no vessel. It states the value at the click.
pub fn no_whole_vessel(click: DVec3, value: f64, reason: NoVessel) -> Error {
    let (found, expected) = match reason {
        NoVessel::NotHere(distance) if distance.is_infinite() => {
            ("no vessel in this scan".to_owned(), "a point within a vessel")
        }
        NoVessel::NotHere(distance) => {
            (format!("no vessel there; the nearest one is {distance:.1} mm away"), "a point within a vessel")
        }
        NoVessel::Already => ("a vessel that is already traced".to_owned(), "one that is not"),
    };
    let error = Error::new(ErrorKind::Tracing, "this point", found, expected).at(click, value);
    match reason {
        NoVessel::NotHere(_) => error.mend("click the vessel at a second point to trace between both"),
        NoVessel::Already => error,
    }
}

/// The error for a seed whose connected part has only doubtful vessels. `doubt` is the reason of the first one.
pub(crate) fn only_doubtful(seed: DVec3, value: f64, doubt: &str) -> Error {
    let found = format!("a doubtful vessel there: {doubt}");
    let error = Error::new(ErrorKind::Tracing, format!("seed {}", in_words(seed)), found, "one that is sure");
    error.mend("trace between two points along it").at(seed, value)
}
