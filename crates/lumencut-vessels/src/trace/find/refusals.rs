//! Error messages for scans and seeds in which no vessels can be found.

use glam::DVec3;

use crate::kind::{Kind, Words};
use crate::trace::find::found::{Below, NoVessel, Trees};
use crate::trace::find::track::TrackDoubt;
use crate::trace::lumen::lumen_model::in_words;
use lumencut_core::error::{Error, ErrorKind, Mend};

/// The error if no vessel is sure. It states the number of doubtful ones, and what a smaller radius finds.
pub fn no_vessel(trees: &Trees) -> Error {
    let doubtful = trees.vessels.len();
    let Words { one, several, scan, .. } = trees.kind.words();
    let found = match doubtful {
        0 => format!("none whose radius is {} mm or more", rounded(trees.smallest_radius)),
        1 => format!("no certain {one}, but one doubtful {one}"),
        count => format!("no certain {one}, but {count} doubtful {several}"),
    };
    let subject = format!("no {one} found");
    if let Some(Below { smallest_radius, length }) = trees.below {
        let found = format!("{found}; from {} mm on, {length:.0} mm of sure ones", rounded(smallest_radius));
        let expected = format!("{several} as wide as the smallest radius");
        return Error::new(ErrorKind::Tracing, subject, found, expected).mended_by(Mend::SmallerRadius);
    }
    let error = Error::new(ErrorKind::Tracing, subject, found, *scan);
    let mend = if doubtful > 0 { Mend::Doubtful } else { Mend::SmallerRadius };
    error.mend(format!("trace between two points along a {one}")).mended_by(mend)
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
pub(crate) fn not_here((seed, value): (DVec3, f64), kind: Kind, nearest: DVec3, distance: f64) -> Error {
    let one = kind.words().one;
    let found = format!("no {one} here; the nearest one is {distance:.1} mm away, at {}", in_words(nearest));
    let expected = format!("a point within a {one}");
    let error = Error::new(ErrorKind::Tracing, format!("seed {}", in_words(seed)), found, expected);
    error.mend(format!("put the seed into a {one}, or trace between two points along it")).at(seed, value)
}

/// The error for a click (mm, LPS) that gives no vessel. It states the value at the click.
pub fn no_whole_vessel((click, value): (DVec3, f64), kind: Kind, reason: NoVessel) -> Error {
    let one = kind.words().one;
    let (found, expected) = match reason {
        NoVessel::NotHere(distance) if distance.is_infinite() => {
            (format!("no {one} in this scan"), format!("a point within a {one}"))
        }
        NoVessel::NotHere(distance) => {
            let found = format!("no {one} there; the nearest one is {distance:.1} mm away");
            (found, format!("a point within a {one}"))
        }
        NoVessel::Already => (format!("a {one} that is already traced"), "one that is not".to_owned()),
    };
    let error = Error::new(ErrorKind::Tracing, "this point", found, expected).at(click, value);
    match reason {
        NoVessel::NotHere(_) => {
            error.mend(format!("click the {one} at a second point to trace between both"))
        }
        NoVessel::Already => error,
    }
}

/// The error for a seed whose connected part has only doubtful vessels. `doubt` is the reason of the first one.
pub(crate) fn only_doubtful((seed, value): (DVec3, f64), kind: Kind, doubt: TrackDoubt) -> Error {
    let found = format!("a doubtful {} there: {}", kind.words().one, doubt.words(kind));
    let error = Error::new(ErrorKind::Tracing, format!("seed {}", in_words(seed)), found, "one that is sure");
    error.mend("trace between two points along it").at(seed, value)
}
