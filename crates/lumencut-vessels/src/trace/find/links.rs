//! Links open ends of tracks to other tracks, so that tracks form trees. Each end is first linked to the cheapest
//! point ahead of it. Then ends and sides are linked, but only to other trees and with stricter limits. If two trees
//! come from one short trunk, their nearest ends belong together.

pub(crate) mod bridges;
pub(crate) mod ends;
pub(crate) mod groups;
pub(crate) mod landings;
pub(crate) mod link;
pub(crate) mod sides;

use rayon::prelude::*;

use crate::trace::find::links::bridges::bridges;
use crate::trace::find::links::ends::{End, ends};
use crate::trace::find::links::groups::Groups;
use crate::trace::find::links::landings::{BETWEEN_TREES, Landings, OPEN_ENDS};
use crate::trace::find::links::link::Link;
use crate::trace::find::links::sides::side_links;
use crate::trace::find::progress::{Stage, Stages};
use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Number of rounds in which ends and sides are linked to other trees.
const ROUNDS: usize = 2;

pub(crate) fn between(scan: &Scan, tracks: &[Track], stop: Stop, stages: Stages) -> Result<Vec<Link>> {
    let landings = Landings::new(scan, tracks);
    let ends = ends(tracks);
    // Each end is processed three times, and each side once.
    let pieces = stages.stage(Stage::Links, 3 * ends.len() + tracks.len());
    let stop = &|| {
        pieces.done(1);
        stop()
    };
    let mut groups = Groups::new(tracks);
    let cheapest = |end: &End| {
        go_on(stop)?;
        Ok(landings.of(end, &OPEN_ENDS).next())
    };
    let links: Vec<Option<Link>> = ends.par_iter().map(cheapest).collect::<Result<_>>()?;
    for link in in_order(links.into_iter().flatten().collect()) {
        groups.add_unless_small_loop(link);
    }
    let to_trees = |end: &End| {
        go_on(stop)?;
        Ok(landings.of(end, &BETWEEN_TREES).collect())
    };
    let to_trees: Vec<Vec<Link>> = ends.par_iter().map(to_trees).collect::<Result<_>>()?;
    for _ in 0..ROUNDS {
        let next = |links: &Vec<Link>| links.iter().find(|link| groups.are_apart(link)).copied();
        for link in in_order(to_trees.iter().filter_map(next).collect()) {
            groups.add_between_trees(link);
        }
    }
    for link in in_order(side_links(scan, tracks, &groups, &landings, stop)?) {
        groups.add_between_trees(link);
    }
    for link in in_order(bridges(scan, tracks, &ends, &groups, stop)?) {
        groups.add_between_trees(link);
    }
    Ok(groups.links)
}

fn in_order(mut links: Vec<Link>) -> Vec<Link> {
    links.sort_unstable_by(Link::order);
    links
}

#[cfg(test)]
#[path = "links/tests/links.rs"]
mod tests;
