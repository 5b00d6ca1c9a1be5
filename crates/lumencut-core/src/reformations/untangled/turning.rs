//! Decides which branches of a tree turn, and by how much, so that no vessel hides another in the image.

use std::f64::consts::PI;

use glam::DVec2;
use rayon::prelude::*;

use super::growth::Growth;
use super::hull::{Disc, Hull, beyond, discs};
use super::pieces::Piece;
use super::sectors::{Sector, turns};
use super::strip::Strip;
use crate::error::{Error, Result};
use crate::stop::{Stop, go_on};

/// Within this number of hull radii (plus `OVERLAP_EXTRA_MM` mm) around a branching point, branches may
/// overlap. The numbers are tried in this order.
const OVERLAP_RADII: [f64; 5] = [1.5, 2.5, 4.0, 7.0, 12.0];
pub(super) const OVERLAP_EXTRA_MM: f64 = 2.0;

/// Shares of the bends of vessels that are kept, tried in this order.
const STIFFNESS: [f64; 4] = [1.0, 0.6, 0.3, 0.0];

/// Number of steps into which a turn is divided, and of bisections of the first step that suffices.
const TURN_STEPS: usize = 16;
const BISECTIONS: usize = 16;

#[derive(Clone, Copy)]
pub(super) struct Tree<'a> {
    pub pieces: &'a [Piece],
    pub strips: &'a [Strip],
    pub growth: &'a Growth,
    /// The margin by which a hull is wider than the lumen (mm).
    pub hull_margin: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Turning {
    /// The stations of each piece (mm) before any turn; the first is where the piece begins to grow.
    pub places: Vec<Vec<DVec2>>,
    /// The turn of each piece and all that follows it (radians, counter-clockwise).
    pub turns: Vec<f64>,
    /// The hull of each connected part, relative to its root.
    pub hulls: Vec<Vec<Disc>>,
    /// Number of hull radii around a branching point (plus [`OVERLAP_EXTRA_MM`]) where branches may overlap.
    pub near: f64,
    /// Number of branching points at which sectors did not fit, so branches turned too much or too little.
    pub without_room: usize,
    /// The pieces that still overlap others, or themselves.
    pub overlaps: Vec<usize>,
}

impl Turning {
    /// The numbers of faults, the more serious ones first.
    fn faults(&self) -> (usize, usize) {
        (self.overlaps.len(), self.without_room)
    }
}

/// The first layout without overlaps in which all branches have room. If there is none, the tried layout with
/// the fewest overlapping pieces, then with the fewest branching points without room.
pub(super) fn untangle(tree: Tree, stop: Stop) -> Result<Turning> {
    let mut best: Option<Turning> = None;
    let ways: Vec<_> =
        OVERLAP_RADII.iter().flat_map(|near| STIFFNESS.map(|stiffness| (*near, stiffness))).collect();
    // The first layout suffices for most trees; the others are tried in parallel, a few at a time.
    let (first, others) = ways.split_at(1);
    for ways in [first].into_iter().chain(others.chunks(STIFFNESS.len())) {
        let attempts = ways.par_iter().map(|(near, stiffness)| attempt(tree, *near, *stiffness, stop));
        for turning in attempts.collect::<Result<Vec<_>>>()? {
            if best.as_ref().is_none_or(|best| turning.faults() < best.faults()) {
                best = Some(turning);
            }
        }
        if best.as_ref().is_some_and(|best| best.faults() == (0, 0)) {
            break;
        }
    }
    best.ok_or_else(Error::interrupted)
}

fn attempt(tree: Tree, near: f64, stiffness: f64, stop: Stop) -> Result<Turning> {
    let Tree { pieces, strips, growth, hull_margin } = tree;
    let bent = |n: usize| strips[n].bent(&pieces[n], growth.is_reversed[n], stiffness);
    let mut turning = Turning {
        places: (0..pieces.len()).map(bent).collect(),
        turns: vec![0.0; pieces.len()],
        hulls: Vec::new(),
        near,
        without_room: 0,
        overlaps: Vec::new(),
    };
    // The discs of each piece and of all pieces that follow it, which are turned already.
    let mut units: Vec<Vec<Disc>> = vec![Vec::new(); pieces.len()];
    for part in &growth.parts {
        for &piece in part.order.iter().rev() {
            go_on(stop)?;
            let own = discs(piece, &pieces[piece], &turning.places[piece], hull_margin);
            if Hull::new(own.clone()).overlaps_itself() {
                turning.overlaps.push(piece);
            }
            let end = turning.places[piece][if growth.is_reversed[piece] { 0 } else { own.len() - 1 }];
            let moved = |discs: &[Disc], by: DVec2| -> Vec<Disc> {
                discs.iter().map(|disc| Disc { center: disc.center + by, ..*disc }).collect()
            };
            let children = &growth.children[piece];
            let forward = forward_of(&turning.places[piece], growth.is_reversed[piece]);
            let parent = Some((moved(&own, -end), forward));
            let mut unit = own;
            for discs in turn_apart(&mut turning, &mut units, children, parent, near) {
                unit.extend(moved(&discs, end));
            }
            units[piece] = unit;
        }
        let hull = turn_apart(&mut turning, &mut units, &part.first, None, near);
        turning.hulls.push(hull.concat());
    }
    turning.overlaps.sort_unstable();
    turning.overlaps.dedup();
    Ok(turning)
}

