//! Handles several slices at one position: phases, overlapping parts of a scan, or repeated images. At shared
//! positions, overlapping parts have equal values, and phases have different ones. So the caller compares the values
//! of the returned pairs.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use crate::error::{Error, Result};
use crate::grouping::groups;
use crate::headers::Unlike;
use crate::keyword::Keyword;
use crate::phases::{choice, distinguishing, in_order, mixed, value_text, values_of};
use crate::slices::{Pair, Slice, are_unlike};
use crate::spacing::ONE_PLACE;
use crate::wording::{counted, listed};

pub(crate) fn one_per_place<'a>(
    ordered: Vec<Slice<'a>>,
    unlike: &[Unlike],
    notes: &mut Vec<String>,
) -> Result<(Vec<Slice<'a>>, Vec<Pair<'a>>)> {
    let places = places(&ordered);
    if places.len() == ordered.len() {
        return Ok((ordered, Vec::new()));
    }
    let neighbours: Vec<Pair> = places
        .iter()
        .flat_map(|place| place.windows(2).map(|two| (two[0].clone(), two[1].clone())))
        .collect();
    let found = format!("{} slices at {}", ordered.len(), counted(places.len() as i64, "position"));
    let keyword = distinguishing(&neighbours);
    if let Some(keyword) = keyword.filter(|&keyword| !may_overlap(&places, keyword)) {
        let found = format!("{found}: {}; {}", names(&neighbours), mixed(&ordered, keyword));
        return Err(Error::new(found, "one slice per position").mended_by(choice(&ordered, keyword)));
    }
    let (kept, pairs) = firsts(&places, keyword);
    let differing: Vec<Pair> = pairs.iter().filter(|pair| are_unlike(pair, unlike)).cloned().collect();
    if !differing.is_empty() {
        return Err(refused(&found, &differing, keyword.map(|keyword| (&ordered[..], keyword))));
    }
    notes.push(match keyword {
        Some(keyword) => format!(
            "{found}, with the same values at shared positions: overlapping parts are read as one scan ({} is {})",
            keyword.name(),
            values_of(&ordered, keyword)
        ),
        None => format!("{found}, with the same values at shared positions: one slice of each position is read"),
    });
    Ok((kept, pairs))
}

fn places<'s, 'a>(ordered: &'s [Slice<'a>]) -> Vec<&'s [Slice<'a>]> {
    let normal = ordered.first().map(Slice::normal).unwrap_or_default();
    let is_one = |a: &Slice, b: &Slice| b.position.dot(normal) - a.position.dot(normal) < ONE_PLACE;
    ordered.chunk_by(is_one).collect()
}

/// Whether slices may belong to overlapping parts of a scan. Then some positions have only one slice, and the
/// parts extend each other or share few positions.
fn may_overlap(places: &[&[Slice]], keyword: Keyword) -> bool {
    let shared = places.iter().filter(|place| place.len() > 1).count();
    let values =
        places.iter().map(|place| place.iter().map(|one| value_text(one, keyword)).collect::<BTreeSet<_>>());
    let covered = groups(values.flatten());
    let extend_each_other = covered.iter().all(|part| part.len() < places.len());
    shared < places.len() && (extend_each_other || 2 * shared <= places.len())
}

fn firsts<'a>(places: &[&[Slice<'a>]], keyword: Option<Keyword>) -> (Vec<Slice<'a>>, Vec<Pair<'a>>) {
    let (mut kept, mut pairs) = (Vec::new(), Vec::new());
    for place in places {
        let in_order = |a: &&Slice, b: &&Slice| {
            keyword
                .map_or(Ordering::Equal, |keyword| in_order(&value_text(a, keyword), &value_text(b, keyword)))
        };
        let Some(first) = place.iter().min_by(in_order) else { continue };
        let others = place.iter().filter(|other| !std::ptr::eq(*other, first));
        pairs.extend(others.map(|other| (first.clone(), other.clone())));
        kept.push(first.clone());
    }
    (kept, pairs)
}

fn refused(found: &str, differing: &[Pair], apart: Option<(&[Slice], Keyword)>) -> Error {
    let found = format!("{found}, with different values: {}", names(differing));
    let Some((ordered, keyword)) = apart else {
        return Error::new(found, "one slice per position").mend("remove all but one slice at each position");
    };
    let values = values_of(ordered, keyword);
    let found = format!("{found}; {} is {values}: phases, or overlapping parts of one scan", keyword.name());
    let error = Error::new(found, "one slice per position").mend("remove one of each pair if they are parts");
    let different: BTreeSet<String> = ordered.iter().map(|one| value_text(one, keyword)).collect();
    // If nearly every slice has a value of its own, the attribute does not indicate phases.
    if 2 * different.len() > ordered.len() { error } else { error.mended_by(choice(ordered, keyword)) }
}

fn names(pairs: &[Pair]) -> String {
    let names: Vec<String> = pairs.iter().map(|(a, b)| format!("{} and {}", a.name(), b.name())).collect();
    listed(&names)
}
