//! Links from the open ends of tracks to other tracks, so that they become trees.
//!
//! Each end is linked with the cheapest place of another track ahead. Then ends and sides are linked with other trees alone, and
//! with stricter limits: where two trees come from one short trunk their nearest ends belong to themselves.

pub mod ends;
pub mod groups;
pub mod landings;
pub mod sides;
pub mod way_level;

use rayon::prelude::*;

use crate::trace::find::links::ends::{End, ends};
use crate::trace::find::links::groups::Groups;
use crate::trace::find::links::landings::{BETWEEN_TREES, Landings, OPEN_ENDS};
use crate::trace::find::links::sides::side_links;
use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// How often the ends look for other trees.
const ROUNDS: usize = 2;

/// A link from a point of one track to a point of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The track it comes from, and the number of its point there.
    pub from: [usize; 2],
    /// The track that it leads to, and the number of its point there.
    pub to: [usize; 2],
    /// What it costs (mm).
    pub cost: f64,
    /// How much of it lies outside the lumens of both tracks (mm): a gap that it bridges.
    pub gap: f64,
    /// The lowest level along it: 0 that of the tissue around, 1 that of the lumens.
    pub level: f64,
}

impl Link {
    /// What decides between links of the same cost: the numbers of what they link.
    fn order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |link: &Self| (link.from, link.to);
        self.cost.total_cmp(&other.cost).then_with(|| numbers(self).cmp(&numbers(other)))
    }
}

/// The links between tracks.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn between(scan: &Scan, tracks: &[Track], stop: Stop) -> Result<Vec<Link>> {
    let landings = Landings::new(scan, tracks);
    let ends = ends(tracks);
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
    Ok(groups.links)
}

/// Links, the cheapest one first.
fn in_order(mut links: Vec<Link>) -> Vec<Link> {
    links.sort_unstable_by(Link::order);
    links
}

#[cfg(test)]
#[path = "links/tests/links.rs"]
mod tests;