fn forward_of(places: &[DVec2], is_reversed: bool) -> DVec2 {
    let last = places.len() - 1;
    let step = if is_reversed { places[0] - places[1] } else { places[last] - places[last - 1] };
    step.normalize_or(DVec2::NEG_Y)
}

/// Turns units (pieces with followers) that begin at one point away from each other and `parent`; returns their
/// discs.
fn turn_apart(
    turning: &mut Turning,
    units: &mut [Vec<Disc>],
    children: &[usize],
    parent: Option<(Vec<Disc>, DVec2)>,
    near: f64,
) -> Vec<Vec<Disc>> {
    let own: Vec<Hull> = children.iter().map(|child| Hull::new(std::mem::take(&mut units[*child]))).collect();
    let node = Node::new(&own, parent, near);
    let (wanted, has_room) = node.wanted_turns();
    let share = node.smallest_share(&wanted);
    turning.without_room += usize::from(share > 0.0 && !has_room);
    node.add_overlaps(&wanted, share, &mut turning.overlaps);
    let turned = children.iter().zip(&own).zip(&wanted);
    turned
        .map(|((child, hull), wanted)| {
            turning.turns[*child] = share * wanted;
            hull.turned(share * wanted)
        })
        .collect()
}

struct Node {
    /// The hulls of the branches beyond the radius within which all may overlap.
    branches: Vec<Hull>,
    /// The hull of the piece that ends at the node; empty if there is none.
    parent: Hull,
    forward: DVec2,
}

impl Node {
    fn new(branches: &[Hull], parent: Option<(Vec<Disc>, DVec2)>, near: f64) -> Self {
        let (parent, forward) = parent.map_or((Vec::new(), None), |(discs, forward)| (discs, Some(forward)));
        let all = branches.iter().map(Hull::discs).chain([parent.as_slice()]);
        // The disc at the point is the first or the last one of each piece that meets there.
        let at_node = |discs: &[Disc]| {
            let here = discs.iter().filter(|disc| disc.center == DVec2::ZERO).map(|disc| disc.radius);
            here.fold(0.0, f64::max)
        };
        let distance = near * all.map(at_node).fold(0.0, f64::max) + OVERLAP_EXTRA_MM;
        let outer = |discs: &[Disc]| Hull::new(beyond(discs, distance));
        let branches: Vec<Hull> = branches.iter().map(|branch| outer(branch.discs())).collect();
        let middle = || {
            let places = branches.iter().flat_map(|branch| branch.discs().iter().map(|disc| disc.center));
            places.map(DVec2::normalize_or_zero).sum::<DVec2>().normalize_or(DVec2::NEG_Y)
        };
        let forward = forward.unwrap_or_else(middle);
        Self { branches, parent: outer(&parent), forward }
    }

    fn wanted_turns(&self) -> (Vec<f64>, bool) {
        let behind = Sector::of(self.parent.discs(), -self.forward).unwrap_or(Sector { low: 0.0, high: 0.0 });
        let room = Sector { low: behind.high - PI, high: PI + behind.low };
        let sectors: Vec<Option<Sector>> =
            self.branches.iter().map(|branch| Sector::of(branch.discs(), self.forward)).collect();
        let known: Vec<Sector> = sectors.iter().flatten().copied().collect();
        let has_room = known.iter().map(Sector::width).sum::<f64>() <= room.width();
        let mut found = turns(&known, room).into_iter();
        // A branch that ends near the point has no sector, and stays.
        let wanted = sectors.iter().map(|sector| sector.and_then(|_| found.next()).unwrap_or(0.0));
        (wanted.collect(), has_room)
    }

    /// The smallest share of the wanted turns at which nothing overlaps; 1 if there is none.
    fn smallest_share(&self, wanted: &[f64]) -> f64 {
        let mut shares = (0..=TURN_STEPS).map(|step| step as f64 / TURN_STEPS as f64);
        let Some(mut enough) = shares.find(|share| self.is_apart(wanted, *share)) else { return 1.0 };
        if enough == 0.0 {
            return 0.0;
        }
        let mut too_small = enough - 1.0 / TURN_STEPS as f64;
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(too_small, enough);
            let half = if self.is_apart(wanted, middle) { &mut enough } else { &mut too_small };
            *half = middle;
        }
        enough
    }

    fn is_apart(&self, wanted: &[f64], share: f64) -> bool {
        !self.pairs(wanted, share).any(|(hull, other, angle)| hull.overlaps(other, angle))
    }

    fn add_overlaps(&self, wanted: &[f64], share: f64, pieces: &mut Vec<usize>) {
        let pairs = self.pairs(wanted, share);
        pairs.for_each(|(hull, other, angle)| hull.add_overlapping(other, angle, pieces));
    }

    fn pairs<'a>(&'a self, wanted: &'a [f64], share: f64) -> impl Iterator<Item = (&'a Hull, &'a Hull, f64)> {
        let angles = wanted.iter().map(move |wanted| share * wanted);
        let all: Vec<(&Hull, f64)> = self.branches.iter().zip(angles).chain([(&self.parent, 0.0)]).collect();
        (1..all.len()).flat_map(move |second| {
            let (other, angle) = all[second];
            let pair = |(hull, own): &(&'a Hull, f64)| (*hull, other, angle - own);
            all[..second].iter().map(pair).collect::<Vec<_>>()
        })
    }
}
