//! The hulls of vessels in the image: discs larger than the lumen by a margin, and tests for overlap.

use glam::DVec2;

use super::pieces::Piece;

/// Number of consecutive discs that a circle encloses, and of such circles that a larger circle encloses.
const DISCS_PER_CIRCLE: usize = 16;

const TOUCH_TOLERANCE_MM: f64 = 1e-9;

#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub center: DVec2,
    pub radius: f64,
    pub piece: usize,
    /// Arc length along the vessel (mm).
    pub at: f64,
}

impl Disc {
    fn overlaps(&self, other: &Self) -> bool {
        let reach = self.radius + other.radius - TOUCH_TOLERANCE_MM;
        reach > 0.0 && self.center.distance_squared(other.center) < reach * reach
    }

    fn towards(&self, next: &Self, share: f64) -> Self {
        let between = |from: f64, to: f64| from + (to - from) * share;
        Self {
            center: self.center.lerp(next.center, share),
            radius: between(self.radius, next.radius),
            at: between(self.at, next.at),
            ..*self
        }
    }
}

pub(super) fn discs(number: usize, piece: &Piece, places: &[DVec2], margin: f64) -> Vec<Disc> {
    let stations = places.iter().zip(&piece.radius).zip(&piece.at);
    stations
        .map(|((center, radius), at)| Disc {
            center: *center,
            radius: radius + margin,
            piece: number,
            at: *at,
        })
        .collect()
}

/// The discs at least `distance` from the origin, and one more at each crossing of that distance.
pub(super) fn beyond(discs: &[Disc], distance: f64) -> Vec<Disc> {
    let is_beyond = |disc: &Disc| disc.center.length() >= distance;
    let mut kept = Vec::new();
    for (n, disc) in discs.iter().enumerate() {
        if is_beyond(disc) {
            kept.push(*disc);
        }
        if let Some(next) = discs.get(n + 1)
            && next.piece == disc.piece
            && is_beyond(next) != is_beyond(disc)
        {
            kept.push(disc.towards(next, crossing(disc.center, next.center, distance)));
        }
    }
    kept
}

/// The share of the line from one position to another at which it has this distance from the origin.
fn crossing(from: DVec2, to: DVec2, distance: f64) -> f64 {
    let step = to - from;
    let [a, b, c] = [step.length_squared(), from.dot(step), from.length_squared() - distance * distance];
    let root = (b * b - a * c).max(0.0).sqrt();
    // Outwards the larger solution counts, inwards the smaller one.
    let share = if c < 0.0 { (root - b) / a } else { (-root - b) / a };
    share.clamp(0.0, 1.0)
}

type Circle = (DVec2, f64);

#[derive(Clone, Debug, Default)]
pub(super) struct Hull {
    discs: Vec<Disc>,
    /// A circle around each sixteen discs (`runs`), and one around each sixteen of those circles (`groups`).
    runs: Vec<Circle>,
    groups: Vec<Circle>,
}

impl Hull {
    pub(super) fn new(discs: Vec<Disc>) -> Self {
        let circles: Vec<Circle> = discs.iter().map(|disc| (disc.center, disc.radius.max(0.0))).collect();
        let around =
            |circles: &[Circle]| circles.chunks(DISCS_PER_CIRCLE).map(circle_around).collect::<Vec<_>>();
        let runs = around(&circles);
        Self { groups: around(&runs), runs, discs }
    }

    pub(super) fn discs(&self) -> &[Disc] {
        &self.discs
    }

    pub(super) fn turned(&self, angle: f64) -> Vec<Disc> {
        let turn = DVec2::from_angle(angle);
        self.discs.iter().map(|disc| Disc { center: turn.rotate(disc.center), ..*disc }).collect()
    }

    pub(super) fn overlaps(&self, other: &Self, angle: f64) -> bool {
        self.pairs(other, angle, &mut |_, _| true)
    }

    pub(super) fn add_overlapping(&self, other: &Self, angle: f64, pieces: &mut Vec<usize>) {
        self.pairs(other, angle, &mut |disc, other| {
            pieces.extend([disc.piece, other.piece]);
            false
        });
    }

    /// Whether two discs overlap that are farther apart along the piece than twice the sum of their radii.
    pub(super) fn overlaps_itself(&self) -> bool {
        let is_far =
            |disc: &Disc, other: &Disc| (disc.at - other.at).abs() > 2.0 * (disc.radius + other.radius);
        self.pairs(self, 0.0, &mut |disc, other| is_far(disc, other))
    }

    /// Passes overlapping discs of this hull and the other, turned, to `is_last` until it returns true.
    fn pairs(&self, other: &Self, angle: f64, is_last: &mut impl FnMut(&Disc, &Disc) -> bool) -> bool {
        let turn = DVec2::from_angle(angle);
        for (m, group) in other.groups.iter().enumerate() {
            let group = (turn.rotate(group.0), group.1);
            for n in (0..self.groups.len()).filter(|n| meet(&self.groups[*n], &group)) {
                for m in members(m, other.runs.len()) {
                    let run = (turn.rotate(other.runs[m].0), other.runs[m].1);
                    let near = members(n, self.runs.len()).filter(|n| meet(&self.runs[*n], &run));
                    for n in near {
                        if self.pairs_of_runs(n, other, m, turn, is_last) {
                            return true;
                        }
                    }
                }
            }
        }
        false
    }

    fn pairs_of_runs(
        &self,
        n: usize,
        other: &Self,
        m: usize,
        turn: DVec2,
        is_last: &mut impl FnMut(&Disc, &Disc) -> bool,
    ) -> bool {
        for other in &other.discs[members(m, other.discs.len())] {
            let other = Disc { center: turn.rotate(other.center), ..*other };
            for disc in &self.discs[members(n, self.discs.len())] {
                if disc.overlaps(&other) && is_last(disc, &other) {
                    return true;
                }
            }
        }
        false
    }
}

fn circle_around(circles: &[Circle]) -> Circle {
    let center = circles.iter().map(|(center, _)| center).sum::<DVec2>() / circles.len() as f64;
    let reach = |(other, radius): &Circle| other.distance(center) + radius;
    (center, circles.iter().map(reach).fold(0.0, f64::max))
}

/// The indices of the discs or circles that circle `n` encloses, of `count` in all.
fn members(n: usize, count: usize) -> std::ops::Range<usize> {
    n * DISCS_PER_CIRCLE..count.min((n + 1) * DISCS_PER_CIRCLE)
}

fn meet(circle: &Circle, other: &Circle) -> bool {
    let reach = circle.1 + other.1;
    circle.0.distance_squared(other.0) <= reach * reach
}
