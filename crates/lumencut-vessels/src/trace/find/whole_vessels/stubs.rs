//! Removes stubs: short ends of a track beyond a fork.

use crate::trace::find::links::link::Link;
use crate::trace::find::track::{Track, length};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Maximum length of a stub, in radii of the track at the link.
const LONGEST: f64 = 1.5;

/// Minimum width of the fork's other branch, relative to the track.
const AS_WIDE: f64 = 0.6;

/// The tracks without stubs, and the links with point numbers adapted to these tracks.
pub(crate) fn without_stubs(tracks: &[Track], links: &[Link], stop: Stop) -> Result<(Vec<Track>, Vec<Link>)> {
    let (mut tracks, mut links) = (tracks.to_vec(), links.to_vec());
    for number in 0..tracks.len() {
        go_on(stop)?;
        for at_last in [true, false] {
            if let Some(kept) = kept(&tracks, &links, number, at_last) {
                shorten(&mut tracks[number], &mut links, number, kept, at_last);
            }
        }
    }
    Ok((tracks, links))
}

fn kept(tracks: &[Track], links: &[Link], number: usize, at_last: bool) -> Option<usize> {
    let points = &tracks[number].points;
    let last = points.len() - 1;
    let both = links.iter().flat_map(|link| [(link.from, link.to), (link.to, link.from)]);
    let here: Vec<([usize; 2], [usize; 2])> = both.filter(|(own, _)| own[0] == number).collect();
    let along = |own: &[usize; 2]| if at_last { own[1] } else { last - own[1] };
    let outermost = here.iter().map(|(own, _)| along(own)).max().filter(|n| *n < last && *n > 0)?;
    let at = if at_last { outermost } else { last - outermost };
    let widest = here.iter().filter(|(own, _)| own[1] == at).map(|(_, other)| tracks[other[0]].radius());
    let stub = if at_last { &points[at..] } else { &points[..=at] };
    let length = length(stub);
    let is_fork = widest.fold(0.0, f64::max) >= AS_WIDE * points[at].radius;
    (is_fork && length <= LONGEST * points[at].radius).then_some(at)
}

fn shorten(track: &mut Track, links: &mut [Link], number: usize, at: usize, at_last: bool) {
    if at_last {
        track.points.truncate(at + 1);
        return;
    }
    track.points.drain(..at);
    for link in links {
        for end in [&mut link.from, &mut link.to] {
            if end[0] == number {
                end[1] -= at;
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/stubs.rs"]
mod tests;
